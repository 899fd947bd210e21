extends "checks.gd"
# A rock that is given as the points of a convex polygon is let go over the lizard's back: it presses the flesh in, is told of, and is
# borne, so that it falls off later than it would fall. One whose points lie in a plane is passed through, which is said once.

const SIZE := 0.06
var character: SoftCharacter3D
var rock: RigidBody3D
var told := []
var standing := 0.0
var pressed := 0.0
var deepest := 0.0
var slowest := -INF
var spine := 0


func add_rock(points: PackedVector3Array, at: Vector3) -> RigidBody3D:
	var body := RigidBody3D.new()
	var form := CollisionShape3D.new()
	form.shape = ConvexPolygonShape3D.new()
	form.shape.points = points
	body.add_child(form)
	body.mass = 2
	body.position = at
	root.add_child(body)
	return body


# Corners of an octahedron, with others inside, in its faces and on its edges.
func octahedron(size: float) -> PackedVector3Array:
	var points := PackedVector3Array([Vector3.ZERO])
	for i in 6:
		var corner := Vector3.ZERO
		corner[i % 3] = size if i < 3 else -size
		points.append_array([corner, corner * 0.5])
	for i in 8:
		points.append(Vector3(1 if i & 1 else -1, 1 if i & 2 else -1, 1 if i & 4 else -1) * size / 3)
	return points


# How deep a place lies in the rock, m; below 0 outside.
func depth_in(at: Vector3) -> float:
	var p := (rock.global_transform.affine_inverse() * at).abs()
	return (SIZE - p.x - p.y - p.z) / sqrt(3)


func _initialize() -> void:
	add_box("StaticBody3D", Vector3(20, 1, 20), Vector3(0, -0.5, 0))
	character = add_character()
	character.contact.connect(func(soft_body: int, _position: Vector3, _normal: Vector3, impulse: float, with: Object):
		if with is RigidBody3D: told.append([soft_body, impulse, with]))


func _physics_process(_delta: float) -> bool:
	frame += 1
	if frame == 30:
		spine = character.asset.get_soft_body_names().find("Spine")
		standing = character.get_max_strain(spine)
		var top := Vector3(0, -INF, 0)
		for point in character.get_skin(character.asset.get_render_mesh_names().find("Spine")):
			if point.y > top.y: top = point
		rock = add_rock(octahedron(SIZE), top + Vector3(0, SIZE + 0.06, 0))
		for i in 2:
			add_rock(PackedVector3Array([Vector3.ZERO, Vector3(0.1, 0, 0), Vector3(0.1, 0, 0.1), Vector3(0, 0, 0.1)]), Vector3(0.3, 0.3, 0.2 * i))
	if frame > 30 and frame <= 70:
		for point in skin_of(character): deepest = maxf(deepest, depth_in(point))
		pressed = maxf(pressed, character.get_max_strain(spine))
		slowest = maxf(slowest, rock.linear_velocity.y)
	if frame == 70:
		print("after %s: %d contacts, %f m in the rock, strain %f, standing %f, rock up at %f m/s, now %s" % [ProjectSettings.get_setting("physics/3d/physics_engine"),
				told.size(), deepest, pressed, standing, slowest, rock.position])
	if frame == 71:
		check(told.size() > 0 and told.all(func(one): return one[2] == rock), "what it touched is not the rock: %s" % [told])
		check(deepest < 0.015, "the skin is %f m in the rock" % deepest)
		check(pressed > standing + 0.05, "the flesh is not pressed in: %f" % pressed)
		check(slowest > 0.1, "the rock is not thrown back: %f" % slowest)
		finish()
		return true
	return false
