// SPDX-License-Identifier: Apache-2.0
// The same clip with the same settings and seed gives the same tracks, bit by bit, by every way
// into the engine.
#include <glint.h>

#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "clip.hpp"
#include "frontends/cli.hpp"
#include "glint/engine/run_config.hpp"
#include "glint/frontends/capi/track_row.hpp"
#include "glint/frontends/config/toml.hpp"
#ifdef GLINT_GST_PLUGINS
#include "pipeline.hpp"
#endif

namespace glint::test {
namespace {

constexpr const char* kSettings = R"(
[run]
seed = 7
[frames]
background_frames = 12
)";
const std::vector<std::string> kTrackers{"mm-phd", "h-pmht", "pmht-imm"};

using Rows = std::vector<glint_track>;

void append(Rows& rows, const std::vector<TrackPoint>& points) {
  for (const TrackPoint& point : points) rows.push_back(track_of(point, 0));
}

/// The tracks of one way, and how many results it gave.
struct Given {
  Rows rows;
  std::int64_t results = 0;
};

/// Of 16-bit frames: the product writes float32, and the least noise that is taken for real depends
/// on the kind of pixel.
std::string npy_header() {
  std::string text = "{'descr': '<u2', 'fortran_order': False, 'shape': (" +
                     std::to_string(kFrames) + ", " + std::to_string(kHeight) + ", " +
                     std::to_string(kWidth) + "), }";
  text.resize(117, ' ');
  return std::string("\x93NUMPY\x01\0", 8) + std::string("\x76\0", 2) + text + '\n';
}

/// The clip and the settings as files; what the engine makes of them, pushed in C++. The background
/// is learned from the frames before each one, or ahead from the first nine.
class Ways : public testing::TestWithParam<std::tuple<std::string, int>> {
 protected:
  Ways() {
    settings_ = kSettings + std::string("background_prime = ") + std::to_string(ahead()) + "\n";
    if (takes_points()) settings_ += "[points]\ndetector = \"wavelet\"\n";
    std::ofstream(config_) << settings_;
    std::ofstream raw(raw_, std::ios::binary), npy(npy_, std::ios::binary);
    npy << npy_header();
    for (int f = 0; f < kFrames; ++f) {
      const auto pixels = picture(f);
      const std::string_view bytes(reinterpret_cast<const char*>(pixels.data()),
                                   sizeof(pixels[0]) * pixels.size());
      raw << bytes, npy << bytes;
    }
    const Given cpp = pushed();
    EXPECT_EQ(cpp.results, kFrames);
    EXPECT_GT(cpp.rows.size(), 10u);
    expected_ = cpp.rows;
  }

  static std::string tracker() { return std::get<0>(GetParam()); }
  static int ahead() { return std::get<1>(GetParam()); }

  static bool takes_points() { return tracker() == "pmht-imm"; }

  static Given pushed() {
    Settings settings{{"seed", 7}, {"background_frames", 12}, {"background_prime", ahead()}};
    if (takes_points()) settings.push_back({"points.detector", "wavelet"});
    Engine engine(tracker(), settings);
    Given given;
    const auto take = [&](const EngineResult& result) {
      ++given.results;
      for (const Track& track : result.tracks) given.rows.push_back(track_of(track, 0));
    };
    for (int f = 0; f < kFrames; ++f) {
      const auto pixels = picture(f);
      engine.push({pixels.data(), kWidth, kHeight}, f);
      while (const auto result = engine.poll()) take(*result);
    }
    engine.finish();
    for (const auto& result : engine.results()) take(result);
    return given;
  }

  void expect_same(const Given& given) const {
    EXPECT_EQ(given.results, kFrames);
    expect_same(given.rows);
  }
  /// As bytes, so that NaN equals NaN.
  void expect_same(const Rows& rows) const {
    ASSERT_EQ(rows.size(), expected_.size());
    EXPECT_EQ(std::memcmp(rows.data(), expected_.data(), rows.size() * sizeof(glint_track)), 0);
  }

  /// The rows that `glint track` writes as JSON Lines.
  static Rows rows_of(const std::string& lines) {
    Rows rows;
    std::istringstream text(lines);
    for (std::string line; std::getline(text, line);) {
      const auto json = nlohmann::json::parse(line);
      if (!json.contains("frame")) continue;
      const auto number = [&](const char* key) {
        return json[key].is_null() ? TrackPoint::kUnknown : json[key].get<double>();
      };
      const std::string status = json["status"];
      TrackPoint p;
      p.frame = json["frame"], p.time = json["time"], p.track_id = json["track_id"];
      p.status = status == "confirmed" ? TrackStatus::confirmed
                 : status == "halted"  ? TrackStatus::halted
                                       : TrackStatus::tentative;
      p.x = number("x"), p.y = number("y"), p.vx = number("vx"), p.vy = number("vy");
      p.intensity = number("intensity"), p.existence = number("existence");
      p.set_covariance({number("var_x"), number("cov_xy"), number("var_y"), number("cov_x_vx"),
                        number("cov_x_vy"), number("cov_y_vx"), number("cov_y_vy"),
                        number("var_vx"), number("cov_vx_vy"), number("var_vy")});
      append(rows, {p});
    }
    return rows;
  }

