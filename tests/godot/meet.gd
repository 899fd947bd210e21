extends "checks.gd"
# Two soft cubes of a physics space, one let go over the other: it comes to lie on it, and both are told who it is; of two that are not to
# meet each other one falls into the other. Each stands on its own floor. Dropped from 30 cm on a third one, a cube first touches it from above,
# and is thrown back.

const SIZE := 0.3
var lower: SoftCharacter3D
var upper: SoftCharacter3D
var apart: Array[SoftCharacter3D] = []
var told := {}
var least := INF
var fast: Array[SoftCharacter3D] = []
var fast_normal := Vector3.ZERO
var fast_least := INF
var fast_most := 0.0


func add_cube(at: Vector3, meets: bool) -> SoftCharacter3D:
	var one := SoftCharacter3D.new()
	one.asset = load("res://cube.sbfz")
	one.meet_others = meets
	one.position = at
	root.add_child(one)
	return one


func top_of(one: SoftCharacter3D) -> float:
	return -lowest(skin_of(one), func(at: Vector3): return 2 * at.y)


func bottom_of(one: SoftCharacter3D) -> float:
	return lowest(skin_of(one), func(_at: Vector3): return 0.0)


func _initialize() -> void:
	add_box("StaticBody3D", Vector3(20, 1, 20), Vector3(0, -0.5, 0))
	add_box("StaticBody3D", Vector3(1, 0.2, 1), Vector3(0, 2.9, 0))
	lower = add_cube(Vector3.ZERO, true)
	upper = add_cube(Vector3(0.013, 0.32, 0.007), true)
	for one in [lower, upper]:
		one.contact.connect(func(_soft_body: int, _position: Vector3, normal: Vector3, _impulse: float, with: Object):
			if with: told[one] = [with, normal])
	fast = [add_cube(Vector3(-2, 0, 0), true), add_cube(Vector3(-1.987, SIZE + 0.3, 0.007), true)]
	fast[1].contact.connect(func(_soft_body: int, _position: Vector3, normal: Vector3, _impulse: float, with: Object):
		if with == fast[0] and fast_normal == Vector3.ZERO: fast_normal = normal)
	apart.append(add_cube(Vector3(0, 3, 0), true)) # over both, on a floor of its own
	for height in [0.0, 0.6]: apart.append(add_cube(Vector3(2, height, 0), false))


func _physics_process(_delta: float) -> bool:
	frame += 1
	if frame > 5 and frame <= 150:
		least = minf(least, bottom_of(upper) - 0.5 * top_of(lower))
	if frame <= 40:
		var between := middle_of(fast[1]) - middle_of(fast[0])
		fast_least = minf(fast_least, between.y)
		if fast_normal != Vector3.ZERO: fast_most = maxf(fast_most, between.y)
	if frame == 40:
		print("dropped from 30 cm: first touched along %s, as near as %f, then %f over it" % [fast_normal, fast_least, fast_most])
		check(fast_normal.y > 0.99, "what falls fast is first touched along %s" % fast_normal)
		check(fast_least > 0.7 * SIZE, "it came as near as %f" % fast_least)
		check(fast_most > 1.2 * SIZE, "it was not thrown back: %f" % fast_most)
	if frame == 150:
		print("after %s: the lower from %f to %f, the upper from %f, the others from %f, %f, %f" %
				[ProjectSettings.get_setting("physics/3d/physics_engine"), bottom_of(lower), top_of(lower), bottom_of(upper),
				bottom_of(apart[0]), bottom_of(apart[1]), bottom_of(apart[2])])
		near(bottom_of(lower), 0, 0.005, "the lower cube's foot")
		check(top_of(lower) < SIZE and top_of(lower) > 0.8 * SIZE, "it bears the other: %f" % top_of(lower))
		var over := middle_of(upper) - middle_of(lower)
		check(over.y > 0.85 * SIZE and over.y < SIZE and Vector2(over.x, over.z).length() < 0.08, "the upper one lies %s over it" % over)
		check(least > 0, "the upper one went into the lower one by more than half of it")
		check(told.get(lower, [null])[0] == upper and told.get(upper, [null])[0] == lower, "they are not told of each other: %s" % told)
		check(told.size() == 2 and told[upper][1].y > 0.7 and told[lower][1].y < -0.7, "from where: %s" % told)
		near(bottom_of(apart[0]), 3, 0.005, "on its own floor")
		near(bottom_of(apart[2]), 0, 0.005, "through the one that it is not to meet")
		upper.queue_free()
	if frame == 240:
		near(top_of(lower), SIZE, 0.01, "freed of its load")
		finish()
		return true
	return false
