#include "session.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "output_name.h"
#include "sbrun/animation.h"
#include "sbrun/collision.h"
#include "sbrun/rigid.h"
#include "standing.h"

/* A clip begins in another pose than the rest pose: time to blend. */
static const float CLIP_FADE_S = 0.5f;

/* Numbers separated by commas; false unless there are `count`. */
static bool parse_numbers(const char *text, int count, double *numbers) {
  for (int i = 0; i < count; i++) {
    char *end;
    numbers[i] = strtod(text, &end);
    if (end == text || !isfinite(numbers[i]) || *end != (i + 1 < count ? ',' : 0)) return false;
    text = end + 1;
  }
  return true;
}

static bool parse_ground(cli_call *call, sbr_ground *ground) {
  const char *text = cli_value(call, "--ground");
  double n[2];
  *ground = sbr_ground_flat(0);
  if (!text || strcmp(text, "flat") == 0) return true;
  if (strncmp(text, "slope:", 6) == 0 && parse_numbers(text + 6, 1, n) && fabs(n[0]) <= 45)
    *ground = sbr_ground_slope(n[0]);
  else if (strncmp(text, "stairs:", 7) == 0 && parse_numbers(text + 7, 2, n) && n[0] >= 0 && n[1] > 0)
    *ground = sbr_ground_stairs(n[0], n[1]);
  else if (strncmp(text, "noise:", 6) == 0 && parse_numbers(text + 6, 2, n) && n[0] >= 0 && n[1] >= 0)
    *ground = sbr_ground_noise(n[0], (uint32_t)n[1]);
  else {
    cli_wrong(call,
        "--ground takes flat, slope:DEGREES (-45 to 45), stairs:RISE,RUN or noise:HEIGHT,SEED in metres, not "
        "'%s'",
        text);
    return false;
  }
  return true;
}

static bool parse_drive(cli_call *call, double drive[3]) {
  const char *text = cli_value(call, "--drive");
  drive[0] = drive[1] = drive[2] = 0;
  if (!text || parse_numbers(text, 2, drive)) return true;
  if (parse_numbers(text, 3, drive)) return true;
  cli_wrong(call,
      "--drive takes a speed, a turn rate and for swimmers and fliers a vertical speed, as M/S,RAD/S[,UP], "
      "for example 0.5,0.2, not '%s'",
      text);
  return false;
}

static bool parse_scheme(cli_call *call, sbf_scheme *scheme) {
  const char *names[SBF_SCHEME_COUNT];
  int chosen = SBF_SCHEME_AUTOMATIC;
  for (int i = 0; i < SBF_SCHEME_COUNT; i++) names[i] = sbf_scheme_name((sbf_scheme)i);
  if (!cli_word(call, "--scheme", names, SBF_SCHEME_COUNT, &chosen)) return false;
  *scheme = (sbf_scheme)chosen;
  return true;
}

static bool parse_instructions(cli_call *call, sbr_instructions *instructions) {
  enum { COUNT = SBR_INSTRUCTIONS_WASM_SIMD128 + 1 };
  const char *names[COUNT];
  int chosen = SBR_INSTRUCTIONS_AUTOMATIC;
  for (int i = 0; i < COUNT; i++) names[i] = sbr_instructions_get_name((sbr_instructions)i);
  if (!cli_word(call, "--instructions", names, COUNT, &chosen)) return false;
  *instructions = (sbr_instructions)chosen;
  return true;
}

/* By name or id, else by number from 0; SBF_NONE if there is no such clip. */
static int32_t find_clip(const sbf_asset *asset, const char *text) {
  for (uint32_t i = 0; i < asset->clips.count; i++)
    if (strcmp(asset->clips.at[i].name, text) == 0 || strcmp(asset->clips.at[i].id, text) == 0)
      return (int32_t)i;
  char *end;
  long number = strtol(text, &end, 10);
  return end != text && !*end && number >= 0 && number < (long)asset->clips.count ? (int32_t)number
                                                                                  : SBF_NONE;
}

/* The played clip controls its bones, instead of gait and chains. */
static bool choose_clip(session *s, const cli_call *call, int32_t *clip) {
  const char *text = cli_value(call, "--clip");
  *clip = SBF_NONE;
  if (!text) return true;
  *clip = find_clip(s->asset, text);
  if (*clip == SBF_NONE) {
    cli_wrong(call,
        s->asset->clips.count ? "no clip '%s' in the file; the first of its %u clips is '%s'"
                              : "no clip '%s': the file has none",
        text, (unsigned)s->asset->clips.count, s->asset->clips.count ? s->asset->clips.at[0].name : "");
    return false;
  }
  s->asset->gaits = (sbf_gait_list){NULL, 0};
  s->asset->chains = (sbf_chain_list){NULL, 0};
  return true;
}

