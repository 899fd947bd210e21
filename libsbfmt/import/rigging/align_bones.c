/* Aligns an input with a rig without a similar mesh, so that the bones are inside.
 *
 * The stated transform stays if most of the bones' length is inside. Otherwise tries axes, usual units and
 * offsets, simplest first, and finally the scale that makes both equally large. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "build/geometry/winding_number.h"
#include "import/rigging/align.h"
#include "import/rigging/align_limbs.h"
#include "import/rigging/bone_lines.h"
#include "import/rigging/moved_bones.h"
#include "import/rigging/surface_finder.h"

enum {
  PER_BONE = 6,
  NAMED = 4,
  SURFACE_SAMPLES = 1000,
  SCORE_SAMPLES = 256,
  SEVERAL = 10,
  ROTATIONS = SBFI_AXIS_ROTATIONS / 2,
  MAX_CANDIDATES = 1 + ROTATIONS * (SBFI_USUAL_UNITS + 3)
};

/* fraction inside; below it the input may be in another pose than the rig */
static const double CERTAIN = 0.85;
static const double GOOD = 0.95; /* fraction of the length inside that needs no further search */

/* For rotated limbs: minimum fraction of the bones inside, maximum fraction of the input without bones,
 * maximum ratio of the cost to that without rotations. Radius of a body around its bones as a fraction of
 * its longest side. */
static const double MIN_ROTATED = 0.85, MAX_UNCOVERED = 0.35, BETTER_ROTATED = 0.85, THICK = 0.15;
static const double SAME_SCALE = 1e-6; /* relative */
static const double BETTER = 0.02;     /* minimum improvement by a later candidate */
static const double NEARNESS = 2;      /* weight of a mean distance against the fraction inside */
/* minimum extent of the bones as a fraction of the body's longest side, for the stated transform */
static const double MIN_LONG = 0.6;
static const double KEPT = 0.85;  /* fraction inside from which the stated transform is not a coincidence */
static const double ODD = 0.15;   /* minimum improvement by an unusual scale or offset with the same axes */
static const double MOVED = 0.05; /* minimum improvement by an offset that was searched for */
static const double POSED = 0.1;  /* minimum improvement by a rarer rotation if limbs are posed differently */
static const double REACH = 0.3;  /* maximum deficit of a candidate before its scale and offset are refined */

typedef struct candidate {
  sbfi_matrix m;
  double fraction, score; /* fraction inside; the same minus a penalty for the distance from the surface */
} candidate;

typedef struct search {
  const sbfi_rigging *r;
  sbfi_soup soup;
  sbfi_winding winding; /* of the input in its own space */
  sbfi_bone_lines lines;
  uint32_t rotation; /* current rotation */
  candidate of_rotation[ROTATIONS];
  candidate best;
} search;

static double longest_side(sbfi_d3 low, sbfi_d3 high) {
  sbfi_d3 sides = sbfi_d3_sub(high, low);
  return fmax(sides.x, fmax(sides.y, sides.z));
}

static bool is_inside(const search *s, sbfi_d3 p) {
  if (p.x < s->soup.low.x || p.y < s->soup.low.y || p.z < s->soup.low.z || p.x > s->soup.high.x ||
      p.y > s->soup.high.y || p.z > s->soup.high.z)
    return false;
  return sbfi_winding_inside(sbfi_winding_of_closed(&s->winding, p), sbfi_winding_of_caps(&s->winding, p));
}

static sbfi_d3 along(const sbfi_bone_line *line, uint32_t sample) {
  double t = (sample + 0.5) / PER_BONE;
  return sbfi_d3_add(sbfi_d3_scale(line->from, 1 - t), sbfi_d3_scale(line->to, t));
}

static double inside_of_line(const search *s, const sbfi_matrix *back, const sbfi_bone_line *line) {
  uint32_t inside = 0;
  for (uint32_t k = 0; k < PER_BONE; k++) inside += is_inside(s, sbfi_similarity_apply(back, along(line, k)));
  return (double)inside / PER_BONE;
}

/* Stops once the fraction cannot reach `min`. */
static double inside_fraction(const search *s, const sbfi_matrix *m, double min) {
  sbfi_matrix back;
  double sum = 0, left = s->lines.total;
  if (!sbfi_matrix_invert(m, &back)) return 0;
  for (uint32_t i = 0; i < s->lines.count; i++) {
    if (sum + left < min * s->lines.total) return 0;
    sum += s->lines.at[i].length * inside_of_line(s, &back, &s->lines.at[i]);
    left -= s->lines.at[i].length;
  }
  return s->lines.total > 0 ? sum / s->lines.total : 1;
}

