#include "tune/fitted_mesh.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fault.h"

/* Factors of the first pass, then steps around the best one, each half of the one before. */
static const double COARSE[] = {1, 0.7, 1.4, 0.5, 2, 0.35, 2.8, 0.25, 4};
enum { COARSE_COUNT = sizeof COARSE / sizeof *COARSE, REFINEMENTS = 3 };
static const double FIRST_STEP = 0.5;
static const double MIN_FACTOR = 0.25, MAX_FACTOR = 4;
/* A factor counts if it reduces the error by a fiftieth. */
static const double WORTHWHILE = 0.98;

typedef struct body_fit {
  double factor, error; /* of the run */
  double best, best_error;
  double own_error; /* with factor 1 */
} body_fit;

typedef struct fitter {
  const tune_mesh *mesh;
  const tune_fit *fit;
  sbf_asset *trial;     /* its stiffness is that of the mesh, times the factors */
  body_fit *bodies;     /* (count) */
  double *vertex_error; /* (vertices of all skins) sum over time */
  uint32_t count, vertices;
  sbf_diagnostic *error;
} fitter;

static sbf_status no_memory(const fitter *f) {
  return fault_set(f->error, SBF_CODE_OUT_OF_MEMORY, "memory ran out for a fit");
}

static void scale_list(const sbf_f32_list *to, const sbf_f32_list *from, double factor) {
  float *at = (float *)(uintptr_t)to->at; /* the trial is owned here */
  for (uint32_t i = 0; i < to->count; i++) at[i] = (float)(factor * (double)from->at[i]);
}

static sbf_level *level_of(const sbf_asset *asset, uint32_t body) {
  return (sbf_level *)(uintptr_t)asset->soft_bodies.at[body].levels.at;
}

/* Springs, tetrahedra and goal springs alike, so that the shape under a load stays similar. */
static void scale_body(const fitter *f, uint32_t body, double factor) {
  if (!f->trial->soft_bodies.at[body].levels.count) return;
  sbf_level *to = level_of(f->trial, body);
  const sbf_level *from = level_of(f->mesh->asset, body);
  for (uint32_t s = 0; s < to->springs.count; s++) {
    scale_list(&to->springs.at[s].stiffness, &from->springs.at[s].stiffness, factor);
    scale_list(&to->springs.at[s].damping, &from->springs.at[s].damping, factor);
  }
  scale_list(&to->lattice.young_modulus, &from->lattice.young_modulus, factor);
  for (uint32_t p = 0; p < to->pins.count; p++) {
    sbf_pin_set *pins = (sbf_pin_set *)(uintptr_t)&to->pins.at[p];
    pins->stiffness = (float)(factor * (double)from->pins.at[p].stiffness);
    pins->damping = (float)(factor * (double)from->pins.at[p].damping);
  }
}

static bool has_stiffness(const sbf_level *level) {
  if (level->model == SBF_ELASTIC_MODEL_TETRAHEDRA) return level->lattice.young_modulus.count > 0;
  bool all = level->model == SBF_ELASTIC_MODEL_SPRINGS && level->springs.count > 0;
  for (uint32_t s = 0; s < level->springs.count; s++) all = all && level->springs.at[s].stiffness.count > 0;
  return all;
}

static bool can_fit(const fitter *f, uint32_t body) {
  const sbf_soft_body *of = &f->mesh->asset->soft_bodies.at[body];
  return of->levels.count && of->levels.at[0].derived != SBF_NONE && has_stiffness(&of->levels.at[0]);
}

/* Fourth powers: near the error of the worst vertices, and still smooth. */
static void add_track(fitter *f, const chart_track *is, const chart_track *wanted) {
  for (uint32_t t = 0; t < is->ticks; t++)
    for (uint32_t v = 0; v < f->vertices; v++) {
      sbf_vec3 p = is->positions[(size_t)t * is->points + v],
               q = wanted->positions[(size_t)t * is->points + v];
      double x = (double)p.x - (double)q.x, y = (double)p.y - (double)q.y, z = (double)p.z - (double)q.z;
      double square = x * x + y * y + z * z;
      f->vertex_error[v] += square * square;
    }
}

/* `*sound` is false if something breaks. */
static sbf_status add_motion(fitter *f, const tune_comparison *drive, int number, bool *sound) {
  chart_scene scene = chart_scene_of(&drive->cases[number], f->trial);
  chart_motion motion;
  chart_track track = {.ticks = 0};
  sbf_diagnostic refusal;
  scene.stop_broken = true;
  sbf_status status = chart_motion_open(&motion, &scene, &(chart_setting){.level = 0}, &refusal);
  bool opened = status == SBF_OK, good = !opened || chart_motion_sample(&motion, &track);
  chart_motion_close(&motion);
  *sound = opened && good && track.sound && !track.turned_over;
  const chart_track *wanted = &drive->truths[number].track;
  if (*sound && track.points == f->vertices && wanted->points == track.points) add_track(f, &track, wanted);
  chart_track_free(&track);
  return good ? SBF_OK : no_memory(f);
}

static uint32_t first_vertex_of(const sbf_asset *asset, int32_t mesh) {
  uint32_t first = 0;
  for (int32_t i = 0; i < mesh; i++) first += asset->render_meshes.at[i].mesh.positions.count;
  return first;
}

