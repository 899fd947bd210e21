/* Checks duplicate names, names of extensions, and hashes. */
#include <stdlib.h>
#include <string.h>

#include "validate/validation.h"

typedef struct named {
  const char *name;
  uint32_t index;
} named;

static int compare(const void *a, const void *b) {
  const named *x = a, *y = b;
  int order = strcmp(x->name, y->name);
  return order ? order : x->index < y->index ? -1 : x->index > y->index;
}

/* A collection of one kind: its word, its items, and the offset of the name in each. */
typedef struct collection {
  const char *kind, *path;
  const void *items;
  uint32_t count;
  size_t size, name;
  sbf_code code;
} collection;

static void find_repeated(sbfi_validation *v, const collection *c) {
  named *all = sbfi_scratch(v, c->count, sizeof *all);
  uint32_t count = 0;
  if (!all) return;
  for (uint32_t i = 0; i < c->count; i++) {
    const char *name;
    memcpy(&name, (const char *)c->items + i * c->size + c->name, sizeof name);
    if (*name) all[count++] = (named){name, i};
  }
  if (count) qsort(all, count, sizeof *all, compare);
  for (uint32_t i = 1, first = 0; i < count; i++) {
    if (strcmp(all[i].name, all[first].name) != 0)
      first = i;
    else
      sbfi_found(v, c->code, sbfi_path_of("%s[%u]", c->path, all[i].index + 1).text, -1,
          "the name '%s' is also that of %s %u", all[i].name, c->kind, all[first].index + 1);
  }
}

static bool is_hash(const char *text) {
  return strlen(text) == 64 && strspn(text, "0123456789abcdef") == 64;
}

static void check_hashes(sbfi_validation *v) {
  const sbf_source_list sources = v->asset->info.sources;
  for (uint32_t i = 0; i < sources.count; i++)
    if (*sources.at[i].sha256 && !is_hash(sources.at[i].sha256))
      sbfi_found(v, SBF_CODE_HASH_MALFORMED, sbfi_path_of("/sbf/asset/source[%u]", i + 1).text, -1,
          "the sum of '%s' is '%.80s'", sources.at[i].path, sources.at[i].sha256);
  const sbf_derivation_list derivations = v->asset->derivations;
  for (uint32_t i = 0; i < derivations.count; i++)
    if (*derivations.at[i].source_hash && !is_hash(derivations.at[i].source_hash))
      sbfi_found(v, SBF_CODE_HASH_MALFORMED, sbfi_path_of("/sbf/derivations/derivation[%u]", i + 1).text, -1,
          "the source hash of '%s' is '%.80s'", derivations.at[i].id, derivations.at[i].source_hash);
}

static bool is_extension_name(const char *name) {
  size_t prefix = strspn(name, "ABCDEFGHIJKLMNOPQRSTUVWXYZ");
  size_t word = name[prefix] == '_' ? strspn(name + prefix + 1, "abcdefghijklmnopqrstuvwxyz0123456789_") : 0;
  return prefix >= 2 && prefix <= 8 && word > 0 && name[prefix + 1 + word] == 0;
}

void sbfi_check_names(sbfi_validation *v) {
  const sbf_asset *a = v->asset;
  const collection collections[] = {{"bone", "/sbf/skeleton/bone", a->bones.at, a->bones.count,
                                        sizeof(sbf_bone), offsetof(sbf_bone, name), SBF_CODE_NAME_REPEATED},
      {"body", "/sbf/soft_body", a->soft_bodies.at, a->soft_bodies.count, sizeof(sbf_soft_body),
          offsetof(sbf_soft_body, name), SBF_CODE_NAME_REPEATED},
      {"clip", "/sbf/clips/clip", a->clips.at, a->clips.count, sizeof(sbf_clip), offsetof(sbf_clip, name),
          SBF_CODE_NAME_REPEATED},
      {"extension", "/sbf/extensions/extension", a->extensions.at, a->extensions.count, sizeof(sbf_extension),
          offsetof(sbf_extension, name), SBF_CODE_EXTENSION_REPEATED}};
  for (size_t i = 0; i < sizeof collections / sizeof *collections && !v->out_of_memory; i++)
    find_repeated(v, &collections[i]);
  for (uint32_t i = 0; i < a->extensions.count; i++)
    if (!is_extension_name(a->extensions.at[i].name))
      sbfi_found(v, SBF_CODE_EXTENSION_NAME, sbfi_path_of("/sbf/extensions/extension[%u]", i + 1).text, -1,
          "the extension has the name '%s'", a->extensions.at[i].name);
  check_hashes(v);
}
