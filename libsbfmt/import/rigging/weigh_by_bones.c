/* Computes weights from the bones alone, for points without other weights. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "build/weights/weights.h"
#include "import/rigging/align.h"
#include "import/rigging/weigh.h"
#include "mechanics/vector.h"
#include "motion/retargeting.h"

/* Objects farther away than this fraction of the rig's size are not part of the character. */
static const double MARGIN = 0.15;
/* Objects larger than this fraction of the rig's size may be another character, so they must contain a
 * bone. */
static const double LARGE = 0.6;

/* If the rig has skins, only their joints deform anything. */
static bool *find_deforming(const sbfi_rigging *r) {
  bool any = false,
       *deforming = sbfi_arena_allocate(&r->c->scratch, r->c->asset->bones.count + 1, sizeof *deforming);
  for (uint32_t m = 0; deforming && m < r->rig.scene->mesh_count; m++)
    for (uint32_t i = r->rig.mesh_starts[m];
         r->rig.scene->meshes[m].skin.joint_count && i < r->rig.mesh_starts[m + 1]; i++)
      for (uint32_t k = 0; k < SBFI_MAX_INFLUENCES && r->rig_weights[i].at[k].weight > 0; k++)
        any = deforming[r->c->bone_of_node[r->rig_weights[i].at[k].node]] = true;
  return any ? deforming : NULL;
}

/* Finds left and right limbs by name. */
static int8_t *find_sides(const sbfi_rigging *r) {
  const sbf_bone_list bones = r->c->asset->bones;
  int8_t *sides = sbfi_arena_allocate(&r->c->scratch, (size_t)bones.count + 1, sizeof *sides);
  for (uint32_t b = 0; sides && b < bones.count; b++) sides[b] = (int8_t)sbfi_name_side(bones.at[b].name);
  return sides;
}

/* --- Objects beside the rig ---------------------------------------------------------------------------- */

typedef struct box {
  sbfi_d3 low, high;
} box;

static void widen(box *b, sbf_vec3 at) {
  sbfi_d3 p = sbfi_d3_of(at);
  b->low = (sbfi_d3){fmin(b->low.x, p.x), fmin(b->low.y, p.y), fmin(b->low.z, p.z)};
  b->high = (sbfi_d3){fmax(b->high.x, p.x), fmax(b->high.y, p.y), fmax(b->high.z, p.z)};
}

static bool holds(const box *b, sbfi_d3 p, double margin) {
  return p.x >= b->low.x - margin && p.y >= b->low.y - margin && p.z >= b->low.z - margin &&
         p.x <= b->high.x + margin && p.y <= b->high.y + margin && p.z <= b->high.z + margin;
}

static double size_of(const box *b) {
  return sbfi_d3_length(sbfi_d3_sub(b->high, b->low));
}

/* Whether a joint is within a margin of the object's box; a hat has a joint beside it. */
static bool is_near_bones(const sbf_bone_list bones, const box *object, double margin) {
  for (uint32_t b = 0; b < bones.count; b++)
    if (holds(object, sbfi_d3_of(bones.at[b].head), margin)) return true;
  return false;
}

/* Reports several characters in one input: the rig is that of one. */
static void report_separated(const sbfi_rigging *r, const sbfi_scene_surface *moved) {
  const sbf_bone_list bones = r->c->asset->bones;
  const sbfi_d3 min = {-INFINITY, -INFINITY, -INFINITY}, max = {INFINITY, INFINITY, INFINITY};
  box rig = {max, min};
  for (uint32_t b = 0; b < bones.count; b++) widen(&rig, bones.at[b].head);
  double size = size_of(&rig);
  for (uint32_t m = 0; m < r->input.scene->mesh_count; m++) {
    box object = {max, min};
    uint32_t count = 0;
    for (uint32_t i = r->input.mesh_starts[m]; i < r->input.mesh_starts[m + 1]; i++) {
      widen(&object, moved->mesh.positions.at[i]);
      count += r->sources[i] == SBFI_WEIGHTS_COMPUTED;
    }
    double margin = size_of(&object) < LARGE * size ? MARGIN * size : 0;
    if (!count || is_near_bones(bones, &object, margin)) continue;
    r->separated[m] = true;
    sbfi_convert_warn(r->c, SBF_CODE_RIG_OBJECT_APART,
        "no bone of %s is inside or near the object '%.60s': if it is another character, convert it "
        "separately with its own rig; otherwise assign it to a bone with --shell",
        r->rig.scene->file, r->names[m]);
  }
}

