/* Snakes: the nose follows the serpenoid curve (Hirose 1993), and every joint of the body follows the path of
 * the nose over the ground. The path's heights bridge edges, so that no joint jumps at one: the ground is
 * dilated by a cone, which bounds the slope, and averaged, which bounds the curvature. */
#include <string.h>

#include "animation/gait/motion_kinds.h"
#include "math/trig.h"

static const float TURN = 6.2831853f;
static const float STEEPEST = 0.8f; /* maximum slope of the path */
enum { ORDERS = 8, TERMS = 9 };
/* In points of the path: checked ahead of the nose, bridged to both sides of an edge, averaged to both sides.
 */
enum { AHEAD = 16, BRIDGED = 3, AVERAGED = 5, SUPPORTS = 4, TRACK = AHEAD + SBRI_PATH_POINTS };

/* Bessel functions J_0 to J_{ORDERS-1} of x in [0, 1.5]: power series, exact to single precision. */
static void bessel(float x, double values[ORDERS]) {
  double half = 0.5 * (double)x, power = 1, factorial = 1;
  for (int n = 0; n < ORDERS; n++) {
    double term = power / factorial, sum = 0;
    for (int k = 0; k < TERMS; k++) {
      sum += term;
      term *= -half * half / ((k + 1) * (double)(n + k + 1));
    }
    values[n] = sum;
    power *= half;
    factorial *= n + 1;
  }
}

/* Integral of the heading a sin(u), u = 2 pi phase, by the Jacobi-Anger expansion, term by term. */
sbf_vec3 sbri_serpenoid(float amplitude, float phase, float *mean) {
  double j[ORDERS], aside = 0, ahead = 0;
  bessel(amplitude, j);
  for (int n = 1; n < ORDERS; n++) {
    float s, c;
    sbri_sincos(TURN * phase * (float)n, &s, &c);
    if (n % 2)
      aside -= 2 * j[n] * (double)c / n;
    else
      ahead += 2 * j[n] * (double)s / n;
  }
  *mean = (float)j[0];
  return sbri_vec3((float)(aside / (double)TURN), 0, (float)(ahead / (double)TURN));
}

/* Position of the nose on its curve, `ahead` of the body on the mean line. */
static sbf_vec3 nose_position(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    float phase, float along) {
  const sbf_undulation *wave = rig->gait->undulation;
  float mean, wavelength = wave->wavelength * rig->wave.length * input->scale;
  sbf_vec3 offset = sbri_scale(sbri_serpenoid(wave->heading_amplitude, phase, &mean), wavelength);
  sbf_vec3 nose = sbri_scale(rig->wave.joints[0], input->scale);
  sbf_vec3 at = sbri_vec3(nose.x + offset.x, 0, nose.z + offset.z + along);
  sbf_vec3 headed = sbri_body_to_world(state, at);
  return sbri_vec3(state->motion.position.x + headed.x, 0, state->motion.position.z + headed.z);
}

static float spacing_of(const sbri_rig *rig, const sbri_gait_input *input) {
  return rig->wave.length * input->scale / (float)SBRI_PATH_PER_BODY;
}

void sbri_slither_reset(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input) {
  const sbf_undulation *wave = rig->gait->undulation;
  sbri_motion_state *m = sbri_motion(rig, state);
  m->path_count = 0;
  if (!wave || !(rig->wave.length > 0)) return;
  float mean, spacing = spacing_of(rig, input),
              phase = spacing / (wave->wavelength * rig->wave.length * input->scale);
  (void)sbri_serpenoid(wave->heading_amplitude, 0, &mean);
  m->nose = nose_position(rig, state, input, m->path_phase, 0);
  /* An initial path along its curve. */
  for (uint32_t i = 0; i < SBRI_PATH_POINTS; i++)
    m->path[i] =
        nose_position(rig, state, input, m->path_phase - phase * (float)i, -mean * spacing * (float)i);
  m->path_count = SBRI_PATH_POINTS;
  m->path_ahead = 0;
}

