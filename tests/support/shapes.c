#include "shapes.h"

#include <check.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"

static void *allocate(sbf_asset *asset, size_t count, size_t size) {
  void *memory = sbf_asset_allocate(asset, count ? count : 1, size);
  if (!memory) abort();
  return memory;
}

static sbf_polygon_mesh mesh_of_quads(
    sbf_asset *asset, sbf_vec3 *positions, uint32_t point_count, uint32_t *corners, uint32_t quad_count) {
  uint32_t *sizes = allocate(asset, quad_count, sizeof *sizes);
  for (uint32_t q = 0; q < quad_count; q++) sizes[q] = 4;
  sbf_polygon_mesh mesh;
  sbf_polygon_mesh_init(&mesh);
  mesh.target = SBF_MESH_TARGET_SURFACE;
  mesh.positions = (sbf_vec3_list){positions, point_count};
  mesh.polygon_sizes = (sbf_u32_list){sizes, quad_count};
  mesh.polygon_points = (sbf_u32_list){corners, 4 * quad_count};
  return mesh;
}

sbf_polygon_mesh shape_cube(sbf_asset *asset, uint32_t n, float side, sbf_vec3 centre) {
  uint32_t row = n + 1, point_count = 0, corner_count = 0;
  uint32_t *numbers = allocate(asset, (size_t)row * row * row, sizeof *numbers);
  sbf_vec3 *positions = allocate(asset, 6 * (size_t)n * n + 2, sizeof *positions);
  uint32_t *corners = allocate(asset, 24 * (size_t)n * n, sizeof *corners);
  for (uint32_t x = 0; x < row; x++)
    for (uint32_t y = 0; y < row; y++)
      for (uint32_t z = 0; z < row; z++) {
        if (x % n && y % n && z % n) continue;
        numbers[(x * row + y) * row + z] = point_count;
        positions[point_count++] = (sbf_vec3){centre.x + side * ((float)x / (float)n - 0.5f),
            centre.y + side * ((float)y / (float)n - 0.5f), centre.z + side * ((float)z / (float)n - 0.5f)};
      }
  for (uint32_t face = 0; face < 6; face++)
    for (uint32_t i = 0; i < n; i++)
      for (uint32_t j = 0; j < n; j++)
        for (uint32_t k = 0; k < 4; k++) {
          /* Corners around the face; the far faces run the other way round. */
          uint32_t u = i + ((k == 1) | (k == 2)), v = j + (k >= 2), w = face < 3 ? 0 : n;
          uint32_t at[3];
          at[face % 3] = w;
          at[(face + 1) % 3] = face < 3 ? v : u;
          at[(face + 2) % 3] = face < 3 ? u : v;
          corners[corner_count++] = numbers[(at[0] * row + at[1]) * row + at[2]];
        }
  return mesh_of_quads(asset, positions, point_count, corners, 6 * n * n);
}

sbf_polygon_mesh shape_bar(sbf_asset *asset, uint32_t along, uint32_t n, float length, float side) {
  const uint32_t sizes[3] = {along, n, n};
  uint32_t row = n + 1, point_count = 0, corner_count = 0, quads = 2 * n * n + 4 * along * n;
  uint32_t *numbers = allocate(asset, (size_t)(along + 1) * row * row, sizeof *numbers);
  sbf_vec3 *positions = allocate(asset, (size_t)quads + 2, sizeof *positions);
  uint32_t *corners = allocate(asset, 4 * (size_t)quads, sizeof *corners);
  for (uint32_t x = 0; x <= along; x++)
    for (uint32_t y = 0; y < row; y++)
      for (uint32_t z = 0; z < row; z++) {
        if (x % along && y % n && z % n) continue;
        numbers[(x * row + y) * row + z] = point_count;
        positions[point_count++] = (sbf_vec3){length * (float)x / (float)along,
            side * ((float)y / (float)n - 0.5f), side * ((float)z / (float)n - 0.5f)};
      }
  for (int face = 0; face < 6; face++) {
    int axis = face % 3, across = (axis + 1) % 3, up = (axis + 2) % 3;
    for (uint32_t i = 0; i < sizes[across]; i++)
      for (uint32_t j = 0; j < sizes[up]; j++)
        for (uint32_t k = 0; k < 4; k++) {
          /* Corners around the face; the near faces run the other way round. */
          uint32_t turn = face < 3 ? 3 - k : k, at[3];
          at[axis] = face < 3 ? 0 : sizes[axis];
          at[across] = i + ((turn == 1) | (turn == 2));
          at[up] = j + (turn >= 2);
          corners[corner_count++] = numbers[(at[0] * row + at[1]) * row + at[2]];
        }
  }
  return mesh_of_quads(asset, positions, point_count, corners, quads);
}

