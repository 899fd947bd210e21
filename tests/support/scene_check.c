#include "scene_check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"

#define REQUIRE(condition)                                                                                   \
  do {                                                                                                       \
    if (!(condition)) return #condition;                                                                     \
  } while (0)

static bool finite_all(const float *values, size_t count) {
  for (size_t i = 0; i < count; i++)
    if (!isfinite(values[i])) return false;
  return true;
}

static bool finite_matrix(const sbfi_matrix *m) {
  for (int i = 0; i < 16; i++)
    if (!isfinite(m->at[i / 4][i % 4])) return false;
  return m->at[3][0] == 0 && m->at[3][1] == 0 && m->at[3][2] == 0 && m->at[3][3] == 1;
}

static bool good_text(const char *text) {
  return text && sbfi_utf8_check(text, strlen(text)) == strlen(text);
}

static bool indices_below(const int32_t *indices, uint32_t count, uint32_t bound) {
  for (uint32_t i = 0; i < count; i++)
    if (indices[i] != SBF_NONE && (indices[i] < 0 || (uint32_t)indices[i] >= bound)) return false;
  return true;
}

static const char *check_surface(const sbfi_scene *scene, const sbfi_scene_mesh *m) {
  REQUIRE(m->polygon_count > 0 && m->polygon_starts[0] == 0);
  REQUIRE(m->polygon_starts[m->polygon_count] == m->corner_count);
  for (uint32_t i = 0; i < m->polygon_count; i++)
    REQUIRE(m->polygon_starts[i + 1] - m->polygon_starts[i] >= 3);
  for (uint32_t i = 0; i < m->corner_count; i++) REQUIRE(m->corner_points[i] < m->point_count);
  REQUIRE(indices_below(m->polygon_materials, m->polygon_count, scene->material_count));
  REQUIRE(finite_all((const float *)m->points, 3 * (size_t)m->point_count));
  REQUIRE(finite_all((const float *)m->normals.at, 3 * (size_t)m->normals.count));
  REQUIRE(
      !m->normals.corner_index || indices_below(m->normals.corner_index, m->corner_count, m->normals.count));
  for (uint32_t i = 0; i < m->uv_set_count; i++) {
    REQUIRE(good_text(m->uv_sets[i].name));
    REQUIRE(finite_all((const float *)m->uv_sets[i].at, 2 * (size_t)m->uv_sets[i].count));
    REQUIRE(indices_below(m->uv_sets[i].corner, m->corner_count, m->uv_sets[i].count));
  }
  return NULL;
}

static const char *check_sources(const sbfi_scene_mesh *m) {
  if (!m->vertex_count) {
    for (uint32_t i = 1; i < m->point_count; i++) REQUIRE(m->point_sources[i - 1] < m->point_sources[i]);
    return NULL;
  }
  for (uint32_t i = 0; i < m->vertex_count; i++) REQUIRE(m->vertex_points[i] < m->point_count);
  for (uint32_t i = 0; i < m->point_count; i++) {
    REQUIRE(m->point_sources[i] < m->vertex_count);
    REQUIRE(m->vertex_points[m->point_sources[i]] == i);
  }
  for (uint32_t i = 0; i < m->corner_count; i++) {
    REQUIRE(m->corner_vertices[i] < m->vertex_count);
    REQUIRE(m->vertex_points[m->corner_vertices[i]] == m->corner_points[i]);
  }
  return NULL;
}

static const char *check_skin(const sbfi_scene *scene, const sbfi_scene_mesh *m) {
  for (uint32_t i = 0; i < m->skin.joint_count; i++) {
    REQUIRE(m->skin.joints[i].node >= 0 && (uint32_t)m->skin.joints[i].node < scene->node_count);
    REQUIRE(scene->nodes[m->skin.joints[i].node].is_bone && finite_matrix(&m->skin.joints[i].bind));
  }
  for (uint32_t p = 0; m->skin.joint_count && p < m->point_count; p++) {
    REQUIRE(m->skin.starts[p] <= m->skin.starts[p + 1]);
    for (uint32_t k = m->skin.starts[p]; k < m->skin.starts[p + 1]; k++) {
      REQUIRE(m->skin.joint_index[k] < m->skin.joint_count);
      REQUIRE(k == m->skin.starts[p] || m->skin.joint_index[k - 1] < m->skin.joint_index[k]);
      REQUIRE(m->skin.weights[k] > 0 && isfinite(m->skin.weights[k]));
    }
  }
  for (uint32_t i = 0; i < m->shape_count; i++) {
    REQUIRE(good_text(m->shapes[i].name) && isfinite(m->shapes[i].weight));
    REQUIRE(finite_all((const float *)m->shapes[i].delta, 3 * (size_t)m->point_count));
  }
  return NULL;
}

static const char *check_track(const float *times, const float *values, uint32_t count, uint32_t width) {
  REQUIRE(finite_all(times, count) && finite_all(values, (size_t)count * width));
  for (uint32_t i = 0; i < count; i++) {
    REQUIRE(times[i] >= 0 && (i == 0 || times[i - 1] < times[i]));
    if (width < 4) continue;
    const float *q = values + (size_t)i * 4;
    double length =
        sqrt((double)q[0] * q[0] + (double)q[1] * q[1] + (double)q[2] * q[2] + (double)q[3] * q[3]);
    REQUIRE(fabs(length - 1) < 1e-5);
  }
  return NULL;
}

