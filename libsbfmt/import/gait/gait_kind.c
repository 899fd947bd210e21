/* Determines how a character moves, and reports the reasons. */
#include <stdio.h>
#include <string.h>

#include "import/convert/conversion.h"
#include "import/gait/locomotion.h"
#include "import/gait/named_chains.h"

enum { MAX_REASONS = 4 }; /* pieces of evidence in a message */

static bool gather_names(sbfi_conversion *c, sbfi_locomotion_names *names) {
  const sbf_asset *a = c->asset;
  uint32_t of_rig = c->rig ? c->rig->clip_count : 0;
  const char **clips = sbfi_arena_allocate(&c->scratch, (size_t)of_rig + a->clips.count + 1, sizeof *clips);
  const char **objects = sbfi_arena_allocate(&c->scratch,
      (size_t)a->render_meshes.count + a->soft_bodies.count + a->materials.count + 1, sizeof *objects);
  if (!clips || !objects) return false;
  names->clips = clips;
  names->objects = objects;
  for (uint32_t i = 0; i < of_rig; i++) clips[names->clip_count++] = c->rig->clips[i].name;
  for (uint32_t i = 0; i < a->clips.count; i++) clips[names->clip_count++] = a->clips.at[i].name;
  for (uint32_t i = 0; i < a->render_meshes.count; i++)
    objects[names->object_count++] = a->render_meshes.at[i].name;
  for (uint32_t i = 0; i < a->soft_bodies.count; i++)
    objects[names->object_count++] = a->soft_bodies.at[i].name;
  for (uint32_t i = 0; i < a->materials.count; i++) objects[names->object_count++] = a->materials.at[i].name;
  if (a->info.title) objects[names->object_count++] = a->info.title;
  return true;
}

/* Lists the strongest evidence for a kind, strongest first. */
static void reasons_text(const sbfi_locomotion *found, sbfi_locomotion_kind kind, char *text, size_t size) {
  bool used[SBFI_MAX_EVIDENCE] = {false};
  text[0] = 0;
  for (int reason = 0; reason < MAX_REASONS; reason++) {
    int best = -1;
    for (uint32_t e = 0; e < found->evidence_count; e++) {
      if (used[e] || found->evidence[e].kind != kind || found->evidence[e].points <= 0) continue;
      if (best < 0 || found->evidence[e].points > found->evidence[best].points) best = (int)e;
    }
    if (best < 0) return;
    used[best] = true;
    size_t length = strlen(text);
    snprintf(text + length, size - length, "%s%s", length ? ", " : "", found->evidence[best].text);
  }
}

static void report_kind(sbfi_conversion *c, const sbfi_locomotion *found) {
  char first[320], second[320];
  reasons_text(found, found->kind, first, sizeof first);
  reasons_text(found, found->second, second, sizeof second);
  if (!found->unsure && found->kind == SBFI_LOCOMOTION_NONE) return; /* RIG_NO_LEGS reports it */
  if (!found->unsure)
    sbfi_convert_warn(c, SBF_CODE_GAIT_KIND, "its gait is %s: %s", sbfi_locomotion_name(found->kind), first);
  else
    sbfi_convert_warn(c, SBF_CODE_GAIT_KIND_UNSURE,
        "its gait is unclear: %s was chosen (%s), but %s is almost as likely (%s); state one with --gait "
        "KIND",
        sbfi_locomotion_name(found->kind), first, sbfi_locomotion_name(found->second), second);
}

static void walk_as_humanoid(sbfi_conversion *c) {
  c->locomotion->kind = SBFI_LOCOMOTION_WALK;
  c->locomotion->unsure = false;
  sbfi_convert_warn(c, SBF_CODE_GAIT_KIND, "its gait is walk: the file names its legs");
}

sbf_status sbfi_evaluate_gait(sbfi_conversion *c) {
  const sbf_asset *a = c->asset;
  if (a->bones.count == 0 || a->gaits.count || a->chains.count || a->ik_chains.count) return SBF_OK;
  sbfi_locomotion_names names = {.clip_count = 0};
  c->locomotion = sbfi_arena_allocate(&c->scratch, 1, sizeof *c->locomotion);
  if (!c->locomotion || !gather_names(c, &names)) return sbfi_convert_no_memory(c);
  if (!sbfi_find_locomotion(a, &names, &c->scratch, c->locomotion)) return sbfi_convert_no_memory(c);
  if (c->options->gait)
    c->locomotion->kind = sbfi_locomotion_named(c->options->gait);
  else if (sbfi_has_named_legs(a))
    walk_as_humanoid(c);
  else
    report_kind(c, c->locomotion);
  return SBF_OK;
}
