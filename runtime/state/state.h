/* A character: settings, one block of state (copied by snapshots, covered by the state hash), and scratch
 * memory without content between calls. */
#ifndef SBRI_STATE_H
#define SBRI_STATE_H

#include "animation/gait/gait.h"
#include "math/follower.h"
#include "model/delta.h"
#include "model/island_tick.h"
#include "model/runtime_model.h"
#include "rigid/rigid_state.h"
#include "shapes/bounds_tree.h"
#include "shapes/contact_reports.h"

enum {
  SBRI_TICK_EVENTS = 2 * SBRI_MAX_LEGS + 1
}; /* a lift-off and a landing per foot, and one landing of the character */

/* State of a polygon. */
enum { SBRI_POLYGON_TORN = 1 };

/* Begins the state block. Has no padding, because the hash reads it as words. */
typedef struct sbri_character_state {
  sbr_double3 origin;            /* world position of the character's origin, m */
  float forward, sideways, turn; /* commanded motion */
  uint32_t paused;
  uint32_t asleep; /* 1: does not change until a call or the ground does */
  /* Present detail level, the one of the next tick, and 1 + the one set by the host (0: automatic). */
  uint32_t detail_level, next_detail_level, set_detail_level_plus_1;
  uint32_t detail_level_ticks;      /* ticks since the level changed; UINT32_MAX: not displayed since */
  uint32_t fade_ticks, fades_ticks; /* remaining ticks of the transition and their total; 0: none */
  float fade, fade_before; /* weight of `faded` in the displayed vertices, now and in the previous tick */
  uint32_t visibility;     /* sbr_visibility */
  uint32_t unseen_ticks;   /* ticks outside all views */
  uint32_t fade_kept;      /* changes level in the next tick; its vertices are stored until then */
  uint32_t swing_ticks;    /* ticks for which a change has been delayed because it swings */
  float up;                /* commanded vertical speed, m/s */
  sbf_vec3 displacement;   /* displacement by the host in the next tick, m */
  float rotation;          /* rotation by the host in the next tick, rad */
} sbri_character_state;

typedef struct sbri_island_state {
  float stretch; /* maximum stretch of a spring in the last substep, as a fraction beyond its rest length */
  float stiffening; /* maximum stiffness of a tetrahedron in the last substep relative to rest */
  float min_ratio;  /* minimum J of the tetrahedra in the last substep; below 0: inverted; 1: no tetrahedra */
  float max_flow_stretch;   /* maximum g.g of a yielded rest shape relative to the original one */
  uint32_t collapsed_ticks; /* ticks with almost no volume or with inverted elements */
  uint32_t unstable;        /* ticks with an unstable shape (soft/collapsed.c) */
  float excess_j;           /* excess energy in them, J; 0: not measured */
  uint32_t damping_ticks;   /* remaining ticks of extra damping */
  uint32_t recoveries;
  uint32_t unsplit; /* points that could not split for lack of spare slots */
  sbri_recovery recovery;
  uint32_t asleep;          /* 1: not stepped */
  uint32_t reported_asleep; /* value of `asleep` last reported to the host */
  uint32_t idle_ticks;      /* ticks below the sleep speed */
  uint32_t ground_mark;     /* version of the ground below a sleeping island */
  uint32_t element_visits;  /* element visits since its creation */
} sbri_island_state;

/* Rigid motion of a body's drivers in the last tick; of a body without pins, its own rigid motion when it was
 * last sound. */
typedef struct sbri_driver_motion {
  sbf_vec3 velocity, angular_velocity; /* velocity of its centre, m/s; rad/s */
} sbri_driver_motion;

/* A vertex of the previous detail level during a transition, asset metres: it continues as a mass on a
 * spring. Positions are relative to the vertex as posed by bones alone or, without bones, as posed by
 * the new level. */
