#include "tune/tuned_meshes.h"

#include <stdio.h>
#include <string.h>

#include "base/fault.h"
#include "chart/subject.h"
#include "sbfmt/build.h"

enum { ALL_REFERENCE = 12000, MIN_REFERENCE = 960, MAX_REFERENCE = 4000, MIN_SIZE = 48 };

typedef struct maker {
  const tune_grid *grid;
  tune_meshes *to;
  sbf_diagnostic *error;
  double done, fraction; /* of the progress: before this build, and its own */
} maker;

static sbf_status no_memory(const maker *m) {
  return fault_set(m->error, SBF_CODE_OUT_OF_MEMORY, "memory ran out for levels to try");
}

static bool build_progress(void *user, const char *pass, double done) {
  const maker *m = user;
  (void)pass;
  if (m->grid->progress) m->grid->progress(m->grid->user, "lattices", m->done + m->fraction * done);
  return true;
}

static bool is_stepped(const sbf_level *level) {
  return level->model != SBF_ELASTIC_MODEL_JIGGLE;
}

static uint32_t stepped_levels(const sbf_soft_body *body) {
  uint32_t count = 0;
  while (count < body->levels.count && is_stepped(&body->levels.at[count])) count++;
  return count;
}

static bool is_derived(const sbf_soft_body *body) {
  return body->levels.count > 0 && body->levels.at[0].derived != SBF_NONE;
}

/* A copy of the base in which each body has one level, chosen by `pick`. */
static sbf_asset *with_levels(
    const sbf_asset *base, const sbf_level *(*pick)(uint32_t body, const void *user), const void *user) {
  sbf_asset *memory = sbf_asset_create(NULL), *made = NULL;
  sbf_soft_body *bodies =
      memory ? sbf_asset_allocate(memory, (size_t)base->soft_bodies.count + 1, sizeof *bodies) : NULL;
  sbf_asset view = *base;
  for (uint32_t b = 0; bodies && b < base->soft_bodies.count; b++) {
    bodies[b] = base->soft_bodies.at[b];
    bodies[b].levels = (sbf_level_list){pick(b, user), 1};
    if (!bodies[b].levels.at) bodies[b].levels.count = 0;
  }
  view.soft_bodies.at = bodies;
  if (bodies) made = sbf_asset_clone(&view, NULL);
  sbf_asset_free(memory);
  return made;
}

typedef struct of_base {
  const sbf_asset *base;
  uint32_t level;
} of_base;

/* For a body with fewer levels uses its coarsest. */
static const sbf_level *pick_of_base(uint32_t body, const void *user) {
  const of_base *from = user;
  const sbf_soft_body *of = &from->base->soft_bodies.at[body];
  uint32_t count = stepped_levels(of);
  return count ? &of->levels.at[from->level < count ? from->level : count - 1] : NULL;
}

typedef struct of_built {
  const sbf_asset *base, *built;
} of_built;

static const sbf_level *pick_of_built(uint32_t body, const void *user) {
  const of_built *from = user;
  const sbf_soft_body *was = &from->base->soft_bodies.at[body];
  return is_derived(was) ? &from->built->soft_bodies.at[body].levels.at[0]
                         : (was->levels.count ? &was->levels.at[0] : NULL);
}

/* Whether a rebuilt asset has the base's parts in its order. */
static bool same_parts(const sbf_asset *a, const sbf_asset *b) {
  if (a->soft_bodies.count != b->soft_bodies.count || a->bones.count != b->bones.count ||
      a->rigid_bodies.count != b->rigid_bodies.count || a->render_meshes.count != b->render_meshes.count)
    return false;
  for (uint32_t i = 0; i < a->soft_bodies.count; i++) {
    const sbf_soft_body *p = &a->soft_bodies.at[i], *q = &b->soft_bodies.at[i];
    size_t size = p->surface.positions.count * sizeof *p->surface.positions.at;
    if (strcmp(p->id, q->id) != 0 || p->surface.positions.count != q->surface.positions.count) return false;
    if (size && memcmp(p->surface.positions.at, q->surface.positions.at, size) != 0) return false;
    if (q->levels.count == 0) return false;
  }
  return true;
}

