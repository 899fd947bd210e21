extends "checks.gd"
# How finely characters are simulated follows what the camera sees: near ones finest, far ones coarser, those behind it not at all; without a
# camera, beside a rigid body, and where a node asks for it, finest.

const FINEST := 0
var ahead: Array[SoftCharacter3D] = []
var behind: SoftCharacter3D
var hidden: SoftCharacter3D
var full: SoftCharacter3D
var touched: SoftCharacter3D
var camera := Camera3D.new()


func add_walker(at: Vector3) -> SoftCharacter3D:
	var one := add_character("res://lizard.sbfz", at)
	one.ground = SoftCharacter3D.GROUND_FLAT
	one.forward_speed = 0.25
	return one


func _initialize() -> void:
	for distance in [1.5, 20, 60, 200]: ahead.append(add_walker(Vector3(0, 0, -distance)))
	behind = add_walker(Vector3(0, 0, 40))
	hidden = add_walker(Vector3(1, 0, -4))
	hidden.visible = false
	full = add_walker(Vector3(3, 0, -200))
	full.detail = SoftCharacter3D.DETAIL_FULL
	touched = add_character("res://lizard.sbfz", Vector3(-3, 0, -200))
	add_box("StaticBody3D", Vector3(4, 1, 4), Vector3(-3, -0.5, -200))
	add_ball(1, 0.05, Vector3(-3, 0.6, -200), Vector3.ZERO)
	camera.position = Vector3(0, 0.5, 0)
	root.add_child(camera)
	camera.current = true


func levels() -> Array:
	return ahead.map(func(one: SoftCharacter3D) -> int: return one.get_detail_level())


func _physics_process(_delta: float) -> bool:
	frame += 1
	if frame == 180:
		var now := levels()
		print("ahead %s, behind %d, hidden %d, near a ball %d" % [now, behind.get_detail_level(), hidden.get_detail_level(), touched.get_detail_level()])
		check(now[0] == FINEST, "the nearest is on level %d" % now[0])
		check(now[3] > FINEST and now[1] <= now[2] and now[2] <= now[3], "levels by distance are %s" % [now])
		check(behind.get_detail_level() > now[3], "the one behind the camera is on level %d" % behind.get_detail_level())
		check(hidden.get_detail_level() > now[3], "the hidden one is on level %d" % hidden.get_detail_level())
		check(full.get_detail_level() == FINEST, "the one in full detail is on level %d" % full.get_detail_level())
		check(touched.get_detail_level() == FINEST, "the one near a ball is on level %d" % touched.get_detail_level())
		for one in ahead + [behind, hidden, full]: near(one.get_travelled(), full.get_travelled(), 0.05, "%s went" % one.name)
		camera.projection = Camera3D.PROJECTION_ORTHOGONAL # the same size on the screen from anywhere
		camera.size = 400
	if frame == 300:
		var now := levels()
		print("far above: ", now)
		check(now[0] > FINEST and now[0] == now[3], "levels without perspective are %s" % [now])
		camera.projection = Camera3D.PROJECTION_PERSPECTIVE
		ProjectSettings.set_setting("sbfmt/detail/budget_ms", 0.001)
	if frame == 420:
		var now := levels()
		print("for a microsecond: ", now)
		check(now[0] > FINEST, "within no time the nearest is on level %d" % now[0])
		ProjectSettings.set_setting("sbfmt/detail/budget_ms", 0.0)
		camera.queue_free()
	if frame < 560:
		return false
	for one in ahead + [behind, hidden, full, touched]: check(one.get_detail_level() == FINEST, "without a camera one is on level %d" % one.get_detail_level())
	finish()
	return true
