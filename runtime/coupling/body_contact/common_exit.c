/* Common exits of bodies that lie crosswise through each other.
 *
 * The nearest face is the exit of shallow penetration. For two crossed bars it is not: points on the two
 * sides of a bar's middle leave to opposite sides, and the bars stay. Here the parts of both bodies that
 * overlap (a cluster) leave in one direction: the one with the shortest exit of them all, found by rays. It
 * is cached, so that it does not change from tick to tick. */
#include "coupling/body_contact/overlap_clusters.h"

enum { DIRECTION_COUNT = 26, MAX_SAMPLES = 40, POWER_ITERATIONS = 8 };
/* Nearest exits oppose the common one below this cosine; and each other if their components along an axis
 * exceed this value with both signs. */
static const float OPPOSED_COSINE = -0.3f, OPPOSED_COMPONENT = 0.5f;
/* A new direction replaces the current one if its exit is shorter by this factor. */
static const float SWITCH_FACTOR = 0.6f;
/* No common exit if it is longer than the nearest exit of the deepest point by this factor: a body that is
 * wrapped by another, as by an arm, leaves the way it came. */
static const float MAX_LENGTH_FACTOR = 3;
/* The same for limbs, as a fraction of the sum of their thicknesses: the middles of their edges are never
 * deep. */
static const float LIMB_EXIT_FRACTION = 0.75f;
/* An edge deeper than this fraction of the other body's thickness passes through it. */
static const float EDGE_DEEP_FRACTION = 0.25f;
/* Edge depth of ordinary ridge contact, as a fraction of the thickness. */
static const float EDGE_CONTACT_FRACTION = 0.1f;
/* Cosine above which a direction is along an edge. */
static const float ALONG_EDGE_COSINE = 0.7f;
/* Fraction of the smaller thickness. */
static const float CLUSTER_MARGIN_FRACTION = 0.25f;
/* Limbs below this sine between their axes do not cross. */
static const float CROSSING_SINE = 0.2f;
static const sbf_vec3 no_direction = {0, 0, 0};

typedef struct crossing {
  const sbri_narrow_phase *f;
  sbri_overlap overlap;
  sbf_vec3 exits[SBRI_OVERLAP_SETS]; /* exit direction of each cluster for body 0, opposite for body 1; 0:
                                        nearest faces */
  uint32_t first_contact;            /* index of the pair's first contact */
  float max_exit_m;                  /* longest exit searched, m */
  float cluster_margin_m;            /* m; contacts this close to a cluster must not block its exit */
} crossing;

static float sign_of(uint32_t side) {
  return side ? -1.0f : 1.0f;
}

static bool is_direction(sbf_vec3 direction) {
  return sbri_dot(direction, direction) > 0;
}

/* Side of an edge of the cluster; 2: not in the cluster. */
static uint32_t side_in_cluster(const crossing *l, const sbri_overlap_edge *e, uint32_t cluster) {
  return sbri_cluster_of_edge(&l->overlap, e) == cluster ? sbri_side_of_edge(&l->overlap, e) : 2;
}

/* Whether a long edge would move along itself, without leaving. */
static bool is_along_edge(const crossing *l, const sbri_overlap_edge *e, sbf_vec3 direction) {
  const sbri_pair_body *other = l->overlap.bodies[1 - sbri_side_of_edge(&l->overlap, e)];
  return e->length > sbri_pair_body_thickness(other) &&
         fabsf(sbri_dot(direction, e->direction)) > ALONG_EDGE_COSINE;
}

/* Distance from an edge's middle to the nearest face, m, and its direction; 0: none. */
static float edge_exit_distance(const crossing *l, const sbri_overlap_edge *e, sbf_vec3 *distance) {
  const sbri_pair_body *other = l->overlap.bodies[1 - sbri_side_of_edge(&l->overlap, e)];
  sbri_surface_hit found;
  if (!sbri_find_nearest_exit(other, e->position, &found)) return 0;
  *distance = found.normal;
  return sbri_pair_body_distance(other, &found, e->position);
}

/* ---- Directions ---- */

