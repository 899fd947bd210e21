/* What a character may be made of: its own levels, and lattices of several sizes, as they are and calibrated.
 */
#ifndef TUNED_MESHES_H
#define TUNED_MESHES_H

#include "sbfmt/asset.h"

enum { TUNE_MAX_SIZES = 12, TUNE_MAX_MESHES = 2 * TUNE_MAX_SIZES + 8 };

/* The character with one level a body. */
typedef struct tune_mesh {
  sbf_asset *asset;
  char name[48];     /* as "tetrahedra 250 calibrated" */
  uint32_t asked;    /* tetrahedra a body that were asked for; 0: a level of the file */
  bool calibrated;   /* of lattices */
  uint32_t elements; /* of all bodies */
} tune_mesh;

/* What is tried. */
typedef struct tune_grid {
  uint32_t sizes[TUNE_MAX_SIZES]; /* tetrahedra a body */
  uint32_t size_count;            /* 0: a half, an eighth and a 32nd of the reference's, 48 at least */
  uint32_t reference;    /* tetrahedra a body of what all are measured against; 0: 12,000 in all, no more than
                            4000 and no fewer than 960 a body */
  bool coarse;           /* where `reference` is 0: a quarter of that */
  bool calibrated_alone; /* not as they are */
  void (*progress)(void *user, const char *what, double fraction); /* may be NULL */
  void *user;
} tune_grid;

typedef struct tune_meshes {
  sbf_asset *base;     /* the file's, built where it was not */
  tune_mesh reference; /* calibrated */
  tune_mesh at[TUNE_MAX_MESHES];
  uint32_t count;
  char note[160];       /* why there are no lattices; empty: there are */
  bool nothing_is_soft; /* the skin follows its bones exactly: `base` is all there is */
} tune_meshes;

/* Free them with tune_meshes_free, also on failure. The asset itself need not stay. SBF_BAD_INPUT where it
 * has nothing soft and no render mesh, or where all its levels are authored, which nobody but their author
 * changes. */
sbf_status tune_meshes_make(
    const sbf_asset *asset, const tune_grid *grid, tune_meshes *meshes, sbf_diagnostic *error);
/* Measures by the finest level that the file has, for where the lattice itself breaks; false where that is
 * what is measured by already. */
bool tune_meshes_trust_own(tune_meshes *meshes);
void tune_meshes_free(tune_meshes *meshes);

#endif
