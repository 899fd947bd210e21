#include "build/level_findings.h"

static void report_poor_level(sbfi_build *b, uint32_t number, const sbfi_poor_level *level) {
  const char *name = b->bodies[number].name;
  if (level->load_error > 0)
    sbfi_build_report_of_body(b, number, SBF_CODE_LEVEL_OFF,
        "a level of %u tetrahedra of soft body \"%s\" is off by %.0f %% of what its matter gives under one "
        "of the loads: %s, give it more elements (--elements, --cell)",
        (unsigned)level->elements, name, 100 * level->load_error,
        level->is_kept ? "the file states each" : "it is left out");
  else
    sbfi_build_report_of_body(b, number, SBF_CODE_LEVEL_UNSETTLED,
        "a level of %u tetrahedra of soft body \"%s\" comes to no rest under gravity where a fine one does: "
        "%s, give it more elements (--elements, --cell) or pin more points",
        (unsigned)level->elements, name, level->is_kept ? "its error is not stated" : "it is left out");
}

void sbfi_level_findings_report(sbfi_build *b, uint32_t number, const sbfi_level_findings *of) {
  const char *name = b->bodies[number].name;
  if (of->missed_elements > 0)
    sbfi_build_report_of_body(b, number, SBF_CODE_LEVEL_ERROR_MISSED,
        "no lattice of soft body \"%s\" coarser than %u tetrahedra comes within %.4g m: it gets so many",
        name, (unsigned)of->missed_elements, b->options.error_m);
  /* Tips and rims are always thin: a few such points are no thin limb. */
  if (of->thinness.thin_count > of->thinness.sample_count / 50)
    sbfi_build_report_of_body(b, number, SBF_CODE_LATTICE_THIN,
        "%u of %u points looked at on soft body \"%s\" stand on matter thinner than two elements, the "
        "thinnest %.4g m at a cell of %.4g m: a smaller cell (--cell, --elements) gives it more",
        (unsigned)of->thinness.thin_count, (unsigned)of->thinness.sample_count, name, of->thinness.min,
        of->cell);
  if (of->can_rotate)
    sbfi_build_report_of_body(b, number, SBF_CODE_LEVEL_UNSETTLED,
        "soft body \"%s\", or a piece of it, is held at points of one line alone and turns about them: "
        "nothing is calibrated and no error stated, pin points beside that line",
        name);
  for (uint32_t i = 0; i < of->poor_count; i++) report_poor_level(b, number, &of->poor[i]);
}

void sbfi_level_counts_repeat(
    sbf_build_report *report, const sbf_build_report *before, const sbf_build_report *after) {
  report->bodies += after->bodies - before->bodies;
  report->levels += after->levels - before->levels;
  report->tetrahedra += after->tetrahedra - before->tetrahedra;
  report->thickened_points += after->thickened_points - before->thickened_points;
  report->lattice_volume += after->lattice_volume - before->lattice_volume;
  report->calibrated += after->calibrated - before->calibrated;
  report->calibrated_springs += after->calibrated_springs - before->calibrated_springs;
  for (int i = 0; i < SBF_DIHEDRAL_BINS; i++)
    report->dihedrals[i] += after->dihedrals[i] - before->dihedrals[i];
}
