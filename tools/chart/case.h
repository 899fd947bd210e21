/* What is charted: bodies, how they move, and what of that is judged. */
#ifndef CHART_CASE_H
#define CHART_CASE_H

#include "chart/errors.h"
#include "chart/subject.h"
#include "chart/watched_motion.h"

typedef struct chart_case {
  const char *name;
  const char *title; /* one line: what happens */
  uint32_t ticks;
  unsigned axes; /* bits of 1 << chart_axis */
  chart_signal signal;
  chart_watch watch;
  bool grounded;
  double raise_m;
  sbf_vec3 gravity;
  bool in_double; /* of springs and tetrahedra the reference is network_motion.h: nothing else acts, and
                     nothing is damped */
  bool of_space;  /* bodies are several meshes of one: each is run by the runtime's own choice, and measured
                     against the first, by its surface */
  uint32_t timed_ticks;     /* of the motion's beginning that are timed; 0: all */
  const sbf_asset *given;   /* a character of a file, which stands in for `make`; its own gravity acts */
  const sbr_ground *ground; /* what it stands on; NULL: level */
  void (*before_tick)(
      void *user, sbr_world *world, sbr_character_id character, uint32_t tick); /* before each */
  void (*begin)(void *user); /* as of a scene (watched_motion.h) */
  void *user;
  /* Makes the `number`-th body, from 0; asset NULL and SBF_OK: there are no more. */
  sbf_status (*make)(uint32_t number, chart_subject *subject, sbf_diagnostic *error);
} chart_case;

/* The case with this body in it. */
chart_scene chart_scene_of(const chart_case *charted, const sbf_asset *asset);

extern const chart_case chart_cases[];
extern const uint32_t chart_case_count;

const chart_case *chart_case_named(const char *name); /* NULL: there is none */

#endif
