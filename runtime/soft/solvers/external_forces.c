#include "soft/solvers/external_forces.h"

#include <string.h>

#include "math/quat.h"
#include "soft/solvers/surface_forces.h"

/* Fraction of its rest volume below which the pressure of a gas does not increase further, inverted or not.
 */
static const double MIN_GAS_FRACTION = 0.02;

/* Maximum ratio by which a gas may stiffen between two checks. */
static const double GAS_MARGIN = 1.25;

static sbf_vec3 vec_of(const sbri_point *p) {
  return sbri_vec3(p->x, p->y, p->z);
}

static void clear(sbri_point *points, uint32_t count) {
  memset(points, 0, count * sizeof *points);
}

static void add_to(sbri_point *p, sbf_vec3 f) {
  *p = (sbri_point){p->x + f.x, p->y + f.y, p->z + f.z, 0};
}

static sbf_vec3 velocity_of(const sbri_island_tick *t, uint32_t slot) {
  return sbri_slot_velocity(t, t->velocities, slot);
}

/* ---- Surfaces ---- */

static uint32_t lane_corners(const sbri_skin *skin, uint32_t face, uint32_t corners[4]) {
  const sbri_face_block *block = &skin->faces[face / SBRI_BLOCK];
  for (int k = 0; k < 4; k++) corners[k] = block->corners[k][face % SBRI_BLOCK];
  if (corners[0] == corners[1] && corners[1] == corners[2]) return 0; /* padding */
  return corners[3] == corners[0] ? 3 : 4;
}

/* Positions or velocities of the surface vertices, from the points that they are embedded in. */
static void compute_vertices(
    const sbri_island_tick *t, const sbri_skin *skin, bool velocities, sbri_point *to) {
  for (uint32_t v = 0; v < skin->vertex_count; v++) {
    uint32_t block = v / SBRI_BLOCK, lane = v % SBRI_BLOCK;
    sbf_vec3 sum = {0, 0, 0};
    for (uint32_t c = skin->cell_begins[block]; c < skin->cell_begins[block + 1]; c++) {
      const sbri_volume_cell *cell = &skin->cells[c];
      uint32_t slot = cell->slots[lane] - t->island->first_slot;
      if (cell->weights[lane] == 0) continue;
      sbf_vec3 at = velocities ? velocity_of(t, slot) : vec_of(&t->positions[slot]);
      sum = sbri_add_scaled(sum, at, cell->weights[lane]);
    }
    to[v] = (sbri_point){sum.x, sum.y, sum.z, 0};
  }
}

/* Distributes forces on vertices to the points that they are embedded in. */
static void distribute_forces(const sbri_island_tick *t, const sbri_skin *skin, const sbri_point *forces) {
  for (uint32_t v = 0; v < skin->vertex_count; v++) {
    uint32_t block = v / SBRI_BLOCK, lane = v % SBRI_BLOCK;
    for (uint32_t c = skin->cell_begins[block]; c < skin->cell_begins[block + 1]; c++) {
      const sbri_volume_cell *cell = &skin->cells[c];
      uint32_t slot = cell->slots[lane] - t->island->first_slot;
      add_to(&t->scratch.external_forces[slot], sbri_scale(vec_of(&forces[v]), cell->weights[lane]));
    }
  }
}

static sbri_face_shape shape_of(const sbri_point *vertices, const uint32_t corners[4]) {
  sbf_vec3 x[4];
  for (int k = 0; k < 4; k++) x[k] = vec_of(&vertices[corners[k]]);
  return sbri_face_shape_of(x);
}

static double volume_of(const sbri_skin *skin, const sbri_point *vertices) {
  double six_fold = 0;
  uint32_t corners[4];
  sbf_vec3 from = vec_of(&vertices[0]);
  for (uint32_t face = 0; face < skin->face_block_count * SBRI_BLOCK; face++) {
    if (!lane_corners(skin, face, corners)) continue;
    sbri_face_shape shape = shape_of(vertices, corners);
    six_fold += sbri_face_volume(&shape, from);
  }
  return six_fold / 6;
}

