/* Builds the levels of a body, finest first: lattices with doubling cell sizes, springs along the edges of
 * one more lattice, jiggle. Each is compared with a fine lattice; lattices are calibrated to it. */
#ifndef SBFI_LEVEL_SET_H
#define SBFI_LEVEL_SET_H

#include "build/levels/calibrate.h"

enum { SBFI_MAX_LEVELS = 8 };

typedef struct sbfi_level_set_recipe {
  uint32_t levels; /* number of levels, 1 to SBFI_MAX_LEVELS */
  double error;    /* m, maximum error of the finest; 0: unlimited */
  bool calibrate;  /* lattices, and springs that are the finest level */
  bool flexion;    /* for a level of springs */
  double tick;     /* s, the tick for costs */
  uint32_t part;   /* default limit of the finest lattice's elements; its reference has eight times as many */
  int32_t derivation;
} sbfi_level_set_recipe;

/* A level that does not converge, or has an error above SBFI_MAX_LOAD_ERROR. */
typedef struct sbfi_poor_level {
  uint32_t elements; /* number of tetrahedra, or for springs the number in their lattice */
  double load_error; /* largest relative error under a load; 0: no convergence */
  bool is_kept;      /* the finest level; others are removed */
} sbfi_poor_level;

typedef struct sbfi_level_set {
  const sbf_soft_body *body;
  const sbfi_level_set_recipe *recipe;
  sbf_asset *asset; /* under construction */
  sbfi_progress progress;
  const sbf_allocator *allocator;
  bool has_reference;
  sbfi_reference reference;
  sbf_level *levels; /* (level_count) owned by the asset */
  uint32_t level_count;
  sbfi_calibration calibrations[SBFI_MAX_LEVELS]; /* of levels with a calibration */
  sbfi_poor_level poor[SBFI_MAX_LEVELS];
  uint32_t poor_count;
} sbfi_level_set;

/* How many of `levels` are lattices if the finest is one: with at least three the last is jiggle, with at
 * least four the one before is springs. */
uint32_t sbfi_level_set_lattices(uint32_t levels);

/* Borrows all arguments. Must be freed after any result. */
void sbfi_level_set_init(sbfi_level_set *set, const sbf_soft_body *body, const sbfi_level_set_recipe *recipe,
    sbf_asset *asset, sbfi_progress progress, const sbf_allocator *allocator);
void sbfi_level_set_free(sbfi_level_set *set);

/* Finds the coarsest lattice, in steps of four times the elements, that meets the recipe's error when
 * calibrated and has an error of at most SBFI_MAX_LOAD_ERROR under every load, and returns its approximate
 * number of tetrahedra. If none meets both, returns the coarsest that meets the error; `*reached` is false if
 * none with fewer elements than the reference does. */
sbfi_lattice_outcome sbfi_level_set_pick(sbfi_level_set *set, uint32_t *elements, bool *reached);

/* Builds and measures all levels from the finest, of springs or tetrahedra, whose map is `interior`. Skips
 * a lattice that finds nothing to fill, is no coarser than the previous one, does not converge under
 * gravity or has an error above SBFI_MAX_LOAD_ERROR, and springs that do not converge. Springs follow the
 * edges of a lattice and keep its tetrahedra until embeddings are made (lattice_springs_level.h). `arena` is
 * scratch. */
sbfi_lattice_outcome sbfi_level_set_make(
    sbfi_level_set *set, const sbf_level *finest, const sbfi_interior_map *interior, sbfi_arena *arena);

#endif
