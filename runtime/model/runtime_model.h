/* The model: constant tables made once from an asset and shared by all characters.
 *
 * Points live in slots. An island is a group of bodies that act on each other, mostly one body alone; each is
 * stepped by one task. Its slots are first the free points, body after body, each body's from a multiple of
 * eight on and padded to one with inert lanes; then the held points, padded too. Within a body free points
 * are ordered by falling number of springs, so that the eight points of a block have about equally many.
 * Slots in tables of an island count from the island's first; skins count slots of the whole character.
 *
 * Frames are what holds and guides points: the rig's bones, then the character's root (the asset's origin,
 * turned to the heading), then the anchor (where the root stood when the character was put there: what the
 * world holds), then the rigid bodies that are no bone's.
 *
 * Lengths are those of the asset. A character of scale s is simulated in its asset's metres, with time
 * running sqrt(s) times slower: that is the similarity the public header promises, and it needs no second
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

/* One spring of each of eight points, seen from them. Inert lanes name the point itself and have zeros. */
typedef struct sbri_spring_cell {
  uint32_t others[SBRI_BLOCK]; /* slot of the other end */
  float stiffness[SBRI_BLOCK]; /* N/m */
  float pull[SBRI_BLOCK];      /* stiffness times rest length, N */
} sbri_spring_cell;

/* Eight springs of which no two share a free point, so that they may be worked on at once: what sweeps over
 * springs go by. Inert lanes have stiffness 0 and both ends at a point that no other lane of the block has.
 */
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

/* A point of each of eight regions that keep their shape, for solvers/region_forces.h. Inert lanes name the
 * region's first point and have zeros. */
typedef struct sbri_region_member {
  uint32_t slots[SBRI_BLOCK];
  float stiffness[SBRI_BLOCK];  /* N/m: a w^2, see mechanics/shape_region.h */
  float offsets[3][SBRI_BLOCK]; /* m, from the region's centre at rest */
} sbri_region_member;
/* Eight regions of one body, each with up to so many points. */
typedef struct sbri_region_block {
  uint32_t first_member, member_count;
  float inverse_sums[SBRI_BLOCK]; /* m/N, one over the sum of the stiffnesses; 0: no region */
  float damping_s;                /* beta */
} sbri_region_block;
/* Of such a block, where some tetrahedron of the island has any. */
typedef struct sbri_solid_limits {
  float min[SBRI_BLOCK], max[SBRI_BLOCK];    /* strain; -1 and 0: no bound */
  float yield[SBRI_BLOCK], rate[SBRI_BLOCK]; /* strain and 1/s; rate 0: never */
  float tear[SBRI_BLOCK];                    /* strain; 0: never */
  float square[SBRI_BLOCK]; /* nothing is beyond while the sum of (s^2 - 1)^2 over its stretches is below */
} sbri_solid_limits;

/* Up to four frames that carry a free point where no force moves it, as in a skin. */
enum { SBRI_GUIDES = 4 };
typedef struct sbri_guide {
  uint32_t frames[SBRI_GUIDES];
  float weights[SBRI_GUIDES]; /* summing to 1; unused ones are 0 */
} sbri_guide;

/* One visit of the relaxation scheme to a spring, from one of its ends. */
typedef struct sbri_visit {
  uint32_t from, to;
  float rest_length_m;
} sbri_visit;

/* Two triangles of a sheet over one side, which bends against the angle at rest: see
 * solvers/surface_forces.h.
 */
typedef struct sbri_hinge {
  uint32_t slots[4];
  float stiffness, rest_angle; /* J/rad^2, rad */
} sbri_hinge;

/* What tearing needs to know of an island's tetrahedra. */
typedef struct sbri_tear_table {
  const uint32_t (
      *neighbours)[4]; /* (tetrahedron_count) across the side opposite each corner; UINT32_MAX: none */
  const uint32_t *around_begins; /* (free_count + 1) into `around` */
  const uint32_t *around;        /* tetrahedra that have each free slot for a corner */
  const float *volumes_m3;       /* (tetrahedron_count) at rest */
} sbri_tear_table;

/* A vertex of a skin that rides on a tetrahedron which may tear: its four carriers are the corners, in their
 * order, in the cells from `cell` on. Or on four points of a network that may: then `tetrahedron` is
 * UINT32_MAX, and unused ones weigh nothing. */
typedef struct sbri_binding {
  uint32_t vertex, cell;
  uint32_t island, tetrahedron;
} sbri_binding;

/* A place of a surface that meets the ground, as a mean of the points that carry it;
 * prepare/contact_samples.c.
 */
