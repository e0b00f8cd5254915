#include "interchange/mjcf_text.h"

#include <fmt/format.h>

#include <algorithm>
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

/// Sections without effect on bodies, joints and contact; elements without effect, wherever they are; and attributes.
constexpr std::string_view kUnused[] = {"sensor", "visual", "statistic", "size", "custom", "extension", "option", "deformable"};
constexpr std::string_view kUnusedElements[] = {"material", "texture", "skin", "hfield", "camera", "light", "site", "pair"};
constexpr std::string_view kUnusedAttributes[] = {"material", "texture", "user",       "rgba",
                                                  "assetdir", "meshdir", "texturedir", "discardvisual"};
/// Attributes of MuJoCo 3 that 2.2.2 lacks, without effect on a module.
constexpr std::string_view kNewAttributes[] = {"actuatorfrclimited", "actuatorgravcomp", "kv",          "dampratio",
                                               "inheritrange",       "timeconst",        "maxhullvert", "content_type",
                                               "ellipsoidinertia",   "alignfree",        "saveinertial"};
constexpr std::string_view kTorqueRange = "actuatorfrcrange";

std::string escaped(const std::string& text) {
  std::string made;
  for (const char c : text) made += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
  return made;
}

std::string value_of(const XmlTag& tag, std::string_view attribute) {
  const XmlTag::Attribute* const found = tag.attribute(attribute);
  return found == nullptr ? "" : decoded(std::string(found->value));
}

}  // namespace

MjcfText::MjcfText(const std::string& file, const std::string& meshes) : file_(file), meshes_(meshes) {
  add_file(file, 0);
  tags_ = xml_tags(text_);
  if (tags_.empty()) throw InputError(SourceLocation{file}, "has no element <mujoco>; expected an MJCF file");
  find_bodies();
  check_actuators();
  reduce();
}

void MjcfText::find_bodies() {
  std::vector<std::size_t> body_of(tags_.size(), 0);
  for (std::size_t t = 1; t < tags_.size(); ++t) {
    const XmlTag& tag = tags_[t];
    const std::string section = section_of(t);
    if (tag.name == "compiler" && value_of(tag, "inertiafromgeom") == "true") from_geoms_ = true;
    if (tag.name == "mesh" && section == "asset") mesh_files_.push_back(t);
    if (tag.name == "pair" && section == "contact") paired_.insert({value_of(tag, "geom1"), value_of(tag, "geom2")});
    if (section != "worldbody") continue;
    if (tag.name == "composite")
      throw InputError(place_of(tag.begin), "<composite> makes bodies that the file does not list; write them out");
    const std::size_t in = body_of[tag.parent];
    if (tag.name == "body") {
      elements_.push_back({t});
      body_of[t] = elements_.size();
    } else if (in > 0 && (tag.name == "joint" || tag.name == "freejoint")) {
      elements_[in - 1].joints.push_back(t);
    } else if (in > 0 && tag.name == "inertial") {
      elements_[in - 1].inertial = true;
    }
  }
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

std::string MjcfText::section_of(std::size_t tag) const {
  while (tags_[tag].parent != kNoTag && tags_[tag].parent != 0) tag = tags_[tag].parent;
  return tags_[tag].parent == 0 ? std::string(tags_[tag].name) : "";
}

void MjcfText::blank(std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) text_[i] = text_[i] == '\n' ? '\n' : ' ';
}

void MjcfText::check_actuators() const {
  Problems problems;
  for (std::size_t t = 1; t < tags_.size(); ++t) {
    const XmlTag& tag = tags_[t];
    if (tags_[tag.parent].name != "actuator" || section_of(t) != "actuator") continue;
    const std::string name = value_of(tag, "name");
    const std::string what = name.empty() ? "an actuator" : "actuator " + in_quotes(name);
    if (tag.name == "muscle" || tag.name == "adhesion") {
      problems.add(place_of(tag.begin),
                   fmt::format("{} is of type {}; expected motor, position, velocity or general", what, tag.name));
    } else if (tag.attribute("joint") == nullptr && tag.attribute("jointinparent") == nullptr) {
      const char* const on = tag.attribute("tendon") != nullptr ? "a tendon"
                             : tag.attribute("body") != nullptr ? "a body"
                                                                : "a site";
      problems.add(place_of(tag.begin), fmt::format("{} acts on {}; expected a joint", what, on));
    }
  }
  problems.raise();
}

