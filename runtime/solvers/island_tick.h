/* One control tick of one island: what a scheme is given, and the schemes.
 *
 * Places in asset metres relative to the character's origin, times in the character's own seconds (a
 * character of scale 1 counts as the world does). All arrays are the island's own, in its slots. */
#ifndef SBRI_ISLAND_TICK_H
#define SBRI_ISLAND_TICK_H

#include "model/runtime_model.h"

typedef struct sbri_island_tick {
  const sbr_model *model;
  const sbri_island *island;
  float tick_s;
  sbf_vec3 gravity; /* m/s^2 */
  sbf_vec3 wind;    /* m/s */
  sbr_double3 origin;
  float scale;
  const sbr_ground *ground;

  sbri_point *positions;         /* (slot_count) */
  float *velocities;             /* (free_count x 3) blocks of three by eight; of the relaxation scheme the
                                    positions of the tick before */
  const sbri_point *targets;     /* (slot_count) where held points shall be at the end of the tick */
  const float *guide_velocities; /* (free_count x 3) of the guides, where a body is held */
  sbri_point *begins;            /* (slot_count) scratch: where held points were at the tick's beginning */
  sbri_point *velocity_points;   /* (slot_count) scratch */
  sbri_point *surface_vertices, *surface_faces; /* scratch of the character; see sbri_body.first_vertex */
  const float *planes;                          /* (free_count x 4) of the ground */
  const uint8_t *near_ground;                   /* (free_count / 8) */
  float *stretch; /* greatest share of a spring beyond its rest length: in of the last tick, out
                     of this one's last substep */
} sbri_island_tick;

#endif
