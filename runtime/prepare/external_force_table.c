/* External forces on a body: gas inside its surface, a dense medium outside, bending of sheets, and fields;
 * and their effect on the highest frequency. */
#include <string.h>

#include "math/trig.h"
#include "prepare/hinges.h"
#include "soft/solvers/surface_forces.h"

/* Fraction of its rest volume down to which a gas's stiffness, which grows with the square of the
 * compression, is bounded in advance. Below it is updated at run time (sbri_update_gas_stiffness). */
static const double MIN_GAS_FRACTION = 0.5;

static bool has_flexion(const sbf_level *level) {
  for (uint32_t s = 0; s < level->springs.count; s++)
    if (level->springs.at[s].kind == SBF_SPRING_KIND_FLEXION && level->springs.at[s].ends.count) return true;
  return false;
}

/* The hinges of a sheet that does not bend by springs. */
static bool make_hinges(sbr_model *model, sbri_body *body) {
  if (has_flexion(body->level)) return true;
  sbfi_arena scratch;
  sbfi_arena_init(&scratch, &model->arena.allocator, 0);
  bool good = sbri_hinges_find(&model->islands[body->island], body, &model->arena, &scratch,
      &body->elements.hinges, &body->elements.hinge_count);
  sbfi_arena_free(&scratch);
  return good;
}

/* ---- Frequency bounds ---- */

static float mass_inverse(const sbri_island *island, uint32_t slot) {
  return slot < island->free_count ? island->inverse_masses[slot] : 0;
}

/* Gershgorin's bound for the hinges alone, rad^2/s^2; `rows` has (slot_count) zeros. */
static double hinges_bound(const sbri_island *island, const sbri_body *body, double *rows) {
  double max = 0;
  for (uint32_t i = 0; i < body->elements.hinge_count; i++) {
    const sbri_hinge *hinge = &body->elements.hinges[i];
    sbf_vec3 x[4], gradients[4];
    double sum = 0;
    for (int k = 0; k < 4; k++) {
      const sbri_point *at = &island->rest[hinge->slots[k]];
      x[k] = sbri_vec3(at->x, at->y, at->z);
    }
    sbri_hinge_shape shape = sbri_hinge_shape_of(x);
    sbri_compute_hinge_gradients(&shape, x, gradients);
    for (int k = 0; k < 4; k++) sum += (double)sbri_length(gradients[k]);
    for (int k = 0; k < 4; k++)
      rows[hinge->slots[k]] += (double)hinge->stiffness * (double)sbri_length(gradients[k]) * sum;
  }
  for (uint32_t i = 0; i < body->elements.hinge_count; i++)
    for (int k = 0; k < 4; k++) {
      uint32_t slot = body->elements.hinges[i].slots[k];
      double square = rows[slot] * (double)mass_inverse(island, slot);
      max = square > max ? square : max;
    }
  return max;
}

/* A vertex of an embedded surface has no mass of its own; the lightest of its points is used. */
static float vertex_mass_inverse(const sbri_island *island, const sbri_skin *skin, uint32_t v) {
  float sum = 0;
  for (uint32_t c = skin->cell_begins[v / SBRI_BLOCK]; c < skin->cell_begins[v / SBRI_BLOCK + 1]; c++) {
    float w = skin->cells[c].weights[v % SBRI_BLOCK];
    uint32_t slot = skin->cells[c].slots[v % SBRI_BLOCK] - island->first_slot;
    if (w != 0) sum += w * w * mass_inverse(island, slot);
  }
  return sum;
}

/* Bound for the gas: p V0 / V^2 times the sum of w |grad V|^2, plus the rotation of the faces, p times a
 * third of the edges around a point. */
