/* Rigid bodies and the joints between them. Part of sbfmt/model.h, which documents the common conventions.
 *
 * Made from spec/sbf.schema by spec/generate/generate.py: change the schema, not this file. */
#ifndef SBFMT_MODEL_RIGID_H
#define SBFMT_MODEL_RIGID_H

#include "sbfmt/model_mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

// clang-format off

/* Values of body_motion; sbf_body_motion_name returns their names in files. */
typedef enum sbf_body_motion {
  SBF_BODY_MOTION_KINEMATIC = 0,
  SBF_BODY_MOTION_DYNAMIC = 1,
  SBF_BODY_MOTION_COUNT = 2
} sbf_body_motion;

/* Values of joint_kind; sbf_joint_kind_name returns their names in files. */
typedef enum sbf_joint_kind {
  SBF_JOINT_KIND_PRISMATIC = 0,
  SBF_JOINT_KIND_REVOLUTE = 1,
  SBF_JOINT_KIND_CYLINDRICAL = 2,
  SBF_JOINT_KIND_SPHERICAL = 3,
  SBF_JOINT_KIND_POINT_ON_LINE = 4,
  SBF_JOINT_KIND_POINT_IN_PLANE = 5,
  SBF_JOINT_KIND_DISTANCE = 6,
  SBF_JOINT_KIND_PULLEY = 7,
  SBF_JOINT_KIND_FIXED = 8,
  SBF_JOINT_KIND_SIX_DOF = 9,
  SBF_JOINT_KIND_COUNT = 10
} sbf_joint_kind;

/* Values of joint_axis; sbf_joint_axis_name returns their names in files. */
typedef enum sbf_joint_axis {
  SBF_JOINT_AXIS_LINEAR_X = 0,
  SBF_JOINT_AXIS_LINEAR_Y = 1,
  SBF_JOINT_AXIS_LINEAR_Z = 2,
  SBF_JOINT_AXIS_TWIST = 3,
  SBF_JOINT_AXIS_SWING_Y = 4,
  SBF_JOINT_AXIS_SWING_Z = 5,
  SBF_JOINT_AXIS_SWING = 6,
  SBF_JOINT_AXIS_DISTANCE = 7,
  SBF_JOINT_AXIS_COUNT = 8
} sbf_joint_axis;

/* A rigid body. Its frame has its origin at `center` and, at rest, the axes of asset space. */
typedef struct sbf_rigid_body {
  const char *id;                /* Identity. */
  const char *name;              /* Name for people. */
  int32_t bone;                  /* Bone. [index into asset.bones, or SBF_NONE] */
  int32_t derived;               /* Derivation, if `build` made it. [index into asset.derivations, or SBF_NONE] */
  bool proposed;                 /* Guessed from the rig, for a person to confirm. [default false] */
  sbf_body_motion motion;        /* kinematic: follows its bone; dynamic: simulated. [default kinematic] */
  float mass;                    /* Mass; 0: density times the hull's volume. [kg; [0, inf)] */
  float density;                 /* Density of the hull, if no mass is given. [kg/m^3; (0, inf); default 1000] */
  sbf_vec3 center;               /* Origin of the frame, asset space, rest pose; the center of mass if inertia is given,
                                  * else that is the hull's. [m] */
  sbf_vec3 inertia;              /* Principal moments about the center; all 0: those of the hull. [kg*m^2; [0, inf)] */
  sbf_quat inertia_rotation;     /* Rotation from the principal axes to asset space. */
  float friction;                /* Coulomb friction coefficient. [[0, inf); default 0.5] */
  float restitution;             /* Fraction of normal speed returned. [[0, 1]; default 0] */
  float gravity_scale;           /* Factor on gravity. [default 1] */
  uint32_t layer;                /* Collision layer bits. [default 1] */
  uint32_t mask;                 /* Layers it collides with. [default 4294967295] */
  const sbf_polygon_mesh *hull;  /* Convex shape, asset space, rest pose. */
  int32_t hull_derived;          /* Derivation of the hull, if `build` made it.
                                  * [index into asset.derivations, or SBF_NONE] */
  sbf_vec3 velocity;             /* Initial velocity of a dynamic body's center of mass, in asset space; it turns with
                                  * the root frame. [m/s] */
  sbf_vec3 angular_velocity;     /* Initial angular velocity of a dynamic body, in the same space. [rad/s] */
} sbf_rigid_body;
typedef struct sbf_rigid_body_list { const sbf_rigid_body *at; uint32_t count; } sbf_rigid_body_list;

