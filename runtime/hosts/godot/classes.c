#include "classes.h"

#include <stdlib.h>
#include <string.h>

enum { MAX_ARGUMENTS = 6, USAGE_DEFAULT = 6, USAGE_IS_ENUM = 65536, USAGE_NIL_IS_VARIANT = 131072 };

/* ---- Instances ---- */

/* Every instance stores its class, so that objects can be identified. */
typedef struct instance {
  const gd_class *form;
  void *self;
} instance;

static void *nothing_bound(void *token, void *object) {
  (void)token;
  (void)object;
  return NULL;
}
static const GDExtensionInstanceBindingCallbacks binding = {nothing_bound, NULL, NULL};

static GDExtensionObjectPtr create(void *userdata, GDExtensionBool notify) {
  const gd_class *form = userdata;
  instance *made = calloc(1, sizeof *made + form->size);
  GDExtensionObjectPtr object;
  if (!made) return NULL;
  made->form = form;
  made->self = made + 1;
  object = gd.classdb_construct_object2(gd_string_name(form->parent));
  gd.object_set_instance(object, gd_string_name(form->name), made);
  gd.object_set_instance_binding(object, gd.library, made, &binding);
  if (form->begin) form->begin(made->self, object);
  if (notify && !form->counted) { /* a counted instance would be freed with this value */
    gd_variant value = gd_object(object);
    GD_DO(&value, "notification", gd_int(0)); /* NOTIFICATION_POSTINITIALIZE */
    gd_free(&value);
  }
  return object;
}

static void destroy(void *userdata, GDExtensionClassInstancePtr made) {
  const gd_class *form = userdata;
  if (form->end) form->end(((instance *)made)->self);
  free(made);
}

static void notify_instance(GDExtensionClassInstancePtr made, int32_t what, GDExtensionBool reversed) {
  instance *one = made;
  if (one->form->notify) one->form->notify(one->self, what, reversed != 0);
}

gd_variant gd_class_new(const gd_class *form) {
  return gd_new(form->name);
}

void *gd_class_instance(const gd_class *form, GDExtensionObjectPtr object) {
  instance *found = object ? gd.object_get_instance_binding(object, gd.library, &binding) : NULL;
  return found && found->form == form ? found->self : NULL;
}

/* ---- Calls ---- */

static uint32_t optional_count(const gd_method *method) {
  uint32_t count = 0;
  while (count < method->count &&
         method->arguments[method->count - 1 - count].type == GDEXTENSION_VARIANT_TYPE_NIL)
    count++;
  return count;
}

static void call_values(void *userdata, GDExtensionClassInstancePtr made,
    const GDExtensionConstVariantPtr *arguments, GDExtensionInt count, GDExtensionVariantPtr result,
    GDExtensionCallError *error) {
  const gd_method *method = userdata;
  const gd_variant *given[MAX_ARGUMENTS] = {0};
  gd_variant answer = gd_nil();
  error->error = GDEXTENSION_CALL_OK;
  GDExtensionInt required = (GDExtensionInt)(method->count - optional_count(method));
  if (count < required || count > (GDExtensionInt)method->count) {
    error->error = count < required ? GDEXTENSION_CALL_ERROR_TOO_FEW_ARGUMENTS
                                    : GDEXTENSION_CALL_ERROR_TOO_MANY_ARGUMENTS;
    error->expected = (int32_t)method->count;
    return;
  }
  gd_variant nil = gd_nil();
  for (uint32_t i = 0; i < method->count; i++) given[i] = i < (uint32_t)count ? arguments[i] : &nil;
  method->run(((instance *)made)->self, given, &answer);
  if (result) gd.variant_new_copy(result, &answer);
  gd_free(&answer);
}

/* A result is initially a null pointer, and counted if its class is. */
static void return_object(GDExtensionTypePtr result, const gd_variant *answer) {
  if (!gd_as_object(answer)) return;
  if (gd_take_bool(GD_CALL(answer, "is_class", gd_string("RefCounted"))))
    gd.ref_set_object(result, gd_as_object(answer));
  else
    *(GDExtensionObjectPtr *)result = gd_as_object(answer);
}

