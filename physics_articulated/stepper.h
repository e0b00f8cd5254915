// One step of time over a scalar T, a double or lanes: implicit, extrapolated, rk4.
#pragma once
#include <algorithm>

#include "core/laws/hinge_stop.h"
#include "physics_articulated/contacts.h"

namespace gaitlab::articulated {

/// What a step did, for the ledger.
template <class T>
struct Done {
  std::vector<T> torque, speed;                  ///< of the motors, N m; the speeds at which they gave it, rad/s
  T contact = 0.0, friction = 0.0, stops = 0.0;  ///< work of the robot on them, J

  explicit Done(std::size_t joints) : torque(joints), speed(joints) {}
  void clear() {
    std::fill(torque.begin(), torque.end(), T(0.0));
    std::fill(speed.begin(), speed.end(), T(0.0));
    contact = friction = stops = T(0.0);
  }
  /// Torque and speed are means of the step, work is a sum.
  void add(const Done& other, double to_mean, double to_sum) {
    for (std::size_t j = 0; j < torque.size(); ++j) {
      torque[j] = torque[j] + to_mean * other.torque[j];
      speed[j] = speed[j] + to_mean * other.speed[j];
    }
    contact = contact + to_sum * other.contact;
    friction = friction + to_sum * other.friction;
    stops = stops + to_sum * other.stops;
  }
};

/// State: entries as in StateLayout, SI. Nothing allocates after the constructor.
///
/// implicit (order 1, stable for any stiffness and damping): motors, stops and contacts act at the velocity of the step's end,
/// as far as their slopes tell:
///     (M + h B + h sum J^T G J) v' = tau + sum J^T f + weight - c        v+ = v + h v'        q+ = q (+) h v+
/// (docs/equations.md, 7). Motors whose limit the end of the step finds passed are held at it and the step is solved again;
/// none is released again, and there are at most kSolves. (To decide by the speed at the start lets the current flip from limit
/// to limit.) extrapolated (order 2): 2 x(two steps of h / 2) - x(one step of h), Richardson. rk4 (order 4, explicit): the
/// classical method on the whole state, for h lambda <= 1.
template <class T>
class Stepper {
 public:
  enum Method { implicit, extrapolated, rk4 };
  static constexpr int kSolves = 4;

  Stepper(const Tree& tree, const PlantSettings& s)
      : body(tree, s.gravity),
        contacts(tree, s.ground, s.law),
        rotor(tree.lo.size(), T(0.0)),
        done(tree.lo.size()),
        tree_(tree),
        actuator_(s.actuator),
        method_(static_cast<Method>(s.integrator)),
        joints_(tree.lo.size()),
        held_(joints_ * s.lanes),
        part_(joints_) {
    for (auto* values : {&torque_, &slope_, &limited_, &limited_slope_, &unlimited_, &unlimited_slope_, &stop_, &stop_slope_,
                         &force_, &diagonal_, &end_}) {
      values->assign(joints_, T(0.0));
    }
    for (auto* state : {&start_, &stage_, &rate_, &sum_}) state->assign(StateLayout::kAngles + 2 * joints_, T(0.0));
    a_.assign(6 + joints_, T(0.0));
    const In inertia = actuator_ == nullptr ? In() : actuator_->reflected_inertia();
    std::copy(inertia.begin(), inertia.end(), numbers(rotor).begin());
  }

  /// Held commands: joint * lanes + lane.
  void step(std::span<T> x, In command, double h) {
    done.clear();
    if (method_ == rk4) {
      runge_kutta(x, command, h);
      return;
    }
    if (method_ == implicit) {
      implicit_step(x, command, h);
      done.add(part_, 1, 1);
      return;
    }
    std::copy(x.begin(), x.end(), start_.begin());
    implicit_step(start_, command, h);
    done.add(part_, -1, -1);
    for (int i = 0; i < 2; ++i) {
      implicit_step(x, command, h / 2);
      done.add(part_, 1, 2);  // means of half the step: 2 / 2
    }
    for (std::size_t e = 0; e < x.size(); ++e) x[e] = 2.0 * x[e] - start_[e];
    normalise(x);
  }

  Body<T> body;
  Contacts<T> contacts;
  std::vector<T> rotor;  ///< reflected inertia of each joint, kg m^2
  Done<T> done;          ///< of the last step

