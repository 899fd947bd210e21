/* Writes the bodies' first levels of tetrahedra, concatenated, in formats that import/tetrahedra reads:
 * PhysX's .tet, TetGen's .node and .ele, Gmsh's .msh 2.2, VTK's .vtu. */
#include <stdio.h>
#include <string.h>

#include "export/exporting.h"

/* Totals over all lattices. */
typedef struct lattices {
  uint32_t bodies, points, tetrahedra;
} lattices;

static lattices count_lattices(const sbf_asset *asset) {
  lattices all = {0, 0, 0};
  for (uint32_t b = 0; b < asset->soft_bodies.count; b++) {
    const sbf_level *level = sbfi_export_lattice(&asset->soft_bodies.at[b]);
    if (!level) continue;
    all.bodies++;
    all.points += level->positions.count;
    all.tetrahedra += level->lattice.tetrahedra.count;
  }
  return all;
}

/* Visits every point, then every tetrahedron with its points' global numbers and its body's number, from 0
 * among those with a lattice. Either may be NULL. */
typedef void write_point(sbfi_export *e, uint32_t number, sbf_vec3 at);
typedef void write_tetrahedron(sbfi_export *e, uint32_t number, const uint32_t points[4], uint32_t body);

static void visit(sbfi_export *e, write_point *on_point, write_tetrahedron *on_tetrahedron) {
  const sbf_asset *asset = e->asset;
  uint32_t first = 0, number = 0, body = 0;
  for (uint32_t b = 0; b < asset->soft_bodies.count; b++) {
    const sbf_level *level = sbfi_export_lattice(&asset->soft_bodies.at[b]);
    if (!level) continue;
    for (uint32_t i = 0; on_point && i < level->positions.count; i++)
      on_point(e, first + i, level->positions.at[i]);
    for (uint32_t i = 0; on_tetrahedron && i < level->lattice.tetrahedra.count; i++) {
      const uint32_t *p = level->lattice.tetrahedra.at[i].at;
      const uint32_t points[4] = {first + p[0], first + p[1], first + p[2], first + p[3]};
      on_tetrahedron(e, number++, points, body);
    }
    first += level->positions.count;
    body++;
  }
}

static sbf_status begin(sbfi_export *e, lattices *all) {
  *all = count_lattices(e->asset);
  if (all->bodies) return SBF_OK;
  return sbfi_diagnose(e->error, SBF_CODE_EXPORT_EMPTY,
      "no soft body has a level of tetrahedra: there is nothing to write to %s; "
      "`sbfmt build IN -o OUT --springs tetrahedra` makes them",
      e->path);
}

static sbf_status end(sbfi_export *e, const lattices *all, const char *form) {
  const sbf_asset *asset = e->asset;
  uint32_t springs = 0, pins = 0;
  for (uint32_t b = 0; b < asset->soft_bodies.count; b++) {
    const sbf_level *level = sbfi_export_lattice(&asset->soft_bodies.at[b]);
    for (uint32_t i = 0; level && i < level->springs.count; i++) springs += level->springs.at[i].ends.count;
    for (uint32_t i = 0; level && i < level->pins.count; i++) pins += level->pins.at[i].points.count;
  }
  const sbfi_left_out things[] = {{asset->soft_bodies.count - all->bodies, "soft bodies without tetrahedra"},
      {springs, "springs"}, {pins, "pinned points"}, {asset->render_meshes.count, "render meshes"},
      {asset->bones.count, "bones"}, {asset->rigid_bodies.count, "rigid bodies"},
      {asset->joints.count, "joints"}, {asset->gaits.count, "gaits"}, {asset->clips.count, "clips"}};
  sbfi_export_left_out(e, form, things, sizeof things / sizeof *things);
  return sbfi_export_commit(e, e->path);
}

static void physx_point(sbfi_export *e, uint32_t number, sbf_vec3 at) {
  (void)number;
  sbfi_text_char(&e->text, 'v');
  sbfi_export_vec3(e, at);
  sbfi_text_char(&e->text, '\n');
}

static void physx_tetrahedron(sbfi_export *e, uint32_t number, const uint32_t p[4], uint32_t body) {
  (void)number, (void)body;
  sbfi_export_format(e, "t %u %u %u %u\n", p[0], p[1], p[2], p[3]);
}

sbf_status sbfi_export_tet(sbfi_export *e) {
  lattices all;
  sbf_status status = begin(e, &all);
  if (status != SBF_OK) return status;
  sbfi_text_string(&e->text, "# tetrahedra of sbfmt: metres, +Y up\n");
  /* Body by body, so that points come before their uses and bodies stay together. */
  visit(e, physx_point, physx_tetrahedron);
  return end(e, &all, ".tet");
}

static void numbered_point(sbfi_export *e, uint32_t number, sbf_vec3 at) {
  sbfi_export_format(e, "%u", number);
  sbfi_export_vec3(e, at);
  sbfi_text_char(&e->text, '\n');
}

static void tetgen_tetrahedron(sbfi_export *e, uint32_t number, const uint32_t p[4], uint32_t body) {
  sbfi_export_format(e, "%u %u %u %u %u %u\n", number, p[0], p[1], p[2], p[3], body + 1);
}

