// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/cue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "glint/engine/engine.hpp"
#include "glint/engine/scenario/scenes.hpp"
#include "glint/engine/trackers/registry.hpp"

namespace glint {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(Cue, NumbersThatCannotBeAreRefused) {
  for (const Cue& good : {Cue{3, 4}, Cue{-3, 4, 1, -1}, Cue{3, 4, kNan, kNan, 0.1}}) {
    EXPECT_NO_THROW(checked(good));
  }
  for (const Cue& bad :
       {Cue{kNan, 4}, Cue{3, kInf}, Cue{3, 1e10}, Cue{3, 4, 1}, Cue{3, 4, kNan, 1},
        Cue{3, 4, kInf, 1}, Cue{3, 4, 1, 1, 0}, Cue{3, 4, 1, 1, -2}, Cue{3, 4, 1, 1, kInf}}) {
    EXPECT_THROW(checked(bad), std::invalid_argument)
        << bad.x << ' ' << bad.y << ' ' << bad.vx << ' ' << bad.vy << ' ' << bad.sigma;
  }
}

Scan scan_at(std::int64_t frame, double time, bool pixels) {
  Scan scan;
  scan.frame = frame, scan.time = time;
  if (pixels) scan.whitened = Frame(Image<float>(20, 10));
  return scan;
}

// 0.5 s at (4, -2) px/s.
TEST(TrackerCues, WaitMovedOnForAScanThatTheTrackerCanUse) {
  const std::vector<Cue> cues{{3, 4, 4, -2, 1}, {5, 6}, {30, 5}};
  TrackerCues of_frames;
  EXPECT_TRUE(of_frames.due({}, scan_at(0, 0, true), Feed::frames).empty());
  EXPECT_TRUE(of_frames.due(cues, scan_at(1, 1, false), Feed::frames).empty());
  const auto due = of_frames.due({}, scan_at(2, 1.5, true), Feed::frames);
  ASSERT_EQ(due.size(), 2u);  // the third is outside the frame
  EXPECT_EQ(due[0].x, 5);
  EXPECT_EQ(due[0].y, 3);
  EXPECT_EQ(due[0].vx, 4);
  EXPECT_EQ(due[0].sigma, 1);
  EXPECT_EQ(due[1].x, 5);
  EXPECT_TRUE(of_frames.due({}, scan_at(3, 2, true), Feed::frames).empty());

  TrackerCues of_points;  // the frame's size says nothing of points
  Scan blind = scan_at(1, 1, true);
  blind.looked = false;
  EXPECT_TRUE(of_points.due(cues, blind, Feed::points).empty());
  EXPECT_EQ(of_points.due({}, scan_at(2, 1.5, true), Feed::points).size(), 3u);
}

TEST(TrackerCues, TheFirstScanKnowsNoVelocity) {
  const std::vector<Cue> cue{{3, 4, 4, -2}};
  TrackerCues cues;
  EXPECT_FALSE(cues.due(cue, scan_at(0, 0, true), Feed::frames)[0].moves());
  EXPECT_TRUE(cues.due(cue, scan_at(1, 1, true), Feed::frames)[0].moves());
}

/// A target of 14 dB from frame `birth` on, 10 frames a second, and points of it.
class OneTarget {
 public:
  explicit OneTarget(int birth) : birth_(birth) {
    scene_.width = scene_.height = 48, scene_.frames = birth + 12, scene_.interval = 0.1;
    scene_.point_spread = PointSpread::of(1);
    ScriptedTarget target;
    target.birth = birth, target.death = scene_.frames;
    target.intensity = scene_.point_spread.intensity_of_snr(14);
    target.path = fly({20, 22, 10, -5});  // [px/s]
    scene_.targets = {target};
  }
  /// What the tracker says with two cues 1 px off in the target's first frame, and one frame later
  /// a cue upon the track.
  TrackLog follow(const TrackerEntry& entry, bool cued = true) const {
    FramesConfig frames;
    frames.background = BackgroundKind::none;
    const Device device = Device::tbb(1);
    Scheduler scheduler(device, FramePreparer(frames, device));
    ConfigSection section = entry.config();
    std::vector<ConfigSection> sections{section};
    if (entry.feed == Feed::frames && entry.name != "h-pmht") {
      apply_set("psf_sigma=1", sections);
    }
    scheduler.add(entry.make(sections[0], device, 1));
    Cued source(*this, cued);
    scheduler.run(source);
    return *scheduler.logs()[0];
  }
  TruthPoint truth(int frame) const { return truth_at(scene_, frame)[0]; }
  int frames() const { return scene_.frames; }

