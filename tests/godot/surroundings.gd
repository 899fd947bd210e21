extends "checks.gd"
# The world that a character walks in: walls of every kind of body stop it, stairs and hills do not, a lift and a platform
# carry it, a door pushes it, and it falls where its floor goes. Each has a lane of its own, 4 m wide.

const LANE := 4.0
var walkers := {}
var lift: AnimatableBody3D
var platform: AnimatableBody3D
var door: AnimatableBody3D
var trapdoor: StaticBody3D
var landed := 0
var steps := {}


func lane(name: String) -> Vector3:
	return Vector3(LANE * walkers.size(), 0, 0)


func add_walker(name: String, speed: float, above := 0.0) -> Vector3:
	var at := lane(name)
	var one := add_character("res://lizard.sbfz", at + Vector3(0, above, 0))
	one.forward_speed = speed
	walkers[name] = one
	return at


func add_form(form: Shape3D, at: Vector3, turned := Vector3.ZERO, kind := "StaticBody3D") -> PhysicsBody3D:
	var body: PhysicsBody3D = ClassDB.instantiate(kind)
	var shape := CollisionShape3D.new()
	shape.shape = form
	body.add_child(shape)
	body.position = at
	body.rotation = turned
	root.add_child(body)
	return body


func add_floor(at: Vector3) -> PhysicsBody3D:
	return add_box("StaticBody3D", Vector3(LANE - 0.5, 1, 14), at + Vector3(0, -0.5, 4))


func hills() -> HeightMapShape3D:
	var map := HeightMapShape3D.new()
	map.map_width = 4
	map.map_depth = 13
	var heights := PackedFloat32Array()
	for z in 13: for x in 4: heights.append(0.0 if z < 5 else 0.1 * sin((z - 5) * 0.7))
	map.map_data = heights
	return map


func wall_of_triangles() -> ConcavePolygonShape3D:
	var mesh := BoxMesh.new()
	mesh.size = Vector3(3, 1, 0.2)
	return mesh.create_trimesh_shape()


func _initialize() -> void:
	for kind in ["StaticBody3D", "AnimatableBody3D", "CharacterBody3D", "RigidBody3D"]:
		var at := add_walker(kind, 0.4)
		add_floor(at)
		var wall := add_box(kind, Vector3(3, 1, 0.2), at + Vector3(0, 0.5, 1.6))
		if wall is RigidBody3D: wall.mass = 5000
	var at := add_walker("triangles", 0.4)
	add_floor(at)
	add_form(wall_of_triangles(), at + Vector3(0, 0.5, 1.6))
	at = add_walker("csg", 0.4)
	add_floor(at)
	var csg := CSGBox3D.new()
	csg.size = Vector3(3, 1, 0.2)
	csg.use_collision = true
	csg.position = at + Vector3(0, 0.5, 1.6)
	root.add_child(csg)
	at = add_walker("grid", 0.4)
	add_floor(at)
	var library := MeshLibrary.new()
	library.create_item(0)
	library.set_item_shapes(0, [hull_of_box(), Transform3D.IDENTITY])
	var grid := GridMap.new()
	grid.mesh_library = library
	grid.cell_size = Vector3(0.5, 0.5, 0.5)
	grid.position = at + Vector3(0, 0, 1.5)
	for x in range(-3, 3): grid.set_cell_item(Vector3i(x, 0, 0), 0)
	root.add_child(grid)
	at = add_walker("boundary", 0.4)
	var plane := WorldBoundaryShape3D.new()
	plane.plane = Plane(Vector3(0, 1, 0.05).normalized(), 0)
	add_form(plane, at + Vector3(0, -1.9, 0)) # endless: below all lanes
	at = add_walker("hills", 0.4)
	add_form(hills(), at)
	at = add_walker("stairs", 0.3)
	add_floor(at)
	for k in 5: add_box("StaticBody3D", Vector3(3, 0.06, 6), at + Vector3(0, 0.06 * k + 0.03, 4 + 0.4 * k))
	at = add_walker("bridge", 0.4)
	add_floor(at)
	add_box("StaticBody3D", Vector3(3, 0.2, 0.6), at + Vector3(0, 1.4, 1.5))
	at = add_walker("lift", 0)
	lift = add_box("AnimatableBody3D", Vector3(3, 0.2, 3), at + Vector3(0, -0.1, 0))
	at = add_walker("platform", 0)
	platform = add_box("AnimatableBody3D", Vector3(3, 0.2, 3), at + Vector3(0, -0.1, 0))
	at = add_walker("door", 0)
	add_floor(at)
	door = add_box("AnimatableBody3D", Vector3(3, 1, 0.2), at + Vector3(0, 0.5, -0.9))
	at = add_walker("trapdoor", 0)
	trapdoor = add_box("StaticBody3D", Vector3(3, 0.2, 3), at + Vector3(0, -0.1, 0))
	add_box("StaticBody3D", Vector3(3, 0.2, 3), at + Vector3(0, -1.6, 0))
	walkers["trapdoor"].landed.connect(func(_at: Vector3): landed += 1)
	for name in ["moved", "slowly", "turned"]:
		at = add_walker(name, 0)
		add_floor(at)
		walkers[name].foot_down.connect(func(_leg: int, _at: Vector3): steps[name] = steps.get(name, 0) + 1)
	for body in [lift, platform, door]: body.sync_to_physics = false


