/* Contents of an asset, for JavaScript. */
#include <string.h>

#include "web.h"

/* Kinds of things that are counted and named. */
enum kind {
  KIND_BONES,
  KIND_MESHES,
  KIND_SOFT_BODIES,
  KIND_RIGID_BODIES,
  KIND_CLIPS,
  KIND_IK_CHAINS,
  KIND_LEGS,
  KIND_MATERIALS,
  KIND_TEXTURES
};

static const sbf_gait *gait_of(const sbf_asset *a) {
  return a->gaits.count ? &a->gaits.at[0] : NULL;
}

uint32_t WEB_CALL(web_asset_count)(const sbf_asset *a, uint32_t kind) {
  switch (kind) {
  case KIND_BONES:
    return a->bones.count;
  case KIND_MESHES:
    return a->render_meshes.count;
  case KIND_SOFT_BODIES:
    return a->soft_bodies.count;
  case KIND_RIGID_BODIES:
    return a->rigid_bodies.count;
  case KIND_CLIPS:
    return a->clips.count;
  case KIND_IK_CHAINS:
    return a->ik_chains.count;
  case KIND_LEGS:
    return gait_of(a) ? gait_of(a)->legs.count : 0;
  case KIND_MATERIALS:
    return a->materials.count;
  case KIND_TEXTURES:
    return a->textures.count;
  default:
    return 0;
  }
}

const char *WEB_CALL(web_asset_name)(const sbf_asset *a, uint32_t kind, uint32_t i) {
  if (i >= web_asset_count(a, kind)) return "";
  switch (kind) {
  case KIND_BONES:
    return a->bones.at[i].name;
  case KIND_MESHES:
    return a->render_meshes.at[i].name;
  case KIND_SOFT_BODIES:
    return a->soft_bodies.at[i].name;
  case KIND_RIGID_BODIES:
    return a->rigid_bodies.at[i].name;
  case KIND_CLIPS:
    return a->clips.at[i].name;
  case KIND_IK_CHAINS:
    return a->ik_chains.at[i].name;
  case KIND_LEGS:
    return gait_of(a)->legs.at[i].name;
  case KIND_MATERIALS:
    return a->materials.at[i].name;
  default:
    return a->textures.at[i].name;
  }
}

const char *WEB_CALL(web_asset_title)(const sbf_asset *a) {
  return a->info.title;
}

/* Maximum number of simulation levels of a body, and of render levels of a mesh, including the full one. */
uint32_t WEB_CALL(web_asset_levels)(const sbf_asset *a) {
  uint32_t max = 0;
  for (uint32_t i = 0; i < a->soft_bodies.count; i++)
    if (a->soft_bodies.at[i].levels.count > max) max = a->soft_bodies.at[i].levels.count;
  return max;
}
uint32_t WEB_CALL(web_asset_render_levels)(const sbf_asset *a) {
  uint32_t max = 1;
  for (uint32_t i = 0; i < a->render_meshes.count; i++)
    if (a->render_meshes.at[i].levels.count + 1 > max) max = a->render_meshes.at[i].levels.count + 1;
  return max;
}

/* Maximum error that bodies state for that level, m; 0: none stated. */
float WEB_CALL(web_asset_level_error)(const sbf_asset *a, uint32_t level) {
  float max = 0;
  for (uint32_t i = 0; i < a->soft_bodies.count; i++) {
    const sbf_level_list *levels = &a->soft_bodies.at[i].levels;
    if (level < levels->count && levels->at[level].simulation.error > max)
      max = levels->at[level].simulation.error;
  }
  return max;
}

/* Nine numbers: parent (-1: none), head (3), rotation (4), length. */
void WEB_CALL(web_asset_bone)(const sbf_asset *a, uint32_t i, float *to) {
  const sbf_bone *b = &a->bones.at[i];
  const float numbers[9] = {(float)b->parent, b->head.x, b->head.y, b->head.z, b->rotation.x, b->rotation.y,
      b->rotation.z, b->rotation.w, b->length};
  memcpy(to, numbers, sizeof numbers);
}

/* The bone that a rigid body moves with; -1: none. */
int32_t WEB_CALL(web_asset_rigid_bone)(const sbf_asset *a, uint32_t i) {
  return i < a->rigid_bodies.count ? a->rigid_bodies.at[i].bone : SBF_NONE;
}
int32_t WEB_CALL(web_asset_body_bone)(const sbf_asset *a, uint32_t i) {
  return i < a->soft_bodies.count ? a->soft_bodies.at[i].bone : SBF_NONE;
}

/* Fifteen numbers: base colour (4), metallic, roughness, emissive (3), alpha mode, cutoff, double sided, and
 * three textures (-1: none). */
void WEB_CALL(web_asset_material)(const sbf_asset *a, uint32_t i, float *to) {
  const sbf_material *m = &a->materials.at[i];
  const float numbers[15] = {m->base_color.x, m->base_color.y, m->base_color.z, m->base_color.w, m->metallic,
      m->roughness, m->emissive.x, m->emissive.y, m->emissive.z, (float)m->alpha_mode, m->alpha_cutoff,
      m->double_sided, (float)m->base_color_texture, (float)m->metallic_roughness_texture,
      (float)m->normal_texture};
  memcpy(to, numbers, sizeof numbers);
}
const char *WEB_CALL(web_asset_texture_type)(const sbf_asset *a, uint32_t i) {
  return a->textures.at[i].media_type;
}
const char *WEB_CALL(web_asset_texture_path)(const sbf_asset *a, uint32_t i) {
  return a->textures.at[i].path;
}
const uint8_t *WEB_CALL(web_asset_texture_bytes)(const sbf_asset *a, uint32_t i, uint32_t *size) {
  *size = a->textures.at[i].bytes.count;
  return a->textures.at[i].bytes.at;
}
