/* Derived parts: makes from what an artist made all that can be computed from it.
 *
 * A build copies the source parts of an asset, drops every part marked derived, and makes the derived ones
 * again: sections of skinned meshes, a level of springs or tetrahedra for each soft body, pins, embeddings,
 * convex hulls. Authored parts are kept as they are: a body with a level of its own gets no other, a rigid
 * body with a hull keeps it. What is made is marked with an entry of `derivations` that records tool,
 * settings and the hash of the source, so that what no longer fits its source can be told.
 *
 * The same source and settings give the same bits, on every machine; render levels with the same version of
 * meshoptimizer. Thread safe. */
#ifndef SBFMT_BUILD_H
#define SBFMT_BUILD_H

#include "sbfmt/asset.h"
#include "sbfmt/codes.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What a body's level is made of. A flat sheet has no inside: whatever is chosen, it gets springs over its
 * surface, which with its thickness make it cloth; but the centroid is heeded in a section.
 *
 * Centroid: a centre and a point for each polygon. Lattice: interior points on a body-centred grid, springs
 * along those of its edges that stay inside, so that no spring leaves a concave body. Brute: springs between
 * all points of the surface, to compare with. Tetrahedra: isosurface stuffing, any surface, open ones and
 * soups included, dihedral angles between 10 and 165 degrees. Shape matching: the points of the same lattice
 * in overlapping regions that keep their shape, with Poisson's ratio 0; stable with few steps whatever
 * befalls it. */
typedef enum sbf_build_interior {
  SBF_BUILD_INTERIOR_AUTOMATIC = 0,     /* lattice in a section cut here, centroid in another, tetrahedra in a
                                           body without a bone, none in a sheet without one */
  SBF_BUILD_INTERIOR_CENTROID = 1,      /* springs; held by the body's bone if it has one */
  SBF_BUILD_INTERIOR_NONE = 2,          /* springs over the surface alone */
  SBF_BUILD_INTERIOR_LATTICE = 3,       /* springs */
  SBF_BUILD_INTERIOR_BRUTE = 4,         /* springs */
  SBF_BUILD_INTERIOR_TETRAHEDRA = 5,    /* held by the body's bone, if it has one, in its inner half */
  SBF_BUILD_INTERIOR_SHAPE_MATCHING = 6 /* regions around the points of such a lattice; one level */
} sbf_build_interior;

/* Whether skinned meshes are cut into sections: soft bodies on bones, each the part of the skin that its bone
 * holds, with an overlap over the cuts and closed by caps. */
typedef enum sbf_build_sections {
  SBF_BUILD_SECTIONS_AUTOMATIC = 0, /* where no bodies of the source lie along the skin */
  SBF_BUILD_SECTIONS_NONE = 1
} sbf_build_sections;

/* Settings of a build. */
typedef struct sbf_build_options {
  size_t struct_size;             /* sizeof(sbf_build_options), or 0 for this version's */
  const sbf_allocator *allocator; /* for the asset made and for scratch memory; NULL: malloc */
  const char *tool;               /* what the derivation names as its maker; NULL: "sbfmt" and its version */
  sbf_build_interior interior;    /* what fills the bodies */
  bool without_flexion;           /* no springs between second neighbours */
  bool without_embeddings;        /* no embeddings */
  bool without_hulls;             /* no hulls */
  /* Called now and then with the share of the work done, 0..1; false cancels the build. May be NULL. */
  bool (*progress)(void *user, const char *pass, double done);
  /* Warnings, one by one; may be NULL. */
  void (*report)(void *user, const sbf_diagnostic *diagnostic);
  void *user; /* for both callbacks */
  /* The size of lattices: the edge of the grid's cubes in metres; where that is 0, about so many tetrahedra a
   * body; where that is 0 too, 2000, or 4000 where much of a body is thinner than two elements, and no more
   * than 16000 in all bodies together, 100 each at least.
   * Interior springs on a grid of no stated cell go by the polygons' size. Cells are rounded to whole
   * micrometres, which the derivation records.
   */
  double cell_m;
  uint32_t elements;           /* see above */
  sbf_build_sections sections; /* of skinned meshes */
  /* How far along the surface a section reaches over a cut; 0: half the limb's radius there. */
  double overlap_m;
  /* Lattices of fewer than 8000 tetrahedra bend too stiffly: unless this is set, each element gets a modulus
   * with which its surroundings give as much as in a lattice of 16,000, and `reference_modulus` says what it
   * stands for. The springs of a body made by centroid are multiplied so that they give as a lattice of 4000
   * does, where it gets several levels. Half a second a body, and some 30 ms a section. `calibration` in the
   * level says what came of it.
   */
  bool without_calibration;
  /* How many levels a body gets, up to 8; 0 and 1: one. Of tetrahedra: lattices, each of twice the cell of
   * the one before; the last of three and more is jiggle, the one before it, of four and more, springs. Of
   * springs: these and, with two and more, jiggle. Where there are several, each states its error and its
   * cost. */
  uint32_t levels;
  /* m; not 0: instead of by cell and number, a lattice is the coarsest of some 60, 240, 960 and 3840
   * tetrahedra no point of whose surface is farther off under gravity along any axis, against one of 16,000.
   * Recorded in whole micrometres as cells are. */
  double error_m;
  /* Render levels of every render mesh that has none, up to 8: each of half the triangles of the one before,
   * and none where that is fewer than 32; 0 and no `render_error_m`: none. They are over the same points, so
   * that what carries the mesh carries them. Which triangles they have depends on the version of
   * meshoptimizer. */
  uint32_t render_levels;
  /* m; not 0: no render level is farther than this from its mesh at rest; and where `render_levels` is 0, as
   * many as that allows. Recorded in whole micrometres. */
  double render_error_m;
} sbf_build_options;

