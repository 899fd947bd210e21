#include "shapes/hull.h"

#include <math.h>
#include <string.h>

#include "shapes/triangle.h"

/* Distance, as a fraction of that from the centre, below which the direction from the nearest point is
 * rounding.
 */
static const float ON_IT_FRACTION = 1e-5f;

/* ---- Build ---- */

/* Aspect ratio from which a face's normal is computed in double precision. */
static const float SLIVER = 1e-3f;

/* The same as area_of. */
static sbf_vec3 area_of_sliver(const sbf_vec3 *vertices, const uint32_t *corners, uint32_t count) {
  double x = 0, y = 0, z = 0;
  sbf_vec3 o = vertices[corners[0]];
  for (uint32_t i = 2; i < count; i++) {
    sbf_vec3 p = vertices[corners[i - 1]], q = vertices[corners[i]];
    double px = (double)p.x - (double)o.x, py = (double)p.y - (double)o.y, pz = (double)p.z - (double)o.z;
    double qx = (double)q.x - (double)o.x, qy = (double)q.y - (double)o.y, qz = (double)q.z - (double)o.z;
    x += py * qz - pz * qy, y += pz * qx - px * qz, z += px * qy - py * qx;
  }
  return sbri_vec3((float)x, (float)y, (float)z);
}

/* Twice the area by Newell's sum, as a vector. */
static sbf_vec3 area_of(const sbf_vec3 *vertices, const uint32_t *corners, uint32_t count) {
  sbf_vec3 sum = {0, 0, 0}, first = vertices[corners[0]];
  float wide = 0;
  for (uint32_t i = 2; i < count; i++) {
    sbf_vec3 a = sbri_sub(vertices[corners[i - 1]], first), b = sbri_sub(vertices[corners[i]], first);
    sum = sbri_add(sum, sbri_cross(a, b));
    wide = fmaxf(wide, fmaxf(sbri_dot(a, a), sbri_dot(b, b)));
  }
  return sbri_length(sum) > SLIVER * wide ? sum : area_of_sliver(vertices, corners, count);
}

typedef struct making {
  sbri_hull *hull;
  sbri_hull_face *faces;
  sbri_hull_edge *edges;
  uint32_t *corners;
  uint32_t *face_of_edge; /* the second face; UINT32_MAX: none */
} making;

/* Adds a face to the edge between two corners, or adds the edge. A linear search suffices for small hulls. */
static void add_edge(making *m, uint32_t a, uint32_t b, sbf_vec3 normal) {
  for (uint32_t e = 0; e < m->hull->edge_count; e++) {
    sbri_hull_edge *edge = &m->edges[e];
    if (edge->ends[0] != b || edge->ends[1] != a || m->face_of_edge[e] != UINT32_MAX) continue;
    edge->normals[1] = normal;
    m->face_of_edge[e] = 0;
    return;
  }
  uint32_t e = m->hull->edge_count++;
  m->edges[e] = (sbri_hull_edge){{a, b}, {normal, sbri_scale(normal, -1)}};
  m->face_of_edge[e] = UINT32_MAX;
}

static void add_face(making *m, const uint32_t *corners, uint32_t count) {
  sbri_hull *h = m->hull;
  sbf_vec3 area = area_of(h->vertices, corners, count);
  float size = sbri_length(area);
  if (!(size > 1e-20f)) return;
  sbf_vec3 n = sbri_scale(area, 1 / size);
  float offset = sbri_dot(n, h->vertices[corners[0]]);
  bool inwards = sbri_dot(n, h->middle) > offset;
  sbri_hull_face *face = &m->faces[h->face_count++];
  *face =
      (sbri_hull_face){inwards ? sbri_scale(n, -1) : n, inwards ? -offset : offset, h->corner_count, count};
  uint32_t *to = m->corners + h->corner_count;
  for (uint32_t i = 0; i < count; i++) to[i] = corners[inwards ? count - 1 - i : i];
  h->corner_count += count;
  for (uint32_t i = 0; i < count; i++) add_edge(m, to[i], to[(i + 1) % count], face->normal);
}

