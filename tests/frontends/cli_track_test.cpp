// SPDX-License-Identifier: Apache-2.0
// What glint track writes: runs that repeat from their own files, and runs that fail.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli.hpp"
#include "glint/frontends/files/tables.hpp"

namespace glint::test {
namespace {

namespace fs = std::filesystem;

/// Two cubes of different sizes: the second one fails at frame 4.
std::string cubes_that_fail(const Folder& folder) {
  fs::rename(cube(folder, 32, 32, 4, 1, 1), folder / "a.npy");
  fs::rename(cube(folder, 33, 32, 4, 1, 1), folder / "b.npy");
  return "track " + (folder / "a.npy") + ' ' + (folder / "b.npy") + " --tracker smc-phd ";
}

/// A file of that name that can be opened, but not written.
std::string full_disk(const Folder& folder, const std::string& name) {
  fs::create_symlink("/dev/full", folder / name);
  return folder / name;
}

bool estimates_head(const std::string& csv) {
  return csv.find("## estimated: noise sigma") < csv.find("\nframe,");
}

TEST(CliTrack, SimulatedFramesAreTrackedAndARunRepeatsFromItsOwnFile) {
  const Folder folder;
  const std::string clip = folder / "clip";
  ASSERT_EQ(glint(folder, "simulate crossing --seed 3 --format npy --out " + clip).code, 0);
  EXPECT_GT(read_truth(clip + "/truth.csv").size(), 20u);
  EXPECT_GT(read_points(clip + "/points.csv").size(), 20u);
  const std::string first = folder / "1.csv", second = folder / "2.csv", third = folder / "3.csv";
  ASSERT_EQ(glint(folder, "track " + clip +
                              " --tracker smc-phd --seed 5 --add-noise 0.1 --set "
                              "birth_particles=3000 --quiet --out " +
                              first)
                .code,
            0);
  EXPECT_TRUE(has(content_of(first), "# seed = 5\n"));
  EXPECT_TRUE(has(content_of(first), "# birth_particles = 3000\n"));
  EXPECT_GT(read_tracks(first).size(), 20u);
  ASSERT_EQ(glint(folder, "track " + clip + " --config " + first + " --out " + second).code, 0);
  EXPECT_EQ(content_of(first), content_of(second));
  ASSERT_EQ(glint(folder, "track " + clip + " --config " + first + " --seed 6 --out " + third).code,
            0);
  EXPECT_NE(content_of(first), content_of(third));
}

// The truth of a scene is such a file, too.
TEST(CliTrack, TracksStartOnTheTargetsOfAFile) {
  const Folder folder;
  const std::string clip = folder / "clip", tracks = folder / "tracks.csv";
  ASSERT_EQ(glint(folder, "simulate crossing --seed 3 --format npy --out " + clip).code, 0);
  const std::vector<TruthPoint> truth = read_truth(clip + "/truth.csv");
  const Result run = glint(folder, "track " + clip + " --tracker mm-phd --start-at " + clip +
                                       "/truth.csv --out " + tracks);
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_TRUE(has(run.err, "comes before the background is known")) << run.err;
  const Result primed = glint(folder, "track " + clip + " --tracker mm-phd --start-at " + clip +
                                          "/truth.csv --set frames.background_prime=20");
  EXPECT_FALSE(has(primed.err, "background")) << primed.err;
  EXPECT_TRUE(has(content_of(tracks), "# start_at = \"" + clip + "/truth.csv\"\n"));
  const std::vector<TrackPoint> points = read_tracks(tracks);
  EXPECT_EQ(std::ranges::count(points, truth[0].frame, &TrackPoint::frame),
            std::ranges::count(truth, truth[0].frame, &TruthPoint::frame));
  const Result bad = glint(folder, "track " + clip + " --tracker mm-phd --start-at " +
                                       folder.write("bad.csv", "frame,x,y\n0,1,nowhere\n"));
  EXPECT_NE(bad.code, 0);
  EXPECT_TRUE(has(bad.err, "bad.csv:2: y must be")) << bad.err;
}

TEST(CliTrack, EveryFormatRepeatsItsRun) {
  const Folder folder;
  const std::string first = folder / "1.csv";
  const std::string settings = " --seed 5 --set birth_particles=3000 --set psf_sigma=auto";
  std::string outs = " --out " + first;
  for (const char* name : {"1.jsonl", "1.mot.txt"}) outs += " --out " + (folder / name);
  ASSERT_EQ(glint(folder, "track scene:crossing --tracker smc-phd" + settings + outs).code, 0);
  for (const char* name : {"1.csv", "1.jsonl", "1.mot.txt", "1.mot.txt.toml"}) {
    const std::string again = folder / "2.csv";
    const Result result =
        glint(folder, "track scene:crossing --config " + (folder / name) + " --out " + again);
    EXPECT_EQ(result.code, 0) << name << ": " << result.err;
    EXPECT_EQ(content_of(first), content_of(again)) << name;
  }
}

/// What a file says of tracks, without the settings and estimates of the run in its head: a run of
/// two trackers has those of both.
std::string said_of_tracks(const std::string& path) {
  const std::string content = content_of(path);
  if (path.ends_with(".csv")) return content.substr(content.find("\nframe,"));
  return content.substr(content.find('\n') + 1);
}

// Points are found in the frames for one of them and not for the other.
TEST(CliTrack, TrackersSideBySideWriteWhatTheyWriteAlone) {
  const Folder folder;
  const auto track = [&](const std::string& arguments, const std::string& to) {
    const std::string outs = " --out " + (folder / to) + ".csv --out " + (folder / to) + ".jsonl";
    const Result result = glint(
        folder, "track scene:ir-clip --set scenes.ir-clip.frames=24 --quiet " + arguments + outs);
    ASSERT_EQ(result.code, 0) << result.err;
  };
  const std::string points = " --tracker pmht-imm --set points.threshold=4";
  track("--threads 2 --tracker mm-phd", "alone.mm-phd");
  track("--threads 2" + points, "alone.pmht-imm");
  for (const std::string threads : {"1", "2"}) {
    track("--threads " + threads + " --tracker mm-phd" + points, "both");
    for (const std::string file :
         {"mm-phd.csv", "mm-phd.jsonl", "pmht-imm.csv", "pmht-imm.jsonl"}) {
      const std::string said = said_of_tracks(folder / ("both." + file));
      EXPECT_GT(std::ranges::count(said, '\n'), 20) << file;
      EXPECT_EQ(said, said_of_tracks(folder / ("alone." + file)))
          << file << ", threads " << threads;
    }
  }
}

TEST(CliTrack, TakesItsPointsFromTheDetectorThatIsSet) {
  const Folder folder;
  const auto track = [&](const std::string& detector) {
    const std::string out = folder / (detector + ".csv");
    const Result result =
        glint(folder,
              "track scene:ir-clip --set scenes.ir-clip.frames=24 --quiet "
              "--tracker pmht-imm --set points.threshold=4 --set points.detector=" +
                  detector + " --out " + out);
    EXPECT_EQ(result.code, 0) << result.err;
    return said_of_tracks(out);
  };
  const std::string matched = track("matched-filter"), wavelet = track("wavelet");
  EXPECT_GT(std::ranges::count(wavelet, '\n'), 5);
  EXPECT_NE(wavelet, matched);
}

TEST(CliTrack, WhatWasEstimatedStandsInTheHeader) {
  const Folder folder;
  std::string outs;
  for (const char* name : {"t.csv", "t.jsonl", "t.mot.txt"}) outs += " --out " + (folder / name);
  ASSERT_EQ(
      glint(folder, "track scene:crossing --tracker smc-phd --set psf_sigma=auto" + outs).code, 0);
  const std::string csv = content_of(folder / "t.csv");
  EXPECT_TRUE(estimates_head(csv));
  EXPECT_LT(csv.find("psf_sigma = ", csv.find("## estimated")), csv.find("\nframe,"));
  const std::string json = content_of(folder / "t.jsonl");
  const auto line = nlohmann::json::parse(json.substr(0, json.find('\n')));
  EXPECT_EQ(line["estimated"].size(), 3u) << line;
  EXPECT_TRUE(has(content_of(folder / "t.mot.txt.toml"), "# estimated: noise sigma"));
}

TEST(CliTrack, WithoutARunsConfigurationJsonIsRefused) {
  const Folder folder;
  folder.write("t.jsonl", "{\"frame\":0}\n");
  expect_error(glint(folder, "track scene:noise --config " + (folder / "t.jsonl")), 2, "t.jsonl");
}

TEST(CliTrack, AFailureKeepsWhatWasTracked) {
  const Folder folder;
  const Result result = glint(folder, cubes_that_fail(folder) + "--out " + (folder / "t.csv"));
  expect_error(result, 1, "33x32");
  EXPECT_TRUE(estimates_head(content_of(folder / "t.csv")));
}

TEST(CliTrack, AnOutputThatFailsKeepsNoOtherFromItsEnd) {
  const Folder folder;
  const Result result =
      glint(folder, "track scene:noise --tracker smc-phd --out " + full_disk(folder, "full.csv") +
                        " --out " + (folder / "t.csv"));
  EXPECT_EQ(result.code, 1);
  EXPECT_TRUE(has(result.err, "glint: " + (folder / "full.csv"))) << result.err;
  EXPECT_TRUE(estimates_head(content_of(folder / "t.csv")));
}

// The revised record is all that such a file gets, so that it fails only at the end.
TEST(CliTrack, TheFirstErrorIsTheOneReported) {
  const Folder folder;
  const Result result =
      glint(folder, cubes_that_fail(folder) + "--revised --out " + full_disk(folder, "full.csv"));
  EXPECT_EQ(result.code, 1);
  EXPECT_TRUE(has(result.err, "glint: warning: " + (folder / "full.csv"))) << result.err;
  EXPECT_TRUE(has(result.err.substr(result.err.find('\n')), "33x32")) << result.err;
}

TEST(CliTrack, PointsFarFromTheOriginKeepTheirDigits) {
  const Folder folder;
  std::string rows = "time,x,y\n";
  for (int k = 0; k < 20; ++k) {
    const std::string end = std::to_string(k % 10) + "5\n";  // 0.1 a second, and .05
    rows += std::to_string(2000000000 + k) + ".000001,1397634160.25," +
            std::to_string(356785130 + k / 10) + '.' + end;
  }
  const std::string points = folder.write("p.csv", rows), tracks = folder / "t.csv";
  ASSERT_EQ(glint(folder, "track " + points + " --tracker imm-jpda --quiet --out " + tracks).code,
            0);
  const TrackPoint last = read_tracks(tracks).back();
  EXPECT_NEAR(last.time, 2000000019.000001, 3e-7);
  EXPECT_NEAR(last.x, 1397634160.25, 1e-3);
  EXPECT_NEAR(last.y, 356785131.95, 1e-3);
}

TEST(CliTrack, CovariancesOfVelocitiesAreInPixelsAndSeconds) {
  const Folder folder;
  const std::string clip = folder / "clip";
  ASSERT_EQ(glint(folder, "simulate crossing --seed 3 --format npy --out " + clip).code, 0);
  const auto tracked = [&](const std::string& fps) {
    const std::string out = folder / ("at" + fps + ".csv");
    EXPECT_EQ(glint(folder, "track " + clip +
                                "/frames.npy --tracker mm-phd --seed 5 --covariance "
                                "--fps " +
                                fps + " --out " + out)
                  .code,
              0);
    return read_tracks(out);
  };
  const std::vector<TrackPoint> slow = tracked("1"), fast = tracked("25");
  ASSERT_EQ(slow.size(), fast.size());
  ASSERT_GT(slow.size(), 20u);
  for (std::size_t i = 0; i < slow.size(); ++i) {
    EXPECT_GT(slow[i].var_vx, 0);
    EXPECT_NEAR(fast[i].var_vx / (625 * slow[i].var_vx), 1, 1e-6);
    EXPECT_NEAR(fast[i].var_vy / (625 * slow[i].var_vy), 1, 1e-6);
    EXPECT_NEAR(fast[i].cov_vx_vy, 625 * slow[i].cov_vx_vy, 1e-6 * fast[i].var_vx);
    EXPECT_NEAR(fast[i].cov_x_vx, 25 * slow[i].cov_x_vx, 1e-6 * std::abs(fast[i].cov_x_vx));
    EXPECT_NEAR(fast[i].cov_y_vy, 25 * slow[i].cov_y_vy, 1e-6 * std::abs(fast[i].cov_y_vy));
    EXPECT_EQ(fast[i].var_x, slow[i].var_x);
  }
}

TEST(CliTrack, EachTrackersFileHasTheCovarianceAskedFor) {
  const Folder folder;
  const std::string plain = " --tracker smc-phd --tracker viterbi --seed 5 --out ";
  ASSERT_EQ(glint(folder, "track scene:crossing" + plain + (folder / "p.csv")).code, 0);
  for (const std::string how : {"--covariance", "--covariance --revised"}) {
    ASSERT_EQ(glint(folder, "track scene:crossing " + how + plain + (folder / "c.csv")).code, 0);
    for (const std::string tracker : {"smc-phd", "viterbi"}) {
      EXPECT_TRUE(has(content_of(folder / ("c." + tracker + ".csv")),
                      ",var_x,cov_xy,var_y,cov_x_vx,cov_x_vy,cov_y_vx,cov_y_vy,var_vx,cov_vx_vy,"
                      "var_vy"))
          << how << ' ' << tracker;
      EXPECT_FALSE(has(content_of(folder / ("p." + tracker + ".csv")), "var_vx"));
    }
  }
}

TEST(CliTrack, AnInputWithoutFramesIsAnError) {
  const Folder folder;
  const std::string start("\x93NUMPY\x01\0v\0", 10);
  std::string shape = "{'descr': '<f4', 'fortran_order': False, 'shape': (0, 16, 16), }";
  shape.resize(117, ' ');
  folder.write("empty.npy", start + shape + '\n');
  const std::string out = folder / "t.csv";
  expect_error(glint(folder, "track " + (folder / "empty.npy") + " --tracker smc-phd --out " + out),
               1, "holds no pixels");
  EXPECT_FALSE(fs::exists(out));
}

TEST(CliTrack, WithoutAFrameNoPictureIsLeft) {
  const Folder folder;
  fs::rename(cube(folder, 33, 32, 1, 1, 1), folder / "mask.npy");
  const Result result =
      glint(folder, "track " + cube(folder, 32, 32, 4, 1, 1) + " --tracker smc-phd --mask " +
                        (folder / "mask.npy") + " --overlay " + (folder / "o.mp4") + " --picture " +
                        (folder / "p.png"));
  EXPECT_NE(result.code, 0);
  EXPECT_FALSE(fs::exists(folder / "o.mp4"));
  EXPECT_FALSE(fs::exists(folder / "p.png"));
}

}  // namespace
}  // namespace glint::test