/* What was made. Counts are of derived parts; springs by sbf_spring_kind. */
typedef struct sbf_build_report {
  uint32_t bodies;                         /* that got a level */
  uint32_t interior_points;                /* made inside them */
  uint32_t springs[SBF_SPRING_KIND_COUNT]; /* of each kind */
  uint32_t inert_springs; /* left out: they would join two points held fast. The kinds do not count them */
  uint32_t pins;          /* points in the pin sets made */
  uint32_t hulls;         /* of rigid bodies */
  uint32_t embedded_vertices;                /* of render meshes, that at least one body carries */
  uint32_t warnings;                         /* reported */
  uint32_t tetrahedra;                       /* of lattices */
  double min_dihedral_deg, max_dihedral_deg; /* of the tetrahedra; 0 where there are none */
  uint64_t dihedrals[18];                    /* how many of the angles lie in each ten degrees */
  double lattice_volume;                     /* m^3, of the tetrahedra */
  double farthest_m; /* greatest distance of an embedded vertex from the lattice that carries it */
  /* Points of lattices that stand in for parts thinner than two elements, which are thicker there than the
   * body. Every other element, too, has a corner inside: nowhere is there but one across. */
  uint32_t thickened_points;
  uint32_t sections;           /* cut from skinned meshes */
  uint32_t levels;             /* beside the finest of each body */
  uint32_t calibrated;         /* lattices; the rest is of these */
  double min_factor;           /* on moduli, the smallest */
  double max_factor;           /* on moduli, the greatest */
  double max_residual;         /* greatest relative error of the compliance under some load */
  double max_period_error;     /* greatest relative error of the period */
  uint32_t render_levels;      /* of render meshes */
  uint32_t calibrated_springs; /* levels of springs; what follows is of these */
  double min_spring_factor;    /* on stiffnesses, the smallest */
  double max_spring_factor;    /* on stiffnesses, the greatest */
  /* Greatest, over the levels, of the fraction of the surface's displacement that no factor repairs. */
  double max_spring_residual;
} sbf_build_report;

/* Makes `*built` from `asset`, which stays as it is and need not outlive the call. On failure `*built` is
 * NULL and `*error` says why. `options`, `report` and `error` may be NULL.
 * Failures: no memory; CANCELLED by `progress`; LATTICE_TOO_FINE, INTERIOR_TOO_MANY; DERIVED_LOST, an
 * authored part refers to a derived one that this build does not make. */
SBF_API sbf_status sbf_build(const sbf_asset *asset, const sbf_build_options *options, sbf_asset **built,
    sbf_build_report *report, sbf_diagnostic *error);

/* Writes to `*cuts` whether sbf_build with default settings cuts skinned meshes of `asset` into sections.
 * Fails only without memory. */
SBF_API sbf_status sbf_build_cuts_sections(const sbf_asset *asset, bool *cuts);

#ifdef __cplusplus
}
#endif
#endif
