#include "build/sections/sections.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "build/sections/authored_sections.h"
#include "build/sections/section_blend.h"
#include "build/sections/section_caps.h"
#include "build/sections/section_cut.h"
#include "build/sections/section_frame.h"
#include "build/sections/section_labels.h"
#include "build/sections/section_merge.h"
#include "build/sections/section_sole.h"
#include "mechanics/bearing_modulus.h"
#include "mechanics/flat_body.h"
#include "mechanics/vector.h"
#include "sbfmt/mechanics.h"

static const float SINGLE_WEIGHT = 0.98f; /* minimum weight of a point with a single bone */

typedef struct weighted_point {
  uint32_t bone, mix;
  float weight;
} weighted_point;

typedef struct work {
  sbf_asset *asset;
  sbfi_sections *made;
  sbfi_ids *ids;
  sbfi_reporter *reporter;
  sbfi_arena *scratch;
  int32_t derivation;
  sbfi_skin_union skin;
  sbfi_topology t;
  uint32_t *labels;              /* (polygons) */
  uint32_t *owners;              /* (bones) */
  uint8_t *rigid;                /* (bones) its part is not a section */
  uint32_t *contribution_begins; /* (points + 1) */
  weighted_point *contributions; /* weights of sections at each point */
  sbfi_array mixes;
  uint32_t guessed_count; /* sections without a stated material */
  float min_guess, max_guess;
} work;

static void report(const work *w, uint32_t bone, sbf_code code, uint32_t sides) {
  sbf_diagnostic diagnostic;
  sbfi_diagnose(&diagnostic, code,
      "%u polygon edges of the section on bone \"%s\" are where several sheets meet: the section stays open "
      "there",
      (unsigned)sides, w->asset->bones.at[bone].name);
  sbfi_report(w->reporter, &diagnostic);
}

const sbf_section_recipe *sbfi_section_recipe_find(const sbf_asset *asset, int32_t bone) {
  const sbf_section_recipe *general = NULL;
  for (uint32_t i = asset->section_recipes.count; i-- > 0;) {
    const sbf_section_recipe *recipe = &asset->section_recipes.at[i];
    if (recipe->bone == bone) return recipe;
    if (recipe->bone == SBF_NONE && !general) general = recipe;
  }
  return general;
}

static bool own(sbf_asset *asset, const void **at, size_t count, size_t size) {
  void *copy = sbf_asset_allocate(asset, count ? count : 1, size);
  if (copy && count) memcpy(copy, *at, count * size);
  *at = copy;
  return copy != NULL;
}

/* Reverses all polygons. */
static void reverse_polygons(sbf_polygon_mesh *mesh) {
  uint32_t *points = (uint32_t *)(uintptr_t)mesh->polygon_points.at; /* owned by this pass */
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; points += mesh->polygon_sizes.at[p++])
    for (uint32_t i = 0, j = mesh->polygon_sizes.at[p] - 1; i < j; i++, j--) {
      uint32_t point = points[i];
      points[i] = points[j];
      points[j] = point;
    }
}

/* Copies the part of a pin set that is in the current section; false if memory runs out. */
static bool copy_pins(work *w, const sbfi_section_cutter *cutter, const sbf_pin_set *from,
    const uint32_t *points_of, int32_t bone, sbf_pin_set *to) {
  uint32_t count = 0;
  uint32_t *points = sbf_asset_allocate(w->asset, (size_t)from->points.count + 1, sizeof *points);
  float *weights = sbf_asset_allocate(w->asset, (size_t)from->points.count + 1, sizeof *weights);
  if (!points || !weights) return false;
  for (uint32_t i = 0; i < from->points.count; i++) {
    points[count] = cutter->new_points[points_of[from->points.at[i]]];
    if (points[count] == SBFI_NO_INDEX) continue;
    weights[count++] = from->weights.count == 0 ? 1 : from->weights.at[from->weights.count == 1 ? 0 : i];
  }
  *to = *from;
  if (from->bone == SBF_NONE && from->rigid_body == SBF_NONE) to->bone = bone;
  to->offsets = (sbf_vec3_list){NULL, 0};
  to->points = (sbf_u32_list){count ? points : NULL, count};
  to->weights = (sbf_f32_list){count ? weights : NULL, count};
  return true;
}

