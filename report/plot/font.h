// The fonts of figures for print: two subsets of Liberation Sans, whose letters have the widths of Helvetica.
#pragma once
#include <array>
#include <cstdint>
#include <set>
#include <string_view>
#include <vector>

namespace gaitlab::report {

/// A TrueType font. Lengths are multiples of the font size; glyph 0 is the box for a missing character.
class Font {
 public:
  /// `file` must outlive the font. It contains one table of characters, in format 12, as report/plot/fonts/subset.py writes it.
  explicit Font(std::string_view file);
  /// Glyph of a character; 0 if the font does not have it.
  [[nodiscard]] unsigned glyph(char32_t code) const;
  [[nodiscard]] double width(unsigned glyph) const;
  [[nodiscard]] std::string_view file() const { return file_; }
  /// Smallest box that contains every glyph: left, bottom, right, top.
  [[nodiscard]] const std::array<double, 4>& box() const { return box_; }
  /// Heights above the baseline of the highest letters, of the lowest (negative), and of capital letters.
  [[nodiscard]] double ascent() const { return ascent_; }
  [[nodiscard]] double descent() const { return descent_; }
  [[nodiscard]] double capital() const { return capital_; }

 private:
  [[nodiscard]] std::size_t table(std::string_view name) const;
  [[nodiscard]] unsigned u16(std::size_t at) const;
  [[nodiscard]] double length(std::size_t at) const;

  std::string_view file_;
  double unit_ = 1;                          ///< units of the file per font size
  std::size_t widths_ = 0, characters_ = 0;  ///< places of tables in the file
  std::size_t last_width_ = 0;               ///< the glyphs after this one have its width
  std::array<double, 4> box_{};
  double ascent_ = 0, descent_ = 0, capital_ = 0;
};

enum class Face { regular, bold };
/// Content of a file in report/plot/fonts, which the build puts into the program (cmake/fonts.cmake).
std::string_view font_file(Face face);
const Font& font_of(Face face);

/// A text as glyphs of one font.
struct SetText {
  struct Letter {
    unsigned glyph = 0;
    char32_t code = 0;
  };
  std::vector<Letter> letters = {};
  double width = 0;                 ///< width at font size 1
  std::set<char32_t> missing = {};  ///< characters that the font does not have; they are replaced by `?`
};
SetText set_text(std::string_view text, Face face);

/// Width of `text`, in the unit of `size`.
double print_width(std::string_view text, double size, bool bold = false);

}  // namespace gaitlab::report
