/* Loads and saves the packed form (.sbfz), and declares the settings of both forms. Part of the core library:
 * a program without XML includes only this header; sbfmt/io.h adds the text form and either form.
 *
 * A load that succeeds promises: indices in range, counts consistent, numbers finite and in their ranges,
 * strings UTF-8, ids unique, references to existing items, the bone tree without cycles, parents before
 * children, tetrahedra positively oriented. A load that fails states what is wrong, where, and by which rule
 * in
 * `*error` (may be NULL), and creates nothing. All functions are thread safe on different assets; a loaded
 * asset may be saved from several threads. */
#ifndef SBFMT_PACKED_H
#define SBFMT_PACKED_H

#include "sbfmt/asset.h"
#include "sbfmt/codes.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Limits on what a file may request. 0 means the default given with each. */
typedef struct sbf_limits {
  uint64_t file_bytes;     /* 4 GiB */
  uint64_t memory_bytes;   /* 4 GiB of memory for the asset */
  uint64_t inflated_bytes; /* size of all packed chunks when inflated: 64 times the file, at least 64 MiB, at
                            * most 4 GiB */
  uint32_t inflate_ratio;  /* inflated size of one chunk: 1100 times its stored size */
  uint32_t list_items;     /* 2^30 items in one list */
  uint32_t depth;          /* 32 nested elements */
} sbf_limits;

/* Parts of a packed file to load. Of all others only the table of contents and the root's record are read,
 * which has the ids and names of all parts. A part that is left out keeps its index, id and name, so
 * references to it stay valid; its other fields have their defaults and its lists are empty. Empty members
 * select all. */
typedef struct sbf_selection {
  sbf_string_list
      kinds; /* elements by their names in sbf.schema: "soft_body", "level", "render_mesh", "texture", "clip";
              * "asset" means the lists that belong to no part (hulls, chains, masks) */
  sbf_string_list parts; /* ids or names of parts, for example of a section */
  sbf_u32_list levels;   /* indices of the levels to load of each selected soft body */
} sbf_selection;

/* A list of numbers or bytes that the caller passes in memory. */
typedef struct sbf_given_list {
  const void *at; /* 32-bit numbers of the list's type in the machine's byte order; or bytes */
  size_t size;    /* total size in bytes */
} sbf_given_list;

/* Settings of a load. */
typedef struct sbf_load_options {
  size_t struct_size;             /* sizeof(sbf_load_options), or 0 for this version's */
  const sbf_allocator *allocator; /* NULL: malloc */
  sbf_limits limits;              /* limits on what the file may request */
  bool check_crc;                /* compare each chunk's CRC-32 when it is read; a load of the whole file also
                                  * checks unused chunks, and that gaps are zero */
  const char *name;              /* the file's name in messages, for loads from memory; may be NULL */
  const char *const *extensions; /* names of the extensions that the caller supports: a file that requires */
  uint32_t extension_count;      /* another is refused */
  const sbf_selection *selection; /* packed: parts to load; NULL: all */
  bool copy_file; /* packed: read the file instead of mapping it, so that it may change or shrink during the
                   * asset's life */
  uint64_t *read_bytes; /* packed: receives the number of bytes of the file that were read; may be NULL */
  /* Packed: read the table of contents and the records, but not the lists with chunks of their own: these
   * have their count, and `at` is NULL. The rest of the asset keeps the promises above, except those about
   * items of such lists. For reports on large files: the asset cannot be saved, and only sbf_asset_free may
   * be called with it. XML is read as a whole. */
  bool outline;
  /* For sbf_fix (sbfmt/validate.h): accept faults that it can repair, which are inverted and flat tetrahedra
   * and weights of skins, pins and embeddings outside their ranges. Only sbf_fix and sbf_asset_free may be
   * called with the asset. glTF: also finds meshes, clips and images that another program renumbered, and
   * calls `report` for each (GLTF_RENUMBERED). */
  bool repairable;
  /* XML: lists passed in memory instead of in the text. An element of a list with the attribute `given`, as
   * <positions given="2"/>, begins with a copy of the items of given_lists[2], which are checked like any
   * others. For programs that create a document and load it at once. Without such lists the attribute is
   * refused, since files never have it. */
  const sbf_given_list *given_lists;
  uint32_t given_list_count; /* number of given_lists */
  /* Called at most once per load, with a warning (VERSION_NEWER), if the file has a newer minor version and
   * parts that this library does not know. These parts are not loaded, so a save loses them. May be NULL. */
  void (*report)(void *user, const sbf_diagnostic *diagnostic);
  void *user; /* passed to `report` */
  /* glTF: textures that are files beside the asset also get the bytes of the image that the .glb has. Without
   * it, the asset equals the saved one. */
  bool with_images;
} sbf_load_options;

/* Settings of a save. */
typedef struct sbf_save_options {
  size_t struct_size; /* sizeof(sbf_save_options), or 0 for this version's */
  bool store;         /* packed: leave the chunks uncompressed, so that a load can use them in place */
  int level;          /* packed: zlib's level 1..9; 0: 6 */
} sbf_save_options;

/* Bytes from a save into memory. Free with sbf_buffer_free. */
typedef struct sbf_buffer {
  uint8_t *at;             /* the bytes */
  size_t size;             /* their number */
  sbf_allocator allocator; /* allocator of the bytes */
  size_t capacity;         /* bytes allocated */
} sbf_buffer;
/* Frees the bytes; a buffer that is {0} does nothing. */
SBF_API void sbf_buffer_free(sbf_buffer *buffer);

/* Packed form. A stored (uncompressed) list of a file is used in place: the file is mapped during the asset's
 * life and must not be changed meanwhile. Replacing it by a rename, as saving does, is safe. `options` may be
 * NULL. Saving refuses what a load would refuse. The same asset and options give the same bytes with the same
 * version of zlib.
 *
 * Saving in either form writes a temporary file in the same folder, syncs it and renames it. Readers see
 * either the whole old file or the whole new one, even if the disk is full or the process is killed. On
 * Linux, if the file system supports it, the temporary file has no name until it is complete, so a killed
 * process leaves nothing behind. Elsewhere it is named .sbf-XXXXXXXX.tmp, with eight hexadecimal digits; such
 * a file may be removed whenever nothing is being saved. A dangling link is refused. */
SBF_API sbf_status sbf_packed_load_file(
    const char *path, const sbf_load_options *options, sbf_asset **asset, sbf_diagnostic *error);
/* `bytes` must outlive the asset: lists that are stored and aligned to four bytes point into them. */
SBF_API sbf_status sbf_packed_load_memory(const void *bytes, size_t size, const sbf_load_options *options,
    sbf_asset **asset, sbf_diagnostic *error);
SBF_API sbf_status sbf_packed_save_file(
    const sbf_asset *asset, const char *path, const sbf_save_options *options, sbf_diagnostic *error);
SBF_API sbf_status sbf_packed_save_memory(const sbf_asset *asset, const sbf_save_options *options,
    const sbf_allocator *allocator, sbf_buffer *buffer, sbf_diagnostic *error);

#ifdef __cplusplus
}
#endif
#endif
