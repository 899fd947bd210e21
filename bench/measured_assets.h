/* The assets that benchmarks measure. */
#ifndef BENCH_MEASURED_ASSETS_H
#define BENCH_MEASURED_ASSETS_H

#include "sbfmt/asset.h"

/* A render mesh of (cells + 1)^2 points with normals and texture coordinates, and cells^2 quads: a bumpy
 * sphere with a little noise, neither as regular as a lattice nor as random as a scan. */
sbf_asset *surface_asset(uint32_t cells);
enum { SURFACE_CELLS = 316 }; /* 100,489 points, 99,856 quads */

/* A character made of `folder`/`mesh` and `folder`/`rig` (NULL: none), as the program's verb `convert` makes
 * it; without derived parts where `build` is false. NULL where the folder has no such mesh. */
sbf_asset *character_asset(const char *folder, const char *mesh, const char *rig, bool build);

/* A copy with render meshes only: the geometry that GLB and OBJ have. Frees its argument. */
sbf_asset *meshes_alone(sbf_asset *asset);

/* The lizard of examples/. */
sbf_asset *our_lizard(bool build);
/* The reference characters, which are not ours to publish and may be absent. */
#define SHARED_FOLDER BENCH_SOURCE_FOLDER "/../shared/data"

uint32_t vertex_count_of(const sbf_asset *asset); /* of all render meshes */
uint32_t polygon_count_of(const sbf_asset *asset);
/* What is simulated: of the finest levels. */
void count_elements(const sbf_asset *asset, uint32_t *points, uint32_t *springs);

#endif
