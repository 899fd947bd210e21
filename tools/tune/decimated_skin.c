#include "tune/decimated_skin.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Rounds in search of a cell; its factor from one to the next. */
enum { MAX_ROUNDS = 24, NO_CLUSTER = -1 };
static const double GROWTH = 1.25;

typedef struct vec {
  double x, y, z;
} vec;

/* A vertex of the decimated mesh. */
typedef struct cluster {
  int32_t cell[3];
  int32_t bone; /* that of the greatest weight */
  vec sum;
  uint32_t count, first; /* vertices; the first of them */
} cluster;

/* Clusters of one mesh, found by their cells and bones in a hash table. */
typedef struct clusters {
  cluster *at;
  int32_t *of_vertex;
  int32_t *slots;
  size_t slot_count;
  uint32_t count;
} clusters;

static vec vec_of(sbf_vec3 p) {
  return (vec){p.x, p.y, p.z};
}

uint64_t tune_count_vertices(const sbf_asset *asset) {
  uint64_t count = 0;
  for (uint32_t m = 0; m < asset->render_meshes.count; m++)
    count += asset->render_meshes.at[m].mesh.positions.count;
  return count;
}

/* The larger of the bounds' sides. */
static double extent_of(const sbf_asset *asset) {
  double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY}, extent = 0;
  for (uint32_t m = 0; m < asset->render_meshes.count; m++) {
    const sbf_vec3_list *points = &asset->render_meshes.at[m].mesh.positions;
    for (uint32_t v = 0; v < points->count; v++) {
      const double at[3] = {points->at[v].x, points->at[v].y, points->at[v].z};
      for (int k = 0; k < 3; k++) low[k] = fmin(low[k], at[k]), high[k] = fmax(high[k], at[k]);
    }
  }
  for (int k = 0; k < 3; k++) extent = fmax(extent, high[k] - low[k]);
  return extent;
}

static double area_of(const sbf_asset *asset) {
  double sum = 0;
  for (uint32_t m = 0; m < asset->render_meshes.count; m++) {
    const sbf_polygon_mesh *mesh = &asset->render_meshes.at[m].mesh;
    const uint32_t *corners = mesh->polygon_points.at;
    for (uint32_t p = 0; p < mesh->polygon_sizes.count; corners += mesh->polygon_sizes.at[p++])
      for (uint32_t k = 2; k < mesh->polygon_sizes.at[p]; k++) {
        vec a = vec_of(mesh->positions.at[corners[0]]), b = vec_of(mesh->positions.at[corners[k - 1]]),
            c = vec_of(mesh->positions.at[corners[k]]);
        b = (vec){b.x - a.x, b.y - a.y, b.z - a.z}, c = (vec){c.x - a.x, c.y - a.y, c.z - a.z};
        vec n = {b.y * c.z - b.z * c.y, b.z * c.x - b.x * c.z, b.x * c.y - b.y * c.x};
        sum += sqrt(n.x * n.x + n.y * n.y + n.z * n.z) / 2;
      }
  }
  return sum;
}

/* --- Clusters ------------------------------------------------------------------------------------------ */

static void free_clusters(clusters *c) {
  free(c->at);
  free(c->of_vertex);
  free(c->slots);
}

static bool allocate_clusters(clusters *c, uint32_t vertices) {
  size_t slots = 16;
  while (slots < 2 * (size_t)vertices) slots *= 2;
  *c = (clusters){.at = malloc(((size_t)vertices + 1) * sizeof *c->at),
      .of_vertex = malloc(((size_t)vertices + 1) * sizeof *c->of_vertex),
      .slots = malloc(slots * sizeof *c->slots),
      .slot_count = slots};
  return c->at && c->of_vertex && c->slots;
}

static size_t slot_of(const clusters *c, const int32_t cell[3], int32_t bone) {
  uint64_t mixed =
      (uint32_t)cell[0] * UINT64_C(0x9e3779b97f4a7c15) ^ (uint32_t)cell[1] * UINT64_C(0xc2b2ae3d27d4eb4f) ^
      (uint32_t)cell[2] * UINT64_C(0x165667b19e3779f9) ^ (uint32_t)bone * UINT64_C(0xd6e8feb86659fd93);
  return (size_t)(mixed ^ mixed >> 29 ^ mixed >> 47) & (c->slot_count - 1);
}

static cluster *find_cluster(clusters *c, const int32_t cell[3], int32_t bone, uint32_t vertex) {
  size_t slot = slot_of(c, cell, bone);
  for (; c->slots[slot] != NO_CLUSTER; slot = (slot + 1) & (c->slot_count - 1)) {
    cluster *at = &c->at[c->slots[slot]];
    if (at->bone == bone && memcmp(at->cell, cell, sizeof at->cell) == 0) return at;
  }
  c->slots[slot] = (int32_t)c->count;
  cluster *made = &c->at[c->count++];
  *made = (cluster){{cell[0], cell[1], cell[2]}, bone, {0, 0, 0}, 0, vertex};
  return made;
}

