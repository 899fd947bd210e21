/* Soft bodies: surface, material, collision, levels. Part of sbfmt/model.h, which documents the common conventions.
 *
 * Made from spec/sbf.schema by spec/generate/generate.py: change the schema, not this file. */
#ifndef SBFMT_MODEL_SOFT_BODY_H
#define SBFMT_MODEL_SOFT_BODY_H

#include "sbfmt/model_pins.h"
#include "sbfmt/model_mesh.h"
#include "sbfmt/model_level.h"

#ifdef __cplusplus
extern "C" {
#endif

// clang-format off

/* Values of pressure_mode; sbf_pressure_mode_name returns their names in files. */
typedef enum sbf_pressure_mode {
  SBF_PRESSURE_MODE_NONE = 0,
  SBF_PRESSURE_MODE_GAS = 1,
  SBF_PRESSURE_MODE_VOLUME = 2,
  SBF_PRESSURE_MODE_COUNT = 3
} sbf_pressure_mode;

/* Values of weight_property; sbf_weight_property_name returns their names in files. */
typedef enum sbf_weight_property {
  SBF_WEIGHT_PROPERTY_DENSITY = 0,
  SBF_WEIGHT_PROPERTY_YOUNG_MODULUS = 1,
  SBF_WEIGHT_PROPERTY_BENDING_STIFFNESS = 2,
  SBF_WEIGHT_PROPERTY_MASS_DAMPING = 3,
  SBF_WEIGHT_PROPERTY_STIFFNESS_DAMPING = 4,
  SBF_WEIGHT_PROPERTY_FRICTION = 5,
  SBF_WEIGHT_PROPERTY_PRESSURE = 6,
  SBF_WEIGHT_PROPERTY_YIELD_STRAIN = 7,
  SBF_WEIGHT_PROPERTY_TEAR_STRAIN = 8,
  SBF_WEIGHT_PROPERTY_COUNT = 9
} sbf_weight_property;

/* Physical properties. Every value is in SI units. */
typedef struct sbf_attributes {
  float density;                    /* Density of a volume. [kg/m^3; (0, inf); default 1000] */
  float mass;                       /* Mass of the body's free points; 0: from the density. [kg; [0, inf)] */
  float area_density;               /* Area density of a sheet; 0: density times thickness. [kg/m^2; [0, inf)] */
  float thickness;                  /* Thickness of a sheet. [m; (0, inf); default 0.001] */
  float young_modulus;              /* Young's modulus. [Pa; (0, inf); default 80000] */
  float poisson_ratio;              /* Poisson's ratio; springs have 1/4. [(-1, 0.5); default 0.4] */
  float bending_stiffness;          /* Flexural rigidity of a sheet; 0: from modulus and thickness. [N*m; [0, inf)] */
  float mass_damping;               /* Rayleigh alpha. [1/s; [0, inf)] */
  float stiffness_damping;          /* Rayleigh beta. [s; [0, inf)] */
  float damping_ratio;              /* Damping ratio of the lowest mode, in addition to alpha.
                                     * [[0, inf); default 0.2] */
  float friction;                   /* Coulomb friction coefficient. [[0, inf); default 0.6] */
  float restitution;                /* Fraction of normal speed returned. [[0, 1]; default 0] */
  float gravity_scale;              /* Factor on gravity. [default 1] */
  float media_friction;             /* Decay rate of speed relative to the medium. [1/s; [0, inf)] */
  float pressure;                   /* Gas pressure at rest, relative to the outside. [Pa] */
  sbf_pressure_mode pressure_mode;  /* none: no pressure; gas: pressure times volume is constant; volume: the volume is
                                     * constant. [default none] */
  float strain_min;                 /* Minimum strain; -1: none. [[-1, 0]; default -1] */
  float strain_max;                 /* Maximum strain; 0: none. [[0, inf)] */
  float yield_strain;               /* Strain at which the rest shape flows; 0: never. [[0, inf)] */
  float yield_flow;                 /* Rate of the flow. [1/s; [0, inf)] */
  float tear_strain;                /* Strain at which the element stops acting; 0: never. [[0, inf)] */
  bool sag_free;                    /* Springs without stated rest lengths carry the weight in the authored shape.
                                     * [default false] */
} sbf_attributes;
typedef struct sbf_attributes_list { const sbf_attributes *at; uint32_t count; } sbf_attributes_list;

/* Collision of a body. */
typedef struct sbf_collision {
  float particle_radius;  /* Radius of a point. [m; [0, inf); default 0.01] */
  float outer_thickness;  /* Contact distance outside a face. [m; [0, inf); default 0.005] */
  float inner_thickness;  /* Depth inside a face up to which a point is pushed out. [m; [0, inf); default 0.01] */
  bool self;              /* Collides with itself. [default false] */
  uint32_t layer;         /* Collision layer bits. [default 1] */
  uint32_t mask;          /* Layers it collides with. [default 4294967295] */
} sbf_collision;
typedef struct sbf_collision_list { const sbf_collision *at; uint32_t count; } sbf_collision_list;

/* Factors on one attribute. */
typedef struct sbf_weight_map {
  sbf_weight_property property;  /* Attribute. */
  sbf_f32_list values;           /* Factor at each source point; an element takes the mean of its points'.
                                  * [[0, inf); length parent.size] */
} sbf_weight_map;
typedef struct sbf_weight_map_list { const sbf_weight_map *at; uint32_t count; } sbf_weight_map_list;

/* Attributes of the 2012 dialect, dimensionless. */
typedef struct sbf_legacy {
  float mass;                  /* As read. */
  float volume_stiffness;      /* As read. */
  float stretching_stiffness;  /* As read. */
  float friction;              /* As read. */
  float particle_radius;       /* As read. */
  uint32_t solver_iterations;  /* As read. */
} sbf_legacy;
typedef struct sbf_legacy_list { const sbf_legacy *at; uint32_t count; } sbf_legacy_list;

/* A deformable body: its source points are the surface's points, then the interior ones. */
typedef struct sbf_soft_body {
  const char *id;                   /* Identity. */
  const char *name;                 /* Name for people. */
  int32_t bone;                     /* The bone of a section. [index into asset.bones, or SBF_NONE] */
  int32_t derived;                  /* Derivation, if `build` cut it from a skinned mesh.
                                     * [index into asset.derivations, or SBF_NONE] */
  sbf_polygon_mesh surface;         /* Surface. */
  sbf_vec3_list interior;           /* Authored interior points. [m] */
  sbf_u32_list source_points;       /* Index of each surface point in the source file.
                                     * [length 0 or surface.positions] */
  sbf_attributes attributes;        /* Material. */
  sbf_collision collision;          /* Collision. */
  sbf_weight_map_list weight_maps;  /* Factors on attributes, per source point. */
  sbf_pin_set_list pins;            /* Pins of source points. */
  sbf_attachment_list attachments;  /* Rules for pins of levels. */
  sbf_level_list levels;            /* Simulation levels, finest first. */
  const sbf_legacy *legacy;         /* Attributes of the 2012 dialect, kept for a round trip. */
} sbf_soft_body;
typedef struct sbf_soft_body_list { const sbf_soft_body *at; uint32_t count; } sbf_soft_body_list;

/* Settings of a section that `build` cuts from a skin. */
typedef struct sbf_section_recipe {
  int32_t bone;               /* Bone of the section; none: all without a recipe.
                               * [index into asset.bones, or SBF_NONE] */
  sbf_attributes attributes;  /* Material. */
  sbf_collision collision;    /* Collision. */
  bool rigid;                 /* No section: the skin moves with its bones there. [default false] */
  bool proposed;              /* Guessed from the rig, for a person to confirm. [default false] */
  uint32_t elements;          /* About how many tetrahedra its lattice has; 0: the program chooses. [default 0] */
} sbf_section_recipe;
typedef struct sbf_section_recipe_list { const sbf_section_recipe *at; uint32_t count; } sbf_section_recipe_list;

/* Sets every field to its default, lists to empty, references to SBF_NONE. */
SBF_API void sbf_attributes_init(sbf_attributes *attributes);
SBF_API void sbf_collision_init(sbf_collision *collision);
SBF_API void sbf_weight_map_init(sbf_weight_map *weight_map);
SBF_API void sbf_legacy_init(sbf_legacy *legacy);
SBF_API void sbf_soft_body_init(sbf_soft_body *soft_body);
SBF_API void sbf_section_recipe_init(sbf_section_recipe *section_recipe);

/* The name of a value in files, or "?" if it is out of range. */
SBF_API const char *sbf_pressure_mode_name(sbf_pressure_mode value);
SBF_API const char *sbf_weight_property_name(sbf_weight_property value);

// clang-format on

#ifdef __cplusplus
}
#endif
#endif
