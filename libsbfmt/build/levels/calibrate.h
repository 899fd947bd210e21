/* With which modulus or stiffness a level stands for what it was made of.
 *
 * Linear tetrahedra bend too stiffly, the more so the coarser they are: numerical coarsening (Kharevych et
 * al. 2009) gives them other moduli. Each element's is found by the work that its surroundings take
 * (local_fit.h) and from there by descent (stiffness_descent.h); then one factor for all makes the level give
 * as much under small loads (level_loads.h), averaged over the surface and summed over the loads, as a
 * reference of some 16,000 tetrahedra does. What is softest, mostly bending, so counts most. Springs get a
 * factor each (spring_fit.h). */
#ifndef SBFI_CALIBRATE_H
#define SBFI_CALIBRATE_H

#include "build/lattice/lattice_level.h"
#include "build/levels/level_loads.h"
#include "build/levels/local_fit.h"

/* Of lattices; and of what springs are compared with. */
enum { SBFI_REFERENCE_ELEMENTS = 16000, SBFI_SPRING_REFERENCE_ELEMENTS = 4000 };

/* What a reference is for. */
typedef struct sbfi_reference_use {
  bool falls;  /* errors in metres, under gravity */
  bool twists; /* errors under twists */
  bool pushes; /* moduli element by element */
  sbfi_progress progress;
} sbfi_reference_use;

/* A level that others are compared with, and how it gives. */
typedef struct sbfi_reference {
  sbf_asset *memory; /* of a level made for it; NULL: the level is another's */
  sbfi_arena arena;  /* of the rest */
  sbf_level made;
  sbfi_level_statics statics;
  bool is_rough;
  bool sound;  /* it resists; else nothing below is known */
  double fall; /* m/s^2, of gravity */
  bool has_falls;
  double *gives[SBFI_MAX_LOADS];    /* (3 x surface points) m, under small loads of 1 m/s^2 */
  double *falls[SBFI_MAX_LOADS];    /* the same under gravity; NULL: not asked for, or it comes to no rest */
  double yieldings[SBFI_MAX_LOADS]; /* m, under small loads */
  double frequencies[SBFI_MAX_LOADS]; /* rad/s, by Rayleigh's quotient */
  bool has_twists;
  double twist_frequencies[SBFI_TWISTS]; /* the same, twisted */
  bool has_works;
  sbfi_push_works works;
} sbfi_reference;

/* Whether a surface has too few points to be pushed at or looked at: a cube's corners do not move where it
 * bends. What counts is then how slowly all of its matter would swing that way, and pushes are of no use. */
bool sbfi_surface_is_sparse(const sbf_soft_body *body);

/* Makes a lattice of about so many elements of the body, which has polygons, and measures how it gives. Where
 * nothing is enclosed it is not sound. `asset` has bones and rigid bodies. A rough one costs less, for scenes
 * of many bodies: its number of elements is off by up to 30 per cent, and moduli are fitted in half the
 * rounds, which leaves 4 per cent more of the mismatch. To be freed whatever the outcome. */
sbfi_lattice_outcome sbfi_reference_make(sbfi_reference *reference, const sbf_soft_body *body,
    uint32_t elements, bool is_rough, const sbf_asset *asset, const sbfi_reference_use *use,
    const sbf_allocator *allocator);

/* The same of a level that is there, and stays so as long as the reference; `interior` as for a embedder. */
sbfi_lattice_outcome sbfi_reference_take(sbfi_reference *reference, const sbf_soft_body *body,
    const sbf_level *level, const sbfi_interior_map *interior, const sbf_asset *asset,
    const sbfi_reference_use *use, const sbf_allocator *allocator);

void sbfi_reference_free(sbfi_reference *reference);

/* Angular frequency of its slowest swing under one of the loads, rad/s; 0: not known. */
double sbfi_reference_frequency(const sbfi_reference *reference);

/* How a level compares. */
typedef struct sbfi_calibration {
  double
      factor; /* on the modulus, or on the stiffness of springs inside, on the mean; 1: nothing was changed */
  double surface;  /* on that of springs over the surface */
  double min, max; /* over the elements */
  double residual; /* of lattices, the greatest share by which one yields otherwise under one of the small
                      loads; of springs, that by which the surface is displaced otherwise (spring_fit.h) */
  double residual_before; /* of springs, the same before */
  /* Of lattices, shares by which one gives more (above 0) or less under each of the small loads, and twisted
   * about x, y and z; NAN: not known. */
  double load_errors[SBFI_MAX_LOADS], twist_errors[SBFI_TWISTS];
  double period_error; /* share by which it swings slower under the load it yields to most; NAN: not known */
  double error;        /* m, greatest distance of a surface point from where the reference has it under
                          gravity along one of the axes; from small strains, where one of the two has not come to
                          rest; INFINITY: these say nothing, as they displace it by more than the body's size, and
                          the level states none */
  bool unsettled; /* it comes to no rest, as parts of it turn about what holds them, or go so far where the
                     reference's do not: it is left as it was, without a calibration */
} sbfi_calibration;

/* A level that is farther off than that under a load is none that stands for the body. */
#define SBFI_MAX_OFF 0.25
/* The greatest share, of either sign, under any of the loads that are known. */
double sbfi_calibration_off(const sbfi_calibration *calibration);

/* Calibrates a level of tetrahedra or, where `springs` says so, of springs, whose lists become memory of
 * `asset`, and compares it; another level is compared alone, and one of jiggle as one that does not give.
 * Sets the level's calibration, its simulation error, and its cost for a control tick of `tick` s. `interior`
 * as for a embedder. False where memory runs out or the work is ended. */
bool sbfi_level_calibrate(sbf_level *level, const sbf_soft_body *body, const sbfi_interior_map *interior,
    const sbfi_reference *reference, bool springs, double tick, sbf_asset *asset,
    sbfi_calibration *calibration, sbfi_progress progress, const sbf_allocator *allocator);

#endif
