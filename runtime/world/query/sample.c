/* Public reads, interpolated between the last two ticks. */
#include <string.h>

#include "math/quat.h"
#include "model/kernels.h"
#include "skin/skin.h"
#include "state/pose/frames.h"
#include "world/detail/detail_levels.h"

static float tick_fraction(const sbr_world *world) {
  if (world->time.ahead_units <= 0) return 1;
  return (float)(1.0 - (double)world->time.ahead_units / (double)world->time.tick_units);
}

/* Interpolates the last two ticks' points and frames into scratch, once per sampled time. The scratch of
 * deltas is that of the tick, which computes them anew. */
static void sample(const sbr_world *world, sbri_character *c) {
  if (c->sampled_at == world->time.stamp) return;
  c->sampled_at = world->time.stamp;
  const sbr_model *model = c->model;
  float t = tick_fraction(world);
  const sbri_point *from = sbri_previous_positions(c), *to = sbri_positions(c);
  if (t >= 1) {
    memcpy(sbri_sampled(c), to, model->slot_count * sizeof *to);
    sbri_deltas_make(c, sbri_pose(c), 1, sbri_sampled_deltas(c));
    return;
  }
  const float *a = &from->x, *b = &to->x;
  float *mixed = &sbri_sampled(c)->x;
  for (size_t i = 0; i < 4 * (size_t)model->slot_count; i++) mixed[i] = a[i] + (b[i] - a[i]) * t;
  sbri_deltas_interpolate(c, t, sbri_sampled_deltas(c));
}

sbr_double3 sbr_character_get_origin(const sbr_world *world, sbr_character_id character) {
  const sbri_character *c = sbri_character_of(world, character);
  return c ? sbri_header(c)->origin : (sbr_double3){0, 0, 0};
}

void sbr_character_get_bones(
    const sbr_world *world, sbr_character_id character, sbr_transform *bones, uint32_t capacity) {
  const sbri_character *c = sbri_character_of(world, character);
  if (!c || !bones) {
    if (bones) memset(bones, 0, capacity * sizeof *bones);
    return;
  }
  float t = tick_fraction(world);
  for (uint32_t f = 0; f < c->model->rig.bones.count && f < capacity; f++) {
    const sbr_transform *p = &sbri_previous_pose(c)[f], *q = &sbri_pose(c)[f];
    bones[f].position = t >= 1 ? q->position : sbri_lerp(p->position, q->position, t);
    bones[f].rotation = t >= 1 ? q->rotation : sbri_quat_blend(p->rotation, q->rotation, t);
  }
}

uint32_t sbr_character_get_bone_scales(
    const sbr_world *world, sbr_character_id character, sbf_vec3 *scales, uint32_t capacity) {
  const sbri_character *c = sbri_character_of(world, character);
  uint32_t count = c ? c->model->rig.bones.count : 0;
  for (uint32_t b = 0; scales && b < count && b < capacity; b++) scales[b] = (sbf_vec3){1, 1, 1};
  for (uint32_t i = 0; c && scales && i < c->model->asset->followers.count; i++) {
    const sbf_follower *source = &c->model->asset->followers.at[i];
    float along = sbri_gait_stretch(&c->model->rig, sbri_gait(c), i, tick_fraction(world));
    if (along == 1 || (uint32_t)source->bone >= capacity) continue;
    sbf_vec3 axis = sbri_squash_axis(source);
    float across = 1 / sqrtf(along), more = along - across;
    scales[source->bone] = (sbf_vec3){across + more * axis.x, across + more * axis.y, across + more * axis.z};
  }
  return count;
}

static void write_points(const sbri_character *c, const sbri_point *from, uint32_t count, sbf_vec3 *to) {
  float s = c->scale;
  for (uint32_t i = 0; i < count; i++) to[i] = (sbf_vec3){from[i].x * s, from[i].y * s, from[i].z * s};
}

static uint32_t min(uint32_t a, uint32_t b) {
  return a < b ? a : b;
}

/* Tangents perpendicular to the normals, from the sums over faces. */
static void write_tangents(const sbri_character *c, const sbri_skin *skin, const sbri_point *vertices,
    const sbf_vec3 *normals, sbf_vec4 *tangents, uint32_t count) {
  c->model->kernels->tangents(skin, vertices, sbri_faces(c));
  c->model->kernels->sums(&skin->tangents.sums, sbri_faces(c), sbri_sums(c));
  for (uint32_t v = 0; v < count; v++) {
    const sbri_point *sum = &sbri_sums(c)[v];
    sbf_vec3 n = normals[v], t = {sum->x, sum->y, sum->z};
    t = sbri_sub(t, sbri_scale(n, sbri_dot(n, t)));
    sbf_vec3 across = fabsf(n.x) < 0.9f ? sbri_vec3(1, 0, 0) : sbri_vec3(0, 1, 0);
    t = sbri_normalize(t, sbri_normalize(sbri_cross(n, across), sbri_vec3(1, 0, 0)));
    tangents[v] = (sbf_vec4){t.x, t.y, t.z, skin->tangents.handedness[v]};
  }
}

uint32_t sbr_model_get_level_vertices(const sbr_model *model, uint32_t render_mesh, uint32_t render_level,
    uint32_t *vertices, uint32_t capacity) {
  const sbri_skin *skin = sbri_skin_of(model, render_mesh, render_level);
  if (!skin) return 0;
  for (uint32_t v = 0; vertices && v < skin->vertex_count && v < capacity; v++)
    vertices[v] = skin->vertices ? skin->vertices[v] : v;
  return skin->vertex_count;
}

uint32_t sbr_character_get_skin(const sbr_world *world, sbr_character_id character, uint32_t render_mesh,
    sbf_vec3 *positions, sbf_vec3 *normals, sbf_vec4 *tangents, uint32_t capacity) {
  return sbr_character_get_level_skin(
      world, character, render_mesh, 0, positions, normals, tangents, capacity);
}

