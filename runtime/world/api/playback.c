/* Playback of recordings: sbrun/record.h. */
#include <string.h>

#include "base/diagnostic.h"
#include "math/usable.h"
#include "sbrun/animation.h"
#include "sbrun/rigid.h"
#include "sbrun/soft_body.h"
#include "world/api/api.h"
#include "world/detail/choose.h"

static uint32_t u32_at(const unsigned char *from) {
  return from[0] | (uint32_t)from[1] << 8 | (uint32_t)from[2] << 16 | (uint32_t)from[3] << 24;
}

static double double_at(const unsigned char *from) {
  uint64_t bits = u32_at(from) | (uint64_t)u32_at(from + 4) << 32;
  double value;
  memcpy(&value, &bits, sizeof value);
  return value;
}

/* Bounds numbers of a file before they become integers. */
static uint32_t whole(double value) {
  return value >= 0 && value <= 4294967295.0 ? (uint32_t)value : UINT32_MAX;
}
static int32_t index_of(double value) {
  return value >= -1 && value <= 2147483647.0 ? (int32_t)value : -1;
}

static void check(sbr_replay *r, const double *n) {
  uint64_t hash = (uint64_t)whole(n[1]) << 32 | whole(n[2]);
  bool same = hash == sbr_world_get_state_hash(r->world) && (double)r->world->time.ticks == n[0];
  r->checks++;
  if (same || r->differs) return;
  r->differs = true;
  r->differs_at_tick = r->world->time.ticks;
}

static void play_view(sbr_world *world, const double *n) {
  const sbr_view view = {
      {n[2], n[3], n[4]}, {(float)n[5], (float)n[6], (float)n[7]}, (float)n[8], (float)n[9], (float)n[10]};
  sbri_view_set(world, whole(n[0]), whole(n[1]), &view);
}

static void play_rigid(sbr_world *world, sbri_recorded what, sbr_character_id id, const double *n) {
  sbr_rigid_drive drive = sbr_default_rigid_drive();
  drive.frequency_hz = (float)n[1], drive.damping_ratio = (float)n[2], drive.strength = (float)n[3];
  drive.joint_damping_1_s = (float)n[4], drive.joint_friction = (float)n[5];
  sbr_fall_definition fall = sbr_default_fall_definition();
  fall.drive_fraction = (float)n[1], fall.rest_s = (float)n[2], fall.rise_s = (float)n[3];
  if (what == SBRI_RECORDED_RIGID_MODE)
    sbr_character_set_rigid_mode(world, id, index_of(n[1]), (sbr_rigid_mode)whole(n[2]));
  else if (what == SBRI_RECORDED_RIGID_DRIVE)
    sbr_character_set_rigid_drive(world, id, &drive);
  else if (what == SBRI_RECORDED_RIGID_FRACTION)
    sbr_character_set_rigid_drive_fraction(world, id, index_of(n[1]), (float)n[2]);
  else if (what == SBRI_RECORDED_RIGID_FALL)
    sbr_character_knock_over(world, id, &fall);
  else
    sbr_character_apply_rigid_impulse(world, id, whole(n[1]), (sbr_double3){n[2], n[3], n[4]},
        (sbf_vec3){(float)n[5], (float)n[6], (float)n[7]});
}

static sbf_vec3 vec3_at(const double *n) {
  return (sbf_vec3){(float)n[0], (float)n[1], (float)n[2]};
}

