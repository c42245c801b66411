// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "clip.hpp"
#include "frontends/folder.hpp"
#include "pipeline.hpp"

namespace glint::test {
namespace {

std::string bytes_of(const std::vector<std::uint16_t>& pixels) {
  return {reinterpret_cast<const char*>(pixels.data()), 2 * pixels.size()};
}

/// Pixels of 8 bits: the clip's levels lie below 256.
std::string narrow(const std::vector<std::uint16_t>& pixels) {
  return {pixels.begin(), pixels.end()};
}

/// As bits, so that NaN equals NaN.
std::vector<std::uint64_t> bits_of(const TrackPoint& p) {
  std::vector<std::uint64_t> bits{static_cast<std::uint64_t>(p.frame),
                                  static_cast<std::uint64_t>(p.track_id),
                                  static_cast<std::uint64_t>(p.status)};
  for (const double value :
       {p.time, p.x, p.y, p.vx, p.vy, p.intensity, p.existence, p.var_x, p.cov_xy, p.var_y}) {
    bits.push_back(std::bit_cast<std::uint64_t>(value));
  }
  for (const double value : velocity_covariance(p)) {
    bits.push_back(std::bit_cast<std::uint64_t>(value));
  }
  return bits;
}

void expect_same(const std::vector<TrackPoint>& a, const std::vector<TrackPoint>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(bits_of(a[i]), bits_of(b[i])) << "point " << i;
  }
}

/// The clip as raw 16-bit frames in a file.
class GlintTrack : public testing::Test {
 protected:
  GlintTrack() {
    std::string raw;
    for (int f = 0; f < kFrames; ++f) raw += bytes_of(picture(f));
    folder_.write("clip.raw", raw);
  }
  /// One frame a second, unless `options` say else.
  std::string source(const std::string& options = "framerate=1/1",
                     const std::string& file = "clip.raw") const {
    return "filesrc location=" + (folder_ / file) +
           " ! rawvideoparse format=gray16-le width=" + std::to_string(kWidth) +
           " height=" + std::to_string(kHeight) + " " + options + " ! ";
  }
  static void expect_clip(const std::vector<Posted>& posted) {
    const auto expected = engine_results("mm-phd");
    ASSERT_EQ(posted.size(), expected.size());
    for (std::size_t f = 0; f < posted.size(); ++f) {
      EXPECT_EQ(posted[f].frame, expected[f].frame);
      EXPECT_EQ(posted[f].time, expected[f].time);
      expect_same(posted[f].tracks, points_of(expected[f]));
    }
  }
  std::string error_of(const std::string& properties) const {
    return Pipeline(source() + "glinttrack " + properties + " ! fakesink").run();
  }