typedef struct sbri_sample {
  uint32_t slots[4];
  float weights[4]; /* summing to 1; below 0 where the place is outside of what carries it */
  float mass_kg;    /* that answers a push there: 1 / sum of weight^2 / mass; 0: nothing of it is free */
  uint32_t vertex;  /* of the surface; UINT32_MAX: a point of the level */
} sbri_sample;

/* Samples that the same points carry. */
typedef struct sbri_sample_group {
  uint32_t slots[4];
  uint32_t first, end; /* in sbri_body.samples */
  float beyond;        /* greatest sum of weights below 0 of one of them, as a positive number */
} sbri_sample_group;

/* A body that goes with its bone and a follower; its frame comes behind all others. */
typedef struct sbri_jiggle {
  uint32_t body;
  uint32_t carrier; /* frame */
  sbf_vec3 middle;  /* mean of the level's points at rest, asset space */
  float frequency_hz, damping_ratio, response;
} sbri_jiggle;

/* Where a free point of one rung is in another's points: a mean of some of them, affine motions exactly. */
enum { SBRI_SOURCES = 8 };
typedef struct sbri_sources {
  uint32_t slots[SBRI_SOURCES]; /* of the whole character on that rung */
  float weights[SBRI_SOURCES];  /* summing to 1 */
} sbri_sources;

typedef struct sbri_body {
  const sbf_soft_body *source;
  const sbf_level *level; /* NULL: it has none, and moves with its bone */
  uint32_t island;
  uint32_t slot_begin, slot_real_end, slot_end; /* free slots; padding from slot_real_end on */
  uint32_t first_spare;      /* of its slots: from here to slot_real_end is room for points that split */
  uint32_t *slot_from_point; /* (level->positions.count) slots of its island */
  uint32_t first_spring, spring_end; /* its own springs among the island's */
  uint32_t first_tetrahedron;        /* of its own among the island's as they are listed */
  uint32_t tetrahedron_count;        /* those of its level, where they are its model; else 0 */
  float *moduli;         /* (tetrahedron_count) Young's, Pa, as stepped; see prepare/softening.h */
  float *poisson_ratios; /* (tetrahedron_count) as stepped */
  uint32_t first_region_block, region_block_end; /* of its regions among the island's */
  bool held;                /* by some pin: it is damped relative to its guide; else relative to itself */
  uint32_t guide_frame;     /* of all its points, where `guides` is NULL */
  const sbri_guide *guides; /* (slot_end - slot_begin), where several frames hold it */
  float lowest_rad_s;       /* slowest mode that deforms it; 0: nothing resists */
  float sliding_rad_s;      /* what it is damped by where it slides, see solvers/slide_damping.h; 0: not */
  float stretching_rad_s;   /* the same, but of a sheet that does not resist bending */
  float alpha_1_s;          /* mass-proportional damping, that of the damping ratio included */
  const float *alphas;      /* (free slots of the island) of each point, where a map scales it, alpha_1_s the
                               greatest; else NULL */
  float media_friction_1_s;
  float friction, restitution;
  const float *frictions;     /* (free slots of the island) of each point, where a map scales it; else NULL */
  float rolling_share;        /* see solvers/rolling.h */
  const sbri_sample *samples; /* (sample_count) NULL: its points themselves meet the ground */
  uint32_t sample_count;
  const sbri_sample_group *sample_groups; /* (sample_group_count) all samples, in order */
  uint32_t sample_group_count;
  const uint32_t
      *coarse_edges; /* (coarse_edge_count x 2) of its surface: samples, or slots where it has none */
  uint32_t coarse_edge_count;
  uint32_t first_touch, touch_capacity;      /* in a character's scratch */
  const uint32_t *self_faces;                /* (self_face_count x 3) slots; NULL: it does not meet itself */
  uint32_t self_face_count, first_self_face; /* first in a character's scratch */
  const uint32_t *self_sides;                /* (self_face_count x 3) as collide/sides.h has them */
  const uint32_t *self_ring_begins; /* (slots of the island + 1) of each slot, in self_ring: those that a side
                                       joins it to */
  const uint32_t *self_ring;
  bool is_sheet;       /* of one that meets itself: its surface encloses nothing */
  bool is_tangled;     /* likewise: it goes through itself at rest */
  float margin_m;      /* that shapes of the host and other bodies keep from it: of sheets and bare points */
  float sample_beyond; /* greatest sum of a sample's weights below 0, as a positive number */
  float rest_size_m;   /* diagonal of its box */
  double rest_volume_m3;             /* 0: open, or without polygons */
  sbri_skin surface;                 /* vertices of its surface */
  uint32_t first_vertex, first_face; /* of them in a character's scratch */
  float gas_pa;                      /* pressure of the gas inside at rest; 0: none */
  double gas_volume_m3;              /* of that gas at rest */
  const float *gas_factors;          /* (vertices of its surface) on the pressure, of maps; NULL: none */
  float max_gas_factor;              /* of these; 1 */
  double gas_turning;                /* rad^2/s^2 for each Pa, by which its faces' turning adds to a mode */
  float medium_kg_m3;                /* density of what pushes on its faces; 0: nothing does */
  const sbri_hinge *hinges;
  uint32_t hinge_count;
  bool keeps_volume;
  const sbri_face_block *volume_faces; /* the surface's over slots; NULL: its points are embedded */
  const uint32_t *volume_begins;       /* (blocks of its slots + 1), where it keeps its volume */
  const sbri_carry_cell *volume_cells; /* faces, as `slots`, with their shares in each slot's gradient */
  const sbri_face_share *volume_held;  /* (volume_held_count) likewise of the points that are held */
  uint32_t volume_held_count;
  int32_t volume_carrier; /* the one rigid body that holds these, or the island; -1: none */
} sbri_body;

