/* Contact between the bodies of characters: soft with soft, soft with rigid, rigid with rigid, within one
 * character or between several.
 *
 * At the begin of a tick the broad phase (broad_phase.c) finds pairs of bodies whose swept bounds overlap.
 * Characters with such pairs form a group, which one task steps (world/group_run.c). The narrow phase
 * (narrow_phase.c) finds the contacts of each pair. Islands with a contact and rigid parts take the same
 * number of steps, that of the one that needs most; other islands take their own. Before each step the solver
 * (contact_step.c) applies equal and opposite impulses at the contacts, so momentum is conserved to rounding.
 *
 * Lengths and speeds are in world units; positions are relative to the group's origin. */
#ifndef SBRI_BODY_CONTACTS_H
#define SBRI_BODY_CONTACTS_H

#include "coupling/ragdoll/ragdoll.h"
#include "math/four.h"

/* ---- Bodies that can collide ---- */

/* Contact surface of a soft body, or of a rigid body's hull. */
typedef struct sbri_contact_surface {
  sbri_sample *samples; /* (vertex_count) points that carry each vertex; mass 0: vertex unused */
  uint32_t *triangles;  /* (triangle_count x 3) vertex indices */
  uint32_t vertex_count, triangle_count;
  bool two_sided;                 /* sheet or open surface */
  bool closed;                    /* every edge has two triangles: the surface has an interior */
  float mean_edge_m, thickness_m; /* closed surfaces at rest: mean edge length; thickness of a rod of equal
                                     volume and area, m */
  float longest_ridge_m,
      sharpness; /* closed surfaces at rest: longest ridge, m; largest sharpness (surface_edges.c) */
  uint32_t *opposite_vertices; /* (triangle_count x 3) vertex across each edge (shapes/sides.h) */
  /* (triangle_count) A bit per edge. Two-sided surface: boundary edges and folds, renewed each tick. Closed
   * surface: convex ridges at rest. */
  uint8_t *edge_flags;
  /* Renewed in each tick in which another body is near: */
  bool is_current;                     /* scratch of the narrow phase */
  sbf_vec3 *positions, *displacements; /* (vertex_count) */
  float max_displacement_m;            /* displacement of the fastest point in the tick, m */
  uint32_t *inside_parents;            /* (vertex_count) scratch of overlap_clusters.c */
  sbri_box *boxes;                     /* (triangle_count) swept bounds with margin */
  sbri_bounds_tree tree;
} sbri_contact_surface;

/* A body that can collide. */
typedef struct sbri_contact_body {
  uint32_t character, body_index; /* index of the soft or the rigid body */
  bool rigid, is_dynamic;
  bool self_contact; /* also collides with itself */
  uint32_t layer, mask;
} sbri_contact_body;

/* Indices of two bodies, a < b; a == b: self-contact. */
typedef struct sbri_contact_pair {
  uint32_t a, b;
} sbri_contact_pair;

/* A character of a group during its steps. */
typedef struct sbri_group_member {
  sbri_character *character;
  sbf_vec3 offset;             /* from the group's origin to the character's */
  float scale, velocity_scale; /* world units per character unit of length and of velocity */
  float mass;                  /* kg per unit of the character's mass */
  float tick_s;                /* tick length in the character's time, s */
  float tick_fraction;         /* elapsed part of the tick, 0..1 */
  float pinned_rate; /* 1/s, character time: velocity of a pinned point per displacement from `begins` to
                        `targets` */
  float last_step_s; /* step length of its rigid bodies before this tick */
  sbri_rigid_parts parts;
  uint32_t first_solver_body; /* index in the group of its first rigid body, */
  uint32_t first_external;    /* and of its first external body */
} sbri_group_member;

/* ---- Contacts ---- */

/* Solver bodies per rigid body: itself and the external (host) bodies that it can push. */
enum { SBRI_SOLVER_BODIES_PER_BODY = 3 };

enum { SBRI_CONTACT_SLOTS = 12, SBRI_CONTACT_SOFT = -1, SBRI_CONTACT_PLANE = -2 };

/* A point of a body: on a rigid body, or a weighted mean of up to twelve points of a soft body. */
typedef struct sbri_contact_side {
  uint32_t member;
  int32_t rigid_body; /* index, SBRI_CONTACT_SOFT, or SBRI_CONTACT_PLANE (ground or host collider) */
  uint32_t island, count;
  uint32_t slots[SBRI_CONTACT_SLOTS];
  float weights[SBRI_CONTACT_SLOTS];
  sbf_vec3 point; /* rigid body: in its frame, m. Plane: a point on it at the tick's begin. External body:
                     from its centre of mass */
  sbf_vec3 plane_velocity; /* m/s */
  uint32_t external;       /* 1 + index of the external body that moves the plane; 0: none */
} sbri_contact_side;

