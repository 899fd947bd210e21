/* Reads Gmsh .msh: version 1 ($NOD, $ELM), 2.2 and 4.1, text or binary. Node numbers may have gaps;
 * elements other than linear tetrahedra (type 4) are skipped. */
#include <stdlib.h>
#include <string.h>

#include "import/tetrahedra/tet_mesh.h"

enum { GMSH_TETRAHEDRON = 4 };

/* Number of nodes of an element by Gmsh's type; 0: unknown type. */
static uint32_t nodes_of_type(uint32_t type) {
  static const uint8_t counts[] = {0, 2, 3, 4, 4, 8, 6, 5, 3, 6, 9, 10, 27, 18, 14, 1, 8, 20, 15, 13};
  return type < sizeof counts ? counts[type] : 0;
}

typedef struct numbered {
  uint64_t number;
  uint32_t index;
} numbered;

typedef struct gmsh {
  sbfi_word_reader *r;
  sbfi_tet_mesh *mesh;
  sbfi_array numbers; /* numbered, sorted after all nodes are read */
  bool binary;
  unsigned version; /* 1, 2, 4 */
} gmsh;

static int compare_numbers(const void *a, const void *b) {
  const numbered *x = a, *y = b;
  return x->number < y->number ? -1 : x->number > y->number;
}

static bool position_of(gmsh *g, uint64_t number, uint32_t *slots) {
  numbered wanted = {number, 0};
  const numbered *found =
      g->numbers.count ? bsearch(&wanted, g->numbers.at, g->numbers.count, sizeof(numbered), compare_numbers)
                       : NULL;
  if (!found)
    return sbfi_word_fail(g->r, SBF_CODE_IMPORT_INDEX, "an element names node %llu, which does not exist",
        (unsigned long long)number);
  *slots = found->index;
  return true;
}

static bool read_u32(gmsh *g, uint32_t *value, const char *what) {
  return g->binary ? sbfi_binary_u32(g->r, value, what) : sbfi_word_u32(g->r, value, what);
}

/* Counts and numbers of version 4 are 64 bits wide in binary files. */
static bool read_wide(gmsh *g, uint64_t *value, const char *what) {
  uint32_t narrow = 0;
  if (g->binary && g->version == 4) return sbfi_binary_u64(g->r, value, what);
  if (!read_u32(g, &narrow, what)) return false;
  *value = narrow;
  return true;
}

static bool read_tag(gmsh *g, const char *what) {
  uint32_t ignored;
  int32_t signed_value;
  return g->binary ? sbfi_binary_u32(g->r, &ignored, what) : sbfi_word_i32(g->r, &signed_value, what);
}

static bool check_count(gmsh *g, uint64_t count, uint32_t min_bytes, const char *what) {
  if (count <= (size_t)(g->r->end - g->r->at) / min_bytes + 1) return true;
  return sbfi_word_fail(g->r, SBF_CODE_IMPORT_SYNTAX,
      "a count of %llu is more than the rest of the file can contain (%s)", (unsigned long long)count, what);
}

static bool read_position(gmsh *g, sbf_vec3 *point) {
  float *out[3] = {&point->x, &point->y, &point->z};
  for (int k = 0; k < 3; k++) {
    double wide;
    if (!g->binary) {
      if (!sbfi_word_f32(g->r, out[k], "a node's place")) return false;
      continue;
    }
    if (!sbfi_binary_f64(g->r, &wide, "a node's place")) return false;
    *out[k] = (float)wide;
  }
  return true;
}

static bool add_number(gmsh *g, uint64_t number) {
  numbered *slot = sbfi_word_push(g->r, &g->numbers, 1);
  if (!slot) return false;
  *slot = (numbered){number, (uint32_t)g->numbers.count - 1};
  return true;
}

/* Versions 1 and 2: a count, then number and position of each node. */
static bool read_nodes_plain(gmsh *g) {
  uint32_t count, number;
  sbfi_span rest;
  if (!sbfi_word_count(g->r, &count, 7, "the nodes")) return false;
  if (g->binary) sbfi_word_line(g->r, &rest);
  for (uint32_t i = 0; i < count; i++) {
    sbf_vec3 *point = sbfi_word_push(g->r, &g->mesh->points, 1);
    if (!point || !read_u32(g, &number, "a node's number") || !add_number(g, number) ||
        !read_position(g, point))
      return false;
  }
  return true;
}

