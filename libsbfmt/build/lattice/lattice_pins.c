#include "build/lattice/lattice_pins.h"

#include <math.h>
#include <string.h>

#include "build/geometry/line_width.h"
#include "build/geometry/topology.h"
#include "build/geometry/triangle_tree.h"
#include "build/lattice/lattice_core.h"
#include "build/lattice/lattice_piece_pins.h"
#include "build/sections/level_pins.h"

/* Fraction of the cell: distance within which a point is on the surface. */
static const double on_surface = 0.01;
/* Fraction of the cell: minimum extent of a core from any line through it. */
static const double core_width = 0.25;

/* Source points of a point on the surface, with weights. */
typedef struct footing {
  uint32_t corners[3]; /* the first is SBFI_NO_INDEX if it is not on the surface */
  double weights[3];
} footing;

typedef struct work {
  sbf_level *level;
  const sbf_soft_body *body;
  sbf_asset *asset;
  sbfi_arena *scratch;
  sbfi_triangle_tree surface;
  sbfi_box_tree points; /* of the level */
  double *depths2;      /* (level points) squared distances from the surface */
  footing *footings;    /* (level points) */
  uint8_t *taken;       /* (level points) belongs to some set */
} work;

static double squared_between(sbf_vec3 a, const double b[3]) {
  double x = a.x - b[0], y = a.y - b[1], z = a.z - b[2];
  return x * x + y * y + z * z;
}

static double min_width(const work *w) {
  return core_width * (double)w->level->cell;
}

static void load(sbf_vec3 from, double to[3]) {
  to[0] = from.x, to[1] = from.y, to[2] = from.z;
}

static double point_distance(const void *user, uint32_t point, const double at[3]) {
  return squared_between(((const work *)user)->level->positions.at[point], at);
}

static bool box_points(work *w) {
  const sbf_vec3_list *points = &w->level->positions;
  sbfi_box *boxes = sbfi_arena_allocate(w->scratch, points->count, sizeof *boxes);
  if (!boxes) return false;
  for (uint32_t i = 0; i < points->count; i++) {
    memcpy(boxes[i].low, &points->at[i], sizeof boxes[i].low);
    memcpy(boxes[i].high, &points->at[i], sizeof boxes[i].high);
  }
  return sbfi_box_tree_build(&w->points, boxes, points->count, w->scratch);
}

/* Finds the depth of every point, and source points of those on the surface. */
static bool find_depths(work *w) {
  const sbf_vec3_list *points = &w->level->positions;
  w->depths2 = sbfi_arena_allocate(w->scratch, points->count, sizeof *w->depths2);
  w->footings = sbfi_arena_allocate(w->scratch, points->count, sizeof *w->footings);
  w->taken = sbfi_arena_allocate(w->scratch, points->count, 1);
  if (!w->depths2 || !w->footings || !w->taken) return false;
  double near = on_surface * w->level->cell;
  for (uint32_t i = 0; i < points->count; i++) {
    double min = INFINITY, at[3], ends[3][3];
    uint32_t triangle = sbfi_triangle_tree_nearest(&w->surface, points->at[i], &min);
    footing *on = &w->footings[i];
    w->depths2[i] = min;
    on->corners[0] = SBFI_NO_INDEX;
    if (triangle == UINT32_MAX || min > near * near) continue;
    load(points->at[i], at);
    for (int k = 0; k < 3; k++) {
      on->corners[k] = w->surface.triangles[triangle].points[k];
      load(w->body->surface.positions.at[on->corners[k]], ends[k]);
    }
    sbfi_triangle_closest(ends[0], ends[1], ends[2], at, on->weights);
  }
  return true;
}

static sbf_vec3 source_point(const work *w, uint32_t point) {
  uint32_t surface = w->body->surface.positions.count;
  return point < surface ? w->body->surface.positions.at[point] : w->body->interior.at[point - surface];
}

