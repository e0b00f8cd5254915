#include "bench/mujoco_plant.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>

#include "bench/mujoco_model.h"
#include "core/files/atomic_file.h"
#include "core/laws/dc_motor.h"
#include "core/simulation/plant.h"
#include "interchange/mjcf.h"

namespace gaitlab {

namespace {

constexpr double kPointRadius = 1e-6;  // m; MuJoCo does not have points
// Contact parameters of set-up armature: the time constant of solref, s; the share of the force at the start of a contact
// (solimp); the depth at which the full force is reached, m. MuJoCo's defaults are 0.02, 0.9 and 0.001. The torques converge
// slowly with the defaults for any setting of the solver: the error of the hexapod at 1.25 ms is 4 %, but 0.9 % with the values
// here. The values are chosen among those with about the penetration of gaitlab's contact law.
constexpr double kTime = 0.01, kOnset = 0.001, kDepth = 0.002;

// Iterations of the solver in set-up armature. Newton's method starts from the solution of the last step, so that three are
// sufficient (default: 100, or until the tolerance is reached).
constexpr int kIterations = 3;

/// Part of the scenario that is exported: without shapes, and without motors, which are applied as forces on the joints.
Scenario bare(const PlantSettings& s) {
  Scenario scenario;
  scenario.name = "versus";
  auto robot = std::make_shared<Robot>(*s.robot);
  for (ModuleType& type : robot->types) {
    for (BodyType& body : type.bodies) body.shapes.clear();
  }
  scenario.robot = robot;
  scenario.base = s.base;
  scenario.physics.gravity = s.gravity;
  scenario.physics.step = 1e-3;  // replaced in advance()
  scenario.ground = s.ground;
  scenario.on_ground = false;
  const ContactSet all =
      s.contacts.size() == contact_elements(*robot, ContactSet::feet).size() ? ContactSet::feet : ContactSet::all;
  scenario.contact.on = s.contacts.empty() ? ContactSet::none : all;
  return scenario;
}

/// The exported MJCF without sites and with docked bodies fused, as a user who needs speed would write it.
std::string lean(const std::string& mjcf) {
  std::string out;
  for (std::size_t at = 0; at < mjcf.size();) {
    const std::size_t end = std::min(mjcf.find('\n', at), mjcf.size() - 1) + 1;
    std::string line = mjcf.substr(at, end - at);
    const std::size_t compiler = line.find("<compiler");
    if (compiler != std::string::npos) line.insert(compiler + 9, " fusestatic=\"true\"");
    if (line.find("<site ") == std::string::npos) out += line;
    at = end;
  }
  return out;
}

/// MJCF of MuJoCo's DC motors, one per joint, in the order of the joints. MuJoCo's motor has one constant K for torque and
/// back-EMF, and no efficiency: T = n K (u - K n w) / R', |T| <= n T_max.
/// It equals gaitlab's motor, T = eta Kt n (u - Ks n w) / R with |T| <= eta Kt n i_max, for K = Ks, R' = R Ks / (eta Kt) and
/// T_max = eta Kt i_max.
std::string dc_motors(const PlantSettings& s) {
  const DcMotor* motor = s.actuator == nullptr ? nullptr : s.actuator->dc_motors();
  const std::size_t joints = s.robot->joints.size();
  if (motor == nullptr || std::any_of(motor, motor + joints, [](const DcMotor& m) { return m.load < 1; })) {
    throw RunError("set-up dcmotor of the benchmarks needs actuator dc_motor with efficiency_model: paper");
  }
  std::string out = "<actuator>\n";
  for (std::size_t j = 0; j < joints; ++j, ++motor) {
    const double kt = motor->efficiency * motor->Kt;
    out += fmt::format(R"(<dcmotor joint="{}" gear="{}" motorconst="{}" resistance="{}" saturation="{}" )",
                       s.robot->joints[j].name, motor->gear, motor->Ks, motor->R * motor->Ks / kt, kt * motor->i_max);
    out += fmt::format("ctrllimited=\"true\" ctrlrange=\"{} {}\"/>\n", -motor->u_max, motor->u_max);
  }
  return out + "</actuator>\n";
}

enum class SetUp { armature, euler, implicit, implicitfast, dcmotor };

const std::map<std::string, SetUp> kSetUps{{"armature", SetUp::armature},
                                           {"euler", SetUp::euler},
                                           {"implicit", SetUp::implicit},
                                           {"implicitfast", SetUp::implicitfast},
                                           {"dcmotor", SetUp::dcmotor}};

SetUp set_up(const std::string& name) { return name.empty() ? SetUp::armature : kSetUps.at(name); }

class MujocoPlant final : public Plant {
 public:
  explicit MujocoPlant(const PlantSettings& s)
      : settings_(s),
        set_up_(set_up(s.integrator)),
        joints_(s.robot->joints.size()),
        layout_{joints_, 1},
        model_(make_model(s)),
        data_(mj_makeData(model_.get())),
        dof_(joints_),
        q_(joints_),
        slope_(joints_),
        torque_(joints_),
        speed_(joints_),
        zero_(joints_) {
    mjModel& m = *model_;
    for (std::size_t j = 0; j < joints_; ++j) {
      const int id = mj_name2id(&m, mjOBJ_JOINT, s.robot->joints[j].name.c_str());
      dof_[j] = m.jnt_dofadr[id];
      q_[j] = m.jnt_qposadr[id];
    }
    touch_with_contacts();
    m.opt.integrator = integrator();
    if (set_up_ == SetUp::armature) set_fast_options();
    if (s.actuator == nullptr) return;
    const In rotor = s.actuator->reflected_inertia();
    s.actuator->effort(zero_, zero_, torque_, slope_);
    for (std::size_t j = 0; j < joints_; ++j) {
      if (!rotor.empty()) m.dof_armature[dof_[j]] = rotor[j];
      if (set_up_ != SetUp::armature && set_up_ != SetUp::dcmotor) m.dof_damping[dof_[j]] = slope_[j];
    }
  }

