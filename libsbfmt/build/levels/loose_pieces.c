#include "build/levels/loose_pieces.h"

/* Union by the lowest number, with path halving: roots do not hang on the order of elements. */
static uint32_t root_of(uint32_t *parents, uint32_t point) {
  while (parents[point] != point) point = parents[point] = parents[parents[point]];
  return point;
}

static void join(uint32_t *parents, uint32_t a, uint32_t b) {
  a = root_of(parents, a);
  b = root_of(parents, b);
  if (a < b)
    parents[b] = a;
  else
    parents[a] = b;
}

bool sbfi_loose_pieces_hold(
    const sbf_spring_network *network, bool held, float *masses, double *loose_kg, sbfi_arena *scratch) {
  uint32_t points = network->point_count, heaviest = 0;
  uint32_t *parents = sbfi_arena_allocate(scratch, (size_t)points + 1, sizeof *parents);
  double *weights = sbfi_arena_allocate(scratch, (size_t)points + 1, sizeof *weights);
  uint8_t *holds = sbfi_arena_allocate(scratch, (size_t)points + 1, 1);
  *loose_kg = 0;
  if (!parents || !weights || !holds) return false;
  for (uint32_t i = 0; i < points; i++) parents[i] = i;
  for (uint32_t s = 0; s < network->spring_count; s++)
    join(parents, network->ends[s].at[0], network->ends[s].at[1]);
  for (uint32_t t = 0; t < network->tetrahedron_count; t++)
    for (int k = 1; k < 4; k++) join(parents, network->tetrahedra[t].at[0], network->tetrahedra[t].at[k]);
  for (uint32_t i = 0; i < points; i++) {
    uint32_t piece = root_of(parents, i);
    if (!(masses[i] > 0) || (network->anchors && network->anchors[i] > 0)) holds[piece] = 1;
    weights[piece] += (double)masses[i];
    if (weights[piece] > weights[heaviest]) heaviest = piece;
  }
  for (uint32_t i = 0; i < points; i++) {
    uint32_t piece = root_of(parents, i);
    if (held ? holds[piece] : piece == heaviest) continue;
    *loose_kg += (double)masses[i];
    masses[i] = 0;
  }
  return true;
}
