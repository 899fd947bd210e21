extends "checks.gd"
# Clips by name with their ends, loops, queues, masks and layers; limbs that reach; a head that turns to a point; and the pose of another
# skeleton, which an AnimationPlayer drives: the flesh follows it.

const HAND := "hand.L"
var one: SoftCharacter3D
var posed: SoftCharacter3D
var source := Skeleton3D.new()
var player := AnimationPlayer.new()
var finished := []
var tip := Vector3.ZERO
var start := Vector3.ZERO


func _initialize() -> void:
	one = add_character("res://animated.sbfz")
	one.ground = SoftCharacter3D.GROUND_FLAT
	one.animation_finished.connect(func(clip: String): finished.append([clip, frame]))
	posed = add_character("res://animated.sbfz", Vector3(3, 0, 0))
	posed.ground = SoftCharacter3D.GROUND_FLAT
	check("nod" in one.asset.get_clip_names() and "back" in one.asset.get_bone_mask_names() and HAND in one.asset.get_ik_chain_names(), "names")


# The asset's own bones, of which the neck is keyed.
func make_source() -> void:
	var from: Skeleton3D = posed.get_skeleton()
	for bone in from.get_bone_count():
		source.add_bone(from.get_bone_name(bone).validate_node_name())
		source.set_bone_parent(bone, from.get_bone_parent(bone))
		source.set_bone_rest(bone, from.get_bone_rest(bone))
	source.reset_bone_poses()
	source.name = "Source"
	root.add_child(source)
	var neck := source.find_bone("neck")
	var rest := source.get_bone_rest(neck).basis.get_rotation_quaternion()
	var clip := Animation.new()
	var track := clip.add_track(Animation.TYPE_ROTATION_3D)
	clip.length = 1
	clip.track_set_path(track, "Source:neck")
	clip.rotation_track_insert_key(track, 0, rest)
	clip.rotation_track_insert_key(track, 0.5, rest * Quaternion(Vector3.RIGHT, 0.4))
	clip.rotation_track_insert_key(track, 1, rest * Quaternion(Vector3.RIGHT, 0.4))
	var library := AnimationLibrary.new()
	library.add_animation("lower", clip)
	player.add_animation_library("", library)
	root.add_child(player)


func bone_of(of: SoftCharacter3D, name: String) -> int:
	return of.asset.get_bone_names().find(name)


# How far a bone is turned from rest, against its parent.
func angle_of(of: SoftCharacter3D, name: String) -> float:
	var skeleton: Skeleton3D = of.get_skeleton()
	var bone := skeleton.find_bone(name)
	return skeleton.get_bone_rest(bone).basis.get_rotation_quaternion().angle_to(skeleton.get_bone_pose_rotation(bone))


func front_of(of: SoftCharacter3D, name: String) -> Vector3:
	var skeleton: Skeleton3D = of.get_skeleton()
	var bone := skeleton.find_bone(name)
	return (skeleton.get_bone_global_pose(bone).basis * skeleton.get_bone_global_rest(bone).basis.inverse()) * Vector3(0, 0, 1)


func head_at(of: SoftCharacter3D, name: String) -> Vector3:
	return of.get_bone_lines()[2 * bone_of(of, name)]


# The mean of the flesh around a bone.
func flesh_of(of: SoftCharacter3D, name: String) -> Vector3:
	var sum := Vector3.ZERO
	var skin := of.get_skin(of.asset.get_render_mesh_names().find(name))
	for point in skin: sum += point
	return sum / skin.size()


