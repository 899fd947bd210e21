#include "contact/ground_contacts.h"

#include <math.h>
#include <string.h>

#include "contact/sample_motion.h"
#include "shapes/contact_reports.h"
#include "shapes/ground.h"

/* Fraction of the body's size. */
static const float MIN_MARGIN_FRACTION = 5e-4f;

/* Bounds of a body's points and their maximum speed. */
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
  for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++) {
    sbf_vec3 v = sbri_point_velocity(t, slot);
    float square = sbri_dot(v, v);
    squares = square > squares ? square : squares;
    extend(&e, &t->positions[slot]);
  }
  e.speed = sqrtf(squares);
  return e;
}

/* Bounds of all points that samples may use, including pinned points on their path. A mean with negative
 * weights lies outside the bounds by at most their sum times the size of the bounds. */
static extent extent_of_samples(const sbri_island_tick *t, const sbri_body *body) {
  extent e = extent_of(t, body);
  for (uint32_t slot = t->island->free_count; body->is_pinned && slot < t->island->slot_count; slot++) {
    e.speed = fmaxf(e.speed, sbri_length(sbri_point_velocity(t, slot)));
    extend(&e, &t->positions[slot]);
  }
  for (int k = 0; k < 3; k++) {
    float overhang = body->contact.max_extrapolation * (e.high[k] - e.low[k]);
    e.low[k] -= overhang, e.high[k] += overhang;
  }
  return e;
}

/* Height under a point in asset metres relative to the origin, and the ground's normal there. */
static float height_at(const sbri_island_tick *t, float x, float z, sbf_vec3 *normal) {
  double world_x = t->environment.origin.x + (double)t->environment.scale * x,
         world_z = t->environment.origin.z + (double)t->environment.scale * z;
  return (
      float)((sbri_ground_height(t->environment.ground, world_x, world_z, normal) - t->environment.origin.y) /
             t->environment.scale);
}

/* Height of flat ground in the same frame; false if the ground is not flat. */
static bool is_ground_flat(const sbri_island_tick *t, float *height) {
  double flat;
  if (!sbri_ground_is_flat(t->environment.ground, &flat)) return false;
  *height = (float)((flat - t->environment.origin.y) / t->environment.scale);
  return true;
}

/* Height below which a point of the body may touch the ground. Takes the maximum of nine positions below and
 * around the body, and adds their range. */
static float reach_of(const sbri_island_tick *t, const extent *e, float displacement) {
  float low = 0, high = 0;
  if (is_ground_flat(t, &high)) return high + displacement;
  for (int i = 0; i < 9; i++) {
    float tx = 0.5f * (float)(i % 3), tz = 0.5f * (float)(i / 3);
    float x = e->low[0] - displacement + (e->high[0] - e->low[0] + 2 * displacement) * tx;
    float z = e->low[2] - displacement + (e->high[2] - e->low[2] + 2 * displacement) * tz;
    sbf_vec3 normal;
    float y = height_at(t, x, z, &normal);
    low = i == 0 || y < low ? y : low;
    high = i == 0 || y > high ? y : high;
  }
  return high + (high - low) + displacement;
}

/* For events: stores a point that reaches its plane within the tick, if it is the fastest. */
static void store_ground_speed(
    const sbri_island_tick *t, uint32_t slot, sbf_vec3 normal, float height, sbri_contact_reports *touched) {
  float closing = -sbri_dot(normal, sbri_point_velocity(t, slot)), gap = height * normal.y;
  float gravity_speed = sbri_length(t->environment.gravity) *
                        t->tick_s; /* pinned points just above the ground may be slower than this */
  float mean = closing > gravity_speed ? closing + 0.5f * gravity_speed : closing;
  if (!(closing > touched->ground_speed) || gap > mean * t->tick_s) return;
  const sbri_point *p = &t->positions[slot];
  touched->ground_speed = closing;
  touched->ground_normal = normal;
  touched->ground_position = sbri_add_scaled(sbri_vec3(p->x, p->y, p->z), normal, -gap);
}

void sbri_ground_planes_find(
    const sbri_island_tick *t, const sbri_body *body, const sbri_contact_tables *to) {
  extent e = extent_of(t, body);
  float displacement = 2 * e.speed * t->tick_s + SBRI_MOTION_FRACTION * body->rest_size_m;
  to->touched->ground_speed = 0;
  float reach = reach_of(t, &e, displacement);
  for (uint32_t block = body->slots.begin / SBRI_BLOCK; block < body->slots.end / SBRI_BLOCK; block++) {
    const sbri_point *points = t->positions + block * SBRI_BLOCK;
    to->near_ground[block] = 0;
    for (int lane = 0; lane < SBRI_BLOCK; lane++)
      if (points[lane].y < reach) to->near_ground[block] = 1;
    if (!to->near_ground[block]) continue;
    float *plane = to->planes + (size_t)block * 4 * SBRI_BLOCK;
    memset(to->pressing + (size_t)block * 2 * SBRI_BLOCK, 0, 2 * SBRI_BLOCK * sizeof(float));
    for (int lane = 0; lane < SBRI_BLOCK; lane++) {
      sbf_vec3 n;
      float y = height_at(t, points[lane].x, points[lane].z, &n);
      plane[lane] = n.x, plane[SBRI_BLOCK + lane] = n.y, plane[2 * SBRI_BLOCK + lane] = n.z;
      plane[3 * SBRI_BLOCK + lane] = n.x * points[lane].x + n.y * y + n.z * points[lane].z;
      uint32_t slot = block * SBRI_BLOCK + (uint32_t)lane;
      if (slot < body->slots.real_end) store_ground_speed(t, slot, n, points[lane].y - y, to->touched);
    }
  }
}