/* Sticking of a contact since it began. */
typedef struct sbri_contact_sticking {
  sbf_vec3 slip;       /* tangential slip of a against b, m */
  sbf_vec3 separation; /* offset of a from b when sticking began, m */
} sbri_contact_sticking;

/* Sums over a tick, for events. */
typedef struct sbri_contact_tick_sums {
  float impulse;           /* N s along the normal */
  float max_closing_speed; /* m/s */
  sbf_vec3 position;       /* of the last impulse */
} sbri_contact_tick_sums;

typedef struct sbri_contact {
  sbri_contact_side a, b;
  uint64_t body_ids[2]; /* sbri_contact_body_id of both; the feature tells contacts of a pair apart */
  uint32_t feature;
  sbf_vec3 normal; /* unit, from b to a */
  float margin;    /* separation to keep, m */
  float friction, restitution;
  /* Kept from step to step: */
  sbri_contact_sticking sticking;
  float soft_size_m;         /* size of the smaller soft body, m; 0: both are rigid */
  float external_bias;       /* normal velocity that springs and joints add in a step, m/s */
  float solved_speed;        /* normal velocity after the last solve, m/s */
  bool has_solved_speed;     /* `solved_speed` is set and not yet compared */
  float normal_impulse;      /* N s */
  sbf_vec3 friction_impulse; /* N s */
  bool is_loaded;
  bool is_deep;       /* deeper than resting contact allows */
  bool exits_nearest; /* deeper than the search for faces: leaves without friction by the nearest exit
                         (nearest_exit.c) */
  bool exits_common;  /* leaves by the common exit of its cluster (common_exit.c) */
  bool is_new;        /* not in the cache of the previous tick */
  sbri_contact_tick_sums tick;
} sbri_contact;

/* A loaded contact of the previous tick: start values for the solver. State, part of snapshots and of the
 * state hash. */
typedef struct sbri_cached_contact {
  uint64_t body_ids[2];
  uint32_t feature;
  sbf_vec3 local_point;        /* in the frame of a, if a is rigid */
  float normal_force;          /* N */
  sbf_vec3 friction_force;     /* N */
  sbf_vec3 tangent_slip;       /* m */
  float external_acceleration; /* m/s^2, along the normal */
  sbf_vec3 common_exit;        /* unit direction; 0: the contact is not in a cluster with a common exit */
  uint32_t next;               /* index of the next cached contact of the same bodies; UINT32_MAX: none */
} sbri_cached_contact;

/* Two bodies in contact, for events. */
typedef struct sbri_pair_report {
  uint64_t body_ids[2]; /* ascending */
  sbr_double3 position; /* world position of the contact with the largest impulse */
  sbf_vec3 normal;      /* of that contact, away from the second body */
  float impulse, speed; /* sum over the contacts, N s; largest closing speed, m/s; of this tick */
} sbri_pair_report;

/* A dynamic rigid body, or an external body, during a solve. */
typedef struct sbri_solver_body {
  uint32_t member, body, external;       /* external: as in a side; 0: a body of the character */
  sbf_vec3 position, position_remainder; /* m; remainder beyond float precision */
  float rotation[3][3];                  /* body axes to world axes */
  sbri_four velocity, angular_velocity;  /* m/s, rad/s */
  float inverse_mass;                    /* 1/kg */
  float inverse_inertia[3][3];           /* 1/(kg m^2), world axes */
  sbf_vec3 impulse, angular_impulse;     /* accumulated, N s and N m s */
  double response[6];                    /* active_contacts.c: change of velocity and angular velocity */
} sbri_solver_body;

/* A side of a contact during a solve: a solver body, or weighted points. */
typedef struct sbri_constraint_side {
  sbri_solver_body *body;        /* NULL: points of a soft body, or a prescribed motion */
  sbf_vec3 lever_arm;            /* from the centre of mass to the contact, m */
  sbf_vec3 prepared_arm;         /* lever arm that `inverse_mass` of the constraint was computed for */
  sbri_four angular_response[3]; /* change of angular velocity per impulse along x, y and z, 1/(kg m) */
  sbf_vec3 prescribed_velocity;  /* velocity of pinned points, kinematic bodies and planes, m/s */
  uint32_t count;
  float velocity_scale;                  /* world units per unit of the points' velocities */
  float *velocities[SBRI_CONTACT_SLOTS]; /* x components; y and z follow at distances of SBRI_BLOCK */
  float weights[SBRI_CONTACT_SLOTS],
      point_responses[SBRI_CONTACT_SLOTS]; /* weight x inverse mass, in units of the points */
} sbri_constraint_side;

