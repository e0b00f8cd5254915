#include "core/scenario/measured_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "core/files/csv_table.h"
#include "core/scenario/scenario.h"
#include "core/scenario/section_places.h"
#include "core/scenario/sections.h"
#include "core/settings/value.h"
#include "core/settings/wording.h"
#include "core/settings/writer.h"

namespace gaitlab {

namespace {

constexpr std::array<LoggedKind, kLoggedKinds> kKinds{
    {{Logged::angle, "angle", "angle", "rad", "Column of the joint's angle."},
     {Logged::speed, "speed", "speed", "rad/s", "Column of the joint's speed."},
     {Logged::voltage, "voltage", "voltage", "V", "Column of the motor's voltage."},
     {Logged::current, "current", "current", "A", "Column of the motor's current."},
     {Logged::torque, "torque", "torque", "N m", "Column of the torque on the joint."},
     {Logged::duty, "duty", "voltage_command", "", "Column of the share of the supply that the servo gives to its motor."}}};

/// Place of `columns.JOINT.KEY` of the section, or else of the nearest key above it.
SourceLocation place_in(const Node& section, const std::string& joint, const char* key) {
  const Node* const columns = section.find("columns");
  const Node* const of_joint = columns == nullptr ? nullptr : columns->find(joint);
  const Node* const value = of_joint == nullptr ? nullptr : of_joint->find(key);
  const Node* const name = value == nullptr ? nullptr : value->find("column");
  for (const Node* const node : {name, value, of_joint, columns}) {
    if (node != nullptr) return node->place;
  }
  return section.place;
}

/// Reader of the numbers of a log.
class LogReader {
 public:
  LogReader(const Node& section, const Scenario& scenario, Problems& problems)
      : section_(section), scenario_(scenario), problems_(problems), table_(scenario.measured.file) {}

  MeasuredLog read() {
    MeasuredLog log;
    log.t = times();
    log.on = column({scenario_.measured.on}, place_of("on"));
    for (const LoggedJoint& columns : scenario_.measured.columns) {
      const std::optional<std::size_t> joint = joint_of(columns);
      if (!joint) continue;
      MeasuredLog::OfJoint& of = log.joints.emplace_back(MeasuredLog::OfJoint{*joint, {}});
      for (const LoggedKind& kind : kKinds) {
        const auto k = static_cast<std::size_t>(kind.kind);
        of.values[k] = column(columns.columns[k], place_in(section_, columns.name, kind.key));
      }
    }
    return log;
  }

 private:
  std::vector<double> times() {
    std::vector<double> t = column({scenario_.measured.time}, place_of("time"));
    if (t.empty() && table_.rows() > 0) return t;  // there is no such column, which is a problem by now
    if (t.size() < 2) throw std::invalid_argument(fmt::format("the log has {}; expected at least 2", counted(t.size(), "row")));
    for (std::size_t k = 1; k < t.size(); ++k) {
      if (!(t[k] > t[k - 1])) table_.fail(k, scenario_.measured.time, "times must rise");
    }
    const double start = t[0];
    for (double& time : t) time -= start;
    return t;
  }

  [[nodiscard]] SourceLocation place_of(const char* key) const {
    const Node* const stated = section_.find(key);
    return stated == nullptr ? section_.place : stated->place;
  }

  /// Values of a column; none for the name "".
  std::vector<double> column(const LogColumn& of, const SourceLocation& place) {
    if (of.name.empty()) return {};
    if (table_.has(of.name)) return table_.column(of.name, of.scale);
    problems_.add(place,
                  fmt::format("the log has no column {}{}", in_quotes(of.name), offer(of.name, table_.names(), "columns")));
    return {};
  }

  /// Number of a joint whose columns are stated, or nothing after a problem.
  std::optional<std::size_t> joint_of(const LoggedJoint& columns) {
    const std::vector<std::string> names = joint_names(*scenario_.robot);
    const SourceLocation place = place_in(section_, columns.name, "");
    if (std::string wrong = not_one_joint(columns.name, names); !wrong.empty()) {
      problems_.add(place, std::move(wrong));
      return {};
    }
    const std::size_t joint = joints_of(columns.name, names).front();
    const auto stated = [&](const LoggedKind& kind) {
      return !columns.columns[static_cast<std::size_t>(kind.kind)].name.empty();
    };
    if (std::ranges::none_of(kKinds, stated)) {
      problems_.add(place,
                    fmt::format("no column of joint {} is stated; expected angle, speed, voltage, current, torque or duty",
                                columns.name));
      return {};
    }
    const auto of_motor = [&](const LoggedKind& kind) { return stated(kind) && kind.kind >= Logged::voltage; };
    const bool driven = scenario_.robot->joints[joint].driven() && scenario_.actuator.entry != nullptr;
    if (const auto* const kind = std::ranges::find_if(kKinds, of_motor); !driven && kind != kKinds.end()) {
      problems_.add(
          place_in(section_, columns.name, kind->key),
          fmt::format("joint {} has no motor, and therefore no {}; expected angle or speed", columns.name, kind->key));
      return {};
    }
    return joint;
  }

