/* Assembly of a scene from the output of sbfmt-import; the functions are in order of execution. */
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
  int32_t *new_from_old;   /* (raw nodes) SBF_NONE if merged into its descendants */
  uint32_t *old_from_new;  /* (scene nodes) */
  sbfi_name_table names;   /* names of the scene's nodes */
  int32_t *node_of_name;   /* (names) the node that skins and clips mean by a name */
  uint32_t *ties;          /* (names) number of other nodes that could be meant */
  int32_t *new_materials;  /* (raw materials) index in the scene; SBF_NONE if no mesh uses it */
  uint32_t *joint_of_node; /* (scene nodes) joint + 1 during the assembly of a skin, otherwise all 0 */
  sbf_status status;       /* set by sbfi_assembly_refuse */
  sbf_diagnostic *error;
} sbfi_assembly;

/* Records why the file is rejected and returns false. Steps use it for failures other than out of memory. */
bool sbfi_assembly_refuse(sbfi_assembly *a, sbf_code code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Runs all steps. The raw scene's stream may be freed afterwards. */
sbf_status sbfi_assemble(
    sbfi_scene *scene, const sbfi_raw_scene *raw, const sbf_allocator *allocator, sbf_diagnostic *error);

/* Steps return false if memory runs out or the file was rejected. In order: unit and axes; nodes, with FBX
 * pivot helpers merged; which nodes are bones; materials and images; meshes; clips. */
bool sbfi_assemble_frame(sbfi_assembly *a);
bool sbfi_assemble_nodes(sbfi_assembly *a);
bool sbfi_assemble_bones(sbfi_assembly *a);
bool sbfi_assemble_materials(sbfi_assembly *a);
bool sbfi_assemble_meshes(sbfi_assembly *a);
bool sbfi_assemble_clips(sbfi_assembly *a);

/* assimp creates a mesh to show the bones of a file without one. It reports that only for some formats. */
bool sbfi_is_invented(const sbfi_assembly *a);

/* Whether the raw node is a merged helper. */
bool sbfi_is_folded(const sbfi_assembly *a, uint32_t raw_node);

/* Node that a skin or a clip means by a name: prefers a bone, then a node without a mesh. SBF_NONE for an
 * unknown name. Sets `*good` to false if memory runs out for the warning about ambiguity. */
int32_t sbfi_assembly_find(sbfi_assembly *a, sbfi_span name, bool *good);

#endif
