extends "checks.gd"
# What is a node's: it keeps still where it does not process, also among those that it meets; it is as large as it is scaled to; what hangs
# below it is neither ground nor in its way; it is dressed, saved, loaded, doubled, given another parent, and freed by the
# signal of one that it meets; a number that is none is refused; and without any ground, or with too much to meet, it says so.

var walkers: Array[SoftCharacter3D] = []
var scaled: SoftCharacter3D
var parent := Node3D.new()
var boxed: Array[SoftCharacter3D] = []
var saved: SoftCharacter3D
var other: SoftCharacter3D
var gone: SoftCharacter3D


func size_of(one: SoftCharacter3D) -> Vector3:
	var skin := skin_of(one)
	var box := AABB(skin[0], Vector3.ZERO)
	for point in skin: box = box.expand(point)
	return box.size


func add_walker(at: Vector3) -> SoftCharacter3D:
	var one := add_character("res://lizard.sbfz", at)
	one.forward_speed = 0.25
	return one


func refuses(name: String, value: Variant) -> void:
	var was: Variant = scaled.get(name)
	scaled.set(name, value)
	check(scaled.get(name) == was, "%s became %s" % [name, value])


func _initialize() -> void:
	add_box("StaticBody3D", Vector3(60, 1, 60), Vector3(0, -0.5, 0))
	for mode in [Node.PROCESS_MODE_ALWAYS, Node.PROCESS_MODE_INHERIT, Node.PROCESS_MODE_DISABLED]:
		var one := add_walker(Vector3(2 * walkers.size(), 0, 0))
		one.meet_others = true
		one.process_mode = mode
		walkers.append(one)
	scaled = SoftCharacter3D.new()
	scaled.asset = load("res://lizard.sbfz")
	root.add_child(parent)
	parent.position = Vector3(-4, 0, 0)
	parent.add_child(scaled)
	for kind in ["", "StaticBody3D", "AnimatableBody3D", "CharacterBody3D", "RigidBody3D"]:
		var one := add_walker(Vector3(3 * boxed.size(), 0, 10))
		boxed.append(one)
		if kind:
			var box := add_box(kind, Vector3(0.2, 0.2, 0.2), Vector3(0, 0.15, 0))
			if box is RigidBody3D: box.freeze = true
			box.reparent(one, false)
	gone = add_walker(Vector3(-8, 0, 0))
	gone.meet_others = true
	walkers[0].foot_down.connect(func(_leg: int, _at: Vector3): if is_instance_valid(gone): gone.free())
	add_character("res://lizard.sbfz", Vector3(500, 0, 0))
	add_character("res://lizard.sbfz", Vector3(-20, 0, 0))
	for i in 300: add_ball(1, 0.02, Vector3(-20 + 0.06 * (i % 10 - 5), 0.6 + 0.06 * (i / 50), 0.06 * (i / 10 % 5)), Vector3.ZERO)


