extends "checks.gd"
# It stands on what the physics space holds: a slope, then a step up, far from the origin's height.

const SLOPE := 0.12
var character: SoftCharacter3D
var least := INF


func height(at: Vector3) -> float:
	return (7.05 if at.z > 1.0 else 7.0) + tan(SLOPE) * at.z


func _initialize() -> void:
	var thick := 1.0
	for above in [0.0, 0.05]:
		# Each is a slab whose upper face rises towards +Z.
		var middle := Vector3(0, 7 + above, 0) + (Vector3(0, tan(SLOPE), 1) * (6.0 if above else 0.0))
		var down := Vector3(0, cos(SLOPE), -sin(SLOPE)) * (-thick / 2)
		add_box("StaticBody3D", Vector3(20, thick, 10 / cos(SLOPE) if above else 40.0), middle + down, Vector3(-SLOPE, 0, 0))
	character = add_character("res://lizard.sbfz", Vector3(0, 7, 0))
	character.forward_speed = 0.25


func _physics_process(_delta: float) -> bool:
	frame += 1
	if frame > 60 and frame % 20 == 0:
		# Beside the edge of the step, where the grid of heights rises over the width of a cell.
		var skin := skin_of(character)
		least = minf(least, lowest(skin, func(at: Vector3): return height(at) if absf(at.z - 1.0) > 0.1 else -INF))
	if frame < 600:
		return false
	print("after %s: at %s, least height above the ground %f" % [ProjectSettings.get_setting("physics/3d/physics_engine"), character.position, least])
	check(character.position.z > 2, "it came to %s" % character.position)
	near(character.position.y, height(character.position), 0.06, "its height")
	check(least > -0.01 and least < 0.01, "the lowest point of its skin is %f above the ground" % least)
	finish()
	return true
