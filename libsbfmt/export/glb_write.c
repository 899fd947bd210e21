/* Writes binary glTF 2.0: render meshes with skin, joints, materials, shape keys and clips; and a motion. */
#include <string.h>

#include "base/file.h"
#include "export/glb_rigid.h"
#include "export/glb_springs.h"
#include "gltf/soft_body_reader.h"

static const char *const part_names[SBFI_GLB_PARTS] = {
    "bufferViews", "accessors", "images", "textures", "materials", "meshes", "skins", "nodes", "animations"};

static void write_scene(sbfi_glb *g, sbfi_text *json) {
  const sbf_asset *asset = g->e->asset;
  bool first = true;
  sbfi_text_string(json, ",\"scene\":0,\"scenes\":[{\"nodes\":[");
  if (asset->bones.count) {
    sbfi_export_print(json, "%u", g->root_node);
    first = false;
  }
  for (uint32_t i = 0; i < asset->render_meshes.count; i++) {
    if (g->meshes[i].node == UINT32_MAX || g->meshes[i].bone >= 0) continue;
    sbfi_export_print(json, "%s%u", first ? "" : ",", g->meshes[i].node);
    first = false;
  }
  sbfi_glb_write_rigid_tops(g, json, &first);
  sbfi_text_string(json, "]}]");
}

static bool has_springs(const sbfi_glb *g) {
  return g->springs && g->springs->count;
}

static void write_extensions_used(const sbfi_glb *g, sbfi_text *json) {
  const char *const extensions[] = {g->emissive_strength ? "KHR_materials_emissive_strength" : NULL,
      g->texture_transform ? "KHR_texture_transform" : NULL, g->texture_webp ? "EXT_texture_webp" : NULL,
      sbfi_glb_has_rigid(g) ? "KHR_physics_rigid_bodies" : NULL,
      g->rigid && g->rigid->shape_count ? "KHR_implicit_shapes" : NULL,
      g->e->soft_bodies ? SBFI_GLTF_EXTENSION : NULL, has_springs(g) ? "VRMC_springBone" : NULL,
      has_springs(g) && g->springs->extended ? "VRMC_springBone_extended_collider" : NULL};
  uint32_t used = 0;
  for (size_t i = 0; i < sizeof extensions / sizeof *extensions; i++)
    if (extensions[i])
      sbfi_export_print(json, "%s\"%s\"", used++ ? "," : ",\"extensionsUsed\":[", extensions[i]);
  if (used) sbfi_text_char(json, ']');
  if (g->texture_webp) sbfi_text_string(json, ",\"extensionsRequired\":[\"EXT_texture_webp\"]");
}

/* The whole document; `soft_body` is the value of its extension, or empty. */
static void write_json(sbfi_glb *g, sbfi_text *json, const sbfi_text *soft_body) {
  const sbf_info *info = &g->e->asset->info;
  sbfi_text_clear(json);
  sbfi_text_string(json, "{\"asset\":{\"version\":\"2.0\",\"generator\":\"sbfmt\"");
  if (*info->copyright) {
    sbfi_text_string(json, ",\"copyright\":");
    sbfi_glb_write_string(json, info->copyright);
  }
  sbfi_text_char(json, '}');
  write_extensions_used(g, json);
  write_scene(g, json);
  if (g->bytes.length)
    sbfi_export_print(json, ",\"buffers\":[{\"byteLength\":%llu}]", (unsigned long long)g->bytes.length);
  for (int i = 0; i < SBFI_GLB_PARTS; i++) {
    const sbfi_glb_array *part = &g->parts[i];
    g->failed = g->failed || part->text.failed;
    if (!part->count) continue;
    sbfi_export_print(json, ",\"%s\":[", part_names[i]);
    sbfi_text_append(json, part->text.at, part->text.length);
    sbfi_text_char(json, ']');
  }
  if (soft_body->length || sbfi_glb_has_rigid(g) || has_springs(g)) {
    sbfi_text_string(json, ",\"extensions\":{");
    if (soft_body->length) {
      sbfi_text_string(json, "\"" SBFI_GLTF_EXTENSION "\":");
      sbfi_text_append(json, soft_body->at, soft_body->length);
    }
    sbfi_glb_write_rigid_document(g, json, !soft_body->length);
    if (has_springs(g)) {
      bool first = !soft_body->length && !sbfi_glb_has_rigid(g);
      sbfi_text_string(json, first ? "\"VRMC_springBone\":" : ",\"VRMC_springBone\":");
      sbfi_glb_write_springs(g, json);
    }
    sbfi_text_char(json, '}');
  }
  sbfi_text_char(json, '}');
  sbfi_text_repeat(json, ' ', (4 - json->length % 4) % 4);
}

