// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/auto_device.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace glint {
namespace {

/// A machine whose GPU, for which the serial device stands in, takes so long, and tbb a second.
AutoProbe with_gpu(double seconds) {
  return {[](int) {
            return HardwareFound{Device::serial(), ""};
          },
          [seconds](const Device& d) { return d.kind() == DeviceKind::tbb ? 1 : seconds; }};
}

DeviceKind chosen(const AutoChoice& choice) { return choice.device.kind(); }

TEST(AutoDevice, IsTheGpuWhereItWinsAndSaysBothTimes) {
  const AutoChoice choice = choose_device(2, with_gpu(.25));
  EXPECT_EQ(chosen(choice), DeviceKind::serial);
  EXPECT_NE(choice.why.find("takes 250.0 ms"), std::string::npos) << choice.why;
  EXPECT_NE(choice.why.find("tbb 1000.0 ms"), std::string::npos) << choice.why;
  EXPECT_FALSE(choice.failed);
}

TEST(AutoDevice, IsTbbWhereTheGpuDoesNotWinClearly) {
  for (const double seconds : {kAutoShare, 1., 7.}) {
    const AutoChoice choice = choose_device(2, with_gpu(seconds));
    EXPECT_EQ(chosen(choice), DeviceKind::tbb) << seconds;
    EXPECT_NE(choice.why.find("not enough to win"), std::string::npos) << choice.why;
    EXPECT_FALSE(choice.failed);
  }
}

TEST(AutoDevice, IsTbbWithItsThreadsWithoutAGpuAndTimesNothing) {
  AutoProbe probe;
  probe.hardware = [](int) { return HardwareFound{std::nullopt, "none here"}; };
  probe.seconds = [](const Device&) -> double { throw std::logic_error("was timed"); };
  const AutoChoice choice = choose_device(3, probe);
  EXPECT_EQ(chosen(choice), DeviceKind::tbb);
  EXPECT_EQ(choice.device.workers().threads(), Device::tbb(3).workers().threads());
  EXPECT_EQ(choice.why, "none here");
  EXPECT_FALSE(choice.failed);
}

TEST(AutoDevice, IsTbbWithTheReasonWhereTheGpuDoesNotOpen) {
  AutoProbe probe = with_gpu(.1);
  probe.hardware = [](int) -> HardwareFound { throw std::runtime_error("no OpenGL 4.3"); };
  const AutoChoice choice = choose_device(1, probe);
  EXPECT_EQ(chosen(choice), DeviceKind::tbb);
  EXPECT_TRUE(choice.failed);
  EXPECT_NE(choice.why.find("no OpenGL 4.3"), std::string::npos) << choice.why;
}

TEST(AutoDevice, IsTbbWithTheReasonWhereTheGpuFailsInTheCalibration) {
  AutoProbe probe = with_gpu(.1);
  probe.seconds = [](const Device&) -> double { throw std::runtime_error("does not compile"); };
  const AutoChoice choice = choose_device(1, probe);
  EXPECT_EQ(chosen(choice), DeviceKind::tbb);
  EXPECT_TRUE(choice.failed);
  EXPECT_NE(choice.why.find("does not compile"), std::string::npos) << choice.why;
}

TEST(AutoDevice, TimesTheKernelsOfADevice) { EXPECT_GT(this_machine().seconds(Device::tbb(1)), 0); }

}  // namespace
}  // namespace glint
