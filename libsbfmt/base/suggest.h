/* "Did you mean ...?": the known word that a mistyped one is closest to. */
#ifndef SBFI_SUGGEST_H
#define SBFI_SUGGEST_H

#include "base/text.h"

typedef struct sbfi_suggestion {
  sbfi_span word;   /* as typed */
  const char *best; /* NULL: none is close */
  size_t distance;  /* of the best, or how far is too far */
} sbfi_suggestion;

sbfi_suggestion sbfi_suggestion_for(sbfi_span word);
/* The first of several that are equally close stays. */
void sbfi_suggestion_consider(sbfi_suggestion *suggestion, const char *known);

/* ": did you mean `best`?", or "" where nothing is close. */
typedef struct sbfi_suggestion_text {
  char at[96];
} sbfi_suggestion_text;
sbfi_suggestion_text sbfi_suggestion_text_of(const sbfi_suggestion *suggestion);

#endif
