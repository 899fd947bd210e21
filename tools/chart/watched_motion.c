#include "chart/watched_motion.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "chart/subject.h"

static const double FAR_DOWN_M = 1000;

static sbf_status create(chart_motion *m, const chart_setting *setting, sbf_diagnostic *error) {
  const chart_scene *scene = &m->scene;
  if (scene->begin) scene->begin(scene->user);
  sbr_model_options options = sbr_default_model_options();
  options.scheme = setting->scheme;
  options.substeps = setting->substeps;
  options.step_error_m = setting->step_error_m;
  options.level = setting->level;
  options.has_gravity = scene->has_gravity;
  options.gravity = scene->gravity;
  sbr_world_definition world = sbr_default_world_definition();
  sbr_character_definition character = sbr_default_character_definition();
  world.ground = sbr_ground_flat(scene->grounded ? 0 : -FAR_DOWN_M);
  if (scene->ground) world.ground = *scene->ground;
  world.has_gravity = scene->has_gravity;
  world.gravity = scene->gravity;
  world.character_capacity = 1;
  world.sleep_after_s = 0;
  world.control_tick_s = (double)scene->asset->environment.control_tick;
  character.position.y = scene->raise_m + (scene->grounded ? 0 : FAR_DOWN_M);
  sbf_status status = sbr_model_create(scene->asset, &options, &m->model, error);
  if (status == SBF_OK) status = sbr_world_create(&world, &m->world, error);
  if (status == SBF_OK) status = sbr_character_create(m->world, m->model, &character, &m->character, error);
  return status;
}

sbf_status chart_motion_open(
    chart_motion *m, const chart_scene *scene, const chart_setting *setting, sbf_diagnostic *error) {
  *m = (chart_motion){.scene = *scene, .scheme = setting->scheme};
  sbf_status status = create(m, setting, error);
  if (status != SBF_OK) return status;
  m->begin_size = sbr_world_get_snapshot_size(m->world);
  m->begin = malloc(m->begin_size);
  if (m->begin && sbr_world_save_snapshot(m->world, m->begin, m->begin_size) == SBF_OK) return SBF_OK;
  *error = (sbf_diagnostic){.severity = SBF_SEVERITY_ERROR, .offset = -1, .index = -1};
  snprintf(error->message, sizeof error->message, "memory ran out for the beginning of a motion");
  return SBF_FAILED;
}

void chart_motion_close(chart_motion *m) {
  sbr_world_destroy(m->world);
  sbr_model_destroy(m->model);
  free(m->begin);
  *m = (chart_motion){.begin = NULL};
}

static void advance(chart_motion *m, uint32_t tick) {
  if (m->scene.before_tick) m->scene.before_tick(m->scene.user, m->world, m->character, tick);
  sbr_world_tick(m->world);
}

void chart_motion_run(void *motion) {
  chart_motion *m = motion;
  sbr_world_restore_snapshot(m->world, m->begin, m->begin_size);
  uint32_t ticks = m->scene.timed_ticks ? m->scene.timed_ticks : m->scene.ticks;
  for (uint32_t t = 0; t < ticks; t++) advance(m, t);
}

/* List number `number` of the observed points; NULL if there are no more. */
static const sbf_vec3_list *watched_list(const chart_scene *scene, uint32_t number) {
  const sbf_asset *asset = scene->asset;
  if (scene->watch == CHART_WATCH_POINTS)
    return number ? NULL : &asset->soft_bodies.at[0].levels.at[0].positions;
  if (scene->watch == CHART_WATCH_SURFACE)
    return number < asset->soft_bodies.count ? &asset->soft_bodies.at[number].surface.positions : NULL;
  return number < asset->render_meshes.count ? &asset->render_meshes.at[number].mesh.positions : NULL;
}

uint32_t chart_motion_points(const chart_scene *scene) {
  uint32_t count = 0;
  const sbf_vec3_list *list;
  for (uint32_t i = 0; (list = watched_list(scene, i)) != NULL; i++) count += list->count;
  return count;
}

void chart_motion_rest(const chart_scene *scene, sbf_vec3 *positions) {
  const sbf_vec3_list *list;
  for (uint32_t i = 0; (list = watched_list(scene, i)) != NULL; i++)
    for (uint32_t k = 0; k < list->count; k++) *positions++ = list->at[k];
}

sbf_vec3 *chart_motion_begins(const chart_scene *scene) {
  sbf_vec3 *positions = calloc((size_t)chart_motion_points(scene) + 1, sizeof *positions);
  if (positions) chart_motion_rest(scene, positions);
  return positions;
}

/* Visits of each element per substep of the scheme. */
static double visits_a_substep(sbf_scheme scheme, const sbf_level *level) {
  enum { SWEEPS = 4 }; /* of block descent, each from every point of an element */
  bool springs = level->model == SBF_ELASTIC_MODEL_SPRINGS;
  if (scheme == SBF_SCHEME_HEUN) return 2;
  if (scheme == SBF_SCHEME_BLOCK_DESCENT) return SWEEPS * (springs ? 2 : 4);
  return 1;
}

