// Contacts of points and spheres with the ground: forces, and their dependence on the velocities at the end of a step.
#pragma once
#include <algorithm>

#include "core/laws/contact.h"
#include "core/laws/plane.h"
#include "physics_articulated/body.h"

namespace gaitlab {
struct Ground;
}

namespace gaitlab::articulated {

/// Contact geometry of an element on the ground of its lane.
template <class T>
struct Touch {
  T penetration;    ///< m; negative if there is a gap
  Vec<T> n, point;  ///< normal; point of action, world, m
  T friction;       ///< Coulomb coefficient
};

/// Gravity, contact law and ground of the lanes. If a ground is not a plane, `query` evaluates it lane by lane with
/// Ground::query.
template <class T>
struct Environment {
  Vec<T> gravity;
  BasicPenaltyContact<T> law;
  bool plane = true;  ///< true if all lanes have planes
  T friction = 0.0;   ///< friction coefficients of the planes
  std::vector<const Ground*> ground;
  Touch<double> (*query)(const Ground&, const Vec<double>& centre, double radius) = nullptr;
  OtherDynamics* dynamics = nullptr;  ///< forces at rest in place of those of the recursion, for one lane; may be null
};

/// An element that touches the ground, or may touch it before the step ends. Its forces depend on the velocity (vn+, vt+) at
/// the end of a step h, at which the depth is p+ = depth - h vn+:
///     normal:   Kn p+^k - D vn+ >= 0, while p+ > 0
///     friction: -f Fn vt+ / max(|vt+|, v_lim)
/// For elements that touch at the start, D = Cd p^d with p at the present place of the body. For elements that land, D = Cd
/// p+^d. Friction uses the normal force at the present place and the velocity at the start of the step. All forces fall with
/// the velocity, so that the step has one solution. A solve uses the following tangents, in which s is the direction of slip:
///     fn - normal_damping (vn - vn_start), -sliding_force s - tangential_damping (1 - s s^T) vt
template <class T>
struct Contact {
  std::size_t element = 0, link = 0;
  Touch<T> touch;
  Vec<T> x, n, vt;  ///< point of action, from the origin of the base frame; normal; tangential velocity
  T vn, slip;       ///< normal velocity, > 0 if separating; magnitude of vt
  typename BasicPenaltyContact<T>::Normal law;  ///< normal force at the present place
  T depth;                                      ///< depth at the start of the step, m
  T damping;                                    ///< D, N s/m
  T fn, normal_damping;                         ///< tangent of the normal force, N, N s/m
  T friction_limit;                             ///< f Fn, N
  T sliding_force, tangential_damping;          ///< f Fn if the element slides, else 0; slope of friction
  Vec<T> slip_direction;                        ///< unit vector s of the slip; 0 if the element sticks
  Vec<T> change, held;                          ///< at the iterate: change of velocity, m/s; force in the solve, N
  Vec<T> next_change, next_held;                ///< change and force of the last solve

  [[nodiscard]] Vec<T> across(const Vec<T>& v) const { return v - dot(slip_direction, v) * slip_direction; }
  [[nodiscard]] Vec<T> friction(const Vec<T>& v) const {
    return -(sliding_force * slip_direction + tangential_damping * across(v));
  }
  [[nodiscard]] Vec<T> force() const { return fn * n + friction(vt); }
  /// Tangent force in a solve for a change dv of the velocity, N.
  [[nodiscard]] Vec<T> force(const Vec<T>& dv) const {
    const T normal = dot(n, dv);
    return (fn - normal_damping * normal) * n + friction(vt + (dv - normal * n));
  }
  /// Resistance for Body: h times the slope of the force.
  [[nodiscard]] Sym<T> slope(double h) const {
    const T zero = 0.0;
    Sym<T> G{h * tangential_damping, h * tangential_damping, h * tangential_damping, zero, zero, zero};
    G.add_square(h * (normal_damping - tangential_damping), n);
    G.add_square(-h * tangential_damping, slip_direction);
    return G;
  }
};

template <class T>
class Contacts {
 public:
  Contacts(const Tree<T>& tree, const Environment<T>& environment)
      : tree_(tree), environment_(environment), per_v_lim_(1.0 / environment.law.v_lim), first_(tree.links.size() + 1) {
    touching_.reserve(tree.points.size());
    for (std::size_t e = 0; e < tree.points.size(); ++e) order_.push_back(e);
    std::stable_sort(order_.begin(), order_.end(),
                     [&](std::size_t a, std::size_t b) { return tree.points[a].link < tree.points[b].link; });
    extent_.assign(tree.links.size(), T(0.0));
    for (const TreePoint<T>& point : tree.points) {
      T& extent = extent_[point.link];
      const T own = math::sqrt(dot(point.centre, point.centre)) + point.radius;
      extent = math::select(own > extent, own, extent);
    }
  }

