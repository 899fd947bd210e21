/* Which places of two bodies may touch within a tick.
 *
 * Corners of soft surfaces against triangles of others and against hulls, corners of hulls against triangles,
 * hulls against hulls (find_hulls.c), rims against rims (find_rims.c). Where two parts of one character
 * overlap at rest they do not fight: what is inside at rest is let be, and what is near is kept no further
 * off. */
#include "collide/shape.h"
#include "collide/surface_look.h"
#include "meet/finding.h"
#include "model/reach.h"

/* What looks more along with a corner than this (a cosine) has it come through. */
static const float COME_THROUGH = 0.3f;
/* What lies so deep behind faces, of the depth to which they are looked for, is in the body. */
static const float IN_SHARE = 0.25f;

static sbri_party party_of(const sbri_finding *f, uint32_t number) {
  const sbri_meeter *is = &f->world->meetings->meeters[number];
  sbri_party p = {.is = is, .member = f->world->meetings->member_of[is->character]};
  p.of = &f->members[p.member];
  const sbr_model *model = p.of->character->model;
  if (is->rigid) {
    p.rigid = &model->rigid.bodies[is->number];
    p.surface = &f->world->meetings->hulls[is->character][is->number];
    p.friction = p.rigid->source->friction, p.restitution = p.rigid->source->restitution;
  } else {
    p.soft = &model->bodies[is->number];
    p.surface = &f->world->meetings->surfaces[is->character][is->number];
    p.friction = p.soft->friction, p.restitution = p.soft->restitution;
  }
  return p;
}

/* ---- Soft with soft ---- */

static sbri_surface_rule rule_of(const sbri_party *p) {
  const sbf_collision *rule = &p->soft->source->collision;
  return (sbri_surface_rule){
      rule->outer_thickness * p->of->scale, rule->inner_thickness * p->of->scale, p->surface->two_sided};
}

static sbri_surface_face face_of(const sbri_party *p, uint32_t triangle) {
  sbri_surface_face face;
  for (int k = 0; k < 3; k++) {
    uint32_t v = p->surface->triangles[3 * (size_t)triangle + (uint32_t)k];
    face.at[k] = p->surface->places[v], face.ways[k] = p->surface->ways[v];
  }
  return face;
}

/* The most urgent triangle of `b` for a place of `a` that goes so; whether there is one. What lies at a
 * margin is looked for beyond it: it would else be let go each other tick, and fall. */
static bool find_face(
    const sbri_party *a, const sbri_party *b, sbf_vec3 x, sbf_vec3 way, sbri_surface_finding *best) {
  sbri_surface_rule rule = rule_of(b);
  float margin = sbri_party_margin(a, b), beyond = sbri_party_beyond(margin, b);
  sbri_box box = sbri_box_with(sbri_box_of_point(x), sbri_add(x, way));
  if (a->soft && margin > 0 && beyond > rule.outer) rule.outer = beyond, box = sbri_box_grown(box, beyond);
  sbri_bounds_walk walk;
  uint32_t triangle;
  *best = sbri_surface_nothing();
  sbri_bounds_walk_begin(&walk, &b->surface->tree, box);
  while (sbri_bounds_walk_next(&walk, &triangle)) {
    if (!sbri_box_meets(&box, &b->surface->boxes[triangle])) continue;
    sbri_surface_face face = face_of(b, triangle);
    sbri_surface_look(&rule, x, way, &face, triangle, best);
  }
  return sbri_surface_found(best);
}

/* Whether what lies deep in the other, or through it, is let out: not where two parts of one character do so
 * at rest. */
static bool may_let_out(const sbri_finding *f, const sbri_party *soft, const sbri_party *other) {
  if (!sbri_are_of_one(soft, other)) return true;
  const sbr_model *model = soft->of->character->model;
  size_t softs = model->asset->soft_bodies.count, i = soft->is->number, k = other->is->number;
  const uint8_t *together = f->world->meetings->together[soft->is->character];
  return together[other->rigid ? softs * softs + i * model->rigid.body_count + k : i * softs + k] ==
         SBRI_APART_AT_REST;
}

