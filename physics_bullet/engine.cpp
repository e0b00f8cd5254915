#include "physics_bullet/engine.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <new>
#include <optional>
#include <string>

#include "core/dynamics/rotor_inertia.h"
#include "core/errors.h"
#include "core/laws/gear_play.h"
#include "core/laws/hinge_stop.h"
#include "core/laws/joint_friction.h"
#include "core/laws/passive_hinge.h"
#include "core/simulation/stability.h"
#include "core/simulation/step_advice.h"
#include "physics_articulated/engine.h"
#include "physics_bullet/bullet_dynamics.h"
#include "physics_bullet/multibody.h"
#include "physics_bullet/solver_plant.h"

namespace gaitlab {

namespace {

constexpr const char* kRk4 = "rk4";
constexpr double kLongestBulletStep = 5e-5;  // s; with a longer step, the torque error of a fast gait exceeds 1 %

class BulletPlant final : public Plant, private InverseMass {
 public:
  explicit BulletPlant(const PlantSettings& s)
      : settings_(s),
        robot_(*s.robot),
        plays_(joints_with_play(robot_)),
        rotors_beside_(rotors_beside(robot_, s.actuator, 0, 1)),
        layout_{robot_.joints.size(), 1, plays_.size()},
        body_(robot_, s.base, s.contacts),
        kinematics_(robot_),
        integrator_(s.integrator == kRk4 ? ExplicitIntegrator::rk4 : ExplicitIntegrator::semi_implicit, robot_.joints.size(),
                    plays_.size()),
        monitor_(robot_, rotors_beside_) {
    const std::size_t n = robot_.joints.size();
    state_.q.resize(n);
    state_.qd.resize(n);
    acceleration_.joints.resize(n);
    acceleration_.rotors.resize(plays_.size());
    motor_speed_.resize(n);
    torque_.resize(n);
    slope_.resize(n);
    applied_.resize(n);
    at_rest_.resize(n);
    start_speed_.resize(n);
    start_angle_.resize(n);
    since_.resize(n);
    grip_.resize(n);
    for (std::size_t j = 0; j < n; ++j) {
      if (!robot_.joints[j].driven()) passive_.push_back(j);
    }
    monitor_.contacts.reserve(s.contacts.size());
    if (has_rotors(s.actuator)) rotors_.emplace(robot_, s.base, s.actuator->reflected_inertia());
  }

  void bind(Out numbers, Out) override { numbers_ = numbers; }

  void advance(In command, double h) override {
    layout_.read(numbers_, 0, state_);
    take_motor_speeds(state_);
    start_speed_ = motor_speed_;
    start_angle_ = state_.q;
    std::fill(applied_.begin(), applied_.end(), 0.0);
    work_ = {};
    for (std::size_t j = 0; j < grip_.size(); ++j) grip_[j] = HingeHold::grip(since_[j] + h / 2);
    integrator_.step(state_, h, [&](const RobotState& state, double weight, Acceleration& out) {
      evaluate(state, command);
      for (std::size_t j = 0; j < torque_.size(); ++j) {
        applied_[j] += weight * torque_[j];
        const double stop = stop_at(state, j);
        work_[2] -= weight * h * stop * state.qd[j];
        body_.add_torque(j, (robot_.joints[j].play.any() ? 0 : torque_[j]) + stop);
      }
      turn_rotors(state, weight * h, out);
      for (const std::size_t j : passive_) {
        const PassiveHinge hinge = law(*robot_.joints[j].passive);
        const double lost = hinge.loss(state.qd[j]).torque;
        work_[3] -= weight * h * lost * state.qd[j];
        body_.add_torque(j, hinge.spring(state.q[j]) + lost);
      }
      work_[0] += weight * h * power_[0];
      work_[1] += weight * h * power_[1];
      accelerate(state, out);
    });
    layout_.write(state_, 0, numbers_);
    part_.set(applied_, start_speed_, start_angle_, h);
  }

