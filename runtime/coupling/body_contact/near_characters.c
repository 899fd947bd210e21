/* Which characters are near each other, before detail levels change. Jiggle and bone levels have no contact
 * bodies: a character uses them only while no other is near. */
#include "coupling/body_contact/body_contacts.h"
#include "math/vec3.h"

/* Prediction time; margin as a fraction of the character's size. */
static const float LOOKAHEAD_S = 0.5f, SIZE_FRACTION = 0.1f;

/* Bounds of its bones, grown by its soft bodies and its predicted motion. */
static sbri_box box_of(const sbr_world *world, const sbri_character *c) {
  const sbr_model *base = c->model->detail.base;
  const sbr_transform *pose = sbri_pose(c), *before = sbri_previous_pose(c);
  sbf_vec3 root = pose[sbri_root_frame(base)].position;
  float size = base->rig.bones.count ? 0 : base->rest_size_m, displacement = 0;
  sbri_box box = sbri_box_of_point(base->rig.bones.count ? pose[0].position : root);
  for (uint32_t f = 0; f < base->rig.bones.count; f++) {
    box = sbri_box_with(box, pose[f].position);
    displacement = fmaxf(displacement, sbri_length(sbri_sub(pose[f].position, before[f].position)));
  }
  for (uint32_t b = 0; b < base->asset->soft_bodies.count; b++)
    size = fmaxf(size, base->bodies[b].rest_size_m);
  const sbri_character_state *state = sbri_header(c);
  float target_step =
      sqrtf(state->forward * state->forward + state->sideways * state->sideways) * (float)world->time.tick_s;
  float margin =
      c->scale * size + fmaxf(displacement, target_step) * (LOOKAHEAD_S / (float)world->time.tick_s);
  box = sbri_box_grown(box, margin + SIZE_FRACTION * c->scale * base->rest_size_m);
  return sbri_box_in_world(box, state->origin, 1);
}

static bool has_contact_bodies(const sbri_character *c) {
  return c->model && c->model->asset->soft_bodies.count + c->model->rigid.body_count > 0;
}

static bool has_detail_levels(const sbri_character *c) {
  return c->model->detail.base->detail.level_count > 1;
}

void sbri_near_characters_find(sbr_world *world) {
  sbri_body_contacts *all = world->body_contacts;
  uint32_t count = 0;
  bool any = false;
  for (uint32_t i = 0; i < world->character_capacity; i++) {
    world->characters[i].near = false;
    if (has_contact_bodies(&world->characters[i]) && has_detail_levels(&world->characters[i])) any = true;
  }
  if (!any) return;
  for (uint32_t i = 0; i < world->character_capacity; i++) {
    sbri_character *c = &world->characters[i];
    if (!has_contact_bodies(c)) continue;
    all->broad_phase.bodies[count].character = i;
    all->broad_phase.boxes[count++] = box_of(world, c);
  }
  sbri_bounds_tree_make(&all->broad_phase.tree, all->broad_phase.boxes, count);
  for (uint32_t a = 0; a < count; a++) {
    sbri_character *c = &world->characters[all->broad_phase.bodies[a].character];
    sbri_bounds_walk walk;
    uint32_t b;
    if (!has_detail_levels(c)) continue;
    sbri_bounds_walk_begin(&walk, &all->broad_phase.tree, all->broad_phase.boxes[a]);
    while (!c->near && sbri_bounds_walk_next(&walk, &b))
      c->near = b != a && sbri_boxes_overlap(&all->broad_phase.boxes[a], &all->broad_phase.boxes[b]);
  }
}
