/* Where the picture is taken from: frames a box, then follows a moving character or circles it. */
#ifndef RENDER_CAMERA_H
#define RENDER_CAMERA_H

#include "render/draw_math.h"

typedef struct draw_camera {
  sbf_vec3 subject;    /* what stands in the middle of the picture, metres */
  sbf_vec3 seen;       /* where that should have been when it was last followed */
  float seen_distance; /* and how far off */
  sbf_vec3 velocity;   /* of the subject while it is followed, m/s */
  float distance;      /* from the subject to the eye, metres */
  float distance_rate; /* while it is followed, m/s */
  float yaw;           /* about +Y, radians; 0 looks at the subject's front, that is from +Z */
  float pitch;         /* above the horizon, radians */
  float half_height;   /* tangent of half the vertical view angle */
  float home_yaw;      /* as framed: the lights stand where the camera first stood */
} draw_camera;

/* The view a product is shown in: three quarters from the front, a little from above, through a long lens. */
#define DRAW_CAMERA_THREE_QUARTER_YAW 0.72f
#define DRAW_CAMERA_THREE_QUARTER_PITCH 0.26f

/* Stands as near as shows all the points, with a margin, in a picture of width / height `aspect`; points that
 * are not finite are left out. Without any, it shows a metre about the origin. */
void draw_camera_frame_points(
    draw_camera *camera, const sbf_vec3 *points, uint32_t point_count, float aspect, float yaw, float pitch);

/* The same for the corners of a box: of all places a moving thing will be at, say. */
void draw_camera_frame(draw_camera *camera, const box3 *box, float aspect, float yaw, float pitch);

/* Goes, in `seconds` since the last call, towards how the subject is best seen now: `best`, framed anew from
 * the camera's own side. It never jerks: it keeps up with steady motion, lags or runs on a little, for about
 * DRAW_CAMERA_FOLLOW_SECONDS, while the subject gains or loses speed, and smooths its bobbing away. */
#define DRAW_CAMERA_FOLLOW_SECONDS 0.5f
void draw_camera_follow(draw_camera *camera, const draw_camera *best, float seconds);

/* Circles the subject; the lights stay. */
void draw_camera_orbit(draw_camera *camera, float radians);

sbf_vec3 draw_camera_back(const draw_camera *camera); /* unit, from what is seen to the eye */
sbf_vec3 draw_camera_eye(const draw_camera *camera);
matrix4 draw_camera_view(const draw_camera *camera);
/* `reach`: how far from the subject there is something to see, metres. */
matrix4 draw_camera_projection(const draw_camera *camera, float aspect, float reach);

#endif
