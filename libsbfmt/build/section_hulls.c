#include "build/section_hulls.h"

#include <string.h>

#include "build/hulls.h"
#include "sbfmt/mechanics.h"

typedef struct hull_list {
  sbf_rigid_body *at;
  uint32_t count, authored_count;
} hull_list;

/* A copy of the hull for one more rigid body: polygons are shared, they are never changed. */
static bool give_hull(
    sbf_rigid_body *to, const sbf_polygon_mesh *hull, int32_t derivation, sbf_asset *asset) {
  sbf_polygon_mesh *copy = sbf_asset_allocate(asset, 1, sizeof *copy);
  if (!copy) return false;
  *copy = *hull;
  to->hull = copy;
  to->hull_derived = derivation;
  return true;
}

static bool make_rigid_body(sbf_rigid_body *to, const sbf_soft_body *body, const sbf_polygon_mesh *hull,
    int32_t derivation, sbf_asset *asset) {
  sbf_solid solid;
  sbf_solid_measure(hull, &solid);
  float density = body->attributes.density;
  sbf_rigid_body_init(to);
  to->name = body->name;
  to->bone = body->bone;
  to->derived = derivation;
  to->density = density;
  to->mass = (float)(density * solid.volume);
  to->center = solid.center;
  to->inertia = (sbf_vec3){density * solid.inertia.x, density * solid.inertia.y, density * solid.inertia.z};
  to->inertia_rotation = solid.inertia_rotation;
  to->friction = body->attributes.friction;
  to->restitution = body->attributes.restitution;
  to->layer = body->collision.layer;
  to->mask = body->collision.mask;
  return give_hull(to, hull, derivation, asset);
}

/* Whether the section needs a hull at all: 1 for authored rigid bodies of its bone, 2 for one of its own. */
static int hull_wanted(const hull_list *list, const sbf_soft_body *body) {
  int wanted = 2;
  for (uint32_t i = 0; i < list->authored_count; i++) {
    if (list->at[i].bone != body->bone) continue;
    if (!list->at[i].hull) return 1;
    wanted = 0;
  }
  return wanted;
}

static bool add_hull(hull_list *list, const sbf_soft_body *body, int wanted, const sbf_polygon_mesh *hull,
    int32_t derivation, sbf_asset *asset) {
  if (wanted == 2) return make_rigid_body(&list->at[list->count++], body, hull, derivation, asset);
  for (uint32_t i = 0; i < list->authored_count; i++)
    if (list->at[i].bone == body->bone && !list->at[i].hull &&
        !give_hull(&list->at[i], hull, derivation, asset))
      return false;
  return true;
}

static void report_flat(const sbf_soft_body *body, sbfi_reporter *reporter) {
  sbf_diagnostic finding;
  sbfi_diagnose(&finding, SBF_CODE_HULL_FLAT,
      "section \"%s\" is flat: it gets no convex hull, and its bone no rigid body", body->name);
  sbfi_report(reporter, &finding);
}

bool sbfi_section_hulls_make(sbf_asset *asset, int32_t derivation, sbfi_ids *ids, sbfi_reporter *reporter,
    uint32_t *made, sbfi_arena *scratch) {
  uint32_t authored = asset->rigid_bodies.count;
  size_t most = (size_t)authored + asset->soft_bodies.count;
  hull_list list = {sbf_asset_allocate(asset, most, sizeof *list.at), authored, authored};
  *made = 0;
  if (most == 0) return true;
  if (!list.at) return false;
  if (authored) memcpy(list.at, asset->rigid_bodies.at, authored * sizeof *list.at);
  for (uint32_t b = 0; b < asset->soft_bodies.count; b++) {
    const sbf_soft_body *body = &asset->soft_bodies.at[b];
    int wanted = body->bone == SBF_NONE ? 0 : hull_wanted(&list, body);
    if (!wanted || body->surface.positions.count == 0) continue;
    sbf_polygon_mesh hull;
    switch (
        sbfi_hull_make(body->surface.positions.at, body->surface.positions.count, asset, &hull, scratch)) {
    case SBFI_HULL_NO_MEMORY:
      return false;
    case SBFI_HULL_FLAT:
      report_flat(body, reporter);
      continue;
    case SBFI_HULL_MADE:
      break;
    }
    if (!add_hull(&list, body, wanted, &hull, derivation, asset)) return false;
    if (wanted == 2) {
      sbf_rigid_body *own = &list.at[list.count - 1];
      own->id = sbfi_unique_id(ids, "hull_", body->id, list.count - 1, asset);
      if (!own->id) return false;
    }
    ++*made;
  }
  asset->rigid_bodies = (sbf_rigid_body_list){list.count ? list.at : NULL, list.count};
  return true;
}