static void meet_faces(const sbri_finding *f, const sbri_party *a, const sbri_party *b, bool lets_out) {
  sbri_surface_rule rule = rule_of(b);
  const float whole = 1;
  for (uint32_t v = 0; v < a->surface->vertex_count; v++) {
    sbri_surface_finding best;
    if (!(a->surface->samples[v].mass_kg > 0)) continue;
    sbf_vec3 x = a->surface->places[v];
    bool deep = !find_face(a, b, x, a->surface->ways[v], &best);
    if (deep && (!lets_out || !sbri_meet_way_out(b, x, &best))) continue;
    const uint32_t *corners = b->surface->triangles + 3 * (size_t)best.face;
    float margin = sbri_party_margin(a, b);
    if (sbri_are_of_one(a, b) && !deep) {
      const sbf_vec3 p[3] = {
          sbri_party_rest(b, corners[0]), sbri_party_rest(b, corners[1]), sbri_party_rest(b, corners[2])};
      float rest = sbri_surface_gap(&rule, sbri_party_rest(a, v), p);
      if (rest <= SBRI_TOGETHER_SHARE * a->soft->rest_size_m * a->of->scale) continue;
      margin = SBRI_REST_SHARE * rest < margin ? SBRI_REST_SHARE * rest : margin;
    }
    sbri_meet_touch t = {.feature = v,
        .a = sbri_soft_side(a, &v, &whole, 1),
        .b = sbri_soft_side(b, corners, best.weights, 3),
        .normal = best.normal,
        .margin = margin,
        .is_in = deep || (best.behind && best.urgency - 1 > IN_SHARE * rule.inner),
        .goes_out = deep};
    sbri_finding_add(f, a, b, &t);
  }
}

/* ---- Itself ---- */

static bool share_points(const sbri_sample *a, const sbri_sample *b) {
  for (int i = 0; i < 4; i++)
    for (int k = 0; k < 4; k++)
      if (a->weights[i] != 0 && b->weights[k] != 0 && a->slots[i] == b->slots[k]) return true;
  return false;
}

/* Parts that hang together do not meet: what the same points carry, and what lies in each other, or nearer
 * than this share of the body, at rest. */
static bool may_meet_face(const sbri_party *p, const sbri_surface_rule *rule, uint32_t v, uint32_t triangle) {
  const uint32_t *corners = p->surface->triangles + 3 * (size_t)triangle;
  sbf_vec3 rest[3];
  for (int k = 0; k < 3; k++) {
    if (corners[k] == v || share_points(&p->surface->samples[v], &p->surface->samples[corners[k]]))
      return false;
    rest[k] = sbri_party_rest(p, corners[k]);
  }
  return sbri_surface_gap(rule, sbri_party_rest(p, v), rest) >
         SBRI_TOGETHER_SHARE * p->soft->rest_size_m * p->of->scale;
}

static bool find_own_face(const sbri_party *p, uint32_t v, sbri_surface_finding *best) {
  sbri_surface_rule rule = rule_of(p);
  sbf_vec3 x = p->surface->places[v], way = p->surface->ways[v];
  sbri_box box = sbri_box_with(sbri_box_of_point(x), sbri_add(x, way));
  sbri_bounds_walk walk;
  uint32_t triangle;
  *best = sbri_surface_nothing();
  sbri_bounds_walk_begin(&walk, &p->surface->tree, box);
  while (sbri_bounds_walk_next(&walk, &triangle)) {
    if (!sbri_box_meets(&box, &p->surface->boxes[triangle]) || !may_meet_face(p, &rule, v, triangle))
      continue;
    sbri_surface_face face = face_of(p, triangle);
    sbri_surface_look(&rule, x, way, &face, triangle, best);
  }
  return sbri_surface_found(best);
}

/* A surface that other points carry; one of a level's own points meets itself by itself. */
static void meet_itself(const sbri_finding *f, const sbri_party *p) {
  const float whole = 1;
  for (uint32_t v = 0; v < p->surface->vertex_count; v++) {
    sbri_surface_finding best;
    if (!(p->surface->samples[v].mass_kg > 0) || !find_own_face(p, v, &best)) continue;
    sbri_meet_touch t = {.feature = v,
        .a = sbri_soft_side(p, &v, &whole, 1),
        .b = sbri_soft_side(p, p->surface->triangles + 3 * (size_t)best.face, best.weights, 3),
        .normal = best.normal,
        .margin = sbri_party_margin(p, p)};
    sbri_finding_add(f, p, p, &t);
  }
}

/* ---- Rigid ---- */

static sbf_vec3 out_of(const sbr_transform *frame, sbf_vec3 own, float scale) {
  return sbri_add_scaled(frame->position, sbri_rotate(frame->rotation, own), scale);
}

