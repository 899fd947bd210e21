#define _XOPEN_SOURCE 700
#include "harness.h"

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/file.h"
#include "base/unnamed_file.h"

static char folder[512]; /* absolute: a test changes the current folder */

/* A new empty folder for each test. */
static void setup(void) {
  char *root = realpath(harness_scratch(""), NULL);
  ck_assert_ptr_nonnull(root);
  snprintf(folder, sizeof folder, "%s/file-XXXXXX", root);
  free(root);
  ck_assert_ptr_nonnull(mkdtemp(folder));
}

static const char *in_folder(const char *name) {
  static char paths[4][1024];
  static int next;
  char *path = paths[next++ % 4];
  snprintf(path, sizeof paths[0], "%s/%s", folder, name);
  return path;
}

static int entries(void) {
  DIR *opened = opendir(folder);
  int count = 0;
  for (struct dirent *entry; (entry = readdir(opened));)
    count += strcmp(entry->d_name, ".") && strcmp(entry->d_name, "..");
  closedir(opened);
  return count;
}

static void teardown(void) {
  DIR *opened = opendir(folder);
  for (struct dirent *entry; (entry = readdir(opened));) unlink(in_folder(entry->d_name));
  closedir(opened);
  rmdir(folder);
}

static void expect_content(const char *path, const char *text) {
  size_t size = 0;
  char *content = harness_read(path, &size);
  ck_assert_ptr_nonnull(content);
  ck_assert_str_eq(content, text);
  free(content);
}

typedef sbf_status getter(
    const char *, uint64_t, const sbf_allocator *, sbfi_file_content *, sbf_diagnostic *);
static getter *const getters[] = {sbfi_file_map, sbfi_file_read};

START_TEST(mapped_and_read_files_have_equal_bytes)
{
  const size_t sizes[] = {1, 4096, 100000, 65536};
  uint8_t *bytes = malloc(100000);
  for (size_t i = 0; i < 100000; i++) bytes[i] = (uint8_t)(i * 31 + i / 251);
  for (size_t i = 0; i < 4; i++) {
    ck_assert(harness_write(in_folder("a"), bytes, sizes[i]));
    sbfi_file_content content;
    ck_assert_int_eq(getters[_i](in_folder("a"), sizes[i], NULL, &content, NULL), SBF_OK);
    ck_assert_uint_eq(content.size, sizes[i]);
    ck_assert_mem_eq(content.at, bytes, sizes[i]);
    sbfi_file_content_free(&content);
    ck_assert_ptr_null(content.at);
  }
  free(bytes);
}
END_TEST

START_TEST(an_empty_file_is_no_error)
{
  sbfi_file_content content;
  harness_memory memory;
  harness_memory_init(&memory, SIZE_MAX);
  harness_write(in_folder("empty"), "", 0);
  ck_assert_int_eq(getters[_i](in_folder("empty"), 0, &memory.allocator, &content, NULL), SBF_OK);
  ck_assert_ptr_null(content.at);
  ck_assert_uint_eq(content.size, 0);
  ck_assert_uint_eq(memory.held_bytes, 0);
}
END_TEST

START_TEST(unreadable_files_are_reported)
{
  sbfi_file_content content;
  sbf_diagnostic d;
  ck_assert_int_eq(getters[_i](in_folder("absent"), 0, NULL, &content, &d), SBF_FAILED);
  ck_assert_int_eq(d.code, SBF_CODE_IO_CANNOT_READ);
  ck_assert_str_eq(d.file, in_folder("absent"));
  ck_assert_ptr_nonnull(strstr(d.message, "No such file"));
  ck_assert_int_eq(getters[_i](folder, 0, NULL, &content, &d), SBF_FAILED);
  ck_assert_int_eq(d.code, SBF_CODE_IO_CANNOT_READ);
  ck_assert_ptr_null(content.at);
  harness_write(in_folder("a"), "12345", 5);
  ck_assert_int_eq(getters[_i](in_folder("a"), 4, NULL, &content, &d), SBF_BAD_INPUT);
  ck_assert_int_eq(d.code, SBF_CODE_IO_TOO_LARGE);
  ck_assert_ptr_null(content.at);
  ck_assert_int_eq(getters[_i](in_folder("absent"), 0, NULL, &content, NULL), SBF_FAILED);
}
END_TEST

