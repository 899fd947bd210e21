/* The runtime: simulates loaded assets inside any engine.
 *
 * A model is made once from an asset and never changes; many characters share it. A world contains characters
 * and steps them. Units are SI. World space is right-handed, +Y up. A character with heading 0 faces +Z; a
 * growing heading turns it left, towards +X.
 *
 * Clocks. Gait, inverse kinematics and clips run at the world's fixed control tick. Each tick is divided into
 * substeps of the soft bodies. sbr_world_step takes any frame time and runs ticks until they cover it. Reads
 * interpolate between the last two ticks at exactly the frame's time, so every frame rate shows the same
 * motion.
 *
 * Determinism. Equal inputs give equal bits: with any number of threads, any lane width, and after restoring
 * a snapshot.
 *
 * Sleep. Bodies at rest are not stepped. A standing character whose bodies all rest costs almost nothing. See
 * sbr_world_definition.sleep_after_s.
 *
 * Robustness. The acceleration that bones give to a body is limited to a quarter of the body's size a tick. A
 * body whose bones jump by more than its size in a tick moves along with them. A body that has lost its shape
 * or has non-finite numbers is reset to its rest shape; sbr_body_health.recoveries counts that.
 *
 * Threads. A world and its characters belong to one thread at a time. Different worlds are independent.
 * Models are read only: worlds on different threads may share them. A step allocates only when characters
 * change their level of detail (sbrun/detail.h) or begin to simulate rigid bodies (sbrun/rigid.h). It does so
 * with the world's allocator, on the thread that steps. If memory runs out, an event (sbrun/events.h) says
 * so.
 *
 * Errors. Calls that can fail return sbf_status and fill *error, which may be NULL. Setters ignore invalid
 * handles; getters then return zeros. Numbers that are not finite or exceed 1e15 are rejected: calls that
 * return sbf_status fail, other calls do nothing. */
#ifndef SBRUN_H
#define SBRUN_H

#include "sbfmt/model.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Shared data of the characters of one asset, and the container that steps characters; both opaque. */
typedef struct sbr_model sbr_model;
typedef struct sbr_world sbr_world;

/* Handle of a character: index and generation. */
typedef struct sbr_character_id {
  uint32_t value; /* 0: none */
} sbr_character_id;

/* Position in double precision. */
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

/* Level ground at a height. */
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
/* The host's threads. A tick calls `run` for each of its stages, and often while it steps a large body (docs/
 * solvers.md, "Threads within a body"); never from within a task. */
typedef struct sbr_tasks {
  void (*run)(void *user, sbr_task *task, void *context, uint32_t count); /* NULL: serial */
  void *user;                                                             /* the host's */
} sbr_tasks;

/* ---- Model -------------------------------------------------------------------------------------------- */

/* Instruction set of the solvers' loops. All give the same bits; they differ in speed only. */
typedef enum sbr_instructions {
  SBR_INSTRUCTIONS_AUTOMATIC,   /* the fastest that the processor has */
  SBR_INSTRUCTIONS_SCALAR,      /* one number at a time, on any processor */
  SBR_INSTRUCTIONS_SSE2,        /* four, x86-64 */
  SBR_INSTRUCTIONS_AVX2,        /* eight, x86-64 */
  SBR_INSTRUCTIONS_AVX512,      /* eight in twice as many registers, x86-64 */
  SBR_INSTRUCTIONS_NEON,        /* four, aarch64 */
  SBR_INSTRUCTIONS_WASM_SIMD128 /* four, WebAssembly */
} sbr_instructions;

/* Whether this library has loops for the set and this processor supports it. Callable from any thread. */
SBF_API bool sbr_instructions_are_available(sbr_instructions instructions);
/* "automatic", "scalar", "sse2", "avx2", "avx512", "neon", "wasm_simd128"; NULL for anything else. */
SBF_API const char *sbr_instructions_get_name(sbr_instructions instructions);