/* Steps of a control tick in which bodies bear their flesh: ragdoll/borne_flesh.c. */
enum { SBRI_BORNE_STEPS = 6 };
/* How the points of an island that hangs on one rigid body answer a change of that body's speed in such a
 * step; prepare/flesh_answers.c. */
enum { SBRI_ANSWER = 18 };
typedef struct sbri_answers {
  sbf_vec3 about;    /* asset space, at rest */
  double mass[6][6]; /* kg, kg m, kg m^2: impulse and moment about there, of linear and angular speeds */
  const float
      *shares; /* (free slots x 18) blocks of 18 by eight: of each of six speeds, x y z at the step's end */
} sbri_answers;

/* The budget of an explicit scheme at rest, in substeps a tick: with more, springs are stepped by another
 * scheme and tetrahedra are softened (prepare/softening.h). A power of two. */
enum { SBRI_MAX_SUBSTEPS = 1024 };
/* The same for a strained body. No tick has more. */
enum { SBRI_MAX_STRAINED_SUBSTEPS = SBRI_MAX_SUBSTEPS + SBRI_MAX_SUBSTEPS / 2 };

/* The pin set that holds a slot: of the body's level. UINT32_MAX: padding. */
typedef struct sbri_pin_of {
  uint32_t body, set;
} sbri_pin_of;

typedef struct sbri_scheme sbri_scheme; /* solvers/scheme.h */