 private:
  struct Cued : Source {
    Cued(const OneTarget& of, bool with_cue) : one(of), cued(with_cue), scene(of.scene_, 3) {}
    std::optional<SourceFrame> next() override {
      auto frame = scene.next();
      if (!frame) return frame;
      frame->points.emplace();
      if (k >= one.birth_) {
        const TruthPoint t = one.truth(k);
        frame->points->push_back({t.x + 0.3, t.y - 0.2, 10});
        const bool first = k == one.birth_;
        if (cued && first) {
          frame->cues.push_back({t.x + 0.8, t.y - 0.6, t.vx, t.vy, 1});
          frame->cues.push_back({t.x + 0.6, t.y + 0.8});  // two have seen it
        }
        if (cued && k == one.birth_ + 1) frame->cues.push_back({t.x - 0.6, t.y + 0.8});
      }
      ++k;
      return frame;
    }
    const OneTarget& one;
    bool cued;
    SceneSource scene;
    int k = 0;
  };
  int birth_;
  Scene scene_;
};

class CueOf : public testing::TestWithParam<TrackerEntry> {
 protected:
  // To mmpf-pmht, whose particles are few, a point errs by 3 px.
  double reach() const { return GetParam().name == "mmpf-pmht" ? 4 : 2; }  // [px]
  // The paths of viterbi are told when its window is full, and may begin where noise leads to them.
  bool late() const { return GetParam().name == "viterbi"; }
};
INSTANTIATE_TEST_SUITE_P(Trackers, CueOf,
                         testing::ValuesIn(all_trackers().begin(), all_trackers().end()),
                         [](const auto& of) {
                           std::string name(of.param.name);
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

TEST_P(CueOf, OneConfirmedTrackFollowsTheTargetFromTheFrameOfTheCue) {
  for (const int birth : {0, 9}) {
    const OneTarget one(birth);
    const TrackLog log = one.follow(GetParam());
    std::vector<std::int64_t> ids;
    for (int k = birth; k < one.frames(); ++k) {
      std::vector<TrackPoint> points;
      for (const TrackPoint& p : late() ? log.revised() : log.online()) {
        if (p.frame == k && p.status == TrackStatus::confirmed) points.push_back(p);
      }
      ASSERT_EQ(points.size(), 1u) << "frame " << k << " of " << birth;
      const TruthPoint t = one.truth(k);
      EXPECT_LT(std::hypot(points[0].x - t.x, points[0].y - t.y), reach()) << k << " of " << birth;
      ids.push_back(points[0].track_id);
    }
    EXPECT_EQ(std::ranges::count(ids, ids[0]), std::ssize(ids)) << birth;
  }
}

// Trackers of points report the cue's variance in its frame: sigma is 1.
TEST_P(CueOf, TrackersOfPointsBeginWithItsVariance) {
  if (GetParam().feed == Feed::frames) return;
  const auto points = OneTarget(9).follow(GetParam()).at(9);
  ASSERT_EQ(points.size(), 1u);
  const double error = GetParam().name == "mmpf-pmht" ? 0.3 : 1e-9;  // of few particles
  EXPECT_NEAR(points[0].var_x, 1, error);
  EXPECT_NEAR(points[0].var_y, 1, error);
}

// But for the cue no tracker is as quick.
TEST_P(CueOf, WithoutItNoTrackIsConfirmedAtOnce) {
  if (late() || GetParam().name == "mm-pf") return;  // one tells the past, one declares at once
  for (const int birth : {0, 9}) {
    for (const TrackPoint& p : OneTarget(birth).follow(GetParam(), false).online()) {
      EXPECT_FALSE(p.frame == birth && p.status == TrackStatus::confirmed) << birth;
    }
  }
}

/// Everything but trackers of points alone.
constexpr const char* kSome =
    "mm-phd mm-pf smc-phd h-pmht viterbi imm-pda-ai imm-jpda imm-mscan-jpda pmht-imm mmpf-pmht";

std::string all_logs(const Engine& engine) {
  std::string text;
  for (const TrackLog* log : engine.scheduler().logs()) text += log->text();
  return text;
}

class CuedClip {
 public:
  static constexpr int kFrames = 16;
  CuedClip() {
    IrClipScene clip;
    clip.frames = kFrames;
    scene_ = make_scene(clip);
  }
  void push(Engine& engine, int from, int to) {
    for (int k = from; k < to; ++k) {
      if (k % 5 == 0) cue(engine, k);
      const Image<float> image = render(scene_, 2, k);
      const FrameView view = image.view();
      engine.push({view.data, view.width, view.height, 1, view.pitch}, 0.1 * k);
    }
  }
  void cue(Engine& engine, int k) const {
    const auto truth = truth_at(scene_, k);
    for (const TruthPoint& t : truth) engine.start(t.x + 1, t.y, t.vx, t.vy);
    engine.start(20 + k, 30);  // and where nothing is
  }

 private:
  Scene scene_;
};

TEST(EngineStart, LogsAreTheSameForAnyNumberOfThreads) {
  std::string first;
  for (const int threads : {1, 2, 3, 8}) {
    Engine engine(kSome, {{"threads", threads}, {"device", "tbb"}});
    CuedClip clip;
    clip.push(engine, 0, CuedClip::kFrames);
    engine.finish();
    if (first.empty()) first = all_logs(engine);
    EXPECT_EQ(all_logs(engine), first) << threads;
  }
}

TEST(EngineStart, ACheckpointHoldsTheCuesOfTheNextFrame) {
  const Settings settings{{"threads", 2}, {"device", "tbb"}};
  for (const int stop : {0, 6}) {  // before the first frame, and later
    Engine whole(kSome, settings), first(kSome, settings), second(kSome, settings);
    CuedClip clip;
    clip.push(whole, 0, stop);
    clip.push(first, 0, stop);
    clip.cue(whole, stop), clip.cue(first, stop);
    second.restore(first.checkpoint());
    clip.push(whole, stop, CuedClip::kFrames), clip.push(second, stop, CuedClip::kFrames);
    whole.finish(), second.finish();
    EXPECT_EQ(all_logs(second), all_logs(whole)) << stop;
  }
}

/// Keeps the cues that it is given, and stops at the first frame until it may go on.
struct CueKeeper : Tracker {
  CueKeeper(std::promise<void>& at_first, std::shared_future<void> may_go,
            std::map<std::int64_t, std::vector<Cue>>& kept)
      : reached(at_first), go(std::move(may_go)), cues(kept) {}
  Feed feed() const override { return Feed::frames; }
  void step(const Scan& scan, TrackLog& /*log*/) override {
    cues[scan.frame].assign(scan.cues.begin(), scan.cues.end());
    if (scan.frame == 0) reached.set_value(), go.wait();
  }
  std::promise<void>& reached;
  std::shared_future<void> go;
  std::map<std::int64_t, std::vector<Cue>>& cues;
};

TEST(EngineStart, TheNextFrameTakesTheCuesOfADroppedOneMovedOn) {
  std::promise<void> reached, go;
  std::map<std::int64_t, std::vector<Cue>> cues;
  const Device device = Device::serial();
  Scheduler scheduler(device, FramePreparer(FramesConfig{}, device));
  scheduler.add(std::make_unique<CueKeeper>(reached, go.get_future().share(), cues));
  EngineSettings settings;
  settings.queue = 1, settings.when_full = EngineSettings::WhenFull::drop_oldest;
  Engine engine(std::move(scheduler), std::move(settings));
  const std::vector<float> pixels(std::size_t{40 * 40});
  const auto push = [&](double time) { return engine.push({pixels.data(), 40, 40}, time); };
  push(0);
  reached.get_future().wait();
  engine.start(10, 20, 4, -2);
  push(1);
  engine.start(5, 5);
  EXPECT_FALSE(push(1.5));  // the second frame is lost
  go.set_value();
  engine.finish();
  EXPECT_TRUE(cues.at(0).empty());
  ASSERT_EQ(cues.at(2).size(), 2u);
  EXPECT_EQ(cues.at(2)[0].x, 12);
  EXPECT_EQ(cues.at(2)[0].y, 19);
  EXPECT_EQ(cues.at(2)[1].x, 5);
}

TEST(EngineStart, RefusesNumbersThatCannotBeAndCuesAfterTheEnd) {
  Engine engine("mm-phd");
  EXPECT_THROW(engine.start(kNan, 3), std::invalid_argument);
  EXPECT_THROW(engine.start(3, 3, 1), std::invalid_argument);
  EXPECT_THROW(engine.start(3, 3, 1, 1, 0), std::invalid_argument);
  engine.finish();
  EXPECT_THROW(engine.start(3, 3), std::logic_error);
}

}  // namespace
}  // namespace glint
