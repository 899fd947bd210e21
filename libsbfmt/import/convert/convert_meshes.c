/* Converts the scene's meshes to soft bodies and render meshes. A mesh without a skin becomes a section (or,
 * without a rig, a body): its points and polygons become the body's surface, in source order. It is also
 * drawn unless a skin hides it completely. */
#include <math.h>
#include <string.h>

#include "build/geometry/topology.h"
#include "import/convert/attach_objects.h"
#include "import/convert/convert_colors.h"
#include "import/convert/convert_pins.h"
#include "import/convert/covered_sections.h"
#include "import/physics/physics.h"
#include "mechanics/extent.h"
#include "mechanics/flat_body.h"
#include "mechanics/polygon.h"
#include "sbfmt/mechanics.h"

typedef struct geometry {
  sbf_polygon_mesh mesh;
  uint32_t *corner_order; /* (corner_count) scene corner of each corner; differs if polygons were flipped */
  sbfi_matrix to_asset;
  bool is_reversed; /* its polygons were flipped because it was inside out */
  bool is_flat;     /* none of its polygons has an area */
} geometry;

/* Rest positions of a skinned mesh: the sum of weight * joint * bind, as at run time. A point without weights
 * keeps its bind position. */
static sbf_status position_skinned(
    sbfi_conversion *c, const sbfi_scene_mesh *mesh, const sbfi_matrix *unskinned, sbf_vec3 *positions) {
  sbfi_matrix *joints = sbfi_arena_allocate(&c->scratch, mesh->skin.joint_count, sizeof *joints);
  if (!joints) return sbfi_convert_no_memory(c);
  for (uint32_t j = 0; j < mesh->skin.joint_count; j++) {
    sbfi_matrix world =
        sbfi_matrix_multiply(&c->scene->nodes[mesh->skin.joints[j].node].world, &mesh->skin.joints[j].bind);
    joints[j] = sbfi_matrix_multiply(&c->to_asset, &world);
  }
  for (uint32_t i = 0; i < mesh->point_count; i++) {
    double sum[3] = {0, 0, 0}, total = 0;
    for (uint32_t s = mesh->skin.starts[i]; s < mesh->skin.starts[i + 1]; s++) {
      const sbfi_matrix *m = &joints[mesh->skin.joint_index[s]];
      const sbf_vec3 p = mesh->points[i];
      double w = (double)mesh->skin.weights[s];
      for (int r = 0; r < 3; r++)
        sum[r] += w * (m->at[r][0] * (double)p.x + m->at[r][1] * (double)p.y + m->at[r][2] * (double)p.z +
                          m->at[r][3]);
      total += w;
    }
    positions[i] = total > 0
                       ? (sbf_vec3){(float)(sum[0] / total), (float)(sum[1] / total), (float)(sum[2] / total)}
                       : sbfi_transform_point(unskinned, mesh->points[i]);
  }
  return SBF_OK;
}

/* Minimum volume as a fraction of area^1.5; below it the surface is the two sides of a sheet. A sphere has
 * 0.094. */
static const double MIN_VOLUME = 1e-3;

/* Whether a surface is inside out: closed, consistently oriented and inward facing. */
static sbf_status find_inside_out(sbfi_conversion *c, const sbf_polygon_mesh *mesh, bool *inside_out) {
  sbfi_arena scratch;
  sbfi_topology t;
  sbf_surface_measures measures;
  sbfi_arena_init(&scratch, &c->scratch.allocator, 0);
  bool good = sbfi_topology_build(&t, mesh, &scratch);
  *inside_out =
      good && t.edge_count && !t.boundary_edge_count && !t.nonmanifold_edge_count && !t.clashing_edge_count;
  sbfi_arena_free(&scratch);
  if (!good) return sbfi_convert_no_memory(c);
  if (!*inside_out) return SBF_OK;
  sbf_surface_measure(mesh, NULL, &measures);
  *inside_out = measures.volume < -MIN_VOLUME * pow(measures.area, 1.5);
  return SBF_OK;
}

