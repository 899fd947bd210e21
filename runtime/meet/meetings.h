/* Bodies of characters that meet each other: soft with soft, soft with rigid, rigid with rigid, of one
 * character or of several.
 *
 * When a tick begins, all whose ways within it may touch are found by their bounds (pairs.c). Characters that
 * may are a group, and a group is one task: its characters step along with each other, in as many steps as
 * the one that needs most (step/group_run.c). Before each step the places that may touch (find.c) push each
 * other off (push.c): what one gets the other loses, so that momentum is kept to rounding.
 *
 * All lengths and speeds here are the world's; places are relative to the group's origin. */
#ifndef SBRI_MEETINGS_H
#define SBRI_MEETINGS_H

#include "math/four.h"
#include "ragdoll/ragdoll.h"

/* ---- Who may meet ---- */

/* The surface of a soft body: what it has to meet others with. */
typedef struct sbri_meet_surface {
  sbri_sample *samples; /* (vertex_count) what carries each vertex; mass 0: it is not there */
  uint32_t *triangles;  /* (triangle_count x 3) vertices */
  uint32_t vertex_count, triangle_count;
  bool two_sided;        /* a sheet, or open */
  bool closed;           /* each side of a triangle is one of another as well: it has an inside */
  float edge_m, thick_m; /* of a closed one at rest: mean length of its edges; how thick it is, as a rod is */
  float ridge_m, sharpness; /* likewise: its longest ridge, and its sharpest, as rims.c has it */
  uint32_t *sides;          /* (triangle_count x 3) as collide/sides.h has them */
  /* (triangle_count) Bits of its sides: of a two-sided one those that are rims, or across which it is bent,
   * of a tick; of a closed one those that are ridges at rest. */
  uint8_t *rims;
  /* Of a tick: */
  sbf_vec3 *places, *ways; /* (vertex_count) */
  float fastest_m;         /* the way of its fastest point */
  uint32_t *inside;        /* (vertex_count) room for find_inside.c */
  sbri_box *boxes;         /* (triangle_count) of the ways, grown */
  sbri_bounds_tree tree;
} sbri_meet_surface;

/* A body that others may meet. */
typedef struct sbri_meeter {
  uint32_t character, number; /* of the soft or the rigid body */
  bool rigid, gives_way;
  bool itself; /* it meets itself as well */
  uint32_t layer, mask;
} sbri_meeter;

/* Two of them, by their numbers, a before b; or one that meets itself. */
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
  uint32_t first_mover; /* of the group's: of its first rigid body, */
  uint32_t first_guest; /* and of the first of the host's bodies that they push */
} sbri_meet_member;

/* ---- Touches ---- */

/* A rigid body, and as many of the host's that it pushes. */
enum { SBRI_MOVERS_OF_BODY = 3 };

enum { SBRI_MEET_SLOTS = 12, SBRI_MEET_SOFT = -1, SBRI_MEET_PLANE = -2 };

/* A place of a body: on a rigid one, or carried by up to twelve points of a soft one. */
typedef struct sbri_meet_side {
  uint32_t member;
  int32_t rigid_body; /* SBRI_MEET_SOFT, or SBRI_MEET_PLANE: what the world's ground and shapes bound it by */
  uint32_t island, count;
  uint32_t slots[SBRI_MEET_SLOTS];
  float weights[SBRI_MEET_SLOTS];
  sbf_vec3 at; /* in the rigid body's own frame, m; of a plane: a place on it when the tick begins, or, if it
                  gives way, from the guest's centre of mass */
  sbf_vec3 goes;  /* m/s of a plane */
  uint32_t guest; /* of a plane that gives way, from 1 on: number of the rigid parts' guest; 0: it does not */
} sbri_meet_side;

typedef struct sbri_meet_touch {
  sbri_meet_side a, b;
  uint64_t names[2]; /* sbri_meet_name of both, and which place of them it is: */
  uint32_t feature;
  sbf_vec3 normal; /* unit, from b to a */
  float margin;    /* m that they keep */
  float friction, restitution;
  /* From step to step: */
  sbf_vec3 slid;   /* m across, of a against b since they stick */
  sbf_vec3 apart;  /* and where a was from b when that was so */
  float soft_m;    /* size of the smaller of both that is soft; 0: neither is */
  float pull;      /* m/s along the normal, that a step adds */
  float after;     /* m/s along the normal, when its pushes were over, */
  bool was_pushed; /* if they have been and no step's begin has looked at it since */
  float gain;      /* N s along the normal */
  sbf_vec3 rub;    /* N s across it */
  bool pushed;
  bool is_in;        /* too far in b for it to be a matter of how surfaces lie on each other */
  bool goes_out;     /* too deep for a face to be near (find_deep.c): nothing rubs on its way out */
  bool goes_through; /* likewise, along what its neighbours go as well (find_through.c) */
  bool is_new;       /* nobody remembers it from the tick before */
  /* For events, of the whole tick: */
  float impulse;  /* N s along the normal */
  float closing;  /* m/s, the most with which it was pushed against */
  sbf_vec3 place; /* where that was last */
} sbri_meet_touch;