/* A pipe of the given length in the place of a file. */
static pid_t feed_pipe(size_t length) {
  unlink(in_folder("pipe"));
  ck_assert_int_eq(mkfifo(in_folder("pipe"), 0600), 0);
  pid_t writer = fork();
  if (writer == 0) {
    signal(SIGPIPE, SIG_IGN);
    FILE *out = fopen(in_folder("pipe"), "wb");
    for (size_t i = 0; i < length; i++) fputc((int)(i % 251), out);
    fclose(out);
    _exit(0);
  }
  return writer;
}

START_TEST(a_pipe_is_read_to_its_end)
{
  sbfi_file_content content;
  sbf_diagnostic d;
  pid_t writer = feed_pipe(200000);
  ck_assert_int_eq(getters[_i](in_folder("pipe"), 0, NULL, &content, NULL), SBF_OK);
  waitpid(writer, NULL, 0);
  ck_assert_uint_eq(content.size, 200000);
  for (size_t i = 0; i < content.size; i++)
    if (content.at[i] != i % 251) ck_abort_msg("byte %zu", i);
  sbfi_file_content_free(&content);
  writer = feed_pipe(200000);
  ck_assert_int_eq(getters[_i](in_folder("pipe"), 100000, NULL, &content, &d), SBF_BAD_INPUT);
  waitpid(writer, NULL, 0);
  ck_assert_int_eq(d.code, SBF_CODE_IO_TOO_LARGE);
  ck_assert_ptr_null(content.at);
}
END_TEST

START_TEST(reading_survives_every_failing_allocation)
{
  for (size_t allowed = 0;; allowed++) {
    sbfi_file_content content;
    sbf_diagnostic d;
    harness_memory memory;
    harness_memory_init(&memory, allowed);
    pid_t writer = feed_pipe(200000);
    sbf_status status = sbfi_file_read(in_folder("pipe"), 0, &memory.allocator, &content, &d);
    waitpid(writer, NULL, 0);
    if (status == SBF_OK) {
      ck_assert_uint_ge(allowed, 2);
      ck_assert_uint_eq(content.size, 200000);
      sbfi_file_content_free(&content);
    } else {
      ck_assert_int_eq(status, SBF_FAILED);
      ck_assert_int_eq(d.code, SBF_CODE_OUT_OF_MEMORY);
      ck_assert_ptr_null(content.at);
    }
    ck_assert_uint_eq(memory.held_bytes, 0);
    if (status == SBF_OK) break;
  }
}
END_TEST

START_TEST(any_range_is_read_by_offset)
{
  sbfi_file file;
  sbf_diagnostic d;
  char part[8] = "";
  harness_write(in_folder("a"), "0123456789", 10);
  ck_assert_int_eq(sbfi_file_open(in_folder("a"), &file, &d), SBF_OK);
  ck_assert_uint_eq(file.size, 10);
  ck_assert_int_eq(sbfi_file_read_at(&file, 7, part, 3, &d), SBF_OK);
  ck_assert_str_eq(part, "789");
  ck_assert_int_eq(sbfi_file_read_at(&file, 0, part, 2, &d), SBF_OK);
  ck_assert_str_eq(part, "019");
  ck_assert_int_eq(sbfi_file_read_at(&file, 10, part, 0, &d), SBF_OK);
  const uint64_t behind[] = {8, 10, 1000, UINT64_MAX};
  for (int i = 0; i < 4; i++) {
    ck_assert_int_eq(sbfi_file_read_at(&file, behind[i], part, 3, &d), SBF_FAILED);
    ck_assert_int_eq(d.code, SBF_CODE_IO_CANNOT_READ);
    ck_assert_ptr_nonnull(strstr(d.message, "truncated"));
  }
  sbfi_file_close(&file);
  ck_assert_int_eq(sbfi_file_open(in_folder("absent"), &file, &d), SBF_FAILED);
  ck_assert_int_eq(d.code, SBF_CODE_IO_CANNOT_READ);
  sbfi_file_close(&file);
  ck_assert_int_eq(sbfi_file_open("/dev/null", &file, &d), SBF_FAILED);
}
END_TEST

