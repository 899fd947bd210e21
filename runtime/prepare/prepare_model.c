/* Order in which a model is built from an asset: bones, rigid parts, islands of soft bodies, skins, schemes.
 */
#include "prepare/prepare.h"

#include <float.h>
#include <string.h>

#include "animation/skeleton/rig_make.h"
#include "base/diagnostic.h"
#include "skin/skin.h"
#include "soft/solvers/router.h"

/* Default error of a step of schemes with error control: a tenth of a millimetre. */
static const float STEP_ERROR_M = 1e-4f;

/* Default number of substeps per tick of rigid parts. */
enum { RIGID_SUBSTEPS = 4 };

static sbf_status no_memory(sbf_diagnostic *error) {
  return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "no memory for the model");
}

/* The smallest error that a level of the island states. */
static float min_step_error(const sbr_model *model, const sbri_island *island) {
  float min = FLT_MAX;
  for (uint32_t b = 0; b < island->body_count; b++) {
    float asked = model->bodies[island->bodies[b]].level->simulation.step_error;
    if (asked > 0 && asked < min) min = asked;
  }
  return min < FLT_MAX ? min : STEP_ERROR_M;
}

/* The scheme that the call sets, else that of the level. If the runtime does not have it, or it cannot step
 * the island, the default, which follows the same energy. */
static sbf_status choose_scheme(
    sbr_model *model, sbri_island *island, const sbr_model_options *options, sbf_diagnostic *error) {
  const sbri_body *first = &model->bodies[island->bodies[0]];
  const sbf_simulation *stated = &first->level->simulation;
  const sbri_scheme *asked = sbri_scheme_of(options->scheme), *scheme = asked;
  const char *reason = asked ? sbri_scheme_refuses(asked, model, island) : NULL;
  if (reason)
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
        "scheme %s cannot step body \"%s\", %s: use another scheme, or automatic",
        sbf_scheme_name(options->scheme), first->source->id, reason);
  if (!scheme) scheme = sbri_scheme_of(stated->scheme);
  if (!scheme || sbri_scheme_refuses(scheme, model, island)) scheme = &sbri_symplectic;
  island->scheme = scheme;
  bool left_open = options->scheme == SBF_SCHEME_AUTOMATIC && scheme != sbri_scheme_of(stated->scheme);
  bool stated_for_this = stated->scheme == scheme->kind || stated->scheme == SBF_SCHEME_AUTOMATIC;
  island->stepping.substeps = options->substeps ? options->substeps : stated_for_this ? stated->substeps : 0;
  island->stepping.min_substeps = stated->substeps_least,
  island->stepping.max_substeps = stated->substeps_most;
  island->stepping.step_error_m =
      options->step_error_m > 0 ? options->step_error_m : min_step_error(model, island);
  island->stepping.is_routed =
      left_open && !island->stepping.substeps && !sbri_scheme_refuses(&sbri_position_based, model, island);
  return SBF_OK;
}

/* Diagonals of the bounding boxes of each body and of all bodies. */
static void measure(sbr_model *model) {
  float low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
  bool any = false;
  for (uint32_t b = 0; b < model->asset->soft_bodies.count; b++) {
    sbri_body *body = &model->bodies[b];
    const sbf_vec3_list *points = &body->source->surface.positions;
    if (!points->count && body->level) points = &body->level->positions;
    float body_low[3] = {0, 0, 0}, body_high[3] = {0, 0, 0}, square = 0;
    for (uint32_t i = 0; i < points->count; i++) {
      const float p[3] = {points->at[i].x, points->at[i].y, points->at[i].z};
      for (int k = 0; k < 3; k++) {
        if (i == 0 || p[k] < body_low[k]) body_low[k] = p[k];
        if (i == 0 || p[k] > body_high[k]) body_high[k] = p[k];
        if (!any || p[k] < low[k]) low[k] = p[k];
        if (!any || p[k] > high[k]) high[k] = p[k];
      }
      any = true;
    }
    for (int k = 0; points->count && k < 3; k++)
      square += (body_high[k] - body_low[k]) * (body_high[k] - body_low[k]);
    body->rest_size_m = sqrtf(square);
  }
  float square = 0;
  for (int k = 0; k < 3; k++) square += (high[k] - low[k]) * (high[k] - low[k]);
  model->rest_size_m = sqrtf(square);
}

/* For bodies that may tear but have no elements that can, only springs between pinned points: turns spare
 * slots into padding, since no state has their origins. */
static void return_spare_slots(const sbr_model *model, const sbri_island *island) {
  for (uint32_t b = 0; b < island->body_count; b++) {
    sbri_body *body = &model->bodies[island->bodies[b]];
    body->slots.real_end = body->slots.first_spare;
  }
}

