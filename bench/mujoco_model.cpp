#include "bench/mujoco_model.h"

#include <fmt/format.h>
#include <stdlib.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>

#include "core/errors.h"
#include "core/files/atomic_file.h"

namespace gaitlab {

MujocoModel load_mjcf(const std::string& mjcf) {
  // MuJoCo reads models from files, so a temporary file is written.
  std::string path = std::filesystem::temp_directory_path() / "gaitlab-XXXXXX.xml";
  const int file = mkstemps(path.data(), 4);
  if (file < 0) throw RunError(path + ": cannot be made");
  close(file);
  std::array<char, 1000> error{};
  try {
    write_file(path, mjcf);
    MujocoModel model(mj_loadXML(path.c_str(), nullptr, error.data(), error.size()));
    std::filesystem::remove(path);
    if (model == nullptr) throw RunError(fmt::format("MuJoCo does not take the model: {}", error.data()));
    return model;
  } catch (...) {
    std::filesystem::remove(path);
    throw;
  }
}

namespace versus {

namespace {

/// Sums of the torques of motors over rows.
class TorqueSums {
 public:
  explicit TorqueSums(std::size_t joints) : squares_(joints), driven_(joints) {
    walk_.rms.assign(joints, 0.0);
    walk_.peak.assign(joints, 0.0);
  }
  void add(std::size_t joint, double torque) {
    driven_[joint] = true;
    squares_[joint] += torque * torque;
    walk_.peak[joint] = std::max(walk_.peak[joint], std::abs(torque));
  }
  Walk walk(std::size_t rows, double travel, double height) {
    double sum = 0;
    double motors = 0;
    for (std::size_t j = 0; j < squares_.size(); ++j) {
      if (!driven_[j]) continue;
      const double mean = squares_[j] / static_cast<double>(rows);
      walk_.rms[j] = std::sqrt(mean);
      sum += mean;
      ++motors;
    }
    walk_.torque = std::sqrt(sum / motors);
    walk_.travel = travel;
    walk_.height = height;
    return walk_;
  }

 private:
  Walk walk_;
  std::vector<double> squares_;
  std::vector<bool> driven_;
};

double row_time(const Recording& record, std::size_t row) { return record.trace.at(row, 0); }

/// First row at `from` or later.
std::size_t first_row(const Recording& record, double from) {
  std::size_t row = 0;
  while (row + 1 < record.trace.rows() && row_time(record, row) < from - 1e-9) ++row;
  return row;
}

}  // namespace

Walk recorded_walk(const Recording& record, double from) {
  const Trace& trace = record.trace;
  const std::size_t first = first_row(record, from);
  const std::size_t last = trace.rows() - 1;
  TorqueSums sums(record.joints.size());
  for (std::size_t j = 0; j < record.joints.size(); ++j) {
    const auto torque = record.joint(j, "torque");
    if (torque.empty()) continue;
    for (std::size_t row = first; row <= last; ++row) sums.add(j, torque[row]);
  }
  const auto com = [&](std::size_t row, const char* axis) { return trace.at(row, trace.find(axis)); };
  return sums.walk(last - first + 1, std::hypot(com(last, "com.x") - com(first, "com.x"), com(last, "com.y") - com(first, "com.y")),
                   com(last, "com.z"));
}

Walk walk_in_mujoco(const std::string& mjcf, const Robot& robot, const Recording& record, double from) {
  const MujocoModel model = load_mjcf(mjcf);
  const MujocoData data(mj_makeData(model.get()));
  mj_resetDataKeyframe(model.get(), data.get(), 0);
  mj_forward(model.get(), data.get());
  std::vector<std::size_t> joint(static_cast<std::size_t>(model->nu));  // of each actuator
  std::vector<Series> set_points;
  for (int a = 0; a < model->nu; ++a) {
    const std::string name = mj_id2name(model.get(), mjOBJ_ACTUATOR, a);
    std::size_t j = 0;
    while (j < robot.joints.size() && robot.joints[j].name != name) ++j;
    joint[static_cast<std::size_t>(a)] = j;
    set_points.emplace_back(record.joint(j, "setpoint"));
  }
  const std::size_t first = first_row(record, from);
  const std::size_t last = record.trace.rows() - 1;
  TorqueSums sums(robot.joints.size());
  const auto com = [&] { return Vec3(data->subtree_com[0], data->subtree_com[1], data->subtree_com[2]); };
  Vec3 start = Vec3::Zero();
  std::size_t row = 0;
  for (std::int64_t step = 0;; ++step) {
    if (static_cast<double>(step) * model->opt.timestep > row_time(record, row) - 1e-9) {
      if (row == first) start = com();
      for (std::size_t a = 0; row >= first && a < joint.size(); ++a) sums.add(joint[a], data->actuator_force[a]);
      if (row == last) break;
      ++row;
      for (std::size_t a = 0; a < joint.size(); ++a) data->ctrl[a] = set_points[a][row];
    }
    mj_step(model.get(), data.get());
  }
  for (int w = 0; w < mjNWARNING; ++w) {
    if (data->warning[w].number > 0) throw RunError(fmt::format("MuJoCo warns: {}", mju_warningText(w, 0)));
  }
  const Vec3 moved = com() - start;
  return sums.walk(last - first + 1, std::hypot(moved.x(), moved.y()), com().z());
}

}  // namespace versus
}  // namespace gaitlab
