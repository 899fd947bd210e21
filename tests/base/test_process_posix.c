#define _XOPEN_SOURCE 700
#include "harness.h"

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "base/process.h"
#include "base/text.h"

/* This program plays the child too: `test_process_posix --as ROLE`. */
static char self[1024];

static sbf_status run(const char *role, const sbfi_process_limits *limits, sbfi_process_result *result) {
  const char *arguments[] = {self, "--as", role, "an argument", NULL};
  sbf_diagnostic d = {.code = 0};
  sbf_status status = sbfi_process_run(arguments, limits, NULL, result, &d);
  ck_assert_msg(status == SBF_OK, "%s", d.message);
  return status;
}

static void flood(FILE *to, size_t bytes) {
  for (size_t i = 0; i < bytes; i++) fputc("0123456789\n"[i % 11], to);
}

static int play(const char *role, int count) {
  if (!strcmp(role, "three")) return count == 4 ? 3 : 99;
  if (!strcmp(role, "both")) {
    flood(stderr, 300000);
    flood(stdout, 300000);
    fputs("\xE2\x82\xACthe end \xFF\n\n", stderr);
    return 0;
  }
  if (!strcmp(role, "crash")) {
    signal(SIGSEGV, SIG_DFL);
    return raise(SIGSEGV);
  }
  if (!strcmp(role, "sleep")) {
    puts("before");
    fflush(stdout);
    for (;;) pause();
  }
  if (!strcmp(role, "silent")) { /* alive with both pipes closed, then ends */
    fclose(stdout);
    fclose(stderr);
    struct timespec little = {0, 30000000};
    nanosleep(&little, NULL);
    return 5;
  }
  if (!strcmp(role, "spin")) {
    for (volatile unsigned i = 0;; i = i + 1) {}
  }
  if (!strcmp(role, "endless")) {
    for (;;) puts("and on");
  }
  if (!strcmp(role, "orphan")) { /* leaves a program behind that holds both pipes */
    if (fork() == 0)
      for (;;) pause();
    puts("done");
    return 0;
  }
  if (!strcmp(role, "allocate")) {
    char *volatile much = malloc((size_t)1 << 30); /* that no compiler takes it for granted */
    puts(much ? "granted" : "refused");
    free(much);
    return 0;
  }
  if (!strcmp(role, "inherited")) {
    int found = 0;
    sigset_t blocked;
    struct sigaction action;
    for (int i = 3; i < 300; i++) found += fcntl(i, F_GETFD) >= 0;
    sigprocmask(SIG_SETMASK, NULL, &blocked);
    sigaction(SIGPIPE, NULL, &action);
    printf("%d %d %d %d", found, sigismember(&blocked, SIGTERM), action.sa_handler == SIG_IGN, getchar());
    return 0;
  }
  return 98;
}

START_TEST(the_exit_status_is_returned)
{
  sbfi_process_result result;
  run("three", &(sbfi_process_limits){0}, &result);
  ck_assert_int_eq(result.end, SBFI_PROCESS_EXITED);
  ck_assert_int_eq(result.exit_status, 3);
  ck_assert_int_eq(result.signal, 0);
  ck_assert_ptr_null(result.output);
  ck_assert_str_eq(result.error_tail, "");
  char line[80];
  sbfi_process_describe(&result, line, sizeof line);
  ck_assert_str_eq(line, "ended with status 3");
  sbfi_process_result_free(&result);
}
END_TEST

START_TEST(all_output_and_the_end_of_errors_are_stored)
{
  sbfi_process_result result;
  run("both", &(sbfi_process_limits){.output_bytes = 300000}, &result);
  ck_assert_int_eq(result.end, SBFI_PROCESS_EXITED);
  ck_assert_uint_eq(result.output_size, 300000);
  for (size_t i = 0; i < result.output_size; i++)
    if (result.output[i] != "0123456789\n"[i % 11]) ck_abort_msg("byte %zu", i);
  size_t length = strlen(result.error_tail);
  ck_assert_uint_gt(length, 400);
  ck_assert_uint_eq(sbfi_utf8_check(result.error_tail, length), length);
  const char *end = "\xE2\x82\xACthe end ?";
  ck_assert_str_eq(result.error_tail + length - strlen(end), end);
  sbfi_process_result_free(&result);
}
END_TEST

