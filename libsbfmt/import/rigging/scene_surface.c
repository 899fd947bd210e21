/* Combines the meshes of a scene to one surface with edges, normals and weights. */
#include <math.h>
#include <string.h>

#include "import/rigging/rigging.h"
#include "mechanics/polygon.h"

static void find_bounds(sbfi_scene_surface *s) {
  const sbf_vec3_list points = s->mesh.positions;
  float low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
  double squared = 0;
  for (uint32_t i = 0; i < points.count; i++) {
    const float at[3] = {points.at[i].x, points.at[i].y, points.at[i].z};
    for (int k = 0; k < 3; k++) {
      low[k] = at[k] < low[k] ? at[k] : low[k];
      high[k] = at[k] > high[k] ? at[k] : high[k];
    }
  }
  for (int k = 0; points.count && k < 3; k++) squared += pow((double)high[k] - (double)low[k], 2);
  s->low = points.count ? (sbf_vec3){low[0], low[1], low[2]} : (sbf_vec3){0, 0, 0};
  s->high = points.count ? (sbf_vec3){high[0], high[1], high[2]} : (sbf_vec3){0, 0, 0};
  s->size = sqrt(squared);
}

static bool find_neighbours(sbfi_scene_surface *s, sbfi_arena *arena) {
  const sbf_polygon_mesh *m = &s->mesh;
  uint32_t *starts = sbfi_arena_allocate(arena, (size_t)m->positions.count + 2, sizeof *starts);
  uint32_t *items = sbfi_arena_allocate(arena, 2 * (size_t)m->polygon_points.count + 1, sizeof *items);
  if (!starts || !items) return false;
  for (uint32_t i = 0; i < m->polygon_points.count; i++) starts[m->polygon_points.at[i] + 2] += 2;
  for (uint32_t i = 2; i < m->positions.count + 2; i++) starts[i] += starts[i - 1];
  for (uint32_t p = 0, at = 0; p < m->polygon_sizes.count; at += m->polygon_sizes.at[p++]) {
    uint32_t size = m->polygon_sizes.at[p];
    for (uint32_t k = 0; k < size; k++) {
      uint32_t a = m->polygon_points.at[at + k], b = m->polygon_points.at[at + (k + 1) % size];
      items[starts[a + 1]++] = b;
      items[starts[b + 1]++] = a;
    }
  }
  s->neighbour_starts = starts;
  s->neighbours = items;
  return true;
}

/* Polygons around a point face opposite directions if less than this fraction of their area remains in the
 * vector sum. */
static const double MIN_LEFT = 0.1;

static bool find_normals(sbfi_scene_surface *s, sbfi_arena *arena) {
  const sbf_polygon_mesh *m = &s->mesh;
  sbfi_d3 *sums = sbfi_arena_allocate(arena, m->positions.count + 1, sizeof *sums);
  double *areas = sbfi_arena_allocate(arena, m->positions.count + 1, sizeof *areas);
  sbf_vec3 *normals = sbfi_arena_allocate(arena, m->positions.count + 1, sizeof *normals);
  if (!sums || !areas || !normals) return false;
  for (uint32_t p = 0, at = 0; p < m->polygon_sizes.count; at += m->polygon_sizes.at[p++]) {
    const uint32_t *points = m->polygon_points.at + at, size = m->polygon_sizes.at[p];
    sbfi_d3 middle = sbfi_polygon_middle(m->positions.at, points, size);
    sbfi_d3 area = sbfi_polygon_area(m->positions.at, points, size, middle);
    for (uint32_t k = 0; k < size; k++) {
      sums[points[k]] = sbfi_d3_add(sums[points[k]], area);
      areas[points[k]] += sbfi_d3_length(area);
    }
  }
  for (uint32_t i = 0; i < m->positions.count; i++)
    if (sbfi_d3_length(sums[i]) > MIN_LEFT * areas[i]) normals[i] = sbfi_d3_rounded(sbfi_d3_normal(sums[i]));
  s->normals = normals;
  return true;
}

static bool finish(sbfi_scene_surface *s, sbfi_arena *arena) {
  find_bounds(s);
  return find_neighbours(s, arena) && find_normals(s, arena);
}

