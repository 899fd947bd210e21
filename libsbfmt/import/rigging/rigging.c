/* Selects how each object gets its weights. */
#include "import/rigging/rigging.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "import/rigging/align.h"
#include "import/rigging/clip_moments.h"
#include "import/rigging/pose_fit.h"
#include "import/rigging/report_separated.h"
#include "import/rigging/rig_pose.h"
#include "import/rigging/rigged_scene.h"
#include "import/rigging/skin_pieces.h"
#include "import/rigging/weigh.h"
#include "mechanics/vector.h"

typedef enum weights_mode {
  MODE_ANY,
  MODE_NAMED,
  MODE_MATCH,
  MODE_TRANSFER,
  MODE_COMPUTE,
  MODE_FILE
} weights_mode;

static weights_mode mode_of(const char *weights) {
  static const char *const words[] = {"named", "match", "transfer", "compute"};
  if (!weights) return MODE_ANY;
  for (int i = 0; i < 4; i++)
    if (strcmp(weights, words[i]) == 0) return (weights_mode)(i + 1);
  return MODE_FILE;
}

static bool prepare(sbfi_rigging *r) {
  sbfi_conversion *c = r->c;
  sbfi_matrix own = sbfi_matrix_identity();
  if (!sbfi_surface_gather(&r->input, c->scene, &own, &c->scratch) ||
      !sbfi_surface_gather(&r->rig, c->rig, &c->rig_to_asset, &c->scratch))
    return false;
  uint32_t points = r->input.mesh.positions.count, meshes = c->scene->mesh_count;
  r->rig_weights = sbfi_rig_weights(c, &r->rig);
  r->weights = sbfi_arena_allocate(&c->scratch, points + 1, sizeof *r->weights);
  r->sources = sbfi_arena_allocate(&c->scratch, points + 1, sizeof *r->sources);
  r->parent_nodes = sbfi_arena_allocate(&c->scratch, meshes, sizeof *r->parent_nodes);
  r->matched_nodes = sbfi_arena_allocate(&c->scratch, meshes, sizeof *r->matched_nodes);
  r->names = sbfi_arena_allocate(&c->scratch, meshes, sizeof *r->names);
  r->separated = sbfi_arena_allocate(&c->scratch, meshes, sizeof *r->separated);
  r->is_reversed = sbfi_arena_allocate(&c->scratch, meshes, sizeof *r->is_reversed);
  if (!r->rig_weights || !r->weights || !r->sources || !r->parent_nodes || !r->matched_nodes || !r->names ||
      !r->separated || !r->is_reversed)
    return false;
  for (uint32_t m = 0; m < meshes; m++) {
    r->parent_nodes[m] = r->matched_nodes[m] = SBF_NONE;
    r->names[m] = c->scene->nodes[c->scene->meshes[m].node].name;
  }
  r->alignment = (sbfi_alignment){.to_asset = c->to_asset, .is_stated = true};
  r->bound = r->rig;
  return true;
}

static uint32_t count_points(const sbfi_rigging *r, sbfi_weight_source source) {
  uint32_t count = 0;
  for (uint32_t i = 0; i < r->input.mesh.positions.count; i++) count += r->sources[i] == source;
  return count;
}

static void report_alignment(const sbfi_rigging *r) {
  char pose[120] = "at the time it was saved, in mid-motion";
  if (r->alignment.pose_clip)
    snprintf(pose, sizeof pose, "%.3f s after the start of its clip '%.60s'", r->alignment.pose_s,
        r->alignment.pose_clip->name);
  if (r->alignment.pose_worlds)
    sbfi_convert_warn(r->c, SBF_CODE_RIG_ALIGNED,
        "the input has the pose of %s %s: it was moved back to the bind pose of the rig's skin",
        r->rig.scene->file, pose);
  if (r->alignment.is_stated) return;
  double size = r->rig.size > 0 ? r->rig.size : r->input.size * sbfi_similarity_scale(&r->alignment.to_asset);
  sbfi_similarity_text text = sbfi_similarity_describe(&r->alignment.to_asset, size);
  if (text.at[0])
    sbfi_convert_warn(r->c, SBF_CODE_RIG_ALIGNED,
        "the input was aligned with the rig: %s; change this with --unit, --up and --forward", text.at);
}

