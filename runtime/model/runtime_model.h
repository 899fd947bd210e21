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

#include "animation/skeleton/rig.h"
#include "base/memory.h"
#include "model/body_model.h"
#include "model/island_model.h"
#include "model/layout.h"
#include "model/rigid_model.h"
#include "sbfmt/mechanics.h"
#include "sbrun/detail.h"

/* A skin vertex that is embedded in a tetrahedron that may tear: the corners are its four points, in order,
 * in the cells from `cell` on. If it is embedded in points of a network that may tear, `tetrahedron` is
 * UINT32_MAX and unused points have weight 0. */
typedef struct sbri_binding {
  uint32_t vertex, cell;
  uint32_t island, tetrahedron;
} sbri_binding;

/* A jiggle body: moves with its bone and a follower. Its frame follows all others. */
typedef struct sbri_jiggle {
  uint32_t body;
  uint32_t parent; /* frame */
  sbf_vec3 middle; /* mean of the level's points at rest, asset space */
  float frequency_hz, damping_ratio, response;
} sbri_jiggle;

/* Weights of a free point of one detail level in the points of another; exact for affine motions. */
enum { SBRI_SOURCES = 8 };
typedef struct sbri_sources {
  uint32_t slots[SBRI_SOURCES]; /* slots of the whole character at that detail level */
  float weights[SBRI_SOURCES];  /* sum 1 */
} sbri_sources;

/* Elements and skins whose state a character has of its own: of all islands. */
typedef struct sbri_model_counts {
  uint32_t link_blocks, tetrahedron_blocks, region_blocks;
  uint32_t flows;                                      /* links of islands whose springs yield or tear */
  uint32_t torn_cells, torn_blocks, torn_link_blocks;  /* of islands whose springs may tear */
  uint32_t state_tetrahedron_blocks, state_tetrahedra; /* of islands whose tetrahedra yield or tear */
  uint32_t force_entries;                              /* of islands that several tasks may step */
  uint32_t skin_cells, bindings, polygons;             /* of all skins that may tear */
} sbri_model_counts;

/* For each render mesh the full skin and its render levels. */
typedef struct sbri_model_skins {
  sbri_skin *at;         /* (count) */
  const uint32_t *first; /* (asset->render_meshes.count) */
  uint32_t count;
} sbri_model_skins;

/* A model with detail levels is the first of them and owns the others. All have the same frames except those
 * of jiggles. */
typedef struct sbri_model_detail {
  sbr_detail_level_kind kind;    /* kind of its tables: soft, jiggle or bones */
  const struct sbr_model *base;  /* the first level; of a single model itself */
  struct sbr_model **levels;     /* (level_count) only in the first; "away" has the tables of bones */
  sbr_detail_level *definitions; /* (level_count) only in the first */
  uint32_t level_count;          /* only in the first */
  uint32_t max_islands;          /* only in the first: maximum over the detail levels */
  size_t max_state_size;         /* only in the first */
  const sbri_sources *
      *sources; /* (level_count of the first) sources per slot; NULL: not both levels are soft */
  const uint32_t *first_vertices; /* (asset->render_meshes.count + 1) first vertex of each mesh */
  const uint32_t *swings_with; /* (all vertices) body that a vertex swings with; the number of bodies: none */
  const float *swing_rad_s;    /* (bodies + 1) angular frequency of each body's swing; the last: of vertices
                                  without a body */
} sbri_model_detail;

struct sbfi_tetrahedron;
struct sbri_kernels;
struct sbr_model {
  sbfi_arena arena;
  const struct sbri_kernels *kernels;
  const sbf_asset *asset;
  sbri_rig rig;
  sbri_rigid_model rigid;
  uint32_t rigid_substeps; /* of a control tick */
  bool rigid_coarse;       /* as sbr_model_options has it */
  uint32_t frame_count;    /* bones, root, anchor, bodies (sbri_body_frame) */
  const int32_t
      *rigid_body_of_frame; /* (frame_count) rigid body that a frame follows if simulated; -1: none */
  sbri_body *bodies;        /* (asset->soft_bodies.count) */
  sbri_island *islands;
  uint32_t island_count;
  uint32_t slot_count; /* of all islands */
  bool splits;         /* points of some island may split */
  sbri_model_counts counts;
  sbri_model_skins skins;
  float rest_size_m; /* diagonal of the bounding box of all bodies, m */
  sbri_layout layout;
  sbri_model_detail detail;
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
  if (own != UINT32_MAX) return model->rig.bones.count + 2 + own;
  return bone >= 0 ? (uint32_t)bone : model->rig.bones.count;
}

/* Returns NULL if the mesh or level does not exist. */
static inline const sbri_skin *sbri_skin_of(
    const sbr_model *model, uint32_t render_mesh, uint32_t render_level) {
  if (render_mesh >= model->asset->render_meshes.count ||
      render_level > model->asset->render_meshes.at[render_mesh].levels.count)
    return NULL;
  return &model->skins.at[model->skins.first[render_mesh] + render_level];
}
static inline uint32_t sbri_root_frame(const sbr_model *model) {
  return model->rig.bones.count;
}
static inline uint32_t sbri_anchor_frame(const sbr_model *model) {
  return model->rig.bones.count + 1;
}
/* Rest transform of a frame, asset space. */
static inline sbr_transform sbri_frame_rest(const sbr_model *model, uint32_t frame) {
  return frame < model->rig.bones.count ? model->rig.bones.rest[frame]
                                        : (sbr_transform){{0, 0, 0}, {0, 0, 0, 1}};
}

/* ---- Access to the tables ---- */

/* Sample of a skin vertex in the island's current state: its four points with the greatest weights. */
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
