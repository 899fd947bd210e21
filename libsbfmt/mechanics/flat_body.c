#include "mechanics/flat_body.h"

#include <math.h>

#include "sbfmt/mechanics.h"

/* Fraction of the area to the power of 3/2: a plate of one square metre is flat if it is thinner than 3
 * micrometres. */
static const double empty_volume = 1e-6;

bool sbfi_flat_body_weigh(sbf_soft_body *body) {
  sbf_attributes *is = &body->attributes;
  sbf_body_measures measures;
  sbf_body_measure(body, &measures);
  if (measures.sheet || is->mass > 0 || !(measures.area > 0)) return false;
  if (measures.volume >= empty_volume * measures.area * sqrt(measures.area)) return false;
  is->area_density = 0.5f * is->density * is->thickness;
  return is->area_density > 0;
}
