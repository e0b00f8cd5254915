#include <fmt/format.h>

#include <algorithm>

#include "bench/results.h"

namespace gaitlab::versus {

namespace {

constexpr std::string_view kBegin = "<!-- versus: written by --renew -->";
constexpr std::string_view kEnd = "<!-- end of versus -->";

using Row = std::vector<std::string>;

Row head() {
  return {"contender", "step, ms",   "error",     "median",   "to bullet",
          "sim s/s",   "min .. max", "per CPU s", "x MuJoCo", "x bullet"};
}

/// Table text with columns as wide as their widest cell; the first column is aligned left. With `markdown` a rule follows the
/// head.
std::string lay_out(const std::vector<Row>& rows, bool markdown) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const Row& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
  }
  std::string out;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::string line;
    for (std::size_t c = 0; c < widths.size(); ++c) {
      const std::string cell =
          c == 0 ? fmt::format("{:<{}}", rows[r][c], widths[c]) : fmt::format("{:>{}}", rows[r][c], widths[c]);
      line += (markdown ? (c == 0 ? "| " : " | ") : (c == 0 ? "" : "  ")) + cell;
    }
    out += line + (markdown ? " |\n" : "\n");
    if (r > 0 || !markdown) continue;
    for (std::size_t c = 0; c < widths.size(); ++c) out += c == 0 ? "|---" : "|--:";
    out += "|\n";
  }
  return out;
}

std::string percent(double share) {
  return share < 0.1 ? fmt::format("{:.2g} %", 100 * share) : fmt::format("{:.0f} %", 100 * share);
}
std::string times(const RacePoint& p, const RacePoint* than) {
  return than == nullptr ? "-" : fmt::format("{:.3g}", p.cpu_speed() / than->cpu_speed());
}

Row row(const RacePoint& p, const RacePoint* mujoco, const RacePoint* bullet) {
  Row row{p.contender, fmt::format("{:.4g}", 1e3 * p.step)};
  for (std::string cell : {percent(p.error.worst), percent(p.error.median), p.other ? percent(p.other->worst) : "-",
                           fmt::format("{:.3g}", p.speed()), fmt::format("{:.3g} .. {:.3g}", p.slowest(), p.fastest()),
                           fmt::format("{:.3g}", p.cpu_speed()), times(p, mujoco), times(p, bullet)}) {
    row.push_back(std::move(cell));
  }
  return row;
}

std::vector<std::string> scenarios(const RaceResults& results) {
  std::vector<std::string> names;
  for (const RacePoint& p : results.points) {
    if (names.empty() || names.back() != p.scenario) names.push_back(p.scenario);
  }
  return names;
}

/// The fastest results that count at error kGood: one per group, and for gaitlab's engines one per number of lanes.
std::vector<const RacePoint*> fastest(const RaceResults& results, const std::string& scenario) {
  std::vector<const RacePoint*> best;
  for (const RacePoint& p : results.points) {
    if (p.scenario != scenario || !p.ran() || p.error.worst > kGood) continue;
    const auto at = std::ranges::find_if(best, [&](const RacePoint* b) { return b->group == p.group && b->lanes == p.lanes; });
    if (at == best.end()) {
      best.push_back(&p);
    } else if (p.cpu_speed() > (*at)->cpu_speed()) {
      *at = &p;
    }
  }
  return best;
}

std::string best_table(const RaceResults& results, const std::string& scenario, bool markdown) {
  const RacePoint* mujoco = results.fastest(scenario, ContenderGroup::mujoco_best, kGood);
  const RacePoint* bullet = results.fastest(scenario, ContenderGroup::bullet, kGood);
  std::vector<Row> rows{head()};
  for (const RacePoint* p : fastest(results, scenario)) rows.push_back(row(*p, mujoco, bullet));
  return lay_out(rows, markdown);
}

/// Reasons why results do not count, one line each.
std::string reasons(const RaceResults& results, const std::string& scenario) {
  std::string out;
  for (const RacePoint& p : results.points) {
    if (p.scenario != scenario || p.note.empty()) continue;
    out += fmt::format("- left out: {} at {:.4g} ms: {}\n", p.contender, 1e3 * p.step, p.note);
  }
  return out;
}

std::string references(const RaceResults& results, const std::string& scenario) {
  std::string out;
  for (const Converged& c : results.references) {
    if (c.scenario != scenario) continue;
    out += fmt::format(
        "- reference {}: step {:.4g} ms; the result with the next longer step differs by {} (by {} in the median joint)\n",
        c.name, 1e3 * c.step, percent(c.left.worst), percent(c.left.median));
  }
  return out;
}

std::string left_out(const RaceResults& results) {
  std::string out;
  for (const std::string& sentence : results.left_out) out += fmt::format("- left out: {}\n", sentence);
  return out;
}

}  // namespace

std::string table(const RaceResults& results, bool markdown) {
  const std::string title = markdown ? "### " : "";
  std::string out;
  for (const std::string& scenario : scenarios(results)) {
    const RacePoint* mujoco = results.fastest(scenario, ContenderGroup::mujoco_best, kGood);
    const RacePoint* bullet = results.fastest(scenario, ContenderGroup::bullet, kGood);
    std::vector<Row> rows{head()};
    for (const RacePoint& p : results.points) {
      if (p.scenario == scenario && p.ran()) rows.push_back(row(p, mujoco, bullet));
    }
    out += fmt::format("{}{}\n\n{}\n{}{}: the fastest with at most {} of error\n\n{}\n", title, scenario,
                       lay_out(rows, markdown), title, scenario, percent(kGood), best_table(results, scenario, markdown));
    const std::string notes = reasons(results, scenario);
    if (!notes.empty()) out += notes + "\n";
    out += references(results, scenario) + "\n";
  }
  return out + left_out(results);
}

std::string digest(const RaceResults& results) {
  std::string out;
  for (const std::string& scenario : scenarios(results)) {
    out += fmt::format("### {}: the fastest with at most {} of error\n\n{}\n{}{}\n", scenario, percent(kGood),
                       best_table(results, scenario, true), references(results, scenario), reasons(results, scenario));
  }
  return out + left_out(results);
}

std::string renewed(const std::string& page, const std::string& part) {
  const std::size_t begin = page.find(kBegin);
  const std::size_t end = page.find(kEnd);
  if (begin == std::string::npos || end == std::string::npos || end < begin) {
    throw RunError(fmt::format("the page must contain the line '{}' and, further down, the line '{}'", kBegin, kEnd));
  }
  return page.substr(0, begin + kBegin.size()) + "\n\n" + part + "\n" + page.substr(end);
}

}  // namespace gaitlab::versus
