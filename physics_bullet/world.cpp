#include "physics_bullet/world.h"

#include <algorithm>

namespace gaitlab::bullet {

namespace {

// Collision groups of Bullet.
enum Group : int { kPlane = 1, kElements = 2, kOutlines = 4, kFixed = 8, kMoving = 16 };

bool robots(const btCollisionObject& object) { return object.getUserIndex() >= 0; }

double friction_between(const btCollisionObject& a, const btCollisionObject& b) {
  if (robots(a)) return b.getFriction();
  if (robots(b)) return a.getFriction();
  return std::min(a.getFriction(), b.getFriction());
}

// Limits of the sequential impulse solver: number of iterations, and change of velocity below which they end. Sixteen motors in
// a chain are exact to 1e-6 after 50 iterations. Contacts of stiff feet do not converge further with 1000 iterations
// (docs/equations.md, 7).
constexpr int kIterations = 50;
constexpr double kSettled = 1e-9;  // m/s, rad/s

btTransform bt(const Pose& pose) {
  const Mat3& R = pose.R;
  return btTransform(btMatrix3x3(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)),
                     bullet::bt(pose.p));
}

}  // namespace

void OneIslandWorld::solveConstraints(btContactSolverInfo& info) {
  solveExternalForces(info);
  btCollisionObjectArray& objects = getCollisionObjectArray();
  btDispatcher& dispatcher = *getDispatcher();
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
    btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
    const double friction = friction_between(*manifold.getBody0(), *manifold.getBody1());
    for (int p = 0; p < manifold.getNumContacts(); ++p) manifold.getContactPoint(p).m_combinedFriction = friction;
  }
  m_multiBodyConstraintSolver->solveMultiBodyGroup(
      objects.size() > 0 ? &objects[0] : nullptr, objects.size(), dispatcher.getInternalManifoldPointer(),
      dispatcher.getNumManifolds(), nullptr, 0, m_multiBodyConstraints.size() > 0 ? &m_multiBodyConstraints[0] : nullptr,
      m_multiBodyConstraints.size(), info, nullptr, &dispatcher);
  for (int i = 0; i < m_multiBodies.size(); ++i) m_multiBodies[i]->processDeltaVeeMultiDof2();
}

BulletWorld::Neighbours::Neighbours(const Robot& robot) {
  for (const Link& link : robot.links) parents_.push_back(link.parent);
}

/// True for links with at most two joints between them: the same link, parents and grandparents, children and grandchildren,
/// siblings.
bool BulletWorld::Neighbours::near(int i, int j) const {
  const auto parent = [&](int link) { return link < 0 ? -1 : parents_[static_cast<std::size_t>(link)]; };
  const bool siblings = parent(i) == parent(j) && parent(i) >= 0;
  return i == j || parent(i) == j || parent(j) == i || parent(parent(i)) == j || parent(parent(j)) == i || siblings;
}

bool BulletWorld::Neighbours::needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const {
  if ((a->m_collisionFilterGroup & b->m_collisionFilterMask) == 0 ||
      (b->m_collisionFilterGroup & a->m_collisionFilterMask) == 0)
    return false;
  const int i = static_cast<const btCollisionObject*>(a->m_clientObject)->getUserIndex();
  const int j = static_cast<const btCollisionObject*>(b->m_clientObject)->getUserIndex();
  return i < 0 || j < 0 || !near(i, j);
}

BulletWorld::BulletWorld(const PlantSettings& s, MultiBody& body)
    : body_(body),
      dispatcher_(&configuration_),
      neighbours_(*s.robot),
      plane_(btVector3(0, 0, 1), 0),
      world_(&dispatcher_, &broadphase_, &solver_, &configuration_) {
  world_.getPairCache()->setOverlapFilterCallback(&neighbours_);
  world_.setGravity(bullet::bt(s.gravity));
  btContactSolverInfo& info = world_.getSolverInfo();  // default of the multibody world: two friction directions and their cone
  info.m_numIterations = kIterations;
  info.m_leastSquaresResidualThreshold = kSettled * kSettled;
  body.bullet().setHasSelfCollision(true);
  world_.addMultiBody(&body.bullet());
  if (!s.contacts.empty()) add_robot(*s.robot, s.ground.friction);
  add_ground(s.ground);
  for (std::size_t j = 0; j < s.robot->joints.size(); ++j) {
    for (auto* rows : {&motors_, &stops_, &frictions_}) {
      rows->push_back(std::make_unique<JointRow>(body.bullet(), body.index_of_joint(j)));
      world_.addMultiBodyConstraint(rows->back().get());
    }
  }
}

BulletWorld::~BulletWorld() {
  // Objects are removed in the opposite order of creation, because pairs of the broadphase refer to them.
  for (auto* rows : {&motors_, &stops_, &frictions_}) {
    for (const auto& row : *rows) world_.removeMultiBodyConstraint(row.get());
  }
  for (int i = world_.getNumCollisionObjects(); i-- > 0;) world_.removeCollisionObject(world_.getCollisionObjectArray()[i]);
  world_.removeMultiBody(&body_.bullet());
}

