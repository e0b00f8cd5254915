#include "kit/episodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/build_id.h"
#include "core/errors.h"
#include "core/files/hash.h"
#include "core/parallel.h"
#include "core/plugin/plugin_instance.h"
#include "core/scenario/built_robot.h"
#include "core/scenario/resolved.h"
#include "core/scenario/sections.h"
#include "core/scenario/sensor_section.h"
#include "core/simulation/batch.h"
#include "core/simulation/start.h"
#include "kit/bytes.h"

namespace gaitlab::kit {

namespace {

constexpr std::size_t kBase = 3 + 9 + 3 + 3;  // numbers of truth before the energy: position, rotation, velocities

/// Difference of two scenarios that changes the rows of observations or truth, or nullptr.
const char* other_rows(const Scenario& a, const Scenario& b) {
  const RobotInfo one = plugin_info(a);
  const RobotInfo two = plugin_info(b);
  const auto same = [](const auto& x, const auto& y) { return x.name == y.name; };
  if (one.channels != two.channels) return "the sensors";
  if (one.modules.size() != two.modules.size() || !std::ranges::equal(one.joints, two.joints, same) ||
      !std::ranges::equal(one.bodies, two.bodies, same))
    return "the modules of the robot";
  const auto same_leg = [](const Leg& x, const Leg& y) { return x.name == y.name && x.bodies == y.bodies; };
  return std::ranges::equal(one.legs, two.legs, same_leg) ? nullptr : "the legs of the robot";
}

/// Angles, speeds and velocities of a start.
std::vector<double> numbers_of(const Initial& start, std::size_t joints) {
  std::vector<double> all;
  for (const PerJoint* values : {&start.angles, &start.speeds}) {
    for (std::size_t j = 0; j < joints; ++j) all.push_back((*values)[j]);
  }
  for (const Vec3& v : {start.base_velocity, start.base_angular_velocity}) all.insert(all.end(), v.data(), v.data() + 3);
  return all;
}

[[noreturn]] void refuse(const std::string& what) { throw InputError(SourceLocation{"snapshot"}, what); }

}  // namespace

Episodes::Episodes(std::vector<Scenario> scenarios, EpisodeSettings settings)
    : scenarios_(std::move(scenarios)), settings_(std::move(settings)) {
  Problems problems;
  for (Scenario& one : scenarios_) one.physics.estimate = Estimate::off;
  for (std::size_t i = 1; i < scenarios_.size(); ++i) {
    const char* other = keeps_apart(scenarios_[0], scenarios_[i]);
    if (other == nullptr) other = other_rows(scenarios_[0], scenarios_[i]);
    if (other == nullptr) continue;
    problems.add(SourceLocation{fmt::format("overrides[{}]", i)},
                 fmt::format("changes {}, which environments that are stepped together share", other));
  }
  problems.raise();
  const Robot& robot = *scenarios_[0].robot;
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    if (robot.joints[j].driven()) driven_.push_back(j);
  }
  if (driven_.empty() || scenarios_[0].actuator.entry == nullptr)
    throw InputError(scenarios_[0].place("actuator"), "the robot has no motors, so that actions have no effect");
  const std::vector<Leg> legs = plugin_info(scenarios_[0]).legs;
  for (const Leg& leg : legs) leg_bodies_.emplace_back(leg.bodies.begin(), leg.bodies.end());
  name_actions();
  observed_ = observed_columns(scenarios_[0]);
  true_columns_ = columns_of_truth(legs);
  for (const Scenario& one : scenarios_) starts_.push_back(one.initial);
  const std::size_t n = scenarios_.size();
  observations_.resize(n * observed_.size());
  truth_.resize(n * true_columns_.size());
  outcomes_.resize(n);
  ended_.assign(n, 0);
  kept_.resize(n);
  load_.assign(n, std::vector<double>(robot.bodies.size()));
  states_.resize(n);
  for (std::size_t i = 0; i < n; ++i) states_[i] = start_state(scenarios_[i]);
  make_groups();
  for (std::size_t i = 0; i < n; ++i) read(i);
}

