/* Draws a world as lines and points: sbrun/debug.h. */
#include "coupling/body_contact/body_contacts.h"
#include "skin/skin.h"
#include "soft/soft.h"
#include "world/debug/debug_lines.h"

enum { DRAW_COOKIE = 0x64726177, MAX_DRAWN_LEGS = SBRI_MAX_LEGS };
static const float FULL_STRAIN = 0.2f;

sbr_debug_draw sbr_default_debug_draw(void) {
  return (sbr_debug_draw){.cookie = DRAW_COOKIE, .parts = SBR_DRAW_ALL, .impulse_m = 0.1f};
}

static sbf_vec3 position_of(const sbri_point *p) {
  return sbri_vec3(p->x, p->y, p->z);
}

/* ---- Colours ---- */

static uint32_t mixed(uint32_t a, uint32_t b, float t) {
  uint32_t color = 0;
  for (int shift = 0; shift < 24; shift += 8) {
    float from = (float)(a >> shift & 255), to = (float)(b >> shift & 255);
    color |= (uint32_t)(from + (to - from) * t) << shift;
  }
  return color;
}

static uint32_t strain_color(float strain) {
  float t = sbri_clamp(strain / FULL_STRAIN, -1, 1);
  return t < 0 ? mixed(SBRI_DRAW_GREY, SBRI_DRAW_BLUE, -t) : mixed(SBRI_DRAW_GREY, SBRI_DRAW_RED, t);
}

static uint32_t island_color(const sbri_character *c, uint32_t island) {
  static const uint32_t colors[8] = {
      0xe6804d, 0x4da6e6, 0x73c973, 0xcc80cc, 0xd9c04d, 0x4dbfb3, 0xe67399, 0x9999e6};
  bool asleep = sbri_header(c)->asleep || sbri_island_states(c)[island].asleep;
  return asleep ? SBRI_DRAW_GREY : colors[island % 8];
}

/* ---- Contacts ---- */

/* Samples of a body near ground, colliders or itself. */
static void draw_soft_contacts(const sbri_character *c, uint32_t number, const sbri_debug_lines *to) {
  const sbri_body *body = &c->model->bodies[number];
  const sbri_point *positions = sbri_positions(c) + c->model->islands[body->island].first_slot;
  if (sbri_header(c)->asleep || sbri_island_states(c)[body->island].asleep) return;
  for (uint32_t i = 0; i < sbri_contact_counts(c)[number]; i++) {
    const sbri_soft_contact *contact = &sbri_contacts(c)[body->contact.first + i];
    sbf_vec3 at = {0, 0, 0};
    for (int k = 0; k < 4; k++)
      at = sbri_add_scaled(at, position_of(&positions[contact->sample.slots[k]]), contact->sample.weights[k]);
    float impulse = sbri_dot(contact->total_velocity_change, contact->normal) * contact->sample.mass_kg /
                    sbri_own_impulse(c);
    sbri_draw_contact(to, at, contact->normal, impulse);
  }
}

/* Contacts between bodies of characters. */
static void draw_body_contacts(const sbr_world *world, const sbr_debug_draw *draw) {
  const sbri_body_contacts *all = world->body_contacts;
  for (uint32_t g = 0; all && g < all->group_count; g++) {
    const sbri_contact_group *group = &all->groups[g];
    const sbri_debug_lines to = {draw, group->origin, 1};
    for (uint32_t i = 0; i < group->contact_count; i++) {
      const sbri_contact *contact = &all->contacts[group->first_contact + i];
      if (contact->tick.impulse > 0)
        sbri_draw_contact(&to, contact->tick.position, contact->normal, contact->tick.impulse);
    }
  }
}

/* ---- Soft bodies ---- */

