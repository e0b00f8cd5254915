#include "core/model/legs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/model/kinematics.h"

namespace gaitlab {

namespace {

constexpr double kNearGround = 0.1;  // share of the robot's height within which a chain stands
constexpr double kEqual = 0.01;      // m, largest difference of two equal chains
constexpr double kMidline = 0.15;    // share of the widest or longest distance within which a leg is in the middle
constexpr double kSole = 1e-3;       // m, height within which the lowest elements of a foot are its sole

/// Links from the trunk outwards, without branches.
struct Chain {
  std::vector<std::size_t> links;
  std::vector<double> distances;  ///< between joints that follow one another, and from the last one to the foot, m
  double low = std::numeric_limits<double>::infinity();  ///< height of the lowest contact element of the last link, m

  [[nodiscard]] bool equals(const Chain& other) const {
    return std::ranges::equal(distances, other.distances, [](double a, double b) { return std::abs(a - b) <= kEqual; });
  }
};

/// A robot in its pose.
struct Posed {
  const Robot& robot;
  Kinematics at, zero;
  std::vector<ContactElement> elements = contact_elements(robot, ContactSet::all);
  std::vector<std::vector<std::size_t>> of_link, bodies;  // numbers of elements and bodies, by link
  std::vector<std::size_t> children;                      // number of them, by link

  Posed(const Robot& of, std::span<const double> q, const Mat3& base)
      : robot(of), at(of), zero(at_zero(of)), of_link(of.links.size()), bodies(of.links.size()), children(of.links.size(), 0) {
    RobotState state;
    state.q.assign(q.begin(), q.end());
    state.qd.assign(q.size(), 0);
    state.orientation = Quat(base);
    at.place(robot, state);
    for (const Link& link : robot.links) {
      if (link.parent >= 0) ++children[static_cast<std::size_t>(link.parent)];
    }
    for (std::size_t e = 0; e < elements.size(); ++e) of_link[elements[e].link].push_back(e);
    for (std::size_t b = 0; b < robot.bodies.size(); ++b) bodies[robot.bodies[b].link].push_back(b);
  }

  [[nodiscard]] double height(const ContactElement& element) const {
    return at.point(element.link, element.centre).z() - element.radius;
  }
  [[nodiscard]] double lowest(std::size_t link) const {
    double low = std::numeric_limits<double>::infinity();
    for (const std::size_t e : of_link[link]) low = std::min(low, height(elements[e]));
    return low;
  }
  /// True for a link that turns freely about the centre of its only contact element, a sphere.
  [[nodiscard]] bool is_wheel(std::size_t l) const {
    const Link& link = robot.links[l];
    if (!robot.joints[static_cast<std::size_t>(link.joint)].turns_freely() || of_link[l].size() != 1) return false;
    const ContactElement& only = elements[of_link[l][0]];
    return only.radius > 0 && only.centre.cross(link.axis).norm() < kSole;
  }

  /// Middle of the lowest elements of a link, m, in the base frame at zero angles.
  [[nodiscard]] Vec3 sole(std::size_t link) const {
    const double low = lowest(link);
    Vec3 sum = Vec3::Zero();
    double count = 0;
    for (const std::size_t e : of_link[link]) {
      if (height(elements[e]) > low + kSole) continue;
      sum += zero.point(link, elements[e].centre);
      count += 1;
    }
    return sum / count;
  }

  [[nodiscard]] Chain chain_to(std::size_t end) const {
    Chain chain;
    chain.low = lowest(end);
    std::size_t link = end;
    chain.links.push_back(link);
    for (auto parent = static_cast<std::size_t>(robot.links[link].parent); parent > 0 && children[parent] == 1;
         parent = static_cast<std::size_t>(robot.links[link].parent)) {
      chain.distances.push_back((zero.p[parent] - zero.p[link]).norm());
      link = parent;
      chain.links.push_back(link);
    }
    std::ranges::reverse(chain.links);
    std::ranges::reverse(chain.distances);
    chain.distances.push_back((sole(end) - zero.p[end]).norm());
    return chain;
  }

