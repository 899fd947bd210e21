/* Looks up names of the XML form in the schema. */
#ifndef SBFI_XML_SCHEMA_H
#define SBFI_XML_SCHEMA_H

#include "base/suggest.h"
#include "model/element_path.h"

/* Field of an element with that name inside `element`: a list, a text, a wrapper or children. NULL if
 * there is none. */
const sbfi_field *sbfi_xml_find_element(const sbfi_element *element, const char *name);
/* Whether children of the field, or those in its wrapper, have that name. If the name encodes an enum
 * value, `*value` receives it, else -1. */
bool sbfi_xml_is_child(const sbfi_field *field, const char *name, int32_t *value);
/* Attribute with that name of an element contained in `holder` (NULL: the root). */
const sbfi_field *sbfi_xml_find_attribute(
    const sbfi_element *element, const sbfi_field *holder, const char *name);

/* Suggestion for a wrong name. */
sbfi_suggestion_text sbfi_xml_suggest_element(const sbfi_element *element, const char *name);
sbfi_suggestion_text sbfi_xml_suggest_child(const sbfi_field *field, const char *name);
sbfi_suggestion_text sbfi_xml_suggest_attribute(
    const sbfi_element *element, const sbfi_field *holder, const char *name);

/* Values of an enum field, for a message: "lag, distance". */
typedef struct sbfi_xml_words {
  char at[160];
} sbfi_xml_words;
sbfi_xml_words sbfi_xml_words_of(const sbfi_field *field);

#endif
