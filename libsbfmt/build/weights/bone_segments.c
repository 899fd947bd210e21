#include "build/weights/bone_segments.h"

#include "build/weights/bone_roles.h"

/* Minimum cosine between a bone's axis and its child; maximum distance of a joint from the axis of a bone
 * without children; length of such a bone as a fraction of the distance to the skin; minimum distance to
 * another bone. */
static const double ALIGNED = 0.9, STRAIGHT = 0.995, ON_AXIS = 0.02, EXIT_DISTANCE = 0.9, CLEARANCE = 0.07,
                    PASSING = 0.6;
static const double TINY = 1e-6;

static sbfi_d3 axis_of(sbf_quat q) {
  const double x = q.x, y = q.y, z = q.z, w = q.w;
  return sbfi_d3_normal((sbfi_d3){2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)});
}

sbfi_d3 sbfi_segment_nearest(const sbfi_bone_segment *s, sbfi_d3 point) {
  sbfi_d3 along = sbfi_d3_sub(s->tail, s->head);
  double squared = sbfi_d3_dot(along, along);
  double t = squared > 0 ? sbfi_d3_dot(sbfi_d3_sub(point, s->head), along) / squared : 0;
  return sbfi_d3_add(s->head, sbfi_d3_scale(along, t < 0 ? 0 : t > 1 ? 1 : t));
}

double sbfi_segment_distance2(const sbfi_bone_segment *s, sbfi_d3 point) {
  sbfi_d3 separation = sbfi_d3_sub(point, sbfi_segment_nearest(s, point));
  return sbfi_d3_dot(separation, separation);
}

/* Finds the child that continues each bone: the nearest on its axis, else the best aligned one. The first
 * bone of a left or right limb, or of an ear, does not continue a middle bone. */
static void find_next(const sbfi_weights_input *in, sbfi_bone_segment *segments, double *fit) {
  for (uint32_t i = 0; i < in->bone_count; i++) {
    int32_t parent = in->bones[i].parent;
    if (parent == SBF_NONE || !segments[i].is_deforming) continue;
    sbfi_d3 displacement = sbfi_d3_sub(segments[i].head, segments[parent].head);
    double length = sbfi_d3_length(displacement);
    if (length < TINY) continue;
    double cosine = sbfi_d3_dot(displacement, axis_of(in->bones[parent].rotation)) / length;
    if (cosine <= STRAIGHT && segments[i].side != segments[parent].side) continue;
    double score = cosine > ALIGNED ? 2 + 1 / (1 + length) : cosine;
    if (segments[parent].next != SBF_NONE && score <= fit[parent]) continue;
    segments[parent].next = (int32_t)i;
    fit[parent] = score;
  }
}

static bool is_below(const sbfi_weights_input *in, uint32_t bone, uint32_t above) {
  for (int32_t b = (int32_t)bone; b != SBF_NONE; b = in->bones[b].parent)
    if ((uint32_t)b == above) return true;
  return false;
}

/* Distance that a bone without a continuation may extend along its axis before another bone. */
static double free_length(const sbfi_weights_input *in, const sbfi_bone_segment *segments, uint32_t bone,
    sbfi_d3 axis, double length) {
  const int steps = 32;
  for (int step = 1; step <= steps; step++) {
    double along = length * step / steps;
    sbfi_d3 at = sbfi_d3_add(segments[bone].head, sbfi_d3_scale(axis, along));
    for (uint32_t other = 0; other < in->bone_count; other++) {
      if (other == bone || !segments[other].is_deforming || is_below(in, bone, other)) continue;
      if (segments[other].side && segments[other].side == segments[bone].side) continue;
      double now = sqrt(sbfi_segment_distance2(&segments[other], at));
      double before = sqrt(sbfi_segment_distance2(&segments[other], segments[bone].head));
      if (now < CLEARANCE && now < PASSING * before) return along;
    }
  }
  return length;
}

bool sbfi_bone_is_adjacent(const sbfi_weights_input *in, const sbfi_bone_segment *segments, uint32_t bone) {
  int32_t parent = in->bones[bone].parent;
  return parent != SBF_NONE && segments[bone].side && segments[bone].side == segments[parent].side &&
         segments[parent].is_deforming && segments[parent].next == SBF_NONE &&
         sbfi_d3_length(sbfi_d3_sub(segments[bone].head, segments[parent].head)) < TINY;
}

/* Whether a bone or one of its ancestors is beside `above`. */
static bool hangs_beside(
    const sbfi_weights_input *in, const sbfi_bone_segment *segments, uint32_t bone, uint32_t above) {
  for (int32_t b = (int32_t)bone; b != SBF_NONE; b = in->bones[b].parent)
    if (in->bones[b].parent == (int32_t)above) return sbfi_bone_is_adjacent(in, segments, (uint32_t)b);
  return false;
}

