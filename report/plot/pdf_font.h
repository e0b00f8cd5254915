// A font embedded in a PDF: the objects that describe it, its glyphs and their characters.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "report/plot/font.h"

namespace gaitlab::report {

/// Glyphs that a page uses, each with its character. If several characters have one glyph, the lowest of them is used.
using UsedGlyphs = std::map<unsigned, char32_t>;

/// Objects of a font of type Type0 with a TrueType file (CIDFontType2), in which a character code is the glyph's number in two
/// bytes. The first one is the font; `number` is its number, and the others have the following numbers. Throws std::bad_alloc
/// if there is no memory for zlib.
std::vector<std::string> pdf_font(Face face, const UsedGlyphs& used, std::size_t number);

/// A stream object with compressed content. `entries` are further entries of its dictionary.
std::string pdf_stream(std::string_view content, std::string_view entries = "");

}  // namespace gaitlab::report
