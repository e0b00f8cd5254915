// Text of a URDF file: its model as urdfdom reads it, and lines of its elements, which urdfdom does not keep.
#pragma once
#include <urdf_model/model.h>

#include <memory>
#include <string>

#include "core/errors.h"

namespace gaitlab::interchange {

class UrdfText {
 public:
  /// Reads the file. Throws InputError if it cannot be read, or with the messages of urdfdom if it has no model.
  explicit UrdfText(const std::string& file);

  [[nodiscard]] const urdf::ModelInterface& model() const { return *model_; }
  /// Place of the element `tag` whose name is `name`; the file if it is not found.
  [[nodiscard]] SourceLocation place(const std::string& tag, const std::string& name) const;
  /// Number of elements `tag`.
  [[nodiscard]] std::size_t count(const std::string& tag) const;

 private:
  /// Offset of the next element `tag` from an offset on, or npos.
  [[nodiscard]] std::size_t find(const std::string& tag, std::size_t from) const;

  std::string file_, text_;
  std::shared_ptr<const urdf::ModelInterface> model_;
};

}  // namespace gaitlab::interchange
