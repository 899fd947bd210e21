/* Triangulates a height field: grid lines along x and z, dense near the centre and sparse farther out.
 * Lines are at multiples of their spacing in the world, so that the ground does not change when its centre
 * moves. If the height jumps between two lines, the position of the jump is searched and gets double lines
 * on both sides, without shared corners, so that tread and riser have separate shading. */
#include "render/draw_scene_data.h"

enum { LINES_MAX = 320, JUMPS_MAX = 24, PROBES = 9, HALVINGS = 16 };

typedef struct terrain_grid {
  draw_height height;
  void *user;
  float middle[2]; /* x and z */
  float radius, cell;
  float lines[2][LINES_MAX];
  uint32_t counts[2];
} terrain_grid;

static float height_at(const terrain_grid *grid, int axis, float along, float across) {
  return axis == 0 ? grid->height(grid->user, along, across) : grid->height(grid->user, across, along);
}

static void add_terrain_line(terrain_grid *grid, int axis, float coordinate) {
  if (grid->counts[axis] < LINES_MAX) grid->lines[axis][grid->counts[axis]++] = coordinate;
}

/* Bisects the interval until it is narrow; then a slope has no difference left, a jump all of it. */
static bool find_jump(
    const terrain_grid *grid, int axis, float from, float to, float across, float *position) {
  float a = height_at(grid, axis, from, across), b = height_at(grid, axis, to, across);
  float whole = fabsf(b - a);
  if (!(whole > 0.35f * (to - from))) return false;
  for (int i = 0; i < HALVINGS; i++) {
    float half = 0.5f * (from + to), c = height_at(grid, axis, half, across);
    if (fabsf(c - a) > fabsf(b - c))
      to = half, b = c;
    else
      from = half, a = c;
  }
  *position = 0.5f * (from + to);
  return fabsf(b - a) > 0.5f * whole;
}

static void add_jump(terrain_grid *grid, int axis, float from, float to) {
  float coordinate;
  for (int i = 0; i < PROBES; i++) {
    float across = grid->middle[1 - axis] + grid->radius * ((float)i / (PROBES - 1) - 0.5f);
    if (!find_jump(grid, axis, from, to, across, &coordinate)) continue;
    float side = 1e-3f * grid->cell;
    add_terrain_line(grid, axis, coordinate - side);
    add_terrain_line(grid, axis, coordinate - side);
    add_terrain_line(grid, axis, coordinate + side);
    add_terrain_line(grid, axis, coordinate + side);
    return;
  }
}

/* Spacing 1 up to 48 cells from the centre, then 2 up to 96, then 4. */
static float next_line(const terrain_grid *grid, int axis, float coordinate) {
  float out = fabsf(coordinate - grid->middle[axis]) / grid->cell;
  float step = grid->cell * (out < 48 ? 1.0f : out < 96 ? 2.0f : 4.0f);
  return (floorf(coordinate / step + 0.001f) + 1) * step;
}

static void add_lines(terrain_grid *grid, int axis) {
  float end = grid->middle[axis] + grid->radius, coarse = 4 * grid->cell;
  float coordinate = floorf((grid->middle[axis] - grid->radius) / coarse) * coarse;
  int jumps = 0;
  grid->counts[axis] = 0;
  add_terrain_line(grid, axis, coordinate);
  while (coordinate < end && grid->counts[axis] + 5 <= LINES_MAX) {
    float next = next_line(grid, axis, coordinate);
    uint32_t before = grid->counts[axis];
    if (jumps < JUMPS_MAX) add_jump(grid, axis, coordinate, next);
    jumps += grid->counts[axis] != before;
    add_terrain_line(grid, axis, next);
    coordinate = next;
  }
}

void draw_scene_set_terrain(
    draw_scene *scene, draw_height height, void *user, float x, float z, float radius) {
  terrain_grid grid = {
      .height = height, .user = user, .middle = {x, z}, .radius = radius, .cell = radius / 168};
  draw_scene_clear_ground(scene);
  if (!(radius > 0) || !isfinite(x) || !isfinite(z)) return;
  add_lines(&grid, 0);
  add_lines(&grid, 1);
  uint32_t wide = grid.counts[0], deep = grid.counts[1], vertices = wide * deep;
  uint32_t index_count = 6 * (wide - 1) * (deep - 1);
  sbf_vec3 *at = draw_scene_list_push(scene, &scene->ground.positions, vertices, sizeof *at);
  sbf_vec3 *normals = draw_scene_list_push(scene, &scene->ground.normals, vertices, sizeof *normals);
  uint32_t *indices = draw_scene_list_push(scene, &scene->ground.indices, index_count, sizeof *indices);
  if (!at || !normals || !indices) {
    draw_scene_clear_ground(scene);
    return;
  }
  uint32_t *index = indices;
  for (uint32_t j = 0; j < deep; j++)
    for (uint32_t i = 0; i < wide; i++) {
      float line_x = grid.lines[0][i], line_z = grid.lines[1][j];
      at[j * wide + i] = v3(line_x, height(user, line_x, line_z), line_z);
    }
  for (uint32_t j = 0; j + 1 < deep; j++)
    for (uint32_t i = 0; i + 1 < wide; i++) {
      uint32_t a = j * wide + i, b = a + wide;
      const uint32_t two[6] = {a, b, a + 1, a + 1, b, b + 1};
      for (int k = 0; k < 6; k++) *index++ = two[k];
    }
  draw_scene_smooth_normals(at, vertices, indices, index_count, normals);
}
