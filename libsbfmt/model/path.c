#include "model/path.h"

#include <stdio.h>

enum { DEEPEST = 16 }; /* elements inside each other; the schema has five */

static void append(char *to, size_t size, const char *text) {
  size_t length = strlen(to);
  if (length + 1 < size) snprintf(to + length, size - length, "%s", text);
}

void sbfi_path_write(const sbfi_path *path, const sbfi_field *field, char *to, size_t size) {
  const sbfi_path *steps[DEEPEST];
  size_t count = 0;
  if (size == 0) return;
  snprintf(to, size, "/%s", sbfi_asset_element.xml);
  for (; path && count < DEEPEST; path = path->up) steps[count++] = path;
  while (count--) {
    const sbfi_path *step = steps[count];
    char name[64], text[96];
    if (step->field->type == SBFI_MANY)
      snprintf(text, sizeof text, "/%s[%u]", sbfi_child_xml_name(step->field, step->child, name, sizeof name),
          step->place);
    else
      snprintf(text, sizeof text, "/%s", step->field->name);
    append(to, size, text);
  }
  if (!field) return;
  append(to, size, "/");
  append(to, size, field->name);
}
