#include "import/rigging/body_core.h"

#include "build/weights/body_rays.h"
#include "import/rigging/similarity.h"

/* As fractions of the longest side: depth below the surface at which rays start; minimum radius in the
 * weight by length. */
static const double BELOW = 1e-4, MIN_RADIUS = 0.02;

static double area_of(const sbfi_weight_mesh *mesh, const uint32_t corners[3], sbfi_d3 *normal) {
  sbfi_d3 a = sbfi_d3_of(mesh->sites[corners[0]]);
  sbfi_d3 n = sbfi_d3_cross(sbfi_d3_sub(sbfi_d3_of(mesh->sites[corners[1]]), a),
      sbfi_d3_sub(sbfi_d3_of(mesh->sites[corners[2]]), a));
  *normal = sbfi_d3_normal(n);
  return sbfi_d3_length(n);
}

/* Point of a triangle; successive numbers spread over it. */
static sbfi_d3 point_on(const sbfi_weight_mesh *mesh, const uint32_t corners[3], uint32_t number) {
  double u = sqrt(fmod(0.5 + number * 0.7548776662466927, 1.0)),
         v = fmod(0.5 + number * 0.5698402909980532, 1.0);
  const double weights[3] = {1 - u, u * (1 - v), u * v};
  sbfi_d3 sum = {0, 0, 0};
  for (int k = 0; k < 3; k++)
    sum = sbfi_d3_add(sum, sbfi_d3_scale(sbfi_d3_of(mesh->sites[corners[k]]), weights[k]));
  return sum;
}

/* Open pieces may face either direction, and sheets enclose nothing. */
static bool find_inwards(const sbfi_body_rays *rays, sbfi_d3 at, sbfi_d3 normal, sbfi_d3 *inwards) {
  for (int sign = -1; sign <= 1; sign += 2) {
    *inwards = sbfi_d3_scale(normal, sign);
    if (sbfi_body_contains(rays, sbfi_d3_add(at, sbfi_d3_scale(*inwards, BELOW)))) return true;
  }
  return false;
}

static void add_point(sbfi_body_core *core, const sbfi_body_rays *rays, sbfi_d3 at, sbfi_d3 normal) {
  sbfi_d3 inwards;
  if (!find_inwards(rays, at, normal, &inwards)) return;
  sbfi_d3 from = sbfi_d3_add(at, sbfi_d3_scale(inwards, BELOW));
  double radius = 0.5 * (BELOW + sbfi_body_exit_distance(rays, from, inwards));
  if (!isfinite(radius)) return;
  core->points[core->count++] = (sbfi_core_point){
      sbfi_d3_add(at, sbfi_d3_scale(inwards, radius)), radius, 1 / fmax(radius, MIN_RADIUS)};
}

static void sample(const sbfi_weight_mesh *mesh, const sbfi_body_rays *rays, sbfi_body_core *core) {
  double area = 0, passed = 0;
  uint32_t next = 0;
  sbfi_d3 normal;
  for (uint32_t t = 0; t < mesh->triangle_count; t++) area += area_of(mesh, mesh->triangles[t], &normal);
  double step = area / SBFI_CORE_POINTS;
  for (uint32_t t = 0; t < mesh->triangle_count && step > 0; t++) {
    passed += area_of(mesh, mesh->triangles[t], &normal);
    for (; next < SBFI_CORE_POINTS && (next + 0.5) * step < passed; next++)
      add_point(core, rays, point_on(mesh, mesh->triangles[t], next), normal);
  }
}

static void project_to_surface(const sbfi_weight_mesh *mesh, sbfi_body_core *core) {
  double sum = 0;
  for (uint32_t i = 0; i < core->count; i++) sum += core->points[i].weight;
  for (uint32_t i = 0; i < core->count; i++) {
    sbfi_core_point *p = &core->points[i];
    p->position = sbfi_d3_add(mesh->low, sbfi_d3_scale(p->position, 1 / mesh->scale));
    p->radius /= mesh->scale;
    p->weight /= sum;
  }
}

bool sbfi_body_core_find(const sbfi_scene_surface *surface, sbfi_body_core *core, sbfi_arena *arena) {
  sbfi_weights_input in = {.allocator = &arena->allocator,
      .points = surface->mesh.positions.at,
      .point_count = surface->mesh.positions.count};
  sbfi_weight_mesh mesh;
  sbfi_body_rays rays;
  core->count = 0;
  in.triangles = (const uint32_t(*)[3])sbfi_surface_triangles(surface, &in.triangle_count, arena);
  if (!in.triangles) return false;
  sbfi_weight_mesh_result made = sbfi_weight_mesh_make(&mesh, &in, arena);
  if (made != SBFI_WEIGHT_MESH_GOOD) return made != SBFI_WEIGHT_MESH_NO_MEMORY;
  uint32_t *sizes = sbfi_arena_allocate(arena, mesh.triangle_count, sizeof *sizes);
  if (!sizes) return false;
  for (uint32_t t = 0; t < mesh.triangle_count; t++) sizes[t] = 3;
  sbf_polygon_mesh triangles = sbfi_weight_mesh_surface(&mesh, sizes);
  if (!sbfi_body_rays_make(&rays, &triangles, arena)) return false;
  sample(&mesh, &rays, core);
  project_to_surface(&mesh, core);
  return true;
}

void sbfi_body_core_move(const sbfi_body_core *from, const sbfi_matrix *similarity, sbfi_body_core *to) {
  double scale = sbfi_similarity_scale(similarity);
  *to = *from;
  for (uint32_t i = 0; i < to->count; i++) {
    to->points[i].position = sbfi_similarity_apply(similarity, from->points[i].position);
    to->points[i].radius *= scale;
  }
}
