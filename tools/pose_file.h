/* Poses as CSV: rows `frame,time,bone,px,py,pz,qx,qy,qz,qw` in world space. */
#ifndef POSE_FILE_H
#define POSE_FILE_H

#include "session.h"

typedef struct pose_file {
  FILE *file;
  char path[1024], temporary[1040];
  sbr_transform *bones;
} pose_file;

/* False where it cannot be made; errno says why. */
bool pose_file_open(pose_file *p, const char *path, const session *s);
bool pose_file_add(pose_file *p, const session *s);
/* Renames the complete file into its place, or removes what was written. False where that fails. */
bool pose_file_close(pose_file *p, bool keep);

#endif
