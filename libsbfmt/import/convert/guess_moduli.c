#include "import/convert/guess_moduli.h"

#include <math.h>

#include "mechanics/bearing_modulus.h"
#include "sbfmt/materials.h"
#include "sbfmt/mechanics.h"

/* Maximum strain of soft tissue under its own weight. Tissue is attached along the whole bone, so it carries
 * only the mass between bone and skin. At this strain the shape still looks as authored. */
static const double MAX_TISSUE_STRAIN = 0.25;

/* Guessed moduli, for the report. */
typedef struct guesses {
  double min, max; /* Pa */
  unsigned count;
} guesses;

static void guess(guesses *made, sbf_attributes *attributes, double modulus) {
  attributes->young_modulus = (float)modulus;
  made->min = made->count ? fmin(made->min, modulus) : modulus;
  made->max = fmax(made->max, modulus);
  made->count++;
}

void sbfi_guess_moduli(sbfi_conversion *c) {
  const sbf_soft_body_list *bodies = &c->asset->soft_bodies;
  double soft_tissue = (double)sbf_material_find("flesh")->young_modulus;
  guesses sections = {0}, standing = {0};
  for (uint32_t i = 0; i < bodies->count; i++) {
    sbf_soft_body *body = (sbf_soft_body *)(uintptr_t)&bodies->at[i]; /* the conversion owns the asset */
    sbf_body_measures measures;
    sbf_body_measure(body, &measures);
    if (measures.sheet || (body->bone == SBF_NONE && body->pins.count)) continue;
    double density = (double)body->attributes.density;
    if (body->bone != SBF_NONE) {
      guess(&sections, &body->attributes,
          sbfi_modulus_to_bear(soft_tissue, density, measures.depth, MAX_TISSUE_STRAIN));
      continue;
    }
    double modulus = sbfi_standing_modulus(&body->attributes, &body->surface);
    if (modulus > (double)body->attributes.young_modulus) guess(&standing, &body->attributes, modulus);
  }
  if (sections.count)
    sbfi_convert_warn(c, SBF_CODE_MATERIAL_GUESSED,
        "%u section%s had no material: flesh of %.6g kPa is used%s; choose a material, for example "
        "--material muscle",
        sections.count, sections.count == 1 ? "" : "s", 1e-3 * sections.max,
        sections.max > sections.min ? " for the thickest" : "");
  if (standing.count)
    sbfi_convert_warn(c, SBF_CODE_MATERIAL_GUESSED,
        "%u bod%s had no material and would be too heavy for the default modulus: %.6g kPa is used%s; choose "
        "a material, for example --material rubber",
        standing.count, standing.count == 1 ? "y" : "ies", 1e-3 * standing.max,
        standing.max > standing.min ? " for the largest" : "");
}
