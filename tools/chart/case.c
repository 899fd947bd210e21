#include "chart/case.h"

#include <stdio.h>
#include <string.h>

#include "base/fault.h"
#include "chart/made_bodies.h"

static sbf_status made(chart_subject *subject, sbf_asset *asset, const char *model, sbf_diagnostic *error) {
  if (!asset) return fault_set(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out for a body to chart");
  subject->asset = asset;
  snprintf(subject->model, sizeof subject->model, "%s", model);
  return SBF_OK;
}

/* 2 kg on 50 N/m: 5 rad/s. */
static sbf_status make_spring(uint32_t number, chart_subject *subject, sbf_diagnostic *error) {
  if (number) return SBF_OK;
  return made(subject, chart_mass_on_spring(2, 50), "springs", error);
}

/* Twenty masses: the lowest mode has 5 rad/s, the highest 67. */
static sbf_status make_chain(uint32_t number, chart_subject *subject, sbf_diagnostic *error) {
  if (number) return SBF_OK;
  return made(subject, chart_pinned_chain(20, 0.1f, 0.05f, 56), "springs", error);
}

/* Its spring has 100 rad/s, and stretches by at most 3 thousandths. */
static sbf_status make_pendulum(uint32_t number, chart_subject *subject, sbf_diagnostic *error) {
  if (number) return SBF_OK;
  return made(subject, chart_level_pendulum(1, 1, 10000), "springs", error);
}

/* ---- Bodies of matter: as tetrahedra, as springs, as regions ---- */

static const chart_matter BODY_AT_REST = {1000, 1e5f, 0.4f, 1};
static const chart_matter BAR_AT_REST = {1000, 1e6f, 0.4f, 1}, BAR_FREE = {1000, 1e6f, 0.4f, 0};
static const chart_matter SOFT_BALL = {1000, 5e4f, 0.4f, 0.1f};

/* Body number `number` of the three models. */
static sbf_status fill_model(uint32_t number, sbf_asset *surface, uint32_t elements, double spring_m,
    chart_subject *subject, sbf_diagnostic *error) {
  static const sbf_build_interior interiors[] = {
      SBF_BUILD_INTERIOR_TETRAHEDRA, SBF_BUILD_INTERIOR_LATTICE, SBF_BUILD_INTERIOR_SHAPE_MATCHING};
  static const char *const names[] = {"tetrahedra", "springs", "regions"};
  sbf_asset *filled;
  const chart_filling filling = {interiors[number], elements, spring_m, true};
  sbf_status status = chart_fill(surface, &filling, &filled, error);
  return status == SBF_OK ? made(subject, filled, names[number], error) : status;
}

static sbf_status make_cantilever(uint32_t number, chart_subject *subject, sbf_diagnostic *error) {
  return number < 3 ? fill_model(number, chart_bar(&BAR_AT_REST), 240, 0.1, subject, error) : SBF_OK;
}

static sbf_status make_beam(uint32_t number, chart_subject *subject, sbf_diagnostic *error) {
  return number < 3 ? fill_model(number, chart_bar(&BAR_FREE), 240, 0.1, subject, error) : SBF_OK;
}

static sbf_status make_drop(uint32_t number, chart_subject *subject, sbf_diagnostic *error) {
  return number < 3 ? fill_model(number, chart_ball(0.2f, &SOFT_BALL), 240, 0.1, subject, error) : SBF_OK;
}

static sbf_status make_hung(uint32_t number, chart_subject *subject, sbf_diagnostic *error) {
  return number < 3 ? fill_model(number, chart_figure(&BODY_AT_REST), 500, 0.1, subject, error) : SBF_OK;
}

/* A skin of springs around gas: 1 kPa above the outside, without prestress in the springs. */
static sbf_status make_pressure(uint32_t number, chart_subject *subject, sbf_diagnostic *error) {
  static const chart_matter skin = {1000, 5e4f, 0.3f, 0.05f};
  sbf_asset *filled = NULL, *ball = number ? NULL : chart_ball(0.2f, &skin);
  if (number) return SBF_OK;
  if (ball) {
    sbf_attributes *attributes = &((sbf_soft_body *)(uintptr_t)ball->soft_bodies.at)->attributes;
    attributes->pressure_mode = SBF_PRESSURE_MODE_GAS;
    attributes->pressure = 1000;
    attributes->mass = 1;
  }
  const chart_filling filling = {.interior = SBF_BUILD_INTERIOR_NONE};
  sbf_status status = chart_fill(ball, &filling, &filled, error);
  return status == SBF_OK ? made(subject, filled, "springs", error) : status;
}

/* ---- The same matter in several meshes ---- */

/* The reference first, then each size unchanged and calibrated. */
static sbf_status make_mesh(
    uint32_t number, const chart_matter *matter, chart_subject *subject, sbf_diagnostic *error) {
  static const uint32_t sizes[] = {60, 120, 240, 480, 960, 1920, 3840};
  enum { SIZES = 7 };
  if (number > 2 * SIZES) return SBF_OK;
  bool calibrated = number > SIZES;
  uint32_t elements = number ? sizes[(number - 1) % SIZES] : 16000;
  sbf_asset *filled;
  const chart_filling filling = {SBF_BUILD_INTERIOR_TETRAHEDRA, elements, 0, calibrated};
  sbf_status status = chart_fill(chart_bar(matter), &filling, &filled, error);
  if (status != SBF_OK) return status;
  snprintf(subject->line, sizeof subject->line, "%s", calibrated ? "calibrated" : "uncalibrated");
  return made(subject, filled, "tetrahedra", error);
}

static sbf_status make_cantilever_mesh(uint32_t number, chart_subject *subject, sbf_diagnostic *error) {
  return make_mesh(number, &BAR_AT_REST, subject, error);
}

static sbf_status make_beam_mesh(uint32_t number, chart_subject *subject, sbf_diagnostic *error) {
  return make_mesh(number, &BAR_FREE, subject, error);
}

/* ---- */

enum {
  MOTION = 1u << CHART_PATH | 1u << CHART_FARTHEST | 1u << CHART_ENERGY,
  SWING = MOTION | 1u << CHART_PERIOD | 1u << CHART_AMPLITUDE,
  REST = 1u << CHART_SHAPE
};

const chart_case chart_cases[] = {
    {.name = "spring",
        .title = "one mass on a spring, let go: 5 rad/s, five seconds",
        .ticks = 300,
        .axes = SWING,
        .signal = {.there = true, .point = 1, .along = 1},
        .gravity = {0, -0.5f, 0},
        .in_double = true,
        .make = make_spring},
    {.name = "chain",
        .title = "twenty masses on springs between two held points, let go: five seconds",
        .ticks = 300,
        .axes = SWING,
        .signal = {.there = true, .point = 10, .along = 1},
        .gravity = {0, -1, 0},
        .in_double = true,
        .make = make_chain},
    {.name = "pendulum",
        .title = "a mass on a stiff spring, let go from level: six seconds",
        .ticks = 360,
        .axes = SWING,
        .signal = {.there = true, .point = 1, .along = 0},
        .gravity = {0, -9.81f, 0},
        .in_double = true,
        .make = make_pendulum},
    {.name = "cantilever",
        .title = "a bar of 1 m held at one end comes to rest under its weight: four seconds",
        .ticks = 240,
        .timed_ticks = 60,
        .axes = REST,
        .gravity = {0, -9.81f, 0},
        .make = make_cantilever},
    {.name = "beam",
        .title = "the same bar, undamped, let go under a tenth of its weight: three seconds",
        .ticks = 180,
        .timed_ticks = 60,
        .axes = SWING,
        .signal = {.there = true, .point = CHART_END_POINT, .along = 1},
        .gravity = {0, -0.981f, 0},
        .in_double = true,
        .make = make_beam},
    {.name = "drop",
        .title = "a soft ball of 0.4 m dropped from 0.3 m: one second",
        .ticks = 60,
        .axes = 1u << CHART_PATH | 1u << CHART_FARTHEST | 1u << CHART_VOLUME,
        .grounded = true,
        .raise_m = 0.5,
        .gravity = {0, -9.81f, 0},
        .make = make_drop},
    {.name = "pressure",
        .title = "a ball of springs about gas, which swells and breathes: one second",
        .ticks = 60,
        .axes = 1u << CHART_PATH | 1u << CHART_PERIOD | 1u << CHART_AMPLITUDE | 1u << CHART_VOLUME,
        .signal = {.there = true, .of_volume = true},
        .make = make_pressure},
    {.name = "hung",
        .title = "a soft figure of 1 m hung by its head comes to rest: four seconds",
        .ticks = 240,
        .timed_ticks = 30,
        .axes = REST | 1u << CHART_VOLUME,
        .gravity = {0, -9.81f, 0},
        .make = make_hung},
    {.name = "cantilever-meshes",
        .title = "the bar at rest in coarser and finer meshes, against 16,000 tetrahedra",
        .ticks = 240,
        .timed_ticks = 60,
        .axes = REST,
        .watch = CHART_WATCH_SURFACE,
        .gravity = {0, -9.81f, 0},
        .of_space = true,
        .make = make_cantilever_mesh},
    {.name = "beam-meshes",
        .title = "the bar that swings in coarser and finer meshes, against 16,000 tetrahedra",
        .ticks = 180,
        .timed_ticks = 60,
        .axes = 1u << CHART_PATH | 1u << CHART_PERIOD | 1u << CHART_AMPLITUDE,
        .signal = {.there = true, .point = CHART_END_POINT, .along = 1},
        .watch = CHART_WATCH_SURFACE,
        .gravity = {0, -0.981f, 0},
        .of_space = true,
        .make = make_beam_mesh},
};
const uint32_t chart_case_count = sizeof chart_cases / sizeof *chart_cases;

chart_scene chart_scene_of(const chart_case *c, const sbf_asset *asset) {
  return (chart_scene){.asset = asset,
      .has_gravity = !c->given,
      .gravity = c->gravity,
      .ground = c->ground,
      .grounded = c->grounded,
      .raise_m = c->raise_m,
      .ticks = c->ticks,
      .timed_ticks = c->timed_ticks,
      .watch = c->watch,
      .before_tick = c->before_tick,
      .begin = c->begin,
      .user = c->user};
}

const chart_case *chart_case_named(const char *name) {
  for (uint32_t i = 0; i < chart_case_count; i++)
    if (strcmp(chart_cases[i].name, name) == 0) return &chart_cases[i];
  return NULL;
}
