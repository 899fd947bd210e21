/* Skins that lattices carry: against those of others, and against themselves. */
#include <math.h>
#include <string.h>

#include "collision_scenes.h"
#include "contact_scenes.h"
#include "coupling/body_contact/body_contacts.h"
#include "harness.h"
#include "momentum.h"
#include "rigid_scenes.h"
#include "skin_depth.h"
#include "state/world.h"

/* A soft bar, bent to a U that lies on its side: two legs, 8 cm apart. Its lattice has 18 x 2 x 2 cells, its
 * skin 24 x 3 x 3 squares. */
enum { LONG = 18, WIDE = 2, SKIN_LONG = 24, SKIN_WIDE = 3 };
enum { SKIN_MAX = (SKIN_LONG + 1) * (SKIN_WIDE + 1) * (SKIN_WIDE + 1) };
static const float LEG = 0.36f, THICK = 0.1f, GAP = 0.08f;
static const sbf_vec3 weight = {0, -9.81f, 0};

/* From the straight bar: `along` from 0 to 1, the others from -1 to 1. */
static sbf_vec3 bent(float along, float up, float side) {
  const float radius = (GAP + THICK) / 2, pi = 3.14159265f, length = 2 * LEG + pi * radius;
  float at = along * length, off = radius - 0.5f * THICK * up, z = 0.5f * THICK * side;
  if (at < LEG) return (sbf_vec3){at - LEG, -off, z};
  if (at > length - LEG) return (sbf_vec3){length - LEG - at, off, z};
  float angle = (at - LEG) / radius - pi / 2;
  return (sbf_vec3){off * cosf(angle), off * sinf(angle), z};
}

static sbf_vec3 bent_from(uint32_t x, uint32_t y, uint32_t z, uint32_t length, uint32_t width) {
  return bent((float)x / (float)length, 2 * (float)y / (float)width - 1, 2 * (float)z / (float)width - 1);
}

