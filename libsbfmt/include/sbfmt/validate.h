/* The rules beyond structure: what a file may say but should not, and what would go wrong with it later.
 *
 * A load already refuses what breaks the structure; these rules look at geometry, physics and rig. Thread
 * safe. */
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
  uint32_t repeats; /* findings of one code at one place beyond so many are counted, not listed; 0: 8 */
  void (*report)(void *user, const sbf_diagnostic *diagnostic); /* may be NULL */
  void *user;                                                   /* for the callback */
  const char *folder; /* where the file lies ("": here), to look for images beside it; NULL: not looked for */
} sbf_validate_options;

/* How a validation came out. */
typedef struct sbf_validate_result {
  uint32_t errors, warnings, infos; /* found, listed or not */
} sbf_validate_result;

/* SBF_OK where the rules could be applied, whatever they found; SBF_FAILED where memory ran out. `options`
 * and `error` may be NULL. */
SBF_API sbf_status sbf_validate(const sbf_asset *asset, const sbf_validate_options *options,
    sbf_validate_result *result, sbf_diagnostic *error);

/* ---- Mending ------------------------------------------------------------------------------------------ */

/* Settings of a repair. */
typedef struct sbf_fix_options {
  size_t struct_size;             /* sizeof(sbf_fix_options), or 0 for this version's */
  const sbf_allocator *allocator; /* of the asset made and of scratch memory; NULL: malloc */
  bool without_build;             /* leave stale derived parts as they are */
  /* What was repaired, one call for each kind and place: `code` is that of the finding, `message` says what
   * was done, `path` and `index` say where in the asset given. May be NULL. */
  void (*report)(void *user, const sbf_diagnostic *diagnostic);
  void *user; /* for the callback */
} sbf_fix_options;

/* What a repair did. */
typedef struct sbf_fix_result {
  uint32_t repaired; /* number of faults */
  bool rebuilt;      /* derived parts were made anew */
} sbf_fix_result;

/* Makes `*fixed`, a copy of the asset in which everything is repaired that has one right answer: rotations
 * and normals of unit length; weights of skins, pins and embedded vertices, and blends, within their ranges
 * and summing to one; tetrahedra the right way round, without those that are flat or repeated; polygons of
 * bodies that face the way their neighbours do, and outwards; points of surfaces and render meshes that
 * nothing uses, taken out; repeated pins and springs, and springs that do nothing, taken out; and derived
 * parts that are stale, or have become so by this, built anew with their settings. What it cannot decide
 * stays.
 *
 * `asset` may be loaded with sbf_load_options.mendable. SBF_BAD_INPUT, with the first fault in `*error`,
 * where the structure is at fault beyond that: then nothing is made. `options`, `result` and `error` may be
 * NULL. Thread safe. */
SBF_API sbf_status sbf_fix(const sbf_asset *asset, const sbf_fix_options *options, sbf_asset **fixed,
    sbf_fix_result *result, sbf_diagnostic *error);

#ifdef __cplusplus
}
#endif
#endif
