/* Transfers weights from the rig's own mesh to a similar one: edited, of another resolution, with clothes or
 * hair.
 *
 * A point takes the weights of the nearest surface that faces in its direction. If none is close, as on a
 * brim or between legs in contact, weights spread along the input's own surface from points that have some
 * (Abdrashitov, Raichstat, Monsen, Hill 2023). Pieces mostly away from the rig's surface, such as a sword,
 * or standing on it, such as a saddle, follow the one bone that they touch most. */
#include <math.h>

#include "import/rigging/surface_finder.h"
#include "import/rigging/surface_pieces.h"
#include "import/rigging/weigh.h"

/* As fractions of the rig's size: maximum distance of a surface that gives weights; how much farther than
 * the nearest surface the one with the right direction may be; how much farther than a piece's nearest
 * point others still count as touching. */
static const double FARTHEST = 0.05, DETOUR = 0.03, TOUCHING = 0.01;
/* Minimum fraction of a piece's points with weights for the rest to inherit theirs. */
static const double MIN_TRANSFERRED = 0.4;
/* Minimum fraction of a piece's points near rigid pieces of one bone for all to follow it. */
static const double MIN_RIGID = 0.75;
/* Minimum fraction of an object's points near unskinned meshes of the rig for it to be attached like them. */
static const double MIN_UNSKINNED = 0.9;
/* A piece stands on the surface, instead of covering it as clothes do, if this fraction of it faces the
 * surface and at most this fraction is parallel to it within a distance. Distance and maximum size of the
 * piece are fractions of the rig's size. */
static const double MIN_FACING = 0.2, MAX_ALONG = 0.35, ALONG = 0.01, MAX_STANDING = 0.6;
/* A sheet in the middle of a thin part may be this many times farther from one side than from the other. */
static const double SHEET = 3;
enum { SPREADING_PASSES = 100 };

typedef struct carrying {
  sbfi_rigging *r;
  const sbfi_scene_surface *moved;
  sbfi_surface_finder finder;
  uint32_t *pieces;   /* (points) first point of the piece of each */
  float *distances;   /* (points) distance from the rig's surface */
  int32_t *nearest;   /* (points) node of the nearest rigid piece of the rig, or SBF_NONE */
  int32_t *unskinned; /* (points) node of the nearest mesh of the rig if no bone moves it, or SBF_NONE */
  int32_t *rigid;     /* (rig points) node that alone moves the whole piece, or SBF_NONE */
  bool *is_stiff;     /* (points) at the first point of each piece: rigid pieces of one bone move it */
  uint8_t *stands;    /* (points) whether the point faces the nearby surface or is parallel to it */
  sbfi_arena *scratch;
} carrying;

enum { FACES_SURFACE = 1, LIES_ALONG };

static bool is_open(const carrying *c, uint32_t point) {
  return c->r->sources[point] == SBFI_WEIGHTS_NONE;
}

/* Finds, for each point of the rig, the node that alone moves its whole piece, or SBF_NONE. */
static bool find_rigid_pieces(carrying *c) {
  const sbfi_scene_surface *s = &c->r->rig;
  const uint32_t *pieces = sbfi_surface_pieces(s, c->scratch);
  c->rigid = sbfi_arena_allocate(c->scratch, (size_t)s->mesh.positions.count + 1, sizeof *c->rigid);
  if (!pieces || !c->rigid) return false;
  for (uint32_t i = 0; i < s->mesh.positions.count; i++) {
    const sbfi_influences *of = &c->r->rig_weights[i];
    int32_t node = of->at[0].weight > 0 && of->at[1].weight <= 0 ? (int32_t)of->at[0].node : SBF_NONE;
    if (pieces[i] == i) /* the first of its piece */
      c->rigid[i] = node;
    else if (c->rigid[pieces[i]] != node)
      c->rigid[pieces[i]] = SBF_NONE;
  }
  for (uint32_t i = 0; i < s->mesh.positions.count; i++) c->rigid[i] = c->rigid[pieces[i]];
  return true;
}

