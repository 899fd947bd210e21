#include "xml/xml_events.h"

#include <libxml/parser.h>
#include <libxml/xmlerror.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"

enum { PROLOG_BYTES = 256, FOREIGN_NAME_SIZE = 256, MAX_ATTRIBUTES = 256 };

/* Tag state at the end of the bytes read so far. */
typedef struct tag_counter {
  enum { OUTSIDE, BEGINNING, INSIDE } state;
  char quote;      /* quote of the open attribute value; 0: none */
  uint32_t values; /* number of attribute values */
} tag_counter;

#if LIBXML_VERSION >= 21200
typedef const xmlError *raised_error;
#else
typedef xmlErrorPtr raised_error;
#endif

typedef struct parse {
  const sbfi_xml_source *source;
  uint64_t offset;
  sbfi_xml_events *events;
  xmlParserCtxtPtr context;
  sbfi_array attributes; /* sbfi_xml_attribute */
  sbfi_text values;      /* decoded attribute values */
  tag_counter tags;
  sbf_diagnostic *error;
  sbf_status status;
  bool stopped; /* by a handler or by an error */
  bool ended;   /* the root element has ended */
  int depth;
} parse;

static void stop(parse *p) {
  p->stopped = true;
  xmlStopParser(p->context);
}

static uint32_t line_of(const parse *p) {
  const xmlParserInput *input = p->context->input;
  return input && input->line > 0 ? (uint32_t)input->line : 0;
}

__attribute__((format(printf, 4, 5))) static void fail(
    parse *p, sbf_code code, uint32_t line, const char *format, ...) {
  if (p->stopped) return;
  va_list arguments;
  va_start(arguments, format);
  p->status = sbfi_diagnose_v(p->error, code, format, arguments);
  va_end(arguments);
  if (p->error) p->error->line = line;
  stop(p);
}

/* --- bytes --- */

static bool read_source(const sbfi_xml_source *source, uint64_t offset, void *to, size_t size,
    sbf_status *status, sbf_diagnostic *error) {
  if (!source->file) {
    if (size) memcpy(to, (const char *)source->bytes + offset, size);
    return true;
  }
  *status = sbfi_file_read_at(source->file, offset, to, size, error);
  return *status == SBF_OK;
}

/* libxml2 (before 2.12) compares all pairs of attributes of an element, so a megabyte of them takes
 * minutes; real elements have at most a few dozen. Tracks tags in the byte stream; false if one has too
 * many attributes. Every `<` starts a tag, so text in a comment that resembles a tag has an effect only up
 * to the next one. */
static bool count_attributes(tag_counter *tags, const char *text, size_t size) {
  const char *end = text + size;
  while (text < end) {
    if (tags->state == OUTSIDE) {
      text = memchr(text, '<', (size_t)(end - text));
      if (!text) return true;
    }
    char c = *text++;
    if (c == '<')
      *tags = (tag_counter){.state = BEGINNING};
    else if (tags->state == BEGINNING)
      tags->state = c == '!' || c == '?' ? OUTSIDE : INSIDE;
    else if (tags->quote)
      tags->quote = c == tags->quote ? 0 : tags->quote;
    else if (c == '>')
      tags->state = OUTSIDE;
    else if (c == '"' || c == '\'') {
      tags->quote = c;
      if (++tags->values > MAX_ATTRIBUTES) return false;
    }
  }
  return true;
}

static int read_some(void *user, char *to, int capacity) {
  parse *p = user;
  uint64_t left = p->source->size - p->offset;
  size_t size = left < (uint64_t)capacity ? (size_t)left : (size_t)capacity;
  if (size == 0 || p->stopped) return 0;
  if (!read_source(p->source, p->offset, to, size, &p->status, p->error)) {
    p->stopped = true; /* the parser then reports an error of its own, which we ignore */
    return -1;
  }
  if (!count_attributes(&p->tags, to, size)) {
    p->status = sbfi_diagnose(
        p->error, SBF_CODE_XML_SYNTAX, "an element has more than %d attributes", MAX_ATTRIBUTES);
    if (p->error) p->error->line = line_of(p);
    p->stopped = true;
    return -1;
  }
  p->offset += size;
  return (int)size;
}

