/* The order in which the relaxation scheme goes over springs. */
#ifndef SBRI_VISITS_H
#define SBRI_VISITS_H

#include "model/runtime_model.h"

/* Of the island, whose tables are made; false where memory runs out. */
bool sbri_visits_make(sbr_model *model, sbri_island *island);

#endif
