#include "collide/contact.h"

#include "collide/ground.h"

/* Range of a body's free points and their greatest speed. */
typedef struct extent {
  float low[3], high[3], speed;
} extent;

static extent extent_of(const sbri_contact_input *in) {
  extent e = {{0}, {0}, 0};
  float squares = 0;
  for (uint32_t slot = in->body->slot_begin; slot < in->body->slot_real_end; slot++) {
    const sbri_point *p = &in->positions[slot];
    const float at[3] = {p->x, p->y, p->z};
    const float *v = in->velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
    float square = v[0] * v[0] + v[SBRI_BLOCK] * v[SBRI_BLOCK] + v[2 * SBRI_BLOCK] * v[2 * SBRI_BLOCK];
    squares = square > squares ? square : squares;
    for (int k = 0; k < 3; k++) {
      bool first = slot == in->body->slot_begin;
      e.low[k] = first || at[k] < e.low[k] ? at[k] : e.low[k];
      e.high[k] = first || at[k] > e.high[k] ? at[k] : e.high[k];
    }
  }
  e.speed = sqrtf(squares);
  return e;
}

/* Height under a point in asset metres relative to the origin, and the ground's normal there. */
static float height_at(const sbri_contact_input *in, float x, float z, sbf_vec3 *normal) {
  double world_x = in->origin.x + (double)in->scale * x, world_z = in->origin.z + (double)in->scale * z;
  return (float)((sbri_ground_height(in->ground, world_x, world_z, normal) - in->origin.y) / in->scale);
}

/* The height below which a point of the body may touch the ground: of nine places under the body and around
 * it, the highest, and as much again as they differ. */
static float reach_of(const sbri_contact_input *in, const extent *e, float motion) {
  double flat;
  if (sbri_ground_is_flat(in->ground, &flat)) return (float)((flat - in->origin.y) / in->scale) + motion;
  float low = 0, high = 0;
  for (int i = 0; i < 9; i++) {
    float tx = 0.5f * (float)(i % 3), tz = 0.5f * (float)(i / 3);
    float x = e->low[0] - motion + (e->high[0] - e->low[0] + 2 * motion) * tx;
    float z = e->low[2] - motion + (e->high[2] - e->low[2] + 2 * motion) * tz;
    sbf_vec3 normal;
    float y = height_at(in, x, z, &normal);
    low = i == 0 || y < low ? y : low;
    high = i == 0 || y > high ? y : high;
  }
  return high + (high - low) + motion;
}

void sbri_contact_prepare(const sbri_contact_input *in, uint8_t *near_ground, float *planes) {
  const sbri_body *body = in->body;
  if (body->slot_begin == body->slot_end) return;
  extent e = extent_of(in);
  /* As far as a point may fall in the tick: twice its present way, and a share of the body for what springs
   * and weight may add. */
  float motion = 2 * e.speed * in->tick_s + 0.02f * body->rest_size_m;
  float reach = reach_of(in, &e, motion);
  for (uint32_t block = body->slot_begin / SBRI_BLOCK; block < body->slot_end / SBRI_BLOCK; block++) {
    const sbri_point *points = in->positions + block * SBRI_BLOCK;
    near_ground[block] = 0;
    for (int lane = 0; lane < SBRI_BLOCK; lane++)
      if (points[lane].y < reach) near_ground[block] = 1;
    if (!near_ground[block]) continue;
    float *plane = planes + (size_t)block * 4 * SBRI_BLOCK;
    for (int lane = 0; lane < SBRI_BLOCK; lane++) {
      sbf_vec3 n;
      float y = height_at(in, points[lane].x, points[lane].z, &n);
      plane[lane] = n.x, plane[SBRI_BLOCK + lane] = n.y, plane[2 * SBRI_BLOCK + lane] = n.z;
      plane[3 * SBRI_BLOCK + lane] = n.x * points[lane].x + n.y * y + n.z * points[lane].z;
    }
  }
}
