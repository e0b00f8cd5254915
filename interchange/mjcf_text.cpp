#include "interchange/mjcf_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <span>

#include "core/settings/text_file.h"
#include "core/settings/wording.h"
#include "interchange/xml_text.h"

namespace gaitlab::interchange {

namespace fs = std::filesystem;

namespace {

constexpr int kMostIncludes = 20;  // one within the other

bool is_one_of(std::string_view name, std::span<const std::string_view> names) {
  return std::ranges::find(names, name) != names.end();
}

/// Sections without effect on bodies, joints and contact.
constexpr std::string_view kUnused[] = {"sensor", "visual", "statistic", "size", "custom", "extension", "option", "deformable"};
/// The same for elements, wherever they are.
constexpr std::string_view kUnusedElements[] = {"material", "texture", "skin", "hfield", "camera", "light", "site", "pair"};
/// And for attributes.
constexpr std::string_view kUnusedAttributes[] = {"material", "texture", "user", "rgba", "texturedir", "assetdir", "meshdir"};
/// Attributes that MuJoCo 2.2.2 lacks, without effect on what a module takes.
constexpr std::string_view kNewWithoutEffect[] = {"actuatorfrcrange", "actuatorfrclimited", "kv",
                                                  "dampratio",        "inheritrange",       "timeconst"};

/// The largest of some numbers without their signs; nothing if it is 0.
std::optional<double> largest_number(std::string_view text) {
  double most = 0;
  for (const char* at = text.data(); at < text.data() + text.size();) {
    double number = 0;
    const auto [end, error] = std::from_chars(at, text.data() + text.size(), number);
    if (error == std::errc()) most = std::max(most, std::fabs(number));
    at = std::max(at + 1, end);
  }
  if (!(most > 0)) return {};
  return most;
}

std::string escaped(const std::string& text) {
  std::string made;
  for (const char c : text) made += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
  return made;
}

}  // namespace

MjcfText::MjcfText(const std::string& file, const std::string& meshes) : file_(file), meshes_(meshes) {
  constexpr std::size_t kMostElements = 10000;
  add_file(file, 0);
  tags_ = xml_tags(text_);
  if (tags_.empty()) throw InputError(SourceLocation{file}, "has no element <mujoco>; expected an MJCF file");
  if (tags_.size() > kMostElements)
    throw InputError(SourceLocation{file}, fmt::format("has {} elements; expected at most {}", tags_.size(), kMostElements));
  std::vector<std::size_t> body_of(tags_.size(), 0);
  for (std::size_t t = 1; t < tags_.size(); ++t) {
    if (!inside(t, "worldbody")) continue;
    const std::size_t parent = tags_[t].parent;
    if (tags_[t].name == "body") {
      elements_.push_back({t});
      body_of[t] = elements_.size();
    } else if ((tags_[t].name == "joint" || tags_[t].name == "freejoint") && body_of[parent] > 0) {
      Element& body = elements_[body_of[parent] - 1];
      body.joints.push_back(t);
      body.torque_limits.push_back(largest_number(value(t, "actuatorfrcrange")));
    }
  }
  check_actuators();
  drop_drawn_meshes();
  reduce();
}

void MjcfText::add_file(const std::string& file, int depth) {
  const std::string text = without_comments([&] {
    std::string read = read_text(file);
    check_xml(read, file);
    return read;
  }());
  const std::vector<XmlTag> tags = xml_tags(text);
  if (tags.empty()) return;
  const bool root = depth == 0;
  std::size_t at = root ? 0 : tags.front().end;
  for (const XmlTag& tag : tags) {
    if (tag.name != "include") continue;
    const XmlTag::Attribute* const name = tag.attribute("file");
    const SourceLocation place = place_in_text(text, tag.begin, file);
    if (name == nullptr) throw InputError(place, "include has no attribute file; expected that of an MJCF file");
    const std::string wanted = decoded(std::string(name->value));
    fs::path found = fs::path(file_).parent_path() / wanted;
    std::error_code none;
    if (!fs::is_regular_file(found, none)) found = fs::path(file).parent_path() / wanted;
    if (!fs::is_regular_file(found, none))
      throw InputError(place, fmt::format("includes {}, which is not beside {}", in_quotes(wanted), file_));
    const std::string path = found.lexically_normal().string();
    if (!included_.insert(path).second || depth == kMostIncludes)
      throw InputError(place, fmt::format("includes {} again; expected each file once", in_quotes(wanted)));
    add_piece(text, file, at, tag.begin);
    add_file(path, depth + 1);
    at = tag.close_end;
  }
  add_piece(text, file, at, root ? text.size() : tags.front().close_begin);
}

void MjcfText::add_piece(const std::string& text, const std::string& file, std::size_t begin, std::size_t end) {
  if (begin >= end) return;
  pieces_.push_back({text_.size(), place_in_text(text, begin, file)});
  text_.append(text, begin, end - begin);
}

SourceLocation MjcfText::place_of(std::size_t offset) const {
  const auto after = std::ranges::find_if(pieces_, [&](const Piece& one) { return one.offset > offset; });
  if (after == pieces_.begin()) return {file_};
  const Piece& piece = *std::prev(after);
  SourceLocation place = place_in_text(std::string_view(text_).substr(piece.offset), offset - piece.offset, piece.first.file);
  if (place.line == 1) place.column += piece.first.column - 1;
  place.line += piece.first.line - 1;
  return place;
}

SourceLocation MjcfText::place(int line) const {
  std::size_t offset = 0;
  for (int n = 1; n < line && offset != std::string::npos; ++n) {
    offset = text_.find('\n', offset);
    offset += offset == std::string::npos ? 0 : 1;
  }
  if (line < 1 || offset == std::string::npos) return {file_};
  return place_of(std::min(text_.find_first_not_of(" \t", offset), text_.size()));
}

SourceLocation MjcfText::body(std::size_t b) const {
  return b == 0 || b > elements_.size() ? SourceLocation{file_} : place_of(tags_[elements_[b - 1].tag].begin);
}

SourceLocation MjcfText::joint(std::size_t b, std::size_t k) const {
  if (b == 0 || b > elements_.size() || k >= elements_[b - 1].joints.size()) return body(b);
  return place_of(tags_[elements_[b - 1].joints[k]].begin);
}

std::optional<double> MjcfText::torque_limit(std::size_t b, std::size_t k) const {
  if (b == 0 || b > elements_.size() || k >= elements_[b - 1].joints.size()) return {};
  return elements_[b - 1].torque_limits[k];
}

bool MjcfText::inside(std::size_t tag, std::string_view section) const {
  while (tags_[tag].parent != kNoTag && tags_[tag].parent != 0) tag = tags_[tag].parent;
  return tags_[tag].parent == 0 && tags_[tag].name == section;
}

std::optional<std::size_t> MjcfText::default_of(std::string_view name, std::string_view tag) const {
  for (std::size_t d = 1; d < tags_.size(); ++d) {
    if (tags_[d].name != tag || tags_[tags_[d].parent].name != "default") continue;
    const XmlTag& group = tags_[tags_[d].parent];
    const XmlTag::Attribute* const own = group.attribute("class");
    const bool first = group.parent == 0;
    if (own == nullptr ? first && name == "main" : own->value == name || (first && name == "main")) return d;
  }
  return {};
}

std::string_view MjcfText::value(std::size_t tag, std::string_view attribute) const {
  if (const auto* own = tags_[tag].attribute(attribute)) return own->value;
  std::string_view name = "main";
  if (const auto* own = tags_[tag].attribute("class")) {
    name = own->value;
  } else {
    for (std::size_t above = tags_[tag].parent; above != kNoTag; above = tags_[above].parent) {
      if (const auto* child = tags_[above].attribute("childclass")) {
        name = child->value;
        break;
      }
    }
  }
  for (std::size_t depth = 0; depth < tags_.size(); ++depth) {  // from the class to those above it
    if (const std::optional<std::size_t> found = default_of(name, tags_[tag].name)) {
      if (const auto* given = tags_[*found].attribute(attribute)) return given->value;
    }
    const auto group = std::ranges::find_if(tags_, [&](const XmlTag& one) {
      return one.name == "default" && one.attribute("class") != nullptr && one.attribute("class")->value == name;
    });
    if (name == "main" || group == tags_.end() || group->parent == kNoTag || group->parent == 0) {
      if (name == "main") break;
      name = "main";
      continue;
    }
    const auto* const above = tags_[group->parent].attribute("class");
    name = above == nullptr ? "main" : above->value;
  }
  return {};
}

void MjcfText::blank(std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) text_[i] = text_[i] == '\n' ? '\n' : ' ';
}

