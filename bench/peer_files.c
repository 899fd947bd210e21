#define _POSIX_C_SOURCE 200809L
#include "peer_files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "measuring.h"

size_t file_size_of(const char *path) {
  struct stat about;
  if (stat(path, &about) != 0) bench_fail("%s is not there", path);
  return (size_t)about.st_size;
}

static void close_file(FILE *file, const char *path) {
  if (fclose(file) != 0) bench_fail("%s cannot be written", path);
}

static FILE *open_file(const char *path) {
  FILE *file = fopen(path, "wb");
  if (!file) bench_fail("%s cannot be made", path);
  return file;
}

/* ---- GLB ---- */

/* A text or a row of bytes that grows. */
typedef struct memory_stream {
  FILE *file;
  char *at;
  size_t size;
} memory_stream;

static void open_stream(memory_stream *stream) {
  stream->file = open_memstream(&stream->at, &stream->size);
  if (!stream->file) bench_fail("memory ran out");
}

typedef struct glb_writer {
  memory_stream bytes, views, accessors, meshes, nodes;
  uint32_t accessor_count;
  size_t used; /* bytes of the binary part */
} glb_writer;

enum { GL_U8 = 5121, GL_U16 = 5123, GL_U32 = 5125, GL_F32 = 5126, GL_ARRAY = 34962, GL_ELEMENTS = 34963 };

/* Adds an array with a view and an accessor of its own; `bounds` are of positions. Returns its number. */
static uint32_t add_array(glb_writer *w, const void *items, size_t count, size_t item_size, int component,
    const char *type, const float *bounds) {
  size_t size = count * item_size, padding = (4 - size % 4) % 4;
  fprintf(w->views.file, "%s{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu,\"target\":%d}",
      w->accessor_count ? "," : "", w->used, size, strcmp(type, "SCALAR") == 0 ? GL_ELEMENTS : GL_ARRAY);
  fprintf(w->accessors.file, "%s{\"bufferView\":%u,\"componentType\":%d,\"count\":%zu,\"type\":\"%s\"",
      w->accessor_count ? "," : "", w->accessor_count, component, count, type);
  if (bounds)
    fprintf(w->accessors.file, ",\"min\":[%.9g,%.9g,%.9g],\"max\":[%.9g,%.9g,%.9g]", (double)bounds[0],
        (double)bounds[1], (double)bounds[2], (double)bounds[3], (double)bounds[4], (double)bounds[5]);
  fputs("}", w->accessors.file);
  fwrite(items, 1, size, w->bytes.file);
  fwrite("\0\0\0", 1, padding, w->bytes.file);
  w->used += size + padding;
  return w->accessor_count++;
}

/* A vertex of GLB: what may differ between the corners of one point. */
typedef struct glb_vertex {
  uint32_t point, normal, coordinate, next; /* next vertex of the same point */
} glb_vertex;

typedef struct glb_mesh {
  const sbf_render_mesh *from;
  glb_vertex *vertices;
  uint32_t *indices, *first; /* first vertex of each point */
  uint32_t vertex_count, index_count;
} glb_mesh;

static uint32_t vertex_of(glb_mesh *m, uint32_t corner) {
  const sbf_render_mesh *from = m->from;
  const sbf_uv_set *uv = from->uv_sets.count ? from->uv_sets.at : NULL;
  uint32_t point = from->mesh.polygon_points.at[corner];
  glb_vertex v = {point, from->normal_corners.count ? from->normal_corners.at[corner] : point,
      uv && uv->corners.count ? uv->corners.at[corner] : point, m->first[point]};
  for (uint32_t i = v.next; i != UINT32_MAX; i = m->vertices[i].next)
    if (m->vertices[i].normal == v.normal && m->vertices[i].coordinate == v.coordinate) return i;
  m->vertices[m->vertex_count] = v;
  return m->first[point] = m->vertex_count++;
}

