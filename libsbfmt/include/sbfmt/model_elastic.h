/* Elastic models: tetrahedra, springs, shape matching, or a follower. Part of sbfmt/model.h, which documents the common
 * conventions.
 *
 * Made from spec/sbf.schema by spec/generate/generate.py: change the schema, not this file. */
#ifndef SBFMT_MODEL_ELASTIC_H
#define SBFMT_MODEL_ELASTIC_H

#include "sbfmt/base.h"

#ifdef __cplusplus
extern "C" {
#endif

// clang-format off

/* Values of volume_target; sbf_volume_target_name returns their names in files. */
typedef enum sbf_volume_target {
  SBF_VOLUME_TARGET_VOLUME = 0,
  SBF_VOLUME_TARGET_COUNT = 1
} sbf_volume_target;

/* Values of spring_kind; sbf_spring_kind_name returns their names in files. */
typedef enum sbf_spring_kind {
  SBF_SPRING_KIND_STRUCTURAL = 0,
  SBF_SPRING_KIND_SHEAR = 1,
  SBF_SPRING_KIND_FLEXION = 2,
  SBF_SPRING_KIND_INTERNAL = 3,
  SBF_SPRING_KIND_CROSS_BODY = 4,
  SBF_SPRING_KIND_COUNT = 5
} sbf_spring_kind;

/* A lattice. Positive orientation: det(p1-p0, p2-p0, p3-p0) > 0. */
typedef struct sbf_tetrahedron_mesh {
  sbf_volume_target target;        /* Purpose. */
  sbf_uint4_list tetrahedra;       /* Four points each; the rest shape is the level's positions.
                                    * [index into parent.positions] */
  sbf_f32_list young_modulus;      /* Effective modulus; empty: the body's.
                                    * [Pa; (0, inf); length 0 or 1 or tetrahedra] */
  sbf_f32_list reference_modulus;  /* Modulus of the material, before calibration; empty: the body's.
                                    * [Pa; (0, inf); length 0 or 1 or tetrahedra] */
  sbf_f32_list densities;          /* Densities; empty: the body's. [kg/m^3; (0, inf); length 0 or 1 or tetrahedra] */
  sbf_u32_list color_counts;       /* Number of elements of each color, in order; empty: not colored. */
  sbf_f32_list stiffness_damping;  /* Rayleigh beta; empty: the body's, by its weight maps.
                                    * [s; [0, inf); length 0 or 1 or tetrahedra] */
} sbf_tetrahedron_mesh;
typedef struct sbf_tetrahedron_mesh_list { const sbf_tetrahedron_mesh *at; uint32_t count; } sbf_tetrahedron_mesh_list;

/* Springs of one kind. */
typedef struct sbf_spring_set {
  const char *name;                /* Name for people. */
  sbf_spring_kind kind;            /* Purpose. */
  int32_t derived;                 /* Derivation, if `build` made them. [index into asset.derivations, or SBF_NONE] */
  bool extra;                      /* Acts beside another elastic model. [default false] */
  sbf_uint2_list ends;             /* Two points each, of the level. [index into parent.positions] */
  sbf_f32_list rest_lengths;       /* Rest lengths; empty: distances at rest. [m; [0, inf); length 0 or ends] */
  sbf_f32_list stiffness;          /* Stiffness; empty: from the body's modulus (specification, 10.1).
                                    * [N/m; [0, inf); length 0 or 1 or ends] */
  sbf_f32_list damping;            /* Damping; empty: from the body's. [N*s/m; [0, inf); length 0 or 1 or ends] */
  float strain_min;                /* As the body's, for this set; -1: the body's. [[-1, 0]; default -1] */
  float strain_max;                /* As the body's, for this set; 0: the body's. [[0, inf)] */
  float yield_strain;              /* As the body's, for this set; 0: the body's. [[0, inf)] */
  float tear_strain;               /* As the body's, for this set; 0: the body's. [[0, inf)] */
  uint32_t inert_count;            /* Number of springs between two pinned points that were left out. */
  sbf_u32_list color_counts;       /* Number of springs of each color, in order; empty: not colored. */
  sbf_f32_list compression_ratio;  /* Stiffness below the rest length, relative to `stiffness`; empty: 1.
                                    * [[0, inf); length 0 or 1 or ends] */
} sbf_spring_set;
typedef struct sbf_spring_set_list { const sbf_spring_set *at; uint32_t count; } sbf_spring_set_list;

/* Overlapping groups of points that keep their shape. */
typedef struct sbf_shape_regions {
  sbf_u32_list sizes;   /* Points of each region. [[1, inf)] */
  sbf_u32_list points;  /* Points, region after region. [length sum(sizes); index into parent.positions] */
  float stiffness;      /* Angular frequency w that pulls a point to its position in the region: energy m/2 w^2
                         * distance^2. [1/s; (0, inf); default 60] */
} sbf_shape_regions;
typedef struct sbf_shape_regions_list { const sbf_shape_regions *at; uint32_t count; } sbf_shape_regions_list;

/* A second-order follower: y + 2z/w y' + y''/w^2 = x + r z/w x', w = 2 pi f. */
typedef struct sbf_jiggle {
  float frequency;      /* Frequency f. [Hz; (0, inf); default 3] */
  float damping_ratio;  /* Damping ratio z. [[0, inf); default 0.4] */
  float response;       /* Response r: above 1 overshoots at once, below 0 anticipates. [default 0] */
} sbf_jiggle;
typedef struct sbf_jiggle_list { const sbf_jiggle *at; uint32_t count; } sbf_jiggle_list;

/* Springs between points of two bodies' levels. */
typedef struct sbf_cross_springs {
  const char *name;           /* Name for people. */
  int32_t derived;            /* Derivation, if `build` made them. [index into asset.derivations, or SBF_NONE] */
  int32_t body_a;             /* First body. [index into asset.soft_bodies, or SBF_NONE] */
  uint32_t level_a;           /* Its level. */
  int32_t body_b;             /* Second body. [index into asset.soft_bodies, or SBF_NONE] */
  uint32_t level_b;           /* Its level. */
  sbf_uint2_list ends;        /* A point of each level. */
  sbf_f32_list rest_lengths;  /* Rest lengths; empty: distances at rest. [m; [0, inf); length 0 or ends] */
  sbf_f32_list stiffness;     /* Stiffness; empty: from the softer body's modulus.
                               * [N/m; [0, inf); length 0 or 1 or ends] */
  sbf_f32_list damping;       /* Damping; empty: from the softer body's. [N*s/m; [0, inf); length 0 or 1 or ends] */
} sbf_cross_springs;
typedef struct sbf_cross_springs_list { const sbf_cross_springs *at; uint32_t count; } sbf_cross_springs_list;

/* Sets every field to its default, lists to empty, references to SBF_NONE. */
SBF_API void sbf_tetrahedron_mesh_init(sbf_tetrahedron_mesh *tetrahedron_mesh);
SBF_API void sbf_spring_set_init(sbf_spring_set *spring_set);
SBF_API void sbf_shape_regions_init(sbf_shape_regions *shape_regions);
SBF_API void sbf_jiggle_init(sbf_jiggle *jiggle);
SBF_API void sbf_cross_springs_init(sbf_cross_springs *cross_springs);

/* The name of a value in files, or "?" if it is out of range. */
SBF_API const char *sbf_volume_target_name(sbf_volume_target value);
SBF_API const char *sbf_spring_kind_name(sbf_spring_kind value);

// clang-format on

#ifdef __cplusplus
}
#endif
#endif