typedef struct sbri_fading_vertex {
  sbf_vec3 position, was; /* now and in the previous tick */
  sbf_vec3 still;         /* its equilibrium */
  sbf_vec3 kept;          /* while a transition begins: displayed position two ticks before it */
} sbri_fading_vertex;

/* Memory of a character at one detail level: state and scratch, as the model's layout divides them. */
typedef struct sbri_character_storage {
  const sbr_model *model; /* NULL: not allocated */
  unsigned char *state, *scratch;
} sbri_character_storage;

typedef struct sbri_character {
  const sbr_model *model; /* of its detail level; NULL: free entry */
  uint32_t generation;
  bool hold;
  bool near; /* other characters are near enough for contact in this tick */
  float scale;
  float time_scale;  /* 1 / sqrt(scale): its own seconds per world second */
  sbr_ground ground; /* ground that it stands on */
  unsigned char *state, *scratch;
  sbri_character_storage spare; /* of its previous or next detail level */
  uint32_t spare_ticks;         /* ticks for which it has not been needed */
  void *rigid_work; /* (rigid_work_size) work memory of the rigid body solver; NULL: no simulated bodies */
  uint32_t rigid_ticks;              /* ticks without simulated bodies */
  uint32_t refused_ticks;            /* ticks until a failed allocation is retried */
  uint64_t sampled_at;               /* stamp of the time that `sampled` belongs to; 0: none */
  void *user_data;                   /* the host's */
  void **body_user_data;             /* (soft bodies, then rigid bodies of the asset) the host's */
  uint32_t left_detail_level_plus_1; /* in the last tick; 0: it did not change */
  uint32_t event_count;              /* of the last tick */
  sbri_gait_event events[SBRI_TICK_EVENTS];
} sbri_character;

/* ---- state/character_storage.c ---- */

/* Size of the storage of a model, bytes. */
size_t sbri_character_storage_size(const sbr_model *model);
/* Allocates uninitialised storage for the model; false if memory runs out. */
bool sbri_character_storage_create(
    const sbf_allocator *allocator, const sbr_model *model, sbri_character_storage *storage);
void sbri_character_storage_free(const sbf_allocator *allocator, sbri_character_storage *storage);
void sbri_rigid_work_free(const sbf_allocator *allocator, sbri_character *c);
/* Exchanges the character's storage and its spare one; the new one is zeroed. */
void sbri_character_storage_swap(sbri_character *c);

/* ---- state/layout.c ---- */

/* Computes the layouts of a model and all its detail levels. */
void sbri_layouts_make(sbr_model *model);
/* Size of the deltas of all frames (state/pose/frames.h), bytes. */
size_t sbri_deltas_size(const sbr_model *model);

static inline sbri_character_state *sbri_header(const sbri_character *c) {
  return (sbri_character_state *)(void *)c->state;
}

#define SBRI_STATE_PART(name, type, offset)                                                                  \
  static inline type *sbri_##name(const sbri_character *c) {                                                 \
    return (type *)(void *)(c->state + c->model->layout.offset);                                             \
  }
SBRI_STATE_PART(loads, sbri_load, loads) /* (SBR_LOAD_CAPACITY) */
SBRI_STATE_PART(gait, void, pose.gait)
SBRI_STATE_PART(pose, sbr_transform, pose.current)                         /* (frame_count) */
SBRI_STATE_PART(previous_pose, sbr_transform, pose.previous)               /* (frame_count) */
SBRI_STATE_PART(island_states, sbri_island_state, islands)                 /* (island_count) */
SBRI_STATE_PART(positions, sbri_point, points.positions)                   /* (slot_count) */
SBRI_STATE_PART(previous_positions, sbri_point, points.previous_positions) /* (slot_count) */
SBRI_STATE_PART(velocities, float, points.velocities)                      /* (slot_count x 3) */
SBRI_STATE_PART(driver_motions, sbri_driver_motion, pose.driver_motions)   /* (bodies) */
SBRI_STATE_PART(rests, float, springs.rests)                   /* (counts.flows) m, rest lengths */
SBRI_STATE_PART(strengths, float, springs.strengths)           /* (counts.flows) 1, or 0 where torn */
SBRI_STATE_PART(rotations, float, solids.rotations)            /* (counts.region_blocks x 4 x 8) */
SBRI_STATE_PART(solids, sbri_tetrahedron_block, solids.blocks) /* (counts.state_tetrahedron_blocks) */
SBRI_STATE_PART(torn, uint32_t, solids.torn)                   /* (counts.state_tetrahedra) sbri_torn_state */
/* Only in models whose elements may tear: the origin of each slot (SBRI_UNUSED for a spare slot), its mass;
 * cells of skins, the tetrahedron that each binding is embedded in, and the state of each polygon. */
