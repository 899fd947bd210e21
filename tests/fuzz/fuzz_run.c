/* Either form, loaded and simulated as two characters in contact. Every number read after a frame is finite,
 * for any file and any drive of the characters. The bytes select the settings. */
#include "base/hash64.h"
#include "fuzz.h"
#include "fuzz_asset.h"
#include "random.h"
#include "sbrun/collision.h"
#include "sbrun/debug.h"
#include "sbrun/detail.h"
#include "sbrun/rigid.h"
#include "sbrun/soft_body.h"

/* Frames of one input; visits of elements and points that they may take, so that inputs stay short; visits
 * that a tick of a rigid body costs as much as, with its joints and contacts. */
enum { MAX_FRAMES = 60, CHARACTERS = 2, READ_CAPACITY = 4096 };
static const double MAX_VISITS = 1e6, RIGID_VISITS = 4e5;

typedef struct simulation {
  const sbf_asset *asset;
  sbr_model *model;
  sbr_world *world;
  sbr_character_id characters[CHARACTERS];
  uint32_t random;
} simulation;

static uint64_t frame_count;

static void print_frame_count(void) {
  fprintf(stderr, "stat::simulated_frames: %llu\n", (unsigned long long)frame_count);
}

static uint32_t random_of(const uint8_t *data, size_t size) {
  sbfi_hash64 hash;
  sbfi_hash64_init(&hash);
  sbfi_hash64_add_bytes(&hash, data, size);
  return (uint32_t)sbfi_hash64_value(&hash);
}

static uint32_t pick(simulation *s, uint32_t below) {
  return (uint32_t)((uint64_t)(random_next(&s->random) >> 8) * below >> 24);
}

/* Uniform in each decade, of either sign. */
static float pick_decades(simulation *s, int low, int high) {
  float value = random_between(&s->random, 1, 10);
  int decade = low + (int)pick(s, (uint32_t)(high - low));
  for (; decade > 0; decade--) value *= 10;
  for (; decade < 0; decade++) value /= 10;
  return pick(s, 2) ? value : -value;
}

static sbf_vec3 pick_vec3(simulation *s, int low, int high) {
  float x = pick_decades(s, low, high), y = pick_decades(s, low, high), z = pick_decades(s, low, high);
  return (sbf_vec3){x, y, z};
}

static bool make_model(simulation *s) {
  sbf_diagnostic error = {0};
  sbr_model_options options = {.level = pick(s, 3),
      .scheme = pick(s, 2) ? SBF_SCHEME_AUTOMATIC : (sbf_scheme)pick(s, SBF_SCHEME_COUNT),
      .substeps = pick(s, 2) ? 0 : 1 + pick(s, 20),
      .free = !pick(s, 4),
      .tear_points = pick(s, 20),
      .detail_levels = !pick(s, 4)};
  sbf_status status = sbr_model_create(s->asset, &options, &s->model, &error);
  if (status == SBF_OK) return true;
  FUZZ_MUST(!s->model);
  FUZZ_MUST(error.code != 0 && error.message[0]);
  return false;
}

static void make_world(simulation *s) {
  sbr_world_definition world = sbr_default_world_definition();
  sbr_ground grounds[] = {
      sbr_ground_flat(0), sbr_ground_slope(20), sbr_ground_stairs(0.1, 0.2), sbr_ground_noise(0.5, 7)};
  world.ground = grounds[pick(s, 4)];
  world.has_gravity = !pick(s, 3);
  world.gravity = pick_vec3(s, -1, 3);
  FUZZ_MUST(sbr_world_create(&world, &s->world, NULL) == SBF_OK);
  FUZZ_MUST(sbr_world_enable_body_contacts(s->world, 256, NULL) == SBF_OK);
  sbr_character_definition character = sbr_default_character_definition();
  character.hold_pose = !pick(s, 4);
  for (int i = 0; i < CHARACTERS; i++) {
    if (!pick(s, 3)) character.scale = pick_decades(s, -2, 2);
    if (character.scale < 0) character.scale = -character.scale;
    character.position = (sbr_double3){i * 0.1, pick(s, 3) * 0.5, 0};
    FUZZ_MUST(sbr_character_create(s->world, s->model, &character, &s->characters[i], NULL) == SBF_OK);
  }
}

/* Frames within MAX_VISITS. */
static uint32_t count_affordable_frames(const simulation *s) {
  sbr_counters c = sbr_world_get_counters(s->world);
  double step = 1.0 + c.point_count + c.spring_count + 4.0 * c.tetrahedron_count;
  double frames =
      MAX_VISITS / (step * (1 + sbr_model_get_substeps(s->model)) + RIGID_VISITS * c.rigid_body_count);
  return frames < MAX_FRAMES ? (uint32_t)frames : MAX_FRAMES;
}

