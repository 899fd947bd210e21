/* Aligns an input with a rig whose mesh is in another pose, limb by limb.
 *
 * The input already overlaps a part of the rig. First rotates limbs that do not overlap onto it, then
 * optimizes all joints together. If nearly all of both surfaces match, the rig takes that pose: its joints
 * move to the input's limbs, and its skin is bound to the input's shape. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "import/rigging/align.h"
#include "import/rigging/moved_bones.h"
#include "import/rigging/pose_fit.h"

enum { PASSES = 4, MAX_NAMED = 8 };

/* Fractions of both surfaces without a match: minimum that suggests another pose; acceptable result;
 * result that ends the search; maximum left by a later pass, relative to before; maximum left by the first
 * pass. */
static const double POSED = 0.06, WELL = 0.06, FITTED = 0.01, BETTER = 0.8, HOPELESS = 0.5;
/* For each surface: maximum unmatched fraction, absolute and relative to before; unmatched fraction of the
 * input that is reported. */
static const double FITTING = 0.12, FEWER = 0.5, DOUBTFUL = 0.04;
/* Relative tolerance for a usual transform. */
static const double USUAL = 0.1;
/* Maximum median distance of the input's surface as a fraction of the size. */
static const double NEAR = 0.01;
/* Maximum distance of correspondences in passes after the first, as a fraction of the size. */
static const double LATER_WITHIN = 0.05;
/* Rotations below REPORTED, rad, are not reported. If none exceeds MIN_ROTATION, the input has the pose of
 * the rig's mesh. */
static const double REPORTED = 0.087, MIN_ROTATION = 0.17;

static bool apply_pose(sbfi_rigging *r, const sbfi_pose_fit *f) {
  sbfi_arena *arena = &r->c->scratch;
  sbf_vec3 *positions =
      sbfi_arena_copy(arena, f->posed.mesh.positions.at, f->posed.mesh.positions.count, sizeof *positions);
  if (!positions || !sbfi_rig_move_bones(r, f->motions)) return false;
  const sbfi_scene_surface bound = r->rig; /* uses the scene of moved nodes */
  if (!sbfi_surface_with_positions(&r->rig, &bound, positions, arena)) return false;
  r->alignment.to_asset = f->to_asset;
  r->alignment.is_stated = memcmp(&f->to_asset, &r->c->to_asset, sizeof f->to_asset) == 0;
  return true;
}

/* --- What was found ------------------------------------------------------------------------------------ */

static double rotation_of(const sbfi_pose_fit *f, uint32_t bone) {
  return 2 * asin(fmin(0.5 * sbfi_d3_length(sbfi_pose_fit_rotation_vector(f, bone)), 1));
}

/* Lists the largest rotations first. */
static void report_pose(const sbfi_pose_fit *f, const sbfi_pose_gaps *gaps) {
  char text[600] = "";
  double last = INFINITY;
  uint32_t named = 0, count = 0;
  for (uint32_t b = 0; b < f->bone_count; b++) count += rotation_of(f, b) >= REPORTED;
  for (; named < MAX_NAMED; named++) {
    uint32_t widest = UINT32_MAX;
    for (uint32_t b = 0; b < f->bone_count; b++) {
      double angle = rotation_of(f, b);
      if (angle >= REPORTED && angle < last && (widest == UINT32_MAX || angle > rotation_of(f, widest)))
        widest = b;
    }
    if (widest == UINT32_MAX) break;
    last = rotation_of(f, widest);
    size_t used = strlen(text);
    snprintf(text + used, sizeof text - used, "%s'%.40s' by %.0f degrees", named ? ", " : "",
        f->bones[widest].name, last * 57.29577951308232);
  }
  size_t used = strlen(text);
  if (count > named) snprintf(text + used, sizeof text - used, " and %u more by less", count - named);
  sbfi_convert_warn(f->r->c, SBF_CODE_RIG_ALIGNED,
      "the input has another pose than the mesh of %s: bones were rotated with their children to match it, "
      "%s",
      f->r->rig.scene->file, text);
  if (gaps->input_unmatched > DOUBTFUL)
    sbfi_convert_warn(f->r->c, SBF_CODE_RIG_OTHER_MESH,
        "in that pose %.0f %% of the input's surface is still away from the mesh of %s: check its limbs in "
        "--report; if they follow wrong bones, use an input in the pose of the rig's mesh",
        100 * gaps->input_unmatched, f->r->rig.scene->file);
}

