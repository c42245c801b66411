// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/files/autoferry.hpp"

#include "folder.hpp"
#include "glint/frontends/usage_error.hpp"

namespace glint {
namespace {

using test::Folder;
using test::has;
using test::message_of;

constexpr const char* kDetections = R"([
  {"sensorID": 3, "time": 1000.0, "ownshipPosition": [1, 2], "measurement": [0.5, 1.5, -2]},
  {"sensorID": 2, "time": 1000.5, "ownshipPosition": [10, 20],
   "measurement": [[1, 2, 3], [100, 200, 300]]},
  {"sensorID": 2, "time": 1001.0, "ownshipPosition": [10, 20], "measurement": [7, 8]},
  {"sensorID": 1, "time": 1001.5, "ownshipPosition": [0, 0], "measurement": [[1], [2]]},
  {"sensorID": 2, "time": 1002.0, "ownshipPosition": [10, 20], "measurement": []}])";
constexpr const char* kTruth = R"([
  [{"targetID": 1, "time": 1000.0, "position": [0, 50, 0]},
   {"targetID": 2, "time": 1000.0, "position": [9, 9, 0]}],
  [{"targetID": 1, "time": 1002.0, "position": [20, 30, 0]},
   {"targetID": 2, "time": 1001.0, "position": [9, 9, 0]}]])";

BoatRecord radar(const Folder& folder) {
  return read_autoferry(folder.write("d.json", kDetections), folder.write("t.json", kTruth),
                        BoatSensor::radar);
}

TEST(Autoferry, GivesTheScansOfOneSensor) {
  const Folder folder;
  const BoatRecord record = radar(folder);
  ASSERT_EQ(record.scans.size(), 3U);
  EXPECT_DOUBLE_EQ(record.scans[0].time, 0.5);
  EXPECT_DOUBLE_EQ(record.scans[2].time, 2);
  EXPECT_EQ(record.scans[0].points.size(), 3U);
  EXPECT_EQ(record.scans[1].points.size(), 1U);
  EXPECT_TRUE(record.scans[2].points.empty());
}

TEST(Autoferry, PointsAreInTheFrameOfTheTruth) {
  const Folder folder;
  const BoatRecord record = radar(folder);
  EXPECT_EQ(record.scans[0].ship.x, 20);
  EXPECT_EQ(record.scans[0].ship.y, 10);
  EXPECT_EQ(record.scans[0].points[1].x, 220);
  EXPECT_EQ(record.scans[0].points[1].y, 12);
  EXPECT_EQ(record.scans[1].points[0].x, 28);
  EXPECT_EQ(record.scans[1].points[0].y, 17);
}

TEST(Autoferry, TruthIsInterpolatedToTheScans) {
  const Folder folder;
  const std::vector<TruthPoint> truth = radar(folder).truth;
  ASSERT_EQ(truth.size(), 6U);
  EXPECT_DOUBLE_EQ(truth[0].x, 45);
  EXPECT_DOUBLE_EQ(truth[0].y, 5);
  EXPECT_EQ(truth[1].track_id, 2);
  EXPECT_EQ(truth[2].frame, 1);
  EXPECT_EQ(truth[2].track_id, 1);
  EXPECT_DOUBLE_EQ(truth[2].x, 40);
  EXPECT_DOUBLE_EQ(truth[2].vx, -10);
  EXPECT_DOUBLE_EQ(truth[2].vy, 10);
  EXPECT_DOUBLE_EQ(truth[4].x, 30);
}

TEST(Autoferry, SaysWhatIsWrong) {
  const Folder folder;
  const std::string truth = folder.write("t.json", kTruth);
  const auto error = [&](const std::string& text) {
    return message_of<std::runtime_error>(
        [&] { read_autoferry(folder.write("d.json", text), truth, BoatSensor::radar); });
  };
  EXPECT_TRUE(has(error("[{\"sensorID\": 2"), "d.json: is no JSON"));
  EXPECT_TRUE(has(error("[]"), "at least one"));
  EXPECT_TRUE(has(error(R"([{"sensorID": 2, "time": 1}])"), "entry 1"));
  EXPECT_TRUE(has(error(R"([{"sensorID": "radar", "time": 1}])"), "entry 1"));
  EXPECT_TRUE(has(message_of<UsageError>(
                      [&] { read_autoferry(folder / "none.json", truth, BoatSensor::radar); }),
                  "none.json"));
}

}  // namespace
}  // namespace glint
