/* Assigns shells to bones at the caller's request: whole objects, or numbered pieces. */
#include <stdlib.h>
#include <string.h>

#include "base/union_find.h"
#include "import/rigging/weigh.h"

typedef struct shell_assignment {
  int32_t mesh;    /* of the input */
  uint32_t number; /* shell number from 1; 0: all */
  int32_t node;    /* of the rig */
} shell_assignment;

static int32_t find_object(const sbfi_rigging *r, const char *name, size_t length) {
  const sbfi_scene *scene = r->input.scene;
  for (uint32_t m = 0; m < scene->mesh_count; m++) {
    const char *object = scene->nodes[scene->meshes[m].node].name;
    if (strlen(object) == length && memcmp(object, name, length) == 0) return (int32_t)m;
  }
  return SBF_NONE;
}

/* OBJECT or OBJECT#NUMBER; the object's name may contain the sign. */
static sbf_status read_assignment(
    const sbfi_rigging *r, const sbf_convert_pin *from, shell_assignment *assignment) {
  const sbf_bone_list bones = r->c->asset->bones;
  const char *sign = strrchr(from->group, '#');
  char *end = NULL;
  *assignment = (shell_assignment){find_object(r, from->group, strlen(from->group)), 0, SBF_NONE};
  if (assignment->mesh == SBF_NONE && sign) {
    unsigned long number = strtoul(sign + 1, &end, 10);
    if (end != sign + 1 && !*end && number > 0 && number < UINT32_MAX) {
      assignment->mesh = find_object(r, from->group, (size_t)(sign - from->group));
      assignment->number = (uint32_t)number;
    }
  }
  if (assignment->mesh == SBF_NONE)
    return sbfi_diagnose(r->c->error, SBF_CODE_IMPORT_PIN_UNKNOWN,
        "no object of %s has the name '%s' of --shell: name an object, or a shell of it as OBJECT#NUMBER",
        r->input.scene->file, from->group);
  for (uint32_t b = 0; b < bones.count && assignment->node == SBF_NONE; b++)
    if (from->bone && strcmp(bones.at[b].name, from->bone) == 0)
      assignment->node = (int32_t)r->c->node_of_bone[b];
  if (assignment->node == SBF_NONE)
    return sbfi_diagnose(r->c->error, SBF_CODE_IMPORT_PIN_UNKNOWN,
        "--shell: no bone of the rig has the name '%s', so it cannot move '%s'", from->bone ? from->bone : "",
        from->group);
  return SBF_OK;
}

static void assign_point(sbfi_rigging *r, uint32_t point, int32_t node) {
  memset(&r->weights[point], 0, sizeof r->weights[point]);
  sbfi_influences_add(&r->weights[point], (uint32_t)node, 1);
  sbfi_influences_finish(&r->weights[point]);
  r->sources[point] = SBFI_WEIGHTS_NAMED;
}

/* Assigns the requested points; numbers shells by their first points. */
static sbf_status apply_request(
    sbfi_rigging *r, const shell_assignment *assignment, const char *name, uint32_t *parents) {
  uint32_t from = r->input.mesh_starts[assignment->mesh], to = r->input.mesh_starts[assignment->mesh + 1],
           shells = 0;
  if (r->parent_nodes[assignment->mesh] != SBF_NONE && assignment->number)
    return sbfi_diagnose(r->c->error, SBF_CODE_IMPORT_PIN_UNKNOWN,
        "'%s' is part of an object that moves rigidly with a bone of its name: rename it, or assign the "
        "whole object",
        name);
  if (r->parent_nodes[assignment->mesh] != SBF_NONE) r->parent_nodes[assignment->mesh] = assignment->node;
  uint32_t wanted = UINT32_MAX;
  for (uint32_t i = from; i < to; i++)
    if (sbfi_set_root(parents, i) == i && ++shells == assignment->number) wanted = i;
  if (assignment->number > shells)
    return sbfi_diagnose(r->c->error, SBF_CODE_IMPORT_PIN_UNKNOWN,
        "there is no shell '%s': the object has %u shells", name, shells);
  for (uint32_t i = from; i < to; i++)
    if (!assignment->number || sbfi_set_root(parents, i) == wanted) assign_point(r, i, assignment->node);
  return SBF_OK;
}

sbf_status sbfi_weigh_shells(sbfi_rigging *r) {
  const sbf_convert_options *options = r->c->options;
  uint32_t count = r->input.mesh.positions.count;
  if (!options->rigging.shell_count) return SBF_OK;
  uint32_t *parents = sbfi_arena_allocate(&r->c->scratch, (size_t)count + 1, sizeof *parents);
  if (!parents) return sbfi_convert_no_memory(r->c);
  sbfi_sets_begin(parents, count);
  const uint32_t *corners = r->input.mesh.polygon_points.at;
  for (uint32_t p = 0; p < r->input.mesh.polygon_sizes.count; corners += r->input.mesh.polygon_sizes.at[p++])
    for (uint32_t k = 1; k < r->input.mesh.polygon_sizes.at[p]; k++)
      sbfi_sets_join(parents, corners[0], corners[k]);
  sbf_status status = SBF_OK;
  for (uint32_t i = 0; status == SBF_OK && i < options->rigging.shell_count; i++) {
    shell_assignment assignment;
    status = read_assignment(r, &options->rigging.shells[i], &assignment);
    if (status == SBF_OK) status = apply_request(r, &assignment, options->rigging.shells[i].group, parents);
  }
  return status;
}
