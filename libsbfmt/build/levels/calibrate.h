/* Calibrates the moduli or stiffnesses of a level so that it represents the original material.
 *
 * Linear tetrahedra are too stiff in bending, more so if they are coarse: numerical coarsening (Kharevych
 * et al. 2009) changes their moduli. Each element's modulus is first found from the work in its
 * surroundings (local_fit.h) and then by descent (stiffness_descent.h). Then a common factor matches the
 * displacements under small loads (level_loads.h), averaged over the surface and summed over the loads, to
 * those of a reference with some 16,000 tetrahedra. The softest motions, mostly bending, count most.
 * Springs get a factor each (spring_fit.h). */
#ifndef SBFI_CALIBRATE_H
#define SBFI_CALIBRATE_H

#include "build/lattice/lattice_level.h"
#include "build/levels/level_loads.h"
#include "build/levels/local_fit.h"

/* For lattices; and for comparison with springs. */
enum { SBFI_REFERENCE_ELEMENTS = 16000, SBFI_SPRING_REFERENCE_ELEMENTS = 4000 };

/* Purpose of a reference. */
typedef struct sbfi_reference_use {
  bool gravity_displacements; /* errors in metres, under gravity */
  bool twists;                /* errors under twists */
  bool pushes;                /* moduli element by element */
  sbfi_progress progress;
} sbfi_reference_use;

/* A level that others are compared with, and its displacements. */
typedef struct sbfi_reference {
  sbf_asset *memory; /* owner of a level built for it; NULL: the level belongs to another asset */
  sbfi_arena arena;  /* owner of everything else */
  sbf_level made;
  sbfi_level_statics statics;
  bool is_rough;
  bool is_valid;  /* it has stiffness; otherwise nothing below is known */
  double gravity; /* acceleration of gravity, m/s^2 */
  bool has_gravity_displacements;
  double
      *displacements[SBFI_MAX_LOADS]; /* (3 x surface points) m, displacements under small loads of 1 m/s^2 */
  double *gravity_displacements[SBFI_MAX_LOADS]; /* the same under gravity; NULL: not requested, or no
                                                    convergence */
  double mean_displacements[SBFI_MAX_LOADS];     /* m, mean displacement along each small load */
  double frequencies[SBFI_MAX_LOADS];            /* rad/s, by Rayleigh's quotient */
  bool has_twists;
  double twist_frequencies[SBFI_TWISTS]; /* the same under twists */
  bool has_works;
  sbfi_push_works works;
} sbfi_reference;

/* Whether a surface has too few points to apply pushes or measure displacements: a cube's corners do not
 * move when it bends. Then the frequency of the whole mass counts, and pushes are useless. */
bool sbfi_surface_is_sparse(const sbf_soft_body *body);

/* Builds a lattice of the body with about this many elements and measures its displacements. The body has
 * polygons. The result is not valid if nothing is enclosed. `asset` has bones and rigid bodies. A rough
 * reference is cheaper, for scenes of many bodies: its number of elements is off by up to 30 per cent, and
 * moduli are fitted in half the rounds, which leaves 4 per cent more of the mismatch. Must be freed after
 * any result. */
sbfi_lattice_outcome sbfi_reference_make(sbfi_reference *reference, const sbf_soft_body *body,
    uint32_t elements, bool is_rough, const sbf_asset *asset, const sbfi_reference_use *use,
    const sbf_allocator *allocator);

/* The same for an existing level, which must outlive the reference; `interior` as for an embedder. */
sbfi_lattice_outcome sbfi_reference_from_level(sbfi_reference *reference, const sbf_soft_body *body,
    const sbf_level *level, const sbfi_interior_map *interior, const sbf_asset *asset,
    const sbfi_reference_use *use, const sbf_allocator *allocator);

void sbfi_reference_free(sbfi_reference *reference);

/* Angular frequency of its slowest motion under one of the loads, rad/s; 0: unknown. */
double sbfi_reference_frequency(const sbfi_reference *reference);

/* Result of a comparison. */
typedef struct sbfi_calibration {
  double factor;   /* mean factor on the modulus, or on the stiffness of interior springs; 1: unchanged */
  double surface;  /* mean factor on the stiffness of surface springs */
  double min, max; /* range over the elements */
  double residual; /* for lattices the largest relative difference of displacement under one of the small
                    * loads; for springs the same over all surface points (spring_fit.h) */
  double residual_before; /* for springs, the same before */
  /* For lattices, relative excess of the displacements under each of the small loads, and under twists
   * about x, y and z; negative: less; NAN: unknown. */
  double load_errors[SBFI_MAX_LOADS], twist_errors[SBFI_TWISTS];
  double period_error; /* relative excess of the period under the load with the largest displacement; NAN:
                          unknown */
  /* m, largest distance of a surface point from its position in the reference under gravity along one of the
   * axes; from small strains, if one of the two did not converge; INFINITY: unknown, because these displace
   * it by more than the body's size, and the level gets no error */
  double error;
  bool unsettled; /* it does not converge, because parts rotate about their pins or move much farther than the
                     reference's: it stays unchanged, without a calibration */
} sbfi_calibration;

/* A level with a larger relative error under any load does not represent the body. */
#define SBFI_MAX_LOAD_ERROR 0.25
/* Largest relative error, of either sign, under any known load. */
double sbfi_calibration_max_error(const sbfi_calibration *calibration);

/* Calibrates a level of tetrahedra or, with `springs`, of springs, and compares it. Its lists become owned
 * by `asset`. Other levels are only compared; a jiggle level counts as rigid. Sets the level's
 * calibration, its simulation error, and its cost for a control tick of `tick` s. `interior` as for an
 * embedder. False if memory runs out or the build is cancelled. */
bool sbfi_level_calibrate(sbf_level *level, const sbf_soft_body *body, const sbfi_interior_map *interior,
    const sbfi_reference *reference, bool springs, double tick, sbf_asset *asset,
    sbfi_calibration *calibration, sbfi_progress progress, const sbf_allocator *allocator);

#endif
