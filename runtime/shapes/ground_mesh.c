/* Triangles as a ground: a grid over x and z, with about one cell per triangle. Each cell lists the triangles
 * whose boxes overlap it. */
#include <math.h>
#include <string.h>

#include "base/diagnostic.h"
#include "base/memory.h"
#include "sbrun/terrain.h"

struct sbr_ground_mesh {
  sbf_allocator allocator;
  const sbf_vec3 *points;
  const uint32_t *triangles;
  double otherwise_m, x, z, cell_m;
  uint32_t columns, rows;
  uint32_t *begins; /* (columns x rows + 1) indices in `members` */
  uint32_t *members;
};

typedef struct cell_range {
  uint32_t first_column, last_column, first_row, last_row;
} cell_range;

static uint32_t cell_at(double from_edge, double cell_m, uint32_t count) {
  double at = from_edge / cell_m;
  if (!(at > 0)) return 0;
  return at >= count ? count - 1 : (uint32_t)at;
}

typedef struct extent {
  float low_x, high_x, low_z, high_z;
} extent;

static const extent nothing = {INFINITY, -INFINITY, INFINITY, -INFINITY};

static void extend(extent *e, sbf_vec3 p) {
  if (p.x < e->low_x) e->low_x = p.x;
  if (p.x > e->high_x) e->high_x = p.x;
  if (p.z < e->low_z) e->low_z = p.z;
  if (p.z > e->high_z) e->high_z = p.z;
}

static cell_range range_of(const sbr_ground_mesh *m, uint32_t triangle) {
  const uint32_t *t = m->triangles + 3 * (size_t)triangle;
  extent e = nothing;
  for (int i = 0; i < 3; i++) extend(&e, m->points[t[i]]);
  return (cell_range){cell_at((double)e.low_x - m->x, m->cell_m, m->columns),
      cell_at((double)e.high_x - m->x, m->cell_m, m->columns),
      cell_at((double)e.low_z - m->z, m->cell_m, m->rows),
      cell_at((double)e.high_z - m->z, m->cell_m, m->rows)};
}

static void find_grid(sbr_ground_mesh *m, uint32_t point_count, uint32_t triangle_count) {
  extent e = nothing;
  for (uint32_t i = 0; i < point_count; i++) extend(&e, m->points[i]);
  double wide = (double)e.high_x - e.low_x, deep = (double)e.high_z - e.low_z;
  double min = 1e-3 * (wide + deep) + 1e-6, cell = sqrt(wide * deep / triangle_count);
  m->x = e.low_x, m->z = e.low_z;
  m->cell_m = cell > min ? cell : min;
  m->columns = (uint32_t)(wide / m->cell_m) + 1;
  m->rows = (uint32_t)(deep / m->cell_m) + 1;
}

/* Counts (pass 0) or writes (pass 1) the members of each cell. */
static void sort_in(sbr_ground_mesh *m, uint32_t triangle_count, int pass) {
  for (uint32_t t = 0; t < triangle_count; t++) {
    cell_range r = range_of(m, t);
    for (uint32_t row = r.first_row; row <= r.last_row; row++)
      for (uint32_t column = r.first_column; column <= r.last_column; column++) {
        uint32_t *cell = &m->begins[(size_t)row * m->columns + column];
        if (pass) m->members[*cell] = t;
        ++*cell;
      }
  }
}

static bool make_cells(sbr_ground_mesh *m, uint32_t triangle_count) {
  size_t cells = (size_t)m->columns * m->rows;
  m->begins = sbfi_allocate(&m->allocator, (cells + 1) * sizeof *m->begins);
  if (!m->begins) return false;
  memset(m->begins, 0, (cells + 1) * sizeof *m->begins);
  sort_in(m, triangle_count, 0);
  uint32_t sum = 0;
  for (size_t i = 0; i <= cells; i++) {
    uint32_t own = i < cells ? m->begins[i] : 0;
    m->begins[i] = sum, sum += own;
  }
  m->members = sbfi_allocate(&m->allocator, ((size_t)sum + 1) * sizeof *m->members);
  if (!m->members) return false;
  sort_in(m, triangle_count, 1); /* leaves the end of each cell in the place of its beginning */
  memmove(m->begins + 1, m->begins, cells * sizeof *m->begins);
  m->begins[0] = 0;
  return true;
}

