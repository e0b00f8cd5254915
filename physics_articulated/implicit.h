// Implicit step for a scalar type T (double or lanes), after which every motor, stop and contact satisfies its law.
#pragma once
#include "physics_articulated/contacts.h"
#include "physics_articulated/iterate.h"
#include "physics_articulated/line_search.h"
#include "physics_articulated/motors.h"
#include "physics_articulated/plays.h"
#include "physics_articulated/sticking.h"
#include "physics_articulated/stops.h"

namespace gaitlab::articulated {

/// Integrates one step. The state has the entries of StateLayout, SI. Only the constructor allocates. The step from (q, v) to
/// (q+, v+) solves
///     M (v+ - v) = h (weight - c + tau(v+) + sum J^T f(v+))        q+ = q (+) h v+
/// with M, c, J and the set of elements near the ground at q (+) h v. If the forces of motors, stops and contacts fall with
/// their speed, v+ minimises the strictly convex function
///     phi(v+) = (v+ - v_free)^T M (v+ - v_free) / 2 + h sum of the potentials of the laws
/// and therefore exists and is unique for any h. Newton's method replaces every law by its tangent at the iterate, and the
/// recursion solves the resulting linear system (Body). If phi is rising at the end of the Newton step, the step is shortened
/// to the part along which phi falls (line search, decision 17).
///
/// Dry friction of a driven joint is a kink of phi at rest. Such a joint has a mode (StepMotors), and phi is that of the modes:
/// the law of a side goes on beyond rest, and a joint that sticks ends the step at rest, under the torque that this needs.
/// A mode that contradicts the iterate changes, and the step is solved again: a joint that turns against its side sticks, and
/// one that sticks under more than its friction turns. The modes at the start depend on the speeds alone, without
/// memory. Motors of gears with play have speeds of their own, further coordinates of phi (Plays).
template <class T>
class Implicit {
 public:
  static constexpr int kSolves = 100;  ///< largest number of solves in one step; most steps need 1
  static constexpr double kTorqueTolerance = Sticking<T>::kTolerance;  ///< least share of the largest torque of a motor at rest
  static constexpr double kShareOfAccuracy = 1e-3;                     ///< share of the relative accuracy of the torques
  static constexpr double kStopTolerance = 1e-9;                       ///< N m
  static constexpr double kRounding = 1e-11;  ///< relative rounding error of the torque of a passive hinge, due to q

  Implicit(const Tree<T>& tree, const Environment<T>& environment, const Actuator* actuator,
           const LaneRange& lanes = {0, math::kLanes<T>})
      : body(tree, environment.gravity, environment.dynamics),
        contacts(tree, environment),
        motors(actuator, tree.lo.size(), tree.passive, tree.hinges, lanes),
        stops(tree),
        rotor(reflected_inertia<T>(tree.lo.size(), actuator, lanes)),
        plays(tree, rotor),
        done(tree.lo.size()),
        tree_(tree),
        joints_(tree.lo.size()),
        place_(StateLayout::kAngles + 2 * (joints_ + plays.size()), T(0.0)),
        sticking_(motors, joints_),
        rests_(joints_),
        now_(joints_, plays.size()),
        next_(joints_, plays.size()) {
    passive_.assign(tree.passive.size(), T(0.0));
    for (auto* values : {&stop_, &stop_slope_, &force_, &diagonal_, &end_}) values->assign(joints_, T(0.0));
    if (plays.any()) motor_end_.assign(joints_, T(0.0));
  }

  /// Advances the lanes `which` of x by a step and fills done, solves and off. `command` is constant, with index joint * lanes
  /// + lane.
  void step(std::span<T> x, In command, double h, const math::Mask<T>& which) {
    std::copy(x.begin(), x.end(), place_.begin());
    drift<T>(place_, joints_, h);
    body.forward_kinematics(place_);
    contacts.find(body, h, h);
    start(x, command, h);
    solves = T(0.0);
    off = T(0.0);
    unfinished = {};
    math::Mask<T> open = which;  // lanes in which a law is not satisfied
    for (int solve = 0; math::any_lane(open); ++solve) {
      if (solve == kSolves) {
        unfinished = open;
        off = math::select(open, missed_, T(0.0));
        break;
      }
      solves = solves + math::select(open, T(1.0), T(0.0));
      this->solve(x, h);
      if (solve == 0) {
        move(open);
      } else {
        move(open, falling_share<T>(open, [&](const T& share) { return climb(x, command, h, share); }));
      }
      open = math::mask_and(open, misses(x, command, h));
      if (!math::any_lane(open)) break;
      if (motors.any_jump && sticking_.change(open, now_.torque, motor_ends(), solve >= Sticking<T>::kTogether, switched))
        motors.linearise(command, motor_ends());
      touch(open, x, h);
    }
    finish(x, h, which);
  }

