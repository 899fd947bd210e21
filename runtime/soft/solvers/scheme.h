/* Time integrators of soft bodies ("schemes"). Each steps the islands of a model through a control tick and
 * has its own file in this folder. Loops over points or elements are in the header of the same name, which is
 * compiled once per instruction set (model/kernels.h). */
#ifndef SBRI_SCHEME_H
#define SBRI_SCHEME_H

#include "model/island_tick.h"

struct sbri_scheme {
  sbf_scheme kind;
  bool forceless; /* uses no forces, masses or time: `velocities` hold the positions of the previous tick */
  bool sweeps;    /* iterates over springs as links */
  /* Returns why the integrator cannot step the island, as text that begins with "whose"; NULL if it can.
   * Called before the island's tables exist, so it may use bodies and levels only. NULL pointer: it steps
   * everything. */
  const char *(*refuse)(const sbr_model *model, const sbri_island *island);
  /* Builds the integrator's own tables after the island's. Returns false if memory runs out. May be NULL. */
  bool (*prepare)(sbr_model *model, sbri_island *island);
  /* Number of substeps for a tick of `tick_s` seconds while no spring is longer than (1 + stretch) times its
   * rest length. NULL pointer: one substep. */
  uint32_t (*substeps)(const sbri_island *island, double tick_s, float stretch);
  void (*tick)(const sbri_island_tick *tick);
};

extern const sbri_scheme sbri_symplectic, sbri_relaxation, sbri_explicit_euler, sbri_heun,
    sbri_position_based, sbri_block_descent;
/* Fallback: moves a body as a rigid shape. Hosts cannot select it. */
extern const sbri_scheme sbri_rigid_shape;

static inline const char *sbri_scheme_refuses(
    const sbri_scheme *scheme, const sbr_model *model, const sbri_island *island) {
  return scheme->refuse ? scheme->refuse(model, island) : NULL;
}

/* Refuses every island that has more than springs. */
const char *sbri_refuse_all_but_springs(const sbr_model *model, const sbri_island *island);
/* Refuses regions, whose stability limit the explicit integrators do not know. */
const char *sbri_refuse_regions(const sbr_model *model, const sbri_island *island);

/* Number of position-based substeps; does not depend on the state. */
uint32_t sbri_position_substeps(const sbri_island *island, double tick_s);

/* Returns NULL if the runtime does not implement the scheme. */
const sbri_scheme *sbri_scheme_of(sbf_scheme kind);
/* Names of the implemented schemes, separated by commas: "symplectic, relaxation". */
const char *sbri_scheme_names(void);

static inline uint32_t sbri_scheme_substeps(const sbri_island *island, double tick_s, float stretch) {
  return island->scheme->substeps ? island->scheme->substeps(island, tick_s, stretch) : 1;
}

#endif
