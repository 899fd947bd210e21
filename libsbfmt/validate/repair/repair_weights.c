/* Normalizes weights of skins and embedded vertices, and limits pin weights to 1. */
#include "validate/repair/repair.h"
#include "validate/rules/pose.h"

static const float ROUNDING = 1e-3f; /* negative weights up to this size become 0 */

/* Normalizes the weights of one point; false if they are invalid. */
static bool normalise(float *weights, uint32_t count, bool *changed) {
  double sum = 0;
  bool outside = false;
  for (uint32_t i = 0; i < count; i++) {
    if (weights[i] < -ROUNDING) return false;
    sum += fmax((double)weights[i], 0);
    outside |= weights[i] < 0 || weights[i] > 1;
  }
  if (!(sum > 0)) return false;
  *changed = outside || fabs(sum - 1) > 1e-3;
  for (uint32_t i = 0; i < count && *changed; i++) weights[i] = (float)(fmax((double)weights[i], 0) / sum);
  return true;
}

static void repair_skin(sbfi_repair *m, const sbf_skin *skin, uint32_t mesh) {
  uint32_t repaired = 0, first = 0;
  float *weights = sbfi_writable(skin->weights.at);
  for (uint32_t i = 0, at = 0; i < skin->influence_counts.count; at += skin->influence_counts.at[i++]) {
    bool changed = false;
    if (!normalise(weights + at, skin->influence_counts.at[i], &changed) || !changed) continue;
    if (repaired++ == 0) first = at;
  }
  sbfi_path path = sbfi_path_of("/sbf/render_mesh[%u]/skin/weights", mesh + 1);
  sbfi_count_repair(m, SBF_CODE_SKIN_SUM, repaired, path.text, first,
      "weights of %u point%s divided by their sum", repaired, sbfi_plural(repaired));
}

/* Normalizes only if the normalized weights reproduce the vertex's position, because otherwise they mean
 * something else. */
static bool repair_vertex(
    sbf_vec4 *weights, const sbf_uint4 *points, const sbf_vec3 *positions, sbf_vec3 vertex, double near) {
  const double w[4] = {weights->x, weights->y, weights->z, weights->w};
  double sum = w[0] + w[1] + w[2] + w[3], far = 1;
  sbfi_d3 position = {0, 0, 0};
  for (int k = 0; k < 4; k++) {
    far = fmax(far, fabs(w[k]));
    position = sbfi_d3_add(position, sbfi_d3_scale(sbfi_d3_of(positions[points->at[k]]), w[k] / sum));
  }
  if (fabs(sum - 1) <= 1e-4 * far || !(sum > 0)) return false;
  if (!(sbfi_d3_length(sbfi_d3_sub(position, sbfi_d3_of(vertex))) <= near)) return false;
  *weights = (sbf_vec4){(float)(w[0] / sum), (float)(w[1] / sum), (float)(w[2] / sum), (float)(w[3] / sum)};
  return true;
}

static void repair_embedding(sbfi_repair *m, const sbf_soft_body *body, const sbf_level *level,
    const sbf_embedding *e, const char *path) {
  sbf_vec3_list vertices = e->render_mesh >= 0 ? m->asset->render_meshes.at[e->render_mesh].mesh.positions
                                               : body->surface.positions;
  double near = 0.01 * sbfi_extent(vertices);
  uint32_t repaired = 0, first = 0;
  if (e->vertices.count && e->vertices.count != e->points.count) return;
  for (uint32_t i = 0; i < e->points.count; i++) {
    uint32_t vertex = e->vertices.count ? e->vertices.at[i] : i;
    sbf_vec4 *weights = (sbf_vec4 *)sbfi_writable(e->weights.at) + i;
    if (vertex >= vertices.count ||
        !repair_vertex(weights, &e->points.at[i], level->positions.at, vertices.at[vertex], near))
      continue;
    if (repaired++ == 0) first = i;
  }
  sbfi_path there = sbfi_path_of("%s/weights", path);
  sbfi_count_repair(m, SBF_CODE_EMBEDDING_SUM, repaired, there.text, first,
      "weights divided by their sum: %u vert%s", repaired, repaired == 1 ? "ex" : "ices");
}

/* Pins from 1 on are rigid: larger values have no further effect. */
static void repair_pins(sbfi_repair *m, const sbf_pin_set_list *sets, const char *parent) {
  for (uint32_t s = 0; s < sets->count; s++) {
    uint32_t repaired = 0, first = 0;
    for (uint32_t i = 0; i < sets->at[s].weights.count; i++) {
      float *weight = (float *)sbfi_writable(sets->at[s].weights.at) + i;
      if (!(*weight > 1)) continue;
      *weight = 1;
      if (repaired++ == 0) first = i;
    }
    sbfi_path path = sbfi_path_of("%s/pins/pin_set[%u]/weights", parent, s + 1);
    sbfi_count_repair(m, SBF_CODE_VALUE_OUT_OF_RANGE, repaired, path.text, first,
        "weights of %u pin%s lowered to 1", repaired, sbfi_plural(repaired));
  }
}

void sbfi_repair_weights(sbfi_repair *m) {
  for (uint32_t i = 0; i < m->asset->render_meshes.count; i++)
    if (m->asset->render_meshes.at[i].skin) repair_skin(m, m->asset->render_meshes.at[i].skin, i);
  for (uint32_t b = 0; b < m->asset->soft_bodies.count; b++) {
    const sbf_soft_body *body = &m->asset->soft_bodies.at[b];
    sbfi_path path = sbfi_path_of("/sbf/soft_body[%u]", b + 1);
    repair_pins(m, &body->pins, path.text);
    for (uint32_t l = 0; l < body->levels.count; l++) {
      sbfi_path level = sbfi_path_of("%s/level[%u]", path.text, l + 1);
      repair_pins(m, &body->levels.at[l].pins, level.text);
      for (uint32_t e = 0; e < body->levels.at[l].embeddings.count; e++) {
        repair_embedding(m, body, &body->levels.at[l], &body->levels.at[l].embeddings.at[e],
            sbfi_path_of("%s/embedding[%u]", level.text, e + 1).text);
      }
    }
  }
}
