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

enum { SBRI_TICK_EVENTS = 2 * SBRI_MOST_LEGS };

/* First in the state block. No padding: the hash reads it as words. */
typedef struct sbri_character_state {
  sbr_double3 origin;            /* m, world */
  float forward, sideways, turn; /* wanted motion */
  uint32_t paused;
  uint32_t asleep; /* nothing of it changes until a call or the ground does */
  /* Its rung, the one that it goes over to when the next tick begins, and what the host has put it on, plus
   * 1. */
  uint32_t rung, next_rung, set_rung_plus_1;
  uint32_t rung_ticks;              /* since it changed */
  uint32_t fade_ticks, fades_ticks; /* left of the change, and of how many; 0: it is over */
  float fade, fade_before;          /* share of `faded` that shows, and a tick ago */
  uint32_t shown;                   /* sbr_shown */
  uint32_t unseen_ticks;            /* for how long no view has it */
  uint32_t unused;                  /* to the next double */
} sbri_character_state;

typedef struct sbri_island_state {
  float stretch;         /* greatest share of a spring beyond its rest length, in the last substep */
  float stiffening;      /* greatest share of a tetrahedron's stiffness to that at rest then, 1 at rest */
  float least_ratio;     /* least J of its tetrahedra then: below 0 one is inside out; 1: it has none */
  float thinning;        /* greatest g.g of a yielded rest shape to that it was made with, 1 as made */
  uint32_t folded_ticks; /* for how long its volume has been next to nothing, or such elements inverted */
  uint32_t wild;         /* for how many ticks its shape has been (core/folded.c) */
  float excess_j;        /* of energy, likewise; 0: not looked at */
  uint32_t calm_ticks;   /* for which its motion is still taken out of it */
  uint32_t recoveries;
  uint32_t unsplit;     /* points that a tear should have split, and there was no room */
  uint32_t recovering;  /* ticks for which the router still keeps to the scheme that recovers */
  uint32_t asleep;      /* it is not stepped */
  uint32_t told_asleep; /* what the host was last told of that */
  uint32_t quiet_ticks; /* for how long it has been as slow as a sleeper */
  uint32_t ground_mark; /* of the ground that a sleeper lies on */
} sbri_island_state;

/* How what holds a body moved in the last tick, as a rigid body. */
typedef struct sbri_guide_motion {
  sbf_vec3 velocity, spin; /* of its middle, m/s; rad/s */
} sbri_guide_motion;

typedef struct sbri_character {
  const sbr_model *model; /* NULL: the place is free */
  uint32_t generation;
  bool hold;
  float scale;
  float time_scale; /* 1 / sqrt(scale): its own seconds in one of the world's */
  unsigned char *state, *scratch;
  uint64_t sampled_at;  /* stamp of the moment that `sampled` holds; 0: none */
  uint32_t event_count; /* of the last tick */
  sbri_gait_event events[SBRI_TICK_EVENTS];
} sbri_character;

/* Of a model and all its rungs. */
void sbri_layouts_make(sbr_model *model);

#define SBRI_STATE_PART(name, type, offset)                                                                  \
  static inline type *sbri_##name(const sbri_character *c) {                                                 \
    return (type *)(void *)(c->state + (offset));                                                            \
  }
SBRI_STATE_PART(head, sbri_character_state, 0)
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
/* By how much each vertex of the render meshes lay elsewhere on the rung before, asset metres. */
SBRI_STATE_PART(faded, sbf_vec3, c->model->layout.faded)
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
SBRI_SCRATCH_PART(stepped_pose, sbr_transform, c->model->layout.stepped_pose)   /* (frame_count) in a tick */
SBRI_SCRATCH_PART(rigid_work, void, c->model->layout.rigid_work)
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
SBRI_SCRATCH_PART(visits, uint32_t, c->model->layout.visits)                   /* (solid_count x 2) */
SBRI_SCRATCH_PART(queue, uint32_t, c->model->layout.queue)                     /* (solid_count) */
SBRI_SCRATCH_PART(touched, uint8_t, c->model->layout.touched)                  /* (binding_count) */
SBRI_SCRATCH_PART(owners, uint32_t, c->model->layout.owners) /* (slot_count x 2) where springs may tear */
SBRI_SCRATCH_PART(frayed, uint8_t, c->model->layout.frayed)  /* (slot_count) likewise: near a torn spring */
SBRI_SCRATCH_PART(planes, float, c->model->layout.planes)    /* (slot_count x 4) */
SBRI_SCRATCH_PART(near_ground, uint8_t, c->model->layout.near_ground)      /* (slot_count / 8) */
SBRI_SCRATCH_PART(touches, sbri_touch, c->model->layout.touches)           /* (samples of all bodies) */
SBRI_SCRATCH_PART(touch_counts, uint32_t, c->model->layout.touch_counts)   /* (bodies) */
SBRI_SCRATCH_PART(slot_touches, uint8_t, c->model->layout.slot_touches)    /* (slot_count) */
SBRI_SCRATCH_PART(soft_touching, sbri_touching, c->model->layout.touching) /* (bodies) */
SBRI_SCRATCH_PART(rigid_touching, sbri_touching, c->model->layout.rigid_touching) /* (rigid bodies) */
SBRI_SCRATCH_PART(self_boxes, sbri_box, c->model->layout.self_boxes) /* (triangles of bodies that do) */
SBRI_SCRATCH_PART(
    self_nodes, sbri_bounds_node, c->model->layout.self_nodes) /* (twice that, and one a body) */
