/* Poses of the bones that the game gives: of another Skeleton3D, and of bones that turn to a point.
 *
 * They are the keys of a clip in the runtime's highest layer. The character has a copy of the asset with that
 * clip, and writes its keys before each step. */
#ifndef SBFMT_GODOT_POSE_DRIVER_H
#define SBFMT_GODOT_POSE_DRIVER_H

#include "soft_character.h"

enum { POSE_LAYER = 3, POSE_AIMS = 8 };

/* A bone that turns its front to a point. */
typedef struct pose_aim {
  int32_t bone;
  sbf_vec3 point; /* world, m */
  float weight;
  sbf_quat turn; /* of the bone, world axes, at the last step */
  bool ends;     /* it turns back */
} pose_aim;

struct pose_driver {
  gd_variant path;            /* NodePath of the Skeleton3D */
  double weight, sent_weight; /* the runtime's; below 0: none */
  pose_aim aims[POSE_AIMS];
  uint32_t aim_count;
  uint64_t skeleton; /* instance id of the one that `bones` are of; 0: none */
  int32_t *bones;    /* of it, for each of the asset; -1: none */
  bool warned;
};

/* NULL, with an error, if memory runs out. */
pose_driver *pose_driver_of(soft_character *one);
void pose_driver_free(soft_character *one);
/* Whether the character needs an asset with the clip. */
bool pose_driver_is_used(const soft_character *one);
/* Before a step of the world. */
void pose_driver_prepare(soft_character *one, float frame_s);
/* The character is created again. */
void pose_driver_clear(soft_character *one);

extern const gd_method soft_character_pose_methods[];

#endif
