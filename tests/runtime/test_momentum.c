/* Every kind of soft-body force between two simulated boxes, one of which receives an off-centre impulse: the
 * boxes lose the momentum, linear and angular, that the soft body's points gain. SHOW_MOMENTUM in the
 * environment prints the table of docs/rigid.md. */
#include "momentum.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "harness.h"
#include "math/vec3.h"
#include "rigid_scenes.h"

enum { LONG = 9, WIDE = 3, GRID = LONG * WIDE * WIDE, MAX_SPRINGS = 13 * GRID };
static const float STEP_M = 0.05f, POINT_KG = 0.02f, BOX_KG = 0.5f;

typedef enum elastic { TETRAHEDRA, SPRINGS, REGIONS } elastic;

static uint32_t grid_point(uint32_t x, uint32_t y, uint32_t z) {
  return x + LONG * (y + WIDE * z);
}

static sbf_vec3 grid_place(uint32_t i) {
  return (sbf_vec3){STEP_M * ((float)(i % LONG) - 4), STEP_M * ((float)(i / LONG % WIDE) - 1),
      STEP_M * ((float)(i / LONG / WIDE) - 1)};
}

/* Each point to each neighbour of the 26. */
static sbf_level *grid_springs(scene *s) {
  sbf_vec3 at[GRID];
  float kg[GRID], k[MAX_SPRINGS];
  sbf_uint2 ends[MAX_SPRINGS];
  uint32_t count = 0;
  for (uint32_t i = 0; i < GRID; i++) at[i] = grid_place(i), kg[i] = POINT_KG;
  for (uint32_t i = 0; i < GRID; i++)
    for (uint32_t j = i + 1; j < GRID; j++) {
      sbf_vec3 d = sbri_sub(at[j], at[i]);
      if (fabsf(d.x) > 1.1f * STEP_M || fabsf(d.y) > 1.1f * STEP_M || fabsf(d.z) > 1.1f * STEP_M) continue;
      ends[count] = (sbf_uint2){{i, j}}, k[count++] = 400;
    }
  sbf_level *level = scene_points(s, 0, at, kg, GRID);
  scene_springs(s, level, ends, k, count);
  return level;
}

static sbf_level *grid_tetrahedra(scene *s) {
  lattice_box box = lattice_box_make(grid_place(0),
      (sbf_vec3){(LONG - 1) * STEP_M, (WIDE - 1) * STEP_M, (WIDE - 1) * STEP_M}, LONG - 1, WIDE - 1, WIDE - 1,
      500, 3e4f, 0.4f);
  sbf_level *level = scene_lattice(s, 0, &box);
  lattice_box_free(&box);
  return level;
}

/* Triangles over the six sides, facing outwards, of all points from `from` on, or from the first box if
 * more. */
static void grid_surface(scene *s, const sbf_level *level, uint32_t from) {
  const uint32_t cells[3] = {LONG - 1 - from, WIDE - 1, WIDE - 1};
  uint32_t count = 0, *corners = sbf_asset_allocate(s->asset, 6 * 6 * 64, sizeof *corners),
           *sizes = sbf_asset_allocate(s->asset, 12 * 64, sizeof *sizes);
  ck_assert(corners && sizes);
  for (int axis = 0; axis < 3; axis++)
    for (int side = 0; side < 2; side++)
      for (uint32_t u = 0; u < cells[(axis + 1) % 3]; u++)
        for (uint32_t v = 0; v < cells[(axis + 2) % 3]; v++) {
          static const uint32_t order[6] = {0, 1, 2, 0, 2, 3};
          for (uint32_t k = 0; k < 6; k++) {
            uint32_t c = order[side ? k : 5 - k], at[3];
            at[axis] = side ? cells[axis] : 0;
            at[(axis + 1) % 3] = u + (c == 1 || c == 2), at[(axis + 2) % 3] = v + (c >= 2);
            corners[6 * count + k] = grid_point(from + at[0], at[1], at[2]);
          }
          sizes[2 * count] = sizes[2 * count + 1] = 3, count++;
        }
  sbf_polygon_mesh *surface = &scene_body(s, 0)->surface;
  surface->positions = level->positions;
  surface->polygon_sizes = (sbf_u32_list){sizes, 2 * count};
  surface->polygon_points = (sbf_u32_list){corners, 6 * count};
}

typedef struct kind {
  const char *name;
  elastic model;
  bool surface, alone; /* alone: pinned to one box, which carries it */
  bool hung;           /* the first box pins no point of the surface */
  sbf_pressure_mode pressure;
  float pa, limit, yield, tear, goal, damping, times;
  float keeps_m; /* the surface collides with itself, at that thickness or at 0.9 of its separation at rest */
  float box_kg;  /* 0: BOX_KG */
  sbf_scheme scheme;
  double linear, angular; /* maximum momentum lost or gained, as fractions; 0: LINEAR and ANGULAR */
} kind;

static const double LINEAR = 1e-6, ANGULAR = 2e-6;