/* Calls of a host on a soft body; calls for missing bodies are refused. */
static void push_body(simulation *s, sbr_character_id c, uint32_t body) {
  uint32_t vertex = pick(s, 3) ? pick(s, 20) : SBR_WHOLE_BODY;
  sbf_vec3 much = pick_vec3(s, -3, 4), little = pick_vec3(s, -1, 2);
  sbr_vertex_grab hold = sbr_default_vertex_grab();
  hold.target = (sbr_double3){(double)little.x, (double)little.y, (double)little.z};
  switch (pick(s, 4)) {
  case 0:
    (void)sbr_character_apply_soft_impulse(s->world, c, body, vertex, much, NULL);
    break;
  case 1:
    (void)sbr_character_apply_soft_force(s->world, c, body, vertex, much, 0.1f, NULL);
    break;
  case 2:
    (void)sbr_character_set_soft_velocity(s->world, c, body, little, much, NULL);
    break;
  default:
    (void)sbr_character_grab_vertex(s->world, c, body, vertex, &hold, NULL);
    break;
  }
}

static void disturb(simulation *s) {
  sbr_character_id c = s->characters[pick(s, CHARACTERS)];
  sbf_vec3 v = pick_vec3(s, -2, 3);
  sbr_fall_definition fall = sbr_default_fall_definition();
  switch (pick(s, 12)) {
  case 0:
    sbr_character_set_drive(s->world, c, v.x, v.y, v.z);
    break;
  case 1:
    sbr_character_teleport(s->world, c, (sbr_double3){(double)v.x, (double)v.y, (double)v.z}, v.x);
    break;
  case 2:
    sbr_character_displace(s->world, c, v, v.y);
    break;
  case 3:
    sbr_character_knock_over(s->world, c, &fall);
    break;
  case 4:
    sbr_character_set_rigid_mode(s->world, c, -1, (sbr_rigid_mode)pick(s, 3));
    break;
  case 5:
    sbr_character_set_detail_level(s->world, c, pick(s, 4));
    break;
  case 6:
    sbr_character_set_vertical_speed(s->world, c, v.y);
    break;
  case 7:
    if (!pick(s, 4)) sbr_character_reset(s->world, c);
    break;
  case 8:
  case 9:
    push_body(s, c, pick(s, s->asset->soft_bodies.count + 1));
    break;
  default:
    break;
  }
}

static void check_positions(const sbf_vec3 *positions, uint32_t count) {
  float sum = 0;
  for (uint32_t i = 0; i < count && i < READ_CAPACITY; i++)
    sum += 0 * (positions[i].x + positions[i].y + positions[i].z);
  FUZZ_MUST(sum == 0);
}

static void check_frame(const simulation *s, sbr_character_id c) {
  static sbf_vec3 positions[READ_CAPACITY], normals[READ_CAPACITY];
  static sbr_transform bones[READ_CAPACITY];
  for (uint32_t i = 0; i < s->asset->soft_bodies.count; i++) {
    sbr_body_health h = sbr_character_get_body_health(s->world, c, i);
    FUZZ_MUST(h.finite);
    FUZZ_MUST(0 * (h.volume_ratio + h.max_strain + h.min_element_ratio) == 0);
    FUZZ_MUST(0 * (h.kinetic_j + h.elastic_j + h.potential_j) == 0);
    check_positions(positions, sbr_character_get_points(s->world, c, i, positions, READ_CAPACITY));
    check_positions(positions, sbr_character_get_surface(s->world, c, i, positions, READ_CAPACITY));
  }
  for (uint32_t i = 0; i < s->asset->render_meshes.count; i++) {
    uint32_t count = sbr_character_get_skin(s->world, c, i, positions, normals, NULL, READ_CAPACITY);
    check_positions(positions, count);
    check_positions(normals, count);
  }
  uint32_t count = s->asset->bones.count;
  sbr_character_get_bones(s->world, c, bones, READ_CAPACITY);
  for (uint32_t i = 0; i < count && i < READ_CAPACITY; i++) check_positions(&bones[i].position, 1);
}

static void step_frame(simulation *s) {
  static const double seconds[] = {1.0 / 60, 1.0 / 30, 1.0 / 240, 0, 0.05};
  sbf_diagnostic error = {0};
  disturb(s);
  sbr_world_step(s->world, seconds[pick(s, 4) ? 0 : pick(s, 5)]);
  if (sbr_world_validate(s->world, &error) != SBF_OK) fprintf(stderr, "%s\n", error.message);
  FUZZ_MUST(!error.message[0]);
  for (int i = 0; i < CHARACTERS; i++) check_frame(s, s->characters[i]);
  frame_count++;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static bool is_counting = false;
  if (!is_counting) is_counting = atexit(print_frame_count) == 0;
  sbf_asset *asset = fuzz_load_either(data, size);
  if (!asset) return 0;
  simulation s = {.asset = asset, .random = random_of(data, size)};
  if (make_model(&s)) {
    make_world(&s);
    for (uint32_t frames = count_affordable_frames(&s); frames; frames--) step_frame(&s);
    sbr_world_destroy(s.world);
    sbr_model_destroy(s.model);
  }
  sbf_asset_free(asset);
  return 0;
}
