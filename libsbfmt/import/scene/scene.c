#include "import/scene/scene.h"

#include <math.h>
#include <string.h>

#include "base/diagnostic.h"

enum { NAME_LIMIT = 1024 }; /* longer names are truncated; no other limit is as large */

bool sbfi_scene_init(
    sbfi_scene *scene, const sbf_allocator *allocator, size_t memory_limit_bytes, const char *file) {
  *scene = (sbfi_scene){.unit_m = 1, .axes = sbfi_matrix_identity(), .format = "", .generator = ""};
  sbfi_arena_init(&scene->arena, allocator, memory_limit_bytes);
  scene->file = sbfi_scene_string(scene, sbfi_span_of(file));
  scene->path = sbfi_arena_string(&scene->arena, file, strlen(file));
  return scene->file && scene->path;
}

void sbfi_scene_free(sbfi_scene *scene) {
  sbfi_arena_free(&scene->arena);
  *scene = (sbfi_scene){0};
}

sbf_status sbfi_scene_fail(sbfi_scene *scene, sbf_diagnostic *error, sbf_status status) {
  if (error && scene->file) sbfi_copy_text(error->file, sizeof error->file, scene->file);
  sbfi_scene_free(scene);
  return status;
}

bool sbfi_scene_warn(sbfi_scene *scene, sbf_code code, uint32_t line, const char *format, ...) {
  if (!scene->warnings)
    scene->warnings = sbfi_arena_allocate(&scene->arena, SBFI_SCENE_WARNINGS, sizeof *scene->warnings);
  if (!scene->warnings) return false;
  if (scene->warning_count == SBFI_SCENE_WARNINGS) {
    scene->warnings_left_out++;
    return true;
  }
  sbf_diagnostic *warning = &scene->warnings[scene->warning_count++];
  va_list arguments;
  va_start(arguments, format);
  sbfi_diagnose_v(warning, code, format, arguments);
  va_end(arguments);
  sbfi_copy_text(warning->file, sizeof warning->file, scene->file);
  warning->line = line;
  return true;
}

/* Length of the prefix that needs no replacement, at most `length`: no control characters, U+FFFE and
 * U+FFFF, which XML cannot represent. */
static size_t good_length(const char *text, size_t length) {
  size_t good = sbfi_utf8_check(text, length);
  for (size_t i = 0; i < good; i++) {
    const uint8_t *at = (const uint8_t *)text + i;
    if (*at < 0x20 || *at == 0x7f) return i;
    if (*at == 0xef && at[1] == 0xbf && at[2] >= 0xbe) return i;
  }
  return good;
}

const char *sbfi_scene_string(sbfi_scene *scene, sbfi_span text) {
  static const char replacement[] = "\xEF\xBF\xBD";
  size_t limit = text.length < NAME_LIMIT ? text.length : NAME_LIMIT;
  char *copy = sbfi_arena_allocate(&scene->arena, 3 * limit + 1, 1);
  if (!copy) return NULL;
  size_t length = 0;
  for (size_t at = 0; at < limit;) {
    size_t good = good_length(text.at + at, limit - at);
    memcpy(copy + length, text.at + at, good);
    length += good;
    at += good;
    if (at == limit) break;
    memcpy(copy + length, replacement, 3);
    length += 3;
    at++;
  }
  return copy;
}

uint32_t sbfi_scene_bone_count(const sbfi_scene *scene) {
  uint32_t count = 0;
  for (uint32_t i = 0; i < scene->node_count; i++) count += scene->nodes[i].is_bone;
  return count;
}

sbfi_matrix sbfi_matrix_identity(void) {
  return (sbfi_matrix){{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
}

sbfi_matrix sbfi_matrix_multiply(const sbfi_matrix *a, const sbfi_matrix *b) {
  sbfi_matrix product;
  for (int row = 0; row < 4; row++)
    for (int column = 0; column < 4; column++) {
      double sum = 0;
      for (int k = 0; k < 4; k++) sum += a->at[row][k] * b->at[k][column];
      product.at[row][column] = sum;
    }
  return product;
}

bool sbfi_matrix_invert(const sbfi_matrix *matrix, sbfi_matrix *to) {
  const double(*m)[4] = matrix->at;
  sbfi_matrix inverse = {.at[3][3] = 1};
  for (int row = 0; row < 3; row++)
    for (int column = 0; column < 3; column++) {
      int a = (column + 1) % 3, b = (column + 2) % 3, c = (row + 1) % 3, d = (row + 2) % 3;
      inverse.at[row][column] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
    }
  double determinant = m[0][0] * inverse.at[0][0] + m[0][1] * inverse.at[1][0] + m[0][2] * inverse.at[2][0];
  if (!(fabs(determinant) > 0) || !isfinite(1 / determinant)) return false;
  for (int row = 0; row < 3; row++) {
    for (int column = 0; column < 3; column++) inverse.at[row][column] /= determinant;
    for (int k = 0; k < 3; k++) inverse.at[row][3] -= inverse.at[row][k] * m[k][3];
    if (!isfinite(inverse.at[row][3])) return false;
  }
  *to = inverse;
  return true;
}

void sbfi_scene_set_worlds(sbfi_scene_node *nodes, uint32_t node_count) {
  for (uint32_t i = 0; i < node_count; i++) {
    const sbfi_scene_node *parent = nodes[i].parent == SBF_NONE ? NULL : &nodes[nodes[i].parent];
    nodes[i].world = parent ? sbfi_matrix_multiply(&parent->world, &nodes[i].local) : nodes[i].local;
  }
}

sbfi_matrix sbfi_scene_mesh_world(const sbfi_scene *scene, const sbfi_scene_mesh *mesh) {
  if (!mesh->skin.joint_count) return scene->nodes[mesh->node].world;
  return sbfi_matrix_multiply(&scene->nodes[mesh->skin.joints[0].node].world, &mesh->skin.joints[0].bind);
}