/* Copies pins painted on the skins to the current section. */
static bool make_pins(work *w, const sbfi_section_cutter *cutter, sbf_soft_body *body) {
  const sbf_render_mesh_list *meshes = &w->asset->render_meshes;
  uint32_t max = 0, count = 0;
  for (uint32_t m = 0; m < meshes->count; m++)
    if (w->skin.points_of_mesh[m]) max += meshes->at[m].pins.count;
  if (max == 0) return true;
  sbf_pin_set *sets = sbf_asset_allocate(w->asset, max, sizeof *sets);
  if (!sets) return false;
  for (uint32_t m = 0; m < meshes->count; m++)
    for (uint32_t i = 0; w->skin.points_of_mesh[m] && i < meshes->at[m].pins.count; i++) {
      if (!copy_pins(
              w, cutter, &meshes->at[m].pins.at[i], w->skin.points_of_mesh[m], body->bone, &sets[count]))
        return false;
      count += sets[count].points.count > 0;
    }
  body->pins = (sbf_pin_set_list){count ? sets : NULL, count};
  return true;
}

static bool make_body(work *w, sbfi_section_cutter *cutter, uint32_t bone, sbf_soft_body *body) {
  sbf_soft_body_init(body);
  sbf_polygon_mesh *mesh = &body->surface;
  sbfi_caps caps;
  sbf_surface_measures measures;
  if (!sbfi_section_cut(cutter, bone, mesh, w->scratch)) return false;
  if (!sbfi_section_caps_make(mesh, &caps, w->scratch)) return false;
  sbf_surface_measure(mesh, NULL, &measures);
  if (measures.volume < 0) reverse_polygons(mesh);
  if (caps.left_sides) report(w, bone, SBF_CODE_SECTION_OPEN, caps.left_sides);
  if (!own(w->asset, (const void **)&mesh->positions.at, mesh->positions.count, sizeof(sbf_vec3)) ||
      !own(w->asset, (const void **)&mesh->polygon_sizes.at, mesh->polygon_sizes.count, sizeof(uint32_t)) ||
      !own(w->asset, (const void **)&mesh->polygon_points.at, mesh->polygon_points.count, sizeof(uint32_t)))
    return false;
  const sbf_bone *on = &w->asset->bones.at[bone];
  body->name = on->name;
  body->id =
      sbfi_unique_id(w->ids, "section_", on->id, w->asset->soft_bodies.count + w->made->count, w->asset);
  body->bone = (int32_t)bone;
  body->derived = w->derivation;
  if (!make_pins(w, cutter, body)) return false;
  const sbf_section_recipe *recipe = sbfi_section_recipe_find(w->asset, body->bone);
  if (recipe) {
    body->attributes = recipe->attributes;
    body->collision = recipe->collision;
  } else {
    /* Without a stated material: as stiff as needed to carry its weight. */
    body->attributes.young_modulus = (float)sbfi_bearing_modulus(&body->attributes, &body->surface.positions);
    body->attributes.sag_free = true;
    float modulus = body->attributes.young_modulus;
    if (w->guessed_count == 0 || modulus < w->min_guess) w->min_guess = modulus;
    if (w->guessed_count == 0 || modulus > w->max_guess) w->max_guess = modulus;
    w->guessed_count++;
  }
  sbfi_flat_body_weigh(body);
  return body->id != NULL;
}

