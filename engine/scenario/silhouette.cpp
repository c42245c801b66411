// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/scenario/silhouette.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace glint {
namespace {

struct Corner {
  double u, v;  // forward, to starboard; [half a length], then [px]
};
using Outline = std::vector<Corner>;

constexpr double kRollRate = 0.11, kRotorRate = 0.83, kLightRate = 0.17;  // [rad/frame]
constexpr int kSubpixels = 4;                                             // along each axis
constexpr double kDarkest = 20;                                           // [grey levels]

/// Both halves of an outline that is given from nose to tail on one side.
Outline mirrored(Outline half) {
  for (std::size_t i = half.size(); i-- > 0;) half.push_back({half[i].u, -half[i].v});
  return half;
}

std::vector<Outline> jet(double roll) {
  Outline half{{1.0, 0.0},   {0.65, 0.15}, {0.3, 0.24},  {-0.3, 0.66}, {-0.55, 0.66},
               {-0.5, 0.26}, {-0.7, 0.24}, {-0.9, 0.42}, {-1.0, 0.42}, {-0.98, 0.15}};
  const double span = 1 - 0.3 * std::pow(std::sin(roll), 2);
  for (Corner& corner : half) corner.v *= span;
  return {mirrored(half)};
}

Outline blade(double angle, double length) {
  const double c = std::cos(angle), s = std::sin(angle), w = 0.04;
  return {{length * c - w * s, length * s + w * c},
          {length * c + w * s, length * s - w * c},
          {-length * c + w * s, -length * s - w * c},
          {-length * c - w * s, -length * s + w * c}};
}

/// Cabin, tail boom, fin and two blades.
std::vector<Outline> helicopter(double rotor) {
  return {mirrored({{0.6, 0.0}, {0.52, 0.18}, {0.3, 0.3}, {0.0, 0.33}, {-0.25, 0.26}, {-0.4, 0.1}}),
          mirrored({{-0.3, 0.09}, {-1.0, 0.06}}), mirrored({{-0.88, 0.17}, {-1.0, 0.17}}),
          blade(rotor, 0.75), blade(rotor + std::numbers::pi / 2, 0.75)};
}

bool inside(const Outline& outline, double u, double v) {
  bool in = false;
  for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const Corner &a = outline[i], &b = outline[j];
    if ((a.v > v) != (b.v > v) && u < (b.u - a.u) * (v - a.v) / (b.v - a.v) + a.u) in = !in;
  }
  return in;
}

bool inside(const std::vector<Outline>& parts, double u, double v) {
  return std::any_of(parts.begin(), parts.end(),
                     [=](const Outline& part) { return inside(part, u, v); });
}

/// Moves the union of `parts` to its centroid and scales it to `area`.
void normalise(std::vector<Outline>& parts, double area) {
  constexpr int kSteps = 128;  // across the square that holds every aircraft
  double count = 0, u_sum = 0, v_sum = 0;
  for (int j = 0; j < kSteps; ++j) {
    for (int i = 0; i < kSteps; ++i) {
      const double u = 2.2 * (i + 0.5) / kSteps - 1.1, v = 2.2 * (j + 0.5) / kSteps - 1.1;
      if (inside(parts, u, v)) ++count, u_sum += u, v_sum += v;
    }
  }
  const double scale = std::sqrt(area / (count * std::pow(2.2 / kSteps, 2)));
  for (Outline& part : parts) {
    for (Corner& c : part) c = {scale * (c.u - u_sum / count), scale * (c.v - v_sum / count)};
  }
}

/// From picture to aircraft: forward and starboard of a point [px].
struct Attitude {
  double x, y, cosine, sine;
  explicit Attitude(const Kinematics& k) : x(k.x), y(k.y) {
    const double speed = std::hypot(k.vx, k.vy);
    cosine = speed > 0 ? k.vx / speed : 1, sine = speed > 0 ? k.vy / speed : 0;
  }
  Corner operator()(double px, double py) const {
    return {cosine * (px - x) + sine * (py - y), cosine * (py - y) - sine * (px - x)};
  }
};

double covered(const std::vector<Outline>& parts, const Attitude& attitude, int x, int y) {
  int count = 0;
  for (int j = 0; j < kSubpixels; ++j) {
    for (int i = 0; i < kSubpixels; ++i) {
      const Corner c = attitude(x + (i + 0.5) / kSubpixels - 0.5, y + (j + 0.5) / kSubpixels - 0.5);
      count += inside(parts, c.u, c.v);
    }
  }
  return static_cast<double>(count) / (kSubpixels * kSubpixels);
}

Box box_around(const std::vector<Outline>& parts, const Kinematics& k) {
  double reach = 0;
  for (const Outline& part : parts) {
    for (const Corner& c : part) reach = std::max(reach, std::hypot(c.u, c.v));
  }
  const auto from = [reach](double at) { return static_cast<int>(std::floor(at - reach)); };
  const auto to = [reach](double at) { return static_cast<int>(std::ceil(at + reach)) + 1; };
  return {from(k.x), from(k.y), to(k.x), to(k.y)};
}

/// Takes grey levels of 1 / light to those whose 255 / I, seen in front of the sky and weighted by
/// share, has the mean `wanted`. Pixels that the outline cuts are mixtures, hence the iteration.
void darken(Patch& patch, double sky, double wanted) {
  const std::vector<float> light = patch.grey;
  double level = 255 / wanted;
  for (int iteration = 0; iteration < 20; ++iteration) {
    double sum = 0, area = 0;
    for (std::size_t i = 0; i < light.size(); ++i) {
      const double grey = std::max(level * static_cast<double>(light[i]), kDarkest);
      patch.grey[i] = static_cast<float>(grey);
      const double share = patch.share[i];
      sum += share * 255 / std::lerp(sky, grey, share), area += share;
    }
    if (area == 0) return;
    level *= sum / area / wanted;
  }
}

}  // namespace

Patch Silhouette::at(double age, const Kinematics& k) const {
  std::vector<Outline> parts =
      kind == Aircraft::jet ? jet(phase + kRollRate * age) : helicopter(phase + kRotorRate * age);
  normalise(parts, area);
  const Attitude attitude(k);
  Patch patch;
  patch.box = box_around(parts, k);
  const double wave = 2 / std::sqrt(area);  // [rad/px]
  for (int y = patch.box.y0; y < patch.box.y1; ++y) {
    for (int x = patch.box.x0; x < patch.box.x1; ++x) {
      const Corner c = attitude(x, y);
      const double light = 1 + 0.15 * std::sin(wave * (c.u + 0.5 * c.v) + phase + kLightRate * age);
      patch.share.push_back(static_cast<float>(covered(parts, attitude, x, y)));
      patch.grey.push_back(static_cast<float>(light));
    }
  }
  darken(patch, sky, reciprocal);
  return patch;
}

void paint(const Patch& patch, ImageView<float> image) {
  std::size_t i = 0;
  for (int y = patch.box.y0; y < patch.box.y1; ++y) {
    for (int x = patch.box.x0; x < patch.box.x1; ++x, ++i) {
      if (!image.contains(x, y) || patch.share[i] == 0) continue;
      image(x, y) = std::lerp(image(x, y), patch.grey[i], patch.share[i]);
    }
  }
}

}  // namespace glint