  /// Takes changed motors and stuck hinges: Plant::change_joints for these lanes.
  void change(In hold, In since, const LaneRange& lanes) {
    motors.take(tree_.passive, lanes);
    stops.holds.change(hold, since, lanes);
  }

  /// Takes the results of a solo's step in the lane `l`; `which` contains only this lane.
  void take(const Solo& solo, std::size_t l, const math::Mask<T>& which) {
    done.take(solo, l);
    for (std::size_t j = 0; j < joints_; ++j) {
      math::lane(now_.torque[j], l) = solo.torque[j];
      math::lane(motors.slope[j], l) = solo.slope[j];
    }
    solves = T(solo.solves);
    off = T(solo.off);
    unfinished = solo.unfinished ? which : math::Mask<T>{};
    if (solo.switches) switched = math::mask_or(switched, which);
  }

  /// Evaluates the laws at x and the resulting accelerations. Joints at rest stick as far as their friction can hold them.
  void evaluate(std::span<const T> x, In command) {
    body.forward_kinematics(x);
    contacts.find(body, 0, 0);
    contacts.begin(0);
    motors.begin(command, plays.motor_speeds(x));
    motors.linearise(command, plays.motor_speeds(x));
    motors.torque = motors.law;
    plays.evaluate(x);
    for (std::size_t j = 0; j < joints_; ++j) stop_[j] = stops.at(x, j, speeds(x)[j]);
    for (std::size_t k = 0; k < tree_.passive.size(); ++k) {
      const std::size_t j = tree_.passive[k];
      passive_[k] = stops.hinges[k].spring(x[StateLayout::kAngles + j]) + stops.hinges[k].loss(speeds(x)[j]).torque;
      stop_[j] = stop_[j] + passive_[k];
    }
    if (!motors.any_jump) return accelerate(0);
    std::ranges::fill(sticking_.locks.acceleration, T(0.0));
    for (bool again = true; again;) {  // at most once per joint, because a joint that leaves does not return
      accelerate(0);
      again = false;
      for (std::size_t j = 0; j < joints_; ++j) again = sticking_.release(j) || again;
    }
  }
  /// Adds friction at the state x to the motor torques `torque` (index joint * lanes + lane). A joint at rest has the torque
  /// that holds it, or the bound of its torques at rest where this cannot hold it.
  void add_friction(std::span<const T> x, In command, Out torque) {
    if (!motors.rubs()) return;
    for (std::size_t j = 0; j < joints_; ++j) {
      const T friction = motors.friction(j, x[plays.entry(j)]);
      for (std::size_t l = 0; l < math::kLanes<T>; ++l) torque[j * math::kLanes<T> + l] += math::lane(friction, l);
    }
    motors.begin(command, plays.motor_speeds(x));
    rests_ = motors.sticks;
    if (std::ranges::none_of(rests_, [](const auto& sticks) { return math::any_lane(sticks); })) return;
    evaluate(x, command);
    for (std::size_t j = 0; j < joints_; ++j) {
      const T held = math::select(motors.sticks[j], sticking_.locks.torque[j], motors.law[j]);
      for (std::size_t l = 0; l < math::kLanes<T>; ++l) {
        if (math::lane(math::select(rests_[j], T(1.0), T(0.0)), l) > 0) torque[j * math::kLanes<T> + l] = math::lane(held, l);
      }
    }
  }
  [[nodiscard]] std::span<const T> accelerations() const { return next_.a; }  ///< result of evaluate()
  /// Power that the robot gives to the ground along its normal, to the ground along its surface, to stops, and to dampers and
  /// friction of passive hinges, W. Called after evaluate().
  std::array<T, 4> powers(std::span<const T> x) const {
    std::array<T, 4> sum{T(0.0), T(0.0), plays.power(x), T(0.0)};
    for (const Contact<T>& c : contacts.touching()) {
      sum[0] = sum[0] - c.fn * c.vn;
      sum[1] = sum[1] - dot(c.friction(c.vt), c.vt);
    }
    for (std::size_t j = 0; j < joints_; ++j) sum[2] = sum[2] - stop_[j] * speeds(x)[j];
    for (std::size_t k = 0; k < tree_.passive.size(); ++k) {
      const T& w = speeds(x)[tree_.passive[k]];
      sum[2] = sum[2] + passive_[k] * w;
      sum[3] = sum[3] - stops.hinges[k].loss(w).torque * w;
    }
    return sum;
  }

