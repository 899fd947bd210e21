#include "build/embed/embed.h"

#include <math.h>
#include <string.h>

#include "build/embed/far_vertices.h"
#include "build/geometry/topology.h"
#include "build/sections/authored_sections.h"
#include "build/sections/section_frame.h"

/* One body's part of one vertex. */
typedef struct weighted_point {
  uint32_t vertex, body;
  float blend;
  const sbfi_mix *mix; /* mix that embeds it; NULL: the embedder does */
} weighted_point;

static bool is_beside(const weighted_point *s) {
  return s->mix && s->mix->beside;
}

typedef struct work {
  sbf_asset *asset;
  const sbfi_embed_target *targets;
  uint32_t target_count;
  int32_t derivation;
  sbfi_embed_report *report;
  sbfi_arena *scratch;
  sbfi_embedder *embedders; /* (target_count) */
  uint32_t *finest;         /* (bodies) first target of each; SBFI_NO_INDEX: none */
  uint32_t *bone_bodies;  /* (bones) first body of the bone or of its nearest ancestor; SBFI_NO_INDEX: none */
  uint32_t *next_of_bone; /* (bodies) next body on the same bone */
  uint32_t *bone_sections; /* (bones) body cut along the bone; SBFI_NO_INDEX: none */
  uint8_t *sectioned;      /* (render meshes) the skin has authored sections */
  const sbfi_sections *sections;
  sbfi_array contributions; /* of the current mesh, in vertex order */
  sbfi_far_vertices far;    /* of the current mesh */
} work;

static bool index_bodies(work *w) {
  uint32_t bodies = w->asset->soft_bodies.count, bones = w->asset->bones.count;
  w->finest = sbfi_arena_allocate(w->scratch, (size_t)bodies + 1, sizeof(uint32_t));
  w->next_of_bone = sbfi_arena_allocate(w->scratch, (size_t)bodies + 1, sizeof(uint32_t));
  w->bone_bodies = sbfi_arena_allocate(w->scratch, (size_t)bones + 1, sizeof(uint32_t));
  w->bone_sections = sbfi_arena_allocate(w->scratch, (size_t)bones + 1, sizeof(uint32_t));
  w->sectioned = sbfi_arena_allocate(w->scratch, (size_t)w->asset->render_meshes.count + 1, 1);
  if (!w->finest || !w->next_of_bone || !w->bone_bodies || !w->bone_sections || !w->sectioned) return false;
  uint32_t cut = w->sections ? w->sections->count : 0;
  if (!sbfi_authored_sections_find(w->asset, bodies - cut, w->sectioned, w->scratch)) return false;
  memset(w->bone_sections, 0xff, bones * sizeof(uint32_t));
  for (uint32_t b = bodies - cut; b < bodies; b++) w->bone_sections[w->asset->soft_bodies.at[b].bone] = b;
  memset(w->finest, 0xff, bodies * sizeof(uint32_t));
  memset(w->next_of_bone, 0xff, bodies * sizeof(uint32_t));
  memset(w->bone_bodies, 0xff, bones * sizeof(uint32_t));
  for (uint32_t t = w->target_count; t-- > 0;) w->finest[w->targets[t].body] = t;
  for (uint32_t b = bodies; b-- > 0;) {
    int32_t bone = w->asset->soft_bodies.at[b].bone;
    if (bone == SBF_NONE || w->finest[b] == SBFI_NO_INDEX) continue;
    w->next_of_bone[b] = w->bone_bodies[bone];
    w->bone_bodies[bone] = b;
  }
  /* Parents come before their children. */
  for (uint32_t i = 0; i < bones; i++)
    if (w->bone_bodies[i] == SBFI_NO_INDEX && w->asset->bones.at[i].parent != SBF_NONE)
      w->bone_bodies[i] = w->bone_bodies[w->asset->bones.at[i].parent];
  return true;
}

static double distance_to(const work *w, uint32_t body, sbf_vec3 position, double min) {
  return sbfi_embedder_distance(&w->embedders[w->finest[body]], position, min);
}

