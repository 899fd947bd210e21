/* State of the animation layer, plain data: the body's motion, its feet, its head and tails. Places are
 * relative to the character's origin, world axes, metres as scaled. */
#ifndef SBRI_GAIT_STATE_H
#define SBRI_GAIT_STATE_H

#include "gait/gait.h"
#include "gait/glide.h"
#include "math/follower.h"

typedef struct sbri_foot {
  sbf_vec3 ground; /* where the sole stands, or the place below it on the line of its step */
  sbf_vec3 normal; /* of the ground there, eased while it swings */
  float heading;   /* the foot's own, rad, less the body's: kept as the body turns */
  /* Of `normal` and `heading`, by sbri_foot_faces: its own heading in the world; and how far the ankle is
   * from above the sole's middle, as it is turned, and were it turned as the body is. */
  float sine, cosine;
  sbf_vec3 beside, beside_at_home;
  sbf_quat tilt, turned;                     /* as the ground is; from how it stands at rest */
  float lift;                                /* of the sole above `ground`, m */
  sbf_vec3 from, from_normal, to, to_normal; /* of the step under way */
  sbf_vec3 planned;                          /* `to` when it was last planned */
  float phase;                               /* 0..1 of it */
  float duration_s;
  float lasting;                                      /* pace that the feet that stand could last for then */
  float clearance;                                    /* greatest lift, m */
  float leaves, arrives;                              /* phases between which it moves over the ground */
  float climbs, climbed;                              /* the same of the height between its places */
  sbri_glide x, z, base, rise, tilt_x, tilt_z, twist; /* of `ground`, `lift`, `normal`, `heading` */
  sbf_vec3 hip;  /* where its leg begins, as last posed: from the root, in its axes; m */
  sbf_vec3 pole; /* that its knee points to, as last posed */
  float missed;  /* how far its sole is from its place then, for its leg's limits; m */
  /* Of the knee, rad, as last posed, straight: pi; how fast it turned, rad/s; what the foot's way asked of
   * it; and what it was held at, 0: nothing. */
  float knee, knee_rate, knee_wanted, knee_held;
  uint32_t knee_known;           /* ticks that this is known of, up to 2 */
  uint32_t planted, was_planted; /* 1 or 0: now, and a tick ago */
  uint32_t steps_taken;
} sbri_foot;

/* A clip that plays, or none. */
enum { SBRI_CLIP_LAYERS = 4 };
typedef struct sbri_clip_layer {
  uint32_t clip_plus_1, mask_plus_1; /* 0: none */
  float time_s, speed, weight, wanted, fade_s;
} sbri_clip_layer;

/* What a tick of a given length does to what follows in the body: kept, since ticks are of one length. */
typedef struct sbri_body_steps {
  float tick_s; /* 0: not known yet */
  sbri_follower_step lean, bend, upright, crouch, head;
} sbri_body_steps;

