/* An asset to walk with: a quadruped of one metre, made in memory, facing +Z. */
#ifndef TEST_QUADRUPED_H
#define TEST_QUADRUPED_H

#include "sbfmt/model.h"

enum { QUADRUPED_HIND_L, QUADRUPED_HIND_R, QUADRUPED_FORE_L, QUADRUPED_FORE_R };

/* Freed with sbf_asset_free. */
sbf_asset *quadruped_asset(void);

#endif
