#include "physics_articulated/engine.h"

#include <algorithm>
#include <array>
#include <memory>

#include "core/simulation/plant.h"
#include "physics_articulated/eigen.h"
#include "physics_articulated/lane_model.h"

namespace gaitlab {

namespace {

using articulated::ContactForce;
using articulated::Kernel;
using articulated::KernelSettings;
using articulated::LaneConstants;
using articulated::LaneModel;
using articulated::vec3;

/// Kernels by number of rollouts side by side.
struct Width {
  std::size_t lanes;
  std::unique_ptr<Kernel> (*make)(const KernelSettings&);
  bool (*runs)();  ///< true if this processor can run the kernel
};
const std::array kWidths{
    Width{1, articulated::make_kernel_1, [] { return true; }},
    Width{4, articulated::make_kernel_4, [] { return __builtin_cpu_supports("avx2") != 0; }},
    Width{8, articulated::make_kernel_8, [] { return __builtin_cpu_supports("avx512f") != 0; }},
};

std::vector<std::size_t> widths() {
  std::vector<std::size_t> all;
  for (const Width& width : kWidths) {
    if (width.runs()) all.push_back(width.lanes);
  }
  return all;
}

/// Integrators of the engine; the first is the default.
struct Offer {
  articulated::StepMethod method;
  const char* name;
  int order;  ///< 0 for an integrator that divides its steps
};
constexpr std::array kOffers{
    Offer{articulated::StepMethod::adaptive, "adaptive", 0}, Offer{articulated::StepMethod::implicit, "implicit", 1},
    Offer{articulated::StepMethod::extrapolated, "extrapolated", 2}, Offer{articulated::StepMethod::rk4, "rk4", 4}};

std::vector<Integrator> integrators() {
  std::vector<Integrator> all;
  for (const Offer& one : kOffers)
    all.push_back({one.name, one.order, one.order == 0, one.method == articulated::StepMethod::rk4});
  return all;
}

articulated::StepMethod method_of(const std::string& name) {
  const auto found = std::find_if(kOffers.begin(), kOffers.end(), [&](const Offer& one) { return one.name == name; });
  if (found != kOffers.end()) return found->method;
  if (!name.empty()) throw std::invalid_argument("engine articulated has no integrator '" + name + "'");
  return kOffers.front().method;
}

class ArticulatedPlant final : public Plant {
 public:
  ArticulatedPlant(const PlantSettings& s, std::unique_ptr<articulated::OtherDynamics> dynamics)
      : settings_(s),
        dynamics_(std::move(dynamics)),
        layout_{s.robot->joints.size(), 1 + s.others.size(), joints_with_play(*s.robot).size()},
        explicit_(method_of(s.integrator) == articulated::StepMethod::rk4),
        x_(StateLayout{layout_.joints, 1}.size()),
        state_{.q = std::vector<double>(layout_.joints),
               .qd = std::vector<double>(layout_.joints),
               .rotor = std::vector<double>(layout_.plays),
               .rotor_speed = std::vector<double>(layout_.plays)} {
    std::vector<LaneConstants> rollouts;
    for (std::size_t l = 0; l < layout_.lanes; ++l) {
      const LaneSettings& own = l == 0 ? settings_ : settings_.others[l - 1];
      rollouts.push_back(articulated::rollout(own, s.base));
      models_.push_back(std::make_unique<LaneModel>(settings_, own, l, layout_.lanes));
    }
    const auto width = std::find_if(kWidths.begin(), kWidths.end(), [&](const Width& w) { return w.lanes == layout_.lanes; });
    if (width == kWidths.end() || !width->runs()) {
      throw std::invalid_argument("no kernel for so many rollouts side by side on this processor");
    }
    KernelSettings settings{rollouts, s.actuator, method_of(s.integrator), articulated::query, dynamics_.get(), {}};
    if (layout_.lanes > 1) own_solos_ = articulated::make_solos(settings);
    for (const auto& solo : own_solos_) solos_.push_back({solo.get()});
    settings.solos = solos_;
    kernel_ = width->make(settings);
    history_ = kernel_->history().size() * layout_.lanes;
  }