/* Whether an object faces away from the rig's nearby surface. */
static bool faces_away(const carrying *c, uint32_t mesh) {
  double sum = 0;
  uint32_t from = c->moved->mesh_starts[mesh], to = c->moved->mesh_starts[mesh + 1];
  for (uint32_t i = from; i < to; i += 1 + (to - from) / 500) {
    sbfi_surface_location near;
    sbfi_d3 position = sbfi_d3_of(c->moved->mesh.positions.at[i]);
    if (sbfi_surface_nearest(&c->finder, position, NULL, FARTHEST * c->r->rig.size, &near))
      sum += sbfi_d3_dot(sbfi_surface_normal(&c->r->rig, &near), sbfi_d3_of(c->moved->normals[i]));
  }
  return sum < 0;
}

static const sbfi_scene_mesh *mesh_at(const carrying *c, uint32_t rig_point) {
  const sbfi_scene_mesh *mesh = c->r->rig.scene->meshes;
  for (const uint32_t *starts = c->r->rig.mesh_starts + 1; *starts <= rig_point; starts++) mesh++;
  return mesh;
}

/* Same rule as in the conversion of the rig's own mesh: a skin point without weights follows the mesh's
 * node or the root. */
static void add_home(const carrying *c, uint32_t rig_point, double factor, sbfi_influences *to) {
  const sbfi_scene_mesh *mesh = mesh_at(c, rig_point);
  if (!mesh->skin.joint_count) return;
  int32_t home = c->r->c->bone_of_node[mesh->node];
  sbfi_influences_add(to, c->r->c->node_of_bone[home == SBF_NONE ? 0 : home], factor);
}

static void add_weights(
    const carrying *c, const sbfi_surface_location *at, double factor, sbfi_influences *to) {
  for (int k = 0; k < 3; k++) {
    const sbfi_influences *from = &c->r->rig_weights[at->points[k]];
    if (!(from->at[0].weight > 0)) add_home(c, at->points[k], factor * at->weights[k], to);
    for (uint32_t i = 0; i < SBFI_MAX_INFLUENCES && from->at[i].weight > 0; i++)
      sbfi_influences_add(to, from->at[i].node, factor * at->weights[k] * (double)from->at[i].weight);
  }
}

static void copy_weights(carrying *c, uint32_t point, sbfi_influences *weights) {
  sbfi_influences_finish(weights);
  c->r->weights[point] = *weights;
  if (weights->at[0].weight > 0) c->r->sources[point] = SBFI_WEIGHTS_TRANSFERRED;
}

/* For a thin part of the rig that the input has as a sheet: blends both sides, the nearer one more. */
static void transfer_to_sheet(
    carrying *c, uint32_t point, sbfi_d3 position, const sbfi_surface_location *near) {
  double size = c->r->rig.size, min = 1e-6 * size;
  sbfi_d3 back = sbfi_d3_scale(sbfi_surface_normal(&c->r->rig, near), -1);
  sbfi_influences weights = {0};
  sbfi_surface_location other;
  if (near->distance > ALONG * size) return;
  c->stands[point] = LIES_ALONG;
  add_weights(c, near, 1 / (near->distance + min), &weights);
  if (sbfi_surface_nearest(&c->finder, position, &back, SHEET * near->distance + min, &other))
    add_weights(c, &other, 1 / (other.distance + min), &weights);
  copy_weights(c, point, &weights);
}

