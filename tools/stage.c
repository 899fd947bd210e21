#include "stage.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sbrun/debug.h"
#include "sbrun/rigid.h"
#include "shown_skin.h"
#include "sole.h"

typedef struct body_style {
  sbf_uint2 *edges; /* unique edges of its tetrahedra */
  uint32_t edge_count;
} body_style;

enum { MAX_LEGS = 16, PRINTS = 64 };
/* radius of a drawn footprint relative to the sole, so that it is visible around it */
static const float AROUND = 1.3f;

/* Position where a foot touched down. */
typedef struct footprint {
  sbf_vec3 position, normal;
  float radius; /* m */
  uint32_t leg;
} footprint;

struct stage {
  footprint prints[PRINTS];
  uint32_t print_count;        /* total number; the last PRINTS are kept */
  uint32_t print_of[MAX_LEGS]; /* index of each leg's last footprint */
  bool was_planted[MAX_LEGS];
  float sole_radii[MAX_LEGS]; /* m, at rest */
  unsigned show;
  shown_skin *skin;
  body_style *bodies;
  uint32_t body_count;
  sbf_vec3 *positions; /* buffer for the points of the largest level */
  sbr_transform *bones;
  draw_colour *colours; /* buffer for the largest set of springs */
  draw_colour_map strains;
  uint32_t capacity;
};

static int compare_edges(const void *a, const void *b) {
  return memcmp(a, b, sizeof(sbf_uint2));
}

/* The level of a body that the session simulates, identified by its number of points. */
static const sbf_level *level_of(const session *s, uint32_t b) {
  const sbf_soft_body *body = &s->asset->soft_bodies.at[b];
  uint32_t count = sbr_character_get_points(s->world, s->character, b, NULL, 0);
  const sbf_level *best = NULL;
  for (uint32_t l = 0; l < body->levels.count; l++)
    if (body->levels.at[l].positions.count == count && (!best || l <= s->settings.model.level))
      best = &body->levels.at[l];
  return best;
}