  const Node& section_;
  const Scenario& scenario_;
  Problems& problems_;
  CsvTable table_;
};

/// Adds a problem for each bound of a quantity that the log does not have.
void check_bounds(const Node& section, const MeasuredBounds& bounds, const MeasuredLog& log, Problems& problems) {
  for (std::size_t i = 0; i < bounds.most.size(); ++i) {
    const MeasuredBounds::Number& number = MeasuredBounds::numbers()[i];
    const auto logged = [&](const MeasuredLog::OfJoint& joint) { return !joint.of(number.of).empty(); };
    if (!bounds.stated(i) || std::ranges::any_of(log.joints, logged)) continue;
    const Node* const stated = section.find("bound");
    const Node* const value = stated == nullptr ? nullptr : stated->find(number.key);
    problems.add(value == nullptr ? section.place : value->place,
                 fmt::format("bound has {}, but no joint has a column for {}", number.key,
                             kKinds[static_cast<std::size_t>(number.of)].key));
  }
}

void set_places(Node& node, const SourceLocation& place) {
  node.place = place;
  for (auto& key : node.keys) key.second = place;
  for (Node& item : node.items) set_places(item, place);
}

/// Time of an entry of the section `at`, or 0 if it has none, which its reader reports.
double time_of(const Node& change) {
  const Node* const t = change.find("t");
  return t == nullptr ? 0 : read_number(*t, "").value;
}

/// Inserts changes, in the order of time, into the section `at`.
void insert_changes(Node& root, Node changes, const SourceLocation& place) {
  Node* at = nullptr;
  for (std::size_t i = 0; i < root.keys.size(); ++i) {
    if (root.keys[i].first == "at") at = &root.items[i];
  }
  if (at == nullptr) {
    root.keys.emplace_back("at", place);
    root.items.push_back(std::move(changes));
  } else if (at->kind == Node::Kind::list) {
    std::ranges::move(changes.items, std::back_inserter(at->items));
    std::ranges::stable_sort(at->items, {}, time_of);
  }
}

}  // namespace

std::span<const LoggedKind, kLoggedKinds> logged_kinds() { return kKinds; }

double MeasuredLog::at(const std::vector<double>& values, double time) const {
  const auto next = static_cast<std::size_t>(std::upper_bound(t.begin(), t.end(), time) - t.begin());
  if (next == t.size()) return time == t.back() ? values.back() : std::numeric_limits<double>::quiet_NaN();
  const std::size_t row = next == 0 ? 0 : next - 1;
  return values[row] + (values[row + 1] - values[row]) * (time - t[row]) / (t[row + 1] - t[row]);
}

const std::vector<MeasuredBounds::Number>& MeasuredBounds::numbers() {
  static const std::vector<Number> kAll = [] {
    std::vector<Number> all;
    for (const LoggedKind& kind : kKinds) {
      for (const char* number : kErrorNumbers) all.push_back({fmt::format("{}.{}", kind.key, number), kind.unit, kind.kind});
    }
    for (const char* number : kLimitNumbers) all.push_back({number, "", Logged::duty});
    return all;
  }();
  return kAll;
}

bool MeasuredBounds::any() const {
  return std::ranges::any_of(most, [](double one) { return one != kNotStated; });
}

void MeasuredBounds::fields(Fields& f) {
  for (std::size_t i = 0; i < most.size(); ++i) {
    const Number& number = numbers()[i];
    if (!brief || stated(i))
      Marked(f, Need::optional).number(number.key.c_str(), most[i], {number.unit, 0, 1e9, "Largest value that passes."});
  }
}

void LoggedJoint::fields(Fields& f) {
  for (const LoggedKind& kind : kKinds) {
    const auto k = static_cast<std::size_t>(kind.kind);
    if (!brief || !columns[k].name.empty()) Marked(f, Need::optional).column(kind.key, columns[k], kind.about);
  }
}

void MeasuredSettings::fields(Fields& f) {
  f.file("file", file,
         "The log: a CSV with a line of names, then a line per row, or JSON with a list `entries`; at most 4 MB; required.");
  f.text("time", time, "Column of the times, s, which rise; the first is the start of the run.");
  if (!brief || !on.empty()) {
    Marked(f, Need::optional)
        .text("on", on, "Column that is 0 while the motors have no torque: the joints of `columns` are then open.");
  }
  if (!brief || !source.empty())
    Marked(f, Need::optional).text("source", source, "Origin and licence of the log, which page and verdict cite.");
  for (LoggedJoint& joint : columns) joint.brief = brief;
  bound.brief = brief;
  if (!brief || bound.any())
    f.group("bound", bound, "Bounds of the numbers `measured.*` of a run, which `gaitlab test` judges like a golden.");
  f.by_name(
      "columns", columns, "{angle: COLUMN}",
      "Columns of each joint that was measured, by its name; required. Scale: the number in the column for 1 in SI units.");
}

bool MeasuredSettings::reads(const std::string& column) const {
  return any() && std::ranges::any_of(log->joints, [&](const MeasuredLog::OfJoint& of) {
           const auto is = [&](const char* quantity) { return column == fmt::format("joint.{}.{}", of.joint, quantity); };
           const auto compared = [&](const LoggedKind& kind) { return !of.of(kind.kind).empty() && is(kind.column); };
           return std::ranges::any_of(kKinds, compared) || (!of.of(Logged::angle).empty() && is("speed")) ||
                  (!of.of(Logged::duty).empty() && column == "supply.voltage");
         });
}

void finish_measured(const Node& node, Scenario& scenario, Problems& problems) {
  if (node.kind != Node::Kind::map || !scenario.robot) return;
  const Node* const file = node.find("file");
  const bool path = file != nullptr && file->text.find('\n') == std::string::npos;
  scenario.measured.path = path ? file->text : "";
  if (file == nullptr) problems.add(node.place, "measured has no file; expected the CSV or JSON of the log");
  if (node.find("columns") == nullptr) problems.add(node.place, "measured has no columns; expected {JOINT: {angle: COLUMN}}");
  if (file == nullptr || scenario.measured.columns.empty()) return;
  const std::size_t before = problems.size();
  try {
    MeasuredLog log = LogReader(node, scenario, problems).read();
    check_bounds(node, scenario.measured.bound, log, problems);
    if (problems.size() == before) scenario.measured.log = std::make_shared<const MeasuredLog>(std::move(log));
  } catch (const std::invalid_argument& error) {
    problems.add(file->place, path                      ? fmt::format("log {}, {}", in_quotes(file->text), error.what())
                              : has_place(error.what()) ? fmt::format("the log's {}", error.what())
                                                        : error.what());
  }
}

void insert_torque_off(Node& root, Scenario& scenario) {
  MeasuredSettings& measured = scenario.measured;
  if (!measured.any() || measured.on.empty()) return;
  const std::vector<std::string> no_joints;
  Node joints{Node::Kind::list};
  for (const MeasuredLog::OfJoint& of : measured.log->joints) {
    const Joint& joint = scenario.robot->joints[of.joint];
    if (joint.driven()) joints.items.push_back(text_node(joint.name));
  }
  Node changes{Node::Kind::list};
  bool has_torque = true;
  for (std::size_t k = 0; k < measured.log->t.size() && measured.log->t[k] < scenario.duration; ++k) {
    if ((measured.log->on[k] != 0) == has_torque) continue;
    has_torque = !has_torque;
    Writer fault(no_joints), change(no_joints);
    fault.add("joint", joints);
    fault.add("kind", scalar_node(has_torque ? "none" : "open"));
    const double time = k == 0 ? 0 : (measured.log->t[k - 1] + measured.log->t[k]) / 2;
    change.add("t", scalar_node(number_text(time)));
    change.add("fault", fault.take());
    changes.items.push_back(change.take());
  }
  measured.on.clear();
  if (changes.items.empty() || joints.items.empty()) return;
  const SourceLocation place = given(root, kMeasuredSection, "on").value_or(root.place);
  set_places(changes, place);
  insert_changes(root, std::move(changes), place);
}

}  // namespace gaitlab