double sbri_surface_rest_volume(const sbri_body *body) {
  const sbf_vec3 *at = body->source->surface.positions.at;
  const sbri_skin *skin = &body->surface.skin;
  double six_fold = 0;
  uint32_t corners[4];
  for (uint32_t face = 0; face < skin->face_block_count * SBRI_BLOCK; face++) {
    if (!lane_corners(skin, face, corners)) continue;
    sbf_vec3 x[4] = {at[corners[0]], at[corners[1]], at[corners[2]], at[corners[3]]};
    sbri_face_shape shape = sbri_face_shape_of(x);
    six_fold += sbri_face_volume(&shape, at[0]);
  }
  return six_fold / 6;
}

/* -density/2 |v_n| v_n A on each face. */
static void add_medium(const sbri_island_tick *t, const sbri_body *body, const sbri_point *vertices,
    const sbri_point *velocities, sbri_point *forces) {
  uint32_t corners[4], count;
  for (uint32_t face = 0; face < body->surface.skin.face_block_count * SBRI_BLOCK; face++) {
    if (!(count = lane_corners(&body->surface.skin, face, corners))) continue;
    sbf_vec3 area = shape_of(vertices, corners).area, v = {0, 0, 0};
    float size = sbri_length(area);
    if (!(size > 0)) continue;
    for (uint32_t k = 0; k < count; k++)
      v = sbri_add_scaled(v, vec_of(&velocities[corners[k]]), 1 / (float)count);
    float speed = sbri_dot(sbri_sub(v, t->environment.wind), area) / size;
    float force = -0.5f * body->medium_kg_m3 * fabsf(speed) * speed / (float)count;
    for (uint32_t k = 0; k < count; k++) add_to(&forces[corners[k]], sbri_scale(area, force));
  }
}

static double gas_volume_now(const sbri_body *body, const sbri_point *vertices) {
  double volume = volume_of(&body->surface.skin, vertices), min = MIN_GAS_FRACTION * body->gas.volume_m3;
  return volume > min ? volume : min;
}

/* `pressure` times the gradient of the volume, and times each face's mean of the factors (NULL: 1). */
static void add_pressure(const sbri_body *body, const sbri_point *vertices, float pressure,
    const float *factors, sbri_point *forces) {
  uint32_t corners[4];
  for (uint32_t face = 0; face < body->surface.skin.face_block_count * SBRI_BLOCK; face++) {
    uint32_t count = lane_corners(&body->surface.skin, face, corners);
    if (!count) continue;
    float factor = factors ? 0 : 1;
    for (uint32_t k = 0; factors && k < count; k++) factor += factors[corners[k]] / (float)count;
    sbri_face_shape shape = shape_of(vertices, corners);
    for (int k = 0; k < 4; k++)
      add_to(&forces[corners[k]], sbri_scale(shape.gradients[k], pressure * factor));
  }
}

static void add_gas(const sbri_body *body, const sbri_point *vertices, sbri_point *forces) {
  double pressure = (double)body->gas.pressure_pa * body->gas.volume_m3 / gas_volume_now(body, vertices);
  add_pressure(body, vertices, (float)pressure, body->gas.factors, forces);
}

/* Limits the medium: in one substep it removes at most a point's whole velocity relative to it. */
static void bound_medium(const sbri_island_tick *t, const sbri_body *body, float h) {
  for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++) {
    float change =
        sbri_length(vec_of(&t->scratch.external_forces[slot])) * h * t->island->inverse_masses[slot];
    float speed = sbri_length(sbri_sub(velocity_of(t, slot), t->environment.wind));
    if (change > speed)
      t->scratch.external_forces[slot] = (sbri_point){t->scratch.external_forces[slot].x * (speed / change),
          t->scratch.external_forces[slot].y * (speed / change),
          t->scratch.external_forces[slot].z * (speed / change), 0};
  }
}