static void write_polygons(const sbfi_scene_mesh *mesh, bool is_reversed, uint32_t *sizes, uint32_t *points,
    uint32_t *corner_order) {
  for (uint32_t p = 0; p < mesh->polygon_count; p++) {
    uint32_t start = mesh->polygon_starts[p], size = mesh->polygon_starts[p + 1] - start;
    sizes[p] = size;
    for (uint32_t k = 0; k < size; k++) {
      uint32_t from = start + (is_reversed ? (size - k) % size : k);
      corner_order[start + k] = from;
      points[start + k] = mesh->corner_points[from];
    }
  }
}

/* Minimum area as a fraction of the squared extent; below it the points are collinear up to rounding. */
static const double MIN_AREA = 1e-7;

/* Whether all polygons are degenerate: nothing to draw and no mass. */
static bool has_no_area(const sbf_polygon_mesh *mesh) {
  sbf_surface_measures measures;
  sbf_surface_measure(mesh, NULL, &measures);
  return mesh->polygon_sizes.count && measures.area <= MIN_AREA * pow(sbfi_extent(mesh->positions), 2);
}

/* Transforms points and polygons to asset space, counter-clockwise from outside. Flips polygons under a
 * mirroring transform and on inside-out closed surfaces. */
static sbf_status convert_geometry(sbfi_conversion *c, const sbfi_scene_mesh *mesh, geometry *g) {
  sbf_vec3 *positions = sbfi_convert_allocate(c, mesh->point_count, sizeof *positions);
  uint32_t *sizes = sbfi_convert_allocate(c, mesh->polygon_count, sizeof *sizes);
  uint32_t *points = sbfi_convert_allocate(c, mesh->corner_count, sizeof *points);
  g->corner_order = sbfi_arena_allocate(&c->scratch, mesh->corner_count, sizeof *g->corner_order);
  if ((mesh->point_count && !positions) || (mesh->corner_count && (!sizes || !points || !g->corner_order)))
    return sbfi_convert_no_memory(c);
  sbfi_matrix transform = sbfi_scene_mesh_world(c->scene, mesh);
  g->to_asset = sbfi_matrix_multiply(&c->to_asset, &transform);
  for (uint32_t i = 0; i < mesh->point_count; i++)
    positions[i] = sbfi_transform_point(&g->to_asset, mesh->points[i]);
  sbf_status status = mesh->skin.joint_count ? position_skinned(c, mesh, &g->to_asset, positions) : SBF_OK;
  bool mirrored = sbfi_matrix_determinant(&g->to_asset) < 0;
  write_polygons(mesh, mirrored, sizes, points, g->corner_order);
  sbf_polygon_mesh_init(&g->mesh);
  g->mesh.positions = (sbf_vec3_list){positions, mesh->point_count};
  g->mesh.polygon_sizes = (sbf_u32_list){sizes, mesh->polygon_count};
  g->mesh.polygon_points = (sbf_u32_list){points, mesh->corner_count};
  if (status == SBF_OK) status = find_inside_out(c, &g->mesh, &g->is_reversed);
  g->is_flat = has_no_area(&g->mesh);
  if (status != SBF_OK || !g->is_reversed) return status;
  write_polygons(mesh, !mirrored, sizes, points, g->corner_order);
  sbfi_convert_warn(c, SBF_CODE_IMPORT_INSIDE_OUT,
      "all polygons of object '%s' faced inwards and were reversed", c->scene->nodes[mesh->node].name);
  return SBF_OK;
}

static sbf_status copy_sources(sbfi_conversion *c, const sbfi_scene_mesh *mesh, sbf_u32_list *list) {
  uint32_t *sources = sbfi_convert_allocate(c, mesh->point_count, sizeof *sources);
  if (mesh->point_count && !sources) return sbfi_convert_no_memory(c);
  if (sources) memcpy(sources, mesh->point_sources, mesh->point_count * sizeof *sources);
  *list = (sbf_u32_list){sources, mesh->point_count};
  return SBF_OK;
}

