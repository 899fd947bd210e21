#include "build/sections/section_blend.h"

#include <string.h>

#include "build/sections/blend_levels.h"

static const double MIN_WEIGHT = 2e-4;

/* Copies the bone weights, which are ascending by bone. */
static sbfi_blend_row *rows_of(const sbfi_skin_union *skin, sbfi_arena *arena) {
  uint32_t points = skin->mesh.positions.count;
  sbfi_blend_row *rows = sbfi_arena_allocate(arena, (size_t)points + 1, sizeof *rows);
  sbfi_blend_weight *all =
      sbfi_arena_allocate(arena, (size_t)skin->bone_weight_begins[points] + 1, sizeof *all);
  if (!rows || !all) return NULL;
  for (uint32_t h = 0; h < skin->bone_weight_begins[points]; h++)
    all[h] = (sbfi_blend_weight){skin->bone_weights[h].bone, skin->bone_weights[h].weight};
  for (uint32_t p = 0; p < points; p++) {
    uint32_t count = skin->bone_weight_begins[p + 1] - skin->bone_weight_begins[p];
    rows[p] = (sbfi_blend_row){all + skin->bone_weight_begins[p], count, count};
  }
  return rows;
}

/* Triangulates polygons as fans if all corners have weights. */
static bool make_triangles(
    sbfi_blend_surface *s, const sbf_polygon_mesh *mesh, const sbfi_topology *t, sbfi_arena *arena) {
  s->triangles = sbfi_arena_allocate(arena, (size_t)mesh->polygon_points.count + 1, sizeof *s->triangles);
  if (!s->triangles) return false;
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; p++) {
    const uint32_t *c = mesh->polygon_points.at + t->corner_begins[p];
    for (uint32_t k = 1; k + 1 < mesh->polygon_sizes.at[p]; k++) {
      if (!s->rows[c[0]].count || !s->rows[c[k]].count || !s->rows[c[k + 1]].count) continue;
      uint32_t *to = s->triangles[s->triangle_count++];
      to[0] = c[0], to[1] = c[k], to[2] = c[k + 1];
    }
  }
  return sbfi_blend_surface_index(s, arena);
}

/* Writes weights above MIN_WEIGHT of changed points. */
static bool write_back(sbfi_skin_union *skin, const sbfi_blend_surface *s, sbfi_arena *arena) {
  uint32_t points = skin->mesh.positions.count, next = 0;
  size_t max = 1;
  for (uint32_t p = 0; p < points; p++) max += s->rows[p].count;
  uint32_t *begins = sbfi_arena_allocate(arena, (size_t)points + 1, sizeof *begins);
  sbfi_bone_weight *bone_weights = sbfi_arena_allocate(arena, max, sizeof *bone_weights);
  if (!begins || !bone_weights) return false;
  for (uint32_t p = 0; p < points; p++) {
    const sbfi_blend_row *r = &s->rows[p];
    double sum = 0;
    begins[p] = next;
    for (uint32_t i = 0; i < r->count; i++) sum += r->at[i].value >= MIN_WEIGHT ? r->at[i].value : 0;
    for (uint32_t i = 0; s->changed[p] && i < r->count; i++)
      if (r->at[i].value >= MIN_WEIGHT)
        bone_weights[next++] = (sbfi_bone_weight){r->at[i].bone, (float)(r->at[i].value / sum)};
    for (uint32_t h = skin->bone_weight_begins[p]; !s->changed[p] && h < skin->bone_weight_begins[p + 1]; h++)
      bone_weights[next++] = skin->bone_weights[h];
  }
  begins[points] = next;
  skin->bone_weight_begins = begins;
  skin->bone_weights = bone_weights;
  return true;
}

bool sbfi_section_blend_smooth(sbfi_skin_union *skin, const sbfi_skin_union *authored, const sbfi_topology *t,
    const sbf_asset *asset, const uint8_t *soft, const uint8_t *fixed, uint32_t *left, uint64_t *checks,
    sbfi_arena *arena) {
  uint32_t points = skin->mesh.positions.count;
  sbfi_blend_surface s = {.bones = asset->bones.at,
      .joints = sbfi_blend_joints_make(&asset->bones, arena),
      .point_count = points,
      .positions = skin->mesh.positions.at,
      .rows = rows_of(skin, arena),
      .before = rows_of(authored, arena),
      .soft = soft,
      .fixed = fixed,
      .changed = sbfi_arena_allocate(arena, (size_t)points + 1, 1)};
  *left = 0;
  bool good = s.joints && s.rows && s.before && s.changed && make_triangles(&s, &skin->mesh, t, arena) &&
              sbfi_blend_levels_relax(&s, left, arena) && write_back(skin, &s, arena);
  if (checks) *checks = s.checks;
  return good;
}