void Episodes::name_actions() {
  for (const ActionPart part : settings_.action) {
    if (part != ActionPart::steering) {
      for (const std::size_t j : driven_) action_columns_.push_back(scenarios_[0].robot->joints[j].name);
      continue;
    }
    for (const auto& sensor : make_sensors(scenarios_[0])) {
      if (!sensor->is_steering()) continue;
      for (const SensorReading& reading : sensor->readings()) steering_.push_back(reading.name);
    }
    if (!steering_.empty()) {
      action_columns_.insert(action_columns_.end(), steering_.begin(), steering_.end());
      continue;
    }
    const char* const example = "{remote: {type: steering, values: {turn: {unit: rad/s}}}}";
    throw InputError(scenarios_[0].place("sensors"),
                     fmt::format("action steering needs a sensor of type steering: {}", example));
  }
}

void Episodes::make_groups() {
  const std::size_t n = scenarios_.size();
  const auto threads = static_cast<std::size_t>(std::max(1, settings_.threads));
  const std::size_t lanes =
      lane_width(*scenarios_[0].physics.engine, std::max<std::size_t>(1, (n + threads - 1) / threads), settings_.lanes);
  const std::size_t joints = scenarios_[0].robot->joints.size();
  for (std::size_t from = 0; from < n; from += lanes) {
    std::vector<Scenario> side_by_side;
    for (std::size_t l = 0; l < lanes; ++l) {
      side_by_side.push_back(scenarios_[std::min(from + l, n - 1)]);  // unused lanes repeat the last environment
      if (from + l < n) places_.push_back({groups_.size(), l});
    }
    first_.push_back(from);
    lanes_.push_back(lanes);
    groups_.push_back(std::make_unique<SteppedLanes>(side_by_side));
    const std::size_t widest = std::max(joints, steering_.size());
    const std::size_t row = settings_.action.size() * widest;
    parts_.emplace_back(lanes * row, 0.0);
    std::vector<Action>& views = actions_.emplace_back(lanes);
    for (std::size_t l = 0; l < lanes; ++l) {
      for (std::size_t k = 0; k < settings_.action.size(); ++k) {
        const bool steered = settings_.action[k] == ActionPart::steering;
        const In part = In(parts_.back()).subspan(l * row + k * widest, steered ? steering_.size() : joints);
        switch (settings_.action[k]) {
          case ActionPart::steering:
            views[l].steering = part;
            break;
          case ActionPart::setpoint:
            views[l].setpoint = part;
            break;
          case ActionPart::residual:
            views[l].residual = part;
            break;
          case ActionPart::command:
            views[l].command = part;
            break;
        }
      }
    }
  }
}

std::string Episodes::problem_of(In actions) const {
  constexpr double kLargest = 3.2;   // rad, as check_angle() of robot_info.h
  constexpr double kFarthest = 1e9;  // of any number, as in a scenario
  const std::size_t row = action_columns_.size();
  const std::size_t motors = driven_.size();
  const auto part = [&](ActionPart wanted) { return std::ranges::find(settings_.action, wanted) != settings_.action.end(); };
  for (std::size_t i = 0; i < size(); ++i) {
    const In own = actions.subspan(i * row, row);
    for (std::size_t k = 0; k < row; ++k) {
      if (!(std::abs(own[k]) <= kFarthest))
        return fmt::format("action[{}, {}] is {} ({}); expected at most 1e9", i, k, own[k], action_columns_[k]);
    }
    for (std::size_t d = 0; ended_[i] == 0 && d < motors; ++d) {
      const Joint& joint = scenarios_[i].robot->joints[driven_[d]];
      double angle = 0;
      std::size_t first = 0;
      for (const ActionPart one : settings_.action) {
        if (one == ActionPart::setpoint || one == ActionPart::residual) angle += own[first + d];
        first += one == ActionPart::steering ? steering_.size() : motors;
      }
      if (joint.hi == std::numeric_limits<double>::infinity() || std::abs(angle) <= kLargest) continue;
      return fmt::format(
          "action[{}]: {} of {} is {:.6g} rad; expected -3.2 to 3.2 for a hinge with a range; {:.6g} degrees are "
          "{:.4g} rad",
          i, part(ActionPart::setpoint) ? "the set point" : "the residual", joint.name, angle, angle,
          angle * std::numbers::pi / 180);
    }
  }
  return "";
}

void Episodes::step(In actions) {
  if (settings_.threads > 1 && groups_.size() > 1)
    return parallel(groups_.size(), settings_.threads, [&](std::size_t g) { step_group(g, actions); });
  for (std::size_t g = 0; g < groups_.size(); ++g) step_group(g, actions);
}