/* A contact of rigid bodies in active_contacts.c. */
typedef struct sbri_active_contact {
  bool is_pressing, is_sticking;
  double residual[3];             /* velocity still missing, m/s */
  double direction[3], change[3]; /* of the current step: impulse, N s; its change of the velocity, m/s */
  double step[3];                 /* change of the impulse that all steps ask for, N s */
} sbri_active_contact;

/* Values of a contact in the lanes of the iterations. */
typedef struct sbri_wide_constraint {
  sbri_four impulse, initial_impulse;        /* normal + friction impulse, N s; its start value */
  sbri_four normal, target;                  /* normal; target velocity without the prescribed part */
  sbri_four mass_columns[3];                 /* columns of `effective_mass` */
  sbri_four lever_arms[2], permuted_arms[2]; /* of both bodies; `permuted`: yzx order */
  sbri_solver_body *bodies[2];               /* a fixed body where a side has none */
} sbri_wide_constraint;

/* A contact during a solve. */
typedef struct sbri_contact_constraint {
  sbri_contact *contact;
  sbf_vec3 normal, target_velocity; /* target of the relative velocity, m/s */
  float friction, normal_mass;      /* effective mass along the normal, kg */
  float inverse_mass[6];            /* symmetric 3x3 matrix of both sides, xx yy zz xy xz yz, 1/kg */
  float effective_mass[6];
  float normal_impulse;
  sbf_vec3 friction_impulse;
  float separation;
  sbf_vec3 offset;            /* from b to a, m */
  sbf_vec3 position;          /* where the impulse acts */
  float initial_normal_speed; /* before the solve, m/s */
  bool is_active;             /* takes part in the solve */
  sbri_constraint_side a, b;
  /* Only during the solve: */
  sbri_wide_constraint wide;
  float inverse_mass_squared; /* square of the inverse normal mass, 1/kg^2 */
  float compliance;           /* 1/kg */
  sbri_active_contact active;
  sbri_four search_direction, change; /* conjugate direction and last change of the impulse, N s */
} sbri_contact_constraint;

typedef struct sbri_contact_group {
  uint32_t first_member, member_count; /* range in `members` */
  uint32_t first_pair, pair_count;
  uint32_t first_contact, contact_count, contact_capacity;
  uint32_t first_solver_body, solver_body_count;
  float step_s; /* step length in this tick, s */
  sbr_double3 origin;
} sbri_contact_group;

/* How two bodies of a character lie at rest: apart, as touching sections of one skin, or touching. */
typedef enum sbri_rest_relation {
  SBRI_REST_SEPARATE,
  SBRI_REST_ADJACENT,
  SBRI_REST_TOUCHING
} sbri_rest_relation;

/* Contact surfaces of each character, (character_capacity) each. */
typedef struct sbri_contact_shapes {
  sbri_contact_surface **surfaces;       /* of soft bodies at the current detail level; NULL: none */
  sbri_contact_surface **level_surfaces; /* of soft bodies at all soft levels, level after level */
  sbri_contact_surface **hulls;          /* of rigid bodies */
  uint8_t **rest_relations; /* sbri_rest_relation of each two soft bodies, then of each soft and rigid body */
} sbri_contact_shapes;

/* Bodies of all characters that can collide in this tick. */
typedef struct sbri_broad_phase {
  sbri_contact_body *bodies; /* (body_capacity) */
  sbri_box *boxes;           /* (body_capacity) swept bounds */
  sbri_bounds_tree tree;
  uint32_t body_count, body_capacity;
} sbri_broad_phase;

/* Loaded contacts of the previous tick and of this one; state. */
typedef struct sbri_contact_cache {
  sbri_cached_contact *at, *next; /* (contact_capacity) of the previous tick; of this tick */
  uint32_t count;
  uint32_t *table; /* (table_capacity, a power of two) hash table by body ids: first cached contact, or
                      UINT32_MAX */
  uint32_t table_capacity;
} sbri_contact_cache;

/* Pairs of bodies in contact, for events; output, not state. */
typedef struct sbri_pair_reports {
  sbri_pair_report *at, *next; /* (contact_capacity) of the previous tick; of this tick; sorted by body ids */
  uint32_t count;
} sbri_pair_reports;

