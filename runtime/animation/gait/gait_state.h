/* State of procedural animation, plain data: the body's motion, feet, head and tails. Positions are relative
 * to the character's origin, in world axes and scaled metres. */
#ifndef SBRI_GAIT_STATE_H
#define SBRI_GAIT_STATE_H

#include "animation/gait/gait.h"
#include "animation/gait/glide.h"
#include "math/follower.h"

/* What follows from a foot's normal and heading (sbri_foot_update_orientation). */
typedef struct sbri_foot_frame {
  float sine, cosine;         /* of the world heading */
  sbf_vec3 ankle_offset;      /* the ankle's offset from the middle of the sole, as rotated */
  sbf_vec3 home_ankle_offset; /* the same with the body's heading */
  sbf_quat tilt, rotation;    /* rotation to the ground's slope; rotation from the rest pose */
} sbri_foot_frame;

/* The present step, or the last. */
typedef struct sbri_foot_step {
  sbf_vec3 from, from_normal, to, to_normal; /* its ends and the ground normals there */
  sbf_vec3 planned;                          /* `to` at the time of the last plan */
  float phase;                               /* 0 to 1 */
  float duration_s;
  float needed_s;               /* shortest duration for its knee */
  float speed_fraction;         /* speed fraction that the stance feet allowed at lift-off */
  float clearance;              /* maximum lift, m */
  float move_begin, move_end;   /* phases at which horizontal motion begins and ends */
  float climb_begin, climb_end; /* phases at which the change of height begins and ends */
} sbri_foot_step;

/* Paths of a foot's `ground`, `lift`, `normal` and `heading`. */
typedef struct sbri_foot_glides {
  sbri_glide x, z, base, rise, tilt_x, tilt_z, twist;
} sbri_foot_glides;

/* Knee angle of the last pose, rad; straight: pi. */
typedef struct sbri_knee_state {
  float angle, rate;    /* rad, rad/s */
  float wanted;         /* angle that the foot's path requires */
  float locked;         /* angle at which it is locked; 0: not locked */
  uint32_t known_ticks; /* number of ticks with a known angle, at most 2 */
} sbri_knee_state;

typedef struct sbri_foot {
  sbf_vec3
      ground; /* position of a planted sole; of a swinging one the point below it on the line of its step */
  sbf_vec3 normal; /* ground normal there, smoothed during swing */
  float heading;   /* heading relative to the body, rad; constant in the world while the body turns */
  sbri_foot_frame frame;
  float lift; /* height of the sole above `ground`, m */
  sbri_foot_step step;
  sbri_foot_glides glides;
  sbf_vec3 hip;      /* hip position in the last pose, in root axes, m */
  sbf_vec3 pole;     /* pole vector of the knee in the last pose */
  float reach_error; /* distance of the sole from its target because of leg limits, m */
  sbri_knee_state knee;
  uint32_t planted, was_planted; /* 1: planted; now and in the previous tick */
  uint32_t steps_taken;
} sbri_foot;

/* Clip layers; a layer plays one clip or none. */
enum { SBRI_CLIP_LAYERS = 4 };
typedef struct sbri_clip_layer {
  uint32_t clip_plus_1, mask_plus_1; /* 0: none */
  float time_s, speed, weight, target_weight, fade_s;
} sbri_clip_layer;

/* Follower steps of the body for the present tick length, cached. */
typedef struct sbri_body_steps {
  float tick_s; /* 0: not known yet */
  sbri_follower_step lean, bend, upright, crouch, head;
} sbri_body_steps;

typedef struct sbri_gait_motion {
  sbf_vec3 position; /* position of the asset's origin; y: height above the ground */
  float heading;     /* rad, in (-pi, pi] */
  float heading_sine, heading_cosine;
  float forward, sideways, turn; /* smoothed, m/s and rad/s */
} sbri_gait_motion;

/* Selection of the foot that steps next, and the speed that the feet allow. */
typedef struct sbri_gait_stepping {
  float speed_fraction; /* speed fraction that the feet allow, 0 to 1 */
  float standing_s;     /* time since it stopped moving, s; 0 while moving */
  float step_limit;     /* speed fraction for which its steps have time, 0 to 1 */
  float step_s;         /* recent duration of a step */
  float half_m;         /* half of the stride length */
  float max_half_m;     /* upper bound of half_m, mean over a stride; 0: unknown */
  float since_lift_m;   /* distance since the last lift-off */
  float waiting_s;      /* time for which a due foot has had to wait */
  uint32_t in_groups;   /* 1: feet of a group step together; 0: as many as balance allows */
  uint32_t quick;       /* 1: on level ground, and feet step without regard to balance */
  uint32_t pivot_leg;   /* 1-based leg that the body turns about; 0: none */
  uint32_t next_leg;    /* 1-based leg that will lift next, towards whose support the body leans; 0: none */
} sbri_gait_stepping;

