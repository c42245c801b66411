// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/config/toml.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "glint/frontends/usage_error.hpp"

namespace glint {
namespace {

struct FrameSettings {
  std::string polarity = "bright";
  double threshold = 4;
};
void describe(FieldList& list, FrameSettings& s) {
  list("polarity", s.polarity, {"bright", "dark", "both"}, "sign of targets");
  list("threshold", s.threshold, 0, 100, "sigmas", "of a point");
}

struct TrackerSettings {
  int birth_particles = 1000;
  double survival = 0.99;
  bool online = true;
  double threshold = 1.0 / 3;
  std::string label = "a \"b\"\\";
};
void describe(FieldList& list, TrackerSettings& s) {
  list("birth_particles", s.birth_particles, 1, 10'000'000, "", "particles born\na frame");
  list("survival", s.survival, 0, 1, "", "probability of surviving a frame");
  list("online", s.online, "report at once");
  list("threshold", s.threshold, 0, 1, "", "existence that confirms");
  list("label", s.label, {}, "any text");
}

struct TomlTest : ::testing::Test {
  std::vector<ConfigSection> sections{ConfigSection::of<FrameSettings>("frames"),
                                      ConfigSection::of<TrackerSettings>("trackers.smc-phd")};
  const FrameSettings& frames = sections[0].as<FrameSettings>();
  const TrackerSettings& tracker = sections[1].as<TrackerSettings>();