typedef struct sbri_body_contacts {
  sbfi_arena *arenas; /* (character_capacity) */
  sbri_contact_shapes shapes;
  uint32_t *group_of;         /* (character_capacity) UINT32_MAX: in no group */
  uint32_t *member_of;        /* (character_capacity) index in its group */
  uint32_t *next_of_group;    /* (character_capacity) linked list while groups are built; UINT32_MAX: last */
  sbri_group_member *members; /* (character_capacity) group after group */
  sbri_contact_group *groups; /* (character_capacity) */
  uint32_t group_count;
  sbri_broad_phase broad_phase;
  sbri_contact_pair *pairs, *found_pairs; /* (contact_capacity) sorted by group; as found */
  uint32_t pair_count;
  sbri_contact *contacts;               /* (contact_capacity) */
  sbri_contact_constraint *constraints; /* (contact_capacity) */
  sbri_contact_cache cache;
  sbri_pair_reports pair_reports;
  sbri_solver_body *solver_bodies; /* (body_capacity x SBRI_SOLVER_BODIES_PER_BODY) sorted by group */
  uint32_t contact_capacity, character_capacity;
} sbri_body_contacts;

/* ---- coupling/body_contact/contact_surfaces.c ---- */

/* Allocates room for the bodies of one more character. False: out of memory. */
bool sbri_body_contacts_reserve(sbr_world *world, const sbr_model *model);
/* Creates the contact surfaces of a new character. False: out of memory. */
bool sbri_contact_surfaces_create(sbr_world *world, uint32_t character);
void sbri_contact_surfaces_free(sbr_world *world, uint32_t character);
/* Selects the surfaces of the character's current detail level. */
void sbri_contact_surfaces_select_level(sbr_world *world, uint32_t character);
void sbri_body_contacts_free(sbr_world *world);
/* Updates vertex positions, displacements in the tick, and the bounds tree of a soft body's surface. */
void sbri_contact_surface_update(sbr_world *world, const sbri_group_member *member, uint32_t soft_body);

/* ---- coupling/body_contact/surface_storage.c ---- */

/* Rest position of a sample, in model units. */
sbf_vec3 sbri_sample_rest_position(const sbr_model *model, uint32_t soft_body, const sbri_sample *sample);

/* Allocates the arrays that a tick renews. False: out of memory. */
bool sbri_contact_surface_allocate(
    sbri_contact_surface *surface, uint32_t vertices, uint32_t triangles, sbfi_arena *arena);
bool sbri_contact_surface_allocate_tree(sbri_contact_surface *surface, uint32_t triangles, sbfi_arena *arena);
/* Builds the bounds tree at the rest positions. Its structure stays, so that it does not depend on what has
 * happened in a world. */
void sbri_contact_surface_build_tree(sbri_contact_surface *surface);
/* Fits the tree to the swept triangles, each grown by `reach`, m. */
void sbri_contact_surface_refit_tree(sbri_contact_surface *surface, float reach);
/* Measures mean edge length and thickness at the current positions. */
void sbri_contact_surface_measure(sbri_contact_surface *surface);

/* ---- coupling/body_contact/hull_surfaces.c ---- */

bool sbri_contact_hulls_create(const sbr_model *model, sbri_contact_surface *hulls, sbfi_arena *arena);
/* Updates vertex positions, displacements from `at` to `end`, and the bounds tree. `scale`: of the
 * character. */
void sbri_contact_hull_update(const sbri_rigid_body *body, const sbr_transform *at, const sbr_transform *end,
    float scale, sbri_contact_surface *hull);

/* ---- coupling/body_contact/nearest_exit.c ---- */

/* Whether every directed edge has an opposite one. */
bool sbri_contact_surface_is_closed(const sbri_contact_surface *surface);

/* ---- coupling/body_contact/surface_edges.c ---- */

/* Finds the edges and, of a closed surface at its rest positions, the ridges. Uses the tree's memory as
 * scratch. False: out of memory. */
bool sbri_surface_edges_create(sbri_contact_surface *surface, sbfi_arena *arena);
/* Updates the edge flags of a two-sided surface at its current positions. */
void sbri_surface_edges_update(sbri_contact_surface *surface);

/* ---- coupling/body_contact/rest_overlaps.c ---- */

/* Fills in the rest relations (zero before). Overwrites the positions of surfaces and hulls. */
void sbri_rest_overlaps_find(
    const sbr_model *model, sbri_contact_surface *surfaces, sbri_contact_surface *hulls, uint8_t *relations);

/* ---- coupling/body_contact/broad_phase.c ---- */

