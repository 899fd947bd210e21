// clang-format off
/* Made from spec/sbf.codes by spec/generate/generate.py: change that, not this file. */
#include "sbfmt/codes.h"

static const sbf_code_info table[] = {
  {"IO_CANNOT_READ", SBF_CODE_IO_CANNOT_READ, SBF_SEVERITY_ERROR, SBF_FAILED, "The file cannot be read: check the path and its permissions."},
  {"IO_CANNOT_WRITE", SBF_CODE_IO_CANNOT_WRITE, SBF_SEVERITY_ERROR, SBF_FAILED, "The file cannot be written: check the folder, its permissions and the free space."},
  {"IO_UNKNOWN_FORMAT", SBF_CODE_IO_UNKNOWN_FORMAT, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "The content is none of the formats known: give a file of a listed format."},
  {"IO_TOO_LARGE", SBF_CODE_IO_TOO_LARGE, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "The input is larger than the limit: raise the limit if the file is trusted."},
  {"OUT_OF_MEMORY", SBF_CODE_OUT_OF_MEMORY, SBF_SEVERITY_ERROR, SBF_FAILED, "Memory ran out, or the limit on it was reached."},
  {"BAD_CALL", SBF_CODE_BAD_CALL, SBF_SEVERITY_ERROR, SBF_FAILED, "An argument of the call is wrong."},
  {"IO_CANNOT_RUN", SBF_CODE_IO_CANNOT_RUN, SBF_SEVERITY_ERROR, SBF_FAILED, "A helper program cannot be run: check that it is installed and may be executed."},
  {"CANCELLED", SBF_CODE_CANCELLED, SBF_SEVERITY_ERROR, SBF_FAILED, "The caller stopped the work."},
  {"XML_SYNTAX", SBF_CODE_XML_SYNTAX, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "The text is not well-formed XML: mend it at the line given."},
  {"XML_DOCTYPE", SBF_CODE_XML_DOCTYPE, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "A DOCTYPE or an entity of its own stands in the file: remove it, the format has none."},
  {"XML_UNKNOWN_ELEMENT", SBF_CODE_XML_UNKNOWN_ELEMENT, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "An element that the format does not have stands here: check its spelling and its place."},
  {"XML_UNKNOWN_ATTRIBUTE", SBF_CODE_XML_UNKNOWN_ATTRIBUTE, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "An attribute that the element does not have: check its spelling."},
  {"XML_BAD_VALUE", SBF_CODE_XML_BAD_VALUE, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "A value is not of its type, as a word where a number belongs."},
  {"XML_REPEATED", SBF_CODE_XML_REPEATED, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "An element that may stand once stands twice."},
  {"XML_TOO_DEEP", SBF_CODE_XML_TOO_DEEP, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "Elements lie inside each other deeper than the limit."},
  {"XML_STRAY_TEXT", SBF_CODE_XML_STRAY_TEXT, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "Text stands where only elements belong."},
  {"XML_NOT_SBF", SBF_CODE_XML_NOT_SBF, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "The document's root is not <sbf>: this is another kind of XML."},
  {"VERSION_TOO_NEW", SBF_CODE_VERSION_TOO_NEW, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "The file needs a newer version of the library: update, or save it with an older one."},
  {"REQUIRED_MISSING", SBF_CODE_REQUIRED_MISSING, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "A field that must be given is missing."},
  {"VALUE_OUT_OF_RANGE", SBF_CODE_VALUE_OUT_OF_RANGE, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "A number lies outside its range."},
  {"VALUE_NOT_FINITE", SBF_CODE_VALUE_NOT_FINITE, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "A number is infinite or not a number."},
  {"WRONG_LENGTH", SBF_CODE_WRONG_LENGTH, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "A list has not the length that goes with its neighbours."},
  {"INDEX_OUT_OF_RANGE", SBF_CODE_INDEX_OUT_OF_RANGE, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "An index names an item that is not there."},
  {"ENUM_OUT_OF_RANGE", SBF_CODE_ENUM_OUT_OF_RANGE, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "A value is none of the words of its enumeration."},
  {"LIST_TOO_LONG", SBF_CODE_LIST_TOO_LONG, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "A list is longer than the limit: raise the limit if the file is trusted."},
  {"NOT_UTF8", SBF_CODE_NOT_UTF8, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "A text is not valid UTF-8."},
  {"ID_EMPTY", SBF_CODE_ID_EMPTY, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "An id is empty."},
  {"ID_REPEATED", SBF_CODE_ID_REPEATED, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "Two objects have the same id: ids are unique in a file."},
  {"FIXED_VALUE", SBF_CODE_FIXED_VALUE, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "A field has another value than its place demands."},
  {"BAD_TEXT", SBF_CODE_BAD_TEXT, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "A text holds a control character, which XML cannot carry: remove it."},
  {"REF_UNKNOWN", SBF_CODE_REF_UNKNOWN, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "A reference names an id that nothing of its kind has."},
  {"BONE_ORDER", SBF_CODE_BONE_ORDER, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "A bone stands before its parent, or among its own ancestors."},
  {"EXTENSION_REQUIRED", SBF_CODE_EXTENSION_REQUIRED, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "The file requires an extension that this library does not know."},
  {"DERIVED_LOST", SBF_CODE_DERIVED_LOST, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "Something refers to a derived part that is not made any more: let it name an authored one."},
  {"TETRAHEDRON_INVERTED", SBF_CODE_TETRAHEDRON_INVERTED, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "A tetrahedron is inverted or flat: its volume is not positive."},
  {"HULL_FLAT", SBF_CODE_HULL_FLAT, SBF_SEVERITY_WARNING, SBF_BAD_INPUT, "A section has too little depth for a convex hull: it gets none."},
  {"EMBEDDING_FLAT", SBF_CODE_EMBEDDING_FLAT, SBF_SEVERITY_WARNING, SBF_BAD_INPUT, "Vertices lie off a body without depth beside them, and are carried at its surface instead."},
  {"EMBEDDING_NO_BODY", SBF_CODE_EMBEDDING_NO_BODY, SBF_SEVERITY_WARNING, SBF_BAD_INPUT, "No soft body carries a mesh: it moves with its bones alone."},
  {"ATTACHMENT_NO_HULL", SBF_CODE_ATTACHMENT_NO_HULL, SBF_SEVERITY_WARNING, SBF_BAD_INPUT, "An attachment names a rigid body without a hull: nothing lies inside it."},
  {"BODY_WITHOUT_POINTS", SBF_CODE_BODY_WITHOUT_POINTS, SBF_SEVERITY_WARNING, SBF_BAD_INPUT, "A soft body has no points: nothing can be built for it."},
  {"PACKED_MAGIC", SBF_CODE_PACKED_MAGIC, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "The file does not begin as a packed file does: it was damaged in transfer, or is another kind."},
  {"PACKED_TRUNCATED", SBF_CODE_PACKED_TRUNCATED, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "The file ends before what its table names: it was cut short."},
  {"PACKED_TABLE", SBF_CODE_PACKED_TABLE, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "The header or the table of contents contradicts itself."},
  {"PACKED_CRC", SBF_CODE_PACKED_CRC, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "A chunk's bytes do not match their CRC-32: the file is damaged."},
  {"PACKED_INFLATE", SBF_CODE_PACKED_INFLATE, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "A chunk does not inflate to the size its entry names."},
  {"PACKED_RATIO", SBF_CODE_PACKED_RATIO, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "A chunk inflates to more than the limit allows."},
  {"PACKED_RECORD", SBF_CODE_PACKED_RECORD, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "A record does not hold together."},
  {"PACKED_CODEC", SBF_CODE_PACKED_CODEC, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "A chunk uses a codec or a filter that this library does not know."},
  {"PACKED_UNKNOWN_PART", SBF_CODE_PACKED_UNKNOWN_PART, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "A critical part of an unknown kind: the file needs a newer reader."},
  {"IMPORT_SYNTAX", SBF_CODE_IMPORT_SYNTAX, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "A line of a text file of another program is not what its form demands: mend or export it again."},
  {"IMPORT_INDEX", SBF_CODE_IMPORT_INDEX, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "A polygon refers to a vertex, normal or texture coordinate that the file does not have."},
  {"IMPORT_NOT_FINITE", SBF_CODE_IMPORT_NOT_FINITE, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "A number of the imported file is infinite or not a number: export it again."},
  {"IMPORT_POLYGON", SBF_CODE_IMPORT_POLYGON, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "A polygon has fewer than three corners."},
  {"IMPORT_EMPTY", SBF_CODE_IMPORT_EMPTY, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "The imported file holds neither a surface nor bones."},
  {"IMPORT_REFUSED", SBF_CODE_IMPORT_REFUSED, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "The importer of this form refuses the file: export it as a current FBX, glTF 2.0 or OBJ."},
  {"IMPORT_CRASHED", SBF_CODE_IMPORT_CRASHED, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "The importer broke down on the file, which is damaged or unusual: export it again or in another form."},
  {"IMPORT_LIMIT", SBF_CODE_IMPORT_LIMIT, SBF_SEVERITY_ERROR, SBF_BAD_INPUT, "The importer needed more time, memory or output than it may have: raise the limit if the file is trusted."},
  {"IMPORT_HELPER_MISSING", SBF_CODE_IMPORT_HELPER_MISSING, SBF_SEVERITY_ERROR, SBF_FAILED, "The program sbfmt-import cannot be found or run: install it beside sbfmt or set SBFMT_IMPORT_HELPER."},
  {"IMPORT_STREAM", SBF_CODE_IMPORT_STREAM, SBF_SEVERITY_ERROR, SBF_FAILED, "What sbfmt-import sent cannot be read: it is of another version, or was cut off."},
  {"IMPORT_MATERIALS_MISSING", SBF_CODE_IMPORT_MATERIALS_MISSING, SBF_SEVERITY_WARNING, SBF_BAD_INPUT, "A material library or a material of the file is missing: grey is used."},
  {"IMPORT_IGNORED", SBF_CODE_IMPORT_IGNORED, SBF_SEVERITY_WARNING, SBF_BAD_INPUT, "The file holds things that are passed over."},
  {"IMPORT_POINTS_LEFT_OUT", SBF_CODE_IMPORT_POINTS_LEFT_OUT, SBF_SEVERITY_WARNING, SBF_BAD_INPUT, "Vertices that no polygon uses belong to no object and are left out."},
  {"IMPORT_MESH_INVENTED", SBF_CODE_IMPORT_MESH_INVENTED, SBF_SEVERITY_WARNING, SBF_BAD_INPUT, "The importer made up a mesh for a file that has none: it is left out."},
  {"IMPORT_NAME_AMBIGUOUS", SBF_CODE_IMPORT_NAME_AMBIGUOUS, SBF_SEVERITY_WARNING, SBF_BAD_INPUT, "Several nodes have the name by which a skin or a clip refers to one of them."},
  {"IMPORT_AXES", SBF_CODE_IMPORT_AXES, SBF_SEVERITY_WARNING, SBF_BAD_INPUT, "The file states axes that make no frame: +Y up is assumed."},
  {"IMPORT_KEYS", SBF_CODE_IMPORT_KEYS, SBF_SEVERITY_WARNING, SBF_BAD_INPUT, "Keys of an animation are left out: they do not hold together."},
  {"IMPORT_IMAGE", SBF_CODE_IMPORT_IMAGE, SBF_SEVERITY_WARNING, SBF_BAD_INPUT, "An image cannot be taken over."},
};

const sbf_code_info *sbf_code_table(uint32_t *count) {
  *count = (uint32_t)(sizeof table / sizeof *table);
  return table;
}

const sbf_code_info *sbf_code_find(int32_t code) {
  for (size_t i = 0; i < sizeof table / sizeof *table; i++)
    if ((int32_t)table[i].code == code) return &table[i];
  return NULL;
}
