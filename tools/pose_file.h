/* Poses as CSV: rows `frame,time,bone,px,py,pz,qx,qy,qz,qw` in world space. */
#ifndef POSE_FILE_H
#define POSE_FILE_H

#include "base/output_file.h"
#include "session.h"

typedef struct pose_file {
  FILE *file;
  output_file output;
  sbr_transform *bones;
} pose_file;

/* `path` must stay valid until the end. */
sbf_status pose_file_open(pose_file *p, const char *path, const session *s, sbf_diagnostic *error);
sbf_status pose_file_add(pose_file *p, const session *s, sbf_diagnostic *error);
/* Renames the complete file to its final path, or deletes it. Does nothing if never opened. */
sbf_status pose_file_close(pose_file *p, bool keep, sbf_diagnostic *error);

#endif
