// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/files/fits.hpp"

#include <fitsio.h>

#include <cmath>
#include <vector>

#include "folder.hpp"

namespace glint {
namespace {

using test::Folder;
using test::has;
using test::message_of;

/// Writes a FITS file of one image or cube; `empty_first` puts a unit without data before it.
void write_fits(const std::string& path, int bitpix, std::vector<long> axes,
                std::vector<double> values, bool empty_first = false) {
  fitsfile* file = nullptr;
  int status = 0;
  fits_create_file(&file, path.c_str(), &status);
  if (empty_first) fits_create_img(file, BYTE_IMG, 0, nullptr, &status);
  fits_create_img(file, bitpix, static_cast<int>(axes.size()), axes.data(), &status);
  fits_write_img(file, TDOUBLE, 1, static_cast<LONGLONG>(values.size()), values.data(), &status);
  fits_close_file(file, &status);
  ASSERT_EQ(status, 0);
}

TEST(Fits, ReadsEveryKindOfPixel) {
  const Folder folder;
  for (const int bitpix : {BYTE_IMG, SHORT_IMG, USHORT_IMG, LONG_IMG, FLOAT_IMG, DOUBLE_IMG}) {
    const std::string path = folder / (std::to_string(bitpix) + ".fits");
    write_fits(path, bitpix, {3, 2}, {1, 2, 3, 4, 5, 250});
    const auto frame = open_fits(path)->next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->pixels.width, 3);
    EXPECT_EQ(frame->pixels.height, 2);
    const float* p = std::get<const float*>(frame->pixels.data);
    EXPECT_EQ(p[1], 2) << bitpix;
    EXPECT_EQ(p[5], 250) << bitpix;
  }
}

TEST(Fits, ACubeIsASequenceAndEmptyUnitsArePassedOver) {
  const Folder folder;
  write_fits(folder / "c.fits", FLOAT_IMG, {2, 1, 3}, {0, 1, 10, 11, 20, NAN}, true);
  const auto source = open_fits(folder / "c.fits");
  EXPECT_EQ(source->frame_count(), 3);
  source->next();
  EXPECT_EQ(std::get<const float*>(source->next()->pixels.data)[1], 11);
  const auto last = source->next();
  EXPECT_TRUE(std::isnan(std::get<const float*>(last->pixels.data)[1]));
  EXPECT_FALSE(source->next());
}

TEST(Fits, TruncatedAndForeignFilesAreNamed) {
  const Folder folder;
  write_fits(folder / "t.fits", FLOAT_IMG, {64, 64}, std::vector<double>(64 * 64, 1));
  test::truncate(folder / "t.fits", 0.5);
  const auto read = [&](const std::string& name) {
    return message_of<std::runtime_error>([&] {
      const auto source = open_fits(folder / name);
      while (source->next()) {
      }
    });
  };
  EXPECT_TRUE(has(read("t.fits"), "t.fits"));
  folder.write("f.fits", "this is no FITS file");
  EXPECT_TRUE(has(read("f.fits"), "f.fits"));
}

}  // namespace
}  // namespace glint
