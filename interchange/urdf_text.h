// Text of a URDF file: its model as urdfdom reads it after repairs, and lines of its elements, which urdfdom does not keep.
#pragma once
#include <urdf_model/model.h>

#include <memory>
#include <string>
#include <vector>

#include "core/errors.h"
#include "interchange/robot_note.h"
#include "interchange/urdf_repair.h"

namespace gaitlab::interchange {

class UrdfText {
 public:
  /// Reads the file. Throws InputError if it cannot be read, or with the first message of urdfdom if it has no model: the
  /// others follow from the first.
  explicit UrdfText(const std::string& file);

  [[nodiscard]] const urdf::ModelInterface& model() const { return *model_; }
  /// Repairs without which urdfdom would refuse the file, one note each.
  [[nodiscard]] std::vector<RobotNote> repairs() const;
  /// True if the joint has a range, but no element `limit`.
  [[nodiscard]] bool lacks_limit(const std::string& joint) const { return repair_.no_limits.contains(joint); }
  /// True if the joint has an element `limit` with neither `lower` nor `upper`.
  [[nodiscard]] bool lacks_range(const std::string& joint) const { return repair_.no_ranges.contains(joint); }
  /// True if a part of a link's collision or visual, a cylinder in the model, is a capsule.
  [[nodiscard]] bool is_capsule(const std::string& link, bool collision, std::size_t part) const {
    return repair_.capsules.contains({link, collision, part});
  }
  /// Place of the first element `tag` whose name is `name`, or of the last; the file if it is not found.
  [[nodiscard]] SourceLocation place(const std::string& tag, const std::string& name, bool last = false) const;
  /// Place of the file as a whole.
  [[nodiscard]] SourceLocation place() const { return {file_}; }
  /// Number of elements `tag`.
  [[nodiscard]] std::size_t count(const std::string& tag) const;

 private:
  /// Offset of the next element `tag` from an offset on, or npos.
  [[nodiscard]] std::size_t find(const std::string& tag, std::size_t from) const;

  [[nodiscard]] SourceLocation place_of(std::size_t offset) const;
  /// Throws InputError if a link is the child of two joints, or if links are joined in a loop without connection to the root.
  /// urdfdom accepts both: the paths to the first are as many as 2 to the power of their number, and the second are in no path.
  void check_tree() const;
  /// Place of the link or joint that one of urdfdom's messages names; the file if the message names neither.
  [[nodiscard]] SourceLocation place_in(const std::vector<std::string>& messages) const;

  std::string file_;
  std::string text_;  ///< with blanks in the place of comments
  UrdfRepair repair_;
  std::shared_ptr<const urdf::ModelInterface> model_;
};

}  // namespace gaitlab::interchange
