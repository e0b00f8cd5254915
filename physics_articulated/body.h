// Articulated-body recursion with resistances of joints and points, for a scalar type T (double or lanes).
#pragma once
#include <span>
#include <vector>

#include "core/math/functions.h"
#include "core/simulation/state_layout.h"
#include "physics_articulated/cholesky.h"
#include "physics_articulated/other_dynamics.h"
#include "physics_articulated/spatial.h"
#include "physics_articulated/tree.h"

namespace gaitlab::articulated {

/// Joints whose acceleration is given, and the torques that they need.
template <class T>
struct Locks {
  explicit Locks(std::size_t joints) : on(joints), acceleration(joints, T(0.0)), torque(joints, T(0.0)) {}
  std::vector<math::Mask<T>> on;  ///< by joint: lanes in which the joint is locked
  std::vector<T> acceleration;    ///< rad/s^2
  std::vector<T> torque;          ///< result of TreeBody::solve: torque in addition to the given one, N m
};

/// Solves (M + K) v' = f - c in O(links), with the resistance K = diagonal + sum J^T G J. The vector v' contains the
/// acceleration of the origin of the base frame, the angular acceleration of the base, and the joint accelerations. A
/// resistance acts on one joint, or on one body against the world, so that it fits into the recursion. The algorithm is from
/// Featherstone, Rigid Body Dynamics Algorithms, 2008, 7.3. It uses world axes about the origin of the base frame, so that
/// inertia and force of a child are added to the parent unchanged. Forces are those at the start of the step. Weight is a force
/// on each link and not an acceleration of the base, so that dampers act on true velocities.
///
/// forward_kinematics() is called first, then solve() any number of times. respond() uses the matrix of the last solve(). The
/// state has the entries of StateLayout, SI; the quaternion may have any length except 0. Only the constructor allocates.
template <class T>
class TreeBody {
 public:
  /// `other` is for one lane only. Its acceleration then replaces weight, centrifugal and gyroscopic forces.
  TreeBody(const Tree<T>& tree, const Vec<T>& gravity, OtherDynamics* other = nullptr)
      : tree_(tree), gravity_(gravity), links_(tree.links.size()), other_(other), fall_(6 + tree.lo.size()) {}

  /// Computes poses, velocities, inertias, weight, and centrifugal and gyroscopic forces from the state.
  void forward_kinematics(std::span<const T> state) {
    place_base(state);
    weigh(0);
    for (std::size_t i = 1; i < links_.size(); ++i) {
      place_link(i, state);
      weigh(i);
    }
    if constexpr (math::kLanes<T> == 1) {
      if (other_ != nullptr) take_forces(state);
    }
  }

  /// Receiver of the forces and resistances on one link, while solve() processes the link.
  class Load {
   public:
    /// Adds a force (N, world axes) at the point x relative to the origin of the base frame.
    void add_force(const Vec<T>& x, const Vec<T>& force) { p_ -= force_at(x, force); }
    void add_moment(const Vec<T>& moment) { p_.n -= moment; }
    /// Adds a force -G J v' on the point x. G has the unit of a mass.
    void add_resistance(const Vec<T>& x, const Sym<T>& G) {
      I_ += resistance(x, G);
      // J v' is the part of the acceleration of the point that v' causes. The remaining part, `bias`, is known beforehand.
      add_force(x, G * bias_.at(x));
    }

   private:
    friend TreeBody;
    Load(Inertia<T>& I, Force<T>& p, const SpatialMotion<T>& bias) : I_(I), p_(p), bias_(bias) {}
    Inertia<T>& I_;
    Force<T>& p_;
    const SpatialMotion<T>& bias_;
  };

