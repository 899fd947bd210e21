/* Normals of morph targets. A normal shared by corners of a point rotates with the surrounding faces: by
 * the smallest rotation between the sums of their area vectors before and after. Hard edges stay hard. */
#include <math.h>
#include <string.h>

#include "export/glb.h"
#include "motion/quatd.h"

struct sbfi_glb_normals {
  const sbf_render_mesh *mesh;
  uint32_t count;               /* number of pairs of a point and a normal */
  uint32_t *pairs;              /* (corners) */
  double (*rest)[3], (*now)[3]; /* (pairs) area vectors */
};

uint32_t sbfi_glb_normal_of(const sbf_render_mesh *m, uint32_t corner) {
  return m->normal_corners.count ? m->normal_corners.at[corner] : m->mesh.polygon_points.at[corner];
}

static sbf_vec3 moved(const sbfi_glb_normals *n, uint32_t corner, const sbf_vec3 *offsets) {
  uint32_t point = n->mesh->mesh.polygon_points.at[corner];
  sbf_vec3 p = n->mesh->mesh.positions.at[point];
  if (offsets) p.x += offsets[point].x, p.y += offsets[point].y, p.z += offsets[point].z;
  return p;
}

/* Adds each polygon to the pairs of all its corners; `offsets` NULL: at rest. */
static void add_areas(const sbfi_glb_normals *n, const sbf_vec3 *offsets, double (*to)[3]) {
  const sbf_polygon_mesh *mesh = &n->mesh->mesh;
  memset(to, 0, n->count * sizeof *to);
  for (uint32_t i = 0, corner = 0; i < mesh->polygon_sizes.count; i++) {
    uint32_t size = mesh->polygon_sizes.at[i];
    double area[3] = {0, 0, 0};
    const sbf_vec3 a = moved(n, corner, offsets);
    for (uint32_t k = 2; k < size; k++) {
      const sbf_vec3 b = moved(n, corner + k - 1, offsets), c = moved(n, corner + k, offsets);
      const double u[3] = {(double)b.x - a.x, (double)b.y - a.y, (double)b.z - a.z};
      const double v[3] = {(double)c.x - a.x, (double)c.y - a.y, (double)c.z - a.z};
      for (int d = 0; d < 3; d++)
        area[d] += u[(d + 1) % 3] * v[(d + 2) % 3] - u[(d + 2) % 3] * v[(d + 1) % 3];
    }
    for (uint32_t k = 0; k < size; k++)
      for (int d = 0; d < 3; d++) to[n->pairs[corner + k]][d] += area[d];
    corner += size;
  }
}

/* Numbers the pairs: those of one point form a chain. */
static bool number_pairs(sbfi_glb *g, sbfi_glb_normals *n) {
  const sbf_polygon_mesh *mesh = &n->mesh->mesh;
  uint32_t corners = mesh->polygon_points.count;
  uint32_t *first = sbfi_glb_allocate(g, mesh->positions.count, sizeof *first);
  uint32_t *next = sbfi_glb_allocate(g, corners, sizeof *next);
  uint32_t *normals = sbfi_glb_allocate(g, corners, sizeof *normals);
  n->pairs = sbfi_glb_allocate(g, corners, sizeof *n->pairs);
  if (!first || !next || !normals || !n->pairs) return false;
  memset(first, 0xff, mesh->positions.count * sizeof *first);
  for (uint32_t c = 0; c < corners; c++) {
    uint32_t point = mesh->polygon_points.at[c], normal = sbfi_glb_normal_of(n->mesh, c), at = first[point];
    while (at != UINT32_MAX && normals[at] != normal) at = next[at];
    if (at == UINT32_MAX) {
      at = n->count++;
      normals[at] = normal;
      next[at] = first[point];
      first[point] = at;
    }
    n->pairs[c] = at;
  }
  return true;
}

sbfi_glb_normals *sbfi_glb_normals_begin(sbfi_glb *g, const sbfi_glb_mesh *mesh) {
  if (!mesh->shown->normals.count || !mesh->target_count) return NULL;
  sbfi_glb_normals *n = sbfi_glb_allocate(g, 1, sizeof *n);
  if (!n) return NULL;
  n->mesh = mesh->shown;
  if (!number_pairs(g, n)) return NULL;
  n->rest = sbfi_glb_allocate(g, n->count, sizeof *n->rest);
  n->now = sbfi_glb_allocate(g, n->count, sizeof *n->now);
  if (!n->rest || !n->now) return NULL;
  add_areas(n, NULL, n->rest);
  return n;
}

void sbfi_glb_normals_move(sbfi_glb_normals *normals, const sbf_vec3 *offsets) {
  add_areas(normals, offsets, normals->now);
}

static bool unit(const double v[3], double to[3]) {
  double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  for (int d = 0; d < 3; d++) to[d] = length > 0 ? v[d] / length : 0;
  return length > 0;
}

sbf_vec3 sbfi_glb_normals_offset(const sbfi_glb_normals *normals, uint32_t corner, sbf_vec3 normal) {
  uint32_t pair = normals->pairs[corner];
  double from[3], to[3], rotation[4];
  const double own[3] = {normal.x, normal.y, normal.z};
  double now[3];
  if (!unit(normals->rest[pair], from) || !unit(normals->now[pair], to)) return (sbf_vec3){0, 0, 0};
  sbfi_quatd_between(from, to, rotation);
  sbfi_quatd_rotate(rotation, own, now);
  return (sbf_vec3){(float)(now[0] - own[0]), (float)(now[1] - own[1]), (float)(now[2] - own[2])};
}
