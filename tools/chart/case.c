#include "chart/case.h"

#include <stdio.h>
#include <string.h>

#include "render/fault.h"

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

/* Twenty masses: the lowest mode turns by 5 rad/s, the highest by 67. */
static sbf_status make_chain(uint32_t number, chart_subject *subject, sbf_diagnostic *error) {
  if (number) return SBF_OK;
  return made(subject, chart_held_chain(20, 0.1f, 0.05f, 56), "springs", error);
}

/* Its spring turns by 100 rad/s, and stretches by 3 thousandths at most. */
static sbf_status make_pendulum(uint32_t number, chart_subject *subject, sbf_diagnostic *error) {
  if (number) return SBF_OK;
  return made(subject, chart_level_pendulum(1, 1, 10000), "springs", error);
}

enum {
  MOTION = 1u << CHART_PATH | 1u << CHART_FARTHEST | 1u << CHART_ENERGY,
  SWING = MOTION | 1u << CHART_PERIOD | 1u << CHART_AMPLITUDE
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
};
const uint32_t chart_case_count = sizeof chart_cases / sizeof *chart_cases;

const chart_case *chart_case_named(const char *name) {
  for (uint32_t i = 0; i < chart_case_count; i++)
    if (strcmp(chart_cases[i].name, name) == 0) return &chart_cases[i];
  return NULL;
}
