/* Files named on the command line, and those below the folders named there. */
#ifndef FILE_LIST_H
#define FILE_LIST_H

#include <stdbool.h>
#include <stddef.h>

typedef struct file_list {
  char **paths; /* in the order given; those of a folder by name */
  size_t count, capacity;
} file_list;

/* Adds a path; of a folder, every .sbf and .sbfz in it and below. Links to folders are not followed. False,
 * with a message on standard error, where a folder cannot be read or memory runs out. What is no folder is
 * added as it is, whether it exists or not. */
bool file_list_add(file_list *list, const char *path);
void file_list_free(file_list *list);

#endif
