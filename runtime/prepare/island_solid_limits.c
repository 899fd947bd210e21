/* Strain limits, yield and tear of the tetrahedra of an island, in the order of its blocks. */
#include "prepare/island_maker.h"

/* Factors of weight maps on the strains of a body. */
typedef struct solid_factors {
  const float *yield, *tear;
} solid_factors;

static bool is_bounded(const sbf_attributes *is) {
  return is->strain_min > -1 || is->strain_max > 0 || is->tear_strain > 0 ||
         (is->yield_strain > 0 && is->yield_flow > 0);
}

/* While every stretch s is within 1 - d and 1 + d, no limit is exceeded; otherwise some (s^2 - 1)^2 is above
 * (2 d - d^2)^2. */
static float square_below(const sbri_solid_limits *limits, uint32_t lane) {
  float nearest = 1;
  if (limits->min[lane] > -1 && -limits->min[lane] < nearest) nearest = -limits->min[lane];
  if (limits->max[lane] > 0 && limits->max[lane] < nearest) nearest = limits->max[lane];
  if (limits->rate[lane] > 0 && limits->yield[lane] < nearest) nearest = limits->yield[lane];
  if (limits->tear[lane] > 0 && limits->tear[lane] < nearest) nearest = limits->tear[lane];
  float squares = nearest * (2 - nearest);
  return squares * squares;
}

static void fill_lane(sbri_solid_limits *limits, uint32_t lane, const sbri_body *body,
    const solid_factors *by, const uint32_t *corners) {
  const sbf_attributes *is = &body->source->attributes;
  limits->min[lane] = is->strain_min, limits->max[lane] = is->strain_max;
  limits->yield[lane] = is->yield_strain * sbri_factor_of(by->yield, corners);
  limits->rate[lane] = limits->yield[lane] > 0 ? is->yield_flow : 0;
  limits->tear[lane] = is->tear_strain * sbri_factor_of(by->tear, corners);
  limits->square[lane] = square_below(limits, lane);
}

static bool find_factors(sbri_island_maker *m, solid_factors *factors) {
  for (uint32_t b = 0; b < m->island->body_count; b++) {
    const sbri_body *body = sbri_maker_body(m, b);
    if (body->elements.tetrahedron_count == 0) continue;
    if (!sbri_factors_find(m, body, SBF_WEIGHT_PROPERTY_YIELD_STRAIN, &factors[b].yield) ||
        !sbri_factors_find(m, body, SBF_WEIGHT_PROPERTY_TEAR_STRAIN, &factors[b].tear))
      return false;
  }
  return true;
}

bool sbri_solid_limits_make(sbri_island_maker *m) {
  sbri_island *island = m->island;
  bool bounded = false;
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = sbri_maker_body(m, b);
    bounded = bounded || (body->elements.tetrahedron_count && is_bounded(&body->source->attributes));
  }
  if (!bounded) return true;
  sbri_solid_limits *limits = sbri_model_allocate(m, island->tetrahedra.dense_count, sizeof *limits);
  uint32_t *elements =
      sbri_model_allocate(m, (size_t)island->tetrahedra.dense_count * SBRI_BLOCK, sizeof *elements);
  solid_factors *factors = sbri_scratch(m, island->body_count, sizeof *factors);
  if (!limits || !elements || !factors || !find_factors(m, factors)) return false;
  for (uint32_t i = 0; i < island->tetrahedra.dense_count * SBRI_BLOCK; i++) {
    limits[i / SBRI_BLOCK].min[i % SBRI_BLOCK] = -1;
    limits[i / SBRI_BLOCK].square[i % SBRI_BLOCK] = INFINITY;
  }
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = sbri_maker_body(m, b);
    for (uint32_t t = 0; t < body->elements.tetrahedron_count; t++) {
      uint32_t at = island->tetrahedra.lanes[2 * (body->elements.first_tetrahedron + t)],
               lane = at % SBRI_BLOCK;
      sbri_solid_limits *to = &limits[at / SBRI_BLOCK];
      elements[at] = body->elements.first_tetrahedron + t;
      if (!is_bounded(&body->source->attributes)) continue;
      fill_lane(to, lane, body, &factors[b], body->level->lattice.tetrahedra.at[t].at);
      island->tetrahedra.are_limited =
          island->tetrahedra.are_limited || to->min[lane] > -1 || to->max[lane] > 0;
      island->tetrahedra.flow = island->tetrahedra.flow || to->rate[lane] > 0 || to->tear[lane] > 0;
    }
  }
  island->tetrahedra.limits = limits, island->tetrahedra.of_lane = elements;
  return true;
}
