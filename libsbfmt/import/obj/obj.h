/* Wavefront OBJ to a scene. Keeps source order, and polygons of any size.
 *
 * A file is divided into meshes by its `o` lines, or by its `g` lines if it has no `o`. A mesh has the
 * points of its polygons in file order (points of several meshes are copied), and unused points between
 * them. Each mesh has its own node of the same name. An `o` or `g` without polygons is ignored, as are
 * vertex weights, lines, points and curves. */
#ifndef SBFI_OBJ_H
#define SBFI_OBJ_H

#include "import/obj/obj_text.h"
#include "import/scene/scene.h"

/* Fills a scene after sbfi_scene_init; reads .mtl files beside the OBJ file. On failure the caller frees
 * the scene. `allocator` (may be NULL) is used for scratch memory. */
sbf_status sbfi_obj_read(
    sbfi_scene *scene, const char *bytes, size_t size, const sbf_allocator *allocator, sbf_diagnostic *error);

/* Converts the lists of an OBJ text to nodes and meshes. Keeps the text's material indices. */
sbf_status sbfi_obj_divide(
    sbfi_scene *scene, const sbfi_obj_text *text, const sbf_allocator *allocator, sbf_diagnostic *error);

#endif
