// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "glint/kernels/resample/check.hpp"
#include "glint/kernels/resample/shares.hpp"

namespace glint {
namespace {

using resample::below;
using resample::Points;
using resample::points_of;
using resample::Scale;
using resample::Split;
using resample::Splitter;
using resample::valid;
using resample::whole;

Scale fitting_scale(const Resample::Args& args, int bits) {
  float largest = 0;
  for (const float weight : args.weights) largest = std::max(largest, valid(weight));
  return resample::scale_of(largest, bits);
}

double total_of(const Resample::Args& args, Scale scale) {
  double total = 0;
  for (const float weight : args.weights) total += whole(weight, scale);
  return total;
}

// Offspring j descends from the particle whose stretch of the cumulative mass holds (j + u) T / L.
void systematic(const Resample::Args& args, Scale scale, std::uint32_t word) {
  const auto count = static_cast<double>(args.ancestors.size());
  const Points points = points_of(total_of(args, scale), count, word);
  double mass = 0;
  std::size_t j = 0;
  for (std::uint32_t i = 0; i < args.weights.size(); ++i) {
    mass += whole(args.weights[i], scale);
    for (const auto end = static_cast<std::size_t>(below(mass, points)); j < end; ++j) {
      args.ancestors[j] = i;
    }
  }
}

// floor(L w) copies of each particle; the fractions share the rest out systematically.
void residual(const Resample::Args& args, Scale scale, int bits, std::uint32_t word) {
  const Splitter splitter =
      resample::splitter_of(total_of(args, scale), args.ancestors.size(), bits);
  double copies = 0, remainders = 0;
  for (const float weight : args.weights) {
    const Split s = resample::split(whole(weight, scale), splitter);
    copies += s.copies;
    remainders += s.remainder;
  }
  const Points points = points_of(remainders, splitter.count - copies, word);
  double sure = 0, mass = 0;
  std::size_t j = 0;
  for (std::uint32_t i = 0; i < args.weights.size(); ++i) {
    const Split s = resample::split(whole(args.weights[i], scale), splitter);
    sure += s.copies;
    mass += s.remainder;
    for (const auto end = static_cast<std::size_t>(sure + below(mass, points)); j < end; ++j) {
      args.ancestors[j] = i;
    }
  }
}

void move(const Resample::Args& args, MovedArray array) {
  for (std::size_t j = 0; j < args.ancestors.size(); ++j) array.move(args.ancestors[j], j);
}

}  // namespace

void Resample::serial(const Args& args) {
  resample::check(args);
  const int bits = resample::bits(args.weights.size(), args.ancestors.size());
  const Scale scale = fitting_scale(args, bits);
  const std::uint32_t word = random_words(args.key, 0).w[0];
  if (args.method == Resampling::systematic) {
    systematic(args, scale, word);
  } else {
    residual(args, scale, bits, word);
  }
  for (const MovedArray& array : args.moved) move(args, array);
}

}  // namespace glint
