/* Rules beyond structure: valid files with content that would cause trouble later.
 *
 * A load already refuses structural faults; these rules check geometry, physics and rig. Thread safe. */
#ifndef SBFMT_VALIDATE_H
#define SBFMT_VALIDATE_H

#include "sbfmt/asset.h"
#include "sbfmt/codes.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Settings of a validation. */
typedef struct sbf_validate_options {
  size_t struct_size;             /* sizeof(sbf_validate_options), or 0 for this version's */
  const sbf_allocator *allocator; /* NULL: malloc; for scratch memory */
  uint32_t repeats;               /* findings listed per code and path; further ones are only counted; 0: 8 */
  void (*report)(void *user, const sbf_diagnostic *diagnostic); /* may be NULL */
  void *user;                                                   /* for the callback */
  const char
      *folder; /* the file's folder ("": the current one), to look for images there; NULL: do not look */
} sbf_validate_options;

/* Counts of a validation's findings. */
typedef struct sbf_validate_result {
  uint32_t errors, warnings, infos; /* including those not listed */
} sbf_validate_result;

/* SBF_OK if the rules were applied, whatever they found; SBF_FAILED if memory ran out. `options` and `error`
 * may be NULL. */
SBF_API sbf_status sbf_validate(const sbf_asset *asset, const sbf_validate_options *options,
    sbf_validate_result *result, sbf_diagnostic *error);

/* ---- Repair ------------------------------------------------------------------------------------------- */

/* Settings of a repair. */
typedef struct sbf_fix_options {
  size_t struct_size;             /* sizeof(sbf_fix_options), or 0 for this version's */
  const sbf_allocator *allocator; /* for the created asset and scratch memory; NULL: malloc */
  bool without_build;             /* leave stale derived parts as they are */
  /* Called once for each kind of repair and path: `code` is that of the finding, `message` says what was
   * done, `path` and `index` say where in the given asset. May be NULL. */
  void (*report)(void *user, const sbf_diagnostic *diagnostic);
  void *user; /* for the callback */
} sbf_fix_options;

/* Results of a repair. */
typedef struct sbf_fix_result {
  uint32_t repaired; /* number of repaired faults */
  bool rebuilt;      /* derived parts were built again */
} sbf_fix_result;

/* Makes `*fixed`, a copy of the asset with every fault repaired that has a single right answer. Rotations and
 * normals get unit length. Weights of skins, embedded vertices and blends are divided by their sum; pin
 * weights are limited to 1. Tetrahedra are oriented positively; flat and repeated ones are removed. Polygons
 * of bodies are wound like their neighbours and outwards. Unused points of surfaces and render meshes,
 * repeated pins and springs, and springs without effect are removed. Derived parts that are stale, before or
 * after this, are built again with their settings. All other faults stay.
 *
 * `asset` may be loaded with sbf_load_options.repairable. SBF_BAD_INPUT, with the first fault in `*error` and
 * no asset, if the structure has other faults. `options`, `result` and `error` may be NULL. Thread safe. */
SBF_API sbf_status sbf_fix(const sbf_asset *asset, const sbf_fix_options *options, sbf_asset **fixed,
    sbf_fix_result *result, sbf_diagnostic *error);

#ifdef __cplusplus
}
#endif
#endif
