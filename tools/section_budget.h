/* Chooses the resolution and number of a skin's sections within a budget. */
#ifndef SECTION_BUDGET_H
#define SECTION_BUDGET_H

#include "sbfmt/build.h"

/* Time of an element visit on the reference machine, ns (sbrun/detail.h): converts a budget in
 * microseconds to element visits, which are the same on every machine. */
#define SECTION_BUDGET_NS_PER_VISIT 6.0

typedef struct section_budget {
  /* tetrahedra of the lattice whose edges are the springs of a section; 0: nothing to choose */
  uint32_t elements;
  double visits;       /* per tick, of the whole character with skin */
  double skin_visits;  /* of the skin only */
  double max_visits;   /* the budget, or the skin plus a quarter of the budget if that is more */
  bool exceeds;        /* the latter applies */
  double p99_fraction; /* 99th percentile over vertices and ticks of the distance from the finest, as a
                          fraction of the size */
  uint32_t finest;     /* number of elements of the finest */
  uint32_t soft;       /* final number of soft parts */
  double firmer;       /* factor on the proposed moduli */
  bool near; /* within 1 % of the size (0.8 % if stiffened), at least nine tenths of the volume, strains up to
                a half */
  uint32_t left_out; /* parts made rigid to keep the budget */
  char names[160];   /* names of those */
} section_budget;

/* Whether there is a choice: soft parts of a skin that will be cut, and no other soft bodies. */
bool section_budget_applies(const sbf_asset *source, const sbf_build_options *build);

/* Builds the sections with several numbers of elements, runs each with the character's own walk, hop and
 * shake, and selects the cheapest that is close to the finest. If none is close, and it may stiffen them,
 * multiplies the moduli that the conversion proposed by up to 4 until one is. Else selects the best within
 * the budget. If none is within it, makes the smallest parts that the conversion proposed rigid until one is.
 * A quarter of the budget is for soft parts even if the skin needs all of it. Tries skins of more than 32,768
 * vertices in a decimated form. Writes the choice into the section recipes of `source`, which is the
 * caller's own. */
sbf_status section_budget_choose(sbf_asset *source, const sbf_build_options *build, double budget_us,
    bool may_stiffen, section_budget *choice, sbf_diagnostic *error);

/* Stores the cost of each level in element visits if section recipes have elements. */
void section_budget_state_costs(sbf_asset *built);

#endif