SBRI_SCRATCH_PART(self_items, uint32_t, c->model->layout.self_items)
SBRI_SCRATCH_PART(sampled, sbri_point, c->model->layout.sampled)               /* (slot_count) */
SBRI_SCRATCH_PART(sampled_deltas, sbri_delta, c->model->layout.sampled_deltas) /* (frame_count) */
SBRI_SCRATCH_PART(vertices, sbri_point, c->model->layout.vertices) /* (most vertices of a mesh, padded) */
SBRI_SCRATCH_PART(faces, sbri_point, c->model->layout.faces)       /* (most faces of a mesh, padded) */
SBRI_SCRATCH_PART(sums, sbri_point, c->model->layout.sums)         /* (most groups of a mesh, padded) */
SBRI_SCRATCH_PART(surface_vertices, sbri_point, c->model->layout.surface_vertices) /* of all bodies */
SBRI_SCRATCH_PART(surface_forces, sbri_point, c->model->layout.surface_forces)
SBRI_SCRATCH_PART(surface_velocities, sbri_point, c->model->layout.surface_velocities)
SBRI_SCRATCH_PART(surface_faces, sbri_point, c->model->layout.surface_faces) /* of all bodies */
/* Of a change of rungs: the state before it, what the bodies touched, and how far each point was from its
 * guide and how fast. */
SBRI_SCRATCH_PART(kept_state, unsigned char, c->model->layout.kept)             /* (state_size) */
SBRI_SCRATCH_PART(kept_touching, sbri_touching, c->model->layout.kept_touching) /* (bodies) */
SBRI_SCRATCH_PART(
    kept_rigid_touching, sbri_touching, c->model->layout.kept_rigid_touching) /* (rigid bodies) */
SBRI_SCRATCH_PART(offsets, sbri_point, c->model->layout.offsets)              /* (most slots) */
SBRI_SCRATCH_PART(speeds, sbri_point, c->model->layout.speeds)                /* likewise */
SBRI_SCRATCH_PART(fading, sbri_point, c->model->layout.fading) /* (most vertices of a mesh, padded) */
SBRI_SCRATCH_PART(energies, double, c->model->layout.energies) /* (bodies) J */
#undef SBRI_SCRATCH_PART

/* ---- core/sleep.c ---- */

void sbri_island_wake(sbri_character *c, uint32_t island);
void sbri_character_wake(sbri_character *c);

/* ---- core/rigid_parts.c ---- */

/* Every rigid body at its bone, joints whole; modes and drives as they are, or as the file has them. */
void sbri_rigid_place(sbri_character *c, bool as_in_file);
/* Rigid bodies go where the pose has gone from what their bones were at, and stop. */
void sbri_rigid_carry(sbri_character *c);
/* The origin moved by `shift`, in asset metres. */
void sbri_rigid_rebase(sbri_character *c, sbf_vec3 shift);
/* After the gait: steps what is simulated and puts the pose's bones where it has gone. */
void sbri_rigid_tick_parts(const struct sbr_world *world, sbri_character *c);
/* Where a pose has a body's own frame, asset metres. */
sbr_transform sbri_rigid_target(const sbri_character *c, const sbr_transform *pose, uint32_t body);
/* The pose with the bones where simulated bodies have them after they have gone on for `ahead_s`, and all
 * else at that share of the way from the tick's beginning to `animated`. Bones below them that have no body
 * keep what the animation has them turned and away from their parents. */
void sbri_rigid_pose(
    const sbri_character *c, const sbr_transform *animated, float share, float ahead_s, sbr_transform *pose);
/* Puts the frames that bodies have for their own where the pose has these. */
void sbri_rigid_frames_follow(const sbri_character *c, sbr_transform *pose);
bool sbri_rigid_is_simulated(const sbri_character *c, uint32_t body);
void sbri_rigid_set_drive(sbri_character *c, const sbr_rigid_drive *drive);
/* After any change to modes, drives or motion. */
void sbri_rigid_wake(sbri_character *c);
/* Whether nothing of it moves by itself. */
bool sbri_rigid_is_still(const sbri_character *c);

