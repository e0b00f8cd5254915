#include "core/robot_files/leg_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "core/settings/value.h"
#include "core/settings/wording.h"
#include "core/settings/writer.h"

namespace gaitlab {

namespace {

constexpr const char* kNoLegs = "none";

/// Bodies at the ends of the chains that begin behind a link.
std::vector<std::string> ends_behind(const Robot& robot, std::size_t link) {
  std::vector<bool> behind(robot.links.size(), false);
  std::vector<bool> carries(robot.links.size(), false);
  for (std::size_t l = link + 1; l < robot.links.size(); ++l) {
    const auto parent = static_cast<std::size_t>(robot.links[l].parent);
    behind[l] = parent == link || behind[parent];
    carries[parent] = true;
  }
  std::vector<std::string> names;
  for (const Body& body : robot.bodies) {
    if (behind[body.link] && !carries[body.link]) names.push_back(body.name);
  }
  return names;
}

/// Reason why no leg ends with a body, `which ...`; empty if one may.
std::string refused_end(const Robot& robot, const Body& body) {
  const std::vector<std::string> ends = ends_behind(robot, body.link);
  if (body.link == 0) return "which is part of the base; expected the last body of a leg: " + joined(ends);
  if (!ends.empty()) return "which carries other bodies; expected the last body of a leg: " + joined(ends);
  const auto touches = [&](const ContactElement& element) { return element.link == body.link; };
  if (std::ranges::none_of(contact_elements(robot, ContactSet::all), touches))
    return "which has no contact elements, so that it cannot stand";
  for (std::size_t l = body.link; l > 0; l = static_cast<std::size_t>(robot.links[l].parent)) {
    if (robot.joints[static_cast<std::size_t>(robot.links[l].joint)].driven()) return {};
  }
  return "which no motor moves";
}

/// Reads an entry. Nothing, with a problem, if its body does not end a leg.
std::optional<StatedLeg> read_leg(const std::string& name, const Node& item, const Robot& robot,
                                  const std::vector<StatedLeg>& before, Problems& problems) {
  const auto refuse = [&](const std::string& wrong) {
    problems.add(item.place, fmt::format("legs.{} {}", clipped(name), wrong));
    return std::nullopt;
  };
  const Reading<std::string> text = read_scalar(item);
  if (!text.ok()) return refuse(text.wrong);
  const auto body = std::ranges::find(robot.bodies, text.value, &Body::name);
  if (body == robot.bodies.end()) {
    std::vector<std::string> bodies;
    for (const Body& one : robot.bodies) bodies.push_back(one.name);
    return refuse(fmt::format("is {}, which is not a body of the robot", in_quotes(text.value)) +
                  offer(text.value, bodies, "bodies"));
  }
  const std::string wrong = refused_end(robot, *body);
  if (!wrong.empty()) return refuse(fmt::format("is {}, {}", in_quotes(text.value), wrong));
  const auto same = [&](const StatedLeg& leg) { return robot.bodies[leg.body].link == body->link; };
  if (const auto other = std::ranges::find_if(before, same); other != before.end())
    return refuse(fmt::format("ends with the link of leg {}; expected another link for each leg", other->name));
  return StatedLeg{name, static_cast<std::size_t>(body - robot.bodies.begin())};
}

}  // namespace

std::optional<std::vector<StatedLeg>> read_legs(const Node& node, const Robot& robot, Problems& problems) {
  std::vector<StatedLeg> legs;
  if (node.kind == Node::Kind::scalar && node.text == kNoLegs) return legs;
  const bool map = node.kind == Node::Kind::map;
  if (!map || node.keys.empty()) {
    problems.add(node.place, fmt::format("legs is {}; expected a map NAME: BODY with the last body of each leg, or none",
                                         map ? "an empty map" : found(node)));
    return {};
  }
  const std::size_t before = problems.size();
  for (std::size_t i = 0; i < node.keys.size(); ++i) {
    const auto& [name, place] = node.keys[i];
    if (!is_name(name, "_"))
      problems.add(place, fmt::format("{} is not a name of a leg; expected letters, digits and _", in_quotes(name)));
    if (const std::optional<StatedLeg> leg = read_leg(name, node.items[i], robot, legs, problems)) legs.push_back(*leg);
  }
  return problems.size() == before ? std::optional(legs) : std::nullopt;
}

Node legs_node(const Robot& robot) {
  if (robot.stated_legs->empty()) return text_node(kNoLegs);
  Node map{Node::Kind::map};
  map.flow = true;
  for (const StatedLeg& leg : *robot.stated_legs) {
    map.keys.emplace_back(leg.name, SourceLocation{});
    map.items.push_back(text_node(robot.bodies[leg.body].name));
  }
  return map;
}

}  // namespace gaitlab
