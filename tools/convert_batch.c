#include "convert_batch.h"

#include <errno.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "base/child_pipe.h"
#include "base/folder.h"
#include "base/system.h"
#include "sbfmt/io.h"
#include "thread_pool.h"

enum { MAX_PATH = 4096, MAX_ROW = 1024, MAX_JOBS = 64, HASH_TEXT = 17 };

static const char header[] = "file\tstatus\tkind\tlegs\tbodies\tvisits\tbytes\tseconds\thash\n";

/* --- What a conversion depends on -------------------------------------------------------------------- */

/* FNV-1a, 64 bits: detects changes, not forgery. */
static void add_bytes(uint64_t *hash, const void *bytes, size_t size) {
  for (size_t i = 0; i < size; i++) *hash = (*hash ^ ((const unsigned char *)bytes)[i]) * 1099511628211u;
}

static void add_text(uint64_t *hash, const char *text) {
  add_bytes(hash, text, strlen(text) + 1);
}

/* Hashes the content of a file; an unreadable file counts by its name. */
static void add_file(uint64_t *hash, const char *path) {
  unsigned char bytes[65536];
  struct stat about;
  size_t got;
  add_text(hash, path);
  FILE *file = stat(path, &about) == 0 && S_ISREG(about.st_mode) ? fopen(path, "rb") : NULL;
  while (file && (got = fread(bytes, 1, sizeof bytes, file)) > 0) add_bytes(hash, bytes, got);
  if (file) fclose(file);
}

/* Hashes files beside the input with the same stem: buffers, material libraries. */
static void add_siblings(uint64_t *hash, const char *input) {
  char folder[MAX_PATH], path[MAX_PATH];
  const char *slash = strrchr(input, '/'), *name = slash ? slash + 1 : input, *dot = strrchr(name, '.');
  size_t stem = dot && dot != name ? (size_t)(dot - name) : strlen(name);
  folder_names names;
  snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - input) : 1, slash ? input : ".");
  if (!folder_list(*folder ? folder : "/", &names)) return;
  for (size_t i = 0; i < names.count; i++) {
    const char *other = names.at[i];
    bool beside = strncmp(other, name, stem) == 0 && other[stem] == '.' && strcmp(other, name) != 0;
    if (beside && snprintf(path, sizeof path, "%s/%s", folder, other) < (int)sizeof path)
      add_file(hash, path);
  }
  folder_names_free(&names);
}

/* Hash of the input and of everything that its conversion depends on. */
static void hash_input(const cli_call *call, const char *input, char text[HASH_TEXT]) {
  uint64_t hash = 14695981039346656037u;
  struct stat program = {.st_size = 0}; /* another version of the program may convert differently */
  char program_path[MAX_PATH];
  if (system_program_path(program_path, sizeof program_path)) stat(program_path, &program);
  add_bytes(&hash, &program.st_size, sizeof program.st_size);
  add_bytes(&hash, &program.st_mtime, sizeof program.st_mtime);
  add_file(&hash, input);
  add_siblings(&hash, input);
  for (int i = 0; i < call->given_count; i++) {
    const char *option = call->verb->options[call->given[i].index].name;
    if (strcmp(option, "--out-dir") == 0 || strcmp(option, "--jobs") == 0) continue;
    add_text(&hash, option);
    add_file(&hash, call->given[i].value);
  }
  for (int i = 0; call->verb->options[i].name; i++)
    if (!call->verb->options[i].argument && call->values[i]) add_text(&hash, call->verb->options[i].name);
  snprintf(text, HASH_TEXT, "%016llx", (unsigned long long)hash);
}

/* --- Rows ---------------------------------------------------------------------------------------------- */

static const char *name_of(const char *path) {
  const char *slash = strrchr(path, '/');
  return slash ? slash + 1 : path;
}

static bool row_path(const char *folder, const char *out, char *path) {
  return snprintf(path, MAX_PATH, "%s/.sbfmt/%s.tsv", folder, name_of(out)) < MAX_PATH;
}

/* Writes a file atomically: completely or not at all. */
static bool write_whole(const char *path, const char *text, size_t size) {
  char temporary[MAX_PATH + 32];
  snprintf(temporary, sizeof temporary, "%s.%ld", path, (long)getpid());
  FILE *file = fopen(temporary, "wb");
  bool good = file && fwrite(text, 1, size, file) == size;
  if (file) good = fclose(file) == 0 && good;
  if (good && system_replace_file(temporary, path)) return true;
  remove(temporary);
  return false;
}

/* Reads the row of an earlier call; false if there is none. */
static bool read_row(const char *folder, const char *out, char row[MAX_ROW]) {
  char path[MAX_PATH];
  FILE *file = row_path(folder, out, path) ? fopen(path, "r") : NULL;
  bool good = file && fgets(row, MAX_ROW, file) != NULL;
  if (file) fclose(file);
  return good;
}