/* Nearest of the bodies on one bone. */
static uint32_t choose_on_bone(const work *w, uint32_t first, sbf_vec3 position) {
  if (first == SBFI_NO_INDEX || w->next_of_bone[first] == SBFI_NO_INDEX) return first;
  double min = INFINITY;
  uint32_t chosen = first;
  for (uint32_t b = first; b != SBFI_NO_INDEX; b = w->next_of_bone[b]) {
    double d = distance_to(w, b, position, min);
    if (!(d < min)) continue;
    min = d;
    chosen = b;
  }
  return chosen;
}

static uint32_t choose_nearest(const work *w, sbf_vec3 position, uint32_t likely) {
  double min = INFINITY;
  uint32_t chosen = SBFI_NO_INDEX;
  /* Tries the last vertex's body first, because its distance bounds the search in the others. The lowest
   * index wins if equal. */
  if (likely != SBFI_NO_INDEX) {
    min = distance_to(w, likely, position, min);
    chosen = likely;
  }
  for (uint32_t b = 0; b < w->asset->soft_bodies.count; b++) {
    if (b == likely || w->finest[b] == SBFI_NO_INDEX) continue;
    double d = distance_to(w, b, position, min);
    if (!(d < min) && !(d == min && chosen == likely && b < likely)) continue;
    min = d;
    chosen = b;
  }
  return chosen;
}

/* Adds a body's part, merged with its existing one in that vertex; `begin` is the vertex's first. */
static bool add_contribution(
    work *w, size_t begin, uint32_t vertex, uint32_t body, float blend, const sbfi_mix *mix) {
  weighted_point *contributions = w->contributions.at;
  for (size_t i = begin; i < w->contributions.count; i++) {
    if (contributions[i].body != body || is_beside(&contributions[i]) || (mix && mix->beside)) continue;
    contributions[i].blend += blend;
    return true;
  }
  return sbfi_array_append(&w->contributions, &(weighted_point){vertex, body, blend, mix}, 1);
}

/* `mixes`: index of each weight's mix of the sections that the skin was cut into; NULL: it was not cut. */
static bool distribute_by_skin(work *w, const sbf_render_mesh *mesh, const sbf_skin *skin,
    const uint32_t *mixes, sbfi_progress progress) {
  uint32_t influence = 0;
  for (uint32_t v = 0; v < mesh->mesh.positions.count; v++) {
    size_t begin = w->contributions.count;
    double sum = 0;
    if (!sbfi_progress_step(progress, v, mesh->mesh.positions.count)) return false;
    for (uint32_t end = influence + skin->influence_counts.at[v]; influence < end; influence++) {
      uint32_t bone = skin->bones.at[influence];
      float weight = skin->weights.at[influence];
      uint32_t body = mixes ? w->bone_sections[bone]
                            : choose_on_bone(w, w->bone_bodies[bone], mesh->mesh.positions.at[v]);
      if (body == SBFI_NO_INDEX || w->finest[body] == SBFI_NO_INDEX || !(weight > 0)) continue;
      uint32_t number = mixes ? mixes[influence] : SBFI_NO_INDEX;
      const sbfi_mix *mix = number != SBFI_NO_INDEX ? &w->sections->mixes[number] : NULL;
      if (!add_contribution(w, begin, v, body, weight, mix)) return false;
      sum += weight;
    }
    weighted_point *contributions = w->contributions.at;
    for (size_t i = begin; i < w->contributions.count; i++) {
      double blend = contributions[i].blend / sum;
      contributions[i].blend = blend < 1 ? (float)blend : 1;
    }
  }
  return true;
}

static bool is_body_of(const work *w, uint32_t body, const sbf_vec3_list *positions) {
  for (uint32_t v = 0; v < positions->count; v++)
    if (!sbfi_embedder_has(&w->embedders[w->finest[body]], positions->at[v])) return false;
  return true;
}

