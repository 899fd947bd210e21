/* A scene on its way to an asset: what the passes of the conversion share. */
#ifndef SBFI_CONVERSION_H
#define SBFI_CONVERSION_H

#include "base/diagnostic.h"
#include "base/memory.h"
#include "import/scene/scene.h"
#include "sbfmt/convert.h"

/* Ids already given. */
typedef struct sbfi_id_set {
  sbfi_array slots; /* const char *, open addressing; capacity a power of two */
  uint32_t used;
} sbfi_id_set;

typedef struct sbfi_conversion {
  const sbfi_scene *scene; /* the meshes */
  const sbfi_scene *rig;   /* the bones: the same scene where it has its own; NULL where there are none */
  sbfi_matrix to_asset, rig_to_asset;
  double lift_m; /* by which the asset was moved up from where these matrices put it */
  sbf_asset *asset;
  sbfi_arena scratch;
  sbfi_id_set ids;
  int32_t *bone_of_node;              /* (rig->node_count) bone of each node of the rig, or SBF_NONE */
  uint32_t *node_of_bone;             /* (asset->bones.count) */
  int32_t *bone_of_mesh;              /* (scene->mesh_count) bone that carries each mesh, or SBF_NONE */
  const char **name_of_mesh;          /* (scene->mesh_count) what the section is called */
  struct sbfi_locomotion *locomotion; /* how it moves, and why; NULL until judged */
  bool keep_misfit; /* it fails, and the asset shows why: the caller of the library gets it */
  const sbf_convert_options *options;
  sbfi_reporter reporter;
  sbf_diagnostic *error;
} sbfi_conversion;

/* Makes an asset of scenes that have been read: `rig` is the same scene, another, or NULL. */
sbf_status sbfi_convert_scenes(const sbfi_scene *scene, const sbfi_scene *rig,
    const sbf_convert_options *options, sbf_asset **asset, sbf_diagnostic *error);

/* Every pass returns SBF_OK, or a status with c->error filled. */
sbf_status sbfi_convert_skeleton(sbfi_conversion *c);
sbf_status sbfi_match_sections(sbfi_conversion *c);
sbf_status sbfi_convert_materials(sbfi_conversion *c);
sbf_status sbfi_convert_meshes(sbfi_conversion *c);
/* After the meshes: how the character moves (c->locomotion), by its shape, its names and its clips, or as the
 * caller says. */
sbf_status sbfi_evaluate_gait(sbfi_conversion *c);
/* After the meshes: turns what would walk sideways or backwards so that it looks along +Z. */
sbf_status sbfi_face_ahead(sbfi_conversion *c);
/* After the gait: moves what walks onto y = 0. */
sbf_status sbfi_stand_on_ground(sbfi_conversion *c);
/* After the meshes and the ground: a rigid body for each bone that carries sections, joints between those. */
sbf_status sbfi_convert_joints(sbfi_conversion *c);
/* After the ground: the rig's animations, as tracks of bones. */
sbf_status sbfi_convert_clips(sbfi_conversion *c);
/* After the meshes: lengths of bones that end in nothing but a section or a part of a skin. */
sbf_status sbfi_measure_leaf_bones(sbfi_conversion *c);

/* An id that no other object has: kind and name with what an id may not hold replaced, numbered where taken.
 */
const char *sbfi_new_id(sbfi_conversion *c, const char *kind, const char *name);
/* Takes an id that an object has already, and that stays as long as the conversion; false: memory ran out. */
bool sbfi_claim_id(sbfi_conversion *c, const char *id);

/* Whether these are a section's: one that is seen shares its points with the mesh that shows it. */
bool sbfi_is_of_section(const sbf_asset *a, const sbf_vec3_list points);

void sbfi_convert_warn(sbfi_conversion *c, sbf_code code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
sbf_status sbfi_convert_no_memory(sbfi_conversion *c);

static inline void *sbfi_convert_allocate(sbfi_conversion *c, size_t count, size_t size) {
  return sbf_asset_allocate(c->asset, count, size);
}

static inline sbf_vec3 sbfi_transform_point(const sbfi_matrix *m, sbf_vec3 p) {
  double out[3];
  for (int r = 0; r < 3; r++)
    out[r] = m->at[r][0] * (double)p.x + m->at[r][1] * (double)p.y + m->at[r][2] * (double)p.z + m->at[r][3];
  return (sbf_vec3){(float)out[0], (float)out[1], (float)out[2]};
}

static inline double sbfi_matrix_determinant(const sbfi_matrix *m) {
  const double(*a)[4] = m->at;
  return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) -
         a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
         a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
}

#endif
