extends "checks.gd"
# What a soft cube of 27 kg touches is pushed: weightless, the two have as much momentum after as before; switched off, the body goes its
# way; and a crate that the cube lies on stays where it is.

const MASS := 27.0
const SPEED := 2.0
var cube: SoftCharacter3D
var ball: RigidBody3D
var crate: RigidBody3D
var lying: SoftCharacter3D
var middle := Vector3.ZERO
var wanted := 0.0
var spun := 0.0


func add_cube(at: Vector3, weight: float) -> SoftCharacter3D:
	var one := SoftCharacter3D.new()
	one.asset = load("res://cube.sbfz")
	one.gravity_scale = weight
	one.position = at
	root.add_child(one)
	return one


func begin(mass: float, pushes: bool) -> void:
	for one in [cube, ball]: if one: one.queue_free()
	cube = add_cube(Vector3(0, 3, 0), 0)
	cube.push_bodies = pushes
	ball = add_ball(mass, 0.1, Vector3(-0.5, 3.2, 0), Vector3(SPEED, 0, 0))
	wanted = mass * SPEED


# The cube's speed by how its middle goes in half a second, over which it has swung many times.
func near_momentum(what: String, within: float) -> void:
	var speed := (middle_of(cube) - middle) * 2
	var sum := MASS * speed + ball.mass * ball.linear_velocity
	print("%s: ball %s, cube %s, momentum %s of %f" % [what, ball.linear_velocity, speed, sum, wanted])
	var energy := MASS * speed.length_squared() + ball.mass * ball.linear_velocity.length_squared()
	check(energy < wanted * SPEED, what + ": energy came from nowhere")
	near(sum.x, wanted, within * wanted, what + ": momentum along")
	near(sum.y, 0, within * wanted, what + ": momentum across")


func _initialize() -> void:
	add_box("StaticBody3D", Vector3(20, 1, 20), Vector3(0, -0.5, 0))
	crate = add_box("RigidBody3D", Vector3(0.6, 0.4, 0.6), Vector3(3, 0.2, 0))
	crate.mass = 10
	lying = add_cube(Vector3(3, 0.6, 0), 1)
	begin(3, true)


func _physics_process(_delta: float) -> bool:
	frame += 1
	var time := frame % 120
	if time == 60:
		middle = middle_of(cube)
		spun = ball.angular_velocity.length()
	if time == 90:
		match frame / 120:
			0:
				near_momentum("a ball of 3 kg", 0.02)
				check(ball.linear_velocity.x < 0, "it did not bounce off: %s" % ball.linear_velocity)
				check(spun > 0.1, "it was hit above its middle and does not spin")
				begin(60, true)
			1:
				near_momentum("a ball of 60 kg", 0.02)
				check(ball.linear_velocity.x < 1.6 and ball.linear_velocity.x > 0.5, "%s" % ball.linear_velocity)
				begin(3, false)
			2:
				near(ball.linear_velocity.x, SPEED, 1e-5, "switched off, its speed")
				var bottom := lowest(skin_of(lying), func(_at: Vector3): return 0.4)
				print("after %s: the crate at %s, the cube %f m above it" %
						[ProjectSettings.get_setting("physics/3d/physics_engine"), crate.position, bottom])
				near(crate.position.y, 0.2, 0.005, "the crate's height")
				check(crate.position.distance_to(Vector3(3, 0.2, 0)) < 0.02, "the crate went to %s" % crate.position)
				near(bottom, 0, 0.01, "the cube over the crate")
				finish()
				return true
	return false
