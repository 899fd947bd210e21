/* Embeddings: weights that sum to one and do not reach far outside, every visible vertex carried. */
#include <math.h>

#include "validate/validation.h"

static const float SUM_TOLERANCE = 1e-4f;
static const float FAR_OUTSIDE = 4; /* weights beyond it make a vertex jump at the least strain */

static void check_embedding(
    sbfi_validation *v, const sbf_embedding *e, float *share, uint32_t vertex_count, const char *path) {
  if (e->vertices.count && e->vertices.count != e->points.count)
    sbfi_found(v, SBF_CODE_EMBEDDING_LENGTH, path, -1, "%u vertices are named and %u embedded",
        e->vertices.count, e->points.count);
  for (uint32_t i = 0; i < e->points.count; i++) {
    sbf_vec4 w = e->weights.at[i];
    float sum = w.x + w.y + w.z + w.w;
    float far = fmaxf(fmaxf(fabsf(w.x), fabsf(w.y)), fmaxf(fabsf(w.z), fabsf(w.w)));
    if (fabsf(sum - 1) > SUM_TOLERANCE * fmaxf(1, far))
      sbfi_found(
          v, SBF_CODE_EMBEDDING_SUM, path, i, "the weights of vertex %u sum to %.6g, not 1", i, (double)sum);
    else if (far > FAR_OUTSIDE)
      sbfi_found(v, SBF_CODE_EMBEDDING_OUTSIDE, path, i,
          "vertex %u lies far outside its element: weight %.3g", i, (double)far);
    uint32_t vertex = e->vertices.count ? (i < e->vertices.count ? e->vertices.at[i] : vertex_count) : i;
    if (vertex >= vertex_count)
      sbfi_found(v, SBF_CODE_EMBEDDING_VERTEX, path, i, "vertex %u is not one of the mesh's %u", vertex,
          vertex_count);
    else
      share[vertex] += e->blends.count ? e->blends.at[i] : 1;
  }
}

/* The shares that all bodies take of one mesh's vertices, at each body's level `l` or its coarsest. */
static void check_mesh(sbfi_validation *v, uint32_t mesh, uint32_t l) {
  const sbf_asset *asset = v->asset;
  uint32_t count = asset->render_meshes.at[mesh].mesh.positions.count, partly = 0, none = 0;
  float *share = sbfi_arena_allocate(&v->scratch, count + 1u, sizeof *share);
  if (!share) {
    v->out_of_memory = true;
    return;
  }
  bool carried = false;
  for (uint32_t b = 0; b < asset->soft_bodies.count; b++) {
    const sbf_soft_body *body = &asset->soft_bodies.at[b];
    if (body->levels.count == 0) continue;
    uint32_t place = l < body->levels.count ? l : body->levels.count - 1;
    for (uint32_t e = 0; e < body->levels.at[place].embeddings.count; e++) {
      const sbf_embedding *embedding = &body->levels.at[place].embeddings.at[e];
      if (embedding->render_mesh != (int32_t)mesh) continue;
      carried = true;
      check_embedding(v, embedding, share, count,
          sbfi_path_of("/sbf/soft_body[%u]/level[%u]/embedding[%u]", b + 1, place + 1, e + 1).text);
    }
  }
  for (uint32_t i = 0; i < count && carried; i++) {
    none += share[i] == 0;
    partly += share[i] != 0 && fabsf(share[i] - 1) > 1e-3f;
  }
  sbfi_path path = sbfi_path_of("/sbf/render_mesh[%u]", mesh + 1);
  const char *name = asset->render_meshes.at[mesh].name;
  if (partly)
    sbfi_found(v, SBF_CODE_EMBEDDING_BLEND, path.text, -1,
        "%u vertices of '%s' have blends that do not sum to 1", partly, name);
  if (none && !asset->render_meshes.at[mesh].skin)
    sbfi_found(v, SBF_CODE_EMBEDDING_MISSING, path.text, -1, "%u vertices of '%s' are carried by no body",
        none, name);
}

static void check_weight_sums(sbfi_validation *v, uint32_t mesh) {
  const sbf_skin *skin = v->asset->render_meshes.at[mesh].skin;
  for (uint32_t i = 0, at = 0; skin && i < skin->influence_counts.count; i++) {
    float sum = 0;
    for (uint32_t k = 0; k < skin->influence_counts.at[i]; k++) sum += skin->weights.at[at++];
    if (fabsf(sum - 1) > 1e-3f)
      sbfi_found(v, SBF_CODE_SKIN_SUM, sbfi_path_of("/sbf/render_mesh[%u]/skin", mesh + 1).text, i,
          "the skin weights of point %u sum to %.6g, not 1", i, (double)sum);
  }
}

void sbfi_check_embeddings(sbfi_validation *v) {
  uint32_t levels = 0;
  for (uint32_t b = 0; b < v->asset->soft_bodies.count; b++)
    if (v->asset->soft_bodies.at[b].levels.count > levels) levels = v->asset->soft_bodies.at[b].levels.count;
  for (uint32_t m = 0; m < v->asset->render_meshes.count && !v->out_of_memory; m++) {
    check_weight_sums(v, m);
    for (uint32_t l = 0; l < levels && !v->out_of_memory; l++) check_mesh(v, m, l);
  }
}
