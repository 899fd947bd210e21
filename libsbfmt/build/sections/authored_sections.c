#include "build/sections/authored_sections.h"

#include <math.h>
#include <string.h>

#include "build/geometry/topology.h"
#include "build/geometry/triangle_tree.h"
#include "mechanics/extent.h"

/* Maximum distance to the surface as a fraction of the body's extent. */
static const double AT_SURFACE = 0.05;
/* Minimum fraction of a skin's vertices at its sections; and minimum fraction of all skins of its skeleton,
 * so that the skin of a single material is not decisive. */
static const double SECTIONED_PART = 0.5, PART_OF_ALL = 0.2;

typedef struct body_side {
  sbfi_triangle_tree surface;
  double squared_reach; /* m^2 */
  uint32_t next;        /* next body on the same bone; SBFI_NO_INDEX: none */
} body_side;

typedef struct work {
  const sbf_asset *asset;
  body_side *bodies;
  uint32_t *bone_bodies; /* (bones) first body of the bone or its nearest ancestor; SBFI_NO_INDEX: none */
} work;

static bool index_bodies(work *w, uint32_t body_count, sbfi_arena *scratch) {
  const sbf_asset *asset = w->asset;
  uint32_t bones = asset->bones.count;
  w->bodies = sbfi_arena_allocate(scratch, (size_t)body_count + 1, sizeof *w->bodies);
  w->bone_bodies = sbfi_arena_allocate(scratch, (size_t)bones + 1, sizeof *w->bone_bodies);
  if (!w->bodies || !w->bone_bodies) return false;
  memset(w->bone_bodies, 0xff, bones * sizeof *w->bone_bodies);
  for (uint32_t b = body_count; b-- > 0;) {
    const sbf_soft_body *body = &asset->soft_bodies.at[b];
    if (body->bone == SBF_NONE) continue;
    if (!sbfi_triangle_tree_build(&w->bodies[b].surface, &body->surface, scratch)) return false;
    w->bodies[b].squared_reach = pow(AT_SURFACE * sbfi_extent(body->surface.positions), 2);
    w->bodies[b].next = w->bone_bodies[body->bone];
    w->bone_bodies[body->bone] = b;
  }
  /* Parents come before their children. */
  for (uint32_t i = 0; i < bones; i++)
    if (w->bone_bodies[i] == SBFI_NO_INDEX && asset->bones.at[i].parent != SBF_NONE)
      w->bone_bodies[i] = w->bone_bodies[asset->bones.at[i].parent];
  return true;
}

static bool is_at_body(const work *w, uint32_t bone, sbf_vec3 vertex) {
  for (uint32_t b = w->bone_bodies[bone]; b != SBFI_NO_INDEX; b = w->bodies[b].next) {
    double min = w->bodies[b].squared_reach;
    if (sbfi_triangle_tree_nearest(&w->bodies[b].surface, vertex, &min) != UINT32_MAX) return true;
  }
  return false;
}

static uint32_t root_of(const sbf_asset *asset, uint32_t bone) {
  while (asset->bones.at[bone].parent != SBF_NONE) bone = (uint32_t)asset->bones.at[bone].parent;
  return bone;
}

/* Number of a skin's vertices at bodies, and the first bone of their skeleton. */
static uint32_t count_covered(const work *w, const sbf_render_mesh *mesh, uint32_t *root) {
  const sbf_skin *skin = mesh->skin;
  uint32_t count = mesh->mesh.positions.count, covered = 0;
  *root = SBFI_NO_INDEX;
  for (uint32_t v = 0, at = 0; v < count; at += skin->influence_counts.at[v++]) {
    uint32_t max = at;
    for (uint32_t i = at; i < at + skin->influence_counts.at[v]; i++)
      if (skin->weights.at[i] > skin->weights.at[max]) max = i;
    if (!skin->influence_counts.at[v]) continue;
    if (*root == SBFI_NO_INDEX) *root = root_of(w->asset, skin->bones.at[max]);
    covered += is_at_body(w, skin->bones.at[max], mesh->mesh.positions.at[v]);
  }
  return covered;
}

bool sbfi_authored_sections_find(
    const sbf_asset *asset, uint32_t body_count, uint8_t *sectioned, sbfi_arena *scratch) {
  work w = {.asset = asset};
  memset(sectioned, 0, asset->render_meshes.count);
  uint32_t meshes = asset->render_meshes.count, bones = asset->bones.count;
  uint32_t *roots = sbfi_arena_allocate(scratch, (size_t)meshes + 1, sizeof *roots);
  uint32_t *all = sbfi_arena_allocate(scratch, (size_t)bones + 1, sizeof *all);
  uint32_t *along = sbfi_arena_allocate(scratch, (size_t)bones + 1, sizeof *along);
  if (!roots || !all || !along || !index_bodies(&w, body_count, scratch)) return false;
  memset(all, 0, bones * sizeof *all), memset(along, 0, bones * sizeof *along);
  for (uint32_t m = 0; m < meshes; m++) {
    const sbf_render_mesh *mesh = &asset->render_meshes.at[m];
    roots[m] = SBFI_NO_INDEX;
    if (!mesh->skin) continue;
    uint32_t count = mesh->mesh.positions.count, covered = count_covered(&w, mesh, &roots[m]);
    sectioned[m] = covered > 0 && covered >= SECTIONED_PART * count;
    if (roots[m] == SBFI_NO_INDEX) continue;
    all[roots[m]] += count;
    along[roots[m]] += sectioned[m] ? covered : 0;
  }
  for (uint32_t m = 0; m < meshes; m++)
    if (sectioned[m] && along[roots[m]] < PART_OF_ALL * all[roots[m]]) sectioned[m] = 0;
  return true;
}
