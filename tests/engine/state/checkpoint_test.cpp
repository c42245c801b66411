// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/state/checkpoint.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <optional>
#include <thread>

#include "checkpoint_clip.hpp"
#include "egl.hpp"
#include "glint/engine/engine.hpp"
#include "glint/engine/state/fields.hpp"
#include "glint/experiments/log_parity.hpp"

namespace glint::test {
namespace {

struct OneFrame : Source {
  explicit OneFrame(SourceFrame f) : frame(std::move(f)) {}
  std::optional<SourceFrame> next() override { return std::exchange(frame, std::nullopt); }
  std::optional<SourceFrame> frame;
};

void track(Scheduler& scheduler, SourceFrame frame) {
  OneFrame source(std::move(frame));
  scheduler.advance(source);
}

FramesConfig background(BackgroundKind kind) {
  FramesConfig frames;
  frames.background = kind;
  frames.background_frames = 12, frames.background_stride = 2, frames.registered_frames = 5;
  return frames;
}

std::vector<CheckpointCase> cases() {
  std::vector<CheckpointCase> all;
  for (const TrackerEntry& t : all_trackers()) {
    const std::string name(t.name);
    if (t.feed != Feed::points)
      all.push_back({name, {}, background(BackgroundKind::temporal), false, true});
    if (t.feed != Feed::frames) all.push_back({name, {}, background(BackgroundKind::none), true});
  }
  all.push_back({"smc-phd", {{"psf_sigma", "auto"}}, background(BackgroundKind::registered)});
  all.push_back({"smc-phd",
                 {{"birth", "matched-filter"}, {"states", "kmeans"}},
                 background(BackgroundKind::none)});
  all.push_back({"mm-phd", {{"psf_sigma", "auto"}}, background(BackgroundKind::spatial)});
  all.push_back({"imm-jpda", {}, background(BackgroundKind::temporal)});
  all.push_back({"imm-jpda",
                 {{"window", "3"}, {"reading", "restart"}},
                 background(BackgroundKind::none),
                 true});
  all.push_back({"imm-jpda",
                 {{"window", "3"},
                  {"motion", "ncv+wpa"},
                  {"measurement", "range-azimuth"},
                  {"range_sd", "1"},
                  {"azimuth_sd", "0.01"}},
                 background(BackgroundKind::none),
                 true});
  all.push_back({"imm-pda-ai", {{"points", "units"}}, background(BackgroundKind::temporal)});
  all.push_back({"h-pmht", {{"intensity", "rpim"}}, background(BackgroundKind::temporal)});
  return all;
}

class Checkpoint : public testing::TestWithParam<CheckpointCase> {
 protected:
  tbb::global_control two_{tbb::global_control::max_allowed_parallelism, 2};
  Scene scene_ = checkpoint_scene();
};
INSTANTIATE_TEST_SUITE_P(Trackers, Checkpoint, testing::ValuesIn(cases()));

// After every frame, from before the first to after the last, into a fresh scheduler, on one
// thread and on two in turn.
TEST_P(Checkpoint, GoesOnWithTheSameBytes) {
  const CheckpointCase& c = GetParam();
  const Device one = Device::tbb(1), two = Device::tbb(2);
  Scheduler whole = checkpoint_scheduler(c, two);
  std::string bytes = checkpoint_scheduler(c, one).checkpoint();
  for (int f = 0; f <= scene_.frames; ++f) {
    Scheduler next = checkpoint_scheduler(c, f % 2 == 0 ? one : two);
    next.restore(bytes);
    EXPECT_TRUE(next.checkpoint() == bytes) << "before frame " << f;
    if (f == scene_.frames) {
      next.finish(), whole.finish();
      EXPECT_EQ(first_other_line(next.logs()[0]->text(), whole.logs()[0]->text()), 0u);
      EXPECT_GT(whole.logs()[0]->revised().size(), 30u);
      EXPECT_EQ(next.tracker(0).notes(), whole.tracker(0).notes());
      EXPECT_EQ(next.preparer().notes(), whole.preparer().notes());
      EXPECT_EQ(next.frames(), scene_.frames);
      return;
    }
    track(next, checkpoint_frame(c, scene_, f));
    track(whole, checkpoint_frame(c, scene_, f));
    ASSERT_EQ(next.logs()[0]->at(f).size(), whole.logs()[0]->at(f).size()) << "frame " << f;
    bytes = next.checkpoint();
  }
}

// What lives on the device is fetched to be saved, and sent when it was read.
TEST(EglCheckpoint, GoesOnWithTheSameBytes) {
  GLINT_NEEDS_EGL(device);
  const Scene scene = checkpoint_scene();
  const std::vector<CheckpointCase> some{{"smc-phd", {}, background(BackgroundKind::temporal)},
                                         {"viterbi",
                                          {{"window", "4"}, {"common_frames", "2"}},
                                          background(BackgroundKind::registered)},
                                         {"mm-pf", {}, background(BackgroundKind::spatial)}};
  for (const CheckpointCase& c : some) {
    Scheduler whole = checkpoint_scheduler(c, device);
    int f = 0;
    for (; f < 9; ++f) track(whole, checkpoint_frame(c, scene, f));
    const std::string bytes = whole.checkpoint();
    Scheduler next = checkpoint_scheduler(c, device);
    next.restore(bytes);
    EXPECT_TRUE(next.checkpoint() == bytes) << c.tracker;
    for (; f < 14; ++f) {
      track(whole, checkpoint_frame(c, scene, f)), track(next, checkpoint_frame(c, scene, f));
    }
    EXPECT_EQ(next.logs()[0]->text(), whole.logs()[0]->text()) << c.tracker;
    EXPECT_FALSE(whole.logs()[0]->revised().empty()) << c.tracker;
    EXPECT_TRUE(next.checkpoint() == whole.checkpoint()) << c.tracker;
  }
}

std::string checkpoint_at(const CheckpointCase& c, const Scene& scene, int frames) {
  Scheduler scheduler = checkpoint_scheduler(c, Device::tbb(1));
  for (int f = 0; f < frames; ++f) track(scheduler, checkpoint_frame(c, scene, f));
  return scheduler.checkpoint();
}

/// What a fresh scheduler of the case says to the bytes; empty if it takes them.
std::string refusal(const CheckpointCase& c, std::string_view bytes,
                    const Device& device = Device::tbb(1)) {
  Scheduler fresh = checkpoint_scheduler(c, device);
  try {
    fresh.restore(bytes);
  } catch (const CheckpointError& e) {
    return e.what();
  }
  return "";
}

std::string resealed(const CheckpointLabel& label, std::string_view state) {
  ByteWriter to = begin_checkpoint(label);
  to.raw(state.data(), state.size());
  return seal_checkpoint(std::move(to));
}

TEST_P(Checkpoint, RefusesBytesThatEndEarlyWhateverTheirChecksum) {
  const std::string bytes = checkpoint_at(GetParam(), scene_, 9);
  const OpenCheckpoint open = open_checkpoint(bytes);
  const std::size_t size = open.state.left();
  const std::string state = bytes.substr(bytes.size() - size);
  EXPECT_EQ(refusal(GetParam(), resealed(open.label, state)), "");
  for (std::size_t i = 0; i < 12; ++i) {
    const std::string part = state.substr(0, size * i / 12);
    EXPECT_NE(refusal(GetParam(), resealed(open.label, part)).find("damaged"), std::string::npos)
        << part.size() << " of " << size;
  }
  EXPECT_NE(refusal(GetParam(), resealed(open.label, state + '\0')), "");
}

// Places all over the state, one at a time: refused, or taken for a true value, which may give
// nonsense. The sanitizers see whether memory is then used that must not be.
TEST_P(Checkpoint, AWrongByteIsRefusedOrTaken) {
  const std::string bytes = checkpoint_at(GetParam(), scene_, 9);
  const OpenCheckpoint open = open_checkpoint(bytes);
  const std::string state = bytes.substr(bytes.size() - open.state.left());
  constexpr std::size_t kPlaces = 41;
  int refused = 0;
  for (std::size_t i = 0; i < kPlaces; ++i) {
    const std::size_t at = i < kPlaces / 2 ? 7 + 8 * i : state.size() * i / kPlaces;
    std::string wrong = state;
    wrong[std::min(at, state.size() - 1)] ^= '\x83';
    Scheduler next = checkpoint_scheduler(GetParam(), Device::tbb(1));
    try {
      next.restore(resealed(open.label, wrong));
    } catch (const CheckpointError&) {
      ++refused;
      EXPECT_THROW(track(next, checkpoint_frame(GetParam(), scene_, 9)), std::logic_error);
      continue;
    }
    try {
      for (int f = 9; f < 12; ++f) track(next, checkpoint_frame(GetParam(), scene_, f));
    } catch (const std::exception& e) {
      EXPECT_NE(std::string(e.what()), "");
    }
  }
  EXPECT_GT(refused, 0);
  EXPECT_LT(refused, static_cast<int>(kPlaces));
}

struct CheckpointLabels : testing::Test {
  CheckpointCase c{"smc-phd", {{"existence", "0.4"}}};
  std::string bytes = checkpoint_at(c, checkpoint_scene(), 2);
  void expect(const std::string& said, const std::string& part) {
    EXPECT_NE(said.find(part), std::string::npos) << said;
  }
};

TEST_F(CheckpointLabels, SayWhatDiffers) {
  expect(refusal({"mm-phd"}, bytes), "trackers was smc-phd, and is mm-phd here");
  expect(refusal({"smc-phd", {{"existence", "0.6"}}}, bytes),
         "\"existence = 0.4\" then and \"existence = 0.6\" now, in [trackers.smc-phd]");
  expect(refusal(c, bytes, Device::serial()), "device was tbb, and is serial here");
  OpenCheckpoint open = open_checkpoint(bytes);
  EXPECT_EQ(open.label.frame, 2);
  open.label.version = "0.0.9";
  expect(refusal(c, resealed(open.label, "")), "version was 0.0.9, and is ");
}

TEST_F(CheckpointLabels, DamageIsSeen) {
  expect(refusal(c, ""), "no checkpoint");
  expect(refusal(c, "GLINTCKP"), "no checkpoint");
  expect(refusal(c, bytes.substr(0, bytes.size() - 1)), "checksum");
  for (const std::size_t at : {20ul, bytes.size() / 2, bytes.size() - 1}) {
    std::string flipped = bytes;
    flipped[at] ^= 4;
    expect(refusal(c, flipped), "checksum");
  }
  std::string newer = bytes;
  newer[8] = 9;
  expect(refusal(c, newer), "format 9");
}

TEST_F(CheckpointLabels, OnlyBetweenTheFirstFrameAndTheEnd) {
  Scheduler scheduler = checkpoint_scheduler(c, Device::tbb(1));
  track(scheduler, checkpoint_frame(c, checkpoint_scene(), 0));
  EXPECT_THROW(scheduler.restore(bytes), std::logic_error);
  scheduler.finish();
  EXPECT_THROW(scheduler.checkpoint(), std::logic_error);
}

std::vector<std::string> results_of(Engine& engine) {
  std::vector<std::string> texts;
  while (auto result = engine.poll()) {
    result->latency = 0;
    ByteWriter to;
    put_bytes(to, *result);
    texts.push_back(to.bytes());
  }
  return texts;
}

// Results that nobody asked for before the checkpoint come after it.
TEST_F(CheckpointLabels, AnEngineGoesOnWithItsCountsAndWaitingResults) {
  const Scene scene = checkpoint_scene();
  Engine whole(checkpoint_scheduler(c, Device::tbb(2)));
  Engine first(checkpoint_scheduler(c, Device::tbb(2)));
  for (int f = 0; f < 12; ++f) {
    whole.push(checkpoint_frame(c, scene, f)), first.push(checkpoint_frame(c, scene, f));
  }
  const auto held = [&](Engine& engine) {
    engine.drain();
    std::int64_t next = -1;
    const auto look = [&](const EngineResult& result) { return next = result.frame, false; };
    EXPECT_FALSE(engine.poll({}, look));
    EXPECT_EQ(next, 0);
  };
  held(first);
  Engine second(checkpoint_scheduler(c, Device::tbb(1)));
  second.restore(first.checkpoint());
  EXPECT_EQ(second.pushed(), 12);
  for (int f = 12; f < scene.frames; ++f) {
    whole.push(checkpoint_frame(c, scene, f)), second.push(checkpoint_frame(c, scene, f));
  }
  whole.finish(), second.finish();
  EXPECT_EQ(results_of(second), results_of(whole));
  EXPECT_EQ(second.scheduler().logs()[0]->text(), whole.scheduler().logs()[0]->text());
  EXPECT_THROW(second.checkpoint(), std::logic_error);
  EXPECT_THROW(first.restore(bytes), std::logic_error);
  Engine third(checkpoint_scheduler(c, Device::tbb(1)));
  EXPECT_THROW(third.restore(bytes), CheckpointError);  // of a Scheduler
}

// Each checkpoint is of some number of whole frames.
TEST_F(CheckpointLabels, FramesMayBePushedMeanwhile) {
  const Scene scene = checkpoint_scene();
  Engine whole(checkpoint_scheduler(c, Device::tbb(2)));
  std::vector<std::string> taken;
  std::thread pusher([&] {
    for (int f = 0; f < scene.frames; ++f) whole.push(checkpoint_frame(c, scene, f));
  });
  for (int some = 1; some <= 5; ++some) {
    while (whole.pushed() < scene.frames * some / 6) std::this_thread::yield();
    taken.push_back(whole.checkpoint());
  }
  pusher.join();
  whole.finish();
  for (const std::string& some : taken) {
    Engine next(checkpoint_scheduler(c, Device::tbb(1)));
    next.restore(some);
    for (auto f = static_cast<int>(next.pushed()); f < scene.frames; ++f) {
      next.push(checkpoint_frame(c, scene, f));
    }
    next.finish();
    ASSERT_EQ(next.scheduler().logs()[0]->text(), whole.scheduler().logs()[0]->text());
  }
}

// The order of its trackers is part of it, and frames that both hold are one.
TEST_F(CheckpointLabels, TwoTrackersGoOnTogether) {
  const Scene scene = checkpoint_scene();
  const CheckpointCase clip{"h-pmht", {}, background(BackgroundKind::registered)};
  const auto both = [&](const Device& device) {
    Scheduler scheduler = checkpoint_scheduler(clip, device);
    const TrackerEntry& entry = find_tracker("viterbi");
    scheduler.add(entry.make(entry.config(), device, 3), "viterbi");
    return scheduler;
  };
  Scheduler whole = both(Device::tbb(2));
  for (int f = 0; f < 9; ++f) track(whole, checkpoint_frame(clip, scene, f));
  Scheduler next = both(Device::tbb(1));
  const std::string at_nine = whole.checkpoint();
  next.restore(at_nine);
  next.restore(at_nine);  // instead of the first
  for (int f = 9; f < scene.frames; ++f) {
    track(whole, checkpoint_frame(clip, scene, f)), track(next, checkpoint_frame(clip, scene, f));
  }
  whole.finish(), next.finish();
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(next.logs()[i]->text(), whole.logs()[i]->text()) << i;
    EXPECT_FALSE(whole.logs()[i]->revised().empty()) << i;
  }
}

// Half a state is no use.
TEST_F(CheckpointLabels, AFailedRestoreEndsItsEngineAndScheduler) {
  const Scene scene = checkpoint_scene();
  Engine made(checkpoint_scheduler(c, Device::tbb(1)));
  made.push(checkpoint_frame(c, scene, 0));
  const std::string whole = made.checkpoint();
  const OpenCheckpoint open = open_checkpoint(whole);
  const std::string state = whole.substr(whole.size() - open.state.left());
  const std::string cut = resealed(open.label, state.substr(0, state.size() - 1));
  Engine engine(checkpoint_scheduler(c, Device::tbb(1)));
  EXPECT_THROW(engine.restore(cut), CheckpointError);
  EXPECT_EQ(engine.pushed(), 0);
  EXPECT_THROW(engine.drain(), CheckpointError);
  EXPECT_THROW(engine.restore(whole), CheckpointError);
  EXPECT_THROW(engine.push(checkpoint_frame(c, scene, 1)), CheckpointError);
  EXPECT_THROW(engine.finish(), CheckpointError);

  const OpenCheckpoint pulled = open_checkpoint(bytes);
  const std::string longer = bytes.substr(bytes.size() - pulled.state.left()) + '\0';
  for (const std::string& wrong : {std::string(), longer}) {
    Scheduler scheduler = checkpoint_scheduler(c, Device::tbb(1));
    EXPECT_THROW(scheduler.restore(resealed(pulled.label, wrong)), CheckpointError);
    EXPECT_THROW(track(scheduler, checkpoint_frame(c, scene, 0)), std::logic_error);
  }
}

}  // namespace
}  // namespace glint::test
