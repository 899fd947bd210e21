#include "motion_bake.h"

#include <stdlib.h>

typedef struct frames {
  sbf_vec3 *skin, *heads;
  sbf_quat *turns;
  sbr_transform *bones;
  uint32_t points, bone_count;
} frames;

bool motion_asked(const cli_call *call) {
  return cli_value(call, "--seconds") || cli_value(call, "--script") || cli_value(call, "--replay");
}

static bool reserve(frames *f, const session *s) {
  size_t count = (size_t)s->frame_count + 1;
  for (uint32_t i = 0; i < s->asset->render_meshes.count; i++)
    f->points += s->asset->render_meshes.at[i].mesh.positions.count;
  f->bone_count = s->asset->bones.count;
  f->skin = calloc(count * f->points + 1, sizeof *f->skin);
  f->heads = calloc(count * f->bone_count + 1, sizeof *f->heads);
  f->turns = calloc(count * f->bone_count + 1, sizeof *f->turns);
  f->bones = calloc((size_t)f->bone_count + 1, sizeof *f->bones);
  return f->skin && f->heads && f->turns && f->bones;
}

static sbf_vec3 in_world(sbr_double3 origin, sbf_vec3 v) {
  return (sbf_vec3){
      (float)(origin.x + (double)v.x), (float)(origin.y + (double)v.y), (float)(origin.z + (double)v.z)};
}

static void keep(frames *f, const session *s) {
  sbr_double3 origin = sbr_character_get_origin(s->world, s->character);
  sbf_vec3 *skin = f->skin + (size_t)s->frame * f->points;
  uint32_t at = 0;
  for (uint32_t i = 0; i < s->asset->render_meshes.count; i++)
    at += sbr_character_get_skin(s->world, s->character, i, skin + at, NULL, NULL, f->points - at);
  for (uint32_t i = 0; i < f->points; i++) skin[i] = in_world(origin, skin[i]);
  sbr_character_get_bones(s->world, s->character, f->bones, f->bone_count);
  for (uint32_t i = 0; i < f->bone_count; i++) {
    size_t index = (size_t)s->frame * f->bone_count + i;
    f->heads[index] = in_world(origin, f->bones[i].position);
    f->turns[index] = f->bones[i].rotation;
  }
}

int motion_bake(cli_call *call, sbf_export_motion *motion) {
  session s;
  frames f = {.points = 0};
  int status;
  *motion = (sbf_export_motion){0};
  if (!session_open(&s, call, 5, 30, &status)) return status;
  if (reserve(&f, &s)) {
    keep(&f, &s);
    while (session_step(&s)) {
      keep(&f, &s);
      if (s.frame % 30 == 0) cli_progress("running", (double)s.frame / s.frame_count);
    }
    cli_progress_end();
    status = session_finish(&s, call) ? SBF_OK : SBF_FAILED;
  } else
    status = cli_wrong(call, "memory ran out: ask for fewer --seconds or --fps");
  *motion = (sbf_export_motion){s.frame + 1, 1 / s.fps, f.skin, f.heads, f.turns};
  free(f.bones);
  session_close(&s);
  if (status != SBF_OK) motion_free(motion);
  return status;
}

/* They were allocated here. */
static void free_list(const void *list) {
  free((void *)(uintptr_t)list);
}

void motion_free(sbf_export_motion *motion) {
  free_list(motion->skin);
  free_list(motion->bone_positions);
  free_list(motion->bone_rotations);
  *motion = (sbf_export_motion){0};
}