static double gas_bound(const sbri_island *island, sbri_body *body) {
  const sbri_skin *skin = &body->surface.skin;
  const sbf_polygon_mesh *mesh = &body->source->surface;
  const uint32_t *corners = mesh->polygon_points.at;
  double pressure =
             body->gas.pressure_pa > 0 ? (double)body->gas.pressure_pa : -(double)body->gas.pressure_pa,
         sum = 0, turning = 0;
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; corners += mesh->polygon_sizes.at[p++]) {
    uint32_t size = mesh->polygon_sizes.at[p];
    double around = 0;
    for (uint32_t k = 0; k < size; k++) {
      const sbf_vec3 *a = &mesh->positions.at[corners[k]], *b = &mesh->positions.at[corners[(k + 1) % size]];
      around += (double)sbri_length(sbri_sub(*b, *a));
    }
    for (uint32_t k = 0; k < size; k++) {
      double w = (double)vertex_mass_inverse(island, skin, corners[k]),
             fraction = around * around / (16 * size);
      sum += 4 * w * fraction *
             fraction; /* a point has about four faces; |grad V| is at most its parts of their areas */
      double turn = 4 * w * around / 6;
      turning = turn > turning ? turn : turning;
    }
  }
  double volume = MIN_GAS_FRACTION * body->gas.volume_m3;
  body->gas.stiffening = turning;
  pressure *= (double)body->gas.max_factor;
  return pressure * body->gas.volume_m3 / (volume * volume) * sum + pressure * turning / MIN_GAS_FRACTION;
}

/* Pressure factors at the surface's vertices, where maps scale it. */
static bool find_gas_factors(sbr_model *model, sbri_body *body) {
  const sbf_soft_body *is = body->source;
  float *factors = NULL;
  body->gas.max_factor = 1;
  for (uint32_t m = 0; m < is->weight_maps.count; m++) {
    const sbf_weight_map *map = &is->weight_maps.at[m];
    if (map->property != SBF_WEIGHT_PROPERTY_PRESSURE) continue;
    if (!factors && !(factors = sbfi_arena_allocate(
                          &model->arena, (size_t)body->surface.skin.vertex_count + 1, sizeof *factors)))
      return false;
    for (uint32_t v = 0; v < body->surface.skin.vertex_count; v++)
      factors[v] = (body->gas.factors ? factors[v] : 1) * (v < map->values.count ? map->values.at[v] : 1);
    body->gas.factors = factors;
  }
  for (uint32_t v = 0; factors && v < body->surface.skin.vertex_count; v++)
    if (v == 0 || factors[v] > body->gas.max_factor) body->gas.max_factor = factors[v];
  return true;
}

static bool make_island(sbr_model *model, sbri_island *island, sbfi_arena *scratch) {
  const sbf_environment *environment = &model->asset->environment;
  double *rows = sbfi_arena_allocate(scratch, (size_t)island->slot_count + 1, sizeof *rows), square = 0;
  if (!rows) return false;
  island->stability.has_external_forces = environment->fields.count > 0;
  for (uint32_t b = 0; b < island->body_count; b++) {
    sbri_body *body = &model->bodies[island->bodies[b]];
    const sbf_attributes *is = &body->source->attributes;
    bool embedded = body->surface.skin.vertex_count && body->surface.skin.frame_vertex_count == 0;
    if (!make_hinges(model, body)) return false;
    if (is->pressure_mode == SBF_PRESSURE_MODE_GAS && embedded && body->surface.rest_volume_m3 > 0) {
      body->gas.pressure_pa = is->pressure;
      body->gas.volume_m3 = sbri_surface_rest_volume(body);
      if (!find_gas_factors(model, body)) return false;
      square += gas_bound(island, body);
    }
    if (embedded) body->medium_kg_m3 = environment->media_density;
    square += hinges_bound(island, body, rows);
    island->stability.has_external_forces = island->stability.has_external_forces ||
                                            body->elements.hinge_count || body->gas.pressure_pa != 0 ||
                                            body->medium_kg_m3 > 0;
  }
  island->stability.external_rad_s = sqrt(square);
  return true;
}

bool sbri_external_forces_make(sbr_model *model) {
  bool good = true;
  for (uint32_t i = 0; good && i < model->island_count; i++) {
    sbfi_arena scratch;
    sbfi_arena_init(&scratch, &model->arena.allocator, 0);
    good = make_island(model, &model->islands[i], &scratch);
    sbfi_arena_free(&scratch);
  }
  return good;
}
