/* Private stream format from the program sbfmt-import to the library. Both come from one build, but the
 * reader validates everything, because the child reads hostile files with a third-party parser.
 *
 * Words of 4 bytes in native byte order. str: u32 length, then the bytes, padded with zeros to a whole word.
 * Doubles are aligned to words. A list is its count, then its items, unless a count is named.
 *
 *   u32 SBFI_STREAM_MAGIC, u32 SBFI_STREAM_VERSION
 *   str generator
 *   f64 unit_scale_factor       centimetres per unit (FBX), 0 if the file has none
 *   i32 axes[6]                 up axis, its sign, front, sign, right, sign (FBX); all 0 if it has none
 *   u32 incomplete              the importer reports an incomplete scene
 *   list of nodes, parents first:
 *     str name, i32 parent, u32 kind (sbfi_stream_kind), u32 number of the node in a glTF
 *     file (SBF_NONE: none), f32 local[16] row after row,
 *     u32 limited (bits 0 to 2: twist, swing_y, swing_z), f32 minimum and maximum (rad) for each set bit,
 *     list of u32 meshes
 *   list of meshes:
 *     str name, u32 material
 *     u32 vertex_count, f32 positions[3 * vertex_count]
 *     u32 has_normals (0 or 1), f32 normals[3 * vertex_count] if 1
 *     u32 has_colors (0 or 1), f32 colors[4 * vertex_count] if 1
 *     list of uv sets: f32 uv[2 * vertex_count]
 *     list of u32 polygon sizes, list of u32 corners
 *     list of bones: str node name, f32 bind[16], list of u32 vertices, f32 weights[as many]
 *     list of shapes: str name, f32 weight, f32 positions[3 * vertex_count]
 *   list of materials:
 *     str name, f32 base_color[4], emissive[3], metallic, roughness, alpha_cutoff, u32 alpha_mode (as
 *     sbfi_alpha_mode), u32 double_sided, then for the base colour's, the metallic-roughness and the normal
 *     image: str path, "*n" for embedded image n, "" for none; u32 uv set; f32 offset[2], rotation, scale[2]
 *     as KHR_texture_transform has them
 *   list of embedded images: str name, str extension, u32 byte_count, bytes up to a whole word
 *   list of clips:
 *     str name, f64 duration, f64 ticks_per_second, list of channels:
 *       str node name, three lists of keys (position, rotation x y z w, scale): f64 time, f32 values[3, 4, 3]
 *   u32 SBFI_STREAM_END */
#ifndef SBFI_STREAM_FORMAT_H
#define SBFI_STREAM_FORMAT_H

enum {
  SBFI_STREAM_MAGIC = 0x53464253, /* "SBFS" where the low byte comes first */
  SBFI_STREAM_VERSION = 4,
  SBFI_STREAM_END = 0x21646e65,
  SBFI_STREAM_LIMITS = 3 /* kinds of limits that a node may have */
};

/* What the file declares a node without a mesh to be. */
typedef enum sbfi_stream_kind {
  SBFI_STREAM_PLAIN,   /* nothing */
  SBFI_STREAM_NO_BONE, /* a null, a camera, a light */
  SBFI_STREAM_BONE     /* a limb of an FBX, a joint of a glTF or Collada file without meshes */
} sbfi_stream_kind;

/* Exit codes of the child. It writes either the stream to its output or a one-line message to its error
 * output. */
enum {
  SBFI_CHILD_DONE = 0,
  SBFI_CHILD_REFUSED = 1,
  SBFI_CHILD_BAD_CALL = 2,
  SBFI_CHILD_CANNOT_WRITE = 3,
  SBFI_CHILD_NO_MEMORY = 4,
  SBFI_CHILD_NOT_FINITE = 5
};

#endif
