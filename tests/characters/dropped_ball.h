/* A ball of a material preset, built and stepped with all settings at their defaults, that falls to a floor.
 */
#ifndef TEST_DROPPED_BALL_H
#define TEST_DROPPED_BALL_H

#include <stdbool.h>

typedef struct dropped_ball {
  const char *preset;
  float poisson; /* 0: the preset's */
  float radius_m, height_m;
} dropped_ball;

/* Lets it fall and lie for 1.5 s. Fails the test unless at every tick all numbers are finite and it has no
 * more energy than it began with, it never loses its shape for good, and its volume ends within 5 %, beside
 * what its own weight takes. Balls that strike at more than twice their speed of sound in a rod may lose
 * their shape once: such an impact flattens their lowest elements with any number of steps. */
void dropped_ball_check(const dropped_ball *ball);

/* Whether any of its elements is inside out at the end of any tick of the first 1.5 s. */
bool dropped_ball_inverts(const dropped_ball *ball);

#endif