static double squared_distance(const sbfi_bone_line *line, sbfi_d3 p) {
  sbfi_d3 along = sbfi_d3_sub(line->to, line->from), displacement = sbfi_d3_sub(p, line->from);
  double t = sbfi_d3_dot(displacement, along) / sbfi_d3_dot(along, along);
  displacement = sbfi_d3_sub(displacement, sbfi_d3_scale(along, t > 0 ? t < 1 ? t : 1 : 0));
  return sbfi_d3_dot(displacement, displacement);
}

/* Distance to the nearest bone, m. */
static double distance_to_nearest(const search *s, sbfi_d3 p) {
  double nearest = INFINITY;
  for (uint32_t k = 0; k < s->lines.count; k++) {
    double squared = squared_distance(&s->lines.at[k], p);
    if (squared < nearest) nearest = squared;
  }
  return sqrt(nearest);
}

/* The fraction of bones inside, less the mean distance of the input's points to the nearest bone as a
 * fraction of its longest side. The distance distinguishes the front of a body from its back, and a full
 * skeleton from a small one inside the belly. Stops once the score is below `min`. */
static double score_of(const search *s, const sbfi_matrix *m, double fraction, double min) {
  const sbf_vec3_list points = s->r->input.mesh.positions;
  double sum = 0, score = fraction, size = longest_side(s->soup.low, s->soup.high) * sbfi_similarity_scale(m);
  uint32_t samples = points.count < SCORE_SAMPLES ? points.count : SCORE_SAMPLES;
  for (uint32_t i = 0; i < samples && score >= min; i++) {
    uint32_t at = (uint32_t)((double)points.count * fmod(0.5 + i * 0.6180339887498949, 1.0));
    sbfi_d3 p = sbfi_similarity_apply(m, sbfi_d3_of(points.at[at]));
    sum += fmin(distance_to_nearest(s, p) / size, 1);
    score = fraction - NEARNESS * (sum / samples);
  }
  return score;
}

/* May return any lower value for a score below `min`. */
static candidate evaluate(const search *s, const sbfi_matrix *m, double min) {
  candidate c = {*m, 0, -INFINITY};
  if (!sbfi_alignment_allowed(s->r, m)) return c;
  c.fraction = inside_fraction(s, m, min);
  if (c.fraction >= min) c.score = score_of(s, m, c.fraction, min);
  return c;
}

static void consider(search *s, const sbfi_matrix *m) {
  candidate *best = &s->of_rotation[s->rotation], here = evaluate(s, m, best->score + BETTER);
  if (here.score >= best->score + BETTER) *best = here;
}

/* --- Candidates ---------------------------------------------------------------------------------------- */

/* Tries no offset, equal centres, and the input standing on the lowest bone, which is an ankle's height
 * above the sole. */
static void consider_offsets(search *s, const sbfi_matrix *axes, double scale) {
  sbfi_matrix m = sbfi_similarity_scaled(axes, scale, (sbfi_d3){0, 0, 0});
  sbfi_d3 bones = sbfi_d3_scale(sbfi_d3_add(s->lines.low, s->lines.high), 0.5);
  sbfi_d3 input = sbfi_similarity_apply(&m, sbfi_d3_scale(sbfi_d3_add(s->soup.low, s->soup.high), 0.5));
  sbfi_d3 a = sbfi_similarity_apply(&m, s->soup.low), b = sbfi_similarity_apply(&m, s->soup.high);
  double height = fabs(b.y - a.y);
  consider(s, &m);
  sbfi_d3 offset = sbfi_d3_sub(bones, input);
  m = sbfi_similarity_scaled(axes, scale, offset);
  consider(s, &m);
  offset.y = s->lines.low.y - 0.05 * height - fmin(a.y, b.y);
  m = sbfi_similarity_scaled(axes, scale, offset);
  consider(s, &m);
}

static void consider_scale(search *s, double scale) {
  for (s->rotation = 0; s->rotation < ROTATIONS; s->rotation++) {
    sbfi_matrix axes = sbfi_axis_rotation(s->rotation);
    consider_offsets(s, &axes, scale);
  }
}