static void transfer_to_point(carrying *c, uint32_t point, double sign) {
  double size = c->r->rig.size;
  sbfi_surface_location near, facing;
  sbfi_d3 position = sbfi_d3_of(c->moved->mesh.positions.at[point]);
  sbfi_d3 normal = sbfi_d3_scale(sbfi_d3_of(c->moved->normals[point]), sign);
  c->distances[point] = INFINITY;
  c->nearest[point] = c->unskinned[point] = SBF_NONE;
  if (!sbfi_surface_nearest(&c->finder, position, NULL, size, &near)) return;
  c->distances[point] = (float)near.distance;
  c->nearest[point] = c->rigid[near.points[0]];
  const sbfi_scene_mesh *nearest_mesh = mesh_at(c, near.points[0]);
  if (near.distance <= FARTHEST * size && !nearest_mesh->skin.joint_count &&
      c->r->c->bone_of_node[nearest_mesh->node] == SBF_NONE)
    c->unskinned[point] = nearest_mesh->node;
  if (!(sbfi_d3_length(normal) > 0)) {
    transfer_to_sheet(c, point, position, &near);
    return;
  }
  if (near.distance <= FARTHEST * size && sbfi_d3_dot(sbfi_surface_normal(&c->r->rig, &near), normal) < 0)
    c->stands[point] = FACES_SURFACE;
  double within = fmin(FARTHEST * size, near.distance + DETOUR * size);
  if (near.distance > within ||
      !sbfi_surface_nearest(&c->finder, position, &normal, within * (1 + 1e-9), &facing))
    return;
  if (facing.distance <= ALONG * size) c->stands[point] = LIES_ALONG;
  sbfi_influences weights = {0};
  add_weights(c, &facing, 1, &weights);
  copy_weights(c, point, &weights);
}

/* --- Where no surface near faces as the point does ----------------------------------------------------- */

/* Mean of the neighbours' weights by proximity; false if none has weights. */
static bool mean_of_neighbours(const carrying *c, uint32_t point, sbfi_influences *to) {
  const sbfi_scene_surface *s = c->moved;
  sbfi_d3 here = sbfi_d3_of(s->mesh.positions.at[point]);
  *to = (sbfi_influences){0};
  for (uint32_t k = s->neighbour_starts[point]; k < s->neighbour_starts[point + 1]; k++) {
    const sbfi_influences *from = &c->r->weights[s->neighbours[k]];
    sbfi_d3 there = sbfi_d3_of(s->mesh.positions.at[s->neighbours[k]]);
    double near = 1 / (sbfi_d3_length(sbfi_d3_sub(there, here)) + 1e-4 * s->size);
    for (uint32_t i = 0; i < SBFI_MAX_INFLUENCES && from->at[i].weight > 0; i++)
      sbfi_influences_add(to, from->at[i].node, near * (double)from->at[i].weight);
  }
  sbfi_influences_finish(to);
  return to->at[0].weight > 0;
}

/* Drops points unlike all neighbours: they matched a surface of another part. */
static bool drop_outliers(carrying *c) {
  static const double min_common = 0.4; /* of 1; 0: nothing in common */
  uint32_t count = c->moved->mesh.positions.count;
  bool *outlier = sbfi_arena_allocate(c->scratch, count + 1, sizeof *outlier);
  if (!outlier) return false;
  for (uint32_t i = 0; i < count; i++) {
    sbfi_influences mean;
    double common = 0;
    if (c->r->sources[i] != SBFI_WEIGHTS_TRANSFERRED || !mean_of_neighbours(c, i, &mean)) continue;
    const sbfi_influences *own = &c->r->weights[i];
    for (uint32_t a = 0; a < SBFI_MAX_INFLUENCES && mean.at[a].weight > 0; a++)
      for (uint32_t b = 0; b < SBFI_MAX_INFLUENCES && own->at[b].weight > 0; b++)
        if (mean.at[a].node == own->at[b].node)
          common += fmin((double)mean.at[a].weight, (double)own->at[b].weight);
    outlier[i] = common < min_common && c->distances[i] > 1e-3f * (float)c->r->rig.size;
  }
  for (uint32_t i = 0; i < count; i++) {
    if (!outlier[i]) continue;
    c->r->sources[i] = SBFI_WEIGHTS_NONE;
    c->r->weights[i] = (sbfi_influences){0};
  }
  return true;
}

