/* Lays an input over a rig without a mesh like it: so that its bones lie inside.
 *
 * The transform that the files state stays where most of the bones' length lies inside. Else axes, usual
 * units and offsets are tried, the plainest first, and at last a scale that makes the two as large. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "build/geometry/winding_number.h"
#include "build/weights/bone_roles.h"
#include "import/rigging/align.h"
#include "import/rigging/surface_finder.h"

enum {
  PER_BONE = 6,
  NAMED = 4,
  SURFACE_SAMPLES = 1000,
  SCORE_SAMPLES = 256,
  SEVERAL = 10,
  ROTATIONS = SBFI_AXIS_ROTATIONS / 2
};

static const double CERTAIN = 0.85; /* with less, the rig may stand otherwise */
static const double GOOD = 0.95;    /* so much of the length inside is as it should be */

/* Shares inside before limbs are turned and after; share of the points that may be without a bone; how thick
 * a body is around its bones, as a share of its longest side. */
static const double MIN_TRUNK = 0.25, MIN_TURNED = 0.9, MAX_UNCOVERED = 0.2;
static const double MIN_COVERING = 0.8,
                    COVERED = 0.05; /* fewer inside do where nearly all points have a bone */
static const double THICK = 0.15;
static const double BETTER = 0.02;  /* by which a later candidate has to be better */
static const double NEARNESS = 2;   /* of a mean distance, by a share inside */
static const double MIN_LONG = 0.6; /* of a body's longest side, of bones that lie as the files say */
static const double KEPT = 0.85;    /* so much inside as the files say is no accident: */
static const double ODD = 0.15;     /* an odd scale or offset with the same axes has to be so much better */
static const double POSED = 0.1; /* so much better a rarer rotation has to be where limbs stand otherwise */
static const double REACH = 0.3; /* so much worse one may be before its scale and offset are refined */

typedef struct bone_line {
  sbfi_d3 from, to; /* asset space */
  uint32_t bone;
  double length;
} bone_line;

typedef struct candidate {
  sbfi_matrix m;
  double fraction, score; /* inside; less what its distance from the surface takes */
} candidate;

