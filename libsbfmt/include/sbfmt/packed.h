/* Loading and saving the packed form (.sbfz), and the settings that both forms share. In the core library:
 * a program that needs no XML includes this alone; sbfmt/io.h adds the text form and either form.
 *
 * A load that succeeds promises: indices in range, counts consistent, numbers finite and in their ranges,
 * strings UTF-8, ids unique, references to things that exist, the bone tree without cycles, parents before
 * children, tetrahedra positively oriented. A load that fails says what, where and which rule in `*error`
 * (may be NULL) and makes nothing. All functions are thread safe on different assets; a loaded asset may be
 * saved from several threads. */
#ifndef SBFMT_PACKED_H
#define SBFMT_PACKED_H

#include "sbfmt/asset.h"
#include "sbfmt/codes.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Bounds on what a file may ask for. Zero means the default that stands behind each. */
typedef struct sbf_limits {
  uint64_t file_bytes;     /* 4 GiB */
  uint64_t memory_bytes;   /* 4 GiB that the asset may take */
  uint64_t inflated_bytes; /* that packed chunks may inflate to, all together: 64 times the file, at least
                              64 MiB, at most 4 GiB */
  uint32_t inflate_ratio;  /* 1100 times its stored size for one chunk */
  uint32_t list_items;     /* 2^30 items in one list */
  uint32_t depth;          /* 32 elements inside each other */
} sbf_limits;

/* What to load of a packed file. Of the rest nothing is read but the table of contents and the root's record,
 * which has every id and name of a part: a part left out keeps its place, id and name, so that references to
 * it stay good; everything else in it is at its default, its lists are empty. An empty member selects all. */
typedef struct sbf_selection {
  sbf_string_list
      kinds; /* elements by their names in sbf.schema: "soft_body", "level", "render_mesh", "texture",
                "clip"; "asset" stands for the lists of what is no part (hulls, chains, masks) */
  sbf_string_list parts; /* ids or names of parts, as of a section */
  sbf_u32_list levels;   /* places of the levels wanted of each soft body selected */
} sbf_selection;

/* A list of numbers, or of bytes, that the caller hands over in memory. */
typedef struct sbf_given_list {
  const void *at; /* 32-bit numbers of the list's type as the machine has them; or bytes */
  size_t size;    /* bytes of all */
} sbf_given_list;

/* Settings of a load. */
typedef struct sbf_load_options {
  size_t struct_size;             /* sizeof(sbf_load_options), or 0 for this version's */
  const sbf_allocator *allocator; /* NULL: malloc */
  sbf_limits limits;              /* on what the file may ask for */
  bool check_crc;                 /* compare each chunk's CRC-32 as it is read; a load of the
                                     whole compares those it does not need as well, and the gaps with zero */
  const char *name;               /* the file's name for messages, with loads from memory; may be NULL */
  const char *const
      *extensions;          /* names of the extensions that the caller understands: a file that requires */
  uint32_t extension_count; /* another is refused */
  const sbf_selection *selection; /* packed: what to load; NULL: all */
  bool copy_file; /* packed: read the file instead of mapping it, so that it may change or shrink meanwhile */
  uint64_t *read_bytes; /* packed: receives how much of the file was looked at; may be NULL */
  /* Packed: read the table of contents and the records, and leave the lists that have chunks of their own
   * where they are: they have their count, and `at` is NULL. What else the asset holds keeps the promises
   * above, apart from those about the items of such lists. For reports on large files: saving it is refused,
   * and no other function but sbf_asset_free may be given it. XML is read whole. */
  bool outline;
  /* For sbf_fix (sbfmt/validate.h): let pass what it may mend, inverted and flat tetrahedra and weights of
   * skins, pins and embeddings outside their ranges. No other function but sbf_asset_free may be given what
   * is loaded so. */
  bool mendable;
  /* XML: lists that stand in memory rather than in the text. An element of a list with the attribute `given`,
   * as <positions given="2"/>, begins with a copy of the items of given_lists[2], which are checked like any.
   * For programs that make a document and load it at once: without such lists the attribute is refused, as
   * files never have it. */
  const sbf_given_list *given_lists;
  uint32_t given_list_count; /* how many of them */
  /* Called at most once in a load, with a warning (VERSION_NEWER), where the file is of a newer minor version
   * and holds parts that this library does not know. They are no part of the asset: a save loses them. May be
   * NULL. */
  void (*report)(void *user, const sbf_diagnostic *diagnostic);
  void *user; /* given to `report` */
} sbf_load_options;

/* Settings of a save. */
typedef struct sbf_save_options {
  size_t struct_size; /* sizeof(sbf_save_options), or 0 for this version's */
  bool store;         /* packed: leave the chunks uncompressed, so that a load can use them in place */
  int level;          /* packed: zlib's 1..9; 0: 6 */
} sbf_save_options;

/* Bytes made by a save into memory: free with sbf_buffer_free. */
typedef struct sbf_buffer {
  uint8_t *at;             /* the bytes */
  size_t size;             /* how many */
  sbf_allocator allocator; /* that they came from */
  size_t capacity;         /* bytes allocated */
} sbf_buffer;
/* Frees the bytes; a buffer that is {0} does nothing. */
SBF_API void sbf_buffer_free(sbf_buffer *buffer);

/* Packed form. A stored (uncompressed) list of a file is used in place: the file is mapped as long as the
 * asset lives, and must not be changed in that time (to be replaced by a rename, as saving does, is safe).
 * `options` may be NULL. Saving refuses what a load would refuse; the same asset and
 * options give the same bytes, with the same version of zlib.
 *
 * Saving, of either form, writes a temporary file in the same folder, syncs and renames it: whoever reads
 * sees the old file or the new one, whole, also where the disk is full or the process is ended. On Linux that
 * file has no name until it is whole, where the file system can do so: nothing is left of it when the process
 * is killed. Elsewhere .sbf-XXXXXXXX.tmp is, with eight hexadecimal digits: it may be removed whenever
 * nothing is being saved. A link that names nothing is refused. */
SBF_API sbf_status sbf_packed_load_file(
    const char *path, const sbf_load_options *options, sbf_asset **asset, sbf_diagnostic *error);
/* `bytes` must outlive the asset: lists may point into them (they do where stored and aligned to four bytes).
 */
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