/* Raw values, as typed scripts and Godot's own code pass them. */
static void call_raw(const gd_method *method, instance *made, const GDExtensionConstTypePtr *arguments,
    GDExtensionTypePtr result) {
  const gd_variant *given[MAX_ARGUMENTS] = {0};
  gd_variant values[MAX_ARGUMENTS], answer = gd_nil();
  for (uint32_t i = 0; i < method->count; i++) {
    GDExtensionVariantType type = method->arguments[i].type;
    if (type == GDEXTENSION_VARIANT_TYPE_NIL)
      gd.variant_new_copy(&values[i], arguments[i]);
    else
      gd.get_variant_from_type_constructor(type)(&values[i], (GDExtensionTypePtr)(uintptr_t)arguments[i]);
    given[i] = &values[i];
  }
  method->run(made->self, given, &answer);
  for (uint32_t i = 0; i < method->count; i++) gd_free(&values[i]);
  if (method->answers && result) {
    if (method->result.type == GDEXTENSION_VARIANT_TYPE_NIL)
      gd.variant_new_copy(result, &answer);
    else if (method->result.type == GDEXTENSION_VARIANT_TYPE_OBJECT)
      return_object(result, &answer);
    else
      gd.get_variant_to_type_constructor(method->result.type)(result, &answer);
  }
  gd_free(&answer);
}

static void call_pointers(void *userdata, GDExtensionClassInstancePtr made,
    const GDExtensionConstTypePtr *arguments, GDExtensionTypePtr result) {
  call_raw(userdata, made, arguments, result);
}

static void *find_virtual(void *userdata, GDExtensionConstStringNamePtr name, uint32_t hash) {
  const gd_class *form = userdata;
  (void)hash;
  for (const gd_method *one = form->virtuals; one && one->name; one++)
    if (gd_is_name(name, one->name)) return (void *)(uintptr_t)one;
  return NULL;
}

static void call_virtual(GDExtensionClassInstancePtr made, GDExtensionConstStringNamePtr name, void *userdata,
    const GDExtensionConstTypePtr *arguments, GDExtensionTypePtr result) {
  (void)name;
  call_raw(userdata, made, arguments, result);
}

/* ---- Registering ---- */

/* Godot takes strings in addition to names: each registration has its own, freed after it. */
typedef struct described {
  GDExtensionPropertyInfo info;
  uint64_t text;
} described;

static void describe(described *one, const char *name, GDExtensionVariantType type, const char *class_name,
    uint32_t hint, const char *hint_text, uint32_t usage) {
  if (type == GDEXTENSION_VARIANT_TYPE_INT && class_name) usage |= USAGE_IS_ENUM;
  gd.string_new_with_utf8_chars(&one->text, hint_text ? hint_text : "");
  one->info = (GDExtensionPropertyInfo){type, (GDExtensionStringNamePtr)(uintptr_t)gd_string_name(name),
      (GDExtensionStringNamePtr)(uintptr_t)gd_string_name(class_name ? class_name : ""), hint, &one->text,
      usage};
}

static void describe_argument(described *one, const gd_argument *argument) {
  uint32_t usage =
      USAGE_DEFAULT | (argument->type == GDEXTENSION_VARIANT_TYPE_NIL ? USAGE_NIL_IS_VARIANT : 0);
  describe(one, argument->name ? argument->name : "", argument->type, argument->class_name, 0, NULL, usage);
}

static void undescribe(described *one) {
  gd.variant_get_ptr_destructor(GDEXTENSION_VARIANT_TYPE_STRING)(&one->text);
}

static void register_method(const gd_class *form, const gd_method *method) {
  described arguments[MAX_ARGUMENTS], result;
  GDExtensionPropertyInfo infos[MAX_ARGUMENTS];
  GDExtensionClassMethodArgumentMetadata metadata[MAX_ARGUMENTS] = {0};
  for (uint32_t i = 0; i < method->count; i++) {
    describe_argument(&arguments[i], &method->arguments[i]);
    infos[i] = arguments[i].info;
  }
  gd_variant nil = gd_nil();
  GDExtensionVariantPtr defaults[MAX_ARGUMENTS];
  for (uint32_t i = 0; i < optional_count(method); i++) defaults[i] = &nil;
  describe_argument(&result, &method->result);
  gd.classdb_register_extension_class_method(gd.library, gd_string_name(form->name),
      &(GDExtensionClassMethodInfo){.name = (GDExtensionStringNamePtr)(uintptr_t)gd_string_name(method->name),
          .method_userdata = (void *)(uintptr_t)method,
          .call_func = call_values,
          .ptrcall_func = call_pointers,
          .method_flags = GDEXTENSION_METHOD_FLAGS_DEFAULT,
          .has_return_value = method->answers,
          .return_value_info = &result.info,
          .argument_count = method->count,
          .arguments_info = infos,
          .arguments_metadata = metadata,
          .default_argument_count = optional_count(method),
          .default_arguments = defaults});
  for (uint32_t i = 0; i < method->count; i++) undescribe(&arguments[i]);
  undescribe(&result);
}

