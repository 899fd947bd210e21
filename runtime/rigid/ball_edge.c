#include "rigid/ball_edge.h"

#include <math.h>
#include <string.h>

enum { SECOND = SBRI_TWINS - 1 };

static void cross(const sbri_twin a[3], const sbri_twin b[3], sbri_twin to[3]) {
  to[0] = a[1] * b[2] - a[2] * b[1];
  to[1] = a[2] * b[0] - a[0] * b[2];
  to[2] = a[0] * b[1] - a[1] * b[0];
}

/* A, symmetric, of which the lower half counts; E, rows of turns; C, lower half. */
typedef struct contact_inertia {
  sbri_twin a[3][3], e[3][3], c[3][3];
} contact_inertia;

/* To another place, from which the one before is `r` away: E + r^ A, and C + r^ E'^T - E r^. */
static inline void move_position(contact_inertia *i, const sbri_twin r[3]) {
  sbri_twin before[3][3], turned[3];
  memcpy(before, i->e, sizeof before);
  i->a[0][1] = i->a[1][0], i->a[0][2] = i->a[2][0], i->a[1][2] = i->a[2][1];
  for (int j = 0; j < 3; j++) {
    cross(r, i->a[j], turned);
    for (int k = 0; k < 3; k++) i->e[k][j] += turned[k];
  }
  for (int j = 0; j < 3; j++) {
    cross(r, i->e[j], turned);
    for (int k = j; k < 3; k++) i->c[k][j] += turned[k];
    cross(r, before[j], turned);
    for (int k = 0; k <= j; k++) i->c[j][k] += turned[k];
  }
}

/* Adds the rows' compliance between the two bodies' rotations to the lower half. */
static void add_give(const sbri_edge *edge, double k[3][3]) {
  for (uint32_t r = 0; r < edge->active_count; r++) {
    const sbri_row *row = &edge->rows[edge->actives[r]];
    const float *g = row->rates[edge->ball->child] + 3;
    double stiff = 1 / (double)row->give;
    for (int i = 0; i < 3; i++)
      for (int j = 0; j <= i; j++) k[i][j] += stiff * g[i] * g[j];
  }
}

/* Compliance (lower half): of all rows, and of joint damping alone. */
static void find_give(const sbri_ball_pair *p, sbri_twin k[3][3]) {
  const sbri_edge *const *edges = (const sbri_edge *const *)p->edges;
  sbri_twin attached = sbri_twin_of(edges[0]->ball->attached_inertia, edges[SECOND]->ball->attached_inertia);
  double of[2][3][3];
  if (!(edges[0]->active_count || edges[SECOND]->active_count)) {
    for (int i = 0; i < 3; i++)
      for (int j = 0; j <= i; j++) k[i][j] = i == j ? attached : sbri_twin_of(0, 0);
    return;
  }
  for (int lane = 0; lane < SBRI_TWINS; lane++) {
    for (int i = 0; i < 3; i++)
      for (int j = 0; j <= i; j++) of[lane][i][j] = i == j ? edges[lane]->ball->attached_inertia : 0;
    add_give(edges[lane], of[lane]);
  }
  for (int i = 0; i < 3; i++)
    for (int j = 0; j <= i; j++) k[i][j] = sbri_twin_of(of[0][i][j], of[SECOND][i][j]);
}

/* The inverse of a pivot's root; 0 where rounding has left no sign of it. */
static sbri_twin inverse_root(sbri_twin pivot, sbri_twin own) {
  double of[2] = {0, 0};
  for (int lane = 0; lane < SBRI_TWINS; lane++)
    if (sbri_twin_at(pivot, lane) > 1e-15 * sbri_twin_at(own, lane))
      of[lane] = 1 / sqrt(sbri_twin_at(pivot, lane));
  return sbri_twin_of(of[0], of[SECOND]);
}

