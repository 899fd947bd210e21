/* The set of simulated bodies changes during a game, so the spanning tree is rebuilt each tick. Joints are
 * taken in the order of their number of constraints; one that connects two components belongs to the tree
 * (Kruskal's algorithm; the world is a component). The others close loops. */
#include "base/union_find.h"
#include "rigid/rigid_work.h"

static bool is_movable(const sbri_rigid_tick *t, int32_t body) {
  return body >= 0 && t->bodies[body].mode != SBR_RIGID_KINEMATIC && t->model->bodies[body].mass > 0;
}

/* Selects the active joints and marks those of the tree in `in_tree`. */
static void choose_edges(const sbri_rigid_tick *t, sbri_rigid_solving *work, uint8_t *in_tree) {
  sbri_rigid_system *s = &work->system;
  const sbri_rigid_model *m = t->model;
  uint32_t world = m->body_count, *parts = work->roots;
  sbfi_sets_begin(parts, m->body_count + 1);
  s->edge_count = s->loop_count = 0;
  for (uint32_t k = 0; k < m->joint_count; k++) {
    uint32_t j = m->by_strength[k], ends[SBRI_SIDES];
    const sbri_rigid_joint *joint = &m->joints[j];
    bool moves[SBRI_SIDES];
    for (int side = 0; side < SBRI_SIDES; side++) {
      moves[side] = is_movable(t, joint->bodies[side]);
      ends[side] = sbfi_set_root(parts, moves[side] ? (uint32_t)joint->bodies[side] : world);
    }
    if (!(moves[SBRI_A] || moves[SBRI_B]) || t->joints[j].broken ||
        joint->bodies[SBRI_A] == joint->bodies[SBRI_B])
      continue;
    uint32_t edge = s->edge_count++;
    s->edges[edge].joint = j;
    in_tree[edge] = ends[SBRI_A] != ends[SBRI_B];
    if (in_tree[edge])
      sbfi_sets_join(parts, ends[SBRI_A], ends[SBRI_B]);
    else
      s->loops[s->loop_count++] = edge;
  }
}

static void add_node(sbri_rigid_solving *work, uint32_t body, int32_t parent, int32_t edge) {
  sbri_rigid_system *s = &work->system;
  work->motions[body].node = (int32_t)s->node_count;
  s->nodes[s->node_count++] = (sbri_node){.body = body, .parent = parent, .edge = edge};
}

/* Whether it locks a point and leaves all rotations free except for limits. */
static bool is_ball(const sbri_rigid_joint *joint) {
  const sbf_limit_list *limits = &joint->source->limits;
  if (joint->source->kind != SBF_JOINT_KIND_SPHERICAL) return false;
  for (uint32_t i = 0; i < limits->count; i++)
    if (limits->at[i].min == limits->at[i].max && !(limits->at[i].stiffness > 0)) return false;
  return true;
}

static void make_balls(const sbri_rigid_tick *t, sbri_rigid_solving *work) {
  sbri_rigid_system *s = &work->system;
  for (uint32_t i = 0; i < s->edge_count; i++) s->edges[i].ball = NULL;
  for (uint32_t i = 0; i < s->node_count; i++) {
    int32_t edge = s->nodes[i].edge;
    if (edge < 0 || !is_ball(&t->model->joints[s->edges[edge].joint])) continue;
    s->edges[edge].ball = &work->balls[edge];
    work->balls[edge] = (sbri_ball){.child = s->edges[edge].nodes[SBRI_B] == (int32_t)i ? SBRI_B : SBRI_A};
  }
}

static bool is_on_ball(const sbri_rigid_system *s, uint32_t node) {
  return s->nodes[node].edge >= 0 && s->edges[s->nodes[node].edge].ball;
}

/* Number of entries after a ball in which a partner is searched; that of a limb is one or two away. */
enum { PARTNERS = 16 };

/* Pairs ball joints and orders all nodes for elimination, from the end of the list, where the leaves are.
 * Each joint is paired with the next one whose children are all done. */
