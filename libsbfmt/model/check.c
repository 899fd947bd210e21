/* Structural check: all promises of a load, from the schema's tables only. */
#include "model/check.h"

#include <float.h>
#include <stdio.h>

#include "base/diagnostic.h"
#include "base/number.h"
#include "base/text.h"
#include "model/asset_box.h"
#include "model/bulk_check.h"
#include "model/element_path.h"
#include "model/ids.h"
#include "model/version.h"

typedef struct checker {
  const sbf_asset *asset;
  void (*report)(void *user, const sbf_diagnostic *diagnostic);
  void *user;
  uint32_t limit, found;
  bool outline;    /* lists may have a count but no items */
  bool repairable; /* skips faults that sbf_fix repairs */
  sbfi_ids ids;
} checker;

static bool is_done(const checker *c) {
  return c->limit && c->found >= c->limit;
}

__attribute__((format(printf, 6, 7))) static void fault(checker *c, sbf_code code,
    const sbfi_element_path *path, const sbfi_field *field, int64_t index, const char *format, ...) {
  if (is_done(c)) return;
  c->found++;
  if (!c->report) return;
  sbf_diagnostic diagnostic;
  va_list arguments;
  va_start(arguments, format);
  sbfi_diagnose_v(&diagnostic, code, format, arguments);
  va_end(arguments);
  sbfi_element_path_print(path, field, diagnostic.path, sizeof diagnostic.path);
  diagnostic.index = index;
  c->report(c->user, &diagnostic);
}

/* --- texts --- */

/* Finds characters that XML 1.0 cannot represent. `text` is well-formed UTF-8. */
static const char *find_forbidden(const char *text) {
  for (; *text; text++) {
    unsigned char byte = (unsigned char)*text;
    if (byte < 0x20 && byte != '\t' && byte != '\n' && byte != '\r') return text;
    if (byte == 0xef && (unsigned char)text[1] == 0xbf && ((unsigned char)text[2] & 0xfe) == 0xbe)
      return text;
  }
  return NULL;
}

static void check_text(checker *c, const sbfi_element_path *path, const sbfi_field *field) {
  const char *text = sbfi_get_pointer(path->object, field);
  if (!text) {
    fault(c, SBF_CODE_BAD_TEXT, path, field, -1, "`%s` is NULL: use an empty text instead", field->name);
    return;
  }
  if (!*text) {
    if (field->type == SBFI_ID)
      fault(c, SBF_CODE_ID_EMPTY, path, field, -1, "the id is empty: give it one that is unique in the file");
    else if (field->required)
      fault(c, SBF_CODE_REQUIRED_MISSING, path, field, -1, "`%s` is required and must not be empty",
          field->name);
    return;
  }
  size_t length = strlen(text), good = sbfi_utf8_check(text, length);
  const char *forbidden;
  if (good < length)
    fault(c, SBF_CODE_NOT_UTF8, path, field, -1,
        "`%s` is not valid UTF-8 at byte %zu: save it in that encoding", field->name, good);
  else if ((forbidden = find_forbidden(text)))
    fault(c, SBF_CODE_BAD_TEXT, path, field, -1,
        "`%s` has a character at byte %zu that XML does not allow: remove it", field->name,
        (size_t)(forbidden - text));
}

static void check_id(checker *c, const sbfi_element_path *path, const sbfi_field *field) {
  const char *id = sbfi_get_pointer(path->object, field);
  const sbfi_id_entry *first;
  if (!id || !*id) return;
  sbfi_id_entry entry = {.id = id, .index = path->index};
  if (path->up && !path->up->up) entry.collection = path->field;
  if (!sbfi_ids_add(&c->ids, entry, &first)) {
    fault(c, SBF_CODE_OUT_OF_MEMORY, path, field, -1, "memory ran out while ids were compared");
    return;
  }
  if (!first) return;
  char other[sizeof((sbf_diagnostic *)0)->path] = "an earlier object";
  if (first->collection) {
    sbfi_element_path root = sbfi_element_path_root(c->asset);
    sbfi_element_path there = sbfi_element_path_child(&root, first->collection, first->index);
    sbfi_element_path_print(&there, NULL, other, sizeof other);
  }
  fault(c, SBF_CODE_ID_REPEATED, path, field, -1,
      "the id `%s` is also used by %s: ids must be unique in the file", id, other);
}

