/* Derived parts: makes from what an artist made all that can be computed from it.
 *
 * A build copies the source parts of an asset, drops every part marked derived, and makes the derived ones
 * again: a level of springs for each soft body, pins, embeddings, convex hulls. Authored parts are kept as
 * they are: a body with a level of its own gets no other, a rigid body with a hull keeps it. What is made is
 * marked with an entry of `derivations` that records tool, settings and the hash of the source, so that what
 * no longer fits its source can be told.
 *
 * The same source and settings give the same bits, on every machine. Thread safe. */
#ifndef SBFMT_BUILD_H
#define SBFMT_BUILD_H

#include "sbfmt/asset.h"
#include "sbfmt/codes.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What springs hold a body's surface from inside. */
typedef enum sbf_build_interior {
  SBF_BUILD_INTERIOR_AUTOMATIC = 0, /* centroid, but none in a sheet without a bone */
  SBF_BUILD_INTERIOR_CENTROID =
      1,                      /* a centre, a point for each polygon; held by the body's bone if it has one */
  SBF_BUILD_INTERIOR_NONE = 2 /* springs over the surface alone */
} sbf_build_interior;

typedef struct sbf_build_options {
  size_t struct_size;             /* sizeof(sbf_build_options), or 0 for this version's */
  const sbf_allocator *allocator; /* for the asset made and for scratch memory; NULL: malloc */
  const char *tool;               /* what the derivation names as its maker; NULL: "sbfmt" and its version */
  sbf_build_interior interior;
  bool without_flexion;    /* no springs between second neighbours */
  bool without_embeddings; /* no embeddings */
  bool without_hulls;      /* no hulls */
  /* Called now and then with the share of the work done, 0..1; false cancels the build. May be NULL. */
  bool (*progress)(void *user, const char *pass, double done);
  /* Warnings, one by one; may be NULL. */
  void (*report)(void *user, const sbf_diagnostic *diagnostic);
  void *user; /* for both callbacks */
} sbf_build_options;

/* What was made. Counts are of derived parts; springs by sbf_spring_kind. */
typedef struct sbf_build_report {
  uint32_t bodies;          /* that got a level */
  uint32_t interior_points; /* made inside them */
  uint32_t springs[SBF_SPRING_KIND_COUNT];
  uint32_t inert_springs; /* left out: they would join two points held fast. The kinds do not count them */
  uint32_t pins;          /* points in the pin sets made */
  uint32_t hulls;
  uint32_t embedded_vertices; /* of render meshes, that at least one body carries */
  uint32_t warnings;
} sbf_build_report;

/* Makes `*built` from `asset`, which stays as it is and need not outlive the call. On failure `*built` is
 * NULL and `*error` says why. `options`, `report` and `error` may be NULL.
 * Failures: no memory; CANCELLED by `progress`; DERIVED_LOST, an authored part refers to a derived one that
 * this build does not make. */
SBF_API sbf_status sbf_build(const sbf_asset *asset, const sbf_build_options *options, sbf_asset **built,
    sbf_build_report *report, sbf_diagnostic *error);

#ifdef __cplusplus
}
#endif
#endif
