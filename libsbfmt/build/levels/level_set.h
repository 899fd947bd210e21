/* The levels of one body, finest first: lattices of twice the cell each, springs along the sides of one more,
 * jiggle; each compared with what the body does as a fine lattice, lattices calibrated to it. */
#ifndef SBFI_LEVEL_SET_H
#define SBFI_LEVEL_SET_H

#include "build/levels/calibrate.h"

enum { SBFI_MAX_LEVELS = 8 };

typedef struct sbfi_level_set_recipe {
  uint32_t levels; /* in all, 1 to SBFI_MAX_LEVELS */
  double error;    /* m, that the finest may be off; 0: whatever it is */
  bool calibrate;  /* lattices, and springs that are the finest level */
  bool flexion;    /* for a level of springs */
  double tick;     /* s, that costs are for */
  uint32_t part;   /* the finest lattice has no more than this unasked; its reference eight times as many */
  int32_t derivation;
} sbfi_level_set_recipe;

/* A level that comes to no rest, or is off by more than SBFI_MAX_OFF. */
typedef struct sbfi_poor_level {
  uint32_t elements; /* tetrahedra, or of springs those along whose sides they go */
  double off;        /* share, under the load where that is most; 0: it comes to no rest */
  bool is_kept;      /* the finest; others are left out */
} sbfi_poor_level;

typedef struct sbfi_level_set {
  const sbf_soft_body *body;
  const sbfi_level_set_recipe *recipe;
  sbf_asset *asset; /* under construction */
  sbfi_progress progress;
  const sbf_allocator *allocator;
  bool has_reference;
  sbfi_reference reference;
  sbf_level *levels; /* (level_count) memory of the asset */
  uint32_t level_count;
  sbfi_calibration calibrations[SBFI_MAX_LEVELS]; /* of those that say so */
  sbfi_poor_level poor[SBFI_MAX_LEVELS];
  uint32_t poor_count;
} sbfi_level_set;

/* How many of `levels` are lattices, where the finest is one: with three and more the last is jiggle, with
 * four and more the one before is springs. */
uint32_t sbfi_level_set_lattices(uint32_t levels);

/* Everything stays the caller's. To be freed whatever comes of it. */
void sbfi_level_set_init(sbfi_level_set *set, const sbf_soft_body *body, const sbfi_level_set_recipe *recipe,
    sbf_asset *asset, sbfi_progress progress, const sbf_allocator *allocator);
void sbfi_level_set_free(sbfi_level_set *set);

/* About how many tetrahedra the coarsest lattice has that meets the recipe's error when calibrated and is off
 * by no more than SBFI_MAX_OFF under any load, in steps of four times as many. Where none is both, the
 * coarsest that meets the error; `*met` is false where none of fewer than the reference's does. */
sbfi_lattice_outcome sbfi_level_set_pick(sbfi_level_set *set, uint32_t *elements, bool *reached);

/* From the finest level, of springs or tetrahedra, `interior` its map, makes the list of all and measures
 * them. A lattice that finds nothing to fill, is no coarser than the one before, comes to no rest under
 * gravity or is off by more than SBFI_MAX_OFF is left out, and springs that come to none. Springs go
 * along the sides of a lattice, whose tetrahedra they keep until embeddings are made
 * (lattice_springs_level.h). `arena` is scratch. */
sbfi_lattice_outcome sbfi_level_set_make(
    sbfi_level_set *set, const sbf_level *finest, const sbfi_interior_map *interior, sbfi_arena *arena);

#endif