  std::string options() const { return " --config " + config_ + " --tracker " + tracker(); }

  Folder folder_;
  std::string settings_, config_ = folder_ / "settings.toml", raw_ = folder_ / "clip.raw",
                         npy_ = folder_ / "clip.npy";
  Rows expected_;
};

TEST_P(Ways, C) {
  glint_options options = GLINT_OPTIONS_INIT;
  const std::string name = tracker();
  options.tracker = name.c_str(), options.config = settings_.c_str();
  glint_engine* engine = nullptr;
  ASSERT_EQ(glint_create(&options, &engine), GLINT_OK) << glint_last_error();
  for (int f = 0; f < kFrames; ++f) {
    const auto pixels = picture(f);
    glint_frame frame = GLINT_FRAME_INIT;
    frame.data = pixels.data(), frame.pixel = GLINT_GRAY16;
    frame.width = kWidth, frame.height = kHeight, frame.time = f;
    ASSERT_EQ(glint_push(engine, &frame), GLINT_OK) << glint_last_error();
  }
  ASSERT_EQ(glint_finish(engine), GLINT_OK) << glint_last_error();
  Given given;
  std::array<glint_track, 50> tracks;
  glint_result result = GLINT_RESULT_INIT;
  glint_status status = GLINT_OK;
  while ((status = glint_next(engine, 1, &result, tracks.data(), tracks.size())) == GLINT_OK) {
    ++given.results;
    given.rows.insert(given.rows.end(), tracks.begin(),
                      tracks.begin() + static_cast<long>(result.tracks));
  }
  EXPECT_EQ(status, GLINT_END);
  glint_destroy(engine);
  expect_same(given);
}

TEST_P(Ways, Pipe) {
  const Result run =
      glint(folder_, "track - --format gray16le --size " + std::to_string(kWidth) + "x" +
                         std::to_string(kHeight) + " --fps 1 --out -" + options() + " < " + raw_);
  ASSERT_EQ(run.code, 0) << run.err;
  expect_same(rows_of(run.out));
}

TEST_P(Ways, File) {
  const std::string out = folder_ / "tracks.jsonl";
  const Result run = glint(folder_, "track " + npy_ + " --fps 1 --out " + out + options());
  ASSERT_EQ(run.code, 0) << run.err;
  expect_same(rows_of(content_of(out)));
}

TEST_P(Ways, Python) {
#ifdef GLINT_PYTHON
  const std::string out = folder_ / "rows";
  const std::string command = std::string(GLINT_PYTHON) + " " + GLINT_PYTHON_WAY + " " + raw_ +
                              " " + std::to_string(kHeight) + " " + std::to_string(kWidth) + " " +
                              config_ + " " + tracker() + " > " + out + " 2> " + out + ".count";
  ASSERT_EQ(std::system(command.c_str()), 0) << command;
  const std::string bytes = content_of(out);
  Rows rows(bytes.size() / sizeof(glint_track));
  ASSERT_EQ(rows.size() * sizeof(glint_track), bytes.size());
  std::memcpy(rows.data(), bytes.data(), bytes.size());
  expect_same({rows, std::stoll(content_of(out + ".count"))});
#else
  GTEST_SKIP() << "NOT TESTED: this build has no Python module; configuring says what is missing";
#endif
}

TEST_P(Ways, GStreamer) {
#ifdef GLINT_GST_PLUGINS
  Pipeline pipeline("filesrc location=" + raw_ + " ! rawvideoparse format=gray16-le width=" +
                    std::to_string(kWidth) + " height=" + std::to_string(kHeight) +
                    " framerate=1/1 ! glinttrack config-file=" + config_ + " tracker=" + tracker() +
                    " ! fakesink");
  const std::string error = pipeline.run();
  if (ahead() > 0) {  // each picture leaves with its own tracks
    EXPECT_NE(error.find("frames.background_prime"), std::string::npos) << error;
    return;
  }
  ASSERT_EQ(error, "");
  Given given;
  for (const Posted& frame : pipeline.posted) append(given.rows, frame.tracks), ++given.results;
  expect_same(given);
#else
  GTEST_SKIP()
      << "NOT TESTED: this build has no GStreamer plugin; configuring says what is missing";
#endif
}

INSTANTIATE_TEST_SUITE_P(Trackers, Ways,
                         testing::Combine(testing::ValuesIn(kTrackers), testing::Values(0, 9)),
                         [](const auto& way) {
                           std::string name = std::get<0>(way.param);
                           std::ranges::replace(name, '-', '_');
                           return name + (std::get<1>(way.param) > 0 ? "_learned_ahead" : "");
                         });

}  // namespace
}  // namespace glint::test
