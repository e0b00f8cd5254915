#include "report/page/plain_page.h"

#include <fmt/format.h>

#include "report/plot/svg.h"

namespace gaitlab::report {

namespace {

constexpr const char* kPlainStyle = R"(
:root { --ink: #1b2127; --muted: #5f6a74; --rule: #e1e6ea; --bg: #f3f5f7; --panel: #fff; --pass: #00694c; --fail: #b3261e; --open: #4a5661; color-scheme: light dark; }
@media (prefers-color-scheme: dark) { :root { --ink: #e9edf1; --muted: #97a4b0; --rule: #262d35; --bg: #0d1013; --panel: #14181d; --pass: #3fd0a2; --fail: #ff7a70; --open: #b4c0cb; } }
body { margin: 0; padding: 24px; background: var(--bg); color: var(--ink); font: 14px/1.45 Inter, ui-sans-serif, system-ui, "Segoe UI", Roboto, "Liberation Sans", Arial, sans-serif; font-variant-numeric: tabular-nums; }
h1 { font-size: 20px; margin: 0 0 4px; }
p { margin: 0 0 16px; color: var(--muted); }
.wide { border-radius: 10px; padding: 4px 0 12px; overflow-x: auto; background: linear-gradient(90deg, var(--panel) 40%, transparent) local, linear-gradient(270deg, var(--panel) 40%, transparent) 100% 0 local, radial-gradient(farthest-side at 0 50%, var(--muted), transparent) scroll, radial-gradient(farthest-side at 100% 50%, var(--muted), transparent) 100% 0 scroll; background-color: var(--panel); background-repeat: no-repeat; background-size: 48px 100%, 48px 100%, 12px 100%, 12px 100%; }
table { border-collapse: collapse; width: 100%; }
th, td { padding: 10px 6px; border-bottom: 1px solid var(--rule); text-align: right; vertical-align: middle; white-space: nowrap; }
th { font-weight: 500; color: var(--muted); vertical-align: bottom; }
th:first-child, td:first-child, .l { text-align: left; }
th:first-child, td:first-child { padding-left: 16px; position: sticky; left: 0; background: var(--panel); }
th:last-child, td:last-child { padding-right: 16px; }
small { display: block; color: var(--muted); font-size: 12.5px; }
)";

}  // namespace

std::string plain_page(const std::string& title, const std::string& style, const std::string& body) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src 'unsafe-inline'\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n"
      "<style>{}{}</style>\n</head>\n<body>\n{}</body>\n</html>\n",
      xml_escaped(title), kPlainStyle, style, body);
}

}  // namespace gaitlab::report
