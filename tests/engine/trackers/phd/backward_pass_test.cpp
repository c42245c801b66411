// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/backward_pass.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "engine/trackers/phd/few_particles.hpp"

namespace glint {
namespace {

using namespace test;

constexpr double kTraceRatio = 100;
/// A target that moves 2 px a frame to the right is detected in frame 6 and confirmed in the next.
/// The frames before show it in those of `visible`.
class Traced {
 public:
  explicit Traced(std::vector<int> visible) : visible_(std::move(visible)) {
    config_.target_particles = 4;
    config_.existence = 0.6;  // one miss leaves less of it, a hit after that more
    config_.confirm_hits = 2, config_.halt_misses = 2;
  }
  /// Another track, number 7, is at these places in that frame.
  void set_others(int frame, std::vector<Pixel> places) { others_[frame] = std::move(places); }

  /// The points before detection in the revised record, by frame.
  std::map<std::int64_t, TrackPoint> trace(int backward_frames = 6) {
    const TargetAppearance appearance = ready(exact_appearance(ratio));
    FollowedTargets targets(config_, exact_motion(), Device::serial(), 1);
    BackwardPass backward(config_, exact_motion(), backward_frames, Device::serial(), 1);
    targets.set_appearance(appearance), backward.set_appearance(appearance);
    TrackLog log;
    for (int k = 0; k < detected; ++k) {
      backward.remember(frame(k), at(k), others(k));
    }
    const Particles p =
        particles_of({{.x = static_cast<float>(place(detected).x),
                       .y = 12,
                       .vx = 2,
                       .intensity = static_cast<float>(intensity_of_ratio(ratio))}});
    const auto members = all_members(p);
    const Peak peak = describe_cluster(p, members, p.weight);
    targets.detect({peak, p, members}, at(detected), log);
    backward.remember(frame(detected), at(detected), {});
    targets.follow(frame(detected + 1), at(detected + 1), log);
    EXPECT_EQ(targets.confirmed_now().size(), 1U);
    const BackwardPass::Start start{targets.targets()[0].id, detected, detected + 1};
    if (from_cluster) {
      const Particles& now = targets.filters().particles();
      const auto all = all_members(now);
      backward.trace({targets.targets()[0].estimate, now, all}, start, log);
    } else {
      backward.trace(targets.filters(), 0, start, log);
    }
    std::map<std::int64_t, TrackPoint> before;
    for (const auto& point : log.revised()) {
      if (point.frame < detected) before[point.frame] = point;
    }
    EXPECT_EQ(log.online().front().frame, detected);
    return before;
  }

  int detected = 6;            ///< frame
  bool from_cluster = false;   ///< start from the particles as a cluster
  double ratio = kTraceRatio;  ///< L in the target's image

  static Pixel place(int k) { return {10 + 2 * k, 12}; }

 private:
  static StepTime at(int k) { return {k, k * 0.5, 1, 2}; }  // two frames a second
  Frame frame(int k) const {
    const bool visible = k >= detected || std::ranges::find(visible_, k) != visible_.end();
    return visible ? image_of(ratio, {place(k)}) : empty_frame();
  }
  std::vector<BackwardPass::Position> others(int k) const {
    std::vector<BackwardPass::Position> list;
    const auto there = others_.find(k);
    if (there == others_.end()) return list;
    for (const Pixel& p : there->second) {
      list.push_back({7, static_cast<double>(p.x), static_cast<double>(p.y)});
    }
    return list;
  }

