/* Binary glTF 2.0 in the making: arrays of JSON that grow side by side, and the bytes that they point into.
 *
 * The JSON is printed by base/text.h, as every other form: shortest digits, no locale, memory that runs out
 * reported; nothing else of a JSON library would be used.
 *
 * Nodes: one for each bone, in their order; one for each mesh that is written, in theirs; and, where there
 * are bones, the one that they hang on. */
#ifndef SBFI_GLB_H
#define SBFI_GLB_H

#include "base/memory.h"
#include "export/exporting.h"

typedef enum sbfi_glb_part {
  SBFI_GLB_VIEWS,
  SBFI_GLB_ACCESSORS,
  SBFI_GLB_IMAGES,
  SBFI_GLB_TEXTURES,
  SBFI_GLB_MATERIALS,
  SBFI_GLB_MESHES,
  SBFI_GLB_SKINS,
  SBFI_GLB_NODES,
  SBFI_GLB_ANIMATIONS,
  SBFI_GLB_PARTS
} sbfi_glb_part;

typedef struct sbfi_glb_array {
  sbfi_text text;
  uint32_t count;
} sbfi_glb_array;

/* Where a bone is, in asset or world space. */
typedef struct sbfi_glb_transform {
  sbf_vec3 position;
  sbf_quat rotation;
} sbfi_glb_transform;

/* m, then t added. */
typedef struct sbfi_glb_affine {
  double m[3][3], t[3];
} sbfi_glb_affine;

/* One render mesh on its way: the polygons that are written, and how its points are held. */
typedef struct sbfi_glb_mesh {
  const sbf_render_mesh *full;   /* of the asset */
  const sbf_render_mesh *shown;  /* the same, or a render level of it */
  const uint32_t *full_of_shown; /* (points of shown) points of full; NULL: the same */
  const sbf_skin *skin;          /* of full's points; NULL: it hangs on `bone`, or on nothing */
  int32_t bone;                  /* SBF_NONE where skin */
  uint32_t node;                 /* UINT32_MAX: it has no polygon and is not written */
  uint32_t target_count;         /* morph targets: shape keys, then frames of the motion */
  uint32_t first_point;          /* of full, in a frame of the motion */
} sbfi_glb_mesh;

typedef struct sbfi_glb {
  sbfi_export *e;
  sbfi_arena arena;
  sbfi_text bytes; /* of the binary chunk */
  sbfi_glb_array parts[SBFI_GLB_PARTS];
  const int32_t *texture_indices; /* by texture of the asset: number among the written ones, or SBF_NONE */
  sbfi_glb_mesh *meshes;          /* by render mesh */
  sbfi_glb_affine *bone_motions;  /* (bones) room for sbfi_glb_compute_offsets; NULL without a motion */
  size_t frame_points;            /* of all render meshes */
  uint32_t root_node;             /* that bones hang on */
  bool root_is_joint;             /* it also holds what no bone holds */
  bool emissive_strength, texture_transform, texture_webp; /* these extensions are used */
  bool failed;                                             /* memory ran out */
  uint32_t lost_images, lost_tracks;
  double worst_m; /* that the written motion is off, where joints' blends fold a place flat */
} sbfi_glb;

typedef enum sbfi_glb_type {
  SBFI_GLB_FLOAT,
  SBFI_GLB_VEC2,
  SBFI_GLB_VEC3,
  SBFI_GLB_VEC4,
  SBFI_GLB_MAT4,
  SBFI_GLB_UINT,
  SBFI_GLB_USHORT4
} sbfi_glb_type;

enum { SBFI_GLB_NO_TARGET = 0, SBFI_GLB_VERTICES = 34962, SBFI_GLB_INDICES = 34963 };

/* Appends `count` items and returns the accessor's number. Floats and vec3 state their bounds. */
uint32_t sbfi_glb_accessor(
    sbfi_glb *g, const void *items, uint32_t count, sbfi_glb_type type, uint32_t target);
/* Appends bytes as a view of their own and returns its number. */
uint32_t sbfi_glb_view(sbfi_glb *g, const void *bytes, size_t size);

/* Begins a new item of a part: its text to append to, behind a comma where needed. */
sbfi_text *sbfi_glb_item(sbfi_glb *g, sbfi_glb_part part, uint32_t *number);
void sbfi_glb_write_string(sbfi_text *text, const char *string);                    /* quoted and escaped */
void sbfi_glb_write_numbers(sbfi_text *text, const float *numbers, uint32_t count); /* [a,b,...] */

/* Zeroed memory until the end; NULL, and `failed` set, where it runs out or the count is 0. */
void *sbfi_glb_allocate(sbfi_glb *g, size_t count, size_t size);

sbfi_glb_transform sbfi_glb_rest(const sbf_asset *asset, uint32_t bone);
/* A place in its parent's frame; NULL: as it is. The rotation has unit length. */
void sbfi_glb_compute_local(
    sbfi_glb_transform own, const sbfi_glb_transform *parent, float translation[3], float rotation[4]);

/* What each file of the writer adds. */
void sbfi_glb_write_materials(sbfi_glb *g);
void sbfi_glb_choose_meshes(sbfi_glb *g); /* fills g->meshes; before nodes and meshes */
void sbfi_glb_write_meshes(sbfi_glb *g);
void sbfi_glb_write_nodes(sbfi_glb *g); /* and the skin */
void sbfi_glb_write_clips(sbfi_glb *g);
/* The motion's channels; behind the meshes. */
void sbfi_glb_write_motion(sbfi_glb *g);
/* What of a mesh's normals its morph targets turn; NULL where it has none, or memory runs out. */
typedef struct sbfi_glb_normals sbfi_glb_normals;
sbfi_glb_normals *sbfi_glb_normals_begin(sbfi_glb *g, const sbfi_glb_mesh *mesh);
/* Takes the points of `mesh->shown` with these offsets. */
void sbfi_glb_normals_move(sbfi_glb_normals *normals, const sbf_vec3 *offsets);
/* By how much the normal of a corner differs there; `normal` has unit length. */
sbf_vec3 sbfi_glb_normals_offset(const sbfi_glb_normals *normals, uint32_t corner, sbf_vec3 normal);
uint32_t sbfi_glb_normal_of(const sbf_render_mesh *m, uint32_t corner); /* index of a corner's normal */
/* Offset of each point of `mesh->shown` at that frame, in the place that its joints move from. */
void sbfi_glb_compute_offsets(sbfi_glb *g, const sbfi_glb_mesh *mesh, uint32_t frame, sbf_vec3 *offsets);

#endif
