/* Parses the text of the 2012 dialect, event by event. */
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/number.h"
#include "import/paper/dialect2012.h"
#include "import/quote.h"
#include "model/schema.h"
#include "xml/xml_events.h"

typedef enum location {
  OUTSIDE,
  MODEL,
  SOFT_BODY,
  LATTICE,
  LATTICE_VERTICES,
  LATTICE_VERTEX,
  TETRAHEDRA,
  TETRAHEDRON,
  TETRAHEDRON_NODE,
  SURFACE,
  VERTICES,
  VERTEX,
  COORDINATES,
  COORDINATE,
  NORMALS,
  NORMAL,
  FACES,
  FACE,
  FACE_NODE,
  BARYCENTRIC,
  EMBEDDED,
  ATTRIBUTES,
  ATTRIBUTE,
  RIGID_BODIES,
  RIGID_BODY,
  JOINTS,
  JOINT,
  LIMITS,
  LIMIT,
  PASSED_OVER
} location;

/* Transitions: which element may be inside which, and what it means. Joints and attributes are recognized
 * by separate rules. */
static const struct {
  location inside;
  const char *name;
  location is;
} steps[] = {
    {OUTSIDE, "model", MODEL},
    {MODEL, "soft_body", SOFT_BODY},
    {MODEL, "rigid_bodies", RIGID_BODIES},
    {MODEL, "joints", JOINTS},
    {SOFT_BODY, "tetrahedron_mesh", LATTICE},
    {SOFT_BODY, "polygon_mesh", SURFACE},
    {SOFT_BODY, "barycentric", BARYCENTRIC},
    {SOFT_BODY, "attributes", ATTRIBUTES},
    {LATTICE, "vertices", LATTICE_VERTICES},
    {LATTICE, "tetrahedra", TETRAHEDRA},
    {LATTICE_VERTICES, "vertex", LATTICE_VERTEX},
    {TETRAHEDRA, "tetrahedron", TETRAHEDRON},
    {TETRAHEDRON, "node", TETRAHEDRON_NODE},
    {SURFACE, "vertices", VERTICES},
    {SURFACE, "texture_coords", COORDINATES},
    {SURFACE, "normals", NORMALS},
    {SURFACE, "faces", FACES},
    {VERTICES, "vertex", VERTEX},
    {COORDINATES, "coord", COORDINATE},
    {NORMALS, "vector", NORMAL},
    {FACES, "face", FACE},
    {FACE, "node", FACE_NODE},
    {BARYCENTRIC, "coord", EMBEDDED},
    {RIGID_BODIES, "rigid_body", RIGID_BODY},
    {RIGID_BODIES, "joints", JOINTS},
    {RIGID_BODY, "polygon_mesh", SURFACE},
    {RIGID_BODY, "attributes", ATTRIBUTES},
    {JOINT, "limits", LIMITS},
    {LIMITS, "limit", LIMIT},
};
static const char *const attribute_names[SBFI_PAPER_ATTRIBUTES] = {
    "mass", "volume_stiffness", "stretching_stiffness", "friction", "particle_radius", "solver_iterations"};

enum { DEEPEST = 16, NUMBER_TEXT = 64 };

typedef struct paper_reader {
  sbfi_paper_model *model;
  sbfi_xml_events events;
  location stack[DEEPEST];
  uint32_t depth, passed_over_depth; /* number of open elements; depth within a skipped element */
  sbfi_paper_body *body;
  uint32_t nodes_of_tetrahedron;
  sbfi_paper_attribute attribute;
  char text[NUMBER_TEXT]; /* of an attribute */
  size_t text_length;
  sbf_diagnostic *error;
  sbf_status status;
} paper_reader;

