/* VRMC_springBone 1.0 and VRMC_springBone_extended_collider 1.0. */
#include <float.h>
#include <stdio.h>
#include <string.h>

#include "import/vrm/vrm_reader.h"

static const sbf_vec3 ORIGIN = {0, 0, 0};

/* Name of a part for messages: "spring 3 \"hair\"". */
typedef struct label {
  char text[96];
} label;

static label label_of(const char *kind, uint32_t index, const char *name) {
  label l;
  snprintf(l.text, sizeof l.text, *name ? "%s %u \"%.60s\"" : "%s %u", kind, index, name);
  return l;
}

static bool read_shape(sbfi_vrm_reader *r, const sbfi_json *shape, const char *what, sbfi_vrm_collider *to) {
  const sbfi_json *sphere = sbfi_json_get(shape, "sphere"), *capsule = sbfi_json_get(shape, "capsule");
  const sbfi_json *plane = sbfi_json_get(shape, "plane"), *one = sphere ? sphere : capsule ? capsule : plane;
  if (!one) return false;
  to->shape = sphere    ? SBF_CHAIN_COLLIDER_SHAPE_SPHERE
              : capsule ? SBF_CHAIN_COLLIDER_SHAPE_CAPSULE
                        : SBF_CHAIN_COLLIDER_SHAPE_PLANE;
  to->offset = sbfi_vrm_vector(r, one, "offset", what, ORIGIN);
  to->tail = capsule && !sphere ? sbfi_vrm_vector(r, one, "tail", what, ORIGIN) : to->offset;
  to->normal =
      one == plane ? sbfi_vrm_vector(r, one, "normal", what, (sbf_vec3){0, 0, 1}) : (sbf_vec3){0, 0, 1};
  to->radius = one == plane ? 0 : sbfi_vrm_number(r, one, "radius", what, 0, 0, FLT_MAX);
  const sbfi_json *inside = sbfi_json_get(one, "inside");
  to->inside = one != plane && inside && inside->type == SBFI_JSON_TRUE;
  if (to->normal.x != 0 || to->normal.y != 0 || to->normal.z != 0) return true;
  sbfi_vrm_warn(r, "the normal of %s has no direction: it is left out", what);
  to->node = SBF_NONE;
  return true;
}

static void read_collider(sbfi_vrm_reader *r, const sbfi_json *from, uint32_t index, sbfi_vrm_collider *to) {
  const sbfi_json *extended =
      sbfi_json_get(sbfi_json_get(from, "extensions"), "VRMC_springBone_extended_collider");
  label what = label_of("collider", index, "");
  to->node = sbfi_vrm_node(r, sbfi_json_get(from, "node"));
  if (to->node == SBF_NONE) {
    sbfi_vrm_warn(r, "%s is on a node that the scene does not have: it is left out", what.text);
    return;
  }
  if (extended && sbfi_json_is_string(sbfi_json_get(extended, "specVersion"), "1.0") &&
      read_shape(r, sbfi_json_get(extended, "shape"), what.text, to))
    return;
  if (read_shape(r, sbfi_json_get(from, "shape"), what.text, to)) return;
  sbfi_vrm_warn(r, "%s has no shape that is a sphere or a capsule: it is left out", what.text);
  to->node = SBF_NONE;
}

static void read_colliders(sbfi_vrm_reader *r, const sbfi_json *list) {
  uint32_t count = sbfi_vrm_count(list);
  sbfi_vrm_collider *colliders = sbfi_vrm_allocate(r, count, sizeof *colliders);
  if (!colliders) return;
  for (uint32_t i = 0; i < count; i++) read_collider(r, sbfi_json_at(list, i), i, &colliders[i]);
  r->vrm->colliders = colliders;
  r->vrm->collider_count = count;
}

static bool is_below(const sbfi_scene *scene, int32_t node, int32_t ancestor) {
  while (node > ancestor) node = scene->nodes[node].parent; /* parents come first */
  return node == ancestor;
}

/* Why a spring cannot be read; NULL: it can. */
static const char *fault_of(const sbfi_vrm_reader *r, const sbfi_vrm_joint *joints, uint32_t count) {
  if (count < 2) return "has less than two joints";
  for (uint32_t i = 0; i < count; i++) {
    if (joints[i].node == SBF_NONE) return "has a joint at a node that the scene does not have";
    if (r->spring_of_node[joints[i].node] != SBF_NONE) return "shares a joint with another spring";
    if (i > 0 &&
        (joints[i].node == joints[i - 1].node || !is_below(r->scene, joints[i].node, joints[i - 1].node)))
      return "has a joint that is not below the one before it";
  }
  return NULL;
}

