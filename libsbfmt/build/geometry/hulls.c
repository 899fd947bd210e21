#include "build/geometry/hulls.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <libqhull_r/qhull_ra.h>

#include "base/file.h"
#include "mechanics/polygon.h"

static const double flat_fraction = 1e-4;

/* Finds the point farthest from a point, line or plane; stores its distance in `*farthest`. */
static uint32_t find_farthest(const sbf_vec3 *points, uint32_t count, sbfi_d3 base, sbfi_d3 direction,
    int dimension, double *farthest) {
  uint32_t found = 0;
  *farthest = -1;
  for (uint32_t i = 0; i < count; i++) {
    sbfi_d3 displacement = sbfi_d3_sub(sbfi_d3_of(points[i]), base);
    double distance = sbfi_d3_length(displacement);                                        /* from a point */
    if (dimension == 1) distance = sbfi_d3_length(sbfi_d3_cross(displacement, direction)); /* from a line */
    if (dimension == 2) distance = fabs(sbfi_d3_dot(displacement, direction));             /* from a plane */
    if (distance > *farthest) {
      *farthest = distance;
      found = i;
    }
  }
  return found;
}

static bool is_flat(const sbf_vec3 *points, uint32_t count) {
  if (count < 4) return true;
  double extent, distance;
  sbfi_d3 none = {0, 0, 0}, a = sbfi_d3_of(points[0]);
  sbfi_d3 b = sbfi_d3_of(points[find_farthest(points, count, a, none, 0, &extent)]);
  sbfi_d3 line = sbfi_d3_normal(sbfi_d3_sub(b, a));
  sbfi_d3 c = sbfi_d3_of(points[find_farthest(points, count, a, line, 1, &distance)]);
  if (!(distance > flat_fraction * extent)) return true;
  sbfi_d3 plane = sbfi_d3_normal(sbfi_d3_cross(line, sbfi_d3_sub(c, a)));
  find_farthest(points, count, a, plane, 2, &distance);
  return !(distance > flat_fraction * extent);
}

/* A polygon during the ordering of the hull. */
typedef struct ring {
  uint32_t *corners;
  uint32_t size;
} ring;

static int compare_rings(const void *a, const void *b) {
  const ring *x = a, *y = b;
  for (uint32_t i = 0; i < x->size && i < y->size; i++)
    if (x->corners[i] != y->corners[i]) return x->corners[i] < y->corners[i] ? -1 : 1;
  return (x->size > y->size) - (x->size < y->size);
}

/* Orders the ring counter-clockwise seen from outside, starting at its lowest point. */
static void straighten(ring *r, const sbf_vec3 *points, sbfi_d3 inside, uint32_t *spare) {
  sbfi_d3 middle = sbfi_polygon_middle(points, r->corners, r->size);
  sbfi_d3 area = sbfi_polygon_area(points, r->corners, r->size, middle);
  bool inwards = sbfi_d3_dot(area, sbfi_d3_sub(middle, inside)) < 0;
  uint32_t lowest = 0;
  for (uint32_t k = 1; k < r->size; k++)
    if (r->corners[k] < r->corners[lowest]) lowest = k;
  for (uint32_t k = 0; k < r->size; k++)
    spare[k] = r->corners[(inwards ? lowest + r->size - k : lowest + k) % r->size];
  memcpy(r->corners, spare, r->size * sizeof *spare);
}

typedef struct ring_list {
  ring *at;
  uint32_t count, corner_count;
} ring_list;

/* Reads the facets of a finished hull. */
static bool read_rings(
    qhT *qh, const sbf_vec3 *points, uint32_t count, ring_list *rings, sbfi_arena *scratch) {
  facetT *facet;
  vertexT *vertex, **vertexp;
  sbfi_d3 inside = {qh->interior_point[0], qh->interior_point[1], qh->interior_point[2]};
  rings->at = sbfi_arena_allocate(scratch, (size_t)qh->num_facets, sizeof *rings->at);
  uint32_t *spare = sbfi_arena_allocate(scratch, count, sizeof *spare);
  if (!rings->at || !spare) return false;
  FORALLfacets {
    setT *vertices = qh_facet3vertex(qh, facet);
    uint32_t size = (uint32_t)qh_setsize(qh, vertices);
    ring *r = &rings->at[rings->count];
    *r = (ring){sbfi_arena_allocate(scratch, size, sizeof *r->corners), 0};
    if (r->corners) FOREACHvertex_(vertices) r->corners[r->size++] = (uint32_t)qh_pointid(qh, vertex->point);
    qh_settempfree(qh, &vertices);
    if (!r->corners) return false;
    straighten(r, points, inside, spare);
    rings->corner_count += size;
    rings->count++;
  }
  qsort(rings->at, rings->count, sizeof *rings->at, compare_rings);
  return true;
}

