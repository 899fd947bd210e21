/* Input and state of one control tick of one island, for the time integrators.
 *
 * Positions are in asset metres relative to the character's origin. Times are in the character's own seconds,
 * so that a character of scale 1 uses world time. Arrays belong to the island and are indexed by its slots.
 */
#ifndef SBRI_ISLAND_TICK_H
#define SBRI_ISLAND_TICK_H

#include "model/load.h"
#include "model/runtime_model.h"
#include "model/soft_contact.h"

/* Elements that tore in a tick: their number and the first SBRI_TEARS of them. */
enum { SBRI_TEARS = 16 };
typedef struct sbri_tear {
  uint32_t link;     /* spring: block x 8 + lane; tetrahedron: its index */
  bool solid;        /* a tetrahedron, not a spring */
  sbf_vec3 position; /* its centre, asset metres */
} sbri_tear;
typedef struct sbri_tears {
  uint32_t unsplit; /* points that could not split for lack of spare slots */
  uint32_t count;   /* may exceed SBRI_TEARS; the rest are only counted */
  sbri_tear at[SBRI_TEARS];
} sbri_tears;

/* State of a tetrahedron that may tear. */
enum sbri_torn_state { SBRI_WHOLE, SBRI_TORN_NOW, SBRI_TORN_BEFORE };

/* Impulse and angular impulse of soft bodies on a rigid body about `about`, N s and N m s. The inverse mass
 * and the largest inverse moment of inertia are 0 for a body that does not move.
 *
 * shift and shift_turn (kg m, kg m^2) accumulate immediate position corrections of pinned points;
 * shift_moment is their angular momentum at the speeds of these points. */
typedef struct sbri_reaction {
  sbf_vec3 about, impulse, moment;
  sbf_vec3 shift, shift_turn, shift_moment;
  float inverse_mass, inverse_inertia;
} sbri_reaction;

/* Recovery of an island from failure; times in ticks. */
typedef struct sbri_recovery {
  uint32_t ticks;               /* left in which the router keeps the recovery integrator */
  uint32_t rigid_ticks;         /* left in which its bodies move rigidly */
  uint32_t row;                 /* number of resets to the rest shape in quick succession */
  uint32_t repeat_window_ticks; /* window in which another reset counts as in succession */
  uint32_t unsound_ticks;       /* since the motion of bodies without pins was last stored */
  uint32_t jumped_ticks;        /* left after a jump of its pins, which may have crushed it */
  uint32_t crushed_ticks;       /* since then in which it has been crushed */
  float acceleration_m_s2;      /* bound of how its drivers accelerate, forgotten slowly */
} sbri_recovery;

/* What acts on an island from outside. */
typedef struct sbri_environment {
  sbf_vec3 gravity; /* m/s^2 */
  sbf_vec3 wind;    /* m/s */
  sbr_double3 origin;
  float scale;
  sbr_transform anchor; /* motion of the anchor frame since the rest pose, asset metres: fields stand in it */
  const sbr_ground *ground;
  const sbri_load_now *loads; /* (load_count) of all bodies of the character */
  uint32_t load_count;
  const struct sbri_collider_set *colliders; /* shapes/colliders.h; NULL: there are none */
} sbri_environment;

/* Contacts of all bodies of the character; see sbri_body_contact. */
typedef struct sbri_tick_contacts {
  const float *planes;        /* (free_count x 4) of the ground */
  const uint8_t *near_ground; /* (free_count / 8) */
  float *pressing; /* (free_count x 2) scratch: sbri_pressing of each point, blocks of two by eight */
  sbri_soft_contact *at;
  const uint32_t *counts; /* (bodies of the model) NULL: none */
  sbri_contact_block *blocks;
  uint32_t *block_counts; /* (bodies of the model) */
  uint8_t *slots;         /* (slot_count / 8) 1: contact blocks read or move some of these slots */
  float *weights;         /* (slot_count) scratch: sums of weights of the contacts that move each point */
  struct sbri_external_bodies *external_bodies; /* (bodies of the model) shapes/external_body.h; NULL: none */
} sbri_tick_contacts;

/* Surfaces of all bodies of the character, scratch; see sbri_body_surface. */
typedef struct sbri_tick_surfaces {
  sbri_point *vertices, *faces, *forces, *velocities;
  double *external_rad_s; /* highest angular frequency of external forces, 1/s, updated by
                             sbri_update_gas_stiffness */
} sbri_tick_surfaces;

typedef struct sbri_tick_springs {
  float *rests, *strengths; /* (links x 8) m, and 1 or 0 where torn; NULL: no spring yields or tears */
  float *edges;             /* (links x 8 x 3) scratch */
  float *
      stretch; /* maximum stretch of a spring: of the previous tick on entry, of the last substep on return */
} sbri_tick_springs;

