/* Measures area, volume and openness of a surface, and normals of its points. */
#include "mechanics/polygon.h"
#include "mechanics/symmetric_eigen.h"
#include "sbfmt/mechanics.h"

static sbfi_d3 mean_of(const sbf_vec3 *positions, uint32_t count) {
  sbfi_d3 sum = {0, 0, 0};
  for (uint32_t i = 0; i < count; i++) sum = sbfi_d3_add(sum, sbfi_d3_of(positions[i]));
  return count ? sbfi_d3_scale(sum, 1.0 / count) : sum;
}

void sbf_surface_measure(
    const sbf_polygon_mesh *mesh, const sbf_vec3 *positions, sbf_surface_measures *measures) {
  if (!positions) positions = mesh->positions.at;
  sbfi_d3 about = mean_of(positions, mesh->positions.count), sum = {0, 0, 0};
  const uint32_t *corners = mesh->polygon_points.at;
  *measures = (sbf_surface_measures){0, 0, 0};
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; corners += mesh->polygon_sizes.at[p++]) {
    uint32_t size = mesh->polygon_sizes.at[p];
    sbfi_d3 middle = sbfi_polygon_middle(positions, corners, size);
    sbfi_d3 area = sbfi_polygon_area(positions, corners, size, middle);
    measures->area += sbfi_d3_length(area);
    /* The triangles from the centre to the edges share the centre: their cones from `about` sum to the
     * area vector times the centre's position. */
    measures->volume += sbfi_d3_dot(sbfi_d3_sub(middle, about), area) / 3;
    sum = sbfi_d3_add(sum, area);
  }
  measures->opening = measures->area > 0 ? sbfi_d3_length(sum) / measures->area : 0;
}

void sbf_surface_point_areas(const sbf_polygon_mesh *mesh, float *areas) {
  const uint32_t *corners = mesh->polygon_points.at;
  for (uint32_t i = 0; i < mesh->positions.count; i++) areas[i] = 0;
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; corners += mesh->polygon_sizes.at[p++]) {
    uint32_t size = mesh->polygon_sizes.at[p];
    sbfi_d3 middle = sbfi_polygon_middle(mesh->positions.at, corners, size);
    float fraction =
        (float)(sbfi_d3_length(sbfi_polygon_area(mesh->positions.at, corners, size, middle)) / size);
    for (uint32_t k = 0; k < size; k++) areas[corners[k]] += fraction;
  }
}

void sbf_surface_point_normals(const sbf_polygon_mesh *mesh, sbf_vec3 *normals) {
  const uint32_t *corners = mesh->polygon_points.at;
  for (uint32_t i = 0; i < mesh->positions.count; i++) normals[i] = (sbf_vec3){0, 0, 0};
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; corners += mesh->polygon_sizes.at[p++]) {
    uint32_t size = mesh->polygon_sizes.at[p];
    sbfi_d3 middle = sbfi_polygon_middle(mesh->positions.at, corners, size);
    sbfi_d3 area = sbfi_polygon_area(mesh->positions.at, corners, size, middle);
    for (uint32_t k = 0; k < size; k++) {
      sbf_vec3 *sum = &normals[corners[k]];
      *sum = sbfi_d3_rounded(sbfi_d3_add(sbfi_d3_of(*sum), area));
    }
  }
  for (uint32_t i = 0; i < mesh->positions.count; i++)
    normals[i] = sbfi_d3_rounded(sbfi_d3_normal(sbfi_d3_of(normals[i])));
}

/* Adds a tetrahedron from the origin: volume v, first moment v/4 (a+b+c), second moments from the closed
 * form int x y = v/20 (sum over corners of x_i y_i + sum x_i sum y_i), with the origin's corner being
 * zero. */
static void add_tetrahedron(
    sbfi_d3 a, sbfi_d3 b, sbfi_d3 c, double *volume, sbfi_d3 *first, double second[6]) {
  double v = sbfi_d3_dot(a, sbfi_d3_cross(b, c)) / 6;
  sbfi_d3 s = sbfi_d3_add(a, sbfi_d3_add(b, c));
  *volume += v;
  *first = sbfi_d3_add(*first, sbfi_d3_scale(s, v / 4));
  second[0] += v / 20 * (a.x * a.x + b.x * b.x + c.x * c.x + s.x * s.x);
  second[1] += v / 20 * (a.y * a.y + b.y * b.y + c.y * c.y + s.y * s.y);
  second[2] += v / 20 * (a.z * a.z + b.z * b.z + c.z * c.z + s.z * s.z);
  second[3] += v / 20 * (a.x * a.y + b.x * b.y + c.x * c.y + s.x * s.y);
  second[4] += v / 20 * (a.y * a.z + b.y * b.z + c.y * c.z + s.y * s.z);
  second[5] += v / 20 * (a.z * a.x + b.z * b.x + c.z * c.x + s.z * s.x);
}

