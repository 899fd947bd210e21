#include "prepare/softening.h"

#include <math.h>

#include "mechanics/neo_hookean.h"
#include "mechanics/network.h"
#include "soft/solvers/scheme.h"

enum { POWER_ITERATIONS = 40, MAX_ROUNDS = 8 };

/* Margin of the power iteration, whose estimate is a lower bound. */
static const double POWER_MARGIN = 1.03;

/* Poisson's ratio down to which the bulk modulus is reduced. */
static const double MIN_POISSON = 0.35;

/* Tolerance of the body's fastest mode below the limit, as a fraction; the search aims at its middle. */
static const double NEAR_ENOUGH = 0.97, AIM = 0.985;

double sbri_fastest(const sbf_spring_network *network, double *scratch) {
  return POWER_MARGIN * sbf_network_highest(network, POWER_ITERATIONS, scratch);
}

/* The maximum w for which a tick is within the budget. */
static double find_limit(void) {
  sbri_island of = {.tetrahedra = {.count = 1}};
  double low = 0, high = 1e6;
  for (int i = 0; i < 60; i++) {
    of.stability.fastest_rad_s = 0.5 * (low + high),
    of.stability.bound_rad_s = 2 * of.stability.fastest_rad_s;
    bool fits = sbri_stable_substeps(&of, 1.0 / 60, 0) <= SBRI_MAX_SUBSTEPS;
    *(fits ? &low : &high) = of.stability.fastest_rad_s;
  }
  return low;
}

/* Volume of the tetrahedra at each point. */
static void add_volumes(const sbf_spring_network *network, double *volumes) {
  sbfi_tetrahedron element;
  for (uint32_t t = 0; t < network->tetrahedron_count; t++)
    for (int k = 0; k < 4 && sbfi_network_tetrahedron(network, t, &element); k++)
      volumes[network->tetrahedra[t].at[k]] += element.volume;
}

/* The square of an element's fastest mode per Pa of 3 lambda + 2 mu: V |G| over the smallest mass of a
 * corner, |G| the Frobenius norm of the Gram matrix of its shape functions' gradients; 0: all its corners are
 * pinned. */
static double find_square_per_pa(
    const sbf_spring_network *network, uint32_t t, const sbfi_tetrahedron *element, const double *volumes) {
  double gram = 0, mass = 0;
  for (int i = 0; i < 4; i++) {
    uint32_t point = network->tetrahedra[t].at[i];
    double of = network->masses[point] * element->volume / volumes[point];
    if (of > 0 && (mass == 0 || of < mass)) mass = of;
    for (int j = 0; j < 4; j++) {
      double product = sbfi_d3_dot(element->gradients[i], element->gradients[j]);
      gram += product * product;
    }
  }
  return mass > 0 ? element->volume * sqrt(gram) / mass : 0;
}

/* Reduces Young's modulus and Poisson's ratio so that 3 lambda + 2 mu is at most `max`; updates the minimum
 * remaining fractions of the shear and bulk moduli in the island. */
static void soften_element(sbri_island *island, float *young, float *poisson, double max) {
  double e = (double)*young, nu = (double)*poisson;
  double mu = e / (2 * (1 + nu)), lambda = 2 * mu * nu / (1 - 2 * nu), bulk = lambda + 2 * mu / 3;
  double min = mu * 2 * MIN_POISSON / (1 - 2 * MIN_POISSON), wanted = (max - 2 * mu) / 3, fraction = 1;
  if (!(3 * lambda + 2 * mu > max)) return;
  if (wanted < min) {
    wanted = lambda < min ? lambda : min;
    fraction = max / (3 * wanted + 2 * mu);
  }
  double ratio = 0.5 * wanted / (wanted + mu), bulk_fraction = fraction * (wanted + 2 * mu / 3) / bulk;
  *poisson = (float)ratio, *young = (float)(2 * fraction * mu * (1 + ratio));
  if ((float)fraction < island->stability.softened_shear) island->stability.softened_shear = (float)fraction;
  if ((float)bulk_fraction < island->stability.softened_bulk)
    island->stability.softened_bulk = (float)bulk_fraction;
}

/* Stated material of an element, and the bound of 3 lambda + 2 mu. */
typedef struct stated_element {
  float young, poisson;
  double square_per_pa;
} stated_element;

static void soften_all(sbri_island *island, const stated_element *stated, uint32_t count, double cap,
    float *young, float *poisson) {
  island->stability.softened_shear = island->stability.softened_bulk = 1;
  for (uint32_t t = 0; t < count; t++) {
    young[t] = stated[t].young, poisson[t] = stated[t].poisson;
    if (stated[t].square_per_pa > 0)
      soften_element(island, &young[t], &poisson[t], cap / stated[t].square_per_pa);
  }
}

static void copy_to_bodies(sbri_island_maker *m, const sbf_spring_network *network) {
  for (uint32_t b = 0; b < m->island->body_count; b++) {
    const sbri_body *body = sbri_maker_body(m, b);
    for (uint32_t t = 0; t < body->elements.tetrahedron_count; t++) {
      body->elements.moduli[t] = network->young_modulus[body->elements.first_tetrahedron + t];
      body->elements.poisson_ratios[t] = network->poisson_ratios[body->elements.first_tetrahedron + t];
    }
  }
}

bool sbri_soften(sbri_island_maker *m, sbf_spring_network *network, double *scratch) {
  uint32_t count = network->tetrahedron_count;
  double limit = find_limit(), fastest;
  m->island->stability.softened_shear = m->island->stability.softened_bulk = 1;
  bool swept = m->island->scheme == &sbri_position_based && !m->island->stepping.substeps;
  if (!(m->island->stepping.is_routed || swept) || count == 0 || sbri_fastest(network, scratch) <= limit)
    return true;
  double *volumes = sbri_scratch(m, network->point_count, sizeof *volumes);
  stated_element *stated = sbri_scratch(m, count, sizeof *stated);
  float *young = sbri_scratch(m, count, sizeof *young), *poisson = sbri_scratch(m, count, sizeof *poisson);
  if (!volumes || !stated || !young || !poisson) return false;
  add_volumes(network, volumes);
  for (uint32_t t = 0; t < count; t++) {
    sbfi_tetrahedron element;
    stated[t] = (stated_element){network->young_modulus[t], network->poisson_ratios[t], 0};
    if (sbfi_network_tetrahedron(network, t, &element))
      stated[t].square_per_pa = find_square_per_pa(network, t, &element, volumes);
  }
  network->young_modulus = young, network->poisson_ratios = poisson;
  double cap = limit * limit; /* certainly sufficient; raised below */
  for (int round = 0; round < MAX_ROUNDS; round++) {
    soften_all(m->island, stated, count, cap, young, poisson);
    fastest = sbri_fastest(network, scratch);
    if (fastest <= limit && fastest >= NEAR_ENOUGH * limit) break;
    cap *= AIM * limit / fastest * (AIM * limit / fastest);
  }
  copy_to_bodies(m, network);
  return true;
}
