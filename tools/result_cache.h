/* Writes results of a run for ParaView: displacement, stress, strain energy, frame by frame. */
#ifndef RESULT_CACHE_H
#define RESULT_CACHE_H

#include "session.h"

typedef struct result_cache result_cache;

/* Whether the path has the extension .pvd. */
bool result_cache_named(const char *path);
/* One cell per tetrahedron and spring of all simulated bodies; one per point of a body with neither. NULL,
 * and *error, if nothing is simulated or memory runs out. */
result_cache *result_cache_open(const session *s, const char *path, sbf_diagnostic *error);
/* Adds the session's current frame; displacements are relative to the first. */
sbf_status result_cache_add(result_cache *cache, const session *s, sbf_diagnostic *error);
/* Both end the cache; a failed commit leaves no new files. */
sbf_status result_cache_commit(result_cache *cache, sbf_diagnostic *error);
void result_cache_abandon(result_cache *cache);

#endif