typedef struct search {
  const sbfi_rigging *r;
  sbfi_soup soup;
  sbfi_winding winding; /* of the input in its own space */
  bone_line *lines;
  uint32_t line_count;
  double total;      /* length */
  sbfi_d3 low, high; /* of the lines */
  uint32_t rotation; /* at hand */
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

static sbfi_d3 along(const bone_line *line, uint32_t sample) {
  double t = (sample + 0.5) / PER_BONE;
  return sbfi_d3_add(sbfi_d3_scale(line->from, 1 - t), sbfi_d3_scale(line->to, t));
}

static double inside_of_line(const search *s, const sbfi_matrix *back, const bone_line *line) {
  uint32_t inside = 0;
  for (uint32_t k = 0; k < PER_BONE; k++) inside += is_inside(s, sbfi_similarity_apply(back, along(line, k)));
  return (double)inside / PER_BONE;
}

/* Stops where less than `least` can be inside. */
static double inside_fraction(const search *s, const sbfi_matrix *m, double min) {
  sbfi_matrix back;
  double sum = 0, left = s->total;
  if (!sbfi_matrix_invert(m, &back)) return 0;
  for (uint32_t i = 0; i < s->line_count; i++) {
    if (sum + left < min * s->total) return 0;
    sum += s->lines[i].length * inside_of_line(s, &back, &s->lines[i]);
    left -= s->lines[i].length;
  }
  return s->total > 0 ? sum / s->total : 1;
}

static double distance_to_line(const bone_line *line, sbfi_d3 p) {
  sbfi_d3 along = sbfi_d3_sub(line->to, line->from), displacement = sbfi_d3_sub(p, line->from);
  double t = fmin(fmax(sbfi_d3_dot(displacement, along) / sbfi_d3_dot(along, along), 0), 1);
  return sbfi_d3_length(sbfi_d3_sub(displacement, sbfi_d3_scale(along, t)));
}

/* Mean distance of the input's points to the nearest bone, as a share of its longest side. It tells the front
 * of a body from its back, and a skeleton from a small one that lies in its belly. */
static double distance_to_bones(const search *s, const sbfi_matrix *m) {
  const sbf_vec3_list points = s->r->input.mesh.positions;
  double sum = 0, size = longest_side(s->soup.low, s->soup.high) * sbfi_similarity_scale(m);
  uint32_t samples = points.count < SCORE_SAMPLES ? points.count : SCORE_SAMPLES;
  for (uint32_t i = 0; i < samples; i++) {
    uint32_t at = (uint32_t)((double)points.count * fmod(0.5 + i * 0.6180339887498949, 1.0));
    sbfi_d3 p = sbfi_similarity_apply(m, sbfi_d3_of(points.at[at]));
    double nearest = INFINITY;
    for (uint32_t k = 0; k < s->line_count; k++) nearest = fmin(nearest, distance_to_line(&s->lines[k], p));
    sum += fmin(nearest / size, 1);
  }
  return samples ? sum / samples : 0;
}

/* A score below `least` is not told. */
static candidate evaluate(const search *s, const sbfi_matrix *m, double min) {
  candidate c = {*m, 0, -INFINITY};
  if (!sbfi_alignment_allowed(s->r, m)) return c;
  c.fraction = inside_fraction(s, m, min);
  if (c.fraction >= min) c.score = c.fraction - NEARNESS * distance_to_bones(s, m);
  return c;
}

static void consider(search *s, const sbfi_matrix *m) {
  candidate *best = &s->of_rotation[s->rotation], here = evaluate(s, m, best->score + BETTER);
  if (here.score >= best->score + BETTER) *best = here;
}

/* --- Bones as lines ------------------------------------------------------------------------------------ */

static int compare_lengths(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static void add_line(search *s, uint32_t bone, sbfi_d3 from, sbfi_d3 to) {
  double length = sbfi_d3_length(sbfi_d3_sub(to, from));
  if (!(length > 0)) return;
  s->lines[s->line_count++] = (bone_line){from, to, bone, length};
  s->total += length;
}

/* Exporters mark the end of a limb's last bone as far away as their own setting says. Ends farther than any
 * two bones of the rig's limbs are apart are moved to the median distance. */
static void shorten_ends(const sbfi_rigging *r, const bool *holds_skin, double *lengths) {
  const sbf_bone_list *bones = &r->c->asset->bones;
  const sbfi_weights_input in = {.bones = bones->at, .bone_count = bones->count};
  uint32_t count = 0;
  for (uint32_t b = 0; b < bones->count; b++) {
    int32_t parent = bones->at[b].parent;
    if (parent == SBF_NONE || !holds_skin[parent] || !holds_skin[b] || sbfi_bone_is_on_root(&in, b)) continue;
    lengths[count++] =
        sbfi_d3_length(sbfi_d3_sub(sbfi_d3_of(bones->at[b].head), sbfi_d3_of(bones->at[parent].head)));
  }
  if (!count) return;
  qsort(lengths, count, sizeof *lengths, compare_lengths);
  double longest = lengths[count - 1], median = lengths[count / 2];
  for (uint32_t b = 0; b < bones->count; b++) {
    int32_t parent = bones->at[b].parent;
    if (!sbfi_bone_is_end(&in, b) || !holds_skin[parent]) continue;
    sbf_bone *end = (sbf_bone *)(uintptr_t)&bones->at[b]; /* ours until the asset is handed out */
    sbf_bone *last = (sbf_bone *)(uintptr_t)&bones->at[parent];
    sbfi_d3 from = sbfi_d3_of(last->head), along = sbfi_d3_sub(sbfi_d3_of(end->head), from);
    double length = sbfi_d3_length(along);
    if (!(length > longest)) continue;
    end->head = sbfi_d3_rounded(sbfi_d3_add(from, sbfi_d3_scale(along, median / length)));
    if ((double)last->length > longest) last->length = (float)median;
  }
}

/* Frames and controls do not lie in a body: lines run between bones that hold skin, and to marks of ends. */
static bool make_lines(search *s, sbfi_arena *arena) {
  const sbf_bone_list *bones = &s->r->c->asset->bones;
  const sbfi_weights_input in = {.bones = bones->at, .bone_count = bones->count};
  bool *holds_skin = sbfi_arena_allocate(arena, (size_t)bones->count + 1, sizeof *holds_skin);
  double *lengths = sbfi_arena_allocate(arena, (size_t)bones->count + 1, sizeof *lengths);
  s->lines = sbfi_arena_allocate(arena, 2 * (size_t)bones->count, sizeof *s->lines);
  if (!s->lines || !holds_skin || !lengths) return false;
  double size = 0;
  for (uint32_t b = 1; b < bones->count; b++)
    size =
        fmax(size, sbfi_d3_length(sbfi_d3_sub(sbfi_d3_of(bones->at[b].head), sbfi_d3_of(bones->at[0].head))));
  const sbfi_weight_mesh space = {.scale = size > 0 ? 1 / size : 1};
  sbfi_bone_roles_find(&in, &space, NULL, holds_skin);
  shorten_ends(s->r, holds_skin, lengths);
  uint32_t joined = 0; /* bones between two that hold skin */
  for (uint32_t b = 0; b < bones->count; b++)
    joined += bones->at[b].parent != SBF_NONE && holds_skin[bones->at[b].parent] && holds_skin[b];
  for (uint32_t b = 0; b < bones->count; b++) {
    int32_t parent = bones->at[b].parent;
    bool is_end = sbfi_bone_is_end(&in, b);
    if (parent == SBF_NONE || !holds_skin[parent] || (!holds_skin[b] && !is_end)) continue;
    if (is_end && joined > SEVERAL) continue;
    add_line(s, (uint32_t)parent, sbfi_d3_of(bones->at[parent].head), sbfi_d3_of(bones->at[b].head));
  }
  for (uint32_t i = 0; i < 2 * s->line_count; i++) {
    sbfi_d3 p = i % 2 ? s->lines[i / 2].to : s->lines[i / 2].from;
    s->low = i ? (sbfi_d3){fmin(s->low.x, p.x), fmin(s->low.y, p.y), fmin(s->low.z, p.z)} : p;
    s->high = i ? (sbfi_d3){fmax(s->high.x, p.x), fmax(s->high.y, p.y), fmax(s->high.z, p.z)} : p;
  }
  return true;
}

/* --- Candidates ---------------------------------------------------------------------------------------- */

/* As it is; middle on middle; standing on the lowest bone, which is an ankle's height above the sole. */
static void consider_offsets(search *s, const sbfi_matrix *axes, double scale) {
  sbfi_matrix m = sbfi_similarity_scaled(axes, scale, (sbfi_d3){0, 0, 0});
  sbfi_d3 bones = sbfi_d3_scale(sbfi_d3_add(s->low, s->high), 0.5);
  sbfi_d3 input = sbfi_similarity_apply(&m, sbfi_d3_scale(sbfi_d3_add(s->soup.low, s->soup.high), 0.5));
  sbfi_d3 a = sbfi_similarity_apply(&m, s->soup.low), b = sbfi_similarity_apply(&m, s->soup.high);
  double height = fabs(b.y - a.y);
  consider(s, &m);
  sbfi_d3 offset = sbfi_d3_sub(bones, input);
  m = sbfi_similarity_scaled(axes, scale, offset);
  consider(s, &m);
  offset.y = s->low.y - 0.05 * height - fmin(a.y, b.y);
  m = sbfi_similarity_scaled(axes, scale, offset);
  consider(s, &m);
}

static void consider_scale(search *s, double scale) {
  for (s->rotation = 0; s->rotation < ROTATIONS; s->rotation++) {
    sbfi_matrix axes = sbfi_axis_rotation(s->rotation);
    consider_offsets(s, &axes, scale);
  }
}

/* Other scales and offsets up and forwards around a candidate, in ever smaller steps. */
static candidate refined(const search *s, candidate from) {
  double size = longest_side(s->low, s->high);
  sbfi_d3 middle = sbfi_d3_scale(sbfi_d3_add(s->low, s->high), 0.5);
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

/* How rarely an input is turned so: up on up with its left on the left; facing backwards; sideways; else. */
static uint32_t rarity_of(const sbfi_matrix *m) {
  double max = 0.9 * sbfi_similarity_scale(m);
  if (m->at[1][1] < max && m->at[1][2] < max) return 3;
  return m->at[0][0] > max ? 0 : m->at[0][0] < -max ? 1 : 2;
}

/* The best of all rotations, each as well as it can lie if limbs do not stand otherwise. A more usual one
 * stays where another is little better, as around straight chains of bones, and so does one of a usual unit
 * and offset. */
static void choose(search *s) {
  static const double by[] = {0.02, 0.03, 0.05, 0.2}; /* so much better than more usual ones */
  double max = s->best.score;
  for (uint32_t i = 0; i < 4 * ROTATIONS; i++) {
    const candidate *plain = &s->of_rotation[i % ROTATIONS];
    uint32_t rarity = i / ROTATIONS;
    if (!(plain->score > max - REACH) || rarity_of(&plain->m) != rarity) continue;
    candidate better = refined(s, *plain);
    if (better.fraction < GOOD) better = *plain;
    if (better.score < max + by[rarity] + (rarity && better.fraction < GOOD ? POSED : 0)) continue;
    max = better.score;
    s->best = better.score >= plain->score + BETTER ? better : *plain;
  }
}

/* Whether a candidate has the axes that the files state, and another scale or offset. */
static bool has_stated_axes(const search *s, const sbfi_matrix *m) {
  const sbfi_matrix *stated = &s->r->c->to_asset;
  double scale = sbfi_similarity_scale(m) / sbfi_similarity_scale(stated);
  for (int row = 0; row < 3; row++)
    for (int k = 0; k < 3; k++)
      if (fabs(m->at[row][k] - scale * stated->at[row][k]) > 1e-6 * sbfi_similarity_scale(m)) return false;
  return true;
}

/* Whether the stated transform stays. */
static bool consider_all(search *s) {
  const candidate stated = s->best;
  double bones = longest_side(s->low, s->high), input = longest_side(s->soup.low, s->soup.high);
  double stated_scale = sbfi_similarity_scale(&s->r->c->to_asset);
  /* A small rig lies inside anything. One of few bones may leave large parts of its body without any. */
  double max = s->line_count < SEVERAL && !sbfi_rig_has_no_size(s->r) ? 3 : 1.6;
  for (uint32_t i = 0; i < ROTATIONS; i++) s->of_rotation[i].score = -INFINITY;
  for (uint32_t unit = 0; unit <= SBFI_USUAL_UNITS; unit++) {
    double scale = unit ? sbfi_usual_units[unit - 1].unit_m : stated_scale;
    if (input * scale < 0.7 * bones || input * scale > (unit ? max : 3) * bones) continue;
    consider_scale(s, scale);
  }
  /* How much longer an input is than its bones. */
  static const double ratios[] = {1.12, 1.3, 1, 1.06, 1.2, 1.45, 1.7, 2};
  size_t count = sizeof ratios / sizeof *ratios - (s->line_count < SEVERAL ? 0 : 2);
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

/* Names the bones that are farthest outside. */
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
  for (uint32_t i = 0; i < s->line_count; i++)
    for (uint32_t k = 0; k < PER_BONE; k++) {
      double *distance = &distances[s->lines[i].bone];
      sbfi_d3 p = along(&s->lines[i], k);
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
  return sbfi_diagnose(s->r->c->error, SBF_CODE_IMPORT_RIG_OUTSIDE,
      "only %.0f %% of the bones' length lies inside the mesh; outside lie %s; give this character's rig, or "
      "--unit, --up and --forward",
      100 * s->best.fraction, outside);
}

/* Of bones that fit, 89 % of their length and more was measured inside. */
static sbf_status warn_of_misfit(const search *s, sbfi_arena *arena) {
  char outside[260] = "";
  if (!describe_outside(s, outside, sizeof outside, arena)) return sbfi_convert_no_memory(s->r->c);
  sbfi_convert_warn(s->r->c, SBF_CODE_RIG_OTHER_MESH,
      "only %.0f %% of the bones' length lies inside the mesh; outside lie %s: if limbs of the rig stand "
      "otherwise or it is another character's, give a rig in the pose of the mesh; --weights compute takes "
      "these bones as they lie",
      100 * s->best.fraction, outside[0] ? outside : "bones on its surface");
  return SBF_OK;
}

/* Motion capture states no unit, and then the input's counts: the rig is scaled, not the input. */
static void scale_rig(sbfi_rigging *r) {
  double factor = sbfi_similarity_scale(&r->c->to_asset) / sbfi_similarity_scale(&r->alignment.to_asset);
  if (!sbfi_rig_has_no_size(r) || fabs(factor - 1) < 1e-9) return;
  for (uint32_t b = 0; b < r->c->asset->bones.count; b++) {
    sbf_bone *bone =
        (sbf_bone *)(uintptr_t)&r->c->asset->bones.at[b]; /* ours until the asset is handed out */
    bone->head = sbfi_d3_rounded(sbfi_d3_scale(sbfi_d3_of(bone->head), factor));
    bone->length = (float)((double)bone->length * factor);
  }
  sbfi_matrix *const matrices[] = {&r->c->rig_to_asset, &r->alignment.to_asset};
  for (int i = 0; i < 2; i++)
    for (int row = 0; row < 3; row++)
      for (int k = 0; k < 4; k++) matrices[i]->at[row][k] *= factor;
  sbfi_convert_warn(r->c, SBF_CODE_RIG_ALIGNED,
      "%s states no unit: it was scaled by %.6g, so that its bones lie inside the input", r->rig.scene->file,
      factor);
}

/* Share of the input's points that lie farther from every bone than any part of a body is thick. */
static double uncovered_fraction(const search *s) {
  const sbf_vec3_list points = s->r->input.mesh.positions;
  double size = longest_side(s->soup.low, s->soup.high) * sbfi_similarity_scale(&s->best.m);
  uint32_t samples = points.count < SURFACE_SAMPLES ? points.count : SURFACE_SAMPLES, far = 0;
  for (uint32_t i = 0; i < samples; i++) {
    uint32_t at = (uint32_t)((double)points.count * i / samples);
    sbfi_d3 p = sbfi_similarity_apply(&s->best.m, sbfi_d3_of(points.at[at]));
    double nearest = INFINITY;
    for (uint32_t k = 0; k < s->line_count && nearest > THICK * size; k++)
      nearest = fmin(nearest, distance_to_line(&s->lines[k], p));
    far += nearest > THICK * size;
  }
  return samples ? (double)far / samples : 0;
}

/* A rig that stands otherwise than the input, limb by limb. The turns stay where they bring nearly all bones
 * inside and no large part of the input is left without any: that would be another character. */
static sbf_status match_limbs(sbfi_rigging *r, search *s, sbfi_arena *arena, bool *matched) {
  sbfi_conversion *c = r->c;
  const sbf_bone_list list = c->asset->bones;
  sbf_bone *bones = (sbf_bone *)(uintptr_t)list.at; /* ours until the asset is handed out */
  const sbf_bone *before = sbfi_arena_copy(arena, bones, list.count, sizeof *bones);
  const sbfi_scene *scene = r->rig.scene, *rig = c->rig;
  char turned[300];
  double fraction = s->best.fraction;
  *matched = fraction >= GOOD;
  if (*matched || fraction < MIN_TRUNK) return SBF_OK;
  r->alignment.to_asset = s->best.m;
  s->line_count = 0;
  s->total = s->best.fraction = 0;
  if (!before || !sbfi_align_limbs(r, &s->winding, turned, sizeof turned) || !make_lines(s, arena))
    return sbfi_convert_no_memory(c);
  s->best.fraction = inside_fraction(s, &s->best.m, 0);
  double uncovered = uncovered_fraction(s);
  bool fits = s->best.fraction >= MIN_TURNED && uncovered <= MAX_UNCOVERED;
  if (turned[0] && (fits || (s->best.fraction >= MIN_COVERING && uncovered <= COVERED))) {
    sbfi_convert_warn(c, SBF_CODE_RIG_ALIGNED,
        "the rig stands otherwise than the input: limbs were turned to lie inside it, %s, each with all that "
        "hangs on it",
        turned);
    if (s->best.fraction < GOOD)
      sbfi_convert_warn(c, SBF_CODE_RIG_OTHER_MESH,
          "with its limbs turned, %.0f %% of the length of the rig's bones lies inside the mesh, and without "
          "a mesh "
          "like the input nothing tells whether each lies in its own limb: look at the bones in --report; a "
          "rig in the "
          "pose of the input needs no turn",
          100 * s->best.fraction);
    *matched = true;
    return SBF_OK;
  }
  memcpy(bones, before, list.count * sizeof *bones);
  r->rig.scene = scene;
  c->rig = rig;
  s->line_count = 0;
  s->total = 0;
  s->best.fraction = fraction;
  return make_lines(s, arena) ? SBF_OK : sbfi_convert_no_memory(c);
}

/* Of usual rotations those that are not much worse than the best, as they are and as well as they can lie. */
static sbf_status match_limbs_otherwise(sbfi_rigging *r, search *s, sbfi_arena *arena, bool *matched) {
  const candidate best = s->best;
  sbf_status status = SBF_OK;
  for (uint32_t i = 0; i < 2 * ROTATIONS && status == SBF_OK && !*matched; i++) {
    const candidate *plain = &s->of_rotation[i / 2];
    if (!(plain->score > best.score - REACH) || rarity_of(&plain->m) != 0) continue;
    s->best = i % 2 ? refined(s, *plain) : *plain;
    status = match_limbs(r, s, arena, matched);
  }
  if (!*matched) s->best = best;
  return status;
}

/* Whether the bones, as they lie, are about as long as the input. */
static bool is_long(const search *s) {
  double input = longest_side(s->soup.low, s->soup.high) * sbfi_similarity_scale(&s->best.m);
  return longest_side(s->low, s->high) >= MIN_LONG * input;
}

sbf_status sbfi_align_by_bones(sbfi_rigging *r) {
  sbfi_arena scratch;
  search s = {.r = r, .best.m = r->alignment.to_asset};
  bool is_stated = r->alignment.is_stated;
  sbfi_arena_init(&scratch, &r->c->scratch.allocator, 0);
  bool good = sbfi_soup_make(&s.soup, &r->input.mesh, &scratch) &&
              sbfi_winding_make(&s.winding, &s.soup, &scratch) && make_lines(&s, &scratch);
  sbf_status status = good ? SBF_OK : sbfi_convert_no_memory(r->c);
  if (good && s.line_count) {
    s.best.fraction = inside_fraction(&s, &s.best.m, 0);
    s.best.score = s.best.fraction - NEARNESS * distance_to_bones(&s, &s.best.m);
    bool matched = false;
    if (is_long(&s)) status = match_limbs(r, &s, &scratch, &matched);
    if (status == SBF_OK && !matched && is_stated) {
      bool kept = consider_all(&s);
      status = match_limbs(r, &s, &scratch, &matched);
      if (status == SBF_OK && !matched && !kept) status = match_limbs_otherwise(r, &s, &scratch, &matched);
    }
    r->alignment.to_asset = s.best.m;
    r->alignment.inside = s.best.fraction;
    if (s.best.fraction >= SBFI_MIN_BONES_INSIDE) scale_rig(r);
    r->alignment.is_stated = memcmp(&s.best.m, &r->c->to_asset, sizeof s.best.m) == 0;
    if (status == SBF_OK && s.best.fraction < SBFI_MIN_BONES_INSIDE)
      status = refuse(&s, &scratch);
    else if (status == SBF_OK && s.best.fraction < CERTAIN && !matched && !r->c->options->weights)
      status = warn_of_misfit(&s, &scratch);
  }
  sbfi_arena_free(&scratch);
  return status;
}