bool sbfi_surface_gather(
    sbfi_scene_surface *surface, const sbfi_scene *scene, const sbfi_matrix *to_space, sbfi_arena *arena) {
  *surface = (sbfi_scene_surface){.scene = scene};
  size_t points = 0, polygons = 0, corners = 0;
  for (uint32_t m = 0; m < scene->mesh_count; m++) {
    points += scene->meshes[m].point_count;
    polygons += scene->meshes[m].polygon_count;
    corners += scene->meshes[m].corner_count;
  }
  if (points >= UINT32_MAX || corners >= UINT32_MAX / 2) return false;
  sbf_vec3 *positions = sbfi_arena_allocate(arena, points + 1, sizeof *positions);
  uint32_t *sizes = sbfi_arena_allocate(arena, polygons + 1, sizeof *sizes);
  uint32_t *polygon_points = sbfi_arena_allocate(arena, corners + 1, sizeof *polygon_points);
  uint32_t *mesh_starts = sbfi_arena_allocate(arena, scene->mesh_count + 1, sizeof *mesh_starts);
  uint32_t *polygon_starts = sbfi_arena_allocate(arena, scene->mesh_count + 1, sizeof *polygon_starts);
  if (!positions || !sizes || !polygon_points || !mesh_starts || !polygon_starts) return false;
  uint32_t point = 0, polygon = 0, corner = 0;
  for (uint32_t m = 0; m < scene->mesh_count; m++) {
    const sbfi_scene_mesh *mesh = &scene->meshes[m];
    sbfi_matrix space = sbfi_scene_mesh_world(scene, mesh);
    space = sbfi_matrix_multiply(to_space, &space);
    for (uint32_t i = 0; i < mesh->corner_count; i++)
      polygon_points[corner++] = point + mesh->corner_points[i];
    for (uint32_t i = 0; i < mesh->polygon_count; i++)
      sizes[polygon++] = mesh->polygon_starts[i + 1] - mesh->polygon_starts[i];
    for (uint32_t i = 0; i < mesh->point_count; i++)
      positions[point++] = sbfi_transform_point(&space, mesh->points[i]);
    mesh_starts[m + 1] = point;
    polygon_starts[m + 1] = polygon;
  }
  surface->mesh_starts = mesh_starts;
  surface->polygon_starts = polygon_starts;
  surface->mesh.positions = (sbf_vec3_list){positions, point};
  surface->mesh.polygon_sizes = (sbf_u32_list){sizes, polygon};
  surface->mesh.polygon_points = (sbf_u32_list){polygon_points, corner};
  return finish(surface, arena);
}

bool sbfi_surface_with_positions(
    sbfi_scene_surface *to, const sbfi_scene_surface *from, const sbf_vec3 *positions, sbfi_arena *arena) {
  *to = *from;
  to->mesh.positions.at = positions;
  find_bounds(to);
  return find_normals(to, arena);
}

bool sbfi_surface_move(
    sbfi_scene_surface *to, const sbfi_scene_surface *from, const sbfi_matrix *matrix, sbfi_arena *arena) {
  sbf_vec3 *positions = sbfi_arena_allocate(arena, from->mesh.positions.count + 1, sizeof *positions);
  if (!positions) return false;
  for (uint32_t i = 0; i < from->mesh.positions.count; i++)
    positions[i] = sbfi_transform_point(matrix, from->mesh.positions.at[i]);
  return sbfi_surface_with_positions(to, from, positions, arena);
}

/* --- Weights ------------------------------------------------------------------------------------------- */

void sbfi_influences_add(sbfi_influences *to, uint32_t node, double weight) {
  uint32_t weakest = 0;
  if (!(weight > 0)) return;
  for (uint32_t i = 0; i < SBFI_MAX_INFLUENCES; i++) {
    if (to->at[i].weight <= 0) {
      to->at[i] = (sbfi_influence){node, (float)weight};
      return;
    }
    if (to->at[i].node == node) {
      to->at[i].weight += (float)weight;
      return;
    }
    if (to->at[i].weight < to->at[weakest].weight) weakest = i;
  }
  if (to->at[weakest].weight < (float)weight) to->at[weakest] = (sbfi_influence){node, (float)weight};
}

