/* Writes a standalone page: the packed asset, the runtime as WebAssembly and its viewer, from a template
 * with {{words}} as placeholders. runtime/hosts/web builds the template and its parts. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/base64.h"
#include "base/file.h"
#include "base/module_path.h"
#include "export/exporting.h"
#include "sbfmt/packed.h"

enum { PATH_SIZE = 4096, LARGEST_PART = 64 << 20 };
static const char template_name[] = "viewer.html";

static bool is_file(const char *folder, const char *destination, char *to, size_t size) {
  char path[PATH_SIZE];
  sbfi_file file;
  int length = snprintf(path, sizeof path, "%s%s/%s", folder, destination, template_name);
  if (length <= 0 || (size_t)length >= sizeof path || sbfi_file_open(path, &file, NULL) != SBF_OK)
    return false;
  sbfi_file_close(&file);
  length = snprintf(to, size, "%s%s", folder, destination);
  return length > 0 && (size_t)length < size;
}

/* Searches from an installed program, an installed library (its folder may include the architecture), a
 * build tree. */
static bool find_from(const char *folder, char *to, size_t size) {
  static const char *const positions[] = {"/../share/sbfmt/web", "/../../share/sbfmt/web", "/../web"};
  for (size_t i = 0; i < sizeof positions / sizeof *positions; i++)
    if (is_file(folder, positions[i], to, size)) return true;
  return false;
}

static sbf_status find_parts(sbfi_export *e, char *to, size_t size) {
  char folder[PATH_SIZE];
  const char *stated = getenv("SBFMT_WEB");
  if (stated && *stated) {
    if (is_file(stated, "", to, size)) return SBF_OK;
    return sbfi_diagnose(e->error, SBF_CODE_EXPORT_PAGE_MISSING, "the folder %s, set by SBFMT_WEB, has no %s",
        stated, template_name);
  }
  if (sbfi_program_folder(folder, sizeof folder) && find_from(folder, to, size)) return SBF_OK;
  if (sbfi_library_folder(folder, sizeof folder) && find_from(folder, to, size)) return SBF_OK;
#ifdef SBFMT_DATA_FOLDER
  if (is_file(SBFMT_DATA_FOLDER, "/web", to, size)) return SBF_OK;
#endif
  return sbfi_diagnose(e->error, SBF_CODE_EXPORT_PAGE_MISSING,
      "this sbfmt was built without WebAssembly: build it where clang, lld, wasi-libc and "
      "libclang-rt-14-dev-wasm32 are installed, or name a folder with %s in SBFMT_WEB",
      template_name);
}

static void append_base64(sbfi_text *text, const uint8_t *bytes, size_t size) {
  if (!sbfi_base64_encode(text, bytes, size)) text->failed = true;
}

/* Page text must not contain tags or quotes. */
static void append_escaped(sbfi_text *text, const char *from) {
  for (; *from; from++) {
    const char *escaped = *from == '<'   ? "&lt;"
                          : *from == '>' ? "&gt;"
                          : *from == '&' ? "&amp;"
                          : *from == '"' ? "&quot;"
                                         : NULL;
    if (escaped)
      sbfi_text_string(text, escaped);
    else
      sbfi_text_char(text, *from);
  }
}

/* Appends a script without the lines that import others, which the page already contains. */
static void append_script(sbfi_text *text, const uint8_t *bytes, size_t size) {
  sbfi_span rest = {(const char *)bytes, size}, line;
  while (sbfi_span_next_line(&rest, &line)) {
    if (sbfi_span_begins(line, "import {")) continue;
    sbfi_text_append(text, line.at, line.length);
    sbfi_text_char(text, '\n');
  }
}

