#include "core/skin.h"

#include "math/quat.h"

void sbri_skin_vertices(
    const sbri_skin *skin, const sbri_point *points, const sbr_transform *deltas, sbri_point *vertices) {
  uint32_t block_count = (skin->vertex_count + SBRI_BLOCK - 1) / SBRI_BLOCK;
  for (uint32_t block = 0; block < block_count; block++)
    for (uint32_t lane = 0; lane < SBRI_BLOCK; lane += SBRI_LANES) {
      sbri_wide3 sum = {sbri_wide_all(0), sbri_wide_all(0), sbri_wide_all(0)};
      for (uint32_t c = skin->cell_begins[block]; c < skin->cell_begins[block + 1]; c++) {
        const sbri_carry_cell *cell = &skin->cells[c];
        sbri_wide3 p = sbri_wide_gather(points, cell->slots + lane);
        sbri_wide w = sbri_wide_load(cell->weights + lane);
        sum.x = sum.x + w * p.x;
        sum.y = sum.y + w * p.y;
        sum.z = sum.z + w * p.z;
      }
      sbri_wide_store_points(vertices + block * SBRI_BLOCK + lane, sum);
    }
  for (uint32_t i = 0; i < skin->frame_vertex_count; i++) {
    const sbri_frame_vertex *v = &skin->frame_vertices[i];
    sbf_vec3 sum = {0, 0, 0};
    for (uint32_t k = v->first; k < v->first + v->count; k++) {
      const sbr_transform *d = &deltas[skin->influences[k].frame];
      sbf_vec3 at = sbri_add(d->position, sbri_rotate(d->rotation, v->rest));
      sum = sbri_add_scaled(sum, at, skin->influences[k].weight);
    }
    vertices[v->vertex] = (sbri_point){sum.x, sum.y, sum.z, 0};
  }
}

typedef struct diagonals {
  sbri_wide3 a, b;
} diagonals;

static inline diagonals face_diagonals(
    const sbri_face_block *face, const sbri_point *vertices, uint32_t lane) {
  sbri_wide3 p = sbri_wide_gather(vertices, face->corners[0] + lane);
  sbri_wide3 q = sbri_wide_gather(vertices, face->corners[1] + lane);
  sbri_wide3 r = sbri_wide_gather(vertices, face->corners[2] + lane);
  sbri_wide3 s = sbri_wide_gather(vertices, face->corners[3] + lane);
  return (diagonals){{r.x - p.x, r.y - p.y, r.z - p.z}, {s.x - q.x, s.y - q.y, s.z - q.z}};
}

void sbri_skin_faces(const sbri_skin *skin, const sbri_point *vertices, sbri_point *faces) {
  for (uint32_t block = 0; block < skin->face_block_count; block++)
    for (uint32_t lane = 0; lane < SBRI_BLOCK; lane += SBRI_LANES) {
      diagonals d = face_diagonals(&skin->faces[block], vertices, lane);
      sbri_wide3 n = {
          d.a.y * d.b.z - d.a.z * d.b.y, d.a.z * d.b.x - d.a.x * d.b.z, d.a.x * d.b.y - d.a.y * d.b.x};
      sbri_wide_store_points(faces + block * SBRI_BLOCK + lane, n);
    }
}

void sbri_skin_tangents(const sbri_skin *skin, const sbri_point *vertices, sbri_point *faces) {
  for (uint32_t block = 0; block < skin->face_block_count; block++)
    for (uint32_t lane = 0; lane < SBRI_BLOCK; lane += SBRI_LANES) {
      diagonals d = face_diagonals(&skin->faces[block], vertices, lane);
      sbri_wide a = sbri_wide_load(skin->tangent_blocks[block].shares[0] + lane);
      sbri_wide b = sbri_wide_load(skin->tangent_blocks[block].shares[1] + lane);
      sbri_wide3 t = {a * d.a.x + b * d.b.x, a * d.a.y + b * d.b.y, a * d.a.z + b * d.b.z};
      sbri_wide_store_points(faces + block * SBRI_BLOCK + lane, t);
    }
}

