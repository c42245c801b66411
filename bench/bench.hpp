// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "glint/bench/harness.hpp"

namespace glint::bench {

struct FrameSize {
  int width = 4096, height = 4096;  ///< [px]
  double pixels() const { return static_cast<double>(width) * height; }
  bool operator==(const FrameSize&) const = default;
};
/// The size that targets of frame-sized work hold for.
inline constexpr FrameSize kReferenceSize{4096, 4096};
/// Smallest width and height that the benchmarks' clouds of particles fit in.
inline constexpr int kMinSide = 256;

struct Options {
  FrameSize size = kReferenceSize;
  bool quick = false;                            ///< fewer samples, no growth over sizes
  std::optional<Device> egl = {};                ///< kernels, frames: measures this device instead
  std::function<void(const Result&)> done = {};  ///< called with each suite as it ends
};

/// Every kernel beside its limit, its serial reference and what others do the same with.
std::vector<Result> bench_kernels(const Options& options);
/// Trackers of points beside plain baselines, then every registered tracker on a built-in scene,
/// beside the serial device [scans/s].
std::vector<Result> bench_trackers(const Options& options);
Result bench_point_trackers(const Options& options);
/// The whole engine with smc-phd on frames in memory [frames/s], the share of each stage, and the
/// rate of its kernels alone; then mm-phd and pmht-imm on one stream beside each of them alone.
std::vector<Result> bench_frames(const Options& options);
Result bench_together(const Options& options);
/// smc-phd with 100 targets and 1e6 particles (2e4 if quick) on options.egl [frames/s]: the shares
/// of upload, kernels and read-back, and the bytes that travel. What bench_frames() is on egl.
Result bench_egl_frames(const Options& options);
/// H-PMHT: one target against full frames in double, the tracker with 100 targets, and what an
/// iteration costs by targets and pixels.
std::vector<Result> bench_h_pmht(const Options& options);

}  // namespace glint::bench
