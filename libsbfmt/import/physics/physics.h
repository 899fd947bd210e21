/* Rigid bodies and joints of a glTF file: the extensions KHR_physics_rigid_bodies and KHR_implicit_shapes,
 * release candidates of 2025 by Khronos. The JSON is untrusted.
 *
 * A node with a motion becomes a bone and a rigid body; the colliders at and below it, up to the next motion,
 * become its hull. Other colliders become kinematic bodies. A file whose moving bodies are all kinematic is
 * converted as any other, with these bodies and joints; in other files nothing becomes soft. */
#ifndef SBFI_PHYSICS_H
#define SBFI_PHYSICS_H

#include "base/file.h"
#include "gltf/glb_file.h"
#include "import/convert/conversion.h"

/* What an asset cannot hold, or holds differently; each is counted and reported once. */
typedef enum sbfi_physics_loss {
  SBFI_LOSS_COMPOUND,
  SBFI_LOSS_CONCAVE,
  SBFI_LOSS_PLANE,
  SBFI_LOSS_STATIC,
  SBFI_LOSS_GEOMETRY,
  SBFI_LOSS_SHAPE_TYPE,
  SBFI_LOSS_TRIGGER,
  SBFI_LOSS_STATIC_FRICTION,
  SBFI_LOSS_COMBINE,
  SBFI_LOSS_MATERIALS,
  SBFI_LOSS_SYSTEMS,
  SBFI_LOSS_VELOCITY,
  SBFI_LOSS_NO_MASS,
  SBFI_LOSS_INFINITE_MASS,
  SBFI_LOSS_INFINITE_INERTIA,
  SBFI_LOSS_STATIC_JOINT,
  SBFI_LOSS_TUBE,
  SBFI_LOSS_ROTATION,
  SBFI_LOSS_CONE_MIN,
  SBFI_LOSS_CONES,
  SBFI_LOSS_SEVERAL_ANGLES,
  SBFI_LOSS_ACCELERATION,
  SBFI_LOSS_DRIVE,
  SBFI_LOSS_COUNT
} sbfi_physics_loss;

typedef struct sbfi_physics_node {
  const sbfi_json *json;
  const sbfi_json *physics; /* the node's extension; NULL: it has none */
  int32_t parent;           /* glTF node above, or SBF_NONE */
  int32_t scene_node;       /* SBF_NONE: the node is not in the scene */
  int32_t moving_node;      /* the node with a motion at or above this one; SBF_NONE: the node is static */
  int32_t body;             /* rigid body of the node's motion or static collider, or SBF_NONE */
} sbfi_physics_node;

struct sbfi_physics {
  sbfi_arena arena;
  sbfi_file_content content, buffer; /* the file, and the buffer beside it */
  sbfi_glb_file file;
  const sbfi_scene *scene;
  const sbfi_json *shapes, *materials, *filters, *joints; /* NULL: none */
  sbfi_physics_node *nodes;                               /* (node_count), as in the glTF */
  uint32_t node_count;
  bool is_simulated; /* a body moves by forces, or nothing moves: the file is no animated character */
  uint32_t losses[SBFI_LOSS_COUNT];
};
typedef struct sbfi_physics sbfi_physics;

/* Reads the extensions of the scene's file, and marks nodes with a motion as bones of the scene.
 * `*physics` is NULL if the file has none; otherwise free it with sbfi_physics_free. */
sbf_status sbfi_physics_read(
    sbfi_physics **physics, sbfi_scene *scene, const sbf_allocator *allocator, sbf_diagnostic *error);
void sbfi_physics_free(sbfi_physics *physics);
/* Whether the scene's file names the extension. */
bool sbfi_physics_is_named(const sbfi_scene *scene, const sbf_allocator *allocator);

/* A pass of the conversion, after meshes: makes rigid bodies and joints, and reports what was lost. */
sbf_status sbfi_physics_convert(sbfi_conversion *c);

/* ---- Parts of the pass. They return false with c->error set. ---- */