/* Length of an axis inside a body that is open ahead. */
static double length_inside(const sbfi_body_rays *rays, sbfi_d3 from, sbfi_d3 axis) {
  const double step = 1.0 / 64;
  double length = 0;
  while (length < 1 && sbfi_body_contains(rays, sbfi_d3_add(from, sbfi_d3_scale(axis, length + step))))
    length += step;
  return length;
}

/* Length along the axis to a joint on it, else nine tenths of the distance to the skin. */
static double leaf_length(const sbfi_weights_input *in, const sbfi_weight_mesh *mesh,
    const sbfi_bone_segment *segments, const sbfi_body_rays *rays, uint32_t bone, sbfi_d3 axis) {
  double stated = in->bones[bone].length * mesh->scale, joint = INFINITY;
  if (stated > TINY) return stated;
  for (uint32_t i = 0; i < in->bone_count; i++) {
    sbfi_d3 displacement = sbfi_d3_sub(segments[i].head, segments[bone].head);
    double along = sbfi_d3_dot(displacement, axis);
    sbfi_d3 aside = sbfi_d3_sub(displacement, sbfi_d3_scale(axis, along));
    if (along > ON_AXIS && along < joint && sbfi_body_contains(rays, segments[i].head) &&
        sbfi_d3_length(aside) < ON_AXIS && !hangs_beside(in, segments, i, bone))
      joint = along;
  }
  double out = sbfi_body_shell_end(rays, mesh, segments[bone].head, axis);
  if (!isfinite(out)) out = length_inside(rays, segments[bone].head, axis);
  return joint < out + ON_AXIS ? joint : EXIT_DISTANCE * out;
}

/* Child that marks the end of a bone, or SBF_NONE. */
static int32_t marked_end(const sbfi_weights_input *in, const sbfi_d3 *heads, uint32_t bone) {
  for (uint32_t i = bone + 1; i < in->bone_count; i++)
    if (in->bones[i].parent == (int32_t)bone && sbfi_bone_is_end(in, i) &&
        sbfi_d3_length(sbfi_d3_sub(heads[i], heads[bone])) > TINY)
      return (int32_t)i;
  return SBF_NONE;
}

/* Exporters invent ends if they know none: a bone ends in the body, or before a mark outside it. */
static sbfi_d3 tail_to_mark(
    const sbfi_weight_mesh *mesh, const sbfi_body_rays *rays, sbfi_d3 head, sbfi_d3 mark) {
  sbfi_d3 displacement = sbfi_d3_sub(mark, head);
  double length = sbfi_d3_length(displacement);
  if (sbfi_body_contains(rays, mark) || !sbfi_body_contains(rays, head)) return mark;
  double out = sbfi_body_shell_end(rays, mesh, head, sbfi_d3_scale(displacement, 1 / length));
  return out < length ? sbfi_d3_add(head, sbfi_d3_scale(displacement, EXIT_DISTANCE * out / length)) : mark;
}

static void find_sides(const sbfi_weights_input *in, sbfi_bone_segment *segments) {
  for (uint32_t i = 0; i < in->bone_count; i++) {
    int32_t parent = in->bones[i].parent;
    segments[i].side = in->sides ? in->sides[i] : 0;
    if (parent != SBF_NONE && segments[parent].side) segments[i].side = segments[parent].side;
  }
}

bool sbfi_bone_segments_find(const sbfi_weights_input *in, const sbfi_weight_mesh *mesh,
    const sbfi_body_rays *rays, sbfi_bone_segment *segments, sbfi_arena *arena) {
  sbfi_d3 *heads = sbfi_arena_allocate(arena, in->bone_count, sizeof *heads);
  double *fit = sbfi_arena_allocate(arena, in->bone_count, sizeof *fit);
  bool *is_deforming = sbfi_arena_allocate(arena, in->bone_count, sizeof *is_deforming);
  if (!heads || !fit || !is_deforming) return false;
  sbfi_bone_roles_find(in, mesh, rays, is_deforming);
  for (uint32_t i = 0; i < in->bone_count; i++) {
    heads[i] = sbfi_weight_mesh_position(mesh, in->bones[i].head);
    segments[i] = (sbfi_bone_segment){
        .head = heads[i], .tail = heads[i], .next = SBF_NONE, .is_deforming = is_deforming[i]};
  }
  find_sides(in, segments);
  find_next(in, segments, fit);
  for (uint32_t i = 0; i < in->bone_count; i++)
    if (segments[i].next != SBF_NONE) segments[i].tail = heads[segments[i].next];
  for (uint32_t i = 0; i < in->bone_count; i++) {
    if (segments[i].next != SBF_NONE || !segments[i].is_deforming) continue;
    int32_t end = marked_end(in, heads, i);
    if (end != SBF_NONE) {
      segments[i].tail = tail_to_mark(mesh, rays, heads[i], heads[end]);
      continue;
    }
    sbfi_d3 axis = axis_of(in->bones[i].rotation);
    double length = leaf_length(in, mesh, segments, rays, i, axis);
    length = free_length(in, segments, i, axis, length);
    segments[i].tail = sbfi_d3_add(heads[i], sbfi_d3_scale(axis, length));
  }
  return true;
}
