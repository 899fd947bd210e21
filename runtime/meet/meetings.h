/* Bodies of characters that meet each other: soft with soft, soft with rigid, rigid with rigid, of one
 * character or of several.
 *
 * When a tick begins, all whose ways within it may touch are found by their bounds (pairs.c). Characters that
 * may are a group, and a group is one task: its characters step along with each other, in as many steps as
 * the one that needs most (core/group_run.c). Before each step the places that may touch (find.c) push each
 * other off (push.c): what one gets the other loses, so that momentum is kept to rounding.
 *
 * All lengths and speeds here are the world's; places are relative to the group's origin. */
#ifndef SBRI_MEETINGS_H
#define SBRI_MEETINGS_H

#include "core/world.h"

/* ---- Who may meet ---- */

/* The surface of a soft body: what it has to meet others with. */
typedef struct sbri_meet_surface {
  sbri_sample *samples; /* (vertex_count) what carries each vertex; mass 0: it is not there */
  uint32_t *triangles;  /* (triangle_count x 3) vertices */
  uint32_t vertex_count, triangle_count;
  bool two_sided; /* a sheet, or open */
  /* Of a tick: */
  sbf_vec3 *places, *ways; /* (vertex_count) */
  sbri_box *boxes;         /* (triangle_count) of the ways, grown */
  sbri_bounds_tree tree;
} sbri_meet_surface;

/* A body that others may meet. */
typedef struct sbri_meeter {
  uint32_t character, number; /* of the soft or the rigid body */
  bool rigid, gives_way;
  uint32_t layer, mask;
} sbri_meeter;

/* Two of them, by their numbers, a before b. */
typedef struct sbri_meet_pair {
  uint32_t a, b;
} sbri_meet_pair;

/* A character in a group while it steps. */
typedef struct sbri_meet_member {
  sbri_character *character;
  sbf_vec3 offset;    /* of its origin from the group's */
  float scale, speed; /* its metres and metres per second in the world's */
  float mass;         /* its kilograms */
  float tick_s;       /* of its own */
  float reached;      /* share of the tick that is over */
  float held_rate;    /* 1/s of its own: what held points go between `begins` and `targets`, times this */
  float last_step_s;  /* of its rigid parts, when the tick began */
  sbri_rigid_parts parts;
} sbri_meet_member;

/* ---- Touches ---- */

enum { SBRI_MEET_SLOTS = 12, SBRI_MEET_SOFT = -1, SBRI_MEET_PLANE = -2 };

/* A place of a body: on a rigid one, or carried by up to twelve points of a soft one. */
typedef struct sbri_meet_side {
  uint32_t member;
  int32_t rigid_body; /* SBRI_MEET_SOFT, or SBRI_MEET_PLANE: what the world's ground and shapes bound it by */
  uint32_t island, count;
  uint32_t slots[SBRI_MEET_SLOTS];
  float weights[SBRI_MEET_SLOTS];
  sbf_vec3 at; /* in the rigid body's own frame */
  sbf_vec3
      arm; /* of a step: from its centre of mass to where it is pushed, its own metres, the world's axes */
} sbri_meet_side;

typedef struct sbri_meet_touch {
  sbri_meet_side a, b;
  sbf_vec3 normal; /* unit, from b to a */
  float margin;    /* m that they keep */
  float friction, restitution;
  /* From step to step: */
  sbf_vec3 after; /* velocity of a against b when its pushes were over */
  sbf_vec3 drift; /* what the step before has changed that by since */
  bool pushed;
  /* In a step: */
  float gap, wanted, mass;
  float gain;        /* N s along the normal */
  sbf_vec3 rub;      /* N s across it */
  sbf_vec3 expected; /* what the step will change the velocity by */
} sbri_meet_touch;

typedef struct sbri_meet_group {
  uint32_t first_member, member_count; /* in `members` */
  uint32_t first_pair, pair_count;
  uint32_t first_touch, touch_count, touch_capacity;
  sbr_double3 origin;
} sbri_meet_group;

typedef struct sbri_meetings {
  sbfi_arena *arenas;           /* (character_capacity) */
  sbri_meet_surface **surfaces; /* (character_capacity) each of its soft bodies; NULL: none is made */
  unsigned char **kept;         /* (character_capacity) room for its state */
  uint32_t *group_of;           /* (character_capacity) UINT32_MAX: it meets nobody */
  sbri_meet_member *members;    /* (character_capacity) group after group */
  sbri_meet_group *groups;      /* (character_capacity) */
  uint32_t group_count;
  sbri_meeter *meeters; /* (meeter_capacity) */
  sbri_box *boxes;      /* likewise, of their ways */
  sbri_bounds_tree tree;
  uint32_t meeter_count, meeter_capacity;
  sbri_meet_pair *pairs; /* (touch_capacity) */
  uint32_t pair_count;
  sbri_meet_touch *touches; /* (touch_capacity) */
  uint32_t touch_capacity, character_capacity;
} sbri_meetings;

/* ---- meet/surfaces.c ---- */

/* Room for a character's bodies, beside that of all others; false where memory runs out. */
bool sbri_meetings_reserve(sbr_world *world, const sbr_model *model);
/* The surfaces of a character that has just been made; false likewise. */
bool sbri_meet_surfaces_make(sbr_world *world, uint32_t character);
void sbri_meet_surfaces_free(sbr_world *world, uint32_t character);
void sbri_meetings_free(sbr_world *world);
/* Places and ways of its vertices within the tick, and the tree over its triangles. */
void sbri_meet_surface_place(sbr_world *world, const sbri_meet_member *member, uint32_t soft_body);

/* ---- meet/pairs.c ---- */

/* Finds who may meet whom in this tick, and the groups. */
void sbri_meet_pairs_find(sbr_world *world);

/* ---- meet/find.c ---- */

/* The touches of a group that begins to step, up to its capacity. */
void sbri_meet_touches_find(sbr_world *world, sbri_meet_group *group);

/* ---- meet/push.c ---- */

sbf_vec3 sbri_meet_place(const sbri_meet_member *members, const sbri_meet_side *side);
sbf_vec3 sbri_meet_velocity(const sbri_meet_member *members, const sbri_meet_side *side);
/* Pushes before a step that takes so long; whether anything was pushed. */
bool sbri_meet_push(const sbri_meetings *all, const sbri_meet_group *group, float step_s);
/* Before the first step: all that is free will fall by its weight. */
void sbri_meet_expect_fall(
    const sbri_meetings *all, const sbri_meet_group *group, const sbr_world *world, float step_s);
/* Looks what the step has made of that. */
void sbri_meet_look(const sbri_meetings *all, const sbri_meet_group *group);

/* ---- core/group_run.c ---- */

/* The tick of a group, after its characters' gaits. */
void sbri_group_run(sbr_world *world, sbri_meet_group *group);

#endif
