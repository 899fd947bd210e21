/* Writing what other programs read.
 *
 * Files are written beside their place and renamed when complete: after a failure the old one stands. Each
 * writer belongs to one thread at a time. */
#ifndef SBFMT_EXPORT_H
#define SBFMT_EXPORT_H

#include "sbfmt/asset.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Settings of sbf_export. */
typedef struct sbf_export_options {
  size_t struct_size;             /* sizeof(sbf_export_options), or 0 for this version's */
  const sbf_allocator *allocator; /* NULL: malloc */
  /* Warnings: what the form has no place for and was left out. May be NULL. */
  void (*report)(void *user, const sbf_diagnostic *diagnostic);
  void *user; /* for the callback */
  /* Of each render mesh: 0 the full one, n its n-th render level, or its last where there are fewer. */
  uint32_t render_level;
} sbf_export_options;

/* Writes the asset in the form that the ending of `path` names: .obj (the render meshes at rest, or where
 * there are none the bodies' surfaces; materials to a .mtl of the same name), .tet (the bodies' first levels
 * of tetrahedra, as PhysX reads them), .xml (the 2012 dialect, section 16 of the specification).
 * SBF_BAD_INPUT where the asset has nothing that the form could hold. `options` may be NULL. */
SBF_API sbf_status sbf_export(
    const sbf_asset *asset, const char *path, const sbf_export_options *options, sbf_diagnostic *error);

/* A point cache, version 1 (.pc2), as Blender's Mesh Cache plays it: places of all points, sample after
 * sample, single precision, little-endian. */
typedef struct sbf_point_cache sbf_point_cache;

/* `sample_count` samples of `point_count` points will follow, one for each frame of whoever plays them. */
SBF_API sbf_status sbf_point_cache_open(const char *path, uint32_t point_count, uint32_t sample_count,
    sbf_point_cache **cache, sbf_diagnostic *error);
/* The next sample: point_count places. */
SBF_API sbf_status sbf_point_cache_add(sbf_point_cache *cache, const sbf_vec3 *points, sbf_diagnostic *error);
/* Completes the file; SBF_FAILED, and no file, where samples are missing or it cannot be written. */
SBF_API sbf_status sbf_point_cache_commit(sbf_point_cache *cache, sbf_diagnostic *error);
/* Gives it up; NULL does nothing. */
SBF_API void sbf_point_cache_abandon(sbf_point_cache *cache);

#ifdef __cplusplus
}
#endif
#endif
