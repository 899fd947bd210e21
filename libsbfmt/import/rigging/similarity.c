#include "import/rigging/similarity.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/diagnostic.h"
#include "import/scene/trs.h"
#include "mechanics/symmetric_eigen.h"
#include "motion/quatd.h"

const sbfi_usual_unit sbfi_usual_units[SBFI_USUAL_UNITS] = {{1, "metres"}, {0.01, "centimetres"},
    {0.001, "millimetres"}, {0.0254, "inches"}, {0.3048, "feet"}, {0.1, "decimetres"}, {100, NULL},
    {10, NULL}, {1000, "kilometres"}, {1 / 0.0254, NULL}, {1 / 0.3048, NULL}, {0.9144, "yards"}};

sbfi_matrix sbfi_axis_rotation(uint32_t number) {
  static const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}};
  uint32_t found = 0;
  for (int mirrored = 0; mirrored < 2; mirrored++)
    for (int order = 0; order < 6; order++)
      for (int signs = 0; signs < 8; signs++) {
        int negative = (signs & 1) + (signs >> 1 & 1) + (signs >> 2 & 1);
        if ((order >= 3) != ((negative + mirrored) % 2 == 1)) continue;
        if (found++ != number) continue;
        sbfi_matrix m = {.at[3][3] = 1};
        for (int r = 0; r < 3; r++) m.at[r][orders[order][r]] = signs >> r & 1 ? -1 : 1;
        return m;
      }
  return sbfi_matrix_identity();
}

sbfi_d3 sbfi_similarity_apply(const sbfi_matrix *m, sbfi_d3 p) {
  double out[3];
  for (int r = 0; r < 3; r++)
    out[r] = m->at[r][0] * p.x + m->at[r][1] * p.y + m->at[r][2] * p.z + m->at[r][3];
  return (sbfi_d3){out[0], out[1], out[2]};
}

sbfi_matrix sbfi_similarity_scaled(const sbfi_matrix *rotation, double scale, sbfi_d3 offset) {
  double old = sbfi_similarity_scale(rotation);
  sbfi_matrix m = *rotation;
  for (int r = 0; r < 3; r++)
    for (int k = 0; k < 3; k++) m.at[r][k] *= scale / old;
  m.at[0][3] = offset.x;
  m.at[1][3] = offset.y;
  m.at[2][3] = offset.z;
  return m;
}

double sbfi_similarity_scale(const sbfi_matrix *m) {
  double squared = 0;
  for (int r = 0; r < 3; r++)
    for (int k = 0; k < 3; k++) squared += m->at[r][k] * m->at[r][k];
  return sqrt(squared / 3);
}

/* Columns: along the first side, across it in the plane, and out of the plane. */
static bool frame_of(const sbfi_d3 at[3], double frame[3][3]) {
  sbfi_d3 x = sbfi_d3_normal(sbfi_d3_sub(at[1], at[0]));
  sbfi_d3 z = sbfi_d3_normal(sbfi_d3_cross(x, sbfi_d3_sub(at[2], at[0])));
  sbfi_d3 y = sbfi_d3_cross(z, x);
  const sbfi_d3 columns[3] = {x, y, z};
  for (int k = 0; k < 3; k++) {
    frame[0][k] = columns[k].x;
    frame[1][k] = columns[k].y;
    frame[2][k] = columns[k].z;
  }
  return sbfi_d3_dot(x, x) > 0 && sbfi_d3_dot(z, z) > 0;
}

static sbfi_d3 mean_of(const sbfi_d3 *at, uint32_t count) {
  sbfi_d3 sum = {0, 0, 0};
  for (uint32_t i = 0; i < count; i++) sum = sbfi_d3_add(sum, at[i]);
  return sbfi_d3_scale(sum, 1.0 / count);
}

/* Sets the offset that maps one point to another. */
static void set_offset(sbfi_matrix *m, sbfi_d3 from, sbfi_d3 to) {
  m->at[0][3] = m->at[1][3] = m->at[2][3] = 0;
  sbfi_d3 offset = sbfi_d3_sub(to, sbfi_similarity_apply(m, from));
  m->at[0][3] = offset.x;
  m->at[1][3] = offset.y;
  m->at[2][3] = offset.z;
}

