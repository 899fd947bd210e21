extends "checks.gd"
# The demo by its keys, drawn: it walks, its skin stays on the hills, and the picture shows it.

var scene: Node3D
var start := Vector3.ZERO
var least := INF
var balls := []
var jellies := []
var met := {}


func _initialize() -> void:
	# Without a graphics card a frame takes a second: the last ones are drawn.
	RenderingServer.render_loop_enabled = false
	scene = load("res://walk.tscn").instantiate()
	root.add_child(scene)
	for name in ["Jelly", "Jelly2"]:
		scene.get_node(name).contact.connect(func(_soft_body: int, _position: Vector3, _normal: Vector3, _impulse: float, with: Object):
			if with == scene.get_node("Lizard"): met[name] = true)


func click(button: MouseButton, pressed: bool, at: Vector3) -> void:
	var event := InputEventMouseButton.new()
	event.button_index = button
	event.pressed = pressed
	event.position = scene.get_node("Camera").unproject_position(at)
	event.global_position = event.position
	root.push_input(event)


func drag_to(at: Vector3) -> void:
	var event := InputEventMouseMotion.new()
	event.position = scene.get_node("Camera").unproject_position(at)
	event.global_position = event.position
	root.push_input(event)


# The mouse pushes, drags and leads; the neck nods; the gate is lit.
func play_on(lizard: SoftCharacter3D) -> void:
	var hand: Node3D = scene.get_node("Hand")
	var jelly: SoftCharacter3D = scene.get_node("Jelly")
	var skeleton: Skeleton3D = lizard.get_skeleton()
	match frame:
		410:
			click(MOUSE_BUTTON_LEFT, true, middle_of(lizard))
			check(scene.get_node("Hit").text.begins_with("Lizard "), "the click hit '%s'" % scene.get_node("Hit").text)
		412:
			start = middle_of(jelly)
			click(MOUSE_BUTTON_RIGHT, true, start)
			drag_to(start + Vector3(0, 0.3, 0))
			check(hand.held == jelly, "the hand holds %s" % hand.held)
		450:
			# The lizard may stand on it: what is grabbed comes up.
			var top := -INF
			for point in skin_of(jelly): top = maxf(top, point.y)
			check(top > start.y + 0.18, "the hand dragged it to %f m, from a middle at %f m" % [top, start.y])
			click(MOUSE_BUTTON_RIGHT, false, start)
			check(hand.held == null and not jelly.is_grabbed(), "the hand still holds it")
			press(KEY_N, true)
		468:
			var neck := skeleton.find_bone("neck")
			var turn := skeleton.get_bone_rest(neck).basis.get_rotation_quaternion().angle_to(skeleton.get_bone_pose_rotation(neck))
			check(turn > 0.2, "the neck nods by %f" % turn)
			start = lizard.position
			hand.goal = start + Vector3(-0.5, 0, -0.5)
		640:
			check(lizard.position.distance_to(start) > 0.4 and not hand.goal.is_finite(), "it was led from %s to %s" % [start, lizard.position])
			lizard.teleport(scene.get_node("Gate").position, 0)
		645:
			check(scene.get_node("Gate/Seen").mesh.material.albedo_color.r > 0.9, "the gate is not lit")


func press(key: Key, down: bool) -> void:
	var event := InputEventKey.new()
	event.keycode = key
	event.physical_keycode = key
	event.pressed = down
	Input.parse_input_event(event)


func _physics_process(_delta: float) -> bool:
	frame += 1
	var lizard: SoftCharacter3D = scene.get_node("Lizard")
	if frame == 60:
		balls = range(1, 5).map(func(i): return scene.get_node("Ball%d" % i).position)
		jellies = ["Jelly", "Jelly2"].map(func(name): return middle_of(scene.get_node(name)))
	if frame == 20:
		press(KEY_UP, true)
	if frame == 260:
		press(KEY_A, true)
	if frame > 60 and frame % 30 == 0:
		least = minf(least, lowest(skin_of(lizard), func(at: Vector3): return scene.get_node("Hills").height(at.x, at.z)))
	if frame == 646:
		RenderingServer.render_loop_enabled = true
	if frame == 400:
		press(KEY_A, false)
		press(KEY_UP, false)
		check(lizard.get_travelled() > 1.2, "it went %f m" % lizard.get_travelled())
		check(lizard.rotation.y > 0.5, "it turned by %f" % lizard.rotation.y)
		var rolled := range(1, 5).map(func(i): return balls[i - 1].distance_to(scene.get_node("Ball%d" % i).position))
		print("balls rolled ", rolled)
		check(rolled.max() > 0.2, "no ball was pushed away: %s" % [rolled])
		var went := [0, 1].map(func(i): return jellies[i].distance_to(middle_of(scene.get_node(["Jelly", "Jelly2"][i]))))
		print("jellies went ", went, ", met ", met.keys())
		check(met.size() == 2, "the lizard met %s of the jellies" % [met.keys()])
		check(went.min() > 0.2, "a jelly was not pushed away: %s" % [went])
		check(scene.steps > 20, "%d steps were told" % scene.steps)
		check(least > -0.02 and least < 0.02, "the lowest point of its skin is %f above the hills" % least)
		print("went %f m, turned %f, %d steps, lowest %f" % [lizard.get_travelled(), lizard.rotation.y, scene.steps, least])
	if frame > 400: play_on(lizard)
	return false


func _process(_delta: float) -> bool:
	if frame < 652:
		return false
	var out := OS.get_cmdline_user_args()
	if out.size() and DisplayServer.get_name() != "headless":
		var picture := root.get_texture().get_image()
		var colours := {}
		for y in range(0, picture.get_height(), 4):
			for x in range(0, picture.get_width(), 4):
				colours[picture.get_pixel(x, y).to_rgba32()] = true
		check(colours.size() > 200, "the picture has %d colours" % colours.size())
		check(picture.save_png(out[0]) == OK, "the picture cannot be written")
	finish()
	return true
