/* Every scheme on bars of springs, of tetrahedra and of regions that match shapes: how far what it does is
 * off what the energy says, case by case, each within its stated bound. The energy's own answer is
 * mechanics/static_solve.h's and sbf_network_lowest's, which tests/mechanics compares with closed forms; of
 * regions it is the finest symplectic steps'.
 *
 * With SBFMT_BIAS_CSV=FILE the program adds what it has measured to that file, from which
 * bench/write_tables.py makes the table of docs/solvers.md: bench/results/any-machine/bias.csv. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "mechanics/static_solve.h"
#include "mechanics/vector.h"
#include "scene_state.h"
#include "scenes.h"
#include "state/state.h"
#include "state/world.h"

typedef enum { SOLID, SPRINGS, REGIONS, MODEL_COUNT } elastic;
typedef enum { STRETCH, BEND, BEND_FAR, TWIST, INCOMPRESSIBLE, SWING, SPIN, FAST_SPIN, CASE_COUNT } question;
static const char *const model_names[] = {"tetrahedra", "springs", "regions"};
static const char *const case_names[] = {
    "stretch", "bend", "bend_far", "twist", "nu_0.49", "swing", "spin", "spin_6_rad/s"};

enum { ALONG = 10, ACROSS = 2, MAX_POINTS = 128, MAX_PINNED = 18, MAX_SPRINGS = 1024 };

typedef struct row {
  sbf_scheme scheme;
  uint32_t substeps; /* 0: chosen by the scheme */
  float stiffness_damping_s;
  /* Maximum errors as fractions, by models: for SWING the period, for both rotations the greater of momentum
   * and angular momentum. Negative: it does not support the model. */
  double within[CASE_COUNT][MODEL_COUNT];
  double damping[MODEL_COUNT]; /* maximum damping ratio added to SWING */
} row;

static const row rows[] = {
    {SBF_SCHEME_SYMPLECTIC, 0, 0,
        {{1e-4, 1e-4, 1e-4}, {1e-4, 1e-4, 1e-3}, {1e-4, 1e-4, 1e-4}, {1e-3, 1e-3, 1e-3}, {1e-4, -1, -1},
            {1e-4, 1e-4, 1e-3}, {1e-4, 1e-4, 1e-3}, {1e-4, 1e-4, 1e-3}},
        {1e-4, 1e-4, 1e-4}},
    {SBF_SCHEME_POSITION_BASED, 0, 0,
        {{0.02, 0.02, -1}, {0.02, 0.025, -1}, {0.02, 0.035, -1}, {0.03, 0.01, -1}, {0.005, -1, -1},
            {0.01, 0.015, -1}, {2e-3, 1e-3, -1}, {0.06, 0.03, -1}},
        {0.005, 0.0025, 0}},
    {SBF_SCHEME_POSITION_BASED, 64, 0,
        {{0.004, 0.01, -1}, {0.004, 0.01, -1}, {0.004, 0.015, -1}, {0.01, 0.01, -1}, {1e-3, -1, -1},
            {0.002, 0.005, -1}, {6e-3, 1e-3, -1}, {0.02, 0.02, -1}},
        {0.0015, 0.0015, 0}},
    {SBF_SCHEME_HEUN, 0, 1e-3f,
        {{1e-3, 1e-3, 1e-3}, {2e-3, 2e-3, 2e-3}, {1e-3, 1e-3, 1e-3}, {2e-3, 2e-3, 2e-3}, {4e-3, -1, -1},
            {1e-3, 1e-3, 1e-3}, {1.5e-3, 1e-3, 1e-3}, {1e-3, 1e-3, 1e-3}},
        {0.005, 0.005, 0.005}},
    {SBF_SCHEME_EXPLICIT_EULER, 128, 2e-3f,
        {{1e-3, 1e-3, 1e-3}, {2e-3, 2e-3, 2e-3}, {1e-3, 1e-3, 1e-3}, {2e-3, 2e-3, 2e-3}, {4e-3, -1, -1},
            {1e-3, 1e-3, 1e-3}, {1e-3, 1e-3, 1e-3}, {0.01, 0.01, 0.01}},
        {0.01, 0.01, 0.01}},
    {SBF_SCHEME_BLOCK_DESCENT, 10, 0,
        {{1e-3, 1e-3, -1}, {1e-3, 1e-3, -1}, {1e-3, 1e-3, -1}, {1e-3, 1e-3, -1}, {0.2, -1, -1}, {1, 1, -1},
            {4e-3, 4e-3, -1}, {0.11, 0.11, -1}},
        {1, 1, 0}},
};
enum { ROW_COUNT = sizeof rows / sizeof *rows };

