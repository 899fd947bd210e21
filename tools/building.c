#include "building.h"

#include <inttypes.h>
#include <string.h>
#include <sys/stat.h>

#include "chart/out_folder.h"
#include "mesh_quality.h"
#include "section_budget.h"

/* In the order of sbf_build_interior, and an alias. */
static const char *const methods[] = {
    "automatic", "centroid", "none", "lattice", "brute", "tetrahedra", "shape_matching", "surface"};
enum { METHOD_COUNT = sizeof methods / sizeof *methods, SURFACE = METHOD_COUNT - 1 };

static bool read_options(const cli_call *call, sbf_build_options *options) {
  int method = SBF_BUILD_INTERIOR_AUTOMATIC;
  *options = (sbf_build_options){.user = NULL};
  long elements = 0, levels = 1, render_levels = 0;
  static const char *const cuts[] = {"auto", "none"}; /* as sbf_build_sections */
  int sections = SBF_BUILD_SECTIONS_AUTOMATIC;
  if (!cli_word(call, "--springs", methods, METHOD_COUNT, &method) ||
      !cli_number(call, "--cell", 1e-9, 1e9, &options->cell_m) ||
      !cli_integer(call, "--elements", 1, 100000000, &elements) ||
      !cli_word(call, "--sections", cuts, 2, &sections) ||
      !cli_number(call, "--overlap", 1e-9, 1e9, &options->overlap_m) ||
      !cli_number(call, "--error", 1e-9, 1e9, &options->error_m) ||
      !cli_integer(call, "--levels", 1, 8, &levels) ||
      !cli_integer(call, "--render-levels", 0, 8, &render_levels) ||
      !cli_number(call, "--render-error", 1e-9, 1e9, &options->render_error_m))
    return false;
  options->sections = (sbf_build_sections)sections;
  if (options->error_m > 0 && !cli_value(call, "--springs")) method = SBF_BUILD_INTERIOR_TETRAHEDRA;
  options->interior = method == SURFACE ? SBF_BUILD_INTERIOR_NONE : (sbf_build_interior)method;
  options->elements = (uint32_t)elements;
  options->levels = levels > 1 ? (uint32_t)levels : 0;
  options->render_levels = (uint32_t)render_levels;
  options->without_calibration = cli_switch(call, "--no-calibration");
  return true;
}

/* A build may take minutes, so unwritable outputs are reported before it starts. */
static bool has_position(const cli_call *call) {
  const char *out = cli_value(call, "-o");
  struct stat facts;
  sbf_diagnostic error;
  bool is_special = out && stat(out, &facts) == 0 && !S_ISREG(facts.st_mode) && !S_ISDIR(facts.st_mode);
  if (!out || is_special || chart_check_writable(out, &error) == SBF_OK) return true;
  cli_print_diagnostic(call, &error);
  return false;
}

bool building_check(const cli_call *call) {
  sbf_build_options options;
  return read_options(call, &options) && has_position(call);
}

static bool progress(void *user, const char *pass, double done) {
  (void)user;
  cli_progress(pass, done);
  return true;
}

static const float LEFT_OVER = 0.25f;

static void print_lattices(const sbf_build_lattices *all) {
  printf("tetrahedra: %u, %.4g m^3, dihedral angles %.1f to %.1f degrees, vertices within %.3g m",
      all->tetrahedra, all->volume, all->min_dihedral_deg, all->max_dihedral_deg, all->farthest_m);
  if (all->thickened_points)
    printf(", %u point%s thin parts", all->thickened_points,
        all->thickened_points == 1 ? " thickens" : "s thicken");
  printf("\n");
}

/* Prints sections whose springs differ from their material's compliance by more than a quarter. */
static void print_left_over(const sbf_asset *built) {
  for (uint32_t i = 0; i < built->soft_bodies.count; i++) {
    const sbf_soft_body *body = &built->soft_bodies.at[i];
    const sbf_level *level = body->levels.count ? &body->levels.at[0] : NULL;
    if (!level || level->model != SBF_ELASTIC_MODEL_SPRINGS || !level->calibration) continue;
    if (!(level->calibration->residual > LEFT_OVER)) continue;
    printf("  %s: displacement error of up to %.0f %%, %.2g m\n", body->name,
        100 * (double)level->calibration->residual, (double)level->simulation.error);
  }
}

static const char *many(uint32_t count) {
  return count == 1 ? "" : "s";
}

/* Prints bodies whose finest level is authored, not built. */
static void print_preserved(const sbf_asset *built) {
  uint32_t bodies = 0;
  uint64_t tetrahedra = 0, springs = 0;
  for (uint32_t i = 0; i < built->soft_bodies.count; i++) {
    const sbf_soft_body *body = &built->soft_bodies.at[i];
    if (body->levels.count == 0 || body->levels.at[0].derived != SBF_NONE) continue;
    const sbf_level *level = &body->levels.at[0];
    bodies++;
    tetrahedra += level->lattice.tetrahedra.count;
    for (uint32_t k = 0; k < level->springs.count; k++) springs += level->springs.at[k].ends.count;
  }
  if (bodies == 0) return;
  printf("kept %u bod%s as authored:", bodies, bodies == 1 ? "y" : "ies");
  if (tetrahedra) printf(" %" PRIu64 " tetrahedr%s", tetrahedra, tetrahedra == 1 ? "on" : "a");
  if (springs) printf("%s %" PRIu64 " springs", tetrahedra ? "," : "", springs);
  printf("\n");
}

