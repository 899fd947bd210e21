/* Writes the 2012 dialect, <model>: section 16 of the specification. Ids count from 1; angles are in
 * degrees. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "export/exporting.h"
#include "interchange/paper_units.h"
#include "model/schema.h"
#include "sbfmt/mechanics.h"

static const double DEGREE = 3.14159265358979323846 / 180;

typedef struct paper_writer {
  sbfi_export *e;
  sbfi_arena scratch;
  uint32_t lost_vertices; /* embedded in no tetrahedron of the level */
  uint32_t skewed_limits; /* limits with asymmetric bounds */
  uint32_t lost_embeddings;
} paper_writer;

static void line(paper_writer *w, int depth, const char *text) {
  sbfi_text_repeat(&w->e->text, ' ', 2 * (size_t)depth);
  sbfi_text_string(&w->e->text, text);
  sbfi_text_char(&w->e->text, '\n');
}

static void attribute(paper_writer *w, const char *name, float value) {
  sbfi_text_char(&w->e->text, ' ');
  sbfi_text_string(&w->e->text, name);
  sbfi_text_string(&w->e->text, "=\"");
  sbfi_text_f32(&w->e->text, value);
  sbfi_text_char(&w->e->text, '"');
}

static void numbered(paper_writer *w, int depth, const char *name, uint32_t id) {
  sbfi_text_repeat(&w->e->text, ' ', 2 * (size_t)depth);
  sbfi_export_format(w->e, "<%s id=\"%u\"", name, id);
}

static void end_line(paper_writer *w) {
  sbfi_text_string(&w->e->text, "/>\n");
}

static void position_line(paper_writer *w, int depth, const char *name, uint32_t id, sbf_vec3 position) {
  numbered(w, depth, name, id);
  attribute(w, "x", position.x);
  attribute(w, "y", position.y);
  attribute(w, "z", position.z);
  end_line(w);
}

static void value_element(paper_writer *w, int depth, const char *name, float value) {
  sbfi_text_repeat(&w->e->text, ' ', 2 * (size_t)depth);
  sbfi_export_format(w->e, "<%s>", name);
  sbfi_text_f32(&w->e->text, value);
  sbfi_export_format(w->e, "</%s>\n", name);
}

/* ---- Surfaces ---- */

static void write_vertices(paper_writer *w, int depth, sbf_vec3_list points) {
  line(w, depth, "<vertices>");
  for (uint32_t i = 0; i < points.count; i++) position_line(w, depth + 1, "vertex", i + 1, points.at[i]);
  line(w, depth, "</vertices>");
}

/* `mesh` provides the corners' normals and coordinates; NULL: none. */
static void write_faces(
    paper_writer *w, int depth, const sbf_polygon_mesh *faces, const sbf_render_mesh *mesh) {
  const sbf_uv_set *uv =
      mesh && mesh->uv_sets.count && mesh->uv_sets.at[0].coordinates.count ? mesh->uv_sets.at : NULL;
  line(w, depth, "<faces>");
  for (uint32_t i = 0, corner = 0; i < faces->polygon_sizes.count; i++) {
    line(w, depth + 1, "<face>");
    for (uint32_t k = 0; k < faces->polygon_sizes.at[i]; k++, corner++) {
      uint32_t point = faces->polygon_points.at[corner];
      sbfi_text_repeat(&w->e->text, ' ', 2 * (size_t)(depth + 2));
      sbfi_export_format(w->e, "<node v=\"%u\"", point + 1);
      if (mesh && mesh->normals.count)
        sbfi_export_format(
            w->e, " n=\"%u\"", 1 + (mesh->normal_corners.count ? mesh->normal_corners.at[corner] : point));
      if (uv) sbfi_export_format(w->e, " t=\"%u\"", 1 + (uv->corners.count ? uv->corners.at[corner] : point));
      end_line(w);
    }
    line(w, depth + 1, "</face>");
  }
  line(w, depth, "</faces>");
}

