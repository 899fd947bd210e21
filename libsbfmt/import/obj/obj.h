/* Wavefront OBJ to a scene. Source order is kept, and polygons of any size.
 *
 * A file is divided into meshes by its lines `o`, or by its lines `g` where it has no `o`. Each has the
 * points its polygons use, in the file's order (a point that two of them use is in both), and the points no
 * polygon uses that stand among them. A mesh lies under a node of its own with the same name. An `o` or `g`
 * without polygons makes none. Vertex colours and weights, lines, points and curves are passed over. */
#ifndef SBFI_OBJ_H
#define SBFI_OBJ_H

#include "import/obj/obj_text.h"
#include "import/scene/scene.h"

/* Fills a scene made by sbfi_scene_init; reads .mtl files beside the OBJ file. On failure the caller frees
 * the scene. `allocator` (may be NULL) is used for scratch memory. */
sbf_status sbfi_obj_read(
    sbfi_scene *scene, const char *bytes, size_t size, const sbf_allocator *allocator, sbf_diagnostic *error);

/* Converts the lists of an OBJ text to nodes and meshes. Keeps the text's material indices. */
sbf_status sbfi_obj_divide(
    sbfi_scene *scene, const sbfi_obj_text *text, const sbf_allocator *allocator, sbf_diagnostic *error);

#endif
