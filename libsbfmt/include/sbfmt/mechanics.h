/* What building, validating and running a body share: how large it is, what it weighs, how stiff its springs
 * and tetrahedra are, how fast it swings.
 *
 * Functions allocate nothing: results and scratch memory are the caller's, with the shapes given. They are
 * pure functions of their arguments, thread safe, and give the same bits on every machine (sums run in double
 * in the order of the lists; no mathematical function but the square root). Units are SI. Assets are valid as
 * sbfmt/packed.h promises; nothing here fails. */
#ifndef SBFMT_MECHANICS_H
#define SBFMT_MECHANICS_H

#include "sbfmt/model.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Surfaces ----------------------------------------------------------------------------------------- */

/* What sbf_surface_measure finds. */
typedef struct sbf_surface_measures {
  double area;    /* m^2, sum of the lengths of the polygons' vector areas */
  double volume;  /* m^3, enclosed; of an open surface, that of the cones over it from the mean of its points.
                     Negative where the polygons face inwards. */
  double opening; /* length of the sum of the vector areas over `area`: 0 closed, 1 a flat sheet */
} sbf_surface_measures;

/* By the divergence theorem, a polygon as the triangles from its corners' mean to its sides. `positions`
 * (mesh->positions.count) stand in for the mesh's own, as of a deformed body; NULL: its own. */
SBF_API void sbf_surface_measure(
    const sbf_polygon_mesh *mesh, const sbf_vec3 *positions, sbf_surface_measures *measures);

/* Tributary areas in m^2, (mesh->positions.count): each polygon's area, in equal parts to its corners. */
SBF_API void sbf_surface_point_areas(const sbf_polygon_mesh *mesh, float *areas);

/* Unit normals at the points, (mesh->positions.count), by the polygons' areas; (0, 0, 0) where there is none.
 */
SBF_API void sbf_surface_point_normals(const sbf_polygon_mesh *mesh, sbf_vec3 *normals);

/* The inside of a closed surface as a rigid body of density 1 kg/m^3: scale mass and inertia by the density.
 * All zero where it encloses nothing. Integrals over tetrahedra from the mean of the points to the surface's
 * triangles; principal axes by Jacobi rotations. */
typedef struct sbf_solid {
  double volume;             /* m^3 */
  sbf_vec3 center;           /* m, centre of mass */
  sbf_vec3 inertia;          /* m^5, principal moments about the centre, the least first */
  sbf_quat inertia_rotation; /* from the principal axes to the space of the positions */
} sbf_solid;
SBF_API void sbf_solid_measure(const sbf_polygon_mesh *mesh, sbf_solid *solid);

/* A rigid part as it is simulated: the mass it states, else density times the hull's volume; the moments it
 * states, else those of its hull filled evenly with the mass, else those of a ball of the mass and density.
 */
typedef struct sbf_rigid_measures {
  double mass;               /* kg; 0: it has neither a hull nor a mass */
  double volume;             /* m^3 of the hull; 0: it has none */
  sbf_vec3 center;           /* m, centre of mass, asset space at rest */
  sbf_vec3 inertia;          /* kg m^2, principal moments about it */
  sbf_quat inertia_rotation; /* from the principal axes to asset space */
} sbf_rigid_measures;
SBF_API void sbf_rigid_body_measure(const sbf_rigid_body *body, sbf_rigid_measures *measures);

/* ---- Bodies: matter and mass -------------------------------------------------------------------------- */

/* What sbf_body_measure finds. */
typedef struct sbf_body_measures {
  double area;   /* m^2 of the surface */
  double volume; /* m^3 of matter: enclosed, or of a sheet its area times its thickness */
  double depth;  /* m of matter under the surface: 3 volume / area, which is the radius of a sphere and the
                    height of pyramids that fill the volume; of a sheet the radius of a sphere of its area */
  double mass;   /* kg by the attributes; 0 for a body without polygons that states none */
  bool sheet;    /* an open surface rather than the skin of a volume */
} sbf_body_measures;

/* A surface counts as a sheet where the body states an area density, where its opening is above a quarter,
 * or where it is open and its volume is next to nothing (below 0.005 of area^1.5; a sphere has 0.094). */
SBF_API void sbf_body_measure(const sbf_soft_body *body, sbf_body_measures *measures);

/* A whole asset: what its soft bodies weigh together, and the box around all render meshes and surfaces (of
 * bodies without a surface: around the points of their finest level, where nothing else is there). */
typedef struct sbf_asset_measures {
  double mass;        /* kg */
  bool bounded;       /* false: there are no points; then low and high are 0 */
  sbf_vec3 low, high; /* m, asset space, rest pose */
} sbf_asset_measures;
SBF_API void sbf_asset_measure(const sbf_asset *asset, sbf_asset_measures *measures);

/* Marks the points of a level that are pinned with weight 1, within the set's minimum and maximum: `pinned`
 * (level->positions.count) receives 1 or 0. Returns the number of pinned points. */
SBF_API uint32_t sbf_level_pinned_points(const sbf_level *level, uint8_t *pinned);

