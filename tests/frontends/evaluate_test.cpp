// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli.hpp"
#include "folder.hpp"
#include "glint/frontends/cli/commands.hpp"

namespace glint {
namespace {

using test::Folder;

struct Outcome {
  int code;
  std::string out, err;
};

Outcome glint(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "glint");
  std::vector<char*> argv;
  for (std::string& a : arguments) argv.push_back(a.data());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const int code = cli::run(static_cast<int>(argv.size()), argv.data());
  const std::string out = testing::internal::GetCapturedStdout();
  return {code, out, testing::internal::GetCapturedStderr()};
}

constexpr const char* kTracks =
    "frame,time,track_id,status,x,y,vx,vy,intensity,existence,var_x,cov_xy,var_y\n"
    "1,1,4,confirmed,11,5,,,,,,,\n"
    "2,2,4,confirmed,12,5,,,,,,,\n"
    "2,2,5,tentative,90,90,,,,,,,\n";

TEST(Evaluate, PrintsTheJsonOfTheContract) {
  const Folder folder;
  const std::string truth =
      folder.write("truth.csv", "frame,track_id,x,y\n0,0,10,5\n1,0,11,5\n2,0,12,8\n2,9,50,50\n");
  const std::string tracks = folder.write("tracks.csv", kTracks);
  const Outcome o = glint({"evaluate", "--truth", truth, "--tracks", tracks, "--json"});
  ASSERT_EQ(o.code, 0) << o.err;
  const auto json = nlohmann::json::parse(o.out);
  EXPECT_EQ(json["ospa"]["per_frame"].size(), 3u);
  EXPECT_EQ(json["ospa"]["per_frame"][0], 5.0);
  EXPECT_EQ(json["ospa"]["per_frame"][1], 0.0);
  EXPECT_TRUE(json["gospa"]["missed"].is_number());
  EXPECT_TRUE(json["gospa"]["false"].is_number());
  EXPECT_NEAR(json["rmse"]["0"].get<double>(), std::sqrt(9 / 2.0), 1e-12);
  EXPECT_TRUE(json["rmse"]["9"].is_null());
  EXPECT_EQ(json["tracks"]["truth"], 2);
  EXPECT_EQ(json["tracks"]["detected"], 1);
  EXPECT_EQ(json["tracks"]["false"], 0);
  EXPECT_EQ(json["tracks"]["pd_track"], 0.5);
  EXPECT_EQ(json["detect_delay"]["0"], 1.0);
  EXPECT_TRUE(json["halt_delay"]["9"].is_null());
  EXPECT_EQ(json["points"]["detected"], 0.5);
  EXPECT_EQ(json["points"]["false_per_frame"], 0.0);
}

TEST(Evaluate, TakesTruthOfLabelledBoxes) {
  const Folder folder;
  const std::string truth = folder.write("boxes.csv",
                                         "frame0,linked_id,class,cx,cy,w,h\n0,3,BIRD,10,5,8,8\n"
                                         "1,3,BIRD,11,5,8,8\n2,3,BIRD,12,5,8,8\n");
  const std::string tracks = folder.write("tracks.csv", kTracks);
  const Outcome o = glint({"evaluate", "--truth", truth, "--tracks", tracks, "--json"});
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(nlohmann::json::parse(o.out)["rmse"]["3"], 0.0);
}

TEST(Evaluate, SetsADetectorBesideTheTracks) {
  const Folder folder;
  const std::string truth = folder.write("truth.csv", "frame,track_id,x,y\n1,0,11,5\n2,0,12,5\n");
  const std::string tracks = folder.write("tracks.csv", kTracks);
  const std::string points =
      folder.write("points.csv", "frame,time,x,y,amplitude\n1,1,11,5,9\n2,2,70,5,8\n2,2,12,5,7\n");
  const Outcome o =
      glint({"evaluate", "--truth", truth, "--tracks", tracks, "--baseline", points, "--json"});
  ASSERT_EQ(o.code, 0) << o.err;
  const auto baseline = nlohmann::json::parse(o.out)["baseline"];
  EXPECT_EQ(baseline["threshold"], 9.0);
  EXPECT_EQ(baseline["detected"], 0.5);
  EXPECT_EQ(baseline["false_per_frame"], 0.0);
}

// Thresholds 9, 8 and 7 give 0, 1 and 1 false points in three frames, and find 1, 1 and 2 of two.
TEST(Evaluate, ScoresADetectorAloneAtTheFalsePointsItMayHave) {
  const Folder folder;
  const std::string truth = folder.write("truth.csv", "frame,track_id,x,y\n1,0,11,5\n2,0,12,5\n");
  const std::string points =
      folder.write("points.csv", "frame,time,x,y,amplitude\n1,1,11,5,9\n2,2,70,5,8\n2,2,12,5,7\n");
  const auto score = [&](const std::string& allowed) {
    const Outcome o = glint(
        {"evaluate", "--truth", truth, "--baseline", points, "--false-points", allowed, "--json"});
    EXPECT_EQ(o.code, 0) << o.err;
    const auto json = nlohmann::json::parse(o.out);
    EXPECT_FALSE(json.contains("ospa"));
    return json["baseline"];
  };
  EXPECT_EQ(score("0.3")["detected"], 0.5);
  EXPECT_EQ(score("0.3")["false_per_frame"], 0.0);
  EXPECT_EQ(score("0.34")["detected"], 1.0);
  EXPECT_EQ(score("0.34")["threshold"], 7.0);
  const Outcome table =
      glint({"evaluate", "--truth", truth, "--baseline", points, "--false-points", "1"});
  EXPECT_NE(table.out.find("1.000 detected at 0.333 false"), std::string::npos) << table.out;
  const std::string tracks = folder.write("tracks.csv", kTracks);
  const Outcome both = glint({"evaluate", "--truth", truth, "--tracks", tracks, "--baseline",
                              points, "--false-points", "1", "--json"});
  EXPECT_EQ(nlohmann::json::parse(both.out)["baseline"]["detected"], 1.0);
  EXPECT_EQ(nlohmann::json::parse(both.out)["points"]["detected"], 1.0);
}

TEST(Evaluate, SaysWhatIsToBeScored) {
  const Folder folder;
  const std::string truth = folder.write("truth.csv", "frame,track_id,x,y\n");
  const std::string tracks = folder.write("tracks.csv", kTracks);
  const auto error = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"evaluate", "--truth", truth});
    const Outcome o = glint(more);
    EXPECT_EQ(o.code, 2);
    return o.err;
  };
  EXPECT_NE(error({}).find("give --tracks"), std::string::npos);
  EXPECT_NE(error({"--baseline", tracks}).find("needs --false-points"), std::string::npos);
  EXPECT_NE(error({"--tracks", tracks, "--false-points", "1"}).find("give its points"),
            std::string::npos);
}

