// SPDX-License-Identifier: Apache-2.0
#include <glint.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "clip.hpp"
#include "handle.hpp"

namespace glint::test {
namespace {

void push_clip(glint_engine* engine) {
  for (int f = 0; f < kFrames; ++f) {
    const auto pixels = picture(f);
    const glint_frame frame = frame_of(pixels, f);
    ASSERT_EQ(glint_push(engine, &frame), GLINT_OK) << glint_last_error();
  }
}

/// Bytes, so that NaN equals NaN.
bool same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

void expect_same(const glint_track& a, const TrackPoint& b) {
  EXPECT_EQ(a.frame, b.frame);
  EXPECT_EQ(a.track_id, b.track_id);
  EXPECT_EQ(a.status, static_cast<int>(b.status));
  EXPECT_TRUE(same(a.time, b.time) && same(a.x, b.x) && same(a.y, b.y) && same(a.vx, b.vx));
  EXPECT_TRUE(same(a.vy, b.vy) && same(a.intensity, b.intensity) && same(a.existence, b.existence));
  EXPECT_TRUE(same(a.var_x, b.var_x) && same(a.cov_xy, b.cov_xy) && same(a.var_y, b.var_y));
  EXPECT_TRUE(same(a.cov_x_vx, b.cov_x_vx) && same(a.cov_x_vy, b.cov_x_vy));
  EXPECT_TRUE(same(a.cov_y_vx, b.cov_y_vx) && same(a.cov_y_vy, b.cov_y_vy));
  EXPECT_TRUE(same(a.var_vx, b.var_vx) && same(a.cov_vx_vy, b.cov_vx_vy));
  EXPECT_TRUE(same(a.var_vy, b.var_vy));
}

TEST(CApi, GivesTheTracksOfTheEngine) {
  const auto expected = engine_results("mm-phd");
  const Handle engine = create("mm-phd");
  push_clip(engine.get());
  ASSERT_EQ(glint_finish(engine.get()), GLINT_OK);
  std::size_t points = 0;
  for (const EngineResult& frame : expected) {
    std::array<glint_track, 50> tracks;
    glint_result result = GLINT_RESULT_INIT;
    ASSERT_EQ(glint_poll(engine.get(), &result, tracks.data(), tracks.size()), GLINT_OK);
    EXPECT_EQ(result.frame, frame.frame);
    EXPECT_GT(result.latency, 0);
    ASSERT_EQ(result.tracks, frame.tracks.size());
    for (std::size_t i = 0; i < result.tracks; ++i) {
      expect_same(tracks[i], frame.tracks[i]);
      EXPECT_GT(tracks[i].var_vx * tracks[i].var_vy, std::pow(tracks[i].cov_vx_vy, 2));
    }
    points += result.tracks;
  }
  EXPECT_GT(points, 10u);
  glint_result rest = GLINT_RESULT_INIT;
  EXPECT_EQ(glint_poll(engine.get(), &rest, nullptr, 0), GLINT_NOTHING);
  EXPECT_EQ(glint_next(engine.get(), 0, &rest, nullptr, 0), GLINT_END);
  std::int64_t pushed = 0, dropped = -1;
  EXPECT_EQ(glint_counts(engine.get(), &pushed, &dropped), GLINT_OK);
  EXPECT_EQ(pushed, kFrames);
  EXPECT_EQ(dropped, 0);
}

// Two trackers, rows with gaps that no pixel is aligned to, pixels not copied where they can be.
TEST(CApi, PixelsAreReadWhereTheyAreAndWhateverTheirRows) {
  const Handle copied = create("smc-phd viterbi"), leased = create("smc-phd viterbi");
  const Handle odd = create("smc-phd viterbi");
  int released = 0;
  for (int f = 0; f < kFrames; ++f) {
    auto* own = new std::vector<std::uint16_t>(picture(f));
    glint_frame frame = frame_of(*own, f);
    ASSERT_EQ(glint_push(copied.get(), &frame), GLINT_OK);

    constexpr std::ptrdiff_t kRow = 2 * kWidth + 3;
    std::vector<char> bytes(kRow * kHeight + 1);
    for (int y = 0; y < kHeight; ++y) {
      std::memcpy(bytes.data() + 1 + y * kRow, own->data() + y * kWidth, 2 * kWidth);
    }
    glint_frame shifted = frame;
    shifted.data = bytes.data() + 1, shifted.row_bytes = kRow;
    ASSERT_EQ(glint_push(odd.get(), &shifted), GLINT_OK);

    struct Lent {
      std::vector<std::uint16_t>* pixels;
      int* released;
    };
    frame.user = new Lent{own, &released};
    frame.release = [](void* user) {
      auto* lent = static_cast<Lent*>(user);
      ++*lent->released;
      delete lent->pixels;
      delete lent;
    };
    ASSERT_EQ(glint_push(leased.get(), &frame), GLINT_OK);
    ASSERT_EQ(glint_drain(leased.get()), GLINT_OK);
    EXPECT_EQ(released, f + 1);
  }
  const auto all = [](glint_engine* engine) {
    EXPECT_EQ(glint_finish(engine), GLINT_OK);
    std::size_t count = 0;
    EXPECT_EQ(glint_revised(engine, nullptr, sizeof(glint_track), &count), GLINT_TOO_SMALL);
    std::vector<glint_track> tracks(count);
    EXPECT_EQ(glint_revised(engine, tracks.data(), sizeof(glint_track), &count), GLINT_OK);
    EXPECT_EQ(tracks.back().tracker, 1);
    return std::string(reinterpret_cast<const char*>(tracks.data()), count * sizeof(glint_track));
  };
  const std::string expected = all(copied.get());
  EXPECT_EQ(all(leased.get()), expected);
  EXPECT_EQ(all(odd.get()), expected);
}

TEST(CApi, ACueStartsATrackInTheNextFrame) {
  EXPECT_EQ(glint_has("start"), 1);
  const Handle engine = create("mm-phd");
  glint_cue cue = GLINT_CUE_INIT;
  cue.x = 20, cue.y = 12, cue.sigma = 1;
  ASSERT_EQ(glint_start(engine.get(), &cue), GLINT_OK) << glint_last_error();
  const auto pixels = picture(0);
  const glint_frame frame = frame_of(pixels, 0);
  ASSERT_EQ(glint_push(engine.get(), &frame), GLINT_OK);
  std::array<glint_track, 50> tracks;
  glint_result result = GLINT_RESULT_INIT;
  ASSERT_EQ(glint_next(engine.get(), 60, &result, tracks.data(), tracks.size()), GLINT_OK);
  ASSERT_EQ(result.tracks, 1u);
  // Of the first frame's background nothing is known: the track may doubt itself.
  EXPECT_EQ(tracks[0].status, tracks[0].existence >= 0.5 ? GLINT_CONFIRMED : GLINT_TENTATIVE);
  EXPECT_NEAR(tracks[0].x, 20, 3);
  EXPECT_NEAR(tracks[0].y, 12, 3);

  EXPECT_EQ(glint_start(engine.get(), nullptr), GLINT_BAD_ARGUMENT);
  cue.vx = 1;  // without vy
  EXPECT_EQ(glint_start(engine.get(), &cue), GLINT_BAD_ARGUMENT);
  EXPECT_TRUE(said("both"));
  cue.vx = NAN;
  ASSERT_EQ(glint_finish(engine.get()), GLINT_OK);
  EXPECT_EQ(glint_start(engine.get(), &cue), GLINT_BAD_STATE);
}

TEST(CApi, WhatIsNotTakenStaysTheCallers) {
  const Handle engine = create("smc-phd");
  ASSERT_EQ(glint_finish(engine.get()), GLINT_OK);
  const auto pixels = picture(0);
  glint_frame frame = frame_of(pixels, 0);
  int released = 0;
  frame.user = &released, frame.release = [](void* user) { ++*static_cast<int*>(user); };
  EXPECT_EQ(glint_push(engine.get(), &frame), GLINT_BAD_STATE);
  EXPECT_TRUE(said("after finish"));
  EXPECT_EQ(released, 0);
}

TEST(CApi, AnArrayThatIsTooSmallLosesNothing) {
  const Handle engine = create("smc-phd", "[run]\nthreads = 1\n");
  push_clip(engine.get());
  ASSERT_EQ(glint_finish(engine.get()), GLINT_OK);
  std::array<glint_track, 50> tracks;
  glint_result result = GLINT_RESULT_INIT;
  glint_status status;
  while ((status = glint_poll(engine.get(), &result, tracks.data(), 0)) == GLINT_OK) {
    EXPECT_EQ(result.tracks, 0u);
  }
  ASSERT_EQ(status, GLINT_TOO_SMALL);
  const std::size_t needed = result.tracks;
  const std::int64_t frame = result.frame;
  ASSERT_EQ(glint_poll(engine.get(), &result, tracks.data(), needed), GLINT_OK);
  EXPECT_EQ(result.frame, frame);
  EXPECT_EQ(tracks[0].frame, frame);
}

// As built with a header whose structs end earlier, and one whose tracks are longer.
TEST(CApi, OlderAndNewerHeadersWork) {
  const Handle engine = create("smc-phd");
  for (int f = 0; f < kFrames; ++f) {
    const auto pixels = picture(f);
    glint_frame frame = frame_of(pixels, f);
    frame.struct_size = offsetof(glint_frame, release);
    frame.release = [](void*) { ADD_FAILURE() << "a field that the header has not was read"; };
    ASSERT_EQ(glint_push(engine.get(), &frame), GLINT_OK);
  }
  ASSERT_EQ(glint_finish(engine.get()), GLINT_OK);
  std::size_t count = 0;
  glint_revised(engine.get(), nullptr, sizeof(glint_track), &count);
  std::vector<glint_track> whole(count);
  ASSERT_EQ(glint_revised(engine.get(), whole.data(), sizeof(glint_track), &count), GLINT_OK);
  struct Longer {
    glint_track known;
    double news;
  };
  std::vector<Longer> longer(count, Longer{{}, 7});
  auto* first = reinterpret_cast<glint_track*>(longer.data());
  ASSERT_EQ(glint_revised(engine.get(), first, sizeof(Longer), &count), GLINT_OK);
  ASSERT_GT(count, 1u);
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_EQ(longer[i].known.x, whole[i].x);
    EXPECT_EQ(longer[i].news, 7);
  }
}

/// glint_track before it had the velocity's covariance.
struct EarlierTrack {
  std::int64_t frame;
  double time;
  std::int64_t track_id;
  std::int32_t tracker, status;
  double x, y, vx, vy, intensity, existence, var_x, cov_xy, var_y;
};

TEST(CApi, AHeaderWithoutTheVelocitysCovarianceGetsTheTracksItKnows) {
  static_assert(sizeof(EarlierTrack) == offsetof(glint_track, cov_x_vx));
  const Handle ours = create("mm-phd"), theirs = create("mm-phd");
  for (const Handle* engine : {&ours, &theirs}) {
    push_clip(engine->get());
    ASSERT_EQ(glint_finish(engine->get()), GLINT_OK);
  }
  constexpr std::size_t kRoom = 50;
  std::array<glint_track, kRoom> tracks;
  std::array<EarlierTrack, kRoom> earlier;
  glint_result result = GLINT_RESULT_INIT, early = GLINT_RESULT_INIT;
  early.track_size = sizeof(EarlierTrack);
  std::size_t points = 0;
  while (glint_poll(ours.get(), &result, tracks.data(), kRoom) == GLINT_OK) {
    auto* first = reinterpret_cast<glint_track*>(earlier.data());
    earlier.fill({-1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    ASSERT_EQ(glint_poll(theirs.get(), &early, first, kRoom), GLINT_OK);
    ASSERT_EQ(early.tracks, result.tracks);
    for (std::size_t i = 0; i < result.tracks; ++i) {
      EXPECT_EQ(std::memcmp(&earlier[i], &tracks[i], sizeof(EarlierTrack)), 0);
    }
    EXPECT_EQ(earlier[result.tracks].frame, -1);
    points += result.tracks;
  }
  EXPECT_GT(points, 10u);
}

TEST(CApi, MistakesAreNamed) {
  glint_engine* engine = nullptr;
  glint_options options = GLINT_OPTIONS_INIT;
  EXPECT_EQ(glint_create(nullptr, &engine), GLINT_BAD_ARGUMENT);
  EXPECT_EQ(glint_create(&options, nullptr), GLINT_BAD_ARGUMENT);
  EXPECT_EQ(glint_create(&options, &engine), GLINT_BAD_CONFIG);
  EXPECT_TRUE(said("set options.tracker"));
  options.tracker = "nobody";
  EXPECT_EQ(glint_create(&options, &engine), GLINT_BAD_CONFIG);
  EXPECT_TRUE(said("tracker 'nobody' is not known"));
  options.tracker = "smc-phd", options.config = "[trackers.smc-phd]\nbirth_particles = 0\n";
  EXPECT_EQ(glint_create(&options, &engine), GLINT_BAD_CONFIG);
  EXPECT_TRUE(said("config:2: trackers.smc-phd.birth_particles must be in")) << glint_last_error();
  options.config = "[run]\nmask = \"mask.png\"\n";
  EXPECT_EQ(glint_create(&options, &engine), GLINT_BAD_CONFIG);
  options.config = nullptr, options.profile = "Q";
  EXPECT_EQ(glint_create(&options, &engine), GLINT_BAD_CONFIG);
  options.struct_size = 0;
  EXPECT_EQ(glint_create(&options, &engine), GLINT_BAD_ARGUMENT);
  EXPECT_TRUE(said("use the _INIT macro"));
  EXPECT_EQ(engine, nullptr);
  glint_destroy(nullptr);
}

TEST(CApi, FramesThatCannotBeAreRefused) {
  const Handle engine = create("smc-phd");
  const auto pixels = picture(0);
  const auto refused = [&](const auto& change) {
    glint_frame frame = frame_of(pixels, 0);
    change(frame);
    return glint_push(engine.get(), &frame) == GLINT_BAD_ARGUMENT;
  };
  EXPECT_TRUE(refused([](glint_frame& f) { f.data = nullptr; }));
  EXPECT_TRUE(refused([](glint_frame& f) { f.width = 0; }));
  EXPECT_TRUE(refused([](glint_frame& f) { f.height = -1; }));
  EXPECT_TRUE(refused([](glint_frame& f) { f.channels = 2; }));
  EXPECT_TRUE(refused([](glint_frame& f) { f.row_bytes = 2 * kWidth - 1; }));
  EXPECT_TRUE(refused([](glint_frame& f) { f.pixel = static_cast<glint_pixel>(9); }));
  EXPECT_EQ(glint_push(engine.get(), nullptr), GLINT_BAD_ARGUMENT);
  glint_frame frame = frame_of(pixels, 0);
  EXPECT_EQ(glint_push(nullptr, &frame), GLINT_BAD_ARGUMENT);
  // Of another size than the first: the engine ends, and says so from then on.
  ASSERT_EQ(glint_push(engine.get(), &frame), GLINT_OK);
  frame.width = kWidth - 1, frame.row_bytes = 2 * kWidth;
  ASSERT_EQ(glint_push(engine.get(), &frame), GLINT_OK);
  EXPECT_EQ(glint_drain(engine.get()), GLINT_FAILED);
  EXPECT_EQ(glint_push(engine.get(), &frame), GLINT_FAILED);
  EXPECT_EQ(glint_finish(engine.get()), GLINT_FAILED);
}

TEST(CApi, FollowsPoints) {
  const Handle engine = create("imm-jpda");
  for (int t = 0; t < 20; ++t) {
    const std::array<glint_point, 2> points{
        {{10 + 2.f * t, 20 + 1.f * t, NAN}, {300, 5.f * t, NAN}}};
    ASSERT_EQ(glint_push_points(engine.get(), points.data(), t == 10 ? 0 : 2, t), GLINT_OK);
  }
  ASSERT_EQ(glint_finish(engine.get()), GLINT_OK);
  std::size_t count = 1000;
  std::vector<glint_track> tracks(count);
  ASSERT_EQ(glint_revised(engine.get(), tracks.data(), sizeof(glint_track), &count), GLINT_OK);
  tracks.resize(count);
  EXPECT_TRUE(std::ranges::any_of(tracks, [](const glint_track& t) {
    return t.frame == 19 && t.status == GLINT_CONFIRMED && std::abs(t.x - 48) < 1.5 &&
           std::abs(t.y - 39) < 1.5;
  }));
}

/// A struct of a later header: the library passes over what it does not know.
struct LaterMeasurement {
  glint_measurement known;
  double more;
};

TEST(CApi, MeasurementsKeepTheirDigits) {
  const Handle engine = create("imm-jpda");
  for (int t = 0; t < 20; ++t) {
    const std::array<LaterMeasurement, 2> points{
        {{{500000.02 + 2 * t, 5000000.01 + t, NAN}, -1}, {{500300.5, 5000000.25 + 5 * t, 8}, -1}}};
    ASSERT_EQ(glint_push_measurements(engine.get(), &points[0].known, sizeof(LaterMeasurement), 2,
                                      2e9 + t),
              GLINT_OK);
  }
  ASSERT_EQ(glint_finish(engine.get()), GLINT_OK);
  std::size_t count = 1000;
  std::vector<glint_track> tracks(count);
  ASSERT_EQ(glint_revised(engine.get(), tracks.data(), sizeof(glint_track), &count), GLINT_OK);
  tracks.resize(count);
  EXPECT_TRUE(std::ranges::any_of(tracks, [](const glint_track& t) {
    return t.time == 2e9 + 19 && t.status == GLINT_CONFIRMED && std::abs(t.x - 500038.02) < 1e-3 &&
           std::abs(t.y - 5000019.01) < 1e-3;
  }));
}

TEST(CApi, BadMeasurementsAreRefused) {
  const Handle engine = create("imm-jpda");
  const glint_measurement point{1, 2, 3};
  EXPECT_EQ(glint_push_measurements(engine.get(), nullptr, sizeof point, 1, 0), GLINT_BAD_ARGUMENT);
  EXPECT_EQ(glint_push_measurements(engine.get(), &point, 0, 1, 0), GLINT_BAD_ARGUMENT);
  EXPECT_EQ(glint_push_measurements(nullptr, &point, sizeof point, 1, 0), GLINT_BAD_ARGUMENT);
  EXPECT_EQ(glint_push_measurements(engine.get(), nullptr, sizeof point, 0, 0), GLINT_OK);
}

TEST(CApi, SaysWhatItHas) {
  EXPECT_STREQ(glint_version(), GLINT_VERSION_TEXT);
  EXPECT_EQ(glint_has("tracker.h-pmht"), 1);
  EXPECT_EQ(glint_has("tracker.none"), 0);
  EXPECT_EQ(glint_has("device.tbb"), 1);
  EXPECT_EQ(glint_has("device.abacus"), 0);
  EXPECT_EQ(glint_has("pixel.gray16"), 1);
  EXPECT_EQ(glint_has("measurements"), 1);
  EXPECT_EQ(glint_has(nullptr), 0);
  std::size_t size = 0;
  ASSERT_EQ(glint_default_config(nullptr, &size), GLINT_TOO_SMALL);
  std::string text(size, ' ');
  ASSERT_EQ(glint_default_config(text.data(), &size), GLINT_OK);
  EXPECT_NE(text.find("[trackers.mm-phd]"), std::string::npos);
  EXPECT_NE(create("mm-phd", text.c_str()), nullptr);
  EXPECT_EQ(glint_revised(create("mm-phd").get(), nullptr, sizeof(glint_track), &size),
            GLINT_BAD_STATE);
}

}  // namespace
}  // namespace glint::test
