#include "fill_asset.h"

#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "model/bulk_check.h"
#include "model/element_path.h"
#include "model/ids.h"

enum { MIN_ITEMS = 7, FEW_CHILDREN = 2 };

typedef struct filler {
  fill_options options;
  sbf_asset *asset;
  uint64_t random;
  uint32_t ids;
  bool failed; /* memory ran out */
} filler;

/* splitmix64 */
static uint32_t random_below(filler *f, uint32_t bound) {
  uint64_t z = f->random += UINT64_C(0x9e3779b97f4a7c15);
  z = (z ^ z >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
  z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
  return (uint32_t)((z ^ z >> 31) >> 32) % bound;
}

static double random_unit(filler *f) {
  return (random_below(f, UINT32_MAX) + 0.5) / 4294967296.0; /* in (0, 1) */
}

static void *allocate(filler *f, size_t count, size_t size) {
  void *memory = sbf_asset_allocate(f->asset, count, size);
  if (!memory && count) f->failed = true;
  return memory;
}

static const char *copy_text(filler *f, const char *text) {
  const char *copy = sbf_asset_copy_text(f->asset, text);
  if (!copy) f->failed = true;
  return copy ? copy : "";
}

/* --- single values --- */

static float random_float(filler *f, const sbfi_field *field) {
  static const double scales[] = {1, 1e-3, 37, 1e-7, 12345.678, 3e9};
  double value = random_unit(f);
  if (!field->range.is_stated) return (float)(value * 2 - 1);
  if (field->range.max <= FLT_MAX)
    return (float)(field->range.min + (field->range.max - field->range.min) * value);
  return (float)(field->range.min + value * scales[random_below(f, sizeof scales / sizeof *scales)]);
}

static void fill_floats(filler *f, const sbfi_field *field, float *to, size_t count) {
  /* what a printer and a parser may stumble over */
  static const float odd[] = {-0.0f, 1e-45f, FLT_MAX, -FLT_MAX, FLT_MIN, 16777216, 0.1f};
  bool any = field->type == SBFI_LIST && field->width == 1 && !field->range.is_stated;
  for (size_t i = 0; i < count; i++)
    to[i] = any && i < sizeof odd / sizeof *odd ? odd[i] : random_float(f, field);
}

static const char *random_text(filler *f, const sbfi_element_path *path, const sbfi_field *field) {
  static const char *const ends[] = {"", " & <tag> \"quoted\" 'so' >",
      " \xc3\xa9\xe2\x82\xac\xf0\x9f\xa6\x8e", "\ttab\nline\r\nend ", " ]]> &amp; \xc2\x85\xe2\x80\xa8"};
  char text[160];
  const char *end = ends[random_below(f, sizeof ends / sizeof *ends)];
  if (field->type == SBFI_ID)
    snprintf(text, sizeof text, "%s_%u%s", path->element->name, f->ids++, end);
  else if (field->type == SBFI_TEXT)
    snprintf(text, sizeof text, "\n  <%s>\n\t%u%s\n", field->name, random_below(f, 1000), end);
  else
    snprintf(text, sizeof text, " %s %u%s", field->name, random_below(f, 1000), end);
  return copy_text(f, text);
}

static int32_t random_ref(filler *f, const sbfi_element_path *path, const sbfi_field *field) {
  uint32_t count = field->earlier ? path->index : sbfi_ref_count(f->asset, field);
  return count ? (int32_t)random_below(f, count) : SBF_NONE;
}

static int32_t random_enum(filler *f, const sbfi_element_path *path, const sbfi_field *field) {
  if (path->field && path->field->tag.by && strcmp(path->field->tag.by, field->name) == 0)
    return (int32_t)(path->index % field->words.count);
  if (field->words.count == 1) return 0;
  uint32_t value = random_below(f, field->words.count - 1);
  return (int32_t)(value + (value >= field->initial.integer));
}

/* --- lists --- */

static uint32_t pick_length(filler *f, const sbfi_element_path *path, const sbfi_field *field) {
  if (field->index && sbfi_length_value(field->index, path) == 0) return 0;
  if (!field->length_count) return f->options.items;
  uint64_t values[8];
  uint32_t count = 0;
  for (uint32_t i = 0; i < field->length_count; i++) {
    values[count] = sbfi_length_value(&field->lengths[i], path);
    count += values[count] != 0;
  }
  return count ? (uint32_t)values[random_below(f, count)] : 0;
}

static void fill_integers(
    filler *f, const sbfi_element_path *path, const sbfi_field *field, uint32_t *to, size_t count) {
  uint32_t low = field->range.is_stated ? (uint32_t)field->range.min : 0, span = 5;
  if (field->index) span = (uint32_t)sbfi_length_value(field->index, path);
  for (size_t i = 0; i < count; i++) to[i] = low + random_below(f, span);
}

static void make_positive(
    filler *f, const sbfi_element_path *path, const sbfi_field *field, sbf_uint4 *items, size_t count) {
  sbfi_list positions = sbfi_term_list(&field->index->terms[0], path);
  for (size_t i = 0; i < count; i++)
    for (int tries = 0; sbfi_find_not_positive(&items[i], 1, positions.at) == 0; tries++) {
      uint32_t *p = items[i].at, kept = p[0];
      p[0] = p[1];
      p[1] = kept;
      if (tries % 2)
        for (int k = 0; k < 4; k++) p[k] = random_below(f, positions.count);
    }
}

static void fill_list(filler *f, const sbfi_element_path *path, const sbfi_field *field, void *object) {
  uint32_t count = pick_length(f, path, field);
  size_t scalars = (size_t)count * field->width;
  void *at = allocate(f, count, sbfi_item_size(field));
  if (!at) return;
  if (field->item == SBFI_ITEM_F32) fill_floats(f, field, at, scalars);
  if (field->item == SBFI_ITEM_U32) fill_integers(f, path, field, at, scalars);
  if (field->item == SBFI_ITEM_U8)
    for (size_t i = 0; i < scalars; i++) ((uint8_t *)at)[i] = (uint8_t)random_below(f, 256);
  if (field->positive) make_positive(f, path, field, at, count);
  sbfi_set_list(object, field, at, count);
}

/* --- objects --- */

static void fill_object(filler *f, const sbfi_element_path *path, void *object);

static void make_children(filler *f, const sbfi_field *field, void *object) {
  uint32_t count = f->options.children;
  if (field->tag.suffix) count = sbfi_element_field(field->element, field->tag.by)->words.count;
  char *row = allocate(f, count, field->element->struct_size);
  if (!row) return;
  for (uint32_t i = 0; i < count; i++)
    sbfi_element_init(field->element, row + (size_t)i * field->element->struct_size);
  sbfi_set_list(object, field, row, count);
}

static void fill_children(filler *f, const sbfi_element_path *path, const sbfi_field *field, void *object) {
  if (field->type == SBFI_MANY && path->up) make_children(f, field, object);
  if (field->type == SBFI_OPTIONAL) {
    void *child = allocate(f, 1, field->element->struct_size);
    if (child) sbfi_element_init(field->element, child);
    sbfi_set_pointer(object, field, child);
  }
  uint32_t count = sbfi_child_count(object, field);
  for (uint32_t i = 0; i < count && !f->failed; i++) {
    sbfi_element_path child = sbfi_element_path_child(path, field, i);
    void *writable = (char *)object + field->offset;
    if (field->type != SBFI_ONE) memcpy(&writable, &child.object, sizeof writable);
    fill_object(f, &child, writable);
    sbfi_child_fix(field, writable);
  }
}

static void fill_field(filler *f, const sbfi_element_path *path, const sbfi_field *field, void *object) {
  char *at = (char *)object + field->offset;
  switch (field->type) {
  case SBFI_BOOL:
    *(bool *)at = !field->initial.integer;
    break;
  case SBFI_INT:
  case SBFI_UINT:
    sbfi_set_integer(object, field, (int32_t)(field->initial.integer + 1 + random_below(f, 99)));
    break;
  case SBFI_FLOAT:
  case SBFI_VEC2:
  case SBFI_VEC3:
  case SBFI_VEC4:
  case SBFI_QUAT: {
    float values[4];
    fill_floats(f, field, values, field->width);
    memcpy(at, values, field->width * sizeof *values);
    break;
  }
  case SBFI_STRING:
  case SBFI_TEXT:
  case SBFI_ID: /* one that has a default is the version: all fields are used */
    sbfi_set_pointer(object, field, *field->initial.text ? SBF_FORMAT_VERSION : random_text(f, path, field));
    break;
  case SBFI_ENUM:
    sbfi_set_integer(object, field, random_enum(f, path, field));
    break;
  case SBFI_REF:
    sbfi_set_integer(object, field, random_ref(f, path, field));
    break;
  case SBFI_LIST:
    fill_list(f, path, field, object);
    break;
  case SBFI_ONE:
  case SBFI_OPTIONAL:
  case SBFI_MANY:
    fill_children(f, path, field, object);
    break;
  }
}

static void fill_object(filler *f, const sbfi_element_path *path, void *object) {
  for (uint32_t i = 0; i < path->element->field_count && !f->failed; i++)
    fill_field(f, path, &path->element->fields[i], object);
}

sbf_asset *fill_asset(const fill_options *options) {
  filler f = {.options = *options, .random = options->seed};
  if (f.options.items < MIN_ITEMS) f.options.items = MIN_ITEMS;
  if (!f.options.children) f.options.children = FEW_CHILDREN;
  f.asset = sbf_asset_create(options->allocator);
  if (!f.asset) return NULL;
  /* references look forward as well, so the root's collections have their length first */
  for (uint32_t i = 0; i < sbfi_asset_element.field_count; i++)
    if (sbfi_asset_element.fields[i].type == SBFI_MANY)
      make_children(&f, &sbfi_asset_element.fields[i], f.asset);
  sbfi_element_path root = sbfi_element_path_root(f.asset);
  fill_object(&f, &root, f.asset);
  if (!f.failed) return f.asset;
  sbf_asset_free(f.asset);
  return NULL;
}

sbf_load_options fill_load_options(const sbf_asset *asset) {
  static const char *names[64];
  sbf_load_options options = {.extensions = names};
  for (uint32_t i = 0; i < asset->extensions.count && i < 64; i++)
    names[options.extension_count++] = asset->extensions.at[i].name;
  return options;
}

/* --- completeness --- */

typedef struct search {
  const sbfi_element *element;
  const sbfi_field *field;
  bool found; /* with another value than its default */
} search;

static bool is_default(const sbfi_field *field, const void *object) {
  char fresh[2048];
  const sbfi_element alone = {.struct_size = sizeof fresh, .field_count = 1, .fields = field};
  if (sbfi_child_count(object, field)) return false;
  sbfi_element_init(&alone, fresh);
  const char *at = (const char *)object + field->offset, *other = fresh + field->offset;
  switch (field->type) {
  case SBFI_BOOL:
    return *(const bool *)at == *(const bool *)other;
  case SBFI_STRING:
  case SBFI_TEXT:
  case SBFI_ID:
    return strcmp(sbfi_get_pointer(object, field), field->initial.text) == 0;
  case SBFI_LIST:
    return sbfi_get_list(object, field).count == 0;
  case SBFI_OPTIONAL:
  case SBFI_MANY:
    return true;
  default:
    return memcmp(at, other, field->width * sizeof(float)) == 0;
  }
}

static void search_object(search *s, const sbfi_element_path *path) {
  if (path->element == s->element && !is_default(s->field, path->object)) s->found = true;
  for (uint32_t i = 0; i < path->element->field_count && !s->found; i++) {
    const sbfi_field *field = &path->element->fields[i];
    uint32_t count = sbfi_child_count(path->object, field);
    for (uint32_t k = 0; k < count && !s->found; k++) {
      sbfi_element_path child = sbfi_element_path_child(path, field, k);
      search_object(s, &child);
    }
  }
}

/* What can have no other value: fixed by its place, of a single word, or with the one version there is. */
static bool has_choice(const sbfi_field *field) {
  return !(field->type == SBFI_ENUM && field->words.count == 1) &&
         !(field->type == SBFI_STRING && *field->initial.text);
}

static bool element_is_filled(
    const sbfi_element_path *root, const sbfi_element *element, char *field, size_t size) {
  for (uint32_t i = 0; i < element->field_count; i++) {
    search s = {element, &element->fields[i], false};
    if (has_choice(s.field)) {
      search_object(&s, root);
      if (!s.found) {
        snprintf(field, size, "%s.%s", element->name, s.field->name);
        return false;
      }
    }
    if (s.field->element && !element_is_filled(root, s.field->element, field, size)) return false;
  }
  return true;
}

bool fill_is_complete(const sbf_asset *asset, char *field, size_t size) {
  sbfi_element_path root = sbfi_element_path_root(asset);
  return element_is_filled(&root, &sbfi_asset_element, field, size);
}
