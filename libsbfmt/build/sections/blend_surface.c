#include "build/sections/blend_surface.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A fixed point becomes free after this many contractions of its triangles. Characters need up to 20 checks a
 * triangle. Bones that are far from the skin for the size of its triangles need weights equal to more digits
 * than numbers have: no number of sweeps is enough. */
enum { MAX_SWEEPS = 1000, MAX_CHECKS = 100, FIXED_CONTRACTIONS = 40 };
static const double MAX_STRETCH = 1.9; /* leaves a margin for rounding and dropped weights */
static const double FLIPPED = 2.2;
static const double HARMLESS = 0.37;                         /* see is_harmless */
static const double COSINE = 0.5, SINE = 0.8660254037844386; /* of 60 degrees */

/* Sum of weights of a bone and its descendants at the three corners of a triangle: current, and authored. */
typedef struct branch {
  uint32_t bone;
  double now[3], before[3];
} branch;

/* Branches of the current triangle, ascending by bone. */
typedef struct branches {
  branch *at;
  uint32_t count, capacity;
} branches;

typedef struct work {
  sbfi_blend_surface *s;
  sbfi_arena *arena;
  branches open;
  uint8_t *pending;      /* (triangles) to be checked */
  uint8_t *fixed;        /* (points) contractions until the point becomes free; 0: it is free */
  uint8_t *contractions; /* (triangles) if their number is limited */
} work;

static sbfi_d3 axis_of(sbf_quat r, int axis) {
  double x = r.x, y = r.y, z = r.z, w = r.w, length = sqrt(x * x + y * y + z * z + w * w);
  if (!(length > 0)) return (sbfi_d3){axis == 0, axis == 1, axis == 2};
  x /= length, y /= length, z /= length, w /= length;
  if (axis == 0) return (sbfi_d3){1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)};
  if (axis == 1) return (sbfi_d3){2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)};
  return (sbfi_d3){2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)};
}

static void fill_rotations(sbfi_blend_joint *joint, const sbf_bone *bone) {
  for (int pose = 0; pose < SBFI_BLEND_POSES; pose++) {
    sbfi_d3 a = axis_of(bone->rotation, pose % 3);
    double sine = pose < 3 ? SINE : -SINE, v[3] = {a.x, a.y, a.z};
    const double k[3][3] = {{0, -a.z, a.y}, {a.z, 0, -a.x}, {-a.y, a.x, 0}};
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++)
        joint->rotations[pose][i][j] = (COSINE - 1) * (i == j) + sine * k[i][j] + (1 - COSINE) * v[i] * v[j];
  }
}

sbfi_blend_joint *sbfi_blend_joints_make(const sbf_bone_list *bones, sbfi_arena *arena) {
  sbfi_blend_joint *joints = sbfi_arena_allocate(arena, (size_t)bones->count + 1, sizeof *joints);
  for (uint32_t b = 0; joints && b < bones->count; b++) {
    if (bones->at[b].parent == SBF_NONE) continue;
    joints[b].head = sbfi_d3_of(bones->at[b].head);
    fill_rotations(&joints[b], &bones->at[b]);
  }
  return joints;
}

/* A triangle with three times its centroid. */
typedef struct placed_triangle {
  double at[3]; /* y, z, x */
  uint32_t corners[3];
} placed_triangle;

static int compare_heights(const void *left, const void *right) {
  const placed_triangle *a = left, *b = right;
  for (int k = 0; k < 3; k++)
    if (a->at[k] != b->at[k]) return a->at[k] < b->at[k] ? -1 : 1;
  return memcmp(a->corners, b->corners, sizeof a->corners);
}

static bool sort_triangles(sbfi_blend_surface *s, sbfi_arena *arena) {
  placed_triangle *placed = sbfi_arena_allocate(arena, (size_t)s->triangle_count + 1, sizeof *placed);
  if (!placed) return false;
  for (uint32_t i = 0; i < s->triangle_count; i++) {
    sbfi_d3 sum = {0, 0, 0};
    for (int k = 0; k < 3; k++) sum = sbfi_d3_add(sum, sbfi_d3_of(s->positions[s->triangles[i][k]]));
    placed[i] = (placed_triangle){.at = {sum.y, sum.z, sum.x}};
    memcpy(placed[i].corners, s->triangles[i], sizeof placed[i].corners);
  }
  qsort(placed, s->triangle_count, sizeof *placed, compare_heights);
  for (uint32_t i = 0; i < s->triangle_count; i++)
    memcpy(s->triangles[i], placed[i].corners, sizeof placed[i].corners);
  return true;
}

