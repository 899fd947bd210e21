/* Divides the content of an OBJ file into meshes by its objects and groups. */
#include <math.h>
#include <string.h>

#include "base/diagnostic.h"
#include "base/file.h"
#include "import/obj/obj.h"

/* Indices of a list that each mesh uses, ascending: those of mesh m are items[starts[m]] to items[starts[m +
 * 1]]. */
typedef struct gathered {
  uint32_t *starts, *items;
} gathered;

typedef struct division {
  sbfi_scene *scene;
  const sbfi_obj_text *text;
  sbfi_arena scratch;
  uint32_t polygon_count, corner_count, mesh_count;
  const sbfi_obj_polygon *polygons;
  const sbfi_obj_corner *corners;
  sbfi_span *names;        /* (mesh_count) */
  int32_t *run_meshes;     /* (runs) mesh of each run, SBF_NONE for a run without polygons */
  uint32_t *mesh_starts;   /* (mesh_count + 1) into polygon_order */
  uint32_t *polygon_order; /* (polygon_count) polygons of each mesh in the file's order */
  uint32_t *local;         /* (longest list) index in a mesh of an item of the file */
  gathered kinds[SBFI_OBJ_KINDS];
} division;

static void *allocate(division *d, size_t count, size_t size) {
  return sbfi_arena_allocate(&d->scratch, count ? count : 1, size);
}

static uint32_t corner_end(const division *d, uint32_t polygon) {
  return polygon + 1 < d->polygon_count ? d->polygons[polygon + 1].first_corner : d->corner_count;
}

static uint32_t run_end(const division *d, size_t run) {
  const sbfi_obj_run *runs = d->text->runs.at;
  return run + 1 < d->text->runs.count ? runs[run + 1].first_polygon : d->polygon_count;
}

static sbfi_span file_stem(const char *path) {
  const char *first = sbfi_path_name(path), *dot = strrchr(first, '.');
  return (sbfi_span){first, dot && dot > first ? (size_t)(dot - first) : strlen(first)};
}

/* Numbers the meshes: one per `o` line or per `g` name with polygons. Key 0 is the part before them. */
static bool number_meshes(division *d) {
  const sbfi_obj_text *text = d->text;
  const sbfi_obj_run *runs = text->runs.at;
  bool by_object = text->objects.count > 0;
  const sbfi_array *keys = by_object ? &text->objects : &text->groups.names;
  size_t key_count = keys->count + 1, run_count = text->runs.count;
  uint32_t *counts = allocate(d, key_count, sizeof *counts);
  int32_t *mesh_of_key = allocate(d, key_count, sizeof *mesh_of_key);
  d->run_meshes = allocate(d, run_count, sizeof *d->run_meshes);
  d->names = allocate(d, key_count, sizeof *d->names);
  d->mesh_starts = allocate(d, key_count + 1, sizeof *d->mesh_starts);
  d->polygon_order = allocate(d, d->polygon_count, sizeof *d->polygon_order);
  if (!counts || !mesh_of_key || !d->run_meshes || !d->names || !d->mesh_starts || !d->polygon_order)
    return false;
  for (size_t run = 0; run < run_count; run++)
    counts[(by_object ? runs[run].object : runs[run].group) + 1] += run_end(d, run) - runs[run].first_polygon;
  const sbfi_span *names = keys->at;
  for (size_t key = 0; key < key_count; key++) {
    mesh_of_key[key] = counts[key] ? (int32_t)d->mesh_count : SBF_NONE;
    if (!counts[key]) continue;
    bool named = key > 0 && names[key - 1].length > 0;
    d->names[d->mesh_count] = named ? names[key - 1] : file_stem(d->scene->file);
    d->mesh_starts[d->mesh_count + 1] = d->mesh_starts[d->mesh_count] + counts[key];
    d->mesh_count++;
  }
  uint32_t *cursors = sbfi_arena_copy(&d->scratch, d->mesh_starts, key_count + 1, sizeof *cursors);
  if (!cursors) return false;
  for (size_t run = 0; run < run_count; run++) {
    int32_t mesh = mesh_of_key[(by_object ? runs[run].object : runs[run].group) + 1];
    d->run_meshes[run] = mesh;
    for (uint32_t p = runs[run].first_polygon; p < run_end(d, run); p++)
      d->polygon_order[cursors[mesh]++] = p;
  }
  return true;
}

