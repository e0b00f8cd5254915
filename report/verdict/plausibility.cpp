#include "report/verdict/plausibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/settings/wording.h"

namespace gaitlab::report {

namespace {

bool usual(const PlausibleNumber& row, double value) { return value >= row.least && value <= row.most; }

/// The mistake that brings a number nearest to the middle of its range, in the sense of ratios; the first one in a range
/// without a lower or upper end. Null if none brings it into the range.
const Slip* likely(const PlausibleNumber& row, const Finding& finding) {
  const Slip* best = nullptr;
  double least = kNoLimit;
  const double low = std::max(row.least, row.likely);
  const bool two_ends = low > 0 && row.most < kNoLimit;
  for (const Slip& slip : row.slips) {
    const double value = finding.again ? finding.again(slip) : slip.corrected(finding.value);
    if (!usual(row, value) || value < low || (finding.sensible && !finding.sensible(slip))) continue;
    const double away = two_ends ? std::abs(std::log(value * value / (low * row.most))) : 0;
    if (away >= least) continue;
    least = away;
    best = &slip;
  }
  return best;
}

double four_digits(double value) { return std::stod(fmt::format("{:.4g}", value)); }

std::string question(const Finding& finding, const Slip& slip) {
  const GivenNumber given = slip.input < finding.inputs.size() ? finding.inputs[slip.input] : GivenNumber();
  if (given.unit == nullptr) return fmt::format(": {}?", slip.question);
  return fmt::format(": {} ({})?", slip.question, with_unit(four_digits(slip.corrected(given.value)), given.unit));
}

/// A box about the contact elements, faces and hinges of a body, whose edges are at least a third of the largest. Empty for a
/// body with fewer than two of these places.
std::vector<Shape> box_of_points(const ModuleType& type, std::size_t body) {
  constexpr double kThin = 1.0 / 3;
  Vec3 low = Vec3::Constant(kNoLimit);
  Vec3 high = -low;
  const auto add = [&](std::size_t of, const Vec3& point, double radius) {
    if (of != body) return;
    low = low.cwiseMin((point.array() - radius).matrix());
    high = high.cwiseMax((point.array() + radius).matrix());
  };
  for (const auto* elements : {&type.all, &type.feet}) {
    for (const ContactType& one : *elements) add(one.body, one.centre, one.radius);
  }
  for (const FaceType& one : type.faces) add(one.body, one.origin, 0);
  for (const HingeType& one : type.hinges) {
    add(one.parent, one.in_parent.p, 0);
    add(one.child, Vec3::Zero(), 0);
  }
  const double edge = (high - low).maxCoeff();
  if (!(edge > 0)) return {};
  Shape box;
  box.in_body.p = (low + high) / 2;
  box.size = (high - low).cwiseMax(kThin * edge);
  return {box};
}

/// Warnings of one row, with one for all parts that have the same mistake, or none that is known.
class Warnings {
 public:
  explicit Warnings(const PlausibleNumber& row) : row_(row) {}

  void add(const Finding& finding, const Slip* slip) {
    for (Group& group : groups_) {
      if (group.slip != slip || group.remedy != finding.remedy) continue;
      ++group.more;
      return;
    }
    const std::string hint = slip != nullptr ? question(finding, *slip) : finding.remedy.empty() ? "" : ": " + finding.remedy;
    groups_.push_back({slip, finding.place, finding.remedy, fmt::format("{}; {}{}", finding.text, row_.expected, hint)});
  }

  void write(std::vector<Warning>& out) const {
    for (const Group& group : groups_) {
      const std::string more = group.more == 0 ? "" : fmt::format(" (and {} more)", group.more);
      out.push_back({group.place, group.text + more, true, row_.of_gait});
    }
  }

 private:
  struct Group {
    const Slip* slip;
    SourceLocation place;
    std::string remedy, text;
    std::size_t more = 0;
  };
  const PlausibleNumber& row_;
  std::vector<Group> groups_ = {};
};

}  // namespace

double Subject::Size::largest_edge() const {
  const auto [low, high] = bounds(shapes);
  return (high - low).maxCoeff();
}

Subject::Subject(const Scenario& s) : scenario(s), set_points(set_point_ranges(s)) {
  for (const ModuleType& type : s.robot->types) {
    sizes.emplace_back();
    for (std::size_t b = 0; b < type.bodies.size(); ++b) {
      const BodyType& body = type.bodies[b];
      Size size{body.shapes.empty() ? box_of_points(type, b) : body.shapes, body.shapes.empty()};
      if (body.volume > 0) {
        size.solid.volume = body.volume;
      } else if (body.mass > 0 && !size.shapes.empty() && size.shapes.size() <= kMostShapes) {
        size.solid = united(size.shapes);
      }
      sizes.back().push_back(std::move(size));
    }
  }
}

const Node* entry_map(const Node& document, const char* key, const char* by, const std::string& name) {
  const Node* const list = document.find(key);
  for (std::size_t i = 0; list != nullptr && i < list->items.size(); ++i) {
    const Node* const found = list->items[i].find(by);
    if (found != nullptr && found->text == name) return &list->items[i];
  }
  return nullptr;
}

const Node* hinge_map(const Scenario& s, std::size_t joint) {
  const Joint& one = s.robot->joints[joint];
  const std::size_t type = s.robot->modules[one.module].type;
  if (type >= s.module_documents->size()) return nullptr;
  return entry_map((*s.module_documents)[type], "hinges", "name", one.name.substr(one.name.find('/') + 1));
}

const std::vector<PlausibleNumber>& plausible_numbers() {
  static const std::vector<PlausibleNumber> kAll = [] {
    std::vector<PlausibleNumber> all;
    for (const auto& rows : {plausible_bodies(), plausible_motors(), plausible_scenario()}) {
      all.insert(all.end(), rows.begin(), rows.end());
    }
    return all;
  }();
  return kAll;
}

Implausible implausible(const Scenario& s) {
  Implausible found;
  const Subject subject(s);
  std::set<std::pair<std::string, std::string>> reported;  // part, and row or question
  for (const PlausibleNumber& row : plausible_numbers()) {
    Warnings warnings(row);
    bool some = false;
    for (const Finding& finding : row.measure(subject)) {
      const auto explained = [&](std::string_view by) {
        return std::any_of(finding.parts.begin(), finding.parts.end(), [&](const std::string& part) {
          return reported.contains({part, std::string(by)});
        });
      };
      if (usual(row, finding.value) || std::any_of(row.unless.begin(), row.unless.end(), explained)) continue;
      const Slip* const slip = likely(row, finding);
      warnings.add(finding, slip);
      for (const std::string& part : finding.parts) {
        reported.insert({part, row.name});
        if (slip != nullptr) reported.insert({part, slip->question});
      }
      some = true;
    }
    warnings.write(found.warnings);
    if (some) found.rows.emplace_back(row.name);
  }
  return found;
}

}  // namespace gaitlab::report
