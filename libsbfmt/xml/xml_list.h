/* Converts the text of a list element, which arrives in pieces, to scalars. A number may span any number
 * of pieces. */
#ifndef SBFI_XML_LIST_H
#define SBFI_XML_LIST_H

#include "base/base64.h"
#include "model/schema.h"
#include "sbfmt/io.h"

typedef enum sbfi_xml_fault {
  SBFI_XML_FINE = 0,
  SBFI_XML_MALFORMED,    /* not a number of the list's type; in bytes: not base64 */
  SBFI_XML_NOT_FINITE,   /* a word for infinity or NaN */
  SBFI_XML_OUT_OF_RANGE, /* the type cannot represent the number */
  SBFI_XML_NOT_WHOLE,    /* ends inside an item; in bytes: inside a group of base64 */
  SBFI_XML_TOO_LONG,     /* more items than the limit */
  SBFI_XML_NO_MEMORY
} sbfi_xml_fault;

/* One for a whole load: reuses its memory for all lists. */
typedef struct sbfi_xml_list {
  const sbfi_field *field;
  uint32_t item_limit;
  sbfi_array scalars; /* of four bytes, or of one with bytes */
  sbfi_base64_reader base64;
  sbfi_text begun; /* number that was cut off at the end of the last piece */
  char wrong[41];  /* beginning of the invalid word */
} sbfi_xml_list;

void sbfi_xml_list_init(sbfi_xml_list *list, const sbf_allocator *allocator, uint32_t item_limit);
void sbfi_xml_list_free(sbfi_xml_list *list);

void sbfi_xml_list_begin(sbfi_xml_list *list, const sbfi_field *field);
/* Items from the caller's memory. */
sbfi_xml_fault sbfi_xml_list_append_given(sbfi_xml_list *list, const sbf_given_list *given);
/* On a fault `*offset` receives its offset in `text`; scalars before it are counted. */
sbfi_xml_fault sbfi_xml_list_add(sbfi_xml_list *list, const char *text, size_t length, size_t *offset);
sbfi_xml_fault sbfi_xml_list_end(sbfi_xml_list *list);
uint32_t sbfi_xml_list_count(const sbfi_xml_list *list); /* complete items so far */
size_t sbfi_xml_list_bytes(const sbfi_xml_list *list);   /* of memory used */

/* A single number in an attribute: `to` is a float, int32_t or uint32_t by the field's type. */
sbfi_xml_fault sbfi_xml_scan_number(const sbfi_field *field, const char *text, size_t length, void *to);

#endif
