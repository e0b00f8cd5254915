#include "report/plot/font.h"

#include <algorithm>

#include "report/plot/characters.h"

namespace gaitlab::report {

// Offsets in the tables are those of the OpenType specification.
Font::Font(std::string_view file) : file_(file) {
  const std::size_t head = table("head");
  unit_ = u16(head + 18);
  for (std::size_t side = 0; side < box_.size(); ++side) box_[side] = length(head + 36 + 2 * side);
  const std::size_t heights = table("hhea");
  ascent_ = length(heights + 4);
  descent_ = length(heights + 6);
  last_width_ = u16(heights + 34) - 1;
  capital_ = length(table("OS/2") + 88);
  widths_ = table("hmtx");
  const std::size_t map = table("cmap");
  characters_ = map + (u16(map + 8) << 16U) + u16(map + 10);
}

std::size_t Font::table(std::string_view name) const {
  const unsigned count = u16(4);
  for (std::size_t entry = 12; entry < 12 + std::size_t{16} * count; entry += 16) {
    if (file_.substr(entry, 4) == name) return (std::size_t{u16(entry + 8)} << 16U) + u16(entry + 10);
  }
  return 0;
}

unsigned Font::u16(std::size_t at) const {
  return (static_cast<unsigned>(static_cast<unsigned char>(file_[at])) << 8U) + static_cast<unsigned char>(file_[at + 1]);
}

double Font::length(std::size_t at) const { return static_cast<std::int16_t>(u16(at)) / unit_; }

unsigned Font::glyph(char32_t code) const {
  const auto u32 = [&](std::size_t at) { return (char32_t{u16(at)} << 16U) + u16(at + 2); };
  const std::size_t groups = u32(characters_ + 12);
  for (std::size_t g = 0; g < groups; ++g) {
    const std::size_t group = characters_ + 16 + 12 * g;
    const char32_t first = u32(group);
    if (code >= first && code <= u32(group + 4)) return u32(group + 8) + (code - first);
  }
  return 0;
}

double Font::width(unsigned glyph) const { return u16(widths_ + 4 * std::min<std::size_t>(glyph, last_width_)) / unit_; }

const Font& font_of(Face face) {
  static const Font kRegular(font_file(Face::regular));
  static const Font kBold(font_file(Face::bold));
  return face == Face::bold ? kBold : kRegular;
}

SetText set_text(std::string_view text, Face face) {
  const Font& font = font_of(face);
  SetText set;
  while (!text.empty()) {
    const Character character = first_character(text);
    const bool blank = text.front() == '\t' || text.front() == '\n' || text.front() == '\r';
    char32_t code = character.length > 0 ? character.code : blank ? U' ' : U'\uFFFD';
    text.remove_prefix(std::max<std::size_t>(1, character.length));
    if (font.glyph(code) == 0) {
      set.missing.insert(code);
      code = U'?';
    }
    set.letters.push_back({font.glyph(code), code});
    set.width += font.width(set.letters.back().glyph);
  }
  return set;
}

double print_width(std::string_view text, double size, bool bold) {
  return set_text(text, bold ? Face::bold : Face::regular).width * size;
}

}  // namespace gaitlab::report