typedef struct sbri_island {
  const sbri_scheme *scheme;
  uint32_t first_slot, slot_count, free_count; /* padding included */
  const uint32_t *bodies;                      /* (body_count) */
  uint32_t body_count;
  const sbri_point *rest;      /* (slot_count) */
  const float *masses;         /* (free_count) kg; 0: padding */
  const float *inverse_masses; /* (free_count) 1/kg; 0: padding */
  const float *gravity_scales; /* (free_count) 0: padding */
  uint32_t cell_slot_count;    /* slots that have cells: all where there are rigid bodies, else the free */
  const uint32_t *cell_begins; /* (cell_slot_count / 8 + 1) */
  const uint32_t *cell_ends;   /* (cell_slot_count / 8) what is in use of each block's; beyond it is room */
  const sbri_spring_cell *cells;
  const float *cell_damping;      /* (cells x 8) N s/m; NULL: no spring is damped or has slack */
  const float *cell_slack;        /* (cells x 8) as sbfi_spring's; NULL: no spring has any */
  const uint32_t *frame_of_held;  /* (slot_count - free_count) */
  const sbri_pin_of *pin_of_held; /* (slot_count - free_count) */
  const int32_t *carrier_of_held; /* (slot_count - free_count) of model.carrier_of_frame */
  const uint32_t *carriers;       /* (carrier_count) the rigid bodies that may carry what holds it */
  uint32_t carrier_count;
  bool lightly_damped;          /* some body of it by a ratio that does not take what coarse steps add */
  const sbri_answers *answers;  /* NULL: it does not hang on one body alone, or may not be borne */
  const uint32_t *held_springs; /* (held_spring_count) springs with one end held */
  uint32_t held_spring_count;
  const sbfi_spring *springs; /* (spring_count) each once, ends as slots */
  uint32_t spring_count;
  uint32_t tetrahedron_count;                               /* of all bodies, body after body */
  uint32_t tetrahedron_full_count, tetrahedron_dense_count; /* ends of the first two sorts of blocks */
  uint32_t tetrahedron_block_count, first_tetrahedron_block;
  const sbri_tetrahedron_block *tetrahedron_blocks;
  const uint32_t *lanes_of_tetrahedra;   /* (tetrahedron_count x 2) block x 8 + lane for forces, for sweeps */
  const sbri_solid_limits *solid_limits; /* (tetrahedron_dense_count) NULL: none is bounded */
  bool solids_limited;                   /* some has strain limits */
  bool solid_flows;                      /* some yields or tears: the blocks are state */
  const sbri_tear_table *tears;          /* NULL: no tetrahedron tears */
  bool frays;                            /* springs of bodies of springs tear */
  bool splits;                           /* either: its points may split, and what they weigh is state */
  const uint32_t *tetrahedron_of_lane;   /* (tetrahedron_dense_count x 8) where there are limits */
  uint32_t first_solid_block, first_solid; /* of its blocks and tetrahedra in the character's state */
  const float *tetrahedron_damping;       /* (tetrahedron_block_count x 8) s: beta; NULL: none is damped so */
  const sbri_region_block *region_blocks; /* (region_block_count) of all bodies that match shapes */
  const sbri_region_member *region_members;
  uint32_t region_block_count;
  uint32_t first_rotation;            /* of its blocks of regions in the character's state */
  const struct sbri_descent *descent; /* solvers/descent_table.h; NULL: not stepped so */
  bool region_damping;                /* some have damping of their own */
  double region_rad_s;                /* greatest w of its regions */
  bool routed;  /* the runtime may step it by another scheme where that is wiser; see solvers/router.h */
  float cell_m; /* mean length of its springs at rest, or of its tetrahedra's sides where that is less */
  const sbri_link_block *links; /* (link_block_count) colour after colour; NULL: nothing sweeps */
  uint32_t link_block_count, first_link_block;
  const float *link_damping;           /* (links x 8) N s/m; NULL: no spring is damped or has slack */
  const float *link_slack;             /* (links x 8) as sbfi_spring's; NULL: no spring has any */
  const sbri_link_limits *link_limits; /* NULL: no spring is bounded */
  const sbri_link_flows *link_flows;   /* NULL: none yields or tears; else rest lengths are state */
  const uint32_t *link_of_spring;      /* (spring_count) block x 8 + lane */
  const uint32_t *cell_links;          /* (cells x 8) likewise, where link_flows is not NULL */
  uint32_t first_flow;                 /* of its links in the character's state */
  uint32_t first_thread_cell, first_thread_block, first_thread_link; /* likewise, where it frays */
  float max_acceleration_m_s2; /* of what holds it, that it is made to feel; 0: no bound */
  float max_push_m_s;          /* likewise, of what its velocity changes by at once */
  double fastest_rad_s;        /* mode at rest, as stepped */
  float softened_shear,
      softened_bulk;          /* least share of a tetrahedron's stated moduli it is stepped with; 1 */
  double bound_rad_s;         /* no mode is faster in any state of the springs, the tetrahedra at rest */
  double outer_rad_s;         /* what gas and bending add to any mode, as a root of squares, at most */
  bool has_outer;             /* something acts beside springs, tetrahedra and weight */
  float rest_stretch;         /* greatest share of a spring beyond its rest length, at rest */
  double stiffness_damping_s; /* greatest damping over stiffness of its springs */
  uint32_t substeps;          /* asked for; 0: as many as needed */
  float step_error_m;         /* of the schemes that control their error */
  uint32_t substeps_least, substeps_most; /* of a tick, of those; 0: no bound */
  const sbri_visit *visits;               /* (visit_count) of the relaxation scheme, in order */
  uint32_t visit_count;
} sbri_island;

