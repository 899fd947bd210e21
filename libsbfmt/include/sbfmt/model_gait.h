/* How the character walks: legs, head and tail. A chapter of sbfmt/model.h, which says what holds for all of them.
 *
 * Made from spec/sbf.schema by spec/generate/generate.py: change the schema, not this file. */
#ifndef SBFMT_MODEL_GAIT_H
#define SBFMT_MODEL_GAIT_H

#include "sbfmt/base.h"

#ifdef __cplusplus
extern "C" {
#endif

// clang-format off

/* One leg. */
typedef struct sbf_leg {
  const char *name;   /* Name for people. */
  int32_t ik;         /* What moves it. [index into asset.ik_chains, or SBF_NONE] */
  sbf_vec3 home;      /* Where its foot stands at rest: the end bone's head, asset space. [m] */
  float sole;         /* Height of the end bone's head above the sole, at rest. [m] */
  uint32_t group;     /* Feet of one group may be in the air together. */
  float jump_margin;  /* A foot farther than its reach plus this is put down anew. [m; [0, inf); default 0.5] */
} sbf_leg;
typedef struct sbf_leg_list { const sbf_leg *at; uint32_t count; } sbf_leg_list;

/* The head looks where a turn will lead. */
typedef struct sbf_head_turn {
  int32_t bone;         /* The head. [index into asset.bones, or SBF_NONE] */
  float lead;           /* How far ahead it looks. [s; [0, inf); default 0.4] */
  float limit;          /* Greatest angle. [rad; [0, 3.15]; default 0.7] */
  float frequency;      /* Of the follower that moves it. [Hz; (0, inf); default 1.5] */
  float damping_ratio;  /* Of that follower. [[0, inf); default 0.8] */
} sbf_head_turn;
typedef struct sbf_head_turn_list { const sbf_head_turn *at; uint32_t count; } sbf_head_turn_list;

/* A chain that lags behind the body and overshoots. */
typedef struct sbf_tail {
  int32_t chain;        /* Which chain. [index into asset.chains, or SBF_NONE] */
  float frequency;      /* Of the first bone's follower. [Hz; (0, inf); default 1.2] */
  float damping_ratio;  /* Of the followers. [[0, inf); default 0.25] */
  float limit;          /* Greatest bend of a bone against its parent. [rad; [0, 3.15]; default 0.6] */
} sbf_tail;
typedef struct sbf_tail_list { const sbf_tail *at; uint32_t count; } sbf_tail_list;

/* How the character walks. */
typedef struct sbf_gait {
  const char *id;             /* Identity. */
  const char *name;           /* Name for people. */
  bool proposed;              /* Guessed from the rig, for a person to confirm. [default false] */
  int32_t body;               /* The bone on which the rest hangs in a walk: it travels with the character.
                               * [index into asset.bones, or SBF_NONE] */
  int32_t hips;               /* Turns with the line between the hind feet. [index into asset.bones, or SBF_NONE] */
  int32_t chest;              /* Turns with the line between the fore feet. [index into asset.bones, or SBF_NONE] */
  float step_height;          /* Greatest lift of a foot. [m; [0, inf); default 0.05] */
  float step_width;           /* Distance of a foot from the body's middle line when walking; 0: its home's.
                               * [m; [0, inf)] */
  float step_trigger;         /* A foot this far from its home wants to step. [m; (0, inf); default 0.05] */
  float step_duration;        /* Time of a step at the walking speed. [s; (0, inf); default 0.25] */
  float walk_speed;           /* Speed the other settings were made for; a note, which changes nothing.
                               * [m/s; (0, inf); default 0.5] */
  float hip_tilt;             /* Share of the feet's line that hips and chest take. [[0, 1]; default 0.5] */
  float body_tilt;            /* Share of the slope between the feet that the body's pitch and roll take.
                               * [[0, 1]; default 0.7] */
  sbf_leg_list legs;          /* Its legs. */
  const sbf_head_turn *head;  /* A head that leads a turn. */
  sbf_tail_list tails;        /* Chains that lag and overshoot. */
} sbf_gait;
typedef struct sbf_gait_list { const sbf_gait *at; uint32_t count; } sbf_gait_list;

/* Every field at its default, lists empty, references SBF_NONE. */
SBF_API void sbf_leg_init(sbf_leg *leg);
SBF_API void sbf_head_turn_init(sbf_head_turn *head_turn);
SBF_API void sbf_tail_init(sbf_tail *tail);
SBF_API void sbf_gait_init(sbf_gait *gait);

// clang-format on

#ifdef __cplusplus
}
#endif
#endif
