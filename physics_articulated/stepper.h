// Time step for a scalar type T (double or lanes) by the integrators implicit, extrapolated, adaptive and rk4.
#pragma once
#include <algorithm>

#include "core/math/runge_kutta.h"
#include "physics_articulated/agreement.h"
#include "physics_articulated/lost_speeds.h"

namespace gaitlab::articulated {

enum class StepMethod { adaptive, implicit, extrapolated, rk4 };

/// Advances the state by one step. The state has the entries of StateLayout, SI. The constructor allocates. Further memory is
/// needed only if a search does not converge, or if a step is divided further than any before and the robot has more than about
/// 1000 joints (300 in four lanes).
///
/// - implicit (order 1): one implicit step (implicit.h).
/// - extrapolated (order 2): 2 x(two steps of h / 2) - x(one step of h), Richardson.
/// - adaptive: the result of `extrapolated` if its estimated error is within the accuracy. Otherwise the result of order 3,
/// x(h)/3 - 2 x(h/2) + 8/3 x(h/4), if the estimated error of this result is within the accuracy. Otherwise two such steps of
/// half the length.
/// - rk4 (order 4, explicit): the classical method on the whole state, for h lambda <= 1.
///
/// If the search of an implicit step does not converge, the step is taken in two halves, only in the affected lanes, down to h
/// / 64. Joints that are then still off their law are counted.
template <class T>
class Stepper {
 public:
  /// `solos` has an element for each lane, or none; they must outlive the stepper.
  Stepper(const Tree<T>& tree, const Environment<T>& environment, const Actuator* actuator, StepMethod method,
          const T& accuracy, std::span<const SoloOfLane> solos)
      : implicit(tree, environment, actuator),
        layout{tree.lo.size()},
        method_(method),
        joints_(tree.lo.size()),
        agreement_(accuracy),
        history_(layout.size(), T(0.0)),
        lost_(2 * implicit.plays.size() + joints_),
        solos_(solos),
        of_solo_(StateLayout::kAngles + 2 * (joints_ + implicit.plays.size())),
        command_of_solo_(joints_),
        eighths_(of_solo_.size()) {
    const std::vector<T> zero(of_solo_.size(), T(0.0));
    for (auto* state : {&sum_, &stage_, &rate_}) *state = zero;
    const StepWay<T> way{zero, 0, 0};
    levels_.assign(kLevels, {zero, 0, way, way, way, way, way, way, {std::vector<math::Mask<T>>(joints_), {}}});
    limits_ = levels_[0].limits;
    halved_.assign(kHalvings, zero);
    if (method == StepMethod::adaptive) implicit.allow(accuracy);
    if (method == StepMethod::rk4) {  // an explicit method needs smooth laws of friction
      implicit.motors.creep();
      implicit.stops.creep();
    }
    parts_.assign(method == StepMethod::adaptive ? std::clamp<std::size_t>(kRoom / size_of_part(), 8, kMostParts) : 4,
                  StepPart<T>(joints_));
  }

  /// Advances x by a step h. `command` is constant, with index joint * lanes + lane.
  void step(std::span<T> x, In command, double h) {
    used_ = 0;
    eighths_.clear();
    contact = friction = stops = hinges = T(0.0);
    if (method_ == StepMethod::rk4) {
      runge_kutta(x, command, h);
    } else {
      take_start(x, command);
      const math::Mask<T> all = T(0.0) <= T(0.0);
      if (method_ == StepMethod::implicit) single(x, command, h, all);
      if (method_ == StepMethod::extrapolated) adapt(x, command, h, all, kLevels);
      if (method_ == StepMethod::adaptive) {
        agreement_.begin(history_[layout.quiet()]);
        implicit.switched = {};
        adapt(x, command, h, all, 0);
        agreement_.add_event(implicit.switched);
        history_[layout.quiet()] = agreement_.quiet(h);
      }
    }
    close();
  }

  /// Numbers kept from step to step, with the entries of History.
  std::span<T> history() { return history_; }
  [[nodiscard]] std::size_t most_parts() const { return parts_.size(); }  ///< largest number of parts if every search converges
  [[nodiscard]] std::span<const StepPart<T>> parts() const { return {parts_.data(), used_}; }
  [[nodiscard]] const Eighths<T>& eighths() const { return eighths_; }

