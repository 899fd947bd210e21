/* Fits limbs one by one, from the trunk to the tips. Among many directions it chooses the one in which a
 * limb best fits parts of the body without other bones. Then it refines all joints of rotated limbs in
 * decreasing steps. */
#include "import/rigging/limb_fit.h"

#include <string.h>

#include "import/rigging/similarity.h"
#include "motion/quatd.h"
#include "motion/retargeting.h"

enum { DIRECTIONS = 300, MAX_SAMPLES = 8, ROUNDS = 24, DESCENTS = 3 };

/* As fractions of the size: distance from a bone at which the centre of a part counts as having none;
 * distance at which a bone counts as outside the body; spacing of samples along bones; minimum length of
 * bones. */
static const double UNCOVERED = 0.1, OUTSIDE = 0.05, SPACING = 0.03, SHORTEST = 0.012;
/* As fractions of the radius: usual distance of bones from the centre of their body; distance within which
 * a part is occupied. */
static const double OFF_CENTRE = 0.6, WITHIN = 0.9;
/* Maximum fraction of all bones in a limb; minimum reach of a limb. */
static const double MAX_LIMB = 0.45, MIN_REACH = 0.06;
/* Minimum cosine of the rotation of a limb. */
static const double FARTHEST = 0.1;
/* All relative to the limb's fraction of the bones: cost of a rotation by its squared angle and, for later
 * joints, by its angle; minimum gain by a rotation; the same if the limb on the other side rotated; the
 * same in the middle of a symmetric body. */
static const double PER_RADIAN2 = 0.15, PER_RADIAN_OF_LATER = 0.05, GAIN = 0.2, GAIN_OF_TWIN = 0.1,
                    GAIN_IN_MIDDLE = 0.7;
static const double MIN_ANGLE = 0.07; /* rad, minimum rotation of a later joint */
/* Relative tolerance for the lengths of limbs on both sides. */
static const double TWIN = 0.15;
/* A child bone with this fraction of the limb rotates instead if its cost relative to the parent's is
 * below TIE. */
static const double CHAIN = 0.6, TIE = 0.995;
/* Minimum cosine for a bone along its own y; length of a tail relative to the bone before, and its
 * maximum. */
static const double ALONG = 0.9, TAIL = 0.5, LONGEST_TAIL = 2;

static sbfi_d3 head_of(const sbfi_limb_fit *f, uint32_t bone) {
  return sbfi_similarity_apply(&f->motions[bone], sbfi_d3_of(f->bones[bone].head));
}

static double squared_distance(const sbfi_bone_line *line, sbfi_d3 p) {
  sbfi_d3 along = sbfi_d3_sub(line->to, line->from), from = sbfi_d3_sub(p, line->from);
  double t = sbfi_d3_dot(from, along) / (line->length * line->length);
  from = sbfi_d3_sub(from, sbfi_d3_scale(along, t > 0 ? t < 1 ? t : 1 : 0));
  return sbfi_d3_dot(from, from);
}

/* --- Cost ---------------------------------------------------------------------------------------------- */

/* Cost of a part of the body by the distance from its centre to the nearest bone; small within the body. */
static double cost_of_distance(const sbfi_limb_fit *f, const sbfi_core_point *p, double distance) {
  double beyond = distance * distance / (distance + OFF_CENTRE * p->radius + 1e-9 * f->size);
  return p->weight * fmin(beyond / (UNCOVERED * f->size), 1);
}

/* Fraction of all bones for a length. A middle bone counts half, because only one of two sides is fitted. */
static double fraction_of(const sbfi_limb_fit *f, uint32_t bone, double length) {
  return (f->is_middle && f->is_middle[bone] ? 0.5 : 1) * length / f->posed.total;
}

