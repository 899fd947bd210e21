/* A soft body at one detail level, as its island steps it. */
#ifndef SBRI_BODY_MODEL_H
#define SBRI_BODY_MODEL_H

#include "model/elements.h"
#include "model/skin_tables.h"
#include "sbfmt/model.h"

/* Maximum number of frames that drive a free point, weighted as in a skin. */
enum { SBRI_DRIVERS = 4 };
typedef struct sbri_driver {
  uint32_t frames[SBRI_DRIVERS];
  float weights[SBRI_DRIVERS]; /* sum 1; unused ones 0 */
} sbri_driver;

/* A contact sample of a surface: a weighted mean of the points in which it is embedded
 * (prepare/contact_samples.c). */
typedef struct sbri_sample {
  uint32_t slots[4];
  float weights[4]; /* sum 1; negative if the sample is outside its element */
  float mass_kg;    /* effective mass of an impulse there, 1 / sum of weight^2 / mass; 0: fully pinned */
  uint32_t vertex;  /* vertex of the surface; UINT32_MAX: a point of the level */
} sbri_sample;

/* Samples that are embedded in the same points. */
typedef struct sbri_sample_group {
  uint32_t slots[4];
  uint32_t first, end;     /* in sbri_body_contact.samples */
  float max_extrapolation; /* maximum absolute sum of negative weights of a sample */
} sbri_sample_group;

/* Free slots of a body in its island. */
typedef struct sbri_body_slots {
  uint32_t begin, real_end, end; /* padding from real_end on */
  uint32_t first_spare;          /* first spare slot; these end at real_end and are for points that split */
  uint32_t *from_point;          /* (points of the level) */
} sbri_body_slots;

/* Elements of a body, as ranges of its island's. */
typedef struct sbri_body_elements {
  uint32_t first_spring, spring_end;
  uint32_t first_tetrahedron;
  uint32_t tetrahedron_count; /* tetrahedra of its level if they are its material model; else 0 */
  float *moduli;              /* (tetrahedron_count) Young's, Pa, as stepped; see prepare/softening.h */
  float *poisson_ratios;      /* (tetrahedron_count) as stepped */
  uint32_t first_region_block, region_block_end;
  const sbri_hinge *hinges;
  uint32_t hinge_count;
} sbri_body_elements;

/* Damping, and the angular frequencies that it follows. */
typedef struct sbri_body_damping {
  float lowest_rad_s;     /* angular frequency of its lowest deformation mode, 1/s; 0: no resistance */
  float sliding_rad_s;    /* damping rate while it slides (soft/solvers/slide_damping.h); 0: none */
  float stretching_rad_s; /* the same without bending, for sheets */
  float alpha_1_s;        /* mass-proportional damping including the damping ratio, 1/s */
  const float *alphas;    /* (free slots of the island) damping per point if a map scales it, alpha_1_s being
                             the maximum; else NULL */
  float media_friction_1_s;
} sbri_body_damping;

/* Contact with ground, colliders and other bodies. */
typedef struct sbri_body_contact {
  float friction, restitution;
  const float *frictions; /* (free slots of the island) friction per point if a map scales it; else NULL */
  float rolling_fraction; /* see soft/solvers/rolling.h */
  float margin_m;         /* collision margin of sheets and bare points, m */
  const sbri_sample *samples; /* (sample_count) NULL: its points are the contact points */
  uint32_t sample_count;
  const sbri_sample_group *sample_groups; /* (sample_group_count) all samples, in order */
  uint32_t sample_group_count;
  float max_extrapolation; /* maximum absolute sum of a sample's negative weights */
  const uint32_t
      *coarse_edges; /* (coarse_edge_count x 2) edges of its surface: samples, or slots without samples */
  uint32_t coarse_edge_count;
  uint32_t first, max_count;        /* its part of the contacts in a character's scratch */
  uint32_t first_block, max_blocks; /* its part of their blocks */
} sbri_body_contact;

/* Contact of a body with itself. */
typedef struct sbri_body_self_contact {
  const uint32_t *faces;           /* (face_count x 3) slots; NULL: no self contact */
  uint32_t face_count, first_face; /* first in a character's scratch */
  const uint32_t *sides;           /* (face_count x 3) as shapes/sides.h has them */
  const uint32_t *ring_begins; /* (slots of the island + 1) begin in `ring` of each slot's edge neighbours */
  const uint32_t *ring;
  bool is_sheet;   /* the surface encloses no volume */
  bool is_tangled; /* the surface intersects itself at rest */
} sbri_body_self_contact;

typedef struct sbri_body_surface {
  sbri_skin skin;                    /* its vertices */
  uint32_t first_vertex, first_face; /* of them in a character's scratch */
  double rest_volume_m3;             /* 0: open, or without polygons */
} sbri_body_surface;

/* Gas inside a closed surface. */
typedef struct sbri_body_gas {
  float pressure_pa;    /* at rest, Pa; 0: none */
  double volume_m3;     /* at rest, m^3 */
  const float *factors; /* (vertices of its surface) pressure factors from maps; NULL: none */
  float max_factor;     /* maximum of these; 1 without maps */
  double stiffening; /* increase of a mode's squared angular frequency by rotating faces, rad^2/s^2 per Pa */
} sbri_body_gas;

/* Preservation of the enclosed volume. */
typedef struct sbri_body_volume {
  bool is_preserved;
  const sbri_face_block *faces;           /* faces of the surface as slots; NULL: the surface is embedded */
  const uint32_t *begins;                 /* (blocks of its slots + 1) if it keeps its volume */
  const sbri_volume_cell *cells;          /* faces, as `slots`, with their weights in each slot's gradient */
  const sbri_face_weight *pinned_weights; /* (pinned_weight_count) the same for pinned points */
  uint32_t pinned_weight_count;
  int32_t attachment; /* the rigid body that these, or the island, are pinned to; -1: none */
} sbri_body_volume;

typedef struct sbri_body {
  const sbf_soft_body *source;
  const sbf_level *level; /* NULL: no level; moves with its bone */
  uint32_t island;
  sbri_body_slots slots;
  sbri_body_elements elements;
  bool is_pinned;        /* has pins: damped relative to its drivers; else relative to its own rigid motion */
  uint32_t driver_frame; /* driver of all points if `drivers` is NULL */
  const sbri_driver *drivers; /* (slots.end - slots.begin) drivers per point; NULL: a single frame */
  sbri_body_damping damping;
  sbri_body_contact contact;
  sbri_body_self_contact self;
  sbri_body_surface surface;
  float rest_size_m; /* diagonal of its box */
  sbri_body_gas gas;
  float medium_kg_m3; /* density of the medium around its faces; 0: none */
  sbri_body_volume volume;
} sbri_body;

#endif
