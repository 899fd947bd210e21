/* Surfaces that a level carries: which places of them meet the ground, and how pushes there reach its points.
 */
#include <math.h>
#include <stdlib.h>

#include "harness.h"
#include "scenes.h"
#include "soft/solvers/motion.h"
#include "state/world.h"

/* The box of 2 x 2 x 2 cells that carries the surface: smaller than it by a fifth. */
static const sbf_vec3 inner_low = {-0.16f, 0.04f, -0.16f}, inner_size = {0.32f, 0.32f, 0.32f};

/* A box of 0.4 m on the ground, `cells` quads along each edge, carried by the smaller lattice within it. */
static scene embedded_box(uint32_t cells, sbf_pressure_mode pressure) {
  scene s = scene_begin();
  scene_bone(&s, (sbf_vec3){0, 0, 0});
  sbf_soft_body *body = scene_body(&s, 0);
  sbf_attributes_init(&body->attributes);
  body->attributes.pressure_mode = pressure;
  scene_section(&s, 0, (sbf_vec3){0, 0.2f, 0}, (sbf_vec3){0.4f, 0.4f, 0.4f}, cells);
  lattice_box box = lattice_box_make(inner_low, inner_size, 2, 2, 2, 2000, 8e4f, 0.4f);
  scene_embed(&s, scene_lattice(&s, 0, &box), &box);
  lattice_box_free(&box);
  s.world_definition.ground = sbr_ground_flat(0);
  s.character_definition.position = (sbr_double3){0, 0, 0};
  return s;
}

static const sbri_body *body_of(const scene *s) {
  return &s->model->bodies[0];
}

START_TEST(all_points_of_polygons_are_sampled)
{
  scene s = embedded_box(4, SBF_PRESSURE_MODE_NONE);
  sbf_soft_body *body = scene_body(&s, 0);
  uint32_t count = body->surface.positions.count;
  body->surface.polygon_sizes.count--; /* a face less: all its corners have others */
  body->surface.polygon_points.count -= 4;
  scene_start(&s);
  ck_assert_uint_eq(body_of(&s)->contact.sample_count, count);
  ck_assert_float_gt(body_of(&s)->contact.max_extrapolation, 0.2f);
  const sbri_island *island = &s.model->islands[0];
  for (uint32_t i = 0; i < count; i++) {
    const sbri_sample *sample = &body_of(&s)->contact.samples[i];
    float sum = 0, inverse = 0;
    sbf_vec3 position = {0, 0, 0}, rest = body->surface.positions.at[sample->vertex];
    for (int k = 0; k < 4; k++) {
      const sbri_point *p = &island->rest[sample->slots[k]];
      float w = sample->weights[k];
      sum += w, inverse += w * w * island->inverse_masses[sample->slots[k]];
      position = sbri_add_scaled(position, sbri_vec3(p->x, p->y, p->z), w);
    }
    ck_assert_float_eq_tol(sum, 1, 1e-5f);
    ck_assert_float_eq_tol(inverse * sample->mass_kg, 1, 1e-4f);
    ck_assert_float_lt(sbri_length(sbri_sub(position, rest)), 1e-5f);
  }
  scene_free(&s);
}
END_TEST

/* With one quad a side, no point of the surface lies between the corners: points of the level must. */
START_TEST(faces_larger_than_the_elements_are_supported_by_points_of_the_level)
{
  scene s = embedded_box(1, SBF_PRESSURE_MODE_NONE);
  scene_start(&s);
  ck_assert_uint_eq(
      body_of(&s)->contact.sample_count, 8 + 3 * 3 * 3 - 1); /* all but the middle: 40 mm within */
  scene_free(&s);
  s = scene_begin();
  scene_bone(&s, (sbf_vec3){0, 0, 0});
  scene_section(&s, 0, (sbf_vec3){0, 0.2f, 0}, (sbf_vec3){0.4f, 0.4f, 0.4f}, 1);
  lattice_box box = lattice_box_make(
      (sbf_vec3){-0.199f, 0.001f, -0.199f}, (sbf_vec3){0.398f, 0.398f, 0.398f}, 4, 4, 4, 2000, 8e4f, 0.4f);
  scene_embed(&s, scene_lattice(&s, 0, &box), &box);
  lattice_box_free(&box);
  scene_start(&s);
  ck_assert_uint_eq(body_of(&s)->contact.sample_count, 8 + 5 * 5 * 5 - 3 * 3 * 3);
  scene_free(&s);
}
END_TEST

