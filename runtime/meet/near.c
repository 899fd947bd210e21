/* Who of those that have rungs is near whom, before they are changed: a body that is jiggle or bones alone
 * has nothing to meet others with, so a character goes to such a rung only where nobody is about, and comes
 * back before anybody is. */
#include "math/vec3.h"
#include "meet/meetings.h"

/* So long ahead, and this share of its size beside. */
static const float AHEAD_S = 0.5f, SIZE_SHARE = 0.1f;

/* Its bones, and its bodies about them. */
static sbri_box box_of(const sbr_world *world, const sbri_character *c) {
  const sbr_model *base = c->model->base;
  const sbr_transform *pose = sbri_pose(c), *before = sbri_previous_pose(c);
  sbf_vec3 root = pose[sbri_root_frame(base)].position;
  float size = base->rig.bone_count ? 0 : base->rest_size_m, way = 0;
  sbri_box box = sbri_box_of_point(base->rig.bone_count ? pose[0].position : root);
  for (uint32_t f = 0; f < base->rig.bone_count; f++) {
    box = sbri_box_with(box, pose[f].position);
    way = fmaxf(way, sbri_length(sbri_sub(pose[f].position, before[f].position)));
  }
  for (uint32_t b = 0; b < base->asset->soft_bodies.count; b++)
    size = fmaxf(size, base->bodies[b].rest_size_m);
  const sbri_character_state *head = sbri_head(c);
  float wanted =
      sqrtf(head->forward * head->forward + head->sideways * head->sideways) * (float)world->tick_s;
  float by = c->scale * size + fmaxf(way, wanted) * (AHEAD_S / (float)world->tick_s);
  box = sbri_box_grown(box, by + SIZE_SHARE * c->scale * base->rest_size_m);
  return sbri_box_in_world(box, head->origin, 1);
}

static bool meets_others(const sbri_character *c) {
  return c->model && c->model->asset->soft_bodies.count + c->model->rigid.body_count > 0;
}

static bool has_rungs(const sbri_character *c) {
  return c->model->base->rung_count > 1;
}

void sbri_meet_near_find(sbr_world *world) {
  sbri_meetings *all = world->meetings;
  uint32_t count = 0;
  bool any = false;
  for (uint32_t i = 0; i < world->character_capacity; i++) {
    world->characters[i].near = false;
    if (meets_others(&world->characters[i]) && has_rungs(&world->characters[i])) any = true;
  }
  if (!any) return;
  for (uint32_t i = 0; i < world->character_capacity; i++) {
    sbri_character *c = &world->characters[i];
    if (!meets_others(c)) continue;
    all->meeters[count].character = i;
    all->boxes[count++] = box_of(world, c);
  }
  sbri_bounds_tree_make(&all->tree, all->boxes, count);
  for (uint32_t a = 0; a < count; a++) {
    sbri_character *c = &world->characters[all->meeters[a].character];
    sbri_bounds_walk walk;
    uint32_t b;
    if (!has_rungs(c)) continue;
    sbri_bounds_walk_begin(&walk, &all->tree, all->boxes[a]);
    while (!c->near && sbri_bounds_walk_next(&walk, &b))
      c->near = b != a && sbri_box_meets(&all->boxes[a], &all->boxes[b]);
  }
}
