/* Rigid parts as the runtime uses them: constant tables of an asset, shared by all characters of a model.
 *
 * A body's own frame, here, has its origin in the centre of mass and its axes along the principal moments.
 * Lengths are asset metres. Which bodies are simulated is each character's choice (rigid_state.h); the tables
 * are the same for all. */
#ifndef SBRI_RIGID_MODEL_H
#define SBRI_RIGID_MODEL_H

#include "base/memory.h"
#include "collide/hull.h"
#include "math/quat.h"
#include "sbfmt/model.h"

typedef struct sbri_rigid_body {
  const sbf_rigid_body *source;
  float mass, inverse_mass;            /* 0 and 0: it weighs nothing and cannot be simulated */
  sbf_vec3 inertia, inverse_inertia;   /* principal moments, kg m^2 */
  sbf_vec3 center;                     /* at rest, asset space */
  sbf_quat axes;                       /* at rest, from the body's own frame to asset space */
  const sbf_vec3 *vertices;            /* (vertex_count) of the hull, own frame */
  uint32_t vertex_count, first_vertex; /* among those of all bodies */
  sbri_hull hull;                      /* the same with its faces; without a hull none */
  float radius;                        /* of the ball about the centre of mass that holds the hull */
  uint32_t joint_begin, joint_end;     /* into joints_of */
} sbri_rigid_body;

/* A frame in a body's own frame; in the anchor frame where there is no body. */
typedef struct sbri_rigid_frame {
  sbf_vec3 at;
  sbf_quat axes;
} sbri_rigid_frame;

enum { SBRI_A, SBRI_B, SBRI_SIDES };

typedef struct sbri_rigid_joint {
  const sbf_joint *source;
  int32_t bodies[SBRI_SIDES]; /* -1: the world */
  sbri_rigid_frame frames[SBRI_SIDES];
  unsigned locked;       /* bits of the coordinates that the kind holds at 0 */
  float rest_distance;   /* of the kinds distance and pulley, m */
  uint32_t row_capacity; /* that it may need */
  uint32_t first_row;    /* among those of all joints */
  size_t first_square;   /* of its row_capacity^2 numbers among those of all joints */
  float reach_inertia;   /* kg m^2 about the joint of what hangs on it: for drives that track a pose */
  float hold_torque;     /* N m that hold what hangs on it out level, in the earth's gravity */
} sbri_rigid_joint;

/* Flesh that hangs on one body and on nothing else. */
typedef struct sbri_attached_mass {
  bool bearable;     /* all that hangs on it has answers (sbri_attached_responses) */
  double mass[6][6]; /* what these add to the body's masses and moments, about its centre, axes of rest */
} sbri_attached_mass;

typedef struct sbri_rigid_model {
  const sbri_rigid_body *bodies;
  uint32_t body_count;
  const sbri_rigid_joint *joints;
  uint32_t joint_count;
  const uint32_t *joints_of;   /* of each body, body after body */
  const uint32_t *by_strength; /* (joint_count) those that hold most first: which a tree is made of first */
  const int32_t *body_of_bone; /* (bones) the first body that moves with it; -1: none */
  const uint32_t *own_frames;  /* (body_count) of bodies with mass that are no bone's such: their number among
                                  these; else UINT32_MAX */
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