static const char *const SOURCE_TEXTS[SBFI_WEIGHTS_SOURCES] = {[SBFI_WEIGHTS_NONE] = "have none",
    [SBFI_WEIGHTS_NAMED] = "from the names of objects or bones",
    [SBFI_WEIGHTS_MATCHED] = "from the same positions of the rig's mesh",
    [SBFI_WEIGHTS_TRANSFERRED] = "from the nearest surface of the rig's mesh",
    [SBFI_WEIGHTS_ATTACHED] = "from the bone that their piece touches",
    [SBFI_WEIGHTS_COMPUTED] = "computed from the bones",
    [SBFI_WEIGHTS_FROM_FILE] = "from the weights file"};

static void report_weights(const sbfi_rigging *r) {
  char text[400] = "";
  for (int s = 0; s < SBFI_WEIGHTS_SOURCES; s++) {
    uint32_t count = count_points(r, (sbfi_weight_source)s);
    size_t used = strlen(text);
    if (count) snprintf(text + used, sizeof text - used, "%s%u %s", used ? ", " : "", count, SOURCE_TEXTS[s]);
  }
  sbfi_convert_warn(r->c, SBF_CODE_RIG_WEIGHTS, "weights of %u points: %s; change this with --weights",
      r->input.mesh.positions.count, text);
}

/* --- Objects that nothing else moves ------------------------------------------------------------------- */

/* Bone whose segment is nearest to a point; the last if equal, because points beyond a bone's end belong
 * to its child. */
static int32_t nearest_bone(const sbf_asset *asset, sbfi_d3 p) {
  int32_t best = SBF_NONE;
  double best_squared = INFINITY;
  for (uint32_t i = 0; i < asset->bones.count; i++) {
    const sbf_bone *bone = &asset->bones.at[i];
    const sbf_quat q = bone->rotation;
    sbfi_d3 axis = {
        2 * (q.x * q.y - q.w * q.z), 1 - 2 * (q.x * q.x + q.z * q.z), 2 * (q.y * q.z + q.w * q.x)};
    sbfi_d3 from_head = sbfi_d3_sub(p, sbfi_d3_of(bone->head));
    double along = fmin(fmax(sbfi_d3_dot(from_head, axis), 0), (double)bone->length);
    sbfi_d3 separation = sbfi_d3_sub(from_head, sbfi_d3_scale(axis, along));
    double squared = sbfi_d3_dot(separation, separation);
    if (squared > best_squared) continue;
    best_squared = squared;
    best = (int32_t)i;
  }
  return best;
}

static void assign_nearest_bone(sbfi_rigging *r, const sbfi_scene_surface *moved, uint32_t mesh) {
  uint32_t from = moved->mesh_starts[mesh], to = moved->mesh_starts[mesh + 1];
  sbfi_d3 middle = {0, 0, 0};
  for (uint32_t i = from; i < to; i++) {
    if (r->sources[i] != SBFI_WEIGHTS_NONE) return;
    middle = sbfi_d3_add(middle, sbfi_d3_of(moved->mesh.positions.at[i]));
  }
  if (to > from) middle = sbfi_d3_scale(middle, 1.0 / (to - from));
  const sbfi_scene_mesh *own = &r->input.scene->meshes[mesh];
  if (r->c->rig == r->c->scene && !own->skin.joint_count && r->c->bone_of_node[own->node] != SBF_NONE) {
    r->parent_nodes[mesh] = own->node;
    return;
  }
  int32_t bone = nearest_bone(r->c->asset, middle);
  r->parent_nodes[mesh] = (int32_t)r->c->node_of_bone[bone];
  sbfi_convert_warn(r->c, SBF_CODE_RIG_SECTION_GUESSED,
      "the name of object '%s' matches no bone of the rig: it was assigned to the nearest, '%s'; if that is "
      "wrong, name it like its node in the rig",
      r->names[mesh], r->c->asset->bones.at[bone].name);
}

/* --- Which way fits ------------------------------------------------------------------------------------ */

/* Maximum distance of similar surfaces as a fraction of the rig's size. */
static const double ALIKE = 0.03;
/* Maximum median distance of points for a mesh similar to the rig's, as a fraction of the rig's size. */
static const double ALIKE_MEDIAN = 0.01;
/* Bounds for an edited version of the rig's mesh: maximum median distance as a fraction of the size,
 * maximum fraction of the surface without a match. Outside them it may be another character's mesh, unless
 * at least this fraction of points equals the rig's. */
