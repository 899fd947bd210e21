@tool
extends "sbf_import.gd"
# A .glb is a scene, by Godot's own importer, until Import As of its Import dock says "Soft character": then its soft bodies
# (the extension SBF_soft_body) make it a SoftAsset.


func _get_importer_name() -> String:
	return "sbfmt.glb"


func _get_recognized_extensions() -> PackedStringArray:
	return ["glb"]


# Below that of Godot's scenes.
func _get_priority() -> float:
	return 0.5


func _get_import_options(_path: String, _preset: int) -> Array[Dictionary]:
	return []