/* --- Rigs of other characters -------------------------------------------------------------------------- */

enum { NAMED = 4 };

/* Bones that are inside but nearest to no point move no skin: limbs inside the trunk of a body without
 * such limbs. They count as outside. */
static sbf_status check_idle_bones(const sbfi_rigging *r, const sbfi_weights *computed) {
  char names[200] = "";
  double idle = 0, last = INFINITY;
  for (uint32_t b = 0; b < computed->bone_count; b++) idle += (double)computed->idle_lengths[b];
  double inside = fmin(r->alignment.inside, computed->figures.inside), fraction = inside * (1 - idle);
  if (!(inside > 0) || fraction >= SBFI_MIN_BONES_INSIDE) return SBF_OK;
  for (int n = 0; n < NAMED; n++) { /* the longest first; only one of equals */
    uint32_t best = UINT32_MAX;
    for (uint32_t b = 0; b < computed->bone_count; b++) {
      double length = (double)computed->idle_lengths[b];
      if (length > 0 && length < last &&
          (best == UINT32_MAX || length > (double)computed->idle_lengths[best]))
        best = b;
    }
    if (best == UINT32_MAX) break;
    last = (double)computed->idle_lengths[best];
    size_t used = strlen(names);
    snprintf(names + used, sizeof names - used, "%s'%.40s'", n ? ", " : "", r->c->asset->bones.at[best].name);
  }
  if (!sbfi_show_misfit(r, &r->alignment.to_asset)) return sbfi_convert_no_memory(r->c);
  return sbfi_diagnose(r->c->error, SBF_CODE_IMPORT_RIG_OUTSIDE,
      "only %.0f %% of the bones' length is inside the mesh near some of its surface; %.0f %% is deep "
      "inside, where other bones are nearer to the surface: %s; use this character's rig, or state --unit, "
      "--up and --forward",
      100 * fraction, 100 * idle, names);
}

/* Many bones span most of their body. A few may not, but then they are near its middle. A rig of another
 * character covers a part of the input, or is off the middle of most of it. */
enum { SEVERAL = 10 };
static const double MIN_EXTENT = 0.75, MIN_FAR_EXTENT = 0.9, MIN_OF_FEW = 0.4, MAX_DISTANCE = 2.2,
                    MAX_DISTANCE_OF_SEVERAL = 3;

static bool is_of_another(const sbfi_weights_figures *f) {
  bool several = f->deforming_count >= SEVERAL;
  return f->bone_extent < (several ? MIN_EXTENT : MIN_OF_FEW) ||
         (f->bone_extent < MIN_FAR_EXTENT &&
             f->median_distance > (several ? MAX_DISTANCE_OF_SEVERAL : MAX_DISTANCE));
}

static sbf_status check_extent(const sbfi_rigging *r, const sbfi_weights *computed) {
  const sbfi_weights_figures *f = &computed->figures;
  if (!(r->alignment.inside > 0) || r->c->options->rigging.weights || !is_of_another(f)) return SBF_OK;
  if (!sbfi_show_misfit(r, &r->alignment.to_asset)) return sbfi_convert_no_memory(r->c);
  return sbfi_diagnose(r->c->error, SBF_CODE_RIG_MISFIT,
      "the bones of %s are inside the mesh, but extend over only %.0f %% of its length, and half of the "
      "surface is farther from them than %.1f times half its thickness: use this character's rig, or "
      "--weights compute if it is right",
      r->rig.scene->file, 100 * f->bone_extent, f->median_distance);
}

/* Relative tolerance between a scale and a unit. */
static const double NEAR_UNIT = 0.05;

static bool is_near(double scale, double unit) {
  return fabs(scale / unit - 1) <= NEAR_UNIT;
}

/* Whether the input was scaled by a unit, stated or usual, instead of being fitted to the bones. */
static bool is_scaled_by_unit(const sbfi_rigging *r) {
  double scale = sbfi_similarity_scale(&r->alignment.to_asset);
  bool found = is_near(scale, sbfi_similarity_scale(&r->c->to_asset));
  for (uint32_t i = 0; i < SBFI_USUAL_UNITS; i++) found |= is_near(scale, sbfi_usual_units[i].unit_m);
  return found;
}