static sbf_status name_mesh(maker *m, tune_mesh *mesh, const char *name) {
  snprintf(mesh->name, sizeof mesh->name, "%s", name);
  if (!mesh->asset) return no_memory(m);
  mesh->elements = chart_all_elements_of(mesh->asset);
  return SBF_OK;
}

/* Restores moduli before calibration: false if there was none. */
static bool uncalibrate(sbf_asset *asset) {
  bool any = false;
  for (uint32_t b = 0; b < asset->soft_bodies.count; b++) {
    /* This file owns the copy. */
    sbf_level *level = (sbf_level *)(uintptr_t)asset->soft_bodies.at[b].levels.at;
    if (!asset->soft_bodies.at[b].levels.count || !level->calibration) continue;
    if (level->model != SBF_ELASTIC_MODEL_TETRAHEDRA || !level->lattice.reference_modulus.count) continue;
    level->lattice.young_modulus = level->lattice.reference_modulus;
    level->lattice.reference_modulus = (sbf_f32_list){NULL, 0};
    level->calibration = NULL;
    level->simulation.error = level->simulation.cost = 0;
    any = true;
  }
  return any;
}

/* ---- Making ---- */

static sbf_status make_base(maker *m, const sbf_asset *asset) {
  sbf_build_options options = {.progress = build_progress, .user = m};
  bool built = asset->soft_bodies.count > 0;
  for (uint32_t b = 0; b < asset->soft_bodies.count; b++)
    built = built && stepped_levels(&asset->soft_bodies.at[b]) > 0;
  if (built) {
    m->to->base = sbf_asset_clone(asset, NULL);
    return m->to->base ? SBF_OK : no_memory(m);
  }
  sbf_status status = sbf_build(asset, &options, &m->to->base, NULL, m->error);
  uint32_t soft = 0;
  for (uint32_t b = 0; status == SBF_OK && b < m->to->base->soft_bodies.count; b++)
    soft += stepped_levels(&m->to->base->soft_bodies.at[b]) > 0;
  if (status == SBF_OK && !soft && m->to->base->render_meshes.count) {
    m->to->nothing_is_soft = true;
    return SBF_OK;
  }
  if (status == SBF_OK && !soft)
    return fault_set(m->error, SBF_CODE_REQUIRED_MISSING,
        "nothing is soft: tune needs a soft body, or a skinned mesh to cut into sections");
  return status;
}

static sbf_status check_base(maker *m) {
  bool derived = false;
  for (uint32_t b = 0; b < m->to->base->soft_bodies.count; b++)
    derived = derived || is_derived(&m->to->base->soft_bodies.at[b]);
  if (derived) return SBF_OK;
  return fault_set(m->error, SBF_CODE_REQUIRED_MISSING,
      "every level is authored, and tune changes only derived ones: remove the levels and run sbfmt build");
}

static sbf_status add_own_levels(maker *m) {
  uint32_t max = 0;
  const sbf_asset *base = m->to->base;
  for (uint32_t b = 0; b < base->soft_bodies.count; b++) {
    uint32_t count = stepped_levels(&base->soft_bodies.at[b]);
    max = count > max ? count : max;
  }
  for (uint32_t l = 0; l < max && m->to->count < 8; l++) {
    char name[48] = "as built";
    if (l > 0) snprintf(name, sizeof name, "as built, level %u", (unsigned)l);
    tune_mesh *mesh = &m->to->at[m->to->count++];
    mesh->asset = with_levels(base, pick_of_base, &(of_base){base, l});
    sbf_status status = name_mesh(m, mesh, name);
    if (status != SBF_OK) return status;
  }
  return SBF_OK;
}

static sbf_status build_lattice(maker *m, uint32_t size, tune_mesh *mesh) {
  const sbf_build_options options = {
      .interior = SBF_BUILD_INTERIOR_TETRAHEDRA, .elements = size, .progress = build_progress, .user = m};
  sbf_asset *built = NULL;
  sbf_status status = sbf_build(m->to->base, &options, &built, NULL, m->error);
  if (status != SBF_OK) return status;
  if (!same_parts(m->to->base, built)) {
    snprintf(m->to->note, sizeof m->to->note,
        "its sections differ from those of a build of this version: build it again so that lattices can be "
        "tried");
    sbf_asset_free(built);
    return SBF_OK;
  }
  char name[48];
  mesh->asset = with_levels(m->to->base, pick_of_built, &(of_built){m->to->base, built});
  mesh->asked = size;
  mesh->calibrated = true;
  snprintf(name, sizeof name, "tetrahedra %u calibrated", (unsigned)size);
  sbf_asset_free(built);
  return name_mesh(m, mesh, name);
}

