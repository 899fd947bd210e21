/* The asset: plain read-only data, as the format defines it.
 *
 * Units are SI: metres, kilograms, seconds, newtons, pascals, radians. Right-handed, +Y up, +Z
 * forward; all positions are in asset space and in the rest pose unless they say otherwise.
 * Everything a loaded asset points at lives in it and is freed with it; it may be read by any
 * number of threads at once. Strings are UTF-8 and never NULL. References are places in a list of
 * the asset, or SBF_NONE. Square brackets give unit, range, default, and the length of a list.
 *
 * Made from spec/sbf.schema by spec/generate/generate.py: change the schema, not this file. */
#ifndef SBFMT_MODEL_H
#define SBFMT_MODEL_H

#include "sbfmt/base.h"

#ifdef __cplusplus
extern "C" {
#endif

// clang-format off

/* Of the format this library writes. */
#define SBF_FORMAT_VERSION "1.0"

/* Words of mesh_target, in the file's spelling by sbf_mesh_target_name. */
typedef enum sbf_mesh_target {
  SBF_MESH_TARGET_RENDERING = 0,
  SBF_MESH_TARGET_SURFACE = 1,
  SBF_MESH_TARGET_COLLISION_DETECTION = 2,
  SBF_MESH_TARGET_COUNT = 3
} sbf_mesh_target;

/* Words of volume_target, in the file's spelling by sbf_volume_target_name. */
typedef enum sbf_volume_target {
  SBF_VOLUME_TARGET_VOLUME = 0,
  SBF_VOLUME_TARGET_COUNT = 1
} sbf_volume_target;

/* Words of elastic_model, in the file's spelling by sbf_elastic_model_name. */
typedef enum sbf_elastic_model {
  SBF_ELASTIC_MODEL_SPRINGS = 0,
  SBF_ELASTIC_MODEL_TETRAHEDRA = 1,
  SBF_ELASTIC_MODEL_SHAPE_MATCHING = 2,
  SBF_ELASTIC_MODEL_JIGGLE = 3,
  SBF_ELASTIC_MODEL_COUNT = 4
} sbf_elastic_model;

/* Words of spring_kind, in the file's spelling by sbf_spring_kind_name. */
typedef enum sbf_spring_kind {
  SBF_SPRING_KIND_STRUCTURAL = 0,
  SBF_SPRING_KIND_SHEAR = 1,
  SBF_SPRING_KIND_FLEXION = 2,
  SBF_SPRING_KIND_INTERNAL = 3,
  SBF_SPRING_KIND_CROSS_BODY = 4,
  SBF_SPRING_KIND_COUNT = 5
} sbf_spring_kind;

/* Words of pressure_mode, in the file's spelling by sbf_pressure_mode_name. */
typedef enum sbf_pressure_mode {
  SBF_PRESSURE_MODE_NONE = 0,
  SBF_PRESSURE_MODE_GAS = 1,
  SBF_PRESSURE_MODE_VOLUME = 2,
  SBF_PRESSURE_MODE_COUNT = 3
} sbf_pressure_mode;

/* Words of body_motion, in the file's spelling by sbf_body_motion_name. */
typedef enum sbf_body_motion {
  SBF_BODY_MOTION_KINEMATIC = 0,
  SBF_BODY_MOTION_DYNAMIC = 1,
  SBF_BODY_MOTION_COUNT = 2
} sbf_body_motion;

/* Words of joint_kind, in the file's spelling by sbf_joint_kind_name. */
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

/* Words of joint_axis, in the file's spelling by sbf_joint_axis_name. */
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

/* Words of attachment_rule, in the file's spelling by sbf_attachment_rule_name. */
typedef enum sbf_attachment_rule {
  SBF_ATTACHMENT_RULE_EXPLICIT = 0,
  SBF_ATTACHMENT_RULE_INSIDE_HULL = 1,
  SBF_ATTACHMENT_RULE_COUNT = 2
} sbf_attachment_rule;

/* Words of weight_property, in the file's spelling by sbf_weight_property_name. */
typedef enum sbf_weight_property {
  SBF_WEIGHT_PROPERTY_DENSITY = 0,
  SBF_WEIGHT_PROPERTY_YOUNG_MODULUS = 1,
  SBF_WEIGHT_PROPERTY_BENDING_STIFFNESS = 2,
  SBF_WEIGHT_PROPERTY_MASS_DAMPING = 3,
  SBF_WEIGHT_PROPERTY_STIFFNESS_DAMPING = 4,
  SBF_WEIGHT_PROPERTY_FRICTION = 5,
  SBF_WEIGHT_PROPERTY_PRESSURE = 6,
  SBF_WEIGHT_PROPERTY_YIELD_STRAIN = 7,
  SBF_WEIGHT_PROPERTY_TEAR_STRAIN = 8,
  SBF_WEIGHT_PROPERTY_COUNT = 9
} sbf_weight_property;

/* Words of scheme, in the file's spelling by sbf_scheme_name. */
typedef enum sbf_scheme {
  SBF_SCHEME_AUTOMATIC = 0,
  SBF_SCHEME_SYMPLECTIC = 1,
  SBF_SCHEME_POSITION_BASED = 2,
  SBF_SCHEME_RELAXATION = 3,
  SBF_SCHEME_EXPLICIT_EULER = 4,
  SBF_SCHEME_HEUN = 5,
  SBF_SCHEME_BLOCK_DESCENT = 6,
  SBF_SCHEME_COUNT = 7
} sbf_scheme;

/* Words of ik_solver, in the file's spelling by sbf_ik_solver_name. */
typedef enum sbf_ik_solver {
  SBF_IK_SOLVER_TWO_BONE = 0,
  SBF_IK_SOLVER_CCD = 1,
  SBF_IK_SOLVER_FABRIK = 2,
  SBF_IK_SOLVER_DAMPED_LEAST_SQUARES = 3,
  SBF_IK_SOLVER_SPLINE = 4,
  SBF_IK_SOLVER_COUNT = 5
} sbf_ik_solver;

/* Words of chain_kind, in the file's spelling by sbf_chain_kind_name. */
typedef enum sbf_chain_kind {
  SBF_CHAIN_KIND_LAG = 0,
  SBF_CHAIN_KIND_DISTANCE = 1,
  SBF_CHAIN_KIND_COUNT = 2
} sbf_chain_kind;

/* Words of follower_channel, in the file's spelling by sbf_follower_channel_name. */
typedef enum sbf_follower_channel {
  SBF_FOLLOWER_CHANNEL_ROTATION = 0,
  SBF_FOLLOWER_CHANNEL_POSITION = 1,
  SBF_FOLLOWER_CHANNEL_BOTH = 2,
  SBF_FOLLOWER_CHANNEL_SQUASH = 3,
  SBF_FOLLOWER_CHANNEL_WEIGHT = 4,
  SBF_FOLLOWER_CHANNEL_COUNT = 5
} sbf_follower_channel;

/* Words of bone_axis, in the file's spelling by sbf_bone_axis_name. */
typedef enum sbf_bone_axis {
  SBF_BONE_AXIS_X = 0,
  SBF_BONE_AXIS_Y = 1,
  SBF_BONE_AXIS_Z = 2,
  SBF_BONE_AXIS_COUNT = 3
} sbf_bone_axis;

/* Words of track_property, in the file's spelling by sbf_track_property_name. */
typedef enum sbf_track_property {
  SBF_TRACK_PROPERTY_TRANSLATION = 0,
  SBF_TRACK_PROPERTY_ROTATION = 1,
  SBF_TRACK_PROPERTY_SCALE = 2,
  SBF_TRACK_PROPERTY_COUNT = 3
} sbf_track_property;

/* Words of interpolation, in the file's spelling by sbf_interpolation_name. */
typedef enum sbf_interpolation {
  SBF_INTERPOLATION_LINEAR = 0,
  SBF_INTERPOLATION_STEP = 1,
  SBF_INTERPOLATION_CUBIC = 2,
  SBF_INTERPOLATION_COUNT = 3
} sbf_interpolation;

/* Words of field_kind, in the file's spelling by sbf_field_kind_name. */
typedef enum sbf_field_kind {
  SBF_FIELD_KIND_UNIFORM = 0,
  SBF_FIELD_KIND_RADIAL = 1,
  SBF_FIELD_KIND_VORTEX = 2,
  SBF_FIELD_KIND_DRAG = 3,
  SBF_FIELD_KIND_COUNT = 4
} sbf_field_kind;

/* Words of alpha_mode, in the file's spelling by sbf_alpha_mode_name. */
typedef enum sbf_alpha_mode {
  SBF_ALPHA_MODE_OPAQUE = 0,
  SBF_ALPHA_MODE_MASK = 1,
  SBF_ALPHA_MODE_BLEND = 2,
  SBF_ALPHA_MODE_COUNT = 3
} sbf_alpha_mode;

/* One of the people who made the asset. */
typedef struct sbf_author {
  /* Name. */
  const char *name;
  /* Mail address or page. */
  const char *contact;
} sbf_author;
typedef struct sbf_author_list {
  const sbf_author *at;
  uint32_t count;
} sbf_author_list;

/* A file the source parts were read from. */
typedef struct sbf_source {
  /* Path or name as it was given, without the folders of the machine. */
  const char *path;
  /* SHA-256 of its bytes, 64 hexadecimal digits. */
  const char *sha256;
} sbf_source;
typedef struct sbf_source_list {
  const sbf_source *at;
  uint32_t count;
} sbf_source_list;

/* What the asset is and where it comes from. */
typedef struct sbf_info {
  /* A name for people. */
  const char *title;
  /* Licence, as an SPDX expression where there is one. */
  const char *licence;
  /* Who holds the rights. */
  const char *copyright;
  /* Program and version that wrote the source parts. */
  const char *tool;
  /* Anything else for people. */
  const char *comment;
  /* Who made it. */
  sbf_author_list authors;
  /* Files the source parts were read from. */
  sbf_source_list sources;
  /* Of all soft bodies together, where no derivation states it. [kg; [0, inf)] */
  float mass;
  /* Least coordinates of all render meshes and surfaces, where no derivation states them. [m] */
  sbf_vec3 low;
  /* Greatest coordinates; equal to `low`: not stated. [m] */
  sbf_vec3 high;
} sbf_info;
typedef struct sbf_info_list {
  const sbf_info *at;
  uint32_t count;
} sbf_info_list;

/* One run of a build pass: parts that name it are derived and can be made again. */
typedef struct sbf_derivation {
  /* Identity. */
  const char *id;
  /* Program and version that computed. */
  const char *tool;
  /* Settings as `name=value` separated by spaces, in alphabetical order. */
  const char *settings;
  /* SHA-256 of the canonical XML of the parts that were read, 64 hexadecimal digits. */
  const char *source_hash;
  /* Of all soft bodies together, as built; so that a file can be described without its geometry. [kg; [0,
   * inf)] */
  float mass;
  /* Least coordinates of all render meshes and surfaces, as built. [m] */
  sbf_vec3 low;
  /* Greatest coordinates; equal to `low`: not stated. [m] */
  sbf_vec3 high;
} sbf_derivation;
typedef struct sbf_derivation_list {
  const sbf_derivation *at;
  uint32_t count;
} sbf_derivation_list;

/* An image. */
typedef struct sbf_texture {
  /* Identity. */
  const char *id;
  /* Name for people. */
  const char *name;
  /* Path relative to the file, with forward slashes; empty where the bytes are embedded. */
  const char *path;
  /* As image/png or image/jpeg. */
  const char *media_type;
  /* The image file itself, where it is embedded. */
  sbf_u8_list bytes;
} sbf_texture;
typedef struct sbf_texture_list {
  const sbf_texture *at;
  uint32_t count;
} sbf_texture_list;

/* An appearance: metallic-roughness, as glTF 2.0 defines it. */
typedef struct sbf_material {
  /* Identity. */
  const char *id;
  /* Name for people. */
  const char *name;
  /* Linear red, green, blue and opacity. [[0, 1]; default 1,1,1,1] */
  sbf_vec4 base_color;
  /* 0 dielectric, 1 metal. [[0, 1]; default 0] */
  float metallic;
  /* 0 mirror, 1 matt. [[0, 1]; default 1] */
  float roughness;
  /* Emitted linear colour. [[0, inf)] */
  sbf_vec3 emissive;
  /* What opacity means. [default opaque] */
  sbf_alpha_mode alpha_mode;
  /* Below it nothing is drawn, with alpha mode `mask`. [[0, 1]; default 0.5] */
  float alpha_cutoff;
  /* Seen from behind as well. [default false] */
  bool double_sided;
  /* Multiplies the base colour. [index into asset.textures, or SBF_NONE] */
  int32_t base_color_texture;
  /* Roughness in green, metallic in blue. [index into asset.textures, or SBF_NONE] */
  int32_t metallic_roughness_texture;
  /* Tangent-space normals. [index into asset.textures, or SBF_NONE] */
  int32_t normal_texture;
} sbf_material;
typedef struct sbf_material_list {
  const sbf_material *at;
  uint32_t count;
} sbf_material_list;

/* One bone. Its local +Y runs from head to tail; positions are in asset space. */
typedef struct sbf_bone {
  /* Identity. */
  const char *id;
  /* Name for people and for matching. */
  const char *name;
  /* The bone it hangs on; absent for a root. A parent stands before its children. [index into asset.bones, or
   * SBF_NONE] */
  int32_t parent;
  /* Where it begins, in the rest pose. [m] */
  sbf_vec3 head;
  /* From the bone's frame to asset space, in the rest pose. */
  sbf_quat rotation;
  /* From head to tail. [m; [0, inf)] */
  float length;
  /* Turns with its parent. [default true] */
  bool inherit_rotation;
  /* Scales with its parent. [default true] */
  bool inherit_scale;
} sbf_bone;
typedef struct sbf_bone_list {
  const sbf_bone *at;
  uint32_t count;
} sbf_bone_list;

/* Polygons over points. Each polygon runs counter-clockwise seen from outside. */
typedef struct sbf_polygon_mesh {
  /* What it is for. */
  sbf_mesh_target target;
  /* Points. [m] */
  sbf_vec3_list positions;
  /* Corners of each polygon. [[3, inf)] */
  sbf_u32_list polygon_sizes;
  /* The corners' points, polygon after polygon. [length sum(polygon_sizes); index into positions] */
  sbf_u32_list polygon_points;
} sbf_polygon_mesh;
typedef struct sbf_polygon_mesh_list {
  const sbf_polygon_mesh *at;
  uint32_t count;
} sbf_polygon_mesh_list;

/* A rigid part. Its frame has its origin at `center` and, at rest, the axes of asset space. */
typedef struct sbf_rigid_body {
  /* Identity. */
  const char *id;
  /* Name for people. */
  const char *name;
  /* The bone it moves with. [index into asset.bones, or SBF_NONE] */
  int32_t bone;
  /* Set where `build` made it. [index into asset.derivations, or SBF_NONE] */
  int32_t derived;
  /* Guessed from the rig, for a person to confirm. [default false] */
  bool proposed;
  /* kinematic: follows its bone; dynamic: simulated. [default kinematic] */
  sbf_body_motion motion;
  /* Mass; 0: density times the hull's volume. [kg; [0, inf)] */
  float mass;
  /* Density of the hull's inside, where no mass is given. [kg/m^3; (0, inf); default 1000] */
  float density;
  /* Origin of its frame, asset space, rest pose; where inertia is given its centre of mass, else that is the
   * hull's. [m] */
  sbf_vec3 center;
  /* Principal moments about the centre; all 0: those of the hull. [kg*m^2; [0, inf)] */
  sbf_vec3 inertia;
  /* From the principal axes to asset space. */
  sbf_quat inertia_rotation;
  /* Coulomb coefficient. [[0, inf); default 0.5] */
  float friction;
  /* Of normal speed. [[0, 1]; default 0] */
  float restitution;
  /* Factor on gravity. [default 1] */
  float gravity_scale;
  /* Collision: bits it is. [default 1] */
  uint32_t layer;
  /* Collision: bits it meets. [default 4294967295] */
  uint32_t mask;
  /* Convex shape, asset space, rest pose. */
  const sbf_polygon_mesh *hull;
  /* Set where `build` made the hull. [index into asset.derivations, or SBF_NONE] */
  int32_t hull_derived;
} sbf_rigid_body;
typedef struct sbf_rigid_body_list {
  const sbf_rigid_body *at;
  uint32_t count;
} sbf_rigid_body_list;

/* A place and an orientation. */
typedef struct sbf_frame {
  /* Origin. [m] */
  sbf_vec3 position;
  /* Orientation. */
  sbf_quat rotation;
} sbf_frame;
typedef struct sbf_frame_list {
  const sbf_frame *at;
  uint32_t count;
} sbf_frame_list;

/* Bounds of one motion of a joint; soft where stiffness is given. */
typedef struct sbf_limit {
  /* Which motion: metres for linear ones and distance, radians for the rest. */
  sbf_joint_axis target;
  /* Least value. */
  float min;
  /* Greatest value; for `swing` the cone's half angle, with min 0. */
  float max;
  /* Limit spring, N/m or N*m/rad; 0: hard. [[0, inf)] */
  float stiffness;
  /* Of the limit spring, N*s/m or N*m*s/rad. [[0, inf)] */
  float damping;
  /* Of a hard limit. [[0, 1]] */
  float restitution;
} sbf_limit;
typedef struct sbf_limit_list {
  const sbf_limit *at;
  uint32_t count;
} sbf_limit_list;

/* A motor on one motion of a joint. */
typedef struct sbf_drive {
  /* Which motion. */
  sbf_joint_axis target;
  /* Wanted value, m or rad. */
  float position;
  /* Wanted rate, m/s or rad/s. */
  float velocity;
  /* N/m or N*m/rad. [[0, inf)] */
  float stiffness;
  /* N*s/m or N*m*s/rad. [[0, inf)] */
  float damping;
  /* Greatest force in N or torque in N*m; 0: no bound. [[0, inf)] */
  float maximum;
} sbf_drive;
typedef struct sbf_drive_list {
  const sbf_drive *at;
  uint32_t count;
} sbf_drive_list;

/* Holds two rigid bodies together. Frames are local to their body; +X is the twist axis. */
typedef struct sbf_joint {
  /* Identity. */
  const char *id;
  /* Name for people. */
  const char *name;
  /* Which motions are left free; numbers 0 to 9 in this order. */
  sbf_joint_kind kind;
  /* First body; absent: the world. [index into asset.rigid_bodies, or SBF_NONE] */
  int32_t body_a;
  /* Second body. [index into asset.rigid_bodies, or SBF_NONE] */
  int32_t body_b;
  /* The joint's frame in body a. */
  sbf_frame frame_a;
  /* The joint's frame in body b. */
  sbf_frame frame_b;
  /* Guessed from the rig, for a person to confirm. [default false] */
  bool proposed;
  /* The two bodies collide with each other. [default false] */
  bool collide;
  /* Bounds of the free motions. */
  sbf_limit_list limits;
  /* Motors. */
  sbf_drive_list drives;
  /* Pulley: where the rope of body a hangs, asset space, fixed in the world from when the character is
   * placed. [m] */
  sbf_vec3 pulley_a;
  /* Pulley: where the rope of body b hangs, likewise. [m] */
  sbf_vec3 pulley_b;
  /* Pulley: rope on side b counts this much. [(0, inf); default 1] */
  float pulley_ratio;
  /* Breaks above it; 0: never. [N; [0, inf)] */
  float break_force;
  /* Breaks above it; 0: never. [N*m; [0, inf)] */
  float break_torque;
  /* Set where `build` made it. [index into asset.derivations, or SBF_NONE] */
  int32_t derived;
} sbf_joint;
typedef struct sbf_joint_list {
  const sbf_joint *at;
  uint32_t count;
} sbf_joint_list;

/* One set of texture coordinates, origin at the lower left. */
typedef struct sbf_uv_set {
  /* Name for people. */
  const char *name;
  /* One a point of the mesh, or as many as corners names. */
  sbf_vec2_list coordinates;
  /* The corners' coordinates; empty: one a point. [length 0 or parent.mesh.polygon_points; index into
   * coordinates] */
  sbf_u32_list corners;
} sbf_uv_set;
typedef struct sbf_uv_set_list {
  const sbf_uv_set *at;
  uint32_t count;
} sbf_uv_set_list;

/* A material that polygons of the mesh use. */
typedef struct sbf_material_slot {
  /* The material. [index into asset.materials, or SBF_NONE] */
  int32_t material;
} sbf_material_slot;
typedef struct sbf_material_slot_list {
  const sbf_material_slot *at;
  uint32_t count;
} sbf_material_slot_list;

/* Linear blend skinning. The rest pose is the bind pose. */
typedef struct sbf_skin {
  /* How many bones hold each point. [length parent.mesh.positions] */
  sbf_u32_list influence_counts;
  /* Those bones, point after point. [length sum(influence_counts); index into asset.bones] */
  sbf_u32_list bones;
  /* Their weights; those of a point sum to one. [[0, 1]; length bones] */
  sbf_f32_list weights;
} sbf_skin;
typedef struct sbf_skin_list {
  const sbf_skin *at;
  uint32_t count;
} sbf_skin_list;

/* Named offsets of some points. */
typedef struct sbf_shape_key {
  /* Name. */
  const char *name;
  /* The points that move. [index into parent.size] */
  sbf_u32_list points;
  /* By how much at full weight. [m; length points] */
  sbf_vec3_list offsets;
} sbf_shape_key;
typedef struct sbf_shape_key_list {
  const sbf_shape_key *at;
  uint32_t count;
} sbf_shape_key_list;

/* Fewer polygons over the same points. */
typedef struct sbf_render_level {
  /* Greatest distance from the full mesh. [m; [0, inf)] */
  float error;
  /* Corners of each polygon. [[3, inf)] */
  sbf_u32_list polygon_sizes;
  /* The corners' points. [length sum(polygon_sizes); index into parent.mesh.positions] */
  sbf_u32_list polygon_points;
  /* Set where `build` made it. [index into asset.derivations, or SBF_NONE] */
  int32_t derived;
  /* Slot of each polygon; empty: the first. [length 0 or polygon_sizes; index into parent.material_slots] */
  sbf_u32_list polygon_materials;
  /* For each corner one of the full mesh at the same point, whose normal and texture coordinates it has;
   * empty: the first there. [length 0 or polygon_points; index into parent.mesh.polygon_points] */
  sbf_u32_list corners;
} sbf_render_level;
typedef struct sbf_render_level_list {
  const sbf_render_level *at;
  uint32_t count;
} sbf_render_level_list;

/* Points held by a frame: a bone, a rigid body, or the world where neither is named. */
typedef struct sbf_pin_set {
  /* Name for people. */
  const char *name;
  /* The bone that holds. [index into asset.bones, or SBF_NONE] */
  int32_t bone;
  /* The rigid body that holds. [index into asset.rigid_bodies, or SBF_NONE] */
  int32_t rigid_body;
  /* Set where `build` made it. [index into asset.derivations, or SBF_NONE] */
  int32_t derived;
  /* Points of the body, or of the level. [index into parent.size] */
  sbf_u32_list points;
  /* Place of each in the frame; empty: where it is at rest. [m; length 0 or points] */
  sbf_vec3_list offsets;
  /* 1 kinematic, below a goal spring; empty: 1. [[0, 1]; length 0 or 1 or points] */
  sbf_f32_list weights;
  /* Of the goal spring at weight 1. [N/m; [0, inf)] */
  float stiffness;
  /* Of the goal spring. [N*s/m; [0, inf)] */
  float damping;
  /* Weights are raised to it. [[0, 1]] */
  float minimum;
  /* Weights are lowered to it. [[0, 1]; default 1] */
  float maximum;
} sbf_pin_set;
typedef struct sbf_pin_set_list {
  const sbf_pin_set *at;
  uint32_t count;
} sbf_pin_set_list;

/* A mesh to be seen, as authored: quads and n-gons are kept. */
typedef struct sbf_render_mesh {
  /* Identity. */
  const char *id;
  /* Name for people. */
  const char *name;
  /* The bone it moves with where it is neither embedded nor skinned. [index into asset.bones, or SBF_NONE] */
  int32_t bone;
  /* Set where `build` made it. [index into asset.derivations, or SBF_NONE] */
  int32_t derived;
  /* Its points and polygons. */
  sbf_polygon_mesh mesh;
  /* Unit normals: one a point, or as many as normal_corners names. */
  sbf_vec3_list normals;
  /* The corners' normals; empty: one normal a point. [length 0 or mesh.polygon_points; index into normals] */
  sbf_u32_list normal_corners;
  /* Texture coordinates. */
  sbf_uv_set_list uv_sets;
  /* The materials its polygons use. */
  sbf_material_slot_list material_slots;
  /* Slot of each polygon; empty: the first. [length 0 or mesh.polygon_sizes; index into material_slots] */
  sbf_u32_list polygon_materials;
  /* Weights of bones on points. */
  const sbf_skin *skin;
  /* Named offsets of points. */
  sbf_shape_key_list shape_keys;
  /* Number from 0 of each point in the source file. [length 0 or mesh.positions] */
  sbf_u32_list source_points;
  /* Coarser polygons over the same points. */
  sbf_render_level_list levels;
  /* What sections cut from it hold, on its points; a set without a frame goes with the section's bone. */
  sbf_pin_set_list pins;
} sbf_render_mesh;
typedef struct sbf_render_mesh_list {
  const sbf_render_mesh *at;
  uint32_t count;
} sbf_render_mesh_list;

/* Physical properties. Every value is in SI units. */
typedef struct sbf_attributes {
  /* Of a volume. [kg/m^3; (0, inf); default 1000] */
  float density;
  /* Of the whole body, free points; 0: from the density. [kg; [0, inf)] */
  float mass;
  /* Of an open surface; 0: density times thickness. [kg/m^2; [0, inf)] */
  float area_density;
  /* Of an open surface. [m; (0, inf); default 0.001] */
  float thickness;
  /* Stiffness. [Pa; (0, inf); default 80000] */
  float young_modulus;
  /* Sideways contraction; spring levels show a quarter. [(-1, 0.5); default 0.4] */
  float poisson_ratio;
  /* Flexural rigidity of an open surface; 0: from modulus and thickness. [N*m; [0, inf)] */
  float bending_stiffness;
  /* Rayleigh alpha. [1/s; [0, inf)] */
  float mass_damping;
  /* Rayleigh beta. [s; [0, inf)] */
  float stiffness_damping;
  /* At the body's lowest free mode, as further alpha. [[0, inf); default 0.2] */
  float damping_ratio;
  /* Coulomb coefficient. [[0, inf); default 0.6] */
  float friction;
  /* Of normal speed. [[0, 1]; default 0] */
  float restitution;
  /* Factor on gravity. [default 1] */
  float gravity_scale;
  /* Rate at which speed against the medium is lost. [1/s; [0, inf)] */
  float media_friction;
  /* Of the gas inside above the outside, at rest. [Pa] */
  float pressure;
  /* none: no pressure; gas: pressure times volume is constant; volume: the volume is kept. [default none] */
  sbf_pressure_mode pressure_mode;
  /* Springs are kept from shrinking below; -1: no bound. [[-1, 0]; default -1] */
  float strain_min;
  /* Springs are kept from stretching beyond; 0: no bound. [[0, inf)] */
  float strain_max;
  /* Beyond it the rest shape flows; 0: never. [[0, inf)] */
  float yield_strain;
  /* Rate of that flow. [1/s; [0, inf)] */
  float yield_flow;
  /* Beyond it the element stops; 0: never. [[0, inf)] */
  float tear_strain;
  /* Bears its weight in the authored shape: springs without stated rest lengths are loaded so. [default
   * false] */
  bool sag_free;
} sbf_attributes;
typedef struct sbf_attributes_list {
  const sbf_attributes *at;
  uint32_t count;
} sbf_attributes_list;

/* How a body meets other things. */
typedef struct sbf_collision {
  /* Of a point. [m; [0, inf); default 0.01] */
  float particle_radius;
  /* Contact begins this far outside a face. [m; [0, inf); default 0.005] */
  float outer_thickness;
  /* A point this far inside a face is still pushed out. [m; [0, inf); default 0.01] */
  float inner_thickness;
  /* Meets itself. [default false] */
  bool self;
  /* Bits it is. [default 1] */
  uint32_t layer;
  /* Bits it meets. [default 4294967295] */
  uint32_t mask;
} sbf_collision;
typedef struct sbf_collision_list {
  const sbf_collision *at;
  uint32_t count;
} sbf_collision_list;

/* Factors on one attribute. */
typedef struct sbf_weight_map {
  /* Which attribute. */
  sbf_weight_property property;
  /* Factor at each source point; an element takes the mean of its points'. [[0, inf); length parent.size] */
  sbf_f32_list values;
} sbf_weight_map;
typedef struct sbf_weight_map_list {
  const sbf_weight_map *at;
  uint32_t count;
} sbf_weight_map_list;

/* A rule by which a body is held. */
typedef struct sbf_attachment {
  /* Name for people. */
  const char *name;
  /* inside_hull: every point inside the rigid body's hull; explicit: the points listed. */
  sbf_attachment_rule rule;
  /* What holds. [index into asset.rigid_bodies, or SBF_NONE] */
  int32_t rigid_body;
  /* With rule explicit. [index into parent.size] */
  sbf_u32_list points;
} sbf_attachment;
typedef struct sbf_attachment_list {
  const sbf_attachment *at;
  uint32_t count;
} sbf_attachment_list;

/* A lattice. Positive orientation: det(p1-p0, p2-p0, p3-p0) > 0. */
typedef struct sbf_tetrahedron_mesh {
  /* What it is for. */
  sbf_volume_target target;
  /* Four points each; rest shape is the level's positions. [index into parent.positions] */
  sbf_uint4_list tetrahedra;
  /* Effective modulus; empty: the body's. [Pa; (0, inf); length 0 or 1 or tetrahedra] */
  sbf_f32_list young_modulus;
  /* What it stands for before calibration; empty: the body's. [Pa; (0, inf); length 0 or 1 or tetrahedra] */
  sbf_f32_list reference_modulus;
  /* Empty: the body's. [kg/m^3; (0, inf); length 0 or 1 or tetrahedra] */
  sbf_f32_list densities;
  /* Elements lie in colour order; how many of each colour. Empty: not coloured. */
  sbf_u32_list color_counts;
  /* Rayleigh beta; empty: the body's, by its weight maps. [s; [0, inf); length 0 or 1 or tetrahedra] */
  sbf_f32_list stiffness_damping;
} sbf_tetrahedron_mesh;
typedef struct sbf_tetrahedron_mesh_list {
  const sbf_tetrahedron_mesh *at;
  uint32_t count;
} sbf_tetrahedron_mesh_list;

/* Springs of one kind. */
typedef struct sbf_spring_set {
  /* Name for people. */
  const char *name;
  /* What they are for. */
  sbf_spring_kind kind;
  /* Set where `build` made them. [index into asset.derivations, or SBF_NONE] */
  int32_t derived;
  /* Acts beside another elastic model. [default false] */
  bool extra;
  /* Two points each, of the level. [index into parent.positions] */
  sbf_uint2_list ends;
  /* Empty: distances at rest. [m; [0, inf); length 0 or ends] */
  sbf_f32_list rest_lengths;
  /* Empty: by the body's modulus as the specification says. [N/m; [0, inf); length 0 or 1 or ends] */
  sbf_f32_list stiffness;
  /* Empty: by the body's damping. [N*s/m; [0, inf); length 0 or 1 or ends] */
  sbf_f32_list damping;
  /* As the body's, for this set; -1: the body's. [[-1, 0]; default -1] */
  float strain_min;
  /* As the body's, for this set; 0: the body's. [[0, inf)] */
  float strain_max;
  /* As the body's, for this set; 0: the body's. [[0, inf)] */
  float yield_strain;
  /* As the body's, for this set; 0: the body's. [[0, inf)] */
  float tear_strain;
  /* Springs that joined two pinned points and were left out. */
  uint32_t inert_count;
  /* Springs lie in colour order; how many of each colour. Empty: not coloured. */
  sbf_u32_list color_counts;
  /* Stiffness below the rest length, as a share of `stiffness`; empty: 1. [[0, inf); length 0 or 1 or ends]
   * */
  sbf_f32_list compression_ratio;
} sbf_spring_set;
typedef struct sbf_spring_set_list {
  const sbf_spring_set *at;
  uint32_t count;
} sbf_spring_set_list;

/* Overlapping groups of points that keep their shape. */
typedef struct sbf_shape_regions {
  /* Points of each region. [[1, inf)] */
  sbf_u32_list sizes;
  /* Those points, region after region. [length sum(sizes); index into parent.positions] */
  sbf_u32_list points;
  /* Angular frequency w with which a point is drawn to its place in the region: energy m/2 w^2 distance^2.
   * [1/s; (0, inf); default 60] */
  float stiffness;
} sbf_shape_regions;
typedef struct sbf_shape_regions_list {
  const sbf_shape_regions *at;
  uint32_t count;
} sbf_shape_regions_list;

/* A second-order follower: y + 2z/w y' + y''/w^2 = x + r z/w x', w = 2 pi f. */
typedef struct sbf_jiggle {
  /* f. [Hz; (0, inf); default 3] */
  float frequency;
  /* z. [[0, inf); default 0.4] */
  float damping_ratio;
  /* r: above 1 overshoots at once, below 0 anticipates. [default 0] */
  float response;
} sbf_jiggle;
typedef struct sbf_jiggle_list {
  const sbf_jiggle *at;
  uint32_t count;
} sbf_jiggle_list;

/* Carries vertices by the level's points. */
typedef struct sbf_embedding {
  /* Whose vertices; absent: the body's own surface. [index into asset.render_meshes, or SBF_NONE] */
  int32_t render_mesh;
  /* Which vertices; empty: all, in order. */
  sbf_u32_list vertices;
  /* Four points of the level for each vertex. [index into parent.positions] */
  sbf_uint4_list points;
  /* Their weights, summing to one; outside 0..1 where the vertex lies outside. [length points] */
  sbf_vec4_list weights;
  /* Share of this body in a vertex that several carry; empty: 1. [[0, 1]; length 0 or points] */
  sbf_f32_list blends;
  /* Set where `build` made it. [index into asset.derivations, or SBF_NONE] */
  int32_t derived;
} sbf_embedding;
typedef struct sbf_embedding_list {
  const sbf_embedding *at;
  uint32_t count;
} sbf_embedding_list;

/* A time on one machine. */
typedef struct sbf_measured {
  /* Which. */
  const char *machine;
  /* For a control tick, one thread. [us; [0, inf)] */
  float microseconds;
} sbf_measured;
typedef struct sbf_measured_list {
  const sbf_measured *at;
  uint32_t count;
} sbf_measured_list;

/* How to step a level. */
typedef struct sbf_simulation {
  /* Method. [default automatic] */
  sbf_scheme scheme;
  /* Of a control tick; 0: as many as the scheme needs. */
  uint32_t substeps;
  /* Measured against the converged reference; 0: not measured. [m; [0, inf)] */
  float error;
  /* Element visits in a control tick; 0: not known. [[0, inf)] */
  float cost;
  /* Times on machines. */
  sbf_measured_list measured;
  /* Of schemes that control their error: how large a step's may be; 0: the host's choice. [m; [0, inf)] */
  float step_error;
  /* Of a control tick, of schemes that control their error; 0: no bound. */
  uint32_t substeps_least;
  /* The same; 0: no bound. */
  uint32_t substeps_most;
  /* Of the character's skin as it moves, all bodies on such levels, at its worst place and moment; 0: not
   * measured. [m; [0, inf)] */
  float motion_error;
  /* The same, root of the mean square over its vertices and moments. [m; [0, inf)] */
  float motion_error_rms;
} sbf_simulation;
typedef struct sbf_simulation_list {
  const sbf_simulation *at;
  uint32_t count;
} sbf_simulation_list;

/* What a level's moduli or stiffnesses were multiplied by, and how near that brought it. */
typedef struct sbf_calibration {
  /* Tetrahedra of the lattice it was compared with. */
  uint32_t reference_elements;
  /* On the moduli, on the mean of the volume; or on the stiffness of springs inside, on their mean. [(0,
   * inf); default 1] */
  float factor;
  /* On the stiffness of springs over the surface, on their mean. [(0, inf); default 1] */
  float surface_factor;
  /* Share by which it still gives otherwise under small loads: of lattices the most that the mean over the
   * surface is off under one of them, of springs the root of the mean square of what is left at the surface's
   * points. [[0, inf)] */
  float residual;
  /* Share by which it swings slower. */
  float period_error;
} sbf_calibration;
typedef struct sbf_calibration_list {
  const sbf_calibration *at;
  uint32_t count;
} sbf_calibration_list;

/* One way to simulate a body: points, one elastic model, pins, embeddings. */
typedef struct sbf_level {
  /* Name for people. */
  const char *name;
  /* The one model that carries the shape. [default springs] */
  sbf_elastic_model model;
  /* Set where `build` made it. [index into asset.derivations, or SBF_NONE] */
  int32_t derived;
  /* Edge length the elements were made with; 0: not known. [m; [0, inf)] */
  float cell;
  /* Points at rest; they begin with the surface's points where the model is springs. [m] */
  sbf_vec3_list positions;
  /* Place in this level of each source point, where the order differs; 4294967295: the level does not have
   * it. */
  sbf_u32_list new_from_old;
  /* Of each point; empty: by the rules of the specification. [kg; [0, inf); length 0 or positions] */
  sbf_f32_list masses;
  /* Tetrahedra. */
  sbf_tetrahedron_mesh lattice;
  /* Springs. */
  sbf_spring_set_list springs;
  /* Shape matching. */
  const sbf_shape_regions *regions;
  /* One follower for the whole body. */
  const sbf_jiggle *jiggle;
  /* What holds it. */
  sbf_pin_set_list pins;
  /* Meshes carried by it. */
  sbf_embedding_list embeddings;
  /* How to step it, with the error and the cost of doing so. */
  sbf_simulation simulation;
  /* How it was made to give as its matter does. */
  const sbf_calibration *calibration;
} sbf_level;
typedef struct sbf_level_list {
  const sbf_level *at;
  uint32_t count;
} sbf_level_list;

/* Attributes of the 2012 dialect, dimensionless as they were. */
typedef struct sbf_legacy {
  /* As read. */
  float mass;
  /* As read. */
  float volume_stiffness;
  /* As read. */
  float stretching_stiffness;
  /* As read. */
  float friction;
  /* As read. */
  float particle_radius;
  /* As read. */
  uint32_t solver_iterations;
} sbf_legacy;
typedef struct sbf_legacy_list {
  const sbf_legacy *at;
  uint32_t count;
} sbf_legacy_list;

/* A deformable body: its source points are the surface's points, then the interior ones. */
typedef struct sbf_soft_body {
  /* Identity. */
  const char *id;
  /* Name for people. */
  const char *name;
  /* The bone of a section. [index into asset.bones, or SBF_NONE] */
  int32_t bone;
  /* Set where `build` cut it from a skinned mesh. [index into asset.derivations, or SBF_NONE] */
  int32_t derived;
  /* Its skin. */
  sbf_polygon_mesh surface;
  /* Points an author placed inside. [m] */
  sbf_vec3_list interior;
  /* Number from 0 of each surface point in the source file. [length 0 or surface.positions] */
  sbf_u32_list source_points;
  /* What it is made of. */
  sbf_attributes attributes;
  /* How it meets other things. */
  sbf_collision collision;
  /* Factors on attributes, per source point. */
  sbf_weight_map_list weight_maps;
  /* What holds it, on source points. */
  sbf_pin_set_list pins;
  /* Rules that `build` turns into pins. */
  sbf_attachment_list attachments;
  /* Its simulation levels, finest first. */
  sbf_level_list levels;
  /* Attributes of the 2012 dialect, kept for a round trip. */
  const sbf_legacy *legacy;
} sbf_soft_body;
typedef struct sbf_soft_body_list {
  const sbf_soft_body *at;
  uint32_t count;
} sbf_soft_body_list;

/* Springs between points of two bodies' levels. */
typedef struct sbf_cross_springs {
  /* Name for people. */
  const char *name;
  /* Set where `build` made them. [index into asset.derivations, or SBF_NONE] */
  int32_t derived;
  /* First body. [index into asset.soft_bodies, or SBF_NONE] */
  int32_t body_a;
  /* Its level. */
  uint32_t level_a;
  /* Second body. [index into asset.soft_bodies, or SBF_NONE] */
  int32_t body_b;
  /* Its level. */
  uint32_t level_b;
  /* A point of each. */
  sbf_uint2_list ends;
  /* Empty: distances at rest. [m; [0, inf); length 0 or ends] */
  sbf_f32_list rest_lengths;
  /* Empty: by the softer body's modulus. [N/m; [0, inf); length 0 or 1 or ends] */
  sbf_f32_list stiffness;
  /* Empty: by the softer body's damping. [N*s/m; [0, inf); length 0 or 1 or ends] */
  sbf_f32_list damping;
} sbf_cross_springs;
typedef struct sbf_cross_springs_list {
  const sbf_cross_springs *at;
  uint32_t count;
} sbf_cross_springs_list;

/* A rotation a bone prefers, relative to its parent's rest. */
typedef struct sbf_comfort {
  /* The bone. [index into asset.bones, or SBF_NONE] */
  int32_t bone;
  /* The rotation. */
  sbf_quat rotation;
  /* How much. [[0, 1]; default 1] */
  float weight;
  /* Shares of the weight about the bone's own X, Y and Z. [[0, 1]; default 1,1,1] */
  sbf_vec3 axes;
} sbf_comfort;
typedef struct sbf_comfort_list {
  const sbf_comfort *at;
  uint32_t count;
} sbf_comfort_list;

/* Bones from root to end reach for a target. */
typedef struct sbf_ik_chain {
  /* Identity. */
  const char *id;
  /* Name for people. */
  const char *name;
  /* Method. [default two_bone] */
  sbf_ik_solver solver;
  /* First bone. [index into asset.bones, or SBF_NONE] */
  int32_t root;
  /* Last bone; its head is what reaches. [index into asset.bones, or SBF_NONE] */
  int32_t end;
  /* The chain bends towards the pole. [default false] */
  bool has_pole;
  /* The pole, asset space, rest pose. [m] */
  sbf_vec3 pole;
  /* The pole moves with it; absent: with the root bone's parent. [index into asset.bones, or SBF_NONE] */
  int32_t pole_bone;
  /* How much of the target's orientation the end takes. [[0, 1]; default 1] */
  float copy_rotation;
  /* Share of the reach over which full extension is eased. [[0, 1); default 0.02] */
  float soft_reach;
  /* Iterative methods stop within it. [m; (0, inf); default 0.0001] */
  float tolerance;
  /* Iterative methods stop after so many. [default 32] */
  uint32_t iterations;
  /* Rotations the bones prefer. */
  sbf_comfort_list comforts;
  /* Guessed from the rig, for a person to confirm. [default false] */
  bool proposed;
} sbf_ik_chain;
typedef struct sbf_ik_chain_list {
  const sbf_ik_chain *at;
  uint32_t count;
} sbf_ik_chain_list;

/* One leg. */
typedef struct sbf_leg {
  /* Name for people. */
  const char *name;
  /* What moves it. [index into asset.ik_chains, or SBF_NONE] */
  int32_t ik;
  /* Where its foot stands at rest: the end bone's head, asset space. [m] */
  sbf_vec3 home;
  /* Height of the end bone's head above the sole, at rest. [m] */
  float sole;
  /* Feet of one group may be in the air together. */
  uint32_t group;
  /* A foot farther than its reach plus this is put down anew. [m; [0, inf); default 0.5] */
  float jump_margin;
} sbf_leg;
typedef struct sbf_leg_list {
  const sbf_leg *at;
  uint32_t count;
} sbf_leg_list;

/* The head looks where a turn will lead. */
typedef struct sbf_head_turn {
  /* The head. [index into asset.bones, or SBF_NONE] */
  int32_t bone;
  /* How far ahead it looks. [s; [0, inf); default 0.4] */
  float lead;
  /* Greatest angle. [rad; [0, 3.15]; default 0.7] */
  float limit;
  /* Of the follower that moves it. [Hz; (0, inf); default 1.5] */
  float frequency;
  /* Of that follower. [[0, inf); default 0.8] */
  float damping_ratio;
} sbf_head_turn;
typedef struct sbf_head_turn_list {
  const sbf_head_turn *at;
  uint32_t count;
} sbf_head_turn_list;

/* A chain that lags behind the body and overshoots. */
typedef struct sbf_tail {
  /* Which chain. [index into asset.chains, or SBF_NONE] */
  int32_t chain;
  /* Of the first bone's follower. [Hz; (0, inf); default 1.2] */
  float frequency;
  /* Of the followers. [[0, inf); default 0.25] */
  float damping_ratio;
  /* Greatest bend of a bone against its parent. [rad; [0, 3.15]; default 0.6] */
  float limit;
} sbf_tail;
typedef struct sbf_tail_list {
  const sbf_tail *at;
  uint32_t count;
} sbf_tail_list;

/* How the character walks. */
typedef struct sbf_gait {
  /* Identity. */
  const char *id;
  /* Name for people. */
  const char *name;
  /* Guessed from the rig, for a person to confirm. [default false] */
  bool proposed;
  /* The bone on which the rest hangs in a walk: it travels with the character. [index into asset.bones, or
   * SBF_NONE] */
  int32_t body;
  /* Turns with the line between the hind feet. [index into asset.bones, or SBF_NONE] */
  int32_t hips;
  /* Turns with the line between the fore feet. [index into asset.bones, or SBF_NONE] */
  int32_t chest;
  /* Greatest lift of a foot. [m; [0, inf); default 0.05] */
  float step_height;
  /* Distance of a foot from the body's middle line when walking; 0: its home's. [m; [0, inf)] */
  float step_width;
  /* A foot this far from its home wants to step. [m; (0, inf); default 0.05] */
  float step_trigger;
  /* Time of a step at the walking speed. [s; (0, inf); default 0.25] */
  float step_duration;
  /* Speed the other settings were made for; a note, which changes nothing. [m/s; (0, inf); default 0.5] */
  float walk_speed;
  /* Share of the feet's line that hips and chest take. [[0, 1]; default 0.5] */
  float hip_tilt;
  /* Share of the slope between the feet that the body's pitch and roll take. [[0, 1]; default 0.7] */
  float body_tilt;
  /* Its legs. */
  sbf_leg_list legs;
  /* A head that leads a turn. */
  const sbf_head_turn *head;
  /* Chains that lag and overshoot. */
  sbf_tail_list tails;
} sbf_gait;
typedef struct sbf_gait_list {
  const sbf_gait *at;
  uint32_t count;
} sbf_gait_list;

/* Bones one after the other. */
typedef struct sbf_chain {
  /* Identity. */
  const char *id;
  /* Name for people. */
  const char *name;
  /* lag: each follows its parent's turn; distance: each is dragged at its spacing. [default lag] */
  sbf_chain_kind kind;
  /* From the leading bone on. [index into asset.bones] */
  sbf_u32_list bones;
  /* Distance to the next; empty: bone lengths. [m; [0, inf); length 0 or bones] */
  sbf_f32_list spacing;
  /* Greatest bend between two. [rad; [0, 3.15]; default 1] */
  float angle_limit;
  /* Rate at which it straightens at rest. [1/s; [0, inf)] */
  float damping;
  /* Guessed from the rig, for a person to confirm. [default false] */
  bool proposed;
} sbf_chain;
typedef struct sbf_chain_list {
  const sbf_chain *at;
  uint32_t count;
} sbf_chain_list;

/* A bone follows its own animated pose as a second-order system. */
typedef struct sbf_follower {
  /* Identity. */
  const char *id;
  /* Name for people. */
  const char *name;
  /* The bone. [index into asset.bones, or SBF_NONE] */
  int32_t bone;
  /* What follows. [default rotation] */
  sbf_follower_channel channel;
  /* f. [Hz; (0, inf); default 2] */
  float frequency;
  /* z. [[0, inf); default 0.5] */
  float damping_ratio;
  /* r. [default 0] */
  float response;
  /* Of a squash: which of the bone's own axes it is pressed and stretched along. [default y] */
  sbf_bone_axis axis;
  /* Of a squash or a weight: share of its length by which the bone stretches, or moves and leans, as it lags
   * by its length. [[0, inf); default 1] */
  float strength;
  /* Of a squash: it stays below 1 + limit of its length, and above 1 / (1 + limit); of a weight: it moves by
   * less than limit of its length and leans by less than limit rad. [(0, inf); default 0.5] */
  float limit;
} sbf_follower;
typedef struct sbf_follower_list {
  const sbf_follower *at;
  uint32_t count;
} sbf_follower_list;

/* Keys of one property of one bone's frame in its parent's. */
typedef struct sbf_track {
  /* The bone. [index into asset.bones, or SBF_NONE] */
  int32_t bone;
  /* What is keyed. */
  sbf_track_property property;
  /* Between keys. [default linear] */
  sbf_interpolation interpolation;
  /* Of the keys, increasing. [s] */
  sbf_f32_list times;
  /* Of the keys: 3 numbers each, 4 for rotation; where cubic three times as many: tangent in, value, tangent
   * out. */
  sbf_f32_list values;
} sbf_track;
typedef struct sbf_track_list {
  const sbf_track *at;
  uint32_t count;
} sbf_track_list;

/* A keyed animation. */
typedef struct sbf_clip {
  /* Identity. */
  const char *id;
  /* Name for people. */
  const char *name;
  /* Length. [s; [0, inf)] */
  float duration;
  /* Starts again at its end. [default true] */
  bool loop;
  /* Keys. */
  sbf_track_list tracks;
} sbf_clip;
typedef struct sbf_clip_list {
  const sbf_clip *at;
  uint32_t count;
} sbf_clip_list;

/* One bone of a pose, relative to its parent. */
typedef struct sbf_pose_key {
  /* The bone. [index into asset.bones, or SBF_NONE] */
  int32_t bone;
  /* Added to its place at rest, in the parent's frame. [m] */
  sbf_vec3 translation;
  /* On top of rest. */
  sbf_quat rotation;
} sbf_pose_key;
typedef struct sbf_pose_key_list {
  const sbf_pose_key *at;
  uint32_t count;
} sbf_pose_key_list;

/* A named pose. */
typedef struct sbf_pose {
  /* Identity. */
  const char *id;
  /* Name for people. */
  const char *name;
  /* Distance walked at which it is reached. [m] */
  float distance;
  /* Bones. */
  sbf_pose_key_list keys;
  /* Of the walk that it belongs to: poses of one speed are one walk. [m/s; [0, inf)] */
  float speed;
  /* The walk's second half is the mirror image of its poses. [default false] */
  bool mirrored;
} sbf_pose;
typedef struct sbf_pose_list {
  const sbf_pose *at;
  uint32_t count;
} sbf_pose_list;

/* Weights per bone. */
typedef struct sbf_bone_mask {
  /* Identity. */
  const char *id;
  /* Name for people. */
  const char *name;
  /* Bones. [index into asset.bones] */
  sbf_u32_list bones;
  /* Empty: 1. [[0, 1]; length 0 or bones] */
  sbf_f32_list weights;
} sbf_bone_mask;
typedef struct sbf_bone_mask_list {
  const sbf_bone_mask *at;
  uint32_t count;
} sbf_bone_mask_list;

/* A chain of bones with a name that other skeletons use too. */
typedef struct sbf_retarget_chain {
  /* Identity. */
  const char *id;
  /* As spine, leg_left, tail. */
  const char *name;
  /* From root to end. [index into asset.bones] */
  sbf_u32_list bones;
} sbf_retarget_chain;
typedef struct sbf_retarget_chain_list {
  const sbf_retarget_chain *at;
  uint32_t count;
} sbf_retarget_chain_list;

/* A field of acceleration. */
typedef struct sbf_force_field {
  /* Identity. */
  const char *id;
  /* Name for people. */
  const char *name;
  /* Shape. */
  sbf_field_kind kind;
  /* Centre. [m] */
  sbf_vec3 position;
  /* Axis of uniform and vortex, of any length. */
  sbf_vec3 direction;
  /* At the centre; radial: away from it; drag: against a speed of 1 m/s. [m/s^2] */
  float strength;
  /* No force beyond; 0: everywhere. [m; [0, inf)] */
  float radius;
  /* Power p with which strength falls: it is divided by (1 + d)^p, d metres from the centre. [[0, inf)] */
  float falloff;
} sbf_force_field;
typedef struct sbf_force_field_list {
  const sbf_force_field *at;
  uint32_t count;
} sbf_force_field_list;

/* What surrounds the character. */
typedef struct sbf_environment {
  /* Acceleration. [m/s^2; default 0,-9.81,0] */
  sbf_vec3 gravity;
  /* Velocity of the medium. [m/s] */
  sbf_vec3 wind;
  /* For drag on faces. [kg/m^3; [0, inf)] */
  float media_density;
  /* Added to each body's. [1/s; [0, inf)] */
  float media_friction;
  /* Time between two control ticks. [s; (0, 1]; default 0.016666668] */
  float control_tick;
  /* Force fields. */
  sbf_force_field_list fields;
} sbf_environment;
typedef struct sbf_environment_list {
  const sbf_environment *at;
  uint32_t count;
} sbf_environment_list;

/* The relaxation scheme of the reference lizard: per tick, dimensionless. */
typedef struct sbf_relaxation {
  /* Share of a spring's error corrected in a visit. [[0, 1]; default 0.3] */
  float stiffness;
  /* Share of a tick's motion that is kept. [[0, 1]; default 0.9] */
  float damping;
  /* Fall added in a tick. [m; default 0.001] */
  float gravity;
} sbf_relaxation;
typedef struct sbf_relaxation_list {
  const sbf_relaxation *at;
  uint32_t count;
} sbf_relaxation_list;

/* A part beyond this specification. */
typedef struct sbf_extension {
  /* As VENDOR_name. */
  const char *name;
  /* A reader that does not know it must refuse the file. [default false] */
  bool required;
  /* Its content, in whatever text form it chooses. */
  const char *data;
} sbf_extension;
typedef struct sbf_extension_list {
  const sbf_extension *at;
  uint32_t count;
} sbf_extension_list;

/* What the section that `build` cuts from a skin for a bone is like. */
typedef struct sbf_section_recipe {
  /* The section's bone; none: every one that no other recipe names. [index into asset.bones, or SBF_NONE] */
  int32_t bone;
  /* What it is made of. */
  sbf_attributes attributes;
  /* How it meets other things. */
  sbf_collision collision;
} sbf_section_recipe;
typedef struct sbf_section_recipe_list {
  const sbf_section_recipe *at;
  uint32_t count;
} sbf_section_recipe_list;

/* A whole file: metres, kilograms, seconds, radians; right-handed, +Y up, +Z forward, rest pose. */
typedef struct sbf_asset {
  /* Version of the format the file is written in, major.minor. [default 1.0] */
  const char *version;
  /* What the asset is and where it comes from. */
  sbf_info info;
  /* What was computed, with which settings, from which source. */
  sbf_derivation_list derivations;
  /* Images used by materials. */
  sbf_texture_list textures;
  /* Appearances. */
  sbf_material_list materials;
  /* The skeleton's bones, parents before children. */
  sbf_bone_list bones;
  /* Rigid parts. */
  sbf_rigid_body_list rigid_bodies;
  /* What holds rigid parts together; loops are allowed. */
  sbf_joint_list joints;
  /* What is seen. */
  sbf_render_mesh_list render_meshes;
  /* What deforms; one with a bone is a section. */
  sbf_soft_body_list soft_bodies;
  /* Springs between two bodies. */
  sbf_cross_springs_list cross_springs;
  /* Chains of bones that reach for a target. */
  sbf_ik_chain_list ik_chains;
  /* How the character walks. */
  sbf_gait_list gaits;
  /* Chains of bones that follow their first. */
  sbf_chain_list chains;
  /* Bones that follow their own pose as second-order systems. */
  sbf_follower_list followers;
  /* Keyed animation. */
  sbf_clip_list clips;
  /* Pose keys. */
  sbf_pose_list poses;
  /* Weights per bone for blending. */
  sbf_bone_mask_list bone_masks;
  /* Named chains of bones, for motion from other skeletons. */
  sbf_retarget_chain_list retarget_chains;
  /* What surrounds the character. */
  sbf_environment environment;
  /* Dimensionless settings of the relaxation scheme. */
  sbf_relaxation relaxation;
  /* Parts beyond this specification. */
  sbf_extension_list extensions;
  /* What sections that `build` cuts are like. */
  sbf_section_recipe_list section_recipes;
} sbf_asset;

/* Every field at its default, lists empty, references SBF_NONE. */
SBF_API void sbf_author_init(sbf_author *author);
SBF_API void sbf_source_init(sbf_source *source);
SBF_API void sbf_info_init(sbf_info *info);
SBF_API void sbf_derivation_init(sbf_derivation *derivation);
SBF_API void sbf_texture_init(sbf_texture *texture);
SBF_API void sbf_material_init(sbf_material *material);
SBF_API void sbf_bone_init(sbf_bone *bone);
SBF_API void sbf_polygon_mesh_init(sbf_polygon_mesh *polygon_mesh);
SBF_API void sbf_rigid_body_init(sbf_rigid_body *rigid_body);
SBF_API void sbf_frame_init(sbf_frame *frame);
SBF_API void sbf_limit_init(sbf_limit *limit);
SBF_API void sbf_drive_init(sbf_drive *drive);
SBF_API void sbf_joint_init(sbf_joint *joint);
SBF_API void sbf_uv_set_init(sbf_uv_set *uv_set);
SBF_API void sbf_material_slot_init(sbf_material_slot *material_slot);
SBF_API void sbf_skin_init(sbf_skin *skin);
SBF_API void sbf_shape_key_init(sbf_shape_key *shape_key);
SBF_API void sbf_render_level_init(sbf_render_level *render_level);
SBF_API void sbf_pin_set_init(sbf_pin_set *pin_set);
SBF_API void sbf_render_mesh_init(sbf_render_mesh *render_mesh);
SBF_API void sbf_attributes_init(sbf_attributes *attributes);
SBF_API void sbf_collision_init(sbf_collision *collision);
SBF_API void sbf_weight_map_init(sbf_weight_map *weight_map);
SBF_API void sbf_attachment_init(sbf_attachment *attachment);
SBF_API void sbf_tetrahedron_mesh_init(sbf_tetrahedron_mesh *tetrahedron_mesh);
SBF_API void sbf_spring_set_init(sbf_spring_set *spring_set);
SBF_API void sbf_shape_regions_init(sbf_shape_regions *shape_regions);
SBF_API void sbf_jiggle_init(sbf_jiggle *jiggle);
SBF_API void sbf_embedding_init(sbf_embedding *embedding);
SBF_API void sbf_measured_init(sbf_measured *measured);
SBF_API void sbf_simulation_init(sbf_simulation *simulation);
SBF_API void sbf_calibration_init(sbf_calibration *calibration);
SBF_API void sbf_level_init(sbf_level *level);
SBF_API void sbf_legacy_init(sbf_legacy *legacy);
SBF_API void sbf_soft_body_init(sbf_soft_body *soft_body);
SBF_API void sbf_cross_springs_init(sbf_cross_springs *cross_springs);
SBF_API void sbf_comfort_init(sbf_comfort *comfort);
SBF_API void sbf_ik_chain_init(sbf_ik_chain *ik_chain);
SBF_API void sbf_leg_init(sbf_leg *leg);
SBF_API void sbf_head_turn_init(sbf_head_turn *head_turn);
SBF_API void sbf_tail_init(sbf_tail *tail);
SBF_API void sbf_gait_init(sbf_gait *gait);
SBF_API void sbf_chain_init(sbf_chain *chain);
SBF_API void sbf_follower_init(sbf_follower *follower);
SBF_API void sbf_track_init(sbf_track *track);
SBF_API void sbf_clip_init(sbf_clip *clip);
SBF_API void sbf_pose_key_init(sbf_pose_key *pose_key);
SBF_API void sbf_pose_init(sbf_pose *pose);
SBF_API void sbf_bone_mask_init(sbf_bone_mask *bone_mask);
SBF_API void sbf_retarget_chain_init(sbf_retarget_chain *retarget_chain);
SBF_API void sbf_force_field_init(sbf_force_field *force_field);
SBF_API void sbf_environment_init(sbf_environment *environment);
SBF_API void sbf_relaxation_init(sbf_relaxation *relaxation);
SBF_API void sbf_extension_init(sbf_extension *extension);
SBF_API void sbf_section_recipe_init(sbf_section_recipe *section_recipe);
SBF_API void sbf_asset_init(sbf_asset *asset);

/* The word the format uses for a value, or "?" for one out of range. */
SBF_API const char *sbf_mesh_target_name(sbf_mesh_target value);
SBF_API const char *sbf_volume_target_name(sbf_volume_target value);
SBF_API const char *sbf_elastic_model_name(sbf_elastic_model value);
SBF_API const char *sbf_spring_kind_name(sbf_spring_kind value);
SBF_API const char *sbf_pressure_mode_name(sbf_pressure_mode value);
SBF_API const char *sbf_body_motion_name(sbf_body_motion value);
SBF_API const char *sbf_joint_kind_name(sbf_joint_kind value);
SBF_API const char *sbf_joint_axis_name(sbf_joint_axis value);
SBF_API const char *sbf_attachment_rule_name(sbf_attachment_rule value);
SBF_API const char *sbf_weight_property_name(sbf_weight_property value);
SBF_API const char *sbf_scheme_name(sbf_scheme value);
SBF_API const char *sbf_ik_solver_name(sbf_ik_solver value);
SBF_API const char *sbf_chain_kind_name(sbf_chain_kind value);
SBF_API const char *sbf_follower_channel_name(sbf_follower_channel value);
SBF_API const char *sbf_bone_axis_name(sbf_bone_axis value);
SBF_API const char *sbf_track_property_name(sbf_track_property value);
SBF_API const char *sbf_interpolation_name(sbf_interpolation value);
SBF_API const char *sbf_field_kind_name(sbf_field_kind value);
SBF_API const char *sbf_alpha_mode_name(sbf_alpha_mode value);

// clang-format on

#ifdef __cplusplus
}
#endif
#endif
