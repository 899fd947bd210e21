/* Render meshes: polygons, normals, texture coordinates, skin weights, shape keys and coarser levels. Part of
 * sbfmt/model.h, which documents the common conventions.
 *
 * Made from spec/sbf.schema by spec/generate/generate.py: change the schema, not this file. */
#ifndef SBFMT_MODEL_MESH_H
#define SBFMT_MODEL_MESH_H

#include "sbfmt/model_pins.h"

#ifdef __cplusplus
extern "C" {
#endif

// clang-format off

/* Values of mesh_target; sbf_mesh_target_name returns their names in files. */
typedef enum sbf_mesh_target {
  SBF_MESH_TARGET_RENDERING = 0,
  SBF_MESH_TARGET_SURFACE = 1,
  SBF_MESH_TARGET_COLLISION_DETECTION = 2,
  SBF_MESH_TARGET_COUNT = 3
} sbf_mesh_target;

/* Points and polygons, counter-clockwise seen from outside. */
typedef struct sbf_polygon_mesh {
  sbf_mesh_target target;       /* Purpose. */
  sbf_vec3_list positions;      /* Points. [m] */
  sbf_u32_list polygon_sizes;   /* Corners of each polygon. [[3, inf)] */
  sbf_u32_list polygon_points;  /* The corners' points, polygon after polygon.
                                 * [length sum(polygon_sizes); index into positions] */
} sbf_polygon_mesh;
typedef struct sbf_polygon_mesh_list { const sbf_polygon_mesh *at; uint32_t count; } sbf_polygon_mesh_list;

/* One set of texture coordinates, origin at the lower left. */
typedef struct sbf_uv_set {
  const char *name;           /* Name for people. */
  sbf_vec2_list coordinates;  /* Coordinates: one a point, or indexed by corners. */
  sbf_u32_list corners;       /* Index of each corner's coordinates; empty: one a point.
                               * [length 0 or parent.mesh.polygon_points; index into coordinates] */
} sbf_uv_set;
typedef struct sbf_uv_set_list { const sbf_uv_set *at; uint32_t count; } sbf_uv_set_list;

/* A material of the mesh's polygons. */
typedef struct sbf_material_slot {
  int32_t material;  /* The material. [index into asset.materials, or SBF_NONE] */
} sbf_material_slot;
typedef struct sbf_material_slot_list { const sbf_material_slot *at; uint32_t count; } sbf_material_slot_list;

/* Linear blend skinning. The rest pose is the bind pose. */
typedef struct sbf_skin {
  sbf_u32_list influence_counts;  /* Number of bones of each point. [length parent.mesh.positions] */
  sbf_u32_list bones;             /* Bones, point after point. [length sum(influence_counts); index into asset.bones] */
  sbf_f32_list weights;           /* Weights; those of a point sum to one. [[0, 1]; length bones] */
} sbf_skin;
typedef struct sbf_skin_list { const sbf_skin *at; uint32_t count; } sbf_skin_list;

/* Named offsets of some points. */
typedef struct sbf_shape_key {
  const char *name;       /* Name. */
  sbf_u32_list points;    /* Points. [index into parent.size] */
  sbf_vec3_list offsets;  /* Offsets at weight 1. [m; length points] */
} sbf_shape_key;
typedef struct sbf_shape_key_list { const sbf_shape_key *at; uint32_t count; } sbf_shape_key_list;

/* Fewer polygons over the same points. */
typedef struct sbf_render_level {
  float error;                     /* Maximum distance from the full mesh. [m; [0, inf)] */
  sbf_u32_list polygon_sizes;      /* Corners of each polygon. [[3, inf)] */
  sbf_u32_list polygon_points;     /* The corners' points.
                                    * [length sum(polygon_sizes); index into parent.mesh.positions] */
  int32_t derived;                 /* Derivation, if `build` made it. [index into asset.derivations, or SBF_NONE] */
  sbf_u32_list polygon_materials;  /* Slot of each polygon; empty: the first.
                                    * [length 0 or polygon_sizes; index into parent.material_slots] */
  sbf_u32_list corners;            /* A corner of the full mesh at the same point for each corner, with its normal and
                                    * texture coordinates; empty: the first there.
                                    * [length 0 or polygon_points; index into parent.mesh.polygon_points] */
} sbf_render_level;
typedef struct sbf_render_level_list { const sbf_render_level *at; uint32_t count; } sbf_render_level_list;

/* A visible mesh as authored, with quads and n-gons. */
typedef struct sbf_render_mesh {
  const char *id;                         /* Identity. */
  const char *name;                       /* Name for people. */
  int32_t bone;                           /* Bone of points that are neither embedded nor skinned.
                                           * [index into asset.bones, or SBF_NONE] */
  int32_t derived;                        /* Derivation, if `build` made it.
                                           * [index into asset.derivations, or SBF_NONE] */
  sbf_polygon_mesh mesh;                  /* Points and polygons. */
  sbf_vec3_list normals;                  /* Unit normals: one a point, or indexed by normal_corners. */
  sbf_u32_list normal_corners;            /* Index of each corner's normal; empty: one normal a point.
                                           * [length 0 or mesh.polygon_points; index into normals] */
  sbf_uv_set_list uv_sets;                /* Texture coordinates. */
  sbf_material_slot_list material_slots;  /* Materials of polygons. */
  sbf_u32_list polygon_materials;         /* Slot of each polygon; empty: the first.
                                           * [length 0 or mesh.polygon_sizes; index into material_slots] */
  const sbf_skin *skin;                   /* Bone weights of points. */
  sbf_shape_key_list shape_keys;          /* Named offsets of points. */
  sbf_u32_list source_points;             /* Index of each point in the source file. [length 0 or mesh.positions] */
  sbf_render_level_list levels;           /* Coarser polygons over the same points. */
  sbf_pin_set_list pins;                  /* Pins of sections cut from it, on its points; a set without a frame uses the
                                           * section's bone. */
  sbf_vec4_list colors;                   /* Linear colors and opacities that multiply the base color: one a point, or
                                           * indexed by color_corners; empty: white. [[0, 1]] */
  sbf_u32_list color_corners;             /* Index of each corner's color; empty: one color a point.
                                           * [length 0 or mesh.polygon_points; index into colors] */
} sbf_render_mesh;
typedef struct sbf_render_mesh_list { const sbf_render_mesh *at; uint32_t count; } sbf_render_mesh_list;

/* Sets every field to its default, lists to empty, references to SBF_NONE. */
SBF_API void sbf_polygon_mesh_init(sbf_polygon_mesh *polygon_mesh);
SBF_API void sbf_uv_set_init(sbf_uv_set *uv_set);
SBF_API void sbf_material_slot_init(sbf_material_slot *material_slot);
SBF_API void sbf_skin_init(sbf_skin *skin);
SBF_API void sbf_shape_key_init(sbf_shape_key *shape_key);
SBF_API void sbf_render_level_init(sbf_render_level *render_level);
SBF_API void sbf_render_mesh_init(sbf_render_mesh *render_mesh);

/* The name of a value in files, or "?" if it is out of range. */
SBF_API const char *sbf_mesh_target_name(sbf_mesh_target value);

// clang-format on

#ifdef __cplusplus
}
#endif
#endif
