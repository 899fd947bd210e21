/* Registers classes with Godot from tables of methods, properties and signals. The same functions serve both
 * of Godot's calling conventions. */
#ifndef SBFMT_GODOT_CLASSES_H
#define SBFMT_GODOT_CLASSES_H

#include "variants.h"

/* `arguments` has the number of values in the table; `result` is nil, and may be assigned. */
typedef void gd_function(void *self, const gd_variant *const *arguments, gd_variant *result);

/* A parameter. */
typedef struct gd_argument {
  const char *name;
  GDExtensionVariantType type; /* NIL: a Variant of any type */
  const char *class_name;      /* of an object, or CLASS.ENUM for an INT; NULL: any */
} gd_argument;

/* A method. Its last arguments may be left out if they are of type NIL: they are nil then. In a table of
 * virtual methods the name is Godot's, with its underscore. */
typedef struct gd_method {
  const char *name;
  gd_function *run;
  bool answers;       /* it has a result */
  gd_argument result; /* its name is ignored */
  uint32_t count;     /* of arguments, at most 5 */
  gd_argument arguments[5];
} gd_method;

/* A property in the inspector, with getter and setter. An entry without `get` begins a group of that name. */
typedef struct gd_property {
  const char *name;
  GDExtensionVariantType type;
  uint32_t hint; /* of Godot's PropertyHint */
  const char *hint_text;
  uint32_t usage; /* of Godot's PropertyUsageFlags; 0: displayed and stored */
  const char *class_name;
  const char *getter_name, *setter_name;
  gd_function *get, *set;
} gd_property;

/* A signal. */
typedef struct gd_signal {
  const char *name;
  uint32_t count;
  gd_argument arguments[6];
} gd_signal;

/* A named constant in an enumeration. */
typedef struct gd_constant {
  const char *enumeration, *name;
  int64_t value;
} gd_constant;

/* Tables end with an entry without a name; they may be NULL. */
typedef struct gd_class {
  const char *name, *parent;
  bool counted;                                            /* reference counted, as resources are */
  size_t size;                                             /* of an instance, which is zeroed initially */
  void (*begin)(void *self, GDExtensionObjectPtr object);  /* may be NULL */
  void (*end)(void *self);                                 /* may be NULL */
  void (*notify)(void *self, int32_t what, bool reversed); /* may be NULL */
  const gd_method *const *methods;                         /* tables; NULL ends them */
  const gd_method *virtuals;
  const gd_property *properties;
  const gd_signal *signals;
  const gd_constant *constants;
} gd_class;

void gd_class_register(const gd_class *form);
void gd_class_unregister(const gd_class *form);
/* A method by its number, from 0, across the tables; NULL: there are fewer. */
const gd_method *gd_class_method(const gd_class *form, uint32_t number);
/* A new instance: the object, whose value is freed with its last reference. */
gd_variant gd_class_new(const gd_class *form);
/* Instance data of `size` bytes of an object; NULL if it is not of that class. */
void *gd_class_instance(const gd_class *form, GDExtensionObjectPtr object);

#endif
