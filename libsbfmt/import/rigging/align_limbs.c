/* Turns limbs of a rig so that they lie inside the input: a rig with its arms stretched out for a mesh whose
 * arms hang, or the other way round.
 *
 * From the trunk to the tips each limb is turned as a whole about its joint: of many directions the nearest
 * to where it points that brings nearly as much of its length inside as any, and along parts of the input
 * that no other bone is near to: a leg lies inside the trunk and inside the other leg as well. Where little
 * is gained it stays. */
#include "import/rigging/align.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "motion/carried_motion.h"
#include "motion/turn.h"

enum { DIRECTIONS = 600, PER_BONE = 8, REFINED = 24, COVERED_SAMPLES = 300 };

/* Inside as it should be; what a turn has to gain; how much worse than the best a lesser turn may be; the
 * greatest turn, as a cosine. All but the last in shares of the limb's length. */
static const double GOOD = 0.9, GAIN = 0.2, NEARLY = 0.05, FARTHEST = 0.2;
/* A limb is no more than this share of all bones, and no less than that: fingers do not show in a winding
 * number. */
static const double LIMB = 0.45, MIN_LIMB = 0.02;
/* A bone on which so much of a limb hangs may turn for it, if that is no worse than by so much. */
static const double CHAIN_OF_LIMB = 0.7, SLIGHTLY = 0.1;
/* Farther from a bone, as a share of the input's size, is no worse. */
static const double FAR = 0.15;
/* So far from the middle, as a share of its length, all of a limb lies that no name gives a side. */
static const double ASIDE = 0.02;

typedef struct limbs {
  sbfi_rigging *r;
  const sbfi_winding *winding;
  sbfi_matrix back; /* asset space to that of the input */
  sbf_bone *bones;
  uint32_t bone_count;
  bool *below;                       /* (bone_count) of the limb at hand, its first bone included */
  double length, all;                /* of its bones; of all bones */
  sbfi_d3 samples[COVERED_SAMPLES];  /* of the input's points, asset space */
  double distances[COVERED_SAMPLES]; /* to the nearest other bone, at most `far` */
  double far;
} limbs;

static sbfi_d3 turned(const double rotation[4], sbfi_d3 about, sbfi_d3 p) {
  sbfi_d3 displacement = sbfi_d3_sub(p, about);
  double to[3];
  sbfi_turn_vector(rotation, (const double[3]){displacement.x, displacement.y, displacement.z}, to);
  return sbfi_d3_add(about, (sbfi_d3){to[0], to[1], to[2]});
}

static bool is_inside(const limbs *l, sbfi_d3 asset_point) {
  sbfi_d3 p = sbfi_similarity_apply(&l->back, asset_point);
  return sbfi_winding_inside(sbfi_winding_of_closed(l->winding, p), sbfi_winding_of_caps(l->winding, p));
}

static sbfi_d3 head_of(const limbs *l, uint32_t bone) {
  return sbfi_d3_of(l->bones[bone].head);
}

/* Share of the limb's length inside, turned about its first joint. */
static double inside_fraction(const limbs *l, uint32_t first, const double rotation[4]) {
  double inside = 0;
  for (uint32_t b = first + 1; b < l->bone_count; b++) {
    if (!l->below[b]) continue;
    sbfi_d3 from = head_of(l, (uint32_t)l->bones[b].parent), along = sbfi_d3_sub(head_of(l, b), from);
    double length = sbfi_d3_length(along);
    for (int k = 0; k < PER_BONE; k++) {
      sbfi_d3 at = sbfi_d3_add(from, sbfi_d3_scale(along, (k + 0.5) / PER_BONE));
      inside += length / PER_BONE * is_inside(l, turned(rotation, head_of(l, first), at));
    }
  }
  return inside / l->length;
}

static double squared_distance_to_bone(sbfi_d3 p, sbfi_d3 from, sbfi_d3 to) {
  sbfi_d3 along = sbfi_d3_sub(to, from), displacement = sbfi_d3_sub(p, from);
  double squared = sbfi_d3_dot(along, along);
  double t = squared > 0 ? fmin(fmax(sbfi_d3_dot(displacement, along) / squared, 0), 1) : 0;
  displacement = sbfi_d3_sub(displacement, sbfi_d3_scale(along, t));
  return sbfi_d3_dot(displacement, displacement);
}