static bool ends_with_hash(const char *row, const char *hash) {
  const char *last = strrchr(row, '\t');
  size_t length = strlen(hash);
  return last && strncmp(last + 1, hash, length) == 0 && (last[1 + length] == '\n' || !last[1 + length]);
}

/* Element visits per tick at the finest levels. */
static double count_visits(const sbf_asset *asset) {
  double visits = 0;
  for (uint32_t b = 0; b < asset->soft_bodies.count; b++)
    if (asset->soft_bodies.at[b].levels.count)
      visits += (double)asset->soft_bodies.at[b].levels.at[0].simulation.cost;
  return visits;
}

/* Writes the row of a finished child process, from the bundle that it wrote. */
static void write_row(
    const char *folder, const char *input, const char *out, int status, double seconds, const char *hash) {
  char path[MAX_PATH], row[MAX_ROW];
  sbf_asset *asset = NULL;
  struct stat about = {.st_size = 0};
  if (status == SBF_OK && sbf_load_file(out, NULL, &asset, NULL) != SBF_OK) asset = NULL;
  if (status == SBF_OK) stat(out, &about);
  uint32_t legs = 0;
  const sbf_gait *gait = asset && asset->gaits.count ? &asset->gaits.at[0] : NULL;
  if (gait) legs = gait->legs.count;
  int length = snprintf(row, sizeof row, "%s\t%s\t%s\t%u\t%u\t%.0f\t%llu\t%.2f\t%s\n", name_of(input),
      status == SBF_OK ? "converted" : "failed",
      !asset ? ""
      : gait ? sbf_gait_kind_name(gait->kind)
             : "none",
      legs, asset ? asset->soft_bodies.count : 0, asset ? count_visits(asset) : 0,
      (unsigned long long)about.st_size, seconds, status == SBF_OK ? hash : "");
  sbf_asset_free(asset);
  if (length > 0 && length < MAX_ROW && row_path(folder, out, path)) write_whole(path, row, (size_t)length);
}

/* Writes all rows of the folder, sorted by name, to FOLDER/summary.tsv. */
static void write_summary(const char *folder) {
  char path[MAX_PATH], row[MAX_ROW], out[MAX_PATH];
  folder_names names;
  snprintf(path, sizeof path, "%s/.sbfmt", folder);
  if (!folder_list(path, &names)) return;
  char *text = malloc(sizeof header + names.count * MAX_ROW);
  size_t used = sizeof header - 1;
  if (text) memcpy(text, header, used);
  for (size_t i = 0; text && i < names.count; i++) {
    const char *name = names.at[i], *dot = strrchr(name, '.');
    if (!dot || strcmp(dot, ".tsv") != 0) continue;
    snprintf(out, sizeof out, "%.*s", (int)(dot - name), name);
    if (!read_row(folder, out, row)) continue;
    memcpy(text + used, row, strlen(row));
    used += strlen(row);
  }
  folder_names_free(&names);
  snprintf(path, sizeof path, "%s/summary.tsv", folder);
  if (text) write_whole(path, text, used);
  free(text);
}

/* --- Jobs ---------------------------------------------------------------------------------------------- */

/* Each input is converted by a process of its own: this program, called for that input alone. */
typedef struct batch {
  cli_call *call;
  const char *folder;
  convert_path *path_of;
  char program[MAX_PATH];
  const char **arguments; /* of every call: the options; the input and the output follow */
  size_t argument_count;
  pthread_mutex_t lock; /* of what follows, and of both outputs */
  int worst, unchanged;
} batch;

