#include "report/page/swap_page.h"

#include <fmt/format.h>

#include <algorithm>

#include "report/figures/run/run_views.h"
#include "report/figures/run/views.h"
#include "report/page/heat_image.h"
#include "report/page/packing.h"
#include "report/page/plain_page.h"
#include "report/plot/svg.h"
#include "report/verdict/numbers/number_texts.h"

namespace gaitlab::report {

namespace {

// Width of a picture, px. It equals the width on the page, so that no pixel is divided.
constexpr std::size_t kPictureColumns = 240;
constexpr double kRobotWidth = 560;  // px

constexpr const char* kStyle = R"(td.l { white-space: normal; min-width: 150px; max-width: 340px; }
a { color: inherit; font-weight: 650; text-underline-offset: 3px; }
b.pass { color: var(--pass); } b.fail { color: var(--fail); } b.open { color: var(--open); }
img { display: block; border-radius: 3px; }
td img { image-rendering: pixelated; }
td:last-child small { white-space: normal; min-width: 86px; }
.robot { max-width: 100%; margin: 0 0 16px; border-radius: 10px; }
)";

/// Replaces a hyphen before a number by a typographic minus sign.
std::string typeset(const std::string& text) {
  std::string set;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool minus =
        text[i] == '-' && i + 1 < text.size() && text[i + 1] >= '0' && text[i + 1] <= '9' && (i == 0 || text[i - 1] == ' ');
    set += minus ? "−" : std::string(1, text[i]);
  }
  return xml_escaped(set);
}

/// Height of a picture, px: a whole number for each joint, together about 64.
std::size_t picture_height(std::size_t joints) { return joints * std::max<std::size_t>(1, (64 + joints / 2) / joints); }

using Run = const RunData&;

/// A number of the table of `swap`. A cell with two numbers becomes two columns.
struct Shown {
  const char *head, *under;
  std::string (*text)(Run run);
  std::string (*small)(Run run) = nullptr;  ///< number below it in small text
};

/// Text of a number, in which 0 has no sign.
std::string fixed(double value, int digits, bool sign = false) {
  std::string text = sign ? fmt::format("{:+.{}f}", value, digits) : fmt::format("{:.{}f}", value, digits);
  return text.find_first_not_of("+-0.") == std::string::npos ? text.substr(text.find('0')) : text;
}

const JudgedJoint& most_loaded(Run run) { return run.summary.judged.joints[run.summary.most_loaded()]; }

std::string peak_text(Run run) { return has_motors(run) ? texts::thousandths(most_loaded(run).torque_peak) : "-"; }
std::string peak_joint(Run run) { return has_motors(run) ? run.scenario.robot->joints[run.summary.most_loaded()].name : ""; }

std::string cycle_text(Run run) {
  return run.summary.limit_cycle.found ? fmt::format("{:.4g} s", run.summary.limit_cycle.period) : "none found";
}
std::string cycle_small(Run run) {
  const MotionCycle& cycle = run.summary.limit_cycle;
  return cycle.found ? fmt::format("from {:.3g} s, to {}", cycle.from, texts::percent(cycle.error)) : "";
}

constexpr Shown kShown[] = {
    {"speed", "m/s", [](Run run) { return fixed(run.summary.speed, 4); }},
    {"travel x", "m", [](Run run) { return fixed(run.summary.displacement_x, 4, true); }},
    {"travel y", "m", [](Run run) { return fixed(run.summary.displacement_y, 4, true); }},
    {"cost of transport", "electrical", [](Run run) { return fmt::format("{:.3g}", run.summary.cost_electrical); }},
    {"", "mechanical", [](Run run) { return fmt::format("{:.3g}", run.summary.cost_mechanical); }},
    {"peak torque", "N m", peak_text, peak_joint},
    {"at a limit", "share", texts::saturated_cell},
    {"tracking error", "rad", texts::tracking_cell},
    {"limit cycle", "", cycle_text, cycle_small},
};

