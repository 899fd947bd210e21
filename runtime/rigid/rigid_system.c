#include "rigid/rigid_system.h"

#include <string.h>

#include "rigid/ball_edge.h"
#include "rigid/sym6.h"

/* A pivot below this fraction of the row's own diagonal marks a redundant row. */
static const double DEPENDENT = 1e-11;

/* Most loops of hinges have redundant rows. A row is left out if its pivot is below this fraction of its
 * value for the bodies alone, which is the rounding error of the Jacobian in single precision. */
static const double REDUNDANT = 3e-7;
/* Compliance of all loop rows, as a fraction of that value: of nearly dependent rows, as in a net, none then
 * amplifies rounding. The position error that this leaves is corrected at the end of the step. */
static const double GIVE = 1e-5;

void sbri_edge_list_active(sbri_edge *e) {
  e->active_count = 0;
  for (uint32_t r = 0; r < e->row_count; r++)
    if (e->rows[r].active) e->actives[e->active_count++] = (uint16_t)r;
}

/* The side of an edge at the node. */
static int side_of(const sbri_edge *e, int32_t node) {
  return e->nodes[SBRI_B] == node ? SBRI_B : SBRI_A;
}

/* Cholesky factorisation of (count x count), lower, as in sbri_sym6_factor. A row whose pivot is below its
 * `min`, or, if that is NULL, below a fraction of its diagonal, gets the pivot 0. */
static void factor_dense(double *a, uint32_t count, const double *min) {
  for (uint32_t k = 0; k < count; k++) {
    double *row = a + (size_t)k * count, own = row[k];
    for (uint32_t j = 0; j < k; j++) {
      const double *other = a + (size_t)j * count;
      double sum = row[j];
      for (uint32_t i = 0; i < j; i++) sum -= row[i] * other[i];
      row[j] = sum * other[j];
    }
    double pivot = own;
    for (uint32_t j = 0; j < k; j++) pivot -= row[j] * row[j];
    row[k] = pivot > (min ? min[k] : DEPENDENT * own) ? 1 / sqrt(pivot) : 0;
  }
}

static void forward_dense(const double *l, uint32_t count, double *b) {
  for (uint32_t i = 0; i < count; i++) {
    const double *row = l + (size_t)i * count;
    double sum = b[i];
    for (uint32_t j = 0; j < i; j++) sum -= row[j] * b[j];
    b[i] = sum * row[i];
  }
}

static void solve_back_dense(const double *l, uint32_t count, double *b) {
  for (uint32_t i = count; i-- > 0;) {
    double sum = b[i];
    for (uint32_t j = i + 1; j < count; j++) sum -= l[(size_t)j * count + i] * b[j];
    b[i] = sum * l[(size_t)i * count + i];
  }
}

/* ---- Tree ---- */

static void eliminate_edge(sbri_rigid_system *s, sbri_node *node, sbri_edge *e) {
  uint32_t count = e->active_count;
  int child = side_of(e, (int32_t)(node - s->nodes));
  for (uint32_t r = 0; r < count; r++) {
    const sbri_row *row = &e->rows[e->actives[r]];
    double *y = e->y + 6 * (size_t)r;
    for (int i = 0; i < 6; i++) y[i] = row->rates[child][i];
    sbri_sym6_solve_forward(node->d, y);
    for (uint32_t k = 0; k <= r; k++) e->g[r * count + k] = sbri_dot6(y, e->y + 6 * (size_t)k);
    e->g[r * count + r] += row->compliance;
  }
  factor_dense(e->g, count, NULL);
  if (node->parent < 0) return;
  sbri_node *parent = &s->nodes[node->parent];
  for (uint32_t r = 0; r < count; r++) {
    double *w = e->w + 6 * (size_t)r;
    for (int i = 0; i < 6; i++) w[i] = e->rows[e->actives[r]].rates[1 - child][i];
    for (uint32_t k = 0; k < r; k++) sbri_add6(w, e->w + 6 * (size_t)k, -e->g[r * count + k]);
    for (int i = 0; i < 6; i++) w[i] *= e->g[r * count + r];
    for (int i = 0; i < 6; i++)
      for (int j = 0; j <= i; j++) parent->d[i][j] += w[i] * w[j];
  }
}

