#include "build/weights/weight_mesh.h"

#include "base/union_find.h"
#include "build/geometry/box_tree.h"
#include "build/weights/weight_sites.h"

static bool has_corner_twice(const uint32_t corners[3]) {
  return corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
}

static bool measure(sbfi_weight_mesh *m, const sbfi_weights_input *in) {
  sbfi_d3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
  for (uint32_t t = 0; t < in->triangle_count; t++)
    for (int k = 0; k < 3; k++) {
      sbfi_d3 at = sbfi_d3_of(in->points[in->triangles[t][k]]);
      low = (sbfi_d3){fmin(low.x, at.x), fmin(low.y, at.y), fmin(low.z, at.z)};
      high = (sbfi_d3){fmax(high.x, at.x), fmax(high.y, at.y), fmax(high.z, at.z)};
    }
  sbfi_d3 size = sbfi_d3_sub(high, low);
  double longest = fmax(size.x, fmax(size.y, size.z));
  m->low = low;
  m->scale = longest > 0 ? 1 / longest : 0;
  return in->triangle_count > 0 && longest > 0 && isfinite(m->scale) && isfinite(longest);
}

static sbfi_d3 corner(const sbfi_weight_mesh *m, const uint32_t corners[3], int k) {
  return sbfi_d3_of(m->sites[corners[k]]);
}

/* Twice the triangle's area, along its normal. */
static sbfi_d3 area_of(const sbfi_weight_mesh *m, const uint32_t corners[3]) {
  sbfi_d3 a = corner(m, corners, 0);
  return sbfi_d3_cross(sbfi_d3_sub(corner(m, corners, 1), a), sbfi_d3_sub(corner(m, corners, 2), a));
}

/* Numbers the shells by first site and lists their sites. */
static bool find_shells(
    sbfi_weight_mesh *m, const uint32_t (*triangles)[3], uint32_t count, sbfi_arena *arena) {
  uint32_t *parents = sbfi_arena_allocate(arena, m->site_count, sizeof *parents);
  m->shell_of_site = sbfi_arena_allocate(arena, m->site_count, sizeof *m->shell_of_site);
  m->sites_by_shell = sbfi_arena_allocate(arena, m->site_count, sizeof *m->sites_by_shell);
  m->index_of_site = sbfi_arena_allocate(arena, m->site_count, sizeof *m->index_of_site);
  m->shells = sbfi_arena_allocate(arena, m->site_count, sizeof *m->shells);
  if (!parents || !m->shell_of_site || !m->sites_by_shell || !m->index_of_site || !m->shells) return false;
  sbfi_sets_begin(parents, m->site_count);
  for (uint32_t t = 0; t < count; t++)
    for (int k = 1; k < 3; k++) sbfi_sets_join(parents, triangles[t][0], triangles[t][k]);
  for (uint32_t i = 0; i < m->site_count; i++) {
    uint32_t root = sbfi_set_root(parents, i); /* the lowest of its set */
    m->shell_of_site[i] = root == i ? m->shell_count++ : m->shell_of_site[root];
    sbfi_shell *shell = &m->shells[m->shell_of_site[i]];
    sbfi_d3 at = sbfi_d3_of(m->sites[i]);
    if (root == i) shell->low = shell->high = at;
    shell->low = (sbfi_d3){fmin(shell->low.x, at.x), fmin(shell->low.y, at.y), fmin(shell->low.z, at.z)};
    shell->high = (sbfi_d3){fmax(shell->high.x, at.x), fmax(shell->high.y, at.y), fmax(shell->high.z, at.z)};
    shell->site_count++;
  }
  for (uint32_t s = 0, next = 0; s < m->shell_count; next += m->shells[s++].site_count) {
    sbfi_d3 size = sbfi_d3_sub(m->shells[s].high, m->shells[s].low);
    m->shells[s].size = fmax(size.x, fmax(size.y, size.z));
    m->shells[s].first_site = next;
  }
  uint32_t *next = parents; /* parents are no longer needed */
  for (uint32_t s = 0; s < m->shell_count; s++) next[s] = m->shells[s].first_site;
  for (uint32_t i = 0; i < m->site_count; i++) {
    m->index_of_site[i] = next[m->shell_of_site[i]]++;
    m->sites_by_shell[m->index_of_site[i]] = i;
  }
  return true;
}

