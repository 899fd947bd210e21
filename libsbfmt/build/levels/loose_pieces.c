#include "build/levels/loose_pieces.h"

#include "base/union_find.h"

bool sbfi_loose_pieces_hold(
    const sbf_spring_network *network, bool held, float *masses, double *loose_kg, sbfi_arena *scratch) {
  uint32_t points = network->point_count, heaviest = 0;
  uint32_t *parents = sbfi_arena_allocate(scratch, (size_t)points + 1, sizeof *parents);
  double *weights = sbfi_arena_allocate(scratch, (size_t)points + 1, sizeof *weights);
  uint8_t *holds = sbfi_arena_allocate(scratch, (size_t)points + 1, 1);
  *loose_kg = 0;
  if (!parents || !weights || !holds) return false;
  sbfi_sets_begin(parents, points);
  for (uint32_t s = 0; s < network->spring_count; s++)
    sbfi_sets_join(parents, network->ends[s].at[0], network->ends[s].at[1]);
  for (uint32_t t = 0; t < network->tetrahedron_count; t++)
    for (int k = 1; k < 4; k++)
      sbfi_sets_join(parents, network->tetrahedra[t].at[0], network->tetrahedra[t].at[k]);
  for (uint32_t i = 0; i < points; i++) {
    uint32_t piece = sbfi_set_root(parents, i);
    if (!(masses[i] > 0) || (network->anchors && network->anchors[i] > 0)) holds[piece] = 1;
    weights[piece] += (double)masses[i];
    if (weights[piece] > weights[heaviest]) heaviest = piece;
  }
  for (uint32_t i = 0; i < points; i++) {
    uint32_t piece = sbfi_set_root(parents, i);
    if (held ? holds[piece] : piece == heaviest) continue;
    *loose_kg += (double)masses[i];
    masses[i] = 0;
  }
  return true;
}