/* --- numbers --- */

/* Next float32 above or below `value`. */
static float next_float(float value, bool up) {
  uint32_t bits;
  if (value == 0) return up ? FLT_TRUE_MIN : -FLT_TRUE_MIN;
  memcpy(&bits, &value, sizeof bits);
  bits += (value > 0) == up ? 1u : UINT32_MAX;
  memcpy(&value, &bits, sizeof value);
  return value;
}

typedef struct bounds {
  float low, high;
} bounds;

/* Smallest and largest float32 of a field. Bounds are rounded to float32 first, so that a file may contain
 * the bound itself. */
static bounds bounds_of(const sbfi_field *field) {
  bounds b = {-FLT_MAX, FLT_MAX};
  if (!field->range.is_stated) return b;
  if (field->range.min > -FLT_MAX)
    b.low = field->range.min_open ? next_float((float)field->range.min, true) : (float)field->range.min;
  if (field->range.max < FLT_MAX)
    b.high = field->range.max_open ? next_float((float)field->range.max, false) : (float)field->range.max;
  return b;
}

/* Numbers for messages, independent of the locale's decimal separator. */
typedef struct number_text {
  char at[SBFI_F32_TEXT_SIZE + 1];
} number_text;

static number_text text_of(double value) {
  number_text text;
  size_t length = sbfi_print_f32(text.at, (float)value);
  text.at[length] = 0;
  if (!length) strcpy(text.at, value != value ? "nan" : value < 0 ? "-inf" : "inf");
  return text;
}

typedef struct range_text {
  char at[64];
} range_text;

static range_text text_of_range(const sbfi_field *field) {
  range_text text;
  snprintf(text.at, sizeof text.at, "%c%s, %s%c%s%s", field->range.min_open ? '(' : '[',
      text_of(field->range.min).at, text_of(field->range.max).at, field->range.max_open ? ')' : ']',
      *field->unit ? " " : "", field->unit);
  return text;
}

static bool is_finite(float value) {
  return value >= -FLT_MAX && value <= FLT_MAX;
}

/* Lists of weights that sbf_fix clamps to their range. */
static bool is_repairable(const sbfi_element_path *path, const sbfi_field *field) {
  static const char *const lists[][2] = {
      {"skin", "weights"}, {"pin_set", "weights"}, {"embedding", "blends"}};
  for (size_t i = 0; i < sizeof lists / sizeof *lists; i++)
    if (strcmp(path->element->name, lists[i][0]) == 0 && strcmp(field->name, lists[i][1]) == 0) return true;
  return false;
}

static void check_floats(
    checker *c, const sbfi_element_path *path, const sbfi_field *field, const float *at, size_t count) {
  bounds b = bounds_of(field);
  if (c->repairable && is_repairable(path, field)) b = (bounds){-FLT_MAX, FLT_MAX};
  size_t bad = sbfi_find_f32_outside(at, count, b.low, b.high);
  if (bad == count) return;
  int64_t item = field->type == SBFI_LIST ? (int64_t)(bad / field->width) : -1;
  char component[16] = "";
  if (field->width > 1) snprintf(component, sizeof component, ".%c", "xyzw"[bad % field->width]);
  const char *verb = field->type == SBFI_LIST ? "has" : "is";
  if (!is_finite(at[bad]))
    fault(c, SBF_CODE_VALUE_NOT_FINITE, path, field, item, "`%s`%s %s %s: every number must be finite",
        field->name, component, verb, text_of(at[bad]).at);
  else
    fault(c, SBF_CODE_VALUE_OUT_OF_RANGE, path, field, item, "`%s`%s %s %s, outside %s: use a value inside",
        field->name, component, verb, text_of(at[bad]).at, text_of_range(field).at);
}

static void check_integer(checker *c, const sbfi_element_path *path, const sbfi_field *field) {
  int32_t value = sbfi_get_integer(path->object, field);
  double number = field->type == SBFI_UINT ? (double)(uint32_t)value : (double)value;
  if (!field->range.is_stated ||
      ((field->range.min_open ? number > field->range.min : number >= field->range.min) &&
          (field->range.max_open ? number < field->range.max : number <= field->range.max)))
    return;
  fault(c, SBF_CODE_VALUE_OUT_OF_RANGE, path, field, -1, "`%s` is %.0f, outside %s: use a value inside",
      field->name, number, text_of_range(field).at);
}

