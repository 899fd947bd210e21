/* Fits the limbs of one side to both halves of the body at once, with the other half mirrored onto it. The
 * sides of a rig saved in mid stride differ, so each pose is tried for both sides. */
#include "import/rigging/limb_symmetry.h"

#include <stdlib.h>
#include <string.h>

#include "import/rigging/similarity.h"
#include "motion/retargeting.h"

enum { SAMPLES = 400, MIDDLES = 64 };

/* As fractions of the input's longest side: tolerance of mirrored points, tolerance of middle bones, and
 * minimum asymmetry of a pair of limbs. */
static const double NEAR = 0.01, MIDDLE = 0.1, ASYMMETRY = 0.03;
/* Minimum fraction of points within the tolerance. */
static const double MIN_ALIKE = 0.85;
/* Minimum rotation, rad, of a bone of the other side onto the mirror image. */
static const double MIN_ANGLE = 0.07;

/* --- Twins --------------------------------------------------------------------------------------------- */

static char lower(char c) {
  return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

static size_t length_of_word(const char *text, const char *word) {
  size_t length = strlen(word);
  for (size_t i = 0; i < length; i++)
    if (lower(text[i]) != word[i]) return 0;
  return length;
}

/* Length of a leading word or letter for the left or right side; 0 if there is none. */
static size_t length_of_side(const char *text, bool left) {
  size_t length = length_of_word(text, left ? "left" : "right");
  return length ? length : length_of_word(text, left ? "l" : "r");
}

static bool differ_by_side(const char *a, const char *b) {
  while (*a || *b) {
    bool left = length_of_side(a, true) > 0;
    size_t of_a = length_of_side(a, left), of_b = length_of_side(b, !left);
    bool is_same = *a && lower(*a) == lower(*b);
    if (!is_same && !(of_a && of_b)) return false;
    a += is_same ? 1 : of_a;
    b += is_same ? 1 : of_b;
  }
  return true;
}

/* Descendants of a limb belong to its side, whatever their names. */
static void find_sides(sbfi_limb_symmetry *s, const sbf_bone_list *bones) {
  for (uint32_t b = 0; b < bones->count; b++) {
    int32_t parent = bones->at[b].parent;
    int8_t above = parent == SBF_NONE ? 0 : s->sides[parent];
    s->sides[b] = above ? above : (int8_t)sbfi_name_side(bones->at[b].name);
  }
}

/* Searches among the children of the parent's twin. */
static int32_t twin_of(const sbfi_limb_symmetry *s, const sbf_bone_list *bones, uint32_t bone) {
  int32_t parent = bones->at[bone].parent, above = parent == SBF_NONE ? SBF_NONE : s->twins[parent];
  if (!s->sides[bone]) return (int32_t)bone;
  if (parent != SBF_NONE && above == SBF_NONE) return SBF_NONE;
  for (uint32_t b = 0; b < bones->count; b++)
    if (bones->at[b].parent == above && s->sides[b] == -s->sides[bone] &&
        differ_by_side(bones->at[bone].name, bones->at[b].name))
      return (int32_t)b;
  return SBF_NONE;
}

bool sbfi_limb_symmetry_find(
    sbfi_limb_symmetry *s, const sbfi_rigging *r, const sbfi_bone_lines *lines, sbfi_arena *arena) {
  const sbf_bone_list *bones = &r->c->asset->bones;
  *s = (sbfi_limb_symmetry){.r = r, .lines = lines};
  s->twins = sbfi_arena_allocate(arena, (size_t)bones->count + 1, sizeof *s->twins);
  s->sides = sbfi_arena_allocate(arena, (size_t)bones->count + 1, sizeof *s->sides);
  if (!s->twins || !s->sides || !sbfi_surface_finder_make(&s->finder, &r->input, arena)) return false;
  find_sides(s, bones);
  for (uint32_t b = 0; b < bones->count; b++) s->twins[b] = twin_of(s, bones, b);
  uint32_t paired = 0, single = 0;
  for (uint32_t k = 0; k < lines->count; k++) {
    int32_t twin = s->twins[lines->at[k].child];
    single += twin == SBF_NONE || s->twins[lines->at[k].bone] == SBF_NONE;
    paired += twin != (int32_t)lines->at[k].child;
  }
  s->has_twins = paired > 0 && single == 0;
  return true;
}

/* --- Symmetric inputs ---------------------------------------------------------------------------------- */

static sbfi_d3 mirrored(sbfi_d3 p, double plane) {
  return (sbfi_d3){2 * plane - p.x, p.y, p.z};
}

static int compare(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* Median of the centres between twins, which is robust to objects on one side. */
static double plane_between_twins(const sbfi_limb_symmetry *s) {
  const sbf_bone *bones = s->r->c->asset->bones.at;
  double middles[MIDDLES];
  uint32_t count = 0;
  for (uint32_t k = 0; k < s->lines->count && count < MIDDLES; k++) {
    uint32_t bone = s->lines->at[k].child;
    if (s->sides[bone] > 0)
      middles[count++] = 0.5 * ((double)bones[bone].head.x + (double)bones[s->twins[bone]].head.x);
  }
  qsort(middles, count, sizeof *middles, compare);
  return count ? middles[count / 2] : 0;
}

static bool is_input_symmetric(const sbfi_limb_symmetry *s, double plane) {
  const sbf_vec3_list points = s->r->input.mesh.positions;
  const sbfi_matrix *m = &s->r->alignment.to_asset;
  uint32_t samples = points.count < SAMPLES ? points.count : SAMPLES, alike = 0;
  sbfi_d3 sides = sbfi_d3_sub(sbfi_d3_of(s->r->input.high), sbfi_d3_of(s->r->input.low));
  double within = NEAR * fmax(sides.x, fmax(sides.y, sides.z));
  sbfi_matrix back;
  if (!sbfi_matrix_invert(m, &back)) return false;
  for (uint32_t i = 0; i < samples; i++) {
    sbfi_surface_location near;
    sbfi_d3 p = sbfi_d3_of(points.at[(uint64_t)i * points.count / samples]);
    p = mirrored(sbfi_similarity_apply(m, p), plane);
    alike += sbfi_surface_nearest(&s->finder, sbfi_similarity_apply(&back, p), NULL, within, &near);
  }
  return samples && alike >= MIN_ALIKE * samples;
}

static bool is_middle_near(const sbfi_limb_symmetry *s, double plane, double within) {
  for (uint32_t k = 0; k < s->lines->count; k++) {
    const sbfi_bone_line *line = &s->lines->at[k];
    if (!s->sides[line->child] && fabs(line->to.x - plane) > within) return false;
  }
  return true;
}

/* Whether the limbs of the rig's two sides are posed differently, as in mid stride. */
static bool is_rig_asymmetric(const sbfi_limb_symmetry *s, double size) {
  const sbf_bone *bones = s->r->c->asset->bones.at;
  double plane = plane_between_twins(s), farthest = 0;
  for (uint32_t k = 0; k < s->lines->count; k++) {
    uint32_t bone = s->lines->at[k].child;
    sbfi_d3 twin = mirrored(sbfi_d3_of(bones[s->twins[bone]].head), plane);
    farthest = fmax(farthest, sbfi_d3_length(sbfi_d3_sub(sbfi_d3_of(bones[bone].head), twin)));
  }
  return farthest > ASYMMETRY * size;
}

bool sbfi_limb_symmetry_holds(const sbfi_limb_symmetry *s, double *plane) {
  const sbfi_matrix *m = &s->r->alignment.to_asset;
  if (!s->has_twins) return false;
  sbfi_d3 low = sbfi_d3_of(s->r->input.low), high = sbfi_d3_of(s->r->input.high);
  sbfi_d3 sides = sbfi_d3_sub(high, low);
  double size = fmax(sides.x, fmax(sides.y, sides.z)) * sbfi_similarity_scale(m);
  if (!is_rig_asymmetric(s, size)) return false;
  const double planes[] = {
      sbfi_similarity_apply(m, sbfi_d3_scale(sbfi_d3_add(low, high), 0.5)).x, plane_between_twins(s)};
  for (int i = 0; i < 2; i++) {
    *plane = planes[i];
    if (is_middle_near(s, *plane, MIDDLE * size) && is_input_symmetric(s, *plane)) return true;
  }
  return false;
}

/* --- One side, and the other like it -------------------------------------------------------------------- */

static bool is_middle(const sbfi_limb_symmetry *s, uint32_t bone) {
  return s->twins[bone] == (int32_t)bone;
}

static sbfi_matrix translation(sbfi_d3 by) {
  sbfi_matrix m = sbfi_matrix_identity();
  m.at[0][3] = by.x, m.at[1][3] = by.y, m.at[2][3] = by.z;
  return m;
}

/* Copies the lines of one side; the middle is in the plane. */
static bool copy_lines(const sbfi_limb_symmetry *s, int side, sbfi_bone_lines *own, sbfi_arena *arena) {
  *own = *s->lines;
  own->at = sbfi_arena_allocate(arena, (size_t)s->lines->count + 1, sizeof *own->at);
  if (!own->at) return false;
  own->count = 0;
  own->total = 0.5 * s->lines->total; /* each of two limbs counts as much as both do in all lines */
  for (uint32_t k = 0; k < s->lines->count; k++) {
    const sbfi_bone_line *line = &s->lines->at[k];
    if (s->sides[line->bone] == -side || s->sides[line->child] == -side) continue;
    own->at[own->count++] = *line;
  }
  return true;
}

/* Mirrors the other half of the body onto this side. */
static void fold_core(const sbfi_limb_symmetry *s, double plane, int side, sbfi_body_core *core) {
  const sbf_bone_list bones = s->r->c->asset->bones;
  double sum = 0;
  for (uint32_t k = 0; k < s->lines->count; k++)
    if (s->sides[s->lines->at[k].child] == side)
      sum += (double)bones.at[s->lines->at[k].child].head.x - plane;
  double sign = sum < 0 ? -1 : 1;
  for (uint32_t i = 0; i < core->count; i++)
    core->points[i].position.x = plane + sign * fabs(core->points[i].position.x - plane);
}

static sbfi_d3 direction_of(const sbfi_limb_symmetry *s, uint32_t bone) {
  for (uint32_t k = 0; k < s->lines->count; k++) {
    const sbfi_bone_line *line = &s->lines->at[k];
    if (line->bone == bone) return sbfi_d3_normal(sbfi_d3_sub(line->to, line->from));
  }
  return (sbfi_d3){0, 0, 0};
}

/* Motion of a bone at rest to the mirror image of its twin at rest. */
static sbfi_matrix motion_to_twin(
    const sbfi_limb_symmetry *s, uint32_t bone, double plane, const double above[4], double rotation[4]) {
  const sbf_bone *bones = s->r->c->asset->bones.at;
  uint32_t twin = (uint32_t)s->twins[bone];
  sbfi_d3 head = sbfi_d3_of(bones[bone].head), to = mirrored(sbfi_d3_of(bones[twin].head), plane);
  sbfi_d3 own = direction_of(s, bone), other = direction_of(s, twin);
  memcpy(rotation, above, 4 * sizeof *rotation);
  if (sbfi_d3_length(own) > 0 && sbfi_d3_length(other) > 0)
    sbfi_quatd_between(
        (const double[3]){own.x, own.y, own.z}, (const double[3]){-other.x, other.y, other.z}, rotation);
  sbfi_matrix turn = sbfi_rotation_about(rotation, head), by = translation(sbfi_d3_sub(to, head));
  return sbfi_matrix_multiply(&by, &turn);
}

static sbfi_matrix mirrored_motion(const sbfi_matrix *motion, double plane) {
  sbfi_matrix mirror = sbfi_matrix_identity();
  mirror.at[0][0] = -1;
  mirror.at[0][3] = 2 * plane;
  sbfi_matrix m = sbfi_matrix_multiply(motion, &mirror);
  return sbfi_matrix_multiply(&mirror, &m);
}

/* Computes the pose of all bones from that of one side. */
static bool pose_from_side(const sbfi_limb_symmetry *s, double plane, int side, const sbfi_limb_fit *half,
    sbfi_limb_fit *f, sbfi_arena *arena) {
  double(*turns)[4] = sbfi_arena_allocate(arena, (size_t)f->bone_count + 1, sizeof *turns);
  bool *is_moved = sbfi_arena_allocate(arena, (size_t)f->bone_count + 1, sizeof *is_moved);
  if (!turns || !is_moved) return false;
  for (uint32_t b = 0; b < f->bone_count; b++) {
    static const double none[4] = {0, 0, 0, 1};
    int32_t parent = f->bones[b].parent, twin = s->twins[b];
    memcpy(turns[b], none, sizeof none);
    f->motions[b] = half->motions[b];
    f->is_rotated[b] = half->is_rotated[b];
    if (s->sides[b] == -side && twin == SBF_NONE && parent != SBF_NONE) f->motions[b] = f->motions[parent];
    if (s->sides[b] != -side || twin == SBF_NONE) continue;
    sbfi_matrix own = motion_to_twin(s, b, plane, parent == SBF_NONE ? none : turns[parent], turns[b]);
    sbfi_matrix motion = mirrored_motion(&half->motions[twin], plane);
    f->motions[b] = sbfi_matrix_multiply(&motion, &own);
    is_moved[b] = parent != SBF_NONE && is_moved[parent];
    bool turns_itself =
        half->is_rotated[twin] || 1 - turns[b][3] * turns[b][3] > 0.25 * MIN_ANGLE * MIN_ANGLE;
    f->is_rotated[b] = turns_itself && !is_moved[b];
    is_moved[b] = is_moved[b] || turns_itself;
  }
  sbfi_limb_fit_update_lines(f, half->offset);
  return true;
}

bool sbfi_limb_symmetry_search(sbfi_limb_symmetry *s, double plane, int side, const sbfi_body_core *core,
    sbfi_limb_fit *f, sbfi_arena *arena) {
  sbfi_limb_fit *half = sbfi_arena_allocate(arena, 1, sizeof *half);
  bool *middle = sbfi_arena_allocate(arena, (size_t)s->r->c->asset->bones.count + 1, sizeof *middle);
  sbfi_bone_lines own;
  if (!half || !middle || !copy_lines(s, side, &own, arena) ||
      !sbfi_limb_fit_begin(half, s->r, &own, core, arena) ||
      !sbfi_limb_fit_begin(f, s->r, s->lines, core, arena))
    return false;
  for (uint32_t k = 0; k < s->lines->count; k++) {
    uint32_t bone = s->lines->at[k].child;
    if (!is_middle(s, bone)) continue;
    middle[bone] = true;
    half->motions[bone] = translation((sbfi_d3){plane - (double)half->bones[bone].head.x, 0, 0});
  }
  half->is_middle = middle;
  fold_core(s, plane, side, &half->core);
  sbfi_limb_fit_update_lines(half, (sbfi_d3){0, 0, 0});
  sbfi_limb_fit_search(half);
  return pose_from_side(s, plane, side, half, f, arena);
}
