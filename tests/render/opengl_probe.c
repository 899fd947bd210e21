#define _POSIX_C_SOURCE 200809L

#include "opengl_probe.h"

#include <stdio.h>
#include <sys/wait.h>
#include <unistd.h>

#include "render/canvas.h"
#include "sbfmt/codes.h"

bool opengl_probe(void) {
  int status = 0;
  fflush(NULL);
  pid_t child = fork();
  if (child == 0) {
    draw_canvas *canvas;
    sbf_diagnostic why = {0};
    draw_canvas_open(&canvas, 8, 8, DRAW_CANVAS_MOVIE, &why);
    if (why.code == SBF_CODE_NO_OPENGL) fprintf(stderr, "skipped: %s\n", why.message);
    fflush(stderr);
    _exit(why.code == SBF_CODE_NO_OPENGL);
  }
  /* Anything but a plain lack is for the tests to find. */
  return child < 0 || waitpid(child, &status, 0) < 0 || !WIFEXITED(status) || WEXITSTATUS(status) == 0;
}
