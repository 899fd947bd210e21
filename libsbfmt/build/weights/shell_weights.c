#include "build/weights/shell_weights.h"

#include <math.h>
#include <string.h>

#include "build/geometry/box_tree.h"

/* Sizes in units of the longest side. A small shell follows its leading bone; a medium one if that bone
 * leads clearly. */
static const double SMALL = 0.15, MIDDLING = 0.5, CLEAR_LEAD = 0.85;
/* A machine has many shells: the sum of squared area fractions is below one over this number, as for as
 * many equal shells. All its shells are rigid. */
static const double MACHINE_SHELLS = 12.5;
/* Minimum ratio of the smaller to the greater weight of both sides over a shell that belongs to neither. */
static const double BOTH_SIDES = 0.5;
/* Maximum distance of a hinge's joint from a shell's centre, as a fraction of its size. */
static const double HINGE_MIDDLE = 0.025;
/* As fractions of its size: distance beyond the end of a bone, and distance from it, for a shell that
 * follows the next bone; distance ahead of the joint of a last bone for a shell that follows it. */
static const double BEYOND = 0.15, NEAR_END = 0.75, AHEAD = 0.25;
/* Fraction of a bone after which shells may belong to the last bone that follows. */
static const double LAST_PART = 0.75;
/* Minimum ratio of length to width of an axle, and maximum cosine between it and its bone. */
static const double ELONGATED = 2, ACROSS = 0.5;

static void sort_weights(sbfi_site_weights *w) {
  for (int i = 1; i < SBFI_SITE_BONES; i++)
    for (int k = i; k > 0 && w->weights[k] > w->weights[k - 1]; k--) {
      float weight = w->weights[k];
      uint32_t bone = w->bones[k];
      w->weights[k] = w->weights[k - 1], w->bones[k] = w->bones[k - 1];
      w->weights[k - 1] = weight, w->bones[k - 1] = bone;
    }
}

static void set_single(sbfi_site_weights *w, uint32_t bone) {
  for (int k = 0; k < SBFI_SITE_BONES; k++) w->bones[k] = UINT32_MAX, w->weights[k] = 0;
  w->bones[0] = bone;
  w->weights[0] = 1;
}

/* Removes weights of the side with the smaller sum. */
static void erase_other_side(const sbfi_bone_segment *segments, sbfi_site_weights *w) {
  double sums[3] = {0, 0, 0};
  for (int k = 0; k < SBFI_SITE_BONES; k++)
    if (w->bones[k] != UINT32_MAX) sums[segments[w->bones[k]].side + 1] += (double)w->weights[k];
  if (sums[0] == 0 || sums[2] == 0) return;
  int erased = sums[2] >= sums[0] ? -1 : 1;
  for (int k = 0; k < SBFI_SITE_BONES; k++)
    if (w->bones[k] != UINT32_MAX && segments[w->bones[k]].side == erased) w->weights[k] = 0;
  sort_weights(w);
}

static void normalise(sbfi_site_weights *w) {
  double sum = 0;
  for (int k = 0; k < SBFI_WEIGHTS_PER_POINT; k++) sum += (double)w->weights[k];
  for (int k = 0; k < SBFI_SITE_BONES; k++) {
    w->weights[k] = k < SBFI_WEIGHTS_PER_POINT && sum > 0 ? (float)((double)w->weights[k] / sum) : 0;
    if (!(w->weights[k] > 0)) w->bones[k] = UINT32_MAX;
  }
}

static double site_distance(const void *user, uint32_t site, const double point[3]) {
  const sbf_vec3 *sites = user;
  sbfi_d3 separation = sbfi_d3_sub(sbfi_d3_of(sites[site]), (sbfi_d3){point[0], point[1], point[2]});
  return sbfi_d3_dot(separation, separation);
}

/* Whether a mesh consists of many separate parts, as machines and jointed dolls do. */
static bool is_machine(const sbfi_weight_mesh *mesh) {
  double whole = 0, squares = 0;
  for (uint32_t s = 0; s < mesh->shell_count; s++) {
    double area = 0;
    for (uint32_t i = 0; i < mesh->shells[s].site_count; i++)
      area += mesh->areas[mesh->sites_by_shell[mesh->shells[s].first_site + i]];
    whole += area;
    squares += area * area;
  }
  return whole * whole > MACHINE_SHELLS * squares;
}

