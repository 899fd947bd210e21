/* SoftCharacter3D: a node that shows and simulates a SoftAsset.
 *
 * Each node has a world of its own, stepped once a physics frame, or shares one with the nodes that it may
 * touch (shared_world.c). Files: properties (character_properties.c), life cycle (soft_character.c), creation
 * of model and world (character_making.c), position (character_position.c, character_loose.c), methods
 * (character_calls.c), mesh, skeleton, ground and physics bodies. */
#ifndef SBFMT_GODOT_SOFT_CHARACTER_H
#define SBFMT_GODOT_SOFT_CHARACTER_H

#include "sbrun/collision.h"
#include "soft_asset.h"

/* Source of its ground. */
typedef enum soft_ground {
  SOFT_GROUND_PHYSICS, /* the bodies of the physics space */
  SOFT_GROUND_FLAT     /* a plane at the initial height of the node */
} soft_ground;

/* Detail of the simulation. */
typedef enum soft_detail {
  SOFT_DETAIL_AUTOMATIC, /* by the camera's view (level_of_detail.c) */
  SOFT_DETAIL_FULL       /* always the finest level */
} soft_detail;
typedef enum soft_detail_state {
  SOFT_DETAIL_UNKNOWN, /* initial value of a new character */
  SOFT_DETAIL_FINEST,
  SOFT_DETAIL_BY_VIEW,
  SOFT_DETAIL_HIDDEN
} soft_detail_state;

/* Settings of the inspector; names as in words.c. */
typedef struct soft_simulation_settings {
  int64_t scheme, substeps, level; /* as in sbr_model_options */
  int64_t detail;                  /* a soft_detail */
  bool free_bodies, hold_pose, use_threads;
  double gravity_scale;
} soft_simulation_settings;

typedef struct soft_drive_settings {
  double forward_speed, sideways_speed, turn_speed, vertical_speed; /* m/s, m/s, rad/s, m/s */
  double max_turn_speed; /* rad/s of move_and_slide; 0: it keeps its heading */
} soft_drive_settings;

typedef struct soft_collision_settings {
  int64_t ground;                          /* a soft_ground */
  int64_t collision_layer, collision_mask; /* physics layers it is on, and that it collides with */
  bool input_ray_pickable;
  bool push_bodies;
  double push_limit;        /* m/s: maximum velocity change of a body by a frame's impulse; 0: no bound */
  bool collide_with_others; /* contacts with other nodes of the physics space */
} soft_collision_settings;

typedef struct soft_display_settings {
  bool mirror_skeleton;
  int64_t cast_shadow, layers; /* as in Godot's GeometryInstance3D */
} soft_display_settings;

typedef struct soft_settings {
  soft_simulation_settings simulation;
  soft_drive_settings drive;
  soft_collision_settings collision;
  soft_display_settings display;
  bool paused, preview;
  double teleport_distance; /* m: a node that is moved farther in a frame is placed there; 0: half its size */
} soft_settings;

typedef struct character_mesh character_mesh;
typedef struct physics_ground physics_ground;
typedef struct physics_bodies physics_bodies;
typedef struct physics_parts physics_parts;
typedef struct shared_world shared_world;
typedef struct contact_list contact_list;
typedef struct clip_player clip_player;
typedef struct pose_driver pose_driver;

/* A vertex of a soft body's surface. */
typedef struct surface_vertex {
  uint32_t soft_body, vertex;
  sbf_vec3 position; /* m */
} surface_vertex;

/* Resources of a character, with a reference each. */
typedef struct soft_resources {
  gd_variant asset;             /* SoftAsset; nil: none */
  gd_variant material;          /* of all its meshes */
  gd_variant surface_materials; /* Dictionary: of single surfaces */
} soft_resources;

/* Position of the node and of its character. */
typedef struct soft_placement {
  bool is_placed;        /* on the ground, from the first physics frame on */
  bool is_still;         /* it does not move: paused, or its node does not process */
  double flat_ground_y;  /* height of the flat ground */
  gd_transform shown_at; /* where its own motion last moved the node */
  bool was_displaced;    /* its node was moved, but the world did not follow at this tick: */
  uint64_t displaced_at_tick;
  sbf_vec3 queried_at;  /* position at the last query for bodies */
  sbf_vec3 last_origin; /* of the node after the last step */
} soft_placement;

/* A character without pins (character_loose.c), and its last placement. */
typedef struct soft_loose_motion {
  bool is_loose;
  sbr_double3 frame; /* its frame in the runtime, y above the ground there */
  sbf_vec3 middle;   /* centre of its points at rest, from the node's origin, without rotation */
} soft_loose_motion;

/* Motion in the editor. */
typedef struct soft_preview {
  bool is_running;
  gd_transform started_at;
  gd_transform warned_at; /* transform at the last warnings of the editor */
} soft_preview;

/* A vertex that a script has grabbed. */
typedef struct soft_grab {
  bool is_active;
  surface_vertex vertex; /* its position: from the grabbed point */
} soft_grab;