bool sbfi_similarity_of_triangle(
    const sbfi_d3 from[3], const sbfi_d3 to[3], bool mirrored, sbfi_matrix *matrix) {
  double a[3][3], b[3][3], from_length = 0, to_length = 0;
  if (!frame_of(from, a) || !frame_of(to, b)) return false;
  for (int k = 0; k < 3; k++) {
    from_length += sbfi_d3_length(sbfi_d3_sub(from[(k + 1) % 3], from[k]));
    to_length += sbfi_d3_length(sbfi_d3_sub(to[(k + 1) % 3], to[k]));
  }
  *matrix = (sbfi_matrix){.at[3][3] = 1};
  for (int r = 0; r < 3; r++)
    for (int c = 0; c < 3; c++)
      for (int k = 0; k < 3; k++)
        matrix->at[r][c] += to_length / from_length * b[r][k] * (k == 2 && mirrored ? -1 : 1) * a[c][k];
  set_offset(matrix, mean_of(from, 3), mean_of(to, 3));
  return true;
}

/* Best rotation between sets of directions, from the sums of products of their coordinates. */
static void rotation_of_sums(double s[3][3], sbfi_matrix *m) {
  double n[16] = {s[0][0] + s[1][1] + s[2][2], s[1][2] - s[2][1], s[2][0] - s[0][2], s[0][1] - s[1][0], 0,
      s[0][0] - s[1][1] - s[2][2], s[0][1] + s[1][0], s[2][0] + s[0][2], 0, 0, s[1][1] - s[0][0] - s[2][2],
      s[1][2] + s[2][1], 0, 0, 0, s[2][2] - s[0][0] - s[1][1]};
  double vectors[16];
  for (int r = 0; r < 4; r++)
    for (int k = 0; k < r; k++) n[4 * r + k] = n[4 * k + r];
  sbfi_symmetric_compute_eigen(4, n, vectors);
  int best = 0;
  for (int k = 1; k < 4; k++)
    if (n[5 * k] > n[5 * best]) best = k;
  sbfi_trs trs = {
      {0, 0, 0}, {vectors[4 + best], vectors[8 + best], vectors[12 + best], vectors[best]}, {1, 1, 1}};
  *m = sbfi_trs_compose(&trs);
}

bool sbfi_similarity_fit(const sbfi_d3 *from, const sbfi_d3 *to, uint32_t count, bool mirrored, double scale,
    sbfi_matrix *matrix) {
  if (count < 3) return false;
  sbfi_d3 a = mean_of(from, count), b = mean_of(to, count);
  double sums[3][3] = {{0}}, from_squared = 0, to_squared = 0, sign = mirrored ? -1 : 1;
  for (uint32_t i = 0; i < count; i++) {
    sbfi_d3 p = sbfi_d3_sub(from[i], a), q = sbfi_d3_sub(to[i], b);
    const double x[3] = {sign * p.x, sign * p.y, sign * p.z}, y[3] = {q.x, q.y, q.z};
    for (int r = 0; r < 3; r++)
      for (int k = 0; k < 3; k++) sums[r][k] += x[r] * y[k];
    from_squared += sbfi_d3_dot(p, p);
    to_squared += sbfi_d3_dot(q, q);
  }
  if (!(from_squared > 0) || !(to_squared > 0)) return false;
  rotation_of_sums(sums, matrix);
  double factor = scale > 0 ? scale : sqrt(to_squared / from_squared);
  for (int r = 0; r < 3; r++)
    for (int k = 0; k < 3; k++) matrix->at[r][k] *= sign * factor;
  set_offset(matrix, a, b);
  return true;
}

sbfi_matrix sbfi_similarity_snapped(const sbfi_matrix *m, double size, double relative) {
  double scale = sbfi_similarity_scale(m);
  sbfi_d3 offset = {m->at[0][3], m->at[1][3], m->at[2][3]};
  sbfi_matrix rotation = sbfi_similarity_scaled(m, 1, (sbfi_d3){0, 0, 0});
  for (uint32_t i = 0; i < SBFI_USUAL_UNITS; i++)
    if (fabs(scale / sbfi_usual_units[i].unit_m - 1) < relative) scale = sbfi_usual_units[i].unit_m;
  for (uint32_t i = 0; i < SBFI_AXIS_ROTATIONS; i++) {
    sbfi_matrix axes = sbfi_axis_rotation(i);
    double max = 0;
    for (int k = 0; k < 9; k++) max = fmax(max, fabs(axes.at[k / 3][k % 3] - rotation.at[k / 3][k % 3]));
    if (max < relative) rotation = axes;
  }
  if (sbfi_d3_length(offset) < relative * size) offset = (sbfi_d3){0, 0, 0};
  return sbfi_similarity_scaled(&rotation, scale, offset);
}

