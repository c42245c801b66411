// SPDX-License-Identifier: Apache-2.0
#include "glint/experiments/experiment.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstring>
#include <set>

#include "glint/engine/config.hpp"

namespace glint {
namespace {

void append(double value, std::string& bytes) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

std::string bytes_of(const ExperimentResult& result) {
  std::string bytes;
  for (const ExperimentRow& row : result.rows) {
    bytes += row.name + row.metric;
    append(row.ours, bytes);
    append(row.spread, bytes);
  }
  for (const Curve& curve : result.curves) {
    bytes += curve.level + curve.condition + curve.metric;
    for (const double v : curve.value) append(v, bytes);
  }
  return bytes;
}

ExperimentResult run_with(int threads, std::uint64_t seed) {
  Workers workers(threads);
  ExperimentOptions options;
  options.runs = 2;
  options.seed = seed;
  return run_experiment(find_experiment("phd-5.1"), options, workers);
}

TEST(Experiment, HasTheSameBytesForAnyNumberOfThreads) {
  const tbb::global_control eight(tbb::global_control::max_allowed_parallelism, 8);
  const std::string one = bytes_of(run_with(1, 7));
  EXPECT_EQ(one, bytes_of(run_with(2, 7)));
  EXPECT_EQ(one, bytes_of(run_with(3, 7)));
  EXPECT_NE(one, bytes_of(run_with(1, 8)));
}

TEST(Experiment, TellsEveryRunOfItsProgress) {
  Workers workers(2);
  ExperimentOptions options;
  options.runs = 1;
  std::set<int> seen;
  int total = 0;
  options.progress = [&](int done, int of) { seen.insert(done), total = of; };
  const ExperimentResult result = run_experiment(find_experiment("phd-5.1"), options, workers);
  EXPECT_EQ(static_cast<int>(seen.size()), total);
  EXPECT_EQ(*seen.rbegin(), total);
  EXPECT_EQ(result.name, "phd-5.1");
  EXPECT_EQ(result.runs, 1);
}

TEST(Experiment, NoTwoRowsHaveOneNameAndMetric) {
  std::set<std::string> names;
  const ExperimentResult result = run_with(2, 1);
  for (const ExperimentRow& row : result.rows) {
    EXPECT_TRUE(names.insert(row.name + "/" + row.metric).second) << row.name << row.metric;
  }
  EXPECT_FALSE(names.empty());
}

TEST(Experiment, UnknownNameListsTheKnownOnes) {
  try {
    find_experiment("nothing");
    FAIL();
  } catch (const ConfigError& e) {
    EXPECT_NE(std::string(e.what()).find("phd-5.1"), std::string::npos);
  }
}

TEST(Experiment, BandsIncludeTheirEndsAndRefuseNan) {
  const Band band{1, 2}, open{{}, 2};
  EXPECT_TRUE(band.holds(1));
  EXPECT_TRUE(band.holds(2));
  EXPECT_FALSE(band.holds(2.001));
  EXPECT_TRUE(open.holds(-1e9));
  EXPECT_FALSE(open.holds(NAN));
  ExperimentResult result;
  result.rows = {{"a", "m", 5, 0, {}, {}}};
  EXPECT_TRUE(bands_hold(result));  // no band, no verdict
  result.rows.push_back({"b", "m", 5, 0, {}, band});
  EXPECT_FALSE(bands_hold(result));
}

TEST(Experiment, SummaryLeavesNanOut) {
  const std::vector<double> values{1, NAN, 3}, none{NAN};
  EXPECT_DOUBLE_EQ(summarise(values).mean, 2);
  EXPECT_DOUBLE_EQ(summarise(values).spread, std::sqrt(2.0));
  EXPECT_TRUE(std::isnan(summarise(none).mean));
}

}  // namespace
}  // namespace glint