static bool fail(paper_reader *r, sbf_code code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
static bool fail(paper_reader *r, sbf_code code, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  r->status = sbfi_diagnose_v(r->error, code, format, arguments);
  va_end(arguments);
  if (r->error) r->error->line = r->events.line;
  return false;
}

static void *push(paper_reader *r, sbfi_array *array) {
  void *item = array->count < UINT32_MAX ? sbfi_array_push(array, 1) : NULL;
  if (!item) fail(r, SBF_CODE_OUT_OF_MEMORY, "memory ran out while the file was read");
  return item;
}

/* ---- Attributes ---- */

typedef struct attribute_list {
  const sbfi_xml_attribute *at;
  uint32_t count;
} attribute_list;

static sbfi_span value_of(attribute_list attributes, const char *name) {
  for (uint32_t i = 0; i < attributes.count; i++)
    if (strcmp(attributes.at[i].name, name) == 0)
      return sbfi_span_trim((sbfi_span){attributes.at[i].value, attributes.at[i].length});
  return (sbfi_span){NULL, 0};
}

static bool read_f32(paper_reader *r, sbfi_span text, const char *name, float *value) {
  if (text.at && sbfi_parse_f32(text.at, text.length, value) == SBFI_NUMBER_READ) return true;
  return fail(r, SBF_CODE_XML_BAD_VALUE, "%s is not a number: \"%s\"", name, sbfi_quote_of(text).text);
}

/* `fallback` is the value of a missing attribute; 0: it is required. */
static bool read_id(
    paper_reader *r, attribute_list attributes, const char *name, uint32_t fallback, uint32_t *value) {
  sbfi_span text = value_of(attributes, name);
  *value = fallback;
  if (!text.at && fallback) return true;
  if (text.at && sbfi_parse_u32(text.at, text.length, value) == SBFI_NUMBER_READ && *value > 0) return true;
  return fail(
      r, SBF_CODE_XML_BAD_VALUE, "%s is not a whole number above 0: \"%s\"", name, sbfi_quote_of(text).text);
}

static bool read_item(paper_reader *r, sbfi_paper_items *items, attribute_list attributes,
    const char *const *names, uint32_t width) {
  float *value = push(r, &items->values);
  uint32_t *id = value ? push(r, &items->ids) : NULL;
  if (!id || !read_id(r, attributes, "id", (uint32_t)items->ids.count, id)) return false;
  for (uint32_t k = 0; k < width; k++)
    if (!read_f32(r, value_of(attributes, names[k]), names[k], &value[k])) return false;
  return true;
}

static bool read_corner(paper_reader *r, attribute_list attributes) {
  sbfi_paper_surface *surface = &r->body->surface;
  sbfi_paper_corner *corner = push(r, &surface->corners);
  if (!corner || !read_id(r, attributes, "v", 0, &corner->vertex)) return false;
  if (value_of(attributes, "n").at && !read_id(r, attributes, "n", 0, &corner->normal)) return false;
  if (value_of(attributes, "t").at && !read_id(r, attributes, "t", 0, &corner->coordinate)) return false;
  ((uint32_t *)surface->sizes.at)[surface->sizes.count - 1]++;
  return true;
}

static bool read_node(paper_reader *r, attribute_list attributes) {
  if (++r->nodes_of_tetrahedron > 4)
    return fail(r, SBF_CODE_WRONG_LENGTH, "a tetrahedron has more than four nodes");
  uint32_t *node = push(r, &r->body->nodes);
  return node && read_id(r, attributes, "v", 0, node);
}

static bool read_embedding(paper_reader *r, attribute_list attributes) {
  static const char *const names[3] = {"v0", "v1", "v2"};
  sbfi_paper_embedding *embedded_vertices = push(r, &r->body->embedded_vertices);
  if (!embedded_vertices || !read_id(r, attributes, "render_id", 0, &embedded_vertices->vertex) ||
      !read_id(r, attributes, "tetr_id", 0, &embedded_vertices->tetrahedron))
    return false;
  for (int k = 0; k < 3; k++)
    if (!read_f32(r, value_of(attributes, names[k]), names[k], &embedded_vertices->weights[k])) return false;
  return true;
}

static bool read_joint(paper_reader *r, attribute_list attributes, sbf_joint_kind kind) {
  sbfi_paper_joint *joint = push(r, &r->model->joints);
  if (!joint) return false;
  joint->kind = kind;
  joint->first_limit = (uint32_t)r->model->limits.count;
  if (value_of(attributes, "r1").at && !read_id(r, attributes, "r1", 0, &joint->bodies[0])) return false;
  return read_id(r, attributes, "r2", 0, &joint->bodies[1]);
}

static const sbfi_field *target_field(void) {
  const sbfi_field *joints = sbfi_element_field(&sbfi_asset_element, "joints");
  return sbfi_element_field(sbfi_element_field(joints->element, "limits")->element, "target");
}

static bool read_limit(paper_reader *r, attribute_list attributes) {
  const sbfi_field *field = target_field();
  sbfi_span target = value_of(attributes, "target");
  uint32_t word = 0;
  while (word < field->words.count && !(target.at && sbfi_span_is(target, field->words.at[word]))) word++;
  if (word == field->words.count)
    return fail(r, SBF_CODE_XML_BAD_VALUE, "\"%s\" is not a motion that a joint can limit",
        sbfi_quote_of(target).text);
  sbfi_paper_limit *limit = push(r, &r->model->limits);
  if (!limit || !read_f32(r, value_of(attributes, "angle"), "angle", &limit->angle)) return false;
  limit->target = (sbf_joint_axis)word;
  sbfi_paper_joint *joints = r->model->joints.at;
  joints[r->model->joints.count - 1].limit_count++;
  return true;
}

/* ---- Elements ---- */

static void init_body(sbfi_paper_body *body, const sbf_allocator *allocator) {
  sbfi_paper_items *items[] = {
      &body->lattice, &body->surface.vertices, &body->surface.normals, &body->surface.coordinates};
  for (size_t i = 0; i < sizeof items / sizeof *items; i++) {
    sbfi_array_init(&items[i]->ids, allocator, sizeof(uint32_t));
    sbfi_array_init(&items[i]->values, allocator, i == 3 ? sizeof(sbf_vec2) : sizeof(sbf_vec3));
  }
  sbfi_array_init(&body->nodes, allocator, sizeof(uint32_t));
  sbfi_array_init(&body->tetrahedron_ids, allocator, sizeof(uint32_t));
  sbfi_array_init(&body->surface.sizes, allocator, sizeof(uint32_t));
  sbfi_array_init(&body->surface.corners, allocator, sizeof(sbfi_paper_corner));
  sbfi_array_init(&body->embedded_vertices, allocator, sizeof(sbfi_paper_embedding));
}

static void free_bodies(sbfi_array *bodies) {
  for (size_t i = 0; i < bodies->count; i++) {
    sbfi_paper_body *b = (sbfi_paper_body *)bodies->at + i;
    sbfi_array *arrays[] = {&b->lattice.ids, &b->lattice.values, &b->nodes, &b->tetrahedron_ids,
        &b->surface.vertices.ids, &b->surface.vertices.values, &b->surface.normals.ids,
        &b->surface.normals.values, &b->surface.coordinates.ids, &b->surface.coordinates.values,
        &b->surface.sizes, &b->surface.corners, &b->embedded_vertices};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++) sbfi_array_free(arrays[k]);
  }
  sbfi_array_free(bodies);
}

