// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <vector>

#include "glint/kernels/cell_integrals/lanes.hpp"
#include "glint/kernels/cell_integrals/neighbours.hpp"
#include "glint/kernels/core/gl_context.hpp"
#include "glint/kernels/core/gl_queue.hpp"
#include "glint_shaders/cell_integrals_axes.hpp"
#include "glint_shaders/cell_integrals_frame.hpp"
#include "glint_shaders/cell_integrals_rows.hpp"
#include "glint_shaders/cell_integrals_targets.hpp"

namespace glint {
namespace {

#include "glint/kernels/cell_integrals/pass.glsl"
static_assert(sizeof(Box) == 16 && sizeof(RowSums) == 28 && sizeof(WindowSums) == 88);

using cell_integrals::PartialSums;
using Args = CellIntegrals::Args;

CellBand band_of(FrameView frame, const CellRule& rule) {
  CellBand band{};
  band.width = frame.width;
  band.boxes = static_cast<uint>(rule.missing.size());
  band.threshold = rule.threshold, band.offset = rule.subtract ? rule.threshold : 0;
  band.truncate_dark = rule.truncate_dark ? 1 : 0;
  return band;
}

/// Calls f(frame, band) for the frame's bands on the device.
template <class F>
void each_frame_band(gl::Queue& queue, FrameView frame, CellBand band, const F& f) {
  if (frame.empty()) return;
  const std::size_t row = sizeof(float) * static_cast<std::size_t>(frame.width);
  gl::each_band(queue, frame.height, row, 0, [&](const gl::Band& part) {
    band.first = part.first, band.last = part.last;
    f(queue.upload(gl::rows(frame, part.first, part.last)), band);
  });
}

/// Targets by the place of their windows, with the neighbours of each.
struct Windows {
  std::vector<LaneTarget> targets;
  std::vector<Window> windows;
  std::vector<uint> neighbours;
  uint axis_cells = 0;
};

Windows windows_of(const Args& args) {
  Windows all;
  std::vector<LaneTarget> located(args.targets.size());
  const CellIntegralsLanes& lanes = cell_integrals_lanes(Isa::plain);
  lanes.locate(args.targets.data(), 0, located.size(), args.reach, args.frame.width,
               args.frame.height, located.data());
  cell_integrals::Grid grid;
  grid.sort(located, args.frame.width, args.frame.height, all.targets);
  for (std::size_t k = 0; k < all.targets.size(); ++k) {
    const LaneTarget& t = all.targets[k];
    const auto first = static_cast<uint>(all.neighbours.size());
    grid.each_neighbour(all.targets, k, [&](uint j) { all.neighbours.push_back(j); });
    all.windows.push_back({t.box.x0, t.box.y0, t.box.x1, t.box.y1, t.left, t.top, t.sigma_x,
                           t.sigma_y, t.proportion, all.axis_cells, first,
                           static_cast<uint>(all.neighbours.size())});
    all.axis_cells += static_cast<uint>(t.box.x1 - t.box.x0 + t.box.y1 - t.box.y0);
  }
  return all;
}

/// Rows of windows in order of their targets, a piece at a time.
struct Rows {
  std::vector<WindowRow> rows;
  std::vector<RowRun> runs;

  void add(uint target, int y) {
    const auto at = static_cast<uint>(rows.size());
    if (runs.empty() || runs.back().target != target) runs.push_back({target, at, at});
    rows.push_back({target, y});
    ++runs.back().end;
  }
  void clear() { rows.clear(), runs.clear(); }
};

/// One call: targets and their sums on the device.
class DeviceTargets {
 public:
  DeviceTargets(gl::Queue& queue, const Args& args, const Windows& all)
      : queue_(queue),
        all_(all),
        boxes_(queue.upload(args.rule.missing)),
        windows_(queue.upload(std::span(all.windows))),
        neighbours_(queue.upload(std::span(all.neighbours))),
        axes_(queue.buffer<AxisCell>(all.axis_cells)),
        axis_totals_(queue.buffer<double>(2 * all.windows.size())),
        sums_(queue.buffer<WindowSums>(all.windows.size())) {
    CellBand pass{};
    pass.items = static_cast<uint>(2 * all.windows.size());
    queue_.run(shaders::cell_integrals_axes, "integrate", pass.items, pass,
               {&windows_, &axes_, &axis_totals_});
    const std::vector<WindowSums> nothing(all.windows.size());
    queue_.write(sums_, std::span(nothing));
  }

