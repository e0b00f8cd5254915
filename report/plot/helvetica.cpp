#include "report/plot/helvetica.h"

#include <algorithm>
#include <array>

#include "report/plot/characters.h"

namespace gaitlab::report {

namespace {

constexpr unsigned kFirst = 0x20;
// Widths of the WinAnsi codes 0x20 to 0xFF, in thousandths of the font size; 0 for an unused code.
using Widths = std::array<unsigned short, 0x100 - kFirst>;

// clang-format off
constexpr Widths kRegular{
    278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278,
    556, 556, 556, 556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556,
    1015, 667, 667, 722, 722, 667, 611, 778, 722, 278, 500, 667, 556, 833, 722, 778,
    667, 778, 722, 667, 611, 722, 667, 944, 667, 667, 611, 278, 278, 278, 469, 556,
    333, 556, 556, 500, 556, 556, 278, 556, 556, 222, 222, 500, 222, 833, 556, 556,
    556, 556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334, 260, 334, 584, 0,
    556, 0, 222, 556, 333, 1000, 556, 556, 333, 1000, 667, 333, 1000, 0, 611, 0,
    0, 222, 222, 333, 333, 350, 556, 1000, 333, 1000, 500, 333, 944, 0, 500, 667,
    278, 333, 556, 556, 556, 556, 260, 556, 333, 737, 370, 556, 584, 333, 737, 333,
    400, 584, 333, 333, 333, 556, 537, 278, 333, 333, 365, 556, 834, 834, 834, 611,
    667, 667, 667, 667, 667, 667, 1000, 722, 667, 667, 667, 667, 278, 278, 278, 278,
    722, 722, 778, 778, 778, 778, 778, 584, 778, 722, 722, 722, 722, 667, 667, 611,
    556, 556, 556, 556, 556, 556, 889, 500, 556, 556, 556, 556, 278, 278, 278, 278,
    556, 556, 556, 556, 556, 556, 556, 584, 611, 556, 556, 556, 556, 500, 556, 500,
};
constexpr Widths kBold{
    278, 333, 474, 556, 556, 889, 722, 238, 333, 333, 389, 584, 278, 333, 278, 278,
    556, 556, 556, 556, 556, 556, 556, 556, 556, 556, 333, 333, 584, 584, 584, 611,
    975, 722, 722, 722, 722, 667, 611, 778, 722, 278, 556, 722, 611, 833, 722, 778,
    667, 778, 722, 667, 611, 722, 667, 944, 667, 667, 611, 333, 278, 333, 584, 556,
    333, 556, 611, 556, 611, 556, 333, 611, 611, 278, 278, 556, 278, 889, 611, 611,
    611, 611, 389, 556, 333, 611, 556, 778, 556, 556, 500, 389, 280, 389, 584, 0,
    556, 0, 278, 556, 500, 1000, 556, 556, 333, 1000, 667, 333, 1000, 0, 611, 0,
    0, 278, 278, 500, 500, 350, 556, 1000, 333, 1000, 556, 333, 944, 0, 500, 667,
    278, 333, 556, 556, 556, 556, 280, 556, 333, 737, 370, 556, 584, 333, 737, 333,
    400, 584, 333, 333, 333, 611, 556, 278, 333, 333, 365, 556, 834, 834, 834, 611,
    722, 722, 722, 722, 722, 722, 1000, 722, 667, 667, 667, 667, 278, 278, 278, 278,
    722, 722, 778, 778, 778, 778, 778, 584, 778, 722, 722, 722, 722, 667, 667, 611,
    556, 556, 556, 556, 556, 556, 889, 556, 556, 556, 556, 556, 278, 278, 278, 278,
    611, 611, 611, 611, 611, 611, 611, 584, 611, 611, 611, 611, 611, 556, 611, 556,
};

struct SymbolCharacter {
  char32_t unicode;
  unsigned char code;
  unsigned short width;
};
constexpr SymbolCharacter kSymbol[] = {
    {0x0391, 0x41, 722},
    {0x0392, 0x42, 667},
    {0x0393, 0x47, 603},
    {0x0394, 0x44, 612},
    {0x0395, 0x45, 611},
    {0x0396, 0x5A, 611},
    {0x0397, 0x48, 722},
    {0x0398, 0x51, 741},
    {0x0399, 0x49, 333},
    {0x039A, 0x4B, 722},
    {0x039B, 0x4C, 686},
    {0x039C, 0x4D, 889},
    {0x039D, 0x4E, 722},
    {0x039E, 0x58, 645},
    {0x039F, 0x4F, 722},
    {0x03A0, 0x50, 768},
    {0x03A1, 0x52, 556},
    {0x03A3, 0x53, 592},
    {0x03A4, 0x54, 611},
    {0x03A5, 0x55, 690},
    {0x03A6, 0x46, 763},
    {0x03A7, 0x43, 722},
    {0x03A8, 0x59, 795},
    {0x03A9, 0x57, 768},
    {0x03B1, 0x61, 631},
    {0x03B2, 0x62, 549},
    {0x03B3, 0x67, 411},
    {0x03B4, 0x64, 494},
    {0x03B5, 0x65, 439},
    {0x03B6, 0x7A, 494},
    {0x03B7, 0x68, 603},
    {0x03B8, 0x71, 521},
    {0x03B9, 0x69, 329},
    {0x03BA, 0x6B, 549},
    {0x03BB, 0x6C, 549},
    {0x03BC, 0x6D, 576},
    {0x03BD, 0x6E, 521},
    {0x03BE, 0x78, 493},
    {0x03BF, 0x6F, 549},
    {0x03C0, 0x70, 549},
    {0x03C1, 0x72, 549},
    {0x03C2, 0x56, 439},
    {0x03C3, 0x73, 603},
    {0x03C4, 0x74, 439},
    {0x03C5, 0x75, 576},
    {0x03C6, 0x66, 521},
    {0x03C7, 0x63, 549},
    {0x03C8, 0x79, 686},
    {0x03C9, 0x77, 686},
    {0x2190, 0xAC, 987},
    {0x2192, 0xAE, 987},
    {0x2202, 0xB6, 494},
    {0x2211, 0xE5, 713},
    {0x2212, 0x2D, 549},
    {0x221A, 0xD6, 549},
    {0x221D, 0xB5, 713},
    {0x221E, 0xA5, 713},
    {0x222B, 0xF2, 274},
    {0x2248, 0xBB, 549},
    {0x2260, 0xB9, 549},
    {0x2264, 0xA3, 549},
    {0x2265, 0xB3, 549},
};

// Characters of the WinAnsi codes 0x80 to 0x9F; 0 for an unused code.
constexpr std::array<char32_t, 32> kHigh{
    0x20AC, 0, 0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160, 0x2039, 0x0152, 0, 0x017D, 0,
    0, 0x2018, 0x2019, 0x201C, 0x201D, 0x2022, 0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0, 0x017E, 0x0178};
// clang-format on

/// WinAnsi code of a character; 0 if it has none.
unsigned win_ansi(char32_t code) {
  if ((code >= 0x20 && code < 0x7F) || (code >= 0xA0 && code < 0x100)) return code;
  if (code == 0) return 0;
  const auto* const high = std::find(kHigh.begin(), kHigh.end(), code);
  return high == kHigh.end() ? 0 : 0x80 + static_cast<unsigned>(high - kHigh.begin());
}

void append(SetText& text, Font font, unsigned code, unsigned width) {
  if (text.runs.empty() || text.runs.back().font != font) text.runs.push_back({font});
  text.runs.back().bytes += static_cast<char>(static_cast<unsigned char>(code));
  text.width += 0.001 * width;
}

}  // namespace

SetText set_in_helvetica(std::string_view text, bool bold) {
  const Widths& widths = bold ? kBold : kRegular;
  const Font font = bold ? Font::bold : Font::helvetica;
  SetText set;
  while (!text.empty()) {
    const Character character = first_character(text);
    const bool blank = text.front() == '\t' || text.front() == '\n' || text.front() == '\r';
    const char32_t code = character.length > 0 ? character.code : blank ? U' ' : U'\uFFFD';
    text.remove_prefix(std::max<std::size_t>(1, character.length));
    const auto* const symbol = std::ranges::find(kSymbol, code, &SymbolCharacter::unicode);
    if (const unsigned plain = win_ansi(code); plain != 0) {
      append(set, font, plain, widths[plain - kFirst]);
    } else if (symbol != std::end(kSymbol)) {
      append(set, Font::symbol, symbol->code, symbol->width);
    } else {
      append(set, font, '?', widths['?' - kFirst]);
      set.missing.insert(code);
    }
  }
  return set;
}

double helvetica_width(std::string_view text, double size, bool bold) { return set_in_helvetica(text, bold).width * size; }

}  // namespace gaitlab::report