void sbri_slither_tick(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, sbf_vec3 step) {
  const sbf_undulation *wave = rig->gait->undulation;
  sbri_motion_state *m = sbri_motion(rig, state);
  if (!m->path_count) return;
  float mean, went = sqrtf(step.x * step.x + step.z * step.z);
  (void)sbri_serpenoid(wave->heading_amplitude, 0, &mean);
  m->path_phase += went / (mean * wave->wavelength * rig->wave.length * input->scale);
  m->path_phase -= (float)(int32_t)m->path_phase;
  m->nose = nose_position(rig, state, input, m->path_phase, 0);
  float spacing = spacing_of(rig, input);
  for (uint32_t i = 0; i < SBRI_PATH_POINTS; i++) { /* no tick moves so far that it needs more */
    sbf_vec3 displacement = sbri_sub(m->nose, m->path[0]);
    displacement.y = 0; /* heights follow in the pose */
    float far = sbri_length(displacement);
    if (!(far >= spacing)) break;
    memmove(m->path + 1, m->path, (SBRI_PATH_POINTS - 1) * sizeof *m->path);
    m->path[0] = sbri_add_scaled(m->path[1], displacement, spacing / far);
  }
  m->path_ahead = sbri_flat_distance(m->nose, m->path[0]);
}

/* Point of the path at the straight distance `distance` from `from`, behind the beginning of segment
 * `*segment`; segment 0 leads from the nose to the first point of m->path. Beyond its end the path continues
 * straight. */
static sbf_vec3 behind(const sbri_motion_state *m, sbf_vec3 from, float distance, uint32_t *segment) {
  for (uint32_t i = *segment; i < m->path_count; i++) {
    sbf_vec3 far = m->path[i];
    if (sbri_length(sbri_sub(far, from)) < distance) continue;
    /* |a + t (b - a)|^2 = d^2 with a inside the circle, or the last joint itself */
    sbf_vec3 start = i == *segment ? from : i ? m->path[i - 1] : m->nose;
    sbf_vec3 a = sbri_sub(start, from), b = sbri_sub(far, start);
    float bb = sbri_dot(b, b), ab = sbri_dot(a, b), rest = distance * distance - sbri_dot(a, a);
    float root = ab * ab + bb * rest, t = bb > 0 ? (sqrtf(root > 0 ? root : 0) - ab) / bb : 0;
    *segment = i;
    return sbri_add_scaled(start, b, sbri_clamp(t, 0, 1));
  }
  sbf_vec3 last = m->path[m->path_count - 1];
  *segment = m->path_count;
  sbf_vec3 displacement = sbri_sub(last, m->path[m->path_count - 2]);
  if (sbri_flat_distance(from, last) > 0) displacement = sbri_sub(last, from);
  return sbri_add_scaled(from, sbri_normalize(displacement, sbri_vec3(0, 0, -1)), distance);
}

/* A joint of the body above the path, at its rest height. */
static sbf_vec3 above(
    const sbri_gait_state *state, const sbri_gait_input *input, sbf_vec3 at, float rest_height) {
  return sbri_vec3(at.x, at.y + state->motion.position.y + rest_height * input->scale, at.z);
}

/* Maximum of the values up to `width` beside each. */
static void dilate(float values[TRACK], int width) {
  float before[TRACK];
  memcpy(before, values, sizeof before);
  for (int i = 0; i < TRACK; i++)
    for (int k = i < width ? 0 : i - width; k <= i + width && k < TRACK; k++)
      if (before[k] > values[i]) values[i] = before[k];
}

/* Raises values until neighbours differ by at most `step`. */
static void dilate_by_cone(float values[TRACK], float step) {
  for (int i = 1; i < TRACK; i++)
    if (values[i] < values[i - 1] - step) values[i] = values[i - 1] - step;
  for (int i = TRACK - 1; i-- > 0;)
    if (values[i] < values[i + 1] - step) values[i] = values[i + 1] - step;
}

static void average(float values[TRACK], int width) {
  float before[TRACK];
  memcpy(before, values, sizeof before);
  for (int i = 0; i < TRACK; i++) {
    float sum = 0;
    for (int k = i - width; k <= i + width; k++) sum += before[k < 0 ? 0 : k < TRACK ? k : TRACK - 1];
    values[i] = sum / (float)(2 * width + 1);
  }
}

/* Half of the body's width, m: mean radius of the balls in it. */
static float body_half_width(const sbri_rig *rig, float scale) {
  float sum = 0;
  for (uint32_t i = 0; i < rig->wall_volume.wall_sphere_count; i++)
    sum += rig->wall_volume.wall_spheres[i].radius;
  return rig->wall_volume.wall_sphere_count ? scale * sum / (float)rig->wall_volume.wall_sphere_count : 0;
}

