// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/parity.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "egl.hpp"
#include "glint/kernels/all.hpp"

namespace glint {
namespace {

/// Lets eight threads run on machines with fewer cores.
struct EightThreads {
  tbb::global_control control{tbb::global_control::max_allowed_parallelism, 8};
};

std::string test_name(const testing::TestParamInfo<KernelEntry>& info) {
  return std::string(info.param.name);
}

class Parity : public testing::TestWithParam<KernelEntry> {
 protected:
  EightThreads eight_;
};

TEST_P(Parity, TbbIsInsideTheToleranceOfSerialWithTheSameBitsForAnyThreadsAndIsa) {
  const std::vector<Device> devices = parity_devices(Device::tbb());
  const std::vector<ParityRow> rows = check_parity(GetParam(), devices);
  EXPECT_FALSE(rows.empty());
  for (const ParityRow& row : rows) EXPECT_TRUE(row.ok()) << description(row);
}

/// Kernels that an egl device runs itself.
std::vector<KernelEntry> egl_kernels() {
  std::vector<KernelEntry> list;
  std::ranges::copy_if(all_kernels(), std::back_inserter(list), &KernelEntry::on_egl);
  return list;
}

class EglParity : public testing::TestWithParam<KernelEntry> {};

TEST_P(EglParity, IsInsideTheToleranceOfSerialWithTheSameBitsInEveryRunAndInSmallBuffers) {
  GLINT_NEEDS_EGL(device);
  const std::vector<Device> devices = parity_devices(device);
  const std::vector<ParityRow> rows = check_parity(GetParam(), devices);
  EXPECT_FALSE(rows.empty());
  for (const ParityRow& row : rows) EXPECT_TRUE(row.ok()) << description(row);
}

INSTANTIATE_TEST_SUITE_P(Kernels, EglParity, testing::ValuesIn(egl_kernels()), test_name);

INSTANTIATE_TEST_SUITE_P(Kernels, Parity,
                         testing::ValuesIn(all_kernels().begin(), all_kernels().end()), test_name);

TEST(ParityDevices, CoverOneTwoThreeAndEightThreadsOnEveryIsa) {
  const std::vector<Device> devices = parity_devices(Device::tbb());
  ASSERT_EQ(devices.size(), 4 * runnable_isas().size());
  for (std::size_t i = 0; i < devices.size(); ++i) {
    constexpr int kThreads[] = {1, 2, 3, 8};
    EXPECT_EQ(devices[i].kind(), DeviceKind::tbb);
    EXPECT_EQ(devices[i].workers().threads(), kThreads[i % 4]);
    EXPECT_EQ(devices[i].workers().isa(), runnable_isas()[i / 4]);
  }
}

/// What a wrong kernel could give: a value that depends on where it runs.
enum class Fault { none, tolerance, threads, isa, signed_zero, length, nan };

template <Fault fault>
class FaultyTrial : public Trial {
 public:
  std::string description() const override { return "faulty"; }
  void run(const Device& device) override {
    const bool is_tbb = device.kind() == DeviceKind::tbb;
    values_ = {1, 0, 3};
    if (fault == Fault::tolerance && is_tbb) values_[2] += 0.02;
    if (fault == Fault::threads && device.workers().threads() == 3) values_[2] += 1e-9;
    if (fault == Fault::isa && device.workers().isa() != Isa::plain) values_[2] += 1e-9;
    if (fault == Fault::signed_zero && device.workers().threads() == 8) values_[1] = -0.0;
    if (fault == Fault::length && is_tbb) values_.pop_back();
    if (fault == Fault::nan && is_tbb) values_[2] = std::numeric_limits<double>::quiet_NaN();
  }
  std::vector<Output> outputs() const override { return {{"value", {0.01, 0}, values_}}; }

 private:
  std::vector<double> values_;
};

template <Fault fault>
std::vector<ParityRow> failures() {
  std::vector<std::unique_ptr<Trial>> trials;
  trials.push_back(std::make_unique<FaultyTrial<fault>>());
  const std::vector<Device> devices = parity_devices(Device::tbb());
  std::vector<ParityRow> rows = check_parity("fake", trials, devices);
  EXPECT_EQ(rows.size(), devices.size());
  std::erase_if(rows, [](const ParityRow& row) { return row.ok(); });
  return rows;
}

TEST(ParityCheck, PassesARightKernel) { EXPECT_TRUE(failures<Fault::none>().empty()); }

TEST(ParityCheck, FailsOutsideTheToleranceAndNamesTheIndex) {
  const auto rows = failures<Fault::tolerance>();
  ASSERT_EQ(rows.size(), parity_devices(Device::tbb()).size());
  ASSERT_TRUE(rows.front().outside);
  EXPECT_EQ(rows.front().outside->index, 2u);
  EXPECT_NEAR(rows.front().worst, 2, 1e-9);
  EXPECT_NE(description(rows.front()).find("value[2]: want 3, got 3.02"), std::string::npos);
}

TEST(ParityCheck, FailsIfTheBitsDependOnTheThreads) {
  const auto rows = failures<Fault::threads>();
  ASSERT_EQ(rows.size(), runnable_isas().size());
  EXPECT_FALSE(rows.front().outside);
  ASSERT_TRUE(rows.front().other_bits);
  EXPECT_EQ(rows.front().other_bits->index, 2u);
  EXPECT_NE(description(rows.front()).find("3 threads"), std::string::npos);
}

TEST(ParityCheck, FailsIfTheBitsDependOnTheInstructionSet) {
  EXPECT_EQ(failures<Fault::isa>().size(), 4 * (runnable_isas().size() - 1));
}

TEST(ParityCheck, TellsMinusZeroFromZero) {
  EXPECT_EQ(failures<Fault::signed_zero>().size(), runnable_isas().size());
}

TEST(ParityCheck, FailsForAnotherLengthAndForNan) {
  EXPECT_EQ(failures<Fault::length>().size(), parity_devices(Device::tbb()).size());
  EXPECT_EQ(failures<Fault::nan>().size(), parity_devices(Device::tbb()).size());
}

}  // namespace
}  // namespace glint
