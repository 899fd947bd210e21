extends "checks.gd"
# A character that walks at a velocity as a CharacterBody3D does: straight on, turned to where it goes, along a NavigationAgent3D's path around
# a wall, into a wall, and with its node moved each frame by a parent and by a script. Its feet step, and it never jumps.

var straight: SoftCharacter3D
var aside: SoftCharacter3D
var walled: SoftCharacter3D
var led: SoftCharacter3D
var moved: SoftCharacter3D
var passenger: SoftCharacter3D
var parent := Node3D.new()
var agent := NavigationAgent3D.new()
var region := NavigationRegion3D.new()
var steps := {}
var longest := {}
var before := {}
var stopped := 0
var arrived := false
var corner := false


func add_walker(name: String, at: Vector3) -> SoftCharacter3D:
	var one := add_character("res://lizard.sbfz", at)
	steps[name] = 0
	longest[name] = 0.0
	one.name = name
	one.foot_down.connect(func(_leg: int, _at: Vector3): steps[name] += 1)
	return one


func _initialize() -> void:
	add_box("StaticBody3D", Vector3(80, 1, 80), Vector3(0, -0.5, 0))
	straight = add_walker("straight", Vector3(0, 0, 0))
	aside = add_walker("aside", Vector3(6, 0, 0))
	walled = add_walker("walled", Vector3(12, 0, 0))
	add_box("StaticBody3D", Vector3(3, 1, 0.2), Vector3(12, 0.5, 1.6))
	moved = add_walker("moved", Vector3(18, 0, 0))
	passenger = add_walker("passenger", Vector3(24, 0, 0))
	root.add_child(parent)
	led = add_walker("led", Vector3(-10, 0, 0))
	led.add_child(agent)
	add_box("StaticBody3D", Vector3(4, 1, 0.2), Vector3(-11, 0.5, 2))
	agent.path_desired_distance = 0.3
	agent.target_desired_distance = 0.3
	agent.path_height_offset = 0
	root.add_child(region)
	region.navigation_mesh = mesh_around()


# Walkable ground around the wall between z = 1 and z = 3, which ends at x = -8.
func mesh_around() -> NavigationMesh:
	var mesh := NavigationMesh.new()
	mesh.vertices = PackedVector3Array([Vector3(-14, 0, -2), Vector3(-8, 0, -2), Vector3(-4, 0, -2), Vector3(-14, 0, 1), Vector3(-8, 0, 1),
			Vector3(-4, 0, 1), Vector3(-14, 0, 3), Vector3(-8, 0, 3), Vector3(-4, 0, 3), Vector3(-14, 0, 6), Vector3(-8, 0, 6), Vector3(-4, 0, 6)])
	for corner_of: Array in [[0, 1, 4, 3], [1, 2, 5, 4], [4, 5, 8, 7], [6, 7, 10, 9], [7, 8, 11, 10]]:
		mesh.add_polygon(PackedInt32Array(corner_of))
	return mesh


func _physics_process(delta: float) -> bool:
	frame += 1
	if frame == 10:
		passenger.reparent(parent)
	if frame < 20:
		return false
	if frame == 20:
		agent.target_position = Vector3(-10, 0, 4.5)
		for one: SoftCharacter3D in [straight, aside, walled, led, moved, passenger]: before[str(one.name)] = one.global_position
		aside.max_turn_speed = 1.5
	if frame <= 320:
		straight.velocity = Vector3(0, 0, 0.4)
		straight.move_and_slide()
		aside.velocity = Vector3(0.3, 0, 0)
		aside.move_and_slide()
		walled.velocity = Vector3(0, 0, 0.4)
		if walled.move_and_slide(): stopped += 1
		moved.position += moved.basis.z * 0.3 * delta
		moved.rotate_y(0.2 * delta)
		parent.position.x += 0.3 * delta
	if not arrived and frame > 22:
		led.velocity = led.global_position.direction_to(agent.get_next_path_position()) * 0.6
		led.move_and_slide()
		arrived = agent.is_navigation_finished()
	corner = corner or (led.position.x > -8.6 and led.position.z > 0.5)
	for one: SoftCharacter3D in [straight, aside, walled, led, moved, passenger]:
		var name := str(one.name)
		longest[name] = maxf(longest[name], one.global_position.distance_to(before[name]))
		before[name] = one.global_position
	if frame == 200:
		near(straight.get_real_velocity().z, 0.4, 0.1, "real velocity")
	if frame < 1300 and not (arrived and frame > 330):
		return false
	print("steps ", steps, " longest ", longest, " frames ", frame)
	near(straight.position.z, 2, 0.05, "how far it went at 0.4 m/s in 5 s")
	near(straight.rotation.y, 0, 0.02, "its heading")
	near(aside.position.x, 7.5, 0.05, "how far it went aside")
	near(aside.rotation.y, PI / 2, 0.05, "it turned to its velocity by")
	check(walled.position.z < 1.4 and stopped > 100, "at the wall it is at %s, and was stopped %d times" % [walled.position, stopped])
	near(moved.rotation.y, 1, 0.03, "how far it turned with its node")
	near(passenger.global_position.x, 25.5, 0.1, "how far its parent took it")
	check(arrived and led.position.distance_to(Vector3(-10, 0, 4.5)) < 0.4 and corner, "the agent led it to %s" % led.position)
	for name: String in steps:
		check(steps[name] > 8 and longest[name] < 0.05, "%s: %d steps, it moved by %f m in a frame" % [name, steps[name], longest[name]])
	finish()
	return true
