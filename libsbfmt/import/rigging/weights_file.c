/* Reads weights from a file. A vertex is a line `v` of an OBJ, from 0. For other files it is a point,
 * counted over the objects in order, as in the OBJ that `sbfmt export` writes. */
#include <string.h>

#include "base/file.h"
#include "base/suggest.h"
#include "import/quote.h"
#include "import/rigging/weigh.h"
#include "import/rigging/weights_rows.h"

/* Point of each vertex + 1; 0 for none. */
static uint32_t *points_of_vertices(const sbfi_rigging *r, uint32_t *vertex_count) {
  const sbfi_scene *scene = r->input.scene;
  bool is_obj = strcmp(scene->format, "obj") == 0;
  *vertex_count = r->input.mesh.positions.count;
  for (uint32_t m = 0; is_obj && m < scene->mesh_count; m++)
    for (uint32_t i = 0; i < scene->meshes[m].point_count; i++)
      if (scene->meshes[m].point_sources[i] >= *vertex_count)
        *vertex_count = scene->meshes[m].point_sources[i] + 1;
  uint32_t *points = sbfi_arena_allocate(&r->c->scratch, (size_t)*vertex_count + 1, sizeof *points);
  for (uint32_t m = 0; points && m < scene->mesh_count; m++)
    for (uint32_t i = 0; i < scene->meshes[m].point_count; i++) {
      uint32_t point = r->input.mesh_starts[m] + i;
      points[is_obj ? scene->meshes[m].point_sources[i] : point] = point + 1;
    }
  return points;
}

static sbf_status unknown_bone(sbfi_rigging *r, sbfi_weights_rows *rows, const sbfi_weights_row *row) {
  sbfi_suggestion near = sbfi_suggestion_for(sbfi_span_of(row->bone));
  const sbf_bone_list *bones = &r->c->asset->bones;
  for (uint32_t b = 0; b < bones->count; b++) sbfi_suggestion_consider(&near, bones->at[b].name);
  return sbfi_weights_rows_fail(rows, row->line, "no bone of %s has the name '%s'%s", r->rig.scene->file,
      sbfi_quote_of(sbfi_span_of(row->bone)).text, sbfi_suggestion_text_of(&near).at);
}

static sbf_status apply_row(sbfi_rigging *r, sbfi_weights_rows *rows, const sbfi_weights_row *row,
    const uint32_t *points, uint32_t vertex_count) {
  const sbf_bone_list *bones = &r->c->asset->bones;
  uint32_t bone = 0;
  while (bone < bones->count && strcmp(bones->at[bone].name, row->bone) != 0) bone++;
  if (bone == bones->count) return unknown_bone(r, rows, row);
  if (row->vertex >= vertex_count || !points[row->vertex])
    return sbfi_weights_rows_fail(rows, row->line,
        "%s has no vertex %u in a polygon: they are counted from 0, and the last one is %u",
        r->input.scene->file, row->vertex, vertex_count - 1);
  uint32_t point = points[row->vertex] - 1;
  sbfi_influences_add(&r->weights[point], r->c->node_of_bone[bone], (double)row->weight);
  if (row->weight > 0) r->sources[point] = SBFI_WEIGHTS_FROM_FILE;
  return SBF_OK;
}

static sbf_status apply_rows(sbfi_rigging *r, sbfi_weights_rows *rows) {
  const sbf_bone_list *bones = &r->c->asset->bones;
  uint32_t vertex_count, given = 0;
  const uint32_t *points = points_of_vertices(r, &vertex_count);
  const sbfi_weights_row *at = rows->rows.at;
  if (!points) return sbfi_convert_no_memory(r->c);
  for (size_t i = 0; i < rows->rows.count; i++) {
    sbf_status status = apply_row(r, rows, &at[i], points, vertex_count);
    if (status != SBF_OK) return status;
  }
  for (uint32_t i = 0; i < r->input.mesh.positions.count; i++) {
    sbfi_influences_finish(&r->weights[i]);
    given += r->sources[i] == SBFI_WEIGHTS_FROM_FILE;
  }
  if (given && given < r->input.mesh.positions.count)
    sbfi_convert_warn(r->c, SBF_CODE_RIG_UNWEIGHTED_POINTS,
        "the weights file has %u of the %u points of %s: the other %u follow the root bone '%s', or the "
        "nearest bone if no point of their object has weights; add their rows, or leave out --weights",
        given, r->input.mesh.positions.count, r->input.scene->file, r->input.mesh.positions.count - given,
        bones->at[0].name);
  return given ? SBF_OK
               : sbfi_weights_rows_fail(rows, 0, "no vertex has a weight above 0: correct the weights");
}

sbf_status sbfi_weigh_by_file(sbfi_rigging *r, const char *path) {
  sbfi_file_content content;
  const char *dot = strrchr(path, '.');
  bool is_json = dot && strcmp(dot, ".json") == 0;
  sbfi_weights_rows rows = {.arena = &r->c->scratch, .error = r->c->error};
  if (!is_json && !(dot && strcmp(dot, ".csv") == 0))
    return sbfi_diagnose(r->c->error, SBF_CODE_BAD_CALL,
        "weights must be named, match, transfer, compute, or a file that ends in .csv or .json, not '%s'",
        sbfi_quote_of(sbfi_span_of(path)).text);
  sbf_status status = sbfi_file_read(path, 0, &r->c->scratch.allocator, &content, r->c->error);
  if (status != SBF_OK) return status;
  sbfi_array_init(&rows.rows, &r->c->scratch.allocator, sizeof(sbfi_weights_row));
  sbfi_span text = {(const char *)content.at, content.size};
  if (sbfi_utf8_check(text.at, text.length) != text.length)
    status = sbfi_weights_rows_fail(&rows, 0, "the file is not UTF-8 text");
  else
    status = is_json ? sbfi_weights_rows_json(&rows, text) : sbfi_weights_rows_csv(&rows, text);
  if (status == SBF_OK) status = apply_rows(r, &rows);
  sbfi_array_free(&rows.rows);
  sbfi_file_content_free(&content);
  if (status != SBF_OK && r->c->error) sbfi_copy_text(r->c->error->file, sizeof r->c->error->file, path);
  return status;
}
