#include "skinned_limb.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static void *allocate(sbf_asset *asset, size_t count, size_t size) {
  void *memory = sbf_asset_allocate(asset, count ? count : 1, size);
  if (!memory) abort();
  return memory;
}

static void add_bones(sbf_asset *asset, uint32_t count) {
  sbf_bone *bones = allocate(asset, count, sizeof *bones);
  for (uint32_t i = 0; i < count; i++) {
    char id[16];
    snprintf(id, sizeof id, "b%u", (unsigned)i);
    sbf_bone_init(&bones[i]);
    bones[i].id = bones[i].name = sbf_asset_copy_text(asset, id);
    if (!bones[i].id) abort();
    bones[i].parent = (int32_t)i - 1;
    bones[i].head.y = (float)i;
    bones[i].length = 1;
  }
  asset->bones = (sbf_bone_list){bones, count};
}

/* Two bones for every vertex: the one it lies along and the nearer neighbour. */
static void weigh(const skinned_limb *of, float y, uint32_t *bones, float *weights) {
  uint32_t below = y <= 0.5f ? 0 : (uint32_t)fminf(y - 0.5f, (float)of->bones - 2);
  float joint = (float)below + 1;
  float upper = of->slope > 0 ? 0.5f + (y - joint) / of->slope : y > joint ? 1 : 0;
  upper = fmaxf(0, fminf(1, upper));
  bones[0] = below, bones[1] = below + 1;
  weights[0] = 1 - upper, weights[1] = upper;
}

sbf_asset *skinned_limb_make(const skinned_limb *of) {
  sbf_asset *asset = sbf_asset_create(NULL);
  if (!asset) abort();
  add_bones(asset, of->bones);
  uint32_t columns = of->sides + of->seam, rings = of->bones * of->rings_a_bone + 1;
  uint32_t vertices = columns * rings, quads = of->sides * (rings - 1), caps = of->open ? 0 : 2, next = 0;
  sbf_vec3 *at = allocate(asset, vertices, sizeof *at);
  uint32_t *counts = allocate(asset, vertices, sizeof *counts);
  uint32_t *bones = allocate(asset, 2 * (size_t)vertices, sizeof *bones);
  float *weights = allocate(asset, 2 * (size_t)vertices, sizeof *weights);
  uint32_t *sizes = allocate(asset, quads + caps, sizeof *sizes);
  uint32_t *corners = allocate(asset, 4 * (size_t)quads + 2 * (size_t)of->sides, sizeof *corners);
  for (uint32_t r = 0; r < rings; r++)
    for (uint32_t c = 0; c < columns; c++) {
      double angle = 6.283185307179586 * (c % of->sides) / of->sides;
      uint32_t v = r * columns + c;
      float y = (float)r / (float)of->rings_a_bone;
      at[v] = (sbf_vec3){of->radius * (float)sin(angle), y, of->radius * (float)cos(angle)};
      counts[v] = 2;
      weigh(of, y + (c % 2 ? of->rag : -of->rag), &bones[2 * v], &weights[2 * v]);
    }
  for (uint32_t r = 0; r + 1 < rings; r++)
    for (uint32_t c = 0; c < of->sides; c++) {
      uint32_t right = of->seam ? c + 1 : (c + 1) % of->sides;
      corners[next++] = r * columns + c;
      corners[next++] = r * columns + right;
      corners[next++] = (r + 1) * columns + right;
      corners[next++] = (r + 1) * columns + c;
      sizes[r * of->sides + c] = 4;
    }
  for (uint32_t end = 0; end < caps; end++) {
    for (uint32_t c = 0; c < of->sides; c++)
      corners[next++] = end ? (rings - 1) * columns + c : of->sides - 1 - c;
    sizes[quads + end] = of->sides;
  }
  sbf_render_mesh *mesh = allocate(asset, 1, sizeof *mesh);
  sbf_skin *skin = allocate(asset, 1, sizeof *skin);
  sbf_render_mesh_init(mesh);
  sbf_skin_init(skin);
  mesh->id = mesh->name = "skin";
  mesh->mesh.positions = (sbf_vec3_list){at, vertices};
  mesh->mesh.polygon_sizes = (sbf_u32_list){sizes, quads + caps};
  mesh->mesh.polygon_points = (sbf_u32_list){corners, next};
  *skin = (sbf_skin){{counts, vertices}, {bones, 2 * vertices}, {weights, 2 * vertices}};
  mesh->skin = skin;
  asset->render_meshes = (sbf_render_mesh_list){mesh, 1};
  return asset;
}
