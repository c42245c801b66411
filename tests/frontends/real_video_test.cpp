// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <vector>

#include "cli.hpp"
#include "glint/engine/trackers/registry.hpp"
#include "glint/frontends/experiments/clip_run.hpp"
#include "glint/frontends/files/cropped_source.hpp"
#include "glint/frontends/files/open_source.hpp"

namespace glint {
namespace {

using test::expect_error;
using test::Folder;
using test::message_of;

constexpr int kClipWidth = 64, kClipHeight = 48, kClipFrames = 24;

double target_x(int frame) { return 10 + 1.5 * frame; }

/// One bright target on a slope of grey levels, and where it is.
ClipInput clip(const Folder& folder) {
  ClipInput input{folder / "clip.npy", {}};
  NpyWriter writer(input.frames);
  for (int t = 0; t < kClipFrames; ++t) {
    Image<float> image(kClipWidth, kClipHeight);
    for (int y = 0; y < kClipHeight; ++y) {
      for (int x = 0; x < kClipWidth; ++x) {
        const double dx = x - target_x(t), dy = y - 20;
        image.view()(x, y) = static_cast<float>(100 + x + 60 * std::exp(-(dx * dx + dy * dy) / 2));
      }
    }
    writer.write(image.view());
    input.truth.push_back({.frame = t, .track_id = 0, .x = target_x(t), .y = 20});
  }
  return input;
}

std::vector<ClipTracker> trackers() {
  std::vector<ClipTracker> list;
  for (const char* name : {"mm-phd", "h-pmht"}) list.push_back({name, find_tracker(name).config()});
  return list;
}

TEST(RealVideo, ABrightTargetIsFollowedByEveryTracker) {
  const Folder folder;
  ClipInput input = clip(folder);
  input.noise = 5;
  const auto scores = run_clip(input, {}, trackers(), 3);
  ASSERT_EQ(scores.size(), 2U);
  for (const ClipScore& score : scores) {
    EXPECT_EQ(score.online.ospa.size(), static_cast<std::size_t>(kClipFrames));
    EXPECT_GT(score.online.detected_points, 0.6);
    EXPECT_GE(score.revised.detected_points, score.online.detected_points);
    EXPECT_EQ(score.online.detected_truths, 1);
  }
}

TEST(RealVideo, TheBaselineIsThatOfTheSameFramesAtEqualFalsePoints) {
  const Folder folder;
  ClipInput input = clip(folder);
  input.noise = 30;  // a peak of 2 sigma
  for (const ClipScore& score : run_clip(input, {}, trackers(), 1)) {
    EXPECT_LE(score.baseline.false_points_per_frame, score.online.false_points_per_frame + 1e-12);
    EXPECT_GT(score.baseline.threshold, 2);
    EXPECT_LT(score.baseline.detected_points, 1);
  }
}

TEST(RealVideo, ARunIsAFunctionOfItsSeed) {
  const Folder folder;
  ClipInput input = clip(folder);
  input.noise = 30;
  const auto ospa = [&](std::uint64_t seed) {
    return run_clip(input, {}, trackers(), seed)[0].online.mean_ospa.distance;
  };
  const double first = ospa(1);
  EXPECT_EQ(ospa(1), first);
  EXPECT_NE(ospa(2), first);
}

TEST(RealVideo, NoiseAloneGivesNoTracks) {
  const auto tracks = tracks_in_noise({kClipWidth, kClipHeight, 40}, {}, trackers(), 1);
  EXPECT_EQ(tracks[0], 0);
}

TEST(RealVideo, SaysWhatItNeeds) {
  const Folder folder;
  expect_error(test::glint(folder, "experiment real-video"), 2, "--data");
  expect_error(test::glint(folder, "experiment real-video --data " + folder.path()), 2, "mp4");
  expect_error(test::glint(folder, "experiment nothing"), 2, "real-video");
}

TEST(CroppedSource, ShowsTheBoxAlone) {
  const Folder folder;
  const std::string path = clip(folder).frames;
  CroppedSource source(open_source(std::span(&path, 1)), {5, 40, 25, 48});
  const auto frame = source.next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->pixels.width, 20);
  EXPECT_EQ(frame->pixels.height, 8);
  const float* pixels = std::get<const float*>(frame->pixels.data);
  EXPECT_EQ(pixels[0], 105);
  EXPECT_EQ(pixels[7 * frame->pixels.pitch + 19], 124);
}

TEST(CroppedSource, RefusesABoxThatLeavesTheFrames) {
  const Folder folder;
  const std::string path = clip(folder).frames;
  CroppedSource source(open_source(std::span(&path, 1)), {50, 0, 70, 10});
  EXPECT_NE(message_of<std::runtime_error>([&] { source.next(); }).find("64x48"),
            std::string::npos);
}

}  // namespace
}  // namespace glint