static float weight_of(const sbf_pin_set *set, uint32_t i) {
  if (set->weights.count == 0) return 1;
  return set->weights.at[set->weights.count == 1 ? 0 : i];
}

/* Mean weight of a point whose source points are all in the set; else -1. */
static float weight_between(const footing *on, const float *at_source) {
  double sum = 0;
  if (on->corners[0] == SBFI_NO_INDEX) return -1;
  for (int k = 0; k < 3; k++) {
    if (!(on->weights[k] > 1e-3)) continue;
    if (at_source[on->corners[k]] < 0) return -1;
    sum += on->weights[k] * at_source[on->corners[k]];
  }
  return sum > 0.999 ? 1 : (float)sum;
}

/* Transfers the set to the level's points. */
static bool map_set(work *w, sbf_pin_set *to, const sbf_pin_set *from) {
  uint32_t sources = w->body->surface.positions.count + w->body->interior.count;
  uint32_t points = w->level->positions.count, count = 0;
  float *at_source = sbfi_arena_allocate(w->scratch, (size_t)sources + 1, sizeof *at_source);
  float *at_level = sbfi_arena_allocate(w->scratch, (size_t)points + 1, sizeof *at_level);
  if (!at_source || !at_level) return false;
  for (uint32_t i = 0; i < sources; i++) at_source[i] = -1;
  for (uint32_t i = 0; i < from->points.count; i++) at_source[from->points.at[i]] = weight_of(from, i);
  for (uint32_t i = 0; i < points; i++) at_level[i] = weight_between(&w->footings[i], at_source);
  for (uint32_t i = 0; i < from->points.count; i++) {
    double at[3], min = INFINITY;
    load(source_point(w, from->points.at[i]), at);
    uint32_t nearest = sbfi_box_tree_nearest(&w->points, at, point_distance, w, &min);
    if (nearest != UINT32_MAX) at_level[nearest] = fmaxf(at_level[nearest], weight_of(from, i));
  }
  for (uint32_t i = 0; i < points; i++) {
    if (w->taken[i]) at_level[i] = -1;
    count += at_level[i] >= 0;
  }
  uint32_t *list = sbf_asset_allocate(w->asset, (size_t)count + 1, sizeof *list);
  float *weights = sbf_asset_allocate(w->asset, (size_t)count + 1, sizeof *weights);
  if (!list || !weights) return false;
  count = 0;
  for (uint32_t i = 0; i < points; i++) {
    if (at_level[i] < 0) continue;
    w->taken[i] = 1;
    list[count] = i;
    weights[count++] = at_level[i];
  }
  *to = *from;
  to->points = (sbf_u32_list){count ? list : NULL, count};
  to->offsets = (sbf_vec3_list){NULL, 0};
  if (from->weights.count > 1) to->weights = (sbf_f32_list){count ? weights : NULL, count};
  return true;
}

/* Whether the points prevent rotation about any line through them. */
static bool is_wide(const work *w, const uint32_t *core, uint32_t count) {
  return count >= 3 && sbfi_farthest_line_of(w->level->positions.at, core, count).width >= min_width(w);
}

/* Core points: the inner half by depth, at any thickness; more of the volume if these are only on a line,
 * about which the body could rotate; and points on the surface if all interior points are pinned, or a piece
 * has none. */
static bool find_core(work *w, uint32_t **core, uint32_t *count) {
  uint32_t points = w->level->positions.count;
  float *thickness = sbfi_arena_allocate(w->scratch, (size_t)points + 1, sizeof *thickness);
  *core = sbfi_arena_allocate(w->scratch, (size_t)points + 1, sizeof **core);
  if (!*core || !thickness ||
      !sbfi_lattice_thickness(w->level->positions.at, w->depths2, points, on_surface * (double)w->level->cell,
          thickness, w->scratch))
    return false;
  for (int tenths = 5; tenths >= 1; tenths--) {
    *count = 0;
    for (uint32_t i = 0; i < points; i++) {
      double part = tenths / 10.0 * (double)thickness[i];
      if (part > 0 && w->depths2[i] >= part * part && !w->taken[i]) (*core)[(*count)++] = i;
    }
    if (is_wide(w, *core, *count)) break;
  }
  return sbfi_lattice_pin_pieces(w->level, w->depths2, w->taken, min_width(w), *core, count, w->scratch);
}