/* Transforms a normal by the cofactor matrix: the inverse transpose up to length. */
static sbf_vec3 transform_normal(const sbfi_matrix *m, sbf_vec3 n) {
  double out[3], v[3] = {n.x, n.y, n.z}, squared = 0, sign = sbfi_matrix_determinant(m) < 0 ? -1 : 1;
  for (int r = 0; r < 3; r++) {
    int r1 = (r + 1) % 3, r2 = (r + 2) % 3;
    out[r] = 0;
    for (int k = 0; k < 3; k++) {
      int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
      out[r] += sign * (m->at[r1][k1] * m->at[r2][k2] - m->at[r1][k2] * m->at[r2][k1]) * v[k];
    }
    squared += out[r] * out[r];
  }
  double scale = squared > 0 ? 1 / sqrt(squared) : 0;
  return scale > 0 ? (sbf_vec3){(float)(out[0] * scale), (float)(out[1] * scale), (float)(out[2] * scale)}
                   : (sbf_vec3){0, 1, 0};
}

/* Reorders the indices of a corner attribute to the asset's corners; false if a corner has none. */
static bool reorder_corners(const int32_t *from, const uint32_t *order, uint32_t count, uint32_t *to) {
  for (uint32_t i = 0; i < count; i++) {
    if (from[order[i]] < 0) return false;
    to[i] = (uint32_t)from[order[i]];
  }
  return true;
}

/* Whether most normals point to the back of their polygons. */
static bool point_backwards(const sbf_polygon_mesh *mesh, const sbf_vec3 *normals, const uint32_t *corners) {
  double sum = 0;
  for (uint32_t p = 0, at = 0; p < mesh->polygon_sizes.count; at += mesh->polygon_sizes.at[p++]) {
    const uint32_t *points = mesh->polygon_points.at + at, size = mesh->polygon_sizes.at[p];
    sbfi_d3 middle = sbfi_polygon_middle(mesh->positions.at, points, size);
    sbfi_d3 area = sbfi_polygon_area(mesh->positions.at, points, size, middle);
    for (uint32_t k = 0; k < size; k++) sum += sbfi_d3_dot(area, sbfi_d3_of(normals[corners[at + k]]));
  }
  return sum < 0;
}

static sbf_status convert_normals(
    sbfi_conversion *c, const sbfi_scene_mesh *mesh, const geometry *g, sbf_render_mesh *render) {
  if (!mesh->normals.corner_index || mesh->corner_count == 0 || mesh->normals.count == 0) return SBF_OK;
  uint32_t *corners = sbfi_convert_allocate(c, mesh->corner_count, sizeof *corners);
  sbf_vec3 *normals = sbfi_convert_allocate(c, mesh->normals.count, sizeof *normals);
  if (!corners || !normals) return sbfi_convert_no_memory(c);
  if (!reorder_corners(mesh->normals.corner_index, g->corner_order, mesh->corner_count, corners))
    return SBF_OK;
  for (uint32_t i = 0; i < mesh->normals.count; i++)
    normals[i] = transform_normal(&g->to_asset, mesh->normals.at[i]);
  if (g->is_reversed && point_backwards(&g->mesh, normals, corners))
    for (uint32_t i = 0; i < mesh->normals.count; i++)
      normals[i] = (sbf_vec3){-normals[i].x, -normals[i].y, -normals[i].z};
  render->normals = (sbf_vec3_list){normals, mesh->normals.count};
  render->normal_corners = (sbf_u32_list){corners, mesh->corner_count};
  return SBF_OK;
}