static void meet_hull(const sbri_finding *f, const sbri_party *soft, const sbri_party *rigid) {
  sbr_transform from = sbri_party_frame(rigid, false), to = sbri_party_frame(rigid, true);
  const sbri_hull *hull = &rigid->rigid->hull;
  float scale = rigid->of->scale, margin = soft->soft->margin_m * soft->of->scale;
  const float whole = 1;
  for (uint32_t v = 0; v < soft->surface->vertex_count; v++) {
    if (!(soft->surface->samples[v].mass_kg > 0)) continue;
    sbf_vec3 x = soft->surface->places[v];
    sbf_vec3 begin = sbri_into_frame(&from, x, scale),
             end = sbri_into_frame(&to, sbri_add(x, soft->surface->ways[v]), scale);
    sbf_vec3 way = sbri_sub(end, begin), place, normal, entered;
    float share, own = sbri_length(way) * scale;
    float reach = sbri_reach_of(soft->soft, soft->of->scale, own, soft->surface->fastest_m) / scale;
    uint32_t face;
    if (sbri_hull_depth(hull, begin, &face) > reach) continue;
    float gap = sbri_hull_nearest(hull, begin, &place, &normal);
    if (gap > 0 && sbri_hull_enter(hull, begin, way, &share, &entered))
      place = sbri_add_scaled(begin, way, share), normal = entered;
    else if (gap > reach)
      continue;
    if (sbri_are_of_one(soft, rigid)) {
      sbr_transform rest = {sbri_scale(rigid->rigid->center, scale), rigid->rigid->axes};
      float together = SBRI_TOGETHER_SHARE * soft->soft->rest_size_m;
      if (sbri_hull_depth(hull, sbri_into_frame(&rest, sbri_party_rest(soft, v), scale), &face) <= together)
        continue;
    }
    sbri_meet_touch t = {.feature = v,
        .a = sbri_soft_side(soft, &v, &whole, 1),
        .b = sbri_rigid_side(rigid, place),
        .normal = sbri_rotate(from.rotation, normal),
        .margin = margin,
        .is_in = -gap * scale > IN_SHARE * rule_of(soft).inner};
    sbri_finding_add(f, soft, rigid, &t);
  }
}

/* A sheet lies before a corner, not behind it: one without thickness that the corner has come through goes
 * back over it, or they would push against what holds the sheet's own points off the hull. */
static void turn_back(const sbri_party *rigid, const sbri_party *soft, sbf_vec3 corner,
    const sbr_transform *at, sbri_surface_finding *best) {
  sbf_vec3 out = sbri_rotate(at->rotation, sbri_sub(corner, rigid->rigid->hull.middle));
  sbri_surface_rule rule = rule_of(soft);
  bool near = best->urgency >= 1 && best->urgency - 1 <= rule.inner && rule.outer == 0;
  if (near && sbri_dot(best->normal, out) > COME_THROUGH * sbri_length(out))
    best->normal = sbri_scale(best->normal, -1);
}

/* Corners of the hull against the soft surface's triangles. */
static void meet_corners(
    const sbri_finding *f, const sbri_party *rigid, const sbri_party *soft, bool lets_out) {
  sbr_transform from = sbri_party_frame(rigid, false), to = sbri_party_frame(rigid, true);
  for (uint32_t i = 0; i < rigid->rigid->vertex_count; i++) {
    sbf_vec3 own = rigid->rigid->vertices[i], x = out_of(&from, own, rigid->of->scale);
    sbri_surface_finding best;
    bool deep = !find_face(rigid, soft, x, sbri_sub(out_of(&to, own, rigid->of->scale), x), &best);
    if (deep && (!lets_out || !sbri_meet_way_out(soft, x, &best))) continue;
    const uint32_t *corners = soft->surface->triangles + 3 * (size_t)best.face;
    if (soft->surface->two_sided) turn_back(rigid, soft, own, &from, &best);
    if (sbri_are_of_one(soft, rigid) && !deep) {
      sbr_transform rest = {sbri_scale(rigid->rigid->center, rigid->of->scale), rigid->rigid->axes};
      const sbf_vec3 p[3] = {sbri_party_rest(soft, corners[0]), sbri_party_rest(soft, corners[1]),
          sbri_party_rest(soft, corners[2])};
      sbri_surface_rule rule = rule_of(soft);
      float together = SBRI_TOGETHER_SHARE * soft->soft->rest_size_m * soft->of->scale;
      if (sbri_surface_gap(&rule, out_of(&rest, own, rigid->of->scale), p) <= together) continue;
    }
    sbri_meet_touch t = {.feature = i,
        .a = sbri_rigid_side(rigid, own),
        .b = sbri_soft_side(soft, corners, best.weights, 3),
        .normal = best.normal,
        .margin = sbri_party_margin(rigid, soft),
        .is_in = deep || (best.behind && best.urgency - 1 > IN_SHARE * rule_of(soft).inner),
        .goes_out = deep};
    sbri_finding_add(f, rigid, soft, &t);
  }
}

