/* A host's impulses on soft bodies change momentum by exactly their amount, and pin reactions equal the
 * load. */
#include "sbrun/soft_body.h"

#include <math.h>
#include <string.h>

#include "harness.h"
#include "momentum.h"
#include "sbfmt/codes.h"
#include "scenes.h"

static const float density = 500, size_m = 0.4f, gravity = 10;
static const sbf_scheme schemes[] = {
    SBF_SCHEME_SYMPLECTIC, SBF_SCHEME_POSITION_BASED, SBF_SCHEME_HEUN, SBF_SCHEME_BLOCK_DESCENT};
enum { SCHEMES = sizeof schemes / sizeof *schemes };
/* Tolerances: of momentum, because the sweeps of block descent end before convergence, and of the forces at
 * rest, which a single position-based sweep leaves unbalanced. */
static const float momentum_off[SCHEMES] = {2e-4f, 2e-4f, 2e-4f, 2e-3f};
static const float balance_off[SCHEMES] = {1e-3f, 1e-2f, 1e-3f, 1e-3f};

/* A cube of tetrahedra with a surface about it, free or with its side x = 0 held by the world; not damped. */
static scene cube(sbf_scheme scheme, bool pinned, float gravity_m_s2, float scale) {
  scene s = scene_begin();
  lattice_box box =
      lattice_box_make((sbf_vec3){0, 1, 0}, (sbf_vec3){size_m, size_m, size_m}, 2, 2, 2, density, 2e5f, 0.3f);
  scene_bone(&s, (sbf_vec3){0, 1, 0});
  sbf_soft_body *body = scene_body(&s, 0);
  scene_section(&s, 0, (sbf_vec3){0.2f, 1.2f, 0.2f}, (sbf_vec3){size_m, size_m, size_m}, 2);
  if (pinned) lattice_box_hold(&box);
  scene_embed(&s, scene_lattice(&s, 0, &box), &box);
  lattice_box_free(&box);
  body->attributes.damping_ratio = pinned ? 1 : 0;
  s.model_options.scheme = scheme;
  s.world_definition.has_gravity = true;
  s.world_definition.gravity = (sbf_vec3){0, -gravity_m_s2, 0};
  s.character_definition.scale = scale;
  scene_start(&s);
  return s;
}

static float mass_of(const scene *s) {
  return sbr_character_get_soft_motion(s->world, s->character, 0).mass;
}

static sbf_vec3 vertex_at(const scene *s, uint32_t vertex) {
  sbf_vec3 vertices[256];
  uint32_t count = sbr_character_get_surface(s->world, s->character, 0, vertices, 256);
  ck_assert_uint_lt(vertex, count);
  return vertices[vertex];
}

/* The vertex at the corner with the greatest coordinates. */
static uint32_t far_corner(const scene *s) {
  sbr_double3 o = sbr_character_get_origin(s->world, s->character);
  return sbr_character_find_nearest_vertex(
      s->world, s->character, 0, (sbr_double3){o.x + 9, o.y + 9, o.z + 9});
}

static void check_vec3(const double is[3], const double wanted[3], double tolerance) {
  for (int k = 0; k < 3; k++) ck_assert_double_eq_tol(is[k], wanted[k], tolerance);
}

START_TEST(an_impulse_adds_equal_momentum)
{
  const float scale = _i ? 0.25f : 1;
  scene s = cube(SBF_SCHEME_SYMPLECTIC, false, 0, scale);
  const sbf_vec3 impulse = {
      0.3f * scale * scale * scale, -0.2f * scale * scale * scale, 0.1f * scale * scale * scale};
  uint32_t vertex = far_corner(&s);
  sbf_vec3 r = vertex_at(&s, vertex);
  ck_assert_float_eq_tol(
      mass_of(&s), density * size_m * size_m * size_m * scale * scale * scale, 1e-3f * mass_of(&s));
  scene_ticks(&s, 3);
  ck_assert_int_eq(sbr_character_apply_soft_impulse(s.world, s.character, 0, vertex, impulse, NULL), SBF_OK);
  /* In the character's own units: momentum of masses by the cube, speeds by the root, lengths by the scale.
   */
  double own = 1 / (pow((double)scale, 3) * sqrt((double)scale));
  const double p[3] = {own * (double)impulse.x, own * (double)impulse.y, own * (double)impulse.z};
  const double x[3] = {(double)(r.x / scale), (double)(r.y / scale), (double)(r.z / scale)};
  const double l[3] = {x[1] * p[2] - x[2] * p[1], x[2] * p[0] - x[0] * p[2], x[0] * p[1] - x[1] * p[0]};
  for (int i = 0; i < 2; i++, scene_ticks(&s, 20)) {
    scene_momentum m = scene_momentum_of(&s);
    check_vec3(m.linear, p, 2e-6);
    check_vec3(m.angular, l, 2e-5);
  }
  scene_free(&s);
}
END_TEST