  /// Fills touching() at the present place of the body, to which it has moved for `ahead` seconds at its velocities. With
  /// `reach` > 0 (s), elements that may touch within this time are included.
  void find(const TreeBody<T>& body, double ahead, double reach) {
    touching_.clear();
    std::size_t e = 0;
    for (std::size_t link = 0; link + 1 < first_.size(); ++link) {
      first_[link] = touching_.size();
      if (e == order_.size() || tree_.points[order_[e]].link != link) continue;
      const T farthest = reach_of(body, link, reach);
      for (; e < order_.size() && tree_.points[order_[e]].link == link; ++e) {
        const TreePoint<T>& point = tree_.points[order_[e]];
        if (environment_.plane && !math::any_lane(on_plane(height(body, link, point), point.radius).penetration > -farthest))
          continue;
        Touch<T> found = touch(body.point(link, point.centre) + body.origin(), point.radius);
        found.friction = found.friction * point.friction;
        const Vec<T> x = found.point - body.origin();
        const Vec<T> v = body.velocity(link, x);
        const T gap = T(reach) * math::sqrt(dot(v, v)) + T(kPull * reach * reach);
        const auto near = found.penetration > -gap;
        if (!math::any_lane(near)) continue;
        Contact<T>& c = touching_.emplace_back(contact(order_[e], link, found, x, v, ahead));
        c.depth = math::select(near, c.depth, T(kFar));  // included because of other lanes
      }
    }
    first_.back() = touching_.size();
  }

  /// Sets the tangents at the velocity at the start, for a step h. With h = 0, sets the forces of the law itself.
  void begin(double h) {
    for (Contact<T>& c : touching_) {
      const Normal end = h > 0 ? normal(c, c.vn, h) : Normal{c.law.fn, c.law.normal_slope};
      c.fn = end.fn;
      c.normal_damping = end.slope;
      c.friction_limit = c.touch.friction * c.law.fn;
      c.sliding_force = c.tangential_damping = T(0.0);
      c.slip_direction = {};
      slide(c, c.slip >= T(0.0), math::mask_and(c.friction_limit > T(0.0), c.slip > environment_.law.v_lim), c.vt, c.slip);
    }
  }

  /// Adds the contact forces and resistances on a link in TreeBody::solve.
  void load(std::size_t link, typename TreeBody<T>::Load load, double h) const {
    for (std::size_t i = first_[link]; i < first_[link + 1]; ++i) {
      const Contact<T>& c = touching_[i];
      if (!math::any_lane(math::mask_or(c.friction_limit > T(0.0), math::mask_or(c.fn > T(0.0), c.normal_damping > T(0.0)))))
        continue;  // element in the air in all lanes
      load.add_force(c.x, c.force());
      if (h > 0) load.add_resistance(c.x, c.slope(h));
    }
  }