/* Distance by which a sample may approach the ground in a tick beyond twice its present displacement, m: by
 * gravity, and by springs and bones that accelerate it to more than the maximum speed of the body. */
static float margin_of(const sbri_island_tick *t, const sbri_body *body, float fastest) {
  float extra_speed = 0.5f * sbri_length(t->environment.gravity) * t->tick_s + 2 * fastest;
  return t->tick_s * extra_speed + MIN_MARGIN_FRACTION * body->rest_size_m;
}

/* gap, rise: present gap, and its change in the tick at the present velocity, m */
static void add_contact(const sbri_island_tick *t, const sbri_body *body, const sbri_sample *s,
    sbf_vec3 normal, float offset, float gap, float rise, const sbri_contact_tables *to) {
  uint32_t *count = &to->contact_counts[body - t->model->bodies];
  to->contacts[body->contact.first + (*count)++] = (sbri_soft_contact){.sample = *s,
      .normal = normal,
      .offset = offset,
      .friction_scale = 1,
      .restitution = body->contact.restitution,
      .collider = SBRI_NO_COLLIDER,
      .gap = gap + (rise < 0 ? rise : 0)};
}

static void add_sample(const sbri_island_tick *t, const sbri_body *body, const sbri_sample *s, float margin,
    const sbri_contact_tables *to) {
  if (!(s->mass_kg > 0)) return;
  sbf_vec3 x = sbri_sample_position(t, s), n;
  float y = height_at(t, x.x, x.z, &n), offset = n.x * x.x + n.y * y + n.z * x.z;
  float gap = sbri_dot(n, x) - offset, rise = t->tick_s * sbri_dot(n, sbri_sample_velocity(t, s));
  if (gap + 2 * (rise < 0 ? rise : 0) > margin) return;
  add_contact(t, body, s, n, offset, gap, rise, to);
}

/* Lower bound of the heights of the group's samples. */
static float min_height(const sbri_island_tick *t, const sbri_sample_group *group) {
  float low = t->positions[group->slots[0]].y, high = low;
  for (int k = 1; k < 4; k++) {
    float y = t->positions[group->slots[k]].y;
    low = y < low ? y : low, high = y > high ? y : high;
  }
  return low - group->max_extrapolation * (high - low);
}

/* ---- Flat ground: heights only ---- */

typedef struct flat_search {
  const sbri_island_tick *tick;
  const sbri_body *body;
  const sbri_contact_tables *tables;
  float height, margin;      /* height of the ground; margin above it in the tick, m */
  const sbri_point *heights; /* (slots) x: height of the point above the ground; y: its rise in the tick, m */
} flat_search;

static void find_heights(const flat_search *f, uint32_t begin, uint32_t end, sbri_point *heights) {
  for (uint32_t slot = begin; slot < end; slot++)
    heights[slot] = (sbri_point){
        f->tick->positions[slot].y - f->height, f->tick->tick_s * sbri_point_velocity(f->tick, slot).y, 0, 0};
}

static void add_group(const flat_search *f, const sbri_sample_group *group) {
  for (uint32_t i = group->first; i < group->end; i++) {
    const sbri_sample *s = &f->body->contact.samples[i];
    float gap = 0, rise = 0;
    for (int k = 0; k < 4; k++) {
      const sbri_point *p = &f->heights[s->slots[k]];
      gap += s->weights[k] * p->x, rise += s->weights[k] * p->y;
    }
    if (gap + 2 * (rise < 0 ? rise : 0) > f->margin || !(s->mass_kg > 0)) continue;
    add_contact(f->tick, f->body, s, sbri_vec3(0, 1, 0), f->height, gap, rise, f->tables);
  }
}

static void add_on_flat_ground(const flat_search *f, float reach) {
  const sbri_island *island = f->tick->island;
  find_heights(f, f->body->slots.begin, f->body->slots.end, f->tick->scratch.velocity_points);
  if (f->body->is_pinned)
    find_heights(f, island->free_count, island->slot_count, f->tick->scratch.velocity_points);
  for (uint32_t g = 0; g < f->body->contact.sample_group_count; g++)
    if (min_height(f->tick, &f->body->contact.sample_groups[g]) <= reach)
      add_group(f, &f->body->contact.sample_groups[g]);
}

void sbri_ground_contacts_add(
    const sbri_island_tick *t, const sbri_body *body, const sbri_contact_tables *to) {
  uint32_t first = body->slots.begin / SBRI_BLOCK, *count = &to->contact_counts[body - t->model->bodies];
  memset(to->near_ground + first, 0, body->slots.end / SBRI_BLOCK - first);
  *count = 0;
  extent e = extent_of_samples(t, body);
  float margin = margin_of(t, body, e.speed), height = 0;
  const bool is_flat = is_ground_flat(t, &height) && !t->island->splits;
  float reach = reach_of(t, &e, e.speed * (1 + 2 * body->contact.max_extrapolation) * 2 * t->tick_s + margin);
  if (e.low[1] > reach) return;
  if (is_flat) {
    add_on_flat_ground(&(flat_search){t, body, to, height, margin, t->scratch.velocity_points}, reach);
    return;
  }
  for (uint32_t g = 0; g < body->contact.sample_group_count; g++) {
    const sbri_sample_group *group = &body->contact.sample_groups[g];
    if (!t->island->splits && min_height(t, group) > reach) continue;
    for (uint32_t i = group->first; i < group->end; i++) {
      sbri_sample s = sbri_sample_now(t, &body->contact.samples[i], to->surface);
      add_sample(t, body, &s, margin, to);
    }
  }
}
