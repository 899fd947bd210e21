#include "rigged_model.h"

#include <math.h>
#include <string.h>

#include "measuring.h"
#include "sbfmt/convert.h"

static void *allocate(rigged_model *m, size_t count, size_t size) {
  void *memory = sbfi_arena_allocate(&m->arena, count + 1, size);
  if (!memory) bench_fail("memory ran out");
  return memory;
}

static void add_mesh(rigged_model *m, const sbf_render_mesh *from) {
  const uint32_t *corners = from->mesh.polygon_points.at;
  for (uint32_t p = 0; p < from->mesh.polygon_sizes.count; corners += from->mesh.polygon_sizes.at[p++])
    for (uint32_t k = 2; k < from->mesh.polygon_sizes.at[p]; k++) {
      uint32_t *to = m->triangles[m->triangle_count++];
      to[0] = m->point_count + corners[0];
      to[1] = m->point_count + corners[k - 1];
      to[2] = m->point_count + corners[k];
    }
  uint32_t at = m->influence_begins[m->point_count];
  memcpy(m->joints + at, from->skin->bones.at, from->skin->bones.count * sizeof *m->joints);
  memcpy(m->weights + at, from->skin->weights.at, from->skin->weights.count * sizeof *m->weights);
  for (uint32_t i = 0; i < from->mesh.positions.count; i++) {
    m->points[m->point_count++] = from->mesh.positions.at[i];
    m->influence_begins[m->point_count] = at += from->skin->influence_counts.at[i];
  }
}

static void take_surface(rigged_model *m) {
  size_t points = 0, corners = 0, influences = 0;
  for (uint32_t i = 0; i < m->asset->render_meshes.count; i++) {
    const sbf_render_mesh *mesh = &m->asset->render_meshes.at[i];
    if (!mesh->skin) continue;
    points += mesh->mesh.positions.count;
    corners += mesh->mesh.polygon_points.count;
    influences += mesh->skin->bones.count;
  }
  m->points = allocate(m, points, sizeof *m->points);
  m->triangles = allocate(m, corners, sizeof *m->triangles);
  m->influence_begins = allocate(m, points + 1, sizeof *m->influence_begins);
  m->joints = allocate(m, influences, sizeof *m->joints);
  m->weights = allocate(m, influences, sizeof *m->weights);
  for (uint32_t i = 0; i < m->asset->render_meshes.count; i++)
    if (m->asset->render_meshes.at[i].skin) add_mesh(m, &m->asset->render_meshes.at[i]);
}

static void take_bones(rigged_model *m) {
  m->bones = allocate(m, m->asset->bones.count, sizeof *m->bones);
  m->sides = allocate(m, m->asset->bones.count, sizeof *m->sides);
  for (uint32_t b = 0; b < m->asset->bones.count; b++) {
    m->bones[b] = m->asset->bones.at[b];
    m->bones[b].length = 0;
    m->sides[b] = (int8_t)sbfi_name_side(m->bones[b].name);
  }
}

static void measure_size(rigged_model *m) {
  double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
  for (uint32_t i = 0; i < m->point_count; i++) {
    const double at[3] = {m->points[i].x, m->points[i].y, m->points[i].z};
    for (int k = 0; k < 3; k++) low[k] = fmin(low[k], at[k]), high[k] = fmax(high[k], at[k]);
  }
  for (int k = 0; k < 3; k++) m->size = fmax(m->size, high[k] - low[k]);
}

bool rigged_model_load(rigged_model *m, const char *path) {
  sbf_diagnostic error;
  *m = (rigged_model){0};
  bench_require(sbf_convert(path, NULL, &m->asset, &error), &error);
  sbfi_arena_init(&m->arena, NULL, 0);
  take_surface(m);
  take_bones(m);
  measure_size(m);
  if (m->point_count) return true;
  rigged_model_free(m);
  return false;
}