typedef struct sbri_gait_state {
  sbf_vec3 position; /* where the asset's origin stands; y: how far all is raised above the ground */
  float heading;     /* rad, in (-pi, pi] */
  float heading_sine, heading_cosine;
  float forward, sideways, turn; /* eased, m/s and rad/s */
  float pace;                    /* share of them that the feet allow, 0 to 1 */
  float standing_s;              /* since it stopped moving; 0 while it moves */
  float limit;                   /* share of the wanted motion that its steps have time for, 0 to 1 */
  float needed_s;                /* time that steps needed lately */
  float half_m;                  /* half a stride */
  float widest_m;                /* the widest it may be, on average over a stride; 0: not known */
  float since_lift_m;            /* travelled since a foot lifted off */
  float waiting_s;               /* for how long a foot has wanted to step and could not */
  uint32_t together;             /* 1: feet of a group go together; 0: as many as balance allows */
  uint32_t pivot;                /* leg that it turns about, plus 1; 0: none */
  uint32_t next;                 /* leg that is to lift next, for which it leans, plus 1; 0: none */
  sbf_vec3 stands;               /* by how much it stands off its rest pose to be over its feet, level; m */
  sbri_lag sway_x, sway_z;       /* of the body over its feet, world axes, m */
  sbri_lag crouch;               /* how far it comes down for its feet, m */
  sbri_lag upright;              /* 1: the body tilts about its hips, balanced; 0: about the ground */
  sbri_lag room;                 /* how far it may, its belly off the ground, m; below 0: it has to rise */
  sbri_lag bent;                 /* 0: legs may be as straight as at rest; 1: they have bent for walking */
  sbf_vec3 center;               /* of mass, from `position`, without the sway; last tick's */
  sbr_transform root;            /* of the last stance, and its turns */
  float hips_yaw, hips_pitch, chest_yaw;
  float lowered;      /* by how much the root is lower than over upright legs, m */
  float rise;         /* of the root in the last tick, m/s */
  float level;        /* of what it stands on, or would fall on, from the origin; m */
  float fall_speed;   /* m/s, downwards */
  uint32_t falls;     /* 1: it is in the air */
  uint32_t displaced; /* 1: its host moved it in this tick; it stops when that does */
  uint32_t eased;     /* 1: not lowered as its feet would have it, for its knees */
  double distance_m;
  float walk_phase; /* of the walks of poses: share of the cycle, from 0 to below 1 */
  float walk_ahead; /* by how much of a cycle that is ahead of the feet, as far as it is to be made up */
  float walk_half_m,
      walk_since_m;     /* asset metres: between the last two landings; 0: not known; since the last */
  uint32_t walk_landed; /* 1, 2: which of the two legs came down last; 0: none */
  sbri_lag head_yaw;
  sbri_body_steps steps;
  uint32_t foot_count, tail_bone_count;
  sbri_clip_layer clips[SBRI_CLIP_LAYERS];
  sbri_foot feet[SBRI_MAX_LEGS];
  /* Behind it: tail_bone_count x {yaw, pitch} as sbri_lag, from the body's heading and the level;
   * chain_bone_count sbri_chain_bone; a sbri_limb_target for each IK chain; a sbri_bone_follower for each
   * follower. */
} sbri_gait_state;

/* A bone of a chain. */
typedef struct sbri_chain_bone {
  sbr_transform frame; /* world axes, as it was last posed */
  sbf_vec3 tip;        /* where the next one begins */
  sbf_vec3 velocity;   /* of its head */
} sbri_chain_bone;

/* What a host asks of an IK chain. */
typedef struct sbri_limb_target {
  sbf_vec3 position; /* relative to the origin */
  sbf_quat rotation;
  float weight; /* 0: none */
} sbri_limb_target;

typedef struct sbri_bone_follower {
  sbri_place_follower place; /* in the parent's frame, asset metres */
  sbri_turn_follower turn;   /* against the parent */
  /* Of a squash, whose `place` is in world axes as that of a weight is: along the bone's axis, now and a tick
   * ago. */
  float stretch, stretch_before;
} sbri_bone_follower;

static inline sbri_lag *sbri_tail_lags(sbri_gait_state *state) {
  return (sbri_lag *)(void *)(state + 1);
}
static inline sbri_chain_bone *sbri_chain_bones(const sbri_rig *rig, sbri_gait_state *state) {
  return (sbri_chain_bone *)(void *)(sbri_tail_lags(state) + 2 * rig->tail_bone_count);
}
static inline sbri_limb_target *sbri_limb_targets(const sbri_rig *rig, sbri_gait_state *state) {
  return (sbri_limb_target *)(void *)(sbri_chain_bones(rig, state) + rig->chain_bone_count);
}
static inline sbri_bone_follower *sbri_bone_followers(const sbri_rig *rig, sbri_gait_state *state) {
  return (sbri_bone_follower *)(void *)(sbri_limb_targets(rig, state) + rig->asset->ik_chains.count);
}

/* `v` turned as the body is; and back. */
static inline sbf_vec3 sbri_headed(const sbri_gait_state *state, sbf_vec3 v) {
  float s = state->heading_sine, c = state->heading_cosine;
  return sbri_vec3(c * v.x + s * v.z, v.y, c * v.z - s * v.x);
}
static inline sbf_vec3 sbri_unheaded(const sbri_gait_state *state, sbf_vec3 v) {
  float s = state->heading_sine, c = state->heading_cosine;
  return sbri_vec3(c * v.x - s * v.z, v.y, c * v.z + s * v.x);
}

/* ---- gait/over_ground.c: turns, distances, the ground ---- */

/* An angle brought into (-pi, pi]. */
float sbri_wrap_angle(float angle);
/* `v` turned about +Y. */
sbf_vec3 sbri_turned(sbf_vec3 v, float yaw);
/* The place on the ground above or below `place`; `normal` may be NULL. */
sbf_vec3 sbri_ground_below(const sbri_gait_input *input, sbf_vec3 place, sbf_vec3 *normal);
/* Between two places as seen from above. */
float sbri_flat_distance(sbf_vec3 a, sbf_vec3 b);

