/* A recording kept in memory. */
#ifndef TEST_TAPE_H
#define TEST_TAPE_H

#include "sbrun/record.h"

enum { TAPE_ROOM = 1 << 16 };

typedef struct tape {
  unsigned char bytes[TAPE_ROOM];
  size_t size;
} tape;

/* Of an sbr_record_output, whose user is the tape. */
void tape_keep(void *user, const void *bytes, size_t size);

#endif
