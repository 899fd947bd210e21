/* Whether points hold a thing, or lie on a line that it turns about. */
#ifndef SBFI_LINE_WIDTH_H
#define SBFI_LINE_WIDTH_H

#include "sbfmt/base.h"

/* The line through two points that lie far from each other. */
typedef struct sbfi_farthest_line {
  double from[3], along[3]; /* m; of length 1, or 0 where all points are in one place */
  double length;            /* m, between both */
  double width;             /* m, of the point farthest from the line; 0 of fewer than three */
} sbfi_farthest_line;

/* Through that point of the list which is farthest from the first, and the one farthest from that. */
sbfi_farthest_line sbfi_farthest_line_of(const sbf_vec3 *positions, const uint32_t *list, uint32_t count);

/* Distance of a place from the line, or where it has no length from its point, m. */
double sbfi_line_distance(const sbfi_farthest_line *line, sbf_vec3 position);

#endif