bool sbfi_blend_surface_index(sbfi_blend_surface *s, sbfi_arena *arena) {
  uint32_t points = s->point_count;
  if (!sort_triangles(s, arena)) return false;
  s->begins = sbfi_arena_allocate(arena, (size_t)points + 2, sizeof *s->begins);
  s->at_point = sbfi_arena_allocate(arena, 3 * (size_t)s->triangle_count + 1, sizeof *s->at_point);
  uint32_t *next = sbfi_arena_allocate(arena, (size_t)points + 1, sizeof *next);
  if (!s->begins || !s->at_point || !next) return false;
  for (uint32_t i = 0; i < s->triangle_count; i++)
    for (int k = 0; k < 3; k++) s->begins[s->triangles[i][k] + 1]++;
  for (uint32_t p = 0; p < points; p++) s->begins[p + 1] += s->begins[p];
  memcpy(next, s->begins, points * sizeof *next);
  for (uint32_t i = 0; i < s->triangle_count; i++)
    for (int k = 0; k < 3; k++) s->at_point[next[s->triangles[i][k]]++] = i;
  return true;
}

static sbfi_d3 transform(const double m[3][3], sbfi_d3 p) {
  return (sbfi_d3){m[0][0] * p.x + m[0][1] * p.y + m[0][2] * p.z,
      m[1][0] * p.x + m[1][1] * p.y + m[1][2] * p.z, m[2][0] * p.x + m[2][1] * p.y + m[2][2] * p.z};
}

/* Twice the area vector of the triangle with its corners moved by fractions of a rotation. */
static sbfi_d3 moved_normal(
    const sbfi_blend_joint *c, int pose, const sbfi_d3 corners[3], const double fractions[3]) {
  sbfi_d3 at[3];
  for (int k = 0; k < 3; k++)
    at[k] = sbfi_d3_add(corners[k],
        sbfi_d3_scale(transform(c->rotations[pose], sbfi_d3_sub(corners[k], c->head)), fractions[k]));
  return sbfi_d3_cross(sbfi_d3_sub(at[1], at[0]), sbfi_d3_sub(at[2], at[0]));
}

/* Whether a normal is opposite to the rest normal rotated by the corners' fractions. */
static bool is_flipped(
    const sbfi_blend_joint *c, int pose, sbfi_d3 normal, sbfi_d3 rest, const double fractions[3]) {
  sbfi_d3 change =
      sbfi_d3_scale(transform(c->rotations[pose], rest), (fractions[0] + fractions[1] + fractions[2]) / 3);
  return sbfi_d3_dot(normal, sbfi_d3_add(rest, change)) < 0;
}

/* Finds or adds the branch of a bone. NULL if memory runs out. */
static branch *branch_of(work *w, uint32_t bone) {
  branches *open = &w->open;
  uint32_t low = 0, high = open->count;
  while (low < high) {
    uint32_t middle = low + (high - low) / 2;
    if (open->at[middle].bone < bone)
      low = middle + 1;
    else
      high = middle;
  }
  if (low < open->count && open->at[low].bone == bone) return &open->at[low];
  if (open->count == open->capacity) {
    uint32_t capacity = 2 * open->capacity + 16;
    branch *grown = sbfi_arena_allocate(w->arena, capacity, sizeof *grown);
    if (!grown) return NULL;
    if (open->count) memcpy(grown, open->at, open->count * sizeof *grown);
    open->at = grown;
    open->capacity = capacity;
  }
  memmove(open->at + low + 1, open->at + low, (open->count - low) * sizeof *open->at);
  open->count++;
  open->at[low] = (branch){.bone = bone};
  return &open->at[low];
}

