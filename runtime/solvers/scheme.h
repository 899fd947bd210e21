/* What a scheme is: one way to step the islands of a model through a control tick. Each has a file of its own
 * in this folder, and its loops over points or elements in a header of the same name, which is compiled for
 * each instruction set (model/kernels.h). */
#ifndef SBRI_SCHEME_H
#define SBRI_SCHEME_H

#include "model/island_tick.h"

struct sbri_scheme {
  sbf_scheme word;
  bool forceless; /* it knows no forces, masses or seconds: `velocities` hold the places of the tick before */
  bool sweeps;    /* it works on the springs as links */
  /* Why it cannot step the island, as "whose ..."; NULL: it can. Asked before the island's tables are made:
   * of its bodies and their levels. May be NULL itself: it steps all. */
  const char *(*refuse)(const sbr_model *model, const sbri_island *island);
  /* Makes the tables that it alone needs, after the island's own; false where memory runs out. May be NULL.
   */
  bool (*prepare)(sbr_model *model, sbri_island *island);
  /* Substeps of a tick of `tick_s` that it needs while no spring is stretched by more than `stretch`, the
   * share of its length that is beyond its rest length. NULL: one. */
  uint32_t (*substeps)(const sbri_island *island, double tick_s, float stretch);
  void (*tick)(const sbri_island_tick *tick);
};

extern const sbri_scheme sbri_symplectic, sbri_relaxation, sbri_explicit_euler, sbri_heun,
    sbri_position_based, sbri_block_descent;
/* For bodies that none of these can step; hosts cannot ask for it. */
extern const sbri_scheme sbri_rigid_shape;

static inline const char *sbri_scheme_refuses(
    const sbri_scheme *scheme, const sbr_model *model, const sbri_island *island) {
  return scheme->refuse ? scheme->refuse(model, island) : NULL;
}

/* For those that step springs alone. */
const char *sbri_refuse_all_but_springs(const sbr_model *model, const sbri_island *island);
/* For those that step all but regions, which are stable by themselves: none of them is faster than it says.
 */
const char *sbri_refuse_regions(const sbr_model *model, const sbri_island *island);

/* Of position-based substeps, whatever the state. */
uint32_t sbri_position_substeps(const sbri_island *island, double tick_s);

/* NULL: the runtime does not have it. */
const sbri_scheme *sbri_scheme_of(sbf_scheme word);
/* Names of those it has, as "symplectic, relaxation". */
const char *sbri_scheme_names(void);

static inline uint32_t sbri_scheme_substeps(const sbri_island *island, double tick_s, float stretch) {
  return island->scheme->substeps ? island->scheme->substeps(island, tick_s, stretch) : 1;
}

#endif
