/* The runtime: brings loaded assets to life inside any engine.
 *
 * A model is what many characters share: made once from an asset, never changed afterwards. A world holds
 * characters and steps them. Units are SI; world space is right-handed, +Y up; a character faces +Z when its
 * heading is 0 and turns left (towards +X) with growing heading.
 *
 * Clocks. Control (gait, IK, clips) runs at a fixed tick of the world; each tick is divided into substeps of
 * the soft bodies. sbr_world_step takes any frame time and runs ticks until they cover the time that has
 * passed; reads sample between the last two ticks, at exactly that time, so every frame rate shows the same
 * motion and none of it late.
 *
 * The same inputs give the same bits: on any number of threads, at any lane width, after restoring a
 * snapshot.
 *
 * Sleep. Bodies at rest are not stepped, and characters that stand with all bodies at rest cost next to
 * nothing, until something moves them: sbr_world_definition.sleep_after_s.
 *
 * Robustness. A body that its bones would throw about by more than a quarter of its size feels no more than
 * that, and one whose bones jump by more than its size in a tick goes along with them. One whose numbers or
 * whose shape are lost for good is put back into its rest shape; sbr_body_health.recoveries counts that.
 *
 * Threads. A world and its characters belong to one thread at a time; different worlds are independent;
 * models are read only and may be shared by worlds on different threads. A step allocates only where
 * characters change their level of detail (sbrun/detail.h) or begin to have simulated rigid parts
 * (sbrun/rigid.h), by the world's allocator, in the thread that steps; where memory runs out it tells by
 * SBR_EVENT_NO_MEMORY.
 *
 * Errors. Calls that can fail return sbf_status and fill *error (may be NULL). Handles that name nothing are
 * ignored by setters; getters then return zeros. A position, rotation, speed, impulse or any other number
 * that is not finite, or beyond 1e15, never gets in: what returns sbf_status fails, any other call does
 * nothing. */
#ifndef SBRUN_H
#define SBRUN_H

#include "sbfmt/model.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What characters of one asset share, and where they live; both opaque. */
typedef struct sbr_model sbr_model;
typedef struct sbr_world sbr_world;

/* Names a character: index and generation; 0 is none. */
typedef struct sbr_character_id {
  uint32_t value; /* 0: none */
} sbr_character_id;

/* A place far from any origin. */
typedef struct sbr_double3 {
  double x, y, z; /* m */
} sbr_double3;

/* ---- Ground ------------------------------------------------------------------------------------------- */

/* Height y and unit normal of the ground at (x, z), world space. `height` must be a pure function: it is
 * called from worker threads, many times a tick. `normal` is never NULL. */
typedef struct sbr_ground sbr_ground;
struct sbr_ground {
  double (*height)(const sbr_ground *ground, double x, double z, sbf_vec3 *normal); /* m */
  const void *user;                                                                 /* the host's */
  double parameters[4]; /* of the built-in grounds; free for others */
};

/* Level, at that height. */
SBF_API sbr_ground sbr_ground_flat(double height_m);
/* Rises towards +Z from the line z = 0; level behind it. [-45, 45] degrees. */
SBF_API sbr_ground sbr_ground_slope(double degrees);
/* Steps up towards +Z, each `rise_m` high and `run_m` deep, from z = run_m on. */
SBF_API sbr_ground sbr_ground_stairs(double rise_m, double run_m);
/* Smooth gradient noise between -height_m / 2 and height_m / 2, fading to flat within 0.5 m of the origin. */
SBF_API sbr_ground sbr_ground_noise(double height_m, uint32_t seed);

/* ---- Tasks -------------------------------------------------------------------------------------------- */

/* Runs task(context, i) for i below count, in any order, on any threads, and returns when all are done. */
typedef void sbr_task(void *context, uint32_t index);
/* The host's threads. */
typedef struct sbr_tasks {
  void (*run)(void *user, sbr_task *task, void *context, uint32_t count); /* NULL: serial */
  void *user;                                                             /* the host's */
} sbr_tasks;

/* ---- Model -------------------------------------------------------------------------------------------- */

/* What the solvers' loops are compiled for. Every one gives the same bits; they differ in speed alone. */
typedef enum sbr_instructions {
  SBR_INSTRUCTIONS_AUTOMATIC,   /* the fastest that the processor has */
  SBR_INSTRUCTIONS_SCALAR,      /* one number at a time, on any processor */
  SBR_INSTRUCTIONS_SSE2,        /* four, x86-64 */
  SBR_INSTRUCTIONS_AVX2,        /* eight, x86-64 */
  SBR_INSTRUCTIONS_AVX512,      /* eight in twice as many registers, x86-64 */
  SBR_INSTRUCTIONS_NEON,        /* four, aarch64 */
  SBR_INSTRUCTIONS_WASM_SIMD128 /* four, WebAssembly */
} sbr_instructions;