static void split(glb_mesh *m) {
  const sbf_polygon_mesh *mesh = &m->from->mesh;
  uint32_t corners = mesh->polygon_points.count;
  m->vertices = bench_allocate(corners, sizeof *m->vertices);
  m->indices = bench_allocate(3 * (size_t)corners, sizeof *m->indices);
  m->first = bench_allocate(mesh->positions.count, sizeof *m->first);
  memset(m->first, 0xff, mesh->positions.count * sizeof *m->first);
  for (uint32_t p = 0, at = 0; p < mesh->polygon_sizes.count; at += mesh->polygon_sizes.at[p++]) {
    uint32_t first = vertex_of(m, at), before = vertex_of(m, at + 1);
    for (uint32_t k = 2; k < mesh->polygon_sizes.at[p]; k++) {
      uint32_t corner = vertex_of(m, at + k);
      m->indices[m->index_count++] = first;
      m->indices[m->index_count++] = before;
      m->indices[m->index_count++] = before = corner;
    }
  }
}

static uint32_t add_positions(glb_writer *w, const glb_mesh *m) {
  sbf_vec3 *out = bench_allocate(m->vertex_count, sizeof *out);
  float bounds[6];
  for (uint32_t i = 0; i < m->vertex_count; i++) {
    out[i] = m->from->mesh.positions.at[m->vertices[i].point];
    const float xyz[3] = {out[i].x, out[i].y, out[i].z};
    for (int k = 0; k < 3; k++) {
      if (i == 0 || xyz[k] < bounds[k]) bounds[k] = xyz[k];
      if (i == 0 || xyz[k] > bounds[k + 3]) bounds[k + 3] = xyz[k];
    }
  }
  uint32_t number = add_array(w, out, m->vertex_count, sizeof *out, GL_F32, "VEC3", bounds);
  free(out);
  return number;
}

static uint32_t add_normals(glb_writer *w, const glb_mesh *m) {
  sbf_vec3 *out = bench_allocate(m->vertex_count, sizeof *out);
  for (uint32_t i = 0; i < m->vertex_count; i++) out[i] = m->from->normals.at[m->vertices[i].normal];
  uint32_t number = add_array(w, out, m->vertex_count, sizeof *out, GL_F32, "VEC3", NULL);
  free(out);
  return number;
}

static uint32_t add_coordinates(glb_writer *w, const glb_mesh *m) {
  sbf_vec2 *out = bench_allocate(m->vertex_count, sizeof *out);
  for (uint32_t i = 0; i < m->vertex_count; i++)
    out[i] = m->from->uv_sets.at[0].coordinates.at[m->vertices[i].coordinate];
  uint32_t number = add_array(w, out, m->vertex_count, sizeof *out, GL_F32, "VEC2", NULL);
  free(out);
  return number;
}

/* The four heaviest influences of a point, heaviest first. */
static void heaviest(
    const sbf_skin *skin, uint32_t begin, uint32_t count, uint8_t joints[4], float weights[4]) {
  for (uint32_t k = 0; k < count; k++) {
    uint32_t bone = skin->bones.at[begin + k];
    float weight = skin->weights.at[begin + k];
    for (int slot = 0; slot < 4; slot++) {
      if (weight <= weights[slot]) continue;
      uint32_t lighter_bone = joints[slot];
      float lighter = weights[slot];
      joints[slot] = (uint8_t)bone, weights[slot] = weight;
      bone = lighter_bone, weight = lighter;
    }
  }
}

