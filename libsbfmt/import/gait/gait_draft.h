/* What a rig looks like, and what of it walks: between the passes that propose a gait. */
#ifndef SBFI_GAIT_DRAFT_H
#define SBFI_GAIT_DRAFT_H

#include "base/memory.h"
#include "sbfmt/asset.h"

/* A bone "bears" if it, or a bone below it, holds part of a mesh. Bones that do not are left out of account:
 * tips, sockets, controls. In a rig without meshes all bear but those named as tips. */
typedef struct sbfi_bone_shape {
  uint32_t points;          /* of meshes that it holds more than any other bone does */
  bool bears;               /* it or one below holds points */
  uint32_t children;        /* that bear */
  uint32_t middle_children; /* those of neither side */
  double low;       /* y of its lowest point; of its head in a rig without meshes; INFINITY without points */
  double low_below; /* the same of it and all below */
  double min_x, max_x; /* of the heads and the points' middles of it and all below that bear */
  double sum_z;        /* of the points it holds */
  int side;            /* 1: all of it and below is on the left (+X), -1: on the right, 0: neither */
} sbfi_bone_shape;

typedef struct sbfi_leg_draft {
  int32_t limb;              /* topmost bone of the leg: its parent is the girdle */
  int32_t upper, lower, end; /* consecutive; lower is SBF_NONE where end hangs on upper itself */
  int32_t toe;               /* what a long foot at `end` stands on; SBF_NONE: `end` stands itself */
  double reach;              /* m, from upper's head by lower's to the end's */
  int side;
} sbfi_leg_draft;

typedef struct sbfi_gait_draft {
  sbf_asset *asset;
  uint32_t turns;          /* what was turned so many quarters about +Y is seen as if it looked along +Z */
  sbfi_bone_shape *shapes; /* (asset->bones.count) */
  bool has_mesh;
  double ground, height, low_z, high_z; /* m, of all that is seen, or of the bones' heads */
  sbfi_leg_draft *legs;
  uint32_t leg_count;
  int32_t hips, chest; /* SBF_NONE where there is none */
  int32_t head;
  uint32_t *tail, *spine; /* bones from the leading one on; in the asset's memory */
  uint32_t tail_count, spine_count;
  bool row; /* the spine bears pairs of legs one behind the other, as a caterpillar's */
} sbfi_gait_draft;

/* In this order; each returns false where memory runs out. Extents and sides; legs and girdles; a spine that
 * is a row of girdles; head and tail. */
bool sbfi_draft_shapes(sbfi_gait_draft *d, sbfi_arena *scratch);
bool sbfi_draft_legs(sbfi_gait_draft *d, sbfi_arena *scratch);
bool sbfi_draft_row(sbfi_gait_draft *d);
bool sbfi_draft_ends(sbfi_gait_draft *d);
/* After the legs: the bone in the middle, above no leg, with "head" in its name, or SBF_NONE. */
int32_t sbfi_draft_named_head(const sbfi_gait_draft *d);

/* How many quarters the character has been turned from +Z: 0 where its legs pair up across x = 0, or nowhere.
 * Which of both ways along that line it looks is said by the names of its legs, else by its feet; backwards,
 * as 2, only where the names and the feet say so, or the names and the head of a quadruped. */
bool sbfi_draft_facing(const sbf_asset *asset, sbfi_arena *scratch, uint32_t *turns);

static inline const sbf_bone *sbfi_draft_bone(const sbfi_gait_draft *d, int32_t bone) {
  return &d->asset->bones.at[bone];
}

/* A point as the draft sees it. */
static inline sbf_vec3 sbfi_draft_seen(const sbfi_gait_draft *d, sbf_vec3 p) {
  switch (d->turns) {
  case 1:
    return (sbf_vec3){0 - p.z, p.y, p.x};
  case 2:
    return (sbf_vec3){0 - p.x, p.y, 0 - p.z};
  case 3:
    return (sbf_vec3){p.z, p.y, 0 - p.x};
  default:
    return p;
  }
}

static inline sbf_vec3 sbfi_draft_head(const sbfi_gait_draft *d, int32_t bone) {
  return sbfi_draft_seen(d, sbfi_draft_bone(d, bone)->head);
}

/* The bone that a leg stands on. */
static inline int32_t sbfi_draft_stands(const sbfi_leg_draft *leg) {
  return leg->toe != SBF_NONE ? leg->toe : leg->end;
}

double sbfi_draft_distance(const sbfi_gait_draft *d, int32_t a, int32_t b); /* between two heads, m */

/* Whether `bone` is `ancestor` or hangs below it. */
bool sbfi_draft_is_below(const sbfi_gait_draft *d, int32_t bone, int32_t ancestor);

/* The child that bears, of a bone that has one such alone; else SBF_NONE. */
int32_t sbfi_draft_only_child(const sbfi_gait_draft *d, int32_t bone);

#endif
