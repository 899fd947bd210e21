extends "checks.gd"
# A soft cube that nothing holds, with the settings that a new node has: let go 3 m above the floor it falls on it, and from half a metre on a
# crate; on a slope it slides far from where it began, on the slope all the way, with its node, and is touched there; it goes where the
# node is put, teleported, reset and turned; and what is thrown at one fast does not fly through it.

const SLOPE := 0.6
const SPEEDS := [10.0, 20.0, 40.0]
var fallen: SoftCharacter3D
var on_crate: SoftCharacter3D
var crate: RigidBody3D
var sliding: SoftCharacter3D
var touched := false
var moved: SoftCharacter3D
var from := Vector3.ZERO
var thrown: Array[RigidBody3D] = []
var bottom := func(_at: Vector3): return 0.0
var slope := func(at: Vector3): return -tan(SLOPE) * at.x


# The middle is where the node says.
func goes_with_node(one: SoftCharacter3D, what: String) -> void:
	var off := middle_of(one) - one.position
	check(off.distance_to(Vector3(0, 0.15, 0)) < 0.03, "%s: its middle is %s from its node" % [what, off])


func _initialize() -> void:
	add_box("StaticBody3D", Vector3(60, 1, 20), Vector3(0, -0.5, 0))
	fallen = add_character("res://cube.sbfz", Vector3(0, 3, 0))
	on_crate = add_character("res://cube.sbfz", Vector3(3, 0.9, 0))
	crate = add_box("RigidBody3D", Vector3(0.6, 0.4, 0.6), Vector3(3, 0.2, 0))
	crate.mass = 40
	var down := add_box("StaticBody3D", Vector3(40, 1, 6), Vector3(0, -0.5 / cos(SLOPE), 30), Vector3(0, 0, -SLOPE))
	down.physics_material_override = PhysicsMaterial.new()
	sliding = add_character("res://cube.sbfz", Vector3(0, 0.2, 30))
	sliding.contact.connect(func(_body: int, _at: Vector3, _normal: Vector3, _impulse: float, with: Object):
		touched = touched or (with is RigidBody3D))
	moved = add_character("res://cube.sbfz", Vector3(-6, 0, 0))
	for i in SPEEDS.size():
		for phase in 2:
			var at := Vector3(-12 - 2 * i, 0, 4 * phase)
			add_character("res://cube.sbfz", at)
			thrown.append(add_ball(0.2, 0.05, at + Vector3(0, 0.15, 2 + SPEEDS[i] / 60 * 0.5 * phase), Vector3(0, 0, -SPEEDS[i])))


func _physics_process(_delta: float) -> bool:
	frame += 1
	if frame == 40:
		for ball in thrown: check(ball.linear_velocity.z > -1, "what was thrown flies on at %s" % ball.linear_velocity)
	if frame == 90:
		check(sliding.position.x > 3, "it slid to %s" % sliding.position)
		goes_with_node(sliding, "sliding")
		near(lowest(skin_of(sliding), slope), 0, 0.03, "sliding, over the slope")
		add_ball(0.2, 0.05, middle_of(sliding) + 0.8 * Vector3(cos(SLOPE), -sin(SLOPE), 0), Vector3(-2, 0, 0))
	if frame == 120:
		check(touched, "what lies in its way far down is not touched")
		moved.position += Vector3(0, 0.5, 1)
		from = moved.position
	if frame == 121:
		check(moved.position.distance_to(from) < 0.02, "put to %s it is at %s" % [from, moved.position])
		goes_with_node(moved, "put")
		moved.teleport(Vector3(-6, 1, 2), 0.5)
		goes_with_node(moved, "teleported")
		near(moved.rotation.y, 0.5, 1e-4, "teleported, its heading")
	if frame == 300:
		goes_with_node(moved, "lying")
		near(lowest(skin_of(moved), bottom), 0, 0.005, "lying")
		from = moved.position
		moved.reset_pose()
		check(middle_of(moved).distance_to(from + Vector3(0, 0.15, 0)) < 0.01, "reset, its middle went to %s" % middle_of(moved))
	if frame == 420:
		near(lowest(skin_of(fallen), bottom), 0, 0.005, "fallen 3 m, over the floor")
		near(lowest(skin_of(on_crate), func(_at: Vector3): return 2 * crate.position.y), 0, 0.01, "fallen on the crate, over it")
		near(crate.position.y, 0.2, 0.01, "the crate's height")
		print("after %s: fallen to %s, on the crate %s, slid to %s" % [ProjectSettings.get_setting("physics/3d/physics_engine"),
				fallen.position, on_crate.position, sliding.position])
		finish()
		return true
	return false
