#include "build/levels/loose_pieces.h"

#include "base/union_find.h"
#include "build/geometry/line_width.h"

static const double min_width = 1e-4;

static void join(const sbf_spring_network *network, uint32_t *parents) {
  sbfi_sets_begin(parents, network->point_count);
  for (uint32_t s = 0; s < network->spring_count; s++)
    sbfi_sets_join(parents, network->ends[s].at[0], network->ends[s].at[1]);
  for (uint32_t t = 0; t < network->tetrahedron_count; t++)
    for (int k = 1; k < 4; k++)
      sbfi_sets_join(parents, network->tetrahedra[t].at[0], network->tetrahedra[t].at[k]);
}

static bool is_pinned(const sbf_spring_network *network, uint32_t point) {
  return !(network->masses[point] > 0) || (network->anchors && network->anchors[point] > 0);
}

bool sbfi_loose_pieces_pin(
    const sbf_spring_network *network, bool pinned, float *masses, double *loose_kg, sbfi_arena *scratch) {
  uint32_t points = network->point_count, heaviest = 0;
  uint32_t *parents = sbfi_arena_allocate(scratch, (size_t)points + 1, sizeof *parents);
  double *weights = sbfi_arena_allocate(scratch, (size_t)points + 1, sizeof *weights);
  uint8_t *is_piece_pinned = sbfi_arena_allocate(scratch, (size_t)points + 1, 1);
  *loose_kg = 0;
  if (!parents || !weights || !is_piece_pinned) return false;
  join(network, parents);
  for (uint32_t i = 0; i < points; i++) {
    uint32_t piece = sbfi_set_root(parents, i);
    if (!(masses[i] > 0) || (network->anchors && network->anchors[i] > 0)) is_piece_pinned[piece] = 1;
    weights[piece] += (double)masses[i];
    if (weights[piece] > weights[heaviest]) heaviest = piece;
  }
  for (uint32_t i = 0; i < points; i++) {
    uint32_t piece = sbfi_set_root(parents, i);
    if (pinned ? is_piece_pinned[piece] : piece == heaviest) continue;
    *loose_kg += (double)masses[i];
    masses[i] = 0;
  }
  return true;
}

bool sbfi_pieces_can_rotate(
    const sbf_spring_network *network, double size_m, bool *can_rotate, sbfi_arena *scratch) {
  uint32_t points = network->point_count;
  uint32_t *parents = sbfi_arena_allocate(scratch, (size_t)points + 1, sizeof *parents);
  uint32_t *ends = sbfi_arena_allocate(scratch, (size_t)points + 1, sizeof *ends);
  uint32_t *pinned_points = sbfi_arena_allocate(scratch, (size_t)points + 1, sizeof *pinned_points);
  uint8_t *moves = sbfi_arena_allocate(scratch, (size_t)points + 1, 1);
  *can_rotate = false;
  if (!parents || !ends || !pinned_points || !moves) return false;
  join(network, parents);
  for (uint32_t i = 0; i < points; i++) {
    uint32_t piece = sbfi_set_root(parents, i);
    ends[piece] += is_pinned(network, i);
    moves[piece] |= network->masses[i] > 0;
  }
  for (uint32_t i = 0, before = 0; i < points; i++) {
    uint32_t count = ends[i];
    ends[i] = before;
    before += count;
  }
  for (uint32_t i = 0; i < points; i++)
    if (is_pinned(network, i)) pinned_points[ends[sbfi_set_root(parents, i)]++] = i;
  for (uint32_t i = 0, from = 0; i < points; from = ends[i++]) {
    uint32_t count = ends[i] - from;
    if (!moves[i] || count == 0) continue;
    *can_rotate |=
        sbfi_farthest_line_of(network->positions, pinned_points + from, count).width <= min_width * size_m;
  }
  return true;
}
