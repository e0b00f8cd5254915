// Tags of an XML text with their offsets.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gaitlab::interchange {

inline constexpr std::size_t kNoTag = static_cast<std::size_t>(-1);

/// An element of an XML text. Offsets are those of bytes in the text; the texts are parts of it.
struct XmlTag {
  struct Attribute {
    std::string_view name, value;
    std::size_t begin = 0;  ///< offset of the value
  };
  std::string_view name;
  std::size_t begin = 0, end = 0;              ///< opening tag, from `<` to behind `>`
  std::size_t close_begin = 0, close_end = 0;  ///< closing tag; both are `end` for `<a/>`, or if there is none
  std::size_t parent = kNoTag;
  std::vector<Attribute> attributes = {};

  [[nodiscard]] const Attribute* attribute(std::string_view wanted) const;
};

/// Elements of a text without comments, in its order. Closing tags that do not belong to the innermost open element are
/// skipped: a later parser refuses such a text. The cost is linear in the length of the text.
std::vector<XmlTag> xml_tags(std::string_view text);

/// A text with characters in the place of their five names, such as `&amp;`, and of ASCII numbers, such as `&#10;`.
std::string decoded(std::string text);

}  // namespace gaitlab::interchange
