/* Rigid bodies and joints in a glTF file: KHR_physics_rigid_bodies and KHR_implicit_shapes.
 *
 * The first rigid body of a bone is the motion of the bone's node; others get nodes of their own. A kinematic
 * body without a bone is static: a collider without a motion. Each joint has two nodes, its attachment
 * frames. A hull that is a box is a shape of a node below the body; others are meshes of nodes outside the
 * scene, so that viewers do not show them. */
#ifndef SBFI_GLB_RIGID_H
#define SBFI_GLB_RIGID_H

#include "export/glb.h"

/* What the extension cannot say. */
typedef enum sbfi_glb_rigid_loss {
  SBFI_RIGID_PULLEYS,
  SBFI_RIGID_BREAKING,
  SBFI_RIGID_BOUNCING_LIMITS,
  SBFI_RIGID_DRIVES,
  SBFI_RIGID_LOSSES
} sbfi_glb_rigid_loss;

typedef struct sbfi_glb_box {
  sbfi_glb_transform transform; /* of its center and edges, asset space */
  float size[3];                /* m, along its own axes */
} sbfi_glb_box;

typedef struct sbfi_glb_rigid_body {
  uint32_t node;                /* with its motion and collider */
  bool own_node, is_static;     /* the node is not a bone's; it has no motion */
  sbfi_glb_transform transform; /* of the node, asset space */
  uint32_t hull_node;           /* of the box or the mesh; UINT32_MAX: none, or the body's own node */
  int32_t shape;                /* of a box, in the list of shapes; SBF_NONE: no box */
  sbfi_glb_box box;
  int32_t material, filter; /* SBF_NONE: none */
} sbfi_glb_rigid_body;

struct sbfi_glb_rigid {
  sbfi_glb_rigid_body *bodies; /* by rigid body */
  uint32_t *joint_nodes;       /* by joint: node of frame a, before that of b; UINT32_MAX: not written */
  sbfi_text materials, filters, joints, shapes; /* items of the document's lists */
  uint32_t material_count, filter_count, joint_count, shape_count;
  uint32_t losses[SBFI_RIGID_LOSSES];
};
typedef struct sbfi_glb_rigid sbfi_glb_rigid;

/* Numbers the nodes from `first_node` on and writes the document's lists; before the nodes. */
void sbfi_glb_plan_rigid(sbfi_glb *g, uint32_t first_node);
void sbfi_glb_free_rigid(sbfi_glb *g);
/* Children of a bone's node that are not bones or meshes, each after a comma or the list's beginning. */
void sbfi_glb_add_rigid_children(sbfi_glb *g, int32_t bone, sbfi_text *text, bool *first);
/* The extensions of a bone's node, after a comma; nothing if it has no body. */
void sbfi_glb_write_bone_physics(sbfi_glb *g, uint32_t bone, sbfi_text *text);
/* The nodes planned, in order. */
void sbfi_glb_write_rigid_nodes(sbfi_glb *g);
/* Nodes at the top of the scene. */
void sbfi_glb_write_rigid_tops(const sbfi_glb *g, sbfi_text *json, bool *first);
/* The document's extensions, after a comma unless `first`. */
void sbfi_glb_write_rigid_document(const sbfi_glb *g, sbfi_text *json, bool first);
/* Whether there are rigid bodies to write. A recorded motion moves the bones itself and has none. */
bool sbfi_glb_has_rigid(const sbfi_glb *g);

/* Whether the hull is a box. */
bool sbfi_glb_find_box(const sbf_polygon_mesh *hull, sbfi_glb_box *box);

/* The item of the list of joints for a joint: limits and drives. */
void sbfi_glb_write_rigid_joint(sbfi_glb *g, const sbf_joint *joint);

#endif
