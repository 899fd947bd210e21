/* Whether bodies may tear. */
#include "model/runtime_model.h"

bool sbri_body_tears(const sbri_body *body) {
  return body->level && body->level->model == SBF_ELASTIC_MODEL_TETRAHEDRA &&
         body->source->attributes.tear_strain > 0;
}

bool sbri_body_frays(const sbri_body *body) {
  if (!body->level || body->level->model != SBF_ELASTIC_MODEL_SPRINGS) return false;
  bool tears = body->source->attributes.tear_strain > 0;
  for (uint32_t s = 0; s < body->level->springs.count; s++)
    tears = tears || body->level->springs.at[s].tear_strain > 0;
  return tears;
}
