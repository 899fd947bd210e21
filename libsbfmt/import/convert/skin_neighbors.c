/* Finds the parents of detached bones from the skin: the bone across the border of their skin, else the
 * bone with the nearest skin. A target without skin at the end of a limb's last bone is its ankle. */
#include <string.h>

#include "import/convert/skeleton_draft.h"

/* maximum fraction of its border that a detached bone shares with its limb */
static const double MAX_BORDER = 0.5;
/* fraction of the size; from its skin to that of its limb's last bone */
static const double NEAR_LIMB = 0.04;
static const double NEAR_ANY = 0.02;    /* the same for bones other than the last of a limb */
static const double NEAR_TARGET = 0.04; /* fraction of the size; from a target to the skin that it moves */
static const double FAR_END = 0.5;      /* fraction of the last bone's length; targets are beyond */
enum { MAX_PINNED = 2, STEPS = 1500 };  /* bones with skin below a detached bone; points compared per bone */

typedef struct skin_points {
  sbfi_d3 *at;
  int32_t *bone;
  uint32_t count;
  double size; /* m */
} skin_points;

static int32_t main_bone(const sbfi_conversion *c, const sbfi_scene_mesh *mesh, uint32_t point) {
  uint32_t max = mesh->skin.starts[point], end = mesh->skin.starts[point + 1];
  if (max == end) return SBF_NONE;
  for (uint32_t k = max; k < end; k++)
    if (mesh->skin.weights[k] > mesh->skin.weights[max]) max = k;
  return c->bone_of_node[mesh->skin.joints[mesh->skin.joint_index[max]].node];
}

static bool gather(const sbfi_conversion *c, sbfi_skeleton_draft *s, sbfi_arena *scratch, skin_points *all) {
  size_t count = 1;
  double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
  for (uint32_t m = 0; m < c->rig->mesh_count; m++) count += c->rig->meshes[m].point_count;
  all->at = sbfi_arena_allocate(scratch, count, sizeof *all->at);
  all->bone = sbfi_arena_allocate(scratch, count, sizeof *all->bone);
  if (!all->at || !all->bone) return false;
  for (uint32_t m = 0; m < c->rig->mesh_count; m++) {
    const sbfi_scene_mesh *mesh = &c->rig->meshes[m];
    sbfi_matrix world = sbfi_scene_mesh_world(c->rig, mesh);
    world = sbfi_matrix_multiply(&c->rig_to_asset, &world);
    for (uint32_t i = 0; mesh->skin.joint_count && i < mesh->point_count; i++) {
      int32_t bone = main_bone(c, mesh, i);
      if (bone == SBF_NONE) continue;
      sbfi_d3 at = sbfi_d3_of(sbfi_transform_point(&world, mesh->points[i]));
      const double p[3] = {at.x, at.y, at.z};
      for (int k = 0; k < 3; k++) {
        low[k] = fmin(low[k], p[k]);
        high[k] = fmax(high[k], p[k]);
      }
      s->bones[bone].points++;
      all->bone[all->count] = bone;
      all->at[all->count++] = at;
    }
  }
  for (int k = 0; k < 3 && all->count; k++) all->size = fmax(all->size, high[k] - low[k]);
  return true;
}

static bool is_descendant(const sbfi_skeleton_draft *s, int32_t bone, int32_t above) {
  while (bone != above && bone != SBF_NONE) bone = s->bones[bone].parent;
  return bone == above;
}

/* Number of bones with skin in the subtree of a bone. */
static uint32_t count_weighted_bones(const sbfi_skeleton_draft *s, uint32_t bone) {
  uint32_t holding = 0;
  for (uint32_t i = 0; i < s->count; i++)
    holding += s->bones[i].points && is_descendant(s, (int32_t)i, (int32_t)bone);
  return holding;
}

/* Whether the bone has no parent, only a root, or only ancestors without skin. */
static bool is_loose(const sbfi_skeleton_draft *s, uint32_t bone) {
  int32_t parent = s->bones[bone].parent;
  if (parent == SBF_NONE) return s->count > 1;
  for (int32_t above = parent; above != SBF_NONE; above = s->bones[above].parent)
    if (s->bones[above].points) return false;
  int32_t grand = s->bones[parent].parent;
  return grand == SBF_NONE || s->bones[grand].parent == SBF_NONE;
}

/* Whether the bone is the last with skin of an attached limb of at least two bones. */
static bool is_last(const sbfi_skeleton_draft *s, int32_t bone) {
  int32_t parent = s->bones[bone].parent;
  if (!s->bones[bone].points || parent == SBF_NONE || s->bones[parent].parent == SBF_NONE) return false;
  return count_weighted_bones(s, (uint32_t)bone) == 1 && s->bones[parent].points;
}

static bool is_candidate(const sbfi_skeleton_draft *s, int32_t bone, uint32_t detached) {
  return bone != SBF_NONE && s->bones[bone].points && !is_descendant(s, bone, (int32_t)detached);
}

