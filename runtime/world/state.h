/* A character: constant settings, one block of mutable state (what a snapshot copies and the hash covers),
 * and scratch memory whose content means nothing between calls. */
#ifndef SBRI_STATE_H
#define SBRI_STATE_H

#include "collide/bounds_tree.h"
#include "collide/touching.h"
#include "gait/gait.h"
#include "math/follower.h"
#include "model/delta.h"
#include "model/island_tick.h"
#include "model/runtime_model.h"
#include "rigid/rigid_state.h"

enum { SBRI_TICK_EVENTS = 2 * SBRI_MAX_LEGS + 1 }; /* feet go up and down, and it lands */

/* What has become of a polygon. */
enum { SBRI_POLYGON_TORN = 1 };

/* First in the state block. No padding: the hash reads it as words. */
typedef struct sbri_character_state {
  sbr_double3 origin;            /* m, world */
  float forward, sideways, turn; /* wanted motion */
  uint32_t paused;
  uint32_t asleep; /* nothing of it changes until a call or the ground does */
  /* Its rung, the one that it goes over to when the next tick begins, and what the host has put it on, plus
   * 1. */
  uint32_t rung, next_rung, set_rung_plus_1;
  uint32_t rung_ticks;              /* since it changed; UINT32_MAX: nobody has seen how it is */
  uint32_t fade_ticks, fades_ticks; /* left of the change, and of how many; 0: it is over */
  float fade, fade_before;          /* share of `faded` that shows, and a tick ago */
  uint32_t shown;                   /* sbr_shown */
  uint32_t unseen_ticks;            /* for how long no view has it */
  uint32_t fade_kept;               /* it goes over in the next tick, and is looked at meanwhile */
  uint32_t swing_ticks;             /* for how long a change has been put off because it swings */
  float up;                         /* wanted vertical speed, m/s */
  sbf_vec3 moved;                   /* by the host, in the next tick; m */
  float turned;                     /* the same, rad */
} sbri_character_state;

typedef struct sbri_island_state {
  float stretch;         /* greatest share of a spring beyond its rest length, in the last substep */
  float stiffening;      /* greatest share of a tetrahedron's stiffness to that at rest then, 1 at rest */
  float min_ratio;       /* least J of its tetrahedra then: below 0 one is inside out; 1: it has none */
  float thinning;        /* greatest g.g of a yielded rest shape to that it was made with, 1 as made */
  uint32_t folded_ticks; /* for how long its volume has been next to nothing, or such elements inverted */
  uint32_t unstable;     /* for how many ticks its shape has been (soft/folded.c) */
  float excess_j;        /* of energy, likewise; 0: not looked at */
  uint32_t calm_ticks;   /* for which its motion is still taken out of it */
  uint32_t recoveries;
  uint32_t unsplit; /* points that a tear should have split, and there was no room */
  sbri_recovery recovery;
  uint32_t asleep;      /* it is not stepped */
  uint32_t told_asleep; /* what the host was last told of that */
  uint32_t quiet_ticks; /* for how long it has been as slow as a sleeper */
  uint32_t ground_mark; /* of the ground that a sleeper lies on */
  uint32_t passes;      /* over its elements, since it was made */
} sbri_island_state;

/* How what holds a body moved in the last tick, as a rigid body; of a loose body, how it itself moved when it
 * was last sound. */
typedef struct sbri_guide_motion {
  sbf_vec3 velocity, spin; /* of its middle, m/s; rad/s */
} sbri_guide_motion;

/* A vertex as the rung before would have it go on, asset metres: as a weight on a spring. Places are from
 * where the bones alone would have it, or, where there are none, from where the new rung has it. */
typedef struct sbri_going {
  sbf_vec3 place, was; /* and a tick ago */
  sbf_vec3 still;      /* where it would come to rest */
  sbf_vec3 kept;       /* while a change is begun: where it was shown two ticks before that */
} sbri_going;

/* Memory for a rung: a state block and scratch behind it, each as its model lays them out. */
typedef struct sbri_room {
  const sbr_model *model; /* NULL: there is none */
  unsigned char *state, *scratch;
} sbri_room;

typedef struct sbri_character {
  const sbr_model *model; /* of the rung that it is on; NULL: the place is free */
  uint32_t generation;
  bool hold;
  bool near; /* others are about that its bodies may have to meet: of this tick */
  float scale;
  float time_scale;  /* 1 / sqrt(scale): its own seconds in one of the world's */
  sbr_ground ground; /* that it stands on */
  unsigned char *state, *scratch;
  sbri_room spare;        /* of the rung that it was on before, or is about to go over to */
  uint32_t spare_ticks;   /* for which nothing has asked for that */
  void *rigid_work;       /* (rigid_work_size) what simulated rigid parts are solved in; NULL: none are */
  uint32_t rigid_ticks;   /* for which none have been */
  uint32_t refused_ticks; /* until memory that there was not is asked for again */
  uint64_t sampled_at;    /* stamp of the moment that `sampled` holds; 0: none */
  uint32_t event_count;   /* of the last tick */
  sbri_gait_event events[SBRI_TICK_EVENTS];
} sbri_character;

