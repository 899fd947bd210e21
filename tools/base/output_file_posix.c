#include "base/output_file.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/fault.h"

/* A signal handler only has static data: the file to delete and the process to kill. Set before the
 * handlers are installed, and cleared after their removal. */
static const int ending_signals[] = {SIGINT, SIGTERM, SIGHUP};
enum { ENDING_SIGNAL_COUNT = 3 };
static const char *volatile pending_path;
static volatile pid_t pending_process;
static bool is_busy;
static struct sigaction previous_actions[ENDING_SIGNAL_COUNT];

static void remove_and_end(int signal_number) {
  pid_t process = pending_process;
  if (process > 0) {
    /* Waits for it, so that it cannot recreate the file. */
    kill(process, SIGKILL);
    waitpid(process, NULL, 0);
  }
  if (pending_path) unlink(pending_path);
  /* SA_RESETHAND has restored the default action: raising again ends this process as intended. */
  raise(signal_number);
}

static void watch_signals(const char *temporary) {
  struct sigaction action = {.sa_handler = remove_and_end, .sa_flags = (int)SA_RESETHAND};
  sigemptyset(&action.sa_mask);
  pending_path = temporary;
  pending_process = 0;
  is_busy = true;
  for (int i = 0; i < ENDING_SIGNAL_COUNT; i++) {
    sigaction(ending_signals[i], NULL, &previous_actions[i]);
    if (previous_actions[i].sa_handler == SIG_DFL) sigaction(ending_signals[i], &action, NULL);
  }
}

static void unwatch_signals(void) {
  for (int i = 0; i < ENDING_SIGNAL_COUNT; i++)
    if (previous_actions[i].sa_handler == SIG_DFL) sigaction(ending_signals[i], &previous_actions[i], NULL);
  pending_path = NULL;
  pending_process = 0;
  is_busy = false;
}

void output_file_tie(intptr_t process) {
  pending_process = (pid_t)process;
}

/* `there`: an existing file, or NULL. Returns 0, or the errno. */
static int make_temporary(const char *path, const struct stat *there) {
  int why = 0;
  int file = open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file < 0) return errno;
  if (there && fchmod(file, there->st_mode & 0777) != 0) why = errno;
  if (close(file) != 0 && !why) why = errno;
  if (why) unlink(path);
  return why;
}

sbf_status output_file_begin(output_file *output, const char *path, sbf_diagnostic *diagnostic) {
  *output = (output_file){.given = path};
  if (is_busy)
    return fault_set_file(
        diagnostic, SBF_CODE_BAD_CALL, path, "another file is being written: one at a time");
  struct stat there, link;
  bool exists = stat(path, &there) == 0;
  /* Renaming would replace a dangling link by the file. */
  if (!exists && lstat(path, &link) == 0 && S_ISLNK(link.st_mode))
    return output_file_refuse(output, ENOENT, diagnostic);
  if (exists && S_ISDIR(there.st_mode)) return output_file_refuse(output, EISDIR, diagnostic);
  if (exists && access(path, W_OK) != 0) return output_file_refuse(output, errno, diagnostic);
  output->direct = exists && !S_ISREG(there.st_mode);
  output->final_path = exists && !output->direct ? realpath(path, NULL) : strdup(path);
  if (!output->final_path) return output_file_no_memory(output, diagnostic);
  size_t size = strlen(output->final_path) + 32;
  output->written_path = malloc(size);
  if (!output->written_path) return output_file_no_memory(output, diagnostic);
  if (output->direct) {
    memcpy(output->written_path, output->final_path, strlen(output->final_path) + 1);
    watch_signals(NULL);
    return SBF_OK;
  }
  snprintf(output->written_path, size, "%s.%ld.part", output->final_path, (long)getpid());
  int why = make_temporary(output->written_path, exists ? &there : NULL);
  if (why) return output_file_refuse(output, why, diagnostic);
  watch_signals(output->written_path);
  return SBF_OK;
}

sbf_status output_file_commit(output_file *output, sbf_diagnostic *diagnostic) {
  int why = 0;
  if (!output->direct && rename(output->written_path, output->final_path) != 0) {
    why = errno;
    unlink(output->written_path);
  }
  unwatch_signals();
  if (why) return output_file_refuse(output, why, diagnostic);
  output_file_release(output);
  return SBF_OK;
}

void output_file_abandon(output_file *output) {
  if (!output->written_path) return;
  if (!output->direct) unlink(output->written_path);
  unwatch_signals();
  output_file_release(output);
}