  /// Computes next_.a from motors, stops and contacts with their tangents for a step h. Joints that stick have the
  /// given accelerations instead of a motor torque.
  void accelerate(double h) {
    for (std::size_t j = 0; j < joints_; ++j) {
      force_[j] = motors.torque[j] + stop_[j];
      diagonal_[j] = rotor[j] + (h > 0 ? T(h) * (motors.slope[j] + stop_slope_[j]) : T(0.0));
    }
    if (motors.any_jump) sticking_.lock(stop_, stop_slope_, rotor, h, force_, diagonal_);
    plays.reduce(motors, stop_, stop_slope_, h, sticking_.locks, force_, diagonal_);
    body.solve(
        force_, diagonal_, next_.a, [&](std::size_t link, typename TreeBody<T>::Load load) { contacts.load(link, load, h); },
        motors.any_jump ? &sticking_.locks : nullptr);
    plays.recover(motors, h, sticking_.locks, next_.a);
  }

  [[nodiscard]] std::span<T> speeds(std::span<T> x) const { return x.subspan(StateLayout::kAngles + joints_, joints_); }
  [[nodiscard]] std::span<const T> speeds(std::span<const T> x) const {
    return x.subspan(StateLayout::kAngles + joints_, joints_);
  }

  /// Lets every motor miss its law by a thousandth of the relative accuracy of the torques (decision 48). The torque of a
  /// directional gear is curved, so that each smaller miss takes a further solve.
  void allow(const T& accuracy) {
    const T least = kTorqueTolerance, share = T(kShareOfAccuracy) * accuracy;
    torque_tolerance_ = math::select(share > least, share, least);
  }

  TreeBody<T> body;
  Contacts<T> contacts;
  StepMotors<T> motors;
  Stops<T> stops;        ///< the time of `holds` is set before step() and evaluate()
  std::vector<T> rotor;  ///< reflected inertia of each joint without play, kg m^2
  Plays<T> plays;
  StepResult<T> done;          ///< result of the last step
  T solves = 0.0;              ///< number of solves of the last step
  math::Mask<T> unfinished{};  ///< lanes in which Newton's method did not converge
  T off = 0.0;                 ///< number of motors and stops off their law after the last step
  math::Mask<T> switched{};    ///< lanes in which a joint began or ceased to stick since the mask was cleared

 private:
  /// Sets the tangents at the speeds at the end of the last step, so that every law begins on the branch of that step.
  void start(std::span<const T> x, In command, double h) {
    const math::Mask<T> all = T(0.0) <= T(0.0);
    motors.begin(command, plays.motor_speeds(x));
    motors.linearise(command, plays.motor_speeds(x));
    plays.start(x, h);
    for (std::size_t j = 0; j < joints_; ++j) {
      motors.touch(j, all, x[plays.entry(j)], x[plays.entry(j)]);
      const StopTorque<T> s = stops.both_at_end(x, j, speeds(x)[j], h);
      stop_[j] = s.torque;
      stop_slope_[j] = s.slope;
    }
    contacts.begin(h);
  }

  void solve(std::span<const T> x, double h) {
    if (motors.any_jump) sticking_.stop(plays.motor_speeds(x), h);
    accelerate(h);
    contacts.solved(body, h);
    for (std::size_t j = 0; j < joints_; ++j) {
      next_.torque[j] = motors.torque[j] - T(h) * motors.slope[j] * next_.a[6 + plays.shaft(j)];
      if (motors.any_jump) next_.torque[j] = math::select(motors.sticks[j], sticking_.locks.torque[j], next_.torque[j]);
      next_.stop[j] = stop_[j] - T(h) * stop_slope_[j] * next_.a[6 + j];
    }
  }

  /// Replaces the iterate by the last solve.
  void move(const math::Mask<T>& which) {
    contacts.move(which);
    now_.move(which, next_);
    plays.move(which, T(1.0));
  }
  void move(const math::Mask<T>& which, const T& share) {
    contacts.move(which, share);
    now_.move(which, share, next_);
    plays.move(which, share);
  }

