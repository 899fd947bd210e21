/* A body that the runtime moves by a chosen scheme: to look at, and to time, again and again from the same
 * beginning. */
#ifndef CHART_WATCHED_MOTION_H
#define CHART_WATCHED_MOTION_H

#include "chart/track.h"
#include "sbrun/sbrun.h"

/* Which points are looked at. */
typedef enum chart_watch {
  CHART_WATCH_POINTS,  /* those of the first body's level: to compare runs of one mesh */
  CHART_WATCH_SURFACE, /* those of all bodies' surfaces: to compare meshes */
  CHART_WATCH_SKIN     /* those of all render meshes */
} chart_watch;

typedef struct chart_scene {
  const sbf_asset *asset;
  bool has_gravity;         /* of its own; else the asset's */
  sbf_vec3 gravity;         /* m/s^2 */
  const sbr_ground *ground; /* not NULL: instead of a level one */
  bool grounded;            /* there is a ground at world y = 0; else it is a kilometre down */
  double raise_m;           /* that the character's origin begins above y = 0 */
  uint32_t ticks;           /* of the world's 1/60 s */
  uint32_t timed_ticks;     /* of them that chart_motion_run runs; 0: all */
  chart_watch watch;
  void (*before_tick)(
      void *user, sbr_world *world, sbr_character_id character, uint32_t tick); /* before each; may
                                                                              be NULL */
  void (*begin)(
      void *user); /* before a character is made: puts back what `before_tick` changes; may be NULL */
  void *user;
  /* Each tick as it is looked at, of a motion by so many substeps; may be NULL. */
  void (*looked)(void *looked_user, uint32_t substeps, uint32_t tick);
  void *looked_user;
  bool stop_broken; /* looking ends with the tick in which something breaks; what the track has of those
                       behind it is zeros */
} chart_scene;

typedef struct chart_setting {
  sbf_scheme scheme;
  uint32_t substeps;  /* 0: its own choice */
  float step_error_m; /* of schemes that control it; 0: the file's */
  uint32_t level;     /* of the bodies, 0 the finest */
} chart_setting;

typedef struct chart_motion {
  chart_scene scene;
  sbf_scheme scheme; /* that was asked for */
  sbr_model *model;
  sbr_world *world;
  sbr_character_id character;
  void *begin; /* snapshot of the beginning */
  size_t begin_size;
  double visits; /* of elements in a tick, on average over those that were last looked at; NAN: nothing is
                    stepped */
} chart_motion;

/* The runtime's own failure, with *error, where it refuses; close it in any case. */
sbf_status chart_motion_open(
    chart_motion *m, const chart_scene *scene, const chart_setting *setting, sbf_diagnostic *error);
void chart_motion_close(chart_motion *m);

/* From the beginning through the ticks that are timed, without looking. Its type is that of what is timed. */
void chart_motion_run(void *motion);

/* From the beginning through all ticks, looking; counts `visits`; false where memory runs out. */
bool chart_motion_sample(chart_motion *m, chart_track *track);

/* Where the points that are looked at are in the asset: (chart_motion_points) of them. */
uint32_t chart_motion_points(const chart_scene *scene);
void chart_motion_rest(const chart_scene *scene, sbf_vec3 *positions);
sbf_vec3 *chart_motion_begins(const chart_scene *scene); /* the same: free() it; NULL: memory ran out */

/* Elements that a tick will look at, as often as it does, of all bodies' finest levels at rest, before
 * anything has moved; NAN where the scheme chooses its steps as it goes. */
double chart_visits_of(const sbr_model *model, const sbf_asset *asset, const chart_setting *setting);
/* Of one body alone. */
double chart_body_visits(
    const sbr_model *model, const sbf_asset *asset, uint32_t soft_body, const chart_setting *setting);

#endif
