/* Builds the derived parts of an asset from the parts that an artist made.
 *
 * A build copies the source parts of an asset, drops every part marked derived, and makes the derived parts
 * again: sections of skinned meshes, a level of springs or tetrahedra for each soft body, pins, embeddings,
 * convex hulls. Authored parts stay as they are: a body with an authored level gets no other, and a rigid
 * body keeps its authored hull. Each derived part refers to an entry of `derivations`, which records the
 * tool, the settings and the hash of the source. A stale derived part is recognised by that hash.
 *
 * The same source and settings give the same bits on every machine; render levels do so with the same version
 * of meshoptimizer. Thread safe. */
#ifndef SBFMT_BUILD_H
#define SBFMT_BUILD_H

#include "sbfmt/asset.h"
#include "sbfmt/codes.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Elements of a body's level. A flat sheet has no interior: for every choice it gets springs over its
 * surface, which act as cloth with its thickness. A sheet that is a section does use the centroid.
 *
 * Centroid: a centre, and a point for each polygon. Lattice: interior points on a body-centred grid, with
 * springs along the grid edges that stay inside, so no spring leaves a concave body. Brute: springs between
 * all points of the surface, for comparison. Tetrahedra: isosurface stuffing of any surface, including open
 * ones and triangle soups; dihedral angles between 10 and 165 degrees. Shape matching: the points of the same
 * lattice in overlapping regions that keep their shape; Poisson's ratio 0; stable with few steps under any
 * load. */
typedef enum sbf_build_interior {
  SBF_BUILD_INTERIOR_AUTOMATIC = 0,     /* lattice in a section cut by this build, centroid in any other
                                         * section, tetrahedra in a body without a bone, none in a sheet without
                                         * a bone */
  SBF_BUILD_INTERIOR_CENTROID = 1,      /* springs; pinned to the body's bone if it has one */
  SBF_BUILD_INTERIOR_NONE = 2,          /* springs over the surface only */
  SBF_BUILD_INTERIOR_LATTICE = 3,       /* springs */
  SBF_BUILD_INTERIOR_BRUTE = 4,         /* springs */
  SBF_BUILD_INTERIOR_TETRAHEDRA = 5,    /* pinned to the body's bone, if it has one, in its inner half */
  SBF_BUILD_INTERIOR_SHAPE_MATCHING = 6 /* regions around the points of such a lattice; one level */
} sbf_build_interior;

/* Whether skinned meshes are cut into sections. A section is a soft body on a bone: the part of the skin that
 * its bone moves, with an overlap across the cuts, closed by caps. */
typedef enum sbf_build_sections {
  SBF_BUILD_SECTIONS_AUTOMATIC = 0, /* if no body of the source lies along the skin */
  SBF_BUILD_SECTIONS_NONE = 1
} sbf_build_sections;

/* Settings of a build. */
typedef struct sbf_build_options {
  size_t struct_size;             /* sizeof(sbf_build_options), or 0 for this version's */
  const sbf_allocator *allocator; /* for the created asset and for scratch memory; NULL: malloc */
  const char *tool;               /* the maker's name in the derivation; NULL: "sbfmt" and its version */
  sbf_build_interior interior;    /* elements of the bodies */
  bool without_flexion;           /* no springs between second neighbours */
  bool without_embeddings;        /* no embeddings */
  bool without_hulls;             /* no hulls */
  /* Called at times with the fraction of work done, 0..1; returning false cancels the build. May be NULL. */
  bool (*progress)(void *user, const char *pass, double done);
  /* Warnings, one by one; may be NULL. */
  void (*report)(void *user, const sbf_diagnostic *diagnostic);
  void *user; /* for both callbacks */
  /* Resolution of lattices: the edge of the grid's cubes in metres. If 0, `elements` gives the approximate
   * number of tetrahedra per body. If that is 0 too, it is 2000, or 4000 if much of a body is thinner than
   * two elements; all bodies together get at most 16000, each at least 100. Without a stated cell, interior
   * springs on a grid use the size of the polygons. Cells are rounded to whole micrometres, which the
   * derivation records. */
  double cell_m;
  uint32_t elements;           /* see above */
  sbf_build_sections sections; /* whether skinned meshes are cut */
  /* Distance along the surface by which a section overlaps a cut; 0: half the limb's radius there. */
  double overlap_m;
  /* Lattices of fewer than 8000 tetrahedra bend too stiffly. Calibration therefore gives each element a
   * modulus with which its surroundings match the compliance of a lattice of 16,000; `reference_modulus`
   * holds the material's modulus. If a centroid body gets several levels, its spring stiffnesses are scaled
   * to match the compliance of a lattice of 4000. Takes half a second per body and some 30 ms per section.
   * The level's `calibration` records the result. True disables calibration. */
  bool without_calibration;
  /* Number of levels per body, up to 8; 0 and 1: one. Of tetrahedra: lattices, each with twice the cell of
   * the level before. Of three and more levels the last is jiggle; of four and more the last but one has
   * springs. Of springs: the springs and, with two and more levels, jiggle. If there are several, each level
   * states its error and its cost. */
  uint32_t levels;
  /* m; if not 0, it replaces cell and number: the lattice is the coarsest of some 60, 240, 960 and 3840
   * tetrahedra whose surface points are all within this distance of those of a lattice of 16,000, under
   * gravity along each axis. Recorded in whole micrometres, like cells. */
  double error_m;
  /* Number of render levels, up to 8, for every render mesh that has none. Each has half the triangles of the
   * level before; levels of fewer than 32 triangles are left out. 0 and no `render_error_m`: none. They use
   * the points of their mesh, so that skins and embeddings apply to them too. Their triangles depend on the
   * version of meshoptimizer. */
  uint32_t render_levels;
  /* m; if not 0: greatest distance of a render level from its mesh at rest. If `render_levels` is 0, there
   * are as many as this distance allows. Recorded in whole micrometres. */
  double render_error_m;
} sbf_build_options;

