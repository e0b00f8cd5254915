#include "cpg/keyframes.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gaitlab::cpg {

const char* const Keyframes::kManual =
    R"(Joint angles at given times (frames), joined by splines or straight lines. Joints that a frame does not name take its `default`.

    theta(t) = a y_k + b y_k+1 + ((a^3 - a) M_k + (b^3 - b) M_k+1) h^2 / 6      t_k <= t <= t_k+1
    h = t_k+1 - t_k,  b = (t - t_k) / h,  a = 1 - b;  for t < ramp: y_0 + (t / ramp) (theta(t) - y_0)

y: angles of the frames. Hold: y_k until t_k+1. M: second derivatives there. Linear: 0. Spline: such that the speed is continuous, a cubic spline,

    h_k-1 M_k-1 + 2 (h_k-1 + h_k) M_k + h_k M_k+1 = 6 ((y_k+1 - y_k) / h_k - (y_k - y_k-1) / h_k-1)

With repeat, the motion repeats with period t_last; the last frame must equal the first, and the spline is smooth there.
Without repeat, the spline starts and ends at rest, and the last frame is held. A spline may swing beyond its frames.
Reference: C. de Boor, A Practical Guide to Splines, Springer 1978, chapter IV.

    cpg:
      type: keyframes
      model:
        frames:
          - {time: 0, angles: 0}
          - {time: 1, angles: {default: 0, m0/passive: 0.5}}
          - {time: 2, angles: 0})";

namespace {

// Error message about the times of frames, or "".
std::string wrong_times(const std::vector<Keyframes::Frame>& frames) {
  if (frames.size() < 2) return "at least two frames are needed; found " + std::to_string(frames.size());
  if (frames[0].time != 0) return "the first frame's time must be 0";
  for (std::size_t k = 1; k < frames.size(); ++k) {
    if (!(frames[k].time > frames[k - 1].time)) {
      return "times must rise: frames[" + std::to_string(k) + "] is not later than the one before it";
    }
  }
  return "";
}

// A tridiagonal system: lower[i] x[i-1] + diagonal[i] x[i] + upper[i] x[i+1] = right[i].
struct Tridiagonal {
  explicit Tridiagonal(std::size_t size) : lower(size, 0.0), diagonal(size, 0.0), upper(size, 0.0) {}
  std::vector<double> lower, diagonal, upper;

  // Solves the system by Thomas' algorithm: elimination without pivots, which these diagonally dominant matrices do not need.
  [[nodiscard]] std::vector<double> solve(std::vector<double> right) const {
    const std::size_t n = diagonal.size();
    std::vector<double> scaled(n);
    for (std::size_t i = 0; i < n; ++i) {
      const double pivot = diagonal[i] - (i > 0 ? lower[i] * scaled[i - 1] : 0);
      scaled[i] = upper[i] / pivot;
      right[i] = (right[i] - (i > 0 ? lower[i] * right[i - 1] : 0)) / pivot;
    }
    for (std::size_t i = n - 1; i-- > 0;) right[i] -= scaled[i] * right[i + 1];
    return right;
  }

  // Solves the system with `corner` in the last column of the first row and in the first column of the last row, by Sherman and
  // Morrison's update of rank one.
  [[nodiscard]] std::vector<double> solve_cyclic(std::vector<double> right, double corner) const {
    const std::size_t n = diagonal.size();
    const double gamma = -diagonal[0];
    Tridiagonal rest = *this;
    rest.diagonal[0] -= gamma;
    rest.diagonal[n - 1] -= corner * corner / gamma;
    std::vector<double> u(n, 0.0);
    u[0] = gamma;
    u[n - 1] = corner;
    std::vector<double> x = rest.solve(std::move(right));
    const std::vector<double> z = rest.solve(std::move(u));
    const double share = (x[0] + corner / gamma * x[n - 1]) / (1 + z[0] + corner / gamma * z[n - 1]);
    for (std::size_t i = 0; i < n; ++i) x[i] -= share * z[i];
    return x;
  }
};

// Second derivatives of the periodic C2 spline through y at t, for which y.front() == y.back().
std::vector<double> periodic_spline(const std::vector<double>& t, const std::vector<double>& y) {
  const std::size_t n = t.size() - 1;  // number of frames without the last frame, which equals the first
  if (n == 1) return {0, 0};
  Tridiagonal system(n);
  std::vector<double> right(n);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t before = (k + n - 1) % n;
    const double h0 = t[before + 1] - t[before];
    const double h1 = t[k + 1] - t[k];
    if (k > 0) system.lower[k] = h0;
    system.diagonal[k] = 2 * (h0 + h1);
    if (k + 1 < n) system.upper[k] = h1;
    right[k] = 6 * ((y[k + 1] - y[k]) / h1 - (y[before + 1] - y[before]) / h0);
  }
  std::vector<double> curvature = system.solve_cyclic(std::move(right), t[n] - t[n - 1]);
  curvature.push_back(curvature[0]);
  return curvature;
}