/* Fractions of the body's mass, (level->positions.count), by tributary area. They sum to 1 over the points
 * that are not pinned; pinned points have none. `pinned` NULL: no point is pinned. A point without area,
 * inside or in no polygon, counts as the mean of the points with area. */
SBF_API void sbf_level_mass_fractions(
    const sbf_soft_body *body, const sbf_level *level, const uint8_t *pinned, float *fractions);

/* Masses in kg, (level->positions.count), and their sum; 0 at held points. Stated masses of the level as they
 * are; else of tetrahedra a quarter of density times rest volume to each point; else the body's mass by
 * shares; where there are no polygons, each point a ball of the particle radius; all but the first times the
 * weight map of the density, which a density for each tetrahedron has in it already. A mass that the body
 * states rescales all to that sum. */
SBF_API double sbf_level_masses(
    const sbf_soft_body *body, const sbf_level *level, const uint8_t *pinned, float *masses);

/* ---- Tetrahedra: shape -------------------------------------------------------------------------------- */

#define SBF_DIHEDRAL_BINS 18 /* of ten degrees */

/* How well tetrahedra are shaped. */
typedef struct sbf_lattice_measures {
  double volume;                         /* m^3, sum of all; inverted ones count below nothing */
  double min_dihedral_deg;               /* 180 where there is no tetrahedron */
  double max_dihedral_deg;               /* 0 where there is none */
  uint64_t dihedrals[SBF_DIHEDRAL_BINS]; /* six angles a tetrahedron: how many lie in each ten degrees */
  uint32_t inverted_count;               /* without volume, or turned inside out */
} sbf_lattice_measures;

/* Of `count` tetrahedra over `positions`. The angles are good to 1e-6 degrees, but for those within a
 * hundredth of 0 and 180. */
SBF_API void sbf_lattice_measure(
    const sbf_vec3 *positions, const sbf_uint4 *tetrahedra, uint32_t count, sbf_lattice_measures *measures);

/* ---- Springs: stiffness ------------------------------------------------------------------------------- */

/* From Young's modulus to N/m.
 *
 * A network of springs of stiffness k, rest length L and directions n that strains by the small tensor e
 * holds U = sum 1/2 k L^2 (n.e.n)^2. Over directions that are spread evenly in space the mean of (n.e.n)^2 is
 * (2 e:e + (tr e)^2) / 15. A volume V of isotropic matter holds V (mu e:e + lambda/2 (tr e)^2). They agree
 * for every e where lambda = mu, that is Poisson's ratio 1/4, and sum k L^2 = 15 mu V = 6 E V. In a plane the
 * mean is (2 e:e + (tr e)^2) / 8, and a sheet of thickness t and area A in plane stress agrees for Poisson's
 * ratio 1/3 and sum k L^2 = 3 E t A. (The classical result for central forces, by Cauchy; worked out here.)
 *
 * Sharing the volume among the springs, k = C E V_s / L^2 with sum V_s = V: each point's tributary volume is
 * shared among its springs by their lengths, as rods of one cross-section would share it. A body of half the
 * size then answers the same stress with the same strain, and a finer mesh is no stiffer. A spring shorter
 * than half the mean of its neighbours is made no stiffer than one of that length: the sums above lose next
 * to nothing by it, while a bevel's short edges would set the time step of the whole body. */
#define SBF_STIFFNESS_VOLUME 6.0
#define SBF_STIFFNESS_SHEET 3.0

/* `volumes` (point_count) are the points' tributary volumes in m^3, times their factor of a weight map.
 * Writes `stiffness` (spring_count) in N/m for C E = `modulus` in Pa; springs without length get 0.
 * `scratch` is (2 * point_count). */
SBF_API void sbf_stiffness_of_network(double modulus, const sbf_vec3 *positions, uint32_t point_count,
    const float *volumes, const sbf_uint2 *ends, uint32_t spring_count, double *length_sums,
    float *stiffness);

/* Springs from held points (on the bone) to free ones on the surface. Here it is not the strain between the
 * ends that counts, for the anchors' places are a matter of construction, but how the surface gives against
 * the core: each free point is the base of a pyramid of volume V_i that stands on the surface, of height d,
 * the depth, and whose apex the bone holds. Displaced by u along its axis, the surface's normal, and by w
 * across, matter with lambda = mu holds V_i E (0.6 u^2 + 0.2 w^2) / d^2: a stiffness of 1.2 E V_i / d^2 along
 * and 0.4 E V_i / d^2 across, trace SBF_STIFFNESS_ANCHOR E V_i / d^2. That trace is shared among the point's
 * springs as k = a + b c^2, c the cosine between spring and axis, so that the stiffness along the axis comes
 * out as well where the directions allow (none falls below a tenth of the mean). Where some
 * direction is next to free, as across a thin rim, all the point's springs are raised together until the
 * stiffness in the softest one is an eighth of what it should be across, but four times at most. The
 * pyramids take a third of the 6 E V above; springs over the surface get the rest, SBF_STIFFNESS_MEMBRANE, by
 * sbf_stiffness_of_network.
 *
 * `modulus` is E in Pa; `normals` (point_count) need be right at free points only, where (0, 0, 0) shares the
 * trace evenly; `pinned` (point_count) marks the anchors. Springs that do not join a held to a free point get
 * 0. `scratch` is (3 * point_count). */
