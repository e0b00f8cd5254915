#include "interchange/urdf_repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "core/settings/wording.h"
#include "interchange/xml_tags.h"

namespace gaitlab::interchange {

namespace {

/// Attributes with numbers, and their count of numbers.
struct Numbers {
  std::string_view tag;
  std::vector<std::string_view> attributes;
  std::size_t count;
};
const std::vector<Numbers>& number_attributes() {
  static const std::vector<Numbers> kAttributes = {{"origin", {"xyz", "rpy"}, 3},
                                                   {"axis", {"xyz"}, 3},
                                                   {"box", {"size"}, 3},
                                                   {"mesh", {"scale"}, 3},
                                                   {"sphere", {"radius"}, 1},
                                                   {"cylinder", {"radius", "length"}, 1},
                                                   {"capsule", {"radius", "length"}, 1},
                                                   {"mass", {"value"}, 1},
                                                   {"inertia", {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}, 1},
                                                   {"limit", {"lower", "upper", "effort", "velocity"}, 1},
                                                   {"dynamics", {"damping", "friction"}, 1}};
  return kAttributes;
}

bool is_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

std::vector<std::string> words_of(std::string_view text, std::string_view between) {
  std::vector<std::string> words;
  for (std::size_t at = text.find_first_not_of(between); at < text.size(); at = text.find_first_not_of(between, at)) {
    const std::size_t end = std::min(text.find_first_of(between, at), text.size());
    words.emplace_back(text.substr(at, end - at));
    at = end;
  }
  return words;
}

/// The value as `count` numbers; nothing if it cannot be read without a guess.
std::optional<std::string> forgiven(std::string_view value, std::size_t count) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const bool commas = value.find(',') != std::string_view::npos;
  std::vector<std::string> words;
  if (commas) {  // one word between two commas: `0,2 0,1` has decimal commas
    for (std::size_t at = 0; at <= value.size();) {
      const std::size_t end = std::min(value.find(',', at), value.size());
      const std::vector<std::string> between = words_of(value.substr(at, end - at), kBlanks);
      if (between.size() != 1) return std::nullopt;
      words.push_back(between.front());
      at = end + 1;
    }
  } else {
    words = words_of(value, kBlanks);
    if (count == 3 && words.size() == 4) words.pop_back();
  }
  if (words.size() != count) return std::nullopt;
  std::string text;
  for (std::string& word : words) {
    if (!is_number(word) && word.ends_with('.')) word.pop_back();
    if (!is_number(word)) return std::nullopt;
    text += (text.empty() ? "" : " ") + word;
  }
  return text;
}

class RepairWalk {
 public:
  RepairWalk(std::string_view text, std::string_view without_comments) : text_(text), tags_(xml_tags(without_comments)) {}

  UrdfRepair repair() {
    owner_.assign(tags_.size(), kNoTag);
    limited_.assign(tags_.size(), false);
    parts_.assign(tags_.size(), {0, 0});
    number_.assign(tags_.size(), 0);
    for (std::size_t i = 0; i < tags_.size(); ++i) look(i);
    for (std::size_t i = 0; i < tags_.size(); ++i) {
      if (owner_[i] == i && tags_[i].name == "joint" && !limited_[i]) add_limit(tags_[i]);
    }
    apply();
    std::ranges::stable_sort(made_.notes, {}, &UrdfRepair::Note::offset);
    return std::move(made_);
  }

 private:
  /// Replacement of a part of the text.
  struct Edit {
    std::size_t begin, size;
    std::string text;
  };

  static std::string name_of_tag(const XmlTag& tag) {
    const XmlTag::Attribute* const name = tag.attribute("name");
    return name == nullptr ? "" : decoded(std::string(name->value));
  }
  [[nodiscard]] bool in_robot(const XmlTag& tag) const {
    return tag.parent != kNoTag && tags_[tag.parent].name == "robot" && tags_[tag.parent].parent == kNoTag;
  }

  void look(std::size_t i) {
    const XmlTag& tag = tags_[i];
    const bool whole = in_robot(tag) && (tag.name == "link" || tag.name == "joint");
    owner_[i] = whole ? i : tag.parent == kNoTag ? kNoTag : owner_[tag.parent];
    if (tag.name == "material" && (in_robot(tag) || owner_[i] != kNoTag)) {
      drop_material(tag);
      return;
    }
    if (owner_[i] == kNoTag) return;
    const std::size_t owner = owner_[i];
    if (tag.parent == owner && (tag.name == "visual" || tag.name == "collision"))
      number_[i] = tag.name == "visual" ? parts_[owner].first++ : parts_[owner].second++;
    if (tag.parent == owner && tag.name == "limit") {
      limited_[owner] = true;
      complete_limit(tag);
      if (tag.attribute("lower") == nullptr && tag.attribute("upper") == nullptr)
        made_.no_ranges.insert(name_of_tag(tags_[owner]));
    }
    if (tag.name == "capsule") drop_capsule(i);
    for (const Numbers& one : number_attributes()) {
      for (const XmlTag::Attribute& attribute : tag.attributes) {
        if (one.tag == tag.name && std::ranges::find(one.attributes, attribute.name) != one.attributes.end())
          read_numbers(attribute, one.count);
      }
    }
  }

