/* Mechanics shared by building, validating and running a body: its size, mass, stiffness and frequencies.
 *
 * Functions allocate nothing: results and scratch memory are the caller's, with the shapes given. They are
 * pure functions of their arguments, thread safe, and give the same bits on every machine (sums run in double
 * in the order of the lists; the square root is the only mathematical function). Units are SI. Assets are
 * valid as sbfmt/packed.h promises; nothing here fails. */
#ifndef SBFMT_MECHANICS_H
#define SBFMT_MECHANICS_H

#include "sbfmt/model.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Surfaces ----------------------------------------------------------------------------------------- */

/* Results of sbf_surface_measure. */
typedef struct sbf_surface_measures {
  double area;    /* m^2, sum of the lengths of the polygons' vector areas */
  double volume;  /* m^3, enclosed. Of an open surface: the volume of the cones over it from the mean of its
                   * points. Negative if the polygons face inwards. */
  double opening; /* length of the sum of the vector areas over `area`: 0 closed, 1 a flat sheet */
} sbf_surface_measures;

/* Uses the divergence theorem; a polygon counts as the triangles between its corners' mean and its sides.
 * `positions` (mesh->positions.count) replace the mesh's own, for example with deformed positions. NULL: the
 * mesh's own. */
SBF_API void sbf_surface_measure(
    const sbf_polygon_mesh *mesh, const sbf_vec3 *positions, sbf_surface_measures *measures);

/* Tributary areas in m^2, (mesh->positions.count): each polygon's area divided equally among its corners. */
SBF_API void sbf_surface_point_areas(const sbf_polygon_mesh *mesh, float *areas);

/* Unit normals at the points, (mesh->positions.count), weighted by the polygons' areas; (0, 0, 0) if
 * undefined.
 */
SBF_API void sbf_surface_point_normals(const sbf_polygon_mesh *mesh, sbf_vec3 *normals);

/* The interior of a closed surface as a rigid body of density 1 kg/m^3: scale mass and inertia by the
 * density. All zero if it encloses no volume. Integrates over tetrahedra from the mean of the points to the
 * surface's triangles; principal axes by Jacobi rotations. */
typedef struct sbf_solid {
  double volume;             /* m^3 */
  sbf_vec3 center;           /* m, centre of mass */
  sbf_vec3 inertia;          /* m^5, principal moments about the centre, smallest first */
  sbf_quat inertia_rotation; /* from the principal axes to the space of the positions */
} sbf_solid;
SBF_API void sbf_solid_measure(const sbf_polygon_mesh *mesh, sbf_solid *solid);

/* Mass properties of a rigid body as simulated. Mass: the stated one, else density times the hull's volume.
 * Moments: the stated ones, else of the hull filled uniformly with the mass, else of a ball of the mass and
 * density. */
typedef struct sbf_rigid_measures {
  double mass;               /* kg; 0: it has neither a hull nor a mass */
  double volume;             /* m^3 of the hull; 0: no hull */
  sbf_vec3 center;           /* m, centre of mass, asset space at rest */
  sbf_vec3 inertia;          /* kg m^2, principal moments about it */
  sbf_quat inertia_rotation; /* from the principal axes to asset space */
} sbf_rigid_measures;
SBF_API void sbf_rigid_body_measure(const sbf_rigid_body *body, sbf_rigid_measures *measures);

/* ---- Bodies: volume and mass -------------------------------------------------------------------------- */

/* Results of sbf_body_measure. */
typedef struct sbf_body_measures {
  double area;   /* m^2 of the surface */
  double volume; /* m^3 of material: the enclosed volume, or a sheet's area times its thickness */
  double depth;  /* m of material under the surface: 3 volume / area, which is the radius of a sphere and the
                  * height of pyramids that fill the volume. For a sheet, the radius of a sphere of its area */
  double mass;   /* kg, from the attributes; 0 for a body without polygons and without a stated mass */
  bool sheet;    /* an open surface and not the boundary of a volume */
} sbf_body_measures;

/* A surface counts as a sheet if the body states an area density, if its opening is above a quarter, or if it
 * is open and its volume is negligible (below 0.005 of area^1.5; a sphere has 0.094). */
SBF_API void sbf_body_measure(const sbf_soft_body *body, sbf_body_measures *measures);

/* Measures of a whole asset: the total mass of its soft bodies, and the box around all render meshes and
 * surfaces. Without those the box is around the finest level of the first body that has points. */
typedef struct sbf_asset_measures {
  double mass;        /* kg */
  bool bounded;       /* false: there are no points; then low and high are 0 */
  sbf_vec3 low, high; /* m, asset space, rest pose */
} sbf_asset_measures;
SBF_API void sbf_asset_measure(const sbf_asset *asset, sbf_asset_measures *measures);

/* Marks the points of a level that are pinned with weight 1, within the set's minimum and maximum: `pinned`
 * (level->positions.count) receives 1 or 0. Returns the number of pinned points. */
SBF_API uint32_t sbf_level_pinned_points(const sbf_level *level, uint8_t *pinned);

