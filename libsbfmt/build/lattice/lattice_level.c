#include "build/lattice/lattice_level.h"

#include <string.h>

#include "build/lattice/lattice_pins.h"
#include "build/materials/point_factors.h"

enum { USUAL_ELEMENTS = 2000 };
/* For bodies whose number is reduced because there are many. */
static const double shared_tolerance = 0.1;

static bool is_thin(const sbfi_thinness *of) {
  return of->thin_count > of->sample_count / 20;
}

static sbfi_lattice_outcome make_lattice(sbfi_lattice *lattice, const sbf_soft_body *body,
    const sbfi_lattice_recipe *recipe, sbfi_thinness *thinness, sbfi_progress progress, sbfi_arena *scratch) {
  sbfi_soup soup;
  sbfi_winding winding;
  if (!sbfi_soup_make(&soup, &body->surface, scratch) || !sbfi_winding_make(&winding, &soup, scratch))
    return SBFI_LATTICE_NO_MEMORY;
  sbfi_lattice_outcome outcome;
  uint32_t max =
      recipe->max && recipe->max < SBFI_LATTICE_THIN_ELEMENTS ? recipe->max : SBFI_LATTICE_THIN_ELEMENTS;
  uint32_t usual = max < USUAL_ELEMENTS ? max : USUAL_ELEMENTS;
  double tolerance = recipe->tolerance > 0                             ? recipe->tolerance
                     : recipe->elements > 0 || usual == USUAL_ELEMENTS ? SBFI_LATTICE_TOLERANCE
                                                                       : shared_tolerance;
  for (uint32_t elements = recipe->elements ? recipe->elements : usual;; elements *= 2) {
    outcome = recipe->cell > 0
                  ? sbfi_lattice_make(lattice, &winding, recipe->cell, progress, scratch)
                  : sbfi_lattice_make_count(lattice, &winding, elements, tolerance, progress, scratch);
    if (outcome != SBFI_LATTICE_MADE) return outcome;
    if (!sbfi_lattice_thinness(thinness, &body->surface, lattice->cell, scratch))
      return SBFI_LATTICE_NO_MEMORY;
    bool is_requested = recipe->cell > 0 || recipe->elements > 0;
    if (is_requested || !is_thin(thinness) || 2 * elements > max) return outcome;
  }
}

static bool fill(sbf_level *level, const sbf_soft_body *body, const sbfi_lattice *lattice, sbf_asset *asset) {
  const sbfi_tetrahedra *made = &lattice->made;
  uint32_t sources = body->surface.positions.count + body->interior.count;
  sbf_vec3 *positions = sbf_asset_allocate(asset, made->point_count, sizeof *positions);
  sbf_uint4 *tetrahedra = sbf_asset_allocate(asset, made->count, sizeof *tetrahedra);
  uint32_t *new_from_old = sbf_asset_allocate(asset, sources, sizeof *new_from_old);
  if (!positions || !tetrahedra || !new_from_old) return false;
  memcpy(positions, made->positions, made->point_count * sizeof *positions);
  memcpy(tetrahedra, made->at, made->count * sizeof *tetrahedra);
  memset(new_from_old, 0xff, sources * sizeof *new_from_old);
  level->positions = (sbf_vec3_list){positions, made->point_count};
  level->new_from_old = (sbf_u32_list){new_from_old, sources};
  level->lattice.target = SBF_VOLUME_TARGET_VOLUME;
  level->lattice.tetrahedra = (sbf_uint4_list){tetrahedra, made->count};
  return true;
}

/* A lattice contains slightly less volume than the surface, or more at thin limbs. If the surface is closed,
 * so that its volume is known, the level gets a density for the mass of the body. */
static bool weigh(sbf_level *level, const sbf_soft_body *body, double volume, sbf_asset *asset) {
  sbf_surface_measures surface;
  sbf_surface_measure(&body->surface, NULL, &surface);
  double ratio = fabs(surface.volume) / volume;
  if (!(surface.opening < 1e-3 && ratio > 0.5 && ratio < 2) || fabs(ratio - 1) < 1e-5) return true;
  float *density = sbf_asset_allocate(asset, 1, sizeof *density);
  if (!density) return false;
  *density = (float)(body->attributes.density * ratio);
  level->lattice.densities = (sbf_f32_list){density, 1};
  return true;
}

sbfi_lattice_outcome sbfi_lattice_level_make(sbf_level *level, const sbf_soft_body *body,
    const sbfi_lattice_recipe *recipe, sbf_asset *asset, sbfi_lattice_counts *counts, sbfi_progress progress,
    sbfi_arena *scratch) {
  sbfi_lattice lattice;
  sbf_level_init(level);
  *counts = (sbfi_lattice_counts){.tetrahedra = 0};
  sbfi_lattice_outcome outcome = make_lattice(&lattice, body, recipe, &counts->thinness, progress, scratch);
  if (outcome != SBFI_LATTICE_MADE) return outcome;
  level->model = SBF_ELASTIC_MODEL_TETRAHEDRA;
  level->derived = recipe->derivation;
  level->cell = (float)lattice.cell;
  level->name = sbf_asset_copy_text(asset, "lattice");
  if (!level->name) return SBFI_LATTICE_NO_MEMORY;
  if (lattice.made.count == 0) return SBFI_LATTICE_MADE;
  if (!fill(level, body, &lattice, asset) ||
      !sbfi_lattice_pins_make(level, body, recipe->derivation, asset, scratch))
    return SBFI_LATTICE_NO_MEMORY;
  counts->tetrahedra = lattice.made.count;
  counts->points = lattice.made.point_count;
  counts->thickened = lattice.forced_count;
  sbf_lattice_measure(lattice.made.positions, lattice.made.at, lattice.made.count, &counts->quality);
  if (!weigh(level, body, counts->quality.volume, asset) || !sbfi_lattice_weigh(level, body, asset, scratch))
    return SBFI_LATTICE_NO_MEMORY;
  for (uint32_t i = 0; i < level->pins.count; i++) counts->pins += level->pins.at[i].points.count;
  return SBFI_LATTICE_MADE;
}
