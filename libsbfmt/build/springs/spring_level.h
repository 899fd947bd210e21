/* A body's level of springs: points, springs of every kind with their stiffness, pins. */
#ifndef SBFI_SPRING_LEVEL_H
#define SBFI_SPRING_LEVEL_H

#include "base/memory.h"
#include "base/progress.h"
#include "sbfmt/asset.h"

typedef enum sbfi_spring_interior {
  SBFI_INTERIOR_NONE,
  SBFI_INTERIOR_CENTROID, /* pinned to the body's bone if it has one */
  SBFI_INTERIOR_LATTICE,  /* its deep points are pinned to the body's bone if it has one */
  SBFI_INTERIOR_BRUTE
} sbfi_spring_interior;

typedef struct sbfi_spring_recipe {
  sbfi_spring_interior interior;
  double cell; /* m, of the lattice; 0: by the polygons */
  bool flexion;
  int32_t derivation;     /* derivation mark of the new parts */
  sbfi_progress progress; /* zeros: no progress reports */
} sbfi_spring_recipe;

/* Counts of one body. */
typedef struct sbfi_spring_counts {
  uint32_t interior_points;                /* created, not authored */
  uint32_t springs[SBF_SPRING_KIND_COUNT]; /* in the file */
  uint32_t inert;                          /* dropped: both ends are pinned */
  uint32_t pins;                           /* points of the level's pin sets */
} sbfi_spring_counts;

/* Positions of the new points, for embedding. */
typedef struct sbfi_interior_map {
  uint32_t centre;          /* index in the level; SBFI_NO_INDEX: none */
  uint32_t *polygon_points; /* (polygons) indices in the level, or SBFI_NO_INDEX; NULL: none */
} sbfi_interior_map;

/* Fills `*level` for a body that has surface points; its lists are owned by `asset`, those of the map by
 * `scratch`.
 *
 * Points: the surface's, the author's interior points, the created ones. Springs: structural, shear, flexion,
 * internal, each set in the order of springs.h, without springs between two pinned points, which its
 * inert_count counts, and without springs of zero length. Pins: the body's own, its attachments', and
 * "interior", which pins the created points to the body's bone (see level_pins.h). Without a bone they stay
 * free and get masses: of each polygon's pyramid from the centre, a quarter goes to its point, a fifth to the
 * centre and the rest to its corners, as for its tetrahedra.
 *
 * A lattice's nodes have the mass of half a cube of its grid each, and all of the mass together with the free
 * surface points. All springs of a level with a lattice, and of a brute one, get their stiffness as one
 * network.
 *
 * Stiffness in N/m by sbfmt/mechanics.h, stated for each spring; damping too if a weight map scales the
 * body's stiffness_damping. False if memory runs out or the recipe's progress cancels. */
bool sbfi_spring_level_make(sbf_level *level, const sbf_soft_body *body, const sbfi_spring_recipe *recipe,
    sbf_asset *asset, sbfi_interior_map *map, sbfi_spring_counts *counts, sbfi_arena *scratch);

#endif