void sbfi_influences_finish(sbfi_influences *of) {
  static const double min = 1e-5;
  sbfi_influences from = *of;
  double sum = 0, kept = 0;
  uint32_t count = 0;
  for (uint32_t i = 0; i < SBFI_MAX_INFLUENCES && from.at[i].weight > 0; i++)
    sum += (double)from.at[i].weight;
  memset(of, 0, sizeof *of);
  for (uint32_t i = 0; i < SBFI_MAX_INFLUENCES && from.at[i].weight > 0; i++) {
    if ((double)from.at[i].weight < min * sum) continue;
    uint32_t at = count++;
    for (; at > 0 && of->at[at - 1].node > from.at[i].node; at--) of->at[at] = of->at[at - 1];
    of->at[at] = from.at[i];
    kept += (double)from.at[i].weight;
  }
  for (uint32_t i = 0; i < count; i++) of->at[i].weight = (float)((double)of->at[i].weight / kept);
}

bool sbfi_influences_equal(const sbfi_influences *a, const sbfi_influences *b) {
  for (uint32_t i = 0; i < SBFI_MAX_INFLUENCES; i++) {
    if (a->at[i].weight <= 0 && b->at[i].weight <= 0) return true;
    if (a->at[i].node != b->at[i].node || fabsf(a->at[i].weight - b->at[i].weight) > 1e-4f) return false;
  }
  return true;
}

/* Node of the bone that moves a node of the rig; false if there is none. */
static bool moved_by(const sbfi_conversion *c, int32_t node, uint32_t *bone_node) {
  int32_t bone = c->bone_of_node[node];
  if (bone != SBF_NONE) *bone_node = c->node_of_bone[bone];
  return bone != SBF_NONE;
}

static void skin_weights(
    const sbfi_conversion *c, const sbfi_scene_mesh *mesh, uint32_t point, sbfi_influences *to) {
  uint32_t node;
  for (uint32_t s = mesh->skin.starts[point]; s < mesh->skin.starts[point + 1]; s++)
    if (moved_by(c, mesh->skin.joints[mesh->skin.joint_index[s]].node, &node))
      sbfi_influences_add(to, node, (double)mesh->skin.weights[s]);
}

sbfi_influences *sbfi_rig_weights(sbfi_conversion *c, const sbfi_scene_surface *surface) {
  sbfi_influences *weights =
      sbfi_arena_allocate(&c->scratch, surface->mesh.positions.count + 1, sizeof *weights);
  for (uint32_t m = 0; weights && m < surface->scene->mesh_count; m++) {
    const sbfi_scene_mesh *mesh = &surface->scene->meshes[m];
    uint32_t home = 0;
    bool on_bone = moved_by(c, mesh->node, &home);
    for (uint32_t i = 0; i < mesh->point_count; i++) {
      sbfi_influences *to = &weights[surface->mesh_starts[m] + i];
      if (mesh->skin.joint_count)
        skin_weights(c, mesh, i, to);
      else if (on_bone)
        sbfi_influences_add(to, home, 1);
      sbfi_influences_finish(to);
    }
  }
  return weights;
}

uint32_t (*sbfi_surface_triangles(const sbfi_scene_surface *surface, uint32_t *count, sbfi_arena *arena))[3] {
  const sbf_polygon_mesh *mesh = &surface->mesh;
  uint32_t(*triangles)[3] =
      sbfi_arena_allocate(arena, (size_t)mesh->polygon_points.count + 1, sizeof *triangles);
  *count = 0;
  for (uint32_t p = 0, at = 0; triangles && p < mesh->polygon_sizes.count; at += mesh->polygon_sizes.at[p++])
    for (uint32_t k = 2; k < mesh->polygon_sizes.at[p]; k++) {
      const uint32_t *points = mesh->polygon_points.at + at;
      uint32_t *to = triangles[(*count)++];
      to[0] = points[0];
      to[1] = points[k - 1];
      to[2] = points[k];
    }
  return triangles;
}
