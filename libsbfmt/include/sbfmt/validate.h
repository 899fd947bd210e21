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

#ifdef __cplusplus
}
#endif
#endif
