// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "glint/kernels/core/device.hpp"

namespace glint::bench {

/// Time [s] that this thread had a core.
double on_core();

/// Something to time: `units` of work a call, on so many threads.
struct Case {
  std::string name;
  int threads = 1;
  double units = 1;
  std::function<void()> run;
  /// Other threads or programs do the work: that this thread had a core says nothing.
  bool elsewhere = false;
};

/// What a figure should be: what a prototype reached, and what is wanted.
struct Target {
  std::optional<double> reached, goal;
  bool at_most = false;  ///< smaller is better
};

struct Timing {
  std::string name;
  int threads = 1;
  double seconds = 0;  ///< of a call; see measure()
  double rate = 0;     ///< [units/s]
  int samples = 0;
  int disturbed = 0;  ///< all of `samples`, if fewer than 3 were free of other work
};

/// A comparison of cases of one suite, so of things measured in the same run.
struct Figure {
  std::string name;
  double value = 0;
  Target target;
};
/// "goal met", "met" (what was reached), "1.23x below" it, or "" without a target.
std::string verdict(const Figure& figure);

struct Result {
  std::string name, unit;
  std::vector<Timing> timings;
  std::vector<Figure> figures;
};

/// Cases that are timed together, and what to compare among them.
class Suite {
 public:
  Suite(std::string name, std::string unit) : name_(std::move(name)), unit_(std::move(unit)) {}

  void add(Case c) { cases_.push_back(std::move(c)); }
  /// `NAME x1` and, with a second core, `NAME x2`: `run` called with a tbb device of that width.
  void add_threads(const std::string& name, double units,
                   const std::function<void(const Device&)>& run);

  /// rate(of) / rate(against). Figures of cases that this build or machine lacks are left out.
  void ratio(std::string figure, std::string of, std::string against, Target target = {});
  /// ratio() for `OF x1` and `OF x2` against the same widths of `against`.
  void ratio_threads(const std::string& figure, const std::string& of, const std::string& against,
                     Target one, Target two);
  /// ratio() for `OF x1` and `OF x2` against one case.
  void ratio_of_threads(const std::string& figure, const std::string& of,
                        const std::string& against, Target one, Target two);
  /// rate(`OF x2`) / rate(`OF x1`).
  void scaling(const std::string& of, Target target);
  /// Dearest unit / cheapest unit over the cases.
  void growth(std::string figure, std::vector<std::string> cases, Target target);

  /// For problems of another size than the one that the targets were set for.
  void forget_targets();

 private:
  friend Result measure(const Suite&, const struct Budget&);
  struct Rule {
    std::string figure;
    std::vector<std::string> cases;
    Target target;
    bool spread;
  };
  std::string name_, unit_;
  std::vector<Case> cases_;
  std::vector<Rule> rules_;
};

/// How long a suite may take: rounds over all its cases until one of these is used up, 3 at least.
struct Budget {
  int rounds = 15;
  double seconds = 12;
};

/// Runs the cases round-robin, so that all see the same weather, and takes medians. A sample counts
/// if its thread had a core all along and, for two threads, if two cores were free before and after
/// it; it is repeated up to three times to get one. A case with fewer than three such samples is
/// marked; then every case of the suite is judged alike, by the lower quartile of all its samples.
Result measure(const Suite& suite, const Budget& budget);

}  // namespace glint::bench