  Implicit<T> implicit;
  T contact = 0.0, friction = 0.0, stops = 0.0, hinges = 0.0;  ///< work of the last step, J
  History layout;

 private:
  static constexpr std::size_t kLevels = 7;  ///< number of lengths of an adaptive step, h to h / 64
  static constexpr std::size_t kShortest = std::size_t{1} << (kLevels - 1);
  static constexpr std::size_t kHalvings = 6;  ///< depth of halving a step whose search does not converge
  static constexpr std::size_t kMostParts = 1 + 7 * ((std::size_t{1} << kLevels) - 1);
  static constexpr std::size_t kRoom = 32 << 20;  ///< bytes of parts that the constructor allocates
  [[nodiscard]] std::size_t size_of_part() const { return sizeof(StepPart<T>) + 3 * joints_ * sizeof(T); }

  /// Adds a part for the start of the step under the new command, because the motor torques there may be peaks.
  void take_start(std::span<const T> x, In command) {
    StepMotors<T>& motors = implicit.motors;
    const std::span<const T> speeds = implicit.plays.motor_speeds(x);
    motors.begin(command, speeds);
    motors.linearise(command, speeds);
    StepPart<T>& part = add_part();
    part.torque = motors.law;
    for (std::size_t j = 0; motors.any_jump && j < joints_; ++j) {
      const T least = math::clamp(T(0.0), motors.below[j], motors.above[j]);
      part.torque[j] = math::select(motors.sticks[j], least, part.torque[j]);
    }
    for (const std::size_t j : motors.passive()) part.torque[j] = T(0.0);
    std::ranges::copy(speeds, part.speed.begin());
    std::copy_n(x.begin() + StateLayout::kAngles, joints_, part.angle.begin());
    part.contact = part.friction = part.stops = part.hinges = T(0.0);
    part.lanes = T(0.0) <= T(0.0);
    part.h = 0;
  }

  StepPart<T>& add_part() {
    if (used_ == parts_.size()) parts_.emplace_back(joints_);
    StepPart<T>& part = parts_[used_++];
    part.sum = part.share = part.off = T(0.0);
    return part;
  }

  /// Takes an implicit step of the lane `l` in scalar code, which ends at `end`. `which` contains this lane only.
  void step_alone(std::size_t l, std::span<T> x, In command, double h, double end, const math::Mask<T>& which) {
    Solo& solo = *solos_[l].get;
    for (std::size_t e = 0; e < x.size(); ++e) of_solo_[e] = math::lane(x[e], l);
    for (std::size_t j = 0; j < joints_; ++j) command_of_solo_[j] = command[j * math::kLanes<T> + l];
    solo.step(of_solo_, command_of_solo_, h, end);
    for (std::size_t e = 0; e < x.size(); ++e) math::lane(x[e], l) = of_solo_[e];
    implicit.take(solo, l, which);
    apart_ = math::mask_or(apart_, which);
    slide_ = solo.slides ? math::mask_or(slide_, which) : math::fresh(slide_, which);
  }

  /// Takes one implicit step in the lanes `which` and adds its parts. It begins `at` seconds after the start of the whole step.
  void settle(std::span<T> x, In command, double h, const math::Mask<T>& which, double at, std::size_t halvings = 0) {
    if (halvings < kHalvings) std::copy(x.begin(), x.end(), halved_[halvings].begin());
    const std::size_t alone = solos_.empty() ? math::kLanes<T> : only_lane<T>(which);
    if (alone < math::kLanes<T>) {
      step_alone(alone, x, command, h, at + h, which);
    } else {
      implicit.stops.holds.at(at + h);
      implicit.step(x, command, h, which);
      apart_ = math::fresh(apart_, which);
    }
    history_[layout.solves()] = history_[layout.solves()] + math::select(which, implicit.solves, T(0.0));
    const bool halve = halvings < kHalvings && math::any_lane(implicit.unfinished);
    StepPart<T>& part = add_part();
    static_cast<StepResult<T>&>(part) = implicit.done;
    part.lanes = halve ? math::fresh(which, implicit.unfinished) : which;
    part.h = h;
    part.off = implicit.off;
    if (!halve) return;
    const math::Mask<T> again = implicit.unfinished;
    for (std::size_t e = 0; e < x.size(); ++e) x[e] = math::select(again, halved_[halvings][e], x[e]);
    for (int half = 0; half < 2; ++half) settle(x, command, h / 2, again, at + half * h / 2, halvings + 1);
  }

