/* Types that all other headers use: status, diagnostics, allocator, lists, small vectors.
 *
 * Everything here is plain data. Functions are thread safe unless they write to an argument that another
 * thread also uses. The library has no global state. */
#ifndef SBFMT_BASE_H
#define SBFMT_BASE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Marks the exports of the shared libraries. */
#if defined(_WIN32) && defined(SBFMT_SHARED)
#define SBF_API __declspec(dllexport)
#elif defined(__GNUC__) && !defined(_WIN32)
#define SBF_API __attribute__((visibility("default")))
#else
#define SBF_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Version of the library, here 0.1.0. */
#define SBF_VERSION_MAJOR 0
#define SBF_VERSION_MINOR 1
#define SBF_VERSION_PATCH 0

/* Outcome of a call, and the exit status of the program. It says who has to act. */
typedef enum sbf_status {
  SBF_OK = 0,        /* done */
  SBF_BAD_INPUT = 1, /* the file is at fault; nothing was created or changed */
  SBF_FAILED = 2     /* the call or the machine is at fault: wrong argument, no memory, cannot write */
} sbf_status;

/* Severity of a finding. */
typedef enum sbf_severity {
  SBF_SEVERITY_ERROR = 0,
  SBF_SEVERITY_WARNING = 1,
  SBF_SEVERITY_INFO = 2
} sbf_severity;

/* One finding, with fixed storage so that reporting cannot itself fail. Texts are UTF-8 and cut to fit.
 * `code` is a number from sbfmt/codes.h, which never changes. */
typedef struct sbf_diagnostic {
  int32_t code;          /* sbf_code; 0: none */
  sbf_severity severity; /* its severity */
  char message[384];     /* what is wrong and what to do next, one line, no full stop needed */
  char path[256];        /* element path, as in /sbf/soft_body[2]/surface/positions; "" if none */
  char file[256];        /* the file's name as the caller gave it; "" for memory */
  uint32_t line;         /* from 1; 0: unknown */
  int64_t offset;        /* byte offset from 0; -1: unknown */
  int64_t index;         /* index of the item in the list at `path`; -1: not about a single item */
} sbf_diagnostic;

/* Memory as one function: size 0 frees, memory NULL allocates. `old_size` is the block's size as last
 * requested. Must return memory aligned for any type, or NULL; the old block then stays valid. */
typedef struct sbf_allocator {
  void *(*reallocate)(void *user, void *memory, size_t old_size, size_t new_size); /* as above */
  void *user; /* passed to the function */
} sbf_allocator;

typedef struct sbf_vec2 {
  float x, y;
} sbf_vec2;
typedef struct sbf_vec3 {
  float x, y, z;
} sbf_vec3;
typedef struct sbf_vec4 {
  float x, y, z, w;
} sbf_vec4;
typedef struct sbf_quat {
  float x, y, z, w;
} sbf_quat; /* unit length, w is the real part */
typedef struct sbf_uint2 {
  uint32_t at[2];
} sbf_uint2;
typedef struct sbf_uint4 {
  uint32_t at[4];
} sbf_uint4;

/* A list is a pointer and a count. All lists of a loaded asset are read only and live as long as the asset.
 * `at` is NULL if count is 0. */
typedef struct sbf_u8_list {
  const uint8_t *at;
  uint32_t count;
} sbf_u8_list;
typedef struct sbf_u32_list {
  const uint32_t *at;
  uint32_t count;
} sbf_u32_list;
typedef struct sbf_uint2_list {
  const sbf_uint2 *at;
  uint32_t count;
} sbf_uint2_list;
typedef struct sbf_uint4_list {
  const sbf_uint4 *at;
  uint32_t count;
} sbf_uint4_list;
typedef struct sbf_f32_list {
  const float *at;
  uint32_t count;
} sbf_f32_list;
typedef struct sbf_vec2_list {
  const sbf_vec2 *at;
  uint32_t count;
} sbf_vec2_list;
typedef struct sbf_vec3_list {
  const sbf_vec3 *at;
  uint32_t count;
} sbf_vec3_list;
typedef struct sbf_vec4_list {
  const sbf_vec4 *at;
  uint32_t count;
} sbf_vec4_list;
typedef struct sbf_quat_list {
  const sbf_quat *at;
  uint32_t count;
} sbf_quat_list;
typedef struct sbf_string_list {
  const char *const *at;
  uint32_t count;
} sbf_string_list;

#define SBF_NONE (-1) /* an empty reference */

#ifdef __cplusplus
}
#endif
#endif
