/* The model: constant tables built once from an asset and shared by all characters.
 *
 * Points live in slots. An island is a group of bodies that act on each other, usually a single body; each
 * island is stepped by one task. Its slots begin with the free points, body after body; those of each body
 * begin at a multiple of eight and are padded to one with unused lanes. The pinned points follow, padded too.
 * Within a body, free points are sorted by decreasing number of springs, so that the eight points of a block
 * have similar numbers. Slots in tables of an island count from the island's first; skins count slots of the
 * whole character.
 *
 * Frames pin and drive points: the bones of the rig, then the character's root (the asset's origin, rotated
 * to the heading), then the anchor (the root at its last placement, to which world pins belong), then the
 * rigid bodies that move no bone.
 *
 * Lengths are those of the asset. A character of scale s is simulated in metres of its asset, with time
 * running sqrt(s) times slower. This is the similarity that the public header promises; it needs no second
 * table. */
#ifndef SBRI_RUNTIME_MODEL_H
#define SBRI_RUNTIME_MODEL_H

#include "base/memory.h"
#include "math/wide.h"
#include "mechanics/spring.h"
#include "model/rigid_model.h"
#include "model/skin_tables.h"
#include "sbfmt/mechanics.h"
#include "sbrun/detail.h"
#include "skeleton/rig.h"

/* Eight springs, one per point of a block, as seen from that point. Padding lanes name the point itself and
 * contain zeros. */
typedef struct sbri_spring_cell {
  uint32_t others[SBRI_BLOCK]; /* slot of the other end */
  float stiffness[SBRI_BLOCK]; /* N/m */
  float pull[SBRI_BLOCK];      /* stiffness times rest length, N */
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
 * (solvers/tetrahedron_forces.h), sweeps, which move points at once, the first and the last
 * (solvers/tetrahedron_sweep.h). Inert lanes have zeros, and all corners at a point that no other lane of the
 * block moves. */
typedef struct sbri_tetrahedron_block {
  uint32_t corners[4][SBRI_BLOCK];  /* slots */
  float stiffness[6][SBRI_BLOCK];   /* N/m: V mu g_i.g_j for ij = 11, 22, 33, 12, 23, 31, g_i the gradients of
                                       the shape functions at rest */
  float inverse_volume[SBRI_BLOCK]; /* 1/m^3: 1 / (6 V) */
  float bulk[SBRI_BLOCK];           /* Pa: lambda / 6, with the lambda of mechanics/neo_hookean.h */
  float shear[SBRI_BLOCK];          /* Pa: mu / 6 */
} sbri_tetrahedron_block;

/* One point of each of eight shape matching regions (solvers/region_forces.h). Padding lanes name the
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

/* Maximum number of frames that drive a free point, weighted as in a skin. */
enum { SBRI_DRIVERS = 4 };
typedef struct sbri_driver {
  uint32_t frames[SBRI_DRIVERS];
  float weights[SBRI_DRIVERS]; /* sum 1; unused ones 0 */
} sbri_driver;

/* One visit of the relaxation integrator to a spring, from one of its ends. */
typedef struct sbri_visit {
  uint32_t from, to;
  float rest_length_m;
} sbri_visit;

/* Two triangles of a sheet at one edge, with bending stiffness about the rest angle
 * (solvers/surface_forces.h). */
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

/* A skin vertex that is embedded in a tetrahedron that may tear: the corners are its four points, in order,
 * in the cells from `cell` on. If it is embedded in points of a network that may tear, `tetrahedron` is
 * UINT32_MAX and unused points have weight 0. */
typedef struct sbri_binding {
  uint32_t vertex, cell;
  uint32_t island, tetrahedron;
} sbri_binding;

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
  uint32_t first, end; /* in sbri_body.samples */
  float beyond;        /* maximum absolute sum of negative weights of a sample */
} sbri_sample_group;

/* A jiggle body: moves with its bone and a follower. Its frame follows all others. */
typedef struct sbri_jiggle {
  uint32_t body;
  uint32_t carrier; /* frame */
  sbf_vec3 middle;  /* mean of the level's points at rest, asset space */
  float frequency_hz, damping_ratio, response;
} sbri_jiggle;

/* Weights of a free point of one detail level in the points of another; exact for affine motions. */
enum { SBRI_SOURCES = 8 };
typedef struct sbri_sources {
  uint32_t slots[SBRI_SOURCES]; /* slots of the whole character at that detail level */
  float weights[SBRI_SOURCES];  /* sum 1 */
} sbri_sources;

