#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "text_forms.h"

typedef struct span {
  const char *at;
  size_t length;
} span;

enum { NONE = -1, DEEPEST = 512 };

typedef struct joint_node {
  span id, sid, name;
  int parent;
  bool is_joint;
} joint_node;

typedef struct name_list {
  span id, names; /* id of the source; text of its array */
  int controller;
} name_list;

typedef struct controller {
  span id, joints; /* id of the source of its joints' names */
  int skeleton;    /* root node of its joints; NONE: not stated */
  bool instanced, several;
} controller;

typedef struct items {
  void *at;
  int count, capacity;
} items;

typedef struct document {
  items nodes, lists, controllers;
  int open_nodes[DEEPEST], depth;
  /* currently open; NONE: none. `instance`: the controller that it refers to */
  int controller, list, instance;
  bool out_of_memory;
} document;

static void *push(document *d, items *list, size_t size) {
  if (list->count == list->capacity) {
    int capacity = list->capacity ? 2 * list->capacity : 64;
    void *grown = capacity < INT32_MAX / 4 ? realloc(list->at, (size_t)capacity * size) : NULL;
    if (!grown) {
      d->out_of_memory = true;
      return NULL;
    }
    list->at = grown;
    list->capacity = capacity;
  }
  return memset((char *)list->at + (size_t)list->count++ * size, 0, size);
}

static joint_node *node_at(const document *d, int i) {
  return (joint_node *)d->nodes.at + i;
}
static controller *controller_at(const document *d, int i) {
  return (controller *)d->controllers.at + i;
}
static name_list *list_at(const document *d, int i) {
  return (name_list *)d->lists.at + i;
}

static bool same(span a, span b) {
  return a.length == b.length && (a.length == 0 || memcmp(a.at, b.at, a.length) == 0);
}
static bool is(span a, const char *word) {
  return same(a, (span){word, strlen(word)});
}

static bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

static span trimmed(span text) {
  while (text.length && is_blank(*text.at)) text.at++, text.length--;
  while (text.length && is_blank(text.at[text.length - 1])) text.length--;
  return text;
}

static span without_hash(span reference) {
  reference = trimmed(reference);
  return reference.length && *reference.at == '#' ? (span){reference.at + 1, reference.length - 1}
                                                  : reference;
}

/* Value of an attribute in the text of a tag; empty if it is missing. */
static span attribute(span tag, const char *name) {
  size_t length = strlen(name);
  for (size_t i = 1; i + length + 2 < tag.length; i++) {
    if (!is_blank(tag.at[i - 1]) || memcmp(tag.at + i, name, length) != 0) continue;
    size_t k = i + length;
    while (k < tag.length && is_blank(tag.at[k])) k++;
    if (k >= tag.length || tag.at[k++] != '=') continue;
    while (k < tag.length && is_blank(tag.at[k])) k++;
    if (k >= tag.length || (tag.at[k] != '"' && tag.at[k] != '\'')) continue;
    const char *begin = tag.at + k + 1, *end = memchr(begin, tag.at[k], tag.length - k - 1);
    if (end) return (span){begin, (size_t)(end - begin)};
  }
  return (span){"", 0};
}

static int node_with_id(const document *d, span id) {
  for (int i = 0; i < d->nodes.count; i++)
    if (id.length && same(node_at(d, i)->id, id)) return i;
  return NONE;
}

static int controller_with_id(const document *d, span id) {
  for (int i = 0; i < d->controllers.count; i++)
    if (same(controller_at(d, i)->id, id)) return i;
  return NONE;
}

static void open_node(document *d, span tag, bool closed) {
  joint_node *made = push(d, &d->nodes, sizeof *made);
  if (!made) return;
  int open = d->depth > 0 && d->depth <= DEEPEST ? d->open_nodes[d->depth - 1] : NONE;
  *made = (joint_node){attribute(tag, "id"), attribute(tag, "sid"), attribute(tag, "name"), open,
      is(attribute(tag, "type"), "JOINT")};
  if (closed) return;
  if (d->depth < DEEPEST) d->open_nodes[d->depth] = d->nodes.count - 1;
  d->depth++;
}

static void open_controller(document *d, span tag) {
  controller *made = push(d, &d->controllers, sizeof *made);
  if (!made) return;
  *made = (controller){.id = attribute(tag, "id"), .skeleton = NONE};
  d->controller = d->controllers.count - 1;
}

