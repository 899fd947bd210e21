/* Shared by the parts of the MJCF writer. Everything is rotated from +Y up to MuJoCo's +Z up, by 90
 * degrees about +X. Bodies have no rotation at rest, like the asset's rigid bodies. */
#ifndef SBFI_MJCF_H
#define SBFI_MJCF_H

#include "export/exporting.h"

typedef struct mjcf_flex {
  const sbf_soft_body *body;
  const sbf_level *level;              /* NULL: nothing of it can be written */
  int dim;                             /* 3: tetrahedra, 2: a sheet's triangles, 1: springs */
  int32_t *holder;                     /* (points) pin set that fixes it, or SBF_NONE */
  sbf_vec3 *positions;                 /* (points) at rest, asset space */
  float *masses;                       /* (points) */
  uint32_t contact_type, contact_with; /* MuJoCo's bits */
} mjcf_flex;

/* Arrays with an item per rigid body. */
typedef struct mjcf_rigid {
  bool *elastic; /* moves points of elastic elements, which rules out a mocap body in MuJoCo */
  int32_t *parent;
  bool *is_written;
  struct mjcf_extent *hull_extents;
  uint32_t *hull_partners; /* bits of the flexes that it collides with */
  uint8_t *jointed;        /* scratch */
} mjcf_rigid;

/* Counts of parts that the format cannot store. */
typedef struct mjcf_unsupported {
  uint32_t soft_limits, drives, breaking, touching, loops, pulleys, massless, velocities, without_level,
      loop_bounds, goals, moduli, ratios, bending, sharing, selves;
} mjcf_unsupported;

typedef struct mjcf_writer {
  sbfi_export *e;
  sbfi_arena scratch;
  mjcf_flex *flexes;   /* (soft bodies) */
  bool *bone_has_pins; /* (bones) */
  bool *bone_elastic;  /* (bones) moves points of elastic elements, which rules out a mocap body in MuJoCo */
  uint32_t *first, *next; /* (rigid bodies + 1), (2 * joints): lists of the joints' ends at each body; the
                             last: the world */
  bool *is_tree;          /* (joints) connects a body to its parent */
  mjcf_rigid rigid;
  mjcf_unsupported unsupported;
} mjcf_writer;

/* A missing end of a joint. */
#define MJCF_END UINT32_MAX

sbf_vec3 sbfi_mjcf_from_asset(sbf_vec3 v);
sbf_vec3 sbfi_mjcf_rotated(sbf_quat q, sbf_vec3 v);
void sbfi_mjcf_write_vec3(mjcf_writer *w, const char *name, sbf_vec3 asset_space); /* an attribute, rotated */
void sbfi_mjcf_write_f32(mjcf_writer *w, const char *name, float value);
/* The id as a word in an XML attribute's list: characters other than letters, digits, '_', '-' and '.'
 * become '_'; then the index is appended, to keep ids distinct. */
void sbfi_mjcf_name(mjcf_writer *w, const char *id, uint32_t index);
void sbfi_mjcf_rigid_name(mjcf_writer *w, int32_t body); /* SBF_NONE: world */

float sbfi_mjcf_point_mass(const mjcf_flex *flex, uint32_t point); /* kg; never 0 */
float sbfi_mjcf_ratio(const sbf_soft_body *body);                  /* Poisson's ratio, as MuJoCo accepts it */

/* Each returns false if memory runs out. */
bool sbfi_mjcf_collect_flexes(mjcf_writer *w);
/* The single modulus (Pa) or stiffness (N/m) of a flex, the mean if its elements `differ`. */
bool sbfi_mjcf_matter(mjcf_writer *w, const mjcf_flex *flex, float *value, bool *differ);
/* Stable time step of the written model in seconds. */
bool sbfi_mjcf_timestep(mjcf_writer *w, float *step);
bool sbfi_mjcf_collect_joints(mjcf_writer *w);
bool sbfi_mjcf_collect_contacts(mjcf_writer *w); /* after the flexes */
void sbfi_mjcf_write_holders_and_points(mjcf_writer *w);
bool sbfi_mjcf_write_flexes(mjcf_writer *w);
void sbfi_mjcf_write_meshes(mjcf_writer *w);
void sbfi_mjcf_write_bodies(mjcf_writer *w);
void sbfi_mjcf_write_joint(mjcf_writer *w, const sbf_joint *joint, uint32_t index, bool forward);
void sbfi_mjcf_write_constraints(mjcf_writer *w); /* joints outside the tree */
/* contype and conaffinity. */
void sbfi_mjcf_flex_bits(mjcf_writer *w, const mjcf_flex *flex);
void sbfi_mjcf_hull_bits(mjcf_writer *w, uint32_t body);
void sbfi_mjcf_write_excludes(mjcf_writer *w);

#endif