/* Finds the pairs of bodies that may collide in this tick, and the groups. */
void sbri_broad_phase_update(sbr_world *world);
bool sbri_character_is_awake(const sbri_character *c);

/* ---- coupling/body_contact/near_characters.c ---- */

/* Sets `near` of each character with detail levels: whether another character is so near that its bodies must
 * be able to collide. */
void sbri_near_characters_find(sbr_world *world);

/* ---- coupling/body_contact/narrow_phase.c ---- */

/* Finds the contacts of a group for this tick, up to its capacity, and marks the islands that they push. */
void sbri_narrow_phase_update(sbr_world *world, sbri_contact_group *group);

/* ---- coupling/body_contact/warm_start.c ---- */

static inline uint64_t sbri_contact_body_id(const sbri_contact_body *body) {
  return (uint64_t)body->character << 32 | (uint64_t)body->rigid << 31 | body->body_index;
}
/* Ids of host colliders precede it. */
#define SBRI_GROUND_CONTACT_ID UINT64_MAX
/* Index of the host collider; UINT32_MAX: the ground. */
static inline uint32_t sbri_contact_collider_index(uint64_t body_id) {
  return (uint32_t)(SBRI_GROUND_CONTACT_ID - body_id) - 1;
}

/* Cached contacts of two bodies, in this order of ids. NULL: no more. */
const sbri_cached_contact *sbri_first_cached_contact(
    const sbri_body_contacts *all, const uint64_t body_ids[2]);
const sbri_cached_contact *sbri_next_cached_contact(
    const sbri_body_contacts *all, const sbri_cached_contact *cached);
/* Sets the start values of the group's contacts from the cache. */
void sbri_contacts_load_cached(const sbri_body_contacts *all, const sbri_contact_group *group, float step_s);
/* Rescales impulses of the previous step to steps of `step_s`. */
void sbri_contacts_scale_impulses(const sbri_body_contacts *all, sbri_contact_group *group, float step_s);
/* Stores the loaded contacts in the cache, after all groups have stepped. */
void sbri_contacts_store(sbr_world *world);
/* Snapshot of the cache; the size depends on the capacity only. */
size_t sbri_contact_cache_size(const sbr_world *world);
void sbri_contact_cache_save(const sbr_world *world, unsigned char *to);
void sbri_contact_cache_restore(sbr_world *world, const unsigned char *from);

/* ---- coupling/body_contact/solver_bodies.c ---- */

/* Number of the member's external bodies that are solver bodies. */
static inline uint32_t sbri_count_member_externals(const sbri_group_member *member) {
  uint32_t max_count = (SBRI_SOLVER_BODIES_PER_BODY - 1) * member->character->model->rigid.body_count;
  if (!member->parts.steps) return 0;
  return member->parts.work.external_list.count < max_count ? member->parts.work.external_list.count
                                                            : max_count;
}

/* Lists the solver bodies of a group at the begin of a tick. */
void sbri_solver_bodies_list(const sbri_body_contacts *all, sbri_contact_group *group);
/* Reads positions and velocities of the group's solver bodies. */
void sbri_solver_bodies_read(const sbri_body_contacts *all, const sbri_contact_group *group);
/* Acceleration of an external body in the step beside contact impulses, as contacts see it, m/s^2. */
sbf_vec3 sbri_external_body_acceleration(
    const sbri_contact_group *group, const sbri_group_member *member, uint32_t external);
/* Applies the accumulated impulses to the bodies. */
void sbri_solver_bodies_write(const sbri_body_contacts *all, const sbri_contact_group *group);
/* Updates sides and separation of a constraint; recomputes its masses if `is_new` or if a lever arm has
 * changed. */
void sbri_contact_constraint_prepare(const sbri_body_contacts *all, const sbri_contact_group *group,
    sbri_contact_constraint *constraint, bool is_new);

/* ---- coupling/body_contact/contact_step.c ---- */

/* Solves the contacts of a group before a step; `first`: of the tick. */
void sbri_contacts_solve(const sbr_world *world, const sbri_contact_group *group, bool first);
/* Updates slip and bias of the contacts after the tick's last step. */
void sbri_contacts_finish_tick(const sbri_body_contacts *all, const sbri_contact_group *group);

/* ---- coupling/body_contact/pair_reports.c ---- */

/* Reports events of pairs that begin or cease to touch, after all groups have stepped. */
void sbri_pair_reports_publish(sbr_world *world);
/* Removes the pairs of a destroyed character. */
void sbri_pair_reports_remove(sbr_world *world, uint32_t character);

#endif