static sbf_status convert_uvs(
    sbfi_conversion *c, const sbfi_scene_mesh *mesh, const geometry *g, sbf_render_mesh *render) {
  if (mesh->uv_set_count == 0 || mesh->corner_count == 0) return SBF_OK;
  sbf_uv_set *sets = sbfi_convert_allocate(c, mesh->uv_set_count, sizeof *sets);
  if (!sets) return sbfi_convert_no_memory(c);
  uint32_t count = 0, first = sbfi_first_uv_set(c, mesh);
  for (uint32_t i = 0; i < mesh->uv_set_count; i++) {
    uint32_t s = i == 0 ? first : i - (i <= first); /* the chosen one first, then the others in order */
    const sbfi_scene_uvs *from = &mesh->uv_sets[s];
    if (from->count == 0) continue;
    uint32_t *corners = sbfi_convert_allocate(c, mesh->corner_count, sizeof *corners);
    sbf_vec2 *coordinates = sbfi_convert_allocate(c, from->count, sizeof *coordinates);
    if (!corners || !coordinates) return sbfi_convert_no_memory(c);
    if (!reorder_corners(from->corner, g->corner_order, mesh->corner_count, corners)) {
      sbfi_convert_warn(c, SBF_CODE_IMPORT_PARTIAL_UVS,
          "object '%s': uv set %u leaves some polygons without coordinates and was dropped",
          c->scene->nodes[mesh->node].name, s);
      continue;
    }
    memcpy(coordinates, from->at, from->count * sizeof *coordinates);
    sbf_uv_set *to = &sets[count++];
    sbf_uv_set_init(to);
    to->name = sbf_asset_copy_text(c->asset, from->name);
    if (!to->name) return sbfi_convert_no_memory(c);
    to->coordinates = (sbf_vec2_list){coordinates, from->count};
    to->corners = (sbf_u32_list){corners, mesh->corner_count};
  }
  render->uv_sets = (sbf_uv_set_list){sets, count};
  return SBF_OK;
}

/* Creates material slots in the order in which polygons use them. */
static sbf_status convert_slots(sbfi_conversion *c, const sbfi_scene_mesh *mesh, sbf_render_mesh *render) {
  if (mesh->polygon_count == 0 || c->scene->material_count == 0) return SBF_OK;
  int32_t *slot_of = sbfi_arena_allocate(&c->scratch, c->scene->material_count + 1, sizeof *slot_of);
  uint32_t *polygons = sbfi_convert_allocate(c, mesh->polygon_count, sizeof *polygons);
  sbf_material_slot *slots = sbfi_convert_allocate(c, c->scene->material_count + 1, sizeof *slots);
  if (!slot_of || !polygons || !slots) return sbfi_convert_no_memory(c);
  uint32_t count = 0;
  for (uint32_t p = 0; p < mesh->polygon_count; p++) {
    int32_t material = mesh->polygon_materials[p];
    int32_t *slot = &slot_of[material + 1]; /* 0: none yet */
    if (*slot == 0) {
      sbf_material_slot_init(&slots[count]);
      slots[count].material = material;
      *slot = (int32_t)++count;
    }
    polygons[p] = (uint32_t)*slot - 1;
  }
  render->material_slots = (sbf_material_slot_list){slots, count};
  if (count > 1) render->polygon_materials = (sbf_u32_list){polygons, mesh->polygon_count};
  return SBF_OK;
}

/* Exporters round weights. A smaller sum means that weights of unknown joints are missing, a larger one that
 * weights are wrong or stated twice. */
static const double MIN_WEIGHT_SUM = 0.9, MAX_WEIGHT_SUM = 1.1;