/* Exit distance of a point, m, or `longest` if that is more. */
static float max_exit_distance(const sbri_contact_surface *other, const sbri_ray_frame *direction, sbf_vec3 x,
    float max_distance, float longest) {
  sbri_surface_hit found;
  float distance = sbri_find_exit_along(other, direction, x, max_distance, &found);
  return distance > longest ? distance : longest;
}

/* Distance until the whole cluster is outside, m; INFINITY: not below `max_distance`. */
static float cluster_exit_distance(
    const crossing *l, uint32_t cluster, sbf_vec3 direction, float max_distance) {
  float longest = 0;
  for (uint32_t side = 0; side < 2; side++) {
    const sbri_contact_surface *s = l->overlap.bodies[side]->surface,
                               *other = l->overlap.bodies[1 - side]->surface;
    sbri_ray_frame ray = sbri_ray_frame_make(sbri_scale(direction, sign_of(side)));
    uint32_t count = 0, visited = 0, sample_stride;
    for (uint32_t i = 0; i < l->overlap.set_count; i++) {
      const sbri_overlap_set *set = &l->overlap.sets[i];
      if (set->side == side && set->cluster == cluster && set->root != SBRI_NO_CLUSTER) count += set->count;
    }
    sample_stride = 1 + count / MAX_SAMPLES;
    for (uint32_t v = 0; v < s->vertex_count && count > 0; v++) {
      if (s->inside_parents[v] == SBRI_VERTEX_OUTSIDE ||
          sbri_cluster_of_feature(&l->overlap, side, v) != cluster || visited++ % sample_stride)
        continue;
      longest = max_exit_distance(other, &ray, s->positions[v], max_distance, longest);
      if (!(longest < max_distance)) return INFINITY;
    }
    for (uint32_t i = 0; i < l->overlap.edge_count; i++) {
      const sbri_overlap_edge *e = &l->overlap.edges[i];
      if (side_in_cluster(l, e, cluster) != side) continue;
      longest = max_exit_distance(other, &ray, e->position, max_distance, longest);
      if (!(longest < max_distance) || is_along_edge(l, e, ray.direction)) return INFINITY;
    }
  }
  return longest;
}

/* Directions to the faces, edges and corners of a cube. */
static sbf_vec3 direction_at(uint32_t number) {
  uint32_t n = number < 13 ? number : number + 1; /* 13 is the cube's center */
  sbf_vec3 to = sbri_vec3((float)(n % 3) - 1, (float)(n / 3 % 3) - 1, (float)(n / 9) - 1);
  return sbri_normalize(to, to);
}

/* Direction with the shortest exit below the maximum; 0: none. */
static sbf_vec3 find_shortest_exit(const crossing *l, uint32_t cluster) {
  sbf_vec3 best = no_direction;
  float min_distance = l->max_exit_m;
  for (uint32_t i = 0; i < DIRECTION_COUNT; i++) {
    float distance = cluster_exit_distance(l, cluster, direction_at(i), min_distance);
    if (distance < min_distance) min_distance = distance, best = direction_at(i);
  }
  return best;
}

/* Principal direction of the cluster's edges of one side, by power iteration on the sum of their outer
 * products; and the mean of their middles. */
static sbf_vec3 axis_of(const crossing *l, uint32_t cluster, uint32_t side, sbf_vec3 *middle) {
  float xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0, count = 0;
  *middle = no_direction;
  for (uint32_t i = 0; i < l->overlap.edge_count; i++) {
    const sbri_overlap_edge *e = &l->overlap.edges[i];
    sbf_vec3 d = e->direction, to = sbri_scale(d, e->length);
    if (side_in_cluster(l, e, cluster) != side) continue;
    xx += d.x * to.x, yy += d.y * to.y, zz += d.z * to.z;
    xy += d.x * to.y, xz += d.x * to.z, yz += d.y * to.z;
    *middle = sbri_add(*middle, e->position), count++;
  }
  sbf_vec3 axis = xx >= yy && xx >= zz ? sbri_vec3(1, 0, 0)
                  : yy >= zz           ? sbri_vec3(0, 1, 0)
                                       : sbri_vec3(0, 0, 1);
  if (count == 0) return no_direction;
  *middle = sbri_scale(*middle, 1 / count);
  for (int i = 0; i < POWER_ITERATIONS; i++)
    axis =
        sbri_normalize(sbri_vec3(xx * axis.x + xy * axis.y + xz * axis.z,
                           xy * axis.x + yy * axis.y + yz * axis.z, xz * axis.x + yz * axis.y + zz * axis.z),
            axis);
  return axis;
}

