/* A rig on flat ground that the tests of its motion tick. */
#ifndef TEST_GAIT_STAGE_H
#define TEST_GAIT_STAGE_H

#include "animation/gait/gait_state.h"

typedef struct gait_stage {
  sbf_asset *asset;
  sbri_rig rig;
  void *memory; /* the rig's */
  sbri_gait_state *state;
  sbri_gait_input input;
  sbr_ground ground;
  sbr_transform *pose; /* (bones) */
} gait_stage;

/* The stage owns the asset from here on. Ticks of 1/60 s, standing at the origin. Ended by gait_stage_end. */
void gait_stage_begin(gait_stage *stage, sbf_asset *asset);
/* Other ticks, another scale; from the beginning. */
void gait_stage_begin_scaled(gait_stage *stage, sbf_asset *asset, float tick_s, float scale);
/* On a ground of the caller's, told `parameter` as its first; as gait_stage_begin else. */
void gait_stage_begin_on(gait_stage *stage, sbf_asset *asset,
    double (*height)(const sbr_ground *, double, double, sbf_vec3 *), double parameter);
void gait_stage_end(gait_stage *stage);

/* Once more from the beginning, of the asset as it has become. */
void gait_stage_remake(gait_stage *stage);

void gait_stage_ticks(gait_stage *stage, int count);
/* The asset's first clip from now on, at once and whole. */
void gait_stage_play(gait_stage *stage);

/* A clip that one bone has `count` numbers of one property from one tick to the next; the asset's only one.
 */
void gait_stage_step_clip(
    sbf_asset *asset, uint32_t bone, sbf_track_property property, const float *values, uint32_t count);

#endif