static void report_weights(
    sbfi_conversion *c, const sbfi_scene_mesh *mesh, uint32_t unweighted, uint32_t lost, uint32_t excessive) {
  const char *name = c->scene->nodes[mesh->node].name;
  if (unweighted)
    sbfi_convert_warn(c, SBF_CODE_RIG_UNWEIGHTED_POINTS,
        "object '%s': %u points have no weights, or only weights on missing joints, and follow the root "
        "bone: paint them in the source",
        name, unweighted);
  if (lost)
    sbfi_convert_warn(c, SBF_CODE_RIG_WEIGHTS_LOST,
        "object '%s': the weights of %u points summed to less than %g, for example because joints are "
        "missing, and were scaled to 1: export the skin again",
        name, lost, MIN_WEIGHT_SUM);
  if (excessive)
    sbfi_convert_warn(c, SBF_CODE_RIG_WEIGHTS_LOST,
        "object '%s': the weights of %u points summed to more than %g and were scaled to 1: export the skin "
        "again",
        name, excessive, MAX_WEIGHT_SUM);
}

/* Converts weights to bones; they sum to 1 at each point. A point without weights follows the mesh's node. */
static sbf_status convert_skin(sbfi_conversion *c, const sbfi_scene_mesh *mesh, sbf_render_mesh *render) {
  uint32_t total = mesh->skin.starts[mesh->point_count];
  sbf_skin *skin = sbfi_convert_allocate(c, 1, sizeof *skin);
  uint32_t *counts = sbfi_convert_allocate(c, mesh->point_count, sizeof *counts);
  uint32_t *bones = sbfi_convert_allocate(c, total + mesh->point_count, sizeof *bones);
  float *weights = sbfi_convert_allocate(c, total + mesh->point_count, sizeof *weights);
  if (!skin || !counts || !bones || !weights) return sbfi_convert_no_memory(c);
  int32_t home = c->bone_of_node[mesh->node];
  uint32_t at = 0, unweighted = 0, lost = 0, excessive = 0;
  for (uint32_t i = 0; i < mesh->point_count; i++) {
    double sum = 0;
    for (uint32_t s = mesh->skin.starts[i]; s < mesh->skin.starts[i + 1]; s++)
      sum += (double)mesh->skin.weights[s];
    if (sum <= 0) {
      unweighted++;
      counts[i] = 1;
      bones[at] = home >= 0 ? (uint32_t)home : 0;
      weights[at++] = 1;
      continue;
    }
    lost += sum < MIN_WEIGHT_SUM;
    excessive += sum > MAX_WEIGHT_SUM;
    for (uint32_t s = mesh->skin.starts[i]; s < mesh->skin.starts[i + 1]; s++) {
      int32_t bone = c->bone_of_node[mesh->skin.joints[mesh->skin.joint_index[s]].node];
      counts[i]++;
      bones[at] = bone >= 0 ? (uint32_t)bone : 0;
      weights[at++] = (float)((double)mesh->skin.weights[s] / sum);
    }
  }
  report_weights(c, mesh, unweighted, lost, excessive);
  sbf_skin_init(skin);
  skin->influence_counts = (sbf_u32_list){counts, mesh->point_count};
  skin->bones = (sbf_u32_list){bones, at};
  skin->weights = (sbf_f32_list){weights, at};
  render->skin = skin;
  return SBF_OK;
}