static bool parse_settings(session *s, cli_call *call) {
  session_settings *set = &s->settings;
  long substeps = 0, level = 0;
  *set = (session_settings){.model = sbr_default_model_options(),
      .threads = 1,
      .hold = cli_switch(call, "--hold"),
      .ragdoll = cli_switch(call, "--ragdoll"),
      .driven = cli_value(call, "--strength") != NULL};
  bool good =
      cli_number(call, "--seconds", 0, 1e6, &s->seconds) && cli_number(call, "--fps", 1, 10000, &s->fps) &&
      cli_integer(call, "--substeps", 1, 1024, &substeps) && cli_integer(call, "--level", 0, 1000, &level) &&
      cli_integer(call, "--threads", 1, 64, &set->threads) &&
      cli_number(call, "--raise", -1000, 1000, &set->raise) &&
      cli_number(call, "--gravity", -1000, 1000, &set->gravity) &&
      cli_number(call, "--strength", 0, 1e6, &set->strength) && parse_drive(call, set->drive) &&
      parse_ground(call, &s->ground) && parse_scheme(call, &set->model.scheme) &&
      parse_instructions(call, &set->model.instructions);
  set->model.substeps = (uint32_t)substeps;
  set->model.level = (uint32_t)level;
  set->model.free = cli_switch(call, "--free");
  set->model.has_gravity = cli_value(call, "--gravity") != NULL;
  set->model.gravity = (sbf_vec3){0, (float)-set->gravity, 0};
  s->frame_count = (uint32_t)(s->seconds * s->fps + 0.5);
  return good;
}

static void report(void *user, const sbf_diagnostic *diagnostic) {
  cli_print_diagnostic(user, diagnostic);
}

static sbf_status create_character(session *s, sbf_diagnostic *error) {
  sbr_character_definition character = sbr_default_character_definition();
  character.position.y = standing_lift(s->asset, &s->ground) + s->settings.raise;
  character.hold_pose = s->settings.hold;
  return sbr_character_create(s->world, s->model, &character, &s->character, error);
}

static bool has_rigid_parts(const session *s, const cli_call *call) {
  if (!(s->settings.ragdoll || s->settings.driven) || s->asset->rigid_bodies.count) return true;
  cli_wrong(call, "the file has no rigid bodies, which --ragdoll and --strength need");
  return false;
}

static void loosen_rigid_parts(session *s) {
  sbr_rigid_drive drive = sbr_default_rigid_drive();
  drive.strength = (float)s->settings.strength;
  if (s->settings.driven) sbr_character_set_rigid_drive(s->world, s->character, &drive);
  if (s->settings.driven || s->settings.ragdoll)
    sbr_character_set_rigid_mode(
        s->world, s->character, -1, s->settings.driven ? SBR_RIGID_DRIVEN : SBR_RIGID_PASSIVE);
}

static bool script_drives_up(const script *s) {
  for (uint32_t i = 0; i < s->count; i++)
    if (s->lines[i].kind == SCRIPT_DRIVE && s->lines[i].numbers[3] != 0) return true;
  return false;
}

/* Warns of commands that the character ignores. */
static void warn_of_drive(const session *s, const cli_call *call) {
  const sbf_gait *gait = s->asset->gaits.count ? &s->asset->gaits.at[0] : NULL;
  bool option = s->settings.drive[2] != 0, rises = option || script_drives_up(&s->script);
  if (!rises || s->recording.bytes ||
      (gait && (gait->kind == SBF_GAIT_KIND_SWIM || gait->kind == SBF_GAIT_KIND_FLY)))
    return;
  fprintf(stderr,
      "sbfmt %s: warning: the vertical speed of %s is ignored: only swimmers and fliers have one, and this "
      "character has %s%s\n",
      call->verb->name, option ? "--drive" : "--script", gait ? "the gait " : "no gait",
      gait ? sbf_gait_kind_name(gait->kind) : "");
}

/* Applies the initial options, unless a recording does. */
static void begin(session *s) {
  const session_settings *set = &s->settings;
  if (s->recording.bytes) {
    s->frame_count = (uint32_t)s->recording.replay.frame_count;
    return;
  }
  script_drive(&s->script, 0, s->world, s->character, set->drive[0], 0, set->drive[1], set->drive[2]);
  sbr_clip_play how = sbr_default_clip_play();
  how.fade_s = CLIP_FADE_S;
  if (set->clip != SBF_NONE) sbr_character_play_clip(s->world, s->character, 0, set->clip, &how);
  loosen_rigid_parts(s);
}

