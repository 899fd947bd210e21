#include "rigid/ball_edge.h"

#include <math.h>
#include <string.h>

static void cross(const double a[3], const double b[3], double to[3]) {
  to[0] = a[1] * b[2] - a[2] * b[1];
  to[1] = a[2] * b[0] - a[0] * b[2];
  to[2] = a[0] * b[1] - a[1] * b[0];
}

/* A, symmetric, of which the lower half counts; E, rows of turns; C, lower half. */
typedef struct place_inertia {
  double a[3][3], e[3][3], c[3][3];
} place_inertia;

/* To another place, from which the one before is `r` away: E + r^ A, and C + r^ E'^T - E r^. */
static void move_place(place_inertia *i, const double r[3]) {
  double before[3][3], turned[3];
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

/* What gives way between the two bodies' turns, lower half. */
static void find_give(const sbri_edge *edge, int side, double k[3][3]) {
  for (int i = 0; i < 3; i++)
    for (int j = 0; j <= i; j++) k[i][j] = i == j ? edge->ball->flesh : 0;
  for (uint32_t r = 0; r < edge->active_count; r++) {
    const sbri_row *row = &edge->rows[edge->actives[r]];
    const float *g = row->rates[side] + 3;
    double stiff = 1 / (double)row->give;
    for (int i = 0; i < 3; i++)
      for (int j = 0; j <= i; j++) k[i][j] += stiff * g[i] * g[j];
  }
}

/* Lower half to its factor, the pivots' inverses on the diagonal, as sbri_sym6_factor. */
static void factor3(double d[3][3]) {
  for (int k = 0; k < 3; k++) {
    double pivot = d[k][k], inverse = 0;
    for (int j = 0; j < k; j++) pivot -= d[k][j] * d[k][j];
    if (pivot > 1e-15 * d[k][k]) inverse = 1 / sqrt(pivot);
    for (int i = k + 1; i < 3; i++) {
      double sum = d[i][k];
      for (int j = 0; j < k; j++) sum -= d[i][j] * d[k][j];
      d[i][k] = sum * inverse;
    }
    d[k][k] = inverse;
  }
}

static void forward3(double l[3][3], double b[3]) {
  b[0] = b[0] * l[0][0];
  b[1] = (b[1] - l[1][0] * b[0]) * l[1][1];
  b[2] = (b[2] - l[2][0] * b[0] - l[2][1] * b[1]) * l[2][2];
}

static void back3(double l[3][3], double y[3]) {
  y[2] = y[2] * l[2][2];
  y[1] = (y[1] - l[2][1] * y[2]) * l[1][1];
  y[0] = (y[0] - l[1][0] * y[1] - l[2][0] * y[2]) * l[0][0];
}

/* L^-1 of a matrix, row after row. */
static void forward_rows(double l[3][3], double m[3][3]) {
  for (int j = 0; j < 3; j++) {
    m[0][j] = m[0][j] * l[0][0];
    m[1][j] = (m[1][j] - l[1][0] * m[0][j]) * l[1][1];
    m[2][j] = (m[2][j] - l[2][0] * m[0][j] - l[2][1] * m[1][j]) * l[2][2];
  }
}

static double dot_columns(double a[3][3], int i, double b[3][3], int j) {
  return a[0][i] * b[0][j] + a[1][i] * b[1][j] + a[2][i] * b[2][j];
}

/* ---- Factor ---- */

void sbri_ball_eliminate(sbri_edge *edge, const sbri_node *child, sbri_node *parent) {
  sbri_ball *ball = edge->ball;
  place_inertia i;
  double back[3];
  for (int j = 0; j < 3; j++) {
    back[j] = -ball->levers[ball->child][j];
    for (int k = 0; k <= j; k++) i.a[j][k] = child->d[j][k], i.c[j][k] = child->d[3 + j][3 + k];
    for (int k = 0; k < 3; k++) i.e[j][k] = child->d[3 + j][k];
  }
  move_place(&i, back);
  memcpy(ball->a, i.a, sizeof ball->a);
  memcpy(ball->e, i.e, sizeof ball->e);
  find_give(edge, ball->child, ball->k);
  for (int j = 0; j < 3; j++)
    for (int k = 0; k <= j; k++) ball->l[j][k] = i.c[j][k] + ball->k[j][k], ball->k[k][j] = ball->k[j][k];
  factor3(ball->l);
  memcpy(ball->y, ball->e, sizeof ball->y);
  memcpy(ball->z, ball->k, sizeof ball->z);
  forward_rows(ball->l, ball->y);
  forward_rows(ball->l, ball->z);
  if (!parent) return;
  for (int j = 0; j < 3; j++) {
    for (int k = 0; k <= j; k++) {
      i.a[j][k] -= dot_columns(ball->y, j, ball->y, k);
      i.c[j][k] = ball->k[j][k] - dot_columns(ball->z, j, ball->z, k);
    }
    for (int k = 0; k < 3; k++) i.e[j][k] = dot_columns(ball->z, j, ball->y, k);
  }
  move_place(&i, ball->levers[1 - ball->child]);
  for (int j = 0; j < 3; j++) {
    for (int k = 0; k <= j; k++) parent->d[j][k] += i.a[j][k], parent->d[3 + j][3 + k] += i.c[j][k];
    for (int k = 0; k < 3; k++) parent->d[3 + j][k] += i.e[j][k];
  }
}

/* ---- Solution ---- */

static double dot3(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double dot_column(double a[3][3], int i, const double b[3]) {
  return a[0][i] * b[0] + a[1][i] * b[1] + a[2][i] * b[2];
}

static void find_wanted(const sbri_edge *edge, double turn[3]) {
  const sbri_ball *ball = edge->ball;
  double sign = ball->child == SBRI_B ? 1 : -1;
  for (int k = 0; k < 3; k++) turn[k] = sign * ball->flesh * ball->flesh_rhs[k];
  for (uint32_t r = 0; r < edge->active_count; r++) {
    const sbri_row *row = &edge->rows[edge->actives[r]];
    const float *g = row->rates[ball->child] + 3;
    double pull = edge->rhs[r] / (double)row->give;
    for (int k = 0; k < 3; k++) turn[k] += pull * g[k];
  }
}

void sbri_ball_forward(sbri_edge *edge, sbri_node *child, sbri_node *parent, bool with_rhs) {
  sbri_ball *ball = edge->ball;
  double moment[3], turned[3], sign = ball->child == SBRI_B ? 1 : -1;
  memset(ball->wanted, 0, sizeof ball->wanted);
  memset(ball->shift, 0, sizeof ball->shift);
  memcpy(ball->force, child->b, sizeof ball->force);
  cross(ball->levers[ball->child], ball->force, turned);
  for (int k = 0; k < 3; k++) moment[k] = child->b[3 + k] - turned[k];
  if (with_rhs) {
    find_wanted(edge, ball->wanted);
    for (int k = 0; k < 3; k++) ball->shift[k] = sign * ball->rhs[k];
    for (int k = 0; k < 3; k++) {
      ball->force[k] -= dot3(ball->a[k], ball->shift);
      moment[k] -= dot3(ball->e[k], ball->shift);
    }
  }
  for (int k = 0; k < 3; k++) ball->p[k] = moment[k] + ball->wanted[k];
  forward3(ball->l, ball->p);
  if (!parent) return;
  double force[3];
  for (int k = 0; k < 3; k++) force[k] = ball->force[k] - dot_column(ball->y, k, ball->p);
  cross(ball->levers[1 - ball->child], force, turned);
  for (int k = 0; k < 3; k++) {
    parent->b[k] += force[k];
    parent->b[3 + k] += turned[k] + dot_column(ball->z, k, ball->p) - ball->wanted[k];
  }
}

/* What the edge has done to body b: an impulse at the place, and a moment about it. */
static void note(sbri_edge *edge, const double speed[3], const double turn[3], const double parent_turn[3]) {
  sbri_ball *ball = edge->ball;
  double sign = ball->child == SBRI_B ? 1 : -1;
  const double off[3] = {parent_turn[0] - turn[0], parent_turn[1] - turn[1], parent_turn[2] - turn[2]};
  for (int k = 0; k < 3; k++) {
    ball->impulse[k] += sign * (dot3(ball->a[k], speed) + dot_column(ball->e, k, turn) - ball->force[k]);
    ball->moment[k] += sign * (dot3(ball->k[k], off) + ball->wanted[k]);
  }
  for (uint32_t r = 0; r < edge->active_count; r++) {
    sbri_row *row = &edge->rows[edge->actives[r]];
    const float *g = row->rates[ball->child] + 3;
    double moved = -(g[0] * off[0] + g[1] * off[1] + g[2] * off[2]);
    row->impulse += (float)((edge->rhs[r] - moved) / (double)row->give);
  }
}

void sbri_ball_back(sbri_edge *edge, sbri_node *child, const sbri_node *parent, bool keep) {
  sbri_ball *ball = edge->ball;
  double speed[3] = {0, 0, 0}, parent_turn[3] = {0, 0, 0}, turned[3], *w = child->x + 3;
  if (parent) {
    memcpy(parent_turn, parent->x + 3, sizeof parent_turn);
    cross(parent_turn, ball->levers[1 - ball->child], turned);
    for (int k = 0; k < 3; k++) speed[k] = parent->x[k] + turned[k];
  }
  for (int k = 0; k < 3; k++) w[k] = ball->p[k] + dot3(ball->z[k], parent_turn) - dot3(ball->y[k], speed);
  back3(ball->l, w);
  cross(w, ball->levers[ball->child], turned);
  for (int k = 0; k < 3; k++) child->x[k] = speed[k] + ball->shift[k] - turned[k];
  if (keep) note(edge, speed, w, parent_turn);
}