/* The body over its feet. */
typedef struct sbri_gait_balance {
  sbf_vec3 stand;          /* level offset from the rest pose that puts it over its feet, m */
  sbri_lag sway_x, sway_z; /* sway of the body over its feet, world axes, m */
  sbri_lag crouch;         /* lowering of the body so that its legs reach their feet, m */
  sbri_lag upright;        /* 1: tilts about its hips; 0: about the ground */
  sbri_lag roll;           /* slope from the right foot to the left, of a character with two, rad */
  sbri_lag clearance;      /* how far the body may be lowered with its belly above the ground, m; below 0: it
                              has to rise */
  sbri_lag bent;           /* 0: legs may be as straight as in the rest pose; 1: bent for walking */
  sbf_vec3 center;         /* centre of mass relative to the position, without sway, of the last tick */
} sbri_gait_balance;

/* Root and spine of the last stance. */
typedef struct sbri_gait_posture {
  sbr_transform root; /* with yaw and pitch */
  float hips_yaw, hips_pitch, chest_yaw;
  float lowered; /* lowering of the root from upright legs, m */
  float rise;    /* vertical speed of the root in the last tick, m/s */
} sbri_gait_posture;

typedef struct sbri_gait_fall {
  float level;         /* height of the ground below, relative to the origin, m */
  float speed;         /* downward speed, m/s */
  uint32_t is_falling; /* 1: in free fall */
} sbri_gait_fall;

/* The walk cycle of keyed poses. */
typedef struct sbri_gait_walk {
  float phase;           /* 0 to below 1 */
  float lead;            /* lead of that cycle over the feet that is still to be corrected, cycles */
  float half_m, since_m; /* asset metres between the last two landings (0: unknown); since the last */
  uint32_t landed_leg;   /* leg that landed last, 1 or 2; 0: none */
} sbri_gait_walk;

typedef struct sbri_gait_state {
  sbri_gait_motion motion;
  sbri_gait_stepping stepping;
  sbri_gait_balance balance;
  sbri_gait_posture posture;
  sbri_gait_fall fall;
  uint32_t displaced;    /* 1: moved by its host in this tick; stops when the host stops */
  uint32_t spares_knees; /* 1: lowered less than the feet need, to limit the knees' acceleration */
  double distance_m;
  sbri_gait_walk walk;
  sbri_lag head_yaw;
  sbri_body_steps steps;
  uint32_t foot_count, tail_bone_count;
  sbri_clip_layer clips[SBRI_CLIP_LAYERS];
  sbri_foot feet[SBRI_MAX_LEGS];
  /* In memory it is followed by tail_bone_count x {yaw, pitch} (sbri_lag, relative to the heading and the
   * level), chain_bone_count sbri_chain_bone, one sbri_spring_end per bone of a swinging chain, one
   * sbri_spring_clock per swinging chain, one sbri_limb_target per IK chain and one sbri_bone_follower per
   * follower. */
} sbri_gait_state;

/* State of one bone of a trailing chain. */
typedef struct sbri_chain_bone {
  sbr_transform frame; /* frame of the last pose, world axes */
  sbf_vec3 tip;        /* position of the bone's end */
  sbf_vec3 velocity;   /* of its head */
} sbri_chain_bone;

/* End of a swinging bone at the last two steps; relative to the spring's center bone if it has one. */
typedef struct sbri_spring_end {
  sbf_vec3 now, before;
} sbri_spring_end;

/* A swinging chain between its steps. */
typedef struct sbri_spring_clock {
  float pending_s;              /* time since the last step */
  sbr_transform anchor, center; /* first bone without swing, and center bone, in the last tick's pose */
} sbri_spring_clock;

/* Target of an IK chain, set by the host. */
typedef struct sbri_limb_target {
  sbf_vec3 position; /* relative to the origin */
  sbf_quat rotation;
  float weight; /* 0: none */
} sbri_limb_target;

