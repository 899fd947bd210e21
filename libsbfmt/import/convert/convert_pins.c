#include "import/convert/convert_pins.h"

#include <string.h>

/* Goal weights from this value on are rigid pins; exporters that divide by sums do not reach 1 exactly. */
static const double rigid_weight = 0.9999;

/* Index of the mesh's joint with that name; -1 if none. */
static int64_t joint_named(const sbfi_conversion *c, const sbfi_scene_mesh *mesh, const char *name) {
  for (uint32_t j = 0; j < mesh->skin.joint_count; j++)
    if (strcmp(c->scene->nodes[mesh->skin.joints[j].node].name, name) == 0) return j;
  return -1;
}

static const sbfi_scene_group *group_named(const sbfi_scene_mesh *mesh, const char *name) {
  for (uint32_t g = 0; g < mesh->group_count; g++)
    if (strcmp(mesh->groups[g].name, name) == 0) return &mesh->groups[g];
  return NULL;
}

static bool has_group(const sbfi_conversion *c, const sbfi_scene_mesh *mesh, const char *name) {
  return group_named(mesh, name) || joint_named(c, mesh, name) >= 0;
}

static int32_t bone_named(const sbfi_conversion *c, const char *name) {
  for (uint32_t i = 0; i < c->asset->bones.count; i++)
    if (strcmp(c->asset->bones.at[i].name, name) == 0) return (int32_t)i;
  return SBF_NONE;
}

bool sbfi_mesh_is_pinned(const sbfi_conversion *c, const sbfi_scene_mesh *mesh) {
  for (uint32_t i = 0; i < c->options->pinning.pin_count; i++)
    if (has_group(c, mesh, c->options->pinning.pins[i].group)) return true;
  return false;
}

static sbf_status check(sbfi_conversion *c, const sbf_convert_pin *pin) {
  bool found = false;
  for (uint32_t m = 0; m < c->scene->mesh_count; m++) found |= has_group(c, &c->scene->meshes[m], pin->group);
  if (!found)
    return sbfi_diagnose(c->error, SBF_CODE_IMPORT_PIN_UNKNOWN,
        "no mesh of %s has a vertex group or weights on a bone named '%s'", c->scene->file, pin->group);
  if (pin->bone && pin->bone[0] && bone_named(c, pin->bone) == SBF_NONE)
    return sbfi_diagnose(c->error, SBF_CODE_IMPORT_PIN_UNKNOWN, "no bone '%s' exists to pin group '%s' to",
        pin->bone, pin->group);
  return SBF_OK;
}

sbf_status sbfi_convert_check_pins(sbfi_conversion *c) {
  const sbf_convert_options *o = c->options;
  sbf_status status = SBF_OK;
  for (uint32_t i = 0; i < o->pinning.pin_count && status == SBF_OK; i++)
    status = check(c, &o->pinning.pins[i]);
  for (uint32_t i = 0; i < o->pinning.section_pin_count && status == SBF_OK; i++)
    status = check(c, &o->pinning.section_pins[i]);
  return status;
}

/* Weights of the points under a name, the sum of bone and group; 0 where neither is defined. */
static float *weights_of(sbfi_conversion *c, const sbfi_scene_mesh *mesh, const char *name) {
  float *weights = sbfi_arena_allocate(&c->scratch, (size_t)mesh->point_count + 1, sizeof *weights);
  const sbfi_scene_group *group = group_named(mesh, name);
  int64_t joint = joint_named(c, mesh, name);
  if (!weights) return NULL;
  if (group) memcpy(weights, group->weights, mesh->point_count * sizeof *weights);
  for (uint32_t i = 0; i < mesh->point_count && joint >= 0; i++)
    for (uint32_t s = mesh->skin.starts[i]; s < mesh->skin.starts[i + 1]; s++)
      if (mesh->skin.joint_index[s] == joint && mesh->skin.weights[s] > weights[i])
        weights[i] = mesh->skin.weights[s];
  return weights;
}

static bool fill_set(
    sbfi_conversion *c, const sbfi_scene_mesh *mesh, const sbf_convert_pin *pin, sbf_pin_set *set) {
  const sbf_convert_options *o = c->options;
  const float *weights = weights_of(c, mesh, pin->group);
  uint32_t *points = sbfi_convert_allocate(c, (size_t)mesh->point_count + 1, sizeof *points);
  float *goals = sbfi_convert_allocate(c, (size_t)mesh->point_count + 1, sizeof *goals);
  uint32_t count = 0, pinned = 0;
  sbf_pin_set_init(set);
  set->name = sbf_asset_copy_text(c->asset, pin->group);
  if (!weights || !points || !goals || !set->name) return false;
  for (uint32_t i = 0; i < mesh->point_count; i++) {
    if (!(weights[i] > 0)) continue;
    goals[count] = (double)weights[i] > rigid_weight ? 1 : sbfi_goal_weight((double)weights[i]);
    pinned += goals[count] >= 1;
    points[count++] = i;
  }
  set->points = (sbf_u32_list){count ? points : NULL, count};
  if (pinned < count) set->weights = (sbf_f32_list){goals, count};
  set->minimum = sbfi_goal_weight(o->pinning.goal_minimum);
  set->maximum = o->pinning.goal_maximum > 0 ? sbfi_goal_weight(o->pinning.goal_maximum) : 1;
  set->stiffness = (float)o->pinning.goal_stiffness;
  if (pin->bone && pin->bone[0]) set->bone = bone_named(c, pin->bone);
  return true;
}

/* Creates one set for each requested pin that names a group of the mesh. */
static bool fill_sets(sbfi_conversion *c, const sbfi_scene_mesh *mesh, const sbf_convert_pin *pins,
    uint32_t pin_count, sbf_pin_set *sets, uint32_t *count) {
  *count = 0;
  for (uint32_t i = 0; i < pin_count; i++)
    if (has_group(c, mesh, pins[i].group) && !fill_set(c, mesh, &pins[i], &sets[(*count)++])) return false;
  return true;
}

bool sbfi_pin_body(sbfi_conversion *c, const sbfi_scene_mesh *mesh, sbf_soft_body *body) {
  const sbf_convert_options *o = c->options;
  sbf_pin_set *sets = sbfi_convert_allocate(c, (size_t)o->pinning.pin_count + 1, sizeof *sets);
  uint32_t count;
  if (!sets || !fill_sets(c, mesh, o->pinning.pins, o->pinning.pin_count, sets, &count)) return false;
  for (uint32_t i = 0, set = 0; i < o->pinning.pin_count; i++) {
    if (!has_group(c, mesh, o->pinning.pins[i].group)) continue;
    if (!o->pinning.pins[i].bone) sets[set].bone = bone_named(c, o->pinning.pins[i].group);
    set++;
  }
  body->pins = (sbf_pin_set_list){count ? sets : NULL, count};
  return true;
}

bool sbfi_pin_skin(sbfi_conversion *c, const sbfi_scene_mesh *mesh, sbf_render_mesh *skin) {
  const sbf_convert_options *o = c->options;
  if (o->pinning.section_pin_count == 0) return true;
  sbf_pin_set *sets = sbfi_convert_allocate(c, o->pinning.section_pin_count, sizeof *sets);
  uint32_t count;
  if (!sets || !fill_sets(c, mesh, o->pinning.section_pins, o->pinning.section_pin_count, sets, &count))
    return false;
  skin->pins = (sbf_pin_set_list){count ? sets : NULL, count};
  return true;
}
