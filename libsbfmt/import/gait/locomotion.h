/* Determines how a character moves from its shape, its names and its clips. */
#ifndef SBFI_LOCOMOTION_H
#define SBFI_LOCOMOTION_H

#include "base/memory.h"
#include "import/gait/gait_draft.h"

typedef enum sbfi_locomotion_kind {
  SBFI_LOCOMOTION_WALK,
  SBFI_LOCOMOTION_SWIM,
  SBFI_LOCOMOTION_FLY,
  SBFI_LOCOMOTION_SLITHER,
  SBFI_LOCOMOTION_CRAWL,
  SBFI_LOCOMOTION_ROLL,
  SBFI_LOCOMOTION_NONE,
  SBFI_LOCOMOTION_KINDS
} sbfi_locomotion_kind;

typedef struct sbfi_evidence {
  sbfi_locomotion_kind kind;
  double points;  /* negative: evidence against the kind */
  char text[112]; /* evidence, as "4 limbs reach the ground" */
} sbfi_evidence;

enum { SBFI_MAX_EVIDENCE = 48 };

typedef struct sbfi_locomotion {
  sbfi_locomotion_kind kind, second;
  double margin;  /* points between the best and the second kind */
  uint32_t turns; /* quarter turns about +Y: 0, it faces along Z; 1, along X; the sign is unknown */
  bool unsure;    /* the margin is too small to rely on */
  sbfi_evidence evidence[SBFI_MAX_EVIDENCE];
  uint32_t evidence_count;
} sbfi_locomotion;

/* Names that indicate how something moves. Each list may be empty. */
typedef struct sbfi_locomotion_names {
  const char *const *clips;
  uint32_t clip_count;
  const char *const *objects; /* meshes, materials, objects, the file */
  uint32_t object_count;
} sbfi_locomotion_names;

/* "walk", "swim" ... as the format spells them. */
const char *sbfi_locomotion_name(sbfi_locomotion_kind kind);
/* Kind with that name; SBFI_LOCOMOTION_KINDS if none. */
sbfi_locomotion_kind sbfi_locomotion_named(const char *name);

/* Evaluates a rig at rest; false if memory runs out. Finds the sideways axis from the symmetry of the
 * skin, so the character may face +X or +Z. */
bool sbfi_find_locomotion(
    const sbf_asset *asset, const sbfi_locomotion_names *names, sbfi_arena *scratch, sbfi_locomotion *found);

/* --- Words ------------------------------------------------------------------------------------------- */

typedef enum sbfi_word {
  SBFI_WORD_LEG,
  SBFI_WORD_ARM,
  SBFI_WORD_FIN,
  SBFI_WORD_WING,
  SBFI_WORD_WHEEL,
  SBFI_WORD_SNAKE,
  SBFI_WORD_SPINE,
  SBFI_WORD_TAIL,
  SBFI_WORD_HEAD,
  SBFI_WORD_MOUTH,   /* parts that move by themselves on a head: tongue, jaw */
  SBFI_WORD_FISH,    /* an animal that swims */
  SBFI_WORD_BIRD,    /* an animal that flies, or an aircraft */
  SBFI_WORD_VEHICLE, /* something that rolls */
  SBFI_WORD_WALKER,  /* an animal or a person on legs */
  SBFI_WORD_OBJECT,  /* something that does not move by itself */
  SBFI_WORDS
} sbfi_word;

/* Words in the name of a bone or an object, as bits 1 << SBFI_WORD_... Supports English, German, French,
 * Spanish, Italian, Portuguese, Polish, Russian, Japanese and Chinese. */
uint32_t sbfi_words_of(const char *name);

/* Kind that a clip's name indicates; SBFI_LOCOMOTION_KINDS if none. */
sbfi_locomotion_kind sbfi_clip_kind(const char *name);

/* Whether a clip's name is that of an idle stance without weapons or fighting. */
bool sbfi_clip_is_idle(const char *name);

/* --- Points ------------------------------------------------------------------------------------------ */

typedef struct sbfi_rig_points {
  sbf_vec3 *at;  /* (count) in the draft's orientation */
  int32_t *bone; /* (count) bone with the greatest weight at each */
  uint32_t count;
  sbf_vec3 center;        /* of the rig, at which they have x = 0 and z = 0 */
  double low[3], high[3]; /* their extent */
  bool are_heads;         /* the points are heads of bones without meshes */
} sbfi_rig_points;

/* Collects points with a bone, seen after `turns` quarter turns; the heads of bones if there are none. */
bool sbfi_gather_points(const sbf_asset *asset, uint32_t turns, sbfi_arena *scratch, sbfi_rig_points *points);

/* Number of quarter turns, 0 to 3, of a character without legs from +Z. `sides` is the result of
 * sbfi_mirror_turns. The front is found from bones named left, right, head and tail, else from the root of
 * a simple chain, else the narrower end is the tail. */
bool sbfi_front_turns(
    const sbf_asset *asset, uint32_t sides, sbfi_locomotion_kind kind, sbfi_arena *scratch, uint32_t *turns);

/* 0: left and right are on the two sides of the middle in x; 1: in z, so it faces along X. Bones with sides
 * in their names decide, otherwise the better symmetry of the skin. `clear` is true if the other is ruled
 * out. */
uint32_t sbfi_mirror_turns(const sbf_asset *asset, const sbfi_rig_points *points, bool *clear);

/* --- Limbs ------------------------------------------------------------------------------------------- */

/* A part of the rig whose skin is on one side. */
typedef struct sbfi_limb_shape {
  int32_t root;
  int side;
  uint32_t bones; /* number of bones with points */
  uint32_t points;
  double low[3], high[3]; /* of its points */
  double flatness;        /* smallest extent / middle extent, along its own axes */
  double slimness;        /* middle extent / greatest extent */
  bool is_round;          /* a disc whose axis points sideways */
  bool is_loop;           /* many siblings around a centre: a track */
  int32_t twin;           /* limb that mirrors it, or SBF_NONE */
} sbfi_limb_shape;

/* A rig in the draft's orientation, with points and limbs. */
typedef struct sbfi_rig_view {
  sbfi_gait_draft draft;
  sbfi_rig_points points;
  sbfi_limb_shape *limbs;
  uint32_t limb_count;
  uint32_t *holds; /* (bones) number of points of each */
} sbfi_rig_view;

bool sbfi_view_rig(sbfi_rig_view *view, const sbf_asset *asset, uint32_t turns, sbfi_arena *scratch);

/* `limbs` has a capacity of bones.count and follows the order of their roots. */
bool sbfi_find_limbs(const sbfi_gait_draft *draft, const sbfi_rig_points *points, sbfi_arena *scratch,
    sbfi_limb_shape *limbs, uint32_t *count);

#endif