bool sbri_hull_make(sbri_hull *hull, const sbf_vec3 *vertices, uint32_t vertex_count, const uint32_t *sizes,
    uint32_t face_count, const uint32_t *corners, sbfi_arena *arena) {
  size_t total = 0;
  for (uint32_t f = 0; f < face_count; f++) total += sizes[f];
  *hull = (sbri_hull){.vertices = vertices, .vertex_count = vertex_count};
  making m = {.hull = hull};
  m.faces = sbfi_arena_allocate(arena, (size_t)face_count + 2, sizeof *m.faces);
  m.edges = sbfi_arena_allocate(arena, total + 1, sizeof *m.edges);
  m.corners = sbfi_arena_allocate(arena, 2 * total + 1, sizeof *m.corners);
  m.face_of_edge = sbfi_arena_allocate(arena, total + 1, sizeof *m.face_of_edge);
  if (!m.faces || !m.edges || !m.corners || !m.face_of_edge) return false;
  for (uint32_t i = 0; i < vertex_count; i++)
    hull->middle = sbri_add_scaled(hull->middle, vertices[i], 1 / (float)vertex_count);
  if (vertex_count) hull->box = sbri_box_of_point(hull->vertices[0]);
  for (uint32_t i = 1; i < vertex_count; i++) hull->box = sbri_box_with(hull->box, hull->vertices[i]);
  hull->faces = m.faces, hull->edges = m.edges, hull->corners = m.corners;
  for (uint32_t f = 0; f < face_count; corners += sizes[f++])
    if (sizes[f] >= 3) add_face(&m, corners, sizes[f]);
  if (hull->face_count == 1) { /* flat: add the back side */
    const sbri_hull_face front = m.faces[0];
    m.faces[1] =
        (sbri_hull_face){sbri_scale(front.normal, -1), -front.offset, hull->corner_count, front.count};
    for (uint32_t i = 0; i < front.count; i++)
      m.corners[hull->corner_count + i] = m.corners[front.first + front.count - 1 - i];
    hull->corner_count += front.count;
    hull->face_count = 2;
  }
  return true;
}

/* ---- Queries ---- */

float sbri_hull_depth(const sbri_hull *hull, sbf_vec3 x, uint32_t *face) {
  float max = -INFINITY;
  *face = 0;
  for (uint32_t f = 0; f < hull->face_count; f++) {
    float height = sbri_dot(hull->faces[f].normal, x) - hull->faces[f].offset;
    if (height > max) max = height, *face = f;
  }
  return max;
}

static sbf_vec3 nearest_on_face(const sbri_hull *hull, const sbri_hull_face *face, sbf_vec3 x) {
  const uint32_t *c = hull->corners + face->first;
  sbf_vec3 best = hull->vertices[c[0]];
  float min = INFINITY;
  for (uint32_t i = 2; i < face->count; i++) {
    sbf_vec3 a = hull->vertices[c[0]], b = hull->vertices[c[i - 1]], d = hull->vertices[c[i]];
    float weights[3];
    sbri_triangle_find_nearest(x, a, b, d, weights);
    sbf_vec3 position = sbri_triangle_point(weights, a, b, d), off = sbri_sub(x, position);
    if (sbri_dot(off, off) < min) min = sbri_dot(off, off), best = position;
  }
  return best;
}

float sbri_hull_nearest(const sbri_hull *hull, sbf_vec3 x, sbf_vec3 *position, sbf_vec3 *normal) {
  uint32_t deepest;
  float depth = sbri_hull_depth(hull, x, &deepest);
  *normal = hull->faces[deepest].normal;
  *position = sbri_add_scaled(x, *normal, -depth);
  if (depth <= 0) return depth;
  float min = INFINITY, on_it = ON_IT_FRACTION * sbri_length(sbri_sub(x, hull->middle));
  for (uint32_t f = 0; f < hull->face_count; f++) {
    const sbri_hull_face *face = &hull->faces[f];
    float height = sbri_dot(face->normal, x) - face->offset;
    if (height < 0 || height * height >= min) continue;
    sbf_vec3 on = nearest_on_face(hull, face, x), off = sbri_sub(x, on);
    float square = sbri_dot(off, off);
    if (square >= min) continue;
    min = square, *position = on;
    *normal = square > on_it * on_it ? sbri_normalize(off, face->normal) : face->normal;
  }
  return sqrtf(min);
}

uint32_t sbri_hull_support(const sbri_hull *hull, sbf_vec3 along) {
  uint32_t best = 0;
  float max = sbri_dot(along, hull->vertices[0]);
  for (uint32_t i = 1; i < hull->vertex_count; i++) {
    float reach = sbri_dot(along, hull->vertices[i]);
    if (reach > max) max = reach, best = i;
  }
  return best;
}