static bool is_utf8_name(sbfi_span name) {
  static const char *const known[] = {"utf-8", "utf8", "us-ascii", "ascii"};
  char lower[16];
  if (name.length >= sizeof lower) return false;
  for (size_t i = 0; i < name.length; i++)
    lower[i] = (char)(name.at[i] >= 'A' && name.at[i] <= 'Z' ? name.at[i] + 32 : name.at[i]);
  for (size_t i = 0; i < sizeof known / sizeof *known; i++)
    if (sbfi_span_is((sbfi_span){lower, name.length}, known[i])) return true;
  return false;
}

/* Encoding in an XML declaration; empty if there is none. */
static sbfi_span declared_encoding(sbfi_span prolog) {
  static const char key[] = "encoding";
  sbfi_span none = {NULL, 0};
  if (sbfi_span_begins(prolog, "\xef\xbb\xbf")) prolog = (sbfi_span){prolog.at + 3, prolog.length - 3};
  if (!sbfi_span_begins(prolog, "<?xml")) return none;
  for (size_t i = 0; i + sizeof key < prolog.length && prolog.at[i] != '>'; i++) {
    if (memcmp(prolog.at + i, key, sizeof key - 1) != 0) continue;
    i += sizeof key - 1;
    while (i < prolog.length && (sbfi_is_space(prolog.at[i]) || prolog.at[i] == '=')) i++;
    if (i == prolog.length || (prolog.at[i] != '"' && prolog.at[i] != '\'')) return none;
    const char *name = prolog.at + i + 1;
    const char *end = memchr(name, prolog.at[i], prolog.length - i - 1);
    return end ? (sbfi_span){name, (size_t)(end - name)} : none;
  }
  return none;
}

static sbf_status check_encoding(const sbfi_xml_source *source, sbf_diagnostic *error) {
  char bytes[PROLOG_BYTES];
  sbf_status status = SBF_OK;
  sbfi_span prolog = {bytes, source->size < sizeof bytes ? (size_t)source->size : sizeof bytes};
  if (!read_source(source, 0, bytes, prolog.length, &status, error)) return status;
  sbfi_span name = declared_encoding(prolog);
  if (sbfi_span_begins(prolog, "\xfe\xff") || sbfi_span_begins(prolog, "\xff\xfe") ||
      memchr(prolog.at, 0, prolog.length < 4 ? prolog.length : 4)) {
    name = sbfi_span_of("UTF-16 or UTF-32");
  } else if (name.length == 0 || is_utf8_name(name)) {
    return SBF_OK;
  }
  status = sbfi_diagnose(error, SBF_CODE_XML_SYNTAX, "the encoding is %.*s: save the file as UTF-8",
      name.length < 40 ? (int)name.length : 40, name.at);
  if (error) error->line = 1;
  return status;
}

/* --- libxml2's callbacks --- */

/* We keep entities, which is safe, so libxml2 returns an attribute's `&` as `&#38;` however it was
 * written; no other references are left in a value. */
static void decode_value(sbfi_text *values, sbfi_xml_attribute *attribute) {
  static const char reference[] = "&#38;";
  const char *from = attribute->value, *end = from + attribute->length;
  char *to = values->at + values->length, *begin = to; /* within the capacity */
  while (from < end) {
    bool is_reference =
        (size_t)(end - from) >= sizeof reference - 1 && memcmp(from, reference, sizeof reference - 1) == 0;
    *to++ = *from;
    from += is_reference ? sizeof reference - 1 : 1;
  }
  attribute->value = begin;
  attribute->length = (size_t)(to - begin);
  values->length += attribute->length;
}

static bool decode_values(parse *p) {
  sbfi_xml_attribute *attributes = p->attributes.at;
  size_t capacity = 0;
  for (size_t i = 0; i < p->attributes.count; i++)
    if (memchr(attributes[i].value, '&', attributes[i].length)) capacity += attributes[i].length;
  sbfi_text_clear(&p->values);
  if (capacity && !sbfi_text_reserve(&p->values, capacity)) return false;
  for (size_t i = 0; capacity && i < p->attributes.count; i++)
    if (memchr(attributes[i].value, '&', attributes[i].length)) decode_value(&p->values, &attributes[i]);
  return true;
}

