/* Scenes of one body whose points stand in a grid, with springs and squares between them, and which meets
 * itself. */
#ifndef TEST_GRID_SCENES_H
#define TEST_GRID_SCENES_H

#include "scenes.h"

/* A grid of points with springs and squares between them. */
typedef struct grid {
  const sbf_vec3 *at;
  uint32_t columns, rows, cut; /* no square and no spring joins row cut - 1 to row cut; 0: all are joined */
  float point_kg, stiffness, bending;
} grid;

/* Begun, not started: of friction 1, 5 mm thick, in air that takes a share of 1/s of what moves. */
scene grid_begin(const grid *g);

/* Whether the way from a to b goes through the triangle. */
bool grid_pierces(sbf_vec3 a, sbf_vec3 b, sbf_vec3 p, sbf_vec3 q, sbf_vec3 r);

#endif
