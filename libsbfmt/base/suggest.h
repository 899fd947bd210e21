/* "Did you mean ...?": the known word closest to a mistyped one. */
#ifndef SBFI_SUGGEST_H
#define SBFI_SUGGEST_H

#include "base/text.h"

typedef struct sbfi_suggestion {
  sbfi_span word;   /* as typed */
  const char *best; /* NULL: none is close */
  size_t distance;  /* of `best`, or the first distance that is too far */
} sbfi_suggestion;

sbfi_suggestion sbfi_suggestion_for(sbfi_span word);
/* Of equally close words the first stays. */
void sbfi_suggestion_consider(sbfi_suggestion *suggestion, const char *known);

/* ": did you mean `best`?", or "" if no word is close. */
typedef struct sbfi_suggestion_text {
  char at[96];
} sbfi_suggestion_text;
sbfi_suggestion_text sbfi_suggestion_text_of(const sbfi_suggestion *suggestion);

#endif
