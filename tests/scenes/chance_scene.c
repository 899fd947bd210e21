#include "chance_scene.h"

#include <string.h>

#include "harness.h"
#include "math/trig.h"
#include "random.h"
#include "sbrun/soft_body.h"
#include "scenes.h"

enum { MAX_POINTS = 60 };

typedef struct chance {
  uint32_t state;
} chance;

static uint32_t roll(chance *c, uint32_t below) {
  return (uint32_t)((uint64_t)(random_next(&c->state) >> 8) * below >> 24);
}
static float between(chance *c, float low, float high) {
  return low + (high - low) * (float)roll(c, 1u << 20) / (float)(1u << 20);
}
/* As likely in each decade. */
static float decades(chance *c, float low, float high) {
  return sbri_exp(2.302585f * between(c, low, high));
}
/* One draw after the other: C leaves the order of several in one expression open. */
static sbf_vec3 between3(chance *c, float low, float high) {
  float x = between(c, low, high), y = between(c, low, high), z = between(c, low, high);
  return (sbf_vec3){x, y, z};
}
static bool likely(chance *c, uint32_t one_in) {
  return roll(c, one_in) == 0;
}

static void add_springs(chance *c, scene *s, sbf_level *level, uint32_t points, float stiffness) {
  sbf_uint2 ends[4 * MAX_POINTS];
  float k[4 * MAX_POINTS];
  uint32_t count = 1 + roll(c, 4 * points < 4 * MAX_POINTS ? 4 * points : 4 * MAX_POINTS - 1);
  for (uint32_t i = 0; i < count; i++) {
    uint32_t a = roll(c, points), b = i < points - 1 ? i + 1 : roll(c, points);
    ends[i] = (sbf_uint2){{i < points - 1 ? i : a, b}};
    if (ends[i].at[0] == b) ends[i].at[0] = (b + 1) % points;
    k[i] = stiffness * decades(c, -1, 1);
  }
  scene_springs(s, level, ends, k, count);
}

static void add_pins(chance *c, scene *s, sbf_level *level, uint32_t points) {
  uint32_t pinned[MAX_POINTS], count = 1 + roll(c, points / 2 + 1);
  for (uint32_t i = 0; i < count; i++) pinned[i] = (i * 7 + 1) % points;
  for (uint32_t i = 0; i < count; i++)
    for (uint32_t j = 0; j < i; j++)
      if (pinned[i] == pinned[j]) count = i;
  scene_pin(s, level, likely(c, 2) ? 0 : -1, pinned, count);
  if (!likely(c, 3)) return;
  sbf_pin_set *set = (sbf_pin_set *)(uintptr_t)level->pins.at; /* goals */
  set->maximum = between(c, 0.05f, 1);
  set->stiffness = decades(c, 0, 5);
}

static void choose_attributes(chance *c, sbf_attributes *is) {
  is->damping_ratio = likely(c, 3) ? 0 : between(c, 0, 1);
  is->mass_damping = likely(c, 3) ? decades(c, -2, 2) : 0;
  is->stiffness_damping = likely(c, 3) ? decades(c, -5, -1) : 0;
  is->friction = between(c, 0, 1);
  is->restitution = between(c, 0, 1);
  is->gravity_scale = likely(c, 4) ? between(c, -2, 3) : 1;
  is->media_friction = likely(c, 4) ? decades(c, -2, 2) : 0;
  is->sag_free = likely(c, 4);
  if (likely(c, 3)) is->strain_max = decades(c, -2, 0.5f);
  if (likely(c, 3)) is->strain_min = -between(c, 0, 1);
  if (likely(c, 3)) is->yield_strain = decades(c, -2, 0.5f), is->yield_flow = decades(c, -1, 3);
  if (likely(c, 3)) is->tear_strain = decades(c, -2, 1);
  is->pressure_mode = (sbf_pressure_mode)roll(c, SBF_PRESSURE_MODE_COUNT);
  is->pressure = between(c, -1, 1);
  is->pressure *= decades(c, 1, 6);
  is->bending_stiffness = likely(c, 2) ? decades(c, -4, 2) : 0;
}