/* ---- gait/walls.c, carried_along.c, fall.c: what colliders and the ground do to the body ---- */

/* Keeps the body out of walls on its way from `from` to where it is, on which it turned by `turned`; true
 * where some were in the way. */
bool sbri_walls_keep_out(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, sbf_vec3 from, float turned);
/* Moves the body and its feet as what they stand on moves in this tick. */
void sbri_carry_along(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input);
/* A tick in the air, if it is there: true, and its feet need none; it has landed where `falls` is 0 then. */
bool sbri_fall_tick(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input);
/* Keeps the level that it stands on. */
void sbri_fall_note_level(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input);

/* ---- gait/foot_faces.c: how a foot stands ---- */

/* Keeps up what follows from a foot's heading and its normal; and what of it follows from the body's heading
 * alone, where a foot stays as it is. */
void sbri_foot_faces(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, uint32_t leg);
void sbri_foot_home_faces(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, uint32_t leg);

/* ---- gait/stride.c: how far feet go, and how fast ---- */

/* Share of the hips' height that a body keeps in its widest strides. */
#define SBRI_LOWERED 0.9f

/* A circle over the ground that a foot may be in: where its home is from the middle, level, and its radius.
 */
typedef struct sbri_roam {
  sbf_vec3 off;
  float radius;
} sbri_roam;

/* A foot's home: from the body's place, level; how fast that goes over the ground; and what is about it. */
typedef struct sbri_home {
  sbf_vec3 arm, velocity;
  float speed;
  sbri_roam roam;
} sbri_home;

/* What follows from the speed, for all feet of a tick. */
typedef struct sbri_stride {
  float speed;       /* of the fastest home over the ground, m/s */
  float half_m;      /* a foot comes down so far ahead of its home, and lifts off so far behind */
  float duration_s;  /* of a step */
  float spacing_m;   /* between two lift-offs */
  float available_s; /* for a step, when feet of a group go together as wide as they can */
  bool together;     /* feet of a group go together */
  bool balanced;     /* so slow that it goes slower rather than out of balance */
  float widest_m;    /* greatest half_m, on average over a stride */
  sbri_home homes[SBRI_MAX_LEGS];
} sbri_stride;
sbri_stride sbri_stride_of(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input);

/* A foot's home relative to the body's place, level. */
sbf_vec3 sbri_home_arm(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input, uint32_t leg);
/* Velocity of a foot's home over the ground. */
sbf_vec3 sbri_home_velocity(const sbri_rig *rig, const sbri_gait_state *state, uint32_t leg, sbf_vec3 arm);
/* Speed of the fastest home in the motion that is wanted. */
float sbri_wanted_speed(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input, const sbri_home *homes);
/* Where a leg's upper bone begins when the body stands at `root`, its spine as it was last posed. */
sbf_vec3 sbri_hip_of(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, const sbr_transform *root);
/* Velocity of the body, world axes. */
sbf_vec3 sbri_body_velocity(const sbri_gait_state *state);
/* Where a foot's ankle is when the middle of its sole is at a place, m; and the same, turned as the body is.
 */
static inline sbf_vec3 sbri_ankle_over(
    const sbri_leg *leg, const sbri_foot *foot, sbf_vec3 sole, float scale) {
  return sbri_add(sbri_add_scaled(sole, foot->normal, leg->ankle.y * scale), foot->beside);
}
static inline sbf_vec3 sbri_ankle_at_home(
    const sbri_leg *leg, const sbri_foot *foot, sbf_vec3 sole, float scale) {
  return sbri_add(sbri_add_scaled(sole, foot->normal, leg->ankle.y * scale), foot->beside_at_home);
}
/* The circle that a foot may roam in as high as it is. */
sbri_roam sbri_roam_of(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, sbf_vec3 arm);
/* How far ahead of its home a foot comes down, which moves along `way` (of unit length); `half` is half its
 * stride. */
float sbri_ahead(const sbri_roam *roam, sbf_vec3 way, float half);
/* How far a planted foot is from its home, in shares of how far it may be. */
float sbri_strain(const sbri_gait_state *state, const sbri_home *home, uint32_t leg);
/* How far a leg's hip may go along a level way (of unit length) before its foot, where it stands, is at the
 * end of its reach. */