/* Creates the inputs of hulls for rigid parts. */
static bool make_rigid_parts(work *w, sbfi_section_cutter *cutter, const uint8_t *used) {
  uint32_t bones = w->asset->bones.count;
  w->made->rigid_parts = sbfi_arena_allocate(w->scratch, (size_t)bones + 1, sizeof *w->made->rigid_parts);
  if (!w->made->rigid_parts) return false;
  for (uint32_t b = 0; b < bones; b++) {
    if (!used[b] || !w->rigid[b]) continue;
    sbf_soft_body *part = &w->made->rigid_parts[w->made->rigid_count++];
    const sbf_section_recipe *recipe = sbfi_section_recipe_find(w->asset, (int32_t)b);
    sbf_soft_body_init(part);
    part->name = w->asset->bones.at[b].name;
    part->id = sbfi_unique_id(w->ids, "section_", w->asset->bones.at[b].id, b, w->asset);
    part->bone = (int32_t)b;
    part->derived = w->derivation;
    part->attributes = recipe->attributes;
    part->collision = recipe->collision;
    if (!part->id || !sbfi_section_cut(cutter, b, &part->surface, w->scratch)) return false;
  }
  return true;
}

static bool make_bodies(work *w, double overlap_m, sbfi_progress progress) {
  uint32_t bones = w->asset->bones.count;
  sbfi_section_cutter cutter = {.skin = &w->skin, .t = &w->t, .labels = w->labels, .overlap_m = overlap_m};
  uint8_t *used = sbfi_arena_allocate(w->scratch, (size_t)bones + 1, 1);
  w->made->bodies = sbf_asset_allocate(w->asset, (size_t)bones + 1, sizeof *w->made->bodies);
  if (!used || !w->made->bodies || !sbfi_section_cutter_init(&cutter, bones, w->scratch)) return false;
  for (uint32_t p = 0; p < w->t.polygon_count; p++)
    if (w->labels[p] != SBFI_NO_INDEX) used[w->labels[p]] = 1;
  for (uint32_t b = 0; b < bones; b++) {
    if (!used[b] || w->rigid[b]) continue;
    if (!sbfi_progress_report(progress, (double)b / bones)) return false;
    if (!make_body(w, &cutter, b, &w->made->bodies[w->made->count++])) return false;
  }
  return make_rigid_parts(w, &cutter, used);
}

static void report_guesses(const work *w) {
  sbf_diagnostic diagnostic;
  char range[64] = "";
  if (w->guessed_count == 0) return;
  if (w->max_guess > w->min_guess) snprintf(range, sizeof range, "%.6g to ", 1e-3 * (double)w->min_guess);
  sbfi_diagnose(&diagnostic, SBF_CODE_MATERIAL_GUESSED,
      "%u section%s cut from skins had no material: %s%.6g kPa is used, which carries the weight; choose a "
      "material, for example --material flesh",
      (unsigned)w->guessed_count, w->guessed_count == 1 ? "" : "s", range, 1e-3 * (double)w->max_guess);
  sbfi_report(w->reporter, &diagnostic);
}

/* Whether the bone's region belongs to a section. */
static bool is_soft(const work *w, uint32_t bone) {
  return w->owners[bone] != SBFI_NO_INDEX && !w->rigid[w->owners[bone]];
}

/* Reports if smoothing fails, as on nearly degenerate triangles. */
static bool smooth_blends(work *w) {
  uint32_t left;
  sbf_diagnostic diagnostic;
  const sbfi_skin_union authored = w->skin;
  uint8_t *soles = sbfi_arena_allocate(w->scratch, (size_t)w->skin.mesh.positions.count + 1, 1);
  uint8_t *soft = sbfi_arena_allocate(w->scratch, (size_t)w->asset->bones.count + 1, 1);
  if (!soles || !soft || !sbfi_soles_gather(&w->skin, w->asset, soles, w->scratch)) return false;
  for (uint32_t b = 0; b < w->asset->bones.count; b++) soft[b] = is_soft(w, b);
  if (!sbfi_section_blend_smooth(&w->skin, &authored, &w->t, w->asset, soft, soles, &left, NULL, w->scratch))
    return false;
  if (left == 0) return true;
  sbfi_diagnose(&diagnostic, SBF_CODE_SECTION_STRETCHED,
      "%u triangles of the skin stretch to more than twice their area when a joint bends by 60 degrees",
      (unsigned)left);
  sbfi_report(w->reporter, &diagnostic);
  return true;
}