static void list_steps(sbri_rigid_solving *work) {
  sbri_rigid_system *s = &work->system;
  uint32_t *waits = work->roots, pair_count = 0; /* number of children not yet eliminated */
  const uint32_t gone = UINT32_MAX;
  for (uint32_t i = 0; i < s->node_count; i++) waits[i] = 0;
  for (uint32_t i = 0; i < s->node_count; i++)
    if (s->nodes[i].parent >= 0) waits[s->nodes[i].parent]++;
  s->step_count = 0;
  for (uint32_t i = s->node_count; i-- > 0;) {
    if (waits[i] == gone) continue;
    sbri_tree_step *step = &s->steps[s->step_count++];
    uint32_t both[2] = {i, i}, count = 1;
    *step = (sbri_tree_step){.node = &s->nodes[i]};
    if (is_on_ball(s, i)) {
      for (uint32_t j = i; count < SBRI_TWINS && j-- > 0 && j + PARTNERS >= i;)
        if (waits[j] == 0 && is_on_ball(s, j)) both[count++] = j;
      step->pair = &work->pairs[pair_count++];
      step->pair->count = count;
    }
    for (uint32_t k = 0; k < 2 && step->pair; k++) {
      sbri_node *node = &s->nodes[both[k]];
      step->pair->children[k] = node;
      step->pair->edges[k] = &s->edges[node->edge];
      step->pair->parents[k] = node->parent >= 0 ? &s->nodes[node->parent] : NULL;
    }
    for (uint32_t k = 0; k < count; k++) {
      waits[both[k]] = gone;
      if (s->nodes[both[k]].parent >= 0) waits[s->nodes[both[k]].parent]--;
    }
  }
}

/* Extends the tree from the nodes that are already in the list. */
static void grow(const sbri_rigid_tick *t, sbri_rigid_solving *work, const int32_t *edge_of_joint,
    const uint8_t *in_tree, uint32_t from) {
  sbri_rigid_system *s = &work->system;
  const sbri_rigid_model *m = t->model;
  for (uint32_t i = from; i < s->node_count; i++) {
    const sbri_rigid_body *body = &m->bodies[s->nodes[i].body];
    for (uint32_t k = body->joint_begin; k < body->joint_end; k++) {
      uint32_t j = m->joints_of[k];
      int32_t edge = edge_of_joint[j];
      const sbri_rigid_joint *joint = &m->joints[j];
      int32_t other = joint->bodies[joint->bodies[SBRI_A] == (int32_t)s->nodes[i].body ? SBRI_B : SBRI_A];
      if (edge < 0 || !in_tree[edge] || !is_movable(t, other) || work->motions[other].node >= 0) continue;
      add_node(work, (uint32_t)other, (int32_t)i, edge);
    }
  }
}

void sbri_rigid_tree_make(const sbri_rigid_tick *t, sbri_rigid_solving *work) {
  sbri_rigid_system *s = &work->system;
  const sbri_rigid_model *m = t->model;
  uint8_t *in_tree = (uint8_t *)work->order;
  int32_t *edge_of_joint = (int32_t *)(work->order + m->joint_count + 1);
  choose_edges(t, work, in_tree);
  for (uint32_t j = 0; j < m->joint_count; j++) edge_of_joint[j] = -1;
  for (uint32_t e = 0; e < s->edge_count; e++) edge_of_joint[s->edges[e].joint] = (int32_t)e;
  s->node_count = 0;
  for (uint32_t b = 0; b <= m->body_count; b++) work->motions[b].node = -1;
  for (uint32_t e = 0; e < s->edge_count; e++) { /* nodes with a joint to the world first */
    const sbri_rigid_joint *joint = &m->joints[s->edges[e].joint];
    bool a = is_movable(t, joint->bodies[SBRI_A]), b = is_movable(t, joint->bodies[SBRI_B]);
    if (!in_tree[e] || (a && b)) continue;
    uint32_t from = s->node_count;
    add_node(work, (uint32_t)joint->bodies[a ? SBRI_A : SBRI_B], -1, (int32_t)e);
    grow(t, work, edge_of_joint, in_tree, from);
  }
  for (uint32_t b = 0; b < m->body_count; b++) { /* then bodies without joints */
    if (!is_movable(t, (int32_t)b) || work->motions[b].node >= 0) continue;
    uint32_t from = s->node_count;
    add_node(work, b, -1, -1);
    grow(t, work, edge_of_joint, in_tree, from);
  }
  for (uint32_t e = 0; e < s->edge_count; e++)
    for (int side = 0; side < SBRI_SIDES; side++) {
      int32_t body = m->joints[s->edges[e].joint].bodies[side];
      s->edges[e].nodes[side] = body >= 0 ? work->motions[body].node : -1;
    }
  make_balls(t, work);
  list_steps(work);
}
