// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/engine.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "scheduler_fakes.hpp"

namespace glint::test {
namespace {

using namespace std::chrono_literals;
using WhenFull = EngineSettings::WhenFull;

constexpr int kWidth = 16, kHeight = 12;

struct Picture {
  explicit Picture(std::int64_t frame, std::ptrdiff_t pitch = kWidth)
      : pixels(static_cast<std::size_t>(pitch * kHeight), 1000.f) {
    for (int i = 0; i < kWidth * kHeight; ++i) {
      pixels[static_cast<std::size_t>(i / kWidth * pitch + i % kWidth)] =
          static_cast<float>((i * 37 + frame) % 11);
    }
    raw = {pixels.data(), kWidth, kHeight, 1, pitch};
  }
  std::vector<float> pixels;
  RawPixels raw;
};

/// Holds the first frame in a tracker until it is opened.
struct Gate {
  std::promise<void> promise;
  std::shared_future<void> future = promise.get_future().share();
  std::promise<void> reached;
  Hook hook() {
    return [this](std::int64_t frame) {
      if (frame != 0) return;
      reached.set_value();
      future.wait();
    };
  }
};

struct EngineTest : SchedulerTest {
  std::unique_ptr<Engine> engine(
      EngineSettings settings = {}, Hook hook = [](std::int64_t) {}) {
    Scheduler fresh = scheduler_on(device);
    fresh.add(std::make_unique<FakeTracker>(2, std::move(hook)));
    return std::make_unique<Engine>(std::move(fresh), std::move(settings));
  }
};
INSTANTIATE_TEST_SUITE_P(Threads, EngineTest, ::testing::Values(0, 1, 2, 3, 8));

// The log of a Source's run over the same frames.
TEST_P(EngineTest, TracksAsARunOverASourceDoes) {
  Scheduler pulled = scheduler_on(device);
  pulled.add(std::make_unique<FakeTracker>(2));
  FakeSource source(40);
  pulled.run(source);
  const auto pushed = engine();
  for (std::int64_t f = 0; f < 40; ++f) {
    const Picture picture(f, kWidth + 5);
    EXPECT_TRUE(pushed->push(picture.raw, static_cast<double>(f)));
    if (f == 20) pushed->drain();
  }
  pushed->finish();
  EXPECT_EQ(pushed->scheduler().logs()[0]->text(), pulled.logs()[0]->text());
  EXPECT_EQ(pushed->pushed(), 40);
  EXPECT_EQ(pushed->dropped(), 0);
}

TEST_P(EngineTest, ResultsComeInOrderByPollOrByCallback) {
  std::vector<std::int64_t> frames;
  EngineSettings settings;
  settings.on_result = [&](const EngineResult& result) {
    frames.push_back(result.frame);
    EXPECT_EQ(result.tracks.size(), 2u);
    EXPECT_EQ(result.tracks.at(1).frame, result.frame);
    EXPECT_EQ(result.tracks[1].tracker, 0);
    EXPECT_GT(result.latency, 0);
  };
  const auto calling = engine(settings);
  const auto polled = engine();
  for (std::int64_t f = 0; f < 30; ++f) {
    calling->push(Picture(f).raw, static_cast<double>(f));
    polled->push(Picture(f).raw, static_cast<double>(f));
  }
  calling->finish(), polled->finish();
  EXPECT_EQ(frames, first(30));
  for (std::int64_t f = 0; f < 30; ++f) {
    const auto result = polled->poll();
    ASSERT_TRUE(result);
    EXPECT_EQ(result->frame, f);
    EXPECT_EQ(result->time, static_cast<double>(f));
  }
  EXPECT_FALSE(polled->poll());
  EXPECT_FALSE(calling->poll());
}

TEST_P(EngineTest, AResultDoesNotWaitForALaterFrame) {
  const auto one = engine();
  for (std::int64_t f = 0; f < 5; ++f) {
    one->push(Picture(f).raw, static_cast<double>(f));
    one->drain();
    const auto result = one->poll();
    ASSERT_TRUE(result);
    EXPECT_EQ(result->frame, f);
  }
}

TEST_P(EngineTest, ResultsEndWithTheLastFramePushed) {
  const auto pushed = engine();
  std::vector<std::int64_t> frames;
  for (std::int64_t f = 0; f < 5; ++f) pushed->push(Picture(f).raw, static_cast<double>(f));
  for (const auto& result : pushed->results()) frames.push_back(result.frame);
  EXPECT_EQ(frames, first(5)) << "waits for those at work, before finish() too";
  EXPECT_TRUE(pushed->more());
  for (std::int64_t f = 5; f < 9; ++f) pushed->push(Picture(f).raw, static_cast<double>(f));
  pushed->finish();
  for (const auto& result : pushed->results()) frames.push_back(result.frame);
  EXPECT_EQ(frames, first(9));
  EXPECT_FALSE(pushed->more());
}

TEST_P(EngineTest, ResultsBeforeAFailureComeThenTheFailure) {
  const auto failing = engine({}, throws_at(3, "no fourth"));
  std::vector<std::int64_t> frames;
  const auto go_through = [&] {
    for (std::int64_t f = 0; f < 6; ++f) failing->push(Picture(f).raw, static_cast<double>(f));
    for (const auto& result : failing->results()) frames.push_back(result.frame);
  };
  EXPECT_THROW(go_through(), std::runtime_error);
  EXPECT_THROW(
      {
        for (const auto& result : failing->results()) frames.push_back(result.frame);
      },
      std::runtime_error);
  EXPECT_EQ(frames, first(3));
}

TEST_P(EngineTest, PollWaitsAsLongAsItIsToldTo) {
  Gate gate;
  const auto held = engine({}, gate.hook());
  held->push(Picture(0).raw, 0);
  gate.reached.get_future().wait();
  EXPECT_FALSE(held->poll(20ms)) << "the tracker holds the frame";
  gate.promise.set_value();
  EXPECT_EQ(held->poll(std::chrono::hours(24 * 365 * 1000)).value().frame, 0);
  held->finish();
  EXPECT_FALSE(held->poll(1h)) << "nothing more can come, so nothing is waited for";
}

TEST_P(EngineTest, ABackgroundLearnedAheadHoldsFramesUntilItIsKnown) {
  Scheduler fresh = scheduler_on(device);
  fresh.prime(6);
  fresh.add(std::make_unique<FakeTracker>(1));
  EngineSettings small;
  small.queue = 2;
  Engine primed(std::move(fresh), small);
  for (std::int64_t f = 0; f < 5; ++f) primed.push(Picture(f).raw, static_cast<double>(f));
  EXPECT_FALSE(primed.poll(20ms)) << "a sixth frame is to come";
  primed.push(Picture(5).raw, 5);
  for (std::int64_t f = 0; f < 6; ++f) EXPECT_EQ(primed.poll(10s).value().frame, f);

  Scheduler fewer = scheduler_on(device);
  fewer.prime(6);
  fewer.add(std::make_unique<FakeTracker>(1));
  Engine hurried(std::move(fewer));
  hurried.push(Picture(0).raw, 0);
  hurried.drain();  // whoever waits for all frames gets them
  EXPECT_EQ(hurried.poll().value().frame, 0);
}

TEST(EngineCheckpoint, IsRefusedWhileFramesAreHeldAndGoneOnFromAfterwards) {
  const Settings settings{{"background_prime", 4}, {"birth_particles", 200}, {"threads", 2}};
  Engine first("smc-phd", settings), next("smc-phd", settings);
  first.push(Picture(0).raw, 0), first.push(Picture(1).raw, 1);
  EXPECT_THROW(first.checkpoint(), std::logic_error);
  for (std::int64_t f = 2; f < 5; ++f) first.push(Picture(f).raw, static_cast<double>(f));
  next.restore(first.checkpoint());
  for (Engine* engine : {&first, &next}) {
    for (std::int64_t f = 5; f < 8; ++f) engine->push(Picture(f).raw, static_cast<double>(f));
    engine->finish();
  }
  EXPECT_EQ(next.pushed(), 8);
  EXPECT_EQ(next.scheduler().frames(), 8);
  EXPECT_EQ(next.scheduler().logs()[0]->text(), first.scheduler().logs()[0]->text());
}

TEST_P(EngineTest, AFullQueueHoldsThePusherBack) {
  Gate gate;
  EngineSettings settings;
  settings.queue = 3;
  const auto held = engine(settings, gate.hook());
  auto pusher = std::async(std::launch::async, [&] {
    for (std::int64_t f = 0; f < 30; ++f) held->push(Picture(f).raw, static_cast<double>(f));
  });
  gate.reached.get_future().wait();
  EXPECT_EQ(pusher.wait_for(50ms), std::future_status::timeout);
  // Those in the queue and those in the pipeline.
  EXPECT_LE(held->pushed(), static_cast<std::int64_t>(3 + Scheduler::kFramesInFlight));
  gate.promise.set_value();
  pusher.wait();
  held->finish();
  EXPECT_EQ(held->scheduler().frames(), 30);
  EXPECT_EQ(held->dropped(), 0);
}

TEST_P(EngineTest, EveryPusherOfAFullQueueGoesOn) {
  constexpr std::int64_t kPushers = 4, kEach = 50;
  EngineSettings settings;
  settings.queue = 5;
  const auto shared = engine(settings);
  std::vector<std::future<void>> pushers;
  for (std::int64_t i = 0; i < kPushers; ++i) {
    pushers.push_back(std::async(std::launch::async, [&] {
      for (std::int64_t f = 0; f < kEach; ++f) shared->push(Picture(f).raw, 0);
    }));
  }
  for (auto& pusher : pushers) pusher.get();
  shared->finish();
  EXPECT_EQ(shared->scheduler().frames(), kPushers * kEach);
  EXPECT_EQ(shared->dropped(), 0);
}

// Frame numbers go on counting, so that trackers know how much time has passed.
TEST_P(EngineTest, AFullQueueDropsTheOldestIfTold) {
  Gate gate;
  EngineSettings settings;
  settings.queue = 2, settings.when_full = WhenFull::drop_oldest;
  const auto dropping = engine(settings, gate.hook());
  dropping->push(Picture(0).raw, 0);
  gate.reached.get_future().wait();
  int refused = 0;
  for (std::int64_t f = 1; f < 30; ++f) {
    refused += !dropping->push(Picture(f).raw, static_cast<double>(f));
  }
  gate.promise.set_value();
  dropping->finish();
  EXPECT_GT(refused, 0);
  EXPECT_EQ(dropping->dropped(), refused);
  std::int64_t results = 0, last = -1;
  while (const auto result = dropping->poll()) {
    EXPECT_GT(result->frame, last);
    EXPECT_EQ(result->time, static_cast<double>(result->frame));
    last = result->frame, ++results;
  }
  EXPECT_EQ(last, 29);
  EXPECT_EQ(results + refused, 30);
}

TEST_P(EngineTest, AFailureComesOutOfTheNextCallAndFinish) {
  const auto failing = engine({}, throws_at(3, "broken"));
  const auto push_all = [&] {
    for (std::int64_t f = 0; f < 1000; ++f) failing->push(Picture(f).raw, static_cast<double>(f));
  };
  EXPECT_THROW(push_all(), std::runtime_error);
  EXPECT_THROW(failing->drain(), std::runtime_error);
  EXPECT_THROW(failing->finish(), std::runtime_error);
  for (std::int64_t f = 0; f < 3; ++f) EXPECT_EQ(failing->poll().value().frame, f);
  EXPECT_THROW(failing->poll(), std::runtime_error);
  EXPECT_FALSE(failing->more());
}

TEST_P(EngineTest, WhatACallbackThrowsEndsIt) {
  EngineSettings settings;
  settings.on_result = [](const EngineResult& r) {
    if (r.frame == 2) throw std::runtime_error("no more");
  };
  const auto ending = engine(settings);
  for (std::int64_t f = 0; f < 3; ++f) ending->push(Picture(f).raw, static_cast<double>(f));
  EXPECT_THROW(ending->finish(), std::runtime_error);
  EXPECT_EQ(ending->scheduler().logs()[0]->revised().at(0).status, TrackStatus::confirmed);
}

TEST_P(EngineTest, MayEndWithFramesInItAndRefusesFramesAfterwards) {
  {
    const auto abandoned = engine();
    for (std::int64_t f = 0; f < 6; ++f) abandoned->push(Picture(f).raw, static_cast<double>(f));
  }
  const auto finished = engine();
  finished->finish();
  finished->finish();
  EXPECT_THROW(finished->push(Picture(0).raw, 0), std::logic_error);
  EXPECT_THROW(finished->push(RawPixels{}, 0), std::invalid_argument);
}

TEST_P(EngineTest, FramesThatAreHeldAreReleasedAtOnceAndDroppedWithTheEngine) {
  std::atomic<int> tracked = 0;
  auto picture = std::make_shared<Picture>(0);
  const std::weak_ptr<Picture> lent = picture;
  {
    Scheduler fresh = scheduler_on(device);
    fresh.prime(50);
    fresh.add(std::make_unique<FakeTracker>(1, [&](std::int64_t) { ++tracked; }));
    Engine primed(std::move(fresh));
    SourceFrame frame;
    frame.pixels = picture->raw, frame.owner = std::move(picture);
    primed.push(std::move(frame));
    for (int i = 0; i < 1000 && !lent.expired(); ++i) std::this_thread::sleep_for(1ms);
    EXPECT_TRUE(lent.expired()) << "a ring of buffers would wait for it";
  }
  EXPECT_EQ(tracked, 0);
}

TEST_P(EngineTest, APitchOf0IsPackedAndOneBelowTheWidthIsRefused) {
  const auto packed = engine(), pitched = engine();
  for (std::int64_t f = 0; f < 3; ++f) {
    const Picture dense(f), wide(f, kWidth + 5);
    packed->push({dense.pixels.data(), kWidth, kHeight}, static_cast<double>(f));
    pitched->push(wide.raw, static_cast<double>(f));
  }
  packed->finish(), pitched->finish();
  EXPECT_EQ(packed->scheduler().logs()[0]->text(), pitched->scheduler().logs()[0]->text());

  const auto refusing = engine();
  const Picture picture(0);
  RawPixels narrow = picture.raw;
  narrow.pitch = kWidth - 1;
  EXPECT_THROW(refusing->push(narrow, 0), std::invalid_argument);
  SourceFrame lent;
  lent.pixels = narrow;
  EXPECT_THROW(refusing->push(lent), std::invalid_argument);
  EXPECT_THROW(refusing->push({static_cast<const float*>(nullptr), 4, 4}, 0),
               std::invalid_argument);
}

TEST_P(EngineTest, PixelsThatAreNotCopiedAreLetGoOf) {
  const auto one = engine();
  auto pixels = std::make_shared<Picture>(0);
  SourceFrame frame;
  frame.pixels = pixels->raw, frame.owner = pixels;
  one->push(std::move(frame));
  one->drain();
  EXPECT_EQ(pixels.use_count(), 1);
}

TEST(Engine, EnginesShareADevicesThreads) {
  const Device device = Device::tbb(2);
  std::vector<std::unique_ptr<Engine>> engines;
  for (int i = 0; i < 3; ++i) {
    Scheduler scheduler = scheduler_on(device);
    scheduler.add(std::make_unique<FakeTracker>(2));
    engines.push_back(std::make_unique<Engine>(std::move(scheduler)));
  }
  for (std::int64_t f = 0; f < 30; ++f) {
    for (const auto& e : engines) e->push(Picture(f).raw, static_cast<double>(f));
  }
  for (const auto& e : engines) e->finish();
  EXPECT_EQ(engines[0]->scheduler().logs()[0]->text(), engines[2]->scheduler().logs()[0]->text());
  EXPECT_EQ(engines[1]->scheduler().frames(), 30);
}

}  // namespace
}  // namespace glint::test
