/* From XML to an asset: one pass of events over the schema's tables. */
#ifndef SBFI_XML_READER_H
#define SBFI_XML_READER_H

#include "sbfmt/io.h"
#include "xml/xml_events.h"

/* What is wrong with a file, as far as there is room. */
typedef struct sbfi_xml_findings {
  sbf_diagnostic *at;
  uint32_t capacity, count; /* capacity at least 1 */
} sbfi_xml_findings;

/* Reads the file into `asset`, which is fresh: values, lists and children, but each reference that is given
 * is still a place in `*refs`, an array of texts (const char *) that live in the asset. The structure is not
 * checked beyond what reading needs. `options` are filled. On failure the first fault is in `error`. */
sbf_status sbfi_xml_read_tree(const sbfi_xml_source *source, const sbf_load_options *options,
    sbf_asset *asset, sbfi_array *refs, sbf_diagnostic *error);

/* Replaces those places by what the references name. What is unknown becomes a finding. False where memory
 * ran out. */
bool sbfi_xml_resolve_refs(sbf_asset *asset, const sbfi_array *refs, sbfi_xml_findings *findings);

/* Finds the lines of findings that have a path but no line, by another pass over the file. */
void sbfi_xml_locate(
    const sbfi_xml_source *source, const sbf_allocator *allocator, sbfi_xml_findings *findings);

/* All of these and the structural check. Where anything was found, `*asset` is NULL and the status that of
 * the first finding. */
sbf_status sbfi_xml_read(const sbfi_xml_source *source, const sbf_load_options *options,
    sbfi_xml_findings *findings, sbf_asset **asset);
/* The same from a file; `options` as the caller gave them. */
sbf_status sbfi_xml_read_file(
    const char *path, const sbf_load_options *options, sbfi_xml_findings *findings, sbf_asset **asset);

#endif