static double unmatched(const sbfi_pose_gaps *gaps) {
  return gaps->input_unmatched + gaps->rig_unmatched;
}

/* Repeats passes while they reduce the gaps; stores the remaining gaps. */
static bool fit(sbfi_pose_fit *f, bool is_free, sbfi_pose_gaps *gaps) {
  for (int pass = 0; pass < PASSES && unmatched(gaps) > FITTED; pass++) {
    double last = unmatched(gaps);
    if (!sbfi_pose_search_limbs(f) ||
        !sbfi_pose_fit_joints(f, pass ? LATER_WITHIN : SBFI_MAX_GAP, is_free && pass > 0))
      return false;
    *gaps = sbfi_pose_fit_gaps(f);
    if (unmatched(gaps) > (pass ? BETTER * last : HOPELESS)) break;
  }
  return true;
}

/* Starts from a usual unit, axes and no offset if the alignment is close to them: shapes in different
 * poses determine the overall position only roughly. */
static bool fit_from_usual(const sbfi_rigging *r, sbfi_pose_fit *f, sbfi_arena *arena, sbfi_pose_gaps *gaps) {
  sbfi_rigging usual = *r;
  sbfi_pose_fit other;
  usual.alignment.to_asset = sbfi_similarity_snapped(&r->alignment.to_asset, r->rig.size, USUAL);
  if (memcmp(&usual.alignment.to_asset, &r->alignment.to_asset, sizeof r->alignment.to_asset) == 0 ||
      !sbfi_alignment_allowed(r, &usual.alignment.to_asset))
    return true;
  bool good = sbfi_pose_fit_begin(&other, &usual, arena);
  sbfi_pose_gaps found = {0};
  if (good) found = sbfi_pose_fit_gaps(&other);
  if (good) good = fit(&other, true, &found);
  bool better = good && unmatched(&found) < unmatched(gaps);
  sbfi_pose_fit_end(better ? f : &other);
  if (!better) return good;
  *f = other;
  f->r = r;
  *gaps = found;
  return true;
}

static double widest_rotation(const sbfi_pose_fit *f) {
  double widest = 0;
  for (uint32_t b = 0; b < f->bone_count; b++) widest = fmax(widest, rotation_of(f, b));
  return widest;
}

static bool is_found(const sbfi_pose_fit *f, const sbfi_pose_gaps *before, const sbfi_pose_gaps *after) {
  return after->input_unmatched < FITTING && after->rig_unmatched < FITTING && after->median < NEAR &&
         unmatched(after) < FEWER * unmatched(before) && widest_rotation(f) >= MIN_ROTATION;
}

bool sbfi_align_pose(sbfi_rigging *r, bool *found) {
  sbfi_arena scratch;
  sbfi_pose_fit f;
  bool by_points = r->alignment.matched > 0;
  *found = false;
  if (!r->rig.mesh.polygon_sizes.count || !r->input.mesh.polygon_sizes.count) return true;
  sbfi_arena_init(&scratch, &r->c->scratch.allocator, 0);
  bool good = sbfi_pose_fit_begin(&f, r, &scratch);
  sbfi_pose_gaps before = {0}, after;
  if (good) before = sbfi_pose_fit_gaps(&f);
  if (good && unmatched(&before) > POSED) {
    after = before;
    good = fit(&f, !by_points, &after);
    if (good && !by_points && unmatched(&after) > WELL) good = fit_from_usual(r, &f, &scratch, &after);
    *found = good && is_found(&f, &before, &after);
    if (*found) report_pose(&f, &after);
    if (*found) good = apply_pose(r, &f);
  }
  sbfi_pose_fit_end(&f);
  sbfi_arena_free(&scratch);
  return good;
}
