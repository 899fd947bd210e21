#include "peer_bullet_falls.h"

#include <cstdio>
#include <memory>

#include <BulletSoftBody/btDeformableBodySolver.h>
#include <BulletSoftBody/btDeformableGravityForce.h>
#include <BulletSoftBody/btDeformableMultiBodyConstraintSolver.h>
#include <BulletSoftBody/btDeformableMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btDeformableNeoHookeanForce.h>
#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

static const btVector3 GRAVITY(0, btScalar(-9.81), 0);

/* In the order in which they are to be made; they end the other way about. */
struct bullet_body {
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDeformableBodySolver deformable;
  btDeformableMultiBodyConstraintSolver deformable_solver;
  std::unique_ptr<btDeformableLagrangianForce> gravity, elastic;
  std::unique_ptr<btDiscreteDynamicsWorld> world;
  std::unique_ptr<btCollisionShape> ball_shape;
  std::unique_ptr<btRigidBody> ball;
  std::unique_ptr<btSoftBody> body;
  ~bullet_body() {
    if (body) world->removeCollisionObject(body.get());
    if (ball) world->removeRigidBody(ball.get());
  }
};

static std::unique_ptr<btSoftBody> make_body(btSoftBodyWorldInfo *info, const bullet_shape &shape) {
  btAlignedObjectArray<btVector3> points;
  btAlignedObjectArray<btScalar> masses;
  for (uint32_t i = 0; i < shape.point_count; i++) {
    points.push_back(btVector3(shape.points[i].x, shape.points[i].y, shape.points[i].z));
    masses.push_back(shape.masses[i]);
  }
  auto body = std::make_unique<btSoftBody>(info, int(shape.point_count), &points[0], &masses[0]);
  body->m_cfg.collisions = 0;
  body->m_cfg.kDP = 0;
  body->setActivationState(DISABLE_DEACTIVATION);
  return body;
}

bullet_body *bullet_make_links(const bullet_shape *shape, uint32_t iterations, float linear_stiffness, float step_s) {
  auto made = std::make_unique<bullet_body>();
  auto *world =
      new btSoftRigidDynamicsWorld(&made->dispatcher, &made->broadphase, &made->solver, &made->configuration);
  made->world.reset(world);
  world->setGravity(GRAVITY);
  world->getWorldInfo().m_gravity = GRAVITY;
  made->body = make_body(&world->getWorldInfo(), *shape);
  btSoftBody::Material *common = linear_stiffness > 0 ? made->body->appendMaterial() : nullptr;
  if (common) common->m_kLST = linear_stiffness;
  for (uint32_t i = 0; i < shape->link_count; i++) {
    const uint32_t *ends = shape->links[i].at;
    btSoftBody::Material *material = common;
    if (!material) { /* k h^2 w / (1 + k h^2 w) of the way, w the sum of the ends' inverse masses */
      double a = shape->masses[ends[0]], b = shape->masses[ends[1]];
      double w = (a > 0 ? 1 / a : 0) + (b > 0 ? 1 / b : 0);
      double stiff = double(shape->stiffness[i]) * step_s * step_s * w;
      material = made->body->appendMaterial();
      material->m_kLST = btScalar(stiff > 0 ? stiff / (1 + stiff) : 1e-12);
    }
    made->body->appendLink(int(ends[0]), int(ends[1]), material);
  }
  made->body->m_cfg.piterations = int(iterations);
  btSoftBodyHelpers::ReoptimizeLinkOrder(made->body.get()); /* takes half of the time it took */
  made->body->updateConstants();
  world->addSoftBody(made->body.get());
  return made.release();
}

bullet_body *bullet_make_links_over_ball(const bullet_shape *shape, uint32_t iterations, float linear_stiffness,
    float step_s, sbf_vec3 center, float radius, float friction) {
  std::unique_ptr<bullet_body> made(bullet_make_links(shape, iterations, linear_stiffness, step_s));
  auto &distances = static_cast<btSoftRigidDynamicsWorld *>(made->world.get())->getWorldInfo().m_sparsesdf;
  distances.setDefaultVoxelsz(btScalar(0.02)); /* unasked 0.25 m: far too coarse for this ball */
  distances.Reset();
  made->ball_shape = std::make_unique<btSphereShape>(radius);
  btRigidBody::btRigidBodyConstructionInfo info(0, nullptr, made->ball_shape.get());
  info.m_startWorldTransform.setIdentity();
  info.m_startWorldTransform.setOrigin(btVector3(center.x, center.y, center.z));
  info.m_friction = friction;
  made->ball = std::make_unique<btRigidBody>(info);
  made->world->addRigidBody(made->ball.get());
  made->body->m_cfg.collisions = btSoftBody::fCollision::SDF_RS;
  made->body->m_cfg.kDF = friction;
  made->body->getCollisionShape()->setMargin(btScalar(0.001));
  return made.release();
}

bullet_body *bullet_make_solid(const bullet_shape *shape) {
  auto made = std::make_unique<bullet_body>();
  made->deformable_solver.setDeformableSolver(&made->deformable);
  auto *world = new btDeformableMultiBodyDynamicsWorld(&made->dispatcher, &made->broadphase,
      &made->deformable_solver, &made->configuration, &made->deformable);
  made->world.reset(world);
  world->setGravity(GRAVITY);
  world->getWorldInfo().m_gravity = GRAVITY;
  world->setImplicit(true);
  world->setLineSearch(false);
  world->setUseProjection(true); /* else nothing moves where no point touches anything */
  made->body = make_body(&world->getWorldInfo(), *shape);
  for (uint32_t i = 0; i < shape->tetrahedron_count; i++) {
    const uint32_t *at = shape->tetrahedra[i].at;
    made->body->appendTetra(int(at[0]), int(at[1]), int(at[2]), int(at[3]));
  }
  btSoftBodyHelpers::generateBoundaryFaces(made->body.get());
  made->body->initializeDmInverse();
  made->body->m_tetraScratches.resize(made->body->m_tetras.size());
  made->body->m_tetraScratchesTn.resize(made->body->m_tetras.size());
  made->body->m_sleepingThreshold = 0;
  world->addSoftBody(made->body.get());
  double modulus = shape->young_modulus, ratio = shape->poisson_ratio;
  auto elastic = std::make_unique<btDeformableNeoHookeanForce>(btScalar(modulus / (2 * (1 + ratio))),
      btScalar(modulus * ratio / ((1 + ratio) * (1 - 2 * ratio))), btScalar(0));
  made->gravity = std::make_unique<btDeformableGravityForce>(GRAVITY);
  world->addForce(made->body.get(), made->gravity.get());
  world->addForce(made->body.get(), elastic.get());
  made->elastic = std::move(elastic);
  return made.release();
}

void bullet_step(bullet_body *body, float step_s) {
  body->world->stepSimulation(step_s, 1, step_s);
}

void bullet_read(const bullet_body *body, sbf_vec3 *points) {
  for (int i = 0; i < body->body->m_nodes.size(); i++) {
    const btVector3 &x = body->body->m_nodes[i].m_x;
    points[i] = sbf_vec3{float(x.x()), float(x.y()), float(x.z())};
  }
}

void bullet_free(bullet_body *body) {
  delete body;
}

const char *bullet_version(void) {
  static char text[16];
  std::snprintf(text, sizeof text, "%d.%02d", btGetVersion() / 100, btGetVersion() % 100);
  return text;
}
