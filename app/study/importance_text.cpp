#include "app/study/importance_text.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "core/settings/wording.h"
#include "studies/search/importance.h"
#include "studies/search/sensitivity.h"

namespace gaitlab::app {

namespace {

using studies::Importance;
using studies::ParameterImportance;

/// Share in percent. An estimate below 0 is noise around 0.
std::string share_cell(double share) {
  return std::isfinite(share) ? fmt::format("{:.0f} %", 100 * std::max(0.0, share)) : "-";
}

std::string range_cell(const ParameterImportance& p) {
  return std::isfinite(p.width) ? fmt::format("{:.3g} to {:.3g} ({:.0f} % of the range)", p.low, p.high, 100 * p.width) : "-";
}

std::string table_of_importance(const Importance& found, const std::string& objective) {
  std::vector<std::vector<std::string>> rows{{"parameter", objective, "kept", "kept points lie within"}};
  bool known = false;
  for (const ParameterImportance& p : found.parameters) {
    rows.push_back({clipped(p.key), share_cell(p.objective), share_cell(p.kept), range_cell(p)});
    known = known || std::isfinite(p.objective) || std::isfinite(p.kept);
  }
  if (!known || found.parameters.size() < 2) return "";
  return fmt::format("share of the variance that a parameter alone explains, over {} points (below {:.0f} % is noise{}):\n{}",
                     found.points, std::ceil(100 * found.noise),
                     found.even ? "" : "; the points are denser where the search found good ones", aligned(rows, 2));
}

std::string narrow_sentence(const ParameterImportance& p) {
  return fmt::format(
      "{}: kept points lie within {:.3g} to {:.3g} ({:.0f} % of its range), and {} of {} outside are kept: narrow the range\n",
      clipped(p.key), p.low, p.high, std::max(1.0, std::round(100 * p.width)), p.kept_beyond, counted(p.beyond, "point"));
}

std::string end_sentence(const ParameterImportance& p) {
  return fmt::format("the best point is at the {} end of {} ({}): widen the range there\n",
                     p.best == studies::End::low ? "lower" : "upper", clipped(p.key), number_text(p.end));
}

}  // namespace

std::string importance_text(studies::Journal& journal, const studies::Results& results) {
  constexpr std::uint64_t kFewest = 20;  // least number of points for statements on ranges
  if (results.points.size() < kFewest || studies::of_sensitivity(journal.head())) return "";
  const Importance found = studies::importance(journal, results);
  std::string text = table_of_importance(found, clipped(journal.head().objectives.front().expression));
  for (const ParameterImportance& p : found.parameters) {
    if (found.kept >= kFewest && p.narrow()) text += narrow_sentence(p);
  }
  for (const ParameterImportance& p : found.parameters) {
    if (p.best != studies::End::none) text += end_sentence(p);
  }
  return text;
}

}  // namespace gaitlab::app