/* Fractions of the body's mass, (level->positions.count), by tributary area. They sum to 1 over the free
 * points and are 0 at pinned points. `pinned` NULL: no point is pinned. A point without area, in the interior
 * or in no polygon, gets the mean of the points with area. */
SBF_API void sbf_level_mass_fractions(
    const sbf_soft_body *body, const sbf_level *level, const uint8_t *pinned, float *fractions);

/* Masses in kg, (level->positions.count), 0 at pinned points. Returns their sum. The level's stated masses
 * are used as they are. Otherwise tetrahedra give each corner a quarter of density times rest volume.
 * Otherwise the body's mass is distributed by sbf_level_mass_fractions. Without polygons each point is a ball
 * of the particle radius. All but stated masses are multiplied by the weight map of the density, which a
 * density per tetrahedron already includes. A mass stated by the body rescales all masses to that sum. */
SBF_API double sbf_level_masses(
    const sbf_soft_body *body, const sbf_level *level, const uint8_t *pinned, float *masses);

/* ---- Tetrahedra: shape -------------------------------------------------------------------------------- */

#define SBF_DIHEDRAL_BINS 18 /* bins of ten degrees */

/* Quality of tetrahedra. */
typedef struct sbf_lattice_measures {
  double volume;                         /* m^3, sum over all tetrahedra; inverted ones are negative */
  double min_dihedral_deg;               /* 180 without tetrahedra */
  double max_dihedral_deg;               /* 0 without tetrahedra */
  uint64_t dihedrals[SBF_DIHEDRAL_BINS]; /* six angles per tetrahedron, histogram in bins of ten degrees */
  uint32_t inverted_count;               /* zero volume, or inverted */
} sbf_lattice_measures;

/* Measures `count` tetrahedra over `positions`. The angles are accurate to 1e-6 degrees, except within a
 * hundredth of a degree of 0 and 180. */
SBF_API void sbf_lattice_measure(
    const sbf_vec3 *positions, const sbf_uint4 *tetrahedra, uint32_t count, sbf_lattice_measures *measures);

/* ---- Springs: stiffness ------------------------------------------------------------------------------- */

/* From Young's modulus to N/m.
 *
 * A network of springs of stiffness k, rest length L and directions n that strains by the small tensor e
 * stores the energy U = sum 1/2 k L^2 (n.e.n)^2. Over directions spread uniformly in space the mean of
 * (n.e.n)^2 is (2 e:e + (tr e)^2) / 15. A volume V of isotropic material stores V (mu e:e + lambda/2 (tr
 * e)^2). They agree for every e if lambda = mu, which is Poisson's ratio 1/4, and sum k L^2 = 15 mu V = 6 E
 * V. In a plane the mean is (2 e:e + (tr e)^2) / 8, and a sheet of thickness t and area A in plane stress
 * agrees for Poisson's ratio 1/3 and sum k L^2 = 3 E t A. (Cauchy's classical result for central forces;
 * derived here.)
 *
 * The volume is distributed over the springs: k = C E V_s / L^2 with sum V_s = V. Each point's tributary
 * volume is distributed over its springs in proportion to their lengths, as for rods of equal cross-section.
 * A body of half the size then has the same strain under the same stress, and a finer mesh is no stiffer. A
 * spring shorter than half the mean of its neighbours gets the stiffness of a spring of that length. The sums
 * above hardly change. Otherwise a bevel's short edges would set the time step of the whole body. */
#define SBF_STIFFNESS_VOLUME 6.0
#define SBF_STIFFNESS_SHEET 3.0

/* `volumes` (point_count) are the points' tributary volumes in m^3, times their factor of a weight map.
 * Writes `stiffness` (spring_count) in N/m for C E = `modulus` in Pa; springs of zero length get 0. `scratch`
 * is (2 * point_count). */
SBF_API void sbf_stiffness_of_network(double modulus, const sbf_vec3 *positions, uint32_t point_count,
    const float *volumes, const sbf_uint2 *ends, uint32_t spring_count, double *length_sums,
    float *stiffness);

/* Springs from pinned points (on the bone) to free points on the surface. The positions of the pinned points
 * are arbitrary, so the strain between the ends means nothing. Instead the stiffness models the compliance of
 * the surface relative to the core. Each free point is the base of a pyramid of volume V_i on the surface;
 * its height is the depth d, and its apex is fixed to the bone. If the point is displaced by u along the
 * pyramid's axis (the surface normal) and by w across it, material with lambda = mu stores the energy V_i E
 * (0.6 u^2 + 0.2 w^2) / d^2. The stiffness is therefore 1.2 E V_i / d^2 along and 0.4 E V_i / d^2 across,
 * with the trace SBF_STIFFNESS_ANCHOR E V_i / d^2. The trace is distributed over the point's springs as k = a
 * + b c^2, c the cosine between spring and axis. The stiffness along the axis is then right too if the
 * directions allow it; no spring falls below a tenth of the mean. If the point is almost free in some
 * direction, as across a thin rim, all its springs are scaled until the smallest stiffness is an eighth of
 * the right one across, at most by four. The pyramids take a third of the 6 E V above; springs over the
 * surface get the rest, SBF_STIFFNESS_MEMBRANE, by sbf_stiffness_of_network.
 *
 * `modulus` is E in Pa. `normals` (point_count) matter at free points only; (0, 0, 0) distributes the trace
 * evenly. `pinned` (point_count) marks the pinned points. Springs that do not join a pinned to a free point
 * get 0. `scratch` is (3 * point_count). */