float sbri_way_left(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, sbf_vec3 way);
/* Share of the wanted motion at which the feet that stand while a leg is in the air stay within their reach
 * for so long. */
float sbri_lasting(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, float in_s);
/* Share of the wanted motion that leaves every planted foot within its reach; `lasting` receives that at
 * which they stay so until the feet in the air are down. */
float sbri_pace_of(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input, float *lasting);

/* ---- gait/footing.c: where a foot may stand ---- */

/* The best place near `wanted`; false where there is none and the foot had better stay. */
bool sbri_footing(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, sbf_vec3 wanted, sbf_vec3 *place, sbf_vec3 *normal);

/* Whether a foot can stand at a place, or stands there well. */
bool sbri_stands(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, sbf_vec3 place, bool well);
/* Puts a sole on the ground at `place`, tilted as the ground is and nowhere inside it. */
void sbri_lay_sole(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, sbf_vec3 *place, sbf_vec3 *normal);

/* ---- gait/support.c: balance ---- */

/* Whether feet but those of `lifted` (bits) bear the body: its centre of mass is well inside what they stand
 * on, and still inside `way` further. */
bool sbri_support_bears(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t lifted, sbf_vec3 way);
/* Where the body should lean so that the feet but those of `lifted` bear it, from `position`, level. */
sbf_vec3 sbri_support_sway(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t lifted, sbf_vec3 way);

/* By how much a body has to be off its rest pose to stand over its feet, asset space, level; m. */
sbf_vec3 sbri_support_stand(const sbri_rig *rig);

/* ---- gait/step_plan.c: a step before it goes ---- */

/* How high the step goes, and when over the ground; what it has begun with stays. */
void sbri_step_plan(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, uint32_t leg);
/* About how long the leg's knee needs for the step as planned, `wanted_s` being what it is asked for. */
float sbri_step_time(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, float wanted_s);

/* ---- gait/swing.c: the way of a foot through the air ---- */

void sbri_swing_begin(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbri_stride *stride, uint32_t leg);
/* True when it comes down. */
bool sbri_swing_tick(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbri_stride *stride, uint32_t leg);

/* ---- gait/feet.c: who steps ---- */

/* Puts a leg's foot down at its home. */
void sbri_foot_place(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, uint32_t leg);

/* How the body stands over its feet. */
typedef struct sbri_stance {
  sbr_transform root;        /* where the asset's origin and axes have gone */
  float hips_yaw, chest_yaw; /* rad, relative to the heading */
  float hips_pitch;          /* rad, about the left axis, from the level: above 0 where it goes down */
  float lowered;             /* how far it has come down for its feet, m */
  bool eased;                /* not as far as it would for them: for its knees */
} sbri_stance;

/* Decides who steps, moves the feet in the air, and the body over all of them; returns how many events were
 * written. */
uint32_t sbri_feet_tick(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    sbri_stance *stance, sbri_gait_event *events, uint32_t capacity);

/* ---- gait/gait.c ---- */

/* Eases the motion towards what is wanted and moves the body on, as fast as the feet allow. Returns the turn
 * made. */
float sbri_body_move(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input);
/* Every foot at its home, body, tails and chains as they are over these. */
void sbri_body_stand(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input);

/* ---- gait/body.c: the body over its feet ---- */

/* Keeps `steps` up to the length of the ticks. */
void sbri_body_steps_keep(const sbri_rig *rig, sbri_gait_state *state, float tick_s);
sbri_stance sbri_body_stance(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input);
/* By how much more it has to come down for every leg to reach its foot from where its hip is now. */
float sbri_body_drop(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    const sbr_transform *root);
/* Moves the followers that bear the body, and says how it then stands: it leans over the feet but `lifting`
 * (bits; 0: upright), while it goes `way` further. Without a stride it is put where they lead to. */
sbri_stance sbri_body_tick(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbri_stride *stride, uint32_t lifting, sbf_vec3 way);

/* ---- gait/pose.c ---- */

/* How far time goes on with a pose. */
typedef enum sbri_advance { SBRI_ADVANCE_TICK, SBRI_ADVANCE_NOT, SBRI_ADVANCE_RESET } sbri_advance;

/* The whole pose: body, head, tails, chains, legs, limbs with targets, followers. The state changes in what
 * lags: chains and followers; with a reset they begin where they are led. */