/* Sorts the triangles by shell, and flips shells that face inwards. */
static bool order_triangles(
    sbfi_weight_mesh *m, const uint32_t (*triangles)[3], uint32_t count, sbfi_arena *arena) {
  m->triangles = sbfi_arena_allocate(arena, count, sizeof *m->triangles);
  uint32_t *next = sbfi_arena_allocate(arena, m->shell_count, sizeof *next);
  double *volumes = sbfi_arena_allocate(arena, m->shell_count, sizeof *volumes);
  m->areas = sbfi_arena_allocate(arena, m->site_count, sizeof *m->areas);
  if (!m->triangles || !next || !volumes || !m->areas) return false;
  for (uint32_t t = 0; t < count; t++) m->shells[m->shell_of_site[triangles[t][0]]].triangle_count++;
  for (uint32_t s = 0, first = 0; s < m->shell_count; first += m->shells[s++].triangle_count)
    m->shells[s].first_triangle = next[s] = first;
  for (uint32_t t = 0; t < count; t++) {
    uint32_t shell = m->shell_of_site[triangles[t][0]], *to = m->triangles[next[shell]++];
    sbfi_d3 area = area_of(m, triangles[t]);
    for (int k = 0; k < 3; k++) {
      to[k] = triangles[t][k];
      m->areas[to[k]] += sbfi_d3_length(area) / 6;
    }
    sbfi_d3 from_middle = sbfi_d3_sub(
        corner(m, to, 0), sbfi_d3_scale(sbfi_d3_add(m->shells[shell].low, m->shells[shell].high), 0.5));
    volumes[shell] += sbfi_d3_dot(from_middle, area);
  }
  m->triangle_count = count;
  for (uint32_t s = 0; s < m->shell_count; s++) {
    for (uint32_t t = 0; volumes[s] < 0 && t < m->shells[s].triangle_count; t++) {
      uint32_t *of = m->triangles[m->shells[s].first_triangle + t], kept = of[1];
      of[1] = of[2];
      of[2] = kept;
    }
  }
  return true;
}

/* Area-weighted means of the surrounding triangles. */
static bool find_normals(sbfi_weight_mesh *m, sbfi_arena *arena) {
  m->normals = sbfi_arena_allocate(arena, m->site_count, sizeof *m->normals);
  if (!m->normals) return false;
  for (uint32_t t = 0; t < m->triangle_count; t++)
    for (int k = 0; k < 3; k++) {
      sbfi_d3 *to = &m->normals[m->triangles[t][k]];
      *to = sbfi_d3_add(*to, area_of(m, m->triangles[t]));
    }
  for (uint32_t i = 0; i < m->site_count; i++) m->normals[i] = sbfi_d3_normal(m->normals[i]);
  return true;
}

static double site_distance(const void *user, uint32_t site, const double point[3]) {
  const sbfi_weight_mesh *m = user;
  sbfi_d3 separation = sbfi_d3_sub(sbfi_d3_of(m->sites[site]), (sbfi_d3){point[0], point[1], point[2]});
  return sbfi_d3_dot(separation, separation);
}