START_TEST(an_impulse_on_the_whole_body_deforms_nothing)
{
  scene s = cube(SBF_SCHEME_SYMPLECTIC, false, 0, 1);
  float mass = mass_of(&s);
  ck_assert_int_eq(sbr_character_apply_soft_impulse(
                       s.world, s.character, 0, SBR_WHOLE_BODY, (sbf_vec3){2 * mass, 0, 0}, NULL),
      SBF_OK);
  scene_ticks(&s, 30);
  sbr_soft_motion m = sbr_character_get_soft_motion(s.world, s.character, 0);
  ck_assert_float_eq_tol(m.velocity.x, 2, 1e-5f);
  ck_assert_float_eq_tol(m.angular_velocity.y, 0, 1e-4f);
  ck_assert_double_lt(sbr_character_get_body_health(s.world, s.character, 0).elastic_j, 1e-6);
  scene_free(&s);
}
END_TEST

START_TEST(a_velocity_that_is_set_is_read_back)
{
  scene s = cube(SBF_SCHEME_SYMPLECTIC, false, 0, 0.5f);
  const sbf_vec3 v = {1, -2, 0.5f}, w = {0.5f, 2, -1};
  for (int i = 0; i < 2; i++) { /* regardless of its previous motion */
    ck_assert_int_eq(sbr_character_set_soft_velocity(s.world, s.character, 0, v, w, NULL), SBF_OK);
    sbr_soft_motion m = sbr_character_get_soft_motion(s.world, s.character, 0);
    ck_assert_float_eq_tol(m.velocity.x, v.x, 1e-5f);
    ck_assert_float_eq_tol(m.velocity.y, v.y, 1e-5f);
    ck_assert_float_eq_tol(m.velocity.z, v.z, 1e-5f);
    ck_assert_float_eq_tol(m.angular_velocity.x, w.x, 1e-4f);
    ck_assert_float_eq_tol(m.angular_velocity.y, w.y, 1e-4f);
    ck_assert_float_eq_tol(m.angular_velocity.z, w.z, 1e-4f);
    sbf_vec3 before = m.center;
    scene_ticks(&s, 6); /* no weight: it continues in a straight line */
    sbf_vec3 now = sbr_character_get_soft_motion(s.world, s.character, 0).center;
    ck_assert_float_eq_tol(now.x - before.x, 0.1f * v.x, 1e-4f);
    ck_assert_float_eq_tol(now.y - before.y, 0.1f * v.y, 1e-4f);
  }
  scene_free(&s);
}
END_TEST

/* 2.4 ticks: of the third a part. */
START_TEST(a_force_acts_for_its_duration)
{
  scene s = cube(schemes[_i], false, 0, 1);
  const sbf_vec3 force = {5, 0, -20};
  const float seconds = 0.04f;
  uint32_t at[2] = {far_corner(&s), SBR_WHOLE_BODY};
  for (int k = 0; k < 2; k++) {
    ck_assert_int_eq(
        sbr_character_apply_soft_force(s.world, s.character, 0, at[k], force, seconds, NULL), SBF_OK);
    scene_ticks(&s, 10);
    scene_momentum m = scene_momentum_of(&s);
    const double p[3] = {(k + 1) * (double)(force.x * seconds), 0, (k + 1) * (double)(force.z * seconds)};
    check_vec3(m.linear, p, (double)(momentum_off[_i] * (force.z * -seconds)));
  }
  scene_free(&s);
}
END_TEST

