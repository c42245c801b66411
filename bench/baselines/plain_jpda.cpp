// SPDX-License-Identifier: Apache-2.0
#include "glint/bench/baselines/plain_jpda.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace glint::bench {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

const MultiscanSettings kLimits;

}  // namespace

void PlainJpda::start(double x, double y, double vx, double vy) {
  Gaussian<4> state;
  state.mean << x, vx, y, vy;
  state.covariance *= config_.velocity_sd * config_.velocity_sd;
  state.covariance(0, 0) = state.covariance(2, 2) = config_.measurement_variance;
  const PlainBank bank = plain_bank(imm_jpda_bank(config_, state), config_.stay);
  groups_.push_back({{static_cast<int>(targets_.size())}, {{{0}, 1.0}}});
  targets_.push_back({bank, {bank}, {}, {}, {}, {}});
}

std::vector<Eigen::Vector4d> PlainJpda::states() const {
  std::vector<Eigen::Vector4d> states;
  for (const Target& target : targets_) states.push_back(target.estimate.kinematic());
  return states;
}

void PlainJpda::step(std::span<const PointMeasurement> points) {
  points_.clear();
  for (const PointMeasurement& p : points) points_.emplace_back(Eigen::Vector2d(p.x, p.y));
  for (Target& target : targets_) predict(target);
  std::vector<Group> next;
  for (const std::vector<int>& cluster : clusters()) {
    const Group before = gather(cluster);
    Joint joint = enumerate(before);
    if (config_.window > 1) keep_best_permutations(before, joint);
    add_posterior(before, joint);
    advance(before, joint, next);
  }
  for (Target& target : targets_) estimate(target);
  if (config_.window == 1) {
    for (Target& target : targets_) target.hypotheses = {target.estimate};
    return;
  }
  groups_ = std::move(next);
  for (Group& group : groups_) take_over(group);
}

/// Moves the hypotheses on, finds the union of their gates, and where each point leads to.
void PlainJpda::predict(Target& target) const {
  const MatrixXd noise = config_.measurement_variance * MatrixXd::Identity(2, 2);
  std::set<int> gate;
  for (PlainBank& bank : target.hypotheses) {
    bank.mix(), bank.predict();
    for (const PlainMode& mode : bank.modes) {
      const PlainPrediction expected(mode.belief, noise);
      for (std::size_t i = 0; i < points_.size(); ++i) {
        if (expected.distance(points_[i]) <= config_.gate) gate.insert(static_cast<int>(i));
      }
    }
  }
  target.gate.assign(gate.begin(), gate.end());
  const std::size_t options = target.gate.size() + 1;
  target.child.assign(target.hypotheses.size(), {});
  target.weight.assign(target.hypotheses.size(), std::vector<double>(options));
  target.posterior.assign(target.hypotheses.size(), std::vector<double>(options));
  for (std::size_t h = 0; h < target.hypotheses.size(); ++h) update(target, h);
}

void PlainJpda::update(Target& target, std::size_t hypothesis) const {
  const MatrixXd noise = config_.measurement_variance * MatrixXd::Identity(2, 2);
  const PlainBank& bank = target.hypotheses[hypothesis];
  target.child[hypothesis].push_back(bank);
  target.weight[hypothesis][0] = 1 - config_.detection;
  for (std::size_t i = 0; i < target.gate.size(); ++i) {
    const VectorXd& point = points_[static_cast<std::size_t>(target.gate[i])];
    PlainBank child = bank;
    VectorXd likelihood(bank.probability.size());
    for (std::size_t j = 0; j < bank.modes.size(); ++j) {
      const PlainPrediction expected(bank.modes[j].belief, noise);
      likelihood(static_cast<Index>(j)) = expected.density(point);
      child.modes[j].belief = expected.updated(bank.modes[j].belief, point);
    }
    target.weight[hypothesis][i + 1] =
        config_.detection * likelihood.dot(bank.probability) / config_.clutter_density;
    child.weigh(likelihood);
    target.child[hypothesis].push_back(child);
  }
}

/// Targets that share points, or whose hypotheses belong together.
std::vector<std::vector<int>> PlainJpda::clusters() const {
  std::vector<std::pair<int, int>> pairs;
  for (const Group& group : groups_) {
    for (const int t : group.targets) pairs.emplace_back(group.targets[0], t);
  }
  std::map<int, int> holder;
  for (std::size_t t = 0; t < targets_.size(); ++t) {
    for (const int point : targets_[t].gate) {
      const auto found = holder.emplace(point, static_cast<int>(t));
      pairs.emplace_back(found.first->second, static_cast<int>(t));
    }
  }
  return components(static_cast<int>(targets_.size()), pairs);
}

/// All pairs of events of the groups that a cluster is made of.
PlainJpda::Group PlainJpda::gather(const std::vector<int>& cluster) const {
  Group all{cluster, {{Event(cluster.size()), 1.0}}};
  bool first = true;
  for (const Group& group : groups_) {
    if (!std::ranges::binary_search(cluster, group.targets[0])) continue;
    Events product;
    for (const auto& [event, weight] : all.events) {
      for (const auto& [own, own_weight] : group.events) {
        Event both = event;
        for (std::size_t c = 0; c < own.size(); ++c) {
          const auto at = std::ranges::lower_bound(cluster, group.targets[c]) - cluster.begin();
          both[static_cast<std::size_t>(at)] = own[c];
        }
        product[both] += weight * own_weight;
      }
    }
    all.events = std::move(product);
    if (!std::exchange(first, false)) keep_best(all.events, kLimits.events, 0);
  }
  return all;
}

