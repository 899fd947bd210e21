/* The 2012 dialect, <model>: the form of a paper of that year, an element for each vertex (section 16 of the
 * specification). What a file says, in the file's words: numbers are ids, angles degrees. */
#ifndef SBFI_DIALECT2012_H
#define SBFI_DIALECT2012_H

#include "base/memory.h"
#include "import/convert/conversion.h"

/* Things with a number and a place: ids beside values, in the order of the file. */
typedef struct sbfi_paper_items {
  sbfi_array ids;    /* uint32_t */
  sbfi_array values; /* sbf_vec3, or sbf_vec2 of texture coordinates */
} sbfi_paper_items;

typedef struct sbfi_paper_corner {
  uint32_t vertex, normal, coordinate; /* ids; 0: none, for the last two */
} sbfi_paper_corner;

typedef struct sbfi_paper_surface {
  sbfi_paper_items vertices, normals, coordinates;
  sbfi_array sizes;   /* uint32_t, corners of each face */
  sbfi_array corners; /* sbfi_paper_corner */
} sbfi_paper_surface;

/* A vertex of the surface in a tetrahedron: weights of its first three nodes. */
typedef struct sbfi_paper_carried {
  uint32_t vertex, tetrahedron; /* ids */
  float weights[3];
} sbfi_paper_carried;

typedef enum sbfi_paper_attribute {
  SBFI_PAPER_MASS,
  SBFI_PAPER_VOLUME_STIFFNESS,
  SBFI_PAPER_STRETCHING_STIFFNESS,
  SBFI_PAPER_FRICTION,
  SBFI_PAPER_PARTICLE_RADIUS,
  SBFI_PAPER_SOLVER_ITERATIONS,
  SBFI_PAPER_ATTRIBUTES
} sbfi_paper_attribute;

/* A soft body or a rigid one; the latter has a surface and attributes only. */
typedef struct sbfi_paper_body {
  uint32_t id;
  sbfi_paper_items lattice;
  sbfi_array nodes;           /* uint32_t, ids, four a tetrahedron */
  sbfi_array tetrahedron_ids; /* uint32_t */
  sbfi_paper_surface surface;
  sbfi_array carried; /* sbfi_paper_carried */
  float attributes[SBFI_PAPER_ATTRIBUTES];
  bool given[SBFI_PAPER_ATTRIBUTES];
} sbfi_paper_body;

typedef struct sbfi_paper_limit {
  sbf_joint_axis target;
  float angle; /* degrees, or lengths of linear motions */
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
  uint32_t ignored_count,
      ignored_line; /* elements that the dialect does not have, and the first one's line */
  char ignored_name[64];
} sbfi_paper_model;

/* Whether the file is of this dialect: its name ends in .xml and its root is <model>. */
bool sbfi_paper_knows(const char *path);

/* Reads the file; on failure the model is empty. */
sbf_status sbfi_paper_read(
    sbfi_paper_model *model, const char *path, const sbf_allocator *allocator, sbf_diagnostic *error);
void sbfi_paper_free(sbfi_paper_model *model);

/* Where the item of a number stands; false, with the failure in c->error, where there is none. `what` names
 * the item in the message. A table is made once for each list. */
typedef struct sbfi_paper_table {
  const uint32_t *ids; /* as in the file */
  uint64_t *sorted;    /* id and place; NULL: the ids count from 1 */
  uint32_t count;
} sbfi_paper_table;
bool sbfi_paper_table_make(
    sbfi_conversion *c, sbfi_paper_table *table, const sbfi_array *ids, const char *what);
bool sbfi_paper_find(
    sbfi_conversion *c, const sbfi_paper_table *table, uint32_t id, const char *what, uint32_t *slots);

/* The status that goes with c->error after one of the two has failed. */
static inline sbf_status sbfi_paper_fault(const sbfi_conversion *c) {
  return c->error->code == SBF_CODE_OUT_OF_MEMORY ? SBF_FAILED : SBF_BAD_INPUT;
}

/* Fills a polygon mesh with the surface's points and faces. */
sbf_status sbfi_paper_polygons(
    sbfi_conversion *c, const sbfi_paper_surface *surface, const char *what, sbf_polygon_mesh *mesh);

/* Fills the conversion's asset; c->scene is not read. */
sbf_status sbfi_convert_paper(sbfi_conversion *c, const sbfi_paper_model *model, const char *name);
/* The rigid bodies and joints, before the soft bodies. */
sbf_status sbfi_convert_paper_skeleton(sbfi_conversion *c, const sbfi_paper_model *model);

#endif
