#define _XOPEN_SOURCE 700
#include "xml_samples.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

sbf_asset *samples_load(const char *text, sbf_diagnostic *error) {
  sbf_asset *asset = NULL;
  memset(error, 0, sizeof *error);
  sbf_status status = sbf_xml_load_memory(text, strlen(text), NULL, &asset, error);
  ck_assert_int_eq(status == SBF_OK, asset != NULL);
  return asset;
}

const char *samples_document(const char *inside) {
  static char text[1 << 16];
  int length = snprintf(text, sizeof text, "<sbf version=\"1.0\">\n%s</sbf>\n", inside);
  ck_assert_int_lt(length, (int)sizeof text);
  return text;
}

void samples_expect(const char *text, sbf_code code, uint32_t line, const char *path, int64_t index) {
  sbf_diagnostic error;
  sbf_asset *asset = samples_load(text, &error);
  ck_assert_msg(!asset, "loads, and should not");
  ck_assert_msg(error.code == (int32_t)code, "code %d, not %d: %s", error.code, (int)code, error.message);
  ck_assert_uint_eq(error.line, line);
  if (path) ck_assert_str_eq(error.path, path);
  ck_assert_int_eq(error.index, index);
}

static int by_name(const void *a, const void *b) {
  return strcmp(*(char *const *)a, *(char *const *)b);
}

size_t samples_each(const char *folder, const char *ending, void (*each)(const char *path)) {
  char *paths[512];
  size_t count = 0;
  DIR *directory = opendir(harness_source(folder));
  ck_assert_msg(directory != NULL, "no folder %s", folder);
  for (struct dirent *entry; (entry = readdir(directory)) && count < 512;) {
    size_t length = strlen(entry->d_name), tail = strlen(ending);
    if (length < tail || strcmp(entry->d_name + length - tail, ending) != 0) continue;
    char relative[1024];
    snprintf(relative, sizeof relative, "%s/%s", folder, entry->d_name);
    paths[count++] = strdup(harness_source(relative));
  }
  closedir(directory);
  qsort(paths, count, sizeof *paths, by_name);
  for (size_t i = 0; i < count; i++) {
    each(paths[i]);
    free(paths[i]);
  }
  return count;
}
