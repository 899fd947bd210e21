/* Blends the skin from one detail level to the next, so that its position, velocity and acceleration stay
 * continuous.
 *
 * The skin is sampled at three moments up to the change, relative to bones alone. They define a harmonic
 * oscillation of each vertex, at the frequency of its body's jiggle. This oscillation continues with the
 * bones while it fades out and the new level's skin fades in, so that the first motion of a new soft level is
 * hardly visible. For loose bodies, which have no level of bones, the difference of both skins fades out. */
#include <string.h>

#include "math/trig.h"
#include "math/vec3.h"
#include "skin/skin.h"
#include "state/pose/frames.h"
#include "world/detail/detail_levels.h"

/* Duration: a quarter of a second, or longer for large differences. It adds at most this fraction of the
 * character's size per second to a vertex's speed, except for oscillating vertices, whose oscillation ends
 * within this phase. */
static const float FADES_S = 0.25f, MAX_SIZES_1_S = 0.05f, SWINGS_RAD = 9.4f;
static const uint32_t MAX_TICKS = 240;

/* Ratio of the steepest to the mean slope of the blend. */
static const float STEEPEST = 1.875f;

/* Maximum amplitude of the oscillation, in multiples of the sampled displacement. */
static const float MAX_REACHES = 2;

/* Maximum phase per tick: three samples cannot resolve faster oscillation. */
static const float MAX_TURN_RAD = 1.5f;

/* Detail level of bones; NULL: none. */
static const sbr_model *bones_of(const sbri_character *c) {
  const sbr_model *base = c->model->detail.base, *last = base->detail.levels[base->detail.level_count - 1];
  return last->detail.kind == SBR_DETAIL_BONES ? last : NULL;
}

static uint32_t first_vertex(const sbri_character *c, uint32_t mesh) {
  return c->model->detail.base->detail.first_vertices[mesh];
}

static uint32_t vertex_count(const sbri_character *c, uint32_t mesh) {
  return first_vertex(c, mesh + 1) - first_vertex(c, mesh);
}

static sbf_vec3 of_point(const sbri_point *p) {
  return sbri_vec3(p->x, p->y, p->z);
}

static float phase_of(const sbr_world *world, const sbri_character *c, uint32_t body) {
  float turn = c->model->detail.base->detail.swing_rad_s[body] * (float)world->time.tick_s * c->time_scale;
  return turn < MAX_TURN_RAD ? turn : MAX_TURN_RAD;
}

/* Second difference over a tick, per metre of displacement, of an oscillation with that phase per tick. */
static float acceleration_per_displacement(float turn) {
  float sine, cosine;
  sbri_sincos(0.5f * turn, &sine, &cosine);
  return 4 * sine * sine;
}

/* ---- Samples of the skin ---- */

static void skin_of(sbri_character *c, const sbr_model *model, uint32_t mesh, bool now, sbri_point *to) {
  sbri_skin_compute_vertices(model, sbri_skin_of(model, mesh, 0),
      now ? sbri_positions(c) : sbri_previous_positions(c), now ? sbri_deltas(c) : sbri_previous_deltas(c),
      to);
}

/* Computes the blend of a skin and, if present, that of the bones. */
static void mix(const sbri_character *c, uint32_t mesh, const sbri_skin *skin, const sbri_point *bones,
    float fraction, sbri_point *to) {
  const sbri_character_state *head = sbri_header(c);
  const sbri_fading_vertex *all = sbri_faded(c) + first_vertex(c, mesh);
  float left = head->fade_before + (head->fade - head->fade_before) * fraction;
  for (uint32_t v = 0; v < skin->vertex_count; v++) {
    const sbri_fading_vertex *g = &all[skin->vertices ? skin->vertices[v] : v];
    sbf_vec3 off = sbri_add_scaled(g->was, sbri_sub(g->position, g->was), fraction);
    if (bones) off = sbri_add(off, sbri_sub(of_point(&bones[v]), of_point(&to[v])));
    to[v].x += left * off.x, to[v].y += left * off.y, to[v].z += left * off.z;
  }
}