/* Body that has the shape of the mesh; SBFI_NO_INDEX: none. */
static uint32_t find_body_of(const work *w, const sbf_render_mesh *mesh) {
  for (uint32_t b = 0; b < w->asset->soft_bodies.count; b++) {
    int32_t bone = w->asset->soft_bodies.at[b].bone;
    bool possible = mesh->skin ? bone == SBF_NONE : mesh->bone == SBF_NONE || mesh->bone == bone;
    if (possible && w->finest[b] != SBFI_NO_INDEX && is_body_of(w, b, &mesh->mesh.positions)) return b;
  }
  return SBFI_NO_INDEX;
}

static bool distribute_whole(work *w, const sbf_render_mesh *mesh, sbfi_progress progress) {
  uint32_t own = find_body_of(w, mesh), likely = own;
  for (uint32_t v = 0; v < mesh->mesh.positions.count; v++) {
    sbf_vec3 position = mesh->mesh.positions.at[v];
    if (!sbfi_progress_step(progress, v, mesh->mesh.positions.count)) return false;
    if (own != SBFI_NO_INDEX)
      likely = own;
    else if (mesh->bone != SBF_NONE)
      likely = choose_on_bone(w, w->bone_bodies[mesh->bone], position);
    else
      likely = choose_nearest(w, position, likely);
    if (likely != SBFI_NO_INDEX &&
        !sbfi_array_append(&w->contributions, &(weighted_point){v, likely, 1, NULL}, 1))
      return false;
  }
  return true;
}

static bool has_embedding(const sbf_level *level, int32_t mesh) {
  for (uint32_t i = 0; i < level->embeddings.count; i++)
    if (level->embeddings.at[i].render_mesh == mesh) return true;
  return false;
}

/* Progress range of one of several levels. */
static sbfi_progress part_of(sbfi_progress progress, uint32_t number, uint32_t count) {
  return sbfi_progress_part(progress, (double)number / count, (number + 1.0) / count);
}

/* Adds an embedding to the level. The list has capacity: see reserve. */
static sbf_embedding *add_embedding(sbf_level *level, int32_t mesh, int32_t derivation) {
  sbf_embedding *list = (sbf_embedding *)(uintptr_t)level->embeddings.at;
  sbf_embedding *embedding = &list[level->embeddings.count++];
  sbf_embedding_init(embedding);
  embedding->render_mesh = mesh;
  embedding->derived = derivation;
  return embedding;
}

/* Reserves writable memory for an embedding of each mesh and of the surface. */
static bool reserve(const work *w, sbf_level *level) {
  uint32_t count = level->embeddings.count;
  sbf_embedding *list =
      sbf_asset_allocate(w->asset, (size_t)count + 2 * w->asset->render_meshes.count + 1, sizeof *list);
  if (!list) return false;
  if (count) memcpy(list, level->embeddings.at, count * sizeof *list);
  level->embeddings.at = list;
  return true;
}

static sbfi_embedded_vertex embedded_mixed(const sbfi_mix *mix) {
  sbfi_embedded_vertex embedded = {
      .weights = {mix->weights[0], mix->weights[1], mix->weights[2], mix->weights[3]}};
  memcpy(embedded.points.at, mix->points, sizeof mix->points);
  return embedded;
}

/* Attaches vertices to the body's bone if they are too far from the level's own points for an accurate
 * embedding. */
static bool attach_to_bone(const work *w, uint32_t target, const sbf_vec3_list *positions,
    const weighted_point *list, sbfi_array *items) {
  sbf_level *level = w->targets[target].level;
  const sbf_soft_body *body = &w->asset->soft_bodies.at[w->targets[target].body];
  sbfi_embedded_vertex *embedded = items->at;
  sbfi_d3 middle = sbfi_points_middle(&level->positions);
  double reach = 0;
  uint32_t first;
  for (uint32_t i = 0; i < items->count; i++)
    if (embedded[i].beyond)
      reach = fmax(reach, sbfi_d3_length(sbfi_d3_sub(sbfi_d3_of(positions->at[list[i].vertex]), middle)));
  if (!(reach > 0)) return true;
  if (!sbfi_bone_frame_add(level, body->bone, middle, reach, w->derivation, w->asset, &first)) return false;
  for (uint32_t i = 0; i < items->count; i++)
    if (embedded[i].beyond)
      embedded[i] = sbfi_embedder_embed_by_frame(&w->embedders[target], first, positions->at[list[i].vertex]);
  return true;
}

