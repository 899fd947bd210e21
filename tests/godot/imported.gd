extends "checks.gd"
# A .sbf that the editor imported is a SoftAsset in the game, and walks with the program's bits.

var character: SoftCharacter3D
var jelly: SoftCharacter3D


func _initialize() -> void:
	var asset = load("res://lizard.sbf")
	check(asset is SoftAsset, "res://lizard.sbf is %s" % asset)
	if not asset is SoftAsset:
		return finish()
	var walker = load("res://walker.glb")
	var scene = load("res://scene.glb")
	check(walker is SoftAsset and walker.data == asset.data, "res://walker.glb is %s" % walker)
	check(scene is PackedScene, "res://scene.glb is %s, no scene as any other .glb" % scene)
	jelly = add_character("res://jelly.sbf", Vector3(3, 0, 0))
	character = add_character("res://lizard.sbf")
	character.ground = SoftCharacter3D.GROUND_FLAT
	character.detail = SoftCharacter3D.DETAIL_FULL
	character.forward_speed = 0.25


func _physics_process(_delta: float) -> bool:
	frame += 1
	if character and frame <= 600:
		return false
	if jelly:
		var material: StandardMaterial3D = jelly.get_mesh_instance(0).mesh.surface_get_material(0)
		check(material.albedo_texture == load("res://textures/checker.png"), "the texture beside the file is %s" % material.albedo_texture)
	var told := OS.get_cmdline_user_args()
	if character and told.size():
		check(character.get_state_hash() == told[0], "state %s, not the program's %s" % [character.get_state_hash(), told[0]])
	finish()
	return true
