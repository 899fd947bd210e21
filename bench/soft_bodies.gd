extends SceneTree
# The lizard's sections, loose, dropped on a plane: as this runtime's or as SoftBody3D. Arguments: who (ours, none, or
# godot), frames, simulation_precision, linear_stiffness, pressure_coefficient, what (time, look, or a picture's path).
#
# Prints "volume LEAST MOST LAST lowest DEPTH" where it looks: shares of the rest volume over all sections, m.

const HEIGHT := 0.25
var words := OS.get_cmdline_user_args()
var frames := words[1].to_int()
var ours: SoftCharacter3D
var bodies: Array[SoftBody3D] = []
var points: Array[PackedVector3Array] = [] # of each section at rest
var triangles: Array[PackedInt32Array] = []
var rest: PackedFloat64Array = []
var least := INF
var most := 0.0
var last := 0.0
var lowest := INF
var frame := 0


func volume(at: PackedVector3Array, faces: PackedInt32Array) -> float:
	var sum := 0.0
	for i in range(0, faces.size(), 3):
		sum += at[faces[i]].cross(at[faces[i + 1]]).dot(at[faces[i + 2]])
	return absf(sum) / 6


# One closed surface of a section: the vertices of its materials' surfaces that lie in one place are one.
func take_section(mesh: ArrayMesh) -> void:
	var number := {}
	var at := PackedVector3Array()
	var faces := PackedInt32Array()
	for surface in mesh.get_surface_count():
		var arrays := mesh.surface_get_arrays(surface)
		for index in arrays[Mesh.ARRAY_INDEX]:
			var point: Vector3 = arrays[Mesh.ARRAY_VERTEX][index]
			if not number.has(point):
				number[point] = at.size()
				at.append(point)
			faces.append(number[point])
	points.append(at)
	triangles.append(faces)
	rest.append(volume(at, faces))


func add_soft_body(i: int) -> void:
	var arrays := []
	arrays.resize(Mesh.ARRAY_MAX)
	arrays[Mesh.ARRAY_VERTEX] = points[i]
	arrays[Mesh.ARRAY_INDEX] = triangles[i]
	var tool := SurfaceTool.new()
	tool.create_from_arrays(arrays)
	tool.generate_normals()
	var body := SoftBody3D.new()
	body.mesh = tool.commit()
	body.total_mass = rest[i] * 1000
	body.simulation_precision = words[2].to_int()
	body.linear_stiffness = words[3].to_float()
	body.pressure_coefficient = words[4].to_float()
	body.position.y = HEIGHT
	var paint := StandardMaterial3D.new()
	paint.albedo_color = Color(0.15, 0.6, 0.6)
	body.material_override = paint
	root.add_child(body)
	bodies.append(body)


func begin() -> void:
	var floor_body := StaticBody3D.new()
	var form := CollisionShape3D.new()
	form.shape = BoxShape3D.new()
	form.shape.size = Vector3(20, 1, 20)
	floor_body.add_child(form)
	floor_body.position.y = -0.5
	root.add_child(floor_body)
	ours = SoftCharacter3D.new()
	ours.asset = load("res://lizard.sbfz")
	ours.free_bodies = true
	ours.ground = SoftCharacter3D.GROUND_FLAT
	ours.use_threads = false
	ours.mirror_skeleton = false
	root.add_child(ours)
	for child in ours.get_children(true):
		if child is MeshInstance3D:
			take_section(child.mesh)
	if words[0] == "ours":
		ours.teleport(Vector3(0, HEIGHT, 0), 0)
	else:
		root.remove_child(ours)
		ours.free()
		ours = null
	if words[0] == "godot":
		for i in points.size():
			add_soft_body(i)
	if words[5].ends_with(".png"):
		RenderingServer.render_loop_enabled = false
		draw_room()


func draw_room() -> void:
	var seen := MeshInstance3D.new()
	seen.mesh = PlaneMesh.new()
	seen.mesh.size = Vector2(6, 6)
	var paint := StandardMaterial3D.new()
	paint.albedo_color = Color(0.5, 0.49, 0.46)
	seen.material_override = paint
	root.add_child(seen)
	var camera := Camera3D.new()
	root.add_child(camera)
	camera.fov = 35
	camera.look_at_from_position(Vector3(0.95, 0.55, 1.0), Vector3(0.02, 0.03, -0.08))
	var sun := DirectionalLight3D.new()
	sun.shadow_enabled = true
	sun.light_energy = 0.55
	sun.directional_shadow_max_distance = 6
	root.add_child(sun)
	sun.look_at_from_position(Vector3(1, 2, 0.6), Vector3.ZERO)
	var around := WorldEnvironment.new()
	around.environment = Environment.new()
	around.environment.background_mode = Environment.BG_COLOR
	around.environment.background_color = Color(0.8, 0.85, 0.9)
	around.environment.ambient_light_source = Environment.AMBIENT_SOURCE_COLOR
	around.environment.ambient_light_color = Color.WHITE
	around.environment.ambient_light_energy = 0.35
	root.add_child(around)


func look() -> void:
	var sum := 0.0
	var all := 0.0
	for i in points.size():
		var now := PackedVector3Array()
		if words[0] == "ours":
			sum += ours.get_volume_ratio(i) * rest[i]
			now = ours.get_skin(i)
		else:
			for k in points[i].size():
				now.append(bodies[i].get_point_transform(k))
			sum += volume(now, triangles[i])
		for point in now:
			lowest = minf(lowest, point.y)
		all += rest[i]
	last = sum / all
	least = minf(least, last)
	most = maxf(most, last)


func _physics_process(_delta: float) -> bool:
	frame += 1
	if frame == 1:
		begin()
	if words[5] != "time" and words[0] != "none" and frame > 5:
		look()
	if frame == frames - 2 and words[5].ends_with(".png"):
		RenderingServer.render_loop_enabled = true
	return false


func _process(_delta: float) -> bool:
	if frame < frames + (3 if words[5].ends_with(".png") else 0):
		return false
	if words[5].ends_with(".png"):
		root.get_texture().get_image().save_png(words[5])
	print("volume %f %f %f lowest %f" % [least, most, last, lowest])
	quit()
	return true