void sbfi_paper_free(sbfi_paper_model *model) {
  free_bodies(&model->soft_bodies);
  free_bodies(&model->rigid_bodies);
  sbfi_array_free(&model->joints);
  sbfi_array_free(&model->limits);
}

static bool begin_body(paper_reader *r, sbfi_array *bodies, attribute_list attributes) {
  r->body = push(r, bodies);
  if (!r->body) return false;
  init_body(r->body, &r->model->allocator);
  return read_id(r, attributes, "id", (uint32_t)bodies->count, &r->body->id);
}

static bool begin_tetrahedron(paper_reader *r, attribute_list attributes) {
  uint32_t *id = push(r, &r->body->tetrahedron_ids);
  r->nodes_of_tetrahedron = 0;
  return id && read_id(r, attributes, "id", (uint32_t)r->body->tetrahedron_ids.count, id);
}

static bool begin(paper_reader *r, location is, attribute_list attributes) {
  static const char *const xyz[3] = {"x", "y", "z"}, *const uv[2] = {"u", "v"};
  switch (is) {
  case SOFT_BODY:
    return begin_body(r, &r->model->soft_bodies, attributes);
  case RIGID_BODY:
    return begin_body(r, &r->model->rigid_bodies, attributes);
  case LATTICE_VERTEX:
    return read_item(r, &r->body->lattice, attributes, xyz, 3);
  case VERTEX:
    return read_item(r, &r->body->surface.vertices, attributes, xyz, 3);
  case NORMAL:
    return read_item(r, &r->body->surface.normals, attributes, xyz, 3);
  case COORDINATE:
    return read_item(r, &r->body->surface.coordinates, attributes, uv, 2);
  case TETRAHEDRON:
    return begin_tetrahedron(r, attributes);
  case TETRAHEDRON_NODE:
    return read_node(r, attributes);
  case FACE:
    return push(r, &r->body->surface.sizes) != NULL;
  case FACE_NODE:
    return read_corner(r, attributes);
  case EMBEDDED:
    return read_embedding(r, attributes);
  case LIMIT:
    return read_limit(r, attributes);
  default:
    return true;
  }
}

