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
  const bool two_ends = row.least > 0 && row.most < kNoLimit;
  for (const Slip& slip : row.slips) {
    const double value = finding.again ? finding.again(slip) : slip.corrected(finding.value);
    if (!usual(row, value)) continue;
    const double away = two_ends ? std::abs(std::log(value * value / (row.least * row.most))) : 0;
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

/// Warnings of one row, with one for all parts that have the same mistake.
class Warnings {
 public:
  explicit Warnings(const PlausibleNumber& row) : row_(row) {}

  void add(const Finding& finding, const Slip* slip) {
    for (Group& group : groups_) {
      if (group.slip != slip || group.remedy != finding.remedy || (slip == nullptr && group.place != finding.place)) continue;
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

Subject::Subject(const Scenario& s) : scenario(s), set_points(set_point_ranges(s)) {
  for (const ModuleType& type : s.robot->types) {
    solids.emplace_back();
    for (const BodyType& body : type.bodies) {
      const bool judged = body.mass > 0 && !body.shapes.empty() && body.shapes.size() <= kMostShapes;
      solids.back().push_back(judged ? united(body.shapes) : Solid());
    }
  }
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
