// A module from MJCF against the file it was made from in MuJoCo: masses, inertias and the motion in the air.
#include <mujoco/mujoco.h>

#include <array>
#include <cstddef>
#include <memory>

#include "core/model/possible_inertia.h"
#include "interchange/robot_module.h"
#include "tests/interchange/from_urdf.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

using CompiledFile = std::unique_ptr<mjModel, decltype(&mj_deleteModel)>;

CompiledFile in_mujoco(const std::string& file) {
  std::array<char, 1000> error{};
  CompiledFile model(mj_loadXML(file.c_str(), nullptr, error.data(), error.size()), mj_deleteModel);
  if (model == nullptr) throw std::runtime_error(error.data());
  return model;
}

class MujocoImport : public ::testing::Test {
 protected:
  const std::string file_ = kImports + "two_hinges_in_a_body.xml";
  const interchange::RobotModule made_ = interchange::module_of_robot(file_, "robot");
  const CompiledFile model_ = in_mujoco(file_);
  Folder folder_;
};

TEST_F(MujocoImport, MassesAndInertias) {
  const ModuleType type = module_in(made_);
  double mass = 0;
  for (const BodyType& body : type.bodies) mass += body.mass;
  EXPECT_NEAR(mass, model_->body_subtreemass[0], 1e-9 * mass);
  for (const char* const name : {"trunk", "left", "tail"}) {  // bodies of one body of the file
    const std::ptrdiff_t b = mj_name2id(model_.get(), mjOBJ_BODY, name);
    const BodyType& body = body_of(type, name);
    EXPECT_NEAR(body.mass, model_->body_mass[b], 1e-12);
    const Vec3 moments(model_->body_inertia + 3 * b);
    const Vec3 ours = principal(Mat3(body.inertia.selfadjointView<Eigen::Upper>())).moments;
    Vec3 sorted = moments;
    std::ranges::sort(sorted);
    EXPECT_LT((ours - sorted).norm(), 1e-9 * sorted.norm()) << name;
  }
}

/// Springs, dampers, axes off the origin and the angle `ref` move the robot as in MuJoCo. Both integrate with RK4 in steps of
/// 0.1 ms, and agree to 4e-13; a wrong frame, spring or angle is off by more than the bound of 1e-6.
TEST_F(MujocoImport, MovesInTheAirAsInMujoco) {
  folder_.write("robot.yaml", made_.text);
  const Scenario s = read_scenario(
      folder_.write(
          "fall.yaml",
          "{gaitlab: 1, robot: {modules: ./robot.yaml}, actuator: {type: none}, contact: {on: none}, ground: {type: none}, "
          "physics: {engine: articulated, integrator: rk4, step: 1e-4}, duration: 0.3}"),
      {}, catalog());
  Simulation simulation({&s, 1});
  simulation.run();
  const Recording record = simulation.take_recording(0);
  const std::unique_ptr<mjData, decltype(&mj_deleteData)> data(mj_makeData(model_.get()), mj_deleteData);
  const double start = data->qpos[2];
  for (int step = 0; step < 3000; ++step) mj_step(model_.get(), data.get());
  for (const char* const name : {"roll", "pitch", "knee", "wag"}) {
    const int j = mj_name2id(model_.get(), mjOBJ_JOINT, name);
    const int at = model_->jnt_qposadr[j];
    const double theirs = data->qpos[at] - model_->qpos0[at];
    EXPECT_GT(std::abs(theirs), 0.01) << name << " moves";
    const auto joint = std::ranges::find(s.robot->joints, std::string("m0/") + name, &Joint::name) - s.robot->joints.begin();
    EXPECT_NEAR(end(record, fmt::format("joint.{}.angle", joint)), theirs, 1e-6) << name;
  }
  EXPECT_NEAR(end(record, "base.z") - Table(record.trace).at(0, "base.z"), data->qpos[2] - start, 1e-6);
  EXPECT_NEAR(end(record, "base.x") - Table(record.trace).at(0, "base.x"), data->qpos[0], 1e-6);
}

}  // namespace
}  // namespace gaitlab::test
