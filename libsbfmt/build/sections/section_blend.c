#include "build/sections/section_blend.h"

#include <math.h>
#include <string.h>

#include "mechanics/vector.h"

enum { MOST_SWEEPS = 400, FIXED_SWEEPS = 200, POSES = 6 };
static const double MOST_STRETCH = 1.9; /* leaves room for rounding and for what is dropped */
static const double FLIPPED = 2.2;
static const double LEAST_WEIGHT = 2e-4;
static const double COSINE = 0.5, SINE = 0.8660254037844386; /* of 60 degrees */

/* A bone that carries weights, or one above such: what it and all below it hold of each point is a column. */
typedef struct column {
  uint32_t bone;
  uint32_t parent; /* column; SBFI_NO_INDEX: none */
  bool joint;      /* the bone has a parent */
  sbfi_d3 head;
  double turns[POSES][3][3]; /* rotation less the unit matrix */
} column;

typedef struct work {
  sbfi_skin_union *skin;
  const sbfi_skin_union *authored;
  const sbfi_topology *t;
  const sbf_asset *asset;
  sbfi_arena *arena;
  column *columns;
  uint32_t column_count;
  uint32_t *column_of_bone;
  double *sums;   /* (points x columns) */
  double *before; /* the same as they were authored */
  uint32_t (*triangles)[3];
  uint32_t triangle_count;
  uint32_t *begins, *at_point; /* triangles at each point */
  uint8_t *pending;            /* (triangles) to be looked at */
  const uint8_t *fixed;        /* (points) that keep their weights; NULL: none, or no longer */
} work;

static sbfi_d3 axis_of(sbf_quat r, int axis) {
  double x = r.x, y = r.y, z = r.z, w = r.w, length = sqrt(x * x + y * y + z * z + w * w);
  if (!(length > 0)) return (sbfi_d3){axis == 0, axis == 1, axis == 2};
  x /= length, y /= length, z /= length, w /= length;
  if (axis == 0) return (sbfi_d3){1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)};
  if (axis == 1) return (sbfi_d3){2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)};
  return (sbfi_d3){2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)};
}

static void fill_turns(column *c, const sbf_bone *bone) {
  for (int pose = 0; pose < POSES; pose++) {
    sbfi_d3 a = axis_of(bone->rotation, pose % 3);
    double sine = pose < 3 ? SINE : -SINE, v[3] = {a.x, a.y, a.z};
    const double k[3][3] = {{0, -a.z, a.y}, {a.z, 0, -a.x}, {-a.y, a.x, 0}};
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++)
        c->turns[pose][i][j] = (COSINE - 1) * (i == j) + sine * k[i][j] + (1 - COSINE) * v[i] * v[j];
  }
}

/* (points x columns) what each column holds of each point; NULL where memory runs out. */
static double *sums_of(const work *w, const sbfi_skin_union *skin) {
  uint32_t points = skin->mesh.positions.count;
  double *sums = sbfi_arena_allocate(w->arena, (size_t)points * w->column_count + 1, sizeof *sums);
  for (uint32_t p = 0; sums && p < points; p++) {
    double *row = sums + (size_t)p * w->column_count;
    for (uint32_t h = skin->hold_begins[p]; h < skin->hold_begins[p + 1]; h++)
      for (uint32_t c = w->column_of_bone[skin->holds[h].bone]; c != SBFI_NO_INDEX; c = w->columns[c].parent)
        row[c] += skin->holds[h].weight;
  }
  return sums;
}

static bool make_columns(work *w) {
  const sbf_bone_list bones = w->asset->bones;
  uint32_t points = w->skin->mesh.positions.count;
  w->column_of_bone = sbfi_arena_allocate(w->arena, (size_t)bones.count + 1, sizeof *w->column_of_bone);
  w->columns = sbfi_arena_allocate(w->arena, (size_t)bones.count + 1, sizeof *w->columns);
  uint8_t *used = sbfi_arena_allocate(w->arena, (size_t)bones.count + 1, 1);
  if (!w->column_of_bone || !w->columns || !used) return false;
  for (uint32_t h = 0; h < w->authored->hold_begins[points]; h++) used[w->authored->holds[h].bone] = 1;
  for (uint32_t b = bones.count; b-- > 0;)
    if (used[b] && bones.at[b].parent != SBF_NONE) used[bones.at[b].parent] = 1;
  for (uint32_t b = 0; b < bones.count; b++) {
    if (!used[b]) continue;
    int32_t parent = bones.at[b].parent;
    column *c = &w->columns[w->column_count];
    w->column_of_bone[b] = w->column_count++;
    c->bone = b;
    c->joint = parent != SBF_NONE;
    c->parent = c->joint ? w->column_of_bone[parent] : SBFI_NO_INDEX;
    c->head = sbfi_d3_of(bones.at[b].head);
    fill_turns(c, &bones.at[b]);
  }
  w->sums = sums_of(w, w->skin);
  w->before = sums_of(w, w->authored);
  return w->sums && w->before;
}