static const double SAME_MEDIAN = 0.0015, MAX_AWAY = 0.02, SAME_MATCHED = 0.5;
/* Minimum fraction of points near the rig's surface for a transfer of weights; the same if the caller
 * requests it. */
static const double MIN_NEAR = 0.6, MIN_FORCED = 0.25;
/* Minimum fraction of points at the rig's points for --weights match. */
static const double MIN_MATCHED = 0.999;
/* Fraction of matched points from which no other pose is tried; minimum improvement by another pose. */
static const double MATCHED_WELL = 0.95, MATCHED_BETTER = 1e-9;

/* Aligns the input with the rig in another pose, which stays if more points match. */
static bool try_pose(sbfi_rigging *r, const sbfi_matrix *worlds, bool *found) {
  sbfi_rigging posed = *r;
  bool found_posed;
  if (!worlds || !sbfi_pose_surface(r, worlds, &posed.rig) || !sbfi_align_by_points(&posed, &found_posed))
    return false;
  if (!found_posed || (*found && posed.alignment.matched < r->alignment.matched + MATCHED_BETTER))
    return true;
  *r = posed;
  r->alignment.pose_worlds = worlds;
  *found = true;
  return true;
}

static bool is_found_well(const sbfi_rigging *r, bool found) {
  return found && r->alignment.matched >= MATCHED_WELL;
}

/* Tries times of the rig's clips, because programs export the frame that they show. */
static bool align_by_clips(sbfi_rigging *r, const sbfi_rigging *bound, bool *found) {
  sbfi_clip_moment poses[SBFI_MAX_CLIP_MOMENTS];
  uint32_t count;
  if (!sbfi_clip_moments_find(bound, poses, &count)) return false;
  for (uint32_t i = 0; i < count; i++) {
    sbfi_rigging posed = *bound;
    bool found_posed = *found;
    posed.alignment = r->alignment;
    posed.alignment.pose_worlds = NULL;
    if (!try_pose(&posed, sbfi_clip_moment_worlds(bound, &poses[i]), &found_posed)) return false;
    if (!posed.alignment.pose_worlds) continue;
    *r = posed;
    r->alignment.pose_clip = poses[i].clip;
    r->alignment.pose_s = poses[i].time_s;
    *found = true;
  }
  return true;
}

/* Aligns by shared points with the rig's meshes in the bind pose, the saved pose, or a pose of a clip. */
static bool align_by_points(sbfi_rigging *r, bool *found) {
  const sbfi_rigging bound = *r;
  const sbfi_matrix *saved = r->rig.scene->saved_worlds;
  if (!sbfi_align_by_points(r, found)) return false;
  if (is_found_well(r, *found) || !r->rig.mesh.positions.count) return true;
  if (saved && !try_pose(r, saved, found)) return false;
  return is_found_well(r, *found) || align_by_clips(r, &bound, found);
}

/* Aligns by shape, in the bind pose or the saved pose. */
static bool align_by_shape(sbfi_rigging *r, double *error) {
  sbfi_rigging saved = *r;
  const sbfi_matrix *worlds = r->rig.scene->saved_worlds;
  double saved_error;
  if (!sbfi_align_by_shape(r, error)) return false;
  if (!worlds || !r->rig.mesh.positions.count) return true;
  if (!sbfi_pose_surface(r, worlds, &saved.rig) || !sbfi_align_by_shape(&saved, &saved_error)) return false;
  if (saved_error >= *error) return true;
  *r = saved;
  *error = saved_error;
  r->alignment.pose_worlds = worlds;
  return true;
}

static bool rig_has_weights(const sbfi_rigging *r) {
  for (uint32_t i = 0; i < r->rig.mesh.positions.count; i++)
    if (r->rig_weights[i].at[0].weight > 0) return true;
  return false;
}

static bool is_transferred(const sbfi_rigging *r, uint32_t point) {
  for (uint32_t m = 0; m < r->input.scene->mesh_count; m++)
    if (point < r->input.mesh_starts[m + 1]) return r->parent_nodes[m] != SBF_NONE;
  return false;
}

