#include "pose_file.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool pose_file_open(pose_file *p, const char *path, const session *s) {
  *p = (pose_file){.file = NULL};
  if (strlen(path) >= sizeof p->path) return false;
  strcpy(p->path, path);
  snprintf(p->temporary, sizeof p->temporary, "%s.%ld.tmp", path, (long)getpid());
  p->bones = calloc(s->asset->bones.count + 1, sizeof *p->bones);
  p->file = p->bones ? fopen(p->temporary, "w") : NULL;
  if (p->file && fputs("frame,time,bone,px,py,pz,qx,qy,qz,qw\n", p->file) >= 0) return true;
  pose_file_close(p, false);
  return false;
}

bool pose_file_add(pose_file *p, const session *s) {
  sbr_double3 origin = sbr_character_origin(s->world, s->character);
  sbr_character_bones(s->world, s->character, p->bones, s->asset->bones.count);
  bool good = true;
  for (uint32_t i = 0; i < s->asset->bones.count && good; i++) {
    const sbr_transform *b = &p->bones[i];
    good = fprintf(p->file, "%u,%.6f,%s,%.7f,%.7f,%.7f,%.7f,%.7f,%.7f,%.7f\n", s->frame, s->time_s,
               s->asset->bones.at[i].name, origin.x + (double)b->position.x, origin.y + (double)b->position.y,
               origin.z + (double)b->position.z, (double)b->rotation.x, (double)b->rotation.y,
               (double)b->rotation.z, (double)b->rotation.w) > 0;
  }
  return good;
}

bool pose_file_close(pose_file *p, bool keep) {
  if (!p->file && !p->bones) return true;
  bool good = p->file && fflush(p->file) == 0 && fsync(fileno(p->file)) == 0;
  if (p->file) good = fclose(p->file) == 0 && good;
  if (keep && good) good = rename(p->temporary, p->path) == 0;
  if (!keep || !good) unlink(p->temporary);
  free(p->bones);
  *p = (pose_file){.file = NULL};
  return good;
}
