#define _POSIX_C_SOURCE 200809L

#include "opengl_probe.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include "harness.h"
#include "render/canvas.h"
#include "sbfmt/codes.h"

static bool can_draw;

void opengl_probe(void) {
  int status = 0;
  fflush(NULL);
  pid_t child = fork();
  if (child == 0) {
    draw_canvas *canvas;
    sbf_diagnostic why = {0};
    draw_canvas_open(&canvas, 8, 8, DRAW_CANVAS_MOVIE, &why);
    _exit(why.code == SBF_CODE_NO_OPENGL);
  }
  /* Anything but a plain lack is for the tests to find. */
  can_draw = child < 0 || waitpid(child, &status, 0) < 0 || !WIFEXITED(status) || WEXITSTATUS(status) == 0;
}

void opengl_needed(void) {
  if (can_draw) return;
  harness_skip_case(tcase_name(), "nothing can be drawn here: no OpenGL");
  _exit(EXIT_SUCCESS);
}
