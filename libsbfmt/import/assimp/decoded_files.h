/* Files for assimp by names as a glTF has them: percent-encoded, which assimp does not decode. */
#ifndef DECODED_FILES_H
#define DECODED_FILES_H

#include <assimp/cfileio.h>

/* Opens a file by its name, else by its decoded name. Reads only. */
extern struct aiFileIO decoded_files;

#endif