static double nearest_bone(const limbs *l, bool below, sbfi_d3 p, double squared) {
  for (uint32_t b = 0; b < l->bone_count; b++) {
    int32_t parent = l->bones[b].parent;
    if (parent == SBF_NONE || (l->below[b] && l->below[parent]) != below) continue;
    squared = fmin(squared, squared_distance_to_bone(p, head_of(l, (uint32_t)parent), head_of(l, b)));
  }
  return squared;
}

static void measure_others(limbs *l) {
  for (uint32_t i = 0; i < COVERED_SAMPLES; i++)
    l->distances[i] = sqrt(nearest_bone(l, false, l->samples[i], l->far * l->far));
}

/* How much of the input comes nearer to a bone by the turned limb, by the share of all bones that it is. */
static double covered_fraction(const limbs *l, uint32_t first, const double rotation[4]) {
  const double back[4] = {-rotation[0], -rotation[1], -rotation[2], rotation[3]};
  double sum = 0;
  for (uint32_t i = 0; i < COVERED_SAMPLES; i++) {
    sbfi_d3 p = turned(back, head_of(l, first), l->samples[i]);
    double distance = l->distances[i];
    sum += distance - sqrt(nearest_bone(l, true, p, distance * distance));
  }
  return fmin(sum / (COVERED_SAMPLES * l->far) * l->all / l->length, 1);
}

static double score(const limbs *l, uint32_t first, const double rotation[4]) {
  return inside_fraction(l, first, rotation) + covered_fraction(l, first, rotation);
}

/* The bones that hang on one, their length, and the unit vector to the farthest of their joints. */
static bool take_limb(limbs *l, uint32_t first, sbfi_d3 *direction) {
  double farthest = 0;
  l->length = 0;
  for (uint32_t b = 0; b < l->bone_count; b++) {
    int32_t parent = l->bones[b].parent;
    l->below[b] = b == first || (parent != SBF_NONE && l->below[parent]);
    if (!l->below[b] || b == first) continue;
    sbfi_d3 displacement = sbfi_d3_sub(head_of(l, b), head_of(l, first));
    l->length += sbfi_d3_length(sbfi_d3_sub(head_of(l, b), head_of(l, (uint32_t)parent)));
    if (sbfi_d3_length(displacement) <= farthest) continue;
    farthest = sbfi_d3_length(displacement);
    *direction = sbfi_d3_scale(displacement, 1 / farthest);
  }
  return farthest > 0 && l->bones[first].parent != SBF_NONE && l->length <= LIMB * l->all &&
         l->length >= MIN_LIMB * l->all;
}

/* Whether a limb is a left or a right one, by its name or because all of it lies on one side of the root: a
 * spine or a neck is no limb. */
static bool is_sided(const limbs *l, uint32_t first) {
  double low = INFINITY, high = -INFINITY, root = (double)l->bones[0].head.x;
  if (sbfi_name_side(l->bones[first].name)) return true;
  for (uint32_t b = first; b < l->bone_count; b++) {
    if (!l->below[b]) continue;
    low = fmin(low, (double)l->bones[b].head.x - root);
    high = fmax(high, (double)l->bones[b].head.x - root);
  }
  return low > ASIDE * l->length || high < -ASIDE * l->length;
}

/* Points spread evenly over the unit sphere, along a spiral. */
static sbfi_d3 spread(uint32_t number) {
  double x = 1, z = 0, height = 1 - 2 * (number + 0.5) / DIRECTIONS;
  const double cosine = -0.7373688780783197, sine = 0.6754902942615238; /* of the golden angle */
  for (uint32_t i = 0; i < number; i++) {
    double next = cosine * x - sine * z;
    z = sine * x + cosine * z;
    x = next;
  }
  double radius = sqrt(1 - height * height);
  return (sbfi_d3){radius * x, height, radius * z};
}