static bool open_branches(work *w, const uint32_t points[3]) {
  w->open.count = 0;
  for (int k = 0; k < 3; k++) {
    const sbfi_blend_row *r = &w->s->rows[points[k]];
    for (uint32_t i = 0; i < r->count; i++) {
      branch *to = branch_of(w, r->at[i].bone);
      if (!to) return false;
      to->now[k] += r->at[i].value;
    }
    const sbfi_blend_row *before = &w->s->before[points[k]];
    for (uint32_t i = 0; i < before->count; i++) {
      branch *to = branch_of(w, before->at[i].bone);
      if (!to) return false;
      to->before[k] += before->at[i].value;
    }
  }
  return true;
}

/* Whether bends about the head can neither stretch the triangle beyond 1 + HARMLESS nor flip it. With the
 * weights s at its corners, T the rotation minus the unit matrix (of norm 1 for 60 degrees) and A = 1 +
 * s_0 T, its edges become A e_k + a_k, a_k = (s_k - s_0) T (p_k - head). A stretches nothing, so the
 * normal differs from cof(A) n by at most q = |a_1| |e_2| + |a_2| |e_1| + |a_1| |a_2|; and the projection
 * of cof(A) n on (1 + m T) n, for any mean weight m, is at least 3/8 n^2, as both rotate by up to 60
 * degrees and shrink by up to sqrt(3/4). */
static bool is_harmless(
    const sbfi_blend_joint *j, const sbfi_d3 corners[3], const double weights[3], double area) {
  double off[3], side[3];
  for (int k = 1; k < 3; k++) {
    off[k] = fabs(weights[k] - weights[0]) * sbfi_d3_length(sbfi_d3_sub(corners[k], j->head));
    side[k] = sbfi_d3_length(sbfi_d3_sub(corners[k], corners[0]));
  }
  return off[1] * side[2] + off[2] * side[1] + off[1] * off[2] < HARMLESS * area;
}

typedef struct bending {
  sbfi_d3 corners[3], rest; /* rest: the normal, with length twice the area */
  double worst;             /* largest squared normal so far */
  bool flipped;
} bending;

static void bend(const sbfi_blend_joint *j, const branch *by, bending *b) {
  for (int pose = 0; pose < SBFI_BLEND_POSES; pose++) {
    sbfi_d3 here = moved_normal(j, pose, b->corners, by->now);
    double square = sbfi_d3_dot(here, here);
    if (square > b->worst) b->worst = square;
    b->flipped = b->flipped || (is_flipped(j, pose, here, b->rest, by->before) &&
                                   !is_flipped(j, pose, moved_normal(j, pose, b->corners, by->before),
                                       b->rest, by->before));
  }
}

/* `*stretch` receives the largest area relative to rest; 1 if the corners have equal weights. A triangle
 * that flips, but does not with the authored weights, counts as stretched to FLIPPED. Processes branches
 * from the leaves of the skeleton, merging each into its parent's, until all corners have equal weights in
 * the rest. */
static bool find_stretch(work *w, uint32_t triangle, double *stretch) {
  const uint32_t *points = w->s->triangles[triangle];
  bending b = {.worst = 0};
  *stretch = 1;
  for (int k = 0; k < 3; k++) b.corners[k] = sbfi_d3_of(w->s->positions[points[k]]);
  b.rest = sbfi_d3_cross(sbfi_d3_sub(b.corners[1], b.corners[0]), sbfi_d3_sub(b.corners[2], b.corners[0]));
  double area = sbfi_d3_length(b.rest);
  if (!(area > 0)) return true;
  if (!open_branches(w, points)) return false;
  while (w->open.count > 1) {
    branch last = w->open.at[--w->open.count];
    int32_t parent = w->s->bones[last.bone].parent;
    if (parent == SBF_NONE) continue;
    const sbfi_blend_joint *j = &w->s->joints[last.bone];
    if ((last.now[0] != last.now[1] || last.now[0] != last.now[2]) &&
        !(is_harmless(j, b.corners, last.now, area)))
      bend(j, &last, &b);
    branch *to = branch_of(w, (uint32_t)parent);
    if (!to) return false;
    for (int k = 0; k < 3; k++) to->now[k] += last.now[k], to->before[k] += last.before[k];
  }
  if (b.worst > area * area) *stretch = sqrt(b.worst) / area;
  if (b.flipped && *stretch < FLIPPED) *stretch = FLIPPED;
  return true;
}