/* ---- The bar: 1 x 0.2 x 0.2 m along x, 1 MPa, 1000 kg/m3, held at x = 0 or free ---- */

typedef struct bar {
  lattice_box box;
  sbf_uint2 ends[MAX_SPRINGS];
  float stiffness[MAX_SPRINGS];
  uint32_t spring_count;
} bar;
static bar b;
static scene s;

static void add_edge(uint32_t p, uint32_t q) {
  for (uint32_t i = 0; i < b.spring_count; i++)
    if ((b.ends[i].at[0] == p && b.ends[i].at[1] == q) || (b.ends[i].at[0] == q && b.ends[i].at[1] == p))
      return;
  b.ends[b.spring_count] = (sbf_uint2){{p, q}};
  b.stiffness[b.spring_count++] = 0.4f * 1e6f * 0.1f;
}

static void make_bar(float poisson, bool pinned) {
  b.box = lattice_box_make(
      (sbf_vec3){0, -0.1f, -0.1f}, (sbf_vec3){1, 0.2f, 0.2f}, ALONG, ACROSS, ACROSS, 1000, 1e6f, poisson);
  if (pinned) lattice_box_hold(&b.box);
  b.spring_count = 0;
  for (uint32_t t = 0; t < b.box.tetrahedron_count; t++)
    for (int i = 0; i < 4; i++)
      for (int k = 0; k < i; k++) add_edge(b.box.tetrahedra[t].at[i], b.box.tetrahedra[t].at[k]);
}

static sbf_spring_network network_of(elastic model) {
  sbf_spring_network n = lattice_box_network(&b.box);
  if (model != SPRINGS) return n;
  n.tetrahedron_count = 0;
  n.spring_count = b.spring_count, n.ends = b.ends, n.stiffness = b.stiffness;
  return n;
}

/* The far end, turned about the bar's axis by this many radians in TWIST. */
static const double TWIST_RAD = 0.3;

static sbf_vec3 held_at(uint32_t point, question q) {
  sbf_vec3 p = b.box.positions[point];
  if (q != TWIST || p.x < 0.5f) return p;
  float c = (float)cos(TWIST_RAD), n = (float)sin(TWIST_RAD);
  return (sbf_vec3){p.x, c * p.y - n * p.z, n * p.y + c * p.z};
}

static void hold(sbf_level *level, question q) {
  uint32_t pinned[MAX_PINNED], count = 0;
  sbf_vec3 *offsets = sbf_asset_allocate(s.asset, MAX_PINNED, sizeof *offsets);
  for (uint32_t i = 0; i < b.box.point_count; i++)
    if (!(b.box.masses[i] > 0)) offsets[count] = held_at(i, q), pinned[count++] = i;
  if (!count) return;
  scene_pin(&s, level, -1, pinned, count);
  ((sbf_pin_set *)(uintptr_t)level->pins.at)->offsets = (sbf_vec3_list){offsets, count};
}

static void begin(elastic model, const row *r, question q, sbf_vec3 gravity) {
  static const uint32_t counts[3] = {ALONG + 1, ACROSS + 1, ACROSS + 1};
  make_bar(q == INCOMPRESSIBLE ? 0.49f : 0.3f, q != SPIN);
  for (uint32_t i = 0; q == TWIST && i < b.box.point_count; i++)
    if (b.box.positions[i].x > 0.99f) b.box.masses[i] = 0;
  s = scene_begin();
  sbf_level *level;
  if (model == REGIONS) {
    level = scene_regions(&s, 0, (sbf_vec3){0, -0.1f, -0.1f}, 0.1f, counts, 1, 300, 1);
    memcpy((float *)(uintptr_t)level->masses.at, b.box.masses, b.box.point_count * sizeof(float));
  } else if (model == SPRINGS) {
    level = scene_points(&s, 0, b.box.positions, b.box.masses, b.box.point_count);
    scene_springs(&s, level, b.ends, b.stiffness, b.spring_count);
  } else {
    level = scene_lattice(&s, 0, &b.box);
  }
  hold(level, q);
  scene_body(&s, 0)->attributes.stiffness_damping = r->stiffness_damping_s;
  s.world_definition.has_gravity = true, s.world_definition.gravity = gravity;
  s.model_options.scheme = r->scheme;
  s.model_options.substeps = q == INCOMPRESSIBLE ? 4 * r->substeps : r->substeps; /* which is stiffer */
}
static void end(void) {
  scene_free(&s);
  lattice_box_free(&b.box);
}