static bool style_of_lattice(const session *s, uint32_t number, body_style *style) {
  static const int pairs[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
  const sbf_level *level = level_of(s, number);
  uint32_t count = level ? level->lattice.tetrahedra.count : 0, kept = 0;
  style->edges = malloc((6 * (size_t)count + 1) * sizeof *style->edges);
  if (!style->edges) return false;
  for (uint32_t t = 0; t < count; t++)
    for (int k = 0; k < 6; k++) {
      const uint32_t *p = level->lattice.tetrahedra.at[t].at;
      uint32_t a = p[pairs[k][0]], b = p[pairs[k][1]];
      style->edges[6 * t + (uint32_t)k] = (sbf_uint2){{a < b ? a : b, a < b ? b : a}};
    }
  qsort(style->edges, 6 * (size_t)count, sizeof *style->edges, compare_edges);
  for (uint32_t i = 0; i < 6 * count; i++)
    if (kept == 0 || memcmp(&style->edges[i], &style->edges[kept - 1], sizeof *style->edges) != 0)
      style->edges[kept++] = style->edges[i];
  style->edge_count = kept;
  return true;
}

static uint32_t largest_extent(const sbf_asset *asset) {
  uint32_t capacity = 1;
  for (uint32_t i = 0; i < asset->soft_bodies.count; i++)
    for (uint32_t l = 0; l < asset->soft_bodies.at[i].levels.count; l++) {
      const sbf_level *level = &asset->soft_bodies.at[i].levels.at[l];
      if (level->positions.count > capacity) capacity = level->positions.count;
      for (uint32_t s = 0; s < level->springs.count; s++)
        if (level->springs.at[s].ends.count > capacity) capacity = level->springs.at[s].ends.count;
    }
  return capacity;
}

static bool measure_soles(stage *st, const session *s) {
  if (s->asset->gaits.count == 0) return true;
  soles *all = soles_create(s);
  for (uint32_t l = 0; all && l < MAX_LEGS; l++) st->sole_radii[l] = (float)soles_radius(all, s, l);
  soles_destroy(all);
  return all != NULL;
}

stage *stage_create(const session *s, const skin_images *images, unsigned show, uint32_t render_level) {
  const sbf_asset *asset = s->asset;
  stage *st = calloc(1, sizeof *st);
  if (!st) return NULL;
  st->show = show;
  st->body_count = asset->soft_bodies.count;
  st->capacity = largest_extent(asset);
  st->skin = shown_skin_create(s, images, render_level);
  st->bodies = calloc(st->body_count + 1u, sizeof *st->bodies);
  st->positions = malloc(st->capacity * sizeof *st->positions);
  st->bones = malloc((asset->bones.count + 1u) * sizeof *st->bones);
  st->colours = malloc(st->capacity * sizeof *st->colours);
  bool good = st->skin && st->bodies && st->positions && st->bones && st->colours;
  for (uint32_t i = 0; good && i < st->body_count; i++) good = style_of_lattice(s, i, &st->bodies[i]);
  if (good && show & STAGE_FEET) good = measure_soles(st, s);
  draw_colour_map_init_diverging(&st->strains);
  if (good) return st;
  stage_destroy(st);
  return NULL;
}

void stage_destroy(stage *st) {
  if (!st) return;
  for (uint32_t i = 0; st->bodies && i < st->body_count; i++) free(st->bodies[i].edges);
  shown_skin_destroy(st->skin);
  free(st->bodies);
  free(st->positions);
  free(st->bones);
  free(st->colours);
  free(st);
}

static sbf_vec3 world_origin(const session *s) {
  sbr_double3 o = sbr_character_get_origin(s->world, s->character);
  return (sbf_vec3){(float)o.x, (float)o.y, (float)o.z};
}

static void to_world(sbf_vec3 origin, sbf_vec3 *points, uint32_t count) {
  for (uint32_t i = 0; i < count; i++) {
    points[i].x += origin.x;
    points[i].y += origin.y;
    points[i].z += origin.z;
  }
}

static float strain_of(const sbf_level *level, const sbf_spring_set *set, uint32_t i, const sbf_vec3 *now) {
  const uint32_t *p = set->ends.at[i].at;
  sbf_vec3 a = now[p[0]], b = now[p[1]], a0 = level->positions.at[p[0]], b0 = level->positions.at[p[1]];
  float length = sqrtf((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z));
  float rest = set->rest_lengths.count ? set->rest_lengths.at[i]
                                       : sqrtf((a0.x - b0.x) * (a0.x - b0.x) + (a0.y - b0.y) * (a0.y - b0.y) +
                                               (a0.z - b0.z) * (a0.z - b0.z));
  return rest > 0 ? length / rest - 1 : 0;
}

static const float FULL_STRAIN = 0.2f;

static void show_springs(stage *st, const session *s, sbf_vec3 origin, draw_scene *scene) {
  bool by_strain = (st->show & STAGE_STRAIN) != 0;
  unsigned seen = 0;
  for (uint32_t b = 0; b < st->body_count; b++) {
    const sbf_level *level = level_of(s, b);
    if (!level) continue;
    uint32_t count = sbr_character_get_points(s->world, s->character, b, st->positions, st->capacity);
    to_world(origin, st->positions, count);
    for (uint32_t k = 0; k < level->springs.count; k++) {
      const sbf_spring_set *set = &level->springs.at[k];
      const draw_spring_style *style = draw_spring_style_of((draw_spring_style_kind)set->kind);
      for (uint32_t i = 0; by_strain && i < set->ends.count; i++)
        st->colours[i] =
            draw_colour_map_at_strain(&st->strains, strain_of(level, set, i, st->positions), FULL_STRAIN);
      draw_scene_add_lines(scene, st->positions, count, set->ends.at, by_strain ? st->colours : NULL,
          set->ends.count, style->colour, style->width);
      seen |= 1u << set->kind;
    }
  }
  if (by_strain) draw_scene_add_scale(scene, &st->strains, "-20%", "0", "+20%");
  for (int k = DRAW_SPRING_STYLE_COUNT - 1; !by_strain && k >= 0; k--) {
    const draw_spring_style *style = draw_spring_style_of((draw_spring_style_kind)k);
    if (seen & 1u << k) draw_scene_add_legend(scene, style->name, style->colour);
  }
}

static void show_lattices(stage *st, const session *s, sbf_vec3 origin, draw_scene *scene) {
  for (uint32_t b = 0; b < st->body_count; b++) {
    if (st->bodies[b].edge_count == 0) continue;
    uint32_t count = sbr_character_get_points(s->world, s->character, b, st->positions, st->capacity);
    to_world(origin, st->positions, count);
    draw_scene_add_lines(scene, st->positions, count, st->bodies[b].edges, NULL, st->bodies[b].edge_count,
        draw_colour_of_tetrahedron(), 0.8f);
  }
}

static sbf_vec3 rotate(sbf_quat q, sbf_vec3 v) {
  sbf_vec3 t = {2 * (q.y * v.z - q.z * v.y), 2 * (q.z * v.x - q.x * v.z), 2 * (q.x * v.y - q.y * v.x)};
  return (sbf_vec3){v.x + q.w * t.x + q.y * t.z - q.z * t.y, v.y + q.w * t.y + q.z * t.x - q.x * t.z,
      v.z + q.w * t.z + q.x * t.y - q.y * t.x};
}

static sbf_quat multiply(sbf_quat a, sbf_quat b) {
  return (sbf_quat){a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w,
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

static void show_bones(stage *st, const session *s, draw_scene *scene) {
  for (uint32_t i = 0; i < s->asset->bones.count; i++) {
    float length = s->asset->bones.at[i].length;
    if (length <= 0) continue;
    sbf_vec3 head = st->bones[i].position, along = rotate(st->bones[i].rotation, (sbf_vec3){0, length, 0});
    draw_scene_add_bone(
        scene, head, (sbf_vec3){head.x + along.x, head.y + along.y, head.z + along.z}, draw_colour_of_bone());
  }
}

/* The bone below a leg's first, or the first itself if its foot is its child. */
static int32_t leg_knee(const sbf_asset *asset, uint32_t leg) {
  const sbf_ik_chain *chain = &asset->ik_chains.at[asset->gaits.at[0].legs.at[leg].ik];
  int32_t knee = asset->bones.at[chain->end].parent >= 0 ? asset->bones.at[chain->end].parent : chain->end;
  while (
      knee != chain->root && asset->bones.at[knee].parent >= 0 && asset->bones.at[knee].parent != chain->root)
    knee = asset->bones.at[knee].parent;
  return knee;
}

/* Footprints of planted feet are visible through objects in front of them. */
static void show_prints(const stage *st, const sbr_leg_state *legs, draw_scene *scene) {
  uint32_t first = st->print_count > PRINTS ? st->print_count - PRINTS : 0;
  for (uint32_t p = first; p < st->print_count; p++) {
    const footprint *print = &st->prints[p % PRINTS];
    bool stands = legs[print->leg].planted && st->print_of[print->leg] == p;
    (stands ? draw_scene_add_ring_mark : draw_scene_add_print)(
        scene, print->position, print->normal, print->radius, 3, draw_colour_of_contact());
  }
}

/* A line with a dot at its end. */
static void mark_line(draw_scene *scene, sbf_vec3 from, sbf_vec3 to, float dot, draw_colour colour) {
  draw_scene_add_mark(scene, &(draw_line){from, to, colour, colour, 3});
  draw_scene_add_mark(scene, &(draw_line){to, to, colour, colour, dot});
}

/* Footprints as rings; a line from every knee to its pole; for a foot in the air its target and the ray
 * down to the ground. */
static void show_feet(stage *st, const session *s, sbf_vec3 origin, draw_scene *scene) {
  sbr_leg_state legs[MAX_LEGS];
  uint32_t count = sbr_character_get_legs(s->world, s->character, legs, MAX_LEGS);
  float size = 0;
  count = count < MAX_LEGS ? count : MAX_LEGS;
  for (uint32_t i = 0; i < count; i++) {
    float length = s->asset->bones.at[leg_knee(s->asset, i)].length;
    size = length > size ? 0.25f * length : size;
    to_world(origin, &legs[i].foot, 1);
    to_world(origin, &legs[i].target, 1);
    to_world(origin, &legs[i].pole, 1);
  }
  for (uint32_t i = 0; i < count; i++) {
    float around = AROUND * st->sole_radii[i];
    footprint print = {.position = legs[i].foot, .radius = around > size ? around : size, .leg = i};
    s->ground.height(&s->ground, (double)print.position.x, (double)print.position.z, &print.normal);
    if (legs[i].planted && !st->was_planted[i]) {
      st->print_of[i] = st->print_count;
      st->prints[st->print_count++ % PRINTS] = print;
    }
    st->was_planted[i] = legs[i].planted;
  }
  show_prints(st, legs, scene);
  for (uint32_t i = 0; i < count; i++) /* bones are in world space */
    mark_line(scene, st->bones[leg_knee(s->asset, i)].position, legs[i].pole, 9, draw_colour_of_pole());
  for (uint32_t i = 0; i < count; i++) {
    if (legs[i].planted) continue;
    sbf_vec3 foot = legs[i].foot, below = foot, normal;
    below.y = (float)s->ground.height(&s->ground, (double)foot.x, (double)foot.z, &normal);
    mark_line(scene, foot, legs[i].target, 13, draw_colour_of_target());
    mark_line(scene, foot, below, 7, draw_colour_of_ray());
  }
  draw_scene_add_legend(scene, "knee to its pole", draw_colour_of_pole());
  draw_scene_add_legend(scene, "ray down", draw_colour_of_ray());
  draw_scene_add_legend(scene, "where the step goes", draw_colour_of_target());
  draw_scene_add_legend(scene, "where a foot came down", draw_colour_of_contact());
}

/* A hull's polygons as triangle fans, at its bone, or where it was simulated. */
static void show_hull(stage *st, const session *s, sbf_vec3 origin, uint32_t number, draw_scene *scene) {
  const sbf_rigid_body *body = &s->asset->rigid_bodies.at[number];
  const sbf_polygon_mesh *hull = body->hull;
  uint32_t *triangles = malloc((3 * (size_t)hull->polygon_points.count + 1) * sizeof *triangles), count = 0;
  for (uint32_t i = 0, at = 0; triangles && i < hull->polygon_sizes.count; at += hull->polygon_sizes.at[i++])
    for (uint32_t k = 2; k < hull->polygon_sizes.at[i]; k++) {
      triangles[3 * count] = hull->polygon_points.at[at];
      triangles[3 * count + 1] = hull->polygon_points.at[at + k - 1];
      triangles[3 * count++ + 2] = hull->polygon_points.at[at + k];
    }
  sbr_transform now = sbr_character_get_rigid_state(s->world, s->character, number).frame;
  sbf_vec3 from = body->center;
  to_world(origin, &now.position, 1);
  if (body->bone >= 0) {
    const sbf_bone *bone = &s->asset->bones.at[body->bone];
    sbf_quat rest = bone->rotation, back = {-rest.x, -rest.y, -rest.z, rest.w};
    now = st->bones[body->bone], from = bone->head;
    now.rotation = multiply(now.rotation, back);
  }
  from = rotate(now.rotation, from);
  draw_transform transform = {
      now.rotation, {now.position.x - from.x, now.position.y - from.y, now.position.z - from.z}};
  if (triangles)
    draw_scene_add_hull(scene, hull->positions.at, hull->positions.count, triangles, count, &transform,
        draw_colour_of_hull());
  free(triangles);
}

/* ---- What the runtime draws of itself ---- */

static sbf_vec3 single(sbr_double3 x) {
  return (sbf_vec3){(float)x.x, (float)x.y, (float)x.z};
}

/* On top of everything: contacts and joints are inside bodies. */
static void add_debug_line(void *user, sbr_double3 from, sbr_double3 to, uint32_t color) {
  draw_colour colour = draw_colour_rgb(color);
  draw_scene_add_mark(user, &(draw_line){single(from), single(to), colour, colour, 1.5f});
}

static void add_debug_point(void *user, sbr_double3 position, float size_pixels, uint32_t color) {
  draw_colour colour = draw_colour_rgb(color);
  draw_scene_add_mark(user, &(draw_line){single(position), single(position), colour, colour, size_pixels});
}

static void show_debug(const stage *st, const session *s, draw_scene *scene) {
  sbr_debug_draw draw = sbr_default_debug_draw();
  draw.line = add_debug_line, draw.point = add_debug_point, draw.user = scene, draw.parts = 0;
  if (st->show & STAGE_CONTACTS) draw.parts |= SBR_DRAW_CONTACTS;
  if (st->show & STAGE_JOINTS) draw.parts |= SBR_DRAW_JOINTS;
  if (st->show & STAGE_BOUNDS) draw.parts |= SBR_DRAW_BOUNDS;
  sbr_world_draw(s->world, &draw);
}

static float ground_height(void *user, float x, float z) {
  const sbr_ground *ground = user;
  sbf_vec3 normal;
  return (float)ground->height(ground, (double)x, (double)z, &normal);
}

static void show_ground(const session *s, sbf_vec3 origin, draw_scene *scene) {
  sbr_ground level = sbr_ground_flat(0);
  if (s->ground.height == level.height)
    draw_scene_set_floor(scene, (float)s->ground.parameters[0]);
  else
    draw_scene_set_terrain(scene, ground_height, (void *)(uintptr_t)&s->ground, origin.x, origin.z, 8);
}

void stage_show(stage *st, const session *s, draw_scene *scene) {
  sbf_vec3 origin = world_origin(s);
  draw_scene_clear(scene);
  sbr_character_get_bones(s->world, s->character, st->bones, s->asset->bones.count);
  for (uint32_t i = 0; i < s->asset->bones.count; i++) to_world(origin, &st->bones[i].position, 1);
  bool inside = (st->show & ~(unsigned)(STAGE_SURFACE | STAGE_FEET)) != 0;
  if (st->show & STAGE_SURFACE) shown_skin_add(st->skin, s, origin, inside ? DRAW_XRAY : 0, scene);
  if (st->show & (STAGE_SPRINGS | STAGE_STRAIN)) show_springs(st, s, origin, scene);
  if (st->show & STAGE_LATTICE) show_lattices(st, s, origin, scene);
  if (st->show & STAGE_BONES) show_bones(st, s, scene);
  for (uint32_t i = 0; st->show & STAGE_HULLS && i < s->asset->rigid_bodies.count; i++)
    if (s->asset->rigid_bodies.at[i].hull) show_hull(st, s, origin, i, scene);
  if (st->show & STAGE_FEET) show_feet(st, s, origin, scene);
  show_debug(st, s, scene);
  show_ground(s, origin, scene);
}
