/* One control tick of one island: what a scheme is given, and the schemes.
 *
 * Places in asset metres relative to the character's origin, times in the character's own seconds (a
 * character of scale 1 counts as the world does). All arrays are the island's own, in its slots. */
#ifndef SBRI_ISLAND_TICK_H
#define SBRI_ISLAND_TICK_H

#include "model/load.h"
#include "model/runtime_model.h"

/* Elements that tore in a tick: how many, and the first of them. */
enum { SBRI_TEARS = 16 };
typedef struct sbri_tear {
  uint32_t link;  /* block x 8 + lane; of a tetrahedron its number */
  bool solid;     /* a tetrahedron */
  sbf_vec3 place; /* its middle, asset metres */
} sbri_tear;
typedef struct sbri_tears {
  uint32_t unsplit; /* points for which there was no room */
  uint32_t count;   /* more than SBRI_TEARS: the others are counted only */
  sbri_tear at[SBRI_TEARS];
} sbri_tears;

/* What a tetrahedron that may tear is. */
enum sbri_torn_state { SBRI_WHOLE, SBRI_TORN_NOW, SBRI_TORN_BEFORE };

#define SBRI_NO_COLLIDER UINT32_MAX
#define SBRI_ITSELF (UINT32_MAX - 1)

/* A sample of a body that may touch something within the tick: the plane it must not go below. A sample may
 * be in several. */
typedef struct sbri_touch {
  sbri_sample sample; /* as it is carried in this tick */
  sbf_vec3 normal;    /* unit */
  float offset;       /* normal . x of the plane, as of the present substep's beginning */
  union {
    sbf_vec3 velocity; /* m/s, of what it stands for */
    sbf_vec3 arm;      /* of an external body, which has its own: from its centre of mass */
  };
  float friction_share, restitution; /* of the body's coefficient of friction; its own */
  uint32_t collider;     /* number of the collider, or SBRI_NO_COLLIDER: the ground, or SBRI_ITSELF: the
            body, against the points whose weights are below 0 */
  bool edges;            /* of itself: the first two points against the last two */
  bool crosses;          /* of itself: they have gone through each other */
  bool alone;            /* the sample is one free point that no other touch moves */
  uint8_t external_body; /* from 1 on: which of the body's external bodies it pushes (collide/external
                            body.h); 0: none */
  /* Of solvers/touches.c, from substep to substep: */
  float gap, wanted;         /* m and m/s, at the beginning of one */
  float share;               /* of its own response that a pass answers it with; 1: it is answered in turn */
  bool pushes;               /* or is about to, in this substep */
  float gain;                /* m/s that the push gives the sample along the normal */
  sbf_vec3 friction_impulse; /* and friction across it */
  float pushed;              /* most of the gains in the tick */
  sbf_vec3 given;            /* m/s that all pushes of the tick have given the sample */
  float
      fast_m_s; /* it nears its plane no faster in the tick, but for what springs and weight add; 0: it may */
  float idle_s; /* for how long it cannot touch */
} sbri_touch;

/* What has been pulled with on a rigid body, N s and N m s about a place; and by how much that changes its
 * speeds, 1/kg and 1/(kg m^2) about the axis about which it turns most easily: 0 where it does not give way.
 *
 * Where points have been moved at once against what holds them, its part of that: kg m and kg m^2 likewise,
 * and the angular momentum that these have at the held places' speeds. */
typedef struct sbri_reaction {
  sbf_vec3 about, impulse, moment;
  sbf_vec3 shift, shift_turn, shift_moment;
  float ease, inverse_inertia;
} sbri_reaction;

/* How an island recovers, in ticks. */
typedef struct sbri_recovery {
  uint32_t ticks;         /* for which the router still keeps to the scheme that recovers */
  uint32_t rigid_ticks;   /* for which its bodies still move as rigid ones */
  uint32_t row;           /* how often it was put back into its rest shape, each soon after the last */
  uint32_t relapse_ticks; /* within which the next time counts as one more of those */
  uint32_t unsound_ticks; /* since the motion of its loose bodies was last kept */
  uint32_t jumped_ticks;  /* within which a jump of what holds it may have left it crushed */
  uint32_t crushed_ticks; /* for which it has been crushed since */
} sbri_recovery;