/* What bears others is borne by the ground itself: with its planes among the touches the push of each is
 * found with that of all. Soft bodies have their ground in every step of their own. */
static void add_planes(const sbri_finding *f, uint32_t member) {
  const sbri_meet_member *m = &f->members[member];
  const sbri_rigid_solving *work = &m->parts.work;
  for (uint32_t i = 0; m->parts.steps && i < work->touch_count; i++) {
    const sbri_ground_touch *from = &work->touches[i];
    bool gives = from->guest && sbri_rigid_guest_gives(&work->guests[from->guest - 1], from->normal);
    if (gives && from->guest > sbri_meet_guests_of(m)) continue;
    if (f->group->touch_count >= f->group->touch_capacity) return;
    sbri_meet_touch *t = &f->world->meetings->touches[f->group->first_touch + f->group->touch_count++];
    sbf_vec3 on = sbri_scale(from->normal, from->offset);
    *t = (sbri_meet_touch){.a = {.member = member, .rigid_body = (int32_t)from->body, .at = from->at},
        .b = {.member = member,
            .rigid_body = SBRI_MEET_PLANE,
            .at = gives ? from->guest_arm : sbri_add_scaled(m->offset, on, m->scale),
            .goes = sbri_scale(from->velocity, m->speed),
            .guest = gives ? from->guest : 0},
        .names = {sbri_meet_name(&(sbri_meeter){.character = (uint32_t)(m->character - f->world->characters),
                      .number = from->body,
                      .rigid = true}),
            SBRI_MEET_NAME_OF_GROUND - (from->collider + 1)},
        .normal = from->normal,
        .friction = from->guest && !gives ? 0 : from->friction}; /* it gives way across, in the body's step */
  }
}

/* ---- All ---- */

void sbri_meet_touches_find(sbr_world *world, sbri_meet_group *group) {
  sbri_meetings *all = world->meetings;
  sbri_finding f = {world, group, all->members + group->first_member};
  group->touch_count = 0;
  for (uint32_t m = 0; m < group->member_count; m++) {
    const sbr_model *model = f.members[m].character->model;
    for (uint32_t b = 0; b < model->asset->soft_bodies.count; b++)
      if (model->bodies[b].level) sbri_meet_surface_place(world, &f.members[m], b);
  }
  for (uint32_t i = 0; i < group->pair_count; i++) {
    sbri_meet_pair pair = all->pairs[group->first_pair + i];
    sbri_party a = party_of(&f, pair.a), b = party_of(&f, pair.b);
    if (pair.a == pair.b) {
      meet_itself(&f, &a);
    } else if (a.rigid && b.rigid) {
      sbri_meet_hulls(&f, &a, &b);
    } else if (a.rigid || b.rigid) {
      const sbri_party *rigid = a.rigid ? &a : &b, *soft = a.rigid ? &b : &a;
      uint32_t first = group->touch_count;
      bool let_out = may_let_out(&f, soft, rigid);
      meet_hull(&f, soft, rigid);
      meet_corners(&f, rigid, soft, let_out);
      if (let_out && soft->surface->closed) {
        sbri_meet_through(&f, soft, rigid, first);
        sbri_meet_ridges(&f, soft, rigid, first);
      }
    } else {
      uint32_t first = group->touch_count;
      bool let_out = may_let_out(&f, &a, &b);
      meet_faces(&f, &a, &b, let_out);
      meet_faces(&f, &b, &a, let_out);
      if (let_out && a.surface->closed && b.surface->closed) {
        sbri_meet_through(&f, &a, &b, first);
        sbri_meet_ridges(&f, &a, &b, first);
      }
      if (a.surface->two_sided && b.surface->two_sided) sbri_meet_rims(&f, &a, &b);
    }
  }
  for (uint32_t m = 0; m < group->member_count; m++) add_planes(&f, m);
}
