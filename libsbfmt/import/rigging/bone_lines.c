#include "import/rigging/bone_lines.h"

#include <stdlib.h>

#include "build/weights/bone_roles.h"

enum { SEVERAL = 10 };

static int compare_lengths(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static void add_line(sbfi_bone_lines *s, const sbf_bone *bones, uint32_t child, bool is_end) {
  uint32_t bone = (uint32_t)bones[child].parent;
  sbfi_d3 from = sbfi_d3_of(bones[bone].head), to = sbfi_d3_of(bones[child].head);
  double length = sbfi_d3_length(sbfi_d3_sub(to, from));
  if (!(length > 0)) return;
  s->at[s->count++] = (sbfi_bone_line){from, to, bone, child, is_end, false, length};
  s->total += length;
}

static bool has_child(const sbf_bone_list *bones, uint32_t bone) {
  for (uint32_t b = bone + 1; b < bones->count; b++)
    if (bones->at[b].parent == (int32_t)bone) return true;
  return false;
}

/* Exporters place the end of a limb's last bone at a distance from their settings. Ends farther than the
 * longest bone of the rig's limbs are moved to the median length, marked by a bone or not. */
static void shorten_ends(const sbfi_rigging *r, const bool *has_skin_points, double *lengths) {
  const sbf_bone_list *bones = &r->c->asset->bones;
  const sbfi_weights_input in = {.bones = bones->at, .bone_count = bones->count};
  uint32_t count = 0;
  for (uint32_t b = 0; b < bones->count; b++) {
    int32_t parent = bones->at[b].parent;
    if (parent == SBF_NONE || !has_skin_points[parent] || !has_skin_points[b] || sbfi_bone_is_on_root(&in, b))
      continue;
    lengths[count++] =
        sbfi_d3_length(sbfi_d3_sub(sbfi_d3_of(bones->at[b].head), sbfi_d3_of(bones->at[parent].head)));
  }
  if (!count) return;
  qsort(lengths, count, sizeof *lengths, compare_lengths);
  double longest = lengths[count - 1], median = lengths[count / 2];
  for (uint32_t b = 0; b < bones->count; b++) {
    sbf_bone *last = (sbf_bone *)(uintptr_t)&bones->at[b]; /* the conversion owns the asset */
    if ((double)last->length > longest && !has_child(bones, b)) last->length = (float)median;
  }
  for (uint32_t b = 0; b < bones->count; b++) {
    int32_t parent = bones->at[b].parent;
    if (!sbfi_bone_is_end(&in, b) || !has_skin_points[parent]) continue;
    sbf_bone *end = (sbf_bone *)(uintptr_t)&bones->at[b];
    sbf_bone *last = (sbf_bone *)(uintptr_t)&bones->at[parent];
    sbfi_d3 from = sbfi_d3_of(last->head), along = sbfi_d3_sub(sbfi_d3_of(end->head), from);
    double length = sbfi_d3_length(along);
    if (!(length > longest)) continue;
    end->head = sbfi_d3_rounded(sbfi_d3_add(from, sbfi_d3_scale(along, median / length)));
    if ((double)last->length > longest) last->length = (float)median;
  }
}

bool sbfi_bone_lines_find(const sbfi_rigging *r, sbfi_bone_lines *s, sbfi_arena *arena) {
  const sbf_bone_list *bones = &r->c->asset->bones;
  *s = (sbfi_bone_lines){0};
  const sbfi_weights_input in = {.bones = bones->at, .bone_count = bones->count};
  bool *has_skin_points = sbfi_arena_allocate(arena, (size_t)bones->count + 1, sizeof *has_skin_points);
  double *lengths = sbfi_arena_allocate(arena, (size_t)bones->count + 1, sizeof *lengths);
  s->at = sbfi_arena_allocate(arena, 2 * (size_t)bones->count, sizeof *s->at);
  if (!s->at || !has_skin_points || !lengths) return false;
  double size = 0;
  for (uint32_t b = 1; b < bones->count; b++)
    size =
        fmax(size, sbfi_d3_length(sbfi_d3_sub(sbfi_d3_of(bones->at[b].head), sbfi_d3_of(bones->at[0].head))));
  const sbfi_weight_mesh space = {.scale = size > 0 ? 1 / size : 1};
  sbfi_bone_roles_find(&in, &space, NULL, has_skin_points);
  shorten_ends(r, has_skin_points, lengths);
  uint32_t joined = 0; /* bones between two bones that have skin */
  for (uint32_t b = 0; b < bones->count; b++)
    joined += bones->at[b].parent != SBF_NONE && has_skin_points[bones->at[b].parent] && has_skin_points[b];
  for (uint32_t b = 0; b < bones->count; b++) {
    int32_t parent = bones->at[b].parent;
    bool is_end = sbfi_bone_is_end(&in, b);
    if (parent == SBF_NONE || !has_skin_points[parent] || (!has_skin_points[b] && !is_end)) continue;
    if (is_end && joined > SEVERAL) continue;
    add_line(s, bones->at, b, is_end);
  }
  for (uint32_t i = 0; i < 2 * s->count; i++) {
    sbfi_d3 p = i % 2 ? s->at[i / 2].to : s->at[i / 2].from;
    s->low = i ? (sbfi_d3){fmin(s->low.x, p.x), fmin(s->low.y, p.y), fmin(s->low.z, p.z)} : p;
    s->high = i ? (sbfi_d3){fmax(s->high.x, p.x), fmax(s->high.y, p.y), fmax(s->high.z, p.z)} : p;
  }
  return true;
}
