/* Where the parts of a character's state and scratch memory begin, in bytes (state/layout.c,
 * state/state.h). State comes first in each group. */
#ifndef SBRI_LAYOUT_H
#define SBRI_LAYOUT_H

#include <stddef.h>

typedef struct sbri_pose_layout {
  size_t gait, current, previous, driver_motions, jiggles;
  size_t gait_before, deltas, previous_deltas, sampled_deltas, animated, stepped;
} sbri_pose_layout;

/* Arrays of all slots. */
typedef struct sbri_point_layout {
  size_t positions, previous_positions, velocities;
  size_t targets, driver_velocities, begins, velocity_points, sampled, moves;
  size_t external_forces, element_forces, accelerations, older_velocities;
} sbri_point_layout;

typedef struct sbri_spring_layout {
  size_t rests, strengths, ends, cells, damping, slack, links, blocks;
  size_t edges, owners, torn;
} sbri_spring_layout;

typedef struct sbri_solid_layout {
  size_t blocks, torn, rotations;
  size_t edges, compressed, visits, queue, tears;
} sbri_solid_layout;

/* Of models whose points may split. */
typedef struct sbri_split_layout {
  size_t origins, masses, inverse_masses, gravity_scales, skin_cells, bound_to, polygons;
  size_t touched;
} sbri_split_layout;

typedef struct sbri_rigid_layout {
  size_t bodies, joints, drive, stored_contacts;
  size_t targets, reactions, attached_loads, touching, work_size;
} sbri_rigid_layout;

typedef struct sbri_contact_layout {
  size_t planes, pressing, near_ground;
  size_t at, counts, blocks, block_counts, slots, islands, external_bodies, slot_contacts, points, weights,
      touching;
} sbri_contact_layout;

typedef struct sbri_self_contact_layout {
  size_t boxes, balls, nodes, items, edges;
} sbri_self_contact_layout;

typedef struct sbri_surface_layout {
  size_t vertices, faces, forces, velocities;
} sbri_surface_layout;

typedef struct sbri_skin_layout {
  size_t vertices, faces, sums;
} sbri_skin_layout;

/* Of models with detail levels. */
typedef struct sbri_detail_layout {
  size_t faded;
  size_t offsets, speeds, energies, fading, pulls;
} sbri_detail_layout;

typedef struct sbri_layout {
  size_t islands, loads, loads_now;
  sbri_pose_layout pose;
  sbri_point_layout points;
  sbri_spring_layout springs;
  sbri_solid_layout solids;
  sbri_split_layout split;
  sbri_rigid_layout rigid;
  sbri_contact_layout contacts;
  sbri_self_contact_layout self;
  sbri_surface_layout surfaces;
  sbri_skin_layout skin;
  sbri_detail_layout detail;
  size_t used_size, state_size, scratch_size;
} sbri_layout;

#endif
