/* A rig to walk with: a quadruped of one metre, made in memory, facing +Z. */
#ifndef TEST_QUADRUPED_H
#define TEST_QUADRUPED_H

#include "skeleton/rig.h"

enum { QUADRUPED_HIND_L, QUADRUPED_HIND_R, QUADRUPED_FORE_L, QUADRUPED_FORE_R };

typedef struct quadruped {
  sbf_asset *asset;
  sbri_rig rig;
  void *memory;
} quadruped;

/* The asset alone; freed with sbf_asset_free. */
sbf_asset *quadruped_asset(void);
void quadruped_create(quadruped *q);
void quadruped_destroy(quadruped *q);

#endif
