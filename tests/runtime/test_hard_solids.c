/* Hard cases for schemes that step tetrahedra, and for regions that match shapes: almost no change of volume,
 * a point ten thousand times as heavy as its neighbours, frames that alternate between a quarter of a second
 * and almost none, a jump of the position, and matter as stiff as steel; in every scheme that supports it. */
#include "harness.h"
#include "scenes.h"
#include "state/state.h"

static const sbf_scheme schemes[] = {SBF_SCHEME_AUTOMATIC, SBF_SCHEME_SYMPLECTIC, SBF_SCHEME_POSITION_BASED,
    SBF_SCHEME_HEUN, SBF_SCHEME_BLOCK_DESCENT, SBF_SCHEME_EXPLICIT_EULER};
enum { SCHEME_COUNT = 6 };
typedef enum { NEARLY_INCOMPRESSIBLE, HEAVY_POINT, HITCHES, JUMPS, VERY_STIFF, HARD_CASES } hardship;
typedef enum { SOLID, REGIONS, KINDS } kind;

static lattice_box box;
static scene s;

static bool is_made_for(sbf_scheme scheme, kind what, hardship how) {
  bool sweeps = scheme == SBF_SCHEME_POSITION_BASED || scheme == SBF_SCHEME_BLOCK_DESCENT;
  if (what == REGIONS) return !sweeps && how != NEARLY_INCOMPRESSIBLE; /* which have no Poisson's ratio */
  /* Explicit steps of the stiffest would be many hundred a tick. */
  return how != VERY_STIFF || sweeps || scheme == SBF_SCHEME_AUTOMATIC;
}

/* A metre along x, held at x = 0. */
static void make(sbf_scheme scheme, kind what, hardship how) {
  static const uint32_t counts[3] = {11, 3, 3};
  box = lattice_box_make((sbf_vec3){0, 0, 0}, (sbf_vec3){1, 0.2f, 0.2f}, 10, 2, 2, 1000,
      how == VERY_STIFF ? 1e9f : 1e5f, how == NEARLY_INCOMPRESSIBLE ? 0.49f : 0.4f);
  lattice_box_hold(&box);
  if (how == HEAVY_POINT)
    box.masses[lattice_box_point(&box, 10, 1, 1)] = 1e4f * box.masses[lattice_box_point(&box, 10, 1, 0)];
  s = scene_begin();
  if (what == SOLID) {
    scene_lattice(&s, 0, &box);
  } else {
    sbf_level *level =
        scene_regions(&s, 0, (sbf_vec3){0, 0, 0}, 0.1f, counts, 1, how == VERY_STIFF ? 2000 : 100, 1);
    uint32_t pinned[9], count = 0;
    for (uint32_t i = 0; i < box.point_count; i++) {
      ((float *)(uintptr_t)level->masses.at)[i] = box.masses[i];
      if (!(box.masses[i] > 0)) pinned[count++] = i;
    }
    scene_pin(&s, level, -1, pinned, count);
  }
  scene_body(&s, 0)->attributes.damping_ratio = 0.2f;
  if (scheme == SBF_SCHEME_EXPLICIT_EULER) { /* which needs it damped */
    scene_body(&s, 0)->attributes.stiffness_damping = 2e-3f;
    s.model_options.substeps = how == NEARLY_INCOMPRESSIBLE || how == VERY_STIFF ? 800 : 200;
  }
  s.model_options.scheme = scheme;
  s.world_definition.has_gravity = true;
  s.world_definition.gravity = (sbf_vec3){0, how == HEAVY_POINT ? -0.01f : -9.81f, 0};
  scene_start(&s);
}

START_TEST(hard_cases_stay_stable)
{
  hardship how = (hardship)(_i % HARD_CASES);
  sbf_scheme scheme = schemes[_i / HARD_CASES];
  for (int what = 0; what < KINDS; what++) {
    if (!is_made_for(scheme, (kind)what, how)) continue;
    make(scheme, (kind)what, how);
    for (int i = 0; i < 240; i++) {
      if (how == HITCHES)
        sbr_world_step(s.world, i % 7 ? 0.001 + 0.03 * (i % 3) : 0.25);
      else
        scene_ticks(&s, 1);
      if (how == JUMPS && i % 20 == 0)
        sbr_character_teleport(s.world, s.character, (sbr_double3){i, 1000, -3 * i}, 0.3f * (float)i);
      sbr_body_health health = sbr_character_get_body_health(s.world, s.character, 0);
      ck_assert_msg(health.finite, "kind %d, tick %d", what, i);
      ck_assert_msg(health.recoveries == 0, "kind %d, tick %d", what, i);
      ck_assert_msg(!health.inverted, "kind %d, tick %d", what, i);
    }
    scene_free(&s);
    lattice_box_free(&box);
  }
}
END_TEST

int main(void) {
  Suite *suite = suite_create("hard_solids");
  TCase *c = tcase_create("hard_solids");
  tcase_add_loop_test(c, hard_cases_stay_stable, 0, SCHEME_COUNT * HARD_CASES);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
