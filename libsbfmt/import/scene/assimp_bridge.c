#include "import/scene/assimp_bridge.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/module_path.h"
#include "base/process.h"
#include "import/quote.h"
#include "import/scene/assembly.h"
#include "import/scene/ply_header.h"

static const char helper_name[] = SBFMT_IMPORT_PROGRAM;

enum { PATH_SIZE = 4096 };

/* Paths of the helper relative to the folder of the program or library: beside it, in an installed tree
 * (bin, or lib with or without the architecture), in a build tree. */
static const char *const positions[] = {
    "", "/../libexec/sbfmt", "/../../libexec/sbfmt", "/../libsbfmt", "/.."};

static bool find_from(const char *folder, char *to, size_t size) {
  for (size_t i = 0; i < sizeof positions / sizeof *positions; i++) {
    int length = snprintf(to, size, "%s%s/%s", folder, positions[i], helper_name);
    if (length > 0 && (size_t)length < size && sbfi_is_program(to)) return true;
  }
  return false;
}

static sbf_status helper_missing(sbf_diagnostic *error, const char *path, const char *from) {
  return sbfi_diagnose(error, SBF_CODE_IMPORT_HELPER_MISSING,
      "%s, set by %s, is not a program: reading this format needs the program %s", path, from, helper_name);
}

static sbf_status find_helper(const char *stated, char *to, size_t size, sbf_diagnostic *error) {
  const char *from = "the option";
  if (!stated || !*stated) {
    stated = getenv("SBFMT_IMPORT_HELPER");
    from = "SBFMT_IMPORT_HELPER";
  }
  if (stated && *stated) {
    /* Some systems would search PATH for a bare name: prefixes the current folder. */
    int length = snprintf(to, size, "%s%s", sbfi_path_name(stated) == stated ? "./" : "", stated);
    if (length < 0 || (size_t)length >= size || !sbfi_is_program(to))
      return helper_missing(error, stated, from);
    return SBF_OK;
  }
  char folder[PATH_SIZE];
  if (sbfi_library_folder(folder, sizeof folder) && find_from(folder, to, size)) return SBF_OK;
  if (sbfi_program_folder(folder, sizeof folder) && find_from(folder, to, size)) return SBF_OK;
#ifdef SBFMT_LIBEXEC_FOLDER
  if (find_from(SBFMT_LIBEXEC_FOLDER, to, size)) return SBF_OK;
#endif
  return sbfi_diagnose(error, SBF_CODE_IMPORT_HELPER_MISSING,
      "the program %s, which reads this format, is neither beside this program or library nor in the libexec "
      "folder of their installation: install it, or set SBFMT_IMPORT_HELPER to its path",
      helper_name);
}

/* Last line of the child's output without its full stop. */
static void last_words(const char *text, char *to, size_t size) {
  sbfi_span rest = sbfi_span_of(text), line, last = {"nothing", 7};
  while (sbfi_span_next_line(&rest, &line)) {
    line = sbfi_span_trim(line);
    if (line.length) last = line;
  }
  while (last.length && last.at[last.length - 1] == '.') last.length--;
  sbfi_quote_into(to, size, last);
}

static sbf_status limit_reached(sbf_diagnostic *error, const char *what) {
  return sbfi_diagnose(error, SBF_CODE_IMPORT_LIMIT,
      "reading took more %s than is allowed for a file of its size: it may be damaged; export it smaller or "
      "in another format",
      what);
}

/* Valid files take about a second for several megabytes; damaged ones can make assimp run forever. */
static double time_limit_s(const sbfi_scene_options *options, uint64_t size_bytes) {
  double by_size = 20 + 10e-6 * (double)size_bytes;
  if (options->helper_time_limit_s > 4e6) return 4e6; /* milliseconds must fit into 32 bits */
  if (options->helper_time_limit_s > 0) return options->helper_time_limit_s;
  return by_size < 120 ? by_size : 120;
}

static sbf_status check_exit(const sbfi_process_result *result, sbf_diagnostic *error) {
  char words[200];
  last_words(result->error_tail, words, sizeof words);
  switch (result->exit_status) {
  case SBFI_CHILD_DONE:
    return SBF_OK;
  case SBFI_CHILD_REFUSED:
    if (strstr(words, "could not open referenced file"))
      return sbfi_diagnose(error, SBF_CODE_IMPORT_REFUSED,
          "assimp refuses the file: %s; put the referenced file at that path, or export everything as one "
          ".glb",
          words);
    return sbfi_diagnose(error, SBF_CODE_IMPORT_REFUSED,
        "assimp refuses the file: %s; export it as a current FBX (2011 or later), glTF 2.0 or OBJ", words);
  case SBFI_CHILD_NOT_FINITE:
    return sbfi_diagnose(error, SBF_CODE_IMPORT_NOT_FINITE, "%s: export the file again", words);
  case SBFI_CHILD_NO_MEMORY:
    return limit_reached(error, "memory");
  default:
    return sbfi_diagnose(error, SBF_CODE_IMPORT_CRASHED,
        "the importer ended with status %d: \"%s\"; export the file again or in another format",
        result->exit_status, words);
  }
}