/* Number of points without weights. */
static uint32_t count_open(const sbfi_rigging *r) {
  uint32_t count = 0;
  for (uint32_t i = 0; i < r->input.mesh.positions.count; i++)
    count += r->sources[i] == SBFI_WEIGHTS_NONE && !is_transferred(r, i);
  return count;
}

static sbf_status refuse_match(const sbfi_rigging *r) {
  return sbfi_diagnose(r->c->error, SBF_CODE_RIG_MISFIT,
      "--weights match: %u of %u points of %s match no point of the meshes of %s in any rotation and scale; "
      "use --weights transfer, which takes the nearest surface",
      count_open(r), r->input.mesh.positions.count, r->input.scene->file, r->rig.scene->file);
}

static sbf_status refuse_transfer(const sbfi_rigging *r, double fraction) {
  return sbfi_diagnose(r->c->error, SBF_CODE_RIG_MISFIT,
      "--weights transfer: only %.0f %% of the points of %s are near a surface of %s with weights; use the "
      "rig of this character, or --weights compute",
      100 * fraction, r->input.scene->file, r->rig.scene->file);
}

/* Computes the remaining weights from the bones alone. The alignment must be known. */
static sbf_status weigh_rest(sbfi_rigging *r, const sbfi_scene_surface *moved, weights_mode mode) {
  if ((mode != MODE_ANY && mode != MODE_COMPUTE) || !count_open(r)) return SBF_OK;
  return sbfi_weigh_by_bones(r, moved);
}

/* Transfers weights by proximity if the input is similar to the rig's mesh or the caller requests it. */
static sbf_status weigh_by_surface(
    sbfi_rigging *r, const sbfi_scene_surface *moved, weights_mode mode, bool alike) {
  double fraction = 0, min = mode == MODE_TRANSFER ? MIN_FORCED : MIN_NEAR;
  if ((mode != MODE_ANY && mode != MODE_TRANSFER) || (mode == MODE_ANY && !alike) || !count_open(r))
    return SBF_OK;
  if (rig_has_weights(r) && !sbfi_weigh_by_nearness(r, moved, min, &fraction))
    return sbfi_convert_no_memory(r->c);
  return mode == MODE_TRANSFER && fraction < min ? refuse_transfer(r, fraction) : SBF_OK;
}

/* Unmatched names are only assigned to the nearest bone if other objects have matching names. */
static sbf_status refuse_nameless(const sbfi_rigging *r) {
  return sbfi_diagnose(r->c->error, SBF_CODE_RIG_MISFIT,
      "--weights named: no object of %s has the name of a node or bone of %s; rename the objects, or leave "
      "out --weights",
      r->input.scene->file, r->rig.scene->file);
}

static bool has_named_objects(const sbfi_rigging *r) {
  for (uint32_t m = 0; m < r->input.scene->mesh_count; m++)
    if (r->parent_nodes[m] != SBF_NONE) return true;
  return false;
}

/* Rotates bones, starting from the current alignment: from the saved pose, or the bind pose if the input
 * does not resemble that. */
static bool align_pose(sbfi_rigging *r, weights_mode mode, double error, bool *posed) {
  if ((mode != MODE_ANY && mode != MODE_TRANSFER) || !isfinite(error) || !rig_has_weights(r)) return true;
  if (!r->alignment.pose_worlds) return sbfi_align_pose(r, posed);
  sbfi_rigging bound = *r;
  bound.rig = r->bound;
  bound.alignment = (sbfi_alignment){.to_asset = r->c->to_asset, .is_stated = true};
  if (error < ALIKE) return true;
  if (!sbfi_align_by_shape(&bound, &error) || !sbfi_align_pose(&bound, posed)) return false;
  if (*posed) *r = bound;
  return true;
}

/* Aligns objects without weights: by the rig's own meshes if they are similar, otherwise by its bones. If
 * the objects of an input are named after the rig's, it is aligned already. */
