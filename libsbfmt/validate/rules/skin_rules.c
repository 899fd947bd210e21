/* Checks skins: weights sum to one, no duplicate bones at a point, no point without weights. */
#include <math.h>

#include "validate/validation.h"

static void check_skin(sbfi_validation *v, const sbf_render_mesh *mesh, const char *path) {
  const sbf_skin *skin = mesh->skin;
  sbfi_path counts = sbfi_path_of("%s/influence_counts", path), weights = sbfi_path_of("%s/weights", path),
            bones = sbfi_path_of("%s/bones", path);
  uint32_t *last = sbfi_scratch(
      v, v->asset->bones.count, sizeof *last); /* number from 1 of the last point with the bone */
  uint32_t unweighted = 0, first = 0;
  if (!last) return;
  for (uint32_t i = 0, at = 0; i < skin->influence_counts.count; i++) {
    uint32_t count = skin->influence_counts.at[i], begin = at;
    double sum = 0;
    if (count == 0 && unweighted++ == 0) first = i;
    for (; at < begin + count; at++) {
      sum += (double)skin->weights.at[at];
      if (last[skin->bones.at[at]] == i + 1)
        sbfi_found(v, SBF_CODE_SKIN_BONE_REPEATED, bones.text, at,
            "point %u of '%s' names the bone '%s' twice", i, sbfi_label(mesh->name, mesh->id),
            sbfi_bone_label(v->asset, skin->bones.at[at]));
      last[skin->bones.at[at]] = i + 1;
    }
    if (count && fabs(sum - 1) > 1e-3)
      sbfi_found(v, SBF_CODE_SKIN_SUM, weights.text, begin,
          "the skin weights of point %u of '%s' sum to %.6g", i, sbfi_label(mesh->name, mesh->id), sum);
  }
  if (unweighted)
    sbfi_found(v, SBF_CODE_RIG_UNWEIGHTED_POINTS, counts.text, first, "%u point%s of '%s' %s no weights",
        unweighted, sbfi_plural(unweighted), sbfi_label(mesh->name, mesh->id),
        unweighted == 1 ? "has" : "have");
}

void sbfi_check_skins(sbfi_validation *v) {
  for (uint32_t m = 0; m < v->asset->render_meshes.count && !v->out_of_memory; m++)
    if (v->asset->render_meshes.at[m].skin)
      check_skin(v, &v->asset->render_meshes.at[m], sbfi_path_of("/sbf/render_mesh[%u]/skin", m + 1).text);
}