  void drop_material(const XmlTag& tag) {
    const std::string name = name_of_tag(tag);
    if (name.empty()) {
      note(tag.begin, "a material without a name", false);
    } else if (in_robot(tag) && !materials_.insert(name).second) {
      note(tag.begin, fmt::format("material {}, which is stated twice", in_quotes(name)), false);
    }
    edits_.push_back({tag.begin, tag.close_end - tag.begin, ""});
  }

  void drop_capsule(std::size_t i) {
    const XmlTag& tag = tags_[i];
    const std::size_t part = tag.parent == kNoTag ? kNoTag : tags_[tag.parent].parent;
    const std::string link = name_of_tag(tags_[owner_[i]]);
    // urdfdom decodes all characters that numbers name, so that this name would not be found.
    if (part == kNoTag || tags_[part].parent != owner_[i] || link.find("&#") != std::string::npos) return;
    made_.capsules.insert({link, tags_[part].name == "collision", number_[part]});
    note(tag.begin,
         fmt::format("link {} has a capsule, which URDF lacks: a cylinder with a sphere at each end", in_quotes(link)));
    edits_.push_back({tag.begin + 1, tag.name.size(), "cylinder"});
    if (tag.close_end > tag.end) edits_.push_back({tag.close_begin + 2, tag.name.size(), "cylinder"});
  }

  void read_numbers(const XmlTag::Attribute& attribute, std::size_t count) {
    const std::optional<std::string> text = forgiven(attribute.value, count);
    if (!text || *text == attribute.value) return;
    edits_.push_back({attribute.begin, attribute.value.size(), *text});
    if (words_of(attribute.value, " \t\r\n") != words_of(*text, " ")) {
      note(attribute.begin,
           fmt::format("{}=\"{}\" is read as {}", attribute.name, clipped(std::string(attribute.value)), *text));
    }
  }

  void complete_limit(const XmlTag& tag) {
    const std::size_t behind_name = tag.begin + 1 + tag.name.size();
    if (tag.attribute("effort") == nullptr) edits_.push_back({behind_name, 0, no_effort()});
    if (tag.attribute("velocity") == nullptr) edits_.push_back({behind_name, 0, no_speed()});
  }

  void add_limit(const XmlTag& joint) {
    const XmlTag::Attribute* const type = joint.attribute("type");
    if (type == nullptr || (type->value != "revolute" && type->value != "prismatic")) return;
    made_.no_limits.insert(name_of_tag(joint));
    edits_.push_back({joint.end, 0, "<limit" + no_effort() + no_speed() + "/>"});
  }
  static std::string no_speed() { return fmt::format(" velocity=\"{}\"", kNoSpeed); }
  static std::string no_effort() { return fmt::format(" effort=\"{}\"", kNoEffort); }

  void note(std::size_t offset, const std::string& text, bool changed = true) {
    made_.notes.push_back({offset, text, changed});
  }

  void apply() {
    std::ranges::stable_sort(edits_, {}, &Edit::begin);
    std::size_t at = 0;
    for (const Edit& edit : edits_) {
      if (edit.begin < at) continue;  // within a part that was removed
      made_.text += text_.substr(at, edit.begin - at);
      made_.text += edit.text;
      at = edit.begin + edit.size;
    }
    made_.text += text_.substr(at);
  }

  std::string_view text_;
  std::vector<XmlTag> tags_;
  UrdfRepair made_ = {};
  std::vector<Edit> edits_ = {};
  std::set<std::string> materials_ = {};
  std::vector<std::size_t> owner_ = {};                          ///< link or joint that contains the tag
  std::vector<bool> limited_ = {};                               ///< joints with an element `limit`
  std::vector<std::pair<std::size_t, std::size_t>> parts_ = {};  ///< of links: numbers of visual and of collision so far
  std::vector<std::size_t> number_ = {};                         ///< of a visual or collision among those of its link
};

}  // namespace

UrdfRepair repaired_urdf(std::string_view text, std::string_view without_comments) {
  return RepairWalk(text, without_comments).repair();
}

}  // namespace gaitlab::interchange