typedef struct sbri_body {
  const sbf_soft_body *source;
  const sbf_level *level; /* NULL: no level; moves with its bone */
  uint32_t island;
  uint32_t slot_begin, slot_real_end, slot_end; /* free slots; padding from slot_real_end on */
  uint32_t first_spare; /* first spare slot; spare slots end at slot_real_end and are for points that split */
  uint32_t *slot_from_point;         /* (level->positions.count) slots of its island */
  uint32_t first_spring, spring_end; /* its springs in the island */
  uint32_t first_tetrahedron;        /* its first tetrahedron in the island */
  uint32_t tetrahedron_count;        /* tetrahedra of its level if they are its material model; else 0 */
  float *moduli;         /* (tetrahedron_count) Young's, Pa, as stepped; see prepare/softening.h */
  float *poisson_ratios; /* (tetrahedron_count) as stepped */
  uint32_t first_region_block, region_block_end; /* its blocks of regions in the island */
  bool is_pinned;        /* has pins: damped relative to its drivers; else relative to its own rigid motion */
  uint32_t driver_frame; /* driver of all points if `drivers` is NULL */
  const sbri_driver *drivers; /* (slot_end - slot_begin) drivers per point; NULL: a single frame */
  float lowest_rad_s;         /* angular frequency of its lowest deformation mode, 1/s; 0: no resistance */
  float sliding_rad_s;        /* damping rate while it slides (solvers/slide_damping.h); 0: none */
  float stretching_rad_s;     /* the same without bending, for sheets */
  float alpha_1_s;            /* mass-proportional damping including the damping ratio, 1/s */
  const float *alphas; /* (free slots of the island) damping per point if a map scales it, alpha_1_s being the
                          maximum; else NULL */
  float media_friction_1_s;
  float friction, restitution;
  const float *frictions; /* (free slots of the island) friction per point if a map scales it; else NULL */
  float rolling_fraction; /* see solvers/rolling.h */
  const sbri_sample *samples; /* (sample_count) NULL: its points are the contact points */
  uint32_t sample_count;
  const sbri_sample_group *sample_groups; /* (sample_group_count) all samples, in order */
  uint32_t sample_group_count;
  const uint32_t
      *coarse_edges; /* (coarse_edge_count x 2) edges of its surface: samples, or slots without samples */
  uint32_t coarse_edge_count;
  uint32_t first_soft_contact, max_contacts;        /* its part of the contacts in a character's scratch */
  uint32_t first_contact_block, max_contact_blocks; /* its part of their blocks */
  const uint32_t *self_faces;                       /* (self_face_count x 3) slots; NULL: no self contact */
  uint32_t self_face_count, first_self_face;        /* first in a character's scratch */
  const uint32_t *self_sides;                       /* (self_face_count x 3) as collide/sides.h has them */
  const uint32_t
      *self_ring_begins; /* (slots of the island + 1) begin in self_ring of each slot's edge neighbours */
  const uint32_t *self_ring;
  bool is_sheet;                     /* self contact: the surface encloses no volume */
  bool is_tangled;                   /* self contact: the surface intersects itself at rest */
  float margin_m;                    /* collision margin of sheets and bare points, m */
  float sample_beyond;               /* maximum absolute sum of a sample's negative weights */
  float rest_size_m;                 /* diagonal of its box */
  double rest_volume_m3;             /* 0: open, or without polygons */
  sbri_skin surface;                 /* vertices of its surface */
  uint32_t first_vertex, first_face; /* of them in a character's scratch */
  float gas_pa;                      /* gas pressure at rest, Pa; 0: none */
  double gas_volume_m3;              /* gas volume at rest, m^3 */
  const float *gas_factors;          /* (vertices of its surface) pressure factors from maps; NULL: none */
  float max_gas_factor;              /* maximum of these; 1 without maps */
  double gas_turning; /* increase of a mode's squared angular frequency by rotating faces, rad^2/s^2 per Pa */
  float medium_kg_m3; /* density of the medium around its faces; 0: none */
  const sbri_hinge *hinges;
  uint32_t hinge_count;
  bool keeps_volume;
  const sbri_face_block *volume_faces; /* faces of the surface as slots; NULL: the surface is embedded */
  const uint32_t *volume_begins;       /* (blocks of its slots + 1) if it keeps its volume */
  const sbri_carry_cell
      *volume_cells; /* faces, as `slots`, with their weights in the gradient of each slot */
  const sbri_face_weight *pinned_face_weights; /* (pinned_face_weight_count) the same for pinned points */
  uint32_t pinned_face_weight_count;
  int32_t volume_carrier; /* the rigid body that these, or the island, are pinned to; -1: none */
} sbri_body;

