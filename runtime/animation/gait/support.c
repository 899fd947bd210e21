/* Balance: the centre of mass above the polygon of the planted feet, now and at its predicted position. */
#include "animation/gait/gait_state.h"
#include "animation/skeleton/rig_mass.h"

static const float NEEDED = 0.02f; /* fraction of the legs' reach: margin inside before a foot lifts off */
static const float SOUGHT = 0.05f; /* margin that the lean aims for */
static const float MAX = 0.3f;     /* fraction of the reach: maximum lean */

typedef struct polygon {
  sbf_vec3 at[4 * SBRI_MAX_LEGS + 1];
  uint32_t count;
} polygon;

static float side(sbf_vec3 a, sbf_vec3 b, sbf_vec3 c) {
  return (b.x - a.x) * (c.z - a.z) - (b.z - a.z) * (c.x - a.x);
}

/* Convex hull of the planted feet, in one orientation (Andrew 1979). */
static polygon hull_of(const sbri_rig *rig, const sbri_gait_state *state, float scale, uint32_t lifted) {
  sbf_vec3 points[4 * SBRI_MAX_LEGS];
  uint32_t n = 0;
  for (uint32_t i = 0; i < 4 * rig->leg_count; i++) {
    const sbri_foot *foot = &state->feet[i / 4];
    if (!foot->planted || lifted & 1u << (i / 4)) continue;
    sbf_vec3 corner = sbri_scale(rig->legs[i / 4].sole.corners[i % 4], scale);
    float s = foot->frame.sine, c = foot->frame.cosine;
    corner = sbri_vec3(c * corner.x + s * corner.z, corner.y, c * corner.z - s * corner.x);
    sbf_vec3 p = sbri_add(foot->ground, corner);
    uint32_t k = n++;
    for (; k > 0 && (points[k - 1].x > p.x || (points[k - 1].x == p.x && points[k - 1].z > p.z)); k--)
      points[k] = points[k - 1];
    points[k] = p;
  }
  sbf_vec3 ring[8 * SBRI_MAX_LEGS + 2];
  uint32_t m = 0;
  for (uint32_t i = 0; i < n; i++) {
    while (m >= 2 && side(ring[m - 2], ring[m - 1], points[i]) <= 0) m--;
    ring[m++] = points[i];
  }
  for (uint32_t i = n > 1 ? n - 1 : 0, min = m + 1; i-- > 0;) {
    while (m >= min && side(ring[m - 2], ring[m - 1], points[i]) <= 0) m--;
    ring[m++] = points[i];
  }
  polygon p = {.count = m > 1 ? m - 1 : m};
  for (uint32_t i = 0; i < p.count; i++) p.at[i] = ring[i];
  return p;
}

static sbf_vec3 nearest_on(sbf_vec3 p, sbf_vec3 a, sbf_vec3 b) {
  sbf_vec3 along = {b.x - a.x, 0, b.z - a.z}, to = {p.x - a.x, 0, p.z - a.z};
  float square = sbri_dot(along, along);
  float t = square > 0 ? sbri_clamp(sbri_dot(to, along) / square, 0, 1) : 0;
  return sbri_add_scaled(sbri_vec3(a.x, 0, a.z), along, t);
}

/* Signed distance of p from the polygon's edge, positive inside; `inwards` receives the direction of
 * increase. */
static float margin_of(const polygon *hull, sbf_vec3 p, sbf_vec3 *inwards) {
  bool inside = hull->count > 2;
  float nearest = 1e30f;
  sbf_vec3 spot = p;
  p.y = 0;
  for (uint32_t i = 0; i < hull->count; i++) {
    sbf_vec3 a = hull->at[i], b = hull->at[(i + 1) % hull->count], on = nearest_on(p, a, b);
    float distance = sbri_flat_distance(p, on);
    inside = inside && side(a, b, p) >= 0;
    if (distance < nearest) nearest = distance, spot = on;
  }
  sbf_vec3 to = sbri_sub(spot, p);
  *inwards = sbri_normalize(inside ? sbri_scale(to, -1) : to, sbri_vec3(0, 0, 0));
  return inside ? nearest : -nearest;
}

