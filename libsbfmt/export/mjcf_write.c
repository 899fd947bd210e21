/* Writes MuJoCo's MJCF: rigid bodies as a tree with joints, loops as equalities, soft bodies as flexes. */
#include <stdio.h>
#include <string.h>

#include "export/mjcf.h"

static void write_all(mjcf_writer *w, float step) {
  sbfi_text *text = &w->e->text;
  sbfi_text_string(text, "<?xml version=\"1.0\"?>\n<mujoco model=\"sbfmt\">\n"
                         "  <!-- Metres, kilograms, radians. Turned from +Y up to +Z up: (x, y, z) is "
                         "(x, -z, y) of the file it was made from. -->\n"
                         "  <compiler angle=\"radian\"/>\n  <option");
  sbfi_mjcf_write_f32(w, "timestep", step);
  sbfi_mjcf_write_vec3(w, "gravity", w->e->asset->environment.gravity);
  sbfi_text_string(text, "/>\n");
  sbfi_mjcf_write_meshes(w);
  sbfi_text_string(text, "  <worldbody>\n");
  sbfi_mjcf_write_bodies(w);
  sbfi_mjcf_write_holders_and_points(w);
  sbfi_text_string(text, "  </worldbody>\n");
}

static bool write_text(mjcf_writer *w) {
  float step;
  if (!sbfi_mjcf_collect_flexes(w) || !sbfi_mjcf_collect_contacts(w) || !sbfi_mjcf_collect_joints(w) ||
      !sbfi_mjcf_timestep(w, &step))
    return false;
  write_all(w, step);
  if (!sbfi_mjcf_write_flexes(w)) return false;
  sbfi_mjcf_write_constraints(w);
  sbfi_mjcf_write_excludes(w);
  sbfi_text_string(&w->e->text, "</mujoco>\n");
  return true;
}

sbf_status sbfi_export_mjcf(sbfi_export *e) {
  const sbf_asset *asset = e->asset;
  if (!asset->rigid_bodies.count && !asset->soft_bodies.count)
    return sbfi_diagnose(e->error, SBF_CODE_EXPORT_EMPTY,
        "the file has neither a rigid nor a soft body: there is nothing to write to %s", e->path);
  mjcf_writer w;
  memset(&w, 0, sizeof w);
  w.e = e;
  sbfi_arena_init(&w.scratch, &e->allocator, 0);
  bool written = write_text(&w);
  sbfi_arena_free(&w.scratch);
  if (!written) return sbfi_export_no_memory(e);
  const sbfi_left_out things[] = {
      {w.unsupported.without_level, "soft bodies without tetrahedra or springs (build makes them)"},
      {w.unsupported.goals, "goal springs"},
      {w.unsupported.moduli, "soft bodies whose elements differ (their mean is written)"},
      {w.unsupported.bending, "held sheets' bending"},
      {w.unsupported.ratios, "Poisson ratios outside 0 to 0.499"},
      {w.unsupported.massless, "moving bodies with a mass of 0"},
      {w.unsupported.velocities, "initial velocities"}, {w.unsupported.loops, "joints that close loops"},
      {w.unsupported.loop_bounds, "limits and drives of joints that close loops"},
      {w.unsupported.pulleys, "pulleys"}, {w.unsupported.soft_limits, "limits' springs"},
      {w.unsupported.drives, "speeds, limits and distances of drives"},
      {w.unsupported.breaking, "breaking loads"},
      {w.unsupported.touching, "contacts between bodies that a joint connects"},
      {w.unsupported.selves, "self-contacts of bodies made of springs"},
      {w.unsupported.sharing, "soft bodies whose contacts share collision bits"},
      {asset->cross_springs.count, "springs between bodies"}};
  sbfi_export_left_out(e, "MJCF", things, sizeof things / sizeof *things);
  const sbfi_left_out others[] = {{asset->render_meshes.count, "render meshes"},
      {asset->clips.count, "clips"}, {asset->gaits.count, "gaits"}, {asset->ik_chains.count, "IK chains"},
      {asset->environment.fields.count, "force fields"}};
  sbfi_export_left_out(e, "MJCF", others, sizeof others / sizeof *others);
  return sbfi_export_commit(e, e->path);
}
