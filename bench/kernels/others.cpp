// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>
#include <vector>

#include "glint/bench/data.hpp"
#include "glint/bench/kernels/suites.hpp"
#include "glint/bench/limits.hpp"
#include "glint/kernels/cell_weights/cell_weights.hpp"
#include "glint/kernels/find_points/find_points.hpp"
#include "glint/kernels/trials.hpp"

namespace glint::bench {
namespace {

struct Cells {
  Cells(FrameSize frame, std::size_t n)
      : size(frame), particles(clouds(n, 50, frame.width, frame.height)), log_ratio(n), updated(n) {
    for (std::size_t i = 0; i < n; ++i) log_ratio[i] = particles.vx[i];
  }
  CellWeights::Args args() {
    CellWeights::Args a;
    a.width = size.width;
    a.height = size.height;
    a.x = particles.x;
    a.y = particles.y;
    a.predicted = particles.weight;
    a.log_ratio = log_ratio;
    a.updated = updated;
    a.workspace = &workspace;
    return a;
  }

  FrameSize size;
  Particles particles;
  AlignedVector<float> log_ratio, updated;
  CellWorkspace workspace;
};

struct NamedDevice {
  std::string name;
  Device device;
};

/// A case a device: all trials of a kernel.
void add_trials(Suite& suite, const KernelEntry& kernel, const std::vector<NamedDevice>& devices) {
  using Trials = std::vector<std::unique_ptr<Trial>>;
  const auto trials = std::make_shared<Trials>(trials_of(kernel));
  for (const auto& [name, device] : devices) {
    suite.add({std::string(kernel.name) + name, 1, 1, [trials, device = device] {
                 for (const auto& trial : *trials) trial->run(device);
               }});
  }
}

}  // namespace

Suite cell_weights_clouds(FrameSize size) {
  Suite suite("cell_weights: 1e6 around 50 targets", "particle");
  constexpr std::size_t kCount = 1000000, kFew = 20000;
  const auto cells = std::make_shared<Cells>(size, kCount);
  suite.add_threads("glint", kCount,
                    [cells](const Device& device) { device.run<CellWeights>(cells->args()); });
  suite.add_threads("limit: read 12 B, write 4 B", kCount, [cells](const Device& device) {
    combine(device.workers(), cells->particles.x, cells->particles.y, cells->log_ratio,
            cells->updated);
  });
  const auto few = std::make_shared<Cells>(size, kFew);
  suite.add({"serial", 1, kFew, [few] { CellWeights::serial(few->args()); }});
  suite.ratio_threads("of reading 12 B and writing 4 B", "glint", "limit: read 12 B, write 4 B", {},
                      {});
  suite.ratio_of_threads("of the serial reference", "glint", "serial", {}, {});
  suite.scaling("glint", {});
  return suite;
}

Suite find_points_noise(FrameSize size) {
  Suite suite("find_points: local maxima of 3x3", "px");
  struct Map {
    Image<float> map;
    std::vector<Point> points;
    PointWorkspace workspace;
    FindPoints::Args args() {
      FindPoints::Args a{map.view()};
      a.threshold = 3.5f;
      a.points = &points;
      a.workspace = &workspace;
      return a;
    }
  };
  const auto whole = std::make_shared<Map>(Map{noise_frame(size.width, size.height), {}, {}});
  suite.add_threads("glint", size.pixels(),
                    [whole](const Device& device) { device.run<FindPoints>(whole->args()); });
  suite.add_threads("limit: read", size.pixels(), [whole](const Device& device) {
    read(device.workers(), memory_of(FrameView(whole->map)));
  });
  const FrameSize small{512, 512};
  const auto part = std::make_shared<Map>(Map{noise_frame(small.width, small.height), {}, {}});
  suite.add({"serial", 1, small.pixels(), [part] { FindPoints::serial(part->args()); }});
  suite.ratio_threads("of reading", "glint", "limit: read", {}, {});
  suite.ratio_of_threads("of the serial reference", "glint", "serial", {}, {});
  suite.scaling("glint", {1.6, 1.6});
  return suite;
}

Suite kernel_trials() {
  Suite suite("every kernel's parity trials", "set of trials");
  for (const KernelEntry& kernel : all_kernels()) {
    const std::string name(kernel.name);
    add_trials(suite, kernel, {{" tbb x1", Device::tbb(1)}, {" serial", Device::serial()}});
    suite.ratio(name + " of the serial reference, x1", name + " tbb x1", name + " serial");
  }
  return suite;
}

Suite egl_trials(const Device& egl) {
  Suite suite("parity trials on " + egl.description(), "set of trials");
  for (const KernelEntry& kernel : all_kernels()) {
    if (!kernel.on_egl) continue;
    const std::string name(kernel.name);
    add_trials(suite, kernel, {{" egl", egl}, {" tbb", Device::tbb()}});
    suite.ratio(name + " of tbb", name + " egl", name + " tbb");
  }
  return suite;
}

}  // namespace glint::bench