/* Returns false for other calls. A call that failed while it was recorded fails again. */
static bool play_soft(sbr_world *world, sbri_recorded what, sbr_character_id id, const double *n) {
  uint32_t body = whole(n[1]), vertex = whole(n[2]);
  sbr_vertex_grab grab = sbr_default_vertex_grab();
  grab.target = (sbr_double3){n[3], n[4], n[5]};
  grab.frequency_hz = (float)n[6], grab.damping_ratio = (float)n[7], grab.max_force = (float)n[8];
  if (what == SBRI_RECORDED_SOFT_VELOCITY)
    (void)sbr_character_set_soft_velocity(world, id, body, vec3_at(n + 2), vec3_at(n + 5), NULL);
  else if (what == SBRI_RECORDED_SOFT_IMPULSE)
    (void)sbr_character_apply_soft_impulse(world, id, body, vertex, vec3_at(n + 3), NULL);
  else if (what == SBRI_RECORDED_SOFT_FORCE)
    (void)sbr_character_apply_soft_force(world, id, body, vertex, vec3_at(n + 3), (float)n[6], NULL);
  else if (what == SBRI_RECORDED_SOFT_HOLD)
    (void)sbr_character_grab_vertex(world, id, body, vertex, &grab, NULL);
  else if (what == SBRI_RECORDED_SOFT_RELEASE)
    (void)sbr_character_release_vertex(world, id, body, vertex);
  else
    return false;
  return true;
}

/* `n` is padded with zeros. */
static void play(sbr_replay *r, sbri_recorded what, const double *n) {
  sbr_character_id id = {whole(n[0])};
  sbr_ik_target target = sbr_default_ik_target();
  target.position = (sbr_double3){n[2], n[3], n[4]};
  target.rotation = (sbf_quat){(float)n[5], (float)n[6], (float)n[7], (float)n[8]};
  target.weight = (float)n[9];
  sbr_clip_play how = sbr_default_clip_play();
  how.weight = (float)n[3], how.fade_s = (float)n[4], how.speed = (float)n[5], how.start_s = (float)n[6];
  how.bone_mask = index_of(n[7]);
  switch (what) {
  case SBRI_RECORDED_HASH:
    check(r, n);
    break;
  case SBRI_RECORDED_STEP:
    r->frame_s = n[0];
    sbr_world_step(r->world, n[0]);
    break;
  case SBRI_RECORDED_TICK:
    r->frame_s = r->world->time.tick_s;
    sbr_world_tick(r->world);
    break;
  case SBRI_RECORDED_DESTROY:
    sbr_character_destroy(r->world, id);
    break;
  case SBRI_RECORDED_DRIVE:
    sbr_character_set_drive(r->world, id, (float)n[1], (float)n[2], (float)n[3]);
    break;
  case SBRI_RECORDED_VERTICAL:
    sbr_character_set_vertical_speed(r->world, id, (float)n[1]);
    break;
  case SBRI_RECORDED_DISPLACE:
    sbr_character_displace(r->world, id, vec3_at(n + 1), (float)n[4]);
    break;
  case SBRI_RECORDED_TELEPORT:
    sbr_character_teleport(r->world, id, (sbr_double3){n[1], n[2], n[3]}, (float)n[4]);
    break;
  case SBRI_RECORDED_RESET:
    sbr_character_reset(r->world, id);
    break;
  case SBRI_RECORDED_WAKE:
    sbr_character_wake(r->world, id);
    break;
  case SBRI_RECORDED_PAUSE:
    sbr_character_set_paused(r->world, id, n[1] != 0);
    break;
  case SBRI_RECORDED_REACH:
    sbr_character_set_ik_target(r->world, id, whole(n[1]), &target);
    break;
  case SBRI_RECORDED_RELEASE:
    sbr_character_set_ik_target(r->world, id, whole(n[1]), NULL);
    break;
  case SBRI_RECORDED_PIVOT:
    sbr_character_set_pivot_leg(r->world, id, index_of(n[1]));
    break;
  case SBRI_RECORDED_PLAY:
    sbr_character_play_clip(r->world, id, whole(n[1]), index_of(n[2]), &how);
    break;
  case SBRI_RECORDED_DETAIL_LEVEL:
    sbr_character_set_detail_level(r->world, id, whole(n[1]));
    break;
  case SBRI_RECORDED_VISIBILITY:
    sbr_character_set_visibility(r->world, id, (sbr_visibility)whole(n[1]));
    break;
  case SBRI_RECORDED_VIEW:
    play_view(r->world, n);
    break;
  default:
    if (!play_soft(r->world, what, id, n)) play_rigid(r->world, what, id, n);
    break;
  }
}

