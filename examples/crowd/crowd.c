/* A crowd that walks before a camera, each character as finely as its size on the screen and a budget ask
 * for; says each second what that costs and by how many pixels it may be off, and draws frames, coloured by
 * level. Compiles as C and as C++. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "crowd_camera.h"
#include "sbfmt/packed.h"

enum { MOST = 1000, WIDTH = 640, HEIGHT = 360, RATE = 60, DRAWN_EVERY = 6 };

static int failed(const sbf_diagnostic *error) {
  fprintf(stderr, "%s: %s\n", error->file, error->message);
  return 1;
}

/* A point of the skin: what is nearer hides what is farther. Soft red, jiggle orange, bones blue, away grey.
 */
static void draw_point(
    unsigned char *pixels, float *depths, double right, double up, float depth, sbr_rung_kind kind) {
  static const unsigned char colours[4][3] = {{214, 64, 48}, {240, 150, 30}, {60, 120, 190}, {150, 150, 150}};
  int size = depth < 6 ? 2 : 1, x0 = (int)(WIDTH / 2 + right), y0 = (int)(HEIGHT / 2 - up);
  float light = depth < 30 ? 1 - depth / 60 : 0.5f;
  for (int y = y0; y < y0 + size; y++)
    for (int x = x0; x < x0 + size; x++) {
      if (x < 0 || y < 0 || x >= WIDTH || y >= HEIGHT || depths[y * WIDTH + x] < depth) continue;
      depths[y * WIDTH + x] = depth;
      for (int c = 0; c < 3; c++)
        pixels[3 * (y * WIDTH + x) + c] =
            (unsigned char)((float)colours[kind][c] * light + 235 * (1 - light));
    }
}

typedef struct crowd {
  sbr_world *world;
  sbr_character_id ids[MOST];
  sbr_rung rungs[16];
  uint32_t count, mesh_count, capacity;
  sbf_vec3 *skin;
  unsigned char pixels[3 * WIDTH * HEIGHT];
  float depths[WIDTH * HEIGHT];
} crowd;

static bool draw(crowd *c, const sbr_view *seen, const char *folder, int number) {
  char path[1024];
  sbr_view view = *seen;
  view.lines = HEIGHT; /* what the runtime was told is a larger screen */
  memset(c->pixels, 235, sizeof c->pixels);
  for (int i = 0; i < WIDTH * HEIGHT; i++) c->depths[i] = 1e9f;
  for (uint32_t i = 0; i < c->count; i++) {
    sbr_rung_kind kind = c->rungs[sbr_character_rung(c->world, c->ids[i])].kind;
    sbr_double3 origin = sbr_character_origin(c->world, c->ids[i]);
    for (uint32_t m = 0; m < c->mesh_count; m++) {
      uint32_t points = sbr_character_skin(c->world, c->ids[i], m, c->skin, NULL, NULL, c->capacity);
      for (uint32_t v = 0; v < points && v < c->capacity; v++) {
        double x = origin.x + (double)c->skin[v].x, y = origin.y + (double)c->skin[v].y;
        double z = origin.z + (double)c->skin[v].z, right, up;
        if (!crowd_project(&view, x, y, z, &right, &up)) continue;
        x -= view.eye.x, y -= view.eye.y, z -= view.eye.z;
        draw_point(c->pixels, c->depths, right, up, (float)sqrt(x * x + y * y + z * z), kind);
      }
    }
  }
  snprintf(path, sizeof path, "%s/frame%04d.ppm", folder, number);
  FILE *file = fopen(path, "wb");
  if (!file) return fprintf(stderr, "%s: this frame cannot be written: is the folder there?\n", path), false;
  fprintf(file, "P6\n%d %d\n255\n", WIDTH, HEIGHT);
  bool good = fwrite(c->pixels, sizeof c->pixels, 1, file) == 1;
  return fclose(file) == 0 && good;
}