  /// Sets the weights of Richardson's extrapolation for the parts of a way in the lanes `which`. If `finest`, these parts
  /// represent the motion.
  void weigh(const StepWay<T>& way, const math::Mask<T>& which, double weight, bool finest) {
    for (std::size_t i = way.from; i < way.to; ++i) {
      StepPart<T>& part = parts_[i];
      const auto here = math::mask_and(which, part.lanes);
      part.sum = math::select(here, T(weight * part.h), part.sum);
      part.share = math::select(here, T(finest ? part.h : 0.0), part.share);
    }
  }

  void single(std::span<T> x, In command, double h, const math::Mask<T>& which) {
    settle(x, command, h, which, 0);
    weigh({{}, 1, used_}, which, 1, true);
  }

  /// Lets joints with dry friction keep the mode in which the finest way `finest` ends: an extrapolated speed on its other side
  /// would mean a torque on the other side of the jump.
  void keep_modes(std::span<T> x, const std::vector<T>& two, const std::vector<T>& four, const math::Mask<T>& second) const {
    for (std::size_t j = 0; j < joints_; ++j) {
      const std::size_t e = implicit.plays.entry(j);
      const T finest = math::select(second, two[e], four[e]);
      const auto other = math::mask_and(implicit.motors.jumps[j], x[e] * finest <= T(0.0));
      x[e] = math::select(other, finest, x[e]);
    }
  }

  /// Returns true if joints lose speed in lanes of `which`, in which the results agree apart from that.
  bool find_lost(const std::vector<T>& start, const std::vector<T>& end, In command, double h, const math::Mask<T>& which) {
    const math::Mask<T> asked = lost_.find(implicit, start, end, command, h, which);
    history_[layout.solves()] = history_[layout.solves()] + math::select(asked, T(1.0), T(0.0));
    return math::any_lane(asked);
  }

  /// Limits after the last solve of each lane.
  void look(StepLimits<T>& limits) const {
    for (std::size_t j = 0; j < joints_; ++j) limits.motor[j] = implicit.motors.at_limit(j);
    limits.slide = math::mask_or(math::fresh(implicit.contacts.mostly_slide(), apart_), math::mask_and(slide_, apart_));
  }

  /// Takes an implicit step from `start` to way.x. If `start` is the end of another way, the new way includes the parts of that
  /// way.
  void go(StepWay<T>& way, const std::vector<T>& start, In command, double h, const math::Mask<T>& which, double at) {
    std::copy(start.begin(), start.end(), way.x.begin());
    way.from = used_;
    settle(way.x, command, h, which, at);
    way.to = used_;
  }
  void go(StepWay<T>& way, const StepWay<T>& before, In command, double h, const math::Mask<T>& which, double at) {
    go(way, before.x, command, h, which, at);
    way.from = before.from;
  }

  /// Takes the whole step and the two halves of a level. If this level is the first half of the level `before`, whose four
  /// quarters missed the accuracy, it copies the steps that `before` has already taken.
  const StepLimits<T>& one_and_two(Level<T>& own, In command, double h, const math::Mask<T>& which, const Level<T>* before) {
    if (before != nullptr) {
      own.whole = before->half;
      own.half = before->quarter;
      own.halves = before->early;
      return before->limits;
    }
    go(own.whole, own.start, command, h, which, own.at);
    go(own.half, own.start, command, h / 2, which, own.at);
    go(own.halves, own.half, command, h / 2, which, own.at + h / 2);
    look(limits_);
    return limits_;
  }
  void four(Level<T>& own, In command, double h, const math::Mask<T>& which) {
    go(own.quarter, own.start, command, h / 4, which, own.at);
    go(own.early, own.quarter, command, h / 4, which, own.at + h / 4);
    look(own.limits);
    go(own.quarters, own.early, command, h / 4, which, own.at + h / 2);
    settle(own.quarters.x, command, h / 4, which, own.at + 3 * h / 4);
    own.quarters.to = used_;
    look(limits_);
  }

