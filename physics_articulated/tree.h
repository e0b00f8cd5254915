// The robot as the recursion wants it: links whose joint axis is the z of their frame.
#pragma once
#include <vector>

#include "core/model/robot.h"
#include "physics_articulated/vector.h"

namespace gaitlab::articulated {

struct TreeLink {
  std::size_t parent = 0, joint = 0;  ///< of links 1..
  Mat<double> at_zero;                ///< own axes in the parent's at joint angle 0
  Vec<double> origin;                 ///< of the own frame, in the parent's, m
  double mass = 0;
  Vec<double> com;      ///< own frame, m
  Sym<double> inertia;  ///< about the COM, own axes, kg m^2
};

struct TreePoint {
  std::size_t link = 0;
  Vec<double> centre;  ///< own frame of the link, m
  double radius = 0;
};

/// Constants of one robot, the same in all lanes.
struct Tree {
  Tree(const Robot& robot, Base base, const std::vector<ContactElement>& contacts);

  Base base;
  std::vector<TreeLink> links;    ///< a parent before its children
  std::vector<TreePoint> points;  ///< one a contact element
  std::vector<double> lo, hi;     ///< range of each joint, rad
};

}  // namespace gaitlab::articulated
