/* Merges the parts of a node into one mesh and restores shared points.
 *
 * assimp splits a mesh into one part per material, with a vertex at every corner or at every difference of
 * normal or texture coordinate. The original points are found by exact comparison: vertices of one node
 * with equal positions, joints, weights and shape deltas are one point. Two points at one position that
 * move differently (lips) stay separate. Vertices of different nodes are never merged, so adjacent
 * sections stay separate. */
#include <math.h>
#include <string.h>

#include "import/scene/assembly.h"
#include "import/scene/row_table.h"

enum { NO_JOINT = 0x7fffffff }; /* for a bone whose name no node has */

typedef struct influence {
  uint32_t joint;
  float weight;
} influence;

typedef struct joining {
  sbfi_assembly *assembly;
  sbfi_arena scratch;
  const sbfi_raw_mesh **parts;
  uint32_t part_count;
  uint32_t *part_vertices; /* (part_count + 1) first vertex of each part in the merged mesh */
  sbfi_scene_mesh *to;
  uint32_t vertex_count, shape_count, uv_set_count;
  uint32_t *influence_starts; /* (vertex_count + 1), NULL without a skin */
  influence *influences;
  uint32_t nodeless_count; /* bones of parts without a node */
  sbfi_row_table table, classes;
} joining;

static void *allocate(joining *j, size_t count, size_t size) {
  return sbfi_arena_allocate(&j->assembly->scene->arena, count ? count : 1, size);
}

static void *scratch(joining *j, size_t count, size_t size) {
  return sbfi_arena_allocate(&j->scratch, count ? count : 1, size);
}

static bool refuse_size(joining *j) {
  return sbfi_assembly_refuse(
      j->assembly, SBF_CODE_IO_TOO_LARGE, "a mesh has more than 2147483647 vertices, corners or weights");
}

static bool refuse_number(joining *j, const char *what) {
  return sbfi_assembly_refuse(j->assembly, SBF_CODE_IMPORT_NOT_FINITE,
      "the %s of mesh \"%s\" exceed single precision: export the file again", what, j->to->name);
}

/* Common prefix of the parts' names: several parts are named "-0", "-1", … after the mesh's name. */
static sbfi_span shared_name(const joining *j) {
  sbfi_span name = j->parts[0]->name;
  for (uint32_t i = 1; i < j->part_count; i++) {
    sbfi_span other = j->parts[i]->name;
    size_t k = 0;
    while (k < name.length && k < other.length && name.at[k] == other.at[k]) k++;
    name.length = k;
  }
  while (j->part_count > 1 && name.length && name.at[name.length - 1] == '-') name.length--;
  return name.length ? name : j->parts[0]->name;
}

static bool count_parts(joining *j) {
  uint64_t vertices = 0, corners = 0, polygons = 0;
  j->part_vertices = scratch(j, (size_t)j->part_count + 1, sizeof *j->part_vertices);
  if (!j->part_vertices) return false;
  for (uint32_t i = 0; i < j->part_count; i++) {
    const sbfi_raw_mesh *part = j->parts[i];
    vertices += part->vertex_count;
    if (vertices > INT32_MAX) return refuse_size(j);
    j->part_vertices[i + 1] = (uint32_t)vertices;
    for (uint32_t p = 0; p < part->polygon_count; p++)
      if (part->polygon_sizes[p] >= 3) {
        corners += part->polygon_sizes[p];
        polygons++;
      }
    if (part->uv_set_count > j->uv_set_count) j->uv_set_count = part->uv_set_count;
    if (part->shape_count > j->shape_count) j->shape_count = part->shape_count;
  }
  if (corners > INT32_MAX) return refuse_size(j);
  j->vertex_count = (uint32_t)vertices;
  j->to->vertex_count = (uint32_t)vertices;
  j->to->corner_count = (uint32_t)corners;
  j->to->polygon_count = (uint32_t)polygons;
  return true;
}