/* Where things lie in a character's state and in its scratch memory, in bytes from their beginnings. */
typedef struct sbri_layout {
  size_t gait, pose, previous_pose, islands, positions, previous_positions, velocities, guide_motions, rests,
      strengths, rotations, solids, torn, origins, masses, inverse_masses, gravity_scales, thread_ends,
      thread_cells, thread_damping, thread_slack, thread_links, thread_blocks, skin_cells, bound_to,
      torn_polygons, rigid_bodies, rigid_joints, rigid_drive, rigid_kept, faded, jiggles, loads, used_size,
      state_size;
  size_t animated, rigid_targets, reactions, burdens, stepped_pose, rigid_work_size;
  size_t deltas, previous_deltas, gait_before, targets, guide_velocities, begins, velocity_points, planes,
      near_ground;
  size_t element_forces;
  size_t touches, touch_counts, contact_islands, external_bodies, slot_touches, touch_weights, touching,
      rigid_touching, self_boxes, self_balls, self_nodes, self_items, self_edges;
  size_t outer, accelerations, older_velocities, moves, edges, solid_edges, tears;
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
  const int32_t *carrier_of_frame; /* (frame_count) the rigid body that a frame goes with where that is
                                      simulated; -1: none */
  sbri_body *bodies;               /* (asset->soft_bodies.count) */
  sbri_island *islands;
  uint32_t island_count;
  uint32_t slot_count;                                               /* of all islands */
  bool splits;                                                       /* points of some island may split */
  uint32_t thread_cell_count, thread_block_count, thread_link_count; /* of all islands that fray */
  uint32_t link_block_count;                                         /* of all islands */
  uint32_t tetrahedron_block_count;                                  /* likewise */
  uint32_t solid_block_count,
      solid_count; /* blocks and tetrahedra of islands whose tetrahedra yield or tear */
  uint32_t torn_cell_count, binding_count, torn_polygon_count; /* of all skins that may tear */
  uint32_t flow_count;         /* links of islands whose springs yield or tear */
  uint32_t region_block_count; /* likewise */
  sbri_skin *skins;            /* (skin_count) of each render mesh the full one and its render levels */
  const uint32_t *first_skins; /* (asset->render_meshes.count) */
  uint32_t skin_count;
  float rest_size_m; /* diagonal of the box of all bodies */
  sbri_layout layout;
  /* A model of several rungs is the first of them, and owns the others; all have the same frames but for
   * those of jiggles. */
  sbr_rung_kind kind;             /* of what its tables are: soft, jiggle or bones */
  const struct sbr_model *base;   /* the first; of a model alone itself */
  struct sbr_model **rungs;       /* (rung_count) of the first; away has the tables of bones alone */
  sbr_rung *ladder;               /* (rung_count) likewise */
  uint32_t rung_count;            /* likewise */
  uint32_t max_islands;           /* likewise, of a rung */
  size_t max_state_size;          /* likewise */
  const sbri_sources **sources;   /* (rung_count of the first) for each slot; NULL: not both are soft */
  const uint32_t *first_vertices; /* (asset->render_meshes.count + 1) of each mesh among all */
  const uint32_t *swings_with; /* (all of those) the body that a vertex swings with, or how many there are */
  const float *swing_rad_s;    /* (bodies + 1) how fast each swings to and fro; the last: what is of none */
  sbri_jiggle *jiggles;
  uint32_t jiggle_count;
};

static inline uint32_t sbri_first_jiggle_frame(const sbr_model *model) {
  return model->frame_count - model->jiggle_count;
}

/* Of a rigid body: its bone, or one of its own where another body moves that or there is none. */
static inline uint32_t sbri_body_frame(const sbr_model *model, uint32_t rigid_body) {
  uint32_t own = model->rigid.own_frames[rigid_body];
  int32_t bone = model->asset->rigid_bodies.at[rigid_body].bone;
  if (own != UINT32_MAX) return model->rig.bone_count + 2 + own;
  return bone >= 0 ? (uint32_t)bone : model->rig.bone_count;
}

/* NULL where there is no such mesh or level. */
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

/* A vertex by what carries it in `skin`, of the island as it is now; the four points that weigh most. */
sbri_sample sbri_sample_of(const sbri_island *island, const sbri_skin *skin, uint32_t vertex);
/* One lane of a block, but for its corners. */
void sbri_tetrahedron_fill(
    sbri_tetrahedron_block *block, uint32_t lane, const struct sbfi_tetrahedron *tetrahedron);
/* The body's tetrahedron at rest; false where it encloses nothing. */
bool sbri_body_tetrahedron(const sbri_body *body, uint32_t tetrahedron, struct sbfi_tetrahedron *made);

/* Whether its tetrahedra may tear, or its springs, where these are its model. */
bool sbri_body_tears(const sbri_body *body);
bool sbri_body_frays(const sbri_body *body);

/* Substeps of a tick of `tick_s` with which symplectic Euler is stable while no spring is stretched by more
 * than `stretch`, the share of its length that is beyond its rest length. */
uint32_t sbri_stable_substeps(const sbri_island *island, double tick_s, float stretch);

#endif
