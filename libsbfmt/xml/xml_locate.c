/* Finds lines of findings. A load keeps no line numbers: only on errors a second pass over the file
 * follows the findings' paths. */
#include <stdlib.h>

#include "base/diagnostic.h"
#include "base/text.h"
#include "xml/xml_reader.h"
#include "xml/xml_schema.h"

enum { DEEPEST = 16 };

/* The path of a finding as steps, and how many the open elements match. */
typedef struct target {
  sbf_diagnostic *diagnostic;
  sbfi_span names[DEEPEST];
  uint32_t numbers[DEEPEST]; /* among siblings of the same name, from 1 */
  uint32_t depth;            /* number of steps */
  uint32_t item_scalars;     /* of a list; 0: searches the element itself */
  uint64_t scalar;           /* of a list: index of the scalar to find */
  uint32_t matched;          /* steps matched by the innermost open elements */
  uint32_t seen[DEEPEST];    /* elements with that name so far, for each step */
  uint64_t scalars;          /* number of scalars of the list so far */
  bool in_list, in_number, found;
} target;

typedef struct locator {
  target *targets;
  size_t count, unfound;
  uint32_t open; /* number of open elements */
  sbfi_xml_events events;
} locator;

static void add_step(target *t, sbfi_span step) {
  const char *bracket = memchr(step.at, '[', step.length);
  if (t->depth == DEEPEST) return;
  t->numbers[t->depth] = bracket ? (uint32_t)strtoul(bracket + 1, NULL, 10) : 1;
  t->names[t->depth] = (sbfi_span){step.at, bracket ? (size_t)(bracket - step.at) : step.length};
  t->depth++;
}

static void cut_path(target *t) {
  const char *path = t->diagnostic->path;
  while (*path == '/' && path[1] != '@') {
    size_t length = strcspn(path + 1, "/");
    add_step(t, (sbfi_span){path + 1, length});
    path += 1 + length;
  }
}

/* Number of scalars in an item of the path's list; 0 if it is not a list. */
static uint32_t width_of(const target *t) {
  const sbfi_element *element = &sbfi_asset_element;
  const sbfi_field *field = NULL;
  for (uint32_t i = 1; i < t->depth; i++) {
    char name[96];
    sbfi_copy_text(
        name, t->names[i].length + 1 < sizeof name ? t->names[i].length + 1 : sizeof name, t->names[i].at);
    bool in_wrapper = field && field->tag.wrapper && element != field->element;
    if (in_wrapper) {
      element = field->element;
      continue;
    }
    field = sbfi_xml_find_element(element, name);
    if (!field) return 0;
    if (field->element && !field->tag.wrapper) element = field->element;
  }
  return field && field->type == SBFI_LIST ? field->width : 0;
}

static void hit(locator *l, target *t, uint32_t line) {
  t->diagnostic->line = line;
  t->found = true;
  l->unfound--;
}

static bool on_start(void *user, const char *name, const sbfi_xml_attribute *attributes, uint32_t count) {
  locator *l = user;
  (void)attributes, (void)count;
  for (size_t i = 0; i < l->count; i++) {
    target *t = &l->targets[i];
    uint32_t step = t->matched;
    if (t->found || step != l->open || step == t->depth || !sbfi_span_is(t->names[step], name)) continue;
    if (++t->seen[step] != t->numbers[step]) continue;
    t->matched = step + 1;
    if (step + 1 < t->depth) {
      t->seen[step + 1] = 0;
    } else if (!t->item_scalars) {
      hit(l, t, l->events.line);
    } else {
      t->diagnostic->line = l->events.line; /* in case the item is missing */
      t->in_list = true;
    }
  }
  l->open++;
  return l->unfound > 0;
}

/* Counts words until the target begins. A number may continue from the previous piece. */
static void count_words(locator *l, target *t, const char *text, size_t length) {
  for (size_t i = 0; i < length; i++) {
    bool space = sbfi_is_space(text[i]);
    if (!space && !t->in_number && t->scalars++ == t->scalar) {
      uint32_t line = l->events.line;
      for (size_t k = i; k < length; k++) line -= text[k] == '\n';
      hit(l, t, line);
      return;
    }
    t->in_number = !space;
  }
}

static bool on_text(void *user, const char *text, size_t length) {
  locator *l = user;
  for (size_t i = 0; i < l->count; i++)
    if (l->targets[i].in_list && !l->targets[i].found) count_words(l, &l->targets[i], text, length);
  return l->unfound > 0;
}

static bool on_end(void *user) {
  locator *l = user;
  l->open--;
  for (size_t i = 0; i < l->count; i++) {
    target *t = &l->targets[i];
    if (t->matched > l->open) t->matched = l->open;
    t->in_list = false;
  }
  return true;
}

void sbfi_xml_locate(
    const sbfi_xml_source *source, const sbf_allocator *allocator, sbfi_xml_findings *findings) {
  locator l = {.events = {.start = on_start, .text = on_text, .end = on_end, .user = &l}};
  size_t bytes = findings->count * sizeof *l.targets;
  l.targets = sbfi_allocate(allocator, bytes);
  if (!l.targets) return; /* without memory findings have no line */
  for (uint32_t i = 0; i < findings->count; i++) {
    sbf_diagnostic *diagnostic = &findings->at[i];
    if (diagnostic->line || !*diagnostic->path) continue;
    target *t = &l.targets[l.count++];
    *t = (target){.diagnostic = diagnostic};
    cut_path(t);
    if (diagnostic->index < 0) continue;
    t->item_scalars = width_of(t);
    t->scalar = (uint64_t)diagnostic->index * t->item_scalars;
  }
  l.unfound = l.count;
  sbf_diagnostic ignored;
  if (l.count) sbfi_xml_parse(source, &l.events, allocator, &ignored);
  sbfi_free(allocator, l.targets, bytes);
}