/* Settings of a model. */
typedef struct sbr_model_options {
  uint32_t cookie;                /* set by sbr_default_model_options */
  const sbf_allocator *allocator; /* NULL: malloc */
  uint32_t level;    /* level of each body, or its coarsest if it has fewer; if the runtime cannot step that
                        level, the nearest of springs or tetrahedra */
  sbf_scheme scheme; /* automatic: the level's own; if that is automatic too, symplectic, or position_based if
                        it would need too many substeps or fails (docs/solvers.md) */
  uint32_t substeps; /* per control tick; 0: the level's own, or as many as the scheme needs */
  bool free; /* drops all pins: bodies fall off the bones, and all their points have mass, interior points in
                proportion to the stiffness of their springs */
  bool has_gravity; /* rest shapes of sag-free bodies balance `gravity` instead of the asset's; set it as in
                       the world */
  sbf_vec3 gravity; /* m/s^2 */
  uint32_t tear_points; /* number of points that tearing may add to each body; 0: half of its points */
  float step_error_m;   /* maximum error of a step of a scheme with error control (heun); 0: the file's, else
                           0.0001 */
  sbr_instructions instructions; /* for the solvers' loops */
  uint32_t rigid_substeps;       /* per control tick for rigid parts (sbrun/rigid.h), at most 1000; in flight
                                    at least a quarter of them; 0: 4, or 1 if `rigid_coarse` */
  bool detail_levels; /* also makes levels coarser than `level`, jiggle, and bones alone, between which
                         characters change (sbrun/detail.h) */
  /* Cheaper rigid parts: one step per tick unless contacts or joints need more, joints with errors of up to
   * 0.1 mm (docs/rigid.md, "Coarse"). */
  bool rigid_coarse;
} sbr_model_options;

/* The default options: values of the asset. Begin with them. */
SBF_API sbr_model_options sbr_default_model_options(void);
/* `asset` must outlive the model. `options` NULL: the default. SBF_FAILED if memory runs out, the
 * instructions are not available, or the scheme is not one of the runtime's (symplectic, position_based,
 * relaxation, explicit_euler, heun, block_descent) or cannot step a body. SBF_BAD_INPUT if the asset needs
 * something that the runtime cannot simulate, or has a length above 1e6 m or another number above 1e15. */
SBF_API sbf_status sbr_model_create(
    const sbf_asset *asset, const sbr_model_options *options, sbr_model **model, sbf_diagnostic *error);
SBF_API void sbr_model_destroy(sbr_model *model);

/* Reports every part of the asset that the runtime ignores. Calls `report` once per part; `report` may be
 * NULL. Returns the number of parts. */
SBF_API uint32_t sbr_model_report_unsupported(
    const sbr_model *model, void (*report)(void *user, const sbf_diagnostic *diagnostic), void *user);
/* Reports every island of bodies whose scheme and substeps have a known error of more than a tenth
 * (SCHEME_BIASED), in the same way. Relaxation has no energy and is not reported. */
SBF_API uint32_t sbr_model_report_scheme_bias(
    const sbr_model *model, void (*report)(void *user, const sbf_diagnostic *diagnostic), void *user);

/* Instruction set in use; never automatic. */
SBF_API sbr_instructions sbr_model_get_instructions(const sbr_model *model);
/* Single-precision lanes of the solvers on this processor, unless a model's options select another set: 1, 4
 * or 8. For reports of speed; results do not depend on it. */
SBF_API uint32_t sbr_get_lane_count(void);

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
  /* Time at rest before a body falls asleep, in seconds. 0 disables sleeping. Default 0.5. A body rests if
   * all its points are slower than a hundredth of its size a second and its pins do not move. */
  double sleep_after_s;
  uint32_t collider_capacity; /* 0: 64; of sbrun/collision.h; more than that cannot be created */
  uint32_t event_capacity;    /* 0: 256; events of each kind that a step can report (sbrun/events.h) */
  float hit_speed;            /* m/s: closing speed from which a contact is reported as a hit; default 1 */
  void *user_data;            /* the host's */
} sbr_world_definition;