static void open_source(document *d, span tag) {
  name_list *made = push(d, &d->lists, sizeof *made);
  if (!made) return;
  *made = (name_list){.id = attribute(tag, "id"), .controller = d->controller};
  d->list = d->lists.count - 1;
}

static void set_skeleton(document *d, span text) {
  controller *shown = controller_at(d, d->instance);
  int node = node_with_id(d, without_hash(text));
  if (node == NONE) return;
  shown->several = shown->several || (shown->skeleton != NONE && shown->skeleton != node);
  shown->skeleton = node;
}

/* `text`: text between this tag and the next one. */
static void read_tag(document *d, span name, span tag, span text, bool closed) {
  if (is(name, "node")) {
    open_node(d, tag, closed);
  } else if (is(name, "/node")) {
    d->depth -= d->depth > 0;
  } else if (is(name, "controller")) {
    open_controller(d, tag);
  } else if (is(name, "/controller")) {
    d->controller = NONE;
  } else if (is(name, "source") && d->controller != NONE) {
    open_source(d, tag);
  } else if ((is(name, "Name_array") || is(name, "IDREF_array")) && d->controller != NONE &&
             d->list != NONE) {
    list_at(d, d->list)->names = text;
  } else if (is(name, "input") && d->controller != NONE && is(attribute(tag, "semantic"), "JOINT")) {
    controller_at(d, d->controller)->joints = without_hash(attribute(tag, "source"));
  } else if (is(name, "instance_controller")) {
    d->instance = controller_with_id(d, without_hash(attribute(tag, "url")));
  } else if (is(name, "/instance_controller")) {
    d->instance = NONE;
  } else if (is(name, "skeleton") && d->instance != NONE) {
    set_skeleton(d, text);
  }
}

static const char *find(const char *at, const char *end, const char *word) {
  size_t length = strlen(word);
  for (; at && (size_t)(end - at) >= length; at++) {
    at = memchr(at, *word, (size_t)(end - at) - length + 1);
    if (!at || memcmp(at, word, length) == 0) return at;
  }
  return NULL;
}

/* Two passes, because skeletons may come after the instances that refer to them. */
static void walk(document *d, const char *text, size_t size, bool instances) {
  const char *end = text + size, *at = memchr(text, '<', size);
  while (at) {
    bool comment = end - at > 4 && memcmp(at, "<!--", 4) == 0;
    const char *close = comment ? find(at, end, "-->") : memchr(at, '>', (size_t)(end - at));
    if (!close) return;
    const char *next = memchr(close, '<', (size_t)(end - close));
    span tag = {at + 1, (size_t)(close - at) - 1}, name = {tag.at, 0};
    while (name.length < tag.length && !is_blank(tag.at[name.length]) &&
           (tag.at[name.length] != '/' || name.length == 0))
      name.length++;
    span inside = {close + 1, (size_t)((next ? next : end) - close) - 1};
    bool of_instance =
        is(name, "instance_controller") || is(name, "/instance_controller") || is(name, "skeleton");
    if (!comment && of_instance == instances)
      read_tag(d, name, tag, inside, tag.length && tag.at[tag.length - 1] == '/');
    at = next;
  }
}

static bool is_below(const document *d, int node, int root) {
  while (node != NONE && node != root) node = node_at(d, node)->parent;
  return node == root;
}

/* Joint with that short id below a skeleton; NONE if there is none or it has no id. */
static int joint_below(const document *d, span sid, int root) {
  for (int i = 0; i < d->nodes.count; i++)
    if (same(node_at(d, i)->sid, sid) && node_at(d, i)->id.length && is_below(d, i, root)) return i;
  return NONE;
}

static int count_sids(const document *d, span sid) {
  int count = 0;
  for (int i = 0; i < d->nodes.count; i++) count += same(node_at(d, i)->sid, sid);
  return count;
}

/* assimp looks up names and ids of nodes before short ids, so an object with the name of a joint hides it. */
static bool is_named_elsewhere(const document *d, span name, int joint) {
  for (int i = 0; i < d->nodes.count; i++)
    if (i != joint && (same(node_at(d, i)->name, name) || same(node_at(d, i)->id, name))) return true;
  return false;
}