START_TEST(pins_report_the_load_on_them)
{
  const float scale = _i < SCHEMES ? 1 : 0.5f;
  scene s = cube(schemes[_i % SCHEMES], true, gravity, scale);
  scene_ticks(&s, 600);
  sbr_pin_reaction r;
  ck_assert_uint_eq(sbr_character_get_pin_reactions(s.world, s.character, 0, &r, 1), 1);
  float weight = mass_of(&s) * gravity, off = balance_off[_i % SCHEMES];
  ck_assert_uint_eq(r.points, 9);
  ck_assert_int_eq(r.bone, -1);
  ck_assert_float_eq_tol(r.force.y, weight, off * weight);
  ck_assert_float_eq_tol(r.force.x, 0, off * weight);
  /* The centre of mass is to the side: the moment of the pins is weight times lever arm. */
  sbr_soft_motion m = sbr_character_get_soft_motion(s.world, s.character, 0);
  float arm = m.center.x - r.about.x;
  ck_assert_float_gt(arm, 0.15f * scale);
  ck_assert_float_eq_tol(r.torque.z, arm * weight, off * arm * weight);
  scene_free(&s);
}
END_TEST

/* A bar along x, held at x = 0, and by a second set at its other end where `both`. */
static scene bar(sbf_scheme scheme, bool both, float damping_ratio) {
  scene s = scene_begin();
  lattice_box box =
      lattice_box_make((sbf_vec3){0, 1, 0}, (sbf_vec3){1, 0.2f, 0.2f}, 10, 2, 2, density, 1e6f, 0.3f);
  uint32_t far_count = 0, *far = sbf_asset_allocate(s.asset, 9, sizeof *far);
  ck_assert_ptr_nonnull(far);
  lattice_box_hold(&box);
  for (uint32_t y = 0; both && y <= 2; y++)
    for (uint32_t z = 0; z <= 2; z++) far[far_count++] = lattice_box_point(&box, 10, y, z);
  for (uint32_t i = 0; i < far_count; i++) box.masses[far[i]] = 0;
  sbf_level *level = scene_lattice(&s, 0, &box);
  if (both) {
    sbf_pin_set *sets = sbf_asset_allocate(s.asset, 2, sizeof *sets);
    uint32_t *near = sbf_asset_allocate(s.asset, 9, sizeof *near), near_count = 0;
    ck_assert(sets && near);
    for (uint32_t i = 0; i < level->pins.at[0].points.count; i++)
      if (!(box.positions[level->pins.at[0].points.at[i]].x > 0))
        near[near_count++] = level->pins.at[0].points.at[i];
    sets[0] = sets[1] = level->pins.at[0];
    sets[0].points = (sbf_u32_list){near, near_count};
    sets[1].points = (sbf_u32_list){far, far_count};
    level->pins = (sbf_pin_set_list){sets, 2};
  }
  lattice_box_free(&box);
  scene_body(&s, 0)->attributes.damping_ratio = damping_ratio;
  s.model_options.scheme = scheme;
  s.world_definition.has_gravity = true;
  s.world_definition.gravity = (sbf_vec3){0, -gravity, 0};
  scene_start(&s);
  return s;
}

START_TEST(both_ends_carry_half_a_bar)
{
  scene s = bar(schemes[_i], true, 1);
  sbr_pin_reaction r[2];
  scene_ticks(&s, 300);
  ck_assert_uint_eq(sbr_character_get_pin_reactions(s.world, s.character, 0, r, 2), 2);
  float weight = mass_of(&s) * gravity;
  ck_assert_float_gt(r[1].about.x - r[0].about.x, 0.99f);
  for (int k = 0; k < 2; k++) {
    ck_assert_uint_eq(r[k].points, 9);
    ck_assert_float_eq_tol(r[k].force.y, weight / 2, 0.01f * weight);
  }
  /* It sags: each end pulls the bar outwards and resists its rotation. */
  ck_assert_float_lt(r[0].force.x, 0);
  ck_assert_float_eq_tol(r[1].force.x, -r[0].force.x, 0.01f * weight);
  ck_assert_float_gt(r[0].torque.z, 0.05f * weight);
  scene_free(&s);
}
END_TEST

/* The gain of momentum is the time integral of weight and reactions, at the end of each tick, in the schemes
 * that step by forces. */
