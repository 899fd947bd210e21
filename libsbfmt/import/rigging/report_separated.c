#include "import/rigging/report_separated.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/union_find.h"
#include "import/rigging/surface_finder.h"
#include "import/rigging/surface_pieces.h"

enum { NAMED = 4 };

/* As fractions of the rig's size: median distance of a piece from the rig's surface, or from its bones, at
 * which it is separated; distance beside a near piece; maximum size of a prop; distance of a point that
 * belongs to no body. */
static const double FAR_FROM_SURFACE = 0.1, FAR_FROM_BONES = 0.2, MAX_GAP = 0.05, LARGE = 0.5, STRAY = 1;
static const double UNBOUNDED = 1e30; /* m */

typedef struct piece {
  uint32_t points, far; /* whose bones were guessed; those of them that are far from the rig */
  uint32_t others;      /* points whose bones are known */
  uint32_t number;      /* within the object from 1, as in --shell */
  double nearest;
  sbfi_d3 low, high;
  bool is_separated;
} piece;

static double length_of(const piece *p) {
  return sbfi_d3_length(sbfi_d3_sub(p->high, p->low));
}

typedef struct separation_search {
  const sbfi_rigging *r;
  const sbfi_scene_surface *moved;
  sbfi_surface_finder finder;
  bool by_surface;
  double size, far_m;
  const uint32_t *pieces; /* (points) */
  double *distances;      /* (points) from the rig, m; 0 if the bones are known */
  piece *all;             /* (points) valid at the first point of each piece */
} separation_search;

static double distance_to_bone(const sbf_bone *bone, sbfi_d3 p) {
  const sbf_quat q = bone->rotation;
  sbfi_d3 axis = {2 * (q.x * q.y - q.w * q.z), 1 - 2 * (q.x * q.x + q.z * q.z), 2 * (q.y * q.z + q.w * q.x)};
  sbfi_d3 from = sbfi_d3_sub(p, sbfi_d3_of(bone->head));
  double along = fmin(fmax(sbfi_d3_dot(from, axis), 0), (double)bone->length);
  return sbfi_d3_length(sbfi_d3_sub(from, sbfi_d3_scale(axis, along)));
}

static double distance_to_rig(const separation_search *a, sbfi_d3 p) {
  sbfi_surface_location near;
  double nearest = INFINITY;
  if (a->by_surface)
    return sbfi_surface_nearest(&a->finder, p, NULL, UNBOUNDED, &near) ? near.distance : UNBOUNDED;
  for (uint32_t b = 0; b < a->r->c->asset->bones.count; b++)
    nearest = fmin(nearest, distance_to_bone(&a->r->c->asset->bones.at[b], p));
  return nearest;
}

static double size_of_bones(const sbf_bone_list bones) {
  sbfi_d3 low = sbfi_d3_of(bones.at[0].head), high = low;
  for (uint32_t b = 0; b < bones.count; b++) {
    sbfi_d3 p = sbfi_d3_of(bones.at[b].head);
    low = (sbfi_d3){fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z)};
    high = (sbfi_d3){fmax(high.x, p.x), fmax(high.y, p.y), fmax(high.z, p.z)};
  }
  return sbfi_d3_length(sbfi_d3_sub(high, low));
}

static void add_point(separation_search *a, uint32_t point) {
  piece *p = &a->all[a->pieces[point]];
  sbfi_d3 at = sbfi_d3_of(a->moved->mesh.positions.at[point]);
  double distance = a->distances[point] = distance_to_rig(a, at);
  bool first = p->points++ == 0;
  p->low = first ? at : (sbfi_d3){fmin(p->low.x, at.x), fmin(p->low.y, at.y), fmin(p->low.z, at.z)};
  p->high = first ? at : (sbfi_d3){fmax(p->high.x, at.x), fmax(p->high.y, at.y), fmax(p->high.z, at.z)};
  p->nearest = first ? distance : fmin(p->nearest, distance);
  p->far += distance > a->far_m;
}

/* Whether a piece is far from the rig. Bones may be short relative to their body, so a piece that contains
 * some is never far. */
static bool is_far(const separation_search *a, const piece *p) {
  bool large = a->by_surface && length_of(p) > LARGE * a->size;
  return 2 * p->far > p->points + p->others && (p->nearest > MAX_GAP * a->size || large);
}

static double gap_between(const piece *a, const piece *b) {
  double x = fmax(a->low.x - b->high.x, b->low.x - a->high.x),
         y = fmax(a->low.y - b->high.y, b->low.y - a->high.y);
  double z = fmax(a->low.z - b->high.z, b->low.z - a->high.z);
  return fmax(x, fmax(y, z));
}

/* Finds pieces that are far from the rig and from all near pieces: a fin may be near its fish only, a lock
 * of hair near another. */
static bool find_separated(separation_search *a, sbfi_arena *arena) {
  uint32_t count = a->moved->mesh.positions.count, near_count = 0, far_count = 0;
  piece **near = sbfi_arena_allocate(arena, (size_t)count + 1, sizeof *near);
  piece **far = sbfi_arena_allocate(arena, (size_t)count + 1, sizeof *far);
  if (!near || !far) return false;
  for (uint32_t i = 0; i < count; i++) {
    piece *p = &a->all[i];
    if (!p->points) continue;
    p->is_separated = is_far(a, p);
    if (p->is_separated)
      far[far_count++] = p;
    else
      near[near_count++] = p;
  }
  for (uint32_t i = 0; i < near_count; i++) /* near_count grows */
    for (uint32_t k = 0; k < far_count; k++) {
      if (!far[k]->is_separated || (a->by_surface && length_of(far[k]) > LARGE * a->size)) continue;
      if (gap_between(near[i], far[k]) > MAX_GAP * a->size) continue;
      far[k]->is_separated = false;
      near[near_count++] = far[k];
    }
  return true;
}