static float kg_of(const kind *is) {
  return is->box_kg > 0 ? is->box_kg : BOX_KG;
}

static scene dumbbell(const kind *is, sbr_instructions instructions) {
  scene s = rigid_begin();
  scene_bodies(&s, 1);
  s.asset->environment.gravity = (sbf_vec3){0, 0, 0};
  const uint32_t counts[3] = {LONG, WIDE, WIDE};
  sbf_level *level = is->model == TETRAHEDRA ? grid_tetrahedra(&s)
                     : is->model == SPRINGS
                         ? grid_springs(&s)
                         : scene_regions(&s, 0, grid_place(0), STEP_M, counts, 1, 60, POINT_KG);
  if (is->surface) grid_surface(&s, level, is->hung);
  sbf_attributes *a = &scene_body(&s, 0)->attributes;
  a->pressure_mode = is->pressure, a->pressure = is->pa;
  a->damping_ratio = is->damping;
  if (is->keeps_m > 0) {
    sbf_collision *rule = &scene_body(&s, 0)->collision;
    rule->self = true, rule->outer_thickness = is->keeps_m;
    a->friction = 0; /* so far apart it would turn them */
  }
  if (is->limit > 0) a->strain_max = is->limit, a->strain_min = -is->limit;
  a->yield_strain = is->yield, a->yield_flow = is->yield > 0 ? 5 : 0, a->tear_strain = is->tear;
  for (uint32_t end = 0; end < (is->alone ? 1 : 2); end++) {
    uint32_t points[WIDE * WIDE];
    for (uint32_t i = 0; i < WIDE * WIDE; i++) points[i] = grid_point(end ? LONG - 1 : 0, i % WIDE, i / WIDE);
    uint32_t body =
        rigid_box(&s, (sbf_vec3){end ? 0.22f : -0.22f, 0, 0}, (sbf_vec3){0.08f, 0.12f, 0.12f}, kg_of(is));
    rigid_pin(&s, level, end, (int32_t)body, points, WIDE * WIDE);
    if (is->goal > 0) {
      sbf_pin_set *pins = (sbf_pin_set *)(uintptr_t)&level->pins.at[end];
      float *weight = sbf_asset_allocate(s.asset, 1, sizeof *weight);
      *weight = is->goal;
      pins->weights = (sbf_f32_list){weight, 1};
      pins->stiffness = 200, pins->damping = 1;
    }
  }
  s.model_options.scheme = is->scheme;
  s.model_options.instructions = instructions;
  scene_start(&s);
  return s;
}

static const kind kinds[] = {
    {.name = "tetrahedra", .model = TETRAHEDRA},
    {.name = "tetrahedra, damped", .model = TETRAHEDRA, .damping = 0.2f},
    {.name = "tetrahedra, limits", .model = TETRAHEDRA, .limit = 0.05f, .damping = 0.1f, .angular = 1e-5},
    {.name = "tetrahedra, yield", .model = TETRAHEDRA, .yield = 0.02f},
    {.name = "tetrahedra, tear", .model = TETRAHEDRA, .tear = 0.15f},
    {.name = "tetrahedra, crushed", .model = TETRAHEDRA, .times = 10, .angular = 5e-4},
    {.name = "springs", .model = SPRINGS},
    {.name = "springs, damped", .model = SPRINGS, .damping = 0.2f},
    {.name = "springs, limits", .model = SPRINGS, .limit = 0.03f, .damping = 0.1f, .angular = 1e-5},
    {.name = "springs, yield", .model = SPRINGS, .yield = 0.02f},
    {.name = "springs, tear", .model = SPRINGS, .tear = 0.1f},
    {.name = "springs, gas", .model = SPRINGS, .surface = true, .pressure = SBF_PRESSURE_MODE_GAS, .pa = 500},
    {.name = "springs, volume", .model = SPRINGS, .surface = true, .pressure = SBF_PRESSURE_MODE_VOLUME},
    {.name = "springs, hung volume",
        .model = SPRINGS,
        .surface = true,
        .hung = true,
        .pressure = SBF_PRESSURE_MODE_VOLUME},
    {.name = "springs, itself", .model = SPRINGS, .surface = true, .keeps_m = 0.2f, .angular = 3e-4},
    {.name = "springs, itself, light",
        .model = SPRINGS,
        .surface = true,
        .keeps_m = 0.2f,
        .times = 3,
        .box_kg = 0.02f},
    {.name = "springs, goal", .model = SPRINGS, .goal = 0.5f},
    {.name = "regions", .model = REGIONS},
    {.name = "regions, damped", .model = REGIONS, .damping = 0.2f},
    {.name = "borne springs, limits",
        .model = SPRINGS,
        .alone = true,
        .limit = 0.01f,
        .damping = 0.1f,
        .angular = 1e-5},
    {.name = "borne tetrahedra, limits",
        .model = TETRAHEDRA,
        .alone = true,
        .limit = 0.02f,
        .damping = 0.1f,
        .angular = 2e-5},
    {.name = "borne springs, volume",
        .model = SPRINGS,
        .alone = true,
        .surface = true,
        .pressure = SBF_PRESSURE_MODE_VOLUME,
        .damping = 0.1f},
    {.name = "borne springs, hung volume",
        .model = SPRINGS,
        .alone = true,
        .surface = true,
        .hung = true,
        .pressure = SBF_PRESSURE_MODE_VOLUME,
        .damping = 0.1f},
    {.name = "borne springs, itself",
        .model = SPRINGS,
        .alone = true,
        .surface = true,
        .keeps_m = 0.2f,
        .angular = 3e-4},
    {.name = "borne springs, itself, light",
        .model = SPRINGS,
        .alone = true,
        .surface = true,
        .keeps_m = 0.2f,
        .times = 3,
        .box_kg = 0.02f},
    /* Schemes whose forces are not evaluated at the start of a step: */
    {.name = "heun", .model = SPRINGS, .scheme = SBF_SCHEME_HEUN, .linear = 1e-3, .angular = 1e-3},
    {.name = "swept springs",
        .model = SPRINGS,
        .scheme = SBF_SCHEME_POSITION_BASED,
        .linear = 1e-3,
        .angular = 3e-3},
    {.name = "swept tetrahedra",
        .model = TETRAHEDRA,
        .scheme = SBF_SCHEME_POSITION_BASED,
        .linear = 5e-4,
        .angular = 2e-3},
    {.name = "descent, springs",
        .model = SPRINGS,
        .scheme = SBF_SCHEME_BLOCK_DESCENT,
        .linear = 3e-5,
        .angular = 3e-3},
    {.name = "descent, tetrahedra",
        .model = TETRAHEDRA,
        .scheme = SBF_SCHEME_BLOCK_DESCENT,
        .linear = 2e-5,
        .angular = 4e-3},
};

