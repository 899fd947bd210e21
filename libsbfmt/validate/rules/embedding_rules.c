/* Checks embeddings: weights sum to one without large extrapolation, vertices match the mesh, every vertex
 * is embedded. */
#include <string.h>

#include "validate/rules/pose.h"
#include "validate/validation.h"

static const float SUM_TOLERANCE = 1e-4f, BLEND_TOLERANCE = 1e-3f;
/* Weights outside these bounds amplify small strains visibly. */
static const float MIN_WEIGHT = -0.5f, MAX_WEIGHT = 1.5f, WEIGHT_TOLERANCE = 1e-3f;
static const double OFF_TOLERANCE = 0.01; /* fraction of the mesh's size */

/* The mesh with embedded vertices: a render mesh, or a body's own surface. */
typedef struct embedded_mesh {
  sbfi_validation *v;
  sbf_vec3_list positions;
  const char *name;
  double size;
  uint8_t *unseen;  /* vertices without polygons, in a mesh that has polygons: invisible */
  float *fractions; /* sum of the bodies' blend weights for each vertex */
  uint32_t *stamps; /* number from 1 of the last embedding with the vertex */
  uint32_t stamp;
  bool broken; /* an embedding has an invalid length: the sums are unknown */
} embedded_mesh;

static void mark_seen(embedded_mesh *c, const sbf_u32_list *corners) {
  for (uint32_t i = 0; i < corners->count; i++)
    if (corners->at[i] < c->positions.count) c->unseen[corners->at[i]] = 0;
}

static bool embedded_mesh_init(
    embedded_mesh *c, sbfi_validation *v, const sbf_polygon_mesh *mesh, const char *name) {
  uint32_t count = mesh->positions.count;
  *c = (embedded_mesh){.v = v,
      .positions = mesh->positions,
      .name = name,
      .size = sbfi_extent(mesh->positions),
      .unseen = sbfi_scratch(v, count, sizeof *c->unseen),
      .fractions = sbfi_scratch(v, count, sizeof *c->fractions),
      .stamps = sbfi_scratch(v, count, sizeof *c->stamps)};
  if (!c->unseen || !c->fractions || !c->stamps) return false;
  memset(c->unseen, mesh->polygon_points.count > 0, count);
  mark_seen(c, &mesh->polygon_points);
  return true;
}

static double distance_off(const sbf_level *level, const sbf_embedding *e, uint32_t i, sbf_vec3 vertex) {
  const float weights[4] = {e->weights.at[i].x, e->weights.at[i].y, e->weights.at[i].z, e->weights.at[i].w};
  sbfi_d3 position = {0, 0, 0};
  for (int k = 0; k < 4; k++)
    position = sbfi_d3_add(
        position, sbfi_d3_scale(sbfi_d3_of(level->positions.at[e->points.at[i].at[k]]), (double)weights[k]));
  return sbfi_d3_length(sbfi_d3_sub(position, sbfi_d3_of(vertex)));
}

/* True if the weights are good enough to compute a position. */
static bool check_weights(const embedded_mesh *c, const sbf_embedding *e, uint32_t i, const char *path) {
  sbf_vec4 w = e->weights.at[i];
  float sum = w.x + w.y + w.z + w.w;
  float far = fmaxf(fmaxf(fabsf(w.x), fabsf(w.y)), fmaxf(fabsf(w.z), fabsf(w.w)));
  if (fabsf(sum - 1) > SUM_TOLERANCE * fmaxf(1, far)) {
    sbfi_found(c->v, SBF_CODE_EMBEDDING_SUM, path, i, "the weights of item %u sum to %.6g", i, (double)sum);
    return false;
  }
  float low = fminf(fminf(w.x, w.y), fminf(w.z, w.w)), high = fmaxf(fmaxf(w.x, w.y), fmaxf(w.z, w.w));
  if (low < MIN_WEIGHT - WEIGHT_TOLERANCE || high > MAX_WEIGHT + WEIGHT_TOLERANCE)
    sbfi_found(c->v, SBF_CODE_EMBEDDING_OUTSIDE, path, i,
        "item %u is far outside its element: it has a weight of %.3g", i,
        (double)(low < MIN_WEIGHT - WEIGHT_TOLERANCE ? low : high));
  return true;
}

