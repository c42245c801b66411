// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/phd/smc_phd.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/dim_targets.hpp"

namespace glint {
namespace {

using namespace test;

/// Settings of P-PHD section 5.1 with the two-frame birth, for a target of `snr` [dB].
SmcPhdConfig paper_config(double snr) {
  SmcPhdConfig c;
  c.psf_sigma = 0.7, c.jitter = 0.5;
  c.snr_low = snr + 20 * std::log10(0.8), c.snr_high = snr + 20 * std::log10(1.2);
  c.intensity_walk = 0.03, c.birth_particles = 2000;
  c.particles_per_target = 4000, c.particles_max = 4000;
  c.identity.separation = 0;
  return c;
}

ScriptedTarget straight(int birth, int death, double x, double vx, double y, double vy,
                        double snr) {
  return target(birth, death, {x, y, vx, vy}, snr);
}

struct Tracked {
  TrackLog log;
  std::vector<double> expected;
};

Tracked track(const Scene& scene, const SmcPhdConfig& config, std::uint64_t seed = 1,
              const Device& device = Device::tbb(1)) {
  Tracked run;
  SmcPhd tracker(config, device, seed);
  for (int k = 0; k < scene.frames; ++k) {
    tracker.step(whitened_scan(scene, seed, k), run.log);
    run.expected.push_back(tracker.expected_targets());
  }
  tracker.finish(run.log);
  return run;
}

double worst_error(const TrackLog& log, const Scene& scene, int from) {
  double worst = 0;
  for (int k = from; k < scene.frames; ++k) {
    for (const auto& t : truth_at(scene, k)) {
      double nearest = 1e9;
      for (const auto& p : log.at(k)) {
        nearest = std::min(nearest, std::hypot(p.x - t.x, p.y - t.y));
      }
      worst = std::max(worst, nearest);
    }
  }
  return worst;
}

TEST(SmcPhd, FollowsOneTargetUnderOneIdentity) {
  const Scene scene = scene_of({straight(2, 24, 6, 0.9, 8, 0.4, 16)});
  const Tracked run = track(scene, paper_config(16));
  EXPECT_EQ(confirmed_ids(run.log).size(), 1u);
  EXPECT_LT(worst_error(run.log, scene, 6), 1.5);
}

TEST(SmcPhd, CountsTheTargetsThatAreThere) {
  const Scene scene =
      scene_of({straight(0, 24, 6, 0.9, 8, 0.4, 16), straight(0, 24, 30, -0.5, 30, -0.6, 16)});
  const Tracked run = track(scene, paper_config(16));
  double mean = 0;
  for (int k = 10; k < 24; ++k) mean += run.expected[static_cast<std::size_t>(k)] / 14;
  EXPECT_NEAR(mean, 2, 0.35);
}

TEST(SmcPhd, SeesNothingInNoise) {
  const Tracked run = track(scene_of({}, 30), paper_config(12));
  double mean = 0;
  for (const double n : run.expected) mean += n / 30;
  EXPECT_LT(mean, 0.1);
  EXPECT_TRUE(confirmed_ids(run.log).empty());
}

TEST(SmcPhd, EndsATrackWhoseTargetVanishes) {
  const Scene scene = scene_of({straight(0, 12, 6, 0.9, 8, 0.4, 18)});
  const Tracked run = track(scene, paper_config(18));
  EXPECT_FALSE(run.log.at(11).empty());
  bool halted = false;
  for (const auto& p : run.log.online()) halted |= p.status == TrackStatus::halted;
  EXPECT_TRUE(halted);
  EXPECT_TRUE(run.log.at(20).empty());
}

TEST(SmcPhd, FollowsATargetAlongTheBorder) {
  const Scene scene = scene_of({straight(0, 24, 5, 0.9, 0, 0, 18)});
  const Tracked run = track(scene, paper_config(18));
  EXPECT_LT(worst_error(run.log, scene, 6), 2.5);
}

TEST(SmcPhd, KeepsTwoCrossingTargetsApart) {
  const Scene scene =
      scene_of({straight(0, 24, 6, 1.1, 10, 0.8, 18), straight(0, 24, 32, -1.1, 10, 0.8, 18)});
  const Tracked run = track(scene, paper_config(18));
  EXPECT_EQ(run.log.at(23).size(), 2u);
}

TEST(SmcPhd, TakesEmptyTinyAndSingleFrames) {
  const SmcPhdConfig config;
  SmcPhd tracker(config, Device::serial(), 1);
  TrackLog log;
  tracker.step(Scan{}, log);
  for (const auto& [w, h] : {std::pair{1, 1}, {3, 2}}) {
    SmcPhd small(config, Device::serial(), 1);
    Scan scan;
    scan.whitened = Frame(Image<float>(w, h));
    small.step(scan, log);
    scan.frame = 1, scan.time = 1;
    small.step(scan, log);
  }
  EXPECT_TRUE(log.online().empty());
}

TEST(SmcPhd, ReportsVelocityInPixelsPerSecond) {
  Scene scene = scene_of({straight(0, 20, 6, 0.9, 8, 0.3, 20)}, 20);
  TrackLog log;
  SmcPhd tracker(paper_config(20), Device::tbb(1), 1);
  for (int k = 0; k < scene.frames; ++k) {
    Scan scan;
    scan.frame = k, scan.time = k * 0.1;  // ten frames a second
    scan.whitened = Frame(render(scene, 5, k));
    tracker.step(scan, log);
  }
  const auto last = log.at(19);
  ASSERT_EQ(last.size(), 1u);
  EXPECT_NEAR(last[0].vx, 9, 3);
  EXPECT_NEAR(last[0].vy, 3, 3);
}

// In noise n rounds to 0 classes of k-means, while any peak of a hundredth of a target counts.
TEST(SmcPhd, MakesTargetsByKmeansOrByPeaks) {
  SmcPhdConfig config = paper_config(12);
  config.existence = 0.01;
  const Scene noise = scene_of({}, 15);
  config.states = StateExtraction::kmeans;
  EXPECT_TRUE(track(noise, config).log.online().empty());
  config.states = StateExtraction::peaks;
  EXPECT_FALSE(track(noise, config).log.online().empty());
}

/// Mean of the reported var_x.
double mean_variance(double noise_adaptation) {
  SmcPhdConfig config = paper_config(18);
  config.process_noise = 0.001, config.noise_adaptation = noise_adaptation;
  const Tracked run = track(scene_of({straight(0, 24, 6, 0.9, 8, 0.4, 18)}), config);
  double sum = 0;
  const auto points = confirmed(run.log.online());
  for (const auto& p : points) sum += p.var_x;
  return sum / static_cast<double>(points.size());
}

// P-PHD (21): particles that contract about a target get more process noise.
TEST(SmcPhd, SpreadsItsParticlesMoreWithAdaptiveNoise) {
  EXPECT_GT(mean_variance(50), 1.2 * mean_variance(1));
}

TEST(SmcPhd, RefusesAnEmptyRangeOfStrengths) {
  SmcPhdConfig c;
  c.snr_low = 10, c.snr_high = 5;
  EXPECT_THROW(SmcPhd(c, Device::serial(), 1), ConfigError);
}

TEST(SmcPhd, FitsThePointSpreadWhenAsked) {
  const Scene scene =
      scene_of({straight(0, 18, 10, 0.2, 10, 0, 30), straight(0, 18, 28, 0.1, 25, 0, 30)}, 18);
  auto config = paper_config(30);
  config.psf_sigma = 0;
  SmcPhd tracker(config, Device::tbb(1), 1);
  TrackLog log;
  for (int k = 0; k < scene.frames; ++k) {
    Scan scan;
    scan.frame = k, scan.time = k;
    scan.whitened = Frame(render(scene, 1, k));
    tracker.step(scan, log);
    const std::string note = tracker.notes().at(0);
    EXPECT_EQ(note.find("default") != std::string::npos, k < 14) << note;
  }
  EXPECT_NEAR(std::stod(tracker.notes().at(0).substr(12)), 0.7, 0.11);
  EXPECT_EQ(log.at(17).size(), 2u);
}

/// First frame of track `id` among `points`.
std::int64_t first_frame(const std::vector<TrackPoint>& points, std::int64_t id) {
  std::int64_t first = 1000;
  for (const TrackPoint& p : points) {
    if (p.track_id == id) first = std::min(first, p.frame);
  }
  return first;
}

// Births all over the frame need frames to gather on a target: by the time that it is confirmed it
// has long been there.
TEST(SmcPhdImproved, FindsWhereAConfirmedTargetWasBeforeItsFirstPeak) {
  const Scene scene = scene_of({straight(4, 30, 10, 0.8, 12, 0.5, 9)}, 30);
  SmcPhdImprovedConfig config;
  static_cast<PhdFilterConfig&>(config) = paper_config(9);
  config.birth = BirthProposal::uniform, config.resample_on = ResampleOn::likelihood;
  int earlier = 0, too_early = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    config.backward_frames = 12;
    const TrackLog log = track(scene, config, seed).log;
    const auto online = log.online(), revised = log.revised();
    for (const TrackPoint& p : online) {
      if (p.status != TrackStatus::confirmed) continue;
      const std::int64_t from = first_frame(revised, p.track_id);
      earlier += from < first_frame(online, p.track_id), too_early += from < 3;
      break;
    }
    config.backward_frames = 0;
    const TrackLog plain = track(scene, config, seed).log;
    EXPECT_EQ(plain.online().size(), online.size());  // what was said at the time stays
    for (const TrackPoint& p : plain.revised()) {
      EXPECT_GE(p.frame, first_frame(plain.online(), p.track_id));
    }
  }
  EXPECT_GE(earlier, 3);
  EXPECT_LE(too_early, 1);
}

// Each track from its own particles: what is added lies on the target that the track follows.
TEST(SmcPhdImproved, TracesEachTargetFromItsOwnPeak) {
  const Scene scene =
      scene_of({straight(0, 30, 30, -0.3, 30, 0, 10), straight(6, 30, 8, 0.6, 10, 0.4, 10)}, 30);
  SmcPhdConfig config = paper_config(10);
  config.birth = BirthProposal::uniform, config.backward_frames = 12;
  config.identity.separation = 6;
  int added = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const TrackLog log = track(scene, config, seed).log;
    for (const TrackPoint& p : log.revised()) {
      if (p.status != TrackStatus::confirmed) continue;
      if (p.frame >= first_frame(log.online(), p.track_id)) continue;
      ++added;
      double nearest = 1000;
      for (const TruthPoint& t : truth_at(scene, static_cast<int>(p.frame))) {
        nearest = std::min(nearest, std::hypot(p.x - t.x, p.y - t.y));
      }
      EXPECT_LT(nearest, 4) << p.frame;
      for (const TrackPoint& other : log.revised()) {
        if (other.frame != p.frame || other.track_id == p.track_id) continue;
        if (other.status != TrackStatus::confirmed) continue;
        EXPECT_GT(std::hypot(p.x - other.x, p.y - other.y), 4) << p.frame;
      }
    }
  }
  EXPECT_GT(added, 0);
}

}  // namespace
}  // namespace glint