/* Whether the bone's region belongs to no section. */
static bool is_rigid(const work *w, uint32_t bone) {
  return w->owners[bone] != SBFI_NO_INDEX && w->rigid[w->owners[bone]];
}

static uint32_t section_on(const work *w, uint32_t bone) {
  uint32_t section = 0;
  while (w->made->bodies[section].bone != (int32_t)bone) section++;
  return section;
}

/* Creates the mix of `owner` at the point, or with `beside` that of rigid bones; SBFI_NO_INDEX if only its
 * own bone has weight. */
static bool make_mix(work *w, uint32_t point, uint32_t owner, bool beside, uint32_t *number) {
  sbfi_mix mix = {
      .section = section_on(w, owner), .position = w->skin.mesh.positions.at[point], .beside = beside};
  bool foreign = beside;
  float sum = 0;
  for (uint32_t h = w->skin.bone_weight_begins[point]; h < w->skin.bone_weight_begins[point + 1]; h++) {
    sbfi_bone_weight bone_weight = w->skin.bone_weights[h];
    if (beside ? !is_rigid(w, bone_weight.bone) : w->owners[bone_weight.bone] != owner) continue;
    foreign = foreign || bone_weight.bone != owner;
    uint32_t at = mix.count < 4 ? mix.count++ : 3;
    if (at == 3 && mix.weights[3] >= bone_weight.weight) continue;
    for (; at > 0 && mix.weights[at - 1] < bone_weight.weight; at--) {
      mix.bones[at] = mix.bones[at - 1];
      mix.weights[at] = mix.weights[at - 1];
    }
    mix.bones[at] = bone_weight.bone;
    mix.weights[at] = bone_weight.weight;
  }
  *number = SBFI_NO_INDEX;
  if (!foreign) return true;
  for (uint32_t k = 0; k < mix.count; k++) sum += mix.weights[k];
  for (uint32_t k = 0; k < mix.count; k++) mix.weights[k] /= sum;
  *number = (uint32_t)w->mixes.count;
  return sbfi_array_append(&w->mixes, &mix, 1);
}

/* Adds the weights of rigid bones to the section with the greatest weight; without sections the skin moves
 * the point. */
static bool distribute_rest(work *w, uint32_t point, uint32_t begin, uint32_t *next) {
  uint32_t max = begin;
  float rest = 0;
  for (uint32_t h = w->skin.bone_weight_begins[point]; h < w->skin.bone_weight_begins[point + 1]; h++)
    if (is_rigid(w, w->skin.bone_weights[h].bone)) rest += w->skin.bone_weights[h].weight;
  for (uint32_t i = begin; i < *next; i++)
    if (w->contributions[i].weight > w->contributions[max].weight) max = i;
  if (*next == begin || !(rest > 0)) return true;
  weighted_point *beside = &w->contributions[(*next)++];
  *beside = (weighted_point){.bone = w->contributions[max].bone, .weight = rest};
  return make_mix(w, point, beside->bone, true, &beside->mix);
}

/* Distributes the weights of each point over sections. */
static bool distribute_points(work *w) {
  uint32_t points = w->skin.mesh.positions.count;
  w->contribution_begins =
      sbfi_arena_allocate(w->scratch, (size_t)points + 1, sizeof *w->contribution_begins);
  w->contributions = sbfi_arena_allocate(
      w->scratch, (size_t)w->skin.bone_weight_begins[points] + 1, sizeof *w->contributions);
  if (!w->contribution_begins || !w->contributions) return false;
  uint32_t next = 0;
  for (uint32_t p = 0; p < points; p++) {
    uint32_t begin = w->contribution_begins[p] = next;
    for (uint32_t h = w->skin.bone_weight_begins[p]; h < w->skin.bone_weight_begins[p + 1]; h++) {
      uint32_t owner = w->owners[w->skin.bone_weights[h].bone], at = begin;
      if (!is_soft(w, w->skin.bone_weights[h].bone)) continue;
      while (at < next && w->contributions[at].bone != owner) at++;
      if (at == next) w->contributions[next++].bone = owner;
      w->contributions[at].weight += w->skin.bone_weights[h].weight;
    }
    for (uint32_t i = begin; i < next; i++)
      if (!make_mix(w, p, w->contributions[i].bone, false, &w->contributions[i].mix)) return false;
    if (!distribute_rest(w, p, begin, &next)) return false;
  }
  w->contribution_begins[points] = next;
  return true;
}

