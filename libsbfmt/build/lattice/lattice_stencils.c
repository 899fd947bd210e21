#include "build/lattice/lattice_stencils.h"

typedef struct spot {
  uint8_t i, j;
} spot;

typedef struct work {
  const uint32_t *nodes;
  const sbfi_d3 (*locations)[4];
  sbfi_stencil_piece *pieces;
  int count;
} work;

static sbfi_d3 position(const work *w, spot s) {
  return w->locations[s.i][s.j];
}

static double volume(const work *w, const spot s[4]) {
  sbfi_d3 origin = position(w, s[0]);
  return sbfi_d3_dot(sbfi_d3_sub(position(w, s[1]), origin),
      sbfi_d3_cross(sbfi_d3_sub(position(w, s[2]), origin), sbfi_d3_sub(position(w, s[3]), origin)));
}

static void add(work *w, spot a, spot b, spot c, spot d) {
  spot s[4] = {a, b, c, d};
  if (volume(w, s) < 0) {
    s[2] = d;
    s[3] = c;
  }
  sbfi_stencil_piece *piece = &w->pieces[w->count++];
  for (int k = 0; k < 4; k++) {
    piece->at[k][0] = s[k].i;
    piece->at[k][1] = s[k].j;
  }
}

static bool is_long(uint8_t i, uint8_t j) {
  return (i ^ j) == 1; /* 0-1 and 2-3 */
}

static spot corner(uint8_t i) {
  return (spot){i, i};
}

static spot cut(uint8_t i, uint8_t j) {
  return (spot){i, j};
}

static double squared(const work *w, spot a, spot b) {
  sbfi_d3 displacement = sbfi_d3_sub(position(w, a), position(w, b));
  return sbfi_d3_dot(displacement, displacement);
}

/* For the quad of the face a b out without corner `out`: whether its diagonal starts at a instead of b. */
static bool starts_at_first(const work *w, uint8_t a, uint8_t b, uint8_t out) {
  if (is_long(a, out)) return false;
  if (is_long(b, out)) return true;
  double from_a = squared(w, corner(a), cut(b, out)), from_b = squared(w, corner(b), cut(a, out));
  if (from_a != from_b) return from_a < from_b;
  return w->nodes[a] < w->nodes[b];
}

/* The prism between the triangles p and q. first[k]: whether the diagonal of the face between edges k and k +
 * 1 starts at p[k] instead of p[k + 1]; they must not form a cycle. */
static void add_prism(work *w, const spot p[3], const spot q[3], const bool first[3]) {
  int rank[3], order[3] = {0, 0, 0};
  for (int k = 0; k < 3; k++) rank[k] = !first[k] + first[(k + 2) % 3];
  for (int k = 0; k < 3; k++) order[rank[k]] = k;
  int x = order[0], y = order[1], z = order[2];
  add(w, p[x], p[y], p[z], q[z]);
  add(w, p[x], p[y], q[y], q[z]);
  add(w, p[x], q[x], q[y], q[z]);
}

/* Quality of the dihedral angles, minimum over all: 1 - |cosine|, with half the weight for obtuse angles, of
 * which there may be more. */
static double worst_shape(const work *w) {
  static const uint8_t faces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  double worst = INFINITY;
  for (int p = 0; p < w->count; p++) {
    sbfi_d3 at[4], normals[4];
    for (int k = 0; k < 4; k++) at[k] = w->locations[w->pieces[p].at[k][0]][w->pieces[p].at[k][1]];
    for (int f = 0; f < 4; f++) {
      sbfi_d3 from = at[faces[f][0]];
      normals[f] = sbfi_d3_normal(
          sbfi_d3_cross(sbfi_d3_sub(at[faces[f][1]], from), sbfi_d3_sub(at[faces[f][2]], from)));
    }
    for (int f = 0; f < 4; f++)
      for (int g = 0; g < f; g++) worst = fmin(worst, 1 - fabs(sbfi_d3_dot(normals[f], normals[g])));
  }
  return worst;
}

/* Two corners inside, two outside: the diagonal of the face on the surface is free. */
static void cut_wedge(work *w, const uint8_t in[2], const uint8_t out[2]) {
  const spot p[3] = {corner(in[0]), cut(in[0], out[0]), cut(in[0], out[1])};
  const spot q[3] = {corner(in[1]), cut(in[1], out[0]), cut(in[1], out[1])};
  bool first[3] = {
      starts_at_first(w, in[0], in[1], out[0]), false, !starts_at_first(w, in[0], in[1], out[1])};
  sbfi_stencil_piece best[SBFI_STENCIL_MAX];
  double best_shape = -INFINITY;
  for (int free = 0; free < 2; free++) {
    first[1] = free;
    if (first[0] == first[1] && first[1] == first[2]) continue;
    w->count = 0;
    add_prism(w, p, q, first);
    double shape = worst_shape(w);
    if (!(shape > best_shape)) continue;
    best_shape = shape;
    for (int k = 0; k < w->count; k++) best[k] = w->pieces[k];
  }
  for (int k = 0; k < w->count; k++) w->pieces[k] = best[k];
}

int sbfi_stencil_apply(const sbfi_stencil_corner corners[4], const uint32_t nodes[4],
    const sbfi_d3 positions[4][4], sbfi_stencil_piece pieces[SBFI_STENCIL_MAX]) {
  work w = {.nodes = nodes, .locations = positions, .pieces = pieces};
  uint8_t in[4], out[4], on[4];
  int in_count = 0, out_count = 0, on_count = 0;
  for (uint8_t i = 0; i < 4; i++) {
    if (corners[i] == SBFI_STENCIL_INSIDE) in[in_count++] = i;
    if (corners[i] == SBFI_STENCIL_OUTSIDE) out[out_count++] = i;
    if (corners[i] == SBFI_STENCIL_ON) on[on_count++] = i;
  }
  if (in_count == 1) {
    spot s[4];
    for (uint8_t i = 0; i < 4; i++) s[i] = corners[i] == SBFI_STENCIL_OUTSIDE ? cut(in[0], i) : corner(i);
    add(&w, s[0], s[1], s[2], s[3]);
  } else if (in_count == 2 && out_count == 2) {
    cut_wedge(&w, in, out);
  } else if (in_count == 2) {
    bool first = starts_at_first(&w, in[0], in[1], out[0]);
    spot from = corner(in[!first]), to = cut(in[first], out[0]);
    add(&w, from, to, corner(in[first]), corner(on[0]));
    add(&w, from, to, cut(in[!first], out[0]), corner(on[0]));
  } else {
    const spot p[3] = {corner(in[0]), corner(in[1]), corner(in[2])};
    const spot q[3] = {cut(in[0], out[0]), cut(in[1], out[0]), cut(in[2], out[0])};
    bool first[3];
    for (int k = 0; k < 3; k++) first[k] = starts_at_first(&w, in[k], in[(k + 1) % 3], out[0]);
    add_prism(&w, p, q, first);
  }
  return w.count;
}