START_TEST(pieces_add_up_to_the_file)
{
  sbfi_file_writer writer;
  size_t size;
  enum { SMALL = 30000, LARGE = 200000 };
  char *large = malloc(LARGE);
  memset(large, 'x', LARGE);
  ck_assert_int_eq(sbfi_file_writer_open(&writer, in_folder("a"), NULL, NULL), SBF_OK);
  for (int i = 0; i < SMALL; i++) ck_assert_int_eq(sbfi_file_writer_write(&writer, "abcde", 5, NULL), SBF_OK);
  ck_assert_int_eq(sbfi_file_writer_write(&writer, large, LARGE, NULL), SBF_OK);
  ck_assert_int_eq(sbfi_file_writer_write(&writer, "", 0, NULL), SBF_OK);
  ck_assert_uint_eq(writer.written_bytes, 5 * SMALL + LARGE);
  ck_assert_int_eq(access(in_folder("a"), F_OK), -1);
  ck_assert_int_eq(sbfi_file_writer_commit(&writer, NULL), SBF_OK);
  char *content = harness_read(in_folder("a"), &size);
  ck_assert_uint_eq(size, 5 * SMALL + LARGE);
  for (int i = 0; i < SMALL; i++) ck_assert(memcmp(content + 5 * i, "abcde", 5) == 0);
  ck_assert_mem_eq(content + 5 * SMALL, large, LARGE);
  ck_assert_int_eq(entries(), 1);
  free(content);
  free(large);
}
END_TEST

/* So that nothing is left behind by a process that ends meanwhile. */
START_TEST(a_file_has_no_name_before_it_is_whole)
{
  sbfi_file_writer writer;
  int probe = sbfi_unnamed_file_open(folder);
  bool has_unnamed = probe >= 0;
  if (has_unnamed) close(probe);
  ck_assert_int_eq(sbfi_file_writer_open(&writer, in_folder("a"), NULL, NULL), SBF_OK);
  ck_assert_int_eq(sbfi_file_writer_write(&writer, "new", 3, NULL), SBF_OK);
  ck_assert_int_eq(entries(), has_unnamed ? 0 : 1);
  sbfi_file_writer_abandon(&writer);
  ck_assert_int_eq(entries(), 0);
  ck_assert_int_eq(chdir(folder), 0); /* and have no folder in its path */
  ck_assert_int_eq(sbfi_file_writer_open(&writer, "b", NULL, NULL), SBF_OK);
  ck_assert_int_eq(entries(), has_unnamed ? 0 : 1);
  ck_assert_int_eq(sbfi_file_writer_commit(&writer, NULL), SBF_OK);
  ck_assert_int_eq(entries(), 1);
  expect_content(in_folder("b"), "");
}
END_TEST

START_TEST(the_old_file_remains_until_commit)
{
  sbfi_file_writer writer;
  sbf_diagnostic d;
  harness_write(in_folder("a"), "old", 3);
  ck_assert_int_eq(sbfi_file_writer_open(&writer, in_folder("a"), NULL, NULL), SBF_OK);
  ck_assert_int_eq(sbfi_file_writer_write(&writer, "new", 3, NULL), SBF_OK);
  expect_content(in_folder("a"), "old");
  sbfi_file_writer_abandon(&writer);
  expect_content(in_folder("a"), "old");
  ck_assert_int_eq(entries(), 1);
  sbfi_file_writer_abandon(&writer);
  ck_assert_int_eq(sbfi_file_writer_write(&writer, "new", 3, &d), SBF_FAILED);
  ck_assert_int_eq(d.code, SBF_CODE_BAD_CALL);
  ck_assert_int_eq(sbfi_file_writer_commit(&writer, &d), SBF_FAILED);
  ck_assert_int_eq(sbfi_file_write(in_folder("a"), "new", 3, NULL, NULL), SBF_OK);
  expect_content(in_folder("a"), "new");
  ck_assert_int_eq(entries(), 1);
}
END_TEST

