/* Child process with limits: fork, pipes, and a kill when time is up. */
#define _DEFAULT_SOURCE
#define _POSIX_C_SOURCE 200809L
#include "base/process.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#include <sys/syscall.h>
#endif

#include "base/text.h"

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define WITH_ADDRESS_SANITIZER 1
#endif
#endif
#ifdef __SANITIZE_ADDRESS__
#define WITH_ADDRESS_SANITIZER 1
#endif

enum {
  READ_BYTES = 1 << 16,
  POLL_MS = 50,      /* interval for detecting an end that no pipe shows */
  FIRST_POLL_MS = 2, /* the same once both pipes are closed and the end is near */
  LAST_DESCRIPTOR = 65536
};

typedef struct pipe_ends {
  int read, write;
} pipe_ends;

static void close_end(int *end) {
  if (*end >= 0) close(*end);
  *end = -1;
}

static void close_pipe(pipe_ends *p) {
  close_end(&p->read);
  close_end(&p->write);
}

/* Moves a descriptor above the standard three. A host may have closed those, and the child uses their
 * numbers. */
static bool lift(int *end) {
  if (*end > 2) return true;
  int lifted = fcntl(*end, F_DUPFD_CLOEXEC, 3);
  if (lifted < 0) return false;
  close(*end);
  *end = lifted;
  return true;
}

static bool open_pipe(pipe_ends *p) {
  int ends[2];
#if defined(__linux__) && defined(SYS_pipe2)
  /* Atomic: otherwise a program that another thread starts meanwhile would inherit the ends. */
  if (syscall(SYS_pipe2, ends, O_CLOEXEC) != 0) return false;
#else
  if (pipe(ends) != 0) return false;
  fcntl(ends[0], F_SETFD, FD_CLOEXEC);
  fcntl(ends[1], F_SETFD, FD_CLOEXEC);
#endif
  *p = (pipe_ends){ends[0], ends[1]};
  return lift(&p->read) && lift(&p->write);
}

static int64_t now_ms(void) {
  struct timespec now = {0, 0};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

/* From here to the exec: only calls that are safe after a fork in a program with threads. */

static void limit_resource(int resource, uint64_t soft, uint64_t hard) {
  struct rlimit limit;
  if (getrlimit(resource, &limit) != 0) return;
  if (limit.rlim_max == RLIM_INFINITY || hard < limit.rlim_max) limit.rlim_max = (rlim_t)hard;
  limit.rlim_cur = soft < limit.rlim_max ? (rlim_t)soft : limit.rlim_max;
  setrlimit(resource, &limit);
}

static void close_others_on_exec(void) {
#if defined(__linux__) && defined(SYS_close_range)
  enum { SET_CLOSE_ON_EXEC = 4 }; /* CLOSE_RANGE_CLOEXEC, since Linux 5.11 */
  if (syscall(SYS_close_range, 3u, ~0u, (unsigned)SET_CLOSE_ON_EXEC) == 0) return;
#endif
  struct rlimit limit;
  int last = LAST_DESCRIPTOR;
  if (getrlimit(RLIMIT_NOFILE, &limit) == 0 && limit.rlim_cur < LAST_DESCRIPTOR) last = (int)limit.rlim_cur;
  for (int i = 3; i < last; i++) fcntl(i, F_SETFD, FD_CLOEXEC);
}

static void default_signals(void) {
  struct sigaction standard;
  memset(&standard, 0, sizeof standard);
  standard.sa_handler = SIG_DFL;
  for (int i = 1; i < 65; i++) sigaction(i, &standard, NULL); /* fails for the few that cannot be set */
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, NULL);
}

_Noreturn static void become(const char *const *arguments, const sbfi_process_limits *limits, pid_t parent,
    int nothing, int output, int errors, int report) {
  setpgid(0, 0);
#ifdef __linux__
  /* Kills the child if the host is killed. */
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);
#else
  (void)parent;
#endif
  limit_resource(RLIMIT_CORE, 0, 0);
  /* The system kills it one second after the signal. */
  if (limits->cpu_s) limit_resource(RLIMIT_CPU, limits->cpu_s, (uint64_t)limits->cpu_s + 1);
#if !defined(WITH_ADDRESS_SANITIZER) && defined(RLIMIT_AS)
  if (limits->memory_bytes) limit_resource(RLIMIT_AS, limits->memory_bytes, limits->memory_bytes);
