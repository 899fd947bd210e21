#include "build/geometry/line_width.h"

#include <math.h>

double sbfi_line_distance(const sbfi_farthest_line *line, sbf_vec3 position) {
  double d[3] = {(double)position.x - line->from[0], (double)position.y - line->from[1],
      (double)position.z - line->from[2]};
  double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
  double dot = d[0] * line->along[0] + d[1] * line->along[1] + d[2] * line->along[2];
  return sqrt(fmax(0, square - dot * dot));
}

static uint32_t farthest(const sbfi_farthest_line *line, const sbf_vec3 *positions, const uint32_t *list,
    uint32_t count, double *distance) {
  uint32_t best = list[0];
  *distance = -1;
  for (uint32_t i = 0; i < count; i++) {
    double d = sbfi_line_distance(line, positions[list[i]]);
    if (d <= *distance) continue;
    *distance = d;
    best = list[i];
  }
  return best;
}

static void begin_at(sbfi_farthest_line *line, sbf_vec3 position) {
  line->from[0] = position.x, line->from[1] = position.y, line->from[2] = position.z;
}

sbfi_farthest_line sbfi_farthest_line_of(const sbf_vec3 *positions, const uint32_t *list, uint32_t count) {
  sbfi_farthest_line line = {{0}, {0}, 0, 0};
  if (count == 0) return line;
  begin_at(&line, positions[list[0]]);
  begin_at(&line, positions[farthest(&line, positions, list, count, &line.length)]);
  sbf_vec3 b = positions[farthest(&line, positions, list, count, &line.length)];
  if (!(line.length > 0)) return line;
  line.along[0] = ((double)b.x - line.from[0]) / line.length;
  line.along[1] = ((double)b.y - line.from[1]) / line.length;
  line.along[2] = ((double)b.z - line.from[2]) / line.length;
  if (count > 2) farthest(&line, positions, list, count, &line.width);
  return line;
}