// One confirmed point with all of the covariance, whose errors are (1, 2) and (3, 4); one of the
// position's alone; one that is no target's; and a tentative one.
constexpr const char* kStated =
    "frame,track_id,status,x,y,vx,vy,existence,var_x,cov_xy,var_y,"
    "cov_x_vx,cov_x_vy,cov_y_vx,cov_y_vy,var_vx,cov_vx_vy,var_vy\n"
    "0,4,confirmed,11,7,3,4,.9,4,1,2,0,0,0,0,9,0,4\n"
    "1,4,confirmed,11,7,3,4,.8,1,0,1,,,,,,,\n"
    "1,5,confirmed,90,90,0,0,.3,1,0,1,0,0,0,0,1,0,1\n"
    "1,6,tentative,10,5,,,.7,,,,,,,,,,\n";

nlohmann::json stated(const Folder& folder, const std::string& truth) {
  const Outcome o = glint({"evaluate", "--truth", folder.write("truth.csv", truth), "--tracks",
                           folder.write("tracks.csv", kStated), "--json"});
  EXPECT_EQ(o.code, 0) << o.err;
  return nlohmann::json::parse(o.out);
}

TEST(Evaluate, SaysHowTrueTheStatedCovariancesAndExistenceAre) {
  const Folder folder;
  const auto json = stated(folder, "frame,track_id,x,y,vx,vy\n0,0,10,5,0,0\n1,0,10,5,0,0\n");
  EXPECT_NEAR(json["position_nees"]["mean"].get<double>(), (2 + 5) / 2.0, 1e-12);
  EXPECT_EQ(json["position_nees"]["points"], 2);
  EXPECT_NEAR(json["state_nees"]["mean"].get<double>(), 2 + 1 + 4, 1e-12);
  EXPECT_EQ(json["state_nees"]["points"], 1);
  EXPECT_NEAR(json["brier"].get<double>(), (.01 + .04 + .09 + .09) / 4, 1e-12);
  EXPECT_NEAR(json["brier_of_base_rate"].get<double>(), .75 * .25, 1e-12);
}

