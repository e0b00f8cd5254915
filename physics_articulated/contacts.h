// Which points and spheres touch the ground, what acts there, and how it resists over a step.
#pragma once
#include <algorithm>

#include "core/laws/contact.h"
#include "core/laws/plane.h"
#include "physics_articulated/body.h"

namespace gaitlab {
struct Ground;
}

namespace gaitlab::articulated {

/// What an element finds at the ground of its lane.
template <class T>
struct Touch {
  T penetration;    ///< m; negative: the gap
  Vec<T> n, point;  ///< normal; where the force acts, world, m
  T friction;       ///< Coulomb coefficient
};

/// What stands around the robot, a lane each. A ground that is no plane is asked lane by lane: `query`, over Ground::query.
template <class T>
struct Site {
  Vec<T> gravity;
  BasicPenaltyContact<T> law;
  bool plane = true;  ///< in every lane
  T friction = 0.0;   ///< of those planes
  std::vector<const Ground*> ground;
  Touch<double> (*query)(const Ground&, const Vec<double>& centre, double radius) = nullptr;
};

/// One element in contact, as a step of h takes it: forces at the velocity of the step's end (vn+, vt+),
///     normal:   Kn (p - h vn+) - Cd p vn+
///     friction: -gt vt+ while it sticks, gt = f Fn / v_lim;  -f Fn s - gt (1 - s s^T) vt+ while it slides along s, gt = f
///     Fn/|v|
/// with Fn that of the start. For k or d other than 1: the law's slopes at the start. For h = 0 this is the law itself.
template <class T>
struct Contact {
  std::size_t element = 0, link = 0;
  Touch<T> touch;
  Vec<T> x, n, vt;                              ///< where it acts, from the base frame's origin; normal; tangential velocity
  T vn, slip;                                   ///< normal velocity, > 0 separating; size of vt
  typename BasicPenaltyContact<T>::Normal law;  ///< at the start
  T fn, gn;                                     ///< normal force and its slope, N, N s/m; 0 in lanes that do not touch
  T most;                                       ///< f Fn, N
  T push, gt;                                   ///< f Fn while it slides, else 0; slope
  Vec<T> along;                                 ///< s; 0 while it sticks
  math::Mask<T> changed;                        ///< from sticking to sliding or back, in this step

  [[nodiscard]] Vec<T> across(const Vec<T>& v) const { return v - dot(along, v) * along; }
  [[nodiscard]] Vec<T> friction(const Vec<T>& v) const { return -(push * along + gt * across(v)); }
  [[nodiscard]] Vec<T> force() const { return fn * n + friction(vt); }
  /// h times the slope: what Body takes for a resistance.
  [[nodiscard]] Sym<T> slope(double h) const {
    const T zero = 0.0;
    Sym<T> G{h * gt, h * gt, h * gt, zero, zero, zero};
    G.add_square(h * (gn - gt), n);
    G.add_square(-h * gt, along);
    return G;
  }
};

template <class T>
class Contacts {
 public:
  Contacts(const Tree<T>& tree, const Site<T>& site)
      : tree_(tree), site_(site), per_v_lim_(1.0 / site.law.v_lim), first_(tree.links.size() + 1) {
    touching_.reserve(tree.points.size());
    for (std::size_t e = 0; e < tree.points.size(); ++e) order_.push_back(e);
    std::stable_sort(order_.begin(), order_.end(),
                     [&](std::size_t a, std::size_t b) { return tree.points[a].link < tree.points[b].link; });
  }

  /// Fills touching() at the body's present place; what the step makes of them is begin's.
  void find(const Body<T>& body) {
    touching_.clear();
    std::size_t e = 0;
    for (std::size_t link = 0; link + 1 < first_.size(); ++link) {
      first_[link] = touching_.size();
      for (; e < order_.size() && tree_.points[order_[e]].link == link; ++e) {
        const TreePoint<T>& point = tree_.points[order_[e]];
        const Touch<T> found = touch(body.point(link, point.centre) + body.origin(), point.radius);
        if (math::any(found.penetration > T(0.0))) touching_.push_back(contact(body, order_[e], found));
      }
    }
    first_.back() = touching_.size();
  }