/* Converts weights of points to those of a mesh's vertices. */
static bool make_blends(work *w, uint32_t mesh, sbf_skin *skin) {
  const uint32_t *points = w->skin.points_of_mesh[mesh];
  uint32_t vertices = w->asset->render_meshes.at[mesh].mesh.positions.count, total = 0, next = 0;
  if (!points) return true;
  for (uint32_t v = 0; v < vertices; v++)
    total += w->contribution_begins[points[v] + 1] - w->contribution_begins[points[v]];
  uint32_t *counts = sbfi_arena_allocate(w->scratch, (size_t)vertices + 1, sizeof *counts);
  uint32_t *bones = sbfi_arena_allocate(w->scratch, (size_t)total + 1, sizeof *bones);
  float *weights = sbfi_arena_allocate(w->scratch, (size_t)total + 1, sizeof *weights);
  uint32_t *mixes = sbfi_arena_allocate(w->scratch, (size_t)total + 1, sizeof *mixes);
  if (!counts || !bones || !weights || !mixes) return false;
  for (uint32_t v = 0; v < vertices; v++) {
    counts[v] = w->contribution_begins[points[v] + 1] - w->contribution_begins[points[v]];
    for (uint32_t i = w->contribution_begins[points[v]]; i < w->contribution_begins[points[v] + 1]; i++) {
      bones[next] = w->contributions[i].bone;
      weights[next] = w->contributions[i].weight;
      mixes[next++] = w->contributions[i].mix;
    }
  }
  sbf_skin_init(skin);
  skin->influence_counts = (sbf_u32_list){counts, vertices};
  skin->bones = (sbf_u32_list){bones, next};
  skin->weights = (sbf_f32_list){weights, next};
  w->made->mixes_of_blends[mesh] = mixes;
  return true;
}

static bool make_all_blends(work *w) {
  sbfi_array_init(&w->mixes, &w->scratch->allocator, sizeof(sbfi_mix));
  bool good = distribute_points(w);
  for (uint32_t m = 0; good && m < w->asset->render_meshes.count; m++)
    good = make_blends(w, m, &w->made->blends[m]);
  w->made->mix_count = (uint32_t)w->mixes.count;
  if (good && w->mixes.count) {
    w->made->mixes = sbfi_arena_copy(w->scratch, w->mixes.at, w->mixes.count, sizeof(sbfi_mix));
    good = w->made->mixes != NULL;
  }
  sbfi_array_free(&w->mixes);
  return good;
}

static void reach_to(sbfi_sections *made, uint32_t section, sbfi_d3 middle, sbf_vec3 point) {
  double away = sbfi_d3_length(sbfi_d3_sub(sbfi_d3_of(point), middle));
  if (away > made->reaches_m[section]) made->reaches_m[section] = away;
}

