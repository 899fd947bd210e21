/* Worker threads for the runtime's tasks. The results do not depend on their number. */
#ifndef THREAD_POOL_H
#define THREAD_POOL_H

#include "sbrun/sbrun.h"

typedef struct thread_pool thread_pool;

/* `thread_count` includes the calling thread: 1 creates no other. NULL if threads or memory run out. */
thread_pool *thread_pool_create(uint32_t thread_count);
void thread_pool_destroy(thread_pool *pool);
sbr_tasks thread_pool_tasks(thread_pool *pool);

#endif
