#include "surface_vertices.h"

#include <math.h>
#include <stdlib.h>

/* The key that distinguishes corners of the same point. */
typedef struct corner_key {
  uint32_t point, uv, normal, color, corner;
} corner_key;

static int by_key(const void *a, const void *b) {
  const corner_key *p = a, *q = b;
  if (p->point != q->point) return p->point < q->point ? -1 : 1;
  if (p->uv != q->uv) return p->uv < q->uv ? -1 : 1;
  if (p->normal != q->normal) return p->normal < q->normal ? -1 : 1;
  if (p->color != q->color) return p->color < q->color ? -1 : 1;
  return (p->corner > q->corner) - (p->corner < q->corner);
}

static bool same_vertex(const corner_key *a, const corner_key *b) {
  return a->point == b->point && a->uv == b->uv && a->normal == b->normal && a->color == b->color;
}

static bool in_slot(const sbf_render_mesh *mesh, uint32_t polygon, uint32_t slot) {
  return (mesh->polygon_materials.count ? mesh->polygon_materials.at[polygon] : 0) == slot;
}

/* Collects a key for each corner of the slot's polygons; returns their number. */
static uint32_t collect(
    const sbf_render_mesh *mesh, uint32_t slot, bool hard, corner_key *keys, uint32_t *triangles) {
  const sbf_uv_set *uvs = mesh->uv_sets.count ? &mesh->uv_sets.at[0] : NULL;
  uint32_t count = 0, at = 0;
  *triangles = 0;
  for (uint32_t i = 0; i < mesh->mesh.polygon_sizes.count; at += mesh->mesh.polygon_sizes.at[i++]) {
    if (!in_slot(mesh, i, slot)) continue;
    *triangles += mesh->mesh.polygon_sizes.at[i] - 2;
    for (uint32_t c = at; c < at + mesh->mesh.polygon_sizes.at[i]; c++) {
      uint32_t point = mesh->mesh.polygon_points.at[c];
      keys[count++] = (corner_key){point,
          !uvs                 ? 0
          : uvs->corners.count ? uvs->corners.at[c]
                               : point,
          hard ? mesh->normal_corners.at[c] : 0,
          mesh->color_corners.count ? mesh->color_corners.at[c] : point, c};
    }
  }
  return count;
}

/* From the file's lower left origin to Godot's upper left one, transformed as glTF does there. */
static sbf_vec2 coordinates(sbf_vec2 uv, const sbf_uv_transform *transform) {
  float u = uv.x, v = 1 - uv.y;
  if (!transform) return (sbf_vec2){u, v};
  float c = cosf(transform->rotation), s = sinf(transform->rotation);
  u *= transform->scale.x, v *= transform->scale.y;
  return (sbf_vec2){transform->offset.x + c * u + s * v, transform->offset.y - s * u + c * v};
}

bool surface_vertices_make(surface_vertices *made, const sbf_render_mesh *mesh, uint32_t slot, bool hard,
    const sbf_uv_transform *transform) {
  uint32_t all = mesh->mesh.polygon_points.count, triangles;
  corner_key *keys = malloc((all + 1) * sizeof *keys);
  uint32_t *vertex_of = malloc((all + 1) * sizeof *vertex_of); /* by corner */
  *made = (surface_vertices){0};
  if (keys && vertex_of) {
    const sbf_uv_set *uvs = mesh->uv_sets.count ? &mesh->uv_sets.at[0] : NULL;
    uint32_t count = collect(mesh, slot, hard, keys, &triangles), written = 0, at = 0;
    qsort(keys, count, sizeof *keys, by_key);
    made->points = malloc((count + 1) * sizeof *made->points);
    made->corners = malloc((count + 1) * sizeof *made->corners);
    made->uvs = uvs ? malloc((count + 1) * sizeof *made->uvs) : NULL;
    made->colors = mesh->colors.count ? malloc((count + 1) * sizeof *made->colors) : NULL;
    made->indices = malloc((3 * (size_t)triangles + 1) * sizeof *made->indices);
    if (made->points && made->corners && made->indices && (!uvs || made->uvs) &&
        (!mesh->colors.count || made->colors)) {
      for (uint32_t i = 0; i < count; i++) {
        if (!i || !same_vertex(&keys[i - 1], &keys[i])) {
          made->points[made->count] = keys[i].point;
          made->corners[made->count] = keys[i].corner;
          if (uvs) made->uvs[made->count] = coordinates(uvs->coordinates.at[keys[i].uv], transform);
          if (made->colors) made->colors[made->count] = mesh->colors.at[keys[i].color];
          made->count++;
        }
        vertex_of[keys[i].corner] = made->count - 1;
      }
      for (uint32_t i = 0; i < mesh->mesh.polygon_sizes.count; at += mesh->mesh.polygon_sizes.at[i++]) {
        if (!in_slot(mesh, i, slot)) continue;
        for (uint32_t c = at + 2; c < at + mesh->mesh.polygon_sizes.at[i]; c++) {
          made->indices[written++] = (int32_t)vertex_of[at];
          made->indices[written++] = (int32_t)vertex_of[c];
          made->indices[written++] = (int32_t)vertex_of[c - 1];
        }
      }
      made->index_count = written;
    } else {
      surface_vertices_free(made);
      free(keys);
      keys = NULL;
    }
  }
  bool good = keys && vertex_of;
  free(keys);
  free(vertex_of);
  return good;
}

void surface_vertices_free(surface_vertices *made) {
  free(made->points);
  free(made->corners);
  free(made->uvs);
  free(made->colors);
  free(made->indices);
  *made = (surface_vertices){0};
}
