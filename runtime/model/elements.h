/* Elements of an island in blocks of eight, as the solvers read them. */
#ifndef SBRI_ELEMENTS_H
#define SBRI_ELEMENTS_H

#include "math/wide.h"

/* Eight springs, one per point of a block, as seen from that point. Padding lanes name the point itself and
 * contain zeros. */
typedef struct sbri_spring_cell {
  uint32_t others[SBRI_BLOCK];  /* slot of the other end */
  float stiffness[SBRI_BLOCK];  /* N/m */
  float rest_force[SBRI_BLOCK]; /* stiffness times rest length, N */
} sbri_spring_cell;

/* Eight springs of which no two share a free point, for iteration over springs with SIMD. Padding lanes have
 * stiffness 0 and both ends at a point that no other lane of the block uses. */
typedef struct sbri_link_block {
  uint32_t a[SBRI_BLOCK], b[SBRI_BLOCK]; /* slots */
  float stiffness[SBRI_BLOCK];           /* N/m */
  float rest[SBRI_BLOCK];                /* m */
} sbri_link_block;

/* Of such a block, where some spring of the island has any. */
typedef struct sbri_link_limits {
  float min[SBRI_BLOCK], max[SBRI_BLOCK]; /* strain; -1 and 0: no bound */
} sbri_link_limits;
typedef struct sbri_link_flows {
  float yield[SBRI_BLOCK], rate[SBRI_BLOCK]; /* strain and 1/s; rate 0: never */
  float tear[SBRI_BLOCK];                    /* strain; 0: never */
} sbri_link_flows;
/* Eight tetrahedra. An island has blocks of three sorts, one after the other: full ones, of which no two
 * lanes share a free point; those that are left over, in full blocks again, which may share points; and the
 * same ones once more in blocks that share none and have inert lanes. Forces take the first two
 * (soft/solvers/tetrahedron_forces.h), sweeps, which move points at once, the first and the last
 * (soft/solvers/tetrahedron_sweep.h). Inert lanes have zeros, and all corners at a point that no other lane
 * of the block moves. */
typedef struct sbri_tetrahedron_block {
  uint32_t corners[4][SBRI_BLOCK];  /* slots */
  float stiffness[6][SBRI_BLOCK];   /* N/m: V mu g_i.g_j for ij = 11, 22, 33, 12, 23, 31, g_i the gradients of
                                       the shape functions at rest */
  float inverse_volume[SBRI_BLOCK]; /* 1/m^3: 1 / (6 V) */
  float bulk[SBRI_BLOCK];           /* Pa: lambda / 6, with the lambda of mechanics/neo_hookean.h */
  float shear[SBRI_BLOCK];          /* Pa: mu / 6 */
} sbri_tetrahedron_block;

/* Where the forces on the corners of a block go if several tasks compute those of an island: slots, or
 * entries of their own behind them. */
typedef struct sbri_force_targets {
  uint32_t at[4][SBRI_BLOCK];
} sbri_force_targets;

/* Division of an island's element forces among tasks (prepare/force_parts.c). Each part is a range of blocks.
 * The first part that touches a point sums its forces directly; later ones store each of theirs in an entry.
 * Entries are then added in the order of the blocks, so the sums have the bits of one task that computes
 * all. */
typedef struct sbri_force_parts {
  uint32_t count;
  const uint32_t *begins;         /* (count + 1) blocks */
  const uint32_t *rows_of;        /* (dense blocks) into `rows`; UINT32_MAX: all go to the corners */
  const sbri_force_targets *rows; /* slots, or first_entry and more */
  const uint32_t *shared_slots;   /* (shared_count) slots that have entries, ascending */
  const uint32_t *entry_begins;   /* (shared_count + 1) entries of each */
  uint32_t shared_count;
  uint32_t first_entry, entry_count; /* in element_forces of the island */
} sbri_force_parts;
enum { SBRI_MAX_PARTS = 16 };

/* One point of each of eight shape matching regions (soft/solvers/region_forces.h). Padding lanes name the
 * region's first point and contain zeros. */
typedef struct sbri_region_member {
  uint32_t slots[SBRI_BLOCK];
  float stiffness[SBRI_BLOCK];  /* N/m: a w^2, see mechanics/shape_region.h */
  float offsets[3][SBRI_BLOCK]; /* m, from the region's centre at rest */
} sbri_region_member;
/* Eight regions of one body, each with up to member_count points. */
typedef struct sbri_region_block {
  uint32_t first_member, member_count;
  float inverse_sums[SBRI_BLOCK]; /* inverse sum of stiffnesses, m/N; 0: no region */
  float damping_s;                /* beta */
} sbri_region_block;
/* Of such a block, where some tetrahedron of the island has any. */
typedef struct sbri_solid_limits {
  float min[SBRI_BLOCK], max[SBRI_BLOCK];    /* strain; -1 and 0: no bound */
  float yield[SBRI_BLOCK], rate[SBRI_BLOCK]; /* strain and 1/s; rate 0: never */
  float tear[SBRI_BLOCK];                    /* strain; 0: never */
  float square[SBRI_BLOCK]; /* no limit is exceeded while the sum of (s^2 - 1)^2 over the principal stretches
                               s is below this */
} sbri_solid_limits;

/* One visit of the relaxation integrator to a spring, from one of its ends. */
typedef struct sbri_visit {
  uint32_t from, to;
  float rest_length_m;
} sbri_visit;

/* Two triangles of a sheet at one edge, with bending stiffness about the rest angle
 * (soft/solvers/surface_forces.h). */
typedef struct sbri_hinge {
  uint32_t slots[4];
  float stiffness, rest_angle; /* J/rad^2, rad */
} sbri_hinge;

/* Topology of an island's tetrahedra, for tearing. */
typedef struct sbri_tear_table {
  const uint32_t (
      *neighbours)[4]; /* (tetrahedron_count) across the side opposite each corner; UINT32_MAX: none */
  const uint32_t *around_begins; /* (free_count + 1) into `around` */
  const uint32_t *around;        /* tetrahedra around each free slot */
  const float *volumes_m3;       /* (tetrahedron_count) at rest */
} sbri_tear_table;

#endif