/* Whether a derived level follows its body's bone. A body without pins does not: pins on added points
 * would turn it into a pinned one. */
static bool follows_bone(const sbf_soft_body *body, const sbf_level *level) {
  bool is_pinned = level->model == SBF_ELASTIC_MODEL_JIGGLE;
  for (uint32_t i = 0; i < level->pins.count; i++) is_pinned |= level->pins.at[i].points.count > 0;
  return is_pinned && body->bone != SBF_NONE && level->derived != SBF_NONE;
}

/* Embeds each vertex of `list` in the target's level. */
static bool embed_all(work *w, uint32_t target, const sbf_vec3_list *positions, const weighted_point *list,
    uint32_t count, sbfi_array *items, sbfi_progress progress) {
  const sbfi_embed_target *to = &w->targets[target];
  for (uint32_t i = 0; i < count; i++) {
    uint32_t v = list[i].vertex;
    if (!sbfi_progress_step(progress, i, count)) return false;
    /* Mixes of the sections are points of the finest level. */
    bool mixed = list[i].mix && w->finest[to->body] == target && to->frame != SBFI_NO_INDEX;
    sbfi_embedded_vertex embedded =
        mixed ? embedded_mixed(list[i].mix) : sbfi_embedder_embed(&w->embedders[target], positions->at[v], v);
    if (!sbfi_array_append(items, &embedded, 1)) return false;
  }
  return !follows_bone(&w->asset->soft_bodies.at[to->body], to->level) ||
         attach_to_bone(w, target, positions, list, items);
}

/* Counts vertices that are far outside or are embedded inaccurately. */
static bool count_inaccurate(
    work *w, uint32_t target, uint32_t vertex, const sbfi_embedded_vertex *embedded) {
  const sbf_level *level = w->targets[target].level;
  if (embedded->outside > w->report->farthest) w->report->farthest = embedded->outside;
  bool far = level->cell > 0 && embedded->outside > level->cell;
  if (!far) w->report->flat += embedded->error > 1e-3f * (float)w->embedders[target].size;
  return !far ||
         sbfi_far_vertices_add(&w->far, vertex, embedded->outside, w->targets[target].body, w->scratch);
}

/* Embeds the vertices of `list` (all of them in order if `whole`) in one target's level. */
static bool embed_list(work *w, uint32_t target, int32_t mesh, const sbf_vec3_list *positions,
    const weighted_point *list, uint32_t count, bool count_it, sbfi_progress progress) {
  sbf_level *level = w->targets[target].level;
  bool whole = count == positions->count, blended = false;
  for (uint32_t i = 0; i < count; i++) blended |= list[i].blend != 1;
  uint32_t *vertices = whole ? NULL : sbf_asset_allocate(w->asset, count, sizeof *vertices);
  sbf_uint4 *points = sbf_asset_allocate(w->asset, count, sizeof *points);
  sbf_vec4 *weights = sbf_asset_allocate(w->asset, count, sizeof *weights);
  float *blends = blended ? sbf_asset_allocate(w->asset, count, sizeof *blends) : NULL;
  if ((!whole && !vertices) || !points || !weights || (blended && !blends)) return false;
  sbfi_array items;
  sbfi_array_init(&items, &w->scratch->allocator, sizeof(sbfi_embedded_vertex));
  bool good = embed_all(w, target, positions, list, count, &items, progress);
  const sbfi_embedded_vertex *embedded = items.at;
  for (uint32_t i = 0; good && i < count; i++) {
    points[i] = embedded[i].points;
    weights[i] = embedded[i].weights;
    if (vertices) vertices[i] = list[i].vertex;
    if (blends) blends[i] = list[i].blend;
    good = !count_it || count_inaccurate(w, target, list[i].vertex, &embedded[i]);
  }
  sbfi_array_free(&items);
  if (!good) return false;
  sbf_embedding *embedding = add_embedding(level, mesh, w->derivation);
  embedding->vertices = (sbf_u32_list){vertices, whole ? 0 : count};
  embedding->points = (sbf_uint4_list){points, count};
  embedding->weights = (sbf_vec4_list){weights, count};
  embedding->blends = (sbf_f32_list){blends, blends ? count : 0};
  return true;
}