static void print_springs(const sbf_build_report *r) {
  uint32_t count = r->inert_springs;
  for (int k = 0; k < SBF_SPRING_KIND_COUNT; k++) count += r->springs[k];
  if (count == 0) return;
  printf("springs: %u structural, %u shear, %u flexion, %u internal", r->springs[SBF_SPRING_KIND_STRUCTURAL],
      r->springs[SBF_SPRING_KIND_SHEAR], r->springs[SBF_SPRING_KIND_FLEXION],
      r->springs[SBF_SPRING_KIND_INTERNAL] + r->inert_springs);
  if (r->inert_springs)
    printf(" (%u of them would join two pinned points and were left out)", r->inert_springs);
  printf("\n");
}

void building_print(const sbf_asset *built, const sbf_build_report *r) {
  mesh_quality quality;
  if (r->sections) printf("cut %u section%s along the bones\n", r->sections, many(r->sections));
  print_preserved(built);
  if (r->bodies || built->soft_bodies.count == 0)
    printf("built %u bod%s: %u interior points, %u pins, %u hull%s, %u embedded vertices\n", r->bodies,
        r->bodies == 1 ? "y" : "ies", r->interior_points, r->pins, r->hulls, many(r->hulls),
        r->embedded_vertices);
  else
    printf("%u embedded vertices\n", r->embedded_vertices);
  if (r->lattices.tetrahedra) print_lattices(&r->lattices);
  if (r->lattice_calibration.count)
    printf("calibrated %u lattice%s: modulus times %.3g to %.3g, displacement within %.3g %% of the "
           "reference under every load, frequency within %.3g %%\n",
        r->lattice_calibration.count, many(r->lattice_calibration.count), r->lattice_calibration.min_factor,
        r->lattice_calibration.max_factor, 100 * r->lattice_calibration.max_residual,
        100 * r->lattice_calibration.max_period_error);
  if (r->spring_calibration.count)
    printf("calibrated the springs of %u level%s: stiffness times %.3g to %.3g, surfaces within %.3g %% of "
           "those of tetrahedra\n",
        r->spring_calibration.count, many(r->spring_calibration.count), r->spring_calibration.min_factor,
        r->spring_calibration.max_factor, 100 * r->spring_calibration.max_residual);
  print_left_over(built);
  if (r->levels) printf("levels: %u coarser than the finest\n", r->levels);
  if (r->render_levels) printf("render levels: %u coarser than the full meshes\n", r->render_levels);
  print_springs(r);
  mesh_quality_measure(built, NULL, &quality);
  mesh_quality_print(&quality);
}

/* Prints what was chosen within a budget and what was left out. */
static void print_choice(const cli_call *call, const section_budget *choice) {
  sbf_diagnostic diagnostic = {
      .code = SBF_CODE_SOFTNESS_PROPOSED, .severity = SBF_SEVERITY_INFO, .offset = -1, .index = -1};
  const double us = SECTION_BUDGET_NS_PER_VISIT / 1e3;
  char off[96] = "", left[320] = "", firmer[96] = "";
  if (choice->p99_fraction >= 0)
    snprintf(off, sizeof off, "99 of 100 skin vertices within %.2g %% of the size of the result with %u, ",
        100 * choice->p99_fraction, (unsigned)choice->finest);
  if (choice->firmer > 1)
    snprintf(firmer, sizeof firmer,
        " and moduli %.2g times the proposed, because softer parts are less close", choice->firmer);
  if (choice->left_out)
    snprintf(left, sizeof left, "; rigid to keep the budget: %u of the smallest parts (%s)",
        (unsigned)choice->left_out, choice->names);
  size_t length = strlen(left);
  if (choice->visits > choice->max_visits)
    snprintf(left + length, sizeof left - length,
        choice->soft ? "; the requested parts cost more: request fewer, or use --budget none"
                     : "; skin and gait alone cost more");
  else if (choice->exceeds)
    snprintf(left + length, sizeof left - length,
        "; the skin's vertices alone cost %.0f us, so soft parts have a quarter of the budget",
        us * choice->skin_visits);
  snprintf(diagnostic.message, sizeof diagnostic.message,
      "sections follow lattices of about %u tetrahedra%s: %s%.0f element visits a tick of at most %.0f (%.0f "
      "us of "
      "%.0f at %.0f ns each)%s",
      (unsigned)choice->elements, firmer, off, choice->visits, choice->max_visits, us * choice->visits,
      us * choice->max_visits, SECTION_BUDGET_NS_PER_VISIT, left);
  cli_progress_end();
  cli_print_diagnostic(call, &diagnostic);
}

sbf_status building_choose(
    cli_call *call, sbf_asset *source, double budget_us, bool may_stiffen, sbf_diagnostic *error) {
  sbf_build_options options;
  section_budget choice;
  if (!read_options(call, &options)) return SBF_FAILED;
  if (!(budget_us > 0) || !section_budget_applies(source, &options)) return SBF_OK;
  cli_progress("budget", 0);
  sbf_status status = section_budget_choose(source, &options, budget_us, may_stiffen, &choice, error);
  if (status == SBF_OK && choice.elements) print_choice(call, &choice);
  cli_progress_end();
  return status;
}

sbf_status building_run(cli_call *call, sbf_asset **asset, sbf_build_report *made, sbf_diagnostic *error) {
  sbf_build_options options;
  sbf_asset *built = NULL;
  if (!read_options(call, &options)) return SBF_FAILED;
  options.progress = progress;
  options.report = cli_report;
  options.user = call;
  sbf_status status = sbf_build(*asset, &options, &built, made, error);
  if (status == SBF_OK) section_budget_state_costs(built);
  cli_print_counted(call);
  cli_progress_end();
  sbf_asset_free(*asset);
  *asset = built;
  return status;
}
