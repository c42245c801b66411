// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/cell_integrals/cell_integrals.hpp"

#include <memory>
#include <string>

#include "glint/bench/baselines/full_frame_hpmht.hpp"
#include "glint/bench/data.hpp"
#include "glint/bench/kernels/suites.hpp"
#include "glint/kernels/core/random.hpp"

namespace glint::bench {
namespace {

/// One expectation step for targets all over the frame, windows of +-5 sigma, 15x15 at most.
struct Scene {
  Scene(FrameSize size, std::size_t count)
      : frame(noise_frame(size.width, size.height)), targets(count), sums(count) {
    for (std::uint32_t k = 0; k < count; ++k) {
      const Words4 r = random_words(random_key(5, 0, Purpose::trial), k);
      targets[k] = {10 + (size.width - 20.0) * uniform(r.w[0]),
                    10 + (size.height - 20.0) * uniform(r.w[1]), 1 + 0.4 * uniform(r.w[2]),
                    1 + 0.4 * uniform(r.w[3]), 0.3 / static_cast<double>(count)};
    }
    device.run<SumCells>({frame.view(), {.threshold = 1, .subtract = true}, &total});
  }
  CellIntegrals::Args args() {
    CellIntegrals::Args a;
    a.frame = frame.view();
    a.rule = {.threshold = 1, .subtract = true};
    a.total = total;
    a.background = 0.7;
    a.targets = targets, a.sums = sums;
    a.mixture = &mixture;
    a.workspace = &workspace;
    return a;
  }

  Device device = Device::tbb(1);
  Image<float> frame;
  std::vector<HistogramTarget> targets;
  std::vector<TargetSums> sums;
  CellTotal total;
  MixtureSums mixture;
  IntegralsWorkspace workspace;
};

/// Short calls are timed many at a time.
std::function<void(const Device&)> kernel(const std::shared_ptr<Scene>& scene, int calls) {
  return [scene, calls](const Device& device) {
    for (int i = 0; i < calls; ++i) device.run<CellIntegrals>(scene->args());
  };
}

void add_serial(Suite& suite, const std::shared_ptr<Scene>& scene) {
  suite.add({"windowed serial", 1, static_cast<double>(scene->targets.size()),
             [scene] { CellIntegrals::serial(scene->args()); }});
}

void add_full_frame(Suite& suite, const std::shared_ptr<Scene>& scene) {
  const auto mixture =
      std::make_shared<std::vector<double>>(static_cast<std::size_t>(scene->frame.width()) *
                                            static_cast<std::size_t>(scene->frame.height()));
  suite.add({"full frame in double", 1, 1, [scene, mixture] {
               scene->sums[0] = full_frame_cell_integrals(scene->frame, 1, scene->targets[0], 0.7,
                                                          *mixture, scene->mixture);
             }});
}

}  // namespace

Suite cell_integrals_one() {
  Suite suite("cell_integrals: 1 target in 200x200", "target");
  const auto scene = std::make_shared<Scene>(FrameSize{200, 200}, 1);
  constexpr int kCalls = 2000;
  suite.add({"glint x1", 1, kCalls, [scene, run = kernel(scene, kCalls)] { run(scene->device); }});
  add_serial(suite, scene);
  add_full_frame(suite, scene);
  suite.ratio("of the full frame in double", "glint x1", "full frame in double", {3e4, 3e4});
  suite.ratio("of the windowed serial reference", "glint x1", "windowed serial");
  return suite;
}

Suite cell_integrals_hundred() {
  Suite suite("cell_integrals: 100 targets in 1024x1024", "target");
  const auto scene = std::make_shared<Scene>(FrameSize{1024, 1024}, 100);
  constexpr int kCalls = 50;
  suite.add_threads("glint", 100 * kCalls, kernel(scene, kCalls));
  add_serial(suite, scene);
  suite.ratio_of_threads("of the windowed serial reference", "glint", "windowed serial", {32, 32},
                         {});
  return suite;
}

Suite cell_integrals_many(FrameSize size) {
  Suite suite("cell_integrals: 10000 targets in the frame", "target");
  const auto scene = std::make_shared<Scene>(size, 10000);
  suite.add_threads("glint", 10000, kernel(scene, 1));
  add_serial(suite, scene);
  suite.ratio_of_threads("of the windowed serial reference", "glint", "windowed serial", {},
                         {15, 40});
  suite.scaling("glint", {});
  return suite;
}

Suite cell_integrals_growth() {
  Suite suite("cell_integrals: growth with pixels and targets", "target");
  const auto add = [&suite](const std::string& name, FrameSize size, std::size_t count) {
    const auto scene = std::make_shared<Scene>(size, count);
    suite.add({name, 1, static_cast<double>(count),
               [scene, run = kernel(scene, 1)] { run(scene->device); }});
  };
  add("1000 in 1024x1024", {1024, 1024}, 1000);
  add("1000 in 2048x2048", {2048, 2048}, 1000);
  add("1000 in 4096x4096", {4096, 4096}, 1000);
  add("10000 in 4096x4096", {4096, 4096}, 10000);
  add("100000 in 4096x4096", {4096, 4096}, 100000);
  suite.growth("pixels, 1000 targets",
               {"1000 in 1024x1024", "1000 in 2048x2048", "1000 in 4096x4096"}, {});
  suite.growth("1e4 to 1e5 targets", {"10000 in 4096x4096", "100000 in 4096x4096"},
               {{}, 1.5, true});
  return suite;
}

}  // namespace glint::bench