/* Lower half to its factor, the pivots' inverses on the diagonal, as sbri_sym6_factor. */
static inline void factor3(sbri_twin d[3][3]) {
  for (int k = 0; k < 3; k++) {
    sbri_twin pivot = d[k][k];
    for (int j = 0; j < k; j++) pivot -= d[k][j] * d[k][j];
    sbri_twin inverse = inverse_root(pivot, d[k][k]);
    for (int i = k + 1; i < 3; i++) {
      sbri_twin sum = d[i][k];
      for (int j = 0; j < k; j++) sum -= d[i][j] * d[k][j];
      d[i][k] = sum * inverse;
    }
    d[k][k] = inverse;
  }
}

static inline void forward3(sbri_twin l[3][3], sbri_twin b[3]) {
  b[0] = b[0] * l[0][0];
  b[1] = (b[1] - l[1][0] * b[0]) * l[1][1];
  b[2] = (b[2] - l[2][0] * b[0] - l[2][1] * b[1]) * l[2][2];
}

static inline void back3(sbri_twin l[3][3], sbri_twin y[3]) {
  y[2] = y[2] * l[2][2];
  y[1] = (y[1] - l[2][1] * y[2]) * l[1][1];
  y[0] = (y[0] - l[1][0] * y[1] - l[2][0] * y[2]) * l[0][0];
}

/* L^-1 of a matrix, row after row. */
static inline void forward_rows(sbri_twin l[3][3], sbri_twin m[3][3]) {
  for (int j = 0; j < 3; j++) {
    m[0][j] = m[0][j] * l[0][0];
    m[1][j] = (m[1][j] - l[1][0] * m[0][j]) * l[1][1];
    m[2][j] = (m[2][j] - l[2][0] * m[0][j] - l[2][1] * m[1][j]) * l[2][2];
  }
}

static inline sbri_twin dot_columns(sbri_twin a[3][3], int i, sbri_twin b[3][3], int j) {
  return a[0][i] * b[0][j] + a[1][i] * b[1][j] + a[2][i] * b[2][j];
}

/* ---- Factor ---- */

static void gather(const sbri_ball_pair *p, contact_inertia *i) {
  const sbri_node *a = p->children[0], *b = p->children[SECOND];
  for (int j = 0; j < 3; j++) {
    for (int k = 0; k <= j; k++) {
      i->a[j][k] = sbri_twin_of(a->d[j][k], b->d[j][k]);
      i->c[j][k] = sbri_twin_of(a->d[3 + j][3 + k], b->d[3 + j][3 + k]);
    }
    for (int k = 0; k < 3; k++) i->e[j][k] = sbri_twin_of(a->d[3 + j][k], b->d[3 + j][k]);
  }
}

static void take_levers(sbri_ball_pair *p) {
  const sbri_ball *a = p->edges[0]->ball, *b = p->edges[SECOND]->ball;
  for (int k = 0; k < 3; k++) {
    p->own[k] = sbri_twin_of(a->levers[a->child][k], b->levers[b->child][k]);
    p->other[k] = sbri_twin_of(a->levers[1 - a->child][k], b->levers[1 - b->child][k]);
  }
  p->sign = sbri_twin_of(a->child == SBRI_B ? 1 : -1, b->child == SBRI_B ? 1 : -1);
}