/* Whether this library has loops for them and this processor runs those. Any thread may call it. */
SBF_API bool sbr_instructions_available(sbr_instructions instructions);
/* "automatic", "scalar", "sse2", "avx2", "avx512", "neon", "wasm_simd128"; NULL for anything else. */
SBF_API const char *sbr_instructions_name(sbr_instructions instructions);

/* Settings of a model. */
typedef struct sbr_model_options {
  size_t struct_size;             /* sizeof(sbr_model_options), or 0 for this version's */
  const sbf_allocator *allocator; /* NULL: malloc */
  uint32_t level;    /* of each body that has so many levels, else its coarsest; of those of springs and of
                        tetrahedra the nearest */
  sbf_scheme scheme; /* automatic: the level's own, and where that is automatic, symplectic, or position_based
                        where that would be too many substeps or in trouble: docs/solvers.md */
  uint32_t substeps; /* of a control tick; 0: the level's own, or as many as the scheme needs */
  bool free; /* every pin is dropped: bodies fall apart from the bones, and all their points have mass, those
                inside in proportion to the stiffness of their springs */
  bool has_gravity; /* sag-free bodies bear `gravity` instead of the asset's own: what the world will use */
  sbf_vec3 gravity; /* m/s^2 */
  uint32_t tear_points; /* that tearing may add to each body; 0: half as many as it has */
  float step_error_m;   /* error that a step of a scheme with error control (heun) may have; 0: the file's,
                           else 0.0001 */
  sbr_instructions instructions; /* for the solvers' loops */
  uint32_t rigid_substeps;       /* of a control tick for rigid parts (sbrun/rigid.h), in flight a quarter at
                                  * the least; at most 1000; 0: 4, or 1 where `rigid_coarse` */
  bool ladder; /* coarser levels than `level` as well, jiggle and bones alone, between which characters change
                  (sbrun/detail.h) */
  /* Rigid parts fall for about half the time: one step of a tick where nothing asks for more, joints off by
   * up to 0.1 mm, a thousandth of a strike's energy left undecided (docs/rigid.md, "Coarse"). */
  bool rigid_coarse;
} sbr_model_options;

/* `asset` must outlive the model. SBF_FAILED where memory runs out, the instructions are not available, or
 * the scheme is not one of the runtime's (symplectic, position_based, relaxation, explicit_euler, heun,
 * block_descent) or cannot step a body; SBF_BAD_INPUT where the asset asks for something the runtime cannot
 * simulate. */
SBF_API sbf_status sbr_model_create(
    const sbf_asset *asset, const sbr_model_options *options, sbr_model **model, sbf_diagnostic *error);
SBF_API void sbr_model_destroy(sbr_model *model);

/* Tells of everything in the asset that the runtime leaves out (what it neither moves nor lets act), a
 * finding each, through `report` (may be NULL). Returns how many there are. */
SBF_API uint32_t sbr_model_left_out(
    const sbr_model *model, void (*report)(void *user, const sbf_diagnostic *finding), void *user);
/* Tells of every group of bodies that hang together and whose scheme and substeps, asked for or all that is
 * left, are known to be off the energy by more than a tenth (SCHEME_BIASED); likewise. Relaxation, which
 * knows no energy, is not among them. */
SBF_API uint32_t sbr_model_scheme_doubts(
    const sbr_model *model, void (*report)(void *user, const sbf_diagnostic *finding), void *user);

/* What the model's loops run with: never automatic. */
SBF_API sbr_instructions sbr_model_instructions(const sbr_model *model);
/* How many numbers of single precision the solvers compute at once on this processor, unless a model's
 * options say otherwise: 1, 4 or 8. For reports of speed; results do not depend on it. */
SBF_API uint32_t sbr_lanes(void);

/* ---- World -------------------------------------------------------------------------------------------- */

