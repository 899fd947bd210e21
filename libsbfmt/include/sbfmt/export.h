/* Writing what other programs read.
 *
 * Files are written beside their place and renamed when complete: after a failure the old one stands. Each
 * writer belongs to one thread at a time. */
#ifndef SBFMT_EXPORT_H
#define SBFMT_EXPORT_H

#include "sbfmt/asset.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How an asset moved, frame by frame from time 0 on, as its host simulated it. World space, m. */
typedef struct sbf_export_motion {
  uint32_t frame_count;           /* 0: none */
  double frame_s;                 /* from one to the next */
  const sbf_vec3 *skin;           /* (frames * points) the points of all render meshes, in their order */
  const sbf_vec3 *bone_positions; /* (frames * bones) heads */
  const sbf_quat *bone_rotations; /* (frames * bones) from the bone's frame */
} sbf_export_motion;

/* Settings of sbf_export. */
typedef struct sbf_export_options {
  size_t struct_size;             /* sizeof(sbf_export_options), or 0 for this version's */
  const sbf_allocator *allocator; /* NULL: malloc */
  /* Warnings: what the form has no place for and was left out. May be NULL. */
  void (*report)(void *user, const sbf_diagnostic *diagnostic);
  void *user; /* for the callback */
  /* Of each render mesh: 0 the full one, n its n-th render level, or its last where there are fewer. */
  uint32_t render_level;
  /* Folder that the paths of images are relative to, the asset's own: .glb and .html take their bytes in.
   * NULL: those not embedded are left out. */
  const char *folder;
  /* For .glb, as an animation "motion": joints move, and what the skin does beside them is a morph target a
   * frame. NULL: none. */
  const sbf_export_motion *motion;
} sbf_export_options;

/* Writes the asset in the form that the ending of `path` names: .glb (binary glTF 2.0: render meshes with
 * skin, joints, materials, shape keys and clips), .obj (the render meshes at rest, or where
 * there are none the bodies' surfaces; materials to a .mtl of the same name), .tet (the bodies' first levels
 * of tetrahedra, as PhysX reads them), .node or .ele (the same for TetGen, two files), .msh (for Gmsh, 2.2)
 * and .vtu (for VTK), .mjcf (MuJoCo's XML, +Z up: rigid
 * bodies with their joints, soft bodies as flexes), .usda (USD as text, +Y up: meshes with their skeleton,
 * rigid bodies with their joints, soft bodies by the proposed schemas of deformables), .xml (the 2012
 * dialect, section 16 of the specification), .html (a page of its own, in which the asset lives; SBF_FAILED
 * where what it is made of is not installed). SBF_BAD_INPUT where the asset has nothing that the form could
 * hold. `options` may be NULL. */
SBF_API sbf_status sbf_export(
    const sbf_asset *asset, const char *path, const sbf_export_options *options, sbf_diagnostic *error);

/* A point cache, as Blender's Mesh Cache plays it: places of all points, sample after sample, single
 * precision. MDD where the path ends in .mdd, else PC2. */
typedef struct sbf_point_cache sbf_point_cache;

/* `sample_count` samples of `point_count` points will follow, one for each frame of whoever plays them, or,
 * which MDD alone states, every `sample_s` seconds. */
SBF_API sbf_status sbf_point_cache_open(const char *path, uint32_t point_count, uint32_t sample_count,
    double sample_s, sbf_point_cache **cache, sbf_diagnostic *error);
/* The next sample: point_count places. */
SBF_API sbf_status sbf_point_cache_add(sbf_point_cache *cache, const sbf_vec3 *points, sbf_diagnostic *error);
/* Completes the file; SBF_FAILED, and no file, where samples are missing or it cannot be written. */
SBF_API sbf_status sbf_point_cache_commit(sbf_point_cache *cache, sbf_diagnostic *error);
/* Gives it up; NULL does nothing. */
SBF_API void sbf_point_cache_abandon(sbf_point_cache *cache);

/* Results on a mesh over time, as ParaView reads them: OUT.pvd, which lists a file OUT_00000.vtu for each
 * frame (VTK XML, unstructured grid, arrays as base64). */
typedef struct sbf_result_series sbf_result_series;

/* Cells of a series, the same in all its frames. */
typedef struct sbf_result_mesh {
  uint32_t point_count;    /* points of all cells */
  uint32_t cell_count;     /* points, lines and tetrahedra together */
  const uint32_t *corners; /* of one cell after the other: 1 of a point, 2 of a line, 4 of a tetrahedron */
  const uint8_t *sizes;    /* (cell_count) how many corners each has */
} sbf_result_mesh;

/* Values on points or cells. */
typedef struct sbf_result_array {
  const char *name;    /* as ParaView lists it */
  uint32_t width;      /* numbers of one: 1, 3 (a vector) or 6 (a symmetric tensor: xx yy zz xy yz xz) */
  const float *values; /* (points or cells x width) */
} sbf_result_array;

/* A frame of a series. */
typedef struct sbf_result_frame {
  double time_s;                     /* since the first frame */
  const double *points;              /* (point_count x 3) m */
  const sbf_result_array *of_points; /* (point_array_count) */
  const sbf_result_array *of_cells;  /* (cell_array_count) */
  uint32_t point_array_count;        /* arrays on points */
  uint32_t cell_array_count;         /* arrays on cells */
} sbf_result_frame;

/* `path` ends in .pvd. `mesh` must stay until the series ends. */
SBF_API sbf_status sbf_result_series_open(
    const char *path, const sbf_result_mesh *mesh, sbf_result_series **series, sbf_diagnostic *error);
/* Writes the next frame under a temporary name, OUT_00000.vtu.part. */
SBF_API sbf_status sbf_result_series_add(
    sbf_result_series *series, const sbf_result_frame *frame, sbf_diagnostic *error);
/* Renames all frames, then writes the .pvd. SBF_FAILED where one cannot be written: what stood there before
 * still does, unless the renaming itself failed. */
SBF_API sbf_status sbf_result_series_commit(sbf_result_series *series, sbf_diagnostic *error);
/* Removes the frames; NULL does nothing. */
SBF_API void sbf_result_series_abandon(sbf_result_series *series);

#ifdef __cplusplus
}
#endif
#endif
