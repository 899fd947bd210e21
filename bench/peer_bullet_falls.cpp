#include "peer_bullet_falls.h"

#include <memory>
#include <vector>

#include <btBulletDynamicsCommon.h>

static btVector3 of(sbf_vec3 v) {
  return btVector3(v.x, v.y, v.z);
}
static sbf_vec3 of(const btVector3 &v) {
  return sbf_vec3{float(v.x()), float(v.y()), float(v.z())};
}

/* In the order in which they are to be made; they end the other way about. */
struct bullet_ragdoll {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::vector<std::unique_ptr<btRigidBody>> bodies; /* the parts, then the ground */
  std::vector<std::unique_ptr<btTypedConstraint>> joints;
  ~bullet_ragdoll() {
    for (auto &joint : joints) world.removeConstraint(joint.get());
    for (auto &body : bodies) world.removeRigidBody(body.get());
  }
};

enum { PART = 1, GROUND = 2 };

static void add_body(
    bullet_ragdoll &r, btCollisionShape *shape, float mass, const btVector3 &at, float friction) {
  btVector3 inertia(0, 0, 0);
  r.shapes.emplace_back(shape);
  if (mass > 0) shape->calculateLocalInertia(mass, inertia);
  btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shape, inertia);
  info.m_startWorldTransform.setIdentity();
  info.m_startWorldTransform.setOrigin(at);
  info.m_friction = friction;
  r.bodies.push_back(std::make_unique<btRigidBody>(info));
  r.bodies.back()->setActivationState(DISABLE_DEACTIVATION);
  r.world.addRigidBody(r.bodies.back().get(), mass > 0 ? PART : GROUND, mass > 0 ? GROUND : PART);
}

bullet_ragdoll *bullet_ragdoll_make(float raise, float friction, int iterations) {
  auto made = std::make_unique<bullet_ragdoll>();
  made->world.setGravity(btVector3(0, btScalar(-9.81), 0));
  made->world.getSolverInfo().m_numIterations = iterations;
  for (const ragdoll_part &p : ragdoll_parts)
    add_body(*made, new btBoxShape(of(p.size) / 2), p.mass, of(p.middle) + btVector3(0, raise, 0), friction);
  add_body(*made, new btStaticPlaneShape(btVector3(0, 1, 0), 0), 0, btVector3(0, 0, 0), 1);
  for (int i = 0; i < RAGDOLL_PARTS; i++) {
    const ragdoll_part &p = ragdoll_parts[i];
    if (p.parent < 0) continue;
    btTransform a(btQuaternion::getIdentity(), of(p.joint) - of(ragdoll_parts[p.parent].middle));
    btTransform b(btQuaternion::getIdentity(), of(p.joint) - of(p.middle));
    auto joint = std::make_unique<btConeTwistConstraint>(
        *made->bodies[size_t(p.parent)], *made->bodies[size_t(i)], a, b);
    joint->setLimit(RAGDOLL_SWING, RAGDOLL_SWING, RAGDOLL_TWIST);
    made->world.addConstraint(joint.get(), true);
    made->joints.push_back(std::move(joint));
  }
  return made.release();
}

void bullet_ragdoll_push(bullet_ragdoll *r, int part, sbf_vec3 point, sbf_vec3 impulse) {
  btRigidBody &body = *r->bodies[size_t(part)];
  body.applyImpulse(of(impulse), of(point) - body.getCenterOfMassPosition());
}

void bullet_ragdoll_step(bullet_ragdoll *r, float step_s) {
  r->world.stepSimulation(step_s, 1, step_s);
}

void bullet_ragdoll_read(const bullet_ragdoll *r, part_state parts[RAGDOLL_PARTS]) {
  for (size_t i = 0; i < RAGDOLL_PARTS; i++) {
    const btRigidBody &body = *r->bodies[i];
    btQuaternion q = body.getOrientation();
    parts[i].center = of(body.getCenterOfMassPosition());
    parts[i].velocity = of(body.getLinearVelocity());
    parts[i].rotation = sbf_quat{float(q.x()), float(q.y()), float(q.z()), float(q.w())};
  }
}

void bullet_ragdoll_free(bullet_ragdoll *ragdoll) {
  delete ragdoll;
}