  void bind(Out numbers, Out) override { numbers_ = numbers; }

  void advance(In command, double h) override {
    read();
    model_->opt.timestep = h;
    std::copy_n(numbers_.begin() + static_cast<std::ptrdiff_t>(layout_.speeds()), joints_, speed_.begin());
    if (settings_.actuator != nullptr) drive(command, h);
    mj_step(model_.get(), data_.get());
    if (set_up_ == SetUp::dcmotor) {
      for (std::size_t j = 0; j < joints_; ++j) torque_[j] = data_->qfrc_actuator[dof_[j]];
    }
    write();
    part_.set(torque_, speed_, In(numbers_).subspan(layout_.angles(), joints_), h);
    // MuJoCo restarts a simulation that it considers diverged. The run must not continue from the restart.
    for (const int bad : {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC}) {
      if (data_->warning[bad].number > 0) numbers_[0] = std::numeric_limits<double>::quiet_NaN();
    }
  }

  [[nodiscard]] StepEffort applied() const override { return part_.applied(works_); }

  void accelerate(std::size_t, const RobotState&, In, std::span<const BodyWrench>, Acceleration&) override {
    throw RunError("engine mujoco of the benchmarks gives no accelerations: leave out the columns reaction.*");
  }

  void contacts(std::size_t, std::span<ContactSample> out) const override {
    for (ContactSample& sample : out) sample = {};
    for (int c = 0; c < data_->ncon; ++c) {
      const mjContact& contact = data_->contact[c];
      if (contact.efc_address < 0) continue;
      std::array<mjtNum, 6> force{};
      mj_contactForce(model_.get(), data_.get(), c, force.data());
      ContactSample& sample = out[element_[static_cast<std::size_t>(contact.geom2)]];
      sample.fn = force[0];
      sample.penetration = -contact.dist;
      sample.point = Vec3(contact.pos[0], contact.pos[1], contact.pos[2]);
      sample.force =
          Eigen::Map<const Mat3>(contact.frame) * Vec3(force[0], force[1], force[2]);  // the rows of contact.frame are the axes
    }
  }

 private:
  static MujocoModel make_model(const PlantSettings& s) {
    if (s.base != Base::floating) throw RunError("engine mujoco of the benchmarks has floating bases only");
    std::string mjcf = lean(interchange::to_mjcf(bare(s), interchange::MjcfModel::strict));
    if (set_up(s.integrator) == SetUp::dcmotor) mjcf.insert(mjcf.rfind("</mujoco>"), dc_motors(s));
    return load_mjcf(mjcf);
  }

  [[nodiscard]] int integrator() const {
    if (set_up_ == SetUp::implicit) return mjINT_IMPLICIT;
#if mjVERSION_HEADER >= 300
    if (set_up_ == SetUp::implicitfast || set_up_ == SetUp::dcmotor) return mjINT_IMPLICITFAST;
#endif
    return mjINT_EULER;
  }

  /// Sets options that save time. Searching for islands is disabled, because a single robot is one island.
  void set_fast_options() {
    model_->opt.iterations = kIterations;
#if mjVERSION_HEADER >= 336
    model_->opt.disableflags |= mjDSBL_ISLAND;
#endif
  }

