// Robots of the lanes in the form that the recursion needs: the joint axis is z of the link frame.
#pragma once
#include <span>
#include <vector>

#include "core/laws/gear_play.h"
#include "core/laws/passive_hinge.h"
#include "core/model/base.h"
#include "physics_articulated/vector.h"

namespace gaitlab {
struct Robot;
struct ContactElement;
}  // namespace gaitlab

namespace gaitlab::articulated {

template <class T>
struct TreeLink {
  std::size_t parent = 0, joint = 0;  ///< not used for link 0
  bool leaf = true;                   ///< true if the link has no children
  bool last_child = false;            ///< true for the last child of a parent
  Mat<T> at_zero;                     ///< link axes in the parent link, at joint angle 0
  Vec<T> origin;                      ///< origin of the link frame in the parent link, m
  T mass = 0.0;
  Vec<T> com;      ///< link frame, m
  Sym<T> inertia;  ///< about the COM, link axes, kg m^2
};

template <class T>
struct TreePoint {
  std::size_t link = 0;
  Vec<T> centre;  ///< link frame, m
  T radius = 0.0;
  T friction = 1.0;  ///< factor on the ground's coefficient
};

/// A joint whose gear has play.
template <class T>
struct TreePlay {
  std::size_t joint = 0;
  BasicGearPlay<T> law;
};

/// Constants of the robots of all lanes. All lanes have the same links, joints and points, but may have different numbers.
template <class T>
struct Tree {
  Base base = Base::floating;
  std::vector<TreeLink<T>> links;            ///< a parent before its children
  std::vector<TreePoint<T>> points;          ///< one per contact element
  std::vector<T> lo, hi;                     ///< range of each joint, rad; infinite without a stop
  std::vector<std::size_t> passive;          ///< joints without a motor
  std::vector<BasicPassiveHinge<T>> hinges;  ///< laws of these joints
  std::vector<TreePlay<T>> plays;            ///< in the order of the joints
};

Tree<double> tree(const Robot& robot, Base base, const std::vector<ContactElement>& contacts);

template <class T>
void put(T& to, std::size_t lane, double from) {
  math::lane(to, lane) = from;
}
template <class T>
void put(Vec<T>& to, std::size_t lane, const Vec<double>& from) {
  put(to.x, lane, from.x);
  put(to.y, lane, from.y);
  put(to.z, lane, from.z);
}
template <class T>
void put(Mat<T>& to, std::size_t lane, const Mat<double>& from) {
  put(to.x, lane, from.x);
  put(to.y, lane, from.y);
  put(to.z, lane, from.z);
}
template <class T>
void put(Sym<T>& to, std::size_t lane, const Sym<double>& from) {
  put(to.xx, lane, from.xx);
  put(to.yy, lane, from.yy);
  put(to.zz, lane, from.zz);
  put(to.xy, lane, from.xy);
  put(to.xz, lane, from.xz);
  put(to.yz, lane, from.yz);
}

/// Joins the trees of the lanes, which have the same structure.
template <class T>
Tree<T> side_by_side(std::span<const Tree<double>* const> lanes) {
  const Tree<double>& first = *lanes[0];
  Tree<T> all;
  all.base = first.base;
  all.links.resize(first.links.size());
  all.points.resize(first.points.size());
  all.lo.resize(first.lo.size());
  all.hi.resize(first.hi.size());
  all.passive = first.passive;
  all.hinges.resize(first.hinges.size());
  all.plays.resize(first.plays.size());
  for (std::size_t l = 0; l < lanes.size(); ++l) {
    const Tree<double>& one = *lanes[l];
    for (std::size_t i = 0; i < all.links.size(); ++i) {
      TreeLink<T>& to = all.links[i];
      const TreeLink<double>& from = one.links[i];
      to.parent = from.parent;
      to.joint = from.joint;
      to.leaf = from.leaf;
      to.last_child = from.last_child;
      put(to.at_zero, l, from.at_zero);
      put(to.origin, l, from.origin);
      put(to.mass, l, from.mass);
      put(to.com, l, from.com);
      put(to.inertia, l, from.inertia);
    }
    for (std::size_t i = 0; i < all.points.size(); ++i) {
      all.points[i].link = one.points[i].link;
      put(all.points[i].centre, l, one.points[i].centre);
      put(all.points[i].radius, l, one.points[i].radius);
      put(all.points[i].friction, l, one.points[i].friction);
    }
    for (std::size_t j = 0; j < all.lo.size(); ++j) {
      put(all.lo[j], l, one.lo[j]);
      put(all.hi[j], l, one.hi[j]);
    }
    for (std::size_t k = 0; k < all.passive.size(); ++k) {
      BasicPassiveHinge<T>& to = all.hinges[k];
      const PassiveHinge& from = one.hinges[k];
      put(to.stiffness, l, from.stiffness);
      put(to.rest, l, from.rest);
      put(to.damping, l, from.damping);
      put(to.friction, l, from.friction);
      put(to.friction_speed, l, from.friction_speed);
    }
    for (std::size_t k = 0; k < all.plays.size(); ++k) {
      all.plays[k].joint = one.plays[k].joint;
      put(all.plays[k].law.half, l, one.plays[k].law.half);
      put(all.plays[k].law.stiffness, l, one.plays[k].law.stiffness);
    }
  }
  return all;
}

}  // namespace gaitlab::articulated
