#include "contact/ground_contacts.h"

#include <math.h>
#include <string.h>

#include "collide/ground.h"
#include "contact/carried.h"

/* Of a body's size. */
static const float MIN_MARGIN_FRACTION = 5e-4f;

/* Range of a body's points and their greatest speed. */
typedef struct extent {
  float low[3], high[3], speed;
  bool any;
} extent;

static void extend(extent *e, const sbri_point *p) {
  const float at[3] = {p->x, p->y, p->z};
  for (int k = 0; k < 3; k++) {
    e->low[k] = !e->any || at[k] < e->low[k] ? at[k] : e->low[k];
    e->high[k] = !e->any || at[k] > e->high[k] ? at[k] : e->high[k];
  }
  e->any = true;
}

static extent extent_of(const sbri_island_tick *t, const sbri_body *body) {
  extent e = {{0}, {0}, 0, false};
  float squares = 0;
  for (uint32_t slot = body->slot_begin; slot < body->slot_real_end; slot++) {
    sbf_vec3 v = sbri_carried_velocity(t, slot);
    float square = sbri_dot(v, v);
    squares = square > squares ? square : squares;
    extend(&e, &t->positions[slot]);
  }
  e.speed = sqrtf(squares);
  return e;
}

/* Over all points that a sample may have, pinned ones at their targets included. A weighted mean with
 * negative weights of that sum lies outside of the points' range by at most as many times the range. */
static extent extent_of_samples(const sbri_island_tick *t, const sbri_body *body) {
  extent e = extent_of(t, body);
  for (uint32_t slot = t->island->free_count; body->is_pinned && slot < t->island->slot_count; slot++) {
    e.speed = fmaxf(e.speed, sbri_length(sbri_carried_velocity(t, slot)));
    extend(&e, &t->positions[slot]);
  }
  for (int k = 0; k < 3; k++) {
    float beyond = body->sample_beyond * (e.high[k] - e.low[k]);
    e.low[k] -= beyond, e.high[k] += beyond;
  }
  return e;
}

/* Height under a point in asset metres relative to the origin, and the ground's normal there. */
static float height_at(const sbri_island_tick *t, float x, float z, sbf_vec3 *normal) {
  double world_x = t->origin.x + (double)t->scale * x, world_z = t->origin.z + (double)t->scale * z;
  return (float)((sbri_ground_height(t->ground, world_x, world_z, normal) - t->origin.y) / t->scale);
}

/* The height below which a point of the body may touch the ground: of nine places under the body and around
 * it, the highest, and as much again as they differ. */
static float reach_of(const sbri_island_tick *t, const extent *e, float motion) {
  double flat;
  if (sbri_ground_is_flat(t->ground, &flat)) return (float)((flat - t->origin.y) / t->scale) + motion;
  float low = 0, high = 0;
  for (int i = 0; i < 9; i++) {
    float tx = 0.5f * (float)(i % 3), tz = 0.5f * (float)(i / 3);
    float x = e->low[0] - motion + (e->high[0] - e->low[0] + 2 * motion) * tx;
    float z = e->low[2] - motion + (e->high[2] - e->low[2] + 2 * motion) * tz;
    sbf_vec3 normal;
    float y = height_at(t, x, z, &normal);
    low = i == 0 || y < low ? y : low;
    high = i == 0 || y > high ? y : high;
  }
  return high + (high - low) + motion;
}

void sbri_ground_planes_find(
    const sbri_island_tick *t, const sbri_body *body, const sbri_contact_tables *to) {
  extent e = extent_of(t, body);
  float motion = 2 * e.speed * t->tick_s + SBRI_MOTION_FRACTION * body->rest_size_m;
  float reach = reach_of(t, &e, motion);
  for (uint32_t block = body->slot_begin / SBRI_BLOCK; block < body->slot_end / SBRI_BLOCK; block++) {
    const sbri_point *points = t->positions + block * SBRI_BLOCK;
    to->near_ground[block] = 0;
    for (int lane = 0; lane < SBRI_BLOCK; lane++)
      if (points[lane].y < reach) to->near_ground[block] = 1;
    if (!to->near_ground[block]) continue;
    float *plane = to->planes + (size_t)block * 4 * SBRI_BLOCK;
    for (int lane = 0; lane < SBRI_BLOCK; lane++) {
      sbf_vec3 n;
      float y = height_at(t, points[lane].x, points[lane].z, &n);
      plane[lane] = n.x, plane[SBRI_BLOCK + lane] = n.y, plane[2 * SBRI_BLOCK + lane] = n.z;
      plane[3 * SBRI_BLOCK + lane] = n.x * points[lane].x + n.y * y + n.z * points[lane].z;
    }
  }
}

/* ---- Samples ---- */

