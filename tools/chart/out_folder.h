/* Files that appear in a folder together or not at all: written into another beside it, and moved when all
 * are there. */
#ifndef CHART_OUT_FOLDER_H
#define CHART_OUT_FOLDER_H

#include <stddef.h>

#include "sbfmt/base.h"

typedef struct chart_folder {
  char final_path[4096], temporary[4128];
  bool open;
} chart_folder;

/* Whether a file or folder could be made there, before any work is done: the folder that it is to be in is
 * there. */
sbf_status chart_check_writable(const char *path, sbf_diagnostic *error);
/* Whether files could be put into that folder, which may be there or not. */
sbf_status chart_folder_check(const char *path, sbf_diagnostic *error);

/* Makes the temporary folder. */
sbf_status chart_folder_begin(chart_folder *folder, const char *path, sbf_diagnostic *error);
/* Where to write a file of that name meanwhile; false where the path is too long. */
bool chart_folder_file(const chart_folder *folder, const char *name, char *path, size_t size);
/* Moves all files to the final folder, over older ones of the same names, and makes it if it is not there. */
sbf_status chart_folder_commit(chart_folder *folder, sbf_diagnostic *error);
/* Deletes what is written; fine after a commit. */
void chart_folder_abandon(chart_folder *folder);

#endif
