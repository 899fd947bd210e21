/* Gaits: legs, head and tail; waves, fins, wings, wheels. Part of sbfmt/model.h, which documents the common
 * conventions.
 *
 * Made from spec/sbf.schema by spec/generate/generate.py: change the schema, not this file. */
#ifndef SBFMT_MODEL_GAIT_H
#define SBFMT_MODEL_GAIT_H

#include "sbfmt/base.h"

#ifdef __cplusplus
extern "C" {
#endif

// clang-format off

/* Values of gait_kind; sbf_gait_kind_name returns their names in files. */
typedef enum sbf_gait_kind {
  SBF_GAIT_KIND_WALK = 0,
  SBF_GAIT_KIND_SWIM = 1,
  SBF_GAIT_KIND_FLY = 2,
  SBF_GAIT_KIND_SLITHER = 3,
  SBF_GAIT_KIND_CRAWL = 4,
  SBF_GAIT_KIND_ROLL = 5,
  SBF_GAIT_KIND_NONE = 6,
  SBF_GAIT_KIND_COUNT = 7
} sbf_gait_kind;

/* Values of wave_plane; sbf_wave_plane_name returns their names in files. */
typedef enum sbf_wave_plane {
  SBF_WAVE_PLANE_LATERAL = 0,
  SBF_WAVE_PLANE_VERTICAL = 1,
  SBF_WAVE_PLANE_COUNT = 2
} sbf_wave_plane;

/* Values of fin_motion; sbf_fin_motion_name returns their names in files. */
typedef enum sbf_fin_motion {
  SBF_FIN_MOTION_FLAP = 0,
  SBF_FIN_MOTION_TRAIL = 1,
  SBF_FIN_MOTION_STEER = 2,
  SBF_FIN_MOTION_COUNT = 3
} sbf_fin_motion;

/* One leg. */
typedef struct sbf_leg {
  const char *name;   /* Name for people. */
  int32_t ik;         /* Its chain. [index into asset.ik_chains, or SBF_NONE] */
  sbf_vec3 home;      /* Rest position of the end bone's head, asset space. [m] */
  float sole;         /* Height of the end bone's head above the sole, at rest. [m] */
  uint32_t group;     /* Feet of one group may be in the air together. */
  float jump_margin;  /* A foot farther from home than its reach plus this is placed at home.
                       * [m; [0, inf); default 0.5] */
} sbf_leg;
typedef struct sbf_leg_list { const sbf_leg *at; uint32_t count; } sbf_leg_list;

/* A head that looks ahead in a turn. */
typedef struct sbf_head_turn {
  int32_t bone;         /* The head. [index into asset.bones, or SBF_NONE] */
  float lead;           /* Time it looks ahead. [s; [0, inf); default 0.4] */
  float limit;          /* Maximum angle. [rad; [0, 3.15]; default 0.7] */
  float frequency;      /* Frequency of its follower. [Hz; (0, inf); default 1.5] */
  float damping_ratio;  /* Damping ratio of its follower. [[0, inf); default 0.8] */
} sbf_head_turn;
typedef struct sbf_head_turn_list { const sbf_head_turn *at; uint32_t count; } sbf_head_turn_list;

/* A chain that lags behind the body and overshoots. */
typedef struct sbf_tail {
  int32_t chain;        /* Chain. [index into asset.chains, or SBF_NONE] */
  float frequency;      /* Frequency of the first bone's follower. [Hz; (0, inf); default 1.2] */
  float damping_ratio;  /* Damping ratio of the followers. [[0, inf); default 0.25] */
  float limit;          /* Maximum angle between a bone and its parent. [rad; [0, 3.15]; default 0.6] */
} sbf_tail;
typedef struct sbf_tail_list { const sbf_tail *at; uint32_t count; } sbf_tail_list;

/* A wave that travels from the nose to the tail along a chain of bones. */
typedef struct sbf_undulation {
  sbf_u32_list bones;       /* Bones, nose to tail; parents do not matter. [index into asset.bones] */
  sbf_wave_plane plane;     /* lateral: to the sides, as fish; vertical: up and down, as whales. [default lateral] */
  float length;             /* Length L from nose to tail; 0: of the bones. [m; [0, inf)] */
  float wavelength;         /* Wavelength relative to L. [(0, inf); default 0.95] */
  sbf_vec3 amplitude;       /* Coefficients of 1, s and s^2 in the amplitude relative to L; s: from the nose, relative
                             * to L. [default 0.02,-0.08,0.16] */
  float exaggeration;       /* Factor of the amplitude. [[0, 10]; default 1] */
  float strouhal_number;    /* Frequency x peak-to-peak amplitude of the tail / speed. [(0, inf); default 0.3] */
  float idle_frequency;     /* Lowest frequency. [Hz; [0, inf); default 0.4] */
  float max_frequency;      /* Highest frequency. [Hz; (0, inf); default 8] */
  float heading_amplitude;  /* Slither: amplitude of the heading along the path. [rad; [0, 1.5]; default 0.7] */
} sbf_undulation;
typedef struct sbf_undulation_list { const sbf_undulation *at; uint32_t count; } sbf_undulation_list;

/* A fin, flipper or wing that turns about a hinge. */
typedef struct sbf_fin {
  const char *name;       /* Name for people. */
  sbf_u32_list bones;     /* Bones from the body to the tip. [index into asset.bones] */
  sbf_fin_motion motion;  /* flap: beats; trail: lags behind the body's turns; steer: turns against them.
                           * [default flap] */
  sbf_vec3 axis;          /* Hinge, asset space, rest pose; positive angles turn about it by the right hand.
                           * [default 0,0,1] */
  float amplitude;        /* Flap: half the stroke of the first bone; trail and steer: maximum angle.
                           * [rad; [0, 3.15]; default 0.4] */
  float mean;             /* Mean angle. [rad; [-3.15, 3.15]] */
  float flex;             /* Half the stroke that the other bones add together. [rad; [0, 3.15]] */
  float lag;              /* Phase by which the last bone lags behind the first. [rad; [0, 6.29]] */
  float phase;            /* Phase ahead of the beat. [rad; [-6.29, 6.29]] */
  float frequency;        /* Flap: frequency of the beat at walk_speed, 0: that of the undulation; trail: of its
                           * follower, 0: 2 Hz. [Hz; [0, 60]] */
  float twist;            /* Half the rotation about its length, a quarter of a beat ahead. [rad; [0, 3.15]] */
} sbf_fin;
typedef struct sbf_fin_list { const sbf_fin *at; uint32_t count; } sbf_fin_list;

/* A wheel that turns by the distance it rolls. */
typedef struct sbf_wheel {
  const char *name;   /* Name for people. */
  int32_t bone;       /* Bone; its head is the center. [index into asset.bones, or SBF_NONE] */
  sbf_vec3 axis;      /* Axle, asset space, rest pose; rolling forward is positive about it. [default 1,0,0] */
  float radius;       /* Radius. [m; (0, inf)] */
  float steer_limit;  /* Maximum steering angle; 0: it does not steer. [rad; [0, 1.5]] */
} sbf_wheel;
typedef struct sbf_wheel_list { const sbf_wheel *at; uint32_t count; } sbf_wheel_list;

/* The links of a track that run around its wheels. */
typedef struct sbf_tread {
  const char *name;    /* Name for people. */
  sbf_u32_list bones;  /* Links in order around the loop; driven forward, each moves to the position of the next.
                        * [index into asset.bones] */
} sbf_tread;
typedef struct sbf_tread_list { const sbf_tread *at; uint32_t count; } sbf_tread_list;

/* Buoyancy, drag and flight of a character in water or air. */
typedef struct sbf_medium {
  float buoyancy;       /* Fraction of its weight that buoyancy supports when it stops; below 1 it sinks, above 1 it
                         * rises. [[0, 10]; default 1] */
  float drag_length;    /* Distance over which drag slows it to 1/e; 0: the undulation's length, else the largest
                         * extent. [m; [0, inf)] */
  float altitude;       /* Height above the ground of its lowest point, where it starts. [m; [0, inf)] */
  float bank;           /* Factor of the bank tan(angle) = speed x turn rate / g. [[0, 4]; default 1] */
  float bank_limit;     /* Maximum bank. [rad; [0, 1.5]; default 0.8] */
  float pitch_limit;    /* Maximum pitch along its path. [rad; [0, 1.5]; default 0.8] */
  float tilt;           /* Additional forward tilt at walk_speed, as of hovering insects. [rad; [-1.5, 1.5]] */
  float bob;            /* Amplitude of the rise and fall at rest. [m; [0, inf)] */
  float bob_frequency;  /* Frequency of the rise and fall. [Hz; [0, 8]; default 0.8] */
  float glide_ratio;    /* Distance forward per height lost with still wings; 0: it never glides. [[0, inf)] */
} sbf_medium;
typedef struct sbf_medium_list { const sbf_medium *at; uint32_t count; } sbf_medium_list;

/* How a character moves. */
typedef struct sbf_gait {
  const char *id;                    /* Identity. */
  const char *name;                  /* Name for people. */
  bool proposed;                     /* Guessed from the rig, for a person to confirm. [default false] */
  int32_t body;                      /* Bone that travels with the character and moves the rest.
                                      * [index into asset.bones, or SBF_NONE] */
  int32_t hips;                      /* Bone that turns with the line between the hind feet.
                                      * [index into asset.bones, or SBF_NONE] */
  int32_t chest;                     /* Bone that turns with the line between the fore feet.
                                      * [index into asset.bones, or SBF_NONE] */
  float step_height;                 /* Maximum lift of a foot. [m; [0, inf); default 0.05] */
  float step_width;                  /* Distance of a foot from the body's middle line when walking; 0: its home's.
                                      * [m; [0, inf)] */
  float step_trigger;                /* Distance from home at which a foot steps. [m; (0, inf); default 0.05] */
  float step_duration;               /* Time of a step at the walking speed. [s; (0, inf); default 0.25] */
  float walk_speed;                  /* Speed for which the other settings were chosen. [m/s; (0, inf); default 0.5] */
  float hip_tilt;                    /* Fraction of the feet's line that hips and chest follow. [[0, 1]; default 0.5] */
  float body_tilt;                   /* Fraction of the slope between the feet that pitch and roll follow.
                                      * [[0, 1]; default 0.7] */
  sbf_leg_list legs;                 /* Legs. */
  const sbf_head_turn *head;         /* Head that leads a turn. */
  sbf_tail_list tails;               /* Chains that lag and overshoot. */
  sbf_gait_kind kind;                /* How it moves. [default walk] */
  int32_t rest_pose;                 /* Pose that it stands and moves in; absent: the rest pose.
                                      * [index into asset.poses, or SBF_NONE] */
  int32_t idle_clip;                 /* Clip played at rest; fades out up to half of walk_speed.
                                      * [index into asset.clips, or SBF_NONE] */
  int32_t move_clip;                 /* Clip played in motion, at its own rate at walk_speed; fades in up to half of it.
                                      * [index into asset.clips, or SBF_NONE] */
  const sbf_undulation *undulation;  /* Wave of the spine: swim, slither, crawl. */
  sbf_fin_list fins;                 /* Fins, flippers, wings: swim, fly. */
  sbf_wheel_list wheels;             /* Wheels: roll. */
  sbf_tread_list treads;             /* Links of tracks: roll. */
  const sbf_medium *medium;          /* Motion in a medium: swim, fly. */
} sbf_gait;
typedef struct sbf_gait_list { const sbf_gait *at; uint32_t count; } sbf_gait_list;

/* Sets every field to its default, lists to empty, references to SBF_NONE. */
SBF_API void sbf_leg_init(sbf_leg *leg);
SBF_API void sbf_head_turn_init(sbf_head_turn *head_turn);
SBF_API void sbf_tail_init(sbf_tail *tail);
SBF_API void sbf_undulation_init(sbf_undulation *undulation);
SBF_API void sbf_fin_init(sbf_fin *fin);
SBF_API void sbf_wheel_init(sbf_wheel *wheel);
SBF_API void sbf_tread_init(sbf_tread *tread);
SBF_API void sbf_medium_init(sbf_medium *medium);
SBF_API void sbf_gait_init(sbf_gait *gait);

/* The name of a value in files, or "?" if it is out of range. */
SBF_API const char *sbf_gait_kind_name(sbf_gait_kind value);
SBF_API const char *sbf_wave_plane_name(sbf_wave_plane value);
SBF_API const char *sbf_fin_motion_name(sbf_fin_motion value);

// clang-format on

#ifdef __cplusplus
}
#endif
#endif
