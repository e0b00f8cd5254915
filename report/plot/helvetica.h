// Text in the fonts that every PDF reader has: Helvetica, and Symbol for Greek letters and signs.
#pragma once
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace gaitlab::report {

enum class Font { helvetica, bold, symbol };

/// Characters of one font in its encoding: WinAnsi (Windows code page 1252), or that of Symbol.
struct TextRun {
  Font font = Font::helvetica;
  std::string bytes = {};
};

struct SetText {
  std::vector<TextRun> runs = {};
  double width = 0;                 ///< for size 1, by the fonts' metrics
  std::set<char32_t> missing = {};  ///< characters that neither font has, replaced by `?`
};

/// `text` (UTF-8) as runs. Widths: Adobe's metrics of the 14 standard fonts, as given by the URW fonts of the same widths.
SetText set_in_helvetica(std::string_view text, bool bold);

/// Width of `text` in Helvetica of `size`, in its unit.
double helvetica_width(std::string_view text, double size, bool bold = false);

}  // namespace gaitlab::report