func _physics_process(_delta: float) -> bool:
	frame += 1
	if frame == 30:
		check(walkers[0].get_travelled() > 0.02 and walkers[1].get_travelled() > 0.02, "they do not walk")
		check(walkers[2].get_travelled() == 0, "it does not process, and walks")
		paused = true
	if frame == 31:
		walkers.append(null)
		set_meta("travelled", walkers[1].get_travelled())
		set_meta("size", size_of(scaled))
		scaled.scale = Vector3(3, 3, 3)
		scaled.process_mode = Node.PROCESS_MODE_ALWAYS
	if frame == 60:
		check(walkers[1].get_travelled() == get_meta("travelled"), "it walks in a paused tree")
		check(walkers[0].get_travelled() > get_meta("travelled") + 0.05, "it does not walk on in a paused tree")
		paused = false
		near(size_of(scaled).z / get_meta("size").z, 3, 0.1, "how much larger it is")
		near(scaled.scale.x, 3, 1e-3, "the node's scale")
		parent.scale = Vector3(0.5, 0.5, 0.5)
	if frame == 90:
		check(walkers[1].get_travelled() > get_meta("travelled"), "it does not walk on")
		near(size_of(scaled).z / get_meta("size").z, 1.5, 0.05, "how much larger it is under a parent of half the size")
		for one: Array in [["scheme", 99], ["scheme", -1], ["substeps", -1], ["gravity_scale", NAN], ["gravity_scale", INF],
				["ground", 7], ["push_limit", NAN], ["forward_speed", INF], ["asset", Resource.new()]]:
			refuses(one[0], one[1])
		scaled.drive(NAN, 0, 0)
		check(scaled.forward_speed == 0 and scaled.get_skin(0).size() > 0, "it is driven by no number")
		scaled.position = Vector3(NAN, 0, 0)
	if frame == 95:
		check(scaled.position.is_finite() and skin_of(scaled)[0].is_finite(), "it is nowhere")
		dress(scaled)
		saved = keep(scaled)
		other = scaled.duplicate()
		other.position.z = 6
		parent.add_child(other)
		scaled.reparent(root)
	if frame == 100:
		check(size_of(saved).is_equal_approx(size_of(other)) and size_of(saved).z > get_meta("size").z, "they are not as large")
		check(not is_instance_valid(gone), "it was not freed by the signal of another one")
		for one in boxed.slice(1):
			check(absf(one.position.y) < 1e-3 and one.get_travelled() == boxed[0].get_travelled(),
					"with a hit box it is at %s, not %s" % [one.position, boxed[0].position])
		saved.queue_free()
		finish()
		return true
	return false


# What it is drawn with, by its own types.
func dress(one: SoftCharacter3D) -> void:
	var skeleton: Skeleton3D = one.get_skeleton()
	var mesh: MeshInstance3D = one.get_mesh_instance(0)
	var none: MeshInstance3D = one.get_mesh_instance(99)
	check(skeleton.get_bone_count() == one.asset.get_bone_names().size() and mesh.mesh.get_surface_count() > 0 and not none, "not its parts")
	var twin := SoftCharacter3D.new()
	twin.asset = one.asset
	parent.add_child(twin)
	check(twin.get_mesh_instance(0).mesh.surface_get_material(0) == mesh.mesh.surface_get_material(0), "a second node made a material of its own")
	twin.free()
	one.material_override = StandardMaterial3D.new()
	one.layers = 5
	one.cast_shadow = GeometryInstance3D.SHADOW_CASTING_SETTING_OFF
	var hat := BoneAttachment3D.new()
	skeleton.add_child(hat)
	hat.bone_name = skeleton.get_bone_name(5)
	one.scheme = SoftCharacter3D.SCHEME_POSITION_BASED # made anew
	check(one.get_skeleton() == skeleton and skeleton.get_child_count() == 1, "what hangs on its bones is gone")
	check(skeleton.get_bone_count() == one.asset.get_bone_names().size(), "its skeleton has %d bones" % skeleton.get_bone_count())
	one.mirror_skeleton = false
	check(one.get_skeleton() == null, "it still has a skeleton")
	one.mirror_skeleton = true
	check(one.get_skeleton() != null, "it has no skeleton again")
	mesh = one.get_mesh_instance(0)
	check(mesh.material_override == one.material_override and mesh.layers == 5 and
			mesh.cast_shadow == GeometryInstance3D.SHADOW_CASTING_SETTING_OFF, "it is not dressed")


# Saved as a scene, and loaded from that.
func keep(one: SoftCharacter3D) -> SoftCharacter3D:
	var scene := PackedScene.new()
	check(scene.pack(one) == OK and ResourceSaver.save(scene, "res://kept.tscn") == OK, "it is not saved")
	check(FileAccess.get_file_as_string("res://kept.tscn").count("[node") == 1, "more is saved than the node")
	var loaded: SoftCharacter3D = load("res://kept.tscn").instantiate()
	check(loaded.asset == one.asset and loaded.layers == 5 and loaded.scheme == SoftCharacter3D.SCHEME_POSITION_BASED, "it is loaded otherwise")
	loaded.position.z = 3
	parent.add_child(loaded)
	return loaded
