extends "checks.gd"
# A .sbf that the editor imported is a SoftAsset in the game, and walks with the program's bits.

var character: SoftCharacter3D


func _initialize() -> void:
	var asset = load("res://lizard.sbf")
	check(asset is SoftAsset, "res://lizard.sbf is %s" % asset)
	if not asset is SoftAsset:
		return finish()
	character = add_character("res://lizard.sbf")
	character.ground = SoftCharacter3D.GROUND_FLAT
	character.forward_speed = 0.25


func _physics_process(_delta: float) -> bool:
	frame += 1
	if character and frame <= 600:
		return false
	var told := OS.get_cmdline_user_args()
	if character and told.size():
		check(character.get_state_hash() == told[0], "state %s, not the program's %s" % [character.get_state_hash(), told[0]])
	finish()
	return true
