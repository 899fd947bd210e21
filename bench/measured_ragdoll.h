/* A person of twenty boxes with ball joints, as game characters have: what ragdolls are measured by. */
#ifndef BENCH_MEASURED_RAGDOLL_H
#define BENCH_MEASURED_RAGDOLL_H

#include "sbfmt/asset.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { RAGDOLL_PARTS = 20 };

typedef struct ragdoll_part {
  int parent;      /* below 0: none */
  sbf_vec3 joint;  /* m, at rest: to its parent */
  sbf_vec3 middle; /* of its box */
  sbf_vec3 size;   /* of its box, whole edges */
  float mass;      /* kg */
} ragdoll_part;

/* Standing on y = 0. Between part and parent a cone about x of RAGDOLL_SWING and a twist of RAGDOLL_TWIST
 * either way, rad. */
extern const ragdoll_part ragdoll_parts[RAGDOLL_PARTS];
#define RAGDOLL_SWING 0.7f
#define RAGDOLL_TWIST 0.3f

#ifdef __cplusplus
}
#endif

/* The same as rigid bodies and joints of a file, each body with a bone. */
sbf_asset *ragdoll_asset(void);

#endif
