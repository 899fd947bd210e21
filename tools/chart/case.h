/* Cases: bodies, their motion, and which errors are measured. */
#ifndef CHART_CASE_H
#define CHART_CASE_H

#include "chart/errors.h"
#include "chart/subject.h"
#include "chart/watched_motion.h"

typedef struct chart_case {
  const char *name;
  const char *title; /* one line: description of the motion */
  uint32_t ticks;
  unsigned axes; /* bits of 1 << chart_axis */
  chart_signal signal;
  chart_watch watch;
  bool grounded;
  double raise_m;
  sbf_vec3 gravity;
  bool in_double; /* for springs and tetrahedra the reference is network_motion.h: no other forces, no damping
                   */
  bool of_space;  /* bodies are several meshes of one shape: each uses the runtime's default scheme and is
                     compared with the first, by surface */
  uint32_t timed_ticks;     /* timed ticks at the beginning of the motion; 0: all */
  const sbf_asset *given;   /* a character from a file instead of `make`; uses its own gravity */
  const sbr_ground *ground; /* ground below it; NULL: level */
  void (*before_tick)(
      void *user, sbr_world *world, sbr_character_id character, uint32_t tick); /* called before each tick */
  void (*begin)(void *user); /* as in chart_scene (watched_motion.h) */
  void *user;
  /* Creates body number `number`, from 0; asset NULL and SBF_OK: there are no more. */
  sbf_status (*make)(uint32_t number, chart_subject *subject, sbf_diagnostic *error);
} chart_case;

/* Scene of the case with this body. */
chart_scene chart_scene_of(const chart_case *charted, const sbf_asset *asset);

extern const chart_case chart_cases[];
extern const uint32_t chart_case_count;

const chart_case *chart_case_named(const char *name); /* NULL: none */

#endif