/* Cost of a bone outside the body. */
static double cost_of_line(const sbfi_limb_fit *f, const sbfi_bone_line *line) {
  double wanted = line->length / (SPACING * f->size), sum = 0;
  if (line->length < SHORTEST * f->size || line->is_tail) return 0;
  int samples = wanted > MAX_SAMPLES ? MAX_SAMPLES : (int)ceil(wanted);
  for (int k = 0; k < samples; k++) {
    double t = (k + 0.5) / samples, out = INFINITY;
    sbfi_d3 at = sbfi_d3_add(sbfi_d3_scale(line->from, 1 - t), sbfi_d3_scale(line->to, t));
    for (uint32_t i = 0; i < f->core.count && out > 0; i++) {
      const sbfi_core_point *p = &f->core.points[i];
      sbfi_d3 d = sbfi_d3_sub(at, p->position);
      double squared = sbfi_d3_dot(d, d), reach = WITHIN * p->radius + out;
      if (squared < reach * reach) out = sqrt(squared) - WITHIN * p->radius;
    }
    sum += fmin(fmax(out, 0) / (OUTSIDE * f->size), 1);
  }
  return sum / samples * fraction_of(f, line->child, line->length);
}

static double whole_cost(const sbfi_limb_fit *f) {
  double sum = 0;
  for (uint32_t i = 0; i < f->core.count; i++) {
    double nearest = INFINITY;
    for (uint32_t k = 0; k < f->posed.count; k++)
      nearest = fmin(nearest, squared_distance(&f->posed.at[k], f->core.points[i].position));
    sum += cost_of_distance(f, &f->core.points[i], sqrt(nearest));
  }
  for (uint32_t k = 0; k < f->posed.count; k++) sum += cost_of_line(f, &f->posed.at[k]);
  return sum;
}

/* Cost of the whole body with the current limb rotated about its joint, plus `angle_cost`. May return less
 * once it is certain to reach `best`. */
static double rotation_cost(
    const sbfi_limb_fit *f, sbfi_d3 joint, const double rotation[4], double angle_cost, double best) {
  sbfi_matrix turn = sbfi_rotation_about(rotation, joint);
  sbfi_bone_line *lines = f->rotated_lines;
  uint32_t count = f->line_count;
  double sum = 0;
  for (uint32_t k = 0; k < count && sum + angle_cost < best; k++) {
    lines[k] = f->posed.at[f->line_indices[k]];
    lines[k].from = sbfi_similarity_apply(&turn, lines[k].from);
    lines[k].to = sbfi_similarity_apply(&turn, lines[k].to);
    sum += cost_of_line(f, &lines[k]);
  }
  for (uint32_t i = 0; i < f->core.count && sum + angle_cost < best; i++) {
    double nearest = f->others[i];
    for (uint32_t k = 0; k < count; k++) {
      double squared = squared_distance(&lines[k], f->core.points[i].position);
      if (squared < nearest) nearest = squared;
    }
    sum += cost_of_distance(f, &f->core.points[i], sqrt(nearest));
  }
  return sum + angle_cost;
}

/* --- Limbs --------------------------------------------------------------------------------------------- */

/* Selects the limb of a bone: its length and direction. False if it is too large or too small to rotate. */
static bool measure_limb(sbfi_limb_fit *f, uint32_t first, double *length, sbfi_d3 *direction) {
  double farthest = 0;
  sbfi_d3 joint = head_of(f, first);
  *length = 0;
  f->line_count = 0;
  for (uint32_t b = 0; b < f->bone_count; b++) {
    int32_t parent = f->bones[b].parent;
    f->below[b] = b == first || (parent != SBF_NONE && f->below[parent]);
  }
  for (uint32_t k = 0; k < f->posed.count; k++) {
    const sbfi_bone_line *line = &f->posed.at[k];
    if (!f->below[line->bone]) continue;
    f->line_indices[f->line_count++] = k;
    if (line->is_tail) continue;
    *length += line->length;
    sbfi_d3 out = sbfi_d3_sub(line->to, joint);
    if (sbfi_d3_length(out) <= farthest) continue;
    farthest = sbfi_d3_length(out);
    *direction = sbfi_d3_scale(out, 1 / farthest);
  }
  return f->bones[first].parent != SBF_NONE && farthest >= MIN_REACH * f->size &&
         *length <= MAX_LIMB * f->posed.total;
}

static void measure_others(sbfi_limb_fit *f) {
  for (uint32_t i = 0; i < f->core.count; i++) {
    f->others[i] = INFINITY;
    for (uint32_t k = 0; k < f->posed.count; k++)
      if (!f->below[f->posed.at[k].bone])
        f->others[i] = fmin(f->others[i], squared_distance(&f->posed.at[k], f->core.points[i].position));
  }
}

