/* Results of a run for ParaView: displacement, stress, strain energy, frame by frame. */
#ifndef RESULT_CACHE_H
#define RESULT_CACHE_H

#include "session.h"

typedef struct result_cache result_cache;

/* Whether the path ends as such results do: .pvd. */
bool result_cache_named(const char *path);
/* A cell for each tetrahedron and spring of all simulated bodies; for each point of one that has neither.
 * NULL, and *error, where nothing is simulated or memory runs out. */
result_cache *result_cache_open(const session *s, const char *path, sbf_diagnostic *error);
/* The session's present frame; displacements count from the first. */
sbf_status result_cache_add(result_cache *cache, const session *s, sbf_diagnostic *error);
/* Both end the cache; commit leaves nothing new where it fails. */
sbf_status result_cache_commit(result_cache *cache, sbf_diagnostic *error);
void result_cache_abandon(result_cache *cache);

#endif
