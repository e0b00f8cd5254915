#include "report/plot/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/results.h"
#include "report/plot/svg.h"

namespace gaitlab::versus {

namespace {

constexpr double kWidth = 1000, kLeft = 90, kRight = 970;  // px
constexpr double kTitleHeight = 44, kLegendLine = 22, kHead = 40, kHeight = 380, kFoot = 56, kMark = 3.5;

constexpr report::Style kGrid{.stroke = report::colour::kPale};
constexpr report::Style kFine{.stroke = report::colour::kPale, .width = 0.4};
constexpr report::Style kFrame{.stroke = report::colour::kInk, .width = 1.2};
constexpr report::Style kGoodLine{.stroke = report::colour::kInk, .width = 1.2, .dash = "6 4"};

// Seven colours, then the same colours with dashes.
report::Style style_of(std::size_t contender) {
  constexpr std::array kColours{report::colour::kBlue,   report::colour::kVermillion, report::colour::kGreen,
                                report::colour::kPurple, report::colour::kSky,        report::colour::kOrange,
                                report::colour::kBlack};
  constexpr std::array kDashes{"", "7 3", "2 3"};
  return {.stroke = kColours[contender % kColours.size()],
          .width = 1.6,
          .dash = kDashes[contender / kColours.size() % kDashes.size()]};
}

/// Range of whole decades that contains all added values, which must be above 0.
struct Decades {
  int lo = 100, hi = -100;
  void add(double value) {
    lo = std::min(lo, static_cast<int>(std::floor(std::log10(value))));
    hi = std::max(hi, static_cast<int>(std::ceil(std::log10(value))));
  }
  void widen() {
    if (lo >= hi) hi = lo + 1;
  }
};

std::vector<std::string> unique(const RaceResults& results, std::string RacePoint::*name) {
  std::vector<std::string> names;
  for (const RacePoint& p : results.points) {
    if (p.ran() && std::ranges::find(names, p.*name) == names.end()) names.push_back(p.*name);
  }
  return names;
}

bool drawn(const RacePoint& p) { return p.ran() && p.error.worst > 0; }

class ScenarioPanel {
 public:
  ScenarioPanel(report::Svg& svg, const RaceResults& results, const std::string& scenario, double top) : svg_(svg), top_(top) {
    Decades speed;
    Decades error;
    error.add(kGood);
    for (const RacePoint& p : results.points) {
      if (p.scenario != scenario || !drawn(p)) continue;
      speed.add(p.speed());
      error.add(p.error.worst);
    }
    if (speed.lo > speed.hi) speed.add(1);
    speed.widen();
    error.widen();
    x_ = {static_cast<double>(speed.lo), static_cast<double>(speed.hi), kLeft, kRight};
    y_ = {static_cast<double>(error.lo), static_cast<double>(error.hi), top + kHeight, top};
    frame(speed, error, scenario);
  }

  void curve(const std::vector<const RacePoint*>& points, const report::Style& style) {
    std::vector<report::Point> line;
    line.reserve(points.size());
    for (const RacePoint* p : points) line.push_back({x_(std::log10(p->speed())), y_(std::log10(p->error.worst))});
    svg_.polyline(line, style);
    for (const report::Point& at : line) svg_.circle(at, kMark, {.stroke = style.stroke, .fill = style.stroke});
  }

 private:
  void frame(const Decades& speed, const Decades& error, const std::string& scenario) {
    svg_.text({kLeft, top_ - 12}, scenario + ": torque error of the worst joint (RMS over its peak)", {.bold = true});
    for (int decade = speed.lo; decade <= speed.hi; ++decade) {
      for (int digit = 1; digit < 10 && (digit == 1 || decade < speed.hi); ++digit) {
        const double x = x_(decade + std::log10(digit));
        svg_.line({x, top_}, {x, top_ + kHeight}, digit == 1 ? kGrid : kFine);
      }
      svg_.text({x_(decade), top_ + kHeight + 18}, fmt::format("{:g}", std::pow(10, decade)),
                {.anchor = report::Anchor::middle});
    }
    for (int decade = error.lo; decade <= error.hi; ++decade) {
      for (int digit = 1; digit < 10 && (digit == 1 || decade < error.hi); ++digit) {
        const double y = y_(decade + std::log10(digit));
        svg_.line({kLeft, y}, {kRight, y}, digit == 1 ? kGrid : kFine);
      }
      svg_.text({kLeft - 8, y_(decade) + 4.5}, fmt::format("{:g} %", 100 * std::pow(10, decade)),
                {.size = 11, .anchor = report::Anchor::end});
    }
    svg_.line({kLeft, y_(std::log10(kGood))}, {kRight, y_(std::log10(kGood))}, kGoodLine);
    svg_.rectangle({kLeft, top_}, kRight - kLeft, kHeight, kFrame);
    svg_.text({(kLeft + kRight) / 2, top_ + kHeight + 38}, "simulated seconds per second, one core",
              {.anchor = report::Anchor::middle});
  }

  report::Svg& svg_;
  double top_;
  report::Scale x_, y_;
};

}  // namespace

std::string plot(const RaceResults& results) {
  const std::vector<std::string> scenarios = unique(results, &RacePoint::scenario);
  const std::vector<std::string> contenders = unique(results, &RacePoint::contender);
  const std::size_t lines = (contenders.size() + 2) / 3;  // three entries per line
  double top = kTitleHeight + kLegendLine * static_cast<double>(lines) + kHead;
  constexpr std::string_view kTitle = "Cost of a simulated second, and error of its torques";
  report::Svg svg(kWidth, top + (kHeight + kFoot + kHead) * static_cast<double>(scenarios.size()) - kHead, kTitle);
  svg.text({kWidth / 2, 28}, kTitle, {.size = 18, .anchor = report::Anchor::middle, .bold = true});
  for (std::size_t c = 0; c < contenders.size(); ++c) {
    const std::size_t line = c / 3;
    const double x = kLeft + static_cast<double>(c % 3) * (kRight - kLeft) / 3;
    const double y = kTitleHeight + 14 + kLegendLine * static_cast<double>(line);
    svg.line({x, y - 4.5}, {x + 38, y - 4.5}, style_of(c));
    svg.text({x + 46, y}, contenders[c]);
  }
  for (const std::string& scenario : scenarios) {
    ScenarioPanel panel(svg, results, scenario, top);
    for (std::size_t c = 0; c < contenders.size(); ++c) {
      std::vector<const RacePoint*> points;
      for (const RacePoint& p : results.points) {
        if (p.scenario == scenario && p.contender == contenders[c] && drawn(p)) points.push_back(&p);
      }
      std::ranges::sort(points, {}, &RacePoint::step);
      panel.curve(points, style_of(c));
    }
    top += kHeight + kFoot + kHead;
  }
  return svg.finish();
}

}  // namespace gaitlab::versus