bool sbfi_physics_convert_bodies(sbfi_conversion *c);
bool sbfi_physics_convert_joints(sbfi_conversion *c);
void sbfi_physics_report(sbfi_conversion *c);

/* Finds the layer and the mask of each collision filter: every distinct set of systems is a layer. The lists
 * are of the arena; a collider without a filter has layer 1 and collides with all. */
typedef struct sbfi_physics_filter {
  uint32_t layer, mask;
} sbfi_physics_filter;
bool sbfi_physics_find_layers(sbfi_conversion *c, const sbfi_physics_filter **filters);

/* ---- Values. A fault names the member and where it stands. ---- */

/* Sets c->error to IMPORT_PHYSICS and returns false. */
bool sbfi_physics_fault(const sbfi_physics *p, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* A finite number; `fallback` if absent. */
bool sbfi_physics_number(
    const sbfi_physics *p, const sbfi_json *object, const char *name, float fallback, float *value);
/* The same, at least `min`, or above it if `above`. */
bool sbfi_physics_number_from(const sbfi_physics *p, const sbfi_json *object, const char *name,
    float fallback, float min, bool above, float *value);
/* `count` numbers; `values` keep what they have if the member is absent. */
bool sbfi_physics_numbers(
    const sbfi_physics *p, const sbfi_json *object, const char *name, uint32_t count, float *values);
/* true or false; false if absent. */
bool sbfi_physics_flag(const sbfi_physics *p, const sbfi_json *object, const char *name, bool *value);
/* Index below `count`; SBF_NONE if absent. */
bool sbfi_physics_index(
    const sbfi_physics *p, const sbfi_json *object, const char *name, uint32_t count, int32_t *index);

/* ---- Geometry ---- */

/* Volume integrals of a solid of density 1. */
typedef struct sbfi_moments {
  double volume, first[3], second[3][3]; /* m^3, m^4, m^5; about the origin */
} sbfi_moments;

/* The collision geometry of a collider in asset space. */
typedef struct sbfi_physics_shape {
  sbfi_array points; /* of sbf_vec3; the caller initializes it */
  sbfi_moments moments;
} sbfi_physics_shape;

/* Adds the geometry of a collider; it adds nothing if the node's scale disables it. */
bool sbfi_physics_add_geometry(
    sbfi_conversion *c, uint32_t node, const sbfi_json *geometry, sbfi_physics_shape *shape);
/* Adds a shape of KHR_implicit_shapes under `to_asset`. */
bool sbfi_physics_add_implicit(
    sbfi_physics *p, uint32_t index, const sbfi_matrix *to_asset, sbfi_physics_shape *shape);
/* Adds the corners of meshes of a node and of the nodes below it; `*found` is false if there are none that
 * can be read. */
bool sbfi_physics_mesh_points(sbfi_physics *p, uint32_t node, sbfi_array *points, bool *found);
/* Adds moments under a linear map and a translation. */
void sbfi_moments_add(sbfi_moments *to, const sbfi_moments *local, const sbfi_matrix *to_asset);
/* Moments of inertia about the center of mass, smallest first, at density 1. */
void sbfi_moments_conclude(const sbfi_moments *moments, sbf_vec3 *center, sbf_vec3 *inertia, sbf_quat *axes);

/* Node to asset space. */
sbfi_matrix sbfi_physics_world(const sbfi_conversion *c, uint32_t node);
/* Transform of a node relative to its parent, as the file states it. */
bool sbfi_physics_local(const sbfi_physics *p, uint32_t node, sbfi_matrix *local);

/* Mass of the motion along or about one coordinate of a joint in the rest pose, kg or kg m^2, with the
 * `locked` coordinates locked: the inverse of the Schur complement of J M^-1 J^T. 0: nothing can move. */
double sbfi_physics_effective_mass(
    const sbf_asset *asset, const sbf_joint *joint, unsigned locked, sbf_joint_axis axis);

#endif