static bool map_attachment(work *w, sbf_pin_set *to, const sbf_attachment *from) {
  sbf_pin_set set;
  sbf_pin_set_init(&set);
  set.name = from->name;
  set.rigid_body = from->rigid_body;
  set.points = from->points;
  return map_set(w, to, &set);
}

static bool make(work *w, int32_t derivation) {
  const sbf_soft_body *body = w->body;
  size_t max = (size_t)body->pins.count + body->attachments.count + 1;
  sbf_pin_set *sets = sbf_asset_allocate(w->asset, max, sizeof *sets);
  sbf_attachment *by_hull = sbfi_arena_allocate(w->scratch, max, sizeof *by_hull);
  uint32_t count = 0, hull_count = 0, core_count = 0, *core = NULL;
  if (!sets || !by_hull) return false;
  for (uint32_t i = 0; i < body->pins.count; i++)
    if (!map_set(w, &sets[count++], &body->pins.at[i])) return false;
  for (uint32_t i = 0; i < body->attachments.count; i++) {
    const sbf_attachment *rule = &body->attachments.at[i];
    if (rule->rule != SBF_ATTACHMENT_RULE_EXPLICIT)
      by_hull[hull_count++] = *rule;
    else if (!map_attachment(w, &sets[count++], rule))
      return false;
  }
  for (uint32_t i = 0; i < count; i++) sets[i].derived = derivation;
  w->level->pins = (sbf_pin_set_list){count ? sets : NULL, count};
  if (body->bone != SBF_NONE && !find_core(w, &core, &core_count)) return false;
  /* The other attachments of the body need no source points. */
  sbf_soft_body rest = *body;
  rest.pins = (sbf_pin_set_list){NULL, 0};
  rest.attachments = (sbf_attachment_list){by_hull, hull_count};
  return sbfi_level_pins_make(w->level, &rest, derivation, w->asset, core, core_count, w->scratch);
}

bool sbfi_lattice_pins_map(sbf_level *level, const sbf_soft_body *body, uint8_t *taken, int32_t derivation,
    sbf_asset *asset, sbfi_arena *scratch) {
  work w = {.level = level, .body = body, .asset = asset, .scratch = scratch};
  sbf_pin_set *sets = sbf_asset_allocate(asset, (size_t)body->pins.count + 1, sizeof *sets);
  uint32_t count = 0;
  if (body->pins.count == 0) return true;
  if (!sets || !sbfi_triangle_tree_build(&w.surface, &body->surface, scratch) || !box_points(&w) ||
      !find_depths(&w))
    return false;
  for (uint32_t i = 0; i < body->pins.count; i++) {
    if (!map_set(&w, &sets[count], &body->pins.at[i])) return false;
    sets[count].derived = derivation;
    count += sets[count].points.count > 0;
  }
  memcpy(taken, w.taken, level->positions.count);
  level->pins = (sbf_pin_set_list){count ? sets : NULL, count};
  return true;
}

bool sbfi_lattice_pins_make(
    sbf_level *level, const sbf_soft_body *body, int32_t derivation, sbf_asset *asset, sbfi_arena *scratch) {
  work w = {.level = level, .body = body, .asset = asset, .scratch = scratch};
  if (body->bone == SBF_NONE && body->pins.count == 0 && body->attachments.count == 0) return true;
  return sbfi_triangle_tree_build(&w.surface, &body->surface, scratch) && box_points(&w) && find_depths(&w) &&
         make(&w, derivation);
}