static void add_skin(glb_writer *w, const glb_mesh *m) {
  const sbf_skin *skin = m->from->skin;
  uint32_t points = m->from->mesh.positions.count, begin = 0;
  uint32_t *begins = bench_allocate(points, sizeof *begins);
  uint8_t(*joints)[4] = bench_allocate(m->vertex_count, sizeof *joints);
  float(*weights)[4] = bench_allocate(m->vertex_count, sizeof *weights);
  for (uint32_t i = 0; i < points; i++) begins[i] = begin, begin += skin->influence_counts.at[i];
  for (uint32_t i = 0; i < m->vertex_count; i++) {
    uint32_t point = m->vertices[i].point;
    heaviest(skin, begins[point], skin->influence_counts.at[point], joints[i], weights[i]);
  }
  uint32_t number = add_array(w, joints, m->vertex_count, sizeof *joints, GL_U8, "VEC4", NULL);
  add_array(w, weights, m->vertex_count, sizeof *weights, GL_F32, "VEC4", NULL);
  fprintf(w->meshes.file, ",\"JOINTS_0\":%u,\"WEIGHTS_0\":%u", number, number + 1);
  free(begins);
  free(joints);
  free(weights);
}

static uint32_t add_indices(glb_writer *w, const glb_mesh *m) {
  if (m->vertex_count > UINT16_MAX)
    return add_array(w, m->indices, m->index_count, sizeof *m->indices, GL_U32, "SCALAR", NULL);
  uint16_t *narrow = bench_allocate(m->index_count, sizeof *narrow);
  for (uint32_t i = 0; i < m->index_count; i++) narrow[i] = (uint16_t)m->indices[i];
  uint32_t number = add_array(w, narrow, m->index_count, sizeof *narrow, GL_U16, "SCALAR", NULL);
  free(narrow);
  return number;
}

static void add_mesh(glb_writer *w, const sbf_render_mesh *from, uint32_t number) {
  glb_mesh m = {.from = from};
  split(&m);
  fprintf(w->meshes.file, "%s{\"primitives\":[{\"attributes\":{\"POSITION\":%u", number ? "," : "",
      add_positions(w, &m));
  if (from->normals.count) fprintf(w->meshes.file, ",\"NORMAL\":%u", add_normals(w, &m));
  if (from->uv_sets.count) fprintf(w->meshes.file, ",\"TEXCOORD_0\":%u", add_coordinates(w, &m));
  if (from->skin) add_skin(w, &m);
  fprintf(w->meshes.file, "},\"indices\":%u}]}", add_indices(w, &m));
  fprintf(w->nodes.file, "%s{\"mesh\":%u,\"name\":\"part%u\"}", number ? "," : "", number, number);
  free(m.vertices);
  free(m.indices);
  free(m.first);
}

static void write_u32(FILE *file, size_t value) {
  const uint8_t bytes[4] = {
      (uint8_t)value, (uint8_t)(value >> 8), (uint8_t)(value >> 16), (uint8_t)(value >> 24)};
  fwrite(bytes, 1, 4, file);
}

/* A mesh without polygons has no place in glTF. */
static bool is_drawn(const sbf_render_mesh *mesh) {
  return mesh->mesh.polygon_sizes.count > 0;
}

static void make_document(glb_writer *w, uint32_t count, memory_stream *json) {
  fprintf(json->file, "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[");
  for (uint32_t i = 0; i < count; i++) fprintf(json->file, "%s%u", i ? "," : "", i);
  fprintf(json->file, "]}],\"nodes\":[%s],\"meshes\":[%s],\"accessors\":[%s],\"bufferViews\":[%s]",
      w->nodes.at, w->meshes.at, w->accessors.at, w->views.at);
  fprintf(json->file, ",\"buffers\":[{\"byteLength\":%zu}]}", w->used);
  fflush(json->file);
  while (json->size % 4) fputc(' ', json->file), fflush(json->file);
}