void Episodes::step_group(std::size_t g, In actions) {
  SteppedLanes& own = *groups_[g];
  const std::size_t joints = scenarios_[0].robot->joints.size();
  const std::size_t used = std::min(lanes_[g], size() - first_[g]);
  const std::size_t width = action_columns_.size();
  const std::size_t widest = std::max(joints, steering_.size());
  for (std::size_t l = 0; l < lanes_[g]; ++l) {
    const double* from = actions.data() + (first_[g] + std::min(l, used - 1)) * width;
    double* to = parts_[g].data() + l * settings_.action.size() * widest;
    for (const ActionPart part : settings_.action) {
      if (part == ActionPart::steering) {
        from = std::ranges::copy_n(from, static_cast<std::ptrdiff_t>(steering_.size()), to).in;
      } else {
        for (const std::size_t j : driven_) to[j] = *from++;
      }
      to += widest;
    }
  }
  for (std::int64_t tick = 0; tick < settings_.every; ++tick) {
    bool any = false;
    for (std::size_t l = 0; l < used; ++l) any = any || !own.ended(l);
    if (!any) break;
    own.tick(actions_[g]);
    for (std::size_t l = 0; l < used; ++l) {
      const std::size_t i = first_[g] + l;
      if (ended_[i] != 0) continue;
      const std::vector<double>& asked = own.asked(l);
      outcomes_[i] = own.outcome(l);
      const bool given = outcomes_[i].ended != Ended::plugin;  // a plugin that threw gave no set points
      if (settings_.record && given) {
        const In sent = actions_[g][l].steering;
        kept_[i].set_points.insert(kept_[i].set_points.end(), asked.begin(), asked.end());
        kept_[i].steering.insert(kept_[i].steering.end(), sent.begin(), sent.end());
      }
      ended_[i] = own.ended(l) ? 1 : 0;
      // A failed lane is at its start again; its last rows are from the tick before.
      if (outcomes_[i].done()) read(i);
    }
  }
}

/// Fills the rows of an environment.
void Episodes::read(std::size_t i) {
  const SteppedLanes& from = group(i);
  const std::size_t lane = places_[i].lane;
  const Measured m = from.measured(lane);
  auto to = observations_.begin() + static_cast<std::ptrdiff_t>(i * observed_.size());
  for (const In part : {m.angle, m.speed, m.torque, m.load, m.touching, m.channels}) to = std::ranges::copy(part, to).out;
  double* row = truth_.data() + i * true_columns_.size();
  RobotState& state = states_[i];
  from.read(lane, state);
  const Mat3 R = state.orientation.toRotationMatrix();
  std::copy_n(state.position.data(), 3, row);
  for (Eigen::Index k = 0; k < 9; ++k) row[3 + k] = R(k / 3, k % 3);
  std::copy_n(state.velocity.data(), 3, row + 12);
  std::copy_n(state.angular_velocity.data(), 3, row + 15);
  row[kBase] = from.energy(lane);
  row[kBase + 1] = from.time(lane);
  from.loads(lane, load_[i]);
  for (std::size_t k = 0; k < leg_bodies_.size(); ++k) {
    double sum = 0;
    for (const std::size_t body : leg_bodies_[k]) sum += load_[i][body];
    row[kBase + 2 + k] = sum;
  }
}

void Episodes::stop(std::size_t i, const std::string& reason) {
  if (ended_[i] != 0) return;
  outcomes_[i] = {Ended::stopped, fmt::format("{} at t = {:.6g} s", reason, group(i).time(places_[i].lane))};
  group(i).stop(places_[i].lane, outcomes_[i].message);
  ended_[i] = 1;
}

void Episodes::restart(std::span<const std::size_t> which, std::span<const Initial> starts) {
  for (std::size_t k = 0; k < which.size(); ++k) {
    const std::size_t i = which[k];
    starts_[i] = starts.empty() ? scenarios_[i].initial : starts[k];
    if (starts.empty()) {
      group(i).restart(places_[i].lane);
    } else {
      Scenario other = scenarios_[i];
      other.initial = starts[k];
      group(i).restart(places_[i].lane, start_state(other));
    }
    outcomes_[i] = {};
    ended_[i] = 0;
    kept_[i] = {};
    read(i);
  }
}

bool Episodes::running() const { return std::ranges::find(ended_, char{0}) != ended_.end(); }