SBRI_STATE_PART(origins, uint32_t, split.origins)            /* (slot_count) */
SBRI_STATE_PART(masses, float, split.masses)                 /* (slot_count) kg */
SBRI_STATE_PART(inverse_masses, float, split.inverse_masses) /* (slot_count) 1/kg */
SBRI_STATE_PART(gravity_scales, float, split.gravity_scales) /* (slot_count) */
/* Only in islands whose springs may tear, in the model's layout plus split points: number of used cells per
 * block, cells, their damping and links, and the links. */
SBRI_STATE_PART(thread_ends, uint32_t, springs.ends)                /* (counts.torn_blocks) */
SBRI_STATE_PART(thread_cells, sbri_spring_cell, springs.cells)      /* (counts.torn_cells) */
SBRI_STATE_PART(thread_damping, float, springs.damping)             /* (counts.torn_cells x 8) */
SBRI_STATE_PART(thread_slack, float, springs.slack)                 /* (counts.torn_cells x 8) */
SBRI_STATE_PART(thread_links, uint32_t, springs.links)              /* (counts.torn_cells x 8) */
SBRI_STATE_PART(thread_blocks, sbri_link_block, springs.blocks)     /* (counts.torn_link_blocks) */
SBRI_STATE_PART(skin_cells, sbri_volume_cell, split.skin_cells)     /* (counts.skin_cells) */
SBRI_STATE_PART(bound_to, uint32_t, split.bound_to)                 /* (counts.bindings) */
SBRI_STATE_PART(torn_polygons, uint32_t, split.polygons)            /* (counts.polygons) */
SBRI_STATE_PART(rigid_bodies, sbri_rigid_body_state, rigid.bodies)  /* (rigid bodies) */
SBRI_STATE_PART(rigid_joints, sbri_rigid_joint_state, rigid.joints) /* (joints) */
SBRI_STATE_PART(rigid_drive, sbri_rigid_drive_state, rigid.drive)
SBRI_STATE_PART(rigid_kept, sbri_stored_contact, rigid.stored_contacts) /* (sbri_rigid_contact_capacity) */
SBRI_STATE_PART(faded, sbri_fading_vertex, detail.faded)                /* (vertices of all render meshes) */
SBRI_STATE_PART(jiggles, sbri_position_follower, pose.jiggles)          /* (jiggle_count) asset metres */
#undef SBRI_STATE_PART

#define SBRI_SCRATCH_PART(name, type, offset)                                                                \
  static inline type *sbri_##name(const sbri_character *c) {                                                 \
    return (type *)(void *)(c->scratch + c->model->layout.offset);                                           \
  }
