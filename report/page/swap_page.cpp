#include "report/page/swap_page.h"

#include <fmt/format.h>

#include <algorithm>

#include "report/page/heat_image.h"
#include "report/plot/svg.h"

namespace gaitlab::report {

namespace {

constexpr std::size_t kPictureColumns = 240;  // px of a picture

constexpr const char* kStyle = R"(
:root { --ink: #1b2127; --muted: #5f6a74; --rule: #e1e6ea; --bg: #f3f5f7; --panel: #fff; --pass: #00694c; --fail: #b3261e; --open: #4a5661; color-scheme: light dark; }
@media (prefers-color-scheme: dark) { :root { --ink: #e9edf1; --muted: #97a4b0; --rule: #262d35; --bg: #0d1013; --panel: #14181d; --pass: #3fd0a2; --fail: #ff7a70; --open: #b4c0cb; } }
body { margin: 0; padding: 24px; background: var(--bg); color: var(--ink); font: 14px/1.45 Inter, ui-sans-serif, system-ui, "Segoe UI", Roboto, "Liberation Sans", Arial, sans-serif; font-variant-numeric: tabular-nums; }
h1 { font-size: 20px; margin: 0 0 4px; }
p { margin: 0 0 16px; color: var(--muted); }
main { background: var(--panel); border-radius: 10px; padding: 4px 16px 12px; overflow-x: auto; }
table { border-collapse: collapse; width: 100%; }
th, td { padding: 10px 8px; border-bottom: 1px solid var(--rule); text-align: right; vertical-align: middle; white-space: nowrap; }
th { font-weight: 500; color: var(--muted); vertical-align: bottom; }
th:first-child, td:first-child, th.l, td.l { text-align: left; }
td.l { white-space: normal; min-width: 150px; max-width: 340px; }
a { color: inherit; font-weight: 650; text-underline-offset: 3px; }
b.pass { color: var(--pass); } b.fail { color: var(--fail); } b.open { color: var(--open); }
small { display: block; color: var(--muted); font-size: 12.5px; }
img { display: block; width: 200px; height: 64px; image-rendering: pixelated; border-radius: 3px; }
)";

/// A minus sign where a number begins with a hyphen.
std::string typeset(const std::string& text) {
  std::string set;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool minus =
        text[i] == '-' && i + 1 < text.size() && text[i + 1] >= '0' && text[i + 1] <= '9' && (i == 0 || text[i - 1] == ' ');
    set += minus ? "−" : std::string(1, text[i]);
  }
  return xml_escaped(set);
}

std::string verdict_cell(const Verdict& verdict) {
  const bool bad = verdict.word == Word::infeasible || verdict.word == Word::failed;
  std::string why = verdict.word == Word::feasible && !verdict.rests_on.empty() ? "over " + verdict.rests_on : verdict.why();
  if (verdict.count(CheckStatus::warn) > 0)
    why += fmt::format("{}{} warning{}", why.empty() ? "" : "; ", verdict.count(CheckStatus::warn),
                       verdict.count(CheckStatus::warn) == 1 ? "" : "s");
  const char* const mark = bad ? "fail" : verdict.word == Word::feasible ? "pass" : "open";
  const char* const sign = bad ? "✕" : verdict.word == Word::feasible ? "✓" : "?";
  return fmt::format("<b class=\"{}\">{} {}</b><small>{}</small>", mark, sign, name_of(verdict.word), xml_escaped(why));
}

}  // namespace

std::string swap_page(const std::string& name, const std::vector<SwapEntry>& entries) {
  const auto columns = placed(&SummaryNumber::swap);
  std::string head =
      "<th scope=\"col\">CPG</th><th scope=\"col\" class=\"l\">verdict</th>"
      "<th scope=\"col\" class=\"l\">every joint over time<small>of its motor: pale 0, dark red all</small></th>";
  for (const SummaryNumber* number : columns)
    head += fmt::format("<th scope=\"col\">{}<small>{}</small></th>", xml_escaped(number->swap.head),
                        xml_escaped(number->swap.under));
  std::string rows;
  for (const SwapEntry& entry : entries) {
    const std::string picture = heat_image(entry.named.run.record, kPictureColumns);
    rows += fmt::format("<tr><td><a href=\"{}\">{}</a></td><td class=\"l\">{}</td><td class=\"l\">{}</td>",
                        xml_escaped(entry.page), xml_escaped(entry.named.name), verdict_cell(entry.verdict),
                        picture.empty() ? ""
                                        : fmt::format("<img src=\"{}\" alt=\"load of every joint over time under {}\">",
                                                      picture, xml_escaped(entry.named.name)));
    for (const SummaryNumber* number : columns) {
      const bool known = entry.named.run.summary.outcome.done();
      rows += fmt::format("<td>{}</td>", known ? typeset(number->swap.cell(entry.named.run)) : "");
    }
    rows += "</tr>\n";
  }
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src 'unsafe-inline'\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{0}: CPGs side by side</title>\n"
      "<style>{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n<p>under {2} CPGs; a name leads to the page of its run</p>\n<main>\n"
      "<table>\n<thead><tr>{3}</tr></thead>\n<tbody>\n{4}</tbody>\n</table>\n</main>\n</body>\n</html>\n",
      xml_escaped(name), kStyle, entries.size(), head, rows);
}

}  // namespace gaitlab::report