/* Tetrahedra and regions. */
typedef struct sbri_tick_solids {
  const sbri_tetrahedron_block *blocks; /* the island's blocks as they are now */
  sbri_tetrahedron_block *flowing;      /* the same where they yield or tear, else NULL */
  uint32_t *torn;                       /* (tetrahedra) sbri_torn_state, likewise */
  float *edges;                         /* (tetrahedra's lanes x 9) scratch */
  uint8_t *compressed; /* (blocks) scratch: 1: the last check in this tick found a compressed element */
  float *rotations;    /* (region blocks x 4 x 8) of the regions: of the last substep on entry and return */
  float *max_flow_stretch; /* see sbri_island_state */
  float *stiffening;       /* see sbri_island_state: of the last tick on entry, of this one on return */
  float *min_ratio;        /* on return the minimum J = det F at the last check; 1 without tetrahedra */
} sbri_tick_solids;

/* Arrays that an integrator may overwrite. */
typedef struct sbri_tick_scratch {
  sbri_point *begins;          /* (slot_count) positions of pinned points at the beginning of the tick */
  sbri_point *velocity_points; /* (slot_count) */
  sbri_point *element_forces;  /* (slot_count) of tetrahedra and regions */
  sbri_point *external_forces; /* (slot_count) N, neither of springs nor weight; NULL: there are none */
  float *accelerations, *older_velocities; /* (free_count x 3) blocks as sbri_island_tick.velocities */
  sbri_point *moves;                       /* (slot_count) */
} sbri_tick_scratch;

typedef struct sbri_island_tick {
  const sbr_model *model;
  const sbri_island *island;
  float
      tick_s; /* length of the tick, s; a fraction of a control tick if the island steps with rigid bodies: */
  float fraction;         /* that fraction; 1: a whole tick */
  bool collides;          /* has contacts with bodies of other characters */
  bool undamped;          /* the caller applies damping relative to the drivers */
  const sbr_tasks *tasks; /* tasks that may divide the work of the tick; NULL: none. The result is the same */
  sbri_environment environment;
  sbri_point *positions;          /* (slot_count) */
  float *velocities;              /* (free_count x 3) blocks of three by eight; of the relaxation scheme the
                                     positions of the tick before */
  const sbri_point *targets;      /* (slot_count) positions of pinned points at the end of the tick */
  const float *driver_velocities; /* (free_count x 3) velocities of the drivers, for pinned bodies */
  sbri_reaction *reactions;       /* (rigid bodies) accumulated; NULL: not needed */
  sbri_tick_contacts contacts;
  sbri_tick_surfaces surfaces;
  sbri_tick_springs springs;
  sbri_tick_solids solids;
  sbri_tick_scratch scratch;
  sbri_tears *tears;        /* scratch: what tore in this tick */
  float step_error_m;       /* of schemes that control their error, asset metres */
  uint32_t *element_visits; /* element visits, accumulated; NULL: not counted */
} sbri_island_tick;

/* Runs task(context, i) for i below count, and returns when all are done. */
static inline void sbri_run_tasks(const sbri_island_tick *t, sbr_task *task, void *context, uint32_t count) {
  if (t->tasks && count > 1)
    t->tasks->run(t->tasks->user, task, context, count);
  else
    for (uint32_t i = 0; i < count; i++) task(context, i);
}

static inline void sbri_count_element_visits(const sbri_island_tick *t, uint32_t element_visits) {
  if (t->element_visits) *t->element_visits += element_visits;
}

/* Velocity of a slot; of a pinned slot its mean velocity over the tick. */
static inline sbf_vec3 sbri_slot_velocity(const sbri_island_tick *t, const float *velocities, uint32_t slot) {
  if (slot < t->island->free_count) {
    const float *v = velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
    return (sbf_vec3){v[0], v[SBRI_BLOCK], v[2 * SBRI_BLOCK]};
  }
  const sbri_point *from = &t->scratch.begins[slot], *to = &t->targets[slot];
  float rate = 1 / t->tick_s;
  return (sbf_vec3){(to->x - from->x) * rate, (to->y - from->y) * rate, (to->z - from->z) * rate};
}

static inline sbf_vec3 sbri_sample_position(const sbri_island_tick *t, const sbri_sample *s) {
  sbf_vec3 x = {0, 0, 0};
  for (int k = 0; k < 4; k++) {
    if (s->weights[k] == 0) continue;
    const sbri_point *p = &t->positions[s->slots[k]];
    x.x += s->weights[k] * p->x, x.y += s->weights[k] * p->y, x.z += s->weights[k] * p->z;
  }
  return x;
}

/* Number of contacts of the body in this tick. */
static inline uint32_t sbri_soft_contact_count(const sbri_island_tick *t, const sbri_body *body) {
  return t->contacts.counts ? t->contacts.counts[body - t->model->bodies] : 0;
}

/* Whether the body may touch anything in this tick. */
static inline bool sbri_may_collide(const sbri_island_tick *t, const sbri_body *body) {
  bool any = sbri_soft_contact_count(t, body) > 0;
  for (uint32_t block = body->slots.begin / SBRI_BLOCK; block < body->slots.end / SBRI_BLOCK; block++)
    any = any || t->contacts.near_ground[block];
  return any;
}

#endif
