/* A level as the network of springs and tetrahedra that it is, with its body's surface on it. */
#ifndef SBFI_LEVEL_STATICS_H
#define SBFI_LEVEL_STATICS_H

#include "build/embed/embedder.h"
#include "sbfmt/mechanics.h"

/* Gravity along three axes; of a body that nothing holds, six ways to bend it and three to stretch it. */
enum {
  SBFI_PINNED_LOADS = 3,
  SBFI_BENDS = 6,
  SBFI_FREE_LOADS = SBFI_BENDS + 3,
  SBFI_MAX_LOADS = SBFI_FREE_LOADS
};

typedef struct sbfi_level_statics {
  const sbf_soft_body *body;
  const sbf_level *level;
  sbf_spring_network network;
  bool is_pinned;
  bool turns; /* about the points that hold it, all of it or a piece: what its statics says means nothing */
  uint32_t load_count;
  sbfi_embedder embedder;
  sbfi_embedded_vertex *embedded; /* (surface points) */
  float *areas;                   /* (surface points) m^2, their tributary areas, that means go by */
  double size;                    /* m, diagonal of the surface's box */
  double low[3], high[3];
  double mass;      /* kg, of what is free */
  float *moduli;    /* (tetrahedra) Pa, those of the network, to be changed */
  float *stiffness; /* (springs) N/m, the same */
} sbfi_level_statics;

/* `interior` as for a embedder; may be NULL. Everything but body and level is memory of `arena`. False where
 * memory runs out. */
bool sbfi_level_statics_make(sbfi_level_statics *statics, const sbf_soft_body *body, const sbf_level *level,
    const sbfi_interior_map *interior, sbfi_arena *arena);

/* The frequency of the lowest mode from above, rad/s; 0: none. */
double sbfi_level_lowest(const sbfi_level_statics *statics, sbfi_arena *scratch);

/* Substeps that a control tick of `tick` s takes explicitly, times springs and tetrahedra. */
double sbfi_level_cost(const sbfi_level_statics *statics, double tick, sbfi_arena *scratch);

#endif
