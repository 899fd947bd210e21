/* The schema of the asset as data: the generated tables describe it, and all generic passes walk it.
 *
 * The XML reader, the writer, the packed codec, the structural check, equality, hashing and copying are
 * walks over these tables, without knowledge of individual elements. */
#ifndef SBFI_SCHEMA_H
#define SBFI_SCHEMA_H

#include <string.h>

#include "sbfmt/base.h"

typedef enum sbfi_type {
  SBFI_BOOL,
  SBFI_INT,
  SBFI_UINT,
  SBFI_FLOAT,
  SBFI_VEC2,
  SBFI_VEC3,
  SBFI_VEC4,
  SBFI_QUAT,
  SBFI_STRING,   /* const char *, never NULL; an XML attribute */
  SBFI_TEXT,     /* the same, as an XML element's content */
  SBFI_ID,       /* a non-empty string that is unique in the file */
  SBFI_ENUM,     /* int32_t */
  SBFI_REF,      /* int32_t: index into a collection of the root, or SBF_NONE */
  SBFI_LIST,     /* pointer and count; `item` is the item type */
  SBFI_ONE,      /* a child by value */
  SBFI_OPTIONAL, /* a pointer to a child, or NULL */
  SBFI_MANY      /* pointer and count of children */
} sbfi_type;

typedef enum sbfi_item { SBFI_ITEM_U8, SBFI_ITEM_U32, SBFI_ITEM_F32 } sbfi_item;

/* Common layout of all lists. */
typedef struct sbfi_list {
  const void *at;
  uint32_t count;
} sbfi_list;

/* A length: the sum of its terms. */
typedef enum sbfi_term_kind {
  SBFI_TERM_NUMBER,
  SBFI_TERM_COUNT,
  SBFI_TERM_SUM,
  SBFI_TERM_SIZE
} sbfi_term_kind;
typedef struct sbfi_term {
  sbfi_term_kind kind;
  int up;         /* number of levels above this element; -1: the root */
  uint32_t value; /* the number, or the offset of the counted or summed list */
} sbfi_term;
typedef struct sbfi_length {
  uint32_t term_count;
  sbfi_term terms[2];
  const char *text; /* for messages */
} sbfi_length;

typedef struct sbfi_element sbfi_element;

/* Four letters as a number that is readable in a little-endian file. */
#define SBFI_KIND(a, b, c, d) ((uint32_t)(a) | (uint32_t)(b) << 8 | (uint32_t)(c) << 16 | (uint32_t)(d) << 24)

/* Names of child elements in XML. */
typedef struct sbfi_field_tag {
  const char *xml;     /* of the child elements; NULL: not a child */
  const char *wrapper; /* element around the children; NULL: none */
  const char *suffix;  /* the children's element name is the value of their field `by` with this suffix */
  const char *by;      /* with suffix: the children's enum field */
} sbfi_field_tag;

/* Range of each scalar. */
typedef struct sbfi_range {
  double min, max; /* infinite if unbounded */
  bool is_stated, min_open, max_open;
} sbfi_range;

/* Default of a field, by its type. */
typedef struct sbfi_default {
  float scalars[4];
  uint32_t integer;
  const char *text;
} sbfi_default;

typedef struct sbfi_field {
  const char *name;     /* in C, and of the attribute or the list's element in XML */
  const char *unit;     /* "" if there is none */
  uint16_t number;      /* in the packed form */
  uint16_t since_minor; /* first version 1.x with it */
  sbfi_type type;
  sbfi_item item;  /* of a list */
  uint32_t width;  /* scalars in an item of a list, or in a vector; otherwise 1 */
  uint32_t offset; /* in the struct */
  bool required, volatile_;
  bool earlier;  /* a reference to an item before this one */
  bool positive; /* the four points of each item span a positive volume */
  sbfi_range range;
  sbfi_default initial;
  struct {
    const char *const *at;
    uint32_t count;
  } words;                     /* of an enum */
  const sbfi_element *element; /* of children */
  sbfi_field_tag tag;          /* of children */
  struct {
    const char *name; /* field of the child that always has `value`; NULL: none */
    int32_t value;
  } fixed;
  struct {
    uint32_t offset; /* of the collection in the root that a reference refers to */
    const char *name;
  } reference;
  uint32_t length_count; /* a list has one of these lengths; 0: any */
  const sbfi_length *lengths;
  const sbfi_length *index; /* upper bound of the items; NULL: not indices */
} sbfi_field;

struct sbfi_element {
  const char *name;
  const char *xml;
  uint32_t struct_size;
  uint32_t kind; /* of a part, which has its own record in the packed form; 0: not a part */
  uint32_t field_count;
  const sbfi_field *fields;
  const sbfi_length *size; /* number of items that indices may refer to; NULL: not needed */
};

extern const sbfi_element sbfi_asset_element;

/* Bytes of one item of a list. */
static inline uint32_t sbfi_item_size(const sbfi_field *field) {
  return (field->item == SBFI_ITEM_U8 ? 1u : 4u) * field->width;
}

/* Field with that name, or NULL. */
const sbfi_field *sbfi_element_field(const sbfi_element *element, const char *name);

/* Sets every field to its default; `memory` has struct_size bytes. */
void sbfi_element_init(const sbfi_element *element, void *memory);

/* Sets the value that the parent fixes in a child (as a mesh's target); returns true if it was set
 * already. */
bool sbfi_child_fix(const sbfi_field *field, void *child);

/* Element name of a child in XML: one with a suffix is composed in `buffer`. */
const char *sbfi_child_xml_name(const sbfi_field *field, const void *child, char *buffer, size_t size);

static inline sbfi_list sbfi_get_list(const void *object, const sbfi_field *field) {
  const char *destination = (const char *)object + field->offset;
  sbfi_list list;
  memcpy(&list.at, destination, sizeof list.at);
  memcpy(&list.count, destination + sizeof list.at, sizeof list.count);
  return list;
}

static inline void sbfi_set_list(void *object, const sbfi_field *field, const void *at, uint32_t count) {
  char *destination = (char *)object + field->offset;
  memcpy(destination, &at, sizeof at);
  memcpy(destination + sizeof at, &count, sizeof count);
}

static inline const void *sbfi_get_pointer(const void *object, const sbfi_field *field) {
  const void *pointer;
  memcpy(&pointer, (const char *)object + field->offset, sizeof pointer);
  return pointer;
}

static inline void sbfi_set_pointer(void *object, const sbfi_field *field, const void *pointer) {
  memcpy((char *)object + field->offset, &pointer, sizeof pointer);
}

static inline int32_t sbfi_get_integer(const void *object, const sbfi_field *field) {
  int32_t value;
  memcpy(&value, (const char *)object + field->offset, sizeof value);
  return value;
}

static inline void sbfi_set_integer(void *object, const sbfi_field *field, int32_t value) {
  memcpy((char *)object + field->offset, &value, sizeof value);
}

#endif