/* Skips lines and points, which have one or two corners. */
static bool join_polygons(joining *j) {
  sbfi_scene_mesh *to = j->to;
  uint32_t *starts = allocate(j, (size_t)to->polygon_count + 1, sizeof *starts);
  int32_t *materials = allocate(j, to->polygon_count, sizeof *materials);
  uint32_t *vertices = allocate(j, to->corner_count, sizeof *vertices);
  if (!starts || !materials || !vertices) return false;
  uint32_t polygon = 0, corner = 0;
  for (uint32_t i = 0; i < j->part_count; i++) {
    const sbfi_raw_mesh *part = j->parts[i];
    const uint32_t *from = part->corners;
    int32_t material = part->material == SBF_NONE ? SBF_NONE : j->assembly->new_materials[part->material];
    for (uint32_t p = 0; p < part->polygon_count; from += part->polygon_sizes[p++]) {
      if (part->polygon_sizes[p] < 3) continue;
      for (uint32_t k = 0; k < part->polygon_sizes[p]; k++)
        vertices[corner++] = from[k] + j->part_vertices[i];
      materials[polygon++] = material;
      starts[polygon] = corner;
    }
  }
  to->polygon_starts = starts;
  to->polygon_materials = materials;
  to->corner_vertices = vertices;
  return true;
}

/* Adds one joint per node: parts list the same joints with equal bind matrices in different orders. */
static int64_t add_joint(joining *j, sbfi_array *joints, int32_t node, const sbfi_matrix *bind) {
  uint32_t *joint_of_node = j->assembly->joint_of_node;
  if (joint_of_node[node] == 0) {
    if (!sbfi_array_append(joints, &(sbfi_scene_joint){node, *bind}, 1)) return -1;
    joint_of_node[node] = (uint32_t)joints->count;
  }
  return (int64_t)joint_of_node[node] - 1;
}

/* Finds the joint of each bone of a part; NO_JOINT if it has no node. */
static bool join_joints(joining *j, sbfi_array *joints, const sbfi_raw_mesh *part, uint32_t *joint_of_bone) {
  sbfi_assembly *a = j->assembly;
  bool good = true;
  for (uint32_t b = 0; b < part->bone_count && good; b++) {
    int32_t node = sbfi_assembly_find(a, part->bones[b].name, &good);
    joint_of_bone[b] = NO_JOINT;
    if (node == SBF_NONE) {
      j->nodeless_count++;
      const char *name = sbfi_scene_string(a->scene, part->bones[b].name);
      good =
          name &&
          sbfi_scene_warn(a->scene, SBF_CODE_IMPORT_IGNORED, 0,
              "a skin refers to \"%s\", which is not a node: its weights move nothing, but pins can use them",
              name);
      continue;
    }
    int64_t joint = add_joint(j, joints, node, &part->bones[b].bind);
    if (joint < 0) return false;
    joint_of_bone[b] = (uint32_t)joint;
  }
  return good;
}

/* Sorts and merges joints, and drops weights of 0. Returns the remaining count. */
static uint32_t tidy(influence *list, uint32_t count) {
  uint32_t kept = 0;
  for (uint32_t i = 0; i < count; i++) {
    influence now = list[i];
    uint32_t k = kept;
    while (k > 0 && list[k - 1].joint > now.joint) k--;
    if (k > 0 && list[k - 1].joint == now.joint) {
      list[k - 1].weight += now.weight;
      continue;
    }
    memmove(list + k + 1, list + k, (kept - k) * sizeof *list);
    list[k] = now;
    kept++;
  }
  return kept;
}

/* Visits every weight above 0 in order of parts and bones: the first pass counts in `indices`, the second
 * fills and advances them. */
static void visit_weights(joining *j, uint32_t *const *joint_of_bone, uint32_t *indices, influence *list) {
  for (uint32_t i = 0; i < j->part_count; i++)
    for (uint32_t b = 0; b < j->parts[i]->bone_count; b++) {
      const sbfi_raw_bone *bone = &j->parts[i]->bones[b];
      if (joint_of_bone[i][b] == NO_JOINT) continue;
      for (uint32_t k = 0; k < bone->weight_count; k++) {
        if (!(bone->weights[k] > 0)) continue;
        uint32_t *slots = &indices[j->part_vertices[i] + bone->vertices[k]];
        if (list) list[*slots] = (influence){joint_of_bone[i][b], bone->weights[k]};
        ++*slots;
      }
    }
}

