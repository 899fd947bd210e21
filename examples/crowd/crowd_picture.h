/* Draws a crowd without a graphics card: triangles with a depth for each pixel, shadows on level ground,
 * haze. Each pixel is the mean of four. */
#ifndef CROWD_PICTURE_H
#define CROWD_PICTURE_H

#include <math.h>
#include <stdio.h>

#include "sbrun/detail.h"

enum { PICTURE_WIDTH = 960, PICTURE_HEIGHT = 540, PICTURE_FINE_WIDTH = 1920, PICTURE_FINE_HEIGHT = 1080 };

typedef struct crowd_picture {
  double eye[3], right[3], up[3], forward[3], pixels; /* unit vectors; fine pixels a metre, one metre off */
  float nearness[PICTURE_FINE_WIDTH * PICTURE_FINE_HEIGHT]; /* one over the depth; 0: nothing */
  unsigned char shadow[PICTURE_FINE_WIDTH * PICTURE_FINE_HEIGHT];
  float colour[PICTURE_FINE_WIDTH * PICTURE_FINE_HEIGHT][3];
} crowd_picture;

/* A corner of a triangle on the screen, in fine pixels. */
typedef struct crowd_corner {
  double x, y;
  float nearness, light;
} crowd_corner;

static const double CROWD_LIGHT[3] = {0.41, 0.82, -0.4}; /* towards it */

static inline float crowd_haze(double depth) {
  return (float)(1 - exp(-depth / 60));
}

/* What is there without anybody: sky, and a floor of tiles of three metres. */
static inline void crowd_empty(crowd_picture *p, const sbr_view *view) {
  double fx = (double)view->forward.x, fy = (double)view->forward.y, fz = (double)view->forward.z;
  double size = sqrt(fx * fx + fy * fy + fz * fz), flat = sqrt(fx * fx + fz * fz);
  double axes[4][3] = {{view->eye.x, view->eye.y, view->eye.z}, {fz / flat, 0, -fx / flat},
      {-fy * fx / (flat * size), flat / size, -fy * fz / (flat * size)}, {fx / size, fy / size, fz / size}};
  for (int k = 0; k < 3; k++) {
    p->eye[k] = axes[0][k], p->right[k] = axes[1][k], p->up[k] = axes[2][k], p->forward[k] = axes[3][k];
  }
  p->pixels = PICTURE_FINE_HEIGHT / 2 / tan((double)view->height_rad / 2);
  for (int y = 0; y < PICTURE_FINE_HEIGHT; y++)
    for (int x = 0; x < PICTURE_FINE_WIDTH; x++) {
      static const float sky[3] = {205, 213, 224}, floor_[3] = {226, 226, 222};
      int at = y * PICTURE_FINE_WIDTH + x;
      double ray[3];
      for (int k = 0; k < 3; k++)
        ray[k] = p->forward[k] + p->right[k] * (x + 0.5 - PICTURE_FINE_WIDTH / 2) / p->pixels +
                 p->up[k] * (PICTURE_FINE_HEIGHT / 2 - y - 0.5) / p->pixels;
      double depth = ray[1] < -1e-4 ? -p->eye[1] / ray[1] : 1e9, haze = (double)crowd_haze(depth), line = 0;
      if (haze < 0.98) { /* lines of a centimetre, as wide as a pixel where that is more */
        double wide = 0.01 + depth / p->pixels * (1 + depth / 8), tile = 3;
        double over = fabs(remainder(p->eye[0] + ray[0] * depth, tile)),
               along = fabs(remainder(p->eye[2] + ray[2] * depth, tile));
        line = (over < wide || along < 2 * wide) ? 0.1 * 0.01 / wide + 0.02 : 0;
      }
      p->nearness[at] = 0, p->shadow[at] = 0;
      for (int c = 0; c < 3; c++)
        p->colour[at][c] = (float)((double)floor_[c] * (1 - line) * (1 - haze) + (double)sky[c] * haze);
    }
}

