/* Positions and velocities of the points pinned to frames. */
#include <string.h>

#include "math/quat.h"
#include "state/pose/frames.h"

/* A rigid motion as three rows of four; the last column is the translation. */
typedef struct rows {
  float at[3][4];
} rows;

static rows rows_of(const sbri_delta *t) {
  sbf_vec3 x = sbri_rotate(t->rotation, sbri_vec3(1, 0, 0)), y = sbri_rotate(t->rotation, sbri_vec3(0, 1, 0)),
           z = sbri_rotate(t->rotation, sbri_vec3(0, 0, 1));
  return (rows){
      {{x.x, y.x, z.x, t->position.x}, {x.y, y.y, z.y, t->position.y}, {x.z, y.z, z.z, t->position.z}}};
}

static sbri_wide row(const rows *r, int k, sbri_wide3 p) {
  return sbri_wide_all(r->at[k][0]) * p.x + sbri_wide_all(r->at[k][1]) * p.y +
         sbri_wide_all(r->at[k][2]) * p.z + sbri_wide_all(r->at[k][3]);
}

static sbri_point guided(const sbri_driver *driver, const sbri_delta *deltas, const sbri_point *rest) {
  sbf_vec3 sum = {0, 0, 0}, p = {rest->x, rest->y, rest->z};
  for (int k = 0; k < SBRI_DRIVERS; k++) {
    if (driver->weights[k] == 0) continue;
    sum = sbri_add_scaled(sum, sbri_delta_position(&deltas[driver->frames[k]], p), driver->weights[k]);
  }
  return (sbri_point){sum.x, sum.y, sum.z, 0};
}

void sbri_compute_driver_positions(
    const sbr_model *model, const sbri_body *body, const sbri_delta *deltas, sbri_point *positions) {
  const sbri_point *rest = model->islands[body->island].rest + body->slots.begin;
  uint32_t count = body->slots.end - body->slots.begin;
  if (body->drivers) {
    for (uint32_t i = 0; i < count; i++) positions[i] = guided(&body->drivers[i], deltas, &rest[i]);
    return;
  }
  if (deltas[body->driver_frame].squash) {
    for (uint32_t i = 0; i < count; i++) {
      sbf_vec3 p = {rest[i].x, rest[i].y, rest[i].z};
      p = sbri_delta_position(&deltas[body->driver_frame], p);
      positions[i] = (sbri_point){p.x, p.y, p.z, 0};
    }
    return;
  }
  rows r = rows_of(&deltas[body->driver_frame]);
  for (uint32_t i = 0; i < count; i += SBRI_LANES) {
    sbri_wide3 p = sbri_wide_load_points(rest + i);
    sbri_wide_store_points(positions + i, (sbri_wide3){row(&r, 0, p), row(&r, 1, p), row(&r, 2, p)});
  }
}

/* sbri_delta_position for a group of lanes without squash, with the same bits. */
static sbri_wide3 placed(const sbri_delta *d, sbri_wide3 v) {
  const sbri_wide ux = sbri_wide_all(d->rotation.x), uy = sbri_wide_all(d->rotation.y),
                  uz = sbri_wide_all(d->rotation.z), w = sbri_wide_all(d->rotation.w), two = sbri_wide_all(2);
  const sbri_wide3 t = {
      (uy * v.z - uz * v.y) * two, (uz * v.x - ux * v.z) * two, (ux * v.y - uy * v.x) * two};
  return (sbri_wide3){sbri_wide_all(d->position.x) + (v.x + t.x * w + (uy * t.z - uz * t.y)),
      sbri_wide_all(d->position.y) + (v.y + t.y * w + (uz * t.x - ux * t.z)),
      sbri_wide_all(d->position.z) + (v.z + t.z * w + (ux * t.y - uy * t.x))};
}

void sbri_compute_pin_targets(const sbri_island *island, const sbri_delta *deltas, sbri_point *positions) {
  const sbri_point *rest = island->rest;
  for (uint32_t first = island->free_count; first < island->slot_count; first += SBRI_LANES) {
    const uint32_t *frames = island->pins.frames + (first - island->free_count);
    bool one = !deltas[frames[0]].squash;
    for (uint32_t i = 1; i < SBRI_LANES; i++) one = one && frames[i] == frames[0];
    if (one) {
      sbri_wide3 p = sbri_wide_load_points(rest + first);
      sbri_wide_store_points(positions + first, placed(&deltas[frames[0]], p));
      continue;
    }
    for (uint32_t i = 0; i < SBRI_LANES; i++) {
      const sbri_point *at = &rest[first + i];
      sbf_vec3 p = sbri_delta_position(&deltas[frames[i]], sbri_vec3(at->x, at->y, at->z));
      positions[first + i] = (sbri_point){p.x, p.y, p.z, 0};
    }
  }
}

void sbri_drivers_stop(sbri_character *c, const sbri_island *island) {
  for (uint32_t b = 0; b < island->body_count; b++)
    memset(&sbri_driver_motions(c)[island->bodies[b]], 0, sizeof(sbri_driver_motion));
}

bool sbri_drivers_rest(const sbri_character *c, const sbri_island *island) {
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_driver_motion *m = &sbri_driver_motions(c)[island->bodies[b]];
    if (!c->model->bodies[island->bodies[b]].is_pinned) continue;
    if (sbri_dot(m->velocity, m->velocity) != 0 || sbri_dot(m->angular_velocity, m->angular_velocity) != 0)
      return false;
  }
  return true;
}
