/* MuJoCo integrates flexes explicitly: a step too long for their fastest mode gives huge accelerations.
 * This one is half of the stability limit of symplectic Euler with damping: w^2 h^2 + 2 b w^2 h < 4 for
 * stiffness-proportional damping b, from its characteristic polynomial at -1. */
#include <math.h>

#include "export/mjcf.h"
#include "sbfmt/mechanics.h"

/* MuJoCo's default, unless a smaller one is required. */
#define LONGEST_STEP_S 0.002

static bool fastest_of_lattice(
    mjcf_writer *w, const mjcf_flex *flex, float value, float *mass, double *scratch, double *w2) {
  const sbf_level *level = flex->level;
  sbf_spring_network network = {
      .point_count = level->positions.count, .positions = flex->positions, .masses = mass};
  if (flex->dim == 3) {
    uint32_t count = level->lattice.tetrahedra.count;
    float *moduli = sbfi_arena_allocate(&w->scratch, count, sizeof *moduli);
    float *ratios = sbfi_arena_allocate(&w->scratch, count, sizeof *ratios);
    if (!moduli || !ratios) return false;
    for (uint32_t i = 0; i < count; i++) moduli[i] = value, ratios[i] = sbfi_mjcf_ratio(flex->body);
    network.tetrahedron_count = count;
    network.tetrahedra = level->lattice.tetrahedra.at;
    network.young_modulus = moduli;
    network.poisson_ratios = ratios;
  } else {
    uint32_t count = 0;
    for (uint32_t s = 0; s < level->springs.count; s++) count += level->springs.at[s].ends.count;
    sbf_uint2 *ends = sbfi_arena_allocate(&w->scratch, count, sizeof *ends);
    float *stiffness = sbfi_arena_allocate(&w->scratch, count, sizeof *stiffness);
    if (!ends || !stiffness) return false;
    for (uint32_t s = 0, k = 0; s < level->springs.count; s++)
      for (uint32_t i = 0; i < level->springs.at[s].ends.count; i++, k++)
        ends[k] = level->springs.at[s].ends.at[i], stiffness[k] = value;
    network.spring_count = count;
    network.ends = ends;
    network.stiffness = stiffness;
  }
  double fastest = sbf_network_highest_bound(&network, scratch);
  *w2 = fastest * fastest;
  return true;
}

/* For a sheet: a triangle's stiffness is at most E t / (1 - nu) times the sum of its shape functions'
 * squared gradients times its area, which is the sum of its squared edges over four times the area. */
static double fastest_of_sheet(
    const mjcf_flex *flex, float modulus, float thickness, const float *mass, double *sums) {
  const sbf_polygon_mesh *mesh = &flex->body->surface;
  double max = 0;
  for (uint32_t i = 0; i < flex->level->positions.count; i++) sums[i] = 0;
  for (uint32_t i = 0, corner = 0; i < mesh->polygon_sizes.count; i++) {
    for (uint32_t k = 2; k < mesh->polygon_sizes.at[i]; k++) {
      const uint32_t at[3] = {corner, corner + k - 1, corner + k};
      uint32_t p[3];
      double sides[3][3], squares = 0;
      for (int c = 0; c < 3; c++) p[c] = sbfi_export_index(flex->level, mesh->polygon_points.at[at[c]]);
      for (int c = 0; c < 3; c++) {
        const sbf_vec3 a = flex->positions[p[c]], b = flex->positions[p[(c + 1) % 3]];
        sides[c][0] = (double)b.x - a.x, sides[c][1] = (double)b.y - a.y, sides[c][2] = (double)b.z - a.z;
        for (int d = 0; d < 3; d++) squares += sides[c][d] * sides[c][d];
      }
      double area2 = 0;
      for (int d = 0; d < 3; d++) {
        int e = (d + 1) % 3, f = (d + 2) % 3;
        double n = sides[0][e] * sides[1][f] - sides[0][f] * sides[1][e];
        area2 += n * n;
      }
      if (!(area2 > 0)) continue;
      double stiffness =
          modulus * thickness / (1 - sbfi_mjcf_ratio(flex->body)) * squares / (2 * sqrt(area2));
      for (int c = 0; c < 3; c++) sums[p[c]] += stiffness;
    }
    corner += mesh->polygon_sizes.at[i];
  }
  for (uint32_t i = 0; i < flex->level->positions.count; i++)
    if (mass[i] > 0 && sums[i] / mass[i] > max) max = sums[i] / mass[i];
  return max;
}

bool sbfi_mjcf_timestep(mjcf_writer *w, float *step) {
  double min = LONGEST_STEP_S;
  for (uint32_t b = 0; b < w->e->asset->soft_bodies.count; b++) {
    const mjcf_flex *flex = &w->flexes[b];
    if (!flex->level) continue;
    uint32_t points = flex->level->positions.count;
    double w2 = 0, *scratch = sbfi_arena_allocate(&w->scratch, points, sizeof *scratch);
    float value, *mass = sbfi_arena_allocate(&w->scratch, points, sizeof *mass);
    bool differ = false;
    if (!scratch || !mass || !sbfi_mjcf_matter(w, flex, &value, &differ)) return false;
    for (uint32_t p = 0; p < points; p++) mass[p] = flex->holder[p] < 0 ? sbfi_mjcf_point_mass(flex, p) : 0;
    if (flex->dim == 2)
      w2 = fastest_of_sheet(flex, value, flex->body->attributes.thickness, mass, scratch);
    else if (!fastest_of_lattice(w, flex, value, mass, scratch, &w2))
      return false;
    if (!(w2 > 0)) continue;
    double damping = flex->body->attributes.stiffness_damping;
    double longest = sqrt(damping * damping + 4 / w2) - damping;
    if (longest / 2 < min) min = longest / 2;
  }
  *step = (float)min;
  return true;
}
