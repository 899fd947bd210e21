#include "walk_report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sbrun/animation.h"

enum { MAX_LEGS = 16, MAX_HULL = 512 };
static const double DEGREES = 57.29577951308232;
static const double FRAME_S = 1.0 / 60; /* changes are counted per frame of this length */
static const double STARTS_S = 1;       /* time after the start of a drive until the full speed is expected */
static const double SKATING_SPEED = 0.2; /* leg lengths per second, of a planted sole */

typedef struct point2 {
  double x, z;
} point2;

typedef struct leg_track {
  int32_t upper, lower, foot; /* bones; lower -1: a leg without a knee */
  double length;
  uint32_t group;
  bool seen, planted;
  double knee, knee_speed; /* deg, deg a second */
  int knee_samples;
  point2 sole; /* centre of the sole in the previous frame */
  double up_s;
  /* Of whole cycles, from one touchdown to the next. */
  double last_down_s, last_down_x, last_down_z;
  uint32_t cycles;
  double stride_sum, period_sum, period_square_sum, air_sum;
} leg_track;

/* Motion of the hips, or the body without them. */
typedef struct body_track {
  int32_t bone;
  int samples;
  double position[3], velocity[3], angular_velocity[3]; /* of the previous frames */
  sbf_quat rotation;
  double max_speed_step, max_turn_step;
} body_track;

struct walk_report {
  const soles *soles;
  leg_track legs[MAX_LEGS];
  uint32_t leg_count, frames, planted_frames, skating_frames, opposite_frames;
  body_track body;
  double leg_length;
  double knee_step, limit_excess, support_margin;
  bool has_margin;
  double driven_m, gone_m, distance_m; /* after the start-up time; distance in the previous frame */
  point2 *points;                      /* (MAX_HULL) */
  sbr_transform *bones;
};

static double angle_between(sbf_vec3 a, sbf_vec3 b) {
  double x = (double)a.y * b.z - (double)a.z * b.y, y = (double)a.z * b.x - (double)a.x * b.z;
  double z = (double)a.x * b.y - (double)a.y * b.x;
  double along = (double)a.x * b.x + (double)a.y * b.y + (double)a.z * b.z;
  return DEGREES * atan2(sqrt(x * x + y * y + z * z), along);
}

static sbf_vec3 away(const sbr_transform *from, const sbr_transform *to) {
  return (sbf_vec3){to->position.x - from->position.x, to->position.y - from->position.y,
      to->position.z - from->position.z};
}

static double rest_length(const sbf_asset *asset, int32_t a, int32_t b) {
  sbf_vec3 p = asset->bones.at[a].head, q = asset->bones.at[b].head;
  return hypot(hypot((double)(p.x - q.x), (double)(p.y - q.y)), (double)(p.z - q.z));
}

walk_report *walk_report_create(const session *s, const soles *feet) {
  const sbf_asset *asset = s->asset;
  if (asset->gaits.count == 0 || !feet) return NULL;
  const sbf_gait *gait = &asset->gaits.at[0];
  walk_report *r = calloc(1, sizeof *r);
  if (!r) return NULL;
  r->soles = feet;
  r->body.bone = gait->hips >= 0 ? gait->hips : gait->body;
  r->points = malloc(MAX_HULL * sizeof *r->points);
  r->bones = malloc((asset->bones.count + 1u) * sizeof *r->bones);
  for (uint32_t l = 0; l < gait->legs.count && l < MAX_LEGS; l++) {
    leg_track *leg = &r->legs[r->leg_count++];
    leg->foot = asset->ik_chains.at[gait->legs.at[l].ik].end;
    leg->lower = asset->bones.at[leg->foot].parent;
    leg->upper = leg->lower >= 0 ? asset->bones.at[leg->lower].parent : -1;
    int32_t root = asset->ik_chains.at[gait->legs.at[l].ik].root;
    if (leg->upper >= 0 && leg->upper != root && asset->bones.at[leg->upper].parent == root)
      leg->foot = leg->lower, leg->lower = leg->upper, leg->upper = root; /* it ends in a toe */
    leg->group = gait->legs.at[l].group;
    if (leg->lower >= 0) leg->length = rest_length(asset, leg->foot, leg->lower);
    if (leg->lower < 0 || leg->upper < 0 || root != leg->upper)
      leg->lower = -1;
    else
      leg->length += rest_length(asset, leg->lower, leg->upper);
    r->leg_length += leg->length / fmin(gait->legs.count, MAX_LEGS);
  }
  if (r->points && r->bones) return r;
  walk_report_destroy(r);
  return NULL;
}