void sbri_fade_apply(const sbri_character *c, uint32_t render_mesh, uint32_t render_level,
    const sbri_skin *skin, float fraction, sbri_point *vertices) {
  const sbr_model *bones = bones_of(c);
  if (!(sbri_header(c)->fade_before > 0)) return;
  if (bones)
    sbri_skin_compute_vertices(bones, sbri_skin_of(bones, render_mesh, render_level), sbri_sampled(c),
        sbri_sampled_deltas(c), sbri_fading(c));
  mix(c, render_mesh, skin, bones ? sbri_fading(c) : NULL, fraction, vertices);
}

/* The displayed vertices at the end or the beginning of this tick, relative to the bones. */
static void displayed(sbri_character *c, uint32_t mesh, bool now, sbri_point *to) {
  const sbr_model *bones = bones_of(c);
  sbri_point *from = sbri_fading(c);
  skin_of(c, c->model, mesh, now, to);
  if (bones) skin_of(c, bones, mesh, now, from);
  if (sbri_header(c)->fade_before > 0)
    mix(c, mesh, sbri_skin_of(c->model, mesh, 0), bones ? from : NULL, now ? 1.0f : 0.0f, to);
  for (uint32_t v = 0; bones && v < vertex_count(c, mesh); v++)
    to[v] = (sbri_point){to[v].x - from[v].x, to[v].y - from[v].y, to[v].z - from[v].z, 0};
}

static void make_deltas(sbri_character *c) {
  sbri_deltas_make(c, sbri_previous_pose(c), 0, sbri_previous_deltas(c));
  sbri_deltas_make(c, sbri_pose(c), 1, sbri_deltas(c));
}

void sbri_fade_record(sbri_character *c) {
  sbri_point *was = sbri_sums(c);
  make_deltas(c);
  for (uint32_t m = 0; m < c->model->asset->render_meshes.count; m++) {
    sbri_fading_vertex *to = sbri_faded(c) + first_vertex(c, m);
    displayed(c, m, false, was);
    for (uint32_t v = 0; v < vertex_count(c, m); v++) to[v].kept = of_point(&was[v]);
  }
  sbri_header(c)->fade_kept = 1;
}

/* ---- Oscillation ---- */

/* Fits the oscillation to three positions a tick apart, with a bounded amplitude. Returns the amplitude. */
static float attach(sbri_fading_vertex *g, float turn) {
  sbf_vec3 bend = sbri_sub(sbri_add(g->kept, g->position), sbri_scale(g->was, 2));
  g->still = sbri_add_scaled(g->was, bend, 1 / acceleration_per_displacement(turn));
  sbf_vec3 off = sbri_sub(g->position, g->still), went = sbri_sub(g->position, g->was);
  float reach = MAX_REACHES * fmaxf(sbri_length(g->position), sbri_length(g->was));
  float swings = sqrtf(sbri_dot(off, off) + sbri_dot(went, went) / (turn * turn));
  if (swings <= reach) return swings;
  float fraction = swings < 1e6f ? reach / swings : 0;
  g->still = sbri_sub(g->position, sbri_scale(off, fraction));
  g->was = sbri_sub(g->position, sbri_scale(went, fraction));
  return reach;
}

/* A spring's next tick. */
static void advance(sbri_fading_vertex *g, float pull) {
  sbf_vec3 to = sbri_add(g->position, sbri_sub(g->position, g->was));
  g->was = g->position;
  g->position = sbri_add_scaled(to, sbri_sub(g->position, g->still), -pull);
}

