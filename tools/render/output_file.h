/* A file that is there whole or not at all: written beside its place under another name, then renamed. For
 * what others write by name (ffmpeg) or by stream (libpng). */
#ifndef RENDER_OUTPUT_FILE_H
#define RENDER_OUTPUT_FILE_H

#include "sbfmt/base.h"

typedef struct output_file {
  const char *given;  /* the caller's path, for messages: must stay until the end */
  char *final_path;   /* where it shall stand: links followed */
  char *written_path; /* where to write it: in the same folder; final_path again where that is no regular file
                       */
  bool direct;        /* that is so: a device or a pipe, with no such promise */
} output_file;

/* Makes the empty temporary file, so that an unwritable place is known before any work is done. An existing
 * file keeps its permissions, and is refused where it may not be written. Where the process is ended by an
 * interrupt, a hang-up or a request to terminate before commit or abandon, the temporary file goes with it.
 * One at a time in a process: SBF_FAILED for a second. */
sbf_status output_file_begin(output_file *output, const char *path, sbf_diagnostic *diagnostic);

/* A process that is writing the file, to be ended along with this one; 0: none any more. */
void output_file_tie(int process);

sbf_status output_file_commit(output_file *output, sbf_diagnostic *diagnostic); /* ended either way */
void output_file_abandon(output_file *output);                                  /* fine when ended or {0} */

#endif
