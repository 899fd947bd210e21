#include "sole.h"

#include <math.h>
#include <stdlib.h>

enum { MAX_LEGS = 16 };
static const float FIRM = 0.99f, MOSTLY = 0.5f; /* weights of a vertex on the foot */
static const double BAND = 0.12;                /* fraction of a foot's height: its sole */

typedef struct sole {
  uint32_t *vertices; /* indices in the skin; the first `firm_count` have weights of the foot only */
  double *rest_y;     /* rest height of each above the lowest */
  uint32_t count, firm_count;
  double rest_low; /* rest height of the lowest vertex above the ground */
  bool planted;
  double x, z; /* start of the stance */
} sole;

struct soles {
  sole at[MAX_LEGS];
  uint32_t count;
  sole_report report;
};

static bool is_below(const sbf_asset *asset, int32_t bone, int32_t ancestor) {
  for (; bone >= 0; bone = asset->bones.at[bone].parent)
    if (bone == ancestor) return true;
  return false;
}

static uint32_t skin_offset(const sbf_asset *asset, int32_t mesh) {
  uint32_t offset = 0;
  for (int32_t i = 0; i < mesh; i++) offset += asset->render_meshes.at[i].mesh.positions.count;
  return offset;
}

/* Vertices of the skin that follow mostly a bone or its descendants. */
static bool gather(const sbf_asset *asset, int32_t foot, sole *s) {
  for (uint32_t b = 0; b < asset->soft_bodies.count; b++) {
    const sbf_soft_body *body = &asset->soft_bodies.at[b];
    if (!is_below(asset, body->bone, foot) || body->levels.count == 0) continue;
    for (uint32_t e = 0; e < body->levels.at[0].embeddings.count; e++) {
      const sbf_embedding *embedding = &body->levels.at[0].embeddings.at[e];
      if (embedding->render_mesh < 0) continue;
      uint32_t offset = skin_offset(asset, embedding->render_mesh);
      uint32_t *grown = realloc(s->vertices, (s->count + embedding->points.count + 1) * sizeof *grown);
      if (!grown) return false;
      s->vertices = grown;
      for (uint32_t i = 0; i < embedding->points.count; i++) {
        bool mostly = embedding->blends.count == 0 || embedding->blends.at[i] > 0.5f;
        if (mostly)
          s->vertices[s->count++] = offset + (embedding->vertices.count ? embedding->vertices.at[i] : i);
      }
    }
  }
  s->firm_count = s->count;
  return true;
}

/* The same for skinned meshes, if the foot has no soft parts: those with a weight on it above `above` and
 * at most `up_to`. */
static bool gather_skinned(const sbf_asset *asset, int32_t foot, float above, float up_to, sole *s) {
  for (uint32_t m = 0; m < asset->render_meshes.count; m++) {
    const sbf_render_mesh *mesh = &asset->render_meshes.at[m];
    uint32_t offset = skin_offset(asset, (int32_t)m), count = mesh->mesh.positions.count;
    uint32_t *grown = realloc(s->vertices, (s->count + (size_t)count + 1) * sizeof *grown);
    if (!grown) return false;
    s->vertices = grown;
    for (uint32_t i = 0, at = 0; mesh->skin && i < count; at += mesh->skin->influence_counts.at[i++]) {
      float limited = 0;
      for (uint32_t k = at; k < at + mesh->skin->influence_counts.at[i]; k++)
        if (is_below(asset, (int32_t)mesh->skin->bones.at[k], foot)) limited += mesh->skin->weights.at[k];
      if (limited > above && limited <= up_to) s->vertices[s->count++] = offset + i;
    }
  }
  return true;
}

/* Vertices that also follow the leg come last. */
static bool gather_firm_first(const sbf_asset *asset, int32_t foot, sole *s) {
  if (!gather_skinned(asset, foot, FIRM, INFINITY, s)) return false;
  s->firm_count = s->count;
  return gather_skinned(asset, foot, MOSTLY, FIRM, s);
}

static sbf_vec3 rest_position(const sbf_asset *asset, uint32_t vertex) {
  uint32_t mesh = 0;
  while (vertex >= asset->render_meshes.at[mesh].mesh.positions.count)
    vertex -= asset->render_meshes.at[mesh++].mesh.positions.count;
  return asset->render_meshes.at[mesh].mesh.positions.at[vertex];
}

static double rest_height(const sbf_asset *asset, uint32_t vertex) {
  return (double)rest_position(asset, vertex).y;
}

