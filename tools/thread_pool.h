/* Worker threads for the runtime's tasks. The results do not depend on how many there are. */
#ifndef THREAD_POOL_H
#define THREAD_POOL_H

#include "sbrun/sbrun.h"

typedef struct thread_pool thread_pool;

/* `thread_count` counts the calling thread: 1 makes no other. NULL where threads or memory run out. */
thread_pool *thread_pool_create(uint32_t thread_count);
void thread_pool_destroy(thread_pool *pool);
sbr_tasks thread_pool_tasks(thread_pool *pool);

#endif