  /// Enables contacts of the contact elements with the ground only; the exported geoms do not collide. MuJoCo 3 first compares
  /// masks of the bodies, which it computed from the masks of their geoms when it compiled the model.
  void touch_with_contacts() {
    mjModel& m = *model_;
    element_.assign(static_cast<std::size_t>(m.ngeom), 0);
    const int ground = mj_name2id(&m, mjOBJ_GEOM, "ground");
    if (ground < 0) return;
    m.geom_conaffinity[ground] = 1;
#if mjVERSION_HEADER >= 300
    m.body_conaffinity[m.geom_bodyid[ground]] = 1;
#endif
    for (std::size_t e = 0; e < settings_.contacts.size(); ++e) {
      const ContactElement& element = settings_.contacts[e];
      const std::ptrdiff_t geom = mj_name2id(&m, mjOBJ_GEOM, element.name.c_str());
      element_[static_cast<std::size_t>(geom)] = e;
      m.geom_contype[geom] = 1;
#if mjVERSION_HEADER >= 300
      m.body_contype[m.geom_bodyid[geom]] = 1;
#endif
      if (!(element.radius > 0)) m.geom_size[3 * geom] = m.geom_rbound[geom] = kPointRadius;
    }
    for (std::ptrdiff_t g = 0; g < m.ngeom; ++g) {
      m.geom_friction[3 * g] = settings_.ground.friction;  // MuJoCo uses the larger friction of two geoms
      if (set_up_ != SetUp::armature) continue;
      m.geom_solref[mjNREF * g] = kTime;
      m.geom_solimp[mjNIMP * g] = kOnset;
      m.geom_solimp[mjNIMP * g + 2] = kDepth;
    }
  }

  void drive(In command, double h) {
    if (set_up_ == SetUp::dcmotor) {
      std::ranges::copy(command, data_->ctrl);
      return;
    }
    if (set_up_ == SetUp::armature) {
      settings_.actuator->effort(command, speed_, torque_, slope_);
      const In rotor = settings_.actuator->reflected_inertia();
      for (std::size_t j = 0; j < joints_; ++j) {
        model_->dof_armature[dof_[j]] = (rotor.empty() ? 0.0 : rotor[j]) + h * slope_[j];
      }
    } else {
      settings_.actuator->effort(command, zero_, torque_, slope_);
    }
    for (std::size_t j = 0; j < joints_; ++j) data_->qfrc_applied[dof_[j]] = torque_[j];
  }

  /// Copies the state into MuJoCo's. A free joint has position, quaternion, velocity in world axes, and angular velocity in
  /// body axes.
  void read() {
    std::copy_n(numbers_.begin(), 7, data_->qpos);
    std::copy_n(numbers_.begin() + StateLayout::kVelocity, 3, data_->qvel);
    const double* w = numbers_.data() + StateLayout::kAngularVelocity;
    std::array<mjtNum, 4> back{};
    mju_negQuat(back.data(), data_->qpos + 3);
    mju_rotVecQuat(data_->qvel + 3, w, back.data());
    for (std::size_t j = 0; j < joints_; ++j) {
      data_->qpos[q_[j]] = numbers_[layout_.angles() + j];
      data_->qvel[dof_[j]] = numbers_[layout_.speeds() + j];
    }
  }

  void write() {
    std::copy_n(data_->qpos, 7, numbers_.begin());
    std::copy_n(data_->qvel, 3, numbers_.begin() + StateLayout::kVelocity);
    mju_rotVecQuat(numbers_.data() + StateLayout::kAngularVelocity, data_->qvel + 3, data_->qpos + 3);
    for (std::size_t j = 0; j < joints_; ++j) {
      numbers_[layout_.angles() + j] = data_->qpos[q_[j]];
      numbers_[layout_.speeds() + j] = data_->qvel[dof_[j]];
    }
  }

  PlantSettings settings_;
  SetUp set_up_;
  std::size_t joints_;
  StateLayout layout_;
  Out numbers_;
  MujocoModel model_;
  MujocoData data_;
  std::vector<int> dof_, q_;          // index for each joint
  std::vector<std::size_t> element_;  // contact element of each geom
  std::vector<double> slope_, torque_, speed_, zero_;
  std::array<double, 4> works_ = {};
  OnePart part_;
};

}  // namespace

void register_mujoco(Catalog& catalog) {
  std::vector<Integrator> set_ups{{"armature"}, {"euler"}, {"implicit"}};
#if mjVERSION_HEADER >= 300
  set_ups.push_back({"implicitfast"});
#endif
#if mjVERSION_HEADER >= 3007000  // 3.7; until 3.4 the number was 340 and the like
  set_ups.push_back({"dcmotor"});
#endif
  catalog.add(Engine{
      "mujoco", "MuJoCo, for comparison.", set_ups, 1e-3, {1}, true, [](const PlantSettings& s) -> std::unique_ptr<Plant> {
        return std::make_unique<MujocoPlant>(s);
      }});
}

std::string compiler_of(const std::string& library) {
  for (const char* mark : {"clang version ", "GCC: ("}) {
    const std::size_t at = library.find(mark);
    if (at != std::string::npos) return std::string(library.c_str() + at).substr(0, 80);
  }
  return "unknown compiler";
}

std::string mujoco_version() {
  Dl_info library{};
  if (dladdr(reinterpret_cast<const void*>(&mj_versionString), &library) == 0) return mj_versionString();
  const std::string file = std::filesystem::weakly_canonical(library.dli_fname).filename();
  return fmt::format("{} ({}, {})", mj_versionString(), file, compiler_of(read_file(library.dli_fname, kMostPage)));
}

}  // namespace gaitlab