/* A full disk, as the limit on the size of files. */
START_TEST(a_failing_write_leaves_the_old_file_alone)
{
  char *large = calloc(1, 300000);
  sbf_diagnostic d;
  harness_write(in_folder("a"), "old", 3);
  signal(SIGXFSZ, SIG_IGN);
  struct rlimit limit = {100000, RLIM_INFINITY};
  ck_assert_int_eq(setrlimit(RLIMIT_FSIZE, &limit), 0);
  ck_assert_int_eq(sbfi_file_write(in_folder("a"), large, 300000, NULL, &d), SBF_FAILED);
  ck_assert_int_eq(d.code, SBF_CODE_IO_CANNOT_WRITE);
  ck_assert_str_eq(d.file, in_folder("a"));

  sbfi_file_writer writer; /* one that goes on after the failure, and one that meets it in the commit */
  ck_assert_int_eq(sbfi_file_writer_open(&writer, in_folder("a"), NULL, NULL), SBF_OK);
  ck_assert_int_eq(sbfi_file_writer_write(&writer, large, 300000, NULL), SBF_FAILED);
  ck_assert_int_eq(sbfi_file_writer_write(&writer, "x", 1, NULL), SBF_FAILED);
  ck_assert_int_eq(sbfi_file_writer_commit(&writer, &d), SBF_FAILED);
  ck_assert_int_eq(d.code, SBF_CODE_IO_CANNOT_WRITE);
  ck_assert_int_eq(sbfi_file_writer_open(&writer, in_folder("a"), NULL, NULL), SBF_OK);
  ck_assert_int_eq(sbfi_file_writer_write(&writer, large, 60000, NULL), SBF_OK);
  ck_assert_int_eq(sbfi_file_writer_write(&writer, large, 60000, NULL), SBF_OK);
  ck_assert_int_eq(sbfi_file_writer_commit(&writer, &d), SBF_FAILED);
  limit.rlim_cur = RLIM_INFINITY;
  setrlimit(RLIMIT_FSIZE, &limit);
  expect_content(in_folder("a"), "old");
  ck_assert_int_eq(entries(), 1);
  free(large);
}
END_TEST

START_TEST(failed_writes_are_reported)
{
  sbf_diagnostic d;
  ck_assert_int_eq(sbfi_file_write(in_folder("absent/a"), "x", 1, NULL, &d), SBF_FAILED);
  ck_assert_int_eq(d.code, SBF_CODE_IO_CANNOT_WRITE);
  ck_assert_str_eq(d.file, in_folder("absent/a"));
  ck_assert_int_eq(sbfi_file_write(folder, "x", 1, NULL, &d), SBF_FAILED);
  ck_assert_int_eq(d.code, SBF_CODE_IO_CANNOT_WRITE);
  ck_assert_int_eq(sbfi_file_write("", "x", 1, NULL, &d), SBF_FAILED);
  if (geteuid() != 0) { /* root may write anything */
    harness_write(in_folder("a"), "old", 3);
    chmod(in_folder("a"), 0444);
    ck_assert_int_eq(sbfi_file_write(in_folder("a"), "x", 1, NULL, &d), SBF_FAILED);
    expect_content(in_folder("a"), "old");
  }
}
END_TEST

START_TEST(permissions_and_links_are_kept)
{
  struct stat facts;
  umask(022);
  ck_assert_int_eq(sbfi_file_write(in_folder("a"), "1", 1, NULL, NULL), SBF_OK);
  stat(in_folder("a"), &facts);
  ck_assert_uint_eq(facts.st_mode & 0777, 0644);
  chmod(in_folder("a"), 0660);
  ck_assert_int_eq(symlink("a", in_folder("link")), 0);
  ck_assert_int_eq(sbfi_file_write(in_folder("link"), "2", 1, NULL, NULL), SBF_OK);
  expect_content(in_folder("a"), "2");
  stat(in_folder("a"), &facts);
  ck_assert_uint_eq(facts.st_mode & 0777, 0660);
  lstat(in_folder("link"), &facts);
  ck_assert(S_ISLNK(facts.st_mode));
  ck_assert_int_eq(entries(), 2);
}
END_TEST

