/* Inverse kinematics: passes, microseconds and error of the solvers on a chain of ten links of 1 m.
 *
 * Each case has a thousand targets: `reachable` uniformly in the ball of 10 m about the root,
 * `unreachable` from 10.5 m to 20 m, `root` within 1 cm of the root, where the chain must fold up. Every
 * solve starts from the chain bent by 0.2 rad at each joint. `passes` and `us` are means over the targets.
 * `error` is in metres; for unreachable targets it is the distance beyond the nearest reachable point.
 * `missed` counts targets whose error is above the tolerance (unreachable: 10 times the tolerance) after
 * 400 passes. `limited` chains bend by up to 0.8 rad at a joint; most of their missed targets are out of
 * their reach. */
#include <math.h>
#include <stdio.h>

#include "animation/ik/ik.h"
#include "measuring.h"

enum { JOINTS = 11, TARGETS = 1000 };

typedef sbri_ik_result method(sbri_ik_chain *chain);
typedef struct solver {
  const char *name;
  method *solve;
} solver;

static const solver solvers[] = {{"fabrik", sbri_fabrik}, {"ccd", sbri_ccd},
    {"damped_least_squares", sbri_damped_least_squares}, {"spline", sbri_ik_spline}};

typedef enum location { REACHABLE, UNREACHABLE, ROOT, TARGET_COUNT } location;
static const char *const target_names[TARGET_COUNT] = {"reachable", "unreachable", "root"};

/* Solving all targets of one kind, with one solver. */
typedef struct work {
  const solver *with;
  const sbf_vec3 *targets;
  const sbri_joint_limit *limit;
  float tolerance;
  uint32_t count, passes, missed;
  double error_sum, error_max;
} work;

static float next(uint32_t *seed) {
  *seed = *seed * 1664525u + 1013904223u;
  return (float)(*seed >> 8) / 8388608.0f - 1;
}

static sbf_vec3 in_ball(uint32_t *seed) {
  for (;;) {
    float x = next(seed), y = next(seed), z = next(seed);
    if (x * x + y * y + z * z <= 1) return (sbf_vec3){x, y, z};
  }
}

static void make_targets(location kind, sbf_vec3 *targets) {
  uint32_t seed = 1;
  for (int i = 0; i < TARGETS; i++) {
    sbf_vec3 p = in_ball(&seed);
    float size = sbri_length(p);
    if (kind == UNREACHABLE) p = sbri_scale(p, (1.05f + 0.95f * size) / size);
    targets[i] = sbri_scale(p, kind == ROOT ? 0.01f : 10);
  }
}

static void solve_all(void *context) {
  work *w = context;
  w->passes = w->missed = 0;
  w->error_sum = w->error_max = 0;
  for (uint32_t i = 0; i < w->count; i++) {
    sbri_ik_joint joints[JOINTS];
    for (int k = 0; k < JOINTS; k++) {
      bool inner = k > 0 && k + 1 < JOINTS;
      joints[k] = (sbri_ik_joint){.offset = {0, k ? 1.0f : 0, 0},
          .rotation = inner ? (sbf_quat){0.0998334f, 0, 0, 0.9950042f} : sbri_quat_identity(),
          .limit = inner ? w->limit : NULL};
    }
    sbri_ik_chain chain = {.base = {{0, 0, 0}, {0, 0, 0, 1}},
        .joints = joints,
        .count = JOINTS,
        .target = w->targets[i],
        .tolerance = w->tolerance,
        .iterations = 400};
    sbri_ik_result r = w->with->solve(&chain);
    float beyond = sbri_length(w->targets[i]) - (JOINTS - 1);
    double error = (double)(beyond > 0 ? r.error - beyond : r.error);
    w->passes += r.iterations;
    w->missed += error > (double)w->tolerance * (beyond > 0 ? 10 : 1);
    w->error_sum += error;
    w->error_max = error > w->error_max ? error : w->error_max;
  }
}

int main(int argument_count, char **arguments) {
  bool quick = bench_is_quick(argument_count, arguments);
  const float tolerances[] = {1e-2f, 1e-4f};
  sbf_quat rotation = sbri_quat_between(sbri_vec3(0, 1, 0), sbri_vec3(1, 0, 0));
  const sbri_joint_limit limit = {.before = rotation,
      .after = sbri_quat_conjugate(rotation),
      .twist = {-0.8f, 0.8f},
      .swing_y = {-3.2f, 3.2f},
      .swing_z = {-3.2f, 3.2f},
      .cone = 0.8f,
      .active = true};
  sbf_vec3 targets[TARGETS];
  bench_print_columns("solver,limits,targets,tolerance_m,passes,us,error_mean_m,error_most_m,missed,of");
  for (int limited = 0; limited < 2; limited++)
    for (int kind = 0; kind < TARGET_COUNT; kind++)
      for (size_t t = 0; t < sizeof tolerances / sizeof *tolerances; t++) {
        enum { SOLVERS = sizeof solvers / sizeof *solvers };
        work works[SOLVERS];
        bench_case cases[SOLVERS];
        make_targets((location)kind, targets);
        for (int s = 0; s < SOLVERS; s++) {
          works[s] = (work){.with = &solvers[s],
              .targets = targets,
              .limit = limited ? &limit : NULL,
              .tolerance = tolerances[t],
              .count = quick ? 20 : TARGETS};
          cases[s] = (bench_case){.run = solve_all, .context = &works[s]};
        }
        bench_rounds(cases, SOLVERS, bench_round_count(5));
        for (int s = 0; s < SOLVERS; s++) {
          const work *w = &works[s];
          bench_print_row("%s,%s,%s,%g,%.1f,%.2f,%.3g,%.3g,%u,%u", w->with->name,
              limited ? "limited" : "free", target_names[kind], (double)w->tolerance,
              (double)w->passes / w->count, 1e6 * cases[s].s.min / w->count, w->error_sum / w->count,
              w->error_max, w->missed, w->count);
        }
      }
  return 0;
}