void MjcfText::reduce() {
  const auto left_out = [&](const char* section, bool changed, const char* what) {
    std::size_t number = 0;
    const XmlTag* first = nullptr;
    for (std::size_t t = 1; t < tags_.size(); ++t) {
      if (tags_[t].parent != 0 || tags_[t].name != section) continue;
      const auto inner = std::ranges::count_if(tags_, [&](const XmlTag& one) { return one.parent == t; });
      if (inner > 0 && first == nullptr) first = &tags_[t];
      number += static_cast<std::size_t>(inner);
      blank(tags_[t].begin, tags_[t].close_end);
    }
    if (first != nullptr) notes_.push_back({place_of(first->begin), counted(number, what), changed});
  };
  std::string folder;
  std::size_t of_world = 0;
  for (const XmlTag& tag : tags_) {
    if (tag.parent == kNoTag) continue;
    for (const char* const key : {"assetdir", "meshdir"}) {
      if (tag.name == "compiler" && tag.attribute(key) != nullptr) folder = value_of(tag, key);
    }
    const bool ground = tag.name == "geom" && tags_[tag.parent].name == "worldbody";
    of_world += ground && value_of(tag, "type") != "plane" ? 1 : 0;
    const bool heights = tag.name == "geom" && tag.attribute("hfield") != nullptr;
    if (heights && !ground) notes_.push_back({place_of(tag.begin), "a geom with a field of heights", true});
    if (ground || heights || is_one_of(tag.name, kUnusedElements) || (tag.parent == 0 && is_one_of(tag.name, kUnused))) {
      blank(tag.begin, tag.close_end);
      continue;
    }
    for (const XmlTag::Attribute& attribute : tag.attributes) {
      const auto begin = static_cast<std::size_t>(attribute.name.data() - text_.data());
      const bool stated = tag.name == "joint" && attribute.name == kTorqueRange;
      const bool range = stated && value_of(tag, "actuatorfrclimited") != "false";
      if (is_one_of(attribute.name, kUnusedAttributes) || (stated && !range))
        blank(begin, attribute.begin + attribute.value.size() + 1);
      if (range) text_.replace(begin, kTorqueRange.size(), "user            ");
    }
  }
  const fs::path beside = fs::absolute(file_).lexically_normal().parent_path();
  meshes_ = meshes_.empty() ? (beside / folder).string() : fs::absolute(meshes_).lexically_normal().string();
  if (of_world > 0) notes_.push_back({{file_}, counted(of_world, "geom") + " of the world other than planes", false});
  left_out("keyframe", false, "keyframe");
  left_out("tendon", true, "tendon");
  left_out("equality", true, "equality constraint");
}

std::string MjcfText::text(const std::set<std::size_t>& meshes) const {
  constexpr const char* kTetrahedron = "vertex=\"0 0 0 1 0 0 0 1 0 0 0 1\"";
  std::string made = text_.substr(0, tags_.front().end);
  made += fmt::format("<compiler autolimits=\"true\" meshdir=\"{}\"/><size nuser_jnt=\"2\"/>", escaped(meshes_));
  std::size_t at = tags_.front().end;
  for (std::size_t m = 0; m < mesh_files_.size(); ++m) {
    const XmlTag& tag = tags_[mesh_files_[m]];
    const XmlTag::Attribute* const file = tag.attribute("file");
    if (file == nullptr || meshes.contains(m)) continue;
    const auto begin = static_cast<std::size_t>(file->name.data() - text_.data());
    made += text_.substr(at, begin - at) + kTetrahedron;
    if (tag.attribute("name") == nullptr)
      made += fmt::format(" name=\"{}\"", escaped(fs::path(value_of(tag, "file")).stem().string()));
    at = file->begin + file->value.size() + 1;
  }
  return made + text_.substr(at);
}

bool MjcfText::drop_attribute(const std::string& tag, const std::string& name) {
  if (!is_one_of(name, kNewAttributes)) return false;
  bool dropped = false;
  for (const XmlTag& one : tags_) {
    const XmlTag::Attribute* const found = one.name == tag ? one.attribute(name) : nullptr;
    if (found == nullptr) continue;
    blank(static_cast<std::size_t>(found->name.data() - text_.data()), found->begin + found->value.size() + 1);
    dropped = true;
  }
  return dropped;
}

}  // namespace gaitlab::interchange