 private:
  static Out numbers(std::span<T> values) { return math::numbers(values); }
  std::span<T> speeds(std::span<T> x) const { return x.subspan(StateLayout::kAngles + joints_, joints_); }

  void implicit_step(std::span<T> x, In command, double h) {
    if (actuator_ != nullptr) actuator_->unlimited(command, numbers(speeds(x)), numbers(torque_), numbers(slope_));
    std::fill(held_.begin(), held_.end(), false);
    place(x, h);
    accelerate(h);
    for (int solve = 1;; ++solve) {
      for (std::size_t j = 0; j < joints_; ++j) end_[j] = speeds(x)[j] + h * a_[6 + j];
      if (solve == kSolves) break;
      const bool motors = hold(command, numbers(speeds(x)));
      if (!contacts.change(body, h) && !motors) break;
      body.clear();
      accelerate(h);
    }
    for (std::size_t j = 0; j < joints_; ++j) part_.torque[j] = torque_[j] - h * slope_[j] * a_[6 + j];
    part_.speed = end_;
    part_.contact = part_.friction = part_.stops = T(0.0);
    add_works(x, h, h);
    for (std::size_t i = 0; i < 6; ++i) x[StateLayout::kVelocity + i] = x[StateLayout::kVelocity + i] + h * a_[i];
    std::copy(end_.begin(), end_.end(), speeds(x).begin());
    drift(x, h);
  }

  /// Holds motors at the limits that the step's end passes, there being any that were not held; torque and slope are then the
  /// law's at that end.
  bool hold(In command, In speed) {
    if (actuator_ == nullptr) return false;
    const In end = numbers(end_);
    actuator_->effort(command, end, numbers(limited_), numbers(limited_slope_));
    actuator_->unlimited(command, end, numbers(unlimited_), numbers(unlimited_slope_));
    bool more = false;
    for (std::size_t i = 0; i < held_.size(); ++i) {
      if (held_[i] || numbers(limited_)[i] == numbers(unlimited_)[i]) continue;
      held_[i] = more = true;
      numbers(slope_)[i] = numbers(limited_slope_)[i];
      numbers(torque_)[i] = numbers(limited_)[i] + numbers(limited_slope_)[i] * (end[i] - speed[i]);
    }
    return more;
  }

  /// h: over which slopes work, 0: explicit.
  void place(std::span<T> x, double h) {
    body.place(x);
    contacts.find(body, h);
    stop(x, h);
  }

  /// a_ from the motors' torque_ and slope_ and all else that acts.
  void accelerate(double h) {
    contacts.apply(body, h);
    for (std::size_t j = 0; j < joints_; ++j) {
      force_[j] = torque_[j] + stop_[j];
      diagonal_[j] = rotor[j] + (h > 0 ? h * (slope_[j] + stop_slope_[j]) : T(0.0));
    }
    body.solve(force_, diagonal_, a_);
  }

  /// Torque and slope of the stops as contacts have them: -ks (q + h qd+ - q_lim) - cs qd+.
  void stop(std::span<T> x, double h) {
    using math::select;
    for (std::size_t j = 0; j < joints_; ++j) {
      const T& qd = speeds(x)[j];
      const auto law = BasicHingeStop<T>::at(x[StateLayout::kAngles + j], qd, tree_.lo[j], tree_.hi[j]);
      const T ahead = law.torque - h * law.stiffness * qd;
      const auto opposes = ahead * law.torque > 0.0;
      stop_[j] = select(opposes, ahead, T(0.0));
      stop_slope_[j] = select(opposes, law.damping + h * law.stiffness, T(0.0));
    }
  }

  /// Work over dt of the forces of the last accelerate, at the middle of the velocities it joins (h as there).
  void add_works(std::span<T> x, double h, double dt) {
    for (const Contact<T>& c : contacts.touching()) {
      const Vec<T> change = T(h) * body.change(c.link, c.x);
      const T normal = dot(c.n, change);
      const Vec<T> tangential = change - normal * c.n;
      part_.contact = part_.contact - dt * (c.fn - c.gn * normal) * (c.vn + 0.5 * normal);
      part_.friction = part_.friction - dt * dot(c.friction(c.vt + tangential), c.vt + T(0.5) * tangential);
    }
    for (std::size_t j = 0; j < joints_; ++j) {
      const T change = h * a_[6 + j];
      part_.stops = part_.stops - dt * (stop_[j] - stop_slope_[j] * change) * (speeds(x)[j] + 0.5 * change);
    }
  }