static void write_render_mesh(paper_writer *w, const sbf_render_mesh *mesh) {
  line(w, 2, "<polygon_mesh target=\"rendering\">");
  write_vertices(w, 3, mesh->mesh.positions);
  if (mesh->uv_sets.count && mesh->uv_sets.at[0].coordinates.count) {
    sbf_vec2_list coordinates = mesh->uv_sets.at[0].coordinates;
    line(w, 3, "<texture_coords>");
    for (uint32_t i = 0; i < coordinates.count; i++) {
      numbered(w, 4, "coord", i + 1);
      attribute(w, "u", coordinates.at[i].x);
      attribute(w, "v", coordinates.at[i].y);
      end_line(w);
    }
    line(w, 3, "</texture_coords>");
  }
  if (mesh->normals.count) {
    line(w, 3, "<normals>");
    for (uint32_t i = 0; i < mesh->normals.count; i++)
      position_line(w, 4, "vector", i + 1, mesh->normals.at[i]);
    line(w, 3, "</normals>");
  }
  write_faces(w, 3, &mesh->mesh, mesh);
  line(w, 2, "</polygon_mesh>");
}

/* ---- The lattice ---- */

/* Index of the body's points in the original file: the surface's by source_points, the others in the
 * remaining indices. NULL: unchanged. */
static const uint32_t *source_order(paper_writer *w, const sbf_soft_body *body, const sbf_level *level) {
  uint32_t count = level->positions.count, surface = body->surface.positions.count;
  if (level->new_from_old.count || body->source_points.count != surface || surface > count ||
      surface + body->interior.count != count)
    return NULL;
  uint32_t *old_from_new = sbfi_arena_allocate(&w->scratch, count, sizeof *old_from_new);
  bool *taken = sbfi_arena_allocate(&w->scratch, count, sizeof *taken);
  if (!old_from_new || !taken) return NULL;
  for (uint32_t i = 0; i < surface; i++) {
    uint32_t old = body->source_points.at[i];
    if (old >= count || taken[old]) return NULL;
    taken[old] = true;
    old_from_new[i] = old;
  }
  for (uint32_t i = surface, old = 0; i < count; i++, old++) {
    while (taken[old]) old++;
    old_from_new[i] = old;
  }
  return old_from_new;
}

typedef struct tetrahedron_key {
  uint32_t sorted[4], index;
} tetrahedron_key;

static int compare_u32(const void *a, const void *b) {
  uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
  return x < y ? -1 : x > y;
}

static int compare_keys(const void *a, const void *b) {
  return memcmp(a, b, sizeof(uint32_t[4]));
}

static tetrahedron_key key_of(sbf_uint4 points, uint32_t index) {
  tetrahedron_key key = {.index = index};
  memcpy(key.sorted, points.at, sizeof key.sorted);
  qsort(key.sorted, 4, sizeof *key.sorted, compare_u32);
  return key;
}

static void write_lattice(paper_writer *w, const sbf_level *level, const uint32_t *old_from_new) {
  uint32_t count = level->positions.count;
  uint32_t *new_from_old = sbfi_arena_allocate(&w->scratch, count, sizeof *new_from_old);
  if (!new_from_old) {
    w->e->text.failed = true;
    return;
  }
  for (uint32_t i = 0; i < count; i++) new_from_old[old_from_new ? old_from_new[i] : i] = i;
  line(w, 2, "<tetrahedron_mesh target=\"volume\">");
  line(w, 3, "<vertices>");
  for (uint32_t i = 0; i < count; i++)
    position_line(w, 4, "vertex", i + 1, level->positions.at[new_from_old[i]]);
  line(w, 3, "</vertices>");
  line(w, 3, "<tetrahedra>");
  for (uint32_t i = 0; i < level->lattice.tetrahedra.count; i++) {
    line(w, 4, "<tetrahedron>");
    for (int k = 0; k < 4; k++) {
      uint32_t point = level->lattice.tetrahedra.at[i].at[k];
      sbfi_text_repeat(&w->e->text, ' ', 10);
      sbfi_export_format(w->e, "<node v=\"%u\"/>\n", 1 + (old_from_new ? old_from_new[point] : point));
    }
    line(w, 4, "</tetrahedron>");
  }
  line(w, 3, "</tetrahedra>");
  line(w, 2, "</tetrahedron_mesh>");
}