/* Settings of a world. */
typedef struct sbr_world_definition {
  uint32_t cookie; /* set by sbr_default_world_definition: catches a definition that was never initialised */
  const sbf_allocator *allocator; /* NULL: malloc */
  sbr_tasks tasks;                /* serial where empty */
  sbr_ground ground;              /* what characters stand on */
  bool has_gravity;               /* use `gravity` instead of each asset's own */
  sbf_vec3 gravity;               /* m/s^2 */
  double control_tick_s;          /* 0: 1/60; an asset's own is its environment.control_tick */
  double longest_frame_s;         /* a longer frame time is cut to it; 0: 0.25 */
  uint32_t character_capacity;    /* 0: 16; more than that cannot be created */
  /* Bodies that have rested for so long are no longer stepped; 0: all always are; default 0.5. At rest is
   * what is slower than a hundredth of its size a second, in all its points, and held by nothing that moves.
   */
  double sleep_after_s;
  uint32_t collider_capacity; /* 0: 64; of sbrun/collision.h; more than that cannot be created */
} sbr_world_definition;

/* A world is made from a definition that begins as the default, and destroyed with all its characters. */
SBF_API sbr_world_definition sbr_default_world_definition(void);
SBF_API sbf_status sbr_world_create(
    const sbr_world_definition *definition, sbr_world **world, sbf_diagnostic *error);
SBF_API void sbr_world_destroy(sbr_world *world);

/* Advances by a frame of `seconds` (>= 0). */
SBF_API void sbr_world_step(sbr_world *world, double seconds);
/* Advances by exactly one control tick. */
SBF_API void sbr_world_tick(sbr_world *world);
SBF_API uint64_t sbr_world_ticks(const sbr_world *world);
/* Soft bodies that were stepped in the last tick: neither asleep nor paused. */
SBF_API uint32_t sbr_world_awake(const sbr_world *world);
/* Hash of all mutable state, but for the fraction of a tick by which reads lie before the last one: equal
 * states, equal hashes, on every machine and at every frame rate. */
SBF_API uint64_t sbr_world_state_hash(const sbr_world *world);

/* A snapshot is a plain copy: save into `bytes` (sbr_world_snapshot_size of them, as many as long as the
 * characters are the same), restore into the same world with the same characters. SBF_FAILED where the sizes
 * or the characters differ, or memory for the levels of detail that they were on runs out; nothing has
 * changed then. */
SBF_API size_t sbr_world_snapshot_size(const sbr_world *world);
SBF_API sbf_status sbr_world_snapshot_save(const sbr_world *world, void *bytes, size_t size);
SBF_API sbf_status sbr_world_snapshot_restore(sbr_world *world, const void *bytes, size_t size);

/* ---- Characters --------------------------------------------------------------------------------------- */

/* Where and how a character begins. */
typedef struct sbr_character_definition {
  uint32_t cookie;      /* set by sbr_default_character_definition */
  sbr_double3 position; /* of the asset's origin; y counts from the ground below it */
  float heading;        /* rad */
  /* [1e-6, 1e6], default 1. Lengths scale by it, masses by its cube, stiffnesses (N/m) by its square and
   * times by its square root: the same shape under the same gravity, moving as a body of that size does. */
  float scale;
  bool hold;         /* bones stay in their rest pose */
  sbr_ground ground; /* of its own, where `height` is set; else the world's: characters of one world may stand
                        on floors above each other */
  uint32_t rung; /* the level of detail that it begins on (sbrun/detail.h), beyond the last: the last; default
                    0: the finest */
} sbr_character_definition;

/* A character likewise; its model must outlive it. */
SBF_API sbr_character_definition sbr_default_character_definition(void);
SBF_API sbf_status sbr_character_create(sbr_world *world, const sbr_model *model,
    const sbr_character_definition *definition, sbr_character_id *character, sbf_diagnostic *error);
SBF_API void sbr_character_destroy(sbr_world *world, sbr_character_id character);

/* Wanted motion: forward speed in m/s, sideways (left) speed in m/s, turn in rad/s (left positive). */
SBF_API void sbr_character_drive(
    sbr_world *world, sbr_character_id character, float forward, float sideways, float turn);
/* Moves it at once, soft bodies and feet with it, at rest relative to its bones. `position` as in the
 * definition. */
SBF_API void sbr_character_teleport(
    sbr_world *world, sbr_character_id character, sbr_double3 position, float heading);
/* Back to the rest pose where it stands, all speeds zero; forces and holds (sbrun/soft_body.h) end. */
SBF_API void sbr_character_reset(sbr_world *world, sbr_character_id character);
/* Wakes all that sleeps of it: for a host that has changed something which the runtime cannot see. What holds
 * a body, a wish to move, another place and (in a ground of the host's, within four ticks) another ground
 * under it wake it by themselves. */
SBF_API void sbr_character_wake(sbr_world *world, sbr_character_id character);
SBF_API void sbr_character_pause(sbr_world *world, sbr_character_id character, bool paused);