void BulletWorld::add_robot(const Robot& robot, double friction) {
  for (std::size_t b = 0; b < robot.bodies.size(); ++b) {
    const Body& of = robot.bodies[b];
    const BodyType& type = robot.types[robot.modules[of.module].type].bodies[of.type];
    if (type.shapes.empty()) continue;
    auto outline = std::find_if(outlines_.begin(), outlines_.end(), [&](const auto& o) { return o.link == of.link; });
    if (outline == outlines_.end()) {
      outlines_.push_back({of.link, std::make_unique<btCompoundShape>(),
                           std::make_unique<btMultiBodyLinkCollider>(&body_.bullet(), body_.index_of(of.link))});
      outline = outlines_.end() - 1;
    }
    for (const Shape& shape : type.shapes) {
      shapes_.push_back(make_shape(shape));
      shapes_.back()->setUserIndex(static_cast<int>(b));
      outline->shape->addChildShape(bt(body_.frame(of.link).inverse() * of.in_link * shape.in_body), shapes_.back().get());
    }
  }
  const auto add = [&](const MultiBody::Compound& compound, Group group, int mask) {
    btMultiBodyLinkCollider& collider = *compound.collider;
    collider.setCollisionShape(compound.shape.get());
    collider.setUserIndex(static_cast<int>(compound.link));
    collider.setFriction(friction);  // friction between parts of the robot
    collider.setActivationState(DISABLE_DEACTIVATION);
    world_.addCollisionObject(&collider, group, mask);
  };
  for (const MultiBody::Compound& elements : body_.compounds()) add(elements, kElements, kPlane);
  for (const MultiBody::Compound& outline : outlines_) add(outline, kOutlines, kOutlines | kFixed | kMoving);
}

btRigidBody& BulletWorld::add_body(double mass, btCollisionShape& shape, const Pose& pose, double friction, int group,
                                   int mask) {
  btVector3 inertia(0, 0, 0);
  if (mass > 0) shape.calculateLocalInertia(mass, inertia);
  ground_.push_back(std::make_unique<btRigidBody>(btRigidBody::btRigidBodyConstructionInfo(mass, nullptr, &shape, inertia)));
  btRigidBody& body = *ground_.back();
  body.setWorldTransform(bt(pose));
  body.setInterpolationWorldTransform(bt(pose));
  body.setFriction(friction);
  body.setActivationState(DISABLE_DEACTIVATION);
  world_.addRigidBody(&body, group, mask);
  return body;
}

void BulletWorld::add_ground(const Ground& ground) {
  if (!ground.exists()) return;
  add_body(0, plane_, {}, ground.friction, kPlane, kElements | kMoving);
  for (std::size_t b = 0; b < ground.boxes().size(); ++b) {
    const Box& box = ground.boxes()[b];
    shapes_.push_back(make_box(box.size));
    if (box.mass > 0) {
      moving_.emplace_back(b, &add_body(box.mass, *shapes_.back(), {box.R, box.center}, box.friction, kMoving,
                                        kPlane | kFixed | kMoving | kOutlines));
    } else {
      add_body(0, *shapes_.back(), {box.R, box.center}, box.friction, kFixed, kMoving | kOutlines);
    }
  }
}

void BulletWorld::boxes(std::span<BoxMotion> out) const {
  for (const auto& [b, body] : moving_) {
    const btQuaternion turn = body->getWorldTransform().getRotation();
    out[b] = {vec(body->getWorldTransform().getOrigin()), Quat(turn.w(), turn.x(), turn.y(), turn.z()),
              vec(body->getLinearVelocity())};
  }
}

void BulletWorld::step(const Kinematics& k, double h) {
  for (const std::vector<MultiBody::Compound>* compounds : {&body_.compounds(), &std::as_const(outlines_)}) {
    for (const MultiBody::Compound& compound : *compounds) {
      compound.collider->setWorldTransform(bt(body_.frame(compound.link, k)));
      compound.collider->setInterpolationWorldTransform(compound.collider->getWorldTransform());
    }
  }
  world_.stepSimulation(h, 0);  // 0: one step of exactly h
}

WorldTouch BulletWorld::touch(const btPersistentManifold& manifold, const btManifoldPoint& p) {
  const auto side = [](const btCollisionObject& object, int child, const btVector3& point) {
    WorldTouch::Side s;
    s.point = vec(point);
    s.link = object.getUserIndex();
    if (s.link < 0) return s;
    const auto& compound = *static_cast<const btCompoundShape*>(object.getCollisionShape());
    const int index = compound.getChildShape(child)->getUserIndex();
    const bool element = (object.getBroadphaseHandle()->m_collisionFilterGroup & kElements) != 0;
    (element ? s.element : s.body) = index;
    return s;
  };
  WorldTouch t;
  t.a = side(*manifold.getBody0(), p.m_index0, p.getPositionWorldOnA());
  t.b = side(*manifold.getBody1(), p.m_index1, p.getPositionWorldOnB());
  t.normal = vec(p.m_normalWorldOnB);
  t.push = p.m_appliedImpulse;
  t.friction = vec(p.m_appliedImpulseLateral1 * p.m_lateralFrictionDir1 + p.m_appliedImpulseLateral2 * p.m_lateralFrictionDir2);
  t.distance = p.getDistance();
  return t;
}

}  // namespace gaitlab::bullet