void walk_report_destroy(walk_report *r) {
  if (!r) return;
  free(r->points);
  free(r->bones);
  free(r);
}

/* ---- Balance ---- */

static int compare_points(const void *a, const void *b) {
  const point2 *p = a, *q = b;
  return p->x != q->x ? (p->x < q->x ? -1 : 1) : p->z < q->z ? -1 : p->z > q->z;
}

static double turn(point2 a, point2 b, point2 c) {
  return (b.x - a.x) * (c.z - a.z) - (b.z - a.z) * (c.x - a.x);
}

/* Distance of a point from a segment. */
static double from_segment(point2 p, point2 a, point2 b) {
  double dx = b.x - a.x, dz = b.z - a.z, square = dx * dx + dz * dz;
  double t = square > 0 ? ((p.x - a.x) * dx + (p.z - a.z) * dz) / square : 0;
  t = t < 0 ? 0 : t > 1 ? 1 : t;
  return hypot(p.x - a.x - t * dx, p.z - a.z - t * dz);
}

/* Distance of a point from the edge of the convex hull of others, positive inside (Andrew 1979). */
static double hull_margin(point2 *points, int count, point2 p) {
  point2 hull[2 * MAX_HULL];
  int n = 0;
  qsort(points, (size_t)count, sizeof *points, compare_points);
  for (int i = 0; i < count; i++) {
    while (n >= 2 && turn(hull[n - 2], hull[n - 1], points[i]) <= 0) n--;
    hull[n++] = points[i];
  }
  for (int i = count - 2, min = n + 1; i >= 0; i--) {
    while (n >= min && turn(hull[n - 2], hull[n - 1], points[i]) <= 0) n--;
    hull[n++] = points[i];
  }
  double nearest = INFINITY;
  bool inside = n > 3;
  for (int i = 0; i + 1 < n; i++) {
    nearest = fmin(nearest, from_segment(p, hull[i], hull[i + 1]));
    inside = inside && turn(hull[i], hull[i + 1], p) >= 0;
  }
  if (n < 2) nearest = hypot(p.x - hull[0].x, p.z - hull[0].z);
  return inside ? nearest : -nearest;
}

static void measure_balance(
    walk_report *r, const session *s, const sbr_leg_state *legs, const sbf_vec3 *skin) {
  sbf_vec3 center;
  int count = 0;
  if (!sbr_character_get_center_of_mass(s->world, s->character, &center)) return;
  for (uint32_t l = 0; l < r->leg_count; l++) {
    const uint32_t *vertices;
    uint32_t n = soles_vertices(r->soles, l, &vertices), max = MAX_HULL / r->leg_count;
    if (!legs[l].planted) continue;
    if (n == 0 && count < MAX_HULL)
      r->points[count++] = (point2){(double)legs[l].foot.x, (double)legs[l].foot.z};
    for (uint32_t i = 0; i < n && i < max; i++) {
      sbf_vec3 p = skin[vertices[(size_t)i * n / (n < max ? n : max)]];
      r->points[count++] = (point2){(double)p.x, (double)p.z};
    }
  }
  if (count == 0) return;
  double margin = hull_margin(r->points, count, (point2){(double)center.x, (double)center.z});
  r->support_margin = r->has_margin ? fmin(r->support_margin, margin) : margin;
  r->has_margin = true;
}

/* ---- Feet ---- */

