/* Avatar data of a VRM file, the format of avatars on top of glTF: humanoid bones, and springs with
 * colliders.
 *
 * VRM 1.0 has the extensions VRMC_vrm, VRMC_springBone 1.0 and VRMC_springBone_extended_collider 1.0; VRM 0.x
 * has the extension VRM. A glTF file with VRMC_springBone alone is read too. Nodes are the scene's, vectors
 * in the axes of their node, lengths in the file's unit. */
#ifndef SBFI_VRM_H
#define SBFI_VRM_H

#include "import/scene/scene.h"
#include "sbfmt/model.h"

typedef struct sbfi_vrm_collider {
  int32_t node; /* SBF_NONE: malformed, left out */
  sbf_chain_collider_shape shape;
  sbf_vec3 offset; /* center, first end or point, from the node */
  sbf_vec3 tail;   /* other end of a capsule */
  sbf_vec3 normal; /* of a plane */
  float radius;
  bool inside;
} sbfi_vrm_collider;

/* Numbers as in the file, within their ranges. */
typedef struct sbfi_vrm_joint {
  int32_t node;
  float stiffness, gravity_power, drag_force, hit_radius;
  sbf_vec3 gravity_direction;
} sbfi_vrm_joint;

/* Each joint swings the next one; the last one swings nothing, or a point beyond itself (VRM 0.x). The last
 * node is no bone if it only marks the tip of the one before, along its +Y. */
typedef struct sbfi_vrm_spring {
  const char *name; /* "" if it has none */
  int32_t center;   /* node or SBF_NONE */
  uint32_t joint_count, collider_count;
  const sbfi_vrm_joint *joints; /* (joint_count) each a descendant of the one before */
  const uint32_t *colliders;    /* (collider_count) */
  bool has_tail;                /* the last joint swings a point SBFI_VRM_TAIL beyond it */
} sbfi_vrm_spring;

/* Distance of the end of the last joint of a VRM 0.x spring. */
#define SBFI_VRM_TAIL 0.07f

/* Bones of a humanoid that become chains; VRM 1.0's names begin with a small letter after the side. */
typedef enum sbfi_vrm_bone {
  SBFI_VRM_HIPS,
  SBFI_VRM_SPINE,
  SBFI_VRM_CHEST,
  SBFI_VRM_UPPER_CHEST,
  SBFI_VRM_NECK,
  SBFI_VRM_HEAD,
  SBFI_VRM_LEFT, /* of the bones of one side */
  SBFI_VRM_UPPER_LEG = SBFI_VRM_LEFT,
  SBFI_VRM_LOWER_LEG,
  SBFI_VRM_FOOT,
  SBFI_VRM_TOES,
  SBFI_VRM_SHOULDER,
  SBFI_VRM_UPPER_ARM,
  SBFI_VRM_LOWER_ARM,
  SBFI_VRM_HAND,
  SBFI_VRM_RIGHT,
  SBFI_VRM_BONES = 2 * SBFI_VRM_RIGHT - SBFI_VRM_LEFT
} sbfi_vrm_bone;

typedef struct sbfi_vrm {
  bool is_avatar;  /* with VRMC_vrm or VRM, so that the axis it faces is known */
  bool faces_back; /* VRM 0.x: it faces -Z */
  uint32_t collider_count, spring_count;
  const sbfi_vrm_collider *colliders; /* (collider_count) */
  const sbfi_vrm_spring *springs;     /* (spring_count) */
  int32_t bones[SBFI_VRM_BONES];      /* nodes, or SBF_NONE */
} sbfi_vrm;

/* Reads the avatar data of a glTF file into scene->vrm, and marks its nodes as bones. The scene's nodes have
 * their numbers. Malformed parts are left out with a warning. `bytes`: the whole file. */
sbf_status sbfi_vrm_read(sbfi_scene *scene, const uint8_t *bytes, size_t size, const sbf_allocator *allocator,
    sbf_diagnostic *error);

#endif
