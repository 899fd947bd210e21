/* The 2012 dialect, <model>: the format of a paper of that year, with one element per vertex (section 16
 * of the specification). The model keeps the file's values: ids as numbers, angles in degrees. */
#ifndef SBFI_DIALECT2012_H
#define SBFI_DIALECT2012_H

#include "base/memory.h"
#include "import/convert/conversion.h"

/* Numbered items with positions: ids and values as parallel arrays in file order. */
typedef struct sbfi_paper_items {
  sbfi_array ids;    /* uint32_t */
  sbfi_array values; /* sbf_vec3, or sbf_vec2 of texture coordinates */
} sbfi_paper_items;

typedef struct sbfi_paper_corner {
  uint32_t vertex, normal, coordinate; /* ids; 0: none (normal and coordinate only) */
} sbfi_paper_corner;

typedef struct sbfi_paper_surface {
  sbfi_paper_items vertices, normals, coordinates;
  sbfi_array sizes;   /* uint32_t, corners of each face */
  sbfi_array corners; /* sbfi_paper_corner */
} sbfi_paper_surface;

/* A surface vertex embedded in a tetrahedron: weights of its first three nodes. */
typedef struct sbfi_paper_embedding {
  uint32_t vertex, tetrahedron; /* ids */
  float weights[3];
} sbfi_paper_embedding;

typedef enum sbfi_paper_attribute {
  SBFI_PAPER_MASS,
  SBFI_PAPER_VOLUME_STIFFNESS,
  SBFI_PAPER_STRETCHING_STIFFNESS,
  SBFI_PAPER_FRICTION,
  SBFI_PAPER_PARTICLE_RADIUS,
  SBFI_PAPER_SOLVER_ITERATIONS,
  SBFI_PAPER_ATTRIBUTES
} sbfi_paper_attribute;

/* A soft or rigid body; a rigid one has only a surface and attributes. */
typedef struct sbfi_paper_body {
  uint32_t id;
  sbfi_paper_items lattice;
  sbfi_array nodes;           /* uint32_t, ids, four per tetrahedron */
  sbfi_array tetrahedron_ids; /* uint32_t */
  sbfi_paper_surface surface;
  sbfi_array embedded_vertices; /* sbfi_paper_embedding */
  float attributes[SBFI_PAPER_ATTRIBUTES];
  bool given[SBFI_PAPER_ATTRIBUTES];
} sbfi_paper_body;

typedef struct sbfi_paper_limit {
  sbf_joint_axis target;
  float angle; /* degrees; a length for linear motions */
} sbfi_paper_limit;

typedef struct sbfi_paper_joint {
  sbf_joint_kind kind;
  uint32_t bodies[2]; /* ids; 0: none */
  uint32_t first_limit, limit_count;
} sbfi_paper_joint;

typedef struct sbfi_paper_model {
  sbf_allocator allocator;
  sbfi_array soft_bodies, rigid_bodies; /* sbfi_paper_body */
  sbfi_array joints, limits;            /* sbfi_paper_joint, sbfi_paper_limit */
  uint32_t ignored_count, ignored_line; /* unknown elements, and the line of the first */
  char ignored_name[64];
} sbfi_paper_model;

/* Whether the file has this dialect: its name ends in .xml and its root is <model>. */
bool sbfi_paper_supports(const char *path);

/* Reads the file; on failure the model is empty. */
sbf_status sbfi_paper_read(
    sbfi_paper_model *model, const char *path, const sbf_allocator *allocator, sbf_diagnostic *error);
void sbfi_paper_free(sbfi_paper_model *model);

/* Looks up the index of an item by id; false, with c->error filled, if it does not exist. `what` names the
 * item in the message. Each list needs one table. */
typedef struct sbfi_paper_table {
  const uint32_t *ids; /* as in the file */
  uint64_t *sorted;    /* id and index; NULL: the ids count from 1 */
  uint32_t count;
} sbfi_paper_table;
bool sbfi_paper_table_make(
    sbfi_conversion *c, sbfi_paper_table *table, const sbfi_array *ids, const char *what);
bool sbfi_paper_find(
    sbfi_conversion *c, const sbfi_paper_table *table, uint32_t id, const char *what, uint32_t *slots);

/* Status for c->error after one of the two functions has failed. */
static inline sbf_status sbfi_paper_fault(const sbfi_conversion *c) {
  return c->error->code == SBF_CODE_OUT_OF_MEMORY ? SBF_FAILED : SBF_BAD_INPUT;
}

/* Fills a polygon mesh with the surface's points and faces. */
sbf_status sbfi_paper_polygons(
    sbfi_conversion *c, const sbfi_paper_surface *surface, const char *what, sbf_polygon_mesh *mesh);

/* Fills the conversion's asset without use of c->scene. */
sbf_status sbfi_convert_paper(sbfi_conversion *c, const sbfi_paper_model *model, const char *name);
/* Converts rigid bodies and joints, before the soft bodies. */
sbf_status sbfi_convert_paper_skeleton(sbfi_conversion *c, const sbfi_paper_model *model);

#endif