/// Picture of the robot at the end of the first completed run, from the side of its path. Empty if no run was completed.
std::string robot_picture(const std::vector<SwapEntry>& entries) {
  for (const SwapEntry& entry : entries) {
    const RunData& run = entry.named.run;
    if (run.scenario.robot->joints.empty() || !run.summary.outcome.done() || run.record.rows() == 0 ||
        !run.record.has_states(*run.scenario.robot))
      continue;
    const Sight from = sight(run.scenario, run.record);
    ViewsInput input = views_input(run.scenario, run.record, from);
    View view = view_at(run.scenario, run.record, from, run.record.rows() - 1, 0);
    view.joint.reset();
    input.views.push_back(std::move(view));
    const Edges edges{60, kRobotWidth - 16};
    const double height = views_height(input, edges) + 8;
    Svg picture(kRobotWidth, height);
    draw_views(picture, input, edges, 4);
    return fmt::format(
        "<img class=\"robot\" width=\"{:.0f}\" height=\"{:.0f}\" src=\"data:image/svg+xml;base64,{}\" "
        "alt=\"the robot at the end of the run under {}\">\n",
        kRobotWidth, height, base64(picture.finish()), xml_escaped(entry.named.name));
  }
  return "";
}

std::string verdict_cell(const Verdict& verdict) {
  const bool bad = verdict.word == Word::infeasible || verdict.word == Word::failed;
  std::string why = verdict.word == Word::feasible && !verdict.rests_on.empty() ? "over " + verdict.rests_on : verdict.why();
  if (verdict.count(CheckStatus::warn) > 0) {
    why += fmt::format("{}{} warning{}", why.empty() ? "" : "; ", verdict.count(CheckStatus::warn),
                       verdict.count(CheckStatus::warn) == 1 ? "" : "s");
  }
  const char* const mark = bad ? "fail" : verdict.word == Word::feasible ? "pass" : "open";
  const char* const sign = bad ? "✕" : verdict.word == Word::feasible ? "✓" : "?";
  return fmt::format("<b class=\"{}\">{} {}</b><small>{}</small>", mark, sign, name_of(verdict.word), xml_escaped(why));
}

}  // namespace

std::string swap_page(const std::string& name, const std::vector<SwapEntry>& entries) {
  std::string head =
      "<th scope=\"col\">CPG</th><th scope=\"col\" class=\"l\">verdict</th>"
      "<th scope=\"col\" class=\"l\">every joint over time<small>share of its motor's torque: pale 0, dark red "
      "all</small></th>";
  for (const Shown& one : kShown) head += fmt::format("<th scope=\"col\">{}<small>{}</small></th>", one.head, one.under);
  std::string rows;
  for (const SwapEntry& entry : entries) {
    const std::string picture = heat_image(entry.named.run.record, kPictureColumns);
    rows += fmt::format("<tr><td><a href=\"{}\">{}</a></td><td class=\"l\">{}</td><td class=\"l\">{}</td>",
                        xml_escaped(entry.page), xml_escaped(entry.named.name), verdict_cell(entry.verdict),
                        picture.empty() ? ""
                                        : fmt::format("<img width=\"{}\" height=\"{}\" src=\"{}\" alt=\"load of every "
                                                      "joint over time under {}\">",
                                                      kPictureColumns, picture_height(entry.named.run.record.joints.size()),
                                                      picture, xml_escaped(entry.named.name)));
    const bool known = entry.named.run.summary.outcome.done();
    for (const Shown& one : kShown) {
      const std::string small = known && one.small != nullptr ? one.small(entry.named.run) : "";
      rows += fmt::format("<td>{}{}</td>", known ? typeset(one.text(entry.named.run)) : "",
                          small.empty() ? "" : "<small>" + typeset(small) + "</small>");
    }
    rows += "</tr>\n";
  }
  return plain_page(name + ": CPGs side by side", kStyle,
                    fmt::format("<h1>{}</h1>\n<p>under {} CPGs; a name leads to the page of its run</p>\n{}"
                                "<main class=\"wide\" tabindex=\"0\" aria-label=\"table of the CPGs\">\n"
                                "<table>\n<thead><tr>{}</tr></thead>\n<tbody>\n{}</tbody>\n</table>\n</main>\n",
                                xml_escaped(name), entries.size(), robot_picture(entries), head, rows));
}

}  // namespace gaitlab::report