void sbri_balls_eliminate(sbri_ball_pair *p) {
  contact_inertia i;
  sbri_twin back[3];
  take_levers(p);
  gather(p, &i);
  for (int j = 0; j < 3; j++) back[j] = -p->own[j];
  move_position(&i, back);
  memcpy(p->a, i.a, sizeof p->a);
  memcpy(p->e, i.e, sizeof p->e);
  find_give(p, p->k);
  for (int j = 0; j < 3; j++)
    for (int k = 0; k <= j; k++) p->l[j][k] = i.c[j][k] + p->k[j][k], p->k[k][j] = p->k[j][k];
  factor3(p->l);
  memcpy(p->y, p->e, sizeof p->y);
  memcpy(p->z, p->k, sizeof p->z);
  forward_rows(p->l, p->y);
  forward_rows(p->l, p->z);
  for (int j = 0; j < 3; j++) {
    for (int k = 0; k <= j; k++) {
      i.a[j][k] -= dot_columns(p->y, j, p->y, k);
      i.c[j][k] = p->k[j][k] - dot_columns(p->z, j, p->z, k);
    }
    for (int k = 0; k < 3; k++) i.e[j][k] = dot_columns(p->z, j, p->y, k);
  }
  move_position(&i, p->other);
  for (uint32_t lane = 0; lane < p->count; lane++) {
    sbri_node *parent = p->parents[lane];
    int at = (int)lane;
    for (int j = 0; parent && j < 3; j++) {
      for (int k = 0; k <= j; k++) {
        parent->d[j][k] += sbri_twin_at(i.a[j][k], at);
        parent->d[3 + j][3 + k] += sbri_twin_at(i.c[j][k], at);
      }
      for (int k = 0; k < 3; k++) parent->d[3 + j][k] += sbri_twin_at(i.e[j][k], at);
    }
  }
}

/* ---- Solution ---- */

