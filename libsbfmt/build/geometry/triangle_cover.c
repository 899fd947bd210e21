#include "build/geometry/triangle_cover.h"

#include <math.h>

enum { MAX_CORNERS = 9 }; /* a triangle clipped three times has six */
static const double AREA_SLACK = 1e-6;

/* Coordinate system of a triangle: origin at its first corner, x along its first edge, z above it. */
typedef struct plane_frame {
  double origin[3], axes[3][3];
  double corners[3][2];
  double area; /* twice the area */
} plane_frame;

typedef struct covering {
  const sbfi_triangle_tree *by;
  plane_frame frame;
  double max, area; /* twice the area covered so far */
} covering;

typedef struct outline {
  double at[MAX_CORNERS][3];
  int count;
} outline;

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void into_frame(const plane_frame *f, const double from[3], double to[3]) {
  double direction[3];
  for (int k = 0; k < 3; k++) direction[k] = from[k] - f->origin[k];
  for (int k = 0; k < 3; k++) to[k] = dot(f->axes[k], direction);
}

static bool make_frame(plane_frame *f, const double corners[3][3]) {
  double side[3], other[3], normal[3], at[3];
  for (int k = 0; k < 3; k++) {
    f->origin[k] = corners[0][k];
    side[k] = corners[1][k] - corners[0][k];
    other[k] = corners[2][k] - corners[0][k];
  }
  for (int k = 0; k < 3; k++)
    normal[k] = side[(k + 1) % 3] * other[(k + 2) % 3] - side[(k + 2) % 3] * other[(k + 1) % 3];
  double length = sqrt(dot(side, side));
  f->area = sqrt(dot(normal, normal));
  if (!(f->area > 1e-9 * length * length)) return false;
  for (int k = 0; k < 3; k++) f->axes[0][k] = side[k] / length;
  for (int k = 0; k < 3; k++) f->axes[2][k] = normal[k] / f->area;
  for (int k = 0; k < 3; k++)
    f->axes[1][k] =
        f->axes[2][(k + 1) % 3] * f->axes[0][(k + 2) % 3] - f->axes[2][(k + 2) % 3] * f->axes[0][(k + 1) % 3];
  for (int c = 0; c < 3; c++) {
    into_frame(f, corners[c], at);
    f->corners[c][0] = at[0], f->corners[c][1] = at[1];
  }
  return true;
}

/* Clips to the left of the edge from `a` to `b` (Sutherland and Hodgman). */
static void cut(outline *o, const double a[2], const double b[2]) {
  outline kept = {.count = 0};
  for (int i = 0; i < o->count; i++) {
    const double *p = o->at[i], *q = o->at[(i + 1) % o->count];
    double here = (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
    double next = (b[0] - a[0]) * (q[1] - a[1]) - (b[1] - a[1]) * (q[0] - a[0]);
    if (here >= 0 && kept.count < MAX_CORNERS) {
      for (int k = 0; k < 3; k++) kept.at[kept.count][k] = p[k];
      kept.count++;
    }
    if ((here > 0 && next < 0) || (here < 0 && next > 0)) {
      double fraction = here / (here - next);
      if (kept.count >= MAX_CORNERS) continue;
      for (int k = 0; k < 3; k++) kept.at[kept.count][k] = p[k] + fraction * (q[k] - p[k]);
      kept.count++;
    }
  }
  *o = kept;
}

static bool add_cover(void *user, uint32_t triangle) {
  covering *c = user;
  outline o = {.count = 3};
  for (int k = 0; k < 3; k++) {
    sbf_vec3 at = c->by->positions[c->by->triangles[triangle].points[k]];
    into_frame(&c->frame, (double[]){(double)at.x, (double)at.y, (double)at.z}, o.at[k]);
  }
  double doubled_area = (o.at[1][0] - o.at[0][0]) * (o.at[2][1] - o.at[0][1]) -
                        (o.at[1][1] - o.at[0][1]) * (o.at[2][0] - o.at[0][0]);
  if (!(doubled_area > 0)) return true; /* it faces away */
  for (int k = 0; k < 3; k++) cut(&o, c->frame.corners[k], c->frame.corners[(k + 1) % 3]);
  double area = 0;
  for (int i = 0; i < o.count; i++) {
    const double *p = o.at[i], *q = o.at[(i + 1) % o.count];
    if (fabs(p[2]) > c->max) return true;
    area += p[0] * q[1] - p[1] * q[0];
  }
  c->area += area;
  return true;
}

bool sbfi_triangle_is_covered(const sbfi_triangle_tree *by, const double corners[3][3], double max) {
  covering c = {.by = by, .max = max};
  sbfi_box box;
  if (!make_frame(&c.frame, corners)) return false;
  for (int k = 0; k < 3; k++) {
    double low = fmin(corners[0][k], fmin(corners[1][k], corners[2][k])) - max;
    double high = fmax(corners[0][k], fmax(corners[1][k], corners[2][k])) + max;
    box.low[k] = nextafterf((float)low, -INFINITY);
    box.high[k] = nextafterf((float)high, INFINITY);
  }
  sbfi_box_tree_visit(&by->tree, &box, add_cover, &c);
  return fabs(c.area - c.frame.area) <= AREA_SLACK * c.frame.area;
}
