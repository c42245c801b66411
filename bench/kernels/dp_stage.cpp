// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/dp_stage/dp_stage.hpp"

#include <memory>

#include "glint/bench/data.hpp"
#include "glint/bench/kernels/suites.hpp"

namespace glint::bench {
namespace {

/// Two stages of noise, then one that is timed.
struct Stages {
  explicit Stages(FrameSize size) : score(noise_frame(size.width, size.height)) {
    before = total = Image<float>(size.width, size.height);
    before_dx = before_dy = dx = dy = Image<std::int8_t>(size.width, size.height);
    const Image<float> first = noise_frame(size.width, size.height, 1);
    DpStage::Args a = args();
    a.before = first.view(), a.moves = {};
    a.total = before.view(), a.dx = before_dx.view(), a.dy = before_dy.view();
    Device::tbb(1).run<DpStage>(a);
  }
  DpStage::Args args() {
    DpStage::Args a;
    a.score = score.view(), a.before = before.view();
    a.moves = {before_dx.view(), before_dy.view()};
    a.total = total.view(), a.dx = dx.view(), a.dy = dy.view();
    return a;
  }
  Image<float> score, before, total;
  Image<std::int8_t> before_dx, before_dy, dx, dy;
};

}  // namespace

Suite dp_stage_noise(FrameSize size) {
  Suite suite("dp_stage: reach 3, tolerance 2", "px");
  const auto whole = std::make_shared<Stages>(size);
  suite.add_threads("glint", size.pixels(),
                    [whole](const Device& device) { device.run<DpStage>(whole->args()); });
  const FrameSize small{256, 256};
  const auto part = std::make_shared<Stages>(small);
  suite.add({"serial", 1, small.pixels(), [part] { DpStage::serial(part->args()); }});
  suite.ratio_of_threads("of the serial reference", "glint", "serial", {}, {});
  suite.scaling("glint", {});
  return suite;
}

}  // namespace glint::bench