/* Begin with the default definition, change it, create the world. Destroying it destroys its characters. */
SBF_API sbr_world_definition sbr_default_world_definition(void);
SBF_API sbf_status sbr_world_create(
    const sbr_world_definition *definition, sbr_world **world, sbf_diagnostic *error);
SBF_API void sbr_world_destroy(sbr_world *world);
/* The host's pointer, as in the definition; the runtime does not use it. */
SBF_API void sbr_world_set_user_data(sbr_world *world, void *user_data);
SBF_API void *sbr_world_get_user_data(const sbr_world *world);

/* Advances by a frame of `seconds` (>= 0). */
SBF_API void sbr_world_step(sbr_world *world, double seconds);
/* Advances by exactly one control tick. */
SBF_API void sbr_world_tick(sbr_world *world);
SBF_API uint64_t sbr_world_get_tick_count(const sbr_world *world);
/* Number of soft bodies stepped in the last tick: neither asleep nor paused. */
SBF_API uint32_t sbr_world_count_awake_bodies(const sbr_world *world);
/* Hash of all mutable state except the interpolation time of reads. Equal states have equal hashes on every
 * machine and at every frame rate. */
SBF_API uint64_t sbr_world_get_state_hash(const sbr_world *world);

/* A snapshot is a plain copy of the state. `bytes` has sbr_world_get_snapshot_size bytes; the size stays the
 * same while the characters do. Restore into the same world with the same characters. SBF_FAILED if sizes or
 * characters differ, or memory for levels of detail runs out; the world is then unchanged. */
SBF_API size_t sbr_world_get_snapshot_size(const sbr_world *world);
SBF_API sbf_status sbr_world_save_snapshot(const sbr_world *world, void *bytes, size_t size);
SBF_API sbf_status sbr_world_restore_snapshot(sbr_world *world, const void *bytes, size_t size);

/* ---- Characters --------------------------------------------------------------------------------------- */

/* Initial state of a character. */
typedef struct sbr_character_definition {
  uint32_t cookie;      /* set by sbr_default_character_definition */
  sbr_double3 position; /* of the asset's origin; y counts from the ground below it, without colliders;
                           characters that walk, crawl, roll or slither fall from there */
  float heading;        /* rad */
  /* [1e-6, 1e6], default 1. Lengths scale by it, masses by its cube, stiffnesses (N/m) by its square and
   * times by its square root: the same shape under the same gravity moves as a body of that size does. */
  float scale;
  bool hold_pose;        /* bones stay in their rest pose */
  sbr_ground ground;     /* its own ground if `height` is set, else the world's; characters of one world may
                            stand on floors above each other */
  uint32_t detail_level; /* initial level of detail (sbrun/detail.h); beyond the last: the last; default 0:
                    the finest */
  void *user_data;       /* the host's */
} sbr_character_definition;

/* Begin with the default definition. The model must outlive the character. */
SBF_API sbr_character_definition sbr_default_character_definition(void);
SBF_API sbf_status sbr_character_create(sbr_world *world, const sbr_model *model,
    const sbr_character_definition *definition, sbr_character_id *character, sbf_diagnostic *error);
SBF_API void sbr_character_destroy(sbr_world *world, sbr_character_id character);
/* Whether the handle names a character of the world that has not been destroyed. */
SBF_API bool sbr_character_is_valid(const sbr_world *world, sbr_character_id character);
/* The host's pointer, as in the definition; the runtime does not use it. */
SBF_API void sbr_character_set_user_data(sbr_world *world, sbr_character_id character, void *user_data);
SBF_API void *sbr_character_get_user_data(const sbr_world *world, sbr_character_id character);

/* Sets the wanted velocity: forward speed in m/s, sideways (left) speed in m/s, turn in rad/s (left
 * positive). */
SBF_API void sbr_character_set_drive(
    sbr_world *world, sbr_character_id character, float forward, float sideways, float turn);
/* Wanted vertical speed in m/s of a character that swims or flies; others ignore it. 0 keeps the height, or
 * lets it drift while the drive is 0 as well (spec 14.7). Numbers that are not finite are ignored. */
