/* Measures the shapes of an asset's elements: tetrahedra and springs of the finest levels. */
#ifndef MESH_QUALITY_H
#define MESH_QUALITY_H

#include <jansson.h>

#include "sbfmt/mechanics.h"

enum { MESH_QUALITY_BINS = 10 };

typedef struct mesh_quality {
  uint64_t tetrahedra, inverted, springs;
  double volume_m3;
  double min_dihedral_deg, max_dihedral_deg;
  uint64_t dihedrals[SBF_DIHEDRAL_BINS]; /* six angles per tetrahedron, in bins of ten degrees */
  /* Three times the radius of the inscribed sphere of a tetrahedron over that of the circumscribed one: 1
   * for a regular one, 0 for a flat one. */
  double min_radius_ratio, radius_ratio_sum;
  uint64_t radius_ratios[MESH_QUALITY_BINS]; /* in bins of a tenth */
  double min_spring_m, max_spring_m, spring_sum_m;
  uint64_t spring_lengths[MESH_QUALITY_BINS]; /* in bins of a tenth of the longest in the asset;
                                                 mesh_quality_measure only */
} mesh_quality;

double mesh_radius_ratio(const sbf_vec3 *positions, const uint32_t *corners);

/* Of one body, or of all if `body` is NULL. */
void mesh_quality_measure(const sbf_asset *asset, const sbf_soft_body *body, mesh_quality *q);
json_t *mesh_quality_json(const mesh_quality *q);
/* Prints the lines of a build; nothing if there are no elements. */
void mesh_quality_print(const mesh_quality *q);

#endif
