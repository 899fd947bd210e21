/* XML as a stream of events, from memory or from a file: the only place that knows libxml2.
 *
 * Hostile input: no tree is built, a DOCTYPE is refused as soon as its name is read (so there are no entities
 * but XML's five), nothing is ever fetched, an element has 256 attributes at most, and libxml2's own limits
 * on the length of names, attributes and comments stay on (10 million characters). Text comes in pieces as it
 * is read and may be of any length. Only UTF-8 is read: other encodings would bring in the system's
 * converters by a name that the file chooses. */
#ifndef SBFI_XML_EVENTS_H
#define SBFI_XML_EVENTS_H

#include "base/file.h"

/* Where the bytes come from: `file` where it is not NULL, else memory. May be parsed several times. */
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

/* Each returns whether to go on. A name in a namespace reads {uri}name; attributes that XML itself or XML
 * Schema own (xml:lang, xsi:...) are left out. What is passed in lives until the call returns. */
typedef struct sbfi_xml_events {
  bool (*start)(void *user, const char *name, const sbfi_xml_attribute *attributes, uint32_t count);
  bool (*text)(void *user, const char *text, size_t length);
  bool (*end)(void *user);
  void *user;
  uint32_t line; /* set before each call: where the tag ends, or the piece of text does */
} sbfi_xml_events;

/* SBF_OK also where a handler ended the parse. Otherwise `*error` says what is wrong, on which line.
 * libxml2's own memory comes from malloc, all else from `allocator`. */
sbf_status sbfi_xml_parse(const sbfi_xml_source *source, sbfi_xml_events *events,
    const sbf_allocator *allocator, sbf_diagnostic *error);

#endif