static void turn_to(sbfi_d3 from, sbfi_d3 to, double rotation[4]) {
  sbfi_turn_between((const double[3]){from.x, from.y, from.z}, (const double[3]){to.x, to.y, to.z}, rotation);
}

/* Of all directions the nearest that is nearly as good as the best; then the best of those around it. */
static double find_turn(const limbs *l, uint32_t first, sbfi_d3 direction, double rotation[4]) {
  double fractions[DIRECTIONS], max = 0, nearest = -1;
  sbfi_d3 chosen = direction;
  for (uint32_t i = 0; i < DIRECTIONS; i++) {
    sbfi_d3 to = spread(i);
    fractions[i] = 0;
    if (sbfi_d3_dot(to, direction) < FARTHEST) continue;
    turn_to(direction, to, rotation);
    fractions[i] = score(l, first, rotation);
    max = fmax(max, fractions[i]);
  }
  for (uint32_t i = 0; i < DIRECTIONS; i++) {
    double cosine = sbfi_d3_dot(spread(i), direction);
    if (cosine < FARTHEST || fractions[i] < max - NEARLY || cosine <= nearest) continue;
    nearest = cosine;
    chosen = spread(i);
  }
  turn_to(direction, chosen, rotation);
  double best = score(l, first, rotation), step = 0.08;
  for (int i = 0; i < REFINED; i++, step *= 0.85) {
    sbfi_d3 aside = spread((uint32_t)(i * 173) % DIRECTIONS);
    sbfi_d3 to = sbfi_d3_normal(sbfi_d3_add(chosen, sbfi_d3_scale(aside, step)));
    double other[4];
    turn_to(direction, to, other);
    double fraction = score(l, first, other);
    if (fraction <= best) continue;
    best = fraction;
    chosen = to;
    memcpy(rotation, other, sizeof other);
  }
  return best;
}

/* Whether a bone lies on the way to nearly all of a limb, whose length is given, and a turn about its joint
 * does as well: collarbones lie still. */
static bool is_child_better(limbs *l, uint32_t child, double length, double with_parent) {
  sbfi_d3 direction = {0, 0, 0};
  double rotation[4];
  if (!take_limb(l, child, &direction) || l->length < CHAIN_OF_LIMB * length ||
      !is_inside(l, head_of(l, child)))
    return false;
  measure_others(l);
  double alone = find_turn(l, child, direction, rotation);
  return alone * l->length + 2 * (length - l->length) >= (with_parent - SLIGHTLY) * length;
}

static bool has_better_child(limbs *l, uint32_t first, double with_parent) {
  double length = l->length;
  sbfi_d3 direction;
  bool found = false;
  for (uint32_t b = first + 1; b < l->bone_count && !found; b++)
    found = l->bones[b].parent == (int32_t)first && is_child_better(l, b, length, with_parent);
  if (!take_limb(l, first, &direction)) return false;
  return found;
}

/* --- The turn in bones and nodes ----------------------------------------------------------------------- */

static void turn_bones(limbs *l, uint32_t first, const double orientation[4]) {
  sbfi_d3 about = head_of(l, first);
  for (uint32_t b = first; b < l->bone_count; b++) {
    if (!l->below[b]) continue;
    sbf_quat *q = &l->bones[b].rotation;
    double rotation[4] = {(double)q->x, (double)q->y, (double)q->z, (double)q->w};
    sbfi_turn_product(orientation, rotation, rotation);
    *q = (sbf_quat){(float)rotation[0], (float)rotation[1], (float)rotation[2], (float)rotation[3]};
    l->bones[b].head = sbfi_d3_rounded(turned(orientation, about, head_of(l, b)));
  }
}

