/* Measures the quality of a lattice: volumes, dihedral angles and quality of its tetrahedra. */
#include <math.h>

#include "mechanics/angle.h"
#include "mechanics/vector.h"
#include "sbfmt/mechanics.h"

/* Cosines of the lower bounds of all bins but the first; bins include their lower bound. */
static const double cosines[SBF_DIHEDRAL_BINS - 1] = {0.98480775301220806, 0.93969262078590838,
    0.86602540378443865, 0.76604444311897804, 0.64278760968653933, 0.5, 0.34202014332566873,
    0.17364817766693035, 0, -0.17364817766693035, -0.34202014332566873, -0.5, -0.64278760968653933,
    -0.76604444311897804, -0.86602540378443865, -0.93969262078590838, -0.98480775301220806};

static void add_angle(uint64_t *histogram, double cosine) {
  int bin = 0;
  for (int i = 0; i < SBF_DIHEDRAL_BINS - 1; i++) bin += cosine <= cosines[i];
  histogram[bin]++;
}

static double angle_of(double cosine) {
  double sine2 = 1 - cosine * cosine;
  return sbfi_angle(sine2 > 0 ? sqrt(sine2) : 0, cosine) * (180 / SBFI_PI);
}

void sbf_lattice_measure(
    const sbf_vec3 *positions, const sbf_uint4 *tetrahedra, uint32_t count, sbf_lattice_measures *measures) {
  double max = -2, min = 2; /* as cosines */
  *measures = (sbf_lattice_measures){.min_dihedral_deg = 180};
  for (uint32_t t = 0; t < count; t++) {
    sbfi_d3 at[4], normals[4];
    for (int k = 0; k < 4; k++) at[k] = sbfi_d3_of(positions[tetrahedra[t].at[k]]);
    sbfi_d3 u = sbfi_d3_sub(at[1], at[0]), v = sbfi_d3_sub(at[2], at[0]), w = sbfi_d3_sub(at[3], at[0]);
    normals[1] = sbfi_d3_cross(v, w);
    normals[2] = sbfi_d3_cross(w, u);
    normals[3] = sbfi_d3_cross(u, v);
    normals[0] = sbfi_d3_scale(sbfi_d3_add(normals[1], sbfi_d3_add(normals[2], normals[3])), -1);
    double volume = sbfi_d3_dot(u, normals[1]) / 6;
    measures->volume += volume;
    measures->inverted_count += !(volume > 0);
    for (int f = 0; f < 4; f++) normals[f] = sbfi_d3_normal(normals[f]);
    for (int f = 1; f < 4; f++) {
      for (int g = 0; g < f; g++) {
        double cosine = -sbfi_d3_dot(normals[f], normals[g]);
        add_angle(measures->dihedrals, cosine);
        max = cosine > max ? cosine : max;
        min = cosine < min ? cosine : min;
      }
    }
  }
  if (count == 0) return;
  measures->min_dihedral_deg = angle_of(max);
  measures->max_dihedral_deg = angle_of(min);
}
