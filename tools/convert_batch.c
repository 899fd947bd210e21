#include "convert_batch.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "sbfmt/io.h"

enum { MAX_PATH = 4096, MAX_ROW = 1024, MAX_JOBS = 256, HASH_TEXT = 17 };

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

static int by_name(const struct dirent **a, const struct dirent **b) {
  return strcmp((*a)->d_name, (*b)->d_name);
}

/* Hashes files beside the input with the same stem: buffers, material libraries. */
static void add_siblings(uint64_t *hash, const char *input) {
  char folder[MAX_PATH], path[MAX_PATH];
  const char *slash = strrchr(input, '/'), *name = slash ? slash + 1 : input, *dot = strrchr(name, '.');
  size_t stem = dot && dot != name ? (size_t)(dot - name) : strlen(name);
  struct dirent **entries;
  snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - input) : 1, slash ? input : ".");
  int count = scandir(*folder ? folder : "/", &entries, NULL, by_name);
  for (int i = 0; i < count; i++) {
    const char *other = entries[i]->d_name;
    bool beside = strncmp(other, name, stem) == 0 && other[stem] == '.' && strcmp(other, name) != 0;
    if (beside && snprintf(path, sizeof path, "%s/%s", folder, other) < (int)sizeof path)
      add_file(hash, path);
    free(entries[i]);
  }
  if (count >= 0) free(entries);
}

/* Hash of the input and of everything that its conversion depends on. */
static void hash_input(const cli_call *call, const char *input, char text[HASH_TEXT]) {
  uint64_t hash = 14695981039346656037u;
  struct stat program = {.st_size = 0}; /* another version of the program may convert differently */
  stat("/proc/self/exe", &program);
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
  if (good && rename(temporary, path) == 0) return true;
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
  struct dirent **entries;
  snprintf(path, sizeof path, "%s/.sbfmt", folder);
  int count = scandir(path, &entries, NULL, by_name);
  char *text = count >= 0 ? malloc(sizeof header + (size_t)count * MAX_ROW) : NULL;
  size_t used = sizeof header - 1;
  if (text) memcpy(text, header, used);
  for (int i = 0; i < count; i++) {
    const char *name = entries[i]->d_name, *dot = strrchr(name, '.');
    if (text && dot && strcmp(dot, ".tsv") == 0) {
      snprintf(out, sizeof out, "%.*s", (int)(dot - name), name);
      if (read_row(folder, out, row)) {
        memcpy(text + used, row, strlen(row));
        used += strlen(row);
      }
    }
    free(entries[i]);
  }
  if (count >= 0) free(entries);
  snprintf(path, sizeof path, "%s/summary.tsv", folder);
  if (text) write_whole(path, text, used);
  free(text);
}

/* --- Jobs ---------------------------------------------------------------------------------------------- */

typedef struct job {
  pid_t process; /* 0: none */
  int output;    /* its output, in an unnamed temporary file */
} job;

static double now_s(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void pass_on(int output) {
  char bytes[4096];
  ssize_t got;
  lseek(output, 0, SEEK_SET);
  while ((got = read(output, bytes, sizeof bytes)) > 0) fwrite(bytes, 1, (size_t)got, stderr);
  close(output);
}

/* Waits for one job, prints its output in one piece and returns its exit status. */
static int finish_one(job *jobs, long count) {
  int state;
  pid_t process = wait(&state);
  for (long i = 0; i < count; i++) {
    if (process <= 0 || jobs[i].process != process) continue;
    jobs[i].process = 0;
    pass_on(jobs[i].output);
    return WIFEXITED(state) ? WEXITSTATUS(state) : SBF_FAILED;
  }
  return SBF_OK;
}

static bool start(job *to, cli_call *call, const char *folder, const char *input, const char *out,
    const char *hash, convert_one *convert, void *user) {
  FILE *said = tmpfile();
  to->output = said ? dup(fileno(said)) : -1;
  if (said) fclose(said);
  fflush(NULL);
  to->process = to->output < 0 ? -1 : fork();
  if (to->process < 0) {
    if (to->output >= 0) close(to->output);
    to->process = 0;
    return false;
  }
  if (to->process > 0) return true;
  dup2(to->output, STDERR_FILENO);
  double from = now_s();
  int status = convert(call, input, out, user);
  cli_print_counted(call);
  write_row(folder, input, out, status, now_s() - from, hash);
  fflush(NULL);
  _exit(status);
}

static bool is_unchanged(const char *folder, const char *out, const char *hash) {
  char row[MAX_ROW];
  return access(out, R_OK) == 0 && read_row(folder, out, row) && ends_with_hash(row, hash);
}

int convert_batch(
    cli_call *call, const char *folder, long jobs, convert_path *path_of, convert_one *convert, void *user) {
  char path[MAX_PATH], row[MAX_ROW], hash[HASH_TEXT];
  job running[MAX_JOBS] = {{0}};
  long busy = 0;
  int worst = SBF_OK, unchanged = 0, status;
  if (jobs <= 0) jobs = sysconf(_SC_NPROCESSORS_ONLN);
  jobs = jobs < 1 ? 1 : jobs > MAX_JOBS ? MAX_JOBS : jobs;
  if (snprintf(path, sizeof path, "%s/.sbfmt", folder) >= (int)sizeof path ||
      (mkdir(path, 0777) != 0 && errno != EEXIST))
    return cli_wrong(call, "the folder %s cannot be made: %s", path, strerror(errno));
  for (int i = 0; i < call->input_count; i++) {
    long index = 0;
    if (!path_of(call, folder, call->inputs[i], path, sizeof path)) continue; /* checked before */
    hash_input(call, call->inputs[i], hash);
    if (is_unchanged(folder, path, hash)) {
      unchanged++;
      continue;
    }
    for (; busy >= jobs; busy--)
      if ((status = finish_one(running, jobs)) > worst) worst = status;
    while (running[index].process) index++;
    if (start(&running[index], call, folder, call->inputs[i], path, hash, convert, user))
      busy++;
    else
      worst = cli_wrong(call, "no process can be started for %s: %s", call->inputs[i], strerror(errno));
  }
  for (; busy > 0; busy--)
    if ((status = finish_one(running, jobs)) > worst) worst = status;
  write_summary(folder);
  printf("%-36s %-10s %-8s %4s %6s %10s %8s\n", "file", "status", "kind", "legs", "bodies", "visits", "s");
  for (int i = 0; i < call->input_count; i++) {
    char name[256], state[32], kind[32] = "", legs[16], bodies[16], visits[32], bytes[32], seconds[32];
    if (!path_of(call, folder, call->inputs[i], path, sizeof path) || !read_row(folder, path, row)) continue;
    if (sscanf(row, "%255[^\t]\t%31[^\t]\t%31[^\t]\t%15[^\t]\t%15[^\t]\t%31[^\t]\t%31[^\t]\t%31[^\t]", name,
            state, kind, legs, bodies, visits, bytes, seconds) == 8)
      printf("%-36s %-10s %-8s %4s %6s %10s %8s\n", name, state, kind, legs, bodies, visits, seconds);
    else
      printf("%-36s failed\n", name_of(call->inputs[i]));
  }
  printf("%d files, %d unchanged; all of the folder: %s/summary.tsv\n", call->input_count, unchanged, folder);
  return worst;
}
