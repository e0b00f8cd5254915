// One step of time over a scalar T, a double or lanes: implicit, extrapolated, rk4.
#pragma once
#include <algorithm>
#include <cstring>

#include "core/laws/hinge_stop.h"
#include "physics_articulated/contacts.h"
#include "physics_articulated/motors.h"

namespace gaitlab::articulated {

enum Method { kImplicit, kExtrapolated, kRk4 };

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
  static constexpr int kSolves = 4;

  Stepper(const Tree<T>& tree, const Site<T>& site, const Actuator* actuator, Method method)
      : body(tree, site.gravity),
        contacts(tree, site),
        motors(actuator, tree.lo.size()),
        rotor(tree.lo.size(), T(0.0)),
        done(tree.lo.size()),
        tree_(tree),
        method_(method),
        joints_(tree.lo.size()),
        part_(joints_),
        whole_part_(joints_) {
    for (auto* values : {&stop_, &stop_slope_, &force_, &diagonal_, &end_}) values->assign(joints_, T(0.0));
    for (auto* state : {&whole_, &prepared_, &stage_, &rate_, &sum_}) state->assign(StateLayout::kAngles + 2 * joints_, T(0.0));
    a_.assign(6 + joints_, T(0.0));
    const In inertia = actuator == nullptr ? In() : actuator->reflected_inertia();
    std::copy(inertia.begin(), inertia.end(), math::numbers(std::span<T>(rotor)).begin());
  }

  /// Places the body and finds its contacts, unless this was the last state placed.
  void place(std::span<const T> x) {
    const In now = math::numbers(x);
    const In last = math::numbers(std::span<const T>(prepared_));
    if (placed_ && std::memcmp(now.data(), last.data(), now.size_bytes()) == 0) return;
    std::copy(x.begin(), x.end(), prepared_.begin());
    placed_ = true;
    body.place(x);
    contacts.find(body);
  }

  /// Held commands: joint * lanes + lane.
  void step(std::span<T> x, In command, double h) {
    done.clear();
    if (method_ == kRk4) {
      runge_kutta(x, command, h);
      return;
    }
    begin(x, command);
    if (method_ == kImplicit) {
      finish(x, command, h);
      done.add(part_, 1, 1);
      return;
    }
    motors.watch(command, speeds(x));
    std::copy(x.begin(), x.end(), whole_.begin());
    finish(whole_, command, h);
    motors.remember();
    whole_part_ = part_;
    for (int half = 0; half < 2; ++half) {
      if (half == 1) begin(x, command);
      finish(x, command, h / 2);
      motors.remember();
      done.add(part_, 1, 2);  // means of half the step: 2 / 2
    }
    extrapolate(x);
    normalise(x);
  }

  Body<T> body;
  Contacts<T> contacts;
  Motors<T> motors;
  std::vector<T> rotor;  ///< reflected inertia of each joint, kg m^2
  Done<T> done;          ///< of the last step

 private:
  std::span<T> speeds(std::span<T> x) const { return x.subspan(StateLayout::kAngles + joints_, joints_); }

  /// What a step needs of its start, whatever its length.
  void begin(std::span<T> x, In command) {
    place(x);
    motors.start(command, speeds(x));
  }

  /// x, at the end of two half steps, and done, their sum: less those of the whole step. Where a motor passed its limit in the
  /// step, one way or the other, the half steps stand: beyond a corner an extrapolation overshoots. (All of the robot stays
  /// with them: a joint by itself would not fit the others.)
  void extrapolate(std::span<T> x) {
    using math::select;
    math::Mask<T> corner{};
    for (std::size_t j = 0; j < joints_; ++j) corner = math::either(corner, motors.has_corner(j));
    const auto less = [&](const T& halves, const T& whole, double mean) {
      return select(corner, T(mean) * halves, T(2.0 * mean) * halves - whole);
    };
    for (std::size_t e = 0; e < x.size(); ++e) x[e] = less(x[e], whole_[e], 1);
    for (std::size_t j = 0; j < joints_; ++j) {
      done.torque[j] = less(done.torque[j], whole_part_.torque[j], 0.5);
      done.speed[j] = less(done.speed[j], whole_part_.speed[j], 0.5);
    }
    done.contact = less(done.contact, whole_part_.contact, 0.5);
    done.friction = less(done.friction, whole_part_.friction, 0.5);
    done.stops = less(done.stops, whole_part_.stops, 0.5);
  }

  /// An implicit step of h from where begin left off; begin serves several.
  void finish(std::span<T> x, In command, double h) {
    motors.begin();
    contacts.begin(h);
    stop(x, h);
    accelerate(h);
    for (int solve = 1;; ++solve) {
      for (std::size_t j = 0; j < joints_; ++j) end_[j] = speeds(x)[j] + T(h) * a_[6 + j];
      if (solve == kSolves) break;
      const bool held = motors.hold(command, speeds(x), end_);
      if (!contacts.change(body, h) && !held) break;
      accelerate(h);
    }
    for (std::size_t j = 0; j < joints_; ++j) part_.torque[j] = motors.torque[j] - T(h) * motors.slope[j] * a_[6 + j];
    part_.speed = end_;
    part_.contact = part_.friction = part_.stops = T(0.0);
    add_works(x, h, h);
    for (std::size_t i = 0; i < 6; ++i) x[StateLayout::kVelocity + i] = x[StateLayout::kVelocity + i] + T(h) * a_[i];
    std::copy(end_.begin(), end_.end(), speeds(x).begin());
    drift(x, h);
  }

  /// a_ from the motors and all else that acts.
  void accelerate(double h) {
    for (std::size_t j = 0; j < joints_; ++j) {
      force_[j] = motors.torque[j] + stop_[j];
      diagonal_[j] = rotor[j] + (h > 0 ? T(h) * (motors.slope[j] + stop_slope_[j]) : T(0.0));
    }
    body.solve(force_, diagonal_, a_, [&](std::size_t link, typename Body<T>::Load load) { contacts.load(link, load, h); });
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
    const T& qw = x[o];  // out may be x: last read where it is overwritten
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
    motors.evaluate(command, speeds(x));
    place(x);
    contacts.begin(0);
    stop(x, 0);
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
      part_.torque = motors.torque;
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

  const Tree<T>& tree_;
  Method method_;
  std::size_t joints_;
  std::vector<T> stop_, stop_slope_, force_, diagonal_, end_, a_;  // a joint; end_: speeds
  Done<T> part_, whole_part_;
  bool placed_ = false;
  std::vector<T> whole_, prepared_, stage_, rate_, sum_;
};

}  // namespace gaitlab::articulated
