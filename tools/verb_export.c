/* sbfmt export: converts bundles to other formats, at rest or in motion. */
#include <stdio.h>
#include <string.h>

#include "motion_bake.h"
#include "motion_cache.h"
#include "output_name.h"
#include "sbfmt/io.h"

static void report(void *user, const sbf_diagnostic *diagnostic) {
  cli_print_diagnostic(user, diagnostic);
}

/* The input's folder, to which its images are relative. */
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

/* First given option of a motion; NULL if there is none. */
static const char *given_of_motion(const cli_call *call) {
  for (int i = 0; call->verb->options[i].name; i++) {
    const char *name = call->verb->options[i].name;
    if (call->values[i] && strcmp(name, "-o") != 0 && strcmp(name, "--render-level") != 0) return name;
  }
  return NULL;
}

static int run(cli_call *call) {
  const char *out = cli_value(call, "-o");
  char folder[4096];
  long render_level = 0;
  sbf_export_motion motion = {0};
  if (!out)
    return cli_wrong(call, "state the output: -o OUT.glb, OUT.html, OUT.obj, OUT.tet, OUT.mjcf, OUT.usda, "
                           "OUT.xml, OUT.csv or OUT.pc2");
  static const char *const endings[] = {".glb", ".html", ".obj", ".tet", ".node", ".ele", ".msh", ".vtu",
      ".mjcf", ".usda", ".xml", ".csv", ".json", ".pc2", ".mdd", NULL};
  if (!output_name_check(call, "-o", endings) || !cli_integer(call, "--render-level", 0, 1000, &render_level))
    return SBF_FAILED;
  bool as_cache = motion_cache_named(out), moves = motion_asked(call) || as_cache;
  const char *of_motion = given_of_motion(call);
  if (of_motion && !as_cache && !ends_with(out, ".glb"))
    return cli_wrong(call, "only .glb, .pc2 and .mdd contain a motion: leave out %s for %s", of_motion, out);
  if (of_motion && !moves)
    return cli_wrong(call, "%s is for a motion, which %s contains only with --seconds, --script or --replay",
        of_motion, out);
  int status = moves ? motion_bake(call, &motion) : SBF_OK;
  if (status != SBF_OK) return status;
  sbf_asset *asset;
  sbf_diagnostic error;
  status = (int)sbf_load_file(call->inputs[0],
      &(sbf_load_options){.report = cli_report, .user = call, .with_images = true}, &asset, &error);
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
        "output file; the ending selects the format"},
    {"--render-level", "N", "level of the meshes, 0 the full ones (0); where there are fewer, the last"},
    SESSION_OPTIONS("length of the motion (.pc2 and .mdd 5, .glb none)", "frames a second (30)"),
    {NULL, NULL, NULL},
};
const cli_verb verb_export = {"export",
    "FILE -o OUT.glb|.html|.obj|.tet|.node|.msh|.vtu|.mjcf|.usda|.xml|.csv|.json|.pc2|.mdd [--seconds S ...]",
    "write files for other programs",
    "The ending of OUT selects the format.\n\n"
    ".glb: meshes with skin, joints, materials, shape keys and clips as binary glTF. With\n"
    "--seconds, --script or --replay it also holds the motion that `run` would show, 30\n"
    "frames a second unless --fps is given: joints are animated, and the motion of soft\n"
    "bodies is one morph target a frame. .obj: meshes at rest, with an MTL. .tet (PhysX),\n"
    ".node and .ele (TetGen), .msh (Gmsh), .vtu (VTK): tetrahedra. .mjcf: soft and rigid\n"
    "bodies with joints for MuJoCo, +Z up. .xml: the same in the 2012 dialect. .usda: all of\n"
    "these as USD text.\n\n"
    ".html: a page with the character and the runtime as WebAssembly, which works without a\n"
    "network: walk it, drag it, throw balls at it. .csv, .json: skin weights, one row per\n"
    "vertex and bone, for `convert --weights`. .pc2, .mdd: the motion as a point cache of the\n"
    "skin, one sample a frame, 5 seconds unless --seconds is given.\n\n"
    "Content that a format cannot hold is reported.",
    options, 1, 1, run};
