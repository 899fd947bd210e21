/* A body simulated by a chosen scheme, to sample or time repeatedly from the same start. */
#ifndef CHART_WATCHED_MOTION_H
#define CHART_WATCHED_MOTION_H

#include "chart/track.h"
#include "sbrun/sbrun.h"

/* Which points are observed. */
typedef enum chart_watch {
  CHART_WATCH_POINTS,  /* of the first body's level, to compare runs of one mesh */
  CHART_WATCH_SURFACE, /* of all bodies' surfaces, to compare meshes */
  CHART_WATCH_SKIN     /* of all render meshes */
} chart_watch;

typedef struct chart_scene {
  const sbf_asset *asset;
  bool has_gravity;         /* it overrides the asset's gravity */
  sbf_vec3 gravity;         /* m/s^2 */
  const sbr_ground *ground; /* replaces the level ground unless NULL */
  bool grounded;            /* there is a ground at world y = 0; otherwise it is a kilometre down */
  double raise_m;           /* initial height of the character's origin above y = 0 */
  uint32_t ticks;           /* world ticks of 1/60 s */
  uint32_t timed_ticks;     /* number of ticks in chart_motion_run; 0: all */
  chart_watch watch;
  void (*before_tick)(void *user, sbr_world *world, sbr_character_id character,
      uint32_t tick); /* called before each tick; may be NULL */
  void (*begin)(
      void *user); /* called before a character is created: resets what `before_tick` changes; may be NULL */
  void *user;
  /* Called for each sampled tick of a motion with this number of substeps; may be NULL. */
  void (*looked)(void *looked_user, uint32_t substeps, uint32_t tick);
  void *looked_user;
  bool stop_broken; /* stops sampling after the tick in which something breaks; the rest of the track is zeros
                     */
} chart_scene;

typedef struct chart_setting {
  sbf_scheme scheme;
  uint32_t substeps;  /* 0: the scheme's own choice */
  float step_error_m; /* for adaptive schemes; 0: the file's */
  uint32_t level;     /* of the bodies, 0 the finest */
} chart_setting;

typedef struct chart_motion {
  chart_scene scene;
  sbf_scheme scheme; /* requested scheme */
  sbr_model *model;
  sbr_world *world;
  sbr_character_id character;
  void *begin; /* snapshot of the start */
  size_t begin_size;
  double visits; /* element visits per tick, mean over the last sampling; NAN: nothing is stepped */
} chart_motion;

/* Returns the runtime's own failure, with *error, if it is unsupported; close it in any case. */
sbf_status chart_motion_open(
    chart_motion *m, const chart_scene *scene, const chart_setting *setting, sbf_diagnostic *error);
void chart_motion_close(chart_motion *m);

/* Runs the timed ticks from the start without sampling. It has the signature of a timed function. */
void chart_motion_run(void *motion);

/* Samples all ticks from the start; counts `visits`; false if memory runs out. */
bool chart_motion_sample(chart_motion *m, chart_track *track);

/* Positions of the observed points in the asset: (chart_motion_points). */
uint32_t chart_motion_points(const chart_scene *scene);
void chart_motion_rest(const chart_scene *scene, sbf_vec3 *positions);
sbf_vec3 *chart_motion_begins(const chart_scene *scene); /* free with free(); NULL if memory runs out */

/* Element visits per tick of all bodies' finest levels at rest; NAN if the scheme adapts its steps. */
double chart_visits_of(const sbr_model *model, const sbf_asset *asset, const chart_setting *setting);
/* The same for one body. */
double chart_body_visits(
    const sbr_model *model, const sbf_asset *asset, uint32_t soft_body, const chart_setting *setting);

#endif