/* The two methods of a property live as long as the extension. */
static gd_method accessors[128];
static uint32_t accessor_count;

static gd_method *accessor(const char *name, gd_function *run) {
  gd_method *one = &accessors[accessor_count++];
  *one = (gd_method){.name = name, .run = run};
  return one;
}

static void register_property(const gd_class *form, const gd_property *property) {
  described one;
  if (!property->get) {
    uint64_t title = 0, prefix = 0;
    gd.string_new_with_utf8_chars(&title, property->name);
    gd.string_new_with_utf8_chars(&prefix, property->hint_text ? property->hint_text : "");
    gd.classdb_register_extension_class_property_group(
        gd.library, gd_string_name(form->name), &title, &prefix);
    gd.variant_get_ptr_destructor(GDEXTENSION_VARIANT_TYPE_STRING)(&title);
    gd.variant_get_ptr_destructor(GDEXTENSION_VARIANT_TYPE_STRING)(&prefix);
    return;
  }
  gd_method *get = accessor(property->getter_name, property->get);
  get->answers = true;
  get->result = (gd_argument){"", property->type, property->class_name};
  register_method(form, get);
  if (property->set) {
    gd_method *set = accessor(property->setter_name, property->set);
    set->count = 1;
    set->arguments[0] = (gd_argument){"value", property->type, property->class_name};
    register_method(form, set);
  }
  describe(&one, property->name, property->type, property->class_name, property->hint, property->hint_text,
      property->usage ? property->usage : USAGE_DEFAULT);
  gd.classdb_register_extension_class_property(gd.library, gd_string_name(form->name), &one.info,
      gd_string_name(property->set ? property->setter_name : ""), gd_string_name(property->getter_name));
  undescribe(&one);
}

static void register_signal(const gd_class *form, const gd_signal *signal) {
  described arguments[MAX_ARGUMENTS];
  GDExtensionPropertyInfo infos[MAX_ARGUMENTS];
  for (uint32_t i = 0; i < signal->count; i++) {
    describe_argument(&arguments[i], &signal->arguments[i]);
    infos[i] = arguments[i].info;
  }
  gd.classdb_register_extension_class_signal(
      gd.library, gd_string_name(form->name), gd_string_name(signal->name), infos, signal->count);
  for (uint32_t i = 0; i < signal->count; i++) undescribe(&arguments[i]);
}

const gd_method *gd_class_method(const gd_class *form, uint32_t number) {
  for (const gd_method *const *table = form->methods; table && *table; table++)
    for (const gd_method *one = *table; one->name; one++)
      if (!number--) return one;
  return NULL;
}

void gd_class_register(const gd_class *form) {
  GDExtensionConstStringNamePtr name = gd_string_name(form->name);
  gd.classdb_register_extension_class5(gd.library, name, gd_string_name(form->parent),
      &(GDExtensionClassCreationInfo5){.is_exposed = true,
          .notification_func = notify_instance,
          .create_instance_func = create,
          .free_instance_func = destroy,
          .get_virtual_call_data_func = find_virtual,
          .call_virtual_with_data_func = call_virtual,
          .class_userdata = (void *)(uintptr_t)form});
  const gd_method *method;
  for (uint32_t i = 0; (method = gd_class_method(form, i)) != NULL; i++) register_method(form, method);
  for (const gd_property *one = form->properties; one && one->name; one++) register_property(form, one);
  for (const gd_signal *one = form->signals; one && one->name; one++) register_signal(form, one);
  for (const gd_constant *one = form->constants; one && one->name; one++)
    gd.classdb_register_extension_class_integer_constant(
        gd.library, name, gd_string_name(one->enumeration), gd_string_name(one->name), one->value, false);
}

void gd_class_unregister(const gd_class *form) {
  gd.classdb_unregister_extension_class(gd.library, gd_string_name(form->name));
}