/* Two files with one name: points, and tetrahedra with their body's number from 1 as region. */
sbf_status sbfi_export_tetgen(sbfi_export *e) {
  lattices all;
  char points[4096], elements[4096];
  int stem = (int)(strrchr(e->path, '.') - e->path);
  int length = snprintf(points, sizeof points, "%.*s.node", stem, e->path);
  if (length < 0 || (size_t)length >= sizeof points)
    return sbfi_diagnose(e->error, SBF_CODE_IO_CANNOT_WRITE, "the path is too long: %.80s...", e->path);
  snprintf(elements, sizeof elements, "%.*s.ele", stem, e->path);
  sbf_status status = begin(e, &all);
  if (status != SBF_OK) return status;
  sbfi_export_format(e, "# points of sbfmt: metres, +Y up\n%u 3 0 0\n", all.points);
  visit(e, numbered_point, NULL);
  status = sbfi_export_commit(e, points);
  if (status != SBF_OK) return status;
  sbfi_export_format(e, "# tetrahedra of sbfmt; the last number is the body's\n%u 4 1\n", all.tetrahedra);
  visit(e, NULL, tetgen_tetrahedron);
  e->path = elements;
  return end(e, &all, "TetGen");
}

static void gmsh_point(sbfi_export *e, uint32_t number, sbf_vec3 at) {
  numbered_point(e, number + 1, at);
}

static void gmsh_tetrahedron(sbfi_export *e, uint32_t number, const uint32_t p[4], uint32_t body) {
  sbfi_export_format(e, "%u 4 2 %u %u %u %u %u %u\n", number + 1, body + 1, body + 1, p[0] + 1, p[1] + 1,
      p[2] + 1, p[3] + 1);
}

/* Each body is a physical volume with its name. */
sbf_status sbfi_export_msh(sbfi_export *e) {
  lattices all;
  uint32_t number = 0;
  sbf_status status = begin(e, &all);
  if (status != SBF_OK) return status;
  sbfi_export_format(e, "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n%u\n", all.bodies);
  for (uint32_t b = 0; b < e->asset->soft_bodies.count; b++) {
    const sbf_soft_body *body = &e->asset->soft_bodies.at[b];
    if (!sbfi_export_lattice(body)) continue;
    sbfi_export_format(e, "3 %u \"", ++number);
    for (const char *c = *body->name ? body->name : body->id; *c; c++)
      sbfi_text_char(&e->text, *c == '"' || (unsigned char)*c < ' ' ? '_' : *c);
    sbfi_text_string(&e->text, "\"\n");
  }
  sbfi_export_format(e, "$EndPhysicalNames\n$Nodes\n%u\n", all.points);
  visit(e, gmsh_point, NULL);
  sbfi_export_format(e, "$EndNodes\n$Elements\n%u\n", all.tetrahedra);
  visit(e, NULL, gmsh_tetrahedron);
  sbfi_text_string(&e->text, "$EndElements\n");
  return end(e, &all, "Gmsh");
}

static void vtu_point(sbfi_export *e, uint32_t number, sbf_vec3 at) {
  (void)number;
  sbfi_export_vec3(e, at);
  sbfi_text_char(&e->text, '\n');
}

static void vtu_corners(sbfi_export *e, uint32_t number, const uint32_t p[4], uint32_t body) {
  (void)number, (void)body;
  sbfi_export_format(e, "%u %u %u %u\n", p[0], p[1], p[2], p[3]);
}

static void vtu_end(sbfi_export *e, uint32_t number, const uint32_t p[4], uint32_t body) {
  (void)p, (void)body;
  sbfi_export_format(e, "%u\n", 4 * number + 4);
}

static void vtu_type(sbfi_export *e, uint32_t number, const uint32_t p[4], uint32_t body) {
  (void)number, (void)p, (void)body;
  sbfi_text_string(&e->text, "10\n");
}

static void vtu_body(sbfi_export *e, uint32_t number, const uint32_t p[4], uint32_t body) {
  (void)number, (void)p;
  sbfi_export_format(e, "%u\n", body);
}

static void write_array(sbfi_export *e, const char *type, const char *name, write_point *on_point,
    write_tetrahedron *on_tetrahedron) {
  sbfi_export_format(e, "<DataArray type=\"%s\" Name=\"%s\"%s format=\"ascii\">\n", type, name,
      on_point ? " NumberOfComponents=\"3\"" : "");
  visit(e, on_point, on_tetrahedron);
  sbfi_text_string(&e->text, "</DataArray>\n");
}

/* Each cell has its body's number, from 0. */
sbf_status sbfi_export_vtu(sbfi_export *e) {
  lattices all;
  sbf_status status = begin(e, &all);
  if (status != SBF_OK) return status;
  sbfi_text_string(&e->text, "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
                             "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n");
  sbfi_export_format(
      e, "<Piece NumberOfPoints=\"%u\" NumberOfCells=\"%u\">\n<Points>\n", all.points, all.tetrahedra);
  write_array(e, "Float32", "Points", vtu_point, NULL);
  sbfi_text_string(&e->text, "</Points>\n<Cells>\n");
  write_array(e, "Int64", "connectivity", NULL, vtu_corners);
  write_array(e, "Int64", "offsets", NULL, vtu_end);
  write_array(e, "UInt8", "types", NULL, vtu_type);
  sbfi_text_string(&e->text, "</Cells>\n<CellData>\n");
  write_array(e, "UInt32", "body", NULL, vtu_body);
  sbfi_text_string(&e->text, "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
  return end(e, &all, "VTU");
}
