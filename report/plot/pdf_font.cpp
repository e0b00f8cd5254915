#include "report/plot/pdf_font.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "report/plot/deflate.h"

namespace gaitlab::report {

namespace {

/// A length of a font in thousandths of the font size.
long thousandths(double length) { return std::lround(1000 * length); }

/// Map from glyphs to Unicode, by which viewers search and copy text (CMap; PDF 1.4, 5.9). A block has at most 100 entries.
std::string to_unicode(const UsedGlyphs& used) {
  constexpr std::size_t kMostOfBlock = 100;
  std::string map =
      "/CIDInit /ProcSet findresource begin\n12 dict begin\nbegincmap\n"
      "/CIDSystemInfo << /Registry (Adobe) /Ordering (UCS) /Supplement 0 >> def\n"
      "/CMapName /Adobe-Identity-UCS def\n/CMapType 2 def\n"
      "1 begincodespacerange\n<0000> <FFFF>\nendcodespacerange\n";
  std::size_t left = used.size();
  std::size_t of_block = 0;
  for (const auto& [glyph, code] : used) {
    if (of_block == 0) {
      of_block = std::min(left, kMostOfBlock);
      left -= of_block;
      fmt::format_to(std::back_inserter(map), "{} beginbfchar\n", of_block);
    }
    // The fonts have characters of the basic plane only: one unit of UTF-16.
    fmt::format_to(std::back_inserter(map), "<{:04X}> <{:04X}>\n", glyph, static_cast<unsigned>(code));
    if (--of_block == 0) map += "endbfchar\n";
  }
  return map + "endcmap\nCMapName currentdict /CMap defineresource pop\nend\nend\n";
}

std::string widths(const Font& font, const UsedGlyphs& used) {
  std::string text;
  for (const auto& [glyph, code] : used)
    fmt::format_to(std::back_inserter(text), "{}{} [{}]", text.empty() ? "" : " ", glyph, thousandths(font.width(glyph)));
  return text;
}

}  // namespace

std::string pdf_stream(std::string_view content, std::string_view entries) {
  const std::string packed = deflated(content, kMostDeflated);
  return fmt::format("<< /Length {} /Filter /FlateDecode{} >>\nstream\n", packed.size(), entries) + packed + "\nendstream";
}

std::vector<std::string> pdf_font(Face face, const UsedGlyphs& used, std::size_t number) {
  const Font& font = font_of(face);
  const bool bold = face == Face::bold;
  // Six letters in front of the name mark a subset.
  const char* const name = bold ? "GAITLB+GaitlabSans-Bold" : "GAITLA+GaitlabSans";
  constexpr int kUprightText = 32;   // flag of a font whose characters are letters of texts
  const int stem = bold ? 140 : 88;  // width of vertical stems, for readers that replace the font
  const auto& [left, bottom, right, top] = font.box();
  return {fmt::format("<< /Type /Font /Subtype /Type0 /BaseFont /{} /Encoding /Identity-H /DescendantFonts [{} 0 R] "
                      "/ToUnicode {} 0 R >>",
                      name, number + 1, number + 4),
          fmt::format("<< /Type /Font /Subtype /CIDFontType2 /BaseFont /{} /CIDToGIDMap /Identity\n"
                      "/CIDSystemInfo << /Registry (Adobe) /Ordering (Identity) /Supplement 0 >>\n"
                      "/FontDescriptor {} 0 R /W [{}] >>",
                      name, number + 2, widths(font, used)),
          fmt::format("<< /Type /FontDescriptor /FontName /{} /Flags {} /ItalicAngle 0 /StemV {}\n"
                      "/FontBBox [{} {} {} {}] /Ascent {} /Descent {} /CapHeight {} /FontFile2 {} 0 R >>",
                      name, kUprightText, stem, thousandths(left), thousandths(bottom), thousandths(right), thousandths(top),
                      thousandths(font.ascent()), thousandths(font.descent()), thousandths(font.capital()), number + 3),
          pdf_stream(font.file(), fmt::format(" /Length1 {}", font.file().size())), pdf_stream(to_unicode(used))};
}

}  // namespace gaitlab::report