sbf_polygon_mesh shape_sheet(sbf_asset *asset, uint32_t n, uint32_t m) {
  sbf_vec3 *positions = allocate(asset, (size_t)(n + 1) * (m + 1), sizeof *positions);
  uint32_t *corners = allocate(asset, 4 * (size_t)n * m, sizeof *corners);
  uint32_t count = 0;
  for (uint32_t i = 0; i <= n; i++)
    for (uint32_t j = 0; j <= m; j++) positions[i * (m + 1) + j] = (sbf_vec3){(float)i, 0, (float)j};
  for (uint32_t i = 0; i < n; i++)
    for (uint32_t j = 0; j < m; j++) {
      uint32_t a = i * (m + 1) + j;
      uint32_t quad[4] = {a, a + 1, a + m + 2, a + m + 1};
      memcpy(corners + count, quad, sizeof quad);
      count += 4;
    }
  return mesh_of_quads(asset, positions, (n + 1) * (m + 1), corners, n * m);
}

sbf_polygon_mesh shape_triangulated(sbf_asset *asset, const sbf_polygon_mesh *mesh) {
  uint32_t quads = mesh->polygon_sizes.count;
  uint32_t *sizes = allocate(asset, 2 * (size_t)quads, sizeof *sizes);
  uint32_t *corners = allocate(asset, 6 * (size_t)quads, sizeof *corners);
  for (uint32_t q = 0; q < quads; q++) {
    const uint32_t *c = mesh->polygon_points.at + 4 * q;
    uint32_t two[6] = {c[0], c[1], c[2], c[0], c[2], c[3]};
    memcpy(corners + 6 * q, two, sizeof two);
    sizes[2 * q] = sizes[2 * q + 1] = 3;
  }
  sbf_polygon_mesh cut = *mesh;
  cut.polygon_sizes = (sbf_u32_list){sizes, 2 * quads};
  cut.polygon_points = (sbf_u32_list){corners, 6 * quads};
  return cut;
}

static const char *numbered(sbf_asset *asset, const char *prefix, uint32_t number) {
  char text[64];
  snprintf(text, sizeof text, "%s%u", prefix, (unsigned)number);
  const char *copy = sbf_asset_copy_text(asset, text);
  if (!copy) abort();
  return copy;
}

sbf_soft_body *shape_add_body(
    sbf_asset *asset, const char *name, const sbf_polygon_mesh *surface, bool with_bone) {
  uint32_t count = asset->soft_bodies.count, bone_count = asset->bones.count;
  sbf_soft_body *bodies = allocate(asset, count + 1, sizeof *bodies);
  if (count) memcpy(bodies, asset->soft_bodies.at, count * sizeof *bodies);
  sbf_soft_body_init(&bodies[count]);
  bodies[count].id = numbered(asset, "body", count);
  bodies[count].name = sbf_asset_copy_text(asset, name);
  bodies[count].surface = *surface;
  asset->soft_bodies = (sbf_soft_body_list){bodies, count + 1};
  if (!with_bone) return &bodies[count];
  sbf_bone *bones = allocate(asset, bone_count + 1, sizeof *bones);
  if (bone_count) memcpy(bones, asset->bones.at, bone_count * sizeof *bones);
  sbf_bone_init(&bones[bone_count]);
  bones[bone_count].id = numbered(asset, "bone", bone_count);
  bones[bone_count].head = surface->positions.count ? surface->positions.at[0] : (sbf_vec3){0, 0, 0};
  bones[bone_count].rotation = (sbf_quat){0.5f, 0.5f, 0.5f, 0.5f};
  asset->bones = (sbf_bone_list){bones, bone_count + 1};
  bodies[count].bone = (int32_t)bone_count;
  return &bodies[count];
}