START_TEST(points_of_a_spring_level_need_no_samples)
{
  scene s = scene_begin();
  scene_bone(&s, (sbf_vec3){0, 0, 0});
  scene_section(&s, 0, (sbf_vec3){0, 0.2f, 0}, (sbf_vec3){0.4f, 0.4f, 0.4f}, 2);
  scene_start(&s);
  ck_assert_ptr_null(body_of(&s)->contact.samples);
  scene_free(&s);
}
END_TEST

/* ---- Pushes ---- */

typedef struct momenta {
  double linear[3], angular[3]; /* about a place */
} momenta;

static momenta momenta_of(const sbri_island_tick *t, sbf_vec3 about) {
  momenta m = {{0}, {0}};
  for (uint32_t slot = 0; slot < t->island->free_count; slot++) {
    sbf_vec3 v = sbri_slot_velocity(t, t->velocities, slot);
    double k = t->island->masses[slot], p[3] = {k * (double)v.x, k * (double)v.y, k * (double)v.z};
    double x = (double)t->positions[slot].x - (double)about.x,
           y = (double)t->positions[slot].y - (double)about.y,
           z = (double)t->positions[slot].z - (double)about.z;
    for (int i = 0; i < 3; i++) m.linear[i] += p[i];
    m.angular[0] += y * p[2] - z * p[1], m.angular[1] += z * p[0] - x * p[2];
    m.angular[2] += x * p[1] - y * p[0];
  }
  return m;
}

static sbf_vec3 velocity_of(const sbri_island_tick *t, const sbri_sample *s) {
  sbf_vec3 v = {0, 0, 0};
  for (int k = 0; k < 4; k++)
    v = sbri_add_scaled(v, sbri_slot_velocity(t, t->velocities, s->slots[k]), s->weights[k]);
  return v;
}

/* Eight at a time, or in sequence. */
static void solve(const sbri_island_tick *tick, const sbri_body *body, const sbri_contact_rule *rule) {
  if (sbri_contact_block_count(tick, body))
    sbri_contact_solve(tick, body, tick->velocities, rule);
  else
    sbri_soft_contacts_solve(tick, body, tick->velocities, rule);
}

START_TEST(a_contact_impulse_acts_at_its_sample)
{
  scene s = embedded_box(2, SBF_PRESSURE_MODE_NONE);
  scene_body(&s, 0)->attributes.friction = 0.2f;
  scene_start(&s);
  sbri_character *c = sbri_character_of(s.world, s.character);
  uint32_t counts[1] = {1};
  sbri_soft_contact contact = {
      .sample = body_of(&s)->contact.samples[3], .normal = {0.6f, 0.8f, 0}, .friction_scale = 1};
  sbri_island_tick tick = {.model = s.model,
      .island = &s.model->islands[0],
      .tick_s = 1.0f / 60,
      .positions = sbri_positions(c),
      .velocities = sbri_velocities(c),
      .targets = sbri_positions(c),
      .contacts = {.at = &contact,
          .weights = sbri_contact_weights(c),
          .counts = counts,
          .blocks = sbri_contact_blocks(c),
          .block_counts = sbri_contact_block_counts(c),
          .slots = sbri_contact_slots(c)},
      .scratch = {.begins = sbri_positions(c), .velocity_points = sbri_velocity_points(c)}};
  for (uint32_t slot = 0; slot < tick.island->free_count; slot++) {
    float *v = sbri_triple(tick.velocities, slot);
    v[0] = -2 + 0.1f * (float)(slot % 5), v[SBRI_BLOCK] = -3 + 0.2f * (float)(slot % 3);
    v[2 * SBRI_BLOCK] = 1 - 0.1f * (float)(slot % 7);
  }
  const sbri_sample *sample = &contact.sample;
  sbf_vec3 position = sbri_sample_position(&tick, sample);
  contact.offset = sbri_dot(contact.normal, position);
  sbf_vec3 before_v = velocity_of(&tick, sample);
  momenta before = momenta_of(&tick, position);
  const float friction = body_of(&s)->contact.friction;
  sbri_contact_block_counts(c)[0] = 0;
  if (_i == 0) sbri_contact_blocks_fill(&tick, body_of(&s));
  ck_assert_uint_eq(sbri_contact_block_count(&tick, body_of(&s)), _i == 0);
  sbri_contact_rule rule = {
      .friction = friction, .step_s = 1e-3f, .max_correction_m = 1, .bounce_from_m_s = 0.05f};
  solve(&tick, body_of(&s), &rule);
  sbf_vec3 after_v = velocity_of(&tick, sample);
  momenta after = momenta_of(&tick, position);
  /* A falling sample stops, and friction changes the sideways velocity by at most its fraction of that. */
  float gain = sbri_dot(contact.normal, sbri_sub(after_v, before_v));
  ck_assert_float_eq_tol(sbri_dot(contact.normal, after_v), 0, 1e-4f);
  ck_assert_float_eq_tol(gain, -sbri_dot(contact.normal, before_v), 1e-4f);
  sbf_vec3 change = sbri_sub(after_v, before_v);
  float sideways = sbri_length(sbri_add_scaled(change, contact.normal, -gain));
  ck_assert_float_eq_tol(sideways, friction * gain, 1e-3f);
  /* The momentum is that of an impulse at the sample: it has no moment about the sample. */
  const float *change_at = &change.x;
  for (int i = 0; i < 3; i++) {
    ck_assert_double_eq_tol(
        after.linear[i] - before.linear[i], (double)(sample->mass_kg * change_at[i]), 1e-2);
    ck_assert_double_eq_tol(after.angular[i], before.angular[i], 2e-3);
  }
  /* A second look finds nothing to do. */
  solve(&tick, body_of(&s), &rule);
  sbf_vec3 again = velocity_of(&tick, sample);
  ck_assert_float_lt(sbri_length(sbri_sub(again, after_v)), 1e-4f);
  scene_free(&s);
}
END_TEST

