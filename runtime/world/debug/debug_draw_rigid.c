/* Draws rigid bodies, joints and colliders as lines: sbrun/debug.h. */
#include "world/debug/debug_lines.h"

#include "coupling/ragdoll/ragdoll.h"
#include "math/trig.h"
#include "rigid/joint_frames.h"

/* Pose of a body's frame, asset metres; that of the anchor frame if `body` is negative. */
static sbr_transform body_pose(const sbri_character *c, int32_t body) {
  const sbr_transform *anchor = &sbri_pose(c)[sbri_anchor_frame(c->model)];
  if (body < 0) return (sbr_transform){sbri_scale(anchor->position, 1 / c->scale), anchor->rotation};
  if (sbri_rigid_drive(c)->any_dynamic) return sbri_rigid_bodies(c)[body].pose;
  return sbri_rigid_target(c, sbri_pose(c), (uint32_t)body);
}

void sbri_draw_rigid_bodies(const sbri_character *c, const sbri_debug_lines *to) {
  static const uint32_t colors[] = {SBRI_DRAW_GREY, SBRI_DRAW_ORANGE, SBRI_DRAW_GREEN};
  for (uint32_t b = 0; b < c->model->rigid.body_count; b++) {
    sbr_transform pose = body_pose(c, (int32_t)b);
    sbri_draw_hull(to, &c->model->rigid.bodies[b].hull, &pose, colors[sbri_rigid_bodies(c)[b].mode % 3]);
  }
}

/* ---- Joints ---- */

/* A cone about `axes[0]` with that half angle: its rim, and four lines from the apex. */
static void draw_cone(
    const sbri_debug_lines *to, sbf_vec3 apex, const sbf_vec3 axes[3], float half_rad, float size) {
  float sine, cosine;
  sbri_sincos(half_rad, &sine, &cosine);
  sbf_vec3 center = sbri_add_scaled(apex, axes[0], size * cosine);
  sbf_vec3 y = sbri_scale(axes[1], size * sine), z = sbri_scale(axes[2], size * sine);
  sbri_draw_arc(to, center, y, z, 0, 6.28318530718f, SBRI_DRAW_YELLOW);
  sbri_draw_line(to, apex, sbri_add(center, y), SBRI_DRAW_YELLOW);
  sbri_draw_line(to, apex, sbri_sub(center, y), SBRI_DRAW_YELLOW);
  sbri_draw_line(to, apex, sbri_add(center, z), SBRI_DRAW_YELLOW);
  sbri_draw_line(to, apex, sbri_sub(center, z), SBRI_DRAW_YELLOW);
}

/* Limits in frame a: angles as arcs of the moving axis, lengths as segments. */
static void draw_limit(
    const sbri_debug_lines *to, const sbf_limit *limit, sbf_vec3 origin, const sbf_vec3 axes[3], float size) {
  sbf_vec3 x = sbri_scale(axes[0], size), y = sbri_scale(axes[1], size), z = sbri_scale(axes[2], size);
  switch (limit->target) {
  case SBF_JOINT_AXIS_LINEAR_X:
  case SBF_JOINT_AXIS_LINEAR_Y:
  case SBF_JOINT_AXIS_LINEAR_Z: {
    sbf_vec3 along = axes[limit->target - SBF_JOINT_AXIS_LINEAR_X];
    sbri_draw_line(to, sbri_add_scaled(origin, along, limit->min), sbri_add_scaled(origin, along, limit->max),
        SBRI_DRAW_YELLOW);
    break;
  }
  case SBF_JOINT_AXIS_TWIST:
    sbri_draw_arc(to, origin, y, z, limit->min, limit->max, SBRI_DRAW_YELLOW);
    break;
  case SBF_JOINT_AXIS_SWING_Y:
    sbri_draw_arc(to, origin, x, sbri_scale(z, -1), limit->min, limit->max, SBRI_DRAW_YELLOW);
    break;
  case SBF_JOINT_AXIS_SWING_Z:
    sbri_draw_arc(to, origin, x, y, limit->min, limit->max, SBRI_DRAW_YELLOW);
    break;
  case SBF_JOINT_AXIS_SWING:
    draw_cone(to, origin, axes, limit->max, size);
    break;
  default:
    break; /* distances are drawn between the frames */
  }
}

static void draw_axes(const sbri_debug_lines *to, sbf_vec3 origin, const sbf_vec3 axes[3], float size) {
  static const uint32_t colors[3] = {SBRI_DRAW_RED, SBRI_DRAW_GREEN, SBRI_DRAW_BLUE};
  for (int k = 0; k < 3; k++) sbri_draw_line(to, origin, sbri_add_scaled(origin, axes[k], size), colors[k]);
}