/* Steps per control tick with attached masses (ragdoll/attached_bodies.c). */
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

typedef struct sbri_scheme sbri_scheme; /* solvers/scheme.h */

typedef struct sbri_island {
  const sbri_scheme *scheme;
  uint32_t first_slot, slot_count, free_count; /* including padding */
  const uint32_t *bodies;                      /* (body_count) */
  uint32_t body_count;
  const sbri_point *rest;      /* (slot_count) */
  const float *masses;         /* (free_count) kg; 0: padding */
  const float *inverse_masses; /* (free_count) 1/kg; 0: padding */
  const float *gravity_scales; /* (free_count) 0: padding */
  uint32_t cell_slot_count;    /* slots with cells: all with rigid bodies, else free ones */
  const uint32_t *cell_begins; /* (cell_slot_count / 8 + 1) */
  const uint32_t
      *cell_ends; /* (cell_slot_count / 8) end of the used cells of each block; spare cells follow */
  const sbri_spring_cell *cells;
  const float *cell_damping;           /* (cells x 8) N s/m; NULL: no spring has damping or slack */
  const float *cell_slack;             /* (cells x 8) as sbfi_spring's; NULL: no spring has any */
  const uint32_t *frame_of_pinned;     /* (slot_count - free_count) */
  const sbri_pin_of *pin_of_pinned;    /* (slot_count - free_count) */
  const int32_t *rigid_body_of_pinned; /* (slot_count - free_count) of model.carrier_of_frame */
  const uint32_t *carriers;            /* (carrier_count) rigid bodies that it is pinned to */
  uint32_t carrier_count;
  bool lightly_damped; /* some body has a damping ratio too low for the damping of coarse steps */
  const sbri_attached_responses *answers; /* NULL: not on a single rigid body, or not attachable */
  const uint32_t *pinned_springs;         /* (pinned_spring_count) springs with one pinned end */
  uint32_t pinned_spring_count;
  const sbfi_spring *springs; /* (spring_count) each once, ends as slots */
  uint32_t spring_count;
  uint32_t tetrahedron_count;                               /* of all bodies, body after body */
  uint32_t tetrahedron_full_count, tetrahedron_dense_count; /* ends of the first two kinds of blocks */
  uint32_t tetrahedron_block_count, first_tetrahedron_block;
  const sbri_tetrahedron_block *tetrahedron_blocks;
  const uint32_t
      *lanes_of_tetrahedra; /* (tetrahedron_count x 2) block x 8 + lane, for forces and for iteration */
  const sbri_solid_limits *solid_limits;   /* (tetrahedron_dense_count) NULL: none is bounded */
  bool solids_limited;                     /* some tetrahedron has strain limits */
  bool solid_flows;                        /* some tetrahedron yields or tears, so the blocks are state */
  const sbri_tear_table *tears;            /* NULL: no tetrahedron tears */
  bool frays;                              /* springs of spring bodies may tear */
  bool splits;                             /* either: points may split, so masses are state */
  const uint32_t *tetrahedron_of_lane;     /* (tetrahedron_dense_count x 8) if there are limits */
  uint32_t first_solid_block, first_solid; /* its blocks and tetrahedra in the character's state */
  const float *tetrahedron_damping;        /* (tetrahedron_block_count x 8) beta, s; NULL: no damping */
  const sbri_region_block *region_blocks;  /* (region_block_count) regions of all bodies */
  const sbri_region_member *region_members;
  uint32_t region_block_count;
  uint32_t first_rotation;            /* its blocks of regions in the character's state */
  const struct sbri_descent *descent; /* solvers/descent_table.h; NULL: another integrator */
  bool region_damping;                /* some region has damping */
  double region_rad_s;                /* maximum angular frequency of its regions, 1/s */
  bool routed;                        /* the router may replace the integrator (solvers/router.h) */
  float cell_m; /* mean rest length of its springs, or of its tetrahedra's edges if that is less, m */
  const sbri_link_block *links; /* (link_block_count) by colour; NULL: no iteration over springs */
  uint32_t link_block_count, first_link_block;
  const float *link_damping;           /* (links x 8) N s/m; NULL: no spring is damped or has slack */
  const float *link_slack;             /* (links x 8) as sbfi_spring's; NULL: no spring has any */
  const sbri_link_limits *link_limits; /* NULL: no spring has strain limits */
  const sbri_link_flows *link_flows;   /* NULL: no spring yields or tears; else rest lengths are state */
  const uint32_t *link_of_spring;      /* (spring_count) block x 8 + lane */
  const uint32_t *cell_links;          /* (cells x 8) the same, if link_flows is not NULL */
  uint32_t first_flow;                 /* its links in the character's state */
  uint32_t first_thread_cell, first_thread_block,
      first_thread_link;       /* its cells, blocks and links in the character's state, if springs may tear */
  float max_acceleration_m_s2; /* bound of its drivers' acceleration that it feels, m/s^2; 0: none */
  float max_push_m_s; /* bound of the immediate change of its drivers' velocity that it feels, m/s; 0: none */
  double fastest_rad_s; /* highest angular frequency at rest with stepped stiffness, 1/s */
  float softened_shear,
      softened_bulk;  /* minimum ratio of stepped to stated moduli of a tetrahedron; 1: not softened */
  double bound_rad_s; /* upper bound of the angular frequency in any state of the springs with tetrahedra at
                         rest, 1/s */
  double external_rad_s;      /* maximum contribution of gas and bending to an angular frequency, as a root of
                                 squares, 1/s */
  bool has_external_forces;   /* other forces than springs, tetrahedra and gravity act */
  float rest_stretch;         /* maximum stretch of a spring at rest, as a fraction beyond its rest length */
  double stiffness_damping_s; /* maximum ratio of damping to stiffness of its springs, s */
  uint32_t substeps;          /* requested substeps; 0: automatic */
  float step_error_m;         /* error bound of integrators with error control, m */
  uint32_t substeps_least, substeps_most; /* bounds of their substeps per tick; 0: none */
  const sbri_visit *visits;               /* (visit_count) order of the relaxation integrator */
  uint32_t visit_count;
} sbri_island;

