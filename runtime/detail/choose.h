/* Selects the detail level of each character of a world, by its error on the screen and a budget. */
#ifndef SBRI_CHOOSE_H
#define SBRI_CHOOSE_H

#include "detail/detail_levels.h"

typedef struct sbri_eye {
  sbr_view view;
  sbf_vec3 forward;             /* unit */
  float cone_sine, cone_cosine; /* of half the angle of the cone around all it sees */
  float pixels;                 /* that a metre has at a metre */
} sbri_eye;

/* A character that is chosen for. */
typedef struct sbri_choice {
  uint32_t character, detail_level, last; /* what it is to be on, and the coarsest that it may */
  float pixels;                           /* pixels of a metre of error; 0: it is not visible */
} sbri_choice;

/* A change for the worse that would save something. */
typedef struct sbri_saving {
  float price; /* pixels a visit */
  uint32_t choice, to;
} sbri_saving;

typedef struct sbri_detail {
  sbr_detail_definition is;
  sbri_eye eyes[SBR_MAX_VIEWS];
  uint32_t eye_count;
  sbri_choice *choices; /* (character_capacity) */
  sbri_saving *savings; /* likewise: a heap, the cheapest first */
  uint32_t choice_count, saving_count;
  bool is_short; /* in this tick the budget does not last for what is wanted */
  double visits; /* of the last tick */
} sbri_detail;

/* ---- detail/choose.c ---- */

/* At the beginning of a tick: what each character goes over to. */
void sbri_detail_choose(sbr_world *world);

/* ---- detail/visibility.c ---- */

sbri_eye sbri_eye_of(const sbr_view *view);
/* Pixels that a metre of the character has where it is shown largest; 0: no view has it. */
float sbri_pixels_of(const sbr_world *world, const sbri_character *c);
/* Factor on the error at rest for the speed at which the character is driven. */
float sbri_speed_factor(const sbri_character *c);

/* ---- detail/budget.c ---- */

/* Coarsens the choices, least visible first, until all cost at most `most` of `visits`; returns their cost.
 */
double sbri_budget_keep(const sbr_world *world, double visits, double max);

#endif
