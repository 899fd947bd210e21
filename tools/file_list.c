#include "file_list.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

enum { DEEPEST = 64 };

static bool out_of_memory(void) {
  fprintf(stderr, "sbfmt: error: memory ran out while files were listed\n");
  return false;
}

/* Takes ownership of the path, also on failure. */
static bool keep(file_list *list, char *path) {
  if (!path) return out_of_memory();
  if (list->count == list->capacity) {
    size_t capacity = list->capacity ? 2 * list->capacity : 64;
    char **grown = realloc(list->paths, capacity * sizeof *grown);
    if (!grown) {
      free(path);
      return out_of_memory();
    }
    list->paths = grown;
    list->capacity = capacity;
  }
  list->paths[list->count++] = path;
  return true;
}

static bool ends_with(const char *name, const char *ending) {
  size_t length = strlen(name), tail = strlen(ending);
  return length > tail && strcasecmp(name + length - tail, ending) == 0;
}

static int by_name(const void *a, const void *b) {
  return strcmp(*(char *const *)a, *(char *const *)b);
}

/* All files of the folder, sorted by name, without hidden ones. */
static bool read_folder(const char *folder, file_list *entries) {
  DIR *directory = opendir(folder);
  if (!directory) {
    fprintf(stderr, "sbfmt: error: the folder %s cannot be read: %s\n", folder, strerror(errno));
    return false;
  }
  bool good = true;
  size_t length = strlen(folder);
  while (length > 1 && folder[length - 1] == '/') length--;
  for (struct dirent *entry; good && (entry = readdir(directory));) {
    if (entry->d_name[0] == '.') continue;
    size_t capacity = length + 1 + strlen(entry->d_name) + 1;
    char *path = malloc(capacity);
    if (path)
      snprintf(path, capacity, "%.*s%s%s", (int)length, folder, folder[length - 1] == '/' ? "" : "/",
          entry->d_name);
    good = keep(entries, path);
  }
  closedir(directory);
  if (entries->count) qsort(entries->paths, entries->count, sizeof *entries->paths, by_name);
  return good;
}

static bool add_folder(file_list *list, const char *folder, int depth) {
  file_list entries = {NULL, 0, 0};
  bool good = read_folder(folder, &entries);
  for (size_t i = 0; i < entries.count && good; i++) {
    struct stat is;
    if (lstat(entries.paths[i], &is) != 0) continue;
    if (S_ISDIR(is.st_mode) && depth < DEEPEST)
      good = add_folder(list, entries.paths[i], depth + 1);
    else if (!S_ISDIR(is.st_mode) &&
             (ends_with(entries.paths[i], ".sbf") || ends_with(entries.paths[i], ".sbfz")))
      good = keep(list, strdup(entries.paths[i]));
  }
  file_list_free(&entries);
  return good;
}

bool file_list_add(file_list *list, const char *path) {
  struct stat is;
  if (stat(path, &is) == 0 && S_ISDIR(is.st_mode)) return add_folder(list, path, 0);
  return keep(list, strdup(path));
}

void file_list_free(file_list *list) {
  for (size_t i = 0; i < list->count; i++) free(list->paths[i]);
  free(list->paths);
  *list = (file_list){NULL, 0, 0};
}