/* Calls `visit` once for each item of the kind that each mesh uses, meshes ascending. `marks` is zeroed. */
static void visit_used(const division *d, uint32_t kind, uint32_t *marks,
    void (*visit)(void *state, uint32_t mesh, uint32_t item), void *state) {
  for (uint32_t mesh = 0; mesh < d->mesh_count; mesh++)
    for (uint32_t k = d->mesh_starts[mesh]; k < d->mesh_starts[mesh + 1]; k++) {
      uint32_t polygon = d->polygon_order[k], end = corner_end(d, polygon);
      for (uint32_t c = d->polygons[polygon].first_corner; c < end; c++) {
        int32_t item = d->corners[c].index[kind];
        if (item == SBF_NONE || marks[item] == mesh + 1) continue;
        marks[item] = mesh + 1;
        visit(state, mesh, (uint32_t)item);
      }
    }
}

typedef struct usage {
  uint32_t *mesh_counts; /* items of each mesh */
  uint32_t *users;       /* number of meshes of each item, then the next index into item_meshes */
  uint32_t *first;       /* first mesh of each item, 1-based, 0: none; NULL: not needed */
  uint32_t *item_meshes; /* meshes of each item, concatenated */
} usage;

static void count_use(void *state, uint32_t mesh, uint32_t item) {
  usage *u = state;
  u->mesh_counts[mesh]++;
  u->users[item]++;
  if (u->first && !u->first[item]) u->first[item] = mesh + 1;
}

static void note_use(void *state, uint32_t mesh, uint32_t item) {
  usage *u = state;
  u->item_meshes[u->users[item]++] = mesh;
}

/* An unused point is separated from the others if it is farther outside the box around the used ones than
 * this fraction of the box's diagonal: it would pass for the size of the character. */
static const double SEPARATION = 0.5;

typedef struct box {
  double low[3], high[3];
} box;

static void read_point(const division *d, uint32_t point, double at[3]) {
  const sbf_vec3 p = ((const sbf_vec3 *)d->text->points.at)[point];
  at[0] = (double)p.x, at[1] = (double)p.y, at[2] = (double)p.z;
}

/* Box that contains the used points and what is near them. */
static box find_box(const division *d, uint32_t point_count, const usage *u) {
  box b = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
  double squared = 0, at[3];
  for (uint32_t p = 0; p < point_count; p++) {
    if (!u->users[p]) continue;
    read_point(d, p, at);
    for (int k = 0; k < 3; k++) b.low[k] = fmin(b.low[k], at[k]), b.high[k] = fmax(b.high[k], at[k]);
  }
  for (int k = 0; k < 3; k++) squared += (b.high[k] - b.low[k]) * (b.high[k] - b.low[k]);
  for (int k = 0; k < 3; k++) b.low[k] -= SEPARATION * sqrt(squared), b.high[k] += SEPARATION * sqrt(squared);
  return b;
}

static bool is_separated(const division *d, const box *b, uint32_t point) {
  double at[3];
  read_point(d, point, at);
  for (int k = 0; k < 3; k++)
    if (at[k] < b->low[k] || at[k] > b->high[k]) return true;
  return false;
}

/* Assigns a point without polygons to the mesh of the next used point of its block of v lines, else of the
 * previous one, else to the mesh whose lines surround it. Returns the number of points without a mesh, as
 * those apart from all others. */
static uint32_t adopt_unused(const division *d, uint32_t point_count, usage *u) {
  const sbfi_obj_block *blocks = d->text->blocks.at;
  const box near = find_box(d, point_count, u);
  uint32_t left_out = 0;
  for (size_t b = 0; b < d->text->blocks.count; b++) {
    uint32_t first = blocks[b].first_point;
    uint32_t end = b + 1 < d->text->blocks.count ? blocks[b + 1].first_point : point_count;
    uint32_t owner = 0, before = 0;
    int32_t around = d->run_meshes[blocks[b].run];
    for (uint32_t p = end; p-- > first;) {
      if (u->users[p])
        owner = u->first[p];
      else
        u->first[p] = owner;
    }
    for (uint32_t p = first; p < end; p++) {
      if (u->users[p]) {
        before = u->first[p];
        continue;
      }
      if (!u->first[p]) u->first[p] = before ? before : (uint32_t)(around + 1);
      if (is_separated(d, &near, p)) u->first[p] = 0;
      if (!u->first[p]) {
        left_out++;
        continue;
      }
      u->users[p] = 1;
      u->mesh_counts[u->first[p] - 1]++;
    }
  }
  return left_out;
}