/* ---- Falls ---- */

static const sbf_scheme schemes[] = {SBF_SCHEME_AUTOMATIC, SBF_SCHEME_HEUN, SBF_SCHEME_EXPLICIT_EULER};
static const sbf_pressure_mode pressures[] = {SBF_PRESSURE_MODE_NONE, SBF_PRESSURE_MODE_VOLUME};

typedef struct fall {
  double lowest_m, speed_m_s, end_m;
} fall;

static fall fall_of(scene *s) {
  static sbf_vec3 before[2048], after[2048];
  fall f = {0, 0, 1};
  for (int tick = 0; tick < 360; tick++) {
    uint32_t count = sbr_character_get_surface(s->world, s->character, 0, before, 2048);
    scene_ticks(s, 1);
    sbr_character_get_surface(s->world, s->character, 0, after, 2048);
    double origin = sbr_character_get_origin(s->world, s->character).y;
    f.speed_m_s = 0, f.end_m = 1;
    for (uint32_t i = 0; i < count; i++) {
      double x = after[i].x - before[i].x, y = after[i].y - before[i].y, z = after[i].z - before[i].z;
      f.lowest_m = fmin(f.lowest_m, origin + (double)after[i].y);
      f.end_m = fmin(f.end_m, origin + (double)after[i].y);
      f.speed_m_s = fmax(f.speed_m_s, 60 * sqrt(x * x + y * y + z * z));
    }
  }
  return f;
}

START_TEST(a_surface_beyond_its_lattice_stays_above_the_ground)
{
  scene s = embedded_box(3, pressures[_i % 2]);
  s.character_definition.position.y = 1;
  s.model_options.scheme = schemes[_i / 2];
  if (s.model_options.scheme == SBF_SCHEME_EXPLICIT_EULER)
    scene_body(&s, 0)->attributes.stiffness_damping = 2e-3f; /* else it gains energy in the air */
  scene_start(&s);
  fall f = fall_of(&s);
  ck_assert(sbr_character_get_body_health(s.world, s.character, 0).finite);
  ck_assert_uint_eq(sbr_character_get_body_health(s.world, s.character, 0).recoveries, 0);
  ck_assert_double_gt(f.lowest_m, -2e-3);
  ck_assert_double_gt(f.end_m, -2e-4);
  ck_assert_double_lt(f.end_m, 1e-3);
  ck_assert_double_lt(f.speed_m_s, 0.02);
  scene_free(&s);
}
END_TEST