  /// Computes v' in `out` (6 + joints entries). `torque` (N m) and `diagonal` (kg m^2) have one entry per joint. loads(link,
  /// Load) is called once per link, from the last link to the first. `locks` may be null. Locked joints are part of the
  /// recursion, without further equations.
  template <class Loads>
  void solve(std::span<const T> torque, std::span<const T> diagonal, std::span<T> out, Loads loads, Locks<T>* locks = nullptr) {
    for (std::size_t i = links_.size(); i-- > 1;) {
      Link& l = links_[i];
      const TreeLink<T>& constant = tree_.links[i];
      Inertia<T> I = constant.leaf ? rigid(constant.mass, l.moment, l.about_origin) : l.I;
      Force<T> p = constant.leaf ? l.at_rest : l.p;
      loads(i, Load(I, p, l.bias));
      l.U = I * l.S;
      l.resistance = dot(l.S, l.U) + diagonal[constant.joint];
      l.inverse = 1.0 / l.resistance;
      l.u = torque[constant.joint] - dot(l.S, p);
      T own = l.inverse * l.u;  // acceleration of the joint on a parent at rest
      if (locks != nullptr) {   // the link of a locked joint adds its whole inertia to its parent
        const auto& on = locks->on[constant.joint];
        l.inverse = math::select(on, T(0.0), l.inverse);
        own = math::select(on, locks->acceleration[constant.joint], own);
      }
      I.add_square(-l.inverse, l.U);
      p += I * l.c;
      add_scaled(p, own, l.U);
      Link& parent = links_[constant.parent];
      if (constant.last_child) {  // first child in this pass
        parent.I = rigid(tree_.links[constant.parent].mass, parent.moment, parent.about_origin);
        parent.p = parent.at_rest;
      }
      parent.I += I;
      parent.p += p;
    }
    Link& base = links_[0];
    if (tree_.links[0].leaf) {
      base.I = rigid(tree_.links[0].mass, base.moment, base.about_origin);
      base.p = base.at_rest;
    }
    loads(0, Load(base.I, base.p, base.bias));
    factor_base();
    spread(base_acceleration(), true, out, locks);
    // Difference between d/dt of the velocity of the origin and the spatial acceleration.
    const Vec<T> turning = cross(links_[0].V.w, links_[0].V.v);
    out[0] = out[0] + turning.x;
    out[1] = out[1] + turning.y;
    out[2] = out[2] + turning.z;
  }

  /// Computes v' = (M + K)^-1 f with the matrix of the last solve(). f and out have 6 + joints entries, beginning with the
  /// force at the origin of the base frame.
  void respond(std::span<const T> f, std::span<T> out) {
    for (Link& l : links_) l.p = {};
    links_[0].p = {{-f[3], -f[4], -f[5]}, {-f[0], -f[1], -f[2]}};
    for (std::size_t i = links_.size(); i-- > 1;) {
      Link& l = links_[i];
      l.u = f[6 + tree_.links[i].joint] - dot(l.S, l.p);
      Force<T>& parent = links_[tree_.links[i].parent].p;
      parent += l.p;
      add_scaled(parent, l.inverse * l.u, l.U);
    }
    spread(base_acceleration(), false, out, nullptr);
  }

  [[nodiscard]] Vec<T> com() const {
    Vec<T> moment{};
    T mass = 0.0;
    for (std::size_t i = 0; i < links_.size(); ++i) {
      moment += links_[i].moment;
      mass = mass + tree_.links[i].mass;
    }
    return origin_ + (T(1.0) / mass) * moment;
  }
  [[nodiscard]] const Vec<T>& origin() const { return origin_; }  ///< origin of the base frame, world, m
  /// Position of a point fixed to a link, relative to the origin of the base frame.
  [[nodiscard]] Vec<T> point(std::size_t link, const Vec<T>& in_link) const {
    return links_[link].r + links_[link].R * in_link;
  }
  /// z coordinate of point().
  [[nodiscard]] T height(std::size_t link, const Vec<T>& in_link) const {
    const Mat<T>& R = links_[link].R;
    return links_[link].r.z + (R.x.z * in_link.x + R.y.z * in_link.y + R.z.z * in_link.z);
  }
  [[nodiscard]] const Vec<T>& turning(std::size_t link) const { return links_[link].V.w; }  ///< angular velocity, rad/s
  [[nodiscard]] Vec<T> velocity(std::size_t link, const Vec<T>& x) const { return links_[link].V.at(x); }
  /// J v' of a point after solve(): the part of the acceleration of the point that v' causes.
  [[nodiscard]] Vec<T> change(std::size_t link, const Vec<T>& x) const {
    return links_[link].A.at(x) - links_[link].bias.at(x);
  }

