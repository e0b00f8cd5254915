#include "interchange/urdf_text.h"

#include <console_bridge/console.h>
#include <fmt/format.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <exception>

#include "core/settings/text_file.h"

namespace gaitlab::interchange {

namespace {

/// Collects the messages of urdfdom, which it otherwise prints.
class UrdfMessages final : public console_bridge::OutputHandler {
 public:
  explicit UrdfMessages(const std::string& file) : file_(file) { console_bridge::useOutputHandler(this); }
  ~UrdfMessages() override { console_bridge::restorePreviousOutputHandler(); }
  UrdfMessages(const UrdfMessages&) = delete;
  UrdfMessages& operator=(const UrdfMessages&) = delete;

  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR) problems.add(SourceLocation{file_}, "urdfdom: " + text);
  }

  Problems problems;

 private:
  std::string file_;
};

/// Checks the number of elements, because the XML parser of urdfdom calls itself for nested ones: 50 000 overflow its stack.
void check_elements(const std::string& text, const std::string& file) {
  constexpr std::size_t kMost = 10000;
  std::size_t number = 0;
  for (std::size_t i = 0; i + 1 < text.size(); ++i) number += text[i] == '<' && text[i + 1] != '/' ? 1 : 0;
  if (number > kMost)
    throw InputError(SourceLocation{file}, fmt::format("has {} elements; expected at most {}", number, kMost));
}

}  // namespace

UrdfText::UrdfText(const std::string& file) : file_(file), text_(read_text(file)) {
  check_text(text_, file);
  check_elements(text_, file);
  UrdfMessages messages(file);
  try {
    model_ = urdf::parseURDF(text_);
  } catch (const std::exception& error) {
    messages.problems.add(SourceLocation{file}, std::string("urdfdom: ") + error.what());
  }
  messages.problems.raise();
  if (model_ == nullptr || model_->getRoot() == nullptr) {
    throw InputError(SourceLocation{file}, "has no robot; expected a URDF file with an element <robot>");
  }
}

std::size_t UrdfText::find(const std::string& tag, std::size_t from) const {
  const std::string open = "<" + tag;
  for (std::size_t at = text_.find(open, from); at != std::string::npos; at = text_.find(open, at + 1)) {
    const std::size_t end = at + open.size();
    if (end < text_.size() && std::string(" \t\r\n/>").find(text_[end]) != std::string::npos) return at;
  }
  return std::string::npos;
}

SourceLocation UrdfText::place(const std::string& tag, const std::string& name) const {
  for (std::size_t at = find(tag, 0); at != std::string::npos; at = find(tag, at + 1)) {
    const std::string head = text_.substr(at, text_.find('>', at) - at);
    if (head.find("name=\"" + name + '"') == std::string::npos && head.find("name='" + name + '\'') == std::string::npos)
      continue;
    const std::size_t start = text_.rfind('\n', at) + 1;  // 0 in the first line
    const auto line = std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    return {file_, static_cast<int>(line) + 1, static_cast<int>(at - start) + 1};
  }
  return {file_};
}

std::size_t UrdfText::count(const std::string& tag) const {
  std::size_t number = 0;
  for (std::size_t at = find(tag, 0); at != std::string::npos; at = find(tag, at + 1)) ++number;
  return number;
}

}  // namespace gaitlab::interchange