static void turn(sbfi_limb_fit *f, uint32_t bone, const double rotation[4]) {
  sbfi_matrix by = sbfi_rotation_about(rotation, head_of(f, bone));
  for (uint32_t b = bone; b < f->bone_count; b++)
    if (f->below[b]) f->motions[b] = sbfi_matrix_multiply(&by, &f->motions[b]);
  for (uint32_t k = 0; k < f->line_count; k++) {
    sbfi_bone_line *line = &f->posed.at[f->line_indices[k]];
    line->from = sbfi_similarity_apply(&by, line->from);
    line->to = sbfi_similarity_apply(&by, line->to);
  }
}

static void rotation_between(sbfi_d3 from, sbfi_d3 to, double rotation[4]) {
  sbfi_quatd_between(
      (const double[3]){from.x, from.y, from.z}, (const double[3]){to.x, to.y, to.z}, rotation);
}

/* Cost of a rotation itself. */
static double cost_of_angle(double fraction, const double rotation[4]) {
  double sine = sqrt(fmax(1 - rotation[3] * rotation[3], 0)); /* of half the angle */
  return fraction * PER_RADIAN2 * 4 * sine * sine;
}

/* Tries all directions, then those around the best. */
static double find_rotation(const sbfi_limb_fit *f, sbfi_d3 joint, sbfi_d3 direction, double fraction,
    bool in_plane, const sbfi_d3 *directions, double best_rotation[4]) {
  double best = INFINITY, step = 0.1;
  sbfi_d3 chosen = direction;
  for (uint32_t i = 0; i < DIRECTIONS + ROUNDS; i++) {
    sbfi_d3 to = directions[i < DIRECTIONS ? i : i * 173 % DIRECTIONS];
    double rotation[4];
    if (i >= DIRECTIONS) {
      to = sbfi_d3_normal(sbfi_d3_add(chosen, sbfi_d3_scale(to, step)));
      step *= 0.9;
    }
    if (in_plane) to = sbfi_d3_normal((sbfi_d3){direction.x, to.y, to.z});
    if (sbfi_d3_dot(to, direction) < FARTHEST) continue;
    rotation_between(direction, to, rotation);
    double cost = rotation_cost(f, joint, rotation, cost_of_angle(fraction, rotation), best);
    if (cost >= best) continue;
    best = cost;
    chosen = to;
    memcpy(best_rotation, rotation, sizeof rotation);
  }
  return best;
}

static double find_rotation_of(sbfi_limb_fit *f, uint32_t bone, const sbfi_d3 *directions, double *before,
    double rotation[4], double *length) {
  static const double none[4] = {0, 0, 0, 1};
  sbfi_d3 direction;
  if (!measure_limb(f, bone, length, &direction)) return INFINITY;
  measure_others(f);
  *before = rotation_cost(f, head_of(f, bone), none, 0, INFINITY);
  bool in_plane = f->is_middle && f->is_middle[bone];
  if (in_plane) direction = sbfi_d3_normal((sbfi_d3){0, direction.y, direction.z});
  return find_rotation(
      f, head_of(f, bone), direction, fraction_of(f, bone, *length), in_plane, directions, rotation);
}

/* Whether a child that carries nearly the whole limb should rotate instead: collarbones rarely move. */
static bool is_child_better(
    sbfi_limb_fit *f, uint32_t bone, const sbfi_d3 *directions, double length, double saved) {
  double rotation[4], child_length, before;
  for (uint32_t b = bone + 1; b < f->bone_count; b++) {
    if (f->bones[b].parent != (int32_t)bone) continue;
    double cost = find_rotation_of(f, b, directions, &before, rotation, &child_length);
    if (isfinite(cost) && child_length >= CHAIN * length &&
        (before - cost >= TIE * saved || is_child_better(f, b, directions, child_length, saved)))
      return true;
  }
  return false;
}

/* Whether a limb of equal length on the other side has been rotated. */
static bool has_rotated_twin(const sbfi_limb_fit *f, uint32_t bone, double length) {
  int side = sbfi_name_side(f->bones[bone].name);
  for (uint32_t b = 0; side && b < f->bone_count; b++)
    if (f->is_rotated[b] && sbfi_name_side(f->bones[b].name) == -side &&
        fabs(f->rotated_lengths[b] / length - 1) < TWIN)
      return true;
  return false;
}

