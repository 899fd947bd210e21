extends "checks.gd"
# Wrong values: each is refused with an error that says what, and nothing changes or crashes; nodes are freed by the signals of their own step.

var one: SoftCharacter3D
var cube: SoftCharacter3D
var gone: SoftCharacter3D
var gone_too: SoftCharacter3D
var still: SoftCharacter3D


func _initialize() -> void:
	add_box("StaticBody3D", Vector3(80, 1, 80), Vector3(0, -0.5, 0))
	one = add_character("res://animated.sbfz")
	cube = add_character("res://cube.sbfz", Vector3(3, 0, 0))
	gone = add_character("res://animated.sbfz", Vector3(6, 0, 0))
	one.animation_finished.connect(func(_clip: String): if is_instance_valid(gone): gone.free())
	gone_too = add_character("res://animated.sbfz", Vector3(9, 0, 0))
	gone_too.meet_others = true
	gone_too.fell.connect(func(): gone_too.queue_free())
	still = SoftCharacter3D.new() # without an asset, outside of the tree


func _physics_process(_delta: float) -> bool:
	frame += 1
	if frame == 5:
		gone.play("nod", {speed = 1.01})
		gone_too.knock_over()
		wrong_clips()
		wrong_targets()
		wrong_bodies()
		nothing_there(still)
		still.free()
	if frame == 60:
		one.scale = Vector3(-1, -1, -1)
	if frame == 80:
		check(one.get_skin(0).size() > 0 and skin_of(one)[0].is_finite() and one.position.is_finite(), "it is nowhere")
		one.scale = Vector3.ZERO
	if frame == 100:
		check(skin_of(one)[0].is_finite(), "without a scale it is nowhere")
		check(not is_instance_valid(gone) and not is_instance_valid(gone_too), "they are not freed")
		one.asset = null
		nothing_there(one)
	if frame == 105:
		finish()
	return frame == 105


func wrong_clips() -> void:
	one.play("wave")
	one.play("nod", "fast")
	one.play("nod", {speed = NAN})
	one.play("nod", {layer = 7})
	one.play("nod", {mask = "wings"})
	check(one.get_current_clip() == "", "it plays %s" % one.get_current_clip())
	one.play("nod")
	for i in 9: one.queue("sway")


func wrong_targets() -> void:
	one.set_ik_target("wing", Transform3D.IDENTITY)
	one.set_ik_target("hand.L", Transform3D(Basis.IDENTITY, Vector3(NAN, 0, 0)))
	one.set_look_target("wing", Vector3.ZERO)
	one.set_look_target("head", Vector3(0, INF, 0))
	one.clear_look_target("wing")
	one.pose_weight = NAN
	check(one.pose_weight == 1, "its pose weighs %f" % one.pose_weight)


func wrong_bodies() -> void:
	cube.drag(Vector3.ZERO)
	one.apply_impulse(Vector3(NAN, 0, 0), Vector3.ONE)
	cube.apply_impulse(cube.position, Vector3(INF, 0, 0))
	cube.velocity = Vector3(INF, 0, 0)
	check(cube.velocity == Vector3.ZERO, "its velocity is %s" % cube.velocity)
	cube.move_and_slide()
	one.collision_layer = -(1 << 40)
	check(one.collision_layer == 1, "it is on the layers %d" % one.collision_layer)


# Without an asset nothing is done, nor complained of.
func nothing_there(what: SoftCharacter3D) -> void:
	what.play("nod")
	what.queue("nod")
	what.set_ik_target("hand.L", Transform3D.IDENTITY)
	what.set_look_target("head", Vector3.ZERO)
	what.apply_impulse(Vector3.ZERO, Vector3.ONE)
	what.apply_force(Vector3.ZERO, Vector3.ONE)
	what.release()
	what.drag(Vector3.ZERO)
	check(not what.grab(Vector3.ZERO) and not what.move_and_slide() and what.get_contacts().is_empty(), "something is there")
	check(what.get_bone_of_shape(0) == "" and what.get_current_clip() == "" and not what.get_rid().is_valid(), "it has parts")
