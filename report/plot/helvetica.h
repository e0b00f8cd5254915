// Text in two fonts that every PDF reader has: Helvetica, and Symbol for Greek letters and signs.
#pragma once
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace gaitlab::report {

enum class Font { helvetica, bold, symbol };

/// Consecutive characters of one font in its encoding: WinAnsi (Windows code page 1252), or the encoding of Symbol.
struct TextRun {
  Font font = Font::helvetica;
  std::string bytes = {};
};

struct SetText {
  std::vector<TextRun> runs = {};
  double width = 0;                 ///< width at font size 1, by the metrics of the fonts
  std::set<char32_t> missing = {};  ///< characters that neither font has; they are replaced by `?`
};

/// Splits `text` (UTF-8) into runs of one font. Widths are Adobe's metrics of the 14 standard fonts, taken from the URW fonts
/// of equal widths.
SetText set_in_helvetica(std::string_view text, bool bold);

/// Width of `text` in Helvetica, in the unit of `size`.
double helvetica_width(std::string_view text, double size, bool bold = false);

}  // namespace gaitlab::report
