/* Selects the detail level of each character of a world, by its error on the screen and a budget. */
#ifndef SBRI_CHOOSE_H
#define SBRI_CHOOSE_H

#include "world/detail/detail_levels.h"

typedef struct sbri_eye {
  sbr_view view;
  sbf_vec3 forward;             /* unit */
  float cone_sine, cone_cosine; /* of half the angle of the cone around its view */
  float pixels;                 /* pixels of a metre at a distance of a metre */
} sbri_eye;

/* A character with a choice of levels. */
typedef struct sbri_choice {
  uint32_t character, detail_level, last; /* its level, and the coarsest allowed one */
  float pixels;                           /* pixels per metre of error; 0: not visible */
} sbri_choice;

/* A change to a coarser level that would save visits. */
typedef struct sbri_saving {
  float price; /* pixels per saved visit */
  uint32_t choice, to;
} sbri_saving;

typedef struct sbri_detail {
  sbr_detail_definition is;
  sbri_eye eyes[SBR_MAX_VIEWS];
  uint32_t eye_count;
  sbri_choice *choices; /* (character_capacity) */
  sbri_saving *savings; /* (character_capacity) a heap with the cheapest first */
  uint32_t choice_count, saving_count;
  bool is_short; /* in this tick the budget does not suffice for acceptable errors */
  double visits; /* of the last tick */
} sbri_detail;

/* ---- world/detail/choose.c ---- */

/* Call at the beginning of a tick: sets the next level of each character. */
void sbri_detail_choose(sbr_world *world);

/* ---- world/detail/visibility.c ---- */

sbri_eye sbri_eye_of(const sbr_view *view);
/* Maximum of pixels per metre over all views; 0: not visible. */
float sbri_pixels_of(const sbr_world *world, const sbri_character *c);
/* Factor on the error at rest for the commanded speed. */
float sbri_speed_factor(const sbri_character *c);

/* ---- world/detail/budget.c ---- */

/* Coarsens the choices, least visible first, until all cost at most `max` of `visits`; returns their cost. */
double sbri_budget_fit(const sbr_world *world, double visits, double max);

#endif