/* Searches scales and offsets up and forwards around a candidate, in decreasing steps. */
static candidate refined(const search *s, candidate from) {
  double size = longest_side(s->lines.low, s->lines.high);
  sbfi_d3 middle = sbfi_d3_scale(sbfi_d3_add(s->lines.low, s->lines.high), 0.5);
  for (double step = 0.08; step > 0.01; step *= 0.5)
    for (int k = 0; k < 6; k++) {
      double sign = k % 2 ? -1 : 1, factor = k < 2 ? 1 + sign * step : 1, aside = 0.5 * sign * step * size;
      sbfi_d3 at = {from.m.at[0][3], from.m.at[1][3], from.m.at[2][3]};
      at = sbfi_d3_add(middle, sbfi_d3_scale(sbfi_d3_sub(at, middle), factor));
      at = sbfi_d3_add(at, (sbfi_d3){0, k / 2 == 1 ? aside : 0, k / 2 == 2 ? aside : 0});
      sbfi_matrix m = sbfi_similarity_scaled(&from.m, sbfi_similarity_scale(&from.m) * factor, at);
      candidate here = evaluate(s, &m, from.score);
      if (here.score > from.score) from = here;
    }
  return from;
}

/* Steps of a descent, as fractions of the bones' size; maximum number of rounds of a step, and of rotations
 * whose offset is searched for. */
static const double FIRST_STEP = 0.16, LAST_STEP = 0.005;
enum { MAX_ROUNDS = 6, MAX_SEARCHED = 3 };
/* Limits of the ratio of the input's length to that of its bones. */
static const double MIN_RATIO = 0.7, MAX_RATIO = 1.6;
static const double NEAR_SCALE = 0.3; /* relative difference of a usual scale from the best one */

/* Moved along an axis (0 to 2), or scaled about the bones' middle (3), by a fraction of the bones' size. */
static sbfi_matrix stepped(const search *s, const sbfi_matrix *m, int axis, double step) {
  double size = longest_side(s->lines.low, s->lines.high), at[3] = {m->at[0][3], m->at[1][3], m->at[2][3]};
  const sbfi_d3 middle = sbfi_d3_scale(sbfi_d3_add(s->lines.low, s->lines.high), 0.5);
  const double fixed[3] = {middle.x, middle.y, middle.z};
  double factor = axis == 3 ? 1 + step : 1;
  for (int k = 0; k < 3; k++) at[k] = fixed[k] + factor * (at[k] - fixed[k]) + (k == axis) * step * size;
  return sbfi_similarity_scaled(m, sbfi_similarity_scale(m) * factor, (sbfi_d3){at[0], at[1], at[2]});
}

/* Improves the offset of a candidate, and its scale if that is free, in decreasing steps. */
static candidate descended(const search *s, candidate from, bool is_scale_free) {
  double bones = longest_side(s->lines.low, s->lines.high), input = longest_side(s->soup.low, s->soup.high);
  for (double step = FIRST_STEP; step > LAST_STEP; step *= 0.5)
    for (int round = 0; round < MAX_ROUNDS; round++) {
      double before = from.score;
      for (int k = 0; k < (is_scale_free ? 8 : 6); k++) {
        sbfi_matrix m = stepped(s, &from.m, k / 2, k % 2 ? -step : step);
        double ratio = input * sbfi_similarity_scale(&m) / bones;
        if (k >= 6 && (ratio < MIN_RATIO || ratio > MAX_RATIO)) continue;
        candidate here = evaluate(s, &m, from.score);
        if (here.score > from.score) from = here;
      }
      if (from.score <= before) break;
    }
  return from;
}

/* Best alignment of a rotation at a usual scale and any offset. Each scale starts where both have their
 * middles, and where an unusual scale fits best. */
static candidate best_offset(const search *s, const candidate *plain) {
  double bones = longest_side(s->lines.low, s->lines.high), input = longest_side(s->soup.low, s->soup.high);
  const sbfi_d3 middle = sbfi_d3_scale(sbfi_d3_add(s->lines.low, s->lines.high), 0.5);
  const sbfi_d3 center = sbfi_d3_scale(sbfi_d3_add(s->soup.low, s->soup.high), 0.5);
  candidate best = {.score = -INFINITY}, unusual = descended(s, *plain, true);
  double found = sbfi_similarity_scale(&unusual.m);
  for (uint32_t unit = 0; unit <= SBFI_USUAL_UNITS; unit++) {
    double scale = unit ? sbfi_usual_units[unit - 1].unit_m : sbfi_similarity_scale(&s->r->c->to_asset);
    if (input * scale < MIN_RATIO * bones || input * scale > MAX_RATIO * bones) continue;
    sbfi_matrix m = sbfi_similarity_scaled(&plain->m, scale, (sbfi_d3){0, 0, 0});
    m = sbfi_similarity_scaled(&m, scale, sbfi_d3_sub(middle, sbfi_similarity_apply(&m, center)));
    candidate here = descended(s, evaluate(s, &m, -INFINITY), false);
    if (here.score > best.score) best = here;
    if (fabs(scale / found - 1) > NEAR_SCALE) continue;
    m = stepped(s, &unusual.m, 3, scale / found - 1);
    here = descended(s, evaluate(s, &m, -INFINITY), false);
    if (here.score > best.score) best = here;
  }
  return best;
}