func hull_of_box() -> ConvexPolygonShape3D:
	var hull := ConvexPolygonShape3D.new()
	var points := PackedVector3Array()
	for i in 8: points.append(Vector3(-0.25 if i & 1 else 0.25, -0.25 if i & 2 else 0.25, -0.25 if i & 4 else 0.25))
	hull.points = points
	return hull


func nose_of(name: String) -> float:
	var most := -INF
	for point in skin_of(walkers[name]): most = maxf(most, point.z)
	return most


func _physics_process(delta: float) -> bool:
	frame += 1
	if frame > 60 and frame <= 180:
		lift.position.y += 0.5 * delta
		platform.position.z += 0.5 * delta
		door.position.z += 0.4 * delta
	if frame > 60 and frame <= 360:
		walkers["moved"].position.z += 0.3 * delta
		walkers["slowly"].position.z += 0.003 * delta
		walkers["turned"].rotate_y(0.3 * delta)
	if frame == 60:
		for name in ["lift", "platform", "trapdoor", "door", "moved", "slowly", "turned"]: set_meta(name, walkers[name].position)
		trapdoor.queue_free()
	if frame < 420:
		return false
	for name in ["StaticBody3D", "AnimatableBody3D", "CharacterBody3D", "RigidBody3D", "triangles", "csg", "grid"]:
		var nose := nose_of(name)
		check(nose > 1.3 and nose < 1.53, "%s: its nose is at %f m, the wall at 1.5 m" % [name, nose])
	for name in ["boundary", "hills", "stairs", "bridge"]:
		check(walkers[name].position.z > 1.2, "%s: it came to %s" % [name, walkers[name].position])
	near(walkers["boundary"].position.y, -1.9 - 0.05 * walkers["boundary"].position.z, 0.05, "its height on the boundary")
	near(walkers["bridge"].position.y, 0, 0.05, "its height under the bridge")
	near(walkers["lift"].position.y - get_meta("lift").y, 1, 0.03, "how far the lift lifted it")
	near(walkers["platform"].position.z - get_meta("platform").z, 1, 0.05, "how far the platform carried it")
	near(get_meta("trapdoor").y - walkers["trapdoor"].position.y, 1.5, 0.03, "how far it fell")
	check(landed == 1, "it said %d times that it landed" % landed)
	check(walkers["door"].position.z - get_meta("door").z > 0.05, "the door did not push it: %s" % walkers["door"].position)
	near(walkers["moved"].position.z - get_meta("moved").z, 1.5, 0.02, "how far it walked with its node")
	near(walkers["slowly"].position.z - get_meta("slowly").z, 0.015, 0.002, "how far it went with its node")
	near(walkers["turned"].rotation.y, 1.5, 0.02, "how far it turned with its node")
	check(steps.get("moved", 0) > 12 and steps.get("turned", 0) > 6, "its feet came down so often: %s" % steps)
	finish()
	return true