static sbf_status append_part(sbfi_export *e, const char *folder, sbfi_span name, bool as_base64) {
  char path[PATH_SIZE];
  sbfi_file_content part;
  int length = snprintf(path, sizeof path, "%s/%.*s", folder, (int)name.length, name.at);
  if (length <= 0 || (size_t)length >= sizeof path)
    return sbfi_diagnose(e->error, SBF_CODE_EXPORT_PAGE_MISSING, "the path of %s is too long", template_name);
  if (sbfi_file_read(path, LARGEST_PART, &e->allocator, &part, NULL) != SBF_OK)
    return sbfi_diagnose(
        e->error, SBF_CODE_EXPORT_PAGE_MISSING, "%s cannot be read: install sbfmt again", path);
  (as_base64 ? append_base64 : append_script)(&e->text, part.at, part.size);
  sbfi_file_content_free(&part);
  return SBF_OK;
}

static sbf_status append_bundle(sbfi_export *e) {
  sbf_buffer buffer = {0};
  sbf_status status = sbf_packed_save_memory(e->asset, NULL, &e->allocator, &buffer, e->error);
  if (status == SBF_OK) append_base64(&e->text, buffer.at, buffer.size);
  sbf_buffer_free(&buffer);
  return status;
}

/* Embeds image files of the asset into the page. */
static void append_images(sbfi_export *e) {
  for (uint32_t i = 0; i < e->asset->textures.count; i++) {
    const sbf_texture *texture = &e->asset->textures.at[i];
    char path[PATH_SIZE];
    sbfi_file_content image;
    if (texture->bytes.count || !*texture->path) continue;
    int length = snprintf(path, sizeof path, "%s/%s", e->folder ? e->folder : ".", texture->path);
    if (length <= 0 || (size_t)length >= sizeof path ||
        sbfi_file_read(path, LARGEST_PART, &e->allocator, &image, NULL) != SBF_OK) {
      sbfi_export_warn(
          e, "the image %s cannot be read: the page shows the plain colour instead", texture->path);
      continue;
    }
    sbfi_export_format(e, "<script type=\"text/plain\" data-texture=\"%u\">", (unsigned)i);
    append_base64(&e->text, image.at, image.size);
    sbfi_text_string(&e->text, "</script>\n");
    sbfi_file_content_free(&image);
  }
}

/* Replaces a word between {{ and }}. */
static sbf_status append_word(sbfi_export *e, const char *folder, sbfi_span word) {
  static const char file[] = "file ", bytes[] = "bytes ";
  const char *title = e->asset->info.title;
  if (sbfi_span_begins(word, file))
    return append_part(
        e, folder, (sbfi_span){word.at + sizeof file - 1, word.length - sizeof file + 1}, false);
  if (sbfi_span_begins(word, bytes))
    return append_part(
        e, folder, (sbfi_span){word.at + sizeof bytes - 1, word.length - sizeof bytes + 1}, true);
  if (sbfi_span_is(word, "bundle")) return append_bundle(e);
  if (sbfi_span_is(word, "images")) append_images(e);
  if (sbfi_span_is(word, "title")) append_escaped(&e->text, *title ? title : "sbfmt");
  return SBF_OK;
}

sbf_status sbfi_export_html(sbfi_export *e) {
  char folder[PATH_SIZE], path[PATH_SIZE + 16];
  sbfi_file_content page;
  sbf_status status = find_parts(e, folder, sizeof folder);
  if (status != SBF_OK) return status;
  snprintf(path, sizeof path, "%s/%s", folder, template_name);
  status = sbfi_file_read(path, LARGEST_PART, &e->allocator, &page, e->error);
  if (status != SBF_OK) return status;
  const char *at = (const char *)page.at, *end = at + page.size;
  for (const char *next = at; status == SBF_OK && at < end; at = next) {
    const char *open = at, *close;
    while (open + 1 < end && memcmp(open, "{{", 2) != 0) open++;
    if (open + 1 >= end) open = end;
    sbfi_text_append(&e->text, at, (size_t)(open - at));
    next = open;
    if (open == end) break;
    for (close = open; close + 1 < end && memcmp(close, "}}", 2) != 0;) close++;
    status = append_word(e, folder, (sbfi_span){open + 2, (size_t)(close - open - 2)});
    next = close + 2 < end ? close + 2 : end;
  }
  sbfi_file_content_free(&page);
  return status == SBF_OK ? sbfi_export_commit(e, e->path) : status;
}