/* Small shells without a bone inside, such as eyes in a head, copy the weights of the nearest sites of shells
 * with one. */
static bool copy_from_bone_shells(const sbfi_weight_mesh *mesh, const sbfi_bone_reach *reach,
    sbfi_site_weights *weights, sbfi_arena *arena) {
  sbf_vec3 *positions = sbfi_arena_allocate(arena, mesh->site_count, sizeof *positions);
  uint32_t *sites = sbfi_arena_allocate(arena, mesh->site_count, sizeof *sites), count = 0;
  sbfi_box *boxes = sbfi_arena_allocate(arena, mesh->site_count, sizeof *boxes);
  if (!positions || !sites || !boxes) return false;
  for (uint32_t i = 0; i < mesh->site_count; i++) {
    if (!reach->shell_contains_bone[mesh->shell_of_site[i]]) continue;
    sbf_vec3 at = mesh->sites[i];
    boxes[count] = (sbfi_box){{at.x, at.y, at.z}, {at.x, at.y, at.z}};
    positions[count] = at;
    sites[count++] = i;
  }
  sbfi_box_tree tree;
  if (count == 0 || count == mesh->site_count) return true;
  if (!sbfi_box_tree_build(&tree, boxes, count, arena)) return false;
  for (uint32_t i = 0; i < mesh->site_count; i++) {
    uint32_t shell = mesh->shell_of_site[i];
    if (reach->shell_contains_bone[shell] || (mesh->shells[shell].size >= SMALL && !is_machine(mesh)))
      continue;
    double nearest = INFINITY;
    sbf_vec3 at = mesh->sites[i];
    uint32_t found = sbfi_box_tree_nearest(
        &tree, (double[]){(double)at.x, (double)at.y, (double)at.z}, site_distance, positions, &nearest);
    if (found != UINT32_MAX) weights[i] = weights[sites[found]];
  }
  return true;
}

/* If bones of both sides have much weight in a shell, middle bones lead, if any has weight. */
static void drop_sides(const sbfi_bone_segment *segments, double *sums, uint32_t bone_count) {
  double sides[3] = {0, 0, 0};
  for (uint32_t b = 0; b < bone_count; b++) sides[segments[b].side + 1] += sums[b];
  if (sides[1] <= 0 || fmin(sides[0], sides[2]) < BOTH_SIDES * fmax(sides[0], sides[2])) return;
  for (uint32_t b = 0; b < bone_count; b++)
    if (segments[b].side) sums[b] = 0;
}

/* Bone with the greatest weight over a shell, by area, and its fraction of the total. */
static uint32_t leading_bone(const sbfi_weight_mesh *mesh, uint32_t shell, const sbfi_bone_segment *segments,
    const sbfi_site_weights *weights, double *sums, uint32_t bone_count, double *fraction) {
  const uint32_t *sites = mesh->sites_by_shell + mesh->shells[shell].first_site;
  double whole = 0;
  memset(sums, 0, bone_count * sizeof *sums);
  for (uint32_t i = 0; i < mesh->shells[shell].site_count; i++)
    for (int k = 0; k < SBFI_SITE_BONES && weights[sites[i]].bones[k] != UINT32_MAX; k++) {
      double weight = (double)weights[sites[i]].weights[k] * mesh->areas[sites[i]];
      sums[weights[sites[i]].bones[k]] += weight;
      whole += weight;
    }
  drop_sides(segments, sums, bone_count);
  uint32_t best = 0;
  for (uint32_t b = 1; b < bone_count; b++)
    if (sums[b] > sums[best]) best = b;
  *fraction = whole > 0 ? sums[best] / whole : 0;
  return best;
}

