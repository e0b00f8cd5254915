#include "report/verdict/plausible/plausibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/settings/wording.h"

namespace gaitlab::report {

namespace {

bool usual(const PlausibleNumber& row, double value) { return value >= row.least && value <= row.most; }

/// The mistake that brings a number nearest to the geometric middle of its range. If the range lacks a lower or upper end, the
/// first mistake that brings the number into the range. Null if there is none.
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

/// A box about the points of a body, whose edges are at least a third of the largest. Empty for a body with fewer than two.
std::vector<Shape> thick_box(const ModuleType& type, std::size_t body) {
  constexpr double kThin = 1.0 / 3;
  const auto [low, high] = box_of_points(type, body);
  const double edge = (high - low).maxCoeff();
  if (!(edge > 0)) return {};
  Shape box;
  box.in_body.p = (low + high) / 2;
  box.size = (high - low).cwiseMax(kThin * edge);
  return {box};
}

bool accepts(const Scenario& s, const PlausibleNumber& row) {
  return std::ranges::find(s.accept, std::string_view(row.name)) != s.accept.end();
}

/// The worst impossible number of a row, with the number of further ones; empty if it has none.
std::string worst_impossible(const Scenario& s, const PlausibleNumber& row) {
  if (row.impossible == nullptr) return "";
  const std::vector<Impossible> found = row.impossible(s);
  if (found.empty()) return "";
  const std::string more = found.size() == 1 ? "" : fmt::format(" (and {} more)", found.size() - 1);
  return std::ranges::max_element(found, {}, &Impossible::times)->text + more;
}

/// The first unusual number of a row; empty if it has none.
std::string first_unusual(const Scenario& s, const PlausibleNumber& row) {
  for (const Finding& finding : row.measure(Subject(s))) {
    if (!usual(row, finding.value)) return finding.text;
  }
  return "";
}

/// Warnings of one row. Parts with the same mistake share a warning, and so do parts without a known mistake.
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

std::pair<Vec3, Vec3> box_of_points(const ModuleType& type, std::size_t body) {
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
  return {low, high};
}

const std::vector<SetPointRange>& Subject::set_points() const {
  if (!set_points_) set_points_ = set_point_ranges(scenario);
  return *set_points_;
}

Subject::Subject(const Scenario& s) : scenario(s) {
  for (const ModuleType& type : s.robot->types) {
    sizes.emplace_back();
    for (std::size_t b = 0; b < type.bodies.size(); ++b) {
      const BodyType& body = type.bodies[b];
      Size size{body.shapes.empty() ? thick_box(type, b) : body.shapes, body.shapes.empty()};
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
    for (const auto& rows : {plausible_bodies(), plausible_motors(), plausible_contacts(), plausible_scenario()}) {
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
    if (accepts(s, row)) continue;
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

Doubts doubts(const Scenario& s) {
  std::vector<std::string> impossible;
  std::vector<std::string> rows;
  std::vector<std::string> accepted;
  for (const PlausibleNumber& row : plausible_numbers()) {
    std::string text = worst_impossible(s, row);
    if (accepts(s, row)) {
      if (text.empty()) text = first_unusual(s, row);
      if (!text.empty()) accepted.push_back(fmt::format("{} ({})", row.name, text));
    } else if (!text.empty()) {
      impossible.push_back(std::move(text));
      rows.emplace_back(row.name);
    }
  }
  Doubts made;
  if (!rows.empty()) {
    rows.insert(rows.begin(), s.accept.begin(), s.accept.end());
    made.refused = fmt::format("{}; give values that are physically possible, or accept: [{}]", fmt::join(impossible, "; "),
                               fmt::join(rows, ", "));
  }
  if (!accepted.empty()) made.accepted = fmt::format("accepted: {}", fmt::join(accepted, ", "));
  return made;
}

void check_accepted(const Scenario& s) {
  if (s.accept.empty()) return;
  const auto odd = [&](const PlausibleNumber& row) {
    return !worst_impossible(s, row).empty() || !first_unusual(s, row).empty();
  };
  std::vector<std::string> others;
  std::vector<std::string> idle;
  for (const PlausibleNumber& row : plausible_numbers()) {
    if (row.impossible == nullptr) continue;
    const bool used = odd(row);
    if (accepts(s, row) && !used) idle.emplace_back(row.name);
    if (!accepts(s, row) && used) others.emplace_back(row.name);
  }
  if (idle.empty()) return;
  const bool one = idle.size() == 1;
  std::string remedy = one ? "remove it" : "remove them";
  if (!others.empty()) remedy = fmt::format("the unusual numbers are those of {}", fmt::join(others, " and "));
  throw InputError(s.place("accept"), fmt::format("accept names {}, but no number of {} is unusual; {}",
                                                  fmt::join(idle, " and "), one ? "this row" : "these rows", remedy));
}

}  // namespace gaitlab::report
