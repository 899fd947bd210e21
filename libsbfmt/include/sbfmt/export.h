/* Exports assets to other programs' formats.
 *
 * Files are written under a temporary name and renamed when complete: after a failure the old file is intact.
 * A writer may be used by one thread at a time. */
#ifndef SBFMT_EXPORT_H
#define SBFMT_EXPORT_H

#include "sbfmt/asset.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Simulated motion of an asset, frame by frame from time 0. World space, m. */
typedef struct sbf_export_motion {
  uint32_t frame_count;           /* 0: none */
  double frame_s;                 /* time between frames */
  const sbf_vec3 *skin;           /* (frames * points) points of all render meshes, in their order */
  const sbf_vec3 *bone_positions; /* (frames * bones) heads */
  const sbf_quat *bone_rotations; /* (frames * bones) rotation from the bone's frame to world space */
} sbf_export_motion;

/* Settings of sbf_export. */
typedef struct sbf_export_options {
  size_t struct_size;             /* sizeof(sbf_export_options), or 0 for this version's */
  const sbf_allocator *allocator; /* NULL: malloc */
  /* Warnings about parts that the format cannot hold and that were left out. May be NULL. */
  void (*report)(void *user, const sbf_diagnostic *diagnostic);
  void *user; /* for the callback */
  /* Render level of each mesh: 0 the full mesh, n its n-th level, or its last if it has fewer. */
  uint32_t render_level;
  /* Folder that image paths are relative to, normally the asset's. .glb and .html embed the images. NULL:
   * images that are not embedded are left out. */
  const char *folder;
  /* For .glb, an animation "motion": the joints move, and a morph target per frame holds the skin's remaining
   * displacement. NULL: none. */
  const sbf_export_motion *motion;
  /* For .glb: also write everything that glTF cannot hold, as the extension SBF_soft_body
   * (spec/gltf/SBF_soft_body), so that sbf_gltf_load_file gives an equal asset. Needs render_level 0. */
  bool soft_bodies;
  bool store;      /* with soft_bodies: leave the extension's lists uncompressed */
  int compression; /* with soft_bodies: zlib's level 1..9; 0: 6 */
  /* For .glb: images of the asset's textures, in their order, for those that are not embedded; searched
   * before `folder`. Must live until the call returns. NULL: none. */
  const sbf_texture_list *images;
} sbf_export_options;

/* Writes the asset in the format given by the extension of `path`: .glb (binary glTF 2.0: render meshes with
 * skin, joints, materials, shape keys and clips), .obj (the render meshes at rest, or the bodies' surfaces if
 * there are none; materials in a .mtl of the same name), .tet (the bodies' first levels of tetrahedra, for
 * PhysX), .node or .ele (the same for TetGen, two files), .msh (for Gmsh, 2.2) and .vtu (for VTK), .mjcf
 * (MuJoCo's XML, +Z up: rigid bodies with their joints, soft bodies as flexes), .usda (USD as text, +Y up:
 * meshes with their skeleton, rigid bodies with their joints, soft bodies by the proposed schemas of
 * deformables), .xml (the 2012 dialect, section 16 of the specification), .html (a self-contained page that
 * simulates the asset; SBF_FAILED if its template is not installed). SBF_BAD_INPUT if the asset has nothing
 * that the format can hold. `options` may be NULL. */
SBF_API sbf_status sbf_export(
    const sbf_asset *asset, const char *path, const sbf_export_options *options, sbf_diagnostic *error);

/* A point cache for Blender's Mesh Cache modifier: positions of all points, sample after sample, single
 * precision. MDD if the path ends in .mdd, else PC2. */
typedef struct sbf_point_cache sbf_point_cache;

/* `sample_count` samples of `point_count` points will follow. A sample is one frame of the player; MDD also
 * states the interval, `sample_s` seconds. */
SBF_API sbf_status sbf_point_cache_open(const char *path, uint32_t point_count, uint32_t sample_count,
    double sample_s, sbf_point_cache **cache, sbf_diagnostic *error);
/* Adds the next sample: point_count positions. */
SBF_API sbf_status sbf_point_cache_add(sbf_point_cache *cache, const sbf_vec3 *points, sbf_diagnostic *error);
/* Completes the file. SBF_FAILED, and no file, if samples are missing or the file cannot be written. */
SBF_API sbf_status sbf_point_cache_commit(sbf_point_cache *cache, sbf_diagnostic *error);
/* Discards the file; NULL does nothing. */
SBF_API void sbf_point_cache_abandon(sbf_point_cache *cache);

/* Results on a mesh over time, for ParaView: OUT.pvd, which lists a file OUT_00000.vtu for each frame (VTK
 * XML, unstructured grid, arrays as base64). */
typedef struct sbf_result_series sbf_result_series;

/* Cells of a series, the same in all its frames. */
typedef struct sbf_result_mesh {
  uint32_t point_count;    /* points of all cells */
  uint32_t cell_count;     /* points, lines and tetrahedra together */
  const uint32_t *corners; /* point indices, cell after cell: 1 for a point, 2 a line, 4 a tetrahedron */
  const uint8_t *sizes;    /* (cell_count) number of corners of each */
} sbf_result_mesh;

/* Values on points or cells. */
typedef struct sbf_result_array {
  const char *name;    /* name in ParaView */
  uint32_t width;      /* components: 1, 3 (a vector) or 6 (a symmetric tensor: xx yy zz xy yz xz) */
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

/* `path` ends in .pvd. `mesh` must live until the series ends. */
SBF_API sbf_status sbf_result_series_open(
    const char *path, const sbf_result_mesh *mesh, sbf_result_series **series, sbf_diagnostic *error);
/* Writes the next frame under a temporary name, OUT_00000.vtu.part. */
SBF_API sbf_status sbf_result_series_add(
    sbf_result_series *series, const sbf_result_frame *frame, sbf_diagnostic *error);
/* Renames all frames, then writes the .pvd. SBF_FAILED if one cannot be written; the old files are then
 * intact, unless a rename failed. */
SBF_API sbf_status sbf_result_series_commit(sbf_result_series *series, sbf_diagnostic *error);
/* Removes the frames; NULL does nothing. */
SBF_API void sbf_result_series_abandon(sbf_result_series *series);

#ifdef __cplusplus
}
#endif
#endif
