/* Build passes as `convert` and `build` run them: options, progress and messages. */
#ifndef BUILDING_H
#define BUILDING_H

#include "cli.h"
#include "sbfmt/build.h"
#include "sbfmt/io.h"

#define BUILDING_OPTIONS                                                                                     \
  {"--springs", "METHOD",                                                                                    \
      "automatic, centroid, lattice, surface (or none), brute: springs; tetrahedra, shape_matching: no "     \
      "springs (automatic)"},                                                                                \
      {"--cell", "METRES", "edge of a lattice's cubes (by --elements)"},                                     \
      {"--elements", "N", "approximate number of tetrahedra in a body (2000, thin ones up to 16000)"},       \
      {"--error", "METRES",                                                                                  \
          "use the coarsest lattice with at most this displacement error; needs tetrahedra"},                \
      {"--levels", "N", "levels per body, finest first: coarser lattices, springs, jiggle (1)"},             \
      {"--render-levels", "N", "coarser levels of render meshes, each with half the triangles (none)"},      \
      {"--render-error", "METRES", "maximum error of a render level; alone: as many levels as it allows"},   \
      {"--no-calibration", NULL, "do not calibrate the moduli of coarse lattices and springs"},              \
      {"--sections", "auto|none",                                                                            \
          "cut skinned meshes into sections unless the file has bodies along the skin (auto)"},              \
  {                                                                                                          \
    "--overlap", "METRES", "overlap of sections at a cut (half the limb's radius there)"                     \
  }

/* Checks the options; false, with a message, if they are wrong. */
bool building_check(const cli_call *call);

/* Chooses the number and resolution of the sections of a skin within a budget (section_budget.h) and stores
 * both in the section recipes; with `may_stiffen` also stiffer moduli than proposed. Does nothing if
 * `budget_us` is 0 or the call's options choose a resolution. */
sbf_status building_choose(
    cli_call *call, sbf_asset *source, double budget_us, bool may_stiffen, sbf_diagnostic *error);

/* Runs the build passes on *asset and replaces it by the result. Frees *asset on failure. */
sbf_status building_run(cli_call *call, sbf_asset **asset, sbf_build_report *made, sbf_diagnostic *error);

/* Prints what was made: called after the result was written. */
void building_print(const sbf_asset *built, const sbf_build_report *made);

#endif