static sbf_status check_end(const sbfi_process_result *result, sbf_diagnostic *error) {
  char how[128];
  switch (result->end) {
  case SBFI_PROCESS_EXITED:
    return check_exit(result, error);
  case SBFI_PROCESS_TIMED_OUT:
  case SBFI_PROCESS_CPU_LIMIT:
    return limit_reached(error, "time");
  case SBFI_PROCESS_OUTPUT_TOO_LARGE:
    return limit_reached(error, "memory");
  case SBFI_PROCESS_KILLED:
    break;
  }
  sbfi_process_describe(result, how, sizeof how);
  return sbfi_diagnose(error, SBF_CODE_IMPORT_CRASHED,
      "assimp crashed on the file (%s): it is damaged or unusual; export it again or in another format", how);
}

/* Checks the file first, to distinguish a missing file from a rejected one, and to skip one that is too
 * large. */
static sbf_status check_input(const char *path, const char **format, const sbfi_scene_options *options,
    uint64_t *size_bytes, sbf_diagnostic *error) {
  char magic[4];
  size_t limit_bytes = options->input_limit_bytes;
  sbfi_file file;
  sbf_status status = sbfi_file_open(path, &file, error);
  if (status) return status;
  uint64_t size = *size_bytes = file.size;
  bool is_glb = size >= sizeof magic && sbfi_file_read_at(&file, 0, magic, sizeof magic, NULL) == SBF_OK &&
                memcmp(magic, "glTF", sizeof magic) == 0;
  if (is_glb) *format = "glb"; /* for any name */
  if (size && strcmp(*format, "ply") == 0) status = sbfi_ply_header_check(&file, options->allocator, error);
  sbfi_file_close(&file);
  if (status) return status;
  if (size == 0) return sbfi_diagnose(error, SBF_CODE_IMPORT_EMPTY, "the file is empty");
  if (size > limit_bytes)
    return sbfi_diagnose(error, SBF_CODE_IO_TOO_LARGE, "the file has %llu bytes, the limit is %zu",
        (unsigned long long)size, limit_bytes);
  return SBF_OK;
}

/* Lower case extension of the name, "" if there is none. */
static const char *format_of(sbfi_scene *scene, const char *path) {
  const char *dot = strrchr(sbfi_path_name(path), '.');
  char *format = (char *)sbfi_scene_string(scene, sbfi_span_of(dot ? dot + 1 : ""));
  for (char *c = format; c && *c; c++)
    if (*c >= 'A' && *c <= 'Z') *c = (char)(*c | 0x20);
  return format;
}

sbf_status sbfi_assimp_parse(sbfi_scene *scene, const uint8_t *bytes, size_t size,
    const sbf_allocator *allocator, sbf_diagnostic *error) {
  sbfi_raw_scene raw;
  sbfi_arena scratch;
  sbfi_arena_init(&scratch, allocator, 0);
  sbf_status status = sbfi_raw_scene_read(&raw, bytes, size, &scratch, error);
  if (!status) status = sbfi_assemble(scene, &raw, allocator, error);
  sbfi_arena_free(&scratch);
  return status;
}

sbf_status sbfi_assimp_read(
    sbfi_scene *scene, const char *path, const sbfi_scene_options *options, sbf_diagnostic *error) {
  char helper[PATH_SIZE];
  uint64_t size_bytes = 0;
  scene->format = format_of(scene, path);
  if (!scene->format) return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "no memory to read a scene");
  sbf_status status = check_input(path, &scene->format, options, &size_bytes, error);
  if (!status) status = find_helper(options->helper_path, helper, sizeof helper, error);
  if (status) return status;
  double seconds = time_limit_s(options, size_bytes);
  sbfi_process_limits limits = {.wall_ms = (uint32_t)(seconds * 1000),
      .cpu_s = (uint32_t)seconds + 1,
      .memory_bytes =
          options->helper_memory_limit_bytes ? options->helper_memory_limit_bytes : (uint64_t)8 << 30,
      .output_bytes = options->memory_limit_bytes};
  const char *arguments[] = {helper, path, NULL};
  sbfi_process_result result;
  status = sbfi_process_run(arguments, &limits, options->allocator, &result, error);
  if (status) return status;
  status = check_end(&result, error);
  if (!status)
    status = sbfi_assimp_parse(scene, result.output, result.output_size, options->allocator, error);
  sbfi_process_result_free(&result);
  return status;
}
