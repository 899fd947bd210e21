#include "build/sections/section_labels.h"

#include <string.h>

#include "mechanics/polygon.h"
#include "mechanics/vector.h"

enum { MAX_ROUNDS = 32, MAX_PIECE_ROUNDS = 4 };
/* Minimum size of a piece as a fraction of its bone's largest; smaller ones join a neighbour. */
static const double MIN_PIECE = 0.1;
/* Minimum gain as a fraction of the outline, so that rounding changes nothing. */
static const double MIN_GAIN = 1e-6;

typedef struct work {
  const sbfi_skin_union *skin;
  const sbfi_topology *t;
  uint32_t *labels;
  double *weights; /* (bones) of the current polygon; 0 between polygons */
  double *borders; /* (bones) the same for the length shared with each label */
  double *edge_lengths;
} work;

static double length_of(const work *w, uint32_t edge) {
  sbf_uint2 ends = w->t->edges[edge];
  const sbf_vec3 *at = w->skin->mesh.positions.at;
  return sbfi_d3_length(sbfi_d3_sub(sbfi_d3_of(at[ends.at[0]]), sbfi_d3_of(at[ends.at[1]])));
}

/* Adds (or with -1 subtracts) the weights of the polygon's corners, with equal corner weights; finds the
 * greatest. */
static void gather_weights(const work *w, uint32_t polygon) {
  for (uint32_t c = w->t->corner_begins[polygon]; c < w->t->corner_begins[polygon + 1]; c++) {
    uint32_t point = w->skin->mesh.polygon_points.at[c];
    double size = w->t->corner_begins[polygon + 1] - w->t->corner_begins[polygon];
    for (uint32_t h = w->skin->bone_weight_begins[point]; h < w->skin->bone_weight_begins[point + 1]; h++)
      w->weights[w->skin->bone_weights[h].bone] += w->skin->bone_weights[h].weight / size;
  }
}

static void clear_weights(const work *w, uint32_t polygon) {
  for (uint32_t c = w->t->corner_begins[polygon]; c < w->t->corner_begins[polygon + 1]; c++) {
    uint32_t point = w->skin->mesh.polygon_points.at[c];
    for (uint32_t h = w->skin->bone_weight_begins[point]; h < w->skin->bone_weight_begins[point + 1]; h++)
      w->weights[w->skin->bone_weights[h].bone] = 0;
  }
}

/* Bone with the greatest weight, the lowest index if equal. */
static uint32_t dominant(const work *w, uint32_t polygon) {
  uint32_t best = SBFI_NO_INDEX;
  for (uint32_t c = w->t->corner_begins[polygon]; c < w->t->corner_begins[polygon + 1]; c++) {
    uint32_t point = w->skin->mesh.polygon_points.at[c];
    for (uint32_t h = w->skin->bone_weight_begins[point]; h < w->skin->bone_weight_begins[point + 1]; h++) {
      uint32_t bone = w->skin->bone_weights[h].bone;
      if (best == SBFI_NO_INDEX || w->weights[bone] > w->weights[best] ||
          (w->weights[bone] == w->weights[best] && bone < best))
        best = bone;
    }
  }
  return best;
}

/* Adds lengths of the polygon's shared edges to their labels, times `sign`. */
static double visit_sides(const work *w, uint32_t polygon, double sign) {
  double outline = 0;
  for (uint32_t c = w->t->corner_begins[polygon]; c < w->t->corner_begins[polygon + 1]; c++) {
    uint32_t edge = w->t->corner_edges[c];
    if (edge == SBFI_NO_INDEX) continue;
    outline += w->edge_lengths[edge];
    for (uint32_t i = w->t->edge_polygon_begins[edge]; i < w->t->edge_polygon_begins[edge + 1]; i++) {
      uint32_t other = w->t->edge_polygons[i];
      if (other == polygon || w->labels[other] == SBFI_NO_INDEX) continue;
      if (sign > 0)
        w->borders[w->labels[other]] += w->edge_lengths[edge];
      else
        w->borders[w->labels[other]] = 0;
    }
  }
  return outline;
}