/* Motion as a script sees it. */
typedef struct soft_movement {
  sbf_vec3 velocity;        /* m/s, of the script */
  sbf_vec3 real_velocity;   /* m/s, measured */
  sbf_vec3 wanted_velocity; /* m/s, at the last move_and_slide */
  int64_t posture;          /* sbr_posture after the last step */
} soft_movement;

/* What links it with Godot's physics space. */
typedef struct soft_physics {
  physics_ground *ground;
  physics_bodies *bodies; /* the shared world's */
  physics_parts *parts;   /* NULL: none */
} soft_physics;

typedef struct soft_bounds {
  sbf_vec3 low, high; /* m */
} soft_bounds;

typedef struct soft_character {
  gd_variant node; /* itself, without a reference */
  soft_resources resources;
  soft_settings settings;
  bool is_in_editor;

  /* Set while there is an asset and the node is in a tree. */
  soft_model *model;
  shared_world *shared;
  sbr_world *world; /* its */
  sbr_character_id id;
  soft_bounds bounds; /* of the asset at rest */
  float scale;        /* scale of the node when it was created */
  soft_detail_state detail_state;
  soft_loose_motion loose;
  soft_placement placement;
  soft_preview preview;
  soft_movement movement;
  soft_physics physics;
  soft_grab grab;
  character_mesh *mesh;
  bool is_mesh_stale;
  bool is_mirrored;         /* its node has a negative scale */
  gd_variant skeleton;      /* Skeleton3D; nil: none */
  clip_player *clip_player; /* NULL: nothing was played */
  pose_driver *pose_driver; /* NULL: nothing was posed */
} soft_character;

/* Logs an error with the node's name. */
void soft_character_error(const soft_character *one, const char *message);
void soft_character_warning(const soft_character *one, const char *message);

extern const gd_class soft_character_class;
extern const gd_property soft_character_properties[];
extern const gd_method soft_character_methods[], soft_character_virtuals[];

/* ---- character_making.c ---- */

/* Recreates model, world and mesh, and keeps the character's state where possible; called when the asset or
 * an option of the model changes. Does nothing without an asset or outside of a tree. */
void soft_character_make(soft_character *one);
void soft_character_unmake(soft_character *one);
void soft_character_drive(soft_character *one);

/* ---- character_position.c ---- */

/* The node's transform in the world; and the heading of a transform, rad. */
gd_transform soft_character_transform(const soft_character *one);
float transform_heading(const gd_transform *node_transform);
/* Scale along +Y; 1 if that is 0. */
float transform_scale(const gd_transform *node_transform);
/* Moves the node to the character's present position. */
void soft_character_follow(soft_character *one);
/* Places the character: a position above the ground below it (m), a heading (rad). */
void soft_character_set_position(soft_character *one, sbf_vec3 position, float heading);
/* m: the maximum of its width and height; and the maximum distance of its parts from the node. */
double soft_character_size(const soft_character *one);
double soft_character_around(const soft_character *one);
/* Before its world steps: takes over the node's position and finds nearby bodies. Returns whether it is
 * simulated. */
bool soft_character_prepare(soft_character *one);
/* Pauses or continues the character. */
void soft_character_pause(soft_character *one);
/* Recreates the character at the node's scale; returns whether that has changed. */
bool soft_character_rescale(soft_character *one);
/* In the editor: a scene is saved with the node at its position before the preview. */
void soft_character_save(soft_character *one, bool done);
/* After the step: its node and its skeleton follow. */
void soft_character_show(soft_character *one);
double soft_character_ground_height(const soft_character *one, double x, double z);

/* ---- character_loose.c ---- */

bool soft_asset_is_loose(const sbf_asset *asset);
/* Call after it was created at its node's position. */
void soft_character_loose_begin(soft_character *one);
/* Moves `put` with the character, or the character to `put`. Returns false if it has pins. */
bool soft_character_loose_follow(soft_character *one);
bool soft_character_set_loose_position(soft_character *one);

/* ---- character_properties.c ---- */

/* Whether a number may be set; otherwise it does not change, with an error in the log. */
bool soft_character_fits(const soft_character *one, const char *name, double value, double low, double high);
#define SOFT_MAX 1e4 /* maximum of numbers with a unit */
/* A Callable of one of its methods. */
gd_variant soft_character_callable(const soft_character *one, const char *method);
/* Called when the resource has changed: the character takes its new content. */
gd_function soft_character_asset_changed;

/* ---- character_parts.c ---- */

/* Creates or frees the parts by the settings. */
void soft_character_apply_part_settings(soft_character *one);
/* Index of the bone of a name; -1: none. */
int32_t soft_character_bone(const soft_character *one, const gd_variant *name);
extern const gd_method soft_character_part_methods[];

/* ---- character_grab.c ---- */

extern const gd_method soft_character_grab_methods[];

/* ---- character_animation.c ---- */

extern const gd_method soft_character_animation_methods[];

/* ---- character_movement.c ---- */

/* After a step. */
void soft_character_measure_velocity(soft_character *one, float frame_s);
extern const gd_method soft_character_movement_methods[];

/* ---- character_soft.c ---- */

