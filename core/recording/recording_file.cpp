#include "core/recording/recording_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <optional>
#include <string_view>
#include <type_traits>

#include "core/errors.h"
#include "core/model/pattern.h"
#include "core/recording/csv.h"
#include "core/recording/run_files.h"

namespace gaitlab {

namespace {

namespace fs = std::filesystem;

constexpr const char* kHinges = "energy.hinges";
constexpr const char* kCurrent = "robot_current.";
constexpr const char* kEnded = "ended";

/// A companion rollout, with its description in definitions of columns.
struct PartingName {
  const char* key;
  Parting StepTally::*member;
  const char* words;
};
constexpr std::array kPartings{
    PartingName{"twin", &StepTally::event, "a rollout with other steps"},
    PartingName{"chaotic", &StepTally::chaotic, "a rollout under gravity times 1 + 1e-9"},
    PartingName{"ill", &StepTally::ill, "a rollout under gravity times 1 + 1e-6 (1000 times the difference for 1e-9)"}};
constexpr std::string_view kParting = "parting.";

/// Visits every number of a recording that does not belong to a row or a joint: visit(name, unit, definition, number).
template <class OfRecording, class Visit>
void each_number(OfRecording& r, Visit visit) {
  visit("simulated", "s", "simulated time", r.simulated);
  visit("steps", "", "steps of the simulation", r.steps);
  visit("control_ticks", "", "control ticks", r.control_ticks);
  visit("control_ticks_above_1", "", "control ticks at which h lambda exceeded 1", r.control_ticks_above_1);
  visit("stability.rate", "1/s", "largest lambda seen at a control tick", r.worst.rate);
  visit("stability.source", "", "source of that lambda: 0 motor, 1 stop, 2 contact, 3 passive hinge, 4 play", r.worst.source);
  visit("stability.index", "", "number of that joint or contact element", r.worst.index);
  visit("stability.time", "s", "time of that tick", r.worst_time);
  visit("energy.electrical", "J", "energy drawn by the motors", r.ledger.electrical);
  visit("energy.copper", "J", "energy lost in the motors' windings", r.ledger.copper);
  visit("energy.gear", "J", "energy lost in the gears, minus the energy that they created", r.ledger.gear);
  visit("energy.contact", "J", "energy given to the ground along its normal", r.ledger.contact);
  visit("energy.friction", "J", "energy given to the ground along its surface", r.ledger.friction);
  visit("energy.stops", "J", "energy given to the hinge stops", r.ledger.stops);
  visit("energy.stored", "J", "kinetic and potential energy, minus the value at the start", r.ledger.stored);
  visit(kHinges, "J", "energy lost in dampers and friction of passive hinges", r.ledger.hinges);
  visit("energy.dry", "J", "energy lost in dry and viscous friction of driven joints", r.ledger.dry);
  visit(kCurrent + std::string("peak"), "A", "largest sum of the magnitudes of all motors' currents", r.current_peak);
  visit(kCurrent + std::string("rms"), "A", "RMS of that sum", r.current_rms);
  visit("solves", "", "solves of the equations of motion", r.tally.solves);
  visit("off_law", "", "joint-steps that do not satisfy the law of their motor or end stop", r.tally.off);
  visit("coarse_time", "s", "time in which the steps did not reach the accuracy", r.tally.coarse);
  visit("torque_error.estimated", "", "1: the torque error was estimated", r.tally.estimated);
  for (const PartingName& one : kPartings) {
    const std::string name = std::string(kParting) + one.key;
    auto& parting = r.tally.*one.member;
    visit(name + ".time", "s",
          std::string("time at which run and ") + one.words + " first differed by more than the accuracy; below 0: never",
          parting.time);
    visit(name + ".joint", "", "number of the joint in which they differed", parting.joint);
    visit(name + ".share", "", "RMS of the torque difference over the torque peak, for the worst joint", parting.share);
  }
  visit(kEnded, "", "end of the run: 0 done, 1 diverged, 2 plugin, 3 stopped, 4 interrupted, 5 not run, 6 early",
        r.outcome.ended);
}

/// Visits every number of joint `j`: visit(name, unit, definition, number).
template <class OfRecording, class Visit>
void each_number_of(OfRecording& r, std::size_t j, Visit visit) {
  for (const JointStatistic& one : kJointStatistics) visit(one.name, one.unit, one.definition, r.joints[j].*one.member);
  visit("torque_error", "N m", "estimate of the motor torque's error, RMS", r.tally.torque_error[j]);
  visit("torque_error_peak", "N m", "largest motor torque at the times of that estimate", r.tally.torque_peak[j]);
}

/// The numbers of the run and of its joints as tables.
struct NumberTables {
  Trace run, joints;
};

NumberTables number_tables(const Recording& r) {
  NumberTables made;
  Trace& run = made.run;
  Trace& joints = made.joints;
  each_number(r, [&](const std::string& name, const char* unit, const std::string& definition, const auto& number) {
    run.columns.push_back({name, unit, definition});
    run.values.push_back(static_cast<double>(number));
  });
  for (std::size_t j = 0; j < r.joints.size(); ++j) {
    each_number_of(r, j, [&](const char* name, const char* unit, const char* definition, double number) {
      if (j == 0) joints.columns.push_back({name, unit, definition});
      joints.values.push_back(number);
    });
  }
  return made;
}

/// Tables beside the trace. `numbers` are from the same recording and must outlive the result.
std::vector<BesideOf> tables(const Recording& r, const NumberTables& numbers) {
  std::vector<BesideOf> all{{"rest", &r.rest},   {"ticks", &r.ticks},         {"loads", &r.loads},
                            {"poses", &r.poses}, {"joints", &numbers.joints}, {"run", &numbers.run}};
  if (r.spread.rows() > 0) all.push_back({"spread", &r.spread});
  if (r.draws.rows() > 0) all.push_back({"draws", &r.draws});
  if (r.supply.rows() > 0) all.push_back({"supply", &r.supply});
  return all;
}

InputError unfit(const fs::path& file, const std::string& what) {
  return {SourceLocation{file.string()}, "is corrupt: " + what};
}

/// Reads the numbers of the joints and of the run from their tables.
void take_numbers(const fs::path& file, const Trace& joints, const Trace& run, Recording& r) {
  const auto value = [&](const Trace& table, std::size_t row, const std::string& name) {
    const std::size_t column = table.find(name);
    if (column == table.columns.size() || row >= table.rows()) throw unfit(file, fmt::format("there is no number {}", name));
    return table.at(row, column);
  };
  r.joints.resize(joints.rows());
  r.tally.torque_error.resize(joints.rows());
  r.tally.torque_peak.resize(joints.rows());
  for (std::size_t j = 0; j < joints.rows(); ++j) {
    each_number_of(r, j,
                   [&](const std::string& name, const char*, const char*, double& number) { number = value(joints, j, name); });
  }
  each_number(r, [&](const std::string& name, const char*, const std::string&, auto& number) {
    using Number = std::remove_reference_t<decltype(number)>;
    const double read = value(run, 0, name);
    // Largest value of a flag, an enum, or a count. A double contains counts exactly up to 2^53.
    constexpr double kMost = std::is_same_v<Number, bool>    ? 1
                             : std::is_same_v<Number, Ended> ? static_cast<double>(enum_names<Ended>().size() - 1)
                             : std::is_enum_v<Number>        ? 4
                                                             : 0x1p53;
    if (!std::is_floating_point_v<Number> && !(read >= 0 && read <= kMost))
      throw unfit(file, fmt::format("{} is {}", name, read));
    number = static_cast<Number>(read);
  });
}

/// Requires a table with the times of `ticks`. The tables of a run that ended early may end with different ticks.
void require_rows_of_ticks(const fs::path& file, const Recording& r, const Trace& table, const char* name) {
  if (!r.outcome.done()) return;
  bool same = table.rows() == r.ticks.rows();
  for (std::size_t k = 0; same && k < table.rows(); ++k) same = table.at(k, 0) == r.ticks.at(k, 0);
  if (!same) throw unfit(file, fmt::format("the times of /recording/{} are not those of /recording/ticks", name));
}

/// Requires the columns and the rows of a supply, which its checks read by their numbers.
void check_supply(const fs::path& file, const Recording& r) {
  if (r.supply.columns.empty()) return;
  const auto same = [](const Column& a, const Column& b) { return a.name == b.name; };
  std::vector<std::string> modules;
  for (std::size_t bus = 0; bus < r.buses(); ++bus) {
    const std::string& first = r.supply.columns[1 + bus * kBusColumns].name;
    const std::size_t dot = first.find('.');
    modules.push_back(dot == std::string::npos ? "" : first.substr(0, dot));
  }
  if (!std::ranges::equal(r.supply.columns, supply_columns(modules), same)) {
    throw unfit(file, "the columns of /recording/supply are not those of a supply");
  }
  require_rows_of_ticks(file, r, r.supply, "supply");
}

/// Moves tables of tables() back into the recording.
void take_tables(const fs::path& file, std::vector<Beside>& beside, Recording& r) {
  const auto find = [&](const char* name) { return std::ranges::find(beside, name, &Beside::name); };
  const auto take = [&](const char* name) -> Trace {
    const auto found = find(name);
    if (found == beside.end()) throw unfit(file, fmt::format("there is no table /recording/{}", name));
    return std::move(found->table);
  };
  r.rest = take("rest");
  r.ticks = take("ticks");
  r.loads = take("loads");
  r.poses = take("poses");
  if (find("spread") != beside.end()) r.spread = take("spread");
  if (find("draws") != beside.end()) r.draws = take("draws");
  if (find("supply") != beside.end()) r.supply = take("supply");
  check_supply(file, r);
  require_rows_of_ticks(file, r, r.poses, "poses");
  const Trace joints = take("joints");
  const Trace run = take("run");
  take_numbers(file, joints, run, r);
  for (const PartingName& one : kPartings) {
    const std::size_t joint = (r.tally.*one.member).joint;
    if (joint > 0 && joint >= r.joints.size()) throw unfit(file, fmt::format("{}{}.joint is {}", kParting, one.key, joint));
  }
  if (!std::isfinite(r.simulated) || r.simulated < 0) throw unfit(file, fmt::format("simulated is {}", r.simulated));
  if (!r.rest.columns.empty() && r.rest.rows() != r.trace.rows()) {
    throw unfit(file, fmt::format("{} rows in /recording/rest, {} in the trace", r.rest.rows(), r.trace.rows()));
  }
}

}  // namespace

namespace {

constexpr std::size_t kKept = std::size_t{1} << 24;  // bytes

/// Writes recording.h5, with the data that trace.csv lacks.
void write_beside(const Recording& r, Provenance origin, const fs::path& folder) {
  origin.csv_hash = hash(r.trace);
  write_h5({}, origin, folder / kBesideCsv, tables(r, number_tables(r)));
}

/// Runs `write`. If memory runs out, returns the message for this case.
template <class Write>
std::optional<std::string> short_of_memory(const fs::path& file, const Write& write) {
  try {
    write();
    return {};
  } catch (const NoImage& error) {
    return error.what();
  } catch (const std::bad_alloc&) {
    return file.string() + ": cannot be written: out of memory";
  }
}

}  // namespace

void write_recording(const Recording& r, const Provenance& origin, const std::string& format, const fs::path& folder) {
  const fs::path rows = folder / "trace.csv";
  if (format == "csv") {
    write_csv(r.trace, rows);
    return write_beside(r, origin, folder);
  }
  const fs::path file = folder / "trace.h5";
  const auto why = short_of_memory(file, [&] {
    std::string
        kept;  // reserve for the message and the code after it, because HDF5 does not free the memory of an unfinished file
    kept.reserve(kKept);
    write_h5(r.trace, origin, file, tables(r, number_tables(r)));
  });
  if (!why) return;
  if (short_of_memory(rows, [&] { write_csv(r.trace, rows); })) throw RunError(*why);
  const bool beside = !short_of_memory(folder / kBesideCsv, [&] { write_beside(r, origin, folder); });
  throw RunError(*why + (beside ? "" : fmt::format("; nor can {}", kBesideCsv)) + "; the rows are in trace.csv beside it");
}

namespace {

/// Reads a recording of rows only, and lists the missing parts.
void take_rows_alone(StoredRecording& read) {
  const Trace& trace = read.recording.trace;
  if (trace.rows() > 0) read.recording.simulated = trace.at(trace.rows() - 1, 0);
  if (!std::isfinite(read.recording.simulated) || read.recording.simulated < 0) {
    throw unfit(read.file, fmt::format("its last row is at t = {}", read.recording.simulated));
  }
  read.missing.push_back(
      fmt::format("{} contains only rows: peaks, shares of time, energies and the torque error are not known, because they are "
                  "computed from every step",
                  read.file.string()));
  std::vector<std::string> absent;
  for (const std::string& pattern : report_columns()) {
    if (pattern.starts_with("box.") || pattern.ends_with(".measured")) continue;  // exist only for moving boxes and encoders
    const auto covers = [&](const Column& column) { return glob(pattern, column.name); };
    if (std::ranges::none_of(trace.columns, covers)) absent.push_back(pattern);
  }
  if (!absent.empty()) read.missing.push_back(fmt::format("the trace has no column {}", fmt::join(absent, ", ")));
}

}  // namespace

StoredRecording read_recording(const fs::path& folder) {
  StoredTrace stored = read_trace(folder);
  StoredRecording read;
  read.file = stored.file;
  read.recording.trace = std::move(stored.trace);
  const fs::path beside = read.file.parent_path() / kBesideCsv;
  std::error_code none;
  if (read.file.extension() == ".csv" && fs::exists(beside, none)) {
    stored = read_h5(beside);
    if (stored.origin.csv_hash != hash(read.recording.trace)) {
      throw InputError(SourceLocation{read.file.string()}, "is not the file that recording.h5 belongs to, or was changed");
    }
  }
  read.tables = stored.file;
  read.origin = std::move(stored.origin);
  if (!stored.beside.empty()) {
    read.recording.outcome = Outcome::of(read.origin.outcome);
    const bool done = read.recording.outcome.done();
    take_tables(read.tables, stored.beside, read.recording);
    if (done != read.recording.outcome.done()) {
      throw unfit(read.tables, fmt::format("outcome is {}, but {} is {}", read.origin.outcome, kEnded,
                                           name_of(read.recording.outcome.ended)));
    }
  } else {
    take_rows_alone(read);
  }
  return read;
}

}  // namespace gaitlab
