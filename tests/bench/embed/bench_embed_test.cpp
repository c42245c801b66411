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
  // Over the plain pipeline, and of those that push what the caller does itself.
  std::size_t pushes = 0;
  for (const std::string& way : ways) pushes += way == "C++" || way == "C" || way == "Python";
  EXPECT_EQ(suite["figures"].size(), expected.size() - 1 + pushes);
  for (const auto& figure : suite["figures"]) EXPECT_GT(figure["value"].get<double>(), 0) << figure;
}

}  // namespace
}  // namespace glint::test
