extends "checks.gd"
# What is light lies still on flesh: a ball, a crate and a body of two shapes, each of half a kilogram, let go over cubes of 27 kg. And a cube
# that is let go over a light crate on the floor lies on that.

var things: Array[RigidBody3D] = []
var cubes: Array[SoftCharacter3D] = []
var crate: RigidBody3D
var fastest: Array[float] = [0, 0, 0]


func shape_of(form: Shape3D, at: Vector3) -> CollisionShape3D:
	var one := CollisionShape3D.new()
	one.shape = form
	one.position = at
	return one


func box(size: Vector3) -> BoxShape3D:
	var form := BoxShape3D.new()
	form.size = size
	return form


func let_go(forms: Array, over: Vector3, mass: float) -> RigidBody3D:
	var body := RigidBody3D.new()
	for one in forms: body.add_child(one)
	body.mass = mass
	body.position = over
	root.add_child(body)
	return body


func add_cube(at: Vector3) -> void:
	var one := SoftCharacter3D.new()
	one.asset = load("res://cube.sbfz")
	one.position = at
	root.add_child(one)
	cubes.append(one)


func _initialize() -> void:
	add_box("StaticBody3D", Vector3(20, 1, 20), Vector3(0, -0.5, 0))
	for i in 3: add_cube(Vector3(2 * i, 0, 0))
	var ball := SphereShape3D.new()
	ball.radius = 0.1
	things.append(let_go([shape_of(ball, Vector3.ZERO)], Vector3(0.025, 0.5, 0.025), 0.5))
	things.append(let_go([shape_of(box(Vector3(0.2, 0.1, 0.2)), Vector3.ZERO)], Vector3(2, 0.5, 0), 0.5))
	var halves := [shape_of(box(Vector3(0.1, 0.1, 0.2)), Vector3(-0.06, 0, 0)), shape_of(box(Vector3(0.1, 0.1, 0.2)), Vector3(0.06, 0, 0))]
	things.append(let_go(halves, Vector3(4, 0.5, 0), 0.5))
	crate = let_go([shape_of(box(Vector3(0.6, 0.2, 0.6)), Vector3.ZERO)], Vector3(6, 0.1, 0), 1)
	add_cube(Vector3(6, 0.3, 0))


func _physics_process(_delta: float) -> bool:
	frame += 1
	if frame > 240:
		for i in things.size(): fastest[i] = maxf(fastest[i], things[i].linear_velocity.length())
	if frame == 360:
		var engine: String = ProjectSettings.get_setting("physics/3d/physics_engine")
		print("%s: the fastest of each in two seconds %s m/s, at %s %s %s" % [engine, fastest, things[0].position, things[1].position, things[2].position])
		for i in things.size():
			near(things[i].position.y, 0.4 if i == 0 else 0.35, 0.02, "the height of thing %d" % i)
			check(fastest[i] < 0.02, "thing %d moves by %f m/s" % [i, fastest[i]])
		var bottom := lowest(skin_of(cubes[3]), func(_at: Vector3): return 0.2)
		print("the crate at %s, the cube %f m above it" % [crate.position, bottom])
		near(crate.position.y, 0.1, 0.005, "the crate's height")
		near(bottom, 0, 0.01, "the cube over the crate")
		finish()
		return true
	return false
