/* Rigid bodies from motions and colliders. */
#include <math.h>

#include "build/geometry/hulls.h"
#include "import/physics/physics.h"
#include "import/scene/trs.h"
#include "mechanics/extent.h"
#include "mechanics/vector.h"
#include "motion/quatd.h"
#include "sbfmt/mechanics.h"

static const float DENSITY = 1000; /* kg/m^3, of bodies without a mass */
/* Mass of a body that states an infinite one, kg; an infinite moment of inertia relative to the largest
 * finite one, or, without one, in m^2 per kg. */
static const float INFINITE_MASS = 1e6f, INFINITE_MOMENT = 1e3f;

/* Thickness of a slab for a flat mesh: at most, m, and relative to its size. */
static const double SLAB_THICKNESS = 1, SLAB_FRACTION = 0.05;

/* ---- Shapes ---- */

/* Adds the volume integrals of the convex hull of points; `*is_flat` is true if they have none. */
static bool add_hull_moments(
    sbfi_conversion *c, const sbf_vec3 *points, uint32_t count, sbfi_moments *to, bool *is_flat) {
  sbf_polygon_mesh hull;
  sbf_solid solid;
  sbfi_hull_outcome outcome = sbfi_hull_make(points, count, c->asset, &hull, &c->scratch);
  if (outcome == SBFI_HULL_NO_MEMORY) return sbfi_convert_no_memory(c) == SBF_OK;
  *is_flat = outcome == SBFI_HULL_FLAT;
  if (*is_flat) return true;
  sbf_solid_measure(&hull, &solid);
  const double moments[3] = {(double)solid.inertia.x, (double)solid.inertia.y, (double)solid.inertia.z};
  const double q[4] = {(double)solid.inertia_rotation.x, (double)solid.inertia_rotation.y,
      (double)solid.inertia_rotation.z, (double)solid.inertia_rotation.w};
  sbfi_moments local = {.volume = solid.volume};
  sbfi_matrix to_center = sbfi_matrix_identity();
  to_center.at[0][3] = (double)solid.center.x, to_center.at[1][3] = (double)solid.center.y,
  to_center.at[2][3] = (double)solid.center.z;
  for (int k = 0; k < 3; k++) {
    double axis[3] = {k == 0, k == 1, k == 2};
    sbfi_quatd_rotate(q, axis, axis);
    double own = 0.5 * (moments[0] + moments[1] + moments[2]) - moments[k];
    for (int r = 0; r < 3; r++)
      for (int s = 0; s < 3; s++) local.second[r][s] += own * axis[r] * axis[s];
  }
  sbfi_moments_add(to, &local, &to_center);
  return true;
}

/* Makes a slab of flat points: adds copies below them. */
static bool thicken(sbfi_conversion *c, size_t first, sbfi_array *points) {
  const sbf_vec3 *at = (const sbf_vec3 *)points->at + first;
  size_t count = points->count - first;
  sbfi_d3 normal = {0, 0, 0};
  for (size_t i = 2; i < count; i++) {
    sbfi_d3 a = sbfi_d3_sub(sbfi_d3_of(at[i - 1]), sbfi_d3_of(at[0]));
    sbfi_d3 area = sbfi_d3_cross(a, sbfi_d3_sub(sbfi_d3_of(at[i]), sbfi_d3_of(at[0])));
    if (sbfi_d3_length(area) > sbfi_d3_length(normal)) normal = area;
  }
  double size = sbfi_extent((sbf_vec3_list){at, (uint32_t)count});
  double down = (normal.y < 0 ? 1 : -1) * fmin(SLAB_THICKNESS, SLAB_FRACTION * size);
  sbf_vec3 step = sbfi_d3_rounded(sbfi_d3_scale(sbfi_d3_normal(normal), down));
  if (!sbfi_array_push(points, count)) return sbfi_convert_no_memory(c) == SBF_OK;
  sbf_vec3 *all = (sbf_vec3 *)points->at + first;
  for (size_t i = 0; i < count; i++)
    all[count + i] = (sbf_vec3){all[i].x + step.x, all[i].y + step.y, all[i].z + step.z};
  return true;
}

