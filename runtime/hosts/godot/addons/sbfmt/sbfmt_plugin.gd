@tool
extends EditorPlugin
# What the editor needs beyond the extension itself: .sbf files and chosen .glb files are imported, and characters have a gizmo.

const Import := preload("sbf_import.gd")
const GlbImport := preload("glb_import.gd")
const Gizmo := preload("character_gizmo.gd")

var imports: Array[EditorImportPlugin] = [Import.new(), GlbImport.new()]
var gizmo := Gizmo.new()


func _enter_tree() -> void:
	Import.add_setting()
	for import in imports:
		add_import_plugin(import)
	add_node_3d_gizmo_plugin(gizmo)


func _exit_tree() -> void:
	remove_node_3d_gizmo_plugin(gizmo)
	for import in imports:
		remove_import_plugin(import)
