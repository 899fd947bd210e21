/* Conversions under test: what came out, what was said, and scenes made by hand. */
#ifndef TEST_CONVERSIONS_H
#define TEST_CONVERSIONS_H

#include "harness.h"
#include "import/convert/conversion.h"

enum { CONVERTED_NOTES = 256 };

typedef struct converted {
  sbf_asset *asset;
  sbf_diagnostic notes[CONVERTED_NOTES];
  uint32_t note_count;
} converted;

/* Convert a file or scenes; the test fails where that fails, or where the asset is not sound (structure, and
 * no error of the validator). `options` may be NULL. Free with converted_free. */
void converted_file(converted *c, const char *path, const sbf_convert_options *options);
void converted_scene(
    converted *c, const sbfi_scene *scene, const sbfi_scene *rig, const sbf_convert_options *options);
void converted_free(converted *c);

/* How many warnings and notes of a code there were; the first of them, NULL for none. */
uint32_t converted_count(const converted *c, sbf_code code);
const sbf_diagnostic *converted_note(const converted *c, sbf_code code);

/* The item with a name; the test fails if there is none. */
int32_t bone_named(const sbf_asset *a, const char *name);
const sbf_soft_body *body_named(const sbf_asset *a, const char *name);
const sbf_render_mesh *mesh_named(const sbf_asset *a, const char *name);
const sbf_joint *joint_named(const sbf_asset *a, const char *name);

void check_near(sbf_vec3 is, double x, double y, double z, double within);

/* --- Scenes by hand: everything lives in the scene's arena, to be freed with sbfi_scene_free ---------- */

/* An empty scene in metres whose file exists. */
void scene_begin(sbfi_scene *scene);
/* A node at x, y, z from its parent; its number. */
int32_t scene_node(
    sbfi_scene *scene, const char *name, int32_t parent, bool bone, double x, double y, double z);
/* Its transform, to be changed before the meshes and scene_end. */
sbfi_matrix *scene_local(sbfi_scene *scene, int32_t node);
/* A box of 8 points and 6 quads with normals, half a side of each extent, about the node's origin moved by
 * x, y, z; one set of texture coordinates, a corner of its own for each point. */
sbfi_scene_mesh *scene_box(
    sbfi_scene *scene, int32_t node, double half, double x, double y, double z, bool inside_out);
/* Skins the mesh: each point to one joint, `joint_of_point` (8) places in `joints`; bound as the nodes are.
 */
void scene_skin(sbfi_scene *scene, sbfi_scene_mesh *mesh, uint32_t joint_count, const int32_t *joints,
    const uint32_t *joint_of_point);
/* A clip of `count` channels, all to be filled. */
sbfi_scene_channel *scene_clip(sbfi_scene *scene, const char *name, float duration_s, uint32_t count);
/* Worlds of the nodes; before the first mesh that is skinned, and at the end. */
void scene_end(sbfi_scene *scene);

#endif