  [[nodiscard]] std::vector<Chain> chains() const {
    std::vector<Chain> all;
    for (std::size_t end = 1; end < robot.links.size(); ++end) {
      if (children[end] > 0 || of_link[end].empty() || is_wheel(end)) continue;
      Chain chain = chain_to(end);
      const auto driven = [&](std::size_t l) { return robot.joints[static_cast<std::size_t>(robot.links[l].joint)].driven(); };
      if (std::ranges::any_of(chain.links, driven)) all.push_back(std::move(chain));
    }
    return all;
  }
};

/// The chains that are legs.
std::vector<Chain> walking(const Posed& posed) {
  std::vector<Chain> chains = posed.chains();
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const ContactElement& element : posed.elements) {
    const double height = posed.height(element);
    low = std::min(low, height);
    high = std::max(high, height + 2 * element.radius);
  }
  const double ground = low + kNearGround * (high - low);
  std::vector<Chain> models;
  for (const Chain& chain : chains) {
    if (chain.low <= ground) models.push_back(chain);
  }
  const auto equals_one = [&](const Chain& chain) {
    return std::ranges::any_of(models, [&](const Chain& model) { return model.equals(chain); });
  };
  if (std::ranges::count_if(chains, equals_one) < 2) {
    constexpr std::ptrdiff_t kGroup = 4;
    std::ptrdiff_t most = kGroup - 1;
    models.clear();
    for (const Chain& one : chains) {
      const std::ptrdiff_t equal = std::ranges::count_if(chains, [&](const Chain& other) { return one.equals(other); });
      if (one.links.size() < 2 || equal <= most) continue;
      most = equal;
      models = {one};
    }
  } else if (chains.size() == 2 && posed.lowest(0) <= ground) {
    models.clear();
  }
  std::erase_if(chains, [&](const Chain& chain) { return !equals_one(chain); });
  if (chains.size() < 2) chains.clear();
  return chains;
}

std::array<double, 3> array_of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Leg leg_of(const Posed& posed, const Chain& chain) {
  const Robot& robot = posed.robot;
  Leg leg;
  for (const std::size_t l : chain.links) {
    const auto joint = static_cast<std::size_t>(robot.links[l].joint);
    if (robot.joints[joint].driven()) leg.joints.push_back(static_cast<std::int64_t>(joint));
    for (const std::size_t body : posed.bodies[l]) leg.bodies.push_back(static_cast<std::int64_t>(body));
  }
  leg.tip = robot.links[chain.links.back()].joint;
  leg.hip = array_of(posed.zero.p[chain.links.front()]);
  leg.foot = array_of(posed.sole(chain.links.back()));
  for (const std::size_t e : posed.of_link[chain.links.back()]) {
    const Vec3 at = posed.zero.point(chain.links.back(), posed.elements[e].centre);
    leg.elements.push_back({at.x(), at.y(), at.z(), posed.elements[e].radius});
  }
  return leg;
}

/// A leg as seen from above, from the middle of all legs, m.
struct Place {
  double forward = 0, left = 0;
};

std::vector<Place> places(const std::vector<Leg>& legs, const Mat3& base) {
  const Vec3 up = base.row(2);
  const Vec3 forward = forwards(up);
  const Vec3 left = up.cross(forward);
  const auto seen = [&](const auto& point) {
    std::vector<Place> all;
    Place mean;
    for (std::size_t i = 0; i < legs.size(); ++i) {
      const Vec3 at = point(i);
      all.push_back({at.dot(forward), at.dot(left)});
      mean.forward += all.back().forward / static_cast<double>(legs.size());
      mean.left += all.back().left / static_cast<double>(legs.size());
    }
    for (Place& one : all) one = {one.forward - mean.forward, one.left - mean.left};
    return all;
  };
  std::vector<Place> hips = seen([&](std::size_t i) { return vector_of(legs[i].hip); });
  const auto apart = [](const Place& one) { return one.forward * one.forward + one.left * one.left > kSole * kSole; };
  if (std::ranges::any_of(hips, apart)) return hips;
  return seen([&](std::size_t i) { return vector_of(legs[i].foot); });  // all hips are on one point
}

std::string place_name(std::size_t rank, std::size_t count) {
  if (rank == 0) return "front";
  if (rank + 1 == count) return "rear";
  if (count == 3) return "middle";
  const std::size_t last = rank / 10 % 10 == 1 ? 0 : (rank + 1) % 10;  // 11th, 12th, 13th
  return std::to_string(rank + 1) + (last == 1 ? "st" : last == 2 ? "nd" : last == 3 ? "rd" : "th");
}

/// Gives the legs of one side their names and places, from front to rear. `most`: the largest distance forwards of all legs, m.
/// `row`: per leg, 0 at the front of its side to 1 at the rear.
void name_side(std::vector<Leg>& legs, const std::vector<Place>& at, int side, double most, std::vector<double>& row) {
  std::vector<std::size_t> own;
  for (std::size_t i = 0; i < legs.size(); ++i) {
    if (legs[i].side == side) own.push_back(i);
  }
  std::ranges::stable_sort(own, [&](std::size_t a, std::size_t b) { return at[a].forward > at[b].forward; });
  for (std::size_t rank = 0; rank < own.size(); ++rank) {
    Leg& leg = legs[own[rank]];
    const double forward = at[own[rank]].forward;
    const bool single = own.size() == 1;
    const bool middle = single && std::abs(forward) <= kMidline * most;
    const std::string place = middle ? "middle" : single ? forward > 0 ? "front" : "rear" : place_name(rank, own.size());
    leg.name = place + (side > 0 ? "_left" : side < 0 ? "_right" : "");
    leg.rank = static_cast<std::int64_t>(rank);
    leg.count = static_cast<std::int64_t>(own.size());
    const double last = static_cast<double>(own.size()) - 1;
    row[own[rank]] = middle ? 0.5 : single ? (forward > 0 ? 0 : 1) : static_cast<double>(rank) / last;
  }
}

}  // namespace