TEST(Evaluate, LeavesOutWhatIsNotKnown) {
  const Folder folder;
  const auto placed = stated(folder, "frame,track_id,x,y\n0,0,10,5\n1,0,10,5\n");
  EXPECT_EQ(placed["position_nees"]["points"], 2);
  EXPECT_TRUE(placed.contains("state_nees") && placed["state_nees"].is_null());
  const auto table = [&](const std::string& tracks, const char* cutoff) {
    return glint({"evaluate", "--truth", folder / "truth.csv", "--tracks", tracks, "--cutoff",
                  cutoff})
        .out;
  };
  const std::string known = table(folder / "tracks.csv", "5");
  EXPECT_TRUE(test::has(known, "NEES of position           3.500 over 2 points")) << known;
  EXPECT_FALSE(test::has(known, "NEES of state")) << known;
  EXPECT_TRUE(test::has(known, "Brier's score of existence 0.057 over 4 points, 0.188")) << known;
  // Nothing but the tentative point lies that close.
  const std::string close = table(folder / "tracks.csv", "1");
  EXPECT_FALSE(test::has(close, "NEES")) << close;
  const std::string bare = folder.write("bare.csv", "frame,track_id,x,y\n0,1,10,5\n");
  const std::string silent = table(bare, "5");
  EXPECT_TRUE(test::has(silent, "false points per frame") && !test::has(silent, "Brier"));
  const auto json = nlohmann::json::parse(
      glint({"evaluate", "--truth", folder / "truth.csv", "--tracks", bare, "--json"}).out);
  for (const char* key : {"position_nees", "state_nees", "brier", "brier_of_base_rate"}) {
    EXPECT_TRUE(json.contains(key) && json[key].is_null()) << key;
  }
}

TEST(Evaluate, NamesWhatIsMissing) {
  const Folder folder;
  const std::string truth = folder.write("truth.csv", "frame,track_id,x\n");
  const std::string tracks = folder.write("tracks.csv", kTracks);
  const Outcome o = glint({"evaluate", "--truth", truth, "--tracks", tracks});
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.err.find("y or cy"), std::string::npos) << o.err;
  EXPECT_EQ(glint({"evaluate", "--truth", folder / "none.csv", "--tracks", tracks}).code, 2);
  EXPECT_EQ(glint({"evaluate", "--truth", truth, "--tracks", tracks, "--cutoff", "0"}).code, 2);
}

TEST(ExperimentCommand, PrintsTheJsonOfTheContractAndWritesTheCurves) {
  const Folder folder;
  const test::Result o =
      test::glint(folder, "experiment phd-5.1 --runs 1 --seed 3 --threads 1 --json --out " +
                              (folder / "curves"));
  const auto json = nlohmann::json::parse(o.out);
  EXPECT_EQ(json["experiment"], "phd-5.1");
  EXPECT_EQ(json["runs"], 1);
  EXPECT_EQ(json["seed"], 3);
  bool all_inside = true;
  for (const auto& row : json["rows"]) {
    EXPECT_TRUE(row["name"].is_string() && row["metric"].is_string());
    EXPECT_TRUE(row["paper"].is_null());
    EXPECT_EQ(row["band"].is_null(), row["inside"].is_null());
    if (!row["band"].is_null()) {
      EXPECT_EQ(row["band"].size(), 2u);
    }
    if (row["inside"].is_boolean()) all_inside = all_inside && row["inside"].get<bool>();
  }
  EXPECT_EQ(o.code, all_inside ? 0 : 1) << o.err;
  std::ifstream csv(folder / "curves/phd-5.1.csv");
  std::string comment, header, first;
  std::getline(csv, comment), std::getline(csv, header), std::getline(csv, first);
  EXPECT_EQ(header, "frame,condition,level,ospa,rmse,n");
  EXPECT_TRUE(first.starts_with("1,\"standard\",\"12 dB\",")) << first;
}

TEST(ExperimentCommand, RefusesAnUnknownNameAndAFolderThatCannotBe) {
  const Folder folder;
  const test::Result unknown = test::glint(folder, "experiment nothing");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.err.find("phd-5.1"), std::string::npos);
  const std::string file = folder.write("file", "");
  EXPECT_EQ(test::glint(folder, "experiment phd-5.1 --runs 1 --out " + file + "/x").code, 2);
}

}  // namespace
}  // namespace glint