/* The skin's vertices, those on the outside alone. */
static void skin_surface(scene *s, uint32_t body) {
  enum { MAX_FACES = 4 * SKIN_LONG * SKIN_WIDE + 2 * SKIN_WIDE * SKIN_WIDE };
  const uint32_t cells[3] = {SKIN_LONG, SKIN_WIDE, SKIN_WIDE};
  uint32_t *sizes = sbf_asset_allocate(s->asset, MAX_FACES, sizeof *sizes), numbers[SKIN_MAX];
  uint32_t *corners = sbf_asset_allocate(s->asset, 4 * MAX_FACES, sizeof *corners);
  sbf_vec3 *at = sbf_asset_allocate(s->asset, SKIN_MAX, sizeof *at);
  uint32_t faces = 0, points = 0;
  ck_assert(sizes && corners && at);
  memset(numbers, 0xff, sizeof numbers);
  for (uint32_t axis = 0; axis < 3; axis++)
    for (uint32_t far = 0; far < 2; far++)
      for (uint32_t u = 0; u < cells[(axis + 1) % 3]; u++)
        for (uint32_t v = 0; v < cells[(axis + 2) % 3]; v++, faces++) {
          static const uint32_t turns[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
          sizes[faces] = 4;
          for (int k = 0; k < 4; k++) {
            uint32_t c[3], turn = (uint32_t)(far ? k : 3 - k);
            c[axis] = far * cells[axis];
            c[(axis + 1) % 3] = u + turns[turn][0], c[(axis + 2) % 3] = v + turns[turn][1];
            uint32_t *number = &numbers[(c[0] * (SKIN_WIDE + 1) + c[1]) * (SKIN_WIDE + 1) + c[2]];
            if (*number == UINT32_MAX) {
              at[points] = bent_from(c[0], c[1], c[2], SKIN_LONG, SKIN_WIDE);
              *number = points++;
            }
            corners[4 * faces + (uint32_t)k] = *number;
          }
        }
  sbf_polygon_mesh *mesh = &scene_body(s, body)->surface;
  mesh->positions = (sbf_vec3_list){at, points};
  mesh->polygon_sizes = (sbf_u32_list){sizes, faces};
  mesh->polygon_points = (sbf_u32_list){corners, 4 * faces};
}

/* `pinned`: the lower leg's underside is. */
static scene begin_bar(bool self, bool pinned, float young_pa) {
  scene s = rigid_begin();
  scene_bodies(&s, 1);
  lattice_box box = lattice_box_make(
      (sbf_vec3){0, 0, 0}, (sbf_vec3){1, THICK, THICK}, LONG, WIDE, WIDE, 1000, young_pa, 0.3f);
  for (uint32_t x = 0; x <= LONG; x++)
    for (uint32_t y = 0; y <= WIDE; y++)
      for (uint32_t z = 0; z <= WIDE; z++) {
        uint32_t i = lattice_box_point(&box, x, y, z);
        box.positions[i] = bent_from(x, y, z, LONG, WIDE);
        if (pinned && y == 0 && x < LONG / 3) box.masses[i] = 0;
      }
  sbf_level *level = scene_lattice(&s, 0, &box);
  skin_surface(&s, 0);
  scene_embed(&s, level, &box);
  lattice_box_free(&box);
  scene_body(&s, 0)->attributes.damping_ratio = 0.5f;
  scene_body(&s, 0)->attributes.friction = 0.5f;
  scene_body(&s, 0)->collision.self = self;
  return s;
}

static void start(scene *s) {
  scene_start(s);
  ck_assert(sbr_world_enable_body_contacts(s->world, 0, NULL) == SBF_OK);
}

/* ---- Depth of skins in each other ---- */

typedef struct placed_skin {
  sbf_vec3 at[SKIN_MAX];
  uint32_t count;
} placed_skin;

static placed_skin skin_of(const scene *s, sbr_character_id who) {
  placed_skin skin;
  sbr_double3 o = sbr_character_get_origin(s->world, who);
  skin.count = sbr_character_get_surface(s->world, who, 0, skin.at, SKIN_MAX);
  for (uint32_t i = 0; i < skin.count; i++)
    skin.at[i] = (sbf_vec3){skin.at[i].x + (float)o.x, skin.at[i].y + (float)o.y, skin.at[i].z + (float)o.z};
  return skin;
}

static double depth_in(const scene *s, const placed_skin *skin, sbf_vec3 x, uint32_t own) {
  return skin_depth(&s->asset->soft_bodies.at[0].surface, skin->at, x, own);
}

static double deepest(const scene *s, const placed_skin *a, const placed_skin *b) {
  double max = 0;
  for (uint32_t v = 0; v < a->count; v++) max = fmax(max, depth_in(s, b, a->at[v], UINT32_MAX));
  for (uint32_t v = 0; v < b->count; v++) max = fmax(max, depth_in(s, a, b->at[v], UINT32_MAX));
  return max;
}

/* Depth of a skin within itself, tested just inside each vertex, where its winding number is 1. */
static double deepest_in_itself(const scene *s, const placed_skin *skin) {
  const sbf_polygon_mesh *mesh = &s->asset->soft_bodies.at[0].surface;
  static sbf_vec3 normals[SKIN_MAX];
  const uint32_t *c = mesh->polygon_points.at;
  double max = 0;
  memset(normals, 0, sizeof normals);
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; p++, c += 4) {
    sbf_vec3 n =
        sbri_cross(sbri_sub(skin->at[c[2]], skin->at[c[0]]), sbri_sub(skin->at[c[3]], skin->at[c[1]]));
    for (int k = 0; k < 4; k++) normals[c[k]] = sbri_add(normals[c[k]], n);
  }
  for (uint32_t v = 0; v < skin->count; v++) {
    sbf_vec3 in = sbri_scale(normals[v], -5e-4f / sbri_length(normals[v]));
    max = fmax(max, depth_in(s, skin, sbri_add(skin->at[v], in), v));
  }
  return max;
}

/* ---- Itself ---- */

