/* Once a tick each point looks for the triangle of its own surface that it comes near to or goes through, and
 * gets a touch with it: a sample whose weights are 1 for the point and below 0 for the corners, so that its
 * place is the point's against the triangle, and a push on it acts on both sides alike and keeps momentum.
 *
 * Which side it belongs on: of a surface that encloses matter the outer one, up to inner_thickness deep (what
 * is deeper has come in by another face, which lets it out; seed of the method: Blender's soft bodies); of a
 * sheet the one that it is on. What is nearer at rest than the thickness is kept no further off than it was:
 * parts that overlap at rest do not fight. */
#include "collide/self_touch.h"

#include "collide/triangle.h"
#include "math/vec3.h"

/* Of the distance at rest, where that is less than the thickness. */
static const float REST_SHARE = 0.9f;
/* Nearer than this at rest, two parts are one. */
static const float TOGETHER_M = 1e-5f;

typedef struct looking {
  const sbri_island_tick *tick;
  const sbri_body *body;
  float outer, inner;
  bool two_sided; /* a sheet, or open */
} looking;

static sbf_vec3 at(const sbri_point *points, uint32_t slot) {
  return sbri_vec3(points[slot].x, points[slot].y, points[slot].z);
}

static sbf_vec3 way_of(const sbri_island_tick *t, uint32_t slot) {
  if (slot < t->island->free_count) return sbri_scale(sbri_slot_velocity(t, t->velocities, slot), t->tick_s);
  return sbri_sub(at(t->targets, slot), at(t->positions, slot));
}

static sbri_box swept(const sbri_island_tick *t, uint32_t slot, float by) {
  sbf_vec3 x = at(t->positions, slot);
  return sbri_box_grown(sbri_box_with(sbri_box_of_point(x), sbri_add(x, way_of(t, slot))), by);
}

static void make_boxes(const looking *l, sbri_box *boxes) {
  for (uint32_t f = 0; f < l->body->self_face_count; f++) {
    const uint32_t *c = l->body->self_faces + 3 * (size_t)f;
    boxes[f] = swept(l->tick, c[0], l->outer);
    for (int k = 1; k < 3; k++) boxes[f] = sbri_box_join(boxes[f], swept(l->tick, c[k], l->outer));
  }
}

/* What a point has to do with a triangle. */
typedef struct finding {
  const uint32_t *corners;
  float weights[3];
  sbf_vec3 normal;
  float urgency; /* the least counts: share of the tick until it goes through, or 1 and more for nearness */
} finding;

static sbf_vec3 mean_way(const sbri_island_tick *t, const uint32_t *c, const float w[3]) {
  sbf_vec3 sum = sbri_scale(way_of(t, c[0]), w[0]);
  return sbri_add_scaled(sbri_add_scaled(sum, way_of(t, c[1]), w[1]), way_of(t, c[2]), w[2]);
}

static bool look(const looking *l, uint32_t slot, const uint32_t *c, finding *best) {
  const sbri_island_tick *t = l->tick;
  sbf_vec3 x = at(t->positions, slot), p[3];
  for (int k = 0; k < 3; k++) p[k] = at(t->positions, c[k]);
  finding f = {.corners = c};
  sbri_triangle_nearest(x, p[0], p[1], p[2], f.weights);
  sbf_vec3 off = sbri_sub(x, sbri_triangle_place(f.weights, p[0], p[1], p[2]));
  sbf_vec3 face = sbri_normalize(sbri_cross(sbri_sub(p[1], p[0]), sbri_sub(p[2], p[0])), off);
  float distance = sbri_length(off), height = sbri_dot(off, face);
  bool behind = !l->two_sided && height < 0;
  if (behind && distance > l->inner) return false;
  sbf_vec3 way = sbri_sub(way_of(t, slot), mean_way(t, c, f.weights));
  sbf_vec3 side = l->two_sided && height < 0 ? sbri_scale(face, -1) : face;
  f.normal = behind || distance < 1e-6f ? face : sbri_scale(off, 1 / distance);
  if (behind) f.normal = sbri_scale(sbri_normalize(off, face), distance < 1e-6f ? 1 : -1);
  f.urgency = 1 + (behind ? 0 : distance);
  float closing = -sbri_dot(way, f.normal);
  bool near = behind || distance - (closing > 0 ? 2 * closing : 0) < l->outer;
  float through = behind ? -1 : sbri_triangle_cross(x, way, p[0], p[1], p[2]);
  if (through >= 0 && through < best->urgency) { /* by what it is then over */
    sbf_vec3 hit = sbri_add_scaled(x, way, through);
    sbri_triangle_nearest(hit, p[0], p[1], p[2], f.weights);
    f.normal = side, f.urgency = through;
  } else if (!near || f.urgency >= best->urgency) {
    return false;
  }
  *best = f;
  return true;
}