 private:
  struct Link {
    Mat<T> R;               ///< axes of the link in the world
    Vec<T> r;               ///< origin of the link, relative to the origin of the base frame
    SpatialMotion<T> S;     ///< motion for unit speed of the joint
    SpatialMotion<T> V;     ///< velocity
    SpatialMotion<T> c;     ///< velocity-dependent acceleration of the joint
    SpatialMotion<T> bias;  ///< acceleration for v' = 0
    Vec<T> moment;          ///< mass times COM
    Sym<T> about_origin;    ///< inertia about the origin
    Force<T> at_rest;       ///< initial value of p: weight, centrifugal and gyroscopic forces
    Inertia<T> I;           ///< articulated inertia: rigid inertia plus the parts of the children
    Force<T> p;             ///< bias force, including the parts of the children
    Force<T> U;             ///< I S
    T resistance;           ///< S^T I S + diagonal
    T inverse, u;           ///< 1 / resistance, or 0 if the joint is locked; net torque on the joint
    SpatialMotion<T> A;     ///< acceleration
  };

  static void add_scaled(Force<T>& to, const T& s, const Force<T>& U) {
    to.n += s * U.n;
    to.f += s * U.f;
  }

  void place_base(std::span<const T> s) {
    Link& base = links_[0];
    origin_ = {s[0], s[1], s[2]};
    constexpr std::size_t o = StateLayout::kOrientation;
    base.R = rotation(s[o], s[o + 1], s[o + 2], s[o + 3]);
    constexpr std::size_t v = StateLayout::kVelocity;
    constexpr std::size_t w = StateLayout::kAngularVelocity;
    base.V = {{s[w], s[w + 1], s[w + 2]}, {s[v], s[v + 1], s[v + 2]}};
    base.bias = {{}, -cross(base.V.w, base.V.v)};
  }

  void place_link(std::size_t i, std::span<const T> state) {
    const TreeLink<T>& constant = tree_.links[i];
    const Link& parent = links_[constant.parent];
    Link& l = links_[i];
    const T& q = state[StateLayout::kAngles + constant.joint];
    const T& qd = state[StateLayout::kAngles + tree_.lo.size() + constant.joint];
    const auto [sin, cos] = math::sincos(q);
    l.r = parent.r + parent.R * constant.origin;
    const Mat<T> at_zero = parent.R * constant.at_zero;
    l.R = {cos * at_zero.x + sin * at_zero.y, cos * at_zero.y - sin * at_zero.x, at_zero.z};
    l.S = {l.R.z, cross(l.r, l.R.z)};
    l.c = qd * cross(parent.V, l.S);
    l.V = parent.V + qd * l.S;
    l.bias = parent.bias + l.c;
  }

  void weigh(std::size_t i) {
    const TreeLink<T>& constant = tree_.links[i];
    Link& l = links_[i];
    const Vec<T> c = l.r + l.R * constant.com;
    const Vec<T> h = constant.mass * c;
    l.moment = h;
    l.about_origin = about(c, h, turned(l.R, constant.inertia));
    const Vec<T> weight = constant.mass * gravity_;
    const Vec<T> momentum = constant.mass * l.V.v + cross(l.V.w, h);
    const Vec<T> angular = l.about_origin * l.V.w + cross(h, l.V.v);
    l.at_rest.n = cross(l.V.w, angular) + cross(l.V.v, momentum) - cross(c, weight);
    l.at_rest.f = cross(l.V.w, momentum) - weight;
  }