static sbf_status make_islands(sbr_model *model, const sbr_model_options *options, sbf_diagnostic *error) {
  sbf_status status = sbri_islands_group(model, options, error);
  if (status == SBF_OK) measure(model);
  for (uint32_t i = 0; status == SBF_OK && i < model->island_count; i++) {
    sbri_island *island = &model->islands[i];
    status = choose_scheme(model, island, options, error);
    if (status == SBF_OK) status = sbri_island_make(model, island, options, error);
    if (status != SBF_OK) break;
    if (!sbri_tear_table_make(model, island)) return no_memory(error);
    island->splits = island->tetrahedra.tears || island->springs.tear;
    model->splits = model->splits || island->splits;
    if (!island->splits) return_spare_slots(model, island);
    island->first_slot = model->slot_count;
    model->slot_count += island->slot_count;
    island->links.first_block = model->counts.link_blocks;
    model->counts.link_blocks += island->links.block_count;
    island->tetrahedra.first_block = model->counts.tetrahedron_blocks;
    model->counts.tetrahedron_blocks += island->tetrahedra.block_count;
    island->tetrahedra.first_state_block = model->counts.state_tetrahedron_blocks;
    island->tetrahedra.first_state = model->counts.state_tetrahedra;
    if (island->tetrahedra.flow) {
      model->counts.state_tetrahedron_blocks += island->tetrahedra.block_count;
      model->counts.state_tetrahedra += island->tetrahedra.count;
    }
    island->links.first_flow = model->counts.flows;
    if (island->links.flows) model->counts.flows += island->links.block_count * SBRI_BLOCK;
    island->cells.first_state_cell = model->counts.torn_cells;
    island->cells.first_state_block = model->counts.torn_blocks;
    island->links.first_state_block = model->counts.torn_link_blocks;
    if (island->springs.tear) {
      model->counts.torn_cells += island->cells.begins[island->free_count / SBRI_BLOCK];
      model->counts.torn_blocks += island->free_count / SBRI_BLOCK;
      model->counts.torn_link_blocks += island->links.block_count;
    }
    island->regions.first_rotation = model->counts.region_blocks;
    model->counts.region_blocks += island->regions.block_count;
    if (island->scheme->prepare && !island->scheme->prepare(model, island)) return no_memory(error);
  }
  for (uint32_t i = 0; status == SBF_OK && i < model->island_count; i++) /* now that all slots are known */
    if (!sbri_force_parts_make(model, &model->islands[i])) return no_memory(error);
  return status;
}

/* Call when all frequencies are known. */
static sbf_status check_substeps(const sbr_model *model, sbf_diagnostic *error) {
  for (uint32_t i = 0; i < model->island_count; i++) {
    const sbri_island *island = &model->islands[i];
    if (sbri_scheme_substeps(island, 1.0 / 60, island->springs.rest_stretch) <= SBRI_MAX_SUBSTEPS) continue;
    const sbf_soft_body *body = model->bodies[island->bodies[0]].source;
    double w = sqrt(island->stability.fastest_rad_s * island->stability.fastest_rad_s +
                    island->stability.external_rad_s * island->stability.external_rad_s);
    return sbfi_diagnose(error, SBF_CODE_TOO_STIFF,
        "body \"%s\" would need more than %d substeps a tick (its fastest mode is %.3g rad/s): use more "
        "mass, less stiffness or fewer points, or the scheme position_based",
        body->id, (int)SBRI_MAX_SUBSTEPS, w);
  }
  return SBF_OK;
}

static bool make_skins(sbr_model *model) {
  const sbf_asset *asset = model->asset;
  uint32_t mesh_count = asset->render_meshes.count;
  uint32_t *first_skins = sbfi_arena_allocate(&model->arena, (size_t)mesh_count + 1, sizeof *first_skins);
  if (!first_skins) return false;
  for (uint32_t i = 0; i < mesh_count; i++) {
    first_skins[i] = model->skins.count;
    model->skins.count += 1 + asset->render_meshes.at[i].levels.count;
  }
  model->skins.first = first_skins;
  model->skins.at =
      sbfi_arena_allocate(&model->arena, (size_t)model->skins.count + 1, sizeof *model->skins.at);
  if (!model->skins.at) return false;
  for (uint32_t i = 0; i < mesh_count; i++)
    for (uint32_t l = 0; l <= asset->render_meshes.at[i].levels.count; l++)
      if (!sbri_skin_make(model, i, l)) return false;
  for (uint32_t i = 0; i < asset->soft_bodies.count; i++)
    if (!sbri_surface_make(model, i) || !sbri_samples_make(model, &model->bodies[i]) ||
        !sbri_coarse_edges_make(model, &model->bodies[i]) || !sbri_self_faces_make(model, &model->bodies[i]))
      return false;
  return true;
}

/* Bones and rigid parts; detail levels share those of the first one. */
static bool make_bones(sbr_model *model) {
  if (model->detail.base != model) {
    model->rig = model->detail.base->rig;
    model->rigid = model->detail.base->rigid;
    return true;
  }
  void *rig = sbfi_arena_allocate(&model->arena, 1, sbri_rig_size(model->asset));
  if (!rig) return false;
  sbri_rig_init(&model->rig, model->asset, rig);
  return sbri_rigid_model_make(&model->rigid, model->asset, &model->arena);
}

sbf_status sbri_model_prepare(sbr_model *model, const sbr_model_options *options, sbf_diagnostic *error) {
  model->rigid_coarse = options->rigid_coarse;
  model->rigid_substeps = options->rigid_substeps ? options->rigid_substeps
                          : options->rigid_coarse ? 1
                                                  : RIGID_SUBSTEPS;
  if (!make_bones(model) || !sbri_jiggles_make(model)) return no_memory(error);
  model->frame_count = model->rig.bones.count + 2 + model->rigid.own_frame_count + model->jiggle_count;
  if (!sbri_attachments_list(model)) return no_memory(error);
  sbf_status status = make_islands(model, options, error);
  if (status != SBF_OK) return status;
  if (!sbri_coupling_make(model) || !make_skins(model)) return no_memory(error);
  if (!sbri_rest_volumes_find(model) || !sbri_external_forces_make(model)) return no_memory(error);
  for (uint32_t i = 0; i < model->island_count; i++) {
    sbri_island *island = &model->islands[i];
    if (!island->stepping.is_routed || sbri_router_begins_explicit(island)) continue;
    island->scheme = &sbri_position_based;
    island->stepping.is_routed = false;
  }
  sbri_attached_mass_join(model);
  return check_substeps(model, error);
}