  [[nodiscard]] StepEffort applied() const override { return part_.applied(work_); }

  void accelerate(std::size_t, const RobotState& state, In torque, std::span<const BodyWrench> wrenches,
                  Acceleration& out) override {
    kinematics_.update(robot_, state);
    body_.load(state, kinematics_, settings_.gravity, torque, wrenches);
    accelerate(state, out);
  }

  void contacts(std::size_t, std::span<ContactSample> out) const override {
    layout_.read(numbers_, 0, state_);
    kinematics_.update(robot_, state_);
    for (ContactSample& sample : out) sample = {};
    for_each_contact([&](const Contact& c) { out[c.element] = {c.world(), c.force.fn, c.touch.penetration, c.touch.point}; });
  }

  void change_joints(In hold, In since) override {
    std::ranges::copy(hold, monitor_.hold.begin());
    std::ranges::copy(since, since_.begin());
  }

  [[nodiscard]] Stability stability(std::size_t, In command, bool standing) override {
    layout_.read(numbers_, 0, state_);
    evaluate(state_, command);
    accelerate(state_, acceleration_);  // factorises the mass matrix for apply()
    if (standing) ask(at_rest_, at_rest_);
    std::copy(slope_.begin(), slope_.end(), monitor_.motor.begin());
    return monitor_.rule(settings_, settings_.base, kinematics_, state_, standing, settings_.step, *this, [&] {
      for_each_contact([&](const Contact& c) {
        monitor_.contacts.push_back({c.element, c.link, c.touch.point, c.touch.normal,
                                     c.force.sliding ? Vec3(c.vt / c.slip) : Vec3::Zero(), c.force.friction_slope,
                                     c.force.normal_slope});
      });
    });
  }

 private:
  void apply(In force, Out acceleration) override {
    if (rotors_) {
      rotors_->inverse_mass(force, acceleration);
    } else {
      body_.inverse_mass(force, acceleration);
    }
  }

  /// Computes accelerations under all forces added so far.
  void accelerate(const RobotState& state, Acceleration& out) {
    body_.accelerate(state, out);
    if (!rotors_) return;
    rotors_->update(kinematics_);
    rotors_->add_to(out);
  }

  /// Speeds of the motors of all joints.
  void take_motor_speeds(const RobotState& state) {
    motor_speed_ = state.qd;
    for (std::size_t k = 0; k < plays_.size(); ++k) motor_speed_[plays_[k]] = state.rotor_speed[k];
  }

  /// Accelerations of the motors of joints with play, the torques of their gears on the links, and the work on the gears in the
  /// time `weight`.
  void turn_rotors(const RobotState& state, double weight, Acceleration& out) {
    for (std::size_t k = 0; k < plays_.size(); ++k) {
      const std::size_t j = plays_[k];
      const double speed = state.rotor_speed[k] - state.qd[j];
      const double on_motor = law(robot_.joints[j].play).at(state.rotor[k] - state.q[j], speed).torque;
      out.rotors[k] = (torque_[j] + on_motor) / rotors_beside_[k];
      work_[2] -= weight * on_motor * speed;
      body_.add_torque(j, -on_motor);
    }
  }

  /// Torque of a stop or of a stuck hinge.
  [[nodiscard]] double stop_at(const RobotState& state, std::size_t j) const {
    const double hold = monitor_.hold[j];
    if (!std::isnan(hold)) return HingeHold::torque(state.q[j], state.qd[j], hold, grip_[j]);
    return HingeStop::at(state.q[j], state.qd[j], robot_.joints[j].lo, robot_.joints[j].hi).torque;
  }

  /// Geometry and velocities of one element in contact.
  struct Contact {
    std::size_t element, link;
    Ground::Touch touch;
    double vn;    ///< normal velocity, positive when separating, m/s
    Vec3 vt;      ///< tangential velocity, m/s
    double slip;  ///< |vt|
    PenaltyContact::Force force;
    [[nodiscard]] Vec3 world() const { return force.fn * touch.normal - force.friction_slope * vt; }
  };