static bool has_weights(const work *w, uint32_t point) {
  return w->skin->hold_begins[point + 1] > w->skin->hold_begins[point];
}

static bool make_triangles(work *w) {
  const sbf_polygon_mesh *mesh = &w->skin->mesh;
  uint32_t points = mesh->positions.count;
  w->triangles = sbfi_arena_allocate(w->arena, (size_t)mesh->polygon_points.count + 1, sizeof *w->triangles);
  w->begins = sbfi_arena_allocate(w->arena, (size_t)points + 2, sizeof *w->begins);
  uint32_t *next = sbfi_arena_allocate(w->arena, (size_t)points + 1, sizeof *next);
  if (!w->triangles || !w->begins || !next) return false;
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; p++) {
    const uint32_t *c = mesh->polygon_points.at + w->t->corner_begins[p];
    for (uint32_t k = 1; k + 1 < mesh->polygon_sizes.at[p]; k++) {
      if (!has_weights(w, c[0]) || !has_weights(w, c[k]) || !has_weights(w, c[k + 1])) continue;
      uint32_t *to = w->triangles[w->triangle_count++];
      to[0] = c[0], to[1] = c[k], to[2] = c[k + 1];
      for (int i = 0; i < 3; i++) w->begins[to[i] + 1]++;
    }
  }
  for (uint32_t p = 0; p < points; p++) w->begins[p + 1] += w->begins[p];
  w->at_point = sbfi_arena_allocate(w->arena, (size_t)w->begins[points] + 1, sizeof *w->at_point);
  w->pending = sbfi_arena_allocate(w->arena, (size_t)w->triangle_count + 1, 1);
  if (!w->at_point || !w->pending) return false;
  memcpy(next, w->begins, points * sizeof *next);
  for (uint32_t i = 0; i < w->triangle_count; i++)
    for (int k = 0; k < 3; k++) w->at_point[next[w->triangles[i][k]]++] = i;
  memset(w->pending, 1, w->triangle_count);
  return true;
}

static sbfi_d3 turned(const double m[3][3], sbfi_d3 p) {
  return (sbfi_d3){m[0][0] * p.x + m[0][1] * p.y + m[0][2] * p.z,
      m[1][0] * p.x + m[1][1] * p.y + m[1][2] * p.z, m[2][0] * p.x + m[2][1] * p.y + m[2][2] * p.z};
}

/* Twice the vector area of the triangle with its corners moved by shares of a turn. */
static sbfi_d3 moved_normal(const column *c, int pose, const sbfi_d3 corners[3], const double shares[3]) {
  sbfi_d3 at[3];
  for (int k = 0; k < 3; k++)
    at[k] = sbfi_d3_add(
        corners[k], sbfi_d3_scale(turned(c->turns[pose], sbfi_d3_sub(corners[k], c->head)), shares[k]));
  return sbfi_d3_cross(sbfi_d3_sub(at[1], at[0]), sbfi_d3_sub(at[2], at[0]));
}

/* Whether a normal lies against what the turn, by its shares at the corners, makes of the one at rest. */
static bool is_flipped(const column *c, int pose, sbfi_d3 normal, sbfi_d3 rest, const double shares[3]) {
  sbfi_d3 turn = sbfi_d3_scale(turned(c->turns[pose], rest), (shares[0] + shares[1] + shares[2]) / 3);
  return sbfi_d3_dot(normal, sbfi_d3_add(rest, turn)) < 0;
}

/* The greatest area over that at rest; 1 where nothing differs between the corners. What is turned over, and
 * by the weights as authored is not, counts as stretched to FLIPPED. */
static double worst_stretch(const work *w, uint32_t triangle) {
  const uint32_t *points = w->triangles[triangle];
  sbfi_d3 corners[3];
  double worst = 0;
  bool flipped = false;
  for (int k = 0; k < 3; k++) corners[k] = sbfi_d3_of(w->skin->mesh.positions.at[points[k]]);
  sbfi_d3 rest = sbfi_d3_cross(sbfi_d3_sub(corners[1], corners[0]), sbfi_d3_sub(corners[2], corners[0]));
  double area = sbfi_d3_dot(rest, rest);
  if (!(area > 0)) return 1;
  for (uint32_t c = 0; c < w->column_count; c++) {
    double shares[3], before[3];
    for (int k = 0; k < 3; k++) {
      shares[k] = w->sums[(size_t)points[k] * w->column_count + c];
      before[k] = w->before[(size_t)points[k] * w->column_count + c];
    }
    if (!w->columns[c].joint || (shares[0] == shares[1] && shares[0] == shares[2])) continue;
    for (int pose = 0; pose < POSES; pose++) {
      sbfi_d3 here = moved_normal(&w->columns[c], pose, corners, shares);
      double square = sbfi_d3_dot(here, here);
      if (square > worst) worst = square;
      flipped = flipped || (is_flipped(&w->columns[c], pose, here, rest, before) &&
                               !is_flipped(&w->columns[c], pose,
                                   moved_normal(&w->columns[c], pose, corners, before), rest, before));
    }
  }
  double stretch = worst > area ? sqrt(worst / area) : 1;
  return flipped && stretch < FLIPPED ? FLIPPED : stretch;
}

