/* PhysX's .tet, as read by import/tetrahedra/physx_tet.c: `v x y z`, `t a b c d` from 0. */
#include "export/exporting.h"

sbf_status sbfi_export_tet(sbfi_export *e) {
  const sbf_asset *asset = e->asset;
  uint32_t first = 0, written = 0;
  sbfi_text_string(&e->text, "# tetrahedra of sbfmt: metres, +Y up\n");
  for (uint32_t b = 0; b < asset->soft_bodies.count; b++) {
    const sbf_level *level = sbfi_export_lattice(&asset->soft_bodies.at[b]);
    if (!level) continue;
    for (uint32_t i = 0; i < level->positions.count; i++) {
      sbfi_text_char(&e->text, 'v');
      sbfi_export_vec3(e, level->positions.at[i]);
      sbfi_text_char(&e->text, '\n');
    }
    for (uint32_t i = 0; i < level->lattice.tetrahedra.count; i++) {
      const uint32_t *p = level->lattice.tetrahedra.at[i].at;
      sbfi_export_format(e, "t %u %u %u %u\n", first + p[0], first + p[1], first + p[2], first + p[3]);
    }
    first += level->positions.count;
    written++;
  }
  if (!written)
    return sbfi_diagnose(e->error, SBF_CODE_EXPORT_EMPTY,
        "no soft body has a level of tetrahedra: there is nothing to write to %s", e->path);
  const sbfi_left_out things[] = {{asset->soft_bodies.count - written, "soft bodies without tetrahedra"},
      {asset->render_meshes.count, "render meshes"}, {asset->bones.count, "bones"},
      {asset->rigid_bodies.count, "rigid bodies"}, {asset->joints.count, "joints"},
      {asset->gaits.count, "gaits"}, {asset->clips.count, "clips"}};
  sbfi_export_left_out(e, ".tet", things, sizeof things / sizeof *things);
  return sbfi_export_commit(e, e->path);
}