static void choose_environment(chance *c, scene *s) {
  sbf_environment *environment = &s->asset->environment;
  environment->wind = between3(c, -20, 20);
  if (likely(c, 3)) environment->media_density = decades(c, -1, 3);
  uint32_t count = likely(c, 2) ? roll(c, 4) : 0;
  sbf_force_field *fields = sbf_asset_allocate(s->asset, count ? count : 1, sizeof *fields);
  for (uint32_t i = 0; i < count; i++) {
    sbf_force_field_init(&fields[i]);
    fields[i].kind = (sbf_field_kind)roll(c, SBF_FIELD_KIND_COUNT);
    fields[i].strength = between(c, -1, 1);
    fields[i].strength *= decades(c, 0, 3);
    fields[i].direction = between3(c, -1, 1);
    fields[i].falloff = likely(c, 2) ? between(c, 0, 4) : 0;
    fields[i].radius = likely(c, 2) ? decades(c, -1, 2) : 0;
  }
  environment->fields = (sbf_force_field_list){fields, count};
  s->world_definition.ground = likely(c, 2)   ? sbr_ground_flat(0)
                               : likely(c, 2) ? sbr_ground_slope(between(c, 0, 40))
                                              : sbr_ground_noise(1, roll(c, 100));
  s->character_definition.position.x = between(c, -2000, 2000);
  s->character_definition.position.y = between(c, -0.5f, 2);
  s->character_definition.scale = likely(c, 3) ? decades(c, -1, 1) : 1;
}

static void add_solid(chance *c, scene *s) {
  uint32_t along = 1 + roll(c, 5), across = 1 + roll(c, 2);
  float poisson = between(c, 0, 0.48f), density = decades(c, 2, 4), young = density * decades(c, 0, 3);
  sbf_vec3 size = between3(c, 0.1f, 1);
  lattice_box box =
      lattice_box_make((sbf_vec3){0, 1, 0}, size, along, across, across, density, young, poisson);
  bool carries = likely(c, 2);
  if (carries) { /* a surface that lies anywhere within and outside of it */
    sbf_vec3 more = between3(c, 0.3f, 1.5f);
    scene_section(s, 0, (sbf_vec3){0.5f * size.x, 1 + 0.5f * size.y, 0.5f * size.z},
        (sbf_vec3){more.x * size.x, more.y * size.y, more.z * size.z}, 1 + roll(c, 3));
  }
  if (likely(c, 2)) lattice_box_hold(&box);
  sbf_level *level = scene_lattice(s, 0, &box);
  if (carries) scene_embed(s, level, &box);
  lattice_box_free(&box);
}

static scene make(chance *c) {
  static const sbf_scheme schemes[] = {SBF_SCHEME_AUTOMATIC, SBF_SCHEME_SYMPLECTIC, SBF_SCHEME_POSITION_BASED,
      SBF_SCHEME_HEUN, SBF_SCHEME_EXPLICIT_EULER, SBF_SCHEME_RELAXATION, SBF_SCHEME_BLOCK_DESCENT};
  scene s = scene_begin();
  scene_bone(&s, (sbf_vec3){0, 1, 0});
  sbf_soft_body *body = scene_body(&s, 0);
  bool solid = likely(c, 4);
  if (solid) {
    add_solid(c, &s);
  } else if (likely(c, 2)) {
    body->attributes.young_modulus = decades(c, 3, 7);
    sbf_vec3 size = between3(c, 0.05f, 1);
    scene_section(&s, 0, (sbf_vec3){0, 1, 0}, size, 1 + roll(c, 3));
  } else {
    uint32_t points = 2 + roll(c, MAX_POINTS - 2);
    sbf_vec3 at[MAX_POINTS];
    float masses[MAX_POINTS], size = decades(c, -2, 1), mass = decades(c, -4, 2), span = between(c, 0, 2);
    for (uint32_t i = 0; i < points; i++) {
      at[i] = between3(c, -size, size);
      at[i].y += 1;
      masses[i] = mass * decades(c, -span, span);
    }
    sbf_level *level = scene_points(&s, 0, at, masses, points);
    add_springs(c, &s, level, points, mass * decades(c, 1, 5));
    if (!likely(c, 3)) add_pins(c, &s, level, points);
  }
  choose_attributes(c, &body->attributes);
  choose_environment(c, &s);
  s.model_options.scheme = schemes[roll(c, 7)];
  if (solid && s.model_options.scheme == SBF_SCHEME_RELAXATION)
    s.model_options.scheme = SBF_SCHEME_AUTOMATIC; /* that one steps springs alone */
  s.model_options.substeps = likely(c, 2) ? 0 : 1 + roll(c, 40);
  s.model_options.free = likely(c, 5);
  return s;
}

