/* Forces and grabs of the host on soft bodies: as state, and prepared for a tick. */
#ifndef SBRI_LOAD_H
#define SBRI_LOAD_H

#include "sbrun/soft_body.h"

typedef enum sbri_load_kind { SBRI_LOAD_NONE, SBRI_LOAD_FORCE, SBRI_LOAD_GRAB } sbri_load_kind;

/* State, in world units. Has no padding, because the hash reads it as words. */
typedef struct sbri_load {
  sbr_double3 target;                           /* of a grab, m */
  uint32_t kind;                                /* sbri_load_kind */
  uint32_t body, vertex;                        /* vertex may be SBR_WHOLE_BODY, of a force */
  sbf_vec3 force;                               /* N */
  float seconds;                                /* remaining time of a force */
  float frequency_hz, damping_ratio, max_force; /* of a grab; N */
  float impulse[3];                             /* in the last tick, kg m/s in the character's own units */
  uint32_t unused;                              /* fills the struct up to the alignment of double */
} sbri_load;

/* Points in which a vertex of a surface is embedded; weights sum to 1. */
enum { SBRI_VERTEX_POINTS = 16 };
typedef struct sbri_vertex_weights {
  uint32_t count, slots[SBRI_VERTEX_POINTS]; /* of the island */
  float weights[SBRI_VERTEX_POINTS];
} sbri_vertex_weights;

/* Scratch, for one tick, in the character's own units. */
typedef struct sbri_load_now {
  uint32_t body;
  bool is_grab;
  float inverse_mass;                  /* of the vertex that it acts on, or of the body; 1/kg */
  sbf_vec3 force;                      /* N, of a force */
  sbf_vec3 target;                     /* m, of a grab */
  float stiffness, damping, max_force; /* N/m, N s/m, N, of a grab */
  float *impulse;                      /* of the load */
  sbri_vertex_weights at;              /* none: the whole body */
} sbri_load_now;
typedef struct sbri_loads_now_list {
  uint32_t count;
  sbri_load_now at[SBR_LOAD_CAPACITY];
} sbri_loads_now_list;

#endif
