/* Words of tables of methods, and the head of their functions. */
#ifndef SBFMT_GODOT_METHOD_TABLE_H
#define SBFMT_GODOT_METHOD_TABLE_H

#include "classes.h"

#define CALL(name) static void name(void *self, const gd_variant *const *arguments, gd_variant *result)
#define UNUSED (void)arguments, (void)result

#define TYPE(kind) GDEXTENSION_VARIANT_TYPE_##kind
#define NOTHING                                                                                              \
  false, {                                                                                                   \
    "", TYPE(NIL), NULL                                                                                      \
  }
#define ANSWER(kind)                                                                                         \
  true, {                                                                                                    \
    "", TYPE(kind), NULL                                                                                     \
  }
#define NODE(of)                                                                                             \
  true, {                                                                                                    \
    "", TYPE(OBJECT), of                                                                                     \
  }
#define WITH(label, kind)                                                                                    \
  { label, TYPE(kind), NULL }

#endif