SBF_API void sbr_character_set_vertical_speed(sbr_world *world, sbr_character_id character, float up);
/* Moves the character by `by` (m, world axes) and turns it (rad, left positive) in the next tick, instead of
 * its drive. Its feet follow with steps; floors and walls act on it. The vertical part is only for characters
 * that swim or fly. Several calls before a tick add up. */
SBF_API void sbr_character_displace(sbr_world *world, sbr_character_id character, sbf_vec3 by, float turn);
/* Moves the character at once, with soft bodies and feet, at rest relative to its bones. `position` as in the
 * definition. */
SBF_API void sbr_character_teleport(
    sbr_world *world, sbr_character_id character, sbr_double3 position, float heading);
/* Puts the character into its rest pose at its position, with zero velocities; forces and grabs
 * (sbrun/soft_body.h) end. */
SBF_API void sbr_character_reset(sbr_world *world, sbr_character_id character);
/* Wakes all sleeping bodies of the character. Needed only after a change that the runtime cannot see. Moving
 * pins, driving, teleporting and a changed ground (a host's ground: within four ticks) wake them anyway. */
SBF_API void sbr_character_wake(sbr_world *world, sbr_character_id character);
SBF_API void sbr_character_set_paused(sbr_world *world, sbr_character_id character, bool paused);

/* Origin of bones and vertices at the sampled time. */
SBF_API sbr_double3 sbr_character_get_origin(const sbr_world *world, sbr_character_id character);

/* Position and orientation. */
typedef struct sbr_transform {
  sbf_vec3 position; /* relative to the character's origin, m */
  sbf_quat rotation; /* bone frame to world */
} sbr_transform;
/* Bones of the asset, in its order, at the sampled time. */
SBF_API void sbr_character_get_bones(
    const sbr_world *world, sbr_character_id character, sbr_transform *bones, uint32_t capacity);
/* Scale of each bone along its own axes, about its head. 1 except where a follower squashes the bone; the
 * product of the three is 1. Children do not inherit it. sbr_character_get_skin already contains it. Returns
 * the number of bones. */
SBF_API uint32_t sbr_character_get_bone_scales(
    const sbr_world *world, sbr_character_id character, sbf_vec3 *scales, uint32_t capacity);

/* Skinned vertices of one render mesh at the sampled time, relative to the character's origin. Normals have
 * unit length; w of a tangent is the sign of the bitangent; tangents are zero without uvs. Normals and
 * tangents may be NULL. Returns the number of vertices of the mesh. */
SBF_API uint32_t sbr_character_get_skin(const sbr_world *world, sbr_character_id character,
    uint32_t render_mesh, sbf_vec3 *positions, sbf_vec3 *normals, sbf_vec4 *tangents, uint32_t capacity);
/* Unit normals of the same skin per polygon corner, in the order of mesh.polygon_points. Hard edges of the
 * mesh stay hard. Returns the number of corners. */
SBF_API uint32_t sbr_character_get_corner_normals(const sbr_world *world, sbr_character_id character,
    uint32_t render_mesh, sbf_vec3 *normals, uint32_t capacity);
/* The same for a render level of the mesh: 0 is the full mesh, n its n-th `render_level`. Returns 0 if there
 * is none. Only vertices used by the level's polygons are written, in ascending order of their numbers.
 * sbr_model_get_level_vertices returns these numbers, the same in every frame; renumber polygon_points by
 * them.
 */
SBF_API uint32_t sbr_model_get_level_vertices(const sbr_model *model, uint32_t render_mesh,
    uint32_t render_level, uint32_t *vertices, uint32_t capacity);
SBF_API uint32_t sbr_character_get_level_skin(const sbr_world *world, sbr_character_id character,
    uint32_t render_mesh, uint32_t render_level, sbf_vec3 *positions, sbf_vec3 *normals, sbf_vec4 *tangents,
    uint32_t capacity);
SBF_API uint32_t sbr_character_get_level_corner_normals(const sbr_world *world, sbr_character_id character,
    uint32_t render_mesh, uint32_t render_level, sbf_vec3 *normals, uint32_t capacity);
