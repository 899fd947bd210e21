/* Built-in grounds, in double precision, with no library function except the square root. */
#include "shapes/ground.h"

#include <math.h>

#include "math/trig.h"

static const sbf_vec3 up = {0, 1, 0};

static double clamped(double value, double low, double high) {
  return value < low ? low : value > high ? high : value;
}

/* Largest integer at or below x, which is limited to +-1e12. */
static int64_t floor_of(double x) {
  x = clamped(x, -1e12, 1e12);
  int64_t whole = (int64_t)x;
  return (double)whole > x ? whole - 1 : whole;
}

/* Unit normal of a surface with the slopes dy/dx and dy/dz. */
static sbf_vec3 normal_of(double slope_x, double slope_z) {
  double s = 1 / sqrt(1 + slope_x * slope_x + slope_z * slope_z);
  return (sbf_vec3){(float)(-slope_x * s), (float)s, (float)(-slope_z * s)};
}

static double flat(const sbr_ground *ground, double x, double z, sbf_vec3 *normal) {
  (void)x, (void)z;
  *normal = up;
  return ground->parameters[0];
}

static double slope(const sbr_ground *ground, double x, double z, sbf_vec3 *normal) {
  (void)x;
  double rise = ground->parameters[0];
  *normal = z > 0 ? normal_of(0, rise) : up;
  return z > 0 ? rise * z : 0;
}

static double stairs(const sbr_ground *ground, double x, double z, sbf_vec3 *normal) {
  (void)x;
  const double *rise_run = ground->parameters;
  *normal = up;
  return z > 0 && rise_run[1] > 0 ? rise_run[0] * (double)floor_of(z / rise_run[1]) : 0;
}

/* ---- Noise: gradients at the corners of squares of 1 m, blended (Perlin, Improving Noise, 2002) ---- */

typedef struct gradient {
  double x, z; /* each in -1..1 */
} gradient;

static gradient gradient_at(int64_t x, int64_t z, uint32_t seed) {
  uint32_t h = (uint32_t)(uint64_t)x * 0x8da6b343u ^ (uint32_t)(uint64_t)z * 0xd8163841u ^ seed * 0xcb1ab31fu;
  h ^= h >> 15, h *= 0x2c1b3c6du, h ^= h >> 12, h *= 0x297a2d39u, h ^= h >> 15;
  return (gradient){(h & 0xffff) / 32767.5 - 1, (h >> 16) / 32767.5 - 1};
}

/* Quintic blend and its derivative. */
static double blend(double t, double *rate) {
  *rate = 30 * t * t * (t - 1) * (t - 1);
  return t * t * t * (t * (6 * t - 15) + 10);
}

/* Between -1 and 1. */
static double noise_at(double x, double z, uint32_t seed, double *slope_x, double *slope_z) {
  int64_t ix = floor_of(x), iz = floor_of(z);
  double u = clamped(x - (double)ix, 0, 1), v = clamped(z - (double)iz, 0, 1), du, dv;
  double a = blend(u, &du), b = blend(v, &dv), value[2][2], sum = 0;
  double weights[2][2] = {{(1 - a) * (1 - b), (1 - a) * b}, {a * (1 - b), a * b}};
  *slope_x = *slope_z = 0;
  for (int i = 0; i < 2; i++)
    for (int k = 0; k < 2; k++) {
      gradient g = gradient_at(ix + i, iz + k, seed);
      value[i][k] = g.x * (u - i) + g.z * (v - k);
      sum += weights[i][k] * value[i][k];
      *slope_x += weights[i][k] * g.x;
      *slope_z += weights[i][k] * g.z;
    }
  *slope_x += du * ((1 - b) * (value[1][0] - value[0][0]) + b * (value[1][1] - value[0][1]));
  *slope_z += dv * ((1 - a) * (value[0][1] - value[0][0]) + a * (value[1][1] - value[1][0]));
  return sum;
}

static double noise(const sbr_ground *ground, double x, double z, sbf_vec3 *normal) {
  const double *parameters = ground->parameters;
  const double flat_radius = 0.5;
  double slope_x, slope_z, half = 0.5 * parameters[0];
  double y = noise_at(x, z, (uint32_t)parameters[1], &slope_x, &slope_z);
  double r = sqrt(x * x + z * z);
  if (r < flat_radius) {
    double rate, fraction = blend(r / flat_radius, &rate);
    double towards = r > 0 ? rate / (flat_radius * r) * y : 0;
    slope_x = slope_x * fraction + towards * x;
    slope_z = slope_z * fraction + towards * z;
    y *= fraction;
  }
  *normal = normal_of(half * slope_x, half * slope_z);
  return half * y;
}

static sbr_ground built_in(
    double (*height)(const sbr_ground *, double, double, sbf_vec3 *), double first, double second) {
  return (sbr_ground){height, NULL, {first, second, 0, 0}};
}

sbr_ground sbr_ground_flat(double height_m) {
  return built_in(flat, height_m, 0);
}

sbr_ground sbr_ground_slope(double degrees) {
  float sine, cosine;
  sbri_sincos((float)(clamped(degrees, -45, 45) * (3.14159265358979323846 / 180)), &sine, &cosine);
  return built_in(slope, (double)sine / cosine, 0);
}

sbr_ground sbr_ground_stairs(double rise_m, double run_m) {
  return built_in(stairs, rise_m, run_m);
}

sbr_ground sbr_ground_noise(double height_m, uint32_t seed) {
  return built_in(noise, height_m, seed);
}

double sbri_ground_height(const sbr_ground *ground, double x, double z, sbf_vec3 *normal) {
  sbf_vec3 unused;
  return ground->height(ground, x, z, normal ? normal : &unused);
}

bool sbri_ground_is_fixed(const sbr_ground *ground) {
  return ground->height == flat || ground->height == slope || ground->height == stairs ||
         ground->height == noise;
}

bool sbri_ground_is_flat(const sbr_ground *ground, double *height) {
  *height = ground->parameters[0];
  return ground->height == flat;
}

bool sbri_ground_is_stairs(const sbr_ground *ground, double *rise, double *run) {
  *rise = ground->parameters[0], *run = ground->parameters[1];
  return ground->height == stairs && *run > 0 && *rise != 0;
}
