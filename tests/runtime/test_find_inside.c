/* Crossed thin limbs without a vertex inside the other, and rigid rods through soft bodies. */
#include <math.h>

#include "contact_scenes.h"
#include "harness.h"
#include "lattice_box.h"
#include "momentum.h"
#include "sbrun/collision.h"
#include "shapes/triangle.h"
#include "skin_depth.h"
#include "state/world.h"

/* A capsule with eight sides. The distance of its rings is at least its thickness. */
enum { SIDES = 8, MAX_RINGS = 24, MAX = SIDES * MAX_RINGS + 2, CELLS = 12 };
static const float LENGTH = 0.6f;

static sbf_polygon_mesh capsule(sbf_asset *asset, uint32_t rings, float radius) {
  sbf_polygon_mesh mesh;
  uint32_t faces = SIDES * (rings + 1), corner = 0;
  sbf_vec3 *at = sbf_asset_allocate(asset, SIDES * rings + 2, sizeof *at);
  uint32_t *sizes = sbf_asset_allocate(asset, faces, sizeof *sizes);
  uint32_t *corners = sbf_asset_allocate(asset, 4 * (size_t)faces, sizeof *corners);
  ck_assert(at && sizes && corners && rings <= MAX_RINGS);
  for (uint32_t i = 0; i < rings * SIDES; i++) {
    float turn = 6.2831853f * ((float)(i % SIDES) + 0.5f) / SIDES, inner = LENGTH - 2 * radius;
    at[i] = (sbf_vec3){
        inner * ((float)(i / SIDES) / (float)(rings - 1) - 0.5f), radius * cosf(turn), radius * sinf(turn)};
  }
  uint32_t ends[2] = {SIDES * rings, SIDES * rings + 1}, face = 0;
  at[ends[0]] = (sbf_vec3){-0.5f * LENGTH, 0, 0}, at[ends[1]] = (sbf_vec3){0.5f * LENGTH, 0, 0};
  for (uint32_t ring = 0; ring <= rings; ring++)
    for (uint32_t k = 0; k < SIDES; k++, face++) {
      uint32_t next = (k + 1) % SIDES, first = corner;
      if (ring > 0) corners[corner++] = SIDES * (ring - 1) + k, corners[corner++] = SIDES * (ring - 1) + next;
      if (ring == 0) corners[corner++] = ends[0];
      if (ring < rings) corners[corner++] = SIDES * ring + next, corners[corner++] = SIDES * ring + k;
      if (ring == rings) corners[corner++] = ends[1];
      sizes[face] = corner - first;
    }
  sbf_polygon_mesh_init(&mesh);
  mesh.target = SBF_MESH_TARGET_SURFACE;
  mesh.positions = (sbf_vec3_list){at, SIDES * rings + 2};
  mesh.polygon_sizes = (sbf_u32_list){sizes, faces};
  mesh.polygon_points = (sbf_u32_list){corners, corner};
  return mesh;
}

static scene begin_capsule(uint32_t rings, float radius) {
  scene s = contact_scene_begin((sbf_vec3){0, 0, 0});
  scene_bodies(&s, 1);
  lattice_box box = lattice_box_make((sbf_vec3){-0.5f * LENGTH, -radius, -radius},
      (sbf_vec3){LENGTH, 2 * radius, 2 * radius}, CELLS, 1, 1, 1000, 1e5f, 0.3f);
  sbf_level *level = scene_lattice(&s, 0, &box);
  scene_body(&s, 0)->surface = capsule(s.asset, rings, radius);
  scene_embed(&s, level, &box);
  lattice_box_free(&box);
  scene_body(&s, 0)->attributes.damping_ratio = 0.5f;
  scene_body(&s, 0)->attributes.friction = 0.5f;
  return s;
}

