/* A level as a network of springs and tetrahedra, with its body's surface embedded. */
#ifndef SBFI_LEVEL_STATICS_H
#define SBFI_LEVEL_STATICS_H

#include "build/embed/embedder.h"
#include "sbfmt/mechanics.h"

/* Gravity along three axes; for a free body six bending and three stretching loads. */
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
  bool can_rotate; /* the whole or a piece can rotate about its pins: static results are meaningless */
  uint32_t load_count;
  sbfi_embedder embedder;
  sbfi_embedded_vertex *embedded; /* (surface points) */
  float *areas;                   /* (surface points) m^2, tributary areas, the weights of means */
  double size;                    /* m, diagonal of the surface's bounding box */
  double low[3], high[3];
  double mass;      /* kg, of free points */
  float *moduli;    /* (tetrahedra) Pa, of the network; may be changed */
  float *stiffness; /* (springs) N/m, of the network; may be changed */
} sbfi_level_statics;

/* `interior` as for an embedder; may be NULL. Allocates from `arena`, except body and level. False if
 * memory runs out. */
bool sbfi_level_statics_make(sbfi_level_statics *statics, const sbf_soft_body *body, const sbf_level *level,
    const sbfi_interior_map *interior, sbfi_arena *arena);

/* Upper bound of the lowest mode's frequency, rad/s; 0: none. */
double sbfi_level_lowest(const sbfi_level_statics *statics, sbfi_arena *scratch);

/* Number of explicit substeps for a control tick of `tick` s times springs and tetrahedra. */
double sbfi_level_cost(const sbfi_level_statics *statics, double tick, sbfi_arena *scratch);

#endif