static void factor_tree(sbri_rigid_system *s) {
  for (uint32_t i = 0; i < s->step_count; i++) {
    sbri_node *node = s->steps[i].node;
    if (s->steps[i].pair) {
      sbri_balls_eliminate(s->steps[i].pair);
      continue;
    }
    sbri_sym6_factor(node->d);
    if (node->edge >= 0) eliminate_edge(s, node, &s->edges[node->edge]);
  }
}

static void forward_node(sbri_rigid_system *s, sbri_node *node, bool with_rhs) {
  sbri_sym6_solve_forward(node->d, node->b);
  if (node->edge < 0) return;
  sbri_edge *e = &s->edges[node->edge];
  for (uint32_t r = 0; r < e->active_count; r++)
    e->t[r] = (with_rhs ? e->rhs[r] : 0) - sbri_dot6(e->y + 6 * (size_t)r, node->b);
  forward_dense(e->g, e->active_count, e->t);
  for (uint32_t r = 0; node->parent >= 0 && r < e->active_count; r++)
    sbri_add6(s->nodes[node->parent].b, e->w + 6 * (size_t)r, e->t[r]);
}

static void solve_back_node(sbri_rigid_system *s, sbri_node *node, bool keeps_impulses) {
  memcpy(node->x, node->b, sizeof node->x);
  if (node->edge >= 0) {
    sbri_edge *e = &s->edges[node->edge];
    for (uint32_t r = 0; node->parent >= 0 && r < e->active_count; r++)
      e->t[r] -= sbri_dot6(e->w + 6 * (size_t)r, s->nodes[node->parent].x);
    solve_back_dense(e->g, e->active_count, e->t);
    for (uint32_t r = 0; r < e->active_count; r++) {
      sbri_add6(node->x, e->y + 6 * (size_t)r, e->t[r]);
      if (keeps_impulses) e->rows[e->actives[r]].impulse += (float)e->t[r];
    }
  }
  sbri_sym6_solve_back(node->d, node->x);
}

/* Solves from the nodes' b to their x; `with_rhs`: with the edges' right-hand sides, else with 0;
 * `keeps_impulses`: stores the impulses of rows. */
static void solve_tree(sbri_rigid_system *s, bool with_rhs, bool keeps_impulses) {
  for (uint32_t i = 0; i < s->step_count; i++)
    if (s->steps[i].pair)
      sbri_balls_solve_forward(s->steps[i].pair, with_rhs);
    else
      forward_node(s, s->steps[i].node, with_rhs);
  for (uint32_t i = s->step_count; i-- > 0;)
    if (s->steps[i].pair)
      sbri_balls_solve_back(s->steps[i].pair, keeps_impulses);
    else
      solve_back_node(s, s->steps[i].node, keeps_impulses);
}

/* ---- Loops ---- */

static void clear_b(sbri_rigid_system *s) {
  for (uint32_t i = 0; i < s->node_count; i++) memset(s->nodes[i].b, 0, sizeof s->nodes[i].b);
}

static void store_b(sbri_rigid_system *s, double *kept, bool restore) {
  for (uint32_t i = 0; i < s->node_count; i++)
    memcpy(
        restore ? s->nodes[i].b : kept + 6 * i, restore ? kept + 6 * i : s->nodes[i].b, sizeof s->nodes[i].b);
}

/* Change of the row's rate by x, 6 numbers per node. */
static double rate_of(const sbri_edge *e, const sbri_row *row, const double *x) {
  double sum = 0;
  for (int side = 0; side < SBRI_SIDES; side++)
    if (e->nodes[side] >= 0) sum += sbri_dot6_rates(row->rates[side], x + 6 * (size_t)e->nodes[side]);
  return sum;
}

static void apply_impulse(sbri_rigid_system *s, const sbri_edge *e, const sbri_row *row, double impulse) {
  for (int side = 0; side < SBRI_SIDES; side++)
    if (e->nodes[side] >= 0) sbri_add6_rates(s->nodes[e->nodes[side]].b, row->rates[side], impulse);
}