/* Whether objects match the rig's by name: they aligned the whole input. */
static bool has_parent_nodes(const sbfi_rigging *r) {
  for (uint32_t m = 0; m < r->input.scene->mesh_count; m++)
    if (r->parent_nodes[m] != SBF_NONE) return true;
  return false;
}

/* The bones of a fish also fit a caterpillar of equal length, so a rig with a mesh must agree in size. If
 * the units agree it may be intended, as for two characters by one author. */
static sbf_status check_other_mesh(const sbfi_rigging *r) {
  if (!(r->mean_gap > 0) || r->c->options->rigging.weights || has_parent_nodes(r)) return SBF_OK;
  if (is_scaled_by_unit(r)) {
    char lie[60] = ""; /* empty if the rig has no two joints to interpolate */
    if (r->alignment.inside > 0)
      snprintf(lie, sizeof lie, " (%.0f %% of them inside the input)", 100 * r->alignment.inside);
    sbfi_convert_warn(r->c, SBF_CODE_RIG_OTHER_MESH,
        "the mesh of %s is not like the input: after alignment, they are %.0f %% of the mesh's size apart; "
        "its bones%s may belong to another character; use the rig of this character, or --weights compute if "
        "it is right",
        r->rig.scene->file, 100 * r->mean_gap, lie);
    return SBF_OK;
  }
  if (!sbfi_show_misfit(r, &r->alignment.to_asset)) return sbfi_convert_no_memory(r->c);
  return sbfi_diagnose(r->c->error, SBF_CODE_RIG_MISFIT,
      "the mesh of %s is not like the input: after alignment, they are %.0f %% of the mesh's size apart; its "
      "bones are inside the input only if that is scaled by %.3g, which is not a usual unit; use the rig of "
      "this character, or state --unit, or --weights compute to use these bones",
      r->rig.scene->file, 100 * r->mean_gap, sbfi_similarity_scale(&r->alignment.to_asset));
}

sbf_status sbfi_weigh_by_bones(sbfi_rigging *r, const sbfi_scene_surface *moved) {
  sbfi_weights computed;
  sbfi_weights_input in = {.allocator = &r->c->scratch.allocator,
      .points = moved->mesh.positions.at,
      .point_count = moved->mesh.positions.count,
      .bones = r->c->asset->bones.at,
      .bone_count = r->c->asset->bones.count,
      .sides = find_sides(r),
      .is_deforming = find_deforming(r)};
  in.triangles = (const uint32_t(*)[3])sbfi_surface_triangles(moved, &in.triangle_count, &r->c->scratch);
  if (!in.triangles || !in.sides) return sbfi_convert_no_memory(r->c);
  sbf_status status = sbfi_compute_weights(&in, &computed, r->c->error);
  if (status == SBF_OK) status = check_idle_bones(r, &computed);
  if (status == SBF_OK) status = check_extent(r, &computed);
  if (status == SBF_OK) status = check_other_mesh(r);
  for (uint32_t i = 0; status == SBF_OK && i < in.point_count; i++) {
    if (r->sources[i] != SBFI_WEIGHTS_NONE) continue;
    for (int k = 0; k < SBFI_WEIGHTS_PER_POINT; k++)
      sbfi_influences_add(
          &r->weights[i], r->c->node_of_bone[computed.joints[i][k]], (double)computed.weights[i][k]);
    sbfi_influences_finish(&r->weights[i]);
    r->sources[i] = SBFI_WEIGHTS_COMPUTED;
  }
  if (status == SBF_OK)
    sbfi_convert_warn(r->c, SBF_CODE_IMPORT_WEIGHTS_COMPUTED,
        "weights were computed from %u bones: %u of %u shells move with one bone each, %u bones move no "
        "point; assign a shell to another bone with --shell",
        in.bone_count, computed.figures.rigid_shell_count, computed.figures.shell_count,
        computed.figures.unused_bone_count);
  if (status == SBF_OK) report_separated(r, moved);
  sbfi_weights_free(&computed);
  return status;
}
