#include "base/folder.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

static int by_name(const void *a, const void *b) {
  return strcmp(*(char *const *)a, *(char *const *)b);
}

static bool add(folder_names *names, const char *name) {
  if (names->count == names->capacity) {
    size_t capacity = names->capacity ? 2 * names->capacity : 64;
    char **grown = realloc(names->at, capacity * sizeof *grown);
    if (!grown) return false;
    names->at = grown;
    names->capacity = capacity;
  }
  char *copy = strdup(name);
  if (copy) names->at[names->count++] = copy;
  return copy != NULL;
}

bool folder_list(const char *path, folder_names *names) {
  *names = (folder_names){NULL, 0, 0};
  DIR *listing = opendir(path);
  if (!listing) return false;
  bool good = true;
  for (struct dirent *entry; good && (entry = readdir(listing)) != NULL;)
    if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0) good = add(names, entry->d_name);
  closedir(listing);
  if (!good) {
    folder_names_free(names);
    errno = ENOMEM;
  } else if (names->count) {
    qsort(names->at, names->count, sizeof *names->at, by_name);
  }
  return good;
}

void folder_names_free(folder_names *names) {
  for (size_t i = 0; i < names->count; i++) free(names->at[i]);
  free(names->at);
  *names = (folder_names){NULL, 0, 0};
}