/* The upper leg sinks onto the lower one, and lies there; without `self` it sinks into it. */
START_TEST(a_skin_rests_on_itself)
{
  double max[2] = {0, 0};
  for (int self = 0; self < 2; self++) {
    scene s = begin_bar(self, true, 3e4f);
    s.asset->environment.gravity = weight;
    start(&s);
    for (int i = 0; i < 360; i++) {
      scene_ticks(&s, 1);
      placed_skin skin = skin_of(&s, s.character);
      if (i % 5 == 0) max[self] = fmax(max[self], deepest_in_itself(&s, &skin));
    }
    ck_assert(!sbr_character_get_body_health(s.world, s.character, 0).inverted);
    if (self) ck_assert_double_le(contact_scene_fastest(&s, s.character), 1e-3);
    scene_free(&s);
  }
  ck_assert_double_ge(max[0], 0.02);
  ck_assert_double_le(max[1], 0.004);
}
END_TEST

/* At rest no faces are near each other: a body with self-collision moves like one without. */
START_TEST(parts_separate_at_rest_get_no_impulses)
{
  scene s = begin_bar(true, false, 3e4f);
  s.asset->environment.gravity = (sbf_vec3){0, 0, 0};
  start(&s);
  scene_ticks(&s, 60);
  ck_assert_double_le(contact_scene_fastest(&s, s.character), 1e-4);
  scene_free(&s);
}
END_TEST

/* Three sections: two touch at rest, and one is separate. */
START_TEST(sections_in_contact_at_rest_stay_connected)
{
  scene s = scene_begin();
  scene_bodies(&s, 3);
  scene_bone(&s, (sbf_vec3){0, 0, 0});
  for (uint32_t b = 0; b < 3; b++)
    scene_section(
        &s, b, (sbf_vec3){0, 0, 0.199f * (float)b + (b == 2 ? 0.02f : 0)}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 3);
  start(&s);
  const uint8_t *together = s.world->body_contacts->shapes.rest_relations[0];
  ck_assert_uint_eq(together[1], 1);
  ck_assert_uint_eq(together[3], 1);
  ck_assert_uint_eq(together[2], 0);
  ck_assert_uint_eq(together[5], 0);
  scene_free(&s);
}
END_TEST

/* ---- Each other ---- */

static scene begin_two(float off, float y, sbr_character_id *other) {
  scene s = begin_bar(false, false, 1e5f);
  s.asset->environment.gravity = (sbf_vec3){0, 0, 0};
  start(&s);
  sbr_character_definition d = s.character_definition;
  d.position.x += (double)off, d.position.y += (double)y;
  ck_assert(sbr_character_create(s.world, s.model, &d, other, NULL) == SBF_OK);
  return s;
}

static void move(const scene *s, sbr_character_id who, float x) {
  sbri_character *c = sbri_character_of(s->world, who);
  for (uint32_t slot = 0; slot < c->model->islands[0].free_count; slot++)
    sbri_velocities(c)[3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK] = x;
}

static double find_displacement(const placed_skin *from, const placed_skin *to) {
  double sum = 0;
  for (uint32_t i = 0; i < from->count; i++) sum += (double)(to->at[i].x - from->at[i].x) / from->count;
  return sum;
}

/* Two of them, the one's bend at 2 m/s into the other's legs. */
START_TEST(skins_of_two_push_each_other_off)
{
  sbr_character_id other;
  scene s = begin_two(-0.65f, 0.05f, &other);
  move(&s, other, 2);
  double max = 0;
  for (int i = 0; i < 60; i++) {
    scene_ticks(&s, 1);
    placed_skin one = skin_of(&s, s.character), two = skin_of(&s, other);
    max = fmax(max, deepest(&s, &one, &two));
  }
  placed_skin begin = skin_of(&s, s.character);
  scene_ticks(&s, 1);
  placed_skin end = skin_of(&s, s.character);
  ck_assert_double_le(max, 0.006);
  ck_assert_double_ge(find_displacement(&begin, &end), 0.8 / 60);
  scene_free(&s);
}
END_TEST

