/* How well the elements of an asset are shaped: tetrahedra and springs of the finest levels. */
#ifndef MESH_QUALITY_H
#define MESH_QUALITY_H

#include <jansson.h>

#include "sbfmt/mechanics.h"

enum { MESH_QUALITY_BINS = 10 };

typedef struct mesh_quality {
  uint64_t tetrahedra, inverted, springs;
  double volume_m3;
  double min_dihedral_deg, max_dihedral_deg;
  uint64_t dihedrals[SBF_DIHEDRAL_BINS]; /* six angles a tetrahedron, by tens of degrees */
  /* Three times the radius of the sphere inside a tetrahedron over that of the sphere around it: 1 in a
   * regular one, 0 in a flat one. */
  double min_radius_ratio, radius_ratio_sum;
  uint64_t radius_ratios[MESH_QUALITY_BINS]; /* by tenths */
  double min_spring_m, max_spring_m, spring_sum_m;
  uint64_t spring_lengths[MESH_QUALITY_BINS]; /* by tenths of the longest of the asset; mesh_quality_measure
                                                 only */
} mesh_quality;

double mesh_radius_ratio(const sbf_vec3 *positions, const uint32_t *corners);

/* Of one body; of all of them, `body` NULL. */
void mesh_quality_measure(const sbf_asset *asset, const sbf_soft_body *body, mesh_quality *q);
json_t *mesh_quality_json(const mesh_quality *q);
/* The lines that a build prints; nothing where there are no elements. */
void mesh_quality_print(const mesh_quality *q);

#endif
