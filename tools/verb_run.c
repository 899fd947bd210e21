/* sbfmt run: simulates a character, reports the result and writes the requested files. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "output_name.h"
#include "pose_file.h"
#include "profile_report.h"
#include "recovery_report.h"
#include "result_cache.h"
#include "rigid_report.h"
#include "run_text.h"
#include "sbfmt/export.h"
#include "seam.h"
#include "session.h"
#include "walk_report.h"

/* Data of a run in addition to the session. */
typedef struct run_state {
  session s;
  soles *soles;
  walk_report *walk;
  seams *seams;
  rigid_report rigid;
  recovery_report recoveries;
  profile_report profile;
  sbf_vec3 *skin, *normals, *surface, *sample;
  uint32_t skin_count, surface_count;
  sbf_point_cache *cache;
  result_cache *results;
  bool cache_of_surface;
  pose_file poses;
  double busy_s;                 /* time spent stepping and skinning */
  double min_volume, max_strain; /* over all frames */
  double end_volume;
  bool valid;
} run_state;

static bool reserve(run_state *r) {
  const sbf_asset *asset = r->s.asset;
  for (uint32_t i = 0; i < asset->render_meshes.count; i++)
    r->skin_count += asset->render_meshes.at[i].mesh.positions.count;
  for (uint32_t i = 0; i < asset->soft_bodies.count; i++)
    r->surface_count += asset->soft_bodies.at[i].surface.positions.count;
  r->skin = calloc(r->skin_count + 1, sizeof *r->skin);
  r->normals = calloc(r->skin_count + 1, sizeof *r->normals);
  r->surface = calloc(r->surface_count + 1, sizeof *r->surface);
  r->sample =
      calloc((r->skin_count > r->surface_count ? r->skin_count : r->surface_count) + 1, sizeof *r->sample);
  return r->skin && r->normals && r->surface && r->sample &&
         recovery_report_begin(&r->recoveries, asset, 1 / r->s.fps);
}

static void read_skin(run_state *r) {
  uint32_t at = 0;
  for (uint32_t i = 0; i < r->s.asset->render_meshes.count; i++)
    at += sbr_character_get_skin(
        r->s.world, r->s.character, i, r->skin + at, r->normals + at, NULL, r->skin_count - at);
}

static void read_health(run_state *r) {
  r->end_volume = 1;
  for (uint32_t i = 0; i < r->s.asset->soft_bodies.count; i++) {
    sbr_body_health health = sbr_character_get_body_health(r->s.world, r->s.character, i);
    r->valid = r->valid && health.finite;
    recovery_report_measure(&r->recoveries, i, &health);
    r->end_volume = fmin(r->end_volume, (double)health.volume_ratio);
    r->max_strain = fmax(r->max_strain, (double)health.max_strain);
  }
  r->min_volume = fmin(r->min_volume, r->end_volume);
}

static double energy(const run_state *r) {
  double sum = 0;
  for (uint32_t i = 0; i < r->s.asset->soft_bodies.count; i++) {
    sbr_body_health health = sbr_character_get_body_health(r->s.world, r->s.character, i);
    sum += health.kinetic_j + health.elastic_j + health.potential_j;
  }
  return sum;
}

/* Adds the skin, or the surfaces, in world space to the cache. */
static bool add_to_cache(run_state *r, sbf_diagnostic *error) {
  sbr_double3 origin = sbr_character_get_origin(r->s.world, r->s.character);
  uint32_t count = r->cache_of_surface ? r->surface_count : r->skin_count, at = 0;
  for (uint32_t i = 0; r->cache_of_surface && i < r->s.asset->soft_bodies.count; i++)
    at += sbr_character_get_surface(r->s.world, r->s.character, i, r->surface + at, count - at);
  const sbf_vec3 *from = r->cache_of_surface ? r->surface : r->skin;
  for (uint32_t i = 0; i < count; i++)
    r->sample[i] = (sbf_vec3){(float)(origin.x + (double)from[i].x), (float)(origin.y + (double)from[i].y),
        (float)(origin.z + (double)from[i].z)};
  return sbf_point_cache_add(r->cache, r->sample, error) == SBF_OK;
}

static bool record(run_state *r, sbf_diagnostic *error) {
  read_health(r);
  rigid_report_measure(&r->rigid, &r->s);
  if (r->soles) soles_measure(r->soles, &r->s, r->skin);
  if (r->walk) walk_report_measure(r->walk, &r->s, r->skin);
  seams_measure(r->seams, r->skin);
  if (r->cache && !add_to_cache(r, error)) return false;
  if (r->results && result_cache_add(r->results, &r->s, error) != SBF_OK) return false;
  return !r->poses.file || pose_file_add(&r->poses, &r->s, error) == SBF_OK;
}