/* Distance of a coordinate from the range `low` to `high`, reduced by a margin at both ends. */
static float distance_from_range(float coordinate, float low, float high, float margin) {
  float middle = 0.5f * (low + high);
  low = low + margin < middle ? low + margin : middle, high = high - margin > middle ? high - margin : middle;
  return sbri_clamp(coordinate, low, high) - coordinate;
}

sbf_vec3 sbri_standing_offset(const sbri_rig *rig) {
  float low[2] = {1e30f, 1e30f}, high[2] = {-1e30f, -1e30f}, margin = NEEDED * rig->stand.reach;
  sbf_vec3 center;
  bool can_lean =
      rig->leg_count && !rig->stand.has_one_bone_legs && sbri_rig_center(rig, rig->bones.rest, 1, &center);
  if (!can_lean) return sbri_vec3(0, 0, 0);
  for (uint32_t i = 0; i < 4 * rig->leg_count; i++) {
    const sbri_leg *leg = &rig->legs[i / 4];
    float at[2] = {
        leg->home.position.x + leg->sole.corners[i % 4].x, leg->home.position.z + leg->sole.corners[i % 4].z};
    for (int k = 0; k < 2; k++) {
      low[k] = at[k] < low[k] ? at[k] : low[k];
      high[k] = at[k] > high[k] ? at[k] : high[k];
    }
  }
  return sbri_vec3(distance_from_range(center.x, low[0], high[0], margin), 0,
      distance_from_range(center.z, low[1], high[1], margin));
}

static sbf_vec3 center_at(const sbri_gait_state *state, float sway_x, float sway_z) {
  sbf_vec3 c = sbri_add(state->motion.position, state->balance.center);
  return sbri_vec3(c.x + sway_x, 0, c.z + sway_z);
}

/* The smaller of the margins at the centre and at the centre plus `direction`, with the direction of
 * increase. */
static float min_margin(const polygon *hull, sbf_vec3 at, sbf_vec3 direction, sbf_vec3 *inwards) {
  sbf_vec3 margin_then;
  float margin_now = margin_of(hull, at, inwards),
        later = margin_of(hull, sbri_add(at, direction), &margin_then);
  if (later < margin_now) *inwards = margin_then;
  return later < margin_now ? later : margin_now;
}

bool sbri_is_supported(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t lifted, sbf_vec3 direction) {
  polygon hull = hull_of(rig, state, input->scale, lifted);
  sbf_vec3 unused, at = center_at(state, state->balance.sway_x.value, state->balance.sway_z.value);
  return margin_of(&hull, at, &unused) >= NEEDED * rig->stand.reach * input->scale &&
         margin_of(&hull, sbri_add(at, direction), &unused) >= 0;
}

sbf_vec3 sbri_find_sway(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t lifted, sbf_vec3 direction) {
  polygon hull = hull_of(rig, state, input->scale, lifted);
  sbf_vec3 sway = {0, 0, 0}, middle = {0, 0, 0};
  if (hull.count == 0) return sway;
  for (uint32_t i = 0; i < hull.count; i++)
    middle = sbri_add_scaled(middle, hull.at[i], 1 / (float)hull.count);
  middle = sbri_add_scaled(middle, direction, -0.5f);
  float size = rig->stand.reach * input->scale, sought = SOUGHT * size;
  for (int pass = 0; pass < 6; pass++) {
    sbf_vec3 inwards, at = center_at(state, sway.x, sway.z);
    float missing = sought - min_margin(&hull, at, direction, &inwards);
    if (missing <= 1e-5f * size) break;
    sbf_vec3 to_middle = sbri_vec3(middle.x - at.x, 0, middle.z - at.z);
    float distance_to_middle = sbri_length(to_middle); /* a small polygon has no point with this margin */
    sway =
        missing >= distance_to_middle ? sbri_add(sway, to_middle) : sbri_add_scaled(sway, inwards, missing);
    if (missing >= distance_to_middle) break;
  }
  float length = sbri_length(sway), max = MAX * size;
  return length > max ? sbri_scale(sway, max / length) : sway;
}