  FollowedTargetsConfig config_;
  std::vector<int> visible_;
  std::map<int, std::vector<Pixel>> others_;
};

std::vector<std::int64_t> frames_of(const std::map<std::int64_t, TrackPoint>& points) {
  std::vector<std::int64_t> frames(points.size());
  std::ranges::transform(points, frames.begin(), [](const auto& point) { return point.first; });
  return frames;
}

using Frames = std::vector<std::int64_t>;

TEST(BackwardPass, FindsWhereTheTargetWasBeforeItsDetection) {
  const auto points = Traced({3, 4, 5}).trace();
  EXPECT_EQ(frames_of(points), (Frames{3, 4, 5}));
  for (const auto& [frame, point] : points) {
    EXPECT_EQ(point.track_id, 1);
    EXPECT_EQ(point.status, TrackStatus::confirmed);
    EXPECT_NEAR(point.x, Traced::place(static_cast<int>(frame)).x, 1e-3);
    EXPECT_NEAR(point.y, 12, 1e-3);
    EXPECT_NEAR(point.time, static_cast<double>(frame) * 0.5, 1e-12);
  }
}

TEST(BackwardPass, ReportsTheForwardVelocityInPixelsPerSecond) {
  for (const auto& [frame, point] : Traced({3, 4, 5}).trace()) {
    EXPECT_NEAR(point.vx, 4, 1e-3) << frame;  // 2 px/frame, two frames a second
    EXPECT_NEAR(point.vy, 0, 1e-3) << frame;
  }
}

// To have appeared in the frame of detection, or 1, 2, 3 frames before it, is as likely as
// 1 : e L : (e L)^2 : (e L)^2 e / L.
TEST(BackwardPass, GivesTheProbabilityThatTheTargetWasThereAlready) {
  const auto points = Traced({4, 5}).trace();
  const double seen = 0.99 * kTraceRatio, all = 1 + seen + seen * seen * (1 + 0.99 / kTraceRatio);
  EXPECT_EQ(frames_of(points), (Frames{4, 5}));
  EXPECT_NEAR(points.at(5).existence, 1 - 1 / all, 1e-6);
  EXPECT_NEAR(points.at(4).existence, 1 - (1 + seen) / all, 1e-6);
}

TEST(BackwardPass, ReportsAMissOnlyIfTheTargetIsSeenWellBeforeIt) {
  EXPECT_EQ(frames_of(Traced({2, 3, 5}).trace()), (Frames{2, 3, 4, 5}));
  EXPECT_EQ(frames_of(Traced({3, 5}).trace()), (Frames{5}));  // before frame 5 as likely as not
  EXPECT_EQ(frames_of(Traced({5}).trace()), (Frames{5}));
}

TEST(BackwardPass, EndsAtTheMissesInARowThatEndATrack) {
  EXPECT_EQ(frames_of(Traced({0, 1, 4, 5}).trace()), (Frames{4, 5}));
  EXPECT_EQ(frames_of(Traced({0, 1, 2, 4, 5}).trace()), (Frames{0, 1, 2, 3, 4, 5}));
}

TEST(BackwardPass, EndsBeforeItRunsOverAnotherTrack) {
  Traced near({2, 3, 4, 5}), far = near;
  const Pixel place = Traced::place(3);
  near.set_others(3, {{place.x, place.y + 5}});
  far.set_others(3, {{place.x, place.y + 6}});
  EXPECT_EQ(frames_of(near.trace()), (Frames{4, 5}));
  EXPECT_EQ(frames_of(far.trace()), (Frames{2, 3, 4, 5}));
}

// 1 : 3.96 : 15.7 : 3.9 : .96; the likeliest start is frame 4, but with .8 only.
TEST(BackwardPass, ReportsOnlyWhatIsSure) {
  Traced faint({4, 5});
  faint.ratio = 4;
  EXPECT_EQ(frames_of(faint.trace()), (Frames{5}));
}

TEST(BackwardPass, StartsFromAClusterAsFromATargetsFilter) {
  Traced traced({3, 4, 5});
  const auto from_filter = traced.trace();
  traced.from_cluster = true;
  const auto from_cluster = traced.trace();
  EXPECT_EQ(frames_of(from_cluster), (Frames{3, 4, 5}));
  for (const auto& [frame, point] : from_cluster) {
    EXPECT_NEAR(point.x, from_filter.at(frame).x, 1e-3);
    EXPECT_NEAR(point.existence, from_filter.at(frame).existence, 1e-6);
  }
}

// Twelve frames of e^70 each are beyond what a double holds.
TEST(BackwardPass, StatesProbabilitiesOfVeryBrightTargets) {
  Traced bright({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11});
  bright.detected = 12, bright.ratio = std::exp(70);
  const auto points = bright.trace(12);
  EXPECT_EQ(points.size(), 12U);
  for (const auto& [frame, point] : points) {
    EXPECT_TRUE(point.existence > 0.9 && point.existence <= 1) << frame << ' ' << point.existence;
  }
}

TEST(BackwardPass, OfNoFramesDoesNothing) { EXPECT_TRUE(Traced({3, 4, 5}).trace(0).empty()); }

TEST(BackwardPass, GoesBackThatManyFrames) {
  EXPECT_EQ(frames_of(Traced({0, 1, 2, 3, 4, 5}).trace(2)), (Frames{4, 5}));
}

}  // namespace
}  // namespace glint