/* Offsets of the parts of a character's state and scratch memory, bytes. */
typedef struct sbri_layout {
  size_t gait, pose, previous_pose, islands, positions, previous_positions, velocities, driver_motions, rests,
      strengths, rotations, solids, torn, origins, masses, inverse_masses, gravity_scales, thread_ends,
      thread_cells, thread_damping, thread_slack, thread_links, thread_blocks, skin_cells, bound_to,
      torn_polygons, rigid_bodies, rigid_joints, rigid_drive, rigid_kept, faded, jiggles, loads, used_size,
      state_size;
  size_t animated, rigid_targets, reactions, burdens, stepped_pose, rigid_work_size;
  size_t deltas, previous_deltas, gait_before, targets, driver_velocities, begins, velocity_points, planes,
      pressing, near_ground;
  size_t element_forces;
  size_t contacts, contact_counts, contact_blocks, contact_block_counts, contact_slots, contact_islands,
      external_bodies, slot_contacts, contact_weights, touching, rigid_touching, self_boxes, self_balls,
      self_nodes, self_items, self_edges;
  size_t external_forces, accelerations, older_velocities, moves, edges, solid_edges, tears;
  size_t visits, queue, touched, owners, frayed, loads_now;
  size_t surface_vertices, surface_faces, surface_forces, surface_velocities, sampled, sampled_deltas,
      vertices, faces, sums, offsets, speeds, energies, fading, pulls, scratch_size;
} sbri_layout;

