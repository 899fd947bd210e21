/* Spring order of the relaxation scheme. */
#ifndef SBRI_VISITS_H
#define SBRI_VISITS_H

#include "model/runtime_model.h"

/* Call after the island's tables are built. Returns false if memory runs out. */
bool sbri_visits_make(sbr_model *model, sbri_island *island);

#endif
