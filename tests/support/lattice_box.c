#include "lattice_box.h"

#include <stdlib.h>

#include "harness.h"

sbf_spring_network lattice_box_network(const lattice_box *box) {
  return (sbf_spring_network){.point_count = box->point_count,
      .positions = box->positions,
      .masses = box->masses,
      .tetrahedron_count = box->tetrahedron_count,
      .tetrahedra = box->tetrahedra,
      .young_modulus = box->young_modulus,
      .poisson_ratios = box->poisson_ratios};
}

uint32_t lattice_box_point(const lattice_box *box, uint32_t x, uint32_t y, uint32_t z) {
  return x + (box->cells[0] + 1) * (y + (box->cells[1] + 1) * z);
}

static void add_cell(lattice_box *box, const uint32_t cell[3]) {
  /* From a corner to the opposite one, an axis at a time, in the six orders; odd ones are turned over. Cells
   * with an odd number along an axis are mirrored along it. */
  static const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  bool turned = (cell[0] + cell[1] + cell[2]) % 2;
  for (int o = 0; o < 6; o++) {
    uint32_t at[3], *corners = box->tetrahedra[box->tetrahedron_count++].at;
    for (int k = 0; k < 3; k++) at[k] = cell[k] + cell[k] % 2;
    for (int k = 0; k < 4; k++) {
      corners[k] = lattice_box_point(box, at[0], at[1], at[2]);
      if (k < 3) at[orders[o][k]] = 2 * cell[orders[o][k]] + 1 - at[orders[o][k]];
    }
    if ((o >= 3) != turned) {
      uint32_t kept = corners[2];
      corners[2] = corners[3];
      corners[3] = kept;
    }
  }
}

lattice_box lattice_box_make(sbf_vec3 low, sbf_vec3 size, uint32_t nx, uint32_t ny, uint32_t nz,
    float density, float young_pa, float poisson) {
  lattice_box box = {.cells = {nx, ny, nz}, .point_count = (nx + 1) * (ny + 1) * (nz + 1)};
  uint32_t max = 6 * nx * ny * nz;
  box.positions = calloc(box.point_count, sizeof *box.positions);
  box.masses = calloc(box.point_count, sizeof *box.masses);
  box.tetrahedra = calloc(max, sizeof *box.tetrahedra);
  box.young_modulus = calloc(max, sizeof *box.young_modulus);
  box.poisson_ratios = calloc(max, sizeof *box.poisson_ratios);
  ck_assert(box.positions && box.masses && box.tetrahedra && box.young_modulus && box.poisson_ratios);
  for (uint32_t i = 0; i < box.point_count; i++) {
    uint32_t x = i % (nx + 1), y = i / (nx + 1) % (ny + 1), z = i / (nx + 1) / (ny + 1);
    box.positions[i] = (sbf_vec3){low.x + size.x * (float)x / (float)nx,
        low.y + size.y * (float)y / (float)ny, low.z + size.z * (float)z / (float)nz};
  }
  for (uint32_t z = 0; z < nz; z++)
    for (uint32_t y = 0; y < ny; y++)
      for (uint32_t x = 0; x < nx; x++) add_cell(&box, (const uint32_t[3]){x, y, z});
  float quarter = density * size.x * size.y * size.z / (float)max / 4;
  for (uint32_t t = 0; t < box.tetrahedron_count; t++) {
    box.young_modulus[t] = young_pa;
    box.poisson_ratios[t] = poisson;
    for (int k = 0; k < 4; k++) box.masses[box.tetrahedra[t].at[k]] += quarter;
  }
  return box;
}

void lattice_box_free(lattice_box *box) {
  free(box->positions);
  free(box->masses);
  free(box->tetrahedra);
  free(box->young_modulus);
  free(box->poisson_ratios);
}

void lattice_box_hold(lattice_box *box) {
  for (uint32_t i = 0; i < box->point_count; i++)
    if (i % (box->cells[0] + 1) == 0) box->masses[i] = 0;
}
