extends "checks.gd"
# A weightless soft cube of 27 kg that a script pushes, holds and drags; and a lizard's pins and stresses.

const MASS := 27.0
var cube: SoftCharacter3D
var lizard: SoftCharacter3D
var vertex := -1
var start := Vector3.ZERO
var target := Vector3.ZERO
var floor_cube: SoftCharacter3D
var slept := []
var woken := []
var struck := []
var ended := 0


func _initialize() -> void:
	add_box("StaticBody3D", Vector3(20, 1, 20), Vector3(0, -0.5, 0))
	cube = SoftCharacter3D.new()
	cube.asset = load("res://cube.sbfz")
	cube.gravity_scale = 0
	cube.position = Vector3(0, 3, 0)
	root.add_child(cube)
	floor_cube = add_character("res://cube.sbfz", Vector3(-3, 0, 0))
	floor_cube.fell_asleep.connect(func(_body: int, _at: Vector3): slept.append(frame))
	floor_cube.woke.connect(func(_body: int, _at: Vector3): woken.append(frame))
	floor_cube.struck.connect(func(_body: int, _at: Vector3, _normal: Vector3, speed: float, with: Object): if with is StaticBody3D: struck.append(speed))
	floor_cube.contact_ended.connect(func(_body: int, with: Object): if with is StaticBody3D: ended += 1)
	lizard = add_character("res://lizard.sbfz", Vector3(4, 0, 0))


func momentum(wanted: Vector3, what: String) -> void:
	var is_now := cube.get_soft_velocity(0) * cube.get_soft_mass(0)
	check(is_now.distance_to(wanted) < 0.02 * wanted.length(), "%s: %s, not %s" % [what, is_now, wanted])


func _physics_process(_delta: float) -> bool:
	frame += 1
	if frame > 204 and frame <= 216: cube.apply_force(middle_of(cube) + Vector3(0, 5, 0), Vector3(-67.5, 0, 0))
	match frame:
		5:
			near(cube.get_soft_mass(0), MASS, 0.5, "mass")
			cube.set_soft_velocity(0, Vector3(0, 0, 1), Vector3(0, 2, 0))
		8:
			momentum(Vector3(0, 0, MASS), "velocity")
			near(cube.get_soft_angular_velocity(0).y, 2, 0.1, "angular velocity")
			cube.set_soft_velocity(0, Vector3.ZERO, Vector3.ZERO)
			cube.apply_soft_impulse(0, -1, Vector3(27, 0, 0))
		11:
			momentum(Vector3(27, 0, 0), "impulse")
			cube.apply_soft_impulse(0, 0, Vector3(-27, 0, 13.5))
		14:
			momentum(Vector3(0, 0, 13.5), "impulse at a vertex")
			cube.apply_soft_force(0, -1, Vector3(0, 0, -135), 0.1)
		24:
			check((cube.get_soft_velocity(0) * MASS).length() < 0.5, "force: %s" % cube.get_soft_velocity(0))
			start = middle_of(cube)
			vertex = cube.get_nearest_vertex(0, start + Vector3(0, 5, 0))
			check(vertex >= 0, "nearest vertex")
			target = start + Vector3(0.5, 0.5, 0)
			cube.grab_vertex(0, vertex, target)
		27:
			check(cube.get_grab_force(0, vertex).length() > 1, "force of the hold")
		200:
			check(middle_of(cube).distance_to(target) < 0.35, "dragged to %s, not %s" % [middle_of(cube), target])
			check(cube.release_vertex(0, vertex), "release")
			check(not cube.release_vertex(0, vertex), "release twice")
			check(cube.get_grab_force(0, vertex) == Vector3.ZERO, "no force after it")
			var pins := lizard.get_pin_reactions(0)
			check(pins.size() > 0 and pins.size() % 2 == 0, "pins: %d" % pins.size())
			check(cube.get_pin_reactions(0).size() == 0, "pins of what is loose")
			print("pins ", pins, " stress ", cube.get_stress(0).size())
			check(cube.get_stress(0).size() % 2 == 0, "stress")
			var contacts := floor_cube.get_contacts()
			check(contacts.size() == 1 and contacts[0].with is StaticBody3D and contacts[0].soft_body == 0 and contacts[0].normal.y > 0.9 and
					absf(contacts[0].position.y) < 0.02, "the cube on the floor has contacts %s" % [contacts])
			check(slept.size() >= 1 and floor_cube.is_asleep(0), "it did not say that it fell asleep")
		201:
			cube.set_soft_velocity(0, Vector3.ZERO, Vector3.ZERO)
			cube.apply_impulse(middle_of(cube) + Vector3(0, 5, 0), Vector3(13.5, 0, 0))
		204:
			momentum(Vector3(13.5, 0, 0), "impulse at a place")
		217:
			check((cube.get_soft_velocity(0) * MASS).length() < 0.6, "force at a place: %s" % cube.get_soft_velocity(0))
			start = middle_of(cube)
			vertex = cube.get_nearest_vertex(0, start + Vector3(0, 2, 0))
			check(cube.grab(start + Vector3(0, 2, 0)) and cube.is_grabbed(), "grab")
			target = Vector3(0.4, 0.3, -0.2)
		218:
			cube.drag(start + Vector3(0, 2, 0) + target)
			start = cube.get_skin(0)[vertex]
		380:
			check((cube.get_skin(0)[vertex] - start).distance_to(target) < 0.05, "dragged by %s, not %s" % [cube.get_skin(0)[vertex] - start, target])
			cube.release()
			check(not cube.is_grabbed(), "released")
			struck.clear()
			floor_cube.set_soft_velocity(0, Vector3(0, 2, 0), Vector3.ZERO)
		384:
			check(woken.size() >= 1, "it did not say that it woke")
			check(floor_cube.get_contacts().is_empty() and ended == 1, "in the air it has contacts %s, %d ended" % [floor_cube.get_contacts(), ended])
		500:
			check(struck.size() >= 1 and struck[0] > 1 and struck.max() < 6, "it was struck at %s" % [struck])
			finish()
	return false