/* False where it lies behind the eye. `normal` NULL: it has no light of its own. */
static inline bool crowd_corner_at(
    const crowd_picture *p, const double position[3], const sbf_vec3 *normal, crowd_corner *corner) {
  double along = 0, across = 0, over = 0;
  for (int k = 0; k < 3; k++) {
    double from = position[k] - p->eye[k];
    along += from * p->forward[k], across += from * p->right[k], over += from * p->up[k];
  }
  if (!(along > 0.1)) return false;
  corner->x = PICTURE_FINE_WIDTH / 2 + p->pixels * across / along;
  corner->y = PICTURE_FINE_HEIGHT / 2 - p->pixels * over / along;
  corner->nearness = (float)(1 / along);
  double facing = normal ? (double)normal->x * CROWD_LIGHT[0] + (double)normal->y * CROWD_LIGHT[1] +
                               (double)normal->z * CROWD_LIGHT[2]
                         : 0;
  corner->light = (float)(0.5 + (facing > 0 ? 0.55 * facing : 0.2 * facing));
  return true;
}

/* `colour` NULL: a shadow, which lies on the floor alone. */
static inline void crowd_triangle(crowd_picture *p, const crowd_corner c[3], const unsigned char *colour) {
  double area = (c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[2].x - c[0].x) * (c[1].y - c[0].y);
  double left = fmin(c[0].x, fmin(c[1].x, c[2].x)), right = fmax(c[0].x, fmax(c[1].x, c[2].x));
  double top = fmin(c[0].y, fmin(c[1].y, c[2].y)), bottom = fmax(c[0].y, fmax(c[1].y, c[2].y));
  if (area == 0 || !(right > 0 && bottom > 0 && left < PICTURE_FINE_WIDTH && top < PICTURE_FINE_HEIGHT))
    return;
  int x0 = left > 0 ? (int)left : 0, y0 = top > 0 ? (int)top : 0;
  for (int y = y0; y < PICTURE_FINE_HEIGHT && y < bottom; y++)
    for (int x = x0; x < PICTURE_FINE_WIDTH && x < right; x++) {
      double px = x + 0.5, py = y + 0.5, w[3];
      int at = y * PICTURE_FINE_WIDTH + x;
      bool inside = true;
      for (int k = 0; k < 3; k++) {
        const crowd_corner *a = &c[(k + 1) % 3], *b = &c[(k + 2) % 3];
        w[k] = ((b->x - a->x) * (py - a->y) - (b->y - a->y) * (px - a->x)) / area;
        inside = inside && w[k] >= 0;
      }
      if (!inside) continue;
      if (!colour) {
        p->shadow[at] = 1;
        continue;
      }
      double nearness = 0, light = 0;
      for (int k = 0; k < 3; k++)
        nearness += w[k] * (double)c[k].nearness, light += w[k] * (double)c[k].light;
      if (nearness <= (double)p->nearness[at]) continue;
      double haze = 0.8 * (double)crowd_haze(1 / nearness);
      p->nearness[at] = (float)nearness;
      for (int k = 0; k < 3; k++) p->colour[at][k] = (float)(colour[k] * light * (1 - haze) + 214 * haze);
    }
}

/* As PPM; false where the file cannot be written whole. */
static inline bool crowd_picture_write(const crowd_picture *p, const char *path) {
  static unsigned char row[3 * PICTURE_WIDTH];
  FILE *file = fopen(path, "wb");
  if (!file) return false;
  bool good = fprintf(file, "P6\n%d %d\n255\n", PICTURE_WIDTH, PICTURE_HEIGHT) > 0;
  for (int y = 0; y < PICTURE_HEIGHT; y++) {
    for (int x = 0; x < PICTURE_WIDTH; x++)
      for (int c = 0; c < 3; c++) {
        float sum = 0;
        for (int k = 0; k < 4; k++) {
          int at = (2 * y + k / 2) * PICTURE_FINE_WIDTH + 2 * x + k % 2;
          bool dark = p->shadow[at] && p->nearness[at] == 0;
          sum += p->colour[at][c] * (dark ? 0.72f : 1.0f);
        }
        row[3 * x + c] = (unsigned char)(sum / 4 > 255 ? 255 : sum / 4);
      }
    good = fwrite(row, sizeof row, 1, file) == 1 && good;
  }
  return fclose(file) == 0 && good;
}

#endif
