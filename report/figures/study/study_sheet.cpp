#include "report/figures/study/study_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/math/functions.h"

namespace gaitlab::report {

namespace {

constexpr Style kCross{.stroke = colour::kVermillion, .width = 1.4};

/// Bytes of a text that ends no UTF-8 character in its middle.
std::size_t whole_characters(std::string_view text, std::size_t bytes) {
  while (bytes > 0 && bytes < text.size() && (static_cast<unsigned char>(text[bytes]) & 0xC0U) == 0x80U) --bytes;
  return std::min(bytes, text.size());
}

}  // namespace

double power_of_ten(double exponent) { return math::exp(exponent * math::log(10)); }

double log10_of(double value) { return math::log(value) / math::log(10); }

AxisMarks axis_marks(const Bounds& bounds, bool log, int count, double wider) {
  if (bounds.empty()) return {};
  const double wide = bounds.hi - bounds.lo;
  const auto number = [&](double at) { return with_minus(fmt::format("{:.6g}", log ? power_of_ten(at) : at)); };
  if (!(wide > 0)) return {bounds.lo - 0.5, bounds.lo + 0.5, {{bounds.lo, number(bounds.lo)}}};
  AxisMarks marks{bounds.lo - wider * wide, bounds.hi + wider * wide, {}};
  if (!log) {
    const Ticks ticks = ticks_within(marks.lo, marks.hi, count);
    for (const double value : ticks.values()) marks.labels.emplace_back(value, with_minus(ticks.label(value)));
    return marks;
  }
  constexpr double kManyDecades = 3;
  constexpr double kSlack = 1e-9;
  const auto within = [&](double at) { return at >= marks.lo - kSlack && at <= marks.hi + kSlack; };
  for (int decade = static_cast<int>(std::floor(marks.lo)); decade <= marks.hi; ++decade) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double at = log10_of(digit) + decade;
      if (within(at) && (wide < kManyDecades || digit < 2)) marks.labels.emplace_back(at, number(at));
    }
  }
  constexpr std::size_t kFew = 2;
  if (marks.labels.size() >= kFew) return marks;
  // Less than a factor of 5: round numbers as of a linear axis.
  marks.labels.clear();
  const Ticks ticks = ticks_within(power_of_ten(marks.lo), power_of_ten(marks.hi), count);
  for (const double value : ticks.values()) marks.labels.emplace_back(log10_of(value), with_minus(ticks.label(value)));
  return marks;
}

void draw_frame(Canvas& canvas, const PlotArea& area, const AxisMarks& x, const AxisMarks& y, const FrameLook& look) {
  const Scale across{x.lo, x.hi, area.left, area.right};
  const Scale up{y.lo, y.hi, area.bottom, area.top};
  for (const auto& [at, label] : x.labels) {
    if (look.grid) canvas.line({across(at), area.top}, {across(at), area.bottom}, kGridLine);
    canvas.line({across(at), area.bottom}, {across(at), area.bottom + 4}, kAxisLine);
    if (look.below_labels) canvas.text({across(at), area.bottom + 18}, label, {.size = 11, .anchor = Anchor::middle});
  }
  for (const auto& [at, label] : y.labels) {
    if (look.grid) canvas.line({area.left, up(at)}, {area.right, up(at)}, kGridLine);
    canvas.line({area.left - 4, up(at)}, {area.left, up(at)}, kAxisLine);
    if (look.left_labels) canvas.text({area.left - 8, up(at) + 4}, label, {.size = 11, .anchor = Anchor::end});
  }
  canvas.rectangle({area.left, area.top}, area.right - area.left, area.bottom - area.top, kAxisLine);
}

std::string shortened(const std::string& name) {
  constexpr std::size_t kMost = 32;
  if (name.size() <= kMost) return name;
  const std::size_t head = whole_characters(name, kMost / 2 - 2);
  const std::size_t tail = whole_characters(name, name.size() - (kMost / 2 - 1));
  return name.substr(0, head) + "..." + name.substr(tail);
}

