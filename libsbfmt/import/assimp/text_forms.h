/* What assimp reads wrong in files of text, without saying so: it is found, and where possible put right,
 * before assimp sees them. */
#ifndef TEXT_FORMS_H
#define TEXT_FORMS_H

#include <stdbool.h>
#include <stddef.h>

enum { TEXT_WHY = 320 };

typedef enum text_verdict {
  TEXT_AS_IT_IS,
  TEXT_REWRITTEN, /* `rewritten` stands for the file */
  TEXT_REFUSED,   /* `why` says for what */
  TEXT_NOT_FINITE,
  TEXT_NO_MEMORY
} text_verdict;

/* Numbers that are none as Microsoft's libraries print them, "1.#QNAN", of which assimp takes the 1. */
text_verdict text_find_not_finite(const char *text, size_t size, char why[TEXT_WHY]);

/* Collada: a skin names its joints by short ids that need be unique below its own skeleton alone; assimp
 * takes the first in the whole file. They are replaced by ids of nodes, which are unique. */
text_verdict collada_name_joints(
    const char *text, size_t size, char **rewritten, size_t *rewritten_size, char why[TEXT_WHY]);

/* Collada: calls `found` with the id of each node that is declared to be a joint. */
void collada_find_joints(
    const char *text, size_t size, void (*found)(void *user, const char *id, size_t length), void *user);

#endif