/* ---- Statics ---- */

static sbf_vec3 load_of(question q) {
  if (q == STRETCH) return (sbf_vec3){9.81f, 0, 0};
  if (q == TWIST) return (sbf_vec3){0, 0, 0};
  return (sbf_vec3){0, q == BEND ? -0.5f : q == BEND_FAR ? -30 : -9.81f, 0};
}

static void run_to_rest(elastic model, const row *r, question q, sbf_vec3 *positions) {
  begin(model, r, q, load_of(q));
  scene_body(&s, 0)->attributes.damping_ratio = 1;
  scene_start(&s);
  scene_ticks(&s, r->scheme == SBF_SCHEME_BLOCK_DESCENT ? 900 : 400);
  ck_assert_uint_eq(scene_read(&s, 0, positions, MAX_POINTS), b.box.point_count);
  sbr_body_health h = sbr_character_get_body_health(s.world, s.character, 0);
  ck_assert(h.finite && !h.inverted && h.recoveries == 0);
}

/* Fraction by which displacements exceed those at the minimum of energy. */
static double rest_bias(elastic model, const row *r, question q) {
  static const row finest = {.scheme = SBF_SCHEME_SYMPLECTIC, .substeps = 64};
  static sbf_vec3 positions[MAX_POINTS], exact[MAX_POINTS];
  if (model == REGIONS) {
    run_to_rest(model, &finest, q, exact);
    end();
  }
  run_to_rest(model, r, q, positions);
  if (model != REGIONS) {
    sbf_spring_network network = network_of(model);
    double *solved = calloc(3 * (size_t)b.box.point_count, sizeof *solved);
    sbfi_static_problem problem = {.network = &network, .gravity = load_of(q)};
    sbfi_static_outcome outcome;
    sbfi_static_start(&network, solved);
    for (uint32_t i = 0; i < b.box.point_count; i++) {
      sbf_vec3 at = held_at(i, q);
      if (b.box.masses[i] > 0) continue;
      solved[3 * i] = (double)at.x, solved[3 * i + 1] = (double)at.y, solved[3 * i + 2] = (double)at.z;
    }
    ck_assert(sbfi_static_solve(&problem, solved, &outcome, NULL) && outcome.converged);
    for (uint32_t i = 0; i < b.box.point_count; i++)
      exact[i] = (sbf_vec3){(float)solved[3 * i], (float)solved[3 * i + 1], (float)solved[3 * i + 2]};
    free(solved);
  }
  double along = 0, all = 0;
  for (uint32_t i = 0; i < b.box.point_count; i++) {
    if (!(b.box.masses[i] > 0)) continue;
    sbfi_d3 rest = sbfi_d3_of(b.box.positions[i]), e = sbfi_d3_sub(sbfi_d3_of(exact[i]), rest);
    along += sbfi_d3_dot(e, sbfi_d3_sub(sbfi_d3_of(positions[i]), rest)), all += sbfi_d3_dot(e, e);
  }
  ck_assert_double_gt(all, 1e-8);
  end();
  return along / all - 1;
}

/* ---- Motion ---- */

