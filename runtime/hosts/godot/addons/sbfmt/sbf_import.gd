@tool
extends EditorImportPlugin
# A .sbf is XML: the program sbfmt packs it, in a process of its own, and the game loads the packed form. So neither
# the editor nor the game has an XML reader of ours in it.

const SETTING := "sbfmt/import/program"
const BESIDE := "res://addons/sbfmt/bin/sbfmt"


static func add_setting() -> void:
	if not ProjectSettings.has_setting(SETTING):
		ProjectSettings.set_setting(SETTING, "")
	ProjectSettings.set_initial_value(SETTING, "")
	ProjectSettings.add_property_info({"name": SETTING, "type": TYPE_STRING, "hint": PROPERTY_HINT_GLOBAL_FILE})


# The setting's, else the one that came with the add-on, else the system's.
static func program() -> String:
	var set_one: String = ProjectSettings.get_setting(SETTING, "")
	if set_one:
		return set_one
	return ProjectSettings.globalize_path(BESIDE) if FileAccess.file_exists(BESIDE) else "sbfmt"


func _get_importer_name() -> String:
	return "sbfmt.bundle"


func _get_visible_name() -> String:
	return "Soft character"


func _get_recognized_extensions() -> PackedStringArray:
	return ["sbf"]


func _get_save_extension() -> String:
	return "sbfz"


func _get_resource_type() -> String:
	return "SoftAsset"


func _get_priority() -> float:
	return 1.0


func _get_import_order() -> int:
	return IMPORT_ORDER_DEFAULT


func _get_preset_count() -> int:
	return 1


func _get_preset_name(_preset: int) -> String:
	return "Default"


func _get_import_options(_path: String, _preset: int) -> Array[Dictionary]:
	return [{"name": "build", "default_value": false}]


func _get_option_visibility(_path: String, _option: StringName, _options: Dictionary) -> bool:
	return true


func run(words: PackedStringArray, source: String) -> Error:
	var said := []
	var status := OS.execute(program(), words, said, true)
	var text := "\n".join(said).strip_edges()
	if status == 0:
		return OK
	if status < 0 or status == 127:
		text = "%s cannot be started: install sbfmt, or say where it is in the project setting %s" % [program(), SETTING]
	push_error("%s: %s" % [source, text])
	return FAILED


func _import(source: String, save_path: String, options: Dictionary, _variants: Array[String], _made: Array[String]) -> Error:
	var from := ProjectSettings.globalize_path(source)
	var to := ProjectSettings.globalize_path(save_path)
	if options.get("build", false):
		var built := to + ".built.sbf"
		var status := run(["build", from, "-o", built], source)
		if status == OK:
			status = run(["pack", built, "--store", "-o", to + ".sbfz"], source)
		DirAccess.remove_absolute(built)
		return status
	return run(["pack", from, "--store", "-o", to + ".sbfz"], source)