SBRI_SCRATCH_PART(deltas, sbri_delta, pose.deltas)                   /* (frame_count) */
SBRI_SCRATCH_PART(previous_deltas, sbri_delta, pose.previous_deltas) /* (frame_count) */
SBRI_SCRATCH_PART(animated, sbr_transform, pose.animated)      /* (frame_count) pose before rigid parts */
SBRI_SCRATCH_PART(rigid_targets, sbr_transform, rigid.targets) /* (rigid bodies) */
SBRI_SCRATCH_PART(reactions, sbri_reaction, rigid.reactions)   /* (rigid bodies) */
SBRI_SCRATCH_PART(attached_loads, sbri_attached_load, rigid.attached_loads) /* (rigid bodies) */
SBRI_SCRATCH_PART(stepped_pose, sbr_transform, pose.stepped)                /* (frame_count) in a tick */
SBRI_SCRATCH_PART(gait_before, void, pose.gait_before)
SBRI_SCRATCH_PART(targets, sbri_point, points.targets)                 /* (slot_count) */
SBRI_SCRATCH_PART(driver_velocities, float, points.driver_velocities)  /* (slot_count x 3) */
SBRI_SCRATCH_PART(begins, sbri_point, points.begins)                   /* (slot_count) */
SBRI_SCRATCH_PART(velocity_points, sbri_point, points.velocity_points) /* (slot_count) */
SBRI_SCRATCH_PART(external_forces, sbri_point, points.external_forces) /* (slot_count) */
SBRI_SCRATCH_PART(accelerations, float, points.accelerations)          /* (slot_count x 3) */
SBRI_SCRATCH_PART(older_velocities, float, points.older_velocities)    /* (slot_count x 3) */
SBRI_SCRATCH_PART(moves, sbri_point, points.moves)                     /* (slot_count) */
SBRI_SCRATCH_PART(edges, float, springs.edges)                         /* (counts.link_blocks x 24) */
SBRI_SCRATCH_PART(solid_edges, float, solids.edges)                    /* (counts.tetrahedron_blocks x 72) */
SBRI_SCRATCH_PART(compressed_blocks, uint8_t, solids.compressed)       /* (counts.tetrahedron_blocks) */
SBRI_SCRATCH_PART(tears_of, sbri_tears, solids.tears)                  /* (island_count) */
SBRI_SCRATCH_PART(element_forces, sbri_point, points.element_forces) /* (slot_count + counts.force_entries) */
SBRI_SCRATCH_PART(loads_now, sbri_loads_now_list, loads_now)         /* of this tick */
SBRI_SCRATCH_PART(visits, uint32_t, solids.visits)                   /* (counts.state_tetrahedra x 2) */
SBRI_SCRATCH_PART(queue, uint32_t, solids.queue)                     /* (counts.state_tetrahedra) */
SBRI_SCRATCH_PART(touched, uint8_t, split.touched)                   /* (counts.bindings) */
SBRI_SCRATCH_PART(owners, uint32_t, springs.owners) /* (slot_count x 2) where springs may tear */
SBRI_SCRATCH_PART(
    torn_ends, uint8_t, springs.torn) /* (slot_count) where springs may tear: near a torn spring */