/* The bar is released from a slight bend: period and damping ratio of the motion. */
static double swing_period(elastic model, const row *r, double *damping) {
  enum { TICKS = 240 };
  static sbf_vec3 positions[MAX_POINTS], shape[MAX_POINTS];
  double off[TICKS], sum = 0, first = -1, last = -1, high[2] = {0, 0};
  uint32_t crossings = 0;
  begin(model, r, SWING, (sbf_vec3){0, 0, 0});
  scene_start(&s);
  sbri_character *c = &s.world->characters[0];
  for (uint32_t i = 0; i < b.box.point_count; i++) { /* the first mode of a beam held at one end, nearly */
    double x = b.box.positions[i].x, bend = 0.02 * x * x * (6 - 4 * x + x * x) / 3;
    double slope = 0.02 * (12 * x - 12 * x * x + 4 * x * x * x) / 3;
    shape[i] = (sbf_vec3){(float)(-slope * b.box.positions[i].y), (float)bend, 0};
    uint32_t slot = s.model->bodies[0].slots.from_point[i];
    if (!(b.box.masses[i] > 0)) continue;
    sbri_positions(c)[slot].x += shape[i].x, sbri_positions(c)[slot].y += shape[i].y;
    sum += b.box.masses[i] * sbfi_d3_dot(sbfi_d3_of(shape[i]), sbfi_d3_of(shape[i]));
  }
  for (uint32_t n = 0; n < TICKS; n++) {
    scene_ticks(&s, 1);
    scene_read(&s, 0, positions, MAX_POINTS);
    off[n] = 0;
    for (uint32_t i = 0; i < b.box.point_count; i++)
      off[n] += b.box.masses[i] / sum *
                sbfi_d3_dot(sbfi_d3_sub(sbfi_d3_of(positions[i]), sbfi_d3_of(b.box.positions[i])),
                    sbfi_d3_of(shape[i]));
    if (n == 0 || !(off[n - 1] < 0 && off[n] >= 0)) continue;
    last = n - 1 + off[n - 1] / (off[n - 1] - off[n]);
    if (first < 0) first = last;
    crossings++;
  }
  end();
  ck_assert_uint_gt(crossings, 2);
  double period = (last - first) / (crossings - 1);
  for (uint32_t n = 0; n < TICKS;
       n++) { /* root of mean squares over whole periods, of the first and the last */
    if (n >= first && n < first + period) high[0] += off[n] * off[n];
    if (n >= last - period && n < last) high[1] += off[n] * off[n];
  }
  *damping = 0.5 * log(high[0] / high[1]) / (2 * 3.14159265358979 * (crossings - 2));
  return period / 60;
}

static double swing_bias(elastic model, const row *r, double *damping) {
  static const row finest = {.scheme = SBF_SCHEME_SYMPLECTIC, .substeps = 128};
  double unused, period = swing_period(model, r, damping), exact;
  exact = swing_period(model, &finest, &unused);
  if (model != REGIONS) { /* and that is the energy's own */
    make_bar(0.3f, true);
    sbf_spring_network network = network_of(model);
    double *scratch = calloc(16 * (size_t)b.box.point_count, sizeof *scratch);
    double lowest = 2 * 3.14159265358979 / sbf_network_lowest(&network, true, scratch);
    free(scratch);
    lattice_box_free(&b.box);
    ck_assert_double_eq_tol(exact, lowest, 0.01 * lowest);
  }
  return period / exact - 1;
}

/* Momentum, and angular momentum about the centre of mass, kg m/s and kg m^2/s. */
static void find_momentum(sbfi_d3 parts[2]) {
  sbri_character *c = &s.world->characters[0];
  sbfi_d3 moment = {0, 0, 0}, turn = {0, 0, 0}, momentum = {0, 0, 0};
  double mass = 0;
  for (uint32_t i = 0; i < s.model->islands[0].free_count; i++) {
    double m = s.model->islands[0].masses[i];
    const sbri_point *x = &sbri_positions(c)[i];
    const float *v = scene_velocity(&s, i);
    sbfi_d3 p = {m * (double)v[0], m * (double)v[SBRI_BLOCK], m * (double)v[2 * SBRI_BLOCK]};
    sbfi_d3 at = {(double)x->x, (double)x->y, (double)x->z};
    mass += m;
    moment = sbfi_d3_add(moment, sbfi_d3_scale(at, m));
    momentum = sbfi_d3_add(momentum, p);
    turn = sbfi_d3_add(turn, sbfi_d3_cross(at, p));
  }
  parts[0] = momentum;
  parts[1] = sbfi_d3_sub(turn, sbfi_d3_cross(sbfi_d3_scale(moment, 1 / mass), momentum));
}