static sbf_status convert_shapes(
    sbfi_conversion *c, const sbfi_scene_mesh *mesh, const geometry *g, sbf_render_mesh *render) {
  if (mesh->shape_count == 0) return SBF_OK;
  sbf_shape_key *keys = sbfi_convert_allocate(c, mesh->shape_count, sizeof *keys);
  if (!keys) return sbfi_convert_no_memory(c);
  sbfi_matrix turn = g->to_asset;
  for (int r = 0; r < 3; r++) turn.at[r][3] = 0;
  for (uint32_t s = 0; s < mesh->shape_count; s++) {
    uint32_t moved = 0;
    const sbf_vec3 *delta = mesh->shapes[s].delta;
    for (uint32_t i = 0; i < mesh->point_count; i++)
      moved += delta[i].x != 0 || delta[i].y != 0 || delta[i].z != 0;
    uint32_t *points = sbfi_convert_allocate(c, moved, sizeof *points);
    sbf_vec3 *offsets = sbfi_convert_allocate(c, moved, sizeof *offsets);
    sbf_shape_key_init(&keys[s]);
    keys[s].name = sbf_asset_copy_text(c->asset, mesh->shapes[s].name);
    if ((moved && (!points || !offsets)) || !keys[s].name) return sbfi_convert_no_memory(c);
    uint32_t at = 0;
    for (uint32_t i = 0; i < mesh->point_count; i++) {
      if (delta[i].x == 0 && delta[i].y == 0 && delta[i].z == 0) continue;
      points[at] = i;
      offsets[at++] = sbfi_transform_point(&turn, delta[i]);
    }
    keys[s].points = (sbf_u32_list){points, moved};
    keys[s].offsets = (sbf_vec3_list){offsets, moved};
  }
  render->shape_keys = (sbf_shape_key_list){keys, mesh->shape_count};
  return SBF_OK;
}

static sbf_status fill_render_mesh(
    sbfi_conversion *c, uint32_t index, const geometry *g, sbf_render_mesh *render) {
  const sbfi_scene_mesh *mesh = &c->scene->meshes[index];
  sbf_render_mesh_init(render);
  render->id = sbfi_new_id(c, "mesh", c->name_of_mesh[index]);
  render->name = sbf_asset_copy_text(c->asset, c->name_of_mesh[index]);
  if (!render->id || !render->name) return sbfi_convert_no_memory(c);
  render->bone = c->bone_of_mesh[index];
  render->mesh = g->mesh;
  render->mesh.target = SBF_MESH_TARGET_RENDERING;
  sbf_status status = copy_sources(c, mesh, &render->source_points);
  if (status == SBF_OK) status = convert_normals(c, mesh, g, render);
  if (status == SBF_OK) status = convert_uvs(c, mesh, g, render);
  if (status == SBF_OK) status = sbfi_convert_colors(c, mesh, g->corner_order, render);
  if (status == SBF_OK) status = convert_slots(c, mesh, render);
  if (status == SBF_OK && mesh->skin.joint_count) status = convert_skin(c, mesh, render);
  if (status == SBF_OK) status = convert_shapes(c, mesh, g, render);
  if (status == SBF_OK && mesh->skin.joint_count && !sbfi_pin_skin(c, mesh, render))
    return sbfi_convert_no_memory(c);
  return status;
}

static sbf_status fill_body(
    sbfi_conversion *c, uint32_t index, bool skinned, const geometry *g, sbf_soft_body *body) {
  sbf_soft_body_init(body);
  body->id = sbfi_new_id(c, "body", c->name_of_mesh[index]);
  body->name = sbf_asset_copy_text(c->asset, c->name_of_mesh[index]);
  if (!body->id || !body->name) return sbfi_convert_no_memory(c);
  body->bone = skinned ? SBF_NONE : c->bone_of_mesh[index];
  body->surface = g->mesh;
  body->surface.target = SBF_MESH_TARGET_SURFACE;
  bool flat = sbfi_flat_body_weigh(body);
  if (body->bone != SBF_NONE) { /* soft tissue on a bone keeps its shape when standing and its volume */
    body->attributes.sag_free = true;
    if (!flat) body->attributes.pressure_mode = SBF_PRESSURE_MODE_VOLUME;
  }
  return copy_sources(c, &c->scene->meshes[index], &body->source_points);
}