void rigged_model_free(rigged_model *m) {
  sbfi_arena_free(&m->arena);
  sbf_asset_free(m->asset);
  *m = (rigged_model){0};
}

sbfi_weights_input rigged_model_input(const rigged_model *m) {
  return (sbfi_weights_input){.points = m->points,
      .point_count = m->point_count,
      .triangles = (const uint32_t(*)[3])m->triangles,
      .triangle_count = m->triangle_count,
      .bones = m->bones,
      .bone_count = m->asset->bones.count,
      .sides = m->sides};
}

/* --- Poses ------------------------------------------------------------------------------------------- */

static bool has_word(const char *text, const char *word) {
  for (; *text; text++) {
    size_t k = 0;
    while (word[k] && (text[k] | 0x20) == word[k]) k++;
    if (!word[k]) return true;
  }
  return false;
}

static bool is_wanted(const sbf_clip *clip) {
  static const char *const words[] = {"walk", "run", "gallop", "swim", "fly", "attack", "idle"};
  for (size_t i = 0; i < sizeof words / sizeof *words; i++)
    if (has_word(clip->name, words[i])) return true;
  return false;
}

/* Turns bones away from rest, about x or z, to one way or the other. */
static void bend(const rigged_model *m, uint32_t number, sbfi_bone_frame *frames) {
  static const double limb[2] = {0.3420201433, 0.9396926208}, spine[2] = {0.1305261922, 0.9914448614};
  for (uint32_t b = 0; b < m->asset->bones.count; b++) {
    sbfi_bone_frame rest = frames[b];
    bool is_limb = m->sides[b] != 0;
    const double *half = is_limb ? limb : spine;
    double sign = (number & 1 ? 1 : -1) * ((number & 2) && m->sides[b] < 0 ? -1 : 1);
    double rotation[4] = {0, 0, 0, 1}, direction[3], back[4];
    if (is_limb || m->bones[b].parent != SBF_NONE) {
      rotation[number & 4 ? 2 : 0] = sign * half[0];
      rotation[3] = half[1];
    }
    int32_t parent = m->bones[b].parent;
    sbfi_quatd_multiply(rotation, rest.rotation, frames[b].rotation);
    if (parent == SBF_NONE) continue;
    /* The parent stands before, and is posed already. */
    const sbf_quat q = m->bones[parent].rotation;
    const double parent_rest[4] = {q.x, q.y, q.z, q.w};
    const sbf_vec3 head = m->bones[parent].head;
    const double from[3] = {rest.position[0] - head.x, rest.position[1] - head.y, rest.position[2] - head.z};
    double moved[4];
    sbfi_quatd_conjugate(parent_rest, back);
    sbfi_quatd_multiply(frames[parent].rotation, back, moved);
    sbfi_quatd_rotate(moved, from, direction);
    for (int k = 0; k < 3; k++) frames[b].position[k] = frames[parent].position[k] + direction[k];
    sbfi_quatd_multiply(moved, rotation, frames[b].rotation);
    sbfi_quatd_multiply(frames[b].rotation, rest.rotation, frames[b].rotation);
  }
}

bool rigged_model_pose(rigged_model *m, uint32_t number, sbfi_bone_frame *frames) {
  uint32_t clips = 0, of = number / RIGGED_POSES;
  for (uint32_t c = 0; c < m->asset->clips.count; c++) {
    if (!is_wanted(&m->asset->clips.at[c]) || clips++ != of) continue;
    sbfi_clip_poses poses;
    float time_s = m->asset->clips.at[c].duration * ((float)(number % RIGGED_POSES) + 0.5f) / RIGGED_POSES;
    if (!sbfi_clip_poses_init(&poses, m->asset, &m->asset->clips.at[c], &m->arena))
      bench_fail("memory ran out");
    sbfi_clip_pose(&poses, time_s, frames);
    return true;
  }
  if (clips || number >= RIGGED_POSES) return false;
  sbfi_compute_rest_frames(m->asset, frames);
  bend(m, number, frames);
  return true;
}