/* Highest ground across the path at a point. */
static float highest_beside(
    const sbri_gait_input *input, const sbf_vec3 points[TRACK], int i, float half_width) {
  const sbf_vec3 *before = &points[i ? i - 1 : i], *after = &points[i + 1 < TRACK ? i + 1 : i];
  sbf_vec3 left = sbri_vec3(after->z - before->z, 0, before->x - after->x);
  left = sbri_scale(sbri_normalize(left, sbri_vec3(0, 0, 0)), half_width);
  float max = sbri_ground_below(input, points[i], NULL).y;
  for (int side = -1; side <= 1; side += 2) {
    float y = sbri_ground_below(input, sbri_add_scaled(points[i], left, (float)side), NULL).y;
    max = y > max ? y : max;
  }
  return max;
}

/* Heights of the path and of the nose. Points ahead of the nose continue those of the path, so that an edge
 * ahead comes nearer at the speed of the nose. */
static void lay_path(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input, sbri_motion_state *m) {
  const sbf_undulation *wave = rig->gait->undulation;
  sbf_vec3 points[TRACK];
  float half_width = body_half_width(rig, input->scale);
  float track[TRACK], mean, spacing = spacing_of(rig, input);
  float cycle = wave->wavelength * rig->wave.length * input->scale;
  (void)sbri_serpenoid(wave->heading_amplitude, 0, &mean);
  float bend = state->motion.forward > 0 ? state->motion.turn / state->motion.forward : 0;
  for (int i = 0; i < AHEAD; i++) {
    float ahead = spacing * (float)(AHEAD - i) - m->path_ahead;
    sbf_vec3 at = nose_position(rig, state, input, m->path_phase + ahead / cycle, 0);
    float turned = bend * mean * ahead;
    sbf_vec3 moved = sbri_rotate_yaw(sbri_body_to_world(state, sbri_vec3(0, 0, mean * ahead)), 0.5f * turned);
    at = sbri_add(sbri_rotate_yaw(sbri_sub(at, state->motion.position), turned), state->motion.position);
    points[i] = sbri_add(at, moved);
  }
  for (uint32_t i = 0; i < SBRI_PATH_POINTS; i++) points[AHEAD + i] = m->path[i];
  for (int i = 0; i < TRACK; i++) track[i] = highest_beside(input, points, i, half_width);
  dilate(track, BRIDGED);
  dilate_by_cone(track, STEEPEST * spacing);
  average(track, AVERAGED);
  for (uint32_t i = 0; i < SBRI_PATH_POINTS; i++) m->path[i].y = track[AHEAD + i];
  float t = m->path_ahead / spacing;
  m->nose.y = track[AHEAD] + (t < 1 ? t : 1) * (track[AHEAD - 1] - track[AHEAD]);
}

/* A bone on the path: its ends and its rotation from rest relative to the root frame. */
typedef struct placed_bone {
  sbf_vec3 front, backward;
  sbf_quat rotation;
} placed_bone;

static sbf_quat yaw_to(sbf_vec3 direction, sbf_vec3 rest) {
  sbf_quat rotation = {0, 0, 0, 1};
  float yaw = sbri_atan2(direction.x, direction.z) - sbri_atan2(rest.x, rest.z);
  sbri_sincos(0.5f * yaw, &rotation.y, &rotation.w);
  return rotation;
}

/* Rotation of the direction of a bone from `rest` to `now`: first about +Y, then up, so that its back stays
 * up. */
static sbf_quat rotation_between(sbf_vec3 rest, sbf_vec3 now) {
  float flat_rest = sqrtf(rest.x * rest.x + rest.z * rest.z), flat = sqrtf(now.x * now.x + now.z * now.z);
  float pitch = sbri_atan2(rest.y, flat_rest) - sbri_atan2(now.y, flat), s;
  sbf_vec3 left = sbri_normalize(sbri_vec3(now.z, 0, -now.x), sbri_vec3(1, 0, 0));
  sbf_quat up = {0, 0, 0, 1};
  sbri_sincos(0.5f * pitch, &s, &up.w);
  up.x = left.x * s, up.z = left.z * s;
  return sbri_quat_normalize(sbri_quat_multiply(up, yaw_to(now, rest)));
}