  /// Stores the result of TreeBody::solve.
  void solved(const TreeBody<T>& body, double h) {
    for (Contact<T>& c : touching_) {
      c.next_change = T(h) * body.change(c.link, c.x);
      c.next_held = c.force(c.next_change);
    }
  }
  /// Moves the iterate by `share` of the way to the last solve, in the lanes `which`.
  void move(const math::Mask<T>& which, const T& share) {
    for (Contact<T>& c : touching_) {
      c.change = between(which, share, c.change, c.next_change);
      c.held = between(which, share, c.held, c.next_held);
    }
  }
  /// Moves the iterate to the last solve, in the lanes `which`.
  void move(const math::Mask<T>& which) {
    for (Contact<T>& c : touching_) {
      c.change = select(which, c.next_change, c.change);
      c.held = select(which, c.next_held, c.held);
    }
  }
  /// Power of the forces of the solve minus the forces of the laws, at `share` of the way from the iterate to the last solve.
  [[nodiscard]] T excess(const T& share, double h) const {
    T sum = 0.0;
    for (const Contact<T>& c : touching_) {
      const Vec<T> d = c.next_change - c.change;
      sum = sum + dot(d, (c.held + share * (c.next_held - c.held)) - law(c, c.change + share * d, h));
    }
    return sum;
  }
  /// Lanes in which a force at the iterate differs from its law by more than the tolerance. The tolerance of the normal force
  /// is 0.1 % and 1e-5 N. The tolerance of the friction vector is a tenth of f Fn. If an element changes between sticking and
  /// sliding, the tolerance of friction is 1e-6 of f Fn. Tighter tolerances would need more solves and would not reduce the
  /// error.
  [[nodiscard]] math::Mask<T> off(double h) const {
    using math::mask_or;
    math::Mask<T> all{};
    for (const Contact<T>& c : touching_) {
      const T dn = dot(c.n, c.change);
      const auto down = c.depth - T(h) * (c.vn + dn) > T(0.0);
      const auto held_before = dot(c.held, c.held) > T(0.0);
      if (!math::any_lane(mask_or(down, mask_or(held_before, mask_or(c.friction_limit > T(0.0), c.normal_damping > T(0.0))))))
        continue;  // element in the air in all lanes
      const T fn = normal(c, c.vn + dn, h).fn;
      const T held = dot(c.n, c.held);
      all = mask_or(all, math::abs(fn - held) > kNormalTolerance * math::select(fn > held, fn, held) + kNormalFloor);
      const Vec<T> end = c.vt + (c.change - dn * c.n);
      const Vec<T> miss = (c.held - held * c.n) - friction(c, end);
      const auto slides = dot(end, end) > environment_.law.v_lim * environment_.law.v_lim;
      const auto slid = c.sliding_force > T(0.0);
      const auto crossed = mask_or(math::fresh(slides, slid), math::fresh(slid, slides));
      const T tolerance = math::select(crossed, T(kCornerTolerance), T(kFrictionTolerance)) * c.friction_limit + kFrictionFloor;
      all = mask_or(all, dot(miss, miss) > tolerance * tolerance);
    }
    return all;
  }
  /// Lanes in which sliding elements carry more than half of the load in the last solve. Friction of sliding elements does not
  /// damp motion along the direction of slip.
  [[nodiscard]] math::Mask<T> mostly_slide() const {
    T load = 0.0, sliding = 0.0;
    for (const Contact<T>& c : touching_) {
      const T fn = dot(c.n, c.held);
      load = load + fn;
      sliding = sliding + math::select(c.sliding_force > T(0.0), fn, T(0.0));
    }
    return sliding > T(0.5) * load;
  }
  /// Sets the tangents at the iterate, in the lanes `which`.
  void touch(const math::Mask<T>& which, double h) {
    using math::select;
    for (Contact<T>& c : touching_) {
      const T dn = dot(c.n, c.change);
      const Normal n = normal(c, c.vn + dn, h);
      c.normal_damping = select(which, n.slope, c.normal_damping);
      c.fn = select(which, n.fn + n.slope * dn, c.fn);
      const Vec<T> end = c.vt + (c.change - dn * c.n);
      const T speed = math::sqrt(dot(end, end));
      slide(c, which, math::mask_and(c.friction_limit > T(0.0), speed > environment_.law.v_lim), end, speed);
    }
  }

  [[nodiscard]] std::span<const Contact<T>> touching() const { return touching_; }

 private:
  static constexpr double kRoom = 1 + 1e-9;
  static constexpr double kFar = -1e9;  ///< m; depth at a gap that no step closes
  static constexpr double kPull = 100;  ///< m/s^2; largest acceleration of an element in the air, by weight and motors
  static constexpr double kNormalTolerance = 1e-3, kNormalFloor = 1e-5, kFrictionTolerance = 0.1, kCornerTolerance = 1e-6;
  static constexpr double kFrictionFloor = 1e-9;  // N

  /// Largest gap at which find() includes an element of the link, m, with a margin for rounding errors.
  [[nodiscard]] T reach_of(const TreeBody<T>& body, std::size_t link, double reach) const {
    const Vec<T> v = body.velocity(link, body.point(link, {}));
    const Vec<T>& w = body.turning(link);
    const T speed = math::sqrt(dot(v, v)) + math::sqrt(dot(w, w)) * extent_[link];
    return T(kRoom * reach) * speed + T(kRoom * kPull * reach * reach + kRoom - 1);
  }
  /// Height of the centre of an element, m, with the same bits as in find().
  [[nodiscard]] T height(const TreeBody<T>& body, std::size_t link, const TreePoint<T>& point) const {
    return body.height(link, point.centre) + body.origin().z;
  }

