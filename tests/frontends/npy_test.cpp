// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/files/npy.hpp"

#include <cstring>

#include "folder.hpp"
#include "glint/frontends/files/open_source.hpp"

namespace glint {
namespace {

using test::Folder;
using test::has;
using test::message_of;

template <class T>
std::string npy(const std::string& type, const std::string& shape, const std::vector<T>& values,
                const std::string& fortran = "False") {
  std::string header =
      "{'descr': '" + type + "', 'fortran_order': " + fortran + ", 'shape': " + shape + ", }";
  header.resize(117, ' ');
  header += '\n';
  std::string file = "\x93NUMPY";
  file += '\x01', file += '\0', file += static_cast<char>(header.size()), file += '\0';
  file += header;
  return file +
         std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

std::unique_ptr<Source> open(const std::string& path) { return open_source(std::span(&path, 1)); }

TEST(Npy, SixteenBitsStaySixteenBits) {
  const Folder folder;
  const auto path =
      folder.write("c.npy", npy<std::uint16_t>("<u2", "(2, 1, 3)", {1, 2, 3, 40000, 50000, 65535}));
  const auto source = open(path);
  EXPECT_EQ(source->frame_count(), 2);
  source->next();
  const auto frame = source->next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->pixels.width, 3);
  EXPECT_EQ(frame->pixels.height, 1);
  EXPECT_EQ(std::get<const std::uint16_t*>(frame->pixels.data)[2], 65535);
  EXPECT_DOUBLE_EQ(frame->time, 1);
  EXPECT_FALSE(source->next());
}

TEST(Npy, DoublesBecomeFloats) {
  const Folder folder;
  const auto source =
      open(folder.write("c.npy", npy<double>("<f8", "(2, 2)", {0.5, -1.25, 3e5, 1.0 / 3})));
  const auto frame = source->next();
  const float* p = std::get<const float*>(frame->pixels.data);
  EXPECT_EQ(p[0], 0.5f);
  EXPECT_EQ(p[1], -1.25f);
  EXPECT_EQ(p[2], 3e5f);
  EXPECT_EQ(p[3], static_cast<float>(1.0 / 3));
}

TEST(Npy, WritesWhatItReads) {
  const Folder folder;
  Image<float> image(5, 3);
  {
    NpyWriter writer(folder / "c.npy");
    for (int f = 0; f < 3; ++f) {
      image.view()(4, 2) = static_cast<float>(f) + 0.5f;
      writer.write(image.view());
    }
  }
  const auto source = open(folder / "c.npy");
  EXPECT_EQ(source->frame_count(), 3);
  for (int f = 0; f < 3; ++f) {
    const auto frame = source->next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(std::get<const float*>(frame->pixels.data)[14], static_cast<float>(f) + 0.5f);
  }
}

TEST(Npy, WhatItCannotReadIsSaidWithARemedy) {
  const Folder folder;
  const auto refused = [&](const std::string& content) {
    return message_of<std::runtime_error>([&] { open(folder.write("c.npy", content)); });
  };
  EXPECT_TRUE(has(refused(npy<float>("<f4", "(2, 2, 2)", {1, 2, 3})), "truncated"));
  EXPECT_TRUE(has(refused(npy<float>("<c8", "(1, 1)", {1, 2})), "astype"));
  EXPECT_TRUE(has(refused(npy<float>(">f4", "(1, 1)", {1})), ">f4"));
  EXPECT_TRUE(has(refused(npy<float>("<f4", "(1, 1)", {1}, "True")), "ascontiguousarray"));
  EXPECT_TRUE(has(refused(npy<float>("<f4", "(1, 1, 1, 1)", {1})), "4 axes"));
  EXPECT_TRUE(has(refused("no such thing"), "numpy.save"));
  EXPECT_TRUE(has(refused(npy<float>("<f4", "(1, 1)", {}).substr(0, 40)), "header"));
  EXPECT_TRUE(has(refused(""), "c.npy"));
}

TEST(Npy, FramesOfAnotherSizeAreNamedWithBothSizes) {
  const Folder folder;
  const std::vector inputs{folder.write("a.npy", npy<float>("<f4", "(1, 2)", {1, 2})),
                           folder.write("b.npy", npy<float>("<f4", "(2, 1)", {1, 2}))};
  const auto source = open_source(inputs);
  source->next();
  const auto message = message_of<std::runtime_error>([&] { source->next(); });
  EXPECT_TRUE(has(message, "b.npy") && has(message, "1x2") && has(message, "2x1")) << message;
}

TEST(Npy, FrameRateCanBeGiven) {
  const Folder folder;
  const std::vector inputs{folder.write("a.npy", npy<float>("<f4", "(3, 1, 1)", {1, 2, 3}))};
  SourceOptions options;
  options.frame_rate = 50;
  const auto source = open_source(inputs, options);
  source->next();
  EXPECT_DOUBLE_EQ(source->next()->time, 0.02);
  EXPECT_DOUBLE_EQ(source->frame_rate(), 50);
}

}  // namespace
}  // namespace glint