static double value_in(const sbfi_blend_row *r, uint32_t *next, uint32_t bone) {
  while (*next < r->count && r->at[*next].bone < bone) ++*next;
  return *next < r->count && r->at[*next].bone == bone ? r->at[*next].value : 0;
}

/* Adds negligible weights to the greatest, so that rows stay short when weights spread far. */
static void drop_negligible(sbfi_blend_row *r) {
  uint32_t kept = 0, greatest = 0;
  double dropped = 0;
  for (uint32_t i = 0; i < r->count; i++) {
    if (r->at[i].value < SBFI_BLEND_NEGLIGIBLE) {
      dropped += r->at[i].value;
      continue;
    }
    r->at[kept] = r->at[i];
    if (r->at[kept].value > r->at[greatest].value) greatest = kept;
    kept++;
  }
  if (kept == 0) return;
  r->at[greatest].value += dropped;
  r->count = kept;
}

static bool reserve(sbfi_blend_row *r, uint32_t count, sbfi_arena *arena) {
  if (r->capacity >= count) return true;
  uint32_t capacity = 2 * count;
  sbfi_blend_weight *grown = sbfi_arena_allocate(arena, capacity, sizeof *grown);
  if (!grown) return false;
  *r = (sbfi_blend_row){grown, r->count, capacity};
  return true;
}

/* Determines which corners are fixed; if all are, treats none as fixed. */
static uint32_t find_fixed(const work *w, const uint32_t points[3], bool is_fixed[3]) {
  uint32_t count = 0;
  for (int k = 0; k < 3; k++) count += is_fixed[k] = w->fixed[points[k]] > 0;
  if (count < 3) return count;
  memset(is_fixed, 0, 3 * sizeof *is_fixed);
  return 0;
}

/* Collects the weights of the three corners side by side. False if memory runs out. */
static bool open_weights(work *w, const uint32_t points[3]) {
  uint32_t next[3] = {0, 0, 0};
  w->open.count = 0;
  for (int k = 0; k < 3; k++)
    for (uint32_t i = 0; i < w->s->rows[points[k]].count; i++)
      if (!branch_of(w, w->s->rows[points[k]].at[i].bone)) return false;
  for (uint32_t i = 0; i < w->open.count; i++)
    for (int k = 0; k < 3; k++)
      w->open.at[i].now[k] = value_in(&w->s->rows[points[k]], &next[k], w->open.at[i].bone);
  return true;
}

/* Moves the corners' weights towards their mean, or that of the fixed ones, keeping the largest admissible
 * fraction of the differences. */
static bool contract(work *w, uint32_t triangle, double stretch) {
  const uint32_t *points = w->s->triangles[triangle];
  double kept = 0.9 * (MAX_STRETCH - 1) / (stretch - 1);
  bool is_fixed[3];
  uint32_t fixed = find_fixed(w, points, is_fixed);
  if (!open_weights(w, points)) return false;
  for (int k = 0; k < 3; k++) {
    sbfi_blend_row *to = &w->s->rows[points[k]];
    w->fixed[points[k]] -= is_fixed[k];
    if (is_fixed[k]) continue;
    if (!reserve(to, w->open.count, w->arena)) return false;
    to->count = w->open.count;
    for (uint32_t i = 0; i < w->open.count; i++) {
      double mean = 0;
      for (int c = 0; c < 3; c++)
        if (!fixed || is_fixed[c]) mean += w->open.at[i].now[c] / (fixed ? fixed : 3);
      to->at[i] = (sbfi_blend_weight){w->open.at[i].bone, mean + kept * (w->open.at[i].now[k] - mean)};
    }
    drop_negligible(to);
  }
  for (int k = 0; k < 3; k++)
    for (uint32_t i = w->s->begins[points[k]]; i < w->s->begins[points[k] + 1]; i++)
      w->pending[w->s->at_point[i]] = 1;
  return true;
}

