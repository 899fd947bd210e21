/* Computes a skin for a mesh without weights or a bone that sections embed: each section has a bone and
 * blend weights of its vertices. */
#include "export/exporting.h"

/* Visits every vertex embedded in a section's finest level. */
typedef struct influences {
  uint32_t *counts; /* by vertex */
  uint32_t *bones;  /* NULL: only count */
  float *weights;
  const uint32_t *begins;
} influences;

static void add(influences *c, uint32_t vertex, int32_t bone, float weight) {
  if (c->bones) {
    uint32_t at = c->begins[vertex] + c->counts[vertex];
    c->bones[at] = (uint32_t)bone;
    c->weights[at] = weight;
  }
  c->counts[vertex]++;
}

static void visit(const sbf_asset *asset, uint32_t render_mesh, influences *c) {
  for (uint32_t b = 0; b < asset->soft_bodies.count; b++) {
    const sbf_soft_body *body = &asset->soft_bodies.at[b];
    if (body->bone < 0 || !body->levels.count) continue;
    const sbf_embedding_list embeddings = body->levels.at[0].embeddings;
    for (uint32_t i = 0; i < embeddings.count; i++) {
      const sbf_embedding *e = &embeddings.at[i];
      if (e->render_mesh != (int32_t)render_mesh) continue;
      for (uint32_t k = 0; k < e->points.count; k++)
        add(c, e->vertices.count ? e->vertices.at[k] : k, body->bone, e->blends.count ? e->blends.at[k] : 1);
    }
  }
}

bool sbfi_export_section_skin(
    const sbf_asset *asset, uint32_t render_mesh, sbfi_arena *arena, const sbf_skin **made) {
  uint32_t points = asset->render_meshes.at[render_mesh].mesh.positions.count, all = 0;
  *made = NULL;
  if (!asset->bones.count || !points) return true;
  influences c = {.counts = sbfi_arena_allocate(arena, points, sizeof *c.counts)};
  uint32_t *begins = sbfi_arena_allocate(arena, points, sizeof *begins);
  if (!c.counts || !begins) return false;
  visit(asset, render_mesh, &c);
  for (uint32_t p = 0; p < points; p++) {
    begins[p] = all;
    all += c.counts[p];
    c.counts[p] = 0;
  }
  if (!all) return true;
  sbf_skin *skin = sbfi_arena_allocate(arena, 1, sizeof *skin);
  c.begins = begins;
  c.bones = sbfi_arena_allocate(arena, all, sizeof *c.bones);
  c.weights = sbfi_arena_allocate(arena, all, sizeof *c.weights);
  if (!skin || !c.bones || !c.weights) return false;
  visit(asset, render_mesh, &c);
  *skin = (sbf_skin){{c.counts, points}, {c.bones, all}, {c.weights, all}};
  *made = skin;
  return true;
}