/* Mean of the limb's vertices near x. The edges' spans lie on the other body's side if the limbs overlap a
 * little. */
static sbf_vec3 limb_center_near(const sbri_pair_body *p, sbf_vec3 x) {
  const sbri_contact_surface *s = p->surface;
  float radius = (s->mean_edge_m + s->thickness_m) * p->owner->scale, count = 0;
  sbf_vec3 sum = no_direction;
  for (uint32_t v = 0; v < s->vertex_count; v++) {
    sbf_vec3 off = sbri_sub(s->positions[v], x);
    if (sbri_dot(off, off) < radius * radius) sum = sbri_add(sum, s->positions[v]), count++;
  }
  return count > 0 ? sbri_scale(sum, 1 / count) : x;
}

/* Exit of crossing limbs: normal to both axes, towards the side each limb is on; 0: none. */
static sbf_vec3 exit_across_limbs(const crossing *l, uint32_t cluster) {
  sbf_vec3 middles[2], a = axis_of(l, cluster, 0, &middles[0]), b = axis_of(l, cluster, 1, &middles[1]);
  sbf_vec3 n = sbri_cross(a, b);
  if (sbri_length(n) < CROSSING_SINE) return no_direction;
  n = sbri_normalize(n, n);
  for (int k = 0; k < 2; k++) middles[k] = limb_center_near(l->overlap.bodies[k], middles[k]);
  if (sbri_dot(n, sbri_sub(middles[0], middles[1])) < 0) n = sbri_scale(n, -1);
  return cluster_exit_distance(l, cluster, n, l->max_exit_m) < l->max_exit_m ? n : no_direction;
}

/* Distance of the deepest point to its nearest face, m. */
static float cluster_depth(const crossing *l, uint32_t cluster) {
  float deepest = 0;
  for (uint32_t side = 0; side < 2; side++) {
    const sbri_contact_surface *s = l->overlap.bodies[side]->surface;
    const sbri_pair_body *other = l->overlap.bodies[1 - side];
    for (uint32_t v = 0; v < s->vertex_count; v++) {
      sbri_surface_hit found;
      if (s->inside_parents[v] == SBRI_VERTEX_OUTSIDE ||
          sbri_cluster_of_feature(&l->overlap, side, v) != cluster)
        continue;
      if (!sbri_find_nearest_exit(other, s->positions[v], &found)) continue;
      deepest = fmaxf(deepest, sbri_pair_body_distance(other, &found, s->positions[v]));
    }
  }
  for (uint32_t i = 0; i < l->overlap.edge_count; i++) {
    sbf_vec3 distance;
    if (side_in_cluster(l, &l->overlap.edges[i], cluster) < 2)
      deepest = fmaxf(deepest, edge_exit_distance(l, &l->overlap.edges[i], &distance));
  }
  return deepest;
}

/* First and next cached contact of one side; NULL: no more. */
static const sbri_cached_contact *first_cached(const crossing *l, uint32_t side) {
  const uint64_t names[2] = {sbri_contact_body_id(l->overlap.bodies[side]->body),
      sbri_contact_body_id(l->overlap.bodies[1 - side]->body)};
  return sbri_first_cached_contact(l->f->world->body_contacts, names);
}

static const sbri_cached_contact *next_cached(const crossing *l, const sbri_cached_contact *m) {
  return sbri_next_cached_contact(l->f->world->body_contacts, m);
}