START_TEST(a_crash_is_a_result)
{
  sbfi_process_result result;
  char line[80];
  run("crash", &(sbfi_process_limits){0}, &result);
  ck_assert_int_eq(result.end, SBFI_PROCESS_KILLED);
  ck_assert_int_eq(result.signal, SIGSEGV);
  sbfi_process_describe(&result, line, sizeof line);
  ck_assert_ptr_nonnull(strstr(line, "signal 11"));
  sbfi_process_result_free(&result);
}
END_TEST

START_TEST(limits_terminate_the_program)
{
  sbfi_process_result result;
  run("sleep", &(sbfi_process_limits){.wall_ms = 300}, &result);
  ck_assert_int_eq(result.end, SBFI_PROCESS_TIMED_OUT);
  ck_assert_int_eq(result.signal, SIGKILL);
  sbfi_process_result_free(&result);
  run("spin", &(sbfi_process_limits){.cpu_s = 1}, &result);
  ck_assert_int_eq(result.end, SBFI_PROCESS_CPU_LIMIT);
  sbfi_process_result_free(&result);
  run("endless", &(sbfi_process_limits){.output_bytes = 1000}, &result);
  ck_assert_int_eq(result.end, SBFI_PROCESS_OUTPUT_TOO_LARGE);
  ck_assert_uint_eq(result.output_size, 1000);
  sbfi_process_result_free(&result);
}
END_TEST

START_TEST(memory_is_limited)
{
#if defined(__SANITIZE_ADDRESS__)
  harness_skip("AddressSanitizer reserves more memory than the limit");
  return;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
  harness_skip("AddressSanitizer reserves more memory than the limit");
  return;
#endif
#endif
  sbfi_process_result result;
  run("allocate", &(sbfi_process_limits){.memory_bytes = 256 << 20}, &result);
  ck_assert_mem_eq(result.output, "refused", 7);
  sbfi_process_result_free(&result);
  run("allocate", &(sbfi_process_limits){0}, &result);
  ck_assert_mem_eq(result.output, "granted", 7);
  sbfi_process_result_free(&result);
}
END_TEST

START_TEST(closed_pipes_do_not_end_the_wait)
{
  sbfi_process_result result;
  run("silent", &(sbfi_process_limits){.wall_ms = 60000}, &result);
  ck_assert_int_eq(result.end, SBFI_PROCESS_EXITED);
  ck_assert_int_eq(result.exit_status, 5);
  sbfi_process_result_free(&result);
}
END_TEST

START_TEST(remaining_children_do_not_block_the_caller)
{
  sbfi_process_result result;
  run("orphan", &(sbfi_process_limits){0}, &result);
  ck_assert_int_eq(result.end, SBFI_PROCESS_EXITED);
  ck_assert_uint_eq(result.output_size, 5);
  sbfi_process_result_free(&result);
}
END_TEST

START_TEST(no_descriptors_are_inherited)
{
  sbfi_process_result result;
  int pinned = fcntl(1, F_DUPFD, 100); /* not close-on-exec */
  ck_assert_int_ge(pinned, 100);
  sigset_t set, now;
  sigemptyset(&set);
  sigaddset(&set, SIGTERM);
  sigprocmask(SIG_BLOCK, &set, NULL);
  signal(SIGPIPE, SIG_IGN);
  run("inherited", &(sbfi_process_limits){0}, &result);
  ck_assert_uint_eq(result.output_size, 8);
  ck_assert_mem_eq(result.output, "0 0 0 -1", 8);
  sbfi_process_result_free(&result);
  sigprocmask(SIG_SETMASK, NULL, &now); /* and the host's mask is unchanged */
  ck_assert(sigismember(&now, SIGTERM) && !sigismember(&now, SIGUSR1));
  close(pinned);
}
END_TEST