void sbri_skin_sums(const sbri_sum_table *table, const sbri_point *faces, sbri_point *sums) {
  uint32_t block_count = (table->group_count + SBRI_BLOCK - 1) / SBRI_BLOCK;
  for (uint32_t block = 0; block < block_count; block++)
    for (uint32_t lane = 0; lane < SBRI_BLOCK; lane += SBRI_LANES) {
      sbri_wide3 sum = {sbri_wide_all(0), sbri_wide_all(0), sbri_wide_all(0)};
      for (uint32_t c = table->cell_begins[block]; c < table->cell_begins[block + 1]; c++) {
        sbri_wide3 f = sbri_wide_gather(faces, table->cells[c].faces + lane);
        sum.x = sum.x + f.x;
        sum.y = sum.y + f.y;
        sum.z = sum.z + f.z;
      }
      sbri_wide_store_points(sums + block * SBRI_BLOCK + lane, sum);
    }
}

void sbri_skin_normals(const sbri_sum_table *table, const sbri_point *faces, sbri_point *normals) {
  sbri_skin_sums(table, faces, normals);
  uint32_t count = (table->group_count + SBRI_BLOCK - 1) / SBRI_BLOCK * SBRI_BLOCK;
  for (uint32_t i = 0; i < count; i += SBRI_LANES) {
    sbri_wide3 n = sbri_wide_load_points(normals + i);
    sbri_wide square = n.x * n.x + n.y * n.y + n.z * n.z, zero = sbri_wide_all(0);
    sbri_mask real = square > sbri_wide_all(1e-36f);
    sbri_wide s = sbri_wide_all(1) / sbri_wide_sqrt(sbri_wide_select(real, square, sbri_wide_all(1)));
    n.x = sbri_wide_select(real, n.x * s, zero);
    n.y = sbri_wide_select(real, n.y * s, sbri_wide_all(1));
    n.z = sbri_wide_select(real, n.z * s, zero);
    sbri_wide_store_points(normals + i, n);
  }
}

/* Of the cones from the surface's first vertex: a third of the product of base vector and place. A quad
 * counts as its two triangles along the diagonal from its first corner. */
double sbri_skin_volume(const sbri_skin *skin, const sbri_point *vertices) {
  double six_fold = 0;
  if (skin->vertex_count == 0) return 0;
  const sbri_point *o = &vertices[0];
  for (uint32_t block = 0; block < skin->face_block_count; block++)
    for (int lane = 0; lane < SBRI_BLOCK; lane++) {
      const uint32_t(*corners)[SBRI_BLOCK] = skin->faces[block].corners;
      const sbri_point *p = &vertices[corners[0][lane]], *q = &vertices[corners[1][lane]];
      const sbri_point *r = &vertices[corners[2][lane]], *s = &vertices[corners[3][lane]];
      double ax = (double)r->x - p->x, ay = (double)r->y - p->y, az = (double)r->z - p->z;
      double bx = (double)s->x - q->x, by = (double)s->y - q->y, bz = (double)s->z - q->z;
      double x = (double)p->x - o->x, y = (double)p->y - o->y, z = (double)p->z - o->z;
      six_fold += x * (ay * bz - az * by) + y * (az * bx - ax * bz) + z * (ax * by - ay * bx);
    }
  return six_fold / 6;
}

double sbri_surface_volume(const sbri_character *c, const sbri_body *body, const sbri_point *points) {
  sbri_point *vertices = sbri_surface_vertices(c) + body->first_vertex;
  sbri_skin_vertices(&body->surface, points, sbri_deltas(c), vertices);
  return sbri_skin_volume(&body->surface, vertices);
}

/* The surface's own points, or those that its level's points carry at rest. */
bool sbri_rest_volumes_find(sbr_model *model) {
  sbfi_arena scratch;
  sbfi_arena_init(&scratch, &model->arena.allocator, 0);
  bool good = true;
  for (uint32_t b = 0; good && b < model->asset->soft_bodies.count; b++) {
    sbri_body *body = &model->bodies[b];
    uint32_t count = body->surface.vertex_count;
    sbf_surface_measures measures;
    sbf_surface_measure(&body->source->surface, NULL, &measures);
    if (count == 0 || measures.opening > 1e-3 || !(measures.volume > 0)) continue;
    sbri_point *vertices = sbfi_arena_allocate(&scratch, count, sizeof *vertices);
    good = vertices != NULL;
    for (uint32_t i = 0; good && i < count; i++) {
      sbf_vec3 p = body->source->surface.positions.at[i];
      vertices[i] = (sbri_point){p.x, p.y, p.z, 0};
    }
    if (good) body->rest_volume_m3 = sbri_skin_volume(&body->surface, vertices);
  }
  sbfi_arena_free(&scratch);
  return good;
}
