/* Loads and saves assets as XML text (.sbf), and in either form. Part of the format library. Settings, the
 * promises of a load, and safe saving are documented in sbfmt/packed.h. */
#ifndef SBFMT_IO_H
#define SBFMT_IO_H

#include "sbfmt/packed.h"

#ifdef __cplusplus
extern "C" {
#endif

/* XML form. */
SBF_API sbf_status sbf_xml_load_file(
    const char *path, const sbf_load_options *options, sbf_asset **asset, sbf_diagnostic *error);
SBF_API sbf_status sbf_xml_load_memory(const void *bytes, size_t size, const sbf_load_options *options,
    sbf_asset **asset, sbf_diagnostic *error);
SBF_API sbf_status sbf_xml_save_file(
    const sbf_asset *asset, const char *path, const sbf_save_options *options, sbf_diagnostic *error);
SBF_API sbf_status sbf_xml_save_memory(const sbf_asset *asset, const sbf_save_options *options,
    const sbf_allocator *allocator, sbf_buffer *buffer, sbf_diagnostic *error);

/* Either form: a load detects the form from the bytes; a save uses the name's extension (.sbfz packed,
 * anything else XML). */
SBF_API sbf_status sbf_load_file(
    const char *path, const sbf_load_options *options, sbf_asset **asset, sbf_diagnostic *error);
SBF_API sbf_status sbf_save_file(
    const sbf_asset *asset, const char *path, const sbf_save_options *options, sbf_diagnostic *error);

/* sbf_load_file for reports: if the structure of an XML file is at fault, it continues to find more faults.
 * Fills up to `capacity` (at least 1) findings and `*count`, which is 0 exactly if the load succeeds. */
SBF_API sbf_status sbf_load_file_findings(const char *path, const sbf_load_options *options,
    sbf_asset **asset, sbf_diagnostic *findings, uint32_t capacity, uint32_t *count);

/* Adds line numbers to findings that have an element path but no line, such as those of sbf_validate, in one
 * pass over their XML file. Does nothing if the file is packed or cannot be read again. */
SBF_API void sbf_locate_findings(
    const char *path, const sbf_load_options *options, sbf_diagnostic *findings, uint32_t count);

#ifdef __cplusplus
}
#endif
#endif