  /// Drops the parts from `first` on, except those that the next level uses.
  void drop(Level<T>& own, std::size_t first) {
    used_ = first;
    const std::size_t of_quarter = own.quarter.to - own.quarter.from;
    for (StepWay<T>* way : {&own.half, &own.early}) {
      if (way->from < first) continue;  // belongs to the previous level
      const std::size_t from = used_;
      for (std::size_t i = way->from; i < way->to; ++i) std::swap(parts_[used_++], parts_[i]);
      way->from = from;
      way->to = used_;
    }
    own.quarter.from = own.early.from;
    own.quarter.to = own.early.from + of_quarter;
  }

  /// Advances the lanes `which` by a step h, which ends after `end` of the kShortest shortest parts of the whole step. The step
  /// at level kLevels has second order, regardless of its error.
  void adapt(std::span<T> x, In command, double h, const math::Mask<T>& which, std::size_t level, std::size_t end = kShortest,
             const Level<T>* before = nullptr) {
    using math::select;
    const bool fixed = level == kLevels;
    Level<T>& own = levels_[fixed ? 0 : level];
    std::copy(x.begin(), x.end(), own.start.begin());
    own.at = fixed ? 0 : h * static_cast<double>(end) / static_cast<double>(kShortest >> level) - h;
    const std::size_t first = used_;
    const StepLimits<T>& limits = one_and_two(own, command, h, which, before);
    const auto &one = own.whole.x, &two = own.halves.x, &four = own.quarters.x;
    const auto agree = [&](double share, const math::Mask<T>& in, const StepLimits<T>& after, const auto& difference) {
      const std::span<const T> peak(&history_[layout.peak()], joints_);
      return agreement_.within(share, in, after, implicit.motors, implicit.plays, peak, difference);
    };
    const auto of_second = [&](std::size_t e) { return two[e] - one[e]; };
    auto second = agree(Agreement<T>::kSecondOrder, which, limits, of_second);
    if (find_lost(own.half.x, two, command, h / 2, second))
      second = agree(Agreement<T>::kSecondOrder, second, limits, [&](std::size_t e) { return lost_.added(e, of_second(e)); });
    if (fixed) second = which;
    weigh(own.whole, second, -1, false);
    weigh(own.halves, second, 2, true);
    const auto more = math::fresh(which, second);
    math::Mask<T> third{};
    if (math::any_lane(more)) {
      this->four(own, command, h, more);
      const auto of_third = [&](std::size_t e) { return 2.0 * (four[e] - two[e]) - (two[e] - one[e]); };
      third = agree(Agreement<T>::kThirdOrder, more, limits_, of_third);
      if (find_lost(own.early.x, four, command, h / 4, third))
        third = agree(Agreement<T>::kThirdOrder, third, limits_, [&](std::size_t e) { return lost_.added(e, of_third(e)); });
      if (level + 1 == kLevels) {
        T& coarse = history_[layout.coarse()];
        coarse = coarse + select(math::fresh(more, third), T(h), T(0.0));
        third = more;
      }
      weigh(own.whole, third, 1.0 / 3, false);
      weigh(own.halves, third, -2, false);
      weigh(own.quarters, third, 8.0 / 3, true);
    }
    for (std::size_t e = 0; e < x.size(); ++e) {
      const T of_three = T(1.0 / 3) * one[e] - T(2.0) * two[e] + T(8.0 / 3) * four[e];
      x[e] = select(second, T(2.0) * two[e] - one[e], of_three);
    }
    normalise<T>(x);
    if (implicit.motors.any_jump) keep_modes(x, two, four, second);
    const auto taken = math::mask_or(second, third);
    for (std::size_t e = 0; e < x.size(); ++e) x[e] = select(taken, x[e], own.start[e]);
    eighths_.keep(x, taken, end, kShortest);
    const auto shorter = math::mask_and(math::fresh(which, taken), finite<T>(own.start));
    if (!math::any_lane(shorter)) return;
    if (!math::any_lane(taken)) drop(own, first);  // no lane uses the other steps
    adapt(x, command, h / 2, shorter, level + 1, end - (kShortest >> (level + 1)), &own);
    adapt(x, command, h / 2, shorter, level + 1, end);
  }