/* Springs between the corners of a box within carry the surface: position-based steps too. */
START_TEST(position_based_steps_apply_samples)
{
  scene s = embedded_box(2, SBF_PRESSURE_MODE_NONE);
  sbf_vec3 positions[8];
  float masses[8], stiffness[28];
  sbf_uint2 ends[28];
  uint32_t count = 0;
  for (uint32_t i = 0; i < 8; i++) {
    positions[i] = (sbf_vec3){i & 1 ? 0.16f : -0.16f, i & 2 ? 0.36f : 0.04f, i & 4 ? 0.16f : -0.16f};
    masses[i] = 4;
    for (uint32_t k = 0; k < i; k++) {
      ends[count] = (sbf_uint2){{k, i}};
      stiffness[count++] = 2e4f;
    }
  }
  sbf_level *level = scene_points(&s, 0, positions, masses, 8);
  scene_springs(&s, level, ends, stiffness, count);
  const sbf_vec3_list *vertices = &scene_body(&s, 0)->surface.positions;
  sbf_uint4 *points = sbf_asset_allocate(s.asset, vertices->count, sizeof *points);
  sbf_vec4 *weights = sbf_asset_allocate(s.asset, vertices->count, sizeof *weights);
  for (uint32_t v = 0; v < vertices->count; v++) {
    /* By a corner and its three neighbours, those nearest to the vertex. */
    sbf_vec3 p = vertices->at[v];
    uint32_t corner = (p.x > 0 ? 1u : 0) + (p.y > 0.2f ? 2u : 0) + (p.z > 0 ? 4u : 0);
    float x = fabsf(p.x - positions[corner].x) / 0.32f, y = fabsf(p.y - positions[corner].y) / 0.32f,
          z = fabsf(p.z - positions[corner].z) / 0.32f;
    if (fabsf(p.x) > 0.16f) x = -x;
    if (fabsf(p.y - 0.2f) > 0.16f) y = -y;
    if (fabsf(p.z) > 0.16f) z = -z;
    points[v] = (sbf_uint4){{corner, corner ^ 1, corner ^ 2, corner ^ 4}};
    weights[v] = (sbf_vec4){1 - x - y - z, x, y, z};
  }
  sbf_embedding *embedding = sbf_asset_allocate(s.asset, 1, sizeof *embedding);
  sbf_embedding_init(embedding);
  embedding->points = (sbf_uint4_list){points, vertices->count};
  embedding->weights = (sbf_vec4_list){weights, vertices->count};
  level->embeddings = (sbf_embedding_list){embedding, 1};
  s.character_definition.position.y = 0.5;
  s.model_options.scheme = SBF_SCHEME_POSITION_BASED;
  scene_start(&s);
  ck_assert_uint_eq(body_of(&s)->contact.sample_count, vertices->count);
  fall f = fall_of(&s);
  ck_assert_double_gt(f.lowest_m, -2e-3);
  ck_assert_double_lt(f.end_m, 1e-3);
  ck_assert_double_lt(f.speed_m_s, 0.02);
  scene_free(&s);
}

static uint32_t contact_count(const scene *s) {
  return sbri_contact_counts(sbri_character_of(s->world, s->character))[0];
}

/* Nine points of the lattice support 289 vertices of the lower face. */
START_TEST(resting_points_keep_few_contacts_and_impacts_keep_all)
{
  scene s = embedded_box(16, SBF_PRESSURE_MODE_NONE);
  s.world_definition.sleep_after_s = 0;
  scene_body(&s, 0)->attributes.damping_ratio = 0.5f;
  s.character_definition.position.y = 0.3;
  scene_start(&s);
  uint32_t most = 0;
  for (int i = 0; i < 60; i++) {
    sbr_world_tick(s.world);
    most = contact_count(&s) > most ? contact_count(&s) : most;
  }
  ck_assert_uint_ge(most, 289);
  fall f = fall_of(&s);
  ck_assert_uint_gt(contact_count(&s), 8);
  ck_assert_uint_le(contact_count(&s), 9 * SBRI_CONTACTS_PER_POINT);
  ck_assert_double_gt(f.end_m, -2e-4);
  ck_assert_double_lt(f.speed_m_s, 0.02);
  scene_free(&s);
}
END_TEST

END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("contact samples");
  TCase *c = tcase_create("contact samples");
  tcase_add_test(c, all_points_of_polygons_are_sampled);
  tcase_add_test(c, faces_larger_than_the_elements_are_supported_by_points_of_the_level);
  tcase_add_test(c, points_of_a_spring_level_need_no_samples);
  tcase_add_loop_test(c, a_contact_impulse_acts_at_its_sample, 0, 2);
  tcase_add_loop_test(c, a_surface_beyond_its_lattice_stays_above_the_ground, 0, 6);
  tcase_add_test(c, position_based_steps_apply_samples);
  tcase_add_test(c, resting_points_keep_few_contacts_and_impacts_keep_all);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
