/* Collision: shapes and colliders of the host, contacts between characters. Queries: sbrun/query.h.
 *
 * A shape is made once and shared. A collider is a shape at a position in a world. The host moves colliders;
 * their velocity acts on bodies in contact. Points of soft bodies and hulls of simulated rigid bodies stay
 * outside of colliders, with Coulomb friction and restitution: docs/collision.md.
 *
 * Rules are those of sbrun.h: setters ignore invalid handles, getters then return zeros; only calls named
 * create allocate. Colliders belong to the host: snapshots do not store their positions. Lengths are world
 * metres. */
#ifndef SBRUN_COLLISION_H
#define SBRUN_COLLISION_H

#include "sbrun/terrain.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Shapes ------------------------------------------------------------------------------------------- */

/* Kinds of shapes, each in its own frame. */
typedef enum sbr_shape_kind {
  SBR_SHAPE_PLANE,   /* all below y = 0 */
  SBR_SHAPE_SPHERE,  /* radius, about the origin */
  SBR_SHAPE_BOX,     /* half_sizes, about the origin */
  SBR_SHAPE_CAPSULE, /* radius, about the straight line from -half_sizes.y to half_sizes.y on the y axis */
  SBR_SHAPE_HULL, /* convex: points and triangles of its surface, in any winding; or points only, whose hull
                     is computed: at most 256 vertices, the outermost, exact to a millionth of its size */
  SBR_SHAPE_MESH, /* triangles, solid behind their faces (counter-clockwise seen from outside) */
  SBR_SHAPE_HEIGHT_FIELD, /* heights, solid below */
  SBR_SHAPE_HOST          /* the host's own geometry, queried by callbacks */
} sbr_shape_kind;

/* Queries of the host's own geometry, in the shape's frame. Both are pure functions, called from worker
 * threads many times a tick. Points of soft bodies and vertices of rigid hulls collide with it. */
typedef struct sbr_host_shape {
  /* Overlap: signed distance in m from `point` to the surface (negative inside), or any number above `reach`
   * if the surface is farther; `normal` receives the unit normal there, outwards. */
  float (*distance)(void *user, sbf_vec3 point, float reach, sbf_vec3 *normal);
  /* Ray: the fraction, 0 to 1, of `displacement` from `from` at which it enters, with the normal there;
   * negative if it hits nothing. NULL: fast points may pass through. */
  float (*cast)(void *user, sbf_vec3 from, sbf_vec3 displacement, sbf_vec3 *normal);
  void *user;         /* passed to both functions */
  sbf_vec3 low, high; /* bounds, m; the functions are not called outside them */
} sbr_host_shape;

/* Definition of a shape; its arrays are copied. */
typedef struct sbr_shape_definition {
  uint32_t cookie;                 /* set by sbr_default_shape_definition */
  sbr_shape_kind kind;             /* default sphere */
  float radius;                    /* m, > 0: sphere, capsule; default 0.5 */
  sbf_vec3 half_sizes;             /* m, > 0: box; y alone, >= 0: capsule; default 0.5 each */
  const sbf_vec3 *points;          /* (point_count) hull, mesh */
  uint32_t point_count;            /* of points */
  const uint32_t *triangles;       /* (triangle_count x 3) hull, mesh */
  uint32_t triangle_count;         /* of triangles; 0: a hull around the points */
  const sbr_height_field *heights; /* height field; its x and z in the shape's frame */
  sbr_host_shape host;             /* of the host's own */
} sbr_shape_definition;

/* A shape; opaque. Any number of colliders may share it, on any threads. */
typedef struct sbr_shape sbr_shape;
SBF_API sbr_shape_definition sbr_default_shape_definition(void);
/* SBF_FAILED if memory runs out, a size is not positive, an index is out of range or a hull has no volume.
 * The shape must outlive its colliders. */
SBF_API sbf_status sbr_shape_create(const sbf_allocator *allocator, const sbr_shape_definition *definition,
    sbr_shape **shape, sbf_diagnostic *error);
SBF_API void sbr_shape_destroy(sbr_shape *shape);

/* ---- Colliders ---------------------------------------------------------------------------------------- */

/* Definition of a collider. */
typedef struct sbr_collider_definition {
  uint32_t cookie;         /* set by sbr_default_collider_definition */
  const sbr_shape *shape;  /* required */
  sbr_double3 position;    /* world, of the shape's origin */
  sbf_quat rotation;       /* from the shape's axes to the world's; default none */
  float friction;          /* Coulomb coefficient; negative (default): the other body's */
  float restitution;       /* [0, 1]; negative (default): the other body's */
  uint32_t layer;          /* layers it is on; default 1 */
  uint32_t mask;           /* layers it collides with; default all */
  float mass;              /* kg, > 0: of a body of the host that contacts move (below); 0 (default):
                              contacts do not move it */
  sbf_vec3 inertia;        /* kg m^2, >= 0, about its principal axes through its centre of mass; 0 (default):
                              contacts        do not rotate it about that axis */
  sbf_quat inertia_axes;   /* from those axes to the shape's; default none */
  sbf_vec3 centre;         /* m, centre of mass in the shape's frame; default its origin */
  sbr_collider_id part_of; /* an earlier collider with a mass: both are parts of one body, and that mass is
                             the mass of all its parts; 0 (default): none */
  void *user_data;         /* the host's */
} sbr_collider_definition;