/* Finds the items that each mesh uses, ascending: two counting sorts, by item and then by mesh. */
static bool gather(division *d, uint32_t kind, uint32_t item_count, uint32_t *left_out) {
  bool points = kind == SBFI_OBJ_POINT;
  uint32_t *marks = allocate(d, item_count, sizeof *marks);
  uint32_t *unused = points ? allocate(d, item_count, sizeof *unused) : NULL;
  usage u = {allocate(d, d->mesh_count, sizeof(uint32_t)), allocate(d, item_count, sizeof(uint32_t)),
      points ? allocate(d, item_count, sizeof(uint32_t)) : NULL, NULL};
  gathered *out = &d->kinds[kind];
  out->starts = allocate(d, (size_t)d->mesh_count + 1, sizeof(uint32_t));
  if (!marks || (points && (!unused || !u.first)) || !u.mesh_counts || !u.users || !out->starts) return false;

  visit_used(d, kind, marks, count_use, &u);
  if (points) {
    for (uint32_t p = 0; p < item_count; p++) unused[p] = !u.users[p];
    *left_out = adopt_unused(d, item_count, &u);
  }
  for (uint32_t mesh = 0; mesh < d->mesh_count; mesh++)
    out->starts[mesh + 1] = out->starts[mesh] + u.mesh_counts[mesh];
  uint32_t total = out->starts[d->mesh_count], sum = 0;
  u.item_meshes = allocate(d, total, sizeof(uint32_t));
  out->items = allocate(d, total, sizeof(uint32_t));
  if (!u.item_meshes || !out->items) return false;

  for (uint32_t item = 0; item < item_count; item++) {
    uint32_t users = u.users[item];
    u.users[item] = sum;
    sum += users;
    marks[item] = 0;
  }
  visit_used(d, kind, marks, note_use, &u);
  for (uint32_t p = 0; points && p < item_count; p++)
    if (unused[p] && u.first[p]) note_use(&u, u.first[p] - 1, p);
  /* users[item] is now the end of the item's meshes */
  memcpy(u.mesh_counts, out->starts, d->mesh_count * sizeof(uint32_t));
  for (uint32_t item = 0, k = 0; item < item_count; item++)
    for (; k < u.users[item]; k++) out->items[u.mesh_counts[u.item_meshes[k]]++] = item;
  return true;
}

static void *arena_allocate(division *d, size_t count, size_t size) {
  return sbfi_arena_allocate(&d->scene->arena, count ? count : 1, size);
}

/* Copies the entries of a corner attribute that the mesh uses, and renumbers its corners. */
static bool copy_corners(
    division *d, uint32_t mesh, uint32_t kind, uint32_t corner_count, int32_t **indices) {
  const gathered *g = &d->kinds[kind];
  for (uint32_t k = g->starts[mesh]; k < g->starts[mesh + 1]; k++)
    d->local[g->items[k]] = k - g->starts[mesh];
  int32_t *to = *indices = arena_allocate(d, corner_count, sizeof *to);
  if (!to) return false;
  for (uint32_t k = d->mesh_starts[mesh]; k < d->mesh_starts[mesh + 1]; k++) {
    uint32_t polygon = d->polygon_order[k], end = corner_end(d, polygon);
    for (uint32_t c = d->polygons[polygon].first_corner; c < end; c++) {
      int32_t item = d->corners[c].index[kind];
      *to++ = item == SBF_NONE ? SBF_NONE : (int32_t)d->local[item];
    }
  }
  return true;
}

static bool make_polygons(division *d, uint32_t mesh, sbfi_scene_mesh *to) {
  to->polygon_count = d->mesh_starts[mesh + 1] - d->mesh_starts[mesh];
  uint32_t *starts = arena_allocate(d, (size_t)to->polygon_count + 1, sizeof *starts);
  int32_t *materials = arena_allocate(d, to->polygon_count, sizeof *materials), *points;
  if (!starts || !materials) return false;
  for (uint32_t i = 0; i < to->polygon_count; i++) {
    uint32_t polygon = d->polygon_order[d->mesh_starts[mesh] + i];
    materials[i] = d->polygons[polygon].material;
    starts[i + 1] = starts[i] + corner_end(d, polygon) - d->polygons[polygon].first_corner;
  }
  to->polygon_starts = starts;
  to->polygon_materials = materials;
  to->corner_count = starts[to->polygon_count];
  if (!copy_corners(d, mesh, SBFI_OBJ_POINT, to->corner_count, &points)) return false;
  to->corner_points = (const uint32_t *)points;
  return true;
}

static bool make_points(division *d, uint32_t mesh, sbfi_scene_mesh *to) {
  const gathered *g = &d->kinds[SBFI_OBJ_POINT];
  const sbf_vec3 *all = d->text->points.at;
  uint32_t first = g->starts[mesh], count = g->starts[mesh + 1] - first;
  sbf_vec3 *points = arena_allocate(d, count, sizeof *points);
  uint32_t *sources = sbfi_arena_copy(&d->scene->arena, g->items + first, count, sizeof *sources);
  if (!points || !sources) return false;
  for (uint32_t i = 0; i < count; i++) points[i] = all[sources[i]];
  to->point_count = count;
  to->points = points;
  to->point_sources = sources;
  return true;
}