/* Rotations by how rarely files need them. `min_better` is the minimum improvement over more common ones;
 * `cost` is added where limbs are rotated too, in RARER. */
enum { UPRIGHT, Z_UP_RIG, BACKWARDS, SIDEWAYS, OWN_AXES, OTHERS, RARITIES };
static const struct {
  double min_better, cost;
} RARE[RARITIES] = {{0.02, 0}, {0.03, 1}, {0.03, 1}, {0.05, 2}, {0.2, 3}, {0.2, 3}};

/* Motion capture from Blender has +Z up or the axes of its armature; left stays left. */
static uint32_t rarity_of(const search *s, const sbfi_matrix *m) {
  double max = 0.9 * sbfi_similarity_scale(m);
  bool may_lie = sbfi_rig_has_no_size(s->r) && !s->r->rig.scene->axes_known;
  if (m->at[1][1] < max && m->at[1][2] < max) {
    if (!may_lie || m->at[0][0] < max) return OTHERS;
    return m->at[2][1] > max ? Z_UP_RIG : OWN_AXES;
  }
  return m->at[0][0] > max ? UPRIGHT : m->at[0][0] < -max ? BACKWARDS : SIDEWAYS;
}

static bool is_usual_scale(const search *s, const sbfi_matrix *m) {
  double scale = sbfi_similarity_scale(m);
  for (uint32_t i = 0; i < SBFI_USUAL_UNITS; i++)
    if (fabs(scale / sbfi_usual_units[i].unit_m - 1) < SAME_SCALE) return true;
  return fabs(scale / sbfi_similarity_scale(&s->r->c->to_asset) - 1) < SAME_SCALE;
}

/* Whether an alignment has a usual scale and no offset. */
static bool is_plain(const search *s, const sbfi_matrix *m) {
  return m->at[0][3] == 0 && m->at[1][3] == 0 && m->at[2][3] == 0 && is_usual_scale(s, m);
}

/* Whether the best of the coarse candidates has a usual scale and no offset, and most bones inside. */
static bool fits_plainly(const search *s) {
  const candidate *best = &s->of_rotation[0];
  for (uint32_t i = 1; i < ROTATIONS; i++)
    if (s->of_rotation[i].score > best->score) best = &s->of_rotation[i];
  return best->fraction >= CERTAIN && is_plain(s, &best->m);
}

/* Number of rotations whose coarse candidate is better. */
static uint32_t count_better(const search *s, const candidate *plain) {
  uint32_t count = 0;
  for (uint32_t i = 0; i < ROTATIONS; i++) count += s->of_rotation[i].score > plain->score;
  return count;
}

/* Selects the best of all rotations, each with its best scale and offset. A more common rotation stays
 * unless another is clearly better, as around straight chains of bones; the same holds for a usual unit
 * and offset. */
static void choose(search *s) {
  double max = s->best.score;
  const bool fits = sbfi_rig_has_no_size(s->r) || fits_plainly(s);
  for (uint32_t i = 0; i < RARITIES * ROTATIONS; i++) {
    const candidate *plain = &s->of_rotation[i % ROTATIONS];
    uint32_t rarity = i / ROTATIONS;
    if (!(plain->score > max - REACH) || rarity_of(s, &plain->m) != rarity) continue;
    candidate better = refined(s, *plain);
    if (better.fraction < GOOD) better = *plain;
    candidate moved = fits || count_better(s, plain) >= MAX_SEARCHED ? better : best_offset(s, plain);
    if (moved.score >= better.score + (is_plain(s, &better.m) ? ODD : MOVED)) better = moved;
    if (better.score < max + RARE[rarity].min_better + (rarity && better.fraction < GOOD ? POSED : 0))
      continue;
    max = better.score;
    s->best = better.score >= plain->score + BETTER ? better : *plain;
  }
}