static bool is_below_rotated(const sbfi_limb_fit *f, uint32_t bone) {
  for (int32_t b = (int32_t)bone; b != SBF_NONE; b = f->bones[b].parent)
    if (f->is_rotated[b]) return true;
  return false;
}

/* Whether the bone is in the trunk of a symmetric body; the limbs determine its position. */
static bool carries_limbs(const sbfi_limb_fit *f, uint32_t bone) {
  for (uint32_t k = 0; f->is_middle && f->is_middle[bone] && k < f->rest.count; k++) {
    int32_t b = (int32_t)f->rest.at[k].child;
    if (f->is_middle[b]) continue;
    while (b != SBF_NONE && b != (int32_t)bone) b = f->bones[b].parent;
    if (b != SBF_NONE) return true;
  }
  return false;
}

/* Rotates a limb if the gain is sufficient. */
static void search_bone(sbfi_limb_fit *f, uint32_t bone, const sbfi_d3 *directions, bool as_twin) {
  double rotation[4], length, before;
  sbfi_d3 direction;
  if (carries_limbs(f, bone)) return;
  double cost = find_rotation_of(f, bone, directions, &before, rotation, &length);
  if (!isfinite(cost) || (as_twin && !has_rotated_twin(f, bone, length))) return;
  double saved = before - cost, fraction = fraction_of(f, bone, length);
  double min_saving = as_twin ? GAIN_OF_TWIN : GAIN;
  if (f->is_middle && f->is_middle[bone]) min_saving = GAIN_IN_MIDDLE;
  if (saved < min_saving * fraction || is_child_better(f, bone, directions, length, saved) ||
      !measure_limb(f, bone, &length, &direction))
    return;
  turn(f, bone, rotation);
  f->is_rotated[bone] = true;
  f->rotated_lengths[bone] = length;
}

static void search(sbfi_limb_fit *f) {
  sbfi_d3 directions[DIRECTIONS];
  sbfi_spread_directions(directions, DIRECTIONS);
  for (uint32_t b = 0; b < f->bone_count; b++) search_bone(f, b, directions, false);
  for (uint32_t b = 0; b < f->bone_count; b++)
    if (!is_below_rotated(f, b)) search_bone(f, b, directions, true);
}

/* --- All joints of rotated limbs ----------------------------------------------------------------------- */

/* Rotation relative to the parent: twice the sine of half the angle, which is identical on all machines. */
static double angle_of(const sbfi_limb_fit *f, uint32_t bone, const sbfi_matrix *motion) {
  sbfi_matrix above = sbfi_matrix_identity(), by;
  if (f->bones[bone].parent != SBF_NONE && !sbfi_matrix_invert(&f->motions[f->bones[bone].parent], &above))
    return 0;
  by = sbfi_matrix_multiply(motion, &above);
  double cosine = 0.5 * (by.at[0][0] + by.at[1][1] + by.at[2][2] - 1);
  return sqrt(fmin(fmax(2 - 2 * cosine, 0), 4));
}

/* Later joints of a limb stay straight if rotating them gains little. As rotation_cost(), may return less
 * once it is certain to reach `best`. */
static double cost_of_pose(
    const sbfi_limb_fit *f, uint32_t bone, double length, const double rotation[4], double best) {
  sbfi_matrix motion = sbfi_rotation_about(rotation, head_of(f, bone));
  motion = sbfi_matrix_multiply(&motion, &f->motions[bone]);
  double angle = angle_of(f, bone, &motion);
  double per_radian = PER_RADIAN2 * angle + (f->is_rotated[bone] ? 0 : PER_RADIAN_OF_LATER);
  double angle_cost = fraction_of(f, bone, length) * per_radian * angle;
  return rotation_cost(f, head_of(f, bone), rotation, angle_cost, best);
}

