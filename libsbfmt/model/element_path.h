/* Current position of a walk over an asset, for paths in findings and length rules that refer to ancestors.
 *
 * A walk is a linked list on the C stack: an entry for the root, then one for each nested child. The
 * schema bounds its depth, because no element contains itself. */
#ifndef SBFI_ELEMENT_PATH_H
#define SBFI_ELEMENT_PATH_H

#include "model/schema.h"
#include "sbfmt/model.h"

typedef struct sbfi_element_path {
  const struct sbfi_element_path *up; /* NULL at the root */
  const sbfi_element *element;
  const void *object;
  const sbfi_field *field; /* field of the parent that contains this object; NULL at the root */
  uint32_t index;          /* among the children of that field */
} sbfi_element_path;

sbfi_element_path sbfi_element_path_root(const sbf_asset *asset);

/* Number of children of the field: 0 for other fields, 0 or 1 for an optional one. */
uint32_t sbfi_child_count(const void *object, const sbfi_field *field);
/* Position of one of them. */
sbfi_element_path sbfi_element_path_child(
    const sbfi_element_path *up, const sbfi_field *field, uint32_t index);

/* The element path as XPath: /sbf/soft_body[2]/polygon_mesh/positions, with /@name for XML attributes.
 * `field` is a field of the current element, or NULL for the element itself. Truncated to fit. */
void sbfi_element_path_print(
    const sbfi_element_path *location, const sbfi_field *field, char *path, size_t size);

/* Length that a rule requires here. */
uint64_t sbfi_length_value(const sbfi_length *length, const sbfi_element_path *path);
/* False if it sums the items of a list that an outline omits. */
bool sbfi_length_is_known(const sbfi_length *length, const sbfi_element_path *path);
/* List of a counting or summing term. */
sbfi_list sbfi_term_list(const sbfi_term *term, const sbfi_element_path *path);

/* Whether the XML form writes the field as an attribute. */
bool sbfi_field_is_attribute(const sbfi_field *field);

#endif