/* Pushed and held hard, and at vertices that may not be there. */
static void handle(chance *c, scene *s) {
  sbf_vec3 much = between3(c, -1, 1), turn = between3(c, -30, 30);
  float times = decades(c, -3, 4), seconds = decades(c, -3, 0);
  much = (sbf_vec3){times * much.x, times * much.y, times * much.z};
  uint32_t vertex = likely(c, 3) ? SBR_WHOLE_BODY : roll(c, 30);
  sbr_vertex_grab hold = sbr_default_vertex_grab();
  hold.frequency_hz = between(c, 0, 100), hold.damping_ratio = between(c, 0, 10);
  sbr_double3 o = sbr_character_get_origin(s->world, s->character);
  hold.target = (sbr_double3){o.x + (double)turn.x, o.y + (double)turn.y, o.z + (double)turn.z};
  hold.max_force = likely(c, 2) ? times : 0;
  switch (roll(c, 5)) {
  case 0:
    (void)sbr_character_set_soft_velocity(s->world, s->character, 0, turn, turn, NULL);
    break;
  case 1:
    (void)sbr_character_apply_soft_impulse(s->world, s->character, 0, vertex, much, NULL);
    break;
  case 2:
    (void)sbr_character_apply_soft_force(s->world, s->character, 0, vertex, much, seconds, NULL);
    break;
  case 3:
    (void)sbr_character_grab_vertex(s->world, s->character, 0, vertex, &hold, NULL);
    break;
  default:
    for (uint32_t i = 0; i < 30; i++) (void)sbr_character_release_vertex(s->world, s->character, 0, i);
    break;
  }
}

/* What a host reads of elements and pins is a number too. */
static void check_readings(const scene *s, uint32_t seed, int frame) {
  sbr_tetrahedron_state tetrahedra[256];
  sbr_pin_reaction pins[4];
  sbr_spring_state springs[256];
  uint32_t count = sbr_character_get_tetrahedra(s->world, s->character, 0, tetrahedra, 256);
  float sum = 0;
  for (uint32_t i = 0; i < count && i < 256; i++)
    sum += 0 * (tetrahedra[i].stress[0] + tetrahedra[i].energy_density);
  count = sbr_character_get_springs(s->world, s->character, 0, springs, 256);
  for (uint32_t i = 0; i < count && i < 256; i++) sum += 0 * (springs[i].tension + springs[i].energy);
  count = sbr_character_get_pin_reactions(s->world, s->character, 0, pins, 4);
  for (uint32_t i = 0; i < count && i < 4; i++) sum += 0 * (pins[i].force.x + pins[i].torque.y);
  ck_assert_msg(sum == 0, "seed %u, frame %d: a reading is no number", seed, frame);
}

static void disturb(chance *c, scene *s) {
  sbr_double3 position;
  position.x = between(c, -2000, 2000), position.y = between(c, -1, 3), position.z = between(c, -50, 50);
  sbf_vec3 wanted;
  switch (roll(c, 14)) {
  case 0:
    sbr_character_teleport(s->world, s->character, position, between(c, -3, 3));
    break;
  case 1:
    wanted = between3(c, -30, 30);
    sbr_character_set_drive(s->world, s->character, wanted.x, wanted.y, wanted.z);
    break;
  case 2:
    sbr_character_set_drive(s->world, s->character, 0, 0, 0);
    break;
  case 3:
    if (likely(c, 4)) sbr_character_reset(s->world, s->character);
    break;
  case 4:
  case 5:
    handle(c, s);
    break;
  default:
    break;
  }
}

uint64_t chance_scene_run(uint32_t seed) {
  chance c = {seed * 2654435761u + 12345u};
  for (int i = 0; i < 4; i++) roll(&c, 2);
  scene s = make(&c);
  sbf_diagnostic error = {0};
  if (sbr_model_create(s.asset, &s.model_options, &s.model, &error) != SBF_OK) {
    bool is_reported = strstr(error.message, "substeps") || strstr(error.message, "yield or tear");
    ck_assert_msg(is_reported, "seed %u: %s", seed, error.message);
    sbf_asset_free(s.asset);
    return 0;
  }
  ck_assert_int_eq(sbr_world_create(&s.world_definition, &s.world, &error), SBF_OK);
  ck_assert_int_eq(
      sbr_character_create(s.world, s.model, &s.character_definition, &s.character, &error), SBF_OK);
  sbf_vec3 points[1024];
  for (int f = 0; f < CHANCE_FRAMES; f++) {
    disturb(&c, &s);
    sbr_world_step(s.world, likely(&c, 10) ? between(&c, 0, 0.25f) : between(&c, 0.001f, 0.03f));
    uint32_t count = scene_read(&s, 0, points, 1024);
    for (uint32_t i = 0; i < count && i < 1024; i++) {
      float sum = points[i].x + points[i].y + points[i].z;
      ck_assert_msg(sum - sum == 0, "seed %u, frame %d: point %u is no number", seed, f, i);
    }
    ck_assert_msg(
        sbr_character_get_body_health(s.world, s.character, 0).finite, "seed %u, frame %d", seed, f);
    if (f % 8 == 0) check_readings(&s, seed, f);
  }
  uint64_t hash = sbr_world_get_state_hash(s.world);
  scene_free(&s);
  return hash;
}
