/* The linear system of one substep: simulated bodies and the constraint rows between them.
 *
 * The unknowns are the changes of the bodies' velocities x (linear and angular, six a body) and the rows'
 * impulses l in
 *   D x - J^T l = b      D: masses, moments of inertia, and contacts, which act on single bodies
 *   J x + G l   = c      one line a row; compliance G = 0 is hard, G > 0 soft (springs, dampers)
 * The bodies are the nodes of a graph, the joints its edges. Along a spanning tree, bodies and joints are
 * eliminated from the leaves to the roots without fill-in (Baraff, Linear-Time Dynamics using Lagrange
 * Multipliers, 1996). Joints that close loops follow by their Schur complement, which is dense and small. For
 * a tree the time is linear in the number of bodies. The result is exact up to rounding for any mass ratio:
 * no iteration carries an impulse from body to body.
 *
 * Redundant rows of a joint (a cone and a box at one bound) are found by their vanishing pivots and left out.
 */
#ifndef SBRI_RIGID_SYSTEM_H
#define SBRI_RIGID_SYSTEM_H

#include "math/twin.h"
#include "model/rigid_model.h"
#include "rigid/sym6.h"

typedef enum sbri_row_kind {
  SBRI_ROW_LOCKED, /* a coordinate at one value */
  SBRI_ROW_LIMIT,  /* unilateral: its impulse is not negative */
  SBRI_ROW_SPRING, /* a limit with stiffness, also unilateral */
  SBRI_ROW_DRIVE,  /* a coordinate's motor, cut to a maximum */
  SBRI_ROW_TRACK   /* a motor towards an angle of the animated pose */
} sbri_row_kind;

/* Limit of a row's coordinate. */
typedef struct sbri_row_limit {
  float position;     /* the coordinate when the substep begins */
  float lower, upper; /* range */
  float bounce_speed; /* of a limit that was reached: speed of the rebound; else 0 */
} sbri_row_limit;

/* Changes of a limit's rate during the iterations of a solve. */
typedef struct sbri_row_change {
  float target;   /* wanted change */
  float previous; /* by the previous iteration */
  float last;     /* by the last iteration */
} sbri_row_change;

typedef struct sbri_row {
  float rates[SBRI_SIDES][6]; /* of the two bodies */
  float target;               /* c, of the velocities at the substep's end */
  float compliance;           /* G */
  float max;                  /* maximum impulse of a drive, N s or N m s; 0: no bound */
  float attached_mass;        /* damping part of the compliance, N s or N m s per unit of velocity */
  float dry_friction;         /* impulse that stands for the dry friction of soft bodies across the joint, */
  float max_dry_friction;     /* and its maximum, N m s */
  float bound;                /* of a locked or limited coordinate */
  float end;                  /* target of a locked or limited coordinate at the substep's end */
  sbri_row_limit limit;
  float impulse;   /* l */
  float speed;     /* of the coordinate, from the velocities at the beginning of the step */
  float clearance; /* of an inactive limit: distance of the coordinate, rad; it has no rates yet; else 0 */
  sbri_row_change change; /* of a limit */
  int8_t sign;            /* of a limit: the only sign that its impulse may have */
  uint8_t kind, axis;     /* of sbri_row_kind and sbf_joint_axis */
  bool active;            /* part of the system */
  bool is_saturated;      /* of a drive: its impulse is the maximum, which the velocities contain already */
} sbri_row;

/* What a joint that holds a place and no turn has instead of rows for that; see ball_edge.h. */
typedef struct sbri_ball {
  int child;                    /* side of the body farther from the root */
  double levers[SBRI_SIDES][3]; /* m, from the bodies' centres of mass to the joint */
  double rhs[3];           /* m/s: velocity change of b's joint point relative to a's that is asked for */
  double attached_inertia; /* N m s per rad/s, about all axes, */
  double dry_friction, max_dry_friction; /* as sbri_row has them, */
  double
      attached_rhs[3]; /* rad/s, and the change of b's angular velocity relative to a's that they ask for */
  double impulse[3], moment[3]; /* N s and N m s, on body b, about the joint */
  sbf_vec3 end;                 /* m, along a's axes: separation of the two joint points at the step's end */
} sbri_ball;