static bool join_influences(joining *j, uint32_t *const *joint_of_bone) {
  uint32_t *starts = scratch(j, (size_t)j->vertex_count + 1, sizeof *starts);
  if (!starts) return false;
  visit_weights(j, joint_of_bone, starts, NULL);
  uint64_t total = 0;
  for (uint32_t v = 0; v < j->vertex_count; v++) {
    uint32_t count = starts[v];
    starts[v] = (uint32_t)total;
    total += count;
    if (total > INT32_MAX) return refuse_size(j);
  }
  j->influences = scratch(j, (size_t)total, sizeof *j->influences);
  if (!j->influences) return false;
  visit_weights(j, joint_of_bone, starts, j->influences);
  /* starts[v] is now the end of v's list: sorts each list and closes the gaps. */
  uint32_t from = 0, kept = 0;
  for (uint32_t v = 0; v < j->vertex_count; v++) {
    uint32_t end = starts[v], count = tidy(j->influences + from, end - from);
    memmove(j->influences + kept, j->influences + from, count * sizeof *j->influences);
    starts[v] = kept;
    kept += count;
    from = end;
  }
  starts[j->vertex_count] = kept;
  for (uint32_t k = 0; k < kept; k++)
    if (!isfinite(j->influences[k].weight)) return refuse_number(j, "weights");
  j->influence_starts = starts;
  return true;
}

static bool join_skin(joining *j) {
  sbfi_assembly *a = j->assembly;
  uint32_t bones = 0;
  for (uint32_t i = 0; i < j->part_count; i++) bones += j->parts[i]->bone_count > 0;
  if (!bones) return true;
  sbfi_array joints;
  sbfi_array_init(&joints, a->allocator, sizeof(sbfi_scene_joint));
  uint32_t **joint_of_bone = scratch(j, j->part_count, sizeof *joint_of_bone);
  bool good = joint_of_bone != NULL;
  for (uint32_t i = 0; i < j->part_count && good; i++) {
    joint_of_bone[i] = scratch(j, j->parts[i]->bone_count, sizeof **joint_of_bone);
    good = joint_of_bone[i] && join_joints(j, &joints, j->parts[i], joint_of_bone[i]);
  }
  const sbfi_scene_joint *have = joints.at;
  for (size_t i = 0; i < joints.count; i++) a->joint_of_node[have[i].node] = 0;
  good = good && join_influences(j, joint_of_bone);
  if (good && joints.count) {
    j->to->skin.joints =
        sbfi_arena_copy(&a->scene->arena, joints.at, joints.count, sizeof *j->to->skin.joints);
    j->to->skin.joint_count = (uint32_t)joints.count;
    good = j->to->skin.joints != NULL;
  }
  sbfi_array_free(&joints);
  return good;
}

static sbf_vec3 shape_delta(const sbfi_raw_mesh *part, uint32_t shape, uint32_t vertex) {
  if (shape >= part->shape_count) return (sbf_vec3){0, 0, 0};
  sbf_vec3 at = part->positions[vertex], moved = part->shapes[shape].positions[vertex];
  return (sbf_vec3){moved.x - at.x, moved.y - at.y, moved.z - at.z};
}

/* Steps down a tree: returns the number of the child with these three words as its key; -1 if memory runs
 * out. Numbers have at most 31 bits, which leaves one bit for the kind of step. */
static int64_t step(joining *j, int64_t from, uint32_t kind, uint32_t a, uint32_t b, uint32_t c) {
  if (from < 0) return -1;
  int64_t child = sbfi_row_table_add(&j->classes, (sbfi_row){{(uint32_t)from | kind << 31, a, b, c}});
  return child < 0 ? -1 : child + 1;
}

/* Number that two vertices share if the same joints and shapes move them equally: the end of a walk with
 * one step per joint and two per shape. */
static int64_t class_of(joining *j, const sbfi_raw_mesh *part, uint32_t part_vertex, uint32_t vertex) {
  int64_t class = 0;
  for (uint32_t k = j->influence_starts ? j->influence_starts[vertex] : 0;
       j->influence_starts && k < j->influence_starts[vertex + 1]; k++)
    class = step(j, class, 0, j->influences[k].joint, sbfi_float_word(j->influences[k].weight), 0);
  for (uint32_t s = 0; s < j->shape_count; s++) {
    sbf_vec3 d = shape_delta(part, s, part_vertex);
    if (d.x == 0 && d.y == 0 && d.z == 0) continue;
    class = step(j, class, 0, s, 0, 1);
    class = step(j, class, 1, sbfi_float_word(d.x), sbfi_float_word(d.y), sbfi_float_word(d.z));
  }
  return class;
}