static void measure_leg(walk_report *r, const session *s, uint32_t l, const sbr_leg_state *state,
    const sbf_vec3 *skin, double dt) {
  leg_track *leg = &r->legs[l];
  sbr_double3 origin = sbr_character_get_origin(s->world, s->character);
  if (leg->lower >= 0) {
    double knee = angle_between(away(&r->bones[leg->upper], &r->bones[leg->lower]),
        away(&r->bones[leg->lower], &r->bones[leg->foot]));
    if (leg->knee_samples > 0 && dt > 0) {
      double speed = (knee - leg->knee) / dt;
      if (leg->knee_samples > 1) r->knee_step = fmax(r->knee_step, fabs(speed - leg->knee_speed) * FRAME_S);
      leg->knee_speed = speed;
    }
    leg->knee = knee;
    leg->knee_samples++;
  }
  const uint32_t *vertices;
  uint32_t n = soles_firm_vertices(r->soles, l, &vertices);
  point2 sole = {0, 0};
  for (uint32_t i = 0; i < n; i++) {
    sole.x += (origin.x + (double)skin[vertices[i]].x) / n;
    sole.z += (origin.z + (double)skin[vertices[i]].z) / n;
  }
  if (leg->seen && leg->planted && state->planted && n && dt > 0) {
    r->planted_frames++;
    double speed = hypot(sole.x - leg->sole.x, sole.z - leg->sole.z) / dt;
    r->skating_frames += speed > SKATING_SPEED * r->leg_length;
  }
  leg->sole = sole;
  if (leg->seen && leg->planted && !state->planted) leg->up_s = s->time_s;
  if (leg->seen && !leg->planted && state->planted) {
    double x = origin.x + (double)state->foot.x, z = origin.z + (double)state->foot.z;
    if (leg->last_down_s > 0) {
      double period = s->time_s - leg->last_down_s;
      leg->cycles++;
      leg->stride_sum += hypot(x - leg->last_down_x, z - leg->last_down_z);
      leg->period_sum += period;
      leg->period_square_sum += period * period;
      leg->air_sum += s->time_s - leg->up_s;
    }
    leg->last_down_s = s->time_s;
    leg->last_down_x = x;
    leg->last_down_z = z;
  }
  leg->planted = state->planted;
  leg->seen = true;
}

/* ---- Body ---- */