/* Counts edges between the skin of `bone` with its descendants and that of each other bone. */
static uint32_t count_border(
    const sbfi_conversion *c, const sbfi_skeleton_draft *s, uint32_t bone, uint32_t *border) {
  uint32_t total = 0;
  memset(border, 0, s->count * sizeof *border);
  for (uint32_t m = 0; m < c->rig->mesh_count; m++) {
    const sbfi_scene_mesh *mesh = &c->rig->meshes[m];
    for (uint32_t p = 0; mesh->skin.joint_count && p < mesh->polygon_count; p++) {
      uint32_t begin = mesh->polygon_starts[p], end = mesh->polygon_starts[p + 1];
      for (uint32_t k = begin; k < end; k++) {
        int32_t a = main_bone(c, mesh, mesh->corner_points[k]);
        int32_t b = main_bone(c, mesh, mesh->corner_points[k + 1 < end ? k + 1 : begin]);
        if (a == SBF_NONE || b == SBF_NONE || a == b) continue;
        bool inside = is_descendant(s, a, (int32_t)bone);
        if (inside == is_descendant(s, b, (int32_t)bone)) continue;
        border[inside ? b : a]++;
        total++;
      }
    }
  }
  return total;
}

/* Bone whose skin is nearest to that of `bone` and its descendants. */
static int32_t nearest_bone(
    const sbfi_skeleton_draft *s, const skin_points *all, uint32_t bone, double *distance) {
  int32_t best = SBF_NONE;
  double nearest = INFINITY;
  uint32_t own = 0, sampled = 0;
  for (uint32_t i = 0; i < all->count; i++) own += is_descendant(s, all->bone[i], (int32_t)bone);
  uint32_t step = own / STEPS + 1;
  for (uint32_t i = 0; i < all->count; i++) {
    if (!is_descendant(s, all->bone[i], (int32_t)bone) || sampled++ % step) continue;
    for (uint32_t k = 0; k < all->count; k++) {
      sbfi_d3 displacement = sbfi_d3_sub(all->at[k], all->at[i]);
      double squared = sbfi_d3_dot(displacement, displacement);
      if (squared >= nearest || !is_candidate(s, all->bone[k], bone)) continue;
      nearest = squared;
      best = all->bone[k];
    }
  }
  *distance = sqrt(nearest);
  return best;
}

static int32_t find_neighbor(const sbfi_conversion *c, const sbfi_skeleton_draft *s, const skin_points *all,
    uint32_t bone, uint32_t *border) {
  uint32_t total = count_border(c, s, bone, border), shared = 0;
  int32_t across = SBF_NONE;
  double distance;
  for (uint32_t i = 0; i < s->count; i++)
    if (border[i] > shared && is_candidate(s, (int32_t)i, bone)) {
      shared = border[i];
      across = (int32_t)i;
    }
  if (total && shared >= MAX_BORDER * total) return is_last(s, across) ? across : SBF_NONE;
  if (total) return SBF_NONE;
  int32_t nearest = nearest_bone(s, all, bone, &distance);
  if (nearest == SBF_NONE) return SBF_NONE;
  if (is_last(s, nearest)) return distance < NEAR_LIMB * all->size ? nearest : SBF_NONE;
  bool prop = s->bones[nearest].parent != SBF_NONE && count_weighted_bones(s, bone) == 1 &&
              s->bones[s->bones[nearest].parent].points;
  return prop && distance < NEAR_ANY * all->size ? nearest : SBF_NONE;
}

/* Limb whose last bone ends at the head of a target without skin. */
static int32_t find_target_limb(const sbfi_skeleton_draft *s, const skin_points *all, uint32_t bone) {
  double nearest = NEAR_TARGET * all->size, reach = 0;
  int32_t best = SBF_NONE;
  for (uint32_t k = 0; k < all->count; k++) {
    double distance = sbfi_d3_length(sbfi_d3_sub(all->at[k], s->bones[bone].head));
    if (distance >= nearest || !is_last(s, all->bone[k])) continue;
    nearest = distance;
    best = all->bone[k];
  }
  if (best == SBF_NONE || s->bones[best].next != SBF_NONE) return SBF_NONE;
  for (uint32_t k = 0; k < all->count; k++)
    if (all->bone[k] == best)
      reach = fmax(reach, sbfi_d3_length(sbfi_d3_sub(all->at[k], s->bones[best].head)));
  double travel = sbfi_d3_length(sbfi_d3_sub(s->bones[bone].head, s->bones[best].head));
  return travel > FAR_END * reach ? best : SBF_NONE;
}

bool sbfi_find_neighbors(sbfi_conversion *c, sbfi_skeleton_draft *s) {
  skin_points all = {.count = 0};
  uint32_t *border = sbfi_arena_allocate(&c->scratch, (size_t)s->count + 1, sizeof *border);
  if (!border || !gather(c, s, &c->scratch, &all)) return false;
  if (all.count == 0) return true;
  for (uint32_t i = 0; i < s->count; i++) {
    if (!is_loose(s, i)) continue;
    uint32_t holding = count_weighted_bones(s, i);
    if (holding == 0 && s->bones[i].below == 0)
      s->bones[i].neighbor = find_target_limb(s, &all, i);
    else if (holding && s->bones[i].points && holding <= MAX_PINNED)
      s->bones[i].neighbor = find_neighbor(c, s, &all, i, border);
  }
  return true;
}
