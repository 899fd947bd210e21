#include "building.h"

#include "sbfmt/build.h"

static const char *const methods[] = {"automatic", "centroid", "none"}; /* as sbf_build_interior */

static bool read_options(const cli_call *call, sbf_build_options *options) {
  int method = SBF_BUILD_INTERIOR_AUTOMATIC;
  *options = (sbf_build_options){.user = NULL};
  if (!cli_word(call, "--springs", methods, 3, &method)) return false;
  options->interior = (sbf_build_interior)method;
  return true;
}

bool building_check(const cli_call *call) {
  sbf_build_options options;
  return read_options(call, &options);
}

static bool progress(void *user, const char *pass, double done) {
  (void)user;
  cli_progress(pass, done);
  return true;
}

static void report(void *user, const sbf_diagnostic *diagnostic) {
  cli_print_diagnostic(user, diagnostic);
}

static void print_report(const sbf_build_report *r) {
  printf("built %u bodies: %u interior points, %u pins, %u hulls, %u embedded vertices\n", r->bodies,
      r->interior_points, r->pins, r->hulls, r->embedded_vertices);
  printf("springs: %u structural, %u shear, %u flexion, %u internal", r->springs[SBF_SPRING_KIND_STRUCTURAL],
      r->springs[SBF_SPRING_KIND_SHEAR], r->springs[SBF_SPRING_KIND_FLEXION],
      r->springs[SBF_SPRING_KIND_INTERNAL] + r->inert_springs);
  if (r->inert_springs) printf(" (%u of them join two pinned points and were left out)", r->inert_springs);
  printf("\n");
}

sbf_status building_run(cli_call *call, sbf_asset **asset, sbf_diagnostic *error) {
  sbf_build_options options;
  sbf_build_report made;
  sbf_asset *built = NULL;
  if (!read_options(call, &options)) return SBF_FAILED;
  options.progress = progress;
  options.report = report;
  options.user = call;
  sbf_status status = sbf_build(*asset, &options, &built, &made, error);
  cli_progress_end();
  sbf_asset_free(*asset);
  *asset = built;
  if (status == SBF_OK) print_report(&made);
  return status;
}
