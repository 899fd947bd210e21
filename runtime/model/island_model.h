/* An island: bodies that act on each other, stepped by one task. Slots, springs, tetrahedra and regions of
 * its bodies lie one body after the other. */
#ifndef SBRI_ISLAND_MODEL_H
#define SBRI_ISLAND_MODEL_H

#include "math/wide.h"
#include "mechanics/spring.h"
#include "model/elements.h"

/* Steps per control tick with attached masses (coupling/ragdoll/attached_bodies.c). */
enum { SBRI_ATTACHED_STEPS = 6 };
/* Response of the points of an island on one rigid body to a change of its velocity in such a step
 * (prepare/attached_responses.c). */
enum { SBRI_ANSWER = 18 };
typedef struct sbri_attached_responses {
  sbf_vec3 about;    /* asset space, at rest */
  double mass[6][6]; /* impulse and angular impulse about that point per linear and angular velocity: kg, kg
                        m, kg m^2 */
  const float *fractions; /* (free slots x 18) blocks of 18 by eight: displacement x y z at the end of the
                             step, for each of six velocities */
} sbri_attached_responses;

/* Maximum number of substeps per tick of an explicit integrator at rest. Beyond it, springs use another
 * integrator and tetrahedra are softened (prepare/softening.h). A power of two. */
enum { SBRI_MAX_SUBSTEPS = 1024 };
/* The same for a strained body: the maximum of any tick. */
enum { SBRI_MAX_STRAINED_SUBSTEPS = SBRI_MAX_SUBSTEPS + SBRI_MAX_SUBSTEPS / 2 };

/* Pin set of a pinned slot, in the level of its body. UINT32_MAX: padding. */
typedef struct sbri_pin_of {
  uint32_t body, set;
} sbri_pin_of;

typedef struct sbri_scheme sbri_scheme; /* soft/solvers/scheme.h */

/* Springs as each point sees them: for forces. */
typedef struct sbri_island_cells {
  uint32_t slot_count;    /* slots with cells: all with rigid bodies, else free ones */
  const uint32_t *begins; /* (slot_count / 8 + 1) */
  const uint32_t *ends;   /* (slot_count / 8) end of the used cells of each block; spare cells follow */
  const sbri_spring_cell *at;
  const float *damping;  /* (cells x 8) N s/m; NULL: no spring has damping or slack */
  const float *slack;    /* (cells x 8) as sbfi_spring's; NULL: no spring has any */
  const uint32_t *links; /* (cells x 8) their lanes in the links, if links.flows is not NULL */
  uint32_t first_state_cell, first_state_block; /* in the character's state, if springs may tear */
} sbri_island_cells;

/* Springs as they are made, each once. */
typedef struct sbri_spring_table {
  const sbfi_spring *at; /* (count) ends as slots */
  uint32_t count;
  const uint32_t *pinned; /* (pinned_count) springs with one pinned end */
  uint32_t pinned_count;
  bool tear;                  /* springs of spring bodies may tear */
  float rest_stretch;         /* maximum stretch of a spring at rest, as a fraction beyond its rest length */
  double stiffness_damping_s; /* maximum ratio of damping to stiffness of its springs, s */
  const sbri_visit *visits;   /* (visit_count) order of the relaxation integrator */
  uint32_t visit_count;
} sbri_spring_table;

/* Springs by colour: for iteration over springs. */
typedef struct sbri_island_links {
  const sbri_link_block *blocks; /* (block_count) NULL: no iteration over springs */
  uint32_t block_count, first_block;
  const float *damping;           /* (links x 8) N s/m; NULL: no spring is damped or has slack */
  const float *slack;             /* (links x 8) as sbfi_spring's; NULL: no spring has any */
  const sbri_link_limits *limits; /* NULL: no spring has strain limits */
  const sbri_link_flows *flows;   /* NULL: no spring yields or tears; else rest lengths are state */
  const uint32_t *of_spring;      /* (springs.count) block x 8 + lane */
  uint32_t first_flow;            /* its links in the character's state */
  uint32_t first_state_block;     /* its blocks there, if springs may tear */
} sbri_island_links;

/* Pinned slots: free_count to slot_count. */
typedef struct sbri_island_pins {
  const uint32_t *frames;      /* (pinned slots) */
  const sbri_pin_of *sets;     /* (pinned slots) */
  const int32_t *rigid_bodies; /* (pinned slots) of model.rigid_body_of_frame */
  const uint32_t *attachments; /* (attachment_count) rigid bodies that it is pinned to */
  uint32_t attachment_count;
  const sbri_attached_responses *responses; /* NULL: not on a single rigid body, or not attachable */
} sbri_island_pins;

