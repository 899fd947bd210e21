#include "mesh_quality.h"

#include <math.h>
#include <stdio.h>

typedef struct vector {
  double x, y, z;
} vector;

static vector between(sbf_vec3 a, sbf_vec3 b) {
  return (vector){(double)b.x - (double)a.x, (double)b.y - (double)a.y, (double)b.z - (double)a.z};
}
static vector cross(vector a, vector b) {
  return (vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static double dot(vector a, vector b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
static double length(vector a) {
  return sqrt(dot(a, a));
}

/* With edges a, b, c from one corner and V six times the volume: the inner radius is V over the sum of the
 * doubled areas, the outer |a^2 b x c + b^2 c x a + c^2 a x b| / 2V. */
double mesh_radius_ratio(const sbf_vec3 *positions, const uint32_t *p) {
  vector a = between(positions[p[0]], positions[p[1]]), b = between(positions[p[0]], positions[p[2]]);
  vector c = between(positions[p[0]], positions[p[3]]);
  vector bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
  vector opposite = {bc.x + ca.x + ab.x, bc.y + ca.y + ab.y, bc.z + ca.z + ab.z};
  double volume = dot(a, bc), areas = length(bc) + length(ca) + length(ab) + length(opposite);
  double aa = dot(a, a), bb = dot(b, b), cc = dot(c, c);
  vector centre = {aa * bc.x + bb * ca.x + cc * ab.x, aa * bc.y + bb * ca.y + cc * ab.y,
      aa * bc.z + bb * ca.z + cc * ab.z};
  double around = length(centre);
  if (!(volume > 0) || !(areas > 0) || !(around > 0)) return 0;
  return fmin(1, 3 * (volume / areas) / (around / (2 * volume)));
}

static double spring_length(const sbf_level *level, const sbf_spring_set *set, uint32_t i) {
  if (set->rest_lengths.count) return (double)set->rest_lengths.at[i];
  const uint32_t *ends = set->ends.at[i].at;
  return length(between(level->positions.at[ends[0]], level->positions.at[ends[1]]));
}

static uint32_t bin_of(double fraction) {
  return fraction >= 1 ? MESH_QUALITY_BINS - 1 : fraction > 0 ? (uint32_t)(fraction * MESH_QUALITY_BINS) : 0;
}

static void add_tetrahedra(const sbf_level *level, mesh_quality *q) {
  const sbf_uint4_list *tetrahedra = &level->lattice.tetrahedra;
  sbf_lattice_measures m;
  if (tetrahedra->count == 0) return;
  sbf_lattice_measure(level->positions.at, tetrahedra->at, tetrahedra->count, &m);
  q->tetrahedra += tetrahedra->count;
  q->inverted += m.inverted_count;
  q->volume_m3 += m.volume;
  q->min_dihedral_deg = fmin(q->min_dihedral_deg, m.min_dihedral_deg);
  q->max_dihedral_deg = fmax(q->max_dihedral_deg, m.max_dihedral_deg);
  for (int k = 0; k < SBF_DIHEDRAL_BINS; k++) q->dihedrals[k] += m.dihedrals[k];
  for (uint32_t i = 0; i < tetrahedra->count; i++) {
    double ratio = mesh_radius_ratio(level->positions.at, tetrahedra->at[i].at);
    q->min_radius_ratio = fmin(q->min_radius_ratio, ratio);
    q->radius_ratio_sum += ratio;
    q->radius_ratios[bin_of(ratio)]++;
  }
}

static void add_springs(const sbf_level *level, mesh_quality *q, bool in_bins) {
  for (uint32_t s = 0; s < level->springs.count; s++)
    for (uint32_t i = 0; i < level->springs.at[s].ends.count; i++) {
      double l = spring_length(level, &level->springs.at[s], i);
      if (in_bins) {
        q->spring_lengths[bin_of(q->max_spring_m > 0 ? l / q->max_spring_m : 0)]++;
        continue;
      }
      q->springs++;
      q->spring_sum_m += l;
      q->min_spring_m = fmin(q->min_spring_m, l);
      q->max_spring_m = fmax(q->max_spring_m, l);
    }
}

void mesh_quality_measure(const sbf_asset *asset, const sbf_soft_body *body, mesh_quality *q) {
  *q = (mesh_quality){.min_dihedral_deg = 180, .min_radius_ratio = 1, .min_spring_m = INFINITY};
  for (int pass = 0; pass < 2; pass++)
    for (uint32_t i = 0; i < asset->soft_bodies.count; i++) {
      const sbf_soft_body *one = &asset->soft_bodies.at[i];
      if ((body && one != body) || one->levels.count == 0) continue;
      if (pass == 0) add_tetrahedra(&one->levels.at[0], q);
      add_springs(&one->levels.at[0], q, pass == 1);
    }
}

static json_t *histogram(const uint64_t *bins, int count) {
  json_t *list = json_array();
  for (int i = 0; i < count; i++) json_array_append_new(list, json_integer((json_int_t)bins[i]));
  return list;
}

json_t *mesh_quality_json(const mesh_quality *q) {
  json_t *tetrahedra = json_null(), *springs = json_null();
  if (q->tetrahedra)
    tetrahedra = json_pack("{s:I, s:I, s:f, s:f, s:f, s:o, s:f, s:f, s:o}", "count",
        (json_int_t)q->tetrahedra, "inverted", (json_int_t)q->inverted, "volume_m3", q->volume_m3,
        "least_dihedral_deg", q->min_dihedral_deg, "most_dihedral_deg", q->max_dihedral_deg, "dihedrals",
        histogram(q->dihedrals, SBF_DIHEDRAL_BINS), "least_radius_ratio", q->min_radius_ratio,
        "mean_radius_ratio", q->radius_ratio_sum / (double)q->tetrahedra, "radius_ratios",
        histogram(q->radius_ratios, MESH_QUALITY_BINS));
  if (q->springs)
    springs = json_pack("{s:I, s:f, s:f, s:f, s:o}", "count", (json_int_t)q->springs, "least_m",
        q->min_spring_m, "mean_m", q->spring_sum_m / (double)q->springs, "most_m", q->max_spring_m, "lengths",
        histogram(q->spring_lengths, MESH_QUALITY_BINS));
  return json_pack("{s:o, s:o}", "tetrahedra", tetrahedra, "springs", springs);
}

void mesh_quality_print(const mesh_quality *q) {
  if (q->tetrahedra)
    printf("radius ratios of tetrahedra: %.3f at least, %.3f on average (1 is regular)\n",
        q->min_radius_ratio, q->radius_ratio_sum / (double)q->tetrahedra);
  if (q->springs)
    printf("lengths of springs: %.4g to %.4g m, %.4g on average\n", q->min_spring_m, q->max_spring_m,
        q->spring_sum_m / (double)q->springs);
}
