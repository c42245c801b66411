// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/core/resident_memory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "egl.hpp"
#include "glint/kernels/core/device_traffic.hpp"
#include "glint/kernels/core/gl_context.hpp"
#include "glint/kernels/core/gl_queue.hpp"
#include "glint/kernels/core/gl_residents.hpp"
#include "glint/kernels/find_points/find_points.hpp"
#include "glint/kernels/pixel_likelihood/pixel_likelihood.hpp"
#include "glint/kernels/prepare_frame/prepare_frame.hpp"

namespace glint {
namespace {

void count_up(std::span<float> values, float first) {
  std::iota(values.begin(), values.end(), first);
}

/// A device whose kept memory is spoilt on the host.
Device spoiling() {
  Device device = Device::egl();
  device.context().run([](gl::Queue& queue) { queue.set_keeping(gl::Queue::Keeping::spoiling); });
  return device;
}

TEST(ResidentMemory, IsTheHostsOwnOnOtherDevices) {
  const Device device = Device::tbb(1);
  ResidentArray<float> array(device);
  array.resize(3);
  count_up(array.values(), 1);
  array.send();
  array.fetch();
  EXPECT_EQ(array.values()[2], 3);
  device.fill(array.values(), 7);
  EXPECT_EQ(array.values()[0], 7);
}

TEST(EglKeptMemory, ComesBackAsItWasSentOrFilledInWholeAndInPart) {
  GLINT_NEEDS_EGL(unused);
  const Device device = spoiling();
  std::vector<float> values(1000);
  const Resident resident = device.make_resident(std::span(values));
  count_up(values, 0);
  device.send(std::span(values));
  device.fill(std::span(values).subspan(10, 5), -1);  // spoils the host's
  device.fetch(std::span(values).first(12));
  EXPECT_EQ(values[9], 9);
  EXPECT_EQ(values[10], -1);
  EXPECT_TRUE(values[12] != values[12]) << "fetched too much";
  device.fetch(std::span(values));
  EXPECT_EQ(values[14], -1);
  EXPECT_EQ(values[15], 15);
  EXPECT_EQ(values[999], 999);
}

TEST(EglKeptMemory, KeepsItsValuesAsItGrowsAndChangesPlaces) {
  GLINT_NEEDS_EGL(unused);
  const Device device = spoiling();
  ResidentArray<float> one(device), other(device);
  one.resize(10), other.resize(5);
  count_up(one.values(), 0), count_up(other.values(), 100);
  one.send(), other.send();
  one.resize(100000);
  std::swap(one, other);
  one.fetch(), other.fetch();
  EXPECT_EQ(one.size(), 5U);
  EXPECT_EQ(one.values()[4], 104);
  EXPECT_EQ(other.values()[9], 9);
}

TEST(EglKeptMemory, HoldsImagesWithoutTheirPadding) {
  GLINT_NEEDS_EGL(unused);
  const Device device = spoiling();
  Image<std::uint8_t> image(37, 9);
  ResidentImage<std::uint8_t> resident(37, 9, device);
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 37; ++x) image.view()(x, y) = static_cast<std::uint8_t>(37 * y + x);
  }
  device.copy<std::uint8_t>(image.view(), resident.view());
  device.fetch(ImageView<std::uint8_t>(resident.view()));
  for (int y = 0; y < 9; ++y) {
    EXPECT_TRUE(
        std::equal(resident.view().row(y), resident.view().row(y) + 37, image.view().row(y)));
  }
  EXPECT_EQ(resident.view().row(0)[37], 0) << "the margin is to stay";
}

TEST(EglKeptMemory, SavesTheTransfersBetweenKernels) {
  GLINT_NEEDS_EGL(unused);
  const Device device = spoiling();
  ResidentImage<float> frame(64, 48, device), map(64, 48, device);
  for (int y = 0; y < 48; ++y) std::fill_n(frame.view().row(y), 64, 0.0F);
  frame.view()(20, 30) = 9;
  device.send(frame.view());
  time_traffic(device, true);
  device.run<PixelLikelihood>({.frame = FrameView(frame.view()),
                               .spread = PointSpread::of(1),
                               .intensity = 5,
                               .map = map.view()});
  std::vector<Point> points;
  device.run<FindPoints>({.map = map.view(), .threshold = 1, .radius = 3, .points = &points});
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points[0].x, 20);
  EXPECT_EQ(points[0].y, 30);
  const DeviceTraffic traffic = traffic_of(device);
  constexpr std::size_t kImage = 64 * 48 * sizeof(float);
  EXPECT_LT(traffic.uploaded, kImage / 4) << "parameters and counts alone";
  EXPECT_LT(traffic.read, kImage / 4);
}

