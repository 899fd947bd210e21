#include "base/child_pipe.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/system.h"

extern char **environ;

static int spawn(child_pipe *child, const char *const *arguments, int input) {
  posix_spawn_file_actions_t actions;
  pid_t process = 0;
  int error = posix_spawn_file_actions_init(&actions);
  if (error) return error;
  error = posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  if (!error) error = posix_spawn_file_actions_adddup2(&actions, fileno(child->said), STDERR_FILENO);
  /* The child's output must not mix with this program's. */
  if (!error && child->wrote)
    error = posix_spawn_file_actions_adddup2(&actions, fileno(child->wrote), STDOUT_FILENO);
  else if (!error)
    error = posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  /* posix_spawn takes char *const * for compatibility; it does not modify the strings. */
  if (!error)
    error =
        posix_spawnp(&process, arguments[0], &actions, NULL, (char *const *)(uintptr_t)arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  child->process = process;
  return error;
}

int child_pipe_start(child_pipe *child, const char *const *arguments, bool keeps_output) {
  *child = (child_pipe){.input = -1};
  /* A socket instead of a pipe, because sends can suppress SIGPIPE. */
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return errno;
  child->said = system_temporary_file();
  if (keeps_output) child->wrote = system_temporary_file();
  bool has_files = child->said && (child->wrote || !keeps_output);
  int error = has_files ? spawn(child, arguments, ends[1]) : errno;
  close(ends[1]);
  if (error) {
    close(ends[0]);
    child_pipe_free(child);
    return error;
  }
  shutdown(ends[0], SHUT_RD);
  child->input = ends[0];
  return 0;
}

bool child_pipe_write(child_pipe *child, const void *bytes, size_t size) {
  const char *at = bytes;
  while (size) {
    ssize_t sent = send((int)child->input, at, size, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    at += sent, size -= (size_t)sent;
  }
  return true;
}

int child_pipe_wait(child_pipe *child) {
  int status = 0;
  if (child->input >= 0) close((int)child->input);
  child->input = -1;
  while (waitpid((pid_t)child->process, &status, 0) < 0 && errno == EINTR) continue;
  child->process = 0;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

void child_pipe_kill(child_pipe *child) {
  if (child->process <= 0) return;
  kill((pid_t)child->process, SIGKILL);
  child_pipe_wait(child);
  child_pipe_free(child);
}