/* Weight of a point in the embedding; duplicates are excluded. */
static float weight_at(const sbf_embedding *embedding, uint32_t i, uint32_t point) {
  const sbf_vec4 weight = embedding->weights.at[i];
  const float weights[4] = {weight.x, weight.y, weight.z, weight.w};
  for (int k = 0; k < 3; k++)
    if (embedding->points.at[i].at[k] == point) return weights[k];
  return weights[3];
}

static void write_barycentric(paper_writer *w, const sbf_level *level, const sbf_embedding *embedding) {
  uint32_t count = level->lattice.tetrahedra.count;
  tetrahedron_key *keys = sbfi_arena_allocate(&w->scratch, count, sizeof *keys);
  if (!keys) {
    w->e->text.failed = true;
    return;
  }
  for (uint32_t i = 0; i < count; i++) keys[i] = key_of(level->lattice.tetrahedra.at[i], i);
  qsort(keys, count, sizeof *keys, compare_keys);
  line(w, 2, "<barycentric>");
  for (uint32_t i = 0; i < embedding->points.count; i++) {
    tetrahedron_key wanted = key_of(embedding->points.at[i], 0);
    const tetrahedron_key *found = bsearch(&wanted, keys, count, sizeof *keys, compare_keys);
    if (!found) {
      w->lost_vertices++;
      continue;
    }
    const uint32_t *nodes = level->lattice.tetrahedra.at[found->index].at;
    uint32_t vertex = embedding->vertices.count ? embedding->vertices.at[i] : i;
    sbfi_export_format(w->e, "      <coord render_id=\"%u\" tetr_id=\"%u\"", vertex + 1, found->index + 1);
    attribute(w, "v0", weight_at(embedding, i, nodes[0]));
    attribute(w, "v1", weight_at(embedding, i, nodes[1]));
    attribute(w, "v2", weight_at(embedding, i, nodes[2]));
    end_line(w);
  }
  line(w, 2, "</barycentric>");
}

/* ---- Soft bodies ---- */

static sbf_status write_attributes(paper_writer *w, const sbf_soft_body *body, const sbf_level *level) {
  sbf_legacy sliders;
  sbf_legacy_init(&sliders);
  if (body->legacy) {
    sliders = *body->legacy;
  } else {
    sbfi_paper_sums sums;
    if (!sbfi_paper_measure(level->positions, level->lattice.tetrahedra, &w->e->allocator, &sums))
      return sbfi_export_no_memory(w->e);
    sbfi_paper_from_si(&body->attributes, &body->collision, &sums, SBFI_PAPER_ITERATIONS, &sliders);
  }
  line(w, 2, "<attributes>");
  value_element(w, 3, "mass", sliders.mass);
  value_element(w, 3, "volume_stiffness", sliders.volume_stiffness);
  value_element(w, 3, "stretching_stiffness", sliders.stretching_stiffness);
  value_element(w, 3, "friction", sliders.friction);
  value_element(w, 3, "particle_radius", sliders.particle_radius);
  sbfi_export_format(w->e, "      <solver_iterations>%u</solver_iterations>\n", sliders.solver_iterations);
  line(w, 2, "</attributes>");
  return SBF_OK;
}

/* Mesh embedded in the level; if none, one with the body's name. */
static const sbf_render_mesh *mesh_of(
    paper_writer *w, const sbf_soft_body *body, const sbf_level *level, const sbf_embedding **embedding) {
  const sbf_asset *asset = w->e->asset;
  *embedding = NULL;
  for (uint32_t i = 0; i < level->embeddings.count; i++) {
    if (level->embeddings.at[i].render_mesh < 0) continue;
    if (*embedding)
      w->lost_embeddings++;
    else
      *embedding = &level->embeddings.at[i];
  }
  if (*embedding) return &asset->render_meshes.at[(*embedding)->render_mesh];
  for (uint32_t i = 0; i < asset->render_meshes.count; i++)
    if (*body->name && strcmp(asset->render_meshes.at[i].name, body->name) == 0)
      return &asset->render_meshes.at[i];
  return NULL;
}

