#include "chart/oscillation.h"

#include <math.h>

/* The cubic through samples at -1, 0, 1 and 2. */
static double cubic(const double y[4], double x) {
  return y[0] * (x * (x - 1) * (x - 2)) / -6 + y[1] * ((x + 1) * (x - 1) * (x - 2)) / 2 +
         y[2] * ((x + 1) * x * (x - 2)) / -2 + y[3] * ((x + 1) * x * (x - 1)) / 6;
}

/* Time of the upward crossing of the level between samples i - 1 and i, in steps from the first. */
static double crossing(const double *signal, uint32_t count, uint32_t i, double level) {
  double before = signal[i - 1] - level, now = signal[i] - level, low = 0, high = 1;
  if (i < 2 || i + 1 >= count) return i - 1 + before / (before - now);
  const double near[4] = {signal[i - 2] - level, before, now, signal[i + 1] - level};
  for (int k = 0; k < 50; k++) {
    double middle = (low + high) / 2;
    if (cubic(near, middle) < 0)
      low = middle;
    else
      high = middle;
  }
  return i - 1 + (low + high) / 2;
}

/* Maximum of sign times the signal within [from, to) samples, interpolated by a parabola through the
 * largest sample and its neighbours. */
static double extreme(const double *signal, uint32_t count, uint32_t from, uint32_t to, double sign) {
  uint32_t best = from;
  for (uint32_t i = from; i < to; i++)
    if (sign * signal[i] > sign * signal[best]) best = i;
  if (best == 0 || best + 1 >= count) return sign * signal[best];
  double a = sign * signal[best - 1], b = sign * signal[best], c = sign * signal[best + 1];
  double bend = a - 2 * b + c;
  return bend < 0 ? b - (a - c) * (a - c) / (8 * bend) : b;
}

static double height(const double *signal, uint32_t count, double from, double to) {
  uint32_t first = (uint32_t)ceil(from), end = (uint32_t)ceil(to);
  if (end > count) end = count;
  return (extreme(signal, count, first, end, 1) + extreme(signal, count, first, end, -1)) / 2;
}

bool chart_swing_of(const double *signal, uint32_t count, double step_s, double level, chart_swing *swing) {
  static const double pi = 3.14159265358979323846;
  double first = -1, second = -1, before_last = -1, last = -1;
  uint32_t crossings = 0;
  *swing = (chart_swing){.periods = 0};
  for (uint32_t i = 1; i < count; i++) {
    if (!(signal[i - 1] < level && signal[i] >= level)) continue;
    before_last = last;
    last = crossing(signal, count, i, level);
    if (crossings == 0) first = last;
    if (crossings == 1) second = last;
    crossings++;
  }
  if (crossings < 2) return false;
  swing->periods = crossings - 1;
  swing->period_s = (last - first) / swing->periods * step_s;
  swing->first_height = height(signal, count, first, second);
  swing->last_height = height(signal, count, before_last, last);
  if (swing->periods > 1)
    swing->damping_ratio = log(swing->first_height / swing->last_height) / (2 * pi * (swing->periods - 1));
  return true;
}
