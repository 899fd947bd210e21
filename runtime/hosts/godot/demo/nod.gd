extends Skeleton3D
# Bones that an AnimationPlayer nods; the lizard takes their pose (pose_source), and its flesh follows.

@onready var lizard: SoftCharacter3D = $"../Lizard"
var player := AnimationPlayer.new()


func _ready() -> void:
	var from: Skeleton3D = lizard.get_skeleton()
	for bone in from.get_bone_count():
		add_bone(from.get_bone_name(bone))
		set_bone_parent(bone, from.get_bone_parent(bone))
		set_bone_rest(bone, from.get_bone_rest(bone))
	reset_bone_poses()
	var rest := get_bone_rest(find_bone("neck")).basis.get_rotation_quaternion()
	var clip := Animation.new()
	var track := clip.add_track(Animation.TYPE_ROTATION_3D)
	clip.track_set_path(track, "%s:neck" % name)
	clip.length = 1.2
	for key in 5: clip.rotation_track_insert_key(track, 0.3 * key, rest * Quaternion(Vector3.RIGHT, 0.4 if key % 2 else 0.0))
	var library := AnimationLibrary.new()
	library.add_animation("nod", clip)
	player.add_animation_library("", library)
	player.root_node = ".."
	get_parent().add_child.call_deferred(player)
	lizard.pose_source = lizard.get_path_to(self)


func nod() -> void:
	player.play("nod")