static void check_enum(checker *c, const sbfi_element_path *path, const sbfi_field *field) {
  int32_t value = sbfi_get_integer(path->object, field);
  if ((uint32_t)value >= field->words.count)
    fault(c, SBF_CODE_ENUM_OUT_OF_RANGE, path, field, -1, "`%s` is %d, but its values are numbered 0 to %u",
        field->name, value, field->words.count - 1);
}

static void check_ref(checker *c, const sbfi_element_path *path, const sbfi_field *field) {
  int32_t value = sbfi_get_integer(path->object, field);
  uint32_t count = sbfi_ref_count(c->asset, field);
  if (value == SBF_NONE) {
    if (field->required)
      fault(c, SBF_CODE_REQUIRED_MISSING, path, field, -1, "`%s` must name one of the %s", field->name,
          field->reference.name);
  } else if ((uint32_t)value >= count) {
    fault(c, SBF_CODE_INDEX_OUT_OF_RANGE, path, field, -1, "`%s` is %d, but there are %u %s", field->name,
        value, count, field->reference.name);
  } else if (field->earlier && (uint32_t)value >= path->index) {
    fault(c, SBF_CODE_BONE_ORDER, path, field, -1,
        "`%s` is `%s`, which does not precede it: sort the %s, each after the one it names", field->name,
        sbfi_ref_id(c->asset, field, value), field->reference.name);
  }
}

/* --- lists --- */

static void check_length(checker *c, const sbfi_element_path *path, const sbfi_field *field, uint32_t count) {
  char allowed[192] = "";
  size_t used = 0;
  for (uint32_t i = 0; i < field->length_count; i++) {
    const sbfi_length *length = &field->lengths[i];
    if (c->outline && !sbfi_length_is_known(length, path)) return;
    uint64_t value = sbfi_length_value(length, path);
    if (value == count) return;
    const char *before = i == 0 ? "" : " or ";
    bool plain = length->terms[0].kind == SBFI_TERM_NUMBER && length->term_count == 1;
    int added = plain ? snprintf(allowed + used, sizeof allowed - used, "%s%s", before, length->text)
                      : snprintf(allowed + used, sizeof allowed - used, "%s%llu (%s)", before,
                            (unsigned long long)value, length->text);
    if (added > 0 && (used += (size_t)added) >= sizeof allowed) used = sizeof allowed - 1;
  }
  if (field->length_count)
    fault(c, SBF_CODE_WRONG_LENGTH, path, field, -1, "`%s` has %u items instead of %s", field->name, count,
        allowed);
}

static uint32_t bound_to_u32(double bound) {
  return bound <= 0 ? 0 : bound >= UINT32_MAX ? UINT32_MAX : (uint32_t)bound;
}

static void check_integers(
    checker *c, const sbfi_element_path *path, const sbfi_field *field, const uint32_t *at, size_t count) {
  if (!field->range.is_stated) return;
  uint32_t low = bound_to_u32(field->range.min) + (field->range.min_open && field->range.min >= 0);
  uint32_t high = bound_to_u32(field->range.max) - (field->range.max_open && field->range.max <= UINT32_MAX);
  size_t bad = sbfi_find_u32_outside(at, count, low, high);
  if (bad < count)
    fault(c, SBF_CODE_VALUE_OUT_OF_RANGE, path, field, (int64_t)(bad / field->width),
        "`%s` has %u, outside %s: use a value inside", field->name, at[bad], text_of_range(field).at);
}

static bool check_indices(
    checker *c, const sbfi_element_path *path, const sbfi_field *field, const uint32_t *at, size_t count) {
  uint64_t limit = sbfi_length_value(field->index, path);
  if (!count || limit > UINT32_MAX || !sbfi_length_is_known(field->index, path)) return true;
  size_t bad = limit ? sbfi_find_u32_outside(at, count, 0, (uint32_t)limit - 1) : 0;
  if (bad == count) return true;
  fault(c, SBF_CODE_INDEX_OUT_OF_RANGE, path, field, (int64_t)(bad / field->width),
      "`%s` names %u, but %s has %llu items, counted from 0", field->name, at[bad], field->index->text,
      (unsigned long long)limit);
  return false;
}

