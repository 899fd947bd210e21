#include "contact/contact.h"

#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "collide/external_body.h"
#include "collide/ground.h"
#include "collide/touching.h"
#include "contact/sample_motion.h"
#include "contact/self_contacts.h"
#include "contact/soft_shape_contacts.h"

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
    sbf_vec3 v = sbri_point_velocity(t, slot);
    float square = sbri_dot(v, v);
    squares = square > squares ? square : squares;
    extend(&e, &t->positions[slot]);
  }
  e.speed = sqrtf(squares);
  return e;
}

/* Of all that may carry a sample, held points on their way included. No mean with weights below 0 of so much
 * lies further out than as many times the range. */
static extent extent_of_samples(const sbri_island_tick *t, const sbri_body *body) {
  extent e = extent_of(t, body);
  for (uint32_t slot = t->island->free_count; body->is_pinned && slot < t->island->slot_count; slot++) {
    e.speed = fmaxf(e.speed, sbri_length(sbri_point_velocity(t, slot)));
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

/* For events: notes a point that reaches its plane within the tick, unless a faster one does. */
static void note_ground_speed(
    const sbri_island_tick *t, uint32_t slot, sbf_vec3 normal, float height, sbri_touching *touched) {
  float closing = -sbri_dot(normal, sbri_point_velocity(t, slot)), gap = height * normal.y;
  float gained = sbri_length(t->gravity) * t->tick_s; /* slower points may hover, pinned, above it */
  float mean = closing > gained ? closing + 0.5f * gained : closing;
  if (!(closing > touched->ground_speed) || gap > mean * t->tick_s) return;
  const sbri_point *p = &t->positions[slot];
  touched->ground_speed = closing;
  touched->ground_normal = normal;
  touched->ground_position = sbri_add_scaled(sbri_vec3(p->x, p->y, p->z), normal, -gap);
}

static void prepare_points(const sbri_island_tick *t, const sbri_body *body, const sbri_contact_tables *to) {
  extent e = extent_of(t, body);
  float motion = 2 * e.speed * t->tick_s + SBRI_MOTION_FRACTION * body->rest_size_m;
  to->touched->ground_speed = 0;
  float reach = reach_of(t, &e, motion);
  for (uint32_t block = body->slot_begin / SBRI_BLOCK; block < body->slot_end / SBRI_BLOCK; block++) {
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
      if (slot < body->slot_real_end) note_ground_speed(t, slot, n, points[lane].y - y, to->touched);
    }
  }
}

/* m by which a sample may come nearer to the ground in a tick than by twice its present way: by weight, and
 * by springs and bones that make it as fast as the fastest of the body, and more. */
static float margin_of(const sbri_island_tick *t, const sbri_body *body, float fastest) {
  float faster = 0.5f * sbri_length(t->gravity) * t->tick_s + 2 * fastest;
  return t->tick_s * faster + MIN_MARGIN_FRACTION * body->rest_size_m;
}

static void prepare_sample(const sbri_island_tick *t, const sbri_body *body, const sbri_sample *s,
    float margin, const sbri_contact_tables *to) {
  uint32_t *count = &to->contact_counts[body - t->model->bodies];
  if (!(s->mass_kg > 0)) return;
  sbf_vec3 x = sbri_sample_position(t, s), n;
  float y = height_at(t, x.x, x.z, &n), offset = n.x * x.x + n.y * y + n.z * x.z;
  float approach = -sbri_dot(n, sbri_sample_velocity(t, s));
  if (sbri_dot(n, x) - offset > (approach > 0 ? approach : 0) * 2 * t->tick_s + margin) return;
  to->contacts[body->first_soft_contact + (*count)++] = (sbri_soft_contact){.sample = *s,
      .normal = n,
      .offset = offset,
      .friction_scale = 1,
      .restitution = body->restitution,
      .collider = SBRI_NO_COLLIDER};
}

/* No sample of the group is lower. */
static float lowest_of(const sbri_island_tick *t, const sbri_sample_group *group) {
  float low = t->positions[group->slots[0]].y, high = low;
  for (int k = 1; k < 4; k++) {
    float y = t->positions[group->slots[k]].y;
    low = y < low ? y : low, high = y > high ? y : high;
  }
  return low - group->beyond * (high - low);
}

/* Those whose way within the tick may end on the ground. */
static void prepare_samples(const sbri_island_tick *t, const sbri_body *body, const sbri_contact_tables *to) {
  uint32_t first = body->slot_begin / SBRI_BLOCK, *count = &to->contact_counts[body - t->model->bodies];
  memset(to->near_ground + first, 0, body->slot_end / SBRI_BLOCK - first);
  *count = 0;
  extent e = extent_of_samples(t, body);
  float margin = margin_of(t, body, e.speed);
  float reach = reach_of(t, &e, e.speed * (1 + 2 * body->sample_beyond) * 2 * t->tick_s + margin);
  if (e.low[1] > reach) return;
  for (uint32_t g = 0; g < body->sample_group_count; g++) {
    const sbri_sample_group *group = &body->sample_groups[g];
    if (!t->island->splits && lowest_of(t, group) > reach) continue;
    for (uint32_t i = group->first; i < group->end; i++) {
      sbri_sample s = sbri_sample_now(t, &body->samples[i], to->surface);
      prepare_sample(t, body, &s, margin, to);
    }
  }
}

/* Bodies of points alone stand against the ground by planes a point each: as touches these are solved along
 * with those of shapes. */
static void convert_planes_to_contacts(
    const sbri_island_tick *t, const sbri_body *body, const sbri_contact_tables *tables) {
  uint32_t *count = &tables->contact_counts[body - t->model->bodies];
  for (uint32_t block = body->slot_begin / SBRI_BLOCK; block < body->slot_end / SBRI_BLOCK; block++) {
    if (!tables->near_ground[block]) continue;
    tables->near_ground[block] = 0;
    const float *plane = tables->planes + (size_t)block * 4 * SBRI_BLOCK;
    for (uint32_t lane = 0; lane < SBRI_BLOCK && *count < body->max_contacts; lane++) {
      sbri_sample s = sbri_point_sample(t, block * SBRI_BLOCK + lane);
      if (s.slots[0] >= body->slot_real_end || !(s.mass_kg > 0)) continue;
      tables->contacts[body->first_soft_contact + (*count)++] = (sbri_soft_contact){.sample = s,
          .normal = {plane[lane], plane[SBRI_BLOCK + lane], plane[2 * SBRI_BLOCK + lane]},
          .offset = plane[3 * SBRI_BLOCK + lane],
          .friction_scale = 1,
          .restitution = body->restitution,
          .collider = SBRI_NO_COLLIDER};
    }
  }
}

/* Marks contacts whose points have no other contact. In a body with samples several of them may share points.
 */
static void find_alone(const sbri_island_tick *t, const sbri_body *body, const sbri_contact_tables *tables) {
  sbri_soft_contact *contacts = tables->contacts + body->first_soft_contact;
  uint32_t count = tables->contact_counts[body - t->model->bodies];
  memset(tables->slot_contacts + body->slot_begin, 0, body->slot_end - body->slot_begin);
  for (uint32_t i = 0; i < count; i++)
    for (int k = 0; k < 4; k++) {
      uint32_t slot = contacts[i].sample.slots[k];
      bool moves = contacts[i].sample.weights[k] != 0 && slot < t->island->free_count;
      if (moves && tables->slot_contacts[slot] < 2) tables->slot_contacts[slot]++;
    }
  for (uint32_t i = 0; i < count; i++) {
    const sbri_sample *s = &contacts[i].sample;
    contacts[i].alone = !contacts[i].external_body && s->weights[0] == 1 && s->weights[1] == 0 &&
                        s->weights[2] == 0 && s->weights[3] == 0 && s->slots[0] < t->island->free_count &&
                        tables->slot_contacts[s->slots[0]] == 1;
  }
}

void sbri_contact_prepare(
    const sbri_island_tick *t, const sbri_body *body, const sbri_contact_tables *tables) {
  tables->contact_counts[body - t->model->bodies] = 0;
  if (body->slot_begin == body->slot_end) return;
  if (body->samples)
    prepare_samples(t, body, tables);
  else
    prepare_points(t, body, tables);
  uint32_t *count = &tables->contact_counts[body - t->model->bodies], before = *count;
  tables->external_bodies->count = 0;
  sbri_soft_shape_contacts_add(t, body, tables);
  if (body->self_face_count) {
    sbri_bounds_tree tree = {.nodes = tables->self_nodes, .items = tables->self_items};
    sbri_self_contacts_add(t, body, tables, &tree);
  }
  if (*count > before && !body->samples) {
    convert_planes_to_contacts(t, body, tables);
    find_alone(t, body, tables);
  }
  SBF_ASSERT(*count <= body->max_contacts);
}