START_TEST(momentum_changes_by_pin_forces_and_weight)
{
  scene s = bar(_i ? SBF_SCHEME_HEUN : SBF_SCHEME_SYMPLECTIC, false, 0);
  sbr_pin_reaction before, after;
  double impulse[2] = {0, 0}, tick_s = 1.0 / 60, weight = (double)(mass_of(&s) * gravity);
  enum { TICKS = 20 };
  ck_assert_uint_eq(sbr_character_get_pin_reactions(s.world, s.character, 0, &before, 1), 1);
  ck_assert_double_lt(fabs((double)before.force.y), 0.01 * weight); /* nothing has sagged yet */
  for (int i = 0; i < TICKS; i++, before = after) {
    scene_ticks(&s, 1);
    sbr_character_get_pin_reactions(s.world, s.character, 0, &after, 1);
    impulse[0] += tick_s / 2 * (double)(before.force.x + after.force.x);
    impulse[1] += tick_s / 2 * (double)(before.force.y + after.force.y);
  }
  sbr_soft_motion m = sbr_character_get_soft_motion(s.world, s.character, 0);
  double whole = weight * TICKS * tick_s;
  ck_assert_double_eq_tol((double)(m.mass * m.velocity.y), impulse[1] - whole, 0.01 * whole);
  ck_assert_double_eq_tol((double)(m.mass * m.velocity.x), impulse[0], 0.01 * whole);
  ck_assert_double_gt(impulse[1], 0.2 * whole);
  scene_free(&s);
}
END_TEST

/* A goal spring stretches by m g / k and pulls with that. */
START_TEST(goal_springs_are_pins_too)
{
  scene s = scene_begin();
  const sbf_vec3 at = {0, 1, 0};
  const float kg = 2;
  const uint32_t point = 0;
  scene_body(&s, 0)->attributes.mass_damping = 8;
  sbf_level *level = scene_points(&s, 0, &at, &kg, 1);
  scene_pin(&s, level, -1, &point, 1);
  sbf_pin_set *set = (sbf_pin_set *)(uintptr_t)level->pins.at;
  set->maximum = 0.5f, set->stiffness = 400;
  s.world_definition.has_gravity = true;
  s.world_definition.gravity = (sbf_vec3){0, -gravity, 0};
  scene_start(&s);
  scene_ticks(&s, 400);
  sbr_pin_reaction r;
  ck_assert_uint_eq(sbr_character_get_pin_reactions(s.world, s.character, 0, &r, 1), 1);
  ck_assert_float_eq_tol(r.force.y, kg * gravity, 1e-3f * kg * gravity);
  ck_assert_float_eq_tol(scene_point(&s, 0, 0).y, 1 - kg * gravity / 200, 1e-4f);
  scene_free(&s);
}
END_TEST

START_TEST(a_grabbed_body_hangs_at_its_grab_point)
{
  scene s = cube(schemes[_i], false, gravity, 1);
  uint32_t vertex = far_corner(&s);
  sbf_vec3 at = vertex_at(&s, vertex);
  sbr_double3 o = sbr_character_get_origin(s.world, s.character);
  sbr_vertex_grab hold = {0};
  sbf_diagnostic error;
  ck_assert_int_eq(sbr_character_grab_vertex(s.world, s.character, 0, vertex, &hold, &error), SBF_FAILED);
  ck_assert_ptr_nonnull(strstr(error.message, "begin with sbr_default_vertex_grab"));
  hold = sbr_default_vertex_grab();
  hold.target = (sbr_double3){o.x + (double)at.x + 0.3, o.y + (double)at.y + 0.2, o.z + (double)at.z};
  hold.frequency_hz = 4;
  float weight = mass_of(&s) * gravity, k = mass_of(&s) * powf(2 * 3.14159265f * hold.frequency_hz, 2);
  ck_assert_int_eq(sbr_character_grab_vertex(s.world, s.character, 0, vertex, &hold, NULL), SBF_OK);
  for (int i = 0; i < 40; i++) { /* nothing else stops the pendulum */
    scene_ticks(&s, 30);
    ck_assert_int_eq(sbr_character_set_soft_velocity(
                         s.world, s.character, 0, (sbf_vec3){0, 0, 0}, (sbf_vec3){0, 0, 0}, NULL),
        SBF_OK);
  }
  at = vertex_at(&s, vertex);
  o = sbr_character_get_origin(s.world, s.character);
  ck_assert_double_eq_tol(o.y + (double)at.y, hold.target.y - (double)(weight / k), 0.01);
  ck_assert_double_eq_tol(o.x + (double)at.x, hold.target.x, 0.02);
  sbf_vec3 force = sbr_character_get_grab_force(s.world, s.character, 0, vertex);
  ck_assert_float_eq_tol(force.y, weight, 0.1f * weight);
  /* Released, it falls. */
  ck_assert(sbr_character_release_vertex(s.world, s.character, 0, vertex));
  ck_assert(!sbr_character_release_vertex(s.world, s.character, 0, vertex));
  float before = sbr_character_get_soft_motion(s.world, s.character, 0).velocity.y;
  scene_ticks(&s, 6);
  float fell = sbr_character_get_soft_motion(s.world, s.character, 0).velocity.y - before;
  ck_assert_float_eq_tol(fell, -0.1f * gravity, 1e-3f);
  ck_assert_float_eq(sbr_character_get_grab_force(s.world, s.character, 0, vertex).y, 0);
  scene_free(&s);
}
END_TEST

