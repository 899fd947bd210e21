#include "tape.h"

#include <check.h>
#include <string.h>

void tape_keep(void *user, const void *bytes, size_t size) {
  tape *to = user;
  ck_assert_uint_le(to->size + size, TAPE_ROOM);
  memcpy(to->bytes + to->size, bytes, size);
  to->size += size;
}