/* Overlapping by nine millimetres, they separate. */
START_TEST(parts_that_got_inside_separate)
{
  sbr_character_id other;
  scene s = begin_two(0, GAP + 2 * THICK - 0.009f, &other);
  placed_skin one = skin_of(&s, s.character), two = skin_of(&s, other);
  ck_assert_double_ge(deepest(&s, &one, &two), 0.008);
  scene_ticks(&s, 120);
  one = skin_of(&s, s.character), two = skin_of(&s, other);
  ck_assert_double_le(deepest(&s, &one, &two), 5e-4);
  ck_assert_double_le(contact_scene_fastest(&s, other), 0.25); /* no faster than the recovery speed */
  scene_free(&s);
}
END_TEST

/* They also separate from an overlap of three or four centimetres, where no face is near (half the thickness
 * of a leg is ten). From four centimetres, corners are compressed flat on the way and leave the legs swinging
 * at 0.4 to 0.7 m/s, as at the start; with 64 steps a tick, at 0.8. */
START_TEST(parts_deep_inside_separate)
{
  sbr_character_id other;
  float deep = _i ? 0.04f : 0.03f;
  scene s = begin_two(0, GAP + 2 * THICK - deep, &other);
  placed_skin one = skin_of(&s, s.character), two = skin_of(&s, other);
  ck_assert_double_ge(deepest(&s, &one, &two), 0.8 * (double)deep);
  scene_ticks(&s, 240);
  one = skin_of(&s, s.character), two = skin_of(&s, other);
  ck_assert_double_le(deepest(&s, &one, &two), 5e-4);
  ck_assert_double_le(contact_scene_fastest(&s, other), _i ? 0.8 : 0.4);
  scene_free(&s);
}
END_TEST

/* One lies on the ground, the other falls on it, straight or tilted. Overlaps from the impact end. Only the
 * faster of these impacts causes deep overlaps in every orientation. */
START_TEST(characters_thrown_down_hard_separate)
{
  static const float speeds_m_s[] = {15, 40};
  bool aslant = _i % 2, fast = _i / 2;
  sbr_character_id other;
  scene s = begin_bar(false, false, 1e5f);
  s.world_definition.ground = sbr_ground_flat(0);
  s.character_definition.position.y = (double)(THICK + 0.5f * GAP);
  s.asset->environment.gravity = weight;
  start(&s);
  sbr_character_definition d = s.character_definition;
  d.position.x += aslant ? 0.15 : 0, d.position.z += aslant ? 0.03 : 0, d.position.y += 0.35;
  d.heading = aslant ? 0.6f : 0;
  ck_assert(sbr_character_create(s.world, s.model, &d, &other, NULL) == SBF_OK);
  sbri_character *c = sbri_character_of(s.world, other);
  for (uint32_t slot = 0; slot < c->model->islands[0].free_count; slot++)
    sbri_velocities(c)[3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + SBRI_BLOCK + slot % SBRI_BLOCK] =
        -speeds_m_s[fast];
  double max = 0;
  for (int i = 0; i < 300; i++) {
    scene_ticks(&s, 1);
    if (i > 60 || i % 3) continue;
    placed_skin one = skin_of(&s, s.character), two = skin_of(&s, other);
    double deep = deepest(&s, &one, &two);
    max = deep > max ? deep : max;
  }
  placed_skin one = skin_of(&s, s.character), two = skin_of(&s, other);
  if (fast) ck_assert_double_ge(max, 0.02);
  ck_assert_double_le(deepest(&s, &one, &two), 0.004);
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("find");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, a_skin_rests_on_itself);
  tcase_add_test(tests, parts_separate_at_rest_get_no_impulses);
  tcase_add_test(tests, sections_in_contact_at_rest_stay_connected);
  tcase_add_test(tests, skins_of_two_push_each_other_off);
  tcase_add_test(tests, parts_that_got_inside_separate);
  tcase_add_loop_test(tests, characters_thrown_down_hard_separate, 0, HARNESS_FEW(4, 1));
  tcase_add_loop_test(tests, parts_deep_inside_separate, 0, 2);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