/* `matrix` is in asset space; `nodes` are ours. */
static void turn_nodes(const limbs *l, uint32_t first, const sbfi_matrix *matrix, sbfi_scene_node *nodes) {
  const sbfi_conversion *c = l->r->c;
  uint32_t top = c->node_of_bone[first], count = l->r->rig.scene->node_count;
  sbfi_matrix to_scene, above, turn;
  if (!sbfi_matrix_invert(&c->rig_to_asset, &to_scene)) return;
  turn = sbfi_matrix_multiply(matrix, &c->rig_to_asset);
  turn = sbfi_matrix_multiply(&to_scene, &turn);
  for (uint32_t n = top; n < count; n++) {
    int32_t parent = nodes[n].parent;
    if (n == top) nodes[n].world = sbfi_matrix_multiply(&turn, &nodes[n].world);
    int32_t up = parent;
    while (up != SBF_NONE && (uint32_t)up > top) up = nodes[up].parent;
    if (n != top && up == (int32_t)top)
      nodes[n].world = sbfi_matrix_multiply(&nodes[parent].world, &nodes[n].local);
  }
  if (nodes[top].parent == SBF_NONE)
    nodes[top].local = nodes[top].world;
  else if (sbfi_matrix_invert(&nodes[nodes[top].parent].world, &above))
    nodes[top].local = sbfi_matrix_multiply(&above, &nodes[top].world);
}

/* A copy of the rig's scene with nodes that may be turned. */
static sbfi_scene_node *own_nodes(sbfi_rigging *r) {
  sbfi_arena *arena = &r->c->scratch;
  sbfi_scene *scene = sbfi_arena_copy(arena, r->rig.scene, 1, sizeof *scene);
  if (!scene) return NULL;
  sbfi_scene_node *nodes = sbfi_arena_copy(arena, scene->nodes, scene->node_count, sizeof *nodes);
  scene->nodes = nodes;
  if (nodes) r->c->rig = r->rig.scene = scene;
  return nodes;
}

static void take_samples(limbs *l) {
  const sbf_vec3_list points = l->r->input.mesh.positions;
  l->far = FAR * l->r->input.size * sbfi_similarity_scale(&l->r->alignment.to_asset);
  for (uint32_t i = 0; i < COVERED_SAMPLES; i++) {
    uint32_t at = (uint32_t)((double)points.count * fmod(0.5 + i * 0.6180339887498949, 1.0));
    l->samples[i] = sbfi_similarity_apply(&l->r->alignment.to_asset, sbfi_d3_of(points.at[at]));
  }
}

bool sbfi_align_limbs(sbfi_rigging *r, const sbfi_winding *winding, char *text, size_t size) {
  limbs l = {.r = r, .winding = winding, .bone_count = r->c->asset->bones.count};
  l.bones = (sbf_bone *)(uintptr_t)r->c->asset->bones.at; /* ours until the asset is handed out */
  l.below = sbfi_arena_allocate(&r->c->scratch, l.bone_count, sizeof *l.below);
  sbfi_scene_node *nodes = own_nodes(r);
  text[0] = 0;
  if (!l.below || !nodes) return false;
  if (!sbfi_matrix_invert(&r->alignment.to_asset, &l.back)) return true;
  take_samples(&l);
  for (uint32_t b = 0; b < l.bone_count; b++)
    if (l.bones[b].parent != SBF_NONE)
      l.all += sbfi_d3_length(sbfi_d3_sub(head_of(&l, b), head_of(&l, (uint32_t)l.bones[b].parent)));
  for (uint32_t b = 0; b < l.bone_count; b++) {
    static const double none[4] = {0, 0, 0, 1};
    sbfi_d3 direction = {0, 0, 0};
    double rotation[4];
    if (!take_limb(&l, b, &direction) || !is_sided(&l, b)) continue;
    double before = inside_fraction(&l, b, none);
    if (before >= GOOD || !is_inside(&l, head_of(&l, b))) continue;
    measure_others(&l);
    double with_turn = find_turn(&l, b, direction, rotation);
    if (with_turn < score(&l, b, none) + GAIN || has_better_child(&l, b, with_turn)) continue;
    sbfi_matrix matrix = sbfi_rotation_about(rotation, head_of(&l, b));
    turn_nodes(&l, b, &matrix, nodes);
    turn_bones(&l, b, rotation);
    size_t used = strlen(text);
    if (used + 60 < size) snprintf(text + used, size - used, "%s'%.40s'", used ? ", " : "", l.bones[b].name);
  }
  return true;
}
