#include "build/weights/weights.h"

#include "build/weights/body_bridges.h"
#include "build/weights/bone_fit.h"
#include "build/weights/shell_weights.h"

typedef struct work {
  const sbfi_weights_input *in;
  sbfi_arena arena;
  sbfi_weight_mesh mesh;
  uint32_t *sizes; /* a 3 for each triangle */
  sbf_polygon_mesh surface;
  sbfi_body_rays rays;
  sbfi_bone_segment *segments;
  sbfi_bone_reach reach;
  sbfi_body_grid grid;
  sbfi_nearest_bone *nearest;
  sbfi_site_weights *weights;
} work;

static bool prepare(work *w) {
  const sbfi_weights_input *in = w->in;
  sbfi_arena *arena = &w->arena;
  w->sizes = sbfi_arena_allocate(arena, w->mesh.triangle_count, sizeof *w->sizes);
  w->segments = sbfi_arena_allocate(arena, in->bone_count, sizeof *w->segments);
  w->nearest = sbfi_arena_allocate(arena, w->mesh.site_count, sizeof *w->nearest);
  w->weights = sbfi_arena_allocate(arena, w->mesh.site_count, sizeof *w->weights);
  if (!w->sizes || !w->segments || !w->nearest || !w->weights) return false;
  for (uint32_t t = 0; t < w->mesh.triangle_count; t++) w->sizes[t] = 3;
  w->surface = sbfi_weight_mesh_surface(&w->mesh, w->sizes);
  return sbfi_body_rays_make(&w->rays, &w->surface, arena) &&
         sbfi_bone_segments_find(in, &w->mesh, &w->rays, w->segments, arena);
}

static bool has_deforming_bone(const work *w) {
  for (uint32_t i = 0; i < w->in->bone_count; i++)
    if (w->segments[i].is_deforming) return true;
  return false;
}

static bool compute(work *w, sbfi_weights_figures *figures) {
  const sbfi_weights_input *in = w->in;
  sbfi_arena *arena = &w->arena;
  if (!sbfi_bone_reach_find(&w->reach, in, &w->mesh, &w->rays, w->segments, w->sizes, arena) ||
      !sbfi_body_grid_make(&w->grid, &w->mesh, &w->rays, arena) || !sbfi_body_bridges_make(&w->grid, arena) ||
      !sbfi_nearest_bones_find(in, &w->mesh, &w->grid, w->segments, &w->reach, w->nearest, arena) ||
      !sbfi_bone_fit_measure(&w->mesh, &w->rays, w->segments, in->bone_count, w->nearest, figures, arena) ||
      !sbfi_heat_weights_solve(&w->mesh, w->nearest, in->bone_count, w->weights, &figures->iterations, arena))
    return false;
  figures->cell_count = w->grid.cell_count;
  return sbfi_shell_weights_repair(
      &w->mesh, w->segments, in->bone_count, &w->reach, w->weights, figures, arena);
}

static void *allocate_output(sbfi_weights *out, uint32_t count, size_t size) {
  size_t bytes;
  if (!sbfi_multiply_size(count, size, &bytes)) return NULL;
  return sbfi_allocate(&out->allocator, bytes);
}

static void measure_idle_bones(const work *w, sbfi_weights *out) {
  double whole = 0;
  for (uint32_t b = 0; b < out->bone_count; b++) {
    double length = sbfi_d3_length(sbfi_d3_sub(w->segments[b].tail, w->segments[b].head));
    out->idle_lengths[b] = w->segments[b].is_deforming ? (float)length : 0;
    whole += (double)out->idle_lengths[b];
  }
  for (uint32_t i = 0; i < w->mesh.site_count; i++) out->idle_lengths[w->nearest[i].bone] = 0;
  for (uint32_t b = 0; b < out->bone_count; b++)
    out->idle_lengths[b] = whole > 0 ? (float)((double)out->idle_lengths[b] / whole) : 0;
}

