/* How fast a body of springs oscillates about the places it is given: its slowest and its fastest mode. The
 * fastest bounds the step of explicit schemes, the slowest is where a damping ratio is stated. */
#ifndef SBFI_MODES_H
#define SBFI_MODES_H

#include "base/memory.h"
#include "mechanics/spring.h"

typedef struct sbfi_modes_input {
  uint32_t point_count;
  const float *positions;      /* x, y, z of point i at positions[stride * i] */
  size_t stride;               /* >= 3 */
  const float *inverse_masses; /* (point_count) 1/kg; 0: held where it is */
  const sbfi_spring *springs;  /* (spring_count) */
  uint32_t spring_count;
} sbfi_modes_input;

typedef struct sbfi_modes {
  double slowest_rad_s; /* of the modes that change a spring's length; 0: there is none */
  double fastest_rad_s;
  double bound_rad_s; /* no state of the body has a faster mode, while no spring is shorter than half its rest
                         length: Gershgorin's circles around springs that resist in every direction */
} sbfi_modes;

/* False where memory runs out. Takes some 100 visits of each spring. */
bool sbfi_modes_find(const sbfi_modes_input *input, sbfi_modes *modes, const sbf_allocator *allocator);

#endif
