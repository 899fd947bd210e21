/* Makes the table of kernels named SBRI_KERNELS, for the instruction set that the including file is compiled
 * for. */
#include "model/kernels.h"
#include "skin/skin_lanes.h"
#include "soft/solvers/block_descent.h"
#include "soft/solvers/explicit_euler.h"
#include "soft/solvers/heun.h"
#include "soft/solvers/position_based.h"
#include "soft/solvers/symplectic.h"

static void vertices(const sbri_skin *skin, const sbri_point *points, sbri_point *to) {
  sbri_lanes_compute_vertices(skin, points, to);
}
static void faces(const sbri_skin *skin, const sbri_point *from, sbri_point *to) {
  sbri_lanes_compute_faces(skin, from, to);
}
static void tangents(const sbri_skin *skin, const sbri_point *from, sbri_point *to) {
  sbri_lanes_compute_tangents(skin, from, to);
}
static void sums(const sbri_sum_table *table, const sbri_point *from, sbri_point *to) {
  sbri_lanes_compute_sums(table, from, to);
}
static void normals(const sbri_sum_table *table, const sbri_point *from, sbri_point *to) {
  sbri_lanes_compute_normals(table, from, to);
}
static void run_symplectic(const sbri_island_tick *tick) {
  sbri_lanes_symplectic_tick(tick);
}
static void run_explicit_euler(const sbri_island_tick *tick) {
  sbri_lanes_explicit_euler_tick(tick);
}
static void run_heun(const sbri_island_tick *tick) {
  sbri_lanes_heun_tick(tick);
}
static void run_position_based(const sbri_island_tick *tick) {
  sbri_lanes_position_based_tick(tick);
}
static void run_block_descent(const sbri_island_tick *tick) {
  sbri_lanes_block_descent_tick(tick);
}

#if SBRI_LANES == 1
#define SBRI_INSTRUCTIONS SBR_INSTRUCTIONS_SCALAR
#elif defined(__AVX512VL__)
#define SBRI_INSTRUCTIONS SBR_INSTRUCTIONS_AVX512
#elif defined(__AVX2__)
#define SBRI_INSTRUCTIONS SBR_INSTRUCTIONS_AVX2
#elif defined(__SSE2__)
#define SBRI_INSTRUCTIONS SBR_INSTRUCTIONS_SSE2
#elif defined(__wasm_simd128__)
#define SBRI_INSTRUCTIONS SBR_INSTRUCTIONS_WASM_SIMD128
#else
#define SBRI_INSTRUCTIONS SBR_INSTRUCTIONS_NEON
#endif

const sbri_kernels SBRI_KERNELS = {SBRI_INSTRUCTIONS, SBRI_LANES, vertices, faces, tangents, sums, normals,
    run_symplectic, run_explicit_euler, run_heun, run_position_based, run_block_descent};