static void descend_joint(sbfi_limb_fit *f, uint32_t bone, double step) {
  static const double none[4] = {0, 0, 0, 1};
  double length;
  sbfi_d3 direction;
  if (!measure_limb(f, bone, &length, &direction)) return;
  measure_others(f);
  double best = cost_of_pose(f, bone, length, none, INFINITY);
  for (int k = 0; k < (f->is_middle && f->is_middle[bone] ? 2 : 6); k++) {
    double rotation[4] = {0, 0, 0, sqrt(1 - 0.25 * step * step)};
    rotation[k / 2] = (k % 2 ? -1 : 1) * 0.5 * step;
    double cost = cost_of_pose(f, bone, length, rotation, best);
    if (cost >= best) continue;
    best = cost;
    turn(f, bone, rotation);
  }
}

static void move_body(sbfi_limb_fit *f, sbfi_d3 by) {
  f->offset = sbfi_d3_sub(f->offset, by);
  for (uint32_t i = 0; i < f->core.count; i++)
    f->core.points[i].position = sbfi_d3_add(f->core.points[i].position, by);
}

/* Refines the offset of the whole rig. */
static void descend_offset(sbfi_limb_fit *f, double step) {
  double best = whole_cost(f);
  for (int k = f->is_middle ? 2 : 0; k < 6; k++) {
    double by = (k % 2 ? -1 : 1) * step * f->size;
    sbfi_d3 offset = {k / 2 == 0 ? by : 0, k / 2 == 1 ? by : 0, k / 2 == 2 ? by : 0};
    move_body(f, offset);
    double cost = whole_cost(f);
    if (cost < best)
      best = cost;
    else
      move_body(f, sbfi_d3_scale(offset, -1));
  }
}

static void descend(sbfi_limb_fit *f) {
  for (double step = 0.2; step > 0.008; step *= 0.6)
    for (int i = 0; i < DESCENTS; i++) {
      if (!f->is_fixed) descend_offset(f, 0.1 * step);
      for (uint32_t b = 0; b < f->bone_count; b++)
        if (is_below_rotated(f, b)) descend_joint(f, b, step);
    }
}

/* Removes the rotation of a joint exactly. */
static void straighten(sbfi_limb_fit *f, uint32_t bone) {
  const sbfi_matrix above = f->motions[f->bones[bone].parent], old = f->motions[bone];
  sbfi_matrix back;
  double length;
  sbfi_d3 direction;
  if (!sbfi_matrix_invert(&old, &back)) return;
  back = sbfi_matrix_multiply(&above, &back);
  measure_limb(f, bone, &length, &direction);
  for (uint32_t b = bone; b < f->bone_count; b++) {
    if (!f->below[b]) continue;
    bool is_same = memcmp(&f->motions[b], &old, sizeof old) == 0;
    f->motions[b] = is_same ? above : sbfi_matrix_multiply(&back, &f->motions[b]);
  }
  for (uint32_t k = 0; k < f->line_count; k++) {
    sbfi_bone_line *line = &f->posed.at[f->line_indices[k]];
    line->from = sbfi_similarity_apply(&back, line->from);
    line->to = sbfi_similarity_apply(&back, line->to);
  }
}

/* Removes small rotations of later joints, which are noise. */
static void straighten_later(sbfi_limb_fit *f) {
  for (uint32_t b = 0; b < f->bone_count; b++)
    if (is_below_rotated(f, b) && !f->is_rotated[b] && angle_of(f, b, &f->motions[b]) < MIN_ANGLE)
      straighten(f, b);
}

void sbfi_limb_fit_update_lines(sbfi_limb_fit *f, sbfi_d3 offset) {
  for (uint32_t k = 0; k < f->posed.count; k++) {
    sbfi_bone_line *line = &f->posed.at[k];
    line->from = sbfi_similarity_apply(&f->motions[line->bone], line->from);
    line->to = sbfi_similarity_apply(&f->motions[line->is_tail ? line->bone : line->child], line->to);
    line->length = sbfi_d3_length(sbfi_d3_sub(line->to, line->from));
  }
  move_body(f, sbfi_d3_scale(offset, -1));
  f->cost = whole_cost(f);
}

void sbfi_limb_fit_search(sbfi_limb_fit *f) {
  search(f);
  descend(f);
  if (!f->is_middle) straighten_later(f);
  f->cost = whole_cost(f);
}

/* --- Ends of limbs -------------------------------------------------------------------------------------- */

