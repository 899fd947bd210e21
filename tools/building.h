/* The build passes as `convert` and `build` run them: their options, progress, and what they say they made.
 */
#ifndef BUILDING_H
#define BUILDING_H

#include "cli.h"
#include "sbfmt/io.h"

#define BUILDING_OPTIONS                                                                                     \
  {"--springs", "METHOD",                                                                                    \
      "automatic, centroid, lattice, surface (or none), brute: springs; tetrahedra, shape_matching: no "     \
      "springs (automatic)"},                                                                                \
      {"--cell", "METRES", "edge of a lattice's cubes (by --elements)"},                                     \
      {"--elements", "N", "about so many tetrahedra a body (2000, thin ones up to 16000)"},                  \
      {"--error", "METRES",                                                                                  \
          "the coarsest lattice that gives so nearly as a fine one does; takes tetrahedra"},                 \
      {"--levels", "N", "levels a body, finest first: coarser lattices, springs, jiggle (1)"},               \
      {"--render-levels", "N", "coarser levels of render meshes, each of half the triangles (none)"},        \
      {"--render-error", "METRES", "no render level farther off than this; alone: as many as that allows"},  \
      {"--no-calibration", NULL, "leave moduli of coarse lattices and springs as they are"},                 \
      {"--sections", "auto|none",                                                                            \
          "cut skinned meshes into sections, where no bodies lie along the skin (auto)"},                    \
  {                                                                                                          \
    "--overlap", "METRES", "how far sections reach over a cut (half the limb's radius there)"                \
  }

/* False, with a message, where the options are wrong. */
bool building_check(const cli_call *call);

/* Replaces *asset by what the passes make of it, and says what they made. `budget_us` above 0: the sections
 * of a skin are as fine, and as many, as that allows (section_budget.h), and their levels state what they
 * cost. *asset is freed where that fails. */
sbf_status building_run(cli_call *call, sbf_asset **asset, double budget_us, sbf_diagnostic *error);

#endif
