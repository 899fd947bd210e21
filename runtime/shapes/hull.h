/* Convex polyhedra: the collision shapes of rigid bodies, boxes and single triangles. */
#ifndef SBRI_HULL_H
#define SBRI_HULL_H

#include "base/memory.h"
#include "sbfmt/model.h"
#include "shapes/bounds_tree.h"

typedef struct sbri_hull_face {
  sbf_vec3 normal;       /* unit, outwards */
  float offset;          /* normal . x on it */
  uint32_t first, count; /* its corners, in order about the normal */
} sbri_hull_face;

typedef struct sbri_hull_edge {
  uint32_t ends[2];
  sbf_vec3 normals[2]; /* of the adjacent faces */
} sbri_hull_edge;

typedef struct sbri_hull {
  const sbf_vec3 *vertices;
  const sbri_hull_face *faces;
  const uint32_t *corners;
  const sbri_hull_edge *edges;
  uint32_t vertex_count, face_count, corner_count, edge_count;
  sbf_vec3 middle; /* mean of the vertices, inside */
  sbri_box box;
} sbri_hull;

/* Builds a hull from polygons over vertices, in any winding. Coplanar faces are not merged; a flat hull
 * encloses no volume and has faces on both sides. Returns false if memory runs out. */
bool sbri_hull_make(sbri_hull *hull, const sbf_vec3 *vertices, uint32_t vertex_count, const uint32_t *sizes,
    uint32_t face_count, const uint32_t *corners, sbfi_arena *arena);

/* Face with the largest signed distance from x; returns that distance. */
float sbri_hull_depth(const sbri_hull *hull, sbf_vec3 x, uint32_t *face);
/* Nearest point on the surface; returns the distance, negative inside. */
float sbri_hull_nearest(const sbri_hull *hull, sbf_vec3 x, sbf_vec3 *position, sbf_vec3 *normal);
/* The support point: the vertex farthest along a direction. */
uint32_t sbri_hull_support(const sbri_hull *hull, sbf_vec3 along);

#endif
