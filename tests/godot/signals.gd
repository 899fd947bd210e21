extends "checks.gd"
# What signals say: a lizard that is knocked over lands, once, where it gets up; a bar that hangs in its own weight tears.

var lizard: SoftCharacter3D
var bar: SoftCharacter3D
var landed: Array[Vector3] = []
var torn: Array[Vector3] = []
var postures := []
var torn_bodies: Array[int] = []


func _initialize() -> void:
	lizard = add_character()
	lizard.ground = SoftCharacter3D.GROUND_FLAT
	lizard.landed.connect(func(place: Vector3) -> void: landed.append(place))
	for name in ["fell", "rising", "rose"]: lizard.connect(name, func(): postures.append([name, frame]))
	bar = add_character("res://bar.sbfz", Vector3(3, 0, 0))
	bar.torn.connect(func(body: int, place: Vector3) -> void:
		torn_bodies.append(body)
		torn.append(place))


func _physics_process(_delta: float) -> bool:
	frame += 1
	if frame == 30:
		check(landed.is_empty(), "it landed before it fell")
		lizard.knock_over()
	if frame < 400:
		return false
	check(landed.size() == 1, "it landed %d times" % landed.size())
	check(postures.map(func(one): return one[0]) == ["fell", "rising", "rose"] and postures[0][1] in [30, 31], "it said %s" % [postures])
	if landed.size() == 1:
		check(landed[0].distance_to(lizard.position) < 0.3, "it landed at %s and stands at %s" % [landed[0], lizard.position])
	check(torn.size() > 3, "the bar tore %d times" % torn.size())
	check(torn_bodies.count(0) == torn.size(), "other bodies tore: %s" % [torn_bodies])
	if torn.size() > 0:
		near(torn[0].x, 3, 0.1, "where it tore first")
		check(torn[0].y > 0.3 and torn[0].y < 1.1, "it tore first at %s, not in its middle" % torn[0])
	finish()
	return true
