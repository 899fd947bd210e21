/* Visibility of characters in the views. A view is the cone around its frustum, because its roll is not
 * known.
 */
#include "math/trig.h"
#include "math/vec3.h"
#include "world/detail/choose.h"

/* Nearer than that nothing is looked at. */
static const float NEAREST_M = 0.05f;

/* Margins around the cone, as fractions of the distance: a character within the first becomes visible, so
 * that it is ready in time; a visible one stays so within the second (hysteresis). */
static const float MARGIN = 0.1f, MORE_MARGIN = 0.15f;

static const float G_M_S2 = 9.81f;

sbri_eye sbri_eye_of(const sbr_view *view) {
  sbri_eye eye = {.view = *view};
  float half = sbri_clamp(0.5f * view->height_rad, 1e-4f, 1.5f), s, c;
  sbri_sincos(half, &s, &c);
  float up = s / c, aside = up * sbri_clamp(view->width_ratio, 0, 100);
  float across = sqrtf(up * up + aside * aside), along = 1 / sqrtf(1 + across * across);
  eye.cone_cosine = along;
  eye.cone_sine = across * along;
  eye.pixels = sbri_clamp(view->lines, 0, 1e6f) / (2 * up);
  eye.forward = sbri_normalize(view->forward, sbri_vec3(0, 0, 1));
  return eye;
}

static float radius_of(const sbri_character *c) {
  float size = c->model->detail.base->rest_size_m, reach = c->model->detail.base->rig.stand.reach;
  return c->scale * (size > 0 ? 0.5f * size : reach > 0 ? reach : 0.5f);
}

float sbri_pixels_of(const sbr_world *world, const sbri_character *c) {
  const sbri_detail *detail = world->detail;
  const sbri_character_state *head = sbri_header(c);
  sbf_vec3 root = sbri_pose(c)[sbri_root_frame(c->model)].position;
  float radius = radius_of(c), max = 0;
  float margin = head->unseen_ticks > 0 ? MARGIN : MORE_MARGIN;
  for (uint32_t i = 0; i < detail->eye_count && head->visibility != SBR_VISIBILITY_NEVER; i++) {
    const sbri_eye *eye = &detail->eyes[i];
    const sbr_double3 *at = &eye->view.eye;
    sbf_vec3 to = {(float)(head->origin.x - at->x) + root.x, (float)(head->origin.y - at->y) + root.y,
        (float)(head->origin.z - at->z) + root.z};
    float square = sbri_dot(to, to), along = sbri_dot(to, eye->forward), distance = sqrtf(square);
    float across = sqrtf(fmaxf(square - along * along, 0));
    float beyond = across * eye->cone_cosine - along * eye->cone_sine;
    bool within = distance <= radius || beyond <= radius + margin * distance;
    if (!within && head->visibility != SBR_VISIBILITY_ALWAYS) continue;
    float near_m = fmaxf(distance - radius, NEAREST_M);
    max = fmaxf(max, eye->pixels / near_m);
  }
  return max;
}

float sbri_speed_factor(const sbri_character *c) {
  const sbri_character_state *head = sbri_header(c);
  const sbri_rig *rig = &c->model->rig;
  float length = rig->leg_count ? rig->stand.reach * c->scale : radius_of(c);
  float round = head->turn * radius_of(c);
  float square = head->forward * head->forward + head->sideways * head->sideways + round * round;
  return 1 + square / (G_M_S2 * fmaxf(length, 1e-3f)); /* Froude's number */
}