func _physics_process(_delta: float) -> bool:
	frame += 1
	match frame:
		5:
			make_source()
		10:
			one.play("nod")
			check(one.get_current_clip() == "nod" and one.get_current_clip(1) == "", "what plays")
			tip = head_at(one, "head")
		25:
			near(one.get_clip_position(), 0.25, 0.03, "position in the clip")
			near(angle_of(one, "neck"), 0.25, 0.05, "the neck's turn half through")
			check(finished.is_empty(), "it ended early: %s" % [finished])
		45:
			check(finished.size() == 1 and finished[0][0] == "nod" and absi(finished[0][1] - 40) <= 1, "its end: %s" % [finished])
			check(one.get_current_clip() == "", "it plays after its end")
			near(angle_of(one, "neck"), 0.5, 0.03, "the neck stays turned")
			check(head_at(one, "head").distance_to(tip) > 0.01, "its head did not move")
			one.play("nod", {speed = 2.0}) # from its beginning again
		50:
			near(angle_of(one, "neck"), 0.15, 0.08, "the neck begins again")
		70:
			check(finished.size() == 2 and absi(finished[1][1] - 61) <= 2, "its end at twice the speed: %s" % [finished])
			one.play("nod", {loop = true})
		170:
			check(finished.size() == 2 and one.get_current_clip() == "nod", "a loop ended: %s" % [finished])
			one.play("sway", {loop = false, layer = 1})
			one.queue("nod", {layer = 1, speed = -1.0})
			one.play("", 0.1)
		260:
			check(finished.map(func(each): return each[0]) == ["nod", "nod", "sway", "nod"], "the queue: %s" % [finished])
			check(absi(finished[2][1] - 230) <= 1 and absi(finished[3][1] - 261) <= 3, "when the queue's ended: %s" % [finished])
			near(angle_of(one, "neck"), 0, 0.03, "the neck, played backwards")
			one.play("", {layer = 1})
			one.play("nod", {mask = "back", layer = 2})
			one.play("sway", {weight = 0.5, blend = 0.2})
		290:
			near(angle_of(one, "neck"), 0, 0.01, "the neck, which the mask leaves out")
			near(angle_of(one, "spine"), 0.1, 0.03, "the spine at half the weight")
			for layer in 3: one.play("", {layer = layer})
			start = one.position
			one.play("crawl", {root_motion = true})
		410:
			near((one.position - start).z, 0.6, 0.05, "how far the clip took it")
			one.play("", 0.0)
			reach(1.0)
		440:
			near(head_at(one, HAND).distance_to(tip), 0, 0.01, "the hand's distance from its target")
			reach(0.0)
			one.clear_ik_target(HAND)
		460:
			check(head_at(one, HAND).distance_to(tip) > 0.02, "the hand stays at the target")
			one.set_look_target("head", head_at(one, "head") + Vector3(1, 0.2, 1))
			tip = front_of(one, "head")
		520:
			check(front_of(one, "head").angle_to(Vector3(1, 0.2, 1)) < 0.25, "the head looks to %s, before to %s" % [front_of(one, "head"), tip])
			one.clear_look_target("head")
		600:
			check(front_of(one, "head").angle_to(tip) < 0.1, "the head looks to %s still" % front_of(one, "head"))
			check_pose_source()
		610:
			player.play("lower")
		700:
			near(angle_of(posed, "neck"), 0.4, 0.03, "the neck that the other skeleton turns")
			check(flesh_of(posed, "Head").distance_to(start) > 0.02, "its flesh did not follow: %s" % [flesh_of(posed, "head") - start])
			posed.pose_weight = 0.5
		705:
			near(angle_of(posed, "neck"), 0.2, 0.03, "the neck at half the weight")
			posed.pose_source = NodePath()
		710:
			near(angle_of(posed, "neck"), 0, 0.03, "the neck on its own")
			posed.pose_source = posed.get_path_to(source)
			posed.pose_weight = 1
			source.free()
		711:
			finish()
	return false


func reach(weight: float) -> void:
	tip = head_at(one, HAND) + Vector3(0.02, 0.06, 0.03)
	one.set_ik_target(HAND, Transform3D(Basis.from_scale(Vector3(2, 2, 2)), tip), weight)


func check_pose_source() -> void:
	var hash_before := posed.get_travelled()
	posed.pose_source = posed.get_path_to(source)
	check(posed.get_travelled() == hash_before and posed.get_skeleton() != null, "it was made from its beginning")
	start = flesh_of(posed, "Head")
