/* What Godot gives an extension: the calls that this one uses, each asked for once by its name.
 *
 * <gdextension_interface.h> is written out by the Godot that the extension is built for. */
#ifndef SBFMT_GODOT_API_H
#define SBFMT_GODOT_API_H

#include <gdextension_interface.h>
#include <stdbool.h>
#include <stdint.h>

/* Name in Godot, type in its header, member here. */
#define GD_CALLS(X)                                                                                          \
  X(string_name_new_with_latin1_chars, StringNameNewWithLatin1Chars)                                         \
  X(string_new_with_utf8_chars, StringNewWithUtf8Chars)                                                      \
  X(string_to_utf8_chars, StringToUtf8Chars)                                                                 \
  X(variant_new_nil, VariantNewNil)                                                                          \
  X(variant_new_copy, VariantNewCopy)                                                                        \
  X(variant_destroy, VariantDestroy)                                                                         \
  X(variant_get_type, VariantGetType)                                                                        \
  X(variant_call, VariantCall)                                                                               \
  X(variant_construct, VariantConstruct)                                                                     \
  X(variant_get_keyed, VariantGetKeyed)                                                                      \
  X(variant_get_indexed, VariantGetIndexed)                                                                  \
  X(variant_set_indexed, VariantSetIndexed)                                                                  \
  X(variant_get_object_instance_id, VariantGetObjectInstanceId)                                              \
  X(get_variant_from_type_constructor, GetVariantFromTypeConstructor)                                        \
  X(get_variant_to_type_constructor, GetVariantToTypeConstructor)                                            \
  X(variant_get_ptr_internal_getter, GetVariantGetInternalPtrFunc)                                           \
  X(variant_get_ptr_destructor, VariantGetPtrDestructor)                                                     \
  X(packed_byte_array_operator_index, PackedByteArrayOperatorIndex)                                          \
  X(packed_int32_array_operator_index, PackedInt32ArrayOperatorIndex)                                        \
  X(packed_float32_array_operator_index, PackedFloat32ArrayOperatorIndex)                                    \
  X(packed_vector2_array_operator_index, PackedVector2ArrayOperatorIndex)                                    \
  X(packed_vector3_array_operator_index, PackedVector3ArrayOperatorIndex)                                    \
  X(classdb_construct_object2, ClassdbConstructObject2)                                                      \
  X(classdb_register_extension_class5, ClassdbRegisterExtensionClass5)                                       \
  X(classdb_register_extension_class_method, ClassdbRegisterExtensionClassMethod)                            \
  X(classdb_register_extension_class_property, ClassdbRegisterExtensionClassProperty)                        \
  X(classdb_register_extension_class_property_group, ClassdbRegisterExtensionClassPropertyGroup)             \
  X(classdb_register_extension_class_signal, ClassdbRegisterExtensionClassSignal)                            \
  X(classdb_register_extension_class_integer_constant, ClassdbRegisterExtensionClassIntegerConstant)         \
  X(classdb_unregister_extension_class, ClassdbUnregisterExtensionClass)                                     \
  X(object_set_instance, ObjectSetInstance)                                                                  \
  X(object_set_instance_binding, ObjectSetInstanceBinding)                                                   \
  X(object_get_instance_binding, ObjectGetInstanceBinding)                                                   \
  X(object_get_instance_from_id, ObjectGetInstanceFromId)                                                    \
  X(object_get_instance_id, ObjectGetInstanceId)                                                             \
  X(ref_set_object, RefSetObject)                                                                            \
  X(global_get_singleton, GlobalGetSingleton)                                                                \
  X(print_error_with_message, PrintErrorWithMessage)                                                         \
  X(print_warning_with_message, PrintWarningWithMessage)                                                     \
  X(worker_thread_pool_add_native_group_task, WorkerThreadPoolAddNativeGroupTask)

/* The calls, and what the extension is known by. */
typedef struct gd_api {
#define X(name, type) GDExtensionInterface##type name;
  GD_CALLS(X)
#undef X
  GDExtensionClassLibraryPtr library;
  GDExtensionInterfaceGetProcAddress get; /* asks for others */
} gd_api;

/* Set once, before anything else of the extension runs. */
extern gd_api gd;

/* False where this Godot lacks one of them: the extension is not for it. */
bool gd_api_load(GDExtensionInterfaceGetProcAddress get, GDExtensionClassLibraryPtr library);
/* What takes help for classes; NULL where this is no editor. */
GDExtensionsInterfaceEditorHelpLoadXmlFromUtf8Chars gd_editor_help(void);

#endif
