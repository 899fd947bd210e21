#include "build/weights/box_triangle.h"

/* Whether an axis separates the box and the triangle, both relative to the box's centre. */
static bool is_separated(sbfi_d3 axis, sbfi_d3 half, const sbfi_d3 corners[3]) {
  double a = sbfi_d3_dot(axis, corners[0]), b = sbfi_d3_dot(axis, corners[1]),
         c = sbfi_d3_dot(axis, corners[2]);
  double reach = fabs(axis.x) * half.x + fabs(axis.y) * half.y + fabs(axis.z) * half.z;
  return fmin(a, fmin(b, c)) > reach || fmax(a, fmax(b, c)) < -reach;
}

bool sbfi_box_overlaps_triangle(sbfi_d3 middle, sbfi_d3 half, const sbfi_d3 corners[3]) {
  static const sbfi_d3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  sbfi_d3 at[3], sides[3];
  for (int k = 0; k < 3; k++) at[k] = sbfi_d3_sub(corners[k], middle);
  for (int k = 0; k < 3; k++) sides[k] = sbfi_d3_sub(at[(k + 1) % 3], at[k]);
  for (int k = 0; k < 3; k++)
    if (is_separated(axes[k], half, at)) return false;
  if (is_separated(sbfi_d3_cross(sides[0], sides[1]), half, at)) return false;
  for (int k = 0; k < 9; k++)
    if (is_separated(sbfi_d3_cross(axes[k / 3], sides[k % 3]), half, at)) return false;
  return true;
}
