@tool
extends EditorPlugin
# What the editor needs beyond the extension itself: .sbf files are imported, and characters have a gizmo.

const Import := preload("sbf_import.gd")
const Gizmo := preload("character_gizmo.gd")

var import := Import.new()
var gizmo := Gizmo.new()


func _enter_tree() -> void:
	Import.add_setting()
	add_import_plugin(import)
	add_node_3d_gizmo_plugin(gizmo)


func _exit_tree() -> void:
	remove_node_3d_gizmo_plugin(gizmo)
	remove_import_plugin(import)
