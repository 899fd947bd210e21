#include <stdio.h>
#include <string.h>

#include "text_forms.h"

static bool begins_with(const char *at, const char *end, const char *word) {
  size_t length = strlen(word);
  return (size_t)(end - at) >= length && memcmp(at, word, length) == 0;
}

text_verdict text_find_not_finite(const char *text, size_t size, char why[TEXT_WHY]) {
  static const char *const words[] = {"#IND", "#INF", "#QNAN", "#SNAN"};
  const char *end = text + size;
  unsigned long line = 1;
  bool quoted = false;
  for (const char *at = text; at < end; at++) {
    line += *at == '\n';
    quoted = *at == '"' ? !quoted : quoted && *at != '\n';
    if (quoted || *at != '#' || at - text < 2 || at[-1] != '.' || at[-2] < '0' || at[-2] > '9') continue;
    for (size_t w = 0; w < sizeof words / sizeof *words; w++) {
      if (!begins_with(at, end, words[w])) continue;
      snprintf(why, TEXT_WHY, "line %lu has %c.%s, which is not a number", line, at[-2], words[w]);
      return TEXT_NOT_FINITE;
    }
  }
  return TEXT_AS_IT_IS;
}
