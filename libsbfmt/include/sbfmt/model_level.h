/* Simulation levels: points, elastic model, embeddings, stepping. Part of sbfmt/model.h, which documents the common
 * conventions.
 *
 * Made from spec/sbf.schema by spec/generate/generate.py: change the schema, not this file. */
#ifndef SBFMT_MODEL_LEVEL_H
#define SBFMT_MODEL_LEVEL_H

#include "sbfmt/model_pins.h"
#include "sbfmt/model_elastic.h"

#ifdef __cplusplus
extern "C" {
#endif

// clang-format off

/* Values of elastic_model; sbf_elastic_model_name returns their names in files. */
typedef enum sbf_elastic_model {
  SBF_ELASTIC_MODEL_SPRINGS = 0,
  SBF_ELASTIC_MODEL_TETRAHEDRA = 1,
  SBF_ELASTIC_MODEL_SHAPE_MATCHING = 2,
  SBF_ELASTIC_MODEL_JIGGLE = 3,
  SBF_ELASTIC_MODEL_COUNT = 4
} sbf_elastic_model;

/* Values of scheme; sbf_scheme_name returns their names in files. */
typedef enum sbf_scheme {
  SBF_SCHEME_AUTOMATIC = 0,
  SBF_SCHEME_SYMPLECTIC = 1,
  SBF_SCHEME_POSITION_BASED = 2,
  SBF_SCHEME_RELAXATION = 3,
  SBF_SCHEME_EXPLICIT_EULER = 4,
  SBF_SCHEME_HEUN = 5,
  SBF_SCHEME_BLOCK_DESCENT = 6,
  SBF_SCHEME_COUNT = 7
} sbf_scheme;

/* Attaches vertices to the level's points. */
typedef struct sbf_embedding {
  int32_t render_mesh;    /* Mesh; absent: the body's own surface. [index into asset.render_meshes, or SBF_NONE] */
  sbf_u32_list vertices;  /* Vertices; empty: all, in order. */
  sbf_uint4_list points;  /* Four points of the level for each vertex. [index into parent.positions] */
  sbf_vec4_list weights;  /* Weights that sum to one; outside 0..1 for vertices outside. [length points] */
  sbf_f32_list blends;    /* Weight of this body for a vertex of several; empty: 1. [[0, 1]; length 0 or points] */
  int32_t derived;        /* Derivation, if `build` made it. [index into asset.derivations, or SBF_NONE] */
} sbf_embedding;
typedef struct sbf_embedding_list { const sbf_embedding *at; uint32_t count; } sbf_embedding_list;

/* A time on a machine. */
typedef struct sbf_measured {
  const char *machine;  /* Machine. */
  float microseconds;   /* Time of a control tick on one thread. [us; [0, inf)] */
} sbf_measured;
typedef struct sbf_measured_list { const sbf_measured *at; uint32_t count; } sbf_measured_list;

/* How to step a level. */
typedef struct sbf_simulation {
  sbf_scheme scheme;           /* Method. [default automatic] */
  uint32_t substeps;           /* Substeps of a control tick; 0: as many as needed. */
  float error;                 /* Error against a converged reference; 0: not measured. [m; [0, inf)] */
  float cost;                  /* Element visits in a control tick; 0: unknown. [[0, inf)] */
  sbf_measured_list measured;  /* Times on machines. */
  float step_error;            /* Error of a step, for schemes that control it; 0: the host's choice. [m; [0, inf)] */
  uint32_t substeps_least;     /* Minimum of such steps in a control tick; 0: none. */
  uint32_t substeps_most;      /* Maximum of such steps in a control tick; 0: none. */
  float motion_error;          /* Maximum error of the skin in motion, all bodies on such levels; 0: not measured.
                                * [m; [0, inf)] */
  float motion_error_rms;      /* The same as root mean square over vertices and time. [m; [0, inf)] */
} sbf_simulation;
typedef struct sbf_simulation_list { const sbf_simulation *at; uint32_t count; } sbf_simulation_list;

/* Factors on a level's moduli or stiffnesses, and the errors left. */
typedef struct sbf_calibration {
  uint32_t reference_elements;  /* Tetrahedra of the reference lattice. */
  float factor;                 /* Mean factor on the moduli, by volume; or on inner springs. [(0, inf); default 1] */
  float surface_factor;         /* Mean factor on surface springs. [(0, inf); default 1] */
  float residual;               /* Relative error under small loads: of lattices the maximum over loads of the surface's
                                 * mean, of springs the root mean square at surface points. [[0, inf)] */
  float period_error;           /* Relative error of the period. */
  sbf_f32_list load_errors;     /* Of lattices: relative error of the displacement under each fitted load: gravity along
                                 * x, y and z; of a loose body six bends and stretch along x, y and z. */
  sbf_f32_list twist_errors;    /* Of lattices: the same for twists about x, y and z; empty: not measured. */
} sbf_calibration;
typedef struct sbf_calibration_list { const sbf_calibration *at; uint32_t count; } sbf_calibration_list;

/* A simulation level: points, one elastic model, pins, embeddings. */
typedef struct sbf_level {
  const char *name;                    /* Name for people. */
  sbf_elastic_model model;             /* Elastic model. [default springs] */
  int32_t derived;                     /* Derivation, if `build` made it. [index into asset.derivations, or SBF_NONE] */
  float cell;                          /* Edge length of the elements; 0: unknown. [m; [0, inf)] */
  sbf_vec3_list positions;             /* Points at rest; levels of springs begin with the surface's points. [m] */
  sbf_u32_list new_from_old;           /* Index in this level of each source point, if the order differs; 4294967295:
                                        * none. */
  sbf_f32_list masses;                 /* Mass of each point; empty: specification, chapter 9.
                                        * [kg; [0, inf); length 0 or positions] */
  sbf_tetrahedron_mesh lattice;        /* Tetrahedra. */
  sbf_spring_set_list springs;         /* Springs. */
  const sbf_shape_regions *regions;    /* Shape matching. */
  const sbf_jiggle *jiggle;            /* Follower of the whole body. */
  sbf_pin_set_list pins;               /* Pins. */
  sbf_embedding_list embeddings;       /* Embedded meshes. */
  sbf_simulation simulation;           /* Stepping, error and cost. */
  const sbf_calibration *calibration;  /* Calibration record. */
} sbf_level;
typedef struct sbf_level_list { const sbf_level *at; uint32_t count; } sbf_level_list;

/* The relaxation scheme of the reference lizard: per tick, dimensionless. */
typedef struct sbf_relaxation {
  float stiffness;  /* Fraction of a spring's error corrected in a visit. [[0, 1]; default 0.3] */
  float damping;    /* Fraction of motion left after a tick. [[0, 1]; default 0.9] */
  float gravity;    /* Displacement added in a tick. [m; default 0.001] */
} sbf_relaxation;
typedef struct sbf_relaxation_list { const sbf_relaxation *at; uint32_t count; } sbf_relaxation_list;

/* Sets every field to its default, lists to empty, references to SBF_NONE. */
SBF_API void sbf_embedding_init(sbf_embedding *embedding);
SBF_API void sbf_measured_init(sbf_measured *measured);
SBF_API void sbf_simulation_init(sbf_simulation *simulation);
SBF_API void sbf_calibration_init(sbf_calibration *calibration);
SBF_API void sbf_level_init(sbf_level *level);
SBF_API void sbf_relaxation_init(sbf_relaxation *relaxation);

/* The name of a value in files, or "?" if it is out of range. */
SBF_API const char *sbf_elastic_model_name(sbf_elastic_model value);
SBF_API const char *sbf_scheme_name(sbf_scheme value);

// clang-format on

#ifdef __cplusplus
}
#endif
#endif
