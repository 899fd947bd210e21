#include "motion_cache.h"

#include <stdio.h>
#include <string.h>

#include "sbfmt/codes.h"

bool motion_cache_named(const char *path) {
  const char *point = strrchr(path, '.');
  return point && (strcmp(point, ".pc2") == 0 || strcmp(point, ".mdd") == 0);
}

static uint32_t skin_points(const sbf_asset *asset) {
  uint32_t count = 0;
  for (uint32_t i = 0; i < asset->render_meshes.count; i++)
    count += asset->render_meshes.at[i].mesh.positions.count;
  return count;
}

static void print_left_out(const cli_call *call, const char *path, const sbf_asset *asset) {
  sbf_diagnostic left = {.code = SBF_CODE_EXPORT_LEFT_OUT,
      .severity = SBF_SEVERITY_WARNING,
      .line = 0,
      .offset = -1,
      .index = -1};
  snprintf(left.message, sizeof left.message,
      "%s: a point cache has only positions of vertices. Left out: polygons of render meshes (export an .obj "
      "for them): %u, bones: %u, soft bodies: %u, rigid bodies: %u, materials: %u",
      path, (unsigned)asset->render_meshes.count, (unsigned)asset->bones.count,
      (unsigned)asset->soft_bodies.count, (unsigned)asset->rigid_bodies.count,
      (unsigned)asset->materials.count);
  cli_print_diagnostic(call, &left);
}

sbf_status motion_cache_write(const cli_call *call, const char *path, const sbf_asset *asset,
    const sbf_export_motion *motion, sbf_diagnostic *error) {
  sbf_point_cache *cache;
  uint32_t points = skin_points(asset);
  if (points == 0) {
    *error = (sbf_diagnostic){.code = SBF_CODE_EXPORT_EMPTY, .offset = -1, .index = -1};
    snprintf(error->message, sizeof error->message,
        "there is no render mesh: `sbfmt run FILE --cache %s --of surface` writes the bodies' surfaces",
        path);
    return SBF_BAD_INPUT;
  }
  sbf_status status = sbf_point_cache_open(path, points, motion->frame_count, motion->frame_s, &cache, error);
  if (status != SBF_OK) return status;
  for (uint32_t frame = 0; status == SBF_OK && frame < motion->frame_count; frame++)
    status = sbf_point_cache_add(cache, motion->skin + (size_t)frame * points, error);
  if (status == SBF_OK)
    status = sbf_point_cache_commit(cache, error);
  else
    sbf_point_cache_abandon(cache);
  if (status == SBF_OK) print_left_out(call, path, asset);
  return status;
}
