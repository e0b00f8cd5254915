#include "core/simulation/stability.h"

#include <algorithm>
#include <cmath>

#include "core/laws/passive_hinge.h"
#include "core/simulation/support.h"

namespace gaitlab {

void static_contact_slopes(const LaneSettings& s, const Kinematics& k, std::vector<ContactSlope>& out) {
  out.clear();
  if (!s.ground.exists()) return;
  std::vector<SupportElement> elements;
  std::vector<Ground::Touch> touches;
  for (std::size_t e = 0; e < s.contacts.size(); ++e) {
    const Ground::Touch touch = s.ground.query(k.point(s.contacts[e].link, s.contacts[e].centre), s.contacts[e].radius);
    elements.push_back({e, -touch.penetration, touch.point});
    touches.push_back(touch);
  }
  for (const SupportElement& on : support_elements(std::move(elements), sums(*s.robot, k, s.gravity).com)) {
    const Ground::Touch& touch = touches[on.element];
    const ContactElement& element = s.contacts[on.element];
    out.push_back({on.element, element.link, on.point, touch.normal, Vec3::Zero(), element.friction * touch.friction, 0});
  }
  if (out.empty()) return;
  const double load = s.robot->mass * s.gravity.norm() / static_cast<double>(out.size());
  const double sink =
      load / s.law.kn;  // exact for k = 1; otherwise an estimate is enough, because the rate is monitored from the first tick
  for (ContactSlope& contact : out) {
    const double friction = contact.tangential;
    contact.along_normal = s.law(sink, 0.0, 0.0, friction).normal_slope;
    contact.tangential = friction * load / s.law.v_lim;
  }
}

RateMonitor::RateMonitor(const Robot& robot, std::vector<double> rotors)
    : motor(robot.joints.size(), 0.0),
      stop(robot.joints.size(), 0.0),
      hinge(robot.joints.size(), 0.0),
      hold(robot.joints.size(), NAN),
      plays_(joints_with_play(robot)),
      rotors_(std::move(rotors)),
      flank_(plays_.size(), 0.0),
      x_(6 + robot.joints.size() + plays_.size()),
      kx_(x_.size()),
      y_(x_.size()),
      v_(robot.links.size()),
      omega_(robot.links.size()),
      force_(robot.links.size()),
      moment_(robot.links.size()) {}

void RateMonitor::stop_at(const Robot& robot, const RobotState& state, double step) {
  for (std::size_t j = 0; j < stop.size(); ++j) {
    const HingeStop own = HingeStop::at(state.q[j], state.qd[j], robot.joints[j].lo, robot.joints[j].hi);
    stop[j] = std::isnan(hold[j]) ? own.damping : held(step);
  }
}

/// Dry friction has its largest slope at rest (`standing`).
void RateMonitor::hinge_at(const Robot& robot, const RobotState& state, bool standing, double step) {
  for (std::size_t j = 0; j < hinge.size(); ++j) {
    if (robot.joints[j].driven()) continue;
    const PassiveHinge own = law(*robot.joints[j].passive);
    hinge[j] = own.loss(standing ? 0 : state.qd[j]).slope + step * own.stiffness;
  }
}

Vec3 RateMonitor::velocity_at(const Kinematics& k, const ContactSlope& c) const {
  return v_[c.link] + omega_[c.link].cross(c.point - k.p[c.link]);
}

/// force = (B + sum J^T G J) velocity. Velocities are computed from the base outwards, forces from the tips inwards.
void RateMonitor::damp(const Robot& robot, const Kinematics& k, In x, Out f) {
  v_[0] = Vec3(x[0], x[1], x[2]);
  omega_[0] = Vec3(x[3], x[4], x[5]);
  for (std::size_t i = 1; i < robot.links.size(); ++i) {
    const auto parent = static_cast<std::size_t>(robot.links[i].parent);
    const auto joint = static_cast<std::size_t>(robot.links[i].joint);
    omega_[i] = omega_[parent] + k.R[i] * robot.links[i].axis * x[6 + joint];
    v_[i] = v_[parent] + omega_[parent].cross(k.p[i] - k.p[parent]);
  }
  for (std::size_t i = 0; i < robot.links.size(); ++i) force_[i] = moment_[i] = Vec3::Zero();
  for (const ContactSlope& c : contacts) {
    const Vec3 force = c.apply(velocity_at(k, c));
    force_[c.link] += force;
    moment_[c.link] += (c.point - k.p[c.link]).cross(force);
  }
  for (std::size_t i = robot.links.size() - 1; i > 0; --i) {
    const auto parent = static_cast<std::size_t>(robot.links[i].parent);
    const auto joint = static_cast<std::size_t>(robot.links[i].joint);
    const double own = robot.joints[joint].play.any() ? 0 : motor[joint];
    f[6 + joint] = (k.R[i] * robot.links[i].axis).dot(moment_[i]) + (own + stop[joint] + hinge[joint]) * x[6 + joint];
    force_[parent] += force_[i];
    moment_[parent] += moment_[i] + (k.p[i] - k.p[parent]).cross(force_[i]);
  }
  for (std::size_t p = 0; p < plays_.size(); ++p) {
    const std::size_t j = 6 + plays_[p];
    const std::size_t shaft = 6 + motor.size() + p;
    const double across = flank_[p] * (x[shaft] - x[j]);
    f[j] -= across;
    f[shaft] = motor[plays_[p]] * x[shaft] + across;
  }
  for (std::size_t a = 0; a < 3; ++a) {
    f[a] = force_[0][static_cast<Eigen::Index>(a)];
    f[3 + a] = moment_[0][static_cast<Eigen::Index>(a)];
  }
}

Stability RateMonitor::attribute(const Kinematics& k, In x, double rate) const {
  Stability result{rate, Stability::Source::motor, 0};
  double most = -1;
  const auto offer = [&](double power, Stability::Source source, std::size_t index) {
    if (power > most) {
      most = power;
      result.source = source;
      result.index = index;
    }
  };
  for (std::size_t j = 0; j < motor.size(); ++j) {
    if (std::ranges::find(plays_, j) == plays_.end()) offer(motor[j] * x[6 + j] * x[6 + j], Stability::Source::motor, j);
    offer(stop[j] * x[6 + j] * x[6 + j], Stability::Source::stop, j);
    offer(hinge[j] * x[6 + j] * x[6 + j], Stability::Source::hinge, j);
  }
  for (std::size_t p = 0; p < plays_.size(); ++p) {
    const double w = x[6 + motor.size() + p];
    const double apart = w - x[6 + plays_[p]];
    offer(motor[plays_[p]] * w * w, Stability::Source::motor, plays_[p]);
    offer(flank_[p] * apart * apart, Stability::Source::play, plays_[p]);
  }
  for (const ContactSlope& c : contacts) {
    const Vec3 v = velocity_at(k, c);
    offer(v.dot(c.apply(v)), Stability::Source::contact, c.element);
  }
  return result;
}

Stability RateMonitor::largest(const Robot& robot, const Kinematics& k, InverseMass& inverse_mass, int iterations) {
  // Start vector that is orthogonal to no mode. Its entries alternate in sign and differ in size, so that no symmetry hides a
  // mode.
  for (std::size_t i = 0; i < x_.size(); ++i) {
    x_[i] = (i % 2 == 0 ? 1.0 : -1.0) * (1.0 + 0.1 * static_cast<double>((7 * i) % 11));
  }
  double rate = 0;
  for (int iteration = 0; iteration < iterations; ++iteration) {
    damp(robot, k, x_, kx_);
    const std::size_t robots = x_.size() - plays_.size();
    inverse_mass.apply(In(kx_).first(robots), Out(y_).first(robots));
    for (std::size_t p = 0; p < plays_.size(); ++p) y_[robots + p] = kx_[robots + p] / rotors_[p];
    double kxy = 0;
    double kxx = 0;
    double norm = 0;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      kxy += kx_[i] * y_[i];
      kxx += kx_[i] * x_[i];
      norm += y_[i] * y_[i];
    }
    if (!(kxx > 0) || !(norm > 0)) return {};  // no damping
    rate = kxy / kxx;
    for (std::size_t i = 0; i < x_.size(); ++i) x_[i] = y_[i] / std::sqrt(norm);
  }
  damp(robot, k, x_, kx_);
  return attribute(k, x_, rate);
}

}  // namespace gaitlab