/* Attaches objects without a bone to the bone of what they touch, unless they are pinned. */
static sbf_status attach_loose(
    sbfi_conversion *c, const geometry *geometries, const sbf_render_mesh *skins, uint32_t skin_count) {
  uint32_t count = c->scene->mesh_count;
  const sbf_polygon_mesh **objects = sbfi_arena_allocate(&c->scratch, count, sizeof *objects);
  if (!objects) return sbfi_convert_no_memory(c);
  for (uint32_t i = 0; i < count; i++) {
    const sbfi_scene_mesh *mesh = &c->scene->meshes[i];
    bool loose = !geometries[i].is_flat && !mesh->skin.joint_count && !sbfi_mesh_is_pinned(c, mesh);
    objects[i] = loose ? &geometries[i].mesh : NULL;
  }
  return sbfi_attach_objects(c, skins, skin_count, objects);
}

sbf_status sbfi_convert_meshes(sbfi_conversion *c) {
  uint32_t count = c->scene->mesh_count, body_count = 0, render_count = 0;
  bool is_simulated = c->physics && c->physics->is_simulated;
  if (count == 0) return SBF_OK;
  geometry *geometries = sbfi_arena_allocate(&c->scratch, count, sizeof *geometries);
  sbf_soft_body *bodies = sbfi_convert_allocate(c, count, sizeof *bodies);
  sbf_render_mesh *renders = sbfi_convert_allocate(c, count, sizeof *renders);
  if (!geometries || !bodies || !renders) return sbfi_convert_no_memory(c);
  sbf_status status = SBF_OK;
  for (uint32_t i = 0; i < count && status == SBF_OK; i++) {
    status = convert_geometry(c, &c->scene->meshes[i], &geometries[i]);
    if (status == SBF_OK && geometries[i].is_flat)
      sbfi_convert_warn(c, SBF_CODE_IMPORT_IGNORED,
          "object '%s' is left out, because none of its polygons has an area",
          c->scene->nodes[c->scene->meshes[i].node].name);
    else if (status == SBF_OK && c->scene->meshes[i].skin.joint_count && c->asset->bones.count)
      status = fill_render_mesh(c, i, &geometries[i], &renders[render_count++]);
  }
  if (status == SBF_OK && !is_simulated) status = attach_loose(c, geometries, renders, render_count);
  if (status != SBF_OK) return status;
  sbfi_skins skins;
  if (!sbfi_skins_make(&skins, renders, render_count, &c->scratch)) return sbfi_convert_no_memory(c);
  for (uint32_t i = 0; i < count && status == SBF_OK; i++) {
    bool skinned = c->scene->meshes[i].skin.joint_count && c->asset->bones.count;
    bool pinned = sbfi_mesh_is_pinned(c, &c->scene->meshes[i]);
    if (geometries[i].is_flat || (skinned && !pinned)) continue;
    if (is_simulated) { /* moved by rigid bodies, and drawn only */
      status = fill_render_mesh(c, i, &geometries[i], &renders[render_count++]);
      continue;
    }
    sbf_soft_body *body = &bodies[body_count++];
    status = fill_body(c, i, skinned, &geometries[i], body);
    if (status == SBF_OK && pinned && !sbfi_pin_body(c, &c->scene->meshes[i], body))
      status = sbfi_convert_no_memory(c);
    bool is_covered = !skinned && body->bone >= 0 && sbfi_skins_hide(&skins, &body->surface);
    if (status == SBF_OK && !skinned && !is_covered)
      status = fill_render_mesh(c, i, &geometries[i], &renders[render_count++]);
  }
  c->asset->soft_bodies = (sbf_soft_body_list){bodies, body_count};
  c->asset->render_meshes = (sbf_render_mesh_list){renders, render_count};
  if (status == SBF_OK && body_count + render_count == 0)
    return sbfi_diagnose(c->error, SBF_CODE_IMPORT_EMPTY,
        "%s has no surface, because none of its polygons has an area: check whether it is scaled to 0, for "
        "example by its unit",
        c->scene->file);
  if (status == SBF_OK && body_count == 0 && !is_simulated)
    sbfi_convert_warn(c, SBF_CODE_RIG_NO_SECTIONS,
        "every mesh is skinned and none is attached to a bone directly: the build cuts sections along the "
        "bones");
  return status;
}
