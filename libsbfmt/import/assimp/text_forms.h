/* Text that assimp silently misreads: detects it and repairs it if possible before assimp reads it. */
#ifndef TEXT_FORMS_H
#define TEXT_FORMS_H

#include <stdbool.h>
#include <stddef.h>

enum { TEXT_WHY = 320 };

typedef enum text_verdict {
  TEXT_AS_IT_IS,
  TEXT_REWRITTEN, /* use `rewritten` instead of the file */
  TEXT_REFUSED,   /* `why` has the reason */
  TEXT_NOT_FINITE,
  TEXT_NO_MEMORY
} text_verdict;

/* Numbers printed by Microsoft's libraries as "1.#QNAN", which assimp reads as 1. */
text_verdict text_find_not_finite(const char *text, size_t size, char why[TEXT_WHY]);

/* Collada: a skin refers to its joints by short ids that are unique only below its own skeleton; assimp
 * uses the first match in the file. Replaces them with ids of nodes, which are unique. */
text_verdict collada_name_joints(
    const char *text, size_t size, char **rewritten, size_t *rewritten_size, char why[TEXT_WHY]);

/* Collada: calls `found` with the id of each node declared as a joint. */
void collada_find_joints(
    const char *text, size_t size, void (*found)(void *user, const char *id, size_t length), void *user);

#endif