/* The extension refers to what the document has without it. */
static void write_document(sbfi_glb *g, sbfi_text *json) {
  sbfi_text soft_body;
  sbfi_text_init(&soft_body, &g->e->allocator);
  write_json(g, json, &soft_body);
  if (g->e->soft_bodies && !g->failed && !json->failed) {
    sbfi_glb_write_soft_body(g, json, &soft_body);
    sbfi_text_repeat(&g->bytes, 0, (4 - g->bytes.length % 4) % 4);
    write_json(g, json, &soft_body);
  }
  g->failed = g->failed || soft_body.failed;
  sbfi_text_free(&soft_body);
}

static void put_words(uint8_t *to, const uint32_t *words, int count) {
  for (int i = 0; i < count; i++)
    for (int k = 0; k < 4; k++) to[4 * i + k] = (uint8_t)(words[i] >> (8 * k));
}

static sbf_status write_chunks(sbfi_glb *g, const sbfi_text *json) {
  sbfi_export *e = g->e;
  size_t size = 12 + 8 + json->length + 8 + g->bytes.length;
  if (size > UINT32_MAX)
    return sbfi_diagnose(e->error, SBF_CODE_BAD_CALL,
        "%s: a .glb cannot be larger than 4 GiB; ask for fewer frames, or for a render level", e->path);
  uint8_t head[20], second[8];
  put_words(head, (uint32_t[]){0x46546c67, 2, (uint32_t)size, (uint32_t)json->length, 0x4e4f534a}, 5);
  put_words(second, (uint32_t[]){(uint32_t)g->bytes.length, 0x004e4942}, 2);
  sbfi_file_writer writer;
  sbf_status status = sbfi_file_writer_open(&writer, e->path, &e->allocator, e->error);
  if (status != SBF_OK) return status;
  status = sbfi_file_writer_write(&writer, head, sizeof head, e->error);
  if (status == SBF_OK) status = sbfi_file_writer_write(&writer, json->at, json->length, e->error);
  if (status == SBF_OK) status = sbfi_file_writer_write(&writer, second, sizeof second, e->error);
  if (status == SBF_OK) status = sbfi_file_writer_write(&writer, g->bytes.at, g->bytes.length, e->error);
  if (status == SBF_OK) return sbfi_file_writer_commit(&writer, e->error);
  sbfi_file_writer_abandon(&writer);
  return status;
}