void draw_sheet_title(Canvas& canvas, const std::string& title) {
  constexpr double kLargest = 17;
  constexpr double kSmallest = 12;
  constexpr double kBoldWider = 1.1;
  const double room = kSheetWidth - 40;
  double size = kLargest;
  while (size > kSmallest && kBoldWider * text_width(title, size) > room) size -= 1;
  std::string text = title;
  while (text.size() > 3 && kBoldWider * text_width(text, size) > room)
    text = text.substr(0, whole_characters(text, text.size() - 4)) + "...";
  canvas.text({20, 30}, text, {.size = size, .bold = true});
}

void draw_sheet_note(Canvas& canvas, const std::string& note, double y) {
  constexpr double kSize = 11;
  std::vector<std::string> lines(1);
  for (std::size_t at = 0; at < note.size();) {
    const std::size_t end = std::min(note.find(' ', at), note.size());
    const std::string word = note.substr(at, end - at);
    if (!lines.back().empty() && text_width(lines.back() + " " + word, kSize) > kSheetWidth - 40) lines.emplace_back();
    lines.back() += (lines.back().empty() ? "" : " ") + word;
    at = end + 1;
  }
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const double up = 14 * static_cast<double>(lines.size() - 1 - k);
    canvas.text({20, y - up}, lines[k], {.size = kSize, .fill = "#666666"});
  }
}

std::string shade(double share) {
  constexpr std::array<double, 3> kPaleEnd{222, 235, 247};
  constexpr std::array<double, 3> kDarkEnd{8, 48, 107};
  std::array<int, 3> mixed{};
  for (std::size_t c = 0; c < 3; ++c)
    mixed[c] = static_cast<int>(std::lround(kPaleEnd[c] + std::clamp(share, 0.0, 1.0) * (kDarkEnd[c] - kPaleEnd[c])));
  return fmt::format("#{:02X}{:02X}{:02X}", mixed[0], mixed[1], mixed[2]);
}

void draw_shades(Canvas& canvas, const PlotArea& area, double lo, double hi, std::string_view title) {
  if (!(lo <= hi)) return;
  const double left = area.right + 28;
  constexpr double kBarWide = 16;
  constexpr int kSteps = 64;
  const double height = area.bottom - area.top;
  const bool flat = !(hi > lo);
  for (int k = 0; k < kSteps; ++k) {
    const double top = area.bottom - height * (k + 1) / kSteps;
    canvas.rectangle({left, top}, kBarWide, height / kSteps + 0.5, {.fill = shade(flat ? 0.5 : (k + 0.5) / kSteps)});
  }
  canvas.rectangle({left, area.top}, kBarWide, height, kAxisLine);
  double widest = 0;
  const auto label = [&](double y, const std::string& text) {
    canvas.text({left + kBarWide + 6, y + 4}, text, {.size = 11});
    widest = std::max(widest, text_width(text, 11));
  };
  if (flat) {
    label((area.top + area.bottom) / 2, with_minus(fmt::format("{:.4g}", lo)));
  } else {
    const Ticks ticks = ticks_within(lo, hi, 6);
    const Scale y{lo, hi, area.bottom, area.top};
    for (const double value : ticks.values()) label(y(value), with_minus(ticks.label(value)));
  }
  canvas.text({std::min(left + kBarWide + widest + 26, kSheetWidth - 10), (area.top + area.bottom) / 2}, title,
              {.anchor = Anchor::middle, .upwards = true});
}

void draw_cross(Canvas& canvas, Point centre, double half) {
  canvas.line({centre.x - half, centre.y - half}, {centre.x + half, centre.y + half}, kCross);
  canvas.line({centre.x - half, centre.y + half}, {centre.x + half, centre.y - half}, kCross);
}

void draw_ring(Canvas& canvas, Point centre) {
  canvas.circle(centre, kMark + 4, {.stroke = colour::kWhite, .width = 5});
  canvas.circle(centre, kMark + 4, kBestMark);
}

}  // namespace gaitlab::report