/* Numbers points by their first vertices. */
static bool weld(joining *j) {
  sbfi_scene_mesh *to = j->to;
  uint32_t *points = allocate(j, j->vertex_count, sizeof *points);
  uint32_t *sources = scratch(j, j->vertex_count, sizeof *sources);
  if (!points || !sources) return false;
  for (uint32_t i = 0; i < j->part_count; i++)
    for (uint32_t k = 0; k < j->parts[i]->vertex_count; k++) {
      uint32_t vertex = j->part_vertices[i] + k;
      const sbf_vec3 *at = &j->parts[i]->positions[k];
      int64_t class = class_of(j, j->parts[i], k, vertex);
      if (class < 0) return false;
      int64_t point = sbfi_row_table_add(&j->table,
          (sbfi_row){
              {sbfi_float_word(at->x), sbfi_float_word(at->y), sbfi_float_word(at->z), (uint32_t) class}});
      if (point < 0) return false;
      if ((uint32_t)point == to->point_count) sources[to->point_count++] = vertex;
      points[vertex] = (uint32_t)point;
    }
  to->vertex_points = points;
  to->point_sources = sbfi_arena_copy(&j->assembly->scene->arena, sources, to->point_count, sizeof *sources);
  sbf_vec3 *positions = allocate(j, to->point_count, sizeof *positions);
  uint32_t *corners = allocate(j, to->corner_count, sizeof *corners);
  if (!to->point_sources || !positions || !corners) return false;
  for (uint32_t i = 0, p = 0; i < j->part_count; i++)
    for (; p < to->point_count && sources[p] < j->part_vertices[i + 1]; p++)
      positions[p] = j->parts[i]->positions[sources[p] - j->part_vertices[i]];
  for (uint32_t c = 0; c < to->corner_count; c++) corners[c] = points[to->corner_vertices[c]];
  to->points = positions;
  to->corner_points = corners;
  return true;
}

static bool copy_skin(joining *j) {
  sbfi_scene_mesh *to = j->to;
  if (!to->skin.joint_count) return true;
  uint32_t *starts = allocate(j, (size_t)to->point_count + 1, sizeof *starts);
  if (!starts) return false;
  for (uint32_t p = 0; p < to->point_count; p++) {
    uint32_t v = to->point_sources[p];
    starts[p + 1] = starts[p] + j->influence_starts[v + 1] - j->influence_starts[v];
  }
  uint32_t *joints = allocate(j, starts[to->point_count], sizeof *joints);
  float *weights = allocate(j, starts[to->point_count], sizeof *weights);
  if (!joints || !weights) return false;
  for (uint32_t p = 0, k = 0; p < to->point_count; p++) {
    uint32_t v = to->point_sources[p];
    for (uint32_t i = j->influence_starts[v]; i < j->influence_starts[v + 1]; i++, k++) {
      joints[k] = j->influences[i].joint;
      weights[k] = j->influences[i].weight;
    }
  }
  to->skin.starts = starts;
  to->skin.joint_index = joints;
  to->skin.weights = weights;
  return true;
}

/* Part and vertex within it of a vertex of the merged mesh. */
static const sbfi_raw_mesh *part_of(const joining *j, uint32_t vertex, uint32_t *part_vertex) {
  uint32_t low = 0, high = j->part_count - 1;
  while (low < high) {
    uint32_t middle = (low + high) / 2;
    if (vertex < j->part_vertices[middle + 1])
      high = middle;
    else
      low = middle + 1;
  }
  *part_vertex = vertex - j->part_vertices[low];
  return j->parts[low];
}

static bool copy_shapes(joining *j) {
  sbfi_scene_mesh *to = j->to;
  if (!j->shape_count) return true;
  sbfi_scene_shape *shapes = allocate(j, j->shape_count, sizeof *shapes);
  if (!shapes) return false;
  for (uint32_t s = 0; s < j->shape_count; s++) {
    uint32_t i = 0, v;
    while (s >= j->parts[i]->shape_count) i++;
    sbf_vec3 *delta = allocate(j, to->point_count, sizeof *delta);
    shapes[s].name = sbfi_scene_string(j->assembly->scene, j->parts[i]->shapes[s].name);
    shapes[s].weight = j->parts[i]->shapes[s].weight;
    shapes[s].delta = delta;
    if (!delta || !shapes[s].name) return false;
    for (uint32_t p = 0; p < to->point_count; p++) {
      const sbfi_raw_mesh *part = part_of(j, to->point_sources[p], &v);
      delta[p] = shape_delta(part, s, v);
      if (!isfinite(delta[p].x) || !isfinite(delta[p].y) || !isfinite(delta[p].z))
        return refuse_number(j, "shapes");
    }
  }
  to->shapes = shapes;
  to->shape_count = j->shape_count;
  return true;
}