  struct Normal {
    T fn, slope;
  };
  /// Normal force and its slope if a step h ends with the normal velocity vn.
  [[nodiscard]] Normal normal(const Contact<T>& c, const T& vn, double h) const {
    using math::select;
    const T zero = 0.0;
    const T p = c.depth - T(h) * vn;
    const auto down = p > zero;
    if (!math::any_lane(down)) return {zero, zero};
    const auto touched = c.depth > zero;
    const T damping = select(touched, c.damping, environment_.law.damping(p));
    const T fn = environment_.law.spring(p) - damping * vn;
    const T steeper = math::all_lanes(touched) ? zero : select(touched, zero, environment_.law.damping_slope(p) * vn);
    const T slope = damping + T(h) * (environment_.law.stiffness(p) - steeper);
    const auto acts = math::mask_and(down, fn > zero);
    return {select(acts, fn, zero), select(math::mask_and(acts, slope > zero), slope, zero)};
  }
  /// Friction force at a tangential velocity.
  [[nodiscard]] Vec<T> friction(const Contact<T>& c, const Vec<T>& v) const {
    const T speed = math::sqrt(dot(v, v));
    return -(c.friction_limit / math::select(speed > environment_.law.v_lim, speed, environment_.law.v_lim)) * v;
  }
  [[nodiscard]] Vec<T> law(const Contact<T>& c, const Vec<T>& change, double h) const {
    const T n = dot(c.n, change);
    return normal(c, c.vn + n, h).fn * c.n + friction(c, c.vt + (change - n * c.n));
  }

  [[nodiscard]] Touch<T> touch(const Vec<T>& centre, const T& radius) const {
    if (environment_.plane) {
      const PlaneTouch<T> found = on_plane(centre.z, radius);
      return {found.penetration, {T(0.0), T(0.0), T(1.0)}, {centre.x, centre.y, found.height}, environment_.friction};
    }
    Touch<T> all{};
    for (std::size_t l = 0; l < environment_.ground.size(); ++l) {
      const Touch<double> one = environment_.query(*environment_.ground[l],
                                                   {math::lane(centre.x, l), math::lane(centre.y, l), math::lane(centre.z, l)},
                                                   math::lane(radius, l));
      put(all.penetration, l, one.penetration);
      put(all.n, l, one.n);
      put(all.point, l, one.point);
      put(all.friction, l, one.friction);
    }
    return all;
  }

  [[nodiscard]] Contact<T> contact(std::size_t element, std::size_t link, const Touch<T>& touch, const Vec<T>& x,
                                   const Vec<T>& v, double ahead) const {
    Contact<T> c{};
    c.element = element;
    c.link = link;
    c.touch = touch;
    c.x = x;
    c.n = touch.n;
    c.vn = dot(c.n, v);
    c.vt = v - c.vn * c.n;
    c.slip = math::sqrt(dot(c.vt, c.vt));
    c.law = environment_.law.normal(touch.penetration, c.vn);
    c.depth = touch.penetration + T(ahead) * c.vn;
    c.damping = math::select(touch.penetration > T(0.0), environment_.law.damping(touch.penetration), T(0.0));
    return c;
  }

  /// Sets the friction tangent in the lanes `which`: sliding with velocity v of magnitude `speed`, or sticking.
  void slide(Contact<T>& c, const math::Mask<T>& which, const math::Mask<T>& sliding, const Vec<T>& v, const T& speed) const {
    using math::select;
    const T per_size = math::any_lane(sliding) ? 1.0 / select(sliding, speed, environment_.law.v_lim) : per_v_lim_;
    c.sliding_force = select(which, select(sliding, c.friction_limit, T(0.0)), c.sliding_force);
    c.tangential_damping = select(which, c.friction_limit * per_size, c.tangential_damping);
    c.slip_direction = select<T>(which, select<T>(sliding, per_size * v, Vec<T>{}), c.slip_direction);
  }

  const Tree<T>& tree_;
  const Environment<T>& environment_;
  T per_v_lim_;
  std::vector<std::size_t> order_;    // elements by link
  std::vector<Contact<T>> touching_;  // contacts found, sorted by link
  std::vector<std::size_t> first_;    // index in touching_ of the first element of each link, and the end
  std::vector<T> extent_;             // largest distance of the points of a link from its origin, m
};

}  // namespace gaitlab::articulated
