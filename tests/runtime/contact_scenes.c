#include "contact_scenes.h"

#include <math.h>

#include "harness.h"
#include "momentum.h"
#include "sbrun/collision.h"
#include "state/world.h"

scene contact_scene_begin(sbf_vec3 gravity) {
  scene s = rigid_begin();
  s.asset->environment.gravity = gravity;
  return s;
}

void contact_scene_start(scene *s) {
  scene_start(s);
  ck_assert(sbr_world_enable_body_contacts(s->world, 0, NULL) == SBF_OK);
}

void contact_scene_throw(scene *s, sbr_character_id who, uint32_t body, sbf_vec3 impulse) {
  sbr_double3 o = sbr_character_get_origin(s->world, who);
  sbf_vec3 c = sbr_character_get_rigid_state(s->world, who, body).center;
  sbr_character_apply_rigid_impulse(
      s->world, who, body, (sbr_double3){o.x + (double)c.x, o.y + (double)c.y, o.z + (double)c.z}, impulse);
}

sbr_character_id contact_scene_another(scene *s, sbr_double3 position) {
  sbr_character_definition d = s->character_definition;
  sbr_character_id id;
  d.position = position;
  ck_assert(sbr_character_create(s->world, s->model, &d, &id, NULL) == SBF_OK);
  return id;
}

void contact_scene_soft_box(scene *s, uint32_t body, lattice_box *box, const sbf_polygon_mesh *skin) {
  sbf_level *level = scene_lattice(s, body, box);
  scene_body(s, body)->surface = *skin;
  scene_body(s, body)->surface.target = SBF_MESH_TARGET_SURFACE;
  scene_embed(s, level, box);
  lattice_box_free(box);
  scene_body(s, body)->attributes.damping_ratio = 0.5f;
  scene_body(s, body)->attributes.friction = 0.5f;
}

void contact_scene_ball(scene *s, uint32_t body, float radius) {
  enum { RINGS = 7, AROUND = 14, POINTS = RINGS * AROUND + 2, FACES = (RINGS + 1) * AROUND };
  sbf_polygon_mesh *hull = sbf_asset_allocate(s->asset, 1, sizeof *hull);
  sbf_vec3 *at = sbf_asset_allocate(s->asset, POINTS, sizeof *at);
  uint32_t *sizes = sbf_asset_allocate(s->asset, FACES, sizeof *sizes);
  uint32_t *corners = sbf_asset_allocate(s->asset, 4 * FACES, sizeof *corners);
  uint32_t faces = 0, count = 0;
  ck_assert(hull && at && sizes && corners);
  for (uint32_t i = 0; i < RINGS * AROUND; i++) {
    double up = 3.14159265 * (i / AROUND + 1) / (RINGS + 1), turn = 6.2831853 * (i % AROUND) / AROUND;
    at[i] = (sbf_vec3){radius * (float)(sin(up) * cos(turn)), radius * (float)cos(up),
        radius * (float)(sin(up) * sin(turn))};
  }
  at[RINGS * AROUND] = (sbf_vec3){0, radius, 0}, at[RINGS * AROUND + 1] = (sbf_vec3){0, -radius, 0};
  for (uint32_t ring = 0; ring <= RINGS; ring++)
    for (uint32_t k = 0; k < AROUND; k++) {
      uint32_t next = (k + 1) % AROUND, first = count;
      if (ring > 0) corners[count++] = (ring - 1) * AROUND + k;
      if (ring > 0) corners[count++] = (ring - 1) * AROUND + next;
      if (ring == 0) corners[count++] = RINGS * AROUND;
      if (ring < RINGS) corners[count++] = ring * AROUND + next;
      if (ring < RINGS) corners[count++] = ring * AROUND + k;
      if (ring == RINGS) corners[count++] = RINGS * AROUND + 1;
      sizes[faces++] = count - first;
    }
  sbf_polygon_mesh_init(hull);
  hull->positions = (sbf_vec3_list){at, POINTS};
  hull->polygon_sizes = (sbf_u32_list){sizes, faces};
  hull->polygon_points = (sbf_u32_list){corners, count};
  rigid_body(s, body)->hull = hull;
}

double contact_scene_deepest(const scene *s) {
  const sbri_character *c = sbri_character_of(s->world, s->character);
  const sbri_island *island = &c->model->islands[0];
  const sbri_point *p = sbri_positions(c) + island->first_slot;
  const sbri_rigid_body_state *b = sbri_rigid_bodies(c);
  double max = -9;
  for (uint32_t slot = 0; slot < island->free_count; slot++) {
    uint32_t face;
    sbf_vec3 off = sbri_sub(sbri_vec3(p[slot].x, p[slot].y, p[slot].z), b->pose.position);
    if (!(island->masses[slot] > 0)) continue;
    max = fmax(max, -(double)sbri_hull_depth(&c->model->rigid.bodies[0].hull,
                        sbri_rotate(sbri_quat_conjugate(b->pose.rotation), off), &face));
  }
  return max;
}

double contact_scene_fastest(const scene *s, sbr_character_id who) {
  const sbri_character *c = sbri_character_of(s->world, who);
  double max = 0;
  for (uint32_t k = 0; k < c->model->island_count; k++)
    for (uint32_t slot = 0; slot < c->model->islands[k].free_count; slot++)
      max = fmax(max, (double)sbri_length(scene_slot_velocity(c, &c->model->islands[k], slot)));
  return max;
}
