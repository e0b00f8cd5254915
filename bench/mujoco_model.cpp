#include "bench/mujoco_model.h"

#include <fmt/format.h>
#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
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

constexpr double kSlack = 1e-9;  // s; more than the rounding error of a sum of steps

double row_time(const Recording& record, std::size_t row) { return record.trace.at(row, 0); }

/// First row at `from` or later.
std::size_t first_row(const Recording& record, double from) {
  std::size_t row = 0;
  while (row + 1 < record.trace.rows() && row_time(record, row) < from - kSlack) ++row;
  return row;
}

/// Set points of a run by time. A row is recorded before the tick at its time, so that the set points of tick k are those of
/// the first row after it.
class SetPoints {
 public:
  SetPoints(const Recording& record, double period) : record_(record), period_(period) {
    std::size_t row = 0;
    for (std::int64_t k = 0;; ++k) {
      while (row < record.trace.rows() && row_time(record, row) < static_cast<double>(k) * period + kSlack) ++row;
      if (row == record.trace.rows()) break;
      rows_.push_back(row);
    }
  }
  [[nodiscard]] double at(double t, std::size_t joint, BetweenTicks between) const {
    const Series recorded = record_.joint(joint, "setpoint");
    const auto tick = std::min(static_cast<std::size_t>((t + kSlack) / period_), rows_.size() - 1);
    const double now = recorded[rows_[tick]];
    if (between == BetweenTicks::held || tick + 1 == rows_.size()) return now;
    return now + (recorded[rows_[tick + 1]] - now) * (t / period_ - static_cast<double>(tick));
  }

 private:
  const Recording& record_;
  double period_;
  std::vector<std::size_t> rows_;  ///< row of each tick
};

/// Joint of each actuator, by its name.
std::vector<std::size_t> joints_of_actuators(const mjModel& model, const Robot& robot) {
  std::vector<std::size_t> out;
  for (int a = 0; a < model.nu; ++a) {
    const auto at = std::ranges::find(robot.joints, mj_id2name(&model, mjOBJ_ACTUATOR, a), &Joint::name);
    out.push_back(static_cast<std::size_t>(at - robot.joints.begin()));
  }
  return out;
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
  return sums.walk(last - first + 1,
                   std::hypot(com(last, "com.x") - com(first, "com.x"), com(last, "com.y") - com(first, "com.y")),
                   com(last, "com.z"));
}

Walk walk_in_mujoco(const std::string& mjcf, const Scenario& s, const Recording& record, double from, BetweenTicks between) {
  const MujocoModel model = load_mjcf(mjcf);
  const MujocoData data(mj_makeData(model.get()));
  mj_resetDataKeyframe(model.get(), data.get(), 0);
  mj_forward(model.get(), data.get());
  const std::vector<std::size_t> joint = joints_of_actuators(*model, *s.robot);
  const SetPoints set_points(record, s.control_period);
  const std::size_t first = first_row(record, from);
  const std::size_t last = record.trace.rows() - 1;
  TorqueSums sums(s.robot->joints.size());
  const auto com = [&] { return Vec3(data->subtree_com[0], data->subtree_com[1], data->subtree_com[2]); };
  Vec3 start = Vec3::Zero();
  std::size_t row = 0;
  for (std::int64_t step = 0;; ++step) {
    const double t = static_cast<double>(step) * model->opt.timestep;
    if (t > row_time(record, row) - kSlack) {
      if (row == first) start = com();
      for (std::size_t a = 0; row >= first && a < joint.size(); ++a) sums.add(joint[a], data->actuator_force[a]);
      if (row == last) break;
      ++row;
    }
    for (std::size_t a = 0; a < joint.size(); ++a) data->ctrl[a] = set_points.at(t, joint[a], between);
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