  void drift(std::span<T> x, double h) const {
    for (std::size_t i = 0; i < 3; ++i) x[i] = x[i] + h * x[StateLayout::kVelocity + i];
    for (std::size_t j = 0; j < joints_; ++j) x[StateLayout::kAngles + j] = x[StateLayout::kAngles + j] + h * speeds(x)[j];
    constexpr std::size_t w = StateLayout::kAngularVelocity;
    const Vec<T> omega{x[w], x[w + 1], x[w + 2]};
    const T rate = math::sqrt(dot(omega, omega));
    const auto [s, c] = math::sincos(0.5 * h * rate);
    turn(x, c, (s / math::select(rate > 0.0, rate, T(1.0))) * omega, x);
    normalise(x);
  }

  /// Orientation of `out` = (w, v) times that of x.
  static void turn(std::span<const T> x, const T& w, const Vec<T>& v, std::span<T> out) {
    constexpr std::size_t o = StateLayout::kOrientation;
    const T qw = x[o];
    const Vec<T> q{x[o + 1], x[o + 2], x[o + 3]};
    const Vec<T> turned = w * q + qw * v + cross(v, q);
    out[o] = w * qw - dot(v, q);
    out[o + 1] = turned.x;
    out[o + 2] = turned.y;
    out[o + 3] = turned.z;
  }

  static void normalise(std::span<T> x) {
    const auto q = x.subspan(StateLayout::kOrientation, 4);
    const T length = math::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (T& value : q) value = value / length;
  }

  /// d/dt of the whole state, the orientation as a quaternion: q' = (0, omega) q / 2.
  void derive(std::span<T> x, In command, std::span<T> rate) {
    if (actuator_ != nullptr) actuator_->effort(command, numbers(speeds(x)), numbers(torque_), numbers(slope_));
    place(x, 0);
    accelerate(0);
    constexpr std::size_t w = StateLayout::kAngularVelocity;
    std::copy_n(x.begin() + StateLayout::kVelocity, 3, rate.begin());
    turn(x, T(0.0), T(0.5) * Vec<T>{x[w], x[w + 1], x[w + 2]}, rate);
    std::copy_n(a_.begin(), 6, rate.begin() + StateLayout::kVelocity);
    std::copy_n(speeds(x).begin(), joints_, rate.begin() + StateLayout::kAngles);
    std::copy_n(a_.begin() + 6, joints_, speeds(rate).begin());
  }

  void runge_kutta(std::span<T> x, In command, double h) {
    constexpr std::array<double, 4> kWeight{1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
    constexpr std::array<double, 4> kReach{0.5, 0.5, 1.0, 0.0};
    std::copy(x.begin(), x.end(), stage_.begin());
    std::copy(x.begin(), x.end(), sum_.begin());
    std::ranges::copy(speeds(x), done.speed.begin());
    for (std::size_t i = 0; i < 4; ++i) {
      derive(stage_, command, rate_);
      part_.contact = part_.friction = part_.stops = T(0.0);
      add_works(stage_, 0, kWeight[i] * h);
      part_.torque = torque_;
      std::fill(part_.speed.begin(), part_.speed.end(), T(0.0));
      done.add(part_, kWeight[i], 1);
      for (std::size_t e = 0; e < x.size(); ++e) {
        sum_[e] = sum_[e] + kWeight[i] * h * rate_[e];
        stage_[e] = x[e] + kReach[i] * h * rate_[e];
      }
    }
    std::copy(sum_.begin(), sum_.end(), x.begin());
    normalise(x);
  }

  const Tree& tree_;
  const Actuator* actuator_;
  Method method_;
  std::size_t joints_;
  std::vector<T> torque_, slope_;                                         // of the motors, as the solve takes them
  std::vector<T> limited_, limited_slope_, unlimited_, unlimited_slope_;  // of the motors' laws at the step's end
  std::vector<T> stop_, stop_slope_, force_, diagonal_, end_, a_;         // a joint; end_: speeds
  std::vector<char> held_;                                                // joint * lanes + lane
  Done<T> part_;
  std::vector<T> start_, stage_, rate_, sum_;
};

}  // namespace gaitlab::articulated
