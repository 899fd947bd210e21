/* The canonical XML form: the same asset gives the same bytes, on every machine and in every locale.
 *
 * Attributes and elements stand in the schema's order, two spaces a level. What equals its default is left
 * out, unless it is required; so are empty lists and a `one` child that says nothing. A list is one element:
 * on the element's line where twelve scalars hold it, else twelve a line (bytes: 57 a line in base64), not
 * indented. A reference is the id of what it names. */
#ifndef SBFI_XML_WRITER_H
#define SBFI_XML_WRITER_H

#include "base/text.h"
#include "model/element_path.h"

/* Takes finished bytes. On failure it fills `*error` and the writing ends. */
typedef struct sbfi_xml_sink {
  sbf_status (*write)(void *user, const void *bytes, size_t size, sbf_diagnostic *error);
  void *user;
} sbfi_xml_sink;

typedef struct sbfi_xml_selection {
  bool source_only; /* leave out what is derived, the records of derivations, and what differs by machine */
  bool (*keep)(void *user, const sbfi_element_path *child); /* a further choice among children; NULL: all */
  void *user;
} sbfi_xml_selection;

/* Writes the asset, which has passed sbf_asset_check, into `text`, and from there to the sink as it fills.
 * With a sink of NULL all stays in `text`. `selection` may be NULL: everything. */
sbf_status sbfi_xml_write(const sbf_asset *asset, const sbfi_xml_selection *selection, sbfi_text *text,
    const sbfi_xml_sink *sink, sbf_diagnostic *error);

#endif
