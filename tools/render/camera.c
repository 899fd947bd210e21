#include "render/camera.h"

static const float margin = 1.12f;           /* picture over subject */
static const float half_height = 0.2493280f; /* tan 14 degrees: long enough that nothing looks bulged */

sbf_vec3 draw_camera_back(const draw_camera *camera) {
  float level = cosf(camera->pitch);
  return v3(level * sinf(camera->yaw), sinf(camera->pitch), level * cosf(camera->yaw));
}

sbf_vec3 draw_camera_eye(const draw_camera *camera) {
  sbf_vec3 back = draw_camera_back(camera), right = v3_unit(v3_cross(v3(0, 1, 0), back), v3(1, 0, 0));
  sbf_vec3 aside = v3_add(v3_scale(right, camera->right), v3_scale(v3_cross(back, right), camera->over));
  return v3_add(v3_add(camera->subject, aside), v3_scale(back, camera->distance));
}

matrix4 draw_camera_view(const draw_camera *camera) {
  return matrix4_look(draw_camera_eye(camera), draw_camera_back(camera), v3(0, 1, 0));
}

matrix4 draw_camera_projection(const draw_camera *camera, float aspect, float reach) {
  float near = camera->distance - reach, least = camera->distance * 0.02f;
  return matrix4_perspective(
      camera->half_height, aspect, near > least ? near : least, camera->distance + reach);
}

/* A point p, in the axes right, over and back of the picture, is inside a picture whose half width is w at
 * distance 1, seen from (shift, distance), when |p.right - shift| <= w (distance - p.back). The nearest
 * distance makes both sides tight: with A = max(p.right + w p.back) and B = max(-p.right + w p.back),
 * distance = (A + B) / 2w and shift = (A - B) / 2; and likewise upwards. */
typedef struct frame_extent {
  float right, left, over, under; /* the maxima A and B of both ways */
} frame_extent;

static void frame_point(frame_extent *extent, sbf_vec3 p, float wide, float high) {
  extent->right = fmaxf(extent->right, p.x + wide * p.z);
  extent->left = fmaxf(extent->left, -p.x + wide * p.z);
  extent->over = fmaxf(extent->over, p.y + high * p.z);
  extent->under = fmaxf(extent->under, -p.y + high * p.z);
}

void draw_camera_frame_points(
    draw_camera *camera, const sbf_vec3 *points, uint32_t point_count, float aspect, float yaw, float pitch) {
  box3 box = box3_empty();
  for (uint32_t i = 0; i < point_count; i++) box3_add(&box, points[i]);
  if (box3_is_empty(&box)) {
    box = (box3){{-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f}};
    draw_camera_frame(camera, &box, aspect, yaw, pitch);
    return;
  }
  *camera = (draw_camera){.yaw = yaw, .home_yaw = yaw, .pitch = pitch, .half_height = half_height};
  float high = half_height / margin, wide = high * aspect;
  sbf_vec3 back = draw_camera_back(camera);
  sbf_vec3 right = v3_unit(v3_cross(v3(0, 1, 0), back), v3(1, 0, 0)), over = v3_cross(back, right);
  sbf_vec3 middle = v3_scale(v3_add(box.min, box.max), 0.5f);
  frame_extent all = {-INFINITY, -INFINITY, -INFINITY, -INFINITY};
  for (uint32_t i = 0; i < point_count; i++) {
    sbf_vec3 p = v3_sub(points[i], middle);
    if (isfinite(p.x) && isfinite(p.y) && isfinite(p.z))
      frame_point(&all, v3(v3_dot(p, right), v3_dot(p, over), v3_dot(p, back)), wide, high);
  }
  float distance = fmaxf((all.right + all.left) / (2 * wide), (all.over + all.under) / (2 * high));
  camera->distance = fmaxf(distance, 1e-3f);
  camera->right = 0.5f * (all.right - all.left);
  camera->over = 0.5f * (all.over - all.under);
  camera->subject = middle;
}

void draw_camera_frame(draw_camera *camera, const box3 *box, float aspect, float yaw, float pitch) {
  sbf_vec3 corners[8];
  for (int i = 0; i < 8; i++)
    corners[i] =
        v3(i & 1 ? box->max.x : box->min.x, i & 2 ? box->max.y : box->min.y, i & 4 ? box->max.z : box->min.z);
  draw_camera_frame_points(camera, corners, box3_is_empty(box) ? 0 : 8, aspect, yaw, pitch);
}

/* x'' = w^2 (target - x) - 2 w x', solved exactly over the step, so any frame rate shows the same path. */
static void follow_axis(float *x, float *velocity, float target, float seconds) {
  float w = 1 / DRAW_CAMERA_FOLLOW_SECONDS, offset = *x - target;
  float decay = expf(-w * seconds), slope = *velocity + w * offset;
  *x = target + (offset + slope * seconds) * decay;
  *velocity = (*velocity - w * slope * seconds) * decay;
}

void draw_camera_follow(draw_camera *camera, sbf_vec3 subject, float seconds) {
  if (!isfinite(subject.x) || !isfinite(subject.y) || !isfinite(subject.z)) return;
  follow_axis(&camera->subject.x, &camera->velocity.x, subject.x, seconds);
  follow_axis(&camera->subject.y, &camera->velocity.y, subject.y, seconds);
  follow_axis(&camera->subject.z, &camera->velocity.z, subject.z, seconds);
}

void draw_camera_orbit(draw_camera *camera, float radians) {
  camera->yaw += radians;
}
