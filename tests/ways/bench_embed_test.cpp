// SPDX-License-Identifier: Apache-2.0
// `glint bench embed` measures every way that this build has.
#include <nlohmann/json.hpp>
#include <set>

#include "frontends/cli.hpp"

namespace glint::test {
namespace {

TEST(BenchEmbed, MeasuresEveryWay) {
  const Folder folder;
  const Result run = glint(folder, "bench embed --quick --json");
  ASSERT_EQ(run.code, 0) << run.err;
  const auto suite = nlohmann::json::parse(run.out)["suites"][0];
  std::set<std::string> ways;
  for (const auto& timed : suite["cases"]) {
    EXPECT_GT(timed["seconds"].get<double>(), 0) << timed;
    const std::string name = timed["name"];
    ways.insert(name.substr(0, name.find(',')));
  }
  std::set<std::string> expected{"plain pipeline", "C++", "C", "pipe"};
#ifdef GLINT_PYTHON
  expected.insert("Python");
#endif
#ifdef GLINT_GST_PLUGINS
  expected.insert("GStreamer");
#endif
  EXPECT_EQ(ways, expected);
  EXPECT_EQ(suite["figures"].size(), expected.size() - 1);
}

}  // namespace
}  // namespace glint::test