/* Origin that bones and vertices are relative to, as of the sampled moment. */
SBF_API sbr_double3 sbr_character_origin(const sbr_world *world, sbr_character_id character);

/* A place and an orientation. */
typedef struct sbr_transform {
  sbf_vec3 position; /* relative to the character's origin, m */
  sbf_quat rotation; /* bone frame to world */
} sbr_transform;
/* Bones of the asset, in its order, at the sampled moment. */
SBF_API void sbr_character_bones(
    const sbr_world *world, sbr_character_id character, sbr_transform *bones, uint32_t capacity);
/* How the same bones are scaled along their own axes, about their heads: 1, but where a follower squashes
 * one; the product of the three is 1, and bones that hang on it are not scaled with it. The skin has it
 * already. Returns how many bones there are. */
SBF_API uint32_t sbr_character_bone_scales(
    const sbr_world *world, sbr_character_id character, sbf_vec3 *scales, uint32_t capacity);

/* The skin: vertices of one render mesh at the sampled moment, relative to the character's origin, with unit
 * normals, and tangents whose w is the bitangent's sign (zeros where the mesh has no uvs); both may be NULL.
 * One of each a vertex; returns how many vertices the mesh has. */
SBF_API uint32_t sbr_character_skin(const sbr_world *world, sbr_character_id character, uint32_t render_mesh,
    sbf_vec3 *positions, sbf_vec3 *normals, sbf_vec4 *tangents, uint32_t capacity);
/* Unit normals of the same skin, one a corner of its polygons (mesh.polygon_points order): edges that the
 * mesh's own normals show as hard stay hard. Returns how many corners there are. */
SBF_API uint32_t sbr_character_corner_normals(const sbr_world *world, sbr_character_id character,
    uint32_t render_mesh, sbf_vec3 *normals, uint32_t capacity);
/* The same of a render level of the mesh: 0 the full one, n its n-th `render_level`; 0 is returned where
 * there is none. Only the vertices that the level's polygons use are computed and written, in ascending
 * order; which those are says sbr_model_level_vertices, once for all frames. A host renumbers the level's
 * polygon_points by that, and draws far characters for what their levels cost. */
SBF_API uint32_t sbr_model_level_vertices(const sbr_model *model, uint32_t render_mesh, uint32_t render_level,
    uint32_t *vertices, uint32_t capacity);
SBF_API uint32_t sbr_character_level_skin(const sbr_world *world, sbr_character_id character,
    uint32_t render_mesh, uint32_t render_level, sbf_vec3 *positions, sbf_vec3 *normals, sbf_vec4 *tangents,
    uint32_t capacity);
SBF_API uint32_t sbr_character_level_corner_normals(const sbr_world *world, sbr_character_id character,
    uint32_t render_mesh, uint32_t render_level, sbf_vec3 *normals, uint32_t capacity);
/* What tears have opened of a skin that rides on tetrahedra or on points of springs: `torn`
 * gets 1 for each polygon of the render level (0: the mesh) that spans a tear and is to be left out when it
 * is drawn, else 0. Returns how many polygons that has. */
SBF_API uint32_t sbr_character_torn_polygons(const sbr_world *world, sbr_character_id character,
    uint32_t render_mesh, uint32_t render_level, uint8_t *torn, uint32_t capacity);
/* Surface vertices of one soft body, in source order; and the points of its simulated level. */
SBF_API uint32_t sbr_character_surface(const sbr_world *world, sbr_character_id character, uint32_t soft_body,
    sbf_vec3 *positions, uint32_t capacity);
SBF_API uint32_t sbr_character_points(const sbr_world *world, sbr_character_id character, uint32_t soft_body,
    sbf_vec3 *positions, uint32_t capacity);

/* Names a collider (sbrun/collision.h); 0 is none. */
typedef struct sbr_collider_id {
  uint32_t value; /* 0: none */
} sbr_collider_id;