/* Cached exit of the previous tick, not turned with the bodies; 0: none. */
static sbf_vec3 cached_exit(const crossing *l, uint32_t cluster) {
  sbf_vec3 sum = no_direction;
  for (uint32_t side = 0; side < 2; side++)
    for (const sbri_cached_contact *m = first_cached(l, side); m; m = next_cached(l, m))
      if (is_direction(m->common_exit) && sbri_cluster_of_feature(&l->overlap, side, m->feature) == cluster)
        sum = sbri_add_scaled(sum, m->common_exit, sign_of(side));
  return is_direction(sum) ? sbri_normalize(sum, sum) : sum;
}

/* Keeps the exit; tests one other direction per tick. */
static sbf_vec3 refresh_exit(const crossing *l, uint32_t cluster, sbf_vec3 direction) {
  float distance = cluster_exit_distance(l, cluster, direction, l->max_exit_m);
  if (!(distance < l->max_exit_m)) return find_shortest_exit(l, cluster);
  sbf_vec3 other = direction_at((uint32_t)(l->f->world->time.ticks % DIRECTION_COUNT));
  return cluster_exit_distance(l, cluster, other, SWITCH_FACTOR * distance) < SWITCH_FACTOR * distance
             ? other
             : direction;
}

/* ---- Contacts ---- */

static sbri_contact *contacts_of(const crossing *l) {
  return l->f->world->body_contacts->contacts + l->f->group->first_contact;
}

static uint32_t side_of(const crossing *l, const sbri_contact *t) {
  return t->body_ids[0] == sbri_contact_body_id(l->overlap.bodies[0]->body) ? 0 : 1;
}

/* Whether a nearest exit in the cluster opposes the common one. */
static bool opposes_a_contact(const crossing *l, uint32_t cluster, sbf_vec3 direction) {
  for (uint32_t i = l->first_contact; i < l->f->group->contact_count; i++) {
    const sbri_contact *t = &contacts_of(l)[i];
    uint32_t side = side_of(l, t);
    if (sbri_dot(t->normal, direction) * sign_of(side) < OPPOSED_COSINE &&
        sbri_cluster_of_feature(&l->overlap, side, t->feature) == cluster)
      return true;
  }
  return false;
}

/* Whether a contact of the cluster is deeper than the search for faces. */
static bool has_deep_contact(const crossing *l, uint32_t cluster) {
  for (uint32_t i = l->first_contact; i < l->f->group->contact_count; i++) {
    const sbri_contact *t = &contacts_of(l)[i];
    if (t->exits_nearest && sbri_cluster_of_feature(&l->overlap, side_of(l, t), t->feature) == cluster)
      return true;
  }
  return false;
}

static bool are_opposed(const sbri_box *directions) {
  const sbf_vec3 *a = &directions->low, *b = &directions->high;
  return (a->x < -OPPOSED_COMPONENT && b->x > OPPOSED_COMPONENT) ||
         (a->y < -OPPOSED_COMPONENT && b->y > OPPOSED_COMPONENT) ||
         (a->z < -OPPOSED_COMPONENT && b->z > OPPOSED_COMPONENT);
}

/* Whether deep contacts of the cluster oppose each other; SBRI_NO_CLUSTER: of the pair. */
static bool has_opposed_contacts(const crossing *l, uint32_t cluster) {
  sbri_box directions = sbri_box_of_point(no_direction);
  for (uint32_t i = l->first_contact; i < l->f->group->contact_count; i++) {
    const sbri_contact *t = &contacts_of(l)[i];
    uint32_t side = side_of(l, t);
    if (t->is_deep &&
        (cluster == SBRI_NO_CLUSTER || sbri_cluster_of_feature(&l->overlap, side, t->feature) == cluster))
      directions = sbri_box_with(directions, sbri_scale(t->normal, sign_of(side)));
  }
  return are_opposed(&directions);
}

