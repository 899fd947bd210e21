/* Joints that are no bones: marks of where the bone before them ends. */
#ifndef SBFI_BONE_ENDS_H
#define SBFI_BONE_ENDS_H

#include <stdbool.h>
#include <stddef.h>

/* Whether a name of so many bytes is that of a joint which only marks the end of the bone before it, as
 * Blender
 * ("Head_end"), 3ds Max ("Toe0Nub") and BVH ("End Site") write them. */
bool sbfi_name_is_end(const char *name, size_t length);

#endif
