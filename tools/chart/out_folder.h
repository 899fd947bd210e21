/* Writes a set of files atomically: into a temporary folder beside the final one, which is moved at the
 * end. */
#ifndef CHART_OUT_FOLDER_H
#define CHART_OUT_FOLDER_H

#include <stddef.h>

#include "sbfmt/base.h"

typedef struct chart_folder {
  char final_path[4096], temporary[4128];
  bool open;
} chart_folder;

/* Whether a file or folder can be created there, checked before any work: its parent folder exists. */
sbf_status chart_check_writable(const char *path, sbf_diagnostic *error);
/* Whether files can be written into that folder, which may exist or not. */
sbf_status chart_folder_check(const char *path, sbf_diagnostic *error);

/* Creates the temporary folder. */
sbf_status chart_folder_begin(chart_folder *folder, const char *path, sbf_diagnostic *error);
/* Temporary path of a file with that name; false if the path is too long. */
bool chart_folder_file(const chart_folder *folder, const char *name, char *path, size_t size);
/* Moves all files to the final folder, over older ones with the same names; creates it if necessary. */
sbf_status chart_folder_commit(chart_folder *folder, sbf_diagnostic *error);
/* Deletes what was written; does nothing after a commit. */
void chart_folder_abandon(chart_folder *folder);

#endif