typedef struct sbri_bone_follower {
  sbri_position_follower position; /* in the parent's frame, asset metres */
  sbri_rotation_follower turn;     /* against the parent */
  /* Squash followers: stretch along the bone's axis, now and in the previous tick. Their position is in world
   * axes, as for weight followers. */
  float stretch, stretch_before;
} sbri_bone_follower;

static inline sbri_lag *sbri_tail_lags(sbri_gait_state *state) {
  return (sbri_lag *)(void *)(state + 1);
}
static inline sbri_chain_bone *sbri_chain_bones(const sbri_rig *rig, sbri_gait_state *state) {
  return (sbri_chain_bone *)(void *)(sbri_tail_lags(state) + 2 * rig->tails.bone_count);
}
static inline sbri_spring_end *sbri_spring_ends(const sbri_rig *rig, sbri_gait_state *state) {
  return (sbri_spring_end *)(void *)(sbri_chain_bones(rig, state) + rig->chains.bone_count);
}
static inline sbri_spring_clock *sbri_spring_clocks(const sbri_rig *rig, sbri_gait_state *state) {
  return (sbri_spring_clock *)(void *)(sbri_spring_ends(rig, state) + rig->springs.chains.bone_count);
}
static inline sbri_limb_target *sbri_limb_targets(const sbri_rig *rig, sbri_gait_state *state) {
  return (sbri_limb_target *)(void *)(sbri_spring_clocks(rig, state) + rig->springs.chains.count);
}
static inline sbri_bone_follower *sbri_bone_followers(const sbri_rig *rig, sbri_gait_state *state) {
  return (sbri_bone_follower *)(void *)(sbri_limb_targets(rig, state) + rig->asset->ik_chains.count);
}

/* Rotates v from body to world heading; and back. */
static inline sbf_vec3 sbri_body_to_world(const sbri_gait_state *state, sbf_vec3 v) {
  float s = state->motion.heading_sine, c = state->motion.heading_cosine;
  return sbri_vec3(c * v.x + s * v.z, v.y, c * v.z - s * v.x);
}
static inline sbf_vec3 sbri_world_to_body(const sbri_gait_state *state, sbf_vec3 v) {
  float s = state->motion.heading_sine, c = state->motion.heading_cosine;
  return sbri_vec3(c * v.x - s * v.z, v.y, c * v.z + s * v.x);
}

/* ---- animation/gait/over_ground.c: turns, distances, the ground ---- */

/* Wraps an angle to (-pi, pi]. */
float sbri_wrap_angle(float angle);
/* Rotates v about +Y by `yaw`. */
sbf_vec3 sbri_rotate_yaw(sbf_vec3 v, float yaw);
/* Point of the ground above or below `position`; `normal` may be NULL. */
sbf_vec3 sbri_ground_below(const sbri_gait_input *input, sbf_vec3 position, sbf_vec3 *normal);
/* Horizontal distance of two points. */
float sbri_flat_distance(sbf_vec3 a, sbf_vec3 b);

/* ---- animation/gait/walls.c, moving_floor.c, fall.c: what colliders and the ground do to the body ---- */

/* Keeps the body out of walls while it moves from `from` to its present position and turns by `turned`.
 * Returns whether it hit any. */
bool sbri_walls_resolve(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, sbf_vec3 from, float turned);
/* Moves the body and its feet with the surfaces that they stand on. */
void sbri_move_with_surfaces(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input);
/* One tick of free fall. Returns false if the character stands; on landing, `falls` becomes 0. */
bool sbri_fall_tick(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input);
/* Stores the level of the ground that it stands on. */
void sbri_fall_store_level(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input);

/* ---- animation/gait/foot_faces.c: geometry of a foot on the ground ---- */

/* Updates what depends on a foot's heading and normal; and only what depends on the body's heading, for a
 * foot that does not move. */
void sbri_foot_update_orientation(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, uint32_t leg);
void sbri_foot_update_heading(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, uint32_t leg);

/* ---- animation/gait/stride.c: range and speed of feet ---- */

/* Hip height at the widest stride, as a fraction of the rest height. */
#define SBRI_LOWERED 0.9f
/* Maximum length of a step, in reaches. */
#define SBRI_WIDEST 1.7f

