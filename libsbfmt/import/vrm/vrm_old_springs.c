/* Springs of VRM 0.x: "secondary animation". A bone group has one set of numbers for all bones below its
 * roots; every bone swings its first child, and a bone without children a point beyond itself. Colliders are
 * spheres whose offsets have z in Unity's direction, against glTF's. */
#include <float.h>
#include <stdio.h>

#include "import/vrm/vrm_reader.h"

/* Spheres of all groups in one list; `starts`: first of each group. */
static uint32_t *read_colliders(sbfi_vrm_reader *r, const sbfi_json *groups) {
  uint32_t group_count = sbfi_vrm_count(groups), count = 0;
  uint32_t *starts = sbfi_arena_allocate(&r->scratch, (size_t)group_count + 1, sizeof *starts);
  for (uint32_t g = 0; starts && g < group_count; g++) {
    starts[g] = count;
    count += sbfi_vrm_count(sbfi_json_get(sbfi_json_at(groups, g), "colliders"));
  }
  sbfi_vrm_collider *colliders = sbfi_vrm_allocate(r, count, sizeof *colliders);
  r->no_memory = r->no_memory || !starts;
  if (r->no_memory) return NULL;
  starts[group_count] = count;
  for (uint32_t g = 0; g < group_count; g++) {
    const sbfi_json *group = sbfi_json_at(groups, g), *list = sbfi_json_get(group, "colliders");
    int32_t node = sbfi_vrm_node(r, sbfi_json_get(group, "node"));
    char what[40];
    snprintf(what, sizeof what, "collider group %u", g);
    if (node == SBF_NONE)
      sbfi_vrm_warn(r, "%s is on a node that the scene does not have: it is left out", what);
    for (uint32_t i = 0; i < sbfi_vrm_count(list); i++) {
      const sbfi_json *from = sbfi_json_at(list, i);
      sbf_vec3 offset = sbfi_vrm_vector(r, from, "offset", what, (sbf_vec3){0, 0, 0});
      offset.z = 0 - offset.z;
      colliders[starts[g] + i] = (sbfi_vrm_collider){.node = node,
          .shape = SBF_CHAIN_COLLIDER_SHAPE_SPHERE,
          .offset = offset,
          .tail = offset,
          .normal = {0, 0, 1},
          .radius = sbfi_vrm_number(r, from, "radius", what, 0, 0, FLT_MAX)};
    }
  }
  r->vrm->colliders = colliders;
  r->vrm->collider_count = count;
  return starts;
}

/* First child of each node, or SBF_NONE. */
static int32_t *first_children(sbfi_vrm_reader *r) {
  uint32_t count = r->scene->node_count;
  int32_t *first = sbfi_arena_allocate(&r->scratch, (size_t)count + 1, sizeof *first);
  r->no_memory = r->no_memory || !first;
  for (uint32_t i = 0; first && i < count; i++) first[i] = SBF_NONE;
  for (uint32_t i = count; first && i-- > 0;)
    if (r->scene->nodes[i].parent != SBF_NONE) first[r->scene->nodes[i].parent] = (int32_t)i;
  return first;
}

/* A chain from `node` along first children. */
static void add_chain(sbfi_vrm_reader *r, const int32_t *first, int32_t node, const sbfi_vrm_joint *numbers,
    const sbfi_vrm_spring *like) {
  sbfi_vrm_spring spring = *like;
  spring.joint_count = 0;
  for (int32_t at = node; at != SBF_NONE && r->spring_of_node[at] == SBF_NONE; at = first[at])
    spring.joint_count++;
  sbfi_vrm_joint *joints = sbfi_vrm_allocate(r, spring.joint_count, sizeof *joints);
  if (!joints) return;
  for (uint32_t i = 0; i < spring.joint_count; i++, node = first[node]) {
    joints[i] = *numbers;
    joints[i].node = node;
  }
  spring.joints = joints;
  sbfi_vrm_add_spring(r, &spring);
}