static void check(const scene *s, sbr_character_id who, sbf_vec3 at[MAX]) {
  sbr_double3 o = sbr_character_get_origin(s->world, who);
  uint32_t count = sbr_character_get_surface(s->world, who, 0, at, MAX);
  for (uint32_t i = 0; i < count; i++)
    at[i] = (sbf_vec3){at[i].x + (float)o.x, at[i].y + (float)o.y, at[i].z + (float)o.z};
}

/* Number of polygon edges of one that pass through polygons of the other. */
static uint32_t crossings(const sbf_polygon_mesh *mesh, const sbf_vec3 *one, const sbf_vec3 *other) {
  uint32_t count = 0;
  const uint32_t *c = mesh->polygon_points.at;
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; c += mesh->polygon_sizes.at[p++])
    for (uint32_t k = 0; k < mesh->polygon_sizes.at[p]; k++) {
      sbf_vec3 from = one[c[k]], displacement = sbri_sub(one[c[(k + 1) % mesh->polygon_sizes.at[p]]], from);
      const uint32_t *d = mesh->polygon_points.at;
      for (uint32_t q = 0; q < mesh->polygon_sizes.count; d += mesh->polygon_sizes.at[q++])
        for (uint32_t i = 2; i < mesh->polygon_sizes.at[q]; i++)
          count += sbri_triangle_cross(from, displacement, other[d[0]], other[d[i - 1]], other[d[i]]) >= 0;
    }
  return count;
}

static uint32_t crossings_of(const scene *s, sbr_character_id one, sbr_character_id other) {
  static sbf_vec3 a[MAX], b[MAX];
  const sbf_polygon_mesh *mesh = &s->asset->soft_bodies.at[0].surface;
  check(s, one, a), check(s, other, b);
  return crossings(mesh, a, b) + crossings(mesh, b, a);
}

typedef struct crossing {
  uint32_t rings;
  float radius, y, along, heading;
} crossing;
static const crossing positions[] = {
    {7, 0.02f, 0.004f, 0.03f, 1.5708f},
    {7, 0.02f, 0, 0, 1.2f},
    {7, 0.02f, 0.02f, 0.12f, 0.9f},
    {13, 0.02f, 0.005f, 0.02f, 1.5708f},
    {22, 0.02f, 0.004f, 0.01f, 1.5708f},
    {22, 0.01f, 0.002f, 0.07f, 1.2f},
};

START_TEST(crossed_thin_limbs_separate)
{
  const crossing *at = &positions[_i];
  scene s = begin_capsule(at->rings, at->radius);
  contact_scene_start(&s);
  sbr_character_definition d = s.character_definition;
  sbr_character_id other;
  d.position.x += (double)at->along, d.position.y += (double)at->y, d.heading = at->heading;
  ck_assert(sbr_character_create(s.world, s.model, &d, &other, NULL) == SBF_OK);
  ck_assert_uint_ge(crossings_of(&s, s.character, other), 4);
  double speed = 0;
  for (int i = 0; i < 180; i++) {
    scene_ticks(&s, 1);
    if (i > 3)
      speed = fmax(speed, fmax(contact_scene_fastest(&s, s.character), contact_scene_fastest(&s, other)));
  }
  scene_momentum after = scene_momentum_of(&s);
  ck_assert_uint_eq(crossings_of(&s, s.character, other), 0);
  ck_assert_double_le(speed, 0.5);
  for (int k = 0; k < 3; k++) ck_assert_double_le(fabs(after.linear[k]), 1e-4 * after.mass);
  scene_free(&s);
}
END_TEST

/* ---- Rigid bodies inside soft bodies ---- */

typedef struct pierced {
  uint32_t rings;
  float radius;
  sbf_vec3 size, at;
} pierced;
static const pierced rods[] = {
    {9, 0.04f, {0.03f, 0.03f, 0.4f}, {0.02f, 0.004f, 0.05f}},  /* a rod through a limb */
    {7, 0.02f, {0.03f, 0.03f, 0.4f}, {0.03f, 0.004f, 0.02f}},  /* a thin limb without a vertex in it */
    {22, 0.05f, {0.02f, 0.02f, 0.03f}, {0.07f, 0.01f, 0.01f}}, /* surrounded by a limb */
    {13, 0.03f, {0.2f, 0.2f, 0.02f}, {0.3f, 0, 0}},            /* a plate at the end of one */
};