/* Centroid of a shell's surface; false if it has no area. */
static bool middle_of(const sbfi_weight_mesh *mesh, const sbfi_shell *shell, sbfi_d3 *middle) {
  double whole = 0;
  *middle = (sbfi_d3){0, 0, 0};
  for (uint32_t i = 0; i < shell->site_count; i++) {
    uint32_t site = mesh->sites_by_shell[shell->first_site + i];
    *middle = sbfi_d3_add(*middle, sbfi_d3_scale(sbfi_d3_of(mesh->sites[site]), mesh->areas[site]));
    whole += mesh->areas[site];
  }
  if (whole > 0) *middle = sbfi_d3_scale(*middle, 1 / whole);
  return whole > 0;
}

/* The only bone that begins in the centre of a shell: the shell is the ball or hinge of its joint and
 * moves with it. UINT32_MAX: none, or several. */
static uint32_t bone_of_hinge(
    const sbfi_shell *shell, sbfi_d3 middle, const sbfi_bone_segment *segments, uint32_t bone_count) {
  uint32_t found = UINT32_MAX;
  for (uint32_t b = 0; b < bone_count; b++) {
    if (!segments[b].is_deforming ||
        sbfi_d3_length(sbfi_d3_sub(segments[b].head, middle)) > HINGE_MIDDLE * shell->size)
      continue;
    if (found != UINT32_MAX) return UINT32_MAX;
    found = b;
  }
  return found;
}

/* A shell at the end of the leading bone, such as a kneecap or an ankle block, moves with the next bone.
 * UINT32_MAX: not such a shell. */
static uint32_t bone_behind(
    const sbfi_shell *shell, sbfi_d3 middle, const sbfi_bone_segment *segments, uint32_t bone) {
  const sbfi_bone_segment *leading = &segments[bone];
  sbfi_d3 along = sbfi_d3_sub(leading->tail, leading->head), left = sbfi_d3_sub(leading->tail, middle);
  double length = sbfi_d3_length(along);
  if (leading->next == SBF_NONE || !segments[leading->next].is_deforming || !(length > 0)) return UINT32_MAX;
  if (shell->size > length || sbfi_d3_dot(left, along) > -BEYOND * length * shell->size) return UINT32_MAX;
  return sbfi_d3_length(left) > NEAR_END * shell->size ? UINT32_MAX : (uint32_t)leading->next;
}

/* Whether the other bone is in the chain that begins with `bone`. */
static bool is_above(const sbfi_bone_segment *segments, uint32_t bone, uint32_t other) {
  for (int32_t b = (int32_t)bone; b != SBF_NONE; b = segments[b].next)
    if (b == (int32_t)other) return true;
  return false;
}

/* A long shell across the leading bone, around its joint, is its axle and moves with the parts at its
 * inner end. UINT32_MAX: not an axle. */
static uint32_t bone_of_axle(const sbfi_shell *shell, sbfi_d3 middle, const sbfi_bone_segment *segments,
    uint32_t bone_count, uint32_t bone) {
  const sbfi_bone_segment *leading = &segments[bone];
  sbfi_d3 sides = sbfi_d3_sub(shell->high, shell->low), along = sbfi_d3_sub(leading->tail, leading->head);
  const double side[3] = {sides.x, sides.y, sides.z}, direction[3] = {along.x, along.y, along.z};
  const double head[3] = {leading->head.x, leading->head.y, leading->head.z};
  const double low[3] = {shell->low.x, shell->low.y, shell->low.z};
  int axis = side[0] >= side[1] && side[0] >= side[2] ? 0 : side[1] >= side[2] ? 1 : 2;
  uint32_t best = UINT32_MAX;
  double nearest = INFINITY;
  if (fabs(direction[axis]) > ACROSS * sbfi_d3_length(along)) return UINT32_MAX;
  for (int k = 0; k < 3; k++) {
    if (k != axis && ELONGATED * side[k] > side[axis]) return UINT32_MAX;
    if (head[k] < low[k] || head[k] > low[k] + side[k]) return UINT32_MAX;
  }
  for (uint32_t b = 0; b < bone_count; b++) {
    double squared = sbfi_segment_distance2(&segments[b], middle);
    if (!segments[b].is_deforming || is_above(segments, bone, b) || squared >= nearest) continue;
    nearest = squared;
    best = b;
  }
  return best != UINT32_MAX && nearest < sbfi_segment_distance2(&segments[best], leading->head) ? best
                                                                                                : UINT32_MAX;
}

