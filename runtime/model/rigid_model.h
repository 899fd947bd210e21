/* Rigid parts: constant tables of an asset, shared by all characters of a model.
 *
 * The frame of a body has its origin in the centre of mass and its axes along the principal moments. Lengths
 * are asset metres. Which bodies are simulated may differ between characters (rigid_state.h); the tables are
 * the same for all. */
#ifndef SBRI_RIGID_MODEL_H
#define SBRI_RIGID_MODEL_H

#include "base/memory.h"
#include "math/quat.h"
#include "sbfmt/model.h"
#include "shapes/hull.h"

typedef struct sbri_rigid_body {
  const sbf_rigid_body *source;
  float mass, inverse_mass;            /* both 0: no mass, so it cannot be simulated */
  sbf_vec3 inertia, inverse_inertia;   /* principal moments, kg m^2 */
  sbf_vec3 center;                     /* at rest, asset space */
  sbf_quat axes;                       /* at rest, from the body's frame to asset space */
  const sbf_vec3 *vertices;            /* (vertex_count) of the hull, in the body's frame */
  uint32_t vertex_count, first_vertex; /* first: in the table of all bodies */
  sbri_hull hull;                      /* the hull with its faces; empty without a hull */
  float radius; /* of the smallest sphere about the centre of mass that contains the hull */
  uint32_t joint_begin, joint_end; /* into joints_of */
} sbri_rigid_body;

/* A frame relative to the body's frame; relative to the anchor frame if there is no body. */
typedef struct sbri_rigid_frame {
  sbf_vec3 at;
  sbf_quat axes;
} sbri_rigid_frame;

enum { SBRI_A, SBRI_B, SBRI_SIDES };

typedef struct sbri_rigid_joint {
  const sbf_joint *source;
  int32_t bodies[SBRI_SIDES]; /* -1: the world */
  sbri_rigid_frame frames[SBRI_SIDES];
  unsigned locked;       /* bits of the coordinates that the kind locks at 0 */
  float rest_distance;   /* of the kinds distance and pulley, m */
  uint32_t row_capacity; /* maximum number of constraint rows */
  uint32_t first_row;    /* in the table of all joints */
  size_t first_square;   /* of its row_capacity^2 numbers, in the table of all joints */
  float reach_inertia; /* inertia of the attached bodies about the joint, kg m^2; for drives that track a pose
                        */
  float hold_torque;   /* torque that supports the attached bodies horizontally in earth's gravity, N m */
} sbri_rigid_joint;

/* Soft bodies that are attached to one rigid body only. */
typedef struct sbri_attached_mass {
  bool bearable;     /* all attached soft bodies have responses (sbri_attached_responses) */
  double mass[6][6]; /* what these add to the body's mass matrix, about its centre, axes of rest */
} sbri_attached_mass;

typedef struct sbri_rigid_model {
  const sbri_rigid_body *bodies;
  uint32_t body_count;
  const sbri_rigid_joint *joints;
  uint32_t joint_count;
  const uint32_t *joints_of;   /* grouped by body */
  const uint32_t *by_strength; /* (joint_count) sorted by decreasing number of locked coordinates; a spanning
                                  tree takes the first ones first */
  const int32_t *body_of_bone; /* (bones) first body that moves with the bone; -1: none */
  const uint32_t
      *own_frames; /* (body_count) index among the bodies with mass that move no bone; else UINT32_MAX */
  uint32_t own_frame_count;
  /* (body_count) rad^2/s^2: upper bound of the squared angular frequency on the attached soft bodies;
   * prepare/coupling.c */
  float *pinned_squares;
  /* (body_count) ratio of the mass, or moment of inertia, of the soft bodies damped against it to its own. */
  float *pinned_weights;
  float *attached_masses;       /* (body_count) kg of soft bodies attached to each */
  sbri_attached_mass *attached; /* (body_count) */
  uint32_t bone_count, vertex_count, row_count;
  size_t square_count;
  uint32_t loop_row_capacity; /* rows of joints that close loops; see loop_solve.h */
} sbri_rigid_model;

#endif
