/* Gravity, wind, medium and force fields. Part of sbfmt/model.h, which documents the common conventions.
 *
 * Made from spec/sbf.schema by spec/generate/generate.py: change the schema, not this file. */
#ifndef SBFMT_MODEL_ENVIRONMENT_H
#define SBFMT_MODEL_ENVIRONMENT_H

#include "sbfmt/base.h"

#ifdef __cplusplus
extern "C" {
#endif

// clang-format off

/* Values of field_kind; sbf_field_kind_name returns their names in files. */
typedef enum sbf_field_kind {
  SBF_FIELD_KIND_UNIFORM = 0,
  SBF_FIELD_KIND_RADIAL = 1,
  SBF_FIELD_KIND_VORTEX = 2,
  SBF_FIELD_KIND_DRAG = 3,
  SBF_FIELD_KIND_COUNT = 4
} sbf_field_kind;

/* A field of acceleration. */
typedef struct sbf_force_field {
  const char *id;       /* Identity. */
  const char *name;     /* Name for people. */
  sbf_field_kind kind;  /* Shape. */
  sbf_vec3 position;    /* Centre. [m] */
  sbf_vec3 direction;   /* Axis of uniform and vortex, of any length. */
  float strength;       /* At the centre; radial: away from it; drag: against a speed of 1 m/s. [m/s^2] */
  float radius;         /* Distance beyond which there is no force; 0: unlimited. [m; [0, inf)] */
  float falloff;        /* Power p with which strength falls: it is divided by (1 + d)^p, d metres from the centre.
                         * [[0, inf)] */
} sbf_force_field;
typedef struct sbf_force_field_list { const sbf_force_field *at; uint32_t count; } sbf_force_field_list;

/* Gravity, wind, medium and fields. */
typedef struct sbf_environment {
  sbf_vec3 gravity;             /* Acceleration. [m/s^2; default 0,-9.81,0] */
  sbf_vec3 wind;                /* Velocity of the medium. [m/s] */
  float media_density;          /* For drag on faces. [kg/m^3; [0, inf)] */
  float media_friction;         /* Added to each body's. [1/s; [0, inf)] */
  float control_tick;           /* Time between two control ticks. [s; (0, 1]; default 0.016666668] */
  sbf_force_field_list fields;  /* Force fields. */
  bool has_water;               /* There is water; swimmers stay below its surface. [default false] */
  float water_level;            /* Height of the water surface. [m] */
} sbf_environment;
typedef struct sbf_environment_list { const sbf_environment *at; uint32_t count; } sbf_environment_list;

/* Sets every field to its default, lists to empty, references to SBF_NONE. */
SBF_API void sbf_force_field_init(sbf_force_field *force_field);
SBF_API void sbf_environment_init(sbf_environment *environment);

/* The name of a value in files, or "?" if it is out of range. */
SBF_API const char *sbf_field_kind_name(sbf_field_kind value);

// clang-format on

#ifdef __cplusplus
}
#endif
#endif