TEST(EglKeptMemory, MayNotBeKeptTwiceOrUsedInAnotherShape) {
  GLINT_NEEDS_EGL(unused);
  const Device device = Device::egl();
  ResidentImage<float> image(20, 10, device);
  const ImageView<float> all = image.view();
  EXPECT_THROW(device.make_resident(all), std::logic_error);
  const ImageView<float> left{all.data, 7, 10, all.pitch};
  EXPECT_THROW(device.fetch(left), std::logic_error);
  const ImageView<float> rows{all.row(3), 20, 4, all.pitch};
  EXPECT_NO_THROW(device.fetch(rows));
}

/// A raw frame of 8 bits and what it becomes.
struct RawFrame {
  std::vector<std::uint8_t> bytes = std::vector<std::uint8_t>(std::size_t{64} * 48);
  Image<float> grey{64, 48};

  std::span<std::uint8_t> all() { return bytes; }
  float converted(const Device& device) {
    const RawPixels raw{bytes.data(), 64, 48, 1, 64};
    device.run<ToGrey>({.raw = raw, .grey = grey.view()});
    return grey.view()(5, 7);
  }
};

TEST(EglStaging, SendsAFrameOnceForAllThatLookAtIt) {
  GLINT_NEEDS_EGL(unused);
  const Device device = spoiling();
  RawFrame frame;
  frame.bytes[7 * 64 + 5] = 99;
  time_traffic(device, true);
  {
    const Resident sent = device.stage(frame.all());
    EXPECT_EQ(frame.converted(device), 99);
    EXPECT_EQ(frame.converted(device), 99);
    EXPECT_EQ(frame.bytes[7 * 64 + 5], 99) << "the host's bytes stay good";
  }
  const std::size_t sent = traffic_of(device).uploaded;
  EXPECT_GE(sent, frame.bytes.size());
  EXPECT_LT(sent, frame.bytes.size() * 3 / 2);
}

TEST(EglStaging, SendsWhatTheMemoryHoldsEachTimeAnew) {
  GLINT_NEEDS_EGL(unused);
  const Device device = Device::egl();
  RawFrame frame;
  for (int i = 0; i < 10; ++i) {  // more than there are slots
    std::ranges::fill(frame.bytes, static_cast<std::uint8_t>(i));
    const Resident sent = device.stage(frame.all());
    EXPECT_EQ(frame.converted(device), static_cast<float>(i));
  }
  std::ranges::fill(frame.bytes, std::uint8_t{77});
  EXPECT_EQ(frame.converted(device), 77) << "nothing is left of what was sent ahead";
}

TEST(EglStaging, LetsTwoSendTheSameMemory) {
  GLINT_NEEDS_EGL(unused);
  const Device device = Device::egl();
  RawFrame frame;
  frame.bytes[7 * 64 + 5] = 12;
  Resident one = device.stage(frame.all());
  const Resident other = device.stage(frame.all());
  EXPECT_EQ(frame.converted(device), 12);
  one = {};
  EXPECT_EQ(frame.converted(device), 12);
}

TEST(EglStaging, LetsOthersSendPartsOfTheSameMemory) {
  GLINT_NEEDS_EGL(unused);
  const Device device = Device::egl();
  RawFrame frame;
  frame.bytes[20 * 64 + 30] = 5;
  const Resident all = device.stage(frame.all());
  const ImageView<std::uint8_t> crop{&frame.bytes[20 * 64 + 30], 16, 8, 64};
  const Resident part = device.stage(crop);
  Image<float> grey(16, 8);
  device.run<ToGrey>({.raw = {crop.data, 16, 8, 1, 64}, .grey = grey.view()});
  EXPECT_EQ(grey.view()(0, 0), 5);
}

TEST(Residents, FindRowsAndPartsOfArraysByAddress) {
  std::vector<float> array(100);
  Image<float> image(20, 10);
  gl::Residents residents;
  EXPECT_TRUE(residents.add(region_of(std::span(array)), gl::Residents::Home::only, 1, 400));
  EXPECT_TRUE(residents.add(region_of(image.view()), gl::Residents::Home::only, 2, 800));
  EXPECT_FALSE(
      residents.add(region_of(std::span(array).subspan(5)), gl::Residents::Home::copy, 3, 9));
  const auto in_array = residents.find(region_of(std::span(array).subspan(25, 10)));
  ASSERT_TRUE(in_array);
  EXPECT_EQ(in_array->id, 1U);
  EXPECT_EQ(in_array->offset, 100U);
  const ImageView<float> all = image.view();
  const auto in_image = residents.find(region_of(ImageView<float>{all.row(3), 20, 2, all.pitch}));
  ASSERT_TRUE(in_image);
  EXPECT_EQ(in_image->offset, 3 * 20 * sizeof(float));
  std::vector<float> elsewhere(3);
  EXPECT_FALSE(residents.find(region_of(std::span(elsewhere))));
  EXPECT_FALSE(residents.find(region_of(std::span(array).first(0))));
  EXPECT_TRUE(residents.remove(region_of(std::span(array)).data));
  EXPECT_FALSE(residents.find(region_of(std::span(array))));
  EXPECT_FALSE(residents.remove(region_of(std::span(array)).data));
}

}  // namespace
}  // namespace glint