/* ---- world/room.c ---- */

/* Bytes of a room. */
size_t sbri_room_size(const sbr_model *model);
/* Room for the model, of any content; false: memory has run out. */
bool sbri_room_make(const sbf_allocator *allocator, const sbr_model *model, sbri_room *room);
void sbri_room_free(const sbf_allocator *allocator, sbri_room *room);
void sbri_rigid_work_free(const sbf_allocator *allocator, sbri_character *c);
/* The character has the spare room, full of zeros, and what it had is the spare one. */
void sbri_room_swap(sbri_character *c);

/* ---- world/layout.c ---- */

/* Of a model and all its rungs. */
void sbri_layouts_make(sbr_model *model);
/* Bytes of the deltas of its frames (pose/frames.h). */
size_t sbri_deltas_size(const sbr_model *model);

#define SBRI_STATE_PART(name, type, offset)                                                                  \
  static inline type *sbri_##name(const sbri_character *c) {                                                 \
    return (type *)(void *)(c->state + (offset));                                                            \
  }
SBRI_STATE_PART(head, sbri_character_state, 0)
SBRI_STATE_PART(loads, sbri_load, c->model->layout.loads) /* (SBR_LOAD_CAPACITY) */
SBRI_STATE_PART(gait, void, c->model->layout.gait)
SBRI_STATE_PART(pose, sbr_transform, c->model->layout.pose)                          /* (frame_count) */
SBRI_STATE_PART(previous_pose, sbr_transform, c->model->layout.previous_pose)        /* (frame_count) */
SBRI_STATE_PART(island_states, sbri_island_state, c->model->layout.islands)          /* (island_count) */
SBRI_STATE_PART(positions, sbri_point, c->model->layout.positions)                   /* (slot_count) */
SBRI_STATE_PART(previous_positions, sbri_point, c->model->layout.previous_positions) /* (slot_count) */
SBRI_STATE_PART(velocities, float, c->model->layout.velocities)                      /* (slot_count x 3) */
SBRI_STATE_PART(guide_motions, sbri_guide_motion, c->model->layout.guide_motions)    /* (bodies) */
SBRI_STATE_PART(rests, float, c->model->layout.rests)                    /* (flow_count) m, rest lengths */
SBRI_STATE_PART(strengths, float, c->model->layout.strengths)            /* (flow_count) 1, or 0 where torn */
SBRI_STATE_PART(rotations, float, c->model->layout.rotations)            /* (region_block_count x 4 x 8) */
SBRI_STATE_PART(solids, sbri_tetrahedron_block, c->model->layout.solids) /* (solid_block_count) */
SBRI_STATE_PART(torn, uint32_t, c->model->layout.torn)                   /* (solid_count) sbri_torn_state */
/* Of models whose elements may tear, else empty: where each slot comes from, SBRI_UNUSED while it is room
 * for a point that splits; what it weighs; the cells of skins, the tetrahedron that each binding rides on,
 * and what has become of each polygon. */
SBRI_STATE_PART(origins, uint32_t, c->model->layout.origins)            /* (slot_count) */
SBRI_STATE_PART(masses, float, c->model->layout.masses)                 /* (slot_count) kg */
SBRI_STATE_PART(inverse_masses, float, c->model->layout.inverse_masses) /* (slot_count) 1/kg */
SBRI_STATE_PART(gravity_scales, float, c->model->layout.gravity_scales) /* (slot_count) */
/* Of islands whose springs may tear, as the model has them with points that have split: what is in use of
 * each block's cells, the cells, their damping and links, and the links. */