  /// Computes sums over the parts, and peaks.
  void close() {
    for (std::size_t i = 0; i < used_; ++i) {
      const StepPart<T>& part = parts_[i];
      if (!(part.h > 0) || !part.weighed()) continue;
      const T weight = part.sum / T(part.h);
      contact = contact + weight * part.contact;
      friction = friction + weight * part.friction;
      stops = stops + weight * part.stops;
      hinges = hinges + weight * part.hinges;
      T& off = history_[layout.off()];
      off = off + math::select(part.share > T(0.0), part.off, T(0.0));
    }
    for (std::size_t j = 0; j < joints_; ++j) {
      T& peak = history_[layout.peak() + j];
      const T now = math::abs(parts_[used_ - 1].torque[j]);
      peak = math::select(now > peak, now, peak);
    }
  }

  /// Time derivative of the whole state. The orientation is a quaternion: q' = (0, omega) q / 2.
  void derive(std::span<T> x, In command, std::span<T> rate) {
    implicit.evaluate(x, command);
    constexpr std::size_t w = StateLayout::kAngularVelocity;
    std::copy_n(x.begin() + StateLayout::kVelocity, 3, rate.begin());
    turn<T>(x, T(0.0), T(0.5) * Vec<T>{x[w], x[w + 1], x[w + 2]}, rate);
    std::copy_n(implicit.accelerations().begin(), 6, rate.begin() + StateLayout::kVelocity);
    std::ranges::copy(implicit.speeds(x), rate.begin() + StateLayout::kAngles);
    std::ranges::copy(implicit.accelerations().subspan(6, joints_), implicit.speeds(rate).begin());
    const Plays<T>& plays = implicit.plays;
    for (std::size_t k = 0; k < plays.size(); ++k) {
      rate[plays.angles() + k] = x[plays.speeds() + k];
      rate[plays.speeds() + k] = implicit.accelerations()[6 + joints_ + k];
    }
  }

  void runge_kutta(std::span<T> x, In command, double h) {
    constexpr auto kWeight = math::RungeKutta::kWeight;
    constexpr auto kReach = math::RungeKutta::kReach;
    std::copy(x.begin(), x.end(), stage_.begin());
    std::copy(x.begin(), x.end(), sum_.begin());
    StepPart<T>& part = add_part();
    part.lanes = T(0.0) <= T(0.0);
    part.h = h;
    part.sum = part.share = T(h);
    part.contact = part.friction = part.stops = part.hinges = T(0.0);
    std::fill(part.torque.begin(), part.torque.end(), T(0.0));
    std::ranges::copy(implicit.plays.motor_speeds(x), part.speed.begin());
    std::copy_n(x.begin() + StateLayout::kAngles, joints_, part.angle.begin());
    for (std::size_t i = 0; i < 4; ++i) {
      implicit.stops.holds.at(i == 0 ? 0 : kReach[i - 1] * h);
      derive(stage_, command, rate_);
      const auto [normal, along, on_stops, on_hinges] = implicit.powers(stage_);
      part.contact = part.contact + kWeight[i] * h * normal;
      part.friction = part.friction + kWeight[i] * h * along;
      part.stops = part.stops + kWeight[i] * h * on_stops;
      part.hinges = part.hinges + kWeight[i] * h * on_hinges;
      for (std::size_t j = 0; j < joints_; ++j) part.torque[j] = part.torque[j] + kWeight[i] * implicit.motors.law[j];
      for (std::size_t e = 0; e < x.size(); ++e) {
        sum_[e] = sum_[e] + kWeight[i] * h * rate_[e];
        stage_[e] = x[e] + kReach[i] * h * rate_[e];
      }
    }
    std::copy(sum_.begin(), sum_.end(), x.begin());
    normalise<T>(x);
  }

  StepMethod method_;
  std::size_t joints_, used_ = 0;
  Agreement<T> agreement_;
  std::vector<T> history_, sum_, stage_, rate_;
  LostSpeeds<T> lost_;
  std::vector<Level<T>> levels_;
  StepLimits<T> limits_;
  std::span<const SoloOfLane> solos_;
  std::vector<double> of_solo_, command_of_solo_;
  Eighths<T> eighths_;
  math::Mask<T> apart_{};  ///< lanes whose last step was taken by a solo
  math::Mask<T> slide_{};  ///< lanes of apart_ in which most of the load slides
  std::vector<std::vector<T>> halved_;
  std::vector<StepPart<T>> parts_;
};

}  // namespace gaitlab::articulated