  /// Computes the forces at rest from the acceleration of `other_`: p = -I A.
  void take_forces(std::span<const T> state) {
    other_->fall(state, fall_);
    const Vec<T> turning = cross(links_[0].V.w, links_[0].V.v);
    links_[0].A = {{fall_[3], fall_[4], fall_[5]}, Vec<T>{fall_[0], fall_[1], fall_[2]} - turning};
    for (std::size_t i = 0; i < links_.size(); ++i) {
      Link& l = links_[i];
      if (i > 0) l.A = links_[tree_.links[i].parent].A + l.c + fall_[6 + tree_.links[i].joint] * l.S;
      const Force<T> causes = rigid(tree_.links[i].mass, l.moment, l.about_origin) * l.A;
      l.at_rest = {-causes.n, -causes.f};
    }
  }

  /// Computes accelerations from the base outwards. If `moving`, they include velocity-dependent terms.
  void spread(const SpatialMotion<T>& base, bool moving, std::span<T> out, Locks<T>* locks) {
    links_[0].A = base;
    const SpatialMotion<T>& a = base;
    out[0] = a.v.x;
    out[1] = a.v.y;
    out[2] = a.v.z;
    out[3] = a.w.x;
    out[4] = a.w.y;
    out[5] = a.w.z;
    for (std::size_t i = 1; i < links_.size(); ++i) {
      Link& l = links_[i];
      const SpatialMotion<T>& parent = links_[tree_.links[i].parent].A;
      const SpatialMotion<T> carried = moving ? parent + l.c : parent;
      const T net = l.u - dot(carried, l.U);
      const std::size_t j = tree_.links[i].joint;
      T qdd = l.inverse * net;
      if (locks != nullptr) {
        qdd = math::select(locks->on[j], locks->acceleration[j], qdd);
        locks->torque[j] = l.resistance * qdd - net;
      }
      out[6 + j] = qdd;
      l.A = carried + qdd * l.S;
    }
  }

  void factor_base() {
    const Inertia<T>& I = links_[0].I;
    if (tree_.base == Base::floating) {
      free_.m = {{{I.A.xx},
                  {I.A.xy, I.A.yy},
                  {I.A.xz, I.A.yz, I.A.zz},
                  {I.B.x.x, I.B.x.y, I.B.x.z, I.C.xx},
                  {I.B.y.x, I.B.y.y, I.B.y.z, I.C.xy, I.C.yy},
                  {I.B.z.x, I.B.z.y, I.B.z.z, I.C.xz, I.C.yz, I.C.zz}}};
      free_.factor();
    } else if (tree_.base == Base::planar) {
      planar_.m = {{{I.A.yy}, {I.B.x.y, I.C.xx}, {I.B.z.y, I.C.xz, I.C.zz}}};
      planar_.factor();
    }
  }

  [[nodiscard]] SpatialMotion<T> base_acceleration() const {
    const Force<T>& p = links_[0].p;
    if (tree_.base == Base::floating) {
      std::array<T, 6> a{-p.n.x, -p.n.y, -p.n.z, -p.f.x, -p.f.y, -p.f.z};
      free_.solve(a);
      return {{a[0], a[1], a[2]}, {a[3], a[4], a[5]}};
    }
    if (tree_.base == Base::planar) {
      std::array<T, 3> a{-p.n.y, -p.f.x, -p.f.z};
      planar_.solve(a);
      return {{T(0.0), a[0], T(0.0)}, {a[1], T(0.0), a[2]}};
    }
    return {};
  }

  const Tree<T>& tree_;
  Vec<T> gravity_;
  Vec<T> origin_;
  std::vector<Link> links_;
  Cholesky<T, 6> free_;    // factor of the articulated inertia of the base: angular, then linear
  Cholesky<T, 3> planar_;  // factor for a planar base: rotation about y, x, z
  OtherDynamics* other_;
  std::vector<T> fall_;  // acceleration of other_
};

}  // namespace gaitlab::articulated
