/* More grounds: planes, height fields, triangle meshes, obstacles, rays of the host.
 *
 * Each call returns an sbr_ground for a world's definition. Its data must outlive the world and must not
 * change meanwhile. Worker threads query grounds. */
#ifndef SBRUN_TERRAIN_H
#define SBRUN_TERRAIN_H

#include "sbrun/sbrun.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Plane through (0, height_m, 0) with that normal (any length, y > 0; otherwise level). */
SBF_API sbr_ground sbr_ground_plane(double height_m, sbf_vec3 normal);

/* Heights on a square grid with bilinear interpolation; level beyond the edge. */
typedef struct sbr_height_field {
  const float *heights_m; /* (rows x columns), columns along +X, rows along +Z */
  uint32_t columns, rows; /* at least 2 each */
  double cell_m;          /* > 0: side of a square */
  double x;               /* world x of the first height, m */
  double z;               /* world z of the first height, m */
} sbr_height_field;
SBF_API sbr_ground sbr_ground_height_field(const sbr_height_field *field);

/* Triangle mesh with a grid index. The highest triangle counts; without one the height is `otherwise_m`.
 * SBF_FAILED if memory runs out or an index is out of range. The arrays must outlive it. */
typedef struct sbr_ground_mesh sbr_ground_mesh;
SBF_API sbf_status sbr_ground_mesh_create(const sbf_allocator *allocator, const sbf_vec3 *points,
    uint32_t point_count, const uint32_t *triangles, uint32_t triangle_count, double otherwise_m,
    sbr_ground_mesh **mesh, sbf_diagnostic *error);
SBF_API void sbr_ground_mesh_destroy(sbr_ground_mesh *mesh);
SBF_API sbr_ground sbr_ground_from_mesh(const sbr_ground_mesh *mesh);

/* Simple shapes on another ground. Feet step on low obstacles and around high ones. */
typedef enum sbr_obstacle_kind {
  SBR_OBSTACLE_BOX,
  SBR_OBSTACLE_CYLINDER,
  SBR_OBSTACLE_SPHERE
} sbr_obstacle_kind;
/* One of them. */
typedef struct sbr_obstacle {
  sbr_obstacle_kind kind; /* its shape */
  sbr_double3 center;     /* world */
  sbf_vec3
      half_sizes; /* box: along its own x, y, z; cylinder (upright): x the radius, y; sphere: x the radius */
  float heading;  /* of a box, rad */
} sbr_obstacle;
/* Obstacles of a ground. Owned by the host; must outlive the ground. */
typedef struct sbr_obstacle_set {
  const sbr_ground *base;        /* ground below them */
  const sbr_obstacle *obstacles; /* (count) */
  uint32_t count;                /* number of obstacles */
} sbr_obstacle_set;
SBF_API sbr_ground sbr_ground_with_obstacles(const sbr_obstacle_set *set);

/* A vertical ray cast of the host. Returns the distance to the hit, at most `length`; negative without a hit.
 * `normal` receives the unit normal there. */
typedef struct sbr_ray_caster {
  /* m; called by worker threads */
  double (*cast)(void *user, sbr_double3 from, double length, sbf_vec3 *normal);
  void *user;         /* the host's, handed to `cast` */
  double top_m;       /* rays begin at this y */
  double length_m;    /* and go down so far */
  double otherwise_m; /* height where nothing is hit */
} sbr_ray_caster;
/* The ground that they find; `caster` must outlive it. */
SBF_API sbr_ground sbr_ground_from_rays(const sbr_ray_caster *caster);

#ifdef __cplusplus
}
#endif
#endif
