/* A crowd that walks before a camera, each character as finely as its size on the screen and a budget ask
 * for; says each second what that costs and by how many pixels it may be off, and draws frames, coloured by
 * level. Compiles as C and as C++. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "crowd_camera.h"
#include "crowd_picture.h"
#include "sbfmt/packed.h"
#include "sbrun/collision.h"

enum { MAX = 1000, RATE = 60, DRAWN_EVERY = 6 };

static int failed(const sbf_diagnostic *error) {
  fprintf(stderr, "%s: %s\n", error->file, error->message);
  return 1;
}

/* Red: at full detail; orange and yellow: coarser, and soft; green: jiggle; blue: bones; grey: away. */
static const unsigned char *colour_of(const sbr_detail_level *detail_levels, uint32_t detail_level) {
  static const unsigned char soft[3][3] = {{213, 70, 20}, {235, 160, 20}, {240, 228, 90}};
  static const unsigned char others[4][3] = {{0, 0, 0}, {0, 158, 115}, {30, 120, 190}, {150, 150, 150}};
  return detail_levels[detail_level].kind == SBR_DETAIL_SOFT ? soft[detail_level < 2 ? detail_level : 2]
                                                             : others[detail_levels[detail_level].kind];
}

typedef struct crowd {
  sbr_world *world;
  sbr_character_id ids[MAX];
  sbr_detail_level detail_levels[16];
  uint32_t count, mesh_count, capacity;
  const sbf_asset *asset;
  sbf_vec3 *skin, *normals;
  crowd_picture picture;
} crowd;

/* The skin of one mesh, and its shadow; a polygon is a fan of triangles. */
static void draw_mesh(
    crowd *c, const sbf_polygon_mesh *mesh, const sbr_double3 *origin, const unsigned char *colour) {
  const uint32_t *point = mesh->polygon_points.at;
  for (uint32_t i = 0; i < mesh->polygon_sizes.count; point += mesh->polygon_sizes.at[i++])
    for (uint32_t k = 2; k < mesh->polygon_sizes.at[i]; k++) {
      const uint32_t points[3] = {point[0], point[k - 1], point[k]};
      crowd_corner seen[3], thrown[3];
      bool before = true, lit = true;
      for (int j = 0; j < 3; j++) {
        sbf_vec3 at = c->skin[points[j]];
        double position[3] = {origin->x + (double)at.x, origin->y + (double)at.y, origin->z + (double)at.z};
        double down = position[1] / CROWD_LIGHT[1];
        double floor_[3] = {position[0] - down * CROWD_LIGHT[0], 0, position[2] - down * CROWD_LIGHT[2]};
        before = crowd_corner_at(&c->picture, position, &c->normals[points[j]], &seen[j]) && before;
        lit = crowd_corner_at(&c->picture, floor_, NULL, &thrown[j]) && lit;
      }
      if (lit) crowd_triangle(&c->picture, thrown, NULL);
      if (before) crowd_triangle(&c->picture, seen, colour);
    }
}

static bool draw(crowd *c, const sbr_view *view, const char *folder, int number) {
  char path[1024];
  crowd_empty(&c->picture, view);
  for (uint32_t i = 0; i < c->count; i++) {
    sbr_double3 origin = sbr_character_get_origin(c->world, c->ids[i]);
    const unsigned char *colour =
        colour_of(c->detail_levels, sbr_character_get_detail_level(c->world, c->ids[i]));
    for (uint32_t m = 0; m < c->mesh_count; m++) {
      sbr_character_get_skin(c->world, c->ids[i], m, c->skin, c->normals, NULL, c->capacity);
      draw_mesh(c, &c->asset->render_meshes.at[m].mesh, &origin, colour);
    }
  }
  snprintf(path, sizeof path, "%s/frame%04d.ppm", folder, number);
  if (crowd_picture_write(&c->picture, path)) return true;
  return fprintf(stderr, "%s: this frame cannot be written: is the folder there?\n", path), false;
}

static void report(const crowd *c, int second, double ms, double visits) {
  uint32_t on[4] = {0, 0, 0, 0}, coarser = 0;
  double max = 0, sum = 0;
  for (uint32_t i = 0; i < c->count; i++) {
    double off = (double)sbr_character_get_error_px(c->world, c->ids[i]);
    uint32_t detail_level = sbr_character_get_detail_level(c->world, c->ids[i]);
    on[c->detail_levels[detail_level].kind]++;
    coarser += c->detail_levels[detail_level].kind == SBR_DETAIL_SOFT && detail_level > 0;
    max = off > max ? off : max, sum += off;
  }
  fprintf(stderr, "%d s: %.2f ms a tick\n", second, ms); /* apart: what follows is the same on any machine */
  printf("%d s: %.0f visits a tick; %u soft (%u coarsely), %u jiggle, %u bones, %u away; predicted off by "
         "%.3f pixels at "
         "most, %.3f on average\n",
      second, visits, (unsigned)on[0], (unsigned)coarser, (unsigned)on[1], (unsigned)on[2], (unsigned)on[3],
      max, sum / c->count);
}

