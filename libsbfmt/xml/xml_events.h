/* XML as a stream of events, from memory or from a file; the only user of libxml2.
 *
 * Safe against hostile input: builds no tree, rejects a DOCTYPE as soon as its name is read (so only XML's
 * five entities exist), fetches nothing, allows at most 256 attributes per element, and keeps libxml2's
 * limits for names, attributes and comments (10 million characters). Text arrives in pieces of any length.
 * Reads only UTF-8: other encodings would call the system's converters with a name from the file. */
#ifndef SBFI_XML_EVENTS_H
#define SBFI_XML_EVENTS_H

#include "base/file.h"

/* Source of the bytes: `file` unless it is NULL, else memory. May be parsed several times. */
typedef struct sbfi_xml_source {
  const sbfi_file *file;
  const void *bytes;
  uint64_t size;
} sbfi_xml_source;

/* The value is not NUL-terminated; entities are already replaced. */
typedef struct sbfi_xml_attribute {
  const char *name;
  const char *value;
  size_t length;
} sbfi_xml_attribute;

/* Handlers return whether to continue. A name in a namespace is {uri}name; attributes of XML itself or XML
 * Schema (xml:lang, xsi:...) are skipped. Arguments are valid during the call. */
typedef struct sbfi_xml_events {
  bool (*start)(void *user, const char *name, const sbfi_xml_attribute *attributes, uint32_t count);
  bool (*text)(void *user, const char *text, size_t length);
  bool (*end)(void *user);
  void *user;
  uint32_t line; /* set before each call: line of the end of the tag or piece of text */
} sbfi_xml_events;

/* Also SBF_OK if a handler ended the parse. Otherwise `*error` has the reason and the line. libxml2 uses
 * malloc, everything else `allocator`. */
sbf_status sbfi_xml_parse(const sbfi_xml_source *source, sbfi_xml_events *events,
    const sbf_allocator *allocator, sbf_diagnostic *error);

#endif