/* A file in its place would be one that nobody named; as root that link may be /dev/stdout. */
START_TEST(a_dangling_link_is_not_replaced)
{
  struct stat facts;
  sbf_diagnostic d;
  ck_assert_int_eq(symlink("absent", in_folder("link")), 0);
  ck_assert_int_eq(sbfi_file_write(in_folder("link"), "x", 1, NULL, &d), SBF_FAILED);
  ck_assert_int_eq(d.code, SBF_CODE_IO_CANNOT_WRITE);
  ck_assert_int_eq(lstat(in_folder("link"), &facts), 0);
  ck_assert(S_ISLNK(facts.st_mode));
  ck_assert_int_eq(entries(), 1);
}
END_TEST

START_TEST(a_name_may_be_as_long_as_the_system_allows)
{
  char name[256];
  memset(name, 'n', 255);
  name[255] = 0;
  ck_assert_int_eq(sbfi_file_write(in_folder(name), "x", 1, NULL, NULL), SBF_OK);
  expect_content(in_folder(name), "x");
  ck_assert_int_eq(chdir(folder), 0); /* and have no folder at all */
  ck_assert_int_eq(sbfi_file_write("plain", "y", 1, NULL, NULL), SBF_OK);
  expect_content(in_folder("plain"), "y");
}
END_TEST

START_TEST(a_device_is_written_in_place)
{
  struct stat facts;
  sbf_diagnostic d;
  ck_assert_int_eq(sbfi_file_write("/dev/null", "x", 1, NULL, &d), SBF_OK);
  ck_assert_int_eq(stat("/dev/null", &facts), 0);
  ck_assert(S_ISCHR(facts.st_mode));
  if (stat("/dev/full", &facts) == 0) {
    ck_assert_int_eq(sbfi_file_write("/dev/full", "x", 1, NULL, &d), SBF_FAILED);
    ck_assert_int_eq(d.code, SBF_CODE_IO_CANNOT_WRITE);
    ck_assert_int_eq(stat("/dev/full", &facts), 0);
    ck_assert(S_ISCHR(facts.st_mode));
  }
}
END_TEST

START_TEST(a_failed_allocation_leaves_no_file)
{
  harness_memory memory;
  sbf_diagnostic d;
  harness_memory_init(&memory, 0);
  ck_assert_int_eq(sbfi_file_write(in_folder("a"), "x", 1, &memory.allocator, &d), SBF_FAILED);
  ck_assert_int_eq(d.code, SBF_CODE_OUT_OF_MEMORY);
  ck_assert_int_eq(entries(), 0);
  harness_memory_init(&memory, 1); /* it takes one block */
  ck_assert_int_eq(sbfi_file_write(in_folder("a"), "x", 1, &memory.allocator, &d), SBF_OK);
  ck_assert_uint_eq(memory.held_bytes, 0);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("file_posix");
  TCase *c = tcase_create("read");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_loop_test(c, mapped_and_read_files_have_equal_bytes, 0, 2);
  tcase_add_loop_test(c, an_empty_file_is_no_error, 0, 2);
  tcase_add_loop_test(c, unreadable_files_are_reported, 0, 2);
  tcase_add_loop_test(c, a_pipe_is_read_to_its_end, 0, 2);
  tcase_add_test(c, reading_survives_every_failing_allocation);
  tcase_add_test(c, any_range_is_read_by_offset);
  suite_add_tcase(s, c);
  c = tcase_create("write");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, pieces_add_up_to_the_file);
  tcase_add_test(c, a_file_has_no_name_before_it_is_whole);
  tcase_add_test(c, the_old_file_remains_until_commit);
  tcase_add_test(c, a_failing_write_leaves_the_old_file_alone);
  tcase_add_test(c, failed_writes_are_reported);
  tcase_add_test(c, permissions_and_links_are_kept);
  tcase_add_test(c, a_dangling_link_is_not_replaced);
  tcase_add_test(c, a_name_may_be_as_long_as_the_system_allows);
  tcase_add_test(c, a_device_is_written_in_place);
  tcase_add_test(c, a_failed_allocation_leaves_no_file);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
