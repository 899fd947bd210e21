#include "host_threads.h"

#include <check.h>
#include <pthread.h>
#include <stdatomic.h>

typedef struct batch {
  sbr_task *task;
  void *context;
  atomic_uint left;
} batch;

static void *work(void *argument) {
  batch *b = argument;
  for (;;) {
    unsigned left = atomic_load(&b->left);
    do {
      if (left == 0) return NULL;
    } while (!atomic_compare_exchange_weak(&b->left, &left, left - 1));
    b->task(b->context, left - 1);
  }
}

void run_on_threads(void *user, sbr_task *task, void *context, uint32_t count) {
  int thread_count = *(const int *)user;
  batch b = {task, context, count};
  pthread_t threads[8];
  for (int i = 1; i < thread_count; i++) ck_assert_int_eq(pthread_create(&threads[i], NULL, work, &b), 0);
  work(&b);
  for (int i = 1; i < thread_count; i++) pthread_join(threads[i], NULL);
}
