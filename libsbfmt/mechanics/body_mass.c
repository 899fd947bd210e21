/* Computes volume and mass of a body, the pinned points of a level, and the distribution of mass over the
 * others. */
#include "mechanics/level_points.h"
#include "mechanics/polygon.h"
#include "sbfmt/mechanics.h"

static const double sheet_opening = 0.25, flat_opening = 1e-3, flat_volume = 0.005,
                    pi = 3.14159265358979323846;

void sbf_body_measure(const sbf_soft_body *body, sbf_body_measures *measures) {
  const sbf_attributes *is = &body->attributes;
  sbf_surface_measures surface;
  sbf_surface_measure(&body->surface, NULL, &surface);
  double enclosed = fabs(surface.volume), area = surface.area;
  bool flat = surface.opening > flat_opening && enclosed < flat_volume * area * sqrt(area);
  bool sheet = is->area_density > 0 || surface.opening > sheet_opening || flat;
  double volume = sheet ? area * is->thickness : enclosed;
  double density_mass = sheet && is->area_density > 0 ? area * is->area_density : volume * is->density;
  *measures = (sbf_body_measures){
      .area = area, .volume = volume, .mass = is->mass > 0 ? is->mass : density_mass, .sheet = sheet};
  if (sheet)
    measures->depth = sqrt(area / (4 * pi));
  else if (area > 0)
    measures->depth = 3 * volume / area;
}

uint32_t sbf_level_pinned_points(const sbf_level *level, uint8_t *pinned) {
  uint32_t count = 0;
  for (uint32_t i = 0; i < level->positions.count; i++) pinned[i] = 0;
  for (uint32_t s = 0; s < level->pins.count; s++) {
    const sbf_pin_set *set = &level->pins.at[s];
    for (uint32_t i = 0; i < set->points.count; i++) {
      float weight = set->weights.count == 0 ? 1 : set->weights.at[set->weights.count == 1 ? 0 : i];
      if (weight < set->minimum) weight = set->minimum;
      if (weight > set->maximum) weight = set->maximum;
      if (weight >= 1) pinned[set->points.at[i]] = 1;
    }
  }
  for (uint32_t i = 0; i < level->positions.count; i++) count += pinned[i];
  return count;
}

/* Adds tributary areas of the surface's points to their points in the level. */
static void add_areas(const sbf_soft_body *body, const sbf_level *level, float *areas) {
  const sbf_polygon_mesh *mesh = &body->surface;
  const uint32_t *corners = mesh->polygon_points.at;
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; corners += mesh->polygon_sizes.at[p++]) {
    uint32_t size = mesh->polygon_sizes.at[p];
    sbfi_d3 middle = sbfi_polygon_middle(mesh->positions.at, corners, size);
    float fraction =
        (float)(sbfi_d3_length(sbfi_polygon_area(mesh->positions.at, corners, size, middle)) / size);
    for (uint32_t k = 0; k < size; k++) {
      uint32_t point = sbfi_level_point(level, corners[k]);
      if (point != UINT32_MAX) areas[point] += fraction;
    }
  }
}

void sbf_level_mass_fractions(
    const sbf_soft_body *body, const sbf_level *level, const uint8_t *pinned, float *fractions) {
  uint32_t count = level->positions.count, with_area = 0;
  for (uint32_t i = 0; i < count; i++) fractions[i] = 0;
  add_areas(body, level, fractions);
  double all = 0, sum = 0;
  for (uint32_t i = 0; i < count; i++) {
    all += fractions[i];
    with_area += fractions[i] > 0;
  }
  float mean = with_area ? (float)(all / with_area) : 1;
  for (uint32_t i = 0; i < count; i++) {
    if (pinned && pinned[i])
      fractions[i] = 0;
    else if (!(fractions[i] > 0))
      fractions[i] = mean;
    sum += fractions[i];
  }
  for (uint32_t i = 0; i < count && sum > 0; i++) fractions[i] = (float)(fractions[i] / sum);
}

static void add_tetrahedra(const sbf_soft_body *body, const sbf_level *level, float *masses) {
  const sbf_tetrahedron_mesh *lattice = &level->lattice;
  for (uint32_t t = 0; t < lattice->tetrahedra.count; t++) {
    const uint32_t *at = lattice->tetrahedra.at[t].at;
    sbfi_d3 edges[3];
    for (int k = 0; k < 3; k++)
      edges[k] =
          sbfi_d3_sub(sbfi_d3_of(level->positions.at[at[k + 1]]), sbfi_d3_of(level->positions.at[at[0]]));
    double volume = sbfi_d3_dot(edges[0], sbfi_d3_cross(edges[1], edges[2])) / 6;
    double density = body->attributes.density;
    if (lattice->densities.count > 0) density = lattice->densities.at[lattice->densities.count == 1 ? 0 : t];
    for (int k = 0; k < 4; k++) masses[at[k]] += (float)(density * volume / 4);
  }
}

static void distribute_mass(
    const sbf_soft_body *body, const sbf_level *level, const uint8_t *pinned, float *masses) {
  sbf_body_measures measures;
  sbf_body_measure(body, &measures);
  double mass = measures.mass;
  sbf_level_mass_fractions(body, level, pinned, masses);
  if (!(mass > 0)) {
    double radius = body->collision.particle_radius > 0 ? body->collision.particle_radius : 0.01;
    double ball = 4.0 / 3 * pi * radius * radius * radius * body->attributes.density;
    for (uint32_t i = 0; i < level->positions.count; i++) mass += masses[i] > 0 ? ball : 0;
  }
  for (uint32_t i = 0; i < level->positions.count; i++) masses[i] = (float)(masses[i] * mass);
  sbfi_level_weigh(body, level, SBF_WEIGHT_PROPERTY_DENSITY, masses);
}

double sbf_level_masses(
    const sbf_soft_body *body, const sbf_level *level, const uint8_t *pinned, float *masses) {
  uint32_t count = level->positions.count;
  double sum = 0, stated = body->attributes.mass;
  if (level->masses.count == 0 && level->lattice.tetrahedra.count == 0) {
    distribute_mass(body, level, pinned, masses);
  } else {
    for (uint32_t i = 0; i < count; i++) masses[i] = level->masses.count ? level->masses.at[i] : 0;
    if (level->masses.count == 0) {
      add_tetrahedra(body, level, masses);
      /* Densities of the lattice already include the maps. */
      if (level->lattice.densities.count < 2)
        sbfi_level_weigh(body, level, SBF_WEIGHT_PROPERTY_DENSITY, masses);
    }
  }
  for (uint32_t i = 0; i < count; i++) {
    if (pinned && pinned[i]) masses[i] = 0;
    sum += masses[i];
  }
  if (!(stated > 0) || !(sum > 0)) return sum;
  double scale = stated / sum;
  sum = 0;
  for (uint32_t i = 0; i < count; i++) sum += masses[i] = (float)(masses[i] * scale);
  return sum;
}