/* Horizontal circle within which a foot can stand: centre relative to its home, and radius. */
typedef struct sbri_foot_circle {
  sbf_vec3 center;
  float radius;
  float height;  /* of the hip above the ground at the home, m */
  sbf_vec3 rise; /* of the ground per metre in each direction; 0 where it does not matter */
} sbri_foot_circle;

/* A foot's home position relative to the body (horizontal), its velocity over the ground, and its circle. */
typedef struct sbri_home {
  sbf_vec3 arm, velocity;
  float speed;
  sbri_foot_circle circle;
} sbri_home;

/* Stride parameters of a tick, from the speed. */
typedef struct sbri_stride {
  float speed;       /* maximum speed of a home over the ground, m/s */
  float half_m;      /* a foot lands this far ahead of its home and lifts off this far behind */
  float duration_s;  /* duration of a step, s */
  float spacing_m;   /* distance between two lift-offs */
  float available_s; /* time for a step at the widest stride of group steps */
  bool in_groups;    /* feet of a group step together */
  bool balanced;     /* slow enough to slow down rather than lose balance */
  bool running;      /* many legs, too fast to wait for balance */
  bool even;         /* the ground is even here, ahead and behind */
  float max_half_m;  /* upper bound of half_m, mean over a stride */
  sbri_home homes[SBRI_MAX_LEGS];
} sbri_stride;
/* Whether planted feet and the targets of swinging feet are at about one height. */
bool sbri_are_feet_level(const sbri_rig *rig, const sbri_gait_state *state, float scale);

sbri_stride sbri_stride_of(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input);

/* A foot's home relative to the body, horizontal. */
sbf_vec3 sbri_home_arm(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input, uint32_t leg);
/* Velocity of a foot's home over the ground. */
sbf_vec3 sbri_home_velocity(const sbri_rig *rig, const sbri_gait_state *state, uint32_t leg, sbf_vec3 arm);
/* Maximum speed of a home in the requested motion, m/s. */
float sbri_wanted_speed(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input, const sbri_home *homes);
/* Hip position of a leg for a body at `root`, with the spine of the last pose. */
sbf_vec3 sbri_hip_of(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, const sbr_transform *root);
/* Velocity of the body, world axes. */
sbf_vec3 sbri_body_velocity(const sbri_gait_state *state);
/* Ankle position for a sole position, m; and the same with the body's heading. */
static inline sbf_vec3 sbri_ankle_over(
    const sbri_leg *leg, const sbri_foot *foot, sbf_vec3 sole, float scale) {
  return sbri_add(sbri_add_scaled(sole, foot->normal, leg->home.ankle.y * scale), foot->frame.ankle_offset);
}
static inline sbf_vec3 sbri_ankle_at_home(
    const sbri_leg *leg, const sbri_foot *foot, sbf_vec3 sole, float scale) {
  return sbri_add(
      sbri_add_scaled(sole, foot->normal, leg->home.ankle.y * scale), foot->frame.home_ankle_offset);
}
/* Circle within which a foot can stand at its present height. */
sbri_foot_circle sbri_foot_circle_of(const sbri_rig *rig, const sbri_gait_state *state,
    const sbri_gait_input *input, uint32_t leg, sbf_vec3 arm);
/* Distance ahead of its home at which a foot that moves along `direction` (unit) lands; `half` is half its
 * stride. */
float sbri_landing_distance(const sbri_foot_circle *circle, sbf_vec3 direction, float half);
/* Distance of a planted foot from its home as a fraction of the allowed distance. */
float sbri_home_distance_fraction(const sbri_gait_state *state, const sbri_home *home, uint32_t leg);
/* Distance that a leg's hip can move along a horizontal unit direction before the planted foot is out of
 * reach. */
float sbri_remaining_reach(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, sbf_vec3 direction);
/* Speed fraction at which the stance feet stay within reach for the given time while a leg swings. */
float sbri_sustainable_fraction(const sbri_rig *rig, const sbri_gait_state *state,
    const sbri_gait_input *input, uint32_t leg, float in_s);
/* Speed fraction that keeps every planted foot within reach; `sustainable` receives the fraction at which
 * they stay there until the swinging feet land. */
float sbri_max_speed_fraction(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input, float *sustainable);

/* ---- animation/gait/footing.c: where a foot may stand ---- */

/* Finds the best foothold near `wanted`; false if there is none and the foot should stay. */
bool sbri_find_foothold(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, sbf_vec3 wanted, sbf_vec3 *position, sbf_vec3 *normal);

