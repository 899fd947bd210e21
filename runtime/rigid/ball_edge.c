#include "rigid/ball_edge.h"

#include <math.h>
#include <string.h>

enum { SECOND = SBRI_TWINS - 1 };

static void cross(const sbri_twin a[3], const sbri_twin b[3], sbri_twin to[3]) {
  to[0] = a[1] * b[2] - a[2] * b[1];
  to[1] = a[2] * b[0] - a[0] * b[2];
  to[2] = a[0] * b[1] - a[1] * b[0];
}

/* Articulated inertia. A: symmetric, only the lower half is valid; E: rows are angular; C: lower half. */
typedef struct contact_inertia {
  sbri_twin a[3][3], e[3][3], c[3][3];
} contact_inertia;

/* Moves the reference point by -r: E + r^ A, and C + r^ E'^T - E r^. */
static inline void move_position(contact_inertia *i, const sbri_twin r[3]) {
  sbri_twin old_e[3][3], product[3];
  memcpy(old_e, i->e, sizeof old_e);
  i->a[0][1] = i->a[1][0], i->a[0][2] = i->a[2][0], i->a[1][2] = i->a[2][1];
  for (int j = 0; j < 3; j++) {
    cross(r, i->a[j], product);
    for (int k = 0; k < 3; k++) i->e[k][j] += product[k];
  }
  for (int j = 0; j < 3; j++) {
    cross(r, i->e[j], product);
    for (int k = j; k < 3; k++) i->c[k][j] += product[k];
    cross(r, old_e[j], product);
    for (int k = 0; k <= j; k++) i->c[j][k] += product[k];
  }
}

/* Adds the rotational compliance of the rows to the lower half. */
static void add_compliance(const sbri_edge *edge, double k[3][3]) {
  for (uint32_t r = 0; r < edge->active_count; r++) {
    const sbri_row *row = &edge->rows[edge->actives[r]];
    const float *g = row->rates[edge->ball->child] + 3;
    double stiff = 1 / (double)row->compliance;
    for (int i = 0; i < 3; i++)
      for (int j = 0; j <= i; j++) k[i][j] += stiff * g[i] * g[j];
  }
}

/* Stiffness matrix between the two rotations (lower half): of all rows, and of joint damping. */
static void find_compliance(const sbri_ball_pair *p, sbri_twin k[3][3]) {
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
    add_compliance(edges[lane], of[lane]);
  }
  for (int i = 0; i < 3; i++)
    for (int j = 0; j <= i; j++) k[i][j] = sbri_twin_of(of[0][i][j], of[SECOND][i][j]);
}

/* Inverse square root of a pivot; 0 if the pivot is lost in rounding. */
static sbri_twin inverse_root(sbri_twin pivot, sbri_twin own) {
  double of[2] = {0, 0};
  for (int lane = 0; lane < SBRI_TWINS; lane++)
    if (sbri_twin_at(pivot, lane) > 1e-15 * sbri_twin_at(own, lane))
      of[lane] = 1 / sqrt(sbri_twin_at(pivot, lane));
  return sbri_twin_of(of[0], of[SECOND]);
}

/* Cholesky factor of the lower half, with inverse pivots on the diagonal, as in sbri_sym6_factor. */
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

/* Applies L^-1 to a matrix, row by row. */
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

