/* Things that characters meet: shapes of the host's own, and what it can ask about them and about bodies.
 *
 * A shape is a form, made once and shared; a collider is a shape at a place in a world. What a collider does
 * from tick to tick is the host's: it stands, or is moved, and what it touches feels its velocity. Points of
 * soft bodies and hulls of simulated rigid bodies stay outside of it, slide on it by Coulomb's law and bounce
 * off it; docs/collision.md has how, and what was measured.
 *
 * The same rules as in sbrun.h: handles that name nothing are ignored, getters then return zeros; nothing
 * allocates but what is named create. Colliders are the host's, as the ground is: snapshots do not hold where
 * they are. Lengths are world metres. */
#ifndef SBRUN_COLLISION_H
#define SBRUN_COLLISION_H

#include "sbrun/terrain.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Shapes ------------------------------------------------------------------------------------------- */

/* What a shape is; each in its own frame. */
typedef enum sbr_shape_kind {
  SBR_SHAPE_PLANE,   /* all below y = 0 */
  SBR_SHAPE_SPHERE,  /* radius, about the origin */
  SBR_SHAPE_BOX,     /* half_sizes, about the origin */
  SBR_SHAPE_CAPSULE, /* radius, about the straight line from -half_sizes.y to half_sizes.y on the y axis */
  SBR_SHAPE_HULL,    /* convex: points and triangles of its surface, in any winding; or points alone, which it
                        lies around: of more than 256 vertices those that stand out the furthest, placed to a
                        millionth of its size */
  SBR_SHAPE_MESH,    /* triangles, solid behind their faces (counter-clockwise seen from outside) */
  SBR_SHAPE_HEIGHT_FIELD, /* heights, solid below */
  SBR_SHAPE_HOST          /* what the host's own physics holds, asked by calls */
} sbr_shape_kind;

/* What a host answers about its own world, in the shape's frame. Both are pure functions, called from worker
 * threads, many times a tick. Points of soft bodies meet it; hulls of rigid bodies meet it by their
 * vertices. */
typedef struct sbr_host_shape {
  /* Overlap: signed distance in m from `place` to the surface (negative inside), or any number above `reach`
   * where nothing is so near; `normal` receives the unit normal there, outwards. */
  float (*distance)(void *user, sbf_vec3 place, float reach, sbf_vec3 *normal);
  /* Ray: the share, 0 to 1, of `way` from `from` at which it enters, with the normal there; negative where it
   * enters nothing. NULL: fast things may pass through. */
  float (*cast)(void *user, sbf_vec3 from, sbf_vec3 way, sbf_vec3 *normal);
  void *user;         /* handed to both */
  sbf_vec3 low, high; /* m: bounds outside of which neither is asked */
} sbr_host_shape;

/* What a shape is made from; copied. */
typedef struct sbr_shape_definition {
  uint32_t cookie;                 /* set by sbr_default_shape_definition */
  sbr_shape_kind kind;             /* its form; default sphere */
  float radius;                    /* m, > 0: sphere, capsule; default 0.5 */
  sbf_vec3 half_sizes;             /* m, > 0: box; y alone, >= 0: capsule; default 0.5 each */
  const sbf_vec3 *points;          /* (point_count) hull, mesh */
  uint32_t point_count;            /* of points */
  const uint32_t *triangles;       /* (triangle_count x 3) hull, mesh */
  uint32_t triangle_count;         /* of triangles; 0: a hull around the points */
  const sbr_height_field *heights; /* height field; its x and z in the shape's frame */
  sbr_host_shape host;             /* of the host's own */
} sbr_shape_definition;

/* Form of a collider; opaque. Any number of colliders share one, on any threads. */
typedef struct sbr_shape sbr_shape;
SBF_API sbr_shape_definition sbr_default_shape_definition(void);
/* SBF_FAILED where memory runs out, a size is not positive, an index is beyond the points or a hull encloses
 * nothing, as around points in a plane. The shape must outlive its colliders. */
SBF_API sbf_status sbr_shape_create(const sbf_allocator *allocator, const sbr_shape_definition *definition,
    sbr_shape **shape, sbf_diagnostic *error);
SBF_API void sbr_shape_destroy(sbr_shape *shape);

/* ---- Colliders ---------------------------------------------------------------------------------------- */

/* Where a collider begins, and how it meets things. */
typedef struct sbr_collider_definition {
  uint32_t cookie;        /* set by sbr_default_collider_definition */
  const sbr_shape *shape; /* its form */
  sbr_double3 position;   /* world, of the shape's origin */
  sbf_quat rotation;      /* from the shape's axes to the world's; default none */
  float friction;         /* Coulomb coefficient; negative (default): that of what touches it */
  float restitution;      /* [0, 1]; negative (default): likewise */
  uint32_t layer;         /* bits it is; default 1 */
  uint32_t mask;          /* bits it meets; default all */
  float mass;             /* kg, > 0: of a body of the host's own, which what touches it moves (below); 0
                             (default): nothing moves it */
  sbf_vec3 inertia; /* kg m^2, >= 0, about its principal axes through its centre of mass; 0 (default): about
                       that axis nothing turns it */
  sbf_quat inertia_axes;   /* from those axes to the shape's; default none */
  sbf_vec3 centre;         /* m, of its mass, in the shape's frame; default its origin */
  sbr_collider_id part_of; /* of one body with that collider, made before and with a mass, which is that of
                             all its parts; 0 (default): of none */
} sbr_collider_definition;

