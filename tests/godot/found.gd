extends "checks.gd"
# What finds a character: areas, rays, overlap queries, a walking CharacterBody3D, a click of the mouse. Hits name the bone. Its own
# ground and colliders are none of its parts; a RigidBody3D meets its flesh, not its parts; one that carries it passes.

const AT := Vector3(0, 0, 0)
var lizard: SoftCharacter3D
var cube: SoftCharacter3D
var carried: SoftCharacter3D
var other: SoftCharacter3D
var alone: SoftCharacter3D
var area := Area3D.new()
var far := Area3D.new()
var ray := RayCast3D.new()
var walker := CharacterBody3D.new()
var carrier := CharacterBody3D.new()
var ball: RigidBody3D
var entered := []
var shapes := []
var left := 0
var met: Object
var camera := Camera3D.new()
var picked := []
var pointed := 0


func add_form(to: Node3D, form: Shape3D) -> void:
	var shape := CollisionShape3D.new()
	shape.shape = form
	to.add_child(shape)


func sphere(radius: float) -> SphereShape3D:
	var form := SphereShape3D.new()
	form.radius = radius
	return form


func _initialize() -> void:
	add_box("StaticBody3D", Vector3(60, 1, 60), Vector3(0, -0.5, 0)).collision_layer = 1
	lizard = add_character("res://lizard.sbfz", AT)
	lizard.collision_layer = 4
	alone = add_character("res://lizard.sbfz", Vector3(12, 0, 0))
	alone.collision_layer = 0
	other = add_character("res://lizard.sbfz", Vector3(0, 0, 12))
	cube = add_character("res://cube.sbfz", Vector3(4, 0.5, 0))
	cube.gravity_scale = 0
	carried = add_character("res://lizard.sbfz")
	root.add_child(carrier)
	add_form(carrier, sphere(0.3))
	carrier.position = Vector3(-6, 0.3, 0)
	carried.reparent(carrier, false)
	carried.position = Vector3(0, -0.3, 0)
	for one: Area3D in [area, far]:
		add_form(one, sphere(0.4))
		one.collision_mask = 4
		root.add_child(one)
	area.position = AT + Vector3(0, 0.2, 3)
	far.position = Vector3(0, 0.2, -3)
	area.body_entered.connect(func(body: Node3D): entered.append(body))
	area.body_exited.connect(func(_body: Node3D): left += 1)
	area.body_shape_entered.connect(func(_rid: RID, body: Node3D, shape: int, _own: int): shapes.append(body.get_bone_of_shape(shape)))
	far.body_entered.connect(func(_body: Node3D): check(false, "an area far from it found it"))
	ray.target_position = Vector3(0, -2, 0)
	ray.collision_mask = 4
	root.add_child(ray)
	add_form(walker, sphere(0.1))
	walker.collision_mask = 5
	walker.position = AT + Vector3(-1.5, 0.11, 0)
	root.add_child(walker)
	alone.input_ray_pickable = true # without effect: it is on no layer
	other.input_ray_pickable = true
	other.input_event.connect(func(_camera: Node, event: InputEvent, at: Vector3, _normal: Vector3, shape: int):
		if event is InputEventMouseButton: picked.append([at, other.get_bone_of_shape(shape)]))
	other.mouse_entered.connect(func(): pointed += 1)
	other.mouse_exited.connect(func(): pointed += 10)
	camera.position = Vector3(0, 3, 12)
	camera.rotation.x = -PI / 2
	root.add_child(camera)
	root.notification(Node.NOTIFICATION_VP_MOUSE_ENTER)
	ball = add_ball(0.05, 0.05, Vector3(0, 0.3, 13.5), Vector3(0, 0, -0.8))


func click(at: Vector3) -> void:
	var event := InputEventMouseButton.new()
	event.button_index = MOUSE_BUTTON_LEFT
	event.pressed = true
	event.position = camera.unproject_position(at)
	event.global_position = event.position
	root.push_input(event)


func hit_by(from: Vector3, to: Vector3, mask := 4) -> Dictionary:
	return root.world_3d.direct_space_state.intersect_ray(PhysicsRayQueryParameters3D.create(from, to, mask))


func bone_at(one: SoftCharacter3D, bone: int) -> Vector3:
	var lines := one.get_bone_lines()
	return (lines[2 * bone] + lines[2 * bone + 1]) / 2


# The middle of each bone with a part is inside of a part: an overlap query finds it.
func count_found(one: SoftCharacter3D) -> int:
	var query := PhysicsShapeQueryParameters3D.new()
	query.shape = sphere(0.005)
	query.collision_mask = one.collision_layer
	var found := 0
	for bone in one.asset.get_bone_names().size():
		query.transform.origin = bone_at(one, bone)
		var hits := root.world_3d.direct_space_state.intersect_shape(query)
		if hits.any(func(hit): return hit.collider == one and one.get_bone_of_shape(hit.shape) == one.asset.get_bone_names()[bone]): found += 1
	return found