static bool open_outputs(run_state *r, cli_call *call) {
  sbf_diagnostic error;
  static const char *const sources[] = {"skin", "surface"};
  int of = 0;
  if (!cli_word(call, "--of", sources, 2, &of)) return false;
  const char *cache = cli_value(call, "--cache"), *poses = cli_value(call, "--pose");
  if (cli_value(call, "--of") && !cache)
    return cli_wrong(call, "--of selects the content of a point cache: add --cache OUT.pc2"), false;
  r->cache_of_surface = of == 1;
  uint32_t points = of ? r->surface_count : r->skin_count;
  bool results = cache && result_cache_named(cache);
  if (results && cli_value(call, "--of")) {
    cli_wrong(call, "--of is for point caches: %s has the points and elements of all soft bodies", cache);
    return false;
  }
  if (results && !(r->results = result_cache_open(&r->s, cache, &error))) {
    cli_print_diagnostic(call, &error);
    return false;
  }
  if (cache && !results &&
      sbf_point_cache_open(cache, points, r->s.frame_count + 1, 1 / r->s.fps, &r->cache, &error) != SBF_OK) {
    cli_print_diagnostic(call, &error);
    return false;
  }
  if (poses && pose_file_open(&r->poses, poses, &r->s, &error) != SBF_OK) {
    cli_print_diagnostic(call, &error);
    return false;
  }
  return profile_report_begin(&r->profile, &r->s, call);
}

/* Commits all written files, or none; false on failure. */
static bool close_outputs(run_state *r, bool keep, const cli_call *call) {
  sbf_diagnostic error;
  bool good = true;
  if (r->cache && keep && sbf_point_cache_commit(r->cache, &error) != SBF_OK)
    cli_print_diagnostic(call, &error), good = false;
  if (r->results && keep && result_cache_commit(r->results, &error) != SBF_OK)
    cli_print_diagnostic(call, &error), good = false;
  if (!keep) sbf_point_cache_abandon(r->cache), result_cache_abandon(r->results);
  if (profile_report_end(&r->profile, keep, &error) != SBF_OK)
    cli_print_diagnostic(call, &error), good = false;
  if (pose_file_close(&r->poses, keep, &error) != SBF_OK) cli_print_diagnostic(call, &error), good = false;
  return good;
}

/* Distance covered by a character without legs. */
static void add_distance(const run_state *r, json_t *o) {
  const sbf_gait_list gaits = r->s.asset->gaits;
  if (gaits.count && gaits.at[0].kind != SBF_GAIT_KIND_WALK)
    json_object_set_new(o, "distance", json_real(sbr_character_get_distance(r->s.world, r->s.character)));
}

static void add_steps(const run_state *r, json_t *o) {
  sbr_leg_state legs[16];
  uint32_t leg_count = sbr_character_get_legs(r->s.world, r->s.character, legs, 16);
  if (leg_count == 0 || !r->soles) return;
  const sbf_gait *gait = &r->s.asset->gaits.at[0];
  json_t *steps = json_object();
  for (uint32_t l = 0; l < leg_count && l < 16; l++)
    json_object_set_new(steps, gait->legs.at[l].name, json_integer(legs[l].steps_taken));
  sole_report walked = soles_report(r->soles);
  json_object_set_new(o, "distance", json_real(sbr_character_get_distance(r->s.world, r->s.character)));
  json_object_set_new(o, "steps_taken", steps);
  json_object_set_new(o, "stance_slip", json_real(walked.slip_m));
  json_object_set_new(o, "penetration", json_real(walked.penetration_m));
  if (r->walk) walk_report_add(r->walk, &r->s, o);
}

static json_t *report(const run_state *r) {
  char hash[24];
  snprintf(hash, sizeof hash, "%016llx", (unsigned long long)sbr_world_get_state_hash(r->s.world));
  uint64_t ticks = sbr_world_get_tick_count(r->s.world);
  json_t *o = json_object();
  json_object_set_new(o, "seconds", json_real(r->s.time_s));
  json_object_set_new(o, "frames", json_integer(r->s.frame));
  json_object_set_new(o, "steps", json_integer((json_int_t)ticks));
  json_object_set_new(o, "substeps", json_integer(sbr_model_get_substeps(r->s.model)));
  json_object_set_new(o, "us_per_frame", json_real(r->s.frame ? 1e6 * r->busy_s / r->s.frame : 0));
  json_object_set_new(o, "state_hash", json_string(hash));
  json_object_set_new(o, "valid", json_boolean(r->valid && recovery_report_is_valid(&r->recoveries)));
  recovery_report_add(&r->recoveries, r->s.asset, o);
  json_object_set_new(o, "energy", json_real(energy(r)));
  json_object_set_new(o, "volume_ratio", json_real(r->end_volume));
  json_object_set_new(o, "volume_ratio_least", json_real(r->min_volume));
  json_object_set_new(o, "max_strain", json_real(r->max_strain));
  json_object_set_new(o, "seam_gap", json_real(seams_gap(r->seams)));
  recording_report(&r->s.recording, o);
  add_distance(r, o);
  add_steps(r, o);
  profile_report_add(&r->profile, &r->s, o);
  /* for simulated bodies the limits of their joints, not of the pose */
  rigid_report_add(&r->rigid, &r->s, o);
  return o;
}

