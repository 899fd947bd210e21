/* Prints what the library reads from a file as the canonical JSON of spec/reader/sbf.py: every field of every
 * object in the order of field numbers, defaults included. Exit status: the status of the load. */
#include <stdio.h>

#include "base/base64.h"
#include "base/text.h"
#include "model/ids.h"
#include "model/schema.h"
#include "sbfmt/io.h"

typedef struct dump {
  const sbf_asset *asset;
  sbfi_text text;
} dump;

static void write_string(dump *d, const char *string) {
  sbfi_text_char(&d->text, '"');
  for (; *string; string++) {
    const char *escaped = *string == '"'    ? "\\\""
                          : *string == '\\' ? "\\\\"
                          : *string == '\n' ? "\\n"
                          : *string == '\r' ? "\\r"
                          : *string == '\t' ? "\\t"
                                            : NULL;
    if (escaped)
      sbfi_text_string(&d->text, escaped);
    else
      sbfi_text_char(&d->text, *string);
  }
  sbfi_text_char(&d->text, '"');
}

static void write_scalars(dump *d, sbfi_item item, const void *at, size_t count) {
  const float *floats = at;
  const uint32_t *integers = at;
  for (size_t i = 0; i < count; i++) {
    if (i) sbfi_text_char(&d->text, ',');
    if (item == SBFI_ITEM_F32)
      sbfi_text_f32(&d->text, floats[i]);
    else
      sbfi_text_u32(&d->text, integers[i]);
  }
}

static void write_list(dump *d, const sbfi_field *field, sbfi_list list) {
  if (field->item == SBFI_ITEM_U8) {
    sbfi_text_char(&d->text, '"');
    sbfi_base64_encode(&d->text, list.at, list.count);
    sbfi_text_char(&d->text, '"');
    return;
  }
  sbfi_text_char(&d->text, '[');
  write_scalars(d, field->item, list.at, (size_t)list.count * field->width);
  sbfi_text_char(&d->text, ']');
}

static void write_value(dump *d, const sbfi_field *field, const void *object) {
  const char *at = (const char *)object + field->offset;
  switch (field->type) {
  case SBFI_BOOL:
    sbfi_text_string(&d->text, *(const bool *)at ? "true" : "false");
    break;
  case SBFI_INT:
    sbfi_text_i32(&d->text, sbfi_get_integer(object, field));
    break;
  case SBFI_UINT:
    sbfi_text_u32(&d->text, (uint32_t)sbfi_get_integer(object, field));
    break;
  case SBFI_FLOAT:
    write_scalars(d, SBFI_ITEM_F32, at, 1);
    break;
  case SBFI_VEC2:
  case SBFI_VEC3:
  case SBFI_VEC4:
  case SBFI_QUAT:
    sbfi_text_char(&d->text, '[');
    write_scalars(d, SBFI_ITEM_F32, at, field->width);
    sbfi_text_char(&d->text, ']');
    break;
  case SBFI_ENUM:
    write_string(d, field->words.at[sbfi_get_integer(object, field)]);
    break;
  case SBFI_REF: {
    const char *id = sbfi_ref_id(d->asset, field, sbfi_get_integer(object, field));
    if (id)
      write_string(d, id);
    else
      sbfi_text_string(&d->text, "null");
    break;
  }
  default:
    write_string(d, sbfi_get_pointer(object, field));
    break;
  }
}

static void write_object(dump *d, const sbfi_element *element, const void *object);

static void write_children(dump *d, const sbfi_field *field, const void *object) {
  sbfi_list list = sbfi_get_list(object, field);
  sbfi_text_char(&d->text, '[');
  for (uint32_t i = 0; i < list.count; i++) {
    if (i) sbfi_text_char(&d->text, ',');
    write_object(d, field->element, (const char *)list.at + (size_t)i * field->element->struct_size);
  }
  sbfi_text_char(&d->text, ']');
}

static void write_object(dump *d, const sbfi_element *element, const void *object) {
  sbfi_text_char(&d->text, '{');
  for (uint32_t i = 0; i < element->field_count; i++) {
    const sbfi_field *field = &element->fields[i];
    const void *child;
    if (i) sbfi_text_char(&d->text, ',');
    write_string(d, field->name);
    sbfi_text_char(&d->text, ':');
    switch (field->type) {
    case SBFI_LIST:
      write_list(d, field, sbfi_get_list(object, field));
      break;
    case SBFI_ONE:
      write_object(d, field->element, (const char *)object + field->offset);
      break;
    case SBFI_OPTIONAL:
      child = sbfi_get_pointer(object, field);
      if (child)
        write_object(d, field->element, child);
      else
        sbfi_text_string(&d->text, "null");
      break;
    case SBFI_MANY:
      write_children(d, field, object);
      break;
    default:
      write_value(d, field, object);
      break;
    }
  }
  sbfi_text_char(&d->text, '}');
}

int main(int argc, char **argv) {
  if (argc != 2) {
    fprintf(stderr, "usage: dump_json FILE\n");
    return SBF_FAILED;
  }
  sbf_asset *asset;
  sbf_diagnostic error;
  const sbf_load_options options = {.check_crc = true};
  sbf_status status = sbf_load_file(argv[1], &options, &asset, &error);
  if (status != SBF_OK) {
    fprintf(stderr, "dump_json: %s: %s at %s\n", argv[1], error.message, error.path);
    return (int)status;
  }
  dump d = {.asset = asset};
  sbfi_text_init(&d.text, NULL);
  write_object(&d, &sbfi_asset_element, asset);
  sbfi_text_char(&d.text, '\n');
  if (d.text.failed || fwrite(d.text.at, 1, d.text.length, stdout) != d.text.length || fflush(stdout) != 0)
    status = SBF_FAILED;
  sbfi_text_free(&d.text);
  sbf_asset_free(asset);
  return (int)status;
}
