/* Candidate meshes of a character: its own levels, and lattices of several sizes, uncalibrated and
 * calibrated. */
#ifndef TUNED_MESHES_H
#define TUNED_MESHES_H

#include "sbfmt/asset.h"

enum { TUNE_MAX_SIZES = 12, TUNE_MAX_MESHES = 2 * TUNE_MAX_SIZES + 8 };

/* The character with one level per body. */
typedef struct tune_mesh {
  sbf_asset *asset;
  char name[48];     /* as "tetrahedra 250 calibrated" */
  uint32_t asked;    /* requested tetrahedra per body; 0: a level of the file */
  bool calibrated;   /* for lattices */
  uint32_t elements; /* of all bodies */
} tune_mesh;

/* Set of candidates. */
typedef struct tune_grid {
  uint32_t sizes[TUNE_MAX_SIZES]; /* tetrahedra per body */
  uint32_t size_count;            /* 0: a half, an eighth and a 32nd of the reference's, at least 48 */
  /* tetrahedra per body of the reference; 0: 12,000 in total, between 960 and 4000 per body */
  uint32_t reference;
  bool coarse;           /* if `reference` is 0: a quarter of that */
  bool calibrated_alone; /* skips uncalibrated ones */
  void (*progress)(void *user, const char *what, double fraction); /* may be NULL */
  void *user;
} tune_grid;

typedef struct tune_meshes {
  sbf_asset *base;     /* the file's asset, built if necessary */
  tune_mesh reference; /* calibrated */
  tune_mesh at[TUNE_MAX_MESHES];
  uint32_t count;
  char note[160];       /* reason if there are no lattices; empty otherwise */
  bool nothing_is_soft; /* the skin follows its bones exactly: there is only `base` */
} tune_meshes;

/* Free them with tune_meshes_free, also on failure. The asset is copied. SBF_BAD_INPUT if it has nothing
 * soft and no render mesh, or if all its levels are authored, because only their author changes those. */
sbf_status tune_meshes_make(
    const sbf_asset *asset, const tune_grid *grid, tune_meshes *meshes, sbf_diagnostic *error);
/* Uses the file's finest level as reference if the lattice itself breaks; false if it already is. */
bool tune_meshes_trust_own(tune_meshes *meshes);
void tune_meshes_free(tune_meshes *meshes);

#endif