static inline sbri_twin dot3(const sbri_twin a[3], const sbri_twin b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline sbri_twin dot_column(sbri_twin a[3][3], int i, const sbri_twin b[3]) {
  return a[0][i] * b[0] + a[1][i] * b[1] + a[2][i] * b[2];
}

/* What rows want of the turns. */
static void add_wanted(const sbri_edge *edge, double turn[3]) {
  for (uint32_t r = 0; r < edge->active_count; r++) {
    const sbri_row *row = &edge->rows[edge->actives[r]];
    const float *g = row->rates[edge->ball->child] + 3;
    double pull = edge->rhs[r] / (double)row->give;
    for (int k = 0; k < 3; k++) turn[k] += pull * g[k];
  }
}

static void find_wanted(sbri_ball_pair *p) {
  const sbri_ball *a = p->edges[0]->ball, *b = p->edges[SECOND]->ball;
  sbri_twin attached = p->sign * sbri_twin_of(a->attached_inertia, b->attached_inertia);
  for (int k = 0; k < 3; k++) p->wanted[k] = attached * sbri_twin_of(a->attached_rhs[k], b->attached_rhs[k]);
  if (!(p->edges[0]->active_count || p->edges[SECOND]->active_count)) return;
  double of[2][3];
  for (int lane = 0; lane < SBRI_TWINS; lane++) {
    for (int k = 0; k < 3; k++) of[lane][k] = sbri_twin_at(p->wanted[k], lane);
    add_wanted(p->edges[lane], of[lane]);
  }
  for (int k = 0; k < 3; k++) p->wanted[k] = sbri_twin_of(of[0][k], of[SECOND][k]);
}

void sbri_balls_solve_forward(sbri_ball_pair *p, bool with_rhs) {
  const sbri_ball *first = p->edges[0]->ball, *second = p->edges[SECOND]->ball;
  const double *a = p->children[0]->b, *b = p->children[SECOND]->b;
  sbri_twin moment[3], turned[3];
  memset(p->wanted, 0, sizeof p->wanted);
  memset(p->shift, 0, sizeof p->shift);
  for (int k = 0; k < 3; k++) p->force[k] = sbri_twin_of(a[k], b[k]);
  cross(p->own, p->force, turned);
  for (int k = 0; k < 3; k++) moment[k] = sbri_twin_of(a[3 + k], b[3 + k]) - turned[k];
  if (with_rhs) {
    find_wanted(p);
    for (int k = 0; k < 3; k++) p->shift[k] = p->sign * sbri_twin_of(first->rhs[k], second->rhs[k]);
    for (int k = 0; k < 3; k++) {
      p->force[k] -= dot3(p->a[k], p->shift);
      moment[k] -= dot3(p->e[k], p->shift);
    }
  }
  for (int k = 0; k < 3; k++) p->p[k] = moment[k] + p->wanted[k];
  forward3(p->l, p->p);
  sbri_twin force[3];
  for (int k = 0; k < 3; k++) {
    force[k] = p->force[k] - dot_column(p->y, k, p->p);
    moment[k] = dot_column(p->z, k, p->p) - p->wanted[k];
  }
  cross(p->other, force, turned);
  for (uint32_t lane = 0; lane < p->count; lane++) {
    sbri_node *parent = p->parents[lane];
    for (int k = 0; parent && k < 3; k++) {
      parent->b[k] += sbri_twin_at(force[k], (int)lane);
      parent->b[3 + k] += sbri_twin_at(turned[k] + moment[k], (int)lane);
    }
  }
}

/* The parents' turns, and how fast they go at the joints' places; 0 of the world. */
static void find_parents(const sbri_ball_pair *p, sbri_twin speed[3], sbri_twin turn[3]) {
  static const double none[6] = {0, 0, 0, 0, 0, 0};
  const double *a = p->parents[0] ? p->parents[0]->x : none,
               *b = p->parents[SECOND] ? p->parents[SECOND]->x : none;
  sbri_twin turned[3];
  for (int k = 0; k < 3; k++) turn[k] = sbri_twin_of(a[3 + k], b[3 + k]);
  cross(turn, p->other, turned);
  for (int k = 0; k < 3; k++) speed[k] = sbri_twin_of(a[k], b[k]) + turned[k];
}

/* What the rows have done, by how much b has turned against a. */
static void note_rows(const sbri_edge *edge, const double off[3]) {
  for (uint32_t r = 0; r < edge->active_count; r++) {
    sbri_row *row = &edge->rows[edge->actives[r]];
    const float *g = row->rates[edge->ball->child] + 3;
    double moved = -(g[0] * off[0] + g[1] * off[1] + g[2] * off[2]);
    row->impulse += (float)((edge->rhs[r] - moved) / (double)row->give);
  }
}

void sbri_balls_solve_back(sbri_ball_pair *p, bool keep) {
  sbri_twin speed[3], parent_turn[3], turned[3], w[3];
  find_parents(p, speed, parent_turn);
  for (int k = 0; k < 3; k++) w[k] = p->p[k] + dot3(p->z[k], parent_turn) - dot3(p->y[k], speed);
  back3(p->l, w);
  cross(w, p->own, turned);
  for (uint32_t lane = 0; lane < p->count; lane++) {
    double *x = p->children[lane]->x;
    int at = (int)lane;
    for (int k = 0; k < 3; k++) {
      x[k] = sbri_twin_at(speed[k] + p->shift[k] - turned[k], at);
      x[3 + k] = sbri_twin_at(w[k], at);
    }
    if (!keep || !p->edges[lane]->active_count) continue;
    double off[3];
    for (int k = 0; k < 3; k++) off[k] = sbri_twin_at(parent_turn[k] - w[k], at);
    note_rows(p->edges[lane], off);
  }
}

/* What the edges have done to bodies b: impulses at the places, and moments about them. */
void sbri_balls_note(sbri_ball_pair *p) {
  sbri_twin speed[3], parent_turn[3], turn[3], off[3];
  find_parents(p, speed, parent_turn);
  const double *a = p->children[0]->x, *b = p->children[SECOND]->x;
  for (int k = 0; k < 3; k++) {
    turn[k] = sbri_twin_of(a[3 + k], b[3 + k]);
    off[k] = parent_turn[k] - turn[k];
  }
  for (int k = 0; k < 3; k++) {
    sbri_twin impulse = p->sign * (dot3(p->a[k], speed) + dot_column(p->e, k, turn) - p->force[k]);
    sbri_twin moment = p->sign * (dot3(p->k[k], off) + p->wanted[k]);
    for (uint32_t lane = 0; lane < p->count; lane++) {
      p->edges[lane]->ball->impulse[k] += sbri_twin_at(impulse, (int)lane);
      p->edges[lane]->ball->moment[k] += sbri_twin_at(moment, (int)lane);
    }
  }
}