static double length3(const double v[3]) {
  return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* Rotation vector from a to b over dt, degrees per second. */
static void angular_velocity(sbf_quat a, sbf_quat b, double dt, double rate[3]) {
  double w = (double)a.w * b.w + (double)a.x * b.x + (double)a.y * b.y + (double)a.z * b.z;
  double v[3] = {(double)a.w * b.x - (double)b.w * a.x - (double)b.y * a.z + (double)b.z * a.y,
      (double)a.w * b.y - (double)b.w * a.y - (double)b.z * a.x + (double)b.x * a.z,
      (double)a.w * b.z - (double)b.w * a.z - (double)b.x * a.y + (double)b.y * a.x};
  double sine = length3(v), angle = 2 * atan2(sine, fabs(w)), fraction = sine > 1e-9 ? angle / sine : 2;
  for (int i = 0; i < 3; i++) rate[i] = DEGREES * v[i] * fraction * (w < 0 ? -1 : 1) / dt;
}

static void measure_body(walk_report *r, const session *s, double dt) {
  sbr_double3 origin = sbr_character_get_origin(s->world, s->character);
  const sbr_transform *b = &r->bones[r->body.bone];
  double at[3] = {
      origin.x + (double)b->position.x, origin.y + (double)b->position.y, origin.z + (double)b->position.z};
  if (r->body.samples > 0 && dt > 0) {
    double speed[3], turned[3], change[3], turn_change[3];
    angular_velocity(r->body.rotation, b->rotation, dt, turned);
    for (int i = 0; i < 3; i++) {
      speed[i] = (at[i] - r->body.position[i]) / dt;
      change[i] = (speed[i] - r->body.velocity[i]) * FRAME_S * fmin(1, FRAME_S / dt);
      turn_change[i] = (turned[i] - r->body.angular_velocity[i]) * FRAME_S * fmin(1, FRAME_S / dt);
    }
    if (r->body.samples > 1) {
      r->body.max_speed_step = fmax(r->body.max_speed_step, length3(change));
      r->body.max_turn_step = fmax(r->body.max_turn_step, length3(turn_change));
    }
    memcpy(r->body.velocity, speed, sizeof speed);
    memcpy(r->body.angular_velocity, turned, sizeof turned);
  }
  memcpy(r->body.position, at, sizeof at);
  r->body.rotation = b->rotation;
  r->body.samples++;
}

static void measure_drive(walk_report *r, const session *s, double dt) {
  double distance = sbr_character_get_distance(s->world, s->character);
  if (s->script.speed > 0 && s->time_s - s->script.since_s > STARTS_S) {
    r->driven_m += s->script.speed * dt;
    r->gone_m += distance - r->distance_m;
  }
  r->distance_m = distance;
}

void walk_report_measure(walk_report *r, const session *s, const sbf_vec3 *skin) {
  sbr_leg_state legs[MAX_LEGS];
  memset(legs, 0, sizeof legs);
  sbr_character_get_legs(s->world, s->character, legs, MAX_LEGS);
  sbr_character_get_bones(s->world, s->character, r->bones, s->asset->bones.count);
  double dt = s->frame_s;
  uint32_t in_air = 0;
  for (uint32_t l = 0; l < r->leg_count; l++) {
    measure_leg(r, s, l, &legs[l], skin, dt);
    if (!legs[l].planted) in_air |= 1u << (r->legs[l].group & 31);
  }
  r->opposite_frames += (in_air & (in_air - 1)) != 0;
  r->limit_excess = fmax(r->limit_excess, (double)sbr_character_get_limit_violation(s->world, s->character));
  measure_balance(r, s, legs, skin);
  measure_body(r, s, dt);
  measure_drive(r, s, dt);
  r->frames++;
}

/* ---- Report ---- */

static json_t *rhythm_of(const walk_report *r, const session *s) {
  const sbf_gait *gait = &s->asset->gaits.at[0];
  json_t *all = json_object();
  const leg_track *first = &r->legs[0];
  for (uint32_t l = 0; l < r->leg_count; l++) {
    const leg_track *leg = &r->legs[l];
    if (leg->cycles == 0) continue;
    double n = leg->cycles, period = leg->period_sum / n;
    double spread = leg->period_square_sum / n - period * period, phase = 0;
    if (first->cycles && period > 0) {
      phase = (leg->last_down_s - first->last_down_s) / period;
      phase -= floor(phase);
    }
    json_t *one = json_object();
    json_object_set_new(one, "stride", json_real(leg->stride_sum / n));
    json_object_set_new(one, "period", json_real(period));
    json_object_set_new(one, "period_jitter", json_real(period > 0 ? sqrt(fmax(0, spread)) / period : 0));
    json_object_set_new(one, "duty", json_real(1 - leg->air_sum / leg->period_sum));
    json_object_set_new(one, "phase", json_real(phase));
    json_object_set_new(all, gait->legs.at[l].name, one);
  }
  return all;
}

void walk_report_add(const walk_report *r, const session *s, json_t *o) {
  json_object_set_new(o, "leg_length", json_real(r->leg_length));
  json_object_set_new(o, "rhythm", rhythm_of(r, s));
  json_object_set_new(
      o, "skate_ratio", json_real(r->planted_frames ? (double)r->skating_frames / r->planted_frames : 0));
  json_object_set_new(o, "knee_speed_step", json_real(r->knee_step));
  json_object_set_new(o, "opposite_feet_in_air", json_integer(r->opposite_frames));
  if (r->has_margin) json_object_set_new(o, "support_margin", json_real(r->support_margin));
  if (r->driven_m > 0) json_object_set_new(o, "drive_kept", json_real(r->gone_m / r->driven_m));
  json_object_set_new(o, "limit_excess", json_real(r->limit_excess * DEGREES));
  json_object_set_new(o, "body_speed_step", json_real(r->body.max_speed_step));
  json_object_set_new(o, "body_turn_step", json_real(r->body.max_turn_step));
}
