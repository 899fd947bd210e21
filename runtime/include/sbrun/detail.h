/* Levels of detail: each character is simulated as finely as its distance and a budget require.
 *
 * A detail level says how finely a character is simulated. A model made with sbr_model_options.detail_levels
 * has several, finest first: each simulated level of the file's bodies; jiggle, one second-order follower per
 * body (spec 10.4); bones only, whose skin follows them; and offscreen, a position that follows the drive,
 * without feet or pose. A character is on one detail level at a time. A change transfers shapes and
 * velocities, and the skin blends from one to the other, so that no jump is visible: docs/detail.md.
 *
 * After sbr_world_select_detail_levels the world selects the detail levels at the beginning of each tick from
 * the host's views: for each character the coarsest detail level whose predicted error on the screen is small
 * enough. If the budget is too small for that, it coarsens those characters first where the visible error
 * grows least. The selection depends on its inputs only, on any machine and any number of threads. Without
 * that call the host selects.
 *
 * A character uses the memory of its detail level (sbr_detail_level.bytes), from the world's allocator.
 * Memory for a change is allocated when a tick begins, on the thread that steps. Memory of the detail level
 * that was left is freed after a second. A step without changes allocates nothing. If memory runs out the
 * character stays on its detail level, sbr_world_get_memory_events reports it, and the change is tried again
 * every half second. Create distant characters on a coarse detail level
 * (sbr_character_definition.detail_level).
 *
 * Rules are those of sbrun.h; only sbr_world_select_detail_levels allocates beside that. Detail levels and
 * the progress of changes are state, stored in snapshots; views belong to the host. Recordings contain both.
 */
#ifndef SBRUN_DETAIL_H
#define SBRUN_DETAIL_H

#include "sbrun/sbrun.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Detail levels ------------------------------------------------------------------------------------- */

/* Kinds of detail levels. */
typedef enum sbr_detail_level_kind {
  SBR_DETAIL_SOFT,     /* a level of springs, tetrahedra or regions is stepped */
  SBR_DETAIL_JIGGLE,   /* each body moves with its bone, displaced by a follower of its centre */
  SBR_DETAIL_BONES,    /* gait and pose; bodies are rigid on their bones */
  SBR_DETAIL_OFFSCREEN /* the character's path over the ground with its last pose, without steps */
} sbr_detail_level_kind;

/* A detail level of a model. */
typedef struct sbr_detail_level {
  sbr_detail_level_kind kind; /* how bodies are simulated */
  uint32_t level;             /* soft kind: level of each body, or its coarsest if it has fewer */
  float error_m; /* maximum error stated by its levels: in motion if measured (simulation.motion_error), else
                    at rest; 2 % of the body's size for a level without a stated error */
  float visits;  /* cost of a tick in element visits, with the gait */
  size_t bytes;  /* memory of a character without the surfaces for body contacts */
} sbr_detail_level;

/* Writes up to `capacity` detail levels of the model, finest first, and returns their number. It is 1 without
 * sbr_model_options.detail_levels and for models with a body that yields or tears. Models with loose bodies
 * have soft detail levels only. */
SBF_API uint32_t sbr_model_get_detail_levels(
    const sbr_model *model, sbr_detail_level *detail_levels, uint32_t capacity);

/* The character's detail level, or the one it is about to change to; from 0. */
SBF_API uint32_t sbr_character_get_detail_level(const sbr_world *world, sbr_character_id character);
/* Sets the detail level; a number beyond the last means the last. The change happens when the tick after the
 * next begins, because its motion is measured until then; at once if the character is not visible or
 * offscreen. SBR_DETAIL_AUTOMATIC returns the selection to the world. With contacts between bodies
 * (sbr_world_enable_body_contacts) a character stays on a soft detail level while others are near or will be
 * within half a second. */
#define SBR_DETAIL_AUTOMATIC 0xffffffffu
SBF_API void sbr_character_set_detail_level(
    sbr_world *world, sbr_character_id character, uint32_t detail_level);
/* Remaining fraction of a change: 1 when the skin still shows the old detail level, 0 when the change is
 * complete. */
SBF_API float sbr_character_get_detail_fade(const sbr_world *world, sbr_character_id character);

/* ---- Choosing ----------------------------------------------------------------------------------------- */

/* Settings of the selection. */
typedef struct sbr_detail_definition {
  uint32_t cookie;         /* set by sbr_default_detail_definition */
  float error_px;          /* maximum error on the screen, also of the jump at a change; default 0.5 */
  float budget_us;         /* processor time a tick for all characters; 0 (default): no budget */
  float ns_per_visit;      /* time of an element visit (sbr_detail_level.visits) on this machine; default 6 */
  float coarsen_fraction;  /* a coarser detail level is selected if its error is below this fraction of
                              error_px; default 0.7 */
  float stay_s;            /* minimum time between changes; default 0.5 */
  float offscreen_after_s; /* time out of view before the offscreen level; negative: never; default 1 */
} sbr_detail_definition;

/* The default settings. */
SBF_API sbr_detail_definition sbr_default_detail_definition(void);
/* Lets the world select the detail levels of characters without a detail level set by the host. A later call
 * changes the settings. Recordings do not contain this call: make it before they begin. SBF_FAILED if memory
 * runs out or a number is out of range: error_px and ns_per_visit above 0, coarsen_fraction in (0, 1]. */
SBF_API sbf_status sbr_world_select_detail_levels(
    sbr_world *world, const sbr_detail_definition *definition, sbf_diagnostic *error);

/* A camera. */
typedef struct sbr_view {
  sbr_double3 eye;   /* world */
  sbf_vec3 forward;  /* viewing direction, any length */
  float height_rad;  /* vertical field of view; (0, 3] */
  float width_ratio; /* aspect ratio, width over height */
  float lines;       /* height in pixels */
} sbr_view;
/* Sets the cameras of the next frames, at most SBR_MAX_VIEWS; without any, no character is visible. The view
 * with the largest image of a character counts. */
#define SBR_MAX_VIEWS 4u
SBF_API void sbr_world_set_views(sbr_world *world, const sbr_view *views, uint32_t count);

/* Visibility set by the host. */
typedef enum sbr_visibility {
  SBR_VISIBILITY_BY_VIEWS, /* from the views */
  SBR_VISIBILITY_ALWAYS,   /* visible outside of the views, as in a mirror; its distance counts */
  SBR_VISIBILITY_NEVER     /* hidden, as behind a wall */
} sbr_visibility;
SBF_API void sbr_character_set_visibility(
    sbr_world *world, sbr_character_id character, sbr_visibility visibility);

/* Predicted maximum error of the character in pixels, in the view that shows it largest; larger when it moves
 * fast. 0: it is not visible. */
SBF_API float sbr_character_get_error_px(const sbr_world *world, sbr_character_id character);
/* Predicted cost of all characters in the last tick, in element visits. */
SBF_API double sbr_world_get_element_visits(const sbr_world *world);

#ifdef __cplusplus
}
#endif
#endif