static void draw_surface(
    const sbri_character *c, uint32_t number, uint32_t color, const sbri_debug_lines *to) {
  const sbri_body *body = &c->model->bodies[number];
  sbri_point *vertices = sbri_surface_vertices(c) + body->surface.first_vertex;
  const sbri_skin surface = sbri_skin_now(c, &body->surface.skin);
  sbri_skin_compute_vertices(c->model, &surface, sbri_positions(c), sbri_deltas(c), vertices);
  for (uint32_t i = 0; i < surface.face_block_count * SBRI_BLOCK; i++) {
    const sbri_face_block *block = &surface.faces[i / SBRI_BLOCK];
    for (int k = 0; k < 4; k++) {
      uint32_t a = block->corners[k][i % SBRI_BLOCK], b = block->corners[(k + 1) % 4][i % SBRI_BLOCK];
      if (a != b) sbri_draw_line(to, position_of(&vertices[a]), position_of(&vertices[b]), color);
    }
  }
}

static void draw_springs(const sbri_character *c, const sbri_body *body, const sbri_debug_lines *to) {
  const sbri_island *island = &c->model->islands[body->island];
  const sbri_point *positions = sbri_positions(c) + island->first_slot;
  for (uint32_t s = body->elements.first_spring; s < body->elements.spring_end; s++) {
    sbfi_spring spring = sbri_spring_now(c, island, s);
    sbf_vec3 a = position_of(&positions[spring.a]), b = position_of(&positions[spring.b]);
    if (spring.stiffness_n_m > 0)
      sbri_draw_line(to, a, b, strain_color(sbfi_spring_strain(&spring, sbri_length(sbri_sub(b, a)))));
  }
}