static sbfi_d3 axis_of(sbf_quat q) {
  const double x = (double)q.x, y = (double)q.y, z = (double)q.z, w = (double)q.w;
  return sbfi_d3_normal((sbfi_d3){2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)});
}

/* Whether most bones point along their own y axis, as in some programs. */
static bool points_along_y(const sbfi_limb_fit *f) {
  uint32_t along = 0;
  for (uint32_t k = 0; k < f->rest.count; k++) {
    const sbfi_bone_line *line = &f->rest.at[k];
    sbfi_d3 direction = sbfi_d3_scale(sbfi_d3_sub(line->to, line->from), 1 / line->length);
    along += sbfi_d3_dot(axis_of(f->bones[line->bone].rotation), direction) > ALONG;
  }
  return 2 * along > f->rest.count;
}

/* Extends hands, feet and heads beyond the last joint. */
static void add_tails(sbfi_limb_fit *f) {
  bool own = points_along_y(f);
  for (uint32_t k = 0; k < f->rest.count; k++) {
    const sbfi_bone_line *line = &f->rest.at[k];
    bool is_last = true;
    for (uint32_t i = 0; i < f->rest.count && is_last; i++) is_last = f->rest.at[i].bone != line->child;
    if (!is_last || line->is_end) continue;
    const sbf_bone *bone = &f->bones[line->child];
    double length = (double)bone->length > 0 ? (double)bone->length : TAIL * line->length;
    length = fmin(length, LONGEST_TAIL * line->length);
    sbfi_d3 axis =
        own ? axis_of(bone->rotation) : sbfi_d3_scale(sbfi_d3_sub(line->to, line->from), 1 / line->length);
    f->posed.at[f->posed.count++] = (sbfi_bone_line){.from = line->to,
        .to = sbfi_d3_add(line->to, sbfi_d3_scale(axis, length)),
        .bone = line->child,
        .length = length,
        .is_tail = true};
  }
}

bool sbfi_limb_fit_begin(sbfi_limb_fit *f, const sbfi_rigging *r, const sbfi_bone_lines *lines,
    const sbfi_body_core *core, sbfi_arena *arena) {
  const sbf_bone_list bones = r->c->asset->bones;
  *f = (sbfi_limb_fit){.bones = bones.at, .bone_count = bones.count, .rest = *lines, .posed = *lines};
  f->motions = sbfi_arena_allocate(arena, (size_t)bones.count + 1, sizeof *f->motions);
  f->is_rotated = sbfi_arena_allocate(arena, (size_t)bones.count + 1, sizeof *f->is_rotated);
  f->rotated_lengths = sbfi_arena_allocate(arena, (size_t)bones.count + 1, sizeof *f->rotated_lengths);
  f->below = sbfi_arena_allocate(arena, (size_t)bones.count + 1, sizeof *f->below);
  f->line_indices =
      sbfi_arena_allocate(arena, (size_t)lines->count + bones.count + 1, sizeof *f->line_indices);
  f->rotated_lines = sbfi_arena_allocate(arena, (size_t)lines->count + bones.count + 1, sizeof *lines->at);
  f->posed.at = sbfi_arena_allocate(arena, (size_t)lines->count + bones.count + 1, sizeof *lines->at);
  if (!f->motions || !f->is_rotated || !f->rotated_lengths || !f->below || !f->line_indices ||
      !f->rotated_lines || !f->posed.at)
    return false;
  for (uint32_t b = 0; b < bones.count; b++) f->motions[b] = sbfi_matrix_identity();
  memcpy(f->posed.at, lines->at, lines->count * sizeof *lines->at);
  add_tails(f);
  sbfi_body_core_move(core, &r->alignment.to_asset, &f->core);
  sbfi_d3 low = sbfi_d3_of(r->input.low), high = sbfi_d3_of(r->input.high);
  f->size = fmax(high.x - low.x, fmax(high.y - low.y, high.z - low.z)) *
            sbfi_similarity_scale(&r->alignment.to_asset);
  const sbfi_matrix *m = &r->alignment.to_asset;
  f->is_fixed = m->at[0][3] == 0 && m->at[1][3] == 0 && m->at[2][3] == 0;
  f->cost = whole_cost(f);
  return true;
}