/* Bone of the greatest weight among `count` influences. */
static int32_t main_bone(const sbf_skin *skin, uint32_t begin, uint32_t count) {
  uint32_t max = begin;
  for (uint32_t i = begin + 1; i < begin + count; i++)
    if (skin->weights.at[i] > skin->weights.at[max]) max = i;
  return count ? (int32_t)skin->bones.at[max] : SBF_NONE;
}

static void fill_clusters(clusters *c, const sbf_render_mesh *mesh, double cell_m) {
  uint32_t influence = 0;
  memset(c->slots, 0xff, c->slot_count * sizeof *c->slots);
  c->count = 0;
  for (uint32_t v = 0; v < mesh->mesh.positions.count; v++) {
    vec p = vec_of(mesh->mesh.positions.at[v]);
    const double at[3] = {p.x, p.y, p.z};
    int32_t cell[3], bone = SBF_NONE;
    for (int k = 0; k < 3; k++)
      cell[k] = (int32_t)fmax(fmin(floor(at[k] / cell_m), INT32_MAX / 2), INT32_MIN / 2);
    if (mesh->skin) {
      bone = main_bone(mesh->skin, influence, mesh->skin->influence_counts.at[v]);
      influence += mesh->skin->influence_counts.at[v];
    }
    cluster *to = find_cluster(c, cell, bone, v);
    to->sum = (vec){to->sum.x + p.x, to->sum.y + p.y, to->sum.z + p.z};
    to->count++;
    c->of_vertex[v] = (int32_t)(to - c->at);
  }
}

static uint64_t count_clusters(const sbf_asset *asset, clusters *all, double cell_m) {
  uint64_t count = 0;
  for (uint32_t m = 0; m < asset->render_meshes.count; m++) {
    fill_clusters(&all[m], &asset->render_meshes.at[m], cell_m);
    count += all[m].count;
  }
  return count;
}

/* Grows the cell from one that would give twice the vertices on a smooth surface. */
static void cluster_all(const sbf_asset *asset, clusters *all, uint32_t max_vertices) {
  double cell_m = sqrt(area_of(asset) / (2.0 * max_vertices)), extent = extent_of(asset);
  if (!(cell_m > extent * 1e-6)) cell_m = extent > 0 ? extent * 1e-6 : 1;
  for (int round = 0; round < MAX_ROUNDS; round++, cell_m *= GROWTH)
    if (count_clusters(asset, all, cell_m) <= max_vertices) return;
  count_clusters(asset, all, 2 * extent);
}

/* --- Decimated meshes ---------------------------------------------------------------------------------- */

static bool make_points(const clusters *c, sbf_asset *asset, sbf_polygon_mesh *mesh) {
  sbf_vec3 *positions = sbf_asset_allocate(asset, (size_t)c->count + 1, sizeof *positions);
  if (!positions) return false;
  for (uint32_t i = 0; i < c->count; i++) {
    const cluster *from = &c->at[i];
    positions[i] = (sbf_vec3){(float)(from->sum.x / from->count), (float)(from->sum.y / from->count),
        (float)(from->sum.z / from->count)};
  }
  mesh->positions = (sbf_vec3_list){positions, c->count};
  return true;
}

/* Triangles of the polygons' fans with three different corners. */
static bool make_triangles(
    const clusters *c, sbf_asset *asset, const sbf_polygon_mesh *from, sbf_polygon_mesh *mesh) {
  uint32_t kept = 0;
  for (int pass = 0; pass < 2; pass++) {
    const uint32_t *corners = from->polygon_points.at;
    uint32_t *sizes = pass ? sbf_asset_allocate(asset, (size_t)kept + 1, sizeof *sizes) : NULL;
    uint32_t *points = pass ? sbf_asset_allocate(asset, 3 * (size_t)kept + 1, sizeof *points) : NULL;
    if (pass && (!sizes || !points)) return false;
    if (pass) mesh->polygon_sizes = (sbf_u32_list){sizes, kept};
    if (pass) mesh->polygon_points = (sbf_u32_list){points, 3 * kept};
    kept = 0;
    for (uint32_t p = 0; p < from->polygon_sizes.count; corners += from->polygon_sizes.at[p++])
      for (uint32_t k = 2; k < from->polygon_sizes.at[p]; k++) {
        const uint32_t at[3] = {(uint32_t)c->of_vertex[corners[0]], (uint32_t)c->of_vertex[corners[k - 1]],
            (uint32_t)c->of_vertex[corners[k]]};
        if (at[0] == at[1] || at[1] == at[2] || at[2] == at[0]) continue;
        if (pass) memcpy(points + 3 * (size_t)kept, at, sizeof at), sizes[kept] = 3;
        kept++;
      }
  }
  return true;
}

