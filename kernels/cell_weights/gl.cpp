// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <utility>

#include "glint/kernels/cell_weights/cells.hpp"
#include "glint/kernels/core/gl_context.hpp"
#include "glint/kernels/core/gl_queue.hpp"
#include "glint/kernels/core/gl_scan.hpp"
#include "glint/kernels/core/inline.hpp"
#include "glint_shaders/cell_weights_boxes.hpp"
#include "glint_shaders/cell_weights_sort.hpp"
#include "glint_shaders/cell_weights_sums.hpp"
#include "glint_shaders/cell_weights_weigh.hpp"

namespace glint {
namespace {

#include "glint/kernels/cell_weights/pass.glsl"

std::size_t chunks_of(std::size_t count) { return (count + kChunk - 1) / kChunk; }

template <class T>
void read_into(gl::Queue& queue, const gl::Buffer& from, std::size_t count, std::vector<T>& to) {
  to.resize(count);
  queue.read(from, std::span(to));
}

/// Particles of the device, by cell.
struct Sorted {
  gl::Buffer keys, order;
};

/// The stable sort of `keys`, a digit a pass.
Sorted sort_by_cell(gl::Queue& queue, CellPass pass, gl::Buffer keys) {
  const std::size_t chunks = chunks_of(pass.count);
  const auto cells = static_cast<uint>(pass.width) * static_cast<uint>(pass.height);
  constexpr int kBits = std::countr_zero(kDigits);
  const int bits =
      std::max(1, static_cast<int>(std::bit_width(cells)));  // `cells` itself is the key outside
  gl::Buffer order = queue.buffer<uint>(pass.count);
  const gl::Buffer counts = queue.buffer<uint>(chunks * kDigits);
  for (int shift = 0; shift < bits; shift += kBits) {
    pass.shift = static_cast<uint>(shift);
    queue.run(shaders::cell_weights_sort, "count_digits", chunks, pass, {&keys, &counts});
    gl::scan(queue, counts, chunks * kDigits);
    gl::Buffer sorted_keys = queue.buffer<uint>(pass.count);
    gl::Buffer sorted = queue.buffer<uint>(pass.count);
    queue.run(shaders::cell_weights_sort, "sort", chunks, pass,
              {&keys, &counts, &order, &sorted_keys, &sorted});
    keys = std::move(sorted_keys);
    order = std::move(sorted);
  }
  return {std::move(keys), std::move(order)};
}

/// Runs of equal cells; leaves order, cell and first in `runs`.
struct Runs {
  gl::Buffer cell, first;
};
Runs find_runs(gl::Queue& queue, const CellPass& pass, const Sorted& sorted, CellRuns& runs) {
  const std::size_t chunks = chunks_of(pass.count);
  const gl::Buffer starts = queue.buffer<uint>(chunks), insides = queue.buffer<uint>(chunks);
  const gl::Buffer& none = sorted.order;  // items, which these passes do not read
  queue.run(shaders::cell_weights_sort, "count_runs", chunks, pass,
            {&sorted.keys, &starts, &none, &insides});
  const std::size_t count = gl::sum_before(queue, starts, chunks);
  const uint inside = gl::sum_before(queue, insides, chunks);
  gl::Buffer cell = queue.buffer<uint>(count), first = queue.buffer<uint>(count + 1);
  queue.run(shaders::cell_weights_sort, "write_runs", chunks, pass,
            {&sorted.keys, &starts, &none, &cell, &first});
  queue.write(first, std::span(&inside, 1), count);
  read_into(queue, sorted.order, inside, runs.order);
  read_into(queue, cell, count, runs.cell);
  read_into(queue, first, count + 1, runs.first);
  return {std::move(cell), std::move(first)};
}

void update(gl::Queue& queue, const CellWeights::Args& args, CellWorkspace& space) {
  CellPass pass{};
  pass.width = args.width, pass.height = args.height;
  pass.half_width = args.psi == Psi::window ? args.half_width : 0;
  pass.clutter = args.clutter;
  pass.count = static_cast<uint>(args.x.size());
  const gl::Buffer x = queue.upload(args.x), y = queue.upload(args.y),
                   predicted = queue.upload(args.predicted), ratio = queue.upload(args.log_ratio);
  gl::Buffer keys = queue.buffer<uint>(pass.count);
  const gl::Buffer weighted =
      args.weighted.empty() ? queue.buffer<float>(pass.count) : queue.output(args.weighted);
  const gl::Buffer updated = queue.output(args.updated);
  queue.run(shaders::cell_weights_weigh, "weigh", pass.count, pass,
            {&x, &y, &predicted, &ratio, &keys, &weighted, &updated});

  const Sorted sorted = sort_by_cell(queue, pass, std::move(keys));
  const auto [cell, first] = find_runs(queue, pass, sorted, space.runs);
  const std::size_t runs = space.runs.size();
  pass.count = static_cast<uint>(runs);
  const gl::Buffer cell_sum = queue.buffer<float>(runs), box_sum = queue.buffer<float>(runs),
                   mass = queue.buffer<float>(runs);
  queue.run(shaders::cell_weights_sums, "sum_cells", runs, pass,
            {&sorted.order, &first, &weighted, &cell_sum});
  queue.run(shaders::cell_weights_boxes, "sum_boxes", runs, pass, {&cell, &cell_sum, &box_sum});
  queue.run(shaders::cell_weights_sums, "update", runs, pass,
            {&sorted.order, &first, &weighted, &cell_sum, &box_sum, &updated, &mass});
  queue.read(updated, args.updated);
  queue.read(weighted, args.weighted);
  read_into(queue, cell_sum, runs, space.cell_sum);
  read_into(queue, box_sum, runs, space.box_sum);
  read_into(queue, mass, runs, space.runs.mass);
}

}  // namespace

WholeCall CellWeights::whole(const Args& args) {
  return {
      args.x.size_bytes(),
      {region_of(args.x), region_of(args.y), region_of(args.predicted), region_of(args.log_ratio)},
      {region_of(args.updated), region_of(args.weighted)}};
}

void CellWeights::egl(const Args& args, gl::Context& context) {
  cell_weights::check(args);
  CellWorkspace own;
  CellWorkspace& space = args.workspace ? *args.workspace : own;
  context.run([&](gl::Queue& queue) { update(queue, args, space); });
}

}  // namespace glint