/* The next complete record: returns its size, 0 if there is none or (`bad`) it is invalid. */
static size_t read(
    const sbr_replay *r, size_t size, uint32_t *what, double numbers[SBRI_RECORDED_MAX], bool *bad) {
  const unsigned char *from = r->bytes + r->at;
  size_t left = size - r->at;
  *bad = false;
  memset(numbers, 0, SBRI_RECORDED_MAX * sizeof *numbers);
  if (left < SBRI_RECORDED_HEADER_BYTES) return 0;
  *what = u32_at(from);
  uint32_t count = u32_at(from + 4);
  *bad = *what >= SBRI_RECORDED_COUNT || count != sbri_recorded_count(*what);
  if (*bad || left < SBRI_RECORDED_HEADER_BYTES + (size_t)count * SBRI_RECORDED_NUMBER_BYTES) return 0;
  for (uint32_t i = 0; i < count; i++) {
    numbers[i] = double_at(from + SBRI_RECORDED_HEADER_BYTES + i * SBRI_RECORDED_NUMBER_BYTES);
    *bad = *bad || !sbri_usable(&numbers[i], 1);
  }
  return *bad ? 0 : SBRI_RECORDED_HEADER_BYTES + (size_t)count * SBRI_RECORDED_NUMBER_BYTES;
}

static bool steps(uint32_t what) {
  return what == SBRI_RECORDED_STEP || what == SBRI_RECORDED_TICK;
}

/* Plays the hashes that come next. */
static void play_hashes(sbr_replay *r) {
  double numbers[SBRI_RECORDED_MAX];
  uint32_t what;
  bool bad;
  for (size_t size; (size = read(r, r->size, &what, numbers, &bad)) > 0 && what == SBRI_RECORDED_HASH;
       r->at += size)
    check(r, numbers);
}

sbf_status sbr_replay_begin(
    sbr_replay *replay, sbr_world *world, const void *bytes, size_t size, sbf_diagnostic *error) {
  if (!replay || !world || !bytes)
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL, "sbr_replay_begin: NULL argument");
  sbr_replay r = {.world = world, .bytes = bytes, .at = SBRI_RECORDING_MAGIC_BYTES};
  double numbers[SBRI_RECORDED_MAX];
  uint32_t what = 0;
  bool bad = false;
  *replay = (sbr_replay){.world = world, .bytes = bytes};
  if (size < SBRI_RECORDING_MAGIC_BYTES ||
      memcmp(bytes, SBRI_RECORDING_MAGIC, SBRI_RECORDING_MAGIC_BYTES) != 0)
    return sbfi_diagnose(error, SBF_CODE_IO_UNKNOWN_FORMAT, "this is not a recording: its header is missing");
  for (size_t step; (step = read(&r, size, &what, numbers, &bad)) > 0; r.at += step) {
    if (what == SBRI_RECORDED_MADE)
      return sbfi_diagnose(error, SBF_CODE_INDEX_OUT_OF_RANGE,
          "characters were created during the recording, at byte %zu: create all before it begins", r.at);
    r.frame_count += steps(what);
  }
  if (bad)
    return sbfi_diagnose(error, SBF_CODE_IO_UNKNOWN_FORMAT, "the recording is damaged at byte %zu", r.at);
  r.size = r.at, r.at = SBRI_RECORDING_MAGIC_BYTES;
  *replay = r;
  play_hashes(replay);
  return SBF_OK;
}

bool sbr_replay_step(sbr_replay *r) {
  double numbers[SBRI_RECORDED_MAX];
  uint32_t what = 0;
  bool bad;
  for (size_t size; r && (size = read(r, r->size, &what, numbers, &bad)) > 0;) {
    r->at += size;
    play(r, (sbri_recorded)what, numbers);
    if (!steps(what)) continue;
    r->frames++;
    play_hashes(r);
    return true;
  }
  return false;
}