struct sbfi_tetrahedron;
struct sbri_kernels;
struct sbri_descent;
struct sbr_model {
  sbfi_arena arena;
  const struct sbri_kernels *kernels;
  const sbf_asset *asset;
  sbri_rig rig;
  sbri_rigid_model rigid;
  uint32_t rigid_substeps;         /* of a control tick */
  bool rigid_coarse;               /* as sbr_model_options has it */
  uint32_t frame_count;            /* bones, root, anchor, bodies (sbri_body_frame) */
  const int32_t *carrier_of_frame; /* (frame_count) rigid body that a frame follows if simulated; -1: none */
  sbri_body *bodies;               /* (asset->soft_bodies.count) */
  sbri_island *islands;
  uint32_t island_count;
  uint32_t slot_count; /* of all islands */
  bool splits;         /* points of some island may split */
  uint32_t thread_cell_count, thread_block_count,
      thread_link_count;            /* of all islands whose springs may tear */
  uint32_t link_block_count;        /* of all islands */
  uint32_t tetrahedron_block_count; /* likewise */
  uint32_t solid_block_count,
      solid_count; /* blocks and tetrahedra of islands whose tetrahedra yield or tear */
  uint32_t torn_cell_count, binding_count, torn_polygon_count; /* of all skins that may tear */
  uint32_t flow_count;         /* links of islands whose springs yield or tear */
  uint32_t region_block_count; /* likewise */
  sbri_skin *skins;            /* (skin_count) for each render mesh the full skin and its render levels */
  const uint32_t *first_skins; /* (asset->render_meshes.count) */
  uint32_t skin_count;
  float rest_size_m; /* diagonal of the bounding box of all bodies, m */
  sbri_layout layout;
  /* A model with detail levels is the first of them and owns the others. All have the same frames except
   * those of jiggles. */
  sbr_detail_level_kind kind;   /* kind of its tables: soft, jiggle or bones */
  const struct sbr_model *base; /* the first level; of a single model itself */
  struct sbr_model **levels;    /* (detail_level_count) only in the first; "away" has the tables of bones */
  sbr_detail_level *detail_levels; /* (detail_level_count) only in the first */
  uint32_t detail_level_count;     /* likewise */
  uint32_t max_islands;            /* likewise, of a detail level */
  size_t max_state_size;           /* likewise */
  const sbri_sources *
      *sources; /* (detail_level_count of the first) sources per slot; NULL: not both levels are soft */
  const uint32_t *first_vertices; /* (asset->render_meshes.count + 1) first vertex of each mesh */
  const uint32_t *swings_with; /* (all vertices) body that a vertex swings with; the number of bodies: none */
  const float *swing_rad_s;    /* (bodies + 1) angular frequency of each body's swing; the last: of vertices
                                  without a body */
  sbri_jiggle *jiggles;
  uint32_t jiggle_count;
};

static inline uint32_t sbri_first_jiggle_frame(const sbr_model *model) {
  return model->frame_count - model->jiggle_count;
}

/* Frame of a rigid body: its bone, or its own if another body moves the bone or there is none. */
static inline uint32_t sbri_body_frame(const sbr_model *model, uint32_t rigid_body) {
  uint32_t own = model->rigid.own_frames[rigid_body];
  int32_t bone = model->asset->rigid_bodies.at[rigid_body].bone;
  if (own != UINT32_MAX) return model->rig.bone_count + 2 + own;
  return bone >= 0 ? (uint32_t)bone : model->rig.bone_count;
}

/* Returns NULL if the mesh or level does not exist. */
static inline const sbri_skin *sbri_skin_of(
    const sbr_model *model, uint32_t render_mesh, uint32_t render_level) {
  if (render_mesh >= model->asset->render_meshes.count ||
      render_level > model->asset->render_meshes.at[render_mesh].levels.count)
    return NULL;
  return &model->skins[model->first_skins[render_mesh] + render_level];
}
static inline uint32_t sbri_root_frame(const sbr_model *model) {
  return model->rig.bone_count;
}
static inline uint32_t sbri_anchor_frame(const sbr_model *model) {
  return model->rig.bone_count + 1;
}
/* Rest transform of a frame, asset space. */
static inline sbr_transform sbri_frame_rest(const sbr_model *model, uint32_t frame) {
  return frame < model->rig.bone_count ? model->rig.rest[frame] : (sbr_transform){{0, 0, 0}, {0, 0, 0, 1}};
}

/* ---- Looking at what is made ---- */

/* Sample of a skin vertex in the island as it is now: its four points with the greatest weights. */
sbri_sample sbri_sample_of(const sbri_island *island, const sbri_skin *skin, uint32_t vertex);
/* Fills one lane of a block except its corners. */
void sbri_tetrahedron_fill(
    sbri_tetrahedron_block *block, uint32_t lane, const struct sbfi_tetrahedron *tetrahedron);
/* Corners of the body's tetrahedron at rest; false if its volume is 0. */
bool sbri_body_tetrahedron(const sbri_body *body, uint32_t tetrahedron, struct sbfi_tetrahedron *made);

/* Whether the elements of its material model (tetrahedra or springs) may tear. */
bool sbri_body_tears(const sbri_body *body);
bool sbri_body_frays(const sbri_body *body);

/* Number of substeps for which symplectic Euler is stable over a tick of `tick_s` while no spring is longer
 * than (1 + stretch) times its rest length. */
uint32_t sbri_stable_substeps(const sbri_island *island, double tick_s, float stretch);

#endif
