#include "core/simulation/load_meter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/model/docking.h"
#include "core/simulation/support.h"

namespace gaitlab {

namespace {

constexpr double kLoaded = 0.005;  // share of the weight; smaller loads occur while a foot lifts off

enum FootColumn : std::size_t {
  kFootForce,
  kFootPoint = 3,
  kFootSlid = 6,
  kFootColumns
};  // with Loads::judged, `slid` is the only column

double level(const Vec3& v) { return std::sqrt(v.x() * v.x() + v.y() * v.y()); }

bool states_what_docks_hold(const Robot& robot) {
  const auto states = [](const Connector& c) { return c.tension > 0 || c.shear > 0 || c.bending > 0 || c.torsion > 0; };
  for (std::size_t m = 1; m < robot.modules.size(); ++m) {
    if (std::ranges::any_of(connectors_at(robot, m), states)) return true;
  }
  return false;
}

/// Rounds to single precision. Seven digits exceed the accuracy of the contact law and halve the size of a trace file.
double single(double value) { return static_cast<double>(static_cast<float>(value)); }

}  // namespace

LoadMeter::LoadMeter(const Scenario& scenario, const std::vector<ContactElement>& elements, Loads wanted,
                     std::vector<std::size_t> gears)
    : robot_(*scenario.robot),
      elements_(elements),
      sample_(robot_, elements.size(), 0),
      weight_(robot_.mass * scenario.physics.gravity.norm()),
      stability_(wanted == Loads::recorded && scenario.ground.is_plane()),
      forces_(wanted == Loads::recorded),
      creep_speed_(scenario.contact.model().penalty_settings ? scenario.contact.penalty.v_lim : 0),
      gears_(scenario.contact.model().element_forces ? std::move(gears) : std::vector<std::size_t>()),
      before_(robot_),
      touched_(elements.size()) {
  sample_.gravity = scenario.physics.gravity;
  support_.reserve(elements.size());
  for (std::size_t m = 1; m < robot_.modules.size() && scenario.contact.model().element_forces; ++m) {
    const Module& module = robot_.modules[m];
    const Module& parent = robot_.modules[static_cast<std::size_t>(module.parent)];
    const FaceType& face = *find_face(robot_.types[parent.type], module.dock.parent_face);
    const Body& body = robot_.bodies[parent.first_body + face.body];
    docks_.push_back({m, body.link, body.in_link.R * face.normal});
  }
  if (wanted == Loads::judged && !states_what_docks_hold(robot_)) docks_.clear();
  dock_loads_.resize(docks_.size());
  gear_loads_.resize(gears_.size());
  for (std::size_t e = 0; e < elements.size(); ++e) {
    if (feet_.empty() || feet_.back().body != elements[e].body) feet_.push_back({.body = elements[e].body, .elements = {}});
    feet_.back().elements.push_back(e);
  }
  add_columns(scenario);
}

void LoadMeter::add_columns(const Scenario& scenario) {
  const auto add = [&](std::string name, const char* unit, std::string definition) {
    columns_.push_back({std::move(name), unit, std::move(definition)});
  };
  add("t", "s", "time");
  add("path", "m", "length of the horizontal path of the centre of mass from t = 0, from row to row");
  add("slip", "m", "distance that contact points slid under load, times the load over the weight, from t = 0");
  if (creep_speed_ > 0) {
    for (const char* const axis : {"x", "y"}) {
      add(fmt::format("creep.{}", axis), "m",
          fmt::format(
              "distance along {} that contact points slid below contact.slip_speed, times the load over the weight, from t = 0",
              axis));
    }
  }
  if (stability_)
    add("stability", "m", "distance of the centre of mass from the edge of the support polygon; negative outside");
  for (const DockFace& dock : docks_) {
    const auto of_dock = [&](const char* quantity, const char* unit, const char* definition) {
      add(fmt::format("dock.{}.{}", dock.module, quantity), unit, definition + fmt::format(" at m{}/dock", dock.module));
    };
    of_dock("tension", "N", "force that pulls the modules apart");
    of_dock("shear", "N", "force in the plane of the faces");
    of_dock("bending", "N m", "moment about an axis in the plane of the faces");
    of_dock("torsion", "N m", "moment about the normal of the parent's face, of the parent on the child,");
  }
  for (const std::size_t joint : gears_) {
    add(fmt::format("gear.{}.torque", joint), "N m",
        "torque that the gear of " + robot_.joints[joint].name +
            " passes on: the torque of its motor minus the torque that turns its rotor");
  }
  foot_columns_ = columns_.size();
  for (const Foot& foot : feet_) {
    const std::string& body = scenario.robot->bodies[foot.body].name;
    const auto of_foot = [&](const char* quantity, const char* unit, const char* definition) {
      add(fmt::format("foot.{}.{}", body, quantity), unit, definition + body);
    };
    if (forces_) {
      for (const char* const axis : {"fx", "fy", "fz"}) of_foot(axis, "N", "force of the ground, world axes, on ");
      for (const char* const axis : {"x", "y", "z"})
        of_foot(axis, "m", "point at which the normal forces act, world axes, on ");
    }
    of_foot("slid", "m", "distance slid under load, from t = 0, of ");
  }
}

/// Number of columns per foot.
std::size_t LoadMeter::foot_width() const { return forces_ ? std::size_t{kFootColumns} : 1; }

Vec3 LoadMeter::slide(std::size_t e) const {
  const ContactSample& now = sample_.contacts[e];
  const Kinematics& k = sample_.kinematics;
  const std::size_t link = elements_[e].link;
  if (touched_[e].fn > 0) return k.point(link, touched_[e].in_link) - before_.point(link, touched_[e].in_link);
  return now.point - before_.point(link, k.R[link].transpose() * (now.point - k.p[link]));
}

void LoadMeter::measure(Foot& foot, Out row) {
  Vec3 force = Vec3::Zero();
  Vec3 point = Vec3::Zero();
  double load = 0;
  double loads = 0;  // sum of the loads at both ticks
  double way = 0;
  for (const std::size_t e : foot.elements) {
    const ContactSample& contact = sample_.contacts[e];
    if (contact.fn > 0) {
      force += contact.force;
      point += contact.fn * contact.point;
      load += contact.fn;
    }
    const double both = contact.fn + touched_[e].fn;
    if (first_ || !(both > 0)) continue;
    loads += both;
    const Vec3 slid = slide(e);
    way += both * level(slid);
    if (weight_ > 0 && level(slid) < creep_speed_ * (sample_.t - time_before_)) creep_ += both / 2 / weight_ * slid;
  }
  const bool loaded = load > kLoaded * weight_;
  const bool was = foot.load > kLoaded * weight_;
  if (loads > 0) {
    if (weight_ > 0) slip_ += way / 2 / weight_;
    foot.slid += way / loads * (loaded && was ? 1 : loaded || was ? 0.5 : 0);
  }
  if (load > 0) foot.point = point / load;
  foot.load = load;
  foot.idle = foot.idle && !(load > 0);
  row.back() = single(foot.slid);
  if (!forces_) return;
  for (Eigen::Index i = 0; i < 3; ++i) {
    row[kFootForce + static_cast<std::size_t>(i)] = single(force[i]);
    row[kFootPoint + static_cast<std::size_t>(i)] = single(foot.point[i]);
  }
}

double LoadMeter::margin() {
  support_.clear();
  for (const ContactSample& contact : sample_.contacts) {
    if (contact.fn > kLoaded * weight_) support_.push_back(contact.point);
  }
  return support_margin(support_, sample_.sums.com);
}

DockLoad LoadMeter::load(const DockFace& dock) const {
  return dock_load(sample_.reactions.dock(dock.module), sample_.kinematics.R[dock.link] * dock.normal);
}

void LoadMeter::watch() {
  for (std::size_t d = 0; d < docks_.size(); ++d) {
    const DockLoad now = load(docks_[d]);
    dock_loads_[d] = watched_ ? largest(dock_loads_[d], now) : now;
  }
  for (std::size_t g = 0; g < gears_.size(); ++g) {
    const std::size_t j = gears_[g];
    const double now = sample_.reactions.torques()[j] - sample_.stop_torque[j] - sample_.passive_torque[j];
    if (!watched_ || std::abs(now) > std::abs(gear_loads_[g])) gear_loads_[g] = now;
  }
  watched_ = true;
}

void LoadMeter::measure(Out row) {
  const Kinematics& k = sample_.kinematics;
  for (std::size_t i = 0; i < feet_.size(); ++i) measure(feet_[i], row.subspan(foot_columns_ + i * foot_width(), foot_width()));
  if (!first_) path_ += level(sample_.sums.com - com_before_);
  std::size_t at = 0;
  row[at++] = sample_.t;
  row[at++] = single(path_);
  row[at++] = single(slip_);
  if (creep_speed_ > 0) {
    for (const double way : {creep_.x(), creep_.y()}) row[at++] = single(way);
  }
  if (stability_) row[at++] = single(margin());
  watch();
  for (const DockLoad& load : dock_loads_) {
    for (const double value : {load.tension, load.shear, load.bending, load.torsion}) row[at++] = single(value);
  }
  for (const double torque : gear_loads_) row[at++] = single(torque);
  watched_ = false;
  first_ = false;
  time_before_ = sample_.t;
  com_before_ = sample_.sums.com;
  before_ = k;
  for (std::size_t e = 0; e < touched_.size(); ++e) {
    const ContactSample& contact = sample_.contacts[e];
    const std::size_t link = elements_[e].link;
    touched_[e].fn = contact.fn;
    if (contact.fn > 0) touched_[e].in_link = k.R[link].transpose() * (contact.point - k.p[link]);
  }
}

void LoadMeter::drop_idle_feet(Trace& loads) const {
  std::vector<std::size_t> kept;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    if (c < foot_columns_ || !feet_[(c - foot_columns_) / foot_width()].idle) kept.push_back(c);
  }
  Trace left;
  for (const std::size_t c : kept) left.columns.push_back(columns_[c]);
  left.values.reserve(loads.rows() * kept.size());
  for (std::size_t row = 0; row < loads.rows(); ++row) {
    for (const std::size_t c : kept) left.values.push_back(loads.at(row, c));
  }
  loads = std::move(left);
}

}  // namespace gaitlab