#endif
  if (dup2(nothing, 0) == 0 && dup2(output, 1) == 1 && dup2(errors, 2) == 2) {
    close_others_on_exec();
    default_signals();
    execv(arguments[0], (char *const *)arguments);
  }
  int number = errno;
  ssize_t put = write(report, &number, sizeof number);
  _exit(put == sizeof number ? 127 : 126);
}

/* The parent's state while the child runs. */
typedef struct child {
  pid_t id;
  int output, errors; /* our ends of its pipes; -1 after their end */
  sbfi_text kept;
  char tail[4096 + SBFI_PROCESS_ERROR_TAIL]; /* the end of its standard error, and space to read more */
  size_t tail_size;
  bool lost; /* someone else waited for it: its process id may belong to another program */
} child;

static bool dont_block(int descriptor) {
  int flags = fcntl(descriptor, F_GETFL);
  return flags >= 0 && fcntl(descriptor, F_SETFL, flags | O_NONBLOCK) == 0;
}

/* Starts the program; 0, or the error number, also of the child before the exec. */
static int start(child *c, const char *const *arguments, const sbfi_process_limits *limits) {
  pipe_ends output = {-1, -1}, errors = {-1, -1}, report = {-1, -1};
  int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC), number = 0;
  if (nothing < 0 || !lift(&nothing) || !open_pipe(&output) || !open_pipe(&errors) || !open_pipe(&report) ||
      !dont_block(output.read) || !dont_block(errors.read)) {
    number = errno;
  } else {
    /* The child must not run any handler of the host. */
    sigset_t all, before;
    pid_t parent = getpid();
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    c->id = fork();
    if (c->id == 0) become(arguments, limits, parent, nothing, output.write, errors.write, report.write);
    if (c->id < 0) number = errno;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
  }
  close_end(&nothing);
  close_end(&output.write);
  close_end(&errors.write);
  close_end(&report.write);
  if (number == 0) {
    /* The exec closes the report pipe; it has an error number only if the exec failed. */
    ssize_t got;
    do got = read(report.read, &number, sizeof number);
    while (got < 0 && errno == EINTR);
    if (got != sizeof number) number = 0;
    if (number != 0)
      while (waitpid(c->id, NULL, 0) < 0 && errno == EINTR) continue;
  }
  close_end(&report.read);
  if (number != 0) {
    close_pipe(&output);
    close_pipe(&errors);
  }
  c->output = output.read;
  c->errors = errors.read;
  return number;
}

/* Reads what is available; closes at the end. */
static ssize_t read_some(int *end, void *to, size_t size) {
  ssize_t got;
  do got = read(*end, to, size);
  while (got < 0 && errno == EINTR);
  if (got == 0 || (got < 0 && errno != EAGAIN && errno != EWOULDBLOCK)) close_end(end);
  return got > 0 ? got : 0;
}

/* Returns whether there was data; `kept.failed` is set if memory runs out. */
static bool read_output(child *c) {
  char *destination = c->output >= 0 ? sbfi_text_reserve(&c->kept, READ_BYTES) : NULL;
  size_t got = destination ? (size_t)read_some(&c->output, destination, READ_BYTES) : 0;
  c->kept.length += got;
  return got > 0;
}

static bool read_errors(child *c) {
  if (c->errors < 0) return false;
  size_t got = (size_t)read_some(&c->errors, c->tail + c->tail_size, sizeof c->tail - c->tail_size);
  c->tail_size += got;
  if (c->tail_size > SBFI_PROCESS_ERROR_TAIL) {
    memmove(c->tail, c->tail + c->tail_size - SBFI_PROCESS_ERROR_TAIL, SBFI_PROCESS_ERROR_TAIL);
    c->tail_size = SBFI_PROCESS_ERROR_TAIL;
  }
  return got > 0;
}

/* Whether the program has ended. It stays a zombie, so that its id (and its group's) is not reused. */
static bool has_ended(child *c) {
  siginfo_t info;
  memset(&info, 0, sizeof info);
  int found = waitid(P_PID, (id_t)c->id, &info, WEXITED | WNOHANG | WNOWAIT);
  c->lost = found != 0 && errno == ECHILD;
  return c->lost || (found == 0 && info.si_pid == c->id);
}

/* Kills the rest of the program and its children. */
static void kill_group(const child *c) {
  if (!c->lost) kill(-c->id, SIGKILL);
}