/* Finds a group by name or adds one without weights; NULL if memory runs out. */
static sbfi_scene_group *group_named(joining *j, sbfi_scene_group *groups, const char *name) {
  for (uint32_t g = 0; g < j->to->group_count; g++)
    if (strcmp(groups[g].name, name) == 0) return &groups[g];
  sbfi_scene_group *group = &groups[j->to->group_count];
  group->name = name;
  group->weights = allocate(j, j->to->point_count, sizeof *group->weights);
  if (!group->weights) return NULL;
  j->to->group_count++;
  return group;
}

/* Creates groups from bones without a node; merged vertices take the maximum. */
static bool copy_groups(joining *j) {
  if (!j->nodeless_count) return true;
  sbfi_scene_group *groups = allocate(j, j->nodeless_count, sizeof *groups);
  if (!groups) return false;
  for (uint32_t i = 0; i < j->part_count; i++)
    for (uint32_t b = 0; b < j->parts[i]->bone_count; b++) {
      const sbfi_raw_bone *bone = &j->parts[i]->bones[b];
      bool good = true;
      if (sbfi_assembly_find(j->assembly, bone->name, &good) != SBF_NONE) continue;
      const char *name = good ? sbfi_scene_string(j->assembly->scene, bone->name) : NULL;
      sbfi_scene_group *group = name ? group_named(j, groups, name) : NULL;
      if (!group) return false;
      float *weights = (float *)(uintptr_t)group->weights; /* created above and still writable */
      for (uint32_t k = 0; k < bone->weight_count; k++) {
        float *weight = &weights[j->to->vertex_points[j->part_vertices[i] + bone->vertices[k]]];
        *weight = fminf(1, fmaxf(*weight, bone->weights[k])); /* fmaxf ignores NaN */
      }
    }
  j->to->groups = groups;
  return true;
}

typedef const float *(*attribute)(const sbfi_raw_mesh *part, uint32_t set);

static const float *normals_of(const sbfi_raw_mesh *part, uint32_t set) {
  (void)set;
  return (const float *)part->normals;
}

static const float *colors_of(const sbfi_raw_mesh *part, uint32_t set) {
  (void)set;
  return (const float *)part->colors;
}

static const float *uvs_of(const sbfi_raw_mesh *part, uint32_t set) {
  return set < part->uv_set_count ? (const float *)part->uvs[set] : NULL;
}

/* Collects the distinct values of an attribute (`width` numbers each) and the index of each corner. */
static bool copy_attribute(joining *j, attribute of, uint32_t set, uint32_t width, float **values,
    uint32_t *count, int32_t **corner_values) {
  sbfi_scene_mesh *to = j->to;
  int32_t *value_of_vertex = scratch(j, j->vertex_count, sizeof *value_of_vertex);
  *corner_values = allocate(j, to->corner_count, sizeof **corner_values);
  if (!value_of_vertex || !*corner_values) return false;
  sbfi_row_table_clear(&j->table);
  for (uint32_t i = 0; i < j->part_count; i++) {
    const float *from = of(j->parts[i], set);
    for (uint32_t k = 0; k < j->parts[i]->vertex_count; k++) {
      sbfi_row row = {{0, 0, 0, 0}};
      for (uint32_t w = 0; from && w < width; w++) row.at[w] = sbfi_float_word(from[(size_t)k * width + w]);
      int64_t value = from ? sbfi_row_table_add(&j->table, row) : SBF_NONE;
      if (from && value < 0) return false;
      value_of_vertex[j->part_vertices[i] + k] = (int32_t)value;
    }
  }
  for (uint32_t c = 0; c < to->corner_count; c++)
    (*corner_values)[c] = value_of_vertex[to->corner_vertices[c]];
  const sbfi_row *rows = j->table.rows.at;
  *count = (uint32_t)j->table.rows.count;
  *values = allocate(j, *count, width * sizeof(float));
  for (uint32_t i = 0; *values && i < *count; i++)
    memcpy(*values + (size_t)i * width, rows[i].at, width * sizeof(float));
  return *values != NULL;
}

