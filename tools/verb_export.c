/* sbfmt export: bundles to foreign files, at rest or in motion. */
#include <stdio.h>
#include <string.h>

#include "motion_bake.h"
#include "motion_cache.h"
#include "output_name.h"
#include "sbfmt/io.h"

static void report(void *user, const sbf_diagnostic *diagnostic) {
  cli_print_diagnostic(user, diagnostic);
}

/* The input's folder, which its images are relative to. */
static const char *folder_of(const char *path, char *to, size_t size) {
  const char *slash = strrchr(path, '/');
  int length = slash ? snprintf(to, size, "%.*s", slash == path ? 1 : (int)(slash - path), path)
                     : snprintf(to, size, ".");
  return length > 0 && (size_t)length < size ? to : NULL;
}

static bool ends_with(const char *path, const char *ending) {
  const char *point = strrchr(path, '.');
  return point && strcmp(point, ending) == 0;
}

static int run(cli_call *call) {
  const char *out = cli_value(call, "-o");
  char folder[4096];
  long render_level = 0;
  sbf_export_motion motion = {0};
  if (!out)
    return cli_wrong(call,
        "say where to write: -o OUT.glb, OUT.html, OUT.obj, OUT.tet, OUT.mjcf, OUT.usda, OUT.xml, OUT.csv "
        "or OUT.pc2");
  static const char *const endings[] = {".glb", ".html", ".obj", ".tet", ".node", ".ele", ".msh", ".vtu",
      ".mjcf", ".usda", ".xml", ".csv", ".json", ".pc2", ".mdd", NULL};
  if (!output_name_check(call, "-o", endings) || !cli_integer(call, "--render-level", 0, 1000, &render_level))
    return SBF_FAILED;
  bool as_cache = motion_cache_named(out), moves = motion_asked(call) || as_cache;
  if (moves && !as_cache && !ends_with(out, ".glb"))
    return cli_wrong(call,
        "only .glb, .pc2 and .mdd hold a motion: leave --seconds, --script and --replay out for %s", out);
  int status = moves ? motion_bake(call, &motion) : SBF_OK;
  if (status != SBF_OK) return status;
  sbf_asset *asset;
  sbf_diagnostic error;
  status = (int)sbf_load_file(
      call->inputs[0], &(sbf_load_options){.report = cli_report, .user = call}, &asset, &error);
  if (status == SBF_OK) {
    const sbf_export_options options = {.report = report,
        .user = call,
        .render_level = (uint32_t)render_level,
        .folder = folder_of(call->inputs[0], folder, sizeof folder),
        .motion = &motion};
    status = (int)(as_cache ? motion_cache_write(call, out, asset, &motion, &error)
                            : sbf_export(asset, out, &options, &error));
    sbf_asset_free(asset);
  }
  motion_free(&motion);
  if (status != SBF_OK) cli_print_diagnostic(call, &error);
  return status;
}

static const cli_option options[] = {
    {"-o", "OUT.glb|.html|.obj|.tet|.node|.msh|.vtu|.mjcf|.usda|.xml|.csv|.json|.pc2|.mdd",
        "where to write; the ending says in which form"},
    {"--render-level", "N", "level of the meshes, 0 the full ones (0); where there are fewer, the last"},
    SESSION_OPTIONS("how much of the motion (.pc2 and .mdd 5, .glb none)", "frames a second (30)"),
    {NULL, NULL, NULL},
};
const cli_verb verb_export = {"export",
    "FILE -o OUT.glb|.html|.obj|.tet|.node|.msh|.vtu|.mjcf|.usda|.xml|.csv|.json|.pc2|.mdd [--seconds S ...]",
    "write what other programs read",
    "Writes meshes with skin, joints, materials, shape keys and clips as binary glTF, .glb;\n"
    "meshes at rest as OBJ with its MTL; tetrahedra as PhysX's .tet, TetGen's .node and .ele,\n"
    "Gmsh's .msh or VTK's .vtu; or soft and rigid bodies with their joints as MuJoCo's\n"
    ".mjcf, +Z up, or in the 2012 dialect, .xml; all of these together as USD's text, .usda. A page, .html, "
    "holds the character with the runtime as "
    "WebAssembly, to be\n"
    "opened without a network: it walks, can be dragged and have balls thrown at it.\n"
    "A .csv or .json holds the weights of the skins, a row for each vertex and bone, for `convert "
    "--weights`.\n"
    "Says what the form has no place for. With --seconds, --script or --replay\n"
    "a .glb also holds the motion that `run` would show, 30 frames a second unless --fps says\n"
    "otherwise: joints that move, and what the flesh does beside them as a morph target a frame.\n"
    "A .pc2 or .mdd is that motion alone, 5 seconds unless said otherwise: places of the skin's points, a "
    "sample a frame.",
    options, 1, 1, run};