/* A joint in the system. */
typedef struct sbri_edge {
  uint32_t joint;
  sbri_ball *ball;           /* NULL: all its constraints are rows */
  int32_t nodes[SBRI_SIDES]; /* -1: that side is not simulated */
  uint32_t row_count;
  sbri_row *rows;        /* (row_count) */
  uint32_t active_count; /* active rows; their indices in `actives` */
  uint16_t *actives;
  double *y;   /* (active_count x 6) L^-1 J^T of the child */
  double *g;   /* (active_count^2) Cholesky factor of J D^-1 J^T + G; a pivot's inverse on its diagonal */
  double *w;   /* (active_count x 6) of the parent */
  double *t;   /* (active_count) */
  double *rhs; /* (active_count) */
} sbri_edge;

/* A simulated body. */
typedef struct sbri_node {
  uint32_t body;
  int32_t parent, edge; /* -1: root; -1: no joint holds it to its parent or the world */
  double d[6][6];       /* lower half, then its factor, with the pivots' inverses on the diagonal */
  double b[6], x[6];
  double previous[6];               /* x of the previous iteration */
  double known_impulse[6];          /* impulses that are known already: of saturated drives */
  float inertia[3][3];              /* in space */
  float mass_factor;                /* sbri_rigid_mass_factor */
  const double (*attached_load)[6]; /* sbri_attached_load.mass; NULL: no mass is attached */
  float
      max_swing_square; /* maximum squared angular frequency of the swing by its joints' springs, (rad/s)^2 */
  float inverse_mass[2]; /* 1 / mass, and the mean of 1 / moment of inertia */
} sbri_node;

/* One or two ball joints of the tree that are eliminated together; neither is above the other. */
typedef struct sbri_ball_pair {
  sbri_edge *edges[2]; /* if there is only one, both entries are the same, here and below */
  sbri_node *children[2];
  sbri_node *parents[2]; /* NULL: the world */
  uint32_t count;
  /* Of the factor: levers of the child and of its parent, 1 where the child is body b and -1 where it is a,
   */
  sbri_twin own[3], other[3], sign;
  sbri_twin a[3][3], e[3][3], k[3][3], l[3][3], y[3][3], z[3][3];
  /* and of the solution: */
  sbri_twin wanted[3], shift[3], force[3], p[3];
} sbri_ball_pair;

/* A node, or a pair of balls with their children, in the order of elimination. */
typedef struct sbri_tree_step {
  sbri_node *node;
  sbri_ball_pair *pair; /* NULL: the node alone, on rows or on nothing */
} sbri_tree_step;

typedef struct sbri_rigid_system {
  sbri_tree_step *steps; /* (step_count) children before parents */
  uint32_t step_count;
  sbri_node *nodes; /* (node_count) each behind its parent */
  uint32_t node_count;
  sbri_edge *edges; /* (edge_count) of the joints that act */
  uint32_t edge_count;
  uint32_t *loops; /* (loop_count) edges that are no part of the tree */
  uint32_t loop_count;
  /* Rows of loops, in this substep: */
  uint32_t loop_row_count, loop_row_capacity;
  double *responses;   /* (loop_row_capacity + 2, x node_count x 6) change of every body by a unit impulse */
  double *loop_matrix; /* (loop_row_capacity^2) its Cholesky factor */
  double *loop_rhs;    /* (loop_row_count) */
} sbri_rigid_system;

/* What the nodes' x do to the row's rate. */
static inline double sbri_row_rate_change(
    const sbri_rigid_system *s, const sbri_edge *e, const sbri_row *row) {
  double sum = 0;
  for (int side = 0; side < SBRI_SIDES; side++)
    if (e->nodes[side] >= 0) sum += sbri_dot6_rates(row->rates[side], s->nodes[e->nodes[side]].x);
  return sum;
}

/* What a unit impulse of the row would change its rate by if nothing else held its bodies. */
double sbri_row_response(const sbri_rigid_system *system, const sbri_edge *edge, const sbri_row *row);

/* Factors the system of the rows that are active and the nodes' d, which it overwrites. */
void sbri_system_factor(sbri_rigid_system *system);

/* Solves for the nodes' x and adds to the active rows' impulses, from the nodes' b and the edges' rhs (of
 * active rows). Overwrites b. May be called again with other b and rhs. */
void sbri_system_solve(sbri_rigid_system *system);

/* Adds the result of the last solution to impulses and moments of the balls. */
void sbri_system_add_impulses(sbri_rigid_system *system);

/* Lists the active rows. */
void sbri_edge_list_active(sbri_edge *edge);

#endif