static const char *check_clip(const sbfi_scene *scene, const sbfi_scene_clip *clip) {
  REQUIRE(good_text(clip->name) && isfinite(clip->duration_s) && clip->duration_s >= 0);
  for (uint32_t i = 0; i < clip->channel_count; i++) {
    const sbfi_scene_channel *c = &clip->channels[i];
    REQUIRE(c->node >= 0 && (uint32_t)c->node < scene->node_count);
    for (uint32_t k = 0; k < i; k++) REQUIRE(clip->channels[k].node != c->node);
    const char *broken = check_track(c->position_times, (const float *)c->positions, c->position_count, 3);
    if (!broken) broken = check_track(c->rotation_times, (const float *)c->rotations, c->rotation_count, 4);
    if (!broken) broken = check_track(c->scale_times, (const float *)c->scales, c->scale_count, 3);
    if (broken) return broken;
  }
  return NULL;
}

static const char *check_materials(const sbfi_scene *scene) {
  for (uint32_t i = 0; i < scene->material_count; i++) {
    const sbfi_scene_material *m = &scene->materials[i];
    REQUIRE(good_text(m->name) && finite_all(m->base_color, 4) && finite_all(m->emissive, 3));
    REQUIRE(m->metallic >= 0 && m->metallic <= 1 && m->roughness >= 0 && m->roughness <= 1);
    int32_t images[] = {m->base_color_image, m->metallic_roughness_image, m->normal_image};
    REQUIRE(indices_below(images, 3, scene->image_count));
  }
  for (uint32_t i = 0; i < scene->image_count; i++) {
    const sbfi_scene_image *image = &scene->images[i];
    REQUIRE(good_text(image->name) && good_text(image->extension));
    REQUIRE(image->path ? good_text(image->path) && !image->bytes : image->bytes && image->byte_count);
  }
  return NULL;
}

const char *scene_check(const sbfi_scene *scene) {
  REQUIRE(good_text(scene->file) && good_text(scene->format) && good_text(scene->generator));
  REQUIRE(isfinite(scene->unit_m) && scene->unit_m > 0 && finite_matrix(&scene->axes));
  REQUIRE(scene->warning_count <= SBFI_SCENE_WARNINGS);
  for (uint32_t i = 0; i < scene->node_count; i++) {
    const sbfi_scene_node *n = &scene->nodes[i];
    REQUIRE(good_text(n->name) && n->parent >= SBF_NONE && n->parent < (int32_t)i);
    REQUIRE(finite_matrix(&n->local) && finite_matrix(&n->world));
    for (int k = 0; k < SBFI_LIMITS; k++)
      REQUIRE(!n->limits[k].stated || (n->limits[k].min <= n->limits[k].max && isfinite(n->limits[k].min) &&
                                          isfinite(n->limits[k].max)));
  }
  const char *broken = check_materials(scene);
  for (uint32_t i = 0; !broken && i < scene->mesh_count; i++) {
    const sbfi_scene_mesh *m = &scene->meshes[i];
    REQUIRE(good_text(m->name) && m->node >= 0 && (uint32_t)m->node < scene->node_count);
    broken = check_surface(scene, m);
    if (!broken) broken = check_sources(m);
    if (!broken) broken = check_skin(scene, m);
  }
  for (uint32_t i = 0; !broken && i < scene->clip_count; i++) broken = check_clip(scene, &scene->clips[i]);
  return broken;
}

scene_counts scene_count(const sbfi_scene *scene) {
  scene_counts c = {.meshes = scene->mesh_count, .bones = sbfi_scene_bone_count(scene)};
  for (uint32_t i = 0; i < scene->node_count; i++) c.ends += scene->nodes[i].is_end;
  for (uint32_t i = 0; i < scene->mesh_count; i++) {
    const sbfi_scene_mesh *m = &scene->meshes[i];
    c.points += m->point_count;
    c.polygons += m->polygon_count;
    for (uint32_t p = 0; p < m->polygon_count; p++) {
      uint32_t size = m->polygon_starts[p + 1] - m->polygon_starts[p];
      c.triangles += size == 3;
      c.quads += size == 4;
      c.ngons += size > 4;
    }
    for (uint32_t p = 0; m->skin.joint_count && p < m->point_count; p++)
      c.skinned += m->skin.starts[p + 1] > m->skin.starts[p];
    bool *used = calloc(m->point_count, sizeof *used);
    for (uint32_t k = 0; k < m->corner_count; k++) used[m->corner_points[k]] = true;
    for (uint32_t p = 0; p < m->point_count; p++) c.unused += !used[p];
    free(used);
  }
  return c;
}

int32_t scene_find_node(const sbfi_scene *scene, const char *name, bool bone) {
  for (uint32_t i = 0; i < scene->node_count; i++)
    if (scene->nodes[i].is_bone == bone && strcmp(scene->nodes[i].name, name) == 0) return (int32_t)i;
  return SBF_NONE;
}

const sbfi_scene_mesh *scene_mesh_of_node(const sbfi_scene *scene, const char *node_name) {
  for (uint32_t i = 0; i < scene->mesh_count; i++)
    if (strcmp(scene->nodes[scene->meshes[i].node].name, node_name) == 0) return &scene->meshes[i];
  return NULL;
}