typedef struct output {
  char *at;
  size_t size, capacity;
  bool failed;
} output;

static void append(output *o, span text) {
  if (o->size + text.length > o->capacity) {
    size_t capacity = 2 * (o->size + text.length);
    char *grown = realloc(o->at, capacity);
    o->failed = o->failed || !grown;
    if (!grown) return;
    o->at = grown;
    o->capacity = capacity;
  }
  if (text.length) memcpy(o->at + o->size, text.at, text.length);
  o->size += text.length;
}

/* Appends the names; replaces those that also refer to a joint of another skeleton. */
static text_verdict rename_list(
    const document *d, const name_list *list, output *to, bool *changed, char why[TEXT_WHY]) {
  const controller *c = controller_at(d, list->controller);
  span rest = list->names;
  while (rest.length) {
    size_t blanks = 0, length = 0;
    while (blanks < rest.length && is_blank(rest.at[blanks])) blanks++;
    append(to, (span){rest.at, blanks});
    rest = (span){rest.at + blanks, rest.length - blanks};
    while (length < rest.length && !is_blank(rest.at[length])) length++;
    span name = {rest.at, length};
    rest = (span){rest.at + length, rest.length - length};
    if (!length) continue;
    bool is_shared = count_sids(d, name) > 1;
    int joint = c->several || c->skeleton == NONE ? NONE : joint_below(d, name, c->skeleton);
    if (is_shared && joint == NONE) {
      snprintf(why, TEXT_WHY,
          "the skin '%.*s' names a joint '%.*s' that several skeletons have, and %s: export each skeleton "
          "separately",
          (int)(c->id.length < 60 ? c->id.length : 60), c->id.at, (int)(length < 60 ? length : 60), name.at,
          c->several ? "is used with several of them" : "does not say which one it uses");
      return TEXT_REFUSED;
    }
    bool replace = joint != NONE && (is_shared || is_named_elsewhere(d, name, joint));
    *changed = *changed || replace;
    append(to, replace ? node_at(d, joint)->id : name);
  }
  return TEXT_REWRITTEN;
}

static text_verdict rename_lists(
    const document *d, const char *text, size_t size, output *to, bool *changed, char why[TEXT_WHY]) {
  const char *at = text;
  for (int i = 0; i < d->lists.count; i++) {
    const name_list *list = list_at(d, i);
    if (!list->names.length || !same(controller_at(d, list->controller)->joints, list->id)) continue;
    append(to, (span){at, (size_t)(list->names.at - at)});
    text_verdict verdict = rename_list(d, list, to, changed, why);
    if (verdict == TEXT_REFUSED) return verdict;
    at = list->names.at + list->names.length;
  }
  append(to, (span){at, (size_t)(text + size - at)});
  return TEXT_REWRITTEN;
}

static void free_document(const document *d) {
  free(d->nodes.at);
  free(d->lists.at);
  free(d->controllers.at);
}

text_verdict collada_name_joints(
    const char *text, size_t size, char **rewritten, size_t *rewritten_size, char why[TEXT_WHY]) {
  document d = {.controller = NONE, .list = NONE, .instance = NONE};
  output to = {0};
  bool changed = false;
  walk(&d, text, size, false);
  walk(&d, text, size, true);
  text_verdict verdict = TEXT_AS_IT_IS;
  if (d.controllers.count > 0 && !d.out_of_memory) verdict = rename_lists(&d, text, size, &to, &changed, why);
  if (d.out_of_memory || to.failed) verdict = TEXT_NO_MEMORY;
  if (verdict == TEXT_REWRITTEN && !changed) verdict = TEXT_AS_IT_IS;
  if (verdict == TEXT_REWRITTEN)
    *rewritten = to.at, *rewritten_size = to.size;
  else
    free(to.at);
  free_document(&d);
  return verdict;
}

void collada_find_joints(
    const char *text, size_t size, void (*found)(void *user, const char *id, size_t length), void *user) {
  document d = {.controller = NONE, .list = NONE, .instance = NONE};
  walk(&d, text, size, false);
  for (int i = 0; i < d.nodes.count; i++) {
    const joint_node *node = node_at(&d, i);
    span id = node->id.length ? node->id : node->sid;
    if (node->is_joint && id.length) found(user, id.at, id.length);
  }
  free_document(&d);
}
