// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli.hpp"
#include "glint/engine/scenario/radar_scenes.hpp"
#include "glint/frontends/files/point_scans.hpp"
#include "glint/frontends/files/tables.hpp"

namespace glint::test {
namespace {

/// Where the points of a scan lie in the plane.
std::vector<PointMeasurement> in_the_plane(const RadarScene& scene, std::uint64_t seed, int scan) {
  std::vector<PointMeasurement> plane;
  const bool polar = scene.radar.measures == RadarMeasurement::range_azimuth_elevation;
  for (const Eigen::Vector3d& p : points_at(scene, seed, scan)) {
    const double ground = p.x() * std::cos(p.z());
    plane.push_back({polar ? scene.radar.place.x() + ground * std::cos(p.y()) : p.x(),
                     polar ? scene.radar.place.y() + ground * std::sin(p.y()) : p.y(), 0});
  }
  return plane;
}

/// The files hold the scene, to 1 mm.
void expect_files(const std::string& out, const RadarScene& scene, std::uint64_t seed) {
  const std::vector<PointScan> scans = read_point_scans(out + "/points.csv", 1).scans;
  ASSERT_EQ(scans.size(), static_cast<std::size_t>(scene.scans));
  for (const PointScan& scan : scans) {
    EXPECT_EQ(scan.time, static_cast<double>(scan.frame) * scene.interval);
    EXPECT_EQ(scan.sensor_x, scene.radar.place.x());
    EXPECT_EQ(scan.sensor_y, scene.radar.place.y());
    const auto want = in_the_plane(scene, seed, static_cast<int>(scan.frame));
    ASSERT_EQ(scan.points.size(), want.size()) << scan.frame;
    for (std::size_t i = 0; i < want.size(); ++i) {
      EXPECT_NEAR(scan.points[i].x, want[i].x, 1e-3);
      EXPECT_NEAR(scan.points[i].y, want[i].y, 1e-3);
    }
  }
  const std::vector<TruthPoint> truth = read_truth(out + "/truth.csv"), of = truth_of(scene);
  ASSERT_EQ(truth.size(), of.size());
  for (std::size_t i = 0; i < of.size(); ++i) {
    EXPECT_EQ(truth[i].track_id, of[i].track_id);
    EXPECT_EQ(truth[i].x, of[i].x);
    EXPECT_EQ(truth[i].vy, of[i].vy);
  }
}

TEST(SimulateRadar, WritesRangesAndAzimuthsAndTheRadarsPlace) {
  const Folder folder;
  const Result result = glint(
      folder, "simulate radar-aircraft --seed 5 --set sensor_x=700 --set sensor_y=-90 --out " +
                  (folder / "air"));
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(has(result.out, "36 scans, 3 targets, ")) << result.out;
  RadarAircraftScene config;
  config.sensor_x = 700, config.sensor_y = -90;
  expect_files(folder / "air", make_scene(config), 5);
  EXPECT_TRUE(has(content_of(folder / "air/points.csv"), "frame,time,range,azimuth,elevation,"));
}

TEST(SimulateRadar, WritesPositionsOfBoatsAndScansWithoutPoints) {
  const Folder folder;
  ASSERT_EQ(
      glint(folder, "simulate merging-boats --set detection=0.5 --out " + (folder / "boats")).code,
      0);
  MergingBoatsScene config;
  config.detection = 0.5;
  expect_files(folder / "boats", make_scene(config), 1);
  EXPECT_TRUE(has(content_of(folder / "boats/points.csv"), ",,\n"));
}

TEST(SimulateRadar, GivesTheSameBytesForASeedAndFromItsOwnHeader) {
  const Folder folder;
  const std::string run = "simulate radar-aircraft --quiet --out ";
  const auto points = [&](const char* out, const std::string& options) {
    const Result result = glint(folder, run + (folder / out) + options);
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(result.out, "");
    return content_of(folder / (std::string(out) + "/points.csv"));
  };
  const std::string first = points("a", " --seed 7 --set clutter=0.3");
  EXPECT_EQ(points("b", " --seed 7 --set clutter=0.3"), first);
  EXPECT_NE(points("c", " --seed 8 --set clutter=0.3"), first);
  EXPECT_EQ(points("d", " --config " + (folder / "a/points.csv")), first);
}

/// As `glint simulate --help` has it.
nlohmann::json scores(const Folder& folder, const std::string& tracker, const std::string& more) {
  const std::string air = folder / "air", tracks = folder / "tracks.csv";
  EXPECT_EQ(glint(folder, "simulate radar-aircraft --set clutter=0.02 --out " + air + more).code,
            0);
  const Result result =
      glint(folder, "track " + air + "/points.csv --tracker " + tracker +
                        " --set measurement=range-azimuth --set range_sd=20 --set azimuth_sd=0.007"
                        " --set motion=ncv+wpa+wpa --set noise=5 --set noise_agile=7.5"
                        " --set noise_jump=40 --set speed_max=500 --out " +
                        tracks);
  EXPECT_EQ(result.code, 0) << result.err;
  const Result evaluated = glint(
      folder, "evaluate --json --cutoff 300 --truth " + air + "/truth.csv --tracks " + tracks);
  EXPECT_EQ(evaluated.code, 0) << evaluated.err;
  return nlohmann::json::parse(evaluated.out);
}

// An azimuth alone is 70 m off at 10 km.
TEST(SimulateRadar, ItsAircraftAreFollowedFromTheFile) {
  const Folder folder;
  for (const std::string tracker : {"imm-jpda", "imm-mscan-jpda"}) {
    for (const std::string place : {"", " --set sensor_x=-400 --set sensor_y=900"}) {
      const nlohmann::json all = scores(folder, tracker, place);
      EXPECT_EQ(all["tracks"]["detected"], 3) << tracker << place;
      EXPECT_EQ(all["tracks"]["false"], 0) << tracker << place;
      EXPECT_GT(all["points"]["detected"].get<double>(), 0.85) << tracker << place;
      for (const char* aircraft : {"0", "1", "2"}) {
        EXPECT_LT(all["rmse"][aircraft].get<double>(), 90) << tracker << place << aircraft;
      }
    }
  }
}

TEST(SimulateRadar, RefusesWhatIsOfFrames) {
  const Folder folder;
  const std::string out = folder / "out";
  expect_error(glint(folder, "simulate radar-aircraft --format npy --out " + out), 2, "--format");
  expect_error(glint(folder, "track scene:merging-boats --tracker imm-jpda"), 2,
               "glint simulate merging-boats");
  ASSERT_EQ(
      glint(folder, "simulate noise --format npy --set scenes.noise.frames=2 --out " + out).code,
      0);
  expect_error(glint(folder, "simulate merging-boats --out " + out), 2, "empty folder");
}

TEST(SimulateRadar, ItsSettingsAreShownAndChecked) {
  const Folder folder;
  const Result config = glint(folder, "config radar-aircraft");
  EXPECT_EQ(config.code, 0) << config.err;
  EXPECT_TRUE(config.out.starts_with("[scenes.radar-aircraft]\n")) << config.out;
  EXPECT_TRUE(has(config.out, "\nclutter = 0.1\n")) << config.out;
  EXPECT_TRUE(has(glint(folder, "info").out, "merging-boats"));
  expect_error(glint(folder, "simulate radar-aircraft --set detection=2 --out " + (folder / "a")),
               2, "scenes.radar-aircraft.detection");
  EXPECT_FALSE(std::filesystem::exists(folder / "a"));
}

}  // namespace
}  // namespace glint::test