static sbf_status align_rest(sbfi_rigging *r, weights_mode mode, bool *alike) {
  double error = INFINITY, median = 0;
  bool posed = false;
  sbfi_alignment stated = r->alignment;
  sbfi_scene_surface bound = r->rig;
  if (r->c->rig == r->c->scene || mode == MODE_NAMED || mode == MODE_MATCH || !count_open(r)) return SBF_OK;
  if (*alike)
    return r->alignment.matched >= MATCHED_WELL || align_pose(r, mode, 0, &posed)
               ? SBF_OK
               : sbfi_convert_no_memory(r->c);
  if (rig_has_weights(r) && !align_by_shape(r, &error)) return sbfi_convert_no_memory(r->c);
  if (!align_pose(r, mode, error, &posed)) return sbfi_convert_no_memory(r->c);
  if (posed) {
    *alike = true;
    return SBF_OK;
  }
  if (error < ALIKE && !sbfi_median_gap(r, &median)) return sbfi_convert_no_memory(r->c);
  *alike = error < ALIKE && median < ALIKE_MEDIAN;
  if (*alike) return SBF_OK;
  r->alignment = stated;
  r->rig = bound;
  if (isfinite(error)) r->mean_gap = error;
  return mode == MODE_TRANSFER || has_named_objects(r) ? SBF_OK : sbfi_align_by_bones(r);
}

/* Whether the points of a surface sample have weights from a nearby mesh of the rig. */
static bool is_on_rig(const sbfi_rigging *r, const sbfi_surface_sample *s) {
  for (int k = 0; k < 3; k++) {
    uint8_t source = r->sources[s->points[k]];
    if (source != SBFI_WEIGHTS_TRANSFERRED && source != SBFI_WEIGHTS_MATCHED) return false;
  }
  return true;
}