/* Whether edges of the cluster oppose each other, or one is so deep that it passes through. */
static bool has_opposed_edges(const crossing *l, uint32_t cluster) {
  sbri_box directions = sbri_box_of_point(no_direction);
  for (uint32_t i = 0; i < l->overlap.edge_count; i++) {
    sbf_vec3 distance = no_direction;
    uint32_t side = side_in_cluster(l, &l->overlap.edges[i], cluster);
    if (side > 1) continue;
    const sbri_pair_body *other = l->overlap.bodies[1 - side];
    float depth = edge_exit_distance(l, &l->overlap.edges[i], &distance);
    if (depth > EDGE_DEEP_FRACTION * sbri_pair_body_thickness(other)) return true;
    if (depth > EDGE_CONTACT_FRACTION * sbri_pair_body_thickness(other))
      directions = sbri_box_with(directions, sbri_scale(distance, sign_of(side)));
  }
  return are_opposed(&directions);
}

/* A cluster keeps its common exit until the nearest exits agree with it. */
static sbf_vec3 choose_exit(const crossing *l, uint32_t cluster) {
  sbf_vec3 direction = cached_exit(l, cluster);
  bool has_edges = has_opposed_edges(l, cluster);
  if (is_direction(direction)) {
    if (!has_edges || !(cluster_exit_distance(l, cluster, direction, l->max_exit_m) < l->max_exit_m))
      direction = refresh_exit(l, cluster, direction);
    return has_edges || has_deep_contact(l, cluster) || opposes_a_contact(l, cluster, direction)
               ? direction
               : no_direction;
  }
  if (!has_edges && !has_deep_contact(l, cluster) && !has_opposed_contacts(l, cluster)) return no_direction;
  if (has_edges) direction = exit_across_limbs(l, cluster);
  if (!is_direction(direction)) direction = find_shortest_exit(l, cluster);
  bool rigid = l->overlap.bodies[1]->rigid != NULL; /* a rigid body moves as a whole */
  if (!is_direction(direction) || !(has_edges || rigid || opposes_a_contact(l, cluster, direction)))
    return no_direction;
  float longest = MAX_LENGTH_FACTOR * cluster_depth(l, cluster);
  if (has_edges)
    longest = fmaxf(longest, LIMB_EXIT_FRACTION * (sbri_pair_body_thickness(l->overlap.bodies[0]) +
                                                      sbri_pair_body_thickness(l->overlap.bodies[1])));
  return cluster_exit_distance(l, cluster, direction, l->max_exit_m) > longest ? no_direction : direction;
}

/* Sets the contact's other side and normal to where x leaves the other body. */
static bool set_exit(const crossing *l, uint32_t side, sbf_vec3 direction, sbf_vec3 x, sbri_contact *t) {
  const sbri_pair_body *other = l->overlap.bodies[1 - side];
  sbri_ray_frame ray = sbri_ray_frame_make(direction);
  sbri_surface_hit found;
  if (!(sbri_find_exit_along(other->surface, &ray, x, l->max_exit_m, &found) < l->max_exit_m)) return false;
  t->b = sbri_pair_body_side(other, other->surface->triangles + 3 * (size_t)found.face, found.weights, 3);
  t->normal = ray.direction;
  t->exits_nearest = t->exits_common = true;
  t->friction = 0;
  return true;
}

static void redirect_contact(const crossing *l, sbri_contact *t) {
  uint32_t side = side_of(l, t), cluster = sbri_cluster_of_feature(&l->overlap, side, t->feature);
  if (cluster == SBRI_NO_CLUSTER || !is_direction(l->exits[cluster])) return;
  (void)set_exit(l, side, sbri_scale(l->exits[cluster], sign_of(side)),
      l->overlap.bodies[side]->surface->positions[t->feature], t);
}

static void add_edge_exit(const crossing *l, const sbri_overlap_edge *e) {
  uint32_t side = sbri_side_of_edge(&l->overlap, e), cluster = sbri_cluster_of_edge(&l->overlap, e);
  const float weights[2] = {1 - e->fraction, e->fraction};
  sbri_contact t = {.feature = e->feature};
  if (!e->both_ends_outside || !is_direction(l->exits[cluster])) return;
  if (!set_exit(l, side, sbri_scale(l->exits[cluster], sign_of(side)), e->position, &t)) return;
  t.a = sbri_pair_body_side(l->overlap.bodies[side], e->ends, weights, 2);
  sbri_narrow_phase_add(l->f, l->overlap.bodies[side], l->overlap.bodies[1 - side], &t);
}