/* Polygons of a skin that tears have opened. `torn` receives 1 for each polygon of the render level (0: the
 * mesh) that spans a tear and must not be drawn, else 0. Returns the number of polygons. */
SBF_API uint32_t sbr_character_get_torn_polygons(const sbr_world *world, sbr_character_id character,
    uint32_t render_mesh, uint32_t render_level, uint8_t *torn, uint32_t capacity);
/* Surface vertices of one soft body in source order; points of its simulated level. */
SBF_API uint32_t sbr_character_get_surface(const sbr_world *world, sbr_character_id character,
    uint32_t soft_body, sbf_vec3 *positions, uint32_t capacity);
SBF_API uint32_t sbr_character_get_points(const sbr_world *world, sbr_character_id character,
    uint32_t soft_body, sbf_vec3 *positions, uint32_t capacity);

/* Handle of a collider (sbrun/collision.h). */
typedef struct sbr_collider_id {
  uint32_t value; /* 0: none */
} sbr_collider_id;

/* What a contact or a query found: a body of a character, a collider, or the ground if all are empty. */
typedef struct sbr_object {
  sbr_character_id character; /* whose body; 0: none */
  int32_t soft_body;          /* of the character; -1: none */
  int32_t rigid_body;         /* of the character; -1: none */
  sbr_collider_id collider;   /* 0: none */
} sbr_object;

/* Measures of a body after the last tick. Springs between two bodies count for the first. */
typedef struct sbr_body_health {
  float volume_ratio;  /* enclosed volume of the surface relative to rest; 1 for an open surface */
  float max_strain;    /* maximum |strain| of an element */
  bool finite;         /* all its numbers are finite */
  bool inverted;       /* an element, or the surface of a body without tetrahedra, is inside out */
  uint32_t recoveries; /* number of resets to its rest shape */
  double kinetic_j, elastic_j, potential_j; /* potential energy of weight is 0 at world y = 0 */
  uint32_t torn;                            /* elements torn since its creation or reset */
  uint32_t unsplit;        /* points that tears could not split, because tear_points was too small */
  bool asleep;             /* it is not stepped */
  bool rigid;              /* reset several times in a row: moves as a rigid body for a second or more */
  float min_element_ratio; /* minimum volume ratio of a tetrahedron, below 0 if inverted; 1 without
                              tetrahedra */
} sbr_body_health;
SBF_API sbr_body_health sbr_character_get_body_health(
    const sbr_world *world, sbr_character_id character, uint32_t soft_body);
/* Number of passes over all elements of the body's island since the character was created: a
 * machine-independent cost. Most schemes make one pass a substep; heun two, or three with damped springs;
 * block_descent one per sweep and end of an element; relaxation one a tick, over structural and shear springs
 * from both ends. Wraps from 2^32 - 1 to 0. Part of the state. 0: no such body, or it is not stepped. */
SBF_API uint32_t sbr_character_get_element_visits(
    const sbr_world *world, sbr_character_id character, uint32_t soft_body);
/* Maximum number of substeps a tick over all bodies, at rest and scale 1. */
SBF_API uint32_t sbr_model_get_substeps(const sbr_model *model);
/* The same for the island of one soft body; 0: it is not stepped. */
SBF_API uint32_t sbr_model_get_body_substeps(const sbr_model *model, uint32_t soft_body);

/* State of a leg of the gait. */
typedef struct sbr_leg_state {
  bool planted;         /* stands on the ground */
  uint32_t steps_taken; /* since the last teleport */
  sbf_vec3 foot;        /* middle of its sole, relative to the origin */
  sbf_vec3 target;      /* next foothold, or the present one */
  sbf_vec3 pole;        /* point that its knee points to */
  float phase;          /* 0..1 of a step while lifted */
} sbr_leg_state;
SBF_API uint32_t sbr_character_get_legs(
    const sbr_world *world, sbr_character_id character, sbr_leg_state *legs, uint32_t capacity);
SBF_API double sbr_character_get_distance(
    const sbr_world *world, sbr_character_id character); /* m travelled */

#ifdef __cplusplus
}
#endif
#endif
