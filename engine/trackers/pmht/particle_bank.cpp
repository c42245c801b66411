// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/pmht/particle_bank.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "glint/engine/state/bytes.hpp"

namespace glint {
namespace {

constexpr double kCollapse = 25;  // squared distance of the nearest particle over the variance
constexpr double kCell = 16384;   // side of a cell of origins, in standard deviations of a point

/// Lower triangle whose square is `covariance`, which may be singular.
template <int N>
Eigen::Matrix<double, N, N> root_of(const Eigen::Matrix<double, N, N>& covariance) {
  Eigen::Matrix<double, N, N> root = Eigen::Matrix<double, N, N>::Zero();
  const double least = 1e-12 * covariance.diagonal().maxCoeff();
  for (int j = 0; j < N; ++j) {
    const double pivot = covariance(j, j) - root.row(j).squaredNorm();
    if (!(pivot > least)) continue;
    root(j, j) = std::sqrt(pivot);
    for (int i = j + 1; i < N; ++i) {
      root(i, j) = (covariance(i, j) - root.row(i).dot(root.row(j))) / root(j, j);
    }
  }
  return root;
}

/// N standard normals for a particle.
template <int N>
Eigen::Matrix<double, N, 1> normals(RandomKey key, std::size_t particle) {
  Eigen::Matrix<double, N, 1> values;
  Normals4 four{};
  for (int i = 0; i < N; ++i) {
    if (i % 4 == 0) {
      four = random_normals(key, static_cast<std::uint32_t>(particle),
                            static_cast<std::uint32_t>(i / 4));
    }
    values(i) = static_cast<double>(four.n[i % 4]);
  }
  return values;
}

/// Particles lie number by number of the state.
template <int N>
Eigen::Matrix<double, N, 1> state_of(const std::vector<float>& states, std::size_t particle) {
  const std::size_t count = states.size() / N;
  Eigen::Matrix<double, N, 1> x;
  for (std::size_t i = 0; i < N; ++i) {
    x(static_cast<Eigen::Index>(i)) = static_cast<double>(states[i * count + particle]);
  }
  return x;
}

template <int N>
void set_state(std::vector<float>& states, std::size_t particle,
               const Eigen::Matrix<double, N, 1>& x) {
  const std::size_t count = states.size() / N;
  for (std::size_t i = 0; i < N; ++i) {
    states[i * count + particle] = static_cast<float>(x(static_cast<Eigen::Index>(i)));
  }
}

template <int N>
Eigen::Vector2d position_in(const Eigen::Matrix<double, N, 1>& state) {
  return {state(0), state(N / 2)};
}

/// What moves a state's position by `shift`.
template <int N>
Eigen::Matrix<double, N, 1> by(const Eigen::Vector2d& shift) {
  Eigen::Matrix<double, N, 1> state = Eigen::Matrix<double, N, 1>::Zero();
  state(0) = shift.x(), state(N / 2) = shift.y();
  return state;
}

}  // namespace

ParticleBank::ParticleBank(Imm imm, int particles, double variance, std::uint64_t seed,
                           std::int64_t track)
    : imm_(std::move(imm)),
      particles_(particles),
      variance_(variance),
      clouds_(imm_.modes().size()),
      weights_(size()),
      ancestors_(size()) {
  const RandomKey of_track =
      random_key(seed, static_cast<std::uint64_t>(track), Purpose::propagate);
  for (std::size_t m = 0; m < clouds_.size(); ++m) {
    const Words4 r = random_words(of_track, static_cast<std::uint32_t>(m));
    clouds_[m].seed = (static_cast<std::uint64_t>(r.w[0]) << 32) | r.w[1];
    std::visit([&](const auto& mode) { draw(clouds_[m], mode.belief); }, imm_.modes()[m]);
  }
}

bool ParticleBank::alike(const ParticleBank& other) const {
  return imm_.alike(other.imm_) && particles_ == other.particles_;
}

void ParticleBank::restored() {
  require_bytes(particles_ > 0 && clouds_.size() == imm_.modes().size(), "a bank is not whole");
  for (std::size_t m = 0; m < clouds_.size(); ++m) {
    const auto numbers =
        std::visit([](const auto& mode) { return mode.belief.mean.size(); }, imm_.modes()[m]);
    require_bytes(clouds_[m].state.size() == static_cast<std::size_t>(numbers) * size(),
                  "a cloud of particles is not whole");
  }
  weights_.resize(size()), ancestors_.resize(size());
}

RandomKey ParticleBank::key(const Cloud& cloud, Purpose purpose) const {
  return random_key(cloud.seed, scan_, purpose);
}

/// A float has 7 digits, so positions count from the next corner of a coarse grid: 14 bits hold the
/// way from there, and 10 are left for a point's standard deviation.
Eigen::Vector2d ParticleBank::origin_near(const Eigen::Vector2d& position) const {
  const double side = kCell * std::sqrt(variance_);
  return side * (position / side).array().round();
}

template <int N>
void ParticleBank::recentre(Cloud& cloud, const Gaussian<N>& belief) const {
  const Eigen::Vector2d origin = origin_near(position_in(belief.mean));
  if (origin == cloud.origin) return;
  const Eigen::Matrix<double, N, 1> shift = by<N>(cloud.origin - origin);
  for (std::size_t p = 0; p < size(); ++p) {
    set_state<N>(cloud.state, p, state_of<N>(cloud.state, p) + shift);
  }
  cloud.origin = origin;
}

template <int N>
void ParticleBank::draw(Cloud& cloud, const Gaussian<N>& belief) {
  const Eigen::Matrix<double, N, N> root = root_of(belief.covariance);
  cloud.origin = origin_near(position_in(belief.mean));
  const Eigen::Matrix<double, N, 1> mean = belief.mean - by<N>(cloud.origin);
  cloud.state.resize(N * size());
  for (std::size_t p = 0; p < size(); ++p) {
    set_state<N>(cloud.state, p, mean + root * normals<N>(key(cloud, Purpose::birth), p));
  }
}

/// P-MMPF step (b) iv.
template <int N>
void ParticleBank::move(Cloud& cloud, const LinearMotion<N>& motion) {
  const Eigen::Matrix<double, N, N> root = root_of(motion.noise);
  for (std::size_t p = 0; p < size(); ++p) {
    set_state<N>(cloud.state, p,
                 motion.transition * state_of<N>(cloud.state, p) +
                     root * normals<N>(key(cloud, Purpose::propagate), p));
  }
}

/// P-MMPF (6), with its spread; (2) if there are no weights.
template <int N>
Gaussian<N> ParticleBank::moments(const Cloud& cloud, std::span<const float> weights) const {
  const auto weight = [&](std::size_t p) {
    return weights.empty() ? 1.0 : static_cast<double>(weights[p]);
  };
  Gaussian<N> result;
  result.mean.setZero(), result.covariance.setZero();
  double sum = 0;
  for (std::size_t p = 0; p < size(); ++p) {
    sum += weight(p), result.mean += weight(p) * state_of<N>(cloud.state, p);
  }
  result.mean /= sum;
  for (std::size_t p = 0; p < size(); ++p) {
    const Eigen::Matrix<double, N, 1> off = state_of<N>(cloud.state, p) - result.mean;
    result.covariance += weight(p) / sum * off * off.transpose();
  }
  result.mean += by<N>(cloud.origin);
  symmetrise(result.covariance);
  return result;
}

void ParticleBank::predict(double step) {
  imm_.mix();
  ++scan_;
  for (std::size_t m = 0; m < clouds_.size(); ++m) {
    Cloud& cloud = clouds_[m];
    std::visit(
        [&](auto& mode) {
          constexpr int kParts = std::remove_cvref_t<decltype(mode.model)>::kParts;
          if (cloud.collapsed) draw(cloud, mode.belief);  // from N(x_0m, P_0m)
          recentre(cloud, mode.belief);
          cloud.collapsed = false;
          move(cloud, linear_motion<2>(mode.model, step));
          mode.belief = moments<2 * kParts>(cloud, {});
        },
        imm_.modes()[m]);
  }
}

PmhtMode ParticleBank::mode(std::size_t model) const {
  const auto position = [](const auto& mode) { return position_in(mode.belief.mean); };
  return {std::visit(position, imm_.modes()[model]), imm_.probability()[model]};
}

/// Squared distances of the particles, into weights_.
template <int N>
void ParticleBank::distances(const Cloud& cloud, const Eigen::Vector2d& to) const {
  const float* x = cloud.state.data();
  const float* y = x + N / 2 * size();
  const auto to_x = static_cast<float>(to.x() - cloud.origin.x());
  const auto to_y = static_cast<float>(to.y() - cloud.origin.y());
  for (std::size_t p = 0; p < size(); ++p) {
    const float dx = x[p] - to_x, dy = y[p] - to_y;
    weights_[p] = dx * dx + dy * dy;
  }
}

/// Distances become weights exp(-d^2 / 2R), the nearest particle's 1; returns its distance.
double ParticleBank::weigh() const {
  const float nearest = *std::ranges::min_element(weights_);
  const auto scale = static_cast<float>(-1 / (2 * variance_));
  for (float& w : weights_) w = std::exp(scale * (w - nearest));
  return static_cast<double>(nearest);
}

Eigen::Vector2d ParticleBank::maximise(std::size_t model, const PmhtCentroid& centroid) const {
  const Cloud& cloud = clouds_[model];
  return std::visit(
      [&](const auto& mode) -> Eigen::Vector2d {
        constexpr int kSize = 2 * std::remove_cvref_t<decltype(mode.model)>::kParts;
        distances<kSize>(cloud, centroid.position);
        if (weigh() / variance_ > kCollapse) return this->mode(model).position;
        Eigen::Vector2d sum = Eigen::Vector2d::Zero();
        double all = 0;
        for (std::size_t p = 0; p < size(); ++p) {
          const auto w = static_cast<double>(weights_[p]);
          sum += w * Eigen::Vector2d(cloud.state[p], cloud.state[kSize / 2 * size() + p]);
          all += w;
        }
        return cloud.origin + sum / all;
      },
      imm_.modes()[model]);
}

template <int N>
void ParticleBank::resample(Cloud& cloud) {
  moved_.resize(cloud.state.size());
  std::array<MovedArray, N> arrays;
  for (std::size_t i = 0; i < N; ++i) arrays[i] = {&cloud.state[i * size()], &moved_[i * size()]};
  Resample::Args args;
  args.weights = weights_, args.ancestors = ancestors_;
  args.method = Resampling::residual;
  args.key = key(cloud, Purpose::resample);
  args.moved = arrays;
  Resample::serial(args);
  std::swap(cloud.state, moved_);
}

/// P-MMPF step (a) vi. The paper weighs by the covariance R / W, which narrows the cloud by points
/// that W says are not there (19 % of the targets lost instead of 4.4 %), and collapses when the
/// weights sum to 0, which in double happens only beyond 115 px.
template <int N>
void ParticleBank::take_in(Cloud& cloud, Gaussian<N>& belief, const PmhtCentroid& centroid) {
  if (!centroid.seen()) return;
  distances<N>(cloud, centroid.position);
  cloud.collapsed = weigh() / variance_ > kCollapse;
  if (cloud.collapsed) return;
  belief = moments<N>(cloud, weights_);
  resample<N>(cloud);
}

void ParticleBank::update(std::span<const PmhtCentroid> first, std::span<const PmhtCentroid> last) {
  std::array<double, kMostModes> log_likelihood{};
  for (std::size_t m = 0; m < clouds_.size(); ++m) {
    std::visit(
        [&](auto& mode) {
          constexpr int kSize = 2 * std::remove_cvref_t<decltype(mode.model)>::kParts;
          if (first[m].seen()) {
            distances<kSize>(clouds_[m], first[m].position);
            const double nearest = weigh();
            double sum = 0;
            for (const float w : weights_) sum += static_cast<double>(w);
            log_likelihood[m] = std::log(sum / particles_) - nearest / (2 * variance_);
          }
          take_in(clouds_[m], mode.belief, last[m]);
        },
        imm_.modes()[m]);
  }
  if (!std::ranges::any_of(first, &PmhtCentroid::seen)) return;
  if (std::ranges::all_of(clouds_, &Cloud::collapsed)) {  // then all are equally likely
    for (std::size_t m = 0; m < clouds_.size(); ++m) {
      log_likelihood[m] = -std::log(imm_.probability()[m]);
    }
  }
  imm_.weigh(std::span(log_likelihood).first(clouds_.size()));
}

}  // namespace glint