typedef struct sbri_island_tetrahedra {
  uint32_t count;                   /* of all bodies, body after body */
  uint32_t full_count, dense_count; /* ends of the first two kinds of blocks */
  uint32_t block_count, first_block;
  const sbri_tetrahedron_block *blocks;
  const uint32_t *lanes;                   /* (count x 2) block x 8 + lane, for forces and for iteration */
  const uint32_t *of_lane;                 /* (dense_count x 8) if there are limits */
  const float *damping;                    /* (block_count x 8) beta, s; NULL: no damping */
  const sbri_solid_limits *limits;         /* (dense_count) NULL: none is bounded */
  bool are_limited;                        /* some tetrahedron has strain limits */
  bool flow;                               /* some tetrahedron yields or tears, so the blocks are state */
  const sbri_tear_table *tears;            /* NULL: no tetrahedron tears */
  uint32_t part_count;                     /* compact parts of the dense blocks, if there are many */
  const uint32_t *part_begins;             /* (part_count + 1) */
  const sbri_force_parts *parts;           /* of these; NULL: tasks do not divide the forces */
  uint32_t first_state_block, first_state; /* its blocks and tetrahedra in the character's state */
} sbri_island_tetrahedra;

/* Shape matching regions of all bodies. */
typedef struct sbri_island_regions {
  const sbri_region_block *blocks; /* (block_count) */
  const sbri_region_member *members;
  uint32_t block_count;
  uint32_t first_rotation; /* its blocks of regions in the character's state */
  bool have_damping;       /* some region has damping */
  double max_rad_s;        /* maximum angular frequency of its regions, 1/s */
} sbri_island_regions;

/* What bounds its steps. */
typedef struct sbri_island_stability {
  float max_acceleration_m_s2;   /* bound of its drivers' acceleration that it feels, m/s^2; 0: none */
  float max_velocity_change_m_s; /* bound of the immediate change of its drivers' velocity that it feels, m/s;
                                    0: none */
  double fastest_rad_s;          /* highest angular frequency at rest with stepped stiffness, 1/s */
  double bound_rad_s; /* upper bound of the angular frequency in any state of the springs with tetrahedra at
                         rest, 1/s */
  double external_rad_s;    /* maximum contribution of gas and bending to an angular frequency, as a root of
                               squares, 1/s */
  bool has_external_forces; /* other forces than springs, tetrahedra and gravity act */
  float softened_shear,
      softened_bulk; /* minimum ratio of stepped to stated moduli of a tetrahedron; 1: not softened */
  float cell_m;      /* mean rest length of its springs, or of its tetrahedra's edges if that is less, m */
} sbri_island_stability;

/* How its substeps are chosen. */
typedef struct sbri_island_stepping {
  uint32_t substeps;                   /* requested substeps; 0: automatic */
  float step_error_m;                  /* error bound of integrators with error control, m */
  uint32_t min_substeps, max_substeps; /* bounds of their substeps per tick; 0: none */
  bool is_routed;                      /* the router may replace the integrator (soft/solvers/router.h) */
  bool lightly_damped; /* some body has a damping ratio too low for the damping of coarse steps */
} sbri_island_stepping;

typedef struct sbri_island {
  const sbri_scheme *scheme;
  uint32_t first_slot, slot_count, free_count; /* including padding */
  const uint32_t *bodies;                      /* (body_count) */
  uint32_t body_count;
  const sbri_point *rest;      /* (slot_count) */
  const float *masses;         /* (free_count) kg; 0: padding */
  const float *inverse_masses; /* (free_count) 1/kg; 0: padding */
  const float *gravity_scales; /* (free_count) 0: padding */
  sbri_island_cells cells;
  sbri_spring_table springs;
  sbri_island_links links;
  sbri_island_pins pins;
  sbri_island_tetrahedra tetrahedra;
  sbri_island_regions regions;
  const struct sbri_descent *descent; /* soft/solvers/descent_table.h; NULL: another integrator */
  sbri_island_stability stability;
  sbri_island_stepping stepping;
  bool splits; /* springs or tetrahedra may tear, and points split: masses are state */
} sbri_island;

#endif