static void wait_for_more(const child *c, int64_t left_ms) {
  struct pollfd ends[2];
  nfds_t count = 0;
  if (c->output >= 0) ends[count++] = (struct pollfd){.fd = c->output, .events = POLLIN};
  if (c->errors >= 0) ends[count++] = (struct pollfd){.fd = c->errors, .events = POLLIN};
  int64_t poll_ms = count ? POLL_MS : FIRST_POLL_MS;
  poll(ends, count, (int)(left_ms < poll_ms ? left_ms : poll_ms));
}

/* Reads the pipes until the program ends or must be killed. */
static sbfi_process_end watch(child *c, const sbfi_process_limits *limits) {
  int64_t deadline = limits->wall_ms ? now_ms() + limits->wall_ms : INT64_MAX;
  bool ended = false;
  for (;;) {
    bool output_came = read_output(c), errors_came = read_errors(c);
    if (c->kept.failed) return SBFI_PROCESS_EXITED;
    if (limits->output_bytes && c->kept.length > limits->output_bytes) {
      c->kept.length = limits->output_bytes;
      return SBFI_PROCESS_OUTPUT_TOO_LARGE;
    }
    bool more = output_came || errors_came;
    if (ended && !more) return SBFI_PROCESS_EXITED;
    int64_t left_ms = deadline - now_ms();
    if (left_ms <= 0) return ended ? SBFI_PROCESS_EXITED : SBFI_PROCESS_TIMED_OUT;
    if (!ended && has_ended(c)) {
      /* Its remaining children could otherwise keep the pipes open, and write to them, forever. */
      kill_group(c);
      ended = true;
    } else if (!more) {
      wait_for_more(c, left_ms);
    }
  }
}

static double seconds_of(struct timeval t) {
  return (double)t.tv_sec + 1e-6 * (double)t.tv_usec;
}

static sbf_status cannot_run(sbf_diagnostic *error, const char *program, const char *what, int number) {
  char why[128];
  if (strerror_r(number, why, sizeof why) != 0) snprintf(why, sizeof why, "error %d", number);
  sbf_status status = sbfi_diagnose(error, SBF_CODE_IO_CANNOT_RUN, "cannot %s the program: %s", what, why);
  if (error) sbfi_copy_text(error->file, sizeof error->file, program);
  return status;
}

sbf_status sbfi_process_run(const char *const *arguments, const sbfi_process_limits *limits,
    const sbf_allocator *allocator, sbfi_process_result *result, sbf_diagnostic *error) {
  child c = {.output = -1, .errors = -1};
  *result = (sbfi_process_result){.allocator = sbfi_allocator_or_default(allocator)};
  sbfi_text_init(&c.kept, allocator);
  int number = start(&c, arguments, limits);
  if (number != 0) return cannot_run(error, arguments[0], "start", number);

  result->end = watch(&c, limits);
  kill_group(&c);
  close_end(&c.output);
  close_end(&c.errors);
  int status = 0;
  struct rusage used;
  pid_t waited;
  do waited = wait4(c.id, &status, 0, &used);
  while (waited < 0 && errno == EINTR);
  number = waited < 0 ? errno : 0;
  if (c.kept.failed || number != 0) {
    sbfi_text_free(&c.kept);
    if (number != 0) return cannot_run(error, arguments[0], "wait for", number);
    return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "no memory for the output of %s", arguments[0]);
  }
  if (WIFSIGNALED(status))
    result->signal = WTERMSIG(status);
  else
    result->exit_status = WEXITSTATUS(status);
  if (result->end == SBFI_PROCESS_EXITED && result->signal != 0) {
    bool used_up = limits->cpu_s && seconds_of(used.ru_utime) + seconds_of(used.ru_stime) >= limits->cpu_s;
    result->end = result->signal == SIGXCPU || (result->signal == SIGKILL && used_up) ? SBFI_PROCESS_CPU_LIMIT
                                                                                      : SBFI_PROCESS_KILLED;
  }
  sbfi_process_copy_tail(c.tail, c.tail_size, result->error_tail);
  if (c.kept.length == 0) sbfi_text_free(&c.kept);
  result->output = (uint8_t *)c.kept.at;
  result->output_size = c.kept.length;
  result->output_capacity = c.kept.capacity;
  return SBF_OK;
}
