/* From what one rung shows to what the next does, over a while; at the moment of the change the skin is
 * exactly where it was. By how much each vertex was elsewhere than the bones alone would have it goes along
 * with the bones and fades, while the new rung's skin comes up: what a soft rung does at first, before it has
 * found where it rests, hardly shows. Of bodies that nothing holds, which have no rung of bones, the
 * difference of both skins fades from the new one. */
#include <string.h>

#include "detail/rungs.h"
#include "math/vec3.h"
#include "skin/skin.h"

/* A quarter of a second, or longer where much is to fade: no vertex goes faster for it than so much of the
 * character's size a second. */
static const float FADES_S = 0.25f, MOST_SIZES_1_S = 0.05f;
static const uint32_t MOST_TICKS = 240;

/* The bones' rung; NULL: there is none. */
static const sbr_model *bones_of(const sbri_character *c) {
  const sbr_model *base = c->model->base, *last = base->rungs[base->rung_count - 1];
  return last->kind == SBR_RUNG_BONES ? last : NULL;
}

/* Adds `model`'s skins as they are now, times `share`. */
static void add_skins(sbri_character *c, const sbr_model *model, float share) {
  for (uint32_t m = 0; model && m < model->asset->render_meshes.count; m++) {
    const sbri_skin *skin = sbri_skin_of(model, m, 0);
    sbf_vec3 *to = sbri_faded(c) + model->base->first_vertices[m];
    sbri_point *vertices = sbri_fading(c);
    sbri_skin_vertices(model, skin, sbri_positions(c), sbri_deltas(c), vertices);
    for (uint32_t v = 0; v < skin->vertex_count; v++)
      to[v] = sbri_add_scaled(to[v], sbri_vec3(vertices[v].x, vertices[v].y, vertices[v].z), share);
  }
}

static uint32_t vertex_count(const sbri_character *c) {
  return c->model->base->first_vertices[c->model->asset->render_meshes.count];
}

void sbri_fade_end(sbri_character *c) {
  sbri_character_state *head = sbri_head(c);
  head->fade = head->fade_before = 0;
  head->fade_ticks = head->fades_ticks = 0;
}

void sbri_fade_keep(sbri_character *c) {
  const sbri_character_state *head = sbri_head(c);
  float left = head->fade;
  sbf_vec3 *faded = sbri_faded(c);
  for (uint32_t v = 0; v < vertex_count(c); v++)
    faded[v] = left > 0 ? sbri_scale(faded[v], left) : sbri_vec3(0, 0, 0);
  add_skins(c, c->model, bones_of(c) ? 1 - left : 1);
  if (bones_of(c) && left > 0) add_skins(c, bones_of(c), left);
}

void sbri_fade_begin(const sbr_world *world, sbri_character *c) {
  sbri_character_state *head = sbri_head(c);
  float most = 0;
  add_skins(c, bones_of(c) ? bones_of(c) : c->model, -1);
  for (uint32_t v = 0; v < vertex_count(c); v++)
    most = fmaxf(most, sbri_dot(sbri_faded(c)[v], sbri_faded(c)[v]));
  sbri_fade_end(c);
  if (!(most < 1e12f)) return;
  /* Where it is steepest the share falls half as fast again as on average. */
  float seconds = 1.5f * sqrtf(most) / (MOST_SIZES_1_S * c->model->base->rest_size_m);
  if (!(seconds > FADES_S)) seconds = FADES_S;
  float ticks = ceilf(seconds / (float)world->tick_s);
  head->fades_ticks = head->fade_ticks = ticks < (float)MOST_TICKS ? (uint32_t)ticks : MOST_TICKS;
  head->fade = head->fade_before = 1;
}

void sbri_fade_tick(sbri_character *c) {
  sbri_character_state *head = sbri_head(c);
  head->fade_before = head->fade;
  if (head->fade_ticks == 0) return;
  float left = (float)--head->fade_ticks / (float)head->fades_ticks;
  head->fade = left * left * (3 - 2 * left);
}

void sbri_fade_apply(const sbri_character *c, uint32_t render_mesh, uint32_t render_level,
    const sbri_skin *skin, float share, sbri_point *vertices) {
  const sbri_character_state *head = sbri_head(c);
  const sbr_model *bones = bones_of(c);
  if (!(head->fade_before > 0)) return;
  float left = head->fade_before + (head->fade - head->fade_before) * share;
  const sbf_vec3 *faded = sbri_faded(c) + c->model->base->first_vertices[render_mesh];
  sbri_point *from = sbri_fading(c);
  if (bones)
    sbri_skin_vertices(
        bones, sbri_skin_of(bones, render_mesh, render_level), sbri_sampled(c), sbri_sampled_deltas(c), from);
  for (uint32_t v = 0; v < skin->vertex_count; v++) {
    sbri_point *p = &vertices[v];
    const sbf_vec3 *d = &faded[skin->vertices ? skin->vertices[v] : v];
    float x = d->x, y = d->y, z = d->z;
    if (bones) x += from[v].x - p->x, y += from[v].y - p->y, z += from[v].z - p->z;
    p->x += left * x, p->y += left * y, p->z += left * z;
  }
}