typedef struct ground_search {
  const sbri_island_tick *tick;
  const sbri_body *body;
  const sbri_contact_tables *tables;
  const float *low; /* (slots) flat ground: the lowest of each point in the tick, with its speed twice */
  bool is_flat;
  float height, margin, reach; /* of flat ground; of samples; below which a sample is looked at, m */
  uint32_t *count;
} ground_search;

/* m: approach of a sample to the ground in a tick beyond twice its present displacement, by gravity, and by
 * springs and bones, which may make it faster than the fastest point of the body. */
static float fastest_approach(const sbri_island_tick *t, float fastest) {
  return 0.5f * sbri_length(t->gravity) * t->tick_s + 2 * fastest;
}

static void add_contact(
    const ground_search *g, const sbri_sample *s, sbf_vec3 normal, float offset, float predicted) {
  g->tables->contacts[g->body->first_soft_contact + (*g->count)++] = (sbri_soft_contact){.sample = *s,
      .normal = normal,
      .offset = offset,
      .friction_scale = 1,
      .restitution = g->body->restitution,
      .gap = predicted,
      .fast_m_s = g->margin / g->tick->tick_s,
      .collider = SBRI_NO_COLLIDER};
}

static void add_sample(const ground_search *g, const sbri_sample *s) {
  const sbri_island_tick *t = g->tick;
  if (!(s->mass_kg > 0)) return;
  if (g->is_flat) {
    float predicted = -g->height;
    for (int k = 0; k < 4; k++) predicted += s->weights[k] * g->low[s->slots[k]];
    if (predicted <= g->margin) add_contact(g, s, sbri_vec3(0, 1, 0), g->height, predicted);
    return;
  }
  sbf_vec3 x = sbri_sample_position(t, s), n;
  float y = height_at(t, x.x, x.z, &n), offset = n.x * x.x + n.y * y + n.z * x.z;
  float approach = -sbri_dot(n, sbri_sample_velocity(t, s));
  float predicted = sbri_dot(n, x) - offset - (approach > 0 ? approach : 0) * 2 * t->tick_s;
  if (predicted <= g->margin) add_contact(g, s, n, offset, predicted);
}

/* No sample of the group is lower. */
static float lowest_of(const ground_search *g, const sbri_sample_group *group) {
  const sbri_point *x = g->tick->positions;
  float low = 0, high = 0;
  for (int k = 0; k < 4; k++) {
    uint32_t slot = group->slots[k];
    float y = x[slot].y, y_low = g->is_flat ? g->low[slot] : y;
    low = k == 0 || y_low < low ? y_low : low, high = k == 0 || y > high ? y : high;
  }
  return low - group->beyond * (high - low);
}

static float lowest_of_point(const sbri_island_tick *t, uint32_t slot) {
  float displacement = 2 * t->tick_s * sbri_carried_velocity(t, slot).y;
  return t->positions[slot].y + (displacement < 0 ? displacement : 0);
}

static void find_lowest_points(const sbri_island_tick *t, const sbri_body *body, float *low) {
  for (uint32_t slot = body->slot_begin; slot < body->slot_real_end; slot++)
    low[slot] = lowest_of_point(t, slot);
  for (uint32_t slot = t->island->free_count; body->is_pinned && slot < t->island->slot_count; slot++)
    low[slot] = lowest_of_point(t, slot);
}

void sbri_ground_contacts_add(
    const sbri_island_tick *t, const sbri_body *body, const sbri_contact_tables *to) {
  uint32_t first = body->slot_begin / SBRI_BLOCK;
  memset(to->near_ground + first, 0, body->slot_end / SBRI_BLOCK - first);
  extent e = extent_of_samples(t, body);
  double flat;
  ground_search g = {.tick = t, .body = body, .tables = to, .low = t->contact_weights};
  g.is_flat = sbri_ground_is_flat(t->ground, &flat);
  g.height = (float)((flat - t->origin.y) / t->scale);
  g.count = &to->contact_counts[body - t->model->bodies];
  g.margin = t->tick_s * fastest_approach(t, e.speed) + MIN_MARGIN_FRACTION * body->rest_size_m;
  g.reach = reach_of(t, &e, e.speed * (1 + 2 * body->sample_beyond) * 2 * t->tick_s + g.margin);
  if (e.low[1] > g.reach) return;
  if (g.is_flat) {
    g.reach = g.height + g.margin;
    find_lowest_points(t, body, t->contact_weights);
  }
  for (uint32_t i = 0; i < body->sample_group_count; i++) {
    const sbri_sample_group *group = &body->sample_groups[i];
    if (!t->island->splits && lowest_of(&g, group) > g.reach) continue;
    for (uint32_t k = group->first; k < group->end; k++) {
      sbri_sample s;
      if (t->island->splits) s = sbri_sample_now(t, &body->samples[k], to->surface);
      add_sample(&g, t->island->splits ? &s : &body->samples[k]);
    }
  }
}
