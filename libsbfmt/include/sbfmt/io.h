/* Loading and saving assets as XML text (.sbf), and in either form by what a file is. In the format library;
 * settings, promises of a load and how saving survives a failure are those of sbfmt/packed.h, which this adds
 * to. */
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

/* Either form: loads by what the bytes are, saves by the name's ending (.sbfz packed, anything else XML). */
SBF_API sbf_status sbf_load_file(
    const char *path, const sbf_load_options *options, sbf_asset **asset, sbf_diagnostic *error);
SBF_API sbf_status sbf_save_file(
    const sbf_asset *asset, const char *path, const sbf_save_options *options, sbf_diagnostic *error);

/* sbf_load_file for reports: where the structure of an XML file is at fault, it goes on to find more. Fills
 * up to `capacity` (at least 1) findings and `*count`, which is 0 exactly where the load succeeds. */
SBF_API sbf_status sbf_load_file_findings(const char *path, const sbf_load_options *options,
    sbf_asset **asset, sbf_diagnostic *findings, uint32_t capacity, uint32_t *count);

/* Looks up the lines of findings that have an element path and no line, as sbf_validate's, in one pass over
 * the XML file that they are about. Leaves them as they are where the file is packed or cannot be read again.
 */
SBF_API void sbf_locate_findings(
    const char *path, const sbf_load_options *options, sbf_diagnostic *findings, uint32_t count);

#ifdef __cplusplus
}
#endif
#endif
