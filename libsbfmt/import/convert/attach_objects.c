#include "import/convert/attach_objects.h"

#include <math.h>
#include <string.h>

#include "build/geometry/topology.h"
#include "build/geometry/triangle_tree.h"
#include "import/convert/main_bones.h"
#include "mechanics/extent.h"

static const double CONTACT_DISTANCE = 0.005; /* fraction of the skins' size; closer points are in contact */
static const double MAX_SIZE = 1.5;           /* times the skins' size; larger objects are scenery */
static const double SOLE = 0.03; /* fraction of the skins' size; objects that end below are the ground */

/* Surface with a bone at each point. */
typedef struct holder {
  /* (points) SBFI_NO_INDEX where no bone moves the point; NULL: all points follow `bone` */
  const uint32_t *bones;
  int32_t bone;
  sbfi_triangle_tree tree;
} holder;

typedef struct work {
  sbfi_conversion *c;
  const sbf_polygon_mesh *const *objects;
  holder *holders; /* skins, then objects that have a bone */
  uint32_t holder_count;
  double size, lowest; /* of the skins: extent, m; minimum y, m */
  uint32_t *votes;     /* (bones) */
} work;

static bool add_holder(work *w, const sbf_polygon_mesh *mesh, const uint32_t *bones, int32_t bone) {
  holder *h = &w->holders[w->holder_count++];
  *h = (holder){.bones = bones, .bone = bone};
  return sbfi_triangle_tree_build(&h->tree, mesh, &w->c->scratch);
}

static bool gather_holders(work *w, const sbf_render_mesh *skins, uint32_t skin_count) {
  w->lowest = INFINITY;
  for (uint32_t m = 0; m < skin_count; m++) {
    const sbf_polygon_mesh *mesh = &skins[m].mesh;
    const uint32_t *bones = sbfi_main_bones(&skins[m], &w->c->scratch);
    if (!bones || !add_holder(w, mesh, bones, SBF_NONE)) return false;
    w->size = fmax(w->size, sbfi_extent(mesh->positions));
    for (uint32_t i = 0; i < mesh->positions.count; i++)
      w->lowest = fmin(w->lowest, (double)mesh->positions.at[i].y);
  }
  for (uint32_t i = 0; i < w->c->scene->mesh_count; i++)
    if (w->objects[i] && w->c->bone_of_mesh[i] != SBF_NONE &&
        !add_holder(w, w->objects[i], NULL, w->c->bone_of_mesh[i]))
      return false;
  return true;
}

static int32_t bone_of(const holder *h, uint32_t point) {
  if (!h->bones) return h->bone;
  return h->bones[point] == SBFI_NO_INDEX ? SBF_NONE : (int32_t)h->bones[point];
}

static void vote(work *w, int32_t bone) {
  if (bone != SBF_NONE) w->votes[bone]++;
}

/* Triangle of `on` that contains the point or is crossed by the edge from it; UINT32_MAX if none. */
static uint32_t find_touched(
    const work *w, const sbfi_triangle_tree *on, const sbf_vec3 *point, const sbf_vec3 *edge_end) {
  double distance2 = pow(CONTACT_DISTANCE * w->size, 2);
  uint32_t found = sbfi_triangle_tree_nearest(on, *point, &distance2);
  return found == UINT32_MAX ? sbfi_triangle_tree_pierced(on, *point, *edge_end, 1) : found;
}

/* Each corner of one surface in contact with the other votes for the holder's bone there. */
static void vote_at_contacts(work *w, const sbfi_triangle_tree *object, const holder *h) {
  for (uint32_t i = 0; i < 3 * object->triangle_count; i++) {
    const uint32_t *corners = object->triangles[i / 3].points;
    uint32_t found = find_touched(
        w, &h->tree, &object->positions[corners[i % 3]], &object->positions[corners[(i + 1) % 3]]);
    if (found != UINT32_MAX) vote(w, bone_of(h, h->tree.triangles[found].points[0]));
  }
  for (uint32_t i = 0; i < 3 * h->tree.triangle_count; i++) {
    const uint32_t *corners = h->tree.triangles[i / 3].points;
    if (find_touched(w, object, &h->tree.positions[corners[i % 3]],
            &h->tree.positions[corners[(i + 1) % 3]]) != UINT32_MAX)
      vote(w, bone_of(h, corners[i % 3]));
  }
}

/* Stores the bone that the object touches most, SBF_NONE if it touches nothing. False if memory runs out. */
static bool find_bone(work *w, const sbf_polygon_mesh *object, int32_t *bone) {
  uint32_t bones = w->c->asset->bones.count, max = 0;
  sbfi_triangle_tree tree;
  if (!sbfi_triangle_tree_build(&tree, object, &w->c->scratch)) return false;
  memset(w->votes, 0, bones * sizeof *w->votes);
  for (uint32_t h = 0; h < w->holder_count; h++) vote_at_contacts(w, &tree, &w->holders[h]);
  *bone = SBF_NONE;
  for (uint32_t b = 0; b < bones; b++)
    if (w->votes[b] > max) max = w->votes[b], *bone = (int32_t)b;
  return true;
}

static bool may_be_part(const work *w, const sbf_polygon_mesh *object) {
  double highest = -INFINITY;
  for (uint32_t i = 0; i < object->positions.count; i++)
    highest = fmax(highest, (double)object->positions.at[i].y);
  return sbfi_extent(object->positions) <= MAX_SIZE * w->size && highest > w->lowest + SOLE * w->size;
}

/* Attaches objects in contact with a holder. They become holders themselves. `*found` is true if there
 * were any. */
static sbf_status attach_some(work *w, bool *found) {
  *found = false;
  for (uint32_t i = 0; i < w->c->scene->mesh_count; i++) {
    int32_t *bone = &w->c->bone_of_mesh[i];
    if (!w->objects[i] || *bone != SBF_NONE || !may_be_part(w, w->objects[i])) continue;
    if (!find_bone(w, w->objects[i], bone)) return sbfi_convert_no_memory(w->c);
    if (*bone == SBF_NONE) continue;
    if (!add_holder(w, w->objects[i], NULL, *bone)) return sbfi_convert_no_memory(w->c);
    *found = true;
    sbfi_convert_warn(w->c, SBF_CODE_RIG_SECTION_GUESSED,
        "object '%s' has no bone as its parent: it moves with '%s', which it touches; parent it to another "
        "bone if that is wrong",
        w->c->name_of_mesh[i], w->c->asset->bones.at[*bone].name);
  }
  return SBF_OK;
}

sbf_status sbfi_attach_objects(sbfi_conversion *c, const sbf_render_mesh *skins, uint32_t skin_count,
    const sbf_polygon_mesh *const *objects) {
  work w = {.c = c, .objects = objects};
  if (skin_count == 0) return SBF_OK;
  w.holders =
      sbfi_arena_allocate(&c->scratch, (size_t)skin_count + c->scene->mesh_count + 1, sizeof *w.holders);
  w.votes = sbfi_arena_allocate(&c->scratch, (size_t)c->asset->bones.count + 1, sizeof *w.votes);
  if (!w.holders || !w.votes || !gather_holders(&w, skins, skin_count)) return sbfi_convert_no_memory(c);
  sbf_status status = SBF_OK;
  for (bool found = true; status == SBF_OK && found;) status = attach_some(&w, &found);
  return status;
}
