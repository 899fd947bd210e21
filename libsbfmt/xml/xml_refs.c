/* Resolves ids in references to indices after everything has been read. */
#include <stdio.h>
#include <string.h>

#include "base/diagnostic.h"
#include "base/suggest.h"
#include "model/asset_box.h"
#include "model/element_path.h"
#include "model/ids.h"
#include "xml/xml_reader.h"

typedef struct resolver {
  sbf_asset *asset;
  const char *const *texts; /* texts of the references, indexed by the reference's current value */
  sbfi_ids ids;
  sbfi_xml_findings *findings;
} resolver;

static sbfi_suggestion_text suggest_id(const sbf_asset *asset, const sbfi_field *ref, const char *text) {
  sbfi_suggestion suggestion = sbfi_suggestion_for(sbfi_span_of(text));
  uint32_t count = sbfi_ref_count(asset, ref);
  for (uint32_t i = 0; i < count; i++)
    sbfi_suggestion_consider(&suggestion, sbfi_ref_id(asset, ref, (int32_t)i));
  return sbfi_suggestion_text_of(&suggestion);
}

static void report_unknown(resolver *r, const sbfi_element_path *path, const sbfi_field *field,
    const char *text, const sbfi_id_entry *other) {
  if (r->findings->count == r->findings->capacity) return;
  sbf_diagnostic *diagnostic = &r->findings->at[r->findings->count++];
  if (other)
    sbfi_diagnose(diagnostic, SBF_CODE_REF_UNKNOWN, "`%s` names `%.60s`, which is in %s, not in %s",
        field->name, text, other->collection->name, field->reference.name);
  else if (!*text)
    sbfi_diagnose(
        diagnostic, SBF_CODE_REF_UNKNOWN, "`%s` is empty: remove it if it refers to nothing", field->name);
  else
    sbfi_diagnose(diagnostic, SBF_CODE_REF_UNKNOWN, "`%s` names `%.60s`, but no item of %s has that id%s",
        field->name, text, field->reference.name, suggest_id(r->asset, field, text).at);
  sbfi_element_path_print(path, field, diagnostic->path, sizeof diagnostic->path);
}

/* Index of the first item with that id in the collection. Duplicates are reported by the check. */
static int32_t find_repeated(const resolver *r, const sbfi_field *field, const char *text) {
  uint32_t count = sbfi_ref_count(r->asset, field);
  for (uint32_t i = 0; i < count; i++)
    if (strcmp(sbfi_ref_id(r->asset, field, (int32_t)i), text) == 0) return (int32_t)i;
  return SBF_NONE;
}

static void resolve_ref(resolver *r, const sbfi_element_path *path, const sbfi_field *field) {
  int32_t slot = sbfi_get_integer(path->object, field);
  if (slot == SBF_NONE) return;
  const char *text = r->texts[slot];
  const sbfi_id_entry *entry = sbfi_ids_find(&r->ids, text);
  int32_t index = entry && entry->collection->offset == field->reference.offset ? (int32_t)entry->index
                  : entry ? find_repeated(r, field, text)
                          : SBF_NONE;
  if (index == SBF_NONE) report_unknown(r, path, field, text, entry);
  /* the reader created the asset and may modify what is read-only for others */
  sbfi_set_integer((void *)(uintptr_t)path->object, field, index);
}

static void resolve_object(resolver *r, const sbfi_element_path *path) {
  for (uint32_t i = 0; i < path->element->field_count; i++) {
    const sbfi_field *field = &path->element->fields[i];
    if (field->type == SBFI_REF) resolve_ref(r, path, field);
    uint32_t count = sbfi_child_count(path->object, field);
    for (uint32_t k = 0; k < count; k++) {
      sbfi_element_path child = sbfi_element_path_child(path, field, k);
      resolve_object(r, &child);
    }
  }
}

bool sbfi_xml_resolve_refs(sbf_asset *asset, const sbfi_array *refs, sbfi_xml_findings *findings) {
  resolver r = {.asset = asset, .texts = refs->at, .findings = findings};
  sbfi_ids_init(&r.ids, &sbfi_asset_box_of(asset)->arena.allocator);
  bool good = sbfi_ids_add_collections(&r.ids, asset);
  sbfi_element_path root = sbfi_element_path_root(asset);
  if (good) resolve_object(&r, &root);
  sbfi_ids_free(&r.ids);
  return good;
}
