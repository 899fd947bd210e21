#include "base/suggest.h"

#include <stdio.h>
#include <string.h>

enum { LONGEST = 48 }; /* longer words are never close to anything */

static size_t min(size_t a, size_t b, size_t c) {
  size_t min_of_two = a < b ? a : b;
  return min_of_two < c ? min_of_two : c;
}

/* Number of insertions, deletions, replacements and swaps of neighbours between two words: the optimal string
 * alignment distance. */
static size_t distance(sbfi_span a, sbfi_span b) {
  size_t rows[3][LONGEST + 1];
  for (size_t j = 0; j <= b.length; j++) rows[0][j] = j;
  for (size_t i = 1; i <= a.length; i++) {
    size_t *row = rows[i % 3];
    const size_t *above = rows[(i + 2) % 3], *two_above = rows[(i + 1) % 3];
    row[0] = i;
    for (size_t j = 1; j <= b.length; j++) {
      bool same = a.at[i - 1] == b.at[j - 1];
      row[j] = min(row[j - 1] + 1, above[j] + 1, above[j - 1] + !same);
      bool swapped = i > 1 && j > 1 && a.at[i - 1] == b.at[j - 2] && a.at[i - 2] == b.at[j - 1];
      if (swapped && two_above[j - 2] + 1 < row[j]) row[j] = two_above[j - 2] + 1;
    }
  }
  return rows[a.length % 3][b.length];
}

sbfi_suggestion sbfi_suggestion_for(sbfi_span word) {
  return (sbfi_suggestion){.word = word, .distance = word.length < 4 ? 2 : word.length / 3 + 2};
}

void sbfi_suggestion_consider(sbfi_suggestion *suggestion, const char *known) {
  sbfi_span other = sbfi_span_of(known);
  if (suggestion->word.length > LONGEST || other.length > LONGEST) return;
  size_t far = distance(suggestion->word, other);
  if (far >= suggestion->distance || far >= other.length) return;
  suggestion->best = known;
  suggestion->distance = far;
}

sbfi_suggestion_text sbfi_suggestion_text_of(const sbfi_suggestion *suggestion) {
  sbfi_suggestion_text text = {""};
  if (suggestion->best) snprintf(text.at, sizeof text.at, ": did you mean `%s`?", suggestion->best);
  return text;
}