/* Numbers shells by their first points, as --shell does; coincident points count separately. */
static bool number_pieces(separation_search *a, sbfi_arena *arena) {
  const sbfi_scene_surface *s = a->moved;
  uint32_t count = s->mesh.positions.count,
           *sets = sbfi_arena_allocate(arena, (size_t)count + 1, sizeof *sets);
  if (!sets) return false;
  sbfi_sets_begin(sets, count);
  for (uint32_t i = 0; i < count; i++)
    for (uint32_t k = s->neighbour_starts[i]; k < s->neighbour_starts[i + 1]; k++)
      sbfi_sets_join(sets, i, s->neighbours[k]);
  for (uint32_t m = 0; m < s->scene->mesh_count; m++)
    for (uint32_t i = s->mesh_starts[m], shells = 0; i < s->mesh_starts[m + 1]; i++) {
      if (sbfi_set_root(sets, i) == i) shells++;
      if (a->pieces[i] == i) a->all[i].number = shells;
    }
  return true;
}

static void report_object(const separation_search *a, uint32_t mesh) {
  uint32_t from = a->moved->mesh_starts[mesh], to = a->moved->mesh_starts[mesh + 1], pieces = 0, count = 0,
           points = 0;
  double nearest = INFINITY;
  char names[200] = "";
  for (uint32_t i = from; i < to; i++) {
    if (a->pieces[i] != i || a->moved->neighbour_starts[i] == a->moved->neighbour_starts[i + 1]) continue;
    pieces++;
    if (!a->all[i].is_separated) continue;
    nearest = fmin(nearest, a->all[i].nearest);
    points += a->all[i].points;
    size_t used = strlen(names);
    if (count++ < NAMED)
      snprintf(names + used, sizeof names - used, "%s'%.30s#%u'", used ? ", " : "", a->r->names[mesh],
          a->all[i].number);
  }
  if (!count) return;
  size_t used = strlen(names);
  if (count > NAMED) snprintf(names + used, sizeof names - used, " and %u more", count - NAMED);
  sbfi_convert_warn(a->r->c, SBF_CODE_RIG_OBJECT_APART,
      "%u of %u shells of the object '%.60s' are apart from the rig of %s, the nearest by %.3g m: %s, with "
      "%u of its %u points; they follow the nearest bones: if they are another character, convert it "
      "separately with its own rig, or assign a shell to a bone with --shell",
      count, pieces, a->r->names[mesh], a->r->rig.scene->file, nearest, names, points, to - from);
}

/* Reports points of near pieces that are far away, as a slip of the mouse leaves them. */
static void report_stray_points(const separation_search *a, uint32_t mesh) {
  uint32_t from = a->moved->mesh_starts[mesh], count = 0, farthest = from;
  for (uint32_t i = from; i < a->moved->mesh_starts[mesh + 1]; i++) {
    if (a->all[a->pieces[i]].is_separated || a->distances[i] <= STRAY * a->size) continue;
    count++;
    if (a->distances[i] > a->distances[farthest]) farthest = i;
  }
  if (count)
    sbfi_convert_warn(a->r->c, SBF_CODE_RIG_OBJECT_APART,
        "%u of the points of the object '%.60s' are farther from the rig of %s than its size of %.3g m: "
        "vertex "
        "%u by %.3g m; delete or move them in the input, because size, gait and soft parts follow from all "
        "points",
        count, a->r->names[mesh], a->r->rig.scene->file, a->size,
        a->r->input.scene->meshes[mesh].point_sources[farthest - from], a->distances[farthest]);
}

/* Whether the bone of a point was guessed. */
static bool is_guessed(const separation_search *a, uint32_t point) {
  sbfi_weight_source source = (sbfi_weight_source)a->r->sources[point];
  return source == SBFI_WEIGHTS_ATTACHED || source == SBFI_WEIGHTS_TRANSFERRED ||
         source == SBFI_WEIGHTS_COMPUTED;
}

bool sbfi_report_separated(const sbfi_rigging *r, const sbfi_scene_surface *moved, bool by_surface) {
  sbfi_arena scratch;
  uint32_t count = moved->mesh.positions.count;
  separation_search a = {.r = r, .moved = moved, .by_surface = by_surface && r->rig.mesh.polygon_sizes.count};
  sbfi_arena_init(&scratch, &r->c->scratch.allocator, 0);
  a.size = a.by_surface ? r->rig.size : size_of_bones(r->c->asset->bones);
  a.far_m = (a.by_surface ? FAR_FROM_SURFACE : FAR_FROM_BONES) * a.size;
  a.pieces = sbfi_surface_pieces(moved, &scratch);
  a.all = sbfi_arena_allocate(&scratch, (size_t)count + 1, sizeof *a.all);
  a.distances = sbfi_arena_allocate(&scratch, (size_t)count + 1, sizeof *a.distances);
  bool good = a.pieces && a.all && a.distances && number_pieces(&a, &scratch) &&
              (!a.by_surface || sbfi_surface_finder_make(&a.finder, &r->rig, &scratch));
  for (uint32_t i = 0; good && a.size > 0 && i < count; i++)
    if (is_guessed(&a, i))
      add_point(&a, i);
    else
      a.all[a.pieces[i]].others++;
  if (good) good = find_separated(&a, &scratch);
  for (uint32_t m = 0; good && m < moved->scene->mesh_count; m++)
    if (r->parent_nodes[m] == SBF_NONE && !r->separated[m]) {
      report_object(&a, m);
      report_stray_points(&a, m);
    }
  sbfi_arena_free(&scratch);
  return good;
}