std::string Episodes::ended(std::size_t i) const { return ended_[i] == 0 ? "" : name_of(outcomes_[i].ended); }

/// First line of a snapshot, equal for environments that it fits.
std::string Episodes::head() const {
  std::uint64_t state = kFnvOffset;
  for (const Scenario& one : scenarios_) state = fnv1a(resolved(one), state);
  for (const ActionPart part : settings_.action) state = fnv1a(name_of(part), state);
  return fmt::format("gaitlab snapshot, build {}, {} environments of {}, {:016x}\n", build_id(), size(), scenarios_[0].name,
                     fnv1a(fmt::format("{} {}", settings_.every, settings_.record), state));
}

std::string Episodes::snapshot() const {
  std::string body;
  const std::size_t joints = scenarios_[0].robot->joints.size();
  for (std::size_t i = 0; i < size(); ++i) {
    const SteppedLanes& from = group(i);
    std::vector<double> numbers(from.size(places_[i].lane));
    from.save(places_[i].lane, numbers);
    put(body, numbers);
    put(body, kept_[i].set_points);
    put(body, kept_[i].steering);
    put(body, numbers_of(starts_[i], joints));
    put(body, std::vector<double>{ended_[i] != 0 ? 1.0 : 0.0, static_cast<double>(outcomes_[i].ended)});
    put(body, outcomes_[i].message);
  }
  put(body, observations_);
  put(body, truth_);
  return head() + hash_words(body) + "\n" + body;
}

void Episodes::restore(const std::string& bytes) try {
  const std::string own = head();
  const std::size_t line = bytes.find('\n');
  if (line == std::string::npos || !bytes.starts_with("gaitlab snapshot, ")) refuse("expected the bytes of snapshot()");
  if (bytes.compare(0, line + 1, own) != 0) {
    refuse(fmt::format("is of other environments or of another build: {}; these are {}", bytes.substr(0, line),
                       own.substr(0, own.size() - 1)));
  }
  constexpr std::size_t kHash = 16;
  const std::string_view rest = std::string_view(bytes).substr(line + 1);
  if (rest.size() <= kHash || hash_words(rest.substr(kHash + 1)) != rest.substr(0, kHash)) refuse("is damaged");
  Bytes body(rest.substr(kHash + 1));
  const std::size_t joints = scenarios_[0].robot->joints.size();
  struct One {
    std::vector<double> lane;
    Kept kept;
    Initial start;
    bool ended = false;
    Outcome outcome;
  };
  std::vector<One> all(size());
  for (std::size_t i = 0; i < size(); ++i) {
    One& one = all[i];
    one.lane = body.numbers(group(i).size(places_[i].lane));
    if (!group(i).fits(places_[i].lane, one.lane)) throw BadBytes("do not fit");
    one.kept = {body.rows(joints), body.rows(std::max<std::size_t>(1, steering_.size()))};
    const std::vector<double> start = body.numbers(2 * joints + 6);
    const auto speeds = start.begin() + static_cast<std::ptrdiff_t>(joints);
    const auto base = speeds + static_cast<std::ptrdiff_t>(joints);
    one.start.angles.each.assign(start.begin(), speeds);
    one.start.speeds.each.assign(speeds, base);
    one.start.base_velocity = Vec3(&*base);
    one.start.base_angular_velocity = Vec3(&*base + 3);
    const std::vector<double> end = body.numbers(2);
    one.ended = end[0] != 0;
    for (const Ended how : {Ended::diverged, Ended::plugin, Ended::stopped}) {
      if (end[1] == static_cast<double>(how)) one.outcome.ended = how;
    }
    one.outcome.message = body.text();
  }
  std::vector<double> observations = body.numbers(observations_.size());
  std::vector<double> truth = body.numbers(truth_.size());
  for (std::size_t i = 0; i < size(); ++i) {
    group(i).load(places_[i].lane, all[i].lane);
    group(i).read(places_[i].lane, states_[i]);
    kept_[i] = std::move(all[i].kept);
    starts_[i] = std::move(all[i].start);
    ended_[i] = all[i].ended ? 1 : 0;
    outcomes_[i] = std::move(all[i].outcome);
  }
  std::ranges::copy(observations, observations_.begin());
  std::ranges::copy(truth, truth_.begin());
} catch (const BadBytes& error) {
  refuse(std::string("its numbers ") + error.what());
}

}  // namespace gaitlab::kit