static sbf_status write_soft_body(paper_writer *w, const sbf_soft_body *body, const sbf_level *level) {
  const sbf_embedding *embedding;
  const sbf_render_mesh *mesh = mesh_of(w, body, level, &embedding);
  line(w, 1, "<soft_body>");
  write_lattice(w, level, source_order(w, body, level));
  if (mesh) write_render_mesh(w, mesh);
  if (embedding) write_barycentric(w, level, embedding);
  sbf_status status = write_attributes(w, body, level);
  line(w, 1, "</soft_body>");
  return status;
}

/* ---- Rigid bodies and joints ---- */

/* Bodies read from this dialect are named by their number; otherwise they count from 1. */
static uint32_t *body_numbers(paper_writer *w) {
  sbf_rigid_body_list bodies = w->e->asset->rigid_bodies;
  uint32_t *numbers = sbfi_arena_allocate(&w->scratch, bodies.count, sizeof *numbers);
  uint32_t *sorted = sbfi_arena_allocate(&w->scratch, bodies.count, sizeof *sorted);
  if (!numbers || !sorted) return NULL;
  bool named = true;
  for (uint32_t i = 0; i < bodies.count; i++) {
    const char *name = bodies.at[i].name;
    named = named && sbfi_parse_u32(name, strlen(name), &numbers[i]) == SBFI_NUMBER_READ && numbers[i] > 0;
    sorted[i] = numbers[i];
  }
  qsort(sorted, bodies.count, sizeof *sorted, compare_u32);
  for (uint32_t i = 1; i < bodies.count; i++) named = named && sorted[i] != sorted[i - 1];
  for (uint32_t i = 0; i < bodies.count && !named; i++) numbers[i] = i + 1;
  return numbers;
}

static float mass_of(const sbf_rigid_body *body) {
  sbf_solid solid;
  if (body->mass > 0 || !body->hull) return body->mass;
  sbf_solid_measure(body->hull, &solid);
  return (float)((double)body->density * solid.volume);
}

static void write_rigid_body(paper_writer *w, const sbf_rigid_body *body, uint32_t number) {
  sbfi_export_format(w->e, "    <rigid_body id=\"%u\">\n", number);
  if (body->hull) {
    line(w, 3, "<polygon_mesh target=\"collision_detection\">");
    write_vertices(w, 4, body->hull->positions);
    write_faces(w, 4, body->hull, NULL);
    line(w, 3, "</polygon_mesh>");
  }
  line(w, 3, "<attributes>");
  value_element(w, 4, "mass", mass_of(body));
  value_element(w, 4, "friction", body->friction);
  line(w, 3, "</attributes>");
  line(w, 2, "</rigid_body>");
}

/* Shortest number of degrees that converts back to these radians. */
static float degrees_of(float radians) {
  double exact = (double)radians / DEGREE;
  for (double scale = 1; scale < 1e7; scale *= 10) {
    float rounded = (float)(floor(exact * scale + 0.5) / scale);
    if ((float)((double)rounded * DEGREE) == radians) return rounded;
  }
  return (float)exact;
}

static void write_limit(paper_writer *w, const sbf_limit *limit, const char *target) {
  bool is_length = limit->target <= SBF_JOINT_AXIS_LINEAR_Z || limit->target == SBF_JOINT_AXIS_DISTANCE;
  bool one_sided = limit->target == SBF_JOINT_AXIS_SWING || limit->target == SBF_JOINT_AXIS_DISTANCE;
  float max = limit->max > -limit->min || one_sided ? limit->max : -limit->min;
  if (one_sided ? limit->min != 0 : limit->min != -limit->max) w->skewed_limits++;
  sbfi_text_repeat(&w->e->text, ' ', 10);
  sbfi_export_format(w->e, "<limit target=\"%s\"", target);
  attribute(w, "angle", is_length ? max : degrees_of(max));
  end_line(w);
}

