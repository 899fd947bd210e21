#include "import/rigging/skin_pieces.h"

#include <stdio.h>
#include <string.h>

#include "base/union_find.h"
#include "import/rigging/join_meshes.h"
#include "import/rigging/mesh_borders.h"

enum { NAMED = 3 };
/* Minimum fraction of the border edges of a skin's pieces that meet another piece. */
static const double MIN_SHARED = 0.5;
static const char skin_name[] = "skin";

typedef struct search {
  const sbfi_conversion *c;
  sbfi_arena *arena;
  uint32_t *sets;         /* (meshes) */
  uint32_t *border_edges; /* (meshes) */
  uint32_t *shared_edges; /* (meshes) those at an edge of another mesh */
} search;

static const char *name_of(const search *s, uint32_t mesh) {
  return s->c->scene->nodes[s->c->scene->meshes[mesh].node].name;
}

static bool is_named_like_bone(const search *s, uint32_t mesh) {
  const sbfi_scene *rig = s->c->rig;
  for (uint32_t n = 0; n < rig->node_count; n++)
    if (rig->nodes[n].is_bone && strcmp(rig->nodes[n].name, name_of(s, mesh)) == 0) return true;
  return false;
}

/* Whether --shell gives the object or a shell of it, OBJECT#N, to a bone. */
static bool is_assigned(const search *s, uint32_t mesh) {
  size_t length = strlen(name_of(s, mesh));
  for (size_t i = 0; i < s->c->options->rigging.shell_count; i++) {
    const char *group = s->c->options->rigging.shells[i].group;
    if (strncmp(group, name_of(s, mesh), length) == 0 && (!group[length] || group[length] == '#'))
      return true;
  }
  return false;
}

static bool find_sets(search *s) {
  const sbfi_scene *scene = s->c->scene;
  sbfi_borders borders;
  bool *is_included = sbfi_arena_allocate(s->arena, scene->mesh_count, sizeof *is_included);
  if (!is_included) return false;
  for (uint32_t m = 0; m < scene->mesh_count; m++) is_included[m] = !is_assigned(s, m);
  if (!sbfi_borders_find(&borders, scene->meshes, scene->mesh_count, is_included, s->arena)) return false;
  sbfi_sets_begin(s->sets, scene->mesh_count);
  for (size_t i = 0; i < borders.count; i++) {
    const sbfi_border_edge *edge = &borders.at[i];
    bool is_like_last = i > 0 && sbfi_borders_coincide(edge - 1, edge);
    bool is_like_next = i + 1 < borders.count && sbfi_borders_coincide(edge, edge + 1);
    s->border_edges[edge->mesh]++;
    s->shared_edges[edge->mesh] += is_like_last || is_like_next;
    if (is_like_last) sbfi_sets_join(s->sets, edge[-1].mesh, edge->mesh);
  }
  for (uint32_t m = 0; m < scene->mesh_count; m++) s->sets[m] = sbfi_set_root(s->sets, m);
  return true;
}

/* Describes the pieces of a set; false if they are no skin. */
static bool is_skin(const search *s, uint32_t root, char *text, size_t size) {
  uint32_t edges = 0, shared = 0, named = 0, pieces = 0;
  size_t used = 0;
  for (uint32_t m = root; m < s->c->scene->mesh_count; m++) {
    if (s->sets[m] != root) continue;
    edges += s->border_edges[m];
    shared += s->shared_edges[m];
    named += is_named_like_bone(s, m);
    if (pieces++ < NAMED)
      used += (size_t)snprintf(text + used, size - used, "%s'%.40s'", pieces > 1 ? ", " : "", name_of(s, m));
  }
  if (pieces > NAMED) snprintf(text + used, size - used, " and %u more", pieces - NAMED);
  return named > 1 && shared >= MIN_SHARED * edges;
}

/* Joins the set of a mesh, or dissolves it. */
static bool join_set(
    const search *s, uint32_t root, sbfi_conversion *c, sbfi_scene_node *nodes, sbfi_scene_mesh *mesh) {
  const sbfi_scene *scene = c->scene;
  char text[160] = "";
  if (!is_skin(s, root, text, sizeof text)) {
    for (uint32_t m = scene->mesh_count; m-- > root;)
      if (s->sets[m] == root) s->sets[m] = m;
    return true;
  }
  if (!sbfi_join_meshes(s->arena, s->sets, root, scene->meshes, scene->mesh_count, mesh)) return false;
  nodes[mesh->node].name = skin_name;
  sbfi_convert_warn(c, SBF_CODE_IMPORT_POINTS_JOINED,
      "the objects %s are open and share their borders, as a skin that was cut along its bones: they were "
      "joined to one skin, whose weights are computed; --weights named makes each a section",
      text);
  return true;
}

static bool join_skins(search *s, sbfi_conversion *c) {
  const sbfi_scene *before = c->scene;
  uint32_t kept = 0;
  sbfi_scene *scene = sbfi_arena_copy(s->arena, before, 1, sizeof *scene);
  sbfi_scene_mesh *meshes = sbfi_arena_copy(s->arena, before->meshes, before->mesh_count, sizeof *meshes);
  sbfi_scene_node *nodes = sbfi_arena_copy(s->arena, before->nodes, before->node_count, sizeof *nodes);
  if (!scene || !meshes || !nodes) return false;
  for (uint32_t m = 0; m < before->mesh_count; m++) {
    if (s->sets[m] != m) continue; /* part of a joined one */
    meshes[kept] = before->meshes[m];
    if (!join_set(s, m, c, nodes, &meshes[kept++])) return false;
  }
  if (kept == before->mesh_count) return true;
  scene->meshes = meshes;
  scene->mesh_count = kept;
  scene->nodes = nodes;
  c->scene = scene;
  return true;
}

bool sbfi_join_skin_pieces(sbfi_conversion *c) {
  uint32_t count = c->scene->mesh_count;
  search s = {.c = c, .arena = &c->scratch};
  /* Other formats have transforms and vertices of their own. */
  if (c->rig->mesh_count || strcmp(c->scene->format, "obj") != 0) return true;
  s.sets = sbfi_arena_allocate(s.arena, count, sizeof *s.sets);
  s.border_edges = sbfi_arena_allocate(s.arena, count, sizeof *s.border_edges);
  s.shared_edges = sbfi_arena_allocate(s.arena, count, sizeof *s.shared_edges);
  return s.sets && s.border_edges && s.shared_edges && find_sets(&s) && join_skins(&s, c);
}
