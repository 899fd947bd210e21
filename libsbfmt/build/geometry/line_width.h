/* Whether points fix an object, or are on a line about which it rotates. */
#ifndef SBFI_LINE_WIDTH_H
#define SBFI_LINE_WIDTH_H

#include "sbfmt/base.h"

/* The line through two distant points. */
typedef struct sbfi_farthest_line {
  double from[3], along[3]; /* m; direction of length 1, or 0 if all points coincide */
  double length;            /* m, between both */
  double width;             /* m, maximum distance of a point from the line; 0 for fewer than three */
} sbfi_farthest_line;

/* Line through the point of the list that is farthest from the first, and the one farthest from that. */
sbfi_farthest_line sbfi_farthest_line_of(const sbf_vec3 *positions, const uint32_t *list, uint32_t count);

/* Distance of a position from the line, or from its point if it has no length, m. */
double sbfi_line_distance(const sbfi_farthest_line *line, sbf_vec3 position);

#endif
