extends "checks.gd"
# Files that are none, or are damaged, are refused with a reason, and what was there stays.


func _initialize() -> void:
	for name in ["cut", "empty", "text"]:
		check(load("res://%s.sbfz" % name) == null, name + ".sbfz was loaded")
	var asset: SoftAsset = load("res://lizard.sbfz")
	var whole := asset.data
	asset.data = FileAccess.get_file_as_bytes("res://cut.sbfz")
	check(asset.data == whole, "a damaged file took the place of a good one")
	var character := add_character()
	character.play("no such clip", 0)
	var bare := SoftCharacter3D.new()
	check(bare.get_leg_count() == 0 and bare.get_skin(0).is_empty(), "a node without an asset has legs")
	bare.drive(1, 0, 0)
	bare.free()
	finish()


func _physics_process(_delta: float) -> bool:
	return true