static bool push_attribute(parse *p, const xmlChar **raw) {
  static const char *const passed_over[] = {
      "http://www.w3.org/XML/1998/namespace", "http://www.w3.org/2001/XMLSchema-instance"};
  for (size_t i = 0; raw[2] && i < sizeof passed_over / sizeof *passed_over; i++)
    if (strcmp((const char *)raw[2], passed_over[i]) == 0) return true;
  sbfi_xml_attribute *attribute = sbfi_array_push(&p->attributes, 1);
  if (!attribute) return false;
  /* the prefix marks an attribute of another namespace, which is unknown here */
  attribute->name = (const char *)(raw[1] ? raw[1] : raw[0]);
  attribute->value = (const char *)raw[3];
  attribute->length = (size_t)(raw[4] - raw[3]);
  return true;
}

/* libxml2 passes on a truncated tag, with a truncated name, before it raises the error. */
static bool tag_is_closed(const parse *p) {
  const xmlParserInput *input = p->context->input;
  return input && input->cur < input->end && (*input->cur == '>' || *input->cur == '/');
}

static void on_start(void *user, const xmlChar *name, const xmlChar *prefix, const xmlChar *uri,
    int namespace_count, const xmlChar **namespaces, int attribute_count, int defaulted_count,
    const xmlChar **raw) {
  (void)prefix, (void)namespace_count, (void)namespaces, (void)defaulted_count;
  parse *p = user;
  if (p->stopped || !tag_is_closed(p)) return;
  p->attributes.count = 0;
  bool good = true;
  for (int i = 0; i < attribute_count && good; i++) good = push_attribute(p, raw + (size_t)i * 5);
  if (!good || !decode_values(p)) {
    fail(p, SBF_CODE_OUT_OF_MEMORY, line_of(p), "memory ran out for an element's attributes");
    return;
  }
  const char *full = (const char *)name;
  char foreign[FOREIGN_NAME_SIZE];
  if (uri) {
    snprintf(foreign, sizeof foreign, "{%s}%s", (const char *)uri, full);
    full = foreign;
  }
  p->events->line = line_of(p);
  p->depth++;
  if (!p->events->start(p->events->user, full, p->attributes.at, (uint32_t)p->attributes.count)) stop(p);
}

static void on_end(void *user, const xmlChar *name, const xmlChar *prefix, const xmlChar *uri) {
  (void)name, (void)prefix, (void)uri;
  parse *p = user;
  if (p->stopped) return;
  p->events->line = line_of(p);
  p->ended = --p->depth == 0;
  if (!p->events->end(p->events->user)) stop(p);
}

static void on_text(void *user, const xmlChar *text, int length) {
  parse *p = user;
  if (p->stopped) return;
  p->events->line = line_of(p);
  if (!p->events->text(p->events->user, (const char *)text, (size_t)length)) stop(p);
}

static void on_doctype(void *user, const xmlChar *name, const xmlChar *external, const xmlChar *system) {
  (void)name, (void)external, (void)system;
  parse *p = user;
  fail(p, SBF_CODE_XML_DOCTYPE, line_of(p),
      "found a DOCTYPE: remove it, the format has neither a DOCTYPE nor entities");
}

static xmlEntityPtr on_entity(void *user, const xmlChar *name) {
  parse *p = user;
  fail(p, SBF_CODE_XML_DOCTYPE, line_of(p),
      "the entity &%.60s; is not one of XML's five: write the character itself", (const char *)name);
  return NULL;
}

/* libxml2 has one code for invalid UTF-8 and for characters that XML forbids. */
static bool stands_on_broken_utf8(const parse *p) {
  const xmlParserInput *input = p->context->input;
  if (!input || input->cur >= input->end) return false;
  size_t left = (size_t)(input->end - input->cur);
  return sbfi_utf8_check((const char *)input->cur, left < 4 ? left : 4) == 0;
}