void sbr_ground_mesh_destroy(sbr_ground_mesh *m) {
  if (!m) return;
  size_t cells = (size_t)m->columns * m->rows;
  if (m->members) sbfi_free(&m->allocator, m->members, ((size_t)m->begins[cells] + 1) * sizeof *m->members);
  if (m->begins) sbfi_free(&m->allocator, m->begins, (cells + 1) * sizeof *m->begins);
  sbf_allocator allocator = m->allocator;
  sbfi_free(&allocator, m, sizeof *m);
}

sbf_status sbr_ground_mesh_create(const sbf_allocator *allocator, const sbf_vec3 *points,
    uint32_t point_count, const uint32_t *triangles, uint32_t triangle_count, double otherwise_m,
    sbr_ground_mesh **mesh, sbf_diagnostic *error) {
  if (!mesh || !points || !triangles || triangle_count == 0)
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL, "sbr_ground_mesh_create: no triangles");
  *mesh = NULL;
  for (size_t i = 0; i < 3 * (size_t)triangle_count; i++)
    if (triangles[i] >= point_count)
      return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
          "sbr_ground_mesh_create: triangle %u names point %u of %u", (unsigned)(i / 3),
          (unsigned)triangles[i], (unsigned)point_count);
  sbf_allocator use = sbfi_allocator_or_default(allocator);
  sbr_ground_mesh *m = sbfi_allocate(&use, sizeof *m);
  if (!m) return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "no memory for a ground");
  *m = (sbr_ground_mesh){
      .allocator = use, .points = points, .triangles = triangles, .otherwise_m = otherwise_m};
  find_grid(m, point_count, triangle_count);
  if (make_cells(m, triangle_count)) {
    *mesh = m;
    return SBF_OK;
  }
  sbr_ground_mesh_destroy(m);
  return sbfi_diagnose(
      error, SBF_CODE_OUT_OF_MEMORY, "no memory for a ground of %u triangles", (unsigned)triangle_count);
}

/* Height of a triangle's plane at a position above it. */
static bool height_on(
    const sbr_ground_mesh *m, uint32_t triangle, double x, double z, double *y, sbf_vec3 *n) {
  const uint32_t *t = m->triangles + 3 * (size_t)triangle;
  sbf_vec3 a = m->points[t[0]], b = m->points[t[1]], c = m->points[t[2]];
  double ux = (double)b.x - a.x, uy = (double)b.y - a.y, uz = (double)b.z - a.z;
  double vx = (double)c.x - a.x, vy = (double)c.y - a.y, vz = (double)c.z - a.z;
  double px = x - (double)a.x, pz = z - (double)a.z, area = ux * vz - uz * vx;
  if (area == 0) return false; /* vertical triangle */
  double s = (px * vz - pz * vx) / area, r = (ux * pz - uz * px) / area;
  const double edge = -1e-9;
  if (s < edge || r < edge || s + r > 1 - edge) return false;
  double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
  double size = sqrt(nx * nx + ny * ny + nz * nz) * (ny < 0 ? -1 : 1);
  *y = (double)a.y + s * uy + r * vy;
  *n = (sbf_vec3){(float)(nx / size), (float)(ny / size), (float)(nz / size)};
  return true;
}

static double mesh_height(const sbr_ground *ground, double x, double z, sbf_vec3 *normal) {
  const sbr_ground_mesh *m = ground->user;
  double highest = -INFINITY, y;
  *normal = (sbf_vec3){0, 1, 0};
  double column = (x - m->x) / m->cell_m, row = (z - m->z) / m->cell_m;
  if (!(column >= 0 && row >= 0 && column <= m->columns && row <= m->rows)) return m->otherwise_m;
  size_t cell =
      (size_t)cell_at(z - m->z, m->cell_m, m->rows) * m->columns + cell_at(x - m->x, m->cell_m, m->columns);
  for (uint32_t i = m->begins[cell]; i < m->begins[cell + 1]; i++) {
    sbf_vec3 n;
    if (!height_on(m, m->members[i], x, z, &y, &n) || y <= highest) continue;
    highest = y;
    *normal = n;
  }
  return highest > -INFINITY ? highest : m->otherwise_m;
}

sbr_ground sbr_ground_from_mesh(const sbr_ground_mesh *mesh) {
  if (!mesh) return sbr_ground_flat(0);
  return (sbr_ground){mesh_height, mesh, {0, 0, 0, 0}};
}