typedef struct sbri_island_tick {
  const sbr_model *model;
  const sbri_island *island;
  float tick_s;     /* a share of the control tick where the island steps along with rigid bodies: */
  float share;      /* of it; 1: all */
  bool meets;       /* in contact with bodies of characters */
  sbf_vec3 gravity; /* m/s^2 */
  sbf_vec3 wind;    /* m/s */
  sbr_double3 origin;
  float scale;
  const sbr_ground *ground;
  const sbri_load_now *loads; /* (load_count) of all bodies of the character */
  uint32_t load_count;
  const struct sbri_collider_set *colliders; /* collide/colliders.h; NULL: there are none */

  sbri_point *positions;         /* (slot_count) */
  float *velocities;             /* (free_count x 3) blocks of three by eight; of the relaxation scheme the
                                    positions of the tick before */
  const sbri_point *targets;     /* (slot_count) where held points shall be at the end of the tick */
  const float *guide_velocities; /* (free_count x 3) of the guides, where a body is held */
  bool undamped;                 /* what damping against the guides does is done by the caller */
  sbri_reaction *reactions;      /* (rigid bodies) is added to; NULL: nobody asks */
  sbri_point *begins;            /* (slot_count) scratch: where held points were at the tick's beginning */
  sbri_point *velocity_points;   /* (slot_count) scratch */
  sbri_point *element_forces;    /* (slot_count) scratch: of tetrahedra and regions */
  double *outer_rad_s;           /* the island's, as the gases are now: sbri_outer_look */
  sbr_transform anchor; /* motion of the anchor frame since the rest pose, asset metres: fields stand in it */
  sbri_point *surface_forces, *surface_velocities; /* scratch likewise */
  sbri_point *surface_vertices, *surface_faces;    /* scratch of the character; see sbri_body.first_vertex */
  const float *planes;                             /* (free_count x 4) of the ground */
  const uint8_t *near_ground;                      /* (free_count / 8) */
  sbri_touch *touches;                             /* of the character; see sbri_body.first_touch */
  struct sbri_external_bodies
      *external_bodies;         /* (bodies of the model) collide/external_body.h; NULL: none */
  float *touch_weights;         /* (slot_count) scratch: the sums of weights of what pushes each point */
  const uint32_t *touch_counts; /* (bodies of the model) NULL: none */
  float *rests, *strengths;     /* (links x 8) m, and 1 or 0 where torn; NULL: no spring yields or tears */
  float *rotations;             /* (region_block_count x 4 x 8) of the regions: in of the last substep, out */
  sbri_point *outer; /* (slot_count) N; scratch of what is neither springs nor weight; NULL: nothing */
  float *accelerations, *older_velocities;  /* (free_count x 3) scratch, blocks as `velocities` */
  sbri_point *moves;                        /* (slot_count) scratch */
  float *edges;                             /* (links x 8 x 3) scratch */
  float *solid_edges;                       /* (tetrahedra's lanes x 9) scratch */
  sbri_tears *tears;                        /* scratch: what tore in this tick */
  float step_error_m;                       /* of schemes that control their error, asset metres */
  const sbri_tetrahedron_block *tetrahedra; /* the island's blocks as they are now */
  sbri_tetrahedron_block *flowing;          /* the same where they yield or tear, else NULL */
  uint32_t *torn;                           /* (tetrahedron_count) sbri_torn_state, likewise */
  float *thinning;                          /* see sbri_island_state */
  float *stiffening; /* of the tetrahedra, see sbri_island_state: in of the last tick, out of this one */
  float *min_ratio;  /* out: least J of the tetrahedra when last looked at, 1 without them */
  float *stretch;    /* greatest share of a spring beyond its rest length: in of the last tick, out
                        of this one's last substep */
  uint32_t *passes;  /* over all elements are added to; NULL: nobody counts */
} sbri_island_tick;

static inline void sbri_count_passes(const sbri_island_tick *t, uint32_t passes) {
  if (t->passes) *t->passes += passes;
}

/* Velocity of a slot; of held ones that of their way through the tick. */
static inline sbf_vec3 sbri_slot_velocity(const sbri_island_tick *t, const float *velocities, uint32_t slot) {
  if (slot < t->island->free_count) {
    const float *v = velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
    return (sbf_vec3){v[0], v[SBRI_BLOCK], v[2 * SBRI_BLOCK]};
  }
  const sbri_point *from = &t->begins[slot], *to = &t->targets[slot];
  float rate = 1 / t->tick_s;
  return (sbf_vec3){(to->x - from->x) * rate, (to->y - from->y) * rate, (to->z - from->z) * rate};
}

static inline sbf_vec3 sbri_sample_place(const sbri_island_tick *t, const sbri_sample *s) {
  sbf_vec3 x = {0, 0, 0};
  for (int k = 0; k < 4; k++) {
    if (s->weights[k] == 0) continue;
    const sbri_point *p = &t->positions[s->slots[k]];
    x.x += s->weights[k] * p->x, x.y += s->weights[k] * p->y, x.z += s->weights[k] * p->z;
  }
  return x;
}

/* How many of the body's touches there are in this tick. */
static inline uint32_t sbri_touch_count(const sbri_island_tick *t, const sbri_body *body) {
  return t->touch_counts ? t->touch_counts[body - t->model->bodies] : 0;
}

/* Whether something of the body may touch anything in this tick. */
static inline bool sbri_may_touch(const sbri_island_tick *t, const sbri_body *body) {
  bool any = sbri_touch_count(t, body) > 0;
  for (uint32_t block = body->slot_begin / SBRI_BLOCK; block < body->slot_end / SBRI_BLOCK; block++)
    any = any || t->near_ground[block];
  return any;
}

#endif