#define SBF_STIFFNESS_ANCHOR 2.0
#define SBF_STIFFNESS_MEMBRANE 4.0
SBF_API void sbf_stiffness_of_anchors(double modulus, double depth, const sbf_vec3 *normals,
    const sbf_vec3 *positions, uint32_t point_count, const float *volumes, const uint8_t *pinned,
    const sbf_uint2 *ends, uint32_t spring_count, double *scratch, float *stiffness);

/* Stiffness of every spring of a level, set after set: as stated by the set. The sets without a stated
 * stiffness get the stiffness of one network of all their springs, with the weight map of the modulus.
 * `volumes` (level->positions.count) and `scratch` (2 * that) are the caller's memory. */
SBF_API void sbf_level_stiffness(
    const sbf_soft_body *body, const sbf_level *level, float *volumes, double *scratch, float *stiffness);

/* ---- Tetrahedra: modulus ------------------------------------------------------------------------------ */

/* Young's modulus in Pa of every tetrahedron of a level, (level->lattice.tetrahedra.count): as stated by the
 * lattice, else the body's times the mean of its weight maps at the corners. `factors` is scratch
 * (level->positions.count). */
SBF_API void sbf_level_moduli(
    const sbf_soft_body *body, const sbf_level *level, float *factors, float *moduli);

/* ---- Springs and tetrahedra: natural frequencies ------------------------------------------------------ */

/* Point masses joined by springs and tetrahedra, linearised about the rest positions `positions`. A
 * tetrahedron is isotropic and has uniform strain. An absent kind of element has count 0. */
typedef struct sbf_spring_network {
  uint32_t point_count;      /* of positions */
  uint32_t spring_count;     /* of ends */
  const sbf_vec3 *positions; /* (point_count) */
  const float *masses;       /* (point_count) kg; 0: pinned */
  const float *anchors;      /* (point_count) N/m towards a fixed point in any direction; NULL: none */
  const sbf_uint2 *ends;     /* (spring_count) */
  const float *stiffness;    /* (spring_count) N/m */

  uint32_t tetrahedron_count;  /* of tetrahedra */
  const sbf_uint4 *tetrahedra; /* (tetrahedron_count) positively oriented; others are ignored */
  const float *young_modulus;  /* (tetrahedron_count) Pa */
  const float *poisson_ratios; /* (tetrahedron_count) in (-1, 0.5) */

  uint32_t hinge_count;            /* of hinges; sbf_network_highest_bound ignores them */
  const sbf_uint4 *hinges;         /* (hinge_count) the four points of two triangles that share an edge */
  const sbf_vec3 *hinge_gradients; /* (hinge_count x 4) 1/m, gradient of the angle at each point */
  const float *hinge_stiffness;    /* (hinge_count) N m / rad */
} sbf_spring_network;

/* An upper bound of all angular frequencies, in rad/s: w^2 <= max over the points of (sum of 2 k to free
 * neighbours + sum of k to pinned ones + anchor + sum over its tetrahedra of the bound of the greatest
 * eigenvalue V (3 lambda + 2 mu) |G|) / m, by Gershgorin's theorem on blocks. lambda and mu are Lame's
 * parameters, |G| is the Frobenius norm of the Gram matrix of the shape functions' gradients. For springs it
 * also holds when stretched, and when compressed to no less than half their length. For tetrahedra it holds
 * at rest, about 1.5 times the fastest mode. An explicit scheme needs substeps below 2 / w. `scratch` is
 * (point_count). */
SBF_API double sbf_network_highest_bound(const sbf_spring_network *network, double *scratch);

/* A lower estimate of the highest mode by `iterations` steps of power iteration; 20 steps are within a few
 * per cent. `scratch` is (6 * point_count). */
SBF_API double sbf_network_highest(const sbf_spring_network *network, uint32_t iterations, double *scratch);

/* The lowest mode that deforms the body, rad/s; damping_ratio refers to it. Rayleigh-Ritz over polynomial
 * displacement fields of second degree (translation, rotation, strain, bending, torsion), without points that
 * dangle on one spring. With `refine`, inverse iterations follow; their result is used if they stay with that
 * mode. Within a few per cent if refined, else an upper estimate. 0: no stiffness, or no free point.
 * `scratch` is (16 * point_count). */
SBF_API double sbf_network_lowest(const sbf_spring_network *network, bool refine, double *scratch);

/* Static displacements under small forces (3 * point_count, N): solves K u = f by conjugate gradients until
 * the residual is `tolerance` times the force or `iterations` have passed. Returns the residual relative to
 * the force. It exceeds the tolerance if springs cannot resist the force. `scratch` is (10 * point_count). */
SBF_API double sbf_network_static(const sbf_spring_network *network, const double *forces, double tolerance,
    uint32_t iterations, double *displacements, double *scratch);

#ifdef __cplusplus
}
#endif
#endif