static void tell(const crowd *c, int second, double ms, double visits) {
  uint32_t on[4] = {0, 0, 0, 0};
  double most = 0, sum = 0;
  for (uint32_t i = 0; i < c->count; i++) {
    double off = (double)sbr_character_error_px(c->world, c->ids[i]);
    on[c->rungs[sbr_character_rung(c->world, c->ids[i])].kind]++;
    most = off > most ? off : most, sum += off;
  }
  fprintf(stderr, "%d s: %.2f ms a tick\n", second, ms); /* apart: what follows is the same on any machine */
  printf("%d s: %.0f visits a tick; %u soft, %u jiggle, %u bones, %u away; predicted off by %.3f pixels at "
         "most, %.3f on average\n",
      second, visits, (unsigned)on[0], (unsigned)on[1], (unsigned)on[2], (unsigned)on[3], most,
      sum / c->count);
}

int main(int argc, char **argv) {
  static crowd c;
  sbf_diagnostic error;
  sbf_asset *asset;
  sbr_model *model;
  int seconds = argc > 3 ? atoi(argv[3]) : 3;
  const char *folder = argc > 5 ? argv[5] : NULL;
  c.count = argc > 2 ? (uint32_t)atoi(argv[2]) : 200;
  if (argc < 2 || argc > 6 || c.count < 1 || c.count > MOST || seconds < 1)
    return fprintf(stderr, "usage: %s FILE.sbfz [LIZARDS [SECONDS [BUDGET_US [FOLDER]]]]\n", argv[0]), 2;

  if (sbf_packed_load_file(argv[1], NULL, &asset, &error) != SBF_OK) return failed(&error);
  sbr_model_options options;
  memset(&options, 0, sizeof options);
  options.ladder = true;
  if (sbr_model_create(asset, &options, &model, &error) != SBF_OK) return failed(&error);
  uint32_t rungs = sbr_model_rungs(model, c.rungs, 16);
  sbr_world_definition definition = sbr_default_world_definition();
  definition.character_capacity = c.count;
  if (sbr_world_create(&definition, &c.world, &error) != SBF_OK) return failed(&error);
  sbr_detail_definition detail = sbr_default_detail_definition();
  detail.budget_us = argc > 4 ? (float)atof(argv[4]) : 4000;
  if (sbr_world_detail(c.world, &detail, &error) != SBF_OK) return failed(&error);
  for (uint32_t i = 0; i < c.count; i++) {
    sbr_character_definition at = crowd_place(i);
    at.rung = rungs > 1 ? rungs - 2 : 0; /* bones: memory and time are for those who turn out to be near */
    if (sbr_character_create(c.world, model, &at, &c.ids[i], &error) != SBF_OK) return failed(&error);
    crowd_drive(c.world, c.ids[i], i);
  }
  c.mesh_count = asset->render_meshes.count;
  for (uint32_t m = 0; m < c.mesh_count; m++)
    if (asset->render_meshes.at[m].mesh.positions.count > c.capacity)
      c.capacity = asset->render_meshes.at[m].mesh.positions.count;
  c.skin = (sbf_vec3 *)calloc(c.capacity + 1, sizeof *c.skin);
  if (!c.skin) return 2;

  double taken = 0, visits = 0;
  for (int tick = 1; tick <= seconds * RATE; tick++) {
    sbr_view view = crowd_view(tick, seconds * RATE);
    clock_t begin = clock();
    sbr_world_views(c.world, &view, 1); /* an engine's camera */
    sbr_world_step(c.world, 1.0 / RATE);
    taken += 1e3 * (double)(clock() - begin) / CLOCKS_PER_SEC;
    visits += sbr_world_visits(c.world);
    if (folder && tick % DRAWN_EVERY == 0 && !draw(&c, &view, folder, tick / DRAWN_EVERY)) return 2;
    if (tick % RATE) continue;
    tell(&c, tick / RATE, taken / RATE, visits / RATE);
    taken = visits = 0;
  }
  printf("state %016llx\n", (unsigned long long)sbr_world_state_hash(c.world));

  free(c.skin);
  sbr_world_destroy(c.world);
  sbr_model_destroy(model);
  sbf_asset_free(asset);
  return 0;
}