/* Version 4: blocks, each with all numbers followed by all positions. */
static bool read_nodes_blocks(gmsh *g) {
  uint64_t blocks, total, min, max, count, number;
  uint32_t parametric;
  if (!read_wide(g, &blocks, "the blocks of nodes") || !read_wide(g, &total, "the nodes") ||
      !read_wide(g, &min, "the least number") || !read_wide(g, &max, "the greatest number") ||
      !check_count(g, blocks, 4, "the blocks of nodes"))
    return false;
  for (uint64_t b = 0; b < blocks; b++) {
    if (!read_tag(g, "a block's dimension") || !read_tag(g, "a block's entity") ||
        !read_u32(g, &parametric, "a block's kind") || !read_wide(g, &count, "a block's nodes") ||
        !check_count(g, count, 7, "a block's nodes"))
      return false;
    if (parametric)
      return sbfi_word_fail(
          g->r, SBF_CODE_IMPORT_REFUSED, "nodes with parameters are not supported: save without them");
    for (uint64_t i = 0; i < count; i++)
      if (!read_wide(g, &number, "a node's number") || !add_number(g, number)) return false;
    for (uint64_t i = 0; i < count; i++) {
      sbf_vec3 *point = sbfi_word_push(g->r, &g->mesh->points, 1);
      if (!point || !read_position(g, point)) return false;
    }
  }
  return true;
}

/* Reads the nodes of one element; adds it if it is a tetrahedron. */
static bool read_element_nodes(gmsh *g, uint32_t type, uint32_t count) {
  sbf_uint4 tetrahedron = {{0}};
  for (uint32_t k = 0; k < count; k++) {
    uint64_t number;
    if (!read_wide(g, &number, "an element's node")) return false;
    if (type == GMSH_TETRAHEDRON && !position_of(g, number, &tetrahedron.at[k])) return false;
  }
  if (type != GMSH_TETRAHEDRON) {
    g->mesh->passed_over++;
    return true;
  }
  sbf_uint4 *position = sbfi_word_push(g->r, &g->mesh->tetrahedra, 1);
  if (position) *position = tetrahedron;
  return position != NULL;
}

static bool unknown_type(gmsh *g, uint32_t type) {
  return sbfi_word_fail(g->r, SBF_CODE_IMPORT_REFUSED, "elements of type %u are not known", type);
}

/* Version 1: number, type, two tags, count, nodes. Version 2: number, type, tag count, tags, nodes. */
static bool read_elements_text(gmsh *g, uint32_t count) {
  for (uint32_t i = 0; i < count; i++) {
    uint32_t number, type, tags = 2, nodes;
    if (!sbfi_word_u32(g->r, &number, "an element's number") ||
        !sbfi_word_u32(g->r, &type, "an element's type") ||
        (g->version == 2 && !sbfi_word_u32(g->r, &tags, "an element's tags")))
      return false;
    for (uint32_t t = 0; t < tags; t++)
      if (!read_tag(g, "an element's tag")) return false;
    nodes = nodes_of_type(type);
    if (g->version == 1 && !sbfi_word_u32(g->r, &nodes, "an element's nodes")) return false;
    if (nodes == 0 || (type == GMSH_TETRAHEDRON && nodes != 4)) return unknown_type(g, type);
    if (!read_element_nodes(g, type, nodes)) return false;
  }
  return true;
}

/* Version 2, binary: runs of elements with equal type and number of tags. */
static bool read_elements_runs(gmsh *g, uint32_t count) {
  for (uint32_t done = 0; done < count;) {
    uint32_t type, run, tags, number;
    if (!read_u32(g, &type, "a run's type") || !read_u32(g, &run, "a run's length") ||
        !read_u32(g, &tags, "a run's tags"))
      return false;
    if (nodes_of_type(type) == 0) return unknown_type(g, type);
    if (run == 0 || run > count - done)
      return sbfi_word_fail(
          g->r, SBF_CODE_IMPORT_SYNTAX, "a block of %u elements does not match the count", run);
    for (uint32_t i = 0; i < run; i++) {
      if (!read_u32(g, &number, "an element's number")) return false;
      for (uint32_t t = 0; t < tags; t++)
        if (!read_tag(g, "an element's tag")) return false;
      if (!read_element_nodes(g, type, nodes_of_type(type))) return false;
    }
    done += run;
  }
  return true;
}

static bool read_elements_plain(gmsh *g) {
  uint32_t count;
  sbfi_span rest;
  if (!sbfi_word_count(g->r, &count, 6, "the elements")) return false;
  if (!g->binary) return read_elements_text(g, count);
  sbfi_word_line(g->r, &rest);
  return read_elements_runs(g, count);
}