enum { MAX_POINTS = 4096, MAX_CORNERS = 16384 };

void shape_sections_of_obj(sbf_asset *asset, const char *path) {
  FILE *file = fopen(path, "r");
  if (!file) abort();
  sbf_polygon_mesh mesh;
  sbf_polygon_mesh_init(&mesh);
  sbf_vec3 *positions = NULL;
  uint32_t *sizes = NULL, *corners = NULL, base = 0, total = 0;
  char line[1024], name[1024] = "";
  for (bool more = true; more;) {
    more = fgets(line, sizeof line, file) != NULL;
    if (!more || line[0] == 'g' || line[0] == 'o') {
      if (positions) shape_add_body(asset, name, &mesh, true);
      if (sscanf(line, "%*s %1000s", name) != 1) name[0] = 0;
      sbf_polygon_mesh_init(&mesh);
      mesh.target = SBF_MESH_TARGET_SURFACE;
      mesh.positions.at = positions = allocate(asset, MAX_POINTS, sizeof *positions);
      mesh.polygon_sizes.at = sizes = allocate(asset, MAX_CORNERS, sizeof *sizes);
      mesh.polygon_points.at = corners = allocate(asset, MAX_CORNERS, sizeof *corners);
      base = total;
    } else if (strncmp(line, "v ", 2) == 0) {
      sbf_vec3 *p = &positions[mesh.positions.count++];
      if (sscanf(line + 2, "%f %f %f", &p->x, &p->y, &p->z) != 3) abort();
      total++;
    } else if (strncmp(line, "f ", 2) == 0) {
      for (char *word = strtok(line + 2, " \r\n"); word; word = strtok(NULL, " \r\n")) {
        corners[mesh.polygon_points.count++] = (uint32_t)strtoul(word, NULL, 10) - 1 - base;
        sizes[mesh.polygon_sizes.count]++;
      }
      mesh.polygon_sizes.count++;
    }
  }
  fclose(file);
}

sbf_polygon_mesh shape_of_obj(sbf_asset *asset, const char *path) {
  size_t size, points = 0, faces = 0, words = 0;
  char *text = harness_read(path, &size);
  ck_assert_ptr_nonnull(text);
  for (size_t i = 0; i < size; i++) {
    bool begins = i == 0 || text[i - 1] == '\n';
    points += begins && text[i] == 'v' && text[i + 1] == ' ';
    faces += begins && text[i] == 'f';
    words += text[i] == ' ';
  }
  sbf_vec3 *positions = sbf_asset_allocate(asset, points + 1, sizeof *positions);
  uint32_t *sizes = sbf_asset_allocate(asset, faces + 1, sizeof *sizes);
  uint32_t *corners = sbf_asset_allocate(asset, words + 1, sizeof *corners);
  ck_assert(positions && sizes && corners);
  sbf_polygon_mesh mesh;
  sbf_polygon_mesh_init(&mesh);
  mesh.target = SBF_MESH_TARGET_SURFACE;
  for (char *line = strtok(text, "\r\n"); line; line = strtok(NULL, "\r\n")) {
    if (line[0] == 'v' && line[1] == ' ') {
      sbf_vec3 *p = &positions[mesh.positions.count++];
      ck_assert_int_eq(sscanf(line + 2, "%f %f %f", &p->x, &p->y, &p->z), 3);
    } else if (line[0] == 'f') {
      for (char *word = strchr(line, ' '); word; word = strchr(word + 1, ' ')) {
        long corner = strtol(word, NULL, 10); /* 0 for the nothing behind a last blank */
        if (corner == 0) continue;
        corners[mesh.polygon_points.count++] =
            (uint32_t)(corner > 0 ? corner - 1 : (long)mesh.positions.count + corner);
        sizes[mesh.polygon_sizes.count]++;
      }
      mesh.polygon_sizes.count++;
    }
  }
  free(text);
  mesh.positions.at = positions;
  mesh.polygon_sizes.at = sizes;
  mesh.polygon_points.at = corners;
  return mesh;
}
