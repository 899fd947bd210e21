/* Soft bodies moved by the host: velocities, impulses, forces, grabbed vertices; reactions of pins.
 *
 * `vertex` is a vertex of the body's surface, in the order of sbr_character_get_surface. Calls act on the
 * points that it is embedded in: an impulse J there changes the body's momentum by J and its angular momentum
 * by r x J. The part on pinned points acts on the simulated rigid bodies that they are pinned to; bones do
 * not react.
 *
 * Lengths are world metres; N, N s and N m are the world's, at any scale of the character. Calls take effect
 * with the next tick and wake sleeping bodies. They are recorded (sbrun/record.h), and everything set here is
 * state, stored in snapshots. SBF_FAILED and BAD_CALL, without a change: a character, body or vertex that
 * does not exist, a number that is not finite, a body that is not simulated (on this level of detail, or
 * without one), or one stepped by relaxation, which has no forces. `error` may be NULL. No call allocates. */
#ifndef SBRUN_SOFT_BODY_H
#define SBRUN_SOFT_BODY_H

#include "sbrun/sbrun.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Instead of a vertex: all points of the body, weighted by their masses, without deformation. */
#define SBR_WHOLE_BODY UINT32_MAX
/* Maximum number of forces and grabs that act on a character. */
#define SBR_LOAD_CAPACITY 8

/* Whether the character is valid and its asset has a soft body of this index. */
SBF_API bool sbr_character_has_soft_body(
    const sbr_world *world, sbr_character_id character, uint32_t soft_body);
/* The host's pointer for a soft body, at first NULL; the runtime does not use it. */
SBF_API void sbr_character_set_soft_user_data(
    sbr_world *world, sbr_character_id character, uint32_t soft_body, void *user_data);
SBF_API void *sbr_character_get_soft_user_data(
    const sbr_world *world, sbr_character_id character, uint32_t soft_body);

/* Motion of a soft body's free points as one rigid body, as of the last tick. */
typedef struct sbr_soft_motion {
  float mass;                /* kg, of the free points */
  sbf_vec3 center;           /* of mass, relative to the character's origin, m */
  sbf_vec3 velocity;         /* of the centre of mass, m/s */
  sbf_vec3 angular_velocity; /* rad/s, world axes */
} sbr_soft_motion;
/* Zeros if the body is not simulated. */
SBF_API sbr_soft_motion sbr_character_get_soft_motion(
    const sbr_world *world, sbr_character_id character, uint32_t soft_body);

/* Sets the body's motion as a whole: velocity of its centre of mass in m/s, angular velocity in rad/s, world
 * axes. Its deformation keeps its own motion. */
SBF_API sbf_status sbr_character_set_soft_velocity(sbr_world *world, sbr_character_id character,
    uint32_t soft_body, sbf_vec3 velocity, sbf_vec3 angular_velocity, sbf_diagnostic *error);

/* Applies an impulse in N s at a vertex, or to the whole body. */
SBF_API sbf_status sbr_character_apply_soft_impulse(sbr_world *world, sbr_character_id character,
    uint32_t soft_body, uint32_t vertex, sbf_vec3 impulse, sbf_diagnostic *error);

/* Applies a constant force in N for `seconds` of the world's ticks, from the next on: an impulse of force *
 * seconds in all. SBF_FAILED also if SBR_LOAD_CAPACITY loads already act. */
SBF_API sbf_status sbr_character_apply_soft_force(sbr_world *world, sbr_character_id character,
    uint32_t soft_body, uint32_t vertex, sbf_vec3 force, float seconds, sbf_diagnostic *error);

