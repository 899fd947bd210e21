/* Writes a file atomically: under another name in the same folder, then renamed. For writers that need a
 * name (ffmpeg) or a stream (libpng). */
#ifndef BASE_OUTPUT_FILE_H
#define BASE_OUTPUT_FILE_H

#include "sbfmt/base.h"

typedef struct output_file {
  const char *given;  /* the caller's path, for messages: must stay valid until the end */
  char *final_path;   /* final path with links resolved */
  char *written_path; /* path to write to: in the same folder; final_path if that is not a regular file */
  bool direct;        /* not a regular file: a device or a pipe, which is not written atomically */
} output_file;

/* Creates the empty temporary file, so that an unwritable path is found before any work is done. An
 * existing file keeps its permissions, and is rejected if it is not writable. If the process is
 * interrupted, hung up or terminated before commit or abandon, the temporary file is deleted. One at a
 * time per process: SBF_FAILED for a second. */
sbf_status output_file_begin(output_file *output, const char *path, sbf_diagnostic *diagnostic);

/* A child_pipe's process that writes the file and is killed together with this one; 0: none any more. */
void output_file_tie(intptr_t process);

sbf_status output_file_commit(output_file *output, sbf_diagnostic *diagnostic); /* ends it in any case */
void output_file_abandon(output_file *output); /* does nothing if ended or {0} */

/* ---- output_file.c, for the files of each system ---- */

void output_file_release(output_file *output);
/* Each releases it, and returns its status: for an errno, and if memory ran out. */
sbf_status output_file_refuse(output_file *output, int why, sbf_diagnostic *diagnostic);
sbf_status output_file_no_memory(output_file *output, sbf_diagnostic *diagnostic);

#endif
