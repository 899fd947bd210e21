/* What the visitor of a window does to a character: makes it walk, drags it, throws balls at it. As in the
 * page that `sbfmt export -o PAGE.html` writes. */
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
  float size;                    /* m: of the character's box from corner to corner */
  float mass;                    /* kg, of all rigid bodies */
  sbr_transform *bones;          /* (bones) room */
  int32_t *rigid_of;             /* (bones) the rigid body that moves with each; -1: none */
  float pace;                    /* bodies' sizes a second */
  float forward, side, turn, up; /* wished by the keys, -1 to 1 */
  bool steered;                  /* a key has been pressed, so that the keys say how it walks */
  sbr_shape *ball, *fingertip;   /* forms of balls and of the finger that presses */
  player_ball balls[PLAYER_BALLS];
  uint32_t ball_count, thrown, hits;
  bool holds;
  int32_t dragged_rigid;  /* -1: nothing that could be pulled, a finger presses */
  sbf_vec3 dragged_local; /* where it is held, from its centre of mass, in its own axes, m */
  sbf_vec3 target;        /* where that is drawn to */
  sbr_collider_id finger;
} player;

/* `size` as above. For the session as it is now: close it before a restart, and open it after. */
sbf_status player_open(player *p, session *s, float size, sbf_diagnostic *error);
void player_close(player *p); /* before the session is */

/* Where the character's middle is: its bones' that carry flesh, else all bones', else its bodies' points'. */
sbf_vec3 player_middle(const player *p);

/* Takes hold of the first thing on the way from `eye`, up to `reach` m; where on it, in *place. False: there
 * is none. */
bool player_grab(player *p, sbf_vec3 eye, sbf_vec3 direction, float reach, sbf_vec3 *position);
void player_drag(player *p, sbf_vec3 target);
void player_release(player *p);

/* A ball from there to the character's middle. */
void player_throw(player *p, sbf_vec3 from);
void player_knock(player *p); /* over */

float player_ball_radius(const player *p); /* m */

/* One frame; false after the session's last. */
bool player_step(player *p, double seconds);

#endif
