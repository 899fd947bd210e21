#include "reference_relaxation.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- The file ---- */

static reference_section *begin_section(reference_body *body) {
  body->sections = realloc(body->sections, (body->section_count + 1) * sizeof *body->sections);
  reference_section *s = &body->sections[body->section_count++];
  memset(s, 0, sizeof *s);
  return s;
}

static void read_face(reference_section *s, const char *line, uint32_t first_vertex) {
  reference_face face = {{0}, 0};
  char *end;
  for (const char *at = line + 1; face.count < 4; at = end) {
    long number = strtol(at, &end, 10);
    if (end == at) break;
    face.corners[face.count++] = (uint32_t)number - 1 - first_vertex;
    while (*end && *end != ' ' && *end != '\n') end++; /* over /texture/normal */
  }
  s->faces = realloc(s->faces, (s->face_count + 1) * sizeof *s->faces);
  s->faces[s->face_count++] = face;
}

static void read_vertex(reference_section *s, const char *line) {
  char *at = (char *)(uintptr_t)(line + 1);
  s->at = realloc(s->at, (s->surface_count + 1) * sizeof *s->at);
  for (int k = 0; k < 3; k++) s->at[s->surface_count][k] = strtof(at, &at);
  s->surface_count++;
}

/* ---- Springs ---- */

static bool has(const reference_pair *pairs, uint32_t count, uint32_t a, uint32_t b) {
  for (uint32_t i = 0; i < count; i++)
    if ((pairs[i].a == a && pairs[i].b == b) || (pairs[i].a == b && pairs[i].b == a)) return true;
  return false;
}

static void hang(
    reference_section *s, reference_spring **lists, uint32_t *counts, uint32_t point, uint32_t other) {
  float x = s->at[other][0] - s->at[point][0], y = s->at[other][1] - s->at[point][1],
        z = s->at[other][2] - s->at[point][2];
  lists[point] = realloc(lists[point], (counts[point] + 1) * sizeof **lists);
  lists[point][counts[point]++] = (reference_spring){other, sqrtf(x * x + y * y + z * z)};
}

static void join(reference_section *s, reference_pair **pairs, uint32_t *count, reference_spring **lists,
    uint32_t *counts, uint32_t a, uint32_t b) {
  *pairs = realloc(*pairs, (*count + 1) * sizeof **pairs);
  (*pairs)[(*count)++] = (reference_pair){a, b};
  hang(s, lists, counts, a, b);
  hang(s, lists, counts, b, a);
}

static void add_edge(reference_section *s, uint32_t a, uint32_t b) {
  if (!has(s->edges, s->edge_count, a, b))
    join(s, &s->edges, &s->edge_count, s->edges_of, s->edges_of_count, a, b);
}

static void add_diagonal(reference_section *s, uint32_t a, uint32_t b) {
  if (!has(s->edges, s->edge_count, a, b) && !has(s->diagonals, s->diagonal_count, a, b))
    join(s, &s->diagonals, &s->diagonal_count, s->diagonals_of, s->diagonals_of_count, a, b);
}

static void add_inner(reference_section *s, uint32_t a, uint32_t b) {
  s->inner = realloc(s->inner, (s->inner_count + 1) * sizeof *s->inner);
  s->inner[s->inner_count++] = (reference_pair){a, b};
  hang(s, s->inner_of, s->inner_of_count, a, b);
}

static void add_inside(reference_section *s) {
  uint32_t n = s->surface_count, centre = n;
  float sum[3] = {0, 0, 0};
  for (uint32_t i = 0; i < n; i++)
    for (int k = 0; k < 3; k++) sum[k] += s->at[i][k];
  for (int k = 0; k < 3; k++) s->at[centre][k] = sum[k] / (float)n;
  s->point_count = n + 1;
  for (uint32_t f = 0; f < s->face_count; f++) {
    const reference_face *face = &s->faces[f];
    if (face->count != 4) continue;
    float *middle = s->at[s->point_count++];
    for (int k = 0; k < 3; k++) {
      float all = 0;
      for (int c = 0; c < 4; c++) all += s->at[face->corners[c]][k];
      middle[k] = (all + s->at[centre][k]) / 5;
    }
  }
}

