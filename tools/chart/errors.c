#include "chart/errors.h"

#include <math.h>
#include <stdlib.h>

#include "chart/oscillation.h"

const char *const chart_axis_names[CHART_AXIS_COUNT] = {
    "path_m", "farthest_m", "period", "amplitude", "shape", "volume", "energy", "path_px", "farthest_px"};
const char *const chart_axis_labels[CHART_AXIS_COUNT] = {"off the path, RMS (m)", "off the path, most (m)",
    "period, share off", "amplitude, share off", "shape at rest, share off", "volume, share off",
    "energy, share of what was in motion", "off on the screen, RMS (pixels)",
    "off on the screen, most (pixels)"};

double chart_pixels_a_metre(double distance_m) {
  static const double lines = 1080, half_field = 0.57735026918962576; /* tan 30 degrees */
  return lines / (2 * distance_m * half_field);
}

static double square_between(sbf_vec3 p, sbf_vec3 q) {
  double x = (double)p.x - (double)q.x, y = (double)p.y - (double)q.y, z = (double)p.z - (double)q.z;
  return x * x + y * y + z * z;
}

double chart_extent_of(const chart_track *t, const sbf_vec3 *rest) {
  double sum = 0;
  for (uint32_t i = 0; i < t->ticks; i++)
    for (uint32_t k = 0; k < t->points; k++)
      sum += square_between(t->positions[(size_t)i * t->points + k], rest[k]);
  return sqrt(sum / ((double)t->ticks * t->points + 1e-9));
}

static void compare_paths(const chart_track *t, const chart_track *r, double errors[CHART_AXIS_COUNT]) {
  size_t count = (size_t)t->ticks * t->points;
  double sum = 0, max = 0;
  for (size_t i = 0; i < count; i++) {
    double off = square_between(t->positions[i], r->positions[i]);
    sum += off;
    if (!(off <= max)) max = off;
  }
  errors[CHART_PATH] = sqrt(sum / (double)(count ? count : 1));
  errors[CHART_FARTHEST] = sqrt(max);
}

static double compare_rest(const chart_track *t, const chart_track *r, const sbf_vec3 *rest) {
  size_t last = (size_t)(t->ticks - 1) * t->points;
  double off = 0, moved = 0;
  for (size_t i = 0; i < t->points; i++) {
    off += square_between(t->positions[last + i], r->positions[last + i]);
    moved += square_between(r->positions[last + i], rest[i]);
  }
  return moved > 0 ? sqrt(off / moved) : NAN;
}

static double compare_energies(const chart_track *t, const chart_track *r) {
  double max = 0, scale = 0;
  for (uint32_t i = 0; i < t->ticks; i++) {
    double off = fabs(t->energy_j[i] - r->energy_j[i]);
    if (!(off <= max)) max = off;
    scale = fmax(scale, r->kinetic_j[i]);
  }
  return scale > 0 ? max / scale : NAN;
}

static double compare_volumes(const chart_track *t, const chart_track *r) {
  double max = 0;
  for (uint32_t i = 0; i < t->ticks; i++) {
    double off = fabs(t->volume[i] - r->volume[i]);
    if (!(off <= max)) max = off;
  }
  return max;
}

static double signal_at(const chart_track *t, const chart_signal *s, uint32_t tick) {
  if (s->of_volume) return t->volume[tick];
  sbf_vec3 p = t->positions[(size_t)tick * t->points + s->point];
  return (double)(s->along == 0 ? p.x : s->along == 1 ? p.y : p.z);
}

static bool compare_swings(const chart_track *t, const chart_track *r, const chart_signal *s, double tick_s,
    double errors[CHART_AXIS_COUNT]) {
  double *own = calloc(t->ticks, sizeof *own), *right = calloc(t->ticks, sizeof *right);
  bool good = own && right;
  double low = INFINITY, high = -INFINITY;
  for (uint32_t i = 0; good && i < t->ticks; i++) {
    own[i] = signal_at(t, s, i), right[i] = signal_at(r, s, i);
    low = fmin(low, right[i]), high = fmax(high, right[i]);
  }
  chart_swing a, b;
  if (good && chart_swing_of(own, t->ticks, tick_s, (low + high) / 2, &a) &&
      chart_swing_of(right, t->ticks, tick_s, (low + high) / 2, &b)) {
    errors[CHART_PERIOD] = fabs(a.period_s / b.period_s - 1);
    errors[CHART_AMPLITUDE] = fabs(a.last_height / b.last_height - 1);
  }
  free(own), free(right);
  return good;
}

static uint32_t end_point(const sbf_vec3 *rest, uint32_t count) {
  uint32_t end = 0;
  for (uint32_t i = 0; i < count; i++)
    if (rest[i].x > rest[end].x) end = i;
  return end;
}

bool chart_errors_of(const chart_track *track, const chart_track *reference, const sbf_vec3 *rest,
    double tick_s, const chart_signal *signal, unsigned axes, double errors[CHART_AXIS_COUNT]) {
  for (int i = 0; i < CHART_AXIS_COUNT; i++) errors[i] = NAN;
  compare_paths(track, reference, errors);
  errors[CHART_SHAPE] = compare_rest(track, reference, rest);
  errors[CHART_VOLUME] = compare_volumes(track, reference);
  errors[CHART_ENERGY] = compare_energies(track, reference);
  chart_signal found = *signal;
  if (signal->point == CHART_END_POINT) found.point = end_point(rest, track->points);
  if (signal->there && !compare_swings(track, reference, &found, tick_s, errors)) return false;
  for (int i = 0; i < CHART_AXIS_COUNT; i++)
    if (!(axes & 1u << i)) errors[i] = NAN;
  return true;
}
