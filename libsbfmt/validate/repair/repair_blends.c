/* Normalizes blend weights of vertices that are embedded in several bodies, as a runtime does anyway. */
#include "validate/repair/repair.h"
#include <math.h>

/* Levels of one index correspond only if all bodies of the mesh have equally many. */
static bool levels_match(const sbf_asset *asset, uint32_t mesh, uint32_t *count) {
  *count = 0;
  for (uint32_t b = 0; b < asset->soft_bodies.count; b++) {
    const sbf_level_list levels = asset->soft_bodies.at[b].levels;
    bool has_embedding = false;
    for (uint32_t l = 0; l < levels.count; l++)
      for (uint32_t e = 0; e < levels.at[l].embeddings.count; e++)
        has_embedding |= levels.at[l].embeddings.at[e].render_mesh == (int32_t)mesh;
    if (!has_embedding) continue;
    if (*count && *count != levels.count) return false;
    *count = levels.count;
  }
  return true;
}

/* Iterates over all embeddings of a mesh in levels of one index. */
static const sbf_embedding *next_embedding(
    const sbf_asset *asset, uint32_t mesh, uint32_t level, uint32_t *body, uint32_t *number) {
  for (; *body < asset->soft_bodies.count; ++*body, *number = 0) {
    const sbf_level_list levels = asset->soft_bodies.at[*body].levels;
    while (level < levels.count && *number < levels.at[level].embeddings.count) {
      const sbf_embedding *e = &levels.at[level].embeddings.at[(*number)++];
      if (e->render_mesh == (int32_t)mesh) return e;
    }
  }
  return NULL;
}

static uint32_t vertex_of(const sbf_embedding *e, uint32_t i) {
  return e->vertices.count ? e->vertices.at[i] : i;
}

/* Sums over all embeddings; false if any of them is invalid. */
static bool add_up(
    const sbf_asset *asset, uint32_t mesh, uint32_t level, double *sums, uint32_t vertex_count) {
  uint32_t body = 0, number = 0;
  for (const sbf_embedding *e; (e = next_embedding(asset, mesh, level, &body, &number));) {
    if (e->vertices.count && e->vertices.count != e->points.count) return false;
    for (uint32_t i = 0; i < e->points.count; i++) {
      double fraction = e->blends.count ? (double)e->blends.at[i] : 1;
      if (vertex_of(e, i) >= vertex_count || fraction < 0) return false;
      sums[vertex_of(e, i)] += fraction;
    }
  }
  return true;
}

static float *blends_of(sbfi_repair *m, sbf_embedding *e) {
  if (e->blends.count) return sbfi_writable(e->blends.at);
  float *blends = sbf_asset_allocate(m->asset, e->points.count, sizeof *blends);
  if (!blends) {
    m->out_of_memory = true;
    return NULL;
  }
  for (uint32_t i = 0; i < e->points.count; i++) blends[i] = 1;
  e->blends = (sbf_f32_list){blends, e->points.count};
  return blends;
}

static void divide(sbfi_repair *m, uint32_t mesh, uint32_t level, const double *sums) {
  uint32_t body = 0, number = 0;
  for (const sbf_embedding *e; (e = next_embedding(m->asset, mesh, level, &body, &number));) {
    float *blends = NULL;
    for (uint32_t i = 0; i < e->points.count; i++) {
      double sum = sums[vertex_of(e, i)];
      if (!(sum > 0) || fabs(sum - 1) <= 1e-3) continue;
      if (!blends && !(blends = blends_of(m, sbfi_writable(e)))) return;
      blends[i] = (float)((double)blends[i] / sum);
    }
  }
}

static void repair_mesh(sbfi_repair *m, uint32_t mesh, uint32_t level) {
  uint32_t count = m->asset->render_meshes.at[mesh].mesh.positions.count, repaired = 0;
  double *sums = sbfi_repair_scratch(m, count, sizeof *sums);
  if (!sums || !add_up(m->asset, mesh, level, sums, count)) return;
  for (uint32_t i = 0; i < count; i++) repaired += sums[i] > 0 && fabs(sums[i] - 1) > 1e-3;
  if (repaired) divide(m, mesh, level, sums);
  sbfi_path path = sbfi_path_of("/sbf/render_mesh[%u]", mesh + 1);
  sbfi_count_repair(m, SBF_CODE_EMBEDDING_BLEND, repaired, path.text, -1,
      "blends divided by their sum: %u vert%s", repaired, repaired == 1 ? "ex" : "ices");
}

void sbfi_repair_blends(sbfi_repair *m) {
  for (uint32_t mesh = 0; mesh < m->asset->render_meshes.count; mesh++) {
    uint32_t levels;
    if (!levels_match(m->asset, mesh, &levels)) continue;
    for (uint32_t l = 0; l < levels && !m->out_of_memory; l++) repair_mesh(m, mesh, l);
  }
}
