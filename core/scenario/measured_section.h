// The section `measured` of a scenario: a log of the real robot, with which a run is compared.
#pragma once
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/plugin/fields.h"
#include "core/settings/node.h"

namespace gaitlab {

struct Scenario;

inline constexpr const char* kMeasuredSection = "measured";

/// Quantity of a joint in a log. A duty is the share of its supply that the servo gives to its motor.
enum class Logged : std::size_t { angle, speed, voltage, current, torque, duty };
inline constexpr std::size_t kLoggedKinds = 6;

/// The names of a quantity: its key, and the column joint.N.COLUMN of a trace from which its simulated value follows.
struct LoggedKind {
  Logged kind;
  const char *key, *column, *unit, *about;
};
std::span<const LoggedKind, kLoggedKinds> logged_kinds();

/// The numbers measured.QUANTITY.NUMBER of the difference between run and log, and the numbers measured.NUMBER of both.
inline constexpr std::array kErrorNumbers{"mae", "rms", "peak"};
inline constexpr std::array kLimitNumbers{"limit.simulated", "limit.logged"};

/// Bounds of these numbers, which `gaitlab test` judges.
struct MeasuredBounds {
  struct Number {
    std::string key;  ///< such as angle.mae
    const char* unit;
    Logged of;  ///< quantity that the log must have
  };
  static const std::vector<Number>& numbers();
  std::vector<double> most = std::vector<double>(numbers().size(), kNotStated);  ///< by number
  bool brief = false;                                                            ///< as LoggedJoint::brief
  [[nodiscard]] bool stated(std::size_t number) const { return most[number] != kNotStated; }
  [[nodiscard]] bool any() const;
  void fields(Fields& f);
};

/// Columns of a log for one joint.
struct LoggedJoint {
  std::string name;                             ///< name of the joint
  std::array<LogColumn, kLoggedKinds> columns;  ///< without a name for a quantity that was not measured
  bool brief = false;                           ///< true to visit only the keys that are stated; for writing
  void fields(Fields& f);
};

/// The numbers of a log in SI units. Times rise from 0.
struct MeasuredLog {
  struct OfJoint {
    std::size_t joint = 0;
    std::array<std::vector<double>, kLoggedKinds> values;  ///< by row; empty for a quantity that was not measured
    [[nodiscard]] const std::vector<double>& of(Logged kind) const { return values[static_cast<std::size_t>(kind)]; }
  };
  std::vector<double> t, on;  ///< s; MeasuredSettings::on by row, or empty
  std::vector<OfJoint> joints;
  /// Value at a time, on the line between two rows; NaN after the last row.
  [[nodiscard]] double at(const std::vector<double>& values, double time) const;
};

struct MeasuredSettings {
  std::string file;        ///< text of the log (CsvTable)
  std::string time = "t";  ///< name of the column of times, s
  std::string on;          ///< name of the column that is 0 while the motors have no torque; "" for none
  std::string source;      ///< origin and licence of the log; "" if not stated
  std::string path;        ///< name of the file, if it is not given as text
  MeasuredBounds bound;
  bool brief = false;  ///< as LoggedJoint::brief
  std::vector<LoggedJoint> columns;
  std::shared_ptr<const MeasuredLog> log;  ///< null without the section
  [[nodiscard]] bool any() const { return log != nullptr; }
  /// True if the trace column is compared with the log.
  [[nodiscard]] bool reads(const std::string& column) const;
  void fields(Fields& f);
};

/// Reads the numbers of the log after the section `node` has been read into scenario.measured. Adds a problem for a joint that
/// does not exist or has no motor, and for a column or a row that cannot be used.
void finish_measured(const Node& node, Scenario& scenario, Problems& problems);

/// Turns the column scenario.measured.on into changes: adds to the section `at` of the scenario `root` a fault `open` where the
/// column becomes 0, and its end where it no longer is, each in the middle between two rows. The resolved scenario contains
/// these faults instead of the name of the column.
void insert_torque_off(Node& root, Scenario& scenario);

}  // namespace gaitlab
