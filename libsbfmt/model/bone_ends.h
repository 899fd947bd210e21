/* Joints that only mark the end of the bone before them. */
#ifndef SBFI_BONE_ENDS_H
#define SBFI_BONE_ENDS_H

#include <stdbool.h>
#include <stddef.h>

/* Whether a name of `length` bytes belongs to a joint that only marks the end of the bone before it, as
 * written by Blender ("Head_end"), 3ds Max ("Toe0Nub") and BVH ("End Site"). */
bool sbfi_name_is_end(const char *name, size_t length);

#endif
