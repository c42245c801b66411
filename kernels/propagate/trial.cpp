// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "glint/kernels/core/particles.hpp"
#include "glint/kernels/propagate/propagate.hpp"

namespace glint {
namespace {

struct Bank {
  std::string name;
  std::vector<MotionMode> modes;
  bool scaled = false;  ///< noise_scale is given
};

Particles start_of(std::size_t n) {
  Particles p;
  p.resize(n);
  const RandomKey key = random_key(11, 0, Purpose::trial);
  for (std::uint32_t i = 0; i < n; ++i) {
    const Normals4 normals = random_normals(key, i), more = random_normals(key, i, 1);
    p.x[i] = 2000 + 1000 * normals.n[0];
    p.y[i] = 2000 + 1000 * normals.n[1];
    p.vx[i] = 5 * normals.n[2];
    p.vy[i] = 5 * normals.n[3];
    p.ax[i] = more.n[0];
    p.ay[i] = more.n[1];
    p.intensity[i] = 10 + more.n[2];
    p.weight[i] = uniform(random_words(key, i, 2).w[0]);
    p.mode[i] = i % 9;  // some beyond the bank
  }
  return p;
}

class PropagateTrial : public Trial {
 public:
  PropagateTrial(std::size_t n, Bank bank) : start_(start_of(n)), bank_(std::move(bank)) {
    const std::size_t modes = bank_.modes.size();
    const float leave = 0.3f / static_cast<float>(modes);
    switching_.assign(modes * modes, leave);
    for (std::size_t m = 0; m < modes; ++m) switching_[m * modes + m] = 0.7f + leave;
  }

  std::string description() const override {
    return std::to_string(start_.size()) + " particles, " + bank_.name +
           (bank_.scaled ? ", scaled noise" : "");
  }
  void run(const Device& device) override {
    moved_ = start_;
    Propagate::Args args{.x = moved_.x,
                         .y = moved_.y,
                         .vx = moved_.vx,
                         .vy = moved_.vy,
                         .intensity = moved_.intensity,
                         .ax = moved_.ax,
                         .ay = moved_.ay,
                         .mode = moved_.mode,
                         .modes = bank_.modes,
                         .switching = switching_,
                         .step = 0.7f,
                         .intensity_noise = 0.5f,
                         .intensity_low = 9,
                         .intensity_high = 11.5f,
                         .seed = 0x123456789abcdef,
                         .frame = 5};
    if (bank_.scaled) args.noise_scale = start_.weight;
    device.run<Propagate>(args);
  }
  std::vector<Output> outputs() const override {
    const auto list = [](const auto& values) {
      return std::vector<double>(values.begin(), values.end());
    };
    return {{"x", Propagate::tolerance, list(moved_.x)},
            {"y", Propagate::tolerance, list(moved_.y)},
            {"vx", Propagate::tolerance, list(moved_.vx)},
            {"vy", Propagate::tolerance, list(moved_.vy)},
            {"ax", Propagate::tolerance, list(moved_.ax)},
            {"ay", Propagate::tolerance, list(moved_.ay)},
            {"intensity", Propagate::tolerance, list(moved_.intensity)},
            {"mode", {}, list(moved_.mode)}};
  }

 private:
  Particles start_, moved_;
  Bank bank_;
  std::vector<float> switching_;
};

}  // namespace

std::vector<std::unique_ptr<Trial>> Propagate::trials() {
  const MotionMode velocity{Motion::constant_velocity, 0, 0.05f};
  const MotionMode acceleration{Motion::constant_acceleration, 0, 0.02f};
  const MotionMode left{Motion::coordinated_turn, 0.26f, 0.05f};
  const MotionMode right{Motion::coordinated_turn, -0.26f, 0.05f};
  std::vector<std::unique_ptr<Trial>> list;
  const auto add = [&](std::size_t n, Bank bank) {
    list.push_back(std::make_unique<PropagateTrial>(n, std::move(bank)));
  };
  for (const std::size_t n : {0u, 1u, 63u, 64u, 65u, 4095u, 4096u, 4097u, 20011u}) {
    add(n, {"CV", {velocity}});
  }
  for (const std::size_t n : {65u, 4097u}) {
    add(n, {"CA", {acceleration}});
    add(n, {"turn", {left}, true});
    add(n, {"CV + turns", {velocity, left, right}});
    add(n, {"CV + CA + turns", {velocity, acceleration, left, right}, true});
  }
  add(5001, {"eight modes", {velocity, acceleration, left, right, left, velocity, right, left}});
  add(9001, {"CV", {velocity}, true});
  return list;
}

}  // namespace glint
