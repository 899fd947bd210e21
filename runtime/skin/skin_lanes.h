/* Skins in eight lanes: vertices from points, faces from vertices, normals from faces. Results are padded to
 * whole blocks.
 *
 * Written for the lanes of the including file; see model/kernels.h. */
#ifndef SBRI_SKIN_LANES_H
#define SBRI_SKIN_LANES_H

#include "math/reduce.h"
#include "model/skin_tables.h"

/* Vertices that are embedded in points; 0 for the others. */
static inline void sbri_lanes_compute_vertices(
    const sbri_skin *skin, const sbri_point *points, sbri_point *vertices) {
  uint32_t block_count = (skin->vertex_count + SBRI_BLOCK - 1) / SBRI_BLOCK;
  for (uint32_t block = 0; block < block_count; block++)
    for (uint32_t lane = 0; lane < SBRI_BLOCK; lane += SBRI_LANES) {
      sbri_wide3 sum = {sbri_wide_all(0), sbri_wide_all(0), sbri_wide_all(0)};
      for (uint32_t c = skin->cell_begins[block]; c < skin->cell_begins[block + 1]; c++) {
        const sbri_volume_cell *cell = &skin->cells[c];
        sbri_wide3 p = sbri_wide_gather(points, cell->slots + lane);
        sbri_wide w = sbri_wide_load(cell->weights + lane);
        sum.x = sum.x + w * p.x;
        sum.y = sum.y + w * p.y;
        sum.z = sum.z + w * p.z;
      }
      sbri_wide_store_points(vertices + block * SBRI_BLOCK + lane, sum);
    }
}

typedef struct sbri_diagonals {
  sbri_wide3 a, b, corner; /* the first corner */
} sbri_diagonals;

static inline sbri_diagonals sbri_face_diagonals(
    const sbri_face_block *face, const sbri_point *vertices, uint32_t lane) {
  sbri_wide3 p = sbri_wide_gather(vertices, face->corners[0] + lane);
  sbri_wide3 q = sbri_wide_gather(vertices, face->corners[1] + lane);
  sbri_wide3 r = sbri_wide_gather(vertices, face->corners[2] + lane);
  sbri_wide3 s = sbri_wide_gather(vertices, face->corners[3] + lane);
  return (sbri_diagonals){{r.x - p.x, r.y - p.y, r.z - p.z}, {s.x - q.x, s.y - q.y, s.z - q.z}, p};
}

/* Twice the area vector of every face. */
static inline void sbri_lanes_compute_faces(
    const sbri_skin *skin, const sbri_point *vertices, sbri_point *faces) {
  for (uint32_t block = 0; block < skin->face_block_count; block++)
    for (uint32_t lane = 0; lane < SBRI_BLOCK; lane += SBRI_LANES) {
      sbri_diagonals d = sbri_face_diagonals(&skin->faces[block], vertices, lane);
      sbri_wide3 n = {
          d.a.y * d.b.z - d.a.z * d.b.y, d.a.z * d.b.x - d.a.x * d.b.z, d.a.x * d.b.y - d.a.y * d.b.x};
      sbri_wide_store_points(faces + block * SBRI_BLOCK + lane, n);
    }
}

/* The tangent of every face, times its area in texture space. */
static inline void sbri_lanes_compute_tangents(
    const sbri_skin *skin, const sbri_point *vertices, sbri_point *faces) {
  for (uint32_t block = 0; block < skin->face_block_count; block++)
    for (uint32_t lane = 0; lane < SBRI_BLOCK; lane += SBRI_LANES) {
      sbri_diagonals d = sbri_face_diagonals(&skin->faces[block], vertices, lane);
      sbri_wide a = sbri_wide_load(skin->tangents.blocks[block].fractions[0] + lane);
      sbri_wide b = sbri_wide_load(skin->tangents.blocks[block].fractions[1] + lane);
      sbri_wide3 t = {a * d.a.x + b * d.b.x, a * d.a.y + b * d.b.y, a * d.a.z + b * d.b.z};
      sbri_wide_store_points(faces + block * SBRI_BLOCK + lane, t);
    }
}

/* Sums of faces, one per group. */
static inline void sbri_lanes_compute_sums(
    const sbri_sum_table *table, const sbri_point *faces, sbri_point *sums) {
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

/* These sums as unit vectors; +Y if there is no area. */
static inline void sbri_lanes_compute_normals(
    const sbri_sum_table *table, const sbri_point *faces, sbri_point *normals) {
  sbri_lanes_compute_sums(table, faces, normals);
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

/* The same faces, and the volume of the cones over them from the first corner of the first one. */
static inline float sbri_lanes_volume(
    const sbri_face_block *blocks, uint32_t block_count, const sbri_point *vertices, sbri_point *faces) {
  float lanes[SBRI_BLOCK] = {0};
  const sbri_point *o = &vertices[blocks[0].corners[0][0]];
  sbri_wide ox = sbri_wide_all(o->x), oy = sbri_wide_all(o->y), oz = sbri_wide_all(o->z);
  for (uint32_t block = 0; block < block_count; block++)
    for (uint32_t lane = 0; lane < SBRI_BLOCK; lane += SBRI_LANES) {
      sbri_diagonals d = sbri_face_diagonals(&blocks[block], vertices, lane);
      sbri_wide3 n = {
          d.a.y * d.b.z - d.a.z * d.b.y, d.a.z * d.b.x - d.a.x * d.b.z, d.a.x * d.b.y - d.a.y * d.b.x};
      sbri_wide_store_points(faces + block * SBRI_BLOCK + lane, n);
      sbri_wide six_fold = (d.corner.x - ox) * n.x + (d.corner.y - oy) * n.y + (d.corner.z - oz) * n.z;
      sbri_wide_store(lanes + lane, sbri_wide_load(lanes + lane) + six_fold);
    }
  return sbri_tree_sum(lanes) * (1.0f / 6);
}

#endif
