#include "build/build_settings.h"

#include "base/text.h"

static bool take_flag(sbfi_span value, bool *without) {
  *without = sbfi_span_is(value, "false");
  return *without || sbfi_span_is(value, "true");
}

static bool take_interior(sbfi_span value, sbf_build_options *options) {
  static const char *const words[] = {"automatic", "centroid", "none"}; /* as sbf_build_interior */
  for (size_t i = 0; i < sizeof words / sizeof *words; i++)
    if (sbfi_span_is(value, words[i])) {
      options->interior = (sbf_build_interior)i;
      return true;
    }
  return false;
}

bool sbfi_build_settings_read(const char *text, sbf_build_options *options) {
  sbfi_span rest = sbfi_span_of(text), word;
  while (sbfi_span_next_word(&rest, &word)) {
    size_t equals = 0;
    while (equals < word.length && word.at[equals] != '=') equals++;
    if (equals == word.length) return false;
    sbfi_span name = {word.at, equals}, value = {word.at + equals + 1, word.length - equals - 1};
    bool known = sbfi_span_is(name, "embeddings") ? take_flag(value, &options->without_embeddings)
                 : sbfi_span_is(name, "flexion")  ? take_flag(value, &options->without_flexion)
                 : sbfi_span_is(name, "hulls")    ? take_flag(value, &options->without_hulls)
                 : sbfi_span_is(name, "interior") ? take_interior(value, options)
                                                  : false;
    if (!known) return false;
  }
  return true;
}
