/* Grounds beyond the simple ones of sbrun.h: height fields, triangles, obstacles, a host's rays.
 *
 * Each call gives an sbr_ground for a world's definition. What it was made from must outlive the world and
 * must not change meanwhile. Grounds are asked from worker threads. */
#ifndef SBRUN_TERRAIN_H
#define SBRUN_TERRAIN_H

#include "sbrun/sbrun.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Through the point (0, height_m, 0), square to `normal` (of any length, y > 0; else level). */
SBF_API sbr_ground sbr_ground_plane(double height_m, sbf_vec3 normal);

/* Heights at the corners of squares, bilinear between them; beyond the edge it goes on level. */
typedef struct sbr_height_field {
  const float *heights_m; /* (rows x columns), columns along +X, rows along +Z */
  uint32_t columns, rows; /* at least 2 each */
  double cell_m;          /* > 0: side of a square */
  double x;               /* m, world: of the first height */
  double z;               /* m, likewise */
} sbr_height_field;
SBF_API sbr_ground sbr_ground_height_field(const sbr_height_field *field);

/* Triangles, indexed by a grid. Where several lie above each other the highest counts; where none does, the
 * ground is at `otherwise_m`. Made and destroyed; SBF_FAILED where memory runs out or an index is beyond the
 * points. The arrays must outlive it. */
typedef struct sbr_ground_mesh sbr_ground_mesh;
SBF_API sbf_status sbr_ground_mesh_create(const sbf_allocator *allocator, const sbf_vec3 *points,
    uint32_t point_count, const uint32_t *triangles, uint32_t triangle_count, double otherwise_m,
    sbr_ground_mesh **mesh, sbf_diagnostic *error);
SBF_API void sbr_ground_mesh_destroy(sbr_ground_mesh *mesh);
SBF_API sbr_ground sbr_ground_of_mesh(const sbr_ground_mesh *mesh);

/* Simple shapes on another ground. Feet step on what is low enough, and around what is not. */
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
/* All of them; the host's, and lives as long as the ground does. */
typedef struct sbr_obstacle_set {
  const sbr_ground *base;        /* what they stand on */
  const sbr_obstacle *obstacles; /* (count) */
  uint32_t count;                /* of obstacles */
} sbr_obstacle_set;
SBF_API sbr_ground sbr_ground_obstacles(const sbr_obstacle_set *set);

/* A host's rays: casts one straight down. Returns how far it goes until it hits, at most `length`; negative
 * where it hits nothing. `normal` receives the unit normal there. */
typedef struct sbr_ray_caster {
  /* m; called by worker threads */
  double (*cast)(void *user, sbr_double3 from, double length, sbf_vec3 *normal);
  void *user;         /* the host's, handed to `cast` */
  double top_m;       /* rays begin at this y */
  double length_m;    /* and go down so far */
  double otherwise_m; /* height where nothing is hit */
} sbr_ray_caster;
/* The ground that they find; `caster` must outlive it. */
SBF_API sbr_ground sbr_ground_rays(const sbr_ray_caster *caster);

#ifdef __cplusplus
}
#endif
#endif
