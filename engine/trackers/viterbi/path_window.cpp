// SPDX-License-Identifier: Apache-2.0
#include "glint/engine/trackers/viterbi/path_window.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "glint/engine/state/bytes.hpp"
#include "glint/kernels/dp_stage/dp_stage.hpp"

namespace glint {
namespace {

/// Narrows [first, last) until no beginning and no end of it adds up to zero or less: a path
/// through the whole window would otherwise start before its target is born.
void trim(WindowPath& path) {
  double sum = 0;
  for (std::size_t k = path.first, end = path.last; k < end; ++k) {
    sum += path.cells[k].score;
    if (sum <= 0) path.first = k + 1, sum = 0;
  }
  sum = 0;
  for (std::size_t k = path.last; k > path.first; --k) {
    sum += path.cells[k - 1].score;
    if (sum <= 0) path.last = k - 1, sum = 0;
  }
}

constexpr int kAround = 3;  // [px] where a target that looks as if in a cell may be

void weigh_around(ImageView<const float> score, WindowPath::Cell& cell) {
  double sum = 0, xx = 0, xy = 0, yy = 0;
  for (int j = -kAround; j <= kAround; ++j) {
    for (int i = -kAround; i <= kAround; ++i) {
      if (!score.contains(cell.x + i, cell.y + j)) continue;
      const double ratio = std::exp(double{score(cell.x + i, cell.y + j)} - cell.score);
      sum += ratio, xx += ratio * i * i, xy += ratio * i * j, yy += ratio * j * j;
    }
  }
  constexpr double kPixel = 1.0 / 12;  // variance of a place within its pixel [px^2]
  cell.weight = sum;
  cell.var_x = xx / sum + kPixel, cell.cov_xy = xy / sum, cell.var_y = yy / sum + kPixel;
}

}  // namespace

PathWindow::PathWindow(int stages, double separation, const Device& device)
    : separation_(separation), device_(device), stages_(static_cast<std::size_t>(stages)) {}

void PathWindow::make_maps(int width, int height) {
  for (ResidentImage<float>& total : total_) total = ResidentImage<float>(width, height, device_);
  for (Stage& s : stages_) {
    for (auto* moves : {&s.dx, &s.dy}) *moves = ResidentImage<std::int8_t>(width, height, device_);
  }
}

void PathWindow::restored() {
  require_bytes(oldest_ < stages_.size() && count_ <= stages_.size(),
                "a window of paths is not whole");
  const int width = stages_[0].score.width(), height = stages_[0].score.height();
  const auto allowed = [](int pixels) { return pixels >= 0 && pixels <= kMaxDpReach; };
  for (const Stage& s : stages_) {
    require_bytes(s.score.width() == width && s.score.height() == height &&
                      allowed(s.moves.reach) && allowed(s.moves.tolerance),
                  "a stage of paths is not whole");
  }
  if (width == 0) return;
  make_maps(width, height);
  for (Stage& s : stages_) s.score.make_resident(device_);
}

ImageView<float> PathWindow::next(int width, int height) {
  if (total_[0].width() != width || total_[0].height() != height) {
    make_maps(width, height);
    for (Stage& s : stages_) s.score = ResidentImage<float>(width, height, device_);
    count_ = oldest_ = 0;
  }
  if (full()) oldest_ = (oldest_ + 1) % stages_.size(), --count_;
  return stage(count_).score.view();
}

void PathWindow::push(StageMoves moves) { stage(count_++).moves = moves; }

// The greedy constraint makes every stage depend on where the window starts: no stage of the last
// window can be kept.
void PathWindow::run() {
  for (std::size_t k = 1; k < stages_.size(); ++k) {
    Stage &now = stage(k), &last = stage(k - 1);
    DpStage::Args args;
    args.score = now.score.view();
    args.before = k == 1 ? last.score.view() : total_[newest_total_].view();
    if (k > 1) args.moves = {last.dx.view(), last.dy.view()};
    args.reach = now.moves.reach, args.tolerance = now.moves.tolerance;
    newest_total_ = 1 - newest_total_;
    args.total = total_[newest_total_].view();
    args.dx = now.dx.view(), args.dy = now.dy.view();
    device_.run<DpStage>(args);
  }
  for (Stage& s : stages_) s.fetched.assign(static_cast<std::size_t>(s.score.height()), false);
}

/// Paths are few: of what is resident on the device only the rows that they cross come back.
void PathWindow::fetch_row(Stage& stage, int y) const {
  if (stage.fetched[static_cast<std::size_t>(y)]) return;
  stage.fetched[static_cast<std::size_t>(y)] = true;
  const auto row = [y](const auto& image) {
    const auto view = image.view();
    return std::span(view.row(y), static_cast<std::size_t>(view.width));
  };
  device_.fetch(row(stage.score));
  device_.fetch(row(stage.dx)), device_.fetch(row(stage.dy));
}

WindowPath PathWindow::trace(int x, int y) {
  WindowPath path;
  path.last = stages_.size();
  for (std::size_t k = stages_.size(); k-- > 0;) {
    Stage& s = stage(k);
    fetch_row(s, y);
    path.cells[k] = {.x = x, .y = y, .score = s.score.view()(x, y)};
    path.total += path.cells[k].score;
    if (k == 0) break;
    const int dx = s.dx.view()(x, y), dy = s.dy.view()(x, y);
    x -= dx, y -= dy;
  }
  return path;
}

bool PathWindow::crowded(const WindowPath& path) const {
  return std::ranges::any_of(paths_, [&](const WindowPath& other) {
    for (std::size_t k = 0; k < stages_.size(); ++k) {
      const auto &a = path.cells[k], &b = other.cells[k];
      if (std::hypot(a.x - b.x, a.y - b.y) < separation_) return true;
    }
    return false;
  });
}

void PathWindow::look_around(WindowPath& path) {
  path.log_odds = -std::log(static_cast<double>(width()) * height());
  for (std::size_t k = path.first; k < path.last; ++k) {
    WindowPath::Cell& cell = path.cells[k];
    Stage& s = stage(k);
    for (int j = cell.y - kAround; j <= cell.y + kAround; ++j) {
      if (j >= 0 && j < height()) fetch_row(s, j);
    }
    weigh_around(s.score.view(), cell);
    path.log_odds += cell.score + std::log(cell.weight);
    // The first move is free within the reach, later ones within the tolerance about the last.
    if (k == path.first) continue;
    const int free = k == path.first + 1 ? s.moves.reach : s.moves.tolerance;
    path.log_odds -= 2 * std::log(2 * free + 1);
  }
}

std::span<const WindowPath> PathWindow::find(float threshold) {
  run();
  FindPoints::Args maxima;
  maxima.map = total_[newest_total_].view();
  maxima.threshold = threshold;
  maxima.points = &terminals_;
  maxima.workspace = &workspace_;
  device_.run<FindPoints>(maxima);
  const auto order = [](const Point& p) { return std::tuple(-p.amplitude, p.y, p.x); };
  std::ranges::sort(terminals_, {}, order);
  paths_.clear();
  for (const Point& p : terminals_) {
    const WindowPath path =
        trace(static_cast<int>(std::lround(p.x)), static_cast<int>(std::lround(p.y)));
    if (!crowded(path)) paths_.push_back(path);
  }
  for (WindowPath& path : paths_) {
    trim(path);
    look_around(path);
  }
  return paths_;
}

}  // namespace glint
