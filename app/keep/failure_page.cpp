#include "app/keep/failure_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "golden/report.h"
#include "report/analysis/plugin_names.h"
#include "report/page/page.h"
#include "report/page/page_overlay.h"

namespace gaitlab::app {

using namespace golden;

namespace {

/// Page data from the trace of a golden, which is not a complete recording.
report::PageData data_of(const Scenario& scenario, const Trace& trace, const std::string& build) {
  Recording record;
  record.trace = trace;
  record.simulated = trace.rows() == 0 ? 0 : trace.at(trace.rows() - 1, 0);
  Scenario sampled = scenario;
  if (trace.rows() > 1) sampled.trace.period = trace.at(1, 0) - trace.at(0, 0);
  report::Summary summary = report::summarise(sampled, record, 0);
  summary.build = build;
  report::Verdict verdict;
  verdict.word = Word::not_judged;
  verdict.to = record.simulated;
  return report::page_data(sampled, record, summary, verdict, {}, report::kMostData / 2);
}

std::vector<double> less(const Trace& now, const Trace& golden, const std::string& column) {
  const std::size_t i = now.find(column);
  const std::size_t j = golden.find(column);
  std::vector<double> difference;
  for (std::size_t k = 0; k < std::min(golden.rows(), now.rows()); ++k) difference.push_back(now.at(k, i) - golden.at(k, j));
  return difference;
}

std::vector<report::Stray> strays(const GoldenCase& c) {
  const RoundedTrace& golden = c.golden->run;
  std::vector<report::Stray> found;
  for (const ColumnCheck& check : c.difference.columns) {
    if (check.passed()) continue;
    const double rounding = 0.5 * golden.precision[golden.trace.find(check.name)];  // rounding error of the numbers in the
                                                                                    // golden's trace
    found.push_back({check.name, check.unit, check.ratio(), kOutside * check.band * check.scale + rounding, check.outside,
                     less(c.run.trace, golden.trace, check.name)});
  }
  const auto from = [](const report::Stray& stray) { return stray.from.value_or(std::numeric_limits<double>::infinity()); };
  std::stable_sort(found.begin(), found.end(), [&](const report::Stray& a, const report::Stray& b) {
    return std::pair(from(a), -a.ratio) < std::pair(from(b), -b.ratio);
  });
  return found;
}

/// Lines of a text without their indentation.
std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> all;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::size_t first = std::min(text.find_first_not_of(' ', at), end);
    if (first < end) all.push_back(text.substr(first, end - first));
    at = end + 1;
  }
  return all;
}

}  // namespace

std::string failure_page(const GoldenCase& c) {
  const Scenario& scenario = *c.scenario;
  GoldenProvenance then = c.golden->origin;
  GoldenProvenance now = golden_origin(scenario);
  for (GoldenProvenance* origin : {&then, &now}) origin->resolved = report::without_folders(origin->resolved, scenario);
  report::PageOverlay overlay;
  overlay.labels = {"golden", "now"};
  overlay.differs = lines(origin_changes(then, now, kAllSettings) + verdict_change(*c.golden, c.run, std::string::npos));
  overlay.strayed = fmt::format("{}. The golden is of approval {} ({})", outside(c.difference), c.golden->history.back().number,
                                c.golden->history.back().reason);
  for (const std::string& finding : c.difference.findings) overlay.strayed += "; " + finding;
  overlay.strays = strays(c);
  return report::page(report::overlaid(data_of(scenario, c.golden->run.trace, c.golden->origin.build),
                                       data_of(scenario, c.run.trace, now.build), overlay));
}

}  // namespace gaitlab::app