double sbri_row_response(const sbri_rigid_system *s, const sbri_edge *e, const sbri_row *row) {
  double sum = 0;
  for (int side = 0; side < SBRI_SIDES; side++) {
    const float *j = row->rates[side];
    if (e->nodes[side] < 0) continue;
    const float *inverse_mass = s->nodes[e->nodes[side]].inverse_mass;
    sum += (j[0] * j[0] + j[1] * j[1] + j[2] * j[2]) * inverse_mass[0] +
           (j[3] * j[3] + j[4] * j[4] + j[5] * j[5]) * inverse_mass[1];
  }
  return sum;
}

static void factor_loops(sbri_rigid_system *s) {
  uint32_t count = 0;
  for (uint32_t l = 0; l < s->loop_count; l++) {
    sbri_edge *e = &s->edges[s->loops[l]];
    uint32_t capacity = s->loop_row_capacity - count;
    if (e->active_count > capacity) e->active_count = capacity;
    count += e->active_count;
  }
  s->loop_row_count = count;
  double *b = s->responses + (size_t)s->loop_row_capacity * s->node_count * 6;
  store_b(s, b, false);
  uint32_t at = 0;
  for (uint32_t l = 0; l < s->loop_count; l++) {
    const sbri_edge *e = &s->edges[s->loops[l]];
    for (uint32_t r = 0; r < e->active_count; r++, at++) {
      clear_b(s);
      apply_impulse(s, e, &e->rows[e->actives[r]], 1);
      solve_tree(s, false, false);
      double *response = s->responses + (size_t)at * s->node_count * 6;
      for (uint32_t i = 0; i < s->node_count; i++)
        memcpy(response + 6 * i, s->nodes[i].x, 6 * sizeof(double));
    }
  }
  at = 0;
  for (uint32_t l = 0; l < s->loop_count; l++) {
    const sbri_edge *e = &s->edges[s->loops[l]];
    for (uint32_t r = 0; r < e->active_count; r++, at++) {
      const sbri_row *row = &e->rows[e->actives[r]];
      double *to = s->loop_matrix + (size_t)at * count;
      for (uint32_t k = 0; k <= at; k++)
        to[k] = rate_of(e, row, s->responses + (size_t)k * s->node_count * 6);
      to[at] += row->compliance + GIVE * sbri_row_response(s, e, row);
      s->loop_rhs[at] = REDUNDANT * sbri_row_response(s, e, row);
    }
  }
  factor_dense(s->loop_matrix, count, s->loop_rhs);
  store_b(s, b, true);
}

void sbri_system_factor(sbri_rigid_system *s) {
  factor_tree(s);
  s->loop_row_count = 0;
  if (s->loop_count) factor_loops(s);
}

void sbri_system_solve(sbri_rigid_system *s) {
  if (!s->loop_row_count) {
    solve_tree(s, true, true);
    return;
  }
  /* First with open loops, then with the impulses that close them. */
  double *b = s->responses + (size_t)s->loop_row_capacity * s->node_count * 6;
  store_b(s, b, false);
  solve_tree(s, true, false);
  double *x = b + (size_t)s->node_count * 6;
  for (uint32_t i = 0; i < s->node_count; i++) memcpy(x + 6 * i, s->nodes[i].x, sizeof s->nodes[i].x);
  uint32_t at = 0;
  for (uint32_t l = 0; l < s->loop_count; l++) {
    const sbri_edge *e = &s->edges[s->loops[l]];
    for (uint32_t r = 0; r < e->active_count; r++, at++)
      s->loop_rhs[at] = e->rhs[r] - rate_of(e, &e->rows[e->actives[r]], x);
  }
  forward_dense(s->loop_matrix, s->loop_row_count, s->loop_rhs);
  solve_back_dense(s->loop_matrix, s->loop_row_count, s->loop_rhs);
  store_b(s, b, true);
  at = 0;
  for (uint32_t l = 0; l < s->loop_count; l++) {
    const sbri_edge *e = &s->edges[s->loops[l]];
    for (uint32_t r = 0; r < e->active_count; r++, at++) {
      apply_impulse(s, e, &e->rows[e->actives[r]], s->loop_rhs[at]);
      e->rows[e->actives[r]].impulse += (float)s->loop_rhs[at];
    }
  }
  solve_tree(s, true, true);
}

void sbri_system_add_impulses(sbri_rigid_system *s) {
  for (uint32_t i = 0; i < s->step_count; i++)
    if (s->steps[i].pair) sbri_balls_add_impulses(s->steps[i].pair);
}