static void add_surface(const sbri_island_tick *t, const sbri_body *body, float h) {
  sbri_point *vertices = t->surfaces.vertices + body->surface.first_vertex;
  sbri_point *forces = t->surfaces.forces + body->surface.first_vertex;
  sbri_point *velocities = t->surfaces.velocities + body->surface.first_vertex;
  compute_vertices(t, &body->surface.skin, false, vertices);
  clear(forces, body->surface.skin.vertex_count);
  if (body->medium_kg_m3 > 0) {
    compute_vertices(t, &body->surface.skin, true, velocities);
    add_medium(t, body, vertices, velocities, forces);
    distribute_forces(t, &body->surface.skin, forces);
    bound_medium(t, body, h);
    clear(forces, body->surface.skin.vertex_count);
  }
  if (body->gas.pressure_pa == 0) return;
  add_gas(body, vertices, forces);
  distribute_forces(t, &body->surface.skin, forces);
}

static void add_bending(const sbri_island_tick *t, const sbri_body *body) {
  for (uint32_t i = 0; i < body->elements.hinge_count; i++) {
    const sbri_hinge *hinge = &body->elements.hinges[i];
    sbf_vec3 x[4], gradients[4];
    for (int k = 0; k < 4; k++) x[k] = vec_of(&t->positions[hinge->slots[k]]);
    sbri_hinge_shape shape = sbri_hinge_shape_of(x);
    sbri_compute_hinge_gradients(&shape, x, gradients);
    float torque = hinge->stiffness * sbri_angle_between(shape.angle, hinge->rest_angle);
    for (int k = 0; k < 4; k++)
      add_to(&t->scratch.external_forces[hinge->slots[k]], sbri_scale(gradients[k], -torque));
  }
}

/* ---- Force fields ---- */

sbf_vec3 sbri_field_at(const sbf_force_field *field, sbf_vec3 x, sbf_vec3 v) {
  sbf_vec3 offset = sbri_sub(x, field->position), none = {0, 0, 0};
  float distance = sbri_length(offset);
  if (field->radius > 0 && distance > field->radius) return none;
  float g = field->strength;
  if (field->falloff > 0) g *= sbri_exp(-field->falloff * sbri_log(1 + distance));
  sbf_vec3 direction = sbri_normalize(field->direction, none);
  switch (field->kind) {
  case SBF_FIELD_KIND_UNIFORM:
    return sbri_scale(direction, g);
  case SBF_FIELD_KIND_RADIAL:
    return sbri_scale(sbri_normalize(offset, none), g);
  case SBF_FIELD_KIND_VORTEX:
    return sbri_scale(sbri_normalize(sbri_cross(direction, offset), none), g);
  default:
    return sbri_scale(v, -g);
  }
}

/* Evaluated in the space of the anchor. A drag field removes at most the whole velocity in a substep. */
static void add_fields(const sbri_island_tick *t, float h) {
  const sbf_force_field_list *fields = &t->model->asset->environment.fields;
  sbf_quat there = sbri_quat_conjugate(t->environment.anchor.rotation);
  for (uint32_t slot = 0; slot < t->island->free_count; slot++) {
    float m = t->island->masses[slot];
    if (!(m > 0)) continue;
    sbf_vec3 x = sbri_rotate(there, sbri_sub(vec_of(&t->positions[slot]), t->environment.anchor.position));
    sbf_vec3 v = sbri_rotate(there, velocity_of(t, slot)), a = {0, 0, 0};
    for (uint32_t i = 0; i < fields->count; i++) {
      sbf_vec3 one = sbri_field_at(&fields->at[i], x, v);
      float size = sbri_length(one) * h, speed = sbri_length(v);
      bool drags = fields->at[i].kind == SBF_FIELD_KIND_DRAG && size > speed;
      a = sbri_add_scaled(a, one, drags ? speed / size : 1);
    }
    add_to(&t->scratch.external_forces[slot], sbri_scale(sbri_rotate(t->environment.anchor.rotation, a), m));
  }
}

