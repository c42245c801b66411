// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/files/tables.hpp"

#include <sys/stat.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "folder.hpp"
#include "glint/frontends/files/track_file.hpp"
#include "glint/frontends/usage_error.hpp"

namespace glint {
namespace {

using test::content_of;
using test::Folder;
using test::has;
using test::message_of;

TrackPoint point(std::int64_t frame, std::int64_t id, double x, TrackStatus status) {
  TrackPoint p;
  p.frame = frame, p.time = 0.5 * static_cast<double>(frame), p.track_id = id;
  p.x = x, p.y = 2 * x, p.status = status, p.existence = 0.75;
  p.mode_probability = {0.25, 0.75};
  return p;
}

TEST(Tables, ColumnsAreFoundByNameAndOthersPassedOver) {
  const Folder folder;
  const auto path = folder.write("t.csv",
                                 "# a comment\nextra,y,x,track_id,frame\n"
                                 "foo,2.5,1.5,7,3\r\n\n# another\n,4,-3e1,8,4\n");
  const auto truth = read_truth(path);
  ASSERT_EQ(truth.size(), 2u);
  EXPECT_EQ(truth[0].frame, 3);
  EXPECT_EQ(truth[0].track_id, 7);
  EXPECT_DOUBLE_EQ(truth[0].x, 1.5);
  EXPECT_DOUBLE_EQ(truth[0].y, 2.5);
  EXPECT_TRUE(std::isnan(truth[0].vx));
  EXPECT_DOUBLE_EQ(truth[1].x, -30);
}

TEST(Tables, AByteOrderMarkIsPassedOver) {
  const Folder folder;
  const auto truth = read_truth(folder.write("t.csv",
                                             "\xEF\xBB\xBF"
                                             "frame,track_id,x,y\n5,1,2,3\n"));
  ASSERT_EQ(truth.size(), 1u);
  EXPECT_EQ(truth[0].frame, 5);
}

TEST(Tables, MistakesAreNamedWithFileAndLine) {
  const Folder folder;
  const auto refused = [&](const std::string& content) {
    const auto path = folder.write("t.csv", content);
    return message_of<std::runtime_error>([&] { read_tracks(path); });
  };
  const std::string head = "frame,track_id,x,y,status\n";
  EXPECT_TRUE(has(refused("frame,x\n1,2\n"), "no column track_id, y"));
  EXPECT_TRUE(has(refused(head + "1,2,3,4,confirmed\n1,2,three,4,confirmed\n"), "t.csv:3: x"));
  EXPECT_TRUE(has(refused(head + "1.5,2,3,4,confirmed\n"), "t.csv:2: frame must be a whole"));
  EXPECT_TRUE(has(refused(head + "1,2,3,4,alive\n"), "tentative, confirmed or halted"));
  EXPECT_TRUE(has(refused(head + "1,2,3\n"), "t.csv:2"));
  EXPECT_TRUE(has(refused("# nothing\n"), "header"));
  EXPECT_TRUE(has(message_of<UsageError>([&] { read_tracks(folder / "no.csv"); }), "no.csv"));
}

TEST(TrackFile, CsvReadsBackAndHoldsConfigurationAndNotes) {
  const Folder folder;
  const std::string path = folder / "t.csv";
  TrackLog log;
  log.set_mode_names({"cv", "ct"});
  log.report(point(0, 1, 1.25, TrackStatus::tentative));
  log.report(point(1, 1, 2.25, TrackStatus::confirmed));
  {
    TrackFile file(path, {"t", "[run]\nseed = 5\n"});
    for (int f : {0, 1}) file.write(log.at(f), log.mode_names());
    file.close(log, {"sigma 3"});
  }
  const std::string text = content_of(path);
  EXPECT_TRUE(has(
      text,
      "\nframe,time,track_id,status,x,y,vx,vy,intensity,existence,var_x,cov_xy,var_y,p_cv,p_ct\n"
      "0,0,1,tentative,1.25,2.5,,,,0.75,,,,0.25,0.75\n"))
      << text;
  EXPECT_TRUE(has(text, "\n# [run]\n# seed = 5\n## estimated: sigma 3\n")) << text;
  EXPECT_LT(text.find("## estimated: sigma 3\n"), text.find("\nframe,"));
  EXPECT_FALSE(has(text, "nothing yet"));
  const auto tracks = read_tracks(path);
  ASSERT_EQ(tracks.size(), 2u);
  EXPECT_EQ(tracks[1].status, TrackStatus::confirmed);
  EXPECT_DOUBLE_EQ(tracks[1].time, 0.5);
  EXPECT_TRUE(std::isnan(tracks[1].vx));
}

/// Known to 1, 2, 3, ... in the order of StateCovariance::fields().
TrackPoint with_covariance(TrackPoint p) {
  p.set_covariance({1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
  return p;
}

TEST(TrackFile, CsvHasTheVelocitysCovarianceIfAskedFor) {
  const Folder folder;
  const std::vector points{with_covariance(point(0, 1, 1.25, TrackStatus::confirmed))};
  TrackLog log;
  log.set_mode_names({"cv", "ct"});
  log.report(points[0]);
  for (const bool revised : {false, true}) {
    const std::string path = folder / "t.csv";
    TrackFile file(path, {"t", ""}, {revised, true});
    file.write(points, log.mode_names());
    file.close(log, {});
    EXPECT_TRUE(has(content_of(path),
                    ",var_x,cov_xy,var_y,cov_x_vx,cov_x_vy,cov_y_vx,cov_y_vy,var_vx,cov_vx_vy,"
                    "var_vy,p_cv,p_ct\n"
                    "0,0,1,confirmed,1.25,2.5,,,,0.75,1,2,3,4,5,6,7,8,9,10,0.25,0.75\n"))
        << content_of(path);
    const TrackPoint read = read_tracks(path).at(0);
    EXPECT_EQ(StateCovariance::fields(read), StateCovariance::fields(points[0]));
  }
  TrackFile(folder / "t.csv", {"t", ""}).write(points, log.mode_names());
  EXPECT_TRUE(has(content_of(folder / "t.csv"), ",var_y,p_cv,p_ct\n"));
  EXPECT_TRUE(has(content_of(folder / "t.csv"), ",0.75,1,2,3,0.25,0.75\n"));
  EXPECT_TRUE(std::isnan(read_tracks(folder / "t.csv").at(0).cov_x_vx));
}

TEST(TrackFile, WhatIsNotKnownOfTheVelocityIsEmpty) {
  const Folder folder;
  const std::string path = folder / "t.csv";
  TrackFile(path, {"t", ""}, {.covariance = true})
      .write(std::vector{point(0, 1, 1.25, TrackStatus::confirmed)}, {});
  EXPECT_TRUE(has(content_of(path), ",0.75,,,,,,,,,,,0.25,0.75\n")) << content_of(path);
  EXPECT_TRUE(std::isnan(read_tracks(path).at(0).var_vy));
}

/// Metres on a map, known to `sd`, at a time since 1970.
TrackPoint far_away(double sd) {
  TrackPoint p = point(0, 4, 0, TrackStatus::confirmed);
  p.x = 10000000.01 + sd, p.y = -5000000.02 - sd, p.time = 2000000000.000001;
  p.var_x = p.var_y = sd * sd;
  return p;
}

TEST(TrackFile, LargeNumbersKeepTheDigitsThatCount) {
  const Folder folder;
  for (const std::string name : {"t.csv", "t.jsonl"}) {
    for (const double sd : {0.02, 2e-6}) {
      const TrackPoint p = far_away(sd);
      TrackFile(folder / name, {"t", ""}).write(std::vector{p}, {});
      const std::string text = content_of(folder / name);
      TrackPoint q;
      if (name == "t.csv") {
        q = read_tracks(folder / name).at(0);
      } else {
        const auto line = nlohmann::json::parse(text.substr(text.find("\n{") + 1));
        q.x = line["x"], q.y = line["y"], q.time = line["time"];
      }
      EXPECT_NEAR(q.x, p.x, 0.051 * sd) << text;
      EXPECT_NEAR(q.y, p.y, 0.051 * sd) << text;
      EXPECT_NEAR(q.time, p.time, 3e-7) << text;
    }
  }
  TrackFile(folder / "t.mot.txt", {"t", ""}).write(std::vector{far_away(0.02)}, {});
  EXPECT_EQ(content_of(folder / "t.mot.txt"), "1,4,9999997.53,-5000002.54,7,7,0.75,-1,-1,-1\n");
}

TEST(TrackFile, ASpreadThatIsNotKnownLeavesAThousandth) {
  const Folder folder;
  TrackPoint p = far_away(0.02);
  p.var_x = p.var_y = TrackPoint::kUnknown;
  TrackFile(folder / "t.csv", {"t", ""}).write(std::vector{p}, {});
  EXPECT_TRUE(has(content_of(folder / "t.csv"),
                  "\n0,2000000000.000001,4,confirmed,10000000.03,-5000000.04,"));
}

TEST(TrackFile, EveryFrameIsThereBeforeTheEnd) {
  const Folder folder;
  TrackFile file(folder / "t.csv", {"t", ""});
  const std::vector points{point(0, 1, 1, TrackStatus::confirmed)};
  file.write(points, {});
  EXPECT_EQ(read_tracks(folder / "t.csv").size(), 1u);
}

TEST(TrackFile, EstimatesThatDoNotFitTheHeaderComeLast) {
  const Folder folder;
  const std::string path = folder / "t.csv", note(2000, 'x');
  TrackFile file(path, {"t", ""});
  file.write(std::vector{point(0, 1, 1, TrackStatus::confirmed)}, {});
  file.close({}, {note});
  EXPECT_TRUE(content_of(path).ends_with("## estimated: " + note + "\n"));
  EXPECT_EQ(read_tracks(path).size(), 1u);
}

TEST(TrackFile, APipeGetsTheEstimatesLast) {
  const Folder folder;
  const std::string path = folder / "t.csv";
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  std::string text;
  std::thread reader([&] { text = content_of(path); });
  {
    TrackFile file(path, {"t", ""});
    file.write(std::vector{point(0, 1, 1, TrackStatus::confirmed)}, {});
    file.close({}, {"sigma 3"});
  }
  reader.join();
  EXPECT_TRUE(has(text, "\n0,0,1,confirmed")) << text;
  EXPECT_TRUE(text.ends_with("## estimated: sigma 3\n")) << text;
}

TEST(TrackFile, LatePointsAreAdded) {
  const Folder folder;
  TrackLog log;
  log.report(point(1, 1, 1, TrackStatus::confirmed));
  TrackFile file(folder / "t.csv", {"t", ""});
  file.write(log.at(1), {});
  log.report(point(0, 1, 0, TrackStatus::confirmed));
  file.close(log, {});
  EXPECT_EQ(read_tracks(folder / "t.csv").size(), 2u);
}

TEST(TrackFile, RevisedReplacesWhatWasReported) {
  const Folder folder;
  TrackLog log;
  log.report(point(0, 1, 1, TrackStatus::tentative));
  log.report(point(0, 2, 1, TrackStatus::tentative));
  TrackFile file(folder / "t.csv", {"t", ""}, {.revised = true});
  file.write(log.at(0), {});
  log.confirm(1, 0);
  log.drop(2, 0);
  file.close(log, {});
  const auto tracks = read_tracks(folder / "t.csv");
  ASSERT_EQ(tracks.size(), 1u);
  EXPECT_EQ(tracks[0].status, TrackStatus::confirmed);
}

TEST(TrackFile, JsonLinesAreObjectsWithTheNamesOfTheColumns) {
  const Folder folder;
  TrackLog log;
  TrackFile file(folder / "t.jsonl", {"t", "[run]\n"});
  file.write(std::vector{with_covariance(point(3, 9, 1.5, TrackStatus::halted)),
                         point(4, 9, 1.5, TrackStatus::halted)},
             {"cv", "ct"});
  file.close(log, {"note"});
  std::istringstream lines(content_of(folder / "t.jsonl"));
  std::vector<nlohmann::json> json;
  for (std::string line; std::getline(lines, line);) json.push_back(nlohmann::json::parse(line));
  ASSERT_EQ(json.size(), 3u);
  EXPECT_EQ(json[0]["config"], "[run]\n");
  EXPECT_EQ(json[1]["frame"], 3);
  EXPECT_EQ(json[1]["status"], "halted");
  EXPECT_EQ(json[1]["x"], 1.5);
  EXPECT_TRUE(json[1]["vx"].is_null());
  EXPECT_EQ(json[1]["p_ct"], 0.75);
  EXPECT_EQ(json[0]["estimated"][0], "note");
  double value = 0;
  for (const char* name : {"var_x", "cov_xy", "var_y", "cov_x_vx", "cov_x_vy", "cov_y_vx",
                           "cov_y_vy", "var_vx", "cov_vx_vy", "var_vy"}) {
    EXPECT_EQ(json[1][name], ++value) << name;
    EXPECT_TRUE(json[2].contains(name) && json[2][name].is_null()) << name;
  }
}

TEST(TrackFile, MotCountsFromOneAndHoldsConfirmedPointsOnly) {
  const Folder folder;
  TrackFile file(folder / "t.mot.txt", {"t", ""});
  file.write(
      std::vector{point(0, 4, 10, TrackStatus::confirmed), point(0, 5, 10, TrackStatus::tentative)},
      {});
  EXPECT_EQ(content_of(folder / "t.mot.txt"), "1,4,7.5,17.5,7,7,0.75,-1,-1,-1\n");
}

TEST(TrackFile, AnUnwritableFileIsFoundOutAtOnce) {
  const Folder folder;
  EXPECT_THROW(TrackFile(folder / "no/such/t.csv", {}), UsageError);
  EXPECT_THROW(TrackFile(folder / "t.xml", {}), UsageError);
}

}  // namespace
}  // namespace glint
