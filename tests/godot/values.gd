extends "checks.gd"
# A walk on level ground has the same bits as the program's own, and all that the node tells agrees with it.

var character: SoftCharacter3D
var downs := 0
var ups := 0
var last_down := Vector3.ZERO


func _initialize() -> void:
	for name in ["SoftAsset", "SoftAssetLoader", "SoftCharacter3D"]:
		check(ClassDB.class_exists(name), name + " is no class")
	for name in ["foot_down", "foot_up", "landed", "contact", "torn"]:
		check(ClassDB.class_has_signal("SoftCharacter3D", name), name + " is no signal")
	for name in ["asset", "paused", "forward_speed", "turn_speed", "scheme", "substeps", "gravity_scale", "ground", "collision_mask"]:
		check(name in ClassDB.class_get_property_list("SoftCharacter3D", true).map(func(one): return one.name), name + " is no property")
	check(ClassDB.class_get_integer_constant("SoftCharacter3D", "SCHEME_HEUN") == 5, "SCHEME_HEUN")
	var asset: SoftAsset = load("res://lizard.sbfz")
	check(asset == load("res://lizard.sbfz"), "a second load is the same resource")
	check(asset.get_bone_names().size() == 29 and "Pelvis" in asset.get_soft_body_names(), "names of parts")
	character = add_character()
	character.ground = SoftCharacter3D.GROUND_FLAT
	character.detail = SoftCharacter3D.DETAIL_FULL # what is selected is a part of the state
	character.forward_speed = 0.25
	character.foot_down.connect(func(_leg: int, position: Vector3): downs += 1; last_down = position)
	character.foot_up.connect(func(_leg: int, _position: Vector3): ups += 1)


func _physics_process(_delta: float) -> bool:
	frame += 1
	if frame <= 600:
		return false
	var told := OS.get_cmdline_user_args()
	check(character.get_state_hash() == told[0], "state %s, not the program's %s" % [character.get_state_hash(), told[0]])
	near(character.get_travelled(), told[1].to_float(), 1e-6, "travelled")
	check(downs == told[2].to_int() and ups >= downs, "%d steps told, not %s; %d lifts" % [downs, told[2], ups])
	check(last_down.distance_to(character.position) < 0.6 and absf(last_down.y) < 0.02, "a foot came down at %s" % last_down)
	near(character.position.z, character.get_travelled(), 0.05, "the node went along")
	check(character.get_leg_count() == 4 and [0, 1, 2, 3].any(character.is_leg_planted), "legs")
	near(character.get_volume_ratio(0), 1, 0.05, "volume")
	var skeleton: Skeleton3D = character.get_skeleton()
	check(skeleton.get_bone_count() == 29, "bones of the skeleton")
	var lines := character.get_bone_lines()
	for bone in skeleton.get_bone_count():
		var at := skeleton.global_transform * skeleton.get_bone_global_pose(bone)
		check(at.origin.distance_to(lines[2 * bone]) < 1e-4, "bone %d is at %s, not %s" % [bone, at.origin, lines[2 * bone]])
		var way := lines[2 * bone + 1] - lines[2 * bone]
		check(way.is_zero_approx() or (at.basis.y.normalized() - way.normalized()).length() < 1e-3, "bone %d points elsewhere" % bone)
	var meshes := character.get_children(true).filter(func(one): return one is MeshInstance3D)
	check(meshes.size() == 22, "%d meshes under the node" % meshes.size())
	check(meshes.all(func(one): return one.mesh.get_surface_count() > 0 and one.mesh.surface_get_material(0)), "surfaces")
	var box: AABB = meshes[0].global_transform * meshes[0].mesh.custom_aabb
	check(box.grow(1e-3).has_point(character.get_skin(0)[0]), "bounds of what is drawn")
	finish()
	return true