static bool add_mesh(sbfi_conversion *c, uint32_t node, const sbfi_matrix *world, sbfi_physics_shape *shape) {
  sbfi_array *points = &shape->points;
  size_t first = points->count;
  bool found, is_flat = false;
  if (!sbfi_physics_mesh_points(c->physics, node, points, &found)) return false;
  sbf_vec3 *at = (sbf_vec3 *)points->at + first;
  size_t count = points->count - first;
  for (size_t i = 0; i < count; i++) at[i] = sbfi_transform_point(world, at[i]);
  c->physics->losses[SBFI_LOSS_GEOMETRY] += !found;
  if (count > UINT32_MAX / 2 || !count) return true;
  if (!add_hull_moments(c, at, (uint32_t)count, &shape->moments, &is_flat)) return false;
  if (!is_flat || count < 3) return true;
  c->physics->losses[SBFI_LOSS_PLANE]++;
  return thicken(c, first, points) &&
         add_hull_moments(c, (sbf_vec3 *)points->at + first, 2 * (uint32_t)count, &shape->moments, &is_flat);
}

bool sbfi_physics_add_geometry(
    sbfi_conversion *c, uint32_t node, const sbfi_json *geometry, sbfi_physics_shape *shape) {
  sbfi_physics *p = c->physics;
  const sbfi_matrix world = sbfi_physics_world(c, node);
  int32_t index, mesh_node;
  bool convex;
  if (!geometry || geometry->type != SBFI_JSON_OBJECT)
    return sbfi_physics_fault(p, "the collider of node %u has no geometry", node);
  if (!sbfi_physics_index(p, geometry, "shape", p->shapes ? p->shapes->count : 0, &index) ||
      !sbfi_physics_index(p, geometry, "node", p->node_count, &mesh_node) ||
      !sbfi_physics_flag(p, geometry, "convexHull", &convex))
    return false;
  if ((index == SBF_NONE) == (mesh_node == SBF_NONE))
    return sbfi_physics_fault(
        p, "the geometry of node %u must name either a shape or a node with a mesh", node);
  if (sbfi_matrix_determinant(&world) == 0) return true; /* a scale of 0 disables it */
  if (index != SBF_NONE) return sbfi_physics_add_implicit(p, (uint32_t)index, &world, shape);
  p->losses[SBFI_LOSS_CONCAVE] += !convex;
  return add_mesh(c, (uint32_t)mesh_node, &world, shape);
}

/* ---- Materials ---- */

static bool read_material(sbfi_conversion *c, int32_t index, sbf_rigid_body *body) {
  sbfi_physics *p = c->physics;
  float still, restitution;
  if (index == SBF_NONE) return true;
  const sbfi_json *material = sbfi_json_at(p->materials, (uint32_t)index);
  const sbfi_json *friction = sbfi_json_get(material, "frictionCombine"),
                  *bounce = sbfi_json_get(material, "restitutionCombine");
  if (!sbfi_physics_number_from(p, material, "dynamicFriction", 0.6f, 0, false, &body->friction) ||
      !sbfi_physics_number_from(p, material, "staticFriction", 0.6f, 0, false, &still) ||
      !sbfi_physics_number_from(p, material, "restitution", 0, 0, false, &restitution))
    return false;
  body->restitution = restitution < 1 ? restitution : 1;
  p->losses[SBFI_LOSS_STATIC_FRICTION] += still != body->friction;
  p->losses[SBFI_LOSS_COMBINE] += friction || bounce;
  return true;
}

/* ---- Motions ---- */

static sbf_quat rotation_of(const sbfi_matrix *world, const float own[4]) {
  const sbfi_trs trs = sbfi_trs_decompose(world);
  double q[4] = {(double)own[0], (double)own[1], (double)own[2], (double)own[3]}, length = 0;
  for (int k = 0; k < 4; k++) length += q[k] * q[k];
  if (!(length > 0)) q[3] = length = 1;
  for (int k = 0; k < 4; k++) q[k] /= sqrt(length);
  sbfi_quatd_multiply(trs.rotation, q, q);
  return (sbf_quat){(float)q[0], (float)q[1], (float)q[2], (float)q[3]};
}

static void make_infinite(sbfi_physics *p, sbf_rigid_body *body) {
  float *moments = &body->inertia.x, max = fmaxf(moments[0], fmaxf(moments[1], moments[2]));
  bool any = false;
  for (int k = 0; k < 3; k++) {
    any |= !(moments[k] > 0);
    if (!(moments[k] > 0)) moments[k] = INFINITE_MOMENT * (max > 0 ? max : body->mass);
  }
  p->losses[SBFI_LOSS_INFINITE_INERTIA] += any;
}

/* A vector of node space, without the node's scale. */
static sbf_vec3 rotated(const sbfi_matrix *world, const float vector[3]) {
  const sbfi_trs trs = sbfi_trs_decompose(world);
  double v[3] = {(double)vector[0], (double)vector[1], (double)vector[2]};
  sbfi_quatd_rotate(trs.rotation, v, v);
  return (sbf_vec3){(float)v[0], (float)v[1], (float)v[2]};
}