/* The next joint behind `from`, at the rest offset `rest`: on the path where the body lies on the ground;
 * where it is raised, as the neck of a cobra, straight up or back along the path's direction `direction`. */
static sbf_vec3 next_joint(const sbri_motion_state *m, sbf_vec3 from, sbf_vec3 rest, sbf_vec3 direction,
    float scale, uint32_t *segment) {
  float flat = sqrtf(rest.x * rest.x + rest.z * rest.z) * scale;
  if (!(flat > 0)) return from;
  bool stands = fabsf(rest.y) * scale > flat;
  if (stands && rest.z > 0) return sbri_add_scaled(from, direction, flat);
  return behind(m, from, flat, segment);
}

/* Places the chain's bones from the nose to `last`; returns the last one. */
static placed_bone set_bone(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input, uint32_t last) {
  const sbri_motion_state *m = sbri_motion(rig, (sbri_gait_state *)(uintptr_t)state);
  const sbf_vec3 *joints = rig->wave.joints;
  sbf_vec3 front = m->nose;
  float scale = input->scale;
  uint32_t segment = 0;
  for (uint32_t k = 0;; k++) {
    sbf_vec3 rest = sbri_sub(joints[2 * k + 1], joints[2 * k]);
    uint32_t ahead = segment;
    sbf_vec3 direction = sbri_sub(front, behind(m, front, 0.02f * rig->wave.length * scale, &ahead));
    direction.y = 0;
    direction = sbri_normalize(direction, sbri_vec3(0, 0, 1));
    sbf_vec3 backward = next_joint(m, front, rest, direction, scale, &segment);
    if (k == last) {
      sbf_vec3 a = above(state, input, front, joints[2 * k].y);
      sbf_vec3 b = above(state, input, backward, joints[2 * k + 1].y);
      float flat = rest.x * rest.x + rest.z * rest.z;
      bool on_ground = flat > rest.y * rest.y;
      sbf_quat rotation = on_ground ? rotation_between(sbri_scale(rest, -1), sbri_sub(a, b))
                                    : yaw_to(direction, sbri_vec3(0, 0, 1));
      return (placed_bone){a, b, rotation};
    }
    front =
        next_joint(m, backward, sbri_sub(joints[2 * k + 2], joints[2 * k + 1]), direction, scale, &segment);
  }
}

float sbri_slither_support(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input) {
  const sbri_motion_state *m = sbri_motion(rig, (sbri_gait_state *)(uintptr_t)state);
  if (!m->path_count) return sbri_ground_below(input, state->motion.position, NULL).y;
  float sum = 0;
  for (uint32_t i = 0; i < SBRI_PATH_PER_BODY; i += SUPPORTS)
    sum += sbri_ground_below(input, m->path[i], NULL).y;
  return sum * SUPPORTS / SBRI_PATH_PER_BODY;
}

void sbri_slither_pose(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbr_transform *root, sbr_transform *pose) {
  const sbf_undulation *wave = rig->gait->undulation;
  (void)root;
  if (!wave || sbri_motion(rig, state)->path_count < 2) return;
  lay_path(rig, state, input, sbri_motion(rig, state));
  /* Parents before children, independent of the order along the chain. */
  for (uint32_t bone = 0; bone < rig->bones.count; bone++) {
    for (uint32_t k = 0; k < wave->bones.count; k++) {
      if (wave->bones.at[k] != bone) continue;
      placed_bone at = set_bone(rig, state, input, k);
      sbf_quat to = sbri_quat_normalize(sbri_quat_multiply(at.rotation, rig->bones.rest[bone].rotation));
      sbri_rig_rotate_bone(rig, bone, sbri_quat_multiply(to, sbri_quat_conjugate(pose[bone].rotation)), pose);
      pose[bone].rotation = to;
      sbf_vec3 head = rig->bones.rest[bone].position;
      bool is_head_first = sbri_length(sbri_sub(head, rig->wave.joints[2 * k])) <=
                           sbri_length(sbri_sub(head, rig->wave.joints[2 * k + 1]));
      sbri_rig_shift(rig, bone, sbri_sub(is_head_first ? at.front : at.backward, pose[bone].position), pose);
      break;
    }
  }
}
