#include "report/figures/study/study_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/settings/wording.h"

namespace gaitlab::report {

namespace {

constexpr Style kCross{.stroke = colour::kVermillion, .width = 1.4};

/// Largest number of bytes, at most `bytes`, that does not split a UTF-8 character.
std::size_t whole_characters(std::string_view text, std::size_t bytes) {
  while (bytes > 0 && bytes < text.size() && (static_cast<unsigned char>(text[bytes]) & 0xC0U) == 0x80U) --bytes;
  return std::min(bytes, text.size());
}

}  // namespace

std::size_t Bins::of(double value) const {
  const double share = hi > lo ? std::clamp((value - lo) / (hi - lo), 0.0, 1.0) : 0;
  return std::min(static_cast<std::size_t>(share * static_cast<double>(count)), count - 1);
}

double Bins::at(std::size_t bin, double share) const {
  return lo + (static_cast<double>(bin) + share) / static_cast<double>(count) * (hi - lo);
}

std::string csv_cell(double value) { return std::isfinite(value) ? number_text(value) : ""; }

std::string shortened(const std::string& name) {
  constexpr std::size_t kMost = 32;
  if (name.size() <= kMost) return name;
  const std::size_t head = whole_characters(name, kMost / 2 - 2);
  const std::size_t tail = whole_characters(name, name.size() - (kMost / 2 - 1));
  return name.substr(0, head) + "..." + name.substr(tail);
}

void draw_sheet_title(Canvas& canvas, const std::string& title) {
  constexpr double kSmallest = 12;
  const double room = kSheetWidth - 40;
  std::string text = title;
  while (text.size() > 3 && fitting_size(text, kSmallest, 0, room) < kSmallest)
    text = text.substr(0, whole_characters(text, text.size() - 4)) + "...";
  canvas.text({20, 30}, text, {.size = fitting_size(text, 17, kSmallest, room), .bold = true});
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
  constexpr std::array<Rgb, 2> kPaleToDark{{{222, 235, 247}, {8, 48, 107}}};
  return ramp(kPaleToDark, share);
}

Bounds shown_range(const Bounds& kept, const Bounds& all) {
  constexpr double kBeyond = 0.25;
  if (!(kept.lo < kept.hi)) return all;
  const double room = kBeyond * (kept.hi - kept.lo);
  return {std::max(all.lo, kept.lo - room), std::min(all.hi, kept.hi + room)};
}

void draw_shades(Canvas& canvas, const PlotArea& area, const Bounds& bounds, const Bounds& all, const std::string& title) {
  if (bounds.empty()) return;
  constexpr double kGap = 28;      // px
  constexpr double kBarWide = 16;  // px
  const PlotArea bar{area.right + kGap, area.right + kGap + kBarWide, area.top, area.bottom};
  std::vector<std::string> shades;
  for (int k = 0; k < 64; ++k) shades.push_back(shade(bounds.hi > bounds.lo ? (k + 0.5) / 64 : 0.5));
  const Ticks ticks = ticks_over(bounds, false, 6);
  const double away = std::min(widest_text(ticks, 11) + 26, kSheetWidth - 10 - bar.right);
  draw_colours(canvas, bar, shades, {.ticks = ticks, .title = title, .away = away});
  constexpr double kTip = 12;  // px
  const double middle = (bar.left + bar.right) / 2;
  const auto beyond = [&](double edge, double tip, const std::string& colour, const std::string& text) {
    const std::vector<Polygon> arrow{{{bar.left, edge}, {bar.right, edge}, {middle, tip}}};
    canvas.polygons(arrow, {.stroke = kAxisLine.stroke, .fill = colour, .width = kAxisLine.width});
    canvas.text({bar.right + 8, tip + (tip < edge ? 2 : 6)}, text, {.size = 11});
  };
  if (all.hi > bounds.hi) beyond(bar.top, bar.top - kTip, shade(1), "to " + with_minus(fmt::format("{:.3g}", all.hi)));
  if (all.lo < bounds.lo) beyond(bar.bottom, bar.bottom + kTip, shade(0), "to " + with_minus(fmt::format("{:.3g}", all.lo)));
}

void draw_cross(Canvas& canvas, Point centre, double half) {
  canvas.line({centre.x - half, centre.y - half}, {centre.x + half, centre.y + half}, kCross);
  canvas.line({centre.x - half, centre.y + half}, {centre.x + half, centre.y - half}, kCross);
}

void draw_arrow(Canvas& canvas, Point tip, bool upwards, const Style& style, double half) {
  const double tail = tip.y + (upwards ? 2 * half : -2 * half);
  canvas.polygons(std::vector<Polygon>{{tip, {tip.x - half, tail}, {tip.x + half, tail}}}, style);
}

void draw_ring(Canvas& canvas, Point centre) {
  canvas.circle(centre, kMark + 4, {.stroke = colour::kWhite, .width = 5});
  canvas.circle(centre, kMark + 4, kBestMark);
}

}  // namespace gaitlab::report
