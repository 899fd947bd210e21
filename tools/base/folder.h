/* The names in a folder. */
#ifndef BASE_FOLDER_H
#define BASE_FOLDER_H

#include <stdbool.h>
#include <stddef.h>

typedef struct folder_names {
  char **at; /* sorted by their bytes, without "." and ".." */
  size_t count, capacity;
} folder_names;

/* False with errno if the folder cannot be read or memory runs out; `names` is empty then. Free it with
 * folder_names_free. */
bool folder_list(const char *path, folder_names *names);
void folder_names_free(folder_names *names);

#endif