/* Catches qhull's errors, which outside qh_new_qhull would end the process. */
static sbfi_hull_outcome read_rings_guarded(
    qhT *qh, const sbf_vec3 *points, uint32_t count, ring_list *rings, sbfi_arena *scratch) {
  if (setjmp(qh->errexit)) {
    qh->NOerrexit = True;
    return SBFI_HULL_FLAT;
  }
  qh->NOerrexit = False;
  bool good = read_rings(qh, points, count, rings, scratch);
  qh->NOerrexit = True;
  return good ? SBFI_HULL_MADE : SBFI_HULL_NO_MEMORY;
}

static bool write_hull(const ring_list *rings, const sbf_vec3 *points, uint32_t count, sbf_asset *asset,
    sbf_polygon_mesh *hull, sbfi_arena *scratch) {
  uint32_t *indices = sbfi_arena_allocate(scratch, count, sizeof *indices);
  uint32_t *sizes = sbf_asset_allocate(asset, rings->count, sizeof *sizes);
  uint32_t *corners = sbf_asset_allocate(asset, rings->corner_count, sizeof *corners);
  if (!indices || !sizes || !corners) return false;
  for (uint32_t r = 0; r < rings->count; r++)
    for (uint32_t k = 0; k < rings->at[r].size; k++) indices[rings->at[r].corners[k]] = 1;
  uint32_t point_count = 0, corner_count = 0;
  for (uint32_t i = 0; i < count; i++) point_count += indices[i];
  sbf_vec3 *positions = sbf_asset_allocate(asset, point_count, sizeof *positions);
  if (!positions) return false;
  point_count = 0;
  for (uint32_t i = 0; i < count; i++) {
    if (!indices[i]) continue;
    positions[point_count] = points[i];
    indices[i] = point_count++;
  }
  for (uint32_t r = 0; r < rings->count; r++) {
    sizes[r] = rings->at[r].size;
    for (uint32_t k = 0; k < sizes[r]; k++) corners[corner_count++] = indices[rings->at[r].corners[k]];
  }
  sbf_polygon_mesh_init(hull);
  hull->target = SBF_MESH_TARGET_COLLISION_DETECTION;
  hull->positions = (sbf_vec3_list){positions, point_count};
  hull->polygon_sizes = (sbf_u32_list){sizes, rings->count};
  hull->polygon_points = (sbf_u32_list){corners, rings->corner_count};
  return true;
}

sbfi_hull_outcome sbfi_hull_make(
    const sbf_vec3 *points, uint32_t count, sbf_asset *asset, sbf_polygon_mesh *hull, sbfi_arena *scratch) {
  if (is_flat(points, count) || count > INT_MAX / 4) return SBFI_HULL_FLAT;
  coordT *coordinates = sbfi_arena_allocate(scratch, count, 3 * sizeof *coordinates);
  qhT *qh = sbfi_arena_allocate(scratch, 1, sizeof *qh);
  if (!coordinates || !qh) return SBFI_HULL_NO_MEMORY;
  for (uint32_t i = 0; i < count; i++) {
    coordinates[3 * (size_t)i] = points[i].x;
    coordinates[3 * (size_t)i + 1] = points[i].y;
    coordinates[3 * (size_t)i + 2] = points[i].z;
  }
  /* qhull writes remarks about the input to the caller's file; only its result matters. */
  FILE *remarks = sbfi_file_discard();
  char command[] = "qhull Pp";
  qh_zero(qh, remarks ? remarks : stderr);
  int trouble =
      qh_new_qhull(qh, 3, (int)count, coordinates, False, command, NULL, remarks ? remarks : stderr);
  ring_list rings = {NULL, 0, 0};
  sbfi_hull_outcome outcome = trouble == qh_ERRmem ? SBFI_HULL_NO_MEMORY : SBFI_HULL_FLAT;
  if (!trouble) {
    outcome = read_rings_guarded(qh, points, count, &rings, scratch);
    if (outcome == SBFI_HULL_MADE && !write_hull(&rings, points, count, asset, hull, scratch))
      outcome = SBFI_HULL_NO_MEMORY;
  }
  int long_blocks, long_bytes;
  qh_freeqhull(qh, !qh_ALL);
  qh_memfreeshort(qh, &long_blocks, &long_bytes);
  if (remarks) fclose(remarks);
  return outcome;
}

bool sbfi_hull_contains(const sbf_polygon_mesh *hull, sbf_vec3 point) {
  const uint32_t *corners = hull->polygon_points.at;
  for (uint32_t p = 0; p < hull->polygon_sizes.count; corners += hull->polygon_sizes.at[p++]) {
    sbfi_d3 middle = sbfi_polygon_middle(hull->positions.at, corners, hull->polygon_sizes.at[p]);
    sbfi_d3 area = sbfi_polygon_area(hull->positions.at, corners, hull->polygon_sizes.at[p], middle);
    /* tolerance in proportion to the face, for rounding in single precision */
    double size = sqrt(sbfi_d3_length(area));
    if (sbfi_d3_dot(sbfi_d3_sub(sbfi_d3_of(point), middle), sbfi_d3_normal(area)) > 1e-5 * size) return false;
  }
  return hull->polygon_sizes.count > 0;
}