void MjcfText::blank(const XmlTag::Attribute& attribute) {
  const auto begin = static_cast<std::size_t>(attribute.name.data() - text_.data());
  blank(begin, attribute.begin + attribute.value.size() + 1);
}

void MjcfText::left_out(const XmlTag& first, const std::string& text, bool changed) {
  notes_.push_back({place_of(first.begin), text, changed});
}

void MjcfText::check_actuators() const {
  Problems problems;
  for (std::size_t t = 1; t < tags_.size(); ++t) {
    const XmlTag& tag = tags_[t];
    if (!inside(t, "actuator") || tags_[tag.parent].name != "actuator") continue;
    if (tag.attribute("joint") != nullptr || tag.attribute("jointinparent") != nullptr) continue;
    const XmlTag::Attribute* const name = tag.attribute("name");
    std::string what = tag.attribute("tendon") != nullptr ? "a tendon" : tag.attribute("body") != nullptr ? "a body" : "a site";
    problems.add(place_of(tag.begin),
                 fmt::format("actuator {} acts on {}; expected a joint",
                             name == nullptr ? "without a name" : in_quotes(std::string(name->value)), what));
  }
  problems.raise();
}

void MjcfText::drop_drawn_meshes() {
  const auto is = [&](std::size_t t, std::string_view attribute, std::string_view wanted) {
    return value(t, attribute) == wanted;
  };
  bool from_geoms = false;
  for (std::size_t t = 1; t < tags_.size(); ++t) from_geoms |= tags_[t].name == "compiler" && is(t, "inertiafromgeom", "true");
  std::vector<bool> stated(tags_.size(), false);
  for (const XmlTag& tag : tags_) {
    if (tag.name == "inertial" && tag.parent != kNoTag) stated[tag.parent] = true;
  }
  std::set<std::string_view> used;
  std::vector<std::size_t> drawn;
  for (std::size_t t = 1; t < tags_.size(); ++t) {
    if (tags_[t].name != "geom" || !inside(t, "worldbody") || tags_[tags_[t].parent].name == "worldbody") continue;
    const std::string_view mesh = value(t, "mesh");
    if (mesh.empty()) continue;
    if (!from_geoms && stated[tags_[t].parent] && is(t, "contype", "0") && is(t, "conaffinity", "0")) {
      drawn.push_back(t);
    } else {
      used.insert(mesh);
    }
  }
  if (!drawn.empty()) left_out(tags_[drawn.front()], counted(drawn.size(), "geom") + " with a mesh that is only drawn", false);
  for (const std::size_t t : drawn) blank(tags_[t]);
  for (std::size_t t = 1; t < tags_.size(); ++t) {
    if (tags_[t].name != "mesh" || !inside(t, "asset")) continue;
    const auto* const name = tags_[t].attribute("name");
    const auto* const of = tags_[t].attribute("file");
    const std::string stem = of == nullptr ? "" : fs::path(std::string(of->value)).stem().string();
    if (!used.contains(name != nullptr ? name->value : std::string_view(stem))) blank(tags_[t]);
  }
}