static void draw_tetrahedra(
    const sbri_character *c, const sbri_body *body, uint32_t color, const sbri_debug_lines *to) {
  static const int edges[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
  const sbri_island *island = &c->model->islands[body->island];
  const sbri_tetrahedron_block *blocks = island->tetrahedra.flow
                                             ? sbri_solids(c) + island->tetrahedra.first_state_block
                                             : island->tetrahedra.blocks;
  const sbri_point *positions = sbri_positions(c) + island->first_slot;
  for (uint32_t t = 0; t < body->elements.tetrahedron_count; t++) {
    uint32_t at = island->tetrahedra.lanes[2 * (body->elements.first_tetrahedron + t)],
             lane = at % SBRI_BLOCK;
    const sbri_tetrahedron_block *block = &blocks[at / SBRI_BLOCK];
    for (int e = 0; block->shear[lane] > 0 && e < 6; e++)
      sbri_draw_line(to, position_of(&positions[block->corners[edges[e][0]][lane]]),
          position_of(&positions[block->corners[edges[e][1]][lane]]), color);
  }
}

static void draw_soft_bodies(const sbri_character *c, unsigned parts, const sbri_debug_lines *to) {
  for (uint32_t b = 0; b < c->model->asset->soft_bodies.count; b++) {
    const sbri_body *body = &c->model->bodies[b];
    uint32_t color = body->level ? island_color(c, body->island) : SBRI_DRAW_GREY;
    if (parts & SBR_DRAW_SURFACES) draw_surface(c, b, color, to);
    if (!body->level) continue;
    if (parts & SBR_DRAW_SPRINGS) draw_springs(c, body, to);
    if (parts & SBR_DRAW_TETRAHEDRA) draw_tetrahedra(c, body, color, to);
    if (parts & SBR_DRAW_CONTACTS) draw_soft_contacts(c, b, to);
  }
}

/* ---- Characters ---- */

static void draw_bounds(const sbri_character *c, const sbri_debug_lines *to) {
  const sbr_transform upright = {{0, 0, 0}, {0, 0, 0, 1}};
  for (uint32_t i = 0; i < c->model->island_count; i++) {
    const sbri_island *island = &c->model->islands[i];
    const sbri_point *positions = sbri_positions(c) + island->first_slot;
    sbri_box box = {{0, 0, 0}, {0, 0, 0}};
    bool any = false;
    for (uint32_t k = 0; k < island->body_count; k++) {
      const sbri_body *body = &c->model->bodies[island->bodies[k]];
      for (uint32_t p = 0; p < body->level->positions.count; p++) {
        sbf_vec3 at = position_of(&positions[body->slots.from_point[p]]);
        box = any ? sbri_box_with(box, at) : sbri_box_of_point(at), any = true;
      }
    }
    if (any) sbri_draw_box(to, &box, &upright, island_color(c, i));
  }
}

/* `to` in metres. */
static void draw_bones(const sbri_character *c, const sbri_debug_lines *to) {
  for (uint32_t b = 0; b < c->model->rig.bones.count; b++) {
    const sbr_transform *pose = &sbri_pose(c)[b];
    float length = c->model->asset->bones.at[b].length * c->scale;
    sbri_draw_point(to, pose->position, 0.5f * SBRI_POINT_PIXELS, SBRI_DRAW_WHITE);
    sbri_draw_line(to, pose->position, sbri_add_scaled(pose->position, sbri_quat_y(pose->rotation), length),
        SBRI_DRAW_WHITE);
  }
}

static void draw_gait(const sbri_character *c, const sbri_debug_lines *to) {
  sbr_leg_state legs[MAX_DRAWN_LEGS];
  uint32_t count = sbri_gait_legs(&c->model->rig, sbri_gait(c), 1, legs, MAX_DRAWN_LEGS);
  for (uint32_t i = 0; i < count && i < MAX_DRAWN_LEGS; i++) {
    sbri_draw_point(
        to, legs[i].foot, SBRI_POINT_PIXELS, legs[i].planted ? SBRI_DRAW_GREEN : SBRI_DRAW_YELLOW);
    sbri_draw_point(to, legs[i].pole, SBRI_POINT_PIXELS, SBRI_DRAW_BLUE);
    if (legs[i].planted) continue;
    sbri_draw_point(to, legs[i].target, SBRI_POINT_PIXELS, SBRI_DRAW_RED);
    sbri_draw_line(to, legs[i].foot, legs[i].target, SBRI_DRAW_YELLOW);
  }
}

/* Length of a joint's axes in asset metres: a twentieth of the largest distance of a bone from the origin. */
static float axis_length(const sbri_character *c) {
  float reach = 0;
  for (uint32_t b = 0; b < c->model->asset->bones.count; b++)
    reach = sbri_max(reach, sbri_length(c->model->asset->bones.at[b].head));
  return reach > 0 ? 0.05f * reach : 0.05f;
}

static void draw_character(const sbr_world *world, const sbri_character *c, const sbr_debug_draw *draw) {
  const sbri_debug_lines metres = {draw, sbri_header(c)->origin, 1};
  const sbri_debug_lines asset = {draw, sbri_header(c)->origin, c->scale};
  draw_soft_bodies(c, draw->parts, &asset);
  if (draw->parts & SBR_DRAW_BOUNDS) draw_bounds(c, &asset);
  if (draw->parts & SBR_DRAW_BONES) draw_bones(c, &metres);
  if (draw->parts & SBR_DRAW_GAIT) draw_gait(c, &metres);
  if (draw->parts & SBR_DRAW_RIGID_BODIES) sbri_draw_rigid_bodies(c, &asset);
  if (draw->parts & SBR_DRAW_JOINTS) sbri_draw_joints(c, axis_length(c), &asset);
  if (draw->parts & SBR_DRAW_CONTACTS) sbri_draw_rigid_contacts(c, world->time.tick_s, &asset);
}

void sbr_world_draw(const sbr_world *world, const sbr_debug_draw *draw) {
  if (!world || !draw || draw->cookie != DRAW_COOKIE) return;
  for (uint32_t i = 0; i < world->character_capacity; i++)
    if (world->characters[i].model) draw_character(world, &world->characters[i], draw);
  if (draw->parts & SBR_DRAW_CONTACTS) draw_body_contacts(world, draw);
  if (draw->parts & SBR_DRAW_COLLIDERS) sbri_draw_colliders(world, draw);
}
