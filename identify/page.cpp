#include "identify/page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>

#include "core/build_id.h"
#include "core/scenario/change_section.h"
#include "core/settings/wording.h"
#include "identify/servo_text.h"
#include "identify/tables.h"
#include "report/figures/run/log_figure.h"
#include "report/page/plain_page.h"
#include "report/plot/svg.h"

namespace gaitlab::identify {

namespace {

using report::xml_escaped;

constexpr const char* kStyle =
    R"(:root { --log: #3cb795; --run: #005c92; --other: #c84f00; --line: #aab4bd; --off: #e4e7ea; --strong: 200, 79, 0; }
@media (prefers-color-scheme: dark) { :root { --log: #1d8a67; --run: #8fd0ff; --other: #ff8a4c; --line: #55616d; --off: #262c33; --strong: 255, 138, 76; } }
body { overflow-wrap: anywhere; }
h2 { font-size: 16px; margin: 24px 0 8px; }
th, td { padding: 7px 10px; overflow-wrap: normal; }
th { white-space: normal; }
@media (max-width: 600px) {
  body { padding: 12px; } th, td { padding: 6px 3px; font-size: 12px; } td { white-space: normal; }
  th:first-child, td:first-child { padding-left: 10px; } th:last-child, td:last-child { padding-right: 10px; }
}
ul { margin: 0; padding-left: 20px; max-width: 110ch; }
li { margin: 0 0 4px; }
details { margin: 16px 0 0; }
pre { overflow-x: auto; white-space: pre-wrap; padding: 12px 16px; border-radius: 10px; background: var(--panel); }
.tables { display: flex; flex-wrap: wrap; gap: 16px; align-items: flex-start; }
.tables .wide { max-width: 100%; }
.logs { display: grid; gap: 16px; grid-template-columns: repeat(auto-fill, minmax(min(100%, 400px), 1fr)); }
figure { margin: 0; padding: 12px 10px 6px; border-radius: 10px; background: var(--panel); border-top: 4px solid transparent; }
figure.out { border-color: var(--muted); }
figcaption { padding: 0 6px; }
figcaption i { float: right; color: var(--muted); }
svg { display: block; width: 100%; height: auto; font-family: inherit; }
.foot { margin: 16px 0 0; }
.legend span { display: inline-block; margin-right: 18px; }
.legend b { display: inline-block; width: 26px; margin-right: 7px; vertical-align: middle; }
)";

/// The canvas has the colours of paper; those of the theme take their place.
std::string colours() {
  struct Colour {
    std::string_view on_paper, on_page;
  };
  constexpr Colour kStrokes[] = {{report::log_colour::kLog, "log"},     {report::log_colour::kRun, "run"},
                                 {report::log_colour::kOther, "other"}, {report::colour::kInk, "line"},
                                 {report::colour::kPale, "rule"},       {report::colour::kGrey, "line"}};
  constexpr Colour kFills[] = {
      {report::colour::kInk, "muted"}, {report::colour::kWhite, "panel"}, {report::log_colour::kOff, "off"}};
  std::string text;
  for (const Colour& one : kStrokes)
    text += fmt::format("svg [stroke=\"{}\"] {{ stroke: var(--{}); }}\n", one.on_paper, one.on_page);
  for (const Colour& one : kFills) text += fmt::format("svg [fill=\"{}\"] {{ fill: var(--{}); }}\n", one.on_paper, one.on_page);
  return text;
}

/// A name that a narrow column can break behind dots and underlines.
std::string breakable(const std::string& name) {
  std::string text;
  for (const char c : xml_escaped(name)) {
    text += c;
    if (c == '.' || c == '_' || c == '/') text += "<wbr>";
  }
  return text;
}

/// HTML of a table. `style` is the attribute of a cell by its text.
std::string table(const std::string& name, const Rows& rows, std::string (*style)(const std::string&) = nullptr) {
  std::string text = fmt::format("<div class=\"wide\" tabindex=\"0\" aria-label=\"{}\">\n<table>\n<thead><tr>", name);
  for (const std::string& head : rows[0]) text += fmt::format("<th scope=\"col\">{}</th>", breakable(head));
  text += "</tr></thead>\n<tbody>\n";
  for (std::size_t i = 1; i < rows.size(); ++i) {
    text += fmt::format("<tr><th scope=\"row\">{}</th>", breakable(rows[i][0]));
    for (std::size_t j = 1; j < rows[i].size(); ++j)
      text += fmt::format("<td{}>{}</td>", style == nullptr ? "" : style(rows[i][j]), xml_escaped(rows[i][j]));
    text += "</tr>\n";
  }
  return text + "</tbody>\n</table>\n</div>\n";
}

/// Background of a correlation: the stronger, the darker.
std::string shade(const std::string& cell) {
  const double share = std::abs(std::strtod(cell.c_str(), nullptr));
  return share > 0 ? fmt::format(" style=\"background: rgba(var(--strong), {:.2f})\"", 0.6 * share * share) : "";
}

std::string section(const char* title, const std::string& content) {
  return content.empty() ? "" : fmt::format("<h2>{}</h2>\n{}", title, content);
}

/// SVG of the quantities of a log with the runs of bench and fit.
std::string figure(const BenchLog& log, const Compared& before, const Compared& after, std::span<const Logged> kinds) {
  const MeasuredLog& measured = *log.scenario.measured.log;
  std::vector<report::LogCurves> curves;
  std::vector<std::string> names;
  for (const Logged kind : kinds) {
    const LoggedKind& of = logged_kinds()[static_cast<std::size_t>(kind)];
    names.emplace_back(of.key);
    for (std::size_t j = 0; j < measured.joints.size(); ++j) {
      const std::vector<double>& values = measured.joints[j].of(kind);
      if (values.empty()) continue;
      std::string title = measured.joints.size() == 1 ? of.key : log.scenario.robot->joints[measured.joints[j].joint].name;
      if (measured.joints.size() > 1 && kinds.size() > 1) title += fmt::format(" {}", of.key);
      const std::string unit = of.unit;
      if (!unit.empty()) title += ", " + unit;
      report::LogCurves& one = curves.emplace_back(
          report::LogCurves{title, unit, 1, values, after.simulated[j].of(kind), before.simulated[j].of(kind)});
      if (unit.empty()) one.of_difference = "difference";
      if (kind != Logged::angle) continue;
      one.of_difference = "mrad";
      one.scale = 1e-3;
    }
  }
  std::vector<report::LogStretch> off;
  for (const FaultSpan& fault : fault_spans(log.scenario)) {
    if (fault.kind == FaultKind::open && fault.joint == measured.joints[0].joint) off.push_back({fault.from, fault.to});
  }
  const std::string title = fmt::format("{} of {}, by the log and by both runs", fmt::join(names, " and "), log.name);
  const std::string svg = report::log_figure(title, measured.t, off, curves);
  return svg.substr(svg.find("<svg"));
}

class Page {
 public:
  Page(const Identified& made, const std::vector<BenchLog>& logs, const std::vector<Key>& keys)
      : made_(made), logs_(logs), keys_(keys), origins_(origins_of(logs)) {}

  [[nodiscard]] std::string text(const std::vector<std::string>& limits, const std::string& result) const {
    const std::string& name = logs_[0].scenario.name;
    std::string body =
        fmt::format("<h1>{}: identified from logs</h1>\n<p>{}; {} of {} starts end within 2 % of the best</p>\n",
                    xml_escaped(name), xml_escaped(long_text(identification(made_, logs_))), made_.agreed, made_.starts);
    body += "<div class=\"tables\">\n" + table("keys", key_rows(made_, keys_)) + table("errors", error_rows(made_, logs_)) +
            "</div>\n";
    std::string list;
    for (const std::string& one : limits) list += fmt::format("<li>{}</li>\n", xml_escaped(one));
    body += section("Limits of these logs", list.empty() ? "" : "<ul>\n" + list + "</ul>\n");
    if (const Rows rows = correlation_rows(made_, keys_); !rows.empty())
      body += section("Correlation of the keys", "<div class=\"tables\">\n" + table("correlations", rows, shade) + "</div>\n");
    body += fmt::format("<details><summary>The result as text</summary><pre>{}</pre></details>\n", lines_escaped(result));
    body += section("Logs, worst first", legend());
    body += "<div class=\"logs\">\n";
    const std::vector<std::size_t> order = worst_first(made_);
    const Rows rows = log_rows(made_, logs_);
    for (std::size_t i = 0; i < order.size(); ++i) body += card(order[i], rows[i + 1]);
    body += fmt::format("</div>\n<p class=\"foot\">gaitlab {}</p>\n", xml_escaped(build_id()));
    return report::plain_page(name + ": identified from logs", kStyle + colours(), body);
  }

 private:
  static std::string lines_escaped(const std::string& text) {
    std::string escaped;
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      escaped += xml_escaped(text.substr(at, end - at)) + "\n";
      at = end + 1;
    }
    return escaped;
  }

  [[nodiscard]] std::string legend() const {
    std::string text = "<p class=\"legend\">";
    const auto add = [&](const char* colour, int height, const char* what) {
      text += fmt::format("<span><b style=\"background: var(--{}); height: {}px\"></b>{}</span>", colour, height, what);
    };
    add("log", 4, "log");
    add("run", 2, "identified");
    add("other", 1, "bench");
    add("off", 14, "without torque");
    text += "<span>below: simulated - measured</span>";
    if (origins_.size() == 1) text += fmt::format("<br>\nlogs: {}", xml_escaped(origins_[0]));
    return text + "</p>\n";
  }

  /// `row` is the log's row of log_rows().
  [[nodiscard]] std::string card(std::size_t log, const std::vector<std::string>& row) const {
    const BenchLog& of = logs_[log];
    std::string text = of.held_out ? "<figure class=\"out\"><figcaption><i>held out</i>" : "<figure><figcaption>";
    text += fmt::format("<b>{}</b>", xml_escaped(of.name));
    text += fmt::format("<small>{} identified, {} bench", xml_escaped(row[3]), xml_escaped(row[2]));
    if (row[4] != "-") text += fmt::format("; at the limit {} of the time, {} in the log", row[4], row[5]);
    if (!of.of_table.empty()) text += fmt::format("; {}", xml_escaped(fmt::format("{}", fmt::join(of.of_table, ", "))));
    if (origins_.size() > 1) text += fmt::format("<br>{}", xml_escaped(of.scenario.measured.source));
    return text + "</small></figcaption>\n" + figure(of, made_.before[log], made_.after[log], made_.kinds) + "</figure>\n";
  }

  const Identified& made_;
  const std::vector<BenchLog>& logs_;
  const std::vector<Key>& keys_;
  std::vector<std::string> origins_;
};

}  // namespace

std::string identify_page(const Identified& made, const std::vector<BenchLog>& logs, const std::vector<Key>& keys,
                          const std::vector<std::string>& limits, const std::string& result) {
  return Page(made, logs, keys).text(limits, result);
}

}  // namespace gaitlab::identify