static bool make_normals(division *d, uint32_t mesh, sbfi_scene_mesh *to) {
  const gathered *g = &d->kinds[SBFI_OBJ_NORMAL];
  const sbf_vec3 *all = d->text->normals.at;
  uint32_t first = g->starts[mesh], count = g->starts[mesh + 1] - first;
  if (!count) return true;
  sbf_vec3 *normals = arena_allocate(d, count, sizeof *normals);
  int32_t *corners;
  if (!normals || !copy_corners(d, mesh, SBFI_OBJ_NORMAL, to->corner_count, &corners)) return false;
  for (uint32_t i = 0; i < count; i++) normals[i] = all[g->items[first + i]];
  to->normals.count = count;
  to->normals.at = normals;
  to->normals.corner_index = corners;
  return true;
}

static bool make_uvs(division *d, uint32_t mesh, sbfi_scene_mesh *to) {
  const gathered *g = &d->kinds[SBFI_OBJ_UV];
  const sbf_vec2 *all = d->text->uvs.at;
  uint32_t first = g->starts[mesh], count = g->starts[mesh + 1] - first;
  if (!count) return true;
  sbfi_scene_uvs *set = arena_allocate(d, 1, sizeof *set);
  sbf_vec2 *uvs = arena_allocate(d, count, sizeof *uvs);
  int32_t *corners;
  if (!set || !uvs || !copy_corners(d, mesh, SBFI_OBJ_UV, to->corner_count, &corners)) return false;
  for (uint32_t i = 0; i < count; i++) uvs[i] = all[g->items[first + i]];
  *set = (sbfi_scene_uvs){"", count, uvs, corners};
  to->uv_set_count = 1;
  to->uv_sets = set;
  return true;
}

static bool divide(division *d) {
  const sbfi_obj_text *text = d->text;
  uint32_t counts[] = {
      (uint32_t)text->points.count, (uint32_t)text->uvs.count, (uint32_t)text->normals.count};
  uint32_t longest = 0, left_out = 0;
  for (uint32_t kind = 0; kind < SBFI_OBJ_KINDS; kind++)
    if (counts[kind] > longest) longest = counts[kind];
  d->local = allocate(d, longest, sizeof *d->local);
  if (!d->local || !number_meshes(d)) return false;
  for (uint32_t kind = 0; kind < SBFI_OBJ_KINDS; kind++)
    if (!gather(d, kind, counts[kind], &left_out)) return false;

  sbfi_scene *scene = d->scene;
  sbfi_scene_node *nodes = arena_allocate(d, d->mesh_count, sizeof *nodes);
  sbfi_scene_mesh *meshes = arena_allocate(d, d->mesh_count, sizeof *meshes);
  if (!nodes || !meshes) return false;
  for (uint32_t mesh = 0; mesh < d->mesh_count; mesh++) {
    sbfi_scene_mesh *to = &meshes[mesh];
    const char *name = sbfi_scene_string(scene, d->names[mesh]);
    if (!name) return false;
    nodes[mesh] = (sbfi_scene_node){
        .name = name, .parent = SBF_NONE, .local = sbfi_matrix_identity(), .number = SBF_NONE};
    *to = (sbfi_scene_mesh){.name = name, .node = (int32_t)mesh};
    if (!make_points(d, mesh, to) || !make_polygons(d, mesh, to) || !make_normals(d, mesh, to) ||
        !make_uvs(d, mesh, to))
      return false;
  }
  sbfi_scene_set_worlds(nodes, d->mesh_count);
  scene->nodes = nodes;
  scene->meshes = meshes;
  scene->node_count = scene->mesh_count = d->mesh_count;
  return !left_out || sbfi_scene_warn(scene, SBF_CODE_IMPORT_POINTS_LEFT_OUT, 0,
                          "%u vertices that no face uses are left out: they belong to no object, or lie "
                          "apart from all others",
                          left_out);
}

sbf_status sbfi_obj_divide(
    sbfi_scene *scene, const sbfi_obj_text *text, const sbf_allocator *allocator, sbf_diagnostic *error) {
  division d = {.scene = scene,
      .text = text,
      .polygon_count = (uint32_t)text->polygons.count,
      .corner_count = (uint32_t)text->corners.count,
      .polygons = text->polygons.at,
      .corners = text->corners.at};
  sbfi_arena_init(&d.scratch, allocator, 0);
  bool good = divide(&d);
  sbfi_arena_free(&d.scratch);
  if (good) return SBF_OK;
  return sbfi_diagnose(
      error, SBF_CODE_OUT_OF_MEMORY, "memory ran out while the OBJ file was divided into objects");
}