/* Sets weights of open points to means of their neighbours, in alternating order, so that they spread in
 * both directions. */
static bool spread(carrying *c) {
  uint32_t count = c->moved->mesh.positions.count, open_count = 0;
  uint32_t *open = sbfi_arena_allocate(c->scratch, count + 1, sizeof *open);
  if (!open) return false;
  for (uint32_t i = 0; i < count; i++)
    if (c->r->sources[i] == SBFI_WEIGHTS_NONE) open[open_count++] = i;
  for (int pass = 0; pass < SPREADING_PASSES; pass++)
    for (uint32_t n = 0; n < open_count; n++) {
      uint32_t i = open[pass % 2 ? open_count - 1 - n : n];
      sbfi_influences mean;
      if (mean_of_neighbours(c, i, &mean)) c->r->weights[i] = mean;
    }
  for (uint32_t n = 0; n < open_count; n++)
    if (c->r->weights[open[n]].at[0].weight > 0) c->r->sources[open[n]] = SBFI_WEIGHTS_TRANSFERRED;
  return true;
}

/* --- Pieces that lie beside the rig's surface, not on it ----------------------------------------------- */

typedef struct piece {
  uint32_t points, weighted;
  uint32_t facing, along; /* points that face the rig's surface, and points parallel to it */
  float nearest;          /* distance to the rig's surface */
  sbf_vec3 low, high;
  bool is_stiff; /* it already has a bone */
  sbfi_influences touched;
} piece;

static void widen(piece *p, sbf_vec3 at) {
  bool first = p->points == 0;
  p->low = first ? at : (sbf_vec3){fminf(p->low.x, at.x), fminf(p->low.y, at.y), fminf(p->low.z, at.z)};
  p->high = first ? at : (sbf_vec3){fmaxf(p->high.x, at.x), fmaxf(p->high.y, at.y), fmaxf(p->high.z, at.z)};
}

/* Whether the piece is a separate rigid object. */
static bool is_attached(const carrying *c, const piece *p) {
  double length = sbfi_d3_length(sbfi_d3_sub(sbfi_d3_of(p->high), sbfi_d3_of(p->low)));
  if (p->weighted < MIN_TRANSFERRED * p->points) return true;
  return !p->is_stiff && p->facing >= MIN_FACING * p->points && p->along <= MAX_ALONG * p->points &&
         length <= MAX_STANDING * c->r->rig.size;
}

static uint32_t strongest(const sbfi_influences *of) {
  uint32_t best = 0;
  for (uint32_t i = 1; i < SBFI_MAX_INFLUENCES && of->at[i].weight > 0; i++)
    if (of->at[i].weight > of->at[best].weight) best = i;
  return of->at[best].node;
}

static void overlaps(const carrying *c, uint32_t point, piece *to) {
  sbfi_surface_location near;
  sbfi_d3 position = sbfi_d3_of(c->moved->mesh.positions.at[point]);
  if (c->distances[point] > to->nearest + (float)(TOUCHING * c->r->rig.size)) return;
  if (!sbfi_surface_nearest(&c->finder, position, NULL, c->r->rig.size, &near)) return;
  for (int k = 0; k < 3; k++) {
    const sbfi_influences *from = &c->r->rig_weights[near.points[k]];
    for (uint32_t i = 0; i < SBFI_MAX_INFLUENCES && from->at[i].weight > 0; i++)
      sbfi_influences_add(&to->touched, from->at[i].node, near.weights[k] * (double)from->at[i].weight);
  }
}

