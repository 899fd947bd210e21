#include "build/lattice/lattice_grid.h"

const int sbfi_lattice_directions[SBFI_LATTICE_EDGES][3] = {
    {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {-1, -1, 1}, {1, -1, 1}, {-1, 1, 1}, {1, 1, 1}};

static const double max_nodes = 1 << 28, border = 2;

bool sbfi_lattice_grid_fit(sbfi_lattice_grid *grid, sbfi_d3 low, sbfi_d3 high, double cell) {
  const double from[3] = {low.x, low.y, low.z}, to[3] = {high.x, high.y, high.z};
  double origin[3], nodes = 2;
  *grid = (sbfi_lattice_grid){.cell = cell};
  for (int k = 0; k < 3; k++) {
    double cubes = floor((to[k] - from[k]) / cell + 0.5);
    if (!(cubes < max_nodes)) return false;
    if (cubes < 1) cubes = 1;
    origin[k] = (from[k] + to[k]) / 2 - (cubes / 2 + border) * cell;
    grid->counts[k] = (uint32_t)(cubes + 2 * border) + 1;
    nodes *= grid->counts[k];
  }
  if (!(nodes < max_nodes)) return false;
  grid->origin = (sbfi_d3){origin[0], origin[1], origin[2]};
  grid->node_count = (uint32_t)nodes;
  int32_t row = (int32_t)grid->counts[0], y = 2 * row, z = y * (int32_t)grid->counts[1];
  for (int kind = 0; kind < 2; kind++) {
    grid->steps[kind][0] = 1;
    grid->steps[kind][1] = y;
    grid->steps[kind][2] = z;
    for (int k = SBFI_LATTICE_LONG_EDGES; k < SBFI_LATTICE_EDGES; k++) {
      const int *direction = sbfi_lattice_directions[k];
      if (kind == 0)
        grid->steps[kind][k] = row + (direction[0] < 0 ? -1 : 0) + (direction[1] < 0 ? -y : 0);
      else
        grid->steps[kind][k] = z - row + (direction[0] > 0 ? 1 : 0) + (direction[1] > 0 ? y : 0);
    }
  }
  return true;
}

void sbfi_lattice_compute_coordinates(const sbfi_lattice_grid *grid, uint32_t node, int32_t at[3]) {
  uint32_t row = node / grid->counts[0], x = node % grid->counts[0], kind = row & 1;
  at[0] = (int32_t)(2 * x + kind);
  at[1] = (int32_t)(2 * (row / 2 % grid->counts[1]) + kind);
  at[2] = (int32_t)(2 * (row / 2 / grid->counts[1]) + kind);
}
