/* Reads XML to an asset in one pass of events over the schema's tables. */
#ifndef SBFI_XML_READER_H
#define SBFI_XML_READER_H

#include "sbfmt/io.h"
#include "xml/xml_events.h"

/* Findings in a file, up to a capacity. */
typedef struct sbfi_xml_findings {
  sbf_diagnostic *at;
  uint32_t capacity, count; /* capacity at least 1 */
} sbfi_xml_findings;

/* Reads the file into a fresh `asset`: values, lists and children. Each reference is still an index into
 * `*refs`, an array of texts (const char *) owned by the asset. Checks the structure only as far as
 * reading requires. `options` have all defaults filled in. On failure the first fault is in `error`. */
sbf_status sbfi_xml_read_tree(const sbfi_xml_source *source, const sbf_load_options *options,
    sbf_asset *asset, sbfi_array *refs, sbf_diagnostic *error);

/* Replaces these indices by those of the referenced items. Unknown ids become findings. False if memory
 * runs out. */
bool sbfi_xml_resolve_refs(sbf_asset *asset, const sbfi_array *refs, sbfi_xml_findings *findings);

/* Finds the lines of findings with a path but no line in another pass over the file. */
void sbfi_xml_locate(
    const sbfi_xml_source *source, const sbf_allocator *allocator, sbfi_xml_findings *findings);

/* Runs all of these and the structural check. On findings `*asset` is NULL and the status is the first
 * finding's. */
sbf_status sbfi_xml_read(const sbfi_xml_source *source, const sbf_load_options *options,
    sbfi_xml_findings *findings, sbf_asset **asset);
/* The same from a file; `options` are the caller's. */
sbf_status sbfi_xml_read_file(
    const char *path, const sbf_load_options *options, sbfi_xml_findings *findings, sbf_asset **asset);

#endif