gd_function soft_character_get_soft_mass, soft_character_get_soft_velocity,
    soft_character_get_soft_angular_velocity, soft_character_set_soft_velocity,
    soft_character_apply_soft_impulse, soft_character_apply_soft_force, soft_character_get_nearest_vertex,
    soft_character_grab_vertex, soft_character_release_vertex, soft_character_get_grab_force,
    soft_character_get_pin_reactions, soft_character_get_stress;

/* ---- character_mesh.c ---- */

/* NULL if memory runs out, or there is nothing to draw. Creates child nodes of the node. */
character_mesh *character_mesh_make(soft_character *one);
void character_mesh_free(character_mesh *mesh);
void character_mesh_update(character_mesh *mesh, soft_character *one);
/* Applies material, shadows and layers of the settings. */
void character_mesh_apply_settings(character_mesh *mesh, const soft_character *one);
/* Applies the materials of single surfaces. */
void character_mesh_apply_materials(character_mesh *mesh, const soft_character *one);
/* The MeshInstance3D of a render mesh; nil: none. */
gd_variant character_mesh_instance(const character_mesh *mesh, int64_t render_mesh);

/* ---- character_skeleton.c ---- */

/* Updates the bones from the model, or removes the skeleton if the settings do not want one. */
void character_skeleton_make(soft_character *one);
void character_skeleton_free(soft_character *one);
void character_skeleton_update(soft_character *one);

/* ---- physics_ground.c ---- */

physics_ground *physics_ground_make(void);
void physics_ground_free(physics_ground *ground);
/* A level ground: far below if there is a body under the node, else at its height; main thread, in a physics
 * frame.
 */
void physics_ground_query(soft_character *one);
sbr_ground physics_ground_of(physics_ground *ground);
/* A horizontal ground at that height (m) until the next query. */
void physics_ground_level(physics_ground *ground, double level);

/* ---- physics_bodies.c ---- */

physics_bodies *physics_bodies_make(void);
void physics_bodies_free(physics_bodies *bodies, sbr_world *world);
/* Creates colliders for the bodies near the character; queries now, or every few frames. */
void physics_bodies_query(soft_character *one, bool now);
/* Once per step: moves the present colliders; and applies the impulses of the step to the bodies. */
void physics_bodies_move(physics_bodies *bodies, sbr_world *world, float frame_s, bool pushes);
void physics_bodies_push(physics_bodies *bodies, sbr_world *world, const soft_settings *settings);
/* Adds the movable bodies to the exceptions of a character's parts. */
void physics_bodies_except(const physics_bodies *bodies, physics_parts *parts);
/* The object of a collider, or null. */
gd_variant physics_bodies_object(const physics_bodies *bodies, sbr_collider_id collider);

/* Whether one of the near bodies is moved by Godot's engine. */
bool physics_bodies_any_rigid(const physics_bodies *bodies);

/* ---- level_of_detail.c ---- */

/* us per physics frame for all characters of the project, from its settings; 0: no bound. */
double level_of_detail_budget_us(void);
/* Lets the world select the levels of its characters; false without memory. */
bool level_of_detail_select(sbr_world *world, double budget_us);
/* Call before a step of their world: passes the views to it. */
void level_of_detail_update(soft_character *const *members, uint32_t count);

/* ---- physics_shapes.c ---- */

/* Converts a body's shape; NULL if it is not supported, with one message if it should be. `object`: its
 * owner; `inner`: transform of the runtime's shape in Godot's. */
sbr_shape *physics_shape_of(const gd_variant *server, const gd_variant *body, int64_t index,
    const gd_variant *object, gd_transform *inner);

/* ---- world_events.c ---- */

/* Signals of the last step of a world. Handlers may free any node: its holder keeps it. */
void world_events_report(shared_world *shared);

/* ---- shared_world.c ---- */

/* A world for a character with a model and a position: its own, or a shared one. Sets the character's fields
 * that belong to the world. Returns false, with a message, if it cannot be created. */
bool shared_world_join(soft_character *one, const sbr_world_definition *definition);
void shared_world_leave(soft_character *one);
/* Number of nodes in it, and one of them. */
uint32_t shared_world_count(const shared_world *shared);
soft_character *shared_world_at(const shared_world *shared, uint32_t index);
sbr_world *shared_world_get(const shared_world *shared);
const physics_bodies *shared_world_bodies(const shared_world *shared);
/* Whether its characters pass through an object: see body_is_passed. */
bool shared_world_has(const shared_world *shared, const gd_variant *object);
/* Physics frame of the character: the first character of a world that is called in a frame steps the world
 * for all. */
void shared_world_step(soft_character *one);

/* Contacts between bodies of its characters and others that have not ended. */
const contact_list *shared_world_contacts(const shared_world *shared);
/* The node with that character; NULL: none. */
soft_character *shared_world_member(const shared_world *shared, sbr_character_id id);
/* Adds a movable body to the exceptions of the parts of its characters. */
void shared_world_except(const shared_world *shared, const gd_variant *body);

/* ---- worker_pool.c ---- */

/* Tasks on Godot's WorkerThreadPool. */
sbr_tasks worker_pool_tasks(void);

#endif