static bool play(run_state *r, cli_call *call) {
  sbf_diagnostic error;
  read_skin(r);
  bool good = record(r, &error);
  for (;;) {
    double start_s = profile_now_s();
    if (!good || !session_step(&r->s)) break;
    double skin_start_s = profile_now_s();
    read_skin(r);
    r->busy_s += profile_now_s() - start_s;
    good = profile_report_measure(&r->profile, &r->s, skin_start_s, &error) && record(r, &error);
    if (r->s.frame % 30 == 0) cli_progress("running", (double)r->s.frame / r->s.frame_count);
  }
  cli_progress_end();
  if (!good) cli_print_diagnostic(call, &error);
  return good;
}

/* Exit status of a replay. */
static int check_replay(const recording *r, const cli_call *call) {
  if (!r->replay.differs) return SBF_OK;
  cli_wrong(call, "the motion differs from the recorded one, at tick %llu or before",
      (unsigned long long)r->replay.differs_at_tick);
  return SBF_BAD_INPUT;
}

static int run(cli_call *call) {
  run_state r = {.valid = true, .min_volume = 1, .end_volume = 1};
  int status;
  if (!output_name_check(call, "--cache", (const char *const[]){".pc2", ".mdd", ".pvd", NULL}) ||
      !output_name_check(call, "--pose", (const char *const[]){".csv", NULL}) ||
      !output_name_check(call, "--trace", (const char *const[]){".json", NULL}))
    return SBF_FAILED;
  if (!session_open(&r.s, call, 5, 60, &status)) return status;
  status = SBF_FAILED;
  if (!reserve(&r))
    cli_wrong(call, "memory ran out");
  else if (open_outputs(&r, call)) {
    rigid_report_begin(&r.rigid, &r.s);
    r.soles = soles_create(&r.s);
    r.walk = walk_report_create(&r.s, r.soles);
    r.seams = seams_create(&r.s);
    if (play(&r, call) && session_finish(&r.s, call)) status = SBF_OK;
  }
  if (!close_outputs(&r, status == SBF_OK, call)) status = SBF_FAILED;
  if (status == SBF_OK) {
    json_t *object = report(&r);
    status = check_replay(&r.s.recording, call);
    recovery_report_warn(&r.recoveries, r.s.asset);
    if (call->json)
      status = cli_print_json(object, status);
    else {
      run_text_print(object);
      json_decref(object);
    }
  }
  walk_report_destroy(r.walk);
  seams_destroy(r.seams);
  soles_destroy(r.soles);
  free(r.skin);
  free(r.normals);
  free(r.surface);
  free(r.sample);
  recovery_report_end(&r.recoveries);
  session_close(&r.s);
  return status;
}

static const cli_option options[] = {
    SESSION_OPTIONS("simulated time (5)", "frames a second (60)"),
    {"--cache", "OUT.pc2|.mdd|.pvd",
        "write a point cache, one sample a frame; .pvd: displacement, stress and strain energy for ParaView, "
        "one file a frame"},
    {"--of", "skin|surface", "content of a point cache: the skin, or the surfaces of all sections (skin)"},
    {"--pose", "OUT.csv", "write position and rotation of every bone, one row a frame"},
    {"--profile", NULL, "print the mean time of a tick by stage, in microseconds, and what the world holds"},
    {"--trace", "OUT.json", "write when each stage of each tick ran, for chrome://tracing or Perfetto"},
    {"--format", "text|json", "how to print (text)"},
    {NULL, NULL, NULL},
};
const cli_verb verb_run = {"run", "FILE [--seconds S] [--drive M/S,RAD/S[,UP]] [--ground KIND] ...",
    "simulate a character and print measures",
    "Loads the file, simulates it and prints measures of the run.\n\n"
    "`valid` is true if at every frame all numbers were finite, no element was inverted, none\n"
    "was longer than ten times its rest length for more than 0.1 s, and no body was put back into\n"
    "its rest shape. `recoveries` counts how often bodies were put back; `recovered`, `inverted`,\n"
    "`stretched` and `crushed` (an element below a fifth or the body below half of its volume)\n"
    "name the bodies.\n"
    "`volume_ratio` is the smallest ratio of all sections at the end, `volume_ratio_least` at any\n"
    "frame. Slip and penetration are measured at the skin's soles. docs/gait.md explains the measures of the "
    "gait.\n\n"
    "With --ragdoll or --strength, `limit_excess` is the maximum angle in degrees by which a\n"
    "joint exceeded its limit, `joint_gap` the maximum distance between the two sides of a\n"
    "joint, and `rest_time` the time when all bodies were at rest (null or -: never).\n\n"
    "The same call gives the same `state_hash`. With --replay, `replay_same` is true if every\n"
    "state hash equals the recorded one; otherwise the exit status is 1.",
    options, 1, 1, run};