static void add_text(sbfi_similarity_text *text, const char *part) {
  size_t used = strlen(text->at);
  snprintf(text->at + used, sizeof text->at - used, "%s%s", used ? ", " : "", part);
}

/* Describes a rotation about an axis of the file if it is one, otherwise by axis and angle. */
static void describe_rotation(const sbfi_matrix *m, sbfi_similarity_text *text) {
  static const double degrees = 57.295779513082323;
  char part[96];
  sbfi_trs trs = sbfi_trs_decompose(m);
  const double *q = trs.rotation;
  double sine = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]), angle = 2 * atan2(sine, q[3]) * degrees;
  if (angle > 180) angle -= 360;
  if (fabs(angle) < 0.01) return;
  for (int k = 0; k < 3; k++)
    if (fabs(q[k]) > 0.99999 * sine) {
      snprintf(part, sizeof part, "rotated by %.4g degrees about %c", q[k] < 0 ? -angle : angle, "xyz"[k]);
      add_text(text, part);
      return;
    }
  snprintf(part, sizeof part, "rotated by %.4g degrees about (%.3g, %.3g, %.3g)", angle, q[0] / sine,
      q[1] / sine, q[2] / sine);
  add_text(text, part);
}

sbfi_similarity_text sbfi_similarity_describe(const sbfi_matrix *m, double size) {
  sbfi_similarity_text text = {{0}};
  char part[96];
  double scale = sbfi_similarity_scale(m);
  const char *unit = NULL;
  for (uint32_t i = 0; i < SBFI_USUAL_UNITS; i++)
    if (fabs(scale / sbfi_usual_units[i].unit_m - 1) < 1e-4) unit = sbfi_usual_units[i].name;
  if (fabs(scale - 1) > 1e-5) {
    snprintf(part, sizeof part, "scaled by %.6g%s%s%s", scale, unit ? " (it is in " : "", unit ? unit : "",
        unit ? ")" : "");
    add_text(&text, part);
  }
  const double(*a)[4] = m->at;
  double determinant = a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) -
                       a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
                       a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
  if (determinant < 0) add_text(&text, "mirrored in x");
  describe_rotation(m, &text);
  if (sqrt(a[0][3] * a[0][3] + a[1][3] * a[1][3] + a[2][3] * a[2][3]) > 1e-4 * size) {
    snprintf(part, sizeof part, "moved by (%.4g, %.4g, %.4g) m", a[0][3], a[1][3], a[2][3]);
    add_text(&text, part);
  }
  return text;
}

void sbfi_spread_directions(sbfi_d3 *directions, uint32_t count) {
  const double cosine = -0.7373688780783197, sine = 0.6754902942615238; /* of the golden angle */
  double x = 1, z = 0;
  for (uint32_t i = 0; i < count; i++) {
    double height = 1 - 2 * (i + 0.5) / count, radius = sqrt(1 - height * height),
           next = cosine * x - sine * z;
    directions[i] = (sbfi_d3){radius * x, height, radius * z};
    z = sine * x + cosine * z;
    x = next;
  }
}

sbfi_matrix sbfi_rotation_about(const double rotation[4], sbfi_d3 about) {
  sbfi_matrix m = sbfi_matrix_identity();
  for (int k = 0; k < 3; k++) {
    double to[3];
    sbfi_quatd_rotate(rotation, (const double[3]){k == 0, k == 1, k == 2}, to);
    for (int row = 0; row < 3; row++) m.at[row][k] = to[row];
  }
  sbfi_d3 moved = sbfi_d3_sub(about, sbfi_similarity_apply(&m, about));
  m.at[0][3] = moved.x, m.at[1][3] = moved.y, m.at[2][3] = moved.z;
  return m;
}
