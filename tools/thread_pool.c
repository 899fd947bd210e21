#include "thread_pool.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

/* Rounds of tasks follow each other within microseconds while a large body is stepped. A thread polls so many
 * times for the next one before it sleeps: a few microseconds, for waking it takes longer. */
enum { POLLS = 2000 };

/* A call of run. */
typedef struct round {
  sbr_task *task;
  void *context;
  uint32_t number, count;
} round;

struct thread_pool {
  pthread_mutex_t mutex;
  pthread_cond_t work, done;
  pthread_t threads[64];
  uint32_t helper_count;
  bool ending;
  round now;
  _Atomic uint64_t next; /* number of the round << 32, and its next task */
  atomic_uint left;      /* tasks that are not done */
};

/* A thread that wakes late finds another round, and takes no task. */
static void run_tasks(thread_pool *pool, const round *r) {
  uint64_t next = atomic_load(&pool->next);
  while (next >> 32 == r->number && (uint32_t)next < r->count) {
    if (!atomic_compare_exchange_weak(&pool->next, &next, next + 1)) continue;
    r->task(r->context, (uint32_t)next);
    if (atomic_fetch_sub(&pool->left, 1) == 1) {
      pthread_mutex_lock(&pool->mutex);
      pthread_cond_signal(&pool->done);
      pthread_mutex_unlock(&pool->mutex);
    }
    next = atomic_load(&pool->next);
  }
}

static void *work(void *argument) {
  thread_pool *pool = argument;
  round r = {0};
  for (;;) {
    for (int i = 0; i < POLLS && atomic_load(&pool->next) >> 32 == r.number; i++)
      ;
    pthread_mutex_lock(&pool->mutex);
    while (pool->now.number == r.number && !pool->ending) pthread_cond_wait(&pool->work, &pool->mutex);
    r = pool->now;
    bool ending = pool->ending;
    pthread_mutex_unlock(&pool->mutex);
    if (ending) return NULL;
    run_tasks(pool, &r);
  }
}

static void run(void *user, sbr_task *task, void *context, uint32_t count) {
  thread_pool *pool = user;
  if (count == 0) return;
  pthread_mutex_lock(&pool->mutex);
  pool->now = (round){task, context, pool->now.number + 1, count};
  round r = pool->now;
  atomic_store(&pool->left, count);
  atomic_store(&pool->next, (uint64_t)r.number << 32);
  pthread_cond_broadcast(&pool->work);
  pthread_mutex_unlock(&pool->mutex);
  run_tasks(pool, &r);
  for (int i = 0; i < POLLS && atomic_load(&pool->left); i++)
    ;
  pthread_mutex_lock(&pool->mutex);
  while (atomic_load(&pool->left)) pthread_cond_wait(&pool->done, &pool->mutex);
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