/* Keeps the lowest vertices and records their heights. */
static bool select_lowest(const sbf_asset *asset, sole *s) {
  double low = INFINITY, high = -INFINITY;
  for (uint32_t i = 0; i < s->count; i++) {
    low = fmin(low, rest_height(asset, s->vertices[i]));
    high = fmax(high, rest_height(asset, s->vertices[i]));
  }
  uint32_t kept = 0, firm = 0;
  for (uint32_t i = 0; i < s->count; i++) {
    if (rest_height(asset, s->vertices[i]) > low + BAND * (high - low)) continue;
    firm += i < s->firm_count;
    s->vertices[kept++] = s->vertices[i];
  }
  s->count = kept;
  s->firm_count = firm;
  s->rest_low = low;
  s->rest_y = malloc((kept + 1) * sizeof *s->rest_y);
  if (!s->rest_y) return false;
  for (uint32_t i = 0; i < kept; i++) s->rest_y[i] = rest_height(asset, s->vertices[i]);
  return true;
}

soles *soles_create(const session *s) {
  const sbf_asset *asset = s->asset;
  if (asset->gaits.count == 0) return NULL;
  soles *all = calloc(1, sizeof *all);
  if (!all) return NULL;
  const sbf_gait *gait = &asset->gaits.at[0];
  for (uint32_t l = 0; l < gait->legs.count && l < MAX_LEGS; l++) {
    sole *one = &all->at[all->count++];
    int32_t foot = asset->ik_chains.at[gait->legs.at[l].ik].end;
    bool good = gather(asset, foot, one) && (one->count || gather_firm_first(asset, foot, one));
    if (good && select_lowest(asset, one)) continue;
    soles_destroy(all);
    return NULL;
  }
  return all;
}

void soles_destroy(soles *all) {
  for (uint32_t l = 0; all && l < all->count; l++) {
    free(all->at[l].vertices);
    free(all->at[l].rest_y);
  }
  free(all);
}

void soles_measure(soles *all, const session *s, const sbf_vec3 *skin) {
  sbr_leg_state legs[MAX_LEGS];
  sbr_double3 origin = sbr_character_get_origin(s->world, s->character);
  uint32_t leg_count = sbr_character_get_legs(s->world, s->character, legs, MAX_LEGS);
  for (uint32_t l = 0; l < all->count && l < leg_count; l++) {
    sole *one = &all->at[l];
    double x = 0, z = 0;
    for (uint32_t i = 0; i < one->firm_count; i++) {
      const sbf_vec3 p = skin[one->vertices[i]];
      double wx = origin.x + (double)p.x, wy = origin.y + (double)p.y, wz = origin.z + (double)p.z;
      sbf_vec3 normal;
      double depth = s->ground.height(&s->ground, wx, wz, &normal) - wy + fmin(one->rest_low, 0);
      all->report.penetration_m = fmax(all->report.penetration_m, depth);
      x += wx / one->firm_count;
      z += wz / one->firm_count;
    }
    if (legs[l].planted && !one->planted) {
      one->x = x;
      one->z = z;
    }
    one->planted = legs[l].planted;
    if (one->planted && one->firm_count)
      all->report.slip_m = fmax(all->report.slip_m, hypot(x - one->x, z - one->z));
  }
}

uint32_t soles_vertices(const soles *all, uint32_t leg, const uint32_t **vertices) {
  *vertices = leg < all->count ? all->at[leg].vertices : NULL;
  return leg < all->count ? all->at[leg].count : 0;
}

uint32_t soles_firm_vertices(const soles *all, uint32_t leg, const uint32_t **vertices) {
  *vertices = leg < all->count ? all->at[leg].vertices : NULL;
  return leg < all->count ? all->at[leg].firm_count : 0;
}

double soles_radius(const soles *all, const session *s, uint32_t leg) {
  const sole *one = leg < all->count ? &all->at[leg] : NULL;
  double x = 0, z = 0, radius = 0;
  for (uint32_t i = 0; one && i < one->count; i++) {
    sbf_vec3 p = rest_position(s->asset, one->vertices[i]);
    x += (double)p.x / one->count;
    z += (double)p.z / one->count;
  }
  for (uint32_t i = 0; one && i < one->count; i++) {
    sbf_vec3 p = rest_position(s->asset, one->vertices[i]);
    radius = fmax(radius, hypot((double)p.x - x, (double)p.z - z));
  }
  return radius;
}

sole_report soles_report(const soles *all) {
  return all->report;
}