/* What is kept of a touch that pushed, from tick to tick: what it will be pushed with again, to begin with.
 */
typedef struct sbri_meet_memory {
  uint64_t names[2];
  uint32_t feature;
  sbf_vec3 at;      /* in a's own frame, if it is rigid */
  float force;      /* N along the normal */
  sbf_vec3 rub;     /* N across it */
  sbf_vec3 slid;    /* m across */
  float pull;       /* m/s^2 along the normal */
  sbf_vec3 through; /* unit, the common way out of what lies through another; 0: it does not */
  uint32_t next;    /* number of the next one of the same names; or UINT32_MAX */
} sbri_meet_memory;

/* Two bodies that touch, for events. */
typedef struct sbri_meet_contact {
  uint64_t names[2];    /* the lesser first */
  sbr_double3 position; /* world, of the touch that pushes most */
  sbf_vec3 normal;      /* there, away from the second */
  float impulse, speed; /* N s of all, and the fastest in m/s, in this tick */
} sbri_meet_contact;

/* A rigid body that gives way, or one of the host, as pushes see it in a step. */
typedef struct sbri_meet_mover {
  uint32_t member, body, guest; /* as a side has it, or 0: it is a body of the character's own */
  sbf_vec3 position, fine;      /* and what that has beyond its rounded numbers */
  float turn[3][3];             /* its own axes to the world's */
  sbri_four velocity, spin;     /* m/s, rad/s */
  float ease;                   /* 1/kg */
  float eases[3][3];            /* 1/(kg m^2), about the world's axes */
  sbf_vec3 given, moment;       /* N s and N m s: the pushes so far */
} sbri_meet_mover;

/* A side as pushes see it in a step: a mover, or points and what nothing pushes. */
typedef struct sbri_meet_end {
  sbri_meet_mover *mover; /* NULL: points */
  sbf_vec3 arm;           /* m, from the mover's centre of mass to where it is pushed */
  sbf_vec3 made;          /* the arm that the row's eases are for */
  sbri_four spins[3];     /* 1/(kg m), of the mover by a push along x, y and z, while one is looked for */
  sbf_vec3 still;         /* m/s, of what is not pushed */
  uint32_t count;
  float speed;                                            /* of the points' numbers */
  float *points[SBRI_MEET_SLOTS];                         /* their velocities, each SBRI_BLOCK apart */
  float weights[SBRI_MEET_SLOTS], eases[SBRI_MEET_SLOTS]; /* 1/kg, times the weight, in those numbers */
} sbri_meet_end;

/* A touch in a step. */
typedef struct sbri_meet_row {
  sbri_meet_touch *touch;
  sbf_vec3 normal, wanted; /* m/s: of the velocity, but for what is expected */
  float friction, mass;    /* kg along the normal */
  float eases[6];          /* 1/kg of both against each other, xx yy zz xy xz yz; its inverse: */
  float block[6];
  float gain;
  sbf_vec3 rub;
  float gap;
  sbf_vec3 apart; /* a from b, m */
  sbf_vec3 place; /* where both are pushed */
  float speed;    /* m/s along the normal before its pushes */
  bool bears;     /* takes part */
  sbri_meet_end a, b;
  /* While its push is looked for: */
  sbri_four impulse, first;          /* N s, gain and rub; and when it begins */
  sbri_four along, aim;              /* the normal; what is wanted of what is pushed */
  sbri_four blocks[3];               /* columns of `block` */
  sbri_four arms[2], arms_turned[2]; /* of both movers */
  sbri_meet_mover *movers[2];        /* one that stands in place of none */
  float ease;                        /* 1/kg^2 along the normal, squared */
  sbri_four way, change;             /* N s, of passes so far and of the present one */
} sbri_meet_row;

typedef struct sbri_meet_group {
  uint32_t first_member, member_count; /* in `members` */
  uint32_t first_pair, pair_count;
  uint32_t first_touch, touch_count, touch_capacity;
  uint32_t first_mover, mover_count;
  float step_s; /* of this tick */
  sbr_double3 origin;
} sbri_meet_group;

