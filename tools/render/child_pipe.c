#include "render/child_pipe.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

static int spawn(child_pipe *child, char *const *arguments, int input) {
  posix_spawn_file_actions_t actions;
  int error = posix_spawn_file_actions_init(&actions);
  if (error) return error;
  error = posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  if (!error) error = posix_spawn_file_actions_adddup2(&actions, fileno(child->said), STDERR_FILENO);
  /* The child's output must not mix with this program's. */
  if (!error) error = posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  if (!error) error = posix_spawnp(&child->process, arguments[0], &actions, NULL, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

int child_pipe_start(child_pipe *child, char *const *arguments) {
  *child = (child_pipe){.input = -1};
  /* A socket instead of a pipe, because sends can suppress SIGPIPE. */
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return errno;
  child->said = tmpfile();
  int error = child->said ? spawn(child, arguments, ends[1]) : errno;
  close(ends[1]);
  if (error) {
    close(ends[0]);
    if (child->said) fclose(child->said);
    *child = (child_pipe){.input = -1};
    return error;
  }
  shutdown(ends[0], SHUT_RD);
  child->input = ends[0];
  return 0;
}

bool child_pipe_write(child_pipe *child, const void *bytes, size_t size) {
  const char *at = bytes;
  while (size) {
    ssize_t sent = send(child->input, at, size, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    at += sent, size -= (size_t)sent;
  }
  return true;
}

static void copy_output(FILE *file, char *said, size_t size) {
  said[0] = 0;
  if (fseek(file, 0, SEEK_END) != 0) return;
  long end = ftell(file), start = end - (long)size + 1;
  if (fseek(file, start > 0 ? start : 0, SEEK_SET) != 0) return;
  size_t got = fread(said, 1, size - 1, file), kept = 0;
  const char *from = said;
  if (start > 0 && (from = memchr(said, '\n', got)) != NULL) from++;
  if (!from) from = said;
  for (const char *at = from; at < said + got; at++) {
    char c = *at;
    if (c == '\n' || c == '\r') c = kept && said[kept - 1] != ';' ? ';' : ' ';
    if ((c != ' ' || (kept && said[kept - 1] != ' ')) && (unsigned char)c >= ' ') said[kept++] = c;
  }
  while (kept && (said[kept - 1] == ';' || said[kept - 1] == ' ')) kept--;
  said[kept] = 0;
}

bool child_pipe_finish(child_pipe *child, char *said, size_t said_size) {
  int status = 0;
  if (child->input >= 0) close(child->input);
  child->input = -1;
  while (waitpid(child->process, &status, 0) < 0 && errno == EINTR) continue;
  copy_output(child->said, said, said_size);
  fclose(child->said);
  *child = (child_pipe){.input = -1};
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

void child_pipe_kill(child_pipe *child) {
  char said[2];
  if (child->process <= 0) return;
  kill(child->process, SIGKILL);
  child_pipe_finish(child, said, sizeof said);
}
