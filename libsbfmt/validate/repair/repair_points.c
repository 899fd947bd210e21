/* Removes surface points of bodies without any reference. Renumbers all indices of source points; levels
 * keep their points. */
#include <string.h>

#include "mechanics/level_points.h"
#include "validate/repair/repair.h"

typedef struct renumbering {
  sbfi_repair *m;
  sbf_soft_body *body;
  uint32_t count;         /* number of source points before */
  uint32_t *new_position; /* (count) */
  uint8_t *dropped;       /* (count) */
} renumbering;

static void use(uint8_t *used, sbf_u32_list points) {
  for (uint32_t i = 0; i < points.count; i++) used[points.at[i]] = 1;
}

/* Marks points that polygons, pins and attachments do not use. */
static uint32_t mark_unused(renumbering *r, uint32_t *first) {
  uint32_t unused = 0;
  uint8_t *used = sbfi_repair_scratch(r->m, r->count, 1);
  if (!used || r->body->surface.polygon_sizes.count == 0) return 0;
  use(used, r->body->surface.polygon_points);
  for (uint32_t s = 0; s < r->body->pins.count; s++) use(used, r->body->pins.at[s].points);
  for (uint32_t a = 0; a < r->body->attachments.count; a++) use(used, r->body->attachments.at[a].points);
  for (uint32_t i = 0; i < r->body->surface.positions.count; i++) {
    if (used[i]) continue;
    r->dropped[i] = 1;
    if (unused++ == 0) *first = i;
  }
  for (uint32_t i = 0, next = 0; i < r->count; i++) r->new_position[i] = r->dropped[i] ? UINT32_MAX : next++;
  return unused;
}

static void renumber(const renumbering *r, sbf_u32_list points) {
  uint32_t *at = sbfi_writable(points.at);
  for (uint32_t i = 0; i < points.count; i++) at[i] = r->new_position[at[i]];
}

/* An empty map means equal numbering, which is no longer true. */
static void renumber_level(renumbering *r, sbf_level *level) {
  if (level->new_from_old.count) {
    sbfi_list_drop(&level->new_from_old, sizeof *level->new_from_old.at, r->dropped);
    return;
  }
  uint32_t *map = sbf_asset_allocate(r->m->asset, r->count, sizeof *map), next = 0;
  if (!map) {
    r->m->out_of_memory = true;
    return;
  }
  for (uint32_t i = 0; i < r->count; i++)
    if (!r->dropped[i]) map[next++] = sbfi_level_point(level, i);
  level->new_from_old = (sbf_u32_list){map, next};
}

/* For the body's own surface: removes embeddings of dropped points. */
static void renumber_embedding(renumbering *r, sbf_embedding *e) {
  uint8_t *dropped = sbfi_repair_scratch(r->m, e->points.count, 1);
  uint32_t surface = r->body->surface.positions.count; /* the original count: it shrinks last */
  if (!dropped || (e->vertices.count && e->vertices.count != e->points.count)) return;
  for (uint32_t i = 0; i < e->points.count; i++) {
    uint32_t vertex = e->vertices.count ? e->vertices.at[i] : i;
    dropped[i] = vertex < surface && r->dropped[vertex];
  }
  if (e->blends.count) sbfi_list_drop(&e->blends, sizeof *e->blends.at, dropped);
  if (e->vertices.count) {
    sbfi_list_drop(&e->vertices, sizeof *e->vertices.at, dropped);
    for (uint32_t i = 0; i < e->vertices.count; i++) {
      uint32_t *vertex = (uint32_t *)sbfi_writable(e->vertices.at) + i;
      if (*vertex < surface) *vertex = r->new_position[*vertex];
    }
  }
  sbfi_list_drop(&e->points, sizeof *e->points.at, dropped);
  sbfi_list_drop(&e->weights, sizeof *e->weights.at, dropped);
}

static void renumber_body(renumbering *r) {
  sbf_soft_body *body = r->body;
  for (uint32_t s = 0; s < body->pins.count; s++) renumber(r, body->pins.at[s].points);
  for (uint32_t a = 0; a < body->attachments.count; a++) renumber(r, body->attachments.at[a].points);
  for (uint32_t w = 0; w < body->weight_maps.count; w++) {
    sbf_weight_map *map = sbfi_writable(&body->weight_maps.at[w]);
    sbfi_list_drop(&map->values, sizeof *map->values.at, r->dropped);
  }
  for (uint32_t l = 0; l < body->levels.count; l++) {
    sbf_level *level = sbfi_writable(&body->levels.at[l]);
    renumber_level(r, level);
    for (uint32_t e = 0; e < level->embeddings.count; e++)
      if (level->embeddings.at[e].render_mesh == SBF_NONE)
        renumber_embedding(r, sbfi_writable(&level->embeddings.at[e]));
  }
  if (body->source_points.count)
    sbfi_list_drop(&body->source_points, sizeof *body->source_points.at, r->dropped);
  renumber(r, body->surface.polygon_points);
  sbfi_list_drop(&body->surface.positions, sizeof *body->surface.positions.at, r->dropped);
}

void sbfi_repair_points(sbfi_repair *m) {
  for (uint32_t b = 0; b < m->asset->soft_bodies.count && !m->out_of_memory; b++) {
    sbf_soft_body *body = sbfi_writable(&m->asset->soft_bodies.at[b]);
    uint32_t count = body->surface.positions.count + body->interior.count, first = 0;
    renumbering r = {m, body, count, sbfi_repair_scratch(m, count, sizeof *r.new_position),
        sbfi_repair_scratch(m, count, 1)};
    if (m->out_of_memory) return;
    uint32_t unused = mark_unused(&r, &first);
    if (unused == 0) continue;
    renumber_body(&r);
    sbfi_path path = sbfi_path_of("/sbf/soft_body[%u]/polygon_mesh/positions", b + 1);
    sbfi_count_repair(m, SBF_CODE_POINT_UNUSED, unused, path.text, first,
        "%u point%s of '%s' in no polygon removed", unused, sbfi_plural(unused),
        sbfi_label(body->name, body->id));
  }
}