/* Thrown with rotation and vibration: gain or loss of momentum and of angular momentum about its centre of
 * mass in two seconds. */
static double spin_bias(elastic model, const row *r, float rad_s) {
  begin(model, r, SPIN, (sbf_vec3){0, 0, 0});
  scene_start(&s);
  sbri_character *c = &s.world->characters[0];
  sbfi_d3 before[2], after[2];
  uint32_t random = 7;
  for (uint32_t i = 0; i < s.model->islands[0].free_count; i++) {
    const sbri_point *x = &sbri_positions(c)[i];
    float *v = scene_velocity(&s, i);
    if (!(s.model->islands[0].masses[i] > 0)) continue;
    random = random * 1664525u + 1013904223u;
    float noise = 0.4f * (float)(int32_t)random / 2147483648.0f;
    v[0] = 1 - rad_s * x->y, v[SBRI_BLOCK] = 2 + rad_s * x->x, v[2 * SBRI_BLOCK] = noise;
  }
  find_momentum(before);
  scene_ticks(&s, 120);
  find_momentum(after);
  end();
  double worst = 0;
  for (int k = 0; k < 2; k++)
    worst = fmax(worst, sbfi_d3_length(sbfi_d3_sub(after[k], before[k])) / sbfi_d3_length(before[k]));
  return worst;
}

/* ---- */

static void report(const row *r, elastic model, question q, double bias, double damping) {
  const char *path = getenv("SBFMT_BIAS_CSV");
  FILE *file = path ? fopen(path, "a") : NULL;
  if (!file) return;
  if (ftell(file) == 0) fprintf(file, "case,model,scheme,substeps,bias,damping\n");
  fprintf(file, "%s,%s,%s,%u,%.6f,%.6f\n", case_names[q], model_names[model], sbf_scheme_name(r->scheme),
      (unsigned)r->substeps, bias, damping);
  fclose(file);
}

START_TEST(bias_is_within_its_bound)
{
  const row *r = &rows[_i / CASE_COUNT];
  question q = (question)(_i % CASE_COUNT);
  char said[512];
  size_t used = 0;
  for (int model = 0; model < MODEL_COUNT; model++) {
    double within = r->within[q][model], damping = 0, bias;
    if (within < 0) continue;
    if (q == SWING)
      bias = swing_bias((elastic)model, r, &damping);
    else
      bias = q >= SPIN ? spin_bias((elastic)model, r, q == SPIN ? 1 : 6) : rest_bias((elastic)model, r, q);
    report(r, (elastic)model, q, bias, damping);
    bool good = fabs(bias) <= within && (q != SWING || fabs(damping) <= r->damping[model]);
    if (!good)
      used += (size_t)snprintf(said + used, sizeof said - used, "%s, %u, %s of %s: %.6f, damping %.6f\n",
          sbf_scheme_name(r->scheme), (unsigned)r->substeps, case_names[q], model_names[model], bias,
          damping);
  }
  ck_assert_msg(used == 0, "%s", said);
}
END_TEST

/* Position-based steps draw what turns back to its circle from the tangent: it loses w^2 h of its angular
 * velocity a second, so that w = w0 / sqrt(1 + 2 w0^2 h t). */
START_TEST(position_based_rotation_decays_with_its_squared_speed)
{
  static const uint32_t substeps[] = {8, 16, 32, 64};
  const row r = {.scheme = SBF_SCHEME_POSITION_BASED, .substeps = substeps[_i]};
  for (int model = SOLID; model <= SPRINGS; model++)
    for (int w = substeps[_i] == 64 ? 6 : 3; w <= 6; w += 3) {
      double h = 1.0 / 60 / substeps[_i], expected = 1 - 1 / sqrt(1 + 2 * 2.0 * w * w * h);
      ck_assert_double_eq_tol(spin_bias((elastic)model, &r, (float)w), expected, 0.05 * expected);
    }
}
END_TEST

int main(void) {
  Suite *suite = suite_create("scheme_bias");
  TCase *c = tcase_create("scheme_bias");
  tcase_add_loop_test(c, bias_is_within_its_bound, 0, ROW_COUNT * CASE_COUNT);
  tcase_add_loop_test(c, position_based_rotation_decays_with_its_squared_speed, 0, 4);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