/* Whether a contact outside of the cluster blocks the cluster's exit. */
static bool blocks_exit(const crossing *l, const sbri_contact *t) {
  uint32_t side = side_of(l, t);
  sbf_vec3 x = l->overlap.bodies[side]->surface->positions[t->feature];
  if (t->exits_nearest || sbri_cluster_of_feature(&l->overlap, side, t->feature) != SBRI_NO_CLUSTER)
    return false;
  for (uint32_t i = 0; i < l->overlap.set_count; i++) {
    sbf_vec3 direction = l->exits[l->overlap.sets[i].cluster];
    sbri_box frame = sbri_box_of_point(x),
             region = sbri_box_grown(l->overlap.sets[i].box, l->cluster_margin_m);
    if (sbri_dot(t->normal, direction) * sign_of(side) < OPPOSED_COSINE &&
        sbri_boxes_overlap(&frame, &region))
      return true;
  }
  return false;
}

static void remove_blocking_contacts(const crossing *l) {
  uint32_t kept = l->first_contact;
  for (uint32_t i = l->first_contact; i < l->f->group->contact_count; i++)
    if (!blocks_exit(l, &contacts_of(l)[i])) contacts_of(l)[kept++] = contacts_of(l)[i];
  l->f->group->contact_count = kept;
}

/* ---- All ---- */

static bool any_deep_contact(const crossing *l) {
  for (uint32_t i = l->first_contact; i < l->f->group->contact_count; i++)
    if (contacts_of(l)[i].exits_nearest) return true;
  return false;
}

static bool any_cached_exit(const crossing *l) {
  for (uint32_t side = 0; side < 2; side++)
    for (const sbri_cached_contact *m = first_cached(l, side); m; m = next_cached(l, m))
      if (is_direction(m->common_exit)) return true;
  return false;
}

static bool are_near(const sbri_pair_body *a, const sbri_pair_body *b) {
  sbri_box box = b->surface->tree.nodes[0].box;
  if (b->rigid) {
    sbr_transform frame = sbri_pair_body_frame(b, false);
    box = sbri_box_grown(sbri_box_of_point(frame.position), b->rigid->radius * b->owner->scale);
  }
  return sbri_boxes_overlap(&a->surface->tree.nodes[0].box, &box);
}

void sbri_resolve_crossings(
    const sbri_narrow_phase *f, const sbri_pair_body *a, const sbri_pair_body *b, uint32_t first) {
  float sizes[2] = {sbri_pair_body_size(a), sbri_pair_body_size(b)};
  crossing l = {.f = f, .first_contact = first, .max_exit_m = fminf(sizes[0], sizes[1])};
  l.overlap.bodies[0] = a, l.overlap.bodies[1] = b;
  l.cluster_margin_m =
      CLUSTER_MARGIN_FRACTION * fminf(sbri_pair_body_thickness(a), sbri_pair_body_thickness(b));
  bool is_needed = any_deep_contact(&l) || any_cached_exit(&l) || has_opposed_contacts(&l, SBRI_NO_CLUSTER);
  if (!is_needed && !(sbri_are_coarse_limbs(a, b) && are_near(a, b))) return;
  if (b->rigid) {
    sbr_transform frame = sbri_pair_body_frame(b, false);
    sbri_contact_hull_update(b->rigid, &frame, &frame, b->owner->scale, b->surface);
  }
  if (!is_needed && !sbri_edges_intersect(a->surface, b->surface)) return;
  sbri_overlap_update(&l.overlap);
  for (uint32_t k = 0; k < l.overlap.set_count; k++)
    l.exits[k] = l.overlap.sets[k].cluster == k ? choose_exit(&l, k) : no_direction;
  remove_blocking_contacts(&l);
  uint32_t end = f->group->contact_count;
  for (uint32_t i = first; i < end; i++) redirect_contact(&l, &contacts_of(&l)[i]);
  for (uint32_t i = 0; i < l.overlap.edge_count; i++) add_edge_exit(&l, &l.overlap.edges[i]);
}
