/* Files named on the command line, and those in the folders named there. */
#ifndef FILE_LIST_H
#define FILE_LIST_H

#include <stdbool.h>
#include <stddef.h>

typedef struct file_list {
  char **paths; /* in command line order; those of a folder by name */
  size_t count, capacity;
} file_list;

/* Adds a path; for a folder, every .sbf and .sbfz in it and below. Links to folders are not followed. A path
 * that is not a folder is added unchanged, whether it exists or not. Returns false, with a message on
 * standard error, if a folder cannot be read or memory runs out. */
bool file_list_add(file_list *list, const char *path);
void file_list_free(file_list *list);

#endif