/* Cost of a label for the polygon: lost weights plus border, up to a constant. */
static double cost_of(const work *w, uint32_t label, double outline) {
  return -outline * w->weights[label] - w->borders[label];
}

static uint32_t best_label(const work *w, uint32_t polygon, double outline) {
  uint32_t own = w->labels[polygon], best = own;
  double min = own == SBFI_NO_INDEX ? 0 : cost_of(w, own, outline) - MIN_GAIN * outline;
  for (uint32_t c = w->t->corner_begins[polygon]; c < w->t->corner_begins[polygon + 1]; c++) {
    uint32_t edge = w->t->corner_edges[c];
    if (edge == SBFI_NO_INDEX) continue;
    for (uint32_t i = w->t->edge_polygon_begins[edge]; i < w->t->edge_polygon_begins[edge + 1]; i++) {
      uint32_t label = w->labels[w->t->edge_polygons[i]];
      if (label == SBFI_NO_INDEX || label == best) continue;
      double cost = cost_of(w, label, outline);
      if (cost < min || (cost == min && label < best)) min = cost, best = label;
    }
  }
  return best;
}

static bool smooth_once(const work *w) {
  bool changed = false;
  for (uint32_t p = 0; p < w->t->polygon_count; p++) {
    gather_weights(w, p);
    double outline = visit_sides(w, p, 1);
    uint32_t label = best_label(w, p, outline);
    visit_sides(w, p, -1);
    clear_weights(w, p);
    changed = changed || label != w->labels[p];
    w->labels[p] = label;
  }
  return changed;
}

/* Numbers the connected pieces of polygons with one label. Returns their number. */
static uint32_t number_pieces(const work *w, uint32_t *pieces, uint32_t *stack) {
  uint32_t count = 0;
  memset(pieces, 0xff, w->t->polygon_count * sizeof *pieces);
  for (uint32_t first = 0; first < w->t->polygon_count; first++) {
    if (pieces[first] != SBFI_NO_INDEX) continue;
    uint32_t height = 0;
    stack[height++] = first;
    pieces[first] = count;
    while (height) {
      uint32_t p = stack[--height];
      for (uint32_t c = w->t->corner_begins[p]; c < w->t->corner_begins[p + 1]; c++) {
        uint32_t edge = w->t->corner_edges[c];
        if (edge == SBFI_NO_INDEX) continue;
        for (uint32_t i = w->t->edge_polygon_begins[edge]; i < w->t->edge_polygon_begins[edge + 1]; i++) {
          uint32_t other = w->t->edge_polygons[i];
          if (pieces[other] != SBFI_NO_INDEX || w->labels[other] != w->labels[p]) continue;
          pieces[other] = count;
          stack[height++] = other;
        }
      }
    }
    count++;
  }
  return count;
}

static double area_of(const work *w, uint32_t p) {
  const sbf_polygon_mesh *mesh = &w->skin->mesh;
  const uint32_t *corners = mesh->polygon_points.at + w->t->corner_begins[p];
  uint32_t size = mesh->polygon_sizes.at[p];
  return sbfi_d3_length(sbfi_polygon_area(
      mesh->positions.at, corners, size, sbfi_polygon_middle(mesh->positions.at, corners, size)));
}

typedef struct piece {
  double area;
  uint32_t label, begin; /* first of its polygons in the sorted list */
} piece;

static uint32_t longest_neighbour(const work *w, const uint32_t *polygons, uint32_t count, uint32_t own) {
  uint32_t best = SBFI_NO_INDEX;
  for (int round = 0; round < 2; round++)
    for (uint32_t k = 0; k < count; k++) {
      if (round == 0) visit_sides(w, polygons[k], 1);
      for (uint32_t c = w->t->corner_begins[polygons[k]]; c < w->t->corner_begins[polygons[k] + 1]; c++) {
        uint32_t edge = w->t->corner_edges[c];
        if (edge == SBFI_NO_INDEX || round == 0) continue;
        for (uint32_t i = w->t->edge_polygon_begins[edge]; i < w->t->edge_polygon_begins[edge + 1]; i++) {
          uint32_t label = w->labels[w->t->edge_polygons[i]];
          if (label == SBFI_NO_INDEX || label == own) continue;
          if (best == SBFI_NO_INDEX || w->borders[label] > w->borders[best] ||
              (w->borders[label] == w->borders[best] && label < best))
            best = label;
        }
      }
    }
  for (uint32_t k = 0; k < count; k++) visit_sides(w, polygons[k], -1);
  return best;
}

