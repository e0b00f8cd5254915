#include "interchange/motion.h"

#include <fmt/format.h>

#include <cmath>

#include "core/errors.h"
#include "core/simulation/start.h"

namespace gaitlab::interchange {

namespace {

Way fixed(const Pose& pose) { return {{pose.p}, {Quat(pose.R).normalized()}}; }

std::vector<Way> fixed_boxes(const Ground& ground) {
  std::vector<Way> ways;
  for (const Box& box : ground.boxes()) ways.push_back(fixed({box.R, box.center}));
  return ways;
}

std::string box_name(std::size_t number) { return fmt::format("box.{}.", number); }

/// Rows of a recording that become frames of an animation.
class Frames {
 public:
  Frames(const Scenario& scenario, const Recording& recording, double rate) : scenario_(scenario), recording_(recording) {
    const double least = (1 - 1e-9) / rate;  // accepts rows that are 1/rate apart except for rounding
    const std::vector<double> t = recording.series("t").values();
    for (std::size_t row = 0; row < t.size(); ++row) {
      const bool last = row + 1 == t.size();
      if (!rows_.empty() && !last && t[row] - t[rows_.back()] < least) continue;
      const auto time = static_cast<float>(t[row]);
      // Equal float32 times are possible after days of simulated time.
      if (!times_.empty() && !(time > times_.back())) continue;
      rows_.push_back(row);
      times_.push_back(time);
    }
  }

  [[nodiscard]] const std::vector<float>& times() const { return times_; }

  [[nodiscard]] std::vector<double> column(const std::string& name) const {
    const Series series = recording_.series(name);
    std::vector<double> values;
    for (const std::size_t row : rows_) {
      if (!std::isfinite(series[row])) {
        throw InputError(SourceLocation{scenario_.file}, fmt::format("column {} of its recording is {} at t = {} s", name,
                                                                     series[row], recording_.series("t")[row]));
      }
      values.push_back(series[row]);
    }
    return values;
  }

  [[nodiscard]] Way way(const std::string& name) const {
    std::vector<std::vector<double>> parts;
    for (const char* part : {"x", "y", "z", "qw", "qx", "qy", "qz"}) parts.push_back(column(name + part));
    Way made;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      made.places.emplace_back(parts[0][k], parts[1][k], parts[2][k]);
      Quat q(parts[3][k], parts[4][k], parts[5][k], parts[6][k]);
      q.normalize();
      if (k > 0 && q.dot(made.turns.back()) < 0) q.coeffs() *= -1;
      made.turns.push_back(q);
    }
    return made;
  }

 private:
  const Scenario& scenario_;
  const Recording& recording_;
  std::vector<std::size_t> rows_;
  std::vector<float> times_;
};

}  // namespace

RobotState RobotMotion::state(std::size_t frame) const {
  RobotState s;
  s.position = base.places[frame];
  s.orientation = base.turns[frame];
  for (const std::vector<double>& angle : angles) s.q.push_back(angle[frame]);
  s.qd.assign(angles.size(), 0.0);
  return s;
}

RobotMotion standing(const Scenario& scenario) {
  const RobotState start = start_state(scenario);
  RobotMotion made{{0}, {{start.position}, {start.orientation.normalized()}}, {}, fixed_boxes(scenario.ground)};
  for (const double angle : start.q) made.angles.push_back({angle});
  return made;
}

RobotMotion motion(const Scenario& scenario, const Recording& recording, double rate) {
  const Frames frames(scenario, recording, rate);
  RobotMotion made{frames.times(), frames.way("base."), {}, fixed_boxes(scenario.ground)};
  for (std::size_t j = 0; j < scenario.robot->joints.size(); ++j)
    made.angles.push_back(frames.column(fmt::format("joint.{}.angle", j)));
  for (std::size_t b = 0; b < made.boxes.size(); ++b) {
    if (has_way(recording, b)) made.boxes[b] = frames.way(box_name(b));
  }
  return made;
}

bool has_way(const Recording& recording, std::size_t number) {
  for (const char* part : {"x", "y", "z", "qw", "qx", "qy", "qz"}) {
    if (recording.series(box_name(number) + part).empty()) return false;
  }
  return true;
}

}  // namespace gaitlab::interchange
