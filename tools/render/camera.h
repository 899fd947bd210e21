/* Camera: frames a box, then follows a moving character or circles it. */
#ifndef RENDER_CAMERA_H
#define RENDER_CAMERA_H

#include "render/draw_math.h"

typedef struct draw_camera {
  sbf_vec3 subject;    /* centre of the picture, metres */
  sbf_vec3 seen;       /* target of the subject at the last update */
  float seen_distance; /* target of the distance at the last update */
  sbf_vec3 velocity;   /* of the subject while it is followed, m/s */
  float distance;      /* from the subject to the eye, metres */
  float distance_rate; /* while it is followed, m/s */
  float yaw;           /* about +Y, radians; 0 looks at the subject's front from +Z */
  float pitch;         /* above the horizon, radians */
  float half_height;   /* tangent of half the vertical view angle */
  float home_yaw;      /* after framing: the lights keep this direction */
} draw_camera;

/* View of product photography: three quarters from the front, slightly from above, with a long lens. */
#define DRAW_CAMERA_THREE_QUARTER_YAW 0.72f
#define DRAW_CAMERA_THREE_QUARTER_PITCH 0.26f

/* Moves as close as shows all the points, with a margin, in a picture of width / height `aspect`; ignores
 * points that are not finite. Without any, it shows a metre about the origin. */
void draw_camera_frame_points(
    draw_camera *camera, const sbf_vec3 *points, uint32_t point_count, float aspect, float yaw, float pitch);

/* The same for the corners of a box, for example of all positions of a moving object. */
void draw_camera_frame(draw_camera *camera, const box3 *box, float aspect, float yaw, float pitch);

/* Moves, in `seconds` since the last call, towards the best view of the subject: `best`, framed anew from
 * the camera's own side. It never jerks: it keeps up with steady motion, lags or overshoots slightly for
 * about DRAW_CAMERA_FOLLOW_SECONDS while the subject changes speed, and filters out its bobbing. */
#define DRAW_CAMERA_FOLLOW_SECONDS 0.5f
void draw_camera_follow(draw_camera *camera, const draw_camera *best, float seconds);

/* Circles the subject; the lights do not move. */
void draw_camera_orbit(draw_camera *camera, float radians);

sbf_vec3 draw_camera_back(const draw_camera *camera); /* unit vector from the subject to the eye */
sbf_vec3 draw_camera_eye(const draw_camera *camera);
matrix4 draw_camera_view(const draw_camera *camera);
/* `reach`: radius of the visible content around the subject, metres. */
matrix4 draw_camera_projection(const draw_camera *camera, float aspect, float reach);

#endif
