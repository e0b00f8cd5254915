#include "cpg/table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string_view>

namespace gaitlab::cpg {

const char* const Table::kManual =
    R"(Set points from a CSV text: one row per time, one column per joint. Joints without a column stay at 0.

    theta(t) = a y_k + b y_k+1 + ((a^3 - a) M_k + (b^3 - b) M_k+1) h^2 / 6      t_k <= t <= t_k+1
    h = t_k+1 - t_k,  b = (t - t_k) / h,  a = 1 - b;  for t < ramp: y_0 + (t / ramp) (theta(t) - y_0)

y: the rows; M, interpolation, repeat and ramp: as in gait keyframes (gaitlab explain cpg keyframes). The first line names the
columns: `time` (or `t`; s, rising from 0) first, then joints by name or number (rad). Lines that begin with # and empty lines
are skipped. With repeat the last row must equal the first. `file` is a path relative to the scenario, or the text itself, in
several lines; the resolved scenario holds the text. For a gait that was computed elsewhere, or measured.
Reference: C. de Boor, A Practical Guide to Splines, Springer 1978, chapter IV.

    cpg:
      type: table
      model:
        file: |
          time, m0/active, m0/passive
          0,    0,         0
          0.5,  0.3,       -0.3
          1,    0,         0)";

namespace {

[[noreturn]] void fail(std::size_t line, std::size_t column, const std::string& what) {
  throw std::invalid_argument("the table's line " + std::to_string(line) + ", column " + std::to_string(column) + ": " + what);
}

std::string in_marks(std::string_view text) { return "'" + std::string(text.substr(0, 40)) + "'"; }

struct Cell {
  std::string_view text;
  std::size_t column;  ///< column of the first character, from 1
};

std::vector<Cell> cells_of(std::string_view line) {
  std::vector<Cell> cells;
  for (std::size_t from = 0; from <= line.size();) {
    const std::size_t end = std::min(line.find(',', from), line.size());
    std::size_t first = from;
    std::size_t last = end;
    while (first < end && (line[first] == ' ' || line[first] == '\t')) ++first;
    while (last > first && (line[last - 1] == ' ' || line[last - 1] == '\t' || line[last - 1] == '\r')) --last;
    cells.push_back({line.substr(first, last - first), first + 1});
    from = end + 1;
  }
  return cells;
}

double number(const Cell& cell, std::size_t line) {
  double value = 0;
  const char* end = cell.text.data() + cell.text.size();
  const auto [stopped, error] = std::from_chars(cell.text.data(), end, value);
  if (error != std::errc() || stopped != end || !std::isfinite(value)) {
    fail(line, cell.column, in_marks(cell.text) + " is not a finite number");
  }
  return value;
}

class TableText {
 public:
  TableText(const RobotInfo& robot, std::string_view text) : robot_(robot) {
    std::size_t line = 0;
    while (!text.empty()) {
      const std::size_t end = text.find('\n');
      read(text.substr(0, end), ++line);
      text = end == std::string_view::npos ? "" : text.substr(end + 1);
    }
    if (!headed_) throw std::invalid_argument("the table is empty; expected a line with the names of its columns");
  }
  std::vector<Keyframes::Frame> take() { return std::move(frames_); }

 private:
  void read(std::string_view line, std::size_t number) {
    const std::vector<Cell> cells = cells_of(line);
    if (cells[0].text.starts_with('#') || (cells.size() == 1 && cells[0].text.empty())) return;
    if (headed_) {
      read_row(cells, number);
    } else {
      read_head(cells, number);
    }
  }

  void read_head(const std::vector<Cell>& cells, std::size_t line) {
    headed_ = true;
    if (cells[0].text != "time" && cells[0].text != "t") {
      fail(line, cells[0].column, "expected the column time; found " + in_marks(cells[0].text));
    }
    for (std::size_t i = 1; i < cells.size(); ++i) {
      const std::size_t joint = joint_of(cells[i], line);
      if (std::find(columns_.begin(), columns_.end(), joint) != columns_.end()) {
        fail(line, cells[i].column, "joint " + in_marks(robot_.joints[joint].name) + " has a column already");
      }
      columns_.push_back(joint);
    }
  }

  [[nodiscard]] std::size_t joint_of(const Cell& cell, std::size_t line) const {
    for (std::size_t j = 0; j < robot_.joints.size(); ++j) {
      if (cell.text == robot_.joints[j].name || cell.text == std::to_string(j)) return j;
    }
    fail(line, cell.column, "no joint " + in_marks(cell.text));
  }

  void read_row(const std::vector<Cell>& cells, std::size_t line) {
    if (cells.size() != columns_.size() + 1) {
      fail(line, 1, std::to_string(cells.size()) + " cells; expected " + std::to_string(columns_.size() + 1));
    }
    Keyframes::Frame frame;
    frame.time = number(cells[0], line);
    const double before = frames_.empty() ? 0 : frames_.back().time;
    if (frames_.empty() ? frame.time != 0 : !(frame.time > before)) {
      fail(line, cells[0].column, frames_.empty() ? "the first time must be 0" : "times must rise");
    }
    frame.angles.each.assign(robot_.joints.size(), 0.0);
    for (std::size_t i = 1; i < cells.size(); ++i) frame.angles.each[columns_[i - 1]] = number(cells[i], line);
    frames_.push_back(std::move(frame));
  }

  const RobotInfo& robot_;
  bool headed_ = false;
  std::vector<std::size_t> columns_;  ///< column in the text of each joint
  std::vector<Keyframes::Frame> frames_;
};

Keyframes::Settings keyframes_of(const RobotInfo& robot, const Table::Model& model) {
  Keyframes::Settings settings;
  settings.model.frames = TableText(robot, model.file).take();
  settings.model.interpolation = model.interpolation;
  settings.model.repeat = model.repeat;
  settings.model.ramp = model.ramp;
  return settings;
}

}  // namespace

void Table::Model::fields(Fields& f) {
  static constexpr const char* kInterpolations[] = {"spline", "linear"};
  f.file("file", file, "The CSV: time and joints.");
  f.choice("interpolation", interpolation, kInterpolations, "Interpolation between rows.");
  f.flag("repeat", repeat, "Start again after the last row, which must equal the first; otherwise hold the last row.");
  f.number("ramp", ramp,
           {"s", 0, 1e6,
            "Duration of the start, in which the motion about the first row grows linearly from 0; without "
            "initial.angles the robot starts at the first row."});
}

Table::Table(const RobotInfo& robot, const Settings& settings) : frames_(robot, keyframes_of(robot, settings.model)) {}

}  // namespace gaitlab::cpg