/* Relabels small pieces; returns whether there were any. */
static bool relabel_small_pieces(const work *w, uint32_t bone_count, uint32_t *numbers, uint32_t *sorted,
    sbfi_arena *scratch, bool *good) {
  uint32_t count = number_pieces(w, numbers, sorted);
  piece *pieces = sbfi_arena_allocate(scratch, (size_t)count + 2, sizeof *pieces);
  double *largest = sbfi_arena_allocate(scratch, (size_t)bone_count + 1, sizeof *largest);
  uint32_t *next = sbfi_arena_allocate(scratch, (size_t)count + 2, sizeof *next);
  *good = pieces && largest && next;
  if (!*good) return false;
  for (uint32_t p = 0; p < w->t->polygon_count; p++) {
    pieces[numbers[p]].area += area_of(w, p);
    pieces[numbers[p]].label = w->labels[p];
    next[numbers[p] + 1]++;
  }
  for (uint32_t i = 0; i < count; i++) {
    pieces[i].begin = next[i];
    next[i + 1] += next[i];
    if (pieces[i].label != SBFI_NO_INDEX && pieces[i].area > largest[pieces[i].label])
      largest[pieces[i].label] = pieces[i].area;
  }
  pieces[count].begin = w->t->polygon_count;
  for (uint32_t p = 0; p < w->t->polygon_count; p++) sorted[next[numbers[p]]++] = p;
  bool changed = false;
  for (uint32_t i = 0; i < count; i++) {
    if (pieces[i].label == SBFI_NO_INDEX || pieces[i].area >= MIN_PIECE * largest[pieces[i].label]) continue;
    const uint32_t *polygons = sorted + pieces[i].begin;
    uint32_t size = pieces[i + 1].begin - pieces[i].begin;
    uint32_t to = longest_neighbour(w, polygons, size, pieces[i].label);
    if (to == SBFI_NO_INDEX) continue;
    for (uint32_t k = 0; k < size; k++) w->labels[polygons[k]] = to;
    changed = true;
  }
  return changed;
}

bool sbfi_section_labels_make(uint32_t *labels, const sbfi_skin_union *skin, const sbfi_topology *t,
    uint32_t bone_count, sbfi_arena *scratch) {
  work w = {.skin = skin, .t = t, .labels = labels};
  w.weights = sbfi_arena_allocate(scratch, (size_t)bone_count + 1, sizeof *w.weights);
  w.borders = sbfi_arena_allocate(scratch, (size_t)bone_count + 1, sizeof *w.borders);
  w.edge_lengths = sbfi_arena_allocate(scratch, (size_t)t->edge_count + 1, sizeof *w.edge_lengths);
  uint32_t *numbers = sbfi_arena_allocate(scratch, (size_t)t->polygon_count + 1, sizeof *numbers);
  uint32_t *sorted = sbfi_arena_allocate(scratch, (size_t)t->polygon_count + 1, sizeof *sorted);
  if (!w.weights || !w.borders || !w.edge_lengths || !numbers || !sorted) return false;
  for (uint32_t e = 0; e < t->edge_count; e++) w.edge_lengths[e] = length_of(&w, e);
  for (uint32_t p = 0; p < t->polygon_count; p++) {
    gather_weights(&w, p);
    labels[p] = dominant(&w, p);
    clear_weights(&w, p);
  }
  for (int round = 0; round < MAX_ROUNDS && smooth_once(&w); round++)
    ;
  bool good = true;
  for (int round = 0; round < MAX_PIECE_ROUNDS; round++)
    if (!relabel_small_pieces(&w, bone_count, numbers, sorted, scratch, &good)) break;
  return good;
}
