// Tree of bodies, each attached to its parent by a hinge or by the dock of its module. The tree does not fuse docked bodies.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "core/model/robot.h"

namespace gaitlab {

struct Attachment {
  enum class Kind { base, hinge, dock } kind = Kind::base;
  std::size_t parent = 0;      ///< index of the parent body; the base body is its own parent
  std::size_t index = 0;       ///< index of the joint (hinge), or of the child module (dock)
  Vec3 origin = Vec3::Zero();  ///< origin of the hinge or of the docked faces, m, frame of the body's link
};

struct BodyTree {
  explicit BodyTree(const Robot& robot);
  std::vector<Attachment> attachments;  ///< one per body
  std::vector<std::size_t> order;       ///< all bodies, a parent before its children
};

/// Name of the dock of a module on its parent, `m3/dock`. No hinge may be called dock (core/robot_files/module_file).
std::string dock_name(std::size_t module);

}  // namespace gaitlab