static bool read_elements_blocks(gmsh *g) {
  uint64_t blocks, total, min, max, count, number;
  uint32_t type;
  if (!read_wide(g, &blocks, "the blocks of elements") || !read_wide(g, &total, "the elements") ||
      !read_wide(g, &min, "the least number") || !read_wide(g, &max, "the greatest number") ||
      !check_count(g, blocks, 4, "the blocks of elements"))
    return false;
  for (uint64_t b = 0; b < blocks; b++) {
    if (!read_tag(g, "a block's dimension") || !read_tag(g, "a block's entity") ||
        !read_u32(g, &type, "a block's type") || !read_wide(g, &count, "a block's elements") ||
        !check_count(g, count, 4, "a block's elements"))
      return false;
    if (nodes_of_type(type) == 0) return unknown_type(g, type);
    for (uint64_t i = 0; i < count; i++)
      if (!read_wide(g, &number, "an element's number") || !read_element_nodes(g, type, nodes_of_type(type)))
        return false;
  }
  return true;
}

static bool read_format(gmsh *g) {
  float version;
  uint32_t binary, size, one;
  sbfi_span rest;
  if (!sbfi_word_f32(g->r, &version, "the version") || !sbfi_word_u32(g->r, &binary, "the kind of file") ||
      !sbfi_word_u32(g->r, &size, "the size of numbers"))
    return false;
  g->version = version >= 4 ? 4 : 2;
  if (version != 2.2f && version != 2.1f && version != 2 && version != 4.1f)
    return sbfi_word_fail(g->r, SBF_CODE_IMPORT_REFUSED,
        "version %.3g is not supported: save the mesh as 2.2 or 4.1", (double)version);
  if (size != 8)
    return sbfi_word_fail(g->r, SBF_CODE_IMPORT_REFUSED, "numbers of %u bytes are not supported", size);
  g->binary = binary == 1;
  if (!g->binary) return true;
  sbfi_word_line(g->r, &rest);
  if (!sbfi_binary_u32(g->r, &one, "the byte order mark")) return false;
  g->r->swap_bytes = one != 1;
  return true;
}

/* Skips a section to its end mark; a binary section may contain any bytes. */
static bool skip_section(gmsh *g, sbfi_span name) {
  char mark[64];
  if (name.length + 4 > sizeof mark)
    return sbfi_word_fail(g->r, SBF_CODE_IMPORT_SYNTAX, "a section's name is too long");
  memcpy(mark, "$End", 4);
  memcpy(mark + 4, name.at + 1, name.length - 1);
  size_t length = name.length + 3;
  for (const char *at = g->r->at; at + length <= g->r->end; at++) {
    at = memchr(at, '$', (size_t)(g->r->end - at));
    if (!at || at + length > g->r->end) break;
    if (memcmp(at, mark, length) != 0) continue;
    g->r->at = at + length;
    return true;
  }
  return sbfi_word_fail(
      g->r, SBF_CODE_IMPORT_SYNTAX, "section %.*s has no end line", (int)name.length, name.at);
}

static bool read_section(gmsh *g, sbfi_span name) {
  if (sbfi_span_is(name, "$MeshFormat")) return read_format(g);
  sbfi_span rest;
  bool counted = sbfi_span_is(name, "$Nodes") || sbfi_span_is(name, "$Elements");
  if (counted && g->binary && g->version == 4) sbfi_word_line(g->r, &rest); /* the bytes begin after it */
  bool old_nodes = sbfi_span_is(name, "$NOD"), old_elements = sbfi_span_is(name, "$ELM");
  if (old_nodes || old_elements) g->version = 1;
  if (old_nodes || sbfi_span_is(name, "$Nodes")) {
    bool good = g->version == 4 ? read_nodes_blocks(g) : read_nodes_plain(g);
    if (good && g->numbers.count) qsort(g->numbers.at, g->numbers.count, sizeof(numbered), compare_numbers);
    return good;
  }
  if (old_elements || sbfi_span_is(name, "$Elements"))
    return g->version == 4 ? read_elements_blocks(g) : read_elements_plain(g);
  return skip_section(g, name);
}

bool sbfi_read_gmsh(sbfi_word_reader *r, sbfi_tet_mesh *mesh) {
  gmsh g = {.r = r, .mesh = mesh, .version = 2};
  sbfi_span word;
  mesh->format = "gmsh";
  sbfi_array_init(&g.numbers, &mesh->allocator, sizeof(numbered));
  bool good = true, begun = false;
  while (good && sbfi_word_next(r, &word)) {
    if (word.at[0] != '$' || word.length < 2) {
      if (begun) continue;
      good = sbfi_word_fail(r, SBF_CODE_IMPORT_REFUSED, "the file does not begin as a Gmsh mesh does");
      break;
    }
    begun = true;
    bool ends = sbfi_span_begins(word, "$End") || sbfi_span_begins(word, "$END");
    if (!ends) good = read_section(&g, word);
  }
  sbfi_array_free(&g.numbers);
  return good && r->status == SBF_OK;
}
