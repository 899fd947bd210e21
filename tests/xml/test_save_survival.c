/* What is left of a file when saving it goes wrong: the disk is full, or the process is killed at any moment.
 * The old file stays whole until the new one is, and what else is left behind can be told by its name. */
#define _GNU_SOURCE
#include <dirent.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#ifdef __linux__
#include <sys/mount.h>
#endif

#include "base/unnamed_file.h"
#include "fill_asset.h"
#include "harness.h"
#include "sbfmt/io.h"

enum { FORMS = 2, SKIPPED = 77 };
static const char *const names[FORMS] = {"a.sbf", "a.sbfz"};

/* Two assets as files, in both forms. */
typedef struct version {
  sbf_asset *asset;
  sbf_buffer bytes[FORMS];
} version;
static version older, newer;
static const sbf_save_options stored = {.store = true}; /* the writing shall take the time, not the packing */

static void make(version *v, uint64_t seed, uint32_t items) {
  v->asset = fill_asset(&(fill_options){.seed = seed, .items = items});
  ck_assert_ptr_nonnull(v->asset);
  ck_assert_int_eq(sbf_xml_save_memory(v->asset, NULL, NULL, &v->bytes[0], NULL), SBF_OK);
  ck_assert_int_eq(sbf_packed_save_memory(v->asset, &stored, NULL, &v->bytes[1], NULL), SBF_OK);
}

static void setup(void) {
  make(&older, 1, 200);
  make(&newer, 2, 1500);
}

static void teardown(void) {
  version *const both[] = {&older, &newer};
  for (int i = 0; i < 2; i++) {
    sbf_asset_free(both[i]->asset);
    for (int form = 0; form < FORMS; form++) sbf_buffer_free(&both[i]->bytes[form]);
  }
}

static const char *in(const char *folder, const char *name) {
  static char paths[4][1024];
  static int next;
  char *path = paths[next++ % 4];
  snprintf(path, sizeof paths[0], "%s/%s", folder, name);
  return path;
}

static bool has_bytes(const char *path, const sbf_buffer *bytes) {
  size_t size = 0;
  char *content = harness_read(path, &size);
  bool same = content && size == bytes->size && memcmp(content, bytes->at, size) == 0;
  free(content);
  return same;
}

/* The name that packed.h states: .sbf-, eight hexadecimal digits, .tmp */
static bool is_left_over(const char *name) {
  return strlen(name) == 17 && memcmp(name, ".sbf-", 5) == 0 && strspn(name + 5, "0123456789abcdef") == 8 &&
         strcmp(name + 13, ".tmp") == 0;
}

/* Removes left-overs and counts them; -1 where there is anything but them and the file itself. */
static int clear_left_overs(const char *folder, const char *own) {
  DIR *opened = opendir(folder);
  int count = 0;
  bool strange = !opened;
  for (struct dirent *entry; opened && (entry = readdir(opened));) {
    const char *name = entry->d_name;
    if (is_left_over(name) && ++count)
      unlink(in(folder, name));
    else if (strcmp(name, own) && strcmp(name, ".") && strcmp(name, ".."))
      strange = true;
  }
  if (opened) closedir(opened);
  return strange ? -1 : count;
}

static void make_folder(char *folder, size_t size) {
  snprintf(folder, size, "%s-XXXXXX", harness_scratch("survival"));
  ck_assert_ptr_nonnull(mkdtemp(folder));
}

/* Whether files there have no name before they are whole, so that nothing is left of them. */
static bool has_unnamed(const char *folder) {
  int handle = sbfi_unnamed_file_open(folder);
  if (handle >= 0) close(handle);
  return handle >= 0;
}

static void remove_folder(const char *folder, const char *own) {
  unlink(in(folder, own));
  rmdir(folder);
}

/* --- killed --- */

/* A process that saves the one and the other until it is ended. */
static void save_for_ever(const char *path) {
  for (int i = 0;; i++)
    if (sbf_save_file((i % 2 ? &newer : &older)->asset, path, &stored, NULL) != SBF_OK) _exit(EXIT_FAILURE);
}