START_TEST(a_grab_never_exceeds_its_max_force)
{
  scene s = cube(SBF_SCHEME_SYMPLECTIC, false, gravity, 1);
  uint32_t vertex = far_corner(&s);
  sbr_double3 o = sbr_character_get_origin(s.world, s.character);
  sbr_vertex_grab hold = sbr_default_vertex_grab();
  float weight = mass_of(&s) * gravity;
  hold.target = (sbr_double3){o.x, o.y + 50, o.z};
  hold.max_force = 0.5f * weight;
  ck_assert_int_eq(sbr_character_grab_vertex(s.world, s.character, 0, vertex, &hold, NULL), SBF_OK);
  float before = sbr_character_get_soft_motion(s.world, s.character, 0).velocity.y;
  scene_ticks(&s, 12);
  sbf_vec3 force = sbr_character_get_grab_force(s.world, s.character, 0, vertex);
  ck_assert_float_le(
      sqrtf(force.x * force.x + force.y * force.y + force.z * force.z), hold.max_force * 1.0001f);
  float fell = sbr_character_get_soft_motion(s.world, s.character, 0).velocity.y - before;
  ck_assert_float_eq_tol(fell, -0.5f * gravity * 0.2f, 0.01f);
  ck_assert(sbr_character_get_body_health(s.world, s.character, 0).finite);
  scene_free(&s);
}
END_TEST

START_TEST(host_calls_wake_sleeping_bodies)
{
  scene s = scene_begin();
  const sbf_vec3 at[2] = {{0, 1, 0}, {0, 0.5f, 0}};
  const float kg[2] = {0, 1}, k = 500;
  const uint32_t point = 0;
  scene_body(&s, 0)->attributes.mass_damping = 20;
  sbf_level *level = scene_points(&s, 0, at, kg, 2);
  scene_springs(&s, level, &(sbf_uint2){{0, 1}}, &k, 1);
  scene_pin(&s, level, -1, &point, 1);
  s.world_definition.sleep_after_s = 0.2;
  scene_start(&s);
  scene_ticks(&s, 300);
  ck_assert_uint_eq(sbr_world_count_awake_bodies(s.world), 0);
  ck_assert_int_eq(sbr_character_set_soft_velocity(
                       s.world, s.character, 0, (sbf_vec3){0, 1, 0}, (sbf_vec3){0, 0, 0}, NULL),
      SBF_OK);
  scene_ticks(&s, 1);
  ck_assert_uint_eq(sbr_world_count_awake_bodies(s.world), 1);
  scene_ticks(&s, 300);
  ck_assert_uint_eq(sbr_world_count_awake_bodies(s.world), 0);
  /* A force keeps it awake for as long as it acts, and it sleeps after that. */
  ck_assert_int_eq(sbr_character_apply_soft_force(
                       s.world, s.character, 0, SBR_WHOLE_BODY, (sbf_vec3){0, -0.01f, 0}, 2, NULL),
      SBF_OK);
  scene_ticks(&s, 110);
  ck_assert_uint_eq(sbr_world_count_awake_bodies(s.world), 1);
  scene_ticks(&s, 300);
  ck_assert_uint_eq(sbr_world_count_awake_bodies(s.world), 0);
  scene_free(&s);
}
END_TEST

