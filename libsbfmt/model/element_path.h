/* Where a walk over an asset stands, so that any finding can say where it is and any length rule can look up.
 *
 * A walk is a chain of places on the C stack: a place for the root, then one for each child stepped into. Its
 * depth is bounded by the schema, in which no element holds itself. */
#ifndef SBFI_ELEMENT_PATH_H
#define SBFI_ELEMENT_PATH_H

#include "model/schema.h"
#include "sbfmt/model.h"

typedef struct sbfi_element_path {
  const struct sbfi_element_path *up; /* NULL at the root */
  const sbfi_element *element;
  const void *object;
  const sbfi_field *field; /* of the object above, which holds this one; NULL at the root */
  uint32_t index;          /* among the children of that field */
} sbfi_element_path;

sbfi_element_path sbfi_element_path_root(const sbf_asset *asset);

/* How many children the field holds here: 0 for what is no child, 0 or 1 for an optional one. */
uint32_t sbfi_child_count(const void *object, const sbfi_field *field);
/* The place of one of them. */
sbfi_element_path sbfi_element_path_child(
    const sbfi_element_path *up, const sbfi_field *field, uint32_t index);

/* The element path, as XPath would have it: /sbf/soft_body[2]/polygon_mesh/positions, and /@name for what XML
 * writes as an attribute. `field` is one of the place's element, or NULL for the place itself. Cut to fit. */
void sbfi_element_path_print(
    const sbfi_element_path *location, const sbfi_field *field, char *path, size_t size);

/* What a length rule asks for here. */
uint64_t sbfi_length_value(const sbfi_length *length, const sbfi_element_path *path);
/* False where it sums the items of a list that an outline has left out. */
bool sbfi_length_is_known(const sbfi_length *length, const sbfi_element_path *path);
/* The list that a counting or summing term looks at. */
sbfi_list sbfi_term_list(const sbfi_term *term, const sbfi_element_path *path);

/* Whether the XML form writes the field as an attribute. */
bool sbfi_field_is_attribute(const sbfi_field *field);

#endif