/* Next pending triangle from `from` on, upwards or downwards; `count` if there is none. */
static uint32_t next_pending(const uint8_t *pending, uint32_t from, uint32_t count, bool down) {
  static const uint8_t none[8];
  for (uint32_t n = from; n < count;) {
    uint32_t i = down ? count - 1 - n : n;
    if (pending[i]) return n;
    /* Most sweeps find few: skips whole blocks. */
    const uint8_t *block = down ? pending + i - 7 : pending + i;
    n += n + 8 <= count && memcmp(block, none, sizeof none) == 0 ? 8 : 1;
  }
  return count;
}

/* Counts the contraction that follows, unless the triangle has had as many as it may. */
static bool is_given_up(work *w, uint32_t triangle) {
  if (w->s->max_contractions == 0) return false;
  if (w->contractions[triangle] == w->s->max_contractions) return true;
  w->contractions[triangle]++;
  return false;
}

/* Counts the triangles that have had all their contractions and still stretch. */
static bool count_given_up(work *w, uint32_t *left) {
  uint32_t count = 0;
  for (uint32_t i = 0; w->s->max_contractions && i < w->s->triangle_count; i++) {
    double stretch;
    if (w->pending[i] || w->contractions[i] < w->s->max_contractions) continue;
    if (!find_stretch(w, i, &stretch)) return false;
    count += stretch > MAX_STRETCH;
  }
  *left = count;
  return true;
}

/* Alternates the direction along the surface, so that weights travel along a whole limb in one sweep. */
static bool sweep_all(work *w, uint32_t *left) {
  uint32_t count = w->s->triangle_count;
  uint64_t max_checks = w->s->checks + (uint64_t)MAX_CHECKS * count;
  for (int sweep = 0; sweep < MAX_SWEEPS && w->s->checks <= max_checks; sweep++) {
    const bool down = sweep % 2;
    *left = 0;
    for (uint32_t n = 0; (n = next_pending(w->pending, n, count, down)) < count; n++) {
      uint32_t i = down ? count - 1 - n : n;
      double stretch;
      w->pending[i] = 0;
      w->s->checks++;
      if (!find_stretch(w, i, &stretch)) return false;
      if (stretch <= MAX_STRETCH) continue;
      if (is_given_up(w, i)) continue;
      ++*left;
      if (!contract(w, i, stretch)) return false;
      for (int k = 0; k < 3; k++) w->s->changed[w->s->triangles[i][k]] = 1;
    }
    if (*left == 0) return true;
  }
  return true;
}

static bool is_soft(const sbfi_blend_surface *s, const uint32_t points[3]) {
  if (!s->soft) return true;
  for (int k = 0; k < 3; k++)
    for (uint32_t i = 0; i < s->rows[points[k]].count; i++)
      if (s->soft[s->rows[points[k]].at[i].bone]) return true;
  return false;
}

bool sbfi_blend_surface_relax(sbfi_blend_surface *surface, uint32_t *left, sbfi_arena *arena) {
  work w = {.s = surface, .arena = arena};
  *left = 0;
  w.pending = sbfi_arena_allocate(arena, (size_t)surface->triangle_count + 1, 1);
  w.fixed = sbfi_arena_allocate(arena, (size_t)surface->point_count + 1, 1);
  if (surface->max_contractions)
    w.contractions = sbfi_arena_allocate(arena, (size_t)surface->triangle_count + 1, 1);
  if (!w.pending || !w.fixed || (surface->max_contractions && !w.contractions)) return false;
  for (uint32_t p = 0; surface->fixed && p < surface->point_count; p++)
    w.fixed[p] = surface->fixed[p] ? FIXED_CONTRACTIONS : 0;
  for (uint32_t i = 0; i < surface->triangle_count; i++)
    w.pending[i] = is_soft(surface, surface->triangles[i]);
  uint32_t given_up = 0;
  if (!sweep_all(&w, left) || !count_given_up(&w, &given_up)) return false;
  *left += given_up;
  return true;
}