  /// Forces and slopes as a step of h takes them; 0: the law itself.
  void begin(double h) {
    using math::select;
    const T zero = 0.0;
    for (Contact<T>& c : touching_) {
      const T ahead = c.law.fn - T(h) * c.law.stiffness * c.vn;
      const auto holds = ahead > zero;  // else it leaves the ground within the step, and nothing pulls it back
      c.fn = select(holds, ahead, zero);
      c.gn = select(holds, c.law.normal_slope + T(h) * c.law.stiffness, zero);
      c.most = select(holds, c.touch.friction * c.law.fn, zero);
      c.push = c.gt = zero;
      c.along = {};
      c.changed = {};
      slide(c, c.slip >= zero, site_.law.slides(c.law, c.slip), c.vt, c.slip);
    }
  }

  /// Loads for Body::solve.
  void load(std::size_t link, typename Body<T>::Load load, double h) const {
    for (std::size_t i = first_[link]; i < first_[link + 1]; ++i) {
      const Contact<T>& c = touching_[i];
      load.add_force(c.x, c.force());
      if (h > 0) load.add_resistance(c.x, c.slope(h));
    }
  }

  /// After Body::solve: whether some that stick end the step faster than v_lim, or that slide end it slower or turned back.
  /// They change, once in a step. (Friction that slides has no slope: alone it would throw a light foot that comes to rest from
  /// one side of v_lim to the other, step after step.)
  bool change(const Body<T>& body, double h) {
    bool more = false;
    for (Contact<T>& c : touching_) {
      const Vec<T> end = c.vt + tangential(c, T(h) * body.change(c.link, c.x));
      const T speed = math::sqrt(dot(end, end));
      const auto slides = c.push > 0.0;
      const auto stops = math::both(slides, math::either(speed < site_.law.v_lim, dot(end, c.along) < 0.0));
      const auto starts = math::both(math::both(c.most > 0.0, c.push <= 0.0), speed > site_.law.v_lim);
      const auto changes = math::fresh(math::either(stops, starts), c.changed);
      if (!math::any(changes)) continue;
      more = true;
      c.changed = math::either(c.changed, changes);
      slide(c, changes, starts, end, speed);
    }
    return more;
  }

  /// Part of v in the ground's plane.
  static Vec<T> tangential(const Contact<T>& c, const Vec<T>& v) { return v - dot(c.n, v) * c.n; }

  [[nodiscard]] std::span<const Contact<T>> touching() const { return touching_; }

 private:
  [[nodiscard]] Touch<T> touch(const Vec<T>& centre, const T& radius) const {
    if (site_.plane) {
      const PlaneTouch<T> found = on_plane(centre.z, radius);
      return {found.penetration, {T(0.0), T(0.0), T(1.0)}, {centre.x, centre.y, found.height}, site_.friction};
    }
    Touch<T> all{};
    for (std::size_t l = 0; l < site_.ground.size(); ++l) {
      const Touch<double> one = site_.query(
          *site_.ground[l], {math::lane(centre.x, l), math::lane(centre.y, l), math::lane(centre.z, l)}, math::lane(radius, l));
      put(all.penetration, l, one.penetration);
      put(all.n, l, one.n);
      put(all.point, l, one.point);
      put(all.friction, l, one.friction);
    }
    return all;
  }

  [[nodiscard]] Contact<T> contact(const Body<T>& body, std::size_t element, const Touch<T>& touch) const {
    Contact<T> c{};
    c.element = element;
    c.link = tree_.points[element].link;
    c.touch = touch;
    c.x = touch.point - body.origin();
    c.n = touch.n;
    const Vec<T> v = body.velocity(c.link, c.x);
    c.vn = dot(c.n, v);
    c.vt = v - c.vn * c.n;
    c.slip = math::sqrt(dot(c.vt, c.vt));
    c.law = site_.law.normal(touch.penetration, c.vn);
    return c;
  }

  /// In the lanes `which`: sliding with velocity v of size `speed`, or sticking.
  void slide(Contact<T>& c, const math::Mask<T>& which, const math::Mask<T>& sliding, const Vec<T>& v, const T& speed) const {
    using math::select;
    const T per_size = math::any(sliding) ? 1.0 / select(sliding, speed, site_.law.v_lim) : per_v_lim_;
    c.push = select(which, select(sliding, c.most, T(0.0)), c.push);
    c.gt = select(which, c.most * per_size, c.gt);
    c.along = select<T>(which, select<T>(sliding, per_size * v, Vec<T>{}), c.along);
  }

  const Tree<T>& tree_;
  const Site<T>& site_;
  T per_v_lim_;
  std::vector<std::size_t> order_;    // elements by link
  std::vector<Contact<T>> touching_;  // in that order
  std::vector<std::size_t> first_;    // of each link in touching_, and the end
};

}  // namespace gaitlab::articulated