double chart_body_visits(
    const sbr_model *model, const sbf_asset *asset, uint32_t soft_body, const chart_setting *setting) {
  const sbf_soft_body *body = &asset->soft_bodies.at[soft_body];
  if (!body->levels.count) return 0;
  const sbf_simulation *own = &body->levels.at[0].simulation;
  sbf_scheme scheme = setting->scheme == SBF_SCHEME_AUTOMATIC ? own->scheme : setting->scheme;
  if (setting->step_error_m > 0 || (scheme == SBF_SCHEME_HEUN && !setting->substeps && !own->substeps))
    return NAN;
  return visits_a_substep(scheme, &body->levels.at[0]) * chart_elements_of(body) *
         sbr_model_get_body_substeps(model, soft_body);
}

double chart_visits_of(const sbr_model *model, const sbf_asset *asset, const chart_setting *setting) {
  double sum = asset->soft_bodies.count ? 0 : NAN;
  for (uint32_t b = 0; b < asset->soft_bodies.count; b++) sum += chart_body_visits(model, asset, b, setting);
  return sum;
}

/* Relative to the character's origin, except for the skin, which is in world space. */
static void read_positions(const chart_motion *m, sbf_vec3 *positions, uint32_t count) {
  const sbf_asset *asset = m->scene.asset;
  uint32_t at = 0;
  if (m->scene.watch == CHART_WATCH_POINTS) {
    sbr_character_get_points(m->world, m->character, 0, positions, count);
    return;
  }
  for (uint32_t i = 0; m->scene.watch == CHART_WATCH_SURFACE && i < asset->soft_bodies.count; i++)
    at += sbr_character_get_surface(m->world, m->character, i, positions + at, count - at);
  if (m->scene.watch != CHART_WATCH_SKIN) return;
  for (uint32_t i = 0; i < asset->render_meshes.count; i++)
    at += sbr_character_get_skin(m->world, m->character, i, positions + at, NULL, NULL, count - at);
  sbr_double3 origin = sbr_character_get_origin(m->world, m->character);
  for (uint32_t i = 0; i < count; i++) {
    positions[i].x += (float)origin.x, positions[i].y += (float)origin.y;
    positions[i].z += (float)origin.z;
  }
}

static void read_health(const chart_motion *m, chart_track *track, uint32_t tick) {
  const char *why = NULL, *of = "";
  track->volume[tick] = 1;
  for (uint32_t i = 0; i < m->scene.asset->soft_bodies.count; i++) {
    sbr_body_health h = sbr_character_get_body_health(m->world, m->character, i);
    const char *before = why;
    track->kinetic_j[tick] += h.kinetic_j;
    track->energy_j[tick] += h.kinetic_j + h.elastic_j + h.potential_j;
    track->volume[tick] = i ? fmin(track->volume[tick], (double)h.volume_ratio) : (double)h.volume_ratio;
    if (!h.finite) why = "numbers that are none";
    if (h.recoveries) why = "lost its shape and was put back into it";
    if (h.inverted) track->turned_over = true;
    track->max_strain = fmax(track->max_strain, (double)h.max_strain);
    if (h.inverted && tick + 1 == m->scene.ticks) why = "inside out at the end";
    if (why != before) of = m->scene.asset->soft_bodies.at[i].id;
  }
  if (!why || !track->sound) return;
  track->sound = false;
  snprintf(track->why, sizeof track->why, "%s (%.40s, tick %u)", why, of, (unsigned)tick);
}

/* Elements visited per pass: each once, except for relaxation, which visits structural and shear springs
 * from both ends, and no flexion springs. */
static double visits_a_pass(sbf_scheme scheme, const sbf_soft_body *body) {
  const sbf_level *level = body->levels.count ? &body->levels.at[0] : NULL;
  if (level && scheme == SBF_SCHEME_AUTOMATIC) scheme = level->simulation.scheme;
  if (!level || scheme != SBF_SCHEME_RELAXATION) return chart_elements_of(body);
  double sum = 0;
  for (uint32_t s = 0; s < level->springs.count; s++) {
    const sbf_spring_set *set = &level->springs.at[s];
    bool twice = set->kind == SBF_SPRING_KIND_STRUCTURAL || set->kind == SBF_SPRING_KIND_SHEAR;
    sum += (twice ? 2.0 : set->kind == SBF_SPRING_KIND_INTERNAL ? 1.0 : 0.0) * set->ends.count;
  }
  return sum;
}

/* Total over all bodies since the character was created. */
static double visits_until_now(const chart_motion *m) {
  const sbf_asset *asset = m->scene.asset;
  double sum = 0;
  for (uint32_t b = 0; b < asset->soft_bodies.count; b++)
    sum += sbr_character_get_element_visits(m->world, m->character, b) *
           visits_a_pass(m->scheme, &asset->soft_bodies.at[b]);
  return sum;
}

bool chart_motion_sample(chart_motion *m, chart_track *track) {
  uint32_t count = chart_motion_points(&m->scene);
  if (!chart_track_make(track, m->scene.ticks, count)) return false;
  sbr_world_restore_snapshot(m->world, m->begin, m->begin_size);
  double before = visits_until_now(m);
  uint32_t ticks = 0;
  for (; ticks < m->scene.ticks && (track->sound || !m->scene.stop_broken); ticks++) {
    if (m->scene.looked) m->scene.looked(m->scene.looked_user, sbr_model_get_substeps(m->model), ticks);
    advance(m, ticks);
    read_positions(m, track->positions + (size_t)ticks * count, count);
    read_health(m, track, ticks);
  }
  double visits = visits_until_now(m) - before;
  m->visits = visits > 0 ? visits / ticks : NAN;
  return true;
}
