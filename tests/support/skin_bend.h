/* What becomes of a skin when a joint bends: of the one that sections carry, beside linear blend skinning. */
#ifndef TEST_SKIN_BEND_H
#define TEST_SKIN_BEND_H

#include "sbfmt/model.h"

typedef struct skin_bend {
  double rest_error; /* farthest of a vertex from its place, at rest, in sizes of the mesh */
  double
      lbs_distance; /* farthest of a vertex from where linear blend skinning has it, in sizes of the mesh */
  double crack;     /* farthest apart of two vertices that stand in one place at rest, in sizes */
  double seam_stretch;  /* greatest area of a triangle between sections, in areas at rest */
  double lbs_stretch;   /* the same of linear blend skinning */
  uint32_t seam_count;  /* triangles whose corners belong to different sections */
  uint32_t poses;       /* joints times axes times directions */
  uint32_t worse_poses; /* with more flips than linear blend skinning has in them */
  /* Triangles whose normal turned over against what its corners' bones turn it to. */
  uint32_t flips, lbs_flips;
  uint32_t stretched, lbs_stretched; /* seam triangles above twice their area */
} skin_bend;

/* Bends the joint of every bone with a parent by `angle_rad` about the three axes of its frame, both ways,
 * one at a time; every section moves with its bone as one piece, and what pins hold with theirs. */
void skin_bend_measure(const sbf_asset *asset, uint32_t mesh, double angle_rad, skin_bend *result);

#endif