static sbf_status add_twin(maker *m, const tune_mesh *of) {
  tune_mesh *mesh = &m->to->at[m->to->count];
  char name[48];
  mesh->asset = sbf_asset_clone(of->asset, NULL);
  mesh->asked = of->asked;
  mesh->calibrated = false;
  snprintf(name, sizeof name, "tetrahedra %u", (unsigned)of->asked);
  sbf_status status = name_mesh(m, mesh, name);
  if (status != SBF_OK) return status;
  m->to->count++;
  if (uncalibrate(mesh->asset)) return SBF_OK;
  m->to->count--;
  sbf_asset_free(mesh->asset);
  *mesh = (tune_mesh){.asset = NULL};
  return SBF_OK;
}

static uint32_t reference_of(const tune_grid *grid, uint32_t bodies) {
  if (grid->reference) return grid->reference;
  uint32_t size = ALL_REFERENCE / (bodies ? bodies : 1);
  size = size > MAX_REFERENCE ? MAX_REFERENCE : size < MIN_REFERENCE ? MIN_REFERENCE : size;
  return grid->coarse ? size / 4 : size;
}

static sbf_status add_lattices(maker *m) {
  uint32_t reference = reference_of(m->grid, m->to->base->soft_bodies.count);
  uint32_t sizes[TUNE_MAX_SIZES], count = m->grid->size_count;
  memcpy(sizes, m->grid->sizes, sizeof sizes);
  for (uint32_t size = reference / 2, i = 0; !m->grid->size_count && i < 3; i++, size /= 4)
    if (size >= MIN_SIZE) sizes[count++] = size;
  m->fraction = 1.0 / (1 + count);
  m->done = 0;
  sbf_status status = build_lattice(m, reference, &m->to->reference);
  for (uint32_t i = 0; status == SBF_OK && m->to->reference.asset && i < count; i++) {
    tune_mesh *mesh = &m->to->at[m->to->count];
    m->done = m->fraction * (1 + i);
    status = build_lattice(m, sizes[i], mesh);
    if (mesh->asset) m->to->count++;
    if (status == SBF_OK && mesh->asset && !m->grid->calibrated_alone) status = add_twin(m, mesh);
  }
  return status;
}

sbf_status tune_meshes_make(
    const sbf_asset *asset, const tune_grid *grid, tune_meshes *meshes, sbf_diagnostic *error) {
  maker m = {.grid = grid, .to = meshes, .error = error, .fraction = 1};
  *meshes = (tune_meshes){.base = NULL};
  sbf_status status = make_base(&m, asset);
  if (status != SBF_OK || meshes->nothing_is_soft) return status;
  status = check_base(&m);
  if (status == SBF_OK) status = add_own_levels(&m);
  if (status != SBF_OK) return status;
  if (meshes->base->cross_springs.count)
    snprintf(meshes->note, sizeof meshes->note, "springs between bodies name points of the levels there are");
  else
    status = add_lattices(&m);
  if (status != SBF_OK || meshes->reference.asset) return status;
  meshes->reference = (tune_mesh){.asset = sbf_asset_clone(meshes->at[0].asset, NULL)};
  return name_mesh(&m, &meshes->reference, meshes->at[0].name);
}

bool tune_meshes_trust_own(tune_meshes *meshes) {
  sbf_asset *own = meshes->reference.asked ? sbf_asset_clone(meshes->at[0].asset, NULL) : NULL;
  if (!own) return false;
  sbf_asset_free(meshes->reference.asset);
  meshes->reference = meshes->at[0];
  meshes->reference.asset = own;
  return true;
}

void tune_meshes_free(tune_meshes *meshes) {
  for (uint32_t i = 0; i < TUNE_MAX_MESHES; i++) sbf_asset_free(meshes->at[i].asset);
  sbf_asset_free(meshes->reference.asset);
  sbf_asset_free(meshes->base);
  *meshes = (tune_meshes){.base = NULL};
}