static void stiffen(
    const sbfi_weight_mesh *mesh, const sbfi_shell *shell, uint32_t bone, sbfi_site_weights *weights) {
  for (uint32_t i = 0; i < shell->site_count; i++)
    set_single(&weights[mesh->sites_by_shell[shell->first_site + i]], bone);
}

/* Parts of a foot are around the end of the lower leg as much as around the foot's joint; the same holds
 * for claws. Shells there, ahead of that joint, move with the last bone. `leaders` (shells): bone that
 * moves each. */
static void assign_to_last_bones(const sbfi_weight_mesh *mesh, const sbfi_bone_segment *segments,
    const uint32_t *leaders, sbfi_site_weights *weights) {
  for (uint32_t s = 0; s < mesh->shell_count; s++) {
    const sbfi_bone_segment *bone = &segments[leaders[s]];
    sbfi_d3 along = sbfi_d3_sub(bone->tail, bone->head), middle;
    if (bone->next == SBF_NONE || !middle_of(mesh, &mesh->shells[s], &middle)) continue;
    const sbfi_bone_segment *last = &segments[bone->next];
    sbfi_d3 axis = sbfi_d3_sub(last->tail, last->head), from_joint = sbfi_d3_sub(middle, last->head);
    double reached = sbfi_d3_dot(sbfi_d3_sub(middle, bone->head), along);
    bool is_ahead = sbfi_d3_dot(from_joint, axis) > AHEAD * mesh->shells[s].size * sbfi_d3_length(axis);
    if (last->is_deforming && last->next == SBF_NONE && is_ahead &&
        reached > LAST_PART * sbfi_d3_dot(along, along))
      stiffen(mesh, &mesh->shells[s], (uint32_t)bone->next, weights);
  }
}

static bool stiffen_shells(const sbfi_weight_mesh *mesh, const sbfi_bone_segment *segments,
    uint32_t bone_count, sbfi_site_weights *weights, sbfi_weights_figures *figures, sbfi_arena *arena) {
  bool all = is_machine(mesh);
  double *sums = sbfi_arena_allocate(arena, bone_count, sizeof *sums), fraction;
  uint32_t *leaders = sbfi_arena_allocate(arena, (size_t)mesh->shell_count + 1, sizeof *leaders);
  if (!sums || !leaders) return false;
  figures->shell_count = mesh->shell_count;
  for (uint32_t s = 0; s < mesh->shell_count; s++) {
    const sbfi_shell *shell = &mesh->shells[s];
    leaders[s] = UINT32_MAX;
    if (shell->size >= MIDDLING && !all) continue;
    uint32_t bone = leading_bone(mesh, s, segments, weights, sums, bone_count, &fraction);
    if (shell->size >= SMALL && fraction <= CLEAR_LEAD && !all) continue;
    sbfi_d3 middle;
    if (middle_of(mesh, shell, &middle)) {
      uint32_t other = bone_of_hinge(shell, middle, segments, bone_count);
      if (other == UINT32_MAX && all) other = bone_behind(shell, middle, segments, bone);
      if (other == UINT32_MAX && all) other = bone_of_axle(shell, middle, segments, bone_count, bone);
      if (other != UINT32_MAX) bone = other;
    }
    leaders[s] = bone;
    stiffen(mesh, shell, bone, weights);
    figures->rigid_shell_count++;
  }
  if (all) assign_to_last_bones(mesh, segments, leaders, weights);
  return true;
}

bool sbfi_shell_weights_repair(const sbfi_weight_mesh *mesh, const sbfi_bone_segment *segments,
    uint32_t bone_count, const sbfi_bone_reach *reach, sbfi_site_weights *weights,
    sbfi_weights_figures *figures, sbfi_arena *arena) {
  if (!copy_from_bone_shells(mesh, reach, weights, arena) ||
      !stiffen_shells(mesh, segments, bone_count, weights, figures, arena))
    return false;
  for (uint32_t i = 0; i < mesh->site_count; i++) {
    erase_other_side(segments, &weights[i]);
    normalise(&weights[i]);
  }
  return true;
}
