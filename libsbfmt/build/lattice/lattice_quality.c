#include "build/lattice/lattice_quality.h"

#include "build/geometry/winding_number.h"

static void add_angle(sbfi_lattice_quality *quality, double degrees) {
  int bin = (int)(degrees / 10);
  if (degrees < quality->least_deg) quality->least_deg = degrees;
  if (degrees > quality->most_deg) quality->most_deg = degrees;
  quality->histogram[bin < 0 ? 0 : bin < SBFI_DIHEDRAL_BINS ? bin : SBFI_DIHEDRAL_BINS - 1]++;
}

void sbfi_dihedrals_measure(
    sbfi_lattice_quality *quality, const sbf_vec3 *positions, const sbf_uint4 *tetrahedra, uint32_t count) {
  static const int faces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  const double degrees = 180 / 3.14159265358979323846;
  for (uint32_t t = 0; t < count; t++) {
    sbfi_d3 at[4], normals[4];
    for (int k = 0; k < 4; k++) at[k] = sbfi_d3_of(positions[tetrahedra[t].at[k]]);
    for (int f = 0; f < 4; f++) {
      sbfi_d3 from = at[faces[f][0]];
      normals[f] = sbfi_d3_normal(
          sbfi_d3_cross(sbfi_d3_sub(at[faces[f][1]], from), sbfi_d3_sub(at[faces[f][2]], from)));
    }
    quality->volume += sbfi_d3_dot(sbfi_d3_sub(at[1], at[0]),
                           sbfi_d3_cross(sbfi_d3_sub(at[2], at[0]), sbfi_d3_sub(at[3], at[0]))) /
                       6;
    for (int f = 0; f < 4; f++) {
      for (int g = 0; g < f; g++) {
        double cosine = -sbfi_d3_dot(normals[f], normals[g]);
        double sine = sbfi_d3_length(sbfi_d3_cross(normals[f], normals[g]));
        add_angle(quality, sbfi_angle(sine, cosine) * degrees);
      }
    }
  }
}
