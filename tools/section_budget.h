/* How fine the sections of a skin have to be, and how many there may be, within a budget. */
#ifndef SECTION_BUDGET_H
#define SECTION_BUDGET_H

#include "sbfmt/build.h"

/* Time of an element visit on the reference machine, ns (sbrun/detail.h): a budget in microseconds is one in
 * element visits, which are the same on every machine. */
#define SECTION_BUDGET_NS_PER_VISIT 6.0

typedef struct section_budget {
  uint32_t elements;   /* tetrahedra of the lattice that a section's springs follow; 0: nothing to choose */
  double visits;       /* of the whole character with skin, a tick */
  double skin_visits;  /* of the skin alone */
  double max_visits;   /* the budget, or the skin and a quarter of it, where that is more */
  bool exceeds;        /* the latter */
  double p99_fraction; /* of the size: 99 of 100 vertices and ticks are no farther off the finest */
  uint32_t finest;     /* elements of that */
  uint32_t soft;       /* parts that are soft in the end */
  bool near;           /* within 1 % of the size, nine tenths of its volume, strains of half */
  uint32_t left_out;   /* parts that were made rigid to keep the budget */
  char names[160];     /* of those */
} section_budget;

/* Whether there is anything to choose: soft parts of a skin that are to be cut, and nothing else that is
 * soft. */
bool section_budget_applies(const sbf_asset *source, const sbf_build_options *build);

/* Builds the sections with several numbers of elements, runs each through the character's own walk, hop and
 * shake, and takes the cheapest that stays near the finest; else the best within the budget. Where nothing is
 * within it, the smallest parts that the conversion proposed become rigid until it is kept. A quarter of the
 * budget is for soft parts even where the skin takes all of it. Writes the choice into the section recipes of
 * `source`, which is the caller's own. */
sbf_status section_budget_choose(sbf_asset *source, const sbf_build_options *build, double budget_us,
    section_budget *choice, sbf_diagnostic *error);

/* States the cost of each level in element visits, where section recipes state elements. */
void section_budget_state_costs(sbf_asset *built);

#endif