/* A damped spring with a bounded force that pulls a vertex to a target. */
typedef struct sbr_vertex_grab {
  uint32_t cookie;     /* set by sbr_default_vertex_grab: catches a struct that was never initialised */
  sbr_double3 target;  /* world, m */
  float frequency_hz;  /* (0, 100], of the whole body on that spring; 0: 5 Hz */
  float damping_ratio; /* [0, 10], of that oscillation; 1: no overshoot */
  float max_force;     /* N, greater than 0; 0: 20 times the body's weight on earth */
} sbr_vertex_grab;
/* Target at the world's origin, damping ratio 1, all else 0. */
SBF_API sbr_vertex_grab sbr_default_vertex_grab(void);
/* Grabs the vertex until it is released. If it is already grabbed, moves the target. */
SBF_API sbf_status sbr_character_grab_vertex(sbr_world *world, sbr_character_id character, uint32_t soft_body,
    uint32_t vertex, const sbr_vertex_grab *grab, sbf_diagnostic *error);
/* Releases the vertex at its velocity. False if it was not grabbed. */
SBF_API bool sbr_character_release_vertex(
    sbr_world *world, sbr_character_id character, uint32_t soft_body, uint32_t vertex);
/* Force on the vertex in N, world axes, mean of the last tick; zeros if it is not grabbed. */
SBF_API sbf_vec3 sbr_character_get_grab_force(
    const sbr_world *world, sbr_character_id character, uint32_t soft_body, uint32_t vertex);

/* Vertex of the body's surface nearest to a position (world), at the sampled time; SBR_WHOLE_BODY if the
 * body has no surface. */
SBF_API uint32_t sbr_character_find_nearest_vertex(
    const sbr_world *world, sbr_character_id character, uint32_t soft_body, sbr_double3 position);

/* Force and torque of the pins of one set on the body: elastic forces and goal springs at the end of the last
 * tick, without damping relative to the pins. For a body that hangs at rest, the weight of its free points,
 * upwards. With symplectic and heun, weight and reactions equal the change of momentum. With position_based,
 * the error is some per cent of the weight. With block_descent, reactions are right only near rest. */
typedef struct sbr_pin_reaction {
  uint32_t pin_set;   /* of the simulated level's pins */
  int32_t bone;       /* bone of the set; -1: none */
  int32_t rigid_body; /* rigid body of the set; -1: none; both -1: the world */
  uint32_t points;    /* number of points that the set pins; a point counts for the first set */
  sbf_vec3 about;     /* m, relative to the character's origin: mean of the pinned positions */
  sbf_vec3 force;     /* N, world axes */
  sbf_vec3 torque;    /* N m about `about` */
} sbr_pin_reaction;
/* One for each pin set of the simulated level, in the file's order; returns how many there are. 0: the body
 * is not simulated, or by relaxation. */
SBF_API uint32_t sbr_character_get_pin_reactions(const sbr_world *world, sbr_character_id character,
    uint32_t soft_body, sbr_pin_reaction *reactions, uint32_t capacity);

/* A tetrahedron as of the last tick. */
typedef struct sbr_tetrahedron_state {
  float stress[6];      /* Cauchy stress in Pa, world axes: xx, yy, zz, xy, yz, zx */
  float energy_density; /* strain energy per volume at rest, J/m^3 */
  float rest_volume;    /* m^3 */
  float volume_ratio;   /* volume relative to rest; below 0: inverted */
  uint32_t corners[4];  /* points of the level, before any tear */
  bool torn;            /* stress, energy and volumes are 0 */
} sbr_tetrahedron_state;
/* Tetrahedra of the simulated level, in its order; returns how many there are. 0: the level has
 * none. */
SBF_API uint32_t sbr_character_get_tetrahedra(const sbr_world *world, sbr_character_id character,
    uint32_t soft_body, sbr_tetrahedron_state *tetrahedra, uint32_t capacity);

/* A spring as of the last tick. */
typedef struct sbr_spring_state {
  uint32_t ends[2]; /* points of the level, before any tear */
  float tension;    /* N, without damping; below 0: compression */
  float energy;     /* J */
  bool torn;        /* tension and energy are 0 */
} sbr_spring_state;
/* Springs of the simulated level that act, in the order of its sets; returns how many there are. */
SBF_API uint32_t sbr_character_get_springs(const sbr_world *world, sbr_character_id character,
    uint32_t soft_body, sbr_spring_state *springs, uint32_t capacity);

#ifdef __cplusplus
}
#endif
#endif