/* Whether a candidate has the stated axes but another scale or offset. */
static bool has_stated_axes(const search *s, const sbfi_matrix *m) {
  const sbfi_matrix *stated = &s->r->c->to_asset;
  double scale = sbfi_similarity_scale(m) / sbfi_similarity_scale(stated);
  for (int row = 0; row < 3; row++)
    for (int k = 0; k < 3; k++)
      if (fabs(m->at[row][k] - scale * stated->at[row][k]) > 1e-6 * sbfi_similarity_scale(m)) return false;
  return true;
}

/* Returns whether the stated transform stays. */
static bool consider_all(search *s) {
  const candidate stated = s->best;
  double bones = longest_side(s->lines.low, s->lines.high), input = longest_side(s->soup.low, s->soup.high);
  double stated_scale = sbfi_similarity_scale(&s->r->c->to_asset);
  /* A small rig fits inside anything. A rig of few bones may leave large parts of its body without bones. */
  double max = s->lines.count < SEVERAL && !sbfi_rig_has_no_size(s->r) ? 3 : 1.6;
  for (uint32_t unit = 0; unit <= SBFI_USUAL_UNITS; unit++) {
    double scale = unit ? sbfi_usual_units[unit - 1].unit_m : stated_scale;
    if (input * scale < 0.7 * bones || input * scale > (unit ? max : 3) * bones) continue;
    consider_scale(s, scale);
  }
  /* Ratio of the input's length to that of its bones. */
  static const double ratios[] = {1.12, 1.3, 1, 1.06, 1.2, 1.45, 1.7, 2};
  size_t count = sizeof ratios / sizeof *ratios - (s->lines.count < SEVERAL ? 0 : 2);
  for (size_t k = 0; k < count; k++) consider_scale(s, ratios[k] * bones / input);
  choose(s);
  if (stated.fraction < KEPT || sbfi_rig_has_no_size(s->r) || !has_stated_axes(s, &s->best.m) ||
      s->best.score >= stated.score + ODD)
    return false;
  s->best = stated;
  return true;
}

/* --- Where they do not fit ----------------------------------------------------------------------------- */

typedef struct outside_bone {
  uint32_t bone;
  double distance; /* m, of its farthest sample */
} outside_bone;

/* Lists the bones that are farthest outside. */
static bool describe_outside(const search *s, char *text, size_t size, sbfi_arena *arena) {
  sbfi_scene_surface moved;
  sbfi_surface_finder finder;
  sbfi_matrix back;
  outside_bone worst[NAMED] = {{0}};
  uint32_t count = 0;
  if (!sbfi_surface_move(&moved, &s->r->input, &s->best.m, arena) ||
      !sbfi_surface_finder_make(&finder, &moved, arena))
    return false;
  if (!sbfi_matrix_invert(&s->best.m, &back)) back = sbfi_matrix_identity();
  uint32_t bone_count = s->r->c->asset->bones.count;
  double *distances = sbfi_arena_allocate(arena, (size_t)bone_count + 1, sizeof *distances);
  if (!distances) return false;
  for (uint32_t i = 0; i < s->lines.count; i++)
    for (uint32_t k = 0; k < PER_BONE; k++) {
      double *distance = &distances[s->lines.at[i].bone];
      sbfi_d3 p = along(&s->lines.at[i], k);
      sbfi_surface_location near;
      if (!is_inside(s, sbfi_similarity_apply(&back, p)) &&
          sbfi_surface_nearest(&finder, p, NULL, 1e30, &near))
        *distance = fmax(*distance, near.distance);
    }
  for (uint32_t b = 0; b < bone_count; b++) {
    outside_bone here = {b, distances[b]};
    if (here.distance <= 0) continue;
    count++;
    for (int k = 0; k < NAMED; k++) {
      if (here.distance <= worst[k].distance) continue;
      outside_bone other = worst[k];
      worst[k] = here;
      here = other;
    }
  }
  for (int k = 0; k < NAMED && worst[k].distance > 0; k++) {
    size_t used = strlen(text);
    snprintf(text + used, size - used, "%s'%.40s' by %.3g m", k ? ", " : "",
        s->r->c->asset->bones.at[worst[k].bone].name, worst[k].distance);
  }
  size_t used = strlen(text);
  if (count > NAMED) snprintf(text + used, size - used, " and %u more", count - NAMED);
  return true;
}