  template <class F>
  static std::string message(const F& f) {
    try {
      f();
    } catch (const ConfigError& e) {
      return e.what();
    }
    return "accepted";
  }
  std::string parse(std::string_view text) {
    return message([&] { parse_toml(text, "f.toml", sections); });
  }
  std::string set(std::string_view text) {
    return message([&] { apply_set(text, sections); });
  }
};

TEST_F(TomlTest, SetsWhatTheFileSaysAndNothingElse) {
  EXPECT_EQ(parse("[frames]\npolarity = \"dark\"\n"
                  "[trackers.smc-phd]\nbirth_particles = 5\nsurvival = 1\nonline = false\n"),
            "accepted");
  EXPECT_EQ(frames.polarity, "dark");
  EXPECT_EQ(frames.threshold, 4);
  EXPECT_EQ(tracker.birth_particles, 5);
  EXPECT_EQ(tracker.survival, 1);
  EXPECT_FALSE(tracker.online);
}

TEST_F(TomlTest, TakesEveryWayOfWritingATable) {
  EXPECT_EQ(parse("frames.polarity = 'both'\ntrackers = {smc-phd = {survival = 0.5}}\n"),
            "accepted");
  EXPECT_EQ(frames.polarity, "both");
  EXPECT_EQ(tracker.survival, 0.5);
}

TEST_F(TomlTest, EmptyFileSaysNothing) {
  const std::string before = write_toml(sections);
  EXPECT_EQ(parse(""), "accepted");
  EXPECT_EQ(parse("# only a comment\n[frames]\n[trackers]\n"), "accepted");
  EXPECT_EQ(write_toml(sections), before);
}

TEST_F(TomlTest, ValueOutOfRangeNamesFileLineKeyAndRange) {
  EXPECT_EQ(parse("\n[trackers.smc-phd]\n\nbirth_particles = 0\n"),
            "f.toml:4: trackers.smc-phd.birth_particles must be in [1, 1e7], got 0");
  EXPECT_EQ(parse("[frames]\npolarity = 'up'\n"),
            "f.toml:2: frames.polarity must be bright, dark or both, got \"up\"");
}

TEST_F(TomlTest, WrongTypeSaysWhatIsTaken) {
  EXPECT_EQ(parse("[trackers.smc-phd]\nsurvival = 'high'\n"),
            "f.toml:2: trackers.smc-phd.survival must be a number in [0, 1], got \"high\"");
  EXPECT_EQ(parse("[frames]\nthreshold = [1, 2]\n"),
            "f.toml:2: frames.threshold must be a single value, got an array");
  EXPECT_EQ(parse("[frames]\nthreshold = 2020-01-01\n"),
            "f.toml:2: frames.threshold must be a single value, got a date or time");
}

TEST_F(TomlTest, UnknownKeyNamesTheNearestOne) {
  EXPECT_EQ(parse("[trackers.smc-phd]\nbirth_particels = 1\n"),
            "f.toml:2: unknown key trackers.smc-phd.birth_particels: did you mean "
            "trackers.smc-phd.birth_particles?");
  EXPECT_EQ(parse("[frames]\nsurvival = 1\n"),
            "f.toml:2: unknown key frames.survival: did you mean trackers.smc-phd.survival?");
  EXPECT_EQ(parse("\nsurvival = 1\n"),
            "f.toml:2: unknown key survival: did you mean trackers.smc-phd.survival?");
  EXPECT_EQ(parse("[frames]\nxyz = 1\n"),
            "f.toml:2: unknown key frames.xyz: `glint config TRACKER` shows all keys");
}

TEST_F(TomlTest, UnknownSectionNamesTheNearestOne) {
  EXPECT_EQ(parse("[frames]\n[trackers.smc-pdh]\n"),
            "f.toml:2: unknown section [trackers.smc-pdh]: did you mean [trackers.smc-phd]?");
  EXPECT_EQ(parse("[camera]\n"),
            "f.toml:1: unknown section [camera]: use [frames], [trackers.smc-phd]");
}

TEST_F(TomlTest, SyntaxErrorNamesItsLine) {
  EXPECT_EQ(parse("[frames]\npolarity = \n").substr(0, 10), "f.toml:2: ");
  EXPECT_EQ(parse("[frames]\nthreshold = 1\nthreshold = 2\n").substr(0, 10), "f.toml:3: ");
  EXPECT_EQ(parse("[frames]\npolarity = '\xff'\n").substr(0, 10), "f.toml:2: ");
}

TEST_F(TomlTest, ReadsAFile) {
  const auto path = std::filesystem::path(testing::TempDir()) / "glint_toml_test.toml";
  std::ofstream(path) << "[frames]\nthreshold = 7\n";
  read_toml(path.string(), sections);
  std::filesystem::remove(path);
  EXPECT_EQ(frames.threshold, 7);
}

TEST_F(TomlTest, MissingFileIsNamedWithTheRemedy) {
  for (const std::string path : {"no/such/file.toml", "/"}) {
    try {
      read_toml(path, sections);
      ADD_FAILURE() << path << " was read";
    } catch (const UsageError& e) {
      EXPECT_TRUE(std::string(e.what()).starts_with(path + " cannot be read")) << e.what();
      EXPECT_NE(std::string(e.what()).find("glint config"), std::string::npos);
    }
  }
}

TEST_F(TomlTest, WrittenFileTeachesAndReadsBack) {
  EXPECT_EQ(write_toml(std::span(sections).first(1)),
            "[frames]\n# sign of targets; bright, dark or both\npolarity = \"bright\"\n"
            "# of a point [sigmas]; [0, 100]\nthreshold = 4.0\n");
  const std::string defaults = write_toml(sections);
  for (const char* change : {"birth_particles=17", "survival=1e-9", "online=false", "label=\t#'",
                             "trackers.smc-phd.threshold=0.1", "polarity=both"}) {
    EXPECT_EQ(set(change), "accepted");
  }
  const std::string changed = write_toml(sections);
  EXPECT_NE(changed, defaults);
  EXPECT_EQ(parse(defaults), "accepted");
  EXPECT_EQ(write_toml(sections), defaults);
  EXPECT_EQ(tracker.threshold, 1.0 / 3);
  EXPECT_EQ(parse(changed), "accepted");
  EXPECT_EQ(write_toml(sections), changed);
}

TEST_F(TomlTest, SetTakesFullAndShortKeys) {
  EXPECT_EQ(set("trackers.smc-phd.birth_particles=3"), "accepted");
  EXPECT_EQ(tracker.birth_particles, 3);
  EXPECT_EQ(set("smc-phd.threshold = 0.5"), "accepted");
  EXPECT_EQ(tracker.threshold, 0.5);
  EXPECT_EQ(set("polarity=dark"), "accepted");
  EXPECT_EQ(frames.polarity, "dark");
  EXPECT_EQ(set("label=a=b"), "accepted");
  EXPECT_EQ(tracker.label, "a=b");
}

TEST_F(TomlTest, SetRefusesWhatDoesNotFit) {
  EXPECT_EQ(set("birth_particles=0"),
            "trackers.smc-phd.birth_particles must be in [1, 1e7], got 0");
  EXPECT_EQ(set("threshold=1"),
            "key threshold is ambiguous: use one of frames.threshold, trackers.smc-phd.threshold");
  EXPECT_EQ(set("polarty=dark"), "unknown key polarty: did you mean polarity?");
  EXPECT_EQ(set("particles=1"), "unknown key particles: `glint config TRACKER` shows all keys");
  EXPECT_EQ(set("polarity"), "'polarity' is no setting: write key=value");
  EXPECT_EQ(set("=1"), "unknown key : `glint config TRACKER` shows all keys");
}

}  // namespace
}  // namespace glint