static void check_positive(
    checker *c, const sbfi_element_path *path, const sbfi_field *field, sbfi_list list) {
  sbfi_list positions = sbfi_term_list(&field->index->terms[0], path);
  if (!positions.at || c->repairable) return;
  size_t bad = sbfi_find_not_positive(list.at, list.count, positions.at);
  if (bad < list.count)
    fault(c, SBF_CODE_TETRAHEDRON_INVERTED, path, field, (int64_t)bad,
        "tetrahedron %zu is inverted or flat: swap two of its points, or remove it", bad);
}

static void check_list(checker *c, const sbfi_element_path *path, const sbfi_field *field) {
  sbfi_list list = sbfi_get_list(path->object, field);
  size_t scalars = (size_t)list.count * field->width;
  check_length(c, path, field, list.count);
  if (list.count && !list.at) {
    if (c->outline) return;
    fault(c, SBF_CODE_WRONG_LENGTH, path, field, -1, "`%s` has %u items, but its pointer is NULL",
        field->name, list.count);
    return;
  }
  if (field->item == SBFI_ITEM_F32) check_floats(c, path, field, list.at, scalars);
  if (field->item != SBFI_ITEM_U32) return;
  check_integers(c, path, field, list.at, scalars);
  if (field->index && check_indices(c, path, field, list.at, scalars) && field->positive)
    check_positive(c, path, field, list);
}

/* --- objects --- */

static void check_fixed(checker *c, const sbfi_element_path *child) {
  const sbfi_field *field = child->field;
  if (!field->fixed.name) return;
  const sbfi_field *fixed = sbfi_element_field(field->element, field->fixed.name);
  if (sbfi_get_integer(child->object, fixed) != field->fixed.value)
    fault(c, SBF_CODE_FIXED_VALUE, child, fixed, -1, "`%s` must be `%s` here", fixed->name,
        fixed->words.at[field->fixed.value]);
}

static void check_object(checker *c, const sbfi_element_path *path);

static void check_children(checker *c, const sbfi_element_path *path, const sbfi_field *field) {
  uint32_t count = sbfi_child_count(path->object, field);
  if (field->type == SBFI_MANY && count && !sbfi_get_list(path->object, field).at) {
    fault(c, SBF_CODE_WRONG_LENGTH, path, field, -1, "`%s` has %u items, but its pointer is NULL",
        field->name, count);
    return;
  }
  for (uint32_t i = 0; i < count && !is_done(c); i++) {
    sbfi_element_path child = sbfi_element_path_child(path, field, i);
    check_fixed(c, &child);
    check_object(c, &child);
  }
}

static void check_field(checker *c, const sbfi_element_path *path, const sbfi_field *field) {
  switch (field->type) {
  case SBFI_BOOL:
    break;
  case SBFI_INT:
  case SBFI_UINT:
    check_integer(c, path, field);
    break;
  case SBFI_FLOAT:
  case SBFI_VEC2:
  case SBFI_VEC3:
  case SBFI_VEC4:
  case SBFI_QUAT: {
    float values[4];
    memcpy(values, (const char *)path->object + field->offset, field->width * sizeof *values);
    check_floats(c, path, field, values, field->width);
    break;
  }
  case SBFI_ID:
    check_text(c, path, field);
    check_id(c, path, field);
    break;
  case SBFI_STRING:
  case SBFI_TEXT:
    check_text(c, path, field);
    break;
  case SBFI_ENUM:
    check_enum(c, path, field);
    break;
  case SBFI_REF:
    check_ref(c, path, field);
    break;
  case SBFI_LIST:
    check_list(c, path, field);
    break;
  case SBFI_ONE:
  case SBFI_OPTIONAL:
  case SBFI_MANY:
    check_children(c, path, field);
    break;
  }
}

static void check_object(checker *c, const sbfi_element_path *path) {
  for (uint32_t i = 0; i < path->element->field_count && !is_done(c); i++)
    check_field(c, path, &path->element->fields[i]);
}

