/* Levels of detail by the camera of the nodes' viewport, within the project's budget.
 *
 * The runtime selects them (sbrun/detail.h); this passes the camera to it. Characters are at their finest
 * level without a camera, as on a server, and while a rigid body is near: coarse levels have no collision
 * bodies. */
#include <math.h>

#include "sbrun/detail.h"
#include "soft_character.h"

enum { ORTHOGONAL = 1, KEEP_WIDTH = 0 };

/* Distance in heights of its picture at which an orthogonal camera equals a perspective one. */
static const double FAR = 1000;

static double project_setting(const char *name, double otherwise) {
  gd_variant settings = gd_singleton("ProjectSettings");
  double value = gd_take_float(GD_CALL(&settings, "get_setting", gd_string(name), gd_float(otherwise)));
  gd_free(&settings);
  return value;
}

double level_of_detail_budget_us(void) {
  double budget = 1000 * project_setting("sbfmt/detail/budget_ms", 0);
  return budget > 0 ? budget : 0;
}

bool level_of_detail_select(sbr_world *world, double budget_us) {
  sbr_detail_definition definition = sbr_default_detail_definition();
  double error = project_setting("sbfmt/detail/error_pixels", (double)definition.error_px);
  if (error > 0) definition.error_px = (float)error;
  definition.budget_us = (float)budget_us;
  return sbr_world_select_detail_levels(world, &definition, NULL) == SBF_OK;
}

/* View of the viewport's camera; false if it has none. */
static bool find_view(const gd_variant *viewport, sbr_view *view) {
  gd_variant camera = GD_CALL(viewport, "get_camera_3d");
  if (!gd_as_object(&camera)) return gd_free(&camera), false;
  gd_variant transform = GD_CALL(&camera, "get_camera_transform");
  gd_transform at = gd_as_transform(&transform);
  gd_rect area = gd_take_rect(GD_CALL(viewport, "get_visible_rect"));
  bool by_width = gd_take_int(GD_CALL(&camera, "get_keep_aspect_mode")) == KEEP_WIDTH;
  bool orthogonal = gd_take_int(GD_CALL(&camera, "get_projection")) == ORTHOGONAL;
  double ratio = area.height > 0 ? (double)(area.width / area.height) : 1, back = 0;
  double half = orthogonal ? gd_take_float(GD_CALL(&camera, "get_size")) / 2
                           : tan(gd_take_float(GD_CALL(&camera, "get_fov")) * 3.14159265358979 / 360);
  if (by_width) half /= ratio;
  if (orthogonal) back = 2 * half * FAR, half = 0.5 / FAR;
  sbf_vec3 forward = {-at.basis[0][2], -at.basis[1][2], -at.basis[2][2]};
  *view = (sbr_view){
      .eye = {(double)at.origin.x - back * (double)forward.x, (double)at.origin.y - back * (double)forward.y,
          (double)at.origin.z - back * (double)forward.z},
      .forward = forward,
      .height_rad = (float)(2 * atan(half)),
      .width_ratio = (float)ratio,
      .lines = area.height};
  gd_free(&transform);
  gd_free(&camera);
  return view->height_rad > 0 && view->width_ratio > 0 && view->lines > 0;
}

static void set_detail(soft_character *one, soft_detail_state state) {
  if (one->detail_state == state) return;
  one->detail_state = state;
  sbr_character_set_detail_level(one->world, one->id, state == SOFT_DETAIL_FINEST ? 0 : SBR_DETAIL_AUTOMATIC);
  sbr_character_set_visibility(
      one->world, one->id, state == SOFT_DETAIL_HIDDEN ? SBR_VISIBILITY_NEVER : SBR_VISIBILITY_BY_VIEWS);
}

void level_of_detail_update(soft_character *const *members, uint32_t count) {
  sbr_view view;
  gd_variant viewport = GD_CALL(&members[0]->node, "get_viewport");
  bool sees = gd_as_object(&viewport) && find_view(&viewport, &view);
  gd_free(&viewport);
  sbr_world_set_views(members[0]->world, &view, sees ? 1 : 0);
  bool finest = !sees || physics_bodies_any_rigid(members[0]->physics.bodies);
  for (uint32_t i = 0; i < count; i++) {
    soft_character *one = members[i];
    bool shown = finest || gd_take_bool(GD_CALL(&one->node, "is_visible_in_tree"));
    set_detail(one, finest || !one->model->options.detail_levels ? SOFT_DETAIL_FINEST
                    : shown                                      ? SOFT_DETAIL_BY_VIEW
                                                                 : SOFT_DETAIL_HIDDEN);
  }
}