SBRI_STATE_PART(thread_ends, uint32_t, c->model->layout.thread_ends)            /* (thread_block_count) */
SBRI_STATE_PART(thread_cells, sbri_spring_cell, c->model->layout.thread_cells)  /* (thread_cell_count) */
SBRI_STATE_PART(thread_damping, float, c->model->layout.thread_damping)         /* (thread_cell_count x 8) */
SBRI_STATE_PART(thread_slack, float, c->model->layout.thread_slack)             /* (thread_cell_count x 8) */
SBRI_STATE_PART(thread_links, uint32_t, c->model->layout.thread_links)          /* (thread_cell_count x 8) */
SBRI_STATE_PART(thread_blocks, sbri_link_block, c->model->layout.thread_blocks) /* (thread_link_count) */
SBRI_STATE_PART(skin_cells, sbri_carry_cell, c->model->layout.skin_cells)       /* (torn_cell_count) */
SBRI_STATE_PART(bound_to, uint32_t, c->model->layout.bound_to)                  /* (binding_count) */
SBRI_STATE_PART(torn_polygons, uint32_t, c->model->layout.torn_polygons)        /* (torn_polygon_count) */
SBRI_STATE_PART(rigid_bodies, sbri_rigid_body_state, c->model->layout.rigid_bodies)  /* (rigid bodies) */
SBRI_STATE_PART(rigid_joints, sbri_rigid_joint_state, c->model->layout.rigid_joints) /* (joints) */
SBRI_STATE_PART(rigid_drive, sbri_rigid_drive_state, c->model->layout.rigid_drive)
SBRI_STATE_PART(rigid_kept, sbri_kept_touch, c->model->layout.rigid_kept) /* (sbri_rigid_touch_capacity) */
SBRI_STATE_PART(faded, sbri_going, c->model->layout.faded)              /* (vertices of all render meshes) */
SBRI_STATE_PART(jiggles, sbri_place_follower, c->model->layout.jiggles) /* (jiggle_count) asset metres */
#undef SBRI_STATE_PART

#define SBRI_SCRATCH_PART(name, type, offset)                                                                \
  static inline type *sbri_##name(const sbri_character *c) {                                                 \
    return (type *)(void *)(c->scratch + (offset));                                                          \
  }
SBRI_SCRATCH_PART(deltas, sbri_delta, c->model->layout.deltas)                   /* (frame_count) */
SBRI_SCRATCH_PART(previous_deltas, sbri_delta, c->model->layout.previous_deltas) /* (frame_count) */
SBRI_SCRATCH_PART(
    animated, sbr_transform, c->model->layout.animated) /* (frame_count) pose before rigid parts */
SBRI_SCRATCH_PART(rigid_targets, sbr_transform, c->model->layout.rigid_targets) /* (rigid bodies) */
SBRI_SCRATCH_PART(reactions, sbri_reaction, c->model->layout.reactions)         /* (rigid bodies) */
SBRI_SCRATCH_PART(burdens, sbri_rigid_burden, c->model->layout.burdens)         /* (rigid bodies) */
SBRI_SCRATCH_PART(stepped_pose, sbr_transform, c->model->layout.stepped_pose)   /* (frame_count) in a tick */
SBRI_SCRATCH_PART(gait_before, void, c->model->layout.gait_before)
SBRI_SCRATCH_PART(targets, sbri_point, c->model->layout.targets)                 /* (slot_count) */
SBRI_SCRATCH_PART(guide_velocities, float, c->model->layout.guide_velocities)    /* (slot_count x 3) */
SBRI_SCRATCH_PART(begins, sbri_point, c->model->layout.begins)                   /* (slot_count) */
SBRI_SCRATCH_PART(velocity_points, sbri_point, c->model->layout.velocity_points) /* (slot_count) */
SBRI_SCRATCH_PART(outer, sbri_point, c->model->layout.outer)                     /* (slot_count) */
SBRI_SCRATCH_PART(accelerations, float, c->model->layout.accelerations)          /* (slot_count x 3) */
SBRI_SCRATCH_PART(older_velocities, float, c->model->layout.older_velocities)    /* (slot_count x 3) */
SBRI_SCRATCH_PART(moves, sbri_point, c->model->layout.moves)                     /* (slot_count) */
SBRI_SCRATCH_PART(edges, float, c->model->layout.edges)                          /* (link_block_count x 24) */
SBRI_SCRATCH_PART(solid_edges, float, c->model->layout.solid_edges) /* (tetrahedron_block_count x 72) */
SBRI_SCRATCH_PART(tears_of, sbri_tears, c->model->layout.tears)     /* (island_count) */
SBRI_SCRATCH_PART(element_forces, sbri_point, c->model->layout.element_forces) /* (slot_count) */
SBRI_SCRATCH_PART(loads_now, sbri_loads_now_list, c->model->layout.loads_now)  /* of this tick */
SBRI_SCRATCH_PART(visits, uint32_t, c->model->layout.visits)                   /* (solid_count x 2) */
SBRI_SCRATCH_PART(queue, uint32_t, c->model->layout.queue)                     /* (solid_count) */
SBRI_SCRATCH_PART(touched, uint8_t, c->model->layout.touched)                  /* (binding_count) */
SBRI_SCRATCH_PART(owners, uint32_t, c->model->layout.owners) /* (slot_count x 2) where springs may tear */
SBRI_SCRATCH_PART(frayed, uint8_t, c->model->layout.frayed)  /* (slot_count) likewise: near a torn spring */
SBRI_SCRATCH_PART(planes, float, c->model->layout.planes)    /* (slot_count x 4) */
SBRI_SCRATCH_PART(near_ground, uint8_t, c->model->layout.near_ground)    /* (slot_count / 8) */
SBRI_SCRATCH_PART(touches, sbri_touch, c->model->layout.touches)         /* (samples of all bodies) */
SBRI_SCRATCH_PART(touch_counts, uint32_t, c->model->layout.touch_counts) /* (bodies) */
/* (island_count) 1: in contact with bodies of characters in this tick; unset without such contacts */
SBRI_SCRATCH_PART(contact_islands, uint8_t, c->model->layout.contact_islands)
SBRI_SCRATCH_PART(
    external_bodies_of, struct sbri_external_bodies, c->model->layout.external_bodies) /* (bodies) */