/* How two bodies of a character are at rest: apart, two sections that touch, or others that do. */
typedef enum sbri_at_rest { SBRI_APART_AT_REST, SBRI_HANG_TOGETHER, SBRI_TOUCH_AT_REST } sbri_at_rest;

typedef struct sbri_meetings {
  sbfi_arena *arenas; /* (character_capacity) */
  sbri_meet_surface *
      *surfaces; /* (character_capacity) each of its soft bodies on its rung; NULL: none is made */
  sbri_meet_surface **all_surfaces; /* (character_capacity) of each of its soft rungs, one behind the other */
  sbri_meet_surface **hulls;        /* (character_capacity) of each of its rigid bodies */
  uint8_t **together;        /* (character_capacity) an sbri_at_rest of each two of its soft bodies, then of
                                each of these and each rigid one */
  uint32_t *group_of;        /* (character_capacity) UINT32_MAX: it meets nobody */
  uint32_t *member_of;       /* (character_capacity) its number in its group */
  uint32_t *next_of_group;   /* (character_capacity) while groups are made: the next in it, or UINT32_MAX */
  sbri_meet_member *members; /* (character_capacity) group after group */
  sbri_meet_group *groups;   /* (character_capacity) */
  uint32_t group_count;
  sbri_meeter *meeters; /* (meeter_capacity) */
  sbri_box *boxes;      /* likewise, of their ways */
  sbri_bounds_tree tree;
  uint32_t meeter_count, meeter_capacity;
  sbri_meet_pair *pairs, *found_pairs; /* (touch_capacity) group after group, and as they are found */
  uint32_t pair_count;
  sbri_meet_touch *touches; /* (touch_capacity) */
  sbri_meet_row *rows;      /* likewise */
  /* (touch_capacity) of the tick before and of this one; state. */
  sbri_meet_memory *memories, *next_memories;
  uint32_t memory_count;
  uint32_t *found_memories; /* (found_capacity, a power of two) by names: their first memory, or UINT32_MAX */
  uint32_t found_capacity;
  sbri_meet_contact *contacts, *next_contacts; /* (touch_capacity) by names; output, not state */
  uint32_t contact_count;
  sbri_meet_mover *movers; /* (meeter_capacity x SBRI_MOVERS_OF_BODY) group after group */
  uint32_t touch_capacity, character_capacity;
} sbri_meetings;

/* ---- meet/surfaces.c ---- */

/* Room for a character's bodies, beside that of all others; false where memory runs out. */
bool sbri_meetings_reserve(sbr_world *world, const sbr_model *model);
/* The surfaces of a character that has just been made; false likewise. */
bool sbri_meet_surfaces_make(sbr_world *world, uint32_t character);
void sbri_meet_surfaces_free(sbr_world *world, uint32_t character);
/* Those of the rung that it is on now. */
void sbri_meet_surfaces_choose(sbr_world *world, uint32_t character);
void sbri_meetings_free(sbr_world *world);
/* Places and ways of its vertices within the tick, and the tree over its triangles. */
void sbri_meet_surface_place(sbr_world *world, const sbri_meet_member *member, uint32_t soft_body);

/* ---- meet/surface_room.c ---- */

/* Where that carries at rest, in the model's own metres. */
sbf_vec3 sbri_meet_rest(const sbr_model *model, uint32_t soft_body, const sbri_sample *sample);

/* Room for what is of a tick alone. */
bool sbri_meet_surface_room(
    sbri_meet_surface *surface, uint32_t vertices, uint32_t triangles, sbfi_arena *arena);
/* Over its triangles and their ways, grown. */
void sbri_meet_tree_make(sbri_meet_surface *surface, float reach);
/* How long its edges are and how thick it is, as it is placed. */
void sbri_meet_surface_measure(sbri_meet_surface *surface);

/* ---- meet/hull_surfaces.c ---- */

bool sbri_meet_hulls_make(const sbr_model *model, sbri_meet_surface *hulls, sbfi_arena *arena);
/* Its vertices, how they go to where it ends, and the tree over its triangles, of a character of that scale.
 */
void sbri_meet_hull_place(const sbri_rigid_body *body, const sbr_transform *at, const sbr_transform *end,
    float scale, sbri_meet_surface *hull);

/* ---- meet/find_deep.c ---- */

/* Whether each side of its triangles is one of another, the other way round. */
bool sbri_meet_is_closed(const sbri_meet_surface *surface);

/* ---- meet/rims.c ---- */

/* Finds the sides of its triangles, and ridges of a closed one, which is placed at rest; takes the tree for
 * scratch. False where memory runs out. */
