/* Writes skin weights as CSV or JSON, a row for each vertex and bone, as `convert --weights FILE` reads.
 * Vertices are numbered from 0 like the `v` lines of the OBJ of the same asset (obj_write.c). */
#include <string.h>

#include "export/exporting.h"

typedef void (*write_row)(sbfi_export *e, uint32_t vertex, const char *bone, float weight);

/* Quotes only if necessary: RFC 4180. */
static void csv_text(sbfi_text *text, const char *name) {
  bool plain = !strpbrk(name, ",\"\r\n");
  if (!plain) sbfi_text_char(text, '"');
  for (; *name; name++) {
    if (*name == '"') sbfi_text_char(text, '"');
    sbfi_text_char(text, *name);
  }
  if (!plain) sbfi_text_char(text, '"');
}

static void csv_row(sbfi_export *e, uint32_t vertex, const char *bone, float weight) {
  sbfi_text_u32(&e->text, vertex);
  sbfi_text_char(&e->text, ',');
  csv_text(&e->text, bone);
  sbfi_text_char(&e->text, ',');
  sbfi_text_f32(&e->text, weight);
  sbfi_text_char(&e->text, '\n');
}

static void json_row(sbfi_export *e, uint32_t vertex, const char *bone, float weight) {
  char last = e->text.length ? e->text.at[e->text.length - 1] : 0;
  sbfi_text_string(&e->text, last == '}' ? ",\n{\"vertex\": " : "\n{\"vertex\": ");
  sbfi_text_u32(&e->text, vertex);
  sbfi_text_string(&e->text, ", \"bone\": \"");
  for (; *bone; bone++) {
    if ((unsigned char)*bone < ' ') {
      sbfi_export_format(e, "\\u%04x", (unsigned)(unsigned char)*bone);
      continue;
    }
    if (*bone == '"' || *bone == '\\') sbfi_text_char(&e->text, '\\');
    sbfi_text_char(&e->text, *bone);
  }
  sbfi_text_string(&e->text, "\", \"weight\": ");
  sbfi_text_f32(&e->text, weight);
  sbfi_text_char(&e->text, '}');
}

static uint32_t write_rows(sbfi_export *e, write_row row) {
  const sbf_asset *a = e->asset;
  uint32_t rows = 0;
  for (uint32_t m = 0, first = 0; m < a->render_meshes.count; m++) {
    const sbf_render_mesh *mesh = &a->render_meshes.at[m];
    uint32_t count = mesh->mesh.positions.count;
    for (uint32_t i = 0, at = 0; mesh->skin && i < count; at += mesh->skin->influence_counts.at[i++])
      for (uint32_t k = at; k < at + mesh->skin->influence_counts.at[i]; k++, rows++)
        row(e, first + i, a->bones.at[mesh->skin->bones.at[k]].name, mesh->skin->weights.at[k]);
    for (uint32_t i = 0; !mesh->skin && mesh->bone >= 0 && i < count; i++, rows++)
      row(e, first + i, a->bones.at[mesh->bone].name, 1);
    first += count;
  }
  return rows;
}

static sbf_status commit(sbfi_export *e, uint32_t rows) {
  if (rows) return sbfi_export_commit(e, e->path);
  return sbfi_diagnose(e->error, SBF_CODE_BAD_CALL,
      "%s: no mesh of the bundle is attached to a bone, so there are no weights to write", e->path);
}

sbf_status sbfi_export_weights_csv(sbfi_export *e) {
  sbfi_text_string(&e->text, "vertex,bone,weight\n");
  return commit(e, write_rows(e, csv_row));
}

sbf_status sbfi_export_weights_json(sbfi_export *e) {
  sbfi_text_string(&e->text, "{\"weights\": [");
  uint32_t rows = write_rows(e, json_row);
  sbfi_text_string(&e->text, "\n]}\n");
  return commit(e, rows);
}