static bool has_velocity(const float v[3]) {
  return v[0] != 0 || v[1] != 0 || v[2] != 0;
}

static bool read_motion(
    sbfi_conversion *c, uint32_t node, const sbfi_moments *moments, sbf_rigid_body *body) {
  sbfi_physics *p = c->physics;
  const sbfi_json *motion = sbfi_json_get(p->nodes[node].physics, "motion");
  const sbfi_matrix world = sbfi_physics_world(c, node);
  float com[3], inertia[3], orientation[4] = {0, 0, 0, 1}, linear[3] = {0}, angular[3] = {0};
  bool kinematic;
  if (!sbfi_physics_flag(p, motion, "isKinematic", &kinematic) ||
      !sbfi_physics_number_from(
          p, motion, "mass", -1, sbfi_json_get(motion, "mass") ? 0 : -1, false, &body->mass) ||
      !sbfi_physics_numbers(p, motion, "centerOfMass", 3, com) ||
      !sbfi_physics_numbers(p, motion, "inertiaDiagonal", 3, inertia) ||
      !sbfi_physics_numbers(p, motion, "inertiaOrientation", 4, orientation) ||
      !sbfi_physics_numbers(p, motion, "linearVelocity", 3, linear) ||
      !sbfi_physics_numbers(p, motion, "angularVelocity", 3, angular) ||
      !sbfi_physics_number(p, motion, "gravityFactor", 1, &body->gravity_scale))
    return false;
  body->motion = kinematic ? SBF_BODY_MOTION_KINEMATIC : SBF_BODY_MOTION_DYNAMIC;
  p->losses[SBFI_LOSS_VELOCITY] += kinematic && (has_velocity(linear) || has_velocity(angular));
  if (!kinematic) body->velocity = rotated(&world, linear);
  if (!kinematic) body->angular_velocity = rotated(&world, angular);
  bool solid = moments->volume > 0, stated_inertia = sbfi_json_get(motion, "inertiaDiagonal") != NULL;
  if (body->mass == 0) p->losses[SBFI_LOSS_INFINITE_MASS]++, body->mass = INFINITE_MASS;
  if (body->mass < 0 && solid) body->mass = (float)(DENSITY * moments->volume);
  if (body->mass < 0) p->losses[SBFI_LOSS_NO_MASS]++, body->mass = 1;
  body->center = sbfi_transform_point(&world, (sbf_vec3){0, 0, 0});
  if (solid) {
    sbfi_moments_conclude(moments, &body->center, &body->inertia, &body->inertia_rotation);
    float *own = &body->inertia.x;
    for (int k = 0; k < 3; k++) own[k] *= (float)((double)body->mass / moments->volume);
  }
  if (sbfi_json_get(motion, "centerOfMass"))
    body->center = sbfi_transform_point(&world, (sbf_vec3){com[0], com[1], com[2]});
  if (!stated_inertia) return true;
  for (int k = 0; k < 3; k++)
    if (inertia[k] < 0)
      return sbfi_physics_fault(
          p, "a moment of inertia of node %u is %g and must not be negative", node, (double)inertia[k]);
  body->inertia = (sbf_vec3){inertia[0], inertia[1], inertia[2]};
  body->inertia_rotation = rotation_of(&world, orientation);
  make_infinite(p, body);
  return true;
}

/* ---- Bodies ---- */

typedef struct body_maker {
  sbfi_conversion *c;
  const sbfi_physics_filter *filters;
  sbfi_physics_shape shape;
  uint32_t colliders; /* of the body */
  int32_t material, filter;
} body_maker;

static bool add_collider(body_maker *m, uint32_t node) {
  sbfi_physics *p = m->c->physics;
  const sbfi_json *collider = sbfi_json_get(p->nodes[node].physics, "collider");
  int32_t material, filter;
  if (!collider || p->nodes[node].scene_node == SBF_NONE) return true;
  if (!sbfi_physics_index(
          p, collider, "physicsMaterial", p->materials ? p->materials->count : 0, &material) ||
      !sbfi_physics_index(p, collider, "collisionFilter", p->filters ? p->filters->count : 0, &filter))
    return false;
  if (!m->colliders++) m->material = material, m->filter = filter;
  p->losses[SBFI_LOSS_MATERIALS] += material != m->material || filter != m->filter;
  return sbfi_physics_add_geometry(m->c, node, sbfi_json_get(collider, "geometry"), &m->shape);
}

