#include "build/sections/section_hulls.h"

#include <string.h>

#include "build/geometry/hulls.h"
#include "sbfmt/mechanics.h"

/* minimum filled fraction of a hull: less is a shell without volume for its mass */
static const double MIN_FILLED = 0.05;

typedef struct hull_list {
  sbf_rigid_body *at;
  uint32_t count, authored_count;
} hull_list;

/* Copies the hull for another rigid body: polygons are shared because they never change. */
static bool copy_hull(
    sbf_rigid_body *to, const sbf_polygon_mesh *hull, int32_t derivation, sbf_asset *asset) {
  sbf_polygon_mesh *copy = sbf_asset_allocate(asset, 1, sizeof *copy);
  if (!copy) return false;
  *copy = *hull;
  to->hull = copy;
  to->hull_derived = derivation;
  return true;
}

/* Fraction of its hull that a rigid part of the skin fills, because hulls of neighbours overlap. A
 * section's rigid body represents the whole hull. */
static float filled_of(const sbf_soft_body *body, const sbf_solid *hull) {
  if (body->levels.count || !(hull->volume > 0)) return 1;
  sbf_surface_measures own;
  sbf_surface_measure(&body->surface, NULL, &own);
  double filled = own.volume / hull->volume;
  return filled > MIN_FILLED && filled < 1 ? (float)filled : 1;
}

static bool make_rigid_body(sbf_rigid_body *to, const sbf_soft_body *body, const sbf_polygon_mesh *hull,
    int32_t derivation, sbf_asset *asset) {
  sbf_solid solid;
  sbf_solid_measure(hull, &solid);
  float density = body->attributes.density, spread = density * filled_of(body, &solid);
  sbf_rigid_body_init(to);
  to->name = body->name;
  to->bone = body->bone;
  to->derived = derivation;
  to->density = density;
  to->mass = (float)(spread * solid.volume);
  to->center = solid.center;
  to->inertia = (sbf_vec3){spread * solid.inertia.x, spread * solid.inertia.y, spread * solid.inertia.z};
  to->inertia_rotation = solid.inertia_rotation;
  to->friction = body->attributes.friction;
  to->restitution = body->attributes.restitution;
  to->layer = body->collision.layer;
  to->mask = body->collision.mask;
  return copy_hull(to, hull, derivation, asset);
}

static bool has_authored_body(const hull_list *list, int32_t bone) {
  for (uint32_t i = 0; i < list->authored_count; i++)
    if (list->at[i].bone == bone) return true;
  return false;
}

static void report_flat(const char *what, const char *name, sbfi_reporter *reporter) {
  sbf_diagnostic diagnostic;
  sbfi_diagnose(&diagnostic, SBF_CODE_HULL_FLAT, "%s \"%s\" is flat and has no convex hull", what, name);
  sbfi_report(reporter, &diagnostic);
}

/* Concatenates the surface points of all sections of a bone. */
static bool points_of_bone(const sbf_asset *asset, int32_t bone, sbf_vec3_list *points, sbfi_arena *scratch) {
  size_t count = 0;
  for (uint32_t b = 0; b < asset->soft_bodies.count; b++)
    if (asset->soft_bodies.at[b].bone == bone) count += asset->soft_bodies.at[b].surface.positions.count;
  *points = (sbf_vec3_list){NULL, 0};
  if (count == 0) return true;
  sbf_vec3 *all = sbfi_arena_allocate(scratch, count, sizeof *all);
  if (!all) return false;
  points->at = all;
  for (uint32_t b = 0; b < asset->soft_bodies.count; b++) {
    const sbf_vec3_list from = asset->soft_bodies.at[b].surface.positions;
    if (asset->soft_bodies.at[b].bone != bone || from.count == 0) continue;
    memcpy(all + points->count, from.at, from.count * sizeof *all);
    points->count += from.count;
  }
  return true;
}

static bool fill_authored(hull_list *list, sbf_asset *asset, int32_t derivation, sbfi_reporter *reporter,
    uint32_t *made, sbfi_progress progress, sbfi_arena *scratch) {
  for (uint32_t i = 0; i < list->authored_count; i++) {
    if (!sbfi_progress_report(progress, (double)i / list->authored_count)) return false;
    sbf_rigid_body *body = &list->at[i];
    sbf_vec3_list points;
    sbf_polygon_mesh hull;
    if (body->hull || body->bone == SBF_NONE) continue;
    if (!points_of_bone(asset, body->bone, &points, scratch)) return false;
    if (points.count == 0) continue;
    sbfi_hull_outcome outcome = sbfi_hull_make(points.at, points.count, asset, &hull, scratch);
    if (outcome == SBFI_HULL_FLAT) report_flat("what moves with rigid body", body->name, reporter);
    if (outcome == SBFI_HULL_FLAT) continue;
    if (outcome == SBFI_HULL_NO_MEMORY || !copy_hull(body, &hull, derivation, asset)) return false;
    ++*made;
  }
  return true;
}

static bool make_own(hull_list *list, sbf_asset *asset, int32_t derivation, sbfi_ids *ids,
    sbfi_reporter *reporter, uint32_t *made, sbfi_progress progress, sbfi_arena *scratch) {
  for (uint32_t b = 0; b < asset->soft_bodies.count; b++) {
    if (!sbfi_progress_report(progress, (double)b / asset->soft_bodies.count)) return false;
    const sbf_soft_body *body = &asset->soft_bodies.at[b];
    sbf_polygon_mesh hull;
    if (body->bone == SBF_NONE || has_authored_body(list, body->bone) || body->surface.positions.count == 0)
      continue;
    sbfi_hull_outcome outcome =
        sbfi_hull_make(body->surface.positions.at, body->surface.positions.count, asset, &hull, scratch);
    if (outcome == SBFI_HULL_FLAT) report_flat("section", body->name, reporter);
    if (outcome == SBFI_HULL_FLAT) continue;
    sbf_rigid_body *own = &list->at[list->count];
    if (outcome == SBFI_HULL_NO_MEMORY || !make_rigid_body(own, body, &hull, derivation, asset)) return false;
    own->id = sbfi_unique_id(ids, "hull_", body->id, list->count, asset);
    if (!own->id) return false;
    list->count++;
    ++*made;
  }
  return true;
}

bool sbfi_section_hulls_make(sbf_asset *asset, int32_t derivation, sbfi_ids *ids, sbfi_reporter *reporter,
    uint32_t *made, sbfi_progress progress, sbfi_arena *scratch) {
  uint32_t authored = asset->rigid_bodies.count;
  size_t max = (size_t)authored + asset->soft_bodies.count;
  *made = 0;
  if (max == 0) return true;
  hull_list list = {sbf_asset_allocate(asset, max, sizeof *list.at), authored, authored};
  if (!list.at) return false;
  if (authored) memcpy(list.at, asset->rigid_bodies.at, authored * sizeof *list.at);
  if (!fill_authored(
          &list, asset, derivation, reporter, made, sbfi_progress_part(progress, 0, 0.5), scratch) ||
      !make_own(&list, asset, derivation, ids, reporter, made, sbfi_progress_part(progress, 0.5, 1), scratch))
    return false;
  asset->rigid_bodies = (sbf_rigid_body_list){list.count ? list.at : NULL, list.count};
  return true;
}