/* Whether a foot can stand, or can stand well, at a position. */
bool sbri_can_stand(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, sbf_vec3 position, bool well);
/* Moves a sole onto the ground at `position` and tilts it to the slope, without penetration. */
void sbri_set_sole_on_ground(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, sbf_vec3 *position, sbf_vec3 *normal);

/* ---- animation/gait/support.c: balance ---- */

/* Whether the feet other than `lifted` (bits) support the body: its centre of mass is well inside their
 * support polygon, and still inside after moving by `direction`. */
bool sbri_is_supported(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t lifted, sbf_vec3 direction);
/* Sway from `position`, horizontal, for which the feet other than `lifted` support the body. */
sbf_vec3 sbri_find_sway(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t lifted, sbf_vec3 direction);

/* Horizontal offset from the rest pose that puts the body over its feet, asset metres. */
sbf_vec3 sbri_standing_offset(const sbri_rig *rig);

/* ---- animation/gait/step_plan.c: height and timing of a step ---- */

/* Plans the height and timing of a step. Motion that has begun does not change. */
void sbri_step_plan(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, uint32_t leg);
/* Estimate of the duration that the knee needs for the planned step, at least `wanted_s`. */
float sbri_step_duration(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, float wanted_s);

/* ---- animation/gait/swing.c: the path of a foot through the air ---- */

void sbri_swing_begin(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbri_stride *stride, uint32_t leg);
/* Moves a swinging foot by one tick. Returns true when it lands. */
bool sbri_swing_tick(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbri_stride *stride, uint32_t leg);

/* ---- animation/gait/feet.c: selection of the feet that step ---- */

/* Places a leg's foot on the ground at its home. */
void sbri_foot_put_down(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, uint32_t leg);

/* Pose of the body over its feet. */
typedef struct sbri_stance {
  sbr_transform root;        /* transform of the asset's origin and axes */
  float hips_yaw, chest_yaw; /* rad, relative to the heading */
  float hips_pitch;          /* rad about the left axis; above 0: nose down */
  float lowered;             /* lowering, m */
  bool spares_knees;         /* lowered less, to limit the knees' acceleration */
} sbri_stance;

/* Selects the feet that step, moves swinging feet and the body above them. Returns the number of events
 * written. */
uint32_t sbri_feet_tick(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    sbri_stance *stance, sbri_gait_event *events, uint32_t capacity);

/* ---- animation/gait/gait.c ---- */

/* Smooths the motion towards the command and moves the body, at most at the speed that the feet allow.
 * Returns the rotation, rad. */
float sbri_body_move(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input);
/* Puts every foot at its home, then the body, tails and chains above them. */
void sbri_body_stand(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input);

/* ---- animation/gait/body.c: the body over its feet ---- */

/* Updates `steps` if the tick length has changed. */
void sbri_body_steps_update(const sbri_rig *rig, sbri_gait_state *state, float tick_s);
sbri_stance sbri_body_stance(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input);
/* Additional lowering for which every leg reaches its foot from the present hip position. */
float sbri_body_drop(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    const sbr_transform *root);
/* Steps the followers of the body and returns its stance: it leans over the feet other than `lifting` (bits;
 * 0: upright) while it moves by `direction`. Without a stride the followers jump to their targets. */
sbri_stance sbri_body_tick(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbri_stride *stride, uint32_t lifting, sbf_vec3 direction);

/* ---- animation/gait/pose.c ---- */

/* How a pose advances time. */
typedef enum sbri_advance { SBRI_ADVANCE_TICK, SBRI_ADVANCE_NOT, SBRI_ADVANCE_RESET } sbri_advance;

/* Computes the whole pose: body, head, tails, chains, legs, limbs with targets, followers. Updates chains and
 * followers; with a reset they start at their targets. */
void sbri_body_pose(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    sbri_advance advance, sbr_transform *pose);

/* ---- animation/gait/clips.c ---- */

void sbri_clips_tick(const sbri_rig *rig, sbri_gait_state *state, float tick_s);
/* Whether a clip contributes to the pose. */
bool sbri_clips_play(const sbri_gait_state *state);
/* Writes every bone relative to its parent, before the gait: position in asset metres, rotation. */
void sbri_clips_pose(const sbri_rig *rig, const sbri_gait_state *state, float scale, sbr_transform *locals);