static double error_of_body(const fitter *f, uint32_t body) {
  const sbf_level *level = level_of(f->trial, body);
  double sum = 0;
  for (uint32_t e = 0; e < level->embeddings.count; e++) {
    const sbf_embedding *of = &level->embeddings.at[e];
    if (of->render_mesh == SBF_NONE) continue;
    uint32_t first = first_vertex_of(f->trial, of->render_mesh);
    for (uint32_t i = 0; i < of->points.count; i++) {
      uint32_t vertex = first + (of->vertices.count ? of->vertices.at[i] : i);
      if (vertex < f->vertices)
        sum += (of->blends.count ? (double)of->blends.at[i] : 1) * f->vertex_error[vertex];
    }
  }
  return sum;
}

/* Runs all measured motions with the factors of the bodies, and keeps those that are better. */
static sbf_status run(fitter *f) {
  bool sound = true;
  sbf_status status = SBF_OK;
  memset(f->vertex_error, 0, f->vertices * sizeof *f->vertex_error);
  for (uint32_t b = 0; b < f->count; b++)
    if (can_fit(f, b)) scale_body(f, b, f->bodies[b].factor);
  for (uint32_t d = 0; d < f->fit->drive_count; d++)
    for (int i = 0; status == SBF_OK && sound && i < CHART_BUNDLE_CASES; i++)
      if (!f->fit->drives[d]->unmeasured[i][0]) status = add_motion(f, f->fit->drives[d], i, &sound);
  for (uint32_t b = 0; status == SBF_OK && b < f->count; b++) {
    body_fit *body = &f->bodies[b];
    if (!can_fit(f, b)) continue;
    body->error = sound ? error_of_body(f, b) : INFINITY;
    if (body->factor == 1 && !(body->own_error >= 0)) body->own_error = body->error;
    if (body->error < body->best_error) body->best = body->factor, body->best_error = body->error;
  }
  return status;
}

static sbf_status search(fitter *f) {
  sbf_status status = SBF_OK;
  for (int i = 0; status == SBF_OK && i < COARSE_COUNT; i++) {
    for (uint32_t b = 0; b < f->count; b++) f->bodies[b].factor = COARSE[i];
    status = run(f);
  }
  double step = FIRST_STEP;
  for (int i = 0; status == SBF_OK && i < 2 * REFINEMENTS; i++) {
    /* up, then down, from what was the best before both */
    for (uint32_t b = 0; b < f->count; b++) {
      double ratio = pow(1.4, i % 2 ? -step : step);
      f->bodies[b].factor = fmin(fmax(f->bodies[b].best * ratio, MIN_FACTOR), MAX_FACTOR);
    }
    status = run(f);
    if (i % 2) step /= 2;
  }
  return status;
}

/* States the modulus of the material beside the effective one. The errors of a calibration no longer hold. */
static bool mark_fitted(const fitter *f, uint32_t body) {
  sbf_level *level = level_of(f->trial, body);
  const sbf_f32_list *was = &level_of(f->mesh->asset, body)->lattice.young_modulus;
  level->calibration = NULL;
  level->simulation.error = 0;
  if (!was->count || level->lattice.reference_modulus.count) return true;
  float *moduli = sbf_asset_allocate(f->trial, was->count, sizeof *moduli);
  if (!moduli) return false;
  memcpy(moduli, was->at, was->count * sizeof *moduli);
  level->lattice.reference_modulus = (sbf_f32_list){moduli, was->count};
  return true;
}

static sbf_status keep_best(fitter *f, bool *any) {
  *any = false;
  for (uint32_t b = 0; b < f->count; b++) {
    const body_fit *body = &f->bodies[b];
    if (!can_fit(f, b)) continue;
    bool better = body->best_error < pow(WORTHWHILE, 4) * body->own_error;
    scale_body(f, b, better ? body->best : 1);
    if (better && !mark_fitted(f, b)) return no_memory(f);
    *any = *any || better;
  }
  return SBF_OK;
}

sbf_status tune_fit_mesh(
    const tune_mesh *mesh, const tune_fit *fit, tune_mesh *fitted, sbf_diagnostic *error) {
  fitter f = {.mesh = mesh, .fit = fit, .count = mesh->asset->soft_bodies.count, .error = error};
  *fitted = (tune_mesh){.asset = NULL};
  f.vertices = first_vertex_of(mesh->asset, (int32_t)mesh->asset->render_meshes.count);
  f.trial = sbf_asset_clone(mesh->asset, NULL);
  f.bodies = calloc((size_t)f.count + 1, sizeof *f.bodies);
  f.vertex_error = calloc((size_t)f.vertices + 1, sizeof *f.vertex_error);
  for (uint32_t b = 0; f.bodies && b < f.count; b++)
    f.bodies[b] = (body_fit){.best = 1, .best_error = INFINITY, .own_error = NAN};
  sbf_status status = f.trial && f.bodies && f.vertex_error ? SBF_OK : no_memory(&f);
  if (status == SBF_OK && f.vertices) status = search(&f);
  bool any = false;
  if (status == SBF_OK && f.vertices) status = keep_best(&f, &any);
  if (any && status == SBF_OK) {
    *fitted = *mesh;
    fitted->asset = f.trial;
    snprintf(fitted->name, sizeof fitted->name, "%.38s, fitted", mesh->name);
    f.trial = NULL;
  }
  sbf_asset_free(f.trial);
  free(f.bodies), free(f.vertex_error);
  return status;
}