/* The same; parts of rigid bones in addition to the body's own go to a separate embedding, because an
 * embedding contains a vertex only once. Reorders the list so that those come last. */
static bool embed_in(work *w, uint32_t target, int32_t mesh, const sbf_vec3_list *positions,
    weighted_point *list, uint32_t count, bool count_it, sbfi_progress progress) {
  const sbf_level *level = w->targets[target].level;
  if (count == 0 || level->positions.count == 0 || has_embedding(level, mesh)) return true;
  weighted_point *beside = sbfi_arena_allocate(w->scratch, count, sizeof *beside);
  uint32_t own = 0, others = 0;
  if (!beside) return false;
  for (uint32_t i = 0; i < count; i++)
    if (is_beside(&list[i]))
      beside[others++] = list[i];
    else
      list[own++] = list[i];
  memcpy(list + own, beside, others * sizeof *beside);
  return (own == 0 || embed_list(w, target, mesh, positions, list, own, count_it, progress)) &&
         (others == 0 || embed_list(w, target, mesh, positions, list + own, others, false, progress));
}

/* Distributes the parts of a mesh to their bodies' levels, body by body. */
static bool distribute_mesh(work *w, int32_t mesh, const sbf_vec3_list *positions, sbfi_progress progress) {
  uint32_t bodies = w->asset->soft_bodies.count, count = (uint32_t)w->contributions.count;
  const weighted_point *contributions = w->contributions.at;
  uint32_t *begins = sbfi_arena_allocate(w->scratch, (size_t)bodies + 2, sizeof *begins);
  weighted_point *sorted = sbfi_arena_allocate(w->scratch, (size_t)count + 1, sizeof *sorted);
  if (!begins || !sorted) return false;
  for (uint32_t i = 0; i < count; i++) begins[contributions[i].body + 2]++;
  for (uint32_t b = 0; b < bodies; b++) begins[b + 2] += begins[b + 1];
  for (uint32_t i = 0; i < count; i++) sorted[begins[contributions[i].body + 1]++] = contributions[i];
  for (uint32_t t = 0; t < w->target_count; t++) {
    uint32_t body = w->targets[t].body;
    if (!embed_in(w, t, mesh, positions, sorted + begins[body], begins[body + 1] - begins[body],
            w->finest[body] == t, part_of(progress, t, w->target_count)))
      return false;
  }
  for (uint32_t i = 0; i < count; i++)
    w->report->vertices += i == 0 || contributions[i].vertex != contributions[i - 1].vertex;
  return true;
}

static bool embed_surfaces(work *w, sbfi_progress progress) {
  for (uint32_t t = 0; t < w->target_count; t++) {
    sbfi_progress part = part_of(progress, t, w->target_count);
    const sbf_vec3_list *positions = &w->asset->soft_bodies.at[w->targets[t].body].surface.positions;
    weighted_point *all = sbfi_arena_allocate(w->scratch, (size_t)positions->count + 1, sizeof *all);
    if (!all) return false;
    for (uint32_t v = 0; v < positions->count; v++) all[v] = (weighted_point){v, 0, 1, NULL};
    if (!embed_in(w, t, SBF_NONE, positions, all, positions->count, false, part)) return false;
  }
  return true;
}

/* Whether recipes make all bones of the skin rigid: then it moves with its bones. */
static bool is_rigid_by_recipe(const sbf_asset *asset, const sbf_skin *skin) {
  for (uint32_t i = 0; i < skin->bones.count; i++) {
    const sbf_section_recipe *recipe = sbfi_section_recipe_find(asset, (int32_t)skin->bones.at[i]);
    if (skin->weights.at[i] > 0 && !(recipe && recipe->rigid)) return false;
  }
  return skin->bones.count > 0;
}

