extends "checks.gd"
# A resource that takes new content keeps its characters where and as they are; one of another structure lets them
# begin again where they stood.

var character: SoftCharacter3D
var before := ""
var place := Vector3.ZERO


func _initialize() -> void:
	character = add_character()
	character.ground = SoftCharacter3D.GROUND_FLAT
	character.drive(0.25, 0, 0.3)


func _physics_process(_delta: float) -> bool:
	frame += 1
	if frame == 200:
		before = character.get_state_hash()
		place = character.position
		var asset: SoftAsset = character.asset
		asset.data = FileAccess.get_file_as_bytes("res://stiffer.sbfz")
		check(character.get_state_hash() == before, "the state is not kept over stiffer flesh")
		check(character.position == place, "it stands elsewhere")
		# As the editor does when a file has changed.
		var again := ResourceLoader.load("res://lizard.sbfz", "", ResourceLoader.CACHE_MODE_REPLACE)
		check(again == asset, "another resource was made")
		check(character.get_state_hash() == before, "the state is not kept over a reload")
		check(character.asset.data == FileAccess.get_file_as_bytes("res://lizard.sbfz"), "the file's content was not taken")
		character.substeps = 40
		check(character.get_state_hash() == before, "the state is not kept over a setting")
		character.substeps = 0
	if frame == 400:
		check(character.position.distance_to(place) > 0.3, "it stopped walking at the reload")
		check(character.turn_speed > 0.29, "its wish is lost")
		place = character.position
		character.gravity_scale = 0.5
		character.position += Vector3(3, 0, 0)
	if frame == 402:
		near(character.position.x, place.x + 3, 0.05, "it was put aside")
		character.teleport(Vector3(-1, 0, 2), 1.5)
		near(character.position.x, -1, 0.05, "it was teleported")
		near(character.rotation.y, 1.5, 0.1, "its heading")
		character.paused = true
		before = character.get_state_hash()
	if frame == 460:
		check(character.get_state_hash() == before, "it moves while it is paused")
		character.asset = null
		check(character.get_skin(0).is_empty() and character.get_travelled() == 0, "something is left without an asset")
		character.asset = load("res://lizard.sbfz")
		check(character.get_skin(0).size() > 0, "it does not come back")
		finish()
		return true
	return false