/* Computes each section's distance from its centre to the farthest point of its surface or its vertices. */
static bool measure_reaches(work *w) {
  sbfi_sections *made = w->made;
  uint32_t *section_of_bone =
      sbfi_arena_allocate(w->scratch, (size_t)w->asset->bones.count + 1, sizeof(uint32_t));
  sbfi_d3 *middles = sbfi_arena_allocate(w->scratch, (size_t)made->count + 1, sizeof *middles);
  made->reaches_m = sbfi_arena_allocate(w->scratch, (size_t)made->count + 1, sizeof *made->reaches_m);
  if (!section_of_bone || !middles || !made->reaches_m) return false;
  for (uint32_t i = 0; i < made->count; i++) {
    section_of_bone[made->bodies[i].bone] = i;
    middles[i] = sbfi_section_middle(&made->bodies[i]);
    const sbf_vec3_list *surface = &made->bodies[i].surface.positions;
    for (uint32_t p = 0; p < surface->count; p++) reach_to(made, i, middles[i], surface->at[p]);
  }
  for (uint32_t m = 0; m < w->asset->render_meshes.count; m++) {
    const sbf_skin *skin = &made->blends[m];
    const sbf_vec3 *at = w->asset->render_meshes.at[m].mesh.positions.at;
    for (uint32_t v = 0, i = 0; v < skin->influence_counts.count; v++)
      for (uint32_t end = i + skin->influence_counts.at[v]; i < end; i++) {
        uint32_t section = section_of_bone[skin->bones.at[i]];
        reach_to(made, section, middles[section], at[v]);
      }
  }
  return true;
}

/* Fills chosen (render meshes) with the skins to cut. */
static bool choose(const sbf_asset *asset, uint8_t **chosen, bool *wanted, sbfi_arena *scratch) {
  uint32_t count, meshes = asset->render_meshes.count;
  *chosen = sbfi_arena_allocate(scratch, (size_t)meshes + 1, 1);
  uint8_t *sectioned = sbfi_arena_allocate(scratch, (size_t)meshes + 1, 1);
  if (!*chosen || !sectioned || !sbfi_skins_choose(asset, *chosen, &count, scratch)) return false;
  *wanted = count > 0 && asset->bones.count > 0;
  if (!*wanted) return true;
  if (!sbfi_authored_sections_find(asset, asset->soft_bodies.count, sectioned, scratch)) return false;
  for (uint32_t m = 0; m < meshes; m++) *wanted = *wanted && !sectioned[m];
  return true;
}

bool sbfi_sections_are_wanted(const sbf_asset *asset, bool *wanted, sbfi_arena *scratch) {
  uint8_t *chosen;
  return choose(asset, &chosen, wanted, scratch);
}

/* Assigns the skin's polygons to sections, and bones to owners. `*wanted` is false if there is nothing to
 * cut. */
static bool divide(work *w, bool *wanted) {
  const sbf_asset *asset = w->asset;
  uint8_t *chosen;
  if (!choose(asset, &chosen, wanted, w->scratch)) return false;
  if (!*wanted) return true;
  if (!sbfi_skin_union_make(&w->skin, asset, chosen, w->scratch)) return false;
  if (!sbfi_topology_build(&w->t, &w->skin.mesh, w->scratch)) return false;
  w->labels = sbfi_arena_allocate(w->scratch, (size_t)w->t.polygon_count + 1, sizeof *w->labels);
  w->owners = sbfi_arena_allocate(w->scratch, (size_t)asset->bones.count + 1, sizeof *w->owners);
  w->rigid = sbfi_arena_allocate(w->scratch, (size_t)asset->bones.count + 1, 1);
  if (!w->rigid) return false;
  for (uint32_t b = 0; b < asset->bones.count; b++) {
    const sbf_section_recipe *recipe = sbfi_section_recipe_find(asset, (int32_t)b);
    w->rigid[b] = recipe && recipe->rigid;
  }
  return w->labels && w->owners &&
         sbfi_section_labels_make(w->labels, &w->skin, &w->t, asset->bones.count, w->scratch) &&
         sbfi_sections_merge(w->labels, w->owners, &w->skin, &w->t, asset, w->reporter, w->scratch);
}

bool sbfi_section_owners_find(const uint32_t **owners, const sbf_asset *asset, sbfi_arena *scratch) {
  sbfi_reporter nobody = {.report = NULL};
  /* The asset is not modified here. */
  work w = {.asset = (sbf_asset *)(uintptr_t)asset, .reporter = &nobody, .scratch = scratch};
  bool wanted, good = divide(&w, &wanted);
  *owners = w.owners;
  return good;
}

