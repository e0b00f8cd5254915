#include "interchange/urdf_text.h"

#include <console_bridge/console.h>
#include <fmt/format.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <exception>
#include <map>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "core/settings/text_file.h"
#include "core/settings/wording.h"
#include "interchange/xml_tags.h"
#include "interchange/xml_text.h"

namespace gaitlab::interchange {

namespace {

/// Collects the messages of urdfdom, which it otherwise prints.
class UrdfMessages final : public console_bridge::OutputHandler {
 public:
  explicit UrdfMessages(std::vector<std::string>& messages) : messages_(messages) { console_bridge::useOutputHandler(this); }
  ~UrdfMessages() override { console_bridge::restorePreviousOutputHandler(); }
  UrdfMessages(const UrdfMessages&) = delete;
  UrdfMessages& operator=(const UrdfMessages&) = delete;

  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR) messages_.push_back(text);
  }

 private:
  std::vector<std::string>& messages_;
};

/// The name in a message such as `link 'a' is not unique.` or `... for joint [j]`; empty if it has none of `tag`.
std::string name_in(const std::string& message, const std::string& tag) {
  for (const auto& [open, close] : {std::pair{" '", '\''}, std::pair{" [", ']'}}) {
    std::size_t at = message.find(tag + open);
    if (at == std::string::npos) continue;
    at += tag.size() + 2;
    const std::size_t end = message.find(close, at);
    if (end != std::string::npos) return message.substr(at, end - at);
  }
  return "";
}

}  // namespace

UrdfText::UrdfText(const std::string& file) : file_(file), text_(read_text(file)) {
  check_xml(text_, file);
  const std::string whole = std::exchange(text_, without_comments(text_));
  if (const std::size_t macro = text_.find("<xacro:"); macro != std::string::npos) {
    throw InputError(place_of(macro), "has macros of xacro; expected URDF, as `xacro FILE > ROBOT.urdf` writes it");
  }
  if (find("robot", 0) == std::string::npos)
    throw InputError(SourceLocation{file}, "has no element <robot> or <mujoco>; expected a URDF or MJCF file");
  repair_ = repaired_urdf(whole, text_);
  std::vector<std::string> messages;
  {
    UrdfMessages collector(messages);
    try {
      model_ = urdf::parseURDF(repair_.text);
    } catch (const std::exception& error) {
      messages.emplace_back(error.what());
    }
  }
  if (!messages.empty()) throw InputError(place_in(messages), "urdfdom: " + messages.front());
  if (model_ == nullptr || model_->getRoot() == nullptr) {
    throw InputError(SourceLocation{file}, "has no robot; expected a URDF file with an element <robot>");
  }
  check_tree();
}

void UrdfText::check_tree() const {
  std::map<std::string, std::string> parent_of;  // joint that moves the link
  Problems problems;
  for (const auto& [name, joint] : model_->joints_) {
    const auto [first, fresh] = parent_of.emplace(joint->child_link_name, name);
    if (fresh) continue;
    problems.add(place("joint", name),
                 fmt::format("link {} is the child of joints {} and {}; expected one tree", in_quotes(joint->child_link_name),
                             in_quotes(first->second), in_quotes(name)));
  }
  problems.raise();
  std::vector<const urdf::Link*> reached{model_->getRoot().get()};
  for (std::size_t i = 0; i < reached.size(); ++i) {
    for (const urdf::LinkSharedPtr& child : reached[i]->child_links) reached.push_back(child.get());
  }
  const std::set<const urdf::Link*> tree(reached.begin(), reached.end());
  const auto lost = std::ranges::find_if(model_->links_, [&](const auto& link) { return !tree.contains(link.second.get()); });
  if (lost == model_->links_.end()) return;
  const std::size_t others = model_->links_.size() - tree.size() - 1;
  throw InputError(
      place("link", lost->first),
      fmt::format("link {}{} is not connected to the root link {}; expected one tree, without loops of joints",
                  in_quotes(lost->first), others == 0 ? "" : fmt::format(", like {},", counted(others, "other link")),
                  in_quotes(model_->getRoot()->name)));
}

std::vector<RobotNote> UrdfText::repairs() const {
  std::vector<RobotNote> notes;
  SourceLocation place{file_, 1, 1};
  std::size_t at = 0;
  for (const UrdfRepair::Note& note : repair_.notes) {  // in the order of the file, so that lines are counted once
    for (; at < note.offset; ++at) {
      const bool ends = text_[at] == '\n';
      place.line += ends ? 1 : 0;
      place.column = ends ? 1 : place.column + 1;
    }
    notes.push_back({place, note.text, note.changed});
  }
  return notes;
}

std::size_t UrdfText::find(const std::string& tag, std::size_t from) const {
  const std::string open = "<" + tag;
  for (std::size_t at = text_.find(open, from); at != std::string::npos; at = text_.find(open, at + 1)) {
    const std::size_t end = at + open.size();
    if (end < text_.size() && std::string(" \t\r\n/>").find(text_[end]) != std::string::npos) return at;
  }
  return std::string::npos;
}

SourceLocation UrdfText::place(const std::string& tag, const std::string& name, bool last) const {
  std::size_t found = std::string::npos;
  for (std::size_t at = find(tag, 0); at != std::string::npos && (last || found == std::string::npos); at = find(tag, at + 1)) {
    const std::string head = decoded(text_.substr(at, text_.find('>', at) - at));
    const bool named =
        head.find("name=\"" + name + '"') != std::string::npos || head.find("name='" + name + '\'') != std::string::npos;
    // Elements <joint> of a transmission do not have a type.
    if (named && (tag != "joint" || head.find("type=") != std::string::npos)) found = at;
  }
  return found == std::string::npos ? SourceLocation{file_} : place_of(found);
}

SourceLocation UrdfText::place_of(std::size_t offset) const { return place_in_text(text_, offset, file_); }

SourceLocation UrdfText::place_in(const std::vector<std::string>& messages) const {
  for (const std::string& message : messages) {
    for (const auto& [word, tag] :
         {std::pair{"link", "link"}, std::pair{"Link", "link"}, std::pair{"joint", "joint"}, std::pair{"Joint", "joint"}}) {
      const std::string name = name_in(message, word);
      if (!name.empty()) return place(tag, name, message.find("not unique") != std::string::npos);
    }
  }
  return {file_};
}

std::size_t UrdfText::count(const std::string& tag) const {
  std::size_t number = 0;
  for (std::size_t at = find(tag, 0); at != std::string::npos; at = find(tag, at + 1)) ++number;
  return number;
}

}  // namespace gaitlab::interchange