void write_glb(const char *path, const sbf_asset *asset) {
  glb_writer w = {.used = 0};
  memory_stream json, *const streams[] = {&w.bytes, &w.views, &w.accessors, &w.meshes, &w.nodes, &json};
  uint32_t count = 0;
  for (size_t i = 0; i < sizeof streams / sizeof *streams; i++) open_stream(streams[i]);
  for (uint32_t i = 0; i < asset->render_meshes.count; i++)
    if (is_drawn(&asset->render_meshes.at[i])) add_mesh(&w, &asset->render_meshes.at[i], count++);
  for (size_t i = 0; i < sizeof streams / sizeof *streams; i++) fflush(streams[i]->file);
  make_document(&w, count, &json);
  FILE *file = open_file(path);
  fwrite("glTF", 1, 4, file);
  write_u32(file, 2);
  write_u32(file, 12 + 8 + json.size + 8 + w.used);
  write_u32(file, json.size);
  fwrite("JSON", 1, 4, file);
  fwrite(json.at, 1, json.size, file);
  write_u32(file, w.used);
  fwrite("BIN\0", 1, 4, file);
  fwrite(w.bytes.at, 1, w.used, file);
  close_file(file, path);
  for (size_t i = 0; i < sizeof streams / sizeof *streams; i++) {
    fclose(streams[i]->file);
    free(streams[i]->at);
  }
}

/* ---- OBJ ---- */

/* The shortest of the texts that read back as the same number. */
static void print_number(FILE *file, float value) {
  char text[32];
  for (int digits = 6; digits <= 9; digits++) {
    snprintf(text, sizeof text, "%.*g", digits, (double)value);
    if (strtof(text, NULL) == value) break;
  }
  fprintf(file, " %s", text);
}

static void print_numbers(FILE *file, const char *word, const float *numbers, uint32_t rows, int columns) {
  for (uint32_t i = 0; i < rows; i++) {
    fputs(word, file);
    for (int k = 0; k < columns; k++) print_number(file, numbers[i * (uint32_t)columns + (uint32_t)k]);
    fputc('\n', file);
  }
}

/* How many of each kind stand above; OBJ counts through the whole file, from 1. */
typedef struct obj_counts {
  uint32_t points, coordinates, normals;
} obj_counts;

static void print_corner(FILE *file, const sbf_render_mesh *mesh, uint32_t corner, const obj_counts *above) {
  const sbf_uv_set *uv = mesh->uv_sets.count ? mesh->uv_sets.at : NULL;
  uint32_t point = mesh->mesh.polygon_points.at[corner];
  fprintf(file, " %u", above->points + point + 1);
  if (uv) fprintf(file, "/%u", above->coordinates + (uv->corners.count ? uv->corners.at[corner] : point) + 1);
  if (!mesh->normals.count) return;
  uint32_t normal = mesh->normal_corners.count ? mesh->normal_corners.at[corner] : point;
  fprintf(file, "%s/%u", uv ? "" : "/", above->normals + normal + 1);
}

void write_obj(const char *path, const sbf_asset *asset) {
  FILE *file = open_file(path);
  obj_counts above = {0, 0, 0};
  for (uint32_t i = 0; i < asset->render_meshes.count; i++) {
    const sbf_render_mesh *mesh = &asset->render_meshes.at[i];
    const sbf_vec2_list *coordinates = mesh->uv_sets.count ? &mesh->uv_sets.at[0].coordinates : NULL;
    fprintf(file, "o part%u\n", i);
    if (mesh->mesh.positions.count)
      print_numbers(file, "v", &mesh->mesh.positions.at->x, mesh->mesh.positions.count, 3);
    if (coordinates && coordinates->count)
      print_numbers(file, "vt", &coordinates->at->x, coordinates->count, 2);
    if (mesh->normals.count) print_numbers(file, "vn", &mesh->normals.at->x, mesh->normals.count, 3);
    for (uint32_t p = 0, at = 0; p < mesh->mesh.polygon_sizes.count; p++) {
      fputc('f', file);
      for (uint32_t k = 0; k < mesh->mesh.polygon_sizes.at[p]; k++) print_corner(file, mesh, at++, &above);
      fputc('\n', file);
    }
    above.points += mesh->mesh.positions.count;
    above.coordinates += coordinates ? coordinates->count : 0;
    above.normals += mesh->normals.count;
  }
  close_file(file, path);
}
