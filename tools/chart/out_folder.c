#include "chart/out_folder.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/fault.h"
#include "base/folder.h"
#include "base/system.h"

enum { MAX_PATH = 4096 };

static sbf_status cannot(sbf_diagnostic *error, const char *path, const char *what) {
  return fault_set_file(error, SBF_CODE_IO_CANNOT_WRITE, path, "%s: %s", what, strerror(errno));
}

/* Folder that contains `path`. */
static void parent_of(const char *path, char *to, size_t size) {
  size_t length = strlen(path);
  while (length > 1 && path[length - 1] == '/') length--;
  while (length && path[length - 1] != '/') length--;
  while (length > 1 && path[length - 1] == '/') length--;
  snprintf(to, size, "%.*s", length ? (int)length : 1, length ? path : ".");
}

sbf_status chart_check_writable(const char *path, sbf_diagnostic *error) {
  char parent[MAX_PATH];
  if (!*path || strlen(path) > sizeof parent - 8)
    return fault_set_file(error, SBF_CODE_IO_CANNOT_WRITE, path, "this is no path to write to");
  parent_of(path, parent, sizeof parent);
  if (!system_is_folder(parent, true))
    return fault_set_file(error, SBF_CODE_IO_CANNOT_WRITE, path,
        "there is no folder '%s' to make this in: make it first", parent);
  if (!system_can_write_folder(parent)) return cannot(error, parent, "this folder cannot be written to");
  return SBF_OK;
}

sbf_status chart_folder_check(const char *path, sbf_diagnostic *error) {
  struct stat is;
  bool exists = stat(path, &is) == 0;
  if (!*path || strlen(path) > MAX_PATH - 8)
    return fault_set_file(error, SBF_CODE_IO_CANNOT_WRITE, path, "this is no path for a folder");
  if (exists && !S_ISDIR(is.st_mode))
    return fault_set_file(
        error, SBF_CODE_IO_CANNOT_WRITE, path, "there is a file of that name: name a folder");
  if (exists && !system_can_write_folder(path))
    return cannot(error, path, "this folder cannot be written to");
  return chart_check_writable(path, error);
}

sbf_status chart_folder_begin(chart_folder *folder, const char *path, sbf_diagnostic *error) {
  *folder = (chart_folder){.open = false};
  size_t length = strlen(path);
  while (length > 1 && path[length - 1] == '/') length--;
  snprintf(folder->final_path, sizeof folder->final_path, "%.*s", (int)length, path);
  snprintf(folder->temporary, sizeof folder->temporary, "%s.XXXXXX", folder->final_path);
  if (!system_make_unique_folder(folder->temporary))
    return cannot(error, folder->temporary, "this folder cannot be made");
  folder->open = true;
  return SBF_OK;
}

bool chart_folder_file(const chart_folder *folder, const char *name, char *path, size_t size) {
  return snprintf(path, size, "%s/%s", folder->temporary, name) < (int)size;
}

/* Calls `act` for every file in the temporary folder until it returns false. */
static bool each_file(const chart_folder *folder, bool (*act)(const chart_folder *folder, const char *name)) {
  folder_names names;
  if (!folder_list(folder->temporary, &names)) return false;
  bool good = true;
  for (size_t i = 0; good && i < names.count; i++) good = act(folder, names.at[i]);
  folder_names_free(&names);
  return good;
}

static bool join(char to[4608], const char *folder, const char *name) {
  return snprintf(to, 4608, "%s/%s", folder, name) < 4608;
}

static bool move_one(const chart_folder *folder, const char *name) {
  char from[4608], to[4608];
  return join(from, folder->temporary, name) && join(to, folder->final_path, name) &&
         system_replace_file(from, to);
}

static bool delete_one(const chart_folder *folder, const char *name) {
  char path[4608];
  return join(path, folder->temporary, name) && unlink(path) == 0;
}

sbf_status chart_folder_commit(chart_folder *folder, sbf_diagnostic *error) {
  if (rename(folder->temporary, folder->final_path) == 0) { /* it did not exist, or was empty */
    folder->open = false;
    return SBF_OK;
  }
  if (!each_file(folder, move_one)) {
    sbf_status status = cannot(error, folder->final_path, "the charts cannot be moved here");
    chart_folder_abandon(folder);
    return status;
  }
  rmdir(folder->temporary);
  folder->open = false;
  return SBF_OK;
}

void chart_folder_abandon(chart_folder *folder) {
  if (!folder->open) return;
  each_file(folder, delete_one);
  rmdir(folder->temporary);
  folder->open = false;
}