float sbri_fade_measure(const sbr_world *world, sbri_character *c) {
  bool swings = sbri_header(c)->fade_kept && bones_of(c);
  float max = 0;
  make_deltas(c);
  for (uint32_t m = 0; m < c->model->asset->render_meshes.count; m++) {
    sbri_fading_vertex *all = sbri_faded(c) + first_vertex(c, m);
    const uint32_t *with = c->model->detail.base->detail.swings_with + first_vertex(c, m);
    sbri_point *was = sbri_sums(c), *is = sbri_vertices(c);
    displayed(c, m, false, was);
    displayed(c, m, true, is);
    for (uint32_t v = 0; v < vertex_count(c, m); v++) {
      all[v].position = all[v].was = all[v].still = of_point(&is[v]);
      if (!swings) continue;
      all[v].was = of_point(&was[v]);
      max = fmaxf(max, attach(&all[v], phase_of(world, c, with[v])));
    }
  }
  return max;
}

void sbri_fade_tick(const sbr_world *world, sbri_character *c) {
  sbri_character_state *head = sbri_header(c);
  head->fade_before = head->fade;
  if (head->fade_ticks == 0) return;
  float left = (float)--head->fade_ticks / (float)head->fades_ticks;
  head->fade = left * left * left * (10 + left * (6 * left - 15));
  uint32_t bodies = c->model->asset->soft_bodies.count;
  uint32_t vertices = first_vertex(c, c->model->asset->render_meshes.count);
  float *pulls = sbri_pulls(c);
  for (uint32_t b = 0; b <= bodies; b++) pulls[b] = acceleration_per_displacement(phase_of(world, c, b));
  for (uint32_t v = 0; v < vertices; v++)
    advance(&sbri_faded(c)[v], pulls[c->model->detail.base->detail.swings_with[v]]);
}

/* ---- A change ---- */

void sbri_fade_end(sbri_character *c) {
  sbri_character_state *head = sbri_header(c);
  head->fade = head->fade_before = 0;
  head->fade_ticks = head->fades_ticks = head->fade_kept = 0;
}

/* Of bodies that nothing holds: what fades is the difference to the new skin. */
static void subtract(sbri_character *c, uint32_t mesh) {
  sbri_fading_vertex *all = sbri_faded(c) + first_vertex(c, mesh);
  sbri_point *is = sbri_fading(c);
  skin_of(c, c->model, mesh, true, is);
  for (uint32_t v = 0; v < vertex_count(c, mesh); v++)
    all[v].position = all[v].was = all[v].still = sbri_sub(all[v].position, of_point(&is[v]));
}

void sbri_fade_begin(const sbr_world *world, sbri_character *c) {
  sbri_character_state *head = sbri_header(c);
  const sbr_model *base = c->model->detail.base;
  uint32_t meshes = base->asset->render_meshes.count;
  float off = 0, swings = 0, slowest = INFINITY, tick_s = (float)world->time.tick_s;
  for (uint32_t m = 0; m < meshes && !bones_of(c); m++) subtract(c, m);
  for (uint32_t v = 0; v < first_vertex(c, meshes); v++) {
    const sbri_fading_vertex *g = &sbri_faded(c)[v];
    sbf_vec3 swing = sbri_sub(g->position, g->still);
    off = fmaxf(off, sbri_dot(g->still, g->still)), swings = fmaxf(swings, sbri_dot(swing, swing));
  }
  for (uint32_t b = 0; b <= base->asset->soft_bodies.count; b++)
    slowest = fminf(slowest, phase_of(world, c, b));
  sbri_fade_end(c);
  if (!(off < 1e12f && swings < 1e12f)) return;
  float max_m_s = MAX_SIZES_1_S * base->rest_size_m;
  float swings_s = fminf(STEEPEST * sqrtf(swings) / max_m_s, SWINGS_RAD / slowest * tick_s);
  float seconds = fmaxf(STEEPEST * sqrtf(off) / max_m_s, swings_s);
  if (!(seconds > FADES_S)) seconds = FADES_S;
  float ticks = ceilf(seconds / tick_s);
  head->fades_ticks = head->fade_ticks = ticks < (float)MAX_TICKS ? (uint32_t)ticks : MAX_TICKS;
  head->fade = head->fade_before = 1;
}