/* How far off it is at rest from that place; negative behind a surface that encloses matter. */
static float rest_gap(const looking *l, uint32_t slot, const finding *f) {
  const sbri_point *rest = l->tick->island->rest;
  sbf_vec3 p[3];
  for (int k = 0; k < 3; k++) p[k] = at(rest, f->corners[k]);
  float weights[3];
  sbri_triangle_nearest(at(rest, slot), p[0], p[1], p[2], weights);
  sbf_vec3 off = sbri_sub(at(rest, slot), sbri_triangle_place(weights, p[0], p[1], p[2]));
  sbf_vec3 face = sbri_cross(sbri_sub(p[1], p[0]), sbri_sub(p[2], p[0]));
  bool behind = !l->two_sided && sbri_dot(off, face) < 0 && sbri_length(off) < l->inner;
  return behind ? -1 : sbri_length(off);
}

static float relative_mass(const sbri_island *island, const sbri_sample *s) {
  float sum = 0;
  for (int k = 0; k < 4; k++)
    if (s->slots[k] < island->free_count)
      sum += s->weights[k] * s->weights[k] * island->inverse_masses[s->slots[k]];
  return sum > 0 ? 1 / sum : 0;
}

void sbri_self_touches_add(const sbri_island_tick *t, const sbri_body *body,
    const sbri_contact_tables *tables, sbri_bounds_tree *tree, sbri_box *boxes) {
  const sbf_collision *rule = &body->source->collision;
  looking l = {
      t, body, rule->outer_thickness, rule->inner_thickness, body->is_sheet || body->rest_volume_m3 == 0};
  uint32_t *count = &tables->touch_counts[body - t->model->bodies];
  make_boxes(&l, boxes);
  sbri_bounds_tree_make(tree, boxes, body->self_face_count);
  for (uint32_t slot = body->slot_begin; slot < body->slot_real_end; slot++) {
    sbri_bounds_walk walk;
    uint32_t item;
    finding best = {.urgency = INFINITY};
    sbri_box box = swept(t, slot, l.outer);
    sbri_bounds_walk_begin(&walk, tree, box);
    while (sbri_bounds_walk_next(&walk, &item)) {
      const uint32_t *c = body->self_faces + 3 * (size_t)item;
      if (c[0] == slot || c[1] == slot || c[2] == slot || !sbri_box_meets(&box, &boxes[item])) continue;
      (void)look(&l, slot, c, &best);
    }
    if (best.urgency == INFINITY || *count >= body->touch_capacity) continue;
    float rest = rest_gap(&l, slot, &best), thickness = l.outer;
    if (rest < TOGETHER_M) continue;
    if (REST_SHARE * rest < thickness) thickness = REST_SHARE * rest;
    sbri_sample s = {{slot, best.corners[0], best.corners[1], best.corners[2]},
        {1, -best.weights[0], -best.weights[1], -best.weights[2]}, 0, UINT32_MAX};
    s.mass_kg = relative_mass(t->island, &s);
    if (!(s.mass_kg > 0)) continue;
    tables->touches[body->first_touch + (*count)++] = (sbri_touch){.sample = s,
        .normal = best.normal,
        .offset = thickness,
        .friction_share = 1,
        .restitution = body->restitution,
        .collider = SBRI_ITSELF};
  }
}
