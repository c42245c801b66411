// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/config.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace glint {
namespace {

enum class Sky { clear, cloudy };

struct TestSettings {
  Sky sky = Sky::clear;
  bool online = true;
  int birth_particles = 1000;
  double survival = 0.99;
  std::string polarity = "bright";
  std::string label = "a";
};

void describe(FieldList& list, TestSettings& s) {
  list("online", s.online, "report at once");
  list("birth_particles", s.birth_particles, 1, 10'000'000, "", "particles born a frame");
  list("survival", s.survival, 0, 1, "", "probability of surviving a frame");
  list("polarity", s.polarity, {"bright", "dark", "both"}, "sign of targets");
  list("label", s.label, {}, "any text");
  list("sky", s.sky, {{"clear", Sky::clear}, {"cloudy", Sky::cloudy}}, "weather");
}

struct ConfigTest : ::testing::Test {
  ConfigSection section = ConfigSection::of<TestSettings>("trackers.test");
  const TestSettings& settings = section.as<TestSettings>();

  ConfigField& field(const std::string& key) {
    for (ConfigField& f : section.fields()) {
      if (f.key == key) return f;
    }
    throw std::out_of_range(key);
  }
  std::string refusal(const std::string& key, const ConfigValue& value) {
    try {
      assign(field(key), value);
    } catch (const ConfigError& e) {
      return e.what();
    }
    return "accepted";
  }
  std::string text_refusal(const std::string& key, const std::string& text) {
    try {
      assign_text(field(key), text);
    } catch (const ConfigError& e) {
      return e.what();
    }
    return "accepted";
  }
};

TEST_F(ConfigTest, SectionOwnsItsStructAndItsDefaults) {
  EXPECT_EQ(section.name(), "trackers.test");
  EXPECT_EQ(section.fields().size(), 6u);
  EXPECT_EQ(settings.birth_particles, 1000);
  const ConfigSection other = ConfigSection::of("x", TestSettings{.birth_particles = 7});
  EXPECT_EQ(other.as<TestSettings>().birth_particles, 7);
}

TEST_F(ConfigTest, AssignsEachType) {
  assign(field("online"), false);
  assign(field("birth_particles"), std::int64_t{5});
  assign(field("survival"), 0.5);
  assign(field("polarity"), std::string("both"));
  assign(field("label"), std::string("anything"));
  EXPECT_FALSE(settings.online);
  EXPECT_EQ(settings.birth_particles, 5);
  EXPECT_EQ(settings.survival, 0.5);
  EXPECT_EQ(settings.polarity, "both");
  EXPECT_EQ(settings.label, "anything");
}

TEST_F(ConfigTest, TakesWholeNumbersOfEitherKind) {
  assign(field("survival"), std::int64_t{1});
  assign(field("birth_particles"), 1e5);
  EXPECT_EQ(settings.survival, 1.0);
  EXPECT_EQ(settings.birth_particles, 100'000);
}

TEST_F(ConfigTest, RangeIncludesItsEnds) {
  assign(field("birth_particles"), std::int64_t{10'000'000});
  EXPECT_EQ(settings.birth_particles, 10'000'000);
  assign(field("survival"), 0.0);
  EXPECT_EQ(settings.survival, 0.0);
}

TEST_F(ConfigTest, OutOfRangeNamesKeyRangeAndValue) {
  EXPECT_EQ(refusal("birth_particles", std::int64_t{0}),
            "birth_particles must be in [1, 1e7], got 0");
  EXPECT_EQ(refusal("birth_particles", std::int64_t{1} << 40),
            "birth_particles must be in [1, 1e7], got 1099511627776");
  EXPECT_EQ(refusal("survival", 1.5), "survival must be in [0, 1], got 1.5");
  EXPECT_EQ(refusal("survival", std::numeric_limits<double>::quiet_NaN()),
            "survival must be in [0, 1], got nan");
  EXPECT_EQ(settings.birth_particles, 1000);
  EXPECT_EQ(settings.survival, 0.99);
}

TEST_F(ConfigTest, WrongTypeSaysWhatIsTaken) {
  EXPECT_EQ(refusal("online", std::int64_t{1}), "online must be true or false, got 1");
  EXPECT_EQ(refusal("birth_particles", 1.5),
            "birth_particles must be a whole number in [1, 1e7], got 1.5");
  EXPECT_EQ(refusal("birth_particles", true),
            "birth_particles must be a number in [1, 1e7], got true");
  EXPECT_EQ(refusal("survival", std::string("high")),
            "survival must be a number in [0, 1], got \"high\"");
  EXPECT_EQ(refusal("label", 2.0), "label must be a text in quotes, got 2");
}

TEST_F(ConfigTest, UnknownChoiceListsTheChoices) {
  EXPECT_EQ(refusal("polarity", std::string("up")),
            "polarity must be bright, dark or both, got \"up\"");
}

TEST_F(ConfigTest, EnumerationsAreNamed) {
  EXPECT_EQ(to_toml(field("sky")), "\"clear\"");
  EXPECT_EQ(allowed(field("sky")), "clear or cloudy");
  assign_text(field("sky"), "cloudy");
  EXPECT_EQ(settings.sky, Sky::cloudy);
  EXPECT_EQ(to_toml(field("sky")), "\"cloudy\"");
  EXPECT_EQ(refusal("sky", std::string("Cloudy")), "sky must be clear or cloudy, got \"Cloudy\"");
  EXPECT_EQ(refusal("sky", std::int64_t{1}), "sky must be clear or cloudy, got 1");
  EXPECT_EQ(settings.sky, Sky::cloudy);
}

std::string fault_of(const TestSettings& settings) {
  try {
    valid(settings);
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "valid";
}

TEST(ValidConfig, StructsFilledByProgramsAreHeldToTheSameRanges) {
  EXPECT_EQ(fault_of({}), "valid");
  EXPECT_EQ(fault_of({.birth_particles = 0}), "birth_particles must be in [1, 1e7], got 0");
  EXPECT_EQ(fault_of({.survival = 7}), "survival must be in [0, 1], got 7");
  EXPECT_EQ(fault_of({.survival = std::numeric_limits<double>::quiet_NaN()}),
            "survival must be in [0, 1], got nan");
  EXPECT_EQ(fault_of({.polarity = "Bright"}),
            "polarity must be bright, dark or both, got \"Bright\"");
  EXPECT_EQ(fault_of({.sky = static_cast<Sky>(7)}),
            "sky must be clear or cloudy, got \"another value\"");
  EXPECT_EQ(valid(TestSettings{.survival = 0.5}).survival, 0.5);
}

TEST_F(ConfigTest, ASectionIsOfItsOwnTypeOnly) {
  struct Other {};
  EXPECT_THROW(section.as<Other>(), ConfigError);
  EXPECT_EQ(section.as<TestSettings>().birth_particles, 1000);
}

TEST_F(ConfigTest, ReadsTextAsTheFieldsType) {
  assign_text(field("online"), "false");
  assign_text(field("birth_particles"), "1e4");
  assign_text(field("survival"), "0.25");
  assign_text(field("label"), "true");
  EXPECT_FALSE(settings.online);
  EXPECT_EQ(settings.birth_particles, 10'000);
  EXPECT_EQ(settings.survival, 0.25);
  EXPECT_EQ(settings.label, "true");
}

TEST_F(ConfigTest, RefusesTextThatIsNotTheFieldsType) {
  EXPECT_EQ(text_refusal("birth_particles", "12x"),
            "birth_particles must be a number in [1, 1e7], got \"12x\"");
  EXPECT_EQ(text_refusal("birth_particles", ""),
            "birth_particles must be a number in [1, 1e7], got \"\"");
  EXPECT_EQ(text_refusal("online", "yes"), "online must be true or false, got \"yes\"");
}

TEST_F(ConfigTest, TomlTextIsExactAndTyped) {
  EXPECT_EQ(to_toml(field("online")), "true");
  EXPECT_EQ(to_toml(field("birth_particles")), "1000");
  EXPECT_EQ(to_toml(field("survival")), "0.99");
  assign(field("survival"), 1.0);
  EXPECT_EQ(to_toml(field("survival")), "1.0");
  assign(field("survival"), 1e-9);
  EXPECT_EQ(to_toml(field("survival")), "1e-9");
  assign(field("survival"), 1.0 / 3);
  EXPECT_EQ(std::stod(to_toml(field("survival"))), 1.0 / 3);
  assign(field("label"), std::string("a \"b\"\\\n"));
  EXPECT_EQ(to_toml(field("label")), "\"a \\\"b\\\"\\\\\\u000A\"");
}

TEST_F(ConfigTest, SaysWhatIsAllowed) {
  EXPECT_EQ(allowed(field("online")), "true or false");
  EXPECT_EQ(allowed(field("birth_particles")), "[1, 1e7]");
  EXPECT_EQ(allowed(field("polarity")), "bright, dark or both");
  EXPECT_EQ(allowed(field("label")), "");
}

TEST(Config, TakesAutoForAnAutomaticNumber) {
  double width = 1;
  FieldList list;
  list.automatic("psf_sigma", width, 0, 2.5, "px", "width");
  ConfigField& field = list.fields()[0];
  assign_text(field, "auto");
  EXPECT_EQ(width, 0);
  EXPECT_EQ(to_toml(field), "\"auto\"");
  assign(field, 1.5);
  EXPECT_EQ(to_toml(field), "1.5");
  EXPECT_THROW(assign_text(field, "wide"), ConfigError);
}

}  // namespace
}  // namespace glint
