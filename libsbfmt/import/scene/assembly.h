/* Putting a scene together from what sbfmt-import sent, step by step in the order of these functions. */
#ifndef SBFI_ASSEMBLY_H
#define SBFI_ASSEMBLY_H

#include "import/scene/name_table.h"
#include "import/scene/raw_scene.h"

typedef struct sbfi_assembly {
  sbfi_scene *scene;
  const sbfi_raw_scene *raw;
  const sbf_allocator *allocator;
  sbfi_arena scratch;
  sbfi_scene_node *nodes;  /* of the scene */
  int32_t *new_from_old;   /* (raw nodes) SBF_NONE for one folded into those below it */
  uint32_t *old_from_new;  /* (scene nodes) */
  sbfi_name_table names;   /* of the scene's nodes */
  int32_t *node_of_name;   /* (names) the node a skin or a clip means by a name */
  uint32_t *ties;          /* (names) how many nodes could be meant as well */
  int32_t *new_materials;  /* (raw materials) number in the scene, SBF_NONE for one that no mesh uses */
  uint32_t *joint_of_node; /* (scene nodes) joint + 1 while a skin is joined, all 0 between */
  sbf_status status;       /* of sbfi_assembly_refuse */
  sbf_diagnostic *error;
} sbfi_assembly;

/* Notes why the file is refused, and returns false: how a step fails that has not run out of memory. */
bool sbfi_assembly_refuse(sbfi_assembly *a, sbf_code code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* All of it. The raw scene's stream may go afterwards. */
sbf_status sbfi_assemble(
    sbfi_scene *scene, const sbfi_raw_scene *raw, const sbf_allocator *allocator, sbf_diagnostic *error);

/* Each returns false where memory runs out, or once it has refused the file. Unit and axes; nodes, with the
 * helper nodes that assimp makes of FBX pivots folded away; which nodes are bones; materials and images;
 * meshes; clips. */
bool sbfi_assemble_frame(sbfi_assembly *a);
bool sbfi_assemble_nodes(sbfi_assembly *a);
bool sbfi_assemble_bones(sbfi_assembly *a);
bool sbfi_assemble_materials(sbfi_assembly *a);
bool sbfi_assemble_meshes(sbfi_assembly *a);
bool sbfi_assemble_clips(sbfi_assembly *a);

/* assimp makes up a mesh to show the bones of a file that has none; it says so, but not of every form. */
bool sbfi_is_invented(const sbfi_assembly *a);

/* Whether the raw node is a helper that was folded away. */
bool sbfi_is_folded(const sbfi_assembly *a, uint32_t raw_node);

/* The node that a skin or a clip means by a name: of several the bone, else the one without a mesh. SBF_NONE
 * for an unknown name. `*good` becomes false where memory runs out for the warning of a tie. */
int32_t sbfi_assembly_find(sbfi_assembly *a, sbfi_span name, bool *good);

#endif