static void report_unsupported(const sbfi_glb *g) {
  const sbf_asset *a = g->e->asset;
  uint32_t uv_sets = 0, inherit = 0, none[SBFI_RIGID_LOSSES] = {0};
  const uint32_t *losses = g->rigid ? g->rigid->losses : none;
  for (uint32_t i = 0; i < a->render_meshes.count; i++)
    if (a->render_meshes.at[i].uv_sets.count > 4) uv_sets += a->render_meshes.at[i].uv_sets.count - 4;
  for (uint32_t i = 0; i < a->bones.count; i++)
    inherit += !a->bones.at[i].inherit_rotation || !a->bones.at[i].inherit_scale;
  const sbfi_left_out things[] = {{a->soft_bodies.count, "soft bodies"},
      {g->e->motion ? a->rigid_bodies.count : 0, "rigid bodies"},
      {g->e->motion ? a->joints.count : 0, "joints between them"}, {losses[SBFI_RIGID_PULLEYS], "pulleys"},
      {losses[SBFI_RIGID_BREAKING], "breaking forces of joints"},
      {losses[SBFI_RIGID_BOUNCING_LIMITS], "restitutions of joint limits"},
      {losses[SBFI_RIGID_DRIVES], "drives of cones and distances"},
      {a->ik_chains.count, "inverse kinematics"}, {a->gaits.count, "gaits"},
      {g->springs ? g->springs->chains_left_out : a->chains.count, "chains"},
      {g->springs ? g->springs->followers_left_out : a->followers.count, "followers"},
      {a->poses.count, "poses"}, {a->bone_masks.count, "bone masks"},
      {a->retarget_chains.count, "retargeting chains"}, {uv_sets, "uv sets beyond four"},
      {g->omitted_images, "images that are neither PNG nor JPEG nor WebP, or not found"},
      {g->omitted_tracks, "clip tracks without increasing times"},
      {inherit, "bones that do not inherit the rotation or scale of their parent"}};
  if (!g->e->soft_bodies) sbfi_export_left_out(g->e, "glTF", things, sizeof things / sizeof *things);
  if (g->worst_m > 0.0005)
    sbfi_export_warn(g->e,
        "the written motion has an error of up to %.1f mm where opposite rotations of joints flatten the "
        "skin",
        1000 * g->worst_m);
}

static sbf_status write_all(sbfi_glb *g) {
  sbfi_export *e = g->e;
  sbfi_text json;
  sbfi_text_init(&json, &e->allocator);
  sbfi_glb_choose_meshes(g);
  if (!g->failed) sbfi_glb_write_materials(g);
  if (!g->failed) sbfi_glb_write_meshes(g);
  if (!g->failed) sbfi_glb_write_nodes(g);
  if (!g->failed) sbfi_glb_write_clips(g);
  if (!g->failed) sbfi_glb_write_motion(g);
  sbfi_text_repeat(&g->bytes, 0, (4 - g->bytes.length % 4) % 4);
  if (!g->failed) write_document(g, &json);
  sbf_status status;
  if (g->failed || json.failed || g->bytes.failed)
    status = sbfi_export_no_memory(e);
  else if ((status = write_chunks(g, &json)) == SBF_OK)
    report_unsupported(g);
  sbfi_text_free(&json);
  return status;
}

sbf_status sbfi_export_glb(sbfi_export *e) {
  const sbf_asset *asset = e->asset;
  if (e->soft_bodies && e->render_level)
    return sbfi_diagnose(e->error, SBF_CODE_BAD_CALL,
        "%s: soft bodies belong to the full meshes: leave the render level out", e->path);
  if (!asset->render_meshes.count && !asset->bones.count && !e->soft_bodies)
    return sbfi_diagnose(e->error, SBF_CODE_EXPORT_EMPTY,
        "the file has neither a render mesh nor a skeleton: there is nothing to write to %s", e->path);
  if (asset->bones.count >= UINT16_MAX)
    return sbfi_diagnose(e->error, SBF_CODE_BAD_CALL,
        "%s: glTF allows at most 65535 joints, and there are %u bones", e->path, asset->bones.count);
  sbfi_glb g = {.e = e};
  sbfi_arena_init(&g.arena, &e->allocator, 0);
  sbfi_text_init(&g.bytes, &e->allocator);
  for (int i = 0; i < SBFI_GLB_PARTS; i++) sbfi_text_init(&g.parts[i].text, &e->allocator);
  for (uint32_t i = 0; i < asset->render_meshes.count; i++)
    g.frame_points += asset->render_meshes.at[i].mesh.positions.count;
  if (e->motion) g.bone_motions = sbfi_glb_allocate(&g, asset->bones.count, sizeof *g.bone_motions);
  sbf_status status = g.failed ? sbfi_export_no_memory(e) : write_all(&g);
  for (int i = 0; i < SBFI_GLB_PARTS; i++) sbfi_text_free(&g.parts[i].text);
  sbfi_glb_free_rigid(&g);
  sbfi_text_free(&g.bytes);
  sbfi_arena_free(&g.arena);
  return status;
}
