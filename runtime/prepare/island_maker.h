/* State of building an island. */
#ifndef SBRI_ISLAND_MAKER_H
#define SBRI_ISLAND_MAKER_H

#include "prepare/prepare.h"

/* A pin with a weight below 1: a spring of rest length 0 to a pinned slot of its own. */
typedef struct sbri_goal {
  uint32_t body, point, set, frame; /* body: index in the island */
  float stiffness, damping;
  sbf_vec3 position;
} sbri_goal;

typedef struct sbri_island_maker {
  sbr_model *model;
  sbri_island *island;
  const sbr_model_options *options;
  sbfi_arena scratch;   /* until the island is built */
  uint32_t **frames;    /* of each body, (points): pin frame of each point */
  sbf_vec3 **positions; /* and its position */
  float **masses;       /* (points) kg */
  sbfi_array goals;     /* sbri_goal */
  uint32_t first_goal;  /* slot of the first goal's far end */
  sbfi_array springs;   /* sbfi_spring, while springs are listed */
  sbfi_array bounds;    /* sbfi_spring_bounds of each */
  bool states_rest_lengths;
  sbri_point *rest; /* the island's own tables, while they are filled */
  sbfi_spring *listed;
} sbri_island_maker;

static inline void *sbri_scratch(sbri_island_maker *m, size_t count, size_t size) {
  return sbfi_arena_allocate(&m->scratch, count ? count : 1, size);
}
static inline void *sbri_model_allocate(sbri_island_maker *m, size_t count, size_t size) {
  return sbfi_arena_allocate(&m->model->arena, count ? count : 1, size);
}
static inline sbri_body *sbri_maker_body(const sbri_island_maker *m, uint32_t index) {
  return &m->model->bodies[m->island->bodies[index]];
}

/* Young's modulus times the edge of the cube of material that a point represents: the stiffness of springs
 * without a stated one and without a length to derive it from. */
float sbri_natural_stiffness(const sbf_soft_body *body, float mass);

/* All return false if memory runs out. */
/* Response of the island to the rigid body that it is attached to, if that is a single one. */
bool sbri_attached_responses_make(sbri_island_maker *m, const sbf_spring_network *network);
/* Factors of weight maps on a property, at the points of the body's level; NULL: 1 everywhere. */
bool sbri_factors_find(
    sbri_island_maker *m, const sbri_body *body, sbf_weight_property property, const float **factors);
/* Their mean over the corners of a tetrahedron. */
static inline float sbri_factor_of(const float *factors, const uint32_t corners[4]) {
  return factors
             ? 0.25f * (factors[corners[0]] + factors[corners[1]] + factors[corners[2]] + factors[corners[3]])
             : 1;
}
/* Strain limits, yield and tear of the tetrahedra, in the order of the blocks; call after these. */
bool sbri_solid_limits_make(sbri_island_maker *m);
bool sbri_tetrahedra_list(sbri_island_maker *m); /* lists active tetrahedra and their moduli */
/* The island's tetrahedra for a network over its slots; the arrays are scratch. */
bool sbri_tetrahedra_network(sbri_island_maker *m, sbf_spring_network *network);
/* Ranges of elements, one per task that computes their forces; a single one if they are few. */
typedef struct sbri_element_parts {
  uint32_t count;
  uint32_t begins[SBRI_MAX_PARTS + 1];
} sbri_element_parts;
/* Orders the tetrahedra (island count) by part. `corners` are slots. */
bool sbri_element_parts_find(
    sbri_island_maker *m, const sbf_uint4 *corners, uint32_t *ordered, sbri_element_parts *parts);
/* Builds the blocks from `network`. */
bool sbri_tetrahedra_make(sbri_island_maker *m, const sbf_spring_network *network);
/* Regions of shape matching bodies; sets `region_rad_s` to the highest frequency. */
bool sbri_regions_make(sbri_island_maker *m);
/* Lowest angular frequency of the body's regions at rest, linearised, with fixed pinned points and without
 * rigid motion; `scratch` has 9 doubles per slot of the island. */
double sbri_regions_lowest(const sbri_island *island, const sbri_body *body, double *scratch);
bool sbri_island_springs(sbri_island_maker *m); /* lists them, finds frequencies and damping, builds tables */
/* Sets rest lengths so that springs support the weight, if the bodies request it and are pinned. */
bool sbri_island_preload(sbri_island_maker *m, const sbf_spring_network *network);

#endif
