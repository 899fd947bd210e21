/* Interaction of the window's user with a character: walking, dragging, throwing balls. As in the page of
 * `sbfmt export -o PAGE.html`. */
#ifndef VIEW_PLAYER_H
#define VIEW_PLAYER_H

#include "render/draw_math.h"
#include "sbrun/query.h"
#include "session.h"

enum { PLAYER_BALLS = 6 };

typedef struct player_ball {
  sbr_collider_id collider;
  sbf_vec3 position, velocity; /* m, m/s */
} player_ball;

typedef struct player {
  session *s;
  float size;                    /* m: diagonal of the character's bounding box */
  float mass;                    /* kg, of all rigid bodies */
  sbr_transform *bones;          /* (bones) buffer */
  int32_t *rigid_of;             /* (bones) rigid body that moves with each; -1: none */
  float pace;                    /* in bodies' sizes per second */
  float forward, side, turn, up; /* input of the keys, -1 to 1 */
  bool steered;                  /* a key has been pressed, so the keys control the walk */
  sbr_shape *ball, *fingertip;   /* shapes of balls and of the finger that presses */
  player_ball balls[PLAYER_BALLS];
  uint32_t ball_count, thrown, hits;
  bool holds;
  int32_t dragged_rigid;  /* -1: nothing that could be pulled, a finger presses */
  sbf_vec3 dragged_local; /* grabbed point relative to the centre of mass, in body axes, m */
  sbf_vec3 target;        /* target of that point */
  sbr_collider_id finger;
} player;

/* `size` as above. For the current session: close it before a restart, and open it afterwards. */
sbf_status player_open(player *p, session *s, float size, sbf_diagnostic *error);
void player_close(player *p); /* before the session is closed */

/* The character's centre: of its bones with soft bodies, else of all bones, else of its bodies' points. */
sbf_vec3 player_middle(const player *p);

/* Grabs the first object along the ray from `eye`, up to `reach` m; *place receives the hit point. False
 * if there is none. */
bool player_grab(player *p, sbf_vec3 eye, sbf_vec3 direction, float reach, sbf_vec3 *position);
void player_drag(player *p, sbf_vec3 target);
void player_release(player *p);

/* Throws a ball from there to the character's centre. */
void player_throw(player *p, sbf_vec3 from);
void player_knock(player *p); /* over */

float player_ball_radius(const player *p); /* m */

/* Advances one frame; false after the session's last. */
bool player_step(player *p, double seconds);

#endif