/* Quaternion of the rotation with the columns x, y, z: computes the largest of its four components first. */
static sbf_quat quaternion_of(sbfi_d3 x, sbfi_d3 y, sbfi_d3 z) {
  double w2 = 1 + x.x + y.y + z.z, x2 = 1 + x.x - y.y - z.z, y2 = 1 - x.x + y.y - z.z,
         z2 = 1 - x.x - y.y + z.z;
  double q[4];
  if (w2 >= x2 && w2 >= y2 && w2 >= z2) {
    double r = 2 * sqrt(w2);
    q[0] = (y.z - z.y) / r, q[1] = (z.x - x.z) / r, q[2] = (x.y - y.x) / r, q[3] = r / 4;
  } else if (x2 >= y2 && x2 >= z2) {
    double r = 2 * sqrt(x2);
    q[0] = r / 4, q[1] = (y.x + x.y) / r, q[2] = (z.x + x.z) / r, q[3] = (y.z - z.y) / r;
  } else if (y2 >= z2) {
    double r = 2 * sqrt(y2);
    q[0] = (y.x + x.y) / r, q[1] = r / 4, q[2] = (z.y + y.z) / r, q[3] = (z.x - x.z) / r;
  } else {
    double r = 2 * sqrt(z2);
    q[0] = (z.x + x.z) / r, q[1] = (z.y + y.z) / r, q[2] = r / 4, q[3] = (x.y - y.x) / r;
  }
  double sign = q[3] < 0 ? -1 : 1; /* chooses one of the two quaternions of a rotation */
  return (sbf_quat){(float)(sign * q[0]), (float)(sign * q[1]), (float)(sign * q[2]), (float)(sign * q[3])};
}

static void find_principal_axes(const double second[6], sbf_solid *solid) {
  double trace = second[0] + second[1] + second[2], vectors[9];
  double inertia[9] = {trace - second[0], -second[3], -second[5], -second[3], trace - second[1], -second[4],
      -second[5], -second[4], trace - second[2]};
  sbfi_symmetric_compute_eigen(3, inertia, vectors);
  int order[3] = {0, 1, 2};
  for (int i = 0; i < 2; i++)
    for (int j = 0; j < 2 - i; j++)
      if (inertia[4 * order[j]] > inertia[4 * order[j + 1]]) {
        int swap = order[j];
        order[j] = order[j + 1];
        order[j + 1] = swap;
      }
  sbfi_d3 axes[3];
  for (int i = 0; i < 3; i++)
    axes[i] = (sbfi_d3){vectors[order[i]], vectors[3 + order[i]], vectors[6 + order[i]]};
  axes[2] = sbfi_d3_cross(axes[0], axes[1]);
  solid->inertia_rotation = quaternion_of(axes[0], axes[1], axes[2]);
  solid->inertia =
      (sbf_vec3){(float)inertia[4 * order[0]], (float)inertia[4 * order[1]], (float)inertia[4 * order[2]]};
}

void sbf_solid_measure(const sbf_polygon_mesh *mesh, sbf_solid *solid) {
  const sbf_vec3 *positions = mesh->positions.at;
  sbfi_d3 about = mean_of(positions, mesh->positions.count), first = {0, 0, 0};
  double volume = 0, second[6] = {0};
  const uint32_t *corners = mesh->polygon_points.at;
  *solid = (sbf_solid){.inertia_rotation = {0, 0, 0, 1}};
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; corners += mesh->polygon_sizes.at[p++]) {
    uint32_t size = mesh->polygon_sizes.at[p];
    sbfi_d3 middle = sbfi_d3_sub(sbfi_polygon_middle(positions, corners, size), about);
    for (uint32_t k = 0; k < size; k++) {
      sbfi_d3 a = sbfi_d3_sub(sbfi_d3_of(positions[corners[k]]), about);
      sbfi_d3 b = sbfi_d3_sub(sbfi_d3_of(positions[corners[k + 1 < size ? k + 1 : 0]]), about);
      add_tetrahedron(middle, a, b, &volume, &first, second);
    }
  }
  if (!(volume > 0)) return;
  sbfi_d3 c = sbfi_d3_scale(first, 1 / volume);
  const double shift[6] = {c.x * c.x, c.y * c.y, c.z * c.z, c.x * c.y, c.y * c.z, c.z * c.x};
  for (int i = 0; i < 6; i++) second[i] -= volume * shift[i];
  solid->volume = volume;
  solid->center = sbfi_d3_rounded(sbfi_d3_add(c, about));
  find_principal_axes(second, solid);
}