void sbri_compute_external_forces(const sbri_island_tick *t, float h) {
  clear(t->scratch.external_forces, t->island->slot_count);
  for (uint32_t b = 0; b < t->island->body_count; b++) {
    const sbri_body *body = &t->model->bodies[t->island->bodies[b]];
    if (body->medium_kg_m3 > 0 || body->gas.pressure_pa != 0) add_surface(t, body, h);
    add_bending(t, body);
  }
  if (t->model->asset->environment.fields.count) add_fields(t, h);
}

/* ---- Stiffness of gases ---- */

/* Squared frequency of one gas, rad^2/s^2: p / V times the sum of w |grad V|^2, plus the rotation of its
 * faces. */
static double gas_square(const sbri_island_tick *t, const sbri_body *body) {
  sbri_point *vertices = t->surfaces.vertices + body->surface.first_vertex;
  sbri_point *gradients = t->surfaces.forces + body->surface.first_vertex;
  double sum = 0;
  compute_vertices(t, &body->surface.skin, false, vertices);
  clear(gradients, body->surface.skin.vertex_count);
  clear(t->scratch.external_forces + body->slots.begin, body->slots.end - body->slots.begin);
  add_pressure(body, vertices, 1, NULL, gradients);
  distribute_forces(t, &body->surface.skin, gradients);
  for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++) {
    sbf_vec3 g = vec_of(&t->scratch.external_forces[slot]);
    sum += (double)t->island->inverse_masses[slot] * (double)sbri_dot(g, g);
  }
  double volume = gas_volume_now(body, vertices),
         pressure =
             fabs((double)(body->gas.pressure_pa * body->gas.max_factor)) * body->gas.volume_m3 / volume;
  return pressure / volume * sum + pressure * body->gas.stiffening;
}

void sbri_update_gas_stiffness(const sbri_island_tick *t) {
  double rest = t->model->islands[t->model->bodies[t->island->bodies[0]].island].stability.external_rad_s,
         square = 0;
  for (uint32_t b = 0; b < t->island->body_count; b++) {
    const sbri_body *body = &t->model->bodies[t->island->bodies[b]];
    if (body->gas.pressure_pa != 0) square += gas_square(t, body);
  }
  if (square == 0) return;
  *t->surfaces.external_rad_s = rest;
  if (GAS_MARGIN * GAS_MARGIN * square > rest * rest) *t->surfaces.external_rad_s = GAS_MARGIN * sqrt(square);
}

/* ---- Energies ---- */

double sbri_external_energy(
    const sbri_island *island, const sbri_body *body, const sbri_point *positions, sbri_point *vertices) {
  double energy = 0;
  for (uint32_t i = 0; i < body->elements.hinge_count; i++) {
    sbf_vec3 x[4];
    for (int k = 0; k < 4; k++) x[k] = vec_of(&positions[body->elements.hinges[i].slots[k]]);
    double angle =
        (double)sbri_angle_between(sbri_hinge_shape_of(x).angle, body->elements.hinges[i].rest_angle);
    energy += 0.5 * (double)body->elements.hinges[i].stiffness * angle * angle;
  }
  if (body->gas.pressure_pa == 0) return energy;
  sbri_island_tick t = {.island = island, .positions = (sbri_point *)(uintptr_t)positions};
  compute_vertices(&t, &body->surface.skin, false, vertices);
  double fraction = volume_of(&body->surface.skin, vertices) / body->gas.volume_m3;
  double reckoned = fraction > MIN_GAS_FRACTION ? fraction : MIN_GAS_FRACTION;
  double grown = (double)sbri_log((float)reckoned) + (fraction - reckoned) / reckoned;
  return energy - (double)body->gas.pressure_pa * body->gas.volume_m3 * grown;
}
