/* Draft of a gait: shape and legs of a rig, shared by the passes that propose a gait. */
#ifndef SBFI_GAIT_DRAFT_H
#define SBFI_GAIT_DRAFT_H

#include "base/memory.h"
#include "sbfmt/asset.h"

/* A bone "carries" points if it or a descendant has points of a mesh. Other bones are ignored: tips, sockets,
 * controls. In a rig without meshes all bones count as carrying points, except those named as tips. */
typedef struct sbfi_bone_shape {
  uint32_t points;          /* points of meshes for which the bone has the greatest weight */
  bool moves_points;        /* the bone or a descendant has points */
  uint32_t children;        /* children that carry points */
  uint32_t middle_children; /* such children on neither side */
  double low; /* y of its lowest point, or of its head in a rig without meshes; INFINITY without points */
  double low_below;    /* the same including all descendants */
  double min_x, max_x; /* range of the heads and centres of points of the bone and such descendants */
  double sum_z;        /* sum over the points of the bone */
  int side;            /* 1: the whole subtree is on the left (+X), -1: on the right, 0: neither */
} sbfi_bone_shape;

typedef struct sbfi_leg_draft {
  int32_t limb;              /* topmost bone of the leg; its parent is the root of the limb */
  int32_t upper, lower, end; /* consecutive; lower is SBF_NONE if end is a child of upper */
  int32_t toe;               /* bone below a long foot that touches the ground; SBF_NONE: `end` does */
  double reach;              /* m, from upper's head over lower's to the end's head */
  int side;
} sbfi_leg_draft;

typedef struct sbfi_gait_draft {
  sbf_asset *asset;
  uint32_t turns; /* number of quarter turns about +Y of the character; the draft undoes them so that it faces
                     +Z */
  sbf_vec3 center;         /* middle of the rig, at which the draft has x = 0 and z = 0 */
  sbfi_bone_shape *shapes; /* (asset->bones.count) */
  bool has_mesh;
  double ground, height, low_z, high_z; /* m, of all measured points, or of the bones' heads */
  sbfi_leg_draft *legs;
  uint32_t leg_count;
  int32_t hips, chest; /* SBF_NONE if there is none */
  int32_t head;
  uint32_t *tail, *spine; /* bones from the leading one on; the asset owns the memory */
  uint32_t tail_count, spine_count;
  bool row; /* the spine carries pairs of legs one behind the other, like a caterpillar's */
} sbfi_gait_draft;

/* Middle of the largest skeleton, which stands where its file has it: the coordinates x and z of the planes
 * that mirror most of its bones, 0 where x = 0 or z = 0 does as well or none does. False if memory runs
 * out. */
bool sbfi_rig_center(const sbf_asset *asset, sbfi_arena *scratch, sbf_vec3 *center);

/* Steps in order: center, extents and sides; legs and girdles; a spine that is a row of girdles; head and
 * tail. Each returns false if memory runs out. */
bool sbfi_draft_shapes(sbfi_gait_draft *d, sbfi_arena *scratch);
bool sbfi_draft_legs(sbfi_gait_draft *d, sbfi_arena *scratch);
bool sbfi_draft_row(sbfi_gait_draft *d);
bool sbfi_draft_ends(sbfi_gait_draft *d);
/* After the legs: the middle bone with "head" in its name that carries no leg, or SBF_NONE. */
int32_t sbfi_draft_named_head(const sbfi_gait_draft *d);

/* Number of quarter turns of the character from +Z. It is 0 if its legs form pairs across its middle in x or
 * not at all. The names of its legs choose between the two directions along the axis, otherwise its feet.
 * Backwards (2) is chosen only if names and feet agree, or names and the head of a quadruped. */
bool sbfi_draft_facing(const sbf_asset *asset, sbfi_arena *scratch, uint32_t *turns);

static inline const sbf_bone *sbfi_draft_bone(const sbfi_gait_draft *d, int32_t bone) {
  return &d->asset->bones.at[bone];
}

/* Converts a point to the draft's orientation, about the rig's middle. */
static inline sbf_vec3 sbfi_draft_seen(const sbfi_gait_draft *d, sbf_vec3 p) {
  p = (sbf_vec3){p.x - d->center.x, p.y, p.z - d->center.z};
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

/* Bone of a leg that touches the ground. */
static inline int32_t sbfi_draft_is_standing(const sbfi_leg_draft *leg) {
  return leg->toe != SBF_NONE ? leg->toe : leg->end;
}

double sbfi_draft_distance(const sbfi_gait_draft *d, int32_t a, int32_t b); /* between two heads, m */

/* Whether `bone` is `ancestor` or a descendant of it. */
bool sbfi_draft_is_below(const sbfi_gait_draft *d, int32_t bone, int32_t ancestor);

/* The only child of a bone that carries points; SBF_NONE if there is not exactly one. */
int32_t sbfi_draft_only_child(const sbfi_gait_draft *d, int32_t bone);

#endif