static bool embed_mesh(work *w, uint32_t number, sbfi_reporter *reporter, sbfi_progress progress) {
  const sbf_render_mesh *mesh = &w->asset->render_meshes.at[number];
  const sbf_skin *skin = mesh->skin, *blends = w->sections ? w->sections->blends : NULL;
  const uint32_t *mixes = NULL;
  if (blends && blends[number].influence_counts.count) {
    skin = &blends[number];
    mixes = w->sections->mixes_of_blends[number];
  }
  if (mesh->mesh.positions.count == 0) return true;
  w->contributions.count = 0;
  uint32_t flat_before = w->report->flat;
  w->far = (sbfi_far_vertices){.mesh = mesh};
  /* A skin whose mesh has the shape of a body, pinned by its weights, follows that body. */
  bool by_skin = mixes || (skin && find_body_of(w, mesh) == SBFI_NO_INDEX);
  sbfi_progress sharing = sbfi_progress_part(progress, 0, 0.3);
  bool by_bones = by_skin && !mixes && !w->sectioned[number];
  if (!by_bones &&
      !(by_skin ? distribute_by_skin(w, mesh, skin, mixes, sharing) : distribute_whole(w, mesh, sharing)))
    return false;
  if (!distribute_mesh(w, (int32_t)number, &mesh->mesh.positions, sbfi_progress_part(progress, 0.3, 1)))
    return false;
  sbf_diagnostic diagnostic;
  if (w->contributions.count == 0 && !(mesh->skin && is_rigid_by_recipe(w->asset, mesh->skin))) {
    sbfi_diagnose(&diagnostic, SBF_CODE_EMBEDDING_NO_BODY,
        "no soft body deforms render mesh \"%s\": make a section for its bones or for a parent of them",
        mesh->name);
    sbfi_report(reporter, &diagnostic);
  } else if (w->report->flat > flat_before) {
    sbfi_diagnose(&diagnostic, SBF_CODE_EMBEDDING_FLAT,
        "%u vertices of render mesh \"%s\" are outside a flat body and follow its surface",
        (unsigned)(w->report->flat - flat_before), mesh->name);
    sbfi_report(reporter, &diagnostic);
  }
  sbfi_far_vertices_report(&w->far, w->asset, reporter);
  return true;
}

bool sbfi_embed(sbf_asset *asset, const sbfi_embed_target *targets, uint32_t target_count,
    const sbfi_sections *sections, int32_t derivation, sbfi_reporter *reporter, sbfi_embed_report *report,
    sbfi_progress progress, sbfi_arena *scratch) {
  work w = {.asset = asset,
      .targets = targets,
      .target_count = target_count,
      .derivation = derivation,
      .sections = sections,
      .report = report,
      .scratch = scratch};
  *report = (sbfi_embed_report){0, 0, 0};
  if (target_count == 0) return true;
  sbfi_array_init(&w.contributions, &scratch->allocator, sizeof(weighted_point));
  w.embedders = sbfi_arena_allocate(scratch, target_count, sizeof *w.embedders);
  bool good = w.embedders && index_bodies(&w);
  for (uint32_t t = 0; good && t < target_count; t++)
    good = sbfi_progress_report(progress, 0.2 * t / target_count) && reserve(&w, targets[t].level) &&
           sbfi_embedder_make(&w.embedders[t], SBFI_EMBEDS_VERTICES, &asset->soft_bodies.at[targets[t].body],
               targets[t].level, targets[t].interior, targets[t].frame, scratch);
  good = good && embed_surfaces(&w, sbfi_progress_part(progress, 0.2, 0.4));
  uint32_t meshes = asset->render_meshes.count;
  for (uint32_t m = 0; good && m < meshes; m++)
    good = embed_mesh(
        &w, m, reporter, sbfi_progress_part(progress, 0.4 + 0.6 * m / meshes, 0.4 + 0.6 * (m + 1) / meshes));
  sbfi_array_free(&w.contributions);
  return good;
}