static void skip_element(paper_reader *r, const char *name) {
  if (r->model->ignored_count++ == 0) {
    r->model->ignored_line = r->events.line;
    sbfi_copy_text(r->model->ignored_name, sizeof r->model->ignored_name, name);
  }
}

static location step_to(paper_reader *r, const char *name) {
  location inside = r->depth ? r->stack[r->depth - 1] : OUTSIDE;
  for (size_t i = 0; i < sizeof steps / sizeof *steps; i++)
    if (steps[i].inside == inside && strcmp(steps[i].name, name) == 0) return steps[i].is;
  if (inside == ATTRIBUTES)
    for (int i = 0; i < SBFI_PAPER_ATTRIBUTES; i++)
      if (strcmp(attribute_names[i], name) == 0) {
        r->attribute = (sbfi_paper_attribute)i;
        r->text_length = 0;
        return ATTRIBUTE;
      }
  return inside == JOINTS ? JOINT : PASSED_OVER;
}

/* KIND_joint, or -1. */
static int joint_kind(const char *name) {
  const sbfi_field *joints = sbfi_element_field(&sbfi_asset_element, "joints");
  const sbfi_field *kind = sbfi_element_field(joints->element, "kind");
  for (uint32_t i = 0; i < kind->words.count; i++) {
    size_t length = strlen(kind->words.at[i]);
    if (strncmp(name, kind->words.at[i], length) == 0 && strcmp(name + length, joints->tag.suffix) == 0)
      return (int)i;
  }
  return -1;
}

static bool on_start(void *user, const char *name, const sbfi_xml_attribute *at, uint32_t count) {
  paper_reader *r = user;
  attribute_list attributes = {at, count};
  if (r->passed_over_depth) {
    r->passed_over_depth++;
    return true;
  }
  location is = step_to(r, name);
  int kind = is == JOINT ? joint_kind(name) : 0;
  if (r->depth == 0 && is != MODEL)
    return fail(r, SBF_CODE_IO_UNKNOWN_FORMAT, "the root is <%.64s>, not <model>", name);
  if (is == PASSED_OVER || kind < 0) {
    skip_element(r, name);
    r->passed_over_depth = 1;
    return true;
  }
  r->stack[r->depth++] = is; /* no path through `steps` is longer than DEEPEST */
  return is == JOINT ? read_joint(r, attributes, (sbf_joint_kind)kind) : begin(r, is, attributes);
}

static bool on_text(void *user, const char *text, size_t length) {
  paper_reader *r = user;
  if (r->passed_over_depth || !r->depth || r->stack[r->depth - 1] != ATTRIBUTE) {
    if (r->passed_over_depth || sbfi_span_trim((sbfi_span){text, length}).length == 0) return true;
    return fail(r, SBF_CODE_XML_STRAY_TEXT, "found text where only elements are allowed");
  }
  if (length > NUMBER_TEXT - r->text_length)
    return fail(r, SBF_CODE_XML_BAD_VALUE, "%s is not a number", attribute_names[r->attribute]);
  memcpy(r->text + r->text_length, text, length);
  r->text_length += length;
  return true;
}

