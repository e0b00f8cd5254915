// Table of all checks. Tests evaluate each check below, at and beyond its limits, with its margin, its span, and cases in which
// it is not judged.
#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <tuple>

#include "tests/labels.h"
#include "tests/report/verdict/checks/check_changes.h"

namespace gaitlab::test {
namespace {

const Label kLongCheckTable("CheckTable.BelowAtAndBeyondEachLimit", "long");

/// A check, and the change of a recorded walk that gives the check a value. The limits are numbers, not settings, so that the
/// test detects a changed default.
struct Expected {
  std::string id;
  std::function<Change(double)> change;      ///< change that gives the check a value
  double limit;                              ///< value beyond which the check fails, or warns if it cannot fail
  double warns;                              ///< value beyond which the check warns
  std::function<Change(double)> early = {};  ///< change before the judged window; absent if `change` has no time
  [[nodiscard]] bool least() const { return id == "fall" || id == "progress"; }
  /// Value that exceeds the limit by `share` of the limit.
  [[nodiscard]] double beyond(double share) const { return limit == 0 ? share : limit * (1 + (least() ? -share : share)); }
};

Expected of_tick(const char* id, TickColumn column, double limit, double warns) {
  return {id, [=](double v) { return tick(column, v); }, limit, warns, [=](double v) { return tick(column, v, kEarly); }};
}

Expected of_joint(const char* id, double JointStatistics::*member, double limit, double warns) {
  return {id, [=](double v) { return joint(member, v); }, limit, warns};
}

Expected of_square(const char* id, TickColumn column, double limit) {
  return {id, [=](double v) { return rate(column, v * v); }, limit, 0.8 * limit,
          [=](double v) { return early_rate(column, v * v); }};
}

Expected of_dock(const char* id, const char* column, double limit) {
  return {id, [=](double v) { return load(column, v); }, limit, 0.8 * limit, [=](double v) { return load(column, v, kEarly); }};
}

/// A supply of 8 V, at least 0.5 V and at most 5 A, whose bus has a constant current and falls to `voltage` at a row, by
/// default the last.
Change on_bus(double voltage, double current, std::optional<std::size_t> row = {}) {
  return [=](Case& made) {
    made.scenario.supply = {.voltage = 8, .current = 5, .least = 0.5};
    Trace& bus = made.record.supply;
    bus.columns = supply_columns();
    bus.values.clear();
    const Trace& ticks = made.record.ticks;
    for (std::size_t k = 0; k < ticks.rows(); ++k) {
      const double t = ticks.at(k, 0);
      const double volts = k == row.value_or(ticks.rows() - 1) ? voltage : 8;
      for (const double value : {t, volts, current, 1.0, current * t, current * current * t}) bus.values.push_back(value);
    }
  };
}

/// Torque at rest of a motor that may hold more than its stall torque.
Change at_rest(double torque, bool early = false) {
  return [=](Case& made) {
    static const Scenario kFree = shipped(
        "caterpillar.yaml", {"physics.engine=articulated", "actuator.i_max=10", "actuator.efficiency_model=directional"});
    made.scenario.actuator = kFree.actuator;
    for (std::size_t k = 0; k <= made.last_tick(); ++k) made.tick(k, kChanged, kSpeedPeak) = 0;
    (early ? early_rate(kTorqueSquare, torque * torque) : rate(kTorqueSquare, torque * torque))(made);
  };
}

/// Rows for a check of saturation: a share of the window in so many pieces that each is short, and one long interval at the
/// end.
std::vector<Expected> of_saturation(const char* id, TickColumn column) {
  const auto pieces = [](const Change& change) {
    return [change](Case& made) {
      made.scenario.limits.saturated_periods = 1e6;
      change(made);
    };
  };
  const auto stretch = [column](double v) {
    return [=](Case& made) {
      made.scenario.limits.saturated_share = 1;
      grow(made, column, 1, 12 - v, 12);
    };
  };
  return {
      {id, [=](double v) { return pieces(rate(column, v)); }, 0.01, 0, [=](double v) { return pieces(early_rate(column, v)); }},
      {id, stretch, 3 * 0.015, 0}};
}

/// A log whose angles span 2 rad, with a mean error of `share` of that, in which the motor is never at its limit; the simulated
/// motor is for `limit` of the time.
Change off_log(double share, double limit) {
  return [=](Case& made) {
    made.scenario.measured.log = std::make_shared<const MeasuredLog>();
    made.also = [=](Summary& summary, Overlaps&) {
      JointLogErrors joint{kChanged, {}, limit, 0};
      joint.errors[static_cast<std::size_t>(Logged::angle)] = LogError{2 * share, 2 * share, 2 * share, 0, 2};
      summary.log = LogErrors{100, 10, 10, {joint}};
    };
  };
}

/// Motors that were fitted to logs with speeds up to 2 rad/s; the joint turns at `share` of that.
Change of_logs(double share, bool early = false) {
  return [=](Case& made) {
    made.scenario.identified = {.logs = 8, .speed = 2};
    for (std::size_t j = 0; j < made.scenario.robot->joints.size(); ++j) {
      for (std::size_t k = 0; k <= made.last_tick(); ++k) made.tick(k, j, kSpeedPeak) = 0;
    }
    made.tick(early ? kEarly : made.last_tick(), kChanged, kSpeedPeak) = 2 * share;
  };
}

std::vector<Expected> table() {
  const double no_load = 7.4 / (0.00395 * 594);          // speed without load u_max / (Ks n), rad/s
  const double stall = 0.7 * 0.00395 * 594 * 7.4 / 4.3;  // eta Kt n u_max / R, N m
  std::vector<Expected> rows{
      {"fall", sinks, 0.5, 0.5, sinks},
      {"progress", [](double v) { return goes(v); }, 0.5, 0.5},
      {"upright", tilts, std::numbers::pi / 2, std::numbers::pi / 3, tilts},
      of_tick("envelope", kEnvelopePeak, 0.8, 0.8),
      of_tick("speed", kSpeedPeak, no_load, 0.8 * no_load),
      {"stall", [](double v) { return at_rest(v); }, stall, stall / 2, [](double v) { return at_rest(v, true); }},
      of_square("heat", kCurrentSquare, 1),
      of_tick("gear_peak", kTorquePeak, 5, 4),
      of_square("gear_continuous", kTorqueSquare, 3),
      {"brownout", [](double v) { return on_bus(8 - v, 0); }, 7.5, 7.5, [](double v) { return on_bus(8 - v, 0, kEarly); }},
      {"battery", [](double v) { return on_bus(8, v); }, 5, 4},
      of_tick("tracking", kErrorPeak, 0.2, 0.1),
      of_joint("stops", &JointStatistics::range_worst, 0.01, 0),
      {"stops",
       [](double v) {
         return [v](Case& made) {
           joint(&JointStatistics::range_worst, v > 0 ? 1e-4 : 0)(made);
           joint(&JointStatistics::range_share, v)(made);
         };
       },
       0.01, 0},
      {"stops", rests_on_stop, 0.05, 0.05},
      of_joint("setpoints", &JointStatistics::setpoint_outside, 0, 0),
      of_joint("start", &JointStatistics::start_jump, 0.05, 0.05),
      {"collision",
       [](double v) {
         return with_overlaps([v](Overlaps& there) { there.collision = {.depth = v, .deepest_second = 5, .pairs = 1}; });
       },
       0.002, 5e-4},
      of_dock("dock_tension", "dock.3.tension", 1000),
      of_dock("dock_shear", "dock.3.shear", 800),
      of_dock("dock_bending", "dock.3.bending", 400),
      of_dock("dock_torsion", "dock.3.torsion", 200),
      {"slip", [](double v) { return slides(v); }, 0.2, 0.2, [](double v) { return slides(v, true); }},
      {"creep", [](double v) { return creeps(v); }, 0.02, 0.02, [](double v) { return creeps(v, true); }},
      {"torque_error", [](double v) { return off(std::max(v, 1e-12)); }, 0.05, 0.01},  // an error of 0 means not estimated
      {"ledger",
       [](double v) {
         return [v](Case& made) {
           made.record.ledger.copper += made.record.ledger.residual() - v * made.record.ledger.electrical;
         };
       },
       0.01, 0.01},
      {"created",
       [](double v) {
         return [v](Case& made) {
           for (JointStatistics& one : made.record.joints) one.created = 0;
           made.record.joints[kChanged].created = v * made.record.ledger.electrical;
         };
       },
       0.05, 0.05},
      {"step",
       [](double v) {
         return [v](Case& made) {
           made.record.control_ticks = 100'000'000;
           made.record.control_ticks_above_1 = std::llround(v * 1e8);
         };
       },
       0.01, 0.01},
      {"coarse", [](double v) { return [v](Case& made) { made.record.tally.coarse = v * made.record.simulated; }; }, 0.1, 0.1},
      {"law", [](double v) { return [v](Case& made) { made.record.tally.off = v; }; }, 0, 0},
      {"measured", [](double v) { return off_log(v, 0); }, 0.2, 0.2},
      {"identified", [](double v) { return of_logs(v); }, 1, 1, [](double v) { return of_logs(v, true); }},
  };
  for (const auto& [id, column] : {std::pair{"voltage", kVoltageLimited}, {"current", kCurrentLimited}}) {
    for (Expected& row : of_saturation(id, column)) rows.push_back(std::move(row));
  }
  return rows;
}

TEST(CheckTable, BelowAtAndBeyondEachLimit) {
  for (const Expected& row : table()) {
    SCOPED_TRACE(row.id);
    const auto at = [&](double value) { return changed(row.id, row.change(value)); };
    const Check beyond = at(row.beyond(1e-4));
    EXPECT_EQ(beyond.status, beyond.can_fail ? CheckStatus::fail : CheckStatus::warn) << beyond.text;
    EXPECT_LT(beyond.margin, 0) << beyond.text;
    const Check none = at(row.least() ? 1 : 0);
    EXPECT_EQ(none.status, CheckStatus::pass) << none.text;
    if (row.limit == 0) continue;
    EXPECT_NEAR(at(row.beyond(0.5)).margin, -0.5, 2e-6) << at(row.beyond(0.5)).text;
    const CheckStatus allowed = row.warns == row.limit ? CheckStatus::pass : CheckStatus::warn;
    // The value of a check may be a quotient of sums over a thousand rows. Checks of intervals therefore have a tolerance of
    // 1e-6.
    for (const double share : {-1e-4, -1e-10}) EXPECT_EQ(at(row.beyond(share)).status, allowed) << at(row.beyond(share)).text;
    const Check below = at(row.beyond(-1e-4));
    EXPECT_GT(below.margin, 0) << below.text;
    if (row.warns == 0 || row.warns == row.limit) continue;
    EXPECT_EQ(at(row.warns * (1 - 1e-4)).status, CheckStatus::pass) << at(row.warns * (1 - 1e-4)).text;
    EXPECT_EQ(at(row.warns * (1 + 1e-4)).status, CheckStatus::warn) << at(row.warns * (1 + 1e-4)).text;
  }
}

/// A check names the part with the least margin and the number of parts beyond the limit.
TEST(CheckTable, CountsThePartsBeyondTheirLimits) {
  for (const auto& [id, column, warns] : {std::tuple{"tracking", kErrorPeak, 0.1},
                                          {"envelope", kEnvelopePeak, 0.8},
                                          {"gear_peak", kTorquePeak, 5.0},
                                          {"speed", kSpeedPeak, 3.154}}) {
    Case made = rated_gait();
    made.tick(made.last_tick(), 2, column) = 1.01 * warns;
    made.tick(made.last_tick(), kChanged, column) = 1.02 * warns;
    const Check check = made.check(id);
    EXPECT_EQ(check.parts, 2U) << id;
    EXPECT_EQ(check.part, Part::joint) << id;
    EXPECT_EQ(check.worst, made.scenario.robot->joints[kChanged].name) << id;
    EXPECT_EQ(check.to, made.time(made.last_tick())) << id;
    EXPECT_EQ(check.from, made.time(made.last_tick() - 1)) << id;
  }
}

/// A value beyond the limit before the judged window fails a check of the whole run, and does not affect a check of the window.
TEST(CheckTable, SpansAreJudged) {
  for (const Expected& row : table()) {
    if (!row.early) continue;
    const auto kind = std::ranges::find_if(check_kinds(), [&](const CheckKind& one) { return row.id == one.id; });
    const CheckStatus whole = kind->can_fail() ? CheckStatus::fail : CheckStatus::warn;
    const Check check = changed(row.id, row.early(row.beyond(0.5)));
    EXPECT_EQ(check.status, kind->span == CheckSpan::window ? CheckStatus::pass : whole) << row.id << ": " << check.text;
  }
}

/// In a run that is too short, a failed check of the whole run makes the gait infeasible, but not a failed check of the window,
/// which a longer run may pass.
TEST(CheckTable, SpansDecideOfARunThatIsTooShort) {
  for (const Expected& row : table()) {
    Case made = rated_gait();
    row.change(row.beyond(0.5))(made);
    const auto before = made.also;
    made.also = [before](Summary& summary, Overlaps& there) {
      if (before) before(summary, there);
      summary.limit_cycle.found = false;
      summary.gait.period = 5;
    };
    const Check check = made.check(row.id);
    if (check.status != CheckStatus::fail) continue;
    EXPECT_EQ(made.judged().word, check.span == CheckSpan::whole_run ? Word::infeasible : Word::not_judged) << row.id;
  }
}

TEST(CheckTable, MeasuredAlsoComparesTheTimeAtTheLimit) {
  EXPECT_EQ(changed("measured", off_log(0.1, 0.0999)).status, CheckStatus::pass);
  EXPECT_EQ(changed("measured", off_log(0.1, 0.1001)).status, CheckStatus::warn);
}

/// Checks have the documented spans. The span of `speed` depends on the limit that decides.
TEST(CheckTable, HasItsSpans) {
  const std::set<std::string> window{"progress", "voltage",         "current",  "envelope", "speed",     "stall",
                                     "heat",     "gear_continuous", "tracking", "slip",     "airborne",  "stability",
                                     "periodic", "evidence",        "creep",    "battery",  "identified"};
  for (const CheckKind& kind : check_kinds())
    EXPECT_EQ(kind.span, window.contains(kind.id) ? CheckSpan::window : CheckSpan::whole_run) << kind.id;
}

/// A check whose value is unknown is not judged.
TEST(CheckTable, NotJudged) {
  const auto no_ticks = [](Case& made) { made.record.ticks = {}; };
  const auto fixed = [](Case& made) { made.scenario.base = Base::fixed; };
  const auto no_statistics = [](Case& made) {
    made.record.joints.clear();
    made.record.trace = made.record.rest = {};
  };
  const auto no_loads = [](Case& made) { made.record.loads = {}; };
  const auto no_motors = [](Case& made) { made.scenario.actuator.entry = nullptr; };
  const auto no_ground = [](Case& made) { made.scenario.ground.shape = NoGround{}; };
  const std::vector<std::pair<std::vector<const char*>, Change>> ways{
      {{"fall", "progress", "upright", "slip", "stability", "airborne"}, fixed},
      {{"voltage", "current", "envelope", "speed", "stall", "heat", "gear_peak", "gear_continuous", "tracking"}, no_ticks},
      {{"stops", "setpoints", "start", "ledger", "created", "supply"}, no_statistics},
      {{"dock_tension", "dock_shear", "dock_bending", "dock_torsion", "slip", "stability"}, no_loads},
      {{"law", "voltage", "setpoints", "start", "ledger", "created", "supply"}, no_motors},
      {{"fall", "progress", "in_ground", "slip"}, no_ground},
      {{"collision", "in_ground"}, with_overlaps([](Overlaps& there) { there.shaped = 0; })},
      {{"field", "torque_error"}, [](Case&) {}},
      {{"step"}, [](Case& made) { made.record.control_ticks = 0; }},
      {{"coarse"}, [](Case& made) { made.record.simulated = 0; }},
  };
  for (const auto& [ids, change] : ways) {
    for (const char* const id : ids) {
      const Check check = changed(id, change);
      EXPECT_EQ(check.status, CheckStatus::not_judged) << id;
      EXPECT_TRUE(std::isnan(check.margin)) << id;
      EXPECT_FALSE(check.text.empty()) << id;
    }
  }
}

}  // namespace
}  // namespace gaitlab::test
