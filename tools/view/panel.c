/* Text of the picture: enabled views, frame times, keys. */
#include "view/panel.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include "view/viewer_choices.h"

static const draw_colour ON = {11, 94, 168, 255}, OFF = {201, 210, 217, 255};

static void add(draw_scene *scene, const draw_colour *colour, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
static void add(draw_scene *scene, const draw_colour *colour, const char *format, ...) {
  char words[128];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(words, sizeof words, format, arguments);
  va_end(arguments);
  draw_scene_add_note(scene, words, colour);
}

static void add_switch(const viewer *v, draw_scene *scene, unsigned what, const char *words) {
  add(scene, v->st.show & what ? &ON : &OFF, "%s", words);
}

/* Largest error stored in the simulated levels, m; negative if there is none. */
static float stated_error(const session *s) {
  float max = -1;
  for (uint32_t i = 0; i < s->asset->soft_bodies.count; i++) {
    const sbf_soft_body *body = &s->asset->soft_bodies.at[i];
    uint32_t level = s->settings.model.level;
    if (body->levels.count == 0) continue;
    const sbf_level *one = &body->levels.at[level < body->levels.count ? level : body->levels.count - 1];
    if (one->simulation.error > 0) max = fmaxf(max, one->simulation.error);
  }
  return max;
}

static void add_health(const viewer *v, draw_scene *scene) {
  const session *s = &v->st.s;
  double volume = 1, strain = 0;
  for (uint32_t i = 0; i < s->asset->soft_bodies.count; i++) {
    sbr_body_health health = sbr_character_get_body_health(s->world, s->character, i);
    if (fabs((double)health.volume_ratio - 1) > fabs(volume - 1)) volume = (double)health.volume_ratio;
    strain = fmax(strain, (double)health.max_strain);
  }
  float error = stated_error(s);
  add(scene, NULL, "volume off by: %.2f %%", 100 * fabs(1 - volume));
  add(scene, NULL, "greatest strain: %.0f %%", 100 * strain);
  if (error > 0)
    add(scene, NULL, "level's stated error: %.2f mm", 1000 * (double)error);
  else
    add(scene, NULL, "level's stated error: not measured");
  add(scene, NULL, "walked: %.2f m", sbr_character_get_distance(s->world, s->character));
}

static void add_figures(const viewer *v, draw_scene *scene) {
  const sbf_asset *asset = v->st.s.asset;
  add_switch(v, scene, STAGE_SURFACE, "1 skin");
  add_switch(v, scene, STAGE_SPRINGS, "2 springs");
  add_switch(v, scene, STAGE_LATTICE, "3 lattice");
  add_switch(v, scene, STAGE_BONES, "4 bones");
  add_switch(v, scene, STAGE_STRAIN, "5 strain");
  add_switch(v, scene, STAGE_HULLS, "6 hulls");
  add_switch(v, scene, STAGE_FEET, "7 feet");
  add_switch(v, scene, STAGE_CONTACTS, "8 contacts");
  add_switch(v, scene, STAGE_JOINTS, "9 joints");
  add_switch(v, scene, STAGE_BOUNDS, "0 bounds");
  add(scene, NULL, "G ground: %s", viewer_ground_name(v));
  add(scene, NULL, "L level of the bodies: %u of 0 to %u", (unsigned)v->st.s.settings.model.level,
      (unsigned)viewer_level_count(asset) - 1);
  add(scene, NULL, "M level of the skin: %u of 0 to %u", (unsigned)v->st.render_level,
      (unsigned)viewer_render_level_count(asset) - 1);
  add(scene, NULL, "F pace: %s", viewer_pace_name(v));
  add(scene, NULL, " ");
  if (v->reported.frames) {
    double frames = v->reported.frames;
    add(scene, NULL, "physics: %.0f us a frame", 1e6 * v->reported.physics_s / frames);
    add(scene, NULL, "picture: %.1f ms a frame", 1e3 * v->reported.picture_s / frames);
    add(scene, NULL, "frames: %.0f /s", frames / fmax(v->reported_s, 1e-9));
  }
  add_health(v, scene);
}

void panel_add(const viewer *v, draw_scene *scene) {
  if (v->panel == PANEL_HIDDEN) return;
  add_figures(v, scene);
  add(scene, NULL, " ");
  if (v->paused) add(scene, NULL, "paused: P goes on");
  if (v->panel == PANEL_FIGURES) {
    add(scene, NULL, "H keys");
    return;
  }
  add(scene, NULL, "W A S D walk, Q E sideways, T V up and down");
  add(scene, NULL, "B ball, K knock over, R again, P pause");
  add(scene, NULL, "arrows turn, + - and wheel zoom");
  add(scene, NULL, "drag the body to pull it,");
  add(scene, NULL, "the ground to look around");
  add(scene, NULL, "H hides this, escape ends");
}