func _physics_process(delta: float) -> bool:
	frame += 1
	walker.velocity = Vector3(0.6, 0, 0)
	walker.move_and_slide()
	for i in walker.get_slide_collision_count():
		var collider: Object = walker.get_slide_collision(i).get_collider()
		if collider is SoftCharacter3D: met = collider
	if frame == 20:
		check_hits()
		check(count_found(other) >= 18, "few bones of the other one are found")
		click(bone_at(other, 5))
	if frame == 24:
		check(picked.size() == 1 and picked[0][0].distance_to(bone_at(other, 5)) < 0.2 and picked[0][1] != "", "the click picked %s" % [picked])
		click(Vector3(0.8, 0, 12.8))
		other.input_ray_pickable = false
	if frame == 28:
		check(picked.size() == 1 and pointed in [1, 11], "a click beside it picked %s, the mouse came %d" % [picked, pointed])
	if frame == 30:
		carrier.position.z += 0.2
	if frame == 200:
		check(walker.position.x < -0.05 and met == lizard, "the walker is at %s, and met %s" % [walker.position, met])
		walker.position.y = 5
		lizard.forward_speed = 0.6
	if frame == 400:
		carrier.move_and_collide(Vector3(0, 0, 0.3))
		near(carrier.position.z, 0.5, 1e-3, "how far its own parts let the carrier go")
		check(lizard.position.z > 1, "it came to %s" % lizard.position)
		check_hits()
	if frame == 560:
		lizard.forward_speed = 0
		print("in the area came ", shapes)
		check(entered == [lizard] and "head" in ",".join(shapes), "in the area came %s, bones %s" % [entered, shapes])
		lizard.teleport(Vector3(0, 0, -20), 0)
	if frame == 564:
		check(left == 1, "it left the area %d times" % left)
		check_hits()
		print("ball ", ball.position, ball.linear_velocity)
		check(ball.linear_velocity.distance_to(Vector3(0, 0, -0.8)) > 0.05, "the ball did not meet the lizard")
		var from := cube.position + Vector3(0, 3, 0)
		cube.set_soft_velocity(0, Vector3.ZERO, Vector3(0, 1, 0))
		check(hit_by(from, cube.position, 1).get("collider") == cube, "no ray found the cube")
		ray.position = bone_at(lizard, 5) + Vector3(0, 1, 0)
	if frame == 570:
		check(ray.is_colliding() and ray.get_collider() == lizard, "RayCast3D found %s" % ray.get_collider())
		lizard.paused = true
		lizard.position = Vector3(0, 0, -30)
	if frame == 574:
		check_hits()
		lizard.paused = false
		lizard.collision_layer = 0
	if frame == 576:
		check(hit_by(bone_at(lizard, 5) + Vector3(0, 1, 0), bone_at(lizard, 5)).is_empty(), "a ray found it on no layer")
		lizard.collision_layer = 8
	if frame == 580:
		check(hit_by(bone_at(lizard, 5) + Vector3(0, 1, 0), bone_at(lizard, 5), 8).get("collider") == lizard, "no ray found it on layer 4")
		PhysicsServer3D.body_set_collision_layer(lizard.get_rid(), 16)
		check(hit_by(bone_at(lizard, 5) + Vector3(0, 1, 0), bone_at(lizard, 5), 16).get("collider") == lizard, "get_rid is another body")
		check(lizard.get_bone_of_shape(-1) == "" and lizard.get_bone_of_shape(999) == "" and lizard.get_soft_body_of_shape(999) == -1, "shapes that are none")
		var turn := cube.get_soft_angular_velocity(0).y
		check(turn > 0.5, "the cube turns by %f" % turn)
		check_cube()
		lizard.free()
		cube.free()
	if frame < 585:
		return false
	finish()
	return true


func check_hits() -> void:
	var found := count_found(lizard)
	check(found >= 18, "%d bones are found" % found)
	check(alone.get_travelled() == 0 and hit_by(bone_at(alone, 5) + Vector3(0, 1, 0), bone_at(alone, 5), 0xffff).get("collider") != alone, "a ray found what is on no layer")
	var down := hit_by(bone_at(lizard, 5) + Vector3(0, 1, 0), bone_at(lizard, 5))
	check(down.get("collider") == lizard, "a ray found %s" % down)
	if down:
		var body := lizard.get_soft_body_of_shape(down.shape)
		check(lizard.get_bone_of_shape(down.shape) != "" and body >= 0, "its shape %d has no bone" % down.shape)


# Its hull turns with its points.
func check_cube() -> void:
	var skin := skin_of(cube)
	var middle := middle_of(cube)
	var corner := middle
	for point in skin: if point.distance_to(middle) > corner.distance_to(middle): corner = point
	var out := (corner - middle).normalized()
	for outside: float in [0.97, 1.06]:
		var at := middle + (corner - middle) * outside
		var query := PhysicsShapeQueryParameters3D.new()
		query.shape = sphere(0.002)
		query.transform.origin = at
		var hit := root.world_3d.direct_space_state.intersect_shape(query).any(func(one): return one.collider == cube)
		check(hit == (outside < 1), "the corner of the cube at %f of its distance: %s, %s" % [outside, hit, out])
