// What every body hangs on: a hinge of its module, or the dock of its module. The bodies of a link stay apart here.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "core/model/robot.h"

namespace gaitlab {

struct Attachment {
  enum class Kind { base, hinge, dock } kind = Kind::base;
  std::size_t parent = 0;      ///< body; itself for the body that carries the base frame
  std::size_t index = 0;       ///< joint, or the docked (child's) module
  Vec3 origin = Vec3::Zero();  ///< of the hinge or of the docked faces, m, frame of the body's link
};

struct BodyTree {
  explicit BodyTree(const Robot& robot);
  std::vector<Attachment> attachments;  ///< one a body
  std::vector<std::size_t> order;       ///< all bodies, a parent before its children
};

/// `m3/dock`: a module's dock on its parent. No hinge is called dock (core/scenario/module_file).
std::string dock_name(std::size_t module);

}  // namespace gaitlab