/* A position and an orientation. */
typedef struct sbf_frame {
  sbf_vec3 position;  /* Origin. [m] */
  sbf_quat rotation;  /* Orientation. */
} sbf_frame;
typedef struct sbf_frame_list { const sbf_frame *at; uint32_t count; } sbf_frame_list;

/* Limits of one motion of a joint; soft if stiffness is given. */
typedef struct sbf_limit {
  sbf_joint_axis target;  /* Motion: metres for linear ones and distance, radians for the rest. */
  float min;              /* Minimum. */
  float max;              /* Maximum; for `swing` the cone's half angle, with min 0. */
  float stiffness;        /* Stiffness of the limit, N/m or N*m/rad; 0: hard. [[0, inf)] */
  float damping;          /* Damping of the limit, N*s/m or N*m*s/rad. [[0, inf)] */
  float restitution;      /* Restitution of a hard limit. [[0, 1]] */
} sbf_limit;
typedef struct sbf_limit_list { const sbf_limit *at; uint32_t count; } sbf_limit_list;

/* A motor on one motion of a joint. */
typedef struct sbf_drive {
  sbf_joint_axis target;  /* Motion. */
  float position;         /* Target position, m or rad. */
  float velocity;         /* Target velocity, m/s or rad/s. */
  float stiffness;        /* N/m or N*m/rad. [[0, inf)] */
  float damping;          /* N*s/m or N*m*s/rad. [[0, inf)] */
  float maximum;          /* Maximum force in N or torque in N*m; 0: unlimited. [[0, inf)] */
} sbf_drive;
typedef struct sbf_drive_list { const sbf_drive *at; uint32_t count; } sbf_drive_list;

/* Connects two rigid bodies. Frames are local to their body; +X is the twist axis. */
typedef struct sbf_joint {
  const char *id;         /* Identity. */
  const char *name;       /* Name for people. */
  sbf_joint_kind kind;    /* Free motions; numbers 0 to 9 in this order. */
  int32_t body_a;         /* First body; absent: the world. [index into asset.rigid_bodies, or SBF_NONE] */
  int32_t body_b;         /* Second body. [index into asset.rigid_bodies, or SBF_NONE] */
  sbf_frame frame_a;      /* The joint's frame in body a. */
  sbf_frame frame_b;      /* The joint's frame in body b. */
  bool proposed;          /* Guessed from the rig, for a person to confirm. [default false] */
  bool collide;           /* The two bodies collide with each other. [default false] */
  sbf_limit_list limits;  /* Limits of free motions. */
  sbf_drive_list drives;  /* Motors. */
  sbf_vec3 pulley_a;      /* Pulley: support of body a's rope, asset space, fixed in the world at placement. [m] */
  sbf_vec3 pulley_b;      /* Pulley: support of body b's rope, in the same way. [m] */
  float pulley_ratio;     /* Pulley: factor of the rope on side b. [(0, inf); default 1] */
  float break_force;      /* Breaking value; 0: never. [N; [0, inf)] */
  float break_torque;     /* Breaking value; 0: never. [N*m; [0, inf)] */
  int32_t derived;        /* Derivation, if `build` made it. [index into asset.derivations, or SBF_NONE] */
} sbf_joint;
typedef struct sbf_joint_list { const sbf_joint *at; uint32_t count; } sbf_joint_list;

/* Sets every field to its default, lists to empty, references to SBF_NONE. */
SBF_API void sbf_rigid_body_init(sbf_rigid_body *rigid_body);
SBF_API void sbf_frame_init(sbf_frame *frame);
SBF_API void sbf_limit_init(sbf_limit *limit);
SBF_API void sbf_drive_init(sbf_drive *drive);
SBF_API void sbf_joint_init(sbf_joint *joint);

/* The name of a value in files, or "?" if it is out of range. */
SBF_API const char *sbf_body_motion_name(sbf_body_motion value);
SBF_API const char *sbf_joint_kind_name(sbf_joint_kind value);
SBF_API const char *sbf_joint_axis_name(sbf_joint_axis value);

// clang-format on

#ifdef __cplusplus
}
#endif
#endif