/* Weights of each cluster's first vertex. */
static bool make_skin(const clusters *c, sbf_asset *asset, sbf_render_mesh *mesh, const sbf_skin *from) {
  size_t total = 0;
  uint32_t next = 0, influence = 0;
  for (uint32_t i = 0; i < c->count; i++) total += from->influence_counts.at[c->at[i].first];
  sbf_skin *skin = sbf_asset_allocate(asset, 1, sizeof *skin);
  uint32_t *counts = sbf_asset_allocate(asset, (size_t)c->count + 1, sizeof *counts);
  uint32_t *bones = sbf_asset_allocate(asset, total + 1, sizeof *bones);
  float *weights = sbf_asset_allocate(asset, total + 1, sizeof *weights);
  if (!skin || !counts || !bones || !weights) return false;
  /* Clusters are in the order of their first vertices. */
  for (uint32_t v = 0, i = 0; i < c->count; influence += from->influence_counts.at[v++]) {
    if (c->at[i].first != v) continue;
    counts[i] = from->influence_counts.at[v];
    if (counts[i]) {
      memcpy(bones + next, from->bones.at + influence, counts[i] * sizeof *bones);
      memcpy(weights + next, from->weights.at + influence, counts[i] * sizeof *weights);
    }
    next += counts[i++];
  }
  sbf_skin_init(skin);
  skin->influence_counts = (sbf_u32_list){counts, c->count};
  skin->bones = (sbf_u32_list){bones, next};
  skin->weights = (sbf_f32_list){weights, next};
  mesh->skin = skin;
  return true;
}

/* A cluster is pinned as the first of its pinned vertices. */
static bool make_pins(
    const clusters *c, sbf_asset *asset, sbf_render_mesh *mesh, const sbf_pin_set_list *from) {
  sbf_pin_set *sets = sbf_asset_allocate(asset, (size_t)from->count + 1, sizeof *sets);
  uint8_t *taken = malloc((size_t)c->count + 1);
  bool good = sets && taken;
  for (uint32_t s = 0; good && s < from->count; s++) {
    const sbf_pin_set *set = &from->at[s];
    uint32_t *points = sbf_asset_allocate(asset, (size_t)set->points.count + 1, sizeof *points), count = 0;
    float *weights = sbf_asset_allocate(asset, (size_t)set->points.count + 1, sizeof *weights);
    good = points && weights;
    memset(taken, 0, c->count);
    for (uint32_t i = 0; good && i < set->points.count; i++) {
      uint32_t to = (uint32_t)c->of_vertex[set->points.at[i]];
      if (taken[to]) continue;
      taken[to] = 1;
      points[count] = to;
      weights[count++] = set->weights.count == 0 ? 1 : set->weights.at[set->weights.count == 1 ? 0 : i];
    }
    sets[s] = *set;
    sets[s].offsets = (sbf_vec3_list){NULL, 0};
    sets[s].points = (sbf_u32_list){count ? points : NULL, count};
    sets[s].weights = (sbf_f32_list){count ? weights : NULL, count};
  }
  free(taken);
  if (good) mesh->pins = (sbf_pin_set_list){from->count ? sets : NULL, from->count};
  return good;
}

static bool make_mesh(const clusters *c, sbf_asset *asset, const sbf_render_mesh *from, sbf_render_mesh *to) {
  sbf_render_mesh_init(to);
  to->id = from->id;
  to->name = from->name;
  to->bone = from->bone;
  to->derived = from->derived;
  sbf_polygon_mesh_init(&to->mesh);
  to->mesh.target = from->mesh.target;
  return make_points(c, asset, &to->mesh) && make_triangles(c, asset, &from->mesh, &to->mesh) &&
         (!from->skin || make_skin(c, asset, to, from->skin)) && make_pins(c, asset, to, &from->pins);
}

sbf_asset *tune_decimate_skins(const sbf_asset *source, uint32_t max_vertices) {
  uint32_t count = source->render_meshes.count;
  sbf_asset *made = sbf_asset_create(NULL);
  clusters *all = calloc((size_t)count + 1, sizeof *all);
  sbf_render_mesh *meshes = made ? sbf_asset_allocate(made, (size_t)count + 1, sizeof *meshes) : NULL;
  bool good = all && meshes;
  for (uint32_t m = 0; good && m < count; m++)
    good = allocate_clusters(&all[m], source->render_meshes.at[m].mesh.positions.count);
  if (good) cluster_all(source, all, max_vertices);
  for (uint32_t m = 0; good && m < count; m++)
    good = make_mesh(&all[m], made, &source->render_meshes.at[m], &meshes[m]);
  if (good) {
    *made = *source;
    made->render_meshes = (sbf_render_mesh_list){count ? meshes : NULL, count};
  }
  for (uint32_t m = 0; all && m < count; m++) free_clusters(&all[m]);
  free(all);
  if (good) return made;
  sbf_asset_free(made);
  return NULL;
}