PlainJpda::Joint PlainJpda::enumerate(const Group& before) const {
  Joint joint;
  Event options;
  std::vector<int> used;
  choose(before, options, used, joint);
  return joint;
}

void PlainJpda::choose(const Group& before, Event& options, std::vector<int>& used,
                       Joint& joint) const {
  if (options.size() == before.targets.size()) {
    for (const auto& [event, prior] : before.events) {
      double weight = prior;
      for (std::size_t c = 0; c < event.size(); ++c) {
        weight *=
            targets_[static_cast<std::size_t>(before.targets[c])]
                .weight[static_cast<std::size_t>(event[c])][static_cast<std::size_t>(options[c])];
      }
      joint[options][event] = weight;
    }
    return;
  }
  const Target& target = targets_[static_cast<std::size_t>(before.targets[options.size()])];
  for (std::size_t o = 0; o <= target.gate.size(); ++o) {
    if (o > 0 && std::ranges::find(used, target.gate[o - 1]) != used.end()) continue;
    options.push_back(static_cast<int>(o));
    if (o > 0) used.push_back(target.gate[o - 1]);
    choose(before, options, used, joint);
    if (o > 0) used.pop_back();
    options.pop_back();
  }
}

/// Of the events that serve the same targets with the same points leaves the likeliest.
void PlainJpda::keep_best_permutations(const Group& before, Joint& joint) const {
  std::map<std::pair<std::vector<bool>, std::set<int>>, std::pair<double, Event>> best;
  for (const auto& [options, by_event] : joint) {
    std::vector<bool> served;
    std::set<int> points;
    double sum = 0;
    for (std::size_t c = 0; c < options.size(); ++c) {
      const Target& target = targets_[static_cast<std::size_t>(before.targets[c])];
      served.push_back(options[c] > 0);
      if (options[c] > 0) points.insert(target.gate[static_cast<std::size_t>(options[c] - 1)]);
    }
    for (const auto& [event, weight] : by_event) sum += weight;
    auto& held = best[{served, points}];
    if (sum > held.first) held = {sum, options};
  }
  std::set<Event> kept;
  for (const auto& [key, held] : best) kept.insert(held.second);
  std::erase_if(joint, [&](const auto& entry) { return !kept.contains(entry.first); });
}

void PlainJpda::add_posterior(const Group& before, const Joint& joint) {
  double all = 0;
  for (const auto& [options, by_event] : joint) {
    for (const auto& [event, weight] : by_event) all += weight;
  }
  for (const auto& [options, by_event] : joint) {
    for (const auto& [event, weight] : by_event) {
      for (std::size_t c = 0; c < event.size(); ++c) {
        targets_[static_cast<std::size_t>(before.targets[c])]
            .posterior[static_cast<std::size_t>(event[c])][static_cast<std::size_t>(options[c])] +=
            weight / all;
      }
    }
  }
}

/// P-JPDA (43), (45), (52).
void PlainJpda::estimate(Target& target) const {
  std::vector<PlainShare> shares;
  for (std::size_t h = 0; h < target.child.size(); ++h) {
    for (std::size_t o = 0; o < target.child[h].size(); ++o) {
      shares.push_back({target.posterior[h][o], &target.child[h][o]});
    }
  }
  target.estimate = mixed(shares);
}

/// What the scan says of the options; targets that shared no point go their own ways.
void PlainJpda::advance(const Group& before, const Joint& joint, std::vector<Group>& next) const {
  std::vector<std::pair<int, int>> bonds;
  std::map<int, int> holder;
  for (std::size_t c = 0; c < before.targets.size(); ++c) {
    for (const int point : targets_[static_cast<std::size_t>(before.targets[c])].gate) {
      const auto found = holder.emplace(point, static_cast<int>(c));
      bonds.emplace_back(found.first->second, static_cast<int>(c));
    }
  }
  for (const auto& columns : components(static_cast<int>(before.targets.size()), bonds)) {
    Group group;
    for (const int c : columns) {
      group.targets.push_back(before.targets[static_cast<std::size_t>(c)]);
    }
    for (const auto& [options, by_event] : joint) {
      Event own;
      for (const int c : columns) own.push_back(options[static_cast<std::size_t>(c)]);
      for (const auto& [event, weight] : by_event) group.events[own] += weight;
    }
    keep_best(group.events, kLimits.events, kLimits.least);
    next.push_back(std::move(group));
  }
}

/// The options of the scan become the hypotheses of the next.
void PlainJpda::take_over(Group& group) {
  for (std::size_t c = 0; c < group.targets.size(); ++c) {
    Target& target = targets_[static_cast<std::size_t>(group.targets[c])];
    std::map<int, int> number;  // of an option that is left
    for (const auto& [event, weight] : group.events) number.emplace(event[c], 0);
    target.hypotheses.clear();
    for (auto& [option, at] : number) {
      const auto o = static_cast<std::size_t>(option);
      double sum = 0;
      for (const auto& by_option : target.posterior) sum += by_option[o];
      std::vector<PlainShare> shares;
      for (std::size_t h = 0; h < target.posterior.size(); ++h) {
        shares.push_back({target.posterior[h][o] / sum, &target.child[h][o]});
      }
      at = static_cast<int>(target.hypotheses.size());
      target.hypotheses.push_back(mixed(shares));
    }
    Events renumbered;
    for (const auto& [event, weight] : group.events) {
      Event own = event;
      own[c] = number.at(event[c]);
      renumbered[own] += weight;
    }
    group.events = std::move(renumbered);
  }
}

}  // namespace glint::bench
