#include "core/laws/boxes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace gaitlab {

namespace {

constexpr std::size_t kFewBoxes = 16;    // up to this number of boxes, testing all is as fast as finding a cell
constexpr double kCellMargin = 0.5;      // margin around a cell, as a share of its edge
constexpr double kLeastEdge = 1e-2;      // m
constexpr double kCellRounding = 1e-9;   // share of the coordinates, which exceeds their rounding error
constexpr double kCellSlack = 1e-3;      // share of the edge; the slack is at least kCellRounding times all coordinates
constexpr double kMostCells = 16;        // largest number of cells per box
constexpr std::size_t kMostListed = 32;  // largest number of list entries per box, in cells of one size
constexpr double kLarge =
    16;  // multiple of the median radius; larger boxes, such as a floor below other boxes, have separate cells
constexpr double kFar = std::numeric_limits<double>::infinity();

/// Cells of one size along x or y.
class CellAxis {
 public:
  /// Covers all boxes whose balls have a radius of at most `largest`.
  CellAxis(const std::vector<Boxes::Ball>& balls, double largest, Eigen::Index of, double edge) : of_(of), edge_(edge) {
    for (const Boxes::Ball& ball : balls) {
      if (ball.radius > largest) continue;
      begin_ = std::min(begin_, ball.center[of] - reach(ball));
      end_ = std::max(end_, ball.center[of] + reach(ball));
    }
  }
  [[nodiscard]] double begin() const { return begin_; }
  [[nodiscard]] double count() const { return std::ceil((end_ - begin_) / edge_); }
  /// Range of cells that list a box: first cell, and the cell after the last.
  [[nodiscard]] std::array<std::size_t, 2> range(const Boxes::Ball& ball) const {
    const auto cell = [&](double at) {
      return static_cast<std::size_t>(std::clamp(std::floor((at - begin_) / edge_), -1.0, count()) + 1);
    };
    const std::size_t first = cell(ball.center[of_] - reach(ball));
    const std::size_t last = cell(ball.center[of_] + reach(ball));
    return {std::max<std::size_t>(first, 1) - 1, std::min(last, static_cast<std::size_t>(count()))};
  }

 private:
  [[nodiscard]] double reach(const Boxes::Ball& ball) const { return ball.radius + (kCellMargin + kCellSlack) * edge_; }

  Eigen::Index of_;
  double edge_, begin_ = kFar, end_ = -kFar;  ///< m
};

}  // namespace

Boxes::Boxes(std::vector<Box> boxes) {
  if (boxes.empty()) return;
  Held held{std::move(boxes), {}, {}, {}};
  held.balls.reserve(held.list.size());
  for (const Box& box : held.list) held.balls.push_back({box.center, 0.5 * box.size.norm()});
  held.all.resize(held.list.size());
  std::iota(held.all.begin(), held.all.end(), 0U);
  held.cells = all_cells(held);
  held_ = std::make_shared<const Held>(std::move(held));
}

Boxes::Boxes(std::initializer_list<Box> boxes) : Boxes(std::vector<Box>(boxes)) {}

const std::vector<Box>& Boxes::list() const {
  static const std::vector<Box> kNone;
  return held_ == nullptr ? kNone : held_->list;
}

double Boxes::margin() const { return held_ == nullptr || held_->cells.empty() ? kFar : held_->cells.front().margin; }

std::span<const std::uint32_t> Boxes::near(const Vec3& place, double distance) const {
  if (held_ == nullptr) return {};
  for (const Cells& cells : held_->cells) {
    if (!(distance <= cells.margin)) continue;
    const double u = (place.x() - cells.x) / cells.edge;
    const double v = (place.y() - cells.y) / cells.edge;
    // The inner condition is false also for NaN, after a run has diverged.
    if (!(u >= 0 && v >= 0 && u < static_cast<double>(cells.columns) && v < static_cast<double>(cells.rows))) {
      if (cells.whole) return {};
      continue;
    }
    const std::size_t cell = static_cast<std::size_t>(v) * cells.columns + static_cast<std::size_t>(u);
    return std::span(cells.listed).subspan(cells.first[cell], cells.first[cell + 1] - cells.first[cell]);
  }
  return held_->all;
}

std::optional<Boxes::Cells> Boxes::cells_of(const Held& held, double largest, double edge) {
  const std::size_t boxes = held.list.size();
  const CellAxis x(held.balls, largest, 0, edge);
  const CellAxis y(held.balls, largest, 1, edge);
  if (x.count() * y.count() > kMostCells * static_cast<double>(boxes)) return {};
  Cells made{edge, kCellMargin * edge, x.begin(), y.begin()};
  made.columns = static_cast<std::size_t>(x.count());
  made.rows = static_cast<std::size_t>(y.count());
  made.whole = largest == kFar;
  made.first.assign(made.columns * made.rows + 1, 0);
  const auto each_cell_of = [&](std::size_t box, const auto& visit) {
    const auto [left, right] = x.range(held.balls[box]);
    const auto [lower, upper] = y.range(held.balls[box]);
    for (std::size_t row = lower; row < upper; ++row) {
      for (std::size_t column = left; column < right; ++column) visit(row * made.columns + column);
    }
  };
  std::size_t listed = 0;
  for (std::size_t i = 0; i < boxes && listed <= kMostListed * boxes; ++i) {
    each_cell_of(i, [&](std::size_t cell) {
      ++made.first[cell + 1];
      ++listed;
    });
  }
  if (listed > kMostListed * boxes) return {};
  std::partial_sum(made.first.begin(), made.first.end(), made.first.begin());
  made.listed.resize(listed);
  std::vector<std::uint32_t> next = made.first;
  for (std::size_t i = 0; i < boxes; ++i)
    each_cell_of(i, [&](std::size_t cell) { made.listed[next[cell]++] = static_cast<std::uint32_t>(i); });
  return made;
}

std::vector<Boxes::Cells> Boxes::all_cells(const Held& held) {
  const std::size_t boxes = held.list.size();
  if (boxes <= kFewBoxes) return {};
  std::vector<double> sizes;
  double farthest = 0;
  for (const Ball& ball : held.balls) {
    sizes.push_back(ball.radius);
    farthest = std::max({farthest, std::abs(ball.center.x()), std::abs(ball.center.y())});
  }
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(boxes / 2);
  std::ranges::nth_element(sizes, middle);
  const double large = kLarge * *middle;
  const double least = std::max({kLeastEdge, 2 * *middle, kCellRounding * farthest});
  std::vector<Cells> all;
  const auto add = [&](double largest) {
    for (double edge = least; std::isfinite(edge); edge *= 2) {
      std::optional<Cells> cells = cells_of(held, largest, edge);
      if (!cells) continue;
      all.push_back(std::move(*cells));
      if (all.back().columns <= 2 && all.back().rows <= 2) return;
    }
  };
  if (std::ranges::any_of(sizes, [&](double size) { return size > large; })) add(large);
  add(kFar);
  return all;
}

}  // namespace gaitlab
