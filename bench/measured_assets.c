#include "measured_assets.h"

#include <math.h>
#include <stdio.h>
#include <unistd.h>

#include "measuring.h"
#include "sbfmt/build.h"
#include "sbfmt/convert.h"

static const double PI = 3.14159265358979323846;

static void *allocate(sbf_asset *asset, size_t count, size_t size) {
  void *memory = sbf_asset_allocate(asset, count, size);
  if (!memory) bench_fail("memory ran out");
  return memory;
}

static void make_points(sbf_asset *asset, sbf_render_mesh *mesh, sbf_uv_set *uv_set, uint32_t cells) {
  uint32_t row = cells + 1, count = row * row, random = 1;
  sbf_vec3 *positions = allocate(asset, count, sizeof *positions);
  sbf_vec3 *normals = allocate(asset, count, sizeof *normals);
  sbf_vec2 *coordinates = allocate(asset, count, sizeof *coordinates);
  for (uint32_t at = 0; at < count; at++) {
    uint32_t i = at / row, j = at % row;
    double u = 2 * PI * i / cells, w = PI * j / cells;
    random = random * 1664525u + 1013904223u;
    double radius = 1 + 0.2 * sin(7 * u) * cos(5 * w) + 1e-3 * (random >> 8) / 16777216.0;
    sbf_vec3 n = {(float)(cos(u) * sin(w)), (float)cos(w), (float)(sin(u) * sin(w))};
    normals[at] = n;
    positions[at] = (sbf_vec3){(float)radius * n.x, (float)radius * n.y, (float)radius * n.z};
    coordinates[at] = (sbf_vec2){(float)i / (float)cells, (float)j / (float)cells};
  }
  mesh->mesh.positions = (sbf_vec3_list){positions, count};
  mesh->normals = (sbf_vec3_list){normals, count};
  uv_set->coordinates = (sbf_vec2_list){coordinates, count};
}

static void make_quads(sbf_asset *asset, sbf_render_mesh *mesh, uint32_t cells) {
  uint32_t count = cells * cells, row = cells + 1;
  uint32_t *sizes = allocate(asset, count, sizeof *sizes);
  uint32_t *corners = allocate(asset, 4 * (size_t)count, sizeof *corners);
  for (uint32_t quad = 0; quad < count; quad++) {
    uint32_t first = quad / cells * row + quad % cells;
    const uint32_t around[4] = {first, first + row, first + row + 1, first + 1};
    sizes[quad] = 4;
    for (uint32_t k = 0; k < 4; k++) corners[4 * quad + k] = around[k];
  }
  mesh->mesh.polygon_sizes = (sbf_u32_list){sizes, count};
  mesh->mesh.polygon_points = (sbf_u32_list){corners, 4 * count};
}

sbf_asset *surface_asset(uint32_t cells) {
  sbf_asset *asset = sbf_asset_create(NULL);
  if (!asset) bench_fail("memory ran out");
  sbf_render_mesh *mesh = allocate(asset, 1, sizeof *mesh);
  sbf_uv_set *uv_set = allocate(asset, 1, sizeof *uv_set);
  sbf_render_mesh_init(mesh);
  sbf_uv_set_init(uv_set);
  mesh->id = "surface";
  mesh->mesh.target = SBF_MESH_TARGET_RENDERING;
  make_points(asset, mesh, uv_set, cells);
  make_quads(asset, mesh, cells);
  mesh->uv_sets = (sbf_uv_set_list){uv_set, 1};
  asset->render_meshes = (sbf_render_mesh_list){mesh, 1};
  return asset;
}

sbf_asset *character_asset(const char *folder, const char *mesh, const char *rig, bool build) {
  char mesh_path[4096], rig_path[4096];
  snprintf(mesh_path, sizeof mesh_path, "%s/%s", folder, mesh);
  snprintf(rig_path, sizeof rig_path, "%s/%s", folder, rig ? rig : "");
  if (access(mesh_path, R_OK) != 0) return NULL;
  const sbf_convert_options options = {.rig = rig ? rig_path : NULL};
  sbf_asset *asset, *built;
  sbf_diagnostic error;
  bench_require(sbf_convert(mesh_path, &options, &asset, &error), &error);
  if (!build) return asset;
  bench_require(sbf_build(asset, NULL, &built, NULL, &error), &error);
  sbf_asset_free(asset);
  return built;
}

sbf_asset *our_lizard(bool build) {
  sbf_asset *asset =
      character_asset(BENCH_SOURCE_FOLDER "/examples/lizard", "lizard.obj", "lizard.glb", build);
  if (!asset) bench_fail("examples/lizard/lizard.obj is not there");
  return asset;
}

sbf_asset *meshes_alone(sbf_asset *asset) {
  sbf_asset *alone = sbf_asset_create(NULL);
  if (!alone) bench_fail("memory ran out");
  uint32_t count = asset->render_meshes.count;
  sbf_render_mesh *meshes = allocate(alone, count, sizeof *meshes);
  for (uint32_t i = 0; i < count; i++) {
    meshes[i] = asset->render_meshes.at[i];
    meshes[i].bone = meshes[i].derived = SBF_NONE;
    meshes[i].skin = NULL;
    meshes[i].material_slots = (sbf_material_slot_list){NULL, 0};
    meshes[i].polygon_materials = meshes[i].source_points = (sbf_u32_list){NULL, 0};
  }
  alone->render_meshes = (sbf_render_mesh_list){meshes, count};
  sbf_asset *clone = sbf_asset_clone(alone, NULL);
  if (!clone) bench_fail("memory ran out");
  sbf_asset_free(alone);
  sbf_asset_free(asset);
  return clone;
}

uint32_t vertex_count_of(const sbf_asset *asset) {
  uint32_t count = 0;
  for (uint32_t i = 0; i < asset->render_meshes.count; i++)
    count += asset->render_meshes.at[i].mesh.positions.count;
  return count;
}

uint32_t polygon_count_of(const sbf_asset *asset) {
  uint32_t count = 0;
  for (uint32_t i = 0; i < asset->render_meshes.count; i++)
    count += asset->render_meshes.at[i].mesh.polygon_sizes.count;
  return count;
}

void count_elements(const sbf_asset *asset, uint32_t *points, uint32_t *springs) {
  *points = *springs = 0;
  for (uint32_t i = 0; i < asset->soft_bodies.count; i++) {
    const sbf_soft_body *body = &asset->soft_bodies.at[i];
    if (!body->levels.count) continue;
    *points += body->levels.at[0].positions.count;
    for (uint32_t s = 0; s < body->levels.at[0].springs.count; s++)
      *springs += body->levels.at[0].springs.at[s].ends.count;
  }
}