void sbri_draw_joints(const sbri_character *c, float size, const sbri_debug_lines *to) {
  for (uint32_t j = 0; j < c->model->rigid.joint_count; j++) {
    const sbri_rigid_joint *joint = &c->model->rigid.joints[j];
    sbr_transform poses[SBRI_SIDES], anchor = body_pose(c, -1);
    const sbr_transform *at[SBRI_SIDES] = {&poses[SBRI_A], &poses[SBRI_B]};
    for (int side = 0; side < SBRI_SIDES; side++) poses[side] = body_pose(c, joint->bodies[side]);
    sbri_joint_frames joint_frames = sbri_joint_frames_of(joint, at, &anchor, sbri_vec3(0, 0, 0));
    sbf_vec3 a = sbri_add(poses[SBRI_A].position, joint_frames.arms[SBRI_A]),
             b = sbri_add(a, joint_frames.separation);
    sbf_quat turn_b = sbri_quat_multiply(poses[SBRI_B].rotation, joint->frames[SBRI_B].axes);
    const sbf_vec3 axes_b[3] = {sbri_quat_x(turn_b), sbri_quat_y(turn_b), sbri_quat_z(turn_b)};
    bool broken = sbri_rigid_joints(c)[j].broken != 0;
    draw_axes(to, a, joint_frames.axes, size);
    if (!broken) draw_axes(to, b, axes_b, 0.6f * size);
    if (!broken) sbri_draw_line(to, a, b, SBRI_DRAW_WHITE);
    for (uint32_t l = 0; !broken && l < joint->source->limits.count; l++)
      draw_limit(to, &joint->source->limits.at[l], a, joint_frames.axes, size);
  }
}

void sbri_draw_rigid_contacts(const sbri_character *c, double tick_s, const sbri_debug_lines *to) {
  const sbri_rigid_drive_state *drive = sbri_rigid_drive(c);
  /* Forces of the last tick as impulses, from the character's units to the world's. */
  float impulse_per_n = (float)tick_s * c->scale * c->scale * c->scale;
  for (uint32_t i = 0; c->model->rigid.body_count && i < drive->stored_contacts; i++) {
    const sbri_stored_contact *kept = &sbri_rigid_kept(c)[i];
    if (!(kept->normal_n > 0)) continue;
    sbr_transform pose = body_pose(c, (int32_t)kept->body);
    sbf_vec3 at = sbri_add(pose.position, sbri_rotate(pose.rotation, kept->at));
    sbri_draw_contact(to, at, kept->normal, kept->normal_n * impulse_per_n);
  }
}

/* ---- Colliders ---- */

static const float PLANE_HALF_M = 5; /* half size of the square that represents a plane */

static void draw_round(const sbri_debug_lines *to, const sbr_shape *shape, const sbr_transform *pose) {
  float r = shape->radius, half = shape->kind == SBR_SHAPE_CAPSULE ? shape->half_sizes.y : 0;
  sbf_vec3 x = sbri_scale(sbri_quat_x(pose->rotation), r), y = sbri_scale(sbri_quat_y(pose->rotation), r),
           z = sbri_scale(sbri_quat_z(pose->rotation), r), up = sbri_scale(sbri_quat_y(pose->rotation), half);
  const float turn = 6.28318530718f;
  for (int end = -1; end <= 1; end += 2) {
    sbf_vec3 center = sbri_add_scaled(pose->position, up, (float)end);
    sbf_vec3 out = sbri_scale(y, (float)end);
    sbri_draw_arc(to, center, x, z, 0, turn, SBRI_DRAW_GREY);
    sbri_draw_arc(to, center, x, out, 0, turn / 2, SBRI_DRAW_GREY);
    sbri_draw_arc(to, center, z, out, 0, turn / 2, SBRI_DRAW_GREY);
  }
  const sbf_vec3 sides[4] = {x, sbri_scale(x, -1), z, sbri_scale(z, -1)};
  for (int k = 0; half > 0 && k < 4; k++) {
    sbf_vec3 at = sbri_add(pose->position, sides[k]);
    sbri_draw_line(to, sbri_sub(at, up), sbri_add(at, up), SBRI_DRAW_GREY);
  }
}

static void draw_triangles(const sbri_debug_lines *to, const sbri_triangles *all, const sbr_transform *pose) {
  for (uint32_t i = 0; i < all->count; i++) {
    sbf_vec3 at[3];
    for (uint32_t k = 0; k < 3; k++)
      at[k] = sbri_add(pose->position, sbri_rotate(pose->rotation, all->points[all->corners[3 * i + k]]));
    for (int k = 0; k < 3; k++) sbri_draw_line(to, at[k], at[(k + 1) % 3], SBRI_DRAW_GREY);
  }
}

static void draw_collider(const sbri_collider *collider, const sbr_debug_draw *draw) {
  const sbr_shape *shape = collider->shape;
  const sbri_debug_lines to = {draw, collider->to, 1};
  const sbr_transform pose = {{0, 0, 0}, collider->rotation_to};
  const sbri_box plane = {{-PLANE_HALF_M, 0, -PLANE_HALF_M}, {PLANE_HALF_M, 0, PLANE_HALF_M}};
  const sbri_box host = {shape->host.low, shape->host.high};
  switch (shape->kind) {
  case SBR_SHAPE_PLANE:
    sbri_draw_box(&to, &plane, &pose, SBRI_DRAW_GREY);
    break;
  case SBR_SHAPE_SPHERE:
  case SBR_SHAPE_CAPSULE:
    draw_round(&to, shape, &pose);
    break;
  case SBR_SHAPE_BOX:
  case SBR_SHAPE_HULL:
    sbri_draw_hull(&to, &shape->hull, &pose, SBRI_DRAW_GREY);
    break;
  case SBR_SHAPE_MESH:
  case SBR_SHAPE_HEIGHT_FIELD:
    draw_triangles(&to, &shape->triangles, &pose);
    break;
  case SBR_SHAPE_HOST:
    sbri_draw_box(&to, &host, &pose, SBRI_DRAW_GREY);
    break;
  }
}

void sbri_draw_colliders(const sbr_world *world, const sbr_debug_draw *draw) {
  for (uint32_t i = 0; i < world->colliders.capacity; i++)
    if (world->colliders.at[i].shape) draw_collider(&world->colliders.at[i], draw);
}
