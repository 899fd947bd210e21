/* Predefined shapes of a scene: spheres, bones, hulls. */
#include <stdlib.h>

#include "render/draw_scene_data.h"

enum { SPHERE_RINGS = 10, SPHERE_SEGMENTS = 18 };

static const float full_turn = 6.28318531f;
static const draw_scene_part solid = {.casts_shadow = true};

void draw_scene_add_sphere(draw_scene *scene, sbf_vec3 centre, float radius, draw_colour colour) {
  enum { ROW = SPHERE_SEGMENTS + 1, VERTICES = (SPHERE_RINGS + 1) * ROW };
  draw_scene_space space;
  if (!draw_scene_reserve(scene, VERTICES, 2 * SPHERE_RINGS * SPHERE_SEGMENTS, &space)) return;
  uint32_t vertex = 0, index = 0;
  for (int ring = 0; ring <= SPHERE_RINGS; ring++)
    for (int segment = 0; segment <= SPHERE_SEGMENTS; segment++, vertex++) {
      float down = 0.5f * full_turn * (float)ring / SPHERE_RINGS;
      float around = full_turn * (float)segment / SPHERE_SEGMENTS;
      sbf_vec3 out = {sinf(down) * sinf(around), cosf(down), sinf(down) * cosf(around)};
      space.positions[vertex] = v3_add(centre, v3_scale(out, radius));
      space.normals[vertex] = out;
      space.colours[vertex] = colour;
    }
  for (uint32_t ring = 0; ring < SPHERE_RINGS; ring++)
    for (uint32_t segment = 0; segment < SPHERE_SEGMENTS; segment++) {
      uint32_t a = space.first_vertex + ring * ROW + segment, b = a + ROW;
      const uint32_t two[6] = {a, b, b + 1, a, b + 1, a + 1};
      for (int k = 0; k < 6; k++) space.indices[index++] = two[k];
    }
  draw_scene_close_part(scene, &space, VERTICES, index, &solid);
}

void draw_scene_add_bone(draw_scene *scene, sbf_vec3 head, sbf_vec3 tail, draw_colour colour) {
  sbf_vec3 run = v3_sub(tail, head);
  float length = v3_length(run);
  if (!(length > 1e-6f)) return;
  sbf_vec3 ahead = v3_scale(run, 1 / length), right = v3_side(ahead), over = v3_cross(ahead, right);
  sbf_vec3 waist = v3_add(head, v3_scale(run, 0.14f));
  float half = 0.085f * length;
  sbf_vec3 corners[6] = {head, tail, v3_add(waist, v3_scale(right, half)),
      v3_add(waist, v3_scale(over, half)), v3_sub(waist, v3_scale(right, half)),
      v3_sub(waist, v3_scale(over, half))};
  static const uint32_t triangles[24] = {
      0, 3, 2, 0, 4, 3, 0, 5, 4, 0, 2, 5, 1, 2, 3, 1, 3, 4, 1, 4, 5, 1, 5, 2};
  draw_scene_add_mesh(scene, &(draw_mesh){.positions = corners,
                                 .vertex_count = 6,
                                 .triangles = triangles,
                                 .triangle_count = 8,
                                 .colour = colour,
                                 .flat = true});
  draw_scene_add_sphere(scene, head, 0.055f * length, colour);
  draw_scene_add_sphere(scene, tail, 0.035f * length, colour);
}

static sbf_vec3 facet_normal(const sbf_vec3 *positions, const uint32_t *triangle) {
  sbf_vec3 a = positions[triangle[0]];
  sbf_vec3 across = v3_cross(v3_sub(positions[triangle[1]], a), v3_sub(positions[triangle[2]], a));
  return v3_unit(across, v3(0, 0, 0));
}

/* The triangle on the other side of the edge from..to, or `triangle_count`. */
static uint32_t neighbour(const uint32_t *triangles, uint32_t triangle_count, uint32_t from, uint32_t to) {
  for (uint32_t t = 0; t < triangle_count; t++)
    for (int k = 0; k < 3; k++)
      if (triangles[3 * (size_t)t + k] == to && triangles[3 * (size_t)t + (k + 1) % 3] == from) return t;
  return triangle_count;
}

void draw_scene_add_hull(draw_scene *scene, const sbf_vec3 *positions, uint32_t vertex_count,
    const uint32_t *triangles, uint32_t triangle_count, const draw_transform *transform, draw_colour colour) {
  const float same_plane = 0.9995f; /* cosine: facets that qhull cut from one polygon */
  draw_scene_add_mesh(scene, &(draw_mesh){.positions = positions,
                                 .vertex_count = vertex_count,
                                 .triangles = triangles,
                                 .triangle_count = triangle_count,
                                 .colour = colour,
                                 .transparency = 0.8f,
                                 .no_shadow = true,
                                 .flat = true,
                                 .transform = transform});
  draw_colour edge = draw_colour_mix(colour, (draw_colour){20, 26, 40, 255}, 0.25f);
  for (uint32_t i = 0; i < 3 * triangle_count; i++)
    if (triangles[i] >= vertex_count) return;
  for (uint32_t t = 0; t < triangle_count; t++)
    for (int k = 0; k < 3; k++) {
      uint32_t from = triangles[3 * (size_t)t + k], to = triangles[3 * (size_t)t + (k + 1) % 3];
      if (from >= to) continue; /* the triangle on the other side has the other direction */
      uint32_t other = neighbour(triangles, triangle_count, from, to);
      if (other < triangle_count && v3_dot(facet_normal(positions, triangles + 3 * (size_t)t),
                                        facet_normal(positions, triangles + 3 * (size_t)other)) > same_plane)
        continue;
      sbf_vec3 a = positions[from], b = positions[to];
      if (transform) {
        a = v3_add(v3_rotate(transform->rotation, a), transform->position);
        b = v3_add(v3_rotate(transform->rotation, b), transform->position);
      }
      draw_scene_add_line(scene, &(draw_line){a, b, edge, edge, 1.2f});
    }
}