bool sbri_meet_rims_make(sbri_meet_surface *surface, sbfi_arena *arena);
/* Which sides of the triangles of a two-sided one stand out, as it is placed now. */
void sbri_meet_rims_look(sbri_meet_surface *surface);

/* ---- meet/at_rest.c ---- */

/* Notes how bodies are to each other at rest, into zeros; places surfaces and hulls for it. */
void sbri_meet_rest_look(
    const sbr_model *model, sbri_meet_surface *surfaces, sbri_meet_surface *hulls, uint8_t *together);

/* ---- meet/pairs.c ---- */

/* Finds who may meet whom in this tick, and the groups. */
void sbri_meet_pairs_find(sbr_world *world);
bool sbri_meet_is_awake(const sbri_character *c);

/* ---- meet/near.c ---- */

/* Notes of each character that has rungs whether another is so near that both must be able to meet. */
void sbri_meet_near_find(sbr_world *world);

/* ---- meet/find.c ---- */

/* The touches of a group that begins to step, up to its capacity. */
void sbri_meet_touches_find(sbr_world *world, sbri_meet_group *group);

/* ---- meet/remember.c ---- */

static inline uint64_t sbri_meet_name(const sbri_meeter *is) {
  return (uint64_t)is->character << 32 | (uint64_t)is->rigid << 31 | is->number;
}
/* Those of the host's shapes come before it. */
#define SBRI_MEET_NAME_OF_GROUND UINT64_MAX
/* The number of that shape; UINT32_MAX: the ground. */
static inline uint32_t sbri_meet_collider_of(uint64_t name) {
  return (uint32_t)(SBRI_MEET_NAME_OF_GROUND - name) - 1;
}

/* What is remembered of the two, in that order, one after the other; NULL: no more. */
const sbri_meet_memory *sbri_meet_first_memory(const sbri_meetings *all, const uint64_t names[2]);
const sbri_meet_memory *sbri_meet_next_memory(const sbri_meetings *all, const sbri_meet_memory *m);
/* What the group's touches have from the tick before. */
void sbri_meet_recall(const sbri_meetings *all, const sbri_meet_group *group, float step_s);
/* The same of what pushed in the step before, for steps of another length. */
void sbri_meet_go_on(const sbri_meetings *all, sbri_meet_group *group, float step_s);
/* Keeps what pushes now, when all groups have stepped with steps of that share of the tick. */
void sbri_meet_remember(sbr_world *world);
/* Of a snapshot: the memories, as many bytes whatever there is. */
size_t sbri_meet_memory_size(const sbr_world *world);
void sbri_meet_memory_save(const sbr_world *world, unsigned char *to);
void sbri_meet_memory_restore(sbr_world *world, const unsigned char *from);

/* ---- meet/ends.c ---- */

/* How many of the member's guests are movers. */
static inline uint32_t sbri_meet_guests_of(const sbri_meet_member *m) {
  uint32_t most = (SBRI_MOVERS_OF_BODY - 1) * m->character->model->rigid.body_count;
  if (!m->parts.steps) return 0;
  return m->parts.work.guest_count < most ? m->parts.work.guest_count : most;
}

/* The movers of a group that begins to step. */
void sbri_meet_movers_list(const sbri_meetings *all, sbri_meet_group *group);
/* Where they are and how they move now. */
void sbri_meet_movers_read(const sbri_meetings *all, const sbri_meet_group *group);
/* By what that guest's velocity, as touches see it, will grow a second in the step, beside pushes, m/s^2. */
sbf_vec3 sbri_meet_guest_fall(const sbri_meet_group *group, const sbri_meet_member *m, uint32_t guest);
/* Gives the bodies what the movers were given. */
void sbri_meet_movers_write(const sbri_meetings *all, const sbri_meet_group *group);
/* The two ends of a touch now, its gap but for the margin, and where the tick is new its eases. */
void sbri_meet_row_begin(
    const sbri_meetings *all, const sbri_meet_group *group, sbri_meet_row *row, bool is_new);

/* ---- meet/push.c ---- */

/* Pushes before a step, the tick's first or another. */
void sbri_meet_push(const sbr_world *world, const sbri_meet_group *group, bool first);
/* Where they have come to when the last step is over. */
void sbri_meet_look(const sbri_meetings *all, const sbri_meet_group *group);

/* ---- meet/tell.c ---- */

/* Events of those who begin to touch and of those who part, when all groups have stepped. */
void sbri_meet_tell(sbr_world *world);
/* A character is gone: whom it touched. */
void sbri_meet_forget(sbr_world *world, uint32_t character);

#endif