  void bind(Out numbers, Out history) override {
    numbers_ = numbers;
    kept_ = history;
  }
  void advance(In command, double h) override { kernel_->step(numbers_, kept_, command, h); }
  bool state_within(std::size_t lane, std::size_t eighth, Out state) const override {
    return kernel_->state_within(lane, eighth, state);
  }
  void change_joints(In hold, In since) override {
    kernel_->change(hold, since);
    for (const auto& solo : own_solos_) solo->change(hold, since);
    for (const auto& model : models_) model->change(hold);
  }
  bool add_friction(In command, double within, Out torque) override {
    if (!explicit_) kernel_->add_friction(numbers_, command, within, torque);
    return !explicit_;
  }
  [[nodiscard]] bool holds_hinges() const override { return !explicit_; }
  void tally(std::size_t lane, StepTally& out) const override {
    if (explicit_) return;
    const articulated::History at = kernel_->history();
    const auto number = [&](std::size_t entry) { return kept_[entry * layout_.lanes + lane]; };
    out.solves = number(at.solves());
    out.off = number(at.off());
    out.coarse = number(at.coarse());
  }
  [[nodiscard]] StepEffort applied() const override { return kernel_->applied(); }

  void accelerate(std::size_t lane, const RobotState& state, In torque, std::span<const BodyWrench> wrenches,
                  Acceleration& out) override {
    if (dynamics_ != nullptr) return dynamics_->accelerate(state, torque, wrenches, out);
    StateLayout{layout_.joints, 1}.write(state, 0, x_);
    models_[lane]->accelerate(x_, state, torque, wrenches, out);
  }

  [[nodiscard]] MotorLaws* motor_laws() override { return kernel_.get(); }
  void update_contacts() override { kernel_->update_contacts(numbers_); }
  [[nodiscard]] std::optional<Vec3> com(std::size_t lane) const override { return vec3(kernel_->com(lane)); }

  void contacts(std::size_t lane, std::span<ContactSample> out) const override {
    for (ContactSample& sample : out) sample = {};
    for (const ContactForce& force : kernel_->contact_forces(lane)) {
      out[force.element] = {vec3(force.force), force.fn, force.touch.penetration, vec3(force.touch.point)};
    }
  }

  /// The stability rule applies to the explicit method. The other methods treat damping implicitly and have no limit.
  [[nodiscard]] Stability stability(std::size_t lane, In command, bool standing) override {
    if (!explicit_) return {};
    layout_.read(numbers_, lane, state_);
    StateLayout{layout_.joints, 1}.write(state_, 0, x_);
    return models_[lane]->stability(x_, state_, command, standing);
  }

 private:
  PlantSettings settings_;
  std::unique_ptr<articulated::OtherDynamics> dynamics_;
  StateLayout layout_;
  bool explicit_;
  Out numbers_, kept_;
  std::vector<std::unique_ptr<articulated::Solo>> own_solos_;
  std::vector<articulated::SoloOfLane> solos_;
  std::unique_ptr<Kernel> kernel_;
  std::vector<std::unique_ptr<LaneModel>> models_;
  std::vector<double> x_;
  RobotState state_;
};

}  // namespace

std::vector<Integrator> implicit_integrators() {
  std::vector<Integrator> all = integrators();
  std::erase_if(all, [](const Integrator& one) { return one.limited; });
  return all;
}

std::unique_ptr<Plant> make_implicit_plant(const PlantSettings& settings,
                                           std::unique_ptr<articulated::OtherDynamics> dynamics) {
  return std::make_unique<ArticulatedPlant>(settings, std::move(dynamics));
}

void register_articulated(Catalog& catalog) {
  catalog.add(Engine{
      "articulated",
      "Our own articulated-body recursion, implicit in motors, stops and contacts: long steps, no Bullet.\n\n"
      "    M (v+ - v) = h (weight - c + tau(v+) + sum J^T f(v+))        q+ = q (+) h v+\n\n"
      "tau: torques of motors and stops, f: forces of the ground, all by their laws at the velocity v+ of the "
      "step's end, which\n"
      "Newton's method with a line search finds for any h (docs/equations.md, 7). Integrators:\n\n"
      "    adaptive      steps of the control period, or of a whole part of it up to 5 ms, each divided until two\n"
      "                  methods agree to physics.accuracy (0.01: 1 % of the torques). The default, with step: auto.\n"
      "    implicit      order 1, steps as given by physics.step. The default where a step is given.\n"
      "    extrapolated  order 2, steps as given: two half steps and a whole one.\n"
      "    rk4           order 4, explicit; its step must be at most 1 / lambda (docs/equations.md, 7).\n\n"
      "The summary gives an estimate of the torque error of the steps.",
      integrators(), kImplicitStep, widths(), true,
      [](const PlantSettings& s) -> std::unique_ptr<Plant> { return std::make_unique<ArticulatedPlant>(s, nullptr); }, 0});
}

}  // namespace gaitlab
