#include "thread_pool.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

struct thread_pool {
  pthread_mutex_t mutex;
  pthread_cond_t work, done;
  pthread_t threads[64];
  uint32_t helper_count;
  uint64_t round; /* counts the calls of run, so that threads detect a new one */
  uint32_t busy;
  bool ending;
  sbr_task *task;
  void *context;
  uint32_t count;
  atomic_uint next;
};

static void run_tasks(thread_pool *pool) {
  for (uint32_t i; (i = atomic_fetch_add(&pool->next, 1)) < pool->count;) pool->task(pool->context, i);
}

static void *work(void *argument) {
  thread_pool *pool = argument;
  uint64_t seen = 0;
  pthread_mutex_lock(&pool->mutex);
  for (;;) {
    while (pool->round == seen && !pool->ending) pthread_cond_wait(&pool->work, &pool->mutex);
    if (pool->ending) break;
    seen = pool->round;
    pthread_mutex_unlock(&pool->mutex);
    run_tasks(pool);
    pthread_mutex_lock(&pool->mutex);
    if (--pool->busy == 0) pthread_cond_signal(&pool->done);
  }
  pthread_mutex_unlock(&pool->mutex);
  return NULL;
}

static void run(void *user, sbr_task *task, void *context, uint32_t count) {
  thread_pool *pool = user;
  pthread_mutex_lock(&pool->mutex);
  pool->task = task;
  pool->context = context;
  pool->count = count;
  atomic_store(&pool->next, 0);
  pool->busy = pool->helper_count;
  pool->round++;
  pthread_cond_broadcast(&pool->work);
  pthread_mutex_unlock(&pool->mutex);
  run_tasks(pool);
  pthread_mutex_lock(&pool->mutex);
  while (pool->busy) pthread_cond_wait(&pool->done, &pool->mutex);
  pthread_mutex_unlock(&pool->mutex);
}

thread_pool *thread_pool_create(uint32_t thread_count) {
  thread_pool *pool = calloc(1, sizeof *pool);
  if (!pool) return NULL;
  pthread_mutex_init(&pool->mutex, NULL);
  pthread_cond_init(&pool->work, NULL);
  pthread_cond_init(&pool->done, NULL);
  while (pool->helper_count + 1 < thread_count && pool->helper_count < 64) {
    if (pthread_create(&pool->threads[pool->helper_count], NULL, work, pool)) {
      thread_pool_destroy(pool);
      return NULL;
    }
    pool->helper_count++;
  }
  return pool;
}

void thread_pool_destroy(thread_pool *pool) {
  if (!pool) return;
  pthread_mutex_lock(&pool->mutex);
  pool->ending = true;
  pthread_cond_broadcast(&pool->work);
  pthread_mutex_unlock(&pool->mutex);
  for (uint32_t i = 0; i < pool->helper_count; i++) pthread_join(pool->threads[i], NULL);
  pthread_cond_destroy(&pool->done);
  pthread_cond_destroy(&pool->work);
  pthread_mutex_destroy(&pool->mutex);
  free(pool);
}

sbr_tasks thread_pool_tasks(thread_pool *pool) {
  return pool && pool->helper_count ? (sbr_tasks){run, pool} : (sbr_tasks){NULL, NULL};
}