  /// Derivative of phi with respect to `share` on the way from the iterate to the last solve. The forces of the solve are
  /// linear on this way and balance M (v+ - v) at both ends of the way. The derivative is therefore the power of the forces of
  /// the solve minus the forces of the laws, and M itself is not needed.
  T climb(std::span<const T> x, In command, double h, const T& share) {
    const auto reached = [&](std::size_t c) { return now_.a[6 + c] + share * (next_.a[6 + c] - now_.a[6 + c]); };
    for (std::size_t j = 0; j < joints_; ++j) end_[j] = speeds(x)[j] + T(h) * reached(j);
    set_motor_ends(x, h, reached);
    motors.linearise(command, motor_ends());
    T sum = contacts.excess(share, h);
    for (std::size_t j = 0; j < joints_; ++j) {
      const T d = T(h) * (next_.a[6 + j] - now_.a[6 + j]);
      const T held = now_.torque[j] + now_.stop[j] + share * (next_.torque[j] + next_.stop[j] - now_.torque[j] - now_.stop[j]);
      const T motor = motors.any_jump ? math::select(motors.sticks[j], next_.torque[j], motors.law[j]) : motors.law[j];
      const T stop = stops.both_at_end(x, j, end_[j], h).torque;
      sum = sum + d * (held - motor - stop);
      if (!plays.has(j)) continue;
      const T beside = T(h) * (next_.a[6 + plays.shaft(j)] - now_.a[6 + plays.shaft(j)]) - d;  // motor relative to link
      const T torque = now_.torque[j] + share * (next_.torque[j] - now_.torque[j]);
      sum = sum + beside * (torque - motor);
    }
    for (std::size_t k = 0; k < plays.size(); ++k) {
      const T d = T(h) * (next_.a[6 + joints_ + k] - now_.a[6 + joints_ + k] - next_.a[6 + plays.joint(k)] +
                          now_.a[6 + plays.joint(k)]);
      const T held = plays.now[k] + share * (plays.next[k] - plays.now[k]);
      sum = sum + d * (held - plays.law(x, k, motor_end_, end_, h));
    }
    return sum;
  }

  /// Lanes where the law of a motor, end stop or contact, at the end speeds of the iterate, differs from the force in the
  /// solve. Sets missed_ to the number of joints whose motor or end stop differs.
  math::Mask<T> misses(std::span<const T> x, In command, double h) {
    for (std::size_t j = 0; j < joints_; ++j) end_[j] = speeds(x)[j] + T(h) * now_.a[6 + j];
    set_motor_ends(x, h, [&](std::size_t c) { return now_.a[6 + c]; });
    if (motors.any_jump) sticking_.come_to_rest(plays.motor_speeds(x), motor_ends());
    motors.linearise(command, motor_ends());
    math::Mask<T> any = contacts.off(h);
    missed_ = T(0.0);
    for (std::size_t j = 0; j < joints_; ++j) {
      auto motor = math::abs(motors.law[j] - now_.torque[j]) > torque_tolerance_ * motors.scale[j];
      if (motors.any_jump)
        motor = math::mask_or(math::fresh(motor, motors.sticks[j]), sticking_.contradicts(j, now_.torque, motor_ends()));
      // The rounding error of the torque of a passive spring may exceed the tolerance of a stop.
      const T allowed = tree_.passive.empty() ? T(kStopTolerance) : T(kStopTolerance) + T(kRounding) * math::abs(now_.stop[j]);
      const auto stop = math::abs(stops.both_at_end(x, j, end_[j], h).torque - now_.stop[j]) > allowed;
      const auto joint = math::mask_or(motor, stop);
      missed_ = missed_ + math::select(joint, T(1.0), T(0.0));
      any = math::mask_or(any, joint);
    }
    for (std::size_t k = 0; k < plays.size(); ++k) {
      const T allowed = T(kStopTolerance) + T(kRounding) * math::abs(plays.now[k]);
      const auto flank = math::abs(plays.law(x, k, motor_end_, end_, h) - plays.now[k]) > allowed;
      missed_ = missed_ + math::select(flank, T(1.0), T(0.0));
      any = math::mask_or(any, flank);
    }
    return any;
  }

  /// Sets the tangents of all laws at the iterate in the lanes `which`, after misses(). Laws within their tolerance are
  /// included, because otherwise climb() would not be the slope of phi.
  void touch(const math::Mask<T>& which, std::span<const T> x, double h) {
    for (std::size_t j = 0; j < joints_; ++j) {
      motors.touch(j, which, x[plays.entry(j)], motor_ends()[j]);
      const StopTorque<T> s = stops.both_at_end(x, j, end_[j], h);
      stop_slope_[j] = math::select(which, s.slope, stop_slope_[j]);
      stop_[j] = math::select(which, s.torque + s.slope * (end_[j] - speeds(x)[j]), stop_[j]);
    }
    plays.touch(which, x, motor_end_, end_, h);
    contacts.touch(which, h);
  }