static void read_levers(sbri_ball_pair *p) {
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
  read_levers(p);
  gather(p, &i);
  for (int j = 0; j < 3; j++) back[j] = -p->own[j];
  move_position(&i, back);
  memcpy(p->a, i.a, sizeof p->a);
  memcpy(p->e, i.e, sizeof p->e);
  find_compliance(p, p->k);
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

/* Adds the moments by the rows' right-hand sides. */
static void add_targets(const sbri_edge *edge, double angular_change[3]) {
  for (uint32_t r = 0; r < edge->active_count; r++) {
    const sbri_row *row = &edge->rows[edge->actives[r]];
    const float *g = row->rates[edge->ball->child] + 3;
    double torque = edge->rhs[r] / (double)row->compliance;
    for (int k = 0; k < 3; k++) angular_change[k] += torque * g[k];
  }
}

static void find_targets(sbri_ball_pair *p) {
  const sbri_ball *a = p->edges[0]->ball, *b = p->edges[SECOND]->ball;
  sbri_twin attached = p->sign * sbri_twin_of(a->attached_inertia, b->attached_inertia);
  for (int k = 0; k < 3; k++) p->wanted[k] = attached * sbri_twin_of(a->attached_rhs[k], b->attached_rhs[k]);
  if (!(p->edges[0]->active_count || p->edges[SECOND]->active_count)) return;
  double of[2][3];
  for (int lane = 0; lane < SBRI_TWINS; lane++) {
    for (int k = 0; k < 3; k++) of[lane][k] = sbri_twin_at(p->wanted[k], lane);
    add_targets(p->edges[lane], of[lane]);
  }
  for (int k = 0; k < 3; k++) p->wanted[k] = sbri_twin_of(of[0][k], of[SECOND][k]);
}

void sbri_balls_solve_forward(sbri_ball_pair *p, bool with_rhs) {
  const sbri_ball *first = p->edges[0]->ball, *second = p->edges[SECOND]->ball;
  const double *a = p->children[0]->b, *b = p->children[SECOND]->b;
  sbri_twin moment[3], product[3];
  memset(p->wanted, 0, sizeof p->wanted);
  memset(p->shift, 0, sizeof p->shift);
  for (int k = 0; k < 3; k++) p->force[k] = sbri_twin_of(a[k], b[k]);
  cross(p->own, p->force, product);
  for (int k = 0; k < 3; k++) moment[k] = sbri_twin_of(a[3 + k], b[3 + k]) - product[k];
  if (with_rhs) {
    find_targets(p);
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
  cross(p->other, force, product);
  for (uint32_t lane = 0; lane < p->count; lane++) {
    sbri_node *parent = p->parents[lane];
    for (int k = 0; parent && k < 3; k++) {
      parent->b[k] += sbri_twin_at(force[k], (int)lane);
      parent->b[3 + k] += sbri_twin_at(product[k] + moment[k], (int)lane);
    }
  }
}

/* Angular velocity changes of the parents, and their velocity changes at the joints' points; 0 for the world.
 */
static void find_parents(const sbri_ball_pair *p, sbri_twin velocity_change[3], sbri_twin angular_change[3]) {
  static const double none[6] = {0, 0, 0, 0, 0, 0};
  const double *a = p->parents[0] ? p->parents[0]->x : none,
               *b = p->parents[SECOND] ? p->parents[SECOND]->x : none;
  sbri_twin product[3];
  for (int k = 0; k < 3; k++) angular_change[k] = sbri_twin_of(a[3 + k], b[3 + k]);
  cross(angular_change, p->other, product);
  for (int k = 0; k < 3; k++) velocity_change[k] = sbri_twin_of(a[k], b[k]) + product[k];
}

/* Adds the rows' impulses for a relative rotation of b against a. */
static void add_row_impulses(const sbri_edge *edge, const double relative[3]) {
  for (uint32_t r = 0; r < edge->active_count; r++) {
    sbri_row *row = &edge->rows[edge->actives[r]];
    const float *g = row->rates[edge->ball->child] + 3;
    double moved = -(g[0] * relative[0] + g[1] * relative[1] + g[2] * relative[2]);
    row->impulse += (float)((edge->rhs[r] - moved) / (double)row->compliance);
  }
}

void sbri_balls_solve_back(sbri_ball_pair *p, bool keep) {
  sbri_twin velocity_change[3], parent_angular_change[3], product[3], w[3];
  find_parents(p, velocity_change, parent_angular_change);
  for (int k = 0; k < 3; k++)
    w[k] = p->p[k] + dot3(p->z[k], parent_angular_change) - dot3(p->y[k], velocity_change);
  back3(p->l, w);
  cross(w, p->own, product);
  for (uint32_t lane = 0; lane < p->count; lane++) {
    double *x = p->children[lane]->x;
    int at = (int)lane;
    for (int k = 0; k < 3; k++) {
      x[k] = sbri_twin_at(velocity_change[k] + p->shift[k] - product[k], at);
      x[3 + k] = sbri_twin_at(w[k], at);
    }
    if (!keep || !p->edges[lane]->active_count) continue;
    double relative[3];
    for (int k = 0; k < 3; k++) relative[k] = sbri_twin_at(parent_angular_change[k] - w[k], at);
    add_row_impulses(p->edges[lane], relative);
  }
}

/* Impulses on bodies b at the joints' points, and moments about them. */
void sbri_balls_add_impulses(sbri_ball_pair *p) {
  sbri_twin velocity_change[3], parent_angular_change[3], angular_change[3], relative[3];
  find_parents(p, velocity_change, parent_angular_change);
  const double *a = p->children[0]->x, *b = p->children[SECOND]->x;
  for (int k = 0; k < 3; k++) {
    angular_change[k] = sbri_twin_of(a[3 + k], b[3 + k]);
    relative[k] = parent_angular_change[k] - angular_change[k];
  }
  for (int k = 0; k < 3; k++) {
    sbri_twin impulse =
        p->sign * (dot3(p->a[k], velocity_change) + dot_column(p->e, k, angular_change) - p->force[k]);
    sbri_twin moment = p->sign * (dot3(p->k[k], relative) + p->wanted[k]);
    for (uint32_t lane = 0; lane < p->count; lane++) {
      p->edges[lane]->ball->impulse[k] += sbri_twin_at(impulse, (int)lane);
      p->edges[lane]->ball->moment[k] += sbri_twin_at(moment, (int)lane);
    }
  }
}