static int compare(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* Warns that a mesh that only resembles the rig's may need its bones elsewhere. */
static bool warn_of_another(const sbfi_rigging *r, weights_mode mode) {
  sbfi_arena scratch;
  sbfi_pose_fit f;
  double gaps[SBFI_POSE_SAMPLES], size = r->rig.size;
  uint32_t count = 0, away_count = 0;
  if (mode != MODE_ANY || r->c->rig == r->c->scene || r->alignment.matched > SAME_MATCHED ||
      !r->rig.mesh.polygon_sizes.count || !r->input.mesh.polygon_sizes.count)
    return true;
  sbfi_arena_init(&scratch, &r->c->scratch.allocator, 0);
  bool good = sbfi_pose_fit_begin(&f, r, &scratch);
  for (uint32_t i = 0; good && i < SBFI_POSE_SAMPLES; i++) {
    sbfi_surface_location near;
    if (!is_on_rig(r, &f.input_samples[i])) continue;
    bool found = sbfi_surface_nearest(&f.posed_finder, f.input_samples[i].position, NULL, size, &near);
    gaps[count] = found ? near.distance / size : 1;
    away_count += gaps[count++] > SBFI_ON_SURFACE;
  }
  qsort(gaps, count, sizeof *gaps, compare);
  double median = count ? gaps[count / 2] : 0;
  if (median > SAME_MEDIAN || away_count > MAX_AWAY * SBFI_POSE_SAMPLES)
    sbfi_convert_warn(r->c, SBF_CODE_RIG_OTHER_MESH,
        "the mesh of %s resembles the input, but half of the input's surface is farther from it than %.2g %% "
        "of its size, and %.0f %% of it farther than %.2g %%: it may belong to another character; use the "
        "rig of this character, or --weights transfer if it is right",
        r->rig.scene->file, 100 * median, 100.0 * away_count / SBFI_POSE_SAMPLES, 100 * SBFI_ON_SURFACE);
  sbfi_pose_fit_end(&f);
  sbfi_arena_free(&scratch);
  return good;
}

/* Warns if a large part of an object is away from the rig's mesh while the rest matches: it may be limbs
 * in another pose. */
static const double MANY_ATTACHED = 0.2;

static void warn_of_attached(const sbfi_rigging *r, weights_mode mode) {
  uint32_t count = r->input.mesh.positions.count, away_count = 0;
  for (uint32_t m = 0; m < r->input.scene->mesh_count; m++) {
    uint32_t attached = 0, matched = 0;
    for (uint32_t i = r->input.mesh_starts[m]; i < r->input.mesh_starts[m + 1]; i++) {
      attached += r->sources[i] == SBFI_WEIGHTS_ATTACHED;
      matched += r->sources[i] == SBFI_WEIGHTS_MATCHED;
    }
    if (matched) away_count += attached;
  }
  if (mode != MODE_ANY || away_count <= MANY_ATTACHED * count) return;
  sbfi_convert_warn(r->c, SBF_CODE_RIG_OTHER_MESH,
      "%u of %u points are away from the mesh of %s, and each of their pieces moves rigidly with the bone "
      "that it touches: if they are limbs in another pose, use an input in the pose of the rig's mesh; if "
      "they are right, use --weights transfer",
      away_count, count, r->rig.scene->file);
}

static sbf_status weigh_objects(
    sbfi_rigging *r, const sbfi_scene_surface *moved, weights_mode mode, bool by_points, bool alike) {
  if (mode == MODE_FILE) return sbfi_weigh_by_file(r, r->c->options->rigging.weights);
  if (by_points && (mode == MODE_ANY || mode == MODE_MATCH) && !sbfi_weigh_by_position(r, moved))
    return sbfi_convert_no_memory(r->c);
  if (mode == MODE_MATCH && count_open(r) > (1 - MIN_MATCHED) * r->input.mesh.positions.count)
    return refuse_match(r);
  sbf_status status = weigh_by_surface(r, moved, mode, alike);
  return status == SBF_OK ? weigh_rest(r, moved, mode) : status;
}

static sbf_status rig_objects(sbfi_rigging *r, weights_mode mode) {
  sbfi_conversion *c = r->c;
  sbfi_scene_surface moved;
  bool by_points = false;
  if (!prepare(r) || (c->rig != c->scene && !align_by_points(r, &by_points)))
    return sbfi_convert_no_memory(c);
  if (mode == MODE_ANY || mode == MODE_NAMED) sbfi_weigh_by_name(r);
  sbf_status status = mode == MODE_ANY ? sbfi_weigh_by_own_skin(r) : SBF_OK;
  bool alike = by_points;
  if (status == SBF_OK) status = sbfi_weigh_shells(r);
  if (status == SBF_OK && mode == MODE_NAMED && !has_named_objects(r) && !r->c->options->rigging.shell_count)
    status = refuse_nameless(r);
  if (status == SBF_OK) status = align_rest(r, mode, &alike);
  if (status != SBF_OK) return status;
  report_alignment(r);
  if (!sbfi_surface_move(&moved, &r->input, &r->alignment.to_asset, &c->scratch))
    return sbfi_convert_no_memory(c);
  status = weigh_objects(r, &moved, mode, by_points, alike);
  if (status != SBF_OK) return status;
  for (uint32_t m = 0; m < c->scene->mesh_count; m++)
    if (r->parent_nodes[m] == SBF_NONE) assign_nearest_bone(r, &moved, m);
  report_weights(r);
  if (alike && !warn_of_another(r, mode)) return sbfi_convert_no_memory(c);
  warn_of_attached(r, mode);
  if (mode != MODE_NAMED && !sbfi_report_separated(r, &moved, alike)) return sbfi_convert_no_memory(c);
  return sbfi_rigged_scene_build(r) ? SBF_OK : sbfi_convert_no_memory(c);
}

/* --weights where there is nothing to choose from. */
static sbf_status refuse_method(const sbfi_conversion *c) {
  return sbfi_diagnose(c->error, SBF_CODE_BAD_CALL,
      c->rig ? "--weights %s is for a skeleton in another file, but %s has its own"
             : "--weights %s needs bones, but %s has none: add --rig FILE",
      c->options->rigging.weights, c->scene->file);
}

sbf_status sbfi_rig_input(sbfi_conversion *c) {
  weights_mode mode = mode_of(c->options->rigging.weights);
  bool own_rig = c->rig == c->scene;
  if (mode != MODE_ANY && (!c->rig || (own_rig && mode < MODE_COMPUTE))) return refuse_method(c);
  if (c->options->rigging.shell_count && (!c->rig || own_rig))
    return sbfi_diagnose(c->error, SBF_CODE_BAD_CALL,
        "'%s' cannot be assigned to a bone: --shell needs a skeleton in another file, --rig FILE",
        c->options->rigging.shells[0].group);
  if (!c->rig || c->asset->bones.count == 0 || c->scene->mesh_count == 0) return SBF_OK;
  if (own_rig && mode == MODE_ANY) return SBF_OK;
  if (!own_rig && (mode == MODE_ANY || mode == MODE_COMPUTE) && !sbfi_join_skin_pieces(c))
    return sbfi_convert_no_memory(c);
  sbfi_rigging r = {.c = c};
  return rig_objects(&r, mode);
}
