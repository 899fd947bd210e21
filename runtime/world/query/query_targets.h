/* Targets of queries in a world as convex pieces: hulls, spheres, capsules, and triangles of surfaces. */
#ifndef SBRI_QUERY_TARGETS_H
#define SBRI_QUERY_TARGETS_H

#include "sbrun/query.h"
#include "shapes/convex.h"
#include "skin/skin.h"
#include "state/world.h"

static const sbr_object sbri_no_object = {.soft_body = -1, .rigid_body = -1};

/* Sets `*filter` to the default if `given` is NULL. Returns false for a wrong cookie. */
bool sbri_query_filter_of(const sbr_query_filter *given, sbr_query_filter *filter);
/* Whether a query considers an object on these layers. */
bool sbri_query_accepts(
    const sbr_query_filter *filter, uint32_t layer, uint32_t mask, const sbr_object *object);

sbr_transform sbri_query_rigid_pose(const sbri_character *c, uint32_t rigid_body);
/* Vertices of a soft body's surface after the last tick, asset metres; computed in its scratch memory. */
const sbri_point *sbri_query_surface(const sbri_character *c, uint32_t soft_body, sbri_skin *surface);

/* A part of an object, in metres from `origin` of the query. */
typedef struct sbri_query_piece {
  const sbr_object *object;
  enum {
    SBRI_PIECE_CONVEX,
    SBRI_PIECE_PLANE,
    SBRI_PIECE_HOST,  /* a host's geometry */
    SBRI_PIECE_INSIDE /* of a mesh: the volume behind all its faces */
  } kind;
  sbri_convex convex;     /* position of a plane; the shape's frame for the last two kinds */
  sbfi_d3 normal;         /* of a plane, or of a triangle that is solid behind it; else 0 */
  const sbr_shape *shape; /* for the last two kinds */
} sbri_query_piece;

/* Return false to end the visit of the object. */
typedef bool sbri_query_visitor(void *context, const sbri_query_piece *piece);

/* Region of a query: `box` in metres from `origin`. */
typedef struct sbri_query_space {
  const sbr_world *world;
  const sbr_query_filter *filter;
  sbr_double3 origin;
  sbri_box box;
} sbri_query_space;

/* Visits every piece whose bounds overlap the box, object after object, except the ground. */
void sbri_query_visit(const sbri_query_space *space, sbri_query_visitor *visit, void *context);
/* Whether the filter accepts the ground; and its pieces in the box. */
bool sbri_query_sees_ground(const sbr_world *world, const sbr_query_filter *filter);
void sbri_query_visit_ground(const sbri_query_space *space, sbri_query_visitor *visit, void *context);

/* A sphere, capsule, box or hull as a convex shape at the origin; false for other kinds. */
bool sbri_query_convex_of(const sbr_shape *shape, sbf_quat rotation, sbri_convex *convex, sbf_vec3 ends[2]);
sbri_box sbri_convex_bounds(const sbri_convex *convex);
/* Whether the shape's first point is inside a mesh. */
bool sbri_query_is_inside(const sbri_query_piece *piece, const sbri_convex *convex);
/* Signed distance of a displaced convex shape's points, less its radius, from a host's geometry, up to
 * `reach`; `normal` receives the normal at the nearest one. */
double sbri_query_host_distance(
    const sbri_query_piece *piece, const sbri_convex *convex, sbfi_d3 offset, double reach, sbfi_d3 *normal);

#endif
