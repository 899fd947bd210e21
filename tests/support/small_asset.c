#include "small_asset.h"

#include <stdlib.h>
#include <string.h>

#include "shapes.h"

static void *allocate(sbf_asset *asset, size_t count, size_t size) {
  void *memory = sbf_asset_allocate(asset, count, size);
  if (!memory) abort();
  return memory;
}

static sbf_level small_level(sbf_asset *asset, const sbf_polygon_mesh *mesh, const char *name) {
  sbf_level level;
  sbf_level_init(&level);
  level.name = name;
  level.positions = mesh->positions;
  sbf_spring_set *springs = allocate(asset, 1, sizeof *springs);
  sbf_uint2 *ends = allocate(asset, mesh->positions.count, sizeof *ends);
  for (uint32_t i = 0; i < mesh->positions.count; i++)
    ends[i] = (sbf_uint2){{i, (i + 1) % mesh->positions.count}};
  sbf_spring_set_init(springs);
  springs->kind = SBF_SPRING_KIND_SHEAR;
  springs->ends = (sbf_uint2_list){ends, mesh->positions.count};
  level.springs = (sbf_spring_set_list){springs, 1};
  sbf_pin_set *pins = allocate(asset, 1, sizeof *pins);
  uint32_t *points = allocate(asset, 3, sizeof *points);
  for (uint32_t i = 0; i < 3; i++) points[i] = i;
  sbf_pin_set_init(pins);
  pins->bone = 1;
  pins->points = (sbf_u32_list){points, 3};
  level.pins = (sbf_pin_set_list){pins, 1};
  return level;
}

static sbf_soft_body small_body(
    sbf_asset *asset, uint32_t n, const char *id, const char *name, int32_t bone) {
  sbf_soft_body body;
  sbf_soft_body_init(&body);
  body.id = id;
  body.name = name;
  body.bone = bone;
  body.surface = shape_cube(asset, n, 0.5f, (sbf_vec3){0, (float)n, 0});
  body.surface.target = SBF_MESH_TARGET_SURFACE;
  body.attributes.young_modulus = 20000;
  sbf_level *levels = allocate(asset, 2, sizeof *levels);
  levels[0] = small_level(asset, &body.surface, "fine");
  levels[1] = small_level(asset, &body.surface, "coarse");
  body.levels = (sbf_level_list){levels, 2};
  return body;
}

sbf_asset *small_asset(void) {
  sbf_asset *asset = sbf_asset_create(NULL);
  if (!asset) abort();
  asset->info.title = "Small \xc3\xa9";
  sbf_bone *bones = allocate(asset, 2, sizeof *bones);
  for (int i = 0; i < 2; i++) sbf_bone_init(&bones[i]);
  bones[0].id = "root";
  bones[1].id = "neck";
  bones[1].parent = 0;
  bones[1].length = 0.25f;
  asset->bones = (sbf_bone_list){bones, 2};

  sbf_texture *texture = allocate(asset, 1, sizeof *texture);
  uint8_t *image = allocate(asset, 333, 1);
  for (int i = 0; i < 333; i++) image[i] = (uint8_t)(i * i * 7);
  sbf_texture_init(texture);
  texture->id = "skin";
  texture->media_type = "image/png";
  texture->bytes = (sbf_u8_list){image, 333};
  asset->textures = (sbf_texture_list){texture, 1};

  sbf_render_mesh *mesh = allocate(asset, 1, sizeof *mesh);
  sbf_render_mesh_init(mesh);
  mesh->id = "seen";
  mesh->mesh = shape_cube(asset, 3, 1, (sbf_vec3){0, 1, 0});
  mesh->mesh.target = SBF_MESH_TARGET_RENDERING;
  asset->render_meshes = (sbf_render_mesh_list){mesh, 1};

  sbf_soft_body *bodies = allocate(asset, 2, sizeof *bodies);
  bodies[0] = small_body(asset, 2, "body_1", "head", 1);
  bodies[1] = small_body(asset, 3, "body_2", "tail", 0);
  asset->soft_bodies = (sbf_soft_body_list){bodies, 2};

  sbf_gait *gait = allocate(asset, 1, sizeof *gait);
  sbf_gait_init(gait);
  gait->id = "walk";
  gait->body = 0;
  asset->gaits = (sbf_gait_list){gait, 1};

  sbf_bone_mask *mask = allocate(asset, 1, sizeof *mask);
  uint32_t *masked = allocate(asset, 80, sizeof *masked);
  for (uint32_t i = 0; i < 80; i++) masked[i] = i % 2;
  sbf_bone_mask_init(mask);
  mask->id = "mask";
  mask->bones = (sbf_u32_list){masked, 80};
  asset->bone_masks = (sbf_bone_mask_list){mask, 1};
  return asset;
}
