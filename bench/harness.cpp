// SPDX-License-Identifier: Apache-2.0
#include "glint/bench/harness.hpp"

#include <time.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>

namespace glint::bench {
namespace {

constexpr double kSampleSeconds = 3e-3;
constexpr double kMinShare = 0.95;  // of a sample that its thread must have had a core
constexpr int kMaxTries = 4;
constexpr int kMinRounds = 3;
constexpr double kMiddle = 0.5, kLowerQuarter = 0.25;

double now() {
  const auto since = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(since).count();
}

void spin() {
  for (int i = 0; i < 400000; ++i) asm volatile("");
}

// Tells whether two cores are free: a spin on each takes hardly longer than one alone.
class Probe {
 public:
  Probe() {
    for (int i = 0; i < 40; ++i) {
      const double start = now();
      spin();
      alone_ = std::min(alone_, now() - start);
    }
  }
  // Three tries, because the second thread may first have to wake up.
  bool two_cores_free() {
    for (int attempt = 0; attempt < 3; ++attempt) {
      const double start = now();
      pair_.for_tiles(2, [](std::size_t) { spin(); });
      if (now() - start < 1.35 * alone_) return true;
    }
    return false;
  }

 private:
  double alone_ = 1e9;
  Workers pair_{2};
};

struct Samples {
  int calls = 1;  // a sample, so that it is long enough for the clock
  std::vector<double> clean, disturbed;
};

double seconds_a_call(const Case& c, int calls) {
  const double start = now();
  for (int i = 0; i < calls; ++i) c.run();
  return (now() - start) / calls;
}

void sample(const Case& c, Probe& probe, Samples& samples) {
  const auto cores_free = [&] { return c.threads < 2 || probe.two_cores_free(); };
  for (int attempt = 0; attempt < kMaxTries; ++attempt) {
    bool clean = cores_free();
    const double before = on_core();
    const double seconds = seconds_a_call(c, samples.calls);
    const double share = (on_core() - before) / (seconds * samples.calls);
    clean = clean && (c.elsewhere || share > kMinShare) && cores_free();
    (clean ? samples.clean : samples.disturbed).push_back(seconds);
    if (clean) return;
  }
}

double quantile(std::vector<double> values, double share) {
  const auto place = static_cast<std::ptrdiff_t>(static_cast<double>(values.size()) * share);
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

bool enough(const Samples& samples) { return samples.clean.size() >= kMinRounds; }

Timing timing(const Case& c, const Samples& samples, bool clean) {
  std::vector<double> used = samples.clean;
  if (!clean) used.insert(used.end(), samples.disturbed.begin(), samples.disturbed.end());
  const double seconds = quantile(used, clean ? kMiddle : kLowerQuarter);
  const int count = static_cast<int>(used.size());
  return {c.name, c.threads, seconds, c.units / seconds, count, enough(samples) ? 0 : count};
}

std::vector<Timing> time_all(const std::vector<Case>& cases, const Budget& budget) {
  static Probe probe;
  std::vector<Samples> samples(cases.size());
  const double start = now();
  for (std::size_t i = 0; i < cases.size(); ++i) {
    cases[i].run();
    const double once = seconds_a_call(cases[i], 1);
    samples[i].calls = std::clamp(static_cast<int>(std::ceil(kSampleSeconds / once)), 1, 10000);
  }
  for (int round = 0; round < budget.rounds; ++round) {
    if (round >= kMinRounds && now() - start > budget.seconds) break;
    for (std::size_t i = 0; i < cases.size(); ++i) sample(cases[i], probe, samples[i]);
  }
  std::vector<Timing> timings;
  const bool clean = std::all_of(samples.begin(), samples.end(), enough);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    timings.push_back(timing(cases[i], samples[i], clean));
  }
  return timings;
}

}  // namespace

double on_core() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::string verdict(const Figure& figure) {
  const std::optional<double>&reached = figure.target.reached, &goal = figure.target.goal;
  const bool at_most = figure.target.at_most;
  const auto meets = [&](double wanted) {
    return at_most ? figure.value <= wanted : figure.value >= wanted;
  };
  if (goal && meets(*goal)) return "goal met";
  if (reached && meets(*reached)) return "met";
  if (!reached && !goal) return "";
  const double wanted = reached ? *reached : *goal;
  char text[32];
  std::snprintf(text, sizeof text, "%.2fx %s",
                at_most ? figure.value / wanted : wanted / figure.value,
                at_most ? "above" : "below");
  return text;
}

void Suite::add_threads(const std::string& name, double units,
                        const std::function<void(const Device&)>& run) {
  const int widest = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 2);
  for (int threads = 1; threads <= widest; ++threads) {
    add({name + " x" + std::to_string(threads), threads, units,
         [run, device = Device::tbb(threads)] { run(device); }});
  }
}

void Suite::ratio(std::string figure, std::string of, std::string against, Target target) {
  rules_.push_back({std::move(figure), {std::move(of), std::move(against)}, target, false});
}

void Suite::ratio_threads(const std::string& figure, const std::string& of,
                          const std::string& against, Target one, Target two) {
  ratio(figure + ", x1", of + " x1", against + " x1", one);
  ratio(figure + ", x2", of + " x2", against + " x2", two);
}

void Suite::ratio_of_threads(const std::string& figure, const std::string& of,
                             const std::string& against, Target one, Target two) {
  ratio(figure + ", x1", of + " x1", against, one);
  ratio(figure + ", x2", of + " x2", against, two);
}

void Suite::scaling(const std::string& of, Target target) {
  ratio(of + ": threads 1 to 2", of + " x2", of + " x1", target);
}

void Suite::growth(std::string figure, std::vector<std::string> cases, Target target) {
  rules_.push_back({std::move(figure), std::move(cases), target, true});
}

void Suite::forget_targets() {
  for (Rule& rule : rules_) rule.target = {};
}

Result measure(const Suite& suite, const Budget& budget) {
  Result result{suite.name_, suite.unit_, time_all(suite.cases_, budget), {}};
  for (const Suite::Rule& rule : suite.rules_) {
    std::vector<double> rates;
    for (const std::string& name : rule.cases) {
      const auto& all = result.timings;
      const auto found =
          std::find_if(all.begin(), all.end(), [&](const Timing& t) { return t.name == name; });
      if (found != all.end()) rates.push_back(found->rate);
    }
    if (rates.size() != rule.cases.size()) continue;
    const auto [low, high] = std::minmax_element(rates.begin(), rates.end());
    const double value = rule.spread ? *high / *low : rates[0] / rates[1];
    result.figures.push_back({rule.figure, value, rule.target});
  }
  return result;
}

}  // namespace glint::bench
