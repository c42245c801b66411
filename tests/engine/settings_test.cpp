// SPDX-License-Identifier: Apache-2.0
// Settings as programs give them: nothing can be wrong in silence.
#include "glint/engine/settings.hpp"

#include <gtest/gtest.h>

#include <glint/glint.hpp>

#include "glint/engine/run_config.hpp"
#include "glint/engine/trackers/phd/mm_phd.hpp"
#include "glint/engine/trackers/registry.hpp"

namespace glint {
namespace {

std::string fault_of(std::string_view trackers, const Settings& settings) {
  try {
    const Scheduler scheduler(trackers, settings);
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "accepted";
}

template <class Make>
std::string fault_of(const Make& make) {
  try {
    make();
  } catch (const std::exception& e) {
    return e.what();
  }
  return "accepted";
}

TEST(Settings, AreFoundByTheirLastPart) {
  EXPECT_EQ(fault_of("mm-phd", {}), "accepted");
  EXPECT_EQ(fault_of("mm-phd", {{"snr_low", 6},
                                {"seed", 1U},
                                {"frames.polarity", "dark"},
                                {"ring", false},
                                {"trackers.mm-phd.existence", 0.25},
                                {"profile", "L"}}),
            "accepted");
  std::vector<ConfigSection> all = all_sections();
  apply_settings({{"snr_low", 5}, {"tracker", "mm-phd"}, {"profile", "L"}, {"seed", 3}}, all);
  EXPECT_EQ(section_named(all, "trackers.mm-phd").as<MmPhdConfig>().snr_low, 5)
      << "a setting goes before the profile";
  EXPECT_EQ(section_named(all, "run").as<RunConfig>().seed, 3);
}

TEST(Settings, WrongOnesAreRefusedWithTheRemedy) {
  EXPECT_EQ(fault_of("mm-phd", {{"background", "Temporal"}}),
            "frames.background must be temporal, registered, spatial or none, got \"Temporal\"");
  EXPECT_EQ(fault_of("mm-phd", {{"existence", 7}}),
            "trackers.mm-phd.existence must be in [0.01, 1], got 7");
  EXPECT_EQ(fault_of("mm-phd", {{"existance", 0.5}}),
            "unknown key existance: did you mean existence?");
  EXPECT_EQ(fault_of("mm-phd", {{"trackers.h-pmht.batch", 5}}),
            "trackers.h-pmht.batch has no effect: a run with tracker \"mm-phd\" does not read it; "
            "leave it out");
  EXPECT_TRUE(fault_of("mm-phd", {{"device", "cuda"}}).starts_with("run.device: "));
  EXPECT_EQ(fault_of("mm-phd", {{"tracker", "viterbi"}}),
            "trackers are named by the first argument; leave the setting tracker out");
  EXPECT_EQ(fault_of("", {}), "no tracker is named; name one, for example mm-phd");
  EXPECT_EQ(fault_of("mm-phd", {{"size", "640x512"}}),
            "run.size has no effect on frames that are pushed: a frame says its size itself");
  EXPECT_EQ(fault_of("mm-phd", {{"fps", 30}}),
            "run.fps has no effect on frames that are pushed: give each frame its time");
}

TEST(Settings, StructsOfACallerAreCheckedByTheConstructors) {
  const Device device = Device::serial();
  MmPhdConfig config;
  config.existence = 7;
  EXPECT_EQ(fault_of([&] { MmPhd(config, device, 1); }), "existence must be in [0.01, 1], got 7");
  FramesConfig frames;
  frames.clip_high = 1e9;
  EXPECT_EQ(fault_of([&] { FramePreparer(frames, device); }),
            "clip_high must be in [0.1, 1000], got 1e9");
  PointsConfig points;
  points.radius = 0;
  EXPECT_EQ(fault_of([&] { PointFinder(points, device); }), "radius must be in [1, 100], got 0");
}

TEST(Settings, EveryTrackerRefusesAnothersSectionAndAValueOutOfRange) {
  const Device device = Device::serial();
  for (const TrackerEntry& tracker : all_trackers()) {
    const ConfigSection others =
        find_tracker(tracker.name == "viterbi" ? "h-pmht" : "viterbi").config();
    EXPECT_THROW(tracker.make(others, device, 1), ConfigError) << tracker.name;
    ConfigSection own = tracker.config();
    for (ConfigField& field : own.fields()) {
      if (auto* const* value = std::get_if<double*>(&field.value)) {
        **value = field.high + 1 + std::abs(field.high);  // past the reader, as a program may
        break;
      }
    }
    EXPECT_THROW(tracker.make(own, device, 1), ConfigError) << tracker.name;
  }
}

}  // namespace
}  // namespace glint
