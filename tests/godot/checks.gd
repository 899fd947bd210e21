extends SceneTree
# What the scripts of this folder share: counting frames, and saying what is not as it should be.

var failed := 0
var frame := 0


func check(good: bool, what: String) -> void:
	if not good:
		failed += 1
		print("FAILED: ", what)


func near(a: float, b: float, within: float, what: String) -> void:
	check(absf(a - b) <= within, "%s: %f, not %f within %f" % [what, a, b, within])


func finish() -> void:
	print("%d failed after %d frames" % [failed, frame])
	quit(1 if failed else 0)


# A box of the physics space; kinds: StaticBody3D, AnimatableBody3D, RigidBody3D.
func add_box(kind: String, size: Vector3, at: Vector3, turned := Vector3.ZERO) -> PhysicsBody3D:
	var body: PhysicsBody3D = ClassDB.instantiate(kind)
	var form := CollisionShape3D.new()
	form.shape = BoxShape3D.new()
	form.shape.size = size
	body.add_child(form)
	body.position = at
	body.rotation = turned
	root.add_child(body)
	return body


# A weightless one that nothing brakes.
func add_ball(mass: float, radius: float, at: Vector3, velocity: Vector3) -> RigidBody3D:
	var body := RigidBody3D.new()
	var form := CollisionShape3D.new()
	form.shape = SphereShape3D.new()
	form.shape.radius = radius
	body.add_child(form)
	body.mass = mass
	body.gravity_scale = 0
	for kind in ["linear_damp", "angular_damp"]:
		body.set(kind + "_mode", RigidBody3D.DAMP_MODE_REPLACE)
		body.set(kind, 0.0)
	body.can_sleep = false
	body.position = at
	body.linear_velocity = velocity
	root.add_child(body)
	return body


func add_character(path := "res://lizard.sbfz", at := Vector3.ZERO) -> SoftCharacter3D:
	var character := SoftCharacter3D.new()
	character.asset = load(path)
	character.position = at
	root.add_child(character)
	return character


# All points of all its render meshes.
func skin_of(character: SoftCharacter3D) -> PackedVector3Array:
	var points := PackedVector3Array()
	for mesh in character.asset.get_render_mesh_names().size():
		points.append_array(character.get_skin(mesh))
	return points


func middle_of(character: SoftCharacter3D) -> Vector3:
	var sum := Vector3.ZERO
	var skin := skin_of(character)
	for point in skin: sum += point
	return sum / skin.size()


# The lowest point of a skin above what a function says of the ground.
func lowest(skin: PackedVector3Array, height: Callable) -> float:
	var least := INF
	for point in skin:
		least = minf(least, point.y - height.call(point))
	return least
