/* Meshes, clips and images that another program gave other numbers in a glTF file while it kept the
 * extension's text. A mesh is found by its checksum, a clip or an image by its name. */
#ifndef SBFI_RENUMBERED_H
#define SBFI_RENUMBERED_H

#include "gltf/mesh_lists.h"
#include "gltf/soft_body_reader.h"

/* The render mesh of a glTF file: its number, the number of its vertices and its checksum as stated. */
typedef struct sbfi_stated_mesh {
  uint32_t number, vertex_count, crc32;
  sbf_u32_list sizes, materials; /* of its polygons */
} sbfi_stated_mesh;

/* Finds the vertices of a stated mesh. Under its own number it must have the checksum; if it has not, another
 * mesh with it is reported and used if the load repairs, and named in the error otherwise. False, with the
 * file's error set, if there is none. */
bool sbfi_find_stated_mesh(sbfi_gltf_reader *r, const sbfi_stated_mesh *stated, sbfi_mesh_vertices *vertices);

/* Item `number` of a list such as "animations", or the only other one of that name if the item has another
 * name: as above. An item that was renamed is taken. NULL, with the file's error set, if there is none. */
const sbfi_json *sbfi_find_named_item(
    sbfi_gltf_reader *r, const char *list, uint32_t number, const char *name);

#endif