/* Points without triangles follow the nearest site. */
static bool position_loose_points(sbfi_weight_mesh *m, const sbfi_weights_input *in, sbfi_arena *arena) {
  sbfi_box_tree tree = {0};
  for (uint32_t i = 0; i < in->point_count; i++) {
    if (m->site_of_point[i] != UINT32_MAX) continue;
    if (!tree.node_count) {
      sbfi_box *boxes = sbfi_arena_allocate(arena, m->site_count, sizeof *boxes);
      if (!boxes) return false;
      for (uint32_t s = 0; s < m->site_count; s++) {
        const sbf_vec3 at = m->sites[s];
        boxes[s] = (sbfi_box){{at.x, at.y, at.z}, {at.x, at.y, at.z}};
      }
      if (!sbfi_box_tree_build(&tree, boxes, m->site_count, arena)) return false;
    }
    sbfi_d3 at = sbfi_weight_mesh_position(m, in->points[i]);
    double nearest = INFINITY;
    uint32_t site = sbfi_box_tree_nearest(&tree, (double[]){at.x, at.y, at.z}, site_distance, m, &nearest);
    m->site_of_point[i] = site == UINT32_MAX ? 0 : site;
  }
  return true;
}

sbfi_weight_mesh_result sbfi_weight_mesh_make(
    sbfi_weight_mesh *m, const sbfi_weights_input *in, sbfi_arena *arena) {
  *m = (sbfi_weight_mesh){0};
  if (!measure(m, in)) return SBFI_WEIGHT_MESH_TOO_SMALL;
  uint32_t(*triangles)[3] = sbfi_arena_allocate(arena, in->triangle_count, sizeof *triangles), count = 0;
  if (!triangles || !sbfi_weight_sites_find(m, in, arena)) return SBFI_WEIGHT_MESH_NO_MEMORY;
  for (uint32_t t = 0; t < in->triangle_count; t++) {
    for (int k = 0; k < 3; k++) triangles[count][k] = m->site_of_point[in->triangles[t][k]];
    count += !has_corner_twice(triangles[count]) && sbfi_d3_length(area_of(m, triangles[count])) > 0;
  }
  if (count < 4) return SBFI_WEIGHT_MESH_TOO_SMALL;
  bool good = find_shells(m, (const uint32_t(*)[3])triangles, count, arena) &&
              order_triangles(m, (const uint32_t(*)[3])triangles, count, arena) && find_normals(m, arena) &&
              position_loose_points(m, in, arena);
  return good ? SBFI_WEIGHT_MESH_GOOD : SBFI_WEIGHT_MESH_NO_MEMORY;
}

static sbf_polygon_mesh surface_of(const sbf_vec3 *sites, uint32_t site_count, const uint32_t *corners,
    uint32_t count, const uint32_t *sizes) {
  sbf_polygon_mesh surface;
  sbf_polygon_mesh_init(&surface);
  surface.positions = (sbf_vec3_list){sites, site_count};
  surface.polygon_sizes = (sbf_u32_list){sizes, count};
  surface.polygon_points = (sbf_u32_list){corners, 3 * count};
  return surface;
}

sbf_polygon_mesh sbfi_weight_mesh_surface(const sbfi_weight_mesh *m, const uint32_t *sizes) {
  return surface_of(m->sites, m->site_count, m->triangles[0], m->triangle_count, sizes);
}

bool sbfi_weight_mesh_shell(const sbfi_weight_mesh *m, uint32_t shell, const uint32_t *sizes,
    sbf_polygon_mesh *surface, sbfi_arena *arena) {
  const sbfi_shell *s = &m->shells[shell];
  sbf_vec3 *sites = sbfi_arena_allocate(arena, s->site_count, sizeof *sites);
  uint32_t *corners = sbfi_arena_allocate(arena, 3 * (size_t)s->triangle_count, sizeof *corners);
  if (!sites || !corners) return false;
  for (uint32_t i = 0; i < s->site_count; i++) sites[i] = m->sites[m->sites_by_shell[s->first_site + i]];
  for (uint32_t i = 0; i < 3 * s->triangle_count; i++)
    corners[i] = m->index_of_site[m->triangles[s->first_triangle + i / 3][i % 3]] - s->first_site;
  *surface = surface_of(sites, s->site_count, corners, s->triangle_count, sizes);
  return true;
}