#define SBF_STIFFNESS_ANCHOR 2.0
#define SBF_STIFFNESS_MEMBRANE 4.0
SBF_API void sbf_stiffness_of_anchors(double modulus, double depth, const sbf_vec3 *normals,
    const sbf_vec3 *positions, uint32_t point_count, const float *volumes, const uint8_t *pinned,
    const sbf_uint2 *ends, uint32_t spring_count, double *scratch, float *stiffness);

/* Stiffness of every spring of a level, set after set: what the sets state, and for sets that state nothing
 * that of one network of them all, with the weight map of the modulus. `volumes` (level->positions.count) and
 * `scratch` (2 * that) are the caller's memory. */
SBF_API void sbf_level_stiffness(
    const sbf_soft_body *body, const sbf_level *level, float *volumes, double *scratch, float *stiffness);

/* ---- Tetrahedra: modulus ------------------------------------------------------------------------------ */

/* Young's modulus in Pa of every tetrahedron of a level, (level->lattice.tetrahedra.count): what the lattice
 * states, else the body's times the mean of its weight maps at the corners. `factors` is scratch
 * (level->positions.count). */
SBF_API void sbf_level_moduli(
    const sbf_soft_body *body, const sbf_level *level, float *factors, float *moduli);

/* ---- Springs and tetrahedra: how fast they swing ------------------------------------------------------ */

/* Point masses joined by springs and by tetrahedra, linear about `positions`, where both are at rest. A
 * tetrahedron is isotropic matter of its modulus and Poisson's ratio that strains evenly. What is not there
 * has the count 0. */
typedef struct sbf_spring_network {
  uint32_t point_count;      /* of positions */
  uint32_t spring_count;     /* of ends */
  const sbf_vec3 *positions; /* (point_count) */
  const float *masses;       /* (point_count) kg; 0: held */
  const float *anchors;      /* (point_count) N/m towards a fixed place in all directions; NULL: none */
  const sbf_uint2 *ends;     /* (spring_count) */
  const float *stiffness;    /* (spring_count) N/m */

  uint32_t tetrahedron_count;  /* of tetrahedra */
  const sbf_uint4 *tetrahedra; /* (tetrahedron_count) positively oriented; others count as not there */
  const float *young_modulus;  /* (tetrahedron_count) Pa */
  const float *poisson_ratios; /* (tetrahedron_count) in (-1, 0.5) */

  uint32_t hinge_count;            /* of hinges; sbf_network_highest_bound leaves them out */
  const sbf_uint4 *hinges;         /* (hinge_count) the four points of two triangles over one side */
  const sbf_vec3 *hinge_gradients; /* (hinge_count x 4) 1/m, of the angle by each point */
  const float *hinge_stiffness;    /* (hinge_count) N m / rad */
} sbf_spring_network;

/* An angular frequency in rad/s that no mode exceeds: w^2 <= max over the points of
 * (sum of 2 k to free neighbours + sum of k to held ones + anchor + sum over its tetrahedra of the greatest
 * eigenvalue's bound V (3 lambda + 2 mu) |G|, lambda and mu Lame's, |G| the Gram matrix of the shape
 * functions' gradients in the Frobenius norm) / m, Gershgorin's theorem on blocks. It holds for stretched
 * springs too, and for springs compressed down to half their length; of tetrahedra it holds at rest,
 * about 1.5 times the fastest mode. An explicit scheme needs substeps below 2 / w. `scratch` is
 * (point_count). */
SBF_API double sbf_network_highest_bound(const sbf_spring_network *network, double *scratch);

/* The highest mode itself, from below, by `iterations` steps of power iteration (20 come within a few per
 * cent). `scratch` is (6 * point_count). */
SBF_API double sbf_network_highest(const sbf_spring_network *network, uint32_t iterations, double *scratch);

/* The lowest mode that deforms the body, rad/s: what damping_ratio refers to. Rayleigh-Ritz over polynomial
 * displacement fields of second degree (translation, rotation, strain, bending, torsion), points that dangle
 * on one spring left out; then, with `refine`, inverse iterations from there, kept where they stay with that
 * mode. Within a few per cent where refined; else from above. 0: nothing resists, or nothing is free.
 * `scratch` is (16 * point_count). */
SBF_API double sbf_network_lowest(const sbf_spring_network *network, bool refine, double *scratch);

/* Displacements at rest under small forces (3 * point_count, N): solves K u = f by conjugate gradients until
 * the residual is `tolerance` of the force or `iterations` have passed. Returns the residual's share of the
 * force: above the tolerance where springs alone cannot hold it. `scratch` is (10 * point_count). */
SBF_API double sbf_network_static(const sbf_spring_network *network, const double *forces, double tolerance,
    uint32_t iterations, double *displacements, double *scratch);

#ifdef __cplusplus
}
#endif
#endif