/* Multiple of the default. */
static float hit(scene *s, const kind *is) {
  float times = is->times > 0 ? is->times : 1;
  float kg = kg_of(is);
  sbf_vec3 impulse = {0.9f * kg * times, 1.5f * kg * times, 0.3f * kg * times};
  rigid_push(s, 0, (sbf_vec3){0, 0, 0.05f}, impulse);
  return times;
}

START_TEST(points_and_boxes_exchange_equal_momentum)
{
  const kind *is = &kinds[_i];
  scene s = dumbbell(is, SBR_INSTRUCTIONS_AUTOMATIC);
  float speed = 1.8f * hit(&s, is);
  scene_momentum first = scene_momentum_of(&s);
  double energy = scene_energy_of(&s);
  double linear = 0, angular = 0, unit = first.mass * (double)speed;
  for (int t = 0; t < 120; t++) {
    scene_ticks(&s, 1);
    if (is->keeps_m > 0) ck_assert_double_le(scene_energy_of(&s), 1.002 * energy);
    scene_momentum now = scene_momentum_of(&s);
    for (int k = 0; k < 3; k++) {
      linear = fmax(linear, fabs(now.linear[k] - first.linear[k]) / unit);
      angular = fmax(angular, fabs(now.angular[k] - first.angular[k]) / (unit * 0.2));
    }
  }
  if (getenv("SHOW_MOMENTUM")) printf("%-26s %.1e %.1e\n", is->name, linear, angular), fflush(stdout);
  ck_assert_msg(linear <= (is->linear > 0 ? is->linear : LINEAR), "%s: %g of momentum", is->name, linear);
  ck_assert_msg(
      angular <= (is->angular > 0 ? is->angular : ANGULAR), "%s: %g of angular momentum", is->name, angular);
  scene_free(&s);
}
END_TEST

START_TEST(every_lane_width_gives_the_same_bits)
{
  uint64_t hash = 0;
  for (int i = SBR_INSTRUCTIONS_SCALAR; i <= SBR_INSTRUCTIONS_WASM_SIMD128; i++) {
    sbr_instructions instructions = (sbr_instructions)i;
    if (!sbr_instructions_are_available(instructions)) continue;
    scene s = dumbbell(&kinds[_i], instructions);
    (void)hit(&s, &kinds[_i]);
    scene_ticks(&s, 30);
    uint64_t now = sbr_world_get_state_hash(s.world);
    if (i == SBR_INSTRUCTIONS_SCALAR) hash = now;
    ck_assert_msg(now == hash, "%s: %s", kinds[_i].name, sbr_instructions_get_name(instructions));
    scene_free(&s);
  }
}
END_TEST

int main(void) {
  Suite *suite = suite_create("momentum");
  TCase *tests = tcase_create("all");
  tcase_add_loop_test(tests, points_and_boxes_exchange_equal_momentum, 0, sizeof kinds / sizeof *kinds);
  tcase_add_loop_test(tests, every_lane_width_gives_the_same_bits, 0, sizeof kinds / sizeof *kinds);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
