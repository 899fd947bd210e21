#include "render/camera.h"

static const float margin = 1.12f; /* margin of the picture around the subject */
/* tangent of 14 degrees: a long lens without perspective distortion */
static const float half_height = 0.2493280f;

sbf_vec3 draw_camera_back(const draw_camera *camera) {
  float level = cosf(camera->pitch);
  return v3(level * sinf(camera->yaw), sinf(camera->pitch), level * cosf(camera->yaw));
}

sbf_vec3 draw_camera_eye(const draw_camera *camera) {
  return v3_add(camera->subject, v3_scale(draw_camera_back(camera), camera->distance));
}

matrix4 draw_camera_view(const draw_camera *camera) {
  return matrix4_view(draw_camera_eye(camera), draw_camera_back(camera), v3(0, 1, 0));
}

matrix4 draw_camera_projection(const draw_camera *camera, float aspect, float reach) {
  float near = camera->distance - reach, min = camera->distance * 0.02f;
  return matrix4_perspective(camera->half_height, aspect, near > min ? near : min, camera->distance + reach);
}

/* A point p, in the axes right, over and back of the picture, is inside a picture with half width w at
 * distance 1, seen from (shift, distance), if |p.right - shift| <= w (distance - p.back). The minimum
 * distance makes both sides tight: with A = max(p.right + w p.back) and B = max(-p.right + w p.back),
 * distance = (A + B) / 2w and shift = (A - B) / 2; the same holds upwards. */
typedef struct frame_extent {
  float right, left, over, under; /* the maxima A and B in both directions */
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
  camera->distance = camera->seen_distance = fmaxf(distance, 1e-3f);
  sbf_vec3 aside =
      v3_add(v3_scale(right, 0.5f * (all.right - all.left)), v3_scale(over, 0.5f * (all.over - all.under)));
  camera->subject = camera->seen = v3_add(middle, aside);
}

void draw_camera_frame(draw_camera *camera, const box3 *box, float aspect, float yaw, float pitch) {
  sbf_vec3 corners[8];
  for (int i = 0; i < 8; i++)
    corners[i] =
        v3(i & 1 ? box->max.x : box->min.x, i & 2 ? box->max.y : box->min.y, i & 4 ? box->max.z : box->min.z);
  draw_camera_frame_points(camera, corners, box3_is_empty(box) ? 0 : 8, aspect, yaw, pitch);
}

/* e'' = -w^2 e - 2 w e', where e is the offset from the target, which moves evenly over the step: the
 * exact solution, so every frame rate gives the same path. */
static void follow_axis(float *x, float *velocity, float before, float now, float seconds) {
  float w = 1 / DRAW_CAMERA_FOLLOW_SECONDS, pace = (now - before) / seconds;
  float error = *x - before, decay = expf(-w * seconds), slope = *velocity - pace + w * error;
  *x = now + (error + slope * seconds) * decay;
  *velocity = pace + (slope - w * (error + slope * seconds)) * decay;
}

/* Distance of the eye from the subject that shows the content of another framing: that framing's distance
 * plus the sideways offset of its centre. */
static float safe_distance(const draw_camera *camera, const draw_camera *best) {
  sbf_vec3 off = v3_sub(best->subject, camera->subject), back = draw_camera_back(camera);
  float nearer = v3_dot(off, back), aside = v3_length(v3_sub(off, v3_scale(back, nearer)));
  return best->distance + nearer + aside / (2 * camera->half_height);
}

void draw_camera_follow(draw_camera *camera, const draw_camera *best, float seconds) {
  if (!(seconds > 0)) return;
  follow_axis(&camera->subject.x, &camera->velocity.x, camera->seen.x, best->subject.x, seconds);
  follow_axis(&camera->subject.y, &camera->velocity.y, camera->seen.y, best->subject.y, seconds);
  follow_axis(&camera->subject.z, &camera->velocity.z, camera->seen.z, best->subject.z, seconds);
  camera->seen = best->subject;
  float distance = safe_distance(camera, best);
  follow_axis(&camera->distance, &camera->distance_rate, camera->seen_distance, distance, seconds);
  camera->seen_distance = distance;
}

void draw_camera_orbit(draw_camera *camera, float radians) {
  camera->yaw += radians;
}
