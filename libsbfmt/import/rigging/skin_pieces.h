/* Joins the objects of an OBJ that are one skin, cut along its bones as Blender splits by vertex groups. */
#ifndef SBFI_SKIN_PIECES_H
#define SBFI_SKIN_PIECES_H

#include "import/convert/conversion.h"

/* Before rigging, for a rig without meshes: objects that share most of their borders, at least two of them
 * named like bones, become one object with a message. Sections that are closed stay. Objects of --shell
 * stay. Replaces the conversion's scene if any were joined. False if memory runs out. */
bool sbfi_join_skin_pieces(sbfi_conversion *c);

#endif
