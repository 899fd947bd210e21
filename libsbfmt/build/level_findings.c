#include "build/level_findings.h"

static void report_poor_level(sbfi_build *b, uint32_t number, const sbfi_poor_level *level) {
  const char *name = b->bodies[number].name;
  if (level->load_error > 0)
    sbfi_build_report_of_body(b, number, SBF_CODE_LEVEL_OFF,
        "a level with %u tetrahedra of soft body \"%s\" has a displacement error of %.0f %% under one of the "
        "loads: %s; use more elements (--elements, --cell)",
        (unsigned)level->elements, name, 100 * level->load_error,
        level->is_kept ? "the file states each error" : "it is left out");
  else
    sbfi_build_report_of_body(b, number, SBF_CODE_LEVEL_UNSETTLED,
        "a level with %u tetrahedra of soft body \"%s\" does not come to rest under gravity, but a fine "
        "level does: %s; use more elements (--elements, --cell) or pin more points",
        (unsigned)level->elements, name, level->is_kept ? "its error is not stated" : "it is left out");
}

void sbfi_level_findings_report(sbfi_build *b, uint32_t number, const sbfi_level_findings *of) {
  const char *name = b->bodies[number].name;
  if (of->missed_elements > 0)
    sbfi_build_report_of_body(b, number, SBF_CODE_LEVEL_ERROR_MISSED,
        "no lattice of soft body \"%s\" with fewer than %u tetrahedra has an error below %.4g m: the body "
        "uses that many",
        name, (unsigned)of->missed_elements, b->options.error_m);
  /* Tips and rims are always thin: a few such points are no thin limb. */
  if (of->thinness.thin_count > of->thinness.sample_count / 50)
    sbfi_build_report_of_body(b, number, SBF_CODE_LATTICE_THIN,
        "at %u of %u sampled points, soft body \"%s\" is thinner than two elements, at the thinnest %.4g m "
        "with a cell of %.4g m: use a smaller cell or more elements (--cell, --elements)",
        (unsigned)of->thinness.thin_count, (unsigned)of->thinness.sample_count, name, of->thinness.min,
        of->cell);
  if (of->can_rotate)
    sbfi_build_report_of_body(b, number, SBF_CODE_LEVEL_UNSETTLED,
        "soft body \"%s\", or a piece of it, is pinned only at points on one line and can rotate about it: "
        "it is not calibrated and no error is stated; pin points off that line",
        name);
  for (uint32_t i = 0; i < of->poor_count; i++) report_poor_level(b, number, &of->poor[i]);
}

void sbfi_level_counts_repeat(
    sbf_build_report *report, const sbf_build_report *before, const sbf_build_report *after) {
  report->bodies += after->bodies - before->bodies;
  report->levels += after->levels - before->levels;
  report->lattices.tetrahedra += after->lattices.tetrahedra - before->lattices.tetrahedra;
  report->lattices.thickened_points += after->lattices.thickened_points - before->lattices.thickened_points;
  report->lattices.volume += after->lattices.volume - before->lattices.volume;
  report->lattice_calibration.count += after->lattice_calibration.count - before->lattice_calibration.count;
  report->spring_calibration.count += after->spring_calibration.count - before->spring_calibration.count;
  for (int i = 0; i < SBF_DIHEDRAL_BINS; i++)
    report->lattices.dihedrals[i] += after->lattices.dihedrals[i] - before->lattices.dihedrals[i];
}
