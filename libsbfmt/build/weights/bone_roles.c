#include "build/weights/bone_roles.h"

#include <string.h>

#include "model/bone_ends.h"

/* In units of the longest side: distance outside the body at which a joint is a control; tolerance for
 * equal positions. */
static const double OUTSIDE = 0.05, SAME_POSITION = 0.002;

enum { NAME_SIZE = 64 };

/* Lower case letters of a name. */
static void copy_letters(const char *name, char letters[NAME_SIZE]) {
  size_t count = 0;
  for (; name && *name && count + 1 < NAME_SIZE; name++) {
    char letter = (char)(*name | 0x20);
    if (letter >= 'a' && letter <= 'z') letters[count++] = letter;
  }
  letters[count] = 0;
}

static bool is_frame_name(const char *letters) {
  static const char *const names[] = {"root", "armature", "master", "rootjoint", "rootbone", "rootnode"};
  for (size_t i = 0; i < sizeof names / sizeof *names; i++)
    if (strcmp(letters, names[i]) == 0) return true;
  return false;
}

static bool is_control_name(const char *letters) {
  static const char *const parts[] = {"pole", "target", "control", "ctrl", "socket"};
  for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
    if (strstr(letters, parts[i])) return true;
  return false;
}

static bool has_child(const sbfi_weights_input *in, uint32_t bone) {
  for (uint32_t i = bone + 1; i < in->bone_count; i++)
    if (in->bones[i].parent == (int32_t)bone) return true;
  return false;
}

bool sbfi_bone_is_end(const sbfi_weights_input *in, uint32_t bone) {
  const char *name = in->bones[bone].name;
  return name && in->bones[bone].parent != SBF_NONE && !has_child(in, bone) &&
         sbfi_name_is_end(name, strlen(name));
}

/* Whether the bone has no children but end marks. */
static bool is_last(const sbfi_weights_input *in, uint32_t bone) {
  for (uint32_t i = bone + 1; i < in->bone_count; i++)
    if (in->bones[i].parent == (int32_t)bone && !sbfi_bone_is_end(in, i)) return false;
  return true;
}

bool sbfi_bone_is_on_root(const sbfi_weights_input *in, uint32_t bone) {
  int32_t parent = in->bones[bone].parent;
  return parent == SBF_NONE || in->bones[parent].parent == SBF_NONE;
}

static bool is_outside(const sbfi_body_rays *rays, sbfi_d3 at) {
  double squared = OUTSIDE * OUTSIDE;
  return sbfi_triangle_tree_nearest(&rays->tree, sbfi_d3_rounded(at), &squared) == UINT32_MAX &&
         !sbfi_body_contains(rays, at);
}

/* Whether a bone of another limb begins at the same position. */
static bool pulls_another(const sbfi_weights_input *in, const sbfi_weight_mesh *mesh, uint32_t bone) {
  for (uint32_t i = 0; i < in->bone_count; i++) {
    if (i == bone || (int32_t)i == in->bones[bone].parent || sbfi_bone_is_on_root(in, i)) continue;
    sbfi_d3 separation = sbfi_d3_sub(sbfi_weight_mesh_position(mesh, in->bones[i].head),
        sbfi_weight_mesh_position(mesh, in->bones[bone].head));
    if (sbfi_d3_length(separation) < SAME_POSITION) return true;
  }
  return false;
}

static uint32_t root_of(const sbfi_weights_input *in, uint32_t bone) {
  while (in->bones[bone].parent != SBF_NONE) bone = (uint32_t)in->bones[bone].parent;
  return bone;
}

static uint32_t largest_tree(const sbfi_weights_input *in) {
  uint32_t best = 0, max = 0;
  for (uint32_t root = 0; root < in->bone_count; root++) {
    uint32_t count = 0;
    if (in->bones[root].parent != SBF_NONE) continue;
    for (uint32_t i = root; i < in->bone_count; i++) count += root_of(in, i) == root;
    if (count > max) best = root, max = count;
  }
  return best;
}

/* Drops other trees of several bones with a joint at the position of one of the skeleton's: animators
 * control feet and hands with them. */
static void drop_helper_trees(
    const sbfi_weights_input *in, const sbfi_weight_mesh *mesh, bool *is_deforming) {
  uint32_t skeleton = largest_tree(in);
  for (uint32_t i = 0; i < in->bone_count; i++) {
    uint32_t root = root_of(in, i);
    bool is_helper = false;
    if (root == skeleton || (i == root && !has_child(in, i))) continue;
    for (uint32_t k = 0; k < in->bone_count && !is_helper; k++) {
      if (root_of(in, k) != skeleton) continue;
      sbfi_d3 separation = sbfi_d3_sub(sbfi_weight_mesh_position(mesh, in->bones[i].head),
          sbfi_weight_mesh_position(mesh, in->bones[k].head));
      is_helper = sbfi_d3_length(separation) < SAME_POSITION;
    }
    for (uint32_t k = root; is_helper && k < in->bone_count; k++)
      if (root_of(in, k) == root) is_deforming[k] = false;
  }
}

static void set_all(bool *is_deforming, uint32_t count) {
  for (uint32_t i = 0; i < count; i++) is_deforming[i] = true;
}

static bool has_any(const bool *is_deforming, uint32_t count) {
  for (uint32_t i = 0; i < count; i++)
    if (is_deforming[i]) return true;
  return false;
}

void sbfi_bone_roles_find(const sbfi_weights_input *in, const sbfi_weight_mesh *mesh,
    const sbfi_body_rays *rays, bool *is_deforming) {
  if (in->is_deforming) {
    memcpy(is_deforming, in->is_deforming, in->bone_count * sizeof *is_deforming);
    return;
  }
  set_all(is_deforming, in->bone_count);
  for (uint32_t i = 0; i < in->bone_count; i++) {
    char letters[NAME_SIZE];
    int32_t parent = in->bones[i].parent;
    copy_letters(in->bones[i].name, letters);
    bool is_control = is_control_name(letters);
    if (!is_control && sbfi_bone_is_on_root(in, i) && is_last(in, i))
      is_control = (rays && is_outside(rays, sbfi_weight_mesh_position(mesh, in->bones[i].head))) ||
                   pulls_another(in, mesh, i);
    if (is_control || is_frame_name(letters) || sbfi_bone_is_end(in, i) ||
        (sbfi_bone_is_on_root(in, i) && strstr(letters, "root")))
      is_deforming[i] = false;
    if (is_control && parent != SBF_NONE && in->bones[parent].parent == SBF_NONE)
      is_deforming[parent] = false;
  }
  drop_helper_trees(in, mesh, is_deforming);
  /* A rig with so few bones has no controls and no frames. */
  if (!has_any(is_deforming, in->bone_count)) set_all(is_deforming, in->bone_count);
}
