/* Removes points of render meshes that no polygon of any level uses. */
#include "validate/repair/repair.h"
#include "validate/rules/mesh_use.h"

typedef struct renumbering {
  sbfi_repair *m;
  sbf_render_mesh *mesh;
  int32_t number;         /* index of the mesh */
  uint32_t count;         /* number of points before */
  uint32_t *new_position; /* (count) */
  uint8_t *dropped;       /* (count) */
} renumbering;

static void renumber(const renumbering *r, sbf_u32_list points) {
  uint32_t *at = sbfi_writable(points.at);
  for (uint32_t i = 0; i < points.count; i++) at[i] = r->new_position[at[i]];
}

/* An embedding with invalid vertex indices is unreliable as a whole. */
static bool is_sound(const sbf_embedding *e, uint32_t count) {
  if (e->vertices.count == 0) return e->points.count == count;
  if (e->vertices.count != e->points.count) return false;
  for (uint32_t i = 0; i < e->vertices.count; i++)
    if (e->vertices.at[i] >= count) return false;
  return true;
}

/* Iterates over the embeddings of the mesh; NULL at the end. */
static sbf_embedding *next_embedding(
    const renumbering *r, uint32_t *body, uint32_t *level, uint32_t *number) {
  const sbf_soft_body_list bodies = r->m->asset->soft_bodies;
  for (; *body < bodies.count; ++*body, *level = 0, *number = 0)
    for (; *level < bodies.at[*body].levels.count; ++*level, *number = 0) {
      const sbf_embedding_list all = bodies.at[*body].levels.at[*level].embeddings;
      while (*number < all.count) {
        const sbf_embedding *e = &all.at[(*number)++];
        if (e->render_mesh == r->number) return sbfi_writable(e);
      }
    }
  return NULL;
}

static bool embeddings_are_sound(const renumbering *r) {
  uint32_t body = 0, level = 0, number = 0;
  for (const sbf_embedding *e; (e = next_embedding(r, &body, &level, &number));)
    if (!is_sound(e, r->count)) return false;
  return true;
}

static void renumber_embedding(renumbering *r, sbf_embedding *e) {
  uint8_t *dropped = sbfi_repair_scratch(r->m, e->points.count, 1);
  if (!dropped) return;
  for (uint32_t i = 0; i < e->points.count; i++)
    dropped[i] = r->dropped[e->vertices.count ? e->vertices.at[i] : i];
  if (e->blends.count) sbfi_list_drop(&e->blends, sizeof *e->blends.at, dropped);
  if (e->vertices.count) {
    sbfi_list_drop(&e->vertices, sizeof *e->vertices.at, dropped);
    renumber(r, e->vertices);
  }
  sbfi_list_drop(&e->points, sizeof *e->points.at, dropped);
  sbfi_list_drop(&e->weights, sizeof *e->weights.at, dropped);
}

static void drop_influences(renumbering *r, sbf_skin *skin) {
  uint8_t *dropped = sbfi_repair_scratch(r->m, skin->bones.count, 1);
  if (!dropped) return;
  for (uint32_t i = 0, at = 0; i < skin->influence_counts.count; i++)
    for (uint32_t left = skin->influence_counts.at[i]; left > 0; left--) dropped[at++] = r->dropped[i];
  sbfi_list_drop(&skin->bones, sizeof *skin->bones.at, dropped);
  sbfi_list_drop(&skin->weights, sizeof *skin->weights.at, dropped);
  sbfi_list_drop(&skin->influence_counts, sizeof *skin->influence_counts.at, r->dropped);
}

static void renumber_key(renumbering *r, sbf_shape_key *key) {
  uint8_t *dropped = sbfi_repair_scratch(r->m, key->points.count, 1);
  if (!dropped) return;
  for (uint32_t i = 0; i < key->points.count; i++) dropped[i] = r->dropped[key->points.at[i]];
  sbfi_list_drop(&key->points, sizeof *key->points.at, dropped);
  sbfi_list_drop(&key->offsets, sizeof *key->offsets.at, dropped);
  renumber(r, key->points);
}

static void renumber_mesh(renumbering *r) {
  sbf_render_mesh *mesh = r->mesh;
  uint32_t body = 0, level = 0, number = 0;
  for (sbf_embedding *e; (e = next_embedding(r, &body, &level, &number));) renumber_embedding(r, e);
  if (mesh->skin) drop_influences(r, sbfi_writable(mesh->skin));
  for (uint32_t k = 0; k < mesh->shape_keys.count; k++)
    renumber_key(r, sbfi_writable(&mesh->shape_keys.at[k]));
  if (mesh->normal_corners.count == 0 && mesh->normals.count == r->count)
    sbfi_list_drop(&mesh->normals, sizeof *mesh->normals.at, r->dropped);
  if (mesh->color_corners.count == 0 && mesh->colors.count == r->count)
    sbfi_list_drop(&mesh->colors, sizeof *mesh->colors.at, r->dropped);
  for (uint32_t u = 0; u < mesh->uv_sets.count; u++) {
    sbf_uv_set *set = sbfi_writable(&mesh->uv_sets.at[u]);
    if (set->corners.count == 0 && set->coordinates.count == r->count)
      sbfi_list_drop(&set->coordinates, sizeof *set->coordinates.at, r->dropped);
  }
  if (mesh->source_points.count)
    sbfi_list_drop(&mesh->source_points, sizeof *mesh->source_points.at, r->dropped);
  for (uint32_t l = 0; l < mesh->levels.count; l++) renumber(r, mesh->levels.at[l].polygon_points);
  renumber(r, mesh->mesh.polygon_points);
  sbfi_list_drop(&mesh->mesh.positions, sizeof *mesh->mesh.positions.at, r->dropped);
}

void sbfi_repair_mesh_points(sbfi_repair *m) {
  for (uint32_t i = 0; i < m->asset->render_meshes.count && !m->out_of_memory; i++) {
    sbf_render_mesh *mesh = sbfi_writable(&m->asset->render_meshes.at[i]);
    uint32_t count = mesh->mesh.positions.count, unused = 0, first = 0, next = 0;
    renumbering r = {m, mesh, (int32_t)i, count, sbfi_repair_scratch(m, count, sizeof *r.new_position),
        sbfi_repair_scratch(m, count, 1)};
    if (m->out_of_memory) return;
    if (mesh->mesh.polygon_sizes.count == 0) continue; /* without polygons the used points are unknown */
    sbfi_mesh_use_of(mesh, r.dropped);
    for (uint32_t p = 0; p < count; p++) {
      r.dropped[p] = !r.dropped[p];
      if (r.dropped[p] && unused++ == 0) first = p;
      r.new_position[p] = r.dropped[p] ? UINT32_MAX : next++;
    }
    if (unused == 0 || !embeddings_are_sound(&r)) continue;
    renumber_mesh(&r);
    sbfi_path path = sbfi_path_of("/sbf/render_mesh[%u]/polygon_mesh/positions", i + 1);
    sbfi_count_repair(m, SBF_CODE_MESH_POINT_UNUSED, unused, path.text, first,
        "%u point%s of '%s' in no polygon removed", unused, sbfi_plural(unused),
        sbfi_label(mesh->name, mesh->id));
  }
}