void MjcfText::reduce() {
  std::size_t of_world = 0;
  const auto count = [&](std::string_view name, bool changed, const char* what) {
    std::size_t number = 0;
    const XmlTag* first = nullptr;
    for (std::size_t t = 1; t < tags_.size(); ++t) {
      if (tags_[t].parent != 0 || tags_[t].name != name) continue;
      const auto inner = std::ranges::count_if(tags_, [&](const XmlTag& one) { return one.parent == t; });
      if (inner > 0 && first == nullptr) first = &tags_[t];
      number += static_cast<std::size_t>(inner);
      blank(tags_[t]);
    }
    if (first != nullptr) left_out(*first, counted(number, what), changed);
  };
  std::string folder;
  for (std::size_t t = 1; t < tags_.size(); ++t) {
    const XmlTag& tag = tags_[t];
    if (tag.name == "compiler") {
      for (const char* const key : {"assetdir", "meshdir"}) {
        if (const auto* given = tag.attribute(key)) folder = decoded(std::string(given->value));
      }
    }
    const bool ground = tag.name == "geom" && tags_[tag.parent].name == "worldbody";
    of_world += ground && value(t, "type") != "plane" ? 1 : 0;
    if (ground || is_one_of(tag.name, kUnusedElements) || (tag.parent == 0 && is_one_of(tag.name, kUnused))) {
      blank(tag);
      continue;
    }
    for (const XmlTag::Attribute& attribute : tag.attributes) {
      if (is_one_of(attribute.name, kUnusedAttributes)) blank(attribute);
    }
  }
  const fs::path beside = fs::absolute(file_).lexically_normal().parent_path();
  meshes_ = meshes_.empty() ? (beside / folder).string() : fs::absolute(meshes_).lexically_normal().string();
  if (of_world > 0) notes_.push_back({{file_}, counted(of_world, "geom") + " of the world other than planes", false});
  count("keyframe", false, "keyframe");
  count("tendon", true, "tendon");
  count("equality", true, "equality constraint");
}

std::string MjcfText::text() const {
  const std::size_t inside_root = tags_.front().end;
  return fmt::format("{}<compiler autolimits=\"true\" meshdir=\"{}\"/>{}", text_.substr(0, inside_root), escaped(meshes_),
                     text_.substr(inside_root));
}

bool MjcfText::drop_attribute(const std::string& tag, const std::string& name) {
  std::size_t number = 0;
  const XmlTag* first = nullptr;
  for (const XmlTag& one : tags_) {
    const XmlTag::Attribute* const found = one.name == tag ? one.attribute(name) : nullptr;
    if (found == nullptr) continue;
    if (first == nullptr) first = &one;
    ++number;
    blank(*found);
  }
  if (first == nullptr) return false;
  if (!is_one_of(name, kNewWithoutEffect))
    left_out(*first, fmt::format("attribute {} of {}, which libmujoco 2.2.2 lacks", name, counted(number, "<" + tag + ">")),
             true);
  return true;
}

}  // namespace gaitlab::interchange