/* What the command line asks for. */
typedef struct wishes {
  const char *file, *folder; /* no folder: nothing is drawn */
  int seconds;
  float budget_us;
  bool close;
} wishes;

static bool read_wishes(int argc, char **argv, wishes *w, uint32_t *count) {
  w->file = argv[1];
  *count = argc > 2 ? (uint32_t)atoi(argv[2]) : 200;
  w->seconds = argc > 3 ? atoi(argv[3]) : 3;
  w->budget_us = argc > 4 ? (float)atof(argv[4]) : 4000;
  w->folder = argc > 5 && strcmp(argv[5], "-") != 0 ? argv[5] : NULL;
  w->close = argc == 7 && strcmp(argv[6], "close") == 0;
  return argc >= 2 && argc <= 7 && (argc < 7 || w->close) && *count >= 1 && *count <= MAX && w->seconds >= 1;
}

/* A world that chooses levels, and its crowd. */
static sbf_status fill_world(crowd *c, const sbr_model *model, const wishes *w, sbf_diagnostic *error) {
  uint32_t detail_levels = sbr_model_get_detail_levels(model, c->detail_levels, 16);
  sbr_world_definition definition = sbr_default_world_definition();
  definition.character_capacity = c->count;
  sbf_status status = sbr_world_create(&definition, &c->world, error);
  if (status != SBF_OK) return status;
  sbr_detail_definition detail = sbr_default_detail_definition();
  detail.budget_us = w->budget_us;
  status = sbr_world_select_detail_levels(c->world, &detail, error);
  if (status == SBF_OK && w->close) status = sbr_world_enable_body_contacts(c->world, 0, error);
  for (uint32_t i = 0; i < c->count && status == SBF_OK; i++) {
    sbr_character_definition at = w->close ? crowd_arrange_close(i) : crowd_arrange(i);
    at.detail_level = detail_levels > 1
                          ? detail_levels - 2
                          : 0; /* bones: memory and time are for those who turn out to be near */
    status = sbr_character_create(c->world, model, &at, &c->ids[i], error);
    if (status == SBF_OK) crowd_drive(c->world, c->ids[i], i);
  }
  return status;
}

static bool reserve_skins(crowd *c, const sbf_asset *asset) {
  c->asset = asset;
  c->mesh_count = asset->render_meshes.count;
  for (uint32_t m = 0; m < c->mesh_count; m++)
    if (asset->render_meshes.at[m].mesh.positions.count > c->capacity)
      c->capacity = asset->render_meshes.at[m].mesh.positions.count;
  c->skin = (sbf_vec3 *)calloc(c->capacity + 1, sizeof *c->skin);
  c->normals = (sbf_vec3 *)calloc(c->capacity + 1, sizeof *c->normals);
  return c->skin && c->normals;
}

static bool walk(crowd *c, const wishes *w) {
  double taken = 0, visits = 0;
  for (int tick = 1; tick <= w->seconds * RATE; tick++) {
    sbr_view view = crowd_view(tick, w->seconds * RATE);
    clock_t begin = clock();
    sbr_world_set_views(c->world, &view, 1); /* an engine's camera */
    sbr_world_step(c->world, 1.0 / RATE);
    taken += 1e3 * (double)(clock() - begin) / CLOCKS_PER_SEC;
    visits += sbr_world_get_element_visits(c->world);
    if (w->folder && tick % DRAWN_EVERY == 0 && !draw(c, &view, w->folder, tick / DRAWN_EVERY)) return false;
    if (tick % RATE) continue;
    report(c, tick / RATE, taken / RATE, visits / RATE);
    taken = visits = 0;
  }
  return true;
}

int main(int argc, char **argv) {
  static crowd c;
  wishes w;
  sbf_diagnostic error;
  sbf_asset *asset;
  sbr_model *model;
  sbr_model_options options;
  if (!read_wishes(argc, argv, &w, &c.count))
    return fprintf(
               stderr, "usage: %s FILE.sbfz [LIZARDS [SECONDS [BUDGET_US [FOLDER|- [close]]]]]\n", argv[0]),
           2;
  options = sbr_default_model_options();
  options.detail_levels = true;
  if (sbf_packed_load_file(w.file, NULL, &asset, &error) != SBF_OK ||
      sbr_model_create(asset, &options, &model, &error) != SBF_OK ||
      fill_world(&c, model, &w, &error) != SBF_OK)
    return failed(&error);
  if (!reserve_skins(&c, asset) || !walk(&c, &w)) return 2;
  printf("state %016llx\n", (unsigned long long)sbr_world_get_state_hash(c.world));

  free(c.skin), free(c.normals);
  sbr_world_destroy(c.world);
  sbr_model_destroy(model);
  sbf_asset_free(asset);
  return 0;
}