  /// Visits the contacts at the present kinematics.
  template <class Visit>
  void for_each_contact(Visit&& visit) const {
    if (!settings_.ground.exists()) return;
    body_.for_each_element(kinematics_, [&](std::size_t element, std::size_t link, const Vec3& centre, double radius) {
      const Ground::Touch touch = settings_.ground.query(centre, radius);
      if (!(touch.penetration > 0)) return;
      const Vec3 v = kinematics_.velocity(link, touch.point);
      const double vn = touch.normal.dot(v);
      const Vec3 vt = v - vn * touch.normal;
      const double slip = vt.norm();
      visit(Contact{element, link, touch, vn, vt, slip,
                    settings_.law(touch.penetration, vn, slip, settings_.contacts[element].friction * touch.friction)});
    });
  }

  /// Evaluates actuator and friction.
  void ask(In command, In speed) {
    if (settings_.actuator == nullptr) return;
    settings_.actuator->effort(command, speed, torque_, slope_);
    add_creeping(settings_.actuator->friction(), speed, torque_, slope_);
  }

  /// Sets the state of the body, adds weight and contact forces, and evaluates the actuator. Joint torques are not added.
  void evaluate(const RobotState& state, In command) {
    kinematics_.update(robot_, state);
    body_.set(state, kinematics_);
    body_.add_weight(settings_.gravity);
    power_ = {};
    for_each_contact([&](const Contact& c) {
      power_[0] -= c.force.fn * c.vn;
      power_[1] += c.force.friction_slope * c.slip * c.slip;
      body_.add_force(c.link, c.touch.point - kinematics_.point(c.link, robot_.links[c.link].com), c.world());
    });
    take_motor_speeds(state);
    ask(command, motor_speed_);
  }

