#include "file_list.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/folder.h"
#include "base/system.h"

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

static char *join(const char *folder, const char *name) {
  size_t length = strlen(folder);
  while (length > 1 && folder[length - 1] == '/') length--;
  size_t capacity = length + 1 + strlen(name) + 1;
  char *path = malloc(capacity);
  if (path)
    snprintf(path, capacity, "%.*s%s%s", (int)length, folder, folder[length - 1] == '/' ? "" : "/", name);
  return path;
}

static bool add_folder(file_list *list, const char *folder, int depth);

/* Adds a bundle, or those of a folder below; hidden files and others are left out. */
static bool add_entry(file_list *list, const char *folder, const char *name, int depth) {
  if (name[0] == '.') return true;
  char *path = join(folder, name);
  if (!path) return out_of_memory();
  bool is_folder = system_is_folder(path, false);
  if (!is_folder && (ends_with(name, ".sbf") || ends_with(name, ".sbfz"))) return keep(list, path);
  bool good = !is_folder || depth >= DEEPEST || add_folder(list, path, depth + 1);
  free(path);
  return good;
}

static bool add_folder(file_list *list, const char *folder, int depth) {
  folder_names names;
  if (!folder_list(folder, &names)) {
    fprintf(stderr, "sbfmt: error: the folder %s cannot be read: %s\n", folder, strerror(errno));
    return false;
  }
  bool good = true;
  for (size_t i = 0; i < names.count && good; i++) good = add_entry(list, folder, names.at[i], depth);
  folder_names_free(&names);
  return good;
}

bool file_list_add(file_list *list, const char *path) {
  if (system_is_folder(path, true)) return add_folder(list, path, 0);
  return keep(list, strdup(path));
}

void file_list_free(file_list *list) {
  for (size_t i = 0; i < list->count; i++) free(list->paths[i]);
  free(list->paths);
  *list = (file_list){NULL, 0, 0};
}