static void check_version(checker *c, const sbfi_element_path *root) {
  const sbfi_field *field = sbfi_element_field(root->element, "version");
  const char *version = c->asset->version;
  if (!version || !*version) return; /* reported as a text */
  switch (sbfi_version_check(version)) {
  case SBFI_VERSION_KNOWN:
  case SBFI_VERSION_NEWER_MINOR:
    break;
  case SBFI_VERSION_TOO_NEW:
    fault(c, SBF_CODE_VERSION_TOO_NEW, root, field, -1,
        "the file has version %s, this library reads %s: update it", version, SBF_FORMAT_VERSION);
    break;
  case SBFI_VERSION_MALFORMED:
    fault(c, SBF_CODE_VALUE_OUT_OF_RANGE, root, field, -1,
        "`version` is `%s`, which does not have the form major.minor: write %s", version, SBF_FORMAT_VERSION);
    break;
  }
}

static uint32_t check_asset(checker *c) {
  sbfi_ids_init(&c->ids, &sbfi_asset_box_of(c->asset)->arena.allocator);
  sbfi_element_path root = sbfi_element_path_root(c->asset);
  check_version(c, &root);
  check_object(c, &root);
  sbfi_ids_free(&c->ids);
  return c->found;
}

uint32_t sbf_asset_check(const sbf_asset *asset, void (*report)(void *user, const sbf_diagnostic *diagnostic),
    void *user, uint32_t limit) {
  checker c = {.asset = asset, .report = report, .user = user, .limit = limit};
  return check_asset(&c);
}

/* --- loads and saves --- */

static void store_diagnostic(void *user, const sbf_diagnostic *diagnostic) {
  *(sbf_diagnostic *)user = *diagnostic;
}

uint32_t sbfi_check_structure(const sbf_asset *asset, const sbf_load_options *options,
    void (*report)(void *user, const sbf_diagnostic *diagnostic), void *user, uint32_t limit) {
  checker c = {.asset = asset, .report = report, .user = user, .limit = limit};
  if (options) c.outline = options->outline;
  if (options) c.repairable = options->repairable;
  return check_asset(&c);
}

static sbf_status check_first(
    const sbf_asset *asset, const sbf_load_options *options, sbf_diagnostic *error) {
  sbf_diagnostic first;
  if (sbfi_check_structure(asset, options, store_diagnostic, &first, 1) == 0) return SBF_OK;
  if (error) *error = first;
  return sbf_code_find(first.code)->fault;
}

sbf_status sbfi_check_saved(const sbf_asset *asset, sbf_diagnostic *error) {
  return check_first(asset, NULL, error);
}

static bool is_known(const char *extension, const sbf_load_options *options) {
  if (!options) return false;
  for (uint32_t i = 0; i < options->extension_count; i++)
    if (strcmp(options->extensions[i], extension) == 0) return true;
  return false;
}

sbf_status sbfi_check_extensions(
    const sbf_asset *asset, const sbf_load_options *options, sbf_diagnostic *error) {
  for (uint32_t i = 0; i < asset->extensions.count; i++) {
    const sbf_extension *extension = &asset->extensions.at[i];
    if (!extension->required || is_known(extension->name, options)) continue;
    sbf_status status = sbfi_diagnose(error, SBF_CODE_EXTENSION_REQUIRED,
        "the file requires the extension `%s`: use a program that knows it", extension->name);
    if (error) snprintf(error->path, sizeof error->path, "/sbf/extensions/extension[%u]", i + 1);
    return status;
  }
  return SBF_OK;
}

sbf_status sbfi_check_loaded(const sbf_asset *asset, const sbf_load_options *options, sbf_diagnostic *error) {
  sbf_status status = check_first(asset, options, error);
  return status == SBF_OK ? sbfi_check_extensions(asset, options, error) : status;
}

void sbfi_report_left_out(
    const sbf_load_options *options, const char *stated, uint32_t left_out, const char *first) {
  sbf_diagnostic warning;
  if (!left_out || !options->report) return;
  sbfi_diagnose(&warning, SBF_CODE_VERSION_NEWER,
      "the file has version %.20s, this library knows %s: %u part%s of it %s left out, the first is %.120s; "
      "update the library before you save the file again",
      stated, SBF_FORMAT_VERSION, left_out, left_out == 1 ? "" : "s", left_out == 1 ? "was" : "were", first);
  if (*first == '/') sbfi_copy_text(warning.path, sizeof warning.path, first);
  if (options->name) sbfi_copy_text(warning.file, sizeof warning.file, options->name);
  options->report(options->user, &warning);
}
