#include "report/plot/canvas.h"

#include <fmt/format.h>

#include <algorithm>

namespace gaitlab::report {

std::string coordinate(double value) {
  std::string text = fmt::format("{:.2f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

double text_width(std::string_view text, double size) {
  const auto starts =
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
  return 0.56 * size * static_cast<double>(starts);
}

double fitting_size(std::string_view text, double most, double least, double room) {
  constexpr double kBoldWider = 1.1;
  const double wide = kBoldWider * text_width(text, most);
  return wide > room ? std::max(least, most * room / wide) : most;
}

std::string ramp(std::span<const Rgb> colours, double share) {
  const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(colours.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(at), colours.size() - 2);
  const double part = at - static_cast<double>(below);
  std::string text = "#";
  for (std::size_t c = 0; c < 3; ++c)
    text += fmt::format("{:02X}", std::lround(colours[below][c] + part * (colours[below + 1][c] - colours[below][c])));
  return text;
}

}  // namespace gaitlab::report