/* Fraction of the points with a single bone. */
static double single_fraction(const work *w) {
  uint32_t pinned = 0, single = 0;
  for (uint32_t p = 0; p < w->skin.mesh.positions.count; p++) {
    float max = 0;
    for (uint32_t h = w->skin.bone_weight_begins[p]; h < w->skin.bone_weight_begins[p + 1]; h++)
      max = fmaxf(max, w->skin.bone_weights[h].weight);
    pinned += max > 0;
    single += max >= SINGLE_WEIGHT;
  }
  return pinned ? (double)single / pinned : 0;
}

static bool measure_parts(work *w, sbfi_skin_parts *to) {
  uint32_t bones = w->asset->bones.count;
  sbfi_section_cutter cutter = {.skin = &w->skin, .t = &w->t, .labels = w->labels, .overlap_m = 1e-9};
  if (!sbfi_section_cutter_init(&cutter, bones, w->scratch)) return false;
  for (uint32_t p = 0; p < w->t.polygon_count; p++)
    if (w->labels[p] != SBFI_NO_INDEX) to->at[w->labels[p]].polygons++;
  for (uint32_t b = 0; b < bones; b++) {
    sbf_polygon_mesh mesh;
    sbf_surface_measures measures;
    sbfi_caps caps;
    if (to->at[b].polygons == 0) continue;
    if (!sbfi_section_cut(&cutter, b, &mesh, w->scratch)) return false;
    sbf_surface_measure(&mesh, NULL, &measures);
    to->at[b].area = measures.area;
    if (!sbfi_section_caps_make(&mesh, &caps, w->scratch)) return false;
    sbf_surface_measure(&mesh, NULL, &measures);
    to->at[b].closed_area = measures.area;
    to->at[b].volume = fabs(measures.volume);
  }
  return true;
}

bool sbfi_skin_parts_measure(sbfi_skin_parts *to, const sbf_asset *asset, sbfi_arena *scratch) {
  sbfi_reporter nobody = {.report = NULL};
  work w = {.asset = (sbf_asset *)(uintptr_t)asset, .reporter = &nobody, .scratch = scratch}; /* as above */
  bool wanted;
  *to = (sbfi_skin_parts){.at = NULL};
  if (!divide(&w, &wanted)) return false;
  if (!wanted) return true;
  to->at = sbfi_arena_allocate(scratch, (size_t)asset->bones.count + 1, sizeof *to->at);
  to->owners = w.owners;
  to->single_fraction = single_fraction(&w);
  return to->at && measure_parts(&w, to);
}

bool sbfi_sections_make(sbfi_sections *made, sbf_asset *asset, double overlap_m, int32_t derivation,
    sbfi_ids *ids, sbfi_reporter *reporter, sbfi_progress progress, sbfi_arena *scratch) {
  work w = {.asset = asset,
      .made = made,
      .ids = ids,
      .reporter = reporter,
      .scratch = scratch,
      .derivation = derivation};
  *made = (sbfi_sections){.count = 0};
  bool wanted;
  if (!divide(&w, &wanted)) return false;
  if (!wanted) return true;
  size_t meshes = (size_t)asset->render_meshes.count + 1;
  made->blends = sbfi_arena_allocate(scratch, meshes, sizeof *made->blends);
  made->mixes_of_blends = sbfi_arena_allocate(scratch, meshes, sizeof *made->mixes_of_blends);
  if (!made->blends || !made->mixes_of_blends) return false;
  if (!make_bodies(&w, overlap_m, sbfi_progress_part(progress, 0.2, 0.6))) return false;
  report_guesses(&w);
  if (!smooth_blends(&w)) return false;
  return sbfi_progress_report(progress, 0.8) && make_all_blends(&w) && measure_reaches(&w);
}