static bool make_hull(body_maker *m, sbf_rigid_body *body) {
  sbfi_conversion *c = m->c;
  sbf_polygon_mesh *hull = sbfi_convert_allocate(c, 1, sizeof *hull);
  if (!hull) return sbfi_convert_no_memory(c) == SBF_OK;
  c->physics->losses[SBFI_LOSS_COMPOUND] += m->colliders > 1;
  sbfi_hull_outcome outcome =
      m->shape.points.count > UINT32_MAX
          ? SBFI_HULL_NO_MEMORY
          : sbfi_hull_make(m->shape.points.at, (uint32_t)m->shape.points.count, c->asset, hull, &c->scratch);
  if (outcome == SBFI_HULL_NO_MEMORY) return sbfi_convert_no_memory(c) == SBF_OK;
  hull->target = SBF_MESH_TARGET_COLLISION_DETECTION;
  if (outcome == SBFI_HULL_MADE) body->hull = hull;
  c->physics->losses[SBFI_LOSS_GEOMETRY] += outcome == SBFI_HULL_FLAT;
  return true;
}

/* Makes the body of a node with a motion, or of a static collider. */
static bool make_body(body_maker *m, uint32_t node, sbf_rigid_body *body) {
  sbfi_conversion *c = m->c;
  const sbfi_physics *p = c->physics;
  const int32_t scene_node = p->nodes[node].scene_node;
  bool moves = p->nodes[node].moving_node == (int32_t)node;
  m->shape.points.count = m->colliders = 0;
  m->shape.moments = (sbfi_moments){0};
  for (uint32_t i = 0; i < p->node_count; i++)
    if ((i == node || (moves && p->nodes[i].moving_node == (int32_t)node)) && !add_collider(m, i))
      return false;
  sbf_rigid_body_init(body);
  body->name = sbf_asset_copy_text(c->asset, c->scene->nodes[scene_node].name);
  body->id = sbfi_new_id(c, "rigid", body->name);
  if (!body->id || !body->name) return sbfi_convert_no_memory(c) == SBF_OK;
  body->bone = moves ? c->bone_of_node[scene_node] : SBF_NONE;
  body->layer = m->colliders ? 1 : 0;
  body->mask = m->colliders ? UINT32_MAX : 0;
  if (m->colliders && m->filter != SBF_NONE)
    body->layer = m->filters[m->filter].layer, body->mask = m->filters[m->filter].mask;
  if (m->colliders && (!make_hull(m, body) || !read_material(c, m->material, body))) return false;
  if (moves) return read_motion(c, node, &m->shape.moments, body);
  if (body->hull)
    sbfi_moments_conclude(&m->shape.moments, &body->center, &body->inertia, &body->inertia_rotation);
  body->inertia = (sbf_vec3){0, 0, 0};
  return true;
}

/* Static colliders without a hull are left out; their geometry was reported. */
bool sbfi_physics_convert_bodies(sbfi_conversion *c) {
  sbfi_physics *p = c->physics;
  body_maker m = {.c = c};
  sbf_rigid_body *bodies = sbfi_convert_allocate(c, (size_t)p->node_count + 1, sizeof *bodies);
  uint32_t count = 0;
  bool good = bodies || sbfi_convert_no_memory(c) == SBF_OK;
  sbfi_array_init(&m.shape.points, c->options->allocator, sizeof(sbf_vec3));
  good = good && sbfi_physics_find_layers(c, &m.filters);
  for (int pass = 0; pass < 2; pass++)
    for (uint32_t i = 0; good && i < p->node_count; i++) {
      sbfi_physics_node *node = &p->nodes[i];
      bool moves = node->moving_node == (int32_t)i;
      if (node->scene_node == SBF_NONE) continue;
      if (pass == 0) p->losses[SBFI_LOSS_TRIGGER] += sbfi_json_get(node->physics, "trigger") != NULL;
      if (pass == 0 ? !moves : node->moving_node != SBF_NONE || !sbfi_json_get(node->physics, "collider"))
        continue;
      good = make_body(&m, i, &bodies[count]);
      if (!good || (!moves && !bodies[count].hull)) continue;
      p->losses[SBFI_LOSS_STATIC] += !moves;
      node->body = (int32_t)count++;
    }
  sbfi_array_free(&m.shape.points);
  c->asset->rigid_bodies = (sbf_rigid_body_list){count ? bodies : NULL, count};
  return good;
}