/* Chains of a root and its descendants, which follow it in the list of nodes. */
static void add_root(sbfi_vrm_reader *r, const int32_t *first, int32_t root, const sbfi_vrm_joint *numbers,
    const sbfi_vrm_spring *like) {
  const sbfi_scene *scene = r->scene;
  for (int32_t i = root; i < (int32_t)scene->node_count && !r->no_memory; i++) {
    if (i != root && scene->nodes[i].parent < root) break; /* no descendant any more */
    if (r->spring_of_node[i] == SBF_NONE) add_chain(r, first, i, numbers, like);
  }
}

/* Colliders of the groups in the list. */
static void add_colliders(sbfi_vrm_reader *r, const uint32_t *starts, uint32_t group_count,
    const sbfi_json *list, const char *what, sbfi_vrm_spring *to) {
  if (!sbfi_vrm_count(list)) return;
  uint8_t *flags = sbfi_arena_allocate(&r->scratch, (size_t)group_count + 1, 1);
  uint32_t *chosen = sbfi_arena_allocate(&r->scratch, (size_t)group_count + 1, sizeof *chosen);
  uint32_t *at = sbfi_vrm_allocate(r, r->vrm->collider_count, sizeof *at);
  r->no_memory = r->no_memory || !flags || !chosen || !at;
  if (r->no_memory) return;
  sbfi_vrm_indices groups = {chosen, 0};
  sbfi_vrm_add_indices(r, list, group_count, flags, what, &groups);
  for (uint32_t i = 0; i < groups.count; i++)
    for (uint32_t k = starts[chosen[i]]; k < starts[chosen[i] + 1]; k++) at[to->collider_count++] = k;
  to->colliders = at;
}

void sbfi_vrm_read_old_springs(sbfi_vrm_reader *r, const sbfi_json *extension) {
  const sbfi_json *secondary = sbfi_json_get(extension, "secondaryAnimation");
  const sbfi_json *groups = sbfi_json_get(secondary, "boneGroups");
  const sbfi_json *collider_groups = sbfi_json_get(secondary, "colliderGroups");
  if (!secondary) return;
  const uint32_t *starts = read_colliders(r, collider_groups);
  const int32_t *first = first_children(r);
  for (uint32_t g = 0; g < sbfi_vrm_count(groups) && !r->no_memory; g++) {
    const sbfi_json *group = sbfi_json_at(groups, g), *roots = sbfi_json_get(group, "bones");
    char what[40];
    snprintf(what, sizeof what, "bone group %u", g);
    sbfi_vrm_spring like = {.name = sbfi_vrm_text(r, sbfi_json_get(group, "comment")),
        .center = sbfi_vrm_node(r, sbfi_json_get(group, "center")), /* -1: the world */
        .has_tail = true};
    sbfi_vrm_joint numbers = {.stiffness = sbfi_vrm_number(r, group, "stiffiness", what, 1, 0, FLT_MAX),
        .gravity_power = sbfi_vrm_number(r, group, "gravityPower", what, 0, -FLT_MAX, FLT_MAX),
        .gravity_direction = sbfi_vrm_vector(r, group, "gravityDir", what, (sbf_vec3){0, -1, 0}),
        .drag_force = sbfi_vrm_number(r, group, "dragForce", what, 0.4f, 0, 1),
        .hit_radius = sbfi_vrm_number(r, group, "hitRadius", what, 0, 0, FLT_MAX)};
    add_colliders(
        r, starts, sbfi_vrm_count(collider_groups), sbfi_json_get(group, "colliderGroups"), what, &like);
    for (uint32_t i = 0; i < sbfi_vrm_count(roots) && !r->no_memory; i++) {
      int32_t root = sbfi_vrm_node(r, sbfi_json_at(roots, i));
      if (root == SBF_NONE)
        sbfi_vrm_warn(r, "%s has a bone that the scene does not have: it is left out", what);
      else if (r->spring_of_node[root] != SBF_NONE)
        sbfi_vrm_warn(r, "%s has the bone \"%.60s\", which another group moves: it is left out", what,
            r->scene->nodes[root].name);
      else
        add_root(r, first, root, &numbers, &like);
    }
  }
}