// Second derivatives of the C2 spline through y at t with zero speed at both ends.
std::vector<double> clamped_spline(const std::vector<double>& t, const std::vector<double>& y) {
  const std::size_t n = t.size();
  Tridiagonal system(n);
  std::vector<double> right(n, 0.0);
  for (std::size_t k = 0; k + 1 < n; ++k) {
    const double h = t[k + 1] - t[k];
    const double slope = (y[k + 1] - y[k]) / h;
    system.diagonal[k] += 2 * h;
    system.upper[k] = h;
    right[k] += 6 * slope;
    system.lower[k + 1] = h;
    system.diagonal[k + 1] += 2 * h;
    right[k + 1] -= 6 * slope;
  }
  return system.solve(std::move(right));
}

}  // namespace

void Keyframes::Frame::fields(Fields& f) {
  f.number("time", time, {"s", 0, 1e6, "Time of the frame; 0 for the first frame."});
  f.per_joint("angles", angles, {"rad", -1000, 1000, "Set points at that time; within +-3.2 for a hinge with a range."});
}

void Keyframes::Model::fields(Fields& f) {
  static constexpr const char* kInterpolations[] = {"spline", "linear", "hold"};
  f.list("frames", frames,
         "At least two frames, in order of increasing time; default: two frames that hold every joint at its default.");
  if (const std::string wrong = wrong_times(frames); !wrong.empty()) f.problem("frames", wrong);
  f.choice("interpolation", interpolation, kInterpolations, "Interpolation between frames.");
  f.flag("repeat", repeat, "Start again after the last frame, which must equal the first; otherwise hold the last frame.");
  f.number("ramp", ramp,
           {"s", 0, 1e6,
            "Duration of the start, in which the motion about the first frame grows linearly from 0; without "
            "initial.angles the robot starts at the first frame."});
}

void Keyframes::Settings::fields(Fields& f) { f.group("model", model, "Keys that only this type has."); }

Keyframes::Keyframes(const RobotInfo& robot, const Settings& settings)
    : joints_(robot.joints.size()),
      hold_(settings.model.interpolation == Interpolation::hold),
      repeat_(settings.model.repeat),
      ramp_(settings.model.ramp) {
  const std::vector<Frame>& frames = settings.model.frames;
  if (const std::string wrong = wrong_times(frames); !wrong.empty()) throw std::invalid_argument(wrong);
  for (const Frame& frame : frames) {
    time_.push_back(frame.time);
    for (std::size_t j = 0; j < joints_; ++j) angle_.push_back(frame.angles[j]);
  }
  for (std::size_t j = 0; j < joints_; ++j) {
    for (std::size_t k = 0; k < frames.size() && robot.joints[j].driven; ++k)
      check_angle(robot.joints[j], "an angle of the frames", angle_[k * joints_ + j]);
  }
  if (repeat_) check_closed(robot);
  curvature_.assign(angle_.size(), 0.0);
  if (settings.model.interpolation == Interpolation::spline) curve();
}

void Keyframes::check_closed(const RobotInfo& robot) {
  constexpr double kSame = 1e-9;  // tolerance for rounding in the file, rad
  const std::size_t last = angle_.size() - joints_;
  for (std::size_t j = 0; j < joints_; ++j) {
    if (!(std::abs(angle_[last + j] - angle_[j]) <= kSame)) {
      throw std::invalid_argument("the last frame differs from the first at joint " + robot.joints[j].name +
                                  "; make them equal or set repeat: false");
    }
    angle_[last + j] = angle_[j];
  }
}

void Keyframes::curve() {
  std::vector<double> y(time_.size());
  for (std::size_t j = 0; j < joints_; ++j) {
    for (std::size_t k = 0; k < y.size(); ++k) y[k] = angle_[k * joints_ + j];
    const std::vector<double> curvature = repeat_ ? periodic_spline(time_, y) : clamped_spline(time_, y);
    for (std::size_t k = 0; k < y.size(); ++k) curvature_[k * joints_ + j] = curvature[k];
  }
}

void Keyframes::output(double t, In, Out setpoint) const {
  const double end = time_.back();
  const double at = std::clamp(repeat_ ? t - end * std::floor(t / end) : t, 0.0, end);
  constexpr double kRounding = 1e-9;  // s; the time of a control tick as a sum of steps may be below the same time in a table
  const auto next = hold_ ? std::upper_bound(time_.begin() + 1, time_.end(), at + kRounding)
                          : std::upper_bound(time_.begin() + 1, time_.end() - 1, at);
  const auto k = static_cast<std::size_t>(next - time_.begin()) - 1;
  if (hold_) {
    std::copy_n(angle_.begin() + static_cast<std::ptrdiff_t>(k * joints_), joints_, setpoint.begin());
    return ramp(t, setpoint);
  }
  const double h = time_[k + 1] - time_[k];
  const double b = (at - time_[k]) / h;
  const double a = 1 - b;
  const double* y = angle_.data() + k * joints_;
  const double* m = curvature_.data() + k * joints_;
  for (std::size_t j = 0; j < joints_; ++j) {
    const double bend = (a * a * a - a) * m[j] + (b * b * b - b) * m[joints_ + j];
    setpoint[j] = a * y[j] + b * y[joints_ + j] + bend * h * h / 6;
  }
  ramp(t, setpoint);
}

/// Scales the motion about the first frame while the ramp lasts.
void Keyframes::ramp(double t, Out setpoint) const {
  if (!(t < ramp_)) return;
  for (std::size_t j = 0; j < joints_; ++j) setpoint[j] = angle_[j] + t / ramp_ * (setpoint[j] - angle_[j]);
}

}  // namespace gaitlab::cpg
