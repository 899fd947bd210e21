#include "import/convert/convert_summary.h"

static void summarize_scene(const sbfi_scene *scene, sbf_convert_source *to) {
  sbfi_copy_text(to->form, sizeof to->form, scene->format ? scene->format : "");
  sbfi_copy_text(to->generator, sizeof to->generator, scene->generator ? scene->generator : "");
  to->unit_m = scene->unit_m;
  to->unit_stated = scene->unit_known;
  to->axes_stated = scene->axes_known;
  to->objects = scene->mesh_count;
  for (uint32_t i = 0; i < scene->mesh_count; i++) {
    const sbfi_scene_mesh *mesh = &scene->meshes[i];
    to->vertices += mesh->vertex_count ? mesh->vertex_count : mesh->point_count;
    to->points += mesh->point_count;
    to->polygons += mesh->polygon_count;
  }
  to->bones = sbfi_scene_bone_count(scene);
  to->materials = scene->material_count;
  to->images = scene->image_count;
  to->clips = scene->clip_count;
}

static void summarize_tets(const sbfi_tet_mesh *tets, sbf_convert_source *to) {
  sbfi_copy_text(to->form, sizeof to->form, tets->format);
  to->vertices = to->points = (uint32_t)tets->points.count;
  to->tetrahedra = (uint32_t)tets->tetrahedra.count;
}

void sbfi_summarize(sbfi_conversion *c, const sbfi_tet_mesh *tets, const sbfi_paper_model *paper,
    const sbf_convert_options *options) {
  sbf_convert_summary *s = options->summary;
  if (!s) return;
  *s = (sbf_convert_summary){.source_count = 1};
  sbf_convert_source *first = &s->sources[0];
  summarize_scene(c->scene, first);
  if (tets) summarize_tets(tets, first);
  if (paper) {
    sbfi_copy_text(first->form, sizeof first->form, "2012 dialect");
    first->objects = (uint32_t)(paper->soft_bodies.count + paper->rigid_bodies.count);
    first->unit_stated = first->axes_stated = true; /* the dialect defines metres and +Y up */
  }
  if (options->unit_m > 0) first->unit_m = options->unit_m;
  if (c->rig && c->rig != c->scene) summarize_scene(c->rig, &s->sources[s->source_count++]);
}