static bool copy_out(const work *w, sbfi_weights *out) {
  out->joints = allocate_output(out, out->point_count, sizeof *out->joints);
  out->weights = allocate_output(out, out->point_count, sizeof *out->weights);
  out->shell_of_point = allocate_output(out, out->point_count, sizeof *out->shell_of_point);
  out->idle_lengths = allocate_output(out, out->bone_count, sizeof *out->idle_lengths);
  if (!out->joints || !out->weights || !out->shell_of_point || !out->idle_lengths) return false;
  measure_idle_bones(w, out);
  for (uint32_t i = 0; i < out->point_count; i++) {
    uint32_t site = w->mesh.site_of_point[i];
    out->shell_of_point[i] = w->mesh.shell_of_site[site];
    for (int k = 0; k < SBFI_WEIGHTS_PER_POINT; k++) {
      bool is_used = w->weights[site].bones[k] != UINT32_MAX;
      out->joints[i][k] = is_used ? w->weights[site].bones[k] : 0;
      out->weights[i][k] = is_used ? w->weights[site].weights[k] : 0;
    }
  }
  return true;
}

static bool count_unused(work *w, sbfi_weights *out) {
  bool *is_used = sbfi_arena_allocate(&w->arena, w->in->bone_count, sizeof *is_used);
  if (!is_used) return false;
  for (uint32_t i = 0; i < out->point_count; i++)
    for (int k = 0; k < SBFI_WEIGHTS_PER_POINT; k++)
      if (out->weights[i][k] > 0) is_used[out->joints[i][k]] = true;
  for (uint32_t i = 0; i < w->in->bone_count; i++)
    out->figures.unused_bone_count += w->segments[i].is_deforming && !is_used[i];
  return true;
}

static sbf_status run(work *w, sbfi_weights *out, sbf_diagnostic *error) {
  sbfi_weight_mesh_result made = sbfi_weight_mesh_make(&w->mesh, w->in, &w->arena);
  if (made == SBFI_WEIGHT_MESH_TOO_SMALL)
    return sbfi_diagnose(error, SBF_CODE_IMPORT_WEIGHTS_IMPOSSIBLE,
        "skin weights need a surface, and this mesh has fewer than four triangles with an area: use the "
        "character's mesh, or read weights from a file");
  if (made == SBFI_WEIGHT_MESH_GOOD && (w->in->bone_count == 0 || prepare(w))) {
    if (!has_deforming_bone(w))
      return sbfi_diagnose(error, SBF_CODE_IMPORT_WEIGHTS_IMPOSSIBLE,
          "none of the %u bones of the rig deforms the mesh: use a rig with deforming bones",
          (unsigned)w->in->bone_count);
    if (compute(w, &out->figures) && copy_out(w, out) && count_unused(w, out)) return SBF_OK;
  }
  return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out while computing skin weights");
}

sbf_status sbfi_compute_weights(const sbfi_weights_input *in, sbfi_weights *out, sbf_diagnostic *error) {
  work w = {.in = in};
  *out = (sbfi_weights){.allocator = sbfi_allocator_or_default(in->allocator),
      .point_count = in->point_count,
      .bone_count = in->bone_count};
  sbfi_arena_init(&w.arena, in->allocator, 0);
  sbf_status status = run(&w, out, error);
  sbfi_arena_free(&w.arena);
  if (status != SBF_OK) sbfi_weights_free(out);
  return status;
}

void sbfi_weights_free(sbfi_weights *w) {
  sbfi_free(&w->allocator, w->joints, w->point_count * sizeof *w->joints);
  sbfi_free(&w->allocator, w->weights, w->point_count * sizeof *w->weights);
  sbfi_free(&w->allocator, w->shell_of_point, w->point_count * sizeof *w->shell_of_point);
  sbfi_free(&w->allocator, w->idle_lengths, w->bone_count * sizeof *w->idle_lengths);
  *w = (sbfi_weights){0};
}