static sbf_vec3 corner_of(const scene *s, sbf_vec3 size, uint32_t k) {
  const sbri_rigid_body_state *b = sbri_rigid_bodies(sbri_character_of(s->world, s->character));
  sbf_vec3 own = {k & 1 ? size.x : -size.x, k & 2 ? size.y : -size.y, k & 4 ? size.z : -size.z};
  return sbri_add_scaled(b->pose.position, sbri_rotate(b->pose.rotation, own), 0.5f);
}

static bool box_holds(const scene *s, sbf_vec3 size, sbf_vec3 x) {
  const sbri_rigid_body_state *b = sbri_rigid_bodies(sbri_character_of(s->world, s->character));
  sbf_vec3 own = sbri_rotate(sbri_quat_conjugate(b->pose.rotation), sbri_sub(x, b->pose.position));
  const float slack = 1e-3f;
  return fabsf(own.x) < 0.5f * size.x - slack && fabsf(own.y) < 0.5f * size.y - slack &&
         fabsf(own.z) < 0.5f * size.z - slack;
}

/* Numbers of sampled points of the box's edges inside the skin, and of the skin's edges inside the box. */
static uint32_t places_inside(const scene *s, sbf_vec3 size) {
  enum { PLACES = 40 };
  static sbf_vec3 at[MAX];
  const sbf_polygon_mesh *mesh = &s->asset->soft_bodies.at[0].surface;
  uint32_t count = 0;
  (void)sbr_character_get_surface(s->world, s->character, 0, at, MAX);
  for (uint32_t k = 0; k < 8; k++)
    for (uint32_t axis = 1; axis < 8; axis *= 2)
      for (int i = 0; i <= PLACES && !(k & axis); i++) {
        sbf_vec3 from = corner_of(s, size, k), to = corner_of(s, size, k | axis);
        count += skin_depth(mesh, at, sbri_lerp(from, to, (float)i / PLACES), UINT32_MAX) > 1e-3;
      }
  const uint32_t *c = mesh->polygon_points.at;
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; c += mesh->polygon_sizes.at[p++])
    for (uint32_t k = 0; k < mesh->polygon_sizes.at[p]; k++)
      for (int i = 0; i < PLACES; i++)
        count += box_holds(
            s, size, sbri_lerp(at[c[k]], at[c[(k + 1) % mesh->polygon_sizes.at[p]]], (float)i / PLACES));
  return count;
}

/* Placed there as if a soft body was pushed over a rigid one. Both are parts of one character. */
START_TEST(rigid_bodies_leave_soft_bodies)
{
  const pierced *r = &rods[_i];
  scene s = begin_capsule(r->rings, r->radius);
  rigid_box(&s, (sbf_vec3){0, 0.5f, 0}, r->size, 0.3f);
  contact_scene_start(&s);
  sbri_character *c = sbri_character_of(s.world, s.character);
  sbri_rigid_bodies(c)[0].pose.position = r->at;
  ck_assert_uint_ge(places_inside(&s, r->size), 10);
  double speed = 0;
  for (int i = 0; i < 240; i++) {
    scene_ticks(&s, 1);
    if (i > 3) speed = fmax(speed, contact_scene_fastest(&s, s.character));
  }
  ck_assert_uint_eq(places_inside(&s, r->size), 0);
  ck_assert_double_le(speed, 0.8);
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("find_inside");
  TCase *tests = tcase_create("all");
  tcase_add_loop_test(tests, crossed_thin_limbs_separate, 0, sizeof positions / sizeof *positions);
  tcase_add_loop_test(tests, rigid_bodies_leave_soft_bodies, 0, sizeof rods / sizeof *rods);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
