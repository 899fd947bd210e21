#define _GNU_SOURCE
#include "chart/rounds.h"

#include <stdlib.h>
#include <time.h>
#ifdef __linux__
#include <sched.h>
#endif

double chart_now_s(void) {
  struct timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

bool chart_stay_on_core(uint32_t core) {
#ifdef __linux__
  cpu_set_t may, one;
  if (sched_getaffinity(0, sizeof may, &may) != 0) return false;
  for (int i = 0; i < CPU_SETSIZE; i++) {
    if (!CPU_ISSET(i, &may) || core-- > 0) continue;
    CPU_ZERO(&one);
    CPU_SET(i, &one);
    return sched_setaffinity(0, sizeof one, &one) == 0;
  }
#endif
  (void)core;
  return false;
}

static double time_of(const chart_timed *c) {
  double begin = chart_now_s();
  c->run(c->context);
  double end = chart_now_s();
  if (c->after) c->after(c->context);
  return end - begin;
}

bool chart_time_in_turns(chart_timed *all, uint32_t count, uint32_t rounds,
    void (*progress)(void *user, double fraction), void *user) {
  double *samples = calloc((size_t)count * rounds + 1, sizeof *samples);
  if (!samples) return false;
  for (uint32_t i = 0; i < count; i++) time_of(&all[i]);
  for (uint32_t r = 0; r < rounds; r++)
    for (uint32_t i = 0; i < count; i++) {
      uint32_t turn = r % 2 ? count - 1 - i : i;
      samples[(size_t)turn * rounds + r] = time_of(&all[turn]);
      if (progress) progress(user, ((double)r * count + i + 1) / ((double)rounds * count));
    }
  for (uint32_t i = 0; i < count; i++) {
    double *own = samples + (size_t)i * rounds;
    for (uint32_t r = 0; all[i].times && r < rounds; r++) all[i].times[r] = own[r];
    all[i].s = chart_spread_of(own, rounds);
  }
  free(samples);
  return true;
}
