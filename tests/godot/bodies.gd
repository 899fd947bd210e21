extends "checks.gd"
# A ball that is pressed on a soft body from above presses it in, and the body tells of it; one that the mask leaves out
# passes.

const RADIUS := 0.08
var character: SoftCharacter3D
var ball: RigidBody3D
var told := []
var deepest := INF
var pressed := 0.0
var standing := 0.0
var spine := 0


func _initialize() -> void:
	var ground := add_box("StaticBody3D", Vector3(20, 1, 20), Vector3(0, -0.5, 0))
	character = add_character()
	character.contact.connect(func(soft_body: int, _position: Vector3, normal: Vector3, impulse: float, with: Object):
		if with != ground: told.append([soft_body, normal, impulse, with]))
	ball = RigidBody3D.new()
	var form := CollisionShape3D.new()
	form.shape = SphereShape3D.new()
	form.shape.radius = RADIUS
	ball.add_child(form)
	ball.freeze_mode = RigidBody3D.FREEZE_MODE_KINEMATIC
	ball.freeze = true
	ball.position = Vector3(0, 1, 0)
	root.add_child(ball)


func _physics_process(_delta: float) -> bool:
	frame += 1
	if frame == 2:
		spine = character.asset.get_soft_body_names().find("Spine")
		var top := Vector3(0, -INF, 0)
		for point in character.get_skin(character.asset.get_render_mesh_names().find("Spine")):
			if point.y > top.y: top = point
		ball.position = top + Vector3(0, RADIUS + 0.03, 0)
	if frame <= 30:
		standing = character.get_max_strain(spine)
	if frame > 30 and frame <= 120:
		ball.position.y -= 0.0005
	if frame > 30 and frame <= 260:
		for point in skin_of(character):
			deepest = minf(deepest, point.distance_to(ball.position) - RADIUS)
		pressed = maxf(pressed, character.get_max_strain(spine))
	if frame == 260:
		print("after %s: %d contacts, nearest %f m outside of the ball, strain %f, standing %f" %
				[ProjectSettings.get_setting("physics/3d/physics_engine"), told.size(), deepest, pressed, standing])
		check(told.size() > 0 and told.all(func(one): return one[3] == ball), "what it touched is not the ball")
		check(told.any(func(one): return one[1].y < -0.5), "the ball's underside is not what it touched")
		check(deepest > -0.006 and deepest < 0.01, "the ball is %f from the skin" % deepest)
		check(pressed > standing + 0.05, "the body is not pressed in")
		ball.collision_layer = 2
		ball.position.y = 1
	if frame == 320:
		told.clear()
		ball.position.y = 0.2
	if frame == 340:
		check(told.is_empty(), "a ball of another layer is met")
		finish()
		return true
	return false