START_TEST(a_kill_at_any_moment)
{
  enum { KILLS = 60 };
  char folder[600];
  int form = _i, left_overs = 0;
  uint64_t random = 7;
  make_folder(folder, sizeof folder);
  const char *name = names[form];
  ck_assert_int_eq(sbf_save_file(older.asset, in(folder, name), &stored, NULL), SBF_OK);
  for (int i = 0; i < KILLS; i++) {
    pid_t child = fork();
    ck_assert_int_ge(child, 0);
    if (child == 0) save_for_ever(in(folder, name));
    random = random * UINT64_C(6364136223846793005) + 1442695040888963407;
    nanosleep(&(struct timespec){0, (long)(random >> 40) % 30000000}, NULL);
    kill(child, SIGKILL);
    int status;
    waitpid(child, &status, 0);
    ck_assert(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
    ck_assert_msg(
        has_bytes(in(folder, name), &older.bytes[form]) || has_bytes(in(folder, name), &newer.bytes[form]),
        "after kill %d the file is neither the old nor the new one", i);
    int found = clear_left_overs(folder, name);
    ck_assert_msg(found == 0 || found == 1, "%d files were left behind", found);
    left_overs += found;
  }
  fprintf(stderr, "%s: %d kills, %d left a temporary file\n", name, KILLS, left_overs);
  /* Between its naming and its renaming a file has a temporary name for a moment. */
  if (has_unnamed(folder)) ck_assert_int_le(left_overs, KILLS / 4);
  remove_folder(folder, name);
}
END_TEST

/* Ended by the system at an exact byte of the file written: SIGXFSZ, where the size is bounded. */
START_TEST(termination_at_any_byte)
{
  char folder[600];
  int form = _i;
  make_folder(folder, sizeof folder);
  const char *name = names[form];
  size_t whole = newer.bytes[form].size;
  ck_assert_int_eq(sbf_save_file(older.asset, in(folder, name), &stored, NULL), SBF_OK);
  for (size_t bound = 0; bound < whole; bound += whole / 23 + 1) {
    pid_t child = fork();
    ck_assert_int_ge(child, 0);
    if (child == 0) {
      struct rlimit limit = {bound, bound};
      signal(SIGXFSZ, SIG_DFL);
      setrlimit(RLIMIT_CORE, &(struct rlimit){0, 0});
      setrlimit(RLIMIT_FSIZE, &limit);
      _exit(sbf_save_file(newer.asset, in(folder, name), &stored, NULL) == SBF_OK ? EXIT_SUCCESS
                                                                                  : EXIT_FAILURE);
    }
    int status;
    waitpid(child, &status, 0);
    ck_assert(WIFSIGNALED(status) && WTERMSIG(status) == SIGXFSZ);
    ck_assert(has_bytes(in(folder, name), &older.bytes[form]));
    ck_assert_int_eq(clear_left_overs(folder, name), has_unnamed(folder) ? 0 : 1);
  }
  remove_folder(folder, name);
}
END_TEST

/* --- a full disk --- */

#ifdef __linux__
enum { DISK_BYTES = 1 << 25, BLOCK = 4096 };

/* In a process and a mount name space of its own, so that nothing of it outlives the test. */
static bool mount_small_disk(const char *folder) {
  char options[64];
  snprintf(options, sizeof options, "size=%d", DISK_BYTES);
  if (unshare(CLONE_NEWNS) != 0 && unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return false;
  if (mount("none", "/", NULL, MS_REC | MS_PRIVATE, NULL) != 0) return false;
  return mount("sbfmt-test", folder, "tmpfs", 0, options) == 0;
}

#define MUST(condition)                                                                                      \
  do {                                                                                                       \
    if (!(condition)) {                                                                                      \
      fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition);                                        \
      _exit(EXIT_FAILURE);                                                                                   \
    }                                                                                                        \
  } while (0)

/* Fills the disk but for `left` bytes, then saves over the old file. */
static void save_with_room(const char *folder, int form, size_t left, int *saved, int *refused) {
  static const char block[BLOCK];
  const char *name = names[form];
  char ballast[700];
  snprintf(ballast, sizeof ballast, "%s/ballast", folder);
  sbf_diagnostic error = {0};
  MUST(sbf_save_file(older.asset, in(folder, name), &stored, NULL) == SBF_OK);
  FILE *filler = fopen(ballast, "wb");
  MUST(filler);
  size_t filled = 0;
  setvbuf(filler, NULL, _IONBF, 0);
  while (fwrite(block, 1, BLOCK, filler) == BLOCK) filled += BLOCK;
  fclose(filler);
  MUST(filled > left && truncate(ballast, (off_t)(filled - left)) == 0);
  sbf_status status = sbf_save_file(newer.asset, in(folder, name), &stored, &error);
  if (status == SBF_OK) {
    MUST(has_bytes(in(folder, name), &newer.bytes[form]));
    ++*saved;
  } else {
    MUST(status == SBF_FAILED && error.code == SBF_CODE_IO_CANNOT_WRITE && error.message[0]);
    MUST(strcmp(error.file, in(folder, name)) == 0);
    MUST(has_bytes(in(folder, name), &older.bytes[form]));
    ++*refused;
  }
  unlink(ballast);
  MUST(clear_left_overs(folder, name) == 0);
}

static void try_full_disk(const char *folder, int form) {
  int saved = 0, refused = 0;
  size_t whole = newer.bytes[form].size;
  if (!mount_small_disk(folder)) _exit(SKIPPED);
  MUST(whole + older.bytes[form].size < DISK_BYTES / 2);
  for (size_t left = 0; left < whole + 3 * BLOCK; left += whole / 12 + BLOCK)
    save_with_room(folder, form, left, &saved, &refused);
  save_with_room(folder, form, whole + 2 * BLOCK, &saved, &refused);
  fprintf(stderr, "%s: refused %d times on a full disk, saved %d times with room enough\n", names[form],
      refused, saved);
  _exit(saved > 0 && refused > 1 ? EXIT_SUCCESS : EXIT_FAILURE);
}

START_TEST(a_full_disk)
{
  char folder[600];
  make_folder(folder, sizeof folder);
  pid_t child = fork();
  ck_assert_int_ge(child, 0);
  if (child == 0) try_full_disk(folder, _i);
  int status;
  waitpid(child, &status, 0);
  rmdir(folder);
  ck_assert(WIFEXITED(status));
  if (WEXITSTATUS(status) == SKIPPED)
    harness_skip("no disk may be mounted here");
  else
    ck_assert_int_eq(WEXITSTATUS(status), EXIT_SUCCESS);
}
END_TEST
#endif

int main(void) {
  Suite *suite = suite_create("save_survival");
  TCase *tests = tcase_create("save_survival");
  tcase_add_unchecked_fixture(tests, setup, teardown);
  tcase_add_loop_test(tests, a_kill_at_any_moment, 0, FORMS);
  tcase_add_loop_test(tests, termination_at_any_byte, 0, FORMS);
#ifdef __linux__
  tcase_add_loop_test(tests, a_full_disk, 0, FORMS);
#endif
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
