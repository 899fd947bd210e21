/* What the making of an island passes from step to step. */
#ifndef SBRI_ISLAND_MAKER_H
#define SBRI_ISLAND_MAKER_H

#include "prepare/prepare.h"

/* A pin of weight below 1: a spring of no rest length to a held slot of its own. */
typedef struct sbri_goal {
  uint32_t body, point, set, frame; /* body: place in the island */
  float stiffness, damping;
  sbf_vec3 position;
} sbri_goal;

typedef struct sbri_island_maker {
  sbr_model *model;
  sbri_island *island;
  const sbr_model_options *options;
  sbfi_arena scratch;   /* until the island is made */
  uint32_t **frames;    /* of each body, (points): what holds each point */
  sbf_vec3 **positions; /* and where */
  float **masses;       /* (points) kg */
  sbfi_array goals;     /* sbri_goal */
  uint32_t first_goal;  /* slot of the first goal's far end */
  sbfi_array springs;   /* sbfi_spring, while they are listed */
  sbfi_array bounds;    /* sbfi_spring_bounds of each */
  bool states_rest_lengths;
  sbri_point *rest; /* the island's own tables, while they are filled */
  sbfi_spring *listed;
} sbri_island_maker;

static inline void *sbri_scratch(sbri_island_maker *m, size_t count, size_t size) {
  return sbfi_arena_allocate(&m->scratch, count ? count : 1, size);
}
static inline void *sbri_keep(sbri_island_maker *m, size_t count, size_t size) {
  return sbfi_arena_allocate(&m->model->arena, count ? count : 1, size);
}
static inline sbri_body *sbri_maker_body(const sbri_island_maker *m, uint32_t index) {
  return &m->model->bodies[m->island->bodies[index]];
}

/* Young's modulus times the edge of the cube of material that a point represents: the stiffness of springs
 * without a stated one and without a length to derive it from. */
float sbri_natural_stiffness(const sbf_soft_body *body, float mass);

/* Each false where memory runs out. */
/* How the island answers the rigid body that it hangs on, where that is one alone. */
bool sbri_attached_responses_make(sbri_island_maker *m, const sbf_spring_network *network);
/* What weight maps of the body make of a property, as factors at its level's points; NULL: 1 everywhere. */
bool sbri_factors_find(
    sbri_island_maker *m, const sbri_body *body, sbf_weight_property property, const float **factors);
/* Their mean at the corners of a tetrahedron. */
static inline float sbri_factor_of(const float *factors, const uint32_t corners[4]) {
  return factors
             ? 0.25f * (factors[corners[0]] + factors[corners[1]] + factors[corners[2]] + factors[corners[3]])
             : 1;
}
/* Strain limits, yield and tear of the tetrahedra, in the order of the blocks; after these. */
bool sbri_solid_limits_make(sbri_island_maker *m);
bool sbri_tetrahedra_list(sbri_island_maker *m); /* finds which act, and their moduli */
/* The island's tetrahedra for a network over its slots; the arrays are scratch. */
bool sbri_tetrahedra_network(sbri_island_maker *m, sbf_spring_network *network);
/* Lays them out; `network` has them. */
bool sbri_tetrahedra_make(sbri_island_maker *m, const sbf_spring_network *network);
/* The regions of bodies that match shapes; then w of the fastest into `region_rad_s`. */
bool sbri_regions_make(sbri_island_maker *m);
/* Lowest angular frequency of the body's regions at rest, linearised, its held points held and rigid motion
 * left out; `scratch` is of 9 doubles a slot of the island. */
double sbri_regions_lowest(const sbri_island *island, const sbri_body *body, double *scratch);
bool sbri_island_springs(sbri_island_maker *m); /* lists them, finds frequencies and damping, lays them out */
/* Sets rest lengths so that they bear the weight, where the bodies ask for it and something holds them. */
bool sbri_island_preload(sbri_island_maker *m, const sbf_spring_network *network);

#endif
