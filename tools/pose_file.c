#include "pose_file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "base/fault.h"
#include "base/system.h"

static sbf_status fault(const pose_file *p, int why, sbf_diagnostic *error) {
  return fault_set_file(error, SBF_CODE_IO_CANNOT_WRITE, p->output.given,
      "cannot write: %s; check the folder, its permissions and the free space", strerror(why));
}

sbf_status pose_file_open(pose_file *p, const char *path, const session *s, sbf_diagnostic *error) {
  *p = (pose_file){.file = NULL};
  sbf_status status = output_file_begin(&p->output, path, error);
  if (status != SBF_OK) return status;
  p->bones = calloc(s->asset->bones.count + 1, sizeof *p->bones);
  p->file = p->bones ? fopen(p->output.written_path, "wb") : NULL;
  if (p->file && fputs("frame,time,bone,px,py,pz,qx,qy,qz,qw\n", p->file) >= 0) return SBF_OK;
  status = fault(p, errno, error);
  pose_file_close(p, false, NULL);
  return status;
}

/* A name as a CSV field: quoted, with doubled quotes, if it contains separators. */
static bool put_name(FILE *file, const char *name) {
  if (!strpbrk(name, ",\"\r\n")) return fputs(name, file) >= 0;
  bool good = fputc('"', file) != EOF;
  for (; *name && good; name++) good = (*name != '"' || fputc('"', file) != EOF) && fputc(*name, file) != EOF;
  return good && fputc('"', file) != EOF;
}

sbf_status pose_file_add(pose_file *p, const session *s, sbf_diagnostic *error) {
  sbr_double3 origin = sbr_character_get_origin(s->world, s->character);
  sbr_character_get_bones(s->world, s->character, p->bones, s->asset->bones.count);
  bool good = true;
  for (uint32_t i = 0; i < s->asset->bones.count && good; i++) {
    const sbr_transform *b = &p->bones[i];
    good = fprintf(p->file, "%u,%.6f,", s->frame, s->time_s) > 0 &&
           put_name(p->file, s->asset->bones.at[i].name) &&
           fprintf(p->file, ",%.7f,%.7f,%.7f,%.7f,%.7f,%.7f,%.7f\n", origin.x + (double)b->position.x,
               origin.y + (double)b->position.y, origin.z + (double)b->position.z, (double)b->rotation.x,
               (double)b->rotation.y, (double)b->rotation.z, (double)b->rotation.w) > 0;
  }
  return good ? SBF_OK : fault(p, errno, error);
}

sbf_status pose_file_close(pose_file *p, bool keep, sbf_diagnostic *error) {
  sbf_status status = SBF_OK;
  if (p->file) {
    bool good = fflush(p->file) == 0 && (p->output.direct || system_sync_file(p->file));
    int why = errno;
    if (fclose(p->file) != 0 && good) good = false, why = errno;
    if (keep && !good) status = fault(p, why, error);
    if (keep && good) status = output_file_commit(&p->output, error);
  }
  output_file_abandon(&p->output);
  free(p->bones);
  *p = (pose_file){.file = NULL};
  return status;
}