static double now_s(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* The command line of the call without what chooses inputs and outputs; false if memory runs out. */
static bool list_arguments(batch *b) {
  const cli_call *call = b->call;
  size_t capacity = 2 * ((size_t)call->given_count + CLI_MAX_OPTIONS) + 8;
  b->arguments = calloc(capacity, sizeof *b->arguments);
  if (!b->arguments) return false;
  b->arguments[b->argument_count++] = b->program;
  b->arguments[b->argument_count++] = call->verb->name;
  for (int i = 0; i < call->given_count; i++) {
    const char *option = call->verb->options[call->given[i].index].name;
    if (strcmp(option, "--out-dir") == 0 || strcmp(option, "--jobs") == 0) continue;
    b->arguments[b->argument_count++] = option;
    b->arguments[b->argument_count++] = call->given[i].value;
  }
  for (int i = 0; call->verb->options[i].name; i++)
    if (!call->verb->options[i].argument && call->values[i])
      b->arguments[b->argument_count++] = call->verb->options[i].name;
  if (call->verbose) b->arguments[b->argument_count++] = "--verbose";
  return true;
}

static void pass_on(FILE *from, FILE *to) {
  char bytes[4096];
  size_t got;
  rewind(from);
  while ((got = fread(bytes, 1, sizeof bytes, from)) > 0) fwrite(bytes, 1, got, to);
  fflush(to);
}

static bool is_unchanged(const char *folder, const char *out, const char *hash) {
  char row[MAX_ROW];
  FILE *there = fopen(out, "rb");
  if (there) fclose(there);
  return there && read_row(folder, out, row) && ends_with_hash(row, hash);
}

/* Converts one input and prints what its process printed in one piece. */
static int convert_one(batch *b, const char *input, const char *out, const char *hash) {
  const char *const last[] = {"-o", out, "--", input, NULL};
  const char **arguments = malloc(b->argument_count * sizeof *arguments + sizeof last);
  child_pipe child;
  double from = now_s();
  int error = ENOMEM;
  if (arguments) {
    memcpy(arguments, b->arguments, b->argument_count * sizeof *arguments);
    memcpy(arguments + b->argument_count, last, sizeof last);
    error = child_pipe_start(&child, arguments, true);
  }
  free(arguments);
  if (error) {
    pthread_mutex_lock(&b->lock);
    cli_wrong(b->call, "no process can be started for %s: %s", input, strerror(error));
    pthread_mutex_unlock(&b->lock);
    return SBF_FAILED;
  }
  int status = child_pipe_wait(&child);
  if (status < 0) status = SBF_FAILED;
  write_row(b->folder, input, out, status, now_s() - from, hash);
  pthread_mutex_lock(&b->lock);
  pass_on(child.wrote, stdout);
  pass_on(child.said, stderr);
  pthread_mutex_unlock(&b->lock);
  child_pipe_free(&child);
  return status;
}

static void convert_input(void *context, uint32_t index) {
  batch *b = context;
  const char *input = b->call->inputs[index];
  char path[MAX_PATH], hash[HASH_TEXT];
  if (!b->path_of(b->call, b->folder, input, path, sizeof path)) return; /* checked before */
  hash_input(b->call, input, hash);
  bool unchanged = is_unchanged(b->folder, path, hash);
  int status = unchanged ? SBF_OK : convert_one(b, input, path, hash);
  pthread_mutex_lock(&b->lock);
  b->unchanged += unchanged;
  if (status > b->worst) b->worst = status;
  pthread_mutex_unlock(&b->lock);
}

static void print_summary(const batch *b) {
  char path[MAX_PATH], row[MAX_ROW];
  printf("%-36s %-10s %-8s %4s %6s %10s %8s\n", "file", "status", "kind", "legs", "bodies", "visits", "s");
  for (int i = 0; i < b->call->input_count; i++) {
    const char *input = b->call->inputs[i];
    char name[256], state[32], kind[32] = "", legs[16], bodies[16], visits[32], bytes[32], seconds[32];
    if (!b->path_of(b->call, b->folder, input, path, sizeof path) || !read_row(b->folder, path, row))
      continue;
    if (sscanf(row, "%255[^\t]\t%31[^\t]\t%31[^\t]\t%15[^\t]\t%15[^\t]\t%31[^\t]\t%31[^\t]\t%31[^\t]", name,
            state, kind, legs, bodies, visits, bytes, seconds) == 8)
      printf("%-36s %-10s %-8s %4s %6s %10s %8s\n", name, state, kind, legs, bodies, visits, seconds);
    else
      printf("%-36s failed\n", name_of(input));
  }
  printf("%d files, %d unchanged; all of the folder: %s/summary.tsv\n", b->call->input_count, b->unchanged,
      b->folder);
}

int convert_batch(cli_call *call, const char *folder, long jobs, convert_path *path_of) {
  char path[MAX_PATH];
  batch b = {.call = call, .folder = folder, .path_of = path_of, .worst = SBF_OK};
  if (jobs <= 0) jobs = (long)system_processor_count();
  if (jobs > MAX_JOBS) jobs = MAX_JOBS;
  if (snprintf(path, sizeof path, "%s/.sbfmt", folder) >= (int)sizeof path || !system_make_folder(path))
    return cli_wrong(call, "the folder %s cannot be made: %s", path, strerror(errno));
  if (!system_program_path(b.program, sizeof b.program))
    return cli_wrong(call, "the system does not tell where this program is: convert one by one with -o");
  if (!list_arguments(&b)) return cli_wrong(call, "out of memory");
  pthread_mutex_init(&b.lock, NULL);
  thread_pool *pool = thread_pool_create((uint32_t)jobs); /* without one, one input after the other */
  sbr_tasks tasks = thread_pool_tasks(pool);
  if (tasks.run)
    tasks.run(tasks.user, convert_input, &b, (uint32_t)call->input_count);
  else
    for (int i = 0; i < call->input_count; i++) convert_input(&b, (uint32_t)i);
  thread_pool_destroy(pool);
  pthread_mutex_destroy(&b.lock);
  free(b.arguments);
  write_summary(folder);
  print_summary(&b);
  return b.worst;
}