  /// Writes the iterate into the state. Works use the mean of the velocities at start and end of the step.
  void finish(std::span<T> x, double h, const math::Mask<T>& which) {
    done.contact = done.friction = done.stops = done.hinges = T(0.0);
    for (const Contact<T>& c : contacts.touching()) {
      const T normal = dot(c.n, c.change);
      const T force = dot(c.n, c.held);
      done.contact = done.contact - h * force * (c.vn + 0.5 * normal);
      done.friction = done.friction - h * dot(c.held - force * c.n, c.vt + T(0.5) * (c.change - normal * c.n));
    }
    for (std::size_t k = 0; k < tree_.passive.size(); ++k) finish_hinge(k, x, h);
    for (std::size_t j = 0; j < joints_; ++j) {
      done.stops = done.stops - h * now_.stop[j] * (speeds(x)[j] + 0.5 * h * now_.a[6 + j]);
    }
    if (plays.any()) done.stops = done.stops + plays.work(x, now_.a, h);
    for (std::size_t i = 0; i < 6; ++i) {
      T& v = x[StateLayout::kVelocity + i];
      v = math::select(which, v + T(h) * now_.a[i], v);
    }
    const std::span<T> qd = speeds(x);
    for (std::size_t j = 0; j < joints_; ++j) {
      const T end = qd[j] + T(h) * now_.a[6 + j];
      const T rest = motors.any_jump && !plays.has(j) ? math::select(motors.sticks[j], T(0.0), end) : end;
      qd[j] = math::select(which, rest, qd[j]);
      // The law of a joint that sticks is vertical.
      if (motors.any_jump)
        motors.slope[j] = math::select(motors.sticks[j], T(std::numeric_limits<double>::infinity()), motors.slope[j]);
    }
    for (std::size_t k = 0; k < plays.size(); ++k) {
      T& w = x[plays.speeds() + k];
      const T end = w + T(h) * now_.a[6 + joints_ + k];
      const T rest = motors.any_jump ? math::select(motors.sticks[plays.joint(k)], T(0.0), end) : end;
      w = math::select(which, rest, w);
    }
    std::copy(x.begin(), x.end(), place_.begin());
    drift<T>(place_, joints_, h);
    for (std::size_t e = 0; e < x.size(); ++e) x[e] = math::select(which, place_[e], x[e]);
    done.torque = now_.torque;
    for (const std::size_t j : tree_.passive) done.torque[j] = T(0.0);  // friction of the hinge, which no motor makes
    std::ranges::copy(plays.motor_speeds(x), done.speed.begin());
    std::copy_n(x.begin() + StateLayout::kAngles, joints_, done.angle.begin());
  }

  /// Splits the joint torque of stop and passive hinge in the solve into the torque of the stop and the work on the hinge.
  void finish_hinge(std::size_t k, std::span<const T> x, double h) {
    const std::size_t j = tree_.passive[k];
    const T end = speeds(x)[j] + T(h) * now_.a[6 + j];
    const T stop = stops.at_end(x, j, end, h).torque;
    const T spring = stops.hinges[k].spring(x[StateLayout::kAngles + j] + T(h) * end);
    const T lost = now_.stop[j] - stop - spring + (motors.any_jump ? now_.torque[j] : T(0.0));
    done.hinges = done.hinges - T(h) * lost * (speeds(x)[j] + T(0.5) * T(h) * now_.a[6 + j]);
    now_.stop[j] = stop;
  }

  /// Sets motor_end_, after end_. `accelerated(c)`: acceleration of coordinate c behind those of the base.
  template <class Accelerated>
  void set_motor_ends(std::span<const T> x, double h, const Accelerated& accelerated) {
    if (!plays.any()) return;
    motor_end_ = end_;
    for (std::size_t k = 0; k < plays.size(); ++k)
      motor_end_[plays.joint(k)] = x[plays.speeds() + k] + T(h) * accelerated(joints_ + k);
  }
  /// Speeds of the motors at the end of the step in the iterate, by joint.
  [[nodiscard]] std::vector<T>& motor_ends() { return plays.any() ? motor_end_ : end_; }

  const Tree<T>& tree_;
  std::size_t joints_;
  std::vector<T> passive_;    ///< torques of passive hinges, set by evaluate()
  std::vector<T> motor_end_;  ///< empty without play
  std::vector<T> place_, stop_, stop_slope_, force_, diagonal_, end_;
  Sticking<T> sticking_;
  std::vector<math::Mask<T>> rests_;  ///< joints at rest in add_friction()
  Iterate<T> now_, next_;
  T missed_ = 0.0;
  T torque_tolerance_ = kTorqueTolerance;  ///< share of the largest torque of a motor at rest
};

}  // namespace gaitlab::articulated
