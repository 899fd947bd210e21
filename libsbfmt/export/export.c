/* Selects the writer by the file's extension. */
#include <string.h>

#include "export/exporting.h"
#include "model/options.h"

static const struct {
  const char *ending;
  sbf_status (*write)(sbfi_export *e);
} forms[] = {{".xml", sbfi_export_paper}, {".glb", sbfi_export_glb}, {".html", sbfi_export_html},
    {".obj", sbfi_export_obj}, {".tet", sbfi_export_tet}, {".node", sbfi_export_tetgen},
    {".ele", sbfi_export_tetgen}, {".msh", sbfi_export_msh}, {".vtu", sbfi_export_vtu},
    {".mjcf", sbfi_export_mjcf}, {".usda", sbfi_export_usda}, {".csv", sbfi_export_weights_csv},
    {".json", sbfi_export_weights_json}};

sbf_status sbf_export(
    const sbf_asset *asset, const char *path, const sbf_export_options *options, sbf_diagnostic *error) {
  sbf_export_options taken = {0};
  if (!sbfi_options_copy(&taken, sizeof taken, options))
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
        "sbf_export_options has a size that no version of the library had: initialize it with the defaults");
  options = &taken;
  const char *ending = strrchr(path, '.');
  for (size_t i = 0; i < sizeof forms / sizeof *forms; i++) {
    if (!ending || strcmp(ending, forms[i].ending) != 0) continue;
    sbfi_export e = {.asset = asset,
        .path = path,
        .allocator = sbfi_allocator_or_default(options->allocator),
        .reporter = {options->report, options->user, 0, 0},
        .render_level = options->render_level,
        .folder = options->folder,
        .images = options->images,
        .motion = options->motion && options->motion->frame_count ? options->motion : NULL,
        .soft_bodies = options->soft_bodies,
        .store = options->store,
        .compression = options->compression ? options->compression : 6,
        .error = error};
    sbfi_text_init(&e.text, &e.allocator);
    sbf_status status = forms[i].write(&e);
    sbfi_text_free(&e.text);
    return status;
  }
  return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
      "%s: the ending selects the format; use .glb, .html, .obj, .tet, .node, .msh, .vtu, .mjcf, .usda, .xml "
      "(the 2012 dialect), .csv or .json (skin weights)",
      path);
}