Vec3 forwards(const Vec3& up) {
  constexpr double kSteep = 0.5;  // sine of 30 degrees
  const Vec3 level = Vec3::UnitX() - up * up.x();
  return (level.norm() < kSteep ? Vec3(Vec3::UnitY() - up * up.y()) : level).normalized();
}

std::vector<Leg> legs_of(const Robot& robot, std::span<const double> q, const Mat3& base) {
  const Posed posed(robot, q, base);
  std::vector<Leg> legs;
  if (robot.stated_legs) {
    for (const StatedLeg& leg : *robot.stated_legs) legs.push_back(leg_of(posed, posed.chain_to(robot.bodies[leg.body].link)));
  } else {
    for (const Chain& chain : walking(posed)) legs.push_back(leg_of(posed, chain));
  }
  if (legs.empty()) return legs;
  const std::vector<Place> at = places(legs, base);
  double longest = 0, widest = 0;
  for (const Place& one : at) {
    longest = std::max(longest, std::abs(one.forward));
    widest = std::max(widest, std::abs(one.left));
  }
  for (std::size_t i = 0; i < legs.size(); ++i) {
    const bool middle = std::abs(at[i].left) < kMidline * widest || widest < kSole;
    legs[i].side = middle ? 0 : at[i].left > 0 ? 1 : -1;
    legs[i].angle = math::atan2(at[i].left, at[i].forward);
  }
  std::vector<double> row(legs.size());
  for (const int side : {1, 0, -1}) name_side(legs, at, side, longest, row);
  for (std::size_t i = 0; robot.stated_legs && i < legs.size(); ++i) legs[i].name = (*robot.stated_legs)[i].name;
  std::vector<std::size_t> order(legs.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(
      order, [&](std::size_t a, std::size_t b) { return row[a] != row[b] ? row[a] < row[b] : legs[a].side > legs[b].side; });
  std::vector<Leg> sorted;
  for (const std::size_t i : order) sorted.push_back(std::move(legs[i]));
  return sorted;
}

}  // namespace gaitlab
