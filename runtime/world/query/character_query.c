/* Queries of characters: sbrun/sbrun.h, sbrun/animation.h. */
#include "animation/skeleton/rig_limits.h"
#include "animation/skeleton/rig_mass.h"
#include "sbrun/animation.h"
#include "soft/soft.h"
#include "state/world.h"

sbr_body_health sbr_character_get_body_health(
    const sbr_world *world, sbr_character_id character, uint32_t soft_body) {
  const sbri_character *c = sbri_character_of(world, character);
  if (!c || soft_body >= c->model->asset->soft_bodies.count) return (sbr_body_health){0};
  return sbri_body_health(world, c, soft_body);
}

uint32_t sbr_character_get_element_visits(
    const sbr_world *world, sbr_character_id character, uint32_t soft_body) {
  const sbri_character *c = sbri_character_of(world, character);
  if (!c || soft_body >= c->model->asset->soft_bodies.count) return 0;
  const sbri_body *body = &c->model->bodies[soft_body];
  return body->level ? sbri_island_states(c)[body->island].element_visits : 0;
}

float sbr_character_get_limit_violation(const sbr_world *world, sbr_character_id character) {
  const sbri_character *c = sbri_character_of(world, character);
  return c ? sbri_rig_limit_excess(&c->model->rig, sbri_pose(c)) : 0;
}

bool sbr_character_get_center_of_mass(const sbr_world *world, sbr_character_id character, sbf_vec3 *center) {
  const sbri_character *c = sbri_character_of(world, character);
  if (center) *center = (sbf_vec3){0, 0, 0};
  return c && center && sbri_rig_center(&c->model->rig, sbri_pose(c), c->scale, center);
}

uint32_t sbr_character_get_torn_polygons(const sbr_world *world, sbr_character_id character,
    uint32_t render_mesh, uint32_t render_level, uint8_t *torn, uint32_t capacity) {
  const sbri_character *c = sbri_character_of(world, character);
  const sbri_skin *skin = c ? sbri_skin_of(c->model, render_mesh, render_level) : NULL;
  if (!skin) return 0;
  const sbf_render_mesh *mesh = &c->model->asset->render_meshes.at[render_mesh];
  uint32_t count =
      render_level ? mesh->levels.at[render_level - 1].polygon_sizes.count : mesh->mesh.polygon_sizes.count;
  for (uint32_t p = 0; torn && p < count && p < capacity; p++) {
    torn[p] = skin->binding_count && sbri_torn_polygons(c)[skin->first_polygon + p] == SBRI_POLYGON_TORN;
    for (uint32_t i = skin->side_begins ? skin->side_begins[p] : 0;
         skin->side_begins && i < skin->side_begins[p + 1]; i++)
      torn[p] = torn[p] || !(sbri_strengths(c)[skin->side_strengths[i]] > 0);
  }
  return count;
}
