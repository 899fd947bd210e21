@tool
extends EditorNode3DGizmoPlugin
# A character in the editor: its bones as lines over everything, and the box that it fills at rest, to click on.


func _init() -> void:
	create_material("bones", Color(1.0, 0.75, 0.2), false, true)
	create_material("box", Color(0.4, 0.8, 1.0, 0.6))


func _get_gizmo_name() -> String:
	return "SoftCharacter3D"


func _has_gizmo(node: Node3D) -> bool:
	return node is SoftCharacter3D


func _redraw(gizmo: EditorNode3DGizmo) -> void:
	gizmo.clear()
	var character: SoftCharacter3D = gizmo.get_node_3d()
	var inside := character.global_transform.affine_inverse()
	var lines := PackedVector3Array()
	for point in character.get_bone_lines():
		lines.append(inside * point)
	if lines.size():
		gizmo.add_lines(lines, get_material("bones", gizmo))
	var box := character.get_rest_bounds()
	var edges := PackedVector3Array()
	for a in 8:
		for axis in [1, 2, 4]:
			if not a & axis:
				edges.append(box.get_endpoint(a))
				edges.append(box.get_endpoint(a | axis))
	gizmo.add_lines(edges, get_material("box", gizmo))
	gizmo.add_collision_segments(edges)