static bool copy_attributes(joining *j) {
  sbfi_scene_mesh *to = j->to;
  bool normals = false, colors = false;
  int32_t *corners;
  float *values;
  for (uint32_t i = 0; i < j->part_count; i++) {
    normals = normals || j->parts[i]->normals;
    colors = colors || j->parts[i]->colors;
  }
  if (normals) {
    if (!copy_attribute(j, normals_of, 0, 3, &values, &to->normals.count, &corners)) return false;
    to->normals.at = (const sbf_vec3 *)values;
    to->normals.corner_index = corners;
  }
  if (colors) {
    if (!copy_attribute(j, colors_of, 0, 4, &values, &to->colors.count, &corners)) return false;
    to->colors.at = (const sbf_vec4 *)values;
    to->colors.corner_index = corners;
  }
  if (!j->uv_set_count) return true;
  sbfi_scene_uvs *sets = allocate(j, j->uv_set_count, sizeof *sets);
  if (!sets) return false;
  for (uint32_t set = 0; set < j->uv_set_count; set++) {
    if (!copy_attribute(j, uvs_of, set, 2, &values, &sets[set].count, &corners)) return false;
    sets[set].name = "";
    sets[set].at = (const sbf_vec2 *)values;
    sets[set].corner = corners;
  }
  to->uv_sets = sets;
  to->uv_set_count = j->uv_set_count;
  return true;
}

static bool join(joining *j) {
  j->to->name = sbfi_scene_string(j->assembly->scene, shared_name(j));
  return j->to->name && join_polygons(j) && join_skin(j) && weld(j) && copy_skin(j) && copy_groups(j) &&
         copy_shapes(j) && copy_attributes(j);
}

/* Creates the mesh of a node in `*to`, unless it has no polygons; counts skipped ones. */
static bool join_node(sbfi_assembly *a, uint32_t node, sbfi_scene_mesh *to, uint64_t *left_out) {
  const sbfi_raw_node *raw = &a->raw->nodes[a->old_from_new[node]];
  joining j = {.assembly = a, .part_count = raw->mesh_count, .to = to};
  *to = (sbfi_scene_mesh){.node = (int32_t)node};
  sbfi_arena_init(&j.scratch, a->allocator, 0);
  sbfi_row_table_init(&j.table, a->allocator);
  sbfi_row_table_init(&j.classes, a->allocator);
  j.parts = scratch(&j, j.part_count, sizeof *j.parts);
  bool good = j.parts != NULL;
  for (uint32_t i = 0; good && i < j.part_count; i++) {
    j.parts[i] = &a->raw->meshes[raw->meshes[i]];
    *left_out += j.parts[i]->polygon_count;
  }
  good = good && count_parts(&j);
  if (good) *left_out -= to->polygon_count;
  if (good && to->polygon_count) good = join(&j);
  sbfi_row_table_free(&j.table);
  sbfi_row_table_free(&j.classes);
  sbfi_arena_free(&j.scratch);
  return good;
}

bool sbfi_assemble_meshes(sbfi_assembly *a) {
  sbfi_scene *scene = a->scene;
  if (!a->raw->mesh_count) return true;
  if (sbfi_is_invented(a))
    return sbfi_scene_warn(scene, SBF_CODE_IMPORT_MESH_INVENTED, 0,
        "the file has no mesh: the one that the importer invented is left out");
  uint32_t count = 0;
  uint64_t left_out = 0;
  for (uint32_t i = 0; i < scene->node_count; i++) count += a->raw->nodes[a->old_from_new[i]].mesh_count > 0;
  sbfi_scene_mesh *meshes = sbfi_arena_allocate(&scene->arena, count ? count : 1, sizeof *meshes);
  a->joint_of_node = sbfi_arena_allocate(&a->scratch, scene->node_count, sizeof *a->joint_of_node);
  if (!meshes || !a->joint_of_node) return false;
  for (uint32_t i = 0; i < scene->node_count; i++) {
    if (a->raw->nodes[a->old_from_new[i]].mesh_count == 0) continue;
    if (!join_node(a, i, &meshes[scene->mesh_count], &left_out)) return false;
    scene->mesh_count += meshes[scene->mesh_count].polygon_count > 0;
  }
  scene->meshes = scene->mesh_count ? meshes : NULL;
  return !left_out || sbfi_scene_warn(scene, SBF_CODE_IMPORT_IGNORED, 0,
                          "%llu points and lines are left out, because they are not polygons",
                          (unsigned long long)left_out);
}