uint32_t sbr_character_get_level_skin(const sbr_world *world, sbr_character_id character,
    uint32_t render_mesh, uint32_t render_level, sbf_vec3 *positions, sbf_vec3 *normals, sbf_vec4 *tangents,
    uint32_t capacity) {
  sbri_character *c = sbri_character_of(world, character);
  const sbri_skin *made = c ? sbri_skin_of(c->model, render_mesh, render_level) : NULL;
  if (!made) return 0;
  const sbri_skin now = sbri_skin_now(c, made), *skin = &now;
  uint32_t count = min(capacity, skin->vertex_count);
  sample(world, c);
  sbri_point *vertices = sbri_vertices(c);
  sbri_skin_compute_vertices(c->model, skin, sbri_sampled(c), sbri_sampled_deltas(c), vertices);
  sbri_fade_apply(c, render_mesh, render_level, skin, tick_fraction(world), vertices);
  if (positions) write_points(c, vertices, count, positions);
  if (!normals && !tangents) return skin->vertex_count;
  c->model->kernels->faces(skin, vertices, sbri_faces(c));
  c->model->kernels->normals(&skin->normals.smooth, sbri_faces(c), sbri_sums(c));
  for (uint32_t v = 0; normals && v < count; v++) {
    const sbri_point *n = &sbri_sums(c)[skin->normals.smooth_of[v]];
    normals[v] = (sbf_vec3){n->x, n->y, n->z};
  }
  if (!tangents) return skin->vertex_count;
  if (normals && skin->tangents.blocks)
    write_tangents(c, skin, vertices, normals, tangents, count);
  else
    memset(tangents, 0, count * sizeof *tangents);
  return skin->vertex_count;
}

uint32_t sbr_character_get_corner_normals(const sbr_world *world, sbr_character_id character,
    uint32_t render_mesh, sbf_vec3 *normals, uint32_t capacity) {
  return sbr_character_get_level_corner_normals(world, character, render_mesh, 0, normals, capacity);
}

uint32_t sbr_character_get_level_corner_normals(const sbr_world *world, sbr_character_id character,
    uint32_t render_mesh, uint32_t render_level, sbf_vec3 *normals, uint32_t capacity) {
  sbri_character *c = sbri_character_of(world, character);
  const sbri_skin *made = c ? sbri_skin_of(c->model, render_mesh, render_level) : NULL;
  if (!made) return 0;
  const sbri_skin now = sbri_skin_now(c, made), *skin = &now;
  if (!normals || skin->vertex_count == 0) return skin->normals.corner_count;
  sample(world, c);
  sbri_skin_compute_vertices(c->model, skin, sbri_sampled(c), sbri_sampled_deltas(c), sbri_vertices(c));
  sbri_fade_apply(c, render_mesh, render_level, skin, tick_fraction(world), sbri_vertices(c));
  c->model->kernels->faces(skin, sbri_vertices(c), sbri_faces(c));
  c->model->kernels->normals(&skin->normals.split, sbri_faces(c), sbri_sums(c));
  for (uint32_t k = 0; k < skin->normals.corner_count && k < capacity; k++) {
    const sbri_point *n = &sbri_sums(c)[skin->normals.split_of[k]];
    normals[k] = (sbf_vec3){n->x, n->y, n->z};
  }
  return skin->normals.corner_count;
}

uint32_t sbr_character_get_surface(const sbr_world *world, sbr_character_id character, uint32_t soft_body,
    sbf_vec3 *positions, uint32_t capacity) {
  sbri_character *c = sbri_character_of(world, character);
  if (!c || soft_body >= c->model->asset->soft_bodies.count) return 0;
  const sbri_body *body = &c->model->bodies[soft_body];
  sample(world, c);
  sbri_point *vertices = sbri_surface_vertices(c) + body->surface.first_vertex;
  const sbri_skin surface = sbri_skin_now(c, &body->surface.skin);
  sbri_skin_compute_vertices(c->model, &surface, sbri_sampled(c), sbri_sampled_deltas(c), vertices);
  if (positions) write_points(c, vertices, min(capacity, body->surface.skin.vertex_count), positions);
  return body->surface.skin.vertex_count;
}

uint32_t sbr_character_get_points(const sbr_world *world, sbr_character_id character, uint32_t soft_body,
    sbf_vec3 *positions, uint32_t capacity) {
  sbri_character *c = sbri_character_of(world, character);
  if (!c || soft_body >= c->model->asset->soft_bodies.count) return 0;
  const sbri_body *body = &c->model->bodies[soft_body];
  if (!body->level) return 0;
  sample(world, c);
  const sbri_point *points = sbri_sampled(c) + c->model->islands[body->island].first_slot;
  uint32_t count = body->level->positions.count;
  for (uint32_t i = 0; positions && i < count && i < capacity; i++) {
    const sbri_point *p = &points[body->slots.from_point[i]];
    positions[i] = (sbf_vec3){p->x * c->scale, p->y * c->scale, p->z * c->scale};
  }
  return count;
}

uint32_t sbr_character_get_legs(
    const sbr_world *world, sbr_character_id character, sbr_leg_state *legs, uint32_t capacity) {
  const sbri_character *c = sbri_character_of(world, character);
  if (!c) return 0;
  return sbri_gait_legs(&c->model->rig, sbri_gait(c), tick_fraction(world), legs, legs ? capacity : 0);
}

double sbr_character_get_distance(const sbr_world *world, sbr_character_id character) {
  const sbri_character *c = sbri_character_of(world, character);
  return c ? sbri_gait_distance(sbri_gait(c)) : 0;
}
