/* Meshes of the example pudding. */
#ifndef TEST_PUDDING_MESHES_H
#define TEST_PUDDING_MESHES_H

#include "tune/comparison.h"
#include "tune/tuned_meshes.h"

/* Converts it and makes its meshes; free them with tune_meshes_free. Ends the test if that fails. */
void make_pudding_meshes(tune_meshes *meshes, const tune_grid *grid);

/* Comparison with their reference by the 99th percentile, of a single run each; free it with
 * tune_comparison_free. */
void compare_to_reference(const tune_meshes *meshes, tune_comparison *comparison);

#endif
