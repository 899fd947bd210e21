#include "recording.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static void write_bytes(void *user, const void *bytes, size_t size) {
  fwrite(bytes, 1, size, user); /* errors are checked at the end */
}

/* Reads the whole file; NULL, with a message, on failure. */
static unsigned char *read_all(const cli_call *call, const char *path, size_t *size) {
  FILE *file = fopen(path, "rb");
  unsigned char *bytes = NULL, *grown;
  size_t capacity = 0;
  *size = 0;
  while (file && !ferror(file) && !feof(file)) {
    if (*size == capacity) {
      capacity = capacity ? 2 * capacity : 65536;
      if (!(grown = realloc(bytes, capacity))) break;
      bytes = grown;
    }
    *size += fread(bytes + *size, 1, capacity - *size, file);
  }
  bool good = file && feof(file) && !ferror(file);
  if (!good) {
    cli_wrong(call, "the recording %s cannot be read: %s", path, errno ? strerror(errno) : "memory ran out");
    free(bytes);
    bytes = NULL;
  }
  if (file) fclose(file);
  return bytes;
}

static int open_replay(recording *r, const cli_call *call, sbr_world *world) {
  sbf_diagnostic error;
  size_t size;
  if (!(r->bytes = read_all(call, r->path, &size))) return SBF_FAILED;
  sbf_status status = sbr_replay_begin(&r->replay, world, r->bytes, size, &error);
  if (status != SBF_OK) cli_print_diagnostic(call, &error);
  if (status != SBF_OK || !r->replay.differs) return (int)status;
  cli_wrong(
      call, "%s begins in another state: use the file and the options with which it was recorded", r->path);
  return SBF_BAD_INPUT;
}

int recording_open(recording *r, const cli_call *call, sbr_world *world) {
  const char *record = cli_value(call, "--record"), *replay = cli_value(call, "--replay");
  *r = (recording){.path = record ? record : replay};
  if (record && replay) return cli_wrong(call, "--record and --replay cannot be combined");
  if (replay && (cli_value(call, "--drive") || cli_value(call, "--script")))
    return cli_wrong(call, "a recording has all input of the character: leave out --drive and --script");
  if (replay) return open_replay(r, call, world);
  if (!record) return SBF_OK;
  if (!(r->file = fopen(record, "wb")))
    return cli_wrong(call, "the recording %s cannot be written: %s", record, strerror(errno));
  const sbr_record_output output = {write_bytes, r->file};
  sbr_world_set_recording(world, &output);
  return SBF_OK;
}

bool recording_finish(recording *r, const cli_call *call, sbr_world *world) {
  if (!r->file) return true;
  sbr_world_set_recording(world, NULL);
  bool good = !ferror(r->file);
  if (fclose(r->file) != 0) good = false;
  r->file = NULL;
  if (good) return true;
  struct stat facts;
  int why = errno;
  if (stat(r->path, &facts) == 0 && S_ISREG(facts.st_mode)) remove(r->path); /* half a recording */
  cli_wrong(call, "the recording %s cannot be written: %s", r->path, strerror(why));
  return false;
}

void recording_close(recording *r) {
  if (r->file) fclose(r->file);
  free(r->bytes);
  *r = (recording){.file = NULL};
}

void recording_report(const recording *r, json_t *object) {
  if (!r->bytes) return;
  const sbr_replay *replay = &r->replay;
  json_object_set_new(object, "replay_same", json_boolean(!replay->differs));
  json_object_set_new(object, "replay_checks", json_integer((json_int_t)replay->checks));
  json_object_set_new(object, "replay_differs_at_tick",
      replay->differs ? json_integer((json_int_t)replay->differs_at_tick) : json_null());
}