bool sbfi_show_misfit(const sbfi_rigging *r, const sbfi_matrix *to_asset) {
  sbfi_conversion *c = r->c;
  const sbf_polygon_mesh *from = &r->input.mesh;
  sbf_render_mesh *mesh = sbfi_convert_allocate(c, 1, sizeof *mesh);
  sbf_vec3 *positions = sbfi_convert_allocate(c, from->positions.count, sizeof *positions);
  uint32_t *sizes = sbfi_convert_allocate(c, from->polygon_sizes.count, sizeof *sizes);
  uint32_t *points = sbfi_convert_allocate(c, from->polygon_points.count, sizeof *points);
  if (!mesh || !positions || !sizes || !points) return false;
  for (uint32_t i = 0; i < from->positions.count; i++)
    positions[i] = sbfi_transform_point(to_asset, from->positions.at[i]);
  memcpy(sizes, from->polygon_sizes.at, from->polygon_sizes.count * sizeof *sizes);
  memcpy(points, from->polygon_points.at, from->polygon_points.count * sizeof *points);
  sbf_render_mesh_init(mesh);
  mesh->id = sbfi_new_id(c, "mesh", "input");
  mesh->name = "input";
  sbf_polygon_mesh_init(&mesh->mesh);
  mesh->mesh.target = SBF_MESH_TARGET_RENDERING;
  mesh->mesh.positions = (sbf_vec3_list){positions, from->positions.count};
  mesh->mesh.polygon_sizes = (sbf_u32_list){sizes, from->polygon_sizes.count};
  mesh->mesh.polygon_points = (sbf_u32_list){points, from->polygon_points.count};
  c->asset->render_meshes = (sbf_render_mesh_list){mesh, 1};
  c->keep_misfit = true;
  return mesh->id != NULL;
}

static sbf_status refuse(const search *s, sbfi_arena *arena) {
  char outside[260] = "";
  if (!sbfi_show_misfit(s->r, &s->best.m)) return sbfi_convert_no_memory(s->r->c);
  if (!describe_outside(s, outside, sizeof outside, arena)) return sbfi_convert_no_memory(s->r->c);
  if (!outside[0])
    snprintf(outside, sizeof outside, "bones on the surface of the mesh, which encloses no space");
  /* Without a skin only a BVH defines the rest pose; other files store a pose of a clip. */
  const sbfi_scene *rig = s->r->rig.scene;
  bool may_be_moved =
      s->r->rig.mesh.positions.count == 0 && rig->clip_count > 0 && strcmp(rig->format, "bvh") != 0;
  return sbfi_diagnose(s->r->c->error, SBF_CODE_IMPORT_RIG_OUTSIDE,
      "only %.0f %% of the bones' length is inside the mesh; outside are %s; use this character's rig%s, or "
      "state --unit, --up and --forward",
      100 * s->best.fraction, outside,
      may_be_moved ? ", exported in its rest pose (its clips may have moved it) or with its mesh" : "");
}

/* Bones that fit had at least 89 % of their length inside in measurements. */
static sbf_status warn_of_misfit(const search *s, sbfi_arena *arena) {
  char outside[260] = "";
  if (!describe_outside(s, outside, sizeof outside, arena)) return sbfi_convert_no_memory(s->r->c);
  sbfi_convert_warn(s->r->c, SBF_CODE_RIG_OTHER_MESH,
      "only %.0f %% of the bones' length is inside the mesh; outside are %s: if the rig has another pose or "
      "belongs to another character, use a rig in the pose of the mesh; if it is right, use --weights "
      "compute",
      100 * s->best.fraction, outside[0] ? outside : "bones on its surface");
  return SBF_OK;
}

/* Fraction of the input's points that are farther from every bone than the maximum radius of a body. */
static double uncovered_fraction(const search *s) {
  const sbf_vec3_list points = s->r->input.mesh.positions;
  double size = longest_side(s->soup.low, s->soup.high) * sbfi_similarity_scale(&s->best.m);
  uint32_t samples = points.count < SURFACE_SAMPLES ? points.count : SURFACE_SAMPLES, far = 0;
  for (uint32_t i = 0; i < samples; i++) {
    uint32_t at = (uint32_t)((double)points.count * i / samples);
    sbfi_d3 p = sbfi_similarity_apply(&s->best.m, sbfi_d3_of(points.at[at]));
    far += distance_to_nearest(s, p) > THICK * size;
  }
  return samples ? (double)far / samples : 0;
}

