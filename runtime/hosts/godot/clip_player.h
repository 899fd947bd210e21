/* Clips of a character in four layers: ends, loops and queues, which the runtime leaves to its host. */
#ifndef SBFMT_GODOT_CLIP_PLAYER_H
#define SBFMT_GODOT_CLIP_PLAYER_H

#include "soft_character.h"

enum { CLIP_LAYERS = 4, CLIP_QUEUE = 8 };

/* A clip as a script asks for it. */
typedef struct clip_request {
  int32_t clip, mask; /* SBF_NONE: none, all bones */
  float speed, blend_s, weight;
  bool loops, root_motion;
} clip_request;

typedef struct clip_layer {
  clip_request now;
  double time_s;       /* in the clip, as the runtime has it */
  float speed;         /* that the runtime has */
  bool plays, rewinds; /* not ended; it is taken back to its beginning in the next step */
  clip_request queue[CLIP_QUEUE];
  uint32_t queued;
} clip_layer;

typedef struct clip_player {
  clip_layer layers[CLIP_LAYERS];
  uint64_t tick;                  /* of the world, last seen */
  int32_t ended[CLIP_LAYERS * 2]; /* clips whose end is to be reported */
  uint32_t ended_count;
} clip_player;

/* Plays at once, or after what plays; false where the queue is full. A clip SBF_NONE fades the layer out. */
void clip_player_play(soft_character *one, uint32_t layer, const clip_request *request);
bool clip_player_queue(soft_character *one, uint32_t layer, const clip_request *request);
/* Before and after a step of the world. */
void clip_player_prepare(soft_character *one, float frame_s);
void clip_player_advance(soft_character *one);
/* Its world is another one, where clips go on. */
void clip_player_remade(soft_character *one);
/* A clip that has ended since it was last asked; SBF_NONE: no more. */
int32_t clip_player_take_ended(soft_character *one);

#endif
