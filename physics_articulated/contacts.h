// Which points and spheres touch the ground, what acts there, and how it resists over a step.
#pragma once
#include "core/laws/contact.h"
#include "core/laws/ground.h"
#include "physics_articulated/body.h"

namespace gaitlab::articulated {

/// One element in contact, as a step of h takes it: forces at the velocity of the step's end (vn+, vt+),
///     normal:   Kn (p - h vn+) - Cd p vn+
///     friction: -gt vt+ while it sticks, gt = f Fn / v_lim;  -f Fn s - gt (1 - s s^T) vt+ while it slides along s, gt = f
///     Fn/|v|
/// with Fn that of the start. For k or d other than 1: the law's slopes at the start. For h = 0 this is the law itself.
template <class T>
struct Contact {
  std::size_t element = 0, link = 0;
  typename Ground::BasicTouch<T> touch;
  Vec<T> x, n, vt;               ///< where it acts, from the base frame's origin; normal; tangential velocity
  T vn;                          ///< normal velocity, > 0 separating
  PenaltyContact::Force<T> law;  ///< at the start
  T fn, gn;                      ///< normal force and its slope, N, N s/m; 0 in lanes that do not touch
  T most;                        ///< f Fn, N
  T push, gt;                    ///< f Fn while it slides, else 0; slope
  Vec<T> along;                  ///< s; 0 while it sticks
  math::Mask<T> changed;         ///< from sticking to sliding or back, in this step

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
  Contacts(const Tree& tree, const Ground& ground, const PenaltyContact& law) : tree_(tree), ground_(ground), law_(law) {
    touching_.reserve(tree.points.size());
  }

  /// Fills touching() at the body's present place.
  void find(const Body<T>& body, double h) {
    touching_.clear();
    if (ground_.kind == Ground::Kind::none) return;
    for (std::size_t e = 0; e < tree_.points.size(); ++e) {
      const TreePoint& point = tree_.points[e];
      const Vec<T> centre = body.point(point.link, point.centre) + body.origin();
      const auto touch = ground_.query(typename Ground::BasicTouch<T>::Vector(centre.x, centre.y, centre.z), point.radius);
      if (math::any(touch.penetration > 0.0)) touching_.push_back(contact(body, e, touch, h));
    }
  }

  void apply(Body<T>& body, double h) const {
    for (const Contact<T>& c : touching_) {
      body.add_force(c.link, c.x, c.force());
      if (h > 0) body.add_resistance(c.link, c.x, c.slope(h));
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
      const auto stops = math::both(slides, math::either(speed < law_.v_lim, dot(end, c.along) < 0.0));
      const auto starts = math::both(math::both(c.most > 0.0, c.push <= 0.0), speed > law_.v_lim);
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
  [[nodiscard]] Contact<T> contact(const Body<T>& body, std::size_t element, const typename Ground::BasicTouch<T>& touch,
                                   double h) const {
    using math::select;
    const T zero = 0.0;
    Contact<T> c{};
    c.element = element;
    c.link = tree_.points[element].link;
    c.touch = touch;
    c.x = Vec<T>{touch.point[0], touch.point[1], touch.point[2]} - body.origin();
    c.n = {touch.normal[0], touch.normal[1], touch.normal[2]};
    const Vec<T> v = body.velocity(c.link, c.x);
    c.vn = dot(c.n, v);
    c.vt = v - c.vn * c.n;
    const T slip = math::sqrt(dot(c.vt, c.vt));
    c.law = law_(touch.penetration, c.vn, slip, touch.friction);
    const T ahead = c.law.fn - h * c.law.stiffness * c.vn;
    const auto holds = ahead > 0.0;  // else it leaves the ground within the step, and nothing pulls it back
    c.fn = select(holds, ahead, zero);
    c.gn = select(holds, c.law.normal_slope + h * c.law.stiffness, zero);
    c.most = select(holds, touch.friction * c.law.fn, zero);
    slide(c, slip >= 0.0, c.law.sliding, c.vt, slip);
    return c;
  }

  /// In the lanes `which`: sliding with velocity v of size `speed`, or sticking.
  void slide(Contact<T>& c, const math::Mask<T>& which, const math::Mask<T>& sliding, const Vec<T>& v, const T& speed) const {
    using math::select;
    const T size = select(sliding, speed, T(law_.v_lim));
    c.push = select(which, select(sliding, c.most, T(0.0)), c.push);
    c.gt = select(which, c.most / size, c.gt);
    c.along = select<T>(which, select<T>(sliding, (1.0 / size) * v, Vec<T>{}), c.along);
  }

  const Tree& tree_;
  Ground ground_;
  PenaltyContact law_;
  std::vector<Contact<T>> touching_;
};

}  // namespace gaitlab::articulated