  /// Adds what the rows of a band show.
  void add_band(const gl::Buffer& frame, const CellBand& band) {
    const std::size_t most = queue_.max_bytes() / sizeof(RowSums);
    Rows piece;
    for (uint k = 0; k < all_.windows.size(); ++k) {
      const Window& w = all_.windows[k];
      for (int y = std::max(w.y0, band.first); y < std::min(w.y1, band.last); ++y) {
        piece.add(k, y);
        if (piece.rows.size() == most) add_rows(frame, band, piece);
      }
    }
    add_rows(frame, band, piece);
  }

  /// Sums by the caller's order of targets; returns the sum of the log ratios.
  double read(std::vector<PartialSums>& partial) {
    std::vector<WindowSums> sums(all_.windows.size());
    std::vector<double> totals(2 * sums.size());
    queue_.read(sums_, std::span(sums));
    queue_.read(axis_totals_, std::span(totals));
    partial.resize(sums.size());
    double log_ratio = 0;
    for (std::size_t k = 0; k < sums.size(); ++k) {
      const WindowSums& s = sums[k];
      partial[all_.targets[k].index] = {s.count,
                                        s.x,
                                        s.y,
                                        s.xx,
                                        s.yy,
                                        s.missing,
                                        s.missing_x,
                                        s.missing_y,
                                        s.missing_xx,
                                        s.missing_yy,
                                        totals[2 * k] * totals[2 * k + 1]};
      log_ratio += s.log_ratio;
    }
    return log_ratio;
  }

 private:
  void add_rows(const gl::Buffer& frame, CellBand band, Rows& piece) {
    const gl::Buffer rows = queue_.upload(std::span<const WindowRow>(piece.rows)),
                     runs = queue_.upload(std::span<const RowRun>(piece.runs)),
                     row_sums = queue_.buffer<RowSums>(piece.rows.size());
    band.items = static_cast<uint>(piece.rows.size());
    queue_.run(shaders::cell_integrals_rows, "sum_row", band.items, band,
               {&frame, &boxes_, &windows_, &neighbours_, &axes_, &rows, &row_sums});
    band.items = static_cast<uint>(piece.runs.size());
    queue_.run(shaders::cell_integrals_targets, "add_rows", band.items, band,
               {&windows_, &axes_, &rows, &row_sums, &runs, &sums_});
    piece.clear();
  }

  gl::Queue& queue_;
  const Windows& all_;
  gl::Buffer boxes_, windows_, neighbours_, axes_, axis_totals_, sums_;
};

}  // namespace

void SumCells::egl(const Args& args, gl::Context& context) {
  *args.total = {};
  context.run([&](gl::Queue& queue) {
    const gl::Buffer boxes = queue.upload(args.rule.missing);
    const auto add_band = [&](const gl::Buffer& frame, CellBand band) {
      band.items = static_cast<uint>((band.width + kSpan - 1) / kSpan * (band.last - band.first));
      std::vector<double> norms(band.items);
      std::vector<uint> shown(band.items);
      const gl::Buffer norm = queue.buffer<double>(band.items),
                       count = queue.buffer<uint>(band.items);
      queue.run(shaders::cell_integrals_frame, "sum_cells", band.items, band,
                {&frame, &boxes, &norm, &count});
      queue.read(norm, std::span(norms));
      queue.read(count, std::span(shown));
      for (const double n : norms) args.total->norm += n;
      for (const uint n : shown) args.total->shown += n;
    };
    each_frame_band(queue, args.frame, band_of(args.frame, args.rule), add_band);
  });
}

void CellIntegrals::egl(const Args& args, gl::Context& context) {
  cell_integrals::check(args);
  const Windows all = windows_of(args);
  std::vector<PartialSums> partial;
  double log_ratio_sum = 0;
  context.run([&](gl::Queue& queue) {
    DeviceTargets targets(queue, args, all);
    CellBand band = band_of(args.frame, args.rule);
    band.background = static_cast<float>(args.background / cell_integrals::cells_of(args));
    band.log_likelihood = args.log_likelihood ? 1 : 0;
    each_frame_band(queue, args.frame, band, [&](const gl::Buffer& frame, const CellBand& part) {
      targets.add_band(frame, part);
    });
    log_ratio_sum = targets.read(partial);
  });
  const cell_integrals::Totals totals = cell_integrals::totals_of(args, partial);
  for (std::size_t k = 0; k < partial.size(); ++k) {
    args.sums[k] = cell_integrals::normalised(args.targets[k], partial[k], totals.missing_weight);
  }
  cell_integrals::fill_mixture(args, totals, log_ratio_sum);
}

}  // namespace glint