  PlantSettings settings_;
  const Robot& robot_;
  std::vector<std::size_t> plays_;     ///< joints with play
  std::vector<double> rotors_beside_;  ///< reflected inertias of their motors, kg m^2
  StateLayout layout_;
  Out numbers_;
  bullet::MultiBody body_;
  mutable Kinematics kinematics_;  // these two are caches, which every public function refills from numbers_
  mutable RobotState state_;
  std::optional<RotorInertia> rotors_;  ///< needed because the algorithm of Bullet has no rotor inertia
  ExplicitIntegrator integrator_;
  Acceleration acceleration_;
  std::vector<double> torque_, slope_, applied_, at_rest_, start_speed_, start_angle_, motor_speed_;
  std::vector<double> since_, grip_;  ///< by joint: s, time stuck at the start of the step; grip in the middle of the step
  OnePart part_;
  std::array<double, 2> power_ = {};  ///< power given to the ground along its normal and along its surface, W
  std::array<double, 4> work_ = {};   ///< works of the last step, J: contact, friction, stops, hinges
  std::vector<std::size_t> passive_;  ///< joints without a motor
  RateMonitor monitor_;
};

bool is_explicit(const std::string& integrator) { return integrator == "semi_implicit" || integrator == kRk4; }

/// Throws TooManyJoints. Bullet allocates a number for every pair of joints (btMultiBody::finalizeMultiDof) and counts the
/// pairs in an int. Rotors need three more matrices, and a Cholesky factor at every step.
void check_joints(const PlantSettings& s) {
  constexpr std::size_t kMost = 10000;           // needs 0.8 GB
  constexpr std::size_t kMostWithRotors = 2000;  // a step takes a second, and this time grows with the third power
  const std::size_t joints = s.robot->joints.size();
  if (joints > kMost) {
    throw TooManyJoints(
        fmt::format("engine bullet keeps a number for every pair of joints, {:.3g} GB for the {} joints here, and "
                    "takes at most {} joints; use engine: articulated, whose memory grows with the number of joints",
                    8e-9 * static_cast<double>(joints) * static_cast<double>(joints), joints, kMost));
  }
  if (joints > kMostWithRotors && has_rotors(s.actuator) && is_explicit(s.integrator)) {
    throw TooManyJoints(
        fmt::format("engine bullet with an explicit integrator solves for all {} joints at once in every step, because "
                    "actuator.rotor_inertia is not 0, and takes at most {} joints then; use integrator: adaptive, whose "
                    "time grows with the number of joints",
                    joints, kMostWithRotors));
  }
}

/// The first integrator is the default, and semi_implicit that for a given step.
std::vector<Integrator> integrators() {
  const std::vector<Integrator> implicit = implicit_integrators();
  std::vector<Integrator> all{implicit.front(), {"semi_implicit", 1, false, true}, {kRk4, 4, false, true}};
  all.insert(all.end(), implicit.begin() + 1, implicit.end());
  return all;
}

/// Allocates memory for Bullet, which does not check the result of malloc.
void* allocate(std::size_t size) {
  void* block = std::malloc(size);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

}  // namespace

void register_bullet(Catalog& catalog) {
  btAlignedAllocSetCustom(allocate, std::free);
  catalog.add(Engine{
      "bullet",
      "One btMultiBody, Bullet's articulated-body algorithm, penalty contacts.\n\n"
      "Contacts act on the points and spheres of the compound shapes of the multibody. Integrators:\n\n"
      "    adaptive       takes the accelerations under weight, centrifugal and gyroscopic forces from Bullet, and is implicit "
      "in\n"
      "                   motors, stops and contacts, with the steps of engine articulated, by physics.accuracy. The default, "
      "with\n"
      "                   step: auto.\n"
      "    semi_implicit  order 1, explicit: Bullet alone. The default where a step is given. Every step must be at most\n"
      "                   1 / lambda (lambda: largest eigenvalue of M^-1 (B + sum J^T G J), checked at the start and watched\n"
      "                   at every control tick). step: auto is the longest up to 5e-5 s that divides the periods and is at\n"
      "                   most 0.8 / lambda at the start, 0.45 / lambda where contacts set it: a gait that stands on half of\n"
      "                   its feet doubles their friction.\n"
      "    rk4            order 4, explicit, with the same limit.\n"
      "    implicit, extrapolated  order 1 and 2, as adaptive with steps as given.\n\n"
      "contact.law: bullet takes Bullet's own collision world and constraint solver instead, for comparison and clutter: "
      "boxes\n"
      "that move, blocks that touch boxes and one another. Motors, stops and contacts are rows of one solve, stable at 1 ms,\n"
      "which is its default step. Its torques do not converge with the step (docs/equations.md, 7, has the table): take the\n"
      "penalty law for torques. It has no snapshots, goldens, reaction columns, rotor inertia and heightfield.\n\n"
      "    contact: {law: bullet, on: all}\n"
      "    ground: {type: boxes, boxes: [{center: [0.5, 0, 0.05], size: [0.1, 0.1, 0.1], mass: 0.2}]}",
      integrators(),
      kImplicitStep,
      {1},
      true,
      [](const PlantSettings& s) -> std::unique_ptr<Plant> {
        check_joints(s);
        if (s.contact == ContactLaw::solver) return make_solver_plant(s);
        if (!is_explicit(s.integrator)) return make_implicit_plant(s, make_bullet_dynamics(s));
        return std::make_unique<BulletPlant>(s);
      },
      1e-3,
      [](const Scenario& s) { return stable_step(s, kLongestBulletStep); },
      kLongestBulletStep});
}

std::string bullet_version() {
  static_assert(sizeof(btScalar) == sizeof(double), "gaitlab needs Bullet in double precision");
  return std::to_string(btGetVersion() / 100) + "." + std::to_string(btGetVersion() % 100) + " float64";
}

}  // namespace gaitlab
