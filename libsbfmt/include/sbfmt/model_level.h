/* One way to simulate a soft body: its points and elastic model, what it carries, and how it is stepped. A chapter of
 * sbfmt/model.h, which says what holds for all of them.
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

/* Words of elastic_model, in the file's spelling by sbf_elastic_model_name. */
typedef enum sbf_elastic_model {
  SBF_ELASTIC_MODEL_SPRINGS = 0,
  SBF_ELASTIC_MODEL_TETRAHEDRA = 1,
  SBF_ELASTIC_MODEL_SHAPE_MATCHING = 2,
  SBF_ELASTIC_MODEL_JIGGLE = 3,
  SBF_ELASTIC_MODEL_COUNT = 4
} sbf_elastic_model;

/* Words of scheme, in the file's spelling by sbf_scheme_name. */
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

/* Carries vertices by the level's points. */
typedef struct sbf_embedding {
  int32_t render_mesh;    /* Whose vertices; absent: the body's own surface.
                           * [index into asset.render_meshes, or SBF_NONE] */
  sbf_u32_list vertices;  /* Which vertices; empty: all, in order. */
  sbf_uint4_list points;  /* Four points of the level for each vertex. [index into parent.positions] */
  sbf_vec4_list weights;  /* Their weights, summing to one; outside 0..1 where the vertex lies outside.
                           * [length points] */
  sbf_f32_list blends;    /* Share of this body in a vertex that several carry; empty: 1.
                           * [[0, 1]; length 0 or points] */
  int32_t derived;        /* Set where `build` made it. [index into asset.derivations, or SBF_NONE] */
} sbf_embedding;
typedef struct sbf_embedding_list { const sbf_embedding *at; uint32_t count; } sbf_embedding_list;

/* A time on one machine. */
typedef struct sbf_measured {
  const char *machine;  /* Which. */
  float microseconds;   /* For a control tick, one thread. [us; [0, inf)] */
} sbf_measured;
typedef struct sbf_measured_list { const sbf_measured *at; uint32_t count; } sbf_measured_list;

/* How to step a level. */
typedef struct sbf_simulation {
  sbf_scheme scheme;           /* Method. [default automatic] */
  uint32_t substeps;           /* Of a control tick; 0: as many as the scheme needs. */
  float error;                 /* Measured against the converged reference; 0: not measured. [m; [0, inf)] */
  float cost;                  /* Element visits in a control tick; 0: not known. [[0, inf)] */
  sbf_measured_list measured;  /* Times on machines. */
  float step_error;            /* Of schemes that control their error: how large a step's may be; 0: the host's choice.
                                * [m; [0, inf)] */
  uint32_t substeps_least;     /* Of a control tick, of schemes that control their error; 0: no bound. */
  uint32_t substeps_most;      /* The same; 0: no bound. */
  float motion_error;          /* Of the character's skin as it moves, all bodies on such levels, at its worst place and
                                * moment; 0: not measured. [m; [0, inf)] */
  float motion_error_rms;      /* The same, root of the mean square over its vertices and moments. [m; [0, inf)] */
} sbf_simulation;
typedef struct sbf_simulation_list { const sbf_simulation *at; uint32_t count; } sbf_simulation_list;

/* What a level's moduli or stiffnesses were multiplied by, and how near that brought it. */
typedef struct sbf_calibration {
  uint32_t reference_elements;  /* Tetrahedra of the lattice it was compared with. */
  float factor;                 /* On the moduli, on the mean of the volume; or on the stiffness of springs inside, on
                                 * their mean. [(0, inf); default 1] */
  float surface_factor;         /* On the stiffness of springs over the surface, on their mean. [(0, inf); default 1] */
  float residual;               /* Share by which it still gives otherwise under small loads: of lattices the most that
                                 * the mean over the surface is off under one of them, of springs the root of the mean
                                 * square of what is left at the surface's points. [[0, inf)] */
  float period_error;           /* Share by which it swings slower. */
  sbf_f32_list load_errors;     /* Of lattices: share by which it gives more (above 0) or less under each small load
                                 * that it was fitted to, gravity along x, y and z; or bent in six ways, where nothing
                                 * holds the body. */
  sbf_f32_list twist_errors;    /* Of lattices: the same, twisted about x, y and z; empty: not measured. */
} sbf_calibration;
typedef struct sbf_calibration_list { const sbf_calibration *at; uint32_t count; } sbf_calibration_list;

/* One way to simulate a body: points, one elastic model, pins, embeddings. */
typedef struct sbf_level {
  const char *name;                    /* Name for people. */
  sbf_elastic_model model;             /* The one model that carries the shape. [default springs] */
  int32_t derived;                     /* Set where `build` made it. [index into asset.derivations, or SBF_NONE] */
  float cell;                          /* Edge length the elements were made with; 0: not known. [m; [0, inf)] */
  sbf_vec3_list positions;             /* Points at rest; they begin with the surface's points where the model is
                                        * springs. [m] */
  sbf_u32_list new_from_old;           /* Place in this level of each source point, where the order differs; 4294967295:
                                        * the level does not have it. */
  sbf_f32_list masses;                 /* Of each point; empty: by the rules of the specification.
                                        * [kg; [0, inf); length 0 or positions] */
  sbf_tetrahedron_mesh lattice;        /* Tetrahedra. */
  sbf_spring_set_list springs;         /* Springs. */
  const sbf_shape_regions *regions;    /* Shape matching. */
  const sbf_jiggle *jiggle;            /* One follower for the whole body. */
  sbf_pin_set_list pins;               /* What holds it. */
  sbf_embedding_list embeddings;       /* Meshes carried by it. */
  sbf_simulation simulation;           /* How to step it, with the error and the cost of doing so. */
  const sbf_calibration *calibration;  /* How it was made to give as its matter does. */
} sbf_level;
typedef struct sbf_level_list { const sbf_level *at; uint32_t count; } sbf_level_list;

/* The relaxation scheme of the reference lizard: per tick, dimensionless. */
typedef struct sbf_relaxation {
  float stiffness;  /* Share of a spring's error corrected in a visit. [[0, 1]; default 0.3] */
  float damping;    /* Share of a tick's motion that is kept. [[0, 1]; default 0.9] */
  float gravity;    /* Fall added in a tick. [m; default 0.001] */
} sbf_relaxation;
typedef struct sbf_relaxation_list { const sbf_relaxation *at; uint32_t count; } sbf_relaxation_list;

/* Every field at its default, lists empty, references SBF_NONE. */
SBF_API void sbf_embedding_init(sbf_embedding *embedding);
SBF_API void sbf_measured_init(sbf_measured *measured);
SBF_API void sbf_simulation_init(sbf_simulation *simulation);
SBF_API void sbf_calibration_init(sbf_calibration *calibration);
SBF_API void sbf_level_init(sbf_level *level);
SBF_API void sbf_relaxation_init(sbf_relaxation *relaxation);

/* The word the format uses for a value, or "?" for one out of range. */
SBF_API const char *sbf_elastic_model_name(sbf_elastic_model value);
SBF_API const char *sbf_scheme_name(sbf_scheme value);

// clang-format on

#ifdef __cplusplus
}
#endif
#endif
