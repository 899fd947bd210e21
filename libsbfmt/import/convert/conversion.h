/* State of a conversion from scenes to an asset, shared by its passes. */
#ifndef SBFI_CONVERSION_H
#define SBFI_CONVERSION_H

#include "base/diagnostic.h"
#include "base/memory.h"
#include "import/scene/scene.h"
#include "sbfmt/convert.h"

/* Set of used ids. */
typedef struct sbfi_id_set {
  sbfi_array slots; /* const char *, open addressing; capacity a power of two */
  uint32_t used;
} sbfi_id_set;

typedef struct sbfi_conversion {
  const sbfi_scene *scene; /* the meshes */
  const sbfi_scene *rig;   /* source of the bones: the same scene if it has bones; NULL if there are none */
  const sbfi_scene *rig_file; /* what was read of a separate rig; NULL if there is none */
  sbfi_matrix to_asset, rig_to_asset;
  double lift_m;  /* height by which the asset was raised, m */
  double moved_m; /* greatest distance along an axis by which it was moved, m */
  sbf_asset *asset;
  sbfi_arena scratch;
  sbfi_id_set ids;
  int32_t *bone_of_node;        /* (rig->node_count) bone of each node of the rig, or SBF_NONE */
  uint32_t *node_of_bone;       /* (asset->bones.count) */
  int32_t *bone_of_mesh;        /* (scene->mesh_count) bone that each mesh is attached to, or SBF_NONE */
  const char **name_of_mesh;    /* (scene->mesh_count) name of the section */
  struct sbfi_physics *physics; /* the file's own rigid bodies (import/physics); NULL: it has none */
  struct sbfi_locomotion *locomotion; /* locomotion and its reasons; NULL until sbfi_evaluate_gait */
  bool keep_misfit;                   /* return the asset even if conversion fails, to show why */
  const sbf_convert_options *options;
  sbfi_reporter reporter;
  sbf_diagnostic *error;
} sbfi_conversion;

/* Converts scenes to an asset. `rig` is the same scene, another one, or NULL. */
sbf_status sbfi_convert_scenes(const sbfi_scene *scene, const sbfi_scene *rig,
    const sbf_convert_options *options, sbf_asset **asset, sbf_diagnostic *error);

/* Converts a scene with its own rig and, if its file has some, its own rigid bodies (import/physics). */
sbf_status sbfi_convert_own_scene(
    sbfi_scene *scene, const sbf_convert_options *options, sbf_asset **asset, sbf_diagnostic *error);

/* Every pass returns SBF_OK, or a status with c->error filled. */
sbf_status sbfi_convert_skeleton(sbfi_conversion *c);
sbf_status sbfi_match_sections(sbfi_conversion *c);
sbf_status sbfi_convert_materials(sbfi_conversion *c);
sbf_status sbfi_convert_meshes(sbfi_conversion *c);
/* After meshes: determines locomotion (c->locomotion) from shape, names and clips, or from the caller's
 * options. */
sbf_status sbfi_evaluate_gait(sbfi_conversion *c);
/* After meshes: rotates a character that would walk sideways or backwards so that it faces +Z. */
sbf_status sbfi_face_ahead(sbfi_conversion *c);
/* After the gait: moves characters to the origin and onto y = 0. */
sbf_status sbfi_stand_on_ground(sbfi_conversion *c);
/* After the skeleton, of a VRM file: names the chains of its humanoid. */
sbf_status sbfi_convert_humanoid(sbfi_conversion *c);
/* After gait and ground, of a VRM file: its springs become chains that swing. */
sbf_status sbfi_convert_springs(sbfi_conversion *c);
/* After meshes and ground: creates a rigid body for each bone with sections, and joints between them. */
sbf_status sbfi_convert_joints(sbfi_conversion *c);
/* After ground: converts the rig's animations to tracks of bones. */
sbf_status sbfi_convert_clips(sbfi_conversion *c);
/* Last: warns of a size that suggests another unit, and of objects too far from the origin. */
void sbfi_check_size(sbfi_conversion *c);
/* After meshes: measures the length of leaf bones by their sections or skin. */
sbf_status sbfi_measure_leaf_bones(sbfi_conversion *c);

/* Creates a unique id from kind and name: replaces invalid characters and appends a number if it is taken. */
const char *sbfi_new_id(sbfi_conversion *c, const char *kind, const char *name);
/* Reserves an existing id; `id` must outlive the conversion. False if memory runs out. */
bool sbfi_claim_id(sbfi_conversion *c, const char *id);

/* Whether the points belong to a section. A visible section shares its points with its render mesh. */
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