/* Begin with the default definition. The collider lives until it or the world is destroyed. */
SBF_API sbr_collider_definition sbr_default_collider_definition(void);
/* SBF_FAILED if the world already holds collider_capacity (sbr_world_definition) colliders. */
SBF_API sbf_status sbr_collider_create(sbr_world *world, const sbr_collider_definition *definition,
    sbr_collider_id *collider, sbf_diagnostic *error);
SBF_API void sbr_collider_destroy(sbr_world *world, sbr_collider_id collider);
/* Whether the handle names a collider of the world that has not been destroyed. */
SBF_API bool sbr_collider_is_valid(const sbr_world *world, sbr_collider_id collider);
/* The host's pointer, as in the definition; the runtime does not use it. */
SBF_API void sbr_collider_set_user_data(sbr_world *world, sbr_collider_id collider, void *user_data);
SBF_API void *sbr_collider_get_user_data(const sbr_world *world, sbr_collider_id collider);
/* Moves the collider during the next tick; its velocity acts on bodies in contact. It then stands still until
 * it is moved again. */
SBF_API void sbr_collider_move(
    sbr_world *world, sbr_collider_id collider, sbr_double3 position, sbf_quat rotation);
/* Puts the collider there at once, without velocity. */
SBF_API void sbr_collider_set_transform(
    sbr_world *world, sbr_collider_id collider, sbr_double3 position, sbf_quat rotation);

/* Motion of a host's body at the beginning of the next tick. */
typedef struct sbr_collider_motion {
  sbr_double3 position;      /* world, of the shape's origin */
  sbf_quat rotation;         /* from the shape's axes to the world's */
  sbf_vec3 velocity;         /* m/s, of the shape's origin */
  sbf_vec3 angular_velocity; /* rad/s, world axes */
  sbf_vec3 acceleration;     /* m/s^2, constant, added by the host: gravity */
  float since_s;             /* s simulated by the host since the last call; 0: it was teleported */
} sbr_collider_motion;
/* Sets the motion of a collider with a mass, before each step. The runtime then predicts its motion within
 * the tick from this velocity, the acceleration and the impulses of bodies in contact, so that a light body
 * gives way in the same tick. The host applies the impulses of sbr_collider_take_impulse to its own body and
 * sets the motion again. A change of velocity from elsewhere, such as a supporting floor, is assumed to act
 * in the next tick too. Set the motion of each collider of a compound body. The prediction continues until
 * the motion is set again or the collider is moved or placed. */
SBF_API void sbr_collider_set_motion(
    sbr_world *world, sbr_collider_id collider, const sbr_collider_motion *motion);

/* Sum of the impulses on a collider from soft bodies and hulls of simulated rigid bodies, with friction. */
typedef struct sbr_collider_impulse {
  sbf_vec3 impulse; /* N s, world axes */
  sbf_vec3 moment; /* N m s, about the collider's position at the end of the last tick; if its motion was set,
                      at the beginning of the tick, where the host's body still is */
} sbr_collider_impulse;
/* Returns the impulse since the last call and clears it. The host applies it to its own body before it moves
 * the body; momentum is then conserved. A collider without mass is immovable for characters. A body in
 * contact with more than twelve colliders pushes the first twelve. Output, as events are: snapshots do not
 * store it. */
SBF_API sbr_collider_impulse sbr_collider_take_impulse(sbr_world *world, sbr_collider_id collider);

/* ---- Each other --------------------------------------------------------------------------------------- */

/* Enables contacts between bodies of characters: soft bodies and hulls of rigid bodies, of the same and of
 * different characters, by the layers and masks of the file. Vertices collide with faces; edges collide with
 * edges on coarse closed bodies and sheets (docs/collision.md). At most `max_contacts` contacts at once (0:
 * 4096); beyond that some bodies pass through each other. Bodies of one character that overlap at rest, are
 * joined or pinned to each other do not collide. Characters that may touch are stepped in one task; islands
 * without a contact take their own steps. Impulses are stored from tick to tick; snapshots include space for
 * `max_contacts` contacts. Call it before the first step; a second call does nothing. SBF_FAILED if memory
 * runs out. */
SBF_API sbf_status sbr_world_enable_body_contacts(
    sbr_world *world, uint32_t max_contacts, sbf_diagnostic *error);

#ifdef __cplusplus
}
#endif
#endif