/* ---- core/reflex.c ---- */

void sbri_reflex_begin(sbri_character *c, const sbr_rigid_fall *fall);
/* The animation has its bodies again. */
void sbri_reflex_end(sbri_character *c);
/* Before a tick of the gait. */
void sbri_reflex_tick(const struct sbr_world *world, sbri_character *c);
/* Before a step of the rigid parts. */
void sbri_reflex_act(const sbri_character *c, const sbri_rigid_tick *tick, float step_s);

/* ---- core/frames.c ---- */

/* The frames' motion since the rest pose: of a pose, squashed as at a `share` of the tick between the last
 * `settle` and now; or all of it at that share. What it fills takes sbri_deltas_size bytes. */
size_t sbri_deltas_size(const sbr_model *model);
void sbri_deltas_make(const sbri_character *c, const sbr_transform *pose, float share, sbri_delta *deltas);
void sbri_deltas_between(const sbri_character *c, float share, sbri_delta *deltas);
/* One frame of it, not squashed. */
sbr_transform sbri_delta_of(const sbri_character *c, const sbr_transform *pose, uint32_t frame);
/* Where guides put the free points of a body (slot_end - slot_begin of them). */
void sbri_guide_places(
    const sbr_model *model, const sbri_body *body, const sbri_delta *deltas, sbri_point *places);
/* Where frames put the held points of an island, at their slots in `places`. */
void sbri_held_places(const sbri_island *island, const sbri_delta *deltas, sbri_point *places);
/* The root frame of the present state. */
sbr_transform sbri_root_place(const sbri_character *c, const sbr_ground *ground);

/* ---- core/guiding.c ---- */

/* Finds `guide_velocities` over the tick, whose length `tick_s` is in the character's own seconds, and gives
 * the island's bodies what they need not feel of it. False where what holds them has jumped: then they have
 * been carried along, as fast as it goes, and the tick is over for them. */
bool sbri_island_follow(sbri_character *c, const sbri_island *island, uint32_t index, float tick_s);
/* The velocities alone, over any part of a tick. False where what holds the bodies has jumped. */
bool sbri_guide_velocities_find(sbri_character *c, const sbri_island *island, float tick_s);
/* The island goes on as what holds it went from `previous_deltas` to `deltas`. */
void sbri_guides_go_on(sbri_character *c, const sbri_island *island, float tick_s);
/* As if what holds it had stood in the last tick; whether it did. */
void sbri_guides_stop(sbri_character *c, const sbri_island *island);
bool sbri_guides_rest(const sbri_character *c, const sbri_island *island);

/* ---- core/split.c ---- */

#define SBRI_UNUSED UINT32_MAX

/* The island with what its state has in place of the model's: masses, and tetrahedra. */
sbri_island sbri_island_now(const sbri_character *c, const sbri_island *island);
/* Nothing torn, no point split. */
void sbri_unsplit(sbri_character *c);
/* Splits the points of what has torn in this tick; returns how many it had no room for. */
uint32_t sbri_island_split(sbri_character *c, uint32_t island);
/* Gives points that have split what their origins have, and unused ones what the body's first has: for tables
 * of the body's slots that are made by the model's. */
void sbri_follow_origins(const sbri_character *c, const sbri_body *body, sbri_point *places);

/* ---- core/torn_skin.c ---- */

/* A skin as the character has it: with cells of its own where it may tear. */
sbri_skin sbri_skin_now(const sbri_character *c, const sbri_skin *skin);
void sbri_skins_mend(sbri_character *c);
/* After elements of the island have torn and its points have split. Skins belong to no one island: not for
 * tasks. */
void sbri_skins_follow(sbri_character *c, uint32_t island);

/* ---- core/placing.c ---- */

/* Everything in its rest shape at the present pose, all speeds zero. */
void sbri_place_at_rest(sbri_character *c);
/* All elements whole again, with the rest shapes they were made with. */
void sbri_mend(sbri_character *c);
/* Rest shapes of one island's elements as they were made; torn ones stay torn. */
void sbri_island_unflow(sbri_character *c, uint32_t island);
/* The same for one island, with the present `deltas`. */
void sbri_island_place_at_rest(sbri_character *c, uint32_t island);
/* The same, but bodies that nothing holds stay where they are: the middle of each where it was, or above the
 * ground if that reaches higher. */
void sbri_island_place_where_it_is(sbri_character *c, uint32_t island, const sbr_ground *ground);
/* An island goes where its frames have gone from `previous_deltas` to `deltas`, keeping its shape, and stops.
 */
void sbri_island_carry(sbri_character *c, uint32_t island);
/* The tick before becomes the same as this one. */
void sbri_settle(sbri_character *c);

#endif