/* Lattices that a build made. */
typedef struct sbf_build_lattices {
  uint32_t tetrahedra;                       /* number of tetrahedra */
  double min_dihedral_deg, max_dihedral_deg; /* degrees; 0 without tetrahedra */
  uint64_t dihedrals[18];                    /* histogram of the dihedral angles in bins of ten degrees */
  double volume;                             /* m^3, of the tetrahedra */
  double farthest_m;                         /* m; greatest distance of an embedded vertex from its lattice */
  /* Points in parts thinner than two elements, where the lattice is thicker than the body. All other parts
   * are at least two elements thick. */
  uint32_t thickened_points;
} sbf_build_lattices;

/* Calibration of the levels of a build: of their moduli or their spring stiffnesses. */
typedef struct sbf_build_calibration {
  uint32_t count;                /* calibrated levels; the other fields are 0 without any */
  double min_factor, max_factor; /* smallest and greatest factor on moduli or stiffnesses */
  /* Greatest error over the levels. Of lattices: relative error of the compliance under any load. Of springs:
   * fraction of the surface's displacement that no factor can correct. */
  double max_residual;
  double max_period_error; /* greatest relative error of the period; 0 for springs */
} sbf_build_calibration;

/* Results of a build. Counts are of derived parts. */
typedef struct sbf_build_report {
  uint32_t bodies;                         /* bodies that got a level */
  uint32_t sections;                       /* cut from skinned meshes */
  uint32_t levels;                         /* levels other than the finest of each body */
  uint32_t render_levels;                  /* render levels of render meshes */
  uint32_t interior_points;                /* points added inside the bodies */
  uint32_t springs[SBF_SPRING_KIND_COUNT]; /* by sbf_spring_kind */
  uint32_t inert_springs; /* springs left out because they would join two pinned points; `springs` does not
                           * count them */
  uint32_t pins;          /* points in the pin sets made */
  uint32_t hulls;         /* hulls of rigid bodies */
  uint32_t embedded_vertices;                /* vertices of render meshes embedded in at least one body */
  uint32_t warnings;                         /* warnings reported */
  sbf_build_lattices lattices;               /* all lattices together */
  sbf_build_calibration lattice_calibration; /* of lattices */
  sbf_build_calibration spring_calibration;  /* of levels of springs */
} sbf_build_report;

/* Makes `*built` from `asset`, which is not changed and need not outlive the call. On failure `*built` is
 * NULL and `*error` says why. `options`, `report` and `error` may be NULL. Failures: no memory; CANCELLED by
 * `progress`; LATTICE_TOO_FINE; INTERIOR_TOO_MANY; DERIVED_LOST, if an authored part refers to a derived one
 * that this build does not make. */
SBF_API sbf_status sbf_build(const sbf_asset *asset, const sbf_build_options *options, sbf_asset **built,
    sbf_build_report *report, sbf_diagnostic *error);

/* Writes to `*cuts` whether sbf_build with default settings cuts skinned meshes of `asset` into sections.
 * Fails only if memory runs out. */
SBF_API sbf_status sbf_build_cuts_sections(const sbf_asset *asset, bool *cuts);

#ifdef __cplusplus
}
#endif
#endif
