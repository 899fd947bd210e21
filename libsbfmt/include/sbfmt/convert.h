/* Other programs' files to assets: OBJ by our own reader, everything else by assimp in a child process.
 *
 * What comes out holds source parts only; sbf_build (sbfmt/build.h) makes the derived ones. Thread safe. */
#ifndef SBFMT_CONVERT_H
#define SBFMT_CONVERT_H

#include "sbfmt/asset.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Settings of a conversion. */
typedef struct sbf_convert_options {
  size_t struct_size;             /* sizeof(sbf_convert_options), or 0 for this version's */
  const sbf_allocator *allocator; /* NULL: malloc */
  const char *rig;                /* a file with the skeleton, where the input has none; NULL: none */
  double unit_m;                  /* metres in a unit of the input; 0: what the file says, else 1 */
  char up;                        /* 'y' or 'z': the input's upward axis; 0: what the file says, else y */
  bool no_gait;                   /* do not propose a gait */
  const char *import_helper;      /* path of the program sbfmt-import; NULL: its usual places */
  /* Warnings, and errors that did not stop the conversion; may be NULL. */
  void (*report)(void *user, const sbf_diagnostic *diagnostic);
  void *user; /* for the callback */
} sbf_convert_options;

/* Reads `input` (and the rig) into a new asset. Sections are mapped to bones by the rig's node tree; names
 * decide only which object of the input a node of the rig stands for. `options` may be NULL. */
SBF_API sbf_status sbf_convert(
    const char *input, const sbf_convert_options *options, sbf_asset **asset, sbf_diagnostic *error);

#ifdef __cplusplus
}
#endif
#endif
