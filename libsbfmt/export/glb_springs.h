/* Swinging parts of a character as VRMC_springBone 1.0, so that they swing in VRM viewers too. */
#ifndef SBFI_GLB_SPRINGS_H
#define SBFI_GLB_SPRINGS_H

#include "export/glb.h"

/* A bone that swings, with VRM's numbers. */
typedef struct sbfi_glb_joint {
  uint32_t bone;
  float stiffness, gravity_power, drag_force, hit_radius;
  sbf_vec3 gravity_direction;
} sbfi_glb_joint;

typedef struct sbfi_glb_spring {
  const char *name;
  const sbf_chain_spring *source; /* with center and colliders; NULL: neither */
  sbfi_glb_joint *joints;         /* (joint_count) */
  uint32_t joint_count;
  int32_t end_bone; /* joint that ends it; SBF_NONE: a node of its own, `end` */
  uint32_t end_node;
  sbf_vec3 end; /* of the last joint, in its bone's frame, m */
} sbfi_glb_spring;

typedef struct sbfi_glb_springs {
  sbfi_glb_spring *at; /* (count) */
  uint32_t count;
  uint32_t end_count;                           /* nodes at ends */
  uint32_t chains_left_out, followers_left_out; /* whose bones another spring swings, or that do not swing */
  bool extended;                                /* has colliders of VRMC_springBone_extended_collider */
} sbfi_glb_springs;

/* Finds what swings. Nodes of ends are numbered from `first_node`. A file with a baked motion has no springs.
 */
void sbfi_glb_plan_springs(sbfi_glb *g, uint32_t first_node);
/* Adds the node of the end of a bone to its children. */
void sbfi_glb_add_end_child(const sbfi_glb *g, uint32_t bone, sbfi_text *text, bool *first);
/* Nodes of ends; after all nodes with lower numbers. */
void sbfi_glb_write_end_nodes(sbfi_glb *g);
/* Appends the value of the extension. */
void sbfi_glb_write_springs(sbfi_glb *g, sbfi_text *text);

#endif
