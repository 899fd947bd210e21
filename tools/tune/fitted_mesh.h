/* Stiffness of a coarse mesh, fitted so that it moves as the reference does. */
#ifndef TUNE_FITTED_MESH_H
#define TUNE_FITTED_MESH_H

#include "tune/comparison.h"
#include "tune/tuned_meshes.h"

enum { TUNE_MAX_DRIVES = 2 };

typedef struct tune_fit {
  const tune_comparison *drives[TUNE_MAX_DRIVES];
  uint32_t drive_count;
} tune_fit;

/* Makes a copy of a mesh in which the stiffness of each body has a factor between a quarter and four: the one
 * with the smallest error of the body's skin in all measured motions. `fitted->asset` stays NULL if no body
 * has a better factor than 1, or if nothing is measured. Fails only if memory runs out. */
sbf_status tune_fit_mesh(
    const tune_mesh *mesh, const tune_fit *fit, tune_mesh *fitted, sbf_diagnostic *error);

#endif
