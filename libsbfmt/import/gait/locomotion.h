/* How a character moves, judged by its shape, its names and its clips. */
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
  double points;  /* against the kind below 0 */
  char text[112]; /* what was found, as "4 limbs reach the ground" */
} sbfi_evidence;

enum { SBFI_MAX_EVIDENCE = 48 };

typedef struct sbfi_locomotion {
  sbfi_locomotion_kind kind, second;
  double margin;  /* points between the two */
  uint32_t turns; /* quarters about +Y: 0, it looks along Z; 1, along X; which way is not said */
  bool unsure;    /* the margin is too small to rely on */
  sbfi_evidence evidence[SBFI_MAX_EVIDENCE];
  uint32_t evidence_count;
} sbfi_locomotion;

/* Names that say how something moves. Each list may be empty. */
typedef struct sbfi_locomotion_names {
  const char *const *clips;
  uint32_t clip_count;
  const char *const *things; /* meshes, materials, objects, the file */
  uint32_t thing_count;
} sbfi_locomotion_names;

/* "walk", "swim" ... as the format spells them. */
const char *sbfi_locomotion_name(sbfi_locomotion_kind kind);
/* The kind of that name; SBFI_LOCOMOTION_KINDS for none. */
sbfi_locomotion_kind sbfi_locomotion_named(const char *name);

/* Judges a rig at rest; false: memory ran out. The sideways axis is found from the symmetry of the skin, so
 * the character may look along +X or +Z. */
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
  SBFI_WORD_MOUTH,   /* what moves by itself on a head: tongue, jaw */
  SBFI_WORD_FISH,    /* an animal that swims */
  SBFI_WORD_BIRD,    /* one that flies, or an aircraft */
  SBFI_WORD_VEHICLE, /* what rolls */
  SBFI_WORD_WALKER,  /* an animal or a person on legs */
  SBFI_WORD_THING,   /* what does not move by itself */
  SBFI_WORDS
} sbfi_word;

/* The words in a name of a bone or an object, as bits 1 << SBFI_WORD_... In English, German, French, Spanish,
 * Italian, Portuguese, Polish, Russian, Japanese and Chinese. */
uint32_t sbfi_words_of(const char *name);

/* The kind that a clip's name speaks for; SBFI_LOCOMOTION_KINDS for none. */
sbfi_locomotion_kind sbfi_clip_kind(const char *name);

/* Whether a clip's name says that the character stands at ease: Idle, without a weapon or a blow in it. */
bool sbfi_clip_is_idle(const char *name);

/* --- Points ------------------------------------------------------------------------------------------ */

typedef struct sbfi_rig_points {
  sbf_vec3 *at;  /* (count) as the draft sees them */
  int32_t *bone; /* (count) the bone that holds most of each */
  uint32_t count;
  double low[3], high[3]; /* their extent */
  bool are_heads;         /* of bones that hold nothing */
} sbfi_rig_points;

/* The points that bones hold, as seen with `turns` quarters; heads of bones where they hold none. */
bool sbfi_gather_points(const sbf_asset *asset, uint32_t turns, sbfi_arena *scratch, sbfi_rig_points *points);

/* Quarters by which what has no legs is turned away from +Z, 0 to 3: `sides` as sbfi_mirror_turns gives it;
 * which end is the front say bones named left, right, head and tail, else the root of a plain chain, else the
 * narrower end is the tail. */
bool sbfi_front_turns(
    const sbf_asset *asset, uint32_t sides, sbfi_locomotion_kind kind, sbfi_arena *scratch, uint32_t *turns);

/* 0: left and right lie across x = 0; 1: across z = 0, it looks along X. Bones that name their sides say so,
 * else the skin's better mirror. `clear`: whether the other is out of the question. */
uint32_t sbfi_mirror_turns(const sbf_asset *asset, const sbfi_rig_points *points, bool *clear);

/* --- Limbs ------------------------------------------------------------------------------------------- */

/* A part of the rig whose skin lies on one side. */
typedef struct sbfi_limb_shape {
  int32_t root;
  int side;
  uint32_t bones; /* that hold points */
  uint32_t points;
  double low[3], high[3]; /* of its points */
  double flatness;        /* least extent / middle extent, along its own axes */
  double slimness;        /* middle extent / greatest */
  bool is_round;          /* a disc whose axis points sideways */
  bool is_loop;           /* many siblings around a middle: a track */
  int32_t twin;           /* the limb that mirrors it; SBF_NONE */
} sbfi_limb_shape;

/* A rig seen with its points and limbs. */
typedef struct sbfi_rig_view {
  sbfi_gait_draft draft;
  sbfi_rig_points points;
  sbfi_limb_shape *limbs;
  uint32_t limb_count;
  uint32_t *holds; /* (bones) points that each holds */
} sbfi_rig_view;

bool sbfi_view_rig(sbfi_rig_view *view, const sbf_asset *asset, uint32_t turns, sbfi_arena *scratch);

/* `limbs` (bones.count) in the order of their roots. */
bool sbfi_find_limbs(const sbfi_gait_draft *draft, const sbfi_rig_points *points, sbfi_arena *scratch,
    sbfi_limb_shape *limbs, uint32_t *count);

#endif
