/* Queries of a world: rays, shapes that are cast, and overlaps.
 *
 * They find the world's ground, colliders, hulls of rigid bodies and surfaces of soft bodies, in the state
 * after the last tick. The ground is solid below; it is on layer 1 and collides with all layers. Where it is
 * not flat it is sampled every 5 cm or, under a large shape, every 32nd of its size, and linear in between.
 * A mesh or a height field is solid behind its faces. Lengths are world metres. No call allocates or changes
 * the world. */
#ifndef SBRUN_QUERY_H
#define SBRUN_QUERY_H

#include "sbrun/collision.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What a query considers. */
typedef struct sbr_query_filter {
  uint32_t cookie; /* set by sbr_default_query_filter */
  uint32_t layer;  /* layers of the query, which an object's mask must include one of; default all */
  uint32_t mask;   /* layers of objects that it finds; default all */
  /* Whether to consider an object; called once for each candidate. NULL (default): all. */
  bool (*accept)(void *user, const sbr_object *object);
  void *user; /* the host's, handed to `accept` */
} sbr_query_filter;
/* The filter that considers everything, as NULL does in the calls below. Another cookie finds nothing. */
SBF_API sbr_query_filter sbr_default_query_filter(void);

/* What a ray or a cast shape hits first. */
typedef struct sbr_hit {
  sbr_object object;    /* a body of a character, a collider, or the ground if all of it is empty */
  sbr_double3 position; /* world: the point of contact */
  sbf_vec3 normal;      /* unit, outwards from the object there */
  double distance;      /* m travelled until then */
} sbr_hit;

/* Casts a ray from `from` along `direction` (any length), up to `length` metres. A ray that begins inside a
 * solid does not hit it. False if nothing is hit. */
SBF_API bool sbr_world_cast_ray(const sbr_world *world, sbr_double3 from, sbf_vec3 direction, double length,
    const sbr_query_filter *filter, sbr_hit *hit);

/* Casts a sphere, capsule, box or hull from `from` along `direction` (any length), up to `length` metres,
 * without rotation. `rotation`: from the shape's axes to the world's. An object that it overlaps at the
 * beginning is hit at distance 0, with a normal against `direction`. Exact to 0.01 mm, or a millionth of the
 * length. False if nothing is hit, or for other kinds of shapes. */
SBF_API bool sbr_world_cast_shape(const sbr_world *world, const sbr_shape *shape, sbr_double3 from,
    sbf_quat rotation, sbf_vec3 direction, double length, const sbr_query_filter *filter, sbr_hit *hit);

/* Receives an object that overlaps. False ends the query. */
typedef bool sbr_overlap_callback(void *user, const sbr_object *object);

/* Reports every object whose bounds overlap the box; `report` may be NULL. Returns the number of reports. */
SBF_API uint32_t sbr_world_overlap_aabb(const sbr_world *world, sbr_double3 low, sbr_double3 high,
    const sbr_query_filter *filter, sbr_overlap_callback *report, void *user);

/* Reports every object that overlaps a sphere, capsule, box or hull; `report` may be NULL. Of a soft body its
 * surface counts, not its inside. Returns the number of reports; 0 for other kinds of shapes. */
SBF_API uint32_t sbr_world_overlap_shape(const sbr_world *world, const sbr_shape *shape, sbr_double3 position,
    sbf_quat rotation, const sbr_query_filter *filter, sbr_overlap_callback *report, void *user);

#ifdef __cplusplus
}
#endif
#endif