/* A collider from a definition that begins as the default, until it is destroyed or the world is. */
SBF_API sbr_collider_definition sbr_default_collider_definition(void);
/* SBF_FAILED where the world holds its collider_capacity (sbr_world_definition) already. */
SBF_API sbf_status sbr_collider_create(sbr_world *world, const sbr_collider_definition *definition,
    sbr_collider_id *collider, sbf_diagnostic *error);
SBF_API void sbr_collider_destroy(sbr_world *world, sbr_collider_id collider);
/* Where it shall be at the end of the next tick: what it touches on the way feels that velocity. It stands
 * still after that until it is moved again. */
SBF_API void sbr_collider_move(
    sbr_world *world, sbr_collider_id collider, sbr_double3 position, sbf_quat rotation);
/* Puts it there at once, without velocity. */
SBF_API void sbr_collider_place(
    sbr_world *world, sbr_collider_id collider, sbr_double3 position, sbf_quat rotation);

/* How a body of the host goes as the next tick begins. */
typedef struct sbr_collider_motion {
  sbr_double3 position;  /* world, of the shape's origin */
  sbf_quat rotation;     /* from the shape's axes to the world's */
  sbf_vec3 velocity;     /* m/s, of the shape's origin */
  sbf_vec3 spin;         /* rad/s, world axes */
  sbf_vec3 acceleration; /* m/s^2, of all that the host itself will add evenly: weight */
  float since_s;         /* s that the host has moved it for since it was last told; 0: it was put there */
} sbr_collider_motion;
/* Of a collider with a mass, before each step: from there it goes by itself, by that velocity, the
 * acceleration and what soft bodies and hulls that touch it push it with, so that a light one gives way at
 * once, not a tick later. That motion is the runtime's guess within its ticks: the host moves its body by
 * sbr_collider_take_push, and tells anew. What its velocity shows to have come from elsewhere since it was
 * last told, as from a floor that bears it, holds it along that direction in the next tick, and keeps it from
 * being turned. Of a body of several colliders each is told. Until it is told of again, or moved or placed,
 * it goes on. */
SBF_API void sbr_collider_set_motion(
    sbr_world *world, sbr_collider_id collider, const sbr_collider_motion *motion);

/* What a collider was pushed with: what soft bodies and hulls of simulated rigid bodies that touched it were
 * pushed with themselves, friction included, the other way. */
typedef struct sbr_collider_push {
  sbf_vec3 impulse; /* N s, world axes */
  sbf_vec3 moment; /* N m s, about where the collider's position was at the end of the last tick; of one whose
                      motion was told, at its beginning, where the host's body still is */
} sbr_collider_push;
/* All since it was last asked, or made. A host whose own body it is gives this to the body, before it moves
 * that: what the two have of momentum is then kept. Without a mass characters meet a collider as something
 * that nothing can move. A body that touches more than twelve
 * things at once pushes the first twelve. Output, as events are: snapshots do not hold it. */
SBF_API sbr_collider_push sbr_collider_take_push(sbr_world *world, sbr_collider_id collider);

/* ---- Each other --------------------------------------------------------------------------------------- */

/* From now on bodies of characters meet each other as well: soft ones, and hulls of rigid ones, of one
 * character and of several, by the layers and masks of the file; corners meet faces, and edges edges, which
 * only coarse closed bodies and sheets need (docs/collision.md). Up to `touch_capacity` places at once (0:
 * 4096); of more, some pass through each other. Parts of one character that lie in each other at rest, that
 * are jointed, or hold each other, do not. Who may touch is stepped in one task. What touches have pushed
 * with is kept from tick to tick: snapshots take room for `touch_capacity` of them. Call it for a world
 * before it is stepped; a second call changes nothing. SBF_FAILED where memory runs out. */
SBF_API sbf_status sbr_world_bodies_meet(sbr_world *world, uint32_t touch_capacity, sbf_diagnostic *error);

/* ---- Questions ---------------------------------------------------------------------------------------- */

/* What a ray or a box finds: one of a collider, a rigid body and a soft body. */
typedef struct sbr_hit {
  sbr_collider_id collider;   /* 0: it is a body of a character */
  sbr_character_id character; /* whose; 0: it is a collider */
  int32_t rigid_body;         /* -1: it is not one */
  int32_t soft_body;          /* likewise */
  sbr_double3 position;       /* of a ray: where it enters */
  sbf_vec3 normal;            /* of a ray: there, unit, outwards */
  double distance;            /* of a ray, m */
} sbr_hit;

/* The first thing on the way from `from`, along `direction` (of any length), up to `length` metres, of those
 * whose layer `mask` has a bit of: colliders, hulls of rigid bodies, surfaces of soft bodies as of the last
 * tick. The ground is not asked. False where there is none. */
SBF_API bool sbr_world_ray(
    const sbr_world *world, sbr_double3 from, sbf_vec3 direction, double length, uint32_t mask, sbr_hit *hit);
/* All whose bounds meet the box, likewise; returns how many there are, of which up to `capacity` are
 * written. */
SBF_API uint32_t sbr_world_overlap(const sbr_world *world, sbr_double3 low, sbr_double3 high, uint32_t mask,
    sbr_hit *hits, uint32_t capacity);

#ifdef __cplusplus
}
#endif
#endif