static void check_embedding(
    embedded_mesh *c, const sbf_level *level, const sbf_embedding *e, const char *path) {
  sbfi_path weights = sbfi_path_of("%s/weights", path), vertices = sbfi_path_of("%s/vertices", path);
  uint32_t off = 0, first = 0;
  double max = 0;
  c->stamp++;
  if (e->vertices.count && e->vertices.count != e->points.count) {
    sbfi_found(c->v, SBF_CODE_EMBEDDING_LENGTH, path, -1, "%u vertices are listed, but %u are embedded",
        e->vertices.count, e->points.count);
    c->broken = true;
    return;
  }
  for (uint32_t i = 0; i < e->points.count; i++) {
    uint32_t vertex = e->vertices.count ? e->vertices.at[i] : i;
    bool good = check_weights(c, e, i, weights.text);
    if (vertex >= c->positions.count) {
      sbfi_found(c->v, SBF_CODE_EMBEDDING_VERTEX, e->vertices.count ? vertices.text : path,
          e->vertices.count ? (int64_t)i : -1, "vertex %u is not one of the %u of '%s'", vertex,
          c->positions.count, c->name);
      continue;
    }
    if (c->stamps[vertex] == c->stamp)
      sbfi_found(c->v, SBF_CODE_EMBEDDING_REPEATED, vertices.text, i, "vertex %u of '%s' is embedded twice",
          vertex, c->name);
    c->stamps[vertex] = c->stamp;
    c->fractions[vertex] += e->blends.count ? e->blends.at[i] : 1;
    double distance = good && !c->unseen[vertex] ? distance_off(level, e, i, c->positions.at[vertex]) : 0;
    if (!(distance > OFF_TOLERANCE * c->size)) continue;
    if (off++ == 0) first = i;
    max = fmax(max, distance);
  }
  if (off)
    sbfi_found(c->v, SBF_CODE_EMBEDDING_OFF, sbfi_path_of("%s/points", path).text, first,
        "%u %s of '%s' %s embedded away from %s rest position%s, by up to %.3g m", off,
        off == 1 ? "vertex" : "vertices", c->name, off == 1 ? "is" : "are", off == 1 ? "its" : "their",
        sbfi_plural(off), max);
}

/* Sums the blend weights of one mesh's vertices over all bodies, at each body's level `l` or its coarsest. */
static void check_mesh(sbfi_validation *v, uint32_t mesh, uint32_t l) {
  const sbf_asset *asset = v->asset;
  const sbf_render_mesh *at = &asset->render_meshes.at[mesh];
  uint32_t partly = 0, none = 0;
  bool found = false;
  embedded_mesh c;
  if (!embedded_mesh_init(&c, v, &at->mesh, sbfi_label(at->name, at->id))) return;
  for (uint32_t i = 0; i < at->levels.count; i++) mark_seen(&c, &at->levels.at[i].polygon_points);
  for (uint32_t b = 0; b < asset->soft_bodies.count; b++) {
    const sbf_soft_body *body = &asset->soft_bodies.at[b];
    if (body->levels.count == 0) continue;
    uint32_t index = l < body->levels.count ? l : body->levels.count - 1;
    const sbf_level *level = &body->levels.at[index];
    for (uint32_t e = 0; e < level->embeddings.count; e++) {
      if (level->embeddings.at[e].render_mesh != (int32_t)mesh) continue;
      found = true;
      check_embedding(&c, level, &level->embeddings.at[e],
          sbfi_path_of("/sbf/soft_body[%u]/level[%u]/embedding[%u]", b + 1, index + 1, e + 1).text);
    }
  }
  for (uint32_t i = 0; i < c.positions.count && found; i++) {
    none += c.fractions[i] == 0;
    partly += c.fractions[i] != 0 && fabsf(c.fractions[i] - 1) > BLEND_TOLERANCE;
  }
  sbfi_path path = sbfi_path_of("/sbf/render_mesh[%u]", mesh + 1);
  if (partly)
    sbfi_found(v, SBF_CODE_EMBEDDING_BLEND, path.text, -1, "the blends of %u %s of '%s' do not sum to 1",
        partly, partly == 1 ? "vertex" : "vertices", sbfi_label(at->name, at->id));
  if (none && !at->skin && !c.broken)
    sbfi_found(v, SBF_CODE_EMBEDDING_MISSING, path.text, -1, "%u %s of '%s' %s embedded in no body", none,
        none == 1 ? "vertex" : "vertices", sbfi_label(at->name, at->id), none == 1 ? "is" : "are");
}

/* Checks embeddings of a body's own surface, which only that body embeds. */
static void check_surface(sbfi_validation *v, uint32_t body, uint32_t l) {
  const sbf_soft_body *at = &v->asset->soft_bodies.at[body];
  const sbf_level *level = &at->levels.at[l];
  embedded_mesh c = {.fractions = NULL};
  for (uint32_t e = 0; e < level->embeddings.count; e++) {
    if (level->embeddings.at[e].render_mesh != SBF_NONE) continue;
    if (!c.fractions && !embedded_mesh_init(&c, v, &at->surface, sbfi_label(at->name, at->id))) return;
    check_embedding(&c, level, &level->embeddings.at[e],
        sbfi_path_of("/sbf/soft_body[%u]/level[%u]/embedding[%u]", body + 1, l + 1, e + 1).text);
  }
}

void sbfi_check_embeddings(sbfi_validation *v) {
  uint32_t levels = 0;
  for (uint32_t b = 0; b < v->asset->soft_bodies.count; b++) {
    const sbf_soft_body *body = &v->asset->soft_bodies.at[b];
    if (body->levels.count > levels) levels = body->levels.count;
    for (uint32_t l = 0; l < body->levels.count && !v->out_of_memory; l++) check_surface(v, b, l);
  }
  for (uint32_t m = 0; m < v->asset->render_meshes.count; m++)
    for (uint32_t l = 0; l < levels && !v->out_of_memory; l++) check_mesh(v, m, l);
}