/* Factors on the cost of rotated limbs: for a usual unit, for the stated unit, and additionally without an
 * offset, because in another pose an unusual scale can compensate. Added cost for each rarer rotation. */
static const double USUAL_UNIT = 0.75, STATED_UNIT = 0.68, NO_OFFSET = 0.8, RARER = 0.15;

static void add_candidate(const search *s, const sbfi_matrix *m, sbfi_limb_candidate *to, uint32_t *count) {
  double scale = sbfi_similarity_scale(m);
  bool stays = m->at[0][3] == 0 && m->at[1][3] == 0 && m->at[2][3] == 0;
  double factor = 1;
  for (uint32_t i = 0; i < SBFI_USUAL_UNITS; i++)
    if (fabs(scale / sbfi_usual_units[i].unit_m - 1) < SAME_SCALE) factor = USUAL_UNIT;
  if (fabs(scale / sbfi_similarity_scale(&s->r->c->to_asset) - 1) < SAME_SCALE) factor = STATED_UNIT;
  if (factor < 1 && stays) factor *= NO_OFFSET;
  to[(*count)++] = (sbfi_limb_candidate){*m, factor * (1 + RARER * RARE[rarity_of(s, m)].cost)};
}

/* Collects candidate alignments for a rig in another pose: the best of the plausible rotations, and those
 * of usual units without an offset. */
static uint32_t collect_candidates(search *s, sbfi_limb_candidate to[MAX_CANDIDATES]) {
  double bones = longest_side(s->lines.low, s->lines.high), input = longest_side(s->soup.low, s->soup.high);
  uint32_t count = 0;
  add_candidate(s, &s->best.m, to, &count);
  for (uint32_t i = 0; i < ROTATIONS; i++) {
    const candidate *plain = &s->of_rotation[i];
    if (!(plain->score > s->best.score - REACH)) continue;
    if (plain->score < s->best.score && rarity_of(s, &plain->m) != UPRIGHT) continue;
    candidate better = refined(s, *plain);
    add_candidate(s, &plain->m, to, &count);
    add_candidate(s, &better.m, to, &count);
    for (uint32_t unit = 0; unit <= SBFI_USUAL_UNITS; unit++) {
      double scale = unit ? sbfi_usual_units[unit - 1].unit_m : sbfi_similarity_scale(&s->r->c->to_asset);
      if (input * scale < 0.7 * bones || input * scale > 2 * bones) continue;
      sbfi_matrix m = sbfi_similarity_scaled(&plain->m, scale, (sbfi_d3){0, 0, 0});
      add_candidate(s, &m, to, &count);
    }
  }
  return count;
}

static void report_rotated(const search *s, const sbfi_limb_alignment *found) {
  sbfi_convert_warn(s->r->c, SBF_CODE_RIG_ALIGNED,
      "the rig has another pose than the input: limbs were rotated with their children to fit inside it, %s",
      found->names);
}

/* Truncates a list of names to fit into an error. */
static void shorten_names(char *names) {
  enum { MAX_LENGTH = 70 };
  char *last = names;
  if (strlen(names) <= MAX_LENGTH) return;
  for (char *at = names; at < names + MAX_LENGTH; at++)
    if (*at == ',') last = at;
  if (last > names) memcpy(last, " ...", sizeof " ...");
}

/* Bones that are still outside, or parts without bones, may be limbs in the wrong position. */
static sbf_status report_limbs_outside(search *s, sbfi_limb_alignment *found, sbfi_arena *arena) {
  sbfi_conversion *c = s->r->c;
  char outside[130] = "";
  if (!describe_outside(s, outside, sizeof outside, arena)) return sbfi_convert_no_memory(c);
  if (!outside[0] || s->best.fraction >= MIN_ROTATED)
    snprintf(outside, sizeof outside, "%s bones, but %.0f %% of the mesh has none near",
        outside[0] ? "few" : "no", 100 * uncovered_fraction(s));
  if (c->options->rigging.weights) {
    sbfi_convert_warn(c, SBF_CODE_RIG_OTHER_MESH,
        "after its limbs were rotated, %.0f %% of the length of the rig's bones is inside the mesh; outside "
        "are %s: check the bones in --report, or use a rig in the pose of the input",
        100 * s->best.fraction, outside);
    return SBF_OK;
  }
  bool has_own_mesh = s->r->mean_gap > 0;
  if (!sbfi_show_misfit(s->r, &s->best.m)) return sbfi_convert_no_memory(c);
  shorten_names(found->names);
  return sbfi_diagnose(c->error, SBF_CODE_IMPORT_RIG_OUTSIDE,
      "the rig has another pose%s than the mesh, and not all limbs were found: after %s were rotated, %.0f "
      "%% "
      "of the bones' length is inside; outside are %s; %s, or use --weights compute",
      has_own_mesh ? " or body" : "", found->names, 100 * s->best.fraction, outside,
      has_own_mesh ? "use this character's rig" : "give both the same pose");
}