void sbri_body_pose(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    sbri_advance advance, sbr_transform *pose);

/* ---- gait/clips.c ---- */

void sbri_clips_tick(const sbri_rig *rig, sbri_gait_state *state, float tick_s);
/* Every bone against its parent before the gait: place in asset metres, rotation. */
/* Whether some clip weighs in the pose. */
bool sbri_clips_play(const sbri_gait_state *state);
void sbri_clips_pose(const sbri_rig *rig, const sbri_gait_state *state, float scale, sbr_transform *locals);

/* ---- gait/walk_poses.c ---- */

/* `walked_m`: in this tick. */
void sbri_walk_tick(const sbri_rig *rig, sbri_gait_state *state, float walked_m, float scale);
void sbri_walk_pose(const sbri_rig *rig, const sbri_gait_state *state, float scale, sbr_transform *locals);

/* ---- gait/knee.c ---- */

/* The angle between thigh and shin, rad, with hip and ankle at a distance; and back. */
float sbri_knee_angle(const sbri_leg *leg, float scale, float distance);
float sbri_knee_distance(const sbri_leg *leg, float scale, float angle);
/* What a knee in the air gets to of the angle that its foot's way asks for. */
float sbri_knee_follow(const sbri_foot *foot, float wanted, float tick_s);
/* How near to the hip, and how far from it, a planted ankle may be in a tick for its knee to turn no more
 * abruptly, and to be able to stop where the leg is stretched to `full`; m. False where that is not in doubt.
 */
bool sbri_knee_range(const sbri_leg *leg, const sbri_foot *foot, const sbri_gait_input *input, float full,
    float *shortest, float *longest);
/* Notes what it has come to. */
void sbri_knee_keep(sbri_foot *foot, float angle, float wanted, float tick_s);

/* ---- gait/long_foot.c: of legs with a toe ---- */

/* Leans the foot over its toe: where its ankle goes instead of to where it would be upright; `leans` receives
 * how it is turned from its rest then. Keeps its knee. */
sbf_vec3 sbri_long_foot_lean(const sbri_leg *leg, sbri_foot *foot, sbf_vec3 hip, sbf_vec3 sole,
    sbf_vec3 ankle, const sbri_gait_input *input, sbri_advance advance, sbf_quat *leans);
/* Where the ankle is from the middle of the sole, as the foot is posed. */
sbf_vec3 sbri_long_foot_over(
    const sbri_rig *rig, const sbri_leg *leg, const sbri_foot *foot, float scale, const sbr_transform *pose);
/* How the toe stands before the foot as that is posed. */
sbr_transform sbri_long_foot_toe(
    const sbri_rig *rig, const sbri_leg *leg, const sbri_foot *foot, float scale, const sbr_transform *pose);

/* ---- gait/limbs.c ---- */

/* Keeps a solved leg within its limits, as near to its foot as they allow. */
void sbri_leg_limit(const sbri_rig *rig, const sbri_leg *leg, sbf_vec3 ankle, sbf_vec3 pole, float scale,
    sbr_transform *pose);
/* Moves the limbs that the host has given targets. */
void sbri_limbs_reach(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbr_transform *root, sbr_transform *pose);

/* ---- gait/trailing_chain.c, gait/bone_follower.c ---- */

void sbri_chains_pose(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbr_transform *root, sbri_advance advance, sbr_transform *pose);
void sbri_followers_pose(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbr_transform *root, sbri_advance advance, sbr_transform *pose);

/* ---- gait/squash.c: before the legs ---- */

void sbri_squashes_pose(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    sbri_advance advance, sbr_transform *pose);

/* ---- gait/weight.c: before the legs ---- */

/* True where a bone is elsewhere for it. */
bool sbri_weights_pose(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    sbri_advance advance, sbr_transform *pose);

/* ---- gait/bone_follower.c ---- */

/* Of those that follow places in the world. */
void sbri_followers_rebase(const sbri_rig *rig, sbri_gait_state *state, sbf_vec3 shift);

/* ---- gait/tail.c ---- */

/* Tails begin along the heading, as steep as the body. */
void sbri_tails_place(const sbri_rig *rig, sbri_gait_state *state, const sbri_stance *stance);
/* Followers of the tails' bones: each goes after the one before it, the first after the hips. */
void sbri_tails_tick(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_stance *stance, float turned_by, float tick_s);

#endif
