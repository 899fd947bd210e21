/* Methods of SoftCharacter3D that act on the soft body nearest to a position in world space. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "method_table.h"
#include "sbrun/soft_body.h"
#include "soft_character.h"

static float squared_distance(sbf_vec3 a, sbf_vec3 b) {
  float x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
  return x * x + y * y + z * z;
}

/* Nearest vertex of all surfaces to a position, and where it is. An error is logged for `caller` where there
 * is none. */
static bool find_vertex(
    const soft_character *one, const char *caller, sbf_vec3 position, surface_vertex *found) {
  sbr_double3 origin = sbr_character_get_origin(one->world, one->id);
  sbf_vec3 wanted = {(float)((double)position.x - origin.x), (float)((double)position.y - origin.y),
      (float)((double)position.z - origin.z)};
  float best = INFINITY;
  for (uint32_t i = 0; i < one->model->asset->soft_bodies.count; i++) {
    uint32_t count = sbr_character_get_surface(one->world, one->id, i, NULL, 0);
    sbf_vec3 *points = count ? malloc(count * sizeof *points) : NULL;
    if (!points) continue;
    sbr_character_get_surface(one->world, one->id, i, points, count);
    for (uint32_t k = 0; k < count; k++) {
      float distance = squared_distance(points[k], wanted);
      if (!(distance < best)) continue;
      best = distance;
      *found = (surface_vertex){.soft_body = i,
          .vertex = k,
          .position = {(float)(origin.x + (double)points[k].x), (float)(origin.y + (double)points[k].y),
              (float)(origin.z + (double)points[k].z)}};
    }
    free(points);
  }
  if (best < INFINITY) return true;
  char message[160];
  snprintf(message, sizeof message, "%s: %s", caller,
      one->model->asset->soft_bodies.count ? "the position is not finite" : "the asset has no soft body");
  soft_character_error(one, message);
  return false;
}

static void report(const soft_character *one, sbf_status status, const sbf_diagnostic *error) {
  if (status != SBF_OK) soft_character_error(one, error->message);
}

CALL(apply_impulse) {
  soft_character *one = self;
  sbf_diagnostic error;
  surface_vertex at;
  UNUSED;
  if (one->world && find_vertex(one, "apply_impulse", gd_as_vector3(arguments[0]), &at))
    report(one,
        sbr_character_apply_soft_impulse(
            one->world, one->id, at.soft_body, at.vertex, gd_as_vector3(arguments[1]), &error),
        &error);
}

/* For one physics frame. */
CALL(apply_force) {
  soft_character *one = self;
  sbf_diagnostic error;
  surface_vertex at;
  UNUSED;
  if (!one->world || !find_vertex(one, "apply_force", gd_as_vector3(arguments[0]), &at)) return;
  float frame_s = (float)gd_take_float(GD_CALL(&one->node, "get_physics_process_delta_time"));
  report(one,
      sbr_character_apply_soft_force(
          one->world, one->id, at.soft_body, at.vertex, gd_as_vector3(arguments[1]), frame_s, &error),
      &error);
}

/* ---- Dragging ---- */

static bool drag_to(soft_character *one, sbf_vec3 target) {
  sbf_diagnostic error;
  sbr_vertex_grab drawn = sbr_default_vertex_grab();
  surface_vertex at = one->grab.vertex;
  drawn.target = (sbr_double3){(double)target.x + (double)at.position.x,
      (double)target.y + (double)at.position.y, (double)target.z + (double)at.position.z};
  sbf_status status = sbr_character_grab_vertex(one->world, one->id, at.soft_body, at.vertex, &drawn, &error);
  report(one, status, &error);
  return status == SBF_OK;
}

CALL(release) {
  soft_character *one = self;
  UNUSED;
  if (one->world && one->grab.is_active)
    sbr_character_release_vertex(one->world, one->id, one->grab.vertex.soft_body, one->grab.vertex.vertex);
  one->grab.is_active = false;
}

CALL(grab) {
  soft_character *one = self;
  sbf_vec3 point = gd_as_vector3(arguments[0]);
  release(self, NULL, NULL);
  if (one->world && find_vertex(one, "grab", point, &one->grab.vertex)) {
    sbf_vec3 *arm = &one->grab.vertex.position; /* from the point to the vertex from now on */
    *arm = (sbf_vec3){arm->x - point.x, arm->y - point.y, arm->z - point.z};
    one->grab.is_active = drag_to(one, point);
  }
  gd_assign(result, gd_bool(one->grab.is_active));
}

CALL(drag) {
  soft_character *one = self;
  UNUSED;
  if (!one->world) return;
  if (!one->grab.is_active)
    soft_character_error(one, "drag: nothing is grabbed: call grab first and check its result");
  else
    drag_to(one, gd_as_vector3(arguments[0]));
}

CALL(is_grabbed) {
  const soft_character *one = self;
  UNUSED;
  gd_assign(result, gd_bool(one->grab.is_active));
}

const gd_method soft_character_grab_methods[] = {
    {"apply_impulse", apply_impulse, NOTHING, 2, {WITH("position", VECTOR3), WITH("impulse", VECTOR3)}},
    {"apply_force", apply_force, NOTHING, 2, {WITH("position", VECTOR3), WITH("force", VECTOR3)}},
    {"grab", grab, ANSWER(BOOL), 1, {WITH("point", VECTOR3)}},
    {"drag", drag, NOTHING, 1, {WITH("point", VECTOR3)}},
    {"release", release, NOTHING, 0, {{0}}},
    {"is_grabbed", is_grabbed, ANSWER(BOOL), 0, {{0}}},
    {0},
};
