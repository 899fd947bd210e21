/* A person of 14 boxes with a bone each, or of 20 with hands, toes and a tail: ball joints with cones of 0.7
 * rad and twists of 0.3 between them. */
#ifndef TEST_RIGID_PERSON_H
#define TEST_RIGID_PERSON_H

#include "rigid_scenes.h"

enum { PARTS = 14, ALL_PARTS = 20 };
typedef struct part {
  int parent;
  sbf_vec3 head, tail;
  float mass;
} part;
extern const part person_parts[ALL_PARTS];

/* Not yet started, 2 cm above flat ground, every body dynamic. */
scene person(void);
scene whole_person(void);
/* An impulse on a body, a little above its middle. */
void person_shove(const scene *s, uint32_t body, sbf_vec3 impulse);
/* Greatest speed of a body's middle, m/s. */
float person_fastest(const scene *s);

#endif