START_TEST(a_host_without_standard_descriptors_will_do)
{
  int kept[3];
  for (int i = 0; i < 3; i++) kept[i] = fcntl(i, F_DUPFD_CLOEXEC, 50);
  for (int i = 0; i < 3; i++) close(i);
  sbfi_process_result result;
  const char *arguments[] = {self, "--as", "both", NULL};
  sbf_status status = sbfi_process_run(arguments, &(sbfi_process_limits){0}, NULL, &result, NULL);
  for (int i = 0; i < 3; i++) dup2(kept[i], i);
  ck_assert_int_eq(status, SBF_OK);
  ck_assert_uint_eq(result.output_size, 300000);
  ck_assert_uint_gt(strlen(result.error_tail), 400);
  sbfi_process_result_free(&result);
}
END_TEST

START_TEST(unsupported_files_are_reported)
{
  const char *absent[] = {"/nowhere/to/be/found", NULL}, *folder[] = {"/", NULL};
  sbfi_process_result result;
  sbf_diagnostic d;
  ck_assert_int_eq(sbfi_process_run(absent, &(sbfi_process_limits){0}, NULL, &result, &d), SBF_FAILED);
  ck_assert_int_eq(d.code, SBF_CODE_IO_CANNOT_RUN);
  ck_assert_str_eq(d.file, absent[0]);
  ck_assert_ptr_nonnull(strstr(d.message, "No such file"));
  ck_assert_int_eq(sbfi_process_run(folder, &(sbfi_process_limits){0}, NULL, &result, &d), SBF_FAILED);
  ck_assert_int_eq(d.code, SBF_CODE_IO_CANNOT_RUN);
  signal(SIGCHLD, SIG_IGN); /* then the system tells nobody how a child ended */
  const char *arguments[] = {self, "--as", "three", NULL};
  ck_assert_int_eq(sbfi_process_run(arguments, &(sbfi_process_limits){0}, NULL, &result, &d), SBF_FAILED);
  ck_assert_int_eq(d.code, SBF_CODE_IO_CANNOT_RUN);
}
END_TEST

START_TEST(output_without_memory_is_an_error)
{
  const char *arguments[] = {self, "--as", "both", NULL};
  for (size_t allowed = 0;; allowed++) {
    sbfi_process_result result;
    sbf_diagnostic d;
    harness_memory memory;
    harness_memory_init(&memory, allowed);
    sbf_status status =
        sbfi_process_run(arguments, &(sbfi_process_limits){0}, &memory.allocator, &result, &d);
    ck_assert_int_eq(waitpid(-1, NULL, WNOHANG), -1); /* no child is left */
    if (status == SBF_OK) {
      ck_assert_uint_eq(result.output_size, 300000);
      sbfi_process_result_free(&result);
    } else {
      ck_assert_int_eq(d.code, SBF_CODE_OUT_OF_MEMORY);
    }
    ck_assert_uint_eq(memory.held_bytes, 0);
    if (status == SBF_OK) {
      ck_assert_uint_ge(allowed, 2);
      break;
    }
  }
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("process_posix");
  TCase *c = tcase_create("process");
  tcase_add_test(c, the_exit_status_is_returned);
  tcase_add_test(c, all_output_and_the_end_of_errors_are_stored);
  tcase_add_test(c, a_crash_is_a_result);
  tcase_add_test(c, limits_terminate_the_program);
  tcase_add_test(c, memory_is_limited);
  tcase_add_test(c, closed_pipes_do_not_end_the_wait);
  tcase_add_test(c, remaining_children_do_not_block_the_caller);
  tcase_add_test(c, no_descriptors_are_inherited);
  tcase_add_test(c, a_host_without_standard_descriptors_will_do);
  tcase_add_test(c, unsupported_files_are_reported);
  tcase_add_test(c, output_without_memory_is_an_error);
  suite_add_tcase(s, c);
  return s;
}

int main(int count, char **arguments) {
  if (count > 2 && !strcmp(arguments[1], "--as")) return play(arguments[2], count);
  if (!realpath(arguments[0], self)) return EXIT_FAILURE;
  return harness_run(suite());
}