static bool attach_pieces(carrying *c) {
  uint32_t count = c->moved->mesh.positions.count;
  piece *pieces = sbfi_arena_allocate(c->scratch, count + 1, sizeof *pieces);
  if (!pieces) return false;
  for (uint32_t i = 0; i < count; i++) {
    piece *p = &pieces[c->pieces[i]];
    if (p->points == 0 || c->distances[i] < p->nearest) p->nearest = c->distances[i];
    widen(p, c->moved->mesh.positions.at[i]);
    p->points++;
    p->weighted += c->r->sources[i] != SBFI_WEIGHTS_NONE;
    p->facing += c->stands[i] == FACES_SURFACE;
    p->along += c->stands[i] == LIES_ALONG || c->r->sources[i] == SBFI_WEIGHTS_MATCHED;
    p->is_stiff |= c->is_stiff[c->pieces[i]];
  }
  for (uint32_t i = 0; i < count; i++) {
    piece *p = &pieces[c->pieces[i]];
    if (is_attached(c, p)) overlaps(c, i, p);
  }
  for (uint32_t i = 0; i < count; i++) {
    const piece *p = &pieces[c->pieces[i]];
    sbfi_weight_source source = (sbfi_weight_source)c->r->sources[i];
    if (!(p->touched.at[0].weight > 0) || (source != SBFI_WEIGHTS_NONE && source != SBFI_WEIGHTS_TRANSFERRED))
      continue;
    c->r->weights[i] = (sbfi_influences){{{strongest(&p->touched), 1}}};
    c->r->sources[i] = SBFI_WEIGHTS_ATTACHED;
  }
  return true;
}

/* --- Pieces of machines -------------------------------------------------------------------------------- */

typedef struct vote {
  uint32_t points, agreed;
  int32_t node;
  int32_t lead; /* votes of the leading node over all others */
} vote;

/* A piece on rigid pieces of one bone follows that bone alone, even if another surface is nearer (majority
 * vote by Boyer and Moore 1981). */
static bool stiffen_pieces(carrying *c) {
  uint32_t count = c->moved->mesh.positions.count;
  vote *votes = sbfi_arena_allocate(c->scratch, (size_t)count + 1, sizeof *votes);
  if (!votes) return false;
  for (uint32_t i = 0; i < count; i++) {
    vote *v = &votes[c->pieces[i]];
    if (v->points++ == 0 || v->lead == 0) v->node = c->nearest[i];
    v->lead += v->node == c->nearest[i] ? 1 : -1;
  }
  for (uint32_t i = 0; i < count; i++)
    votes[c->pieces[i]].agreed += c->nearest[i] == votes[c->pieces[i]].node;
  for (uint32_t i = 0; i < count; i++) {
    const vote *v = &votes[c->pieces[i]];
    if (v->node == SBF_NONE || v->agreed < MIN_RIGID * v->points) continue;
    if (!is_open(c, i) && c->r->sources[i] != SBFI_WEIGHTS_TRANSFERRED) continue;
    c->r->weights[i] = (sbfi_influences){{{(uint32_t)v->node, 1}}};
    c->r->sources[i] = SBFI_WEIGHTS_TRANSFERRED;
    c->is_stiff[c->pieces[i]] = true;
  }
  return true;
}

/* --- All of it ----------------------------------------------------------------------------------------- */

static double weighted_fraction(const sbfi_rigging *r) {
  uint32_t count = r->input.mesh.positions.count, weighted = 0;
  for (uint32_t i = 0; i < count; i++) weighted += r->sources[i] != SBFI_WEIGHTS_NONE;
  return count ? (double)weighted / count : 0;
}

/* Node of an unskinned rig mesh on which the object lies; SBF_NONE if there is none. */
static int32_t unskinned_node_of(const carrying *c, uint32_t mesh) {
  uint32_t from = c->r->input.mesh_starts[mesh], to = c->r->input.mesh_starts[mesh + 1], on = 0;
  int32_t node = SBF_NONE;
  for (uint32_t i = from; i < to; i++) {
    bool is_matched = c->r->sources[i] == SBFI_WEIGHTS_MATCHED && !(c->r->weights[i].at[0].weight > 0);
    on += is_matched || c->unskinned[i] != SBF_NONE;
    if (c->unskinned[i] != SBF_NONE) node = c->unskinned[i];
  }
  return on >= MIN_UNSKINNED * (to - from) ? node : SBF_NONE;
}