SBRI_SCRATCH_PART(touch_weights, float, c->model->layout.touch_weights)                /* (slot_count) */
SBRI_SCRATCH_PART(slot_touches, uint8_t, c->model->layout.slot_touches)                /* (slot_count) */
SBRI_SCRATCH_PART(soft_touching, sbri_touching, c->model->layout.touching)             /* (bodies) */
SBRI_SCRATCH_PART(rigid_touching, sbri_touching, c->model->layout.rigid_touching)      /* (rigid bodies) */
SBRI_SCRATCH_PART(self_boxes, sbri_box, c->model->layout.self_boxes) /* (triangles of bodies that do) */
SBRI_SCRATCH_PART(self_balls, sbri_moving_ball, c->model->layout.self_balls)
SBRI_SCRATCH_PART(
    self_nodes, sbri_bounds_node, c->model->layout.self_nodes) /* (twice that, and one a body) */
SBRI_SCRATCH_PART(self_items, uint32_t, c->model->layout.self_items)
SBRI_SCRATCH_PART(self_edges, uint8_t, c->model->layout.self_edges)
SBRI_SCRATCH_PART(sampled, sbri_point, c->model->layout.sampled)               /* (slot_count) */
SBRI_SCRATCH_PART(sampled_deltas, sbri_delta, c->model->layout.sampled_deltas) /* (frame_count) */
SBRI_SCRATCH_PART(vertices, sbri_point, c->model->layout.vertices) /* (most vertices of a mesh, padded) */
SBRI_SCRATCH_PART(faces, sbri_point, c->model->layout.faces)       /* (most faces of a mesh, padded) */
SBRI_SCRATCH_PART(sums, sbri_point, c->model->layout.sums)         /* (most groups of a mesh, padded) */
SBRI_SCRATCH_PART(surface_vertices, sbri_point, c->model->layout.surface_vertices) /* of all bodies */
SBRI_SCRATCH_PART(surface_forces, sbri_point, c->model->layout.surface_forces)
SBRI_SCRATCH_PART(surface_velocities, sbri_point, c->model->layout.surface_velocities)
SBRI_SCRATCH_PART(surface_faces, sbri_point, c->model->layout.surface_faces) /* of all bodies */
/* Of a change of rungs, of the one before it: how far each point was from its guide, and how fast. */
SBRI_SCRATCH_PART(offsets, sbri_point, c->model->layout.offsets) /* (slot_count) */
SBRI_SCRATCH_PART(speeds, sbri_point, c->model->layout.speeds)   /* (slot_count) */
SBRI_SCRATCH_PART(fading, sbri_point, c->model->layout.fading)   /* (most vertices of a mesh, padded) */
SBRI_SCRATCH_PART(pulls, float, c->model->layout.pulls)          /* (bodies + 1) */
SBRI_SCRATCH_PART(energies, double, c->model->layout.energies)   /* (bodies) J */
#undef SBRI_SCRATCH_PART

/* A host's impulse in the character's own units is so many times as great: masses go with the cube of the
 * scale and times with its square root, speeds with the root too. */
static inline float sbri_own_impulse(const sbri_character *c) {
  return c->time_scale / (c->scale * c->scale * c->scale);
}

static inline void sbri_island_wake(sbri_character *c, uint32_t island) {
  sbri_island_state *state = &sbri_island_states(c)[island];
  state->asleep = 0;
  state->quiet_ticks = 0;
}
static inline void sbri_character_wake(sbri_character *c) {
  sbri_head(c)->asleep = 0;
}

/* ---- world/present.c ---- */

#define SBRI_UNUSED UINT32_MAX

/* The island with what its state has in place of the model's: masses, and tetrahedra. */
sbri_island sbri_island_now(const sbri_character *c, const sbri_island *island);
/* Gives points that have split what their origins have, and unused ones what the body's first has: for tables
 * of the body's slots that are made by the model's. */
void sbri_follow_origins(const sbri_character *c, const sbri_body *body, sbri_point *places);
/* A skin as the character has it: with cells of its own where it may tear. */
sbri_skin sbri_skin_now(const sbri_character *c, const sbri_skin *skin);

#endif
