/* A clip with one key of rotation and translation for each bone, which its owner may change. */
#ifndef SBFMT_GODOT_POSE_CLIP_H
#define SBFMT_GODOT_POSE_CLIP_H

#include <stdbool.h>
#include <stdint.h>

#include "sbfmt/asset.h"

/* Keys of a bone. */
typedef struct pose_key {
  float time;
  sbf_quat rotation; /* in the parent's frame */
  sbf_vec3 translation;
  uint32_t enabled; /* whether it applies */
} pose_key;

typedef struct pose_clip {
  sbf_asset *asset;  /* the copy that has it */
  int32_t clip;      /* its index */
  sbf_track *tracks; /* two for each bone */
  pose_key *keys;    /* for each bone */
  pose_key *before;  /* as of the last call of pose_clip_changes */
} pose_clip;

/* Copies the asset and adds the clip; false without memory. */
bool pose_clip_make(pose_clip *made, const sbf_asset *asset);
void pose_clip_free(pose_clip *made);
/* Whether the keys of a bone apply. */
void pose_clip_enable(pose_clip *made, uint32_t bone, bool enabled);
/* Whether any key is another one since the last call. */
bool pose_clip_changes(pose_clip *made);

#endif
