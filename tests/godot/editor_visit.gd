@tool
extends EditorPlugin
# Visits a scene in the editor: the character is there at rest and goes with the node, has a gizmo, moves while it
# previews, is saved where it stood and put back; its properties and signals have help, and
# one without an asset a warning.

var failed := 0
var frame := 0
var character: SoftCharacter3D
var began: Transform3D
var hash_at_rest := ""


func check(good: bool, what: String) -> void:
	if not good:
		failed += 1
		print("FAILED: ", what)


# What the scene tree's icons say, in one text.
func warnings() -> String:
	var told := ""
	for tree in EditorInterface.get_base_control().find_children("*", "Tree", true, false):
		var item: TreeItem = tree.get_root()
		while item:
			for i in item.get_button_count(0): told += item.get_button_tooltip_text(0, i) + "\n"
			item = item.get_next_in_tree()
	return told


func _ready() -> void:
	EditorInterface.open_scene_from_path("res://visited.tscn")


func _physics_process(_delta: float) -> void:
	frame += 1
	var scene := EditorInterface.get_edited_scene_root()
	if not scene or frame < 30:
		return
	if not character:
		character = scene.get_node("Lizard")
		frame = 100
	if frame == 101:
		check(character.get_skin(0).size() > 0, "no skin in the editor")
		check(character.get_gizmos().any(func(one): return one.get_plugin().get_script() and "character_gizmo" in one.get_plugin().get_script().resource_path),
				"no gizmo")
		hash_at_rest = character.get_state_hash()
		var bare := SoftCharacter3D.new()
		scene.add_child(bare)
		bare.owner = scene
		bare.scale = Vector3(1, 2, 1)
		bare.rotation.x = 0.3
	if frame == 130:
		for words in ["There is nothing to show", "scaled unevenly", "is tilted"]:
			check(warnings().count(words) == 1, "warned %d times: %s" % [warnings().count(words), words])
		check(character.get_state_hash() == hash_at_rest and character.get_travelled() == 0, "it moves without preview")
		character.position = Vector3(2, 0.5, 0)
	if frame == 140:
		var low := INF
		for point in character.get_skin(0):
			low = minf(low, point.x)
		check(low > 1.5, "it does not go with the node: %f" % low)
		began = character.transform
		character.forward_speed = 0.3
		character.preview = true
	if frame == 260:
		check(character.position.z > 0.2, "its preview came to %s" % character.position)
		var previewed := character.position
		EditorInterface.save_scene()
		check(character.position.is_equal_approx(previewed), "saving moved it to %s" % character.position)
		var saved: Node = load("res://visited.tscn").instantiate()
		check(saved.get_node("Lizard").transform.is_equal_approx(began), "saved while it previews it is at %s" % saved.get_node("Lizard").position)
		saved.free()
		character.preview = false
		EditorInterface.get_script_editor().goto_help("class_name:SoftCharacter3D")
	if frame == 270:
		check(character.transform.is_equal_approx(began), "it was not put back: %s" % character.transform)
		var pages := EditorInterface.get_script_editor().find_children("*", "RichTextLabel", true, false)
		var help := "".join(pages.map(func(one): return one.get_parsed_text()))
		for words in ["with deformable bodies", "gets the soft bodies' impulses", "begins to touch something", "A foot of the gait lands"]:
			check(words in help, "its help does not say: %s" % words)
		print("%d failed after %d frames of the editor" % [failed, frame])
		get_tree().quit(1 if failed else 0)