static void write_joint(paper_writer *w, const sbf_joint *joint, const uint32_t *numbers) {
  const sbfi_field *joints = sbfi_element_field(&sbfi_asset_element, "joints");
  const char *const *kinds = sbfi_element_field(joints->element, "kind")->words.at;
  const sbfi_field *limits = sbfi_element_field(joints->element, "limits");
  const char *const *targets = sbfi_element_field(limits->element, "target")->words.at;
  const char *kind = kinds[joint->kind];
  sbfi_export_format(w->e, "      <%s_joint", kind);
  if (joint->body_a >= 0) sbfi_export_format(w->e, " r1=\"%u\"", numbers[joint->body_a]);
  sbfi_export_format(w->e, " r2=\"%u\"", numbers[joint->body_b]);
  if (!joint->limits.count) {
    end_line(w);
    return;
  }
  sbfi_text_string(&w->e->text, ">\n");
  line(w, 4, "<limits>");
  for (uint32_t i = 0; i < joint->limits.count; i++)
    write_limit(w, &joint->limits.at[i], targets[joint->limits.at[i].target]);
  line(w, 4, "</limits>");
  sbfi_export_format(w->e, "      </%s_joint>\n", kind);
}

static sbf_status write_skeleton(paper_writer *w) {
  const sbf_asset *asset = w->e->asset;
  if (!asset->rigid_bodies.count) return SBF_OK;
  const uint32_t *numbers = body_numbers(w);
  if (!numbers) return sbfi_export_no_memory(w->e);
  line(w, 1, "<rigid_bodies>");
  for (uint32_t i = 0; i < asset->rigid_bodies.count; i++)
    write_rigid_body(w, &asset->rigid_bodies.at[i], numbers[i]);
  if (asset->joints.count) {
    line(w, 2, "<joints>");
    for (uint32_t i = 0; i < asset->joints.count; i++) write_joint(w, &asset->joints.at[i], numbers);
    line(w, 2, "</joints>");
  }
  line(w, 1, "</rigid_bodies>");
  return SBF_OK;
}

/* ---- The document ---- */

static void report_unsupported(paper_writer *w, uint32_t without_lattice) {
  const sbf_asset *a = w->e->asset;
  uint32_t drives = 0;
  for (uint32_t i = 0; i < a->joints.count; i++) drives += a->joints.at[i].drives.count;
  const sbfi_left_out things[] = {{without_lattice, "soft bodies without tetrahedra"},
      {w->lost_vertices, "vertices that are not embedded in a tetrahedron"},
      {w->lost_embeddings, "further embeddings"},
      {w->skewed_limits, "minima of limits that are not symmetric"}, {drives, "drives of joints"},
      {a->bones.count, "bones"}, {a->materials.count, "materials"}, {a->cross_springs.count, "cross springs"},
      {a->ik_chains.count, "IK chains"}, {a->gaits.count, "gaits"}, {a->clips.count, "clips"}};
  sbfi_export_left_out(w->e, "the 2012 dialect", things, sizeof things / sizeof *things);
}

static sbf_status write_model(paper_writer *w) {
  const sbf_asset *asset = w->e->asset;
  uint32_t without_lattice = 0;
  sbf_status status = SBF_OK;
  line(w, 0, "<?xml version=\"1.0\" encoding=\"utf-8\"?>");
  line(w, 0, "<model>");
  for (uint32_t i = 0; i < asset->soft_bodies.count && status == SBF_OK; i++) {
    const sbf_level *level = sbfi_export_lattice(&asset->soft_bodies.at[i]);
    if (level)
      status = write_soft_body(w, &asset->soft_bodies.at[i], level);
    else
      without_lattice++;
  }
  if (status == SBF_OK) status = write_skeleton(w);
  if (status != SBF_OK) return status;
  line(w, 0, "</model>");
  if (without_lattice == asset->soft_bodies.count && !asset->rigid_bodies.count)
    return sbfi_diagnose(w->e->error, SBF_CODE_EXPORT_EMPTY,
        "the file has neither tetrahedra nor rigid bodies: there is nothing to write to %s", w->e->path);
  report_unsupported(w, without_lattice);
  return sbfi_export_commit(w->e, w->e->path);
}

sbf_status sbfi_export_paper(sbfi_export *e) {
  paper_writer w = {.e = e};
  sbfi_arena_init(&w.scratch, &e->allocator, 0);
  sbf_status status = write_model(&w);
  sbfi_arena_free(&w.scratch);
  return status;
}