/* Draws the corners towards their mean, or that of those that are fixed, keeping the share of the differences
 * that would just do. Where all are fixed they differ within what is fixed: there nothing is. */
static void contract(work *w, uint32_t triangle, double stretch) {
  const uint32_t *points = w->triangles[triangle];
  double kept = 0.9 * (MOST_STRETCH - 1) / (stretch - 1);
  uint32_t fixed = 0;
  for (int k = 0; w->fixed && k < 3; k++) fixed += w->fixed[points[k]];
  if (fixed == 3) fixed = 0;
  for (uint32_t c = 0; c < w->column_count; c++) {
    double *of[3], mean = 0;
    for (int k = 0; k < 3; k++) {
      of[k] = &w->sums[(size_t)points[k] * w->column_count + c];
      if (!fixed || w->fixed[points[k]]) mean += *of[k] / (fixed ? fixed : 3);
    }
    for (int k = 0; k < 3; k++)
      if (!fixed || !w->fixed[points[k]]) *of[k] = mean + kept * (*of[k] - mean);
  }
  for (int k = 0; k < 3; k++)
    for (uint32_t i = w->begins[points[k]]; i < w->begins[points[k] + 1]; i++) w->pending[w->at_point[i]] = 1;
}

static void sweep_all(work *w, uint8_t *changed, uint32_t *left) {
  for (int sweep = 0; sweep < MOST_SWEEPS; sweep++) {
    *left = 0;
    if (sweep == FIXED_SWEEPS) w->fixed = NULL;
    for (uint32_t i = 0; i < w->triangle_count; i++) {
      if (!w->pending[i]) continue;
      w->pending[i] = 0;
      double stretch = worst_stretch(w, i);
      if (stretch <= MOST_STRETCH) continue;
      ++*left;
      contract(w, i, stretch);
      for (int k = 0; k < 3; k++) changed[w->triangles[i][k]] = 1;
    }
    if (*left == 0) return;
  }
}

/* Columns back to weights: of a bone, its sum less those of the bones that hang on it. */
static bool write_back(work *w, const uint8_t *changed) {
  uint32_t points = w->skin->mesh.positions.count, next = 0;
  size_t most = (size_t)w->skin->hold_begins[points] + 1;
  for (uint32_t p = 0; p < points; p++) most += changed[p] ? w->column_count : 0;
  uint32_t *begins = sbfi_arena_allocate(w->arena, (size_t)points + 1, sizeof *begins);
  sbfi_hold *holds = sbfi_arena_allocate(w->arena, most, sizeof *holds);
  double *own = sbfi_arena_allocate(w->arena, (size_t)w->column_count + 1, sizeof *own);
  if (!begins || !holds || !own) return false;
  for (uint32_t p = 0; p < points; p++) {
    begins[p] = next;
    if (!changed[p]) {
      for (uint32_t h = w->skin->hold_begins[p]; h < w->skin->hold_begins[p + 1]; h++)
        holds[next++] = w->skin->holds[h];
      continue;
    }
    double sum = 0;
    memcpy(own, w->sums + (size_t)p * w->column_count, w->column_count * sizeof *own);
    for (uint32_t c = 0; c < w->column_count; c++)
      if (w->columns[c].parent != SBFI_NO_INDEX)
        own[w->columns[c].parent] -= w->sums[(size_t)p * w->column_count + c];
    for (uint32_t c = 0; c < w->column_count; c++) sum += own[c] >= LEAST_WEIGHT ? own[c] : 0;
    for (uint32_t c = 0; c < w->column_count; c++)
      if (own[c] >= LEAST_WEIGHT) holds[next++] = (sbfi_hold){w->columns[c].bone, (float)(own[c] / sum)};
  }
  begins[points] = next;
  w->skin->hold_begins = begins;
  w->skin->holds = holds;
  return true;
}

bool sbfi_section_blend_smooth(sbfi_skin_union *skin, const sbfi_skin_union *authored, const sbfi_topology *t,
    const sbf_asset *asset, const uint8_t *fixed, uint32_t *left, sbfi_arena *arena) {
  work w = {.skin = skin, .authored = authored, .t = t, .asset = asset, .arena = arena, .fixed = fixed};
  uint8_t *changed = sbfi_arena_allocate(arena, (size_t)skin->mesh.positions.count + 1, 1);
  *left = 0;
  if (!changed || !make_columns(&w) || !make_triangles(&w)) return false;
  sweep_all(&w, changed, left);
  return write_back(&w, changed);
}