static void read_joint(sbfi_vrm_reader *r, const sbfi_json *from, const char *what, sbfi_vrm_joint *to) {
  to->node = sbfi_vrm_node(r, sbfi_json_get(from, "node"));
  to->stiffness = sbfi_vrm_number(r, from, "stiffness", what, 1, 0, FLT_MAX);
  to->gravity_power = sbfi_vrm_number(r, from, "gravityPower", what, 0, -FLT_MAX, FLT_MAX);
  to->gravity_direction = sbfi_vrm_vector(r, from, "gravityDir", what, (sbf_vec3){0, -1, 0});
  to->drag_force = sbfi_vrm_number(r, from, "dragForce", what, 0.4f, 0, 1);
  to->hit_radius = sbfi_vrm_number(r, from, "hitRadius", what, 0, 0, FLT_MAX);
}

static void read_groups(sbfi_vrm_reader *r, const sbfi_json *groups, const sbfi_json *list, const char *what,
    sbfi_vrm_spring *to) {
  uint32_t group_count = sbfi_vrm_count(groups), count = r->vrm->collider_count;
  if (!sbfi_vrm_count(list)) return;
  uint8_t *flags = sbfi_arena_allocate(&r->scratch, (size_t)group_count + count + 1, 1);
  uint32_t *chosen = sbfi_arena_allocate(&r->scratch, (size_t)group_count + 1, sizeof *chosen);
  uint32_t *at = sbfi_vrm_allocate(r, count, sizeof *at);
  r->no_memory = r->no_memory || !flags || !chosen || !at;
  if (r->no_memory) return;
  sbfi_vrm_indices of_groups = {chosen, 0}, colliders = {at, 0};
  sbfi_vrm_add_indices(r, list, group_count, flags, what, &of_groups);
  for (uint32_t i = 0; i < of_groups.count; i++)
    sbfi_vrm_add_indices(r, sbfi_json_get(sbfi_json_at(groups, chosen[i]), "colliders"), count,
        flags + group_count, "a collider group", &colliders);
  to->colliders = at;
  to->collider_count = colliders.count;
}

static void read_spring(sbfi_vrm_reader *r, const sbfi_json *from, const sbfi_json *groups, uint32_t index) {
  const sbfi_json *joints = sbfi_json_get(from, "joints"), *center = sbfi_json_get(from, "center");
  sbfi_vrm_spring spring = {.name = sbfi_vrm_text(r, sbfi_json_get(from, "name")),
      .center = sbfi_vrm_node(r, center),
      .joint_count = sbfi_vrm_count(joints)};
  label what = label_of("spring", index, spring.name);
  sbfi_vrm_joint *read = sbfi_vrm_allocate(r, spring.joint_count, sizeof *read);
  if (!read) return;
  for (uint32_t i = 0; i < spring.joint_count; i++)
    read_joint(r, sbfi_json_at(joints, i), what.text, &read[i]);
  spring.joints = read;
  const char *fault = fault_of(r, read, spring.joint_count);
  if (fault) {
    sbfi_vrm_warn(r, "%s %s: it is left out", what.text, fault);
    return;
  }
  if (center && (spring.center == SBF_NONE || !is_below(r->scene, read[0].node, spring.center))) {
    sbfi_vrm_warn(r, "the center of %s is not above its first joint: it swings in the world", what.text);
    spring.center = SBF_NONE;
  }
  read_groups(r, groups, sbfi_json_get(from, "colliderGroups"), what.text, &spring);
  sbfi_vrm_add_spring(r, &spring);
}

void sbfi_vrm_read_springs(sbfi_vrm_reader *r, const sbfi_json *extension) {
  const sbfi_json *version = sbfi_json_get(extension, "specVersion");
  const sbfi_json *springs = sbfi_json_get(extension, "springs");
  const sbfi_json *groups = sbfi_json_get(extension, "colliderGroups");
  if (!sbfi_json_is_string(version, "1.0") && !sbfi_json_is_string(version, "1.0-beta")) {
    sbfi_vrm_warn(r, "VRMC_springBone is of another version than 1.0: its springs are left out");
    return;
  }
  read_colliders(r, sbfi_json_get(extension, "colliders"));
  for (uint32_t i = 0; i < sbfi_vrm_count(springs) && !r->no_memory; i++)
    read_spring(r, sbfi_json_at(springs, i), groups, i);
}
