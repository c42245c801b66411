// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/files/fits.hpp"

#include <fitsio.h>
#include <fmt/core.h>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <stdexcept>

namespace glint {
namespace {

struct CloseFits {
  void operator()(fitsfile* file) const {
    int status = 0;
    fits_close_file(file, &status);
  }
};
using FitsHandle = std::unique_ptr<fitsfile, CloseFits>;

[[noreturn]] void refuse(const std::string& path, const std::string& what, int status) {
  char text[FLEN_STATUS];
  fits_get_errstatus(status, text);
  fits_clear_errmsg();
  throw std::runtime_error(
      fmt::format("{}: {} ({}); copy or make the file again", path, what, text));
}

FitsHandle open(const std::string& path) {
  fitsfile* file = nullptr;
  int status = 0;
  // "diskfile": brackets in a name are part of the name
  if (fits_open_diskfile(&file, path.c_str(), READONLY, &status)) {
    refuse(path, "cannot be read as FITS", status);
  }
  return FitsHandle(file);
}

/// Axis lengths of the present unit if it is an image or a cube, otherwise {0, 0, 0}.
struct Axes {
  long width = 0, height = 0, frames = 0;
};

Axes axes_of(fitsfile* file) {
  int status = 0, type = 0, count = 0;
  long length[3] = {0, 0, 1};
  fits_get_hdu_type(file, &type, &status);
  if (status != 0 || type != IMAGE_HDU) return {};
  fits_get_img_dim(file, &count, &status);
  fits_get_img_size(file, 3, length, &status);
  if (status != 0 || count < 2 || count > 3) return {};
  return {length[0], length[1], length[2]};
}

/// No picture is packed better than a thousandfold: a larger one is a damaged header's, and there
/// may be no memory for it.
bool can_hold(const std::string& path, const Axes& axes) {
  constexpr std::uintmax_t kPixelsPerByte = 4096;
  constexpr long kMaxSide = 1L << 20;
  if (axes.width > kMaxSide || axes.height > kMaxSide) return false;
  return static_cast<std::uintmax_t>(axes.width) * static_cast<std::uintmax_t>(axes.height) <=
         kPixelsPerByte * std::filesystem::file_size(path);
}

class FitsSource : public Source {
 public:
  explicit FitsSource(const std::string& path) : path_(path), file_(open(path)) {
    int units = 0, status = 0;
    fits_get_num_hdus(file_.get(), &units, &status);
    for (int unit = 1; unit <= units && axes_.width == 0; ++unit) {
      fits_movabs_hdu(file_.get(), unit, nullptr, &status);
      axes_ = axes_of(file_.get());
    }
    if (status != 0) refuse(path, "cannot be read as FITS", status);
    if (axes_.width < 1 || axes_.height < 1 || axes_.frames < 1) {
      throw std::runtime_error(path +
                               ": holds no image or cube (NAXIS 2 or 3); give a file that does");
    }
    if (!can_hold(path, axes_)) {
      throw std::runtime_error(
          fmt::format("{}: its header asks for {}x{} pixels, more than the file can hold; copy or "
                      "make it again",
                      path, axes_.width, axes_.height));
    }
  }

  std::optional<SourceFrame> next() override {
    if (frame_ == axes_.frames) return std::nullopt;
    const long long count = static_cast<long long>(axes_.width) * axes_.height;
    auto pixels = std::shared_ptr<float[]>(new float[static_cast<std::size_t>(count)]);
    long first[3] = {1, 1, ++frame_};
    float blank = std::numeric_limits<float>::quiet_NaN();
    int status = 0, any_blank = 0;  // cfitsio writes to the latter unasked
    fits_read_pix(file_.get(), TFLOAT, first, count, &blank, pixels.get(), &any_blank, &status);
    if (status != 0) {
      refuse(path_, fmt::format("frame {} of {} is damaged or truncated", frame_ - 1, axes_.frames),
             status);
    }
    SourceFrame frame;
    frame.pixels = {static_cast<const float*>(pixels.get()), static_cast<int>(axes_.width),
                    static_cast<int>(axes_.height), 1, axes_.width};
    frame.owner = std::move(pixels);
    return frame;
  }
  std::optional<std::int64_t> frame_count() const override { return axes_.frames; }

 private:
  std::string path_;
  FitsHandle file_;
  Axes axes_;
  long frame_ = 0;
};

}  // namespace

std::unique_ptr<Source> open_fits(const std::string& path) {
  return std::make_unique<FitsSource>(path);
}

}  // namespace glint