  Folder folder_;
};

TEST_F(GlintTrack, PostsTheTracksOfEachPicture) {
  Pipeline pipeline(source() + "glinttrack tracker=mm-phd ! fakesink");
  ASSERT_EQ(pipeline.run(), "");
  expect_clip(pipeline.posted);
  ASSERT_GT(pipeline.posted.back().tracks.size(), 0u);
  const TrackPoint& last = pipeline.posted.back().tracks[0];
  EXPECT_GT(last.var_vx * last.var_vy, last.cov_vx_vy * last.cov_vx_vy);
}

TEST_F(GlintTrack, PicturesPassThroughWithoutACopy) {
  Pipeline pipeline(source() + "glinttrack name=t tracker=viterbi ! fakesink");
  std::vector<GstMemory*> in, out;
  std::string passed, expected;
  pipeline.watch("t", "sink", [&](GstBuffer* b) { in.push_back(gst_buffer_peek_memory(b, 0)); });
  pipeline.watch("t", "src", [&](GstBuffer* b) {
    out.push_back(gst_buffer_peek_memory(b, 0));
    passed += pixels_of(b);
  });
  ASSERT_EQ(pipeline.run(), "");
  for (int f = 0; f < kFrames; ++f) expected += bytes_of(picture(f));
  EXPECT_EQ(passed, expected);
  EXPECT_EQ(in, out);
}

TEST_F(GlintTrack, APictureCarriesItsTracksAsRegions) {
  // A branch beside it: the buffer is not the element's own.
  Pipeline pipeline(source() +
                    "tee name=both ! queue ! glinttrack name=t tracker=mm-phd ! fakesink both. ! "
                    "queue ! fakesink name=other");
  std::vector<std::vector<TrackPoint>> regions;
  pipeline.watch("t", "src", [&](GstBuffer* buffer) {
    regions.emplace_back();
    gpointer state = nullptr;
    while (GstMeta* meta = gst_buffer_iterate_meta_filtered(
               buffer, &state, GST_VIDEO_REGION_OF_INTEREST_META_API_TYPE)) {
      const auto* region = reinterpret_cast<GstVideoRegionOfInterestMeta*>(meta);
      const TrackPoint p = point_of(gst_video_region_of_interest_meta_get_param(
          const_cast<GstVideoRegionOfInterestMeta*>(region), "track"));
      EXPECT_STREQ(g_quark_to_string(region->roi_type), "mm-phd");
      EXPECT_EQ(region->id, p.track_id);
      EXPECT_LE(region->x, p.x + 0.5);
      EXPECT_LE(region->y, p.y + 0.5);
      EXPECT_GE(region->x + region->w, p.x + 0.5);
      EXPECT_GE(region->y + region->h, p.y + 0.5);
      EXPECT_LE(region->x + region->w, static_cast<guint>(kWidth));
      EXPECT_LE(region->y + region->h, static_cast<guint>(kHeight));
      regions.back().push_back(p);
    }
  });
  int marked_beside = 0;
  pipeline.watch("other", "sink", [&](GstBuffer* buffer) {
    marked_beside += gst_buffer_get_video_region_of_interest_meta_id(buffer, 1) != nullptr;
  });
  ASSERT_EQ(pipeline.run(), "");
  ASSERT_EQ(regions.size(), pipeline.posted.size());
  std::size_t count = 0;
  for (std::size_t f = 0; f < regions.size(); ++f) {
    std::vector<TrackPoint> inside = pipeline.posted[f].tracks;
    std::erase_if(inside, [](const TrackPoint& p) {
      const bool in = p.x > -0.5 && p.x < kWidth - 0.5 && p.y > -0.5 && p.y < kHeight - 0.5;
      return !in || p.status == TrackStatus::halted;
    });
    expect_same(regions[f], inside);
    count += inside.size();
  }
  EXPECT_GT(count, 10u);
  EXPECT_EQ(marked_beside, 0);
}

TEST_F(GlintTrack, TheEndPostsTheRevisedTracks) {
  Pipeline pipeline(source() + "glinttrack tracker=mm-phd ! fakesink");
  ASSERT_EQ(pipeline.run(), "");
  const Device device = Device::tbb();
  Scheduler scheduler(device, FramePreparer(FramesConfig{}, device));
  const TrackerEntry& tracker = find_tracker("mm-phd");
  scheduler.add(tracker.make(tracker.config(), device, 1));
  Engine engine(std::move(scheduler));
  for (int f = 0; f < kFrames; ++f) {
    const auto pixels = picture(f);
    engine.push({pixels.data(), kWidth, kHeight, 1, kWidth}, f);
  }
  engine.finish();
  EXPECT_EQ(pipeline.ends, 1);
  EXPECT_GT(pipeline.revised.size(), 10u);
  expect_same(pipeline.revised, engine.scheduler().logs()[0]->revised());
}

TEST_F(GlintTrack, RowsMayLieAnyDistanceApart) {
  constexpr std::size_t kRow = 2 * kWidth;
  std::string raw;
  for (int f = 0; f < kFrames; ++f) {
    const std::string pixels = bytes_of(picture(f));
    for (std::size_t y = 0; y < kHeight; ++y) raw += pixels.substr(y * kRow, kRow) + "?";
  }
  folder_.write("odd.raw", raw);
  Pipeline pipeline(
      source("framerate=1/1 plane-strides=\"<" + std::to_string(kRow + 1) + ">\"", "odd.raw") +
      "glinttrack tracker=mm-phd ! fakesink");
  ASSERT_EQ(pipeline.run(), "");
  expect_clip(pipeline.posted);
}

TEST_F(GlintTrack, TakesPicturesOf8Bits) {
  std::string raw;
  for (int f = 0; f < kFrames; ++f) raw += narrow(picture(f));
  folder_.write("narrow.raw", raw);
  Pipeline pipeline("filesrc location=" + (folder_ / "narrow.raw") +
                    " ! rawvideoparse format=gray8 framerate=1/1 width=" + std::to_string(kWidth) +
                    " height=" + std::to_string(kHeight) +
                    " ! glinttrack name=t tracker=mm-phd ! fakesink");
  std::string passed;
  pipeline.watch("t", "src", [&](GstBuffer* b) { passed += pixels_of(b); });
  ASSERT_EQ(pipeline.run(), "");
  EXPECT_EQ(passed, raw);
  ASSERT_EQ(pipeline.posted.size(), static_cast<std::size_t>(kFrames));
  const auto& last = pipeline.posted.back().tracks;
  const bool found = std::ranges::any_of(last, [](const TrackPoint& p) {
    return std::hypot(p.x - 8 - 1.2 * (kFrames - 1), p.y - 10 - 0.5 * (kFrames - 1)) < 1;
  });
  EXPECT_TRUE(found);
}

TEST_F(GlintTrack, OverlayDrawsBoxesIntoItsOwnCopy) {
  Pipeline pipeline(source() +
                    "tee name=both ! queue ! glinttrack name=t tracker=mm-phd overlay=true ! "
                    "fakesink both. ! queue ! fakesink name=other");
  std::vector<std::string> drawn, beside;
  pipeline.watch("t", "src", [&](GstBuffer* b) { drawn.push_back(pixels_of(b)); });
  pipeline.watch("other", "sink", [&](GstBuffer* b) { beside.push_back(pixels_of(b)); });
  ASSERT_EQ(pipeline.run(), "");
  expect_clip(pipeline.posted);
  ASSERT_EQ(drawn.size(), static_cast<std::size_t>(kFrames));
  int boxes = 0;
  for (int f = 0; f < kFrames; ++f) {
    const auto frame = static_cast<std::size_t>(f);
    std::vector<std::uint16_t> expected = picture(f);
    const auto [low, high] = std::ranges::minmax(expected);
    for (const auto& [ring, level] : {std::pair{4, high}, std::pair{5, low}}) {
      for (const TrackPoint& p : pipeline.posted[frame].tracks) {
        if (p.status != TrackStatus::confirmed) continue;
        ++boxes;
        for (int i = 0; i < kWidth * kHeight; ++i) {
          const auto away = std::max(std::abs(i % kWidth - std::lround(p.x)),
                                     std::abs(i / kWidth - std::lround(p.y)));
          if (away == ring) expected[static_cast<std::size_t>(i)] = level;
        }
      }
    }
    EXPECT_EQ(drawn[frame], bytes_of(expected)) << "frame " << f;
    EXPECT_EQ(beside[frame], bytes_of(picture(f))) << "frame " << f;
  }
  EXPECT_GT(boxes, 10);
}

// rawvideoparse adds up durations of whole nanoseconds; `glint track --fps 30` has frame / 30.
TEST_F(GlintTrack, TimesAreThoseOfTheFrameRate) {
  Pipeline pipeline(source("framerate=30/1") + "glinttrack tracker=viterbi ! fakesink");
  ASSERT_EQ(pipeline.run(), "");
  ASSERT_EQ(pipeline.posted.size(), static_cast<std::size_t>(kFrames));
  for (int f = 0; f < kFrames; ++f) {
    EXPECT_EQ(pipeline.posted[static_cast<std::size_t>(f)].time, f / 30.0);
  }
}

TEST_F(GlintTrack, TimesOffTheFrameRateAreTheTimeStamps) {
  Pipeline pipeline(source("framerate=30/1") + "glinttrack name=t tracker=viterbi ! fakesink");
  pipeline.watch("t", "sink", [](GstBuffer* b) { GST_BUFFER_PTS(b) += GST_MSECOND; });
  ASSERT_EQ(pipeline.run(), "");
  ASSERT_EQ(pipeline.posted.size(), static_cast<std::size_t>(kFrames));
  EXPECT_EQ(pipeline.posted[0].time, 0.001);
  EXPECT_EQ(pipeline.posted[2].time, 0.067666666);
}

TEST_F(GlintTrack, WithoutTimeStampsTheFrameRateTellsTheTime) {
  const auto raw = [&](const std::string& rate) {
    return "filesrc blocksize=" + std::to_string(2 * kWidth * kHeight) +
           " location=" + (folder_ / "clip.raw") +
           " ! video/x-raw,format=GRAY16_LE,width=" + std::to_string(kWidth) +
           ",height=" + std::to_string(kHeight) + ",framerate=" + rate +
           " ! glinttrack name=t tracker=viterbi ! fakesink";
  };
  const auto take_stamp = [](GstBuffer* b) { GST_BUFFER_PTS(b) = GST_CLOCK_TIME_NONE; };
  Pipeline steady(raw("8/1")), none(raw("0/1"));
  steady.watch("t", "sink", take_stamp);
  none.watch("t", "sink", take_stamp);
  ASSERT_EQ(steady.run(), "");
  ASSERT_EQ(steady.posted.size(), static_cast<std::size_t>(kFrames));
  EXPECT_EQ(steady.posted.back().time, (kFrames - 1) / 8.0);
  EXPECT_TRUE(has(none.run(), "put videorate in front of glinttrack"));
}

TEST_F(GlintTrack, AnEventStartsATrackInThePictureBehindIt) {
  Pipeline pipeline(source() + "glinttrack name=t tracker=mm-phd ! fakesink");
  int picture = 0;
  pipeline.watch("t", "sink", [&](GstBuffer*) {
    const auto cue = [](const char* field, double value) {
      return gst_event_new_custom(
          GST_EVENT_CUSTOM_DOWNSTREAM,
          gst_structure_new("glint-start", "x", G_TYPE_DOUBLE, 20.0, "y", G_TYPE_DOUBLE, 12.0,
                            field, G_TYPE_DOUBLE, value, nullptr));
    };
    if (picture == 1) pipeline.send("t", cue("sigma", 1));
    if (picture == 2) pipeline.send("t", cue("sigma", 0));  // a warning, no error
    ++picture;
  });
  ASSERT_EQ(pipeline.run(), "");
  ASSERT_EQ(pipeline.posted.size(), static_cast<std::size_t>(kFrames));
  ASSERT_EQ(pipeline.posted[1].tracks.size(), 1u);
  EXPECT_EQ(pipeline.posted[1].tracks[0].status, TrackStatus::confirmed);
  EXPECT_NEAR(pipeline.posted[1].tracks[0].x, 20, 3);
  EXPECT_TRUE(pipeline.posted[0].tracks.empty());
}

TEST_F(GlintTrack, AFlushBeginsAnew) {
  Pipeline pipeline(source() + "glinttrack tracker=mm-phd ! fakesink");
  pipeline.preroll();
  pipeline.seek_to_start();
  ASSERT_EQ(pipeline.run(), "");
  ASSERT_EQ(pipeline.posted.size(), static_cast<std::size_t>(kFrames) + 1);
  pipeline.posted.erase(pipeline.posted.begin());
  expect_clip(pipeline.posted);
}

TEST_F(GlintTrack, AStoppedPipelineBeginsAnew) {
  Pipeline pipeline(source() + "glinttrack tracker=mm-phd ! fakesink");
  for (int run = 0; run < 2; ++run) {
    pipeline.posted.clear();
    ASSERT_EQ(pipeline.run(), "");
    expect_clip(pipeline.posted);
  }
}

TEST_F(GlintTrack, PicturesMayNotChangeInMidStream) {
  folder_.write("small.raw", std::string(std::size_t{2} * 16 * 16, 'x'));
  Pipeline pipeline("concat name=c ! glinttrack tracker=viterbi ! fakesink " + source() +
                    "c. filesrc location=" + (folder_ / "small.raw") +
                    " ! rawvideoparse format=gray16-le width=16 height=16 framerate=1/1 ! c.");
  const std::string error = pipeline.run();
  EXPECT_TRUE(has(error, "the pictures change from 48x32 GRAY16_LE to 16x16 GRAY16_LE")) << error;
  EXPECT_TRUE(has(error, "put videoscale, videoconvert and a caps filter in front")) << error;
}

TEST_F(GlintTrack, SettingsComeInByEveryProperty) {
  const auto rows = [&](const std::string& properties) {
    Pipeline pipeline(source() + "glinttrack " + properties + " ! fakesink");
    EXPECT_EQ(pipeline.run(), "") << properties;
    std::string text;
    for (const Posted& frame : pipeline.posted) {
      for (const TrackPoint& p : frame.tracks) {
        text += std::to_string(p.track_id) + ' ' + std::to_string(p.x) + '\n';
      }
    }
    return text;
  };
  const std::string file = folder_.write("settings.toml", "[run]\nseed = 5\n");
  const std::string plain = rows(""), seeded = rows("set=\"seed=5\"");
  EXPECT_NE(plain, seeded);
  EXPECT_EQ(rows("tracker=mm-phd"), plain);
  EXPECT_EQ(rows("config-file=" + file), seeded);
  EXPECT_EQ(rows("config=\"[run]\nseed = 5\n\""), seeded);
  EXPECT_EQ(rows("config-file=" + file + " config=\"[run]\nseed = 1\n\""), plain);
  EXPECT_EQ(rows("config-file=" + file + " set=\"threads=1; run.seed = 1\""), plain);
  EXPECT_NE(rows("profile=L"), plain);
  EXPECT_NE(rows("device=serial"), "");
}

TEST_F(GlintTrack, BadSettingsAreNamed) {
  const std::vector<std::pair<std::string, std::string>> all{
      {"tracker=nobody", "tracker 'nobody' is not known"},
      {"profile=Q", "Q"},
      {"config=\"[trackers.mm-phd]\nbirth_particles = 0\n\"",
       "config:2: trackers.mm-phd.birth_particles must be in"},
      {"config-file=/nowhere.toml", "/nowhere.toml"},
      {"set=\"seed\"", "seed"},
      {"set=\"run.mask=m.png\"", "run.mask has no effect"},
      {"device=moon", "moon"}};
  for (const auto& [properties, part] : all) {
    const std::string error = error_of(properties);
    EXPECT_TRUE(has(error, part)) << properties << ": " << error;
  }
}

}  // namespace
}  // namespace glint::test