static void refused(sbf_status status, const sbf_diagnostic *error, const char *says) {
  ck_assert_int_eq(status, SBF_FAILED);
  ck_assert_int_eq(error->code, SBF_CODE_BAD_CALL);
  ck_assert_msg(strstr(error->message, says), "%s", error->message);
}

START_TEST(bad_calls_are_refused_and_change_nothing)
{
  scene s = cube(SBF_SCHEME_SYMPLECTIC, false, gravity, 1);
  const sbf_vec3 one = {1, 0, 0}, none = {NAN, 0, 0}, endless = {0, INFINITY, 0};
  sbf_diagnostic e;
  sbr_vertex_grab hold = sbr_default_vertex_grab();
  uint64_t hash = sbr_world_get_state_hash(s.world);
  sbr_world *w = s.world;
  sbr_character_id c = s.character, nobody = {12345};
  refused(sbr_character_apply_soft_impulse(w, nobody, 0, 0, one, &e), &e, "no such character");
  refused(sbr_character_apply_soft_impulse(w, c, 1, 0, one, &e), &e, "the asset has 1");
  refused(sbr_character_apply_soft_impulse(w, c, 0, 9999, one, &e), &e, "vertex 9999");
  refused(sbr_character_apply_soft_impulse(w, c, 0, 0, none, &e), &e, "not a finite number");
  refused(sbr_character_set_soft_velocity(w, c, 0, one, endless, &e), &e, "not a finite number");
  refused(sbr_character_apply_soft_force(w, c, 0, 0, one, -1, &e), &e, "more than 0");
  refused(sbr_character_grab_vertex(w, c, 0, SBR_WHOLE_BODY, &hold, &e), &e, "vertex");
  refused(sbr_character_grab_vertex(w, c, 0, 0, NULL, &e), &e, "NULL");
  hold.target.x = (double)NAN;
  refused(sbr_character_grab_vertex(w, c, 0, 0, &hold, &e), &e, "not a finite number");
  hold.target.x = 0, hold.damping_ratio = 11;
  refused(sbr_character_grab_vertex(w, c, 0, 0, &hold, &e), &e, "damping_ratio");
  ck_assert_uint_eq(sbr_world_get_state_hash(s.world), hash);
  for (uint32_t i = 0; i < SBR_LOAD_CAPACITY; i++)
    ck_assert_int_eq(sbr_character_apply_soft_force(w, c, 0, 0, one, 5, &e), SBF_OK);
  refused(sbr_character_apply_soft_force(w, c, 0, 0, one, 5, &e), &e, "already");
  sbr_character_reset(w, c); /* ends them */
  ck_assert_int_eq(sbr_character_apply_soft_force(w, c, 0, 0, one, 5, &e), SBF_OK);
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *s = suite_create("soft_host");
  TCase *c = tcase_create("soft_host");
  tcase_add_loop_test(c, an_impulse_adds_equal_momentum, 0, 2);
  tcase_add_test(c, an_impulse_on_the_whole_body_deforms_nothing);
  tcase_add_test(c, a_velocity_that_is_set_is_read_back);
  tcase_add_loop_test(c, a_force_acts_for_its_duration, 0, SCHEMES);
  tcase_add_loop_test(c, pins_report_the_load_on_them, 0, SCHEMES + 1);
  tcase_add_loop_test(c, both_ends_carry_half_a_bar, 0, SCHEMES);
  tcase_add_loop_test(c, momentum_changes_by_pin_forces_and_weight, 0, 2);
  tcase_add_test(c, goal_springs_are_pins_too);
  tcase_add_loop_test(c, a_grabbed_body_hangs_at_its_grab_point, 0, SCHEMES);
  tcase_add_test(c, a_grab_never_exceeds_its_max_force);
  tcase_add_test(c, host_calls_wake_sleeping_bodies);
  tcase_add_test(c, bad_calls_are_refused_and_change_nothing);
  suite_add_tcase(s, c);
  return harness_run(s);
}