/* Matches a rig in another pose than the input limb by limb. The stated transform stays if it fits. */
static sbf_status match_limbs(sbfi_rigging *r, search *s, bool is_stated, bool *matched) {
  sbfi_limb_candidate candidates[MAX_CANDIDATES];
  sbfi_limb_alignment found;
  sbfi_arena arena;
  sbf_status status = SBF_OK;
  uint32_t count = 0;
  sbfi_arena_init(&arena, &r->c->scratch.allocator, 0);
  if (is_stated)
    add_candidate(s, &s->best.m, candidates, &count);
  else
    count = collect_candidates(s, candidates);
  bool good = sbfi_align_limbs(r, &s->lines, candidates, count, &s->best.m, &found, &arena);
  *matched = s->best.fraction >= GOOD;
  if (good && found.names[0] && found.cost < BETTER_ROTATED * found.unposed_cost) {
    const candidate before = s->best;
    sbfi_bone_line *lines = s->lines.at;
    s->best.m = found.to_asset;
    s->lines.at = found.lines;
    s->best.fraction = inside_fraction(s, &s->best.m, 0);
    bool fits = s->best.fraction >= MIN_ROTATED && uncovered_fraction(s) <= MAX_UNCOVERED;
    if (fits || (!is_stated && s->best.fraction >= SBFI_MIN_BONES_INSIDE)) {
      r->alignment.to_asset = s->best.m;
      if (!fits) status = report_limbs_outside(s, &found, &arena);
      if (status == SBF_OK) report_rotated(s, &found);
      good = sbfi_rig_move_bones(r, found.motions);
      *matched = true;
    } else
      s->best = before;
    s->lines.at = lines;
  }
  sbfi_arena_free(&arena);
  return good ? status : sbfi_convert_no_memory(r->c);
}

/* Whether the bones in the current alignment are about as long as the input. */
static bool is_long(const search *s) {
  double input = longest_side(s->soup.low, s->soup.high) * sbfi_similarity_scale(&s->best.m);
  return longest_side(s->lines.low, s->lines.high) >= MIN_LONG * input;
}

sbf_status sbfi_align_by_bones(sbfi_rigging *r) {
  sbfi_arena scratch;
  search s = {.r = r, .best.m = r->alignment.to_asset};
  bool is_stated = r->alignment.is_stated;
  sbfi_arena_init(&scratch, &r->c->scratch.allocator, 0);
  bool good = sbfi_soup_make(&s.soup, &r->input.mesh, &scratch) &&
              sbfi_winding_make(&s.winding, &s.soup, &scratch) && sbfi_bone_lines_find(r, &s.lines, &scratch);
  sbf_status status = good ? SBF_OK : sbfi_convert_no_memory(r->c);
  if (good && s.lines.count) {
    s.best.fraction = inside_fraction(&s, &s.best.m, 0);
    for (uint32_t i = 0; i < ROTATIONS; i++) s.of_rotation[i].score = -INFINITY;
    s.best.score = score_of(&s, &s.best.m, s.best.fraction, -INFINITY);
    bool matched = false;
    if (is_long(&s) || !is_stated) status = match_limbs(r, &s, true, &matched);
    if (status == SBF_OK && !matched && is_stated) {
      consider_all(&s);
      status = match_limbs(r, &s, false, &matched);
    }
    r->alignment.to_asset = s.best.m;
    r->alignment.inside = s.best.fraction;
    if (s.best.fraction >= SBFI_MIN_BONES_INSIDE) sbfi_adapt_rig(r);
    r->alignment.is_stated = memcmp(&s.best.m, &r->c->to_asset, sizeof s.best.m) == 0;
    if (status == SBF_OK && s.best.fraction < SBFI_MIN_BONES_INSIDE)
      status = refuse(&s, &scratch);
    else if (status == SBF_OK && s.best.fraction < CERTAIN && !matched && !r->c->options->rigging.weights)
      status = warn_of_misfit(&s, &scratch);
  }
  sbfi_arena_free(&scratch);
  return status;
}