/* ---- animation/gait/walk_poses.c ---- */

/* `walked_m`: in this tick. */
void sbri_walk_tick(const sbri_rig *rig, sbri_gait_state *state, float walked_m, float scale);
void sbri_walk_pose(const sbri_rig *rig, const sbri_gait_state *state, float scale, sbr_transform *locals);

/* ---- animation/gait/knee.c ---- */

/* Knee angle, rad, for a distance of hip and ankle; and the inverse. */
float sbri_knee_angle(const sbri_leg *leg, float scale, float distance);
float sbri_knee_distance(const sbri_leg *leg, float scale, float angle);
/* Angle that a swinging knee reaches, from the angle that the foot's path requires. */
float sbri_knee_follow(const sbri_foot *foot, float wanted, float tick_s);
/* Range of the hip-ankle distance of a planted foot for which the knee's angular acceleration stays bounded
 * and the knee can stop where the leg is stretched to `full`, m. False if there is no bound. */
bool sbri_knee_range(const sbri_leg *leg, const sbri_foot *foot, const sbri_gait_input *input, float full,
    float *shortest, float *longest);
/* Stores the knee's angle and rate. */
void sbri_knee_store(sbri_foot *foot, float angle, float wanted, float tick_s);

/* ---- animation/gait/long_foot.c: of legs with a toe ---- */

/* Tilts the foot over its toe: returns the ankle's position; `leans` receives the rotation from the rest
 * pose. Updates the knee. */
sbf_vec3 sbri_long_foot_tilt(const sbri_leg *leg, sbri_foot *foot, sbf_vec3 hip, sbf_vec3 sole,
    sbf_vec3 ankle, const sbri_gait_input *input, sbri_advance advance, sbf_quat *leans);
/* Ankle relative to the middle of the sole, in the foot's pose. */
sbf_vec3 sbri_long_foot_over(
    const sbri_rig *rig, const sbri_leg *leg, const sbri_foot *foot, float scale, const sbr_transform *pose);
/* Transform of the toe for the foot's pose. */
sbr_transform sbri_long_foot_toe(
    const sbri_rig *rig, const sbri_leg *leg, const sbri_foot *foot, float scale, const sbr_transform *pose);

/* ---- animation/gait/limbs.c ---- */

/* Clamps a solved leg to its joint limits, as near to its foot as they allow. */
void sbri_leg_limit(const sbri_rig *rig, const sbri_leg *leg, sbf_vec3 ankle, sbf_vec3 pole, float scale,
    sbr_transform *pose);
/* Solves the IK chains that have targets. */
void sbri_limbs_reach(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbr_transform *root, sbr_transform *pose);

/* ---- animation/gait/trailing_chain.c, spring_chain.c, bone_follower.c ---- */

/* Vector from a bone's head to the next one at rest, in the bone's frame, with the chain's spacing. */
sbf_vec3 sbri_chain_step(const sbri_rig *rig, const sbf_chain *chain, uint32_t k, float scale);
/* Swinging chains: last, on the finished pose. */
void sbri_springs_pose(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    sbri_advance advance, sbr_transform *pose);
void sbri_springs_rebase(const sbri_rig *rig, sbri_gait_state *state, sbf_vec3 shift);

void sbri_chains_pose(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbr_transform *root, sbri_advance advance, sbr_transform *pose);
void sbri_followers_pose(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbr_transform *root, sbri_advance advance, sbr_transform *pose);

/* ---- animation/gait/squash.c: before the legs ---- */

void sbri_squashes_pose(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    sbri_advance advance, sbr_transform *pose);

/* ---- animation/gait/weight.c: before the legs ---- */

/* Applies weight followers; returns whether they moved a bone. */
bool sbri_weights_pose(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    sbri_advance advance, sbr_transform *pose);

/* ---- animation/gait/bone_follower.c ---- */

/* Rebases followers of world positions. */
void sbri_followers_rebase(const sbri_rig *rig, sbri_gait_state *state, sbf_vec3 shift);

/* ---- animation/gait/tail.c ---- */

/* Resets tails to the heading and the body's slope, clear of the ground. */
void sbri_tails_reset(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, const sbri_stance *stance);
/* Followers of the tails' bones: each follows the one before it, the first the hips, and all keep their ends
 * over the ground. */
void sbri_tails_tick(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbri_stance *stance, float turned_by);

#endif
