/* Canonical XML form: equal assets give equal bytes, on every machine and in every locale.
 *
 * Attributes and elements are in the schema's order, with two spaces of indentation per level. Omitted are
 * values equal to their default unless required, empty lists, and `one` children without content. A list is
 * one element: on one line if it has at most twelve scalars, else twelve per line (bytes: 57 per line in
 * base64), without indentation. A reference is the id of its target. */
#ifndef SBFI_XML_WRITER_H
#define SBFI_XML_WRITER_H

#include "base/text.h"
#include "model/element_path.h"

/* Receives finished bytes. On failure it fills `*error` and writing ends. */
typedef struct sbfi_xml_sink {
  sbf_status (*write)(void *user, const void *bytes, size_t size, sbf_diagnostic *error);
  void *user;
} sbfi_xml_sink;

typedef struct sbfi_xml_selection {
  bool source_only; /* omits derived parts, derivation records, and machine-dependent values */
  bool (*keep)(void *user, const sbfi_element_path *child); /* additional filter of children; NULL: all */
  void *user;
} sbfi_xml_selection;

/* Writes an asset that has passed sbf_asset_check into `text`, which is flushed to the sink. With a sink
 * of NULL everything stays in `text`. `selection` may be NULL: everything. */
sbf_status sbfi_xml_write(const sbf_asset *asset, const sbfi_xml_selection *selection, sbfi_text *text,
    const sbfi_xml_sink *sink, sbf_diagnostic *error);

#endif