static bool end_attribute(paper_reader *r) {
  const char *name = attribute_names[r->attribute];
  float *value = &r->body->attributes[r->attribute];
  if (!read_f32(r, sbfi_span_trim((sbfi_span){r->text, r->text_length}), name, value)) return false;
  if (*value < 0) return fail(r, SBF_CODE_VALUE_OUT_OF_RANGE, "%s is below 0", name);
  if (r->attribute == SBFI_PAPER_SOLVER_ITERATIONS && *value > 1e6f)
    return fail(r, SBF_CODE_VALUE_OUT_OF_RANGE, "%s is above a million", name);
  r->body->given[r->attribute] = true;
  return true;
}

static bool on_end(void *user) {
  paper_reader *r = user;
  if (r->passed_over_depth) {
    r->passed_over_depth--;
    return true;
  }
  location was = r->stack[--r->depth];
  if (was == TETRAHEDRON && r->nodes_of_tetrahedron != 4)
    return fail(r, SBF_CODE_WRONG_LENGTH, "a tetrahedron has %u nodes, not four", r->nodes_of_tetrahedron);
  if (was == FACE) {
    const sbfi_array *sizes = &r->body->surface.sizes;
    if (((const uint32_t *)sizes->at)[sizes->count - 1] < 3)
      return fail(r, SBF_CODE_IMPORT_POLYGON, "a face has fewer than three nodes");
  }
  return was == ATTRIBUTE ? end_attribute(r) : true;
}

static sbf_status parse(
    const char *path, sbfi_xml_events *events, const sbf_allocator *allocator, sbf_diagnostic *error) {
  sbfi_file file;
  sbf_status status = sbfi_file_open(path, &file, error);
  if (status != SBF_OK) return status;
  status = sbfi_xml_parse(&(sbfi_xml_source){.file = &file, .size = file.size}, events, allocator, error);
  sbfi_file_close(&file);
  return status;
}

sbf_status sbfi_paper_read(
    sbfi_paper_model *model, const char *path, const sbf_allocator *allocator, sbf_diagnostic *error) {
  *model = (sbfi_paper_model){.allocator = sbfi_allocator_or_default(allocator)};
  sbfi_array_init(&model->soft_bodies, allocator, sizeof(sbfi_paper_body));
  sbfi_array_init(&model->rigid_bodies, allocator, sizeof(sbfi_paper_body));
  sbfi_array_init(&model->joints, allocator, sizeof(sbfi_paper_joint));
  sbfi_array_init(&model->limits, allocator, sizeof(sbfi_paper_limit));
  paper_reader r = {.model = model, .events = {on_start, on_text, on_end, NULL, 0}, .error = error};
  r.events.user = &r;
  sbf_status status = parse(path, &r.events, allocator, error);
  if (status == SBF_OK) status = r.status;
  if (status == SBF_OK) return SBF_OK;
  if (error) sbfi_copy_text(error->file, sizeof error->file, path);
  sbfi_paper_free(model);
  return status;
}

/* ---- Which dialect ---- */

static bool peek_root(void *user, const char *name, const sbfi_xml_attribute *attributes, uint32_t count) {
  bool **is_model = user;
  (void)attributes, (void)count;
  **is_model = strcmp(name, "model") == 0;
  return false;
}
static bool peek_text(void *user, const char *text, size_t length) {
  (void)user, (void)text, (void)length;
  return true;
}
static bool peek_end(void *user) {
  (void)user;
  return true;
}

bool sbfi_paper_supports(const char *path) {
  size_t length = strlen(path);
  bool is_model = false, *seen = &is_model;
  if (length < 5 || strcmp(path + length - 4, ".xml") != 0) return false;
  sbfi_xml_events events = {peek_root, peek_text, peek_end, &seen, 0};
  return parse(path, &events, NULL, NULL) == SBF_OK && is_model;
}