SBRI_SCRATCH_PART(planes, float, contacts.planes)                        /* (slot_count x 4) */
SBRI_SCRATCH_PART(ground_pressing, float, contacts.pressing)             /* (slot_count x 2) */
SBRI_SCRATCH_PART(near_ground, uint8_t, contacts.near_ground)            /* (slot_count / 8) */
SBRI_SCRATCH_PART(contacts, sbri_soft_contact, contacts.at)              /* (samples of all bodies) */
SBRI_SCRATCH_PART(contact_counts, uint32_t, contacts.counts)             /* (bodies) */
SBRI_SCRATCH_PART(contact_blocks, sbri_contact_block, contacts.blocks)   /* (contacts / 8) */
SBRI_SCRATCH_PART(contact_block_counts, uint32_t, contacts.block_counts) /* (bodies) */
SBRI_SCRATCH_PART(contact_slots, uint8_t, contacts.slots)                /* (slot_count / 8) */
/* (island_count) 1: in contact with bodies of characters in this tick; unset without such contacts */
SBRI_SCRATCH_PART(contact_islands, uint8_t, contacts.islands)
SBRI_SCRATCH_PART(external_bodies_of, struct sbri_external_bodies, contacts.external_bodies) /* (bodies) */
SBRI_SCRATCH_PART(contact_weights, float, contacts.weights)                 /* (slot_count) */
SBRI_SCRATCH_PART(contacts_of_points, sbri_point_contacts, contacts.points) /* (slot_count) */
SBRI_SCRATCH_PART(slot_contacts, uint8_t, contacts.slot_contacts)           /* (slot_count) */
SBRI_SCRATCH_PART(soft_touching, sbri_contact_reports, contacts.touching)   /* (bodies) */
SBRI_SCRATCH_PART(rigid_touching, sbri_contact_reports, rigid.touching)     /* (rigid bodies) */
SBRI_SCRATCH_PART(self_boxes, sbri_box, self.boxes) /* (triangles of bodies with self-contact) */
SBRI_SCRATCH_PART(self_balls, sbri_moving_ball, self.balls)
SBRI_SCRATCH_PART(self_nodes, sbri_bounds_node, self.nodes) /* (twice that, and one per body) */
SBRI_SCRATCH_PART(self_items, uint32_t, self.items)
SBRI_SCRATCH_PART(self_edges, uint8_t, self.edges)
SBRI_SCRATCH_PART(sampled, sbri_point, points.sampled)             /* (slot_count) */
SBRI_SCRATCH_PART(sampled_deltas, sbri_delta, pose.sampled_deltas) /* (frame_count) */
SBRI_SCRATCH_PART(vertices, sbri_point, skin.vertices)             /* (maximum vertices of a mesh, padded) */
SBRI_SCRATCH_PART(faces, sbri_point, skin.faces)                   /* (maximum faces of a mesh, padded) */
SBRI_SCRATCH_PART(sums, sbri_point, skin.sums)                     /* (maximum groups of a mesh, padded) */
SBRI_SCRATCH_PART(surface_vertices, sbri_point, surfaces.vertices) /* of all bodies */
SBRI_SCRATCH_PART(surface_forces, sbri_point, surfaces.forces)
SBRI_SCRATCH_PART(surface_velocities, sbri_point, surfaces.velocities)
SBRI_SCRATCH_PART(surface_faces, sbri_point, surfaces.faces) /* of all bodies */
/* Of the previous detail level during a transition: offset and speed of each point relative to its driver. */
SBRI_SCRATCH_PART(offsets, sbri_point, detail.offsets) /* (slot_count) */
SBRI_SCRATCH_PART(speeds, sbri_point, detail.speeds)   /* (slot_count) */
SBRI_SCRATCH_PART(fading, sbri_point, detail.fading)   /* (maximum vertices of a mesh, padded) */
SBRI_SCRATCH_PART(pulls, float, detail.pulls)          /* (bodies + 1) */
SBRI_SCRATCH_PART(energies, double, detail.energies)   /* (bodies) J */
#undef SBRI_SCRATCH_PART

/* Factor from a host's impulse to the character's own units. Masses scale with scale^3, times and speeds with
 * sqrt(scale). */
static inline float sbri_own_impulse(const sbri_character *c) {
  return c->time_scale / (c->scale * c->scale * c->scale);
}

static inline void sbri_island_wake(sbri_character *c, uint32_t island) {
  sbri_island_state *state = &sbri_island_states(c)[island];
  state->asleep = 0;
  state->idle_ticks = 0;
}
static inline void sbri_character_wake(sbri_character *c) {
  sbri_header(c)->asleep = 0;
}

/* ---- state/present.c ---- */

#define SBRI_UNUSED UINT32_MAX

/* Returns the island with present masses and tetrahedra from the state. */
sbri_island sbri_island_now(const sbri_character *c, const sbri_island *island);
/* Copies to split points the values of their origins, and to unused slots those of the body's first slot, in
 * tables that are indexed by slots. */
void sbri_follow_origins(const sbri_character *c, const sbri_body *body, sbri_point *positions);
/* Returns a skin with the character's own cells if it may tear. */
sbri_skin sbri_skin_now(const sbri_character *c, const sbri_skin *skin);

#endif