static void finish_section(reference_section *s) {
  uint32_t max = s->surface_count + 1 + s->face_count;
  s->at = realloc(s->at, max * sizeof *s->at);
  add_inside(s);
  uint32_t points = s->point_count;
  s->before = malloc(points * sizeof *s->before);
  memcpy(s->before, s->at, points * sizeof *s->before);
  s->used = calloc(s->surface_count, sizeof *s->used);
  s->inner_of = calloc(points, sizeof *s->inner_of), s->edges_of = calloc(points, sizeof *s->edges_of);
  s->diagonals_of = calloc(points, sizeof *s->diagonals_of);
  s->inner_of_count = calloc(points, sizeof(uint32_t)), s->edges_of_count = calloc(points, sizeof(uint32_t));
  s->diagonals_of_count = calloc(points, sizeof(uint32_t));
  uint32_t centre = s->surface_count, quad = centre + 1;
  for (uint32_t i = 0; i < s->surface_count; i++) add_inner(s, centre, i);
  for (uint32_t f = 0; f < s->face_count; f++) {
    const reference_face *face = &s->faces[f];
    for (uint32_t c = 0; c < face->count; c++) {
      s->used[face->corners[c]] = true;
      add_edge(s, face->corners[c], face->corners[(c + 1) % face->count]);
    }
    if (face->count != 4) continue;
    for (int c = 0; c < 4; c++) add_inner(s, quad, face->corners[c]);
    add_inner(s, quad, centre);
    quad++;
  }
  for (uint32_t f = 0; f < s->face_count; f++) {
    const reference_face *face = &s->faces[f];
    if (face->count != 4) continue;
    add_diagonal(s, face->corners[0], face->corners[2]);
    add_diagonal(s, face->corners[1], face->corners[3]);
  }
}

bool reference_read(reference_body *body, const char *text) {
  *body = (reference_body){NULL, 0};
  reference_section *section = NULL;
  uint32_t vertex_count = 0, first_vertex = 0;
  for (const char *line = text; line; line = strchr(line, '\n') ? strchr(line, '\n') + 1 : NULL) {
    if (line[0] == 'g' && line[1] == ' ') {
      section = begin_section(body);
      first_vertex = vertex_count;
    } else if (line[0] == 'v' && line[1] == ' ' && section) {
      read_vertex(section, line);
      vertex_count++;
    } else if (line[0] == 'f' && line[1] == ' ' && section) {
      read_face(section, line, first_vertex);
    }
  }
  for (uint32_t i = 0; i < body->section_count; i++) finish_section(&body->sections[i]);
  return body->section_count > 0;
}

void reference_free(reference_body *body) {
  for (uint32_t i = 0; i < body->section_count; i++) {
    reference_section *s = &body->sections[i];
    for (uint32_t p = 0; p < s->point_count; p++)
      free(s->inner_of[p]), free(s->edges_of[p]), free(s->diagonals_of[p]);
    free(s->inner_of), free(s->edges_of), free(s->diagonals_of), free(s->inner_of_count);
    free(s->edges_of_count), free(s->diagonals_of_count), free(s->inner), free(s->edges), free(s->diagonals);
    free(s->used), free(s->faces), free(s->before), free(s->at);
  }
  free(body->sections);
}

/* ---- The motion ---- */

static void clamp(float *p, bool ground) {
  if (ground && p[1] <= 0) p[1] = 0;
}

static void correct(reference_section *s, uint32_t a, const reference_spring *spring, float k, bool ground) {
  float *p = s->at[a], *q = s->at[spring->other], d[3];
  bool p_free = a < s->surface_count, q_free = spring->other < s->surface_count;
  if (!p_free && !q_free) return;
  for (int i = 0; i < 3; i++) d[i] = q[i] - p[i];
  float length = sqrtf(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  if (length == 0) return;
  float amount = k * (length - spring->rest);
  for (int i = 0; i < 3; i++) {
    float move = d[i] / length * amount * (p_free && q_free ? 0.5f : 1.0f);
    if (p_free) p[i] += move;
    if (q_free) q[i] -= move;
  }
  if (p_free) clamp(p, ground);
  if (q_free) clamp(q, ground);
}

static void tick_section(reference_section *s, float gravity, float k, bool ground) {
  for (uint32_t i = 0; i < s->surface_count; i++) {
    float *p = s->at[i], *old = s->before[i];
    if (ground && p[1] == 0) continue;
    for (int c = 0; c < 3; c++) {
      float next = 2 * p[c] - old[c] - (c == 1 ? gravity : 0);
      old[c] = p[c];
      p[c] = next;
    }
    clamp(p, ground);
  }
  for (uint32_t i = s->surface_count; i < s->point_count; i++)
    for (uint32_t j = 0; j < s->inner_of_count[i]; j++) correct(s, i, &s->inner_of[i][j], k, ground);
  for (uint32_t i = 0; i < s->surface_count; i++)
    for (uint32_t j = 0; j < s->edges_of_count[i]; j++) correct(s, i, &s->edges_of[i][j], k, ground);
  for (uint32_t i = 0; i < s->surface_count; i++)
    for (uint32_t j = 0; j < s->diagonals_of_count[i]; j++) correct(s, i, &s->diagonals_of[i][j], k, ground);
  for (uint32_t i = 0; i < s->surface_count; i++) {
    float *p = s->at[i];
    if (ground && p[1] == 0) continue;
    for (int c = 0; c < 3; c++) p[c] = s->before[i][c] + 0.9f * (p[c] - s->before[i][c]);
    clamp(p, ground);
  }
}

void reference_tick(reference_body *body, float gravity, float stiffness, bool ground) {
  for (uint32_t i = 0; i < body->section_count; i++)
    tick_section(&body->sections[i], gravity, stiffness, ground);
}
