#include "cpg/table.h"

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include "core/files/csv_table.h"

namespace gaitlab::cpg {

const char* const Table::kManual =
    R"(Set points from a CSV text: one row per time, one column per joint. Joints without a column stay at 0.

    theta(t) = a y_k + b y_k+1 + ((a^3 - a) M_k + (b^3 - b) M_k+1) h^2 / 6      t_k <= t <= t_k+1
    h = t_k+1 - t_k,  b = (t - t_k) / h,  a = 1 - b;  for t < ramp: y_0 + (t / ramp) (theta(t) - y_0)

y: the rows; M, interpolation, repeat and ramp: as in gait keyframes (gaitlab explain cpg keyframes). The first line names the
columns: `time` (or `t`; s, from 0 upwards), then joints by name or number (rad). Empty lines and lines that begin with # are
skipped. For a log of another program, `time` and `columns` say which columns to take. With repeat, the last row must equal the
first. `file` is a path relative to the scenario, or the text itself in several lines; the resolved scenario contains the text.
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

/// Columns named after joints, by name or number.
std::vector<JointColumn> columns_of_joints(const CsvTable& table, const std::string& time, const RobotInfo& robot) {
  std::vector<JointColumn> columns;
  for (const std::string& name : table.names()) {
    if (name == time) continue;
    std::size_t j = 0;
    while (j < robot.joints.size() && name != robot.joints[j].name && name != std::to_string(j)) ++j;
    if (j == robot.joints.size()) table.fail(name, "no joint '" + name.substr(0, 40) + "'");
    const auto joint = static_cast<std::int64_t>(j);
    if (std::ranges::find(columns, joint, &JointColumn::joint) != columns.end())
      table.fail(name, "joint '" + std::string(robot.joints[j].name) + "' has a column already");
    columns.push_back({joint, {name}});
  }
  return columns;
}

std::vector<Keyframes::Frame> frames_of(const RobotInfo& robot, const Table::Model& model) {
  const CsvTable table(model.file);
  const std::string time = model.time.empty() ? table.names()[0] : model.time;
  if (model.time.empty() && time != "time" && time != "t")
    table.fail(time, "expected the column time; found '" + time.substr(0, 40) + "'");
  const std::vector<double> times = table.column(time);
  std::vector<Keyframes::Frame> frames(times.size());
  const double start = model.time.empty() || times.empty() ? 0 : times[0];
  for (std::size_t k = 0; k < times.size(); ++k) {
    frames[k].time = times[k] - start;
    frames[k].angles.each.assign(robot.joints.size(), 0.0);
    if (k == 0 && frames[k].time != 0) table.fail(k, time, "the first time must be 0");
    if (k > 0 && !(times[k] > times[k - 1])) table.fail(k, time, "times must rise");
  }
  for (const auto& [joint, column] : model.columns.empty() ? columns_of_joints(table, time, robot) : model.columns) {
    if (joint < 0) continue;
    const std::vector<double> angles = table.column(column.name, column.scale);
    for (std::size_t k = 0; k < angles.size(); ++k) frames[k].angles.each[static_cast<std::size_t>(joint)] = angles[k];
  }
  return frames;
}

Keyframes::Settings keyframes_of(const RobotInfo& robot, const Table::Model& model) {
  Keyframes::Settings settings;
  try {
    settings.model.frames = frames_of(robot, model);
  } catch (const std::invalid_argument& error) {
    const std::string_view what = error.what();
    throw std::invalid_argument(has_place(what) ? "the table's " + std::string(what) : std::string(what));
  }
  settings.model.interpolation = model.interpolation;
  settings.model.repeat = model.repeat;
  settings.model.ramp = model.ramp;
  return settings;
}

}  // namespace

void Table::Model::fields(Fields& f) {
  static constexpr const char* kInterpolations[] = {"spline", "linear", "hold"};
  f.file("file", file, "The CSV: time and joints, or JSON with a list `entries`.");
  f.text("time", time, "Name of the column of times, which may begin at any time; without it, the first column, from 0.");
  f.columns("columns", columns,
            "Column of a joint's set points, for a file whose columns are not named after joints. Scale: the number in the "
            "column for 1 rad.");
  f.choice("interpolation", interpolation, kInterpolations, "Interpolation between rows.");
  f.flag("repeat", repeat, "Start again after the last row, which must equal the first; otherwise hold the last row.");
  f.number("ramp", ramp,
           {"s", 0, 1e6,
            "Duration of the start, in which the motion about the first row grows linearly from 0; without "
            "initial.angles the robot starts at the first row."});
  f.number("cycle", cycle,
           {"s", 0, 1e6, "Period of a motion that the rows repeat by themselves, for the judgement of the run; 0: none."});
}

Table::Table(const RobotInfo& robot, const Settings& settings)
    : frames_(robot, keyframes_of(robot, settings.model)),
      cycle_(settings.model.cycle),
      hold_(settings.model.interpolation == Keyframes::Interpolation::hold) {}

std::string Table::note() const { return hold_ ? "the set points are a recording: nothing in the run acts on them" : ""; }

}  // namespace gaitlab::cpg