/* What happened in a tick. */
typedef enum sbr_event_kind {
  SBR_EVENT_FOOT_DOWN,
  SBR_EVENT_FOOT_UP,
  SBR_EVENT_LANDED, /* what fell (sbr_character_rigid_fall) lies still and begins to get up; where it will
                       stand */
  SBR_EVENT_TEAR,   /* an element tore; of more than 16 in one tick of bodies that hang together, the first */
  SBR_EVENT_UNSPLIT,  /* a tear found no room to split points: more tear_points */
  SBR_EVENT_ASLEEP,   /* bodies that hang together are no longer stepped */
  SBR_EVENT_AWAKE,    /* and are again */
  SBR_EVENT_CONTACT,  /* a body that did not in the tick before touches the ground or a collider (of more than
                         four at once, the first four), or another body (sbr_world_bodies_meet) */
  SBR_EVENT_PARTED,   /* two bodies of characters that touched each other do so no longer */
  SBR_EVENT_NO_MEMORY /* there was none for the level of detail that it was to go over to: it stays on its
                         own; or for its simulated rigid parts: they stand still. Asked for again in half a
                         second
                         */
} sbr_event_kind;
/* Something that happened in a step. */
typedef struct sbr_event {
  sbr_event_kind kind;        /* what happened */
  sbr_character_id character; /* to whom */
  uint32_t leg;               /* of the gait, from 0; 0 for what is no foot's */
  uint64_t tick;              /* since the world began */
  sbr_double3 position;       /* world */
  uint32_t soft_body; /* of a tear: whose element; of sleep: the first of those bodies; of contact: which */
  int32_t rigid_body; /* of contact: which, if it is one; -1: none */
  sbr_collider_id collider; /* of contact: with that; 0: with the ground, or with `other` */
  sbf_vec3 normal;        /* of contact: away from what is touched; of bodies that part: when they touched */
  float impulse;          /* of contact: N s, about, in that tick */
  sbr_character_id other; /* of contact and parting: whose body it is with, or the same; 0: with none */
  uint32_t other_soft_body; /* which */
  int32_t other_rigid_body; /* which, if it is one; -1: none */
  float speed;              /* of contact with `other`: m/s with which they came together */
} sbr_event;
/* Two bodies that touch are told of once, in whichever order; of characters that are destroyed nobody parts.
 * Contacts of bodies come in a fixed order after all else of their tick but sleep, on any number of threads.
 */
/* Events since the last call, oldest first; returns how many were written. Older ones than the world keeps
 * (256) are lost. They are output, not state: snapshots do not hold them. */
SBF_API uint32_t sbr_world_events(sbr_world *world, sbr_event *events, uint32_t capacity);

/* How a body fares, as of the last tick. Springs between two bodies count for the first. */
typedef struct sbr_body_health {
  float volume_ratio;  /* enclosed volume of the surface against rest; 1 for an open surface */
  float max_strain;    /* greatest |strain| of an element */
  bool finite;         /* every number is */
  bool inverted;       /* an element, or the surface as a whole, is inside out */
  uint32_t recoveries; /* how often it had to be put back into its rest shape, having lost it for good */
  double kinetic_j, elastic_j, potential_j; /* potential is that of weight, 0 at the height of world y = 0 */
  uint32_t torn;                            /* elements that have torn since it was made or reset */
  uint32_t
      unsplit; /* points that tears of bodies that hang together could not split, for want of tear_points */
  bool asleep; /* it rests, and is not stepped */
} sbr_body_health;
SBF_API sbr_body_health sbr_character_health(
    const sbr_world *world, sbr_character_id character, uint32_t soft_body);
/* How often all elements of a body, and of those that hang together with it, have been looked at since it was
 * made: what its motion costs, on any machine. Once a substep by most schemes; twice
 * by heun, three times where springs are damped; by block_descent in each of its sweeps, from each end of an
 * element; once a tick by relaxation, in which it goes to structural and shear springs from either end and to
 * none of flexion. Counts on from 2^32 - 1 to 0. Part of the state. 0: there is no such body, or it is not
 * stepped.
 */
SBF_API uint32_t sbr_character_passes(const sbr_world *world, sbr_character_id character, uint32_t soft_body);
/* The most substeps of a tick that a body at rest and of scale 1 needs. */
SBF_API uint32_t sbr_model_substeps(const sbr_model *model);
/* The same of one soft body and those that hang together with it; 0: it is not stepped. */
SBF_API uint32_t sbr_model_body_substeps(const sbr_model *model, uint32_t soft_body);

/* Gait, for measuring: where a leg is and what it does. */
typedef struct sbr_leg_state {
  bool planted;         /* stands on the ground */
  uint32_t steps_taken; /* since it was placed */
  sbf_vec3 foot;        /* middle of its sole, relative to the origin */
  sbf_vec3 target;      /* where that will come down, or stands */
  sbf_vec3 pole;        /* that its knee points to */
  float phase;          /* 0..1 of a step while lifted */
} sbr_leg_state;
SBF_API uint32_t sbr_character_legs(
    const sbr_world *world, sbr_character_id character, sbr_leg_state *legs, uint32_t capacity);
SBF_API double sbr_character_distance(const sbr_world *world, sbr_character_id character); /* m travelled */

#ifdef __cplusplus
}
#endif
#endif
