/* The host's tasks on threads that are started for each batch, last index first. */
#ifndef TEST_HOST_THREADS_H
#define TEST_HOST_THREADS_H

#include "sbrun/sbrun.h"

/* For sbr_tasks; `user` is the number of threads, an int of 1 to 8. */
void run_on_threads(void *user, sbr_task *task, void *context, uint32_t count);

#endif