static sbf_code code_of(const parse *p, raised_error found) {
  switch (found->code) {
  case XML_ERR_NO_MEMORY:
    return SBF_CODE_OUT_OF_MEMORY;
  case XML_ERR_INVALID_ENCODING:
    return SBF_CODE_NOT_UTF8;
  case XML_ERR_INVALID_CHAR:
    return stands_on_broken_utf8(p) ? SBF_CODE_NOT_UTF8 : SBF_CODE_XML_SYNTAX;
  case XML_ERR_UNDECLARED_ENTITY:
    return SBF_CODE_XML_DOCTYPE;
  default:
    return SBF_CODE_XML_SYNTAX;
  }
}

static const char *advice_of(sbf_code code) {
  switch (code) {
  case SBF_CODE_OUT_OF_MEMORY:
    return "memory ran out in the XML parser";
  case SBF_CODE_NOT_UTF8:
    return "the text is not valid UTF-8: save the file in that encoding";
  case SBF_CODE_XML_DOCTYPE:
    return "an entity is not one of XML's five: write the character itself";
  default:
    return "not well-formed XML";
  }
}

/* libxml2 may continue after an error; we stop. */
static void on_error(void *user, raised_error found) {
  parse *p = user;
  if (found->level < XML_ERR_ERROR || p->stopped) return;
  sbf_code code = code_of(p, found);
  const char *detail = found->message ? found->message : "";
  size_t length = strcspn(detail, "\n");
  if (code == SBF_CODE_XML_SYNTAX)
    fail(p, code, found->line > 0 ? (uint32_t)found->line : 0, "%s: %.*s", advice_of(code), (int)length,
        detail);
  else
    fail(p, code, found->line > 0 ? (uint32_t)found->line : 0, "%s", advice_of(code));
}

/* Catches messages outside any parser (such as out of memory), which libxml2 would print. */
static void ignore_error(void *user, raised_error found) {
  (void)user, (void)found;
}

static const xmlSAXHandler handlers = {.internalSubset = on_doctype,
    .getEntity = on_entity,
    .characters = on_text,
    .ignorableWhitespace = on_text,
    .cdataBlock = on_text,
    .startElementNs = on_start,
    .endElementNs = on_end,
    .serror = on_error,
    .initialized = XML_SAX2_MAGIC};

/* --- the parse --- */

static void run(parse *p) {
  p->context = xmlNewParserCtxt();
  if (!p->context) {
    p->status = sbfi_diagnose(p->error, SBF_CODE_OUT_OF_MEMORY, "memory ran out for the XML parser");
    return;
  }
  *p->context->sax = handlers; /* build no document: the read returns NULL */
  p->context->userData = p;
  xmlFreeDoc(
      xmlCtxtReadIO(p->context, read_some, NULL, p, NULL, NULL, XML_PARSE_NONET | XML_PARSE_BIG_LINES));
  /* it stops without an error if memory for its input runs out */
  bool no_memory = p->context->errNo == XML_ERR_NO_MEMORY || (p->context->wellFormed && !p->ended);
  if (!p->stopped && (!p->context->wellFormed || !p->ended)) {
    sbf_code code = no_memory ? SBF_CODE_OUT_OF_MEMORY : SBF_CODE_XML_SYNTAX;
    fail(p, code, line_of(p), "%s", advice_of(code));
  }
  xmlFreeParserCtxt(p->context);
}

sbf_status sbfi_xml_parse(const sbfi_xml_source *source, sbfi_xml_events *events,
    const sbf_allocator *allocator, sbf_diagnostic *error) {
  sbf_status status = check_encoding(source, error);
  if (status != SBF_OK) return status;
  parse p = {.source = source, .events = events, .error = error};
  sbfi_array_init(&p.attributes, allocator, sizeof(sbfi_xml_attribute));
  sbfi_text_init(&p.values, allocator);
  xmlInitParser();
  xmlStructuredErrorFunc before = xmlStructuredError;
  void *before_context = xmlStructuredErrorContext;
  xmlSetStructuredErrorFunc(NULL, ignore_error);
  run(&p);
  xmlSetStructuredErrorFunc(before_context, before);
  sbfi_array_free(&p.attributes);
  sbfi_text_free(&p.values);
  return p.status;
}