/* Whether the file has surroundings: hulls that neither a bone nor a force moves. */
static bool has_static_bodies(const sbf_asset *asset) {
  for (uint32_t i = 0; i < asset->rigid_bodies.count; i++) {
    const sbf_rigid_body *body = &asset->rigid_bodies.at[i];
    if (body->bone == SBF_NONE && body->motion == SBF_BODY_MOTION_KINEMATIC && body->hull) return true;
  }
  return false;
}

static sbf_status create(session *s, sbf_diagnostic *error) {
  const session_settings *set = &s->settings;
  sbf_status status = sbr_model_create(s->asset, &set->model, &s->model, error);
  if (status != SBF_OK) return status;
  sbr_world_definition world = sbr_default_world_definition();
  world.tasks = thread_pool_tasks(s->threads);
  world.ground = s->ground;
  world.control_tick_s = (double)s->asset->environment.control_tick;
  world.has_gravity = set->model.has_gravity;
  world.gravity = set->model.gravity;
  status = sbr_world_create(&world, &s->world, error);
  if (status == SBF_OK && has_static_bodies(s->asset))
    status = sbr_world_enable_body_contacts(s->world, 0, error);
  return status == SBF_OK ? create_character(s, error) : status;
}

bool session_open(session *s, cli_call *call, double seconds, double fps, int *status) {
  sbf_diagnostic error;
  *s = (session){.seconds = seconds, .fps = fps};
  *status = SBF_FAILED;
  if (!parse_settings(s, call) || !output_name_check(call, "--record", (const char *const[]){".sbrec", NULL}))
    return false;
  const char *commands = cli_value(call, "--script");
  if (commands && !script_load(&s->script, call, commands, status)) return false;
  s->threads = thread_pool_create((uint32_t)s->settings.threads);
  if (!s->threads) {
    cli_wrong(call, "the threads cannot be created: use fewer");
    session_close(s);
    return false;
  }
  *status = (int)sbf_load_file(call->inputs[0],
      &(sbf_load_options){.report = cli_report, .user = call, .with_images = true}, &s->asset, &error);
  if (*status == SBF_OK && !(choose_clip(s, call, &s->settings.clip) && has_rigid_parts(s, call))) {
    *status = SBF_FAILED;
    session_close(s);
    return false;
  }
  if (*status == SBF_OK && !script_fits(&s->script, call, commands, s->asset)) {
    *status = SBF_BAD_INPUT;
    session_close(s);
    return false;
  }
  if (*status == SBF_OK) *status = (int)create(s, &error);
  if (*status != SBF_OK) {
    cli_print_diagnostic(call, &error);
  } else {
    sbr_model_report_unsupported(s->model, report, call);
    sbr_model_report_scheme_bias(s->model, report, call);
    if ((*status = recording_open(&s->recording, call, s->world)) == SBF_OK) {
      warn_of_drive(s, call);
      begin(s);
      return true;
    }
  }
  session_close(s);
  return false;
}

sbf_status session_restart(session *s, const cli_call *call, sbf_diagnostic *error) {
  recording_finish(&s->recording, call, s->world);
  recording_close(&s->recording);
  sbr_world_destroy(s->world);
  sbr_model_destroy(s->model);
  s->world = NULL, s->model = NULL;
  s->frame = 0, s->time_s = 0;
  s->frame_count = (uint32_t)(s->seconds * s->fps + 0.5);
  sbf_status status = create(s, error);
  if (status == SBF_OK) begin(s);
  return status;
}

void session_close(session *s) {
  sbr_world_destroy(s->world);
  sbr_model_destroy(s->model);
  sbf_asset_free(s->asset);
  thread_pool_destroy(s->threads);
  script_free(&s->script);
  recording_close(&s->recording);
  *s = (session){.asset = NULL};
}

static bool replay_frame(session *s) {
  if (!sbr_replay_step(&s->recording.replay)) return false;
  s->frame_s = s->recording.replay.frame_s;
  s->frame++;
  s->time_s += s->frame_s;
  return true;
}

bool session_step_by(session *s, double seconds) {
  if (s->frame >= s->frame_count) return false;
  if (s->recording.bytes) return replay_frame(s);
  script_play(&s->script, s->time_s, s->world, s->character);
  s->frame_s = seconds;
  sbr_world_step(s->world, s->frame_s);
  s->frame++;
  s->time_s += seconds;
  return true;
}

bool session_step(session *s) {
  if (!session_step_by(s, 1 / s->fps)) return false;
  if (!s->recording.bytes) s->time_s = s->frame / s->fps; /* avoids accumulated rounding */
  return true;
}

bool session_finish(session *s, const cli_call *call) {
  return recording_finish(&s->recording, call, s->world);
}