static void attach_unskinned_objects(carrying *c) {
  sbfi_rigging *r = c->r;
  for (uint32_t m = 0; m < r->input.scene->mesh_count; m++)
    if (r->parent_nodes[m] == SBF_NONE) r->parent_nodes[m] = unskinned_node_of(c, m);
}

static void transfer_to_objects(carrying *c) {
  sbfi_rigging *r = c->r;
  for (uint32_t m = 0; m < r->input.scene->mesh_count; m++) {
    bool away = faces_away(c, m), mirrored = sbfi_matrix_determinant(&r->alignment.to_asset) < 0;
    r->is_reversed[m] = away != mirrored; /* a mirrored mesh is flipped later anyway */
    if (r->parent_nodes[m] != SBF_NONE) continue;
    for (uint32_t i = r->input.mesh_starts[m]; i < r->input.mesh_starts[m + 1]; i++)
      if (is_open(c, i)) transfer_to_point(c, i, away ? -1 : 1);
    if (unskinned_node_of(c, m) == SBF_NONE) continue;
    for (uint32_t i = r->input.mesh_starts[m]; i < r->input.mesh_starts[m + 1]; i++)
      r->sources[i] = SBFI_WEIGHTS_TRANSFERRED;
  }
}

bool sbfi_weigh_by_nearness(sbfi_rigging *r, const sbfi_scene_surface *moved, double min, double *fraction) {
  sbfi_arena scratch;
  uint32_t count = moved->mesh.positions.count;
  sbfi_arena_init(&scratch, &r->c->scratch.allocator, 0);
  carrying c = {.r = r, .moved = moved, .scratch = &scratch};
  c.distances = sbfi_arena_allocate(&scratch, count + 1, sizeof *c.distances);
  c.nearest = sbfi_arena_allocate(&scratch, (size_t)count + 1, sizeof *c.nearest);
  c.unskinned = sbfi_arena_allocate(&scratch, (size_t)count + 1, sizeof *c.unskinned);
  c.pieces = sbfi_surface_pieces(moved, &scratch);
  c.is_stiff = sbfi_arena_allocate(&scratch, (size_t)count + 1, sizeof *c.is_stiff);
  c.stands = sbfi_arena_allocate(&scratch, (size_t)count + 1, sizeof *c.stands);
  bool good = c.distances && c.nearest && c.unskinned && c.pieces && c.is_stiff && c.stands &&
              find_rigid_pieces(&c) && sbfi_surface_finder_make(&c.finder, &r->rig, &scratch);
  for (uint32_t i = 0; good && i < count; i++) c.unskinned[i] = SBF_NONE;
  for (uint32_t i = 0; good && i < count; i++) /* points matched by position keep their node */
    c.nearest[i] = r->weights[i].at[0].weight > 0 && r->weights[i].at[1].weight <= 0
                       ? (int32_t)r->weights[i].at[0].node
                       : SBF_NONE;
  if (good) transfer_to_objects(&c);
  *fraction = good ? weighted_fraction(r) : 0;
  if (good && *fraction >= min) attach_unskinned_objects(&c);
  if (good && *fraction >= min)
    good = stiffen_pieces(&c) && attach_pieces(&c) && drop_outliers(&c) && spread(&c);
  for (uint32_t i = 0; *fraction < min && i < count; i++)
    if (r->sources[i] == SBFI_WEIGHTS_TRANSFERRED) {
      r->sources[i] = SBFI_WEIGHTS_NONE;
      r->weights[i] = (sbfi_influences){0};
    }
  sbfi_arena_free(&scratch);
  return good;
}
